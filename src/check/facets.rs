//! The input facets for the checks: with flips applied, planes, edges subdivided as in the mesh, and groups.
//!
//! A mesher may retriangulate facets across their common edges if they are exactly coplanar and have equal markers. So coverage is checked
//! for such a *group*, not for single facets. Non-planar facets join a group only if the mesh has not kept their common edge.
use crate::check::chains::Chains;
use crate::check::context::Context;
use crate::check::overlaps;
use crate::check::report::Report;
use crate::error::{DefectKind, Element, Error};
use crate::fallible;
use crate::plc::Interior;
use crate::predicates::Sign;
use rustc_hash::FxHashMap;

/// A facet: its polygons of three corners or more, as representatives.
pub(super) struct Facet {
    pub(super) polygons: Vec<Vec<u32>>,
    /// All corners, including those of polygons of one or two.
    pub(super) corners: Vec<u32>,
    /// Pairs of corners that must be joined in the mesh but bound nothing.
    pub(super) inner_edges: Vec<[u32; 2]>,
    /// Three corners that are not collinear, if any.
    pub(super) plane: Option<[u32; 3]>,
    /// Whether all corners lie exactly in `plane`.
    pub(super) planar: bool,
    /// Whether the interior is what the polygons enclose (TetGen's rule), instead of their sum modulo 2.
    pub(super) enclosed: bool,
    /// Whether there are hole seeds.
    pub(super) seeded: bool,
    pub(super) marker: i32,
}

/// A piece of a facet's edge, between two consecutive vertices of the mesh on it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Piece {
    /// Ends, ascending.
    pub(super) ends: [u32; 2],
    pub(super) facet: u32,
    /// Whether it is an edge of the mesh.
    pub(super) found: bool,
}

/// All facets, in the PLC's numbering.
pub(super) fn facets(context: &Context, report: &mut Report) -> Result<Vec<Facet>, Error> {
    let plc = context.plc;
    let triangles = flipped_triangles(context, report)?;
    let mut out = fallible::reserved(plc.facet_count())?;
    for (i, corners) in triangles.into_iter().enumerate() {
        let polygons = fallible::collect([fallible::copied(&corners)?])?;
        fallible::push(&mut out, facet(context, polygons, false, false, plc.facet_marker(i))?)?;
    }
    for (i, general) in plc.facets.iter().enumerate() {
        let mut polygons = fallible::reserved(general.polygons.len())?;
        for polygon in &general.polygons {
            let mut corners = fallible::collect(polygon.iter().map(|&v| context.alias(v)))?;
            corners.dedup();
            fallible::push(&mut polygons, corners)?;
        }
        let enclosed = general.interior == Interior::Seeds;
        let marker = plc.facet_marker(plc.triangles.len() + i);
        fallible::push(&mut out, facet(context, polygons, enclosed, !general.holes.is_empty(), marker)?)?;
    }
    Ok(out)
}

fn facet(
    context: &Context,
    all: Vec<Vec<u32>>,
    enclosed: bool,
    seeded: bool,
    marker: i32,
) -> Result<Facet, Error> {
    let inner_edges = fallible::collect(all.iter().filter(|p| p.len() == 2).map(|p| [p[0], p[1]]))?;
    let mut everything = fallible::collect(all.iter().flatten().copied())?;
    let mut polygons = all;
    polygons.retain(|p| p.len() > 2);
    let corners = || polygons.iter().flatten().copied();
    let mut plane = None;
    if let Some(a) = corners().next() {
        if let Some(b) = corners().find(|&v| v != a) {
            plane = corners().find(|&c| !context.geometry.collinear([a, b, c])).map(|c| [a, b, c]);
        }
    }
    let in_plane = |[a, b, c]: [u32; 3], v| {
        v == a || v == b || v == c || context.geometry.orient3d([a, b, c, v]) == Sign::Zero
    };
    let planar = plane.is_some_and(|p| everything.iter().all(|&v| in_plane(p, v)));
    everything.sort_unstable();
    everything.dedup();
    Ok(Facet { polygons, corners: everything, inner_edges, plane, planar, enclosed, seeded, marker })
}

/// The input triangles after the flips of facet merging: each flip replaces two triangles with a common edge by the two others of the same
/// quadrilateral. The triangle with the first end of the old edge keeps the first facet's number.
pub(super) fn flipped_triangles(context: &Context, report: &mut Report) -> Result<Vec<[u32; 3]>, Error> {
    let mut triangles: Vec<[u32; 3]> =
        fallible::collect(context.plc.triangles.iter().map(|t| t.map(|v| context.alias(v))))?;
    let key = |mut c: [u32; 3]| {
        c.sort_unstable();
        c
    };
    // Only looked up, never iterated, so its order decides nothing.
    let mut numbers: FxHashMap<[u32; 3], usize> = FxHashMap::default();
    if !context.mesh.facet_flips.is_empty() {
        fallible::insert_all(&mut numbers, triangles.iter().enumerate().map(|(i, &c)| (key(c), i)))?;
    }
    for flip in &context.mesh.facet_flips {
        let [a, b] = flip.old.map(|v| context.alias(v));
        let [c, d] = flip.new.map(|v| context.alias(v));
        let pair = (numbers.remove(&key([a, b, c])), numbers.remove(&key([a, b, d])));
        let (Some(f), Some(g)) = pair else {
            report.add(DefectKind::FacetMissing, Element::Facet(flip.facets[0]), None, context.position(a));
            continue;
        };
        let (f, g) = if g as u32 == flip.facets[0] { (g, f) } else { (f, g) };
        if context.plc.facet_marker(f) != context.plc.facet_marker(g) {
            report.add(DefectKind::FacetMissing, Element::Facet(f as u32), None, context.position(a));
        }
        for (slot, corners) in [(f, [a, c, d]), (g, [b, c, d])] {
            triangles[slot] = corners;
            fallible::insert(&mut numbers, key(corners), slot)?;
        }
    }
    Ok(triangles)
}

