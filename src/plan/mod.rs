//! The pipeline: prepare → Delaunay → segments → facets → regions → rounding → output → audit. The only place that knows the
//! order.
use crate::check::{audit, audit_promise, Promise};
use crate::control::{controlled, Control};
use crate::delaunay::insert::Inserter;
use crate::delaunay::order::{insertion_order, Order};
use crate::delaunay::Construction;
use crate::domain::{components, label, Domain, Seeds};
use crate::error::{Element, Error, Status};
use crate::facets::polygons::{retriangulate, Polygons, Retriangulated};
use crate::facets::recovery::FacetRecovery;
use crate::facets::subface::{Subfaces, Triangles};
use crate::fallible;
use crate::kernel::edge_key;
use crate::kernel::Mesh;
use crate::options::{Mode, Options};
use crate::output::{Statistics, SteinerPoint, TetMesh};
use crate::plc::surface::Surface;
use crate::plc::{Plc, Prepared};
use crate::predicates::{scale, Points};
use crate::progress::{Observer, Phase};
use crate::segments::recovery::{Recovery, Segments};
use crate::warning::Warnings;
use crate::INVALID;
use assemble::Weighted;
use std::time::Instant;

mod assemble;
mod constrain;
mod crowding;
pub mod given;
mod lift;
mod merge;
mod preserve;
mod promise;
mod refine;
mod refined;
mod slides;
mod unmeshed;
mod unrounded;
mod warn;

/// Makes a tetrahedral mesh of a PLC.
///
/// The result is constrained Delaunay (or Delaunay, by [`Mode`]), its tetrahedra are all positive in exact arithmetic on
/// the returned doubles, and input points come back first, in order, bit for bit. See [`Status`] for what can fail; a
/// valid PLC does not.
pub fn tetrahedralize(plc: &Plc, options: &Options, observer: &mut dyn Observer) -> Result<TetMesh, Error> {
    controlled(options.limits(), observer, |control| tetrahedralize_with(plc, options, control))
}

/// The same as a part of a run with a control of its own, whose limits count instead of those of `options`: one that also reads and writes
/// files, for example.
///
/// # Errors
/// As [`tetrahedralize`].
pub fn tetrahedralize_with(plc: &Plc, options: &Options, control: &Control) -> Result<TetMesh, Error> {
    let (statistics, warnings) = (Statistics::default(), Warnings::default());
    let promise = Promise::default();
    let seeds = Warnings::default();
    let mut run = Run {
        clock: Instant::now(),
        statistics,
        warnings,
        seeds,
        unmerged_at_least: 0,
        promise,
        control,
        is_refining: false,
    };
    let outcome = run.mesh(plc, options);
    match &outcome {
        Ok(mesh) => mesh.warnings.log(control),
        Err(_) => run.warnings.log(control),
    }
    outcome
}

/// Translates the engine's segments in an error to the caller's: a facet edge is named by the first facet that has it. The location is
/// translated too.
fn in_terms_of_input(mut error: Error, segments: &Segments, input_of: &[u32], surface: &Surface) -> Error {
    for defect in &mut error.defects {
        let Element::Segment(s) = defect.first else { continue };
        let [a, b] = segments.ends[s as usize].map(|v| input_of[v as usize]);
        let found = surface.segments.binary_search(&edge_key(a, b));
        let parent = found.map_or(INVALID, |s| surface.segment_parent[s]);
        let facet = || surface.triangles.iter().position(|t| t.contains(&a) && t.contains(&b));
        defect.first = match parent {
            INVALID => facet().map_or(Element::Point(a), |t| Element::Facet(surface.triangle_facet[t])),
            parent => Element::Segment(parent),
        };
        let at = surface.points[a as usize].map(|x| scale(x, -surface.scale));
        defect.point = defect.point.or(Some(at));
    }
    error
}

/// Segments that are unions of edges, and polygons with other diagonals than the surface's.
struct Recovered {
    segments: Segments,
    polygons: Retriangulated,
}

impl Recovered {
    /// Segments alone.
    fn of(segments: Segments) -> Recovered {
        Recovered { segments, polygons: Retriangulated::default() }
    }
}

/// Clock, counts and control.
struct Run<'a> {
    clock: Instant,
    statistics: Statistics,
    warnings: Warnings,
    /// Warnings about seeds, of the last mesh made.
    seeds: Warnings,
    /// The number of Steiner points certain to be needed without merging.
    unmerged_at_least: u64,
    /// What the mesh must have, if it is to keep the surface.
    promise: Promise,
    control: &'a Control<'a>,
    /// The mesh is filled or optimised: an error ends the run.
    is_refining: bool,
}

