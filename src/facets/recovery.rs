//! Facet recovery (D1 → D2) by connected missing regions: Si & Gärtner 2011, section 6.
//!
//! When all segments are edges, the constrained Delaunay tetrahedralization exists (Shewchuk 1998), and still does after each facet. The
//! tetrahedra that cross a connected set of missing subfaces form a cavity; the region cuts the cavity into two halves, each of which is
//! filled on its own ([`fill`](crate::facets::fill)) without adding points. Tetrahedra that do not cross the region stay, since adding a constraint
//! only hides vertices.
//!
//! A mesh edge in the plane is also in the patch's triangulation, because both break ties the same way. Hence regions are sets of missing
//! subfaces connected through missing edges, and their boundaries are edges of the mesh.
use crate::control::Control;
use crate::error::{Element, Error};
use crate::facets::cavity::{Opening, RegionCavity};
use crate::facets::fill::{Filler, Half};
use crate::facets::subface::Subfaces;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::face_key;
use crate::kernel::lookup::Lookup;
use crate::kernel::replace::Replace;
use crate::kernel::Mesh;
use crate::predicates::{Points, Sign};
use crate::progress::Phase;
use crate::segments::crossing;

/// The state of a recovery.
pub struct FacetRecovery<'a> {
    mesh: &'a mut Mesh,
    points: &'a Points,
    subfaces: &'a Subfaces,
    control: &'a Control<'a>,
    recovered: Vec<bool>,
    in_region: Vec<bool>,
    search: StarSearch,
    cavity: RegionCavity,
    filler: Filler,
    replace: Replace,
    /// Number of missing regions filled.
    pub regions: u64,
}

impl<'a> FacetRecovery<'a> {
    /// Prepares a recovery; `mesh.vertex_tet` must be up to date.
    pub fn new(
        mesh: &'a mut Mesh,
        points: &'a Points,
        subfaces: &'a Subfaces,
        control: &'a Control<'a>,
    ) -> Result<Self, Error> {
        let recovered = fallible::filled(false, subfaces.verts.len())?;
        let in_region = fallible::filled(false, subfaces.verts.len())?;
        Ok(FacetRecovery {
            mesh,
            points,
            subfaces,
            control,
            recovered,
            in_region,
            search: StarSearch::default(),
            cavity: RegionCavity::default(),
            filler: Filler::default(),
            replace: Replace::default(),
            regions: 0,
        })
    }

    /// Makes every subface a face of the mesh, flagged on both sides.
    pub fn run(&mut self) -> Result<(), Error> {
        self.mark_present()?;
        let order = self.missing_by_region_size()?;
        let mut region = Vec::new();
        for (i, &s) in order.iter().enumerate() {
            if i % 256 == 0 {
                self.control.progress(Phase::Facets, i as f64 / order.len() as f64)?;
            }
            self.control.step()?;
            if self.recovered[s as usize] || self.mark_if_present(s)? {
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
                self.control.step()?;
                if !self.mark_if_present(r)? {
                    return Err(Error::internal("a filled region has a missing subface"));
                }
            }
        }
        Ok(())
    }

    /// Flags the faces of the mesh that are subfaces, in one pass over the mesh, since nearly all subfaces are present.
    fn mark_present(&mut self) -> Result<(), Error> {
        let keyed = |(&v, s): (&[u32; 3], u32)| {
            let [a, b, c] = face_key(v);
            (a, [b, c], s)
        };
        let keys = || self.subfaces.verts.iter().zip(0..).map(keyed);
        let subface_of = Lookup::new(self.points.len(), keys, self.control)?;
        self.mesh.clear_subsegments();
        let mesh = &mut self.mesh;
        for t in 0..mesh.slot_count() as u32 {
            if !mesh.is_live(t) || mesh.is_ghost(t) {
                continue;
            }
            self.control.step()?;
            for f in 0..4u32 {
                // Visit each face once, from the tetrahedron with the smaller index; on the hull, from inside.
                let other = mesh.across(4 * t + f);
                let seen = other < 4 * t && !mesh.is_ghost(other >> 2);
                if seen {
                    continue;
                }
                let [a, b, c] = face_key(mesh.face(4 * t + f));
                if let Some(s) = subface_of.get(a, [b, c]) {
                    mesh.set_subface(4 * t + f);
                    self.recovered[s as usize] = true;
                }
            }
        }
        Ok(())
    }

