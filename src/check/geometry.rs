//! The coordinates that the checks ask: the doubles of the mesh.
use crate::error::Error;
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::predicates::{self, Sign};

/// Coordinates of all vertices of the mesh.
pub(super) struct Geometry {
    rounded: Vec<[f64; 3]>,
}

impl Geometry {
    pub(super) fn new(_plc: &Plc, mesh: &TetMesh) -> Result<Self, Error> {
        let mut rounded = Vec::new();
        rounded.try_reserve_exact(mesh.points.len())?;
        rounded.extend_from_slice(&mesh.points);
        Ok(Geometry { rounded })
    }

    fn at(&self, v: u32) -> &[f64; 3] {
        &self.rounded[v as usize]
    }

    /// Orientation of the exact positions.
    pub(super) fn orient3d(&self, [a, b, c, d]: [u32; 4]) -> Sign {
        predicates::orient3d(self.at(a), self.at(b), self.at(c), self.at(d))
    }

    /// Orientation of the doubles handed out.
    pub(super) fn orient3d_rounded(&self, [a, b, c, d]: [u32; 4]) -> Sign {
        predicates::orient3d(self.at(a), self.at(b), self.at(c), self.at(d))
    }

    /// Positive when `e` is inside the circumsphere of the positive tetrahedron.
    pub(super) fn insphere(&self, [a, b, c, d]: [u32; 4], e: u32) -> Sign {
        predicates::insphere(self.at(a), self.at(b), self.at(c), self.at(d), self.at(e))
    }

    /// Orientation of a triangle seen along coordinate `axis`.
    pub(super) fn orient_in_plane(&self, axis: usize, [a, b, c]: [u32; 3]) -> Sign {
        let flat = |v: u32| [self.at(v)[(axis + 1) % 3], self.at(v)[(axis + 2) % 3]];
        predicates::orient2d(flat(a), flat(b), flat(c))
    }

    /// Whether three points lie on one line.
    pub(super) fn collinear(&self, corners: [u32; 3]) -> bool {
        (0..3).all(|axis| self.orient_in_plane(axis, corners) == Sign::Zero)
    }

    /// Whether `v` lies on the open segment `ab`.
    pub(super) fn strictly_between(&self, v: u32, a: u32, b: u32) -> bool {
        if v == a || v == b || !self.collinear([v, a, b]) {
            return false;
        }
        let (p, a, b) = (self.at(v), self.at(a), self.at(b));
        (0..3).any(|k| a[k] < p[k] && p[k] < b[k] || b[k] < p[k] && p[k] < a[k])
    }
}
