//! The corridor of a missing edge: all tetrahedra that the open segment between two vertices meets.
//!
//! A walk from one end to the other, from feature to feature: through the inside of a face, or across an edge (then the whole ring
//! round that edge belongs to the corridor). Exact signs only, so coplanar points, as on the flat sides of parts, are no special
//! case. A vertex on the segment ends the walk: a valid PLC has none there.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::{EdgeRing, StarSearch};
use crate::kernel::cavity::Cavity;
use crate::kernel::Mesh;
use crate::predicates::{Points, Sign};

/// What the segment crosses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Feature {
    /// The inside of a face.
    Face([u32; 3]),
    /// The inside of an edge.
    Edge([u32; 2]),
}

/// Where the segment goes on.
enum Step {
    /// Into the tetrahedron of this corner code, through the face opposite that corner.
    Face(u32),
    /// Across the inside of an edge of this tetrahedron.
    Edge(u32, u32, u32),
}

/// The result of the walk.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The corridor is in the cavity.
    Found,
    /// The edge is in the mesh.
    Present,
    /// A vertex lies on the segment, or it leaves the hull.
    Blocked,
}

/// Walks; keeps its scratch space.
#[derive(Default)]
pub struct Corridor {
    search: StarSearch,
    ring: Vec<(u32, u32, u32)>,
    /// Edges that the segment meets: those crossed, and those of crossed faces.
    pub obstacles: Vec<[u32; 2]>,
    /// What the segment crosses, in order from its first end.
    pub features: Vec<Feature>,
}

impl Corridor {
    /// Collects the corridor of `a b` in `cavity`.
    pub fn collect(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        [a, b]: [u32; 2],
        cavity: &mut Cavity,
        control: &Control,
    ) -> Result<Outcome, Error> {
        cavity.clear();
        self.obstacles.clear();
        self.features.clear();
        let left = self.leave(mesh, points, [a, b])?;
        control.worked(8 * self.search.tets.len());
        let mut step = match left {
            Ok(step) => step,
            Err(outcome) => return Ok(outcome),
        };
        if let Step::Face(code) = step {
            let first = mesh.across(code) >> 2;
            cavity.add(first)?;
        }
        for _ in 0..mesh.slot_count() {
            control.step()?;
            let feature = match step {
                Step::Face(code) => Feature::Face(mesh.face(code)),
                Step::Edge(_, p, q) => Feature::Edge([p, q]),
            };
            fallible::push(&mut self.features, feature)?;
            let next = match step {
                Step::Face(code) => self.through_face(mesh, points, [a, b], code, cavity)?,
                Step::Edge(t, p, q) => self.across_edge(mesh, points, [a, b], t, [p, q], cavity)?,
            };
            match next {
                Ok(next) => step = next,
                Err(outcome) => return Ok(outcome),
            }
        }
        Ok(Outcome::Blocked)
    }

    /// The first feature met when leaving `a` towards `b`.
    fn leave(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        [a, b]: [u32; 2],
    ) -> Result<Result<Step, Outcome>, Error> {
        let start = mesh.vertex_tet[a as usize];
        self.search.vertex_star(mesh, a, start)?;
        for &t in &self.search.tets {
            if mesh.is_ghost(t) {
                continue;
            }
            if mesh.verts(t).contains(&b) {
                return Ok(Err(Outcome::Present));
            }
            let Some(i) = mesh.slot_of(t, a) else { continue };
            let [x, y, z] = mesh.face(4 * t + i);
            let sx = points.orient3d(a, b, y, z);
            if sx == Sign::Negative {
                continue;
            }
            let sy = points.orient3d(a, x, b, z);
            if sy == Sign::Negative {
                continue;
            }
            let sz = points.orient3d(a, x, y, b);
            if sz == Sign::Negative {
                continue;
            }
            return Ok(match [sx, sy, sz].map(|s| s == Sign::Zero) {
                [false, false, false] => {
                    fallible::extend(&mut self.obstacles, [[x, y], [y, z], [z, x]])?;
                    Ok(Step::Face(mesh.across(4 * t + i)))
                }
                [true, false, false] => Ok(Step::Edge(t, y, z)),
                [false, true, false] => Ok(Step::Edge(t, x, z)),
                [false, false, true] => Ok(Step::Edge(t, x, y)),
                _ => Err(Outcome::Blocked),
            });
        }
        Ok(Err(Outcome::Blocked))
    }

