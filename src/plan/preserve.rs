//! The pipeline of [`Mode::Preserve`](crate::Mode::Preserve).
//!
//! First by reconnection: edges and faces of the surface are recovered in the Delaunay tetrahedralization without a point, or with few
//! points on the edges that resist ([`recover`](crate::preserve::recover::edges)). If that is given up, and if the hull is kept or facets are
//! merged, the start is the constrained Delaunay tetrahedralization, which always exists. Either way points on the surface are removed
//! again ([`from_constrained`]).
use crate::control::Control;
use crate::elementary::{exponent_above, power_of_two};
use crate::error::Error;
use crate::facets::recovery::FacetRecovery;
use crate::facets::subface::{Subfaces, Triangles};
use crate::fallible;
use crate::kernel::edge_key;
use crate::options::{Options, Preserve};
use crate::output::{Guarantee, TetMesh};
use crate::plan::assemble::Origin;
use crate::plan::crowding::crowding;
use crate::plan::promise::promise;
use crate::plan::refine::Input;
use crate::plan::{assemble, in_terms_of_input, warn, Engine, Recovered, Run};
use crate::plc::near::Home;
use crate::plc::patch::Patches;
use crate::plc::surface::Surface;
use crate::plc::{Plc, Prepared};
use crate::preserve::inside::Inside;
use crate::preserve::recover::edges::{Recovery, Round, ROUNDS};
use crate::preserve::recover::order::first_points;
use crate::preserve::release::patches::Target;
use crate::preserve::whole::{fill_hull, Wanted};
use crate::preserve::{carve, from_constrained, Failure, Spot};
use crate::progress::Phase;
use crate::segments::recovery::Segments;
use rustc_hash::FxHashMap;

/// The tetrahedralization D2: the whole surface is in it, perhaps with points on its segments.
pub(super) struct D2 {
    pub(super) engine: Engine,
    pub(super) segments: Segments,
    pub(super) subfaces: Subfaces,
    /// Patch of each triangle of the surface.
    pub(super) patch: Vec<u32>,
    /// Points inside.
    pub(super) inside: Vec<u32>,
    /// How many attempts have failed.
    pub(super) attempt: u32,
}

/// The Delaunay tetrahedralization D1, with the segments in it; facets come next.
struct D1 {
    engine: Engine,
    recovered: Recovered,
    /// How many attempts have failed.
    attempt: u32,
}

