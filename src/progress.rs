//! Progress, cancellation and log of a run.
use crate::error::{Error, Status};
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
}

impl Phase {
    /// The number of phases.
    pub const COUNT: usize = 10;

    /// All phases in the order of a run.
    pub const ALL: [Phase; Phase::COUNT] = [
        Phase::Read,
        Phase::Validate,
        Phase::Delaunay,
        Phase::Segments,
        Phase::Facets,
        Phase::Regions,
        Phase::Preserve,
        Phase::Round,
        Phase::Audit,
        Phase::Write,
    ];

    /// The name as printed in statistics.
    pub fn name(self) -> &'static str {
        const NAMES: [&str; Phase::COUNT] = [
            "read", "validate", "delaunay", "segments", "facets", "regions", "round", "audit", "write",
            "preserve",
        ];
        NAMES[self as usize]
    }
}

impl Phase {
    /// Where each phase begins in the whole of reading, meshing and writing, in the order of [`Phase::ALL`]; the last one ends at 1. These
    /// are rough shares of the time on our own models. The shares differ by a factor of ten between models, so finer numbers would be
    /// meaningless.
    const BEGINS: [f64; Phase::COUNT] = [0.0, 0.05, 0.15, 0.35, 0.55, 0.65, 0.7, 0.8, 0.85, 0.9];

    /// The fraction of the whole that is done when `fraction` of this phase is done: from 0 to 1, increasing from phase to phase.
    pub fn overall(self, fraction: f64) -> f64 {
        let place = self.place();
        let begin = Phase::BEGINS[place];
        let end = Phase::BEGINS.get(place + 1).copied().unwrap_or(1.0);
        begin + (end - begin) * fraction.clamp(0.0, 1.0)
    }

    /// The index in [`Phase::ALL`].
    fn place(self) -> usize {
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

/// Passes on only progress that does not go back: repeated work, in another attempt for example, reports no progress.
pub(crate) struct Steady<'a> {
    observer: &'a mut dyn Observer,
    /// The phase and fraction reported last.
    now: Option<(Phase, f64)>,
}

impl<'a> Steady<'a> {
    pub(crate) fn new(observer: &'a mut dyn Observer) -> Self {
        Steady { observer, now: None }
    }
}

impl Observer for Steady<'_> {
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        let now = match self.now {
            Some((last, reached)) if last.place() > phase.place() => (last, reached),
            Some((last, reached)) if last == phase => (last, reached.max(fraction)),
            Some((last, reached)) => {
                if reached < 1.0 {
                    self.observer.progress(last, 1.0)?;
                }
                (phase, fraction)
            }
            None => (phase, fraction),
        };
        self.now = Some(now);
        self.observer.progress(now.0, now.1)
    }

    fn log(&mut self, message: &str) {
        self.observer.log(message);
    }
}

/// Reports progress; fails with [`Status::Cancelled`] if the observer cancels.
pub fn report(observer: &mut dyn Observer, phase: Phase, fraction: f64) -> Result<(), Error> {
    match observer.progress(phase, fraction.clamp(0.0, 1.0)) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::new(Status::Cancelled, "cancelled by the caller")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Records everything reported, and checks it.
    #[derive(Default)]
    struct Witness(Vec<(Phase, f64)>);

    impl Observer for Witness {
        fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
            assert!((0.0..=1.0).contains(&fraction));
            if let Some(&(last, reached)) = self.0.last() {
                assert!(phase.place() >= last.place(), "{last:?}, then {phase:?}");
                assert!(phase != last || fraction >= reached, "{phase:?} falls to {fraction}");
                assert!(phase == last || reached == 1.0, "{last:?} ends at {reached}");
                assert!(phase.overall(fraction) >= last.overall(reached));
            }
            self.0.push((phase, fraction));
            ControlFlow::Continue(())
        }
    }

    #[test]
    fn work_that_is_done_again_shows_as_no_progress() {
        let mut witness = Witness::default();
        let mut steady = Steady::new(&mut witness);
        for (phase, fraction) in [
            (Phase::Validate, 0.0),
            (Phase::Delaunay, 0.5),
            (Phase::Validate, 1.0),
            (Phase::Delaunay, 0.25),
            (Phase::Segments, 0.75),
            (Phase::Delaunay, 1.0),
            (Phase::Round, 0.5),
            (Phase::Preserve, 0.1),
            (Phase::Audit, 1.0),
        ] {
            assert!(steady.progress(phase, fraction).is_continue());
        }
        assert_eq!(witness.0.first(), Some(&(Phase::Validate, 0.0)));
        assert_eq!(witness.0.last(), Some(&(Phase::Audit, 1.0)));
        let phases: std::collections::BTreeSet<Phase> = witness.0.iter().map(|seen| seen.0).collect();
        assert_eq!(phases.len(), 5, "preserve comes too late and is not seen");
    }

    #[test]
    fn the_whole_goes_from_0_to_1() {
        assert_eq!(Phase::Read.overall(0.0), 0.0);
        assert_eq!(Phase::Write.overall(1.0), 1.0);
        for pair in Phase::ALL.windows(2) {
            assert!(pair[0].overall(0.0) < pair[0].overall(1.0));
            assert_eq!(pair[0].overall(1.0), pair[1].overall(0.0));
        }
    }

    /// Every mode, with merging, over models that need several attempts and those that need none.
    #[test]
    fn phases_come_in_order_and_fractions_never_fall_on_every_path() {
        use crate::options::{Mode, Options};
        use crate::{tetrahedralize, Plc};
        let points = vec![
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [0.0, 4.0, 0.0],
            [4.0, 4.0, 0.5],
            [0.0, 0.0, 4.0],
            [4.0, 0.0, 4.0],
            [0.0, 4.0, 4.0],
            [4.0, 4.0, 3.0],
            [1.0, 1.9, 2.0],
            [3.0, 2.0, 2.1],
        ];
        let triangles = vec![
            [0, 2, 1],
            [1, 2, 3],
            [4, 5, 6],
            [5, 7, 6],
            [0, 1, 4],
            [1, 5, 4],
            [2, 6, 3],
            [3, 6, 7],
            [0, 4, 2],
            [2, 4, 6],
            [1, 3, 5],
            [3, 7, 5],
        ];
        let segments = vec![crate::Segment { ends: [8, 9], marker: 1 }];
        let plc = Plc { points, triangles, segments, ..Plc::default() };
        for mode in [Mode::Delaunay, Mode::Constrained, Mode::Preserve] {
            for merge_facets in [None, Some(170.0)] {
                let options = Options { mode, merge_facets, ..Options::default() };
                let mut witness = Witness::default();
                tetrahedralize(&plc, &options, &mut witness).unwrap();
                assert_eq!(witness.0.last(), Some(&(Phase::Audit, 1.0)), "{mode:?}");
                assert!(witness.0.iter().any(|seen| seen.0 == Phase::Delaunay));
                let preserve = witness.0.iter().any(|seen| seen.0 == Phase::Preserve);
                assert_eq!(preserve, mode == Mode::Preserve);
            }
        }
    }
}
