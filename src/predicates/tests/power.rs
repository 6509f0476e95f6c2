//! The power test and power centres against big integers.
use super::*;
use crate::predicates::Lifts;
use num_rational::BigRational;

/// Coordinates and weights are exact integers in units of 2^-FINE, and of its square.
const FINE: i32 = 1080;

fn fine(x: f64, unit: i32) -> BigInt {
    let (mantissa, exponent) = range::decompose(x);
    let value = BigInt::from(mantissa) << (exponent + unit);
    if x < 0.0 {
        -value
    } else {
        value
    }
}

/// A set with offsets; `squares` says whether they are added to squares.
struct Set {
    xyz: Vec<[f64; 3]>,
    offsets: Vec<f64>,
    squares: bool,
}

impl Set {
    fn points(&self) -> Points {
        let mut points = Points::new(self.xyz.clone());
        points.lift(Lifts::new(self.offsets.clone(), self.squares));
        points
    }

    fn row(&self, i: u32) -> (Exact, BigInt) {
        let p = self.xyz[i as usize].map(|x| fine(x, FINE));
        let square = if self.squares { dot(&p, &p) } else { BigInt::zero() };
        let lift = square + fine(self.offsets[i as usize], 2 * FINE);
        (p, lift)
    }

    fn sign(&self, ids: [u32; 5]) -> Sign {
        let rows = ids.map(|i| self.row(i));
        let (e, last) = &rows[4];
        let d = [0, 1, 2, 3].map(|i| (sub(&rows[i].0, e), &rows[i].1 - last));
        let det = &d[0].1 * det3(&d[1].0, &d[2].0, &d[3].0) - &d[1].1 * det3(&d[0].0, &d[2].0, &d[3].0)
            + &d[2].1 * det3(&d[0].0, &d[1].0, &d[3].0)
            - &d[3].1 * det3(&d[0].0, &d[1].0, &d[2].0);
        sign(&det)
    }

    /// The exact centre, if the tetrahedron is not flat.
    fn center(&self, ids: [u32; 4]) -> Option<[BigRational; 3]> {
        let rows = ids.map(|i| self.row(i));
        let r = [0, 1, 2].map(|i| sub(&rows[i].0, &rows[3].0));
        let l = [0, 1, 2].map(|i| &rows[i].1 - &rows[3].1);
        let det = BigInt::from(2) * det3(&r[0], &r[1], &r[2]);
        if det.is_zero() {
            return None;
        }
        let unit = BigRational::from_integer(BigInt::from(1) << FINE);
        Some([0, 1, 2].map(|k| {
            let column = [0, 1, 2].map(|i| {
                let mut row = r[i].clone();
                row[k] = l[i].clone();
                row
            });
            BigRational::new(det3(&column[0], &column[1], &column[2]), det.clone()) / &unit
        }))
    }
}

/// Whether `x` is a double nearest to `exact`, the even one of two.
fn is_nearest(x: f64, exact: &BigRational) -> bool {
    let value = |x: f64| BigRational::from_float(x).expect("finite");
    let largest = value(f64::MAX);
    if x.is_infinite() {
        let beyond = &largest + (&largest - value(f64::MAX.next_down())) / BigInt::from(2);
        return *exact >= beyond || *exact <= -beyond;
    }
    let even = x.to_bits() % 2 == 0;
    let middle = |y: f64| match y.is_finite() {
        true => (value(x) + value(y)) / BigInt::from(2),
        false => {
            value(x) + (value(x) - value(if x > 0.0 { x.next_down() } else { x.next_up() })) / BigInt::from(2)
        }
    };
    let (low, high) = (middle(x.next_down()), middle(x.next_up()));
    (*exact > low && *exact < high) || even && (*exact == low || *exact == high)
}

