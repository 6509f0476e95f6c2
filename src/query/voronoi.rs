//! The Voronoi diagram of points, or the power diagram of weighted ones: the dual of their Delaunay tetrahedralization.
//!
//! A vertex per tetrahedron, an edge per face, a facet per edge, a cell per point, each with the index of what it is dual to
//! ([`Faces`], [`Edges`]). It is the dual of the tetrahedralization as it is: five and more cospherical points have several vertices at the
//! same place, with edges and facets of no extent between them, however the ties were broken.
//!
//! A vertex is the centre of the sphere through the corners (with weights: the point of equal power distances), each coordinate correctly
//! rounded. Equal centres so have equal doubles.
//!
//! Source of the power diagram: Aurenhammer 1987.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::output::Guarantee;
use crate::plc::lift::lifts;
use crate::predicates::{range_scale, scale, Points};
use crate::query::{Edges, Face, Faces};
use crate::{TetMesh, INVALID};

/// An edge of a Voronoi diagram, dual to a face of the mesh.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct VoronoiEdge {
    /// Its ends; the second is [`INVALID`] for a ray.
    pub vertices: [u32; 2],
    /// The direction of a ray, of length 1: the outward normal of the face of the hull. Zero for an edge with two ends.
    pub direction: [f64; 3],
}

/// A facet of a Voronoi diagram, dual to an edge of the mesh: a convex polygon between two cells, in the plane of points that have equal
/// (power) distances from both.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct VoronoiFacet {
    /// Its cells: the points whose edge it is dual to, the smaller first.
    pub cells: [u32; 2],
    /// Where its edges begin in [`Voronoi::facet_edges`]. They follow each other counterclockwise, seen from the second point; if it is
    /// unbounded, from one ray to the other.
    pub first: usize,
    /// The number of its edges.
    pub count: u32,
    /// Whether it is bounded.
    pub bounded: bool,
}

/// The cell of a point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct VoronoiCell {
    /// Where its facets begin in [`Voronoi::cell_facets`], ascending.
    pub first: usize,
    /// The number of its facets; 0 if there is no cell: the point is hidden by others, or equal to an earlier one.
    pub count: u32,
    /// Whether there is a cell, and it is bounded.
    pub bounded: bool,
}

/// The Voronoi diagram of the points of a mesh, or their power diagram.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Voronoi {
    /// The vertices, one per tetrahedron. Infinite where the centre of a nearly flat tetrahedron is beyond the range of doubles.
    pub vertices: Vec<[f64; 3]>,
    /// The edges, one per face of the mesh, in the order of [`Faces`].
    pub edges: Vec<VoronoiEdge>,
    /// The facets, one per edge of the mesh, in the order of [`Edges`].
    pub facets: Vec<VoronoiFacet>,
    /// The edges of all facets, one facet after the other.
    pub facet_edges: Vec<u32>,
    /// The cells, one per point of the mesh.
    pub cells: Vec<VoronoiCell>,
    /// The facets of all cells, one cell after the other.
    pub cell_facets: Vec<u32>,
}

/// For corners i and j of a tetrahedron the two others, in the order that makes an even permutation: about the axis from i to j the first
/// is followed counterclockwise by the second.
const OTHERS: [[[usize; 2]; 4]; 4] = [
    [[0, 0], [2, 3], [3, 1], [1, 2]],
    [[3, 2], [0, 0], [0, 3], [2, 0]],
    [[1, 3], [3, 0], [0, 0], [0, 1]],
    [[2, 1], [0, 2], [1, 0], [0, 0]],
];

impl Voronoi {
    /// The diagram of a mesh made in mode Delaunay, with weights or without.
    ///
    /// # Errors
    /// [`Status::Unsupported`] for other meshes, and for weighted ones without their weights, as read from files;
    /// [`Status::CoordinateRange`], [`Status::TooLarge`], [`Status::OutOfMemory`].
    pub fn new(mesh: &TetMesh) -> Result<Voronoi, Error> {
        Voronoi::new_with(mesh, &Control::free())
    }

    /// The same within a run whose limits count.
    ///
    /// # Errors
    /// As [`Voronoi::new`], and those of the limits.
    pub fn new_with(mesh: &TetMesh, control: &Control) -> Result<Voronoi, Error> {
        check(mesh)?;
        let exponent = range_scale(&mesh.points)
            .map_err(|i| Error::new(Status::CoordinateRange, format_args!("point {i} is out of range")))?;
        control.room(BYTES_PER_TET * mesh.tets.len())?;
        let mut points =
            Points::new(fallible::collect(mesh.points.iter().map(|p| p.map(|x| scale(x, exponent))))?);
        if !mesh.lift.is_plain() {
            points.lift(lifts(&mesh.lift, 0..mesh.points.len() as u32, exponent, &mesh.points)?);
        }
        control.look()?;
        let mut diagram = Voronoi::default();
        diagram.vertices.try_reserve_exact(mesh.tets.len())?;
        for &tet in &mesh.tets {
            control.step()?;
            fallible::push(&mut diagram.vertices, points.power_center(tet, -exponent))?;
        }
        let faces = Faces::new(mesh)?;
        control.look()?;
        diagram.edges.try_reserve_exact(faces.faces.len())?;
        for face in &faces.faces {
            control.step()?;
            fallible::push(&mut diagram.edges, edge(face, &points))?;
        }
        let edges = Edges::alone(mesh)?;
        control.look()?;
        diagram.add_facets(mesh, &faces, &edges, control)?;
        diagram.add_cells(mesh.points.len())?;
        Ok(diagram)
    }

