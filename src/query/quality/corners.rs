//! Narrow corners of facets, which force large radius-edge ratios.
//!
//! A corner is what a facet has at a point from one subsegment to the next: the subfaces that one passes on the way, without crossing a
//! subsegment. Their angles there add up to that of the corner, so each is at most that, in every mesh of this input. A triangle with an angle
//! α has a circumradius over shortest edge of at least 1 / (2 sin α), since 2 sin α is the length of the edge opposite the angle over the
//! circumradius; a tetrahedron has at least that of its faces. So all tetrahedra at a corner of less than arcsin(1 / (2 ratio)) are above
//! the ratio.
use crate::elementary::{angle_in_degrees, quotient};
use crate::error::Error;
use crate::fallible;
use crate::query::quality::tet::{length, to_one};
use crate::vector::{cross, dot, sub};
use crate::TetMesh;

/// A triangle in units of about its own size: the edges from the first corner to the others, and between these.
pub(super) struct Triangle([[f64; 3]; 3]);

impl Triangle {
    /// A triangle of a mesh; `None` if it has no size, or a coordinate is not finite.
    pub fn of(mesh: &TetMesh, corners: &[u32; 3]) -> Option<Triangle> {
        let at = corners.map(|v| mesh.points.get(v as usize).copied().unwrap_or_default());
        if !at.as_flattened().iter().all(|x| x.is_finite()) {
            return None;
        }
        let (factor, _) = to_one(at.as_flattened())?;
        let [a, b, c] = at.map(|p| p.map(|x| x * factor));
        let edges = [sub(&b, &a), sub(&c, &a), sub(&c, &b)];
        let (factor, _) = to_one(edges.as_flattened())?;
        Some(Triangle(edges.map(|edge| edge.map(|x| x * factor))))
    }

    /// The circumradius over the shortest edge; infinite if it is flat.
    pub fn radius_edge(&self) -> f64 {
        let [u, v, w] = &self.0;
        let mut lengths = [u, v, w].map(length);
        lengths.sort_unstable_by(f64::total_cmp);
        let [_, middle, longest] = lengths;
        quotient(middle * longest, 2.0 * length(&cross(u, v))).unwrap_or(f64::INFINITY)
    }

    /// The angle at the first corner, in degrees.
    fn angle(&self) -> f64 {
        let [u, v, _] = &self.0;
        angle_in_degrees(dot(u, v), length(&cross(u, v)))
    }
}

/// An edge of a subface, the smaller end first.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    ends: [u32; 2],
    subface: u32,
}

/// The subfaces of a mesh by their edges, and its subsegments.
struct Surface<'a> {
    mesh: &'a TetMesh,
    /// Sorted.
    sides: Vec<Side>,
    /// Sorted.
    subsegments: Vec<[u32; 2]>,
}

impl Surface<'_> {
    fn new(mesh: &TetMesh) -> Result<Surface<'_>, Error> {
        let mut sides = fallible::reserved(3 * mesh.subfaces.len())?;
        for (subface, face) in (0..).zip(&mesh.subfaces) {
            let [a, b, c] = face.corners;
            for ends in [[a, b], [b, c], [c, a]] {
                fallible::push(&mut sides, Side { ends: sorted(ends), subface })?;
            }
        }
        sides.sort_unstable();
        let mut subsegments = fallible::collect(mesh.subsegments.iter().map(|edge| sorted(edge.ends)))?;
        subsegments.sort_unstable();
        Ok(Surface { mesh, sides, subsegments })
    }

    fn is_subsegment(&self, ends: [u32; 2]) -> bool {
        self.subsegments.binary_search(&sorted(ends)).is_ok()
    }

    /// The subface on the other side of an edge that is no subsegment.
    fn across(&self, subface: u32, ends: [u32; 2]) -> Option<u32> {
        let ends = sorted(ends);
        let first = self.sides.partition_point(|side| side.ends < ends);
        let there = self.sides[first..].iter().take_while(|side| side.ends == ends);
        let mut others = there.map(|side| side.subface).filter(|&other| other != subface);
        others.next().filter(|_| others.next().is_none())
    }

    /// Goes over a facet around a point, from an edge of a subface to the next subsegment; in `passed` it leaves the subfaces between
    /// them. Whether their angle is below a limit.
    fn cross_corner(
        &self,
        mut subface: u32,
        point: u32,
        mut from: u32,
        limit: f64,
        passed: &mut Vec<u32>,
    ) -> Result<bool, Error> {
        passed.clear();
        let mut angle = 0.0;
        // Subfaces that contradict each other lead nowhere.
        while passed.len() < self.mesh.subfaces.len() {
            let corners = self.mesh.subfaces[subface as usize].corners;
            let Some(&to) = corners.iter().find(|&&corner| corner != point && corner != from) else {
                return Ok(false);
            };
            angle += Triangle::of(self.mesh, &[point, from, to]).map_or(0.0, |triangle| triangle.angle());
            if angle >= limit {
                return Ok(false);
            }
            fallible::push(passed, subface)?;
            if self.is_subsegment([point, to]) {
                return Ok(true);
            }
            let Some(next) = self.across(subface, [point, to]) else { return Ok(false) };
            (subface, from) = (next, to);
        }
        Ok(false)
    }
}

/// Calls a function for each subface in a corner that is too narrow for a ratio, with the facets on both sides of the corner (mostly one
/// and the same); more than once for some.
pub(super) fn narrow_corners(
    mesh: &TetMesh,
    ratio: f64,
    mut found: impl FnMut(usize, [u32; 2]) -> Result<(), Error>,
) -> Result<(), Error> {
    let sine = (0.5 / ratio.max(0.5)).min(1.0);
    let limit = angle_in_degrees((1.0 - sine * sine).sqrt(), sine);
    let surface = Surface::new(mesh)?;
    let mut passed = Vec::new();
    for (i, face) in (0u32..).zip(&mesh.subfaces) {
        for k in 0..3 {
            let [point, a, b] = [0, 1, 2].map(|j| face.corners[(k + j) % 3]);
            for from in [a, b] {
                if !surface.is_subsegment([point, from])
                    || !surface.cross_corner(i, point, from, limit, &mut passed)?
                {
                    continue;
                }
                let last = passed.last().map_or(face.facet, |&last| mesh.subfaces[last as usize].facet);
                let facets = sorted([face.facet, last]);
                passed.iter().try_for_each(|&subface| found(subface as usize, facets))?;
            }
        }
    }
    Ok(())
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
