//! What the writers of all mesh formats share: nodes of either order with their data, and what a format may lose.
use crate::error::{Element, Error, Status};
use crate::io::WriteOptions;
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::query::{Edges, NodeOrder, PointData};
use crate::warning::{Warning, WarningKind, Warnings};
use crate::INVALID;

/// A mesh as it is written. Its nodes are the points of the mesh, then, in second order, the middles of all edges in the order of
/// [`Edges`].
pub(super) struct Model<'a> {
    /// The mesh.
    pub mesh: &'a TetMesh,
    /// The PLC that it was made from.
    pub plc: &'a Plc,
    /// The options of the writer.
    pub options: &'a WriteOptions,
    data: PointData,
    edges: Option<Edges>,
}

/// The nodes of an element: its corners, then the middles of its edges.
#[derive(Clone, Copy)]
pub(super) struct Nodes {
    list: [u32; 10],
    count: usize,
}

impl Nodes {
    fn new(corners: &[u32]) -> Self {
        let mut list = [0; 10];
        list.iter_mut().zip(corners).for_each(|(node, corner)| *node = *corner);
        Nodes { list, count: corners.len().min(10) }
    }

    /// The same nodes under other numbers.
    pub fn map(mut self, number: impl Fn(u32) -> u32) -> Self {
        let count = self.count;
        self.list.iter_mut().take(count).for_each(|node| *node = number(*node));
        self
    }

    fn push(&mut self, node: u32) {
        if let Some(free) = self.list.get_mut(self.count) {
            *free = node;
            self.count += 1;
        }
    }
}

impl std::ops::Deref for Nodes {
    type Target = [u32];
    fn deref(&self) -> &[u32] {
        self.list.get(..self.count).unwrap_or_default()
    }
}

impl<'a> Model<'a> {
    /// Continues the points' data to Steiner points, and numbers the edges if they are to have nodes.
    pub fn new(mesh: &'a TetMesh, plc: &'a Plc, options: &'a WriteOptions) -> Result<Self, Error> {
        let data = PointData::new(plc, mesh)?;
        let mut model = Model { mesh, plc, options, data, edges: None };
        if !options.second_order {
            return Ok(model);
        }
        let points = mesh.points.len();
        if mesh.tets.iter().flatten().any(|&v| v as usize >= points) {
            return Err(Error::new(
                Status::IndexOutOfRange,
                "a tetrahedron has a corner that is no point of the mesh",
            ));
        }
        let edges = Edges::new(mesh)?;
        if points + edges.edges.len() >= INVALID as usize {
            return Err(Error::new(
                Status::TooLarge,
                "more second-order nodes than 32-bit indices can address",
            ));
        }
        let bare = edges.subface_edges.iter().flatten().any(|&edge| edge == INVALID)
            || mesh.subsegments.iter().any(|s| edges.find(s.ends[0], s.ends[1]).is_none());
        if bare {
            let message = "a subface or subsegment of the mesh is no face or edge of its tetrahedra";
            return Err(Error::new(Status::InvalidArgument, message));
        }
        model.edges = Some(edges);
        Ok(model)
    }

    /// How many nodes there are.
    pub fn node_count(&self) -> usize {
        self.mesh.points.len() + self.edges.as_ref().map_or(0, |e| e.edges.len())
    }

    /// The points of the mesh that a node is the middle of: twice the same for a point.
    fn ends(&self, node: usize) -> [usize; 2] {
        let edge = node.checked_sub(self.mesh.points.len());
        match edge.and_then(|i| self.edges.as_ref()?.edges.get(i)) {
            Some(edge) => edge.ends.map(|v| v as usize),
            None => [node; 2],
        }
    }

    /// Where a node is.
    pub fn node(&self, node: usize) -> [f64; 3] {
        let point = |i: usize| self.mesh.points.get(i).copied().unwrap_or_default();
        match self.ends(node) {
            [a, b] if a == b => point(a),
            ends => {
                let [a, b] = ends.map(point);
                std::array::from_fn(|axis| 0.5 * a[axis] + 0.5 * b[axis])
            }
        }
    }

    /// How many attributes nodes have.
    pub fn attribute_count(&self) -> usize {
        self.data.attribute_count
    }

    /// Attribute `k` of a node: in the middle of an edge the mean of its ends'.
    pub fn attribute(&self, node: usize, k: usize) -> f64 {
        let of_point =
            |i: usize| self.data.attributes.get(i * self.data.attribute_count + k).copied().unwrap_or(0.0);
        match self.ends(node) {
            [a, b] if a == b => of_point(a),
            [a, b] => 0.5 * of_point(a) + 0.5 * of_point(b),
        }
    }

    /// Whether nodes have markers.
    pub fn is_marked(&self) -> bool {
        !self.data.markers.is_empty()
    }

    /// The marker of a node: in the middle of an edge that of the segment that it is a part of, if it is one.
    pub fn marker(&self, node: usize) -> i32 {
        let edge = node.checked_sub(self.mesh.points.len());
        match edge.and_then(|i| self.edges.as_ref()?.edges.get(i)) {
            Some(edge) => edge.marker,
            None => self.data.markers.get(node).copied().unwrap_or(0),
        }
    }

    /// The nodes of a tetrahedron.
    pub fn tet(&self, tet: usize, order: NodeOrder) -> Nodes {
        let mut nodes = Nodes::new(self.mesh.tets.get(tet).map_or(&[][..], |t| &t[..]));
        if let Some(edges) = self.edges.as_ref().and_then(|e| e.tet_edges.get(tet)) {
            order.edges().iter().for_each(|&i| nodes.push(self.middle(edges[i])));
        }
        nodes
    }

    /// The nodes of a subface `(a, b, c)`; the middles are those of ab, bc and ca.
    pub fn face(&self, face: usize) -> Nodes {
        let mut nodes = Nodes::new(self.mesh.subfaces.get(face).map_or(&[][..], |f| &f.corners[..]));
        if let Some(edges) = self.edges.as_ref().and_then(|e| e.subface_edges.get(face)) {
            edges.iter().for_each(|&edge| nodes.push(self.middle(edge)));
        }
        nodes
    }

    /// The nodes of a subsegment.
    pub fn piece(&self, piece: usize) -> Nodes {
        let ends = self.mesh.subsegments.get(piece).map_or(&[][..], |s| &s.ends[..]);
        let mut nodes = Nodes::new(ends);
        if let (Some(edges), [a, b]) = (&self.edges, ends) {
            nodes.push(edges.find(*a, *b).map_or(*a, |edge| self.middle(edge)));
        }
        nodes
    }

    fn middle(&self, edge: u32) -> u32 {
        self.mesh.points.len() as u32 + edge
    }

    /// Warns that points have attributes, for a format that has no place for them.
    pub fn lose_attributes(&self, warnings: &mut Warnings) {
        let width = self.plc.point_attribute_count.max(1);
        if let Some(i) = self.plc.point_attributes.iter().position(|&x| x != 0.0) {
            lose(warnings, self.options, Element::Point((i / width) as u32));
        }
    }

    /// Warns that points have markers, for a format that has no place for them.
    pub fn lose_markers(&self, warnings: &mut Warnings) {
        if let Some(i) = self.plc.point_markers.iter().position(|&m| m != 0) {
            lose(warnings, self.options, Element::Point(i as u32));
        }
    }
}

/// Warns of a value of an element that the format cannot hold as it is.
pub(super) fn lose(warnings: &mut Warnings, options: &WriteOptions, first: Element) {
    let warning = Warning { kind: WarningKind::LostValue, first, second: None, point: None };
    warnings.push(warning, options.max_warnings);
}
