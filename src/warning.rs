//! Warnings: what a caller should know about a mesh that is valid nonetheless. No C types here: `ffi` translates.
use crate::control::Control;
use crate::error::Element;
use crate::fallible;
use std::collections::TryReserveError;
use std::fmt;

/// What a warning is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum WarningKind {
    /// An edge of only one facet, on a part of the surface that encloses nothing: it leaks there. The elements are the ends.
    OpenEdge,
    /// A part of a facet bounds no tetrahedron.
    UnmeshedFacet,
    /// A part of a segment is an edge of no tetrahedron.
    UnmeshedSegment,
    /// A point is a corner of no tetrahedron and equals no earlier point.
    UnmeshedPoint,
    /// A point equals an earlier one, which is used instead. The elements are the point and the earlier one.
    EqualPoints,
    /// Two region seeds lie in one region; the attribute of the earlier is used. The elements are the later seed and the earlier one.
    RepeatedSeed,
    /// A hole seed lies outside the domain and has no effect.
    HoleOutside,
    /// A region has a volume bound, which has no effect unless the mesh is filled with points.
    UnusedVolume,
    /// A polygon is out of plane by more than rounding; it was triangulated.
    NonPlanarFacet,
    /// A file's format cannot hold a value as it is.
    LostValue,
}

impl WarningKind {
    /// The number of kinds.
    pub const COUNT: usize = 10;

    /// All kinds, in listing order.
    pub const ALL: [WarningKind; WarningKind::COUNT] = [
        WarningKind::OpenEdge,
        WarningKind::UnmeshedFacet,
        WarningKind::UnmeshedSegment,
        WarningKind::UnmeshedPoint,
        WarningKind::EqualPoints,
        WarningKind::RepeatedSeed,
        WarningKind::HoleOutside,
        WarningKind::UnusedVolume,
        WarningKind::NonPlanarFacet,
        WarningKind::LostValue,
    ];

    /// The kind in words, as printed in reports.
    pub fn name(self) -> &'static str {
        match self {
            WarningKind::OpenEdge => "open edge",
            WarningKind::UnmeshedFacet => "unmeshed facet",
            WarningKind::UnmeshedSegment => "unmeshed segment",
            WarningKind::UnmeshedPoint => "unmeshed point",
            WarningKind::EqualPoints => "equal points",
            WarningKind::RepeatedSeed => "repeated region seed",
            WarningKind::HoleOutside => "hole seed outside",
            WarningKind::UnusedVolume => "unused region volume",
            WarningKind::NonPlanarFacet => "non-planar facet",
            WarningKind::LostValue => "value lost in a file",
        }
    }

    /// The sentence that follows the number of warnings of the kind, for one or for several.
    fn sentence(self, one: bool) -> &'static str {
        let texts = match self {
            WarningKind::OpenEdge => [
                "open edge: the surface there encloses nothing; close it if it should",
                "open edges: the surface there encloses nothing; close it if it should",
            ],
            WarningKind::UnmeshedFacet => {
                ["part of a facet bounds no tetrahedron", "parts of facets bound no tetrahedron"]
            }
            WarningKind::UnmeshedSegment => [
                "part of a segment is an edge of no tetrahedron",
                "parts of segments are edges of no tetrahedron",
            ],
            WarningKind::UnmeshedPoint => ["point is in no tetrahedron", "points are in no tetrahedron"],
            WarningKind::EqualPoints => [
                "point equals an earlier one, which is used instead",
                "points equal earlier ones, which are used instead",
            ],
            WarningKind::RepeatedSeed => [
                "region seed lies in a region that has an earlier seed, whose attribute is used",
                "region seeds lie in regions that have an earlier seed, whose attribute is used",
            ],
            WarningKind::HoleOutside => [
                "hole seed lies outside the domain and has no effect",
                "hole seeds lie outside the domain and have no effect",
            ],
            WarningKind::UnusedVolume => [
                "region has a volume bound, which has no effect unless the mesh is filled with points",
                "regions have a volume bound, which has no effect unless the mesh is filled with points",
            ],
            WarningKind::NonPlanarFacet => [
                "polygon is not planar; it was triangulated",
                "polygons are not planar; they were triangulated",
            ],
            WarningKind::LostValue => {
                ["value cannot be stored in this file format", "values cannot be stored in this file format"]
            }
        };
        texts[usize::from(!one)]
    }
}

/// One warning: kind, the one or two elements involved, and a point that locates it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warning {
    /// The kind.
    pub kind: WarningKind,
    /// The element that the warning is about.
    pub first: Element,
    /// The other element of a pair.
    pub second: Option<Element>,
    /// A point at or near the element (rounded).
    pub point: Option<[f64; 3]>,
}

