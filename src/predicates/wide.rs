//! Determinants in integers of fixed width: the exact level that decides nearly all close cases.
//!
//! Coordinates of the given points, one or two doubles each, are integers in units of their lowest set bit. If these stay within 2^124, the
//! differences stay within 2^125 and all determinants within 640 bits; differences up to 2^61 take half as many digits. Two's complement,
//! 64-bit digits, lowest first. Bounds, with |difference| <= 2^125 (2^61): minor 2^251 (2^123), squared distance 2^252 (2^124), triple
//! product 2^378 (2^186), insphere 2^632 (2^312), incircle 2^505 (2^249): below the sign bits of 4, 4, 6, 10, 8 (2, 2, 3, 5, 4) digits.
//! Branch-free and faster than expansions, whose lengths vary.

use crate::elementary::power_of_two;
use crate::predicates::expansion::two_sum;
use crate::predicates::{filter, Sign};

/// Differences of explicit points to the last one as integers, if 62 bits hold them all exactly; `size` bounds their rounded values. Little
/// more than the rounding errors of the differences (Knuth 1969) needs to be computed; most exact tests use this.
///
/// With |difference| <= 2^62, the minor is below 2^125, the squared distance 2^126, the triple product 2^189, insphere 2^317: they fit as
/// well.
#[inline(always)]
pub(crate) fn short_differences<const N: usize, const M: usize>(
    points: [&[f64; 3]; N],
    size: f64,
) -> Option<[[i64; 3]; M]> {
    const { assert!(M + 1 == N) };
    let exponent = ((size.to_bits() >> 52) & 0x7ff) as i64 - 1023;
    // Scales the largest difference to at least 2^61 and below 2^62. For coordinates in range this factor is a normal number.
    let factor = f64::from_bits((((61 - exponent) + 1023) as u64) << 52);
    let last = points[N - 1];
    let mut rows = [[0; 3]; M];
    let mut exact = true;
    for (row, p) in rows.iter_mut().zip(points) {
        for axis in 0..3 {
            let (a, b) = (p[axis], last[axis]);
            let difference = a - b;
            let b_part = a - difference;
            let rest = (a - (difference + b_part)) + (b_part - b);
            let (high, low) = (difference * factor, rest * factor);
            let (high_integer, low_integer) = (high as i64, low as i64);
            exact &= (high_integer as f64 == high) & (low_integer as f64 == low);
            row[axis] = high_integer.wrapping_add(low_integer);
        }
    }
    exact.then_some(rows)
}

/// `low + high 2^64`.
#[derive(Clone, Copy)]
struct Triple {
    low: u64,
    high: i128,
}

impl Triple {
    #[inline(always)]
    fn product(x: i64, y: i128) -> Triple {
        let low = i128::from(x) * i128::from(y as u64);
        Triple { low: low as u64, high: i128::from(x) * (y >> 64) + (low >> 64) }
    }

    #[inline(always)]
    fn plus(self, other: Triple) -> Triple {
        let (low, carry) = self.low.overflowing_add(other.low);
        Triple { low, high: self.high + other.high + i128::from(carry) }
    }

    #[inline(always)]
    fn minus(self, other: Triple) -> Triple {
        let (low, borrow) = self.low.overflowing_sub(other.low);
        Triple { low, high: self.high - other.high - i128::from(borrow) }
    }

    /// `z₁ m₁ − z₂ m₂ + z₃ m₃`.
    #[inline(always)]
    fn combined(z: [i64; 3], m: [i128; 3]) -> Triple {
        Triple::product(z[0], m[0]).minus(Triple::product(z[1], m[1])).plus(Triple::product(z[2], m[2]))
    }

    fn sign(self) -> Sign {
        match (self.high, self.low) {
            (0, 0) => Sign::Zero,
            (high, _) if high < 0 => Sign::Negative,
            _ => Sign::Positive,
        }
    }

    /// The product with a number below 2^127 in magnitude.
    #[inline(always)]
    fn times_signed(self, l: i128) -> [u64; 5] {
        let product = self.times(l.abs());
        if l < 0 {
            subtract(&[0; 5], &product)
        } else {
            product
        }
    }

