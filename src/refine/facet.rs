//! A point on a facet: where the circumcentre of a wall is, in the triangle of the facet that has it, exactly in the facet's plane.
//!
//! On the way from the wall to its circumcentre there may be a subsegment: that is split instead. The point's parameters have few bits
//! ([`Points::push_in_triangle`]); which wall it is put into is decided in floating-point arithmetic, that it lies strictly inside by exact signs.
use super::{encroached, nearest, Attempt, Need, OnFacet, Refine, Target, What, MOST_STEPS};
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::fill::place::FARTHEST;
use crate::fill::{too_many, MOST_POINTS};
use crate::kernel::{face_key, Mesh, NONE};
use crate::ops::insert::{Opening, Outcome};
use crate::predicates::Points;
use crate::size::{distance, Wanted, BELOW};
use crate::vector::{cross, dot, sub};

/// Of each patch the triangle that is its frame: three explicit points of its plane, not collinear.
#[derive(Debug, Default)]
pub struct Frames(Vec<[u32; 3]>);

impl Frames {
    /// Takes of the triangles of each patch the one with the largest area; patches are numbered without gaps.
    ///
    /// # Errors
    /// `OutOfMemory`, and what ends the run.
    pub fn new(
        points: &Points,
        triangles: impl Iterator<Item = ([u32; 3], u32)>,
        control: &Control,
    ) -> Result<Frames, Error> {
        let mut best: Vec<([u32; 3], f64)> = Vec::new();
        for (corners, patch) in triangles {
            control.step()?;
            let [x, y, z] = corners.map(|v| points.xyz(v));
            let n = cross(&sub(y, x), &sub(z, x));
            let area = dot(&n, &n);
            if best.len() <= patch as usize {
                fallible::resize(&mut best, patch as usize + 1, ([NONE; 3], -1.0))?;
            }
            if area > best[patch as usize].1 {
                best[patch as usize] = (corners, area);
            }
        }
        Ok(Frames(fallible::collect(best.into_iter().map(|x| x.0))?))
    }

    /// That of a patch; `None` if it has no triangle.
    pub fn of(&self, patch: u32) -> Option<[u32; 3]> {
        self.0.get(patch as usize).copied().filter(|frame| frame[0] != NONE)
    }
}

/// What is wanted on a facet, in the engine's lengths; infinite if nothing is.
#[derive(Clone, Copy, Debug)]
pub struct Wish {
    /// The edge length.
    pub length: f64,
    /// The largest area of a subface.
    pub area: f64,
}

impl Wish {
    const NONE: Wish = Wish { length: f64::INFINITY, area: f64::INFINITY };

    /// How many times its bound a triangle is.
    pub(super) fn excess(&self, [x, y, z]: [&[f64; 3]; 3]) -> f64 {
        let area = area([x, y, z]);
        // At most 10^100, as below.
        area / (BELOW * self.area).max(1e-100 * area).max(f64::MIN_POSITIVE)
    }
}

/// Of a triangle.
fn area([x, y, z]: [&[f64; 3]; 3]) -> f64 {
    let n = cross(&sub(y, x), &sub(z, x));
    0.5 * dot(&n, &n).sqrt()
}

/// What is wanted on the facets of each patch; empty if nothing is.
#[derive(Debug, Default)]
pub struct Wishes(Vec<Wish>);

