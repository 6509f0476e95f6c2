//! Merging of facets ([`Options::merge_facets`]) in the pipeline: flips and recovery of segments in turn, and the comparison with
//! the mesh without merging.
//!
//! Merging never fails on input that can be meshed without it, and never takes more Steiner points. If merging fails, the mesh is made
//! without it. To compare the number of points, recovery without merging is also run, until it is certain to take as many: each missing
//! piece of a segment takes at least one point. So it usually ends early, and it is not started if nothing was flipped, or if at least as
//! many segments are missing at the start.
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::options::{Mode, Options};
use crate::output::TetMesh;
use crate::plan::refine::refines;
use crate::plan::{Engine, Recovered, Run};
use crate::plc::merge::{Guide, Merger};
use crate::plc::surface::Surface;
use crate::plc::{Plc, Prepared};
use crate::progress::Phase;
use crate::segments::recovery::Segments;
use rustc_hash::FxHashMap;

/// Attempts at merging facets from scratch before all new edges off the input's surface are given up. 1 and 6 change nothing on seven
/// models: it only bounds the work on worse ones.
const MERGE_ATTEMPTS: usize = 3;
/// How often an attempt is repaired: new edges that would need Steiner points are flipped back. 8 and 32 change nothing on seven models: it
/// only bounds the work on worse ones.
const MENDINGS: usize = 16;

const FEWER: &str = "facets are not merged: without merging the mesh needs fewer Steiner points";

/// The result of merging and recovery.
struct Merged {
    surface: Surface,
    segments: Segments,
    engine: Engine,
    /// Whether any edge was flipped.
    is_flipped: bool,
}

/// For each segment whether merging made it off the input's surface.
fn edges_beside(surface: &Surface) -> Result<Vec<bool>, Error> {
    let beside = fallible::collect(
        surface.segments.iter().map(|edge| surface.edges_beside.binary_search(edge).is_ok()),
    )?;
    Ok(beside)
}

/// The edges that have Steiner points.
fn split_edges(surface: &Surface, segments: &Segments) -> Result<Vec<[u32; 2]>, Error> {
    let mut split =
        fallible::collect(segments.steiner_segment.iter().map(|&s| surface.segments[s as usize]))?;
    split.sort_unstable();
    split.dedup();
    Ok(split)
}

