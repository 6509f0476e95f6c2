//! Hand-made contacts of each kind, the box hierarchy, and the interface.
use super::*;
use crate::control::{controlled, Control, Limits};
use crate::error::{DefectKind, Element, Status};
use crate::progress::{Observer, Phase};
use std::ops::ControlFlow;

/// A PLC with every triangle its own facet and every point a vertex.
#[derive(Clone, Debug, Default)]
pub(super) struct Model {
    pub(super) points: Vec<[f64; 3]>,
    pub(super) triangles: Vec<[u32; 3]>,
    pub(super) segments: Vec<[u32; 2]>,
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
        find_intersections(&input, max_defects, Control::free().whole(Phase::Validate)).unwrap()
    }

    pub(super) fn find(&self) -> Intersections {
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
    assert_eq!(kinds(&model.find()), []);
    assert_eq!(model.find().edge_in_facet, [([0, 3], 1)]);
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
    let found = find_intersections(&input, 10, Control::free().whole(Phase::Validate)).unwrap();
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
fn boxes_at_the_ends_of_the_range_still_meet() {
    // Only the boxes are tested at the very ends; the signs are exact in the range of the predicates.
    for size in [f64::MAX, 1e100, 1.0, 1e-100, 5e-324] {
        let at = |x: f64, y: f64, z: f64| [x * size, y * size, z * size];
        let points = [at(-1.0, -1.0, -1.0), at(1.0, 1.0, 1.0), at(1.0, 0.0, -1.0), at(1.0, 1.0, 0.0)];
        let frame = Frame::of(points.iter());
        let bounds = [frame.bounds(points[..2].iter()), frame.bounds(points[2..].iter())];
        let mut pairs = vec![];
        let visited = BoxTree::new(&bounds, Fans::default(), &Control::free()).unwrap().for_each_pair(
            &Control::free(),
            |i, j, _| {
                pairs.push((i.min(j), i.max(j)));
                Ok(())
            },
        );
        visited.unwrap();
        assert_eq!(pairs, [(0, 1)], "size {size}");
    }
}

#[test]
fn all_meeting_boxes_are_found_once() {
    let mut random = Random(4);
    let points: Vec<[f64; 3]> =
        (0..600).map(|_| std::array::from_fn(|_| random.below(40) as f64 / 7.0)).collect();
    let frame = Frame::of(points.iter());
    let pieces: Vec<&[[f64; 3]]> = (0..299).map(|i| &points[2 * i..2 * i + 1 + i % 2]).collect();
    let bounds: Vec<Bounds> = pieces.iter().map(|p| frame.bounds(p.iter())).collect();
    let tree = BoxTree::new(&bounds, Fans::default(), &Control::free()).unwrap();
    let mut found = vec![];
    let place = |i: usize| tree.order()[i] as usize;
    let visited = tree.for_each_pair(&Control::free(), |i, j, _| {
        found.push((place(i).min(place(j)), place(i).max(place(j))));
        Ok(())
    });
    visited.unwrap();
    found.sort();
    let range = |i: usize, k: usize| {
        let x = || pieces[i].iter().map(|p| p[k]);
        (x().fold(f64::INFINITY, f64::min), x().fold(f64::NEG_INFINITY, f64::max))
    };
    let meet =
        |i: usize, j: usize| (0..3).all(|k| range(i, k).0 <= range(j, k).1 && range(j, k).0 <= range(i, k).1);
    let pairs = (0..pieces.len()).flat_map(|i| (i + 1..pieces.len()).map(move |j| (i, j)));
    let expected: Vec<_> = pairs.filter(|&(i, j)| meet(i, j)).collect();
    assert!(expected.len() > 1000);
    assert_eq!(found, expected);
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
    assert_eq!(
        find_intersections(&input, 1, Control::free().whole(Phase::Validate)).unwrap_err().status,
        Status::IndexOutOfRange
    );
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
    let find = |watch: &mut Watch| {
        controlled(Limits::default(), watch, |control| {
            find_intersections(&input, 1, control.whole(Phase::Validate))
        })
    };
    let found = find(&mut watch).unwrap();
    assert_eq!(found, Intersections::default());
    assert!(watch.0.len() > 3 && watch.0.windows(2).all(|w| w[0] <= w[1]), "{:?}", watch.0);
    let error = find(&mut Watch(vec![], 2)).unwrap_err();
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

/// A small reproducible generator (Knuth's MMIX constants).
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((self.0 >> 33) % n as u64) as usize
    }
}
