//! Explicit points, points on segments and points on facets: all predicates on all combinations of kinds, and the constructor.
//!
//! Each family makes sets of points of all kinds; of every set, all 243 combinations of five kinds are compared.

use super::*;

/// The fewest cases of each family: 486, or as many as the environment variable `PROPTEST_CASES` says.
pub(super) fn cases() -> usize {
    let given = std::env::var("PROPTEST_CASES").ok().and_then(|cases| cases.parse().ok());
    given.unwrap_or(2 * COMBINATIONS)
}

/// The combinations of five points of three kinds.
const COMBINATIONS: usize = 243;

/// Points by kind: explicit, on segments, on facets. Not all points of the store need to be listed.
struct Mixture {
    points: Points,
    kinds: [Vec<u32>; 3],
}

impl Mixture {
    fn of(explicit: Vec<[f64; 3]>) -> Mixture {
        let all = (0..explicit.len() as u32).collect();
        Mixture { points: Points::new(explicit), kinds: [all, Vec::new(), Vec::new()] }
    }

    /// Adds a point of any kind; those that turn out to be explicit are listed as such.
    fn list(&mut self, i: u32) {
        let kind = match self.points.position(i) {
            Position::Explicit => 0,
            Position::OnSegment { .. } => 1,
            Position::OnFacet { .. } => 2,
        };
        self.kinds[kind].push(i);
    }

    fn on_segment(&mut self, a: u32, b: u32, t: impl Into<Expansion>) {
        let i = self.points.push_on_segment(a, b, &t.into()).expect("a point on a segment");
        self.list(i);
    }

    fn on_facet(&mut self, frame: [u32; 3], parameters: [f64; 2]) {
        let i = self.points.push_on_facet(frame, parameters).expect("a point on a facet");
        self.list(i);
    }

    /// Points on segments and facets between the first `n` points, until there are eight of each kind.
    fn fill(&mut self, n: usize, bits: u32, random: &mut Random) {
        for _ in 0..400 {
            if self.kinds[1].len() < 8 {
                let [a, b] = random.distinct::<2>(n);
                let t = random.parameter(bits);
                self.on_segment(a, b, t);
            }
            if self.kinds[2].len() < 8 {
                let frame @ [o, a, b] = random.distinct::<3>(n);
                if !self.points.collinear(o, a, b) {
                    let parameters = [0; 2].map(|_| random.parameter(bits) * random.outside());
                    self.on_facet(frame, parameters);
                }
            }
        }
    }
}

impl Random {
    /// Strictly between 0 and 1.
    fn parameter(&mut self, bits: u32) -> f64 {
        (1 + self.below((1 << bits) - 1)) as f64 / (1u64 << bits) as f64
    }

    /// A factor that leads out of the triangle in half of the cases.
    fn outside(&mut self) -> f64 {
        [0.5, 1.0, -1.0, 6.0][self.below(4) as usize]
    }

    fn nudged(&mut self, p: [f64; 3]) -> [f64; 3] {
        p.map(|x| self.nudge(x))
    }
}

/// What was compared.
#[derive(Debug, Default)]
struct Tally {
    cases: usize,
    /// Orientations that are zero.
    flat: usize,
    /// Orientations that the static filter leaves open.
    close: usize,
    /// Insphere signs that are zero.
    cospherical: usize,
}

/// Compares all combinations of kinds of each set until there are enough cases.
fn compare_family(seed: u64, make: impl Fn(usize, &mut Random) -> Mixture) -> Tally {
    let mut random = Random(seed);
    let mut tally = Tally::default();
    let mut seen = [false; COMBINATIONS];
    for set in 0..cases().div_ceil(COMBINATIONS) {
        let Mixture { points, kinds } = make(set, &mut random);
        let exact: Vec<Exact> = (0..points.len() as u32).map(|i| of_point(&points, i)).collect();
        for (combination, seen) in seen.iter_mut().enumerate() {
            let mut ids = [u32::MAX; 5];
            for i in 0..5 {
                let kind = &kinds[combination / 3usize.pow(i as u32) % 3];
                assert!(kind.len() >= 5, "too few points of a kind: {kinds:?}");
                ids[i] = loop {
                    let id = kind[random.below(kind.len() as u64) as usize];
                    if !ids[..i].contains(&id) {
                        break id;
                    }
                };
            }
            let [orient, inside] = compare(&points, &exact, ids, combination % 3, &mut random);
            let [a, b, c, d, _] = ids.map(|i| points.xyz(i));
            tally.flat += usize::from(orient == Sign::Zero);
            tally.cospherical += usize::from(inside == Sign::Zero);
            tally.close += usize::from(filter::orient3d_det(a, b, c, d).abs() <= points.orient3d_bound);
            tally.cases += 1;
            *seen = true;
        }
    }
    assert!(seen.iter().all(|&s| s));
    tally
}