impl Run<'_> {
    /// Makes a mesh that has every triangle of the surface.
    pub(super) fn preserve(
        &mut self,
        plc: &Plc,
        options: &Options,
        prepared: Prepared,
    ) -> Result<TetMesh, Error> {
        let mut first = Vec::new();
        if !options.keep_hull && options.merge_facets.is_none() {
            let surface = prepared.copied()?.connect(plc, self.control)?;
            first = first_points(&surface, self.control)?;
            self.lap(Phase::Validate);
            for rounds in ROUNDS {
                // What is given up once would only take longer with more levels.
                let Some(d2) = self.reconnect(&surface, options, &first, rounds)? else { break };
                match self.free_surface(plc, &surface, options, d2) {
                    // Another mesh may leave more room.
                    Err(e) if self.is_crowded(&e) => self.statistics.preserve = Default::default(),
                    done => return done,
                }
            }
            self.statistics.preserve = Default::default();
        }
        let (mut engine, mut order) = Engine::numbered(prepared.surface(), options, &first, self.control)?;
        self.delaunay_in(&mut engine, &mut order, options.worker_threads())?;
        let (surface, recovered) = self.connect_and_recover(plc, options, prepared, &mut engine, false)?;
        let careful = more_careful(&[], &surface, &recovered.segments)?;
        let retries = retries(recovered.segments.steiner_t.len());
        match self.free_recovered(plc, &surface, options, D1 { engine, recovered, attempt: 0 }) {
            Err(e) if self.is_crowded(&e) => match self.whole(plc, &surface, options)? {
                Some(mesh) => Ok(mesh),
                None => self.try_again(plc, &surface, options, careful, retries)?.ok_or(e),
            },
            done => done,
        }
    }

    /// The mesh of a small surface that is filled as a whole ([`fill_hull`]), where a point had no position in doubles. `None` if there is
    /// none.
    pub(super) fn whole(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
    ) -> Result<Option<TetMesh>, Error> {
        self.statistics.preserve = Default::default();
        let mut engine = Engine::new(surface, options, self.control)?;
        let corners = engine.map(&surface.triangles)?;
        let edges = edges_of(surface, self.control)?;
        let Relaxed { patch, patch_count, .. } = relax(surface, &edges, &[], self.control)?;
        let segments = Segments::new(&engine.points, engine.map(&edges)?, self.control)?;
        let wanted = Wanted { triangles: &corners, edges: &segments.ends };
        let control = self.control;
        control.progress(Phase::Preserve, 0.0)?;
        let filled = fill_hull(&mut engine.mesh, &mut engine.points, wanted, control)?;
        let Some(inside) = filled else { return Ok(None) };
        let triangles =
            Triangles { corners: &corners, facet: &surface.triangle_facet, patch: &patch, patch_count };
        let subfaces = Subfaces::build(&engine.points, &triangles, &segments, control)?;
        FacetRecovery::new(&mut engine.mesh, &engine.points, &subfaces, control)?.run()?;
        let d2 = D2 { engine, segments, subfaces, patch, inside, attempt: 0 };
        match self.free_surface(plc, surface, options, d2) {
            Err(e) if self.is_crowded(&e) => Ok(None),
            made => made.map(Some),
        }
    }

    /// Further attempts where a point had no position in doubles: other exact meshes, whose points are removed in another order, may leave
    /// room. `None` if all fail.
    fn try_again(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        mut careful: Vec<u8>,
        retries: u32,
    ) -> Result<Option<TetMesh>, Error> {
        for attempt in 1..=retries {
            self.statistics.preserve = Default::default();
            let mut engine = Engine::new(surface, options, self.control)?;
            let first = engine.points.len() as u32;
            let again = match self.recover_anew(surface, options, &mut engine, first, &careful, false) {
                Ok(recovered) => {
                    careful = more_careful(&careful, surface, &recovered.segments)?;
                    self.free_recovered(plc, surface, options, D1 { engine, recovered, attempt })
                }
                Err(other) => Err(other),
            };
            match again {
                Err(e) if !self.is_final(&e) => {}
                done => return done.map(Some),
            }
        }
        Ok(None)
    }

    /// Recovers facets in a constrained Delaunay tetrahedralization and takes all points off the surface.
    fn free_recovered(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        exact: D1,
    ) -> Result<TetMesh, Error> {
        let D1 { mut engine, recovered, attempt } = exact;
        let subfaces = self.recover_facets(surface, &recovered, &mut engine)?;
        let segments = recovered.segments;
        let counts = &mut self.statistics.preserve;
        counts.missing_edges = segments.missing;
        counts.by_splits = segments.missing;
        let patch = fallible::copied(&surface.triangle_patch)?;
        let d2 = D2 { engine, segments, subfaces, patch, inside: Vec::new(), attempt };
        self.free_surface(plc, surface, options, d2)
    }

    /// Carves the domain and takes all points off the surface.
    pub(super) fn free_surface(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        d2: D2,
    ) -> Result<TetMesh, Error> {
        let D2 { mut engine, segments, subfaces, patch, inside, attempt } = d2;
        let regions = self.find_regions(plc, surface, options, &mut engine)?;
        self.control.progress(Phase::Preserve, 0.0)?;
        let mut mesh = std::mem::take(&mut engine.mesh);
        carve(&mut mesh, engine.points.len(), &subfaces, self.control)?;
        drop(subfaces);
        self.promise = promise(&engine, surface, &patch, &mesh, &segments, options.preserve, self.control)?;
        let target = Target {
            triangles: &engine.map(&surface.triangles)?,
            patch: &patch,
            facet: &surface.triangle_facet,
            first_polygon: surface.first_polygon,
            preserve: options.preserve,
            attempt,
        };
        let control = self.control;
        let whole = control.whole(Phase::Preserve);
        let mut freed = from_constrained(
            &mut mesh,
            &mut engine.points,
            &segments,
            &target,
            Inside::of(inside),
            &mut self.statistics.preserve,
            whole,
        )
        .map_err(|failure| match failure {
            Failure::Other(error) => error,
            Failure::Crowded(spots) => {
                let input = |v: u32| engine.input_of[v as usize];
                let place = |spot: &Spot| match *spot {
                    Spot::Edge(ends, at) => (Home::Edge(ends.map(input)), at),
                    Spot::Facet(facet, at) => (Home::Facet(facet), at),
                };
                match fallible::collect(spots.iter().map(place)) {
                    Ok(places) => crowding(surface, &places, "", options.max_defects, control),
                    Err(short) => Error::from(short),
                }
            }
        })?;
        let input = Input { plc, surface, regions: &regions };
        self.refine(options, &mut engine, &mut mesh, &mut freed, input)?;
        self.statistics.missing_segments = segments.missing;
        self.statistics.steiner = freed.settled.len() as u64;
        self.statistics.steiner_moved = freed.settled.iter().filter(|point| point.moved).count() as u64;
        let origin = Origin { plc, surface, segments: &segments, regions: &regions };
        let mut mesh = assemble::preserved(&engine, origin, &mesh, &freed, control)?;
        self.statistics.steiner_exact =
            mesh.steiner.iter().filter(|point| point.exact && !point.is_inside()).count() as u64;
        mesh.hull_kept = options.keep_hull;
        mesh.guarantee = match options.preserve {
            Preserve::All => Guarantee::Preserved,
            Preserve::Outer => Guarantee::PreservedOuter,
        };
        self.seeds = warn::about_seeds(plc, &regions, options);
        self.lap(Phase::Preserve);
        Ok(mesh)
    }

    /// Recovers edges and faces by reconnection, inside a box, so that nothing of the surface lies on the hull. None if it was
    /// given up.
    fn reconnect(
        &mut self,
        surface: &Surface,
        options: &Options,
        first: &[u32],
        rounds: &'static [Round],
    ) -> Result<Option<D2>, Error> {
        let (mut engine, inner) = Engine::numbered(surface, options, first, self.control)?;
        let count = engine.points.len() as u32;
        for corner in surrounding_box(engine.points.coordinates()) {
            engine.points.push(corner)?;
        }
        for end in &mut engine.rounds {
            *end += 8;
        }
        let mut order = fallible::collect((count..count + 8).chain(inner))?;
        self.delaunay_in(&mut engine, &mut order, options.worker_threads())?;
        self.control.look()?;
        engine.mesh.index_vertices(engine.points.len())?;

        self.control.progress(Phase::Segments, 0.0)?;
        let all_edges = edges_of(surface, self.control)?;
        let edges = engine.map(&all_edges)?;
        let corners = engine.map(&surface.triangles)?;
        let Engine { mesh, points, input_of, .. } = &mut engine;
        let control = self.control;
        let mut recovery = Recovery::new(mesh, points, rounds, control);
        let missing = recovery.edges(&edges)?;
        let relaxed = relax(surface, &all_edges, &missing, control)?;
        let mut kept = fallible::reserved(edges.len())?;
        fallible::extend(&mut kept, edges.iter().zip(&relaxed.keep).filter(|e| *e.1).map(|e| *e.0))?;
        let mut segments = Segments::new(recovery.points, kept, control)?;
        segments.missing = recovery.missing_edges;
        let split = recovery
            .split_missing(&mut segments)
            .map_err(|e| in_terms_of_input(e, &segments, input_of, surface))?;
        self.lap(Phase::Segments);
        if !split {
            return Ok(None);
        }

        self.control.progress(Phase::Facets, 0.0)?;
        let triangles = Triangles {
            corners: &corners,
            facet: &surface.triangle_facet,
            patch: &relaxed.patch,
            patch_count: relaxed.patch_count,
        };
        let mut subfaces = Subfaces::build(recovery.points, &triangles, &segments, control)?;
        let found = recovery.faces(&mut subfaces)?;
        let counts = &mut self.statistics.preserve;
        counts.missing_edges = recovery.missing_edges;
        counts.missing_faces = recovery.missing_faces;
        counts.by_reconnection = recovery.recovered;
        counts.by_splits = recovery.split;
        counts.by_interior_points = recovery.by_points;
        let inside = std::mem::take(&mut recovery.inside);
        drop(recovery);
        self.lap(Phase::Facets);
        self.note_peak(&engine);
        Ok(found.then_some(D2 { engine, segments, subfaces, patch: relaxed.patch, inside, attempt: 0 }))
    }
}

