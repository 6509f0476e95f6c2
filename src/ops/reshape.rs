//! Steps that improve a mesh of tetrahedra: an edge removed with the best sheet in its ring, a cavity filled in the best way found,
//! another apex for the walls of a tetrahedron ([`mod@approach`](crate::ops::approach)).
//!
//! Each step replaces tetrahedra by others whose worst is better in one measure, and no worse in the other than allowed. Qualities are
//! floating-point and only choose among fillings whose tetrahedra are positive by exact signs.
//!
//! Invariants: subfaces, edges on no facet, regions and vertices stay.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::EdgeRing;
use crate::kernel::cavity::{Cavity, Edges, Terms};
use crate::kernel::replace::Replace;
use crate::kernel::reversed;
use crate::kernel::tables::EDGE;
use crate::kernel::visited::Visited;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::kernel::{edge_key, face_key};
use crate::ops::approach::Approach;
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::ops::shape::{Goal, Measure, Shape};
use crate::ops::sheet::Sheets;
use crate::predicates::{Points, Sign};
use crate::vector::{dot, sub};
use rustc_hash::FxHashSet;

/// Most tetrahedra round an edge that is removed: time for better shapes. On eleven models with 22 points inside 10 changes one mesh, 40
/// none, but never their number.
const MOST_IN_RING: usize = 20;

/// Most vertices of the cavity in which a wall gets another apex: larger ones are filled only if they are cones. On nine models with 22
/// points inside 15 changes two meshes, 60 none, but never their number.
const MOST_AT_WALL: usize = 30;
/// Search steps for each of these cavities. 100 and 400 change nothing on nine models: it only bounds the work on worse ones.
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
    /// The largest volume that may come, unless what goes is larger.
    pub largest: f64,
}

impl Aim {
    /// The goal for the replacement of tetrahedra. Half of their value in the other measure may be lost; otherwise most slivers would stay
    /// because of a hundredth of it.
    pub(super) fn goal(&self, mesh: &Mesh, points: &Points, old: &[u32]) -> Goal {
        let worst = old.iter().map(|&t| shape(mesh, points, t)).fold(Shape::BEST, Shape::worse);
        let other = if self.measure == Measure::Angle { Measure::Ratio } else { Measure::Angle };
        let least = (0.5 * worst.by(other)).min(self.enough.by(other)).max(self.least.by(other));
        Goal {
            measure: self.measure,
            above: worst.by(self.measure),
            least,
            largest: self.largest.max(worst.volume),
        }
    }
}

/// The shape of a tetrahedron of the mesh.
pub fn shape(mesh: &Mesh, points: &Points, t: u32) -> Shape {
    Shape::of(points, mesh.verts(t))
}

/// Takes steps; keeps its scratch space.
pub struct Reshape<'a> {
    control: &'a Control<'a>,
    sheets: Sheets,
    approach: Approach,
    reconnect: Reconnect<'a>,
    /// Puts tetrahedra in place.
    pub replace: Replace,
    /// Whether the last step that was taken removed an edge; otherwise it filled a cavity anew.
    pub removed_edge: bool,
    ring: Vec<u32>,
    link: Vec<u32>,
    cavity: Cavity,
    corners: Vec<u32>,
    /// Corner codes of tetrahedra that could be added to the cavity.
    doors: Vec<u32>,
    faces: Vec<[u32; 3]>,
    inner: Vec<u32>,
    /// Tetrahedra that a filling must have.
    given: Vec<[u32; 4]>,
    new: Vec<[u32; 4]>,
}

impl<'a> Reshape<'a> {
    /// Steps that this control may end.
    pub fn new(control: &'a Control<'a>) -> Self {
        Reshape {
            control,
            sheets: Sheets::default(),
            approach: Approach::default(),
            reconnect: Reconnect::new(control),
            replace: Replace::default(),
            removed_edge: false,
            ring: Vec::new(),
            link: Vec::new(),
            cavity: Cavity::default(),
            corners: Vec::new(),
            doors: Vec::new(),
            faces: Vec::new(),
            inner: Vec::new(),
            given: Vec::new(),
            new: Vec::new(),
        }
    }

