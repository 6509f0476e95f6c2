//! The point of a star-shaped polyhedron that is farthest from the planes of its faces.
//!
//! A linear program in four unknowns: maximise `r` under `m·p + c >= r` for every face. Solved in the dual by the simplex method with
//! a basis of four faces (Dantzig 1951), in floating-point arithmetic: the result is a candidate that exact signs accept or reject.

use crate::vector::dot;

/// A half-space: `normal·p + offset >= 0` inside, the normal of length one.
#[derive(Clone, Copy, Debug)]
pub struct Plane {
    /// The inner normal.
    pub normal: [f64; 3],
    /// The distance of the origin.
    pub offset: f64,
}

/// Most changes of the basis: degenerate programs could go on for ever. 64 and 256 change nothing on six models: it only bounds the work on
/// worse ones.
const MOST_STEPS: usize = 128;

/// A face that lies beyond the nearest one by less than this part of the size cannot improve the centre in doubles. Rounding decides about
/// the last steps only: the exact signs judge the point.
const NEAR_ENOUGH: f64 = 1e-12;

/// A smaller share is rounding of zero: a step by it would be of no known size.
const NO_SHARE: f64 = 1e-14;

/// The point with the largest distance to the nearest plane, and this distance (negative outside); `size` bounds its coordinates.
pub fn center(planes: &[Plane], size: f64) -> ([f64; 3], f64) {
    let third = 1.0 / 3f64.sqrt();
    let far = [[1.0, 1.0, 1.0], [1.0, -1.0, -1.0], [-1.0, 1.0, -1.0], [-1.0, -1.0, 1.0]];
    let mut basis = far.map(|n| Plane { normal: n.map(|x: f64| x * third), offset: size });
    let mut weight = [0.25f64; 4];
    let mut best = ([0.0; 3], f64::NEG_INFINITY);
    for _ in 0..MOST_STEPS {
        // r − m·p = c for the four faces of the basis.
        let rows = basis.map(|b| [-b.normal[0], -b.normal[1], -b.normal[2], 1.0]);
        let Some(x) = solve(rows, basis.map(|b| b.offset)) else { break };
        let p = [x[0], x[1], x[2]];
        let mut worst = (f64::INFINITY, None);
        for plane in planes {
            let distance = dot(&plane.normal, &p) + plane.offset;
            if distance < worst.0 {
                worst = (distance, Some(plane));
            }
        }
        if worst.0 > best.1 {
            best = (p, worst.0);
        }
        let (distance, Some(plane)) = worst else { break };
        if distance >= x[3] - NEAR_ENOUGH * size {
            break;
        }
        // The entering column in terms of the basis.
        let n = plane.normal;
        let columns = [0, 1, 2, 3].map(|k| if k == 3 { [1.0; 4] } else { basis.map(|b| b.normal[k]) });
        let Some(share) = solve(columns, [n[0], n[1], n[2], 1.0]) else { break };
        let leaving = (0..4)
            .filter(|&j| share[j] > NO_SHARE)
            .min_by(|&i, &j| (weight[i] / share[i]).total_cmp(&(weight[j] / share[j])));
        let Some(leaving) = leaving else { break };
        let step = weight[leaving] / share[leaving];
        for j in 0..4 {
            weight[j] = (weight[j] - step * share[j]).max(0.0);
        }
        weight[leaving] = step;
        basis[leaving] = *plane;
    }
    best
}

/// Gauss's elimination with pivoting.
fn solve(mut a: [[f64; 4]; 4], mut b: [f64; 4]) -> Option<[f64; 4]> {
    for k in 0..4 {
        let pivot = (k..4).max_by(|&i, &j| a[i][k].abs().total_cmp(&a[j][k].abs()))?;
        // Coordinates are at most 2^202: three divisions by more than this do not overflow.
        if a[pivot][k].abs() < 1e-60 {
            return None;
        }
        a.swap(k, pivot);
        b.swap(k, pivot);
        for i in k + 1..4 {
            let factor = a[i][k] / a[k][k];
            let row = a[k];
            for (x, y) in a[i].iter_mut().zip(row).skip(k) {
                *x -= factor * y;
            }
            b[i] -= factor * b[k];
        }
    }
    let mut x = [0.0; 4];
    for k in (0..4).rev() {
        let rest: f64 = (k + 1..4).map(|j| a[k][j] * x[j]).sum();
        x[k] = (b[k] - rest) / a[k][k];
    }
    x.iter().all(|v| v.is_finite()).then_some(x)
}
