//! Random piecewise linear complexes on small integer grids, where degenerate cases are the norm: each valid one is meshed, and
//! the mesh passes the exact checker. Reduced failures belong into a table of named regression cases, not here.
use delotet::{
    check_guarantee, check_mesh, check_preserved, check_preserved_outer, tetrahedralize, Error, Facet, Mode,
    Options, Plc, Preserve, Segment, Silent, Status, TetMesh,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

/// Whether an error is legitimate: not every random complex is valid or encloses something.
fn refused(error: &Error) -> bool {
    matches!(
        error.status,
        Status::SelfIntersection
            | Status::DegenerateFacet
            | Status::DegenerateInput
            | Status::NonPlanarFacet
            | Status::NothingEnclosed
            | Status::Rounding
    )
}

/// Meshes; the result (if any) must pass the check, and a second run must give the same.
fn mesh(plc: &Plc, keep_hull: bool) -> Result<Option<TetMesh>, TestCaseError> {
    let options = Options { keep_hull, steiner_limit: Some(5000), ..Options::default() };
    let mesh = match tetrahedralize(plc, &options, &mut Silent) {
        Ok(mesh) => mesh,
        Err(error) if refused(&error) => return Ok(None),
        Err(error) => return Err(TestCaseError::fail(format!("{error}: {:?}\n{plc:?}", error.defects))),
    };
    if let Err(error) = check_mesh(plc, &mesh, true, 10) {
        return Err(TestCaseError::fail(format!("{error}: {:?}\n{plc:?}", error.defects)));
    }
    refined(plc, &options, &mesh)?;
    preserve(plc, &options, &mesh)?;
    Ok(Some(mesh))
}

/// An input with a constrained mesh also has one that keeps the surface; it passes its own check and has the same regions.
fn preserve(plc: &Plc, options: &Options, constrained: &TetMesh) -> Result<(), TestCaseError> {
    let options = Options { mode: Mode::Preserve, ..options.clone() };
    let kept = match tetrahedralize(plc, &options, &mut Silent) {
        Ok(kept) => kept,
        // Points inside may be too crowded for doubles.
        Err(error) if error.status == Status::Rounding => return Ok(()),
        Err(error) => {
            return Err(TestCaseError::fail(format!("preserve: {error}: {:?}\n{plc:?}", error.defects)))
        }
    };
    if let Err(error) = check_preserved(plc, &kept, 10) {
        return Err(TestCaseError::fail(format!("preserve: {error}: {:?}\n{plc:?}", error.defects)));
    }
    prop_assert_eq!(kept.regions.len(), constrained.regions.len());
    filled(plc, &options, &kept)?;
    let options = Options { preserve: Preserve::Outer, ..options };
    match tetrahedralize(plc, &options, &mut Silent) {
        Ok(outer) => {
            if let Err(error) = check_preserved_outer(plc, &outer, 10) {
                return Err(TestCaseError::fail(format!("outer: {error}: {:?}\n{plc:?}", error.defects)));
            }
            prop_assert_eq!(outer.regions.len(), constrained.regions.len());
            let on_facets = outer.steiner.iter().filter(|s| !s.is_inside()).count() as u64;
            prop_assert_eq!(on_facets, outer.statistics.preserve.on_internal_facets);
        }
        Err(error) if error.status == Status::Rounding => {}
        Err(error) => {
            return Err(TestCaseError::fail(format!("outer: {error}: {:?}\n{plc:?}", error.defects)))
        }
    }
    Ok(())
}

/// The constrained mesh refined by sizes and shapes: still constrained Delaunay before it is optimised, with the same regions.
fn refined(plc: &Plc, options: &Options, constrained: &TetMesh) -> Result<(), TestCaseError> {
    // The large ones take most of the time: a search takes them too.
    if constrained.tets.len() > 200 && std::env::var_os("PROPTEST_CASES").is_none() {
        return Ok(());
    }
    let size = constrained.points.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs())) / 4.0;
    for (quality, size, optimize) in [(Some(1.5), None, 0), (Some(2.0), Some(size), 1)] {
        let asked =
            Options { quality, size, optimize, gradation: 1.0, steiner_limit: None, ..options.clone() };
        let fail = |error: Error| {
            TestCaseError::fail(format!("refined: {error}: {:?}\n{asked:?}\n{plc:?}", error.defects))
        };
        let refined = tetrahedralize(plc, &asked, &mut Silent).map_err(fail)?;
        check_guarantee(plc, &refined, 10).map_err(fail)?;
        prop_assert_eq!(refined.regions.len(), constrained.regions.len());
    }
    Ok(())
}

