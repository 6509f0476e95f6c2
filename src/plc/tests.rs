//! From PLC to surface.
use crate::control::{controlled, Control, Limits};
use crate::error::{DefectKind, Element, Error, Status};
use crate::options::Options;
use crate::plc::prepare::{check, prepare};
use crate::plc::surface::Surface;
use crate::plc::{Facet, Interior, Plc, Segment};
use crate::progress::Silent;
use crate::INVALID;

const CUBE: [[f64; 3]; 8] = [
    [0., 0., 0.],
    [1., 0., 0.],
    [1., 1., 0.],
    [0., 1., 0.],
    [0., 0., 1.],
    [1., 0., 1.],
    [1., 1., 1.],
    [0., 1., 1.],
];
const CUBE_QUADS: [[u32; 4]; 6] =
    [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]];

fn run(plc: &Plc) -> Result<Surface, Error> {
    let surface = prepare(plc, &Options::default(), &Control::free())?;
    assert_consistent(&surface);
    Ok(surface)
}

/// The invariants of every surface.
fn assert_consistent(s: &Surface) {
    assert_eq!(s.triangles.len(), s.triangle_facet.len());
    assert_eq!(s.triangles.len(), s.triangle_patch.len());
    assert_eq!(s.segments.len(), s.segment_parent.len());
    assert!(s.segments.windows(2).all(|w| w[0] < w[1]));
    assert!(s.segments.iter().all(|e| e[0] < e[1]));
    let used = s.triangles.iter().flatten().chain(s.segments.iter().flatten());
    assert!(used.into_iter().all(|&v| s.alias[v as usize] == v));
    assert!(s.triangle_patch.iter().all(|&p| p < s.patch_count));
    if s.points.len() * s.triangles.len() < 100_000 {
        assert_conforming(s);
    }
}

/// No vertex lies in a segment or in a closed triangle other than its own.
fn assert_conforming(s: &Surface) {
    use crate::predicates::{orient2d, orient3d, Sign};
    let at = |v: u32| &s.points[v as usize];
    let flat = |v: u32, axis: usize| super::polygon::project(at(v), axis);
    let vertices = || (0..s.points.len() as u32).filter(|&v| s.alias[v as usize] == v);
    for &[a, b] in &s.segments {
        for v in vertices().filter(|v| ![a, b].contains(v) && super::polygon::collinear(&s.points, a, b, *v))
        {
            assert!(
                (0..3).any(|k| at(v)[k] < at(a)[k].min(at(b)[k]) || at(v)[k] > at(a)[k].max(at(b)[k])),
                "{v} in segment {a} {b}"
            );
        }
    }
    for &[a, b, c] in &s.triangles {
        let axis = (0..3).find(|&axis| orient2d(flat(a, axis), flat(b, axis), flat(c, axis)) != Sign::Zero);
        let axis = axis.expect("a triangle with area");
        let turn = |a, b, c| orient2d(flat(a, axis), flat(b, axis), flat(c, axis));
        let sense = turn(a, b, c);
        for v in vertices().filter(|v| ![a, b, c].contains(v)) {
            if orient3d(at(a), at(b), at(c), at(v)) == Sign::Zero {
                assert!(
                    [(a, b), (b, c), (c, a)].iter().any(|&(p, q)| turn(p, q, v) == -sense),
                    "{v} in triangle {a} {b} {c}"
                );
            }
        }
    }
}

fn ring_facet(rings: &[&[u32]]) -> Facet {
    Facet { polygons: rings.iter().map(|r| r.to_vec()).collect(), ..Facet::default() }
}

fn flat(points: &[[f64; 2]], rings: &[&[u32]]) -> Plc {
    Plc {
        points: points.iter().map(|p| [p[0], p[1], 0.0]).collect(),
        facets: vec![ring_facet(rings)],
        ..Plc::default()
    }
}

fn cube_quads() -> Plc {
    Plc {
        points: CUBE.to_vec(),
        facets: CUBE_QUADS.iter().map(|q| ring_facet(&[q])).collect(),
        ..Plc::default()
    }
}

fn cube_triangles() -> Plc {
    let triangles = CUBE_QUADS.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Plc { points: CUBE.to_vec(), triangles, ..Plc::default() }
}

/// Twice the signed area in the plane of x and y, for integer coordinates.
fn area(s: &Surface) -> i128 {
    let at = |v: u32| [s.points[v as usize][0] as i128, s.points[v as usize][1] as i128];
    s.triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(at);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        })
        .inspect(|&area| assert!(area != 0))
        .sum()
}

fn shoelace(points: &[[f64; 2]]) -> i128 {
    let at = |i: usize| points[i % points.len()].map(|x| x as i128);
    (0..points.len()).map(|i| at(i)[0] * at(i + 1)[1] - at(i)[1] * at(i + 1)[0]).sum()
}

