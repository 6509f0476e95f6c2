//! Splits input edges that overlap along a line without being equal (T-junctions inside a plane) at each other's ends.
use crate::check::context::Context;
use crate::error::Error;
use crate::fallible;

/// For each edge its ends and the ends of other edges strictly inside it, ordered along it.
///
/// Sweep along x over the bounding boxes; these edges are few in a valid mesh.
pub(super) fn split_at_each_other(
    context: &Context,
    mut edges: Vec<[u32; 2]>,
) -> Result<Vec<Vec<u32>>, Error> {
    let at = |v: u32, axis: usize| context.geometry.nearest(v)[axis];
    let low = |e: &[u32; 2], axis: usize| at(e[0], axis).min(at(e[1], axis));
    let high = |e: &[u32; 2], axis: usize| at(e[0], axis).max(at(e[1], axis));
    edges.sort_unstable_by(|e, f| low(e, 0).total_cmp(&low(f, 0)).then(e.cmp(f)));
    // (edge, vertex inside it)
    let mut inside: Vec<(usize, u32)> = Vec::new();
    for (i, e) in edges.iter().enumerate() {
        for (j, f) in edges.iter().enumerate().skip(i + 1) {
            if low(f, 0) > high(e, 0) {
                break;
            }
            if (1..3).any(|k| low(f, k) > high(e, k) || low(e, k) > high(f, k)) {
                continue;
            }
            for (edge, ends, other) in [(i, e, f), (j, f, e)] {
                for &v in other {
                    if context.geometry.strictly_between(v, ends[0], ends[1]) {
                        fallible::push(&mut inside, (edge, v))?;
                    }
                }
            }
        }
    }
    inside.sort_unstable();
    inside.dedup();
    let mut out = fallible::reserved(edges.len())?;
    for (i, e) in edges.iter().enumerate() {
        let from = inside.partition_point(|x| x.0 < i);
        let to = inside.partition_point(|x| x.0 <= i);
        let mut corners = fallible::reserved(to - from + 2)?;
        fallible::push(&mut corners, e[0])?;
        fallible::extend(&mut corners, inside[from..to].iter().map(|x| x.1))?;
        corners[1..].sort_unstable_by(|&v, &w| {
            let before = |v, w| context.geometry.strictly_between(v, e[0], w);
            before(w, v).cmp(&before(v, w)).then(v.cmp(&w))
        });
        fallible::push(&mut corners, e[1])?;
        fallible::push(&mut out, corners)?;
    }
    Ok(out)
}
