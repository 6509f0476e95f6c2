//! The pipeline end to end on small models, every mesh proved by the exact checker.
use crate::check::check_mesh;
use crate::delaunay::HELPERS_STARTED;
use crate::fill::tests::grid_box;
use crate::plan::tetrahedralize;
use crate::{
    check_guarantee, DefectKind, Element, Error, Facet, Interior, Mode, Observer, Options, Phase, Plc,
    RegionSeed, Segment, Silent, SizeFunction, Status, TetMesh, INVALID,
};
use std::ops::ControlFlow;

fn run(plc: &Plc, options: &Options) -> Result<TetMesh, Error> {
    let mesh = tetrahedralize(plc, options, &mut Silent)?;
    if options.mode == Mode::Constrained && mesh.crowded.is_empty() {
        check_mesh(plc, &mesh, true, 100).unwrap();
    }
    Ok(mesh)
}

fn volume6(mesh: &TetMesh) -> f64 {
    mesh.tets
        .iter()
        .map(|t| {
            let p = t.map(|v| mesh.points[v as usize]);
            let e = |i: usize, k: usize| p[i][k] - p[0][k];
            e(1, 0) * (e(2, 1) * e(3, 2) - e(2, 2) * e(3, 1))
                - e(1, 1) * (e(2, 0) * e(3, 2) - e(2, 2) * e(3, 0))
                + e(1, 2) * (e(2, 0) * e(3, 1) - e(2, 1) * e(3, 0))
        })
        .sum()
}

/// The corners of a box, x fastest.
fn corners(low: [f64; 3], high: [f64; 3]) -> Vec<[f64; 3]> {
    (0..8).map(|i| std::array::from_fn(|k| if i >> k & 1 == 1 { high[k] } else { low[k] })).collect()
}

/// The six sides of a box whose corners start at point `base`.
fn sides(base: u32) -> Vec<Facet> {
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
        .iter()
        .map(|ring| Facet { polygons: vec![ring.iter().map(|v| v + base).collect()], ..Facet::default() })
        .collect()
}

fn cube(size: f64) -> Plc {
    Plc { points: corners([0.0; 3], [size; 3]), facets: sides(0), ..Plc::default() }
}

/// A box within a box.
fn nested() -> Plc {
    let mut plc = cube(8.0);
    plc.points.extend(corners([2.0; 3], [5.0; 3]));
    plc.facets.extend(sides(8));
    plc
}

