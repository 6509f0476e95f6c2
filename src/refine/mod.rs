//! Constrained Delaunay refinement: a constrained Delaunay tetrahedralization (CDT) gets points inside, exactly on facets and exactly on
//! segments until its tetrahedra have the sizes and the shape asked for, and stays one.
//!
//! Chew 1989, Ruppert 1995, Shewchuk 1998, Si 2008, Shewchuk & Si 2014. The worst tetrahedron comes first. It gets its circumcentre; if a
//! wall is before that, or it is in the smallest sphere round a wall or a subsegment of its cavity, that is split instead ([`facet`],
//! [`segment`]). So a wall or subsegment is only split for a tetrahedron that needs it, never since a vertex of the surface is in its sphere:
//! surfaces that meet at small angles are left alone where the tetrahedra between them are good. If the split is refused, the circumcentre
//! is tried without regard to spheres.
//!
//! Why it ends, for every input: a point that comes for a shape is no nearer to its neighbours than the shortest edge of the tetrahedron that it
//! comes for, times [`SHORTEN`] for every such point before it; one that comes for a size is not nearer than a share of the size, and on a
//! segment or facet that counts along it. A tetrahedron for which nothing can be done is not looked at again. What remains bad is at small angles of
//! the input, or next to such a tetrahedron.
//!
//! No point comes whose tetrahedra would be flat or inverted at the doubles nearest to their points: so rounding, which comes after this, has
//! nothing to mend where it need not mend the recovered surface.
//!
//! Invariants: the mesh is a CDT by exact signs, walls are unions of faces, segments unions of edges. Everything else (which point is tried, what
//! is in which sphere) is floating-point.
pub(crate) mod facet;
mod floor;
mod segment;
#[cfg(test)]
pub(crate) mod tests;

use crate::control::Part;
use crate::elementary::quotient;
use crate::error::Error;
use crate::fallible;
use crate::fill::place::{circumcentre, snapped};
use crate::fill::{bounding_box, LARGE};
use crate::kernel::around::{EdgeRing, StarSearch};
use crate::kernel::budget::Budget;
use crate::kernel::{Mesh, NONE};
use crate::ops::insert::{Insert, Opening, Outcome};
use crate::output::RefineStatistics;
use crate::predicates::{Points, Sign};
use crate::preserve::inside::Inside;
use crate::segments::recovery::Segments;
use crate::size::{distance, Bounds, Size};
use crate::vector::{dot, sub};
use facet::{Frames, Wishes};
use floor::Floor;
use rustc_hash::{FxHashMap, FxHashSet};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Least distance of a new point over the size, where it comes for the size: inside, on a facet (from what is on the facet) and on a segment (from
/// the ends of the piece).
const APART: f64 = 0.7;
/// The same where only a volume is too large, and in the middle of such a tetrahedron.
const APART_FOR_VOLUME: f64 = 0.5;
const APART_IN_MIDDLE: f64 = 0.2;
/// How much too large a tetrahedron is whose middle is tried.
const FAR_TOO_LARGE: f64 = 1.5;
const APART_ON_WALL: f64 = 0.5;
const APART_ON_SEGMENT: f64 = 0.4;
/// How much shorter than the shortest edge of its tetrahedron an edge may be that comes for its shape.
const SHORTEN: f64 = 1.0;
/// How many points may come for a shape, on walls and then for tetrahedra: these, and so many for each of the input. With 10 the CAD models of
/// [`floor`] have 505,000 tetrahedra instead of 448,000, 6,380 below 10° instead of 5,950; clean models need no two for each.
const LEAST_BUDGET: usize = 2000;
const POINTS_A_POINT: usize = 4;
/// Above all that is too thin: lengths are below 2^400.
const LARGE_FIRST: f64 = 1e150;
/// The most tetrahedra that a walk passes.
const MOST_STEPS: usize = 2000;
/// How many places may be tried one instead of the other.
const MOST_INSTEAD: usize = 6;

/// A ball in which the surface stays as it is.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// Where.
    pub centre: [f64; 3],
    /// How large.
    pub radius: f64,
}

/// A point on a facet, not on its edges.
#[derive(Clone, Copy, Debug)]
pub struct OnFacet {
    /// The vertex.
    pub v: u32,
    /// Its patch.
    pub patch: u32,
}

