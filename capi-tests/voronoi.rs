//! Weighted Delaunay tetrahedralizations and Voronoi diagrams against their definitions, in big integers and by brute force.
use delotet::query::{Edges, Faces, Voronoi};
use delotet::{
    check_guarantee, check_mesh, tetrahedralize, CancelToken, Error, Guarantee, Lift, Mode, Options, Plc,
    Segment, Silent, Status, TetMesh, INVALID,
};
use num_bigint::BigInt;
use num_traits::Signed;

/// Coordinates are exact integers in units of 2^-UNIT, weights in its square.
const UNIT: i32 = 60;

/// Deterministic numbers in [0, 1).
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
    fn point(&mut self) -> [f64; 3] {
        [self.next(), self.next(), self.next()]
    }
    fn below(&mut self, n: u32) -> f64 {
        (self.next() * f64::from(n)).floor()
    }
}

fn integer(x: f64, unit: i32) -> BigInt {
    let bits = x.abs().to_bits();
    let (mantissa, exponent) = match (bits >> 52) as i32 {
        0 => (bits, -1074),
        biased => (bits & ((1 << 52) - 1) | 1 << 52, biased - 1075),
    };
    let shift = exponent + unit;
    let value = match shift {
        0.. => BigInt::from(mantissa) << shift,
        _ => {
            assert!(mantissa.trailing_zeros() as i32 >= -shift || mantissa == 0, "the unit is too coarse");
            BigInt::from(mantissa) >> -shift
        }
    };
    if x < 0.0 {
        -value
    } else {
        value
    }
}

type Row = [BigInt; 4];

/// The lifted points.
fn rows(plc: &Plc) -> Vec<Row> {
    let lift = |i: usize, p: &[BigInt; 3]| {
        let square = &p[0] * &p[0] + &p[1] * &p[1] + &p[2] * &p[2];
        match &plc.lift {
            Lift::Plain => square,
            Lift::Weights(weights) => square - integer(weights[i], 2 * UNIT),
            Lift::Heights(heights) => integer(heights[i], 2 * UNIT),
        }
    };
    let row = |(i, p): (usize, &[f64; 3])| {
        let p = p.map(|x| integer(x, UNIT));
        let h = lift(i, &p);
        let [x, y, z] = p;
        [x, y, z, h]
    };
    plc.points.iter().enumerate().map(row).collect()
}

fn minus(a: &Row, b: &Row) -> Row {
    [0, 1, 2, 3].map(|k| &a[k] - &b[k])
}

fn det3(a: &Row, b: &Row, c: &Row) -> BigInt {
    &a[0] * (&b[1] * &c[2] - &b[2] * &c[1]) - &a[1] * (&b[0] * &c[2] - &b[2] * &c[0])
        + &a[2] * (&b[0] * &c[1] - &b[1] * &c[0])
}

/// Positive when the lift of `e` is below the hyperplane through those of the positive tetrahedron.
fn power(tet: [&Row; 4], e: &Row) -> BigInt {
    let [a, b, c, d] = tet.map(|row| minus(row, e));
    &a[3] * det3(&b, &c, &d) - &b[3] * det3(&a, &c, &d) + &c[3] * det3(&a, &b, &d) - &d[3] * det3(&a, &b, &c)
}

fn orientation([a, b, c, d]: [&Row; 4]) -> BigInt {
    det3(&minus(b, a), &minus(c, a), &minus(d, a))
}

fn options() -> Options {
    Options { mode: Mode::Delaunay, ..Options::default() }
}

fn mesh_of(plc: &Plc) -> TetMesh {
    tetrahedralize(plc, &options(), &mut Silent)
        .unwrap_or_else(|error| panic!("{error}: {:?}", error.defects))
}

