//! Diagonals of polygons that are planar only up to rounding.
//!
//! Hardly any two triangles of such a polygon are exactly coplanar, so each diagonal would be a segment, and one missing from the Delaunay
//! tetrahedralization would need Steiner points, which make others go missing. But the diagonals are free: any triangulation of the polygon
//! is valid. So segments of the input are recovered first. Then each polygon, with the Steiner points on its edges as corners, is made
//! Delaunay in its plane (Lawson 1977) and gets all edges that the mesh has between its corners (Sloan 1993). If no edge is then missing,
//! the polygon needs no point inside: its triangles are faces, or missing regions of one triangle each, which facet recovery fills. A
//! polygon that still has a missing edge, because something pierces it, keeps its previous diagonals as segments.
//!
//! Nothing here can make a mesh invalid. Triangles that are faces of one tetrahedralization do not cross each other; if a polygon lies so
//! close to another element that its new triangles cross it, facet recovery reports that, and the caller keeps the old ones.
use crate::control::Control;
use crate::error::Error;
use crate::facets::subface::{Subfaces, Triangles};
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::edge_key;
use crate::kernel::Mesh;
use crate::kernel::{GHOST, NONE};
use crate::plc::polygon::metric::is_inside_circle;
use crate::predicates::{Points, Sign};
use crate::segments::recovery::Segments;
use crate::vector::by_size;
use rustc_hash::FxHashMap;
use std::collections::VecDeque;

/// The triangles of a surface, in vertex ids of the engine.
pub struct Polygons<'a> {
    /// Corners.
    pub corners: &'a [[u32; 3]],
    /// Input facet of each.
    pub facet: &'a [u32],
    /// For each segment whether it is a diagonal that may be removed.
    pub soft: &'a [bool],
}

/// Triangles that replace those of some facets.
#[derive(Debug, Default)]
pub struct Retriangulated {
    /// The facets, in ascending order.
    pub facets: Vec<u32>,
    /// Corners, including Steiner points.
    pub corners: Vec<[u32; 3]>,
    /// Facet of each.
    pub facet: Vec<u32>,
}

impl Retriangulated {
    /// Whether a facet has triangles other than the surface's.
    pub fn has(&self, facet: u32) -> bool {
        self.facets.binary_search(&facet).is_ok()
    }
}

