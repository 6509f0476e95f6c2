//! The pipeline end to end on small models, every mesh proved by the exact checker.
use super::tetrahedralize;
use crate::check::check_mesh;
use crate::{
    DefectKind, Element, Error, Facet, Interior, Mode, Observer, Options, Phase, Plc, RegionSeed, Segment,
    Silent, Status, TetMesh, INVALID,
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
    // A box of two rooms: the facets of the carved one border nothing any more.
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
    assert!(mesh.subfaces.iter().any(|s| s.tets == [INVALID; 2]));
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
fn elements_an_ulp_apart_end_with_a_status() {
    // A vertex of one triangle lies an ulp beside an edge of another that starts at the same corner (found by the property
    // test of triangles in a cube, coordinates times 0.1): equal radii cannot be kept equal in doubles.
    let s = 0.30000000000000004;
    let mut plc = cube(0.4);
    plc.facets.clear();
    plc.points.extend([[s, s, 0.0], [0.0, s, s], [0.4, 0.4, 0.2], [0.0, 0.2, s], [0.2, s, 0.1], [0.0, s, s]]);
    plc.triangles = vec![[8, 9, 10], [11, 12, 13]];
    match run(&plc, &Options { keep_hull: true, ..Options::default() }) {
        Ok(mesh) => assert!(mesh.hull_kept),
        Err(error) => assert_eq!(error.status, Status::SteinerLimit),
    }
}

#[test]
fn scaled_models_give_the_same_mesh() {
    // Powers of two change nothing but the exponents, far beyond what plain doubles could multiply.
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

#[test]
fn the_number_of_threads_changes_nothing() {
    let one = run(&schoenhardt(0.0), &Options::default()).unwrap();
    for threads in [0, 2, 3, 7] {
        let more = run(&schoenhardt(0.0), &Options { threads, ..Options::default() }).unwrap();
        assert_eq!((&one.points, &one.tets), (&more.points, &more.tets));
    }
    assert!(Options { threads: 0, ..Options::default() }.worker_threads() >= 1);
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
            let mut mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
            mesh.statistics.seconds = Default::default();
            mesh.statistics.peak_bytes = 0;
            mesh
        };
        let one = by(1);
        assert!(one.tets.len() > 400_000);
        for threads in [2, 3, 4, 7] {
            assert!(by(threads) == one, "{mode:?}, {threads} threads");
        }
    }
}
