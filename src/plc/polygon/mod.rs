//! Triangulation of one facet: polygons of any number of corners, in projection along an axis.
//!
//! Projecting drops one coordinate, so it is exact. For exactly planar polygons every axis not parallel to their plane gives the same
//! result; other polygons are triangulated as projected, and refused only if no axis gives a valid region. Steps: Delaunay triangulation of
//! the corners ([`delaunay`]), insertion of the polygons' edges ([`constraint`]), inside and outside ([`region`]), diagonals that are
//! Delaunay in space ([`metric`]).
//!
//! Invariant of the result: each triangle has the orientation of the outer ring, is not degenerate, and has only corners of the polygons;
//! each polygon vertex that lies on a polygon's edge splits it.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::Interior;
use crate::predicates::{orient2d, orient3d, Sign};
use crate::vector::by_size;
use crate::INVALID;

pub mod constraint;
pub mod delaunay;
pub mod metric;
pub mod region;
mod small;

use constraint::{Inserter, Obstacle};
use delaunay::{Flaw, Triangulation, GHOST};
use region::Regions;

/// The role of a polygon.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The outer ring.
    Outer,
    /// A hole in the outer ring.
    Hole,
    /// Edges that constrain but bound nothing.
    Edge,
}

/// What is wrong with a facet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FaultKind {
    /// No area.
    Degenerate,
    /// Rings cross.
    Crossing,
    /// A hole outside the outer ring or in another hole.
    Nesting,
    /// Not planar, and no projection is a valid region.
    NonPlanar,
    /// A hole seed lies on an edge.
    Seed,
    /// A failed invariant.
    Broken,
}

/// A fault, with the vertices that locate it: two edges that cross, or one vertex four times, or `INVALID`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The kind.
    pub kind: FaultKind,
    /// The place.
    pub vertices: [u32; 4],
}

/// Triangulates facets one after another, reusing its storage.
#[derive(Default)]
pub struct Triangulator {
    /// The result: triangles, as indices of points.
    pub triangles: Vec<[u32; 3]>,
    /// The result: edges that constrain although the facet lies on both sides of them, or on neither.
    pub edges: Vec<[u32; 2]>,
    mesh: Triangulation,
    inserter: Inserter,
    regions: Regions,
    vertices: Vec<u32>,
    /// For each point its index in `vertices`.
    local: Vec<u32>,
    input: Vec<[u32; 3]>,
    roles: Vec<Role>,
    seeds: Vec<[f64; 2]>,
    stack: Vec<u32>,
}

impl Triangulator {
    /// A triangulator for facets with corners among this many points.
    pub fn new(point_count: usize) -> Result<Self, Error> {
        let mut triangulator = Triangulator::default();
        triangulator.local.try_reserve_exact(point_count)?;
        fallible::resize(&mut triangulator.local, point_count, INVALID)?;
        Ok(triangulator)
    }

    /// Begins a facet.
    pub fn clear(&mut self) {
        for &v in &self.vertices {
            self.local[v as usize] = INVALID;
        }
        self.vertices.clear();
        self.input.clear();
        self.roles.clear();
        self.triangles.clear();
        self.edges.clear();
    }

    /// Adds a vertex.
    pub fn add_vertex(&mut self, v: u32) -> Result<u32, Error> {
        if self.local[v as usize] == INVALID {
            self.local[v as usize] = self.vertices.len() as u32;
            fallible::push(&mut self.vertices, v)?;
        }
        Ok(self.local[v as usize])
    }

    /// The vertices of the facet so far.
    pub fn vertices(&self) -> &[u32] {
        &self.vertices
    }

    /// Adds a polygon without edges; returns its number.
    pub fn add_polygon(&mut self, role: Role) -> Result<u32, Error> {
        fallible::push(&mut self.roles, role)?;
        Ok(self.roles.len() as u32 - 1)
    }

    /// Adds an edge of a polygon, from `u` to `v`.
    pub fn add_edge(&mut self, polygon: u32, u: u32, v: u32) -> Result<(), Error> {
        let edge = [self.add_vertex(u)?, self.add_vertex(v)?, polygon];
        if u != v {
            fallible::push(&mut self.input, edge)?;
        }
        Ok(())
    }

