//! The vertex among what is there: which tetrahedra are in conflict with it, what it sees, which subsegment it is close to, and the sheets
//! that it splits.
//!
//! A sheet is followed from wall to wall on one side: no subsegment is crossed, so no other wall begins on the way, and both sides tell the
//! same.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::{edge_key, Mesh, NONE};
use crate::ops::insert::Insert;
use crate::predicates::{Points, Sign};
use crate::vector::{dot, sub};

/// The vertex, and where it goes.
#[derive(Clone, Copy)]
pub(super) struct Scene<'a> {
    pub mesh: &'a Mesh,
    pub points: &'a Points,
    /// Of any kind: at doubles, on a segment, on a facet. Only exact signs look at it.
    pub p: u32,
    /// The edge that it splits.
    pub edge: Option<[u32; 2]>,
    pub control: &'a Control<'a>,
}

impl<'a> Scene<'a> {
    pub fn conflict(&self, t: u32) -> bool {
        self.points.inside_perturbed(self.mesh.verts(t), self.p, self.points.xyz(self.p))
    }

    pub fn side(&self, [x, y, z]: [u32; 3]) -> Sign {
        self.points.orient3d(self.p, x, y, z)
    }

    pub fn occupied(&self, vertices: &[u32]) -> Option<u32> {
        vertices.iter().copied().find(|&v| self.points.same_position(v, self.p))
    }

    /// Whether a tetrahedron contains the vertex, on its boundary or inside.
    pub fn contains(&self, t: u32) -> bool {
        (4 * t..4 * t + 4).all(|code| self.side(self.mesh.face(code)) != Sign::Negative)
    }

    pub fn is_split(&self, edge: [u32; 2]) -> bool {
        self.edge.is_some_and(|[a, b]| edge_key(a, b) == edge_key(edge[0], edge[1]))
    }

    /// The subsegments of a tetrahedron but for the edge that is split.
    pub fn subsegments(&self, t: u32) -> impl Iterator<Item = [u32; 2]> + use<'a, '_> {
        self.mesh.subsegments(t).map(|[a, b]| edge_key(a, b)).filter(|&edge| !self.is_split(edge))
    }

    /// Of the subsegments of these tetrahedra the one that the vertex sees under the largest angle. (That is only a choice.)
    pub fn widest(&self, tets: &[u32]) -> Result<Option<[u32; 2]>, Error> {
        let p = self.points.xyz(self.p);
        let cosine = |edge: [u32; 2]| {
            let [u, v] = edge.map(|w| sub(self.points.xyz(w), p));
            dot(&u, &v) / (dot(&u, &u) * dot(&v, &v)).sqrt()
        };
        let mut widest: Option<(f64, [u32; 2])> = None;
        for &t in tets {
            self.control.step()?;
            for edge in self.subsegments(t) {
                let at = cosine(edge);
                if widest.is_none_or(|(least, _)| at.total_cmp(&least).is_lt()) {
                    widest = Some((at, edge));
                }
            }
        }
        Ok(widest.map(|x| x.1))
    }

    /// The wall that continues a wall beyond an edge, on the same side; `None` beyond a subsegment and the edge that is split.
    fn beyond(&self, code: u32, edge: [u32; 2]) -> Result<Option<u32>, Error> {
        if self.is_split(edge) || self.mesh.is_subsegment(code >> 2, edge) {
            return Ok(None);
        }
        let next = self.mesh.next_wall(code, edge);
        next.map(Some).ok_or_else(|| Error::internal("a wall has no neighbour"))
    }
}

/// A wall that the vertex splits.
#[derive(Clone, Copy, Debug)]
pub(super) struct Split {
    /// Its corner on the side of the domain.
    pub code: u32,
    /// The number of the void beyond it; `NONE` if it has the domain on both sides.
    pub void: u32,
}

impl Split {
    /// The wall of a corner on either side.
    pub fn new(mesh: &Mesh, code: u32, void: u32) -> Split {
        let other = mesh.across(code);
        match [code, other].map(|side| mesh.is_ghost(side >> 2)) {
            [false, false] => Split { code, void: NONE },
            [false, true] => Split { code, void },
            _ => Split { code: other, void },
        }
    }
}

/// An edge of the boundary of what is split, in the order of the wall's face.
#[derive(Clone, Copy, Debug)]
pub(super) struct Rim {
    pub edge: [u32; 2],
    pub wall: Split,
}

impl Insert {
    /// The walls in conflict of one sheet, from the one that has the vertex.
    pub(super) fn split_sheet(&mut self, scene: Scene, first: Split) -> Result<(), Error> {
        let mesh = scene.mesh;
        let (name, plane) = (mesh.subface(first.code), mesh.face(first.code));
        let mut next = self.walls.len();
        self.split(scene, first)?;
        while next < self.walls.len() {
            scene.control.step()?;
            let code = self.walls[next].code;
            next += 1;
            for edge in edges(mesh.face(code)) {
                let Some(n) = scene.beyond(code, edge)? else { continue };
                let apart = mesh.subface(n) != name || mesh.is_subface(n) != mesh.is_subface(first.code);
                if apart || self.wall_codes.contains(n) || !scene.conflict(n >> 2) {
                    continue;
                }
                // Subfaces of a patch are in one plane by construction.
                let flat = |&v: &u32| scene.points.orient3d(plane[0], plane[1], plane[2], v) == Sign::Zero;
                if mesh.is_subface(n) || mesh.face(n).iter().all(flat) {
                    self.split(scene, Split { code: n, ..first })?;
                }
            }
        }
        Ok(())
    }

    fn split(&mut self, scene: Scene, wall: Split) -> Result<(), Error> {
        fallible::push(&mut self.walls, wall)?;
        let other = scene.mesh.across(wall.code);
        self.wall_codes.insert(wall.code)?;
        self.wall_codes.insert(other)?;
        self.seed(wall.code >> 2)?;
        if wall.void == NONE {
            self.seed(other >> 2)?;
        }
        Ok(())
    }

    /// Collects the edges that bound what is split of each sheet, sorted.
    pub(super) fn find_rim(&mut self, scene: Scene) -> Result<(), Error> {
        self.rim.clear();
        for i in 0..self.walls.len() {
            scene.control.step()?;
            let wall = self.walls[i];
            for edge in edges(scene.mesh.face(wall.code)) {
                let next = scene.beyond(wall.code, edge)?;
                let inner = next.is_some_and(|n| self.wall_codes.contains(n) && self.inside.contains(n >> 2));
                if !inner && !scene.is_split(edge) {
                    fallible::push(&mut self.rim, Rim { edge, wall })?;
                }
            }
        }
        let key = |rim: &Rim| (edge_key(rim.edge[0], rim.edge[1]), rim.wall.code);
        scene.control.sort_by(&mut self.rim, |x, y| key(x).cmp(&key(y)))
    }

    /// Whether this edge, given by its key, bounds what is split.
    pub(super) fn is_on_rim(&self, key: [u32; 2]) -> bool {
        self.rim.binary_search_by(|rim| edge_key(rim.edge[0], rim.edge[1]).cmp(&key)).is_ok()
    }
}

/// The edges of a triangle in its order; that of number `k` is opposite corner `k + 2` modulo 3.
pub(super) fn edges([x, y, z]: [u32; 3]) -> [[u32; 2]; 3] {
    [[x, y], [y, z], [z, x]]
}