/// What a mesh has to have.
pub struct Goal<'a, 'b> {
    /// The lengths.
    pub size: &'a mut Size<'b>,
    /// The largest circumradius over shortest edge.
    pub ratio: f64,
    /// The largest volumes.
    pub bounds: &'a Bounds,
    /// What is wanted on facets.
    pub wishes: &'a Wishes,
    /// Where the surface stays as it is.
    pub kept: &'a [Ball],
}

/// What is refined.
pub struct Model<'a> {
    /// Carved, with named subfaces and marked subsegments.
    pub mesh: &'a mut Mesh,
    /// All points.
    pub points: &'a mut Points,
    /// The segments, which are split.
    pub segments: &'a mut Segments,
    /// The points inside.
    pub inside: &'a mut Inside,
    /// Of the patches.
    pub frames: &'a Frames,
}

/// What came of it.
pub struct Refined {
    /// The points on facets, in ascending order.
    pub on_facets: Vec<OnFacet>,
    /// Counts.
    pub counts: RefineStatistics,
}

/// A tetrahedron to be split: the bits of how bad it is, its slot (the lowest first), and after which change it came.
type Entry = (u64, Reverse<u32>, u64);

/// Where a point is tried.
#[derive(Clone, Copy, Debug)]
enum Target {
    /// At the circumcentre of this tetrahedron.
    Centre(u32),
    /// In its middle.
    Middle(u32),
    /// At that of this wall.
    Wall(u32),
    /// In this subsegment.
    Edge([u32; 2]),
}

/// What a point comes for.
#[derive(Clone, Copy, Debug)]
struct Need {
    /// A size, not a shape.
    large: bool,
    /// Its least distance from others: for a shape; for a size inside, on a facet, on a segment.
    least: f64,
    on_wall: f64,
    on_segment: f64,
    /// That of the middle of the tetrahedron, which is tried if all else is refused.
    middle: Option<f64>,
}

impl Need {
    /// The same, where a shape may make no shorter edges than this.
    fn above(self, floor: f64) -> Need {
        match self.large {
            true => self,
            false => Need { least: self.least.max(floor), ..self },
        }
    }
}

/// What became of it.
#[derive(Clone, Copy, Debug)]
enum Attempt {
    /// It is in the mesh.
    Done,
    /// This comes first: the place is in its sphere, and is tried again without regard to it if it is refused.
    First(Target),
    /// This comes instead: it is in the way.
    Instead(Target),
    /// A vertex is too near.
    TooNear,
    /// It is not good.
    Refused,
}

/// What was refused since a vertex is too near to where it would be split: it only gets nearer, since no vertex goes. Only looked up.
#[derive(Default)]
struct Refused {
    walls: FxHashSet<[u32; 3]>,
    pieces: FxHashSet<u32>,
    /// The subsegment that was in the way of a piece's split, and the last change round the piece: asked again after the next one.
    blocked: FxHashMap<u32, ([u32; 2], u64)>,
}

/// The state of a refinement.
struct Refine<'a, 'b> {
    mesh: &'a mut Mesh,
    points: &'a mut Points,
    segments: &'a mut Segments,
    inside: &'a mut Inside,
    frames: &'a Frames,
    size: &'a mut Size<'b>,
    ratio: f64,
    bounds: &'a Bounds,
    wishes: &'a Wishes,
    bounds_areas: bool,
    kept: &'a [Ball],
    part: Part<'a>,
    insert: Insert,
    search: StarSearch,
    /// By input vertex, whether segments meet there at a small angle.
    acute: Vec<bool>,
    corners: [[f64; 3]; 2],
    floor: Floor,
    near: Refused,
    /// How many more points may come for a shape.
    budget: usize,
    what: What,
    tets: Budget,
    queue: BinaryHeap<Entry>,
    on_facets: Vec<OnFacet>,
    counts: RefineStatistics,
}

/// What is split.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum What {
    /// Walls alone.
    Walls,
    /// Tetrahedra, and walls above the bound on their area: a point on a facet may make triangles that are larger than those before.
    Tetrahedra,
}

