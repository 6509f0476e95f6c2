//! Every contact among the triangles, segments and vertices of a PLC: the legal ones that split something, and all defects.
//!
//! Two elements may meet in common vertices and edges, and where a vertex of one lies on the other; after such vertices have split what
//! they lie on, elements meet only in shared vertices and edges. Every other contact is a defect. All decisions are exact signs of
//! determinants of the given doubles. Candidates come from a box hierarchy ([`boxtree`]) and, for many elements at one vertex, from their
//! directions there ([`fans`]); each candidate pair is visited once and classified by the signs of its corners against each other's planes
//! (Möller 1997, "A fast triangle-triangle intersection test", with exact signs; Guigue & Devillers 2003 for the predicates).
//!
//! Invariant: the lists are sorted and without duplicates, and depend only on the input.
use crate::control::{Control, Part};
use crate::error::{Defect, DefectKind, Element, Error};
use crate::fallible;
use boxtree::{Bounds, BoxTree, Frame};
use collector::Collector;
use fans::Fans;
use locate_point::{Segment, Triangle};

mod boxtree;
mod collector;
mod coplanar;
#[cfg(test)]
mod corpus_tests;
mod fans;
#[cfg(test)]
mod fans_tests;
mod locate_point;
pub mod obstacles;
#[cfg(test)]
mod oracle_tests;
mod segment_segment;
mod segment_triangle;
#[cfg(test)]
mod tests;
mod triangle_triangle;

/// The elements to test against each other. All indices refer to `points`; no two vertices have equal coordinates.
#[derive(Clone, Copy, Debug)]
pub struct IntersectInput<'a> {
    /// Coordinates, #points by 3, finite.
    pub points: &'a [[f64; 3]],
    /// All vertices of the PLC, each once. Those of no triangle and no segment are tested as isolated vertices.
    pub vertices: &'a [u32],
    /// Triangles with three corners that are not collinear.
    pub triangles: &'a [[u32; 3]],
    /// The facet each triangle is part of, for reports: #triangles.
    pub triangle_facet: &'a [u32],
    /// Input segments with two different ends; the index is the id in reports.
    pub segments: &'a [[u32; 2]],
}

/// The names of segments in reports.
#[derive(Clone, Copy, Debug)]
pub struct Names<'a> {
    /// The element that each segment comes from; a segment without one is named by its index.
    pub owners: &'a [Element],
    /// Segments from this index on are edges of facets: what crosses one crosses the facet.
    pub edges_from: usize,
}

impl Names<'_> {
    /// Segments go by their index.
    const NONE: Names<'static> = Names { owners: &[], edges_from: usize::MAX };

    fn of(&self, element: Element) -> Element {
        match element {
            Element::Segment(i) => self.owners.get(i as usize).copied().unwrap_or(element),
            other => other,
        }
    }

    /// The kind of a defect in terms of the owners.
    fn kind(&self, kind: DefectKind, first: Element, second: Element) -> DefectKind {
        let is_edge = |element| matches!(element, Element::Segment(i) if i as usize >= self.edges_from);
        if !is_edge(first) && !is_edge(second) {
            return kind;
        }
        match (self.of(first), self.of(second)) {
            (Element::Facet(_), Element::Facet(_)) => DefectKind::FacetFacet,
            (Element::Segment(_), Element::Facet(_)) | (Element::Facet(_), Element::Segment(_)) => {
                DefectKind::SegmentFacet
            }
            _ => kind,
        }
    }
}