/// Schönhardt's polyhedron (1928), a prism twisted until its diagonals bend inwards: it has no tetrahedralization without
/// further points.
fn schoenhardt(offset: f64) -> Plc {
    let at = |x: f64, y: f64, z: f64| [x + offset, y + offset, z + offset];
    let points = vec![
        at(10.0, 0.0, 0.0),
        at(-5.0, 9.0, 0.0),
        at(-5.0, -9.0, 0.0),
        at(9.0, 5.0, 10.0),
        at(-9.0, 5.0, 10.0),
        at(0.0, -10.0, 10.0),
    ];
    let triangles =
        vec![[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
    Plc { points, triangles, ..Plc::default() }
}

#[test]
fn a_cube_needs_no_further_point() {
    let mesh = run(&cube(2.0), &Options::default()).unwrap();
    assert_eq!(mesh.points.len(), 8);
    assert!(mesh.tets.len() == 5 || mesh.tets.len() == 6);
    assert_eq!(volume6(&mesh), 48.0);
    assert_eq!((mesh.subfaces.len(), mesh.subsegments.len(), mesh.regions.len()), (12, 12, 1));
    for subface in &mesh.subfaces {
        assert_eq!(subface.tets.iter().filter(|&&t| t == INVALID).count(), 1);
    }
}

#[test]
fn nested_boxes_are_two_regions_or_a_hole() {
    let mut plc = nested();
    plc.regions.push(RegionSeed { point: [3.0; 3], attribute: 7.5, max_volume: Some(0.25) });
    let mesh = run(&plc, &Options::default()).unwrap();
    assert_eq!(volume6(&mesh), 6.0 * 512.0);
    let attributes: Vec<f64> = mesh.regions.iter().map(|r| r.attribute).collect();
    assert_eq!(attributes, [7.5, 1.0]);
    assert_eq!(mesh.regions[0].max_volume, Some(0.25));
    plc.regions.clear();
    plc.holes.push([3.0; 3]);
    let mesh = run(&plc, &Options::default()).unwrap();
    assert_eq!(volume6(&mesh), 6.0 * (512.0 - 27.0));
    assert_eq!(mesh.regions.len(), 1);
}

#[test]
fn a_hole_may_take_a_whole_room_with_its_walls() {
    // A box of two rooms: the facets of the carved one no longer bound anything.
    let mut plc = cube(2.0);
    plc.points.extend([[1.0, 0.0, 0.0], [1.0, 2.0, 0.0], [1.0, 2.0, 2.0], [1.0, 0.0, 2.0]]);
    // Floor, ceiling and two sides know the wall's edges.
    for (facet, edge) in [(0, [8, 9]), (1, [11, 10]), (2, [8, 11]), (3, [9, 10])] {
        plc.facets[facet].polygons.push(edge.to_vec());
        plc.facets[facet].interior = Interior::Seeds;
    }
    plc.facets.push(Facet { polygons: vec![vec![8, 9, 10, 11]], ..Facet::default() });
    plc.holes.push([1.5, 1.0, 1.0]);
    let mesh = run(&plc, &Options::default()).unwrap();
    assert_eq!(volume6(&mesh), 24.0);
    assert!(mesh.subfaces.iter().all(|s| s.tets[0] != INVALID));
    assert!(!mesh.unmeshed_subfaces.is_empty());
    // A wall of the carved room is 2 triangles or more; its floor, ceiling and two sides are parts of facets.
    assert!(mesh.unmeshed_subfaces.iter().all(|s| s.tets == [INVALID; 2]));
    assert_eq!(mesh.unmeshed_points, [1, 3, 5, 7]);
    assert_eq!(mesh.unmeshed_subsegments.len(), 8);
    // Nothing leaks: the room is closed.
    assert_eq!(mesh.warnings.count(crate::WarningKind::OpenEdge), 0);
    assert_eq!(mesh.warnings.count(crate::WarningKind::UnmeshedPoint), 4);
    assert_eq!(mesh.warnings.count(crate::WarningKind::UnmeshedFacet), mesh.unmeshed_subfaces.len() as u64);
}

#[test]
fn seeds_on_facets_and_outside_are_named() {
    let mut plc = nested();
    plc.holes.push([2.0, 3.0, 3.0]);
    let error = run(&plc, &Options::default()).unwrap_err();
    assert_eq!(error.status, Status::SeedOutside);
    assert_eq!((error.defects[0].kind, error.defects[0].first), (DefectKind::SeedOnFacet, Element::Hole(0)));
    plc.holes.clear();
    plc.regions.push(RegionSeed { point: [9.0; 3], attribute: 1.0, max_volume: None });
    let error = run(&plc, &Options::default()).unwrap_err();
    assert_eq!((error.status, error.defects[0].kind), (Status::SeedOutside, DefectKind::SeedOutside));
}

#[test]
fn open_surfaces_enclose_nothing_but_have_a_hull() {
    let mut plc = cube(2.0);
    plc.facets.pop();
    assert_eq!(run(&plc, &Options::default()).unwrap_err().status, Status::NothingEnclosed);
    let mesh = run(&plc, &Options { keep_hull: true, ..Options::default() }).unwrap();
    assert!(mesh.hull_kept);
    assert_eq!(volume6(&mesh), 48.0);
}

#[test]
fn schoenhardt_gets_points_on_its_edges_only() {
    let plc = schoenhardt(0.0);
    let mesh = run(&plc, &Options::default()).unwrap();
    assert!(mesh.statistics.steiner > 0);
    assert_eq!(mesh.steiner.len() as u64, mesh.statistics.steiner);
    assert_eq!(mesh.points.len(), 6 + mesh.steiner.len());
    for (i, s) in mesh.steiner.iter().enumerate() {
        let [a, b] = s.ends.map(|v| mesh.points[v as usize]);
        for k in 0..3 {
            let expected = a[k] + s.t * (b[k] - a[k]);
            assert!((mesh.points[6 + i][k] - expected).abs() <= 1e-14 * 10.0);
        }
    }
    let limited = Options { steiner_limit: Some(0), ..Options::default() };
    assert_eq!(run(&plc, &limited).unwrap_err().status, Status::SteinerLimit);
}

#[test]
fn where_doubles_are_too_coarse_the_exact_form_remains() {
    // Beyond 2^52 doubles are the integers: a twisted prism three units wide whose edges must be split has no room for it.
    let lattice = [[2, 0, 1], [3, 1, 1], [3, 2, 0], [3, 1, 0], [0, 0, 0], [1, 1, 1]];
    let points = lattice.map(|p: [u64; 3]| p.map(|x| ((1 << 52) + x) as f64)).to_vec();
    let plc = Plc { points, ..schoenhardt(0.0) };
    let error = run(&plc, &Options::default()).unwrap_err();
    assert_eq!(error.status, Status::Rounding);
    assert!(!error.defects.is_empty() && error.defects.iter().all(|d| d.kind == DefectKind::Rounding));
    let mesh = run(&plc, &Options { exact_form: true, ..Options::default() }).unwrap();
    assert!(!mesh.crowded.is_empty() && mesh.crowded.iter().all(|&v| v >= 6));
    assert_eq!(mesh.steiner.len(), mesh.points.len() - 6);
}

#[test]
fn elements_an_ulp_apart_are_meshed() {
    // A vertex of one triangle lies an ulp off an edge of another that starts at the same corner (found by the property test of triangles
    // in a cube, coordinates times 0.1): equal radii cannot be kept equal in doubles.
    let s = 0.30000000000000004;
    let mut plc = cube(0.4);
    plc.facets.clear();
    plc.points.extend([[s, s, 0.0], [0.0, s, s], [0.4, 0.4, 0.2], [0.0, 0.2, s], [0.2, s, 0.1], [0.0, s, s]]);
    plc.triangles = vec![[8, 9, 10], [11, 12, 13]];
    let mesh = run(&plc, &Options { keep_hull: true, ..Options::default() }).unwrap();
    assert!(mesh.hull_kept && !mesh.steiner.is_empty());
}

#[test]
fn scaled_models_give_the_same_mesh() {
    // Powers of two change only the exponents, far beyond what doubles could multiply.
    let reference = run(&schoenhardt(0.0), &Options::default()).unwrap();
    for power in [-900, -500, 500, 900] {
        let factor = 2f64.powi(power);
        let mut plc = schoenhardt(0.0);
        for p in &mut plc.points {
            *p = p.map(|x| x * factor);
        }
        let mesh = run(&plc, &Options::default()).unwrap();
        assert_eq!(mesh.tets, reference.tets, "2^{power}");
    }
}

#[test]
fn internal_facets_segments_and_points_are_kept() {
    let mut plc = cube(8.0);
    // A dangling square, an isolated segment and an isolated point; the square has a hole ring.
    plc.points.extend([[2.0, 2.0, 4.0], [6.0, 2.0, 4.0], [6.0, 6.0, 4.0], [2.0, 6.0, 4.0]]);
    plc.points.extend([[3.0, 3.0, 4.0], [5.0, 3.0, 4.0], [5.0, 5.0, 4.0], [3.0, 5.0, 4.0]]);
    plc.points.extend([[4.0, 4.0, 1.0], [4.0, 4.0, 7.0], [1.0, 1.0, 1.0]]);
    plc.facets.push(Facet {
        polygons: vec![vec![8, 9, 10, 11], vec![12, 13, 14, 15]],
        interior: Interior::FirstMinusOthers,
        marker: 5,
        ..Facet::default()
    });
    plc.segments.push(Segment { ends: [16, 17], marker: 9 });
    let mesh = run(&plc, &Options::default()).unwrap();
    assert_eq!(volume6(&mesh), 6.0 * 512.0);
    assert_eq!(mesh.regions.len(), 1);
    let dangling: Vec<_> = mesh.subfaces.iter().filter(|s| s.marker == 5).collect();
    assert!(dangling.len() >= 8 && dangling.iter().all(|s| s.tets.iter().all(|&t| t != INVALID)));
    assert!(mesh.subsegments.iter().any(|s| s.segment == 0 && s.marker == 9));
    assert!(mesh.tets.iter().flatten().any(|&v| v == 18));
}

#[test]
fn equal_points_are_one_vertex() {
    let mut plc = cube(2.0);
    plc.points.push([-0.0, 0.0, 0.0]);
    plc.facets[0].polygons[0][0] = 8;
    let mesh = run(&plc, &Options::default()).unwrap();
    assert_eq!(mesh.point_alias[8], 0);
    assert_eq!(mesh.statistics.duplicate_points, 1);
    assert!(mesh.points[8][0].is_sign_negative());
    assert!(mesh.tets.iter().flatten().all(|&v| v != 8));
}

#[test]
fn delaunay_mode_ignores_facets() {
    let mut plc = nested();
    plc.facets.truncate(3);
    let mesh = run(&plc, &Options { mode: Mode::Delaunay, ..Options::default() }).unwrap();
    assert_eq!(volume6(&mesh), 6.0 * 512.0);
    assert!(mesh.subfaces.is_empty());
    assert!(mesh.statistics.peak_bytes > 0);
    let points_only = Plc { points: plc.points, ..Plc::default() };
    check_mesh(&points_only, &mesh, true, 10).unwrap();
}

#[test]
fn the_caller_can_cancel_in_every_phase() {
    struct Stop(Phase);
    impl Observer for Stop {
        fn progress(&mut self, phase: Phase, _: f64) -> ControlFlow<()> {
            if phase == self.0 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        }
    }
    let phases =
        [Phase::Validate, Phase::Segments, Phase::Facets, Phase::Regions, Phase::Round, Phase::Audit];
    for phase in phases {
        let error = tetrahedralize(&nested(), &Options::default(), &mut Stop(phase)).unwrap_err();
        assert_eq!(error.status, Status::Cancelled, "{}", phase.name());
    }
}

/// A fan of triangles whose edges from the common vertex are an ulp apart.
#[test]
fn segments_an_ulp_apart_from_a_common_vertex() {
    let grid = [
        [4, 3, 3],
        [3, 2, 3],
        [3, 3, 1],
        [2, 0, 4],
        [4, 1, 4],
        [0, 2, 3],
        [0, 4, 1],
        [4, 2, 0],
        [4, 3, 1],
        [1, 0, 3],
        [0, 1, 1],
    ];
    let mut points = corners([0.0; 3], [0.4; 3]);
    points.extend(grid.map(|p| p.map(|x| f64::from(x) * 0.1)));
    let triangles = vec![[8, 9, 10], [8, 11, 12], [8, 13, 14], [8, 15, 16], [8, 17, 18]];
    let plc = Plc { points, triangles, ..Plc::default() };
    let mesh = run(&plc, &Options { keep_hull: true, ..Options::default() }).unwrap();
    assert!(mesh.steiner.len() < 30 && !mesh.steiner_terms.is_empty(), "{} points", mesh.steiner.len());
    for term in &mesh.steiner_terms {
        assert!(term.value.abs() <= f64::EPSILON * mesh.steiner[term.steiner as usize].t);
    }
}

/// Bundles of segments much closer to each other than an ulp of their length: with a common end, parallel, skew; and
/// vertices close to a segment's end or middle.
#[test]
fn segments_far_less_than_an_ulp_apart() {
    let v = |x: f64, y: f64, z: f64| [x, y, z];
    for d in [1e-5, 1e-10, 1e-16, 1e-25, 1e-40, 1e-60] {
        let o = v(0., 0., 0.);
        let along = [v(-0.75, 0., 0.), v(0.75, 0., 0.)];
        let crowd =
            [[v(d, d, 0.), v(d, -d, 0.5 * d)], [v(2. * d, 0.1 * d, 0.1 * d), v(3. * d, 0.1 * d, 0.1 * d)]];
        let bundles = [
            vec![[o, v(0.75, 0., 0.)], [o, v(0.5, d, 0.)], [o, v(0.3, 0., d)], [o, v(0.6, -d, -d)]],
            vec![[o, v(0.75, 0., 0.)], crowd[0], crowd[1]],
            vec![along, crowd[0], crowd[1]],
            vec![
                along,
                [v(-0.3, d, 0.), v(0.9, d, 0.)],
                [v(-0.6, 0., d), v(0.5, 0., d)],
                [v(-0.5, -d, -d), v(0.55, -d, -d)],
            ],
            vec![along, [v(-0.3, d, 3. * d), v(0.9, d, -5. * d)], [v(-0.6, -2. * d, d), v(0.5, 7. * d, d)]],
        ];
        for bundle in bundles {
            let mut plc = Plc { points: corners([-1.0; 3], [1.0; 3]), ..Plc::default() };
            for ends in bundle {
                let base = plc.points.len() as u32;
                plc.points.extend(ends);
                plc.segments.push(Segment { ends: [base, base + 1], marker: 1 });
            }
            let mesh = run(&plc, &Options { keep_hull: true, ..Options::default() }).unwrap();
            assert!(mesh.steiner.len() <= 30, "{} points at {d}", mesh.steiner.len());
        }
    }
}

/// A Steiner point on a segment across the plane x = 0 comes so near to it that its double would have bits below the range of
/// exact arithmetic.
#[test]
fn steiner_points_are_rounded_into_the_exact_range() {
    let grid = [
        [0, 2, 0],
        [1, 1, 2],
        [3, 1, 3],
        [0, 4, 4],
        [4, 1, 4],
        [3, 4, 2],
        [3, 0, 3],
        [1, 3, 4],
        [2, 0, 4],
        [0, 3, 2],
        [2, 3, 3],
    ];
    let mut points = corners([0.0; 3], [4e30; 3]);
    points.extend(grid.map(|p| p.map(|x| f64::from(x) * 1e30)));
    let triangles = vec![[8, 9, 10], [8, 11, 12], [8, 13, 14], [8, 15, 16], [8, 17, 18]];
    run(&Plc { points, triangles, ..Plc::default() }, &Options { keep_hull: true, ..Options::default() })
        .unwrap();
}

/// A wall that stands on a floor which does not list its foot, and one that leaves the floor at a vertex on its edge.
#[test]
fn a_wall_on_a_floor_that_does_not_list_it() {
    let mut plc = cube(4.0);
    let wall = [[1., 2., 0.], [3., 2., 0.], [3., 2., 2.], [1., 2., 2.]];
    plc.points.extend(wall);
    plc.facets.push(Facet { polygons: vec![vec![8, 9, 10, 11]], marker: 7, ..Facet::default() });
    let mesh = run(&plc, &Options::default()).unwrap();
    assert_eq!((mesh.regions.len(), volume6(&mesh)), (1, 6.0 * 64.0));
    assert!(mesh.subfaces.iter().any(|face| face.marker == 7));
    // Both ends of the wall touch the sides: two rooms below it and above it are one region.
    (plc.points[8], plc.points[9]) = ([0., 2., 0.], [4., 2., 0.]);
    (plc.points[10], plc.points[11]) = ([4., 2., 4.], [0., 2., 4.]);
    let mesh = run(&plc, &Options::default()).unwrap();
    assert_eq!((mesh.regions.len(), volume6(&mesh)), (2, 6.0 * 64.0));
    // Through the floor it is an error.
    plc.points[8][2] = -1.0;
    plc.points[9][2] = -1.0;
    assert_eq!(run(&plc, &Options::default()).unwrap_err().status, Status::SelfIntersection);
}

/// A box with so many points inside that rounds are inserted by ranges.
fn crowded_box() -> Plc {
    let mut plc = cube(1.0);
    let mut state = 5u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 20) as f64 / (1u64 << 44) as f64
    };
    plc.points.extend((0..66_000).map(|_| [next(), next(), next()]));
    // Some twice: duplicates are mapped to the first ones.
    let again = plc.points[100..150].to_vec();
    plc.points.extend(again);
    plc
}

