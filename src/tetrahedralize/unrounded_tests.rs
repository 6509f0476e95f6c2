//! Sheets and needles closer to each other than the spacing of doubles: every mesh is proved by the exact checker.
use super::tetrahedralize;
use crate::check::check_mesh;
use crate::error::Status;
use crate::output::TetMesh;
use crate::{Options, Plc, Silent};

/// Numbers that look random (Knuth's multiplier).
struct Numbers(u64);

impl Numbers {
    fn next(&mut self, from: i32, to: i32) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        f64::from(from) + ((self.0 >> 33) % (to - from + 1) as u64) as f64
    }

    /// A rotation: the columns of its matrix come from a quaternion.
    fn rotation(&mut self) -> [[f64; 3]; 3] {
        let q: [f64; 4] = std::array::from_fn(|_| self.next(-500, 500) + 0.5);
        let [w, x, y, z] = q.map(|c| c / q.iter().map(|c| c * c).sum::<f64>().sqrt());
        [
            [1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y - z * w), 2.0 * (x * z + y * w)],
            [2.0 * (x * y + z * w), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z - x * w)],
            [2.0 * (x * z - y * w), 2.0 * (y * z + x * w), 1.0 - 2.0 * (x * x + y * y)],
        ]
    }
}

fn turned(plc: &mut Plc, numbers: &mut Numbers) {
    let rows = numbers.rotation();
    for p in &mut plc.points {
        *p = rows.map(|row| row[0] * p[0] + row[1] * p[1] + row[2] * p[2]);
    }
}

/// Triangles around an edge in directions of a lattice, rotated: where two directions coincide, rounding leaves one sheet next to the
/// other.
fn fan(seed: u64) -> Plc {
    let mut numbers = Numbers(seed);
    let mut plc = Plc { points: vec![[0.0; 3], [0.0, 0.0, numbers.next(1, 4)]], ..Plc::default() };
    for i in 0..numbers.next(5, 8) as u32 {
        plc.points.push([numbers.next(-3, 3), numbers.next(-3, 3), numbers.next(-3, 5)]);
        plc.triangles.push([0, 1, 2 + i]);
    }
    turned(&mut plc, &mut numbers);
    plc
}

/// Cubes in each other, a hundred units in the last place apart, turned, with diagonals at will.
fn shells(seed: u64, count: u32) -> Plc {
    const SQUARES: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    let mut numbers = Numbers(seed);
    let mut plc = Plc::default();
    for shell in 0..count {
        let size = 1.0 - 2e-14 * f64::from(shell);
        let corner = |i: u32| [i & 1, i >> 1 & 1, i >> 2].map(|x| (f64::from(x) - 0.5) * size);
        plc.points.extend((0..8).map(corner));
        for square in SQUARES {
            let [a, b, c, d] = square.map(|v| v + 8 * shell);
            let diagonal =
                if numbers.next(0, 1) > 0.0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            plc.triangles.extend(diagonal);
        }
    }
    turned(&mut plc, &mut numbers);
    plc
}

/// The checked mesh; `None` if the input is not valid.
fn meshed(plc: &Plc, options: &Options) -> Option<TetMesh> {
    match tetrahedralize(plc, options, &mut Silent) {
        Ok(mesh) => {
            check_mesh(plc, &mesh, true, 10).unwrap();
            Some(mesh)
        }
        Err(error) => {
            assert_eq!(error.status, Status::SelfIntersection, "{}", error.message);
            None
        }
    }
}

fn with_hull() -> Options {
    Options { keep_hull: true, ..Options::default() }
}

/// Constrained Delaunay meshes have points on these sheets without valid doubles: the search ends soon, and the mesh has no points there.
#[test]
fn sheets_an_ulp_apart_round_an_edge_are_meshed() {
    for seed in [1, 22] {
        let mesh = meshed(&fan(seed), &with_hull()).unwrap();
        assert!(mesh.preserved && mesh.steiner.iter().all(|point| point.is_inside()), "{seed}");
        assert!(!mesh.replaced.is_empty() && mesh.statistics.replaced == mesh.replaced.len() as u64);
    }
}

/// The same with merging, which takes other code paths.
#[test]
fn sheets_an_ulp_apart_are_meshed_with_merged_facets() {
    let mesh = meshed(&fan(1), &Options { merge_facets: Some(179.9), ..with_hull() }).unwrap();
    assert!(mesh.preserved);
}

#[test]
fn shells_some_ulps_apart_are_meshed() {
    for seed in 0..4 {
        meshed(&shells(seed, 2 + seed as u32 % 2), &with_hull()).unwrap();
    }
}
