//! TetGen's output: `.node`, `.ele`, `.face`, `.edge`, `.neigh`, numbered from 0. Source: Hang Si, TetGen User's Manual,
//! section 5 "File Formats". In second order (`-o2`) nodes in the middle of edges come last in `.node`; tetrahedra have ten,
//! faces six, edges three nodes.
use crate::error::Error;
use crate::io::model::Model;
use crate::io::output_files::{with_extension, Out, OutputFiles};
use crate::io::parents;
use crate::io::tags::attribute_of;
use crate::output::Guarantee;
use crate::query::NodeOrder;
use crate::INVALID;
use std::io;
use std::path::Path;

/// Writes the files of a mesh: `stem` with each suffix, and our own `.parents`.
pub(super) fn write(files: &mut OutputFiles, stem: &Path, model: &Model<'_>) -> Result<(), Error> {
    files.write(&with_extension(stem, "node")?, |out| nodes(out, model))?;
    files.write(&with_extension(stem, "ele")?, |out| tets(out, model))?;
    files.write(&with_extension(stem, "face")?, |out| faces(out, model))?;
    files.write(&with_extension(stem, "edge")?, |out| edges(out, model))?;
    files.write(&with_extension(stem, "neigh")?, |out| neighbors(out, model))?;
    files.write(&with_extension(stem, "parents")?, |out| parents::write(out, model.mesh))
}

fn nodes(out: &mut Out, model: &Model<'_>) -> io::Result<()> {
    let attributes = model.attribute_count();
    let marked = model.is_marked();
    out.int(model.node_count())?;
    out.format(format_args!("  3  {attributes}  {}\n", u8::from(marked)))?;
    for i in 0..model.node_count() {
        out.int(i)?;
        out.put(b" ")?;
        out.point(&model.node(i))?;
        for k in 0..attributes {
            out.blank_float(model.attribute(i, k))?;
        }
        if marked {
            out.blank_int(model.marker(i))?;
        }
        out.put(b"\n")?;
    }
    Ok(())
}

fn tets(out: &mut Out, model: &Model<'_>) -> io::Result<()> {
    let mesh = model.mesh;
    let attributed = !model.plc.regions.is_empty()
        || mesh.regions.len() > 1
        || mesh.guarantee == Guarantee::Given && mesh.regions.iter().any(|region| region.attribute != 1.0);
    out.int(mesh.tets.len())?;
    let corners = if model.options.second_order { 10 } else { 4 };
    out.format(format_args!("  {corners}  {}\n", u8::from(attributed)))?;
    for i in 0..mesh.tets.len() {
        row(out, i, &model.tet(i, NodeOrder::Tetgen))?;
        if attributed {
            out.blank_float(attribute_of(mesh, i))?;
        }
        out.put(b"\n")?;
    }
    Ok(())
}

fn row(out: &mut Out, number: usize, values: &[u32]) -> io::Result<()> {
    out.int(number)?;
    values.iter().try_for_each(|&v| out.blank_int(v))
}

fn faces(out: &mut Out, model: &Model<'_>) -> io::Result<()> {
    out.int(model.mesh.subfaces.len())?;
    out.put("  1\n")?;
    for (i, face) in model.mesh.subfaces.iter().enumerate() {
        row(out, i, &model.face(i))?;
        out.blank_int(face.marker)?;
        out.put(b"\n")?;
    }
    Ok(())
}

fn edges(out: &mut Out, model: &Model<'_>) -> io::Result<()> {
    out.int(model.mesh.subsegments.len())?;
    out.put("  1\n")?;
    for (i, edge) in model.mesh.subsegments.iter().enumerate() {
        row(out, i, &model.piece(i))?;
        out.blank_int(edge.marker)?;
        out.put(b"\n")?;
    }
    Ok(())
}

fn neighbors(out: &mut Out, model: &Model<'_>) -> io::Result<()> {
    out.int(model.mesh.neighbors.len())?;
    out.put("  4\n")?;
    for (i, around) in model.mesh.neighbors.iter().enumerate() {
        out.int(i)?;
        for &tet in around {
            out.blank_int(if tet == INVALID { -1 } else { i64::from(tet) })?;
        }
        out.put(b"\n")?;
    }
    Ok(())
}
