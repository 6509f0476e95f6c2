//! Ten-node tetrahedra: a node at the midpoint of every edge. The node of edge `i` has the index `points.len() + i`.
use crate::error::{Error, Status};
use crate::fallible;
use crate::query::edges::Edges;
use crate::{TetMesh, INVALID};

/// The order in which the six mid-edge nodes follow the four corners.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum NodeOrder {
    /// VTK, Abaqus and CalculiX (C3D10), Nastran: 01 12 02 03 13 23.
    Vtk,
    /// Gmsh: 01 12 02 03 23 13.
    Gmsh,
    /// TetGen (`-o2`): 23 03 01 12 13 02.
    Tetgen,
}

impl NodeOrder {
    /// The edge, among 01 02 03 12 13 23, of each mid-edge node.
    pub(crate) fn edges(self) -> [usize; 6] {
        match self {
            NodeOrder::Vtk => [0, 3, 1, 2, 4, 5],
            NodeOrder::Gmsh => [0, 3, 1, 2, 5, 4],
            NodeOrder::Tetgen => [5, 2, 0, 3, 4, 1],
        }
    }
}

/// The mid-edge nodes, in the order of `edges`.
pub fn nodes(mesh: &TetMesh, edges: &Edges) -> Result<Vec<[f64; 3]>, Error> {
    let nodes = fallible::collect(edges.edges.iter().map(|edge| {
        let [a, b] = edge.ends.map(|end| mesh.points[end as usize]);
        [0, 1, 2].map(|axis| 0.5 * a[axis] + 0.5 * b[axis])
    }))?;
    Ok(nodes)
}

/// Ten nodes per tetrahedron: its corners, then its mid-edge nodes in the given order.
pub fn tets(mesh: &TetMesh, edges: &Edges, order: NodeOrder) -> Result<Vec<[u32; 10]>, Error> {
    if mesh.points.len() + edges.edges.len() >= INVALID as usize {
        return Err(Error::new(Status::TooLarge, "more second-order nodes than 32-bit indices can address"));
    }
    let first = mesh.points.len() as u32;
    let slots = order.edges();
    let mut tets = fallible::reserved(mesh.tets.len())?;
    for (corners, of_tet) in mesh.tets.iter().zip(&edges.tet_edges) {
        let mut nodes = [0; 10];
        nodes[..4].copy_from_slice(corners);
        slots.iter().zip(&mut nodes[4..]).for_each(|(&slot, node)| *node = first + of_tet[slot]);
        fallible::push(&mut tets, nodes)?;
    }
    Ok(tets)
}
