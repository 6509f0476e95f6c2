//! Points: the input points come first, bit for bit; equal ones are mapped to the first of them; each is a vertex of the mesh unless it
//! lies outside; each Steiner point is a vertex, and those marked exact are at their exact positions.
use crate::check::context::Context;
use crate::check::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::predicates::Sign;

/// Reports input points that were moved, wrongly mapped or lost.
pub(super) fn check_points(context: &Context, report: &mut Report) -> Result<(), Error> {
    let (plc, mesh) = (context.plc, context.mesh);
    for (i, (p, q)) in plc.points.iter().zip(&mesh.points).enumerate() {
        if p.map(f64::to_bits) != q.map(f64::to_bits) {
            report.add(DefectKind::PointMoved, Element::Point(i as u32), None, Some(*q));
        }
    }
    for (i, (given, found)) in mesh.point_alias.iter().zip(&context.alias).enumerate() {
        if given != found {
            report.add(
                DefectKind::PointMoved,
                Element::Point(i as u32),
                Some(Element::Point(*found)),
                plc.points.get(i).copied(),
            );
        }
    }
    for v in plc.points.len() as u32..mesh.points.len() as u32 {
        let steiner = mesh.steiner.get(v as usize - plc.points.len());
        if steiner.is_some_and(|s| s.exact) && !context.geometry.is_exact(v) {
            report.add(DefectKind::PointMoved, Element::Point(v), None, context.position(v));
        }
    }
    check_unused(context, report)
}

/// Checks that a point that is no vertex lies outside every closed tetrahedron, or is hidden by the one that contains it.
///
/// The unused points are sorted by x, so each tetrahedron is tested only against those in its range. The bounding box filter uses the
/// nearest doubles: rounding to nearest is monotone, so a point in the tetrahedron is in the box of its rounded corners.
fn check_unused(context: &Context, report: &mut Report) -> Result<(), Error> {
    let near = |v: u32| context.geometry.nearest(v);
    let mut unused: Vec<u32> = Vec::new();
    for i in 0..context.mesh.points.len() as u32 {
        if context.alias(i) == i && !context.stars.used(i) {
            fallible::push(&mut unused, i)?;
        }
    }
    unused.sort_unstable_by(|&i, &j| near(i)[0].total_cmp(&near(j)[0]).then(i.cmp(&j)));
    let mut inside: Vec<(u32, u32)> = Vec::new();
    if unused.is_empty() || context.weights_unknown() {
        return Ok(());
    }
    for (t, tet) in context.mesh.tets.iter().enumerate() {
        let corner = tet.map(near);
        let low: [f64; 3] =
            std::array::from_fn(|k| corner.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min));
        let high: [f64; 3] =
            std::array::from_fn(|k| corner.iter().map(|p| p[k]).fold(f64::NEG_INFINITY, f64::max));
        let from = unused.partition_point(|&i| near(i)[0] < low[0]);
        for &i in unused[from..].iter().take_while(|&&i| near(i)[0] <= high[0]) {
            let p = near(i);
            if (1..3).all(|k| low[k] <= p[k] && p[k] <= high[k])
                && in_tet(context, *tet, i)
                && !is_hidden(context, *tet, i)
            {
                fallible::push(&mut inside, (i, t as u32))?;
            }
        }
    }
    inside.sort_unstable();
    inside.dedup_by_key(|pair| pair.0);
    for (i, t) in inside {
        let at = context.position(i);
        report.add(DefectKind::PointMoved, Element::Point(i), Some(Element::Tet(t)), at);
    }
    Ok(())
}

/// Whether the weights of a tetrahedron hide a point in it.
fn is_hidden(context: &Context, tet: [u32; 4], p: u32) -> bool {
    !context.plc.lift.is_plain() && context.geometry.in_conflict(tet, p) != Sign::Positive
}

fn in_tet(context: &Context, tet: [u32; 4], p: u32) -> bool {
    (0..4).all(|k| {
        let mut moved = tet;
        moved[k] = p;
        context.geometry.orient3d(moved) != Sign::Negative
    })
}
