//! Collects contacts: sorted lists without duplicates, and one defect per pair of elements, at most as many as allowed.
use crate::control::Control;
use crate::error::{Defect, DefectKind, Element, Error};
use crate::fallible;
use crate::plc::intersect::locate_point::Triangle;
use crate::plc::intersect::{Intersections, Names};

/// Lists shorter than this are not worth deduplicating.
const COMPACT_FROM: usize = 1 << 12;

/// Which of several findings about one pair of elements is listed: the most informative one has the lowest rank.
fn rank(kind: DefectKind) -> u32 {
    match kind {
        DefectKind::DuplicateFacet => 0,
        DefectKind::FacetFacet => 1,
        DefectKind::Overlap => 2,
        DefectKind::SegmentFacet => 3,
        _ => 4,
    }
}

/// A proper crossing of an input segment with an edge of a triangle.
#[derive(Clone, Copy, Debug)]
struct EdgeCrossing {
    segment: u32,
    edge: [u32; 2],
    facet: u32,
    triangle: u32,
    /// The segment lies in the triangle's plane.
    coplanar: bool,
    point: [f64; 3],
}

/// The growing result.
pub(super) struct Collector<'a> {
    found: Intersections,
    names: Names<'a>,
    max_defects: usize,
    /// The two elements of each defect, the smaller one first; deduplicated when the list has doubled.
    pairs: Vec<[Element; 2]>,
    compacted_pairs: usize,
    /// The listed defects; truncated to the first `max_defects` when the list has grown well beyond.
    listed: Vec<Defect>,
    crossings: Vec<EdgeCrossing>,
    /// Pairs of segments that cross, and segments that pierce triangles (index, facet).
    segments: Vec<([u32; 2], [f64; 3])>,
    piercings: Vec<([u32; 3], [f64; 3])>,
}

