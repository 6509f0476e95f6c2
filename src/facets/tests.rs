//! Filling: gift wrapping and Delaunay filling give the same result.
use crate::control::Control;
use crate::delaunay::Construction;
use crate::facets::fill::{Filler, Half};
use crate::facets::gift_wrap::gift_wrap;
use crate::predicates::Points;

fn sorted(mut tets: Vec<[u32; 4]>) -> Vec<[u32; 4]> {
    for t in &mut tets {
        t.sort_unstable();
    }
    tets.sort_unstable();
    tets
}

/// The hull of a Delaunay tetrahedralization as a polyhedron to fill, and the tetrahedra that fill it.
fn hull(points: &Points) -> (Half, Vec<[u32; 4]>) {
    let mesh = Construction::of(points);
    let (mut half, mut tets) = (Half::default(), Vec::new());
    for t in (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t)) {
        if mesh.is_ghost(t) {
            half.faces.push(mesh.face(mesh.across(4 * t + 3)));
        } else {
            tets.push(mesh.verts(t));
        }
    }
    // Most vertices are not on the boundary; a half may swallow some too.
    half.vertices = (0..points.len() as u32).collect();
    (half, tets)
}

fn fills_the_hull(xyz: Vec<[f64; 3]>) {
    let points = Points::new(xyz);
    let (half, expected) = hull(&points);
    let mut wrapped = Vec::new();
    gift_wrap(&points, &half, &mut wrapped, &Control::free()).unwrap();
    assert_eq!(sorted(wrapped), sorted(expected.clone()));
    let mut filled = Vec::new();
    let mut filler = Filler::default();
    filler.fill(&points, half, &mut filled, &Control::free()).unwrap();
    assert_eq!(filler.wrapped, 0);
    assert_eq!(sorted(filled), sorted(expected));
}

#[test]
fn both_fillings_agree_on_random_points() {
    let mut state = 12345u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 40) as f64
    };
    fills_the_hull((0..60).map(|_| [next(), next(), next()]).collect());
}

#[test]
fn both_fillings_agree_on_a_grid() {
    // Everything is cospherical and coplanar: only the global perturbation makes the result unique.
    let mut xyz = Vec::new();
    for i in 0..4 {
        for j in 0..4 {
            for k in 0..3 {
                xyz.push([i as f64, j as f64, k as f64]);
            }
        }
    }
    fills_the_hull(xyz);
}

#[test]
fn gift_wrapping_sees_what_facets_hide() {
    // A block with a notch whose floor is thin: below it lies a vertex that only the boundary hides from the notch's own
    // faces. The Delaunay tetrahedralization of the vertices lacks boundary faces, gift wrapping does not need it.
    let xyz = vec![
        [0.0, 0.0, 0.0],
        [4.0, 0.0, 0.0],
        [4.0, 4.0, 0.0],
        [0.0, 4.0, 0.0],
        [2.0, 2.0, 0.25],
        [2.0, 2.0, -0.25],
    ];
    // Pyramid with apex 4 cut out from below by apex 5: two sheets over one square ring.
    let faces =
        vec![[0u32, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4], [1, 0, 5], [2, 1, 5], [3, 2, 5], [0, 3, 5]];
    let points = Points::new(xyz);
    // Turn the faces inwards: (p, x, y, z) positive for p inside, here the midpoint of the square.
    let centre = [2.0, 2.0, 0.0];
    let turned = faces
        .into_iter()
        .map(|[x, y, z]| {
            let sign = crate::predicates::orient3d(&centre, points.xyz(x), points.xyz(y), points.xyz(z));
            if sign == crate::predicates::Sign::Positive {
                [x, y, z]
            } else {
                [x, z, y]
            }
        })
        .collect();
    let half = Half { faces: turned, vertices: (0..6).collect() };
    let mut tets = Vec::new();
    gift_wrap(&points, &half, &mut tets, &Control::free()).unwrap();
    // Four tetrahedra round the axis 4–5, each between two neighbouring corners of the square.
    assert_eq!(tets.len(), 4);
    assert!(tets.iter().all(|t| t.contains(&4) && t.contains(&5)));
}
