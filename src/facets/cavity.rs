//! The cavity of a region: the tetrahedra that it crosses (Si & Gärtner 2011, section 6).
//!
//! A region is a set of coplanar triangles whose boundary edges are edges of the mesh. Two facts keep the search combinatorial: the section
//! of a tetrahedron with the plane then lies entirely inside or outside the region; and the tetrahedra that the region crosses are
//! connected through faces with vertices on both sides of the plane.
use crate::delaunay::Delaunay;
use crate::error::Error;
use crate::kernel::star::{EdgeRing, StarSearch};
use crate::kernel::{flag, NONE};
use crate::predicates::{Points, Sign};

/// The result of the search.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Opening {
    /// The tetrahedra were found and marked.
    Found,
    /// No tetrahedron crosses the region.
    Nothing,
    /// This face, a subface or on the hull, blocks the search. Nothing is marked.
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
}

impl RegionCavity {
    /// Sets the region, whose triangles must all be oriented alike.
    pub fn begin(&mut self, points: &Points, region: &[[u32; 3]]) -> Result<(), Error> {
        let missing = points.len().saturating_sub(self.sides.len());
        self.sides.try_reserve(missing)?;
        self.sides.resize(self.sides.len() + missing, (0, Sign::Zero));
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

    /// Collects and marks the tetrahedra that the region, given to [`begin`](Self::begin), crosses.
    pub fn collect(
        &mut self,
        delaunay: &mut Delaunay,
        points: &Points,
        region: &[[u32; 3]],
    ) -> Result<Opening, Error> {
        self.tets.clear();
        let Some(first) = self.find_first(delaunay, points, region) else { return Ok(Opening::Nothing) };
        self.tets.try_reserve(1)?;
        self.tets.push(first);
        delaunay.mesh.flags[first as usize] |= flag::MARK;
        let mut next = 0;
        while next < self.tets.len() {
            let t = self.tets[next];
            next += 1;
            self.tets.try_reserve(4)?;
            for f in 0..4u32 {
                let mesh = &mut delaunay.mesh;
                let n = mesh.adj[t as usize][f as usize] >> 2;
                if mesh.flags[n as usize] & flag::MARK != 0 {
                    continue;
                }
                let face = mesh.face(4 * t + f);
                let sides = face.map(|v| self.side(points, v));
                if !(sides.contains(&Sign::Positive) && sides.contains(&Sign::Negative)) {
                    continue;
                }
                if mesh.flags[t as usize] & (flag::FACE << f) != 0 || mesh.is_ghost(n) {
                    self.unmark(delaunay);
                    return Ok(Opening::Blocked(face));
                }
                mesh.flags[n as usize] |= flag::MARK;
                self.tets.push(n);
            }
        }
        Ok(Opening::Found)
    }

    /// Removes the marks.
    pub fn unmark(&self, delaunay: &mut Delaunay) {
        for &t in &self.tets {
            delaunay.mesh.flags[t as usize] &= !flag::MARK;
        }
    }

    /// A tetrahedron whose interior the region enters from an edge of its boundary.
    fn find_first(&mut self, delaunay: &mut Delaunay, points: &Points, region: &[[u32; 3]]) -> Option<u32> {
        for corners in region {
            for k in 0..3 {
                let (a, b) = (corners[k], corners[(k + 1) % 3]);
                let start = delaunay.vertex_tet[a as usize];
                if start == NONE {
                    continue;
                }
                let Some(t) = self.search.find_edge(&mut delaunay.mesh, a, b, start) else { continue };
                // Looking along a → b, the region lies at angle 0; the positive tetrahedron (a, b, x, y) spans the angles from x to y, and
                // contains angle 0 exactly if x is below the plane and y above.
                let mesh = &delaunay.mesh;
                for (t, _, _, k, l) in EdgeRing::new(mesh, t, a, b) {
                    let v = mesh.verts[t as usize];
                    if !mesh.is_ghost(t)
                        && self.side(points, v[k as usize]) == Sign::Negative
                        && self.side(points, v[l as usize]) == Sign::Positive
                    {
                        return Some(t);
                    }
                }
            }
        }
        None
    }
}
