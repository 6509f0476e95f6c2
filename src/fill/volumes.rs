//! The bound on volumes: what is above it gets a point, the largest first.
//!
//! It holds everywhere but over triangles of the surface that are too coarse for it: a flat tetrahedron there would be worse than a large
//! one. A split is a point at the circumcentre, or where that is of no use at the centroid, which is always inside and splits the tetrahedron
//! at least.
//!
//! Why it ends: the number of points is bounded by the sum of volumes over bounds; each of them takes at least a part of a tetrahedron.
use crate::error::{Error, Status};
use crate::fallible;
use crate::fill::{Attempt, Fill, Limits, APART_FOR_SHAPE, MOST_POINTS};
use crate::kernel::NONE;
use crate::size::Bounds;
use std::cmp::Reverse;

impl Fill<'_, '_> {
    /// Splits what is above its bound.
    pub(super) fn bound_volumes(&mut self, bounds: &Bounds) -> Result<(), Error> {
        self.queue.clear();
        let mut sum = 0.0;
        for t in self.mesh.all() {
            self.part.step()?;
            sum += self.push_large(bounds, t)?;
        }
        // Twice as many points as that volume has tetrahedra are never needed: a net for arithmetic gone astray.
        if sum > 6.0 * MOST_POINTS {
            return Err(Error::new(
                Status::TooLarge,
                format_args!(
                    "the bound on volumes asks for about {sum:.1e} tetrahedra, more than a mesh can have"
                ),
            ));
        }
        let mut left = 100 + (2.0 * sum) as u64;
        while let Some((_, Reverse(t), since)) = self.queue.pop() {
            self.part.step()?;
            if left == 0 || !self.mesh.is_live(t) || self.mesh.changed(t) != since {
                continue;
            }
            if self.split_large(t)? {
                left -= 1;
                for i in 0..self.insert.fresh().len() {
                    self.push_large(bounds, self.insert.fresh()[i])?;
                }
                // The point may have come elsewhere.
                if self.mesh.changed(t) == since {
                    self.push_large(bounds, t)?;
                }
            }
        }
        Ok(())
    }

    /// Takes note of a tetrahedron above its bound; how many times the bound it is.
    fn push_large(&mut self, bounds: &Bounds, t: u32) -> Result<f64, Error> {
        if !self.mesh.is_live(t) || self.mesh.region(t) == NONE {
            return Ok(0.0);
        }
        let excess = bounds.excess(self.mesh, self.points, t);
        if excess <= 1.0 {
            return Ok(0.0);
        }
        let entry = (excess.min(1e300).to_bits(), Reverse(t), self.mesh.changed(t));
        fallible::push_heap(&mut self.queue, entry)?;
        Ok(excess)
    }

    fn split_large(&mut self, t: u32) -> Result<bool, Error> {
        let near = Limits { apart: APART_FOR_SHAPE, at_walls: true, for_size: true };
        if let Some(centre) = self.circumcentre(t) {
            if let Attempt::Done = self.attempt(centre, t, near)? {
                return Ok(true);
            }
        }
        let middle = self.centroid(t);
        if let Attempt::Done = self.attempt(middle, t, near)? {
            return Ok(true);
        }
        // Over a coarse triangle of the surface this would be flat.
        if (4 * t..4 * t + 4).any(|code| self.mesh.is_wall(code)) {
            return Ok(false);
        }
        let anyhow = Limits { apart: 0.0, at_walls: false, for_size: true };
        Ok(matches!(self.attempt(middle, t, anyhow)?, Attempt::Done))
    }
}
