//! A polyhedron hollowed out of the mesh on one side of new walls, and its growth.
//!
//! What cannot be filled as it is often can when a tetrahedron behind one of its faces is added: the face that blocks it is gone then.
//! Tetrahedra behind faces that few vertices see from inside are added first.
use super::solid::{Sector, Solid};
use crate::constrain::{edge_key, face_key};
use crate::error::Error;
use crate::mesh::tables::EDGE;
use crate::mesh::NONE;
use crate::predicates::{Points, Sign};
use crate::reconnect::{Polyhedron, Reconnect, MOST_VERTICES};
use rustc_hash::FxHashSet;

/// How far to grow.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    /// Steps per search.
    pub budget: u32,
    /// Single tetrahedra tried at each stage.
    pub singles: usize,
    /// Most tetrahedra added one after the other.
    pub stages: usize,
}

/// A polyhedron to fill; keeps its scratch space.
#[derive(Default)]
pub struct Hollow {
    /// Tetrahedra taken out.
    pub tets: Vec<u32>,
    /// Boundary, turned inward: of the tetrahedra, but for the walls that go, and new walls.
    pub faces: Vec<[u32; 3]>,
    inner: Vec<u32>,
    edges: Vec<[u32; 2]>,
    inside: FxHashSet<u32>,
    corners: FxHashSet<u32>,
    /// Faces of tetrahedra behind which others could be added: corner codes of these.
    doors: Vec<(u32, u32)>,
}

/// What a hollow starts from.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a> {
    /// The tetrahedra that must go.
    pub tets: &'a [u32],
    /// Subfaces that go, as keys.
    pub gone: &'a [[u32; 3]],
    /// Walls that come, turned inward.
    pub walls: &'a [[u32; 3]],
    /// A vertex that goes, or `NONE`.
    pub without: u32,
    /// An edge that must come.
    pub edge: Option<[u32; 2]>,
    /// Tetrahedra with both vertices are not added: they belong to another part of the same replacement.
    pub avoid: [u32; 2],
    /// Nor are these.
    pub taken: &'a [Sector],
}

impl Hollow {
    /// Finds the boundary for the tetrahedra in `self.tets`.
    fn bound(&mut self, solid: &Solid, start: &Start, isolated: &FxHashSet<[u32; 2]>) -> Result<(), Error> {
        let mesh = &solid.mesh;
        self.inside.clear();
        self.inside.extend(self.tets.iter().copied());
        self.faces.clear();
        self.doors.clear();
        for &t in &self.tets {
            for code in 4 * t..4 * t + 4 {
                let n = mesh.across(code) >> 2;
                let wall = solid.is_wall(code);
                if !wall && self.inside.contains(&n) {
                    continue;
                }
                let face = mesh.face(code);
                if wall && start.gone.contains(&face_key(face)) {
                    continue;
                }
                self.faces.try_reserve(1)?;
                self.faces.push(face);
                if !wall {
                    self.doors.try_reserve(1)?;
                    self.doors.push((self.faces.len() as u32 - 1, mesh.across(code)));
                }
            }
        }
        self.faces.try_reserve(start.walls.len())?;
        self.faces.extend_from_slice(start.walls);
        self.corners.clear();
        self.corners.extend(self.faces.iter().flatten().copied());
        self.inner.clear();
        self.edges.clear();
        self.edges.extend(start.edge);
        for &t in &self.tets {
            let verts = mesh.verts[t as usize];
            for v in verts {
                if v != start.without && self.corners.insert(v) {
                    self.inner.try_reserve(1)?;
                    self.inner.push(v);
                }
            }
            if isolated.is_empty() {
                continue;
            }
            for [i, j] in EDGE {
                let key = edge_key(verts[i as usize], verts[j as usize]);
                if isolated.contains(&key) && !key.contains(&start.without) && !self.edges.contains(&key) {
                    self.edges.try_reserve(1)?;
                    self.edges.push(key);
                }
            }
        }
        Ok(())
    }

    fn fill(
        &self,
        reconnect: &mut Reconnect,
        points: &Points,
        budget: u32,
        new: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        if self.corners.len() > MOST_VERTICES {
            return Ok(false);
        }
        let polyhedron =
            Polyhedron { faces: &self.faces, inner: &self.inner, edges: &self.edges, without: None };
        reconnect.fill(points, &polyhedron, budget, new)
    }

    /// Fills the hollow with more and more tetrahedra added. Returns the new tetrahedra, or nothing; the old ones are in `self.tets`.
    pub fn grow(
        &mut self,
        solid: &Solid,
        points: &Points,
        reconnect: &mut Reconnect,
        start: &Start,
        isolated: &FxHashSet<[u32; 2]>,
        growth: Growth,
    ) -> Result<Option<Vec<[u32; 4]>>, Error> {
        self.tets.clear();
        self.tets.try_reserve(start.tets.len() + growth.stages)?;
        self.tets.extend_from_slice(start.tets);
        let mut new = Vec::new();
        let growth = match std::env::var("DBGG") {
            Ok(s) => {
                let v: Vec<usize> = s.split(',').map(|x| x.parse().unwrap()).collect();
                Growth { budget: v[0] as u32, singles: v[1], stages: v[2] }
            }
            _ => growth,
        };
        for _ in 0..growth.stages {
            self.bound(solid, start, isolated)?;
            let ranked = self.ranked(solid, points, start)?;
            for &(_, t) in ranked.iter().take(growth.singles) {
                self.tets.push(t);
                self.bound(solid, start, isolated)?;
                if self.fill(reconnect, points, growth.budget, &mut new)? {
                    return Ok(Some(new));
                }
                self.tets.pop();
            }
            let Some(&(_, t)) = ranked.first() else { break };
            self.tets.push(t);
        }
        Ok(None)
    }

    /// Tetrahedra that could be added, those behind the faces that the fewest vertices see first.
    fn ranked(&self, solid: &Solid, points: &Points, start: &Start) -> Result<Vec<(u32, u32)>, Error> {
        let mut vertices: Vec<u32> = self.corners.iter().copied().collect();
        vertices.sort_unstable();
        let mut ranked: Vec<(u32, u32)> = Vec::new();
        ranked.try_reserve(self.doors.len())?;
        for &(face, code) in &self.doors {
            let [x, y, z] = self.faces[face as usize];
            let seen = vertices
                .iter()
                .filter(|&&v| v != x && v != y && v != z && points.orient3d(v, x, y, z) == Sign::Positive)
                .count();
            let t = code >> 2;
            let verts = &solid.mesh.verts[t as usize];
            let taken = start.taken.iter().any(|s| s.old.contains(&t));
            if solid.region[t as usize] == NONE || taken || start.avoid.iter().all(|v| verts.contains(v)) {
                continue;
            }
            ranked.push((seen as u32, t));
        }
        ranked.sort_unstable();
        let mut known = FxHashSet::default();
        ranked.retain(|x| known.insert(x.1));
        Ok(ranked)
    }
}