fn kinds(result: Result<Surface, Error>) -> Vec<DefectKind> {
    result.unwrap_err().defects.iter().map(|d| d.kind).collect()
}

/// A small generator (SplitMix64).
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) % n
    }
}

/// A polygon of lattice points, star-shaped about the origin: one point per direction, sorted exactly by angle.
fn star(random: &mut Random, n: usize, radius: i64) -> Vec<[f64; 2]> {
    let mut points: Vec<[i64; 2]> = (0..n)
        .map(|_| [0; 2].map(|_: i64| random.below(2 * radius as u64 + 1) as i64 - radius))
        .filter(|p| *p != [0, 0])
        .collect();
    points.extend([[radius, 1], [-radius, radius], [-radius, -radius], [1, -radius]]);
    let half = |p: &[i64; 2]| (p[1], p[0]) < (0, 0);
    let cross = |p: &[i64; 2], q: &[i64; 2]| {
        i128::from(p[0]) * i128::from(q[1]) - i128::from(p[1]) * i128::from(q[0])
    };
    points.sort_by(|p, q| half(p).cmp(&half(q)).then(0.cmp(&cross(p, q))).then(p.cmp(q)));
    points.dedup_by(|p, q| half(p) == half(q) && cross(p, q) == 0);
    points.iter().map(|p| p.map(|x| x as f64)).collect()
}

#[test]
fn cube_of_quads_and_of_triangles() {
    for plc in [cube_quads(), cube_triangles()] {
        let s = run(&plc).unwrap();
        assert_eq!((s.triangles.len(), s.segments.len(), s.patch_count), (12, 12, 6));
        assert!(s.segment_parent.iter().all(|&p| p == INVALID));
        assert_eq!(s.scale, 0);
    }
}

#[test]
fn triangles_keep_the_sense_of_their_ring() {
    let s = run(&cube_quads()).unwrap();
    let volume: f64 = s
        .triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| s.points[v as usize]);
            a[0] * (b[1] * c[2] - b[2] * c[1])
                + a[1] * (b[2] * c[0] - b[0] * c[2])
                + a[2] * (b[0] * c[1] - b[1] * c[0])
        })
        .sum();
    assert_eq!(volume, 6.0);
}

#[test]
fn different_markers_keep_their_common_edge() {
    let mut plc = cube_triangles();
    plc.triangle_markers = vec![1; 12];
    plc.triangle_markers[0] = 2;
    let s = run(&plc).unwrap();
    assert_eq!((s.segments.len(), s.patch_count), (13, 7));
    assert!(s.segments.contains(&[0, 2]));
}

#[test]
fn an_input_segment_on_a_flat_edge_constrains() {
    let mut plc = cube_triangles();
    plc.segments = vec![Segment { ends: [6, 7], marker: 1 }, Segment { ends: [2, 0], marker: 5 }];
    let s = run(&plc).unwrap();
    assert_eq!((s.segments.len(), s.patch_count), (13, 7));
    let parent = |e: [u32; 2]| s.segment_parent[s.segments.iter().position(|f| *f == e).unwrap()];
    assert_eq!((parent([0, 2]), parent([6, 7]), parent([0, 1])), (1, 0, INVALID));
}

#[test]
fn a_hole_ring() {
    let points = [[0., 0.], [9., 0.], [9., 9.], [0., 9.], [3., 3.], [6., 3.], [6., 6.], [3., 6.]];
    for hole in [[4, 5, 6, 7], [7, 6, 5, 4]] {
        let s = run(&flat(&points, &[&[0, 1, 2, 3], &hole])).unwrap();
        assert_eq!(area(&s), 2 * (81 - 9));
        assert_eq!((s.segments.len(), s.patch_count), (8, 1));
        let s = run(&flat(&points, &[&[3, 2, 1, 0], &hole])).unwrap();
        assert_eq!(area(&s), -2 * (81 - 9));
    }
}

#[test]
fn holes_that_touch_the_outer_ring_or_another_hole() {
    let points = [[0., 0.], [8., 0.], [8., 8.], [0., 8.], [4., 0.], [2., 4.], [4., 4.], [6., 2.], [6., 6.]];
    // The first hole touches the outer ring inside an edge; the holes share a corner.
    let s = run(&flat(&points, &[&[0, 1, 2, 3], &[4, 6, 5], &[6, 7, 8]])).unwrap();
    assert_eq!(area(&s), 128 - 8 - 8);
}

