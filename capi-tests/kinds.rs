//! Some call returns each status, kind of defect, kind of warning and element in the header, for the smallest input found that produces
//! this kind and no other. The lists are those of the header: each addition there needs a row here.
#![allow(unsafe_code)]
use delotet::ffi::status::{DelotetDefectKind, DelotetStatus, DelotetWarningKind};
use delotet::ffi::{options as c_options, plc as c_plc};
use delotet::io::{self, Format};
use delotet::plc::check as check_plc;
use delotet::{
    check_mesh, controlled, tetrahedralize, DefectKind, Element, Error, Facet, Limits, Mode, Observer,
    Options, Phase, Plc, RegionSeed, Segment, Silent, Status, TetMesh, WarningKind, Warnings,
};
use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;
use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;
use std::ptr::null_mut;
use std::time::Duration;

thread_local! {
    /// Blocks of this size or more are refused in this thread.
    static REFUSED: Cell<usize> = const { Cell::new(usize::MAX) };
}

/// The system's allocator, which refuses large blocks if a test asks for it.
struct Sparing;

// SAFETY: all blocks are the system's; null is an allowed answer.
unsafe impl GlobalAlloc for Sparing {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        match layout.size() >= REFUSED.get() {
            true => null_mut(),
            // SAFETY: the caller's promise is the same.
            false => unsafe { System.alloc(layout) },
        }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the caller's promise is the same.
        unsafe { System.dealloc(block, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Sparing = Sparing;

/// The names and numbers of an enumeration of the header.
fn listed(prefix: &str) -> BTreeSet<u32> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("include/delotet/delotet.h");
    let header = std::fs::read_to_string(path).expect("the header");
    let numbers = header.lines().filter_map(|line| {
        let (name, number) = line.trim().strip_suffix(',')?.split_once(" = ")?;
        name.starts_with(prefix).then(|| number.parse().expect("a number"))
    });
    numbers.collect()
}

/// The corner of the unit cube with its four faces: the smallest body.
fn tetrahedron() -> Plc {
    Plc {
        points: vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.]],
        triangles: vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        ..Plc::default()
    }
}

/// Triangles on points in the plane z = 0.
fn flat(points: &[[f64; 2]], triangles: &[[u32; 3]]) -> Plc {
    let points = points.iter().map(|&[x, y]| [x, y, 0.]).collect();
    Plc { points, triangles: triangles.to_vec(), ..Plc::default() }
}

/// A triangle in the plane z = 0 and a line that pierces it.
fn pierced() -> Plc {
    let mut plc = flat(&[[0., 0.], [4., 0.], [0., 4.]], &[[0, 1, 2]]);
    plc.points.extend([[1., 1., -1.], [1., 1., 1.]]);
    plc
}

/// One facet of these rings on points in the plane z = 0.
fn rings(points: &[[f64; 2]], rings: &[&[u32]]) -> Plc {
    let polygons = rings.iter().map(|ring| ring.to_vec()).collect();
    Plc { facets: vec![Facet { polygons, ..Facet::default() }], ..flat(points, &[]) }
}

/// Schönhardt's polyhedron (1928), which needs Steiner points.
fn schoenhardt() -> Plc {
    Plc {
        points: vec![
            [10., 0., 0.],
            [-5., 9., 0.],
            [-5., -9., 0.],
            [9., 5., 10.],
            [-9., 5., 10.],
            [0., -10., 10.],
        ],
        triangles: vec![
            [0, 2, 1],
            [3, 4, 5],
            [0, 1, 4],
            [0, 4, 3],
            [1, 2, 5],
            [1, 5, 4],
            [2, 0, 3],
            [2, 3, 5],
        ],
        ..Plc::default()
    }
}

/// A twisted prism of a few units where doubles are the integers: its edges must be split, and there is no room for that.
fn crowded() -> Plc {
    let lattice = [[2, 0, 1], [3, 1, 1], [3, 2, 0], [3, 1, 0], [0, 0, 0], [1, 1, 1]];
    let points = lattice.map(|p: [u64; 3]| p.map(|x| ((1 << 52) + x) as f64)).to_vec();
    Plc { points, ..schoenhardt() }
}

/// Points above and below a triangle, so far that two tetrahedra are Delaunay.
fn bipyramid() -> Plc {
    let mut plc = flat(&[[0., 0.], [1., 0.], [0., 1.]], &[]);
    plc.points.extend([[0.3, 0.3, 2.], [0.3, 0.3, -2.]]);
    plc
}

/// Two triangles that cross.
fn crossing() -> Plc {
    let mut plc = pierced();
    plc.points.push([9., 9., 0.]);
    plc.triangles.push([3, 4, 5]);
    plc
}