/// Compares with the definition: no point is in conflict with any tetrahedron; a hidden one lies in one, on or above its hyperplane.
fn compare_with_definition(name: &str, plc: &Plc, mesh: &TetMesh) {
    check_guarantee(plc, mesh, 10).unwrap_or_else(|error| panic!("{name}: {error}: {:?}", error.defects));
    let rows = rows(plc);
    let mut hidden_by: Vec<u32> = vec![0; rows.len()];
    let mut used = vec![false; rows.len()];
    for tet in &mesh.tets {
        let corners = tet.map(|v| &rows[v as usize]);
        assert!(orientation(corners).is_positive(), "{name}");
        tet.iter().for_each(|&v| used[v as usize] = true);
        for (i, row) in rows.iter().enumerate().filter(|(i, _)| !tet.contains(&(*i as u32))) {
            assert!(!power(corners, row).is_positive(), "{name}: point {i} is in conflict with {tet:?}");
            let inside = (0..4).all(|k| {
                let mut moved = corners;
                moved[k] = row;
                !orientation(moved).is_negative()
            });
            hidden_by[i] += u32::from(inside);
        }
    }
    let unmeshed = |i: usize| mesh.unmeshed_points.contains(&(i as u32));
    for i in 0..rows.len() {
        assert_eq!(!used[i], unmeshed(i), "{name}: point {i}");
        assert!(used[i] || hidden_by[i] > 0, "{name}: point {i} is lost");
        let hidden = mesh.hidden_points.contains(&(i as u32));
        assert_eq!(hidden, unmeshed(i) && mesh.point_alias[i] == i as u32, "{name}: point {i}");
    }
}

fn weighted(points: Vec<[f64; 3]>, lift: Lift) -> Plc {
    Plc { points, lift, ..Plc::default() }
}

fn grid(n: u32) -> Vec<[f64; 3]> {
    (0..n * n * n).map(|i| [i % n, i / n % n, i / (n * n)].map(f64::from)).collect()
}

fn sets() -> Vec<(&'static str, Plc)> {
    let mut random = Random(3);
    let mut sets = Vec::new();
    for (name, spread) in [("few hidden", 0.02), ("some hidden", 0.1), ("most hidden", 1.0)] {
        let points: Vec<[f64; 3]> = (0..120).map(|_| random.point()).collect();
        let weights = points.iter().map(|_| spread * random.next()).collect();
        sets.push((name, weighted(points, Lift::Weights(weights))));
    }
    let points: Vec<[f64; 3]> = (0..100).map(|_| random.point()).collect();
    sets.push((
        "negative",
        weighted(points, Lift::Weights((0..100).map(|_| -0.1 * random.next()).collect())),
    ));
    for (name, n, range) in [("grid", 5, 3), ("small grid", 3, 6), ("flat weights", 4, 1)] {
        let points = grid(n);
        let weights = points.iter().map(|_| random.below(range) - 1.0).collect();
        sets.push((name, weighted(points, Lift::Weights(weights))));
    }
    let heights = |points: &[[f64; 3]], of: &mut dyn FnMut(&[f64; 3]) -> f64| points.iter().map(of).collect();
    let points = grid(4);
    let affine = heights(&points, &mut |p| 3.0 * p[0] - p[1] + 2.0);
    sets.push(("all lifts in one hyperplane", weighted(points.clone(), Lift::Heights(affine))));
    let convex = heights(&points, &mut |p| p[0].abs() + (p[1] - 1.0).abs() + p[2]);
    sets.push(("lifts in few hyperplanes", weighted(points.clone(), Lift::Heights(convex))));
    let few = heights(&points, &mut |_| random.below(3));
    sets.push(("small heights", weighted(points, Lift::Heights(few))));
    let points: Vec<[f64; 3]> = (0..80).map(|_| random.point()).collect();
    let any = heights(&points, &mut |_| random.next());
    sets.push(("random heights", weighted(points, Lift::Heights(any))));
    // Many points in the planes, edges and corners of the hull.
    let points: Vec<[f64; 3]> =
        (0..150).map(|_| [random.below(4), random.below(4), random.below(2)]).collect();
    let weights = points.iter().map(|_| random.below(3)).collect();
    sets.push(("equal points with different weights", weighted(points, Lift::Weights(weights))));
    let mut points: Vec<[f64; 3]> = (0..60).map(|_| [random.below(6), random.below(6), 0.0]).collect();
    points.push([2.0, 3.0, 5.0]);
    let weights = points.iter().map(|_| random.below(5)).collect();
    sets.push(("a plane and an apex", weighted(points, Lift::Weights(weights))));
    sets
}

