//! All signs against big integers: grids, cospherical and nearly degenerate sets, Steiner points, the ends of the range.

mod arithmetic;
mod on_facet;
mod positions;
mod power;

use super::*;
use crate::predicates::position::Position;
use crate::predicates::range::is_facet_parameter;
use num_bigint::BigInt;
use num_traits::{Signed, Zero};
use std::cmp::Ordering;

/// Coordinates are exact integers in units of 2^-UNIT.
const UNIT: i32 = 480;

struct Random(u64);

impl Random {
    fn next(&mut self) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0.wrapping_mul(0x2545_f491_4f6c_dd1d)
    }
    fn below(&mut self, n: u64) -> u64 {
        (self.next() >> 11) % n
    }
    fn unit(&mut self) -> f64 {
        (self.next() >> 11) as f64 * f64::EPSILON / 2.0
    }
    fn point(&mut self) -> [f64; 3] {
        [self.unit(), self.unit(), self.unit()]
    }
    fn grid(&mut self, n: u64) -> [f64; 3] {
        [self.below(n) as f64, self.below(n) as f64, self.below(n) as f64]
    }
    /// As in text files: six decimals.
    fn decimal(&mut self) -> f64 {
        format!("0.{:06}", self.below(1_000_000)).parse().expect("a number")
    }
    fn decimals(&mut self) -> [f64; 3] {
        [self.decimal(), self.decimal(), self.decimal()]
    }
    fn nudge(&mut self, x: f64) -> f64 {
        f64::from_bits(x.to_bits().wrapping_add(self.below(5)).wrapping_sub(2))
    }
    fn distinct<const N: usize>(&mut self, n: usize) -> [u32; N] {
        let mut ids = [0; N];
        for i in 0..N {
            ids[i] = loop {
                let id = self.below(n as u64) as u32;
                if !ids[..i].contains(&id) {
                    break id;
                }
            };
        }
        ids
    }
}

fn integer(x: f64) -> BigInt {
    let (mantissa, exponent) = range::decompose(x);
    let value = BigInt::from(mantissa) << (exponent + UNIT);
    if x < 0.0 {
        -value
    } else {
        value
    }
}

type Exact = [BigInt; 3];

/// The product of two numbers in units of 2^-UNIT.
fn times(a: &BigInt, b: &BigInt) -> BigInt {
    let scaled = a * b;
    let shifted: BigInt = &scaled >> UNIT;
    assert_eq!(&shifted << UNIT, scaled, "the unit is too coarse for the test");
    shifted
}

fn of_point(points: &Points, i: u32) -> Exact {
    let along = |from: u32, to: u32, by: &BigInt| -> Exact {
        let (from, to) = (of_point(points, from), of_point(points, to));
        [0, 1, 2].map(|k| times(&(&to[k] - &from[k]), by))
    };
    match points.position(i) {
        Position::Explicit => points.xyz(i).map(integer),
        Position::OnSegment { a, b, t } => {
            let t: BigInt = t.value().components().iter().map(|&x| integer(x)).sum();
            let (a, d) = (of_point(points, *a), along(*a, *b, &t));
            [0, 1, 2].map(|k| &a[k] + &d[k])
        }
        &Position::OnFacet { o, a, b, u, v } => {
            let (d, e) = (along(o, a, &integer(u)), along(o, b, &integer(v)));
            let o = of_point(points, o);
            [0, 1, 2].map(|k| &o[k] + &d[k] + &e[k])
        }
    }
}

fn sub(a: &Exact, b: &Exact) -> Exact {
    [&a[0] - &b[0], &a[1] - &b[1], &a[2] - &b[2]]
}
fn dot(a: &Exact, b: &Exact) -> BigInt {
    &a[0] * &b[0] + &a[1] * &b[1] + &a[2] * &b[2]
}
fn det3(a: &Exact, b: &Exact, c: &Exact) -> BigInt {
    &a[0] * (&b[1] * &c[2] - &b[2] * &c[1]) - &a[1] * (&b[0] * &c[2] - &b[2] * &c[0])
        + &a[2] * (&b[0] * &c[1] - &b[1] * &c[0])
}
fn sign(x: &BigInt) -> Sign {
    if x.is_zero() {
        Sign::Zero
    } else if x.is_positive() {
        Sign::Positive
    } else {
        Sign::Negative
    }
}