    /// The product with a non-negative number.
    #[inline(always)]
    fn times(self, l: i128) -> [u64; 5] {
        let digits = [self.low, self.high as u64];
        let top = i128::from((self.high >> 64) as i64);
        let row = |factor: u64| {
            let first = u128::from(factor) * u128::from(digits[0]);
            let second = u128::from(factor) * u128::from(digits[1]) + (first >> 64);
            // Below 2^64 2^62 in magnitude.
            let third = i128::from(factor) * top + (second >> 64) as i128;
            [first as u64, second as u64, third as u64, (third >> 64) as u64]
        };
        let (a, b) = (row(l as u64), row((l >> 64) as u64));
        let extended = |x: [u64; 4]| ((x[3] as i64) >> 63) as u64;
        add(&[a[0], a[1], a[2], a[3], extended(a)], &[0, b[0], b[1], b[2], b[3]])
    }
}

#[inline(always)]
fn short_minor(a: &[i64; 3], b: &[i64; 3]) -> i128 {
    i128::from(a[0]) * i128::from(b[1]) - i128::from(a[1]) * i128::from(b[0])
}

/// Sign of `det(b − a, c − a, d − a)`, from the differences to d.
pub(crate) fn short_orient3d([a, b, c]: &[[i64; 3]; 3]) -> Sign {
    let minors = [short_minor(b, c), short_minor(a, c), short_minor(a, b)];
    -Triple::combined([a[2], b[2], c[2]], minors).sign()
}

/// Sign of the 2D orientation of (a, b, c) in the first two coordinates, from the differences to c.
pub(crate) fn short_orient2d([a, b]: &[[i64; 3]; 2]) -> Sign {
    match short_minor(a, b) {
        0 => Sign::Zero,
        minor if minor < 0 => Sign::Negative,
        _ => Sign::Positive,
    }
}

/// Positive when e is inside the circumsphere of the positive tetrahedron (a, b, c, d), from the differences to e.
pub(crate) fn short_insphere(rows: &[[i64; 3]; 4]) -> Sign {
    short_lifted(rows, |i, minor| minor.times(square(&rows[i])))
}

/// The same with these lifts instead of the squared distances, each below 2^127 in magnitude: the determinant is below 2^318.
pub(crate) fn short_power(rows: &[[i64; 3]; 4], lifts: &[i128; 4]) -> Sign {
    short_lifted(rows, |i, minor| minor.times_signed(lifts[i]))
}

#[inline(always)]
fn square(p: &[i64; 3]) -> i128 {
    p.iter().map(|&x| i128::from(x) * i128::from(x)).sum()
}

/// The sign of the determinant whose minors without the lifts are multiplied by them in `times`.
#[inline(always)]
fn short_lifted([a, b, c, d]: &[[i64; 3]; 4], times: impl Fn(usize, Triple) -> [u64; 5]) -> Sign {
    let (ab, ac, ad) = (short_minor(a, b), short_minor(a, c), short_minor(a, d));
    let (bc, bd, cd) = (short_minor(b, c), short_minor(b, d), short_minor(c, d));
    let first = times(0, Triple::combined([b[2], c[2], d[2]], [cd, bd, bc]));
    let second = times(1, Triple::combined([a[2], c[2], d[2]], [cd, ad, ac]));
    let third = times(2, Triple::combined([a[2], b[2], d[2]], [bd, ad, ab]));
    let fourth = times(3, Triple::combined([a[2], b[2], c[2]], [bc, ac, ab]));
    sign(&subtract(&add(&subtract(&first, &second), &third), &fourth))
}

/// The lifts for [`short_power`], in the square of the unit of `rows` (or in another one, without `squares`), relative to that of the last
/// point; `None` if they are no integers below 2^127 there. `size` as for [`short_differences`].
pub(crate) fn short_lifts(
    rows: &[[i64; 3]; 4],
    offsets: [f64; 5],
    squares: bool,
    size: f64,
) -> Option<[i128; 4]> {
    let exponent_of = |x: f64| ((x.to_bits() >> 52) & 0x7ff) as i32 - 1023;
    let [.., last] = offsets;
    let largest = offsets.iter().fold(0.0, |most, &x| filter::larger((x - last).abs(), most));
    if largest == 0.0 && !squares {
        return Some([0; 4]);
    }
    let exponent = if squares { 2 * (61 - exponent_of(size)) } else { 120 - exponent_of(largest) };
    if exponent.abs() > 1000 || exponent_of(largest) + exponent > 124 {
        return None;
    }
    let factor = power_of_two(exponent);
    let mut lifts = [0; 4];
    for ((lift, row), x) in lifts.iter_mut().zip(rows).zip(offsets) {
        let (high, low) = two_sum(x, -last);
        for part in [high, low] {
            let scaled = part * factor;
            // What underflows is no integer.
            if scaled as i128 as f64 != scaled || (scaled == 0.0 && part != 0.0) {
                return None;
            }
            *lift += scaled as i128;
        }
        *lift += if squares { square(row) } else { 0 };
    }
    Some(lifts)
}

