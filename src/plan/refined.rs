//! Refinement in mode cdt: from the exact mesh with its regions to the one that is rounded, and from that to the result.
use crate::blocks::{self, Crew};
use crate::control::Control;
use crate::error::Error;
use crate::facets::polygons::Retriangulated;
use crate::facets::subface::Subfaces;
use crate::fallible;
use crate::fill::{estimate, fill, Shape};
use crate::kernel::around::StarSearch;
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, face_key, Mesh, GHOST, NONE};
use crate::optimise::slide::{Slides, Track};
use crate::options::Options;
use crate::output::{Guarantee, SteinerPoint, TetMesh};
use crate::plan::assemble::{self, Origin};
use crate::plan::refine::{bounds, fills, given, mark_isolated, request, Input, Interior};
use crate::plan::slides::{slides, Facets};
use crate::plan::{Engine, Run};
use crate::plc::surface::Surface;
use crate::predicates::{scale, Points, Position};
use crate::preserve::carve;
use crate::preserve::inside::Inside;
use crate::progress::Phase;
use crate::refine::facet::{Frames, Wish, Wishes};
use crate::refine::{refine, Ball, Goal, Model, OnFacet, What};
use crate::rounding::Rounded;
use crate::segments::placement::Subsegment;
use crate::segments::recovery::Segments;
use crate::size::{distance, scaled, Bounds, Size};
use crate::INVALID;
use rustc_hash::FxHashSet;

/// How often the surface is kept in larger and larger balls round points without a valid position, before it is kept as a whole.
const MOST_WIDENED: u32 = 5;

/// Where the surface stays as recovery made it.
#[derive(Default)]
pub(super) struct Keeps {
    balls: Vec<Ball>,
    widened: u32,
}

impl Keeps {
    /// Whether it stays everywhere.
    fn all(&self) -> bool {
        self.widened > MOST_WIDENED
    }

    /// Keeps it round these vertices as well, in larger balls every time.
    pub fn widen(&mut self, engine: &Engine, crowded: &[u32]) -> Result<(), Error> {
        let mut search = StarSearch::default();
        for &v in crowded {
            search.vertex_star(&engine.mesh, v, engine.mesh.vertex_tet[v as usize])?;
            let centre = *engine.points.xyz(v);
            let around = search.tets.iter().flat_map(|&t| engine.mesh.verts(t)).filter(|&w| w != GHOST);
            let far = around.map(|w| distance(engine.points.xyz(w), &centre)).fold(0.0, f64::max);
            let radius = far * f64::from(1u32 << (2 * self.widened));
            fallible::push(&mut self.balls, Ball { centre, radius })?;
        }
        self.widened += 1;
        Ok(())
    }
}

/// How many units in the last place a point of a refined mesh may be from its exact position, so that the mesh is constrained Delaunay up to
/// rounding.
const MOST_UNITS: f64 = 4.0;

/// The vertices that have no valid position, or none that is near, and those of tetrahedra that replace others.
pub(super) fn tight(engine: &Engine, rounded: &Rounded, control: &Control) -> Result<Vec<u32>, Error> {
    let mut out = fallible::copied(&rounded.crowded)?;
    for (v, at) in (0..).zip(&rounded.xyz) {
        control.step()?;
        let exact = engine.points.xyz(v);
        let unit = |x: f64| x.abs().next_up() - x.abs();
        if (0..3).any(|k| (at[k] - exact[k]).abs() > MOST_UNITS * unit(exact[k])) {
            fallible::push(&mut out, v)?;
        }
    }
    for &t in rounded.replaced.iter().filter(|&&t| engine.mesh.is_live(t)) {
        fallible::extend(&mut out, engine.mesh.verts(t).into_iter().filter(|&v| v != GHOST))?;
    }
    out.sort_unstable();
    out.dedup();
    Ok(out)
}

/// What recovery has left besides the mesh.
pub(super) struct Recovery<'a> {
    pub segments: &'a mut Segments,
    pub polygons: &'a Retriangulated,
    pub subfaces: &'a Subfaces,
}

