//! `delotet check`.
use super::args::{CheckArgs, PreserveArg};
use super::page::Page;
use super::quality::Quality;
use super::{paths, report, Failure};
use delotet::io;
use delotet::{Defect, DefectKind, Element, Error, Guarantee, Status, SteinerPoint, TetMesh, Warnings};
use std::path::Path;

/// Reads a mesh and its input and checks the mesh against the input.
pub fn run(args: &CheckArgs) -> Result<(), Failure> {
    let mut inputs = io::sources(&args.input)?;
    // Another kind of file is refused by what reads it.
    inputs.extend(io::mesh_sources(&args.mesh).unwrap_or_default());
    paths::check_report(args.report.as_deref(), &inputs)?;
    let outcome = check(args);
    report::write_if_asked(args.report.as_deref(), outcome, |()| {
        report::of_success(None, &Quality::default(), &Warnings::default())
    })
}

fn check(args: &CheckArgs) -> Result<(), Failure> {
    paths::check_input(&args.input)?;
    paths::check_input(&args.mesh)?;
    let mut plc = io::read(&args.input)?;
    super::weights::add_to(&mut plc, args.weights)?;
    let mesh = io::read_mesh(&args.mesh).map_err(|e| Failure::from(e).with_code(1))?;
    let mesh = match mesh.dropped {
        Some(_) => mesh.with_dropped(&plc.points).map_err(|e| Failure::from(e).with_code(1))?,
        None => mesh,
    };
    let input_point_count = mesh.points.len().min(plc.points.len()) as u32;
    let mut mesh = TetMesh { input_point_count, ..mesh };
    if !mesh.steiner.is_empty() && mesh.steiner.len() + plc.points.len() != mesh.points.len() {
        // The file belongs to a mesh of another input: check without it.
        mesh.steiner.clear();
        mesh.steiner_terms.clear();
    }
    let preserved = args.preserved.or(match mesh.guarantee {
        _ if args.no_delaunay => None,
        Guarantee::Preserved => Some(PreserveArg::All),
        Guarantee::PreservedOuter => Some(PreserveArg::Outer),
        Guarantee::ConstrainedDelaunay
        | Guarantee::Conforming
        | Guarantee::Delaunay
        | Guarantee::WeightedDelaunay
        | Guarantee::Given => None,
    });
    if preserved == Some(PreserveArg::All) {
        // The files do not say where added points lie; here none may lie on the surface.
        let added = |v: &u32| *v as usize >= plc.points.len();
        if let Some(&v) = mesh.subfaces.iter().flat_map(|face| &face.corners).find(|v| added(v)) {
            let point = mesh.points.get(v as usize).copied();
            let first = Element::Point(v);
            let defect = Defect { kind: DefectKind::FacetMissing, first, second: None, point };
            let message = format!("the added point {v} is a corner of a face on the surface");
            return Err(Failure::from(Error::with_defect(Status::CheckFailed, message, defect)).with_code(1));
        }
        mesh.steiner = vec![SteinerPoint::INSIDE; mesh.points.len().saturating_sub(plc.points.len())];
    }
    super::attribute::attribute_subfaces(&plc, &mut mesh)?;
    let judged = mesh.steiner.len() + plc.points.len() == mesh.points.len();
    let of_points = matches!(mesh.guarantee, Guarantee::Delaunay | Guarantee::WeightedDelaunay);
    if judged && plc.facet_count() > 0 && !of_points {
        require_faces(&args.mesh)?;
    }
    let limit = if args.report.is_some() { 10_000_000 } else { 1000 };
    let verdict = match preserved {
        Some(PreserveArg::All) => delotet::check_preserved(&plc, &mesh, limit),
        Some(PreserveArg::Outer) => delotet::check_preserved_outer(&plc, &mesh, limit),
        None => {
            let conforms = matches!(mesh.guarantee, Guarantee::Conforming | Guarantee::Given);
            let delaunay = !args.no_delaunay && !conforms;
            delotet::check_mesh(&plc, &mesh, delaunay, limit)
        }
    };
    verdict.map_err(|e| Failure::from(e).with_code(1))?;
    let what = match (preserved, mesh.guarantee) {
        (Some(PreserveArg::All), _) => "; the surface is kept",
        (Some(PreserveArg::Outer), _) => "; the outer boundary is kept",
        (None, Guarantee::Delaunay) => "; Delaunay, without facets",
        (None, Guarantee::WeightedDelaunay) if plc.lift.is_plain() => {
            "; weighted: without --weights the Delaunay property was not judged"
        }
        (None, Guarantee::WeightedDelaunay) => "; weighted Delaunay",
        (None, Guarantee::Conforming) => "; optimised",
        (None, Guarantee::Given) => "; the faces of a given mesh are kept",
        (None, _) => "",
    };
    let mut page = Page::default();
    page.text(format_args!(
        "{}: correct ({} points, {} tetrahedra{what}{})",
        args.mesh.display(),
        mesh.points.len(),
        mesh.tets.len(),
        if judged { "" } else { "; no .parents file for this input: conformity was not judged" }
    ));
    page.print()
}

/// Refuses a mesh without a `.face` file, of which it cannot be said that it has the input's facets.
fn require_faces(mesh: &Path) -> Result<(), Failure> {
    match io::mesh_sources(mesh)?.into_iter().find(|file| file.extension().is_some_and(|e| e == "face")) {
        Some(file) if !file.exists() => {
            let message =
                format!("{}: no such file; it says which faces of the mesh are on facets", file.display());
            Err(Failure::from(Error::new(Status::File, message)).with_code(1))
        }
        _ => Ok(()),
    }
}