fn exact_orient3d(p: &[Exact; 4]) -> Sign {
    sign(&det3(&sub(&p[1], &p[0]), &sub(&p[2], &p[0]), &sub(&p[3], &p[0])))
}

fn exact_insphere(p: &[Exact; 5]) -> Sign {
    // The circumcentre's equations by Cramer's rule, relative to a: with D = det(b, c, d) and N = 2 D centre, the power
    // of e is |e|² − 2 centre·e = (D |e|² − N·e) / D; inside when it is negative.
    let [b, c, d, e] = [1, 2, 3, 4].map(|i| sub(&p[i], &p[0]));
    let (bb, cc, dd) = (dot(&b, &b), dot(&c, &c), dot(&d, &d));
    let cross = |u: &Exact, v: &Exact| {
        [&u[1] * &v[2] - &u[2] * &v[1], &u[2] * &v[0] - &u[0] * &v[2], &u[0] * &v[1] - &u[1] * &v[0]]
    };
    let (cd, db, bc) = (cross(&c, &d), cross(&d, &b), cross(&b, &c));
    let n = [0, 1, 2].map(|i| &bb * &cd[i] + &cc * &db[i] + &dd * &bc[i]);
    -sign(&(det3(&b, &c, &d) * dot(&e, &e) - dot(&n, &e)))
}

fn exact_orient2d(p: &[Exact; 3], axis: usize) -> Sign {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (b, c) = (sub(&p[1], &p[0]), sub(&p[2], &p[0]));
    sign(&(&b[u] * &c[v] - &b[v] * &c[u]))
}

fn exact_incircle(p: &[Exact; 4], axis: usize) -> Sign {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let row = |i: usize| {
        let r = sub(&p[i], &p[3]);
        [r[u].clone(), r[v].clone(), dot(&r, &r)]
    };
    sign(&det3(&row(0), &row(1), &row(2)))
}

/// All predicates on `count` random tuples of the points; returns how many signs of orient3d and insphere were zero.
fn compare_all(points: &Points, count: usize, random: &mut Random) -> [usize; 2] {
    let exact: Vec<Exact> = (0..points.len() as u32).map(|i| of_point(points, i)).collect();
    let mut zeros = [0, 0];
    for round in 0..count {
        let ids = random.distinct::<5>(points.len());
        let signs = compare(points, &exact, ids, round % 3, random);
        for (zeros, sign) in zeros.iter_mut().zip(signs) {
            *zeros += usize::from(sign == Sign::Zero);
        }
    }
    zeros
}

