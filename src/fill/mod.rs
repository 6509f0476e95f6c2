//! Filling a mesh whose surface is kept with points inside, graded by size.
//!
//! First the *apex layer* ([`layer`]): over each wall, in breadth-first order over the surface, the apex of its best tetrahedron. Neighbouring
//! walls want apexes too near to each other; in this order every other wall gets one, as in a packing of spheres. Then tetrahedra that are too
//! large for their size, or whose circumradius is too large for their shortest edge, get their circumcentre, the worst first (Ruppert 1995;
//! Shewchuk 1998). Where a wall is in the way, the apex over that wall takes its place. Bounds on volumes come last ([`volumes`]).
//!
//! A point counts only if it is far enough from every vertex of its cavity (a share of the size there) and makes no flat tetrahedron
//! at a wall. It is inserted by the constrained insertion ([`ops::insert`](crate::ops::insert)), which crosses no wall.
//!
//! Why it ends: points keep a distance that has a lower bound, since sizes do; a tetrahedron whose candidates are refused is not looked at
//! again. Sizes that ask for more points than a mesh can have are refused first.
//!
//! Invariants: walls, input points and regions stay; all points are doubles; every tetrahedron is positive by exact signs. Which point is
//! tried is floating-point.
mod blocked;
mod blocks;
mod layer;
mod near;
pub(crate) mod place;
mod volumes;

use crate::blocks::{Crew, Model};
use crate::control::{Control, Part};
use crate::elementary::quotient;
use crate::error::{Error, Status};
use crate::fallible;
use crate::kernel::block::Seams;
use crate::kernel::budget::Budget;
use crate::kernel::{Mesh, NONE};
use crate::ops::apex::apex;
use crate::ops::insert::{Face, Insert, Outcome};
use crate::ops::shape::sine;
use crate::options::Options;
use crate::output::RefineStatistics;
use crate::predicates::Points;
use crate::preserve::inside::Inside;
use crate::size::{distance, volume, Bounds, Size, Wanted};
use blocked::Blocked;
use near::Near;
use place::{circumcentre, needle_free, snapped, Found};
use std::cmp::Reverse;
use std::collections::BinaryHeap;

// Measured on the eight clean models of `quality_figures.py`, optimised: 319,000 tetrahedra, the median smallest angle 19.5°, 1.4 % below 30°.

/// Circumradius over size above which a tetrahedron is too large: points have about this distance. With 0.8 there are 403,000 tetrahedra and
/// half as many below 30°.
pub const LARGE: f64 = 0.95;
/// Least distance of a new point over the size: where one comes for the size, and where for the shape. With 0.6 for the size there are 365,000
/// tetrahedra, 0.6 % below 30°; with 0.8 they are 290,000, and 2.1 %. For the shape 0.4 and 0.6 change 40 tetrahedra.
const APART: f64 = 0.7;
const APART_FOR_SHAPE: f64 = 0.5;
/// Sine of the least angle that a new tetrahedron at a wall must have, unless it is better than the old one. Half of it
/// and one and a half of it change 2 % of the tetrahedra, and angles by half a degree.
const AT_WALL: f64 = 0.3;
/// What is more than so many times too large is split before points come over the walls: with nothing far inside, their cavities reach across. (A
/// sphere filled with 914,000 tetrahedra of one size takes 43 s without, 7 s with it.) These points are far from walls. What is near to a vertex is
/// refused by hash grids: a cavity may be a tenth of the mesh. (In a sphere to have 2.9 million, 1,700 refused places took 31 s of 93 s.)
const SPARSE: f64 = 8.0;
/// The most points of a mesh, by its tables of 2^30 tetrahedra.
pub const MOST_POINTS: f64 = 1.5e8;

/// A tetrahedron to be split: the bits of how bad it is, its slot (the lowest first), and after which change it came.
type Entry = (u64, Reverse<u32>, u64);

