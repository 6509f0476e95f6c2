//! Optimisation of a mesh: the worst tetrahedra get better, by their smallest dihedral angle.
//!
//! Hill climbing (Freitag & Ollivier-Gooch 1997; Klingner & Shewchuk 2007), the worst first, by smoothing ([`descend`]), removal of edges and
//! of faces, reconnection of small cavities ([`reshape`](crate::ops::reshape)), points that come with their cavity and points that go
//! ([`point`]). A step counts only if the worst of what it touches gets strictly better, so no mesh gets worse, and a pass ends. Passes go on
//! while they gain something. What comes is above the bound on volume only if what goes is larger.
//!
//! Invariants: walls, input points, edges on no facet and regions stay; every tetrahedron is positive by exact signs. Where the surface may be
//! refined, points that were added on it slide on it ([`slide`]). A large mesh is optimised in blocks ([`blocks`]).
mod aim;
mod blocks;
pub mod descend;
mod point;
pub mod slide;

use crate::blocks::Crew;
use crate::control::Part;
use crate::elementary::{angle_in_degrees, quotient};
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::budget::Budget;
use crate::kernel::{Mesh, GHOST, NONE};
use crate::ops::faces::{Faces, Site};
use crate::ops::reshape::{Aim, Effort, Reshape};
use crate::ops::shape::{sine, Measure, Shape};
use crate::output::OptimizeStatistics;
use crate::predicates::Points;
use crate::preserve::inside::Inside;
use crate::size::{volume, Bounds};
use aim::{aim, Aims};
use descend::Descend;
use point::Coming;
use rustc_hash::FxHashSet;
use slide::Slides;
use std::cmp::Reverse;
use std::collections::BinaryHeap;
use std::time::{Duration, Instant};

// Measured on the clean models of `quality_figures.py` (319,000 tetrahedra, 1.4 % below 30°), and on CAD parts with needles (1,582 tetrahedra
// below 10° that the surface does not force).

/// Sines below and above which something is done, and how much may be.
#[derive(Clone, Copy, Debug)]
struct Level {
    /// Tetrahedra below this are reconnected, and get larger cavities below the second.
    bad: f64,
    awful: f64,
    /// Below this points come and go.
    poor: f64,
    /// Stars whose worst is above this are not smoothed.
    good: f64,
    /// How many more failures with large cavities are allowed than a [`Trial`] tells.
    patience: usize,
    /// How many points may come: [`LEAST_BUDGET`], and for each unit of effort one per so many tetrahedra.
    tets_a_point: usize,
}

/// By effort; those above the last have more passes.
const LEVELS: [Level; 3] = [
    // The angles are about 28°, 17°, 20° and 45°. With 0.35 for the first, 14 % are below 30°; 0.6 leaves 1.1 %, and takes half as long again.
    // With 0.2 for the second the worst angle is 1.7° less, 0.4 changes next to nothing. With 0.2 for the third the worst angle is 1.1° less; 0.47
    // leaves 1.2 % below 30° for 0.6 % more tetrahedra. 0.6 for the last changes a few tetrahedra in 10,000. Only needles use up the
    // points: three times as many make 6 % more tetrahedra on CAD parts, and 14 % more below 10°.
    Level { bad: 0.47, awful: 0.3, poor: 0.34, good: 0.7, patience: 1, tets_a_point: 300 },
    // On sofa_pelvis, of_flange, regions_tinyBoxt and spot, surfaces kept: smallest angles that nothing forces of 25°, 24°, 31° and 30° (20°, 20°,
    // 28° and 28° above) in three times the time.
    Level { bad: 0.65, awful: 0.5, poor: 0.55, good: 0.8, patience: 10, tets_a_point: 20 },
    // 30°, 27°, 31° and 33°, in six times the time.
    Level { bad: 0.75, awful: 0.6, poor: 0.6, good: 0.85, patience: 20, tets_a_point: 20 },
];
/// The points that may come in any case.
const LEAST_BUDGET: usize = 20;
/// Passes a unit of effort, after the first. Two more gain 0.03 % of the tetrahedra below 30° on the clean models of `quality_figures.py`, and
/// take an eighth longer.
const PASSES: usize = 2;
/// A pass gains enough if what is missing falls by more than this share. Five times as much changes a tetrahedron in 4,000.
const WORTH: f64 = 0.01;

