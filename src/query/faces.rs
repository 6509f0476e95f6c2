//! All faces of a mesh, each once, in the order of their first tetrahedron.
//!
//! Invariant: `corners` are oriented outward from `tets[0]`, which always exists. It has the smaller index of the two, except on a subface,
//! which keeps its own order: from the lower region to the higher.
use crate::error::Error;
use crate::fallible;
use crate::query::FACE_CORNERS;
use crate::{TetMesh, INVALID};

/// A face of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Face {
    /// The corners; `(b − a) × (c − a)` points from `tets[0]` to `tets[1]`.
    pub corners: [u32; 3],
    /// The tetrahedra on both sides; the second is [`INVALID`] on the boundary.
    pub tets: [u32; 2],
    /// Its subface, or [`INVALID`] if it is not constrained.
    pub subface: u32,
    /// The marker of its subface, or 0.
    pub marker: i32,
}

/// The faces of a mesh, and those of each tetrahedron.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Faces {
    /// Every face once.
    pub faces: Vec<Face>,
    /// For each tetrahedron its four faces, face `i` opposite vertex `i`.
    pub tet_faces: Vec<[u32; 4]>,
}

impl Faces {
    /// Lists the faces of `mesh`. Fails if memory runs out, or with `Internal` if the neighbours are inconsistent.
    pub fn new(mesh: &TetMesh) -> Result<Faces, Error> {
        let inner: usize = mesh.neighbors.iter().flatten().filter(|&&beyond| beyond != INVALID).count();
        let mut faces = fallible::reserved(4 * mesh.tets.len() - inner / 2)?;
        let mut tet_faces = fallible::filled([INVALID; 4], mesh.tets.len())?;
        for (tet, neighbors) in mesh.neighbors.iter().enumerate() {
            for (side, &beyond) in neighbors.iter().enumerate() {
                if beyond != INVALID && (beyond as usize) < tet {
                    continue;
                }
                let index = faces.len() as u32;
                tet_faces[tet][side] = index;
                let corners = FACE_CORNERS[side].map(|corner| mesh.tets[tet][corner]);
                fallible::push(
                    &mut faces,
                    Face { corners, tets: [tet as u32, beyond], subface: INVALID, marker: 0 },
                )?;
                if beyond != INVALID {
                    let back = side_with(mesh, beyond, &corners).ok_or_else(neighbor_error)?;
                    tet_faces[beyond as usize][back] = index;
                }
            }
        }
        let mut list = Faces { faces, tet_faces };
        list.mark_subfaces(mesh)?;
        Ok(list)
    }

    fn mark_subfaces(&mut self, mesh: &TetMesh) -> Result<(), Error> {
        for (index, subface) in mesh.subfaces.iter().enumerate() {
            let Some(&tet) = subface.tets.iter().find(|&&tet| tet != INVALID) else { continue };
            let side = side_with(mesh, tet, &subface.corners).ok_or_else(neighbor_error)?;
            let face = &mut self.faces[self.tet_faces[tet as usize][side] as usize];
            face.subface = index as u32;
            if face.tets[0] != subface.tets[0] {
                face.tets.swap(0, 1);
                face.corners.swap(1, 2);
            }
            face.marker = subface.marker;
        }
        Ok(())
    }
}

/// The face of `tet` with these corners, if any.
pub(super) fn side_with(mesh: &TetMesh, tet: u32, corners: &[u32; 3]) -> Option<usize> {
    let tet = mesh.tets.get(tet as usize)?;
    let side = tet.iter().position(|corner| !corners.contains(corner))?;
    FACE_CORNERS[side].iter().all(|&corner| corners.contains(&tet[corner])).then_some(side)
}

fn neighbor_error() -> Error {
    Error::internal("a face of the mesh is missing from its tetrahedron")
}