/// A subface around which everything was carved: it is not in the mesh, but its edges may be.
struct Unmeshed {
    corners: [u32; 3],
    facet: u32,
    /// The pieces of segments that are its edges: the edge opposite each corner.
    pieces: [Option<Subsegment>; 3],
}

/// What refinement has left besides the mesh.
pub(super) struct Refined {
    inside: Inside,
    /// Points on facets.
    on_facets: Vec<OnFacet>,
    /// Of the patches, if points may have come on facets.
    frames: Frames,
    wishes: Wishes,
    /// Edges on no wall that stay.
    isolated: FxHashSet<[u32; 2]>,
    bounds: Bounds,
    /// A facet of each patch.
    facet_of: Vec<u32>,
    /// Subfaces around which everything was carved.
    unmeshed: Vec<Unmeshed>,
    /// The surface was left as it was, and what is inside will be filled in doubles.
    plain: bool,
}

impl Refined {
    /// Whether refinement has put points on the surface, or inside, where rounding meets them.
    pub fn changes_rounding(&self, segments: &Segments, needed: u64) -> bool {
        !self.plain
            && (segments.steiner_t.len() as u64 > needed
                || !self.on_facets.is_empty()
                || !self.inside.list.is_empty())
    }
}

impl Run<'_> {
    /// Carves the domain and refines it, surface and all.
    pub(super) fn refine_surface(
        &mut self,
        options: &Options,
        engine: &mut Engine,
        recovery: Recovery,
        input: Input,
        keeps: &Keeps,
    ) -> Result<Refined, Error> {
        self.forget_refinement();
        let Recovery { segments, polygons, subfaces } = recovery;
        let control = self.control;
        let mut mesh = std::mem::take(&mut engine.mesh);
        carve(&mut mesh, engine.points.len(), subfaces, control)?;
        let mut refined = Refined {
            inside: Inside::default(),
            on_facets: Vec::new(),
            frames: Frames::default(),
            wishes: Wishes::default(),
            isolated: isolated(&mesh, segments, control)?,
            bounds: Bounds::default(),
            facet_of: facet_of(subfaces, control)?,
            unmeshed: unmeshed(&mesh, subfaces, segments, control)?,
            plain: keeps.all(),
        };
        if fills(options) && !refined.plain {
            let part = control.whole(Phase::Refine);
            part.progress(0.0)?;
            mark_pieces(&mut mesh, segments)?;
            refined.bounds = bounds(options, engine, input)?;
            let given = given(options, engine, input)?;
            let mut size =
                Size::new(&mesh, &engine.points, &refined.isolated, given, options.gradation, &part)?;
            let ratio = options.quality.unwrap_or(Options::USUAL_RATIO);
            estimate(&mesh, &engine.points, &size, &part)?;
            refined.frames = frames(engine, input.surface, polygons, control)?;
            refined.wishes = wishes(engine, input, subfaces, control)?;
            let (frames, wishes) = (&refined.frames, &refined.wishes);
            wishes.estimate(&mesh, &engine.points, &part)?;
            let Engine { points, .. } = engine;
            let inside = &mut refined.inside;
            let mut model = Model { mesh: &mut mesh, points, segments, inside, frames };
            let bounds = &refined.bounds;
            let mut goal = Goal { size: &mut size, ratio, bounds, wishes, kept: &keeps.balls };
            let counts = &mut self.statistics.refine;
            let walls = refine(&mut model, &mut goal, What::Walls, part.part(0.0, 0.2))?;
            counts.add(&walls.counts);
            refined.on_facets = walls.on_facets;
            let added = model.points.len() - model.segments.first_steiner as usize;
            model.inside.elsewhere = (added - model.inside.list.len()) as u64;
            let shape = Shape { ratio, delaunay: true };
            let whole = blocks::Model { mesh: model.mesh, points: model.points, inside: model.inside };
            let crew = Crew { threads: options.worker_threads(), part: part.part(0.2, 0.6) };
            counts.add(&fill(whole, goal.size, shape, crew)?);
            let more = refine(&mut model, &mut goal, What::Tetrahedra, part.part(0.6, 1.0))?;
            counts.add(&more.counts);
            fallible::append(&mut refined.on_facets, &more.on_facets)?;
            let count = engine.points.len() - segments.first_steiner as usize;
            fallible::resize(&mut segments.steiner_segment, count, NONE)?;
            fallible::resize(&mut segments.steiner_t, count, 0.0)?;
            self.lap(Phase::Refine);
        }
        engine.mesh = mesh;
        Ok(refined)
    }

    /// Puts all points at their doubles, optimises, and makes the result.
    pub(super) fn finish(
        &mut self,
        options: &Options,
        engine: &mut Engine,
        origin: Origin,
        rounded: &Rounded,
        refined: &mut Refined,
    ) -> Result<TetMesh, Error> {
        let control = self.control;
        let mut steiner = steiner(engine, origin, rounded, refined, control)?;
        let mut replaced = fallible::copied(&rounded.replaced)?;
        let changes = request(options).is_some() || fills(options) && refined.plain;
        let mut mesh = std::mem::take(&mut engine.mesh);
        // Points that slide keep their order along a segment.
        let unmeshed = split_unmeshed(&refined.unmeshed, origin.segments, control)?;
        if changes {
            let Refined { on_facets, frames, wishes, .. } = &*refined;
            let mut slides = match request(options) {
                Some(_) => slides(engine, origin.segments, Facets { on_facets, frames, wishes }, control)?,
                None => None,
            };
            for v in origin.segments.first_steiner..engine.points.len() as u32 {
                control.step()?;
                let at = rounded.xyz[v as usize];
                if !engine.points.is_explicit(v) || *engine.points.xyz(v) != at {
                    engine.points.settle(v, at)?;
                }
            }
            // Refinement has split some of them.
            refined.isolated = isolated(&mesh, origin.segments, control)?;
            mark_isolated(&mut mesh, &refined.isolated)?;
            let Refined { inside, isolated, .. } = refined;
            inside.elsewhere = steiner.len() as u64;
            let interior = Interior { mesh: &mut mesh, inside, isolated, slides: slides.as_mut() };
            let input = Input { plc: origin.plc, surface: origin.surface, regions: origin.regions };
            // Where subsegments that may not be split are in the way, a constrained Delaunay mesh has no room for points; this one has.
            self.fill_and_optimise(options, engine, interior, input)?;
            replaced.clear();
            if let Some(slides) = &slides {
                record(engine, slides, &mut steiner, control)?;
            }
        }
        let parts = assemble::Parts {
            steiner: &steiner,
            inside: &refined.inside.list,
            replaced: &replaced,
            crowded: &rounded.crowded,
            facet_of: &refined.facet_of,
            unmeshed: &unmeshed,
            xyz: if changes { engine.points.coordinates() } else { &rounded.xyz },
        };
        let mut out = assemble::refined(engine, origin, &mesh, parts, control)?;
        if changes {
            out.guarantee = Guarantee::Conforming;
        }
        Ok(out)
    }
}