/// All predicates on these points; returns the signs of orient3d and insphere.
fn compare(points: &Points, exact: &[Exact], ids: [u32; 5], axis: usize, random: &mut Random) -> [Sign; 2] {
    let [a, b, c, d, e] = ids;
    let p = ids.map(|i| exact[i as usize].clone());
    let [pa, pb, pc, pd, _] = &p;
    let four = [pa.clone(), pb.clone(), pc.clone(), pd.clone()];
    let three = [pa.clone(), pb.clone(), pc.clone()];
    let orient = exact_orient3d(&four);
    let inside = exact_insphere(&p);
    assert_eq!(points.orient3d(a, b, c, d), orient, "orient3d {ids:?} {:?}", ids.map(|i| points.xyz(i)));
    if let Some(side) = points.plane(b, c, d).side(points.xyz(a)) {
        assert_eq!(side, orient, "plane {ids:?} {:?}", ids.map(|i| points.xyz(i)));
    }
    assert_eq!(points.insphere(a, b, c, d, e), inside, "insphere {ids:?} {:?}", ids.map(|i| points.xyz(i)));
    if orient == Sign::Positive {
        glance_is_right(points, [a, b, c, d], e, inside);
    }
    assert_eq!(points.orient_in_plane(axis, a, b, c), exact_orient2d(&three, axis));
    let dots = sign(&dot(&sub(pb, pa), &sub(pc, pa)));
    assert_eq!(points.dot_sign(a, b, c), dots);
    let order = pa.cmp(pb);
    assert_eq!(points.compare_lex(a, b), order);
    assert_eq!(points.same_position(a, b), order == Ordering::Equal);
    assert_eq!(points.collinear(a, b, c), (0..3).all(|k| exact_orient2d(&three, k) == Sign::Zero));
    if orient == Sign::Zero {
        let circle = exact_incircle(&four, axis);
        if circle != Sign::Zero {
            assert_eq!(points.incircle_in_plane(axis, a, b, c, d), circle);
        }
        circle_agrees_with_sphere(points, axis, ids);
    }
    if ids.iter().all(|&i| points.is_explicit(i)) {
        let [a, b, c, d, _] = ids.map(|i| points.xyz(i));
        assert_eq!(orient3d(a, b, c, d), orient);
        assert_eq!(orient2d([a[1], a[2]], [b[1], b[2]], [c[1], c[2]]), exact_orient2d(&three, 0));
    }
    perturbed_is_odd(points, ids, random);
    [orient, inside]
}

/// A glance at a positive tetrahedron never reports anything false.
fn glance_is_right(points: &Points, t: [u32; 4], e: u32, inside: Sign) {
    let of_face = |face: usize| {
        let mut v = t;
        v[face] = e;
        points.orient3d(v[0], v[1], v[2], v[3])
    };
    match points.glance(t, points.xyz(e)) {
        Glance::Inside => assert_eq!(inside, Sign::Positive, "glance at {t:?} from {e}"),
        Glance::Beyond(face) => {
            assert_eq!(of_face(face as usize), Sign::Negative, "glance at {t:?} from {e}")
        }
        // `static_filter_decides` tests that this is rare.
        Glance::Unclear => {}
    }
}

/// The perturbed sign of a permutation is the sign times the parity; never zero unless all five are coplanar.
fn perturbed_is_odd(points: &Points, ids: [u32; 5], random: &mut Random) {
    let of = |i: [u32; 5]| points.insphere_perturbed(i[0], i[1], i[2], i[3], i[4]);
    let first = of(ids);
    let mut swapped = ids;
    let (i, j) = (random.below(5) as usize, random.below(5) as usize);
    swapped.swap(i, j);
    assert_eq!(of(swapped), if i == j { first } else { -first }, "{ids:?} {i} {j}");
    if first == Sign::Zero {
        let [a, b, c, d, e] = ids;
        for f in [[a, b, c, d], [b, c, d, e], [a, c, d, e], [a, b, d, e], [a, b, c, e]] {
            assert_eq!(points.orient3d(f[0], f[1], f[2], f[3]), Sign::Zero);
        }
    }
}

/// For coplanar a, b, c, d and e off their plane the sign in the plane is the perturbed one in space.
fn circle_agrees_with_sphere(points: &Points, axis: usize, [a, b, c, d, e]: [u32; 5]) {
    let turn = points.orient_in_plane(axis, a, b, c);
    let side = points.orient3d(a, b, c, e);
    let apart = [(a, d), (b, d), (c, d)].iter().all(|&(i, j)| !points.same_position(i, j));
    if turn == Sign::Zero || side == Sign::Zero || !apart {
        return;
    }
    // Both signs are odd in a, b, c: swap where the turn is not to the left, or the tetrahedron not positive.
    let circle = points.incircle_in_plane(axis, a, b, c, d);
    let sphere = points.insphere_perturbed(a, b, c, e, d);
    assert_ne!(circle, Sign::Zero);
    assert_eq!(if turn == side { sphere } else { -sphere }, circle);
}