impl Wishes {
    /// Lowers what is wanted on the facets of a patch.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn lower(&mut self, patch: u32, wish: Wish) -> Result<(), Error> {
        if self.0.len() <= patch as usize {
            fallible::resize(&mut self.0, patch as usize + 1, Wish::NONE)?;
        }
        let known = &mut self.0[patch as usize];
        *known = Wish { length: known.length.min(wish.length), area: known.area.min(wish.area) };
        Ok(())
    }

    /// That of a patch.
    pub fn of(&self, patch: u32) -> Wish {
        self.0.get(patch as usize).copied().unwrap_or(Wish::NONE)
    }

    /// All of them, by patch.
    pub fn list(&self) -> &[Wish] {
        &self.0
    }

    /// Refuses lengths that ask for more points on facets than a mesh can have, before it has filled the memory.
    ///
    /// # Errors
    /// `TooLarge`, and what ends the run.
    pub fn estimate(&self, mesh: &Mesh, points: &Points, control: &Control) -> Result<(), Error> {
        let mut sum = 0.0;
        if self.0.is_empty() {
            return Ok(());
        }
        for code in mesh.subfaces() {
            control.step()?;
            let length = self.of(mesh.subface(code)).length;
            let side = area(mesh.face(code).map(|v| points.xyz(v))).sqrt();
            // At most 10^5, whatever the length: compilers may divide before they choose.
            let ratio = side / length.max(1e-5 * side).max(f64::MIN_POSITIVE);
            // Equilateral triangles have √3/4 of the square of their edge, and two of them come with a point.
            sum += 2.0 / 3f64.sqrt() * ratio * ratio;
            if sum >= MOST_POINTS {
                return Err(too_many(sum));
            }
        }
        Ok(())
    }

    /// Whether areas are bounded.
    pub fn bound_areas(&self) -> bool {
        self.0.iter().any(|wish| wish.area.is_finite())
    }
}

/// Where a walk over a facet ends.
enum Over {
    /// In this wall.
    In(u32),
    /// Before this subsegment.
    Before([u32; 2]),
}

impl Refine<'_, '_> {
    /// Tries the circumcentre of a wall, or what is before it.
    pub(super) fn attempt_on_wall(&mut self, code: u32, need: Need, strict: bool) -> Result<Attempt, Error> {
        let corners = self.mesh.face(code);
        let patch = self.mesh.subface(code);
        let Some(frame) = self.frames.of(patch).filter(|_| self.mesh.is_subface(code)) else {
            return Ok(Attempt::Refused);
        };
        let Some((centre, _)) = circumcircle(corners.map(|v| self.points.xyz(v))) else {
            return Ok(Attempt::Refused);
        };
        let code = match self.seek(code, &centre) {
            Some(Over::In(code)) => code,
            Some(Over::Before(edge)) => return Ok(Attempt::Instead(Target::Edge(edge))),
            None => return Ok(Attempt::Refused),
        };
        // The circumcentre is the same for all walls from which it is looked for.
        let key = face_key(corners);
        let known = !need.large && self.near.walls.contains(&key);
        if known || self.is_kept(&centre) {
            return Ok(Attempt::Refused);
        }
        let Some(p) = self.points.push_in_triangle(frame, self.mesh.face(code), &centre)? else {
            return Ok(Attempt::Refused);
        };
        let mut crowded = false;
        let attempt = self.insert_on_wall(p, code, need, strict, &mut crowded)?;
        if !matches!(attempt, Attempt::Done) {
            self.points.pop();
        }
        if matches!(attempt, Attempt::TooNear) && crowded && self.what == What::Walls {
            fallible::add(&mut self.near.walls, key)?;
        }
        Ok(attempt)
    }

