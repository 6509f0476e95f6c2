//! Sorts many numbered keys: three passes over the 33 highest bits in which the keys differ (LSD radix sort; Knuth, TAOCP vol. 3, section
//! 5.2.5), then comparisons for the remaining bits, within the short runs of equal digits.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;

/// Bits per pass.
const DIGIT: u32 = 11;
const PASSES: u32 = 3;

/// Below this, comparisons are as fast.
const FEW: usize = 1 << 10;

/// Sorts pairs of a key and a number.
pub(super) fn sort_keyed(list: &mut Vec<(u64, u32)>, control: &Control) -> Result<(), Error> {
    if list.len() < FEW {
        list.sort_unstable();
        return Ok(());
    }
    let first = list[0].0;
    let differing = list.iter().fold(0, |bits, entry| bits | (entry.0 ^ first));
    let low = (u64::BITS - differing.leading_zeros()).saturating_sub(DIGIT * PASSES);
    let mut other = fallible::filled((0, 0), list.len())?;
    for pass in 0..PASSES {
        control.look()?;
        pass_by_digit(list, &mut other, low + DIGIT * pass);
        std::mem::swap(list, &mut other);
    }
    for run in list.chunk_by_mut(|x, y| x.0 >> low == y.0 >> low) {
        if run.len() > 1 {
            control.step()?;
            run.sort_unstable();
        }
    }
    Ok(())
}

/// Copies one list to another, sorted by the digit from bit `shift` on; entries with equal digits stay in order.
fn pass_by_digit(from: &[(u64, u32)], to: &mut [(u64, u32)], shift: u32) {
    let digit = |key: u64| (key >> shift) as usize & ((1 << DIGIT) - 1);
    let mut place = [0u32; 1 << DIGIT];
    from.iter().for_each(|entry| place[digit(entry.0)] += 1);
    let mut sum = 0;
    for count in &mut place {
        (*count, sum) = (sum, sum + *count);
    }
    for &entry in from {
        let place = &mut place[digit(entry.0)];
        to[*place as usize] = entry;
        *place += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sorts_like_comparisons() {
        let mut state = 1u64;
        let mut next = || {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            state ^ state >> 29
        };
        let masks = [u64::MAX, u64::MAX >> 1, 0xff, 0, 0xf00_0000_0000_000f, 0x7fff_ffff, 1 << 63];
        for mask in masks {
            for len in [0, 1, 2, FEW - 1, FEW, 5000] {
                let mut list: Vec<(u64, u32)> = (0..len as u32).map(|i| (next() & mask, i)).collect();
                let mut expected = list.clone();
                expected.sort();
                sort_keyed(&mut list, &Control::free()).unwrap();
                assert_eq!(list, expected, "{mask:x} {len}");
            }
        }
    }
}