type Row<const L: usize> = [[u64; L]; 3];

/// Differences of the first N − 1 points to the last one (whose own row is zero).
pub(crate) enum Differences<const N: usize> {
    Short([Row<1>; N]),
    Long([Row<2>; N]),
}

/// `x = mantissa 2^exponent`, 53 bits.
#[inline(always)]
fn mantissa(x: f64) -> (i64, i32) {
    let bits = x.to_bits();
    let biased = ((bits >> 52) & 0x7ff) as i32;
    let implied = u64::from(biased != 0) << 52;
    let size = ((bits & ((1 << 52) - 1)) | implied) as i64;
    (if x < 0.0 { -size } else { size }, biased.max(1) - 1075)
}

impl<const N: usize> Differences<N> {
    /// The differences of coordinates that are sums of two doubles each; `None` if they span too many bits.
    #[inline(always)]
    pub(crate) fn new(points: &[[[f64; 2]; 3]; N]) -> Option<Self> {
        let (mut low, mut high) = (i32::MAX, i32::MIN);
        for &x in points.iter().flatten().flatten() {
            let (m, exponent) = mantissa(x);
            if m != 0 {
                low = low.min(exponent + m.trailing_zeros() as i32);
                high = high.max(exponent + 53);
            }
        }
        if high.saturating_sub(low) > 123 && high != i32::MIN {
            return None;
        }
        let integer = |x: f64| {
            let (m, exponent) = mantissa(x);
            if m == 0 {
                return 0;
            }
            let shift = exponent - low;
            if shift >= 0 {
                i128::from(m) << shift
            } else {
                i128::from(m) >> -shift
            }
        };
        let integers = points.map(|p| p.map(|[a, b]| integer(a) + integer(b)));
        let last = integers[N - 1];
        let mut rows = [[0i128; 3]; N];
        let mut size = 0;
        for (row, p) in rows.iter_mut().zip(&integers) {
            for axis in 0..3 {
                row[axis] = p[axis] - last[axis];
                size |= row[axis].unsigned_abs();
            }
        }
        if size < 1 << 61 {
            return Some(Differences::Short(rows.map(|row| row.map(|x| [x as u64]))));
        }
        Some(Differences::Long(rows.map(|row| row.map(|x| [x as u64, (x >> 64) as u64]))))
    }
}

/// All ones if negative, else zero.
#[inline(always)]
fn sign_mask<const L: usize>(a: &[u64; L]) -> u64 {
    ((a[L - 1] as i64) >> 63) as u64
}

fn sign<const L: usize>(a: &[u64; L]) -> Sign {
    if sign_mask(a) != 0 {
        Sign::Negative
    } else if a.iter().all(|&d| d == 0) {
        Sign::Zero
    } else {
        Sign::Positive
    }
}

#[inline(always)]
fn add<const L: usize>(a: &[u64; L], b: &[u64; L]) -> [u64; L] {
    let mut out = [0; L];
    let mut carry = false;
    for i in 0..L {
        let (s, c) = a[i].overflowing_add(b[i]);
        let (s, d) = s.overflowing_add(u64::from(carry));
        out[i] = s;
        carry = c | d;
    }
    out
}

#[inline(always)]
fn subtract<const L: usize>(a: &[u64; L], b: &[u64; L]) -> [u64; L] {
    let mut out = [0; L];
    let mut borrow = false;
    for i in 0..L {
        let (s, c) = a[i].overflowing_sub(b[i]);
        let (s, d) = s.overflowing_sub(u64::from(borrow));
        out[i] = s;
        borrow = c | d;
    }
    out
}

