//! Points put into triangles of facets: strictly inside, near the wanted position, with few bits.

use super::*;

/// The parameters of a point on a facet.
fn parameters(points: &Points, i: u32) -> Option<[f64; 2]> {
    match *points.position(i) {
        Position::OnFacet { u, v, .. } => Some([u, v]),
        _ => None,
    }
}

fn bits(x: f64) -> i32 {
    let lowest = range::lowest_exponent(x);
    lowest.map_or(0, |lowest| range::highest_exponent(x).expect("not zero") - lowest + 1)
}

/// The weights of the corners of a triangle that give a point of its plane, rounded: by exact determinants.
fn weights(points: &Points, triangle: [u32; 3], p: &Exact) -> [f64; 3] {
    let [x, y, z] = triangle.map(|i| of_point(points, i));
    let axis =
        (0..3).find(|&axis| !turn(&[x.clone(), y.clone(), z.clone()], axis).is_zero()).expect("not flat");
    let whole = turn(&[x.clone(), y.clone(), z.clone()], axis);
    [[p, &y, &z], [&x, p, &z], [&x, &y, p]].map(|t| {
        let part = turn(&t.map(Clone::clone), axis);
        let thousandths = (part * (1i64 << 40)) / &whole;
        i64::try_from(thousandths).expect("not far away") as f64 / (1i64 << 40) as f64
    })
}

fn turn(p: &[Exact; 3], axis: usize) -> BigInt {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let (b, c) = (sub(&p[1], &p[0]), sub(&p[2], &p[0]));
    &b[u] * &c[v] - &b[v] * &c[u]
}

/// The point is in the plane and strictly inside, by exact determinants; returns its weights.
fn strictly_inside(points: &Points, frame: [u32; 3], triangle: [u32; 3], i: u32) -> [f64; 3] {
    let p = of_point(points, i);
    let [o, a, b] = frame.map(|i| of_point(points, i));
    assert_eq!(exact_orient3d(&[o, a, b, p.clone()]), Sign::Zero);
    let [x, y, z] = triangle.map(|i| of_point(points, i));
    let mut seen = 0;
    for axis in 0..3 {
        let whole = turn(&[x.clone(), y.clone(), z.clone()], axis);
        if !whole.is_zero() {
            for t in [[&p, &y, &z], [&x, &p, &z], [&x, &y, &p]] {
                assert_eq!(sign(&turn(&t.map(Clone::clone), axis)), sign(&whole));
            }
            seen += 1;
        }
    }
    assert!(seen > 0);
    weights(points, triangle, &p)
}

/// Frames of decimals, single precision and grids; triangles of corners of all kinds; wanted positions inside and outside.
#[test]
fn points_inside_triangles() {
    let mut random = Random(61);
    let (mut most_bits, mut explicit, mut count, mut wanted_inside) = (0, [0; 4], [0; 4], 0);
    for round in 0..positions::cases() {
        let kind = round % 4;
        let corners = [0; 3].map(|_| match kind {
            0 => random.decimals(),
            1 => random.decimals().map(|x| f64::from(x as f32)),
            2 => [random.decimal(), random.decimal(), 0.1],
            _ => random.grid(5),
        });
        let mut points = Points::new(corners.to_vec());
        let frame = [0, 1, 2];
        if points.collinear(0, 1, 2) {
            continue;
        }
        let triangle = match round / 4 % 3 {
            0 => frame,
            1 => [points.push_on_segment(1, 2, &random.unit().max(0.1).into()).expect("valid"), 0, 1],
            _ => [0; 3].map(|_| {
                let parameters = [0; 2].map(|_| (random.below(1 << 10) as f64 - 300.0) / 512.0);
                points.push_on_facet(frame, parameters).expect("valid")
            }),
        };
        if points.collinear(triangle[0], triangle[1], triangle[2]) {
            continue;
        }
        let first = random.unit() * 1.5 - 0.25;
        let second = random.unit() * (1.0 - first);
        let shares = [first, second, 1.0 - first - second];
        let wanted: [f64; 3] = std::array::from_fn(|axis| {
            triangle.iter().zip(shares).map(|(&v, share)| points.xyz(v)[axis] * share).sum()
        });
        let i = points.push_in_triangle(frame, triangle, &wanted).expect("valid").expect("room for a point");
        let weights = strictly_inside(&points, frame, triangle, i);
        count[kind] += 1;
        explicit[kind] += usize::from(points.is_explicit(i));
        if triangle == frame {
            if let Some(parameters) = parameters(&points, i) {
                most_bits = parameters.into_iter().map(bits).fold(most_bits, i32::max);
            }
        }
        // Not near an edge, the position is the wanted one up to the rounding of parameters (and of the doubles).
        if shares.iter().all(|&w| w > 1.0 / 32.0) && triangle == frame {
            wanted_inside += 1;
            for (w, share) in weights.iter().zip(shares) {
                assert!((w - share).abs() < 1.0 / 128.0 + 1e-4, "{weights:?} {shares:?}");
            }
        }
        assert!(weights.iter().all(|&w| w > 1.0 / 140.0), "{weights:?}");
    }
    assert!(wanted_inside > positions::cases() / 20, "{wanted_inside}");
    assert!(most_bits <= 8, "{most_bits}");
    // Planes normal to an axis and grids need nothing but doubles, single precision hardly ever.
    assert_eq!([explicit[2], explicit[3]], [count[2], count[3]]);
    assert!(explicit[1] * 10 > count[1] * 9 && explicit[0] * 2 < count[0], "{explicit:?} {count:?}");
}