/// The frames of all patches; those of polygons with triangles of their own have none, since their corners need not be input points.
fn frames(
    engine: &Engine,
    surface: &Surface,
    polygons: &Retriangulated,
    control: &Control,
) -> Result<Frames, Error> {
    let corners = engine.map(&surface.triangles)?;
    let stays = |&(t, _): &(usize, _)| !polygons.has(surface.triangle_facet[t]);
    let own = corners.iter().copied().zip(surface.triangle_patch.iter().copied()).enumerate();
    let own = own.filter(stays).map(|x| x.1);
    let explicit = |corners: &[u32; 3]| corners.iter().all(|&v| engine.points.is_explicit(v));
    let single = polygons.corners.iter().copied().zip(surface.patch_count..);
    let single = single.filter(|(corners, _)| explicit(corners));
    Frames::new(&engine.points, own.chain(single), control)
}

/// What is wanted on the facets of each patch.
fn wishes(engine: &Engine, input: Input, subfaces: &Subfaces, control: &Control) -> Result<Wishes, Error> {
    let (mut out, sizes) = (Wishes::default(), &input.plc.sizes);
    if !sizes.on_facets() {
        return Ok(out);
    }
    for (&patch, &facet) in subfaces.patch.iter().zip(&subfaces.facet) {
        control.step()?;
        let marker = input.plc.facet_marker(facet as usize);
        if let Some(edge) = sizes.edge_of_facet(marker) {
            let area =
                sizes.area_of_facet(marker).map_or(f64::INFINITY, |area| scaled(area, 2 * engine.scale));
            out.lower(patch, Wish { length: scaled(edge, engine.scale), area })?;
        }
    }
    Ok(out)
}

