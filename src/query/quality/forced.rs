//! Input-forced tetrahedra: those that the input allows no good dihedral angle.
//!
//! Rule: a tetrahedron is input-forced if it lies in a *wedge* of less than [`FORCED_BELOW`] degrees. A wedge is the part of the domain at
//! an edge of the mesh from one subface to the next one around that edge: the tetrahedra that one passes on the way, without crossing a
//! subface. Their dihedral angles there add up to the angle of the two facets, so each is smaller than the wedge, and every mesh
//! of this input, however fine, has an angle of at most that at every point of the edge.
//!
//! Two subfaces that meet at so small an angle are pieces of different facets, which name the cause. The rule does not ask how
//! bad a tetrahedron is; its wedge's angle is recorded with it. Needle-like triangles of the surface are no reason: they force large
//! radius-edge ratios, not small dihedral angles.
use crate::error::Error;
use crate::fallible;
use crate::query::faces::side_with;
use crate::query::quality::TetQuality;
use crate::{TetMesh, INVALID};

/// Wedges of fewer degrees force the tetrahedra in them.
pub const FORCED_BELOW: f64 = 30.0;

/// A tetrahedron in a narrow wedge between two facets; of several wedges the narrowest.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct ForcedTet {
    /// The tetrahedron.
    pub tet: u32,
    /// The input facets on both sides of the wedge, the smaller index first.
    pub facets: [u32; 2],
    /// The ends of the edge where they meet, the smaller index first.
    pub ends: [u32; 2],
    /// The angle of the wedge in degrees.
    pub angle: f64,
}

/// One side of a subface: face `side` of tetrahedron `tet`.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Side {
    tet: u32,
    side: u32,
    facet: u32,
}

/// A step around an edge: in `tet`, from the face opposite its corner `from` to the one opposite its corner `to`. The edge is between the
/// other two corners.
#[derive(Clone, Copy)]
struct Step {
    tet: u32,
    from: usize,
    to: usize,
}

/// The input-forced tetrahedra, in ascending order. None if the mesh has no neighbours or its subfaces have no tetrahedra, as those
/// read from files.
///
/// # Errors
/// [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn forced_tets(mesh: &TetMesh) -> Result<Vec<ForcedTet>, Error> {
    let sides = sides_of(mesh)?;
    let mut found: Vec<ForcedTet> = Vec::new();
    let mut passed: Vec<u32> = Vec::new();
    for &start in &sides {
        let Some(corners) = mesh.tets.get(start.tet as usize) else { continue };
        let quality = TetQuality::of_tet(mesh, corners);
        let from = start.side as usize;
        for to in (0..4).filter(|&to| to != from) {
            let first = Step { tet: start.tet, from, to };
            let Some((facet, angle)) = cross_wedge(mesh, &sides, first, &quality, &mut passed)? else {
                continue;
            };
            let facets = sorted([start.facet, facet]);
            let ends = sorted(edge_of(first).map(|corner| corners[corner]));
            for &tet in &passed {
                fallible::push(&mut found, ForcedTet { tet, facets, ends, angle })?;
            }
        }
    }
    // Every wedge was crossed from both sides; of the narrowest of a tetrahedron one remains.
    found.sort_unstable_by(|a, b| {
        let key = |f: &ForcedTet| (f.facets, f.ends);
        a.tet.cmp(&b.tet).then(a.angle.total_cmp(&b.angle)).then(key(a).cmp(&key(b)))
    });
    found.dedup_by_key(|forced| forced.tet);
    Ok(found)
}

/// Both sides of all subfaces, sorted.
fn sides_of(mesh: &TetMesh) -> Result<Vec<Side>, Error> {
    let mut sides = fallible::reserved(2 * mesh.subfaces.len())?;
    for subface in &mesh.subfaces {
        for tet in subface.tets {
            if let Some(side) = side_with(mesh, tet, &subface.corners) {
                fallible::push(&mut sides, Side { tet, side: side as u32, facet: subface.facet })?;
            }
        }
    }
    sides.sort_unstable();
    Ok(sides)
}

/// Goes around an edge from a subface to the next one. Returns the facet there and the angle between both, and in `passed` the
/// tetrahedra between them; `None` if the angle is not narrow. `quality`: that of the first tetrahedron.
fn cross_wedge(
    mesh: &TetMesh,
    sides: &[Side],
    mut step: Step,
    quality: &TetQuality,
    passed: &mut Vec<u32>,
) -> Result<Option<(u32, f64)>, Error> {
    passed.clear();
    let mut angle = quality.at_edge(edge_of(step));
    // No edge has more tetrahedra than the mesh: neighbours that contradict each other lead nowhere.
    while angle < FORCED_BELOW && passed.len() < mesh.tets.len() {
        fallible::push(passed, step.tet)?;
        let key = (step.tet, step.to as u32);
        if let Ok(at) = sides.binary_search_by_key(&key, |side| (side.tet, side.side)) {
            return Ok(Some((sides[at].facet, angle)));
        }
        let Some(next) = across(mesh, step) else { return Ok(None) };
        step = next;
        angle += TetQuality::of_tet(mesh, &mesh.tets[step.tet as usize]).at_edge(edge_of(step));
    }
    Ok(None)
}

/// The step that follows, in the neighbour; `None` on the boundary.
fn across(mesh: &TetMesh, step: Step) -> Option<Step> {
    let corners = mesh.tets.get(step.tet as usize)?;
    let tet = *mesh.neighbors.get(step.tet as usize)?.get(step.to)?;
    let beyond = mesh.tets.get(tet as usize).filter(|_| tet != INVALID)?;
    // The shared face has the edge and the corner that this step came from.
    let to = beyond.iter().position(|&corner| corner == corners[step.from])?;
    let edge = edge_of(step).map(|corner| corners[corner]);
    let from = (0..4).find(|&i| i != to && !edge.contains(&beyond[i]))?;
    Some(Step { tet, from, to })
}

/// The corners of the edge that a step goes around.
fn edge_of(step: Step) -> [usize; 2] {
    let mut rest = (0..4).filter(|&corner| corner != step.from && corner != step.to);
    [rest.next().unwrap_or(0), rest.next().unwrap_or(0)]
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
