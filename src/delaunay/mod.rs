//! Delaunay tetrahedralization by incremental insertion (Bowyer 1981, Watson 1981) over ghost tetrahedra.
//!
//! Ties are broken by one symbolic perturbation of the lifting by vertex id: the perturbed Delaunay tetrahedralization is unique, has no
//! flat tetrahedron, and does not depend on the insertion order.
//!
//! *Weighted points* (Edelsbrunner & Shah 1996): with the power test instead of insphere the same insertion makes the regular
//! tetrahedralization. A point whose lift is not below the hyperplane of the tetrahedron that contains it is *hidden*: it is not inserted. A
//! vertex of which all tetrahedra are in conflict with a new one is hidden from then on. The lower hull of the lifts only sinks, so no point
//! comes back, and the order of insertion does not matter. One thread inserts them.
//!
//! Invariant between insertions: `mesh` is the perturbed Delaunay tetrahedralization of the inserted vertices, closed by
//! ghosts; hidden ones have no tetrahedron.
#[cfg(test)]
pub mod check;
mod conflicts;
mod edge_table;
pub mod insert;
pub mod locate;
pub mod order;
mod parallel;
mod ranges;

use crate::control::{Control, Part};
use crate::error::{Error, Status};
use crate::fallible;
use crate::kernel::{Mesh, GHOST};
use crate::predicates::{Points, Sign};
#[cfg(test)]
pub(crate) use crate::workers::STARTED as HELPERS_STARTED;
use insert::Inserter;
use locate::{walk, Walk};
use order::Frame;
use parallel::{Pass, Workers, FEWEST_VERTICES};
use ranges::{range_count, Division};

/// Walks of more steps are long: tetrahedra then extend far, and it matters at which tetrahedron of the last vertex a walk starts. From 12
/// to 48 the time for 8,000 points, all but one in a plane, stays within 3 % (the least of three runs): nothing measurable depends on it
/// there.
const LONG_WALK: u32 = 24;
/// After a long walk this many starts are chosen with care. From 32 to 128 that time stays within 6 %, which is its scatter.
const CAREFUL: u32 = 64;
/// Limit on passes over the vertices that the first pass of a round deferred: a pass over all tetrahedra for fewer vertices that one thread
/// inserts.
const MOST_PASSES: usize = 2;

/// A Delaunay tetrahedralization under construction.
#[derive(Default)]
pub struct Construction {
    /// The tetrahedra.
    pub mesh: Mesh,
    /// Inserts the vertices.
    pub inserter: Inserter,
    /// Where the next walk starts.
    pub hint: u32,
    /// Statistics of the rounds that the last [`build_rounds`](Self::build_rounds) inserted by ranges.
    pub rounds: Vec<Round>,
    /// For experiments: the number of ranges in each of these rounds, instead of one that suits its size.
    pub ranges: Option<usize>,
}

/// A round of insertions by ranges.
#[cfg_attr(not(any(test, feature = "internals")), expect(dead_code, reason = "for tests"))]
#[derive(Debug, Default)]
pub struct Round {
    /// Vertices inserted in it.
    pub vertices: usize,
    /// Ranges of its first pass.
    pub ranges: usize,
    /// Vertices that each pass deferred; those of the last one were inserted by one thread.
    pub deferred: Vec<usize>,
}

impl Construction {
    /// Begins with the memory of a mesh and an inserter that are no longer needed.
    pub fn with(mesh: Mesh, inserter: Inserter) -> Self {
        Construction { mesh, inserter, ..Self::default() }
    }

    /// The Delaunay tetrahedralization of all points, with a tetrahedron of each vertex.
    #[cfg(test)]
    pub fn of(points: &Points) -> Mesh {
        let mut construction = Construction::default();
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        construction.build(points, &mut order, &Control::free()).unwrap();
        construction.mesh.index_vertices(points.len()).unwrap();
        construction.mesh
    }

    /// Bytes held.
    #[cfg(feature = "internals")]
    pub fn bytes(&self) -> usize {
        self.mesh.bytes() + self.inserter.bytes()
    }

