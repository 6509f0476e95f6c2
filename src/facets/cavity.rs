//! The cavity of a region: the tetrahedra that it crosses (Si & Gärtner 2011, section 6).
//!
//! A region is a set of coplanar triangles whose boundary edges are edges of the mesh. Two facts keep the search combinatorial: the section
//! of a tetrahedron with the plane then lies entirely inside or outside the region; and the tetrahedra that the region crosses are
//! connected through faces with vertices on both sides of the plane.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::{EdgeRing, StarSearch};
use crate::kernel::visited::Visited;
use crate::kernel::{Mesh, NONE};
use crate::predicates::{Points, Sign};

/// The result of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opening {
    /// The tetrahedra were found.
    Found,
    /// No tetrahedron crosses the region.
    Nothing,
    /// This face, a subface or on the hull, blocks the search.
    Blocked([u32; 3]),
}

/// The search, with its scratch space.
#[derive(Default)]
pub struct RegionCavity {
    /// The tetrahedra found.
    pub tets: Vec<u32>,
    plane: [u32; 3],
    /// Side of the current plane per vertex, valid if the stamp is current.
    sides: Vec<(u32, Sign)>,
    stamp: u32,
    search: StarSearch,
    visited: Visited,
}

impl RegionCavity {
    /// Sets the region, whose triangles must all be oriented alike.
    pub fn begin(&mut self, points: &Points, region: &[[u32; 3]]) -> Result<(), Error> {
        let room = points.len().max(self.sides.len());
        fallible::resize(&mut self.sides, room, (0, Sign::Zero))?;
        self.stamp += 1;
        self.plane = region[0];
        // Coplanar by construction, so no arithmetic is needed.
        for &v in region.iter().flatten() {
            self.sides[v as usize] = (self.stamp, Sign::Zero);
        }
        Ok(())
    }

    /// Which side of the region's plane a vertex is on: positive above, where the triangles turn left.
    pub fn side(&mut self, points: &Points, v: u32) -> Sign {
        let cached = &mut self.sides[v as usize];
        if cached.0 != self.stamp {
            let [a, b, c] = self.plane;
            *cached = (self.stamp, points.orient3d(a, b, c, v));
        }
        cached.1
    }

    /// Collects the tetrahedra that the region, given to [`begin`](Self::begin), crosses.
    pub fn collect(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        region: &[[u32; 3]],
        control: &Control,
    ) -> Result<Opening, Error> {
        self.tets.clear();
        let Some(first) = self.find_first(mesh, points, region, control)? else {
            return Ok(Opening::Nothing);
        };
        fallible::push(&mut self.tets, first)?;
        self.visited.begin();
        self.visited.insert(first)?;
        let mut next = 0;
        while next < self.tets.len() {
            let t = self.tets[next];
            next += 1;
            control.step()?;
            for f in 0..4u32 {
                let n = mesh.beyond(t, f);
                if self.visited.contains(n) {
                    continue;
                }
                let face = mesh.face(4 * t + f);
                let sides = face.map(|v| self.side(points, v));
                if !(sides.contains(&Sign::Positive) && sides.contains(&Sign::Negative)) {
                    continue;
                }
                if mesh.is_subface(4 * t + f) || mesh.is_ghost(n) {
                    return Ok(Opening::Blocked(face));
                }
                self.visited.insert(n)?;
                fallible::push(&mut self.tets, n)?;
            }
        }
        Ok(Opening::Found)
    }

    /// Whether the last search found a tetrahedron.
    pub fn has(&self, t: u32) -> bool {
        self.visited.contains(t)
    }

    /// A tetrahedron whose interior the region enters from an edge of its boundary.
    fn find_first(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        region: &[[u32; 3]],
        control: &Control,
    ) -> Result<Option<u32>, Error> {
        for corners in region {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let start = mesh.vertex_tet[a as usize];
                if start == NONE {
                    continue;
                }
                let found = self.search.find_edge(mesh, a, b, start)?;
                control.worked(self.search.tets.len());
                let Some(t) = found else { continue };
                // Looking along a → b, the region lies at angle 0; the positive tetrahedron (a, b, x, y) spans the angles from x to y, and
                // contains angle 0 exactly if x is below the plane and y above.
                for (t, _, _, k, l) in EdgeRing::new(mesh, t, a, b) {
                    let v = mesh.verts(t);
                    if !mesh.is_ghost(t)
                        && self.side(points, v[k as usize]) == Sign::Negative
                        && self.side(points, v[l as usize]) == Sign::Positive
                    {
                        return Ok(Some(t));
                    }
                }
            }
        }
        Ok(None)
    }
}