#[test]
fn general_position() {
    let tally = compare_family(41, |set, random| {
        let bits = [1, 3, 6, 10, 20, 52][set % 6];
        let n = 12;
        let explicit = (0..n).map(|_| match set / 2 % 3 {
            0 => random.decimals(),
            1 => random.point(),
            _ => random.decimals().map(|x| f64::from(x as f32) * 1e3),
        });
        let mut mixture = Mixture::of(explicit.collect());
        // Where single bits of single precision make all points explicit, decimal ones follow.
        mixture.fill(n, bits, random);
        let first = mixture.points.len() as u32;
        for _ in 0..6 {
            let i = mixture.points.push(random.decimals()).expect("in range");
            mixture.list(i);
        }
        for k in 0..6 {
            mixture.on_segment(first + k, first + (k + 1) % 6, random.parameter(30));
            mixture.on_facet([first + k, first + (k + 1) % 6, first + (k + 3) % 6], [0.3, -1.7]);
        }
        mixture
    });
    assert!(tally.flat < tally.cases / 4 && tally.cospherical < tally.cases / 10, "{tally:?}");
}

#[test]
fn small_grid() {
    let tally = compare_family(42, |set, random| {
        // A grid that is not one of doubles: many exact coincidences.
        let explicit: Vec<_> = (0..14).map(|_| random.grid(3).map(|x| x * 0.1 + 0.7)).collect();
        let mut mixture = Mixture::of(explicit);
        mixture.fill(14, 1 + (set % 3) as u32, random);
        mixture
    });
    assert!(tally.flat > tally.cases / 20 && tally.cospherical < tally.cases / 2, "{tally:?}");
}

/// Points of one plane, with few off it: planes normal to an axis, a frame of decimals, and different frames of one integer plane.
#[test]
fn coplanar() {
    let tally = compare_family(43, |set, random| {
        let n = 7;
        let plane: Vec<[f64; 3]> = (0..n)
            .map(|_| match set % 3 {
                0 => [random.decimal(), 0.1, random.decimal()],
                1 => random.decimals(),
                _ => {
                    let [x, y, _] = random.grid(1 << 30);
                    [x, y, 3.0 * x - 7.0 * y]
                }
            })
            .collect();
        let mut mixture = Mixture::of(plane);
        let one_frame = set % 3 == 1;
        for k in 0..20 {
            let bits = [2, 5, 12, 30, 52][k % 5];
            let [mut o, mut a, mut b] = random.distinct::<3>(n);
            if one_frame {
                [o, a, b] = [[0, 1, 2], [1, 0, 2], [2, 0, 1]][k % 3];
            }
            // Not a grid of doubles even where the corners are on one.
            let t = random.parameter(bits) / 3.0;
            mixture.on_segment(o, a, t);
            if !mixture.points.collinear(o, a, b) {
                mixture.on_facet([o, a, b], [t * random.outside(), random.parameter(bits) / 3.0]);
            }
        }
        // Off the plane of the first three by a rounding error at most.
        for i in (n as u32..n as u32 + 6).rev() {
            let beside = mixture.points.xyz(i).map(|x| random.nudge(x));
            let i = mixture.points.push(beside).expect("in range");
            mixture.list(i);
        }
        mixture
    });
    assert!(tally.flat > tally.cases / 3, "{tally:?}");
}

