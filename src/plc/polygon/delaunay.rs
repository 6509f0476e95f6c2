//! Delaunay triangulation in the plane: the vertices of one facet, in projection.
//!
//! Lawson 1977: insert into a triangle, flip until all edges are locally Delaunay; points are inserted in rounds, each along a Hilbert
//! curve (Amenta, Choi & Rote 2003). The plane outside the convex hull is covered by ghost triangles with the vertex at infinity [`GHOST`],
//! so every edge has two sides.
//!
//! Half-edge `h = 3 t + i` is the side of triangle `t` opposite its corner `i`; it runs from corner `i + 1` to `i + 2`, with the
//! triangle on its left. Invariants: `twin[twin[h]] == h`; finite triangles are counter-clockwise.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::predicates::{incircle, orient2d, Sign};
use crate::INVALID;

/// The vertex at infinity.
pub const GHOST: u32 = u32::MAX;

/// Why there is no triangulation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flaw {
    /// All points lie on one line.
    Collinear,
    /// Two points are equal.
    Coincident,
}

/// Where a point is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// Inside this triangle (a ghost: outside the hull, beyond this hull edge).
    Triangle(u32),
    /// Inside this half-edge.
    Edge(u32),
    /// On this vertex.
    Vertex(u32),
}

/// A triangulation under construction; its storage is reused from facet to facet.
#[derive(Default)]
pub struct Triangulation {
    /// The vertices.
    pub points: Vec<[f64; 2]>,
    /// The corner opposite each half-edge.
    pub corner: Vec<u32>,
    /// The other side of each half-edge.
    pub twin: Vec<u32>,
    /// The constraints on each half-edge: head of a list owned by the caller, or `INVALID`.
    pub mark: Vec<u32>,
    /// One triangle at each vertex.
    pub triangle_of: Vec<u32>,
    order: Vec<(u64, u32)>,
    stack: Vec<u32>,
    last: u32,
}

/// The half-edge after `h` in its triangle.
#[inline(always)]
pub fn next(h: u32) -> u32 {
    if h % 3 == 2 {
        h - 2
    } else {
        h + 1
    }
}

/// The half-edge before `h` in its triangle.
#[inline(always)]
pub fn prev(h: u32) -> u32 {
    if h % 3 == 0 {
        h + 2
    } else {
        h - 1
    }
}

impl Triangulation {
    /// Where half-edge `h` begins.
    #[inline(always)]
    pub fn from(&self, h: u32) -> u32 {
        self.corner[next(h) as usize]
    }

    /// Where half-edge `h` ends.
    #[inline(always)]
    pub fn to(&self, h: u32) -> u32 {
        self.corner[prev(h) as usize]
    }

    /// The number of triangles, including ghosts.
    pub fn triangle_count(&self) -> u32 {
        (self.corner.len() / 3) as u32
    }

    /// The corners of triangle `t`.
    #[inline(always)]
    pub fn corners(&self, t: u32) -> [u32; 3] {
        let h = 3 * t as usize;
        [self.corner[h], self.corner[h + 1], self.corner[h + 2]]
    }

    /// Whether `t` is a ghost.
    #[inline(always)]
    pub fn is_ghost(&self, t: u32) -> bool {
        self.corners(t).contains(&GHOST)
    }

    /// The turn of `a`, `b`, `c`, all finite.
    #[inline(always)]
    pub fn turn(&self, a: u32, b: u32, c: u32) -> Sign {
        orient2d(self.points[a as usize], self.points[b as usize], self.points[c as usize])
    }

    /// Sets the triangle's corners and the incident triangles of its vertices; marks are cleared.
    pub(super) fn set_triangle(&mut self, t: u32, corners: [u32; 3]) {
        for (i, v) in corners.into_iter().enumerate() {
            self.corner[3 * t as usize + i] = v;
            self.mark[3 * t as usize + i] = INVALID;
            if v != GHOST {
                self.triangle_of[v as usize] = t;
            }
        }
    }

    /// Makes two half-edges the sides of one edge.
    #[inline(always)]
    pub(super) fn link(&mut self, g: u32, h: u32) {
        self.twin[g as usize] = h;
        self.twin[h as usize] = g;
    }

    fn new_triangle(&mut self) -> Result<u32, Error> {
        let t = self.triangle_count();
        fallible::extend(&mut self.corner, [GHOST; 3])?;
        fallible::extend(&mut self.twin, [INVALID; 3])?;
        fallible::extend(&mut self.mark, [INVALID; 3])?;
        Ok(t)
    }

