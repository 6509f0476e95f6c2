//! The elements of a PLC that changes by flips, and a test whether a flip of two triangles keeps it valid.
//!
//! A flip replaces two faces of a tetrahedron `(a, b, c, d)` by the two others. If the old faces are part of a valid PLC, the new ones meet
//! every other element only in common vertices and edges, and no other vertex lies in the closed tetrahedron, then no part of the PLC is
//! inside: a convex piece of a triangle in the tetrahedron would have its corners where the triangle meets the boundary, which is in one
//! common vertex or edge.
//! A contact that would be legal elsewhere (a vertex in an edge or a triangle) counts as an obstacle too.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::intersect::boxtree::{BoxTree, Frame};
use crate::plc::intersect::collector::Collector;
use crate::plc::intersect::fans::Fans;
use crate::plc::intersect::locate_point::{Segment, Triangle};
use crate::plc::intersect::{segment_triangle, triangle_triangle, Names};
use crate::predicates::{orient3d, Sign};

/// An element in the tree.
#[derive(Clone, Copy)]
enum Item {
    Triangle(u32),
    Segment([u32; 2]),
    Seed([f64; 3]),
}

/// All elements, with a box tree that follows the flips.
pub struct Obstacles {
    frame: Frame,
    tree: BoxTree,
    items: Vec<Item>,
    /// The place in the tree of each triangle.
    place: Vec<u32>,
    triangles: Vec<Triangle>,
    stack: Vec<usize>,
}

impl Obstacles {
    /// The obstacles of a PLC: triangles (none degenerate), segments (those along edges of triangles may be omitted), and single points
    /// (isolated vertices and seeds).
    ///
    /// # Errors
    /// What ends the run, `OutOfMemory`.
    pub fn new(
        points: &[[f64; 3]],
        triangles: &[[u32; 3]],
        segments: &[[u32; 2]],
        seeds: &[[f64; 3]],
        control: &Control,
    ) -> Result<Obstacles, Error> {
        let frame = Frame::of(points.iter().chain(seeds));
        let count = triangles.len() + segments.len() + seeds.len();
        let (mut unsorted, mut bounds, mut items) = (Vec::new(), Vec::new(), Vec::new());
        unsorted.try_reserve_exact(count)?;
        bounds.try_reserve_exact(count)?;
        items.try_reserve_exact(count)?;
        fallible::extend(&mut unsorted, (0..triangles.len() as u32).map(Item::Triangle))?;
        fallible::extend(&mut unsorted, segments.iter().map(|&s| Item::Segment(s)))?;
        fallible::extend(&mut unsorted, seeds.iter().map(|&p| Item::Seed(p)))?;
        let at = |v: &u32| &points[*v as usize];
        fallible::extend(&mut bounds, triangles.iter().map(|t| frame.bounds(t.iter().map(at))))?;
        fallible::extend(&mut bounds, segments.iter().map(|s| frame.bounds(s.iter().map(at))))?;
        fallible::extend(&mut bounds, seeds.iter().map(|p| frame.bounds([p].into_iter())))?;
        let tree = BoxTree::new(&bounds, Fans::default(), control)?;
        let mut place = fallible::filled(0, triangles.len())?;
        for (k, &i) in (0..).zip(tree.order()) {
            fallible::push(&mut items, unsorted[i as usize])?;
            if let Some(place) = place.get_mut(i as usize) {
                *place = k;
            }
        }
        let mut cached = fallible::reserved(triangles.len())?;
        for (i, &corners) in (0..).zip(triangles) {
            control.step()?;
            fallible::push(&mut cached, Triangle::new(points, i, i, corners))?;
        }
        Ok(Obstacles { frame, tree, items, place, triangles: cached, stack: Vec::new() })
    }

    /// Sets new corners for a triangle.
    pub fn replace(&mut self, points: &[[f64; 3]], triangle: u32, corners: [u32; 3]) {
        self.triangles[triangle as usize] = Triangle::new(points, triangle, triangle, corners);
        let bounds = self.frame.bounds(corners.iter().map(|&v| &points[v as usize]));
        self.tree.replace(self.place[triangle as usize] as usize, bounds);
    }

