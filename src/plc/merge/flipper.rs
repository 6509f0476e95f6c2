//! The surface during flipping: examines edges, flips those that a rule wants and exact tests allow, and keeps records.
//!
//! Invariants: the surface is a valid PLC; `edges` and `obstacles` describe its triangles; `records` has one entry per flip of the
//! surface.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::output::FacetFlip;
use crate::plc::intersect::obstacles::Obstacles;
use crate::plc::merge::edges::{sides, Edges};
use crate::plc::merge::wanted::{distance, Bound, Quadrilateral};
use crate::plc::merge::Guide;
use crate::plc::patch::{are_flat, FixedEdge};
use crate::plc::polygon::collinear;
use crate::plc::surface::Surface;
use crate::plc::Plc;
use crate::predicates::{orient3d, scale, Sign};
use crate::progress::Phase;
use crate::INVALID;

/// Limit of flips per triangle. Flips of a curved surface could cycle. 32 and 128 change nothing on seven models: it only bounds the work
/// on worse ones.
const FLIPS_PER_TRIANGLE: usize = 64;
/// How many edges are examined between two reports of progress.
const EDGES_PER_REPORT: usize = 1 << 12;

/// A Steiner point this near to the input's surface, relative to the diagonal of its box, counts as lying on it. On seven models with 1,326
/// Steiner points 2.5e-10 takes the same, 1e-09 0.1 % fewer.
const NEGLIGIBLE: f64 = 0.5e-9;

/// Which flips are wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Rule {
    /// Those that make the surface Delaunay.
    Angles,
    /// Those that lower the cost of edges (see [`super::steer`]).
    Cost,
}

/// The record of a flip.
#[derive(Clone, Copy)]
pub(super) struct Record {
    /// Approximate upper bound on the distance of the new edge from the input's surface.
    pub(super) deviation: f64,
    /// The flip that made the old edge, or `INVALID` if it is the input's.
    old_maker: u32,
    /// The distance of the old triangles from the input's surface.
    old_deviation: f64,
}

/// An edge that facets and markers allow to be flipped: triangles `t`, `u` at `ab`, with `c` and `d` opposite. `ab` is directed as in `t`.
#[derive(Clone, Copy)]
pub(super) struct Candidate {
    triangles: [u32; 2],
    pub(super) vertices: [u32; 4],
}

/// The state.
pub(super) struct Flipper<'a> {
    pub(super) surface: &'a mut Surface,
    plc: &'a Plc,
    pub(super) edges: Edges,
    obstacles: Obstacles,
    /// For each triangle whether it may be changed.
    movable: Vec<bool>,
    /// For each triangle an approximate upper bound on its distance from the input's surface.
    deviation: Vec<f64>,
    pub(super) records: Vec<Record>,
    bound: Bound,
    /// Deviations up to this count as none.
    pub(super) negligible: f64,
    /// Edges to be examined.
    queue: Vec<[u32; 2]>,
    /// Edges whose flip was wanted but not allowed.
    blocked: Vec<[u32; 2]>,
    /// The number of edges examined.
    looked: usize,
}

