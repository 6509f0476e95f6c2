//! A raw view of the tetrahedra: unchecked, and several may exist at the same time.
//!
//! The inner loops of insertion use it, on one thread or several. Why it is sound:
//!
//! *In bounds.* Codes and slots come from `adj` of live tetrahedra or from the allocator, and the invariants of [`Mesh`] bound both
//! by the number of slots; debug builds assert this at each access.
//!
//! *No data races.* While workers share the arrays ([`Mesh::share`]), a tetrahedron belongs to the range that its flags name, or to none:
//! then it is *frozen*. All vertices of an owned tetrahedron belong to its range. So two tetrahedra of different ranges share no vertex,
//! the neighbours of an owned tetrahedron are owned by the same range or frozen, and a worker that starts from an owned one and stops at
//! frozen ones meets no others. A worker
//! * reads and writes `verts`, `flags` and `adj` of its own slots: those it owned at first, and its own block of new ones;
//! * reads `verts` and `flags` of frozen tetrahedra next to its own, which nobody writes;
//! * writes one entry of `adj` of a frozen tetrahedron: the one that leads to a tetrahedron of its own. No other worker accesses this
//!   entry. (Rows of `adj` of frozen tetrahedra are never loaded as a whole.)
//! * reads, of a frozen ghost, the entry of `adj` that leads to the finite tetrahedron at the same hull face, and that one's `verts`. It
//!   is frozen too, since its range would have the ghost's three vertices; so nobody writes this entry.
#![allow(unsafe_code)]
use crate::kernel::tables::FACE;
use crate::kernel::{flag, Mesh};
use std::marker::PhantomData;

/// Pointers to the arrays of [`Mesh`].
pub struct Slots<'a> {
    verts: *mut [u32; 4],
    adj: *mut [u32; 4],
    flags: *mut u16,
    /// Number of slots.
    count: usize,
    life: PhantomData<&'a Mesh>,
}

// SAFETY: plain pointers to arrays that outlive the view; the absence of data races is shown above.
unsafe impl Send for Slots<'_> {}
// SAFETY: as for Send.
unsafe impl Sync for Slots<'_> {}

impl<'a> Slots<'a> {
    /// A view for readers: nothing may be written through it.
    #[inline(always)]
    pub(super) fn read(mesh: &'a Mesh) -> Self {
        Slots {
            verts: mesh.verts.as_ptr().cast_mut(),
            adj: mesh.adj.as_ptr().cast_mut(),
            flags: mesh.flags.as_ptr().cast_mut(),
            count: mesh.verts.len(),
            life: PhantomData,
        }
    }

    /// A view for one writer.
    #[inline(always)]
    pub(super) fn exclusive(mesh: &'a mut Mesh) -> Self {
        Slots {
            verts: mesh.verts.as_mut_ptr(),
            adj: mesh.adj.as_mut_ptr(),
            flags: mesh.flags.as_mut_ptr(),
            count: mesh.verts.len(),
            life: PhantomData,
        }
    }

    /// The number of slots.
    #[inline(always)]
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    #[inline(always)]
    fn at(&self, t: u32) -> usize {
        debug_assert!((t as usize) < self.count, "slot {t} of {}", self.count);
        t as usize
    }

    /// The vertices of `t`.
    #[inline(always)]
    pub(crate) fn verts(&self, t: u32) -> [u32; 4] {
        // SAFETY: in bounds and not written by others, see above.
        unsafe { *self.verts.add(self.at(t)) }
    }

    /// Vertex `i` of `t`; only the last two bits of `i` count.
    #[inline(always)]
    pub(crate) fn vertex(&self, t: u32, i: u8) -> u32 {
        // SAFETY: in bounds and not written by others, see above.
        unsafe { *self.verts.add(self.at(t)).cast::<u32>().add((i & 3) as usize) }
    }

    /// Sets the vertices of `t`.
    #[inline(always)]
    pub(crate) fn set_verts(&self, t: u32, verts: [u32; 4]) {
        // SAFETY: in bounds and an own slot, see above.
        unsafe { *self.verts.add(self.at(t)) = verts }
    }

    /// The neighbours of `t`, which is owned.
    #[inline(always)]
    pub(crate) fn adj(&self, t: u32) -> [u32; 4] {
        // SAFETY: in bounds and an own slot, see above.
        unsafe { *self.adj.add(self.at(t)) }
    }

    /// Sets the neighbours of `t`.
    #[inline(always)]
    pub(crate) fn set_adj(&self, t: u32, adj: [u32; 4]) {
        // SAFETY: in bounds and an own slot, see above.
        unsafe { *self.adj.add(self.at(t)) = adj }
    }

    /// The flags of `t`.
    #[inline(always)]
    pub(crate) fn flags(&self, t: u32) -> u16 {
        // SAFETY: in bounds and not written by others, see above.
        unsafe { *self.flags.add(self.at(t)) }
    }

    /// Sets the flags of `t`.
    #[inline(always)]
    pub(crate) fn set_flags(&self, t: u32, flags: u16) {
        // SAFETY: in bounds and an own slot, see above.
        unsafe { *self.flags.add(self.at(t)) = flags }
    }

    /// The corner code across corner code `c`.
    #[inline(always)]
    pub(crate) fn across(&self, c: u32) -> u32 {
        let (t, f) = (self.at(c >> 2), (c & 3) as usize);
        // SAFETY: in bounds, an own slot or the entry of a frozen ghost that nobody writes; only this entry is touched.
        unsafe { *self.adj.add(t).cast::<u32>().add(f) }
    }

    /// Sets the corner code across corner code `c`.
    #[inline(always)]
    pub(crate) fn set_across(&self, c: u32, to: u32) {
        let (t, f) = (self.at(c >> 2), (c & 3) as usize);
        // SAFETY: in bounds, an own slot or the entry of a frozen tetrahedron that leads to an own one; only it is touched.
        unsafe { *self.adj.add(t).cast::<u32>().add(f) = to }
    }

    /// Prefetches the memory of `t`, which is needed soon.
    #[inline(always)]
    pub(crate) fn prefetch(&self, t: u32) {
        #[cfg(target_arch = "x86_64")]
        {
            use std::arch::x86_64::{_mm_prefetch, _MM_HINT_T0};
            // SAFETY: in bounds; a hint reads and writes nothing.
            unsafe {
                _mm_prefetch::<_MM_HINT_T0>(self.verts.add(self.at(t)).cast());
                _mm_prefetch::<_MM_HINT_T0>(self.adj.add(self.at(t)).cast());
            }
        }
    }

    /// Like [`Mesh::face`].
    #[inline(always)]
    pub(crate) fn face(&self, c: u32) -> [u32; 3] {
        FACE[(c & 3) as usize].map(|i| self.vertex(c >> 2, i))
    }
}

impl Mesh {
    /// Takes the list of free slots, to distribute them among workers; [`Mesh::give_free`] returns what is left.
    pub(crate) fn take_free(&mut self) -> Vec<u32> {
        std::mem::take(&mut self.free)
    }

    /// Returns free slots.
    pub(crate) fn give_free(&mut self, free: Vec<u32>) {
        self.free = free;
    }

    /// Vertices and flags, to write owners into the flags.
    pub(crate) fn verts_and_flags(&mut self) -> (&[[u32; 4]], &mut [u16]) {
        (&self.verts, &mut self.flags)
    }

    /// No tetrahedron belongs to a range any more.
    pub(crate) fn disown(&mut self) {
        for flags in &mut self.flags {
            *flags &= flag::DEAD;
        }
    }
}