/// A vertex of a bad tetrahedron that moves is progress for it if its sine grows by this share and this much: without a bound it would come
/// again and again for almost nothing (boeing_part: 92 s without, 10 s with it, as good a mesh). A quarter of the second takes 5 % longer, for
/// the same angles.
const GAIN: f64 = 0.02;
const LEAST_GAIN: f64 = 0.002;

const EDGES: Effort = Effort { cavities: &[], thorough: false };

/// What is tried in a pass.
struct Trial {
    /// Its place among the others: what has failed is not tried again with less.
    level: u8,
    /// For the worst, until it has failed this often, plus once per this many tetrahedra of the mesh.
    effort: Effort,
    failures: [usize; 2],
    /// Whether points come and go.
    points: bool,
}

const FIRST: Trial = Trial { level: 1, effort: EDGES, failures: [0, 1], points: false };
const LATER: Trial = Trial {
    level: 2,
    effort: Effort { cavities: &[(9, 30), (12, 100)], thorough: false },
    failures: [500, 50],
    points: true,
};
const LAST: Trial = Trial {
    level: 3,
    effort: Effort { cavities: &[(12, 300), (16, 800)], thorough: true },
    failures: [100, 500],
    points: true,
};

/// No measure but the angle counts.
const ANY: Shape = Shape { angle: 0.0, ratio: 0.0, dihedral: 0.0, volume: 0.0 };

/// A tetrahedron to improve: the bits of its sine, and its slot.
type Entry = Reverse<(u64, u32)>;

/// When to end.
#[derive(Clone, Copy, Debug)]
pub enum Extent {
    /// With as many passes and points as this effort allows.
    Effort(u32),
    /// As with the largest effort, but after so many seconds at the latest: then the mesh is as good as it got, which depends on the machine.
    Seconds(f64),
}

/// What is asked for.
#[derive(Clone, Copy, Debug)]
pub struct Request {
    /// When to end.
    pub extent: Extent,
    /// Then, what is below this sine is improved; as long as something is below it, larger efforts are tried from the start.
    pub sine: f64,
}

/// Larger efforts do the same. Passes end before when they gain too little.
const LARGEST_EFFORT: u32 = 100;

/// Optimises a mesh.
struct Optimise<'a> {
    mesh: &'a mut Mesh,
    points: &'a mut Points,
    inside: &'a mut Inside,
    isolated: &'a FxHashSet<[u32; 2]>,
    /// The vertices of the surface that may slide.
    slides: Option<&'a mut Slides>,
    bounds: &'a Bounds,
    level: Level,
    part: Part<'a>,
    start: Instant,
    /// How long it may take.
    time: Option<Duration>,
    /// By vertex, whether it may move.
    movable: Vec<bool>,
    /// By vertex, after which change of its surroundings it could not be moved.
    stuck: Vec<u64>,
    /// Positions change what the mesh does not know of.
    clock: u64,
    /// By vertex, when it last moved or a tetrahedron at it changed.
    moved: Vec<u64>,
    /// By slot, when it could last not be improved, and by which effort.
    failed: Vec<(u64, u8)>,
    queue: BinaryHeap<Entry>,
    descend: Descend,
    search: StarSearch,
    link: Vec<[u32; 3]>,
    /// The vertices that one may go into.
    into: Vec<u32>,
    faces: Faces,
    coming: Coming,
    /// How many more points may come.
    budget: usize,
    tets: Budget,
    most: Most,
    /// What is settled already, in another block; `None` if nothing is.
    settled: Option<Settled>,
    /// By vertex, where something is settled, whether this one is not; others are smoothed for what is bad alone. (In a sphere of
    /// 971,000 tetrahedra vertices move 460,000 times instead of 631,000; the worst angle is 29.0° instead of 29.2°.)
    left: Vec<bool>,
    /// A vertex that is not in the mesh: the next point.
    next: Option<u32>,
    steps: OptimizeStatistics,
}

