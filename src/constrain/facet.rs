//! Facet recovery (D1 → D2): Si & Gärtner 2011, section 6, by connected missing regions.
//!
//! When all segments are edges, the constrained Delaunay tetrahedralization exists (Shewchuk 1998), and so it does after each
//! facet. A connected set of missing subfaces is crossed by tetrahedra that form a cavity; the region cuts the cavity in
//! two halves, each is filled on its own ([`fill`](super::fill)), no point is added. Tetrahedra that do not cross the region
//! stay: adding a constraint only hides vertices.
//!
//! Two facts keep the search combinatorial. Region boundaries are mesh edges, so a tetrahedron's section with the plane lies
//! wholly inside or outside a region. And an edge in the plane that is in the mesh is in the patch's triangulation too,
//! because both break ties the same way. Hence regions are the sets of missing subfaces joined by missing edges, and a
//! region's cavity is what one reaches through faces with vertices on both sides of the plane.
use super::fill::{Filler, Half};
use super::subface::Subfaces;
use super::{crossing, face_key};
use crate::delaunay::Delaunay;
use crate::error::{Element, Error, Status};
use crate::mesh::star::{EdgeRing, StarSearch};
use crate::mesh::tables::FACE;
use crate::mesh::{flag, NONE};
use crate::predicates::{Points, Sign};
use rustc_hash::FxHashMap;

/// The state of a recovery.
pub struct FacetRecovery<'a> {
    delaunay: &'a mut Delaunay,
    points: &'a Points,
    subfaces: &'a Subfaces,
    recovered: Vec<bool>,
    in_region: Vec<bool>,
    /// Side of the current plane per vertex, valid if the stamp is current.
    side: Vec<(u32, Sign)>,
    stamp: u32,
    search: StarSearch,
    filler: Filler,
    /// Tetrahedra of the current cavity.
    cavity: Vec<u32>,
    /// Missing regions filled.
    pub regions: u64,
}

impl<'a> FacetRecovery<'a> {
    /// Prepares a recovery; `delaunay.vertex_tet` must be up to date.
    pub fn new(
        delaunay: &'a mut Delaunay,
        points: &'a Points,
        subfaces: &'a Subfaces,
    ) -> Result<Self, Error> {
        let mut recovered = Vec::new();
        recovered.try_reserve(subfaces.verts.len())?;
        recovered.resize(subfaces.verts.len(), false);
        let in_region = recovered.clone();
        let mut side = Vec::new();
        side.try_reserve(points.len())?;
        side.resize(points.len(), (0, Sign::Zero));
        Ok(FacetRecovery {
            delaunay,
            points,
            subfaces,
            recovered,
            in_region,
            side,
            stamp: 0,
            search: StarSearch::default(),
            filler: Filler::default(),
            cavity: Vec::new(),
            regions: 0,
        })
    }

    /// Makes every subface a face of the mesh, flagged on both sides.
    pub fn run(&mut self, tick: &mut dyn FnMut(usize, usize) -> Result<(), Error>) -> Result<(), Error> {
        self.mark_present()?;
        let order = self.missing_by_region_size()?;
        let mut region = Vec::new();
        for (i, &s) in order.iter().enumerate() {
            if i % 256 == 0 {
                tick(i, order.len())?;
            }
            if self.recovered[s as usize] || self.mark_if_present(s) {
                continue;
            }
            self.collect_region(s, &mut region)?;
            let filled = self.fill_region(&region);
            for &r in &region {
                self.in_region[r as usize] = false;
            }
            filled?;
            self.regions += 1;
            for &r in &region {
                if !self.mark_if_present(r) {
                    return Err(Error::internal("a filled region has a missing subface"));
                }
            }
        }
        Ok(())
    }

