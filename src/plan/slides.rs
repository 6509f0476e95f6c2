//! Which points of a refined surface may slide on it while the mesh is optimised, and what is recorded of them then.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::fill::LARGE;
use crate::optimise::slide::{Largest, Slider, Slides, Track};
use crate::plan::Engine;
use crate::refine::facet::{Frames, Wish, Wishes};
use crate::refine::OnFacet;
use crate::segments::recovery::Segments;
use crate::size::BELOW;

/// What points on facets lie on, and what is wanted there.
pub(super) struct Facets<'a> {
    /// The points.
    pub on_facets: &'a [OnFacet],
    /// By patch.
    pub frames: &'a Frames,
    /// By patch.
    pub wishes: &'a Wishes,
}

/// The points that were added on segments and on facets, all at their exact positions; `None` if there are none. Those on a segment stay if
/// a parameter there is the sum of several doubles: so close to each other are they that doubles leave no room.
///
/// # Errors
/// `OutOfMemory`, and what ends the run.
pub(super) fn slides(
    engine: &Engine,
    segments: &Segments,
    facets: Facets,
    control: &Control,
) -> Result<Option<Slides>, Error> {
    let mut list = on_segments(segments, control)?;
    for &OnFacet { v, patch } in facets.on_facets {
        control.step()?;
        if let Some(frame) = facets.frames.of(patch) {
            fallible::push(&mut list, Slider { v, track: Track::Facet { frame, patch }, moved: false })?;
        }
    }
    if list.is_empty() {
        return Ok(None);
    }
    control.sort_by(&mut list, |x, y| x.v.cmp(&y.v))?;
    let wanted = |wish: &Wish| Largest { area: BELOW * wish.area, radius: LARGE * wish.length };
    let largest = fallible::collect(facets.wishes.list().iter().map(wanted))?;
    control.room(engine.points.len() * size_of::<[f64; 3]>())?;
    let exact = engine.points.copied()?;
    Slides::new(exact, segments.first_steiner, list, largest, engine.scale).map(Some)
}

/// The points on segments, each between its neighbours.
fn on_segments(segments: &Segments, control: &Control) -> Result<Vec<Slider>, Error> {
    let points = segments.steiner_by_segment(control)?;
    let mut list = fallible::reserved(points.len())?;
    for chain in points.chunk_by(|x, y| x.0 == y.0) {
        control.step()?;
        if chain.iter().any(|x| segments.fine.contains_key(&(x.2 - segments.first_steiner))) {
            continue;
        }
        let ends = segments.ends[chain[0].0 as usize];
        for (i, &(_, t, v)) in chain.iter().enumerate() {
            let before = if i == 0 { ends[0] } else { chain[i - 1].2 };
            let after = chain.get(i + 1).map_or(ends[1], |next| next.2);
            let track = Track::Segment { ends, between: [before, after], t };
            fallible::push(&mut list, Slider { v, track, moved: false })?;
        }
    }
    Ok(list)
}
