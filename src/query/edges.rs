//! All edges of a mesh, each once, sorted by their ends.
//!
//! Counting sort by the smaller end, then a small sort by the larger one: about 10 entries per vertex.
use crate::error::{Error, Status};
use crate::fallible;
use crate::query::EDGE_ENDS;
use crate::{TetMesh, INVALID};

/// An edge of the mesh.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct Edge {
    /// The ends, the smaller first.
    pub ends: [u32; 2],
    /// The first tetrahedron that has it.
    pub tet: u32,
    /// Its subsegment, or [`INVALID`] if it is not constrained.
    pub subsegment: u32,
    /// The marker of its subsegment, or 0.
    pub marker: i32,
}

/// The edges of a mesh, and those of each tetrahedron and subface.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Edges {
    /// Every edge once, sorted by ends.
    pub edges: Vec<Edge>,
    /// Edges whose smaller end is `v` are `edges[starts[v]..starts[v + 1]]`.
    starts: Vec<u32>,
    /// For each tetrahedron its edges 01 02 03 12 13 23.
    pub tet_edges: Vec<[u32; 6]>,
    /// For each subface `(a, b, c)` its edges ab, bc, ca.
    pub subface_edges: Vec<[u32; 3]>,
}

impl Edges {
    /// Lists the edges of `mesh` alone, not those of tetrahedra and subfaces, and without subsegments. Fails as [`Edges::new`].
    pub(super) fn alone(mesh: &TetMesh) -> Result<Edges, Error> {
        let mut list = Edges::default();
        list.collect(mesh)?;
        Ok(list)
    }

    /// Lists the edges of `mesh`. Fails if memory runs out or there are more than 2³² − 2 edges.
    pub fn new(mesh: &TetMesh) -> Result<Edges, Error> {
        let mut list = Edges::alone(mesh)?;
        list.tet_edges.try_reserve_exact(mesh.tets.len())?;
        for tet in &mesh.tets {
            let edges = EDGE_ENDS.map(|[a, b]| list.find(tet[a], tet[b]).unwrap_or(INVALID));
            fallible::push(&mut list.tet_edges, edges)?;
        }
        list.subface_edges.try_reserve_exact(mesh.subfaces.len())?;
        for subface in &mesh.subfaces {
            let [a, b, c] = subface.corners;
            let edges = [(a, b), (b, c), (c, a)].map(|(a, b)| list.find(a, b).unwrap_or(INVALID));
            fallible::push(&mut list.subface_edges, edges)?;
        }
        for (index, subsegment) in mesh.subsegments.iter().enumerate() {
            if let Some(edge) = list.find(subsegment.ends[0], subsegment.ends[1]) {
                let edge = &mut list.edges[edge as usize];
                edge.subsegment = index as u32;
                edge.marker = subsegment.marker;
            }
        }
        Ok(list)
    }

    /// The edge between two vertices, if there is one.
    pub fn find(&self, a: u32, b: u32) -> Option<u32> {
        let (low, high) = (a.min(b), a.max(b));
        let start = *self.starts.get(low as usize)?;
        let end = *self.starts.get(low as usize + 1)?;
        let of_low = &self.edges[start as usize..end as usize];
        of_low.binary_search_by_key(&high, |edge| edge.ends[1]).ok().map(|found| start + found as u32)
    }

    /// Fills `edges` and `starts`.
    fn collect(&mut self, mesh: &TetMesh) -> Result<(), Error> {
        let points = mesh.points.len();
        let mut ends = fallible::filled(0usize, points + 1)?;
        for tet in &mesh.tets {
            EDGE_ENDS.iter().for_each(|&[a, b]| ends[tet[a].min(tet[b]) as usize + 1] += 1);
        }
        for vertex in 0..points {
            ends[vertex + 1] += ends[vertex];
        }
        let mut next = crate::fallible::copied(&ends)?;
        let mut uses = fallible::filled((0u32, 0u32), 6 * mesh.tets.len())?;
        for (index, tet) in mesh.tets.iter().enumerate() {
            for [a, b] in EDGE_ENDS {
                let (low, high) = (tet[a].min(tet[b]), tet[a].max(tet[b]));
                uses[next[low as usize]] = (high, index as u32);
                next[low as usize] += 1;
            }
        }
        let mut count = 0;
        for vertex in 0..points {
            let of_low = &mut uses[ends[vertex]..ends[vertex + 1]];
            of_low.sort_unstable();
            count += of_low.chunk_by(|a, b| a.0 == b.0).count();
        }
        if count >= INVALID as usize {
            return Err(Error::new(Status::TooLarge, "more edges than 32-bit indices can address"));
        }
        self.edges.try_reserve_exact(count)?;
        self.starts.try_reserve_exact(points + 1)?;
        for vertex in 0..points {
            fallible::push(&mut self.starts, self.edges.len() as u32)?;
            for same in uses[ends[vertex]..ends[vertex + 1]].chunk_by(|a, b| a.0 == b.0) {
                let (high, tet) = same[0];
                let ends = [vertex as u32, high];
                fallible::push(&mut self.edges, Edge { ends, tet, subsegment: INVALID, marker: 0 })?;
            }
        }
        fallible::push(&mut self.starts, self.edges.len() as u32)?;
        Ok(())
    }
}
