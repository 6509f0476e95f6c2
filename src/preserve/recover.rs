//! Recovery of edges and faces by reconnection: no point is added.
//!
//! After Liu, Chen & Chen 2007. A missing edge is opened by its corridor, a missing triangle (whose edges are there) by the
//! tetrahedra that cross it, cut in two halves by the triangle; a search fills the cavity anew with the edge or triangle in it. What
//! fails is tried again after the others, with more steps and with the obstacles taken away one by one: an edge in the
//! way is removed by filling its ring without it, if fewer obstacles are left then.
//!
//! Invariants: `edges` holds the surface's edges that the mesh has, flags the faces; neither is ever lost.
use super::cavity::{Cavity, Edges};
use super::corridor::{Corridor, Outcome};
use crate::constrain::cavity::RegionCavity;
use crate::constrain::edge_key;
use crate::constrain::segment::Segments;
use crate::delaunay::Delaunay;
use crate::error::Error;
use crate::mesh::star::{EdgeRing, StarSearch};
use crate::mesh::NONE;
use crate::predicates::{Expansion, Points, Sign};
use crate::reconnect::{Polyhedron, Reconnect, MOST_VERTICES};
use rustc_hash::FxHashMap;

/// Search steps per cavity in each round.
pub(super) const BUDGETS: [u32; 3] = [50, 200, 200];
/// Most faces of a cavity that is searched: the cost of a step grows with the square. (Larger ones may still be cones.)
const MOST_SEARCHED: usize = 60;

/// Most pieces of one segment; beyond, reconnection has failed.
const MOST_PIECES: u32 = 64;

/// The removal of an edge, for taking it back.
pub(super) struct Removal {
    /// Vertices of the tetrahedra that went.
    before: Vec<[u32; 4]>,
    /// Slots of those that came.
    after: Vec<u32>,
}

/// The state of a recovery.
pub struct Recovery<'a> {
    pub(super) delaunay: &'a mut Delaunay,
    /// The vertices.
    pub points: &'a mut Points,
    pub(super) edges: Edges,
    pub(super) cavity: Cavity,
    corridor: Corridor,
    pub(super) search: StarSearch,
    pub(super) crossed: RegionCavity,
    pub(super) reconnect: Reconnect,
    pub(super) tets: Vec<[u32; 4]>,
    /// Edges missing at the start.
    pub missing_edges: u64,
    /// Faces missing once all edges were there.
    pub missing_faces: u64,
    /// Edges and faces recovered without a point.
    pub recovered: u64,
    /// Edges recovered by points on them.
    pub split: u64,
    /// Faces recovered with points inside.
    pub by_points: u64,
    /// The points inside.
    pub inside: Vec<u32>,
}

impl<'a> Recovery<'a> {
    /// Prepares a recovery; `delaunay.vertex_tet` must be up to date.
    pub fn new(delaunay: &'a mut Delaunay, points: &'a mut Points) -> Self {
        Recovery {
            delaunay,
            points,
            edges: Edges::default(),
            cavity: Cavity::default(),
            corridor: Corridor::default(),
            search: StarSearch::default(),
            crossed: RegionCavity::default(),
            reconnect: Reconnect::default(),
            tets: Vec::new(),
            missing_edges: 0,
            missing_faces: 0,
            recovered: 0,
            split: 0,
            by_points: 0,
            inside: Vec::new(),
        }
    }

    /// Recovers edges by reconnection alone; returns the numbers of those it could not.
    pub fn edges(
        &mut self,
        edges: &[[u32; 2]],
        tick: &mut dyn FnMut(f64) -> Result<(), Error>,
    ) -> Result<Vec<u32>, Error> {
        let mut missing: Vec<u32> = Vec::new();
        self.edges.try_reserve(edges.len())?;
        for (i, &[a, b]) in edges.iter().enumerate() {
            if self.has_edge(a, b) {
                self.edges.insert(edge_key(a, b));
            } else {
                missing.try_reserve(1)?;
                missing.push(i as u32);
            }
        }
        self.missing_edges = missing.len() as u64;
        self.sort_by_length(edges, &mut missing);
        for (round, &budget) in BUDGETS.iter().enumerate() {
            let before = missing.len();
            let mut left = Vec::new();
            left.try_reserve(missing.len())?;
            for (i, &edge) in missing.iter().enumerate() {
                if i % 64 == 0 {
                    tick(1.0 - (before - i + left.len()) as f64 / edges.len().max(1) as f64)?;
                }
                if self.recover_edge(edges[edge as usize], budget, round > 0)? {
                    self.recovered += 1;
                } else {
                    left.push(edge);
                }
            }
            missing = left;
        }
        Ok(missing)
    }

