//! Vertex ids that make the perturbed Delaunay tetrahedralization agree with the surface.
//!
//! On flat sides of parts four points often lie on a circle, and the surface has one diagonal or the other. The perturbation gives the
//! diagonal to the point with the lowest id (its lift is lowered most), so numbering the points well makes it choose the
//! surface's: for every such pair of triangles the lowest id of the four is to be an end of the common edge. Points are numbered greedily:
//! the next one is the apex of no open pair or, if there is none, of the fewest.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::edge_key;
use crate::plc::surface::Surface;
use crate::predicates::Points;
use rustc_hash::FxHashMap;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Two triangles with a common edge, on a circle.
struct Pair {
    /// The ends of the edge, then the apexes.
    corners: [u32; 4],
    open: bool,
}

/// The points that should have the lowest ids, in order.
pub fn first_points(surface: &Surface, control: &Control) -> Result<Vec<u32>, Error> {
    let pairs = cocircular_pairs(surface, control)?;
    let mut out = Vec::new();
    if pairs.is_empty() {
        return Ok(out);
    }
    number(pairs, surface.points.len(), &mut out, control)?;
    Ok(out)
}

fn number(
    mut pairs: Vec<Pair>,
    point_count: usize,
    out: &mut Vec<u32>,
    control: &Control,
) -> Result<(), Error> {
    // Pairs of each point; of them, how many it would spoil.
    let mut pairs_of: Vec<(u32, u32)> = fallible::reserved(4 * pairs.len())?;
    let mut spoils: Vec<u32> = fallible::filled(0, point_count)?;
    for (i, pair) in pairs.iter().enumerate() {
        fallible::extend(&mut pairs_of, pair.corners.map(|v| (v, i as u32)))?;
        for v in &pair.corners[2..] {
            spoils[*v as usize] += 1;
        }
    }
    control.sort(&mut pairs_of)?;
    let mut queue = BinaryHeap::new();
    queue.try_reserve(2 * pairs_of.len())?;
    for group in pairs_of.chunk_by(|x, y| x.0 == y.0) {
        fallible::push_heap(&mut queue, Reverse((spoils[group[0].0 as usize], group[0].0)))?;
    }
    let mut done: Vec<bool> = fallible::filled(false, point_count)?;
    while let Some(Reverse((count, v))) = queue.pop() {
        control.step()?;
        if done[v as usize] || count != spoils[v as usize] {
            continue;
        }
        done[v as usize] = true;
        fallible::push(out, v)?;
        let range = pairs_of.partition_point(|x| x.0 < v)..pairs_of.partition_point(|x| x.0 <= v);
        for &(_, i) in &pairs_of[range] {
            let pair = &mut pairs[i as usize];
            if !std::mem::replace(&mut pair.open, false) {
                continue;
            }
            for w in &pair.corners[2..] {
                spoils[*w as usize] -= 1;
                fallible::push_heap(&mut queue, Reverse((spoils[*w as usize], *w)))?;
            }
        }
    }
    Ok(())
}

/// Pairs of triangles at edges that are no segments, whose corners lie on a circle.
fn cocircular_pairs(surface: &Surface, control: &Control) -> Result<Vec<Pair>, Error> {
    let mut pairs = Vec::new();
    if surface.patch_count as usize == surface.triangles.len() {
        return Ok(pairs);
    }
    let points = Points::new(fallible::copied(&surface.points)?);
    let mut apex_of: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    for &[a, b, c] in &surface.triangles {
        control.step()?;
        for (x, y, z) in [(a, b, c), (b, c, a), (c, a, b)] {
            let key = edge_key(x, y);
            if surface.segments.binary_search(&key).is_ok() {
                continue;
            }
            let Some(other) = fallible::insert(&mut apex_of, key, z)? else { continue };
            if points.cocircular(x, y, z, other) {
                fallible::push(&mut pairs, Pair { corners: [x, y, z, other], open: true })?;
            }
        }
    }
    Ok(pairs)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of squares, all cut along the same diagonal or along alternating ones.
    fn grid(size: u32, alternating: bool) -> Surface {
        let mut surface = Surface { patch_count: 1, ..Surface::default() };
        let at = |i: u32, j: u32| i * (size + 1) + j;
        for i in 0..=size {
            for j in 0..=size {
                surface.points.push([f64::from(i), f64::from(j), 0.0]);
            }
        }
        for i in 0..size {
            for j in 0..size {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                if alternating && (i + j) % 2 == 1 {
                    surface.triangles.extend([[a, b, d], [b, c, d]]);
                } else {
                    surface.triangles.extend([[a, b, c], [a, c, d]]);
                }
            }
        }
        surface
    }

    #[test]
    fn all_diagonals_of_grids_are_chosen() {
        for alternating in [false, true] {
            let surface = grid(6, alternating);
            let order = first_points(&surface, &Control::free()).unwrap();
            let rank = |v: u32| order.iter().position(|&w| w == v).unwrap();
            let pairs = cocircular_pairs(&surface, &Control::free()).unwrap();
            assert!(pairs.len() >= 36);
            for pair in pairs {
                let lowest = pair.corners.into_iter().min_by_key(|&v| rank(v)).unwrap();
                assert!(pair.corners[..2].contains(&lowest));
            }
        }
    }
}
