//! Histograms and the worst tetrahedra, in one pass over the mesh that keeps nothing per tetrahedron.
use crate::error::Error;
use crate::fallible;
use crate::query::quality::rough::{keys, Bins, Worst};
use crate::query::quality::tet::corners_of;
use crate::query::quality::{ForcedTet, Measure, TetQuality, BINS};
use crate::{TetMesh, INVALID};
use std::cmp::{Ordering, Reverse};
use std::collections::BinaryHeap;

pub(super) const MEASURES: usize = Measure::ALL.len();

/// Worst values and histograms of some tetrahedra. Lists are indexed by [`Measure`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// The worst value of each measure; 0 if there are no tetrahedra.
    pub worst: [f64; MEASURES],
    /// The first tetrahedron with that value, or [`INVALID`] if there are none.
    pub worst_tet: [u32; MEASURES],
    /// The number of tetrahedra in each bin ([`Measure::bin_edges`]) of each measure.
    pub histograms: [[u64; BINS]; MEASURES],
}

impl Figures {
    const NONE: Figures =
        Figures { worst: [0.0; MEASURES], worst_tet: [INVALID; MEASURES], histograms: [[0; BINS]; MEASURES] };

    /// Adds a tetrahedron that is not the worst by any measure.
    fn add_to_bins(&mut self, bins: &[usize; MEASURES]) {
        for (histogram, &bin) in self.histograms.iter_mut().zip(bins) {
            histogram[bin] += 1;
        }
    }

    fn add(&mut self, tet: u32, quality: &TetQuality) {
        for (i, measure) in Measure::ALL.into_iter().enumerate() {
            let value = quality.by(measure);
            self.histograms[i][measure.bin(value)] += 1;
            if self.worst_tet[i] == INVALID || measure.badness(value) > measure.badness(self.worst[i]) {
                (self.worst[i], self.worst_tet[i]) = (value, tet);
            }
        }
    }
}

/// The quality of a mesh at a glance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QualitySummary {
    /// The number of tetrahedra.
    pub tet_count: u64,
    /// How many of them are input-forced.
    pub forced_count: u64,
    /// Of all tetrahedra.
    pub all: Figures,
    /// Of those that are not input-forced: what a better mesher could improve.
    pub unforced: Figures,
}

impl QualitySummary {
    /// The figures of a mesh. `forced`: its input-forced tetrahedra, as [`forced_tets`](super::forced_tets) lists them.
    pub fn new(mesh: &TetMesh, forced: &[ForcedTet]) -> QualitySummary {
        let (mut all, mut unforced) = (Figures::NONE, Figures::NONE);
        let mut forced_count = 0;
        let mut next = forced.iter().peekable();
        let bins = Bins::new();
        let (mut worst, mut worst_unforced) = (Worst::new(), Worst::new());
        for (tet, corners) in (0..).zip(&mesh.tets) {
            let corners = corners_of(mesh, corners);
            let forced = next.next_if(|forced| forced.tet == tet).is_some();
            forced_count += u64::from(forced);
            let sure = keys(&corners).and_then(|keys| {
                let beaten = worst.add(&keys);
                let beaten = (forced || worst_unforced.add(&keys)) && beaten;
                bins.of(&keys).filter(|_| beaten)
            });
            match sure {
                Some(bins) => {
                    all.add_to_bins(&bins);
                    if !forced {
                        unforced.add_to_bins(&bins);
                    }
                }
                None => {
                    let quality = TetQuality::of(corners);
                    all.add(tet, &quality);
                    if !forced {
                        unforced.add(tet, &quality);
                    }
                }
            }
        }
        QualitySummary { tet_count: mesh.tets.len() as u64, forced_count, all, unforced }
    }
}

/// A tetrahedron and how bad it is. The order is total: of equally bad ones that with the smaller index counts as worse.
struct Ranked {
    badness: f64,
    tet: u32,
}

impl Ord for Ranked {
    fn cmp(&self, other: &Self) -> Ordering {
        self.badness.total_cmp(&other.badness).then(other.tet.cmp(&self.tet))
    }
}

impl PartialOrd for Ranked {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Ranked {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Ranked {}

/// Fills `out` with the worst tetrahedra by a measure, the worst first, then, if there are not that many, with [`INVALID`]. Those in
/// `without` (sorted by tetrahedron, as [`forced_tets`](super::forced_tets) lists them) are left out. Returns how many there are.
///
/// # Errors
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn worst_tets(
    mesh: &TetMesh,
    measure: Measure,
    without: &[ForcedTet],
    out: &mut [u32],
) -> Result<usize, Error> {
    // The worst so far, the least bad of them on top.
    let mut kept: BinaryHeap<Reverse<Ranked>> = BinaryHeap::new();
    let mut next = without.iter().peekable();
    for (tet, corners) in (0..).zip(&mesh.tets) {
        if out.is_empty() || next.next_if(|forced| forced.tet == tet).is_some() {
            continue;
        }
        let badness = measure.badness(TetQuality::of_tet(mesh, corners).by(measure));
        let ranked = Ranked { badness, tet };
        if kept.len() == out.len() {
            if kept.peek().is_some_and(|least| ranked < least.0) {
                continue;
            }
            kept.pop();
        }
        fallible::push_heap(&mut kept, Reverse(ranked))?;
    }
    let count = kept.len();
    out.fill(INVALID);
    for place in out.iter_mut().take(count).rev() {
        *place = kept.pop().map_or(INVALID, |Reverse(ranked)| ranked.tet);
    }
    Ok(count)
}
