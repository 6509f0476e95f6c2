//! From the engine's arrays to the output: what stays, renumbered, in the caller's coordinates.
use crate::control::Control;
use crate::domain::Domain;
use crate::error::Error;
use crate::facets::subface::Subfaces;
use crate::fallible;
use crate::kernel::{edge_key, face_key};
use crate::kernel::{Mesh, NONE};
use crate::output::{Guarantee, Lift, Region, SteinerPoint, SteinerTerm, Subface, Subsegment, TetMesh};
use crate::plan::Engine;
use crate::plc::surface::Surface;
use crate::plc::Plc;
use crate::predicates::{scale, Expansion};
use crate::preserve::Freed;
use crate::rounding::Rounded;
use crate::segments::recovery::Segments;
use crate::INVALID;
use rustc_hash::FxHashMap;

/// What the output holds of a tetrahedron: corners, neighbours and region.
const BYTES_PER_TET: usize = size_of::<[u32; 9]>();

/// What the mesh of a surface comes from.
#[derive(Clone, Copy)]
pub(super) struct Origin<'a> {
    pub(super) plc: &'a Plc,
    pub(super) surface: &'a Surface,
    pub(super) segments: &'a Segments,
    pub(super) regions: &'a Domain,
}

/// The output mesh.
pub(super) fn mesh(
    engine: &Engine,
    origin: Origin,
    subfaces: &Subfaces,
    rounded: &Rounded,
    control: &Control,
) -> Result<TetMesh, Error> {
    let Origin { plc, surface, segments, .. } = origin;
    let mut out = without_elements(origin)?;
    let steiner_count = engine.points.len() - engine.input_of.len();
    out.points.try_reserve(plc.points.len() + steiner_count)?;
    fallible::append(&mut out.points, &plc.points)?;
    for p in &rounded.xyz[engine.input_of.len()..engine.points.len()] {
        fallible::push(&mut out.points, p.map(|x| scale(x, -engine.scale)))?;
    }
    let point_of = |v: u32| match engine.input_of.get(v as usize) {
        Some(&input) => input,
        None => (plc.points.len() + v as usize - engine.input_of.len()) as u32,
    };
    fallible::extend(&mut out.crowded, rounded.crowded.iter().map(|&v| point_of(v)))?;
    let number = tets(&engine.mesh, &mut out, point_of, control)?;
    fallible::extend(&mut out.replaced, rounded.replaced.iter().map(|&t| number[t as usize]))?;
    out.replaced.sort_unstable();
    steiner(engine, segments, surface, rounded, &mut out, point_of, control)?;
    subsegments(plc, surface, segments, &mut out, point_of, control)?;
    let list = subfaces.verts.iter().copied().zip(subfaces.facet.iter().copied());
    faces(&engine.mesh, plc, list, &number, &mut out, point_of, control)?;
    Ok(out)
}

/// What does not depend on the tetrahedra.
fn without_elements(origin: Origin) -> Result<TetMesh, Error> {
    let Origin { plc, surface, regions, .. } = origin;
    Ok(TetMesh {
        input_point_count: plc.points.len() as u32,
        point_alias: fallible::copied(&surface.alias)?,
        regions: fallible::copied(&regions.regions)?,
        facet_flips: fallible::copied(&surface.facet_flips)?,
        ..TetMesh::default()
    })
}

