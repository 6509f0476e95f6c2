//! The determinants in big integers: the last resort, for points that span too many bits for anything else.
//!
//! Room: coordinates of points in the store are multiples of `2^-1014` up to `2^201` (see `range`), so their differences have at most 1217
//! bits, 39 digits, and a factor of a determinant takes as many digits again.

use crate::predicates::big::Big;
use crate::predicates::Sign;

/// A coordinate or the difference of two, and products of as many as the name says.
pub(crate) type One = Big<40>;
type Two = Big<80>;
type Three = Big<120>;
type Four = Big<160>;
type Five = Big<200>;

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
    let (a, b, c, d) = (minus3(a, e), minus3(b, e), minus3(c, e), minus3(d, e));
    let [ab, ac, ad]: [Two; 3] = [minor(&a, &b, 0, 1), minor(&a, &c, 0, 1), minor(&a, &d, 0, 1)];
    let [bc, bd, cd]: [Two; 3] = [minor(&b, &c, 0, 1), minor(&b, &d, 0, 1), minor(&c, &d, 0, 1)];
    // 3 by 3 determinants, each as z times (xy minors) with alternating signs.
    let triple = |p: &[One; 3], qr: &Two, q: &[One; 3], pr: &Two, r: &[One; 3], pq: &Two| -> Three {
        p[2].times(qr).minus(&q[2].times(pr)).plus(&r[2].times(pq))
    };
    let bcd = triple(&b, &cd, &c, &bd, &d, &bc);
    let acd = triple(&a, &cd, &c, &ad, &d, &ac);
    let abd = triple(&a, &bd, &b, &ad, &d, &ab);
    let abc = triple(&a, &bc, &b, &ac, &c, &ab);
    let odd: Five = dot(&a, &a).times(&bcd).minus(&dot(&b, &b).times(&acd));
    let even: Five = dot(&c, &c).times(&abd).minus(&dot(&d, &d).times(&abc));
    odd.plus(&even).sign()
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