    /// Makes every segment a union of edges by points on those that are missing. False if it was given up.
    pub fn split_missing(
        &mut self,
        segments: &mut Segments,
        tick: &mut dyn FnMut(f64) -> Result<(), Error>,
    ) -> Result<bool, Error> {
        let mut missing: Vec<u32> = Vec::new();
        for (i, piece) in segments.pieces.iter().enumerate() {
            if !self.edges.contains(&edge_key(piece.ends[0], piece.ends[1])) {
                missing.try_reserve(1)?;
                missing.push(i as u32);
            }
        }
        self.split += missing.len() as u64;
        let mut count: FxHashMap<u32, u32> = FxHashMap::default();
        while let Some(piece) = missing.pop() {
            tick(1.0)?;
            let sub = segments.pieces[piece as usize];
            if self.recover_edge(sub.ends, BUDGETS[1], true)? {
                continue;
            }
            let pieces = count.entry(sub.segment).or_insert(1);
            *pieces += 1;
            if *pieces > MOST_PIECES || !self.split(segments, piece)? {
                return Ok(false);
            }
            missing.try_reserve(2)?;
            missing.extend([segments.pieces.len() as u32 - 1, piece]);
        }
        Ok(true)
    }

    /// Puts a point in the middle of a missing piece.
    fn split(&mut self, segments: &mut Segments, piece: u32) -> Result<bool, Error> {
        let sub = segments.pieces[piece as usize];
        if self.corridor.collect(self.delaunay, self.points, sub.ends, &mut self.cavity)? != Outcome::Found {
            return Ok(false);
        }
        self.cavity.unmark(self.delaunay);
        let [a, b] = segments.ends[sub.segment as usize];
        let t = 0.5 * (sub.t[0] + sub.t[1]);
        if !(t > sub.t[0] && t < sub.t[1]) {
            return Ok(false);
        }
        let v = self.points.push_on_segment(a, b, &Expansion::from(t))?;
        self.delaunay.vertex_tet.try_reserve(1)?;
        self.delaunay.vertex_tet.push(NONE);
        // The tetrahedra whose closure has the point: it sees their boundary.
        let (mesh, points) = (&self.delaunay.mesh, &*self.points);
        self.cavity.tets.retain(|&t| {
            (0..4).all(|f| {
                let [x, y, z] = mesh.face(4 * t + f);
                points.orient3d(v, x, y, z) != Sign::Negative
            })
        });
        self.cavity.mark(self.delaunay);
        self.cavity.bound(self.delaunay, &self.edges)?;
        self.tets.clear();
        self.tets.try_reserve(self.cavity.faces.len())?;
        self.tets.extend(self.cavity.faces.iter().map(|&[x, y, z]| [v, x, y, z]));
        let fits = self.tets.iter().all(|&[v, x, y, z]| self.points.orient3d(v, x, y, z) == Sign::Positive);
        if !fits || !self.cavity.edges.is_empty() || !self.cavity.inner.is_empty() {
            return Ok(false);
        }
        self.cavity.replace(self.delaunay, &self.tets, &[])?;
        segments.add_steiner(piece, v, t)?;
        Ok(true)
    }