/// Refines a mesh.
///
/// # Errors
/// `OutOfMemory`, `TooLarge`, `SteinerLimit`, `TetrahedraLimit`, what a size function returns, and what ends the run.
pub fn refine<'a>(
    model: &'a mut Model,
    goal: &'a mut Goal,
    what: What,
    part: Part<'a>,
) -> Result<Refined, Error> {
    let Model { mesh, points, segments, inside, frames } = model;
    let acute = segment::acute(points, segments, &part)?;
    let corners = bounding_box(points);
    let floor = Floor::new(mesh, points, segments, &part)?;
    let inputs = segments.first_steiner as usize;
    let mut refine = Refine {
        mesh,
        points,
        segments,
        inside,
        frames,
        size: goal.size,
        ratio: goal.ratio,
        bounds: goal.bounds,
        wishes: goal.wishes,
        bounds_areas: goal.wishes.bound_areas(),
        kept: goal.kept,
        part,
        insert: Insert::rounding(),
        search: StarSearch::default(),
        acute,
        corners,
        floor,
        near: Refused::default(),
        budget: LEAST_BUDGET + POINTS_A_POINT * inputs,
        what,
        tets: Budget::default(),
        queue: BinaryHeap::new(),
        on_facets: Vec::new(),
        counts: RefineStatistics::default(),
    };
    refine.run()?;
    part.progress(1.0)?;
    Ok(Refined { on_facets: refine.on_facets, counts: refine.counts })
}

impl Refine<'_, '_> {
    fn run(&mut self) -> Result<(), Error> {
        for t in self.mesh.all() {
            self.part.step()?;
            self.push(t)?;
        }
        while let Some((_, Reverse(code), since)) = self.queue.pop() {
            self.part.step()?;
            let t = code >> 2;
            if !self.mesh.is_live(t) || self.mesh.changed(t) != since {
                continue;
            }
            if let Some((_, code)) = self.large_wall(t) {
                let need = self.excess_of_wall(code)?.need();
                if !self.insert.is_wasting() && self.split(Target::Wall(code), need)? {
                    self.renew(t, since)?;
                    continue;
                }
                if self.excess(t)?.worst() <= 1.0 {
                    continue;
                }
            }
            let (target, need) = match self.what {
                What::Walls => (Target::Wall(code), self.excess_of_wall(code)?.need()),
                What::Tetrahedra => (Target::Centre(t), self.excess(t)?.need()),
            };
            // What is refused again and again will not get better.
            let over_budget = !need.large && self.budget == 0;
            self.counts.over_budget += u64::from(over_budget);
            if self.insert.is_wasting() || over_budget {
                continue;
            }
            let middle = need.middle.map(|least| (Target::Middle(t), Need { least, ..need }));
            let done = self.split(target, need)?
                || middle.map_or(Ok(false), |(target, need)| self.split(target, need))?;
            if done {
                self.budget -= usize::from(!need.large);
                self.renew(t, since)?;
            }
        }
        Ok(())
    }

    /// Takes note of what has come with a point that came for a tetrahedron.
    fn renew(&mut self, t: u32, since: u64) -> Result<(), Error> {
        for i in 0..self.insert.fresh().len() {
            self.push(self.insert.fresh()[i])?;
        }
        // The point may have come elsewhere.
        if self.mesh.changed(t) == since {
            self.push(t)?;
        }
        Ok(())
    }

    /// Takes note of a tetrahedron if it is to be split.
    fn push(&mut self, t: u32) -> Result<(), Error> {
        if self.mesh.region(t) == NONE || !self.mesh.is_live(t) {
            return Ok(());
        }
        if self.what == What::Tetrahedra {
            let mut excess = self.excess(t)?;
            excess.large = self.large_wall(t).map_or(excess.large, |wall| wall.0.max(excess.large));
            return self.note(excess, 4 * t);
        }
        for code in 4 * t..4 * t + 4 {
            if self.mesh.is_subface(code) {
                self.note(self.excess_of_wall(code)?, code)?;
            }
        }
        Ok(())
    }

    fn note(&mut self, excess: Excess, code: u32) -> Result<(), Error> {
        let worst = excess.worst();
        if worst > 1.0 {
            // Sizes first, then what is largest: if the budget ends, what is left is small.
            let is_large = excess.large > 1.0 || excess.volume > 1.0;
            let worst =
                if is_large { worst.min(LARGE_FIRST) * LARGE_FIRST } else { excess.thin * excess.shortest };
            let entry = (worst.min(1e300).to_bits(), Reverse(code), self.mesh.changed(code >> 2));
            fallible::push_heap(&mut self.queue, entry)?;
        }
        Ok(())
    }

    /// The wall of a tetrahedron that is farthest above its bound on area, and how many times the bound it is; walls alone are split for it in
    /// any case.
    fn large_wall(&self, t: u32) -> Option<(f64, u32)> {
        if !self.bounds_areas || self.what == What::Walls {
            return None;
        }
        let walls = (4 * t..4 * t + 4).filter(|&code| self.mesh.is_subface(code));
        let above = walls.map(|code| (self.area(code), code)).filter(|x| x.0 > 1.0);
        above.max_by(|x, y| x.0.total_cmp(&y.0))
    }