/// Fills a mesh.
pub struct Fill<'a, 'b> {
    mesh: &'a mut Mesh,
    points: &'a mut Points,
    inside: &'a mut Inside,
    size: &'a mut Size<'b>,
    /// Circumradius over shortest edge that is good enough.
    ratio: f64,
    part: Part<'a>,
    insert: Insert,
    /// The corners of a box round the mesh.
    corners: [[f64; 3]; 2],
    queue: BinaryHeap<Entry>,
    /// A vertex that is not in the mesh: the next point.
    next: Option<u32>,
    /// Where a subsegment blocks vertices.
    blocked: Blocked,
    budget: Budget,
    /// Only sizes count, and what is near to one of these is refused without a look at its cavity.
    sparse: Option<Near>,
    /// Where the mesh is cut off from the rest of a larger one.
    seams: Option<Seams<'a>>,
    /// By vertex, whether a seam was in the way of a point for a tetrahedron that has it.
    open: Vec<bool>,
    counts: RefineStatistics,
}

/// What is asked for besides sizes.
#[derive(Clone, Copy, Debug)]
pub struct Shape {
    /// Circumradius over shortest edge that is good enough.
    pub ratio: f64,
    /// The mesh is constrained Delaunay and stays so.
    pub delaunay: bool,
}

/// Fills a mesh with points inside.
///
/// # Errors
/// `OutOfMemory`, `TooLarge`, `SteinerLimit`, `TetrahedraLimit`, and what ends the run.
pub fn fill(model: Model, size: &mut Size, shape: Shape, crew: Crew) -> Result<RefineStatistics, Error> {
    let Model { mesh, points, inside } = model;
    let part = crew.part;
    let mut fill = Fill::new(mesh, points, inside, size, part).shaped(shape);
    fill.sparse = Some(Near::default());
    fill.push_all(|_| true)?;
    if fill.queue.peek().is_some_and(|entry| entry.0 > SPARSE.to_bits()) {
        fill.sparse = Some(Near::of(fill.points, fill.size, &part)?);
        fill.run(SPARSE)?;
    }
    fill.sparse = None;
    fill.queue.clear();
    fill.layer()?;
    part.progress(0.3)?;
    fill.push_all(|_| true)?;
    fill.run(blocks::COARSE)?;
    if blocks::serve(fill.queue.len()) {
        fill.give_back();
        let crew = Crew { part: part.part(0.3, 0.9), ..crew };
        let mut counts = fill.counts;
        let open = blocks::fill(Model { mesh, points, inside }, size, shape, crew, &mut counts)?;
        fill = Fill::new(mesh, points, inside, size, part).shaped(shape);
        fill.counts = counts;
        fill.push_all(|v| open.get(v as usize) == Some(&true))?;
    }
    fill.run(1.0)?;
    fill.give_back();
    part.progress(1.0)?;
    Ok(fill.counts)
}

/// Refuses sizes that ask for more points than a mesh can have, before it has filled the memory.
///
/// # Errors
/// `TooLarge`, what a size function returns, and what ends the run.
pub fn estimate(mesh: &Mesh, points: &Points, size: &Size, control: &Control) -> Result<(), Error> {
    let mut sum = 0.0;
    for t in mesh.all().filter(|&t| mesh.is_live(t) && mesh.region(t) != NONE) {
        control.step()?;
        let at = mesh.verts(t).map(|v| points.xyz(v));
        let middle = [0, 1, 2].map(|k| at.iter().map(|p| p[k]).sum::<f64>() / 4.0);
        let size = size.at(points, &middle, mesh.region(t), &mesh.verts(t))?.length;
        // Regular tetrahedra have √2/12 of the cube of their edge, and six of them come with a point.
        let over = |x: Option<f64>| x.and_then(|x| quotient(x, size));
        let count = over(over(over(Some(volume(at) * 2f64.sqrt())))).unwrap_or(f64::MAX);
        sum = if count < MOST_POINTS { sum + count } else { count };
        if sum >= MOST_POINTS {
            return Err(too_many(sum));
        }
    }
    Ok(())
}

/// What is said of so many points.
pub fn too_many(count: f64) -> Error {
    Error::new(
        Status::TooLarge,
        format_args!(
            "the sizes ask for more than {count:.1e} points, a mesh can have {MOST_POINTS:.1e}: choose larger sizes"
        ),
    )
}

/// Splits what is above its bound on volume, unless the surface is too coarse for it.
///
/// # Errors
/// As [`fill`].
pub fn bound_volumes<'a>(
    mesh: &'a mut Mesh,
    points: &'a mut Points,
    inside: &'a mut Inside,
    size: &'a mut Size,
    bounds: &Bounds,
    part: Part<'a>,
) -> Result<RefineStatistics, Error> {
    let mut fill = Fill::new(mesh, points, inside, size, part);
    fill.bound_volumes(bounds)?;
    fill.give_back();
    part.progress(1.0)?;
    Ok(fill.counts)
}

