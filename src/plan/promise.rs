//! What mode preserve promises for a carved domain, recorded before anything is removed from its surface.
use crate::check::Promise;
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::edge_key;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::options::Preserve;
use crate::plan::Engine;
use crate::plc::surface::Surface;
use crate::preserve::internal::Internal;
use crate::segments::recovery::Segments;
use crate::INVALID;

/// The triangles, polygons and segments that are in the domain; with [`Preserve::Outer`] those of the outer boundary. `patch` has
/// the patch of each triangle.
pub(super) fn promise(
    engine: &Engine,
    surface: &Surface,
    patch: &[u32],
    mesh: &Mesh,
    segments: &Segments,
    preserve: Preserve,
    control: &Control,
) -> Result<Promise, Error> {
    let internal = Internal::find(preserve, mesh, segments, control)?;
    // Whether a patch is in the domain and must be kept.
    let in_mesh = || mesh.subfaces().map(|code| mesh.subface(code));
    let patches = patch.iter().copied().chain(in_mesh());
    let mut kept = fallible::filled(false, patches.max().map_or(0, |last| last as usize + 1))?;
    for patch in in_mesh().filter(|patch| !internal.patches.contains(patch)) {
        kept[patch as usize] = true;
    }
    let mut promise = Promise::default();
    promise.triangles.try_reserve(surface.triangles.len())?;
    let mut edges: Vec<([u32; 2], u32)> = Vec::new();
    let mut polygons: Vec<u32> = Vec::new();
    for ((&corners, &facet), &patch) in surface.triangles.iter().zip(&surface.triangle_facet).zip(patch) {
        control.step()?;
        if !kept[patch as usize] {
            continue;
        }
        if facet < surface.first_polygon {
            fallible::push(&mut promise.triangles, (corners, facet))?;
            continue;
        }
        let [a, b, c] = corners;
        fallible::extend(
            &mut edges,
            [edge_key(a, b), edge_key(b, c), edge_key(c, a)].map(|edge| (edge, facet)),
        )?;
        fallible::push(&mut polygons, facet)?;
    }
    control.sort(&mut edges)?;
    control.sort(&mut polygons)?;
    for run in edges.chunk_by(|x, y| x.0 == y.0) {
        if !matches!(run, [(_, f), (_, g)] if f == g) {
            fallible::push(&mut promise.polygon_edges, run[0])?;
        }
    }
    for run in polygons.chunk_by(|x, y| x == y) {
        fallible::push(&mut promise.polygons, (run[0], run.len() as u32))?;
    }
    if preserve == Preserve::All {
        promise.segments = whole_segments(engine, surface, mesh, segments, control)?;
    }
    Ok(promise)
}

/// Segments of the input whose pieces are all in the domain.
fn whole_segments(
    engine: &Engine,
    surface: &Surface,
    mesh: &Mesh,
    segments: &Segments,
    control: &Control,
) -> Result<Vec<([u32; 2], u32)>, Error> {
    let mut whole: Vec<([u32; 2], u32)> = Vec::new();
    if surface.segment_parent.iter().all(|&parent| parent == INVALID) {
        return Ok(whole);
    }
    // Per segment its ends in the input and its parent, or that it has none.
    control.look()?;
    let mut known: Vec<Option<([u32; 2], u32)>> = fallible::collect(segments.ends.iter().map(|ends| {
        let [a, b] = ends.map(|v| engine.input_of[v as usize]);
        let found = surface.segments.binary_search(&edge_key(a, b)).ok()?;
        let parent = surface.segment_parent[found];
        (parent != INVALID).then_some(([a, b], parent))
    }))?;
    let mut search = StarSearch::default();
    for piece in &segments.pieces {
        control.step()?;
        let known = &mut known[piece.segment as usize];
        if known.is_none() {
            continue;
        }
        let [a, b] = piece.ends;
        let start = mesh.vertex_tet[a as usize];
        if start == NONE || search.find_edge(mesh, a, b, start)?.is_none() {
            *known = None;
        }
        control.worked(search.tets.len());
    }
    whole.try_reserve(known.len())?;
    fallible::extend(&mut whole, known.into_iter().flatten())?;
    Ok(whole)
}
