//! Fillings of known and random polyhedra.
use crate::control::Control;
use crate::delaunay::Construction;
use crate::kernel::around::StarSearch;
use crate::ops::quality::quality;
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::ops::scene_tests::triangulations;
use crate::ops::shape::{Goal, Measure, Shape};
use crate::ops::sheet::Sheets;
use crate::predicates::{Points, Sign};

const BUDGET: u32 = 100_000;

fn fill(points: &Points, polyhedron: &Polyhedron) -> Option<Vec<[u32; 4]>> {
    let mut tets = Vec::new();
    let found = Reconnect::new(&Control::free()).fill(points, polyhedron, BUDGET, &mut tets).unwrap();
    assert_eq!(found, !tets.is_empty());
    found.then(|| {
        check(points, polyhedron, &tets);
        tets
    })
}

/// All tetrahedra positive; their faces cancel to the boundary; required edges and inner vertices are there.
fn check(points: &Points, polyhedron: &Polyhedron, tets: &[[u32; 4]]) {
    let turned = |f: [u32; 3]| {
        let k = (0..3).min_by_key(|&k| f[k]).unwrap();
        [f[k], f[(k + 1) % 3], f[(k + 2) % 3]]
    };
    let mut open: Vec<[u32; 3]> = Vec::new();
    for &[a, b, c, d] in tets {
        assert_eq!(points.orient3d(a, b, c, d), Sign::Positive);
        for f in [[b, c, d], [a, d, c], [a, b, d], [a, c, b]] {
            let back = turned([f[0], f[2], f[1]]);
            match open.iter().position(|&x| x == back) {
                Some(at) => drop(open.swap_remove(at)),
                None => open.push(turned(f)),
            }
        }
    }
    let mut boundary: Vec<[u32; 3]> = polyhedron.faces.iter().map(|&f| turned(f)).collect();
    boundary.sort_unstable();
    open.sort_unstable();
    assert_eq!(open, boundary);
    for &[a, b] in polyhedron.edges {
        assert!(tets.iter().any(|t| t.contains(&a) && t.contains(&b)));
    }
    for v in polyhedron.inner {
        assert!(tets.iter().any(|t| t.contains(v)));
    }
}

/// A triangular prism of height 1 whose top is turned, its three sides cut by the given diagonals.
fn prism(turn: f64, inward: bool) -> (Points, Vec<[u32; 3]>) {
    let at = |k: usize, z: f64, turn: f64| {
        let angle = (k as f64 * 120.0 + turn).to_radians();
        [angle.cos(), angle.sin(), z]
    };
    let xyz = (0..6).map(|k| if k < 3 { at(k, 0.0, 0.0) } else { at(k - 3, 1.0, turn) }).collect();
    // Seen from inside the bottom 0 1 2 turns one way, the top the other.
    let mut faces = vec![[0, 2, 1], [3, 4, 5]];
    for k in 0..3u32 {
        let (a, b) = (k, (k + 1) % 3);
        let (c, d) = (a + 3, b + 3);
        if inward {
            faces.extend([[a, b, d], [a, d, c]]);
        } else {
            faces.extend([[a, b, c], [b, d, c]]);
        }
    }
    (Points::new(xyz), faces)
}

#[test]
fn schoenhardt_has_no_filling() {
    for inward in [false, true] {
        let (points, faces) = prism(if inward { -30.0 } else { 30.0 }, inward);
        let convex = fill(&points, &Polyhedron { faces: &faces, ..Default::default() });
        let (points, _) = prism(if inward { 30.0 } else { -30.0 }, inward);
        let twisted = fill(&points, &Polyhedron { faces: &faces, ..Default::default() });
        assert!(
            convex.is_some() != twisted.is_some(),
            "one twist makes the diagonals reflex, the other convex"
        );
    }
}

/// The octahedron with the corners ±x, ±y, ±z.
fn octahedron() -> (Points, Vec<[u32; 3]>) {
    let points = Points::new(vec![
        [1.0, 0.0, 0.0],
        [-1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, -1.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 0.0, -1.0],
    ]);
    let mut faces = Vec::new();
    for x in [0, 1] {
        for y in [2, 3] {
            for z in [4, 5] {
                let turn = (x + y + z) % 2 == 1;
                faces.push(if turn { [x, z, y] } else { [x, y, z] });
            }
        }
    }
    (points, faces)
}

#[test]
fn octahedron_has_every_diagonal() {
    let (points, faces) = octahedron();
    for edge in [[0, 1], [2, 3], [4, 5]] {
        let tets =
            fill(&points, &Polyhedron { faces: &faces, edges: &[edge], ..Default::default() }).unwrap();
        assert_eq!(tets.len(), 4);
    }
    let two = [[0, 1], [2, 3]];
    assert!(fill(&points, &Polyhedron { faces: &faces, edges: &two, ..Default::default() }).is_none());
}

