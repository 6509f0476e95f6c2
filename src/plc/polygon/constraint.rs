//! Inserting edges into the triangulation of a facet.
//!
//! Removing the triangles that an edge crosses leaves a pseudo-polygon on each side, which is filled with triangles whose circumcircles
//! contain no other corner of it (Anglada 1997). A vertex on the edge splits it. The chain of a pseudo-polygon may pass through a vertex
//! more than once, or along both sides of an edge.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::polygon::delaunay::{next, prev, Triangulation, GHOST};
use crate::predicates::{incircle, Sign};
use crate::INVALID;

/// One use of an edge by a polygon, in a list of uses of the same edge.
#[derive(Clone, Copy, Debug)]
pub struct Cover {
    /// The polygon.
    pub polygon: u32,
    /// The end at which the polygon enters the edge.
    pub from: u32,
    /// The next use, or `INVALID`.
    pub next: u32,
}

/// Why an edge cannot be inserted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Obstacle {
    /// It crosses this constrained edge.
    Crossing([u32; 2]),
    /// The triangulation is broken.
    Broken,
}

/// A side of a pseudo-polygon: what lies beyond it.
#[derive(Clone, Copy)]
struct Side {
    inner: u32,
    outer: u32,
    mark: u32,
    /// The half-edge that replaces it.
    own: u32,
}

/// Inserts edges; its storage is reused from facet to facet.
#[derive(Default)]
pub struct Inserter {
    /// All uses of edges by polygons.
    pub covers: Vec<Cover>,
    /// Vertices found inside edges of polygons: the edge's ends and the vertex.
    pub hits: Vec<[u32; 3]>,
    crossed: Vec<u32>,
    upper: Vec<u32>,
    lower: Vec<u32>,
    upper_sides: Vec<Side>,
    lower_sides: Vec<Side>,
    /// For each half-edge of a crossed triangle its index among the sides.
    side_of: Vec<u32>,
    tasks: Vec<(u32, u32, u32)>,
}

impl Inserter {
    /// Forgets all edges.
    pub fn clear(&mut self) {
        self.covers.clear();
        self.hits.clear();
    }

    /// Makes the edge from `u` to `v` a union of edges of the triangulation, used by `polygon`.
    pub fn insert(
        &mut self,
        mesh: &mut Triangulation,
        u: u32,
        v: u32,
        polygon: u32,
        control: &Control,
    ) -> Result<Result<(), Obstacle>, Error> {
        let mut a = u;
        while a != v {
            let start = match leave(mesh, a, v, control)? {
                Some(Way::Along(h)) => {
                    let end = mesh.to(h);
                    self.cover(mesh, h, polygon)?;
                    self.pass(u, v, end)?;
                    a = end;
                    continue;
                }
                Some(Way::Across(h)) => h,
                None => return Ok(Err(Obstacle::Broken)),
            };
            let end = match self.dig(mesh, a, v, start, control)? {
                Ok(end) => end,
                Err(obstacle) => return Ok(Err(obstacle)),
            };
            let Some(h) = self.refill(mesh, control)? else { return Ok(Err(Obstacle::Broken)) };
            self.cover(mesh, h, polygon)?;
            self.pass(u, v, end)?;
            a = end;
        }
        Ok(Ok(()))
    }

    /// Records a vertex inside an edge.
    fn pass(&mut self, u: u32, v: u32, vertex: u32) -> Result<(), Error> {
        if vertex != v {
            fallible::push(&mut self.hits, [u, v, vertex])?;
        }
        Ok(())
    }

    /// Records that `polygon` runs along half-edge `h`.
    fn cover(&mut self, mesh: &mut Triangulation, h: u32, polygon: u32) -> Result<(), Error> {
        let head = self.covers.len() as u32;
        fallible::push(&mut self.covers, Cover { polygon, from: mesh.from(h), next: mesh.mark[h as usize] })?;
        mesh.mark[h as usize] = head;
        mesh.mark[mesh.twin[h as usize] as usize] = head;
        Ok(())
    }

    /// Collects the triangles crossed from `a` towards `v`, entered through `start`, up to the first vertex on the edge.
    fn dig(
        &mut self,
        mesh: &Triangulation,
        a: u32,
        v: u32,
        start: u32,
        control: &Control,
    ) -> Result<Result<u32, Obstacle>, Error> {
        self.crossed.clear();
        self.upper.clear();
        self.lower.clear();
        self.upper_sides.clear();
        self.lower_sides.clear();
        let side = |h: u32| Side {
            inner: h,
            outer: mesh.twin[h as usize],
            mark: mesh.mark[h as usize],
            own: INVALID,
        };
        let mut h = start;
        fallible::push(&mut self.crossed, h / 3)?;
        fallible::extend(&mut self.upper, [a, mesh.to(h)])?;
        fallible::extend(&mut self.lower, [a, mesh.from(h)])?;
        fallible::push(&mut self.upper_sides, side(next(h)))?;
        fallible::push(&mut self.lower_sides, side(prev(h)))?;
        loop {
            control.step()?;
            if mesh.mark[h as usize] != INVALID {
                return Ok(Err(Obstacle::Crossing([mesh.from(h), mesh.to(h)])));
            }
            let g = mesh.twin[h as usize];
            let x = mesh.corner[g as usize];
            if x == GHOST {
                return Ok(Err(Obstacle::Broken));
            }
            fallible::push(&mut self.crossed, g / 3)?;
            let turn = if x == v { Sign::Zero } else { mesh.turn(a, v, x) };
            if turn != Sign::Negative {
                fallible::push(&mut self.upper, x)?;
                fallible::push(&mut self.upper_sides, side(prev(g)))?;
                h = next(g);
            }
            if turn != Sign::Positive {
                fallible::push(&mut self.lower, x)?;
                fallible::push(&mut self.lower_sides, side(next(g)))?;
                h = prev(g);
            }
            if turn == Sign::Zero {
                return Ok(Ok(x));
            }
        }
    }