/// The working state: vertices in insertion order and their triangulation.
pub(crate) struct Engine {
    pub(crate) points: Points,
    /// The tetrahedra.
    pub(crate) mesh: Mesh,
    /// Inserts vertices.
    pub(crate) inserter: Inserter,
    /// Input point of each engine vertex (Steiner points excluded).
    pub(crate) input_of: Vec<u32>,
    /// Where rounds of insertion end.
    pub(crate) rounds: Vec<usize>,
    /// Engine vertex of each input point (of its first equal one).
    pub(crate) engine_of: Vec<u32>,
    /// Coordinates are the input's times two to this power.
    pub(crate) scale: i32,
}

impl Engine {
    /// Orders the distinct points and sets up the exact arithmetic.
    fn new(surface: &Surface, options: &Options, control: &Control) -> Result<Self, Error> {
        Ok(Self::numbered(surface, options, &[], control)?.0)
    }

    /// The same, where the given points get the lowest ids; and the order in which to insert the vertices.
    fn numbered(
        surface: &Surface,
        options: &Options,
        first: &[u32],
        control: &Control,
    ) -> Result<(Self, Vec<u32>), Error> {
        let mut distinct = fallible::reserved(surface.alias.len())?;
        fallible::extend(
            &mut distinct,
            (0u32..).zip(&surface.alias).filter(|&(i, &a)| i == a).map(|(i, _)| i),
        )?;
        let Order { ids: sorted, rounds } = if options.points_sorted {
            Order { ids: distinct, rounds: Vec::new() }
        } else {
            insertion_order(&surface.points, &distinct, control)?
        };
        control.look()?;
        let mut engine_of = fallible::filled(INVALID, surface.points.len())?;
        for (engine, &input) in first.iter().enumerate() {
            engine_of[input as usize] = engine as u32;
        }
        let mut input_of = fallible::reserved(sorted.len())?;
        fallible::append(&mut input_of, first)?;
        fallible::extend(
            &mut input_of,
            sorted.iter().copied().filter(|&i| engine_of[i as usize] == INVALID),
        )?;
        for (engine, &input) in input_of.iter().enumerate() {
            engine_of[input as usize] = engine as u32;
        }
        control.look()?;
        for i in 0..surface.alias.len() {
            engine_of[i] = engine_of[surface.alias[i] as usize];
        }
        control.room(input_of.len() * size_of::<[f64; 3]>())?;
        let xyz = fallible::collect(input_of.iter().map(|&i| surface.points[i as usize]))?;
        let mut order = sorted;
        for v in &mut order {
            *v = engine_of[*v as usize];
        }
        let points = Points::new(xyz);
        let engine = Engine { points, input_of, rounds, engine_of, scale: surface.scale, ..Engine::empty() };
        Ok((engine, order))
    }

    /// A copy.
    fn copied(&self, control: &Control) -> Result<Engine, Error> {
        control.room(self.mesh.bytes() + self.points.len() * size_of::<[f64; 3]>())?;
        let copy = Engine {
            points: self.points.copied()?,
            mesh: self.mesh.copied()?,
            inserter: Inserter::default(),
            input_of: fallible::copied(&self.input_of)?,
            rounds: fallible::copied(&self.rounds)?,
            engine_of: fallible::copied(&self.engine_of)?,
            scale: self.scale,
        };
        control.look()?;
        Ok(copy)
    }

    /// Nothing.
    fn empty() -> Engine {
        Engine {
            points: Points::new(Vec::new()),
            mesh: Mesh::default(),
            inserter: Inserter::default(),
            input_of: Vec::new(),
            rounds: Vec::new(),
            engine_of: Vec::new(),
            scale: 0,
        }
    }

    /// Takes everything out.
    fn take(&mut self) -> Engine {
        std::mem::replace(self, Engine::empty())
    }

    fn map<const N: usize>(&self, list: &[[u32; N]]) -> Result<Vec<[u32; N]>, Error> {
        let mapped = fallible::collect(list.iter().map(|v| v.map(|i| self.engine_of[i as usize])))?;
        Ok(mapped)
    }
}