/// How many there may be, with what the caller allows.
#[derive(Clone, Copy, Debug)]
struct Most {
    /// Tetrahedra and ghosts.
    tets: usize,
    /// Points that are not of the input.
    points: u64,
}

/// What a block settled that had other borders.
#[derive(Clone, Copy, Debug)]
struct Settled {
    /// How many tetrahedra have a vertex that is not.
    left: usize,
    /// How many there are.
    all: usize,
}

/// What is optimised.
pub struct Subject<'a> {
    /// With isolated edges marked as subsegments.
    pub mesh: &'a mut Mesh,
    /// All points, explicit.
    pub points: &'a mut Points,
    /// Those that move and go.
    pub inside: &'a mut Inside,
    /// Edges on no wall that stay.
    pub isolated: &'a FxHashSet<[u32; 2]>,
    /// Vertices of the surface that slide on it, if it may be refined.
    pub slides: Option<&'a mut Slides>,
    /// The largest volumes.
    pub bounds: &'a Bounds,
}

impl Subject<'_> {
    /// The same, for a while.
    fn again(&mut self) -> Subject<'_> {
        Subject {
            mesh: self.mesh,
            points: self.points,
            inside: self.inside,
            isolated: self.isolated,
            slides: self.slides.as_deref_mut(),
            bounds: self.bounds,
        }
    }
}

/// Optimises a mesh, a large one in blocks; larger efforts take longer and find more.
///
/// # Errors
/// `OutOfMemory`, `TetrahedraLimit`, and what ends the run.
pub fn optimise(mut subject: Subject, request: Request, crew: Crew) -> Result<OptimizeStatistics, Error> {
    let worst_before = worst(subject.mesh, subject.points, crew.part)?;
    let steps = match request.extent {
        _ if blocks::serves(&subject) => blocks::optimise(subject.again(), request, crew)?,
        Extent::Effort(effort) => {
            let aims = Aims { effort: effort.min(LARGEST_EFFORT), sine: request.sine };
            aim(subject.again(), aims, crew.part, &|_| Ok(()))?
        }
        Extent::Seconds(seconds) => {
            let mut optimise = Optimise::new(subject.again(), crew.part)?;
            optimise.time = Some(Duration::try_from_secs_f64(seconds).unwrap_or(Duration::MAX));
            optimise.run(Aims { effort: LARGEST_EFFORT, sine: request.sine })?;
            optimise.steps
        }
    };
    let worst_after = worst(subject.mesh, subject.points, crew.part)?;
    Ok(OptimizeStatistics { worst_before: degrees(worst_before), worst_after: degrees(worst_after), ..steps })
}

impl<'a> Optimise<'a> {
    fn new(subject: Subject<'a>, part: Part<'a>) -> Result<Optimise<'a>, Error> {
        let Subject { mesh, points, inside, isolated, slides, bounds } = subject;
        let count = points.len();
        let mut tets = Budget::default();
        tets.check(mesh, &part)?;
        // Points of the optimisation are never needed.
        let most =
            Most { tets: mesh.live_count() + tets.room(mesh), points: part.steiner_limit(usize::MAX / 200) };
        let mut movable = fallible::filled(false, count)?;
        for &v in &inside.list {
            movable[v as usize] = true;
        }
        Ok(Optimise {
            mesh,
            points,
            inside,
            isolated,
            slides,
            bounds,
            level: LEVELS[0],
            part,
            start: Instant::now(),
            time: None,
            movable,
            stuck: fallible::filled(0, count)?,
            clock: 1,
            moved: fallible::filled(1, count)?,
            failed: Vec::new(),
            queue: BinaryHeap::new(),
            descend: Descend::default(),
            search: StarSearch::default(),
            link: Vec::new(),
            into: Vec::new(),
            faces: Faces::default(),
            coming: Coming::default(),
            budget: 0,
            tets,
            most,
            settled: None,
            left: Vec::new(),
            next: None,
            steps: OptimizeStatistics::default(),
        })
    }
}

