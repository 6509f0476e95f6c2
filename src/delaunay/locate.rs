//! Point location by a visibility walk (Devillers, Pion & Teillaud 2002): from tetrahedron to tetrahedron through a face
//! that separates it from the target. In a Delaunay tetrahedralization the walk cannot cycle (Edelsbrunner 1990).
use super::Delaunay;
use crate::error::Error;
use crate::mesh::slots::Slots;
use crate::mesh::{flag, GHOST};
use crate::predicates::{Points, Sign};

/// Where a walk ended.
pub(super) enum Walk {
    /// At a tetrahedron in conflict.
    Found(u32),
    /// At one that the range does not own.
    Left,
    /// Nowhere: the mesh is broken.
    Lost,
}

impl Delaunay {
    /// A tetrahedron in conflict with `p`: the finite one that contains it (boundary included) or a ghost whose hull face
    /// sees it.
    pub fn locate(&self, points: &Points, p: u32, start: u32) -> Result<u32, Error> {
        match walk::<false>(&self.mesh.slots(), 0, points, p, start) {
            Walk::Found(t) => Ok(t),
            _ => Err(Error::internal("point location did not end")),
        }
    }
}

/// Walks to `p`; with `SHARED` through tetrahedra of the range `owner` only, of which `start` must be one.
#[inline(always)]
pub(super) fn walk<const SHARED: bool>(
    slots: &Slots,
    owner: u16,
    points: &Points,
    p: u32,
    start: u32,
) -> Walk {
    let mut t = start;
    if slots.vertex(t, 3) == GHOST {
        t = slots.across(4 * t + 3) >> 2;
        if SHARED && slots.flags(t) & flag::OWNER != owner {
            return Walk::Left;
        }
    }
    // The face we came through needs no test. The first face tested rotates with the step count: a fixed order makes
    // walks longer.
    let mut entered = 4u32;
    let limit = 4 * slots.count() + 64;
    for step in 0..limit {
        let mut next = None;
        for i in 0..4u32 {
            let f = (i + step as u32) & 3;
            if f == entered {
                continue;
            }
            let [x, y, z] = slots.face(4 * t + f);
            let side = points.orient3d(p, x, y, z);
            if side == Sign::Negative {
                next = Some(slots.across(4 * t + f));
                break;
            }
        }
        let Some(code) = next else { return Walk::Found(t) };
        t = code >> 2;
        entered = code & 3;
        if SHARED && slots.flags(t) & flag::OWNER != owner {
            return Walk::Left;
        }
        if slots.vertex(t, 3) == GHOST {
            return Walk::Found(t);
        }
    }
    Walk::Lost
}
