//! How fine a shape may make the mesh: a share of the shortest segment around, growing with the distance from it.
//!
//! Between features that are close to each other for their size (the sides of a needle, sheets a millionth apart, facets at a small angle) the
//! shape asks for points at their distance from each other, all along them: as many as the ratio of these lengths, or its square. That ratio
//! of a good mesh grows by a constant factor from one tetrahedron to the next (Ruppert 1995, local feature size); here the local feature size is
//! replaced by one that only knows the lengths of segments. So points stay in proportion to the input, whatever is near what; what is
//! flat between close features stays so.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::Mesh;
use crate::predicates::Points;
use crate::segments::recovery::Segments;
use crate::size::{distance, graded};

/// The share. Measured on five CAD models with needles (anchor, bracket, hinge, pinion, rotor_small), ratio 1.414, optimised, before the
/// number of points for a shape was bounded by the input: 524,000 tetrahedra, 6,460 that are not forced below 10°; with 0.2 they are 736,000 and
/// 6,930. With 1 a beam twenty times as long as thick keeps ratios up to 5.
const SHARE: f64 = 0.5;
/// How fast it grows. A beam a hundred times as long as thick gets the ratio; with 0.05 one of twenty does, and the CAD models have 449,000
/// tetrahedra; with 0.3 they have 321,000, 6,010 below 10°.
const SLOPE: f64 = 0.02;

/// The shortest segment around each vertex.
pub(super) struct Floor(Vec<f64>);

impl Floor {
    pub fn new(mesh: &Mesh, points: &Points, segments: &Segments, control: &Control) -> Result<Floor, Error> {
        let mut lengths = fallible::filled(f64::INFINITY, points.len())?;
        for &[a, b] in &segments.ends {
            control.step()?;
            let length = distance(points.xyz(a), points.xyz(b));
            for v in [a, b] {
                lengths[v as usize] = length.min(lengths[v as usize]);
            }
        }
        graded(&mut lengths, mesh, points, SLOPE, control)?;
        Ok(Floor(lengths))
    }

    /// The least edge for a shape at a place that has these vertices around it.
    pub fn at(&self, points: &Points, at: &[f64; 3], around: impl Iterator<Item = u32>) -> f64 {
        let of = |v: u32| self.0.get(v as usize).copied().unwrap_or(f64::INFINITY);
        SHARE * around.map(|v| of(v) + SLOPE * distance(points.xyz(v), at)).fold(f64::INFINITY, f64::min)
    }

    /// Notes what holds at a new vertex.
    pub fn set(&mut self, v: u32, floor: f64) -> Result<(), Error> {
        if self.0.len() <= v as usize {
            fallible::resize(&mut self.0, v as usize + 1, f64::INFINITY)?;
        }
        self.0[v as usize] = floor / SHARE;
        Ok(())
    }
}
