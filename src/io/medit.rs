//! MEDIT's `.mesh`, in text. Source: Pascal Frey, MEDIT: an interactive mesh visualization software (INRIA RT-0253), chapter 4.
//!
//! References: point and facet markers as they are; regions by their tags (see `tags`).
use crate::io::model::Model;
use crate::io::output_files::Out;
use crate::io::tags;
use crate::query::NodeOrder;
use std::io;

/// Integers that stand for what the mesh has.
pub(super) struct References {
    /// Subsegments on segments.
    pub pieces: Vec<u32>,
    /// The tag of each region.
    pub regions: Vec<i32>,
}

/// Writes a mesh.
pub(super) fn write(out: &mut Out, model: &Model<'_>, references: &References) -> io::Result<()> {
    let mesh = model.mesh;
    out.format(format_args!("MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n{}\n", mesh.points.len()))?;
    for (i, point) in mesh.points.iter().enumerate() {
        out.point(point)?;
        out.blank_int(model.marker(i))?;
        out.put("\n")?;
    }
    if !references.pieces.is_empty() {
        out.format(format_args!("\nEdges\n{}\n", references.pieces.len()))?;
        for &piece in &references.pieces {
            let piece = &mesh.subsegments[piece as usize];
            element(out, &piece.ends, piece.marker)?;
        }
    }
    out.format(format_args!("\nTriangles\n{}\n", mesh.subfaces.len()))?;
    for face in &mesh.subfaces {
        element(out, &face.corners, face.marker)?;
    }
    out.format(format_args!("\nTetrahedra\n{}\n", mesh.tets.len()))?;
    for i in 0..mesh.tets.len() {
        let reference = references.regions.get(tags::region_of(mesh, i)).copied().unwrap_or(1);
        element(out, &model.tet(i, NodeOrder::Vtk), reference)?;
    }
    out.put("\nEnd\n")
}

/// Corners from 1, and the reference.
fn element(out: &mut Out, corners: &[u32], reference: i32) -> io::Result<()> {
    for &corner in corners {
        out.int(u64::from(corner) + 1)?;
        out.put(" ")?;
    }
    out.int(reference)?;
    out.put("\n")
}
