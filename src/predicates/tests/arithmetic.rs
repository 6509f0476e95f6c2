//! Expansions, wide integers, the point store and the range of coordinates.

use super::*;

/// The integers of fixed width at the limits of what they accept, against big integers of any size.
#[test]
fn widest_integers() {
    let mut random = Random(12);
    let mut wide_enough = [0, 0];
    for round in 0..3000 {
        // Signed coordinates up to 2^high with bits down to 1 in the second double.
        let high = [54, 60, 61, 62, 110, 121, 122, 123, 124, 125][round % 10];
        let p: [[[f64; 2]; 3]; 5] = [0; 5].map(|_| {
            [0; 3].map(|_| {
                let sign = |random: &mut Random| if random.below(2) == 0 { 1.0 } else { -1.0 };
                let size = [random.unit(), 1.0 - f64::EPSILON / 2.0, 1.0][random.below(3) as usize];
                let main = (sign(&mut random) * scale(size, high)).round();
                [main, if high > 60 { sign(&mut random) * random.below(3) as f64 } else { 0.0 }]
            })
        });
        let exact = p.map(|q| q.map(|[x, y]| integer(x) + integer(y)));
        let four = [0, 1, 2, 3].map(|i| exact[i].clone());
        let three = [0, 1, 2].map(|i| exact[i].clone());
        if let Some(rows) = wide::Differences::new(&p) {
            wide_enough[usize::from(matches!(rows, wide::Differences::Long(_)))] += 1;
            assert_eq!(wide::insphere(&rows), exact_insphere(&exact));
        } else {
            assert!(high > 120);
        }
        if let Some(rows) = wide::Differences::new(&[p[0], p[1], p[2], p[3]]) {
            assert_eq!(wide::orient3d(&rows), exact_orient3d(&four));
            assert_eq!(wide::incircle(&rows, 1, 2), exact_incircle(&four, 0));
        }
        if let Some(rows) = wide::Differences::new(&[p[0], p[1], p[2]]) {
            assert_eq!(wide::orient2d(&rows, 1, 2), exact_orient2d(&three, 0));
            let dots = dot(&sub(&three[0], &three[2]), &sub(&three[1], &three[2]));
            assert_eq!(wide::dot_sign(&rows), sign(&dots));
        }
        if high <= 60 {
            let q = p.map(|q| q.map(|x| x[0]));
            let size = filter::Spread::of([&q[0], &q[1], &q[2]]).max();
            let rows = wide::short_differences([&q[0], &q[1], &q[2]], size).unwrap();
            assert_eq!(wide::short_orient2d(&rows), exact_orient2d(&three, 2));
        }
    }
    assert!(wide_enough[0] > 300 && wide_enough[1] > 900, "{wide_enough:?}");
}

/// Leading bits decide correctly or not at all, and they nearly always decide unless the five points are cospherical.
#[test]
fn leading_bits() {
    let mut random = Random(31);
    let mut undecided = [0, 0];
    for round in 0..6000 {
        // Far from the origin as seen from each other, with bits far down in the second double.
        let [high, low] = [[60, 0], [90, 0], [150, 60], [170, 100]][round % 4];
        let far = [0; 3].map(|_| if round % 3 == 0 { 0.0 } else { scale(random.unit(), high + 30) });
        let corner = |random: &mut Random, i: u64| -> [[f64; 2]; 3] {
            std::array::from_fn(|axis| {
                let cube = far[axis] + scale((i >> axis & 1) as f64, high);
                let other = far[axis] + scale(random.unit(), high);
                [if round % 5 == 0 { cube } else { other }, 0.0]
            })
        };
        let mut p = [0, 1, 2, 4, 7].map(|i| corner(&mut random, i));
        let cospherical = round % 5 == 0 && round % 2 == 0;
        if !cospherical {
            for x in p.iter_mut().flatten() {
                x[1] = (random.unit() - 0.5) * scale(1.0, low);
            }
        }
        let exact = p.map(|q| q.map(|[x, y]| integer(x) + integer(y)));
        match wide::insphere_leading(&p, 0.0) {
            Some(sign) => assert_eq!(sign, exact_insphere(&exact)),
            None => undecided[usize::from(cospherical)] += 1,
        }
        // The lost part matters: no decision may come from bits below it.
        if let Some(sign) = wide::insphere_leading(&p, scale(1.0, high - 60)) {
            let moved = p.map(|q| q.map(|[x, y]| integer(x) + integer(y) + integer(scale(0.9, high - 60))));
            let mixed =
                [0, 1, 2, 3, 4]
                    .map(|i| if round >> i & 1 == 0 { exact[i].clone() } else { moved[i].clone() });
            assert_eq!(sign, exact_insphere(&mixed));
        }
    }
    assert_eq!(undecided[1], 600);
    assert!(undecided[0] < 20, "{undecided:?}");
}

