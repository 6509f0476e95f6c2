//! Subfaces: the constrained Delaunay triangulation of every patch, including the Steiner points on its segments.
//!
//! A patch is an exactly coplanar set of triangles, so its subfaces in the final tetrahedralization are known in advance: they are the
//! two-dimensional constrained Delaunay triangulation with ties broken as in space. Lawson's flips (1977) make it from the triangulation
//! that comes with the PLC.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::edge_key;
use crate::kernel::NONE;
use crate::predicates::{Points, Sign};
use crate::segments::placement::distance;
use crate::segments::recovery::Segments;
use crate::vector::{by_size, cross, sub};

/// The triangulated patches.
#[derive(Default)]
pub struct Subfaces {
    /// Corners, positively oriented in the projection of the patch.
    pub verts: Vec<[u32; 3]>,
    /// Edge codes `3·t' + e'` across the edge opposite each corner; NONE across subsegments.
    pub adj: Vec<[u32; 3]>,
    /// The input facet.
    pub facet: Vec<u32>,
    /// The patch.
    pub patch: Vec<u32>,
    /// For each patch an axis along which its projection is a triangulation.
    axis: Vec<u8>,
}

/// Triangles in vertex ids of the engine, as [`crate::plc::surface::Surface`] has them.
pub struct Triangles<'a> {
    /// Corners.
    pub corners: &'a [[u32; 3]],
    /// Input facet of each.
    pub facet: &'a [u32],
    /// Patch of each.
    pub patch: &'a [u32],
    /// Number of patches.
    pub patch_count: usize,
}

impl Subfaces {
    /// Splits the triangles at the Steiner points of their segments and makes every patch constrained Delaunay.
    pub fn build(
        points: &Points,
        triangles: &Triangles,
        segments: &Segments,
        control: &Control,
    ) -> Result<Self, Error> {
        let mut subfaces = Subfaces::default();
        let steiner = segments.steiner_by_segment(control)?;
        let expected = triangles.corners.len() + 2 * steiner.len();
        subfaces.reserve(expected)?;
        subfaces.orient(points, triangles, control)?;
        let (edge_segment, lone) = subfaces.connect(segments, &[], control)?;
        if !lone.is_empty() {
            return Err(Error::internal("an edge without a segment does not have two triangles"));
        }
        subfaces.split_edges(points, segments, &steiner, &edge_segment, control)?;
        subfaces.make_delaunay(points, control)?;
        Ok(subfaces)
    }

    /// The same for polygons that are planar only up to rounding: each is a patch that projects well along its axis. `soft` segments do not
    /// divide patches. Edges are not made Delaunay. Also returns the patches that share edges which are not segments.
    pub(super) fn of_polygons(
        points: &Points,
        triangles: &Triangles,
        axis: Vec<u8>,
        segments: &Segments,
        soft: &[bool],
        control: &Control,
    ) -> Result<(Self, Vec<u32>), Error> {
        let mut subfaces = Subfaces { axis, ..Subfaces::default() };
        let steiner = segments.steiner_by_segment(control)?;
        subfaces.reserve(triangles.corners.len() + 2 * steiner.len())?;
        subfaces.orient(points, triangles, control)?;
        let (edge_segment, lone) = subfaces.connect(segments, soft, control)?;
        subfaces.split_edges(points, segments, &steiner, &edge_segment, control)?;
        let entangled: Vec<u32> = fallible::collect(lone.into_iter().map(|t| subfaces.patch[t as usize]))?;
        Ok((subfaces, entangled))
    }

    /// The projection axis of a patch.
    pub(super) fn axis(&self, patch: u32) -> usize {
        self.axis[patch as usize] as usize
    }

