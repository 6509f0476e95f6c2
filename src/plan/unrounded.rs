//! The mesh for input whose constrained Delaunay mesh no doubles make positive.
//!
//! Steiner points on edges have no room if sheets or needles are closer to each other than the spacing of doubles. Without these points
//! nothing has to be rounded. So all are removed from the surface, as in [`Mode::Preserve`](crate::Mode::Preserve); any points inside are
//! doubles from the start. If these have no room either, a small surface is filled as a whole. The mesh conforms to the input like the
//! other one, but not all of its faces are locally Delaunay: tetrahedra at such faces are listed as replaced.
use crate::control::Control;
use crate::error::{Error, Status};
use crate::fallible;
use crate::options::{Mode, Options, Preserve};
use crate::output::{Guarantee, TetMesh};
use crate::plan::preserve::D2;
use crate::plan::{tetrahedralize_with, Run};
use crate::plc::surface::Surface;
use crate::plc::Plc;
use crate::predicates::{scale, Points, Sign};
use crate::INVALID;
use std::borrow::Cow;

impl Run<'_> {
    /// Makes a mesh without points on the surface.
    pub(super) fn without_boundary_points(
        &mut self,
        plc: &Plc,
        surface: &Surface,
        options: &Options,
        d2: D2,
    ) -> Result<TetMesh, Error> {
        let scale_exponent = d2.engine.scale;
        let options = Options { preserve: Preserve::All, ..options.copied() };
        let mut mesh = match self.free_surface(plc, surface, &options, d2) {
            Err(e) if e.status == Status::Rounding => self.whole(plc, surface, &options)?.ok_or(e)?,
            made => made?,
        };
        mesh.guarantee = Guarantee::ConstrainedDelaunay;
        mesh.replaced = not_delaunay(&mesh, scale_exponent, self.control)?;
        self.statistics.replaced = mesh.replaced.len() as u64;
        Ok(mesh)
    }
}

/// The error for a surface that cannot be kept, with what mode cdt would do; or what else ends the attempt to find out.
pub(super) fn with_hint(plc: &Plc, options: &Options, error: Error, control: &Control) -> Error {
    let constrained = Options {
        mode: Mode::Constrained,
        size: None,
        max_volume: None,
        size_function: None,
        quality: None,
        optimize: 0,
        optimize_seconds: None,
        min_angle: None,
        ..options.copied()
    };
    let hint = match control.muted(|| tetrahedralize_with(plc, &constrained, control)) {
        Ok(_) => "; mode cdt, which may put points on the surface, meshes it",
        Err(other) if other.status == Status::Rounding => "; nor is there room in mode cdt",
        Err(other) if other.status.is_final() => return other,
        Err(_) => "",
    };
    match fallible::text(format_args!("{}{hint}", error.message)) {
        Ok(message) => Error { message: Cow::Owned(message), ..error },
        Err(short) => Error::from(short),
    }
}

/// The tetrahedra at faces that are no subfaces and not locally Delaunay, ascending.
fn not_delaunay(mesh: &TetMesh, scale_exponent: i32, control: &Control) -> Result<Vec<u32>, Error> {
    let xyz = fallible::collect(mesh.points.iter().map(|p| p.map(|x| scale(x, scale_exponent))))?;
    let points = Points::new(xyz);
    let mut walls: Vec<[u32; 2]> =
        fallible::collect(mesh.subfaces.iter().map(|face| face.tets).map(|[s, t]| [s.min(t), s.max(t)]))?;
    walls.sort_unstable();
    let mut list = Vec::new();
    for (t, near) in (0..).zip(&mesh.neighbors) {
        control.step()?;
        let [a, b, c, d] = mesh.tets[t as usize];
        for &n in near.iter().filter(|&&n| n != INVALID && n > t) {
            let apex = mesh.tets[n as usize].into_iter().find(|v| ![a, b, c, d].contains(v));
            let spoils = apex.is_some_and(|e| points.insphere(a, b, c, d, e) == Sign::Positive);
            if spoils && walls.binary_search(&[t, n]).is_err() {
                fallible::extend(&mut list, [t, n])?;
            }
        }
    }
    list.sort_unstable();
    list.dedup();
    Ok(list)
}