/// The result. All lists but the defects are legal contacts.
#[derive(Debug, Default, PartialEq)]
pub struct Intersections {
    /// (segment, vertex): the vertex lies strictly inside the segment and splits it.
    pub vertex_on_segment: Vec<(u32, u32)>,
    /// (edge of a triangle as sorted ends, vertex): the vertex lies strictly inside the edge and splits it.
    pub vertex_on_edge: Vec<([u32; 2], u32)>,
    /// (triangle, vertex): the vertex lies strictly inside the triangle and splits it.
    pub vertex_in_triangle: Vec<(u32, u32)>,
    /// (segment, triangle): the segment lies in the triangle's plane and passes through its interior.
    pub segment_in_facet: Vec<(u32, u32)>,
    /// (edge of a triangle as sorted ends, its facet): it runs through the interior of another triangle, in its plane. Whether it crosses
    /// edges there is found out when it is passed as a segment.
    pub edge_in_facet: Vec<([u32; 2], u32)>,
    /// Defects, one per pair of elements, in the order of elements, at most as many as the caller allows.
    pub defects: Vec<Defect>,
    /// The number of all defects.
    pub defect_count: usize,
}

impl Intersections {
    /// Whether a vertex lies on both a segment and an edge of triangles, so that they cross there. The lists must be sorted.
    pub fn meet_in_vertex(&self, segment: u32, edge: [u32; 2]) -> bool {
        self.on_segment(segment).any(|v| self.vertex_on_edge.binary_search(&(edge, v)).is_ok())
    }

    fn on_segment(&self, segment: u32) -> impl Iterator<Item = u32> + '_ {
        let begin = self.vertex_on_segment.partition_point(|x| x.0 < segment);
        self.vertex_on_segment[begin..].iter().take_while(move |x| x.0 == segment).map(|x| x.1)
    }
}

/// How many candidate pairs are classified between two reports of progress.
const PAIRS_PER_REPORT: u32 = 1 << 14;

/// Finds all contacts, with segments named by their index in reports. A pair of elements is one defect, however often they meet.
///
/// # Errors
/// What ends the run, `OutOfMemory`, `IndexOutOfRange` where an index refers to no point.
pub fn find_intersections(
    input: &IntersectInput,
    max_defects: usize,
    part: Part,
) -> Result<Intersections, Error> {
    find_named_intersections(input, Names::NONE, max_defects, part)
}

/// The same with the names to be used in reports.
///
/// # Errors
/// As [`find_intersections`].
pub fn find_named_intersections(
    input: &IntersectInput,
    names: Names,
    max_defects: usize,
    part: Part,
) -> Result<Intersections, Error> {
    check_indices(input)?;
    part.progress(0.0)?;
    let (elements, bounds, fans) = list_elements(input, &part)?;
    let tree = BoxTree::new(&bounds, fans, &part)?;
    drop(bounds);
    let scene = Scene::new(input, &elements, tree.order(), &part)?;
    let mut collector = Collector::new(names, max_defects);
    let mut countdown = PAIRS_PER_REPORT;
    tree.for_each_pair(&part, |i, j, done| {
        part.step()?;
        countdown -= 1;
        if countdown == 0 {
            countdown = PAIRS_PER_REPORT;
            part.progress(done)?;
        }
        scene.classify(i, j, &mut collector)
    })?;
    collector.finish(&part)
}

/// An element in the tree. The order of variants is the order in which `classify` expects a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Item {
    Vertex(u32),
    Segment(u32),
    Triangle(u32),
}

fn check_indices(input: &IntersectInput) -> Result<(), Error> {
    use crate::error::Status::{IndexOutOfRange, InvalidArgument, TooLarge};
    let count = input.points.len();
    let valid = |&i: &u32| (i as usize) < count;
    if input.triangle_facet.len() != input.triangles.len() {
        return Err(Error::new(InvalidArgument, "one facet per triangle is required"));
    }
    if input.triangles.len().max(input.segments.len()).max(input.vertices.len()) > (u32::MAX / 4) as usize {
        return Err(Error::new(TooLarge, "too many elements for the intersection test"));
    }
    let triangles = input.triangles.iter().all(|t| t.iter().all(valid));
    let segments = input.segments.iter().all(|s| s.iter().all(valid));
    if !(triangles && segments && input.vertices.iter().all(valid)) {
        return Err(Error::new(IndexOutOfRange, "an element refers to a point that does not exist"));
    }
    Ok(())
}