    /// The missing subfaces, those of small regions first: a cavity filled early is not opened again.
    fn missing_by_region_size(&mut self) -> Result<Vec<u32>, Error> {
        let mut sized: Vec<(u32, u32, u32)> = Vec::new();
        let mut region = Vec::new();
        let mut seen = fallible::filled(false, self.recovered.len())?;
        for s in 0..self.subfaces.verts.len() as u32 {
            if self.recovered[s as usize] || seen[s as usize] {
                continue;
            }
            self.control.step()?;
            self.collect_region(s, &mut region)?;
            sized.try_reserve(region.len())?;
            for &r in &region {
                seen[r as usize] = true;
                self.in_region[r as usize] = false;
                fallible::push(&mut sized, (region.len() as u32, s, r))?;
            }
        }
        self.control.sort(&mut sized)?;
        Ok(fallible::collect(sized.into_iter().map(|x| x.2))?)
    }

    /// Flags the subface in the mesh if it is a face; returns whether it is.
    fn mark_if_present(&mut self, s: u32) -> Result<bool, Error> {
        let corners = self.subfaces.verts[s as usize];
        let start = self.mesh.vertex_tet[corners[0] as usize];
        let mesh = &mut self.mesh;
        let found = self.search.find_face(mesh, corners, start)?;
        self.control.worked(self.search.tets.len());
        if let Some(code) = found {
            mesh.set_subface(code);
            self.recovered[s as usize] = true;
        }
        Ok(found.is_some())
    }

    /// Collects the missing subfaces connected to `s` through edges missing from the mesh.
    fn collect_region(&mut self, s: u32, region: &mut Vec<u32>) -> Result<(), Error> {
        let FacetRecovery { mesh, search, subfaces, recovered, in_region, control, .. } = self;
        subfaces.collect_region(s, recovered, in_region, region, control, |[a, b]| {
            let start = mesh.vertex_tet[a as usize];
            let found = search.find_edge(mesh, a, b, start)?.is_some();
            control.worked(search.tets.len());
            Ok(found)
        })
    }

    /// Opens the cavity of a region and fills its halves.
    fn fill_region(&mut self, region: &[u32]) -> Result<(), Error> {
        let corners = fallible::collect(region.iter().map(|&s| self.subfaces.verts[s as usize]))?;
        self.cavity.begin(self.points, &corners)?;
        match self.cavity.collect(self.mesh, self.points, &corners, self.control)? {
            Opening::Found => {}
            Opening::Nothing => return Err(Error::internal("no tetrahedron crosses a missing region")),
            Opening::Blocked(face) => return Err(self.facet_of(face, region)),
        }
        let [upper, lower] = self.halves(&corners)?;
        let mut tets = Vec::new();
        self.filler.fill(self.points, upper, &mut tets, self.control)?;
        self.filler.fill(self.points, lower, &mut tets, self.control)?;
        self.replace.cavity(self.mesh, &self.cavity.tets, &tets, &corners)
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

    /// The boundaries of the cavity's halves above and below the plane, with faces oriented towards the inside.
    fn halves(&mut self, region: &[[u32; 3]]) -> Result<[Half; 2], Error> {
        let mut upper = Half::default();
        let mut lower = Half::default();
        for i in 0..self.cavity.tets.len() {
            let t = self.cavity.tets[i];
            self.control.step()?;
            // Vertices come from the tetrahedra, not from the faces: the whole star of a vertex may be in the cavity.
            for v in self.mesh.verts(t) {
                let side = self.cavity.side(self.points, v);
                if side != Sign::Negative {
                    fallible::push(&mut upper.vertices, v)?;
                }
                if side != Sign::Positive {
                    fallible::push(&mut lower.vertices, v)?;
                }
            }
            for f in 0..4u32 {
                let n = self.mesh.beyond(t, f);
                let inner = self.cavity.has(n);
                let constrained = self.mesh.is_subface(4 * t + f);
                if inner && !constrained {
                    continue;
                }
                let face = self.mesh.face(4 * t + f);
                let sides = face.map(|v| self.cavity.side(self.points, v));
                let half = if sides.contains(&Sign::Positive) {
                    &mut upper
                } else if sides.contains(&Sign::Negative) {
                    &mut lower
                } else {
                    return Err(Error::internal("a cavity has a face in the plane of its region"));
                };
                fallible::push(&mut half.faces, face)?;
            }
        }
        upper.faces.try_reserve(region.len())?;
        lower.faces.try_reserve(region.len())?;
        for &[a, b, c] in region {
            // All subfaces of a patch are oriented alike.
            fallible::push(&mut upper.faces, [a, c, b])?;
            fallible::push(&mut lower.faces, [a, b, c])?;
        }
        Ok([upper, lower])
    }
}
