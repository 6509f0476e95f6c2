//! The quality of a mesh as data: measures of every tetrahedron, histograms, the worst tetrahedra, and those that the input forces to be
//! bad.
//!
//! Users look at the smallest and the largest dihedral angle (interpolation suffers from large ones, conditioning from both), the
//! radius-edge ratio (what Delaunay refinement bounds) and the mean ratio η; and at histograms and worst values, not at means. What each
//! measure is good for: Shewchuk, *What Is a Good Linear Finite Element?*, 2002. The mean ratio: Liu & Joe, *Relationship between
//! Tetrahedron Shape Measures*, 1994.
//!
//! Invariant: the measures of a tetrahedron depend on its four points alone, to the last bit, not on their order or numbers and not on the
//! platform; nothing here divides by zero, overflows or makes a NaN. They are information: no decision about a mesh rests on them.
//!
//! * [`tet`]: the measures of one tetrahedron.
//! * [`summary`]: histograms and worst tetrahedra.
//! * `rough`: their bins without the measures.
//! * [`forced`]: tetrahedra in narrow wedges between two facets.
//! * [`skinny`]: tetrahedra above a radius-edge ratio, and what forces them.
//! * `corners`: narrow corners of facets.

mod corners;
pub mod forced;
mod rough;
pub mod skinny;
pub mod summary;
#[cfg(test)]
mod tests;
pub mod tet;

pub use forced::{forced_tets, ForcedTet, FORCED_BELOW};
pub use skinny::{skinny_tets, SkinnyCause, SkinnyTet, SkinnyTets};
pub use summary::{worst_tets, Figures, QualitySummary};
pub use tet::TetQuality;

use crate::error::Error;
use crate::fallible;
use crate::TetMesh;
use std::ffi::CStr;

/// The number of bins of every histogram.
pub const BINS: usize = 10;

/// A measure of quality that has a histogram and a worst value.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Measure {
    /// The smallest of the six dihedral angles, in degrees. Up to 70.53, that of the regular tetrahedron.
    MinDihedral,
    /// The largest of the six dihedral angles, in degrees. At least 70.53.
    MaxDihedral,
    /// The circumradius over the shortest edge. At least 0.6124; infinite if the tetrahedron is not positive.
    RadiusEdge,
    /// The mean ratio `12 (3 V)^(2/3) / (sum of the squared edge lengths)`: 1 for the regular tetrahedron, 0 if it is not positive.
    Eta,
}

impl Measure {
    /// All measures, in the order of their numbers.
    pub const ALL: [Measure; 4] =
        [Measure::MinDihedral, Measure::MaxDihedral, Measure::RadiusEdge, Measure::Eta];

    /// A name in words.
    pub fn name(self) -> &'static str {
        match self {
            Measure::MinDihedral => "smallest dihedral angle",
            Measure::MaxDihedral => "largest dihedral angle",
            Measure::RadiusEdge => "radius-edge ratio",
            Measure::Eta => "mean ratio",
        }
    }

    /// The bounds of the bins, ascending: bin `i` has the values from `edges[i]` (inclusive) to `edges[i + 1]` (exclusive), the last one
    /// all from `edges[9]` on.
    pub fn bin_edges(self) -> &'static [f64; BINS + 1] {
        match self {
            Measure::MinDihedral => &[0.0, 1.0, 5.0, 10.0, 15.0, 20.0, 30.0, 40.0, 50.0, 60.0, 180.0],
            Measure::MaxDihedral => {
                &[0.0, 100.0, 120.0, 140.0, 150.0, 160.0, 165.0, 170.0, 175.0, 179.0, 180.0]
            }
            Measure::RadiusEdge => {
                &[0.0, 0.8, 1.0, 1.2, std::f64::consts::SQRT_2, 2.0, 3.0, 5.0, 10.0, 100.0, f64::INFINITY]
            }
            Measure::Eta => &[0.0, 0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 0.9, 1.0],
        }
    }

    /// The names of the bins. They end with a zero byte, for C.
    pub(crate) fn bin_texts(self) -> &'static [&'static CStr; BINS] {
        match self {
            Measure::MinDihedral => &[
                c"below 1",
                c"1 to 5",
                c"5 to 10",
                c"10 to 15",
                c"15 to 20",
                c"20 to 30",
                c"30 to 40",
                c"40 to 50",
                c"50 to 60",
                c"from 60",
            ],
            Measure::MaxDihedral => &[
                c"below 100",
                c"100 to 120",
                c"120 to 140",
                c"140 to 150",
                c"150 to 160",
                c"160 to 165",
                c"165 to 170",
                c"170 to 175",
                c"175 to 179",
                c"from 179",
            ],
            Measure::RadiusEdge => &[
                c"below 0.8",
                c"0.8 to 1",
                c"1 to 1.2",
                c"1.2 to 1.414",
                c"1.414 to 2",
                c"2 to 3",
                c"3 to 5",
                c"5 to 10",
                c"10 to 100",
                c"from 100",
            ],
            Measure::Eta => &[
                c"below 0.01",
                c"0.01 to 0.05",
                c"0.05 to 0.1",
                c"0.1 to 0.2",
                c"0.2 to 0.3",
                c"0.3 to 0.4",
                c"0.4 to 0.6",
                c"0.6 to 0.8",
                c"0.8 to 0.9",
                c"from 0.9",
            ],
        }
    }

    /// The name of a bin, such as "10 to 15"; empty for bins that do not exist.
    pub fn bin_name(self, bin: usize) -> &'static str {
        self.bin_texts().get(bin).and_then(|name| name.to_str().ok()).unwrap_or_default()
    }

    /// The bin of a value.
    pub fn bin(self, value: f64) -> usize {
        self.bin_edges()[1..BINS].iter().filter(|&&edge| value >= edge).count()
    }

    /// Whether small values are bad, not large ones.
    fn is_worse_if_small(self) -> bool {
        matches!(self, Measure::MinDihedral | Measure::Eta)
    }

    /// How bad a value is: larger is worse.
    fn badness(self, value: f64) -> f64 {
        if self.is_worse_if_small() {
            -value
        } else {
            value
        }
    }
}

/// The measures of each tetrahedron.
///
/// # Errors
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn tet_qualities(mesh: &TetMesh) -> Result<Vec<TetQuality>, Error> {
    Ok(fallible::collect(mesh.tets.iter().map(|tet| TetQuality::of_tet(mesh, tet)))?)
}