impl<'a, 'b> Fill<'a, 'b> {
    fn new(
        mesh: &'a mut Mesh,
        points: &'a mut Points,
        inside: &'a mut Inside,
        size: &'a mut Size<'b>,
        part: Part<'a>,
    ) -> Fill<'a, 'b> {
        let (insert, queue) = (Insert::squeezing(), BinaryHeap::new());
        let corners = bounding_box(points);
        let (blocked, budget) = (Blocked::default(), Budget::default());
        let (next, sparse, seams, open) = (None, None, None, Vec::new());
        let counts = RefineStatistics::default();
        Fill {
            mesh,
            points,
            inside,
            size,
            ratio: Options::USUAL_RATIO,
            part,
            insert,
            corners,
            queue,
            next,
            blocked,
            budget,
            sparse,
            seams,
            open,
            counts,
        }
    }
}

impl Fill<'_, '_> {
    fn shaped(mut self, shape: Shape) -> Self {
        self.ratio = shape.ratio;
        self.insert.squeeze = !shape.delaunay;
        self.insert.rounded = shape.delaunay;
        self
    }

    /// Takes note of all tetrahedra that are to be split and have a vertex that counts.
    fn push_all(&mut self, counts: impl Fn(u32) -> bool) -> Result<(), Error> {
        for t in self.mesh.all() {
            self.part.step()?;
            if self.mesh.region(t) != NONE && self.mesh.verts(t).into_iter().any(&counts) {
                self.push(t)?;
            }
        }
        Ok(())
    }

    /// Splits tetrahedra, the worst first, until what is left is so little too large or too thin.
    fn run(&mut self, enough: f64) -> Result<(), Error> {
        while self.queue.peek().is_some_and(|entry| entry.0 > enough.to_bits()) {
            let Some((_, Reverse(t), since)) = self.queue.pop() else { break };
            self.part.step()?;
            if self.is_wasting() {
                break;
            }
            if !self.mesh.is_live(t) || self.mesh.changed(t) != since {
                continue;
            }
            match self.split(t)? {
                Attempt::Done => {
                    for i in 0..self.insert.fresh().len() {
                        self.push(self.insert.fresh()[i])?;
                    }
                }
                Attempt::Cut => {
                    let count = self.points.len();
                    fallible::resize(&mut self.open, count, false)?;
                    self.mesh.verts(t).into_iter().for_each(|v| self.open[v as usize] = true);
                }
                Attempt::Blocked(_) | Attempt::Refused(_) => {}
            }
        }
        Ok(())
    }

    /// Whether most work is for vertices that are refused, where the mesh stays Delaunay: others will have to split what is in the way.
    fn is_wasting(&self) -> bool {
        !self.insert.squeeze && self.insert.is_wasting()
    }

    /// Takes note of a tetrahedron if it is to be split.
    fn push(&mut self, t: u32) -> Result<(), Error> {
        if self.mesh.region(t) == NONE || !self.mesh.is_live(t) {
            return Ok(());
        }
        let (large, thin) = self.excess(t)?;
        let worst = if self.sparse.is_some() { large } else { large.max(thin) };
        if worst > 1.0 {
            let entry = (worst.min(1e300).to_bits(), Reverse(t), self.mesh.changed(t));
            fallible::push_heap(&mut self.queue, entry)?;
        }
        Ok(())
    }

    /// How much too large a tetrahedron is, and how much its circumradius for its shortest edge: above 1 is too much.
    fn excess(&self, t: u32) -> Result<(f64, f64), Error> {
        let v = self.mesh.verts(t);
        let at = v.map(|v| self.points.xyz(v));
        let (_, radius) = circumcentre(at);
        let h = self.wanted_in(t)?.length;
        let mut shortest = f64::INFINITY;
        for (i, p) in at.iter().enumerate() {
            for q in &at[..i] {
                shortest = shortest.min(distance(p, q));
            }
        }
        let over = |length: f64| quotient(radius, length).unwrap_or(f64::INFINITY);
        Ok((over(LARGE * h), over(self.ratio * shortest)))
    }

