//! Big integers, for signs at Steiner points that integers of fixed width cannot represent (see `wide`).
//!
//! They have no limited range: expansions would underflow if a Steiner point has bits below the exact range of coordinates (see `range`).
//! Slow and simple on purpose: schoolbook arithmetic on 32-bit digits, lowest first, no leading zero digit, zero has no digits and is not
//! negative.

use crate::predicates::expansion::Expansion;
use crate::predicates::{range, Sign};
use std::cmp::Ordering;

#[derive(Clone, Debug)]
pub(crate) struct Big {
    negative: bool,
    digits: Vec<u32>,
}

fn compare(a: &[u32], b: &[u32]) -> Ordering {
    a.len().cmp(&b.len()).then_with(|| a.iter().rev().cmp(b.iter().rev()))
}

fn add(a: &[u32], b: &[u32]) -> Vec<u32> {
    let (long, short) = if a.len() >= b.len() { (a, b) } else { (b, a) };
    let mut out = Vec::with_capacity(long.len() + 1);
    let mut carry = 0u64;
    for (i, &digit) in long.iter().enumerate() {
        let s = u64::from(digit) + u64::from(short.get(i).copied().unwrap_or(0)) + carry;
        out.push(s as u32);
        carry = s >> 32;
    }
    if carry != 0 {
        out.push(carry as u32);
    }
    out
}

/// `a − b` where `a >= b`.
fn subtract(a: &[u32], b: &[u32]) -> Vec<u32> {
    let mut out = Vec::with_capacity(a.len());
    let mut borrow = 0i64;
    for (i, &digit) in a.iter().enumerate() {
        let s = i64::from(digit) - i64::from(b.get(i).copied().unwrap_or(0)) + borrow;
        out.push(s as u32);
        borrow = s >> 32;
    }
    trim(out)
}

fn trim(mut digits: Vec<u32>) -> Vec<u32> {
    while digits.last() == Some(&0) {
        digits.pop();
    }
    digits
}

impl Big {
    /// Coordinates in a common unit: the lowest bit set in any of them.
    pub(crate) fn rows<const N: usize>(points: &[[Expansion; 3]; N]) -> [[Big; 3]; N] {
        Big::scaled_rows(points, [0; N])
    }

    /// The same for points times two to the power of their exponents.
    pub(crate) fn scaled_rows<const N: usize>(
        points: &[[Expansion; 3]; N],
        exponents: [i32; N],
    ) -> [[Big; 3]; N] {
        let lowest = |i: usize| {
            let components = points[i].iter().flat_map(|x| x.components());
            components.filter_map(|&x| range::lowest_exponent(x)).min().map(|e| e + exponents[i])
        };
        let unit = (0..N).filter_map(lowest).min().unwrap_or(0);
        std::array::from_fn(|i| std::array::from_fn(|k| Big::of(&points[i][k], unit - exponents[i])))
    }

    /// The value of an expansion in units of 2^`unit`, which divides all its components.
    fn of(value: &Expansion, unit: i32) -> Big {
        let zero = Big { negative: false, digits: Vec::new() };
        value.components().iter().fold(zero, |sum, &x| sum.combine(&Big::of_double(x, unit), false))
    }

    fn of_double(x: f64, unit: i32) -> Big {
        let (mantissa, exponent) = range::decompose(x);
        let shift = exponent.saturating_sub(unit).max(0) as usize;
        let mut digits = vec![0u32; shift / 32];
        let wide = u128::from(mantissa) << (shift % 32);
        digits.extend([wide as u32, (wide >> 32) as u32, (wide >> 64) as u32]);
        Big { negative: x < 0.0, digits: trim(digits) }
    }

    fn combine(&self, other: &Big, negate: bool) -> Big {
        let other_negative = other.negative != negate;
        if self.negative == other_negative {
            return Big { negative: self.negative, digits: add(&self.digits, &other.digits) };
        }
        match compare(&self.digits, &other.digits) {
            Ordering::Equal => Big { negative: false, digits: Vec::new() },
            Ordering::Greater => {
                Big { negative: self.negative, digits: subtract(&self.digits, &other.digits) }
            }
            Ordering::Less => Big { negative: other_negative, digits: subtract(&other.digits, &self.digits) },
        }
    }

    /// The sum.
    pub(crate) fn plus(&self, other: &Big) -> Big {
        self.combine(other, false)
    }

    /// The difference.
    pub(crate) fn minus(&self, other: &Big) -> Big {
        self.combine(other, true)
    }

    /// The product.
    pub(crate) fn times(&self, other: &Big) -> Big {
        let mut digits = vec![0u32; self.digits.len() + other.digits.len()];
        for (i, &a) in self.digits.iter().enumerate() {
            let mut carry = 0u64;
            for (j, &b) in other.digits.iter().enumerate() {
                let s = u64::from(a) * u64::from(b) + u64::from(digits[i + j]) + carry;
                digits[i + j] = s as u32;
                carry = s >> 32;
            }
            digits[i + other.digits.len()] = carry as u32;
        }
        Big { negative: self.negative != other.negative, digits: trim(digits) }
    }

    pub(crate) fn sign(&self) -> Sign {
        match (self.digits.is_empty(), self.negative) {
            (true, _) => Sign::Zero,
            (false, false) => Sign::Positive,
            (false, true) => Sign::Negative,
        }
    }
}