/// Equal points count as one: gives each the value that counts.
fn merged(plc: &Plc) -> Plc {
    let mut merged = plc.clone();
    let best = |values: &[f64], i: usize, sign: f64| {
        let equal = plc.points.iter().zip(values).filter(|x| *x.0 == plc.points[i]).map(|x| sign * x.1);
        sign * equal.fold(f64::NEG_INFINITY, f64::max)
    };
    merged.lift = match &plc.lift {
        Lift::Plain => Lift::Plain,
        Lift::Weights(values) => Lift::Weights((0..values.len()).map(|i| best(values, i, 1.0)).collect()),
        Lift::Heights(values) => Lift::Heights((0..values.len()).map(|i| best(values, i, -1.0)).collect()),
    };
    merged
}

#[test]
fn weighted_meshes_have_no_point_below_them() {
    let mut hidden = 0;
    for (name, plc) in sets() {
        let mesh = mesh_of(&plc);
        assert_eq!(mesh.guarantee, Guarantee::WeightedDelaunay);
        compare_with_definition(name, &merged(&plc), &mesh);
        check_mesh(&plc, &mesh, true, 10).unwrap();
        hidden += mesh.hidden_points.len();
    }
    assert!(hidden > 200, "{hidden}");
}

/// Small integers: lifts in common hyperplanes, points in common planes and lines, equal points.
#[test]
fn small_integer_sets_are_meshed_by_the_definition() {
    let mut random = Random(21);
    let (mut meshed, mut hidden) = (0, 0);
    for case in 0..400 {
        let count = 5 + random.below(25) as usize;
        let size = 2 + random.below(3) as u32;
        let points: Vec<[f64; 3]> = (0..count).map(|_| [0; 3].map(|_| random.below(size))).collect();
        let range = 1 + random.below(4) as u32;
        let values = points.iter().map(|_| random.below(range) * 0.5).collect();
        let plc = weighted(points, if case % 3 == 0 { Lift::Heights(values) } else { Lift::Weights(values) });
        let mesh = match tetrahedralize(&plc, &options(), &mut Silent) {
            Ok(mesh) => mesh,
            Err(error) => {
                assert_eq!(error.status, Status::DegenerateInput);
                continue;
            }
        };
        let name = format!("case {case}");
        compare_with_definition(&name, &merged(&plc), &mesh);
        check_structure(&name, &mesh, &Voronoi::new(&mesh).unwrap());
        meshed += 1;
        hidden += mesh.hidden_points.len();
    }
    assert!(meshed > 300 && hidden > 200, "{meshed} {hidden}");
}

#[test]
fn the_order_of_the_points_does_not_matter() {
    let mut random = Random(9);
    let points: Vec<[f64; 3]> = (0..400).map(|_| random.point()).collect();
    let weights: Vec<f64> = (0..400).map(|_| 0.05 * random.next()).collect();
    let tets = |turn: usize| {
        let place = |i: usize| (i * turn) % 401 % 400;
        let mut list: Vec<usize> = (0..400).collect();
        list.sort_by_key(|&i| place(i));
        let plc = weighted(
            list.iter().map(|&i| points[i]).collect(),
            Lift::Weights(list.iter().map(|&i| weights[i]).collect()),
        );
        let mesh = mesh_of(&plc);
        let mut tets: Vec<[usize; 4]> = mesh.tets.iter().map(|tet| tet.map(|v| list[v as usize])).collect();
        tets.iter_mut().for_each(|tet| tet.sort_unstable());
        tets.sort_unstable();
        tets
    };
    let reference = tets(1);
    assert!(reference == tets(7) && reference == tets(395));
}

