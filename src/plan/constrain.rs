//! From recovered segments to the mesh of mode cdt: facets, regions, refinement, positions in doubles, optimisation; and what is done if there
//! are no such positions.
//!
//! If points that refinement put on the surface have no valid position, the surface stays as it is round them, further and further; in the end
//! it is not refined at all.
use crate::error::{Error, Status};
use crate::fallible;
use crate::options::Options;
use crate::output::TetMesh;
use crate::plan::assemble::{self, Origin};
use crate::plan::crowding::crowding;
use crate::plan::preserve::D2;
use crate::plan::refine::{refines, Input};
use crate::plan::refined::{tight, Keeps, Recovery};
use crate::plan::{warn, Engine, Recovered, Run};
use crate::plc::near::Home;
use crate::plc::surface::Surface;
use crate::plc::Plc;
use crate::progress::Phase;
use crate::rounding::round;

impl Run<'_> {
    /// All stages after segment recovery.
    pub(super) fn constrain(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        mut recovered: Recovered,
        engine: &mut Engine,
    ) -> Result<TetMesh, Error> {
        let mut careful = fallible::filled(0u8, surface.segments.len())?;
        let mut fewest: Option<usize> = None;
        let mut any_diagonals = true;
        let mut keeps = Keeps::default();
        loop {
            let subfaces = match self.recover_facets(surface, &recovered, engine) {
                // An element lies so close to a polygon that it crosses its new triangles. It does not cross the surface's triangles, which
                // were checked.
                Err(e)
                    if matches!(e.status, Status::SelfIntersection | Status::Internal)
                        && !recovered.polygons.facets.is_empty() =>
                {
                    any_diagonals = false;
                    let first = recovered.segments.first_steiner;
                    recovered =
                        self.recover_anew(surface, options, engine, first, &careful, any_diagonals)?;
                    continue;
                }
                subfaces => subfaces?,
            };
            let segments = &mut recovered.segments;
            let regions = self.find_regions(plc, surface, options, engine)?;
            let input = Input { plc, surface, regions: &regions };
            let needed = segments.steiner_t.len() as u64;
            let mut refined = match refines(options) {
                true => Some(self.refine_surface(
                    options,
                    engine,
                    Recovery { segments, polygons: &recovered.polygons, subfaces: &subfaces },
                    input,
                    &keeps,
                )?),
                false => None,
            };
            self.control.progress(Phase::Round, 0.0)?;
            let rounded = round(
                &mut engine.mesh,
                &mut engine.points,
                segments,
                engine.scale,
                !options.exact_form,
                self.control,
            )?;
            self.lap(Phase::Round);
            let at_fault = refined.as_ref().is_some_and(|refined| refined.changes_rounding(segments, needed));
            if at_fault && !options.exact_form {
                let tight = tight(engine, &rounded, self.control)?;
                if !tight.is_empty() {
                    keeps.widen(engine, &tight)?;
                    let first = segments.first_steiner;
                    recovered =
                        self.recover_anew(surface, options, engine, first, &careful, any_diagonals)?;
                    continue;
                }
            }
            // At least once, and as long as each attempt leaves at most half as many; not if other points might be needed on edges made by
            // merging.
            let hopeful = surface.edges_beside.is_empty()
                && fewest.is_none_or(|fewest| 2 * rounded.crowded.len() <= fewest);
            if !rounded.crowded.is_empty() && hopeful {
                // The exact mesh is valid but has no counterpart in doubles: other parameters on those segments make another
                // exact mesh.
                fewest = Some(rounded.crowded.len());
                for &v in &rounded.crowded {
                    careful[segments.steiner_segment[(v - segments.first_steiner) as usize] as usize] += 1;
                }
                let first = segments.first_steiner;
                recovered = self.recover_anew(surface, options, engine, first, &careful, any_diagonals)?;
                continue;
            }
            if !rounded.crowded.is_empty() && !options.exact_form {
                let place = |&v: &u32| {
                    let segment = segments.steiner_segment[(v - segments.first_steiner) as usize];
                    let ends = segments.ends[segment as usize].map(|v| engine.input_of[v as usize]);
                    (Home::Edge(ends), *engine.points.xyz(v))
                };
                let places = fallible::collect(rounded.crowded.iter().map(place))?;
                drop((rounded, regions));
                let mut subfaces = subfaces;
                if !recovered.polygons.facets.is_empty() {
                    // What will be kept are the surface's own triangles.
                    let first = recovered.segments.first_steiner;
                    recovered = self.recover_anew(surface, options, engine, first, &careful, false)?;
                    subfaces = self.recover_facets(surface, &recovered, engine)?;
                }
                let engine = engine.take();
                let patch = fallible::copied(&surface.triangle_patch)?;
                let segments = recovered.segments;
                let d2 = D2 { engine, segments, subfaces, patch, inside: Vec::new(), attempt: 0 };
                return self.without_boundary_points(plc, surface, options, d2).map_err(|other| {
                    if other.status != Status::Rounding {
                        return other;
                    }
                    let hint = "; nor is there room in any mesh without points on the surface";
                    crowding(surface, &places, hint, options.max_defects, self.control)
                });
            }
            let origin = Origin { plc, surface, segments, regions: &regions };
            let mut mesh = match &mut refined {
                None => assemble::mesh(engine, origin, &subfaces, &rounded, self.control)?,
                Some(refined) => self.finish(options, engine, origin, &rounded, refined)?,
            };
            mesh.hull_kept = options.keep_hull;
            self.seeds = warn::about_seeds(plc, &regions, options);
            self.statistics.missing_segments = segments.missing;
            self.statistics.steiner = needed;
            self.statistics.steiner_moved = rounded.moved;
            self.statistics.replaced = rounded.replaced.len() as u64;
            self.statistics.steiner_exact =
                mesh.steiner.iter().filter(|point| point.exact && !point.is_inside()).count() as u64;
            self.lap(Phase::Round);
            return Ok(mesh);
        }
    }
}
