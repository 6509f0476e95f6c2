//! The pipeline: prepare → Delaunay → segments → facets → regions → rounding → output → audit. The only place that knows the
//! order.
use crate::check::audit;
use crate::constrain::facet::FacetRecovery;
use crate::constrain::segment::{Recovery, Segments};
use crate::constrain::subface::{Subfaces, Triangles};
use crate::delaunay::order::{insertion_order, Order};
use crate::delaunay::Delaunay;
use crate::error::{Error, Status};
use crate::mesh::flag;
use crate::mesh::star::StarSearch;
use crate::options::{Mode, Options};
use crate::output::{Statistics, TetMesh};
use crate::plc::merge::Guide;
use crate::plc::surface::Surface;
use crate::plc::{Plc, Prepared, RegionSeed};
use crate::predicates::{scale, Points};
use crate::progress::{report, Observer, Phase};
use crate::region::{components, label, Components, Regions, Seeds};
use crate::rounding::{round, Kept};
use crate::INVALID;
use std::time::Instant;

mod assemble;

/// Makes a tetrahedral mesh of a PLC.
///
/// The result is constrained Delaunay (or Delaunay, by [`Mode`]), its tetrahedra are all positive in exact arithmetic on
/// the returned doubles, and input points come back first, in order, bit for bit. See [`Status`] for what can fail; a
/// valid PLC does not.
pub fn tetrahedralize(plc: &Plc, options: &Options, observer: &mut dyn Observer) -> Result<TetMesh, Error> {
    if options.threads == 0 {
        return Err(Error::new(Status::InvalidArgument, "the number of threads must be at least 1"));
    }
    let mut run = Run { clock: Instant::now(), statistics: Statistics::default(), observer };
    let prepared = run.prepare(plc, options)?;
    let mut engine = Engine::new(prepared.surface(), options)?;
    let mut mesh = match options.mode {
        Mode::Delaunay => {
            // The surface's copy of the points would lie beside the mesh at its largest.
            let alias = prepared.surface().alias.clone();
            drop(prepared);
            run.delaunay(&mut engine, options.threads)?;
            assemble::delaunay(engine, plc, alias)?
        }
        Mode::Constrained => {
            run.delaunay(&mut engine, options.threads)?;
            let (surface, segments) = run.connect_and_recover(plc, options, prepared, &mut engine)?;
            let mesh = run.constrain(plc, &surface, options, segments, &mut engine)?;
            drop(engine);
            mesh
        }
    };
    run.audit(plc, options, &mut mesh)?;
    Ok(mesh)
}

/// How often segments are recovered anew because Steiner points have no valid position in doubles.
const MOST_ATTEMPTS: u32 = 6;

/// Attempts at merging facets before all new edges beside the input's surface are given up.
const MERGE_ATTEMPTS: usize = 2;

/// Edges beside the input's surface that have Steiner points.
fn split_beside(surface: &Surface, segments: &Segments) -> Result<Vec<[u32; 2]>, Error> {
    let mut split: Vec<[u32; 2]> = Vec::new();
    split.try_reserve(segments.steiner_segment.len())?;
    split.extend(segments.steiner_segment.iter().map(|&s| surface.segments[s as usize]));
    split.retain(|edge| surface.edges_beside.binary_search(edge).is_ok());
    Ok(split)
}

/// Clock, counts and the caller's observer.
struct Run<'a> {
    clock: Instant,
    statistics: Statistics,
    observer: &'a mut dyn Observer,
}

/// The working state: vertices in insertion order and their triangulation.
#[derive(Clone)]
pub(crate) struct Engine {
    pub(crate) points: Points,
    pub(crate) delaunay: Delaunay,
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
    fn new(surface: &Surface, options: &Options) -> Result<Self, Error> {
        let distinct: Vec<u32> = surface
            .alias
            .iter()
            .enumerate()
            .filter(|&(i, &a)| i as u32 == a)
            .map(|(i, _)| i as u32)
            .collect();
        let Order { ids: input_of, rounds } = if options.points_sorted {
            Order { ids: distinct, rounds: Vec::new() }
        } else {
            insertion_order(&surface.points, &distinct)
        };
        let mut engine_of = vec![INVALID; surface.points.len()];
        for (engine, &input) in input_of.iter().enumerate() {
            engine_of[input as usize] = engine as u32;
        }
        for i in 0..surface.alias.len() {
            engine_of[i] = engine_of[surface.alias[i] as usize];
        }
        let mut xyz = Vec::new();
        xyz.try_reserve(input_of.len())?;
        xyz.extend(input_of.iter().map(|&i| surface.points[i as usize]));
        Ok(Engine {
            points: Points::new(xyz),
            delaunay: Delaunay::new(),
            input_of,
            rounds,
            engine_of,
            scale: surface.scale,
        })
    }

