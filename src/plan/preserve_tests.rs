//! Mode preserve end to end, where doubles leave no room: every mesh proved by the exact checker.
use crate::check::{check_preserved, check_preserved_outer};
use crate::control::Control;
use crate::error::{Defect, Error};
use crate::plan::tetrahedralize;
use crate::plan::unrounded::with_hint;
use crate::plc::Segment;
use crate::{Mode, Options, Plc, Preserve, Silent, Status};
use std::collections::HashMap;

/// They still have a box around them in doubles.
#[test]
fn points_that_are_one_or_none_are_no_internal_error() {
    let near = [[1.0; 3], [1.0, 1.0, 1.0 + f64::EPSILON]];
    for points in [&[][..], &[[1.0, -3.0, 0.1]], &[[5e-300; 3]; 4], &near] {
        let plc = Plc { points: points.to_vec(), ..Plc::default() };
        let options = Options { mode: Mode::Preserve, ..Options::default() };
        let error = tetrahedralize(&plc, &options, &mut Silent).unwrap_err();
        assert!(matches!(error.status, Status::DegenerateInput | Status::NothingEnclosed), "{error}");
    }
}

/// A prism over a polygon in thousandths with a sloping lid, all triangles split at the middles of their edges, twice. The triangles of
/// the lid are coplanar to the last bits only. With `loft` there is a second room above the lid.
fn sloping_prism(polygon: &[[i32; 2]], lid: &[[usize; 3]], loft: bool) -> Plc {
    let n = polygon.len();
    let thousandths = |x: i32| f64::from(x) / 1000.0;
    let top = polygon.iter().map(|&[x, y]| [x, y, 500 - x]);
    let level = |z: i32| polygon.iter().map(move |&[x, y]| [x, y, z]);
    let corners: Vec<[f64; 3]> =
        top.chain(level(-500)).chain(level(1500)).map(|p| p.map(thousandths)).collect();
    let mut triangles: Vec<[[f64; 3]; 3]> = Vec::new();
    for &[a, b, c] in lid {
        triangles.extend([[a, b, c], [n + a, n + c, n + b]].map(|t| t.map(|v| corners[v])));
        triangles.extend(loft.then(|| [2 * n + a, 2 * n + b, 2 * n + c].map(|v| corners[v])));
    }
    for i in 0..n {
        let j = (i + 1) % n;
        triangles.extend([[n + i, n + j, j], [n + i, j, i]].map(|t| t.map(|v| corners[v])));
        if loft {
            triangles.extend([[2 * n + j, 2 * n + i, i], [2 * n + j, i, j]].map(|t| t.map(|v| corners[v])));
        }
    }
    for _ in 0..2 {
        let middle = |p: [f64; 3], q: [f64; 3]| [0, 1, 2].map(|k| (p[k] + q[k]) / 2.0);
        let split = |&[a, b, c]: &[[f64; 3]; 3]| {
            let [ab, bc, ca] = [middle(a, b), middle(b, c), middle(c, a)];
            [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
        };
        triangles = triangles.iter().flat_map(split).collect();
    }
    let mut plc = Plc::default();
    let mut number: HashMap<[u64; 3], u32> = HashMap::new();
    for triangle in triangles {
        plc.triangles.push(triangle.map(|p| {
            *number.entry(p.map(|x| (x + 0.0).to_bits())).or_insert_with(|| {
                plc.points.push(p);
                plc.points.len() as u32 - 1
            })
        }));
    }
    plc
}

/// Around points on segments of such a lid there are tetrahedra as thin as the last bits: no double sees all faces of a sector, but
/// one higher up sees those of the sector with its surroundings.
#[test]
fn almost_coplanar_triangles_leave_room_farther_away() {
    let heptagon = [[-70, -200], [250, -70], [380, 0], [210, 170], [200, 210], [40, 240], [10, 220]];
    let hexagon = [[-332, 67], [-345, -4], [166, -165], [379, 9], [200, 247], [-146, 197]];
    let prisms = [
        sloping_prism(&heptagon, &[[0, 1, 2], [0, 2, 3], [6, 0, 3], [6, 3, 4], [4, 5, 6]], false),
        sloping_prism(&hexagon, &[[0, 1, 2], [4, 5, 0], [2, 3, 4], [4, 0, 2]], false),
    ];
    for plc in prisms {
        let options = Options { mode: Mode::Preserve, ..Options::default() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        check_preserved(&plc, &mesh, 10).unwrap();
    }
}

/// Points on internal segments may stay; one has no double near it that sees its star, so it is relocated after all. (With the hull kept,
/// the start is the constrained Delaunay tetrahedralization.)
#[test]
fn points_that_may_stay_are_relocated_where_doubles_leave_no_room() {
    let plc =
        sloping_prism(&[[147, 246], [-83, 224], [-102, 243], [80, -307]], &[[3, 0, 1], [3, 1, 2]], true);
    let options =
        Options { mode: Mode::Preserve, preserve: Preserve::Outer, keep_hull: true, ..Options::default() };
    let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
    check_preserved_outer(&plc, &mesh, 10).unwrap();
    let counts = mesh.statistics.preserve;
    assert_eq!((counts.on_internal_facets, counts.relocated), (1, 1));
}

/// Crossing-free segments in a cube, coordinates times 0.1, whose points stay: tetrahedra that are reconnected at them must be
/// positive where the points are exactly, too (found by the property test of segments).
#[test]
fn tetrahedra_at_points_that_stay_are_positive_in_exact_positions() {
    let ends = [
        [[4, 5, 4], [0, 1, 4]],
        [[2, 0, 2], [0, 0, 0]],
        [[0, 3, 5], [1, 2, 4]],
        [[3, 4, 5], [0, 2, 1]],
        [[1, 0, 4], [4, 4, 5]],
        [[0, 4, 4], [5, 2, 0]],
        [[1, 2, 2], [2, 2, 4]],
    ];
    let point = |p: [i32; 3]| p.map(|x| f64::from(x) * 0.1);
    let corner = |i: i32| [i & 1, i >> 1 & 1, i >> 2].map(|x| 5 * x);
    let mut plc = Plc { points: (0..8).map(|i| point(corner(i))).collect(), ..Plc::default() };
    for (i, pair) in ends.into_iter().enumerate() {
        plc.points.extend(pair.map(point));
        let base = 8 + 2 * i as u32;
        plc.segments.push(Segment { ends: [base, base + 1], marker: 1 });
    }
    let options =
        Options { mode: Mode::Preserve, preserve: Preserve::Outer, keep_hull: true, ..Options::default() };
    let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
    check_preserved_outer(&plc, &mesh, 10).unwrap();
    assert!(mesh.statistics.preserve.on_internal_facets > 0);
}

/// Points of a grid of sevenths, far out, and triangles between them.
fn far_grid(out: f64, points: &[[i32; 3]], triangles: &[[u32; 3]]) -> Plc {
    let place = |&[x, y, z]: &[i32; 3]| {
        let [x, y, z] = [x, y, z].map(|i| f64::from(i) / 7.0);
        [x + out, y - out, z + out]
    };
    Plc { points: points.iter().map(place).collect(), triangles: triangles.to_vec(), ..Plc::default() }
}

/// Edges that all but cross others of the grid. In the first exact mesh a point on them has no room to go to; points elsewhere on the edges,
/// or taken away in another order, have.
#[test]
fn further_attempts_find_room_on_grids() {
    let one = [[0, 1, 2], [2, 0, 2], [2, 1, 0], [2, 1, 1], [2, 2, 2], [3, 0, 1], [3, 0, 3], [4, 0, 1]];
    let two = [[0, 1, 1], [0, 3, 3], [0, 4, 1], [0, 4, 2], [1, 3, 2], [1, 4, 1], [2, 4, 3], [3, 4, 2]];
    // Turned and scaled.
    let turned = Plc {
        points: vec![
            [1269.2782497806484, -1081.0044122247748, -1189.3974043120927],
            [1789.1164241858282, 3468.544639079986, -1243.1719540827828],
            [3058.3946739664766, 2387.5402268552116, -2432.5693583948755],
            [4327.6729237471245, 1306.5358146304366, -3621.9667627069675],
            [-1335.291103022447, 134.28694064555026, -1547.0192913345184],
            [-66.01285324179867, -946.7174715792246, -2736.4166956466106],
            [828.5453588511157, 787.5548479607687, -3358.0026726880023],
            [453.8253211633812, 3602.8315797255364, -2790.191245417301],
        ],
        triangles: vec![[4, 0, 3], [6, 2, 5], [1, 0, 7]],
        ..Plc::default()
    };
    let far = [far_grid(1e6, &one, &[[4, 0, 7]]), far_grid(1e3, &two, &[[6, 7, 2], [1, 5, 0]])];
    for mut plc in far.into_iter().chain([turned]) {
        // Triangles beside it, since small surfaces are filled as a whole.
        let [a, b] = [plc.points[0], plc.points[1]];
        let size = (0..3).map(|k| (a[k] - b[k]).abs()).fold(0.0, f64::max);
        for i in 0..20 {
            let first = plc.points.len() as u32;
            let x = a[0] + size * f64::from(40 + 8 * i);
            plc.points.extend([[x, a[1], a[2]], [x, a[1] + size, a[2]], [x, a[1], a[2] + size]]);
            plc.triangles.push([first, first + 1, first + 2]);
        }
        let options = Options { mode: Mode::Preserve, keep_hull: true, ..Options::default() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        check_preserved(&plc, &mesh, 10).unwrap();
    }
}

/// Three triangles whose edges cross each other an ulp apart, in two rotations: a point is needed between two edges, within an ulp of one
/// of them, and few parameters on it have such a double. Points elsewhere do not help.
#[test]
fn small_surfaces_are_filled_as_a_whole() {
    let first = Plc {
        points: vec![
            [0.0, 0.0, 0.0],
            [-23.352474877273732, 58.260097278811074, 12.506917372788926],
            [-41.310843205881866, 46.019642862521394, 35.9945371469759],
            [5.814777997669747, -7.179669699607687, 44.30170086850336],
            [-5.861459440967121, 21.95037893979785, 50.55515955489782],
            [0.42067144900414455, 63.32088199549307, 33.32099846710531],
            [29.587924323947625, -2.118884982925694, 65.11578196281974],
            [35.87005521391889, 39.251618072769524, 47.88162087502724],
            [6.23544944667389, 56.14121229588538, 77.62269933560866],
        ],
        triangles: vec![[5, 2, 4], [3, 1, 6], [8, 0, 7]],
        ..Plc::default()
    };
    let second = Plc {
        points: vec![
            [0.0, 0.0, 0.0],
            [-2.7571561978475478e-05, 4.639518116276729e-05, -2.8505901729343737e-05],
            [-1.1263409116587616e-05, 2.6401576329203857e-05, 5.386448441104312e-05],
            [-6.453849601094537e-05, -3.191230747333162e-06, 5.7229181156873896e-05],
            [-9.211005798942085e-05, 4.3203950415434124e-05, 2.8723279427530155e-05],
            [-0.00016169329774566647, 3.360474817246054e-05, -5.028240996702593e-05],
            [-0.00012907699202189074, -6.382461494666324e-06, 0.00011445836231374779],
            [-0.0001842201159788417, 8.640790083086825e-05, 5.744655885506031e-05],
        ],
        triangles: vec![[3, 2, 1], [5, 7, 2], [0, 4, 6]],
        ..Plc::default()
    };
    for plc in [first, second] {
        let options = Options { mode: Mode::Preserve, keep_hull: true, ..Options::default() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        check_preserved(&plc, &mesh, 10).unwrap();
        assert!(mesh.steiner.len() == 1 && mesh.steiner[0].is_inside());
    }
}

/// Two cubes in each other, an ulp or two apart, far out: the diagonals of squares on the hull are not the Delaunay tetrahedralization's.
#[test]
fn cubes_an_ulp_apart_are_filled_as_a_whole() {
    const SQUARES: [[u32; 4]; 6] =
        [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];
    for choice in 0..8 {
        let mut plc = Plc::default();
        for shell in 0..2 {
            let size = 0.5 - 1e-12 * f64::from(shell);
            let place = |i: u32| [i & 1, i >> 1 & 1, i >> 2].map(|x| (2.0 * f64::from(x) - 1.0) * size);
            plc.points
                .extend((0..8).map(place).map(|[x, y, z]| [x / 7.0 + 1e3, y / 7.0 - 1e3, z / 7.0 + 1e3]));
            for (i, square) in SQUARES.into_iter().enumerate() {
                let [a, b, c, d] = square.map(|v| v + 8 * shell);
                plc.triangles.extend(match (choice + shell) as usize >> (i % 3) & 1 {
                    0 => [[a, b, c], [a, c, d]],
                    _ => [[a, b, d], [b, c, d]],
                });
            }
        }
        let options = Options { mode: Mode::Preserve, keep_hull: true, ..Options::default() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        check_preserved(&plc, &mesh, 10).unwrap();
    }
}

/// A twisted prism three units in the last place wide: a point is needed inside, and there is no double.
#[test]
fn the_error_names_what_is_too_close_and_the_mode_that_works() {
    let lattice = [[2, 0, 1], [3, 1, 1], [3, 2, 0], [3, 1, 0], [0, 0, 0], [1, 1, 1]];
    let points = lattice.map(|p: [u64; 3]| p.map(|x| ((1 << 52) + x) as f64)).to_vec();
    let triangles =
        vec![[0, 2, 1], [3, 4, 5], [0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
    let mut plc = Plc { points, triangles, ..Plc::default() };
    let options = Options { mode: Mode::Preserve, ..Options::default() };
    let error = tetrahedralize(&plc, &options, &mut Silent).unwrap_err();
    assert_eq!(error.status, Status::Rounding);
    let Some(Defect { first, second: Some(second), .. }) = error.defects.first() else {
        panic!("{error}");
    };
    let close =
        format!("{first} and {second} are too close to each other: a point is needed between them and");
    let said = format!("{close} has no position in doubles; nor is there room in mode cdt");
    assert_eq!(error.message, said);
    // The same error, of a surface that mode cdt does mesh.
    plc.points = lattice.map(|p: [u64; 3]| p.map(|x| x as f64)).to_vec();
    let error = with_hint(&plc, &options, Error::new(Status::Rounding, "no room"), &Control::free());
    assert_eq!(error.status, Status::Rounding);
    assert_eq!(error.message, "no room; mode cdt, which may put points on the surface, meshes it");
}