    /// How many times its bound on area a wall is.
    fn area(&self, code: u32) -> f64 {
        let corners = self.mesh.face(code).map(|v| self.points.xyz(v));
        self.wishes.of(self.mesh.subface(code)).excess(corners)
    }

    /// What is wrong with a wall: no tetrahedron at it is better.
    fn excess_of_wall(&self, code: u32) -> Result<Excess, Error> {
        let v = self.mesh.face(code);
        let at = v.map(|v| self.points.xyz(v));
        let wish = self.wishes.of(self.mesh.subface(code));
        let radius = facet::circumcircle(at).map_or(f64::INFINITY, |circle| circle.1);
        let middle = [0, 1, 2].map(|k| at.iter().map(|p| p[k]).sum::<f64>() / 3.0);
        let size =
            self.size.at(self.points, &middle, self.mesh.region(code >> 2), &v)?.length.min(wish.length);
        let volume = 0.0;
        let shortest = (0..3).map(|k| distance(at[k], at[(k + 1) % 3])).fold(f64::INFINITY, f64::min);
        Ok(Excess {
            large: over(radius, LARGE * size).max(self.area(code)),
            thin: over(radius, self.ratio * shortest),
            volume,
            size,
            shortest,
        })
    }

    /// What is wrong with a tetrahedron.
    fn excess(&self, t: u32) -> Result<Excess, Error> {
        let v = self.mesh.verts(t);
        let at = v.map(|v| self.points.xyz(v));
        let (_, radius) = circumcentre(at);
        let size = self.wanted(&middle(at), t)?;
        let volume = match self.bounds.is_empty() {
            true => 0.0,
            false => self.bounds.excess(self.mesh, self.points, t),
        };
        let mut shortest = f64::INFINITY;
        for (i, p) in at.iter().enumerate() {
            for q in &at[..i] {
                shortest = shortest.min(distance(p, q));
            }
        }
        Ok(Excess {
            large: over(radius, LARGE * size),
            thin: over(radius, self.ratio * shortest),
            volume,
            size,
            shortest,
        })
    }

    /// The length wanted at a place in a tetrahedron.
    fn wanted(&self, at: &[f64; 3], t: u32) -> Result<f64, Error> {
        Ok(self.size.at(self.points, at, self.mesh.region(t), &self.mesh.verts(t))?.length)
    }

    /// Puts a point at a place, or where it helps that.
    fn split(&mut self, first: Target, need: Need) -> Result<bool, Error> {
        // What was tried with regard to spheres, and is tried again without if its substitute fails.
        let mut waiting = [first; MOST_INSTEAD];
        let (mut count, mut turns, mut target, mut strict) = (0, 0, first, true);
        loop {
            match self.attempt(target, need, strict)? {
                Attempt::Done => return Ok(true),
                Attempt::First(other) if count < MOST_INSTEAD => {
                    waiting[count] = target;
                    count += 1;
                    (target, strict) = (other, true);
                }
                Attempt::Instead(other) if turns < MOST_INSTEAD => {
                    turns += 1;
                    (target, strict) = (other, true);
                }
                _ if count == 0 => return Ok(false),
                _ => {
                    count -= 1;
                    (target, strict) = (waiting[count], false);
                }
            }
        }
    }

    fn attempt(&mut self, target: Target, need: Need, strict: bool) -> Result<Attempt, Error> {
        let attempt = self.attempt_at(target, need, strict)?;
        match attempt {
            Attempt::Done => self.counts.came(need.large),
            Attempt::First(_) => self.counts.encroaching += 1,
            Attempt::Instead(_) => self.counts.blocked += 1,
            Attempt::TooNear => self.counts.too_near += 1,
            Attempt::Refused => self.counts.elsewhere += 1,
        }
        Ok(attempt)
    }

    fn attempt_at(&mut self, target: Target, need: Need, strict: bool) -> Result<Attempt, Error> {
        match target {
            Target::Centre(t) => {
                let (centre, radius) = circumcentre(self.mesh.verts(t).map(|v| self.points.xyz(v)));
                self.attempt_inside(t, radius.is_finite().then_some(centre), need, strict)
            }
            Target::Middle(t) => {
                let middle = middle(self.mesh.verts(t).map(|v| self.points.xyz(v)));
                self.attempt_inside(t, Some(middle), need, false)
            }
            Target::Wall(code) => self.attempt_on_wall(code, need, strict),
            Target::Edge(edge) => self.attempt_on_edge(edge, need),
        }
    }

