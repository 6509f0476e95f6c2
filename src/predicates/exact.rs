//! The determinants in big integers: the last resort, for points that span too many bits for anything else.
//!
//! Room: coordinates of points in the store are multiples of `2^-1014` up to `2^201` (see `range`), so their differences have at most 1217
//! bits, 39 digits, and a factor of a determinant takes as many digits again.

use crate::predicates::big::Big;
use crate::predicates::center::nearest;
use crate::predicates::{range, Sign};

/// A coordinate or the difference of two, and products of as many as the name says.
pub(crate) type One = Big<40>;
type Two = Big<80>;
type Three = Big<120>;
type Four = Big<160>;

/// The same if one of the points is from outside the range and scaled as the store is. It has bits from `2^-1903` on (a subnormal number
/// scaled down) or up to `2^2298` (a large one scaled up): differences have at most 3314 bits, 104 digits.
pub(crate) type Far = Big<106>;
type ThreeFar = Big<318>;

fn minus3<const N: usize>(a: &[Big<N>; 3], b: &[Big<N>; 3]) -> [Big<N>; 3] {
    [a[0].minus(&b[0]), a[1].minus(&b[1]), a[2].minus(&b[2])]
}

fn dot(a: &[One; 3], b: &[One; 3]) -> Two {
    a[0].times(&b[0]).plus(&a[1].times(&b[1])).plus(&a[2].times(&b[2]))
}

/// `a[u] b[v] − a[v] b[u]`.
fn minor<const N: usize, const M: usize>(a: &[Big<N>; 3], b: &[Big<N>; 3], u: usize, v: usize) -> Big<M> {
    a[u].times(&b[v]).minus(&a[v].times(&b[u]))
}

/// A factor and its cofactor.
type Term<'a, const N: usize, const M: usize> = (&'a Big<N>, &'a Big<M>);

/// The sum of three products.
fn combine<const N: usize, const M: usize, const R: usize>([x, y, z]: [Term<N, M>; 3]) -> Big<R> {
    x.0.times(x.1).plus(&y.0.times(y.1)).plus(&z.0.times(z.1))
}

fn orientation<const N: usize, const M: usize, const R: usize>([a, b, c, d]: &[[Big<N>; 3]; 4]) -> Big<R> {
    let (b, c, d) = (minus3(b, a), minus3(c, a), minus3(d, a));
    let [cd, db, bc]: [Big<M>; 3] = [minor(&c, &d, 0, 1), minor(&d, &b, 0, 1), minor(&b, &c, 0, 1)];
    combine([(&b[2], &cd), (&c[2], &db), (&d[2], &bc)])
}

/// Sign of `det(b − a, c − a, d − a)`.
#[cold]
#[inline(never)]
pub(crate) fn orient3d(rows: &[[One; 3]; 4]) -> Sign {
    let value: Three = orientation::<40, 80, 120>(rows);
    value.sign()
}

/// The same with a point from outside the range.
#[cold]
#[inline(never)]
pub(crate) fn orient3d_far(rows: &[[Far; 3]; 4]) -> Sign {
    let value: ThreeFar = orientation::<106, 212, 318>(rows);
    value.sign()
}

/// Positive when e is inside the circumsphere of the positive tetrahedron (a, b, c, d).
#[cold]
#[inline(never)]
pub(crate) fn insphere([a, b, c, d, e]: &[[One; 3]; 5]) -> Sign {
    let rows = [minus3(a, e), minus3(b, e), minus3(c, e), minus3(d, e)];
    let lifts =
        [dot(&rows[0], &rows[0]), dot(&rows[1], &rows[1]), dot(&rows[2], &rows[2]), dot(&rows[3], &rows[3])];
    let minors: [Three; 4] = minors::<40, 80, 120>(&rows);
    lifted::<80, 120, 200>(&lifts, &minors)
}