    /// Whether the two triangles `old`, which meet in edge `ab` and have `c` and `d` opposite, may become `cda` and `cdb`. The tetrahedron
    /// must not be flat, and `cd` must not yet be an edge of any element.
    ///
    /// # Errors
    /// What ends the run, `OutOfMemory`.
    pub fn allow_flip(
        &mut self,
        points: &[[f64; 3]],
        old: [u32; 2],
        [a, b, c, d]: [u32; 4],
        control: &Control,
    ) -> Result<bool, Error> {
        let mut stack = std::mem::take(&mut self.stack);
        let tet = Tetrahedron::new(points, [a, b, c, d]);
        let new = [[c, d, a], [c, d, b]].map(|corners| Triangle::new(points, old[0], old[0], corners));
        let bounds = self.frame.bounds(tet.corners.iter());
        let mut collector = Collector::new(Names::NONE, 1);
        let hit = self.tree.any(&bounds, &mut stack, |place| {
            control.step()?;
            match self.items[place] {
                Item::Triangle(t) if old.contains(&t) => {}
                Item::Triangle(t) => {
                    let other = &self.triangles[t as usize];
                    if tet.misses(&other.corners) {
                        return Ok(false);
                    }
                    if (0..3).any(|k| tet.holds_vertex(other.ids[k], &other.corners[k])) {
                        return Ok(true);
                    }
                    for triangle in &new {
                        triangle_triangle::classify(triangle, other, &mut collector)?;
                    }
                }
                Item::Segment(ends) => {
                    if ends.iter().any(|&v| tet.holds_vertex(v, &points[v as usize])) {
                        return Ok(true);
                    }
                    let segment = Segment::new(points, 0, ends);
                    for triangle in &new {
                        segment_triangle::classify(&segment, triangle, &mut collector)?;
                    }
                }
                Item::Seed(p) => return Ok(tet.holds(&p)),
            }
            Ok(!collector.is_empty())
        })?;
        self.stack = stack;
        Ok(!hit)
    }
}

/// A tetrahedron that is not flat.
struct Tetrahedron {
    ids: [u32; 4],
    corners: [[f64; 3]; 4],
    orientation: Sign,
    low: [f64; 3],
    high: [f64; 3],
}

impl Tetrahedron {
    fn new(points: &[[f64; 3]], ids: [u32; 4]) -> Tetrahedron {
        let corners = ids.map(|v| points[v as usize]);
        let [a, b, c, d] = &corners;
        let orientation = orient3d(a, b, c, d);
        let low = std::array::from_fn(|k| corners.iter().fold(f64::INFINITY, |m, p| m.min(p[k])));
        let high = std::array::from_fn(|k| corners.iter().fold(f64::NEG_INFINITY, |m, p| m.max(p[k])));
        Tetrahedron { ids, corners, orientation, low, high }
    }

    /// Whether the boxes of the tetrahedron and of a triangle are apart.
    fn misses(&self, triangle: &[[f64; 3]; 3]) -> bool {
        (0..3).any(|k| {
            triangle.iter().all(|p| p[k] < self.low[k]) || triangle.iter().all(|p| p[k] > self.high[k])
        })
    }

    /// Whether another vertex lies in the closed tetrahedron.
    fn holds_vertex(&self, vertex: u32, p: &[f64; 3]) -> bool {
        !self.ids.contains(&vertex) && self.holds(p)
    }

    /// Whether a point lies in the closed tetrahedron.
    fn holds(&self, p: &[f64; 3]) -> bool {
        if (0..3).any(|k| p[k] < self.low[k] || p[k] > self.high[k]) {
            return false;
        }
        (0..4).all(|k| {
            let mut with = self.corners;
            with[k] = *p;
            let [a, b, c, d] = &with;
            orient3d(a, b, c, d) != -self.orientation
        })
    }
}
