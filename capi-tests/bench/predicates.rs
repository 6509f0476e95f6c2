//! Nanoseconds per call of the predicates, on the inputs that matter: random, gridded, decimal and implicit points.
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
    println!("{name:34} {orient:9.1} {orient_zeros:5.1}% {inside:9.1} {inside_zeros:5.1}% {tied:9.1}");
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
        "{:34} {:>9} {:>6} {:>9} {:>6} {:>9}",
        "ns per call", "orient3d", "zero", "insphere", "zero", "perturbed"
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
    for (name, flat, bits) in [
        ("implicit, random decimal, 4 bits", false, 4),
        ("implicit, random decimal, 30 bits", false, 30),
        ("implicit, slanted plane, 4 bits", true, 4),
        ("implicit, slanted plane, 30 bits", true, 30),
    ] {
        let decimal = |random: &mut Random| random.below(1_000_000) as f64 / 1e6;
        let corners: Vec<[f64; 3]> = (0..30)
            .map(|_| {
                let [x, y, z] = [0; 3].map(|_| decimal(&mut random));
                if flat {
                    [x, y, y]
                } else {
                    [x, y, z]
                }
            })
            .collect();
        let mut points = Points::new(corners);
        for _ in 0..200 {
            let (a, b) = (random.below(15) as u32, 15 + random.below(15) as u32);
            let t = (1 + random.below((1 << bits) - 1)) as f64 / (1u64 << bits) as f64;
            if points.push_on_segment(a, b, &t.into()).is_err() {
                println!("a point was refused");
            }
        }
        time(name, &points, &tuples(&points, 30, &mut random));
    }
}
