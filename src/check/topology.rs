//! Topology: the tetrahedra form a complex. Each face belongs to at most two, which lie on opposite sides of it; the listed neighbours are
//! these; regions change only at subfaces.
use crate::check::context::Context;
use crate::check::faces::{face_corners, sorted, Entry};
use crate::check::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::output::TetMesh;
use crate::INVALID;

/// Checks the faces; returns for each tetrahedron and face the neighbour as `4 * tet + face`, or `INVALID`.
pub(super) fn check_topology(context: &Context, report: &mut Report) -> Result<Vec<[u32; 4]>, Error> {
    let tets = &context.mesh.tets;
    for (t, tet) in tets.iter().enumerate() {
        let repeated = (0..4).any(|i| (i + 1..4).any(|j| tet[i] == tet[j]));
        if repeated || tet.iter().any(|&v| context.alias(v) != v) {
            not_conforming(context, t as u32, None, report);
        }
    }
    let mut adjacency = fallible::filled([INVALID; 4], tets.len())?;
    for (_, run) in context.faces.runs() {
        match run {
            [_] => {}
            [a, b] if opposite_sides(tets, a, b) => {
                adjacency[a.handle as usize / 4][a.handle as usize % 4] = b.handle;
                adjacency[b.handle as usize / 4][b.handle as usize % 4] = a.handle;
            }
            [a, b, ..] => not_conforming(context, a.handle / 4, Some(b.handle / 4), report),
            [] => {}
        }
    }
    check_neighbors(context.mesh, &adjacency, report);
    Ok(adjacency)
}

/// Whether two tetrahedra induce opposite orientations on a common face; positive ones are then on opposite sides.
fn opposite_sides(tets: &[[u32; 4]], a: &Entry, b: &Entry) -> bool {
    let odd = |e: &Entry| sorted(face_corners(tets[e.handle as usize / 4], e.handle as usize % 4)).1;
    odd(a) != odd(b)
}

/// `neighbors` may be empty (a mesh from files); otherwise each entry must be correct.
fn check_neighbors(mesh: &TetMesh, adjacency: &[[u32; 4]], report: &mut Report) {
    for (t, (given, found)) in mesh.neighbors.iter().zip(adjacency).enumerate() {
        let found = found.map(|n| if n == INVALID { INVALID } else { n / 4 });
        if *given != found {
            report.add(DefectKind::NotConforming, Element::Tet(t as u32), None, None);
        }
    }
}

/// Checks that tetrahedra on both sides of a face without a subface belong to one region.
pub(super) fn check_regions(context: &Context, adjacency: &[[u32; 4]], subfaces: &[u8], report: &mut Report) {
    let regions = &context.mesh.tet_region;
    // Without subfaces it is unknown where regions may change.
    let unknown = !context.subfaces_known() && context.mesh.subfaces.is_empty();
    if regions.is_empty() || unknown {
        return;
    }
    for (t, near) in adjacency.iter().enumerate() {
        for (face, &n) in near.iter().enumerate() {
            let constrained = subfaces[t] >> face & 1 == 1;
            if n != INVALID && n as usize / 4 > t && !constrained && regions[n as usize / 4] != regions[t] {
                not_conforming(context, t as u32, Some(n / 4), report);
            }
        }
    }
}

fn not_conforming(context: &Context, t: u32, other: Option<u32>, report: &mut Report) {
    let at = context.mesh.points[context.mesh.tets[t as usize][0] as usize];
    report.add(DefectKind::NotConforming, Element::Tet(t), other.map(Element::Tet), Some(at));
}
