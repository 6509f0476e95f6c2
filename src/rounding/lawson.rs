//! Flips of the tetrahedra that replaced ones spoiled by rounding, towards the constrained Delaunay tetrahedralization of the doubles.
//!
//! Lawson's flips in space (Joe 1989): a face that is not locally Delaunay is removed by flipping its two tetrahedra to three or, if they
//! form a reflex edge, by replacing that edge with a sheet that joins the two apexes. In space flips can get stuck, and with tetrahedra
//! that must stay they can cycle, so their number is bounded, and remaining faces are left as they are.
//!
//! Invariants: subfaces and subsegments stay; every tetrahedron is positive in doubles.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::EdgeRing;
use crate::kernel::edge_key;
use crate::kernel::Mesh;
use crate::ops::sheet::Sheets;
use crate::predicates::{Points, Sign};
use crate::rounding::positive;
use crate::rounding::untangle::{is_closed, Place};

/// Limit of flips per initial tetrahedron: faces left over are not locally Delaunay. 4 and 16 change nothing on the only model measured
/// whose points have to move.
const MOST_FLIPS: usize = 8;
/// The most tetrahedra around a reflex edge: the number of sheets grows with it. 3 and 12 change nothing on the only model measured whose
/// points have to move.
const MOST_RING: usize = 6;

/// Flips; keeps its scratch space.
#[derive(Default)]
pub struct Lawson {
    sheets: Sheets,
    old: Vec<u32>,
    link: Vec<u32>,
    new: Vec<[u32; 4]>,
}

impl Lawson {
    /// Flips faces of the given tetrahedra, and of those that come, until all are locally Delaunay or none can be flipped.
    pub fn run(
        &mut self,
        place: &mut Place,
        points: &Points,
        mut stack: Vec<u32>,
        control: &Control,
    ) -> Result<(), Error> {
        let mut left = MOST_FLIPS * stack.len();
        while let Some(t) = stack.pop() {
            control.step()?;
            if !place.mesh.is_live(t) {
                continue;
            }
            for code in 4 * t..4 * t + 4 {
                if left > 0 && self.find(place, points, code)? && place.put(&self.old, &self.new)? {
                    left -= 1;
                    fallible::append(&mut stack, &place.replace.fresh)?;
                    break;
                }
            }
        }
        Ok(())
    }

    /// Finds the flip for a face that is not locally Delaunay.
    fn find(&mut self, place: &Place, points: &Points, code: u32) -> Result<bool, Error> {
        let mesh = &place.mesh;
        let across = mesh.across(code);
        let [a, b, c, d] = mesh.verts(code >> 2);
        let (v, e) = (mesh.apex(code), mesh.apex(across));
        if is_closed(mesh, code) || points.insphere(a, b, c, d, e) != Sign::Positive {
            return Ok(false);
        }
        let [x, y, z] = mesh.face(code);
        self.new.clear();
        fallible::extend(&mut self.new, [[v, x, y, e], [v, y, z, e], [v, z, x, e]])?;
        let flat = self
            .new
            .iter()
            .position(|&tet| points.orient3d(tet[0], tet[1], tet[2], tet[3]) != Sign::Positive);
        match flat {
            None => {
                self.old.clear();
                fallible::extend(&mut self.old, [code >> 2, across >> 2])?;
            }
            Some(i) => {
                let (edge, third) = [([x, y], z), ([y, z], x), ([z, x], y)][i];
                if place.edges.contains(&edge_key(edge[0], edge[1]))
                    || !self.ring(mesh, code >> 2, edge, third)?
                {
                    return Ok(false);
                }
                self.new.clear();
                if !self.sheets.fill(points, edge, &self.link, true, &mut self.new)? {
                    return Ok(false);
                }
            }
        }
        Ok(self.new.iter().all(|&tet| positive(points.coordinates(), tet)))
    }

    /// Collects the tetrahedra round an edge and its link, with `ear` last.
    fn ring(&mut self, mesh: &Mesh, t: u32, [p, q]: [u32; 2], ear: u32) -> Result<bool, Error> {
        self.old.clear();
        self.link.clear();
        self.old.try_reserve(MOST_RING)?;
        self.link.try_reserve(MOST_RING)?;
        for (t, .., k, l) in EdgeRing::new(mesh, t, p, q) {
            if is_closed(mesh, 4 * t + k) || is_closed(mesh, 4 * t + l) || self.old.len() == MOST_RING {
                return Ok(false);
            }
            fallible::push(&mut self.old, t)?;
            fallible::push(&mut self.link, mesh.vertex(t, k))?;
        }
        let Some(at) = self.link.iter().position(|&w| w == ear) else { return Ok(false) };
        self.link.rotate_left(at + 1);
        Ok(true)
    }
}
