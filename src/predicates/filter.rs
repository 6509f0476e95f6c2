//! Determinants in floating-point arithmetic and bounds on their errors.
//!
//! Notation: u = 2^-53. A determinant evaluated as below is a sum of monomials, each of which passes through at most k
//! roundings, so the error is at most `γ_k P`, `γ_k = k u / (1 − k u)`, P the sum of the monomials' magnitudes (Higham; the same count is
//! in Shewchuk 1997, section 4.3). Counts: a difference of coordinates rounds once.
//! * orient3d: 3 differences, product, subtraction, product, two sums: k = 8.
//! * insphere: 5 differences, product, subtraction, product, two sums, square, two sums, product, two sums: k = 16.
//! * power test: insphere and one subtraction; its other part has fewer: k = 17.
//! * 2D orientation: 2 differences, product, subtraction: k = 4. Dot product: 2, product, two sums: k = 5.
//! * incircle in a plane: 4 differences, product, subtraction, square, two sums, product, two sums: k = 12.
//!
//! With X, Y, Z bounds on the differences per axis, L = X² + Y² + Z²: P is at most 6 XYZ, 24 XYZL, 24 XYZ (L + H) with H a
//! bound on differences of offsets, 2 UV, L, 6 UVL. Such a bound is static if X, Y, Z come from the box, semi-static if they come from the given points (Devillers & Pion 2003). The bounds use k + 1 instead of k;
//! this and the factor `SLACK` cover their own rounding.
//!
//! *Implicit points* are represented by their nearest doubles. If a difference is off by at most δx in x (the errors of both points), the
//! exact determinant differs from the one of the nearest doubles by at most the sum over columns of (number of monomials) (δ of this
//! column) (bounds of the other columns), with X, Y, Z enlarged by δ: replace the columns one after the other. The column of squares has δL
//! = 2 (X δx + Y δy + Z δz).
//!
//! *Underflow.* Products of differences of explicit points are multiples of 2^-1070: exact or normal. The bounds may underflow, so the
//! smallest normal number is added to them. Steiner points with bits below the exact range may make products of the static level underflow,
//! by 2^-1075 times the other factors' bounds: far below the static bound, whose X, Y, Z are zero or at least 2^-214. The semi-static level
//! leaves such points to exact arithmetic.

const U: f64 = f64::EPSILON / 2.0;
const SLACK: f64 = 1.0 + 1.0 / 1_099_511_627_776.0;
const TINY: f64 = f64::MIN_POSITIVE;

/// `det(b − a, c − a, d − a)`, rounded; evaluated relative to `d`.
#[inline(always)]
pub(crate) fn orient3d_det(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3]) -> f64 {
    let [ax, ay, az] = [a[0] - d[0], a[1] - d[1], a[2] - d[2]];
    let [bx, by, bz] = [b[0] - d[0], b[1] - d[1], b[2] - d[2]];
    let [cx, cy, cz] = [c[0] - d[0], c[1] - d[1], c[2] - d[2]];
    // −det(a − d, b − d, c − d)
    az * (cx * by - bx * cy) + bz * (ax * cy - cx * ay) + cz * (bx * ay - ax * by)
}

/// The insphere determinant relative to `e`, rounded: positive inside for a positive tetrahedron.
#[inline(always)]
pub(crate) fn insphere_det(a: &[f64; 3], b: &[f64; 3], c: &[f64; 3], d: &[f64; 3], e: &[f64; 3]) -> f64 {
    insphere_minors(a, b, c, d, e).1
}

/// The insphere determinant relative to `e`, and its minors: `orient3d` with `e` in place of each vertex of `(a, b, c, d)` (with the same
/// roundings as [`orient3d_det`], so its bounds hold).
///
/// The points are processed in two pairs, (a, c) and (b, d): nearly all steps are the same for both members, and compilers merge them into
/// one instruction.
#[inline(always)]
pub(crate) fn insphere_minors(
    a: &[f64; 3],
    b: &[f64; 3],
    c: &[f64; 3],
    d: &[f64; 3],
    e: &[f64; 3],
) -> ([f64; 4], f64) {
    let pair = |p: &[f64; 3], q: &[f64; 3], axis: usize| Pair([p[axis], q[axis]]) - Pair([e[axis]; 2]);
    let [acx, acy, acz] = [pair(a, c, 0), pair(a, c, 1), pair(a, c, 2)];
    let [bdx, bdy, bdz] = [pair(b, d, 0), pair(b, d, 1), pair(b, d, 2)];
    let acl = acx * acx + acy * acy + acz * acz;
    let bdl = bdx * bdx + bdy * bdy + bdz * bdz;
    // Minors of x and y: those of (a, b) and (c, d), of (b, c) and (d, a), of (a, c) and (b, d).
    let ab_cd = acx * bdy - bdx * acy;
    let bc_da = bdx * acy.swapped() - acx.swapped() * bdy;
    let (ac_terms, bd_terms) = (acx * acy.swapped(), bdx * bdy.swapped());
    let ac_bd = Pair([ac_terms.0[0], bd_terms.0[0]]) - Pair([ac_terms.0[1], bd_terms.0[1]]);
    let (ac, bd) = (Pair([ac_bd.0[0]; 2]), Pair([ac_bd.0[1]; 2]));
    // Minors of x, y and z: of (a, b, c) and (c, d, a), of (b, c, d) and (d, a, b).
    let (bz_ac, az_bd) = (bdz * ac, acz.swapped() * bd);
    let abc_cda = acz * bc_da + acz.swapped() * ab_cd + Pair([-bz_ac.0[0], bz_ac.0[1]]);
    let bcd_dab = bdz * ab_cd.swapped() + bdz.swapped() * bc_da + Pair([-az_bd.0[0], az_bd.0[1]]);
    let sum = acl * bcd_dab - bdl * abc_cda.swapped();
    let ([abc, cda], [bcd, dab]) = (abc_cda.0, bcd_dab.0);
    ([bcd, -cda, dab, -abc], sum.0[0] + sum.0[1])
}