fn segment(a: u32, b: u32) -> Segment {
    Segment { ends: [a, b], marker: 0 }
}

fn seed(point: [f64; 3], max_volume: Option<f64>) -> RegionSeed {
    RegionSeed { point, attribute: 1.0, max_volume }
}

fn mesh(plc: &Plc) -> Result<TetMesh, Error> {
    tetrahedralize(plc, &Options::default(), &mut Silent)
}

/// The mesh of a tetrahedron, or of the hull of some points, after a change to it and its input, as the check sees it.
fn checked(plc: Plc, change: impl Fn(&mut Plc, &mut TetMesh)) -> Result<(), Error> {
    let options = Options { keep_hull: plc.facet_count() < 4, ..Options::default() };
    let mut mesh = tetrahedralize(&plc, &options, &mut Silent)?;
    check_mesh(&plc, &mesh, true, 100)?;
    let mut plc = plc;
    change(&mut plc, &mut mesh);
    check_mesh(&plc, &mesh, true, 100)
}

struct DefectRow {
    kind: DefectKind,
    status: Status,
    run: fn() -> Result<(), Error>,
}

macro_rules! defect {
    ($kind:ident, $status:ident, $run:expr) => {
        DefectRow { kind: DefectKind::$kind, status: Status::$status, run: || $run }
    };
}

#[rustfmt::skip]
const DEFECTS: &[DefectRow] = &[
    defect!(NonFinite, NonFinitePoint, { let mut plc = tetrahedron(); plc.points[2][0] = f64::NAN; mesh(&plc).map(drop) }),
    defect!(CoordinateRange, CoordinateRange, { let mut plc = tetrahedron(); plc.points[3] = [1e300, 1e-300, 1.]; mesh(&plc).map(drop) }),
    defect!(IndexOutOfRange, IndexOutOfRange, { let mut plc = tetrahedron(); plc.triangles[1][1] = 4; mesh(&plc).map(drop) }),
    defect!(DegenerateSegment, DegenerateFacet, mesh(&Plc { segments: vec![segment(1, 1)], ..tetrahedron() }).map(drop)),
    defect!(DegenerateFacet, DegenerateFacet, mesh(&flat(&[[0., 0.], [1., 0.], [2., 0.]], &[[0, 1, 2]])).map(drop)),
    defect!(RingIntersection, SelfIntersection, mesh(&rings(&[[0., 0.], [4., 0.], [4., 4.], [0., 4.]], &[&[0, 2, 1, 3]])).map(drop)),
    defect!(RingNesting, DegenerateFacet,
        mesh(&rings(&[[0., 0.], [1., 0.], [0., 1.], [5., 0.], [6., 0.], [5., 1.]], &[&[0, 1, 2], &[3, 4, 5]])).map(drop)),
    // A corkscrew.
    defect!(NonPlanarFacet, NonPlanarFacet, {
        let mut plc = rings(&[], &[&[0, 1, 2, 3, 4, 5]]);
        plc.points = vec![[0., 0., 0.], [4., 1., 9.], [4., 4., 1.], [-3., 1., 6.], [2., -3., 2.], [1., 5., 4.]];
        mesh(&plc).map(drop)
    }),
    defect!(DuplicateFacet, SelfIntersection, mesh(&flat(&[[0., 0.], [1., 0.], [0., 1.]], &[[0, 1, 2], [1, 0, 2]])).map(drop)),
    defect!(SegmentSegment, SelfIntersection, {
        let mut plc = flat(&[[0., 0.], [2., 2.], [2., 0.], [0., 2.]], &[]);
        plc.segments = vec![segment(0, 1), segment(2, 3)];
        mesh(&plc).map(drop)
    }),
    defect!(SegmentFacet, SelfIntersection, mesh(&Plc { segments: vec![segment(3, 4)], ..pierced() }).map(drop)),
    defect!(FacetFacet, SelfIntersection, mesh(&crossing()).map(drop)),
    defect!(Overlap, SelfIntersection, mesh(&flat(&[[0., 0.], [4., 0.], [0., 4.], [3., 3.]], &[[0, 1, 2], [0, 1, 3]])).map(drop)),
    defect!(SeedOnFacet, SeedOutside, mesh(&Plc { holes: vec![[0.25, 0.25, 0.]], ..tetrahedron() }).map(drop)),
    defect!(SeedOutside, SeedOutside, mesh(&Plc { regions: vec![seed([2.; 3], None)], ..tetrahedron() }).map(drop)),
    defect!(OpenEdge, NothingEnclosed, { let mut plc = tetrahedron(); plc.triangles.pop(); mesh(&plc).map(drop) }),
    defect!(Rounding, Rounding, mesh(&crowded()).map(drop)),
    defect!(NotPositive, CheckFailed, checked(tetrahedron(), |plc, mesh| {
        for points in [&mut plc.points, &mut mesh.points] {
            points[3][2] = -1.;
        }
    })),
    defect!(NotConforming, CheckFailed, checked(tetrahedron(), |_, mesh| mesh.neighbors[0][0] = 0)),
    defect!(PointMoved, CheckFailed, checked(tetrahedron(), |_, mesh| mesh.points[3][2] = 2.)),
    defect!(SegmentMissing, CheckFailed, checked(Plc { segments: vec![segment(0, 1)], ..tetrahedron() }, |_, mesh| {
        mesh.subsegments.retain(|s| s.segment != 0);
    })),
    // Across the common face of the two tetrahedra.
    defect!(FacetMissing, CheckFailed, checked(Plc { triangles: vec![[0, 1, 2]], ..bipyramid() }, |plc, _| plc.triangles.push([0, 3, 4]))),
    defect!(NotDelaunay, CheckFailed, checked(bipyramid(), |plc, mesh| {
        for points in [&mut plc.points, &mut mesh.points] {
            (points[3][2], points[4][2]) = (0.1, -0.1);
        }
    })),
    defect!(HullOffFacets, CheckFailed, checked(tetrahedron(), |plc, mesh| {
        let facet = plc.triangles.len() as u32 - 1;
        plc.triangles.pop();
        mesh.subfaces.retain(|s| s.facet != facet);
    })),
];

