//! Flips steered by the Delaunay tetrahedralization of the points.
//!
//! An edge of that tetrahedralization costs nothing. A missing edge will take Steiner points: it costs one if it lies on the input's
//! surface, and much more if it is a new edge off it, since its Steiner points would lie off the surface too. Flips that lower the cost are
//! made as long as there are any; then the flips that made new edges of the expensive kind are undone, together with later flips that
//! changed the triangles at them.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::merge::flipper::{Candidate, Flipper};
use crate::plc::merge::Guide;
use crate::progress::Phase;

/// Limit of undo rounds: a restored edge may itself be expensive. 16 and 64 change nothing on seven models: it only bounds the work on
/// worse ones.
const ROUNDS: usize = 32;
/// Limit of flips undone for one edge. 500 and 2,000 change nothing on three models: it only bounds the work on worse ones.
const DEPTH: usize = 1000;
/// What an edge costs that the Delaunay tetrahedralization does not have: without it only edges off the surface would be steered away from.
/// On six models with 1,326 Steiner points 0 takes 0.1 % more, 2 the same.
const MISSING: u32 = 1;
/// What it costs if it also lies off the input's surface: a thousand times as much. 500 and 2,000 change nothing on four models: nothing
/// measurable depends on it.
const MISSING_BESIDE: u32 = 1000;

impl Flipper<'_> {
    fn cost(&self, guide: &mut Guide, ends: [u32; 2], deviation: f64) -> u32 {
        match (deviation <= self.negligible, (guide.is_edge)(ends)) {
            (true, true) => 0,
            (true, false) => MISSING,
            (false, true) if !guide.avoids(ends) => 0,
            (false, _) => MISSING_BESIDE,
        }
    }

    fn live_cost(&self, guide: &mut Guide, ends: [u32; 2]) -> u32 {
        let deviation = self.edges.maker(ends).map_or(0.0, |k| self.records[k as usize].deviation);
        self.cost(guide, ends, deviation)
    }

    /// Whether the flip lowers the cost.
    pub(super) fn is_cheaper(&self, guide: &mut Guide, candidate: &Candidate) -> bool {
        let [a, b, c, d] = candidate.vertices;
        let old = self.live_cost(guide, [a, b]);
        old > 0 && self.cost(guide, [c, d], self.new_deviation(candidate)) < old
    }

    /// The edges made by flips that lie off the input's surface, sorted.
    pub(super) fn edges_beside(&self, control: &Control) -> Result<Vec<[u32; 2]>, Error> {
        let mut beside: Vec<[u32; 2]> = Vec::new();
        for (ends, record) in self.surface.facet_flips.iter().map(|flip| flip.new).zip(&self.records) {
            control.step()?;
            if record.deviation > self.negligible && self.is_beside(ends) {
                fallible::push(&mut beside, [ends[0].min(ends[1]), ends[0].max(ends[1])])?;
            }
        }
        beside.sort_unstable();
        beside.dedup();
        Ok(beside)
    }

    /// Whether there is such an edge and it lies off the input's surface.
    fn is_beside(&self, ends: [u32; 2]) -> bool {
        self.edges.maker(ends).is_some_and(|k| self.records[k as usize].deviation > self.negligible)
    }

    /// Undoes flips until no missing edge lies off the input's surface, or none of those can be undone.
    pub(super) fn take_back(&mut self, guide: &mut Guide, control: &Control) -> Result<(), Error> {
        for _ in 0..ROUNDS {
            control.progress(Phase::Validate, 0.95)?;
            let before = self.records.len();
            for k in 0..before {
                control.step()?;
                let ends = self.surface.facet_flips[k].new;
                if self.is_beside(ends) && self.live_cost(guide, ends) == MISSING_BESIDE {
                    self.take_back_edge(ends, control)?;
                }
            }
            if self.records.len() == before || self.is_exhausted() {
                break;
            }
        }
        Ok(())
    }

    /// Undoes the flip that made an edge, after undoing those that have changed the triangles at it since.
    fn take_back_edge(&mut self, ends: [u32; 2], control: &Control) -> Result<(), Error> {
        let mut stack: Vec<[u32; 2]> = Vec::new();
        fallible::push(&mut stack, ends)?;
        let mut steps = 0;
        while let Some(&edge) = stack.last() {
            control.step()?;
            steps += 1;
            if steps > DEPTH {
                break;
            }
            if !self.edges.contains(edge) {
                stack.pop();
                continue;
            }
            let Some(maker) = self.edges.maker(edge) else { break };
            let ([a, b], [c, d]) = (self.surface.facet_flips[maker as usize].old, edge);
            let around = [[a, c], [c, b], [b, d], [d, a]];
            if let Some(gone) = around.into_iter().find(|&e| !self.edges.contains(e)) {
                match self.heir(gone) {
                    Some(heir) if !stack.contains(&heir) => {
                        fallible::push(&mut stack, heir)?;
                        continue;
                    }
                    _ => break,
                }
            }
            let Some(candidate) = self.candidate(edge) else { break };
            let [_, _, p, q] = candidate.vertices;
            if ([p, q] != [a, b] && [q, p] != [a, b]) || !self.is_allowed(&candidate, control)? {
                break;
            }
            self.flip(&candidate)?;
            stack.pop();
        }
        Ok(())
    }

    /// The edge that now replaces a flipped one, if any.
    fn heir(&self, mut edge: [u32; 2]) -> Option<[u32; 2]> {
        for _ in 0..DEPTH {
            let flip = self.surface.facet_flips.get(self.edges.remover(edge)? as usize)?;
            edge = flip.new;
            if self.edges.contains(edge) {
                return Some(edge);
            }
        }
        None
    }
}
