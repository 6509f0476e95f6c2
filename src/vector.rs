//! Vectors in floating-point arithmetic: for candidates, orders and bounds, never for a decision.

/// The difference.
#[inline]
pub fn sub(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The scalar product.
#[inline]
pub fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The cross product.
#[inline]
pub fn cross(a: &[f64; 3], b: &[f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

/// The axes by descending absolute values, those of equal ones in the order given.
pub fn by_size(values: &[f64; 3], mut axes: [usize; 3]) -> [usize; 3] {
    for [i, j] in [[0, 1], [1, 2], [0, 1]] {
        if values[axes[i]].abs().total_cmp(&values[axes[j]].abs()).is_lt() {
            axes.swap(i, j);
        }
    }
    axes
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_are_sorted_as_by_a_stable_sort() {
        let values = [0.0_f64, -0.0, 1.0, -1.0, 2.0];
        for triple in 0..125 {
            let v = [triple / 25, triple / 5 % 5, triple % 5].map(|i: usize| values[i]);
            for order in [[0, 1, 2], [2, 1, 0]] {
                let mut axes = order;
                axes.sort_by(|&i: &usize, &j| v[j].abs().total_cmp(&v[i].abs()));
                assert_eq!(by_size(&v, order), axes, "{v:?}");
            }
        }
    }
}