#[test]
fn any_number_of_threads_gives_the_same_mesh() {
    let plc = crowded_box();
    for mode in [Mode::Delaunay, Mode::Constrained] {
        let by = |threads| {
            let options = Options { mode, threads, ..Options::default() };
            let before = HELPERS_STARTED.get();
            let mut mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
            let helpers = HELPERS_STARTED.get() - before;
            assert_eq!(helpers > 0, options.worker_threads() > 1, "{threads} threads, {helpers} helpers");
            mesh.statistics.seconds = Default::default();
            mesh.statistics.peak_bytes = 0;
            mesh
        };
        let one = by(1);
        assert!(one.tets.len() > 400_000);
        for threads in [0, 2, 3, 7] {
            assert!(by(threads) == one, "{mode:?}, {threads} threads");
        }
    }
}

#[test]
fn blocks_are_the_same_for_any_number_of_threads() {
    let plc = grid_box(4);
    let function = SizeFunction::new(|[x, ..]| Ok(0.25 + 0.05 * x));
    let shapes = [
        Options { size: Some(0.3), optimize: 1, ..Options::default() },
        Options { size_function: Some(function), quality: Some(1.6), ..Options::default() },
        Options { max_volume: Some(0.01), min_angle: Some(16.0), ..Options::default() },
    ];
    for (shape, mode) in shapes.iter().flat_map(|shape| [(shape, Mode::Preserve), (shape, Mode::Constrained)])
    {
        let by = |threads| {
            let options = Options { mode, threads, ..shape.clone() };
            let before = HELPERS_STARTED.get();
            let mut mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
            let helpers = HELPERS_STARTED.get() - before;
            let alone = threads == 1 || shape.size_function.is_some();
            assert_eq!(helpers == 0, alone, "{mode:?}, {threads} threads, {helpers} helpers");
            check_guarantee(&plc, &mesh, 10).unwrap();
            mesh.statistics.seconds = Default::default();
            mesh.statistics.peak_bytes = 0;
            mesh
        };
        let one = by(1);
        assert!(one.tets.len() > 3_000);
        for threads in [2, 5] {
            assert!(by(threads) == one, "{mode:?}, {threads} threads");
        }
    }
}