    fn insert_on_wall(
        &mut self,
        p: u32,
        code: u32,
        need: Need,
        strict: bool,
        crowded: &mut bool,
    ) -> Result<Attempt, Error> {
        let at = *self.points.xyz(p);
        let tet = if self.mesh.region(code >> 2) == NONE { self.mesh.across(code) >> 2 } else { code >> 2 };
        let wanted = self.size.at(self.points, &at, self.mesh.region(tet), &self.mesh.face(code))?;
        let floor = self.floor.at(self.points, &at, self.mesh.face(code).into_iter());
        let others = self.least_from_others(need, floor);
        let patch = self.mesh.subface(code);
        let most = self.wishes.of(patch).length;
        let wanted = Wanted { length: wanted.length.min(most), wish: wanted.wish.min(most) };
        let Refine { mesh, points, insert, .. } = self;
        let mut attempt = Attempt::TooNear;
        let accept = |opening: Opening| {
            let encroached = if strict { encroached(&opening, &at, false) } else { None };
            let rim = opening.rim_vertices().map(|v| distance(opening.points.xyz(v), &at));
            let mut too_near = rim.fold(f64::INFINITY, f64::min) < need.on_wall;
            if !need.large {
                *crowded = nearest(&opening, &at) < others;
                too_near |= *crowded;
            }
            match encroached {
                _ if too_near => {}
                Some(target) => attempt = Attempt::First(target),
                None => return Ok(true),
            }
            Ok(false)
        };
        match insert.on_facet_after(mesh, points, p, code, &self.part, accept)? {
            Some(Outcome::Inserted | Outcome::Squeezed(_)) => {}
            Some(Outcome::Blocked(edge)) => return Ok(Attempt::Instead(Target::Edge(edge))),
            Some(_) => return Ok(Attempt::Refused),
            None => return Ok(attempt),
        }
        fallible::push(&mut self.on_facets, OnFacet { v: p, patch })?;
        self.counts.on_facets += 1;
        self.size.set(p, wanted)?;
        self.floor.set(p, floor)?;
        self.count()?;
        Ok(Attempt::Done)
    }

    /// Walks over a facet from a wall to a place in its plane.
    fn seek(&self, code: u32, at: &[f64; 3]) -> Option<Over> {
        let (mut code, mut entered) = (code, [NONE; 2]);
        let name = self.mesh.subface(code);
        for _ in 0..MOST_STEPS {
            let corners = self.mesh.face(code);
            let [x, y, z] = corners.map(|v| self.points.xyz(v));
            let n = cross(&sub(y, x), &sub(z, x));
            let [a, b, c] = corners;
            let beyond = [[a, b], [b, c], [c, a]].into_iter().find(|&[v, w]| {
                let [p, q] = [v, w].map(|v| self.points.xyz(v));
                [w, v] != entered && [v, w] != entered && dot(&cross(&n, &sub(q, p)), &sub(at, p)) < 0.0
            });
            let Some(edge) = beyond else { return Some(Over::In(code)) };
            if self.mesh.is_subsegment(code >> 2, edge) {
                return Some(Over::Before(edge));
            }
            let next = self.mesh.next_wall(code, edge)?;
            // Triangles of a polygon that is planar only up to rounding are facets of their own.
            if self.mesh.subface(next) != name {
                return Some(Over::In(code));
            }
            (code, entered) = (next, edge);
        }
        None
    }
}

/// The circumcentre and circumradius of a triangle; `None` if it is flat.
pub(super) fn circumcircle([x, y, z]: [&[f64; 3]; 3]) -> Option<([f64; 3], f64)> {
    let (u, v) = (sub(y, x), sub(z, x));
    let n = cross(&u, &v);
    let (uu, vv, uv, nn) = (dot(&u, &u), dot(&v, &v), dot(&u, &v), dot(&n, &n));
    let weights = [vv * (uu - uv), uu * (vv - uv)];
    // What is farther than this is beyond all coordinates; hosts may trap a division by zero and an overflow.
    if !weights.iter().all(|w| w.abs() / FARTHEST < nn) {
        return None;
    }
    let [s, t] = weights.map(|w| w / (2.0 * nn));
    let d = [0, 1, 2].map(|k| s * u[k] + t * v[k]);
    Some(([0, 1, 2].map(|k| x[k] + d[k]), dot(&d, &d).sqrt()))
}

#[cfg(test)]
mod tests {
    use super::circumcircle;

    #[test]
    fn a_circle_has_its_points_at_one_distance() {
        let at = [[0.0, 0.0, 1.0], [4.0, 1.0, 0.0], [1.0, 3.0, 2.0]];
        let (centre, radius) = circumcircle(at.each_ref()).unwrap();
        for p in &at {
            assert!((crate::size::distance(p, &centre) - radius).abs() < 1e-12);
        }
        assert!(circumcircle([&[0.0; 3], &[1.0, 0.0, 0.0], &[2.0, 0.0, 0.0]]).is_none());
    }
}
