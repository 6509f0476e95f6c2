//! Keeping the surface as it is: a tetrahedralization without points on it.
//!
//! From the constrained Delaunay tetrahedralization, whose Steiner points lie on segments, to one that has every triangle of the
//! surface as a face ([`from_constrained`]): the domain is carved out ([`solid`]), the points on segments are taken away
//! ([`unsplit`]), patches get the surface's triangles again ([`retarget`]), and points inside that are not needed go ([`thin`]).
pub mod cavity;
pub mod center;
pub mod check;
pub mod hollow;
pub mod corridor;
pub mod inside;
pub mod order;
pub mod place;
pub mod polygon;
pub mod recover;
pub mod retarget;
pub mod smooth;
pub mod solid;
pub mod star;
pub mod thin;
pub mod unsplit;

use crate::constrain::edge_key;
use crate::constrain::segment::Segments;
use crate::error::{Defect, DefectKind, Element, Error, Status};
use crate::mesh::NONE;
use crate::output::PreserveStatistics;
use crate::predicates::Points;
use hollow::Growth;
use inside::Inside;
use smooth::smooth;
use retarget::{Retarget, Target};
use rustc_hash::FxHashSet;
use solid::Solid;
use thin::Thin;
use unsplit::{Effort, Outcome, Unsplit};

static T0: std::sync::LazyLock<std::time::Instant> = std::sync::LazyLock::new(std::time::Instant::now);
/// What is tried on points of the surface, in this order.
const EFFORTS: [Effort; 4] = [
    Effort { budget: 200, walls: 3, growth: None, relocate: false },
    Effort { budget: 500, walls: 8, growth: None, relocate: false },
    Effort { budget: 100, walls: 3, growth: Some(GROWTHS[1]), relocate: false },
    Effort { budget: 200, walls: 3, growth: Some(GROWTHS[1]), relocate: true },
];
/// How far stars of points inside grow.
const GROWTHS: [Growth; 3] = [
    Growth { budget: 200, branches: 0, tries: 0 },
    Growth { budget: 100, branches: 8, tries: 24 },
    Growth { budget: 200, branches: 8, tries: 200 },
];
/// Takes all points off the surface; the mesh then has the target's triangles as faces. Returns the points inside.
///
/// # Errors
/// [`Status::Rounding`] if a point inside has no valid position in doubles; [`Status::Cancelled`], [`Status::OutOfMemory`].
pub fn from_constrained(
    solid: &mut Solid,
    points: &mut Points,
    segments: &Segments,
    target: &Target,
    mut inside: Inside,
    statistics: &mut PreserveStatistics,
    tick: &mut dyn FnMut(f64) -> Result<(), Error>,
) -> Result<Inside, Error> {
    inside.sweep(solid);
    T0.elapsed();
    let isolated = unsplit_all(solid, points, segments, target, &mut inside, statistics, tick)?;
    let sp = inside.list.len();
    let flips = Retarget::new(solid, points, &mut inside, &isolated, GROWTHS[0].budget).run(target)?;
    if std::env::var("DBG").is_ok() { eprintln!("inside {sp} {flips:?} {:?}", T0.elapsed()); }
    if flips.missing > 0 {
        return Err(Error::internal(format!("{} triangles of the surface were not reached", flips.missing)));
    }
    let mut thin = Thin::default();
    let growths = match std::env::var("DBGT") { Ok(s) => { let v: Vec<usize> = s.split(',').map(|x| x.parse().unwrap()).collect(); v.chunks(3).map(|v| Growth { budget: v[0] as u32, branches: v[1], tries: v[2] }).collect() } _ => GROWTHS.to_vec() };
    for growth in growths {
        thin.run(solid, points, &mut inside, &isolated, growth)?;
        if std::env::var("DBG").is_ok() { eprintln!("thin {growth:?} {} {:?}", inside.list.len(), T0.elapsed()); }
    }
    smooth(solid, points, &inside)?;
    statistics.interior = inside.list.len() as u64;
    Ok(inside)
}

/// Steiner points and their neighbours on their segments.
struct Along {
    first: u32,
    ends: Vec<[u32; 2]>,
}

impl Along {
    fn new(segments: &Segments) -> Result<Along, Error> {
        let list = segments.steiner_by_segment();
        let mut ends = Vec::new();
        ends.try_reserve(list.len())?;
        ends.resize(list.len(), [NONE; 2]);
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

/// Takes the points on segments away: those that go easily first, the last made first; relocation comes last.
fn unsplit_all(
    solid: &mut Solid,
    points: &mut Points,
    segments: &Segments,
    target: &Target,
    inside: &mut Inside,
    statistics: &mut PreserveStatistics,
    tick: &mut dyn FnMut(f64) -> Result<(), Error>,
) -> Result<FxHashSet<[u32; 2]>, Error> {
    let mut along = Along::new(segments)?;
    let mut wanted: FxHashSet<[u32; 2]> = FxHashSet::default();
    for &[a, b, c] in target.triangles {
        wanted.extend([edge_key(a, b), edge_key(b, c), edge_key(c, a)]);
    }
    let mut isolated: FxHashSet<[u32; 2]> = FxHashSet::default();
    isolated.extend(segments.pieces.iter().map(|piece| edge_key(piece.ends[0], piece.ends[1])));
    let on_facets: FxHashSet<[u32; 2]> =
        solid.patch_of.keys().flat_map(|&[a, b, c]| [[a, b], [b, c], [a, c]]).collect();
    isolated.retain(|edge| !on_facets.contains(edge));
    let mut left: Vec<u32> = Vec::new();
    left.try_reserve(along.ends.len())?;
    left.extend((0..along.ends.len() as u32).rev().map(|i| along.first + i));
    let total = left.len().max(1) as f64;
    let mut unsplit = Unsplit::new(solid, points, &wanted, &mut isolated, inside);
    for effort in EFFORTS {
        loop {
            let before = left.len();
            let mut kept = Vec::new();
            for (i, &v) in left.iter().enumerate() {
                if i % 64 == 0 {
                    tick(1.0 - (before - i + kept.len()) as f64 / total)?;
                }
                if std::env::var("DBGCHECK").is_ok() {
                    check::check_solid(unsplit.solid, unsplit.points)
                        .map_err(|e| Error::internal(format!("{v} {:?}: {e}", kept.last())))?;
                }
                match unsplit.remove(v, along.of(v), effort)? {
                    Outcome::Deleted => statistics.deleted += 1,
                    Outcome::Relocated => statistics.relocated += 1,
                    Outcome::Kept => {
                        kept.push(v);
                        continue;
                    }
                }
                along.remove(v);
            }
            left = kept;
            if std::env::var("DBG").is_ok() { eprintln!("round {effort:?}: {before} -> {} fills {:?}  {:?}", left.len(), unsplit.reconnect_stats(), T0.elapsed()); }
            if left.is_empty() || left.len() == before {
                break;
            }
        }
    }
    if left.is_empty() {
        return Ok(isolated);
    }
    let mut error = Error::new(
        Status::Rounding,
        format!(
            "{} points cannot be taken off the surface: points inside have no valid position",
            left.len()
        ),
    );
    error.defect_count = left.len();
    error.defects = left
        .iter()
        .map(|&v| {
            let segment = segments.steiner_segment[(v - segments.first_steiner) as usize];
            Defect {
                kind: DefectKind::Rounding,
                first: Element::Segment(segment),
                second: None,
                point: Some(*unsplit.points.xyz(v)),
            }
        })
        .collect();
    Err(error)
}
