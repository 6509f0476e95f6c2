//! Constrained gift wrapping (Shewchuk 1998, Diazzi et al. 2023, section 5) of a polyhedron whose constrained Delaunay
//! tetrahedralization exists.
//!
//! The apex of an open face is the first vertex, in the order in which a sphere through the face growing inwards meets them, whose
//! tetrahedron does not cross the boundary. Any earlier vertex with a free tetrahedron would be visible from the face and inside the
//! circumsphere of the correct one, so the first is the correct one; ties are broken by the global perturbation. The result is therefore
//! consistent with everything else made under it.
use crate::control::Control;
use crate::error::Error;
use crate::facets::fill::Half;
use crate::facets::overlap::overlaps;
use crate::fallible;
use crate::kernel::face_key;
use crate::predicates::{Points, Sign};
use rustc_hash::FxHashMap;

/// A boundary triangle with its box, for quick rejection.
struct Obstacle {
    corners: [u32; 3],
    low: [f64; 3],
    high: [f64; 3],
}

/// Appends the tetrahedra of `half` to `tets`. Fails if an invariant does or memory runs out.
pub fn gift_wrap(
    points: &Points,
    half: &Half,
    tets: &mut Vec<[u32; 4]>,
    control: &Control,
) -> Result<(), Error> {
    let vertices = &half.vertices;
    let obstacles = obstacles(points, half)?;
    // Open faces by key, one entry per side; the stack gives the order.
    let mut open: FxHashMap<[u32; 3], Vec<[u32; 3]>> = FxHashMap::default();
    let mut stack = fallible::reserved(half.faces.len())?;
    for &face in &half.faces {
        fallible::push(fallible::entry(&mut open, face_key(face))?.or_default(), face)?;
        fallible::push(&mut stack, face)?;
    }
    let mut candidates = Vec::new();
    // Each tetrahedron uses up at least one of finitely many (face, side) pairs; more than this is a failed invariant.
    let limit = 64 * (vertices.len() + 16) * (vertices.len() + 16);
    let mut made = 0;
    while let Some(face) = stack.pop() {
        if !close(&mut open, face) {
            continue;
        }
        let apex = find_apex(points, face, vertices, &obstacles, &mut candidates, control)?;
        let [x, y, z] = face;
        fallible::push(tets, [apex, x, y, z])?;
        made += 1;
        if made > limit {
            return Err(Error::internal("gift wrapping did not terminate"));
        }
        // The other faces: each closes an open side, or opens the far one.
        for inner in [[apex, z, y], [apex, x, z], [apex, y, x]] {
            // `inner` as seen from inside this tetrahedron; the opposite vertex is on its positive side.
            if !close(&mut open, inner) {
                let far = [inner[0], inner[2], inner[1]];
                fallible::push(fallible::entry(&mut open, face_key(far))?.or_default(), far)?;
                fallible::push(&mut stack, far)?;
            }
        }
    }
    Ok(())
}

/// Removes an open side of a face; returns whether it was open.
fn close(open: &mut FxHashMap<[u32; 3], Vec<[u32; 3]>>, face: [u32; 3]) -> bool {
    let Some(sides) = open.get_mut(&face_key(face)) else { return false };
    let same = |other: &[u32; 3]| (0..3).any(|k| other[0] == face[k] && other[1] == face[(k + 1) % 3]);
    let Some(at) = sides.iter().position(same) else { return false };
    sides.swap_remove(at);
    true
}

fn obstacles(points: &Points, half: &Half) -> Result<Vec<Obstacle>, Error> {
    let mut keys: Vec<[u32; 3]> = fallible::collect(half.faces.iter().map(|&f| face_key(f)))?;
    keys.sort_unstable();
    keys.dedup();
    let mut list = fallible::reserved(keys.len())?;
    for corners in keys {
        let (low, high) = bounds(points, &corners);
        fallible::push(&mut list, Obstacle { corners, low, high })?;
    }
    Ok(list)
}

/// A box that contains the exact positions of the given vertices: nearest doubles widened by one step.
fn bounds(points: &Points, ids: &[u32]) -> ([f64; 3], [f64; 3]) {
    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for &id in ids {
        let p = points.xyz(id);
        for k in 0..3 {
            low[k] = low[k].min(p[k].next_down());
            high[k] = high[k].max(p[k].next_up());
        }
    }
    (low, high)
}

fn find_apex(
    points: &Points,
    face: [u32; 3],
    vertices: &[u32],
    obstacles: &[Obstacle],
    candidates: &mut Vec<u32>,
    control: &Control,
) -> Result<u32, Error> {
    let [x, y, z] = face;
    candidates.clear();
    candidates.try_reserve(vertices.len())?;
    fallible::extend(
        candidates,
        vertices
            .iter()
            .copied()
            .filter(|v| !face.contains(v) && points.orient3d(*v, x, y, z) == Sign::Positive),
    )?;
    while !candidates.is_empty() {
        let mut first = 0;
        for i in 1..candidates.len() {
            control.step()?;
            // Inside the sphere of the best so far: earlier.
            if points.insphere_perturbed(candidates[first], x, y, z, candidates[i]) == Sign::Positive {
                first = i;
            }
        }
        let apex = candidates.swap_remove(first);
        if is_free(points, [apex, x, y, z], obstacles, control)? {
            return Ok(apex);
        }
    }
    Err(Error::internal("gift wrapping found no apex for a face"))
}

/// Whether no boundary triangle meets the interior of the tetrahedron.
fn is_free(points: &Points, tet: [u32; 4], obstacles: &[Obstacle], control: &Control) -> Result<bool, Error> {
    let (low, high) = bounds(points, &tet);
    for o in obstacles {
        control.step()?;
        let apart = (0..3).any(|k| o.high[k] < low[k] || o.low[k] > high[k]);
        if !apart && overlaps(points, tet, o.corners) {
            return Ok(false);
        }
    }
    Ok(true)
}
