//! Stars of vertices and rings of edges.
use crate::error::Error;
use crate::fallible;
use crate::kernel::tables::OTHERS;
use crate::kernel::visited::Visited;
use crate::kernel::Mesh;

/// Searches stars; keeps its scratch space.
#[derive(Debug, Default)]
pub struct StarSearch {
    /// The tetrahedra found by the last search.
    pub tets: Vec<u32>,
    visited: Visited,
}

impl StarSearch {
    fn begin(&mut self, start: u32) -> Result<(), Error> {
        self.tets.clear();
        self.visited.begin();
        self.visited.insert(start)?;
        fallible::push(&mut self.tets, start)?;
        Ok(())
    }

    /// Collects the star of vertex `v` into `self.tets`, starting from `start`, a tetrahedron with that vertex.
    pub fn vertex_star(&mut self, mesh: &Mesh, v: u32, start: u32) -> Result<(), Error> {
        self.begin(start)?;
        let mut next = 0;
        while next < self.tets.len() {
            let t = self.tets[next];
            next += 1;
            for (w, code) in mesh.verts(t).into_iter().zip(mesh.adj(t)) {
                if w != v && self.visited.insert(code >> 2)? {
                    fallible::push(&mut self.tets, code >> 2)?;
                }
            }
        }
        Ok(())
    }

    /// The faces opposite a vertex inside, turned towards it. `self.tets` gets its star.
    pub fn link(&mut self, mesh: &Mesh, v: u32, faces: &mut Vec<[u32; 3]>) -> Result<(), Error> {
        self.vertex_star(mesh, v, mesh.vertex_tet[v as usize])?;
        faces.clear();
        faces.try_reserve(self.tets.len())?;
        for &t in &self.tets {
            if let Some(slot) = mesh.slot_of(t, v) {
                fallible::push(faces, mesh.face(4 * t + slot))?;
            }
        }
        Ok(())
    }

    /// A tetrahedron with the edge `v w`, if that is an edge of the mesh; `start` has vertex `v`. Searches the star of `v`
    /// breadth-first and stops at the first hit.
    pub fn find_edge(&mut self, mesh: &Mesh, v: u32, w: u32, start: u32) -> Result<Option<u32>, Error> {
        if mesh.verts(start).contains(&w) {
            return Ok(Some(start));
        }
        self.begin(start)?;
        let mut next = 0;
        while next < self.tets.len() {
            let t = self.tets[next];
            next += 1;
            for (opposite, code) in mesh.verts(t).into_iter().zip(mesh.adj(t)) {
                let n = code >> 2;
                if opposite == v || !self.visited.insert(n)? {
                    continue;
                }
                // The previous tetrahedron does not have `w`, so only the apex can be it.
                if mesh.apex(code) == w {
                    return Ok(Some(n));
                }
                fallible::push(&mut self.tets, n)?;
            }
        }
        Ok(None)
    }

    /// A corner code of the face `a b c`, if it is in the mesh; `start` has vertex `a`.
    pub fn find_face(&mut self, mesh: &Mesh, [a, b, c]: [u32; 3], start: u32) -> Result<Option<u32>, Error> {
        let Some(t) = self.find_edge(mesh, a, b, start)? else { return Ok(None) };
        Ok(EdgeRing::new(mesh, t, a, b)
            .find(|&(t, _, _, _, l)| mesh.vertex(t, l) == c)
            .map(|(t, _, _, k, _)| 4 * t + k))
    }
}

impl Mesh {
    /// The wall after the wall `code` on a turn round its edge `a b` through the tetrahedra on this side, seen from this side.
    pub fn next_wall(&self, code: u32, [a, b]: [u32; 2]) -> Option<u32> {
        let mut entered = code;
        for _ in self.all() {
            let t = entered >> 2;
            let others = |&k: &u32| k != entered & 3 && ![a, b].contains(&self.vertex(t, k));
            let left = 4 * t + (0..4).find(others)?;
            if self.is_wall(left) {
                return Some(left);
            }
            entered = self.across(left);
        }
        None
    }
}

/// Walks once around an edge.
///
/// Yields `(t, i, j, k, l)`: the tetrahedron, the slots of the edge's ends and of the two other vertices, such that
/// `(i, j, k, l)` is an even permutation; the next tetrahedron lies across the face opposite slot `k`.
pub struct EdgeRing<'a> {
    mesh: &'a Mesh,
    ends: [u32; 2],
    start: u32,
    current: Option<u32>,
}

impl<'a> EdgeRing<'a> {
    /// A ring around the edge `a b` of tetrahedron `t`.
    pub fn new(mesh: &'a Mesh, t: u32, a: u32, b: u32) -> Self {
        EdgeRing { mesh, ends: [a, b], start: t, current: Some(t) }
    }
}

impl Iterator for EdgeRing<'_> {
    type Item = (u32, u32, u32, u32, u32);

    fn next(&mut self) -> Option<Self::Item> {
        let t = self.current?;
        let i = self.mesh.slot_of(t, self.ends[0])?;
        let j = self.mesh.slot_of(t, self.ends[1])?;
        let [k, l] = OTHERS[i as usize][j as usize];
        let next = self.mesh.beyond(t, u32::from(k));
        self.current = if next == self.start { None } else { Some(next) };
        Some((t, i, j, k as u32, l as u32))
    }
}
