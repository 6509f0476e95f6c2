//! Circumcentres and power centres of tetrahedra, and normals of triangles, in doubles: information, no decision rests on them.
//!
//! A centre is correctly rounded: each coordinate is the double nearest to the exact one, ties to even. It is computed relative to the last
//! vertex d, as the solution x of `2 (p − d)·x = lift(p) − lift(d)` for the three others: `x = N / 2 D` by Cramer's rule, in pairs of doubles
//! (Dekker 1971), which have about 104 bits. If the bound on their error leaves room for another double (Ziv's test), integers decide.
//!
//! Bounds: a product or sum of pairs is off by less than 2^-102 of the product or of the sum of magnitudes; differences of coordinates are
//! exact. Monomials of D and N pass through 5 and 9 of these (see `filter` for the argument), so the errors are below `LOSS` times 6 XYZ and
//! 6 YZ L, L a bound on lifts.

use crate::elementary::{exponent, power_of_two, quotient};
use crate::predicates::big::Big;
use crate::predicates::exact::{center_of, normal_of};
use crate::predicates::expansion::{fast_two_sum, two_product, two_sum};
use crate::predicates::filter::{larger, Spread};
use crate::predicates::range::scale;
use crate::predicates::Points;

/// Far above 9 times 2^-102; the rest covers the rounding of bounds.
const LOSS: f64 = 1.0 / (1u128 << 97) as f64;
/// What underflow may take from products of subnormal weights: with the other factors, at most `2^403` each, far below the unit of any
/// centre that is not zero.
const LOST: f64 = f64::MIN_POSITIVE;

/// The sum of two doubles, the second at most half an ulp of the first.
#[derive(Clone, Copy)]
struct Pair {
    high: f64,
    low: f64,
}

impl Pair {
    #[inline(always)]
    fn difference(a: f64, b: f64) -> Pair {
        let (high, low) = two_sum(a, -b);
        Pair { high, low }
    }

    #[inline(always)]
    fn plus(self, other: Pair) -> Pair {
        let (high, low) = two_sum(self.high, other.high);
        let (high, low) = fast_two_sum(high, low + (self.low + other.low));
        Pair { high, low }
    }

    #[inline(always)]
    fn minus(self, other: Pair) -> Pair {
        self.plus(Pair { high: -other.high, low: -other.low })
    }

    #[inline(always)]
    fn times(self, other: Pair) -> Pair {
        let (high, low) = two_product(self.high, other.high);
        let (high, low) = fast_two_sum(high, low + (self.high * other.low + self.low * other.high));
        Pair { high, low }
    }

    /// The quotient, if it is of moderate size.
    #[inline(always)]
    fn over(self, other: Pair) -> Option<Pair> {
        let first = quotient(self.high, other.high).filter(|q| q.abs() < power_of_two(400))?;
        let rest = self.minus(other.times(Pair { high: first, low: 0.0 }));
        let (high, low) = fast_two_sum(first, quotient(rest.high, other.high)?);
        Some(Pair { high, low })
    }
}

