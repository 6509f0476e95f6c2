//! What hangs on the mesh: the region of a tetrahedron, the subface on a face, the subsegment on an edge.
//!
//! Flags in both tetrahedra at a face tell whether a subface is there, and in all tetrahedra round an edge whether a subsegment is. Regions
//! and the names of subfaces have arrays of their own, which do not exist until they are given.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::tables::EDGE;
use crate::kernel::{flag, Mesh, NONE};

/// See [`Mesh::subfaces`].
pub struct SubfaceCodes<'a> {
    mesh: &'a Mesh,
    /// The tetrahedron whose subfaces `faces` are left.
    t: u32,
    next: u32,
    faces: u16,
}

impl Iterator for SubfaceCodes<'_> {
    type Item = u32;

    #[inline]
    fn next(&mut self) -> Option<u32> {
        loop {
            while self.faces == 0 {
                if self.next as usize == self.mesh.slot_count() {
                    return None;
                }
                self.t = self.next;
                self.next += 1;
                self.faces = self.mesh.subface_bits(self.t);
            }
            let code = 4 * self.t + self.faces.trailing_zeros();
            self.faces &= self.faces - 1;
            if code < self.mesh.across(code) {
                return Some(code);
            }
        }
    }
}

impl Mesh {
    /// Whether the face of a corner is a subface.
    #[inline(always)]
    pub fn is_subface(&self, code: u32) -> bool {
        self.flags[(code >> 2) as usize] & (flag::FACE << (code & 3)) != 0
    }

    /// Whether the face of a corner is a wall: a subface, or between the domain and what is not.
    #[inline(always)]
    pub fn is_wall(&self, code: u32) -> bool {
        self.is_subface(code) || self.is_ghost(code >> 2) != self.is_ghost(self.across(code) >> 2)
    }

    /// Makes the face of a corner a subface, on both sides.
    #[inline]
    pub fn set_subface(&mut self, code: u32) {
        for side in [code, self.across(code)] {
            self.flags[(side >> 2) as usize] |= flag::FACE << (side & 3);
        }
    }

    /// The name of the subface of a corner; `NONE` if it is none or has none.
    #[inline]
    pub fn subface(&self, code: u32) -> u32 {
        match self.subface.get((code >> 2) as usize) {
            Some(names) if self.is_subface(code) => names[(code & 3) as usize],
            _ => NONE,
        }
    }

    /// Corner codes of all subfaces, one of the two sides each, ascending.
    pub fn subfaces(&self) -> SubfaceCodes<'_> {
        SubfaceCodes { mesh: self, t: 0, next: 0, faces: 0 }
    }

    /// The faces of a tetrahedron that are subfaces, as bits.
    #[inline(always)]
    fn subface_bits(&self, t: u32) -> u16 {
        match self.flags[t as usize] {
            flags if flags & flag::DEAD == 0 => flags & flag::FACES,
            _ => 0,
        }
    }

    /// Names subfaces: `name` gives the name of the subface of each corner, `None` if it is a subface no longer. Only one side of each is
    /// asked for, and ghosts that are not flagged themselves take over what their neighbours have.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory); as [`Control::room`].
    pub fn name_subfaces(
        &mut self,
        name: impl Fn(&Mesh, u32) -> Option<u32>,
        control: &Control,
    ) -> Result<(), Error> {
        control.room(self.slot_count() * size_of::<[u32; 4]>())?;
        let mut names = fallible::filled([NONE; 4], self.slot_count())?;
        for t in self.all() {
            control.step()?;
            let mut faces = self.subface_bits(t);
            while faces != 0 {
                let code = 4 * t + faces.trailing_zeros();
                faces &= faces - 1;
                let other = self.across(code);
                // Already named from there.
                if other < code && self.is_subface(other) {
                    continue;
                }
                let named = name(self, code.min(other));
                for side in [code, other] {
                    let flags = &mut self.flags[(side >> 2) as usize];
                    match named {
                        Some(named) => {
                            *flags |= flag::FACE << (side & 3);
                            names[(side >> 2) as usize][(side & 3) as usize] = named;
                        }
                        None => *flags &= !(flag::FACE << (side & 3)),
                    }
                }
            }
        }
        self.subface = names;
        Ok(())
    }

    /// Makes edge `e` of a tetrahedron (see [`tables::EDGE`](crate::kernel::tables::EDGE)) a subsegment: to be called for all tetrahedra round it.
    #[inline]
    pub fn set_subsegment(&mut self, t: u32, e: u8) {
        self.flags[t as usize] |= flag::EDGE << e;
    }

    /// One bit for each edge of a tetrahedron that is a subsegment.
    #[inline(always)]
    pub fn subsegment_bits(&self, t: u32) -> u16 {
        (self.flags[t as usize] & flag::EDGES) / flag::EDGE
    }

    /// Whether the edge `a b` of a tetrahedron is a subsegment.
    pub fn is_subsegment(&self, t: u32, [a, b]: [u32; 2]) -> bool {
        self.subsegments(t).any(|edge| edge == [a, b] || edge == [b, a])
    }

    /// The edges of a tetrahedron that are subsegments, by their ends.
    pub fn subsegments(&self, t: u32) -> impl Iterator<Item = [u32; 2]> + '_ {
        let bits = self.subsegment_bits(t);
        EDGE.iter().enumerate().filter(move |(e, _)| bits >> e & 1 != 0).map(move |(_, &[i, j])| {
            let v = &self.verts[t as usize];
            [v[i as usize], v[j as usize]]
        })
    }

    /// Lets `each` choose which edges of every live tetrahedron become subsegments: it gets the vertices and returns one bit an edge.
    ///
    /// # Errors
    /// Ends at the first error of `each`.
    pub fn mark_subsegments(
        &mut self,
        mut each: impl FnMut(&[u32; 4]) -> Result<u16, Error>,
    ) -> Result<(), Error> {
        for (v, flags) in self.verts.iter().zip(&mut self.flags) {
            if *flags & flag::DEAD == 0 {
                *flags |= each(v)? * flag::EDGE;
            }
        }
        Ok(())
    }

    /// Forgets which edges are subsegments.
    pub fn clear_subsegments(&mut self) {
        for flags in &mut self.flags {
            *flags &= !flag::EDGES;
        }
    }

    /// The region of a tetrahedron; `NONE` for ghosts, for what is carved, and without regions.
    #[inline(always)]
    pub fn region(&self, t: u32) -> u32 {
        self.region.get(t as usize).copied().unwrap_or(NONE)
    }

    /// Gives every slot the region that `of` says; ghosts and free slots get none.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
    pub fn set_regions(&mut self, of: impl Fn(u32) -> u32) -> Result<(), Error> {
        self.region.clear();
        self.region.try_reserve_exact(self.slot_count())?;
        let (flags, verts) = (&self.flags, &self.verts);
        let inside =
            |t: u32| flags[t as usize] & flag::DEAD == 0 && verts[t as usize][3] != crate::kernel::GHOST;
        fallible::extend(
            &mut self.region,
            (0..verts.len() as u32).map(|t| if inside(t) { of(t) } else { NONE }),
        )?;
        Ok(())
    }
}
