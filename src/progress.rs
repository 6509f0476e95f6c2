//! Progress, cancellation and log: the caller's eyes and hands during a run.
use crate::error::{Error, Status};
use std::ops::ControlFlow;

/// The stages of a run. The numbers are fixed; [`Phase::ALL`] has them in the order in which they come.
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
    /// How many phases there are.
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

    /// The name as statistics print it.
    pub fn name(self) -> &'static str {
        const NAMES: [&str; Phase::COUNT] = [
            "read", "validate", "delaunay", "segments", "facets", "regions", "round", "audit", "write",
            "preserve",
        ];
        NAMES[self as usize]
    }
}

/// Receives progress and log lines on the thread that called, and may cancel.
pub trait Observer {
    /// `fraction` of `phase` is done (0 to 1, never falling within a phase). `Break` cancels the run.
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        let _ = (phase, fraction);
        ControlFlow::Continue(())
    }

    /// A line of text about the run. Nothing is printed otherwise.
    fn log(&mut self, message: &str) {
        let _ = message;
    }
}

/// An observer that looks away.
#[derive(Clone, Copy, Debug, Default)]
pub struct Silent;

impl Observer for Silent {}

/// Reports progress and turns a cancel into an error.
pub fn report(observer: &mut dyn Observer, phase: Phase, fraction: f64) -> Result<(), Error> {
    match observer.progress(phase, fraction.clamp(0.0, 1.0)) {
        ControlFlow::Continue(()) => Ok(()),
        ControlFlow::Break(()) => Err(Error::new(Status::Cancelled, "cancelled by the caller")),
    }
}
