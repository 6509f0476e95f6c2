//! The net flips: those that remain when flips that undo each other are dropped.
//!
//! Flips of different triangles commute. So a flip and a later one that undoes it cancel if no remaining flip between them touches one of
//! the two triangles.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::output::FacetFlip;
use crate::INVALID;
use rustc_hash::FxHashMap;

/// The flips of a list without the pairs that cancel, in order.
///
/// # Errors
/// What ends the run, [`Status::OutOfMemory`](crate::Status::OutOfMemory).
pub fn net_flips(flips: &[FacetFlip], control: &Control) -> Result<Vec<FacetFlip>, Error> {
    // Each kept flip, and the kept flip before it at each of its facets.
    let mut kept: Vec<(FacetFlip, [u32; 2])> = fallible::reserved(flips.len())?;
    let mut is_dropped: Vec<bool> = fallible::reserved(flips.len())?;
    // The last flip kept at each facet. Only looked up, never iterated.
    let mut last: FxHashMap<u32, u32> = FxHashMap::default();
    for flip in flips {
        control.step()?;
        let before = flip.facets.map(|facet| last.get(&facet).copied().unwrap_or(INVALID));
        let [k, other] = before;
        if k == other && kept.get(k as usize).is_some_and(|(earlier, _)| takes_back(earlier, flip)) {
            let (earlier, before) = kept[k as usize];
            is_dropped[k as usize] = true;
            for (facet, flip) in earlier.facets.into_iter().zip(before) {
                fallible::insert(&mut last, facet, flip)?;
            }
            continue;
        }
        for facet in flip.facets {
            fallible::insert(&mut last, facet, kept.len() as u32)?;
        }
        fallible::push(&mut kept, (*flip, before))?;
        fallible::push(&mut is_dropped, false)?;
    }
    let mut net: Vec<FacetFlip> = fallible::reserved(is_dropped.iter().filter(|&&dropped| !dropped).count())?;
    fallible::extend(&mut net, kept.iter().zip(&is_dropped).filter(|x| !x.1).map(|x| x.0 .0))?;
    Ok(net)
}

/// Whether the second of two flips of the same two facets restores the old edge and gives each facet its own triangle back: after a flip,
/// the triangle with the first end of the old edge belongs to the first facet.
fn takes_back(first: &FacetFlip, second: &FacetFlip) -> bool {
    let same = |[a, b]: [u32; 2], [c, d]: [u32; 2]| [a, b] == [c, d] || [a, b] == [d, c];
    // The apex, opposite the old edge, of the first facet before the first flip is `new[0]`.
    let gets_apex = if second.facets[0] == first.facets[0] { second.old[0] } else { second.old[1] };
    same(first.old, second.new) && same(first.new, second.old) && gets_apex == first.new[0]
}
