//! Collects what the checks find: every defect is counted, at most a given number is kept.
use crate::error::{Defect, DefectKind, Element, Error, KindCounts, Status};
use crate::fallible;
use std::fmt;

/// The defects found so far. Invariant: `defects.len() <= limit`, `count` is never less.
pub(super) struct Report {
    defects: Vec<Defect>,
    limit: usize,
    /// How many of each kind.
    kinds: KindCounts,
    count: usize,
    /// What a mesh without parents could not be asked, for the message.
    notes: String,
    /// Memory ran out for a note.
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

    /// Adds a defect; beyond the limit (or without memory for it) it is only counted.
    pub(super) fn add(
        &mut self,
        kind: DefectKind,
        first: Element,
        second: Option<Element>,
        point: Option<[f64; 3]>,
    ) {
        self.count += 1;
        self.kinds.add(kind);
        if self.defects.len() < self.limit && self.defects.try_reserve(1).is_ok() {
            self.defects.push(Defect { kind, first, second, point });
        }
    }

    /// Adds a line to the message of a failed check.
    pub(super) fn note(&mut self, text: fmt::Arguments<'_>) {
        match fallible::text(format_args!("{}; {text}", self.notes)) {
            Ok(notes) => self.notes = notes,
            Err(error) => self.short = Some(error.into()),
        }
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// `Ok` if nothing was found, else all of it as one error.
    pub(super) fn finish(self) -> Result<(), Error> {
        if let Some(short) = self.short {
            return Err(short);
        }
        if self.count == 0 {
            return Ok(());
        }
        let message =
            format_args!("the mesh fails its check: {}{}", self.kinds.shown(" × "), self.notes).into();
        Err(Error::with_defects(Status::CheckFailed, message, self.defects, self.count))
    }
}