/// The 3 by 3 minors of four rows, each without one of them.
fn minors<const N: usize, const M: usize, const T: usize>([a, b, c, d]: &[[Big<N>; 3]; 4]) -> [Big<T>; 4] {
    let [ab, ac, ad]: [Big<M>; 3] = [minor(a, b, 0, 1), minor(a, c, 0, 1), minor(a, d, 0, 1)];
    let [bc, bd, cd]: [Big<M>; 3] = [minor(b, c, 0, 1), minor(b, d, 0, 1), minor(c, d, 0, 1)];
    // Each as z times (xy minors) with alternating signs.
    let triple = |p: &[Big<N>; 3], qr, q: &[Big<N>; 3], pr, r: &[Big<N>; 3], pq| -> Big<T> {
        p[2].times(qr).minus(&q[2].times::<M, T>(pr)).plus(&r[2].times(pq))
    };
    [
        triple(b, &cd, c, &bd, d, &bc),
        triple(a, &cd, c, &ad, d, &ac),
        triple(a, &bd, b, &ad, d, &ab),
        triple(a, &bc, b, &ac, c, &ab),
    ]
}

/// The sign of the determinant with these lifts as its last column.
fn lifted<const L: usize, const T: usize, const R: usize>(lifts: &[Big<L>; 4], minors: &[Big<T>; 4]) -> Sign {
    let odd: Big<R> = lifts[0].times(&minors[0]).minus(&lifts[1].times(&minors[1]));
    let even: Big<R> = lifts[2].times(&minors[2]).minus(&lifts[3].times(&minors[3]));
    odd.plus(&even).sign()
}

/// A coordinate of an explicit point or the difference of two: at most 416 bits, 13 digits.
pub(super) type Explicit = Big<16>;
/// The lift of one: offsets have bits from `2^-1074` to `2^402`, and squares are below `2^405`: at most 1480 bits, 47 digits.
pub(super) type Lifted = Big<56>;

/// Explicit points relative to the last one: differences, lifts, and the exponents of their units.
pub(super) struct Rows<const N: usize> {
    pub(super) rows: [[Explicit; 3]; N],
    pub(super) lifts: [Lifted; N],
    pub(super) unit: i32,
    pub(super) lift_unit: i32,
}

impl<const N: usize> Rows<N> {
    /// Points, the last one apart; the same of their offsets. With `squares` lifts are offsets and squared distances, otherwise offsets.
    pub(super) fn of(
        points: [&[f64; 3]; N],
        last: &[f64; 3],
        offsets: [f64; N],
        last_offset: f64,
        squares: bool,
    ) -> Self {
        let lowest = |list: &mut dyn Iterator<Item = f64>| list.filter_map(range::lowest_exponent).min();
        let unit = lowest(&mut points.iter().chain([&last]).flat_map(|p| p.iter().copied())).unwrap_or(0);
        let of_offsets = lowest(&mut offsets.into_iter().chain([last_offset]));
        let lift_unit = match (squares, of_offsets) {
            (false, own) => own.unwrap_or(0),
            (true, own) => own.map_or(2 * unit, |own| own.min(2 * unit)),
        };
        let big = |x: f64| Explicit::of_double(x, unit);
        let last = last.map(big);
        let last_lift = Lifted::of_double(last_offset, lift_unit);
        let rows = points.map(|p| minus3(&p.map(big), &last));
        let mut lifts = offsets.map(|x| Lifted::of_double(x, lift_unit).minus(&last_lift));
        if squares {
            for (lift, [x, y, z]) in lifts.iter_mut().zip(&rows) {
                let square: Big<32> = x.times(x).plus(&y.times(y)).plus(&z.times(z));
                *lift = lift.plus(&square.shifted((2 * unit - lift_unit) as usize));
            }
        }
        Rows { rows, lifts, unit, lift_unit }
    }
}