/// A vertex and the faces opposite it.
type Link = (u32, Vec<[u32; 3]>);

/// The vertices inside the Delaunay tetrahedralization of 400 random points.
fn random_stars() -> (Points, Vec<Link>) {
    let mut state = 1u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let points = Points::new((0..400).map(|_| [random(), random(), random()]).collect());
    let mesh = Construction::of(&points);
    let mut stars = Vec::new();
    for v in 0..400 {
        let start = mesh.vertex_tet[v as usize];
        let mut star = StarSearch::default();
        star.vertex_star(&mesh, v, start).unwrap();
        if star.tets.iter().any(|&t| mesh.is_ghost(t)) {
            continue;
        }
        stars.push((v, star.tets.iter().map(|&t| mesh.face(4 * t + mesh.slot_of(t, v).unwrap())).collect()));
    }
    assert!(stars.len() > 200);
    (points, stars)
}

#[test]
fn stars_of_random_vertices_are_filled_without_them_and_with_them() {
    let (points, stars) = random_stars();
    for (v, faces) in &stars {
        assert!(fill(&points, &Polyhedron { faces, inner: &[*v], ..Default::default() }).is_some());
        let without = fill(&points, &Polyhedron { faces, ..Default::default() });
        assert!(without.is_some(), "a Delaunay vertex can always be deleted");
    }
}

/// Known signs change no result, whatever was filled before, even if there are more vertices than there is room for.
#[test]
fn fillings_do_not_depend_on_what_was_filled_before() {
    let (points, stars) = random_stars();
    let free = Control::free();
    let mut reconnect = Reconnect::new(&free);
    let (mut found, mut none) = (0, 0);
    for (i, (v, faces)) in stars.iter().enumerate() {
        // The same again, with the vertex, and with an edge that most fillings lack.
        let edge = [[faces[0][0], faces[faces.len() / 2].iter().copied().max().unwrap()]];
        let asked: &[[u32; 2]] = if edge[0][0] == edge[0][1] { &[] } else { &edge };
        for polyhedron in [
            Polyhedron { faces, ..Default::default() },
            Polyhedron { faces, inner: &[*v], ..Default::default() },
            Polyhedron { faces, edges: asked, ..Default::default() },
        ] {
            let (mut alone, mut after) = (Vec::new(), Vec::new());
            let budget = [50, 5][i % 2];
            let filled =
                Reconnect::new(&Control::free()).fill(&points, &polyhedron, budget, &mut alone).unwrap();
            assert_eq!(reconnect.fill_another(&points, &polyhedron, budget, &mut after).unwrap(), filled);
            assert_eq!(alone, after);
            *if filled { &mut found } else { &mut none } += 1;
        }
    }
    assert!(found > 400 && none > 20, "{found} {none}");
}

/// A cone from an end of the required edge would lack the triangle, which has the inside on both sides: there is no filling at all.
#[test]
fn a_face_with_the_inside_on_both_sides_is_kept() {
    let (points, mut faces) = octahedron();
    faces.extend([[0, 1, 4], [0, 4, 1]]);
    // Not by `fill`: both sides of the triangle cancel in its sum of faces.
    let found = |edge: [u32; 2]| {
        let polyhedron = Polyhedron { faces: &faces, edges: &[edge], ..Default::default() };
        let mut tets = Vec::new();
        Reconnect::new(&Control::free())
            .fill(&points, &polyhedron, BUDGET, &mut tets)
            .unwrap()
            .then_some(tets)
    };
    assert!(found([4, 5]).is_none());
    let tets = found([0, 1]).unwrap();
    assert_eq!(tets.iter().filter(|t| [0, 1, 4].iter().all(|v| t.contains(v))).count(), 2);
}