/// Marks the pieces of segments as subsegments.
fn mark_pieces(mesh: &mut Mesh, segments: &Segments) -> Result<(), Error> {
    mesh.mark_subsegments(|v| {
        let bit = |(e, &[i, j]): (usize, &[u8; 2])| {
            u16::from(segments.piece_of.contains_key(&edge_key(v[i as usize], v[j as usize]))) << e
        };
        Ok(EDGE.iter().enumerate().map(bit).fold(0, |all, bit| all | bit))
    })
}

/// The pieces of segments that are edges of no wall.
fn isolated(mesh: &Mesh, segments: &Segments, control: &Control) -> Result<FxHashSet<[u32; 2]>, Error> {
    let mut out = FxHashSet::default();
    out.try_reserve(segments.pieces.len())?;
    for piece in &segments.pieces {
        control.step()?;
        fallible::add(&mut out, edge_key(piece.ends[0], piece.ends[1]))?;
    }
    for t in mesh.all().filter(|&t| mesh.is_live(t)) {
        control.step()?;
        for code in (4 * t..4 * t + 4).filter(|&code| mesh.is_wall(code)) {
            let [a, b, c] = mesh.face(code);
            for [a, b] in [[a, b], [b, c], [c, a]] {
                out.remove(&edge_key(a, b));
            }
        }
    }
    let used = |v: u32| mesh.vertex_tet.get(v as usize).is_some_and(|&t| t != NONE);
    out.retain(|&[a, b]| used(a) && used(b));
    Ok(out)
}

/// A facet of each patch.
fn facet_of(subfaces: &Subfaces, control: &Control) -> Result<Vec<u32>, Error> {
    let mut out = Vec::new();
    for (&patch, &facet) in subfaces.patch.iter().zip(&subfaces.facet) {
        control.step()?;
        if out.len() <= patch as usize {
            fallible::resize(&mut out, patch as usize + 1, INVALID)?;
        }
        out[patch as usize] = facet.min(out[patch as usize]);
    }
    Ok(out)
}

/// The subfaces that are not in the carved mesh.
fn unmeshed(
    mesh: &Mesh,
    subfaces: &Subfaces,
    segments: &Segments,
    control: &Control,
) -> Result<Vec<Unmeshed>, Error> {
    let mut there: FxHashSet<[u32; 3]> = FxHashSet::default();
    there.try_reserve(subfaces.verts.len())?;
    for code in mesh.subfaces() {
        control.step()?;
        fallible::add(&mut there, face_key(mesh.face(code)))?;
    }
    let mut out = Vec::new();
    for (&corners, &facet) in subfaces.verts.iter().zip(&subfaces.facet) {
        control.step()?;
        if !there.contains(&face_key(corners)) {
            let piece = |k: usize| {
                let key = edge_key(corners[(k + 1) % 3], corners[(k + 2) % 3]);
                segments.piece_of.get(&key).map(|&piece| segments.pieces[piece as usize])
            };
            fallible::push(&mut out, Unmeshed { corners, facet, pieces: [0, 1, 2].map(piece) })?;
        }
    }
    Ok(out)
}