/// A box without one triangle of its lid, at `base`.
fn leaky(low: [f64; 3], high: [f64; 3], base: u32) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let rings = sides(base);
    let halves = |f: &Facet| {
        let r = f.polygons[0].clone();
        [[r[0], r[1], r[2]], [r[0], r[2], r[3]]]
    };
    let mut triangles: Vec<[u32; 3]> = rings.iter().flat_map(halves).collect();
    triangles.remove(3);
    (corners(low, high), triangles)
}

/// The error used to name no element at all.
#[test]
fn a_surface_that_leaks_is_told_where() {
    let (points, triangles) = leaky([0.0; 3], [2.0; 3], 0);
    let plc = Plc { points, triangles, ..Plc::default() };
    for mode in [Mode::Constrained, Mode::Preserve] {
        let options = Options { mode, ..Options::default() };
        let error = run(&plc, &options).unwrap_err();
        assert_eq!((error.status, error.defect_count, error.defects.len()), (Status::NothingEnclosed, 3, 3));
        let of = |d: &crate::Defect| (d.kind, d.first, d.second, d.point);
        let open = |a, b, at| (DefectKind::OpenEdge, Element::Point(a), Some(Element::Point(b)), Some(at));
        assert_eq!(
            error.defects.iter().map(of).collect::<Vec<_>>(),
            [open(4, 6, [0.0, 1.0, 2.0]), open(4, 7, [1.0, 1.0, 2.0]), open(6, 7, [1.0, 2.0, 2.0])]
        );
        assert!(error.message.contains("3 open edges, such as that of facet"), "{}", error.message);
        assert!(error.message.contains("between points 4 and 6 at (0, 1, 2)"), "{}", error.message);
    }
    // The check of the input alone says the same, unless the hull is kept.
    let checked = crate::plc::check(&plc, &Options::default(), &mut Silent).unwrap_err();
    assert_eq!(checked, run(&plc, &Options::default()).unwrap_err());
    let kept = Options { keep_hull: true, ..Options::default() };
    let warnings = crate::plc::check(&plc, &kept, &mut Silent).unwrap();
    assert_eq!(warnings.count(crate::WarningKind::OpenEdge), 3);
    assert_eq!(run(&plc, &kept).unwrap().warnings.total(), 0);
}

