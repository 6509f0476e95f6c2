//! Attributes of added points, interpolated from those of the input points.
//!
//! On an input edge: linear between its ends. Inside: the point is a convex combination of four points around it, a vertex of its star and
//! the triangle of the star's boundary through which the line from there through the point leaves. So linear attributes are reproduced up
//! to rounding, and no value leaves the range of its neighbours. This is no topological decision, so doubles suffice.
use crate::elementary::{exponent, power_of_two, quotient};
use crate::error::Error;
use crate::fallible;
use crate::output::TetMesh;
use crate::plc::{MarkerName, Plc};
use std::borrow::Cow;

/// The input restricted to the points that remain in the mesh, for their markers and attributes. Facets are not copied, since their corners
/// would have other indices; markers, names and seeds are.
///
/// # Errors
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn as_meshed<'a>(plc: &'a Plc, mesh: &TetMesh) -> Result<Cow<'a, Plc>, Error> {
    // The numbers of input points agree: none was dropped, or the input has already been restricted.
    let dropped = match &mesh.dropped {
        Some(dropped) if plc.points.len() != mesh.input_point_count as usize => dropped,
        _ => return Ok(Cow::Borrowed(plc)),
    };
    let width = plc.point_attribute_count;
    let mut left = Plc {
        point_attribute_count: width,
        segments: fallible::copied(&plc.segments)?,
        regions: fallible::copied(&plc.regions)?,
        names: fallible::each(&plc.names, MarkerName::try_clone)?,
        ..Plc::default()
    };
    left.points.try_reserve_exact(mesh.input_point_count as usize)?;
    left.point_markers.try_reserve_exact(plc.point_markers.len())?;
    left.point_attributes.try_reserve_exact(plc.point_attributes.len())?;
    for old in dropped.kept_inputs().map(|old| old as usize) {
        fallible::extend(&mut left.points, plc.points.get(old).copied())?;
        fallible::extend(&mut left.point_markers, plc.point_markers.get(old).copied())?;
        let row = plc.point_attributes.get(old * width..(old + 1) * width);
        fallible::append(&mut left.point_attributes, row.unwrap_or_default())?;
    }
    Ok(Cow::Owned(left))
}

/// The attributes of the Steiner points of `mesh`: `plc.point_attribute_count` numbers per point, in their order.
///
/// # Errors
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn continue_attributes(plc: &Plc, mesh: &TetMesh) -> Result<Vec<f64>, Error> {
    let width = plc.point_attribute_count;
    let mut added: Vec<f64> = Vec::new();
    if width == 0 {
        return Ok(added);
    }
    added.try_reserve_exact(width * mesh.steiner.len())?;
    fallible::resize(&mut added, width * mesh.steiner.len(), 0.0)?;
    let given = |p: u32, k: usize| plc.point_attributes.get(p as usize * width + k).copied().unwrap_or(0.0);
    let inputs = mesh.points.len().saturating_sub(mesh.steiner.len());
    let mut known: Vec<bool> = fallible::filled(true, mesh.points.len())?;
    let mut inside: Vec<u32> = Vec::new();
    for (i, steiner) in mesh.steiner.iter().enumerate() {
        if !steiner.is_on_edge() {
            if let Some(known) = known.get_mut(inputs + i) {
                *known = false;
                fallible::push(&mut inside, (inputs + i) as u32)?;
            }
            continue;
        }
        let [a, b] = steiner.ends;
        for k in 0..width {
            added[i * width + k] = (1.0 - steiner.t) * given(a, k) + steiner.t * given(b, k);
        }
    }
    if inside.is_empty() {
        return Ok(added);
    }
    let stars = stars(mesh, &known)?;
    // Points inside may have to wait for others around them; if that does not help, the known ones must suffice.
    let mut partly = false;
    while !inside.is_empty() {
        let before = inside.len();
        inside.retain(|&v| {
            let from = stars.partition_point(|x| x.0 < v);
            let star = stars[from..].iter().take_while(|x| x.0 == v).map(|x| mesh.tets[x.1 as usize]);
            let found = match partly {
                false => enclosing(mesh, v, star, &known),
                true => beside(star, &known),
            };
            let Some((corners, weights)) = found else { return true };
            for k in 0..width {
                let value = |p: u32| match (p as usize).checked_sub(inputs) {
                    None => given(p, k),
                    Some(i) => added[i * width + k],
                };
                let sum = corners.iter().zip(weights).map(|(&p, w)| w * value(p)).sum::<f64>();
                added[(v as usize - inputs) * width + k] = sum;
            }
            known[v as usize] = true;
            false
        });
        let stuck = inside.len() == before;
        if stuck && partly {
            break;
        }
        partly = stuck;
    }
    Ok(added)
}

