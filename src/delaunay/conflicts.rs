//! The conflict region of a vertex, and its boundary.
//!
//! Breadth-first, level by level: all neighbours of the last level not yet visited are listed, then all of them are tested. Which of them
//! are in conflict is hard to predict, so a tested tetrahedron is always written after the list of those in conflict, and only the length
//! of this list depends on the outcome: the processor mispredicts branches only at the ends of loops. No tetrahedron is tested twice,
//! although most share several faces with the region.
use crate::error::Error;
use crate::fallible;
use crate::kernel::slots::Slots;
use crate::kernel::{flag, GHOST};
use crate::predicates::{Points, Sign};
use std::hint::black_box;

/// The vertices of each face, oriented as in [`FACE`](crate::kernel::tables::FACE), with slot 3, the ghost's, last.
const GHOST_LAST: [[usize; 3]; 4] = [[1, 2, 3], [2, 0, 3], [0, 1, 3], [0, 2, 1]];

/// A region of more tetrahedra takes milliseconds: vertices on a sphere and one near its centre, for example.
const MANY: usize = 1 << 13;

/// The result of the last [`collect`](Conflicts::collect).
#[derive(Default)]
pub(super) struct Conflicts {
    /// The tetrahedra in conflict are the first `dead_count`.
    dead: Vec<u32>,
    dead_count: usize,
    /// The first one and all that were tested, in conflict or not.
    met: Vec<u32>,
    /// The first `face_count` are the vertices of the boundary faces, positive as seen from inside and the ghost last, and the corner code
    /// across each.
    faces: Vec<[u32; 4]>,
    face_count: usize,
}

/// Extends a list to at least this length.
#[inline(always)]
fn lengthen<T: Copy + Default>(list: &mut Vec<T>, length: usize) -> Result<(), Error> {
    if list.len() < length {
        lengthen_slowly(list, length.max(2 * list.len()))?;
    }
    Ok(())
}

#[cold]
#[inline(never)]
fn lengthen_slowly<T: Copy + Default>(list: &mut Vec<T>, length: usize) -> Result<(), Error> {
    list.try_reserve_exact(length - list.len())?;
    fallible::resize(list, length, T::default())?;
    Ok(())
}

/// Whether the hull face of a ghost sees `p`, or `p` lies in its plane and is in conflict with the finite tetrahedron behind it.
#[inline(always)]
pub(super) fn ghost_in_conflict<const WEIGHTED: bool>(
    slots: &Slots,
    points: &Points,
    t: u32,
    p: u32,
) -> bool {
    let v = slots.verts(t);
    match points.orient3d(v[0], v[1], v[2], p) {
        Sign::Positive => true,
        Sign::Negative => false,
        Sign::Zero => {
            let w = slots.verts(slots.across(4 * t + 3) >> 2);
            match WEIGHTED {
                true => points.power_perturbed(w, p) == Sign::Positive,
                false => points.insphere_perturbed(w[0], w[1], w[2], w[3], p) == Sign::Positive,
            }
        }
    }
}