    /// Puts a point into a tetrahedron that is to be split, or near it.
    fn split(&mut self, t: u32) -> Result<Attempt, Error> {
        let (large, _) = self.excess(t)?;
        let for_size = large > 1.0;
        let apart = if for_size { APART } else { APART_FOR_SHAPE };
        let limits = Limits { apart, at_walls: true, for_size };
        if let Some(centre) = self.circumcentre(t) {
            let mut attempt = self.attempt(centre, t, limits)?;
            if let Attempt::Blocked(wall) = attempt {
                if let Some(apex) = apex(self.points, self.mesh.face(wall)) {
                    attempt = self.attempt(apex, wall >> 2, limits)?;
                }
            }
            if let Attempt::Done | Attempt::Cut = attempt {
                return Ok(attempt);
            }
        }
        if large > 1.5 {
            let middle = self.centroid(t);
            return self.attempt(middle, t, limits);
        }
        Ok(Attempt::Refused(Why::Nowhere))
    }

    /// The length wanted in the middle of a tetrahedron.
    fn wanted_in(&self, t: u32) -> Result<Wanted, Error> {
        self.size.at(self.points, &self.centroid(t), self.mesh.region(t), &self.mesh.verts(t))
    }

    fn centroid(&self, t: u32) -> [f64; 3] {
        let at = self.mesh.verts(t).map(|v| self.points.xyz(v));
        [0, 1, 2].map(|k| at.iter().map(|p| p[k]).sum::<f64>() / 4.0)
    }

    /// `None` if the tetrahedron is flat in plain arithmetic.
    fn circumcentre(&self, t: u32) -> Option<[f64; 3]> {
        let (centre, radius) = circumcentre(self.mesh.verts(t).map(|v| self.points.xyz(v)));
        radius.is_finite().then_some(centre)
    }

    /// Tries a place, and counts what comes of it.
    fn attempt(&mut self, at: [f64; 3], from: u32, limits: Limits) -> Result<Attempt, Error> {
        let attempt = self.attempt_at(at, from, limits)?;
        match attempt {
            Attempt::Done => {
                self.counts.inside += 1;
                self.counts.came(limits.for_size);
            }
            Attempt::Blocked(_) => self.counts.blocked += 1,
            Attempt::Refused(Why::TooNear) => self.counts.too_near += 1,
            Attempt::Refused(Why::TooFlat) => self.counts.too_flat += 1,
            Attempt::Refused(Why::Blocked) => self.counts.blocked += 1,
            Attempt::Refused(Why::Nowhere) => self.counts.elsewhere += 1,
            // It is tried again without the seam.
            Attempt::Cut => {}
        }
        Ok(attempt)
    }

    /// Inserts a point if it is somewhere before a wall, far enough from others, and good at walls.
    fn attempt_at(&mut self, at: [f64; 3], from: u32, limits: Limits) -> Result<Attempt, Error> {
        // A far circumcentre would make all later signs slow; walls are in its way in any case.
        let [low, high] = &self.corners;
        let at = [0, 1, 2].map(|k| at[k].max(low[k]).min(high[k]));
        let Some(at) = snapped(at, distance(&at, self.points.xyz(self.mesh.vertex(from, 0)))) else {
            return Ok(Attempt::Refused(Why::Nowhere));
        };
        let p = self.take(at)?;
        let t = match place::locate(self.mesh, self.points, p, from) {
            Found::In(t) => t,
            Found::Blocked(wall) if self.is_seam(wall) => return Ok(Attempt::Cut),
            Found::Blocked(wall) => return Ok(Attempt::Blocked(wall)),
            Found::Nowhere => return Ok(Attempt::Refused(Why::Nowhere)),
        };
        // These four are of its cavity, whatever that is: most candidates that are too near to something fail here.
        let corners = self.mesh.verts(t);
        let wanted = self.size.at(self.points, &at, self.mesh.region(t), &corners)?;
        let least = limits.apart * wanted.length;
        let near = corners.into_iter().any(|v| distance(self.points.xyz(v), &at) < least);
        if near {
            return Ok(Attempt::Refused(Why::TooNear));
        }
        if self.sparse.as_ref().is_some_and(|sparse| sparse.any(&at, least, wanted.length)) {
            return Ok(Attempt::Refused(Why::TooNear));
        }
        if self.blocked.has(&at, wanted.length) {
            return Ok(Attempt::Refused(Why::Blocked));
        }
        let (mut why, mut cut, seams) = (Why::TooNear, false, self.seams);
        let accept = |mesh: &Mesh, points: &mut Points, _: &[u32], faces: &[Face]| {
            if let Some(seams) = seams {
                cut = faces.iter().any(|face| corner(mesh, face).is_some_and(|code| seams.has(mesh, code)));
                if cut {
                    return Ok(false);
                }
            }
            let far = |&v: &u32| distance(points.xyz(v), &at) >= least;
            if !faces.iter().flat_map(|face| &face.corners).all(far) {
                return Ok(false);
            }
            why = Why::TooFlat;
            Ok(!limits.at_walls || faces.iter().all(|face| fits(mesh, points, &at, face)))
        };
        let Fill { mesh, points, insert, .. } = self;
        match insert.interior_if(mesh, points, p, t, &self.part, accept)? {
            Some(Outcome::Inserted | Outcome::Squeezed(_)) => {}
            Some(Outcome::Blocked(_)) => {
                self.blocked.add(&at, wanted.length)?;
                return Ok(Attempt::Refused(Why::Blocked));
            }
            Some(Outcome::Occupied(_)) => return Ok(Attempt::Refused(Why::TooNear)),
            None if cut => return Ok(Attempt::Cut),
            None => return Ok(Attempt::Refused(why)),
        }
        self.next = None;
        if let Some(sparse) = &mut self.sparse {
            sparse.add(at, wanted.length)?;
        }
        self.size.set(p, wanted)?;
        self.part.steiner(self.inside.total(), usize::MAX / 200)?;
        self.budget.check(self.mesh, &self.part)?;
        Ok(Attempt::Done)
    }

