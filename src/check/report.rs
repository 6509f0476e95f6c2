//! Collects what the checks find: every defect is counted, at most a given number is kept.
use crate::error::{Defect, DefectKind, Element, Error, Status};

/// The defects found so far. Invariant: `defects.len() <= limit`, `count` is never less.
pub(super) struct Report {
    defects: Vec<Defect>,
    limit: usize,
    /// How many of each kind, in the order in which the kinds were first seen.
    kinds: Vec<(DefectKind, usize)>,
    count: usize,
    /// What a mesh without parents could not be asked, for the message.
    notes: Vec<String>,
}

impl Report {
    pub(super) fn new(limit: usize) -> Self {
        Report { defects: Vec::new(), limit, kinds: Vec::new(), count: 0, notes: Vec::new() }
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
        match self.kinds.iter_mut().find(|k| k.0 == kind) {
            Some(k) => k.1 += 1,
            None => self.kinds.push((kind, 1)),
        }
        if self.defects.len() < self.limit && self.defects.try_reserve(1).is_ok() {
            self.defects.push(Defect { kind, first, second, point });
        }
    }

    /// Adds a line to the message of a failed check.
    pub(super) fn note(&mut self, text: String) {
        self.notes.push(text);
    }

    pub(super) fn count(&self) -> usize {
        self.count
    }

    /// `Ok` if nothing was found, else all of it as one error.
    pub(super) fn finish(self) -> Result<(), Error> {
        if self.count == 0 {
            return Ok(());
        }
        let kinds: Vec<String> =
            self.kinds.iter().map(|(kind, n)| format!("{n} × {}", kind.name())).collect();
        let mut message = format!("the mesh fails its check: {}", kinds.join(", "));
        for note in &self.notes {
            message.push_str("; ");
            message.push_str(note);
        }
        Err(Error { status: Status::CheckFailed, message, defects: self.defects, defect_count: self.count })
    }
}
