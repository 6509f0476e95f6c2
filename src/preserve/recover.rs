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
use super::place::place;
use crate::constrain::edge_key;
use crate::constrain::segment::Segments;
use crate::constrain::subface::Subfaces;
use crate::delaunay::Delaunay;
use crate::error::Error;
use crate::mesh::star::{EdgeRing, StarSearch};
use crate::mesh::{flag, NONE};
use crate::predicates::{Expansion, Points, Sign};
use crate::reconnect::{Polyhedron, Reconnect, MOST_VERTICES};
use rustc_hash::FxHashMap;

/// Search steps per cavity in each round.
const BUDGETS: [u32; 3] = [50, 200, 200];
/// Most faces of a cavity that is searched: the cost of a step grows with the square. (Larger ones may still be cones.)
const MOST_SEARCHED: usize = 60;

/// Most pieces of one segment; beyond, reconnection has failed.
const MOST_PIECES: u32 = 64;

/// The state of a recovery.
pub struct Recovery<'a> {
    delaunay: &'a mut Delaunay,
    /// The vertices.
    pub points: &'a mut Points,
    edges: Edges,
    cavity: Cavity,
    corridor: Corridor,
    search: StarSearch,
    reconnect: Reconnect,
    tets: Vec<[u32; 4]>,
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

    /// Makes every subface a face. False if it was given up.
    pub fn faces(
        &mut self,
        subfaces: &mut Subfaces,
        tick: &mut dyn FnMut(f64) -> Result<(), Error>,
    ) -> Result<bool, Error> {
        self.conform(subfaces)?;
        self.inner_edges(subfaces)?;
        self.conform(subfaces)?;
        let count = subfaces.verts.len();
        let mut present = Vec::new();
        present.try_reserve(count)?;
        present.extend(subfaces.verts.iter().map(|&triangle| self.mark_if_present(triangle)));
        self.missing_faces = present.iter().filter(|&&p| !p).count() as u64;
        let mut in_region = Vec::new();
        in_region.try_reserve(count)?;
        in_region.resize(count, false);
        let mut region = Vec::new();
        for (round, &budget) in BUDGETS.iter().enumerate() {
            for s in 0..count {
                if s % 1024 == 0 {
                    tick((round as f64 + s as f64 / count as f64) / BUDGETS.len() as f64)?;
                }
                if present[s] || self.mark_if_present(subfaces.verts[s]) {
                    present[s] = true;
                    continue;
                }
                self.collect_region(subfaces, s as u32, &present, &mut in_region, &mut region)?;
                if region.len() > 1 && self.conform_region(subfaces, &region)? {
                    for &r in &region {
                        in_region[r as usize] = false;
                        present[r as usize] = self.mark_if_present(subfaces.verts[r as usize]);
                    }
                    if present[s] {
                        continue;
                    }
                    self.collect_region(subfaces, s as u32, &present, &mut in_region, &mut region)?;
                }
                let corners: Vec<[u32; 3]> = region.iter().map(|&r| subfaces.verts[r as usize]).collect();
                let done = self.recover_region(&corners, budget, round > 0, round + 1 == BUDGETS.len())?;
                for &r in &region {
                    in_region[r as usize] = false;
                    present[r as usize] |= done;
                }
                self.recovered += if done { region.len() as u64 } else { 0 };
            }
        }
        Ok(present.iter().all(|&p| p))
    }

    /// Recovers edges between subfaces, as far as reconnection goes.
    fn inner_edges(&mut self, subfaces: &Subfaces) -> Result<(), Error> {
        let mut missing: Vec<[u32; 2]> = Vec::new();
        for code in 0..3 * subfaces.verts.len() {
            let (v, i) = (subfaces.verts[code / 3], code % 3);
            let (b, c) = (v[(i + 1) % 3], v[(i + 2) % 3]);
            if subfaces.adj[code / 3][i] != NONE && b < c && !self.has_edge(b, c) {
                missing.try_reserve(1)?;
                missing.push([b, c]);
            }
        }
        for (round, &budget) in BUDGETS.iter().enumerate() {
            let mut left = Vec::new();
            left.try_reserve(missing.len())?;
            for &edge in &missing {
                if !self.recover_edge(edge, budget, round > 0)? {
                    left.push(edge);
                }
            }
            missing = left;
        }
        Ok(())
    }

    /// Turns edges between subfaces that the mesh lacks where it has the other diagonal: the search for tetrahedra that cross a region
    /// relies on edges in the plane being those of the subfaces.
    fn conform(&mut self, subfaces: &mut Subfaces) -> Result<(), Error> {
        let mut changed = true;
        while changed {
            changed = false;
            for code in 0..3 * subfaces.verts.len() as u32 {
                let (t, i) = ((code / 3) as usize, (code % 3) as usize);
                if subfaces.adj[t][i] == NONE {
                    continue;
                }
                let (b, c) = (subfaces.verts[t][(i + 1) % 3], subfaces.verts[t][(i + 2) % 3]);
                if self.has_edge(b, c) {
                    continue;
                }
                let Some([a, d]) = subfaces.other_diagonal(self.points, code) else { continue };
                if self.has_edge(a, d) {
                    subfaces.turn(code);
                    changed = true;
                }
            }
        }
        Ok(())
    }

    /// Turns edges between the subfaces of a region until it has all edges of the mesh between its vertices; true if any was turned.
    /// (Sloan 1993; edges of the mesh do not cross each other.)
    fn conform_region(&mut self, subfaces: &mut Subfaces, region: &[u32]) -> Result<bool, Error> {
        let mut vertices: Vec<u32> = Vec::new();
        vertices.try_reserve(3 * region.len())?;
        vertices.extend(region.iter().flat_map(|&r| subfaces.verts[r as usize]));
        vertices.sort_unstable();
        vertices.dedup();
        let mut any = false;
        for (i, &p) in vertices.iter().enumerate() {
            for &q in &vertices[i + 1..] {
                if !self.has_edge(p, q) {
                    continue;
                }
                for _ in 0..region.len() * region.len() {
                    let crossing = region.iter().flat_map(|&r| 3 * r..3 * r + 3).find(|&code| {
                        subfaces.crosses(self.points, code, [p, q])
                            && subfaces.other_diagonal(self.points, code).is_some()
                    });
                    let Some(code) = crossing else { break };
                    subfaces.turn(code);
                    any = true;
                }
            }
        }
        Ok(any)
    }

    /// The missing subfaces connected to `s` through edges that the mesh lacks.
    fn collect_region(
        &mut self,
        subfaces: &Subfaces,
        s: u32,
        present: &[bool],
        in_region: &mut [bool],
        region: &mut Vec<u32>,
    ) -> Result<(), Error> {
        region.clear();
        region.push(s);
        in_region[s as usize] = true;
        let mut next = 0;
        while next < region.len() {
            let t = region[next] as usize;
            next += 1;
            region.try_reserve(3)?;
            for e in 0..3 {
                let n = subfaces.adj[t][e];
                if n == NONE || in_region[(n / 3) as usize] || present[(n / 3) as usize] {
                    continue;
                }
                let v = subfaces.verts[t];
                if !self.has_edge(v[(e + 1) % 3], v[(e + 2) % 3]) {
                    in_region[(n / 3) as usize] = true;
                    region.push(n / 3);
                }
            }
        }
        Ok(())
    }

    /// Short edges first: their corridors are small, and what they fix stays out of the way of long ones.
    fn sort_by_length(&self, edges: &[[u32; 2]], pieces: &mut [u32]) {
        let length = |edge: u32| {
            let [p, q] = edges[edge as usize].map(|v| self.points.xyz(v));
            (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>()
        };
        pieces.sort_by(|&x, &y| length(x).total_cmp(&length(y)).then(x.cmp(&y)));
    }

    fn has_edge(&mut self, a: u32, b: u32) -> bool {
        let start = self.delaunay.vertex_tet[a as usize];
        start != NONE && self.search.find_edge(&mut self.delaunay.mesh, a, b, start).is_some()
    }

    /// Makes `a b` an edge of the mesh, if it can.
    fn recover_edge(&mut self, edge: [u32; 2], budget: u32, stubborn: bool) -> Result<bool, Error> {
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
            self.put_back(&undo)?;
        }
        Ok(false)
    }

    /// Fills the ring of an edge without it; returns the tetrahedra before and after.
    fn remove_edge(&mut self, [p, q]: [u32; 2], budget: u32) -> Result<Option<[Vec<[u32; 4]>; 2]>, Error> {
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
        Ok(self.refill(budget.min(500), Some([p, q]))?.then(|| [before, self.tets.clone()]))
    }

    /// Undoes the last removal of an edge.
    fn put_back(&mut self, [before, after]: &[Vec<[u32; 4]>; 2]) -> Result<(), Error> {
        self.cavity.clear();
        for v in after {
            let mut sorted = *v;
            sorted.sort_unstable();
            let start = self.delaunay.vertex_tet[v[0] as usize];
            self.search.vertex_star(&mut self.delaunay.mesh, v[0], start);
            let found = self.search.tets.iter().copied().find(|&t| {
                let mut w = self.delaunay.mesh.verts[t as usize];
                w.sort_unstable();
                w == sorted
            });
            let Some(t) = found else { return Err(Error::internal("a tetrahedron to be put back is gone")) };
            // No marks: the search of the next star needs them.
            self.cavity.tets.try_reserve(1)?;
            self.cavity.tets.push(t);
        }
        self.cavity.replace(self.delaunay, before, &[])
    }

    /// Flags the triangle in the mesh if it is a face there.
    fn mark_if_present(&mut self, [a, b, c]: [u32; 3]) -> bool {
        let start = self.delaunay.vertex_tet[a as usize];
        let Some(t) = self.search.find_edge(&mut self.delaunay.mesh, a, b, start) else { return false };
        let mesh = &mut self.delaunay.mesh;
        let hit =
            EdgeRing::new(mesh, t, a, b).find(|&(t, _, _, _, l)| mesh.verts[t as usize][l as usize] == c);
        let Some((t, _, _, k, _)) = hit else { return false };
        let other = mesh.adj[t as usize][k as usize];
        mesh.flags[t as usize] |= flag::FACE << k;
        mesh.flags[(other >> 2) as usize] |= flag::FACE << (other & 3);
        true
    }

    /// Makes the triangles of a region, whose boundary edges are in the mesh, faces.
    fn recover_region(
        &mut self,
        region: &[[u32; 3]],
        budget: u32,
        stubborn: bool,
        last: bool,
    ) -> Result<bool, Error> {
        loop {
            let mut all = true;
            for &triangle in region {
                all &= self.mark_if_present(triangle);
            }
            if all {
                return Ok(true);
            }
            if !self.collect_crossing(region)? {
                return Ok(false);
            }
            self.cavity.bound(self.delaunay, &self.edges)?;
            if self.fill_halves(region, budget, false)? {
                continue;
            }
            if !stubborn {
                return Ok(false);
            }
            if !self.clear_region(region, budget)? {
                return if last { self.fill_with_points(region, budget) } else { Ok(false) };
            }
        }
    }

    /// Which side of the region's plane a vertex is on.
    fn side(&self, region: &[[u32; 3]], v: u32) -> Sign {
        let [a, b, c] = region[0];
        if region.iter().any(|r| r.contains(&v)) {
            Sign::Zero
        } else {
            self.points.orient3d(a, b, c, v)
        }
    }

    /// A tetrahedron that the region enters from an edge of its boundary.
    fn find_crossing(&mut self, region: &[[u32; 3]]) -> Result<Option<u32>, Error> {
        for corners in region {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let start = self.delaunay.vertex_tet[a as usize];
                let Some(t) = self.search.find_edge(&mut self.delaunay.mesh, a, b, start) else { continue };
                let mesh = &self.delaunay.mesh;
                // Seen along a → b the region lies at angle 0; the positive tetrahedron (a, b, x, y) turns from x to y, and passes
                // angle 0 exactly if x is below the plane and y above.
                let found = EdgeRing::new(mesh, t, a, b).find(|&(t, _, _, k, l)| {
                    let v = mesh.verts[t as usize];
                    !mesh.is_ghost(t)
                        && self.side(region, v[k as usize]) == Sign::Negative
                        && self.side(region, v[l as usize]) == Sign::Positive
                });
                if let Some((t, ..)) = found {
                    return Ok(Some(t));
                }
            }
        }
        Ok(None)
    }

    /// Collects the tetrahedra that cross the region in the cavity; false if one cannot be opened.
    fn collect_crossing(&mut self, region: &[[u32; 3]]) -> Result<bool, Error> {
        self.cavity.clear();
        let Some(first) = self.find_crossing(region)? else { return Ok(false) };
        self.cavity.add(self.delaunay, first)?;
        let mut next = 0;
        while next < self.cavity.tets.len() {
            let t = self.cavity.tets[next];
            next += 1;
            for f in 0..4u32 {
                let mesh = &self.delaunay.mesh;
                let n = mesh.adj[t as usize][f as usize] >> 2;
                if mesh.flags[n as usize] & flag::MARK != 0 {
                    continue;
                }
                let sides = mesh.face(4 * t + f).map(|v| self.side(region, v));
                if !(sides.contains(&Sign::Positive) && sides.contains(&Sign::Negative)) {
                    continue;
                }
                if mesh.flags[t as usize] & (flag::FACE << f) != 0 || mesh.is_ghost(n) {
                    self.cavity.unmark(self.delaunay);
                    return Ok(false);
                }
                self.cavity.add(self.delaunay, n)?;
            }
        }
        Ok(true)
    }

    /// Opens the region once more and fills its halves with the help of points inside.
    fn fill_with_points(&mut self, region: &[[u32; 3]], budget: u32) -> Result<bool, Error> {
        if !self.collect_crossing(region)? {
            return Ok(false);
        }
        self.cavity.bound(self.delaunay, &self.edges)?;
        if !self.fill_halves(region, budget, true)? {
            return Ok(false);
        }
        self.by_points += region.len() as u64;
        for &triangle in region {
            if !self.mark_if_present(triangle) {
                return Err(Error::internal("a filled region has a missing subface"));
            }
        }
        Ok(true)
    }

    /// A new point that sees all the faces, joined to them.
    fn star_point(&mut self, faces: &[[u32; 3]]) -> Result<bool, Error> {
        let mut from = [0.0; 3];
        for face in faces {
            for v in face {
                let p = self.points.xyz(*v);
                from = [0, 1, 2].map(|k| from[k] + p[k] / (3 * faces.len()) as f64);
            }
        }
        let p = self.points.push(from)?;
        if !place(self.points, p, faces, from, &[])? {
            self.points.truncate(p as usize);
            return Ok(false);
        }
        self.delaunay.vertex_tet.try_reserve(1)?;
        self.delaunay.vertex_tet.push(NONE);
        self.inside.try_reserve(1)?;
        self.inside.push(p);
        self.tets.try_reserve(faces.len())?;
        self.tets.extend(faces.iter().map(|&[x, y, z]| [p, x, y, z]));
        Ok(true)
    }

    /// Fills both sides of the region in the bounded cavity; with points inside, if `help` allows them.
    fn fill_halves(&mut self, region: &[[u32; 3]], budget: u32, help: bool) -> Result<bool, Error> {
        self.tets.clear();
        let known = self.inside.len();
        for above in [true, false] {
            let wanted = if above { Sign::Positive } else { Sign::Negative };
            let on_side = |v: &u32| self.side(region, *v) == wanted;
            let mut faces: Vec<[u32; 3]> =
                self.cavity.faces.iter().filter(|f| f.iter().any(on_side)).copied().collect();
            // (p, x, y, z) is positive for p inside.
            faces.extend(region.iter().map(|&[a, b, c]| if above { [a, c, b] } else { [a, b, c] }));
            let edges: Vec<[u32; 2]> =
                self.cavity.edges.iter().filter(|e| e.iter().any(on_side)).copied().collect();
            let mut inner: Vec<u32> = Vec::new();
            for &t in &self.cavity.tets {
                let verts = self.delaunay.mesh.verts[t as usize];
                inner.extend(verts.iter().filter(|v| on_side(v)));
            }
            inner.sort_unstable();
            inner.dedup();
            inner.retain(|v| !faces.iter().any(|f| f.contains(v)));
            let polyhedron = Polyhedron { faces: &faces, inner: &inner, edges: &edges, without: None };
            if self.reconnect.fill(self.points, &polyhedron, budget, &mut self.tets)? {
                continue;
            }
            if !help || !inner.is_empty() || !edges.is_empty() || !self.star_point(&faces)? {
                for _ in known..self.inside.len() {
                    self.inside.pop();
                    self.delaunay.vertex_tet.pop();
                    self.points.truncate(self.points.len() - 1);
                }
                return Ok(false);
            }
        }
        self.cavity.replace(self.delaunay, &self.tets, region)?;
        Ok(true)
    }

    /// Removes one of the edges that pierce the region's plane in the cavity such that fewer tetrahedra cross the region.
    fn clear_region(&mut self, region: &[[u32; 3]], budget: u32) -> Result<bool, Error> {
        let before = self.cavity.tets.len();
        let mut piercing: Vec<[u32; 2]> = Vec::new();
        for &t in &self.cavity.tets {
            let v = self.delaunay.mesh.verts[t as usize];
            let sides = v.map(|w| self.side(region, w));
            for i in 0..4 {
                for j in 0..i {
                    if sides[i] != Sign::Zero && sides[i] == -sides[j] {
                        piercing.push(edge_key(v[i], v[j]));
                    }
                }
            }
        }
        piercing.sort_unstable();
        piercing.dedup();
        for edge in piercing {
            if self.edges.contains(&edge) {
                continue;
            }
            let Some(undo) = self.remove_edge(edge, budget)? else { continue };
            let open = self.collect_crossing(region)?;
            let after = self.cavity.tets.len();
            if open {
                self.cavity.unmark(self.delaunay);
            }
            if (!open && self.cavity.tets.is_empty()) || (open && after < before) {
                return Ok(true);
            }
            self.put_back(&undo)?;
        }
        Ok(false)
    }
}
