//! Warnings about a mesh that is valid nonetheless.
use crate::control::Control;
use crate::domain::Domain;
use crate::error::{Element, Error};
use crate::fallible;
use crate::kernel::edge_key;
use crate::options::{Mode, Options};
use crate::output::{Subface, TetMesh};
use crate::plan::refine::fills;
use crate::plc::planarity::{farthest_corner, NOTABLE};
use crate::plc::surface::Surface;
use crate::plc::{Plc, RegionSeed};
use crate::warning::{Warning, WarningKind, Warnings};
use crate::INVALID;

/// Warns of equal points, and of input that has no effect. Returns how many points equal an earlier one.
pub(super) fn about_input(plc: &Plc, alias: &[u32], options: &Options, warnings: &mut Warnings) -> u64 {
    for (&earlier, (i, &at)) in alias.iter().zip((0..).zip(&plc.points)) {
        if earlier != i {
            let (first, second) = (Element::Point(i), Some(Element::Point(earlier)));
            let warning = Warning { kind: WarningKind::EqualPoints, first, second, point: Some(at) };
            warnings.push(warning, options.max_defects);
        }
    }
    if options.mode != Mode::Delaunay {
        let unused = |seed: &RegionSeed| seed.max_volume.is_some() && !fills(options);
        for (i, seed) in (0..).zip(&plc.regions).filter(|x| unused(x.1)) {
            let (kind, first) = (WarningKind::UnusedVolume, Element::Region(i));
            let warning = Warning { kind, first, second: None, point: Some(seed.point) };
            warnings.push(warning, options.max_defects);
        }
        for (i, facet) in (plc.triangles.len() as u32..).zip(&plc.facets) {
            let Some((corner, far)) = farthest_corner(plc, facet) else { continue };
            if far > NOTABLE {
                let (kind, first) = (WarningKind::NonPlanarFacet, Element::Facet(i));
                let point = plc.points.get(corner as usize).copied();
                let second = Some(Element::Point(corner));
                warnings.push(Warning { kind, first, second, point }, options.max_defects);
            }
        }
    }
    warnings.count(WarningKind::EqualPoints)
}

/// Warns of seeds that have no effect.
pub(super) fn about_seeds(plc: &Plc, regions: &Domain, options: &Options) -> Warnings {
    let mut warnings = Warnings::default();
    for &hole in &regions.holes_outside {
        let (kind, first) = (WarningKind::HoleOutside, Element::Hole(hole));
        let point = plc.holes.get(hole as usize).copied();
        warnings.push(Warning { kind, first, second: None, point }, options.max_defects);
    }
    for &[seed, earlier] in &regions.repeated_seeds {
        let (kind, first) = (WarningKind::RepeatedSeed, Element::Region(seed));
        let point = plc.regions.get(seed as usize).map(|seed| seed.point);
        warnings.push(
            Warning { kind, first, second: Some(Element::Region(earlier)), point },
            options.max_defects,
        );
    }
    warnings
}

/// Warns of what is not meshed, and of the open edges where it leaks.
pub(super) fn about_mesh(
    mesh: &TetMesh,
    options: &Options,
    warnings: &mut Warnings,
    control: &Control,
) -> Result<(), Error> {
    let limit = options.max_defects;
    let at = |v: u32| mesh.points.get(v as usize).copied().unwrap_or_default();
    let middle = |list: &[u32]| {
        let weight = 1.0 / list.len() as f64;
        Some([0, 1, 2].map(|k| list.iter().map(|&v| at(v)[k] * weight).sum()))
    };
    for ends in open_edges(mesh, control)? {
        let [first, second] = ends.map(Element::Point);
        let (kind, point) = (WarningKind::OpenEdge, middle(&ends));
        warnings.push(Warning { kind, first, second: Some(second), point }, limit);
    }
    for face in &mesh.unmeshed_subfaces {
        let (kind, first) = (WarningKind::UnmeshedFacet, Element::Facet(face.facet));
        warnings.push(Warning { kind, first, second: None, point: middle(&face.corners) }, limit);
    }
    for edge in mesh.unmeshed_subsegments.iter().filter(|edge| edge.segment != INVALID) {
        let (kind, first) = (WarningKind::UnmeshedSegment, Element::Segment(edge.segment));
        warnings.push(Warning { kind, first, second: None, point: middle(&edge.ends) }, limit);
    }
    // Hidden points are what weights are for.
    let unmeshed = mesh.unmeshed_points.iter().filter(|v| mesh.hidden_points.binary_search(v).is_err());
    for &v in unmeshed {
        // Equal points and the pieces on which added points lie have warnings of their own.
        if mesh.point_alias.get(v as usize) == Some(&v) {
            let (kind, first) = (WarningKind::UnmeshedPoint, Element::Point(v));
            warnings.push(Warning { kind, first, second: None, point: Some(at(v)) }, limit);
        }
    }
    Ok(())
}

/// The input's edges (ends ascending; sorted) with only one facet, which bounds no tetrahedron there.
fn open_edges(mesh: &TetMesh, control: &Control) -> Result<Vec<[u32; 2]>, Error> {
    let edges = |face: &Subface| {
        let [a, b, c] = face.corners;
        [edge_key(a, b), edge_key(b, c), edge_key(c, a)]
    };
    let mut open: Vec<[u32; 2]> = fallible::reserved(3 * mesh.unmeshed_subfaces.len())?;
    fallible::extend(&mut open, mesh.unmeshed_subfaces.iter().flat_map(edges))?;
    if open.is_empty() {
        return Ok(open);
    }
    control.look()?;
    open.sort_unstable();
    // Once among those that are not meshed, and on no other subface.
    let mut once: Vec<([u32; 2], bool)> = fallible::reserved(open.len())?;
    fallible::extend(
        &mut once,
        open.chunk_by(|x, y| x == y).filter(|run| run.len() == 1).map(|run| (run[0], true)),
    )?;
    for edge in mesh.subfaces.iter().flat_map(edges) {
        control.step()?;
        if let Ok(found) = once.binary_search_by_key(&edge, |x| x.0) {
            once[found].1 = false;
        }
    }
    // Pieces of one input edge, between the points added on it, count as one.
    open.clear();
    fallible::extend(
        &mut open,
        once.into_iter().filter(|x| x.1).map(|([a, b], _)| {
            let added =
                |v: u32| v.checked_sub(mesh.input_point_count).and_then(|i| mesh.steiner.get(i as usize));
            let parent = added(a).or(added(b)).filter(|point| point.is_on_edge());
            parent.map_or([a, b], |point| edge_key(point.ends[0], point.ends[1]))
        }),
    )?;
    open.sort_unstable();
    open.dedup();
    Ok(open)
}

/// The error for an input that encloses nothing, with the open edges where it leaks.
pub(super) fn nothing_enclosed(plc: &Plc, surface: &Surface, max_defects: usize, control: &Control) -> Error {
    match crate::plc::open::open_edges(surface, control) {
        Ok(open) => crate::plc::prepare::nothing_enclosed(plc, surface, &open, max_defects),
        Err(error) => error,
    }
}