#[test]
fn sheets_fill_rings_as_far_as_they_are_convex() {
    // A ring of n tetrahedra round an upright edge, its link on a circle; every second vertex drawn in to `inner` of its radius.
    let ring = |n: u32, inner: f64| {
        let mut xyz = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
        xyz.extend((0..n).map(|k| {
            let (angle, r) =
                (f64::from(k) * std::f64::consts::TAU / f64::from(n), if k % 2 == 1 { inner } else { 1.0 });
            [r * angle.cos(), r * angle.sin(), 0.0]
        }));
        (Points::new(xyz), (2..n + 2).collect::<Vec<u32>>())
    };
    for n in 3..=20 {
        let (points, link) = ring(n, 1.0);
        let mut tets = Vec::new();
        assert!(Sheets::default().fill(&points, [0, 1], &link, false, &mut tets).unwrap());
        assert_eq!(tets.len(), 2 * (n as usize - 2));
        let side = |k: usize| [link[k], link[(k + 1) % link.len()]];
        let faces: Vec<[u32; 3]> = (0..link.len())
            .flat_map(|k| [[0, side(k)[1], side(k)[0]], [1, side(k)[0], side(k)[1]]])
            .collect();
        check(&points, &Polyhedron { faces: &faces, ..Default::default() }, &tets);
        assert!(!tets.iter().any(|t| t.contains(&0) && t.contains(&1)));
    }
    // A star of six with inner corners: its sheet has the inner triangle, so an ear at an outer corner, none at an inner one.
    let (points, link) = ring(6, 0.4);
    let ear = |by: usize| {
        let mut turned = link.clone();
        turned.rotate_left(by);
        Sheets::default().fill(&points, [0, 1], &turned, true, &mut Vec::new()).unwrap()
    };
    assert_eq!([ear(1), ear(2)], [true, false]);
    // More than a half turn from one vertex of the link to the next but one: no sheet.
    let xyz = [[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [1.0, 0.0, 3.0], [-1.0, 2.0, 3.0], [-1.0, -2.0, 3.0]];
    let points = Points::new(xyz.to_vec());
    let mut tets = Vec::new();
    assert!(!Sheets::default().fill(&points, [0, 1], &[2, 3, 4], false, &mut tets).unwrap());
    assert!(tets.is_empty());
}

#[test]
fn sheets_are_the_best_of_all_triangulations() {
    let mut state = 7u64;
    let mut random = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let (mut filled, mut none) = ([0, 0], [0, 0]);
    for round in 0..600 {
        let n = 3 + round % 5;
        let mut xyz = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0]];
        xyz.extend((0..n).map(|k| {
            let angle = (k as f64 + 0.7 * random()) * std::f64::consts::TAU / n as f64;
            let r = 0.2 + 1.1 * random();
            [r * angle.cos(), r * angle.sin(), 3.0 * random() - 1.5]
        }));
        let points = Points::new(xyz);
        let link: Vec<u32> = (2..n as u32 + 2).collect();
        for ear in [false, true] {
            let tets_of = |triangles: &[[usize; 3]]| -> Vec<[u32; 4]> {
                triangles
                    .iter()
                    .map(|t| t.map(|i| link[i]))
                    .flat_map(|[a, b, c]| [[a, b, c, 1], [b, a, c, 0]])
                    .collect()
            };
            let worst = |tets: &[[u32; 4]]| {
                let at = |t: &[u32; 4]| quality(t.map(|v| points.xyz(v)));
                tets.iter().map(at).fold(f64::INFINITY, f64::min)
            };
            let best = triangulations(0, n - 1)
                .iter()
                .filter(|all| !ear || all.contains(&[0, n - 2, n - 1]))
                .map(|all| tets_of(all))
                .filter(|tets| tets.iter().all(|&[a, b, c, d]| points.orient3d(a, b, c, d) == Sign::Positive))
                .map(|tets| worst(&tets))
                .max_by(f64::total_cmp);
            let mut tets = Vec::new();
            let found = Sheets::default().fill(&points, [0, 1], &link, ear, &mut tets).unwrap();
            assert_eq!(found.then(|| worst(&tets)), best);
            *if found { &mut filled } else { &mut none }.get_mut(usize::from(ear)).unwrap() += 1;
        }
    }
    assert!(filled.iter().chain(&none).all(|&count| count > 50), "{filled:?} {none:?}");
}

/// Among the sheets of a ring, the one with the fewest tetrahedra that meet a segment across it is chosen.
#[test]
fn a_sheet_leaves_most_of_a_way_clear() {
    let mut less = 0;
    for n in 5..=12u32 {
        let mut xyz = vec![[0.0, 0.0, -1.0], [0.0, 0.0, 1.0], [-3.0, 0.3, 0.1], [3.0, 0.5, 0.3]];
        xyz.extend((0..n).map(|k| {
            let angle = (f64::from(k) + 0.3) * std::f64::consts::TAU / f64::from(n);
            [angle.cos(), angle.sin(), 0.0]
        }));
        let points = Points::new(xyz.clone());
        let link: Vec<u32> = (4..n + 4).collect();
        let (mut usual, mut clear) = (Vec::new(), Vec::new());
        let mut sheets = Sheets::default();
        assert!(sheets.fill(&points, [0, 1], &link, false, &mut usual).unwrap());
        assert!(sheets.clear(&points, [0, 1], &link, [2, 3], &mut clear).unwrap());
        let faces: Vec<[u32; 3]> = (0..link.len())
            .map(|k| [link[k], link[(k + 1) % link.len()]])
            .flat_map(|[a, b]| [[0, b, a], [1, a, b]])
            .collect();
        check(&points, &Polyhedron { faces: &faces, ..Default::default() }, &clear);
        // Tetrahedra that contain one of many positions on the segment.
        let met = |tets: &[[u32; 4]]| {
            let place = |i: u32| {
                let part = f64::from(i) / 2000.0;
                std::array::from_fn(|k| xyz[2][k] + part * (xyz[3][k] - xyz[2][k]))
            };
            let with_places = Points::new(xyz.iter().copied().chain((1..2000).map(place)).collect());
            let places = n + 4..n + 4 + 1999;
            let inside = |t: &[u32; 4], p: u32| {
                (0..4).all(|i| {
                    let mut with = *t;
                    with[i] = p;
                    let [a, b, c, d] = with;
                    with_places.orient3d(a, b, c, d) == Sign::Positive
                })
            };
            tets.iter().filter(|t| places.clone().any(|p| inside(t, p))).count()
        };
        let [usual, clear] = [met(&usual), met(&clear)];
        assert!(clear <= usual, "{n}: {clear} {usual}");
        less += usize::from(clear < usual);
    }
    assert!(less > 0);
}