/// Positive when the lift of e is below the hyperplane through those of the positive tetrahedron (a, b, c, d). Explicit points.
#[cold]
#[inline(never)]
pub(crate) fn power([a, b, c, d, e]: [&[f64; 3]; 5], offsets: [f64; 5], squares: bool) -> Sign {
    let [p, q, r, s, last] = offsets;
    let Rows { rows, lifts, .. } = Rows::of([a, b, c, d], e, [p, q, r, s], last, squares);
    let minors = minors::<16, 32, 48>(&rows);
    lifted::<56, 48, 104>(&lifts, &minors)
}

/// The components of `u × v`.
fn cross(u: &[Explicit; 3], v: &[Explicit; 3]) -> [Big<32>; 3] {
    [minor(u, v, 1, 2), minor(u, v, 2, 0), minor(u, v, 0, 1)]
}

/// The power centre of a tetrahedron of explicit points, times 2^`unscale`; correctly rounded.
#[cold]
#[inline(never)]
pub(super) fn center_of(
    [a, b, c, d]: [&[f64; 3]; 4],
    offsets: [f64; 4],
    squares: bool,
    unscale: i32,
) -> [f64; 3] {
    let [p, q, r, s] = offsets;
    let Rows { rows, lifts, unit, lift_unit } = Rows::of([a, b, c], d, [p, q, r], s, squares);
    let [u, v, w] = &rows;
    let (vw, wu, uv) = (cross(v, w), cross(w, u), cross(u, v));
    let det: Big<48> = combine([(&u[0], &vw[0]), (&u[1], &vw[1]), (&u[2], &vw[2])]);
    let det: Big<48> = det.shifted(1);
    let mut center = [0.0; 3];
    for (k, to) in center.iter_mut().enumerate() {
        let n: Big<88> = combine([(&lifts[0], &vw[k]), (&lifts[1], &wu[k]), (&lifts[2], &uv[k])]);
        let mut n: Big<104> = n.shifted(0);
        if squares {
            // The centre is relative to d, in units of the lifts' over that of coordinates.
            let base: Lifted = Explicit::of_double(d[k], unit).shifted((2 * unit - lift_unit) as usize);
            n = n.plus(&base.times(&det));
        }
        *to = n.ratio(&det, lift_unit - unit + unscale);
    }
    center
}

/// The components of `(b − a) × (c − a)`, correctly rounded. Explicit points.
#[cold]
#[inline(never)]
pub(super) fn normal_of([a, b, c]: [&[f64; 3]; 3]) -> [f64; 3] {
    let Rows { rows: [u, v], unit, .. } = Rows::of([b, c], a, [0.0; 2], 0.0, true);
    cross(&u, &v).map(|x| nearest(&x, 2 * unit))
}

/// Sign of the 2D orientation in the coordinates u, v.
#[cold]
#[inline(never)]
pub(crate) fn orient2d([a, b, c]: &[[One; 3]; 3], u: usize, v: usize) -> Sign {
    let value: Two = minor(&minus3(b, a), &minus3(c, a), u, v);
    value.sign()
}

/// Sign of `(b − a)·(c − a)`.
#[cold]
#[inline(never)]
pub(crate) fn dot_sign([a, b, c]: &[[One; 3]; 3]) -> Sign {
    dot(&minus3(b, a), &minus3(c, a)).sign()
}

/// Sign of the determinant with rows (u, v, squared distance in space) relative to d.
#[cold]
#[inline(never)]
pub(crate) fn incircle([a, b, c, d]: &[[One; 3]; 4], u: usize, v: usize) -> Sign {
    let (a, b, c) = (minus3(a, d), minus3(b, d), minus3(c, d));
    let (bc, ca, ab): (Two, Two, Two) = (minor(&b, &c, u, v), minor(&c, &a, u, v), minor(&a, &b, u, v));
    let value: Four = combine([(&dot(&a, &a), &bc), (&dot(&b, &b), &ca), (&dot(&c, &c), &ab)]);
    value.sign()
}
