//! The Delaunay invariants on random and degenerate point sets.
use super::check::check_delaunay;
use super::order::insertion_order;
use super::Delaunay;
use crate::predicates::Points;

/// Deterministic numbers in [0, 1).
struct Lcg(u64);

impl Lcg {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn build(xyz: Vec<[f64; 3]>) -> (Delaunay, Points) {
    let ids: Vec<u32> = (0..xyz.len() as u32).collect();
    let mut order = insertion_order(&xyz, &ids).ids;
    let points = Points::new(xyz);
    let mut delaunay = Delaunay::new();
    delaunay.build(&points, &mut order, &mut |_| Ok(())).unwrap();
    check_delaunay(&delaunay, &points).unwrap();
    (delaunay, points)
}

fn finite_count(delaunay: &Delaunay) -> usize {
    let mesh = &delaunay.mesh;
    (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)).count()
}

#[test]
fn random_points() {
    let mut random = Lcg(1);
    let (delaunay, _) = build((0..3000).map(|_| [random.next(), random.next(), random.next()]).collect());
    let tets = finite_count(&delaunay);
    assert!((6 * 3000..7 * 3000).contains(&tets), "{tets}");
}

#[test]
fn integer_grid_is_filled_without_flat_tetrahedra() {
    let n = 9;
    let mut xyz = Vec::new();
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                xyz.push([i as f64, j as f64, k as f64]);
            }
        }
    }
    let (delaunay, points) = build(xyz);
    let volume: f64 = (0..delaunay.mesh.slot_count() as u32)
        .filter(|&t| delaunay.mesh.is_live(t) && !delaunay.mesh.is_ghost(t))
        .map(|t| {
            let [a, b, c, d] = delaunay.mesh.verts[t as usize].map(|v| points.xyz(v));
            let u: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
            let v: [f64; 3] = std::array::from_fn(|k| c[k] - a[k]);
            let w: [f64; 3] = std::array::from_fn(|k| d[k] - a[k]);
            u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                + u[2] * (v[0] * w[1] - v[1] * w[0])
        })
        .sum();
    // Integer coordinates: the sum is exact.
    assert_eq!(volume, 6.0 * ((n - 1) * (n - 1) * (n - 1)) as f64);
}

#[test]
fn nearly_everything_in_one_plane() {
    let mut random = Lcg(7);
    let mut xyz: Vec<[f64; 3]> =
        (0..500).map(|_| [(random.next() * 30.0).floor(), (random.next() * 30.0).floor(), 0.0]).collect();
    xyz.sort_by(|a, b| a.partial_cmp(b).unwrap());
    xyz.dedup();
    xyz.push([3.0, 4.0, 5.0]);
    build(xyz);
}

#[test]
fn large_cavities_are_linked_by_sorting() {
    // Two skew lines: every tetrahedron joins an edge of each, stars are as large as they get.
    let mut xyz: Vec<[f64; 3]> = (0..80).map(|i| [i as f64, 0.0, 0.0]).collect();
    xyz.extend((0..80).map(|i| [0.0, i as f64, 1.0]));
    let (delaunay, _) = build(xyz);
    assert_eq!(finite_count(&delaunay), 79 * 79);
}

#[test]
fn the_result_does_not_depend_on_the_order() {
    let mut xyz = Vec::new();
    for i in 0..5 {
        for j in 0..5 {
            for k in 0..5 {
                xyz.push([i as f64, j as f64, k as f64]);
            }
        }
    }
    let points = Points::new(xyz);
    let sorted_tets = |mut order: Vec<u32>| {
        let mut delaunay = Delaunay::new();
        delaunay.build(&points, &mut order, &mut |_| Ok(())).unwrap();
        let mesh = &delaunay.mesh;
        let mut tets: Vec<[u32; 4]> = (0..mesh.slot_count() as u32)
            .filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t))
            .map(|t| {
                let mut v = mesh.verts[t as usize];
                v.sort_unstable();
                v
            })
            .collect();
        tets.sort_unstable();
        tets
    };
    let forward: Vec<u32> = (0..125).collect();
    let backward: Vec<u32> = (0..125).rev().collect();
    let mixed: Vec<u32> = (0..125).map(|i| i * 62 % 125).collect();
    let reference = sorted_tets(forward);
    assert_eq!(reference, sorted_tets(backward));
    assert_eq!(reference, sorted_tets(mixed));
}

#[test]
fn coplanar_points_are_refused() {
    let points = Points::new((0..10).map(|i| [i as f64, (i * i % 7) as f64, 0.0]).collect());
    let mut delaunay = Delaunay::new();
    let mut order: Vec<u32> = (0..10).collect();
    let error = delaunay.build(&points, &mut order, &mut |_| Ok(())).unwrap_err();
    assert_eq!(error.status, crate::Status::DegenerateInput);
}