#[test]
fn equal_weights_make_the_bytes_of_no_weights() {
    let mut random = Random(4);
    for points in [grid(6), (0..3000).map(|_| random.point()).collect()] {
        let plain = mesh_of(&weighted(points.clone(), Lift::Plain));
        for weight in [0.0, 0.3, -7.0] {
            let mesh = mesh_of(&weighted(points.clone(), Lift::Weights(vec![weight; points.len()])));
            assert!(
                mesh.tets == plain.tets && mesh.neighbors == plain.neighbors && mesh.points == plain.points
            );
            assert_eq!(mesh.hidden_points, []);
        }
        // The squares as heights: the same tetrahedra, one by one.
        let squares = points.iter().map(|p| p.iter().map(|x| x * x).sum()).collect();
        let mesh = mesh_of(&weighted(points.clone(), Lift::Heights(squares)));
        let sorted = |mesh: &TetMesh| {
            let mut tets = mesh.tets.clone();
            tets.iter_mut().for_each(|tet| tet.sort_unstable());
            tets.sort_unstable();
            tets
        };
        // The squares of the grid are exact.
        assert!(points.len() != 216 || sorted(&mesh) == sorted(&plain));
    }
}

#[test]
fn any_number_of_threads_makes_the_same_weighted_mesh() {
    let mut random = Random(5);
    let points: Vec<[f64; 3]> = (0..80_000).map(|_| random.point()).collect();
    let weights = points.iter().map(|_| 1e-3 * random.next()).collect();
    let plc = weighted(points, Lift::Weights(weights));
    let one = mesh_of(&plc);
    assert!(one.hidden_points.len() > 1000);
    let three = tetrahedralize(&plc, &Options { threads: 3, ..options() }, &mut Silent).unwrap();
    assert!(
        one.tets == three.tets
            && one.neighbors == three.neighbors
            && one.hidden_points == three.hidden_points
    );
    check_guarantee(&plc, &one, 10).unwrap();
    let diagram = Voronoi::new(&one).unwrap();
    assert_eq!(diagram.cells.iter().filter(|cell| cell.count == 0).count(), one.hidden_points.len());
}

#[test]
fn a_check_finds_wrong_weights() {
    let (_, plc) = sets().swap_remove(1);
    let mesh = mesh_of(&plc);
    let Lift::Weights(weights) = &plc.lift else { panic!("no weights") };
    let mut other = weights.clone();
    // A hidden point comes up; a vertex goes down.
    let hidden = mesh.hidden_points[0] as usize;
    other[hidden] += 1.0;
    let error = check_guarantee(&Plc { lift: Lift::Weights(other), ..plc.clone() }, &mesh, 10).unwrap_err();
    assert_eq!(error.status, Status::CheckFailed);
    let inner = Voronoi::new(&mesh).unwrap().cells.iter().position(|cell| cell.bounded).unwrap();
    let mut other = weights.clone();
    other[inner] -= 1.0;
    let error = check_guarantee(&Plc { lift: Lift::Weights(other), ..plc.clone() }, &mesh, 10).unwrap_err();
    assert_eq!(error.status, Status::CheckFailed);
    // Without weights it is not judged.
    check_guarantee(&Plc { lift: Lift::Plain, ..plc }, &mesh, 10).unwrap();
}

