//! The points inside: added where the boundary cannot be kept without them, explicit, in doubles.
use crate::error::Error;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::predicates::Points;

/// Points inside that are vertices of the mesh, in order of their making, and ids free for new ones.
#[derive(Clone, Debug, Default)]
pub struct Inside {
    /// Vertex ids.
    pub list: Vec<u32>,
    spare: Vec<u32>,
}

impl Inside {
    /// Points that are there already.
    pub fn of(list: Vec<u32>) -> Inside {
        Inside { list, ..Inside::default() }
    }

    /// A new point. (Its coordinates must be in the exact range.)
    pub fn add(&mut self, mesh: &mut Mesh, points: &mut Points, at: [f64; 3]) -> Result<u32, Error> {
        let p = match self.spare.pop() {
            Some(p) => {
                points.move_to(p, at)?;
                p
            }
            None => points.push(at)?,
        };
        mesh.add_vertex(p)?;
        self.list.try_reserve(1)?;
        self.list.push(p);
        Ok(p)
    }

    /// Takes the last points back, all but the first `count`.
    pub fn shorten(&mut self, count: usize) {
        while self.list.len() > count {
            let last = self.list.pop();
            if self.spare.try_reserve(1).is_ok() {
                self.spare.extend(last);
            }
        }
    }

    /// Forgets points that are no longer vertices.
    pub fn sweep(&mut self, mesh: &Mesh) {
        self.list.retain(|&p| mesh.vertex_tet[p as usize] != NONE);
    }
}