/// The outer shell used to vanish without a warning.
#[test]
fn a_shell_that_leaks_beside_others_is_a_warning() {
    let (mut points, mut triangles) = leaky([0.0; 3], [8.0; 3], 0);
    points.extend(corners([2.0; 3], [5.0; 3]));
    triangles.extend(sides(8).iter().flat_map(|f| {
        let r = &f.polygons[0];
        [[r[0], r[1], r[2]], [r[0], r[2], r[3]]]
    }));
    let mut plc = Plc { points, triangles, ..Plc::default() };
    // Steiner points on the leaking shell do not make more edges.
    plc.points.push([4.0, 8.0, 8.0]);
    for mode in [Mode::Constrained, Mode::Preserve] {
        let mesh = run(&plc, &Options { mode, ..Options::default() }).unwrap();
        let of = |kind| mesh.warnings.of(kind).copied().collect::<Vec<_>>();
        let ends: Vec<_> =
            of(crate::WarningKind::OpenEdge).iter().map(|w| (w.first, w.second.unwrap())).collect();
        let point = Element::Point;
        assert_eq!(
            ends,
            [(point(4), point(6)), (point(4), point(7)), (point(6), point(16)), (point(7), point(16))]
        );
        assert_eq!(of(crate::WarningKind::UnmeshedFacet).len(), mesh.unmeshed_subfaces.len());
        assert!(mesh.unmeshed_subfaces.len() >= 11);
        assert!(mesh.unmeshed_points.iter().copied().eq((0..8).chain(16..mesh.points.len() as u32)));
        assert!(mesh.subfaces.iter().all(|s| s.facet >= 11 && s.tets[0] != INVALID));
    }
    let warnings = crate::plc::check(&plc, &Options::default(), &mut Silent).unwrap();
    assert_eq!(warnings.count(crate::WarningKind::OpenEdge), 4);
}