#[test]
fn seeds_rule() {
    let points = [
        [0., 0.],
        [9., 0.],
        [9., 9.],
        [0., 9.],
        [3., 3.],
        [6., 3.],
        [6., 6.],
        [3., 6.],
        [1., 1.],
        [12., 0.],
        [8., 8.],
    ];
    let mut plc = flat(&points, &[&[0, 1, 2, 3], &[4, 5, 6, 7], &[0, 8], &[1, 9], &[10]]);
    plc.facets[0].interior = Interior::Seeds;
    let s = run(&plc).unwrap();
    assert_eq!(area(&s), 2 * 81);
    assert_eq!(s.patch_count, 2);
    for edge in [[0, 8], [1, 9], [4, 5], [5, 6], [6, 7], [4, 7]] {
        assert!(s.segments.contains(&edge), "{edge:?}");
    }
    assert!(s.triangles.iter().flatten().any(|&v| v == 10));
    assert_eq!(s.segments.len(), 10);
    plc.facets[0].holes = vec![[5., 4., 7.]];
    let s = run(&plc).unwrap();
    assert_eq!(area(&s), 2 * (81 - 9));
    assert_eq!(s.segments.len(), 10);
    plc.facets[0].holes = vec![[3., 4., 0.]];
    assert_eq!(kinds(run(&plc)), [DefectKind::SeedOnFacet]);
    // A polygon that encloses nothing.
    plc.facets[0].polygons = vec![vec![0, 1], vec![1, 2]];
    assert_eq!(kinds(run(&plc)), [DefectKind::DegenerateFacet]);
}

#[test]
fn dangling_edges_and_lone_vertices_in_a_facet() {
    let points = [[0., 0.], [9., 0.], [9., 9.], [0., 9.], [3., 3.], [6., 3.], [2., 7.]];
    let s = run(&flat(&points, &[&[0, 1, 2, 3], &[4, 5], &[6]])).unwrap();
    assert_eq!(area(&s), 162);
    assert_eq!(s.segments.len(), 5);
    assert!(s.segments.contains(&[4, 5]));
    assert!(s.triangles.iter().flatten().any(|&v| v == 6));
}

#[test]
fn nesting_defects() {
    let mut points = vec![[0., 0.], [9., 0.], [9., 9.], [0., 9.], [2., 2.], [7., 2.], [7., 7.], [2., 7.]];
    points.extend([[4., 4.], [5., 4.], [5., 5.], [20., 0.], [21., 0.], [21., 1.]]);
    assert_eq!(
        kinds(run(&flat(&points, &[&[0, 1, 2, 3], &[4, 5, 6, 7], &[8, 9, 10]]))),
        [DefectKind::RingNesting]
    );
    assert_eq!(kinds(run(&flat(&points, &[&[0, 1, 2, 3], &[11, 12, 13]]))), [DefectKind::RingNesting]);
    let error = run(&flat(&points, &[&[0, 1, 2, 3], &[11, 12, 13]])).unwrap_err();
    assert_eq!(error.status, Status::DegenerateFacet);
    assert_eq!(error.defects[0].first, Element::Facet(0));
}

#[test]
fn crossing_rings() {
    let points = [[0., 0.], [4., 0.], [4., 4.], [0., 4.], [2., 2.], [6., 2.], [6., 3.]];
    // A bow tie.
    let error = run(&flat(&points, &[&[0, 2, 1, 3]])).unwrap_err();
    assert_eq!(
        (error.status, error.defects[0].kind),
        (Status::SelfIntersection, DefectKind::RingIntersection)
    );
    assert_eq!(error.defects[0].point, Some([2., 2., 0.]));
    assert_eq!(error.message, "1 defect: 1 ring intersection");
    // A hole across the outer ring.
    assert_eq!(kinds(run(&flat(&points, &[&[0, 1, 2, 3], &[4, 5, 6]]))), [DefectKind::RingIntersection]);
    // A bow tie that crosses itself in a corner.
    assert_eq!(kinds(run(&flat(&points, &[&[0, 4, 2, 1, 4, 3]]))), [DefectKind::RingIntersection]);
    // A ring that winds twice.
    assert_eq!(kinds(run(&flat(&points, &[&[0, 1, 2, 0, 1, 2]]))), [DefectKind::RingIntersection]);
}

#[test]
fn a_corner_inside_an_edge_of_its_own_ring() {
    // Corner 4 pinches the ring on edge (0, 1): two lobes, one region.
    let points = [[0., 0.], [8., 0.], [8., 8.], [0., 8.], [4., 0.]];
    let s = run(&flat(&points, &[&[0, 1, 2, 4, 3]])).unwrap();
    assert_eq!(area(&s), 2 * (16 + 16));
    assert!(s.segments.contains(&[0, 4]) && s.segments.contains(&[1, 4]) && !s.segments.contains(&[0, 1]));
    // A flat corner.
    let s = run(&flat(&points, &[&[0, 4, 1, 2, 3]])).unwrap();
    assert_eq!(area(&s), 128);
    assert_eq!(s.segments.len(), 5);
}

