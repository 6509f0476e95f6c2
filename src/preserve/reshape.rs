//! Steps that improve a mesh of tetrahedra: an edge removed with the best sheet in its ring, a cavity filled in the best way found.
//!
//! Both replace tetrahedra by others of which the worst is better by one measure, and no worse by the other than allowed. Qualities
//! are plain arithmetic and only choose among fillings whose tetrahedra are positive by exact signs.
//!
//! Invariants: subfaces, edges on no facet, regions and vertices stay.
use super::solid::{Sector, Solid};
use crate::constrain::edge_key;
use crate::error::Error;
use crate::mesh::star::EdgeRing;
use crate::mesh::tables::EDGE;
use crate::mesh::{flag, NONE};
use crate::predicates::Points;
use crate::reconnect::shape::{Goal, Measure, Shape};
use crate::reconnect::sheet::Sheets;
use crate::reconnect::{Polyhedron, Reconnect};
use crate::vector::{dot, sub};
use rustc_hash::FxHashSet;

/// Most tetrahedra round an edge that is removed.
const MOST_IN_RING: usize = 20;

/// How hard a tetrahedron is tried for.
#[derive(Clone, Copy, Debug)]
pub struct Effort {
    /// Most vertices of the cavities, and search steps for each.
    pub cavities: &'static [(usize, u32)],
    /// Cavities are grown from the rings of the tetrahedron's edges, too.
    pub rings: bool,
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
    /// What is to be reached in the place of tetrahedra. Half of what they are by the other measure may be lost: else most slivers
    /// would stay for a hundredth of it.
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
    reconnect: Reconnect,
    ring: Vec<u32>,
    link: Vec<u32>,
    cavity: Vec<u32>,
    corners: Vec<u32>,
    /// Corner codes of tetrahedra that could be added to the cavity.
    doors: Vec<u32>,
    faces: Vec<[u32; 3]>,
    inner: Vec<u32>,
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
            if self.remove_edge(solid, points, isolated, (t, edge), aim)? {
                return Ok(true);
            }
        }
        for &(most, budget) in effort.cavities {
            self.ring.clear();
            self.ring.push(t);
            self.grow(solid, points, isolated, t, most)?;
            if self.refill(solid, points, aim, budget)? {
                return Ok(true);
            }
            if !effort.rings {
                continue;
            }
            for [i, j] in EDGE {
                let verts = solid.mesh.verts[t as usize];
                if !self.collect_ring(solid, isolated, (t, [verts[i as usize], verts[j as usize]]))? {
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

    /// Finds the tetrahedra round an edge and its link; false if it must stay.
    fn collect_ring(
        &mut self,
        solid: &Solid,
        isolated: &FxHashSet<[u32; 2]>,
        (t, [p, q]): (u32, [u32; 2]),
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
        (t, [p, q]): (u32, [u32; 2]),
        aim: &Aim,
    ) -> Result<bool, Error> {
        if !self.collect_ring(solid, isolated, (t, [p, q]))? {
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

    /// Collects tetrahedra round one, up to a number of vertices: always the one with the nearest new vertex, or none new.
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

    /// Fills the cavity as well as the search can; its tetrahedra are unmarked.
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
        self.inner.try_reserve(self.corners.len())?;
        let faces = &self.faces;
        self.inner.extend(self.corners.iter().filter(|&v| !faces.iter().any(|f| f.contains(v))));
        let goal = aim.goal(solid, points, &self.cavity);
        let polyhedron = Polyhedron { faces: &self.faces, inner: &self.inner, edges: &[] };
        self.new.clear();
        if !self.reconnect.improve(points, &polyhedron, goal, budget, &mut self.new)? {
            return Ok(false);
        }
        let region = solid.region[self.cavity[0] as usize];
        let sector =
            Sector { old: std::mem::take(&mut self.cavity), new: std::mem::take(&mut self.new), region };
        solid.replace(std::slice::from_ref(&sector))?;
        (self.cavity, self.new) = (sector.old, sector.new);
        Ok(true)
    }
}

/// Whether a tetrahedron may be added to the marked ones: no subface and no edge on no facet may come to lie inside.
fn may_join(solid: &Solid, isolated: &FxHashSet<[u32; 2]>, t: u32) -> bool {
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
