//! The settings of a run and of a writer, with their defaults.
use crate::control::{CancelToken, Limits};
use crate::error::{Error, Status};
use crate::fallible;
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

/// What is made from the input.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Mode {
    /// The Delaunay tetrahedralization of the points; segments and facets are ignored.
    Delaunay,
    /// The constrained Delaunay tetrahedralization: segments and facets are unions of edges and faces, with Steiner points
    /// on segments only, unless sizes or shapes ask for more points ([`Options::size`]).
    #[default]
    Constrained,
    /// A tetrahedralization that keeps the surface as it is: every triangle is a face, every segment and every edge of a polygon is an
    /// edge, and no point is added on them; a polygon may get any diagonals. Points are added only inside, as few as possible.
    Preserve,
}

/// What [`Mode::Preserve`] keeps.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Preserve {
    /// Every facet and segment.
    #[default]
    All,
    /// The outer boundary: facets with the mesh on one side, and the segments on them. Other facets and segments (interfaces between
    /// regions, dangling ones) are unions of faces and edges, with Steiner points on segments where keeping them would take points inside.
    Outer,
}

/// A function that gives the edge length wanted at a point (x, y, z): positive; infinite where it has no wish. What it returns as an error
/// ends the run with that error; NaN, zero and negative lengths end it with
/// [`Status::InvalidArgument`]. It is called on the thread that called for the mesh, in the same order in
/// every run, once or more for a point.
pub struct SizeFunction(Kept);

/// What a [`SizeFunction`] calls.
type Wanted = dyn Fn([f64; 3]) -> Result<f64, Error> + Send + Sync;

/// How a [`SizeFunction`] has its function.
enum Kept {
    Shared(Arc<Wanted>),
    /// For the C API: an `Arc` would abort the process if memory ran out.
    Borrowed(&'static Wanted),
}

impl SizeFunction {
    /// Wraps a function.
    #[expect(clippy::disallowed_methods, reason = "for callers; the library itself never calls it")]
    pub fn new(function: impl Fn([f64; 3]) -> Result<f64, Error> + Send + Sync + 'static) -> SizeFunction {
        SizeFunction(Kept::Shared(Arc::new(function)))
    }

    /// A function that somebody else keeps.
    pub(crate) fn borrowed(function: &'static Wanted) -> SizeFunction {
        SizeFunction(Kept::Borrowed(function))
    }

    /// The same function.
    #[expect(clippy::disallowed_methods, reason = "a count goes up, nothing is allocated")]
    pub(crate) fn shared(&self) -> SizeFunction {
        SizeFunction(match &self.0 {
            Kept::Shared(function) => Kept::Shared(Arc::clone(function)),
            Kept::Borrowed(function) => Kept::Borrowed(*function),
        })
    }

    fn get(&self) -> &Wanted {
        match &self.0 {
            Kept::Shared(function) => &**function,
            Kept::Borrowed(function) => function,
        }
    }

    /// The length wanted at a point.
    ///
    /// # Errors
    /// What the function returns, and `InvalidArgument` for what is no length.
    pub fn at(&self, point: [f64; 3]) -> Result<f64, Error> {
        let length = self.get()(point)?;
        if length > 0.0 {
            return Ok(length);
        }
        let [x, y, z] = point;
        Err(Error::new(
            Status::InvalidArgument,
            format_args!("the size function gives {length} at ({x}, {y}, {z}): a positive length is needed"),
        ))
    }
}

impl Clone for SizeFunction {
    fn clone(&self) -> SizeFunction {
        self.shared()
    }
}

/// Equal if it is the same function object.
impl PartialEq for SizeFunction {
    fn eq(&self, other: &SizeFunction) -> bool {
        std::ptr::addr_eq(self.get(), other.get())
    }
}

impl fmt::Debug for SizeFunction {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("SizeFunction")
    }
}

/// The bounds of what may be asked for, and what counts if nothing is.
impl Options {
    /// The least circumradius over shortest edge that may be asked for ([`Options::quality`]).
    pub const LEAST_RATIO: f64 = 1.0;
    /// The circumradius over shortest edge that is good enough unless another one is asked for.
    pub const USUAL_RATIO: f64 = 2.0;
    /// The largest angle that may be asked for ([`Options::min_angle`]), in degrees: a regular tetrahedron has 70.5, but they do not fill
    /// space.
    pub const LARGEST_MIN_ANGLE: f64 = 60.0;
}

