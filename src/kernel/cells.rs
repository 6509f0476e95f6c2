//! The arrays of the mesh: slots of tetrahedra with vertices, neighbours and flags, and the list of free ones.
//!
//! The arrays are private to the kernel, and every access from outside is checked.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::kernel::slots::Slots;
use crate::kernel::tables::FACE;
use crate::kernel::{flag, GHOST, MAX_TETS, NONE};
use std::collections::TryReserveError;

/// Tetrahedra with all that hangs on them.
#[derive(Debug, Default)]
pub struct Mesh {
    /// Vertices of each tetrahedron.
    pub(super) verts: Vec<[u32; 4]>,
    /// Corner codes: `4·t' + f'` of the neighbour across each face and the face as seen from there.
    pub(super) adj: Vec<[u32; 4]>,
    /// Flag bits, see [`flag`].
    pub(super) flags: Vec<u16>,
    /// Free slots.
    pub(super) free: Vec<u32>,
    /// One live tetrahedron (no ghost if it has another) of each vertex; `NONE` for vertices that no tetrahedron has. Empty until
    /// [`Mesh::index_vertices`].
    pub vertex_tet: Vec<u32>,
    /// Region of each slot, `NONE` for ghosts and what is carved; empty until there are regions.
    pub(super) region: Vec<u32>,
    /// The subface on each face of each slot, where there is one; empty until subfaces have names.
    pub(super) subface: Vec<[u32; 4]>,
    /// When each slot last changed; see [`Mesh::track`].
    pub(super) stamps: Stamps,
}

/// Change stamps.
#[derive(Debug, Default)]
pub(super) struct Stamps {
    pub(super) tracked: bool,
    /// How many replacements there were.
    pub(super) changes: u64,
    /// Per slot, after which of them it has what it has now; slots beyond the end have never changed.
    pub(super) changed: Vec<u64>,
}

fn too_large() -> Error {
    Error::new(Status::TooLarge, "more tetrahedra than the library can address, 2^30 - 1")
}

