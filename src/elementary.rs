//! Elementary functions that give the same bits everywhere: they consist of additions, multiplications, divisions and roots, which IEEE 754
//! defines to the last bit. The math library of a platform is not defined that way, so its results must not decide a byte of a mesh.

use std::hint::black_box;

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
    if y.abs() > x.abs() * f64::MIN_POSITIVE {
        // Keeps the compiler from dividing first and testing then, which it does where it takes a branch to cost more.
        return Some(x / black_box(y));
    }
    None
}

/// The arc tangent of a number from 0 to 1, to about 10⁻¹⁶: the angle is halved three times, then Euler's series is truncated.
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

/// The angle in degrees, from 0 to 180, between the vector `(run, rise)` and the first axis; 0 for the zero vector. `rise` is not negative.
/// The relative error is below 10⁻¹⁵, also of angles near 0, which their cosines do not tell apart.
pub fn angle_in_degrees(run: f64, rise: f64) -> f64 {
    let across = run.abs();
    let steep = rise > across;
    let fraction = if steep { quotient(across, rise) } else { quotient(rise, across) };
    let degrees = arc_tangent_of_fraction(fraction.unwrap_or(0.0)) * (180.0 / std::f64::consts::PI);
    match (steep, run < 0.0) {
        (false, false) => degrees,
        (false, true) => 180.0 - degrees,
        (true, false) => 90.0 - degrees,
        (true, true) => 90.0 + degrees,
    }
}

/// The cube root of a number that is not negative, with a relative error below 4·10⁻¹⁶: Newton's iteration.
pub fn cube_root(x: f64) -> f64 {
    if x < f64::MIN_POSITIVE {
        return 0.0;
    }
    let third = exponent(x).div_euclid(3);
    // In two steps, since the power alone may be out of range.
    let m = x * power_of_two(-third) * power_of_two(-2 * third);
    // 1 <= m < 8. Within 9 %, then 0.8 %, 7·10⁻⁵, 5·10⁻⁹, and as doubles allow.
    let root = (0..4).fold(0.9 + m / 7.0, |root, _| (2.0 * root + m / (root * root)) / 3.0);
    root * power_of_two(third)
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
    use num_bigint::BigInt;
    use num_traits::ToPrimitive;

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

    /// The arc tangent of a fraction in units of 2⁻²⁰⁰, by Euler's series, whose terms at least halve.
    fn precise_arc_tangent(run: &BigInt, rise: &BigInt) -> BigInt {
        let square = run * run + rise * rise;
        let mut term: BigInt = (BigInt::from(1) << 200) * run * rise / &square;
        let mut sum = term.clone();
        for k in 1..400 {
            term = term * (2 * k) * rise * rise / (&square * (2 * k + 1));
            sum += &term;
        }
        sum
    }

    /// A double in units of 2⁻¹⁰⁷⁴.
    fn exactly(x: f64) -> BigInt {
        let (bits, k) = (x.to_bits() & 0xf_ffff_ffff_ffff, (x.to_bits() >> 52) as i32 & 0x7ff);
        if k == 0 {
            BigInt::from(bits)
        } else {
            BigInt::from(bits | 1 << 52) << (k - 1)
        }
    }

    #[test]
    fn angles_agree_with_a_series_of_200_bits() {
        let half_turn = precise_arc_tangent(&1.into(), &1.into()) * 4;
        let mut worst: f64 = 0.0;
        let steps =
            (-40..=40).map(|i| 1.7f64.powi(i)).chain((0..2000).map(|i| 0.001 * f64::from(i) + 0.0003));
        for rise in steps {
            for run in [1.0, -1.0, 0.7, -3.1] {
                let (a, b): (f64, f64) = (rise, run);
                // The series is good for slopes up to one.
                let angle = match a <= b.abs() {
                    true => precise_arc_tangent(&exactly(b.abs()), &exactly(a)),
                    false => &half_turn / 2 - precise_arc_tangent(&exactly(a), &exactly(b.abs())),
                };
                let angle = if b < 0.0 { &half_turn - angle } else { angle };
                // Degrees in units of 2⁻¹⁰⁷⁴, rounded to more than a double's bits.
                let degrees: BigInt = ((angle * 180) << 1074) / &half_turn;
                let error = exactly(angle_in_degrees(b, a)) - &degrees;
                let relative: BigInt = (error << 100) / &degrees;
                let relative = relative.to_f64().unwrap() * 2f64.powi(-100);
                worst = worst.max(relative.abs());
            }
        }
        assert!(worst < 1e-15, "{worst:e}");
        let exact = [(0.0, 0.0), (1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (5e-324, 0.0), (1e-300, 1e300)];
        assert_eq!(exact.map(|(run, rise)| angle_in_degrees(run, rise)), [0.0, 0.0, 180.0, 90.0, 0.0, 90.0]);
        assert_eq!(angle_in_degrees(1.0, 1.0), 45.0);
    }

    #[test]
    fn cube_roots_are_exact_to_the_last_digits() {
        let numbers =
            (-330..=330).map(|i| 8.7f64.powi(i)).chain((0..1000).map(|i| 1.0 + 0.007 * f64::from(i)));
        for x in numbers.filter(|&x| (f64::MIN_POSITIVE..f64::INFINITY).contains(&x)) {
            let root = cube_root(x);
            // The exact root lies between neighbours two steps away.
            let cube = |y: f64| exactly(y).pow(3);
            let (mut low, mut high) = (root, root);
            for _ in 0..3 {
                (low, high) = (low.next_down(), high.next_up());
            }
            let exact = exactly(x) << (2 * 1074);
            assert!(cube(low) < exact && exact < cube(high), "{x}: {root}");
        }
        assert_eq!([0.0, 1.0, 8.0, 27.0, 1e-320].map(cube_root), [0.0, 1.0, 2.0, 3.0, 0.0]);
    }
}
