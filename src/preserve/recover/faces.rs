//! Recovery of faces: regions of missing subfaces.
//!
//! A region is a set of missing subfaces of one patch joined by edges that the mesh lacks. Its boundary edges are in the mesh. The
//! tetrahedra that cross it are cut in two halves by the region, and each half is filled by search. What cannot be filled is
//! tried again when edges that pierce the region are gone, and at last with a point inside that sees the whole half.
//!
//! First the subfaces get all edges that the mesh has in their plane: otherwise the search for tetrahedra that cross the region would miss
//! those with a face in the plane.
use crate::error::Error;
use crate::facets::cavity::Opening;
use crate::facets::subface::Subfaces;
use crate::fallible;
use crate::kernel::cavity::Terms;
use crate::kernel::edge_key;
use crate::kernel::NONE;
use crate::ops::place::place;
use crate::ops::reconnect::Polyhedron;
use crate::predicates::Sign;
use crate::preserve::recover::edges::{Recovery, BUDGETS, PIERCING};
use crate::progress::Phase;

/// Most edges that are tried for one region in turn. None of the models measured reaches it.
const MOST_PIERCING: usize = 100;

impl Recovery<'_> {
    /// Makes every subface a face. False if it was given up.
    pub fn faces(&mut self, subfaces: &mut Subfaces) -> Result<bool, Error> {
        self.conform(subfaces)?;
        self.inner_edges(subfaces)?;
        self.conform(subfaces)?;
        let count = subfaces.verts.len();
        let mut present = fallible::reserved(count)?;
        for &triangle in &subfaces.verts {
            self.control.step()?;
            fallible::push(&mut present, self.mark_if_present(triangle)?)?;
        }
        self.missing_faces = present.iter().filter(|&&p| !p).count() as u64;
        let mut in_region = fallible::filled(false, count)?;
        let mut region = Vec::new();
        for (round, &budget) in BUDGETS.iter().enumerate() {
            for s in 0..count {
                if s % 1024 == 0 {
                    let done = (round as f64 + s as f64 / count as f64) / BUDGETS.len() as f64;
                    self.control.progress(Phase::Facets, done)?;
                }
                self.control.step()?;
                if present[s] || self.mark_if_present(subfaces.verts[s])? {
                    present[s] = true;
                    continue;
                }
                self.collect_region(subfaces, s as u32, &present, &mut in_region, &mut region)?;
                if region.len() > 1 && self.conform_region(subfaces, &region)? {
                    for &r in &region {
                        in_region[r as usize] = false;
                        present[r as usize] = self.mark_if_present(subfaces.verts[r as usize])?;
                    }
                    if present[s] {
                        continue;
                    }
                    self.collect_region(subfaces, s as u32, &present, &mut in_region, &mut region)?;
                }
                let corners: Vec<[u32; 3]> =
                    fallible::collect(region.iter().map(|&r| subfaces.verts[r as usize]))?;
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
            self.control.step()?;
            let (v, i) = (subfaces.verts[code / 3], code % 3);
            let (b, c) = (v[(i + 1) % 3], v[(i + 2) % 3]);
            if subfaces.adj[code / 3][i] != NONE && b < c && !self.has_edge(b, c)? {
                fallible::push(&mut missing, [b, c])?;
            }
        }
        for round in self.rounds {
            let mut left = fallible::reserved(missing.len())?;
            for &edge in &missing {
                if !self.recover_edge(edge, round)? {
                    fallible::push(&mut left, edge)?;
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
                self.control.step()?;
                let (t, i) = ((code / 3) as usize, (code % 3) as usize);
                if subfaces.adj[t][i] == NONE {
                    continue;
                }
                let (b, c) = (subfaces.verts[t][(i + 1) % 3], subfaces.verts[t][(i + 2) % 3]);
                if self.has_edge(b, c)? {
                    continue;
                }
                let Some([a, d]) = subfaces.other_diagonal(self.points, code) else { continue };
                if self.has_edge(a, d)? {
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
        let mut vertices: Vec<u32> = fallible::reserved(3 * region.len())?;
        fallible::extend(&mut vertices, region.iter().flat_map(|&r| subfaces.verts[r as usize]))?;
        vertices.sort_unstable();
        vertices.dedup();
        let mut any = false;
        for (i, &p) in vertices.iter().enumerate() {
            for &q in &vertices[i + 1..] {
                self.control.step()?;
                if !self.has_edge(p, q)? {
                    continue;
                }
                for _ in 0..region.len() * region.len() {
                    self.control.step()?;
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

    /// Collects the missing subfaces connected to `s` through edges missing from the mesh.
    fn collect_region(
        &mut self,
        subfaces: &Subfaces,
        s: u32,
        present: &[bool],
        in_region: &mut [bool],
        region: &mut Vec<u32>,
    ) -> Result<(), Error> {
        let control = self.control;
        subfaces.collect_region(s, present, in_region, region, control, |[a, b]| self.has_edge(a, b))
    }

    /// Makes the triangles of a region, whose boundary edges are in the mesh, faces.
    fn recover_region(
        &mut self,
        region: &[[u32; 3]],
        budget: u32,
        stubborn: bool,
        last: bool,
    ) -> Result<bool, Error> {
        self.crossed.begin(self.points, region)?;
        loop {
            let mut all = true;
            for &triangle in region {
                all &= self.mark_if_present(triangle)?;
            }
            if all {
                return Ok(true);
            }
            if self.collect_crossing(region)? != Opening::Found {
                return Ok(false);
            }
            self.cavity.bound(self.mesh, &Terms::keep(&self.edges))?;
            if self.fill_halves(region, budget, false)? {
                continue;
            }
            if !stubborn {
                return Ok(false);
            }
            if !self.clear_region(region)? {
                return if last { self.fill_with_points(region, budget) } else { Ok(false) };
            }
        }
    }

    /// Collects the tetrahedra that cross the region in the cavity, if they can be opened.
    fn collect_crossing(&mut self, region: &[[u32; 3]]) -> Result<Opening, Error> {
        let outcome = self.crossed.collect(self.mesh, self.points, region, self.control)?;
        self.cavity.set(&self.crossed.tets)?;
        Ok(outcome)
    }

    /// Opens the region once more and fills its halves with the help of points inside.
    fn fill_with_points(&mut self, region: &[[u32; 3]], budget: u32) -> Result<bool, Error> {
        if self.collect_crossing(region)? != Opening::Found {
            return Ok(false);
        }
        self.cavity.bound(self.mesh, &Terms::keep(&self.edges))?;
        if !self.fill_halves(region, budget, true)? {
            return Ok(false);
        }
        self.by_points += region.len() as u64;
        for &triangle in region {
            if !self.mark_if_present(triangle)? {
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
        if !place(self.points, p, faces, from, &[], self.control)? {
            self.points.truncate(p as usize);
            return Ok(false);
        }
        fallible::push(&mut self.mesh.vertex_tet, NONE)?;
        fallible::push(&mut self.inside, p)?;
        fallible::extend(&mut self.tets, faces.iter().map(|&[x, y, z]| [p, x, y, z]))?;
        Ok(true)
    }

    /// Fills both sides of the region in the bounded cavity; with points inside, if `help` allows them.
    fn fill_halves(&mut self, region: &[[u32; 3]], budget: u32, help: bool) -> Result<bool, Error> {
        self.tets.clear();
        // Faces that cross the plane, or lie in it, beyond the region bound neither half.
        for face in &self.cavity.faces {
            let sides = face.map(|v| self.crossed.side(self.points, v));
            if sides.contains(&Sign::Positive) == sides.contains(&Sign::Negative) {
                return Ok(false);
            }
        }
        let known = self.inside.len();
        for above in [true, false] {
            let (points, crossed) = (&*self.points, &mut self.crossed);
            let wanted = if above { Sign::Positive } else { Sign::Negative };
            let mut on_side = |v: &u32| crossed.side(points, *v) == wanted;
            let mut faces: Vec<[u32; 3]> = fallible::reserved(self.cavity.faces.len() + region.len())?;
            fallible::extend(
                &mut faces,
                self.cavity.faces.iter().copied().filter(|f| f.iter().any(&mut on_side)),
            )?;
            // (p, x, y, z) is positive for p inside.
            fallible::extend(
                &mut faces,
                region.iter().map(|&[a, b, c]| if above { [a, c, b] } else { [a, b, c] }),
            )?;
            let mut edges: Vec<[u32; 2]> = fallible::reserved(self.cavity.edges.len())?;
            fallible::extend(
                &mut edges,
                self.cavity.edges.iter().copied().filter(|e| e.iter().any(&mut on_side)),
            )?;
            let mut inner: Vec<u32> = fallible::reserved(self.cavity.inner.len())?;
            fallible::extend(&mut inner, self.cavity.inner.iter().copied().filter(|v| on_side(v)))?;
            if !is_closed(&faces)? {
                return self.forget_points(known);
            }
            let polyhedron = Polyhedron { faces: &faces, inner: &inner, edges: &edges };
            if self.reconnect.fill(self.points, &polyhedron, budget, &mut self.tets)? {
                continue;
            }
            if !help || !inner.is_empty() || !edges.is_empty() || !self.star_point(&faces)? {
                return self.forget_points(known);
            }
        }
        self.replace.cavity(self.mesh, &self.cavity.tets, &self.tets, region)?;
        Ok(true)
    }

    /// Removes the newest points inside again, which are in no tetrahedron yet.
    fn forget_points(&mut self, known: usize) -> Result<bool, Error> {
        for _ in known..self.inside.len() {
            self.inside.pop();
            self.mesh.vertex_tet.pop();
            self.points.truncate(self.points.len() - 1);
        }
        Ok(false)
    }

    /// Removes one of the edges that pierce the region's plane in the cavity such that fewer tetrahedra cross the region.
    fn clear_region(&mut self, region: &[[u32; 3]]) -> Result<bool, Error> {
        let before = self.cavity.tets.len();
        let mut piercing: Vec<[u32; 2]> = Vec::new();
        for &t in &self.cavity.tets {
            let v = self.mesh.verts(t);
            let sides = v.map(|w| self.crossed.side(self.points, w));
            for i in 0..4 {
                for j in 0..i {
                    if sides[i] != Sign::Zero && sides[i] == -sides[j] {
                        fallible::push(&mut piercing, edge_key(v[i], v[j]))?;
                    }
                }
            }
        }
        piercing.sort_unstable();
        piercing.dedup();
        piercing.retain(|edge| !self.edges.contains(edge));
        for edge in piercing.into_iter().take(MOST_PIERCING) {
            self.control.look()?;
            let (flips, mut site) = self.site();
            if !flips.remove(&mut site, edge, None, PIERCING)? {
                continue;
            }
            let outcome = self.collect_crossing(region)?;
            let fewer = self.cavity.tets.len() < before;
            if outcome == Opening::Nothing || (outcome == Opening::Found && fewer) {
                return Ok(true);
            }
            let (flips, mut site) = self.site();
            flips.take_back(&mut site)?;
        }
        Ok(false)
    }
}

/// Whether the faces bound something: every edge has as many faces one way as the other.
fn is_closed(faces: &[[u32; 3]]) -> Result<bool, Error> {
    let mut edges: Vec<([u32; 2], bool)> = fallible::reserved(3 * faces.len())?;
    for &[x, y, z] in faces {
        fallible::extend(&mut edges, [(x, y), (y, z), (z, x)].map(|(a, b)| (edge_key(a, b), a < b)))?;
    }
    edges.sort_unstable();
    let balanced = |group: &[([u32; 2], bool)]| 2 * group.iter().filter(|edge| edge.1).count() == group.len();
    Ok(edges.chunk_by(|a, b| a.0 == b.0).all(balanced))
}

#[cfg(test)]
mod tests {
    use super::is_closed;

    #[test]
    fn faces_bound_something_or_are_open() {
        let tetrahedron = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];
        assert!(is_closed(&tetrahedron).unwrap());
        assert!(!is_closed(&tetrahedron[1..]).unwrap());
        // A face with the wrong orientation.
        assert!(!is_closed(&[[1, 3, 2], [0, 3, 2], [0, 1, 3], [0, 2, 1]]).unwrap());
        // Both sides of one triangle, as of a dangling facet.
        assert!(is_closed(&[[0, 1, 2], [0, 2, 1]]).unwrap());
    }
}
