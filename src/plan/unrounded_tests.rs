//! Sheets and needles closer to each other than the spacing of doubles: every mesh is proved by the exact checker.
use crate::check::check_mesh;
use crate::error::Status;
use crate::output::TetMesh;
use crate::plan::tetrahedralize;
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
    for seed in [39, 860] {
        let mesh = meshed(&fan(seed), &with_hull()).unwrap();
        assert!(mesh.preserved && mesh.steiner.iter().all(|point| point.is_inside()), "{seed}");
        assert!(!mesh.replaced.is_empty() && mesh.statistics.replaced == mesh.replaced.len() as u64);
    }
}

/// The same with merging, which takes other code paths.
#[test]
fn sheets_an_ulp_apart_are_meshed_with_merged_facets() {
    let mesh = meshed(&fan(39), &Options { merge_facets: Some(179.9), ..with_hull() }).unwrap();
    assert!(mesh.preserved);
}

#[test]
fn shells_some_ulps_apart_are_meshed() {
    for seed in 0..4 {
        meshed(&shells(seed, 2 + seed as u32 % 2), &with_hull()).unwrap();
    }
}

/// Sheets round an edge that cross each other an ulp apart, at small angles. With the feet of perpendiculars two segments split each other
/// again and again: the first mesh had 1,560 Steiner points and took 18 s, the second 154.
#[test]
fn segments_that_all_but_cross_do_not_split_each_other_for_ever() {
    let first = vec![
        [0.0; 3],
        [0.00037334577918695673, -0.0007627028860774357, 0.000482256729490304],
        [-0.0009355610071015942, 0.0014751124268175778, 0.0030572103368137196],
        [0.0024002702161979514, 0.000397900239960604, 0.0027261362251288597],
        [0.004346033482623069, -0.002011315242228675, 0.001364601110530218],
        [0.0028088098214003273, -0.0022598176204233133, -0.001793397638153798],
        [0.001756893817697436, -0.002459508827526573, 0.0026601886811956853],
        [0.0023191090456120738, -0.0031719183682667146, -0.0008792783851083382],
        [0.0021302395968843925, -0.0032222117136040088, 0.0031424454106859893],
        [0.0031096411484609014, -0.0013980102179172054, 0.00131420690459507],
    ];
    let second = vec![
        [0.0; 3],
        [-0.3005217594915751, -191.99614653178023, 1.1787296633447095],
        [46.66439007570686, -320.3329833655722, -41.2942425402661],
        [228.1159678539976, 63.42419476422641, -35.83959721513913],
        [4.005426139895686, 63.43746135226403, -90.81654617203765],
        [-35.24915517500296, 126.65307435880383, -228.79793664915746],
        [11.91610449985653, 126.31366854619868, -272.0567286283314],
        [-224.01036779427142, 64.01198209863102, -55.36985884468012],
        [3.5045565407430566, -256.556116200703, -88.8519967331298],
    ];
    for points in [first, second] {
        let triangles = (2..points.len() as u32).map(|k| [0, 1, k]).collect();
        let plc = Plc { points, triangles, ..Plc::default() };
        meshed(&plc, &with_hull()).unwrap();
        let exact = Options { exact_form: true, ..with_hull() };
        let mesh = tetrahedralize(&plc, &exact, &mut Silent).unwrap();
        assert!(mesh.steiner.len() <= 40, "{} Steiner points", mesh.steiner.len());
    }
}

/// Some of its edges cross each other an ulp apart: neither points on edges nor points taken off them have room, but a filling of all of it
/// has, with a point near an edge. With facets merged too.
#[test]
fn a_surface_without_room_for_points_on_edges_is_filled_as_a_whole() {
    let plc = Plc {
        points: vec![
            [0.0, 0.0, 0.0],
            [-2.7571561978475478e-05, 4.639518116276729e-05, -2.8505901729343737e-05],
            [-1.1263409116587616e-05, 2.6401576329203857e-05, 5.386448441104312e-05],
            [-3.8834971095063095e-05, 7.279675749197114e-05, 2.5358582681699382e-05],
            [-2.2526818233175233e-05, 5.2803152658407714e-05, 0.00010772896882208625],
            [-7.766994219012619e-05, 0.00014559351498394228, 5.0717165363398765e-05],
            [-5.327508689435776e-05, -2.9592807076537018e-05, 3.3646967458307764e-06],
            [-8.084664887283324e-05, 1.680237408623027e-05, -2.5141204983512964e-05],
            [-0.00010841821085130871, 6.319755524899756e-05, -5.364710671285669e-05],
            [-6.453849601094537e-05, -3.191230747333162e-06, 5.7229181156873896e-05],
            [-9.211005798942085e-05, 4.3203950415434124e-05, 2.8723279427530155e-05],
            [-0.00010655017378871552, -5.9185614153074035e-05, 6.729393491661553e-06],
            [-0.00016169329774566647, 3.360474817246054e-05, -5.028240996702593e-05],
            [-0.00014538514488377863, 1.361114333889711e-05, 3.208797617336094e-05],
            [-0.0001729567068622541, 6.00063245016644e-05, 3.582074444017215e-06],
            [-0.00012907699202189074, -6.382461494666324e-06, 0.00011445836231374779],
            [-0.0001566485540003662, 4.001271966810097e-05, 8.595246058440405e-05],
            [-0.0001842201159788417, 8.640790083086825e-05, 5.744655885506031e-05],
        ],
        triangles: vec![
            [12, 1, 5],
            [12, 15, 13],
            [9, 2, 1],
            [12, 17, 2],
            [12, 4, 3],
            [16, 17, 14],
            [0, 10, 15],
        ],
        ..Plc::default()
    };
    for merge_facets in [None, Some(179.9)] {
        let mesh = meshed(&plc, &Options { merge_facets, ..with_hull() }).unwrap();
        assert!(mesh.preserved && mesh.steiner.iter().all(|point| point.is_inside()));
    }
}
