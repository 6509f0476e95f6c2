//! Stars: the tetrahedra around a vertex or an edge.
use crate::kernel::tables::OTHERS;
use crate::kernel::{flag, Tetrahedra};

/// Scratch space for star searches.
#[derive(Clone, Debug, Default)]
pub struct StarSearch {
    /// The tetrahedra found by the last search.
    pub tets: Vec<u32>,
}

impl StarSearch {
    /// Collects the star of vertex `v` into `self.tets`, starting from `start`, a tetrahedron with that vertex.
    pub fn vertex_star(&mut self, mesh: &mut Tetrahedra, v: u32, start: u32) {
        self.tets.clear();
        self.tets.push(start);
        mesh.flags[start as usize] |= flag::MARK;
        let mut next = 0;
        while next < self.tets.len() {
            let t = self.tets[next] as usize;
            next += 1;
            for f in 0..4 {
                if mesh.verts[t][f] == v {
                    continue;
                }
                let n = mesh.adj[t][f] >> 2;
                if mesh.flags[n as usize] & flag::MARK == 0 {
                    mesh.flags[n as usize] |= flag::MARK;
                    self.tets.push(n);
                }
            }
        }
        for &t in &self.tets {
            mesh.flags[t as usize] &= !flag::MARK;
        }
    }

    /// A tetrahedron with the edge `v w`, if that is an edge of the mesh; `start` has vertex `v`. Searches the star of `v`
    /// breadth-first and stops at the first hit.
    pub fn find_edge(&mut self, mesh: &mut Tetrahedra, v: u32, w: u32, start: u32) -> Option<u32> {
        if mesh.verts[start as usize].contains(&w) {
            return Some(start);
        }
        self.tets.clear();
        self.tets.push(start);
        mesh.flags[start as usize] |= flag::MARK;
        let mut next = 0;
        let mut found = None;
        'search: while next < self.tets.len() {
            let t = self.tets[next];
            next += 1;
            let verts = mesh.verts[t as usize];
            let adj = mesh.adj[t as usize];
            for (&opposite, code) in verts.iter().zip(adj) {
                let n = code >> 2;
                if opposite == v || mesh.flags[n as usize] & flag::MARK != 0 {
                    continue;
                }
                // The previous tetrahedron does not have `w`, so only the apex can be it.
                if mesh.apex(code) == w {
                    found = Some(n);
                    break 'search;
                }
                mesh.flags[n as usize] |= flag::MARK;
                self.tets.push(n);
            }
        }
        for &t in &self.tets {
            mesh.flags[t as usize] &= !flag::MARK;
        }
        found
    }
}

impl StarSearch {
    /// A corner code of the face `a b c`, if it is in the mesh; `start` has vertex `a`.
    pub fn find_face(&mut self, mesh: &mut Tetrahedra, [a, b, c]: [u32; 3], start: u32) -> Option<u32> {
        let t = self.find_edge(mesh, a, b, start)?;
        EdgeRing::new(mesh, t, a, b)
            .find(|&(t, _, _, _, l)| mesh.verts[t as usize][l as usize] == c)
            .map(|(t, _, _, k, _)| 4 * t + k)
    }
}

/// Walks once around an edge.
///
/// Yields `(t, i, j, k, l)`: the tetrahedron, the slots of the edge's ends and of the two other vertices, such that
/// `(i, j, k, l)` is an even permutation; the next tetrahedron lies across the face opposite slot `k`.
pub struct EdgeRing<'a> {
    mesh: &'a Tetrahedra,
    ends: [u32; 2],
    start: u32,
    current: Option<u32>,
}

impl<'a> EdgeRing<'a> {
    /// A ring around the edge `a b` of tetrahedron `t`.
    pub fn new(mesh: &'a Tetrahedra, t: u32, a: u32, b: u32) -> Self {
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
        let next = self.mesh.adj[t as usize][k as usize] >> 2;
        self.current = if next == self.start { None } else { Some(next) };
        Some((t, i, j, k as u32, l as u32))
    }
}