    /// Flags the faces of the mesh that are subfaces. One pass over the mesh: nearly all subfaces are there.
    fn mark_present(&mut self) -> Result<(), Error> {
        let mut corners = Vec::new();
        corners.try_reserve(self.points.len())?;
        corners.resize(self.points.len(), false);
        let mut subface_of: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let full = |_| Error::new(Status::OutOfMemory, "out of memory");
        subface_of.try_reserve(self.subfaces.verts.len()).map_err(full)?;
        for (s, v) in self.subfaces.verts.iter().enumerate() {
            subface_of.insert(face_key(*v), s as u32);
            for w in v {
                corners[*w as usize] = true;
            }
        }
        let mesh = &mut self.delaunay.mesh;
        for t in 0..mesh.slot_count() as u32 {
            mesh.flags[t as usize] &= !flag::EDGES;
            if !mesh.is_live(t) || mesh.is_ghost(t) {
                continue;
            }
            let corner = mesh.verts[t as usize].map(|w| corners[w as usize]);
            for f in 0..4u32 {
                // Each face once, from the tetrahedron with the smaller number; from the inside on the hull.
                let other = mesh.across(4 * t + f);
                let seen = other < 4 * t && !mesh.is_ghost(other >> 2);
                if seen || !FACE[f as usize].iter().all(|&k| corner[k as usize]) {
                    continue;
                }
                if let Some(&s) = subface_of.get(&face_key(mesh.face(4 * t + f))) {
                    mesh.flags[t as usize] |= flag::FACE << f;
                    mesh.flags[(other >> 2) as usize] |= flag::FACE << (other & 3);
                    self.recovered[s as usize] = true;
                }
            }
        }
        Ok(())
    }

    /// The missing subfaces, those of small regions first: a cavity that is filled early is not dug up again.
    fn missing_by_region_size(&mut self) -> Result<Vec<u32>, Error> {
        let mut sized: Vec<(u32, u32, u32)> = Vec::new();
        let mut region = Vec::new();
        let mut seen = vec![false; self.recovered.len()];
        for s in 0..self.subfaces.verts.len() as u32 {
            if self.recovered[s as usize] || seen[s as usize] {
                continue;
            }
            self.collect_region(s, &mut region)?;
            sized.try_reserve(region.len())?;
            for &r in &region {
                seen[r as usize] = true;
                self.in_region[r as usize] = false;
                sized.push((region.len() as u32, s, r));
            }
        }
        sized.sort_unstable();
        Ok(sized.into_iter().map(|x| x.2).collect())
    }

    /// A tetrahedron with the edge, if the mesh has it.
    fn find_edge(&mut self, a: u32, b: u32) -> Option<u32> {
        let start = self.delaunay.vertex_tet[a as usize];
        self.search.find_edge(&mut self.delaunay.mesh, a, b, start)
    }

    /// Flags the subface in the mesh if it is a face there.
    fn mark_if_present(&mut self, s: u32) -> bool {
        let [a, b, c] = self.subfaces.verts[s as usize];
        let Some(t) = self.find_edge(a, b) else { return false };
        let mesh = &mut self.delaunay.mesh;
        let hit =
            EdgeRing::new(mesh, t, a, b).find(|&(t, _, _, _, l)| mesh.verts[t as usize][l as usize] == c);
        let Some((t, _, _, k, _)) = hit else { return false };
        let other = mesh.adj[t as usize][k as usize];
        mesh.flags[t as usize] |= flag::FACE << k;
        mesh.flags[(other >> 2) as usize] |= flag::FACE << (other & 3);
        self.recovered[s as usize] = true;
        true
    }

    /// The missing subfaces connected to `s` through edges that the mesh lacks.
    fn collect_region(&mut self, s: u32, region: &mut Vec<u32>) -> Result<(), Error> {
        region.clear();
        region.push(s);
        self.in_region[s as usize] = true;
        let mut next = 0;
        while next < region.len() {
            let t = region[next] as usize;
            next += 1;
            region.try_reserve(3)?;
            for e in 0..3 {
                let n = self.subfaces.adj[t][e];
                if n == NONE || self.in_region[(n / 3) as usize] || self.recovered[(n / 3) as usize] {
                    continue;
                }
                let v = self.subfaces.verts[t];
                if self.find_edge(v[(e + 1) % 3], v[(e + 2) % 3]).is_none() {
                    self.in_region[(n / 3) as usize] = true;
                    region.push(n / 3);
                }
            }
        }
        Ok(())
    }

