//! Legacy VTK, binary (big endian). Source: VTK User's Guide, "VTK File Formats", simple legacy formats.
use super::output_files::Out;
use super::quality::{corners, dihedrals};
use super::tags::attribute_of;
use crate::output::TetMesh;
use std::io;

/// VTK's number of a tetrahedral cell.
const VTK_TETRA: u32 = 10;

/// Writes a mesh: cells with `region` (the attribute) and `min_dihedral` (degrees).
pub(super) fn write(out: &mut Out, mesh: &TetMesh) -> io::Result<()> {
    let count = mesh.tets.len();
    out.put("# vtk DataFile Version 3.0\ndelotet\nBINARY\nDATASET UNSTRUCTURED_GRID\n")?;
    out.format(format_args!("POINTS {} double\n", mesh.points.len()))?;
    for x in mesh.points.iter().flatten() {
        out.put(x.to_be_bytes())?;
    }
    out.format(format_args!("\nCELLS {count} {}\n", 5 * count as u64))?;
    for tet in &mesh.tets {
        out.put(4u32.to_be_bytes())?;
        tet.iter().try_for_each(|v| out.put(v.to_be_bytes()))?;
    }
    out.format(format_args!("\nCELL_TYPES {count}\n"))?;
    for _ in 0..count {
        out.put(VTK_TETRA.to_be_bytes())?;
    }
    out.format(format_args!("\nCELL_DATA {count}\nSCALARS region double 1\nLOOKUP_TABLE default\n"))?;
    for tet in 0..count {
        out.put(attribute_of(mesh, tet).to_be_bytes())?;
    }
    out.put("\nSCALARS min_dihedral float 1\nLOOKUP_TABLE default\n")?;
    for tet in &mesh.tets {
        out.put((dihedrals(corners(mesh, tet))[0] as f32).to_be_bytes())?;
    }
    out.put("\n")
}