#[inline(always)]
fn cross(u: &[Pair; 3], v: &[Pair; 3]) -> [Pair; 3] {
    let minor = |i: usize, j: usize| u[i].times(v[j]).minus(u[j].times(v[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}

#[inline(always)]
fn dot(u: &[Pair; 3], v: &[Pair; 3]) -> Pair {
    u[0].times(v[0]).plus(u[1].times(v[1])).plus(u[2].times(v[2]))
}

impl Points {
    /// The point with equal (power) distances from the corners of a tetrahedron that is not flat, times 2^`unscale`: each coordinate correctly
    /// rounded, infinite if it is beyond the range of doubles. All points must be explicit.
    pub fn power_center(&self, tet: [u32; 4], unscale: i32) -> [f64; 3] {
        let points = tet.map(|i| self.xyz(i));
        let (offsets, squares) = match &self.lifts {
            Some(lifts) => (tet.map(|i| lifts.of(i)), lifts.squares),
            None => ([0.0; 4], true),
        };
        match quick_center(points, offsets, squares) {
            Some(center) if unscale == 0 => center,
            // Scaling rounds no number that stays normal.
            Some(center) if center.iter().all(|&x| x == 0.0 || stays_normal(x, unscale)) => {
                center.map(|x| scale(x, unscale))
            }
            _ => center_of(points, offsets, squares, unscale),
        }
    }

    /// The unit normal of a triangle, `(b − a) × (c − a)` over its length, within a few ulps. All points must be explicit.
    pub fn unit_normal(&self, triangle: [u32; 3]) -> [f64; 3] {
        let points @ [a, b, c] = triangle.map(|i| self.xyz(i));
        let edge = |p: &[f64; 3]| [0, 1, 2].map(|k| Pair::difference(p[k], a[k]));
        let quick = cross(&edge(b), &edge(c)).map(|x| x.high);
        let Spread { size: [x, y, z], .. } = Spread::of([b, c, a]);
        let most = |n: &[f64; 3]| n.iter().fold(0.0, |most, &x| larger(x.abs(), most));
        // A nearly flat triangle has few of its bits right.
        let is_sure = most(&quick) > larger(larger(x * y, y * z), z * x) * power_of_two(-40);
        let normal = if is_sure { quick } else { normal_of(points) };
        let factor = power_of_two(-exponent(larger(most(&normal), f64::MIN_POSITIVE)));
        let n = normal.map(|x| x * factor);
        let length = (n[0] * n[0] + n[1] * n[1] + n[2] * n[2]).sqrt();
        n.map(|x| quotient(x, length).unwrap_or(0.0))
    }
}

fn stays_normal(x: f64, unscale: i32) -> bool {
    (-1000..1000).contains(&(exponent(x) + unscale)) && x.is_normal()
}

/// The centre where pairs of doubles are certain of it.
fn quick_center([a, b, c, d]: [&[f64; 3]; 4], offsets: [f64; 4], squares: bool) -> Option<[f64; 3]> {
    let row = |p: &[f64; 3]| [0, 1, 2].map(|k| Pair::difference(p[k], d[k]));
    let rows @ [u, v, w] = [row(a), row(b), row(c)];
    let lift = |i: usize| {
        let offset = Pair::difference(offsets[i], offsets[3]);
        if squares {
            dot(&rows[i], &rows[i]).plus(offset)
        } else {
            offset
        }
    };
    let (vw, wu, uv) = (cross(&v, &w), cross(&w, &u), cross(&u, &v));
    let half = dot(&u, &vw);
    let det = Pair { high: 2.0 * half.high, low: 2.0 * half.low };
    let size = Spread::of([a, b, c, d]).size;
    let [x, y, z] = size;
    let offset = (0..3).fold(0.0, |most, i| larger((offsets[i] - offsets[3]).abs(), most));
    let l = if squares { x * x + y * y + z * z + offset } else { offset };
    let det_error = LOSS * (12.0 * (x * y * z));
    if det.high.abs() <= 4.0 * det_error {
        return None;
    }
    let lifts = [lift(0), lift(1), lift(2)];
    let mut center = [0.0; 3];
    for (k, to) in center.iter_mut().enumerate() {
        let n = dot(&lifts, &[vw[k], wu[k], uv[k]]);
        let n_error = LOSS * (6.0 * (size[(k + 1) % 3] * size[(k + 2) % 3] * l)) + LOST;
        let x = n.over(det)?;
        let error = quotient(n_error + x.high.abs() * det_error, det.high.abs() - det_error)?;
        let base = if squares { d[k] } else { 0.0 };
        let sum = x.plus(Pair { high: base, low: 0.0 });
        let error = 1.01 * error + LOSS * (x.high.abs() + base.abs());
        if sum.high + (sum.low + error) != sum.high || sum.high + (sum.low - error) != sum.high {
            return None;
        }
        *to = sum.high;
    }
    Some(center)
}

/// A number for which a big integer stands, in units of 2^`exponent`.
pub(super) fn nearest<const ROOM: usize>(n: &Big<ROOM>, exponent: i32) -> f64 {
    n.ratio(&Big::<3>::of_double(1.0, 0), exponent)
}
