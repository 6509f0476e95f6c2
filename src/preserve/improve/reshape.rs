//! Steps that improve a mesh of tetrahedra: an edge removed with the best sheet in its ring, a cavity filled in the best way found,
//! another apex for the walls of a tetrahedron ([`mod@approach`](crate::preserve::improve::approach)).
//!
//! Each step replaces tetrahedra by others whose worst is better in one measure, and no worse in the other than allowed. Qualities are
//! floating-point and only choose among fillings whose tetrahedra are positive by exact signs.
//!
//! Invariants: subfaces, edges on no facet, regions and vertices stay.
use crate::error::Error;
use crate::kernel::star::EdgeRing;
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, face_key};
use crate::kernel::{flag, NONE};
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::ops::shape::{Goal, Measure, Shape};
use crate::ops::sheet::Sheets;
use crate::predicates::{Points, Sign};
use crate::preserve::improve::approach::Approach;
use crate::preserve::solid::{reversed, Sector, Solid};
use crate::vector::{dot, sub};
use rustc_hash::FxHashSet;

/// Most tetrahedra round an edge that is removed.
const MOST_IN_RING: usize = 20;

/// Most vertices of the cavity in which a wall gets another apex, and search steps for each.
const MOST_AT_WALL: usize = 30;
const BUDGET_AT_WALL: u32 = 200;

/// The effort to improve a tetrahedron.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Most vertices of the cavities, and search steps for each.
    pub cavities: &'static [(usize, u32)],
    /// Walls of the tetrahedron get other apexes, too; if it has none, cavities are grown from the rings of its edges.
    pub thorough: bool,
}

/// What a step must reach.
#[derive(Clone, Copy, Debug)]
pub struct Aim {
    /// By which measure the worst tetrahedron must become better.
    pub measure: Measure,
    /// How good by the other measure is always good enough.
    pub enough: Shape,
    /// How good by the other measure is never good enough.
    pub least: Shape,
}

impl Aim {
    /// The goal for the replacement of tetrahedra. Half of their value in the other measure may be lost; otherwise most slivers would stay
    /// because of a hundredth of it.
    fn goal(&self, solid: &Solid, points: &Points, old: &[u32]) -> Goal {
        let worst = old.iter().map(|&t| shape(solid, points, t)).fold(Shape::BEST, Shape::worse);
        let other = if self.measure == Measure::Angle { Measure::Ratio } else { Measure::Angle };
        let least = (0.5 * worst.by(other)).min(self.enough.by(other)).max(self.least.by(other));
        Goal { measure: self.measure, above: worst.by(self.measure), least }
    }
}

/// The shape of a tetrahedron of the mesh.
pub fn shape(solid: &Solid, points: &Points, t: u32) -> Shape {
    Shape::of(points, solid.mesh.verts[t as usize])
}

/// Takes steps; keeps its scratch space.
#[derive(Default)]
pub struct Reshape {
    sheets: Sheets,
    approach: Approach,
    reconnect: Reconnect,
    ring: Vec<u32>,
    link: Vec<u32>,
    cavity: Vec<u32>,
    corners: Vec<u32>,
    /// Corner codes of tetrahedra that could be added to the cavity.
    doors: Vec<u32>,
    faces: Vec<[u32; 3]>,
    inner: Vec<u32>,
    /// Tetrahedra that a filling must have.
    given: Vec<[u32; 4]>,
    new: Vec<[u32; 4]>,
}