    fn add_facets(
        &mut self,
        mesh: &TetMesh,
        faces: &Faces,
        edges: &Edges,
        control: &Control,
    ) -> Result<(), Error> {
        self.facets.try_reserve_exact(edges.edges.len())?;
        self.facet_edges.try_reserve_exact(3 * faces.faces.len())?;
        for edge in &edges.edges {
            control.step()?;
            let around = Around { mesh, faces, ends: edge.ends };
            let first = self.facet_edges.len();
            let bounded = around.turn(edge.tet, &mut self.facet_edges)?;
            if !bounded {
                let start = around.back(edge.tet)?;
                self.facet_edges.truncate(first);
                fallible::push(
                    &mut self.facet_edges,
                    faces.tet_faces[start as usize][around.others(start)?[1]],
                )?;
                around.turn(start, &mut self.facet_edges)?;
            }
            let count = (self.facet_edges.len() - first) as u32;
            fallible::push(&mut self.facets, VoronoiFacet { cells: edge.ends, first, count, bounded })?;
        }
        Ok(())
    }

    fn add_cells(&mut self, points: usize) -> Result<(), Error> {
        let none = VoronoiCell { first: 0, count: 0, bounded: false };
        fallible::resize(&mut self.cells, points, none)?;
        for facet in &self.facets {
            for &cell in &facet.cells {
                let cell = &mut self.cells[cell as usize];
                cell.bounded = facet.bounded && (cell.bounded || cell.count == 0);
                cell.count += 1;
            }
        }
        let mut first = 0;
        for cell in &mut self.cells {
            cell.first = first;
            first += cell.count as usize;
        }
        fallible::resize(&mut self.cell_facets, first, INVALID)?;
        let mut next = fallible::collect(self.cells.iter().map(|cell| cell.first))?;
        for (facet, index) in self.facets.iter().zip(0..) {
            for &cell in &facet.cells {
                let place = &mut next[cell as usize];
                self.cell_facets[*place] = index;
                *place += 1;
            }
        }
        Ok(())
    }

    /// The edges of a facet, in order.
    pub fn edges_of(&self, facet: &VoronoiFacet) -> &[u32] {
        self.facet_edges.get(facet.first..facet.first + facet.count as usize).unwrap_or_default()
    }

    /// The facets of a cell, ascending.
    pub fn facets_of(&self, cell: &VoronoiCell) -> &[u32] {
        self.cell_facets.get(cell.first..cell.first + cell.count as usize).unwrap_or_default()
    }
}

/// What the diagram, the faces and the edges take: a vertex, two edges, about 1.2 facets, six entries of facets and two of cells.
const BYTES_PER_TET: usize = 24 + 2 * (32 + size_of::<Face>()) + 16 + 2 * 24 + 24 + 24 + 10 + 12 + 24 + 48;

/// Refuses meshes that are not the Delaunay tetrahedralization of their points.
fn check(mesh: &TetMesh) -> Result<(), Error> {
    let unsupported = |what: &'static str| Err(Error::new(Status::Unsupported, what));
    match mesh.guarantee {
        Guarantee::Delaunay => Ok(()),
        Guarantee::WeightedDelaunay if mesh.lift.values().len() == mesh.points.len() => Ok(()),
        Guarantee::WeightedDelaunay => {
            unsupported("Voronoi diagram: the mesh is weighted, but the weights of its points are not known")
        }
        _ => unsupported("Voronoi diagram: only a mesh made in mode delaunay has one"),
    }
}

fn edge(face: &Face, points: &Points) -> VoronoiEdge {
    let direction = match face.tets[1] {
        INVALID => points.unit_normal(face.corners),
        _ => [0.0; 3],
    };
    VoronoiEdge { vertices: face.tets, direction }
}

/// The tetrahedra around an edge of the mesh, in a ring or from one face of the hull to another.
struct Around<'a> {
    mesh: &'a TetMesh,
    faces: &'a Faces,
    ends: [u32; 2],
}

impl Around<'_> {
    /// Appends the faces through which a counterclockwise turn from `start` leaves tetrahedra; whether it comes back.
    fn turn(&self, start: u32, list: &mut Vec<u32>) -> Result<bool, Error> {
        let mut tet = start;
        for _ in 0..self.mesh.tets.len() {
            let [ahead, _] = self.others(tet)?;
            fallible::push(list, self.faces.tet_faces[tet as usize][ahead])?;
            tet = self.mesh.neighbors[tet as usize][ahead];
            if tet == INVALID || tet == start {
                return Ok(tet == start);
            }
        }
        Err(Error::internal("the tetrahedra around an edge make no ring"))
    }

    /// The last tetrahedron of a clockwise turn to the hull.
    fn back(&self, from: u32) -> Result<u32, Error> {
        let mut tet = from;
        for _ in 0..self.mesh.tets.len() {
            let [_, behind] = self.others(tet)?;
            match self.mesh.neighbors[tet as usize][behind] {
                INVALID => return Ok(tet),
                before => tet = before,
            }
        }
        Err(Error::internal("the tetrahedra around an edge do not end at the hull"))
    }

    /// The slots opposite the faces through which a counterclockwise turn leaves a tetrahedron and enters it.
    #[inline(always)]
    fn others(&self, tet: u32) -> Result<[usize; 2], Error> {
        let corners = self.mesh.tets.get(tet as usize).copied().unwrap_or([INVALID; 4]);
        // Branch-free: which corners they are cannot be predicted.
        let slot = |end: u32| (1..4).map(|i| i * usize::from(corners[i] == end)).sum::<usize>();
        let [a, b] = self.ends;
        let (i, j) = (slot(a), slot(b));
        match corners.get(i) == Some(&a) && corners.get(j) == Some(&b) {
            true => Ok(OTHERS[i][j]),
            false => Err(Error::internal("a tetrahedron lacks the edge that it is said to have")),
        }
    }
}
