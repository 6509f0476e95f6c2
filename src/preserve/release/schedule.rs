//! Removal of all points from segments: easy ones first, the last added before earlier ones; relocation comes last.
//!
//! For which points inside there is room depends on the order of removal: later attempts
//! ([`Target::attempt`](crate::preserve::release::patches::Target)) have another one.
//!
//! Points that may stay (inside internal facets, where only the outer boundary is kept) go if nothing has to come in their place.
use crate::control::{Control, Part};
use crate::error::Error;
use crate::fallible;
use crate::kernel::edge_key;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::predicates::Points;
use crate::preserve::inside::Inside;
use crate::preserve::memory::Memory;
use crate::preserve::release::segments::{Effort, Outcome, Unsplit};
use crate::preserve::Terms;
use crate::preserve::{BUDGET, SOME};
use crate::segments::recovery::Segments;
use rustc_hash::FxHashSet;

/// What is tried, in this order: the cheapest first, since it is tried at every point. Half of all budgets and double change nothing on
/// eleven models: it only bounds the work on worse ones. Half of all numbers of walls and double change nothing on eleven models: nothing
/// measurable depends on that.
const EFFORTS: [Effort; 4] = [
    Effort { budget: BUDGET, walls: 3, growth: None, relocate: false },
    Effort { budget: 500, walls: 8, growth: None, relocate: false },
    Effort { budget: BUDGET, walls: 3, growth: Some(SOME), relocate: false },
    Effort { budget: BUDGET, walls: 3, growth: Some(SOME), relocate: true },
];

/// The outcome for the points on segments.
#[derive(Debug, Default)]
pub struct Removal {
    /// Points that went without a replacement.
    pub deleted: u64,
    /// Points that points inside replaced.
    pub relocated: u64,
    /// Points that could not be taken away.
    pub left: Vec<u32>,
    /// Pieces of segments on no facet.
    pub isolated: FxHashSet<[u32; 2]>,
    /// Points that stay, ascending.
    pub staying: Vec<u32>,
}

/// Steiner points and their neighbours on their segments.
struct Along {
    first: u32,
    ends: Vec<[u32; 2]>,
}

impl Along {
    fn new(segments: &Segments, control: &Control) -> Result<Along, Error> {
        let list = segments.steiner_by_segment(control)?;
        let mut ends = fallible::filled([NONE; 2], list.len())?;
        for (i, &(s, _, v)) in list.iter().enumerate() {
            let [a, b] = segments.ends[s as usize];
            let before = if i > 0 && list[i - 1].0 == s { list[i - 1].2 } else { a };
            let after = list.get(i + 1).filter(|next| next.0 == s).map_or(b, |next| next.2);
            ends[(v - segments.first_steiner) as usize] = [before, after];
        }
        Ok(Along { first: segments.first_steiner, ends })
    }

    fn of(&self, v: u32) -> [u32; 2] {
        self.ends[(v - self.first) as usize]
    }

    fn remove(&mut self, v: u32) {
        let [a, b] = self.of(v);
        for (end, side, other) in [(a, 1, b), (b, 0, a)] {
            if let Some(ends) = end.checked_sub(self.first).and_then(|i| self.ends.get_mut(i as usize)) {
                ends[side] = other;
            }
        }
    }
}

/// Takes the points on segments away.
pub(in crate::preserve) fn remove_all(
    mesh: &mut Mesh,
    points: &mut Points,
    Terms { segments, target, internal }: Terms,
    inside: &mut Inside,
    part: Part,
) -> Result<Removal, Error> {
    let mut along = Along::new(segments, &part)?;
    // Looked up only where a point goes.
    let count = if along.ends.is_empty() { 0 } else { target.triangles.len() };
    let wanted = edges_of(target.triangles[..count].iter(), &part)?;
    let mut removal = Removal { isolated: isolated_pieces(mesh, segments, &part)?, ..Removal::default() };
    let mut left: Vec<u32> = fallible::collect((0..along.ends.len() as u32).rev().map(|i| along.first + i))?;
    let total = left.len().max(1) as f64;
    let mut counts = [0, 0];
    let mut unsplit = Unsplit::new(mesh, points, &wanted, &mut removal.isolated, inside, &part);
    if target.attempt > 0 {
        left.sort_unstable_by_key(|&v| (shuffled(v - along.first, target.attempt), v));
    }
    for effort in EFFORTS {
        let mut lasting = Memory::default();
        loop {
            let before = left.len();
            let mut kept = fallible::reserved(before)?;
            for (i, &v) in left.iter().enumerate() {
                if i % 16 == 0 {
                    part.progress(1.0 - (before - i + kept.len()) as f64 / total)?;
                }
                part.step()?;
                let stays = effort.relocate && internal.may_stay(v);
                if stays || lasting.knows(unsplit.mesh, v) {
                    fallible::push(&mut kept, v)?;
                } else if !take(&mut unsplit, &mut along, v, effort, &mut counts)? {
                    lasting.note(unsplit.mesh, v, &unsplit.read)?;
                    fallible::push(&mut kept, v)?;
                }
            }
            left = kept;
            if left.is_empty() || left.len() == before {
                break;
            }
        }
    }
    removal.staying = fallible::collect(left.iter().copied().rev().filter(|&v| internal.may_stay(v)))?;
    left.retain(|&v| !internal.may_stay(v));
    removal.left = left;
    [removal.deleted, removal.relocated] = counts;
    Ok(removal)
}

/// A pseudo-random key (with Knuth's multiplier), a different one in each attempt.
fn shuffled(index: u32, attempt: u32) -> u64 {
    let key = (u64::from(attempt) << 32 | u64::from(index)).wrapping_mul(6364136223846793005);
    (key ^ key >> 29).wrapping_mul(6364136223846793005) >> 16
}

/// Takes one point away and counts it as deleted or relocated; false if it stays.
fn take(
    unsplit: &mut Unsplit,
    along: &mut Along,
    v: u32,
    effort: Effort,
    [deleted, relocated]: &mut [u64; 2],
) -> Result<bool, Error> {
    match unsplit.remove(v, along.of(v), effort)? {
        Outcome::Deleted => *deleted += 1,
        Outcome::Relocated => *relocated += 1,
        Outcome::Kept => return Ok(false),
    }
    along.remove(v);
    Ok(true)
}

/// The edges of triangles, in order.
fn edges_of<'a>(
    triangles: impl ExactSizeIterator<Item = &'a [u32; 3]>,
    control: &Control,
) -> Result<Vec<[u32; 2]>, Error> {
    let mut edges = fallible::reserved(3 * triangles.len())?;
    fallible::extend(
        &mut edges,
        triangles.flat_map(|&[a, b, c]| [edge_key(a, b), edge_key(b, c), edge_key(c, a)]),
    )?;
    control.sort(&mut edges)?;
    edges.dedup();
    Ok(edges)
}

/// The pieces of segments that no subface has.
fn isolated_pieces(
    mesh: &Mesh,
    segments: &Segments,
    control: &Control,
) -> Result<FxHashSet<[u32; 2]>, Error> {
    let faces: Vec<[u32; 3]> = fallible::collect(mesh.subfaces().map(|code| mesh.face(code)))?;
    let edges = edges_of(faces.iter(), control)?;
    let mut isolated = FxHashSet::default();
    for piece in &segments.pieces {
        control.step()?;
        let key = edge_key(piece.ends[0], piece.ends[1]);
        if edges.binary_search(&key).is_err() {
            fallible::add(&mut isolated, key)?;
        }
    }
    Ok(isolated)
}
