//! Finds the facets of faces that replace triangles of the surface in a patch.
//!
//! Polygons keep their edges, but may get other diagonals. So the faces of a polygon cover what its triangles covered, and are bounded by
//! the same edges: a face at such an edge, on the same side of it, belongs to the polygon, and so do all faces connected to it through
//! other edges.
use crate::error::Error;
use crate::fallible;
use crate::predicates::{Points, Sign};
use crate::preserve::release::segments::axis_of;
use rustc_hash::FxHashMap;

/// A triangle of the surface that is no longer a face.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Gone {
    /// Its patch.
    pub patch: u32,
    /// Its corners.
    pub corners: [u32; 3],
    /// Its facet.
    pub facet: u32,
}

/// Appends the faces (patch and corners, sorted) that replace triangles, each with its facet. A face that no edge assigns to a facet gets
/// any facet of its patch: all of these have one marker.
///
/// # Errors
/// `OutOfMemory`, `Internal`.
pub fn name_facets(
    points: &Points,
    gone: &mut [Gone],
    faces: &[(u32, [u32; 3])],
    out: &mut Vec<([u32; 3], u32)>,
) -> Result<(), Error> {
    gone.sort_unstable();
    out.try_reserve(faces.len())?;
    for run in faces.chunk_by(|x, y| x.0 == y.0) {
        let patch = run[0].0;
        let from = gone.partition_point(|x| x.patch < patch);
        let old = &gone[from..gone.partition_point(|x| x.patch <= patch)];
        let Some(&Gone { facet, .. }) = old.first() else { continue };
        if old.iter().all(|x| x.facet == facet) {
            fallible::extend(out, run.iter().map(|x| (x.1, facet)))?;
        } else {
            name_in_patch(points, old, run, out)?;
        }
    }
    Ok(())
}

/// The directed edges of a triangle turned to be positive along an axis.
fn directed(points: &Points, axis: usize, [a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    match points.orient_in_plane(axis, a, b, c) {
        Sign::Negative => [[a, c], [c, b], [b, a]],
        _ => [[a, b], [b, c], [c, a]],
    }
}

fn name_in_patch(
    points: &Points,
    old: &[Gone],
    faces: &[(u32, [u32; 3])],
    out: &mut Vec<([u32; 3], u32)>,
) -> Result<(), Error> {
    let Some(axis) = axis_of(points, &old[0].corners) else {
        return Err(Error::internal("a triangle of the surface is degenerate"));
    };
    // Facets by the directed edges of their triangles; those that two triangles of one facet have bound nothing.
    let mut facet_of: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    facet_of.try_reserve(3 * old.len())?;
    for x in old {
        fallible::insert_all(&mut facet_of, directed(points, axis, x.corners).map(|edge| (edge, x.facet)))?;
    }
    let bounding = |edge: [u32; 2]| {
        let facet = facet_of.get(&edge).copied()?;
        (facet_of.get(&[edge[1], edge[0]]) != Some(&facet)).then_some(facet)
    };
    let mut face_at: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    face_at.try_reserve(3 * faces.len())?;
    for (i, face) in (0..).zip(faces) {
        fallible::insert_all(&mut face_at, directed(points, axis, face.1).map(|edge| (edge, i)))?;
    }
    let mut named: Vec<Option<u32>> = fallible::filled(None, faces.len())?;
    let mut stack: Vec<u32> = fallible::reserved(faces.len())?;
    for i in 0..faces.len() {
        let edges = directed(points, axis, faces[i].1);
        let Some(facet) = edges.into_iter().find_map(bounding) else { continue };
        if named[i].is_none() {
            named[i] = Some(facet);
            fallible::push(&mut stack, i as u32)?;
        }
        while let Some(j) = stack.pop() {
            for edge in directed(points, axis, faces[j as usize].1) {
                if bounding(edge).is_some() {
                    continue;
                }
                let Some(&beyond) = face_at.get(&[edge[1], edge[0]]) else { continue };
                if named[beyond as usize].is_none() {
                    named[beyond as usize] = Some(facet);
                    fallible::push(&mut stack, beyond)?;
                }
            }
        }
    }
    fallible::extend(
        out,
        faces.iter().zip(named).map(|(face, facet)| (face.1, facet.unwrap_or(old[0].facet))),
    )?;
    Ok(())
}
