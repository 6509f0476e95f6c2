//! Progress and log of a run: its phases and its observer.
use std::ops::ControlFlow;

/// The stages of a run. The numbers are fixed; [`Phase::ALL`] has them in the order of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u32)]
pub enum Phase {
    /// Reading a file.
    Read = 0,
    /// Checking the input.
    Validate = 1,
    /// Delaunay tetrahedralization of the points.
    Delaunay = 2,
    /// Segment recovery.
    Segments = 3,
    /// Facet recovery.
    Facets = 4,
    /// Carving, holes and regions.
    Regions = 5,
    /// Rounding Steiner points to doubles.
    Round = 6,
    /// The exact audit of the result.
    Audit = 7,
    /// Writing files.
    Write = 8,
    /// Keeping the surface as it is ([`Mode::Preserve`](crate::Mode::Preserve)); comes before the audit.
    Preserve = 9,
    /// Points by size and shape ([`Options::size`](crate::Options::size), [`Options::quality`](crate::Options::quality)); comes before
    /// rounding.
    Refine = 10,
    /// Optimisation ([`Options::optimize`](crate::Options::optimize)); comes before the audit.
    Optimize = 11,
}

impl Phase {
    /// The number of phases.
    pub const COUNT: usize = 12;

    /// All phases in the order of a run.
    pub const ALL: [Phase; Phase::COUNT] = [
        Phase::Read,
        Phase::Validate,
        Phase::Delaunay,
        Phase::Segments,
        Phase::Facets,
        Phase::Regions,
        Phase::Preserve,
        Phase::Refine,
        Phase::Round,
        Phase::Optimize,
        Phase::Audit,
        Phase::Write,
    ];

    /// The name as printed in statistics.
    pub fn name(self) -> &'static str {
        const NAMES: [&str; Phase::COUNT] = [
            "read", "validate", "delaunay", "segments", "facets", "regions", "round", "audit", "write",
            "preserve", "refine", "optimize",
        ];
        NAMES[self as usize]
    }
}

impl Phase {
    /// Where each phase begins in the whole of reading, meshing and writing, in the order of [`Phase::ALL`]; the last one ends at 1. These
    /// are rough shares of the time on our own models. The shares differ by a factor of ten between models, so finer numbers would be
    /// meaningless.
    const BEGINS: [f64; Phase::COUNT] = [0.0, 0.05, 0.1, 0.2, 0.3, 0.35, 0.4, 0.5, 0.7, 0.75, 0.9, 0.95];

    /// The fraction of the whole that is done when `fraction` of this phase is done: from 0 to 1, increasing from phase to phase.
    pub fn overall(self, fraction: f64) -> f64 {
        let place = self.place();
        let begin = Phase::BEGINS[place];
        let end = Phase::BEGINS.get(place + 1).copied().unwrap_or(1.0);
        begin + (end - begin) * fraction.clamp(0.0, 1.0)
    }

    /// The index in [`Phase::ALL`].
    pub(crate) fn place(self) -> usize {
        Phase::ALL.iter().position(|&phase| phase == self).unwrap_or(0)
    }
}

/// Receives progress and log lines on the calling thread, and may cancel.
pub trait Observer {
    /// `fraction` of `phase` is done (0 to 1). During a run phases come in the order of [`Phase::ALL`], each once and up to 1 (unneeded
    /// ones never); neither fractions nor [`Phase::overall`] ever decrease. `Break` cancels the run.
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        let _ = (phase, fraction);
        ControlFlow::Continue(())
    }

    /// A line of text about the run. The library prints nothing itself.
    fn log(&mut self, message: &str) {
        let _ = message;
    }
}

/// An observer that ignores everything.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Observer for Silent {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_whole_goes_from_0_to_1() {
        assert_eq!(Phase::Read.overall(0.0), 0.0);
        assert_eq!(Phase::Write.overall(1.0), 1.0);
        for pair in Phase::ALL.windows(2) {
            assert!(pair[0].overall(0.0) < pair[0].overall(1.0));
            assert_eq!(pair[0].overall(1.0), pair[1].overall(0.0));
        }
    }
}