/// The signed product; C = A + B.
#[inline(always)]
fn multiply<const A: usize, const B: usize, const C: usize>(a: &[u64; A], b: &[u64; B]) -> [u64; C] {
    const { assert!(A + B == C) };
    let mut out = [0u64; C];
    for i in 0..A {
        let mut carry = 0u64;
        for j in 0..B {
            let s = u128::from(a[i]) * u128::from(b[j]) + u128::from(out[i + j]) + u128::from(carry);
            out[i + j] = s as u64;
            carry = (s >> 64) as u64;
        }
        out[i + B] = carry;
    }
    // Read as unsigned, a negative factor is 2^(64 digits) too large.
    let (a_mask, b_mask) = (sign_mask(a), sign_mask(b));
    let mut excess = [0u64; C];
    for i in 0..B {
        excess[A + i] = b[i] & a_mask;
    }
    out = subtract(&out, &excess);
    excess = [0u64; C];
    for i in 0..A {
        excess[B + i] = a[i] & b_mask;
    }
    subtract(&out, &excess)
}

#[inline(always)]
fn minor<const L: usize, const M: usize>(a: &Row<L>, b: &Row<L>, u: usize, v: usize) -> [u64; M] {
    subtract(&multiply(&a[u], &b[v]), &multiply(&a[v], &b[u]))
}

#[inline(always)]
fn dot<const L: usize, const M: usize>(a: &Row<L>, b: &Row<L>) -> [u64; M] {
    add(&add(&multiply(&a[0], &b[0]), &multiply(&a[1], &b[1])), &multiply(&a[2], &b[2]))
}

/// `x a − y b + z c`.
#[inline(always)]
fn triple<const A: usize, const B: usize, const C: usize>(factors: [(&[u64; A], &[u64; B]); 3]) -> [u64; C] {
    let [(x, a), (y, b), (z, c)] = factors;
    add(&subtract(&multiply(x, a), &multiply(y, b)), &multiply(z, c))
}

fn orient3d_of<const L: usize, const M: usize, const T: usize>([a, b, c, _]: &[Row<L>; 4]) -> Sign {
    let (bc, ac, ab) = (minor::<L, M>(b, c, 0, 1), minor::<L, M>(a, c, 0, 1), minor::<L, M>(a, b, 0, 1));
    // det(a − d, b − d, c − d) is minus the orientation of (a, b, c, d).
    -sign::<T>(&triple([(&a[2], &bc), (&b[2], &ac), (&c[2], &ab)]))
}

fn insphere_of<const L: usize, const M: usize, const T: usize, const F: usize>(
    [a, b, c, d, _]: &[Row<L>; 5],
) -> [u64; F] {
    let (ab, ac, ad) = (minor::<L, M>(a, b, 0, 1), minor::<L, M>(a, c, 0, 1), minor::<L, M>(a, d, 0, 1));
    let (bc, bd, cd) = (minor::<L, M>(b, c, 0, 1), minor::<L, M>(b, d, 0, 1), minor::<L, M>(c, d, 0, 1));
    let bcd: [u64; T] = triple([(&b[2], &cd), (&c[2], &bd), (&d[2], &bc)]);
    let acd: [u64; T] = triple([(&a[2], &cd), (&c[2], &ad), (&d[2], &ac)]);
    let abd: [u64; T] = triple([(&a[2], &bd), (&b[2], &ad), (&d[2], &ab)]);
    let abc: [u64; T] = triple([(&a[2], &bc), (&b[2], &ac), (&c[2], &ab)]);
    let lift = |p| dot::<L, M>(p, p);
    let first: [u64; F] = triple([(&lift(a), &bcd), (&lift(b), &acd), (&lift(c), &abd)]);
    subtract(&first, &multiply(&lift(d), &abc))
}

fn incircle_of<const L: usize, const M: usize, const F: usize>(
    [a, b, c, _]: &[Row<L>; 4],
    u: usize,
    v: usize,
) -> Sign {
    let (bc, ac, ab) = (minor::<L, M>(b, c, u, v), minor::<L, M>(a, c, u, v), minor::<L, M>(a, b, u, v));
    let lift = |p| dot::<L, M>(p, p);
    sign::<F>(&triple([(&lift(a), &bc), (&lift(b), &ac), (&lift(c), &ab)]))
}