#[test]
fn every_kind_of_defect_is_produced() {
    let mut produced = BTreeSet::new();
    let mut elements = BTreeSet::new();
    for row in DEFECTS {
        let error = (row.run)().expect_err(row.kind.name());
        assert_eq!(error.status, row.status, "{}: {error}", row.kind.name());
        let kinds: BTreeSet<_> = error.defects.iter().map(|d| d.kind).collect();
        assert_eq!(kinds, BTreeSet::from([row.kind]), "{error}");
        produced.insert(DelotetDefectKind::from(row.kind) as u32);
        elements.extend(error.defects.iter().flat_map(|d| [Some(d.first), d.second]).map(number));
    }
    assert_eq!(produced, listed("DELOTET_DEFECT_KIND_"));
    assert_eq!(elements, listed("DELOTET_ELEMENT_"));
}

/// As in the header.
fn number(element: Option<Element>) -> u32 {
    match element {
        None => 0,
        Some(Element::Point(_)) => 1,
        Some(Element::Segment(_)) => 2,
        Some(Element::Facet(_)) => 3,
        Some(Element::Hole(_)) => 4,
        Some(Element::Region(_)) => 5,
        Some(Element::Tet(_)) => 6,
    }
}

struct Stop;

impl Observer for Stop {
    fn progress(&mut self, _: Phase, _: f64) -> ControlFlow<()> {
        ControlFlow::Break(())
    }
}

fn status<T>(result: Result<T, Error>) -> DelotetStatus {
    result.map_or_else(|error| error.status.into(), |_| DelotetStatus::Ok)
}

/// An array of this many zero bytes that takes no memory; `call` may read a few of them.
#[cfg(unix)]
fn with_zeros<T>(bytes: usize, call: impl FnOnce(*const u32) -> T) -> T {
    let flags = libc::MAP_PRIVATE | libc::MAP_ANONYMOUS | libc::MAP_NORESERVE;
    // SAFETY: a new mapping, at a place of the system's choice, which is taken away after its last use.
    unsafe {
        let zeros = libc::mmap(null_mut(), bytes, libc::PROT_READ, flags, -1, 0);
        assert!(zeros != libc::MAP_FAILED, "no {bytes} bytes of address space");
        let result = call(zeros.cast());
        assert_eq!(libc::munmap(zeros, bytes), 0);
        result
    }
}

struct StatusRow {
    status: DelotetStatus,
    run: fn() -> DelotetStatus,
}