fn with_steiner(points: Vec<[f64; 3]>, count: usize, bits: u32, random: &mut Random) -> Points {
    let n = points.len();
    let mut points = Points::new(points);
    for i in 0..count {
        let [a, b] = random.distinct::<2>(n);
        let t = (random.below((1 << bits) - 1) + 1) as f64 / (1u64 << bits) as f64;
        // Every fourth parameter has more bits than a double.
        let rest = if i % 4 == 3 { scale(random.below(1 << 20) as f64 - 5e5, -110) } else { 0.0 };
        points.push_on_segment(a, b, &Expansion::from(t).sum(&rest.into())).expect("a point on a segment");
    }
    points
}

#[test]
fn conventions() {
    let corner = [
        [0.0; 3],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.3, 0.3, 0.3],
        [2.0, 2.0, 2.0],
        [1.0, 1.0, 1.0],
    ];
    let points = Points::new(corner.to_vec());
    assert_eq!(points.orient3d(0, 1, 2, 3), Sign::Positive);
    assert_eq!(points.insphere(0, 1, 2, 3, 4), Sign::Positive);
    assert_eq!(points.insphere(0, 1, 2, 3, 5), Sign::Negative);
    assert_eq!(points.insphere(0, 1, 2, 3, 6), Sign::Zero);
    assert_eq!(points.orient_in_plane(2, 0, 1, 2), Sign::Positive);
    assert_eq!(points.incircle_in_plane(2, 0, 1, 2, 4), Sign::Positive);
    assert_eq!(points.dot_sign(0, 1, 5), Sign::Positive);
}

#[test]
fn integer_grid() {
    let mut random = Random(1);
    for n in [3, 5, 1000] {
        let points = (0..60).map(|_| random.grid(n)).collect();
        let zeros = compare_all(&Points::new(points), 1500, &mut random);
        assert!(n > 5 || (zeros[0] > 50 && zeros[1] > 50), "{zeros:?}");
    }
}

#[test]
fn random_points() {
    let mut random = Random(2);
    let points = Points::new((0..100).map(|_| random.point()).collect());
    compare_all(&points, 500, &mut random);
    // The static filter is useful: it decides nearly all sides of points in general position.
    let told = (0..500).filter(|_| {
        let [a, b, c, d] = random.distinct::<4>(points.len());
        points.plane(b, c, d).side(points.xyz(a)).is_some()
    });
    assert!(told.count() > 450);
}

#[test]
fn cospherical_and_off_by_ulps() {
    let mut random = Random(3);
    // Integer points with x² + y² + z² = 9·25·49·4: many exact cospherical tuples.
    let mut sphere = Vec::new();
    for x in -210i32..=210 {
        for y in -210i32..=210 {
            let zz = 210 * 210 - x * x - y * y;
            let z = f64::from(zz.max(0)).sqrt() as i32;
            if zz >= 0 && z * z == zz {
                sphere.push([x, y, z].map(f64::from));
                sphere.push([x, y, -z].map(f64::from));
            }
        }
    }
    let exact: Vec<_> = (0..150).map(|_| sphere[random.below(sphere.len() as u64) as usize]).collect();
    let zeros = compare_all(&Points::new(exact.clone()), 500, &mut random);
    assert!(zeros[1] > 400, "{zeros:?}");
    let nudged = exact.iter().map(|p| p.map(|x| random.nudge(x + 1000.0))).collect();
    compare_all(&Points::new(nudged), 1000, &mut random);
}

#[test]
fn steiner_points() {
    let mut random = Random(4);
    for bits in [1, 4, 10, 30, 52] {
        let corners: Vec<_> = (0..15).map(|_| random.decimals()).collect();
        compare_all(&with_steiner(corners, 60, bits, &mut random), 400, &mut random);
        let grid: Vec<_> = (0..15).map(|_| random.grid(4)).collect();
        compare_all(&with_steiner(grid, 60, bits, &mut random), 300, &mut random);
    }
}

