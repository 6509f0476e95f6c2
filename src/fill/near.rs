//! Which vertices are near a place, by hash grids: a filter that spares cavities, of floating-point arithmetic alone.
//!
//! A vertex is in the grid whose cells are as large as its size, up to the next power of two. Sizes are graded, so what is within a size of
//! a place has a size of about the same: three grids are looked at.
use crate::control::Control;
use crate::elementary::{exponent_above, power_of_two};
use crate::error::Error;
use crate::fallible;
use crate::kernel::NONE;
use crate::predicates::Points;
use crate::size::{distance, Size};
use rustc_hash::FxHashMap;

/// A cell of the grid of an exponent.
pub(super) type Cell = (i32, [i64; 3]);

/// A vertex, and the next one in its cell.
struct Entry {
    at: [f64; 3],
    next: u32,
}

/// Vertices by place.
#[derive(Default)]
pub(super) struct Near {
    first: FxHashMap<Cell, u32>,
    entries: Vec<Entry>,
}

impl Near {
    /// All points, by their sizes.
    pub fn of(points: &Points, size: &Size, control: &Control) -> Result<Near, Error> {
        let mut near = Near::default();
        for v in 0..points.len() as u32 {
            control.step()?;
            near.add(*points.xyz(v), size.of(v))?;
        }
        Ok(near)
    }

    /// Adds a vertex of a size; one without a finite size is left out.
    pub fn add(&mut self, at: [f64; 3], size: f64) -> Result<(), Error> {
        let Some(cell) = cell(&at, size, 0) else { return Ok(()) };
        let next = self.first.get(&cell).copied().unwrap_or(NONE);
        fallible::insert(&mut self.first, cell, self.entries.len() as u32)?;
        fallible::push(&mut self.entries, Entry { at, next })?;
        Ok(())
    }

    /// Whether a vertex is nearer than a radius, which is at most the size of the place.
    pub fn any(&self, at: &[f64; 3], radius: f64, size: f64) -> bool {
        let Some(level) = level(size) else { return false };
        (level - 1..=level + 1).any(|level| {
            let from = at.map(|x| index(x - radius, level));
            let to = at.map(|x| index(x + radius, level));
            (from[0]..=to[0]).any(|i| {
                (from[1]..=to[1])
                    .any(|j| (from[2]..=to[2]).any(|k| self.any_in((level, [i, j, k]), at, radius)))
            })
        })
    }

    fn any_in(&self, cell: Cell, at: &[f64; 3], radius: f64) -> bool {
        let mut next = self.first.get(&cell).copied().unwrap_or(NONE);
        while let Some(entry) = self.entries.get(next as usize) {
            if distance(&entry.at, at) < radius {
                return true;
            }
            next = entry.next;
        }
        false
    }
}

/// The cell of a place in the grid whose cells are as large as a size, up to the next power of two, less a number of halvings.
pub(super) fn cell(at: &[f64; 3], size: f64, finer: i32) -> Option<Cell> {
    let level = level(size)? - finer;
    Some((level, at.map(|x| index(x, level))))
}

/// The exponent of the cells for a size. No coordinate overflows when it is counted in the smallest.
fn level(size: f64) -> Option<i32> {
    (size > 0.0 && size.is_finite()).then(|| exponent_above(size).clamp(-800, 900))
}

/// The number of a cell along an axis; far away from the origin the last one, which only makes the filter slow.
fn index(x: f64, level: i32) -> i64 {
    const FAR: f64 = (1u64 << 60) as f64;
    (x / power_of_two(level)).floor().clamp(-FAR, FAR) as i64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_near_is_found_in_any_cell() {
        let mut near = Near::default();
        let sizes = [1.0, 1.1, 0.9, 2.1];
        let mut state = 3u64;
        let mut random = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (state >> 40) as f64 / 16777216.0 * 8.0 - 4.0
        };
        let all: Vec<[f64; 3]> = (0..200).map(|_| std::array::from_fn(|_| random())).collect();
        for (i, &at) in all.iter().enumerate() {
            near.add(at, sizes[i % 4]).unwrap();
        }
        near.add([0.0; 3], f64::INFINITY).unwrap();
        for _ in 0..1000 {
            let at: [f64; 3] = std::array::from_fn(|_| random());
            let there = all.iter().any(|x| distance(x, &at) < 0.7);
            assert_eq!(near.any(&at, 0.7, 1.05), there);
        }
    }
}
