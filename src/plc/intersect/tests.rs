//! Hand-made contacts of each kind, and random soups on small grids against an oracle in exact rationals.
//!
//! The oracle clips one element against the half-spaces that bound the other and judges the common set itself; it shares no code
//! and no case analysis with the tested module.
use super::*;
use crate::error::{DefectKind, Element, Status};
use crate::progress::Silent;
use num_rational::Ratio;
use num_traits::{Signed, Zero};
use std::collections::BTreeSet;
use std::ops::ControlFlow;

/// A PLC with every triangle its own facet and every point a vertex.
#[derive(Clone, Debug, Default)]
struct Model {
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    segments: Vec<[u32; 2]>,
}

impl Model {
    fn find_up_to(&self, max_defects: usize) -> Intersections {
        let vertices: Vec<u32> = (0..self.points.len() as u32).collect();
        let facets: Vec<u32> = (0..self.triangles.len() as u32).collect();
        let input = IntersectInput {
            points: &self.points,
            vertices: &vertices,
            triangles: &self.triangles,
            triangle_facet: &facets,
            segments: &self.segments,
        };
        find_intersections(&input, max_defects, &mut Silent).unwrap()
    }

    fn find(&self) -> Intersections {
        self.find_up_to(usize::MAX)
    }
}

/// One lower triangle in z = 0 with corners 0, 1, 2, and more points.
fn with_base(more: &[[f64; 3]]) -> Model {
    let mut points = vec![[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0]];
    points.extend(more);
    Model { points, triangles: vec![[0, 1, 2]], segments: vec![] }
}

fn kinds(found: &Intersections) -> Vec<DefectKind> {
    assert_eq!(found.defect_count, found.defects.len());
    found.defects.iter().map(|d| d.kind).collect()
}

#[test]
fn neighbours_of_a_closed_surface_are_legal() {
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
    let model = Model { points, triangles, segments: vec![[0, 1], [2, 3]] };
    assert_eq!(model.find(), Intersections::default());
}

#[test]
fn an_edge_through_a_triangle_is_a_facet_crossing_with_its_point() {
    // Common vertex 0, so the crossing begins there and has one other end.
    let mut model = with_base(&[[2.0, 2.0, -1.0], [2.0, 2.0, 1.0]]);
    model.triangles.push([0, 3, 4]);
    let found = model.find();
    assert_eq!(kinds(&found), [DefectKind::FacetFacet]);
    assert_eq!(
        (found.defects[0].first, found.defects[0].second),
        (Element::Facet(0), Some(Element::Facet(1)))
    );
    assert_eq!(found.defects[0].point, Some([2.0, 2.0, 0.0]));
}

#[test]
fn edge_across_edge_is_a_facet_crossing() {
    let mut model = with_base(&[[4.0, 0.0, -1.0], [4.0, 0.0, 1.0], [4.0, -5.0, 0.0]]);
    model.triangles.push([3, 4, 5]);
    assert_eq!(kinds(&model.find()), [DefectKind::FacetFacet]);
}

#[test]
fn vertices_split_triangles_edges_and_segments() {
    let mut model = with_base(&[
        [2.0, 2.0, 0.0],
        [2.0, 2.0, 3.0],
        [3.0, 2.0, 3.0],
        [4.0, 0.0, 0.0],
        [4.0, -2.0, 1.0],
        [4.0, -2.0, -1.0],
        [0.0, 3.0, 0.0],
        [1.0, 1.0, 0.0],
        [-1.0, -1.0, 0.0],
        [-4.0, -4.0, 0.0],
    ]);
    model.triangles.extend([[3, 4, 5], [6, 7, 8]]);
    model.segments = vec![[0, 12]];
    let found = model.find();
    assert_eq!(kinds(&found), []);
    assert_eq!(found.vertex_in_triangle, [(0, 3), (0, 10)]);
    assert_eq!(found.vertex_on_edge, [([0, 1], 6), ([0, 2], 9)]);
    assert_eq!(found.vertex_on_segment, [(0, 11)]);
}