    /// Starts with the first four vertices of `order` that are not coplanar and moves them to its front. Fails if all are coplanar.
    pub fn start(&mut self, points: &Points, order: &mut [u32], control: &Control) -> Result<(), Error> {
        self.mesh.clear();
        let flat = || Error::new(Status::DegenerateInput, "all points lie in one plane");
        if order.len() < 4 {
            return Err(flat());
        }
        let first = |from: usize, order: &[u32], test: &dyn Fn(u32) -> bool| {
            for (i, &v) in (from..).zip(&order[from..]) {
                control.step()?;
                if test(v) {
                    return Ok(i);
                }
            }
            Err(flat())
        };
        let third = first(2, order, &|v| !points.collinear(order[0], order[1], v))?;
        order[2..=third].rotate_right(1);
        let [a, b, c] = [order[0], order[1], order[2]];
        let fourth = first(3, order, &|v| points.orient3d(a, b, c, v) != Sign::Zero)?;
        order[3..=fourth].rotate_right(1);
        let d = order[3];
        let v = if points.orient3d(a, b, c, d) == Sign::Positive { [a, b, c, d] } else { [a, c, b, d] };
        self.mesh.reserve(5)?;
        let t = self.mesh.allocate(v)?;
        let mut ghosts = [0; 4];
        for f in 0..4 {
            // (apex, x, y, z) is positive, and so is (x, y, z, p) for p beyond the face.
            let [x, y, z] = self.mesh.face(4 * t + f);
            let g = self.mesh.allocate([x, y, z, GHOST])?;
            ghosts[f as usize] = g;
            self.mesh.link(4 * t + f, 4 * g + 3);
        }
        for i in 0..4 {
            for j in 0..i {
                self.link_ghosts(ghosts[i], ghosts[j]);
            }
        }
        self.hint = t;
        Ok(())
    }

    /// Makes two ghosts neighbours across the face of their common hull edge.
    fn link_ghosts(&mut self, g: u32, h: u32) {
        let (a, b) = (self.mesh.verts(g), self.mesh.verts(h));
        let f = (0..3).find(|&i| !b.contains(&a[i])).unwrap_or(0) as u32;
        let k = (0..3).find(|&i| !a.contains(&b[i])).unwrap_or(0) as u32;
        self.mesh.link(4 * g + f, 4 * h + k);
    }

    /// Inserts one vertex by a walk from a tetrahedron; returns the number of steps.
    fn insert_from(&mut self, points: &Points, p: u32, start: u32, control: &Control) -> Result<u32, Error> {
        let Walk::Found(t, steps) = walk::<false, false, false>(&self.mesh.slots(), 0, points, p, start)
        else {
            return Err(Error::internal("point location did not terminate"));
        };
        self.hint = self.inserter.insert::<false, false>(&mut self.mesh, points, p, t, control)?;
        Ok(steps)
    }

    /// The same for a weighted vertex, unless it is hidden.
    fn insert_weighted_from(
        &mut self,
        points: &Points,
        p: u32,
        start: u32,
        control: &Control,
    ) -> Result<u32, Error> {
        let Walk::Found(t, steps) = walk::<false, false, true>(&self.mesh.slots(), 0, points, p, start)
        else {
            return Err(Error::internal("point location did not terminate"));
        };
        // Beyond a hull face nothing is hidden.
        let is_hidden =
            !self.mesh.is_ghost(t) && points.power_perturbed(self.mesh.verts(t), p) != Sign::Positive;
        self.hint = match is_hidden {
            true => t,
            false => self.inserter.insert::<false, true>(&mut self.mesh, points, p, t, control)?,
        };
        Ok(steps)
    }

    /// Among the tetrahedra made last, the one whose vertices are nearest to `p`.
    fn nearest_made(&self, points: &Points, p: u32) -> u32 {
        let at = points.xyz(p);
        let mut best = (f64::INFINITY, self.hint);
        for &t in &self.inserter.fresh {
            let verts = self.mesh.verts(t);
            if verts[3] == GHOST {
                continue;
            }
            let distance = |v: u32| {
                let q = points.xyz(v);
                (0..3).map(|k| (at[k] - q[k]) * (at[k] - q[k])).sum::<f64>()
            };
            let sum = verts.iter().map(|&v| distance(v)).sum();
            if sum < best.0 {
                best = (sum, t);
            }
        }
        best.1
    }

    /// Builds the triangulation of the given vertices, in this order of insertion (the first four may be swapped with later ones).
    pub fn build(&mut self, points: &Points, order: &mut [u32], control: &Control) -> Result<(), Error> {
        self.begin(points, order, control)?;
        self.insert_in_order(points, &order[4..], control, None)
    }

    /// Makes the first tetrahedron.
    fn begin(&mut self, points: &Points, order: &mut [u32], control: &Control) -> Result<(), Error> {
        self.inserter.prepare(points.len())?;
        self.rounds.clear();
        self.start(points, order, control)
    }

