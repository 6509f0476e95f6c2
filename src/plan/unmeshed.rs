//! Separates what is not meshed: pieces of facets and segments, and points, around which everything was carved.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::edge_key;
use crate::output::{Subsegment, TetMesh};
use crate::INVALID;
use rustc_hash::FxHashSet;

/// Moves subsegments that are edges of no tetrahedron to their list, and lists the points that no tetrahedron has. Subfaces have
/// been sorted out already: they know their tetrahedra.
pub(super) fn set_apart(mesh: &mut TetMesh, control: &Control) -> Result<(), Error> {
    let mut used = fallible::filled(false, mesh.points.len())?;
    for tet in &mesh.tets {
        for &v in tet {
            used[v as usize] = true;
        }
    }
    set_subsegments_apart(mesh, &used, control)?;
    for (v, &used) in used.iter().enumerate() {
        if !used {
            fallible::push(&mut mesh.unmeshed_points, v as u32)?;
            if !mesh.lift.is_plain() && mesh.point_alias.get(v) == Some(&(v as u32)) {
                fallible::push(&mut mesh.hidden_points, v as u32)?;
            }
        }
    }
    Ok(())
}

fn set_subsegments_apart(mesh: &mut TetMesh, used: &[bool], control: &Control) -> Result<(), Error> {
    // An edge of facets only is no edge of the mesh only if a facet at it is not meshed. Looked up only, never iterated.
    let mut apart: FxHashSet<[u32; 2]> = FxHashSet::default();
    let segments = || mesh.subsegments.iter().filter(|edge| edge.segment != INVALID);
    apart.try_reserve(segments().count() + 3 * mesh.unmeshed_subfaces.len())?;
    fallible::add_all(&mut apart, segments().map(|edge| edge_key(edge.ends[0], edge.ends[1])))?;
    fallible::add_all(&mut apart, mesh.unmeshed_subfaces.iter().flat_map(|face| edges(face.corners)))?;
    if apart.is_empty() {
        return Ok(());
    }
    for edge in mesh.subfaces.iter().flat_map(|face| edges(face.corners)) {
        apart.remove(&edge);
    }
    // A segment through a region is on no subface, but on tetrahedra.
    if apart.iter().any(|edge| edge.iter().all(|&v| used[v as usize])) {
        for &[a, b, c, d] in &mesh.tets {
            control.step()?;
            for [a, b] in [[a, b], [a, c], [a, d], [b, c], [b, d], [c, d]] {
                apart.remove(&edge_key(a, b));
            }
        }
    }
    if apart.is_empty() {
        return Ok(());
    }
    let is_apart = |edge: &Subsegment| apart.contains(&edge_key(edge.ends[0], edge.ends[1]));
    mesh.unmeshed_subsegments
        .try_reserve_exact(mesh.subsegments.iter().filter(|edge| is_apart(edge)).count())?;
    let moved = mesh.subsegments.iter().filter(|edge| is_apart(edge)).copied();
    fallible::extend(&mut mesh.unmeshed_subsegments, moved)?;
    mesh.subsegments.retain(|edge| !is_apart(edge));
    Ok(())
}

fn edges([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [edge_key(a, b), edge_key(b, c), edge_key(c, a)]
}