    /// Tries all ways to improve a tetrahedron; the new ones are in `replace.fresh`.
    pub fn improve(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        aim: &Aim,
        effort: Effort,
    ) -> Result<bool, Error> {
        for [i, j] in EDGE {
            let verts = mesh.verts(t);
            let edge = [verts[i as usize], verts[j as usize]];
            if self.remove_edge(mesh, points, isolated, t, edge, aim)? {
                self.removed_edge = true;
                return Ok(true);
            }
        }
        self.removed_edge = false;
        if effort.thorough && self.lift(mesh, points, isolated, t, aim)? {
            return Ok(true);
        }
        self.given.clear();
        for &(most, budget) in effort.cavities {
            self.ring.clear();
            fallible::push(&mut self.ring, t)?;
            self.grow(mesh, points, isolated, t, most)?;
            if self.refill(mesh, points, aim, budget)? {
                return Ok(true);
            }
            if !effort.thorough || !self.approach.walls.is_empty() {
                continue;
            }
            for [i, j] in EDGE {
                let verts = mesh.verts(t);
                if !self.collect_ring(mesh, isolated, t, [verts[i as usize], verts[j as usize]])? {
                    continue;
                }
                self.grow(mesh, points, isolated, t, most)?;
                if self.refill(mesh, points, aim, budget)? {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Gives the walls of a tetrahedron another apex, if it has walls.
    fn lift(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        aim: &Aim,
    ) -> Result<bool, Error> {
        self.control.look()?;
        let goal = aim.goal(mesh, points, &[t]);
        self.approach.find(mesh, points, isolated, t, &goal)?;
        for i in 0..self.approach.apexes.len() {
            let apex = self.approach.apexes[i];
            self.approach.collect(mesh, points, isolated, t, apex, &mut self.ring)?;
            self.grow(mesh, points, isolated, t, 0)?;
            self.given.clear();
            fallible::extend(&mut self.given, self.approach.walls.iter().map(|&[x, y, z]| [apex, x, y, z]))?;
            let small = self.corners.len() <= MOST_AT_WALL;
            if self.refill(mesh, points, aim, if small { BUDGET_AT_WALL } else { 0 })? {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Finds the tetrahedra round an edge and its link; false if it must stay.
    fn collect_ring(
        &mut self,
        mesh: &Mesh,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        [p, q]: [u32; 2],
    ) -> Result<bool, Error> {
        self.ring.clear();
        self.link.clear();
        for (t, .., k, l) in EdgeRing::new(mesh, t, p, q) {
            if mesh.is_subface(4 * t + k)
                || mesh.is_subface(4 * t + l)
                || mesh.region(t) == NONE
                || self.ring.len() == MOST_IN_RING
            {
                return Ok(false);
            }
            fallible::push(&mut self.ring, t)?;
            fallible::push(&mut self.link, mesh.vertex(t, k))?;
        }
        Ok(self.ring.len() >= 3 && !isolated.contains(&edge_key(p, q)))
    }

    /// Removes an edge of a tetrahedron with the best sheet.
    fn remove_edge(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        [p, q]: [u32; 2],
        aim: &Aim,
    ) -> Result<bool, Error> {
        if !self.collect_ring(mesh, isolated, t, [p, q])? {
            return Ok(false);
        }
        let goal = aim.goal(mesh, points, &self.ring);
        self.new.clear();
        if !self.sheets.improve(points, [p, q], &self.link, &goal, &mut self.new)? {
            return Ok(false);
        }
        self.replace.cavity(mesh, &self.ring, &self.new, &[])?;
        Ok(true)
    }

    /// Collects tetrahedra around one, up to a number of vertices: always the one with the nearest new vertex, or without any.
    fn grow(
        &mut self,
        mesh: &mut Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        seed: u32,
        most: usize,
    ) -> Result<(), Error> {
        self.cavity.clear();
        self.corners.clear();
        self.doors.clear();
        self.corners.try_reserve(most + 4)?;
        let start = mesh.verts(seed);
        let mut center = [0.0; 3];
        for p in start.map(|v| points.xyz(v)) {
            center = [0, 1, 2].map(|k| center[k] + 0.25 * p[k]);
        }
        let mut seeds = std::mem::take(&mut self.ring);
        let mut next = seeds.pop();
        while let Some(t) = next {
            self.cavity.add(t)?;
            for v in mesh.verts(t) {
                if !self.corners.contains(&v) {
                    fallible::push(&mut self.corners, v)?;
                }
            }
            fallible::extend(
                &mut self.doors,
                (4 * t..4 * t + 4).filter(|&c| !mesh.is_wall(c)).map(|c| mesh.across(c)),
            )?;
            if let Some(seed) = seeds.pop() {
                next = Some(seed);
                continue;
            }
            let mut best: Option<(f64, u32)> = None;
            let mut i = 0;
            while i < self.doors.len() {
                let code = self.doors[i];
                let t = code >> 2;
                if self.cavity.has(t) || !may_join(mesh, isolated, self.cavity.visited(), t) {
                    self.doors.swap_remove(i);
                    continue;
                }
                i += 1;
                let apex = mesh.apex(code);
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
                        fallible::push(&mut self.faces, reversed(face))?;
                    }
                }
            }
        }
        Ok(!self.faces.is_empty())
    }

    /// Fills the cavity as well as the search can, or in some better way with the given tetrahedra.
    fn refill(&mut self, mesh: &mut Mesh, points: &Points, aim: &Aim, budget: u32) -> Result<bool, Error> {
        self.cavity.bound(mesh, &Terms::keep(&Edges::default()))?;
        self.faces.clear();
        self.inner.clear();
        fallible::append(&mut self.faces, &self.cavity.faces)?;
        let goal = aim.goal(mesh, points, &self.cavity.tets);
        if budget == 0 || !self.cut_given(points, &goal)? {
            return Ok(false);
        }
        self.inner.try_reserve(self.corners.len())?;
        let (faces, given) = (&self.faces, &self.given);
        let covered = |v: &u32| faces.iter().any(|f| f.contains(v)) || given.iter().any(|t| t.contains(v));
        fallible::extend(&mut self.inner, self.corners.iter().copied().filter(|v| !covered(v)))?;
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
        fallible::append(&mut self.new, &self.given)?;
        self.replace.cavity(mesh, &self.cavity.tets, &self.new, &[])?;
        Ok(true)
    }
}

/// Whether two faces with the same corners are turned the same way.
fn same_way([a, b, c]: [u32; 3], face: [u32; 3]) -> bool {
    face == [a, b, c] || face == [b, c, a] || face == [c, a, b]
}

/// Whether a tetrahedron may be added to those visited: no subface and no edge on no facet may come to lie inside.
pub(super) fn may_join(mesh: &Mesh, isolated: &FxHashSet<[u32; 2]>, visited: &Visited, t: u32) -> bool {
    let walled =
        (4 * t..4 * t + 4).any(|code| mesh.is_subface(code) && visited.contains(mesh.across(code) >> 2));
    let verts = mesh.verts(t);
    let free = isolated.is_empty()
        || EDGE.iter().all(|&[i, j]| !isolated.contains(&edge_key(verts[i as usize], verts[j as usize])));
    !walled && free
}