/// Both kinds used to be listed with the mesh's own, as subfaces with two invalid tetrahedra.
#[test]
fn what_bounds_nothing_is_set_apart() {
    let mut plc = nested();
    // A fin outside, a loose segment outside and one inside, a loose point, and a point twice.
    plc.points.extend([
        [10.0, 0.0, 0.0],
        [10.0, 8.0, 0.0],
        [20.0; 3],
        [1.0, 1.0, 1.0],
        [30.0; 3],
        [1.0, 1.0, 1.0],
    ]);
    plc.facets.push(Facet { polygons: vec![vec![1, 16, 17, 3]], marker: 5, ..Facet::default() });
    plc.segments = vec![Segment { ends: [16, 18], marker: 3 }, Segment { ends: [0, 19], marker: 4 }];
    for mode in [Mode::Constrained, Mode::Preserve] {
        let mesh = run(&plc, &Options { mode, ..Options::default() }).unwrap();
        assert!(mesh.subfaces.iter().all(|s| s.tets[0] != INVALID && s.marker == 0));
        assert_eq!(mesh.unmeshed_subfaces.len(), 2);
        assert!(mesh.unmeshed_subfaces.iter().all(|s| s.facet == 12 && s.marker == 5));
        assert_eq!(mesh.subsegments.iter().filter(|s| s.segment != INVALID).map(|s| s.marker).max(), Some(4));
        let mut apart: Vec<_> = mesh.unmeshed_subsegments.iter().map(|s| (s.ends, s.segment)).collect();
        apart.iter_mut().for_each(|x| x.0.sort_unstable());
        apart.sort_unstable();
        assert_eq!(apart, [([1, 16], INVALID), ([3, 17], INVALID), ([16, 17], INVALID), ([16, 18], 0)]);
        assert_eq!(mesh.unmeshed_points, [16, 17, 18, 20, 21]);
        let of = |kind| mesh.warnings.of(kind).map(|w| (w.first, w.second)).collect::<Vec<_>>();
        use crate::WarningKind::*;
        let point = Element::Point;
        assert_eq!(
            of(OpenEdge),
            [(point(1), Some(point(16))), (point(3), Some(point(17))), (point(16), Some(point(17)))]
        );
        assert_eq!(of(UnmeshedFacet), [(Element::Facet(12), None); 2]);
        assert_eq!(of(UnmeshedSegment), [(Element::Segment(0), None)]);
        assert_eq!(of(UnmeshedPoint), [16, 17, 18, 20].map(|v| (point(v), None)));
        assert_eq!(of(EqualPoints), [(point(21), Some(point(19)))]);
        crate::check::check_mesh(&plc, &mesh, false, 10).unwrap();
        // The check notices a piece in the wrong list.
        let mut wrong = mesh.clone();
        wrong.subfaces.push(wrong.unmeshed_subfaces[0]);
        wrong.unmeshed_subfaces.remove(0);
        assert!(crate::check::check_mesh(&plc, &wrong, false, 10).is_err());
        let mut wrong = mesh.clone();
        wrong.subsegments.append(&mut wrong.unmeshed_subsegments);
        assert!(crate::check::check_mesh(&plc, &wrong, false, 10).is_err());
        let mut wrong = mesh.clone();
        wrong.unmeshed_subfaces.clear();
        assert!(crate::check::check_mesh(&plc, &wrong, false, 10).is_err());
    }
}