    /// Adds triangles, each as its own patch.
    pub fn add_single(
        &mut self,
        points: &Points,
        corners: &[[u32; 3]],
        facets: &[u32],
        control: &Control,
    ) -> Result<(), Error> {
        self.reserve(corners.len())?;
        self.axis.try_reserve(corners.len())?;
        for (&[a, b, c], &facet) in corners.iter().zip(facets) {
            control.step()?;
            let axis = projection_axis(points, [a, b, c])?;
            let turned = points.orient_in_plane(axis as usize, a, b, c) == Sign::Negative;
            fallible::push(&mut self.verts, if turned { [a, c, b] } else { [a, b, c] })?;
            fallible::push(&mut self.adj, [NONE; 3])?;
            fallible::push(&mut self.facet, facet)?;
            fallible::push(&mut self.patch, self.axis.len() as u32)?;
            fallible::push(&mut self.axis, axis)?;
        }
        Ok(())
    }

    /// Copies the triangles, oriented to be positive in a projection chosen per patch.
    fn orient(&mut self, points: &Points, triangles: &Triangles, control: &Control) -> Result<(), Error> {
        const UNKNOWN: u8 = 3;
        fallible::resize(&mut self.axis, triangles.patch_count, UNKNOWN)?;
        for (i, &corners) in triangles.corners.iter().enumerate() {
            control.step()?;
            let patch = triangles.patch[i];
            let axis = &mut self.axis[patch as usize];
            if *axis == UNKNOWN {
                *axis = projection_axis(points, corners)?;
            }
            let [a, b, c] = corners;
            let turned = match points.orient_in_plane(*axis as usize, a, b, c) {
                Sign::Positive => corners,
                Sign::Negative => [a, c, b],
                Sign::Zero => return Err(Error::internal("a triangle of a patch is not in its plane")),
            };
            fallible::push(&mut self.verts, turned)?;
            fallible::push(&mut self.adj, [NONE; 3])?;
            fallible::push(&mut self.facet, triangles.facet[i])?;
            fallible::push(&mut self.patch, patch)?;
        }
        Ok(())
    }

    /// Links triangles across edges that are not segments, or are `soft` ones; returns the segment of each constrained edge, and the
    /// triangles at other edges that do not have two triangles of one patch.
    fn connect(
        &mut self,
        segments: &Segments,
        soft: &[bool],
        control: &Control,
    ) -> Result<(Vec<[u32; 3]>, Vec<u32>), Error> {
        // (edge, 0, segment) sorts before (edge, 1, edge code) of the triangles with that edge.
        let mut entries: Vec<([u32; 2], u32, u32)> =
            fallible::reserved(3 * self.verts.len() + segments.ends.len())?;
        let mut lone: Vec<u32> = Vec::new();
        for (s, e) in segments.ends.iter().enumerate().filter(|x| soft.get(x.0) != Some(&true)) {
            fallible::push(&mut entries, (edge_key(e[0], e[1]), 0, s as u32))?;
        }
        for (t, v) in self.verts.iter().enumerate() {
            for e in 0..3 {
                fallible::push(
                    &mut entries,
                    (edge_key(v[(e + 1) % 3], v[(e + 2) % 3]), 1, (3 * t + e) as u32),
                )?;
            }
        }
        control.sort(&mut entries)?;
        let mut edge_segment = fallible::filled([NONE; 3], self.verts.len())?;
        for group in entries.chunk_by(|x, y| x.0 == y.0) {
            control.step()?;
            if group[0].1 == 0 {
                for &(_, _, code) in group.iter().filter(|entry| entry.1 == 1) {
                    edge_segment[(code / 3) as usize][(code % 3) as usize] = group[0].2;
                }
                continue;
            }
            match group {
                [x, y] if self.patch[x.2 as usize / 3] == self.patch[y.2 as usize / 3] => self.link(x.2, y.2),
                _ => {
                    fallible::extend(&mut lone, group.iter().map(|entry| entry.2 / 3))?;
                }
            }
        }
        Ok((edge_segment, lone))
    }

    fn link(&mut self, a: u32, b: u32) {
        if a != NONE {
            self.adj[(a / 3) as usize][(a % 3) as usize] = b;
        }
        if b != NONE {
            self.adj[(b / 3) as usize][(b % 3) as usize] = a;
        }
    }

