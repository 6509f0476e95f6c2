//! Fans: elements that have one vertex, their *apex*, in common. All their boxes meet there, so boxes alone leave a quadratic number of
//! pairs. Such elements are separated by the directions in which they leave the apex.
//!
//! Let two elements with the common vertex `v` have another point `x` in common. Both are convex, so the direction from `v` to
//! `x` is one in which either of them leaves `v`. Elements that leave it in disjoint sets of directions therefore meet only in `v`, which
//! is no contact. So two elements of one fan, or two subtrees of them, need no test if the boxes around their sets of directions are apart.
//! (For two elements this is sharper than comparing what lies opposite the apex, since the distance from it does not matter.)
//!
//! Directions are points of the unit sphere: one for a segment, for a triangle the arc between two. An arc over a chord of
//! length L < 2 rises 1 − √(1 − L²/4) <= L²/4 above it, so the box of its ends, enlarged by that, contains it. The box is rounded outwards
//! by more than the errors of the ends.
//!
//! Two fans with apexes `v` and `w`, like the side and the base of a cone, are separated by directions around the axis `a = w − v`. A
//! common point is `v + α d = w + β d′` with α, β >= 0 and directions d, d′ of the two elements, so α (a × d) = β (a × d′). If for all d,
//! d′ of two boxes the determinant (a, d, d′) is not zero, or (a × d)·(a × d′) is negative, these products are neither zero nor of the same
//! direction. That leaves α = β = 0, which would make the apexes equal, so the elements are disjoint.
//!
//! An element is in the fan of its corner with the most elements, if there are [`MANY`] of them, otherwise in none. Pairs in which one
//! element is in no fan are separated only by their boxes. Many triangles at one edge are still quadratic.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::intersect::boxtree::{morton_code, Bounds, Frame};
use crate::plc::intersect::IntersectInput;
use crate::vector::{cross, dot};
use crate::INVALID;

/// How many elements at a vertex make a fan. Ordinary surfaces have about six, seldom more than twenty; with fewer than this, a fan has too
/// few pairs for its own tree to pay off.
const MANY: u32 = 32;

/// An element of a fan, or a subtree of such elements.
#[derive(Clone, Copy, Debug)]
pub(super) struct Member {
    /// The fan's vertex; [`INVALID`] for a subtree whose elements are not all in one fan.
    apex: u32,
    at: [f64; 3],
    /// A box around all directions in which it leaves the apex; the sphere of directions is mapped to the unit cube.
    directions: Bounds,
}

impl Member {
    /// A subtree whose elements are not all in one fan.
    pub(super) const MIXED: Member = Member { apex: INVALID, at: [0.0; 3], directions: Bounds::EMPTY };

    /// The member for two subtrees together.
    pub(super) fn union(&self, other: &Member) -> Member {
        if self.apex != other.apex {
            return Member::MIXED;
        }
        Member { directions: self.directions.union(&other.directions), ..*self }
    }

    /// Whether two elements, or any elements of two subtrees, are known to meet only in a common apex or not at all.
    #[inline]
    pub(super) fn apart(&self, other: &Member) -> bool {
        if self.apex == INVALID || other.apex == INVALID {
            return false;
        }
        if self.apex == other.apex {
            return !self.directions.meets(&other.directions);
        }
        self.apart_around_axis(other)
    }

    /// The same for two fans, by the directions around the axis from apex to apex.
    #[inline(never)]
    fn apart_around_axis(&self, other: &Member) -> bool {
        let Some(axis) = direction(&self.at, &other.at) else {
            return false;
        };
        // Every direction differs from its box's centre by less than the spread.
        let ((c, s), (d, t)) = (self.centre(), other.centre());
        let (p, q) = (cross(&axis, &c), cross(&axis, &d));
        let size = axis.map(f64::abs);
        let (e, f) = (cross_bound(&size, &s), cross_bound(&size, &t));
        // (a, c + δ, d + ε) = (a, c, d) − δ·(a × d) + ε·(a × c) + a·(δ × ε).
        let det_bound =
            dot(&s, &q.map(f64::abs)) + dot(&t, &p.map(f64::abs)) + dot(&size, &cross_bound(&s, &t));
        let dot_bound = dot(&e, &q.map(f64::abs)) + dot(&f, &p.map(f64::abs)) + dot(&e, &f);
        dot(&p, &d).abs() > det_bound + ERROR || dot(&p, &q) < -(dot_bound + ERROR)
    }

    /// The centre of the box of directions, and the largest distance of a direction from it along each axis.
    fn centre(&self) -> ([f64; 3], [f64; 3]) {
        /// More than twice the error of rounding to single precision, below 2^-24 in the unit cube.
        const SINGLE: f64 = 1.0 / 4_194_304.0;
        let (low, high) = self.directions.corners();
        let centre = std::array::from_fn(|k| low[k] + high[k] - 1.0);
        (centre, std::array::from_fn(|k| high[k] - low[k] + SINGLE))
    }
}

/// The elements of all fans, fan by fan, ordered so that near directions are near each other.
#[derive(Default)]
pub(super) struct Fans {
    /// The elements' indices.
    pub(super) elements: Vec<u32>,
    /// Their fan members.
    pub(super) members: Vec<Member>,
}

impl Fans {
    /// The fans of an input; `valence` has the number of elements at each point. Triangles are numbered first, then segments.
    pub(super) fn new(input: &IntersectInput, valence: &[u32], control: &Control) -> Result<Fans, Error> {
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
            control.step()?;
            let directions = directions(input.points, apex, corners);
            fallible::push(&mut found, (apex, morton_code(&directions), element, directions))?;
        }
        control.sort_by(&mut found, |x, y| (x.0, x.1, x.2).cmp(&(y.0, y.1, y.2)))?;
        fans.elements.try_reserve_exact(found.len())?;
        fans.members.try_reserve_exact(found.len())?;
        for (apex, _, element, directions) in found {
            fallible::push(&mut fans.elements, element)?;
            fallible::push(&mut fans.members, Member { apex, at: input.points[apex as usize], directions })?;
        }
        Ok(fans)
    }
}

/// Above all rounding errors of unit vectors, some 2^-49, and of sums of a few of their products.
const ERROR: f64 = 1.0 / 1_099_511_627_776.0;

/// A box around the directions in which the segment or triangle with these corners leaves its corner `apex`.
fn directions(points: &[[f64; 3]], apex: u32, corners: &[u32]) -> Bounds {
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

/// Maps the unit sphere into the unit cube.
const SPHERE: Frame = Frame::new([-1.0; 3], 2.0);

/// The unit vector from one point towards another, rounded; `None` if it is undefined in doubles.
fn direction(from: &[f64; 3], to: &[f64; 3]) -> Option<[f64; 3]> {
    let d: [f64; 3] = std::array::from_fn(|k| to[k] - from[k]);
    let largest = d.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    // So that no square overflows, or vanishes next to the others.
    let d = d.map(|x| x / largest);
    let length = d.iter().map(|x| x * x).sum::<f64>().sqrt();
    Some(d.map(|x| x / length))
}

/// Bounds on the components of the cross product of vectors with these bounds on their components.
fn cross_bound(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] + a[2] * b[1], a[2] * b[0] + a[0] * b[2], a[0] * b[1] + a[1] * b[0]]
}
