//! Equal points: each is mapped to the first point equal to it, by sorting. `-0.0` equals `0.0`.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::plc::radix::sort_keyed;

/// A key that sorts like the finite number itself; both zeros get the same key.
#[inline]
fn key(value: f64) -> u64 {
    let bits = (value + 0.0).to_bits();
    if bits >> 63 == 0 {
        bits | 1 << 63
    } else {
        !bits
    }
}

/// For each point the index of the first point equal to it (itself if it is the first). Points must be finite.
pub fn first_equal(points: &[[f64; 3]], control: &Control) -> Result<Vec<u32>, Error> {
    let mut alias = fallible::collect(0..points.len() as u32)?;
    let mut order: Vec<(u64, u32)> =
        fallible::collect(points.iter().enumerate().map(|(i, p)| (key(p[0]), i as u32)))?;
    sort_keyed(&mut order, control)?;
    let mut begin = 0;
    while begin < order.len() {
        let x = order[begin].0;
        let end = begin + order[begin..].iter().take_while(|entry| entry.0 == x).count();
        if end - begin > 1 {
            control.steps((end - begin) as u32)?;
            alias_run(points, &mut order[begin..end], &mut alias);
        }
        begin = end;
    }
    Ok(alias)
}

/// Resolves the points with equal x.
fn alias_run(points: &[[f64; 3]], run: &mut [(u64, u32)], alias: &mut [u32]) {
    let rest = |i: u32| (key(points[i as usize][1]), key(points[i as usize][2]));
    run.sort_unstable_by_key(|&(_, i)| (rest(i), i));
    for k in 1..run.len() {
        let (previous, current) = (run[k - 1].1, run[k].1);
        if rest(previous) == rest(current) {
            alias[current as usize] = alias[previous as usize];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_points_map_to_the_first() {
        let points = [
            [1., 2., 3.],
            [0., 0., -1.],
            [1., 2., 3.],
            [-0., 0., -1.],
            [1., 2., 4.],
            [0., -0., -1.],
            [-1., 0., 0.],
        ];
        assert_eq!(first_equal(&points, &Control::free()).unwrap(), [0, 1, 0, 1, 4, 1, 6]);
    }

    #[test]
    fn keys_sort_like_numbers() {
        let values = [-f64::MAX, -1.0, -f64::MIN_POSITIVE, -5e-324, 0.0, 5e-324, 1.0, 1.5, f64::MAX];
        assert!(values.windows(2).all(|w| key(w[0]) < key(w[1])));
        assert_eq!(key(0.0), key(-0.0));
    }
}
