//! Flips on random meshes: removed edges are absent, undone flips restore the mesh, and the mesh is always valid.
use crate::control::Control;
use crate::delaunay::Construction;
use crate::kernel::cavity::Edges;
use crate::kernel::check::check_topology;
use crate::kernel::edge_key;
use crate::kernel::replace::Replace;
use crate::kernel::Mesh;
use crate::ops::flip::{Flips, Limits, Site};
use crate::predicates::{Points, Sign};
use crate::preserve::recover::breakpoint::breakpoint;
use crate::preserve::recover::corridor::Feature;
use crate::preserve::recover::edges::{Recovery, ROUNDS};
use crate::segments::recovery::Segments;

/// Points on a small grid, in a fixed random order: many are coplanar.
fn grid(seed: u64, count: usize, side: u64) -> (Mesh, Points) {
    let mut state = seed;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        ((state >> 33) % side) as f64
    };
    let mut xyz: Vec<[f64; 3]> = (0..count).map(|_| [next(), next(), next()]).collect();
    xyz.sort_by(|a, b| a.partial_cmp(b).unwrap());
    xyz.dedup();
    let points = Points::new(xyz);
    (Construction::of(&points), points)
}

/// The tetrahedra, as sorted corners in order.
fn tets(mesh: &Mesh) -> Vec<[u32; 4]> {
    let live = (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t));
    let mut all: Vec<[u32; 4]> = live
        .map(|t| {
            let mut v = mesh.verts(t);
            v.sort_unstable();
            v
        })
        .collect();
    all.sort_unstable();
    all
}

fn edges(mesh: &Mesh) -> Vec<[u32; 2]> {
    let mut all: Vec<[u32; 2]> = (0..mesh.slot_count() as u32)
        .filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t))
        .flat_map(|t| {
            let [a, b, c, d] = mesh.verts(t);
            [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]].map(|e| edge_key(e[0], e[1]))
        })
        .collect();
    all.sort_unstable();
    all.dedup();
    all
}

fn check(mesh: &Mesh, points: &Points) {
    check_topology(mesh).unwrap();
    for t in (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)) {
        let [a, b, c, d] = mesh.verts(t);
        assert_eq!(points.orient3d(a, b, c, d), Sign::Positive);
    }
}

#[test]
fn edges_are_removed_or_nothing_changes() {
    let (mut shallow, mut deep) = (0, 0);
    for (seed, side) in [(1, 6), (2, 8), (3, 1000)] {
        for depth in [0, 4] {
            let (mut mesh, points) = grid(seed, 120, side);
            let (mut replace, mut flips) = (Replace::default(), Flips::default());
            // Every fifth edge is constrained.
            let all = edges(&mesh);
            let kept: Edges = all.iter().copied().step_by(5).collect();
            for &edge in &all {
                if !edges(&mesh).contains(&edge) {
                    continue;
                }
                let before = tets(&mesh);
                let control = &Control::free();
                let mut site =
                    Site { mesh: &mut mesh, points: &points, edges: &kept, replace: &mut replace, control };
                let gone = flips.remove(&mut site, edge, None, Limits { depth, rings: 300 }).unwrap();
                check(&mesh, &points);
                let now = edges(&mesh);
                assert!(kept.iter().all(|e| now.binary_search(e).is_ok()));
                assert_eq!(gone, now.binary_search(&edge).is_err());
                if !gone {
                    assert_eq!(tets(&mesh), before);
                    continue;
                }
                *if depth == 0 { &mut shallow } else { &mut deep } += 1;
                let control = &Control::free();
                let mut site =
                    Site { mesh: &mut mesh, points: &points, edges: &kept, replace: &mut replace, control };
                flips.take_back(&mut site).unwrap();
                check(&mesh, &points);
                assert_eq!(tets(&mesh), before);
            }
        }
    }
    assert!(shallow > 0 && 3 * deep > 4 * shallow, "{shallow} at once, {deep} with others first");
}