impl<'a> Collector<'a> {
    pub(super) fn new(names: Names<'a>, max_defects: usize) -> Collector<'a> {
        Collector {
            found: Intersections::default(),
            names,
            max_defects,
            pairs: Vec::new(),
            compacted_pairs: 0,
            listed: Vec::new(),
            crossings: Vec::new(),
            segments: Vec::new(),
            piercings: Vec::new(),
        }
    }

    /// `vertex` lies strictly inside input segment `segment`.
    pub(super) fn vertex_on_segment(&mut self, segment: u32, vertex: u32) -> Result<(), Error> {
        push(&mut self.found.vertex_on_segment, (segment, vertex))
    }

    /// `vertex` lies strictly inside the edge of a triangle.
    pub(super) fn vertex_on_edge(&mut self, edge: [u32; 2], vertex: u32) -> Result<(), Error> {
        push(&mut self.found.vertex_on_edge, (sorted(edge), vertex))
    }

    /// `vertex` lies strictly inside a triangle.
    pub(super) fn vertex_in_triangle(&mut self, triangle: u32, vertex: u32) -> Result<(), Error> {
        push(&mut self.found.vertex_in_triangle, (triangle, vertex))
    }

    /// `segment` lies in the plane of `triangle` and passes through its interior.
    pub(super) fn segment_in_facet(&mut self, segment: u32, triangle: u32) -> Result<(), Error> {
        push(&mut self.found.segment_in_facet, (segment, triangle))
    }

    /// An edge of a triangle runs through the interior of another triangle, in its plane.
    pub(super) fn edge_in_facet(&mut self, edge: [u32; 2], of: &Triangle) -> Result<(), Error> {
        push(&mut self.found.edge_in_facet, (sorted(edge), of.facet))
    }

    /// Two triangles meet where they must not.
    pub(super) fn triangles(
        &mut self,
        kind: DefectKind,
        a: &Triangle,
        b: &Triangle,
        point: [f64; 3],
    ) -> Result<(), Error> {
        let (first, second) = (a.facet.min(b.facet), a.facet.max(b.facet));
        self.defect(kind, Element::Facet(first), Element::Facet(second), point)
    }

    /// An input segment pierces a triangle.
    pub(super) fn pierced(
        &mut self,
        segment: u32,
        triangle: &Triangle,
        point: [f64; 3],
    ) -> Result<(), Error> {
        push(&mut self.piercings, ([segment, triangle.index, triangle.facet], point))
    }

    /// Two input segments cross.
    pub(super) fn segments(&mut self, a: u32, b: u32, point: [f64; 3]) -> Result<(), Error> {
        push(&mut self.segments, ([a.min(b), a.max(b)], point))
    }

    /// An input segment crosses edge `k` of a triangle at an inner point of both.
    pub(super) fn edge_crossed(
        &mut self,
        segment: u32,
        triangle: &Triangle,
        k: usize,
        coplanar: bool,
        point: [f64; 3],
    ) -> Result<(), Error> {
        let edge = sorted(triangle.edge(k));
        let (facet, triangle) = (triangle.facet, triangle.index);
        push(&mut self.crossings, EdgeCrossing { segment, edge, facet, triangle, coplanar, point })
    }

    /// Whether there was no contact at all, legal or not.
    pub(super) fn is_empty(&self) -> bool {
        self.pairs.is_empty()
            && self.crossings.is_empty()
            && self.segments.is_empty()
            && self.piercings.is_empty()
            && self.found.vertex_on_segment.is_empty()
            && self.found.vertex_on_edge.is_empty()
            && self.found.vertex_in_triangle.is_empty()
            && self.found.segment_in_facet.is_empty()
            && self.found.edge_in_facet.is_empty()
    }

    fn defect(
        &mut self,
        kind: DefectKind,
        first: Element,
        second: Element,
        point: [f64; 3],
    ) -> Result<(), Error> {
        let kind = self.names.kind(kind, first, second);
        let (x, y) = (self.names.of(first), self.names.of(second));
        let (first, second) = (x.min(y), x.max(y));
        push(&mut self.pairs, [first, second])?;
        if self.pairs.len() > COMPACT_FROM.max(2 * self.compacted_pairs) {
            self.compact_pairs();
        }
        push(&mut self.listed, Defect { kind, first, second: Some(second), point: Some(point) })?;
        if self.listed.len() > COMPACT_FROM.max(self.max_defects.saturating_mul(2)) {
            self.compact_listed()?;
        }
        Ok(())
    }

    fn compact_pairs(&mut self) {
        self.pairs.sort_unstable();
        self.pairs.dedup();
        self.compacted_pairs = self.pairs.len();
    }

    fn compact_listed(&mut self) -> Result<(), Error> {
        let key = |d: &Defect| (d.first, d.second, rank(d.kind));
        // Stable: of equal findings the first one stays, with its point.
        fallible::stable_sort_by(&mut self.listed, |x, y| key(x).cmp(&key(y)))?;
        self.listed.dedup_by_key(|d| (d.first, d.second));
        self.listed.truncate(self.max_defects);
        Ok(())
    }

    /// Every triangle at a crossed edge has met the segment, so the crossings of an edge tell whether all its triangles lie in one plane
    /// with the segment. If so, the edge is inside a flat patch and may be cut; otherwise it is part of the surface's shape.
    fn resolve_crossings(&mut self, control: &Control) -> Result<(), Error> {
        let mut crossings = std::mem::take(&mut self.crossings);
        let key = |c: &EdgeCrossing| (c.segment, c.edge, c.facet, c.triangle);
        fallible::stable_sort_by(&mut crossings, |x, y| key(x).cmp(&key(y)))?;
        crossings.dedup_by_key(|c| (c.segment, c.edge, c.triangle));
        for group in crossings.chunk_by(|x, y| (x.segment, x.edge) == (y.segment, y.edge)) {
            // Another look each time: a segment may have many vertices.
            control.look()?;
            let flat = group.len() > 1 && group.iter().all(|c| c.coplanar);
            if let (false, Some(c)) = (flat, group.first()) {
                if self.found.meet_in_vertex(c.segment, c.edge) {
                    continue;
                }
                let (first, second) = (Element::Segment(c.segment), Element::Facet(c.facet));
                self.defect(DefectKind::SegmentSegment, first, second, c.point)?;
            }
        }
        Ok(())
    }

    /// Two segments that cross at a vertex are split there, and so are a segment and a triangle that it pierces at one.
    fn resolve_segments(&mut self, control: &Control) -> Result<(), Error> {
        for ([a, b], point) in std::mem::take(&mut self.segments) {
            control.look()?;
            let on_b = |v: u32| self.found.vertex_on_segment.binary_search(&(b, v)).is_ok();
            if !self.found.on_segment(a).any(on_b) {
                self.defect(DefectKind::SegmentSegment, Element::Segment(a), Element::Segment(b), point)?;
            }
        }
        for ([segment, triangle, facet], point) in std::mem::take(&mut self.piercings) {
            control.look()?;
            let inside = |v: u32| self.found.vertex_in_triangle.binary_search(&(triangle, v)).is_ok();
            if !self.found.on_segment(segment).any(inside) {
                let (first, second) = (Element::Segment(segment), Element::Facet(facet));
                self.defect(DefectKind::SegmentFacet, first, second, point)?;
            }
        }
        Ok(())
    }

    /// The sorted lists.
    pub(super) fn finish(mut self, control: &Control) -> Result<Intersections, Error> {
        sort_unique(&mut self.found.vertex_on_segment, control)?;
        sort_unique(&mut self.found.vertex_on_edge, control)?;
        sort_unique(&mut self.found.vertex_in_triangle, control)?;
        sort_unique(&mut self.found.segment_in_facet, control)?;
        sort_unique(&mut self.found.edge_in_facet, control)?;
        self.found.edge_in_facet.dedup_by_key(|x| x.0);
        self.resolve_crossings(control)?;
        self.resolve_segments(control)?;
        self.compact_pairs();
        self.compact_listed()?;
        let mut found = self.found;
        found.defect_count = self.pairs.len();
        found.defects = self.listed;
        Ok(found)
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

fn push<T>(list: &mut Vec<T>, value: T) -> Result<(), Error> {
    fallible::push(list, value)?;
    Ok(())
}

fn sort_unique<T: Ord>(list: &mut Vec<T>, control: &Control) -> Result<(), Error> {
    control.sort(list)?;
    list.dedup();
    Ok(())
}