/// The statuses without a list of defects.
#[rustfmt::skip]
const STATUSES: &[StatusRow] = &[
    StatusRow { status: DelotetStatus::Ok, run: || status(mesh(&tetrahedron())) },
    StatusRow { status: DelotetStatus::InvalidArgument, run: || {
        // SAFETY: a handle that is freed after its last use.
        unsafe {
            let options = c_options::delotet_options_new();
            let status = c_options::delotet_options_set_mode(options, 99, null_mut());
            c_options::delotet_options_free(options);
            status
        }
    } },
    StatusRow { status: DelotetStatus::Unsupported, run: || status(io::read(Path::new("body.xyz"))) },
    StatusRow { status: DelotetStatus::DegenerateInput, run: || {
        let options = Options { mode: Mode::Delaunay, ..Options::default() };
        status(tetrahedralize(&flat(&[[0., 0.], [1., 0.], [0., 1.], [1., 1.]], &[]), &options, &mut Silent))
    } },
    StatusRow { status: DelotetStatus::Cancelled, run: || status(tetrahedralize(&tetrahedron(), &Options::default(), &mut Stop)) },
    StatusRow { status: DelotetStatus::SteinerLimit, run: || {
        let options = Options { steiner_limit: Some(0), ..Options::default() };
        status(tetrahedralize(&schoenhardt(), &options, &mut Silent))
    } },
    StatusRow { status: DelotetStatus::TimeLimit, run: || {
        let options = Options { time_limit: Some(Duration::from_nanos(1)), ..Options::default() };
        status(tetrahedralize(&tetrahedron(), &options, &mut Silent))
    } },
    StatusRow { status: DelotetStatus::MemoryLimit, run: || {
        let limits = Limits { memory: Some(1 << 20), ..Limits::default() };
        status(controlled(limits, &mut Silent, |control| control.room(1 << 30)))
    } },
    StatusRow { status: DelotetStatus::TetrahedraLimit, run: || {
        let options = Options { tetrahedra_limit: Some(0), ..Options::default() };
        status(tetrahedralize(&tetrahedron(), &options, &mut Silent))
    } },
    StatusRow { status: DelotetStatus::OutOfMemory, run: || {
        let file = "OFF 2000 0 0\n".to_string() + &"0 0 0\n".repeat(2000);
        REFUSED.set(16 << 10);
        let result = io::read_bytes(file.as_bytes(), Format::Off);
        REFUSED.set(usize::MAX);
        status(result)
    } },
    #[cfg(unix)]
    StatusRow { status: DelotetStatus::TooLarge, run: || with_zeros((8 << 32) - 8, |ends| {
        // SAFETY: the array has two indices per segment; a handle that is freed after its last use.
        unsafe {
            let mut plc = null_mut();
            assert_eq!(c_plc::delotet_plc_new([0.0f64; 3].as_ptr(), 1, &mut plc, null_mut()), DelotetStatus::Ok);
            let status = c_plc::delotet_plc_add_segments(plc, ends, std::ptr::null(), (1 << 32) - 1, null_mut());
            c_plc::delotet_plc_free(plc);
            status
        }
    }) },
    StatusRow { status: DelotetStatus::File, run: || status(io::read(Path::new("no such file.off"))) },
    // The result of input wrongly promised to be valid; a panic gives it too (tested with the guard).
    StatusRow { status: DelotetStatus::Internal, run: || {
        let options = Options { validate: false, ..Options::default() };
        let mut plc = tetrahedron();
        plc.points.extend([[0.1, 0.1, -1.], [0.1, 0.1, 1.], [5., 5., 5.]]);
        plc.triangles.push([4, 5, 6]);
        status(tetrahedralize(&plc, &options, &mut Silent))
    } },
    StatusRow { status: DelotetStatus::Format, run: || status(io::read_bytes(b"OFF 1 0 0\n0 zero 0\n", Format::Off)) },
];

#[test]
fn every_status_is_produced() {
    let mut produced: BTreeSet<u32> =
        DEFECTS.iter().map(|row| DelotetStatus::from(row.status) as u32).collect();
    for row in STATUSES {
        assert_eq!((row.run)(), row.status);
        assert!(produced.insert(row.status as u32), "{:?} is there twice", row.status);
    }
    let listed = listed("DELOTET_STATUS_");
    assert!(produced.is_subset(&listed));
    let mut rest: Vec<u32> = listed.difference(&produced).copied().collect();
    if cfg!(not(unix)) {
        rest.retain(|&status| status != DelotetStatus::TooLarge as u32);
    }
    assert_eq!(rest, []);
}

struct WarningRow {
    kind: WarningKind,
    run: fn() -> Result<Warnings, Error>,
}

/// The warnings of meshing a tetrahedron after a change.
fn warned(change: impl Fn(&mut Plc)) -> Result<Warnings, Error> {
    let mut plc = tetrahedron();
    change(&mut plc);
    mesh(&plc).map(|mesh| mesh.warnings)
}

