//! Fillings of whole convex hulls: every wanted face is there, every point is a vertex, and the volume is that of the hull.
use crate::control::{controlled, CancelToken, Control, Limits};
use crate::delaunay::Construction;
use crate::error::Status;
use crate::kernel::{edge_key, face_key, Mesh};
use crate::predicates::{Points, Sign};
use crate::preserve::whole::{fill_hull, Random, Wanted};
use crate::progress::Silent;
use std::collections::BTreeSet;

fn edges(triangles: &[[u32; 3]], segments: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let around = |&[a, b, c]: &[u32; 3]| [edge_key(a, b), edge_key(b, c), edge_key(c, a)];
    let mut edges: Vec<_> = triangles.iter().flat_map(around).chain(segments.iter().copied()).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Fills and checks; six times the volume, or `None` if there is no filling.
fn filled(coordinates: &[[f64; 3]], triangles: &[[u32; 3]], segments: &[[u32; 2]]) -> Option<f64> {
    let mut points = Points::new(coordinates.to_vec());
    let mut mesh = Mesh::default();
    let edges = edges(triangles, segments);
    let wanted = Wanted { triangles, edges: &edges };
    let inside = fill_hull(&mut mesh, &mut points, wanted, &Control::free()).unwrap();
    let Some(inside) = inside else {
        assert_eq!(points.len(), coordinates.len());
        return None;
    };
    assert_eq!(points.len(), coordinates.len() + inside.len());
    let (mut faces, mut pairs, mut vertices) = (BTreeSet::new(), BTreeSet::new(), BTreeSet::new());
    let mut volume = 0.0;
    for t in 0..mesh.slot_count() as u32 {
        assert!(mesh.is_live(t));
        for code in 4 * t..4 * t + 4 {
            let other = mesh.across(code);
            assert_eq!((mesh.across(other), face_key(mesh.face(other))), (code, face_key(mesh.face(code))));
            // Neighbours have the face in opposite directions; ghosts too, or rings round edges would not close.
            let [x, y, z] = mesh.face(code);
            assert!([[x, z, y], [z, y, x], [y, x, z]].contains(&mesh.face(other)));
        }
        if mesh.is_ghost(t) {
            continue;
        }
        let v = mesh.verts(t);
        assert_eq!(points.orient3d(v[0], v[1], v[2], v[3]), Sign::Positive);
        faces.extend((0..4).map(|k| face_key(mesh.face(4 * t + k))));
        pairs.extend((0..4).flat_map(|i| (0..i).map(move |j| edge_key(v[i], v[j]))));
        vertices.extend(v);
        let [a, b, c, d] = v.map(|v| points.xyz(v));
        let [u, v, w] = [b, c, d].map(|p| crate::vector::sub(p, a));
        volume += crate::vector::dot(&u, &crate::vector::cross(&v, &w)).abs();
    }
    assert!(triangles.iter().all(|&t| faces.contains(&face_key(t))));
    assert!(edges.iter().all(|e| pairs.contains(e)));
    assert_eq!(vertices.len(), points.len());
    Some(volume)
}

const CUBE: [[f64; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [4.0, 0.0, 0.0],
    [0.0, 4.0, 0.0],
    [4.0, 4.0, 0.0],
    [0.0, 0.0, 4.0],
    [4.0, 0.0, 4.0],
    [0.0, 4.0, 4.0],
    [4.0, 4.0, 4.0],
];
const SQUARES: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];

/// The hull gets the surface's diagonals, in all 64 combinations, whatever those of the Delaunay tetrahedralization are.
#[test]
fn a_hull_has_the_diagonals_of_the_surface() {
    for choice in 0..64 {
        let triangles: Vec<_> = (SQUARES.iter().enumerate())
            .flat_map(|(i, &[a, b, c, d])| match choice >> i & 1 {
                0 => [[a, b, c], [a, c, d]],
                _ => [[a, b, d], [b, c, d]],
            })
            .collect();
        assert_eq!(filled(&CUBE, &triangles, &[]), Some(6.0 * 64.0), "{choice}");
    }
    // A fan on a parabola: none of its edges but the outline's is Delaunay.
    let mut points = vec![[0.0, 0.0, 5.0]];
    let mut triangles = Vec::new();
    for (i, x) in (0..).zip([-4, -2, -1, 0, 1, 3, 4]) {
        points.push([f64::from(x), f64::from(x * x), 0.0]);
        if i > 1 {
            triangles.push([1, i, i + 1]);
        }
    }
    assert!(filled(&points, &triangles, &[[0, 4]]).is_some());
}

/// Points of no facet are inside, on faces and edges of tetrahedra, on the hull, and outside the hull of the others.
#[test]
fn loose_points_become_vertices_wherever_they_are() {
    for seed in 0..200 {
        let mut numbers = Random(seed);
        let mut points = CUBE.to_vec();
        let triangles = [[0, 1, 7], [2, 4, 6]];
        // On a grid of odd numbers, in the cube, beside it and farther out.
        for _ in 0..numbers.next(6) {
            let mut p = std::array::from_fn(|_| 2.0 * numbers.next(4) as f64 - 1.0);
            if numbers.next(3) == 0 {
                p = p.map(|x| x + 6.0);
            }
            let on_triangle = (p[1] == p[2] && p[0] >= p[1]) || (p[0] == 0.0) || p[0] + p[1] + p[2] == 8.0;
            if !on_triangle && !points.contains(&p) {
                points.push(p);
            }
        }
        let volume = filled(&points, &triangles, &[]).unwrap_or_else(|| panic!("{seed}"));
        let all = Points::new(points.clone());
        let mesh = Construction::of(&all);
        let mut hull = 0.0;
        for t in (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)) {
            let [a, b, c, d] = mesh.verts(t).map(|v| all.xyz(v));
            let [u, v, w] = [b, c, d].map(|p| crate::vector::sub(p, a));
            hull += crate::vector::dot(&u, &crate::vector::cross(&v, &w)).abs();
        }
        assert!((volume - hull).abs() < 1e-9 * hull, "{seed}: {volume} {hull}");
    }
}

