//! Other apexes for the walls of a bad tetrahedron.
//!
//! A flat tetrahedron on the boundary can be removed only if its walls get another apex, which may be far away, on the other side of a thin
//! part. So apexes are chosen by the tetrahedra that they would form with the walls, and the cavity is what these overlap, as when
//! inserting a vertex (Watson 1981), but for an existing vertex. All this is floating-point arithmetic: it only chooses what to try.
use crate::error::Error;
use crate::fallible;
use crate::kernel::tables::FACE;
use crate::kernel::visited::Visited;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::reshape::may_join;
use crate::ops::shape::{Goal, Shape};
use crate::predicates::Points;
use crate::vector::{cross, dot, sub};
use rustc_hash::FxHashSet;

/// Most tetrahedra round a bad one whose vertices may become apexes: time for more to choose from. On nine models with 22 points inside 100
/// changes two meshes, 400 two meshes, but never their number.
const NEAR: usize = 200;

/// Most tetrahedra of a cavity: larger ones take more time. On nine models with 22 points inside 30 changes one mesh, 120 none, but never
/// their number.
const MOST: usize = 60;

/// How many of the apexes with the best tetrahedra are considered: time for better shapes. On nine models with 22 points inside 10 changes
/// six meshes, 40 two meshes, but never their number.
const CANDIDATES: usize = 20;
/// How many of these are tried, those with the smallest cavities: time for better shapes. On nine models with 22 points inside 4 changes
/// none, 16 three meshes, but never their number.
const TRIES: usize = 8;

/// Finds apexes and cavities; keeps its scratch space.
#[derive(Default)]
pub struct Approach {
    /// Vertices that would make better tetrahedra with the walls; what they overlap is smallest for the first.
    pub apexes: Vec<u32>,
    /// The walls: `(p, x, y, z)` is positive for `p` on the side of the tetrahedron.
    pub walls: Vec<[u32; 3]>,
    near: Vec<u32>,
    visited: Visited,
    /// Candidates, and how good their tetrahedra are.
    ranked: Vec<(f64, u32)>,
    /// Those left, after the size of what they overlap.
    sized: Vec<(usize, u32)>,
}

impl Approach {
    /// Finds apexes for the walls of a tetrahedron, so that the goal is reached there; none if it has no wall.
    pub fn find(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        goal: &Goal,
    ) -> Result<(), Error> {
        self.apexes.clear();
        self.walls.clear();
        fallible::extend(
            &mut self.walls,
            (4 * t..4 * t + 4).filter(|&c| mesh.is_wall(c)).map(|c| mesh.face(c)),
        )?;
        if self.walls.is_empty() {
            return Ok(());
        }
        self.look_round(mesh, t)?;
        self.rank(mesh, points, t, goal)?;
        let mut tets = std::mem::take(&mut self.near);
        self.sized.clear();
        self.sized.try_reserve(CANDIDATES)?;
        for i in 0..self.ranked.len().min(CANDIDATES) {
            let apex = self.ranked[i].1;
            if self.collect(mesh, points, isolated, t, apex, &mut tets)? {
                fallible::push(&mut self.sized, (tets.len(), apex))?;
            }
        }
        self.near = tets;
        self.sized.sort_unstable();
        fallible::extend(&mut self.apexes, self.sized.iter().take(TRIES).map(|s| s.1))?;
        Ok(())
    }

    /// Collects tetrahedra round one, layer by layer, not beyond walls.
    fn look_round(&mut self, mesh: &Mesh, t: u32) -> Result<(), Error> {
        self.near.clear();
        self.near.try_reserve(NEAR + 4)?;
        fallible::push(&mut self.near, t)?;
        self.visited.begin();
        self.visited.insert(t)?;
        let mut i = 0;
        while i < self.near.len() && self.near.len() < NEAR {
            for code in 4 * self.near[i]..4 * self.near[i] + 4 {
                let n = mesh.across(code) >> 2;
                if !mesh.is_wall(code) && self.visited.insert(n)? {
                    fallible::push(&mut self.near, n)?;
                }
            }
            i += 1;
        }
        Ok(())
    }

    /// Ranks the vertices of these tetrahedra by the worse of their tetrahedra at the walls.
    fn rank(&mut self, mesh: &Mesh, points: &Points, t: u32, goal: &Goal) -> Result<(), Error> {
        self.ranked.clear();
        let first = mesh.verts(t);
        for &n in &self.near {
            for p in mesh.verts(n) {
                if first.contains(&p) || self.ranked.iter().any(|r| r.1 == p) {
                    continue;
                }
                let of = |&[x, y, z]: &[u32; 3]| goal.quality(Shape::of(points, [p, x, y, z]));
                fallible::push(
                    &mut self.ranked,
                    (self.walls.iter().map(of).fold(f64::INFINITY, f64::min), p),
                )?;
            }
        }
        self.ranked.retain(|r| r.0 > goal.above);
        self.ranked.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
        Ok(())
    }

    /// Collects what the tetrahedra of an apex and the walls overlap; false if that is too much or must not be changed.
    pub fn collect(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        isolated: &FxHashSet<[u32; 2]>,
        t: u32,
        apex: u32,
        tets: &mut Vec<u32>,
    ) -> Result<bool, Error> {
        tets.clear();
        tets.try_reserve(MOST + 4)?;
        fallible::push(tets, t)?;
        self.visited.begin();
        self.visited.insert(t)?;
        let mut i = 0;
        let mut whole = true;
        while i < tets.len() && tets.len() < MOST && whole {
            for code in 4 * tets[i]..4 * tets[i] + 4 {
                let n = mesh.across(code) >> 2;
                if self.visited.contains(n) || mesh.region(n) == NONE {
                    continue;
                }
                let verts = mesh.verts(n);
                if self.walls.iter().any(|&[x, y, z]| overlap(points, [apex, x, y, z], verts)) {
                    whole &= !mesh.is_wall(code) && may_join(mesh, isolated, &self.visited, n);
                    self.visited.insert(n)?;
                    fallible::push(tets, n)?;
                }
            }
            i += 1;
        }
        Ok(whole && tets.len() < MOST)
    }
}

/// Whether no plane of a face seems to separate two positive tetrahedra.
fn overlap(points: &Points, a: [u32; 4], b: [u32; 4]) -> bool {
    !parts(points, a, b) && !parts(points, b, a)
}

/// Whether the plane of a face of the first tetrahedron seems to separate it from the second.
fn parts(points: &Points, a: [u32; 4], b: [u32; 4]) -> bool {
    FACE.iter().any(|face| {
        let face = face.map(|i| a[i as usize]);
        let [x, y, z] = face.map(|v| points.xyz(v));
        b.iter().filter(|w| !face.contains(w)).all(|&w| {
            let [u, v, w] = [x, y, z].map(|p| sub(p, points.xyz(w)));
            dot(&u, &cross(&v, &w)) <= 0.0
        })
    })
}
