//! The mesh for input whose constrained Delaunay mesh no doubles make positive.
//!
//! Steiner points on edges have no room if sheets or needles are closer to each other than the spacing of doubles. Without these points
//! nothing has to be rounded. So all are removed from the surface, as in [`Mode::Preserve`](crate::Mode::Preserve); any points inside are
//! doubles from the start. If these have no room either, a small surface is filled as a whole. The mesh conforms to the input like the
//! other one, but not all of its faces are locally Delaunay: tetrahedra at such faces are listed as replaced.
use crate::error::{Error, Status};
use crate::fallible;
use crate::options::{Mode, Options, Preserve};
use crate::output::{Guarantee, TetMesh};
use crate::plan::preserve::Embedded;
use crate::plan::{tetrahedralize, Run};
use crate::plc::surface::Surface;
use crate::plc::Plc;
use crate::predicates::{scale, Points, Sign};
use crate::progress::{Observer, Phase};
use crate::INVALID;
use std::ops::ControlFlow;

impl Run<'_> {
    /// Makes a mesh without points on the surface.
    pub(super) fn without_boundary_points(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        embedded: Embedded,
    ) -> Result<TetMesh, Error> {
        let scale_exponent = embedded.engine.scale;
        let options = Options { preserve: Preserve::All, ..options.clone() };
        let mut mesh = match self.free_surface(plc, surface, &options, embedded) {
            Err(e) if e.status == Status::Rounding => self.whole(plc, surface, &options)?.ok_or(e)?,
            made => made?,
        };
        mesh.guarantee = Guarantee::ConstrainedDelaunay;
        mesh.replaced = not_delaunay(&mesh, scale_exponent)?;
        self.statistics.replaced = mesh.replaced.len() as u64;
        Ok(mesh)
    }
}

/// The error for a surface that cannot be kept, with what mode cdt would do; or what else ends the attempt to find out.
pub(super) fn with_hint(plc: &Plc, options: &Options, error: Error, observer: &mut dyn Observer) -> Error {
    let constrained = Options { mode: Mode::Constrained, ..options.clone() };
    let hint = match tetrahedralize(plc, &constrained, &mut Probe(observer)) {
        Ok(_) => "; mode cdt, which may put points on the surface, meshes it",
        Err(other) if other.status == Status::Rounding => "; nor is there room in mode cdt",
        Err(other) if matches!(other.status, Status::Cancelled | Status::OutOfMemory) => return other,
        Err(_) => "",
    };
    match fallible::text(format_args!("{}{hint}", error.message)) {
        Ok(message) => Error { message: message.into(), ..error },
        Err(short) => short.into(),
    }
}

/// Asks whether to go on; says nothing.
struct Probe<'a>(&'a mut dyn Observer);

impl Observer for Probe<'_> {
    fn progress(&mut self, _: Phase, _: f64) -> ControlFlow<()> {
        self.0.progress(Phase::Preserve, 1.0)
    }
}

/// The tetrahedra at faces that are no subfaces and not locally Delaunay, ascending.
fn not_delaunay(mesh: &TetMesh, scale_exponent: i32) -> Result<Vec<u32>, Error> {
    let mut xyz = Vec::new();
    xyz.try_reserve_exact(mesh.points.len())?;
    xyz.extend(mesh.points.iter().map(|p| p.map(|x| scale(x, scale_exponent))));
    let points = Points::new(xyz);
    let mut walls: Vec<[u32; 2]> = Vec::new();
    walls.try_reserve_exact(mesh.subfaces.len())?;
    walls.extend(mesh.subfaces.iter().map(|face| face.tets).map(|[s, t]| [s.min(t), s.max(t)]));
    walls.sort_unstable();
    let mut list = Vec::new();
    for (t, near) in (0..).zip(&mesh.neighbors) {
        let [a, b, c, d] = mesh.tets[t as usize];
        for &n in near.iter().filter(|&&n| n != INVALID && n > t) {
            let apex = mesh.tets[n as usize].into_iter().find(|v| ![a, b, c, d].contains(v));
            let spoils = apex.is_some_and(|e| points.insphere(a, b, c, d, e) == Sign::Positive);
            if spoils && walls.binary_search(&[t, n]).is_err() {
                list.try_reserve(2)?;
                list.extend([t, n]);
            }
        }
    }
    list.sort_unstable();
    list.dedup();
    Ok(list)
}