/// Sign of `det(b − a, c − a, d − a)`.
pub(crate) fn orient3d(rows: &Differences<4>) -> Sign {
    match rows {
        Differences::Short(rows) => orient3d_of::<1, 2, 3>(rows),
        Differences::Long(rows) => orient3d_of::<2, 4, 6>(rows),
    }
}

/// Positive when e is inside the circumsphere of the positive tetrahedron (a, b, c, d).
pub(crate) fn insphere(rows: &Differences<5>) -> Sign {
    match rows {
        Differences::Short(rows) => sign(&insphere_of::<1, 2, 3, 5>(rows)),
        Differences::Long(rows) => sign(&insphere_of::<2, 4, 6, 10>(rows)),
    }
}

/// The insphere sign from the leading 122 bits of the differences, for points that otherwise span too many bits; `None` if these bits do
/// not decide. Coordinates are sums of two doubles, each off by less than `lost`.
///
/// Truncation takes less than one unit from each of a coordinate's two doubles, and `lost` is at most one unit: differences are off by less
/// than δ = 4. With Y a bound on their magnitudes, exact and truncated, the determinant is off by less than 24 (3 Y² δ 3 Y² + Y³ 6 Y δ) =
/// 1440 Y⁴ < 2^11 Y⁴ (replacing columns as in `filter`; the squares are off by 6 Y δ).
pub(crate) fn insphere_leading(points: &[[[f64; 2]; 3]; 5], lost: f64) -> Option<Sign> {
    let beyond = |x: f64| mantissa(x).1 + 53;
    let mut widest = 0.0f64;
    for p in points {
        for (x, last) in p.iter().zip(&points[4]) {
            widest = widest.max((x[0] - last[0]).abs() + x[1].abs() + last[1].abs());
        }
    }
    let low = (beyond(widest) + 1 - 123).max(beyond(lost));
    // Modulo 2^128: coordinates may be larger, differences are not.
    let integer = |x: f64| {
        let (m, exponent) = mantissa(x);
        match exponent - low {
            128.. => 0,
            shift @ 0.. => i128::from(m) << shift,
            shift => i128::from(m) >> shift.unsigned_abs().min(127),
        }
    };
    let integers = points.map(|p| p.map(|[a, b]| integer(a).wrapping_add(integer(b))));
    let mut size = 0;
    let rows = integers.map(|p| {
        let mut row = [[0; 2]; 3];
        for axis in 0..3 {
            let x = p[axis].wrapping_sub(integers[4][axis]);
            size |= x.unsigned_abs();
            row[axis] = [x as u64, (x >> 64) as u64];
        }
        row
    });
    // Y + 4 <= 2^bits.
    let bits = u128::BITS - size.leading_zeros() + 3;
    if bits > 125 {
        return None;
    }
    let det = insphere_of::<2, 4, 6, 10>(&rows);
    let sign = sign(&det);
    let size = if sign == Sign::Negative { subtract(&[0; 10], &det) } else { det };
    (highest_bit(&size)? >= 11 + 4 * bits).then_some(sign)
}

/// The position of the highest bit of a non-negative number; `None` for zero.
fn highest_bit(digits: &[u64; 10]) -> Option<u32> {
    let i = digits.iter().rposition(|&d| d != 0)?;
    Some(64 * i as u32 + digits[i].ilog2())
}

/// Sign of the determinant with rows (u, v, squared distance in space) relative to the last point.
pub(crate) fn incircle(rows: &Differences<4>, u: usize, v: usize) -> Sign {
    match rows {
        Differences::Short(rows) => incircle_of::<1, 2, 4>(rows, u, v),
        Differences::Long(rows) => incircle_of::<2, 4, 8>(rows, u, v),
    }
}

/// Sign of the 2D orientation of (a, b, c) in the coordinates u, v.
pub(crate) fn orient2d(rows: &Differences<3>, u: usize, v: usize) -> Sign {
    match rows {
        Differences::Short([a, b, _]) => sign::<2>(&minor(a, b, u, v)),
        Differences::Long([a, b, _]) => sign::<4>(&minor(a, b, u, v)),
    }
}

/// Sign of `(a − c)·(b − c)` for points (a, b, c).
pub(crate) fn dot_sign(rows: &Differences<3>) -> Sign {
    match rows {
        Differences::Short([a, b, _]) => sign::<2>(&dot(a, b)),
        Differences::Long([a, b, _]) => sign::<4>(&dot(a, b)),
    }
}
