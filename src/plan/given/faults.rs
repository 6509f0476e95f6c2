//! What is wrong with a given mesh: everything found by one test, together.
use crate::error::{Defect, DefectKind, Element, Error, KindCounts, Message, Status};
use crate::fallible;

/// The faults found so far.
pub(super) struct Faults<'a> {
    points: &'a [[f64; 3]],
    list: Vec<Defect>,
    most: usize,
    count: usize,
    kinds: KindCounts,
}

impl<'a> Faults<'a> {
    /// None yet; at most this many are listed.
    pub(super) fn new(points: &'a [[f64; 3]], most: usize) -> Faults<'a> {
        Faults { points, list: Vec::new(), most, count: 0, kinds: KindCounts::default() }
    }

    /// Takes note of a fault near a point. Beyond the limit, or without memory, it is only counted.
    pub(super) fn add(&mut self, kind: DefectKind, first: Element, second: Option<Element>, near: u32) {
        self.count += 1;
        self.kinds.add(kind);
        if self.list.len() < self.most {
            let point = self.points.get(near as usize).copied().filter(|p| p.iter().all(|x| x.is_finite()));
            let _ = fallible::push(&mut self.list, Defect { kind, first, second, point });
        }
    }

    /// The error, if there are any.
    pub(super) fn finish(self, status: Status, what: &str) -> Result<(), Error> {
        let Faults { list, count, kinds, .. } = self;
        if count == 0 {
            return Ok(());
        }
        let shown = kinds.shown(" × ");
        let message = match list.first() {
            Some(first) => Message::from(format_args!("{what}: {first} (in all: {shown})")),
            None => Message::from(format_args!("{what}: {shown}")),
        };
        Err(Error::with_defects(status, message, list, count))
    }
}
