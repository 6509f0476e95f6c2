//! Insertion order: biased randomized rounds, each along a Hilbert curve.
//!
//! Amenta, Choi & Rote 2003 (BRIO): random rounds of growing size keep the expected cost of incremental insertion optimal
//! for every input; the curve inside a round keeps walks short. Curve indices by Skilling 2004 (transpose form).

/// Bits per axis of a curve index.
const BITS: u32 = 21;
/// Points in the first round.
const FIRST_ROUND: usize = 2000;
/// Each round is this many times the sum of those before, roughly.
const GROWTH: f64 = 7.5;

/// A permutation of `ids` in which the points should be inserted. Depends on the coordinates and the ids' order only.
pub fn insertion_order(points: &[[f64; 3]], ids: &[u32]) -> Vec<u32> {
    let (low, scale) = frame(points, ids);
    let mut keyed: Vec<(u64, u32)> = Vec::with_capacity(ids.len());
    let mut shuffled: Vec<(u64, u32)> =
        ids.iter().enumerate().map(|(i, &id)| (splitmix(i as u64), id)).collect();
    // Only the membership in rounds is random: sort by a hash of the position.
    if ids.len() > FIRST_ROUND {
        shuffled.sort_unstable();
    }
    let mut order = Vec::with_capacity(ids.len());
    let mut ends = vec![ids.len()];
    while let Some(&end) = ends.last() {
        let before = (end as f64 / GROWTH) as usize;
        if before < FIRST_ROUND {
            break;
        }
        ends.push(before);
    }
    let mut start = 0;
    for &end in ends.iter().rev() {
        keyed.clear();
        keyed.extend(
            shuffled[start..end].iter().map(|&(_, id)| (hilbert_key(&points[id as usize], low, scale), id)),
        );
        keyed.sort_unstable();
        order.extend(keyed.iter().map(|&(_, id)| id));
        start = end;
    }
    order
}

/// Lower corner of the bounding box and the factor that maps its longest side to the curve's grid.
fn frame(points: &[[f64; 3]], ids: &[u32]) -> ([f64; 3], f64) {
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
    (low, if scale.is_finite() { scale } else { 0.0 })
}

/// A fixed bijective hash (Steele, Lea & Flood 2014).
fn splitmix(x: u64) -> u64 {
    let mut z = x.wrapping_add(0x9e37_79b9_7f4a_7c15);
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// The index of a point along the Hilbert curve through the bounding cube.
fn hilbert_key(p: &[f64; 3], low: [f64; 3], scale: f64) -> u64 {
    let mut x = [0u32; 3];
    for k in 0..3 {
        x[k] = (((p[k] - low[k]) * scale) as u32).min((1 << BITS) - 1);
    }
    // Skilling's AxesToTranspose.
    let mut q = 1u32 << (BITS - 1);
    while q > 1 {
        let mask = q - 1;
        for k in 0..3 {
            if x[k] & q != 0 {
                x[0] ^= mask;
            } else {
                let swap = (x[0] ^ x[k]) & mask;
                x[0] ^= swap;
                x[k] ^= swap;
            }
        }
        q >>= 1;
    }
    x[1] ^= x[0];
    x[2] ^= x[1];
    let mut t = 0;
    q = 1 << (BITS - 1);
    while q > 1 {
        if x[2] & q != 0 {
            t ^= q - 1;
        }
        q >>= 1;
    }
    for axis in &mut x {
        *axis ^= t;
    }
    spread(x[0]) << 2 | spread(x[1]) << 1 | spread(x[2])
}

/// Puts two zero bits between the bits of a 21-bit number.
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
        let mut order = insertion_order(&points, &ids);
        order.sort_unstable();
        assert_eq!(order, ids);
        // One round along the curve over a full grid of 2^4: consecutive points are grid neighbours.
        let (low, scale) = frame(&points, &ids);
        let scale = scale * 15.0 / 16.0 * (16.0 / 15.0);
        let mut keyed: Vec<(u64, u32)> =
            ids.iter().map(|&id| (hilbert_key(&points[id as usize], low, scale), id)).collect();
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
