//! Removal of faces: the edge between the two vertices on their sides takes their place. The inverse of the removal of an edge.
//!
//! Two vertices `a` and `b` *sandwich* a face that lies between a tetrahedron at `a` and one at `b`. A connected set of such faces goes,
//! with the edges between them, and every edge of its outline joined to `a` and `b` becomes a tetrahedron of the ring of `ab` (Shewchuk
//! 2002, "Two discrete optimization algorithms for the topological improvement of tetrahedral meshes"; Klingner & Shewchuk 2007,
//! "Aggressive tetrahedral mesh improvement"). The flips 2-3 and 4-4 are the cases of one and two faces. The flip 2-2 is none here: it
//! would change the boundary, which stays.
//!
//! Why the outcome is valid: all new tetrahedra are positive, and their boundary is that of the old ones, so they cover each point as often.
//!
//! Why the sets form a tree: seen along `ab`, the outline runs once round this line, and always forward. If it may run forward along a
//! side of a face, what lies beyond that side is seen within the angle of the side, and the corner beyond divides this angle. If not, the
//! line lies beyond, within a larger angle. So angles are nested or disjoint, no face is reached twice, and for each side the best
//! way to end or to go on does not depend on the other sides.
//!
//! Invariants: subfaces, edges that must stay, regions and vertices stay. Signs are exact; quality is floating-point and only chooses.
use crate::error::Error;
use crate::fallible;
use crate::kernel::cavity::Edges;
use crate::kernel::edge_key;
use crate::kernel::replace::Replace;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::reshape::Aim;
use crate::ops::shape::{Goal, Shape};
use crate::ops::sheet::MOST_IN_RING;
use crate::predicates::{Points, Sign};

/// The most faces looked at: a sheet can fill the ring that comes.
pub const MOST_FACES: usize = MOST_IN_RING - 2;

/// A side of a face that may go, and the best choice from there on.
#[derive(Clone, Copy, Debug)]
struct Side {
    /// Its ends `u w`: the outline may run here if `(a, b, u, w)` is positive.
    edge: [u32; 2],
    /// The third corner of the face.
    third: u32,
    /// The tetrahedra of the face, at `a` and at `b`.
    tets: [u32; 2],
    /// The sign of `(a, b, u, w)`.
    sign: Sign,
    /// Where the two other sides of the face beyond are, if that may go; or `NONE`.
    beyond: u32,
    /// The worst new tetrahedron from here on.
    worst: f64,
    /// Whether the face beyond goes.
    crossed: bool,
}

/// What faces are removed from.
pub struct Site<'a> {
    /// The mesh.
    pub mesh: &'a mut Mesh,
    /// The vertices.
    pub points: &'a Points,
    /// Edges that must stay.
    pub edges: &'a Edges,
    /// Puts tetrahedra in place; the new ones are in `replace.fresh`.
    pub replace: &'a mut Replace,
}

/// Removes faces; keeps its scratch space.
#[derive(Default)]
pub struct Faces {
    /// The two vertices.
    ends: [u32; 2],
    /// The sides of the first face, then pairs of those of the faces reached, each pair after the side that leads to it.
    sides: Vec<Side>,
    /// Whether the chosen set reaches each side.
    reached: Vec<bool>,
    /// The tetrahedra that go, those of the first face in front.
    old: Vec<u32>,
    /// Those that come, in the order of the sides.
    new: Vec<[u32; 4]>,
}

impl Faces {
    /// Removes the face of a corner, with others, if the worst new tetrahedron is better than the worst old one. Of the sets with this face,
    /// the one with the best worst tetrahedron counts.
    pub fn improve(&mut self, site: &mut Site, code: u32, aim: &Aim) -> Result<bool, Error> {
        let Site { mesh, points, edges, replace } = site;
        // These two go anyway. If others do, the goal for the other measure is no higher.
        let pair = [code >> 2, mesh.across(code) >> 2];
        if pair.iter().any(|&t| mesh.is_ghost(t)) {
            return Ok(false);
        }
        let goal = Goal { above: 0.0, ..aim.goal(mesh, points, &pair) };
        let Some(worst) = self.plan(mesh, points, edges, code, &goal)? else { return Ok(false) };
        if worst <= aim.goal(mesh, points, &self.old).above {
            return Ok(false);
        }
        replace.cavity(mesh, &self.old, &self.new, &[])?;
        Ok(true)
    }

    /// Removes the face of a corner, with others, if the new tetrahedra then reach a goal.
    #[cfg(test)]
    pub fn reach(&mut self, site: &mut Site, code: u32, goal: &Goal) -> Result<bool, Error> {
        let Site { mesh, points, edges, replace } = site;
        if self.plan(mesh, points, edges, code, goal)?.is_none() {
            return Ok(false);
        }
        replace.cavity(mesh, &self.old, &self.new, &[])?;
        Ok(true)
    }

    /// Finds the best set with the face of a corner, if it reaches the goal: its worst new tetrahedron, in `self.old` the tetrahedra that go,
    /// in `self.new` those that come.
    fn plan(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        keep: &Edges,
        code: u32,
        goal: &Goal,
    ) -> Result<Option<f64>, Error> {
        if !self.begin(mesh, points, code)? {
            return Ok(None);
        }
        self.look_round(mesh, points, keep)?;
        self.choose(points, goal);
        let worst = self.sides.iter().take(3).map(|side| side.worst).fold(f64::INFINITY, f64::min);
        if worst <= goal.above {
            return Ok(None);
        }
        self.collect()?;
        Ok(Some(worst))
    }

