//! Efforts for an angle that is wanted: if one does not reach it, the next one begins from the start again, and the best counts.
//!
//! Hill climbing ends where no step helps, and from what a smaller effort has left larger ones need not get out: nested, filled with gradation
//! 1, stays at 10° after effort 1, and effort 2 alone reaches 23°. So what is reached is never below what one of these efforts reaches alone.
use super::slide::Slides;
use super::{Optimise, Subject, LEVELS};
use crate::control::Part;
use crate::error::Error;
use crate::kernel::Mesh;
use crate::output::OptimizeStatistics;
use crate::predicates::Points;
use crate::preserve::inside::Inside;

/// How much is done, and what for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Aims {
    pub effort: u32,
    /// Of the smallest angle that is wanted, or 0.
    pub sine: f64,
}

/// Optimises with an effort; then, if something is below the sine that is wanted, with larger ones.
pub(super) fn aim(
    mut subject: Subject,
    aims: Aims,
    part: Part,
    prepare: &dyn Fn(&mut Optimise) -> Result<(), Error>,
) -> Result<OptimizeStatistics, Error> {
    let last = if aims.sine > 0.0 { LEVELS.len() as u32 } else { aims.effort };
    let more = aims.effort + 1..=last;
    let mut best: Option<(f64, State, OptimizeStatistics)> = None;
    let start = match more.is_empty() {
        true => None,
        false => Some(State::of(&subject)?),
    };
    for effort in std::iter::once(aims.effort).chain(more) {
        let mut optimise = Optimise::new(subject.again(), part)?;
        prepare(&mut optimise)?;
        let worst = optimise.run(Aims { effort, ..aims })?;
        let steps = optimise.steps;
        let (Some(start), true) = (&start, worst < aims.sine) else {
            // Reached, or there is only this one.
            return Ok(steps);
        };
        let mut state = start.copied()?;
        state.swap(&mut subject);
        if best.as_ref().is_none_or(|best| worst > best.0) {
            best = Some((worst, state, steps));
        }
    }
    let Some((_, mut state, steps)) = best else { return Ok(OptimizeStatistics::default()) };
    state.swap(&mut subject);
    Ok(steps)
}

/// A mesh at some time.
struct State {
    mesh: Mesh,
    points: Points,
    inside: Inside,
    slides: Option<Slides>,
}

impl State {
    /// What there is now.
    fn of(subject: &Subject) -> Result<State, Error> {
        Ok(State {
            mesh: subject.mesh.copied()?,
            points: subject.points.copied()?,
            inside: subject.inside.copied()?,
            slides: subject.slides.as_ref().map(|slides| slides.copied()).transpose()?,
        })
    }

    fn copied(&self) -> Result<State, Error> {
        Ok(State {
            mesh: self.mesh.copied()?,
            points: self.points.copied()?,
            inside: self.inside.copied()?,
            slides: self.slides.as_ref().map(Slides::copied).transpose()?,
        })
    }

    /// Changes places with what there is now.
    fn swap(&mut self, subject: &mut Subject) {
        std::mem::swap(&mut self.mesh, subject.mesh);
        std::mem::swap(&mut self.points, subject.points);
        std::mem::swap(&mut self.inside, subject.inside);
        if let (Some(own), Some(there)) = (&mut self.slides, &mut subject.slides) {
            std::mem::swap(own, *there);
        }
    }
}