/// The output mesh of a domain without points on its surface, or on its outer boundary.
pub(super) fn preserved(
    engine: &Engine,
    origin: Origin,
    mesh: &Mesh,
    freed: &Freed,
    control: &Control,
) -> Result<TetMesh, Error> {
    let Origin { plc, surface, segments, .. } = origin;
    let mut out = TetMesh { preserved: true, ..without_elements(origin)? };
    let mut number_of: Vec<u32> = fallible::reserved(engine.points.len())?;
    fallible::append(&mut number_of, &engine.input_of)?;
    fallible::resize(&mut number_of, engine.points.len(), INVALID)?;
    let inside = &freed.inside.list;
    out.points.try_reserve(plc.points.len() + freed.settled.len() + inside.len())?;
    fallible::append(&mut out.points, &plc.points)?;
    for v in freed.settled.iter().map(|point| point.v).chain(inside.iter().copied()) {
        number_of[v as usize] = out.points.len() as u32;
        fallible::push(&mut out.points, engine.points.xyz(v).map(|x| scale(x, -engine.scale)))?;
    }
    out.steiner.try_reserve(freed.settled.len() + inside.len())?;
    settled(engine, freed, segments, surface, &mut out, control)?;
    fallible::extend(&mut out.steiner, inside.iter().map(|_| SteinerPoint::INSIDE))?;
    let number = tets(mesh, &mut out, |v| number_of[v as usize], control)?;
    let chains = chains(engine, freed, segments, surface, control)?;
    let mut chains = chains.into_iter().peekable();
    for (s, (&ends, &segment)) in surface.segments.iter().zip(&surface.segment_parent).enumerate() {
        let marker = plc.segments.get(segment as usize).map_or(0, |s| s.marker);
        let mut from = ends[0];
        while let Some((_, v)) = chains.next_if(|x| x.0 == s) {
            let to = number_of[v as usize];
            fallible::push(&mut out.subsegments, Subsegment { ends: [from, to], segment, marker })?;
            from = to;
        }
        fallible::push(&mut out.subsegments, Subsegment { ends: [from, ends[1]], segment, marker })?;
    }
    faces(mesh, plc, freed.subfaces.iter().copied(), &number, &mut out, |v| number_of[v as usize], control)?;
    Ok(out)
}

/// What the output of a refined mesh is made from, besides the mesh.
#[derive(Clone, Copy)]
pub(super) struct Parts<'a> {
    /// The points on segments and facets, by vertex, ascending.
    pub steiner: &'a [(u32, SteinerPoint)],
    /// The points inside.
    pub inside: &'a [u32],
    /// Slots of tetrahedra that replace others.
    pub replaced: &'a [u32],
    /// Vertices without a valid position.
    pub crowded: &'a [u32],
    /// A facet of each patch.
    pub facet_of: &'a [u32],
    /// Subfaces around which everything was carved, and their facets.
    pub unmeshed: &'a [([u32; 3], u32)],
    /// Positions in doubles.
    pub xyz: &'a [[f64; 3]],
}

/// The output mesh of a carved domain whose surface may have been refined: input points, points on the surface, points inside.
pub(super) fn refined(
    engine: &Engine,
    origin: Origin,
    mesh: &Mesh,
    parts: Parts,
    control: &Control,
) -> Result<TetMesh, Error> {
    let Origin { plc, surface, segments, .. } = origin;
    let mut out = without_elements(origin)?;
    let mut number_of: Vec<u32> = fallible::reserved(parts.xyz.len())?;
    fallible::append(&mut number_of, &engine.input_of)?;
    fallible::resize(&mut number_of, parts.xyz.len(), INVALID)?;
    let count = parts.steiner.len() + parts.inside.len();
    out.points.try_reserve(plc.points.len() + count)?;
    fallible::append(&mut out.points, &plc.points)?;
    for v in parts.steiner.iter().map(|x| x.0).chain(parts.inside.iter().copied()) {
        number_of[v as usize] = out.points.len() as u32;
        fallible::push(&mut out.points, parts.xyz[v as usize].map(|x| scale(x, -engine.scale)))?;
    }
    let point_of = |v: u32| number_of[v as usize];
    out.steiner.try_reserve(count)?;
    for (i, (v, point)) in parts.steiner.iter().enumerate() {
        control.step()?;
        fallible::push(&mut out.steiner, *point)?;
        if let Some(exact) = segments.fine.get(&(v - segments.first_steiner)) {
            push_terms(exact, point.t, i as u32, &mut out)?;
        }
    }
    fallible::resize(&mut out.steiner, count, SteinerPoint::INSIDE)?;
    fallible::extend(&mut out.crowded, parts.crowded.iter().map(|&v| point_of(v)))?;
    let number = tets(mesh, &mut out, point_of, control)?;
    fallible::extend(&mut out.replaced, parts.replaced.iter().map(|&t| number[t as usize]))?;
    out.replaced.sort_unstable();
    subsegments(plc, surface, segments, &mut out, point_of, control)?;
    let mut list = fallible::reserved(parts.unmeshed.len())?;
    for code in mesh.subfaces() {
        control.step()?;
        let facet = parts.facet_of.get(mesh.subface(code) as usize).copied();
        let facet = facet.ok_or_else(|| Error::internal("a subface has no facet"))?;
        fallible::push(&mut list, (mesh.face(code), facet))?;
    }
    faces(mesh, plc, list.into_iter(), &number, &mut out, point_of, control)?;
    for &(corners, facet) in parts.unmeshed {
        let marker = plc.facet_marker(facet as usize);
        let corners = corners.map(point_of);
        fallible::push(&mut out.unmeshed_subfaces, Subface { corners, facet, marker, tets: [INVALID; 2] })?;
    }
    Ok(out)
}

