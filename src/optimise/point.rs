//! Points that come with their cavity, and points that go into a neighbour.
//!
//! A cavity grows from a bad tetrahedron, or from the ring of its longest edge, by quality: where the tetrahedron from the new point to a
//! face of the cavity would be the worst, what is behind that face joins, if that makes it better (Klingner & Shewchuk 2007). Then the point
//! is smoothed. It stays only if everything is better than the worst before.
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::EdgeRing;
use crate::kernel::cavity::{Cavity, Terms};
use crate::kernel::replace::Replace;
use crate::kernel::tables::EDGE;
use crate::kernel::{Mesh, NONE};
use crate::ops::apex::apex;
use crate::ops::place::sees_all;
use crate::ops::shape::sine;
use crate::optimise::{largest, Optimise};
use crate::predicates::{in_range, Points, Sign};
use crate::size::{distance, volume};

/// The most tetrahedra of a cavity.
const MOST: usize = 48;
/// Vertices with more faces round them stay: each neighbour is tried with all of them.
const LARGEST_LINK: usize = 200;

/// The least edge of a point over the shortest of the tetrahedra that go, and the least gain in sines. With 1, and 0.01 more than a twentieth of the
/// worst, the worst angles of the clean models with refined surfaces are 1.8° and 2.2° less (sofa_pelvis, of_flange), and 2.7° with regions8; with
/// 0.3 all are the same.
const SHORTEST: f64 = 0.5;
const LEAST_RISE: f64 = 0.005;

/// The scratch space of points that come.
#[derive(Default)]
pub(super) struct Coming {
    cavity: Cavity,
    /// Boundary faces: the sine from the point, and the corner code inside.
    open: Vec<(f64, u32)>,
    new: Vec<[u32; 4]>,
    pub(super) replace: Replace,
}

impl Coming {
    /// Grows the cavity from its tetrahedra by quality, until all from the place to its faces are good.
    fn grow(&mut self, mesh: &Mesh, points: &Points, at: &[f64; 3], good: f64) -> Result<(), Error> {
        let rate = |code: u32| {
            let [x, y, z] = mesh.face(code).map(|v| points.xyz(v));
            sine([at, x, y, z])
        };
        self.open.clear();
        for i in 0..self.cavity.tets.len() {
            let t = self.cavity.tets[i];
            for code in 4 * t..4 * t + 4 {
                if mesh.is_wall(code) || !self.cavity.has(mesh.across(code) >> 2) {
                    fallible::push(&mut self.open, (rate(code), code))?;
                }
            }
        }
        while self.cavity.tets.len() < MOST {
            let worst = self.open.iter().copied().min_by(|x, y| x.0.total_cmp(&y.0).then(x.1.cmp(&y.1)));
            let Some((value, code)) = worst else { return Ok(()) };
            let (other, n) = (mesh.across(code), mesh.across(code) >> 2);
            if value > good || mesh.is_wall(code) || self.cavity.has(n) {
                return Ok(());
            }
            // Faces of what is behind: those at the cavity vanish, the others come.
            let mut better = true;
            for side in (4 * n..4 * n + 4).filter(|&side| side != other) {
                let inner = !mesh.is_wall(side) && self.cavity.has(mesh.across(side) >> 2);
                better &= inner || rate(side) > value;
            }
            if !better {
                return Ok(());
            }
            self.cavity.add(n)?;
            self.open.retain(|x| mesh.is_wall(x.1) || mesh.across(x.1) >> 2 != n);
            for side in 4 * n..4 * n + 4 {
                if mesh.is_wall(side) || !self.cavity.has(mesh.across(side) >> 2) {
                    fallible::push(&mut self.open, (rate(side), side))?;
                }
            }
        }
        Ok(())
    }
}