    /// Like [`build`](Self::build), for vertices in rounds that end at `rounds`, each sorted along the curve. Large rounds are inserted by
    /// up to `threads` threads; the result is the same for any number. After an error the mesh is empty.
    pub fn build_rounds(
        &mut self,
        points: &Points,
        order: &mut [u32],
        rounds: &[usize],
        threads: usize,
        part: Part,
    ) -> Result<(), Error> {
        self.begin(points, order, &part)?;
        let at = |done: usize| done as f64 / order.len() as f64;
        let mut begin = 4;
        let mut shared = false;
        for &end in rounds.iter().chain([&order.len()]) {
            if end <= begin {
                continue;
            }
            let ranges = match (range_count(begin), self.ranges) {
                (1, _) | (_, None) => range_count(begin),
                (_, Some(ranges)) => ranges,
            };
            let part = part.part(at(begin), at(end));
            if !points.are_weighted() && !rounds.is_empty() && ranges > 1 && end - begin >= FEWEST_VERTICES {
                if !shared {
                    // The number of present vertices predicts the number of tetrahedra (slightly too low, since the hull's share shrinks).
                    // Growing the arrays instead would copy them and leave gaps among smaller blocks.
                    let each = self.mesh.live_count() as f64 / begin as f64;
                    let expected = (each * order.len() as f64 * 1.03) as usize;
                    self.mesh.expect(expected.saturating_sub(self.mesh.slot_count()));
                }
                shared = true;
                let done = self.insert_round(points, order, begin..end, ranges, Workers { threads, part });
                if done.is_err() {
                    self.mesh.clear();
                }
                done?;
            } else {
                self.insert_in_order(points, &order[begin..end], &part, Some(part))?;
            }
            begin = end;
        }
        if shared {
            self.mesh.disown();
        }
        Ok(())
    }

    /// Inserts vertices one after the other.
    fn insert_in_order(
        &mut self,
        points: &Points,
        vertices: &[u32],
        control: &Control,
        part: Option<Part>,
    ) -> Result<(), Error> {
        let weighted = points.are_weighted();
        let mut careful = 0;
        for (i, &p) in vertices.iter().enumerate() {
            if let (Some(part), 0) = (part, i % 8192) {
                part.progress(i as f64 / vertices.len() as f64)?;
            }
            control.step()?;
            let start = if careful > 0 { self.nearest_made(points, p) } else { self.hint };
            let steps = match weighted {
                false => self.insert_from(points, p, start, control)?,
                true => self.insert_weighted_from(points, p, start, control)?,
            };
            control.worked(steps as usize + self.inserter.conflicts.dead().len());
            careful = if steps > LONG_WALK { CAREFUL } else { careful.saturating_sub(1) };
        }
        Ok(())
    }

    /// Inserts a round in passes.
    fn insert_round(
        &mut self,
        points: &Points,
        order: &[u32],
        round: std::ops::Range<usize>,
        ranges: usize,
        workers: Workers,
    ) -> Result<(), Error> {
        let frame = Frame::of(points.coordinates(), order);
        let mut present = &order[..round.start];
        let division =
            Division::along_curve(points, &frame, present, &order[round.start..round.end], ranges)?;
        let pass = Pass { points, present, reserve: 0.97, workers };
        let mut left = self.insert_pass(&pass, division)?;
        let mut report = Round { vertices: round.len(), ranges, deferred: fallible::collect([left.len()])? };
        present = &order[..round.end];
        for turn in 0..MOST_PASSES {
            // A pass visits all tetrahedra once, which takes as long as inserting a fraction of the vertices. Nor does another division
            // help if no vertex has its surroundings in one range.
            let hopeless = 4 * left.len() > 3 * round.len();
            if hopeless || left.len() < FEWEST_VERTICES.max(present.len() / 32) {
                break;
            }
            // The deferred vertices are counted once more, in the part that they have of the round.
            let part = workers.part.part(1.0 - left.len() as f64 / round.len() as f64, 1.0);
            let workers = Workers { part, ..workers };
            let division = Division::slabs(points, present, &left, ranges.div_ceil(2).max(2), turn)?;
            let pass = Pass { points, present, reserve: 1.05, workers };
            left = self.insert_pass(&pass, division)?;
            fallible::push(&mut report.deferred, left.len())?;
        }
        fallible::push(&mut self.rounds, report)?;
        self.hint = (0..self.mesh.slot_count() as u32).find(|&t| self.mesh.is_live(t)).unwrap_or(0);
        let part = workers.part.part(1.0 - left.len() as f64 / round.len() as f64, 1.0);
        self.insert_in_order(points, &left, &part, Some(part))
    }
}

#[cfg(test)]
mod tests;
