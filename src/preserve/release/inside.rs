//! Removal of points inside that the surface does not need: one by one, then in pairs, until none goes.
use crate::control::Control;
use crate::error::Error;
use crate::kernel::Mesh;
use crate::ops::contract::Contract;
use crate::ops::hollow::Growth;
use crate::ops::remove_vertex::RemoveVertex;
use crate::predicates::Points;
use crate::preserve::inside::Inside;
use crate::preserve::memory::Memory;
use rustc_hash::FxHashSet;

/// Deletes points inside.
pub struct Thin<'a> {
    control: &'a Control<'a>,
    remove: RemoveVertex<'a>,
    contract: Contract<'a>,
}

impl<'a> Thin<'a> {
    /// Nothing is done yet.
    pub fn new(control: &'a Control<'a>) -> Self {
        Thin { control, remove: RemoveVertex::new(control), contract: Contract::new(control) }
    }

    /// Tries to remove each point with the given budget until none can be removed; returns the number removed.
    pub fn run(
        &mut self,
        mesh: &mut Mesh,
        points: &mut Points,
        inside: &mut Inside,
        isolated: &FxHashSet<[u32; 2]>,
        growth: Growth,
    ) -> Result<u64, Error> {
        let (mut lasting, mut unmerged) = (Memory::default(), Memory::default());
        let mut gone = 0;
        loop {
            let before = gone;
            for i in (0..inside.list.len()).rev() {
                self.control.step()?;
                let p = inside.list[i];
                if lasting.knows(mesh, p) {
                    continue;
                }
                if self.remove.remove(mesh, points, p, isolated, growth)? {
                    gone += 1;
                } else {
                    lasting.note(mesh, p, &self.remove.read)?;
                }
            }
            inside.sweep(mesh);
            for i in (0..inside.list.len()).rev() {
                self.control.step()?;
                let p = inside.list[i];
                if unmerged.knows(mesh, p) {
                    continue;
                }
                if self.contract.merge(mesh, points, &inside.list, p, growth.budget)? {
                    gone += 1;
                } else {
                    unmerged.note(mesh, p, &self.contract.read)?;
                }
            }
            inside.sweep(mesh);
            if gone == before {
                return Ok(gone);
            }
        }
    }
}
