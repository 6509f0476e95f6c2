//! The quality of a mesh: measures of every tetrahedron, histograms, the worst ones, and those that the input forces to be bad.
use crate::error::Error;
use crate::ffi::error::DelotetError;
use crate::ffi::guard::{get, guard, invalid, null, set};
use crate::ffi::mesh::DelotetMesh;
use crate::ffi::query::kept;
use crate::ffi::slice::array_mut;
use crate::ffi::status::{name_in, DelotetStatus};
use crate::ffi::view::{records, same_layout, DelotetDoublesView};
use crate::query::quality::{self, BINS, FORCED_BELOW};
use crate::query::{ForcedTet, Measure, QualitySummary, TetQuality};
use libc::c_char;
use std::mem::offset_of;

/// A measure of quality: one of the DELOTET_QUALITY_ constants.
pub type DelotetQualityMeasure = u32;
/// The smallest of the six dihedral angles, in degrees; up to 70.53. Smaller is worse.
pub const DELOTET_QUALITY_MIN_DIHEDRAL: DelotetQualityMeasure = 0;
/// The largest of the six dihedral angles, in degrees; at least 70.53. Larger is worse.
pub const DELOTET_QUALITY_MAX_DIHEDRAL: DelotetQualityMeasure = 1;
/// The circumradius over the shortest edge; at least 0.6124. Larger is worse.
pub const DELOTET_QUALITY_RADIUS_EDGE: DelotetQualityMeasure = 2;
/// The mean ratio 12 (3 V)^(2/3) / (sum of the squared edge lengths), from 0 to 1. Smaller is worse.
pub const DELOTET_QUALITY_ETA: DelotetQualityMeasure = 3;

/// The number of measures.
pub const DELOTET_QUALITY_MEASURES: usize = 4;
/// The number of bins of each histogram.
pub const DELOTET_QUALITY_BINS: usize = 10;
/// Tetrahedra in wedges of fewer degrees are input-forced (delotet_mesh_forced_tets()).
pub const DELOTET_QUALITY_FORCED_BELOW: f64 = 30.0;
const _: () = assert!(DELOTET_QUALITY_MEASURES == Measure::ALL.len() && DELOTET_QUALITY_BINS == BINS);
const _: () = assert!(DELOTET_QUALITY_FORCED_BELOW == FORCED_BELOW);

/// The measures of a tetrahedron. One that is not positive (in meshes of delotet_options_set_exact_form() only) counts as flat.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetTetQuality {
    /// The dihedral angles in degrees at the edges 01 02 03 12 13 23; 0 0 0 180 180 180 if it is not positive.
    pub dihedrals: [f64; 6],
    /// The circumradius over the length of the shortest edge; infinite if it is not positive.
    pub radius_edge: f64,
    /// The mean ratio 12 (3 V)^(2/3) / (sum of the squared edge lengths): 1 for the regular tetrahedron, 0 if it is not positive.
    pub eta: f64,
    /// The volume, negative if it is inverted. Beyond the range of doubles it is the largest of them, or zero.
    pub volume: f64,
}

/// Borrowed measures, one per tetrahedron; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetTetQualitiesView {
    /// The first of `count` records; DELOTET_AT(DelotetTetQuality, view, i) is the i-th.
    pub first: *const DelotetTetQuality,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetTetQualitiesView, DelotetTetQuality, TetQuality);
same_layout!(
    DelotetTetQuality,
    TetQuality,
    dihedrals = dihedrals,
    radius_edge = radius_edge,
    eta = eta,
    volume = volume
);

/// A tetrahedron in a narrow wedge between two facets; of several wedges the narrowest.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetForcedTet {
    /// The tetrahedron.
    pub tet: u32,
    /// The input facets on both sides of the wedge, the smaller index first.
    pub facets: [u32; 2],
    /// The ends of the edge where they meet, the smaller index first.
    pub ends: [u32; 2],
    /// The angle of the wedge in degrees.
    pub angle: f64,
}

/// Borrowed input-forced tetrahedra; NULL and 0 if there are none.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetForcedTetsView {
    /// The first of `count` records; DELOTET_AT(DelotetForcedTet, view, i) is the i-th.
    pub first: *const DelotetForcedTet,
    /// Number of elements.
    pub count: usize,
    /// Bytes from one element to the next.
    pub stride: usize,
}
records!(DelotetForcedTetsView, DelotetForcedTet, ForcedTet);
same_layout!(DelotetForcedTet, ForcedTet, tet = tet, facets = facets, ends = ends, angle = angle);