fn sets(random: &mut Random) -> Vec<(&'static str, Set)> {
    let mut sets = Vec::new();
    let mut add = |name, xyz: Vec<[f64; 3]>, offsets: Vec<f64>| {
        for squares in [true, false] {
            sets.push((name, Set { xyz: xyz.clone(), offsets: offsets.clone(), squares }));
        }
    };
    let n = 40;
    add("random", (0..n).map(|_| random.point()).collect(), (0..n).map(|_| -random.unit()).collect());
    let grid: Vec<[f64; 3]> = (0..n).map(|_| random.grid(5)).collect();
    add("grid", grid.clone(), (0..n).map(|_| random.below(4) as f64 - 1.0).collect());
    let lifted = grid.iter().map(|p| p.iter().map(|x| x * x).sum()).collect();
    add("grid lifted to its squares", grid.clone(), lifted);
    add("equal", grid, vec![0.7; n]);
    let decimals: Vec<[f64; 3]> = (0..n).map(|_| random.decimals()).collect();
    add("decimals", decimals.clone(), (0..n).map(|_| random.decimal()).collect());
    add("subnormal weights", decimals, (0..n).map(|_| f64::from_bits(random.below(1 << 40))).collect());
    let flat = |random: &mut Random| {
        let p = random.grid(9);
        [p[0], p[1], random.nudge(p[0] + p[1] + 1.0)]
    };
    add(
        "nearly flat",
        (0..n).map(|_| flat(random)).collect(),
        (0..n).map(|_| random.below(3) as f64).collect(),
    );
    let wide = |random: &mut Random, by: i32| {
        let k = random.below(2 * by as u64) as i32 - by;
        let x = scale(random.unit() + 0.5, k);
        if random.below(2) == 0 {
            x
        } else {
            -x
        }
    };
    add(
        "wide",
        (0..n).map(|_| [wide(random, 150), wide(random, 150), wide(random, 150)]).collect(),
        (0..n).map(|_| wide(random, 380)).collect(),
    );
    add(
        "the ends of the range",
        (0..n)
            .map(|_| {
                [0, 1, 2].map(|_| {
                    if random.below(2) == 0 {
                        wide(random, 2) * scale(1.0, 197)
                    } else {
                        scale(1.0, -214)
                    }
                })
            })
            .collect(),
        (0..n).map(|_| if random.below(2) == 0 { scale(1.0, 402) } else { f64::from_bits(1) }).collect(),
    );
    sets
}

#[test]
fn the_power_test_is_that_of_big_integers() {
    let mut random = Random(77);
    for (name, set) in sets(&mut random) {
        let points = set.points();
        let mut ties = 0;
        for _ in 0..400 {
            let ids @ [a, b, c, d, e]: [u32; 5] = random.distinct(set.xyz.len());
            let expected = set.sign(ids);
            ties += usize::from(expected == Sign::Zero);
            assert_eq!(points.power([a, b, c, d], e), expected, "{name} {} {ids:?}", set.squares);
            assert_eq!(points.power([b, a, c, d], e), -expected, "{name} {} {ids:?}", set.squares);
        }
        assert!(name != "grid" || ties > 0, "no tie in {name}");
    }
}

#[test]
fn centres_are_correctly_rounded() {
    let mut random = Random(78);
    for (name, set) in sets(&mut random) {
        let points = set.points();
        for _ in 0..100 {
            let ids: [u32; 4] = random.distinct(set.xyz.len());
            let Some(exact) = set.center(ids) else { continue };
            for unscale in [0i32, -1030, 40, 700] {
                let factor = BigRational::from_integer(BigInt::from(1) << unscale.unsigned_abs());
                let center = points.power_center(ids, unscale);
                for (x, exact) in center.iter().zip(&exact) {
                    let exact = if unscale < 0 { exact / &factor } else { exact * &factor };
                    assert!(is_nearest(*x, &exact), "{name} {} {ids:?} {unscale}: {x:e}", set.squares);
                }
            }
        }
    }
}

#[test]
fn normals_have_length_one_and_point_to_the_positive_side() {
    let mut random = Random(79);
    for (name, set) in sets(&mut random).into_iter().filter(|set| set.1.squares) {
        let points = set.points();
        for _ in 0..100 {
            let [a, b, c]: [u32; 3] = random.distinct(set.xyz.len());
            if points.collinear(a, b, c) {
                continue;
            }
            let normal = points.unit_normal([a, b, c]);
            let length: f64 = normal.iter().map(|x| x * x).sum();
            assert!((length - 1.0).abs() < 1e-15, "{name}: {length}");
            let [p, q, r] = [a, b, c].map(|i| set.row(i).0);
            let (u, v) = (sub(&q, &p), sub(&r, &p));
            let exact = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &u[i] * &v[j] - &u[j] * &v[i]);
            let n = normal.map(|x| fine(x, FINE));
            // The sine of the angle between both is tiny.
            let across = [(1, 2), (2, 0), (0, 1)].map(|(i, j)| &n[i] * &exact[j] - &n[j] * &exact[i]);
            let (across, along) = (dot(&across, &across), dot(&exact, &exact) << (2 * FINE));
            assert!(dot(&n, &exact).is_positive() && across << 100u32 < along, "{name}");
        }
    }
}