#[test]
fn a_bridge_to_a_hole() {
    let points = [[0., 0.], [9., 0.], [9., 9.], [0., 9.], [3., 3.], [6., 3.], [6., 6.], [3., 6.]];
    let s = run(&flat(&points, &[&[0, 1, 2, 3, 0, 4, 7, 6, 5, 4]])).unwrap();
    assert_eq!(area(&s), 2 * (81 - 9));
    assert_eq!((s.segments.len(), s.patch_count), (8, 1));
}

#[test]
fn non_planar_quad() {
    let plc = Plc {
        points: vec![[0., 0., 0.], [1., 0., 0.25], [1., 1., 0.], [0., 1., 0.25]],
        facets: vec![ring_facet(&[&[0, 1, 2, 3]])],
        ..Plc::default()
    };
    let s = run(&plc).unwrap();
    assert_eq!((s.triangles.len(), s.segments.len(), s.patch_count), (2, 5, 2));
}

#[test]
fn a_polygon_without_valid_projection() {
    // A corkscrew.
    let points = vec![[0., 0., 0.], [4., 1., 9.], [4., 4., 1.], [-3., 1., 6.], [2., -3., 2.], [1., 5., 4.]];
    let plc = Plc { points, facets: vec![ring_facet(&[&[0, 1, 2, 3, 4, 5]])], ..Plc::default() };
    let error = run(&plc).unwrap_err();
    assert_eq!((error.status, error.defects[0].kind), (Status::NonPlanarFacet, DefectKind::NonPlanarFacet));
}

#[test]
fn a_corner_that_lies_on_an_edge_in_projection_only() {
    // Along z, the direction of the normal, corner 4 lies on edge (0, 1), but it is above it.
    let points = vec![[0., 0., 0.], [8., 0., 0.], [8., 8., 0.], [0., 8., 0.], [4., 0., 1.]];
    let mut plc = Plc { points, facets: vec![ring_facet(&[&[0, 1, 2, 4, 3]])], ..Plc::default() };
    let error = run(&plc).unwrap_err();
    assert_eq!((error.status, error.defects[0].first), (Status::NonPlanarFacet, Element::Facet(0)));
    // A corner next to the edge in projection too has a triangulation that keeps the edge.
    plc.points[4][1] = 1.0;
    assert!(run(&plc).unwrap().segments.contains(&[0, 1]));
}

#[test]
fn degenerate_elements() {
    let mut plc = cube_triangles();
    plc.points.extend([[0.5, 0.5, 0.5], [0.5, 0.5, 0.5], [0.25, 0.25, 0.25]]);
    plc.segments = vec![Segment { ends: [8, 9], marker: 0 }, Segment { ends: [3, 3], marker: 0 }];
    plc.triangles.extend([[0, 8, 9], [0, 8, 10], [0, 1, 1]]);
    plc.facets = vec![ring_facet(&[&[0, 10, 8, 9]]), ring_facet(&[]), ring_facet(&[&[8, 9, 8]])];
    let error = run(&plc).unwrap_err();
    assert_eq!((error.status, error.defect_count), (Status::DegenerateFacet, 8));
    assert_eq!(error.message, "8 defects: 2 degenerate segment, 6 degenerate facet");
    assert_eq!(error.defects[0].first, Element::Segment(0));
    assert_eq!(
        error.defects.iter().skip(2).map(|d| d.first).collect::<Vec<_>>(),
        [12, 13, 14, 15, 16, 17].map(Element::Facet)
    );
    let options = Options { max_defects: 3, ..Options::default() };
    let error = check(&plc, &options, &mut Silent).unwrap_err();
    assert_eq!((error.defects.len(), error.defect_count), (3, 8));
}

#[test]
fn duplicate_points_join_the_facets() {
    let mut plc = cube_triangles();
    let corners: Vec<[f64; 3]> = plc
        .triangles
        .iter()
        .flatten()
        .map(|&v| CUBE[v as usize].map(|x| if x == 0. { -x } else { x }))
        .collect();
    plc.points.extend(corners);
    plc.triangles = (0..12).map(|t| [8 + 3 * t, 9 + 3 * t, 10 + 3 * t]).collect();
    let s = run(&plc).unwrap();
    assert_eq!(s.triangles, cube_triangles().triangles);
    assert_eq!((s.segments.len(), s.patch_count), (12, 6));
    assert!(
        s.points[8..].iter().flatten().any(|x| x.to_bits() == (-0.0f64).to_bits()),
        "points are handed on bit for bit"
    );
}

#[test]
fn duplicate_facets() {
    let mut plc = cube_triangles();
    plc.triangles.push([2, 0, 3]);
    let error = run(&plc).unwrap_err();
    assert_eq!((error.status, error.defect_count), (Status::SelfIntersection, 1));
    assert_eq!(error.defects[0].kind, DefectKind::DuplicateFacet);
    assert_eq!(
        (error.defects[0].first, error.defects[0].second),
        (Element::Facet(0), Some(Element::Facet(12)))
    );
}