#[test]
fn an_edge_is_exchanged_for_one_that_crosses_it() {
    // A short upright edge 0 1 within a ring of 22 vertices: 2 and 13 face each other.
    let mut xyz = vec![[0.0, 0.0, -0.5], [0.0, 0.0, 0.5]];
    xyz.extend((0..22).map(|k| {
        let angle = f64::from(k % 11) * std::f64::consts::PI / 11.0;
        let r = if k < 11 { 1.5 } else { -1.5 };
        [r * angle.cos(), r * angle.sin(), 0.0]
    }));
    let points = Points::new(xyz);
    let mut mesh = Construction::of(&points);
    let (old, new) = ([0, 1], [2, 13]);
    assert!(edges(&mesh).contains(&old));
    let (mut replace, mut flips, kept) = (Replace::default(), Flips::default(), Edges::default());
    let control = &Control::free();
    let mut site = Site { mesh: &mut mesh, points: &points, edges: &kept, replace: &mut replace, control };
    assert!(flips.exchange(&mut site, old, new).unwrap());
    check(&mesh, &points);
    let now = edges(&mesh);
    assert!(now.contains(&new) && !now.contains(&old));
}

#[test]
fn a_point_goes_into_the_longest_inner_stretch_or_beside_the_only_edge() {
    let mut xyz = vec![[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]];
    for x in [1.0, 2.0, 6.0, 9.0] {
        xyz.extend([[x, -1.0, -1.0], [x, 1.0, -1.0], [x, 0.0, 2.0]]);
    }
    xyz.extend([[8.0, -1.0, 0.0], [8.0, 3.0, 0.0]]);
    let points = Points::new(xyz);
    let face = |k: u32| Feature::Face([2 + 3 * k, 3 + 3 * k, 4 + 3 * k]);
    let mut places = Vec::new();
    let mut at = |features: &[Feature]| {
        (1e6 * breakpoint(&points, [0, 1], features, &mut places).unwrap()).round() / 1e6
    };
    assert_eq!(at(&[face(0), face(1), face(2), face(3)]), 0.4);
    // Never in the tetrahedra at the ends, however long they are.
    assert_eq!(at(&[face(2), face(3)]), 0.75);
    assert_eq!(at(&[Feature::Edge([14, 15])]), 0.7);
    // Nothing known: the middle.
    assert_eq!(at(&[Feature::Face([0, 1, 2])]), 0.5);
}

#[test]
fn segments_become_unions_of_edges_with_all_rounds() {
    let (unstretched, _) = grid(7, 400, 50);
    let ends = edges(&unstretched);
    let mut counts = Vec::new();
    for rounds in ROUNDS {
        let (_, mut points) = grid(7, 400, 50);
        // Stretched, the same points have another Delaunay mesh, and the same edges do not cross.
        let mut stretched: Vec<[f64; 3]> =
            points.coordinates().iter().map(|&[x, y, z]| [x + 8.0 * y, y, 3.0 * z]).collect();
        // Nothing lies on the hull.
        let end = |k: u32, i: u32, low: f64, high: f64| if i >> k & 1 == 0 { low } else { high };
        stretched.extend(
            (0..8).map(|i| [end(0, i, -700.0, 1100.0), end(1, i, -900.0, 800.0), end(2, i, -600.0, 1000.0)]),
        );
        points = Points::new(stretched);
        let mut mesh = Construction::of(&points);
        // Every third edge, so that not all of the mesh is given.
        let wanted: Vec<[u32; 2]> = ends.iter().copied().step_by(3).collect();
        let (pieces, [missing, split]) = {
            let free = Control::free();
            let mut recovery = Recovery::new(&mut mesh, &mut points, rounds, &free);
            recovery.edges(&wanted).unwrap();
            let mut segments = Segments::new(recovery.points, wanted, &Control::free()).unwrap();
            assert!(recovery.split_missing(&mut segments).unwrap());
            (segments.pieces, [recovery.missing_edges, recovery.split])
        };
        check(&mesh, &points);
        let now = edges(&mesh);
        assert!(pieces.iter().all(|p| now.contains(&edge_key(p.ends[0], p.ends[1]))));
        counts.push((missing, split));
    }
    // Most come by flips; the second list leaves no more than the first.
    assert!(
        counts.iter().all(|&(missing, split)| missing > 100 && split > 0 && 4 * split < 3 * missing),
        "{counts:?}"
    );
    assert!(counts[1].1 <= counts[0].1, "{counts:?}");
}
