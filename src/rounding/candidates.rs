//! Positions to try for a Steiner point whose nearest double is not valid.
use crate::elementary::power_of_two;
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
    pub fn exact_parameters(&self, points: &Points) -> Vec<f64> {
        let bits = points.exact_bits(self.ends[0], self.ends[1]);
        if bits == 0 {
            return Vec::new();
        }
        let unit = (1u64 << bits.min(52)) as f64;
        let low = (self.t * unit).floor();
        let mut list: Vec<f64> = [low, low + 1.0, low - 1.0, low + 2.0]
            .iter()
            .map(|k| k / unit)
            .filter(|&t| self.has_room(t))
            .collect();
        list.sort_by(|x, y| (x - self.t).abs().total_cmp(&(y - self.t).abs()));
        list
    }

    /// Parameters round the present one, in growing steps: each rounds differently.
    pub fn nearby_parameters(&self) -> Vec<f64> {
        let span = self.room[1] - self.room[0];
        let mut list = Vec::new();
        for power in [-40i32, -36, -32, -28, -24, -20, -16] {
            for k in 1..=8 {
                for sign in [-1.0, 1.0] {
                    let t = self.t + sign * k as f64 * span * power_of_two(power);
                    if self.has_room(t) {
                        list.push(t);
                    }
                }
            }
        }
        list
    }
}

/// Steps in units in the last place, nearest first; the zero step is left out.
pub fn lattice() -> impl Iterator<Item = [i8; 3]> {
    let mut steps: Vec<[i8; 3]> = Vec::new();
    for x in -3i8..=3 {
        for y in -3i8..=3 {
            for z in -3i8..=3 {
                if [x, y, z] != [0, 0, 0] {
                    steps.push([x, y, z]);
                }
            }
        }
    }
    steps.sort_by_key(|s| s.iter().map(|&x| x as i32 * x as i32).sum::<i32>());
    steps.into_iter()
}