#[test]
fn hidden_points_can_be_dropped() {
    let (_, plc) = sets().swap_remove(2);
    let whole = mesh_of(&plc);
    let dropping = Options { drop_unmeshed_points: true, ..options() };
    let mesh = tetrahedralize(&plc, &dropping, &mut Silent).unwrap();
    assert_eq!(mesh.points.len(), plc.points.len() - whole.unmeshed_points.len());
    assert_eq!(mesh.lift.values().len(), mesh.points.len());
    let new_index = &mesh.dropped.as_ref().unwrap().new_index;
    assert!(
        whole.hidden_points.iter().all(|&v| new_index[v as usize] == INVALID)
            && mesh.hidden_points.is_empty()
    );
    check_guarantee(&plc, &mesh, 10).unwrap();
    let [of_whole, of_rest] = [&whole, &mesh].map(|mesh| Voronoi::new(mesh).unwrap());
    assert_eq!(of_whole.vertices, of_rest.vertices);
}

#[test]
fn weights_that_cannot_be_used_are_refused() {
    let points = grid(3);
    let count = points.len();
    let with = |i: usize, weight: f64| {
        let mut weights = vec![0.0; count];
        weights[i] = weight;
        weighted(points.clone(), Lift::Weights(weights))
    };
    let refusal = |plc: &Plc, options: &Options| {
        let Error { status, message, .. } = tetrahedralize(plc, options, &mut Silent).unwrap_err();
        (status, message.to_string())
    };
    let invalid = |plc: &Plc, options: &Options, text: &str| {
        assert_eq!(refusal(plc, options), (Status::InvalidArgument, text.to_string()));
    };
    invalid(&with(4, f64::NAN), &options(), "point 4 has the weight NaN, which is not finite");
    invalid(&with(5, f64::INFINITY), &options(), "point 5 has the weight inf, which is not finite");
    invalid(&with(5, 1.0), &Options::default(), "weights of points: only mode delaunay counts them");
    let short = weighted(points.clone(), Lift::Heights(vec![1.0]));
    invalid(&short, &options(), "1 heights for 27 points");
    let segment = Segment { ends: [0, 1], marker: 0 };
    let plc = Plc { segments: vec![segment], ..with(0, 1.0) };
    invalid(&plc, &options(), "weights of points: not offered with facets or segments");
    let plc = Plc { triangles: vec![[0, 1, 5]], ..with(0, 1.0) };
    invalid(&plc, &options(), "weights of points: not offered with facets or segments");
    let (status, message) = refusal(&with(3, 1e200), &options());
    assert_eq!(status, Status::CoordinateRange, "{message}");
    // Scaled coordinates: the weights are scaled with them.
    for factor in [2f64.powi(-700), 2f64.powi(400)] {
        let plc = weighted(
            points.iter().map(|p| p.map(|x| x * factor)).collect(),
            Lift::Weights(
                (0..count)
                    .map(|i| if factor < 1.0 { 0.0 } else { (i % 3) as f64 * factor * factor })
                    .collect(),
            ),
        );
        let mesh = mesh_of(&plc);
        check_guarantee(&plc, &mesh, 10).unwrap();
    }
}

#[test]
fn limits_end_a_weighted_run_and_a_diagram() {
    let mut random = Random(6);
    let points: Vec<[f64; 3]> = (0..20_000).map(|_| random.point()).collect();
    let weights = points.iter().map(|_| 0.01 * random.next()).collect();
    let plc = weighted(points, Lift::Weights(weights));
    let token = CancelToken::new();
    token.cancel();
    let cancelled = Options { cancel: Some(token), ..options() };
    assert_eq!(tetrahedralize(&plc, &cancelled, &mut Silent).unwrap_err().status, Status::Cancelled);
    let few = Options { tetrahedra_limit: Some(100), ..options() };
    assert_eq!(tetrahedralize(&plc, &few, &mut Silent).unwrap_err().status, Status::TetrahedraLimit);
    let mesh = mesh_of(&plc);
    let made =
        delotet::controlled(cancelled.limits(), &mut Silent, |control| Voronoi::new_with(&mesh, control));
    assert_eq!(made.unwrap_err().status, Status::Cancelled);
}