impl Optimise<'_> {
    /// Puts a point into a tetrahedron, onto its longest edge that is on no wall, or over its walls, if that makes the worst there better.
    pub(super) fn add(&mut self, t: u32) -> Result<bool, Error> {
        let full = self.inside.total() >= self.most.points
            || self.most.tets.saturating_sub(self.mesh.live_count()) < 2 * MOST + 2;
        if self.budget == 0 || full {
            return Ok(false);
        }
        let verts = self.mesh.verts(t);
        let at = verts.map(|v| *self.points.xyz(v));
        let middle = [0, 1, 2].map(|k| at.iter().map(|p| p[k]).sum::<f64>() / 4.0);
        self.coming.cavity.set(&[t])?;
        if self.add_at(middle)? {
            return Ok(true);
        }
        let mut edges = EDGE.map(|e| e.map(usize::from));
        let length = |&[i, j]: &[usize; 2]| distance(&at[i], &at[j]);
        edges.sort_unstable_by(|e, f| length(f).total_cmp(&length(e)).then(e.cmp(f)));
        for [i, j] in edges {
            if self.ring([verts[i], verts[j]], t)? {
                let halfway = [0, 1, 2].map(|k| 0.5 * (at[i][k] + at[j][k]));
                if self.add_at(halfway)? {
                    return Ok(true);
                }
                break;
            }
        }
        // Over a wall, the middle of what is flat on it is no place from which a cavity could grow.
        for code in 4 * t..4 * t + 4 {
            let wall = self.mesh.is_wall(code).then(|| self.mesh.face(code));
            if let Some(apex) = wall.and_then(|wall| apex(self.points, wall)) {
                self.coming.cavity.set(&[t])?;
                if self.add_at(apex)? {
                    return Ok(true);
                }
            }
        }
        Ok(false)
    }

    /// Makes the ring of an edge of a tetrahedron the cavity, unless there is a wall or too much.
    fn ring(&mut self, [a, b]: [u32; 2], t: u32) -> Result<bool, Error> {
        self.coming.cavity.clear();
        for (t, .., k, l) in EdgeRing::new(self.mesh, t, a, b) {
            let walled = self.mesh.is_wall(4 * t + k) || self.mesh.is_wall(4 * t + l);
            if walled || self.mesh.region(t) == NONE || self.coming.cavity.tets.len() == MOST {
                return Ok(false);
            }
            self.coming.cavity.add(t)?;
        }
        Ok(true)
    }

    /// Puts a point there into what grows from the cavity.
    fn add_at(&mut self, at: [f64; 3]) -> Result<bool, Error> {
        if !at.iter().all(|&x| in_range(x)) {
            return Ok(false);
        }
        self.coming.grow(self.mesh, self.points, &at, self.level.good)?;
        let Coming { cavity, new, replace, .. } = &mut self.coming;
        cavity.bound(self.mesh, &Terms::keep(self.isolated))?;
        if !cavity.inner.is_empty() || !cavity.edges.is_empty() {
            return Ok(false);
        }
        let of = |&t: &u32| sine(self.mesh.verts(t).map(|v| self.points.xyz(v)));
        let worst = cavity.tets.iter().map(of).fold(f64::INFINITY, f64::min);
        let shortest = cavity.tets.iter().map(|&t| shortest_edge(self.mesh, self.points, t));
        let shortest = shortest.fold(f64::INFINITY, f64::min);
        let p = match self.next {
            Some(p) => {
                self.points.move_to(p, at)?;
                p
            }
            None => self.inside.add(self.mesh, self.points, at)?,
        };
        self.next = Some(p);
        self.link.clear();
        fallible::append(&mut self.link, &cavity.faces)?;
        if !sees_all(self.points, p, &self.link) {
            return Ok(false);
        }
        let (_, after) = self.descend.smooth(self.points, p, &mut self.link, self.level.good)?;
        // Points cost: next to nothing is not enough, and edges far shorter than those that go would lead to shorter ones again.
        let p_at = self.points.xyz(p);
        let near = self.link.iter().flatten().map(|&v| distance(self.points.xyz(v), p_at));
        if near.fold(f64::INFINITY, f64::min) < SHORTEST * shortest {
            return Ok(false);
        }
        if after <= worst + LEAST_RISE {
            return Ok(false);
        }
        let bound = self.bounds.of(self.mesh.region(cavity.tets[0]));
        let old = |&t: &u32| volume(self.mesh.verts(t).map(|v| self.points.xyz(v)));
        let bound = cavity.tets.iter().map(old).fold(bound, f64::max);
        if largest(self.points, p_at, &self.link) > bound {
            return Ok(false);
        }
        new.clear();
        fallible::extend(new, self.link.iter().map(|&[x, y, z]| [p, x, y, z]))?;
        self.mesh.add_vertex(p)?;
        replace.cavity(self.mesh, &cavity.tets, new, &[])?;
        self.next = None;
        self.budget -= 1;
        self.steps.points_added += 1;
        let count = self.points.len();
        fallible::resize(&mut self.movable, count, false)?;
        fallible::resize(&mut self.stuck, count, 0)?;
        fallible::resize(&mut self.moved, count, self.clock)?;
        self.movable[p as usize] = true;
        self.stuck[p as usize] = 0;
        let fresh = std::mem::take(&mut self.coming.replace.fresh);
        self.renew(&fresh)?;
        self.coming.replace.fresh = fresh;
        Ok(true)
    }

    /// Moves a point of a tetrahedron into a neighbour, where both become one, if the worst of its star gets better.
    pub(super) fn contract(&mut self, t: u32) -> Result<bool, Error> {
        for v in self.mesh.verts(t) {
            if !self.movable.get(v as usize).is_some_and(|&m| m) {
                continue;
            }
            self.search.link(self.mesh, v, &mut self.link)?;
            self.part.worked(self.link.len());
            if self.link.len() > LARGEST_LINK {
                continue;
            }
            let (points, link) = (&*self.points, &self.link);
            let rate = |p: u32, [x, y, z]: [u32; 3]| sine([p, x, y, z].map(|v| points.xyz(v)));
            let worst = link.iter().map(|&face| rate(v, face)).fold(f64::INFINITY, f64::min);
            let mut best = (worst + 0.01, NONE);
            let bound = self.bounds.of(self.mesh.region(t)).max(largest(points, points.xyz(v), link));
            self.into.clear();
            fallible::extend(&mut self.into, link.iter().flatten().copied())?;
            self.into.sort_unstable();
            self.into.dedup();
            for &w in &self.into {
                let mut least = f64::INFINITY;
                for &face in link.iter().filter(|face| !face.contains(&w)) {
                    least = least.min(rate(w, face));
                    let [x, y, z] = face;
                    if volume([w, x, y, z].map(|v| points.xyz(v))) > bound {
                        least = 0.0;
                    }
                    if least <= best.0 {
                        break;
                    }
                }
                if least > best.0 && least.is_finite() {
                    best = (least, w);
                }
            }
            let w = best.1;
            if w == NONE {
                continue;
            }
            self.coming.new.clear();
            let faces = link.iter().filter(|face| !face.contains(&w));
            fallible::extend(&mut self.coming.new, faces.map(|&[x, y, z]| [w, x, y, z]))?;
            let positive = |&[w, x, y, z]: &[u32; 4]| points.orient3d(w, x, y, z) == Sign::Positive;
            if !self.coming.new.iter().all(positive) {
                continue;
            }
            let Optimise { mesh, search, coming, .. } = self;
            coming.replace.cavity(mesh, &search.tets, &coming.new, &[])?;
            mesh.vertex_tet[v as usize] = NONE;
            self.movable[v as usize] = false;
            self.steps.points_removed += 1;
            let fresh = std::mem::take(&mut self.coming.replace.fresh);
            self.renew(&fresh)?;
            self.coming.replace.fresh = fresh;
            return Ok(true);
        }
        Ok(false)
    }
}

/// The length of the shortest edge of a tetrahedron.
fn shortest_edge(mesh: &Mesh, points: &Points, t: u32) -> f64 {
    let at = mesh.verts(t).map(|v| points.xyz(v));
    let length = |[i, j]: [u8; 2]| distance(at[i as usize], at[j as usize]);
    EDGE.into_iter().map(length).fold(f64::INFINITY, f64::min)
}
