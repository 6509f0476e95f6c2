use super::*;
use crate::control::Control;
use crate::options::Options;
use crate::output::FacetFlip;
use crate::plc::intersect::{find_intersections, IntersectInput};
use crate::plc::merge::net::net_flips;
use crate::plc::{prepare, RegionSeed, Segment};
use crate::progress::Phase;

/// A tube of `n` strips (full circle), each strip cut into `m` slivers by fans from its ends, coordinates in single precision.
fn tube(n: u32, m: u32) -> Plc {
    let mut plc = Plc::default();
    let at = |i: u32, z: f64| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        // The axis is along no coordinate axis, so that the strips are not exactly planar.
        let (x, y) = (angle.cos(), angle.sin());
        let rotated = [0.36 * x - 0.8 * y + 0.48 * z, 0.48 * x + 0.6 * y + 0.64 * z, 0.6 * z - 0.8 * x];
        rotated.map(|x| f64::from(x as f32))
    };
    for i in 0..n {
        plc.points.extend((0..=m).map(|k| at(i, f64::from(k * k) * 0.37)));
    }
    let id = |i: u32, k: u32| (i % n) * (m + 1) + k;
    for i in 0..n {
        // The whole lower left corner sees the right side, the upper right corner the left one.
        plc.triangles.extend((0..m).map(|k| [id(i, 0), id(i + 1, k), id(i + 1, k + 1)]));
        plc.triangles.extend((0..m).map(|k| [id(i, k), id(i + 1, m), id(i, k + 1)]));
    }
    for z in [0, m] {
        let ring: Vec<u32> = (0..n).map(|i| id(i, z)).collect();
        plc.triangles.extend((2..ring.len()).map(|i| {
            let t = [ring[0], ring[i], ring[i - 1]];
            if z == 0 {
                t
            } else {
                [t[0], t[2], t[1]]
            }
        }));
    }
    plc
}

fn merged(plc: &Plc, degrees: f64) -> Surface {
    prepare(plc, &Options { merge_facets: Some(degrees), ..Options::default() }, &Control::free()).unwrap()
}

/// Two triangles at an edge from (0, 0, 0) to (1, 0, 0), the first opposite vertex at y = 0.1, the other at y = -0.1 and height `z`: the
/// edge is not Delaunay, and the tetrahedron has about the height `z`.
fn sliver(z: f64) -> Plc {
    Plc {
        points: vec![[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.5, 0.1, 0.0], [0.5, -0.1, z]],
        triangles: vec![[0, 1, 2], [1, 0, 3]],
        ..Plc::default()
    }
}

fn sorted(mut corners: [u32; 3]) -> [u32; 3] {
    corners.sort_unstable();
    corners
}

fn defects(surface: &Surface, segments: &[[u32; 2]]) -> usize {
    let vertices: Vec<u32> = (0..surface.points.len() as u32).collect();
    let input = IntersectInput {
        points: &surface.points,
        vertices: &vertices,
        triangles: &surface.triangles,
        triangle_facet: &surface.triangle_facet,
        segments,
    };
    let found = find_intersections(&input, 10, Control::free().whole(Phase::Validate)).unwrap();
    found.defect_count + found.vertex_on_edge.len() + found.vertex_in_triangle.len()
}

#[test]
fn slivers_of_a_tube_are_flipped_and_the_surface_stays_valid() {
    let plc = tube(24, 9);
    let (before, after) = (merged(&plc, 180.0), merged(&plc, 179.9));
    assert!(before.facet_flips.is_empty());
    assert!(after.facet_flips.len() > 24 * 8, "{} flips", after.facet_flips.len());
    assert_eq!(defects(&after, &[]), 0);
    // A closed surface with the same vertices has the same number of triangles, and each edge two of them.
    assert_eq!(after.triangles.len(), plc.triangles.len());
    let mut edges: Vec<[u32; 2]> = after.triangles.iter().flat_map(|&t| edges::sides(t)).collect();
    edges.sort_unstable();
    assert!(edges.windows(2).all(|w| w[0] != w[1]), "the orientation has changed");
    assert!(edges.iter().all(|&[a, b]| edges.binary_search(&[b, a]).is_ok()));
}

#[test]
fn the_result_is_the_same_each_time() {
    let plc = tube(12, 7);
    assert_eq!(merged(&plc, 179.9), merged(&plc, 179.9));
}

#[test]
fn a_sliver_is_flipped_and_told() {
    let surface = merged(&sliver(1e-6), 179.9);
    assert_eq!(surface.facet_flips, [FacetFlip { old: [0, 1], new: [2, 3], facets: [0, 1] }]);
    assert_eq!(surface.triangles, [[2, 0, 3], [3, 1, 2]]);
    assert_eq!(surface.triangle_facet, [0, 1]);
    assert!(surface.segments.contains(&[2, 3]) && !surface.segments.contains(&[0, 1]));
}