/// The power distance.
fn distance(plc: &Plc, i: usize, at: &[f64; 3]) -> f64 {
    let p = plc.points[i];
    let square: f64 = (0..3).map(|k| (p[k] - at[k]) * (p[k] - at[k])).sum();
    match &plc.lift {
        Lift::Plain => square,
        Lift::Weights(weights) => square - weights[i],
        Lift::Heights(heights) => square - p.iter().map(|x| x * x).sum::<f64>() + heights[i],
    }
}

/// The duality, and what follows of it.
fn check_structure(name: &str, mesh: &TetMesh, diagram: &Voronoi) {
    let (faces, edges) = (Faces::new(mesh).unwrap(), Edges::new(mesh).unwrap());
    assert_eq!(diagram.vertices.len(), mesh.tets.len());
    assert_eq!(diagram.edges.len(), faces.faces.len());
    assert_eq!(diagram.facets.len(), edges.edges.len());
    assert_eq!(diagram.cells.len(), mesh.points.len());
    for (edge, face) in diagram.edges.iter().zip(&faces.faces) {
        assert_eq!(edge.vertices, face.tets);
        let length: f64 = edge.direction.iter().map(|x| x * x).sum();
        assert!(if face.tets[1] == INVALID { (length - 1.0).abs() < 1e-15 } else { length == 0.0 }, "{name}");
    }
    let mut on_facets = vec![0; diagram.edges.len()];
    for (facet, edge) in diagram.facets.iter().zip(&edges.edges) {
        assert_eq!(facet.cells, edge.ends);
        let ring = diagram.edges_of(facet);
        assert!(ring.len() >= if facet.bounded { 3 } else { 2 }, "{name}");
        let ends = |i: usize| diagram.edges[ring[i] as usize].vertices;
        for i in 0..ring.len() {
            on_facets[ring[i] as usize] += 1;
            let is_ray = ends(i)[1] == INVALID;
            assert_eq!(is_ray, !facet.bounded && (i == 0 || i + 1 == ring.len()), "{name}");
            // Consecutive edges share a vertex, whose tetrahedron has both points.
            if i + 1 < ring.len() || facet.bounded {
                let next = ends((i + 1) % ring.len());
                let shared =
                    ends(i).into_iter().find(|v| *v != INVALID && next.contains(v)).expect("a shared vertex");
                assert!(facet.cells.iter().all(|v| mesh.tets[shared as usize].contains(v)), "{name}");
            }
        }
    }
    assert!(on_facets.iter().all(|&count| count == 3), "{name}: an edge is on three facets");
    let hull: std::collections::BTreeSet<u32> =
        faces.faces.iter().filter(|face| face.tets[1] == INVALID).flat_map(|face| face.corners).collect();
    for (i, cell) in (0u32..).zip(&diagram.cells) {
        let facets = diagram.facets_of(cell);
        assert!(facets.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(facets.iter().all(|&f| diagram.facets[f as usize].cells.contains(&i)));
        assert_eq!(facets.is_empty(), mesh.unmeshed_points.contains(&i), "{name}");
        assert_eq!(cell.bounded, !facets.is_empty() && !hull.contains(&i), "{name}");
        if cell.bounded {
            // Euler's formula for the cell.
            let mut vertices: Vec<u32> = Vec::new();
            let mut edges: Vec<u32> = Vec::new();
            for &f in facets {
                let ring = diagram.edges_of(&diagram.facets[f as usize]);
                edges.extend(ring);
                vertices.extend(ring.iter().flat_map(|&e| diagram.edges[e as usize].vertices));
            }
            for list in [&mut vertices, &mut edges] {
                list.sort_unstable();
                list.dedup();
            }
            assert_eq!(vertices.len() + facets.len(), edges.len() + 2, "{name}");
        }
    }
    assert_eq!(diagram.cell_facets.len(), 2 * diagram.facets.len());
}

/// The volume of a bounded cell: a pyramid from its point, or any other, over each facet.
fn volume(diagram: &Voronoi, i: u32, apex: [f64; 3]) -> f64 {
    let cell = &diagram.cells[i as usize];
    let mut sum = 0.0;
    for &f in diagram.facets_of(cell) {
        let facet = &diagram.facets[f as usize];
        let ring = diagram.edges_of(facet);
        let ends = |k: usize| diagram.edges[ring[k % ring.len()] as usize].vertices;
        let corners: Vec<[f64; 3]> = (0..ring.len())
            .map(|k| {
                let next = ends(k + 1);
                // The two edges of a triangle without extent may share both; any order of them has the same area.
                let shared = ends(k).into_iter().find(|v| next.contains(v)).expect("a shared vertex");
                let at = diagram.vertices[shared as usize];
                [0, 1, 2].map(|k| at[k] - apex[k])
            })
            .collect();
        let mut pyramid = 0.0;
        for pair in corners[1..].windows(2) {
            let (a, b, c) = (corners[0], pair[0], pair[1]);
            pyramid += a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0])
                + a[2] * (b[0] * c[1] - b[1] * c[0]);
        }
        // Counterclockwise seen from the second cell: outward for the first.
        sum += if facet.cells[0] == i { pyramid } else { -pyramid };
    }
    sum / 6.0
}

