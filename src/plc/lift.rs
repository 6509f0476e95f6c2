//! What weights of points (see [`Lift`]) must be, and the lifts that follow from them.
use crate::elementary::exponent as exponent_of;
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::fallible;
use crate::options::{Mode, Options};
use crate::output::Lift;
use crate::plc::Plc;
use crate::predicates::{is_offset, scale, Lifts, OFFSET_EXPONENT};

impl Plc {
    /// Refuses weights that are no numbers, and input and modes that have no use for weights.
    ///
    /// # Errors
    /// [`Status::InvalidArgument`].
    pub(crate) fn check_lift(&self, options: &Options) -> Result<(), Error> {
        let refuse = |what: std::fmt::Arguments| Err(Error::new(Status::InvalidArgument, what));
        let name = match self.lift {
            Lift::Plain => return Ok(()),
            Lift::Weights(_) => "weight",
            Lift::Heights(_) => "height",
        };
        let (values, points) = (self.lift.values(), self.points.len());
        if values.len() != points {
            return refuse(format_args!("{} {name}s for {points} points", values.len()));
        }
        if let Some(i) = values.iter().position(|x| !x.is_finite()) {
            return refuse(format_args!("point {i} has the {name} {}, which is not finite", values[i]));
        }
        if self.facet_count() > 0 || !self.segments.is_empty() {
            return refuse(format_args!("{name}s of points: not offered with facets or segments"));
        }
        if options.mode != Mode::Delaunay {
            return refuse(format_args!("{name}s of points: only mode delaunay counts them"));
        }
        Ok(())
    }
}

/// The lifts of these points, whose coordinates are scaled by 2^`exponent`; `coordinates` are those of all points, for the error.
///
/// # Errors
/// [`Status::CoordinateRange`] if exact arithmetic cannot represent a weight beside the coordinates, [`Status::OutOfMemory`].
pub(crate) fn lifts(
    lift: &Lift,
    points: impl IntoIterator<Item = u32>,
    exponent: i32,
    coordinates: &[[f64; 3]],
) -> Result<Lifts, Error> {
    let mut offsets = Vec::new();
    for i in points {
        let value = lift.values().get(i as usize).copied().unwrap_or(0.0);
        // First of all, nothing may overflow: hosts may trap that.
        let fits = exponent_of(value.abs()) + 2 * exponent <= OFFSET_EXPONENT;
        let is_small = value.is_finite() && (value == 0.0 || fits);
        let scaled = if is_small { scale(value, 2 * exponent) } else { f64::NAN };
        if !is_small || !is_offset(scaled) || scale(scaled, -2 * exponent) != value {
            return Err(out_of_range(i, value, coordinates));
        }
        fallible::push(&mut offsets, lift.offset(scaled))?;
    }
    Ok(Lifts::new(offsets, matches!(lift, Lift::Weights(_))))
}

fn out_of_range(i: u32, value: f64, coordinates: &[[f64; 3]]) -> Error {
    let (kind, first) = (DefectKind::CoordinateRange, Element::Point(i));
    let defect = Defect { kind, first, second: None, point: coordinates.get(i as usize).copied() };
    let text = format_args!(
        "the weight or height {value:e} of point {i} is too far from the squares of the coordinates"
    );
    Error::with_defect(Status::CoordinateRange, text, defect)
}
