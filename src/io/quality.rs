//! The dihedral angles that files always hold, as written since the first version. [`query::quality`](crate::query::quality) has
//! all measures, and keeps digits of angles near 0 and 180 degrees that these, made from cosines, do not.
use crate::elementary::{arc_cosine_degrees, exponent, power_of_two};
use crate::output::TetMesh;
use crate::vector::{cross, dot, sub};

/// The smallest and largest dihedral angle of a tetrahedron in degrees; 0 and 180 if a face has no area in doubles.
///
/// The angle at the edge between the faces opposite `i` and `j` has cosine `−n_i · n_j` for the outward unit normals.
pub(super) fn dihedrals(corners: [[f64; 3]; 4]) -> [f64; 2] {
    // Coordinates of about one, then normals of about one: nothing over- or underflows that matters.
    let [a, b, c, d] = match power_of_two_above(corners.as_flattened()) {
        Some(factor) => corners.map(|p| p.map(|x| x * factor)),
        None => return [0.0, 180.0],
    };
    let mut normals = [
        cross(&sub(&d, &b), &sub(&c, &b)),
        cross(&sub(&c, &a), &sub(&d, &a)),
        cross(&sub(&d, &a), &sub(&b, &a)),
        cross(&sub(&b, &a), &sub(&c, &a)),
    ];
    for normal in &mut normals {
        let Some(factor) = power_of_two_above(normal) else { return [0.0, 180.0] };
        let scaled = normal.map(|x| x * factor);
        let length = dot(&scaled, &scaled).sqrt();
        *normal = scaled.map(|x| x / length);
    }
    let (mut low, mut high) = (1.0f64, -1.0f64);
    for i in 0..4 {
        for j in 0..i {
            let cosine = -dot(&normals[i], &normals[j]);
            low = low.min(cosine);
            high = high.max(cosine);
        }
    }
    [high, low].map(arc_cosine_degrees)
}

/// The power of two that brings the largest of these numbers to between 1 and 2; none if all are zero.
fn power_of_two_above(numbers: &[f64]) -> Option<f64> {
    let largest = numbers.iter().fold(0.0f64, |largest, x| largest.max(x.abs()));
    (largest > 0.0).then(|| power_of_two((-exponent(largest)).min(1023)))
}

/// The corners of a tetrahedron.
pub(super) fn corners(mesh: &TetMesh, tet: &[u32; 4]) -> [[f64; 3]; 4] {
    tet.map(|v| mesh.points.get(v as usize).copied().unwrap_or_default())
}