    /// Which side of the plane of `plane` a vertex is on.
    fn side_of(&mut self, plane: [u32; 3], v: u32) -> Sign {
        let cached = &mut self.side[v as usize];
        if cached.0 != self.stamp {
            *cached = (self.stamp, self.points.orient3d(plane[0], plane[1], plane[2], v));
        }
        cached.1
    }

    /// Opens the cavity of a region and fills its halves.
    fn fill_region(&mut self, region: &[u32]) -> Result<(), Error> {
        let plane = self.subfaces.verts[region[0] as usize];
        self.stamp += 1;
        for &s in region {
            for v in self.subfaces.verts[s as usize] {
                self.side[v as usize] = (self.stamp, Sign::Zero);
            }
        }
        let start = self.find_crossing(plane, region)?;
        self.collect_cavity(plane, start, region)?;
        let halves = self.halves(plane, region);
        for &t in &self.cavity {
            self.delaunay.mesh.flags[t as usize] &= !flag::MARK;
        }
        let [upper, lower] = halves?;
        let mut tets = Vec::new();
        self.filler.fill(self.points, upper, &mut tets)?;
        self.filler.fill(self.points, lower, &mut tets)?;
        self.replace(region, &tets)
    }

    /// A tetrahedron whose interior the region enters from an edge of its boundary.
    fn find_crossing(&mut self, plane: [u32; 3], region: &[u32]) -> Result<u32, Error> {
        for &s in region {
            for e in 0..3 {
                let v = self.subfaces.verts[s as usize];
                let (a, b) = (v[(e + 1) % 3], v[(e + 2) % 3]);
                let Some(t) = self.find_edge(a, b) else { continue };
                // Seen along a → b the region lies at angle 0; the positive tetrahedron (a, b, x, y) turns from x to y, and
                // passes angle 0 exactly if x is below the plane and y above.
                let ring: Vec<(u32, u32, u32)> = {
                    let mesh = &self.delaunay.mesh;
                    EdgeRing::new(mesh, t, a, b)
                        .filter(|&(t, ..)| !mesh.is_ghost(t))
                        .map(|(t, _, _, k, l)| {
                            (t, mesh.verts[t as usize][k as usize], mesh.verts[t as usize][l as usize])
                        })
                        .collect()
                };
                for (t, x, y) in ring {
                    if self.side_of(plane, x) == Sign::Negative && self.side_of(plane, y) == Sign::Positive {
                        return Ok(t);
                    }
                }
            }
        }
        Err(Error::internal("no tetrahedron crosses a missing region"))
    }

    /// Marks and collects the tetrahedra that the region crosses.
    fn collect_cavity(&mut self, plane: [u32; 3], start: u32, region: &[u32]) -> Result<(), Error> {
        self.cavity.clear();
        self.cavity.push(start);
        self.delaunay.mesh.flags[start as usize] |= flag::MARK;
        let mut next = 0;
        let mut trouble = None;
        while next < self.cavity.len() {
            let t = self.cavity[next];
            next += 1;
            self.cavity.try_reserve(4)?;
            for f in 0..4u32 {
                let face = self.delaunay.mesh.face(4 * t + f);
                let n = self.delaunay.mesh.adj[t as usize][f as usize] >> 2;
                if self.delaunay.mesh.flags[n as usize] & flag::MARK != 0 {
                    continue;
                }
                let sides = face.map(|v| self.side_of(plane, v));
                if !(sides.contains(&Sign::Positive) && sides.contains(&Sign::Negative)) {
                    continue;
                }
                let constrained = self.delaunay.mesh.flags[t as usize] & (flag::FACE << f) != 0;
                if constrained || self.delaunay.mesh.is_ghost(n) {
                    trouble = Some(self.facet_of(face, region));
                    continue;
                }
                self.delaunay.mesh.flags[n as usize] |= flag::MARK;
                self.cavity.push(n);
            }
        }
        if let Some(error) = trouble {
            for &t in &self.cavity {
                self.delaunay.mesh.flags[t as usize] &= !flag::MARK;
            }
            return Err(error);
        }
        Ok(())
    }