    /// Triangulates a facet that is a single ring of three or four corners, if it is simple; returns whether it did. Nothing needs to be
    /// added before.
    pub fn triangulate_ring(&mut self, points: &[[f64; 3]], ring: &[u32]) -> Result<bool, Error> {
        self.clear();
        if let Some((triangles, count)) = small::triangulate_small(points, ring) {
            fallible::append(&mut self.triangles, &triangles[..count])?;
        }
        Ok(!self.triangles.is_empty())
    }

    /// Triangulates what was added since [`Triangulator::clear`]. `holes` are the seeds of [`Interior::Seeds`].
    pub fn triangulate(
        &mut self,
        points: &[[f64; 3]],
        interior: Interior,
        holes: &[[f64; 3]],
        control: &Control,
    ) -> Result<Result<(), Fault>, Error> {
        let mut first = None;
        for axis in self.axes(points) {
            match self.attempt(points, axis, interior, holes, control)? {
                Ok(()) => return Ok(Ok(())),
                Err(fault) => first = first.or((fault.kind != FaultKind::Degenerate).then_some(fault)),
            }
            if first.is_some() && self.is_planar(points, control)? {
                break;
            }
        }
        let Some(mut fault) = first else {
            return Ok(Err(Fault {
                kind: FaultKind::Degenerate,
                vertices: [self.vertices.first().copied().unwrap_or(INVALID); 4],
            }));
        };
        if self.is_warped(points, control)? {
            fault.kind = FaultKind::NonPlanar;
        }
        if fault.vertices[0] != INVALID {
            fault.vertices = fault.vertices.map(|v| self.vertices[v as usize]);
        }
        Ok(Err(fault))
    }

    /// Newell's normal of the edges of all bounding polygons, relative to the first vertex. Approximate.
    fn normal(&self, points: &[[f64; 3]]) -> [f64; 3] {
        let mut normal = [0.0; 3];
        let Some(&origin) = self.vertices.first() else { return normal };
        let at = |v: u32| {
            let (p, o) = (points[self.vertices[v as usize] as usize], points[origin as usize]);
            [p[0] - o[0], p[1] - o[1], p[2] - o[2]]
        };
        for &[u, v, polygon] in &self.input {
            if self.roles[polygon as usize] == Role::Outer {
                let (p, q) = (at(u), at(v));
                for k in 0..3 {
                    normal[k] += p[(k + 1) % 3] * q[(k + 2) % 3] - p[(k + 2) % 3] * q[(k + 1) % 3];
                }
            }
        }
        normal
    }

    /// The axes to project along, the most promising first.
    fn axes(&self, points: &[[f64; 3]]) -> [usize; 3] {
        by_size(&self.normal(points), [2, 1, 0])
    }

    /// Three vertices that are not collinear.
    fn frame(&self, points: &[[f64; 3]]) -> Option<[u32; 3]> {
        let (&a, &b) = (self.vertices.first()?, self.vertices.get(1)?);
        let c = self.vertices.iter().copied().find(|&c| !collinear(points, a, b, c))?;
        Some([a, b, c])
    }

    /// Whether all vertices lie exactly in one plane.
    fn is_planar(&self, points: &[[f64; 3]], control: &Control) -> Result<bool, Error> {
        let Some([a, b, c]) = self.frame(points) else { return Ok(true) };
        let at = |v: u32| &points[v as usize];
        for &d in &self.vertices {
            control.step()?;
            if orient3d(at(a), at(b), at(c), at(d)) != Sign::Zero {
                return Ok(false);
            }
        }
        Ok(true)
    }

    /// Whether the vertices are farther from a plane than rounding explains. Only the kind of a fault depends on it.
    fn is_warped(&self, points: &[[f64; 3]], control: &Control) -> Result<bool, Error> {
        let normal = self.normal(points);
        let length = normal.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length == 0.0 {
            return Ok(false);
        }
        let (mut low, mut high, mut size) = (f64::INFINITY, f64::NEG_INFINITY, 0f64);
        for &v in &self.vertices {
            let (p, o) = (points[v as usize], points[self.vertices[0] as usize]);
            let d = [p[0] - o[0], p[1] - o[1], p[2] - o[2]];
            let height = (0..3).map(|k| d[k] * normal[k] / length).sum::<f64>();
            low = low.min(height);
            high = high.max(height);
            size = d.iter().fold(size, |s, x| s.max(x.abs()));
        }
        Ok(high - low > 1e-6 * size && !self.is_planar(points, control)?)
    }

