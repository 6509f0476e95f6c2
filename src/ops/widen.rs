//! Cavities grown until one position sees all their faces, for points whose stars leave no room.
//!
//! If triangles of the surface are nearly coplanar, tetrahedra between them are as thin as the last bits of coordinates, and no double lies
//! between their faces. A position clearly above the surface sees all its triangles, but not the faces of the thin tetrahedra that are
//! turned away from it. So the position comes first: every tetrahedron behind a face that it does not see is added, until it sees all faces
//! or one that it does not see must stay. The cavity is the smallest that holds the start and is star-shaped from the position; which
//! tetrahedra it has does not depend on the order of the work.
//!
//! Points inside that the cavity swallows are no longer needed; other vertices must stay on its boundary.
use crate::control::Control;
use crate::elementary::power_of_two;
use crate::error::Error;
use crate::fallible;
use crate::kernel::cavity::{Cavity, Terms};
use crate::kernel::face_key;
use crate::kernel::Mesh;
use crate::ops::hollow::Start;
use crate::predicates::{in_range, Points, Sign};
use crate::vector::{dot, sub};
use rustc_hash::FxHashSet;

/// Most tetrahedra of a cavity: bounds the work for one point. None of the models measured reaches it.
const MOST_TETS: usize = 1024;

/// How often the height above the start is quartered: as often as doubles tell apart. None of the models measured reaches it.
const QUARTERINGS: i32 = 28;

/// Grows cavities; keeps its scratch space.
#[derive(Default)]
pub struct Widen {
    /// The tetrahedra taken out, and what bounds them.
    pub cavity: Cavity,
    /// Points inside that no longer belong to any tetrahedron.
    pub swallowed: Vec<u32>,
    /// What the last search looked at, with repetitions.
    pub read: Vec<u32>,
    doors: Vec<u32>,
}

/// Where a position is looked for.
#[derive(Clone, Copy, Debug)]
pub struct Rays<'a> {
    /// The point that is to get it.
    pub point: u32,
    /// Near which the cavity is open.
    pub from: [f64; 3],
    /// Directions into it, of length one.
    pub toward: &'a [[f64; 3]],
}

/// What a cavity respects besides its start.
#[derive(Clone, Copy, Debug)]
pub struct Kept<'a> {
    /// Edges that must stay.
    pub isolated: &'a FxHashSet<[u32; 2]>,
    /// The points inside: all that it may swallow.
    pub inside: &'a [u32],
}

impl Widen {
    /// Moves the point to a position from which a cavity that holds the start is star-shaped. Returns the new tetrahedra, or nothing;
    /// the old ones are in `self.cavity`.
    pub fn place(
        &mut self,
        mesh: &Mesh,
        points: &mut Points,
        start: &Start,
        kept: Kept,
        rays: &Rays,
        control: &Control,
    ) -> Result<Option<Vec<[u32; 4]>>, Error> {
        let p = rays.point;
        self.read.clear();
        let corners = start.tets.iter().flat_map(|&t| mesh.verts(t));
        let reach =
            corners.map(|v| sub(points.xyz(v), &rays.from)).map(|d| dot(&d, &d)).fold(0.0, f64::max).sqrt();
        for k in 1..=QUARTERINGS {
            let height = reach * power_of_two(-2 * k);
            for way in rays.toward {
                let at = [0, 1, 2].map(|k| rays.from[k] + height * way[k]);
                if !at.iter().all(|&x| in_range(x)) {
                    continue;
                }
                points.move_to(p, at)?;
                if self.grow(mesh, points, p, start, control)? && self.keeps(mesh, start, kept)? {
                    let faces = &self.cavity.faces;
                    let (boundary, walls) = faces.split_at(faces.len() - start.walls.len());
                    let new = walls.iter().chain(boundary).map(|&[x, y, z]| [p, x, y, z]);
                    return Ok(Some(fallible::collect(new)?));
                }
            }
        }
        Ok(None)
    }

    /// The smallest cavity that holds the start and is star-shaped from `p`; false if there is none.
    fn grow(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        p: u32,
        start: &Start,
        control: &Control,
    ) -> Result<bool, Error> {
        let sees = |[x, y, z]: [u32; 3]| points.orient3d(p, x, y, z) == Sign::Positive;
        if !start.walls.iter().all(|&face| sees(face)) {
            return Ok(false);
        }
        self.cavity.set(start.tets)?;
        self.doors.clear();
        self.doors.try_reserve(4 * start.tets.len())?;
        fallible::extend(&mut self.doors, start.tets.iter().flat_map(|&t| 4 * t..4 * t + 4))?;
        while let Some(code) = self.doors.pop() {
            control.step()?;
            let n = mesh.across(code);
            let wall = mesh.is_wall(code);
            if !wall && self.cavity.has(n >> 2) {
                continue;
            }
            let face = mesh.face(code);
            if (wall && start.gone.contains(&face_key(face))) || sees(face) {
                continue;
            }
            if wall || self.cavity.tets.len() >= MOST_TETS {
                return Ok(false);
            }
            let (t, verts) = (n >> 2, mesh.verts(n >> 2));
            fallible::push(&mut self.read, t)?;
            if start.taken.iter().any(|s| s.old.contains(&t)) || start.avoid.iter().all(|v| verts.contains(v))
            {
                return Ok(false);
            }
            self.cavity.add(t)?;
            fallible::extend(&mut self.doors, (4 * t..4 * t + 4).filter(|&code| code != n))?;
        }
        Ok(true)
    }

    /// Collects the faces of the cavity; false if a vertex or an edge that must stay is on none of them.
    fn keeps(&mut self, mesh: &Mesh, start: &Start, kept: Kept) -> Result<bool, Error> {
        let Start { gone, walls, without, .. } = *start;
        self.cavity.bound(mesh, &Terms { keep: kept.isolated, gone, walls, without })?;
        self.swallowed.clear();
        fallible::append(&mut self.swallowed, &self.cavity.inner)?;
        Ok(self.cavity.edges.is_empty() && self.swallowed.iter().all(|v| kept.inside.contains(v)))
    }
}