/// They used to point either way, by the indices of the tetrahedra.
#[test]
fn interfaces_point_from_the_lower_region_to_the_higher() {
    let mut plc = nested();
    let seeds = [([1.0; 3], 5.0), ([3.0; 3], 2.0)];
    for order in [[0, 1], [1, 0]] {
        let seed = |i: usize| RegionSeed { point: seeds[i].0, attribute: seeds[i].1, max_volume: None };
        plc.regions = order.map(seed).to_vec();
        for mode in [Mode::Constrained, Mode::Preserve] {
            let mesh = run(&plc, &Options { mode, ..Options::default() }).unwrap();
            let mut interfaces = 0;
            for face in mesh.subfaces.iter().filter(|face| face.tets[1] != INVALID) {
                assert_eq!(face.tets.map(|t| mesh.tet_region[t as usize]), [0, 1]);
                let [a, b, c] = face.corners.map(|v| mesh.points[v as usize]);
                let inward = (0..3).map(|k| {
                    let (u, v) = ([0, 1, 2].map(|i| b[i] - a[i]), [0, 1, 2].map(|i| c[i] - a[i]));
                    let normal = u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3];
                    normal * (3.5 - a[k])
                });
                assert_eq!(inward.sum::<f64>() > 0.0, order == [0, 1]);
                interfaces += 1;
            }
            assert!(interfaces >= 12);
            check_mesh(&plc, &mesh, false, 10).unwrap();
            let mut wrong = mesh.clone();
            let face = wrong.subfaces.iter_mut().find(|face| face.tets[1] != INVALID).unwrap();
            face.tets.swap(0, 1);
            face.corners.swap(1, 2);
            let error = check_mesh(&plc, &wrong, false, 10).unwrap_err();
            assert_eq!(error.defects[0].kind, DefectKind::NotConforming);
        }
    }
}