/// Pairs (point, tetrahedron) for every unknown point, sorted.
fn stars(mesh: &TetMesh, known: &[bool]) -> Result<Vec<(u32, u32)>, Error> {
    let mut stars: Vec<(u32, u32)> = Vec::new();
    let sound = |tet: &[u32; 4]| tet.iter().all(|&v| (v as usize) < known.len());
    for (t, tet) in mesh.tets.iter().enumerate().filter(|(_, tet)| sound(tet)) {
        for &v in tet.iter().filter(|&&v| !known[v as usize]) {
            fallible::push(&mut stars, (v, t as u32))?;
        }
    }
    stars.sort_unstable();
    Ok(stars)
}

/// Four known points around `v` and its weights in them: of all pairs of a vertex of the star and a triangle of the star's boundary, the
/// one with the largest smallest weight. `None` if there is none.
#[expect(clippy::disallowed_methods, reason = "the iterator goes over slices: a copy of it owns no memory")]
fn enclosing(
    mesh: &TetMesh,
    v: u32,
    star: impl Iterator<Item = [u32; 4]> + Clone,
    known: &[bool],
) -> Option<([u32; 4], [f64; 4])> {
    let mut best: Option<(f64, [u32; 4], [f64; 4])> = None;
    for apex in star.clone().flatten().filter(|&p| known[p as usize]) {
        for tet in star.clone().filter(|tet| !tet.contains(&apex)) {
            let corners = tet.map(|p| if p == v { apex } else { p });
            if !corners.iter().all(|&p| known[p as usize]) {
                continue;
            }
            let weights = barycentric(mesh, corners, v);
            let least = weights.iter().copied().fold(f64::INFINITY, f64::min);
            if least > best.map_or(0.0, |b| b.0) {
                best = Some((least, corners, weights));
            }
        }
    }
    best.map(|(_, corners, weights)| (corners, weights))
}

/// The known corners of the tetrahedron in the star that has the most of them, with equal weights.
fn beside(star: impl Iterator<Item = [u32; 4]>, known: &[bool]) -> Option<([u32; 4], [f64; 4])> {
    let count = |tet: &[u32; 4]| tet.iter().filter(|&&p| known[p as usize]).count();
    let tet = star.max_by_key(count).filter(|tet| count(tet) > 0)?;
    let weight = 1.0 / count(&tet) as f64;
    Some((tet, tet.map(|p| if known[p as usize] { weight } else { 0.0 })))
}

/// Weights of `v` in a tetrahedron: the volume with `v` in place of each corner, divided by the whole volume.
fn barycentric(mesh: &TetMesh, corners: [u32; 4], v: u32) -> [f64; 4] {
    // Coordinates of about one: their products neither overflow nor vanish.
    let largest = corners.iter().flat_map(|&p| mesh.points[p as usize]).fold(0.0f64, |m, x| m.max(x.abs()));
    let factor = power_of_two(-exponent(largest).max(-1000));
    let volume = |at: [u32; 4]| {
        let [a, b, c, d] = at.map(|p| mesh.points[p as usize].map(|x| x * factor));
        let [u, v, w] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
            + u[2] * (v[0] * w[1] - v[1] * w[0])
    };
    let whole = volume(corners);
    std::array::from_fn(|i| {
        let mut part = corners;
        part[i] = v;
        // No weights if the tetrahedron is flat in doubles.
        quotient(volume(part), whole).unwrap_or(-1.0)
    })
}
