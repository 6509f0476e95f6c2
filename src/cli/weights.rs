//! `--weights` and `--voronoi`.
use super::args::WeightsArg;
use super::Failure;
use delotet::query::Voronoi;
use delotet::{Control, Error, Lift, Plc, Status, TetMesh};
use std::path::Path;

/// Makes the first attribute of each point its weight or its height.
pub fn add_to(plc: &mut Plc, kind: Option<WeightsArg>) -> Result<(), Failure> {
    let Some(kind) = kind else { return Ok(()) };
    let width = plc.point_attribute_count;
    if width == 0 {
        let message = "--weights: the points of the input have no attributes";
        return Err(Error::new(Status::InvalidArgument, message).into());
    }
    let first = plc.point_attributes.chunks(width).map(|row| row[0]).collect();
    plc.lift = match kind {
        WeightsArg::Weight => Lift::Weights(first),
        WeightsArg::Height => Lift::Heights(first),
    };
    Ok(())
}

/// Writes the bounded cells of the diagram of a mesh.
pub fn write_cells(path: &Path, mesh: &TetMesh, control: &Control) -> Result<(), Failure> {
    let diagram = Voronoi::new_with(mesh, control)?;
    delotet::io::write_voronoi(path, &diagram, control).map_err(Failure::usage)
}
