//! Positions to try for a Steiner point whose nearest double is not valid.
use crate::elementary::power_of_two;
use crate::error::Error;
use crate::fallible;
use crate::predicates::Points;
use crate::segments::recovery::Segments;

/// A Steiner point on its segment, and the room it has there.
pub struct Candidate {
    /// Ends of the segment.
    pub ends: [u32; 2],
    /// The present parameter.
    pub t: f64,
    /// Parameters of the neighbours on the segment.
    room: [f64; 2],
}

impl Candidate {
    /// The Steiner point `v`, if it is one.
    pub fn of(points: &Points, segments: &Segments, v: u32) -> Option<Self> {
        let (a, b, t) = points.implicit_parameters(v)?;
        // A parameter of several doubles cannot be changed.
        let [t] = *t.components() else { return None };
        Some(Candidate { ends: [a, b], t, room: segments.neighbors_on_segment(v)? })
    }

    fn has_room(&self, t: f64) -> bool {
        t > self.room[0] && t < self.room[1] && t != self.t
    }

    /// Parameters near the present one that make the point an exact double, nearest first.
    pub fn exact_parameters(&self, points: &Points) -> Result<Vec<f64>, Error> {
        let bits = points.exact_bits(self.ends[0], self.ends[1]);
        if bits == 0 {
            return Ok(Vec::new());
        }
        let unit = (1u64 << bits.min(52)) as f64;
        let low = (self.t * unit).floor();
        let near = [low, low + 1.0, low - 1.0, low + 2.0].map(|k| k / unit);
        let mut list = fallible::collect(near.into_iter().filter(|&t| self.has_room(t)))?;
        fallible::stable_sort_by(&mut list, |x, y| (x - self.t).abs().total_cmp(&(y - self.t).abs()))?;
        Ok(list)
    }

    /// Parameters round the present one, in growing steps: each rounds differently.
    pub fn nearby_parameters(&self) -> Result<Vec<f64>, Error> {
        let span = self.room[1] - self.room[0];
        let mut list = Vec::new();
        for power in [-40i32, -36, -32, -28, -24, -20, -16] {
            for k in 1..=8 {
                for sign in [-1.0, 1.0] {
                    let t = self.t + sign * k as f64 * span * power_of_two(power);
                    if self.has_room(t) {
                        fallible::push(&mut list, t)?;
                    }
                }
            }
        }
        Ok(list)
    }
}

/// The number of steps of up to three units on each axis.
const STEPS: usize = 7 * 7 * 7 - 1;

/// Steps in units in the last place, nearest first; the zero step is left out.
pub fn lattice() -> [[i8; 3]; STEPS] {
    // The zero step is in the middle.
    let digits = |i: i16| [i / 49, i / 7 % 7, i % 7].map(|digit| digit as i8 - 3);
    let mut steps: [[i8; 3]; STEPS] = std::array::from_fn(|i| digits(i as i16 + i16::from(i >= STEPS / 2)));
    steps.sort_unstable_by_key(|s| (s.iter().map(|&x| i32::from(x) * i32::from(x)).sum::<i32>(), *s));
    steps
}