/// How many further attempts there are where the first had this many points on segments. They bound the work: a small input is done or given
/// up within a second. Of 25 small inputs that failed before, 15 succeed within ten attempts.
fn retries(steiner: usize) -> u32 {
    (1024 / steiner.max(1)).clamp(2, 10) as u32
}

/// One more failure for each segment with points on it. (Not for merged facets: other points might be needed on edges that merging made.)
fn more_careful(careful: &[u8], surface: &Surface, segments: &Segments) -> Result<Vec<u8>, Error> {
    let mut more = fallible::filled(0u8, surface.segments.len())?;
    if surface.edges_beside.is_empty() {
        for &s in &segments.steiner_segment {
            more[s as usize] = careful.get(s as usize).map_or(1, |&c| c.saturating_add(1));
        }
    }
    Ok(more)
}

/// Which edges are kept, and the patches between them.
struct Relaxed {
    /// Per edge whether it is a segment.
    keep: Vec<bool>,
    /// Per triangle its patch.
    patch: Vec<u32>,
    patch_count: usize,
}

/// Gives up missing flat edges: the triangles on both sides become one patch.
fn relax(
    surface: &Surface,
    edges: &[[u32; 2]],
    missing: &[u32],
    control: &Control,
) -> Result<Relaxed, Error> {
    let mut keep = fallible::filled(true, edges.len())?;
    let mut dropped: Vec<[u32; 2]> = Vec::new();
    for &edge in missing {
        control.step()?;
        let ends = edges[edge as usize];
        if surface.segments.binary_search(&ends).is_err() {
            keep[edge as usize] = false;
            fallible::push(&mut dropped, ends)?;
        }
    }
    dropped.sort_unstable();
    let mut patches = Patches::new(surface.triangles.len())?;
    let mut first: FxHashMap<[u32; 2], u32> = FxHashMap::default();
    for (t, &[a, b, c]) in surface.triangles.iter().enumerate() {
        control.step()?;
        for key in [edge_key(a, b), edge_key(b, c), edge_key(c, a)] {
            if dropped.binary_search(&key).is_ok() {
                let other = *fallible::entry(&mut first, key)?.or_insert(t as u32);
                patches.join(other, t as u32);
            }
        }
    }
    control.look()?;
    let mut patch = Vec::new();
    let patch_count = patches.number(&mut patch)? as usize;
    Ok(Relaxed { keep, patch, patch_count })
}

