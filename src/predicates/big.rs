//! Big integers, for signs at Steiner points that integers of fixed width cannot represent (see `wide`).
//!
//! Expansions would underflow if a Steiner point has bits below the exact range of coordinates (see `range`). Slow and simple on purpose:
//! schoolbook arithmetic on 32-bit digits, lowest first, no leading zero digit, zero has no digits and is not negative. The digits are on the
//! stack, so that no sign can fail for want of memory.

use crate::predicates::expansion::Sum;
use crate::predicates::{range, Sign};
use std::cmp::Ordering;

/// An integer of up to `ROOM` digits.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Big<const ROOM: usize> {
    negative: bool,
    digits: Digits<ROOM>,
}

/// A natural number.
#[derive(Clone, Copy, Debug)]
struct Digits<const ROOM: usize> {
    len: usize,
    all: [u32; ROOM],
}

impl<const ROOM: usize> Digits<ROOM> {
    const ZERO: Self = Digits { len: 0, all: [0; ROOM] };

    fn get(&self) -> &[u32] {
        &self.all[..self.len]
    }

    /// The number in the first `len` digits.
    fn trimmed(mut self, len: usize) -> Self {
        self.len = self.all[..len].iter().rposition(|&digit| digit != 0).map_or(0, |last| last + 1);
        self
    }

    /// The position of the highest bit; `None` for zero.
    fn highest_bit(&self) -> Option<usize> {
        let last = self.get().last()?;
        Some(32 * (self.len - 1) + last.ilog2() as usize)
    }

    fn compare(&self, other: &Self) -> Ordering {
        self.len.cmp(&other.len).then_with(|| self.get().iter().rev().cmp(other.get().iter().rev()))
    }

    fn add(&self, other: &Self) -> Self {
        let (long, short) = if self.len >= other.len { (self, other) } else { (other, self) };
        let mut out = Self::ZERO;
        let mut carry = 0u64;
        for (i, &digit) in long.get().iter().enumerate() {
            let s = u64::from(digit) + u64::from(short.all[i]) + carry;
            out.all[i] = s as u32;
            carry = s >> 32;
        }
        out.len = long.len;
        if carry != 0 {
            out.all[out.len] = carry as u32;
            out.len += 1;
        }
        out
    }

    /// `self − other` where `self >= other`.
    fn subtract(&self, other: &Self) -> Self {
        let mut out = Self::ZERO;
        let mut borrow = 0i64;
        for (i, &digit) in self.get().iter().enumerate() {
            let s = i64::from(digit) - i64::from(other.all[i]) + borrow;
            out.all[i] = s as u32;
            borrow = s >> 32;
        }
        out.trimmed(self.len)
    }

    fn times<const OTHER: usize, const PRODUCT: usize>(&self, other: &Digits<OTHER>) -> Digits<PRODUCT> {
        let mut out = Digits::ZERO;
        for (i, &a) in self.get().iter().enumerate() {
            let mut carry = 0u64;
            for (j, &b) in other.get().iter().enumerate() {
                let s = u64::from(a) * u64::from(b) + u64::from(out.all[i + j]) + carry;
                out.all[i + j] = s as u32;
                carry = s >> 32;
            }
            out.all[i + other.len] = carry as u32;
        }
        out.trimmed(self.len + other.len)
    }
}

impl<const ROOM: usize> Big<ROOM> {
    /// Coordinates in a common unit: the lowest bit set in any of them.
    pub(crate) fn rows<const N: usize, const M: usize>(points: &[[Sum<M>; 3]; N]) -> [[Self; 3]; N] {
        Big::scaled_rows(points, [0; N])
    }

    /// The same for points times two to the power of their exponents.
    pub(crate) fn scaled_rows<const N: usize, const M: usize>(
        points: &[[Sum<M>; 3]; N],
        exponents: [i32; N],
    ) -> [[Self; 3]; N] {
        let lowest = |i: usize| {
            let components = points[i].iter().flat_map(|x| x.components());
            components.filter_map(|&x| range::lowest_exponent(x)).min().map(|e| e + exponents[i])
        };
        let unit = (0..N).filter_map(lowest).min().unwrap_or(0);
        std::array::from_fn(|i| std::array::from_fn(|k| Big::of(&points[i][k], unit - exponents[i])))
    }

    const ZERO: Self = Big { negative: false, digits: Digits::ZERO };

    /// The value of an expansion in units of 2^`unit`, which divides all its components.
    fn of<const M: usize>(value: &Sum<M>, unit: i32) -> Self {
        value.components().iter().fold(Big::ZERO, |sum, &x| sum.combine(&Big::of_double(x, unit), false))
    }