#[test]
fn exactly_flat_pairs_are_flipped_only_if_convex() {
    assert_eq!(merged(&sliver(0.0), 179.9).facet_flips.len(), 1);
    let mut reflex = sliver(0.0);
    reflex.points[3] = [-0.5, -0.1, 0.0];
    assert!(merged(&reflex, 179.9).facet_flips.is_empty());
}

#[test]
fn the_bound_holds_before_and_after() {
    // The planes meet at 180 - atan(z / 0.1) degrees before the flip, at about 180 - atan(z / 0.5) after it.
    assert!(merged(&sliver(1e-3), 179.9).facet_flips.is_empty());
    assert_eq!(merged(&sliver(1e-3), 179.0).facet_flips.len(), 1);
    // Almost flat before the flip, but a fold of two needles after it: the ends lie at unequal heights over the new edge.
    let mut fold = sliver(1e-5);
    fold.points[2] = [1e-4, 0.1, 0.0];
    fold.points[3] = [1e-4, -0.1, 1e-5];
    assert!(merged(&fold, 179.9).facet_flips.is_empty());
}

#[test]
fn markers_and_segments_keep_edges() {
    let mut marked = sliver(1e-6);
    marked.triangle_markers = vec![1, 2];
    assert!(merged(&marked, 179.9).facet_flips.is_empty());
    marked.triangle_markers = vec![2, 2];
    assert_eq!(merged(&marked, 179.9).facet_flips.len(), 1);
    let mut kept = sliver(1e-6);
    kept.segments = vec![Segment { ends: [1, 0], marker: 0 }];
    assert!(merged(&kept, 179.9).facet_flips.is_empty());
    // A third triangle at the edge.
    let mut three = sliver(1e-6);
    three.points.push([0.5, 0.0, 1.0]);
    three.triangles.push([0, 1, 4]);
    assert!(merged(&three, 179.9).facet_flips.is_empty());
    // The new edge exists already.
    let mut joined = sliver(1e-6);
    joined.points.push([0.5, 0.0, 1.0]);
    joined.triangles.push([2, 3, 4]);
    assert!(merged(&joined, 179.9).facet_flips.is_empty());
}

#[test]
fn a_flip_passes_over_nothing() {
    let z = 1e-6;
    // The middle of the sliver tetrahedron.
    let inside = [0.5, 0.0, 0.25 * z];
    let mut vertex = sliver(z);
    vertex.points.push(inside);
    assert!(merged(&vertex, 179.9).facet_flips.is_empty(), "an isolated vertex");
    vertex.points[4] = [0.5, 0.0, 0.75 * z];
    assert_eq!(merged(&vertex, 179.9).facet_flips.len(), 1, "a vertex above the tetrahedron");
    let mut hole = sliver(z);
    hole.holes = vec![inside];
    assert!(merged(&hole, 179.9).facet_flips.is_empty(), "a hole seed");
    let mut region = sliver(z);
    region.regions = vec![RegionSeed { point: inside, attribute: 1.0, max_volume: None }];
    assert!(merged(&region, 179.9).facet_flips.is_empty(), "a region seed");
    let mut segment = sliver(z);
    segment.points.extend([inside, [0.5, 0.0, 1.0]]);
    segment.segments = vec![Segment { ends: [4, 5], marker: 0 }];
    assert!(merged(&segment, 179.9).facet_flips.is_empty(), "a segment that ends inside");
    let mut triangle = sliver(z);
    triangle.points.extend([inside, [0.5, 0.3, 1.0], [0.5, -0.3, 1.0]]);
    triangle.triangles.push([4, 5, 6]);
    assert!(merged(&triangle, 179.9).facet_flips.is_empty(), "a triangle that ends inside");
}

#[test]
fn a_flip_does_not_cross_what_has_no_vertex_inside() {
    let z = 1e-6;
    // Enters above the old edge and leaves below the new one: only through the new triangles.
    let across = |low: f64| {
        let mut plc = sliver(z);
        plc.points.extend([[0.4, 0.0, low], [0.6, 0.0, low], [0.5, 0.0, 1.0]]);
        plc.triangles.push([4, 5, 6]);
        plc
    };
    // The new edge is at half the height in the middle.
    assert!(merged(&across(0.45 * z), 179.9).facet_flips.is_empty());
    assert_eq!(merged(&across(0.6 * z), 179.9).facet_flips.len(), 1);
    let mut segment = sliver(z);
    segment.points.extend([[0.0, 0.0, 0.45 * z], [1.0, 0.0, 0.45 * z]]);
    segment.segments = vec![Segment { ends: [4, 5], marker: 0 }];
    assert!(merged(&segment, 179.9).facet_flips.is_empty());
}

#[test]
fn split_triangles_and_polygons_stay() {
    let mut split = sliver(1e-6);
    split.points.push([0.5, 0.05, 0.0]);
    assert!(merged(&split, 179.9).facet_flips.is_empty());
    let mut polygon = sliver(1e-6);
    polygon.triangles.pop();
    let corners = vec![vec![1, 0, 3]];
    polygon.facets = vec![crate::plc::Facet { polygons: corners, ..Default::default() }];
    assert!(merged(&polygon, 179.9).facet_flips.is_empty());
}