    /// Splits the triangles' edges at the Steiner points of the segments.
    fn split_edges(
        &mut self,
        points: &Points,
        segments: &Segments,
        steiner: &[(u32, f64, u32)],
        edge_segment: &[[u32; 3]],
        control: &Control,
    ) -> Result<(), Error> {
        if steiner.is_empty() {
            return Ok(());
        }
        let mut chains: [Vec<u32>; 3] = Default::default();
        for (t, edges) in edge_segment.iter().enumerate() {
            control.step()?;
            for (e, chain) in chains.iter_mut().enumerate() {
                chain.clear();
                let s = edges[e];
                if s == NONE {
                    continue;
                }
                let first = steiner.partition_point(|x| x.0 < s);
                let on_edge = steiner[first..].iter().take_while(|x| x.0 == s).map(|x| x.2);
                fallible::extend(chain, on_edge)?;
                if self.verts[t][(e + 1) % 3] != segments.ends[s as usize][0] {
                    chain.reverse();
                }
            }
            if chains.iter().any(|chain| !chain.is_empty()) {
                self.split_triangle(points, t, &mut chains)?;
            }
        }
        Ok(())
    }

    /// Splits triangle `t` at points on its edges, given in the triangle's orientation.
    ///
    /// A strip joins the two edges with the most points from their common corner on, in order of the distance from it: this is nearly
    /// Delaunay even if a sliver's long sides have many points. The points of the third edge get a fan.
    fn split_triangle(&mut self, points: &Points, t: usize, chains: &mut [Vec<u32>; 3]) -> Result<(), Error> {
        let k = (0..3).min_by_key(|&e| chains[e].len()).unwrap_or(0);
        let (next, last) = ((k + 1) % 3, (k + 2) % 3);
        let [a, b, c] = [k, next, last].map(|e| self.verts[t][e]);
        let [across_bc, across_ca, across_ab] = [k, next, last].map(|e| self.adj[t][e]);
        let (mut left, mut right) = (std::mem::take(&mut chains[last]), std::mem::take(&mut chains[next]));
        fallible::push(&mut left, b)?;
        right.reverse();
        fallible::push(&mut right, c)?;
        let distance = |v: u32| distance(points.xyz(a), points.xyz(v));
        self.verts[t] = [a, left[0], right[0]];
        self.adj[t] = [NONE; 3];
        if left.len() == 1 {
            self.link(3 * t as u32 + 2, across_ab);
        }
        if right.len() == 1 {
            self.link(3 * t as u32 + 1, across_ca);
        }
        let (mut i, mut j) = (0, 0);
        // The edge from `left[i]` to `right[j]`, behind which the strip continues.
        let mut front = 3 * t as u32;
        while i + 1 < left.len() || j + 1 < right.len() {
            let on_left = j + 1 == right.len()
                || (i + 1 < left.len() && distance(left[i + 1]) <= distance(right[j + 1]));
            let (corners, edge) = if on_left {
                ([left[i], left[i + 1], right[j]], 0)
            } else {
                ([left[i], right[j + 1], right[j]], 2)
            };
            i += on_left as usize;
            j += !on_left as usize;
            let n = self.push_piece(t, corners)?;
            self.link(front, 3 * n + 1);
            front = 3 * n + edge;
        }
        if chains[k].is_empty() {
            self.link(front, across_bc);
        } else {
            self.split_edge((front / 3) as usize, (front % 3) as usize, &chains[k])?;
        }
        left.clear();
        right.clear();
        (chains[last], chains[next]) = (left, right);
        Ok(())
    }

    /// Makes room for more triangles.
    fn reserve(&mut self, count: usize) -> Result<(), Error> {
        self.verts.try_reserve(count)?;
        self.adj.try_reserve(count)?;
        self.facet.try_reserve(count)?;
        self.patch.try_reserve(count)?;
        Ok(())
    }