#[rustfmt::skip]
const WARNINGS: &[WarningRow] = &[
    WarningRow { kind: WarningKind::OpenEdge, run: || {
        let mut plc = tetrahedron();
        plc.triangles.pop();
        check_plc(&plc, &Options { keep_hull: true, ..Options::default() }, &mut Silent)
    } },
    // A pit in the largest face, with a lid that a hole opens again.
    WarningRow { kind: WarningKind::UnmeshedFacet, run: || warned(|plc| {
        plc.points.push([0.25; 3]);
        plc.triangles.extend([[1, 2, 4], [2, 3, 4], [3, 1, 4]]);
        plc.holes = vec![[0.3; 3]];
    }) },
    WarningRow { kind: WarningKind::UnmeshedSegment, run: || warned(|plc| {
        let other = tetrahedron();
        plc.points.extend(other.points.iter().map(|p| p.map(|x| x + 2.)));
        plc.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + 4)));
        plc.segments = vec![segment(3, 4)];
    }) },
    WarningRow { kind: WarningKind::UnmeshedPoint, run: || warned(|plc| plc.points.push([2.; 3])) },
    WarningRow { kind: WarningKind::EqualPoints, run: || warned(|plc| plc.points.push(plc.points[1])) },
    WarningRow { kind: WarningKind::RepeatedSeed, run: || warned(|plc| plc.regions = vec![seed([0.1; 3], None), seed([0.2; 3], None)]) },
    WarningRow { kind: WarningKind::HoleOutside, run: || warned(|plc| plc.holes = vec![[2.; 3]]) },
    WarningRow { kind: WarningKind::UnusedVolume, run: || warned(|plc| plc.regions = vec![seed([0.1; 3], Some(0.01))]) },
    // The base is a kite with one corner below it.
    WarningRow { kind: WarningKind::NonPlanarFacet, run: || warned(|plc| {
        plc.points.push([1., 1., -0.25]);
        plc.triangles = vec![[0, 1, 3], [0, 3, 2], [1, 4, 3], [4, 2, 3]];
        plc.facets = vec![Facet { polygons: vec![vec![0, 2, 4, 1]], ..Facet::default() }];
    }) },
    WarningRow { kind: WarningKind::LostValue, run: || {
        // The tests of the other profile may run at the same time.
        let name = if cfg!(debug_assertions) { "kinds-debug.off" } else { "kinds-release.off" };
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
        io::write_surface(&path, &Plc { point_markers: vec![7, 0, 0, 0], ..tetrahedron() })
    } },
];

#[test]
fn every_kind_of_warning_is_produced() {
    let mut produced = BTreeSet::new();
    for row in WARNINGS {
        let warnings = (row.run)().unwrap_or_else(|error| panic!("{}: {error}", row.kind.name()));
        let kinds: BTreeSet<_> = warnings.list().iter().map(|w| w.kind).collect();
        assert_eq!(kinds, BTreeSet::from([row.kind]), "{}", row.kind.name());
        produced.insert(DelotetWarningKind::from(row.kind) as u32);
    }
    assert_eq!(produced, listed("DELOTET_WARNING_KIND_"));
}

/// A mesh may be the result of several attempts: with facets merged and without, with fewer points here or there. What is said of seeds
/// is said of the mesh that is returned, once.
#[test]
fn seeds_are_warned_of_once_however_many_attempts_there_are() {
    let bracket = Path::new(env!("CARGO_MANIFEST_DIR")).join("capi-tests/data/bracket.off");
    let mut bracket = io::read(&bracket).unwrap();
    let mut schoenhardt = schoenhardt();
    for plc in [&mut bracket, &mut schoenhardt] {
        plc.holes.push([1e6, 1e6, 1e6]);
    }
    let preserve = Options { mode: Mode::Preserve, ..Options::default() };
    let limited = Options { keep_hull: true, steiner_limit: Some(10), ..preserve.clone() };
    assert_eq!(
        tetrahedralize(&bracket, &limited, &mut Silent).unwrap_err().status,
        Status::SteinerLimit,
        "the mesh below is the merged one"
    );
    for (plc, options) in [
        (&bracket, Options { merge_facets: Some(100.0), ..limited }),
        (&schoenhardt, Options { merge_facets: Some(150.0), ..preserve.clone() }),
        (&schoenhardt, Options { merge_facets: Some(150.0), ..Options::default() }),
        (&schoenhardt, preserve),
    ] {
        let mesh = tetrahedralize(plc, &options, &mut Silent).unwrap();
        let warned: Vec<_> = mesh.warnings.of(WarningKind::HoleOutside).map(|w| w.first).collect();
        assert_eq!((&warned[..], mesh.warnings.total()), (&[Element::Hole(0)][..], 1), "{options:?}");
    }
}