/// Points on a facet are coplanar with each other and with what determines them; doubles an ulp beside are not in their plane.
#[test]
fn an_ulp_beside_a_facet() {
    let mut random = Random(44);
    let mut beside = [0, 0];
    for round in 0..cases() {
        let mut points = Points::new((0..3).map(|_| random.decimals()).collect());
        if points.collinear(0, 1, 2) {
            continue;
        }
        let bits = [2, 6, 12, 52][round % 4];
        let p: [u32; 4] = [0; 4].map(|_| {
            let parameters = [0; 2].map(|_| random.parameter(bits) * random.outside());
            points.push_on_facet([0, 1, 2], parameters).expect("valid")
        });
        let s = points.push_on_segment(1, 2, &random.parameter(bits).into()).expect("valid");
        let coplanar = [0, 1, 2, p[0], p[1], p[2], p[3], s];
        for _ in 0..10 {
            let [i, j, k, l] = random.distinct::<4>(8).map(|i| coplanar[i as usize]);
            assert_eq!(points.orient3d(i, j, k, l), Sign::Zero);
        }
        // The nearest doubles and their neighbours along the axis nearest to the normal: at most one is in the plane.
        let axis = (0..3).find(|&axis| points.orient_in_plane(axis, 0, 1, 2) != Sign::Zero).expect("a plane");
        let nearest = *points.xyz(p[0]);
        let moved = |f: fn(f64) -> f64| {
            let mut q = nearest;
            q[axis] = f(q[axis]);
            q
        };
        let near = [moved(f64::next_up), nearest, moved(f64::next_down)];
        let near = near.map(|q| points.push(q).expect("in range"));
        let exact: Vec<Exact> = (0..points.len() as u32).map(|i| of_point(&points, i)).collect();
        for triple in [[0, 1, 2], [p[1], s, p[2]], [p[0], 0, p[3]]] {
            let of = |q: u32| points.orient3d(triple[0], triple[1], triple[2], q);
            for q in near {
                let four = [triple[0], triple[1], triple[2], q].map(|i| exact[i as usize].clone());
                assert_eq!(of(q), exact_orient3d(&four));
                // Three swaps bring the last point to the front.
                assert_eq!(of(q), -points.orient3d_of(points.xyz(q), 0, triple));
            }
            let spans = !points.collinear(triple[0], triple[1], triple[2]);
            let zeros = near.iter().filter(|&&q| of(q) == Sign::Zero).count();
            assert!(zeros <= 1 || !spans, "{zeros}");
            beside[usize::from(zeros == 0)] += 1;
        }
    }
    assert!(beside[1] > 20 * beside[0], "{beside:?}");
}

/// A sphere of integer points round a centre where doubles are multiples of four: most of them can only be positions on segments or
/// facets. All are exactly cospherical, or moved by a tiny change of a parameter.
fn lattice_sphere(moved: bool, random: &mut Random) -> Mixture {
    const RADIUS: i64 = 315;
    let centre = [(3 << 53) - 1, 3 << 53, 5 << 52];
    let mut sphere = Vec::new();
    for x in -RADIUS..=RADIUS {
        for y in -RADIUS..=RADIUS {
            let zz = RADIUS * RADIUS - x * x - y * y;
            let z = (zz.max(0) as f64).sqrt() as i64;
            if zz >= 0 && z * z == zz {
                sphere.push([centre[0] + x, centre[1] + y, centre[2] + z]);
                sphere.push([centre[0] + x, centre[1] + y, centre[2] - z]);
            }
        }
    }
    let on_grid = |p: &[i64; 3]| p.iter().all(|x| x % 4 == 0);
    let doubles = |p: [i64; 3]| p.map(|x| x as f64);
    let explicit: Vec<_> = sphere.iter().copied().filter(on_grid).map(doubles).collect();
    let chosen = (0..10).map(|_| explicit[random.below(explicit.len() as u64) as usize]).collect();
    let mut mixture = Mixture::of(chosen);
    let corner = |mixture: &mut Mixture, p: [i64; 3]| mixture.points.push(p.map(|x| x as f64)).expect("fits");
    let change = |random: &mut Random| match moved {
        true => scale([-1.0, 0.0, 1.0][random.below(3) as usize], -40 - random.below(30) as i32),
        false => 0.0,
    };
    while mixture.kinds[1].len() < 10 || mixture.kinds[2].len() < 10 {
        let p = sphere[random.below(sphere.len() as u64) as usize];
        if on_grid(&p) {
            continue;
        }
        let near = p.map(|x| x / 4 * 4 + 4 * random.below(1 << 10) as i64 - (1 << 11));
        let a = corner(&mut mixture, near);
        if mixture.kinds[1].len() < 10 {
            // A quarter of the way.
            let b = corner(&mut mixture, [0, 1, 2].map(|k| near[k] + 4 * (p[k] - near[k])));
            mixture.on_segment(a, b, Expansion::from(0.25).sum(&change(random).into()));
            continue;
        }
        let second = [0; 3].map(|_| 4 * random.below(1 << 10) as i64);
        let (v, count) = [(0.25, 1), (0.75, 3), (-1.25, -5)][random.below(3) as usize];
        let first = [0, 1, 2].map(|k| 4 * (p[k] - near[k]) - count * second[k]);
        let [b, c] = [first, second].map(|e| [0, 1, 2].map(|k| near[k] + e[k]));
        let frame = [a, corner(&mut mixture, b), corner(&mut mixture, c)];
        if !mixture.points.collinear(frame[0], frame[1], frame[2]) {
            mixture.on_facet(frame, [0.25 + change(random), v + change(random)]);
        }
    }
    mixture
}