    /// Goes through the tetrahedron behind a face that the segment pierces.
    fn through_face(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        [a, b]: [u32; 2],
        code: u32,
        cavity: &mut Cavity,
    ) -> Result<Result<Step, Outcome>, Error> {
        let t = code >> 2;
        if mesh.is_ghost(t) {
            return Ok(Err(Outcome::Blocked));
        }
        cavity.add(t)?;
        let w = mesh.apex(code);
        if w == b {
            return Ok(Err(Outcome::Found));
        }
        let face = mesh.face(code);
        let inner = points.orient3d(a, b, face[0], face[1]);
        let turns = face.map(|x| points.orient3d(a, b, w, x));
        for k in 0..3 {
            // Through the face of w and the k-th edge of the entered face.
            if turns[k] == inner && turns[(k + 1) % 3] == -inner {
                let (x, y) = (face[k], face[(k + 1) % 3]);
                fallible::extend(&mut self.obstacles, [[w, x], [w, y]])?;
                let opposite = face[(k + 2) % 3];
                let Some(slot) = mesh.slot_of(t, opposite) else { break };
                return Ok(Ok(Step::Face(mesh.across(4 * t + slot))));
            }
        }
        for k in 0..3 {
            if turns[k] == Sign::Zero && turns[(k + 1) % 3] == -inner && turns[(k + 2) % 3] == inner {
                return Ok(Ok(Step::Edge(t, w, face[k])));
            }
        }
        Ok(Err(Outcome::Blocked))
    }

    /// Goes on beyond an edge that the segment crosses.
    fn across_edge(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        [a, b]: [u32; 2],
        t: u32,
        [p, q]: [u32; 2],
        cavity: &mut Cavity,
    ) -> Result<Result<Step, Outcome>, Error> {
        fallible::push(&mut self.obstacles, [p, q])?;
        self.ring.clear();
        for (t, _, _, k, l) in EdgeRing::new(mesh, t, p, q) {
            if mesh.is_ghost(t) {
                return Ok(Err(Outcome::Blocked));
            }
            fallible::push(&mut self.ring, (t, mesh.vertex(t, k), mesh.vertex(t, l)))?;
        }
        for &(t, ..) in &self.ring {
            cavity.add(t)?;
        }
        if self.ring.iter().any(|&(_, r, s)| r == b || s == b) {
            return Ok(Err(Outcome::Found));
        }
        for &(t, r, s) in &self.ring {
            // (p, q, r, s) is positive.
            let (beyond_r, before_s) = (points.orient3d(p, q, r, b), points.orient3d(p, q, b, s));
            if before_s != Sign::Positive || beyond_r == Sign::Negative {
                continue;
            }
            if beyond_r == Sign::Zero {
                // In the plane of p q r.
                let [at_p, at_q, at_r] = [p, q, r].map(|v| points.orient3d(a, b, v, s));
                if at_r == Sign::Zero {
                    return Ok(Err(Outcome::Blocked));
                }
                let other = if at_p == -at_r { p } else { q };
                if at_p != -at_r && at_q != -at_r {
                    return Ok(Err(Outcome::Blocked));
                }
                return Ok(Ok(Step::Edge(t, other, r)));
            }
            let across = points.orient3d(a, b, r, s);
            if across == Sign::Zero {
                return Ok(Ok(Step::Edge(t, r, s)));
            }
            for (v, opposite) in [(p, q), (q, p)] {
                if points.orient3d(a, b, v, r) == across && points.orient3d(a, b, s, v) == across {
                    fallible::extend(&mut self.obstacles, [[r, s], [v, r], [v, s]])?;
                    let Some(slot) = mesh.slot_of(t, opposite) else { break };
                    return Ok(Ok(Step::Face(mesh.across(4 * t + slot))));
                }
            }
            return Ok(Err(Outcome::Blocked));
        }
        Ok(Err(Outcome::Blocked))
    }
}