    /// Triangulates `self.points`. Returns a flaw if there is no triangulation; fails if memory runs out.
    pub fn build(&mut self, control: &Control) -> Result<Result<(), Flaw>, Error> {
        let n = self.points.len();
        for list in [&mut self.corner, &mut self.twin, &mut self.mark] {
            list.clear();
            list.try_reserve(6 * n)?;
        }
        self.stack.clear();
        self.triangle_of.clear();
        fallible::resize(&mut self.triangle_of, n, INVALID)?;
        self.sort(control)?;
        let Some(second) =
            (1..n).find(|&i| self.points[self.order[i].1 as usize] != self.points[self.order[0].1 as usize])
        else {
            return Ok(Err(Flaw::Collinear));
        };
        let (a, b) = (self.order[0].1, self.order[second].1);
        let Some(third) = (1..n).find(|&i| self.turn(a, b, self.order[i].1) != Sign::Zero) else {
            return Ok(Err(Flaw::Collinear));
        };
        let c = self.order[third].1;
        self.first_triangle(if self.turn(a, b, c) == Sign::Positive { [a, b, c] } else { [b, a, c] })?;
        for i in 1..n {
            if i == second || i == third {
                continue;
            }
            let v = self.order[i].1;
            if !self.insert(v, control)? {
                return Ok(Err(Flaw::Coincident));
            }
        }
        Ok(Ok(()))
    }

    /// The order of insertion: rounds of about eightfold size, each along a Hilbert curve.
    fn sort(&mut self, control: &Control) -> Result<(), Error> {
        self.order.clear();
        if self.points.len() <= 16 {
            fallible::extend(&mut self.order, (0..self.points.len() as u32).map(|i| (0, i)))?;
            return Ok(());
        }
        let (mut low, mut high) = (self.points[0], self.points[0]);
        for p in &self.points {
            for k in 0..2 {
                low[k] = low[k].min(p[k]);
                high[k] = high[k].max(p[k]);
            }
        }
        let span = (high[0] - low[0]).max(high[1] - low[1]);
        let cell = |p: &[f64; 2], k: usize| ((p[k] - low[k]) / span * 65535.0) as u32;
        for (i, p) in self.points.iter().enumerate() {
            let round = ((i as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 20).trailing_zeros() / 3;
            let curve = u64::from(hilbert(cell(p, 0), cell(p, 1)));
            fallible::push(&mut self.order, (u64::from(63 - round) << 32 | curve, i as u32))?;
        }
        control.sort(&mut self.order)
    }

    fn first_triangle(&mut self, [a, b, c]: [u32; 3]) -> Result<(), Error> {
        let t = self.new_triangle()?;
        self.set_triangle(t, [a, b, c]);
        let ghosts = [self.new_triangle()?, self.new_triangle()?, self.new_triangle()?];
        for (g, corners) in ghosts.into_iter().zip([[c, b, GHOST], [a, c, GHOST], [b, a, GHOST]]) {
            for (i, v) in corners.into_iter().enumerate() {
                self.corner[(3 * g) as usize + i] = v;
            }
        }
        for i in 0..3 {
            self.link(3 * t + i, 3 * ghosts[i as usize] + 2);
            // Ghost i has the finite edge (x, y); its side from y to infinity meets the ghost whose edge begins at y.
            self.link(3 * ghosts[i as usize], 3 * ghosts[((i + 2) % 3) as usize] + 1);
        }
        self.last = t;
        Ok(())
    }

    /// Finds `p` by a walk from the last triangle. It terminates because the triangulation is Delaunay while points are inserted.
    fn locate(&self, p: [f64; 2]) -> Place {
        let mut t = self.last;
        if let Some(i) = self.corners(t).iter().position(|&v| v == GHOST) {
            t = self.twin[3 * t as usize + i] / 3;
        }
        'walk: loop {
            let mut zero = [INVALID; 2];
            for i in 0..3 {
                let h = 3 * t + i;
                match orient2d(self.points[self.from(h) as usize], self.points[self.to(h) as usize], p) {
                    Sign::Negative => {
                        t = self.twin[h as usize] / 3;
                        if self.is_ghost(t) {
                            return Place::Triangle(t);
                        }
                        continue 'walk;
                    }
                    Sign::Zero => zero = [h, zero[0]],
                    Sign::Positive => {}
                }
            }
            return match zero {
                [INVALID, _] => Place::Triangle(t),
                [h, INVALID] => Place::Edge(h),
                // The corner on both edges is the one opposite neither.
                [g, h] => Place::Vertex(self.corner[(9 * t + 3 - g - h) as usize]),
            };
        }
    }