#[test]
fn a_common_vertex_does_not_hide_a_crossing() {
    // Common vertex 0; the opposite edge of the second pierces the first.
    let mut model = with_base(&[[2.0, 3.0, -1.0], [4.0, 1.0, 1.0]]);
    model.triangles.push([0, 3, 4]);
    assert_eq!(kinds(&model.find()), [DefectKind::FacetFacet]);
    // An edge through the common vertex that runs inside the first triangle.
    let mut model = with_base(&[[2.0, 2.0, 0.0], [1.0, 1.0, 5.0]]);
    model.triangles.push([0, 3, 4]);
    assert_eq!(kinds(&model.find()), [DefectKind::FacetFacet]);
    // The same edge outside.
    let mut model = with_base(&[[-2.0, -2.0, 0.0], [-1.0, -1.0, 5.0]]);
    model.triangles.push([0, 3, 4]);
    assert_eq!(model.find(), Intersections::default());
}

#[test]
fn vertices_at_both_ends_do_not_hide_a_crossing_between_them() {
    // Corner 3 of the second lies in the first, corner 1 of the first in the second.
    let mut model = with_base(&[[2.0, 2.0, 0.0], [14.0, -2.0, 4.0], [14.0, -2.0, -4.0]]);
    model.triangles.push([3, 4, 5]);
    let found = model.find();
    assert_eq!(kinds(&found), [DefectKind::FacetFacet]);
    assert_eq!(found.vertex_in_triangle, [(0, 3), (1, 1)]);
}

#[test]
fn folds_overlaps_and_duplicates() {
    let mut model = with_base(&[[1.0, 1.0, 0.0], [8.0, 8.0, 0.0]]);
    model.triangles.extend([[1, 0, 3], [2, 1, 4], [1, 2, 0]]);
    let found = model.find();
    use DefectKind::{DuplicateFacet, Overlap};
    assert_eq!(kinds(&found), [Overlap, DuplicateFacet, Overlap]);
    let pairs: Vec<_> = found.defects.iter().map(|d| (d.first, d.second.unwrap())).collect();
    let facet = Element::Facet;
    assert_eq!(pairs, [(facet(0), facet(1)), (facet(0), facet(3)), (facet(1), facet(3))]);
}

#[test]
fn overlapping_collinear_edges_split_each_other() {
    let mut model = with_base(&[[4.0, 0.0, 0.0], [12.0, 0.0, 0.0], [5.0, -3.0, 2.0]]);
    model.triangles.push([3, 4, 5]);
    let found = model.find();
    assert_eq!(kinds(&found), []);
    assert_eq!(found.vertex_on_edge, [([0, 1], 3), ([3, 4], 1)]);
}