#[test]
fn wrong_references_and_numbers() {
    let mut plc = cube_triangles();
    plc.triangles[3][1] = 8;
    plc.segments.push(Segment { ends: [0, 99], marker: 0 });
    let error = run(&plc).unwrap_err();
    assert_eq!((error.status, error.defect_count), (Status::IndexOutOfRange, 2));
    plc.points[2][1] = f64::NAN;
    plc.points[5][0] = f64::INFINITY;
    let error = run(&plc).unwrap_err();
    assert_eq!((error.status, error.defect_count), (Status::NonFinitePoint, 4));
    assert_eq!(error.defects[1].first, Element::Point(5));
}

#[test]
fn range_of_coordinates() {
    for k in [-900, 0, 150, 1000] {
        let mut plc = cube_quads();
        let factor = |x: f64| x * 2f64.powi(k / 2) * 2f64.powi(k - k / 2);
        plc.points.iter_mut().flatten().for_each(|x| *x = factor(*x));
        let s = run(&plc).unwrap();
        assert_eq!((s.segments.len(), s.patch_count), (12, 6));
        let back = |x: f64| x * 2f64.powi(-s.scale / 2) * 2f64.powi(-s.scale + s.scale / 2);
        assert!(s.points.iter().flatten().zip(plc.points.iter().flatten()).all(|(x, y)| back(*x) == *y));
    }
    let mut plc = cube_quads();
    plc.points[1][0] = 1e300;
    plc.points[2][0] = 1e-300;
    assert_eq!(run(&plc).unwrap_err().status, Status::CoordinateRange);
}

#[test]
fn random_stars() {
    let mut random = Random(1);
    let mut sizes: Vec<(usize, i64)> = (0..300).map(|i| (3 + i % 40, 3 + (i as i64 % 17))).collect();
    sizes.extend([(1000, 100), (1000, 1 << 20), (10_000, 1 << 26)]);
    for (n, radius) in sizes {
        let points = star(&mut random, n, radius);
        let ring: Vec<u32> = (0..points.len() as u32).collect();
        let s = run(&flat(&points, &[&ring])).unwrap();
        assert_eq!(area(&s), shoelace(&points));
        assert_eq!(s.triangles.len(), points.len() - 2);
        assert_eq!((s.segments.len(), s.patch_count), (points.len(), 1));
    }
}

#[test]
fn a_large_polygon_on_a_tilted_plane() {
    let mut random = Random(7);
    let count = if cfg!(debug_assertions) { 10_000 } else { 100_000 };
    let points = star(&mut random, count, 1 << 24);
    let ring: Vec<u32> = (0..points.len() as u32).collect();
    let mut plc = flat(&points, &[&ring]);
    plc.points.iter_mut().for_each(|p| p[2] = p[0] + 2.0 * p[1]);
    let s = run(&plc).unwrap();
    assert_eq!(s.triangles.len(), points.len() - 2);
    assert_eq!(s.patch_count, 1);
    assert_eq!(area(&s), shoelace(&points));
}

#[test]
fn the_callers_cancel_stops() {
    struct Stop;
    impl crate::progress::Observer for Stop {
        fn progress(&mut self, _: crate::progress::Phase, _: f64) -> std::ops::ControlFlow<()> {
            std::ops::ControlFlow::Break(())
        }
    }
    assert_eq!(
        controlled(Limits::default(), &mut Stop, |control| prepare(
            &cube_quads(),
            &Options::default(),
            control
        ))
        .unwrap_err()
        .status,
        Status::Cancelled
    );
}

#[test]
fn vertices_on_edges_and_in_facets_split_them() {
    for mut plc in [cube_triangles(), cube_quads()] {
        // On edges of the cube, on the diagonals of two squares or inside their triangles, and off the surface.
        plc.points.extend([[0.5, 0., 0.], [0.25, 0., 0.], [0.875, 0., 0.], [0., 0., 0.5]]);
        plc.points.extend([
            [0.5, 0.5, 0.],
            [0.25, 0.25, 0.],
            [0.5, 0.25, 0.],
            [0.25, 0.125, 1.],
            [0.125, 0.25, 1.],
            [0.5; 3],
        ]);
        let s = run(&plc).unwrap();
        assert_eq!((s.segments.len(), s.patch_count), (16, 6));
        // Euler: a closed surface with 17 vertices on it.
        assert_eq!(s.triangles.len(), 2 * 17 - 4);
        assert!(
            s.segments.contains(&[8, 9]) && s.segments.contains(&[8, 10]) && s.segments.contains(&[1, 10])
        );
        let normal = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| s.points[v as usize]);
            (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        };
        for (t, &facet) in s.triangles.iter().zip(&s.triangle_facet) {
            let bottom = facet < plc.facet_count() as u32 / 6;
            let level = t.iter().all(|&v| s.points[v as usize][2] == 0.0);
            assert_eq!(bottom, level);
            assert!(!bottom || normal(t) < 0.0);
        }
    }
}