/// The surface's segment that a Steiner point lies on, in the order of both, and whether its ends are reversed.
fn segment_of(
    engine: &Engine,
    segments: &Segments,
    surface: &Surface,
    segment: u32,
) -> Option<(usize, bool)> {
    let [a, b] = segments.ends[segment as usize].map(|v| engine.input_of[v as usize]);
    let found = surface.segments.binary_search(&edge_key(a, b)).ok()?;
    Some((found, surface.segments[found] != [a, b]))
}

/// Steiner points that stay on internal segments: their parents.
fn settled(
    engine: &Engine,
    freed: &Freed,
    segments: &Segments,
    surface: &Surface,
    out: &mut TetMesh,
    control: &Control,
) -> Result<(), Error> {
    for (i, point) in freed.settled.iter().enumerate() {
        control.step()?;
        let index = point.v - segments.first_steiner;
        let (s, t) = (segments.steiner_segment[index as usize], segments.steiner_t[index as usize]);
        let at = *engine.points.xyz(point.v);
        // Scaling back may lose bits of subnormal coordinates.
        let returned = at.map(|x| scale(scale(x, -engine.scale), engine.scale)) == at;
        let parent = segment_of(engine, segments, surface, s);
        fallible::push(
            &mut out.steiner,
            SteinerPoint {
                ends: segments.ends[s as usize].map(|v| engine.input_of[v as usize]),
                t,
                segment: parent.map_or(INVALID, |(found, _)| surface.segment_parent[found]),
                exact: point.exact && returned,
                ..SteinerPoint::INSIDE
            },
        )?;
        let Some(exact) = segments.fine.get(&index) else { continue };
        push_terms(exact, t, i as u32, out)?;
    }
    Ok(())
}

/// The terms of a Steiner point's parameter beyond its double.
fn push_terms(exact: &Expansion, t: f64, steiner: u32, out: &mut TetMesh) -> Result<(), Error> {
    let rest = exact.difference(&Expansion::from(t)).compressed();
    out.steiner_terms.try_reserve(rest.components().len())?;
    let term = |&value: &f64| SteinerTerm { steiner, value };
    fallible::extend(&mut out.steiner_terms, rest.components().iter().rev().map(term))?;
    Ok(())
}

/// The points that stay on each segment of the surface, from its first end to its second.
fn chains(
    engine: &Engine,
    freed: &Freed,
    segments: &Segments,
    surface: &Surface,
    control: &Control,
) -> Result<Vec<(usize, u32)>, Error> {
    let mut chains = Vec::new();
    if freed.settled.is_empty() {
        return Ok(chains);
    }
    chains.try_reserve(freed.settled.len())?;
    let list = segments.steiner_by_segment(control)?;
    for run in list.chunk_by(|x, y| x.0 == y.0) {
        control.step()?;
        let Some((s, turned)) = segment_of(engine, segments, surface, run[0].0) else { continue };
        let from = chains.len();
        let stays = |v: &u32| freed.settled.binary_search_by_key(v, |point| point.v).is_ok();
        fallible::extend(&mut chains, run.iter().map(|x| x.2).filter(stays).map(|v| (s, v)))?;
        if turned {
            chains[from..].reverse();
        }
    }
    fallible::stable_sort_by(&mut chains, |x, y| x.0.cmp(&y.0))?;
    Ok(chains)
}