/// The quality of a mesh at a glance. Arrays are indexed by measure (a DELOTET_QUALITY_ constant). Later versions append fields;
/// `struct_size` tells both sides which ones exist.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct DelotetQualitySummary {
    /// The caller sets it to sizeof(DelotetQualitySummary); the library sets it to the number of bytes written.
    pub struct_size: usize,
    /// The number of tetrahedra.
    pub tet_count: u64,
    /// How many of them are input-forced (delotet_mesh_forced_tets()).
    pub forced_count: u64,
    /// The worst value of each measure; 0 if there are no tetrahedra.
    pub worst: [f64; DELOTET_QUALITY_MEASURES],
    /// The first tetrahedron with that value, or DELOTET_INVALID_INDEX if there are none.
    pub worst_tets: [u32; DELOTET_QUALITY_MEASURES],
    /// The number of tetrahedra in each bin of each measure (delotet_quality_bin_edges()).
    pub histograms: [[u64; DELOTET_QUALITY_BINS]; DELOTET_QUALITY_MEASURES],
    /// `worst` among the tetrahedra that are not input-forced.
    pub unforced_worst: [f64; DELOTET_QUALITY_MEASURES],
    /// `worst_tets` among the tetrahedra that are not input-forced.
    pub unforced_worst_tets: [u32; DELOTET_QUALITY_MEASURES],
    /// `histograms` of the tetrahedra that are not input-forced.
    pub unforced_histograms: [[u64; DELOTET_QUALITY_BINS]; DELOTET_QUALITY_MEASURES],
}

impl DelotetQualitySummary {
    fn new(summary: &QualitySummary) -> DelotetQualitySummary {
        DelotetQualitySummary {
            struct_size: size_of::<DelotetQualitySummary>(),
            tet_count: summary.tet_count,
            forced_count: summary.forced_count,
            worst: summary.all.worst,
            worst_tets: summary.all.worst_tet,
            histograms: summary.all.histograms,
            unforced_worst: summary.unforced.worst,
            unforced_worst_tets: summary.unforced.worst_tet,
            unforced_histograms: summary.unforced.histograms,
        }
    }

    /// Writes as many bytes as the caller's struct holds.
    ///
    /// # Safety
    /// `out` has a readable `struct_size` and as many writable bytes as that says.
    unsafe fn write(mut self, out: *mut DelotetQualitySummary) -> Result<(), Error> {
        // SAFETY: the caller promises that it is readable.
        let size = unsafe { (&raw const (*out).struct_size).read() }.min(self.struct_size);
        if size < size_of::<usize>() {
            return Err(invalid("summary->struct_size is not set"));
        }
        self.struct_size = size;
        // SAFETY: `size` bytes of both structs are valid, and they do not overlap.
        unsafe { std::ptr::copy_nonoverlapping((&raw const self).cast::<u8>(), out.cast::<u8>(), size) };
        Ok(())
    }
}

impl DelotetMesh {
    pub(super) fn forced_tets(&self) -> Result<&[ForcedTet], Error> {
        Ok(kept(&self.derived.forced_tets, || quality::forced_tets(&self.mesh))?)
    }

    fn quality_summary(&self) -> Result<&QualitySummary, Error> {
        let make = || Ok(QualitySummary::new(&self.mesh, self.forced_tets()?));
        kept(&self.derived.quality_summary, make)
    }
}

/// The measure with this number.
fn measure_of(number: DelotetQualityMeasure) -> Result<Measure, Error> {
    let message = format_args!("measure {number} is not a DELOTET_QUALITY_ constant");
    Measure::ALL.get(number as usize).copied().ok_or_else(|| invalid(message))
}

/// The measures of every tetrahedron, in the order of delotet_mesh_tets(): dihedral angles (6 doubles), radius-edge ratio, mean ratio,
/// volume. Computed on first use, in 72 bytes per tetrahedron; borrowed from `mesh`, valid until it is freed. The relative error of
/// a measure is below 1e-8 (usually 1e-14), also for the flattest tetrahedra; the bits are the same on all platforms and do not depend on
/// the order of points or corners. Nothing traps, whatever the size of the coordinates.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_quality(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetTetQualitiesView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            let list = kept(&mesh.derived.tet_qualities, || quality::tet_qualities(&mesh.mesh))?;
            set(out_view, DelotetTetQualitiesView::new(list), "out_view")
        })
    }
}