#[test]
fn a_segment_in_a_facet_becomes_an_edge_of_it() {
    // Across the diagonal between two input triangles; with an end inside the facet; through the whole square.
    let mut plc = cube_triangles();
    plc.points.extend([[0.5, 0.75, 1.], [0., 0.25, 0.], [1., 0.5, 0.]]);
    plc.segments = [[5, 7], [4, 8], [9, 10]].map(|ends| Segment { ends, marker: 0 }).to_vec();
    let error = run(&plc).unwrap_err();
    assert_eq!(error.defects[0].kind, DefectKind::SegmentSegment, "the first two cross");
    plc.segments[1].ends = [7, 8];
    let s = run(&plc).unwrap();
    for (parent, edge) in [[5, 7], [7, 8], [9, 10]].into_iter().enumerate() {
        let at = s.segments.iter().position(|e| *e == edge).unwrap();
        assert_eq!(s.segment_parent[at], parent as u32);
        let sheets = s.triangles.iter().filter(|t| edge.iter().all(|v| t.contains(v))).count();
        assert_eq!(sheets, 2);
    }
    assert_eq!(s.triangles.len(), 2 * 11 - 4);
    assert_eq!(s.patch_count, 8);
    // The same with squares of two markers: the diagonal between them stays, and is crossed.
    plc.triangle_markers = (0..12).collect();
    let error = run(&plc).unwrap_err();
    assert_eq!(error.status, Status::SelfIntersection);
    let pairs: Vec<_> = error.defects.iter().map(|d| (d.kind, d.first, d.second)).collect();
    assert!(pairs.iter().all(|p| p.0 == DefectKind::SegmentSegment));
    assert_eq!(pairs.iter().map(|p| p.1).collect::<Vec<_>>(), [Element::Segment(0), Element::Segment(2)]);
}

#[test]
fn segments_that_overlap_split_each_other() {
    let points = vec![[0., 0., 0.], [4., 0., 0.], [1., 0., 0.], [3., 0., 0.], [0., 1., 1.]];
    let segments = [[1, 0], [2, 3], [3, 4]].map(|ends| Segment { ends, marker: 0 }).to_vec();
    let s = run(&Plc { points, segments, ..Plc::default() }).unwrap();
    assert_eq!(s.segments, [[0, 2], [1, 3], [2, 3], [3, 4]]);
    assert_eq!(s.segment_parent, [0, 0, 0, 2]);
}

#[test]
fn facets_that_meet_in_a_t() {
    // A wall stands on the middle of a floor that has no edge there: its foot is a segment in the floor.
    let points = vec![
        [0., 0., 0.],
        [4., 0., 0.],
        [4., 4., 0.],
        [0., 4., 0.],
        [1., 2., 0.],
        [3., 2., 0.],
        [3., 2., 2.],
        [1., 2., 2.],
    ];
    let mut plc = Plc {
        points,
        facets: vec![ring_facet(&[&[0, 1, 2, 3]]), ring_facet(&[&[4, 5, 6, 7]])],
        ..Plc::default()
    };
    let mut with_edge = plc.clone();
    with_edge.facets[0].polygons.push(vec![4, 5]);
    for plc in [&plc, &with_edge] {
        let s = run(plc).unwrap();
        assert_eq!(s.triangles.iter().filter(|t| t.contains(&4) && t.contains(&5)).count(), 3);
        assert_eq!((s.segments.len(), s.patch_count), (8, 2));
    }
    // A foot that ends beyond the floor at one of its corners, or in a vertex on its edge.
    plc.points[4] = [-1., 0., 0.];
    plc.points[5] = [3., 3., 0.];
    (plc.points[6], plc.points[7]) = ([3., 3., 2.], [-1., 0., 2.]);
    let error = run(&plc).unwrap_err();
    assert_eq!(error.defects[0].kind, DefectKind::FacetFacet);
    assert_eq!(
        (error.defects[0].first, error.defects[0].second),
        (Element::Facet(0), Some(Element::Facet(1)))
    );
    plc.points.push([0., 0.75, 0.]);
    let s = run(&plc).unwrap();
    assert!(s.segments.contains(&[4, 8]) && s.segments.contains(&[5, 8]));
    // A wall that pierces the floor.
    (plc.points[4], plc.points[5]) = ([1., 2., -1.], [3., 2., -1.]);
    (plc.points[6], plc.points[7]) = ([3., 2., 2.], [1., 2., 2.]);
    assert_eq!(run(&plc).unwrap_err().defects[0].kind, DefectKind::FacetFacet);
}

