//! Divisions of space into ranges, and the tetrahedra that belong to each.
//!
//! Any map from vertices to ranges is correct; these make few tetrahedra cross from one range to another. The first pass of a round uses
//! consecutive pieces of the Hilbert curve, later ones slabs across an oblique direction, which meet the first pass's borders (where nearly
//! all remaining vertices are) only in lines.
//!
//! Neither depends on the number of threads.
use crate::delaunay::order::{curve_indices, Frame};
use crate::error::Error;
use crate::fallible;
use crate::kernel::flag;
use crate::predicates::Points;

/// The fewest tetrahedra of a section that is worth a thread.
pub(super) const FEWEST: usize = 1 << 16;
/// With this many present vertices a round has two ranges.
const FEWEST_PRESENT: usize = 1 << 13;
/// Directions of slabs.
const DIRECTIONS: [[f64; 3]; 3] = [[0.61, 0.83, 1.07], [1.09, -0.67, 0.79], [-0.73, 1.03, 0.59]];
/// Number of vertices from which borders between slabs are chosen.
const SAMPLE: usize = 4096;

/// Ranges and their vertices.
pub(super) struct Division {
    /// Range of each vertex in the mesh, from 1.
    owner_of: Vec<u16>,
    /// The vertices that each range inserts.
    pub(super) parts: Vec<Vec<u32>>,
}

/// The number of ranges of a round while `present` vertices are in the mesh. It grows as the square root, so that the fraction of a range's
/// vertices near its borders shrinks.
pub(super) fn range_count(present: usize) -> usize {
    if present < FEWEST_PRESENT {
        return 1;
    }
    ((present as f64 / FEWEST_PRESENT as f64).sqrt() as usize).clamp(2, flag::OWNER as usize)
}

impl Division {
    fn new(points: &Points, count: usize, each: usize) -> Result<Self, Error> {
        let owner_of = fallible::filled(0, points.len())?;
        let mut parts: Vec<Vec<u32>> = fallible::reserved(count)?;
        for _ in 0..count {
            fallible::push(&mut parts, fallible::reserved(each)?)?;
        }
        Ok(Division { owner_of, parts })
    }

    /// Consecutive pieces of `round`, which is sorted along the curve in `frame`.
    pub(super) fn along_curve(
        points: &Points,
        frame: &Frame,
        present: &[u32],
        round: &[u32],
        count: usize,
    ) -> Result<Self, Error> {
        let mut division = Division::new(points, 0, 0)?;
        let each = round.len().div_ceil(count);
        let mut borders = Vec::new();
        for piece in round.chunks(each) {
            let part = fallible::copied(piece)?;
            if !division.parts.is_empty() {
                fallible::push(&mut borders, curve_indices(points.coordinates(), &piece[..1], frame)[0])?;
            }
            fallible::push(&mut division.parts, part)?;
            let owner = division.parts.len() as u16;
            for &v in piece {
                division.owner_of[v as usize] = owner;
            }
        }
        for few in present.chunks(8) {
            let indices = curve_indices(points.coordinates(), few, frame);
            for (&v, index) in few.iter().zip(indices) {
                division.owner_of[v as usize] = borders.partition_point(|&b| b <= index) as u16 + 1;
            }
        }
        Ok(division)
    }

    /// Slabs with about equally many vertices of `round`.
    pub(super) fn slabs(
        points: &Points,
        present: &[u32],
        round: &[u32],
        count: usize,
        turn: usize,
    ) -> Result<Self, Error> {
        let direction = DIRECTIONS[turn % DIRECTIONS.len()];
        let height = |v: u32| {
            let p = points.xyz(v);
            p[0] * direction[0] + p[1] * direction[1] + p[2] * direction[2]
        };
        let mut sample = Vec::new();
        fallible::extend(
            &mut sample,
            round.iter().step_by(round.len().div_ceil(SAMPLE).max(1)).map(|&v| height(v)),
        )?;
        sample.sort_unstable_by(f64::total_cmp);
        let borders =
            fallible::collect((1..count).filter_map(|i| sample.get(i * sample.len() / count).copied()))?;
        let mut division = Division::new(points, count, round.len() / count + round.len() / 16)?;
        let slab = |v: u32| {
            let h = height(v);
            borders.partition_point(|&b| b <= h)
        };
        for &v in present {
            division.owner_of[v as usize] = slab(v) as u16 + 1;
        }
        for &v in round {
            let part = &mut division.parts[slab(v)];
            fallible::push(part, v)?;
        }
        Ok(division)
    }

    /// Writes owners into the flags of tetrahedra: the number of the range that has all vertices, or 0 if they differ.
    pub(super) fn assign(&self, verts: &[[u32; 4]], flags: &mut [u16]) {
        for (v, flags) in verts.iter().zip(flags) {
            if *flags & flag::DEAD != 0 {
                continue;
            }
            let [a, b, c] = [v[0], v[1], v[2]].map(|v| self.owner_of[v as usize]);
            let d = self.owner_of.get(v[3] as usize).copied().unwrap_or(a);
            debug_assert!(a != 0 && b != 0 && c != 0 && d != 0);
            *flags = if (a == b) & (a == c) & (a == d) { a } else { 0 };
        }
    }
}