#[test]
fn segments_pierce_cross_and_touch() {
    let mut model = with_base(&[[1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [4.0, -1.0, -1.0], [4.0, 1.0, 1.0]]);
    model.segments = vec![[3, 4], [5, 6]];
    let found = model.find();
    assert_eq!(kinds(&found), [DefectKind::SegmentFacet, DefectKind::SegmentSegment]);
    assert_eq!(found.defects[0].point, Some([1.0, 1.0, 0.0]));
    assert_eq!(found.defects[1].point, Some([4.0, 0.0, 0.0]));
    assert_eq!(found.defects[1].second, Some(Element::Facet(0)));
}

#[test]
fn crossing_and_overlapping_segments() {
    let points = vec![[0.0; 3], [2.0, 2.0, 2.0], [2.0, 0.0, 0.0], [0.0, 2.0, 2.0], [1.0, 1.0, 5.0], [4.0; 3]];
    let model = Model { points, triangles: vec![], segments: vec![[0, 1], [2, 3], [3, 4], [0, 5], [1, 0]] };
    let found = model.find();
    assert_eq!(kinds(&found), [DefectKind::SegmentSegment; 3]);
    assert_eq!(found.vertex_on_segment, [(3, 1)]);
    assert_eq!(found.defects[0].point, Some([1.0, 1.0, 1.0]));
}

#[test]
fn a_segment_in_a_flat_patch_is_legal_and_across_a_ridge_is_not() {
    // Two coplanar triangles with diagonal 1–2, and the other diagonal as a segment.
    let mut model = with_base(&[[8.0, 8.0, 0.0]]);
    model.triangles.push([2, 1, 3]);
    model.segments = vec![[0, 3]];
    let found = model.find();
    assert_eq!(kinds(&found), []);
    assert_eq!(found.segment_in_facet, [(0, 0), (0, 1)]);
    // A third triangle at the diagonal, in another plane.
    model.points.push([5.0, 5.0, 5.0]);
    model.triangles.push([1, 2, 4]);
    assert_eq!(kinds(&model.find()), [DefectKind::SegmentSegment]);
    // Only one triangle at the diagonal.
    model.triangles.truncate(1);
    assert_eq!(kinds(&model.find()), [DefectKind::SegmentSegment]);
}

#[test]
fn one_defect_per_pair_of_polygon_facets() {
    // Two squares of two triangles each that cross in a line.
    let points = vec![
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
        [1.0, 2.0, -1.0],
        [3.0, 2.0, -1.0],
        [3.0, 2.0, 1.0],
        [1.0, 2.0, 1.0],
    ];
    let triangles = [[0, 1, 2], [0, 2, 3], [4, 5, 6], [4, 6, 7]];
    let vertices: Vec<u32> = (0..8).collect();
    let input = IntersectInput {
        points: &points,
        vertices: &vertices,
        triangles: &triangles,
        triangle_facet: &[7, 7, 5, 5],
        segments: &[],
    };
    let found = find_intersections(&input, 10, &mut Silent).unwrap();
    assert_eq!(found.defect_count, 1);
    assert_eq!(
        (found.defects[0].first, found.defects[0].second),
        (Element::Facet(5), Some(Element::Facet(7)))
    );
}

#[test]
fn the_limit_cuts_the_list_and_not_the_count() {
    // A comb of parallel triangles, all pierced by one.
    let mut model = with_base(&[]);
    for i in 0..50 {
        let x = 0.1 + 0.1 * f64::from(i);
        let first = model.points.len() as u32;
        model.points.extend([[x, 1.0, -1.0], [x, 1.0, 1.0], [x, -9.0, 0.0]]);
        model.triangles.push([first, first + 1, first + 2]);
    }
    let (all, some) = (model.find(), model.find_up_to(7));
    assert_eq!((all.defect_count, all.defects.len()), (50, 50));
    assert_eq!((some.defect_count, some.defects.len()), (50, 7));
    assert_eq!(some.defects, all.defects[..7]);
    assert_eq!(model.find_up_to(0).defect_count, 50);
}

#[test]
fn empty_and_wrong_input() {
    assert_eq!(Model::default().find(), Intersections::default());
    let input = IntersectInput {
        points: &[[0.0; 3]],
        vertices: &[0],
        triangles: &[[0, 1, 2]],
        triangle_facet: &[0],
        segments: &[],
    };
    assert_eq!(find_intersections(&input, 1, &mut Silent).unwrap_err().status, Status::IndexOutOfRange);
}

#[test]
fn the_observer_cancels_and_sees_growing_fractions() {
    struct Watch(Vec<f64>, usize);
    impl Observer for Watch {
        fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
            assert_eq!(phase, Phase::Validate);
            self.0.push(fraction);
            if self.0.len() > self.1 {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        }
    }
    let model = grid_surface(100);
    let vertices: Vec<u32> = (0..model.points.len() as u32).collect();
    let facets = vec![0; model.triangles.len()];
    let input = IntersectInput {
        points: &model.points,
        vertices: &vertices,
        triangles: &model.triangles,
        triangle_facet: &facets,
        segments: &[],
    };
    let mut watch = Watch(vec![], usize::MAX);
    let found = find_intersections(&input, 1, &mut watch).unwrap();
    assert_eq!(found, Intersections::default());
    assert!(watch.0.len() > 3 && watch.0.windows(2).all(|w| w[0] <= w[1]), "{:?}", watch.0);
    let error = find_intersections(&input, 1, &mut Watch(vec![], 2)).unwrap_err();
    assert_eq!(error.status, Status::Cancelled);
}

/// A bumpy height field of 2·n² triangles.
fn grid_surface(n: u32) -> Model {
    let mut model = Model::default();
    for i in 0..=n {
        for j in 0..=n {
            model.points.push([f64::from(i), f64::from(j), f64::from((i * i + 3 * j) % 7)]);
        }
    }
    for i in 0..n {
        for j in 0..n {
            let v = i * (n + 1) + j;
            model.triangles.extend([[v, v + 1, v + n + 2], [v, v + n + 2, v + n + 1]]);
        }
    }
    model
}

// ---------------------------------------------------------------------------------------------------------------- oracle

type Q = Ratio<i128>;
type P = [Q; 3];

fn exact(p: &[f64; 3]) -> P {
    p.map(|x| Q::from_integer(x as i128))
}

fn sub(a: &P, b: &P) -> P {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: &P, b: &P) -> P {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn dot(a: &P, b: &P) -> Q {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn is_zero(a: &P) -> bool {
    a.iter().all(Q::is_zero)
}

/// The part of a convex polygon (also of two corners or one) where `normal · (x − origin) ≥ 0`.
fn clip(polygon: &[P], origin: &P, normal: &P) -> Vec<P> {
    let height = |p: &P| dot(normal, &sub(p, origin));
    let mut kept = Vec::new();
    for (i, p) in polygon.iter().enumerate() {
        let q = &polygon[(i + 1) % polygon.len()];
        let (hp, hq) = (height(p), height(q));
        if !hp.is_negative() {
            kept.push(*p);
        }
        if (hp * hq).is_negative() {
            let t = hp / (hp - hq);
            kept.push(std::array::from_fn(|k| p[k] + t * (q[k] - p[k])));
        }
    }
    kept
}

/// The distinct corners of the part of `polygon` on triangle `t`.
fn common_part(polygon: &[P], t: &[P; 3]) -> Vec<P> {
    let normal = cross(&sub(&t[1], &t[0]), &sub(&t[2], &t[0]));
    let mut part = clip(polygon, &t[0], &normal);
    part = clip(&part, &t[0], &normal.map(|x| -x));
    for k in 0..3 {
        let inward = cross(&normal, &sub(&t[(k + 1) % 3], &t[k]));
        part = clip(&part, &t[k], &inward);
    }
    part.sort();
    part.dedup();
    part
}

/// Whether `p` is on the closed segment.
fn on_segment(p: &P, a: &P, b: &P) -> bool {
    is_zero(&cross(&sub(b, a), &sub(p, a))) && !dot(&sub(p, a), &sub(p, b)).is_positive()
}

fn inside_segment(p: &P, a: &P, b: &P) -> bool {
    p != a && p != b && on_segment(p, a, b)
}

fn collinear(part: &[P]) -> bool {
    part.iter().all(|p| is_zero(&cross(&sub(&part[1], &part[0]), &sub(p, &part[0]))))
}

fn in_an_edge(part: &[P], t: &[P; 3]) -> bool {
    (0..3).any(|k| part.iter().all(|p| on_segment(p, &t[k], &t[(k + 1) % 3])))
}

/// The defect of two triangles, if any, from their common set.
fn judge_triangles(a: &[P; 3], b: &[P; 3]) -> Option<DefectKind> {
    let part = common_part(a, b);
    match part.len() {
        0 => None,
        1 => (!a.contains(&part[0]) && !b.contains(&part[0])).then_some(DefectKind::FacetFacet),
        _ if collinear(&part) => {
            (!(in_an_edge(&part, a) && in_an_edge(&part, b))).then_some(DefectKind::FacetFacet)
        }
        _ if a.iter().all(|p| b.contains(p)) => Some(DefectKind::DuplicateFacet),
        _ => Some(DefectKind::Overlap),
    }
}

type Found = BTreeSet<(DefectKind, Element, Element)>;

/// The point inside both of two segments that are not collinear.
fn proper_crossing(a: &P, b: &P, c: &P, d: &P) -> Option<P> {
    let (u, v) = (sub(b, a), sub(d, c));
    let normal = cross(&u, &v);
    if is_zero(&normal) || !dot(&normal, &sub(c, a)).is_zero() {
        return None;
    }
    let t = dot(&cross(&sub(c, a), &v), &normal) / dot(&normal, &normal);
    let x = std::array::from_fn(|k| a[k] + t * u[k]);
    (inside_segment(&x, a, b) && inside_segment(&x, c, d)).then_some(x)
}

/// Everything that `find` must report about a model with integer coordinates.
fn expected(model: &Model) -> (Found, Intersections) {
    let points: Vec<P> = model.points.iter().map(exact).collect();
    let triangles: Vec<[P; 3]> = model.triangles.iter().map(|t| t.map(|v| points[v as usize])).collect();
    let segments: Vec<[P; 2]> = model.segments.iter().map(|s| s.map(|v| points[v as usize])).collect();
    let (mut defects, mut lists) = (Found::new(), Intersections::default());
    for (i, a) in triangles.iter().enumerate() {
        for (j, b) in triangles.iter().enumerate().skip(i + 1) {
            if let Some(kind) = judge_triangles(a, b) {
                defects.insert((kind, Element::Facet(i as u32), Element::Facet(j as u32)));
            }
        }
        for (v, p) in points.iter().enumerate() {
            if common_part(&[*p], a).is_empty() || a.contains(p) {
                continue;
            }
            match (0..3).find(|&k| on_segment(p, &a[k], &a[(k + 1) % 3])) {
                None => lists.vertex_in_triangle.push((i as u32, v as u32)),
                Some(k) => {
                    let mut edge = [model.triangles[i][k], model.triangles[i][(k + 1) % 3]];
                    edge.sort();
                    lists.vertex_on_edge.push((edge, v as u32));
                }
            }
        }
    }
    lists.vertex_on_edge.sort();
    lists.vertex_on_edge.dedup();
    for (i, s) in segments.iter().enumerate() {
        expect_segment(model, &points, &triangles, &segments, i, s, &mut defects, &mut lists);
    }
    (defects, lists)
}

#[allow(clippy::too_many_arguments)]
fn expect_segment(
    model: &Model,
    points: &[P],
    triangles: &[[P; 3]],
    segments: &[[P; 2]],
    i: usize,
    s: &[P; 2],
    defects: &mut Found,
    lists: &mut Intersections,
) {
    let id = Element::Segment(i as u32);
    for (v, p) in points.iter().enumerate() {
        if inside_segment(p, &s[0], &s[1]) {
            lists.vertex_on_segment.push((i as u32, v as u32));
        }
    }
    for (j, t) in segments.iter().enumerate().skip(i + 1) {
        if proper_crossing(&s[0], &s[1], &t[0], &t[1]).is_some() {
            defects.insert((DefectKind::SegmentSegment, id, Element::Segment(j as u32)));
        }
    }
    for (j, t) in triangles.iter().enumerate() {
        let part = common_part(s, t);
        if part.len() == 2 && !in_an_edge(&part, t) {
            lists.segment_in_facet.push((i as u32, j as u32));
        }
        if part.len() == 1 && !s.contains(&part[0]) && !t.contains(&part[0]) && !in_an_edge(&part, t) {
            defects.insert((DefectKind::SegmentFacet, id, Element::Facet(j as u32)));
        }
        for k in 0..3 {
            if proper_crossing(&s[0], &s[1], &t[k], &t[(k + 1) % 3]).is_none() {
                continue;
            }
            let ends = [model.triangles[j][k], model.triangles[j][(k + 1) % 3]];
            let around: Vec<usize> = (0..triangles.len())
                .filter(|&n| ends.iter().all(|v| model.triangles[n].contains(v)))
                .collect();
            let coplanar = |n: &usize| {
                let t = &triangles[*n];
                let normal = cross(&sub(&t[1], &t[0]), &sub(&t[2], &t[0]));
                s.iter().all(|p| dot(&normal, &sub(p, &t[0])).is_zero())
            };
            if around.len() < 2 || !around.iter().all(coplanar) {
                defects.insert((DefectKind::SegmentSegment, id, Element::Facet(around[0] as u32)));
            }
        }
    }
}

/// A small reproducible generator (Knuth's MMIX constants).
struct Random(u64);

impl Random {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) % n as u64) as usize
    }
}

