//! The points inside: added where the boundary cannot be kept without them, explicit, in doubles.
use crate::error::Error;
use crate::fallible;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::predicates::Points;

/// Points inside that are vertices of the mesh, in order of their making, and ids free for new ones.
#[derive(Debug, Default)]
pub struct Inside {
    /// Vertex ids.
    pub list: Vec<u32>,
    spare: Vec<u32>,
    /// How many points were added elsewhere: a limit counts them all.
    pub elsewhere: u64,
}

impl Inside {
    /// Points that are there already.
    pub fn of(list: Vec<u32>) -> Inside {
        Inside { list, ..Inside::default() }
    }

    /// A copy.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn copied(&self) -> Result<Inside, Error> {
        let list = fallible::copied(&self.list)?;
        Ok(Inside { list, spare: fallible::copied(&self.spare)?, elsewhere: self.elsewhere })
    }

    /// How many points were added in all.
    pub fn total(&self) -> u64 {
        self.list.len() as u64 + self.elsewhere
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
        fallible::push(&mut self.list, p)?;
        Ok(p)
    }

    /// Takes the last points back, all but the first `count`.
    pub fn shorten(&mut self, count: usize) {
        while self.list.len() > count {
            if let Some(last) = self.list.pop() {
                // Without memory, the id is not used again.
                let _ = fallible::push(&mut self.spare, last);
            }
        }
    }

    /// Forgets points that are no longer vertices.
    pub fn sweep(&mut self, mesh: &Mesh) {
        self.list.retain(|&p| mesh.vertex_tet[p as usize] != NONE);
    }
}