/// The same filled with points and optimised: still the surface, the regions and their volumes, whatever is asked for.
fn filled(plc: &Plc, options: &Options, kept: &TetMesh) -> Result<(), TestCaseError> {
    let size = kept.points.iter().flatten().fold(0.0, |most: f64, x| most.max(x.abs())) / 4.0;
    for (quality, size, max_volume) in
        [(Some(2.0), None, None), (None, Some(size), Some(size * size * size / 8.0))]
    {
        let asked = Options { quality, size, max_volume, optimize: 1, ..options.clone() };
        let filled = match tetrahedralize(plc, &asked, &mut Silent) {
            Ok(filled) => filled,
            Err(error) => {
                return Err(TestCaseError::fail(format!(
                    "filled: {error}: {:?}\n{asked:?}\n{plc:?}",
                    error.defects
                )))
            }
        };
        if let Err(error) = check_preserved(plc, &filled, 10) {
            return Err(TestCaseError::fail(format!(
                "filled: {error}: {:?}\n{asked:?}\n{plc:?}",
                error.defects
            )));
        }
        prop_assert_eq!(filled.regions.len(), kept.regions.len());
        let of = |mesh: &TetMesh, region: u32| -> f64 {
            let tets = mesh.tets.iter().zip(&mesh.tet_region).filter(|x| *x.1 == region);
            tets.map(|x| volume6_of(mesh, x.0)).sum()
        };
        for region in 0..kept.regions.len() as u32 {
            let (before, after) = (of(kept, region), of(&filled, region));
            prop_assert!((before - after).abs() <= 1e-9 * before, "{} {}", before, after);
        }
    }
    Ok(())
}

/// Like [`mesh`] for inputs that are valid by construction: an error is a failure.
fn mesh_valid(plc: &Plc, keep_hull: bool) -> Result<TetMesh, TestCaseError> {
    match mesh(plc, keep_hull)? {
        Some(mesh) => Ok(mesh),
        None => Err(TestCaseError::fail(format!("a valid complex was refused\n{plc:?}"))),
    }
}

/// The same 14 cases each, in debug builds the first 6 of them; others, and more, by the environment variable `PROPTEST_CASES`.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    let search = std::env::var_os("PROPTEST_CASES").is_some();
    let few = if cfg!(debug_assertions) { 6 } else { 14 };
    let (cases, rng_seed) = if search { (default.cases, default.rng_seed) } else { (few, RngSeed::Fixed(1)) };
    ProptestConfig { cases, rng_seed, failure_persistence: None, ..default }
}

type Point = [i32; 3];

fn point(size: i32) -> impl Strategy<Value = Point> {
    [0..=size, 0..=size, 0..=size]
}

fn double(p: Point) -> [f64; 3] {
    p.map(f64::from)
}

/// The corners of a cube of that size: something to be inside of.
fn cube(size: i32) -> Vec<[f64; 3]> {
    (0..8).map(|i| double([i & 1, i >> 1 & 1, i >> 2].map(|x| size * x))).collect()
}

/// Multiplies all coordinates. A factor that is no binary fraction makes the grid irregular in the last bits, so that Steiner points have
/// to be rounded. Axis-parallel planes stay planes.
fn scaled(plc: &Plc, step: f64) -> Plc {
    Plc { points: plc.points.iter().map(|p| p.map(|x| x * step)).collect(), ..plc.clone() }
}

/// Adds the box between two corners as six square facets.
fn add_box(plc: &mut Plc, low: Point, high: Point, marker: i32) {
    let base = plc.points.len() as u32;
    for i in 0..8u32 {
        let corner: Point = std::array::from_fn(|k| if i >> k & 1 == 1 { high[k] } else { low[k] });
        plc.points.push(double(corner));
    }
    for k in 0..3 {
        let (i, j) = (1u32 << ((k + 1) % 3), 1u32 << ((k + 2) % 3));
        for start in [base, base + (1 << k)] {
            let polygons = vec![vec![start, start + i, start + i + j, start + j]];
            plc.facets.push(Facet { polygons, marker, ..Facet::default() });
        }
    }
}