    /// The error for a region that crosses a recovered subface: the PLC crosses itself.
    fn facet_of(&self, face: [u32; 3], region: &[u32]) -> Error {
        let key = face_key(face);
        let other = (0..self.subfaces.verts.len()).find(|&s| face_key(self.subfaces.verts[s]) == key);
        let first = Element::Facet(self.subfaces.facet[region[0] as usize]);
        match other {
            Some(s) => crossing("two facets cross", first, Some(Element::Facet(self.subfaces.facet[s]))),
            None => Error::internal("a missing region leaves the convex hull"),
        }
    }

    /// The boundaries of the cavity's halves above and below the plane, faces turned to the inside.
    fn halves(&mut self, plane: [u32; 3], region: &[u32]) -> Result<[Half; 2], Error> {
        let mut upper = Half::default();
        let mut lower = Half::default();
        for i in 0..self.cavity.len() {
            let t = self.cavity[i];
            // From the tetrahedra, not from the faces: a vertex may have its whole star in the cavity.
            upper.vertices.try_reserve(4)?;
            lower.vertices.try_reserve(4)?;
            for v in self.delaunay.mesh.verts[t as usize] {
                let side = self.side_of(plane, v);
                if side != Sign::Negative {
                    upper.vertices.push(v);
                }
                if side != Sign::Positive {
                    lower.vertices.push(v);
                }
            }
            for f in 0..4u32 {
                let n = self.delaunay.mesh.adj[t as usize][f as usize] >> 2;
                let inner = self.delaunay.mesh.flags[n as usize] & flag::MARK != 0;
                let constrained = self.delaunay.mesh.flags[t as usize] & (flag::FACE << f) != 0;
                if inner && !constrained {
                    continue;
                }
                let face = self.delaunay.mesh.face(4 * t + f);
                let sides = face.map(|v| self.side_of(plane, v));
                let half = if sides.contains(&Sign::Positive) {
                    &mut upper
                } else if sides.contains(&Sign::Negative) {
                    &mut lower
                } else {
                    return Err(Error::internal("a cavity has a face in the plane of its region"));
                };
                half.faces.try_reserve(1)?;
                half.faces.push(face);
            }
        }
        upper.faces.try_reserve(region.len())?;
        lower.faces.try_reserve(region.len())?;
        for &s in region {
            let [a, b, c] = self.subfaces.verts[s as usize];
            // `side_of` measures against plane = verts[region[0]]; all subfaces of a patch turn the same way.
            upper.faces.push([a, c, b]);
            lower.faces.push([a, b, c]);
        }
        Ok([upper, lower])
    }

    /// Replaces the cavity's tetrahedra by new ones and links them.
    fn replace(&mut self, region: &[u32], tets: &[[u32; 4]]) -> Result<(), Error> {
        let mesh = &mut self.delaunay.mesh;
        // Faces that wait for their second side: corner code of the first.
        let mut open: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        let mut constrained: FxHashMap<[u32; 3], ()> = FxHashMap::default();
        for &t in &self.cavity {
            mesh.flags[t as usize] |= flag::MARK;
        }
        for &t in &self.cavity {
            for f in 0..4u32 {
                let key = face_key(mesh.face(4 * t + f));
                if mesh.flags[t as usize] & (flag::FACE << f) != 0 {
                    constrained.insert(key, ());
                }
                let n = mesh.adj[t as usize][f as usize];
                if mesh.flags[(n >> 2) as usize] & flag::MARK == 0 {
                    open.insert(key, n);
                }
            }
        }
        for &s in region {
            constrained.insert(face_key(self.subfaces.verts[s as usize]), ());
        }
        for &t in &self.cavity {
            mesh.release(t);
        }
        mesh.reserve(tets.len())?;
        for v in tets {
            let t = mesh.allocate(*v);
            for w in v {
                self.delaunay.vertex_tet[*w as usize] = t;
            }
            for f in 0..4u32 {
                let code = 4 * t + f;
                let key = face_key(mesh.face(code));
                if constrained.contains_key(&key) {
                    mesh.flags[t as usize] |= flag::FACE << f;
                }
                match open.remove(&key) {
                    Some(other) => mesh.link(code, other),
                    None => {
                        open.insert(key, code);
                    }
                }
            }
        }
        if !open.is_empty() {
            return Err(Error::internal("the halves of a cavity do not fit together"));
        }
        Ok(())
    }
}