/// Distinct grid points, and random non-degenerate elements on them.
fn soup(random: &mut Random, size: [usize; 3], points: usize, triangles: usize, segments: usize) -> Model {
    let mut chosen = BTreeSet::new();
    while chosen.len() < points {
        chosen.insert(size.map(|n| random.below(n)));
    }
    let mut model = Model::default();
    model.points.extend(chosen.iter().map(|p| p.map(|x| x as f64)));
    while model.triangles.len() < triangles {
        let t: [u32; 3] = std::array::from_fn(|_| random.below(points) as u32);
        let [a, b, c] = t.map(|v| exact(&model.points[v as usize]));
        if !is_zero(&cross(&sub(&b, &a), &sub(&c, &a))) {
            model.triangles.push(t);
        }
    }
    while model.segments.len() < segments {
        let s: [u32; 2] = std::array::from_fn(|_| random.below(points) as u32);
        if s[0] != s[1] {
            model.segments.push(s);
        }
    }
    model
}

fn compare(model: &Model) {
    let found = model.find();
    let (defects, lists) = expected(model);
    let seen: Found = found.defects.iter().map(|d| (d.kind, d.first, d.second.unwrap())).collect();
    assert_eq!(seen, defects, "{model:?}");
    assert_eq!(found.defect_count, defects.len(), "{model:?}");
    assert_eq!(found.vertex_on_segment, lists.vertex_on_segment, "{model:?}");
    assert_eq!(found.vertex_on_edge, lists.vertex_on_edge, "{model:?}");
    assert_eq!(found.vertex_in_triangle, lists.vertex_in_triangle, "{model:?}");
    assert_eq!(found.segment_in_facet, lists.segment_in_facet, "{model:?}");
}