/// Triangles so thin or so small that rounding errors of ordinary arithmetic are larger than they are, in frames that may be needles.
#[test]
fn points_inside_thin_triangles() {
    let mut random = Random(62);
    let mut found = [0; 4];
    for round in 0..positions::cases() {
        let kind = round % 4;
        // Far from the origin, so that differences of doubles have few bits.
        let far = [0; 3].map(|_| if kind == 0 { scale(random.unit(), 20) } else { 0.0 });
        let mut corners = [0; 3].map(|_| {
            let p = random.decimals();
            [0, 1, 2].map(|k| p[k] + far[k])
        });
        match kind {
            // Normal to an axis: the nearest doubles are in the plane, but rarely in the triangle.
            1 => corners.iter_mut().for_each(|p| p[1] = 0.7),
            2 => {
                let [o, a, away] = corners;
                corners[2] = [0, 1, 2].map(|k| o[k] + 0.4 * (a[k] - o[k]) + away[k] * scale(1.0, -30));
            }
            _ => {}
        }
        let mut points = Points::new(corners.to_vec());
        if points.collinear(0, 1, 2) {
            continue;
        }
        let [u, v] = [0; 2].map(|_| 0.125 + random.below(1 << 16) as f64 * scale(1.0, -17));
        let exponent = [-20, -36, -46][round / 4 % 3];
        let mut short = || scale(random.unit() + 1.0, exponent);
        // A needle along the first side of the frame, or a triangle that is small in both directions. (Needles in a frame that is a needle
        // itself are beyond doubles.)
        let thin = match round / 12 % 2 {
            0 if kind != 2 => [[u, v], [u + 0.3, v], [u + 0.1, v + short()]],
            _ => [[u, v], [u + short(), v], [u, v + short()]],
        };
        let triangle = thin.map(|parameters| points.push_on_facet([0, 1, 2], parameters).expect("valid"));
        let wanted = *points.xyz(triangle[round % 3]);
        let i =
            points.push_in_triangle([0, 1, 2], triangle, &wanted).expect("valid").expect("room for a point");
        strictly_inside(&points, [0, 1, 2], triangle, i);
        found[kind] += 1;
    }
    assert!(found.iter().all(|&n| n > positions::cases() / 5), "{found:?}");
}

/// Where even doubles as parameters are too coarse there is no position, and none is made up.
#[test]
fn no_room_for_a_point() {
    let mut points = Points::new(vec![[0.1, 0.2, 0.3], [0.7, 0.45, 0.11], [0.0, 1.0, 0.6]]);
    let ulp = f64::EPSILON / 2.0;
    let corners = [[0.5, 0.5], [0.5 + ulp, 0.5], [0.5, 0.5 + ulp]];
    // No parameters between those of the corners.
    let triangle = corners.map(|parameters| points.push_on_facet([0, 1, 2], parameters).expect("valid"));
    let (before, wanted) = (points.len(), *points.xyz(triangle[0]));
    assert_eq!(points.push_in_triangle([0, 1, 2], triangle, &wanted).ok(), Some(None));
    assert_eq!(points.len(), before);
}