/// Settings of a run. `Options::default()` has the defaults that the field docs give.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq)]
pub struct Options {
    /// What is made. Default: [`Mode::Constrained`].
    pub mode: Mode,
    /// What [`Mode::Preserve`] keeps; other modes ignore it. Default: [`Preserve::All`].
    pub preserve: Preserve,
    /// Keep every tetrahedron of the convex hull, holes and outside included (holes given by seeds are still carved). Default: false.
    pub keep_hull: bool,
    /// Treat facets with equal markers that meet at more than this angle (degrees, 90 to 180) as one smooth patch, and flip its triangles
    /// to be Delaunay on the surface before meshing. Default: None (off).
    pub merge_facets: Option<f64>,
    /// Look for self-intersections and all other defects before meshing. Default: true. Without it an invalid PLC may cause
    /// [`Status::Internal`].
    pub validate: bool,
    /// How many defects an error lists at most, and how many warnings of each kind a mesh lists. Default: 1000.
    pub max_defects: usize,
    /// The number of worker threads; 0: one per processor available to the process. The mesh is the same for any number. Default: 1.
    pub threads: usize,
    /// Fail with [`Status::SteinerLimit`] if the mesh needs more Steiner points than this; those that
    /// [`Mode::Preserve`] removes again count where it starts from the constrained Delaunay tetrahedralization. Default: None, which means
    /// 100,000 plus 100 per segment, many times what any model has needed; points of filling count only against a limit that is given.
    pub steiner_limit: Option<u64>,
    /// Fail with [`Status::TetrahedraLimit`] once the mesh has more tetrahedra than this: while it is filled, refined or optimised, or in the
    /// end. Default: None (no limit).
    pub tetrahedra_limit: Option<u64>,
    /// Fail with [`Status::TimeLimit`] after this time, counted from the call. Default: None (no limit).
    pub time_limit: Option<Duration>,
    /// Fail with [`Status::MemoryLimit`] before the resident memory of the process has grown by more than this
    /// many bytes since the call. Concurrent runs and the host's other threads count, since only the whole process is measured. What
    /// is taken between two readings may exceed it. Linux only: other systems count only the large tables of the engine. Default: None (no limit).
    pub memory_limit: Option<u64>,
    /// Fail with [`Status::Cancelled`] once this token is cancelled. Default: None.
    pub cancel: Option<CancelToken>,
    /// Return the mesh even if some Steiner points have no valid position in doubles, instead of failing with
    /// [`Status::Rounding`]. [`TetMesh::crowded`](crate::TetMesh::crowded) lists these points; tetrahedra at them
    /// may be flat or inverted in doubles; [`TetMesh::steiner`](crate::TetMesh::steiner) gives the exact mesh. Default: false.
    pub exact_form: bool,
    /// Leave out points that belong to no tetrahedron: those that equal an earlier one, and those around which everything was carved. Input
    /// points then have other indices in the mesh; [`TetMesh::dropped`](crate::TetMesh::dropped) maps them. Unmeshed subfaces and
    /// subsegments are not listed, since their points are dropped; warnings about them remain. Default: false.
    pub drop_unmeshed_points: bool,
    /// The largest edge length wanted anywhere: the mesh is filled with points. With [`Mode::Constrained`] they come on segments, on facets
    /// and inside, with [`Mode::Preserve`] only inside; [`Mode::Delaunay`] refuses this and what follows. The smallest of all sizes counts:
    /// this one, those of the input ([`Plc::sizes`](crate::Plc::sizes)), [`Options::size_function`], the lengths of the surface, and what
    /// follows from them by [`Options::gradation`]. Positive and finite. Default: None.
    pub size: Option<f64>,
    /// The largest volume of a tetrahedron: none is above it where the surface allows it (with [`Mode::Preserve`], but for some over
    /// triangles of the kept surface that are too large for it). Bounds of regions
    /// ([`RegionSeed::max_volume`](crate::RegionSeed::max_volume)) count beside it once the mesh is filled. Positive and finite. Default: None.
    pub max_volume: Option<f64>,
    /// How fast sizes may grow: by at most this times the distance. More than 0, at most 1. Default: 0.3.
    pub gradation: f64,
    /// The edge length wanted at a point, asked for wherever one may come. Default: None.
    pub size_function: Option<SizeFunction>,
    /// Fill the mesh with points until no tetrahedron's circumradius is more than this many of its shortest edge, where the surface allows
    /// it; without other sizes those of the surface count, and grow inwards. The number of points is bounded: at small angles, in needles
    /// and in thin plates tetrahedra stay bad. At least 1; below about 1.2 many more points come, and some tetrahedra get worse. Default: None (off).
    pub quality: Option<f64>,
    /// The effort to optimise the smallest dihedral angles: 0 none, 1 as much as pays, larger numbers take longer and find more. With
    /// [`Mode::Constrained`] the mesh is then conforming, no longer Delaunay ([`Guarantee::Conforming`](crate::Guarantee::Conforming));
    /// refused there together with [`Options::exact_form`]. Default: 0.
    pub optimize: u32,
    /// Optimise for so many seconds instead, as with the largest effort: until nothing is gained any more, or the time is over. What the mesh is
    /// then is the result, which so depends on the machine and its load. They count from the beginning of the optimisation, and are no limit:
    /// [`Options::time_limit`] ends the run. Positive and finite. Default: None (the effort counts).
    pub optimize_seconds: Option<f64>,
    /// The smallest dihedral angle that is wanted, in degrees: what is below it after the optimisation, or above 180 less it, is worked on
    /// further; if it is not reached, larger efforts of up to 3 are tried from the start, and the best counts. Angles of the input bound what can be reached. Above 0, at most 60. Default: None.
    pub min_angle: Option<f64>,
    /// The points are already in a spatially coherent order: skip sorting. Default: false.
    pub points_sorted: bool,
}