#[test]
fn diagrams_are_dual_and_cells_hold_what_is_nearest() {
    let mut random = Random(8);
    let mut all = sets();
    all.push(("plain", weighted((0..150).map(|_| random.point()).collect(), Lift::Plain)));
    all.push(("plain grid", weighted(grid(5), Lift::Plain)));
    let on_sphere = |random: &mut Random| loop {
        let p = random.point().map(|x| 2.0 * x - 1.0);
        let r = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (0.1..1.0).contains(&r) {
            return p.map(|x| x / r);
        }
    };
    all.push(("sphere", weighted((0..100).map(|_| on_sphere(&mut random)).collect(), Lift::Plain)));
    let mut on_cube: Vec<[f64; 3]> = Vec::new();
    for p in grid(2) {
        on_cube.push(p.map(|x| 5.0 * (2.0 * x - 1.0)));
        // All at the distance 5² · 3 = 75 = 1 + 25 + 49 of the origin: cospherical exactly.
        for turn in 0..3 {
            let mut q = [1.0, 5.0, 7.0];
            q.rotate_left(turn);
            on_cube.push([0, 1, 2].map(|k| q[k] * (2.0 * p[k] - 1.0)));
        }
    }
    all.push(("cospherical", weighted(on_cube, Lift::Plain)));
    for (name, plc) in all {
        let mesh = mesh_of(&plc);
        let plc = merged(&plc);
        let diagram = Voronoi::new(&mesh).unwrap();
        check_structure(name, &mesh, &diagram);
        for (tet, at) in mesh.tets.iter().zip(&diagram.vertices) {
            let own = tet.map(|v| distance(&plc, v as usize, at));
            let size: f64 = at.iter().map(|x| x * x).sum::<f64>() + 100.0;
            let tolerance = 1e-13 * size;
            assert!(own.iter().all(|d| (d - own[0]).abs() <= tolerance), "{name}: {own:?}");
            let nearest = (0..plc.points.len()).map(|i| distance(&plc, i, at)).fold(f64::INFINITY, f64::min);
            assert!(nearest >= own[0] - tolerance, "{name}: a point is nearer than those of its tetrahedron");
        }
        if name == "cospherical" {
            assert!(diagram.vertices.iter().all(|at| *at == [0.0; 3]));
        }
        // A place is in the cell of the nearest point, and in no other, as far as the facets of the cells say.
        for _ in 0..200 {
            let size = plc.points.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
            let at = random.point().map(|x| (3.0 * x - 1.0) * size);
            let distances: Vec<f64> = (0..plc.points.len()).map(|i| distance(&plc, i, &at)).collect();
            let least = distances.iter().copied().fold(f64::INFINITY, f64::min);
            let holds = |i: &usize| {
                let facets = diagram.facets_of(&diagram.cells[*i]);
                let other = |f: &u32| {
                    diagram.facets[*f as usize].cells.into_iter().find(|&c| c as usize != *i).unwrap()
                };
                !facets.is_empty() && facets.iter().all(|f| distances[*i] <= distances[other(f) as usize])
            };
            let cells: Vec<usize> = (0..plc.points.len()).filter(holds).collect();
            assert!(
                !cells.is_empty() && cells.iter().all(|&i| distances[i] <= least + 1e-12),
                "{name}: {cells:?}"
            );
        }
    }
}