#[test]
fn without_validation_errors_name_the_elements_of_the_caller() {
    // Two segments of one length that cross in their middles: the mesh cannot have both.
    let mut plc = cube(4.0);
    plc.points.extend([[1.0, 1.0, 2.0], [3.0, 3.0, 2.0], [1.0, 3.0, 2.0], [3.0, 1.0, 2.0]]);
    plc.points.extend([[0.5, 0.5, 0.5], [0.5, 0.5, 1.0]]);
    let segment = |a, b| Segment { ends: [a, b], marker: 0 };
    plc.segments = vec![segment(12, 13), segment(8, 9), segment(10, 11)];
    let blind = Options { validate: false, ..Options::default() };
    let error = run(&plc, &blind).unwrap_err();
    assert_eq!(error.status, Status::SelfIntersection);
    let defect = error.defects[0];
    assert!([Element::Segment(1), Element::Segment(2)].contains(&defect.first), "{defect}");
    assert!(plc.points[8..12].contains(&defect.point.unwrap()), "{defect}");
    // Edges of triangles instead: the facets are named.
    plc.segments.clear();
    plc.points.extend([[2.0, 2.0, 3.9], [2.0, 2.0, 0.1]]);
    plc.triangles = vec![[8, 9, 14], [10, 11, 15]];
    for mode in [Mode::Constrained, Mode::Preserve] {
        let error = run(&plc, &Options { mode, ..blind.clone() }).unwrap_err();
        assert_eq!(error.status, Status::SelfIntersection);
        let defect = error.defects[0];
        assert!([Element::Facet(0), Element::Facet(1)].contains(&defect.first), "{mode:?}: {defect}");
    }
}

/// The map and the data to undo it: a check against the input needs nothing else.
#[test]
fn points_without_tetrahedra_can_be_dropped() {
    // A loose point first, a twisted prism, a leaking one with Steiner points of its own, and a corner twice.
    let mut plc = Plc { points: vec![[50.0; 3]], ..Plc::default() };
    for offset in [0.0, 30.0] {
        let base = plc.points.len() as u32;
        let prism = schoenhardt(offset);
        plc.points.extend(prism.points);
        plc.triangles.extend(prism.triangles.iter().map(|t| t.map(|v| v + base)));
    }
    plc.triangles.pop();
    plc.points.push(plc.points[3]);
    plc.point_markers = (0..plc.points.len() as i32).collect();
    plc.point_attribute_count = 1;
    plc.point_attributes = plc.points.iter().map(|p| p[0] + 2.0 * p[1]).collect();
    for mode in [Mode::Constrained, Mode::Preserve] {
        let whole = run(&plc, &Options { mode, ..Options::default() }).unwrap();
        let options = Options { mode, drop_unmeshed_points: true, ..Options::default() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        crate::check::check_mesh(&plc, &mesh, mode == Mode::Constrained, 10).unwrap();
        assert_eq!(mesh.points.len(), whole.points.len() - whole.unmeshed_points.len());
        assert_eq!((mesh.input_point_count, mesh.unmeshed_points.len()), (6, 0));
        assert_eq!(mesh.points[..6], plc.points[1..7]);
        assert!(mesh.unmeshed_subfaces.is_empty() && mesh.unmeshed_subsegments.is_empty());
        assert_eq!(mesh.warnings, whole.warnings);
        let dropped = mesh.dropped.as_ref().unwrap();
        assert_eq!(dropped.inputs()[..7], [INVALID, 0, 1, 2, 3, 4, 5]);
        assert!(dropped.inputs()[7..13].iter().all(|&v| v == INVALID));
        assert_eq!(dropped.inputs()[13], 2);
        // Those of the leaking prism are dropped, the ends of the other's have their new indices.
        assert_eq!(mode == Mode::Constrained, !dropped.steiner.is_empty());
        assert!(mesh.steiner.iter().all(|s| s.is_inside() || s.ends.iter().all(|&v| v < 6)));
        let back = mesh.with_dropped(&plc.points).unwrap();
        assert_eq!((&back.points, &back.tets, &back.steiner), (&whole.points, &whole.tets, &whole.steiner));
        assert_eq!((&back.subfaces, &back.subsegments), (&whole.subfaces, &whole.subsegments));
        assert_eq!(
            (&back.unmeshed_subfaces, &back.unmeshed_subsegments),
            (&whole.unmeshed_subfaces, &whole.unmeshed_subsegments)
        );
        // Markers and attributes follow their points.
        let data = crate::query::PointData::new(&plc, &mesh).unwrap();
        assert_eq!(data.markers[..6], [1, 2, 3, 4, 5, 6]);
        for (p, a) in mesh.points.iter().zip(&data.attributes) {
            assert!((p[0] + 2.0 * p[1] - a).abs() < 1e-9);
        }
        assert_eq!((data.markers.len(), data.attributes.len()), (mesh.points.len(), mesh.points.len()));
        // A mismatch is an error.
        assert!(mesh.with_dropped(&plc.points[1..]).is_err());
        let mut wrong = mesh.clone();
        wrong.dropped.as_mut().unwrap().new_index[0] = 0;
        assert!(crate::check::check_mesh(&plc, &wrong, false, 10).is_err());
        let mut wrong = mesh.clone();
        wrong.points[0][0] = 11.0;
        assert!(crate::check::check_mesh(&plc, &wrong, false, 10).is_err());
    }
}