#[test]
fn all_defects_are_reported_together() {
    let mut plc = cube_triangles();
    plc.points.extend([[0.5, 0.25, -1.], [0.5, 0.25, 0.5], [2., 0.25, 0.5], [9., 9., 9.]]);
    plc.triangles.push([8, 9, 10]);
    plc.triangles.push([8, 8, 9]);
    plc.segments.push(Segment { ends: [11, 11], marker: 0 });
    plc.segments.push(Segment { ends: [8, 4], marker: 0 });
    let error = run(&plc).unwrap_err();
    assert_eq!(error.status, Status::SelfIntersection);
    assert!(error
        .defects
        .iter()
        .any(|d| d.kind == DefectKind::DegenerateSegment && d.first == Element::Segment(0)));
    assert!(error
        .defects
        .iter()
        .any(|d| d.kind == DefectKind::DegenerateFacet && d.first == Element::Facet(13)));
    assert!(error
        .defects
        .iter()
        .any(|d| d.kind == DefectKind::FacetFacet && d.second == Some(Element::Facet(12))));
    // Segment 0 is excluded from the test, yet the next one keeps its index.
    assert!(error.defects.iter().any(|d| d.first == Element::Segment(1)));
    assert_eq!(error.defect_count, error.defects.len());
}

#[test]
fn random_vertices_on_a_lattice_conform() {
    let mut random = Random(3);
    let (mut taken, mut refused) = (0, 0);
    for round in 0..60 {
        let size = 4 + round % 9;
        let mut plc = flat(&[], &[]);
        let corner = size as f64;
        plc.points = vec![[0., 0., 0.], [corner, 0., corner], [corner, corner, corner], [0., corner, 0.]];
        plc.facets[0].polygons = vec![vec![0, 1, 2, 3]];
        for _ in 0..3 * size {
            let [x, y] = [0; 2].map(|_: u64| random.below(size + 1) as f64);
            plc.points.push([x, y, x]);
        }
        let s = run(&plc).unwrap();
        assert_eq!(area(&s), 2 * i128::from(size * size));
        assert_eq!(s.patch_count, 1);
        // Segments from vertex to vertex, as long as they do not cross.
        for _ in 0..6 {
            let ends = [0; 2].map(|_: u64| random.below(plc.points.len() as u64) as u32);
            plc.segments.push(Segment { ends, marker: 0 });
            match run(&plc) {
                Ok(s) => {
                    taken += 1;
                    assert_eq!(area(&s), 2 * i128::from(size * size));
                    let edges: Vec<[u32; 2]> =
                        s.triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
                    for &[u, v] in &s.segments {
                        assert!(edges.contains(&[u, v]) || edges.contains(&[v, u]));
                    }
                }
                Err(error) => {
                    assert!(matches!(error.status, Status::SelfIntersection | Status::DegenerateFacet));
                    refused += 1;
                    plc.segments.pop();
                }
            }
        }
    }
    assert!(taken > 200 && refused > 50, "{taken} {refused}");
}

#[test]
fn random_rings_give_a_region_or_a_defect() {
    let mut random = Random(11);
    let (mut regions, mut defects) = (0, 0);
    for round in 0..4000 {
        let size = 2 + round % 7;
        let mut plc = flat(&[], &[]);
        for _ in 0..1 + random.below(3) {
            let first = plc.points.len() as u32;
            let count = 1 + random.below(7) as u32;
            for _ in 0..count {
                let [x, y] = [0; 2].map(|_: u64| random.below(size) as f64);
                plc.points.push([x, y, y]);
            }
            plc.facets[0].polygons.push((first..first + count).collect());
        }
        plc.facets[0].interior = if round % 2 == 0 { Interior::FirstMinusOthers } else { Interior::Seeds };
        plc.facets[0].holes = if round % 8 == 1 { vec![[0.5, 0.25, 0.25]] } else { vec![] };
        match run(&plc) {
            Ok(s) => {
                regions += 1;
                // Counter-clockwise or clockwise, but all alike.
                let sum: i128 = area(&s).abs();
                let parts: i128 = s
                    .triangles
                    .iter()
                    .map(|&t| area(&Surface { triangles: vec![t], ..s.copied().unwrap() }).abs())
                    .sum();
                assert_eq!(sum, parts);
            }
            Err(error) => {
                defects += 1;
                let classes = [Status::DegenerateFacet, Status::SelfIntersection, Status::SeedOutside];
                assert!(classes.contains(&error.status), "{error:?} {plc:?}");
            }
        }
    }
    assert!(regions > 500 && defects > 500, "{regions} {defects}");
}

#[test]
fn an_edge_across_many_triangles() {
    // A plate with close vertices on its long sides, and an edge along its middle: both pseudo-polygons are long.
    let n = 2000u32;
    let mut points: Vec<[f64; 2]> = (0..n).map(|i| [f64::from(i), 0.0]).collect();
    points.extend((0..n).rev().map(|i| [f64::from(i), 4096.0]));
    let ring: Vec<u32> = (0..2 * n).collect();
    points.extend([[0.0, 2048.0], [f64::from(n - 1), 2047.0]]);
    let s = run(&flat(&points, &[&ring, &[2 * n, 2 * n + 1]])).unwrap();
    assert!(s.segments.contains(&[2 * n, 2 * n + 1]));
    assert_eq!(area(&s), 2 * 4096 * i128::from(n - 1));
    // Both ends of the edge lie on the short sides and split them.
    assert_eq!(s.triangles.len() as u32, 2 * n);
}