impl<'a> Flipper<'a> {
    pub(super) fn new(
        surface: &'a mut Surface,
        fixed: &[FixedEdge],
        plc: &'a Plc,
        degrees: f64,
        control: &Control,
    ) -> Result<Flipper<'a>, Error> {
        let edges = Edges::new(&surface.triangles, fixed, control)?;
        let mut segments: Vec<[u32; 2]> = fallible::reserved(fixed.len())?;
        fallible::extend(
            &mut segments,
            fixed.iter().map(|edge| edge.ends).filter(|&ends| !edges.in_triangle(ends)),
        )?;
        let seeds = single_points(surface, fixed, plc)?;
        let obstacles = Obstacles::new(&surface.points, &surface.triangles, &segments, &seeds, control)?;
        let movable = whole_triangles(surface, plc)?;
        control.look()?;
        let deviation: Vec<f64> = fallible::filled(0.0, surface.triangles.len())?;
        surface.facet_flips.clear();
        let negligible = NEGLIGIBLE * diagonal(&surface.points);
        let mut flipper = Flipper {
            surface,
            plc,
            edges,
            obstacles,
            movable,
            deviation,
            records: Vec::new(),
            bound: Bound::new(degrees),
            negligible,
            queue: Vec::new(),
            blocked: Vec::new(),
            looked: 0,
        };
        flipper.fix_creases(control)?;
        Ok(flipper)
    }

    /// Fixes every edge at which the input's triangles meet below the bound. Otherwise a chain of flips could turn a triangle little by
    /// little until a crease looks flat.
    fn fix_creases(&mut self, control: &Control) -> Result<(), Error> {
        for t in 0..self.surface.triangles.len() {
            control.step()?;
            for ends in sides(self.surface.triangles[t]) {
                let Some(Candidate { vertices, .. }) = self.candidate(ends) else { continue };
                let vertices = vertices.map(|v| &self.surface.points[v as usize]);
                if !Quadrilateral::new(vertices).meets_within(&self.bound) {
                    self.edges.fix(ends);
                }
            }
        }
        Ok(())
    }

    /// Examines every edge until there is nothing to flip. Edges whose flip is wanted but not allowed are tried at most `passes` times,
    /// since a flip far away may make room.
    pub(super) fn run(
        &mut self,
        rule: Rule,
        guide: &mut Guide,
        passes: usize,
        control: &Control,
    ) -> Result<(), Error> {
        self.queue.clear();
        self.blocked.clear();
        for t in 0..self.surface.triangles.len() {
            fallible::extend(&mut self.queue, sides(self.surface.triangles[t]))?;
            self.empty_queue(rule, guide, control)?;
        }
        self.run_on(rule, guide, passes - 1, control)
    }

    /// The same for only the edges in the queue and those whose flip was not allowed, when all others have been examined.
    pub(super) fn run_on(
        &mut self,
        rule: Rule,
        guide: &mut Guide,
        passes: usize,
        control: &Control,
    ) -> Result<(), Error> {
        for _ in 0..passes {
            let before = self.records.len();
            let blocked = std::mem::take(&mut self.blocked);
            self.empty_queue(rule, guide, control)?;
            for edge in blocked {
                fallible::push(&mut self.queue, edge)?;
                self.empty_queue(rule, guide, control)?;
            }
            if self.records.len() == before || self.is_exhausted() {
                break;
            }
        }
        Ok(())
    }

    /// Puts an edge into the queue.
    pub(super) fn look_at(&mut self, edge: [u32; 2]) -> Result<(), Error> {
        fallible::push(&mut self.queue, edge)?;
        Ok(())
    }

    /// Whether any edge was flipped.
    pub(super) fn is_started(&self) -> bool {
        !self.records.is_empty()
    }

    pub(super) fn is_exhausted(&self) -> bool {
        self.records.len() / FLIPS_PER_TRIANGLE > self.surface.triangles.len()
    }

    /// Examines the edges in the queue, and those around each flip.
    fn empty_queue(&mut self, rule: Rule, guide: &mut Guide, control: &Control) -> Result<(), Error> {
        while let Some(edge) = self.queue.pop() {
            if self.looked % EDGES_PER_REPORT == 0 {
                control.progress(Phase::Validate, 0.9)?;
            }
            control.step()?;
            self.looked += 1;
            if self.is_exhausted() {
                self.queue.clear();
                return Ok(());
            }
            let Some(candidate) = self.candidate(edge) else { continue };
            if !self.is_wanted(rule, guide, &candidate) {
                continue;
            }
            if self.is_allowed(&candidate, control)? {
                self.flip(&candidate)?;
            } else {
                fallible::push(&mut self.blocked, edge)?;
            }
        }
        Ok(())
    }

    /// The flip of an edge, if it is an edge between two triangles that may be changed.
    pub(super) fn candidate(&self, ends: [u32; 2]) -> Option<Candidate> {
        let [t, u] = self.edges.pair(ends)?;
        if t == u || !self.movable[t as usize] || !self.movable[u as usize] {
            return None;
        }
        let [f, g] = [t, u].map(|t| self.plc.facet_marker(self.surface.triangle_facet[t as usize] as usize));
        if f != g {
            return None;
        }
        let corners = self.surface.triangles[t as usize];
        let [a, b] = sides(corners).into_iter().find(|side| side.iter().all(|v| ends.contains(v)))?;
        let apex = |t: u32| self.surface.triangles[t as usize].into_iter().find(|&v| v != a && v != b);
        let (c, d) = (apex(t)?, apex(u)?);
        (c != d).then_some(Candidate { triangles: [t, u], vertices: [a, b, c, d] })
    }

    fn is_wanted(&self, rule: Rule, guide: &mut Guide, candidate: &Candidate) -> bool {
        let quadrilateral =
            || Quadrilateral::new(candidate.vertices.map(|v| &self.surface.points[v as usize]));
        match rule {
            Rule::Angles => {
                let quadrilateral = quadrilateral();
                quadrilateral.is_not_delaunay()
                    && quadrilateral.is_within(&self.bound)
                    && !(guide.avoids([candidate.vertices[2], candidate.vertices[3]])
                        && self.new_deviation(candidate) > self.negligible)
            }
            Rule::Cost => self.is_cheaper(guide, candidate) && quadrilateral().is_within(&self.bound),
        }
    }

    /// The distance of the new edge of a flip from the input's surface.
    pub(super) fn new_deviation(&self, candidate: &Candidate) -> f64 {
        let [t, u] = candidate.triangles.map(|t| self.deviation[t as usize]);
        match self.undone(candidate).map(|k| self.records[k as usize].old_maker) {
            Some(INVALID) => 0.0,
            Some(maker) => self.records[maker as usize].deviation,
            None => t.max(u) + distance(candidate.vertices.map(|v| &self.surface.points[v as usize])),
        }
    }

    /// The flip that this one undoes, if any.
    fn undone(&self, candidate: &Candidate) -> Option<u32> {
        let [a, b, c, d] = candidate.vertices;
        let maker = self.edges.maker([a, b])?;
        let flip = self.surface.facet_flips.get(maker as usize)?;
        (flip.old == [c, d] || flip.old == [d, c]).then_some(maker)
    }

    /// Whether the surface is valid after the flip, exactly.
    pub(super) fn is_allowed(&mut self, candidate: &Candidate, control: &Control) -> Result<bool, Error> {
        let points = &self.surface.points;
        let [a, b, c, d] = candidate.vertices;
        if self.edges.contains([c, d]) || collinear(points, c, d, a) || collinear(points, c, d, b) {
            return Ok(false);
        }
        let [p, q, r, s] = candidate.vertices.map(|v| &points[v as usize]);
        if orient3d(p, q, r, s) == Sign::Zero {
            // Strictly convex: the same points are covered before and after.
            return Ok(are_flat(points, [a, b], c, d) && are_flat(points, [c, d], a, b));
        }
        self.obstacles.allow_flip(points, candidate.triangles, candidate.vertices, control)
    }

    /// Edge `ab` becomes `cd`; the triangle with `a` becomes `t`, the one with `b` becomes `u`, or the reverse if that gives both facets
    /// the triangles they had before an earlier flip.
    pub(super) fn flip(&mut self, candidate: &Candidate) -> Result<(), Error> {
        let (pair @ [t, u], [a, b, c, d]) = (candidate.triangles, candidate.vertices);
        let record = Record {
            deviation: self.new_deviation(candidate),
            old_maker: self.edges.maker([a, b]).unwrap_or(INVALID),
            old_deviation: pair.iter().map(|&t| self.deviation[t as usize]).fold(0.0, f64::max),
        };
        let undone = self.undone(candidate);
        let (maker, deviation) = match undone {
            Some(k) => (self.records[k as usize].old_maker, self.records[k as usize].old_deviation),
            None => (self.records.len() as u32, record.deviation),
        };
        let surface = &mut *self.surface;
        let facets = pair.map(|t| surface.triangle_facet[t as usize]);
        let is_turned = undone.is_some_and(|k| {
            let flip = surface.facet_flips[k as usize];
            (flip.new[0] == a) != (flip.facets[0] == facets[0])
        });
        let (old, of_t, mut of_u) = match is_turned {
            false => ([a, b], [c, a, d], [d, b, c]),
            true => ([b, a], [d, b, c], [c, a, d]),
        };
        let alike = sides(surface.triangles[u as usize]).contains(&[b, a]);
        if !alike {
            of_u.swap(0, 2);
        }
        let [x, y] = old;
        self.edges.flip([[a, b], [c, d]], pair, [[y, c], [x, d]], maker, self.records.len() as u32)?;
        for (slot, corners) in [(t, of_t), (u, of_u)] {
            surface.triangles[slot as usize] = corners;
            self.deviation[slot as usize] = deviation;
            self.obstacles.replace(&surface.points, slot, corners);
        }
        fallible::push(&mut surface.facet_flips, FacetFlip { old, new: [c, d], facets })?;
        fallible::push(&mut self.records, record)?;
        fallible::extend(&mut self.queue, [[a, c], [c, b], [b, d], [d, a]])?;
        Ok(())
    }
}