    /// Fills both pseudo-polygons; returns the half-edge of the new edge, in its direction.
    fn refill(&mut self, mesh: &mut Triangulation, control: &Control) -> Result<Option<u32>, Error> {
        self.lower.reverse();
        self.lower_sides.reverse();
        let room = mesh.corner.len().max(self.side_of.len());
        fallible::resize(&mut self.side_of, room, INVALID)?;
        let mut slots = std::mem::take(&mut self.crossed);
        let tops = (
            fill(mesh, &self.upper, &mut self.upper_sides, &mut slots, &mut self.tasks, control)?,
            fill(mesh, &self.lower, &mut self.lower_sides, &mut slots, &mut self.tasks, control)?,
        );
        self.crossed = slots;
        let (Some(up), Some(down)) = tops else { return Ok(None) };
        mesh.link(up, down);
        let upper_count = self.upper_sides.len();
        for (k, s) in self.upper_sides.iter().chain(&self.lower_sides).enumerate() {
            self.side_of[s.inner as usize] = k as u32;
        }
        for k in 0..upper_count + self.lower_sides.len() {
            let at = |k: usize| {
                if k < upper_count {
                    &self.upper_sides[k]
                } else {
                    &self.lower_sides[k - upper_count]
                }
            };
            let s = at(k);
            mesh.mark[s.own as usize] = s.mark;
            // Beyond a dangling edge lies the pseudo-polygon itself.
            let mate = self.side_of.get(s.outer as usize).copied().filter(|&m| m != INVALID);
            let outer = mate.map_or(s.outer, |m| at(m as usize).own);
            mesh.link(s.own, outer);
        }
        for s in self.upper_sides.iter().chain(&self.lower_sides) {
            self.side_of[s.inner as usize] = INVALID;
        }
        Ok(Some(up))
    }
}

/// How an edge leaves its first vertex.
enum Way {
    /// Along this half-edge.
    Along(u32),
    /// Through this half-edge, opposite the vertex.
    Across(u32),
}

/// Turns about `a` to find the way to `v`.
fn leave(mesh: &Triangulation, a: u32, v: u32, control: &Control) -> Result<Option<Way>, Error> {
    let first = mesh.triangle_of[a as usize];
    let mut t = first;
    loop {
        control.step()?;
        let Some(corner) = mesh.corners(t).iter().position(|&c| c == a) else { return Ok(None) };
        let h = 3 * t + corner as u32;
        let (right, left) = (mesh.from(h), mesh.to(h));
        if right == v {
            return Ok(Some(Way::Along(prev(h))));
        }
        if right != GHOST && left != GHOST && left != v {
            let (r, l) = (mesh.turn(a, v, right), mesh.turn(a, v, left));
            if r == Sign::Zero && l == Sign::Positive {
                return Ok(Some(Way::Along(prev(h))));
            }
            if r == Sign::Negative && l == Sign::Zero {
                return Ok(Some(Way::Along(mesh.twin[next(h) as usize])));
            }
            if r == Sign::Negative && l == Sign::Positive {
                return Ok(Some(Way::Across(h)));
            }
        }
        // Counter-clockwise: across the side from `left` to `a`.
        t = mesh.twin[next(h) as usize] / 3;
        if t == first {
            return Ok(None);
        }
    }
}

/// Fills the pseudo-polygon left of its base, from the first to the last vertex of `chain`. Returns the base's half-edge.
fn fill(
    mesh: &mut Triangulation,
    chain: &[u32],
    sides: &mut [Side],
    slots: &mut Vec<u32>,
    tasks: &mut Vec<(u32, u32, u32)>,
    control: &Control,
) -> Result<Option<u32>, Error> {
    let mut base = None;
    tasks.clear();
    fallible::push(tasks, (0, chain.len() as u32 - 1, INVALID))?;
    while let Some((i, j, parent)) = tasks.pop() {
        if j - i == 1 {
            sides[i as usize].own = parent;
            continue;
        }
        control.steps(j - i)?;
        let Some(k) = choose(mesh, chain, i, j) else { return Ok(None) };
        let Some(t) = slots.pop() else { return Ok(None) };
        mesh.set_triangle(t, [chain[i as usize], chain[j as usize], chain[k as usize]]);
        if parent == INVALID {
            base = Some(3 * t + 2);
        } else {
            mesh.link(3 * t + 2, parent);
        }
        fallible::push(tasks, (i, k, 3 * t + 1))?;
        fallible::push(tasks, (k, j, 3 * t))?;
    }
    Ok(base)
}

/// The vertex between `i` and `j` whose circle through the base is empty.
fn choose(mesh: &Triangulation, chain: &[u32], i: u32, j: u32) -> Option<u32> {
    let p = |k: u32| mesh.points[chain[k as usize] as usize];
    let mut best = None;
    for k in i + 1..j {
        if mesh.turn(chain[i as usize], chain[j as usize], chain[k as usize]) != Sign::Positive {
            continue;
        }
        if best.is_none_or(|b| incircle(p(i), p(j), p(b), p(k)) == Sign::Positive) {
            best = Some(k);
        }
    }
    best
}