/// Decimal points in an axis plane and on a slanted plane, and Steiner points between them.
#[test]
fn coplanar_steiner_points() {
    let mut random = Random(5);
    for slanted in [false, true] {
        let plane: Vec<_> = (0..12)
            .map(|_| {
                let [x, y, _] = random.decimals();
                if slanted {
                    [x, y, x]
                } else {
                    [x, y, 0.1]
                }
            })
            .collect();
        let points = with_steiner(plane, 40, 7, &mut random);
        let zeros = compare_all(&points, 400, &mut random);
        assert_eq!(zeros, [400, 400]);
    }
}

/// Far from the origin the nearest doubles of Steiner points are off by much more than the rounding of the determinants.
#[test]
fn rounded_steiner_points_far_from_the_origin() {
    let mut random = Random(11);
    let mut wrong = 0;
    for round in 0..6 {
        let far = [1e3, 1e6][round / 3];
        let plane: Vec<_> = (0..12)
            .map(|_| {
                let [x, y, _] = random.decimals();
                [[x + far, y, x + far], [far + x, far + y, far - x * 0.5], [y, far + x, far + y]][round % 3]
            })
            .collect();
        let points = with_steiner(plane, 40, [3, 9, 25][round % 3], &mut random);
        compare_all(&points, 300, &mut random);
        // The test is meaningful: signs with the nearest doubles differ from the exact ones.
        for _ in 0..100 {
            let [a, b, c, d] = random.distinct::<4>(points.len());
            let rounded = [a, b, c, d].map(|i| points.xyz(i));
            let near = orient3d(rounded[0], rounded[1], rounded[2], rounded[3]);
            wrong += usize::from(near != points.orient3d(a, b, c, d));
        }
    }
    assert!(wrong > 100, "{wrong}");
}

/// Zeros among integers so large that the determinant in doubles rounds: the grid shortcut must not take these.
#[test]
fn large_integers_with_zeros() {
    let mut random = Random(14);
    let quarter = [[2.0, 3.0, 6.0], [6.0, 2.0, 3.0], [3.0, 6.0, 2.0], [0.0, 0.0, 7.0]];
    for factor in [37.0, 73.0, 1001.0, 54_321.0, 9_999_991.0] {
        let mut sphere: Vec<[f64; 3]> = Vec::new();
        for p in quarter {
            for signs in 0..8 {
                let flip = |i: usize| if signs >> i & 1 == 0 { factor } else { -factor };
                sphere.push([p[0] * flip(0), p[1] * flip(1), p[2] * flip(2)]);
            }
        }
        let zeros = compare_all(&Points::new(sphere), 300, &mut random);
        assert_eq!(zeros[1], 300);
        let plane = (0..40).map(|_| {
            let [x, y, _] = random.grid(9).map(|x| x * factor);
            [x + 1.0, y + 3.0, 3.0 * x - 7.0 * y]
        });
        compare_all(&Points::new(plane.collect()), 300, &mut random);
        let slanted = (0..40).map(|_| {
            let [x, y, _] = random.grid(factor as u64);
            [x, y, 3.0 * x - 7.0 * y]
        });
        let zeros = compare_all(&Points::new(slanted.collect()), 300, &mut random);
        assert_eq!(zeros[0], 300);
    }
}

