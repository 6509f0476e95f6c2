//! The caller's limit on tetrahedra, for a mesh that grows.
use super::Mesh;
use crate::control::Control;
use crate::error::Error;

/// Counts tetrahedra only when there may be too many. In between, no ghosts may go: a domain may only get more faces.
#[derive(Debug, Default)]
pub struct Budget {
    /// With so many tetrahedra and ghosts, the limit is not exceeded.
    safe: usize,
}

impl Budget {
    /// To be called after each step that may have added tetrahedra.
    ///
    /// # Errors
    /// `TetrahedraLimit` if there are more than the caller allows.
    #[inline(always)]
    pub fn check(&mut self, mesh: &Mesh, control: &Control) -> Result<(), Error> {
        if mesh.live_count() <= self.safe {
            return Ok(());
        }
        self.count(mesh, control)
    }

    #[cold]
    #[inline(never)]
    fn count(&mut self, mesh: &Mesh, control: &Control) -> Result<(), Error> {
        let Some(limit) = control.tetrahedra_limit() else {
            self.safe = usize::MAX;
            return Ok(());
        };
        let count = mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)).count();
        control.worked(mesh.slot_count());
        control.tetrahedra(count)?;
        self.safe = mesh.live_count().saturating_add(usize::try_from(limit).unwrap_or(usize::MAX) - count);
        Ok(())
    }

    /// How many more there may be, after a check, at least.
    pub fn room(&self, mesh: &Mesh) -> usize {
        self.safe.saturating_sub(mesh.live_count())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::control::{controlled, Limits};
    use crate::error::Status;
    use crate::progress::Silent;

    #[test]
    fn ghosts_do_not_count() {
        let mesh = Mesh::of_tetrahedra(&[[0, 1, 2, 3], [0, 2, 1, 4]], 5).unwrap();
        assert!(mesh.live_count() > 2);
        for (limit, room) in [(1, None), (2, Some(0)), (5, Some(3)), (u64::MAX, Some(usize::MAX))] {
            controlled(Limits { tetrahedra: Some(limit), ..Limits::default() }, &mut Silent, |control| {
                let mut budget = Budget::default();
                let outcome = budget.check(&mesh, control).map(|()| budget.room(&mesh));
                match room {
                    None => assert_eq!(outcome.unwrap_err().status, Status::TetrahedraLimit),
                    Some(usize::MAX) => assert!(outcome.unwrap() > 1 << 30),
                    Some(room) => assert_eq!(outcome.unwrap(), room),
                }
            });
        }
        let mut budget = Budget::default();
        budget.check(&mesh, &Control::free()).unwrap();
        assert!(budget.room(&mesh) > 1 << 30);
    }
}