impl Options {
    /// A copy: no setting owns memory but the token and the function, which are shared.
    pub(crate) fn copied(&self) -> Options {
        Options {
            cancel: self.cancel.as_ref().map(CancelToken::shared),
            size_function: self.size_function.as_ref().map(SizeFunction::shared),
            ..*self
        }
    }

    /// What ends a run.
    pub fn limits(&self) -> Limits<'_> {
        Limits {
            cancel: self.cancel.as_ref().map(CancelToken::flag),
            time: self.time_limit,
            memory: self.memory_limit,
            steiner: self.steiner_limit,
            tetrahedra: self.tetrahedra_limit,
        }
    }

    /// The number of worker threads of a run: [`Options::threads`], or the number of processors if that is 0.
    pub fn worker_threads(&self) -> usize {
        match self.threads {
            0 => std::thread::available_parallelism().map_or(1, std::num::NonZeroUsize::get),
            threads => threads,
        }
    }
}

impl Default for Options {
    fn default() -> Self {
        Options {
            mode: Mode::Constrained,
            preserve: Preserve::All,
            keep_hull: false,
            merge_facets: None,
            validate: true,
            max_defects: 1000,
            threads: 1,
            steiner_limit: None,
            tetrahedra_limit: None,
            time_limit: None,
            memory_limit: None,
            cancel: None,
            exact_form: false,
            drop_unmeshed_points: false,
            size: None,
            max_volume: None,
            gradation: 0.3,
            size_function: None,
            quality: None,
            optimize: 0,
            optimize_seconds: None,
            min_angle: None,
            points_sorted: false,
        }
    }
}

/// A version of Gmsh's format.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum MshVersion {
    /// Version 4.1, that of Gmsh 4.
    #[default]
    V41,
    /// Version 2.2, which many solvers read; some read no other.
    V22,
}

/// The name of the regions with an attribute.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq)]
pub struct RegionName {
    /// The attribute.
    pub attribute: f64,
    /// The name: one line.
    pub name: String,
}

/// How a mesh is written. `WriteOptions::default()` has the defaults that the field docs give.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, PartialEq)]
pub struct WriteOptions {
    /// `.vtu`: compress the arrays with zlib, which makes smaller files more slowly. Default: false.
    pub compress: bool,
    /// `.vtu`: also write the subfaces, to `STEM_subfaces.vtu`. Other formats always contain them, except `.vtk`, which never does.
    /// Default: false.
    pub subfaces: bool,
    /// `.vtu`: also write the quality of each tetrahedron: arrays `max_dihedral`, `radius_edge`, `eta` and `volume` beside `min_dihedral`
    /// ([`TetQuality`](crate::query::TetQuality)). Other formats have no room for it. Default: false.
    pub quality_data: bool,
    /// Write tetrahedra of ten nodes: the corners, then the midpoints of the edges in the order of the format. All formats but `.mesh`.
    /// Default: false.
    pub second_order: bool,
    /// `.msh`: the version. Default: 4.1.
    pub msh_version: MshVersion,
    /// `.msh`, `.inp`: names of regions, by attribute. Default: none.
    pub region_names: Vec<RegionName>,
    /// How many warnings of each kind are listed at most. Default: 1000.
    pub max_warnings: usize,
}

impl Default for WriteOptions {
    fn default() -> Self {
        WriteOptions {
            compress: false,
            subfaces: false,
            quality_data: false,
            second_order: false,
            msh_version: MshVersion::V41,
            region_names: Vec::new(),
            max_warnings: 1000,
        }
    }
}

impl WriteOptions {
    /// Names the regions with an attribute.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn set_region_name(&mut self, attribute: f64, name: &str) -> Result<(), Error> {
        let kept = fallible::copied_text(name)?;
        match self.region_names.iter_mut().find(|n| n.attribute == attribute) {
            Some(known) => known.name = kept,
            None => fallible::push(&mut self.region_names, RegionName { attribute, name: kept })?,
        }
        Ok(())
    }
}
