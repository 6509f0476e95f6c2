//! Nanoseconds per call of the predicates, on the inputs that matter: random, gridded and decimal points, and by kinds of positions:
//! explicit points, points on segments, points on facets, and the three in turn.
//!
//! Run with `cargo run --release --features internals --example predicate_times`.
use delotet::internals::{Points, Sign};
use std::time::Instant;

/// A small generator (xorshift), so that the figures repeat.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 16) % n
    }
    fn unit(&mut self) -> f64 {
        self.below(1 << 40) as f64 / (1u64 << 40) as f64
    }
}

fn time(name: &str, points: &Points, tuples: &[[u32; 5]]) {
    let measure = |f: &dyn Fn(&[u32; 5]) -> Sign| {
        // The best of many short runs: other processes only ever make it slower.
        let (mut best, mut zeros) = (f64::INFINITY, 0);
        for _ in 0..100 {
            let start = Instant::now();
            zeros = tuples.iter().filter(|t| f(t) == Sign::Zero).count();
            best = best.min(start.elapsed().as_secs_f64());
        }
        (best * 1e9 / tuples.len() as f64, 100.0 * zeros as f64 / tuples.len() as f64)
    };
    let (orient, orient_zeros) = measure(&|t| points.orient3d(t[0], t[1], t[2], t[3]));
    let (inside, inside_zeros) = measure(&|t| points.insphere(t[0], t[1], t[2], t[3], t[4]));
    let (tied, _) = measure(&|t| points.insphere_perturbed(t[0], t[1], t[2], t[3], t[4]));
    let (turn, _) = measure(&|t| points.orient_in_plane(2, t[0], t[1], t[2]));
    let (circle, _) = measure(&|t| points.incircle_in_plane(2, t[0], t[1], t[2], t[3]));
    let (dot, _) = measure(&|t| points.dot_sign(t[0], t[1], t[2]));
    let (order, _) = measure(&|t| Sign::of(f64::from(points.compare_lex(t[0], t[1]) as i8)));
    println!(
        "{name:34} {orient:9.1} {orient_zeros:5.1}% {inside:9.1} {inside_zeros:5.1}% {tied:9.1} {turn:9.1} {circle:9.1} {dot:9.1} \
         {order:9.1}"
    );
}

/// Tuples of points close to each other in the list.
fn tuples(points: &Points, from: usize, random: &mut Random) -> Vec<[u32; 5]> {
    let window = 12.min(points.len() - from) as u64;
    (0..4096)
        .map(|_| {
            let start = from as u64 + random.below((points.len() - from) as u64 - window + 1);
            let mut t = [0; 5];
            for i in 0..5 {
                t[i] = loop {
                    let id = (start + random.below(window)) as u32;
                    if !t[..i].contains(&id) {
                        break id;
                    }
                };
            }
            t
        })
        .collect()
}

fn main() {
    let mut random = Random(88172645463325252);
    println!(
        "{:34} {:>9} {:>6} {:>9} {:>6} {:>9} {:>9} {:>9} {:>9} {:>9}",
        "ns per call",
        "orient3d",
        "zero",
        "insphere",
        "zero",
        "perturbed",
        "in plane",
        "circle",
        "dot",
        "order"
    );
    let random_points: Vec<[f64; 3]> =
        (0..2000).map(|_| [random.unit(), random.unit(), random.unit()]).collect();
    let points = Points::new(random_points);
    time("random", &points, &tuples(&points, 0, &mut random));
    // Points within 0.01 of each other in a unit box are as in a Delaunay triangulation of a million random points.
    for (name, size) in [("random, 0.01 apart", 0.01), ("random, 0.0001 apart", 0.0001)] {
        let mut local = vec![[0.0; 3], [1.0; 3]];
        for _ in 0..400 {
            let c = [random.unit(), random.unit(), random.unit()];
            local.extend((0..12).map(|_| c.map(|x| x + size * random.unit())));
        }
        let points = Points::new(local);
        let windows: Vec<[u32; 5]> = (0..4096)
            .map(|i| {
                let start = 2 + 12 * (i as u32 % 400);
                [
                    start,
                    start + 1,
                    start + 2,
                    start + 3 + random.below(4) as u32,
                    start + 7 + random.below(5) as u32,
                ]
            })
            .collect();
        time(name, &points, &windows);
    }
    for (name, step, n) in
        [("grid of integers", 1.0, 40), ("grid of 0.1", 0.1, 40), ("grid of 0.1, single precision", 0.0, 40)]
    {
        let coordinate = |random: &mut Random| {
            let i = random.below(n) as f64;
            if step == 0.0 {
                f64::from((i * 0.1) as f32)
            } else {
                i * step
            }
        };
        let grid: Vec<[f64; 3]> = (0..2000).map(|_| [0; 3].map(|_| coordinate(&mut random))).collect();
        let mut grid = grid;
        // Close neighbours: within a 4 by 4 by 4 block each window.
        for chunk in grid.chunks_mut(12) {
            for p in chunk {
                *p = p.map(|x| {
                    if step == 0.0 {
                        f64::from(((x * 10.0).round() % 4.0 * 0.1) as f32)
                    } else {
                        (x / step).round() % 4.0 * step
                    }
                });
            }
        }
        let points = Points::new(grid);
        time(name, &points, &tuples(&points, 0, &mut random));
    }
    for (arrangement, name) in [
        (Corners::Decimal, "decimal"),
        (Corners::Plane, "slanted plane"),
        (Corners::Facet, "one facet"),
        (Corners::Grid, "grid of 0.1"),
    ] {
        let explicit = by_kind(arrangement, Kind::Explicit, 30, &mut random);
        time(&format!("{name}, explicit"), &explicit, &tuples(&explicit, CORNERS, &mut random));
        for bits in [4, 30, 52] {
            for (kind, of) in [(Kind::Segment, "segments"), (Kind::Facet, "facets"), (Kind::Mixed, "mixed")] {
                let points = by_kind(arrangement, kind, bits, &mut random);
                let name = format!("{name}, {of}, {bits} bits");
                time(&name, &points, &tuples(&points, CORNERS, &mut random));
            }
        }
    }
    constructors(&mut random);
}

