//! Point location by a visibility walk (Devillers, Pion & Teillaud 2002): from tetrahedron to tetrahedron through a face
//! that separates it from the target. In a Delaunay tetrahedralization the walk cannot cycle (Edelsbrunner 1990).
use super::Delaunay;
use crate::error::Error;
use crate::mesh::tables::FACE;
use crate::predicates::{Points, Sign};

impl Delaunay {
    /// A tetrahedron in conflict with `p`: the finite one that contains it (boundary included) or a ghost whose hull face
    /// sees it.
    pub fn locate(&self, points: &Points, p: u32, start: u32) -> Result<u32, Error> {
        let mesh = &self.mesh;
        let mut t = start;
        if mesh.is_ghost(t) {
            t = mesh.adj[t as usize][3] >> 2;
        }
        // The face we came through needs no test. The first face tested rotates with the step count: a fixed order makes
        // walks longer.
        let mut entered = 4u32;
        let limit = 4 * mesh.slot_count() + 64;
        for step in 0..limit {
            let v = &mesh.verts[t as usize];
            let mut next = None;
            for i in 0..4u32 {
                let f = (i + step as u32) & 3;
                if f == entered {
                    continue;
                }
                let [x, y, z] = FACE[f as usize];
                let side = points.orient3d(p, v[x as usize], v[y as usize], v[z as usize]);
                if side == Sign::Negative {
                    next = Some(mesh.adj[t as usize][f as usize]);
                    break;
                }
            }
            match next {
                None => return Ok(t),
                Some(code) => {
                    t = code >> 2;
                    entered = code & 3;
                    if mesh.is_ghost(t) {
                        return Ok(t);
                    }
                }
            }
        }
        Err(Error::internal("point location did not end"))
    }
}