/// Which of the input points count, and with which weights.
pub(super) struct Weighted {
    /// For each input point the first equal one.
    pub(super) alias: Vec<u32>,
    pub(super) lift: Lift,
}

/// The output mesh of all tetrahedra of the convex hull, made in the engine's own arrays: they are most of the memory.
pub(super) fn delaunay(
    engine: Engine,
    plc: &Plc,
    Weighted { alias, lift }: Weighted,
    control: &Control,
) -> Result<TetMesh, Error> {
    // Destructured by name, since fields left in the struct would live until the end.
    let Engine { points, mesh, inserter, input_of, rounds: _, engine_of, scale: _ } = engine;
    drop((points, engine_of, inserter));
    let stays = |mesh: &Mesh, t| mesh.is_live(t) && !mesh.is_ghost(t);
    let [tets, neighbors] = mesh.into_arrays(stays, |v| input_of[v as usize], control)?;
    drop(input_of);
    let mut out = TetMesh {
        input_point_count: plc.points.len() as u32,
        point_alias: alias,
        regions: fallible::collect([Region { attribute: 1.0, seed: INVALID, max_volume: None }])?,
        tets,
        neighbors,
        hull_kept: true,
        guarantee: if lift.is_plain() { Guarantee::Delaunay } else { Guarantee::WeightedDelaunay },
        lift,
        ..TetMesh::default()
    };
    out.points.try_reserve_exact(plc.points.len())?;
    fallible::append(&mut out.points, &plc.points)?;
    out.tet_region.try_reserve_exact(out.tets.len())?;
    fallible::resize(&mut out.tet_region, out.tets.len(), 0)?;
    Ok(out)
}

/// Tetrahedra that stay, their neighbours and regions; returns the new number of each slot.
pub(super) fn tets(
    mesh: &Mesh,
    out: &mut TetMesh,
    point_of: impl Fn(u32) -> u32,
    control: &Control,
) -> Result<Vec<u32>, Error> {
    let mut number = fallible::reserved(mesh.slot_count())?;
    let mut count = 0;
    for t in mesh.all() {
        let stays = mesh.is_live(t) && mesh.region(t) != NONE;
        fallible::push(&mut number, if stays { count } else { INVALID })?;
        count += u32::from(stays);
    }
    control.room(count as usize * BYTES_PER_TET)?;
    out.tets.try_reserve(count as usize)?;
    out.neighbors.try_reserve(count as usize)?;
    out.tet_region.try_reserve(count as usize)?;
    for t in mesh.all().filter(|&t| number[t as usize] != INVALID) {
        control.step()?;
        fallible::push(&mut out.tets, mesh.verts(t).map(&point_of))?;
        fallible::push(&mut out.neighbors, mesh.adj(t).map(|code| number[(code >> 2) as usize]))?;
        fallible::push(&mut out.tet_region, mesh.region(t))?;
    }
    Ok(number)
}

fn steiner(
    engine: &Engine,
    segments: &Segments,
    surface: &Surface,
    rounded: &Rounded,
    out: &mut TetMesh,
    point_of: impl Fn(u32) -> u32,
    control: &Control,
) -> Result<(), Error> {
    out.steiner.try_reserve(segments.steiner_t.len())?;
    for (i, (&s, &t)) in segments.steiner_segment.iter().zip(&segments.steiner_t).enumerate() {
        control.step()?;
        let v = segments.first_steiner + i as u32;
        let exact = engine.points.is_explicit(v) && rounded.xyz[v as usize] == *engine.points.xyz(v);
        // Scaling back may lose bits of subnormal coordinates.
        let returned =
            out.points[point_of(v) as usize].map(|x| scale(x, engine.scale)) == rounded.xyz[v as usize];
        fallible::push(
            &mut out.steiner,
            SteinerPoint {
                ends: segments.ends[s as usize].map(&point_of),
                t,
                segment: surface.segment_parent[s as usize],
                exact: exact && returned,
                ..SteinerPoint::INSIDE
            },
        )?;
        let Some(exact) = segments.fine.get(&(i as u32)) else { continue };
        push_terms(exact, t, i as u32, out)?;
    }
    Ok(())
}