impl Run<'_> {
    /// All stages in their order.
    fn mesh(&mut self, plc: &Plc, options: &Options) -> Result<TetMesh, Error> {
        refine::check(plc, options)?;
        plc.check_lift(options)?;
        let prepared = self.prepare(plc, options)?;
        let mut mesh = match options.mode {
            Mode::Delaunay => {
                let mut engine = Engine::new(prepared.surface(), options, self.control)?;
                // The surface's copy of the points would coexist with the mesh at its peak size.
                let alias = fallible::copied(&prepared.surface().alias)?;
                drop(prepared);
                let lift = lift::lift(&mut engine, plc, &alias, self.control)?;
                self.delaunay(&mut engine, options.worker_threads())?;
                assemble::delaunay(engine, plc, Weighted { alias, lift }, self.control)?
            }
            Mode::Constrained | Mode::Preserve => {
                let made = match options.merge_facets {
                    None => self.mesh_surface(plc, options, prepared),
                    Some(_) => self.merged_or_not(plc, options, prepared),
                };
                match made {
                    Err(error) if self.is_crowded(&error) && options.mode == Mode::Preserve => {
                        return Err(unrounded::with_hint(plc, options, error, self.control))
                    }
                    made => made?,
                }
            }
        };
        self.control.tetrahedra(mesh.tets.len())?;
        // Filling has its own account.
        let refined = refine::refines(options);
        let counts = |point: &&SteinerPoint| !(refined && point.is_inside());
        if !(refined && options.mode == Mode::Constrained) {
            self.control
                .steiner(mesh.steiner.iter().filter(counts).count() as u64, mesh.subsegments.len())?;
        }
        self.audit(plc, options, &mut mesh)?;
        unmeshed::set_apart(&mut mesh, self.control)?;
        self.warnings.append(&self.seeds);
        warn::about_mesh(&mesh, options, &mut self.warnings, self.control)?;
        mesh.warnings = std::mem::take(&mut self.warnings);
        mesh.ratio = options.quality;
        if options.drop_unmeshed_points {
            self.control.look()?;
            mesh.drop_unmeshed_points()?;
            self.control.look()?;
        }
        Ok(mesh)
    }

    /// Whether nothing else may be tried after an error.
    fn is_final(&self, error: &Error) -> bool {
        self.is_refining || error.status.is_final()
    }

    /// Whether a point had no position in doubles.
    fn is_crowded(&self, error: &Error) -> bool {
        !self.is_refining && error.status == Status::Rounding
    }

    /// Books the time since the last call for `phase`.
    fn lap(&mut self, phase: Phase) {
        self.statistics.seconds[phase as usize] += self.clock.elapsed().as_secs_f64();
        self.clock = Instant::now();
    }

    fn prepare(&mut self, plc: &Plc, options: &Options) -> Result<Prepared, Error> {
        self.control.progress(Phase::Validate, 0.0)?;
        let prepared = match options.mode {
            Mode::Constrained | Mode::Preserve => crate::plc::check_and_split(plc, options, self.control)?,
            Mode::Delaunay => {
                let points_only = Plc { points: fallible::copied(&plc.points)?, ..Plc::default() };
                crate::plc::check_and_split(&points_only, options, self.control)?
            }
        };
        self.statistics.duplicate_points =
            warn::about_input(plc, &prepared.surface().alias, options, &mut self.warnings);
        self.lap(Phase::Validate);
        Ok(prepared)
    }

    /// Meshes in the modes that keep facets, with merging or without.
    fn mesh_surface(&mut self, plc: &Plc, options: &Options, prepared: Prepared) -> Result<TetMesh, Error> {
        if options.mode == Mode::Preserve {
            return self.preserve(plc, options, prepared);
        }
        let mut engine = Engine::new(prepared.surface(), options, self.control)?;
        self.delaunay(&mut engine, options.worker_threads())?;
        let (surface, recovered) = self.connect_and_recover(plc, options, prepared, &mut engine, true)?;
        self.constrain(plc, &surface, options, recovered, &mut engine)
    }

    /// Makes segments and patches of the surface and recovers the segments. If `any_diagonals`, polygons may get others than the
    /// surface's.
    fn connect_and_recover(
        &mut self,
        plc: &Plc,
        options: &Options,
        prepared: Prepared,
        engine: &mut Engine,
        any_diagonals: bool,
    ) -> Result<(Surface, Recovered), Error> {
        self.control.look()?;
        engine.mesh.index_vertices(engine.points.len())?;
        self.control.look()?;
        if let Some(degrees) = options.merge_facets {
            return self.merge_and_compare(plc, options, degrees, prepared, engine);
        }
        let surface = prepared.connect(plc, self.control)?;
        self.lap(Phase::Validate);
        let segments = Segments::new(&engine.points, engine.map(&surface.segments)?, self.control)?;
        let recovered = self.recover_with_polygons(&surface, segments, engine, any_diagonals)?;
        Ok((surface, recovered))
    }

    /// Recovers segments: first those that must be there, then diagonals of polygons for which there are no others.
    fn recover_with_polygons(
        &mut self,
        surface: &Surface,
        mut segments: Segments,
        engine: &mut Engine,
        any_diagonals: bool,
    ) -> Result<Recovered, Error> {
        if surface.diagonals.is_empty() || !any_diagonals {
            self.recover_segments(&mut segments, surface, engine)?;
            return Ok(Recovered::of(segments));
        }
        let mut soft: Vec<bool> = fallible::filled(false, surface.segments.len())?;
        surface.diagonals.iter().for_each(|d| soft[d.0 as usize] = true);
        let corners = engine.map(&surface.triangles)?;
        loop {
            segments.deferred.clear();
            segments.deferred.try_reserve_exact(soft.len())?;
            fallible::append(&mut segments.deferred, &soft)?;
            self.recover_segments(&mut segments, surface, engine)?;
            if segments.waiting.is_empty() {
                return Ok(Recovered::of(segments));
            }
            segments.waiting.sort_unstable();
            let waits = |s: &u32| segments.waiting.binary_search(s).is_ok();
            // Diagonals are in the order of segments, not of facets.
            let mut wanted: Vec<u32> = fallible::reserved(segments.waiting.len())?;
            fallible::extend(&mut wanted, surface.diagonals.iter().filter(|d| waits(&d.0)).map(|d| d.1))?;
            wanted.sort_unstable();
            wanted.dedup();
            let polygons = Polygons { corners: &corners, facet: &surface.triangle_facet, soft: &soft };
            let Engine { mesh, points, .. } = &mut *engine;
            let (polygons, left) = retriangulate(mesh, points, &segments, &polygons, &wanted, self.control)?;
            if left.is_empty() {
                let mut gone: Vec<bool> = fallible::filled(false, soft.len())?;
                let theirs = surface.diagonals.iter().filter(|d| polygons.has(d.1));
                theirs.for_each(|d| gone[d.0 as usize] = soft[d.0 as usize]);
                segments.give_up(&gone, self.control)?;
                return Ok(Recovered { segments, polygons });
            }
            for &(segment, facet) in &surface.diagonals {
                let stays = left.binary_search(&facet).is_ok();
                soft[segment as usize] &= !(stays && segments.waiting.binary_search(&segment).is_ok());
            }
            let ends = engine.map(&surface.segments)?;
            let careful = std::mem::take(&mut segments.careful);
            segments = segments.exchange(&engine.points, ends, self.control)?;
            segments.careful = careful;
        }
    }

    /// Records the current size of the engine's arrays.
    fn note_peak(&mut self, engine: &Engine) {
        let bytes = engine.mesh.bytes() + engine.inserter.bytes();
        self.control.tables(bytes);
        self.statistics.peak_bytes = self.statistics.peak_bytes.max(bytes as u64);
    }

    fn delaunay(&mut self, engine: &mut Engine, threads: usize) -> Result<(), Error> {
        let mut order = fallible::collect(0..engine.points.len() as u32)?;
        self.delaunay_in(engine, &mut order, threads)
    }

    /// Inserts the vertices in this order.
    fn delaunay_in(&mut self, engine: &mut Engine, order: &mut [u32], threads: usize) -> Result<(), Error> {
        let part = self.control.whole(Phase::Delaunay);
        let (mesh, inserter) = (std::mem::take(&mut engine.mesh), std::mem::take(&mut engine.inserter));
        let mut construction = Construction::with(mesh, inserter);
        construction.build_rounds(&engine.points, order, &engine.rounds, threads, part)?;
        (engine.mesh, engine.inserter) = (construction.mesh, construction.inserter);
        self.note_peak(engine);
        self.lap(Phase::Delaunay);
        Ok(())
    }

    /// Begins segment recovery again, with other parameters on segments where rounding failed.
    fn recover_anew(
        &mut self,
        surface: &Surface,
        options: &Options,
        engine: &mut Engine,
        first_steiner: u32,
        careful: &[u8],
        any_diagonals: bool,
    ) -> Result<Recovered, Error> {
        engine.points.truncate(first_steiner as usize);
        self.delaunay(engine, options.worker_threads())?;
        self.control.look()?;
        engine.mesh.index_vertices(engine.points.len())?;
        self.control.look()?;
        let mut segments = Segments::new(&engine.points, engine.map(&surface.segments)?, self.control)?;
        segments.careful.try_reserve_exact(careful.len())?;
        fallible::append(&mut segments.careful, careful)?;
        self.recover_with_polygons(surface, segments, engine, any_diagonals)
    }

    fn recover_segments(
        &mut self,
        segments: &mut Segments,
        surface: &Surface,
        engine: &mut Engine,
    ) -> Result<(), Error> {
        self.recover_fewer(segments, surface, engine, None).map(|_| ())
    }

    /// The same, given up with `false` as soon as it is certain to take `enough` Steiner points.
    fn recover_fewer(
        &mut self,
        segments: &mut Segments,
        surface: &Surface,
        engine: &mut Engine,
        enough: Option<u64>,
    ) -> Result<bool, Error> {
        self.control.progress(Phase::Segments, 0.0)?;
        let mut recovery =
            Recovery::new(&mut engine.mesh, &mut engine.inserter, &mut engine.points, segments, self.control);
        recovery.enough = enough;
        let done = recovery.run();
        drop(recovery);
        let done = done.map_err(|e| in_terms_of_input(e, segments, &engine.input_of, surface))?;
        self.lap(Phase::Segments);
        Ok(done)
    }

    fn recover_facets(
        &mut self,
        surface: &Surface,
        Recovered { segments, polygons }: &Recovered,
        engine: &mut Engine,
    ) -> Result<Subfaces, Error> {
        self.control.progress(Phase::Facets, 0.0)?;
        let corners = engine.map(&surface.triangles)?;
        let (facet, patch) = (&surface.triangle_facet, &surface.triangle_patch);
        let patch_count = surface.patch_count as usize;
        let subfaces = if polygons.facets.is_empty() {
            let triangles = Triangles { corners: &corners, facet, patch, patch_count };
            Subfaces::build(&engine.points, &triangles, segments, self.control)?
        } else {
            let (mut rest, mut rest_facet, mut rest_patch) = (Vec::new(), Vec::new(), Vec::new());
            self.control.look()?;
            rest.try_reserve_exact(corners.len())?;
            rest_facet.try_reserve_exact(corners.len())?;
            rest_patch.try_reserve_exact(corners.len())?;
            for t in (0..corners.len()).filter(|&t| !polygons.has(facet[t])) {
                fallible::push(&mut rest, corners[t])?;
                fallible::push(&mut rest_facet, facet[t])?;
                fallible::push(&mut rest_patch, patch[t])?;
            }
            let triangles = Triangles { corners: &rest, facet: &rest_facet, patch: &rest_patch, patch_count };
            let mut subfaces = Subfaces::build(&engine.points, &triangles, segments, self.control)?;
            subfaces.add_single(&engine.points, &polygons.corners, &polygons.facet, self.control)?;
            subfaces
        };
        let mut recovery = FacetRecovery::new(&mut engine.mesh, &engine.points, &subfaces, self.control)?;
        recovery.run()?;
        self.statistics.missing_regions = recovery.regions;
        drop(recovery);
        self.lap(Phase::Facets);
        Ok(subfaces)
    }

    fn find_regions(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        engine: &mut Engine,
    ) -> Result<Domain, Error> {
        self.control.progress(Phase::Regions, 0.0)?;
        engine.mesh.clear_subsegments();
        self.control.look()?;
        let components = components(&engine.mesh, self.control)?;
        let regions = label(
            &engine.mesh,
            &mut engine.points,
            &components,
            &Seeds { holes: &plc.holes, regions: &plc.regions, exponent: engine.scale },
            options.keep_hull,
            self.control,
        )
        .map_err(|error| match error.status {
            Status::NothingEnclosed => {
                warn::nothing_enclosed(plc, surface, options.max_defects, self.control)
            }
            _ => error,
        })?;
        engine.mesh.set_regions(|t| regions.of_component[components.of[t as usize] as usize])?;
        self.note_peak(engine);
        self.lap(Phase::Regions);
        Ok(regions)
    }

    /// The exact audit of the output.
    fn audit(&mut self, plc: &Plc, options: &Options, mesh: &mut TetMesh) -> Result<(), Error> {
        self.control.progress(Phase::Audit, 0.0)?;
        let audited = audit(plc, mesh, options.max_defects, self.control);
        let audited =
            audited.and_then(|()| audit_promise(mesh, &self.promise, options.max_defects, self.control));
        audited.map_err(|e| match e.status {
            Status::CheckFailed => Error { status: Status::Internal, ..e.at(format_args!("audit")) },
            _ => e,
        })?;
        self.control.progress(Phase::Audit, 1.0)?;
        self.lap(Phase::Audit);
        mesh.statistics = std::mem::take(&mut self.statistics);
        Ok(())
    }
}

#[cfg(test)]
mod polygon_tests;
#[cfg(test)]
mod preserve_tests;
#[cfg(test)]
mod tests;
#[cfg(test)]
mod unrounded_tests;
