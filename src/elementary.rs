//! Elementary functions that give the same bits everywhere: they consist of additions, multiplications, divisions and roots, which IEEE 754
//! defines to the last bit. The math library of a platform is not defined that way, so its results must not decide a byte of a mesh.

/// `2^k`; 0 or infinity if that is no normal double.
pub fn power_of_two(k: i32) -> f64 {
    match k {
        -1022..=1023 => f64::from_bits(((k + 1023) as u64) << 52),
        ..-1022 => 0.0,
        _ => f64::INFINITY,
    }
}

/// The largest `k` with `2^k <= x`, for a positive finite `x`. From −1022 (also for denormal numbers) to 1023.
pub fn exponent(x: f64) -> i32 {
    (((x.to_bits() >> 52) & 0x7ff) as i32 - 1023).clamp(-1022, 1023)
}

/// The smallest `k` with `x <= 2^k`, for a positive finite `x`. Not below −1022.
pub fn exponent_above(x: f64) -> i32 {
    let k = exponent(x);
    if x > power_of_two(k) {
        k + 1
    } else {
        k
    }
}

/// `x / y`; `None` if `y` is zero or the quotient overflows, which hosts may trap.
pub fn quotient(x: f64, y: f64) -> Option<f64> {
    (y.abs() > x.abs() * f64::MIN_POSITIVE).then(|| x / y)
}

/// The arc tangent of a number from 0 to 1, to about 10⁻¹⁶: the angle is halved three times, then Euler's series is truncated.
#[cfg(any(test, feature = "io"))] // The quality of tetrahedra, which only files hold.
fn arc_tangent_of_fraction(x: f64) -> f64 {
    let half = |x: f64| x / (1.0 + (1.0 + x * x).sqrt());
    let x = half(half(half(x)));
    // |x| <= tan(π/32) < 0.1: the first omitted term is below 10⁻¹⁸ of the sum.
    let square = x * x;
    let sum = (0..9).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) - square * sum);
    8.0 * x * sum
}

/// The angle in degrees whose cosine is `cosine`, clamped to [−1, 1].
#[cfg(any(test, feature = "io"))] // The quality of tetrahedra, which only files hold.
pub fn arc_cosine_degrees(cosine: f64) -> f64 {
    let c = cosine.clamp(-1.0, 1.0);
    // Twice the angle with this tangent, or with its reciprocal.
    let (rise, run) = ((1.0 - c).sqrt(), (1.0 + c).sqrt());
    let degrees = |angle: f64| 2.0 * angle * (180.0 / std::f64::consts::PI);
    if rise <= run {
        degrees(arc_tangent_of_fraction(rise / run))
    } else {
        180.0 - degrees(arc_tangent_of_fraction(run / rise))
    }
}

/// The cosine of an angle from 0 to 90 degrees, by Taylor's series.
pub fn cosine_of_degrees(degrees: f64) -> f64 {
    let sine_or_cosine = |x: f64, first: i32| {
        // x <= π/4: the first omitted term is below 10⁻¹⁸.
        (0..9).rev().fold(1.0, |sum, k| {
            let n = f64::from(2 * k + 1 + first);
            1.0 - sum * x * x / (n * (n + 1.0))
        })
    };
    let radians = |degrees: f64| degrees * (std::f64::consts::PI / 180.0);
    if degrees <= 45.0 {
        sine_or_cosine(radians(degrees), 0)
    } else {
        let x = radians(90.0 - degrees);
        x * sine_or_cosine(x, 1)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_and_exponents() {
        for k in -1022..=1023 {
            let power = power_of_two(k);
            assert_eq!(power, 2f64.powi(k));
            assert_eq!((exponent(power), exponent_above(power)), (k, k));
            if k > -1022 {
                assert_eq!((exponent(power.next_down()), exponent_above(power.next_down())), (k - 1, k));
            }
            if k < 1023 {
                assert_eq!((exponent(power.next_up()), exponent_above(power.next_up())), (k, k + 1));
            }
        }
        assert_eq!((power_of_two(-1023), power_of_two(1024)), (0.0, f64::INFINITY));
        assert_eq!(exponent(5e-324), -1022);
    }

    #[test]
    fn quotients_are_finite_or_none() {
        assert_eq!(quotient(3.0, -2.0), Some(-1.5));
        assert_eq!(quotient(0.0, 5e-324), Some(0.0));
        assert_eq!(quotient(1.0, f64::MIN_POSITIVE), None);
        assert!(quotient(1.0, 2.0 * f64::MIN_POSITIVE).unwrap().is_finite());
        for x in [0.0, 1.0, f64::MAX] {
            assert_eq!((quotient(x, 0.0), quotient(x, -0.0)), (None, None));
        }
    }

    #[test]
    fn angles_agree_with_the_platform() {
        for i in -1000..=1000 {
            let cosine = f64::from(i) / 1000.0;
            let (ours, theirs) = (arc_cosine_degrees(cosine), cosine.acos().to_degrees());
            assert!((ours - theirs).abs() < 1e-13, "{cosine}: {ours} {theirs}");
        }
        for i in 0..=900 {
            let degrees = f64::from(i) / 10.0;
            let (ours, theirs) = (cosine_of_degrees(degrees), degrees.to_radians().cos());
            assert!((ours - theirs).abs() < 1e-15, "{degrees}: {ours} {theirs}");
        }
        let exact = [arc_cosine_degrees(1.0), arc_cosine_degrees(-1.0), arc_cosine_degrees(0.0)];
        assert_eq!(exact, [0.0, 180.0, 90.0]);
        assert_eq!((cosine_of_degrees(0.0), cosine_of_degrees(90.0)), (1.0, 0.0));
    }
}