/// Triangles, segments and isolated vertices with their boxes, and the fans of the triangles and segments.
fn list_elements(input: &IntersectInput, control: &Control) -> Result<(Vec<Item>, Vec<Bounds>, Fans), Error> {
    let mut valence = fallible::filled(0, input.points.len())?;
    let corners = input.triangles.iter().flatten().chain(input.segments.iter().flatten());
    corners.for_each(|&v| valence[v as usize] += 1);
    let isolated = || input.vertices.iter().filter(|&&v| valence[v as usize] == 0);
    let count = input.triangles.len() + input.segments.len() + isolated().count();
    let (mut elements, mut bounds) = (fallible::reserved(count)?, fallible::reserved(count)?);
    control.look()?;
    let frame = Frame::of(input.points.iter());
    let mut add = |item: Item, corners: &[u32]| -> Result<(), Error> {
        fallible::push(&mut elements, item)?;
        fallible::push(&mut bounds, frame.bounds(corners.iter().map(|&v| &input.points[v as usize])))?;
        Ok(())
    };
    (0..).zip(input.triangles).try_for_each(|(i, corners)| add(Item::Triangle(i), corners))?;
    (0..).zip(input.segments).try_for_each(|(i, ends)| add(Item::Segment(i), ends))?;
    isolated().try_for_each(|&v| add(Item::Vertex(v), &[v]))?;
    control.look()?;
    let fans = Fans::new(input, &valence, control)?;
    Ok((elements, bounds, fans))
}

/// All elements in the order of the tree, so that neighbours in space are neighbours in memory.
struct Scene<'a> {
    input: &'a IntersectInput<'a>,
    /// A triangle is given by its place in `triangles`.
    items: Vec<Item>,
    triangles: Vec<Triangle>,
}

impl<'a> Scene<'a> {
    fn new(
        input: &'a IntersectInput<'a>,
        elements: &[Item],
        order: &[u32],
        control: &Control,
    ) -> Result<Scene<'a>, Error> {
        let (mut items, mut triangles) = (Vec::new(), Vec::new());
        items.try_reserve_exact(elements.len())?;
        triangles.try_reserve_exact(input.triangles.len())?;
        for &i in order {
            control.step()?;
            let mut item = elements[i as usize];
            if let Item::Triangle(t) = item {
                item = Item::Triangle(triangles.len() as u32);
                let (facet, corners) = (input.triangle_facet[t as usize], input.triangles[t as usize]);
                fallible::push(&mut triangles, Triangle::new(input.points, t, facet, corners))?;
            }
            fallible::push(&mut items, item)?;
        }
        Ok(Scene { input, items, triangles })
    }

    /// Classifies the contact of two elements, given by their places in the tree's order, whose boxes meet.
    #[inline]
    fn classify(&self, x: usize, y: usize, out: &mut Collector) -> Result<(), Error> {
        let points = self.input.points;
        let triangle = |i: u32| &self.triangles[i as usize];
        let segment = |i: u32| Segment::new(points, i, self.input.segments[i as usize]);
        let (x, y) = (self.items[x], self.items[y]);
        if let (Item::Triangle(i), Item::Triangle(j)) = (x, y) {
            let (a, b) = (triangle(i), triangle(j));
            // Triangles of one facet come from one triangulation, so they meet only in its edges.
            return if a.facet == b.facet { Ok(()) } else { triangle_triangle::classify(a, b, out) };
        }
        match if x <= y { (x, y) } else { (y, x) } {
            (Item::Segment(i), Item::Triangle(j)) => {
                segment_triangle::classify(&segment(i), triangle(j), out)
            }
            (Item::Segment(i), Item::Segment(j)) => segment_segment::classify(&segment(i), &segment(j), out),
            (Item::Vertex(v), Item::Triangle(i)) => {
                segment_triangle::classify_vertex(v, &points[v as usize], triangle(i), out)
            }
            (Item::Vertex(v), Item::Segment(i)) => {
                segment_segment::classify_vertex(v, &points[v as usize], &segment(i), out)
            }
            _ => Ok(()),
        }
    }
}