#[test]
fn nearest_is_rounded_correctly() {
    let mut random = Random(8);
    for round in 0..5000 {
        let mut e = Expansion::zero();
        for _ in 0..4 {
            let size = scale(1.0, random.below(120) as i32 - 60);
            let x = if round % 2 == 0 { random.unit() * size } else { size };
            e = e.sum(&Expansion::from(if random.below(2) == 0 { x } else { -x }));
        }
        let exact: BigInt = e.components().iter().map(|&x| integer(x)).sum();
        let nearest = e.nearest();
        assert_eq!(nearest, e.compressed().nearest());
        assert_eq!(sign(&exact), e.sign());
        let distance = |x: f64| (integer(x) - &exact).abs();
        let even = |x: f64| x.to_bits() & 1 == 0;
        for other in [nearest.next_up(), nearest.next_down()] {
            let (here, there) = (distance(nearest), distance(other));
            assert!(nearest == 0.0 || here < there || (here == there && even(nearest)), "{e:?}");
        }
    }
}

#[test]
fn expansion_arithmetic() {
    let mut random = Random(9);
    let unit = BigInt::from(1) << UNIT;
    for _ in 0..2000 {
        let mut make = || {
            let mut e = Expansion::zero();
            for _ in 0..random.below(9) {
                e = e.sum(&Expansion::from((random.unit() - 0.5) * scale(1.0, random.below(90) as i32 - 45)));
            }
            e
        };
        let (e, f) = (make(), make());
        let value = |e: &Expansion| -> BigInt { e.components().iter().map(|&x| integer(x)).sum() };
        assert_eq!(value(&e.sum(&f)), value(&e) + value(&f));
        assert_eq!(value(&e.difference(&f)), value(&e) - value(&f));
        assert_eq!(value(&e.product(&f)) * &unit, value(&e) * value(&f));
        let compressed = e.compressed();
        assert_eq!(value(&compressed), value(&e));
        assert!(compressed.components().windows(2).all(|w| w[0].abs() <= w[1].abs() * f64::EPSILON));
    }
}

#[test]
fn exact_bits_are_sound_and_maximal() {
    let mut random = Random(10);
    let mut seen = [false; 54];
    for round in 0..600 {
        let point = |random: &mut Random| match round % 5 {
            0 => random.grid(64),
            1 => random.decimals(),
            2 => random.decimals().map(|x| f64::from(x as f32)),
            3 => random.grid(3).map(|x| x * 0.1),
            _ => random.grid(9).map(|x| x - 4.0),
        };
        let (a, b) = (point(&mut random), point(&mut random));
        let mut points = Points::new(vec![a, b]);
        let n = points.exact_bits(0, 1);
        seen[n as usize] = true;
        let mut all_exact = |bits: u32| {
            let last = (1u64 << bits) - 1;
            let all =
                if bits <= 6 { (1..=last).collect() } else { vec![1, 3, last / 2, last / 3, last - 2, last] };
            all.iter().all(|&k| {
                let i = points.push_on_segment(0, 1, &(k as f64 / (last + 1) as f64).into()).expect("valid");
                points.is_explicit(i)
            })
        };
        assert!(n == 0 || all_exact(n), "{a:?} {b:?} {n}");
        assert!(n == 52 || a == b || !all_exact(n + 1), "{a:?} {b:?} {n}");
    }
    assert!(seen.iter().filter(|&&s| s).count() > 15, "{seen:?}");
}