fn diagonal(points: &[[f64; 3]]) -> f64 {
    let extent = |k: usize| {
        let along = || points.iter().map(|p| p[k]);
        along().fold(f64::NEG_INFINITY, f64::max) - along().fold(f64::INFINITY, f64::min)
    };
    (0..3).map(extent).map(|x| x * x).sum::<f64>().sqrt()
}

/// Vertices of no triangle and no segment, and the seeds of holes and regions: a flip must not pass over them.
fn single_points(surface: &Surface, fixed: &[FixedEdge], plc: &Plc) -> Result<Vec<[f64; 3]>, Error> {
    let mut used: Vec<bool> = fallible::filled(false, surface.points.len())?;
    let ends = fixed.iter().flat_map(|edge| edge.ends);
    surface.triangles.iter().flatten().copied().chain(ends).for_each(|v| used[v as usize] = true);
    let isolated = (0..surface.points.len()).filter(|&v| !used[v] && surface.alias[v] as usize == v);
    let mut single: Vec<[f64; 3]> = fallible::collect(isolated.map(|v| surface.points[v]))?;
    let seeds = plc.holes.iter().chain(plc.regions.iter().map(|region| &region.point));
    fallible::extend(&mut single, seeds.map(|p| p.map(|x| scale(x, surface.scale))))?;
    Ok(single)
}

/// For each triangle whether it is a whole input triangle.
fn whole_triangles(surface: &Surface, plc: &Plc) -> Result<Vec<bool>, Error> {
    let whole: Vec<bool> =
        fallible::collect(surface.triangles.iter().zip(&surface.triangle_facet).map(|(corners, &facet)| {
            plc.triangles.get(facet as usize).is_some_and(|input| {
                let given = input.map(|v| surface.alias[v as usize]);
                corners.iter().all(|v| given.contains(v))
            })
        }))?;
    Ok(whole)
}