/// Segments on no facet are edges, and their ends vertices.
#[test]
fn segments_inside_are_kept() {
    let mut points = CUBE.to_vec();
    points.extend([[1.0, 1.0, 1.5], [3.0, 3.0, 2.5], [1.0, 3.0, 2.0]]);
    let segments = [[0, 8], [8, 9], [9, 10]];
    assert_eq!(filled(&points, &[[0, 3, 5]], &segments), Some(6.0 * 64.0));
}

/// All vertices in a plane, or too many of them.
#[test]
fn where_nothing_is_found_nothing_is_changed() {
    let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    assert_eq!(filled(&flat, &[[0, 1, 2]], &[]), None);
    let many: Vec<[f64; 3]> = (0..70).map(f64::from).map(|x| [x, x * x, x * x * x]).collect();
    let segments: Vec<[u32; 2]> = (0..69).map(|i| [i, i + 1]).collect();
    assert_eq!(filled(&many, &[], &segments), None);
}

#[test]
fn the_search_can_be_cancelled() {
    let mut points = Points::new(CUBE.to_vec());
    let triangles = [[0, 1, 7], [2, 4, 6]];
    let edges = edges(&triangles, &[]);
    let wanted = Wanted { triangles: &triangles, edges: &edges };
    let token = CancelToken::new();
    token.cancel();
    let limits = Limits { cancel: Some(token.flag()), ..Limits::default() };
    let error = controlled(limits, &mut Silent, |control| {
        fill_hull(&mut Mesh::default(), &mut points, wanted, control).unwrap_err()
    });
    assert_eq!(error.status, Status::Cancelled);
}