impl Mesh {
    /// A copy.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn copied(&self) -> Result<Mesh, Error> {
        Ok(Mesh {
            verts: fallible::copied(&self.verts)?,
            adj: fallible::copied(&self.adj)?,
            flags: fallible::copied(&self.flags)?,
            free: fallible::copied(&self.free)?,
            vertex_tet: fallible::copied(&self.vertex_tet)?,
            region: fallible::copied(&self.region)?,
            subface: fallible::copied(&self.subface)?,
            stamps: Stamps { changed: fallible::copied(&self.stamps.changed)?, ..self.stamps },
        })
    }

    /// Forgets everything, keeps the memory of the tetrahedra.
    pub fn clear(&mut self) {
        self.verts.clear();
        self.adj.clear();
        self.flags.clear();
        self.free.clear();
        self.vertex_tet.clear();
        self.region = Vec::new();
        self.subface = Vec::new();
        self.stamps = Stamps::default();
    }

    /// The number of slots (live and free).
    #[inline(always)]
    pub fn slot_count(&self) -> usize {
        self.verts.len()
    }

    /// All slots (live and free).
    pub fn all(&self) -> std::ops::Range<u32> {
        0..self.verts.len() as u32
    }

    /// The number of live tetrahedra, including ghosts.
    pub fn live_count(&self) -> usize {
        self.verts.len() - self.free.len()
    }

    /// Bytes held by the arrays.
    pub fn bytes(&self) -> usize {
        (self.verts.capacity() + self.adj.capacity() + self.subface.capacity()) * 16
            + self.flags.capacity() * 2
            + (self.free.capacity() + self.vertex_tet.capacity() + self.region.capacity()) * 4
            + self.stamps.changed.capacity() * 8
    }

    /// Makes room for `extra` more slots.
    #[inline(always)]
    pub fn reserve(&mut self, extra: usize) -> Result<(), Error> {
        if self.verts.capacity() - self.verts.len() < extra
            || self.flags.capacity() - self.flags.len() < extra
        {
            self.grow(extra)?;
        }
        Ok(())
    }

    /// A view for readers.
    #[inline(always)]
    pub(crate) fn slots(&self) -> Slots<'_> {
        Slots::read(self)
    }

    /// A view for one writer.
    #[inline(always)]
    pub(crate) fn exclusive(&mut self) -> Slots<'_> {
        Slots::exclusive(self)
    }

    /// Bytes of a slot in the arrays that every mesh has.
    pub(crate) const SLOT_BYTES: usize = 2 * size_of::<[u32; 4]>() + size_of::<u16>();

    /// A view for several writers, after appending `more` free slots for their new tetrahedra.
    pub(crate) fn share(&mut self, more: usize) -> Result<Slots<'_>, Error> {
        if self.verts.len() + more > MAX_TETS {
            return Err(too_large());
        }
        self.verts.try_reserve_exact(more)?;
        self.adj.try_reserve_exact(more)?;
        self.flags.try_reserve_exact(more)?;
        let slots = self.verts.len() + more;
        fallible::resize(&mut self.verts, slots, [NONE; 4])?;
        fallible::resize(&mut self.adj, slots, [NONE; 4])?;
        fallible::resize(&mut self.flags, slots, flag::DEAD)?;
        Ok(Slots::exclusive(self))
    }

    /// Makes room for about `extra` more slots if there is memory. This is only a hint: growth reserves again.
    pub(crate) fn expect(&mut self, extra: usize) {
        let extra = extra.min(MAX_TETS.saturating_sub(self.verts.len()));
        let _ = self.verts.try_reserve_exact(extra);
        let _ = self.adj.try_reserve_exact(extra);
        let _ = self.flags.try_reserve_exact(extra);
    }

    #[cold]
    #[inline(never)]
    fn grow(&mut self, extra: usize) -> Result<(), Error> {
        if self.verts.len() + extra > MAX_TETS {
            return Err(too_large());
        }
        // Grow by a quarter instead of doubling: most of the memory of a large mesh is here.
        let room = extra.max(self.verts.len() / 4).min(MAX_TETS - self.verts.len());
        self.verts.try_reserve_exact(room)?;
        self.adj.try_reserve_exact(room)?;
        self.flags.try_reserve_exact(room)?;
        self.free.try_reserve(extra)?;
        Ok(())
    }

    /// A slot for a new tetrahedron: a free one or a new one at the end. Its content is undefined except for the vertices.
    #[inline(always)]
    pub(crate) fn allocate(&mut self, verts: [u32; 4]) -> Result<u32, TryReserveError> {
        if let Some(t) = self.free.pop() {
            self.verts[t as usize] = verts;
            self.flags[t as usize] = 0;
            Ok(t)
        } else {
            let t = self.verts.len() as u32;
            fallible::push(&mut self.verts, verts)?;
            fallible::push(&mut self.adj, [NONE; 4])?;
            fallible::push(&mut self.flags, 0)?;
            Ok(t)
        }
    }

    /// Appends `count` slots for new tetrahedra to `slots`. Their content is undefined.
    #[inline(always)]
    pub(crate) fn allocate_all(&mut self, count: usize, slots: &mut Vec<u32>) -> Result<(), Error> {
        slots.try_reserve(count)?;
        let recycled = count.min(self.free.len());
        let kept = self.free.len() - recycled;
        fallible::append(slots, &self.free[kept..])?;
        self.free.truncate(kept);
        let added = count - recycled;
        if added > 0 {
            self.reserve(added)?;
            let length = self.verts.len();
            fallible::extend(slots, length as u32..(length + added) as u32)?;
            fallible::resize(&mut self.verts, length + added, [NONE; 4])?;
            fallible::resize(&mut self.adj, length + added, [NONE; 4])?;
            fallible::resize(&mut self.flags, length + added, 0)?;
        }
        Ok(())
    }

    /// Frees a slot.
    #[inline(always)]
    pub(crate) fn release(&mut self, t: u32) -> Result<(), TryReserveError> {
        self.flags[t as usize] = flag::DEAD;
        fallible::push(&mut self.free, t)
    }

    /// Whether the slot is in use.
    #[inline(always)]
    pub fn is_live(&self, t: u32) -> bool {
        self.flags[t as usize] & flag::DEAD == 0
    }

    /// Whether the tetrahedron has the vertex at infinity.
    #[inline(always)]
    pub fn is_ghost(&self, t: u32) -> bool {
        self.verts[t as usize][3] == GHOST
    }

    /// The vertices of a tetrahedron.
    #[inline(always)]
    pub fn verts(&self, t: u32) -> [u32; 4] {
        self.verts[t as usize]
    }

    /// Vertex `i` of a tetrahedron.
    #[inline(always)]
    pub fn vertex(&self, t: u32, i: u32) -> u32 {
        self.verts[t as usize][i as usize]
    }

    /// The corner codes across the faces of a tetrahedron.
    #[inline(always)]
    pub fn adj(&self, t: u32) -> [u32; 4] {
        self.adj[t as usize]
    }

    /// The tetrahedron beyond face `f` of `t`.
    #[inline(always)]
    pub fn beyond(&self, t: u32, f: u32) -> u32 {
        self.adj[t as usize][f as usize] >> 2
    }

    /// Makes two corner codes neighbours.
    #[inline(always)]
    pub(crate) fn link(&mut self, a: u32, b: u32) {
        self.adj[(a >> 2) as usize][(a & 3) as usize] = b;
        self.adj[(b >> 2) as usize][(b & 3) as usize] = a;
    }

    /// The corner code across corner code `c`.
    #[inline(always)]
    pub fn across(&self, c: u32) -> u32 {
        self.adj[(c >> 2) as usize][(c & 3) as usize]
    }

    /// The vertices of the face opposite corner `c`, ordered so that `(opposite, x, y, z)` is positive.
    #[inline(always)]
    pub fn face(&self, c: u32) -> [u32; 3] {
        let v = &self.verts[(c >> 2) as usize];
        let f = &FACE[(c & 3) as usize];
        [v[f[0] as usize], v[f[1] as usize], v[f[2] as usize]]
    }

    /// The vertex of corner `c`.
    #[inline(always)]
    pub fn apex(&self, c: u32) -> u32 {
        self.verts[(c >> 2) as usize][(c & 3) as usize]
    }

    /// The slot of vertex `v` in tetrahedron `t`, if it is one of its vertices.
    #[inline(always)]
    pub fn slot_of(&self, t: u32, v: u32) -> Option<u32> {
        let w = &self.verts[t as usize];
        (0..4u32).find(|&i| w[i as usize] == v)
    }

    /// Fills `vertex_tet` for `vertex_count` vertices: a finite tetrahedron if there is one, `NONE` for absent vertices.
    pub fn index_vertices(&mut self, vertex_count: usize) -> Result<(), Error> {
        self.vertex_tet.clear();
        fallible::resize(&mut self.vertex_tet, vertex_count, NONE)?;
        for (t, v) in (0..).zip(&self.verts) {
            if self.flags[t as usize] & flag::DEAD == 0 && v[3] != GHOST {
                for &v in v {
                    self.vertex_tet[v as usize] = t;
                }
            }
        }
        Ok(())
    }

    /// Makes room for a vertex.
    pub fn add_vertex(&mut self, v: u32) -> Result<(), Error> {
        let count = self.vertex_tet.len().max(v as usize + 1);
        Ok(fallible::resize(&mut self.vertex_tet, count, NONE)?)
    }

    /// Stamps every change from here on.
    pub fn track(&mut self) {
        self.stamps.tracked = true;
    }

    /// A mesh without tetrahedra, with these stamps.
    #[cfg(test)]
    pub fn stamped(changes: u64, changed: Vec<u64>) -> Mesh {
        Mesh { stamps: Stamps { tracked: true, changes, changed }, ..Mesh::default() }
    }

    /// The number of replacements since [`Mesh::track`].
    pub fn changes(&self) -> u64 {
        self.stamps.changes
    }

    /// After which of these replacements a slot has what it has now.
    pub fn changed(&self, t: u32) -> u64 {
        self.stamps.changed.get(t as usize).copied().unwrap_or(0)
    }

    /// Whether a slot has what it had after the first `since` replacements.
    pub fn is_unchanged(&self, t: u32, since: u64) -> bool {
        self.changed(t) <= since
    }

    /// The tetrahedra and their neighbours without the free slots and those that `stays` rejects, in the arrays that they already have;
    /// vertices are mapped by `point_of`, and neighbours outside become `NONE`.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn into_arrays(
        mut self,
        stays: impl Fn(&Mesh, u32) -> bool,
        point_of: impl Fn(u32) -> u32,
        control: &Control,
    ) -> Result<[Vec<[u32; 4]>; 2], Error> {
        // Flags tell which slots stay; the list of free ones is no longer needed.
        self.free = Vec::new();
        self.vertex_tet = Vec::new();
        let mut number = fallible::reserved(self.slot_count())?;
        let mut count = 0;
        for t in self.all() {
            let stays = stays(&self, t);
            fallible::push(&mut number, if stays { count } else { NONE })?;
            count += u32::from(stays);
        }
        self.flags = Vec::new();
        for (t, &n) in number.iter().enumerate() {
            control.step()?;
            if n == NONE {
                continue;
            }
            // New numbers are never larger: nothing is overwritten before it is read.
            self.verts[n as usize] = self.verts[t].map(&point_of);
            self.adj[n as usize] = self.adj[t].map(|code| number[(code >> 2) as usize]);
        }
        self.verts.truncate(count as usize);
        self.adj.truncate(count as usize);
        Ok([self.verts, self.adj])
    }
}
