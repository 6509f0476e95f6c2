//! Insertion order: biased randomized rounds, each along a Hilbert curve.
//!
//! Amenta, Choi & Rote 2003 (BRIO): random rounds of growing size keep the expected cost of incremental insertion optimal
//! for every input; the curve inside a round keeps walks short. Curve indices by Skilling 2004 (transpose form).
//!
//! One sort does both: a point's key is its round, then its curve index. The leading digits are sorted from the last to the first, in
//! linear time; the few points that agree in them are sorted by comparison.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;

/// Bits per axis of a curve index. With 10 and with 19 the time for 8,000 points stays within 2 %.
const BITS: u32 = 20;
/// Minimum number of points in the first round. From 1,000 to 4,000 the time for 8,000 points stays within 5 %, for 100,000 within 2 %:
/// nothing measurable depends on it there.
const FIRST_ROUND: usize = 2000;
/// Each round is roughly this many times as large as all previous ones together: larger rounds have shorter walks, smaller ones a better
/// bound on the expected cost. From 3.75 to 15 the time for 8,000 points stays within 5 %, for 100,000 within 2 %: nothing measurable
/// depends on it there.
const GROWTH: f64 = 7.5;
/// Points whose curve indices are computed together.
const BLOCK: usize = 8;
/// Bits of a digit: passes over the points for the size of the table. From 10 to 12 the time for 8,000 points stays within 2 %.
const DIGIT: u32 = 11;
/// Below this many points, digit tables are not worth their cost. From 1,000 to 4,000 the time for 8,000 points stays within 2 %.
const FEW: usize = 2000;

/// Points in an order of insertion.
#[derive(Debug, Default)]
pub struct Order {
    /// The points' ids.
    pub ids: Vec<u32>,
    /// Where rounds end in `ids`. Empty if the order is unknown.
    pub rounds: Vec<usize>,
}

/// A permutation of `ids` in which the points should be inserted. Depends only on the coordinates and the order of the ids.
pub fn insertion_order(points: &[[f64; 3]], ids: &[u32], control: &Control) -> Result<Order, Error> {
    control.look()?;
    let Frame { low, scale } = Frame::of(points, ids);
    let (limits, count) = round_limits(ids.len());
    let rounds = &limits[..count];
    let mut keyed: Vec<(u64, u32)> = fallible::reserved(ids.len())?;
    for (block, chunk) in ids.chunks(BLOCK).enumerate() {
        control.step()?;
        let mut coordinates = [[0.0; 3]; BLOCK];
        for (to, &id) in coordinates.iter_mut().zip(chunk) {
            *to = points[id as usize];
        }
        let indices = hilbert_indices(&coordinates, low, scale);
        fallible::extend(
            &mut keyed,
            chunk.iter().zip(indices).enumerate().map(|(i, (&id, index))| {
                // Only the membership in rounds is random: by a hash of the position.
                let hash = splitmix((block * BLOCK + i) as u64);
                let round = rounds.iter().take_while(|&&limit| hash < limit).count();
                (((rounds.len() - round) as u64) << (3 * BITS) | index, id)
            }),
        )?;
    }
    sort(&mut keyed, control)?;
    control.look()?;
    let ends =
        (0..=rounds.len() as u64).map(|round| keyed.partition_point(|&(key, _)| key >> (3 * BITS) <= round));
    let rounds = fallible::collect(ends)?;
    Ok(Order { ids: fallible::collect(keyed.iter().map(|&(_, id)| id))?, rounds })
}

/// The indices of up to `BLOCK` points along the curve.
pub(super) fn curve_indices(points: &[[f64; 3]], ids: &[u32], frame: &Frame) -> [u64; BLOCK] {
    let mut coordinates = [[0.0; 3]; BLOCK];
    for (to, &id) in coordinates.iter_mut().zip(ids) {
        *to = points[id as usize];
    }
    hilbert_indices(&coordinates, frame.low, frame.scale)
}

/// The limits and their number: hash values below the first limit move a point from the last round to the one before, values below the
/// second one round further, and so on.
fn round_limits(count: usize) -> ([u64; 15], usize) {
    let mut limits = [0; 15];
    let mut rounds = 0;
    let mut share = 1.0 / GROWTH;
    while share * count as f64 >= FIRST_ROUND as f64 && rounds < limits.len() {
        limits[rounds] = (share * u64::MAX as f64) as u64;
        rounds += 1;
        share /= GROWTH;
    }
    (limits, rounds)
}

/// Sorts by key.
fn sort(keyed: &mut Vec<(u64, u32)>, control: &Control) -> Result<(), Error> {
    let count = keyed.len();
    if count < FEW {
        keyed.sort_unstable();
        return Ok(());
    }
    // Enough leading bits that hardly any two of this many evenly distributed points agree in them.
    let bits = count.ilog2() + 10;
    let passes = bits.div_ceil(DIGIT);
    let lowest = u64::BITS - passes * DIGIT;
    let mut other = fallible::filled((0u64, 0u32), count)?;
    for pass in 0..passes {
        control.look()?;
        let digit = |key: u64| (key >> (lowest + pass * DIGIT)) as usize % (1 << DIGIT);
        let mut places = [0u32; 1 << DIGIT];
        for &(key, _) in keyed.iter() {
            places[digit(key)] += 1;
        }
        let mut sum = 0;
        for place in &mut places {
            sum += std::mem::replace(place, sum);
        }
        for &entry in keyed.iter() {
            let place = &mut places[digit(entry.0)];
            other[*place as usize] = entry;
            *place += 1;
        }
        std::mem::swap(keyed, &mut other);
    }
    let mut begin = 0;
    while begin < count {
        let leading = keyed[begin].0 >> lowest;
        let end = begin + keyed[begin..].iter().take_while(|entry| entry.0 >> lowest == leading).count();
        if end - begin > 1 {
            control.step()?;
            keyed[begin..end].sort_unstable();
        }
        begin = end;
    }
    Ok(())
}