impl Optimise<'_> {
    /// Passes with an effort, then what can be done for a sine that is wanted; returns the worst, if one is.
    fn run(&mut self, aims: Aims) -> Result<f64, Error> {
        let mut reshape = Reshape::new(self.part.control());
        self.passes(&mut reshape, aims.effort)?;
        if aims.sine > 0.0 {
            self.reach(&mut reshape, aims.sine)?;
        }
        if self.next.take().is_some() {
            let count = self.inside.list.len();
            self.inside.shorten(count - 1);
        }
        self.inside.sweep(self.mesh);
        self.part.progress(1.0)?;
        if aims.sine > 0.0 {
            worst(self.mesh, self.points, self.part)
        } else {
            Ok(0.0)
        }
    }

    /// Passes until the last has gained too little.
    fn passes(&mut self, reshape: &mut Reshape, effort: u32) -> Result<(), Error> {
        self.level = LEVELS[effort.clamp(1, LEVELS.len() as u32) as usize - 1];
        let effort = effort as usize;
        let most = 1 + PASSES * effort;
        let mut missing = f64::INFINITY;
        self.budget = LEAST_BUDGET + effort * self.busy() / self.level.tets_a_point;
        self.forget()?;
        self.tets.check(self.mesh, self.part.control())?;
        self.smooth_all(self.level.good)?;
        for pass in 0..most {
            self.part.progress(0.9 * self.done().max(pass as f64 / most as f64))?;
            self.reconnect(reshape, if pass == 0 { &FIRST } else { &LATER })?;
            self.smooth_all(self.level.good)?;
            let now = self.missing()?;
            if pass >= 2 && now > (1.0 - WORTH) * missing || self.is_over() {
                break;
            }
            missing = now;
        }
        self.reconnect(reshape, &LAST)?;
        self.smooth_all(self.level.bad)
    }

    /// Does what can be done for tetrahedra below a sine.
    fn reach(&mut self, reshape: &mut Reshape, sine: f64) -> Result<(), Error> {
        let most = LEVELS[LEVELS.len() - 1];
        self.level = Level { bad: sine, awful: sine, poor: sine, ..most };
        self.budget = LEAST_BUDGET + self.busy() / most.tets_a_point;
        // What failed has failed with less.
        self.forget()?;
        let mut missing = self.missing()?;
        while missing > 0.0 && !self.is_over() {
            self.reconnect(reshape, &LAST)?;
            self.smooth_all(sine)?;
            let now = self.missing()?;
            if now > (1.0 - WORTH) * missing {
                break;
            }
            missing = now;
        }
        Ok(())
    }

    /// How many tetrahedra are not settled.
    fn busy(&self) -> usize {
        let count = self.mesh.live_count() as u64;
        let of = |Settled { left, all }: Settled| (count * left as u64 / all.max(1) as u64) as usize;
        self.settled.map_or(count as usize, of)
    }

    /// Forgets what has failed here.
    fn forget(&mut self) -> Result<(), Error> {
        self.failed.clear();
        if self.settled.is_some() {
            // All of it was tried where it was settled.
            fallible::resize(&mut self.failed, self.mesh.slot_count(), (1, LAST.level))?;
        }
        Ok(())
    }

    /// Whether the time is over: what has been done so far is the result.
    fn is_over(&self) -> bool {
        self.time.is_some_and(|time| self.start.elapsed() >= time)
    }

    /// The share of the time that is over; 0 without one.
    fn done(&self) -> f64 {
        let share = |time: Duration| quotient(self.start.elapsed().as_secs_f64(), time.as_secs_f64());
        self.time.map_or(0.0, |time| share(time).unwrap_or(1.0).min(1.0))
    }

    /// How much is missing to good angles, the worst weighted most.
    fn missing(&self) -> Result<f64, Error> {
        let mut sum = 0.0;
        for t in self.mesh.all() {
            self.part.steps(u32::from(t % 16 == 0))?;
            if self.counts(t) {
                let less = (self.level.bad - self.sine(t)).max(0.0);
                sum += less * less * less;
            }
        }
        Ok(sum)
    }

    fn counts(&self, t: u32) -> bool {
        self.mesh.is_live(t) && self.mesh.region(t) != NONE
    }

    fn sine(&self, t: u32) -> f64 {
        sine(self.mesh.verts(t).map(|v| self.points.xyz(v)))
    }

    /// Smooths all vertices with something below a bound in their star, unless nothing has changed there since they could not be moved.
    fn smooth_all(&mut self, below: f64) -> Result<(), Error> {
        for i in 0..self.inside.list.len() {
            self.part.step()?;
            if self.is_over() {
                break;
            }
            let v = self.inside.list[i];
            self.smooth(v, below)?;
        }
        let slider = |this: &Self, i: usize| this.slides.as_ref()?.list().get(i).map(|slider| slider.v);
        let mut next = 0;
        while let Some(v) = slider(self, next).filter(|_| !self.is_over()) {
            self.part.step()?;
            self.smooth(v, below)?;
            next += 1;
        }
        Ok(())
    }

    /// Smooths one vertex; whether it has moved.
    fn smooth(&mut self, v: u32, enough: f64) -> Result<bool, Error> {
        let at = v as usize;
        let there = self.mesh.vertex_tet.get(at).is_some_and(|&t| t != NONE);
        let inside = self.movable.get(at).is_some_and(|&m| m);
        let slides = || self.slides.as_ref().is_some_and(|slides| slides.of(v).is_some());
        if !there || !inside && !slides() {
            return Ok(false);
        }
        self.search.link(self.mesh, v, &mut self.link)?;
        if !inside {
            self.link.retain(|face| !face.contains(&GHOST));
        }
        self.part.worked(self.link.len());
        let latest =
            self.link.iter().flatten().map(|&w| self.moved[w as usize]).fold(self.moved[at], u64::max);
        if self.stuck[at] >= latest {
            return Ok(false);
        }
        let is_settled = self.left.get(at) == Some(&false);
        let enough = if is_settled { enough.min(self.level.bad) } else { enough };
        let old = *self.points.xyz(v);
        let (before, after) = match inside {
            true => self.descend.smooth(self.points, v, &mut self.link, enough)?,
            false => self.slide(v, enough)?,
        };
        if after > before && inside && self.too_large(v, &old) {
            self.points.move_to(v, old)?;
        } else if after > before {
            self.clock += 1;
            self.moved[at] = self.clock;
            self.steps.moves += 1;
            return Ok(true);
        }
        self.stuck[at] = self.clock;
        Ok(false)
    }

    /// Whether a vertex, whose link is at hand, has a tetrahedron above the bound on volume, and a larger one than at its old place.
    fn too_large(&self, v: u32, old: &[f64; 3]) -> bool {
        let bound = self.bounds.of(self.mesh.region(self.mesh.vertex_tet[v as usize]));
        bound.is_finite() && {
            let new = largest(self.points, self.points.xyz(v), &self.link);
            new > bound && new > largest(self.points, old, &self.link)
        }
    }

    /// Takes note of a tetrahedron if it is bad.
    fn push(&mut self, t: u32) -> Result<(), Error> {
        if self.counts(t) {
            let sine = self.sine(t);
            if sine < self.level.bad {
                fallible::push_heap(&mut self.queue, Reverse((sine.to_bits(), t)))?;
            }
        }
        Ok(())
    }

    /// Notes that tetrahedra are new.
    fn renew(&mut self, fresh: &[u32]) -> Result<(), Error> {
        self.tets.check(self.mesh, &self.part)?;
        self.clock += 1;
        for &t in fresh {
            self.push(t)?;
            for v in self.mesh.verts(t).into_iter().filter(|&v| v != GHOST) {
                self.moved[v as usize] = self.clock;
            }
        }
        Ok(())
    }

    /// Improves bad tetrahedra, the worst first, each once per shape. What has failed is tried again if one of its vertices has moved or has
    /// got another tetrahedron since.
    fn reconnect(&mut self, reshape: &mut Reshape, trial: &Trial) -> Result<(), Error> {
        self.steps.passes += 1;
        let mut left = self.level.patience * (trial.failures[0] + self.mesh.live_count() / trial.failures[1]);
        self.queue.clear();
        for t in self.mesh.all() {
            self.part.steps(u32::from(t % 16 == 0))?;
            self.push(t)?;
        }
        let mut last = None;
        while let Some(Reverse((bits, t))) = self.queue.pop() {
            self.part.step()?;
            if self.is_over() {
                break;
            }
            // What has changed since has an entry of its own, unless a vertex of it moved: then it is found in the next pass.
            if last == Some((bits, t)) || !self.counts(t) || self.sine(t).to_bits() != bits {
                continue;
            }
            last = Some((bits, t));
            let latest = self.mesh.verts(t).into_iter().map(|v| self.moved[v as usize]).fold(0, u64::max);
            let known = self.failed.get(t as usize).copied().unwrap_or_default();
            if known.0 >= latest && known.1 >= trial.level {
                continue;
            }
            let sine = f64::from_bits(bits);
            let hard = sine < self.level.awful && left > 0;
            if !self.improve(reshape, t, sine, if hard { trial.effort } else { EDGES }, trial.points)? {
                left -= usize::from(hard);
                let count = self.mesh.slot_count().max(self.failed.len());
                fallible::resize(&mut self.failed, count, (0, 0))?;
                self.failed[t as usize] = (self.clock, trial.level);
            }
        }
        Ok(())
    }

    /// Tries to improve a tetrahedron.
    fn improve(
        &mut self,
        reshape: &mut Reshape,
        t: u32,
        sine: f64,
        effort: Effort,
        points: bool,
    ) -> Result<bool, Error> {
        let verts = self.mesh.verts(t);
        let largest = self.bounds.of(self.mesh.region(t));
        let aim = Aim { measure: Measure::Dihedral, enough: ANY, least: ANY, largest };
        let mut done = reshape.improve(self.mesh, self.points, self.isolated, t, &aim, EDGES)?;
        self.steps.edges_removed += u64::from(done);
        for k in 0..4 {
            if !done {
                let mut site = Site {
                    mesh: self.mesh,
                    points: self.points,
                    edges: self.isolated,
                    replace: &mut reshape.replace,
                };
                done = self.faces.improve(&mut site, 4 * t + k, &aim)?;
                self.steps.faces_removed += u64::from(done);
            }
        }
        if !done {
            for v in verts {
                if self.smooth(v, self.level.good)? && self.sine(t) > (1.0 + GAIN) * sine + LEAST_GAIN {
                    // Its star has other shapes now.
                    self.search.vertex_star(self.mesh, v, self.mesh.vertex_tet[v as usize])?;
                    for i in 0..self.search.tets.len() {
                        self.push(self.search.tets[i])?;
                    }
                    return Ok(true);
                }
            }
        }
        if !done && !effort.cavities.is_empty() {
            done = reshape.improve(self.mesh, self.points, self.isolated, t, &aim, effort)?;
            self.steps.edges_removed += u64::from(done && reshape.removed_edge);
            self.steps.reconnected += u64::from(done && !reshape.removed_edge);
        }
        if done {
            self.renew(&reshape.replace.fresh)?;
            return Ok(true);
        }
        Ok(points && sine < self.level.poor && (self.contract(t)? || self.add(t)?))
    }
}

/// The smallest sine of the angles of a mesh; infinite if there is no tetrahedron.
fn worst(mesh: &Mesh, points: &Points, part: Part) -> Result<f64, Error> {
    let mut worst = f64::INFINITY;
    for t in mesh.all() {
        part.steps(u32::from(t % 16 == 0))?;
        if mesh.is_live(t) && mesh.region(t) != NONE {
            worst = worst.min(sine(mesh.verts(t).map(|v| points.xyz(v))));
        }
    }
    Ok(worst)
}

/// The angle of a sine, at most 90; 0 if it is none.
fn degrees(sine: f64) -> f64 {
    let sine = if sine <= 1.0 { sine } else { 0.0 };
    angle_in_degrees((1.0 - sine * sine).sqrt(), sine)
}

/// The largest volume of a tetrahedron from a place to a face.
fn largest(points: &Points, at: &[f64; 3], faces: &[[u32; 3]]) -> f64 {
    let of = |&[x, y, z]: &[u32; 3]| volume([at, points.xyz(x), points.xyz(y), points.xyz(z)]);
    faces.iter().map(of).fold(0.0, f64::max)
}

#[cfg(test)]
mod slide_tests;
#[cfg(test)]
mod tests;