#[test]
fn random_soups_agree_with_the_oracle() {
    let mut random = Random(1);
    for _ in 0..60 {
        compare(&soup(&mut random, [3, 3, 3], 12, 8, 4));
        compare(&soup(&mut random, [5, 5, 5], 16, 10, 6));
        compare(&soup(&mut random, [4, 4, 2], 14, 8, 4));
        compare(&soup(&mut random, [5, 5, 1], 12, 6, 4));
    }
}

#[test]
fn pairs_of_triangles_agree_with_the_oracle() {
    let mut random = Random(2);
    for _ in 0..1500 {
        compare(&soup(&mut random, [3, 3, 2], 5, 2, 0));
        compare(&soup(&mut random, [4, 4, 4], 6, 2, 1));
    }
}

#[test]
fn a_large_soup_agrees_with_the_oracle() {
    // Deep enough for a tree of several levels, small triangles and a few large ones.
    let mut random = Random(3);
    let mut model = soup(&mut random, [12, 12, 12], 60, 5, 3);
    for _ in 0..70 {
        let near = [random.below(9), random.below(9), random.below(9)];
        let small = soup(&mut random, [3, 3, 3], 4, 1, 1);
        let mut add = |v: u32| -> u32 {
            let p = std::array::from_fn(|k| small.points[v as usize][k] + near[k] as f64);
            let position = model.points.iter().position(|q| *q == p);
            position.unwrap_or_else(|| {
                model.points.push(p);
                model.points.len() - 1
            }) as u32
        };
        let (t, s) = (small.triangles[0].map(&mut add), small.segments[0].map(&mut add));
        model.triangles.push(t);
        model.segments.push(s);
    }
    compare(&model);
}