#[test]
fn cospherical() {
    let tally = compare_family(45, |_, random| lattice_sphere(false, random));
    assert_eq!(tally.cospherical, tally.cases);
}

#[test]
fn nearly_cospherical() {
    let tally = compare_family(46, |_, random| lattice_sphere(true, random));
    assert!(tally.cospherical > tally.cases / 100 && tally.cospherical < tally.cases / 2, "{tally:?}");
}

/// The images of a point under changes of signs are cospherical, however many doubles its coordinates take.
#[test]
fn cospherical_by_symmetry() {
    let three_doubles = std::cell::Cell::new(0);
    let tally = compare_family(47, |set, random| {
        let wide = set % 2 == 0;
        let mut corner = || [0; 3].map(|_| (random.below(1 << 50) + 1) as f64 * if wide { 8.0 } else { 0.1 });
        let [o, e, f] = [corner(), corner(), corner()];
        let small = if wide { scale(1.0, -40) } else { 1.0 };
        let [u, v] = [0; 2].map(|_| random.parameter(53) * small);
        let mut mixture = Mixture::of(Vec::new());
        for signs in 0..8 {
            let image = |p: [f64; 3]| [0, 1, 2].map(|k| if signs >> k & 1 == 0 { p[k] } else { -p[k] });
            let frame = [o, e, f].map(|p| mixture.points.push(image(p)).expect("in range"));
            mixture.list(frame[0]);
            mixture.on_segment(frame[0], frame[1], u);
            mixture.on_facet(frame, [u, v]);
            let last = mixture.points.len() as u32 - 1;
            let [x, ..] = mixture.points.exact_coordinates(last);
            three_doubles.set(three_doubles.get() + usize::from(x.components().len() > 2));
        }
        mixture
    });
    // Five of one kind, of three kinds.
    assert!(tally.cospherical >= tally.cases / 81, "{tally:?}");
    assert!(three_doubles.get() > 0);
}

/// Facets whose planes differ by rounding errors, and doubles next to points on them.
#[test]
fn nearly_degenerate() {
    let tally = compare_family(48, |set, random| {
        let base: Vec<[f64; 3]> = (0..3).map(|_| random.decimals().map(|x| x + 1.0)).collect();
        let mut corners = base.clone();
        for _ in 0..3 {
            corners.extend(base.iter().map(|&p| random.nudged(p)));
        }
        let mut mixture = Mixture::of(corners);
        let parameters = [0; 2].map(|_| random.parameter([3, 8, 40][set % 3]));
        for k in 0..4 {
            let frame = [3 * k, 3 * k + 1, 3 * k + 2];
            for i in 0..3 {
                let change = scale(random.below(3) as f64 - 1.0, -50);
                let [u, v] = parameters.map(|x| x * [0.25, 0.5, 1.0][i] + change);
                mixture.on_facet(frame, [u, v]);
                mixture.on_segment(frame[i], frame[(i + 1) % 3], u);
                // Positions that share only some of their points, in planes that differ by as little.
                let other = frame.map(|i| (i + 3) % 12);
                mixture.on_segment(frame[i], other[(i + 1) % 3], v);
                mixture.on_facet([frame[0], frame[1], other[2]], [v, u]);
                let beside = *mixture.points.xyz(mixture.points.len() as u32 - 1);
                let i = mixture.points.push(random.nudged(beside)).expect("in range");
                mixture.list(i);
            }
        }
        mixture
    });
    assert!(tally.close > tally.cases * 9 / 10 && tally.flat < tally.cases / 10, "{tally:?}");
}