/// Where explicit points lie.
#[derive(Clone, Copy)]
enum Corners {
    /// Six decimals.
    Decimal,
    /// Six decimals in the plane y = z.
    Plane,
    /// Six decimals; all other points on one facet between them, explicit ones as near as doubles get.
    Facet,
    /// A cube of four points a side.
    Grid,
}

/// What is timed, after the corners.
#[derive(Clone, Copy)]
enum Kind {
    Explicit,
    Segment,
    Facet,
    Mixed,
}

const CORNERS: usize = 30;

fn corner(corners: Corners, random: &mut Random) -> [f64; 3] {
    let decimal = |random: &mut Random| random.below(1_000_000) as f64 / 1e6;
    let [x, y, z] = [0; 3].map(|_| decimal(random));
    match corners {
        Corners::Decimal | Corners::Facet => [x, y, z],
        Corners::Plane => [x, y, y],
        Corners::Grid => [0; 3].map(|_| random.below(4) as f64 * 0.1),
    }
}

/// Corners, then 200 points of the kind: between random corners, with parameters of so many bits.
fn by_kind(corners: Corners, kind: Kind, bits: u32, random: &mut Random) -> Points {
    let mut points = Points::new((0..CORNERS).map(|_| corner(corners, random)).collect());
    for i in 0.. {
        let kind = match kind {
            Kind::Mixed => [Kind::Explicit, Kind::Segment, Kind::Facet][i % 3],
            kind => kind,
        };
        let mut frame = [0, 1, 2].map(|third| 10 * third + random.below(10) as u32);
        if matches!(corners, Corners::Facet) {
            frame = [[0, 10, 20], [10, 20, 0], [20, 0, 10]][i % 9 / 3];
        }
        let [o, a, b] = frame;
        let [t, u] = [0; 2].map(|_| (1 + random.below((1 << bits) - 1)) as f64 / (1u64 << bits) as f64);
        let pushed = match kind {
            Kind::Segment => points.push_on_segment(o, a, &t.into()),
            // Corners on a line are no frame: another attempt.
            Kind::Facet => points.push_on_facet([o, a, b], [t / 2.0, u / 2.0]),
            Kind::Explicit if matches!(corners, Corners::Facet) => {
                let [o, a, b] = frame.map(|i| *points.xyz(i));
                points.push([0, 1, 2].map(|k| o[k] + 0.5 * t * (a[k] - o[k]) + 0.5 * u * (b[k] - o[k])))
            }
            _ => points.push(corner(corners, random)),
        };
        // Positions that are doubles would be explicit points.
        if pushed.is_ok_and(|i| points.is_explicit(i) != matches!(kind, Kind::Explicit)) {
            points.truncate(points.len() - 1);
        }
        if points.len() == CORNERS + 200 {
            break;
        }
    }
    points
}

/// A point to add.
struct Wanted {
    frame: [u32; 3],
    parameters: [f64; 2],
}

/// Times of adding a point, of each kind.
fn constructors(random: &mut Random) {
    time_adding("add, explicit", random, |points, wanted| points.push(*points.xyz(wanted.frame[0])).is_ok());
    time_adding("add, segment", random, |points, wanted| {
        let [o, a, _] = wanted.frame;
        points.push_on_segment(o, a, &wanted.parameters[0].into()).is_ok()
    });
    time_adding("add, facet", random, |points, wanted| {
        points.push_on_facet(wanted.frame, wanted.parameters).is_ok()
    });
    time_adding("add, in a triangle", random, |points, wanted| {
        let [o, a, b] = wanted.frame.map(|i| *points.xyz(i));
        let [u, v] = wanted.parameters;
        let at = [0, 1, 2].map(|k| o[k] + u * (a[k] - o[k]) + v * (b[k] - o[k]));
        points.push_in_triangle(wanted.frame, wanted.frame, &at).is_ok_and(|i| i.is_some())
    });
}

fn time_adding(name: &str, random: &mut Random, add: impl Fn(&mut Points, &Wanted) -> bool) {
    let corners: Vec<[f64; 3]> = (0..CORNERS).map(|_| corner(Corners::Decimal, random)).collect();
    let all: Vec<Wanted> = (0..1000)
        .map(|_| Wanted {
            frame: [0, 1, 2].map(|third| 10 * third + random.below(10) as u32),
            parameters: [0; 2].map(|_| (1 + random.below(15)) as f64 / 32.0),
        })
        .collect();
    let (mut best, mut failed) = (f64::INFINITY, 0);
    for _ in 0..100 {
        let mut points = Points::new(corners.clone());
        let start = Instant::now();
        failed += all.iter().filter(|wanted| !add(&mut points, wanted)).count();
        best = best.min(start.elapsed().as_secs_f64());
    }
    println!("{name:34} {:9.1}", best * 1e9 / all.len() as f64);
    if failed > 0 {
        println!("{failed} points were refused");
    }
}