/// A skew octahedron: its three diagonals give three fillings, and their qualities differ.
fn skew_octahedron() -> (Points, Vec<[u32; 3]>) {
    let xyz = vec![
        [1.0, 0.1, 0.0],
        [-0.9, 0.0, 0.2],
        [0.1, 1.5, 0.1],
        [0.0, -1.3, -0.2],
        [0.2, 0.1, 2.5],
        [0.0, 0.3, -1.9],
    ];
    let mut faces = Vec::new();
    for (x, y, z) in (0..8).map(|i| (i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2))) {
        let odd = (x + y + z) % 2 == 1;
        faces.push(if odd { [x, z, y] } else { [x, y, z] });
    }
    (Points::new(xyz), faces)
}

#[test]
fn the_best_filling_is_found() {
    let (points, faces) = skew_octahedron();
    let polyhedron = Polyhedron { faces: &faces, ..Default::default() };
    let free = Control::free();
    let mut reconnect = Reconnect::new(&free);
    for measure in [Measure::Angle, Measure::Ratio] {
        let worst = |tets: &[[u32; 4]]| {
            tets.iter().map(|&t| Shape::of(&points, t).by(measure)).fold(f64::INFINITY, f64::min)
        };
        // All fillings: one for each diagonal.
        let mut values: Vec<f64> = [[0, 1], [2, 3], [4, 5]]
            .iter()
            .map(|&edge| worst(&fill(&points, &Polyhedron { edges: &[edge], ..polyhedron }).unwrap()))
            .collect();
        values.sort_by(f64::total_cmp);
        assert!(values[0] < values[1] && values[1] < values[2], "{values:?}");
        for (above, found) in [(0.0, true), (values[1], true), (values[2], false)] {
            let goal = Goal { measure, above, least: 0.0, largest: f64::INFINITY };
            let mut tets = Vec::new();
            assert_eq!(reconnect.improve(&points, &polyhedron, goal, BUDGET, &mut tets).unwrap(), found);
            assert_eq!(found, !tets.is_empty());
            if found {
                check(&points, &polyhedron, &tets);
                assert_eq!(worst(&tets), values[2]);
            }
            let mut some = Vec::new();
            assert_eq!(reconnect.reach(&points, &polyhedron, goal, BUDGET, &mut some).unwrap(), found);
            if found {
                check(&points, &polyhedron, &some);
                assert!(worst(&some) > above);
            }
        }
        // A filling that misses the other measure does not count.
        let goal = Goal { measure, above: 0.0, least: 10.0, largest: f64::INFINITY };
        assert!(!reconnect.improve(&points, &polyhedron, goal, BUDGET, &mut Vec::new()).unwrap());
    }
}

#[test]
fn a_sheet_reaches_its_goal_or_is_none() {
    let (points, _) = skew_octahedron();
    // Round the edge from bottom to top.
    let (edge, link) = ([5, 4], [0, 2, 1, 3]);
    let mut sheets = Sheets::default();
    let mut best = Vec::new();
    let mut goal = Goal { measure: Measure::Angle, above: 0.0, least: 0.0, largest: f64::INFINITY };
    assert!(sheets.improve(&points, edge, &link, &goal, &mut best).unwrap());
    let worst = best.iter().map(|&t| Shape::of(&points, t).angle).fold(f64::INFINITY, f64::min);
    assert!(best.iter().all(|&[a, b, c, d]| points.orient3d(a, b, c, d) == Sign::Positive));
    goal.above = 0.999 * worst;
    let mut again = Vec::new();
    assert!(sheets.improve(&points, edge, &link, &goal, &mut again).unwrap());
    assert_eq!(again, best);
    goal.above = worst;
    assert!(!sheets.improve(&points, edge, &link, &goal, &mut again).unwrap());
    assert_eq!(again, best, "nothing is appended");
}
