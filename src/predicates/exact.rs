//! The determinants in big integers: the last resort, for points that span too many bits for anything else.

use crate::predicates::big::Big;
use crate::predicates::Sign;

fn minus3(a: &[Big; 3], b: &[Big; 3]) -> [Big; 3] {
    [a[0].minus(&b[0]), a[1].minus(&b[1]), a[2].minus(&b[2])]
}

fn dot(a: &[Big; 3], b: &[Big; 3]) -> Big {
    a[0].times(&b[0]).plus(&a[1].times(&b[1])).plus(&a[2].times(&b[2]))
}

/// `a[u] b[v] − a[v] b[u]`.
fn minor(a: &[Big; 3], b: &[Big; 3], u: usize, v: usize) -> Big {
    a[u].times(&b[v]).minus(&a[v].times(&b[u]))
}

/// `x a + y b + z c`.
fn combine(x: &Big, a: &Big, y: &Big, b: &Big, z: &Big, c: &Big) -> Big {
    x.times(a).plus(&y.times(b)).plus(&z.times(c))
}

/// Sign of `det(b − a, c − a, d − a)`.
pub(crate) fn orient3d([a, b, c, d]: &[[Big; 3]; 4]) -> Sign {
    let (b, c, d) = (minus3(b, a), minus3(c, a), minus3(d, a));
    let (cd, db, bc) = (minor(&c, &d, 0, 1), minor(&d, &b, 0, 1), minor(&b, &c, 0, 1));
    combine(&b[2], &cd, &c[2], &db, &d[2], &bc).sign()
}

/// Positive when e is inside the circumsphere of the positive tetrahedron (a, b, c, d).
pub(crate) fn insphere([a, b, c, d, e]: &[[Big; 3]; 5]) -> Sign {
    let (a, b, c, d) = (minus3(a, e), minus3(b, e), minus3(c, e), minus3(d, e));
    let [ab, ac, ad] = [minor(&a, &b, 0, 1), minor(&a, &c, 0, 1), minor(&a, &d, 0, 1)];
    let [bc, bd, cd] = [minor(&b, &c, 0, 1), minor(&b, &d, 0, 1), minor(&c, &d, 0, 1)];
    // 3 by 3 determinants, each as z times (xy minors) with alternating signs.
    let triple = |p: &[Big; 3], qr: &Big, q: &[Big; 3], pr: &Big, r: &[Big; 3], pq: &Big| {
        p[2].times(qr).minus(&q[2].times(pr)).plus(&r[2].times(pq))
    };
    let bcd = triple(&b, &cd, &c, &bd, &d, &bc);
    let acd = triple(&a, &cd, &c, &ad, &d, &ac);
    let abd = triple(&a, &bd, &b, &ad, &d, &ab);
    let abc = triple(&a, &bc, &b, &ac, &c, &ab);
    let odd = dot(&a, &a).times(&bcd).minus(&dot(&b, &b).times(&acd));
    let even = dot(&c, &c).times(&abd).minus(&dot(&d, &d).times(&abc));
    odd.plus(&even).sign()
}

/// Sign of the 2D orientation in the coordinates u, v.
pub(crate) fn orient2d([a, b, c]: &[[Big; 3]; 3], u: usize, v: usize) -> Sign {
    minor(&minus3(b, a), &minus3(c, a), u, v).sign()
}

/// Sign of `(b − a)·(c − a)`.
pub(crate) fn dot_sign([a, b, c]: &[[Big; 3]; 3]) -> Sign {
    dot(&minus3(b, a), &minus3(c, a)).sign()
}

/// Sign of the determinant with rows (u, v, squared distance in space) relative to d.
pub(crate) fn incircle([a, b, c, d]: &[[Big; 3]; 4], u: usize, v: usize) -> Sign {
    let (a, b, c) = (minus3(a, d), minus3(b, d), minus3(c, d));
    let (bc, ca, ab) = (minor(&b, &c, u, v), minor(&c, &a, u, v), minor(&a, &b, u, v));
    combine(&dot(&a, &a), &bc, &dot(&b, &b), &ca, &dot(&c, &c), &ab).sign()
}