    /// Short edges first: their corridors are small, and what they fix stays out of the way of long ones.
    fn sort_by_length(&self, edges: &[[u32; 2]], pieces: &mut [u32]) {
        let length = |edge: u32| {
            let [p, q] = edges[edge as usize].map(|v| self.points.xyz(v));
            (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>()
        };
        pieces.sort_by(|&x, &y| length(x).total_cmp(&length(y)).then(x.cmp(&y)));
    }

    pub(super) fn has_edge(&mut self, a: u32, b: u32) -> bool {
        let start = self.delaunay.vertex_tet[a as usize];
        start != NONE && self.search.find_edge(&mut self.delaunay.mesh, a, b, start).is_some()
    }

    /// Makes `a b` an edge of the mesh, if it can.
    pub(super) fn recover_edge(
        &mut self,
        edge: [u32; 2],
        budget: u32,
        stubborn: bool,
    ) -> Result<bool, Error> {
        loop {
            match self.corridor.collect(self.delaunay, self.points, edge, &mut self.cavity)? {
                Outcome::Present => {
                    self.edges.insert(edge_key(edge[0], edge[1]));
                    return Ok(true);
                }
                Outcome::Blocked => return Ok(false),
                Outcome::Found => {}
            }
            self.cavity.bound(self.delaunay, &self.edges)?;
            self.cavity.edges.try_reserve(1)?;
            self.cavity.edges.push(edge);
            if self.refill(budget, None)? {
                continue;
            }
            if stubborn {
                self.cavity.grow(self.delaunay)?;
                self.cavity.bound(self.delaunay, &self.edges)?;
                self.cavity.edges.try_reserve(1)?;
                self.cavity.edges.push(edge);
                if self.refill(budget, None)? {
                    continue;
                }
                let Outcome::Found =
                    self.corridor.collect(self.delaunay, self.points, edge, &mut self.cavity)?
                else {
                    return Ok(false);
                };
                self.cavity.unmark(self.delaunay);
            }
            if !stubborn || !self.clear_way(edge, budget)? {
                return Ok(false);
            }
        }
    }

    /// Fills the bounded cavity and puts the filling in its place.
    fn refill(&mut self, budget: u32, without: Option<[u32; 2]>) -> Result<bool, Error> {
        self.tets.clear();
        let budget = if self.cavity.faces.len() > MOST_SEARCHED { 0 } else { budget };
        let polyhedron = Polyhedron {
            faces: &self.cavity.faces,
            inner: &self.cavity.inner,
            edges: &self.cavity.edges,
            without,
        };
        if !self.reconnect.fill(self.points, &polyhedron, budget, &mut self.tets)? {
            return Ok(false);
        }
        self.cavity.replace(self.delaunay, &self.tets, &[])?;
        Ok(true)
    }

    /// Removes one of the edges in the way of `edge` such that fewer are left.
    fn clear_way(&mut self, edge: [u32; 2], budget: u32) -> Result<bool, Error> {
        let mut obstacles = std::mem::take(&mut self.corridor.obstacles);
        for o in &mut obstacles {
            *o = edge_key(o[0], o[1]);
        }
        obstacles.sort_unstable();
        obstacles.dedup();
        let before = self.cavity.tets.len();
        for &obstacle in &obstacles {
            if self.edges.contains(&obstacle) || edge.iter().any(|v| obstacle.contains(v)) {
                continue;
            }
            let Some(undo) = self.remove_edge(obstacle, budget)? else { continue };
            let outcome = self.corridor.collect(self.delaunay, self.points, edge, &mut self.cavity)?;
            let after = if outcome == Outcome::Present { 0 } else { self.cavity.tets.len() };
            if outcome == Outcome::Found {
                self.cavity.unmark(self.delaunay);
            }
            if outcome != Outcome::Blocked && after < before {
                return Ok(true);
            }
            self.put_back(undo)?;
        }
        Ok(false)
    }

    /// Fills the ring of an edge without it.
    pub(super) fn remove_edge(&mut self, [p, q]: [u32; 2], budget: u32) -> Result<Option<Removal>, Error> {
        let start = self.delaunay.vertex_tet[p as usize];
        let Some(t) = self.search.find_edge(&mut self.delaunay.mesh, p, q, start) else { return Ok(None) };
        self.search.tets.clear();
        for (t, ..) in EdgeRing::new(&self.delaunay.mesh, t, p, q) {
            if self.delaunay.mesh.is_ghost(t) || self.search.tets.len() >= MOST_VERTICES {
                return Ok(None);
            }
            self.search.tets.try_reserve(1)?;
            self.search.tets.push(t);
        }
        self.cavity.clear();
        for &t in &self.search.tets {
            self.cavity.add(self.delaunay, t)?;
        }
        self.cavity.bound(self.delaunay, &self.edges)?;
        // A subface at the edge holds it.
        if self.cavity.faces.iter().any(|f| f.contains(&p) && f.contains(&q)) {
            return Ok(None);
        }
        let mut before = Vec::new();
        before.try_reserve(self.cavity.tets.len())?;
        before.extend(self.cavity.tets.iter().map(|&t| self.delaunay.mesh.verts[t as usize]));
        let removed = self.refill(budget, Some([p, q]))?;
        Ok(removed.then(|| Removal { before, after: self.cavity.refill.fresh.clone() }))
    }

    /// Undoes the last change of the mesh, the removal of an edge.
    pub(super) fn put_back(&mut self, removal: Removal) -> Result<(), Error> {
        self.cavity.tets = removal.after;
        self.cavity.replace(self.delaunay, &removal.before, &[])
    }

    /// Flags the triangle in the mesh if it is a face there.
    pub(super) fn mark_if_present(&mut self, corners: [u32; 3]) -> bool {
        let start = self.delaunay.vertex_tet[corners[0] as usize];
        let mesh = &mut self.delaunay.mesh;
        let found = self.search.find_face(mesh, corners, start);
        if let Some(code) = found {
            mesh.flag_face(code);
        }
        found.is_some()
    }
}