    /// A double in units of 2^`unit`, which divides it.
    pub(crate) fn of_double(x: f64, unit: i32) -> Self {
        let (mantissa, exponent) = range::decompose(x);
        let shift = exponent.saturating_sub(unit).max(0) as usize;
        let wide = u128::from(mantissa) << (shift % 32);
        let mut digits = Digits::ZERO;
        for (k, digit) in digits.all[shift / 32..][..3].iter_mut().enumerate() {
            *digit = (wide >> (32 * k)) as u32;
        }
        Big { negative: x < 0.0, digits: digits.trimmed(shift / 32 + 3) }
    }

    fn combine(&self, other: &Self, negate: bool) -> Self {
        let other_negative = other.negative != negate;
        if self.negative == other_negative {
            return Big { negative: self.negative, digits: self.digits.add(&other.digits) };
        }
        match self.digits.compare(&other.digits) {
            Ordering::Equal => Big::ZERO,
            Ordering::Greater => Big { negative: self.negative, digits: self.digits.subtract(&other.digits) },
            Ordering::Less => Big { negative: other_negative, digits: other.digits.subtract(&self.digits) },
        }
    }

    /// The sum.
    pub(crate) fn plus(&self, other: &Self) -> Self {
        self.combine(other, false)
    }

    /// The difference.
    pub(crate) fn minus(&self, other: &Self) -> Self {
        self.combine(other, true)
    }

    /// The product.
    pub(crate) fn times<const OTHER: usize, const PRODUCT: usize>(&self, other: &Big<OTHER>) -> Big<PRODUCT> {
        Big { negative: self.negative != other.negative, digits: self.digits.times(&other.digits) }
    }

    /// The product with 2^`bits`, in more room.
    pub(crate) fn shifted<const MORE: usize>(&self, bits: usize) -> Big<MORE> {
        let (whole, rest) = (bits / 32, bits % 32);
        let mut digits = Digits::ZERO;
        let mut carry = 0;
        for (i, &digit) in self.digits.get().iter().enumerate() {
            let wide = u64::from(digit) << rest | carry;
            digits.all[whole + i] = wide as u32;
            carry = wide >> 32;
        }
        let len = match self.digits.len {
            0 => 0,
            len => {
                digits.all[whole + len] = carry as u32;
                whole + len + 1
            }
        };
        Big { negative: self.negative, digits: digits.trimmed(len) }
    }

    /// The double nearest to the quotient times 2^`exponent`, ties to even; infinite if it is beyond their range, 0 if the divisor is 0.
    pub(crate) fn ratio<const OTHER: usize>(&self, divisor: &Big<OTHER>, exponent: i32) -> f64 {
        let (mut n, d) = (*self, divisor);
        let (Some(high), Some(low)) = (n.digits.highest_bit(), d.digits.highest_bit()) else { return 0.0 };
        let mut d: Self = d.shifted(high.saturating_sub(low));
        n = n.shifted(low.saturating_sub(high));
        (n.negative, d.negative) = (false, false);
        let mut power = high as i32 - low as i32;
        if n.digits.compare(&d.digits) == Ordering::Less {
            n = n.shifted(1);
            power -= 1;
        }
        // Now 1 <= n / d < 2: 64 bits of the quotient, and whether anything is left.
        let mut bits = 0u64;
        for _ in 0..64 {
            bits <<= 1;
            if n.digits.compare(&d.digits) != Ordering::Less {
                n = Big { negative: false, digits: n.digits.subtract(&d.digits) };
                bits |= 1;
            }
            n = n.shifted(1);
        }
        let size = round_to_double(bits, n.digits.len != 0, power + exponent);
        if self.negative == divisor.negative {
            size
        } else {
            -size
        }
    }

    pub(crate) fn sign(&self) -> Sign {
        match (self.digits.len == 0, self.negative) {
            (true, _) => Sign::Zero,
            (false, false) => Sign::Positive,
            (false, true) => Sign::Negative,
        }
    }
}

/// The double nearest to `bits 2^(power − 63)`, the highest bit of `bits` set; `more` if the number is larger, by less than the last bit.
fn round_to_double(bits: u64, more: bool, power: i32) -> f64 {
    if power > 1023 {
        return f64::INFINITY;
    }
    // The exponent of the last place, larger below the normal numbers.
    let place = (power - 52).max(-1074);
    let dropped = (place - (power - 63)) as u32;
    if dropped > 64 {
        return 0.0;
    }
    let wide = u128::from(bits);
    let (kept, rest, half) = (wide >> dropped, wide & ((1 << dropped) - 1), 1u128 << (dropped - 1));
    let up = match rest.cmp(&half) {
        Ordering::Less => false,
        Ordering::Equal => more || kept % 2 == 1,
        Ordering::Greater => true,
    };
    let kept = (kept as u64 + u64::from(up)) as f64;
    if place == 971 && kept == (1u64 << 53) as f64 {
        return f64::INFINITY;
    }
    range::scale(kept, place)
}