#[test]
fn refused_triangles() {
    let mut points = Points::new(vec![
        [0.1, 0.2, 0.3],
        [0.7, 0.45, 0.11],
        [0.0, 1.0, 0.6],
        [0.4, 0.7, 0.7],
        [0.7, 0.45, 0.11],
    ]);
    let on_side = points.push_on_segment(0, 1, &0.25.into()).expect("valid");
    let wanted = [0.3, 0.5, 0.4];
    let frame = [0, 1, 2];
    assert!(points.push_in_triangle(frame, [0, 1, 3], &wanted).is_err(), "not in the plane");
    assert!(points.push_in_triangle(frame, [0, 1, 77], &wanted).is_err(), "no such point");
    assert!(points.push_in_triangle([0, 1, 4], [0, 1, 2], &wanted).is_err(), "a collinear frame");
    assert!(points.push_in_triangle([0, on_side, 2], [0, 1, 2], &wanted).is_err(), "an implicit frame");
    assert_eq!(points.push_in_triangle(frame, [0, 1, on_side], &wanted).ok(), Some(None), "flat");
    // Wherever it is wanted, it gets inside.
    for wanted in [[f64::NAN; 3], [f64::INFINITY; 3], [f64::MAX, -f64::MAX, 0.0], [1e300; 3], [0.0; 3]] {
        let i = points.push_in_triangle(frame, [0, 2, on_side], &wanted).expect("valid").expect("room");
        strictly_inside(&points, frame, [0, 2, on_side], i);
    }
}

/// Wherever it is wanted, inside of the triangle or not, a position is in the plane and near; a point takes it and gives it back.
#[test]
fn places_in_a_plane() {
    let mut random = Random(63);
    let (mut implicit, mut count) = (0, 0);
    for round in 0..positions::cases() {
        let corners = [0; 3].map(|_| if round % 2 == 0 { random.decimals() } else { random.grid(5) });
        let mut points = Points::new(corners.to_vec());
        if points.collinear(0, 1, 2) {
            continue;
        }
        let explicit = points.push(random.decimals()).expect("in range");
        let p = points.push_in_triangle([0, 1, 2], [0, 1, 2], &[0.4; 3]).expect("valid").expect("room");
        points.allow_implicit(explicit).expect("memory");
        let shares = [0; 2].map(|_| random.unit() * 4.0 - 2.0);
        let of = |[s, t]: [f64; 2]| {
            let [o, a, b] = [0, 1, 2].map(|i| *points.xyz(i));
            [0, 1, 2].map(|k| o[k] + s * (a[k] - o[k]) + t * (b[k] - o[k]))
        };
        let wanted = of(shares);
        let old = of_point(&points, p);
        let Some(placed) = points.place_in_plane([0, 1, 2], [0, 1, p], &wanted) else { continue };
        count += 1;
        let [at, is_explicit] = [*placed.xyz(), [f64::from(u8::from(placed.is_explicit())); 3]];
        let turns = [0, 1, 2].map(|axis| points.orient_placed(axis, &placed, 0, 1));
        // One that was explicit, and one that may not have been.
        for i in [explicit, p] {
            let placed = points.place_in_plane([0, 1, 2], [0, 1, p], &wanted).expect("as before");
            points.take(i, placed).expect("memory");
            assert_eq!((*points.xyz(i), points.is_explicit(i)), (at, is_explicit[0] == 1.0));
            let exact = [0, 1, 2, i].map(|i| of_point(&points, i));
            assert_eq!(exact_orient3d(&exact), Sign::Zero);
            assert_eq!(turns, [0, 1, 2].map(|axis| points.orient_in_plane(axis, i, 0, 1)));
        }
        implicit += usize::from(!points.is_explicit(p));
        // Near for the triangle to p, which is smaller than the frame.
        let size =
            (0..3).map(|k| (corners[0][k] - corners[1][k]).abs() + (corners[0][k] - corners[2][k]).abs());
        let off = (0..3).map(|k| (at[k] - wanted[k]).abs()).fold(0.0, f64::max);
        assert!(off < 0.05 * size.fold(0.0, f64::max), "{off} {at:?} {wanted:?}");
        assert_ne!(old, of_point(&points, p));
    }
    assert!(10 * count > 9 * positions::cases() && 5 * implicit > count, "{count} {implicit}");
    // Below the first that may be implicit there are none.
    let mut points = Points::new(vec![[0.1, 0.2, 0.3], [0.7, 0.45, 0.11], [0.0, 1.0, 0.6]]);
    let placed = points.place_on_segment([0, 1], 0.3).expect("valid");
    assert!(points.take(2, placed).is_err());
    points.allow_implicit(2).expect("memory");
    let placed = points.place_on_segment([0, 1], 0.3).expect("valid");
    assert!(points.take(2, placed).is_ok() && points.collinear(0, 1, 2) && !points.is_explicit(2));
}