/// The power determinant relative to `e`, and the same minors: the insphere determinant with the differences of the offsets to that of `e`
/// added to the squared distances, or alone.
#[inline(always)]
pub(crate) fn power_minors(
    [a, b, c, d, e]: [&[f64; 3]; 5],
    offsets: [f64; 5],
    squares: bool,
) -> ([f64; 4], f64) {
    let (sides, insphere) = insphere_minors(a, b, c, d, e);
    let [p, q, r, s, last] = offsets;
    let added =
        ((p - last) * sides[0] + (q - last) * sides[1]) + ((r - last) * sides[2] + (s - last) * sides[3]);
    (sides, if squares { insphere + added } else { added })
}

/// Two numbers that undergo the same operations.
#[derive(Clone, Copy)]
struct Pair([f64; 2]);

impl Pair {
    #[inline(always)]
    fn swapped(self) -> Pair {
        Pair([self.0[1], self.0[0]])
    }
}

impl std::ops::Add for Pair {
    type Output = Pair;
    #[inline(always)]
    fn add(self, other: Pair) -> Pair {
        Pair([self.0[0] + other.0[0], self.0[1] + other.0[1]])
    }
}

impl std::ops::Sub for Pair {
    type Output = Pair;
    #[inline(always)]
    fn sub(self, other: Pair) -> Pair {
        Pair([self.0[0] - other.0[0], self.0[1] - other.0[1]])
    }
}

impl std::ops::Mul for Pair {
    type Output = Pair;
    #[inline(always)]
    fn mul(self, other: Pair) -> Pair {
        Pair([self.0[0] * other.0[0], self.0[1] * other.0[1]])
    }
}

/// Bounds on coordinate differences per axis: `size` on the exact ones, `error` on the errors with nearest doubles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spread {
    pub(crate) size: [f64; 3],
    pub(crate) error: [f64; 3],
}

/// The larger of two numbers; unlike `f64::max` a single instruction, since there are no NaNs here.
#[inline(always)]
pub(crate) fn larger(a: f64, b: f64) -> f64 {
    if a > b {
        a
    } else {
        b
    }
}

impl Spread {
    /// For exact points: the differences to the last one.
    #[inline(always)]
    pub(crate) fn of<const N: usize>(points: [&[f64; 3]; N]) -> Spread {
        let last = points[N - 1];
        let mut size = [0.0f64; 3];
        for p in &points[..N - 1] {
            for axis in 0..3 {
                size[axis] = larger((p[axis] - last[axis]).abs(), size[axis]);
            }
        }
        Spread { size, error: [0.0; 3] }
    }

    /// Whether all points agree exactly in some coordinate.
    #[inline(always)]
    pub(crate) fn flat(&self) -> bool {
        self.size[0] == 0.0 || self.size[1] == 0.0 || self.size[2] == 0.0
    }

    #[inline(always)]
    pub(crate) fn max(&self) -> f64 {
        larger(larger(self.size[0], self.size[1]), self.size[2])
    }

    /// Bounds on a squared distance and on its error.
    #[inline(always)]
    fn lift(&self) -> (f64, f64) {
        let ([x, y, z], [ex, ey, ez]) = (self.size, self.error);
        (x * x + y * y + z * z, 2.0 * (x * ex + y * ey + z * ez))
    }

    #[inline(always)]
    pub(crate) fn orient3d_bound(&self) -> f64 {
        let ([x, y, z], [ex, ey, ez]) = (self.size, self.error);
        6.0 * (9.0 * U * (x * y * z) + ex * y * z + x * ey * z + x * y * ez) * SLACK + TINY
    }

    #[inline(always)]
    pub(crate) fn insphere_bound(&self) -> f64 {
        let ([x, y, z], [ex, ey, ez]) = (self.size, self.error);
        let (l, el) = self.lift();
        let moved = (ex * y * z + x * ey * z + x * y * ez) * l + x * y * z * el;
        24.0 * (17.0 * U * (x * y * z * l) + moved) * SLACK + TINY
    }

    /// For exact points; `offset` bounds the differences of offsets.
    pub(crate) fn power_bound(&self, offset: f64, squares: bool) -> f64 {
        let [x, y, z] = self.size;
        let l = if squares { self.lift().0 + offset } else { offset };
        24.0 * (18.0 * U * (x * y * z * l)) * SLACK + TINY
    }

    pub(crate) fn orient2d_bound(&self, u: usize, v: usize) -> f64 {
        let (s, e) = (self.size, self.error);
        2.0 * (5.0 * U * (s[u] * s[v]) + e[u] * s[v] + s[u] * e[v]) * SLACK + TINY
    }

    pub(crate) fn dot_bound(&self) -> f64 {
        let (l, el) = self.lift();
        (6.0 * U * l + el) * SLACK + TINY
    }

    pub(crate) fn incircle_bound(&self, u: usize, v: usize) -> f64 {
        let (s, e) = (self.size, self.error);
        let (l, el) = self.lift();
        let moved = (e[u] * s[v] + s[u] * e[v]) * l + s[u] * s[v] * el;
        6.0 * (13.0 * U * (s[u] * s[v] * l) + moved) * SLACK + TINY
    }
}
