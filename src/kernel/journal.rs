//! A journal of replacements, so that they can be undone: the same tetrahedra return to the same slots.
//!
//! A replacement ([`Replace`](crate::kernel::replace::Replace)) releases the old slots in order and then allocates one for each new
//! tetrahedron, from a stack of free slots. Undone in reverse order, these steps see the same stack: every old tetrahedron gets its own
//! slot again, and its data, including neighbours and attachments, are restored.
//!
//! Invariant: replacements are undone in reverse order, and nothing else has been replaced since.
use crate::error::Error;
use crate::fallible;
use crate::kernel::{flag, Mesh, NONE};

/// A tetrahedron that was replaced.
struct Saved {
    slot: u32,
    flags: u16,
    verts: [u32; 4],
    adj: [u32; 4],
    region: u32,
    subface: [u32; 4],
}

/// Replacements, in order.
#[derive(Default)]
pub struct Journal {
    saved: Vec<Saved>,
    fresh: Vec<u32>,
    /// Where each replacement starts in both lists.
    starts: Vec<[usize; 2]>,
}

impl Journal {
    /// The number of replacements that can be undone.
    pub fn len(&self) -> usize {
        self.starts.len()
    }

    /// Forgets all entries: the replacements become permanent.
    pub fn clear(&mut self) {
        self.saved.clear();
        self.fresh.clear();
        self.starts.clear();
    }

    /// Begins the entry of a replacement: `old`, in that order, are about to be replaced.
    pub(super) fn begin(&mut self, mesh: &Mesh, old: &[u32]) -> Result<(), Error> {
        fallible::push(&mut self.starts, [self.saved.len(), self.fresh.len()])?;
        let saved = |&slot: &u32| {
            let t = slot as usize;
            Saved {
                slot,
                flags: mesh.flags[t],
                verts: mesh.verts[t],
                adj: mesh.adj[t],
                region: mesh.region(slot),
                subface: mesh.subface.get(t).copied().unwrap_or([NONE; 4]),
            }
        };
        Ok(fallible::extend(&mut self.saved, old.iter().map(saved))?)
    }

    /// Ends the entry: `fresh` are the new tetrahedra, in the order of their allocation.
    pub(super) fn end(&mut self, fresh: &[u32]) -> Result<(), Error> {
        Ok(fallible::append(&mut self.fresh, fresh)?)
    }

    /// Undoes the last replacement.
    ///
    /// # Errors
    /// `Internal` if something else has been replaced since.
    pub fn take_back(&mut self, mesh: &mut Mesh) -> Result<(), Error> {
        let Some([saved, fresh]) = self.starts.pop() else { return Ok(()) };
        for t in self.fresh.drain(fresh..).rev() {
            mesh.release(t)?;
        }
        for old in self.saved[saved..].iter().rev() {
            if mesh.allocate(old.verts)? != old.slot {
                return Err(Error::internal("a replacement is undone out of order"));
            }
            let t = old.slot as usize;
            mesh.flags[t] = old.flags & !flag::MARK;
            if let Some(region) = mesh.region.get_mut(t) {
                *region = old.region;
            }
            if let Some(subface) = mesh.subface.get_mut(t) {
                *subface = old.subface;
            }
            for v in old.verts {
                mesh.vertex_tet[v as usize] = old.slot;
            }
        }
        for old in self.saved.drain(saved..) {
            for (f, n) in old.adj.into_iter().enumerate() {
                mesh.link(4 * old.slot + f as u32, n);
            }
        }
        Ok(())
    }
}
