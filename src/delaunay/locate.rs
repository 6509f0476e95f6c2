//! Point location by a visibility walk (Devillers, Pion & Teillaud 2002): from tetrahedron to tetrahedron through a face
//! that separates it from the target. In a Delaunay tetrahedralization, weighted or
//! not, the walk cannot cycle (Edelsbrunner 1990).
use crate::error::Error;
use crate::kernel::slots::Slots;
use crate::kernel::{flag, Mesh, GHOST};
use crate::predicates::{Glance, Points, Sign};

/// Where a walk ended.
pub(super) enum Walk {
    /// At this tetrahedron in conflict, after this many steps.
    Found(u32, u32),
    /// At a tetrahedron that the range does not own.
    Left,
    /// Nowhere: the mesh is broken.
    Lost,
}

/// A tetrahedron in conflict with `p`: the finite one that contains it (including its boundary) or a ghost whose hull face sees it. The
/// walk starts at `start`, which must be live.
pub fn locate(mesh: &Mesh, points: &Points, p: u32, start: u32) -> Result<u32, Error> {
    if start as usize >= mesh.slot_count() || !mesh.is_live(start) {
        return Err(Error::internal("point location starts nowhere"));
    }
    match walk::<false, true, false>(&mesh.slots(), 0, points, p, start) {
        Walk::Found(t, _) => Ok(t),
        _ => Err(Error::internal("point location did not terminate")),
    }
}

/// Walks to `p`; with `SHARED` only through tetrahedra of the range `owner`, including `start`. Ends at the tetrahedron that contains `p`,
/// or without `INTO` at the first one in conflict. With `WEIGHTED` the one that contains `p` need not be in conflict.
#[inline(always)]
pub(super) fn walk<const SHARED: bool, const INTO: bool, const WEIGHTED: bool>(
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
    let at = *points.xyz(p);
    // The face through which the walk entered needs no test.
    let mut entered = 4u32;
    let limit = 4 * slots.count() + 64;
    for step in 0..limit {
        let glance = match (INTO, WEIGHTED) {
            (true, _) => Glance::Unclear,
            (false, true) => points.glance_power(slots.verts(t), p),
            (false, false) => points.glance(slots.verts(t), &at),
        };
        let face = match glance {
            Glance::Inside => return Walk::Found(t, step as u32),
            Glance::Beyond(face) => face,
            Glance::Unclear => match separating(slots, points, p, t, step as u32, entered) {
                Some(face) => face,
                None => return Walk::Found(t, step as u32),
            },
        };
        let code = slots.across(4 * t + face);
        t = code >> 2;
        entered = code & 3;
        if SHARED && slots.flags(t) & flag::OWNER != owner {
            return Walk::Left;
        }
        if slots.vertex(t, 3) == GHOST {
            return Walk::Found(t, step as u32);
        }
    }
    Walk::Lost
}

/// A face of `t` with `p` beyond its plane. The first face tested rotates with `turn`: a fixed order makes walks longer.
#[inline(always)]
fn separating(slots: &Slots, points: &Points, p: u32, t: u32, turn: u32, entered: u32) -> Option<u32> {
    (0..4).map(|i| (i + turn) & 3).find(|&f| {
        let [x, y, z] = slots.face(4 * t + f);
        f != entered && points.orient3d(p, x, y, z) == Sign::Negative
    })
}