    /// Inserts a vertex; returns false if there is an equal one.
    fn insert(&mut self, v: u32, control: &Control) -> Result<bool, Error> {
        let p = self.points[v as usize];
        match self.locate(p) {
            Place::Vertex(_) => return Ok(false),
            Place::Triangle(t) => {
                let slots = [t, self.new_triangle()?, self.new_triangle()?, INVALID];
                self.star(v, [3 * t, 3 * t + 1, 3 * t + 2, INVALID], slots, 3)?;
            }
            Place::Edge(h) => {
                let g = self.twin[h as usize];
                let slots = [h / 3, g / 3, self.new_triangle()?, self.new_triangle()?];
                self.star(v, [next(h), prev(h), next(g), prev(g)], slots, 4)?;
            }
        }
        self.legalize(v, control)?;
        self.last = self.triangle_of[v as usize];
        Ok(true)
    }

    /// Replaces the triangles whose border is given, in counter-clockwise order, by triangles from `v`.
    fn star(&mut self, v: u32, border: [u32; 4], slots: [u32; 4], count: usize) -> Result<(), Error> {
        let ends = border.map(|h| if h == INVALID { (0, 0) } else { (self.from(h), self.to(h)) });
        let outer = border.map(|h| if h == INVALID { INVALID } else { self.twin[h as usize] });
        for k in 0..count {
            self.set_triangle(slots[k], [v, ends[k].0, ends[k].1]);
            self.link(3 * slots[k], outer[k]);
            self.link(3 * slots[k] + 1, 3 * slots[(k + 1) % count] + 2);
            fallible::push(&mut self.stack, 3 * slots[k])?;
        }
        Ok(())
    }

    /// Flips until all edges opposite the new vertex are locally Delaunay.
    fn legalize(&mut self, v: u32, control: &Control) -> Result<(), Error> {
        while let Some(h) = self.stack.pop() {
            control.step()?;
            debug_assert_eq!(self.corner[h as usize], v);
            if self.is_illegal(h) {
                let g = self.flip(h);
                fallible::extend(&mut self.stack, g)?;
            }
        }
        Ok(())
    }

    /// Whether the vertex beyond half-edge `h` is in conflict with the triangle of `h`, whose apex is finite.
    fn is_illegal(&self, h: u32) -> bool {
        let (apex, from, to) = (self.corner[h as usize], self.from(h), self.to(h));
        let beyond = self.corner[self.twin[h as usize] as usize];
        if beyond == GHOST {
            false
        } else if from == GHOST {
            self.turn(beyond, to, apex) == Sign::Positive
        } else if to == GHOST {
            self.turn(apex, from, beyond) == Sign::Positive
        } else {
            let p = |v: u32| self.points[v as usize];
            incircle(p(apex), p(from), p(to), p(beyond)) == Sign::Positive
        }
    }

    /// Flips the diagonal; returns the two sides now opposite the apex of `h`.
    pub(super) fn flip(&mut self, h: u32) -> [u32; 2] {
        let g = self.twin[h as usize];
        let (apex, from, to, beyond) =
            (self.corner[h as usize], self.from(h), self.to(h), self.corner[g as usize]);
        // Outer sides: apex-from, to-apex; from-beyond, beyond-to.
        let outer = [prev(h), next(h), next(g), prev(g)].map(|s| self.twin[s as usize]);
        let (t, u) = (h / 3, g / 3);
        self.set_triangle(t, [apex, from, beyond]);
        self.set_triangle(u, [apex, beyond, to]);
        self.link(3 * t + 2, outer[0]);
        self.link(3 * t, outer[2]);
        self.link(3 * u + 1, outer[1]);
        self.link(3 * u, outer[3]);
        self.link(3 * t + 1, 3 * u + 2);
        [3 * t, 3 * u]
    }
}

/// The position of a cell along the Hilbert curve of a 65536 by 65536 grid.
fn hilbert(mut x: u32, mut y: u32) -> u32 {
    let mut d = 0;
    let mut s = 1 << 15;
    while s > 0 {
        let (rx, ry) = (u32::from(x & s != 0), u32::from(y & s != 0));
        d += s * s * ((3 * rx) ^ ry);
        if ry == 0 {
            if rx == 1 {
                x = 65535 - x;
                y = 65535 - y;
            }
            std::mem::swap(&mut x, &mut y);
        }
        s >>= 1;
    }
    d
}