/// The positive tetrahedra whose perturbed spheres are empty tile the hull, without overlaps, whatever the order of ids.
#[test]
fn perturbed_delaunay_fills_the_hull() {
    let mut random = Random(15);
    for (side, spacing) in [(1, 1.0), (1, 0.1), (2, 1.0)] {
        for middle in [false, true] {
            let mut corners = Vec::new();
            for i in 0..(side + 1) * (side + 1) * (side + 1) {
                let (x, y, z) = (i % (side + 1), i / (side + 1) % (side + 1), i / (side + 1) / (side + 1));
                corners.push([x, y, z].map(|x| 0.25 + spacing * f64::from(x)));
            }
            for i in (1..corners.len()).rev() {
                corners.swap(i, random.below(i as u64 + 1) as usize);
            }
            let mut points = Points::new(corners);
            let last = points.len() as u32 - 1;
            if middle {
                points.push_on_segment(0, last, &0.5.into()).expect("valid");
                points.push_on_segment(0, 1, &0.3.into()).expect("valid");
            }
            let n = points.len() as u32;
            let exact: Vec<Exact> = (0..n).map(|i| of_point(&points, i)).collect();
            let mut volume = BigInt::zero();
            for a in 0..n {
                for b in a + 1..n {
                    for c in b + 1..n {
                        for d in c + 1..n {
                            let (a, b) = match points.orient3d(a, b, c, d) {
                                Sign::Positive => (a, b),
                                Sign::Negative => (b, a),
                                Sign::Zero => continue,
                            };
                            let others = (0..n).filter(|e| ![a, b, c, d].contains(e));
                            let empty = |e: u32| points.insphere_perturbed(a, b, c, d, e) == Sign::Negative;
                            if others.into_iter().all(empty) {
                                let [p, q, r, s] = [a, b, c, d].map(|i| &exact[i as usize]);
                                volume += det3(&sub(q, p), &sub(r, p), &sub(s, p));
                            }
                        }
                    }
                }
            }
            let low = integer(0.25);
            let high = integer(0.25 + spacing * f64::from(side));
            let edge = high - low;
            assert_eq!(volume, &edge * &edge * &edge * 6);
        }
    }
}

/// The rule itself: the lift of the lowest id is lowered first.
#[test]
fn lowest_id_is_lowered_first() {
    let corner = |i: i32| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)];
    let points = Points::new((0..8).map(corner).collect());
    assert_eq!(points.orient3d(1, 2, 4, 7), Sign::Positive);
    assert_eq!(points.insphere_perturbed(1, 2, 4, 7, 0), Sign::Positive);
    // 0 to 3 are coplanar: orient3d without 0 decides first, and (1, 2, 3, 4) is negative.
    assert_eq!(points.insphere_perturbed(0, 1, 2, 3, 4), points.orient3d(1, 2, 3, 4));
    assert_eq!(points.orient3d(1, 2, 3, 4), Sign::Negative);
}

/// On random points the static bound decides nearly all calls.
#[test]
fn static_filter_decides() {
    let mut random = Random(13);
    let points = Points::new((0..1000).map(|_| random.point()).collect());
    let mut undecided = [0, 0, 0];
    for _ in 0..10_000 {
        let ids @ [a, b, c, d, e] = random.distinct::<5>(1000);
        if points.orient3d(a, b, c, d) == Sign::Positive && points.insphere(a, b, c, d, e) == Sign::Negative {
            let glance = points.glance([a, b, c, d], points.xyz(e));
            undecided[2] += usize::from(matches!(glance, Glance::Unclear));
        }
        let [a, b, c, d, e] = ids.map(|i| points.xyz(i));
        undecided[0] += usize::from(filter::orient3d_det(a, b, c, d).abs() <= points.orient3d_bound);
        undecided[1] += usize::from(filter::insphere_det(a, b, c, d, e).abs() <= points.insphere_bound);
    }
    assert!(undecided.iter().all(|&count| count < 10), "{undecided:?}");
}

/// Steiner points on one line are collinear, with both ends and in between.
#[test]
fn collinear_steiner_points() {
    let mut points = Points::new(vec![[0.1, 0.2, 0.3], [0.7, 0.45, 0.11], [0.0, 1.0, 0.0], [0.9, 0.8, 0.7]]);
    let on: Vec<u32> =
        [0.25, 0.375, 0.7].iter().map(|&t| points.push_on_segment(0, 1, &t.into()).expect("valid")).collect();
    let same = points.push_on_segment(1, 0, &0.75.into()).expect("valid");
    assert!(points.same_position(same, on[0]));
    assert!(
        points.collinear(0, on[0], on[1])
            && points.collinear(on[0], on[1], on[2])
            && points.collinear(1, on[2], on[1])
    );
    assert!(!points.collinear(0, on[0], 2));
    assert_eq!(points.orient3d(on[0], on[1], on[2], 2), Sign::Zero);
    assert_eq!(points.dot_sign(on[1], 0, 1), Sign::Negative);
}

