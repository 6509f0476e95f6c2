//! What solvers need from a finished mesh: its faces and edges, second-order nodes, the data of its points, the quality of its tetrahedra,
//! and the one that contains a point, with sizes there. Everything here is derived from [`TetMesh`](crate::TetMesh) and leaves it unchanged.

pub(crate) mod background;
pub mod edges;
pub mod faces;
pub mod locate;
pub mod point_data;
pub mod quality;
pub mod second_order;
pub mod voronoi;

pub(crate) use background::Background;
pub use edges::{Edge, Edges};
pub use faces::{Face, Faces};
pub use locate::Locator;
pub use point_data::PointData;
pub use quality::{ForcedTet, Measure, QualitySummary, SkinnyCause, SkinnyTet, SkinnyTets, TetQuality};
pub use second_order::NodeOrder;
pub use voronoi::{Voronoi, VoronoiCell, VoronoiEdge, VoronoiFacet};

use crate::error::Error;
use crate::fallible;
use crate::predicates::{in_range, orient3d, range_scale, scale, Sign};

/// Corners of face `i` (opposite vertex `i`) of a positive tetrahedron, so that `(b − a) × (c − a)` points outward.
pub const FACE_CORNERS: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Ends of edge `i` of a tetrahedron.
pub const EDGE_ENDS: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// Whether four points lie in a plane, by an exact sign. False if a coordinate is not finite or the exponents are too far apart for it.
pub fn are_coplanar(points: [&[f64; 3]; 4]) -> bool {
    let points = points.map(|p| *p);
    let exponent = match points.iter().flatten().all(|&x| in_range(x)) {
        true => 0,
        false => match range_scale(&points) {
            Ok(exponent) => exponent,
            Err(_) => return false,
        },
    };
    let [a, b, c, d] = points.map(|p| p.map(|x| scale(x, exponent)));
    orient3d(&a, &b, &c, &d) == Sign::Zero
}

/// For each point the first tetrahedron that has it as a corner, or [`INVALID`](crate::INVALID) if none does.
pub fn point_tets(mesh: &crate::TetMesh) -> Result<Vec<u32>, Error> {
    let mut first = fallible::filled(crate::INVALID, mesh.points.len())?;
    for (tet, corners) in mesh.tets.iter().enumerate().rev() {
        for &corner in corners {
            first[corner as usize] = tet as u32;
        }
    }
    Ok(first)
}

/// The region attribute of each tetrahedron.
pub fn tet_attributes(mesh: &crate::TetMesh) -> Result<Vec<f64>, Error> {
    let mut attributes = fallible::reserved(mesh.tets.len())?;
    let of_region = |region: &u32| mesh.regions.get(*region as usize).map_or(0.0, |region| region.attribute);
    fallible::extend(&mut attributes, mesh.tet_region.iter().map(of_region))?;
    Ok(attributes)
}

#[cfg(test)]
pub(crate) mod tests;