    /// Appends a triangle of the same facet as `t`, without neighbours.
    fn push_piece(&mut self, t: usize, corners: [u32; 3]) -> Result<u32, Error> {
        let n = self.verts.len() as u32;
        fallible::push(&mut self.verts, corners)?;
        fallible::push(&mut self.adj, [NONE; 3])?;
        let (facet, patch) = (self.facet[t], self.patch[t]);
        fallible::push(&mut self.facet, facet)?;
        fallible::push(&mut self.patch, patch)?;
        Ok(n)
    }

    /// Splits triangle `t` into a fan at points on its edge `k`, given in the edge's direction.
    fn split_edge(&mut self, t: usize, k: usize, chain: &[u32]) -> Result<(), Error> {
        let (start_slot, end_slot) = ((k + 1) % 3, (k + 2) % 3);
        let apex = self.verts[t][k];
        let end = self.verts[t][end_slot];
        let following = self.adj[t][start_slot];
        self.verts[t][end_slot] = chain[0];
        let mut previous = (3 * t + start_slot) as u32;
        for i in 0..chain.len() {
            let next = chain.get(i + 1).copied().unwrap_or(end);
            let n = self.push_piece(t, [apex, chain[i], next])?;
            // Edge 2 of the new piece (apex → chain[i]) faces the previous one; edge 1 (next → apex) the following one.
            self.link(previous, 3 * n + 2);
            previous = 3 * n + 1;
        }
        self.link(previous, following);
        Ok(())
    }

    /// Lawson's algorithm over all edges that are not subsegments.
    fn make_delaunay(&mut self, points: &Points, control: &Control) -> Result<(), Error> {
        let mut stack: Vec<u32> = fallible::reserved(self.verts.len() * 2)?;
        for t in 0..self.verts.len() as u32 {
            for e in 0..3 {
                let n = self.adj[t as usize][e as usize];
                if n != NONE && n / 3 > t {
                    fallible::push(&mut stack, 3 * t + e)?;
                }
            }
        }
        while let Some(code) = stack.pop() {
            control.step()?;
            let (t, i) = ((code / 3) as usize, (code % 3) as usize);
            let other = self.adj[t][i];
            if other == NONE {
                continue;
            }
            let (n, j) = ((other / 3) as usize, (other % 3) as usize);
            let (a, b, c) = (self.verts[t][i], self.verts[t][(i + 1) % 3], self.verts[t][(i + 2) % 3]);
            let d = self.verts[n][j];
            let axis = self.axis[self.patch[t] as usize] as usize;
            if points.incircle_in_plane(axis, a, b, c, d) != Sign::Positive {
                continue;
            }
            self.turn(code);
            let [ti, t2, nj, n2] = self.quadrilateral(code);
            fallible::extend(&mut stack, [ti, t2, nj, n2])?;
        }
        Ok(())
    }

    /// The other diagonal of an edge's quadrilateral, to which the edge can be flipped; `None` unless the quadrilateral is strictly convex.
    pub fn other_diagonal(&self, points: &Points, code: u32) -> Option<[u32; 2]> {
        let (t, i) = ((code / 3) as usize, (code % 3) as usize);
        let other = self.adj[t][i];
        if other == NONE {
            return None;
        }
        let (n, j) = ((other / 3) as usize, (other % 3) as usize);
        let [a, b, c] = [0, 1, 2].map(|k| self.verts[t][(i + k) % 3]);
        let d = self.verts[n][j];
        let axis = self.axis[self.patch[t] as usize] as usize;
        let convex = points.orient_in_plane(axis, a, b, d) == Sign::Positive
            && points.orient_in_plane(axis, d, c, a) == Sign::Positive;
        convex.then_some([a, d])
    }