    /// Whether a face, given by its corner, is where the mesh is cut off.
    fn is_seam(&self, code: u32) -> bool {
        self.seams.is_some_and(|seams| seams.has(self.mesh, code))
    }

    /// The vertex for the next point, there.
    fn take(&mut self, at: [f64; 3]) -> Result<u32, Error> {
        match self.next {
            Some(p) => {
                self.points.move_to(p, at)?;
                Ok(p)
            }
            None => {
                let p = self.inside.add(self.mesh, self.points, at)?;
                self.next = Some(p);
                Ok(p)
            }
        }
    }

    /// Gives back the vertex that no point has got.
    fn give_back(&mut self) {
        if self.next.take().is_some() {
            let count = self.inside.list.len();
            self.inside.shorten(count - 1);
        }
    }
}

/// The lowest and the highest coordinates.
pub fn bounding_box(points: &Points) -> [[f64; 3]; 2] {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for p in points.coordinates() {
        for k in 0..3 {
            low[k] = low[k].min(p[k]);
            high[k] = high[k].max(p[k]);
        }
    }
    [low, high]
}

/// The corner opposite a face of a cavity.
fn corner(mesh: &Mesh, face: &Face) -> Option<u32> {
    let t = face.tet;
    (4 * t..4 * t + 4).find(|&code| !face.corners.contains(&mesh.apex(code)))
}

/// Whether a new tetrahedron is good enough if it is at a wall.
fn fits(mesh: &Mesh, points: &Points, at: &[f64; 3], face: &Face) -> bool {
    let t = face.tet;
    let Some(code) = corner(mesh, face) else { return true };
    if !mesh.is_wall(code) {
        return true;
    }
    let [x, y, z] = face.corners.map(|v| points.xyz(v));
    let new = sine([at, x, y, z]);
    // A needle on the surface bounds what any apex reaches.
    new >= AT_WALL * needle_free([x, y, z]) || new > sine(mesh.verts(t).map(|v| points.xyz(v)))
}

/// What a candidate must have.
#[derive(Clone, Copy)]
struct Limits {
    /// Its least distance from others over the size there.
    apart: f64,
    /// Whether the tetrahedra at walls must be good.
    at_walls: bool,
    /// Whether it comes for a size, not for a shape.
    for_size: bool,
}

/// What became of a candidate.
enum Attempt {
    /// It is in the mesh.
    Done,
    /// This wall (the corner on the side of the start) is before it.
    Blocked(u32),
    /// It is not good.
    Refused(Why),
    /// A seam is in the way: what is behind that must be there.
    Cut,
}

/// Why a candidate is not good.
#[derive(Clone, Copy)]
enum Why {
    TooNear,
    TooFlat,
    /// A subsegment is in the way.
    Blocked,
    /// There is no place for it.
    Nowhere,
}

#[cfg(test)]
pub(crate) mod tests;