/// The pieces of all facets' edges, sorted by ends, then facet.
///
/// An edge that is no chain of mesh edges may have been removed by retriangulation inside a group. If the neighbour's edges on the same
/// line end elsewhere, the edges split each other, so that equal pieces match.
pub(super) fn pieces(context: &Context, facets: &[Facet], chains: &Chains) -> Result<Vec<Piece>, Error> {
    let mut edges: Vec<([u32; 2], u32)> = Vec::new();
    for (i, facet) in facets.iter().enumerate() {
        for polygon in &facet.polygons {
            edges.try_reserve(polygon.len())?;
            for (k, &a) in polygon.iter().enumerate() {
                let b = polygon[(k + 1) % polygon.len()];
                if a != b {
                    fallible::push(&mut edges, ([a.min(b), a.max(b)], i as u32))?;
                }
            }
        }
    }
    edges.sort_unstable();
    let mut out = Vec::new();
    let mut open: Vec<[u32; 2]> = Vec::new();
    let mut chain = Vec::new();
    for run in edges.chunk_by(|x, y| x.0 == y.0) {
        let ends = run[0].0;
        let found = chains.find(ends[0], ends[1], &mut chain)?;
        if found {
            add_pieces(&mut out, run, &chain, true)?;
        } else if matches!(run, [(_, f), (_, g)] if may_merge(context, facets, *f, *g, false)) {
            add_pieces(&mut out, run, &ends, false)?;
        } else {
            fallible::push(&mut open, ends)?;
        }
    }
    for corners in overlaps::split_at_each_other(context, open)? {
        let ends = [corners[0], corners[corners.len() - 1]];
        let ends = [ends[0].min(ends[1]), ends[0].max(ends[1])];
        let from = edges.partition_point(|e| e.0 < ends);
        let to = edges.partition_point(|e| e.0 <= ends);
        for w in corners.windows(2) {
            let found = chains.find(w[0], w[1], &mut chain)?;
            add_pieces(&mut out, &edges[from..to], if found { &chain } else { w }, found)?;
        }
    }
    out.sort_unstable();
    Ok(out)
}

/// The pieces between consecutive vertices of `chain`, for every facet that has the edge.
fn add_pieces(
    out: &mut Vec<Piece>,
    run: &[([u32; 2], u32)],
    chain: &[u32],
    found: bool,
) -> Result<(), Error> {
    out.try_reserve(run.len() * chain.len())?;
    for &(_, facet) in run {
        let piece = |w: &[u32]| Piece { ends: [w[0].min(w[1]), w[0].max(w[1])], facet, found };
        fallible::extend(out, chain.windows(2).map(piece))?;
    }
    Ok(())
}

/// For each facet the group it belongs to, named by the smallest facet in it.
pub(super) fn groups(context: &Context, facets: &[Facet], pieces: &[Piece]) -> Result<Vec<u32>, Error> {
    let mut group: Vec<u32> = fallible::collect(0..facets.len() as u32)?;
    for run in pieces.chunk_by(|x, y| x.ends == y.ends) {
        for (i, p) in run.iter().enumerate() {
            for q in &run[i + 1..] {
                if p.facet != q.facet && may_merge(context, facets, p.facet, q.facet, p.found) {
                    let (a, b) = (root(&mut group, p.facet), root(&mut group, q.facet));
                    group[a.max(b) as usize] = a.min(b);
                }
            }
        }
    }
    for i in 0..group.len() as u32 {
        group[i as usize] = root(&mut group, i);
    }
    Ok(group)
}

/// The root of a tree of parents; halves the path on the way.
fn root(group: &mut [u32], mut i: u32) -> u32 {
    while group[i as usize] != i {
        let up = group[group[i as usize] as usize];
        group[i as usize] = up;
        i = up;
    }
    i
}

/// Whether two facets with a common piece of an edge belong to one group; `found` says whether the piece is an edge of the mesh.
fn may_merge(context: &Context, facets: &[Facet], f: u32, g: u32, found: bool) -> bool {
    let (f, g) = (&facets[f as usize], &facets[g as usize]);
    if f.marker != g.marker {
        return false;
    }
    match (f.plane, g.plane) {
        (Some([a, b, c]), Some(other)) if f.planar && g.planar => other
            .iter()
            .all(|&v| [a, b, c].contains(&v) || context.geometry.orient3d([a, b, c, v]) == Sign::Zero),
        _ => !found,
    }
}
