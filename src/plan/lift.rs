//! Weighted points: from the input's weights to the lifts of the engine.
//!
//! Equal points count as one, with the largest of their weights (the smallest of their heights): the others would be hidden. Equal weights
//! cancel, so the engine gets none, and takes the faster way.
use crate::control::Control;
use crate::error::Error;
use crate::output::Lift;
use crate::plan::Engine;
use crate::plc::lift::lifts;
use crate::plc::Plc;

/// Lifts the engine's points; returns the weights that count, one per input point.
///
/// # Errors
/// `CoordinateRange` if exact arithmetic cannot represent a weight beside the coordinates, `OutOfMemory`.
pub(super) fn lift(engine: &mut Engine, plc: &Plc, alias: &[u32], control: &Control) -> Result<Lift, Error> {
    let mut lift = plc.lift.try_clone()?;
    lift.merge(alias);
    let value = |i: &u32| lift.values().get(*i as usize).copied();
    let first = engine.input_of.first().and_then(value);
    let cancel = matches!(lift, Lift::Weights(_)) && engine.input_of.iter().all(|i| value(i) == first);
    if lift.is_plain() || cancel {
        return Ok(lift);
    }
    control.look()?;
    control.room(engine.points.len() * size_of::<f64>())?;
    engine.points.lift(lifts(&lift, engine.input_of.iter().copied(), engine.scale, &plc.points)?);
    control.look()?;
    Ok(lift)
}
