//! Times the Delaunay phase alone (ordering and insertion) on a TetGen `.node` file or raw coordinates (`.raw`).
//!
//! `cargo bench --bench delaunay -- FILE [REPETITIONS [THREADS]]` prints points, tetrahedra, the time of reading and of each
//! part (minimum and median over the repetitions), bytes per tetrahedron and a hash of the tetrahedra that does not depend
//! on their order.
use delotet::internals::Construction;
use delotet::internals::Points;
use delotet::internals::{insertion_order, Order};
use delotet::{Control, Phase};
use std::io::{BufRead, Read};
use std::time::Instant;

/// CPU seconds of this thread, so that other programs on the machine disturb less; wall-clock time if the system does not report them.
fn seconds(start: Instant) -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split_whitespace().next().and_then(|x| x.parse::<f64>().ok());
    nanoseconds.map_or(start.elapsed().as_secs_f64(), |x| x * 1e-9)
}

/// Points of a `.node` file, in order, attributes and markers ignored; or of a `.raw` file: their coordinates as doubles.
fn read(path: &str) -> Vec<[f64; 3]> {
    if path.ends_with(".raw") {
        return read_raw(path);
    }
    let file = std::fs::File::open(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let mut lines = std::io::BufReader::new(file)
        .lines()
        .map(|line| line.unwrap())
        .filter(|line| !line.trim_start().is_empty() && !line.trim_start().starts_with('#'));
    let count: usize = lines.next().unwrap().split_whitespace().next().unwrap().parse().unwrap();
    let coordinates = |line: String| {
        let mut numbers = line.split_whitespace().skip(1).map(|x| x.parse::<f64>().unwrap());
        [(); 3].map(|()| numbers.next().unwrap())
    };
    let mut points = Vec::with_capacity(count);
    points.extend(lines.take(count).map(coordinates));
    points
}

fn read_raw(path: &str) -> Vec<[f64; 3]> {
    let mut file = std::fs::File::open(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let count = file.metadata().unwrap().len() as usize / 24;
    let mut points = Vec::with_capacity(count);
    let mut bytes = [0u8; 24];
    let mut reader = std::io::BufReader::new(&mut file);
    for _ in 0..count {
        reader.read_exact(&mut bytes).unwrap();
        points.push([0, 8, 16].map(|at| f64::from_le_bytes(bytes[at..at + 8].try_into().unwrap())));
    }
    points
}

/// Peak memory of the process in megabytes; zero if the system does not report it.
fn peak_megabytes() -> f64 {
    let text = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = text.lines().find(|line| line.starts_with("VmHWM"));
    let kilobytes = line.and_then(|line| line.split_whitespace().nth(1)).and_then(|x| x.parse::<f64>().ok());
    kilobytes.unwrap_or(0.0) * 1024e-6
}

/// A hash of the set of finite tetrahedra, in vertices of the file.
fn fingerprint(delaunay: &Construction, order: &[u32]) -> (usize, u64) {
    let mesh = &delaunay.mesh;
    let (mut count, mut hash) = (0, 0u64);
    for t in 0..mesh.slot_count() as u32 {
        if mesh.is_live(t) && !mesh.is_ghost(t) {
            let mut v = mesh.verts(t).map(|v| order[v as usize]);
            v.sort_unstable();
            let mix = v.iter().fold(0x9e37_79b9_7f4a_7c15u64, |h, &v| {
                (h ^ v as u64).wrapping_mul(0xff51_afd7_ed55_8ccd).rotate_left(29)
            });
            count += 1;
            hash = hash.wrapping_add(mix);
        }
    }
    (count, hash)
}

/// The first part; a function of its own so that tools can find it.
#[inline(never)]
fn sort_all(points: &[[f64; 3]], ids: &[u32]) -> Order {
    insertion_order(points, ids, &Control::free()).expect("enough memory")
}

/// The second part.
#[inline(never)]
fn insert_all(points: &Points, rounds: &[usize], threads: usize, ranges: Option<usize>) -> Construction {
    let mut delaunay = Construction { ranges, ..Construction::default() };
    let mut sequence: Vec<u32> = (0..points.len() as u32).collect();
    let control = Control::free();
    delaunay.build_rounds(points, &mut sequence, rounds, threads, control.whole(Phase::Delaunay)).unwrap();
    delaunay
}

/// Deferred vertices by round and pass, and bounds of the speed-up.
fn simulation(delaunay: &Construction, count: usize) -> String {
    let mut text = String::new();
    for round in &delaunay.rounds {
        text += &format!(
            "{} vertices in {} ranges, deferred {:?}\n",
            round.vertices, round.ranges, round.deferred
        );
    }
    let bound = |threads: usize| {
        let mut time = count as f64;
        let mut total = time;
        for round in &delaunay.rounds {
            let mut before = round.vertices;
            let mut ranges = round.ranges;
            for &after in &round.deferred {
                // A deferred vertex costs about half an insertion.
                let work = (before - after) as f64 + 0.5 * after as f64;
                total += 0.5 * after as f64;
                let most = ranges.div_ceil(threads) as f64 / ranges as f64;
                time += work * most - (before - after) as f64;
                before = after;
                ranges = round.ranges.div_ceil(2).max(2);
            }
        }
        total / time
    };
    let bounds = [2, 4, 8, 16, 64].map(|threads| format!("{threads}: {:.2}", bound(threads)));
    text + "speed-up at most " + &bounds.join(", ")
}

/// Minimum and median in milliseconds.
fn summary(seconds: &mut [f64]) -> String {
    seconds.sort_by(f64::total_cmp);
    format!("{:.1} / {:.1} ms", seconds[0] * 1e3, seconds[seconds.len() / 2] * 1e3)
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    let Some(path) = arguments.first() else {
        eprintln!("usage: delaunay FILE [REPETITIONS [THREADS]]");
        return;
    };
    let repetitions: usize = arguments.get(1).map_or(1, |n| n.parse().unwrap());
    let threads: usize = arguments.get(2).map_or(1, |n| n.parse().unwrap());
    let ranges: Option<usize> = arguments.get(3).map(|n| n.parse().unwrap());
    let points = read(path);
    let ids: Vec<u32> = (0..points.len() as u32).collect();
    let (mut ordering, mut insertion, mut wall) = (Vec::new(), Vec::new(), Vec::new());
    let (mut last, mut conflicts) = (String::new(), String::new());
    let start = Instant::now();
    for _ in 0..repetitions.max(1) {
        let clock = seconds(start);
        let order = sort_all(&points, &ids);
        let store = Points::new(order.ids.iter().map(|&i| points[i as usize]).collect());
        ordering.push(seconds(start) - clock);
        let (clock, by_wall) = (seconds(start), Instant::now());
        let delaunay = insert_all(&store, &order.rounds, threads, ranges);
        insertion.push(seconds(start) - clock);
        wall.push(by_wall.elapsed().as_secs_f64());
        conflicts = simulation(&delaunay, points.len());
        let (count, hash) = fingerprint(&delaunay, &order.ids);
        let each = delaunay.bytes() as f64 / delaunay.mesh.live_count() as f64;
        last = format!("{} points, {count} tetrahedra, hash {hash:016x}, {each:.1} bytes each", points.len());
    }
    println!(
        "{last}\norder {}, insertion {}, wall {}, peak {:.0} MB\n{conflicts}",
        summary(&mut ordering),
        summary(&mut insertion),
        summary(&mut wall),
        peak_megabytes()
    );
}