/// The same as triangles, split at the points that have come on their edges.
fn split_unmeshed(
    unmeshed: &[Unmeshed],
    segments: &Segments,
    control: &Control,
) -> Result<Vec<([u32; 3], u32)>, Error> {
    let mut out = Vec::new();
    if unmeshed.is_empty() {
        return Ok(out);
    }
    let steiner = segments.steiner_by_segment(control)?;
    for face in unmeshed {
        control.step()?;
        let from = out.len();
        fallible::push(&mut out, (face.corners, face.facet))?;
        for (k, piece) in face.pieces.iter().enumerate() {
            let Some(piece) = piece else { continue };
            let [a, b] = [(k + 1) % 3, (k + 2) % 3].map(|i| face.corners[i]);
            let first = steiner.partition_point(|x| x.0 < piece.segment);
            let on_segment = steiner[first..].iter().take_while(|x| x.0 == piece.segment);
            let between = on_segment.filter(|x| x.1 > piece.t[0] && x.1 < piece.t[1]).map(|x| x.2);
            let mut chain = Vec::new();
            for v in between {
                fallible::push(&mut chain, v)?;
            }
            if piece.ends[0] != a {
                chain.reverse();
            }
            // The triangle with the rest of the edge is cut at each point in turn.
            let mut start = a;
            for v in chain.into_iter().filter(|&v| v != a && v != b) {
                let at = (from..out.len()).find(|&i| out[i].0.contains(&start) && out[i].0.contains(&b));
                let Some(at) = at else { break };
                let (corners, facet) = out[at];
                out[at].0 = corners.map(|w| if w == b { v } else { w });
                fallible::push(&mut out, (corners.map(|w| if w == start { v } else { w }), facet))?;
                start = v;
            }
        }
    }
    Ok(out)
}

/// The points on segments and facets, by vertex, ascending; and where they lie.
fn steiner(
    engine: &Engine,
    origin: Origin,
    rounded: &Rounded,
    refined: &Refined,
    control: &Control,
) -> Result<Vec<(u32, SteinerPoint)>, Error> {
    let Origin { surface, segments, .. } = origin;
    let input = |v: u32| engine.input_of[v as usize];
    let is_exact = |v: u32| is_exact(&engine.points, v, &rounded.xyz[v as usize], engine.scale);
    let mut out = fallible::reserved(segments.steiner_t.len())?;
    for (v, (&s, &t)) in
        (segments.first_steiner..).zip(segments.steiner_segment.iter().zip(&segments.steiner_t))
    {
        control.step()?;
        if s != NONE {
            let ends = segments.ends[s as usize].map(input);
            let segment = surface.segment_parent[s as usize];
            let point = SteinerPoint { ends, t, segment, exact: is_exact(v), ..SteinerPoint::INSIDE };
            fallible::push(&mut out, (v, point))?;
        }
    }
    for &OnFacet { v, patch } in &refined.on_facets {
        control.step()?;
        let point = SteinerPoint { exact: is_exact(v), ..on_facet(&engine.points, v, input) };
        let facet = refined.facet_of.get(patch as usize).copied().unwrap_or(INVALID);
        fallible::push(&mut out, (v, SteinerPoint { facet, ..point }))?;
    }
    control.sort_by(&mut out, |x, y| x.0.cmp(&y.0))?;
    Ok(out)
}

/// Whether a point that comes back at these doubles is there exactly.
fn is_exact(points: &Points, v: u32, at: &[f64; 3], exponent: i32) -> bool {
    // Scaling back may lose bits of subnormal coordinates.
    let returned = at.map(|x| scale(scale(x, -exponent), exponent)) == *at;
    points.is_explicit(v) && at == points.xyz(v) && returned
}

/// Where the points on segments and facets that have slid lie now.
fn record(
    engine: &Engine,
    slides: &Slides,
    steiner: &mut [(u32, SteinerPoint)],
    control: &Control,
) -> Result<(), Error> {
    let input = |v: u32| engine.input_of[v as usize];
    for (v, point) in steiner {
        control.step()?;
        let Some(slider) = slides.of(*v).filter(|slider| slider.moved) else { continue };
        let exact = is_exact(slides.exact(), *v, engine.points.xyz(*v), engine.scale);
        *point = match slider.track {
            Track::Segment { t, .. } => SteinerPoint { t, exact, ..*point },
            Track::Facet { .. } => {
                SteinerPoint { facet: point.facet, exact, ..on_facet(slides.exact(), *v, input) }
            }
        };
    }
    Ok(())
}

/// The position of a point on a facet.
fn on_facet(points: &Points, v: u32, input: impl Fn(u32) -> u32) -> SteinerPoint {
    match *points.position(v) {
        Position::OnFacet { o, a, b, u, v } => {
            SteinerPoint { ends: [o, a].map(&input), third: input(b), t: u, u: v, ..SteinerPoint::INSIDE }
        }
        _ => SteinerPoint::INSIDE,
    }
}