#[test]
fn missing_edges_beside_the_surface_are_taken_back() {
    let plc = tube(24, 9);
    let with = |is_edge: &mut dyn FnMut([u32; 2]) -> bool, avoid_all| {
        let mut guide = Guide { is_edge, avoid: &[], avoid_all };
        let mut prepared = crate::plc::check_and_split(&plc, &Options::default(), &Control::free()).unwrap();
        prepared
            .merger(&plc, 179.9, &Control::free())
            .unwrap()
            .run(Some(&mut guide), &Control::free())
            .unwrap();
        prepared.into_surface(&Control::free()).unwrap()
    };
    let all = with(&mut |_| true, false);
    assert!(!all.edges_beside.is_empty());
    // Nothing is an edge: every new edge off the surface is flipped back.
    let back = with(&mut |_| false, false);
    // Only net flips are listed.
    assert!(back.facet_flips.len() < all.facet_flips.len());
    assert!(net_flips(&back.facet_flips, &Control::free()).unwrap() == back.facet_flips);
    // All are unwanted: they are not made.
    let none = with(&mut |_| true, true);
    assert!(none.facet_flips.len() < all.facet_flips.len());
    for surface in [back, none] {
        assert_eq!(surface.edges_beside, Vec::<[u32; 2]>::new());
        assert_eq!(defects(&surface, &[]), 0);
    }
}

#[test]
fn merging_is_taken_up_again() {
    let plc = tube(24, 9);
    let mut prepared = crate::plc::check_and_split(&plc, &Options::default(), &Control::free()).unwrap();
    let mut merger = prepared.merger(&plc, 179.9, &Control::free()).unwrap();
    let mut guide = Guide { is_edge: &mut |_| true, avoid: &[], avoid_all: false };
    merger.run(Some(&mut guide), &Control::free()).unwrap();
    let beside = merger.surface().edges_beside.clone();
    let (unwanted, pinned) = (&beside[..1], &beside[1..]);
    merger.keep(pinned).unwrap();
    let mut guide = Guide { is_edge: &mut |_| true, avoid: unwanted, avoid_all: false };
    merger.run(Some(&mut guide), &Control::free()).unwrap();
    let surface = prepared.into_surface(&Control::free()).unwrap();
    assert!(!surface.edges_beside.contains(&unwanted[0]));
    for edge in pinned {
        assert!(surface.segments.contains(edge), "{edge:?}");
    }
    assert_eq!(defects(&surface, &[]), 0);
}

#[test]
fn flips_and_their_undoing_cancel() {
    let flip = |old, new, facets| FacetFlip { old, new, facets };
    let first = flip([0, 1], [2, 3], [0, 1]);
    let far = flip([10, 11], [12, 13], [5, 6]);
    let net = |list: &[FacetFlip]| net_flips(list, &Control::free()).unwrap();
    assert_eq!(net(&[first, far]), [first, far]);
    // Facet 0 has vertex 2 again: recognized from either facet.
    for back in [flip([2, 3], [0, 1], [0, 1]), flip([3, 2], [1, 0], [1, 0])] {
        assert_eq!(net(&[first, far, back]), [far]);
    }
    // The two facets have swapped places: this undoes nothing.
    let exchanged = flip([3, 2], [0, 1], [0, 1]);
    assert_eq!(net(&[first, exchanged]), [first, exchanged]);
    // One in between at facet 1 keeps both, unless it is undone itself.
    let between = flip([1, 3], [2, 4], [1, 2]);
    let back = flip([2, 3], [0, 1], [0, 1]);
    assert_eq!(net(&[first, between, back]), [first, between, back]);
    assert_eq!(net(&[first, between, far, flip([2, 4], [1, 3], [1, 2]), back]), [far]);
}

#[test]
fn what_is_flipped_back_is_as_it_was() {
    // Every flip undone: each facet has the triangle it was given.
    let plc = tube(24, 9);
    let mut prepared = crate::plc::check_and_split(&plc, &Options::default(), &Control::free()).unwrap();
    let given: Vec<_> = prepared.surface().triangles.iter().map(|&t| sorted(t)).collect();
    let mut merger = prepared.merger(&plc, 179.9, &Control::free()).unwrap();
    let flipper = &mut merger.flipper;
    let mut guide = Guide { is_edge: &mut |_| true, avoid: &[], avoid_all: false };
    flipper.run(Rule::Angles, &mut guide, 1, &Control::free()).unwrap();
    let count = flipper.records.len();
    assert!(count > 100);
    for k in (0..count).rev() {
        let candidate = flipper.candidate(flipper.surface.facet_flips[k].new).unwrap();
        flipper.flip(&candidate).unwrap();
    }
    let surface = prepared.into_surface(&Control::free()).unwrap();
    assert_eq!(surface.facet_flips, []);
    assert_eq!(surface.triangles.iter().map(|&t| sorted(t)).collect::<Vec<_>>(), given);
}