/// Six times the volume of a mesh of integer points: exact in doubles while small.
fn volume6(mesh: &TetMesh) -> f64 {
    mesh.tets.iter().map(|t| volume6_of(mesh, t)).sum()
}

/// That of one tetrahedron.
fn volume6_of(mesh: &TetMesh, t: &[u32; 4]) -> f64 {
    let p = t.map(|v| mesh.points[v as usize]);
    let [a, b, c] = [1, 2, 3].map(|i| [0, 1, 2].map(|k| p[i][k] - p[0][k]));
    a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

proptest! {
    #![proptest_config(config())]

    /// Points on a grid, many cospherical, collinear, equal.
    #[test]
    fn points(points in prop::collection::vec(point(3), 4..40)) {
        let plc = Plc { points: points.into_iter().map(double).collect(), ..Plc::default() };
        mesh(&plc, true)?;
    }

    /// Triangles anywhere: the validator removes those that cross, and the rest must be meshed.
    #[test]
    fn triangles(corners in prop::collection::vec([point(4), point(4), point(4)], 1..12)) {
        let mut plc = Plc { points: cube(4), ..Plc::default() };
        for triangle in corners {
            let before = plc.clone();
            let base = plc.points.len() as u32;
            plc.points.extend(triangle.map(double));
            plc.triangles.push([base, base + 1, base + 2]);
            if mesh(&plc, true)?.is_none() {
                plc = before;
            }
        }
        mesh(&scaled(&plc, 0.1), true)?;
    }

    /// Segments anywhere.
    #[test]
    fn segments(ends in prop::collection::vec([point(5), point(5)], 1..12)) {
        let mut plc = Plc { points: cube(5), ..Plc::default() };
        for pair in ends {
            let before = plc.clone();
            let base = plc.points.len() as u32;
            plc.points.extend(pair.map(double));
            plc.segments.push(Segment { ends: [base, base + 1], marker: 1 });
            if mesh(&plc, true)?.is_none() {
                plc = before;
            }
        }
        mesh(&scaled(&plc, 0.1), true)?;
    }

    /// A box with dangling triangles strictly inside, each kept if the complex stays valid. The volume is the box's.
    #[test]
    fn dangling(corners in prop::collection::vec([point(4), point(4), point(4)], 1..8)) {
        let mut plc = Plc::default();
        add_box(&mut plc, [-1; 3], [5; 3], 0);
        for (i, triangle) in corners.into_iter().enumerate() {
            let before = plc.clone();
            let base = plc.points.len() as u32;
            plc.points.extend(triangle.map(double));
            plc.facets.push(Facet { polygons: vec![vec![base, base + 1, base + 2]], marker: i as i32, ..Facet::default() });
            match mesh(&plc, false)? {
                Some(mesh) if mesh.steiner.iter().all(|s| s.exact && s.t == 0.5) => {
                    prop_assert_eq!(volume6(&mesh), 6.0 * 216.0);
                }
                Some(_) => {}
                None => plc = before,
            }
        }
        mesh(&scaled(&plc, 0.1), false)?;
    }

    /// Boxes inside each other: valid by construction, one region each.
    #[test]
    fn nested_boxes(depth in 1..4i32, shift in [0..2i32, 0..2, 0..2], points in prop::collection::vec(point(20), 0..10)) {
        let mut plc = Plc::default();
        let mut inner = 0;
        for i in 0..depth {
            let low: Point = shift.map(|s| i * (2 + s));
            let high: Point = [20 - 2 * i; 3];
            add_box(&mut plc, low, high, i);
            inner += 1;
        }
        plc.points.extend(points.into_iter().map(double));
        let mesh = mesh_valid(&plc, false)?;
        prop_assert_eq!(mesh.regions.len(), inner);
        let mesh = mesh_valid(&scaled(&plc, 0.1), false)?;
        prop_assert_eq!(mesh.regions.len(), inner);
    }
}
