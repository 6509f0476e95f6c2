//! Positions for points that are there: found and tested first, taken then.
use crate::error::Error;
use crate::fallible;
use crate::predicates::located::{Implicit, Located};
use crate::predicates::points::NONE;
use crate::predicates::{Expansion, Points, Sign};

/// A position that a point may take.
#[derive(Debug)]
pub struct Placed {
    /// The nearest doubles.
    pub(super) xyz: [f64; 3],
    /// If they are not exact.
    pub(super) implicit: Option<Implicit>,
}

impl Placed {
    /// The nearest doubles.
    pub fn xyz(&self) -> &[f64; 3] {
        &self.xyz
    }

    /// Whether they are the position.
    pub fn is_explicit(&self) -> bool {
        self.implicit.is_none()
    }

    pub(super) fn located(&self) -> Located<'_> {
        Located { xyz: &self.xyz, implicit: self.implicit.as_ref() }
    }
}

impl Points {
    /// The position `a + t (b − a)`.
    ///
    /// # Errors
    /// As [`Points::push_on_segment`].
    pub fn place_on_segment(&self, [a, b]: [u32; 2], t: f64) -> Result<Placed, Error> {
        let (xyz, implicit) = self.on_segment(a, b, &Expansion::from(t))?;
        Ok(Placed { xyz, implicit })
    }

    /// [`Points::orient_in_plane`] of a position and two points.
    pub fn orient_placed(&self, axis: usize, p: &Placed, a: u32, b: u32) -> Sign {
        let [a, b] = self.located([a, b]);
        self.orient_in_plane_of(axis, [p.located(), a, b])
    }

    /// Moves a point to a position.
    ///
    /// # Errors
    /// `Internal` if the point is below the first that may be implicit ([`Points::allow_implicit`]); `OutOfMemory`.
    pub fn take(&mut self, i: u32, placed: Placed) -> Result<(), Error> {
        let slot = i.checked_sub(self.first_implicit).map(|k| k as usize);
        let Some(slot) = slot.filter(|&k| k < self.slots.len()) else {
            return Err(Error::internal("a point that cannot be implicit cannot take a position"));
        };
        let Placed { xyz, implicit } = placed;
        self.xyz[i as usize] = xyz;
        let Some(implicit) = implicit else {
            self.slots[slot] = NONE;
            self.take_explicit(xyz);
            return Ok(());
        };
        match self.implicit.get_mut(self.slots[slot] as usize) {
            Some(old) => *old = implicit,
            None => {
                fallible::push(&mut self.implicit, implicit)?;
                self.slots[slot] = self.implicit.len() as u32 - 1;
            }
        }
        self.cover(&xyz);
        if self.implicit.len() == 1 {
            self.update_bounds();
        }
        Ok(())
    }

    /// Lets all points from this one on become implicit.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn allow_implicit(&mut self, first: u32) -> Result<(), Error> {
        let end = self.first_implicit.min(self.xyz.len() as u32);
        if first >= end {
            return Ok(());
        }
        let mut slots = fallible::filled(NONE, (end - first) as usize)?;
        fallible::append(&mut slots, &self.slots)?;
        self.slots = slots;
        self.first_implicit = first;
        Ok(())
    }
}