/// All edges of triangles, and the other segments.
fn edges_of(surface: &Surface, control: &Control) -> Result<Vec<[u32; 2]>, Error> {
    let mut edges = fallible::reserved(3 * surface.triangles.len() + surface.segments.len())?;
    for &[a, b, c] in &surface.triangles {
        fallible::extend(&mut edges, [edge_key(a, b), edge_key(b, c), edge_key(c, a)])?;
    }
    fallible::extend(&mut edges, surface.segments.iter().map(|&[a, b]| edge_key(a, b)))?;
    control.sort(&mut edges)?;
    edges.dedup();
    Ok(edges)
}

/// Corners of an uneven box well around all points: hardly anything is coplanar with them. On a coarse grid: short numbers keep the
/// arithmetic short.
fn surrounding_box(points: &[[f64; 3]]) -> [[f64; 3]; 8] {
    /// Odd multiples of a 64th, all different.
    const UNEVEN: [[f64; 3]; 8] = [
        [1.0, 19.0, 7.0],
        [29.0, 3.0, 11.0],
        [13.0, 23.0, 31.0],
        [5.0, 17.0, 27.0],
        [21.0, 9.0, 15.0],
        [25.0, 33.0, 37.0],
        [35.0, 39.0, 43.0],
        [41.0, 47.0, 45.0],
    ];
    // Without points anywhere.
    let any = points.first().copied().unwrap_or_default();
    let fold = |k: usize, f: fn(f64, f64) -> f64| points.iter().map(|p| p[k]).fold(any[k], f);
    let low = [0, 1, 2].map(|k| fold(k, f64::min));
    let high = [0, 1, 2].map(|k| fold(k, f64::max));
    let side = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
    // Points that are (nearly) one have a box, too, whose corners differ in doubles.
    let largest = low.iter().chain(&high).map(|x| x.abs()).fold(0.0, f64::max);
    let side = match side.max(largest * power_of_two(-40)) {
        0.0 => 1.0,
        side => side,
    };
    let unit = power_of_two(exponent_above(side));
    std::array::from_fn(|i| {
        std::array::from_fn(|k| {
            let beyond = unit * (1.0 + UNEVEN[i][k] / 64.0);
            if i >> k & 1 == 0 {
                (low[k] / unit).floor() * unit - beyond
            } else {
                (high[k] / unit).ceil() * unit + beyond
            }
        })
    })
}
