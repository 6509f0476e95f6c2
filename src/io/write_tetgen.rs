//! TetGen's output: `.node`, `.ele`, `.face`, `.edge`, `.neigh`, numbered from 0. Source: Hang Si, TetGen User's Manual,
//! section 5 "File Formats".
use super::output_files::{Out, OutputFiles};
use super::parents;
use crate::error::Error;
use crate::output::TetMesh;
use crate::plc::attributes::continue_attributes;
use crate::plc::Plc;
use crate::INVALID;
use std::io;
use std::path::Path;

/// Writes the files of a mesh: `stem` with each suffix, and our own `.parents`.
pub(super) fn write(files: &mut OutputFiles, stem: &Path, mesh: &TetMesh, plc: &Plc) -> Result<(), Error> {
    let added = continue_attributes(plc, mesh)?;
    files.write(&stem.with_extension("node"), |out| nodes(out, mesh, plc, &added))?;
    files.write(&stem.with_extension("ele"), |out| tets(out, mesh, plc))?;
    files.write(&stem.with_extension("face"), |out| faces(out, mesh))?;
    files.write(&stem.with_extension("edge"), |out| edges(out, mesh))?;
    files.write(&stem.with_extension("neigh"), |out| neighbors(out, mesh))?;
    files.write(&stem.with_extension("parents"), |out| parents::write(out, mesh))
}

fn nodes(out: &mut Out, mesh: &TetMesh, plc: &Plc, added: &[f64]) -> io::Result<()> {
    let attributes = plc.point_attribute_count;
    let marked = !plc.point_markers.is_empty();
    out.int(mesh.points.len())?;
    out.format(format_args!("  3  {attributes}  {}\n", u8::from(marked)))?;
    for (i, point) in mesh.points.iter().enumerate() {
        out.int(i)?;
        out.put(b" ")?;
        out.point(point)?;
        for k in 0..attributes {
            out.blank_float(attribute(plc, added, i, k))?;
        }
        if marked {
            out.blank_int(plc.point_markers.get(i).copied().unwrap_or(0))?;
        }
        out.put(b"\n")?;
    }
    Ok(())
}

/// Attribute `k` of a point; `added` are those of the points after the input's.
pub(super) fn attribute(plc: &Plc, added: &[f64], point: usize, k: usize) -> f64 {
    let width = plc.point_attribute_count;
    let found = match point.checked_sub(plc.points.len()) {
        None => plc.point_attributes.get(point * width + k),
        Some(steiner) => added.get(steiner * width + k),
    };
    found.copied().unwrap_or(0.0)
}

fn tets(out: &mut Out, mesh: &TetMesh, plc: &Plc) -> io::Result<()> {
    let attributed = !plc.regions.is_empty() || mesh.regions.len() > 1;
    out.int(mesh.tets.len())?;
    out.format(format_args!("  4  {}\n", u8::from(attributed)))?;
    for (i, tet) in mesh.tets.iter().enumerate() {
        row(out, i, tet)?;
        if attributed {
            let region = mesh.tet_region.get(i).and_then(|&r| mesh.regions.get(r as usize));
            out.blank_float(region.map_or(0.0, |r| r.attribute))?;
        }
        out.put(b"\n")?;
    }
    Ok(())
}

fn row(out: &mut Out, number: usize, values: &[u32]) -> io::Result<()> {
    out.int(number)?;
    values.iter().try_for_each(|&v| out.blank_int(v))
}

fn faces(out: &mut Out, mesh: &TetMesh) -> io::Result<()> {
    out.int(mesh.subfaces.len())?;
    out.put("  1\n")?;
    for (i, face) in mesh.subfaces.iter().enumerate() {
        row(out, i, &face.corners)?;
        out.blank_int(face.marker)?;
        out.put(b"\n")?;
    }
    Ok(())
}

fn edges(out: &mut Out, mesh: &TetMesh) -> io::Result<()> {
    out.int(mesh.subsegments.len())?;
    out.put("  1\n")?;
    for (i, edge) in mesh.subsegments.iter().enumerate() {
        row(out, i, &edge.ends)?;
        out.blank_int(edge.marker)?;
        out.put(b"\n")?;
    }
    Ok(())
}

fn neighbors(out: &mut Out, mesh: &TetMesh) -> io::Result<()> {
    out.int(mesh.neighbors.len())?;
    out.put("  4\n")?;
    for (i, around) in mesh.neighbors.iter().enumerate() {
        out.int(i)?;
        for &tet in around {
            out.blank_int(if tet == INVALID { -1 } else { i64::from(tet) })?;
        }
        out.put(b"\n")?;
    }
    Ok(())
}
