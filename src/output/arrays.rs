//! A mesh as plain arrays: what a caller, a solver or a file knows of it.

/// A tetrahedral mesh that was made elsewhere. [`mesh_from_arrays`](crate::mesh_from_arrays) checks it and makes a
/// [`TetMesh`](crate::TetMesh) of it.
#[allow(clippy::disallowed_methods, reason = "for callers; the library itself never clones it")]
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshArrays {
    /// The points.
    pub points: Vec<[f64; 3]>,
    /// How many of them are input points, which keep their place in every later mesh. The others may be moved and taken out, if they are
    /// behind the last point that is on a kept face or edge; the points before that one stay. `None`: all are input points.
    pub input_point_count: Option<u32>,
    /// The tetrahedra, four corners each, in either orientation.
    pub tets: Vec<[u32; 4]>,
    /// One attribute per tetrahedron: equal ones are one material. Empty: tetrahedra that are connected are.
    pub attributes: Vec<f64>,
    /// Faces of the mesh that are to be kept. Those on its boundary and between different attributes need not be listed.
    pub faces: Vec<[u32; 3]>,
    /// One marker per face, or empty, which means 0 for all.
    pub face_markers: Vec<i32>,
    /// Edges of the mesh that are to be kept.
    pub edges: Vec<[u32; 2]>,
    /// One marker per edge, or empty, which means 0 for all.
    pub edge_markers: Vec<i32>,
}