#[test]
fn random_segments_in_a_facet_are_all_kept() {
    let mut random = Random(5);
    for round in 0..40 {
        let size = 6 + round % 20;
        let corner = size as f64;
        let mut plc = flat(&[[0., 0.], [corner, 0.], [corner, corner], [0., corner]], &[&[0, 1, 2, 3]]);
        // Edges of a random polyline that is monotone in x cannot cross.
        for x in 1..size {
            plc.points.push([x as f64, random.below(size + 1) as f64, 0.0]);
        }
        plc.facets[0].polygons.extend((4..plc.points.len() as u32 - 1).map(|v| vec![v, v + 1]));
        let s = run(&plc).unwrap();
        assert_eq!(area(&s), 2 * i128::from(size * size));
        for v in 4..plc.points.len() as u32 - 1 {
            assert!(s.segments.contains(&[v, v + 1]));
            let sheets = s.triangles.iter().filter(|t| t.contains(&v) && t.contains(&(v + 1))).count();
            assert!(
                sheets == 2
                    || (sheets == 1
                        && [v, v + 1].iter().all(|&v| [0.0, corner].contains(&s.points[v as usize][1])))
            );
        }
    }
}

#[test]
fn names_of_markers_are_sorted_unique_and_one_line() {
    let mut plc = Plc::default();
    for (marker, name) in [(7, " left wall \nmore"), (-3, "inlet"), (7, "right wall"), (2, ""), (0, "rest")] {
        plc.set_marker_name(marker, name).unwrap();
    }
    plc.set_marker_name(0, "  ").unwrap();
    let names: Vec<(i32, &str)> = plc.names.iter().map(|n| (n.marker, n.name.as_str())).collect();
    assert_eq!(names, [(-3, "inlet"), (7, "right wall")]);
    assert_eq!((plc.marker_name(7), plc.marker_name(0)), (Some("right wall"), None));
}

fn limited_check(plc: &Plc, max_defects: usize) -> Result<(), Error> {
    check(plc, &Options { max_defects, ..Options::default() }, &mut Silent).map(|_| ())
}

#[test]
fn a_pair_of_elements_is_one_defect() {
    // A square with an edge inside, crossed by a triangle there: the triangles of both cross, and the edge pierces.
    let mut plc = Plc {
        points: vec![[0., 0., 0.], [4., 0., 0.], [4., 4., 0.], [0., 4., 0.], [1., 1., 0.], [3., 3., 0.]],
        ..Plc::default()
    };
    plc.facets = vec![Facet {
        polygons: vec![vec![0, 1, 2, 3], vec![4, 5]],
        interior: Interior::Seeds,
        ..Facet::default()
    }];
    plc.points.extend([[1.0, 3.0, -1.0], [3.0, 1.0, -1.0], [2.0, 2.0, 2.0]]);
    plc.triangles = vec![[6, 7, 8]];
    let error = limited_check(&plc, 100).unwrap_err();
    assert_eq!((error.defects.len(), error.defect_count), (1, 1), "{:?}", error.defects);
    let defect = error.defects[0];
    assert_eq!(defect.kind, DefectKind::FacetFacet);
    assert_eq!((defect.first, defect.second), (Element::Facet(0), Some(Element::Facet(1))));
    // The same with a limit that leaves nothing to list.
    let error = limited_check(&plc, 0).unwrap_err();
    assert_eq!((error.defects.len(), error.defect_count), (0, 1));
}

#[test]
fn the_point_far_from_most_is_out_of_range() {
    // Small points next to one far point are not at fault.
    let mut plc = Plc { points: vec![[0.1, 0.2, 0.3]; 6], ..Plc::default() };
    plc.points[4] = [0.0, -1e200, 0.0];
    let error = limited_check(&plc, 100).unwrap_err();
    assert_eq!(error.status, Status::CoordinateRange);
    let points: Vec<_> = error.defects.iter().map(|d| (d.first, d.point)).collect();
    assert_eq!(points, [(Element::Point(4), Some(plc.points[4]))]);
    // Nor are large points next to tiny ones; all tiny ones are named.
    plc.points[4] = [1e-200, 0.0, 0.0];
    plc.points[1] = [0.0, 0.0, -1e-300];
    let error = limited_check(&plc, 100).unwrap_err();
    let points: Vec<_> = error.defects.iter().map(|d| d.first).collect();
    assert_eq!(points, [Element::Point(1), Element::Point(4)]);
}
