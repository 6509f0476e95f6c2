//! Quality of tetrahedra, for information: dihedral angles in plain floating point.
use crate::output::TetMesh;
use crate::vector::{cross, dot, sub};

/// The smallest and largest dihedral angle of a tetrahedron in degrees; NaN for a flat one.
///
/// The angle at the edge between the faces opposite `i` and `j` has cosine `−n_i · n_j` for the outward unit normals.
pub(super) fn dihedrals(corners: [[f64; 3]; 4]) -> [f64; 2] {
    let [a, b, c, d] = corners;
    let normals = [
        cross(&sub(&d, &b), &sub(&c, &b)),
        cross(&sub(&c, &a), &sub(&d, &a)),
        cross(&sub(&d, &a), &sub(&b, &a)),
        cross(&sub(&b, &a), &sub(&c, &a)),
    ];
    let inverse = normals.map(|n| 1.0 / dot(&n, &n).sqrt());
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..4 {
        for j in 0..i {
            let cosine = -dot(&normals[i], &normals[j]) * inverse[i] * inverse[j];
            low = low.min(cosine);
            high = high.max(cosine);
        }
    }
    [high, low].map(|cosine| cosine.clamp(-1.0, 1.0).acos().to_degrees())
}

/// The smallest and largest dihedral angle of a mesh in degrees.
pub fn dihedral_range(mesh: &TetMesh) -> Option<(f64, f64)> {
    let mut range = None;
    for tet in &mesh.tets {
        let [low, high] = dihedrals(corners(mesh, tet));
        let (least, most) = range.unwrap_or((low, high));
        range = Some((low.min(least), high.max(most)));
    }
    range
}

/// The corners of a tetrahedron.
pub(super) fn corners(mesh: &TetMesh, tet: &[u32; 4]) -> [[f64; 3]; 4] {
    tet.map(|v| mesh.points.get(v as usize).copied().unwrap_or_default())
}