#[test]
fn store_of_points() {
    let mut points = Points::new(vec![[0.0; 3], [1.0, 1.0, 1.0], [0.1, 0.2, 0.3], [0.7, 0.9, 0.8]]);
    assert_eq!(points.push_on_segment(0, 1, &0.5.into()).ok(), Some(4));
    assert!(points.is_explicit(4));
    assert_eq!(points.push_on_segment(2, 3, &(1.0 / 3.0).into()).ok(), Some(5));
    assert_eq!(points.implicit_parameters(5).map(|p| p.2.nearest()), Some(1.0 / 3.0));
    assert_eq!(points.push([0.5, 0.1, 0.3]).ok(), Some(6));
    assert!(points.is_explicit(6) && !points.is_explicit(5));
    assert!(points.push_on_segment(2, 5, &0.5.into()).is_err(), "an implicit end");
    assert!(points.push_on_segment(2, 9, &0.5.into()).is_err(), "no such point");
    assert!(
        points.push_on_segment(2, 3, &scale(1.0, -801).into()).is_err()
            && points.push_on_segment(2, 3, &1.0.into()).is_err()
    );
    assert!(
        points.push_on_segment(2, 3, &f64::NAN.into()).is_err()
            && points.push_on_segment(2, 3, &0.0.into()).is_err()
    );
    assert!(points.push([f64::NAN, 0.0, 0.0]).is_err() && points.push([1e-70, 0.0, 0.0]).is_err());
    let [x, ..] = points.exact_coordinates(5);
    assert_eq!(x.nearest(), points.xyz(5)[0]);
    points.truncate(5);
    assert_eq!(points.len(), 5);
    assert_eq!(points.push_on_segment(2, 3, &0.3.into()).ok(), Some(5));
    assert!(!points.is_explicit(5));
    points.truncate(6);
    assert!(!points.is_explicit(5));
    // A point outside the box enlarges the static bounds.
    let before = points.orient3d_bound;
    points.push([100.0, 0.0, 0.0]).expect("in range");
    assert!(points.orient3d_bound > before);
}

#[test]
fn range_and_scale() {
    assert_eq!(range_scale(&[[0.0; 3]]), Ok(0));
    assert_eq!(range_scale(&[[1.0, -1e40, 1e-30]]), Ok(0));
    assert_eq!(range_scale(&[[1.0, 0.0, 0.0], [0.0, f64::NAN, 0.0]]), Err(1));
    let huge = [[f64::MAX, 1e290, 0.0]];
    assert_eq!(range_scale(&huge), Ok(195 - 1023));
    let small = [[5e-324, 0.0, 1e-320]];
    let k = range_scale(&small).expect("in range");
    for &x in small.iter().chain(&huge).flatten() {
        let k = if x > 1.0 { 195 - 1023 } else { k };
        assert!(in_range(scale(x, k)));
        assert_eq!(scale(scale(x, k), -k), x);
    }
    assert_eq!(range_scale(&[[1e300, 0.0, 0.0], [0.0, 0.0, 1e-300]]), Err(1));
    // The point far from most others is at fault, and so is a point that spans too much by itself.
    assert_eq!(range_scale(&[[1.0; 3], [1.0, 0.1, 1e300], [0.1; 3]]), Err(1));
    assert_eq!(
        far_from_most(&[[1.0; 3], [0.1, 1e300, 0.0], [1e300; 3], [0.0; 3], [2.0; 3]]).collect::<Vec<_>>(),
        [1, 2]
    );
    assert_eq!(scale(5e-324, 1074), 1.0);
    assert_eq!(scale(1.0, -1074), 5e-324);
    assert_eq!(scale(1.0 + f64::EPSILON, -1074), 5e-324);
    assert_eq!(scale(1.5 + f64::EPSILON, -1074), 1e-323);
    assert_eq!(scale(3.0, 2000), f64::INFINITY);
}
