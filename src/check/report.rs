//! Collects defects: all are counted, at most a given number is kept.
use crate::error::{Defect, DefectKind, Element, Error, KindCounts, Message, Status};
use crate::fallible;
use std::fmt;

/// The defects found so far. Invariants: `defects.len() <= limit` and `defects.len() <= count`.
pub(super) struct Report {
    defects: Vec<Defect>,
    limit: usize,
    /// The number of each kind.
    kinds: KindCounts,
    count: usize,
    /// What could not be checked for a mesh without parents, for the message.
    notes: String,
    /// The error, if memory ran out for a note.
    short: Option<Error>,
}

impl Report {
    pub(super) fn new(limit: usize) -> Self {
        Report {
            defects: Vec::new(),
            limit,
            kinds: KindCounts::default(),
            count: 0,
            notes: String::new(),
            short: None,
        }
    }

    /// Adds a defect; beyond the limit, or without memory for it, the defect is only counted.
    pub(super) fn add(
        &mut self,
        kind: DefectKind,
        first: Element,
        second: Option<Element>,
        point: Option<[f64; 3]>,
    ) {
        self.count += 1;
        self.kinds.add(kind);
        if self.defects.len() < self.limit {
            let _ = fallible::push(&mut self.defects, Defect { kind, first, second, point });
        }
    }

    /// Adds a line to the message of a failed check.
    pub(super) fn note(&mut self, text: fmt::Arguments<'_>) {
        match fallible::text(format_args!("{}; {text}", self.notes)) {
            Ok(notes) => self.notes = notes,
            Err(error) => self.short = Some(Error::from(error)),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// `Ok` if nothing was found, otherwise one error with all defects.
    pub(super) fn finish(self) -> Result<(), Error> {
        if let Some(short) = self.short {
            return Err(short);
        }
        if self.count == 0 {
            return Ok(());
        }
        let kinds = self.kinds.shown(" × ");
        let message = Message::from(format_args!("the mesh failed its check: {kinds}{}", self.notes));
        Err(Error::with_defects(Status::CheckFailed, message, self.defects, self.count))
    }
}