/// Ends of the range, with Steiner points whose bits are below it (big integers).
#[test]
fn ends_of_the_range() {
    let mut random = Random(6);
    for exponent in [-140, -161, 150, 199] {
        let size = scale(1.0, exponent);
        let grid: Vec<_> = (0..25).map(|_| random.grid(4).map(|x| x * 0.25 * size)).collect();
        compare_all(&Points::new(grid.clone()), 300, &mut random);
        compare_all(&with_steiner(grid, 25, 3, &mut random), 300, &mut random);
        let decimal: Vec<_> = (0..25).map(|_| random.decimals().map(|x| (x + 1.0) * 0.5 * size)).collect();
        let points = with_steiner(decimal, 25, 40, &mut random);
        assert_eq!(exponent < -120, points.any_fine(&(25..50).collect::<Vec<_>>()));
        compare_all(&points, 200, &mut random);
    }
    // The whole range at once: largest and smallest coordinates in one set.
    let mixed: Vec<_> = (0..40)
        .map(|_| {
            [0, 1, 2].map(|_| {
                let x = scale(1.0 + random.unit() * random.below(2) as f64, random.below(360) as i32 - 161);
                if random.below(8) == 0 {
                    0.0
                } else {
                    x
                }
            })
        })
        .collect();
    assert!(mixed.iter().flatten().all(|&x| in_range(x)));
    compare_all(&Points::new(mixed.clone()), 300, &mut random);
    compare_all(&with_steiner(mixed, 20, 20, &mut random), 300, &mut random);
    // Lowest bits at the very bottom, insphere zero and one unit off.
    let u = scale(1.0, -214);
    let mut cube: Vec<[f64; 3]> =
        (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|x| f64::from(x) * u)).collect();
    cube.push([3.0 * u, 2.0 * u, 5.0 * u]);
    compare_all(&Points::new(cube), 300, &mut random);
}

/// Four cocircular points and any fifth one off the plane: the rule in the plane is the rule in space.
#[test]
fn circle_rule_is_the_sphere_rule() {
    let mut random = Random(7);
    let mut ties = 0;
    for round in 0..12_000 {
        // Twelve points of a circle in an axis plane, or in the plane x + y + z = 0.
        let axis = round % 3;
        let circle: Vec<[f64; 3]> = if round % 2 == 0 {
            let quarter = [[5.0, 0.0], [4.0, 3.0], [3.0, 4.0]];
            let turned = quarter.iter().flat_map(|&[x, y]| [[x, y], [-y, x], [-x, -y], [y, -x]]);
            turned.map(|[x, y]| [[1.0, x, y], [y, 1.0, x], [x, y, 1.0]][axis]).collect()
        } else {
            let [x, y, z] = [1.0, 2.0, -3.0];
            let half = [[x, y, z], [y, z, x], [z, x, y], [x, z, y], [z, y, x], [y, x, z]];
            half.iter().flat_map(|&p| [p, p.map(|x| -x)]).collect()
        };
        let mut all: Vec<[f64; 3]> = (0..5).map(|_| circle[random.below(12) as usize]).collect();
        all.push(random.grid(9));
        for i in (1..all.len()).rev() {
            all.swap(i, random.below(i as u64 + 1) as usize);
        }
        let points = Points::new(all);
        let [a, b, c, d, e] = random.distinct::<5>(points.len());
        if points.orient3d(a, b, c, d) == Sign::Zero {
            circle_agrees_with_sphere(&points, axis, [a, b, c, d, e]);
            let tie = points.insphere(a, b, c, e, d) == Sign::Zero;
            ties += usize::from(tie && points.orient3d(a, b, c, e) != Sign::Zero);
        }
    }
    assert!(ties > 900, "{ties}");
}