    /// One projection. Vertices of the fault are local.
    fn attempt(
        &mut self,
        points: &[[f64; 3]],
        axis: usize,
        interior: Interior,
        holes: &[[f64; 3]],
        control: &Control,
    ) -> Result<Result<(), Fault>, Error> {
        self.mesh.points.clear();
        fallible::extend(
            &mut self.mesh.points,
            self.vertices.iter().map(|&v| project(&points[v as usize], axis)),
        )?;
        if let Err(flaw) = self.mesh.build(control)? {
            let kind = if flaw == Flaw::Collinear { FaultKind::Degenerate } else { FaultKind::NonPlanar };
            return Ok(Err(Fault { kind, vertices: [INVALID; 4] }));
        }
        if let Err(fault) = self.insert_edges(points, control)? {
            return Ok(Err(fault));
        }
        self.seeds.clear();
        fallible::extend(&mut self.seeds, holes.iter().map(|p| project(p, axis)))?;
        let covers = &self.inserter.covers;
        let found = self.regions.classify(&self.mesh, covers, &self.roles, interior, &self.seeds, control)?;
        if let Err(fault) = found {
            return Ok(Err(fault));
        }
        let at = |v: u32| points[self.vertices[v as usize] as usize];
        metric::improve(&mut self.mesh, &self.regions.inside, axis, at, &mut self.stack, control)?;
        self.emit(interior, control)?;
        if self.triangles.is_empty() {
            return Ok(Err(Fault { kind: FaultKind::Degenerate, vertices: [INVALID; 4] }));
        }
        Ok(Ok(()))
    }

    fn insert_edges(&mut self, points: &[[f64; 3]], control: &Control) -> Result<Result<(), Fault>, Error> {
        self.inserter.clear();
        for &[u, v, polygon] in &self.input {
            match self.inserter.insert(&mut self.mesh, u, v, polygon, control)? {
                Ok(()) => {}
                Err(Obstacle::Crossing([a, b])) => {
                    return Ok(Err(Fault { kind: FaultKind::Crossing, vertices: [u, v, a, b] }));
                }
                Err(Obstacle::Broken) => {
                    return Ok(Err(Fault { kind: FaultKind::Broken, vertices: [u, v, u, v] }))
                }
            }
        }
        // A vertex that lies on an edge only in projection would bend it.
        let global = |v: u32| self.vertices[v as usize];
        for &[u, v, w] in &self.inserter.hits {
            control.step()?;
            if !collinear(points, global(u), global(v), global(w)) {
                return Ok(Err(Fault { kind: FaultKind::NonPlanar, vertices: [w; 4] }));
            }
        }
        Ok(Ok(()))
    }

    /// Stores the inner triangles and the constraining edges in the result.
    fn emit(&mut self, interior: Interior, control: &Control) -> Result<(), Error> {
        control.look()?;
        self.triangles.clear();
        self.edges.clear();
        self.triangles.try_reserve(self.regions.inside.iter().filter(|&&inside| inside).count())?;
        let global = |v: u32| self.vertices[v as usize];
        for t in 0..self.mesh.triangle_count() {
            if self.regions.inside[t as usize] {
                let [a, b, c] = self.mesh.corners(t).map(global);
                fallible::push(
                    &mut self.triangles,
                    if self.regions.counter_clockwise { [a, b, c] } else { [a, c, b] },
                )?;
            }
        }
        for h in 0..self.mesh.corner.len() as u32 {
            let g = self.mesh.twin[h as usize];
            if h > g || self.mesh.mark[h as usize] == INVALID || self.mesh.from(h) == GHOST {
                continue;
            }
            control.step()?;
            let inside = [h, g].map(|s| self.regions.inside[s as usize / 3]);
            let dangling = interior == Interior::Seeds && inside[0] == inside[1];
            if dangling || region::constrains(&self.mesh, &self.inserter.covers, &self.roles, h) {
                fallible::push(&mut self.edges, [global(self.mesh.from(h)), global(self.mesh.to(h))])?;
            }
        }
        Ok(())
    }
}

/// Drops a coordinate, such that a positive normal along the axis gives a counter-clockwise turn.
#[inline]
pub fn project(p: &[f64; 3], axis: usize) -> [f64; 2] {
    [p[(axis + 1) % 3], p[(axis + 2) % 3]]
}

/// Whether three points are exactly collinear.
pub fn collinear(points: &[[f64; 3]], a: u32, b: u32, c: u32) -> bool {
    (0..3).all(|axis| {
        let at = |v: u32| project(&points[v as usize], axis);
        orient2d(at(a), at(b), at(c)) == Sign::Zero
    })
}
