//! On request: the surface is the input's, triangle by triangle, and no added point lies on it.
//!
//! The other checks ensure that the subfaces tile the facets, that the complex is valid and that segments are chains of edges. Three
//! questions remain: whether all corners of subfaces and ends of subsegments are input points (then no added point lies on the surface,
//! since it could only be a vertex of these), whether no added point claims an input edge, and whether every input triangle is a face. A
//! triangle with input points on it besides its corners cannot be a face: there only a tiling by input points is required, and the same
//! holds for general facets.
//!
//! For the outer boundary the converse is checked: every face there has input points as corners and is a triangle of the input. Since the
//! faces tile the facets, no triangle of the outer boundary can then be missing.
use crate::check::carved::is_carved;
use crate::check::context::Context;
use crate::check::faces::sorted;
use crate::check::facets::flipped_triangles;
use crate::check::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::predicates::Sign;

/// Reports added points on the surface, and input triangles that are not faces.
pub(super) fn check_preserved(context: &Context, report: &mut Report) -> Result<(), Error> {
    check_added_points(context, report);
    let triangles = flipped_triangles(context, report)?;
    let by_facet = subfaces_by_facet(context)?;
    for (f, &corners) in triangles.iter().enumerate() {
        let [a, b, c] = corners;
        if a == b || b == c || c == a || !context.faces.find(corners).is_empty() {
            continue;
        }
        let from = by_facet.partition_point(|x| x.0 < f as u32);
        let mut own = by_facet[from..].iter().take_while(|x| x.0 == f as u32);
        let excused = own.any(|x| {
            let face = &context.subfaces[x.1 as usize];
            let mut others = face.corners.iter().filter(|v| !corners.contains(v));
            let is_it = face.corners.iter().all(|v| corners.contains(v));
            is_it && is_carved(context, face)
                || others.any(|&v| context.is_input(v) && on_triangle(context, corners, v))
        });
        if !excused {
            report.add(DefectKind::FacetMissing, Element::Facet(f as u32), None, context.position(a));
        }
    }
    Ok(())
}

/// Reports added points on the outer boundary, and faces there that are not input triangles.
pub(super) fn check_outer(context: &Context, report: &mut Report) -> Result<(), Error> {
    let triangles = flipped_triangles(context, report)?;
    let mut keys: Vec<[u32; 3]> = fallible::collect(triangles.iter().map(|&t| sorted(t).0))?;
    keys.sort_unstable();
    for face in context.subfaces.iter() {
        if context.faces.find(face.corners).len() != 1 {
            continue;
        }
        let corners = face.corners.map(|v| context.alias(v));
        let element = Element::Facet(face.facet);
        if let Some(&v) = corners.iter().find(|&&v| !context.is_input(v)) {
            report.add(DefectKind::FacetMissing, element, Some(Element::Point(v)), context.position(v));
            continue;
        }
        let excused = match triangles.get(face.facet as usize) {
            // General facets have no triangles of their own.
            None => true,
            Some(&own) => {
                corners.iter().any(|v| !own.contains(v))
                    && corners.iter().all(|&v| own.contains(&v) || on_triangle(context, own, v))
            }
        };
        if keys.binary_search(&sorted(corners).0).is_err() && !excused {
            report.add(DefectKind::FacetMissing, element, None, context.position(corners[0]));
        }
    }
    Ok(())
}

/// Reports added points that claim to lie on an input edge, or that are corners of pieces of the surface.
fn check_added_points(context: &Context, report: &mut Report) {
    let inputs = context.plc.points.len();
    for (i, _) in context.mesh.steiner.iter().enumerate().filter(|(_, s)| !s.is_inside()) {
        let v = (inputs + i) as u32;
        report.add(DefectKind::SegmentMissing, Element::Point(v), None, context.position(v));
    }
    for face in context.subfaces.iter() {
        for &v in face.corners.iter().filter(|&&v| !context.is_input(v)) {
            let point = Some(Element::Point(v));
            report.add(DefectKind::FacetMissing, Element::Facet(face.facet), point, context.position(v));
        }
    }
    for edge in context.subsegments.iter() {
        for &v in edge.ends.iter().filter(|&&v| !context.is_input(v)) {
            let point = Some(Element::Point(v));
            report.add(
                DefectKind::SegmentMissing,
                Element::Segment(edge.segment),
                point,
                context.position(v),
            );
        }
    }
}

/// Pairs (facet, subface), sorted.
fn subfaces_by_facet(context: &Context) -> Result<Vec<(u32, u32)>, Error> {
    let subfaces = &context.subfaces;
    let mut by_facet =
        fallible::collect(subfaces.iter().enumerate().map(|(i, face)| (face.facet, i as u32)))?;
    by_facet.sort_unstable();
    Ok(by_facet)
}

/// Whether `v` lies on the closed triangle.
fn on_triangle(context: &Context, [a, b, c]: [u32; 3], v: u32) -> bool {
    let geometry = &context.geometry;
    if geometry.orient3d([a, b, c, v]) != Sign::Zero {
        return false;
    }
    let Some(axis) = (0..3).find(|&axis| geometry.orient_in_plane(axis, [a, b, c]) != Sign::Zero) else {
        return false;
    };
    let all = geometry.orient_in_plane(axis, [a, b, c]);
    [[a, b, v], [b, c, v], [c, a, v]].iter().all(|&t| {
        let sign = geometry.orient_in_plane(axis, t);
        sign == Sign::Zero || sign == all
    })
}