/// Triangulates the `wanted` facets (ascending) with edges of the mesh where possible; also returns the facets where it is not. All
/// segments that are not soft must be unions of edges, and `mesh.vertex_tet` up to date.
///
/// # Errors
/// `OutOfMemory`, `Internal`.
pub fn retriangulate(
    mesh: &mut Mesh,
    points: &Points,
    segments: &Segments,
    polygons: &Polygons,
    wanted: &[u32],
    control: &Control,
) -> Result<(Retriangulated, Vec<u32>), Error> {
    // (place in `wanted`, triangle)
    let mut picked: Vec<(u32, u32)> = Vec::new();
    for (t, f) in (0..).zip(polygons.facet) {
        if let Ok(place) = wanted.binary_search(f) {
            fallible::push(&mut picked, (place as u32, t))?;
        }
    }
    picked.sort_unstable();
    let mut corners: Vec<[u32; 3]> = fallible::reserved(picked.len())?;
    let mut facet: Vec<u32> = fallible::reserved(picked.len())?;
    let mut patch: Vec<u32> = fallible::reserved(picked.len())?;
    let mut axis: Vec<u8> = fallible::filled(0, wanted.len())?;
    let mut failed: Vec<bool> = fallible::filled(false, wanted.len())?;
    for run in picked.chunk_by(|x, y| x.0 == y.0) {
        control.step()?;
        let (place, triangles) = (run[0].0, || run.iter().map(|x| polygons.corners[x.1 as usize]));
        let Some(found) = common_axis(points, triangles) else {
            failed[place as usize] = true;
            continue;
        };
        axis[place as usize] = found;
        fallible::extend(&mut corners, triangles())?;
        fallible::resize(&mut facet, corners.len(), wanted[place as usize])?;
        fallible::resize(&mut patch, corners.len(), place)?;
    }
    let triangles = Triangles { corners: &corners, facet: &facet, patch: &patch, patch_count: wanted.len() };
    let (subfaces, entangled) =
        Subfaces::of_polygons(points, &triangles, axis, segments, polygons.soft, control)?;
    entangled.into_iter().for_each(|p| failed[p as usize] = true);
    let mut work = Work {
        mesh,
        points,
        subfaces,
        control,
        search: StarSearch::default(),
        triangle_of: FxHashMap::default(),
    };
    let mut members: Vec<(u32, u32)> =
        fallible::collect((0..).zip(&work.subfaces.patch).map(|(t, &p)| (p, t)))?;
    members.sort_unstable();
    let mut done = Retriangulated::default();
    let mut own: Vec<u32> = Vec::new();
    for run in members.chunk_by(|x, y| x.0 == y.0) {
        let number = run[0].0 as usize;
        if failed[number] {
            continue;
        }
        own.clear();
        fallible::extend(&mut own, run.iter().map(|x| x.1))?;
        work.make_delaunay(&own)?;
        if !work.conform(&own)? {
            failed[number] = true;
            continue;
        }
        fallible::push(&mut done.facets, wanted[number])?;
        done.corners.try_reserve(own.len())?;
        done.facet.try_reserve(own.len())?;
        fallible::extend(&mut done.corners, own.iter().map(|&t| work.subfaces.verts[t as usize]))?;
        fallible::extend(&mut done.facet, own.iter().map(|_| wanted[number]))?;
    }
    let mut left: Vec<u32> = fallible::reserved(wanted.len() - done.facets.len())?;
    fallible::extend(&mut left, wanted.iter().zip(&failed).filter(|x| *x.1).map(|x| *x.0))?;
    Ok((done, left))
}

/// The axis along which all triangles have the same orientation and their projections are largest, as far as doubles tell; `None` if there
/// is none.
fn common_axis<I: Iterator<Item = [u32; 3]>>(points: &Points, triangles: impl Fn() -> I) -> Option<u8> {
    let mut normal = [0.0; 3];
    for corners in triangles() {
        let [p, q, r] = corners.map(|v| points.xyz(v));
        let (d, e) = ([0, 1, 2].map(|k| q[k] - p[k]), [0, 1, 2].map(|k| r[k] - p[k]));
        for k in 0..3 {
            normal[k] += d[(k + 1) % 3] * e[(k + 2) % 3] - d[(k + 2) % 3] * e[(k + 1) % 3];
        }
    }
    let turn = |axis: u8, [a, b, c]: [u32; 3]| points.orient_in_plane(axis as usize, a, b, c);
    by_size(&normal, [0, 1, 2]).map(|axis| axis as u8).into_iter().find(|&axis| {
        let mut signs = triangles().map(|corners| turn(axis, corners));
        let first = signs.next().unwrap_or(Sign::Zero);
        first != Sign::Zero && signs.all(|sign| sign == first)
    })
}

/// The working state for polygons.
struct Work<'a> {
    mesh: &'a mut Mesh,
    points: &'a Points,
    subfaces: Subfaces,
    control: &'a Control<'a>,
    search: StarSearch,
    /// A triangle at each corner of the current polygon. Only looked up, never iterated.
    triangle_of: FxHashMap<u32, u32>,
}