/// Ends of the range: coordinates with bits below it and large ones, and frames far smaller than the distance of the point.
#[test]
fn ends_of_the_range() {
    let fine = std::cell::Cell::new(0);
    compare_family(49, |set, random| {
        let size = scale(1.0, [-161, -140, 150, 195][set % 4]);
        let mut mixture = Mixture::of((0..10).map(|_| random.decimals().map(|x| (x + 1.0) * size)).collect());
        let bits = [20, 52][set / 4 % 2];
        mixture.fill(10, bits, random);
        fine.set(fine.get() + usize::from(mixture.points.any_fine(&mixture.kinds[2])));
        // A frame of a few ulps, and parameters that lead far away from it.
        let o = mixture.points.xyz(0).map(|x| x + random.below(4) as f64 * scale(x, -52));
        let [a, b] = [0; 2].map(|_| o.map(|x| x + (1 + random.below(9)) as f64 * scale(x, -52)));
        let frame = [o, a, b].map(|p| mixture.points.push(p).expect("in range"));
        if !mixture.points.collinear(frame[0], frame[1], frame[2]) {
            for _ in 0..4 {
                let parameters = [0; 2].map(|_| (random.unit() - 0.5) * scale(1.0, random.below(48) as i32));
                mixture.on_facet(frame, parameters);
            }
        }
        mixture
    });
    assert!(fine.get() > 0);
}

/// What the head of `range` derives: coordinates are exact at the limits of the parameters, and refused beyond them.
#[test]
fn limits_of_the_parameters() {
    /// Exact integers in units of 2^-1100.
    fn unbounded(x: f64) -> BigInt {
        let (mantissa, exponent) = range::decompose(x);
        let value = BigInt::from(mantissa) << (exponent + 1100);
        if x < 0.0 {
            -value
        } else {
            value
        }
    }
    let unit = BigInt::from(1) << 1100;
    let mut random = Random(50);
    let mut outcomes = [0, 0, 0];
    for round in 0..cases() {
        let mut corner = || {
            [0; 3].map(|_| {
                let exponent = [-161, -100, 0, 100, 199][random.below(5) as usize];
                let x = scale(1.0 + random.unit(), exponent);
                if random.below(2) == 0 {
                    x
                } else {
                    -x
                }
            })
        };
        let o = corner();
        let near = [0; 3].map(|_| scale(1.0, LOWEST));
        let ends = match round % 3 {
            0 => [corner(), corner()],
            // Frames of the smallest size, so that the largest parameters do not leave the box.
            1 => [[near[0], 0.0, 0.0], [0.0, near[1], 0.0]],
            _ => [corner(), [near[0], 0.0, near[2]]],
        };
        let o = if round % 3 == 0 { o } else { [0.0; 3] };
        let mut points = Points::new(vec![o, ends[0], ends[1]]);
        let parameters = [0; 2].map(|_| {
            let lowest = -800 + random.below(1240) as i32;
            let mantissa = (random.next() >> (11 + random.below(53))) as f64 + 1.0;
            let x = scale(mantissa, lowest);
            if random.below(2) == 0 {
                x
            } else {
                -x
            }
        });
        let valid = parameters.iter().all(|&x| is_facet_parameter(x));
        let wanted: [BigInt; 3] = [0, 1, 2].map(|k| {
            let [a, b] = ends.map(|e| unbounded(e[k]) - unbounded(o[k]));
            unbounded(o[k]) * &unit + a * unbounded(parameters[0]) + b * unbounded(parameters[1])
        });
        match points.push_on_facet([0, 1, 2], parameters) {
            Ok(i) => {
                for (x, wanted) in points.exact_coordinates(i).iter().zip(&wanted) {
                    let value: BigInt = x.components().iter().map(|&x| unbounded(x)).sum();
                    assert_eq!(&(value * &unit), wanted, "{o:?} {ends:?} {parameters:?}");
                }
                outcomes[0] += 1;
            }
            Err(_) if valid => {
                // Outside the box, up to rounding.
                let limit = unbounded(scale(1.0, 200)) * &unit;
                assert!(points.collinear(0, 1, 2) || wanted.iter().any(|x| x.abs() > limit));
                outcomes[1] += 1;
            }
            Err(_) => outcomes[2] += 1,
        }
    }
    assert!(outcomes.iter().all(|&n| n > cases() / 50), "{outcomes:?}");
}