    /// Tries a place inside for a tetrahedron.
    fn attempt_inside(
        &mut self,
        t: u32,
        centre: Option<[f64; 3]>,
        need: Need,
        strict: bool,
    ) -> Result<Attempt, Error> {
        let verts = self.mesh.verts(t);
        let Some(centre) = centre else { return Ok(Attempt::Refused) };
        // A far circumcentre would make all later signs slow; walls are in its way in any case.
        let [low, high] = &self.corners;
        let at = [0, 1, 2].map(|k| centre[k].max(low[k]).min(high[k]));
        let Some(at) = snapped(at, distance(&at, self.points.xyz(verts[0]))) else {
            return Ok(Attempt::Refused);
        };
        let p = self.points.push(at)?;
        let attempt = match self.locate(p, t) {
            Found::In(start) => self.insert_inside(p, start, need, strict)?,
            Found::Before(wall) => Attempt::Instead(Target::Wall(wall)),
            _ => Attempt::Refused,
        };
        if !matches!(attempt, Attempt::Done) {
            self.points.pop();
        }
        Ok(attempt)
    }

    fn insert_inside(&mut self, p: u32, start: u32, need: Need, strict: bool) -> Result<Attempt, Error> {
        let at = *self.points.xyz(p);
        let around = self.mesh.verts(start);
        let wanted = self.size.at(self.points, &at, self.mesh.region(start), &around)?;
        let floor = self.floor.at(self.points, &at, around.into_iter());
        let need = need.above(floor);
        let Refine { mesh, points, insert, .. } = self;
        let mut attempt = Attempt::TooNear;
        let accept = |opening: Opening| {
            let encroached = if strict { encroached(&opening, &at, true) } else { None };
            match encroached {
                Some(target) => attempt = Attempt::First(target),
                None if nearest(&opening, &at) < need.least => {}
                None => return Ok(true),
            }
            Ok(false)
        };
        match insert.interior_after(mesh, points, p, start, &self.part, accept)? {
            Some(Outcome::Inserted | Outcome::Squeezed(_)) => {}
            Some(Outcome::Blocked(edge)) => return Ok(Attempt::Instead(Target::Edge(edge))),
            Some(_) => return Ok(Attempt::Refused),
            None => return Ok(attempt),
        }
        fallible::push(&mut self.inside.list, p)?;
        self.counts.inside += 1;
        self.size.set(p, wanted)?;
        self.floor.set(p, floor)?;
        self.count()?;
        Ok(Attempt::Done)
    }

    /// Takes account of a new point.
    fn count(&mut self) -> Result<(), Error> {
        let count = self.points.len() as u64 - u64::from(self.segments.first_steiner);
        self.part.steiner(count, usize::MAX / 200)?;
        self.tets.check(self.mesh, &self.part)
    }

    /// Walks to a vertex that is not in the mesh, through faces that have it on their other side.
    fn locate(&self, p: u32, start: u32) -> Found {
        let (mut t, mut from) = (start, NONE);
        for step in 0..MOST_STEPS {
            let (mut next, mut wall, mut on) = (None, None, 0u8);
            for k in 0..4 {
                let code = 4 * t + ((k + step as u32) & 3);
                let across = self.mesh.across(code);
                if across >> 2 == from {
                    continue;
                }
                let [x, y, z] = self.mesh.face(code);
                match self.points.orient3d(p, x, y, z) {
                    Sign::Positive => {}
                    Sign::Zero if !self.mesh.is_wall(code) => on |= 1 << (code & 3),
                    _ if self.mesh.is_wall(code) => wall = Some(code),
                    _ => {
                        next = Some(across >> 2);
                        break;
                    }
                }
            }
            match (next, wall) {
                (Some(n), _) => (from, t) = (t, n),
                (None, Some(wall)) => return Found::Before(wall),
                (None, None) => return self.inside_or_on(t, on),
            }
        }
        Found::Nowhere
    }