    fn map<const N: usize>(&self, list: &[[u32; N]]) -> Result<Vec<[u32; N]>, Error> {
        let mut mapped = Vec::new();
        mapped.try_reserve(list.len())?;
        mapped.extend(list.iter().map(|v| v.map(|i| self.engine_of[i as usize])));
        Ok(mapped)
    }
}

impl Run<'_> {
    /// Books the time since the last call for `phase`.
    fn lap(&mut self, phase: Phase) {
        self.statistics.seconds[phase as usize] += self.clock.elapsed().as_secs_f64();
        self.clock = Instant::now();
    }

    fn prepare(&mut self, plc: &Plc, options: &Options) -> Result<Prepared, Error> {
        report(self.observer, Phase::Validate, 0.0)?;
        let prepared = match options.mode {
            Mode::Constrained => crate::plc::check_and_split(plc, options, self.observer)?,
            Mode::Delaunay => {
                let points_only = Plc { points: plc.points.clone(), ..Plc::default() };
                crate::plc::check_and_split(&points_only, options, self.observer)?
            }
        };
        self.statistics.duplicate_points =
            prepared.surface().alias.iter().enumerate().filter(|&(i, &a)| i as u32 != a).count() as u64;
        self.lap(Phase::Validate);
        Ok(prepared)
    }

    /// Makes segments and patches of the surface and recovers the segments. Where merging has made edges beside the input's surface
    /// and they got Steiner points, which then lie beside it too, it is done again without these edges, and in the last attempt
    /// without any such edge.
    fn connect_and_recover(
        &mut self,
        plc: &Plc,
        options: &Options,
        prepared: Prepared,
        engine: &mut Engine,
    ) -> Result<(Surface, Segments), Error> {
        engine.delaunay.index_vertices(engine.points.len())?;
        let mut avoid: Vec<[u32; 2]> = Vec::new();
        if options.merge_facets.is_some() {
            for _ in 0..MERGE_ATTEMPTS {
                let mut trial = engine.clone();
                let surface = self.connect(plc, options, prepared.clone(), &mut trial, (&avoid, false))?;
                let segments = self.recover_segments(&surface, options, &mut trial, &[])?;
                let split = split_beside(&surface, &segments)?;
                if split.is_empty() {
                    *engine = trial;
                    return Ok((surface, segments));
                }
                avoid.try_reserve(split.len())?;
                avoid.extend(split);
                avoid.sort_unstable();
                avoid.dedup();
            }
        }
        let surface = self.connect(plc, options, prepared, engine, (&avoid, true))?;
        let segments = self.recover_segments(&surface, options, engine, &[])?;
        Ok((surface, segments))
    }

    /// Segments and patches of the surface; its flips are steered by the edges of the triangulation.
    fn connect(
        &mut self,
        plc: &Plc,
        options: &Options,
        prepared: Prepared,
        engine: &mut Engine,
        (avoid, avoid_all): (&[[u32; 2]], bool),
    ) -> Result<Surface, Error> {
        let Engine { delaunay, engine_of, .. } = engine;
        let mut search = StarSearch::default();
        let mut is_edge = |ends: [u32; 2]| {
            let [a, b] = ends.map(|v| engine_of[v as usize]);
            search.find_edge(&mut delaunay.mesh, a, b, delaunay.vertex_tet[a as usize]).is_some()
        };
        let mut guide = Guide { is_edge: &mut is_edge, avoid, avoid_all };
        let surface = prepared.connect(plc, options, Some(&mut guide), self.observer)?;
        self.lap(Phase::Validate);
        Ok(surface)
    }

    /// Takes note of what the kernel's arrays hold now.
    fn note_peak(&mut self, engine: &Engine) {
        self.statistics.peak_bytes = self.statistics.peak_bytes.max(engine.delaunay.bytes() as u64);
    }

    fn delaunay(&mut self, engine: &mut Engine, threads: usize) -> Result<(), Error> {
        let mut order: Vec<u32> = (0..engine.points.len() as u32).collect();
        let total = order.len().max(1) as f64;
        let observer = &mut *self.observer;
        engine.delaunay.build_rounds(&engine.points, &mut order, &engine.rounds, threads, &mut |done| {
            report(observer, Phase::Delaunay, done as f64 / total)
        })?;
        self.note_peak(engine);
        self.lap(Phase::Delaunay);
        Ok(())
    }

    fn constrain(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        mut segments: Segments,
        engine: &mut Engine,
    ) -> Result<TetMesh, Error> {
        let mut careful = vec![0u8; surface.segments.len()];
        let mut attempt = 0;
        loop {
            let subfaces = self.recover_facets(surface, &segments, engine)?;
            let (components, regions) = self.find_regions(plc, options, engine)?;
            report(self.observer, Phase::Round, 0.0)?;
            let kept = Kept { components: &components, regions: &regions };
            let rounded =
                round(&mut engine.delaunay, &mut engine.points, &mut segments, &kept, engine.scale)?;
            self.lap(Phase::Round);
            if !rounded.crowded.is_empty() && attempt < MOST_ATTEMPTS {
                // The exact mesh is valid but has no counterpart in doubles: other parameters on those segments make another
                // exact mesh.
                attempt += 1;
                for &v in &rounded.crowded {
                    careful[segments.steiner_segment[(v - segments.first_steiner) as usize] as usize] += 1;
                }
                engine.points.truncate(segments.first_steiner as usize);
                self.delaunay(engine, options.threads)?;
                segments = self.recover_segments(surface, options, engine, &careful)?;
                continue;
            }
            let mut mesh = assemble::mesh(
                engine,
                plc,
                surface,
                &components,
                &regions,
                &rounded,
                Some((&segments, &subfaces)),
            )?;
            if !rounded.crowded.is_empty() && !options.exact_form {
                return Err(assemble::crowded(&mesh, &segments, &rounded));
            }
            mesh.hull_kept = options.keep_hull;
            self.statistics.missing_segments = segments.missing;
            self.statistics.steiner = segments.steiner_t.len() as u64;
            self.statistics.steiner_moved = rounded.moved;
            self.statistics.steiner_exact = mesh.steiner.iter().filter(|s| s.exact).count() as u64;
            self.lap(Phase::Round);
            return Ok(mesh);
        }
    }

    fn recover_segments(
        &mut self,
        surface: &Surface,
        options: &Options,
        engine: &mut Engine,
        careful: &[u8],
    ) -> Result<Segments, Error> {
        report(self.observer, Phase::Segments, 0.0)?;
        engine.delaunay.index_vertices(engine.points.len())?;
        let mut segments = Segments::new(&engine.points, engine.map(&surface.segments)?)?;
        segments.careful = careful.to_vec();
        let observer = &mut *self.observer;
        let mut best = 0.0f64;
        let limit = options.steiner_limit.unwrap_or(100_000 + 100 * segments.ends.len() as u64);
        Recovery::new(&mut engine.delaunay, &mut engine.points, &mut segments, Some(limit)).run(
            &mut |done, known| {
                best = best.max(done as f64 / known.max(1) as f64);
                report(observer, Phase::Segments, best)
            },
        )?;
        self.lap(Phase::Segments);
        Ok(segments)
    }

    fn recover_facets(
        &mut self,
        surface: &Surface,
        segments: &Segments,
        engine: &mut Engine,
    ) -> Result<Subfaces, Error> {
        report(self.observer, Phase::Facets, 0.0)?;
        let triangles = Triangles {
            corners: &engine.map(&surface.triangles)?,
            facet: &surface.triangle_facet,
            patch: &surface.triangle_patch,
            patch_count: surface.patch_count as usize,
        };
        let subfaces = Subfaces::build(&engine.points, &triangles, segments)?;
        let observer = &mut *self.observer;
        let mut recovery = FacetRecovery::new(&mut engine.delaunay, &engine.points, &subfaces)?;
        recovery.run(&mut |done, all| report(observer, Phase::Facets, done as f64 / all.max(1) as f64))?;
        self.statistics.missing_regions = recovery.regions;
        drop(recovery);
        self.lap(Phase::Facets);
        Ok(subfaces)
    }

    fn find_regions(
        &mut self,
        plc: &Plc,
        options: &Options,
        engine: &mut Engine,
    ) -> Result<(Components, Regions), Error> {
        report(self.observer, Phase::Regions, 0.0)?;
        for flags in &mut engine.delaunay.mesh.flags {
            *flags &= flag::FACES | flag::DEAD;
        }
        let components = components(&engine.delaunay.mesh)?;
        let scaled = |p: [f64; 3]| p.map(|x| scale(x, engine.scale));
        let holes: Vec<[f64; 3]> = plc.holes.iter().map(|&p| scaled(p)).collect();
        let seeds: Vec<RegionSeed> =
            plc.regions.iter().map(|r| RegionSeed { point: scaled(r.point), ..*r }).collect();
        let regions = label(
            &engine.delaunay.mesh,
            &mut engine.points,
            &components,
            &Seeds { holes: &holes, regions: &seeds },
            options.keep_hull,
        )?;
        self.note_peak(engine);
        self.lap(Phase::Regions);
        Ok((components, regions))
    }

    /// The exact audit of what is handed out.
    fn audit(&mut self, plc: &Plc, options: &Options, mesh: &mut TetMesh) -> Result<(), Error> {
        report(self.observer, Phase::Audit, 0.0)?;
        audit(plc, mesh, options.max_defects).map_err(|e| match e.status {
            Status::CheckFailed => {
                Error { status: Status::Internal, message: format!("audit: {}", e.message), ..e }
            }
            _ => e,
        })?;
        report(self.observer, Phase::Audit, 1.0)?;
        self.lap(Phase::Audit);
        mesh.statistics = std::mem::take(&mut self.statistics);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
