//! Legacy VTK, binary (big endian). Source: VTK User's Guide, "VTK File Formats", simple legacy formats.
//!
//! Cells carry `region` (the attribute) and `min_dihedral` (degrees), points the input's attributes and markers. Scalars do not state a
//! number of components, since some readers turn scalars that do into columns.
use crate::io::model::Model;
use crate::io::output_files::Out;
use crate::io::quality::{corners, dihedrals};
use crate::io::tags::attribute_of;
use crate::query::NodeOrder;
use std::io;

/// VTK's numbers of a tetrahedral cell, linear and quadratic.
const VTK_TETRA: u32 = 10;
const VTK_QUADRATIC_TETRA: u32 = 24;

/// Writes a mesh.
pub(super) fn write(out: &mut Out, model: &Model<'_>) -> io::Result<()> {
    let mesh = model.mesh;
    let (count, points) = (mesh.tets.len(), model.node_count());
    let (width, kind) =
        if model.options.second_order { (10u32, VTK_QUADRATIC_TETRA) } else { (4, VTK_TETRA) };
    out.put("# vtk DataFile Version 3.0\ndelotet\nBINARY\nDATASET UNSTRUCTURED_GRID\n")?;
    out.format(format_args!("POINTS {points} double\n"))?;
    for node in 0..points {
        model.node(node).iter().try_for_each(|x| out.put(x.to_be_bytes()))?;
    }
    out.format(format_args!("\nCELLS {count} {}\n", u64::from(width + 1) * count as u64))?;
    for tet in 0..count {
        out.put(width.to_be_bytes())?;
        model.tet(tet, NodeOrder::Vtk).iter().try_for_each(|v| out.put(v.to_be_bytes()))?;
    }
    out.format(format_args!("\nCELL_TYPES {count}\n"))?;
    for _ in 0..count {
        out.put(kind.to_be_bytes())?;
    }
    if model.attribute_count() > 0 || model.is_marked() {
        out.format(format_args!("\nPOINT_DATA {points}"))?;
    }
    for k in 0..model.attribute_count() {
        out.format(format_args!("\nSCALARS attribute_{k} double\nLOOKUP_TABLE default\n"))?;
        (0..points).try_for_each(|node| out.put(model.attribute(node, k).to_be_bytes()))?;
    }
    if model.is_marked() {
        out.put("\nSCALARS marker int\nLOOKUP_TABLE default\n")?;
        (0..points).try_for_each(|node| out.put(model.marker(node).to_be_bytes()))?;
    }
    out.format(format_args!("\nCELL_DATA {count}\nSCALARS region double\nLOOKUP_TABLE default\n"))?;
    for tet in 0..count {
        out.put(attribute_of(mesh, tet).to_be_bytes())?;
    }
    out.put("\nSCALARS min_dihedral float\nLOOKUP_TABLE default\n")?;
    for tet in &mesh.tets {
        out.put((dihedrals(corners(mesh, tet))[0] as f32).to_be_bytes())?;
    }
    out.put("\n")
}