/// The cube that the curve fills.
pub(super) struct Frame {
    /// Lower corner of the bounding box.
    low: [f64; 3],
    /// The factor that maps its longest side to the curve's grid.
    scale: f64,
}

impl Frame {
    /// The frame around the points `ids`.
    pub(super) fn of(points: &[[f64; 3]], ids: &[u32]) -> Frame {
        let mut low = [f64::INFINITY; 3];
        let mut high = [f64::NEG_INFINITY; 3];
        for &id in ids {
            for k in 0..3 {
                low[k] = low[k].min(points[id as usize][k]);
                high[k] = high[k].max(points[id as usize][k]);
            }
        }
        let side = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        let scale = if side > 0.0 { ((1u64 << BITS) - 1) as f64 / side } else { 0.0 };
        Frame { low, scale: if scale.is_finite() { scale } else { 0.0 } }
    }
}

/// A fixed bijective hash (Steele, Lea & Flood 2014).
fn splitmix(x: u64) -> u64 {
    let mut z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The indices of points along the Hilbert curve through the bounding cube.
///
/// Skilling's AxesToTranspose without branches, several points at a time, so that it can be vectorized.
fn hilbert_indices(points: &[[f64; 3]; BLOCK], low: [f64; 3], scale: f64) -> [u64; BLOCK] {
    let mut x = [[0u32; BLOCK]; 3];
    for i in 0..BLOCK {
        for k in 0..3 {
            x[k][i] = (((points[i][k] - low[k]) * scale) as u32).min((1 << BITS) - 1);
        }
    }
    let [mut x, mut y, mut z] = x;
    for bit in (1..BITS).rev() {
        let mask = (1 << bit) - 1;
        for i in 0..BLOCK {
            // All ones if the bit is set: then invert x below it, otherwise swap x and the other axis there.
            x[i] ^= mask & (x[i] >> bit & 1).wrapping_neg();
            for other in [&mut y, &mut z] {
                let invert = (other[i] >> bit & 1).wrapping_neg();
                let exchange = (x[i] ^ other[i]) & mask & !invert;
                x[i] ^= exchange | (mask & invert);
                other[i] ^= exchange;
            }
        }
    }
    let mut t = [0; BLOCK];
    for i in 0..BLOCK {
        y[i] ^= x[i];
        z[i] ^= y[i];
    }
    for bit in 1..BITS {
        for i in 0..BLOCK {
            t[i] ^= ((1 << bit) - 1) & (z[i] >> bit & 1).wrapping_neg();
        }
    }
    let mut indices = [0; BLOCK];
    for i in 0..BLOCK {
        indices[i] = spread(x[i] ^ t[i]) << 2 | spread(y[i] ^ t[i]) << 1 | spread(z[i] ^ t[i]);
    }
    indices
}

/// Inserts two zero bits between the bits of a 21-bit number.
fn spread(x: u32) -> u64 {
    let mut x = x as u64 & 0x1f_ffff;
    x = (x | x << 32) & 0x1f_0000_0000_ffff;
    x = (x | x << 16) & 0x1f_0000_ff00_00ff;
    x = (x | x << 8) & 0x100f_00f0_0f00_f00f;
    x = (x | x << 4) & 0x10c3_0c30_c30c_30c3;
    (x | x << 2) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_sorted_whether_few_or_many_agree() {
        for (count, mask) in [(100, u64::MAX), (50_000, u64::MAX), (50_000, 0xfff), (50_000, 0xf << 60)] {
            let mut keyed: Vec<(u64, u32)> = (0..count).map(|i| (splitmix(i) & mask, i as u32)).collect();
            let mut expected = keyed.clone();
            expected.sort_unstable();
            sort(&mut keyed, &Control::free()).unwrap();
            assert_eq!(keyed, expected);
        }
    }

    #[test]
    fn rounds_grow() {
        assert_eq!(round_limits(10_000).1, 0);
        let (limits, count) = round_limits(1_000_000);
        let limits = &limits[..count];
        assert_eq!(limits.len(), 3);
        assert!(limits.windows(2).all(|w| w[0] > w[1]));
        assert!(round_limits(u32::MAX as usize).1 < 16);
    }

    #[test]
    fn order_is_a_permutation_and_the_curve_is_continuous() {
        let mut points = Vec::new();
        for i in 0..16 {
            for j in 0..16 {
                for k in 0..16 {
                    points.push([i as f64, j as f64, k as f64]);
                }
            }
        }
        let ids: Vec<u32> = (0..points.len() as u32).collect();
        let mut order = insertion_order(&points, &ids, &Control::free()).unwrap().ids;
        order.sort_unstable();
        assert_eq!(order, ids);
        // One round along the curve over a full grid of 2^4: consecutive points are grid neighbours.
        let Frame { low, scale } = Frame::of(&points, &ids);
        let scale = scale * 15.0 / 16.0 * (16.0 / 15.0);
        let mut keyed: Vec<(u64, u32)> = ids
            .iter()
            .map(|&id| (hilbert_indices(&[points[id as usize]; BLOCK], low, scale)[0], id))
            .collect();
        keyed.sort_unstable();
        let far = keyed
            .windows(2)
            .filter(|w| {
                let (a, b) = (points[w[0].1 as usize], points[w[1].1 as usize]);
                (0..3).map(|k| (a[k] - b[k]).abs()).sum::<f64>() > 1.5
            })
            .count();
        assert_eq!(far, 0);
    }
}
