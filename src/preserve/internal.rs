//! Internal patches and segments: those with the mesh on all sides. If only the outer boundary is kept ([`Preserve::Outer`]), points may
//! stay on them.
//!
//! A patch has the outside on one side everywhere or nowhere: where that changes, another facet meets it at segments, which bound patches.
//! A segment is a segment of the outer boundary if a boundary face has one of its pieces: its ends are the only vertices of other facets on
//! it, so all pieces are alike.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::edge_key;
use crate::kernel::Mesh;
use crate::options::Preserve;
use crate::segments::recovery::Segments;
use rustc_hash::FxHashSet;

/// Internal patches and points on internal segments. Empty if everything is to be kept.
#[derive(Debug, Default)]
pub struct Internal {
    /// The patches.
    pub patches: FxHashSet<u32>,
    /// For each Steiner point whether it is on such a segment.
    points: Vec<bool>,
    first: u32,
}

impl Internal {
    /// Finds what may get triangles and points other than the surface's, by `preserve`.
    pub fn find(
        preserve: Preserve,
        mesh: &Mesh,
        segments: &Segments,
        control: &Control,
    ) -> Result<Internal, Error> {
        let mut internal = Internal { first: segments.first_steiner, ..Internal::default() };
        if preserve == Preserve::All {
            return Ok(internal);
        }
        fallible::add_all(&mut internal.patches, mesh.subfaces().map(|code| mesh.subface(code)))?;
        let mut outer: FxHashSet<[u32; 2]> = FxHashSet::default();
        for t in (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t)) {
            if !mesh.is_ghost(t) {
                continue;
            }
            control.step()?;
            internal.patches.remove(&mesh.subface(4 * t + 3));
            let [a, b, c] = mesh.face(4 * t + 3);
            fallible::add_all(&mut outer, [edge_key(a, b), edge_key(b, c), edge_key(c, a)])?;
        }
        fallible::resize(&mut internal.points, segments.steiner_t.len(), true)?;
        for piece in &segments.pieces {
            control.step()?;
            if !outer.contains(&edge_key(piece.ends[0], piece.ends[1])) {
                continue;
            }
            for v in piece.ends {
                let index = v.checked_sub(internal.first).map(|i| i as usize);
                if let Some(at) = index.and_then(|i| internal.points.get_mut(i)) {
                    *at = false;
                }
            }
        }
        Ok(internal)
    }

    /// Whether any Steiner point may stay on its segment.
    pub fn any_may_stay(&self) -> bool {
        self.points.contains(&true)
    }

    /// These points may no longer stay.
    pub fn forbid(&mut self, list: &[u32]) {
        for v in list {
            self.points[(v - self.first) as usize] = false;
        }
    }

    /// Whether a Steiner point may stay on its segment.
    pub fn may_stay(&self, v: u32) -> bool {
        v.checked_sub(self.first).and_then(|i| self.points.get(i as usize)).is_some_and(|&x| x)
    }
}