impl Run<'_> {
    /// Meshes with merged facets, or without merging if that fails or takes more Steiner points.
    pub(super) fn merged_or_not(
        &mut self,
        plc: &Plc,
        options: &Options,
        prepared: Prepared,
    ) -> Result<TetMesh, Error> {
        self.unmerged_at_least = 0;
        let merged = match self.mesh_surface(plc, options, prepared.copied()?) {
            Ok(mesh) if self.needed(&mesh, options) <= self.unmerged_at_least => return Ok(mesh),
            Err(error) if self.is_final(&error) => return Err(error),
            other => other,
        };
        let needed = merged.as_ref().map_or(0, |mesh| self.needed(mesh, options));
        let seeds = std::mem::take(&mut self.seeds);
        let seconds = self.statistics.seconds;
        let statistics = std::mem::take(&mut self.statistics);
        let promise = std::mem::take(&mut self.promise);
        self.statistics.seconds = seconds;
        self.statistics.duplicate_points = statistics.duplicate_points;
        let options = Options { merge_facets: None, ..options.copied() };
        let unmerged = self.mesh_surface(plc, &options, prepared);
        let fewer = match (&merged, &unmerged) {
            (Ok(_), Ok(unmerged)) => self.needed(unmerged, &options) < needed,
            (Ok(_), Err(error)) if !self.is_final(error) => false,
            _ => true,
        };
        if fewer {
            match &merged {
                Err(error) if unmerged.is_ok() => {
                    self.control.log(&fallible::text(format_args!(
                        "facets are not merged, since merging fails: {}",
                        error.message
                    ))?);
                }
                _ => self.control.log(FEWER),
            }
            return unmerged;
        }
        let seconds = self.statistics.seconds;
        self.statistics = statistics;
        self.statistics.seconds = seconds;
        self.promise = promise;
        self.seeds = seeds;
        merged
    }

    /// The Steiner points that the surface needed, without those of filling and optimisation.
    fn needed(&self, mesh: &TetMesh, options: &Options) -> u64 {
        if refines(options) {
            self.statistics.steiner + self.statistics.preserve.interior
        } else {
            mesh.steiner.len() as u64
        }
    }

    /// Recovers segments with merging, and compares.
    pub(super) fn merge_and_compare(
        &mut self,
        plc: &Plc,
        options: &Options,
        degrees: f64,
        prepared: Prepared,
        engine: &mut Engine,
    ) -> Result<(Surface, Recovered), Error> {
        let merged = self.merge_and_recover(plc, degrees, &prepared, engine)?;
        if options.mode == Mode::Preserve {
            // The points on the surface will go.
            *engine = merged.engine;
            return Ok((merged.surface, Recovered::of(merged.segments)));
        }
        self.unmerged_at_least = merged.segments.steiner_t.len() as u64;
        if !merged.surface.diagonals.is_empty() {
            return self.compare_polygons(plc, prepared, merged, engine);
        }
        if !merged.is_flipped {
            // The same would be done again.
            *engine = merged.engine;
            return Ok((merged.surface, Recovered::of(merged.segments)));
        }
        let surface = prepared.connect(plc, self.control)?;
        let mut plain = Segments::new(&engine.points, engine.map(&surface.segments)?, self.control)?;
        match self.recover_fewer(&mut plain, &surface, engine, Some(self.unmerged_at_least)) {
            Ok(true) => {
                self.unmerged_at_least = plain.steiner_t.len() as u64;
                self.control.log(FEWER);
                return Ok((surface, Recovered::of(plain)));
            }
            Err(error) if self.is_final(&error) => return Err(error),
            // As many points, or not possible at all.
            Ok(false) | Err(_) => {}
        }
        *engine = merged.engine;
        Ok((merged.surface, Recovered::of(merged.segments)))
    }

    /// The comparison where polygons have diagonals of their own: merging keeps these as segments, the mesh without it does not.
    fn compare_polygons(
        &mut self,
        plc: &Plc,
        prepared: Prepared,
        merged: Merged,
        engine: &mut Engine,
    ) -> Result<(Surface, Recovered), Error> {
        let surface = prepared.connect(plc, self.control)?;
        let mut trial = engine.copied(self.control)?;
        let plain = Segments::new(&trial.points, trial.map(&surface.segments)?, self.control)?;
        match self.recover_with_polygons(&surface, plain, &mut trial, true) {
            Ok(plain)
                if !merged.is_flipped || plain.segments.steiner_t.len() < merged.segments.steiner_t.len() =>
            {
                if merged.is_flipped {
                    self.control.log(FEWER);
                }
                self.unmerged_at_least = plain.segments.steiner_t.len() as u64;
                *engine = trial;
                return Ok((surface, plain));
            }
            Err(error) if self.is_final(&error) => return Err(error),
            _ => {}
        }
        *engine = merged.engine;
        Ok((merged.surface, Recovered::of(merged.segments)))
    }

    /// Merges facets and recovers segments. Steiner points on an edge that merging made off the input's surface would lie off it too. So
    /// such edges are not split; those found missing are flipped back as long as that helps, and then avoided from the start. In the last
    /// attempt there are no such edges.
    ///
    /// Steiner points that an earlier state took stay. Recovery from the start once more would save 46 of 354,660 on the eleven models
    /// that take longest, and costs a tenth to a sixth of the instructions.
    fn merge_and_recover(
        &mut self,
        plc: &Plc,
        degrees: f64,
        prepared: &Prepared,
        engine: &Engine,
    ) -> Result<Merged, Error> {
        let mut avoid: Vec<[u32; 2]> = Vec::new();
        for attempt in 0..=MERGE_ATTEMPTS {
            let avoid_all = attempt == MERGE_ATTEMPTS;
            let mut prepared = prepared.copied()?;
            let mut merger = prepared.merger(plc, degrees, self.control)?;
            let mut trial = engine.copied(self.control)?;
            let mut segments: Option<Segments> = None;
            for _ in 0..MENDINGS {
                self.merge(&mut merger, &mut trial, &avoid, avoid_all)?;
                let surface = merger.surface();
                let ends = trial.map(&surface.segments)?;
                let mut current = match segments.take() {
                    None => Segments::new(&trial.points, ends, self.control)?,
                    Some(earlier) => earlier.exchange(&trial.points, ends, self.control)?,
                };
                self.control.look()?;
                current.deferred = edges_beside(surface)?;
                self.control.look()?;
                self.recover_segments(&mut current, surface, &mut trial)?;
                if current.waiting.is_empty() {
                    let is_flipped = merger.is_flipped();
                    let surface = prepared.into_surface(self.control)?;
                    return Ok(Merged { surface, segments: current, engine: trial, is_flipped });
                }
                let known = avoid.len();
                fallible::extend(&mut avoid, current.waiting.iter().map(|&s| surface.segments[s as usize]))?;
                avoid.sort_unstable();
                avoid.dedup();
                if avoid.len() == known {
                    break;
                }
                let split = split_edges(surface, &current)?;
                merger.keep(&split)?;
                segments = Some(current);
            }
        }
        Err(Error::internal("merging did not terminate"))
    }

    /// Flips edges of the surface, steered by the edges of the triangulation, and finds its segments and patches.
    fn merge(
        &mut self,
        merger: &mut Merger,
        engine: &mut Engine,
        avoid: &[[u32; 2]],
        avoid_all: bool,
    ) -> Result<(), Error> {
        let Engine { mesh, engine_of, .. } = engine;
        let (mut search, control) = (StarSearch::default(), self.control);
        // Every edge is looked up many times. Never iterated.
        let mut known: FxHashMap<[u32; 2], bool> = FxHashMap::default();
        let mut failed = None;
        let mut is_edge = |[a, b]: [u32; 2]| {
            let key = [a.min(b), a.max(b)];
            if let Some(&answer) = known.get(&key) {
                return answer;
            }
            let [a, b] = key.map(|v| engine_of[v as usize]);
            let start = mesh.vertex_tet[a as usize];
            let answer = search.find_edge(mesh, a, b, start).unwrap_or_else(|error| {
                failed = Some(error);
                None
            });
            control.worked(search.tets.len());
            // Without memory, it will be looked up again.
            let _ = fallible::insert(&mut known, key, answer.is_some());
            answer.is_some()
        };
        let run = merger.run(Some(&mut Guide { is_edge: &mut is_edge, avoid, avoid_all }), self.control);
        failed.map_or(run, Err)?;
        self.control.progress(Phase::Validate, 1.0)?;
        self.lap(Phase::Validate);
        Ok(())
    }
}