    /// Where a vertex is that lies in a tetrahedron or in the planes of these of its faces, which are no walls: their edge may be on one.
    fn inside_or_on(&self, t: u32, faces: u8) -> Found {
        let off = |&k: &u32| faces >> k & 1 == 0;
        match faces.count_ones() {
            0 | 1 => return Found::In(t),
            2 => {}
            _ => return Found::Nowhere,
        }
        let mut ends = (0..4).filter(off).map(|k| self.mesh.vertex(t, k));
        let (Some(a), Some(b)) = (ends.next(), ends.next()) else { return Found::Nowhere };
        if self.mesh.is_subsegment(t, [a, b]) {
            return Found::Nowhere;
        }
        let mut ring = EdgeRing::new(self.mesh, t, a, b).map(|(t, _, _, k, _)| 4 * t + k);
        match ring.find(|&code| self.mesh.is_wall(code)) {
            Some(code) if self.mesh.is_ghost(code >> 2) => Found::Before(self.mesh.across(code)),
            Some(code) => Found::Before(code),
            None => Found::In(t),
        }
    }

    /// How near to a new point on the surface that comes for a shape other vertices may be. As long as walls alone are split, those are on other
    /// features, at whatever distance these are.
    fn least_from_others(&self, need: Need, floor: f64) -> f64 {
        match self.what {
            What::Walls => floor,
            What::Tetrahedra => need.least.max(floor),
        }
    }

    /// Whether the surface stays as it is at a place.
    fn is_kept(&self, at: &[f64; 3]) -> bool {
        self.kept.iter().any(|ball| distance(&ball.centre, at) < ball.radius)
    }
}

/// Where a walk ended.
enum Found {
    /// In this tetrahedron, on none of its walls.
    In(u32),
    /// On or before this wall.
    Before(u32),
    /// The walk was too long.
    Nowhere,
}

/// What is wrong with a tetrahedron: above 1 is too much.
#[derive(Clone, Copy)]
struct Excess {
    large: f64,
    thin: f64,
    /// Its volume over the bound.
    volume: f64,
    /// The length wanted there.
    size: f64,
    shortest: f64,
}

impl Excess {
    fn worst(&self) -> f64 {
        self.large.max(self.thin).max(self.volume)
    }

    /// What a point must have that comes for it.
    fn need(&self) -> Need {
        let large = self.large > 1.0 || self.volume > 1.0;
        let of = |share: f64| if large { share * self.size } else { SHORTEN * self.shortest };
        Need {
            large,
            least: of(if self.large > 1.0 { APART } else { APART_FOR_VOLUME }),
            on_wall: of(APART_ON_WALL),
            on_segment: of(APART_ON_SEGMENT),
            middle: match (self.volume > 1.0, self.large > FAR_TOO_LARGE) {
                (true, _) => Some(APART_IN_MIDDLE * self.size),
                (_, true) => Some(APART_FOR_VOLUME * self.size),
                _ => None,
            },
        }
    }
}

/// How many times a length another one is.
fn over(length: f64, other: f64) -> f64 {
    quotient(length, other).unwrap_or(f64::INFINITY)
}

/// The mean of four places.
fn middle(at: [&[f64; 3]; 4]) -> [f64; 3] {
    [0, 1, 2].map(|k| at.iter().map(|p| p[k]).sum::<f64>() / 4.0)
}

/// The distance of a place from the nearest vertex of its cavity.
fn nearest(opening: &Opening, at: &[f64; 3]) -> f64 {
    let corners = opening.faces.iter().flat_map(|face| face.corners);
    corners.map(|v| distance(opening.points.xyz(v), at)).fold(f64::INFINITY, f64::min)
}

/// The subsegment, or with `walls` the wall, of a cavity in whose smallest sphere a place is, the one that it is deepest in.
fn encroached(opening: &Opening, at: &[f64; 3], walls: bool) -> Option<Target> {
    let mut deepest = (0.0, None);
    for [a, b] in opening.subsegments() {
        let [u, v] = [a, b].map(|w| sub(opening.points.xyz(w), at));
        let w = sub(&u, &v);
        let depth = quotient(dot(&u, &v), dot(&w, &w)).unwrap_or(0.0);
        if depth < deepest.0 {
            deepest = (depth, Some(Target::Edge([a, b])));
        }
    }
    if deepest.1.is_none() && walls {
        for (code, corners) in opening.walls() {
            let Some((centre, radius)) = facet::circumcircle(corners.map(|v| opening.points.xyz(v))) else {
                continue;
            };
            let depth = over(distance(&centre, at), radius) - 1.0;
            if depth < deepest.0 {
                deepest = (depth, Some(Target::Wall(code)));
            }
        }
    }
    deepest.1
}