impl Work<'_> {
    fn has_edge(&mut self, [a, b]: [u32; 2]) -> Result<bool, Error> {
        let start = self.mesh.vertex_tet[a as usize];
        let found = start != NONE && self.search.find_edge(self.mesh, a, b, start)?.is_some();
        self.control.worked(self.search.tets.len());
        Ok(found)
    }

    /// The ends of the edge opposite a corner.
    fn ends(&self, code: u32) -> [u32; 2] {
        let (v, i) = (self.subfaces.verts[code as usize / 3], code as usize % 3);
        [v[(i + 1) % 3], v[(i + 2) % 3]]
    }

    fn is_inner(&self, code: u32) -> bool {
        self.subfaces.adj[code as usize / 3][code as usize % 3] != NONE
    }

    /// Lawson's flips in the plane of a polygon.
    fn make_delaunay(&mut self, own: &[u32]) -> Result<(), Error> {
        let axis = self.subfaces.axis(self.subfaces.patch[own[0] as usize]);
        let origin = *self.points.xyz(self.subfaces.verts[own[0] as usize][0]);
        let mut stack: Vec<u32> = fallible::reserved(3 * own.len())?;
        fallible::extend(
            &mut stack,
            own.iter().flat_map(|&t| 3 * t..3 * t + 3).filter(|&code| self.is_inner(code)),
        )?;
        while let Some(code) = stack.pop() {
            self.control.step()?;
            let Some([a, d]) = self.subfaces.other_diagonal(self.points, code) else { continue };
            let [b, c] = self.ends(code);
            let corners = [a, b, c, d].map(|v| self.points.xyz(v));
            if is_inside_circle(axis, &origin, corners) {
                self.subfaces.turn(code);
                fallible::extend(&mut stack, self.subfaces.quadrilateral(code))?;
            }
        }
        Ok(())
    }

    /// Gives a polygon all edges that the mesh has between its corners, except where these cross each other; returns true if no other edges
    /// remain.
    fn conform(&mut self, own: &[u32]) -> Result<bool, Error> {
        self.triangle_of.clear();
        own.iter().try_for_each(|&t| self.note_corners(t))?;
        let mut missing: Vec<u32> = Vec::new();
        let mut around: Vec<u32> = Vec::new();
        for _ in 0..own.len() {
            missing.clear();
            missing.try_reserve(3 * own.len())?;
            for code in own.iter().flat_map(|&t| 3 * t..3 * t + 3) {
                self.control.step()?;
                let ends = self.ends(code);
                if !self.has_edge(ends)? {
                    if !self.is_inner(code) {
                        return Ok(false);
                    }
                    fallible::push(&mut missing, code)?;
                }
            }
            if missing.is_empty() {
                return Ok(true);
            }
            // A mesh edge that crosses only missing edges begins at a corner opposite one of these.
            let mut apexes: Vec<u32> = fallible::reserved(missing.len())?;
            let apex = |&code: &u32| self.subfaces.verts[code as usize / 3][code as usize % 3];
            fallible::extend(&mut apexes, missing.iter().map(apex))?;
            apexes.sort_unstable();
            apexes.dedup();
            let mut changed = false;
            for (i, &p) in apexes.iter().enumerate() {
                self.control.step()?;
                self.neighbors(p, &mut around)?;
                for &q in around.iter().filter(|q| apexes[i + 1..].binary_search(q).is_ok()) {
                    changed |= self.insert_edge([p, q])?;
                }
            }
            if !changed {
                return Ok(false);
            }
        }
        Ok(false)
    }

    /// The vertices joined to `v` in the mesh, in ascending order.
    fn neighbors(&mut self, v: u32, around: &mut Vec<u32>) -> Result<(), Error> {
        around.clear();
        let start = self.mesh.vertex_tet[v as usize];
        if start == NONE {
            return Ok(());
        }
        self.search.vertex_star(self.mesh, v, start)?;
        around.try_reserve(4 * self.search.tets.len())?;
        fallible::extend(around, self.search.tets.iter().flat_map(|&t| self.mesh.verts(t)))?;
        around.retain(|&w| w != v && w != GHOST);
        around.sort_unstable();
        around.dedup();
        Ok(())
    }

    /// Flips the edges that cross `pq` until it exists, if the mesh has none of them; returns true if that created it.
    fn insert_edge(&mut self, [p, q]: [u32; 2]) -> Result<bool, Error> {
        let mut crossing: VecDeque<[u32; 2]> = VecDeque::new();
        self.walk([p, q], |_, ends| {
            fallible::push_back(&mut crossing, ends)?;
            Ok(false)
        })?;
        if crossing.is_empty() {
            return Ok(false);
        }
        for &ends in &crossing {
            if self.has_edge(ends)? {
                return Ok(false);
            }
        }
        let mut tries = 4 * crossing.len() * crossing.len() + 16;
        while let Some(edge) = crossing.pop_front() {
            if tries == 0 {
                return Ok(false);
            }
            tries -= 1;
            self.control.step()?;
            let mut found = None;
            self.walk([p, q], |code, ends| {
                found = (ends == edge).then_some(code);
                Ok(found.is_some())
            })?;
            let Some(code) = found else { return Ok(false) };
            let Some([a, d]) = self.subfaces.other_diagonal(self.points, code) else {
                fallible::push_back(&mut crossing, edge)?;
                continue;
            };
            let other = self.subfaces.adj[code as usize / 3][code as usize % 3] / 3;
            self.subfaces.turn(code);
            for t in [code / 3, other] {
                self.note_corners(t)?;
            }
            let inner = self.subfaces.verts[code as usize / 3].iter().position(|v| *v != a && *v != d);
            let across = inner.map(|i| code / 3 * 3 + i as u32);
            if across.is_some_and(|across| self.subfaces.crosses(self.points, across, [p, q])) {
                fallible::push_back(&mut crossing, edge_key(a, d))?;
            }
        }
        Ok(true)
    }

    /// Calls `visit` with the edges that cross `pq`, as codes and ends, in their order from `p`, until it asks to stop. Does nothing if
    /// `pq` does not lie in the polygon or passes through a corner.
    fn walk(
        &self,
        [p, q]: [u32; 2],
        mut visit: impl FnMut(u32, [u32; 2]) -> Result<bool, Error>,
    ) -> Result<(), Error> {
        let Some(mut code) = self.entry([p, q]) else { return Ok(()) };
        loop {
            let [x, y] = self.ends(code);
            if visit(code, edge_key(x, y))? {
                return Ok(());
            }
            let other = self.subfaces.adj[code as usize / 3][code as usize % 3];
            let (t, i) = (other / 3, other % 3);
            if self.subfaces.verts[t as usize][i as usize] == q {
                return Ok(());
            }
            let onward = [3 * t + (i + 1) % 3, 3 * t + (i + 2) % 3];
            let Some(next) = onward.into_iter().find(|&c| self.subfaces.crosses(self.points, c, [p, q]))
            else {
                return Ok(());
            };
            code = next;
        }
    }

    /// The edge opposite `p` that `pq` crosses first, if any.
    fn entry(&self, [p, q]: [u32; 2]) -> Option<u32> {
        let &first = self.triangle_of.get(&p)?;
        // Around `p` one way, then the other way if that ends at an edge of the polygon.
        for turn in [1, 2] {
            let mut t = first;
            loop {
                let i = self.subfaces.verts[t as usize].iter().position(|&v| v == p)?;
                let code = 3 * t + i as u32;
                if self.subfaces.crosses(self.points, code, [p, q]) {
                    return Some(code);
                }
                let beyond = self.subfaces.adj[t as usize][(i + turn) % 3];
                if beyond == NONE {
                    break;
                }
                t = beyond / 3;
                if t == first {
                    return None;
                }
            }
        }
        None
    }

    /// Records a triangle at each of its corners.
    fn note_corners(&mut self, t: u32) -> Result<(), Error> {
        fallible::insert_all(&mut self.triangle_of, self.subfaces.verts[t as usize].map(|v| (v, t)))?;
        Ok(())
    }
}