#[test]
fn inner_cells_of_a_grid_are_unit_cubes() {
    let n = 6;
    let points = grid(n);
    let mesh = mesh_of(&weighted(points.clone(), Lift::Plain));
    let diagram = Voronoi::new(&mesh).unwrap();
    let mut inner = 0;
    for (i, p) in (0u32..).zip(&points) {
        let is_inner = p.iter().all(|&x| x > 0.0 && x < f64::from(n - 1));
        assert_eq!(diagram.cells[i as usize].bounded, is_inner);
        if is_inner {
            inner += 1;
            // Halves of integers: nothing rounds.
            assert_eq!(volume(&diagram, i, *p), 1.0);
            assert_eq!(volume(&diagram, i, [0.5, 7.0, -1.5]), 1.0);
        }
    }
    assert_eq!(inner, (n - 2) * (n - 2) * (n - 2));
}

#[test]
fn cells_of_mirrored_points_fill_a_cube() {
    let mut random = Random(10);
    for spread in [0.0, 0.03] {
        let inside: Vec<[f64; 3]> = (0..300).map(|_| random.point()).collect();
        let mut points = inside.clone();
        for axis in 0..3 {
            for side in [0.0, 1.0] {
                points.extend(inside.iter().map(|p| {
                    let mut q = *p;
                    q[axis] = 2.0 * side - q[axis];
                    q
                }));
            }
        }
        let weights: Vec<f64> = (0..300).map(|_| spread * random.next()).collect();
        let lift = match spread > 0.0 {
            true => Lift::Weights(weights.repeat(7)),
            false => Lift::Plain,
        };
        let plc = weighted(points, lift);
        let mesh = mesh_of(&plc);
        let diagram = Voronoi::new(&mesh).unwrap();
        let cells = (0..300).filter(|&i| diagram.cells[i as usize].count > 0);
        let sum: f64 = cells.clone().map(|i| volume(&diagram, i, plc.points[i as usize])).sum();
        assert!(cells.clone().all(|i| diagram.cells[i as usize].bounded));
        assert!((sum - 1.0).abs() < 1e-12, "{spread}: {sum}");
        assert!(spread == 0.0 || cells.count() < 300, "nothing is hidden");
    }
}

#[test]
fn other_meshes_have_no_diagram() {
    let mut plc = Plc { points: grid(2), ..Plc::default() };
    let square = |a, b, c, d| [[a, b, c], [a, c, d]];
    plc.triangles = [
        square(0, 1, 3, 2),
        square(4, 5, 7, 6),
        square(0, 1, 5, 4),
        square(2, 3, 7, 6),
        square(0, 2, 6, 4),
        square(1, 3, 7, 5),
    ]
    .concat();
    let mesh = tetrahedralize(&plc, &Options::default(), &mut Silent).unwrap();
    let error = Voronoi::new(&mesh).unwrap_err();
    assert_eq!(error.status, Status::Unsupported);
    assert_eq!(error.message, "Voronoi diagram: only a mesh made in mode delaunay has one");
    let (_, plc) = sets().swap_remove(0);
    let mesh = TetMesh { lift: Lift::Plain, ..mesh_of(&plc) };
    assert_eq!(Voronoi::new(&mesh).unwrap_err().status, Status::Unsupported);
}
