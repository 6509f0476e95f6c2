//! Fans: elements that have one vertex, their *apex*, in common. All their boxes meet there, so boxes alone leave a quadratic
//! number of pairs; what tells such elements apart is the directions in which they leave the apex.
//!
//! Let two elements with the common vertex `v` have another point `x` in common. Both are convex, so the direction from `v` to
//! `x` is one in which either of them leaves `v`. Elements that leave it in disjoint sets of directions therefore meet in `v`
//! alone, which is a contact of no kind. So two elements of one fan, or two subtrees of them, need no look if boxes around their
//! sets of directions are apart. (For two elements this is sharper than to compare what lies opposite the apex: the distance from
//! it does not matter.)
//!
//! Directions are points of the unit sphere: one for a segment, for a triangle the arc between two. An arc over a chord of
//! length L < 2 rises 1 − √(1 − L²/4) <= L²/4 above it, so the box of its ends, enlarged by that, holds it. The box is rounded
//! outwards by more than the errors of the ends.
//!
//! An element is in the fan of that corner which has the most elements, if these are [`MANY`]; else in none. Pairs of
//! elements in different fans, or of which one is in none, are told apart by their boxes only. Still quadratic are many
//! triangles at one edge, and two fans with their apexes so close that all boxes meet.
use super::boxtree::{morton_code, Bounds, Frame};
use super::IntersectInput;
use crate::error::Error;
use crate::INVALID;

/// How many elements at a vertex make a fan. Ordinary surfaces have six, and seldom more than twenty; below this, the pairs of a fan
/// are too few for a tree of their own to pay.
const MANY: u32 = 32;

/// An element of a fan, or a subtree of such.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    /// The fan's vertex; [`INVALID`] for a subtree whose elements are not all in one fan.
    apex: u32,
    /// A box around all directions in which it leaves the apex, the sphere of directions in the unit cube.
    directions: Bounds,
}

impl Member {
    /// A subtree whose elements are not all in one fan.
    pub(super) const MIXED: Member = Member { apex: INVALID, directions: Bounds::EMPTY };

    /// What two subtrees are together.
    pub(super) fn union(&self, other: &Member) -> Member {
        if self.apex != other.apex {
            return Member::MIXED;
        }
        Member { apex: self.apex, directions: self.directions.union(&other.directions) }
    }

    /// Whether two elements, or any two of two subtrees, are known to meet in their common apex only.
    #[inline]
    pub(super) fn apart(&self, other: &Member) -> bool {
        self.apex == other.apex && self.apex != INVALID && !self.directions.meets(&other.directions)
    }
}

/// The elements of all fans, fan by fan, near directions near each other.
#[derive(Default)]
pub(super) struct Fans {
    /// The elements' indices.
    pub(super) elements: Vec<u32>,
    /// What they are in the fans.
    pub(super) members: Vec<Member>,
}

impl Fans {
    /// The fans of an input; `valence` tells how many elements are at each point. Elements are numbered triangles first, then
    /// segments.
    pub(super) fn new(input: &IntersectInput, valence: &[u32]) -> Result<Fans, Error> {
        let mut fans = Fans::default();
        if valence.iter().all(|&count| count < MANY) {
            return Ok(fans);
        }
        let mut found: Vec<(u32, u64, u32, Bounds)> = Vec::new();
        let triangles = input.triangles.iter().map(|t| &t[..]);
        let corners = triangles.chain(input.segments.iter().map(|s| &s[..]));
        for (element, corners) in (0..).zip(corners) {
            let most = corners.iter().map(|&v| (valence[v as usize], std::cmp::Reverse(v))).max();
            let Some((MANY.., std::cmp::Reverse(apex))) = most else { continue };
            let directions = directions(input.points, apex, corners);
            found.try_reserve(1)?;
            found.push((apex, morton_code(&directions), element, directions));
        }
        found.sort_unstable_by_key(|&(apex, code, element, _)| (apex, code, element));
        fans.elements.try_reserve_exact(found.len())?;
        fans.members.try_reserve_exact(found.len())?;
        for (apex, _, element, directions) in found {
            fans.elements.push(element);
            fans.members.push(Member { apex, directions });
        }
        Ok(fans)
    }
}

/// A box around the directions in which the segment or triangle with these corners leaves its corner `apex`.
fn directions(points: &[[f64; 3]], apex: u32, corners: &[u32]) -> Bounds {
    /// Above all rounding errors of the ends, some 2^-49, and of the square of their distance.
    const ERROR: f64 = 1.0 / 1_099_511_627_776.0;
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for &v in corners.iter().filter(|&&v| v != apex) {
        let Some(unit) = direction(&points[apex as usize], &points[v as usize]) else {
            // The whole sphere.
            (low, high) = ([-1.0; 3], [1.0; 3]);
            break;
        };
        for k in 0..3 {
            low[k] = low[k].min(unit[k]);
            high[k] = high[k].max(unit[k]);
        }
    }
    // Each end is at a corner of this box or its mirror image: the diagonal is the chord.
    let chord_squared: f64 = (0..3).map(|k| (high[k] - low[k]) * (high[k] - low[k])).sum();
    let margin = 0.25 * chord_squared + ERROR;
    SPHERE.bounds([low.map(|x| x - margin), high.map(|x| x + margin)].iter())
}

/// Takes the unit sphere into the unit cube.
const SPHERE: Frame = Frame::new([-1.0; 3], 2.0);

/// The unit vector from one point towards another, rounded; none where it has no sense in doubles.
fn direction(from: &[f64; 3], to: &[f64; 3]) -> Option<[f64; 3]> {
    let d: [f64; 3] = std::array::from_fn(|k| to[k] - from[k]);
    let largest = d.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // No square overflows or vanishes beside the others.
    let d = d.map(|x| x / largest);
    let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(d.map(|x| x / length))
}