fn subsegments(
    plc: &Plc,
    surface: &Surface,
    segments: &Segments,
    out: &mut TetMesh,
    point_of: impl Fn(u32) -> u32,
    control: &Control,
) -> Result<(), Error> {
    out.subsegments.try_reserve(segments.pieces.len())?;
    let mut pieces = fallible::collect(segments.pieces.iter())?;
    control.sort_by(&mut pieces, |x, y| {
        let order = || segments.order(x.segment, [x.ends[0], y.ends[0]], [x.t[0], y.t[0]]);
        x.segment.cmp(&y.segment).then_with(order)
    })?;
    for piece in pieces {
        control.step()?;
        let segment = surface.segment_parent[piece.segment as usize];
        let marker = plc.segments.get(segment as usize).map_or(0, |s| s.marker);
        fallible::push(
            &mut out.subsegments,
            Subsegment { ends: piece.ends.map(&point_of), segment, marker },
        )?;
    }
    Ok(())
}

/// Subfaces with the tetrahedra on both sides.
fn faces(
    mesh: &Mesh,
    plc: &Plc,
    subfaces: impl ExactSizeIterator<Item = ([u32; 3], u32)>,
    number: &[u32],
    out: &mut TetMesh,
    point_of: impl Fn(u32) -> u32,
    control: &Control,
) -> Result<(), Error> {
    let mut code_of: FxHashMap<[u32; 3], u32> = FxHashMap::default();
    code_of.try_reserve(subfaces.len())?;
    for t in mesh.all().filter(|&t| mesh.is_live(t)) {
        control.step()?;
        // One side is enough.
        for code in (4 * t..4 * t + 4).filter(|&code| mesh.is_subface(code) && code < mesh.across(code)) {
            fallible::insert(&mut code_of, face_key(mesh.face(code)), code)?;
        }
    }
    out.subfaces.try_reserve(subfaces.len())?;
    for (corners, facet) in subfaces {
        control.step()?;
        let marker = plc.facet_marker(facet as usize);
        let Some(&code) = code_of.get(&face_key(corners)) else {
            // Everything around it was carved, and is no longer even in the mesh.
            if !out.preserved {
                return Err(Error::internal("a subface is no face of the mesh"));
            }
            let corners = corners.map(&point_of);
            fallible::push(
                &mut out.unmeshed_subfaces,
                Subface { corners, facet, marker, tets: [INVALID; 2] },
            )?;
            continue;
        };
        // (apex, x, y, z) is positive, so (x, y, z, apex) is not: the normal of (x, y, z) points away from the apex.
        let found = mesh.face(code);
        let same = (0..3).any(|k| found[0] == corners[k] && found[1] == corners[(k + 1) % 3]);
        let (behind, ahead) = if same { (code, mesh.across(code)) } else { (mesh.across(code), code) };
        let mut corners = corners.map(&point_of);
        let mut tets = [number[(behind >> 2) as usize], number[(ahead >> 2) as usize]];
        // The lower region first, INVALID last: on the boundary normals point outward.
        let rank = |t: u32| (out.tet_region.get(t as usize).copied().unwrap_or(INVALID), t);
        if rank(tets[0]) > rank(tets[1]) {
            tets.swap(0, 1);
            corners.swap(1, 2);
        }
        let subface = Subface { corners, facet, marker, tets };
        if tets == [INVALID; 2] {
            fallible::push(&mut out.unmeshed_subfaces, subface)?;
        } else {
            fallible::push(&mut out.subfaces, subface)?;
        }
    }
    Ok(())
}