impl Conflicts {
    /// Finds the tetrahedra in conflict with `p`, of which `t` is one, and marks them. With `WEIGHTED` the power test decides: all tetrahedra
    /// of a vertex may then be in conflict, and none of the faces has it. With `SHARED` all must belong to the range `owner`:
    /// if another one is in conflict, nothing is marked and the result is false. `may_go_on` is asked where the region becomes large; if it
    /// fails, the mesh is useless.
    pub(super) fn collect<const SHARED: bool, const WEIGHTED: bool>(
        &mut self,
        slots: &Slots,
        owner: u16,
        points: &Points,
        p: u32,
        t: u32,
        may_go_on: &impl Fn() -> Result<(), Error>,
    ) -> Result<bool, Error> {
        let at = *points.xyz(p);
        let Conflicts { dead, met, .. } = self;
        let own = |flags: u16| !SHARED || flags & flag::OWNER == owner;
        lengthen(dead, 1)?;
        lengthen(met, 1)?;
        (dead[0], met[0]) = (t, t);
        slots.set_flags(t, slots.flags(t) | flag::MET | flag::MARK);
        let (mut dead_count, mut expanded, mut met_count, mut tested) = (1, 0, 1, 1);
        while expanded < dead_count {
            if dead_count > MANY {
                may_go_on()?;
            }
            lengthen(met, met_count + 4 * (dead_count - expanded))?;
            for &t in &dead[expanded..dead_count] {
                for across in slots.adj(t) {
                    let n = across >> 2;
                    let flags = slots.flags(n);
                    met[met_count] = n;
                    met_count += (flags & flag::MET == 0) as usize;
                    slots.prefetch(n);
                    // Flags of tetrahedra of others must not be written, so these may be visited again.
                    if own(flags) {
                        slots.set_flags(n, flags | flag::MET);
                    }
                }
            }
            expanded = dead_count;
            lengthen(dead, dead_count + met_count - tested)?;
            for &n in &met[tested..met_count] {
                let v = slots.verts(n);
                let conflict = if v[3] == GHOST {
                    ghost_in_conflict::<WEIGHTED>(slots, points, n, p)
                } else if WEIGHTED {
                    points.power_perturbed(v, p) == Sign::Positive
                } else {
                    points.inside_perturbed(v, p, &at)
                };
                // Keeps the compiler from turning this into a branch, which would often be mispredicted.
                let conflict = black_box(u16::from(conflict));
                let flags = slots.flags(n);
                if !own(flags) {
                    if conflict != 0 {
                        give_up(slots, owner, &met[..met_count]);
                        return Ok(false);
                    }
                    continue;
                }
                slots.set_flags(n, flags | (flag::MARK * conflict));
                dead[dead_count] = n;
                dead_count += conflict as usize;
            }
            tested = met_count;
        }
        self.dead_count = dead_count;
        self.collect_faces(slots)?;
        for &n in &self.met[..met_count] {
            let flags = slots.flags(n);
            if own(flags) {
                slots.set_flags(n, flags & !flag::MET);
            }
        }
        Ok(true)
    }

    /// The faces between tetrahedra in conflict and others.
    #[inline(always)]
    fn collect_faces(&mut self, slots: &Slots) -> Result<(), Error> {
        lengthen(&mut self.faces, 4 * self.dead_count)?;
        let faces = &mut self.faces[..];
        let mut count = 0;
        for &t in &self.dead[..self.dead_count] {
            let v = slots.verts(t);
            for (across, [x, y, z]) in slots.adj(t).into_iter().zip(GHOST_LAST) {
                faces[count] = [v[x], v[y], v[z], across];
                count += (slots.flags(across >> 2) & flag::MARK == 0) as usize;
            }
        }
        self.face_count = count;
        Ok(())
    }

    /// The tetrahedra in conflict.
    #[inline(always)]
    pub(super) fn dead(&self) -> &[u32] {
        &self.dead[..self.dead_count]
    }

    /// The faces between them and others: vertices, positive as seen from inside and the ghost last, and the corner code across each.
    #[inline(always)]
    pub(super) fn faces(&mut self) -> &mut [[u32; 4]] {
        &mut self.faces[..self.face_count]
    }

    /// The number of these faces.
    #[inline(always)]
    pub(super) fn face_count(&self) -> usize {
        self.face_count
    }

    /// Bytes held.
    pub(super) fn bytes(&self) -> usize {
        4 * (self.dead.capacity() + self.met.capacity() + 4 * self.faces.capacity())
    }
}

/// Clears the marks of a search over tetrahedra of several ranges.
#[cold]
#[inline(never)]
fn give_up(slots: &Slots, owner: u16, met: &[u32]) {
    for &t in met {
        if slots.flags(t) & flag::OWNER == owner {
            slots.set_flags(t, owner);
        }
    }
}