/// A list of warnings, limited per kind; all are counted.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Warnings {
    list: Vec<Warning>,
    counts: [u64; WarningKind::COUNT],
}

impl Warnings {
    /// Counts a warning, and lists it unless `limit` others of its kind are already listed or memory is short.
    pub fn push(&mut self, warning: Warning, limit: usize) {
        let count = &mut self.counts[warning.kind as usize];
        // The listed warnings of a kind are its first ones: none was listed after one that was not.
        let listed = *count < limit as u64;
        *count += 1;
        if listed {
            let _ = fallible::push(&mut self.list, warning);
        }
    }

    /// Appends the warnings of another list.
    pub fn append(&mut self, other: &Warnings) {
        for (count, more) in self.counts.iter_mut().zip(other.counts) {
            *count += more;
        }
        // Without memory, they are counted only.
        let _ = fallible::append(&mut self.list, &other.list);
    }

    /// A copy; unlike `clone` it returns an error if memory runs out.
    pub(crate) fn try_clone(&self) -> Result<Warnings, TryReserveError> {
        Ok(Warnings { list: fallible::copied(&self.list)?, counts: self.counts })
    }

    /// The listed warnings, in the order found.
    pub fn list(&self) -> &[Warning] {
        &self.list
    }

    /// The number of warnings of a kind, listed or not.
    pub fn count(&self, kind: WarningKind) -> u64 {
        self.counts[kind as usize]
    }

    /// The number of all warnings, listed or not.
    pub fn total(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// Whether there are no warnings.
    pub fn is_empty(&self) -> bool {
        self.total() == 0
    }

    /// The listed warnings of one kind.
    pub fn of(&self, kind: WarningKind) -> impl Iterator<Item = &Warning> {
        self.list.iter().filter(move |warning| warning.kind == kind)
    }

    /// One line in English about the warnings of a kind: how many, what to do, and where the first one is; `None` if there are no such
    /// warnings.
    pub fn line(&self, kind: WarningKind) -> Option<String> {
        let count = self.count(kind);
        let text = kind.sentence(count == 1);
        match self.of(kind).next() {
            _ if count == 0 => None,
            Some(first) if count == 1 => {
                fallible::text(format_args!("{count} {text} ({})", Place(first))).ok()
            }
            Some(first) => fallible::text(format_args!("{count} {text} (first: {})", Place(first))).ok(),
            None => fallible::text(format_args!("{count} {text}")).ok(),
        }
    }

    /// Logs one line per kind.
    pub fn log(&self, control: &Control) {
        for line in WarningKind::ALL.into_iter().filter_map(|kind| self.line(kind)) {
            // Without memory for a line, the line is dropped: the mesh has the warnings themselves.
            if let Ok(line) = fallible::text(format_args!("warning: {line}")) {
                control.log(&line);
            }
        }
    }
}

/// The elements and the place of a warning.
struct Place<'a>(&'a Warning);

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.0.first)?;
        if let Some(second) = self.0.second {
            write!(f, " and {second}")?;
        }
        if let Some([x, y, z]) = self.0.point {
            write!(f, " at ({x}, {y}, {z})")?;
        }
        Ok(())
    }
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.kind.name(), Place(self))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn warning(kind: WarningKind, point: u32) -> Warning {
        Warning { kind, first: Element::Point(point), second: None, point: Some([0.5, 0.0, 1.0]) }
    }

    #[test]
    fn kinds_are_numbered_in_the_order_of_the_list() {
        for (i, kind) in WarningKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, i);
        }
    }

    #[test]
    fn a_kind_that_fills_its_part_of_the_list_hides_no_other() {
        let mut warnings = Warnings::default();
        for i in 0..100 {
            warnings.push(warning(WarningKind::EqualPoints, i), 3);
        }
        warnings.push(warning(WarningKind::OpenEdge, 7), 3);
        assert_eq!(warnings.count(WarningKind::EqualPoints), 100);
        assert_eq!(warnings.of(WarningKind::EqualPoints).count(), 3);
        assert_eq!(warnings.of(WarningKind::OpenEdge).count(), 1);
        assert_eq!((warnings.total(), warnings.list().len()), (101, 4));
        let lines: Vec<String> = WarningKind::ALL.iter().filter_map(|&k| warnings.line(k)).collect();
        assert_eq!(lines.len(), 2);
        assert!(lines[0].starts_with("1 open edge:") && lines[0].ends_with("(point 7 at (0.5, 0, 1))"));
        assert_eq!(
            lines[1],
            "100 points equal earlier ones, which are used instead (first: point 0 at (0.5, 0, 1))"
        );
    }
}