impl Reshape {
    /// Tries all ways to improve a tetrahedron; the new ones are `solid.fresh`.
    pub fn improve(
        &mut self,
        solid: &mut Solid,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        aim: &Aim,
        effort: Effort,
    ) -> Result<bool, Error> {
        for [i, j] in EDGE {
            let verts = solid.mesh.verts[t as usize];
            let edge = [verts[i as usize], verts[j as usize]];
            if self.remove_edge(solid, points, isolated, t, edge, aim)? {
                return Ok(true);
            }
        }
        if effort.thorough && self.lift(solid, points, isolated, t, aim)? {
            return Ok(true);
        }
        self.given.clear();
        for &(most, budget) in effort.cavities {
            self.ring.clear();
            self.ring.push(t);
            self.grow(solid, points, isolated, t, most)?;
            if self.refill(solid, points, aim, budget)? {
                return Ok(true);
            }
            if !effort.thorough || !self.approach.walls.is_empty() {
                continue;
            }
            for [i, j] in EDGE {
                let verts = solid.mesh.verts[t as usize];
                if !self.collect_ring(solid, isolated, t, [verts[i as usize], verts[j as usize]])? {
                    continue;
                }
                self.grow(solid, points, isolated, t, most)?;
                if self.refill(solid, points, aim, budget)? {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Gives the walls of a tetrahedron another apex, if it has walls.
    fn lift(
        &mut self,
        solid: &mut Solid,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        aim: &Aim,
    ) -> Result<bool, Error> {
        let goal = aim.goal(solid, points, &[t]);
        self.approach.find(solid, points, isolated, t, &goal)?;
        for i in 0..self.approach.apexes.len() {
            let apex = self.approach.apexes[i];
            self.approach.collect(solid, points, isolated, t, apex, &mut self.ring)?;
            self.grow(solid, points, isolated, t, 0)?;
            self.given.clear();
            self.given.extend(self.approach.walls.iter().map(|&[x, y, z]| [apex, x, y, z]));
            let small = self.corners.len() <= MOST_AT_WALL;
            if self.refill(solid, points, aim, if small { BUDGET_AT_WALL } else { 0 })? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Finds the tetrahedra round an edge and its link; false if it must stay.
    fn collect_ring(
        &mut self,
        solid: &Solid,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        [p, q]: [u32; 2],
    ) -> Result<bool, Error> {
        self.ring.clear();
        self.link.clear();
        for (t, .., k, l) in EdgeRing::new(&solid.mesh, t, p, q) {
            let walls = flag::FACE << k | flag::FACE << l;
            if solid.mesh.flags[t as usize] & walls != 0
                || solid.region[t as usize] == NONE
                || self.ring.len() == MOST_IN_RING
            {
                return Ok(false);
            }
            self.ring.try_reserve(1)?;
            self.ring.push(t);
            self.link.try_reserve(1)?;
            self.link.push(solid.mesh.verts[t as usize][k as usize]);
        }
        Ok(self.ring.len() >= 3 && !isolated.contains(&edge_key(p, q)))
    }

    /// Removes an edge of a tetrahedron with the best sheet.
    fn remove_edge(
        &mut self,
        solid: &mut Solid,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        [p, q]: [u32; 2],
        aim: &Aim,
    ) -> Result<bool, Error> {
        if !self.collect_ring(solid, isolated, t, [p, q])? {
            return Ok(false);
        }
        let goal = aim.goal(solid, points, &self.ring);
        self.new.clear();
        if !self.sheets.improve(points, [p, q], &self.link, &goal, &mut self.new)? {
            return Ok(false);
        }
        let region = solid.region[t as usize];
        let sector =
            Sector { old: std::mem::take(&mut self.ring), new: std::mem::take(&mut self.new), region };
        solid.replace(std::slice::from_ref(&sector))?;
        (self.ring, self.new) = (sector.old, sector.new);
        Ok(true)
    }

    /// Collects tetrahedra around one, up to a number of vertices: always the one with the nearest new vertex, or without any.
    fn grow(
        &mut self,
        solid: &mut Solid,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        seed: u32,
        most: usize,
    ) -> Result<(), Error> {
        self.cavity.clear();
        self.corners.clear();
        self.doors.clear();
        self.corners.try_reserve(most + 4)?;
        let start = solid.mesh.verts[seed as usize];
        let mut center = [0.0; 3];
        for p in start.map(|v| points.xyz(v)) {
            center = [0, 1, 2].map(|k| center[k] + 0.25 * p[k]);
        }
        let mut seeds = std::mem::take(&mut self.ring);
        let mut next = seeds.pop();
        while let Some(t) = next {
            self.cavity.try_reserve(1)?;
            self.cavity.push(t);
            solid.mesh.flags[t as usize] |= flag::MARK;
            for v in solid.mesh.verts[t as usize] {
                if !self.corners.contains(&v) {
                    self.corners.push(v);
                }
            }
            self.doors.try_reserve(4)?;
            self.doors
                .extend((4 * t..4 * t + 4).filter(|&c| !solid.is_wall(c)).map(|c| solid.mesh.across(c)));
            if let Some(seed) = seeds.pop() {
                next = Some(seed);
                continue;
            }
            let mut best: Option<(f64, u32)> = None;
            let mut i = 0;
            while i < self.doors.len() {
                let code = self.doors[i];
                let t = code >> 2;
                if solid.mesh.flags[t as usize] & flag::MARK != 0 || !may_join(solid, isolated, t) {
                    self.doors.swap_remove(i);
                    continue;
                }
                i += 1;
                let apex = solid.mesh.apex(code);
                let known = self.corners.contains(&apex);
                if !known && self.corners.len() >= most {
                    continue;
                }
                let away = sub(points.xyz(apex), &center);
                let distance = if known { -1.0 } else { dot(&away, &away) };
                if best.is_none_or(|b| (distance, t) < b) {
                    best = Some((distance, t));
                }
            }
            next = best.map(|b| b.1);
        }
        self.ring = seeds;
        Ok(())
    }

    /// Takes the given tetrahedra out of the polyhedron; false if they are not good enough, or nothing is left.
    fn cut_given(&mut self, points: &Points, goal: &Goal) -> Result<bool, Error> {
        for &[p, x, y, z] in &self.given {
            let good = goal.quality(Shape::of(points, [p, x, y, z])) > goal.above;
            if !good || points.orient3d(p, x, y, z) != Sign::Positive {
                return Ok(false);
            }
            for face in [[x, y, z], [p, z, y], [p, x, z], [p, y, x]] {
                let key = face_key(face);
                match self.faces.iter().position(|&f| face_key(f) == key) {
                    Some(i) if same_way(self.faces[i], face) => {
                        self.faces.swap_remove(i);
                    }
                    // The tetrahedron is on the other side of it.
                    Some(_) => return Ok(false),
                    None => {
                        self.faces.try_reserve(1)?;
                        self.faces.push(reversed(face));
                    }
                }
            }
        }
        Ok(!self.faces.is_empty())
    }

    /// Fills the cavity as well as the search can, or in some better way with the given tetrahedra; its own are unmarked.
    fn refill(&mut self, solid: &mut Solid, points: &Points, aim: &Aim, budget: u32) -> Result<bool, Error> {
        self.faces.clear();
        self.inner.clear();
        for &t in &self.cavity {
            for code in 4 * t..4 * t + 4 {
                let n = solid.mesh.across(code) >> 2;
                if solid.mesh.flags[n as usize] & flag::MARK == 0 {
                    self.faces.try_reserve(1)?;
                    self.faces.push(solid.mesh.face(code));
                }
            }
        }
        for &t in &self.cavity {
            solid.mesh.flags[t as usize] &= !flag::MARK;
        }
        let goal = aim.goal(solid, points, &self.cavity);
        if budget == 0 || !self.cut_given(points, &goal)? {
            return Ok(false);
        }
        self.inner.try_reserve(self.corners.len())?;
        let (faces, given) = (&self.faces, &self.given);
        let covered = |v: &u32| faces.iter().any(|f| f.contains(v)) || given.iter().any(|t| t.contains(v));
        self.inner.extend(self.corners.iter().filter(|&v| !covered(v)));
        let polyhedron = Polyhedron { faces: &self.faces, inner: &self.inner, edges: &[] };
        self.new.clear();
        let found = if given.is_empty() {
            self.reconnect.improve(points, &polyhedron, goal, budget, &mut self.new)?
        } else {
            self.reconnect.reach(points, &polyhedron, goal, budget, &mut self.new)?
        };
        if !found {
            return Ok(false);
        }
        self.new.try_reserve(self.given.len())?;
        self.new.extend_from_slice(&self.given);
        let region = solid.region[self.cavity[0] as usize];
        let sector =
            Sector { old: std::mem::take(&mut self.cavity), new: std::mem::take(&mut self.new), region };
        solid.replace(std::slice::from_ref(&sector))?;
        (self.cavity, self.new) = (sector.old, sector.new);
        Ok(true)
    }
}

/// Whether two faces with the same corners are turned the same way.
fn same_way([a, b, c]: [u32; 3], face: [u32; 3]) -> bool {
    face == [a, b, c] || face == [b, c, a] || face == [c, a, b]
}

/// Whether a tetrahedron may be added to the marked ones: no subface and no edge on no facet may come to lie inside.
pub(super) fn may_join(solid: &Solid, isolated: &FxHashSet<[u32; 2]>, t: u32) -> bool {
    let walled = (4 * t..4 * t + 4).any(|code| {
        let n = solid.mesh.across(code) >> 2;
        solid.mesh.flags[t as usize] & (flag::FACE << (code & 3)) != 0
            && solid.mesh.flags[n as usize] & flag::MARK != 0
    });
    let verts = solid.mesh.verts[t as usize];
    let free = isolated.is_empty()
        || EDGE.iter().all(|&[i, j]| !isolated.contains(&edge_key(verts[i as usize], verts[j as usize])));
    !walled && free
}