    /// Collects the subfaces connected to `s` through edges missing from the mesh, except those `present`; marks them in `in_region`, which
    /// must be clear.
    pub fn collect_region(
        &self,
        s: u32,
        present: &[bool],
        in_region: &mut [bool],
        region: &mut Vec<u32>,
        control: &Control,
        mut has_edge: impl FnMut([u32; 2]) -> Result<bool, Error>,
    ) -> Result<(), Error> {
        region.clear();
        fallible::push(region, s)?;
        in_region[s as usize] = true;
        let mut next = 0;
        while next < region.len() {
            let t = region[next] as usize;
            next += 1;
            control.step()?;
            for e in 0..3 {
                let n = self.adj[t][e];
                if n == NONE || in_region[(n / 3) as usize] || present[(n / 3) as usize] {
                    continue;
                }
                let v = self.verts[t];
                if !has_edge([v[(e + 1) % 3], v[(e + 2) % 3]])? {
                    in_region[(n / 3) as usize] = true;
                    fallible::push(region, n / 3)?;
                }
            }
        }
        Ok(())
    }

    /// Whether the edge between two triangles crosses the open segment between two vertices of the patch.
    pub fn crosses(&self, points: &Points, code: u32, [p, q]: [u32; 2]) -> bool {
        let (t, i) = ((code / 3) as usize, (code % 3) as usize);
        let (x, y) = (self.verts[t][(i + 1) % 3], self.verts[t][(i + 2) % 3]);
        if self.adj[t][i] == NONE || [p, q].contains(&x) || [p, q].contains(&y) {
            return false;
        }
        let axis = self.axis[self.patch[t] as usize] as usize;
        let apart = |a, b, c, d| {
            let side = points.orient_in_plane(axis, a, b, c);
            side != Sign::Zero && points.orient_in_plane(axis, a, b, d) == -side
        };
        apart(p, q, x, y) && apart(x, y, p, q)
    }

    /// Flips an edge between two triangles to the other diagonal of their quadrilateral, which must be convex.
    pub fn turn(&mut self, code: u32) {
        let (t, i) = ((code / 3) as usize, (code % 3) as usize);
        let other = self.adj[t][i];
        let (n, j) = ((other / 3) as usize, (other % 3) as usize);
        let (a, d) = (self.verts[t][i], self.verts[n][j]);
        // (a b c) + (d c b) → (a b d) + (d c a)
        let (beyond_ca, beyond_bd) = (self.adj[t][(i + 1) % 3], self.adj[n][(j + 1) % 3]);
        self.verts[t][(i + 2) % 3] = d;
        self.verts[n][(j + 2) % 3] = a;
        self.adj[t][i] = NONE;
        self.adj[n][j] = NONE;
        self.link(code, beyond_bd);
        self.link(other, beyond_ca);
        let (t1, n1) = (3 * t as u32 + ((i + 1) % 3) as u32, 3 * n as u32 + ((j + 1) % 3) as u32);
        self.link(t1, n1);
    }

    /// The outer edges of the two triangles whose common edge was flipped by this code.
    pub(super) fn quadrilateral(&self, code: u32) -> [u32; 4] {
        let (t, i) = (code / 3, code % 3);
        let inner = self.adj[t as usize][((i + 1) % 3) as usize];
        let (n, j) = (inner / 3, inner % 3);
        [code, 3 * t + (i + 2) % 3, 3 * n + (j + 2) % 3, 3 * n + (j + 1) % 3]
    }
}

/// The axis along which the triangle's projection is largest, as far as doubles tell, and certainly not flat.
fn projection_axis(points: &Points, [a, b, c]: [u32; 3]) -> Result<u8, Error> {
    let (p, q, r) = (points.xyz(a), points.xyz(b), points.xyz(c));
    let normal = cross(&sub(q, p), &sub(r, p));
    by_size(&normal, [0, 1, 2])
        .into_iter()
        .find(|&axis| points.orient_in_plane(axis, a, b, c) != Sign::Zero)
        .map(|axis| axis as u8)
        .ok_or_else(|| Error::internal("a triangle is degenerate"))
}