const LOWEST: i32 = range::LOWEST_EXPONENT;

#[test]
fn positions_in_the_store() {
    let mut points = Points::new(vec![[0.1, 0.2, 0.3], [0.7, 0.45, 0.11], [0.0, 1.0, 0.6], [0.4, 0.7, 0.7]]);
    let frame = [0, 1, 2];
    assert_eq!(points.push_on_segment(0, 1, &0.3.into()).ok(), Some(4));
    assert_eq!(points.push_on_facet(frame, [0.3, 0.4]).ok(), Some(5));
    assert!(matches!(points.position(3), Position::Explicit));
    assert!(matches!(points.position(4), Position::OnSegment { a: 0, b: 1, .. }));
    assert!(
        matches!(*points.position(5), Position::OnFacet { o: 0, a: 1, b: 2, u, v } if [u, v] == [0.3, 0.4])
    );
    assert!(points.implicit_parameters(5).is_none() && !points.is_explicit(5));
    // A corner of the frame, and a point of which all coordinates are doubles, are explicit.
    assert_eq!(points.push_on_facet(frame, [0.0, 1.0]).ok(), Some(6));
    assert!(points.is_explicit(6) && points.same_position(6, 2));
    let mut grid = Points::new(vec![[0.0; 3], [3.0, 0.0, 1.0], [0.0, 5.0, 7.0]]);
    let i = grid.push_on_facet([0, 1, 2], [0.375, -0.5]).expect("valid");
    assert!(grid.is_explicit(i) && *grid.xyz(i) == [1.125, -2.5, -3.125]);
    // On a side of the frame a facet's point is a segment's.
    assert_eq!(points.push_on_facet(frame, [0.3, 0.0]).ok(), Some(7));
    assert!(points.same_position(4, 7) && points.compare_lex(4, 7).is_eq());
    let refused = |points: &mut Points, frame, parameters| {
        let before = points.len();
        points.push_on_facet(frame, parameters).is_err() && points.len() == before
    };
    for bad in [f64::NAN, f64::INFINITY, scale(1.0, 416), scale(1.0, -801), -scale(1.5, -800)] {
        assert!(!is_facet_parameter(bad));
        assert!(refused(&mut points, frame, [bad, 0.5]) && refused(&mut points, frame, [0.5, bad]), "{bad}");
    }
    assert!(is_facet_parameter(-scale(1.0, 415)) && is_facet_parameter(scale(1.0, -800)));
    assert!(refused(&mut points, frame, [scale(1.0, 202), 0.0]), "outside the box");
    assert!(refused(&mut points, [0, 1, 5], [0.5, 0.5]), "an implicit corner");
    assert!(refused(&mut points, [0, 1, 99], [0.5, 0.5]), "no such point");
    assert!(refused(&mut points, [0, 1, 1], [0.5, 0.5]), "a collinear frame");
    // Points far out enlarge the static bounds, implicit or not.
    let before = points.orient3d_bound;
    let i = points.push_on_facet(frame, [100.3, 0.1]).expect("valid");
    assert!(!points.is_explicit(i) && points.orient3d_bound > 1e4 * before);
    points.truncate(6);
    assert!(!points.is_explicit(5) && points.len() == 6);
    points.truncate(4);
    assert_eq!(points.push_on_facet(frame, [0.3, 0.4]).ok(), Some(4));
    assert!(!points.is_explicit(4));
    points.settle(4, [0.5; 3]).expect("in range");
    assert!(points.is_explicit(4) && matches!(points.position(4), Position::Explicit));
}
