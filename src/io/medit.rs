//! MEDIT's `.mesh`, in text. Source: Pascal Frey, MEDIT: an interactive mesh visualization software (INRIA RT-0253), chapter 4.
//!
//! References: point and facet markers as they are; regions by their tags (see `tags`).
use super::output_files::Out;
use super::tags;
use crate::output::TetMesh;
use crate::plc::Plc;
use std::io;

/// Writes a mesh.
pub(super) fn write(out: &mut Out, mesh: &TetMesh, plc: &Plc) -> io::Result<()> {
    out.format(format_args!("MeshVersionFormatted 2\n\nDimension 3\n\nVertices\n{}\n", mesh.points.len()))?;
    for (i, point) in mesh.points.iter().enumerate() {
        out.point(point)?;
        out.blank_int(plc.point_markers.get(i).copied().unwrap_or(0))?;
        out.put("\n")?;
    }
    let pieces = tags::segment_pieces(mesh);
    if !pieces.is_empty() {
        out.format(format_args!("\nEdges\n{}\n", pieces.len()))?;
        for piece in pieces {
            let piece = &mesh.subsegments[piece as usize];
            element(out, &piece.ends, piece.marker)?;
        }
    }
    out.format(format_args!("\nTriangles\n{}\n", mesh.subfaces.len()))?;
    for face in &mesh.subfaces {
        element(out, &face.corners, face.marker)?;
    }
    let region_tags = tags::region_tags(mesh);
    out.format(format_args!("\nTetrahedra\n{}\n", mesh.tets.len()))?;
    for (i, tet) in mesh.tets.iter().enumerate() {
        element(out, tet, region_tags[tags::region_of(mesh, i)])?;
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