/// Worst values and histograms, of all tetrahedra and of those that are not input-forced. Set `summary->struct_size = sizeof *summary`
/// before the call. Computed on first use, without memory per tetrahedron.
/// Errors: INVALID_ARGUMENT (NULL, or a `struct_size` smaller than that field itself), OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_quality_summary(
    mesh: *const DelotetMesh,
    summary: *mut DelotetQualitySummary,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, a struct of which `struct_size` bytes may be written, and NULL or a valid
    // out-parameter.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            if summary.is_null() {
                return Err(null("summary"));
            }
            DelotetQualitySummary::new(mesh.quality_summary()?).write(summary)
        })
    }
}

/// The worst tetrahedra by a measure, the worst first; of equally bad ones the smaller index.
/// `measure`: a DELOTET_QUALITY_ constant. `unforced`: leave out those that are input-forced. `out_tets`: room for `count` indices; receives
/// DELOTET_INVALID_INDEX where there are no more tetrahedra.
/// Errors: INVALID_ARGUMENT, OUT_OF_MEMORY; then nothing was written.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_worst_tets(
    mesh: *const DelotetMesh,
    measure: DelotetQualityMeasure,
    unforced: bool,
    out_tets: *mut u32,
    count: usize,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, an array of this size, and NULL or a valid out-parameter.
    unsafe {
        guard(out_error, || {
            let mesh = get(mesh, "mesh")?;
            let (measure, tets) = (measure_of(measure)?, array_mut(out_tets, count, "out_tets")?);
            let without = if unforced { mesh.forced_tets()? } else { &[] };
            quality::worst_tets(&mesh.mesh, measure, without, tets).map(|_| ())
        })
    }
}

/// The input-forced tetrahedra, in ascending order, with the facets at fault. A tetrahedron is input-forced if it lies in a wedge
/// of less than DELOTET_QUALITY_FORCED_BELOW degrees: between two subfaces that meet at an edge of the mesh, among the tetrahedra that one
/// passes from one to the other around that edge without crossing a third. Their dihedral angles there add up to the angle of the
/// wedge, so every mesh of this input has an angle of at most that all along the edge. Computed on first use; borrowed from `mesh`, valid
/// until it is freed. Errors: INVALID_ARGUMENT, OUT_OF_MEMORY.
#[no_mangle]
#[must_use]
pub unsafe extern "C" fn delotet_mesh_forced_tets(
    mesh: *const DelotetMesh,
    out_view: *mut DelotetForcedTetsView,
    out_error: *mut *mut DelotetError,
) -> DelotetStatus {
    // SAFETY: the caller passes a mesh that is alive, and NULL or valid out-parameters.
    unsafe {
        guard(out_error, || {
            let list = get(mesh, "mesh")?.forced_tets()?;
            set(out_view, DelotetForcedTetsView::new(list), "out_view")
        })
    }
}

/// The bounds of the bins of a measure's histogram, ascending: DELOTET_QUALITY_BINS + 1 doubles. Bin i has the values from bound i
/// (inclusive) to bound i + 1 (exclusive), the last one all from bound DELOTET_QUALITY_BINS - 1 on. Static. Empty for other measures.
#[no_mangle]
pub extern "C" fn delotet_quality_bin_edges(measure: DelotetQualityMeasure) -> DelotetDoublesView {
    let edges = Measure::ALL.get(measure as usize).map_or(&[][..], |measure| measure.bin_edges());
    DelotetDoublesView::new(edges, 1)
}

/// The name of a bin of a measure's histogram in words, such as "10 to 15", "below 1" or "from 60"; "unknown" for other measures and bins.
/// Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_quality_bin_name(measure: DelotetQualityMeasure, bin: usize) -> *const c_char {
    let measure = Measure::ALL.get(measure as usize);
    measure.and_then(|measure| measure.bin_texts().get(bin)).map_or(c"unknown", |name| name).as_ptr()
}

static MEASURE_NAMES: &[(u32, &str)] = &[
    (0, "DELOTET_QUALITY_MIN_DIHEDRAL\0"),
    (1, "DELOTET_QUALITY_MAX_DIHEDRAL\0"),
    (2, "DELOTET_QUALITY_RADIUS_EDGE\0"),
    (3, "DELOTET_QUALITY_ETA\0"),
];

/// Name of a measure, such as "DELOTET_QUALITY_ETA"; "unknown" for other numbers. Static: never NULL, never freed.
#[no_mangle]
pub extern "C" fn delotet_quality_measure_name(measure: DelotetQualityMeasure) -> *const c_char {
    name_in(MEASURE_NAMES, measure)
}