    /// Starts with the face of a corner; false if it is in no set.
    fn begin(&mut self, mesh: &Mesh, points: &Points, code: u32) -> Result<bool, Error> {
        let other = mesh.across(code);
        let tets = [code >> 2, other >> 2];
        if mesh.is_subface(code) || !tets.iter().all(|&t| may_go(mesh, tets[0], t)) {
            return Ok(false);
        }
        self.ends = [mesh.apex(code), mesh.apex(other)];
        let [x, y, z] = mesh.face(code);
        let sides = [([x, y], z), ([y, z], x), ([z, x], y)].map(|(edge, z)| self.side(points, edge, z, tets));
        self.sides.clear();
        self.sides.try_reserve(1 + 2 * MOST_FACES)?;
        fallible::extend(&mut self.sides, sides)?;
        // The line through both vertices lies beyond one side, if not within all.
        Ok(sides.iter().filter(|side| side.sign == Sign::Positive).count() >= 2)
    }

    /// A side of a face of which nothing more is known.
    fn side(&self, points: &Points, edge: [u32; 2], third: u32, tets: [u32; 2]) -> Side {
        let ([a, b], [u, w]) = (self.ends, edge);
        let sign = points.orient3d(a, b, u, w);
        Side { edge, third, tets, sign, beyond: NONE, worst: f64::NEG_INFINITY, crossed: false }
    }

    /// Finds the faces that may go with the first one, those near it first.
    fn look_round(&mut self, mesh: &Mesh, points: &Points, keep: &Edges) -> Result<(), Error> {
        let mut i = 0;
        while i < self.sides.len() && self.sides.len() < 1 + 2 * MOST_FACES {
            if let Some(pair) = self.cross(mesh, points, keep, &self.sides[i]) {
                self.sides[i].beyond = self.sides.len() as u32;
                fallible::extend(&mut self.sides, pair)?;
            }
            i += 1;
        }
        Ok(())
    }

    /// The other sides of the face beyond a side, if it may go, with what is between.
    fn cross(&self, mesh: &Mesh, points: &Points, keep: &Edges, side: &Side) -> Option<[Side; 2]> {
        let Side { edge: [u, w], third, tets, sign, .. } = *side;
        if keep.contains(&edge_key(u, w)) {
            return None;
        }
        let mut entered = [NONE; 2];
        for (entered, &t) in entered.iter_mut().zip(&tets) {
            let code = 4 * t + mesh.slot_of(t, third)?;
            *entered = mesh.across(code);
            if mesh.is_subface(code) || !may_go(mesh, t, *entered >> 2) {
                return None;
            }
        }
        let (v, next) = (mesh.apex(entered[0]), entered.map(|code| code >> 2));
        let face = 4 * next[0] + mesh.slot_of(next[0], self.ends[0])?;
        if mesh.is_subface(face) || mesh.across(face) >> 2 != next[1] {
            return None;
        }
        let pair = [([u, v], w), ([v, w], u)].map(|(edge, third)| self.side(points, edge, third, next));
        let forward = pair.iter().filter(|side| side.sign == Sign::Positive).count();
        // The line through both vertices lies on this side, or on that one and perhaps beyond one of the others.
        let least = if sign == Sign::Negative { 1 } else { 2 };
        (forward >= least).then_some(pair)
    }

    /// Finds the best choice for each side, the last first.
    fn choose(&mut self, points: &Points, goal: &Goal) {
        let [a, b] = self.ends;
        for i in (0..self.sides.len()).rev() {
            let Side { edge: [u, w], sign, beyond, .. } = self.sides[i];
            let end = match sign {
                Sign::Positive => goal.quality(Shape::of(points, [a, b, u, w])),
                _ => f64::NEG_INFINITY,
            };
            let on = match self.sides.get(beyond as usize..) {
                Some([one, other, ..]) => one.worst.min(other.worst),
                _ => f64::NEG_INFINITY,
            };
            // As few faces as possible go.
            let side = &mut self.sides[i];
            side.crossed = on > end;
            side.worst = end.max(on);
        }
    }

    /// Collects the tetrahedra of the best set.
    fn collect(&mut self) -> Result<(), Error> {
        let ([a, b], count) = (self.ends, self.sides.len());
        self.old.clear();
        self.new.clear();
        self.old.try_reserve(count)?;
        self.new.try_reserve(count)?;
        self.reached.clear();
        fallible::resize(&mut self.reached, count, false)?;
        self.reached[..3].fill(true);
        fallible::extend(&mut self.old, self.sides[0].tets)?;
        for i in 0..count {
            let Side { edge: [u, w], beyond, crossed, .. } = self.sides[i];
            if !self.reached[i] {
                continue;
            }
            if !crossed {
                fallible::push(&mut self.new, [a, b, u, w])?;
                continue;
            }
            let beyond = beyond as usize;
            self.reached[beyond..beyond + 2].fill(true);
            fallible::extend(&mut self.old, self.sides[beyond].tets)?;
        }
        Ok(())
    }
}

/// Whether a tetrahedron may go together with another. Those at subsegments stay: an edge inside a set might be one.
fn may_go(mesh: &Mesh, with: u32, t: u32) -> bool {
    !mesh.is_ghost(t) && mesh.region(t) == mesh.region(with) && mesh.subsegment_bits(t) == 0
}
