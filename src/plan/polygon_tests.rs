//! Polygons that are planar only up to rounding: their diagonals are chosen freely and take no points.
use crate::check::{check_mesh, check_preserved};
use crate::control::Control;
use crate::plan::{tetrahedralize, Promise, Run, Statistics, Warnings};
use crate::{Element, Facet, Mode, Options, Plc, Silent, Status, TetMesh};
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

/// A vertex of a cell: its cell and the three neighbours, sorted; the walls of the unit cube are -1 to -6.
type Vertex = [i32; 4];

fn sorted<const N: usize>(mut list: [i32; N]) -> [i32; N] {
    list.sort_unstable();
    list
}

/// The plane between two seeds, or of a wall: normal and offset.
fn plane(seeds: &[[f64; 3]], i: i32, j: i32) -> ([f64; 3], f64) {
    if j < 0 {
        let (k, side) = ((-1 - j) / 2, (-1 - j) % 2);
        return (std::array::from_fn(|l| f64::from(l as i32 == k)), f64::from(side));
    }
    let (p, q) = (seeds[i as usize], seeds[j as usize]);
    let normal = std::array::from_fn(|k| q[k] - p[k]);
    (normal, (0..3).map(|k| 0.5 * (q[k] * q[k] - p[k] * p[k])).sum())
}

/// Where the three planes of a vertex meet, rounded.
fn position(seeds: &[[f64; 3]], vertex: Vertex) -> [f64; 3] {
    let i = vertex.into_iter().find(|&s| s >= 0).unwrap();
    let others: Vec<i32> = vertex.into_iter().filter(|&s| s != i).collect();
    let planes: [_; 3] = std::array::from_fn(|k| plane(seeds, i, others[k]));
    let det = |m: [[f64; 3]; 3]| {
        m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) - m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0])
            + m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0])
    };
    let rows = planes.map(|p| p.0);
    let mut p: [f64; 3] = std::array::from_fn(|k| {
        let mut replaced = rows;
        (0..3).for_each(|r| replaced[r][k] = planes[r].1);
        det(replaced) / det(rows)
    });
    for wall in others.into_iter().filter(|&j| j < 0) {
        p[(-1 - wall) as usize / 2] = f64::from((-1 - wall) % 2);
    }
    p
}

/// One Voronoi cell in the unit cube: its faces by neighbour, with their vertices in order.
fn cell(seeds: &[[f64; 3]], i: i32) -> BTreeMap<i32, Vec<Vertex>> {
    let mut faces: BTreeMap<i32, Vec<Vertex>> = BTreeMap::new();
    for k in 0..3i32 {
        for side in 0..2 {
            let corner = |u: i32, v: i32| {
                let walls =
                    [(k, side), ((k + 1) % 3, u), ((k + 2) % 3, v)].map(|(k, side)| -1 - 2 * k - side);
                sorted([walls[0], walls[1], walls[2], i])
            };
            let mut ring = vec![corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
            if side == 0 {
                ring.reverse();
            }
            faces.insert(-1 - 2 * k - side, ring);
        }
    }
    for j in (0..seeds.len() as i32).filter(|&j| j != i) {
        let (normal, offset) = plane(seeds, i, j);
        let beyond = |v: &Vertex| (0..3).map(|k| normal[k] * position(seeds, *v)[k]).sum::<f64>() > offset;
        let mut cut: BTreeMap<Vertex, Vertex> = BTreeMap::new();
        for ring in faces.values_mut() {
            let (mut rest, mut enter, mut leave) = (Vec::new(), None, None);
            for (a, b) in (0..ring.len()).map(|n| (ring[n], ring[(n + 1) % ring.len()])) {
                if !beyond(&a) {
                    rest.push(a);
                }
                if beyond(&a) != beyond(&b) {
                    let common: Vec<i32> = a.into_iter().filter(|s| *s != i && b.contains(s)).collect();
                    let new = sorted([common[0], common[1], i, j]);
                    rest.push(new);
                    *(if beyond(&b) { &mut leave } else { &mut enter }) = Some(new);
                }
            }
            cut.extend(enter.zip(leave));
            *ring = rest;
        }
        faces.retain(|_, ring| ring.len() > 2);
        if let Some((&first, _)) = cut.iter().next() {
            let mut ring = vec![first];
            while cut[&ring[ring.len() - 1]] != first {
                ring.push(cut[&ring[ring.len() - 1]]);
            }
            faces.insert(j, ring);
        }
    }
    faces
}

/// The Voronoi cells of random seeds in the unit cube.
fn polycrystal(cells: i32, mut state: u64) -> Plc {
    let mut random = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    let seeds: Vec<[f64; 3]> = (0..cells).map(|_| std::array::from_fn(|_| random())).collect();
    let mut plc = Plc::default();
    let mut number: BTreeMap<Vertex, u32> = BTreeMap::new();
    for i in 0..cells {
        for (j, ring) in cell(&seeds, i) {
            if j >= 0 && j < i {
                continue;
            }
            let corners = ring.iter().map(|v| {
                *number.entry(*v).or_insert_with(|| {
                    plc.points.push(position(&seeds, *v));
                    plc.points.len() as u32 - 1
                })
            });
            plc.facets.push(Facet { polygons: vec![corners.collect()], marker: i, ..Facet::default() });
        }
    }
    plc
}

/// Steiner points that are not on an edge of a polygon.
fn on_diagonals(plc: &Plc, mesh: &TetMesh) -> usize {
    let rings = plc.facets.iter().flat_map(|facet| &facet.polygons);
    let edges: BTreeSet<[u32; 2]> = rings
        .flat_map(|ring| (0..ring.len()).map(|k| [ring[k], ring[(k + 1) % ring.len()]]))
        .flat_map(|[a, b]| [[a, b], [b, a]])
        .collect();
    mesh.steiner.iter().filter(|point| !edges.contains(&point.ends)).count()
}

#[test]
fn polygons_of_a_polycrystal_take_few_points_for_their_diagonals() {
    let (mut points, mut diagonals) = (0, 0);
    for seed in 1..5 {
        let plc = polycrystal(40, seed);
        let mesh = tetrahedralize(&plc, &Options::default(), &mut Silent).unwrap();
        check_mesh(&plc, &mesh, true, 10).unwrap();
        points += mesh.steiner.len();
        diagonals += on_diagonals(&plc, &mesh);
        let cells: BTreeSet<u32> = mesh.tet_region.iter().copied().collect();
        assert_eq!(cells.len(), 40);
        for face in &mesh.subfaces {
            assert_eq!(face.marker, plc.facets[face.facet as usize].marker);
        }
    }
    // Twice as many of these crystals, seeds 1 to 8, take 216 points, 80 of them on diagonals: where cells are thin wedges.
    assert!(points <= 216, "{points} points");
    assert!(diagonals <= 80, "{diagonals} of {points} points on diagonals");
}

#[test]
fn a_polygon_with_points_on_its_edges_is_the_same_each_time() {
    let plc = polycrystal(30, 3);
    let run = || tetrahedralize(&plc, &Options::default(), &mut Silent).unwrap();
    let (one, two) = (run(), run());
    assert_eq!((one.tets, one.subfaces), (two.tets, two.subfaces));
}

/// A square, bent by less than rounding along a diagonal, with a vertex close above and one close below its middle, in a box.
fn pierced(bend: f64) -> Plc {
    let mut plc = Plc {
        points: vec![
            [1.0, 1.0, 0.0],
            [-1.0, 1.0, bend],
            [-1.0, -1.0, 0.0],
            [1.0, -1.0, 0.0],
            [0.0, 0.0, 0.125],
            [0.0, 0.0, -0.125],
        ],
        facets: vec![Facet { polygons: vec![vec![0, 1, 2, 3]], ..Facet::default() }],
        ..Plc::default()
    };
    for i in 0..8 {
        plc.points.push(std::array::from_fn(|k| if i >> k & 1 == 1 { 4.0 } else { -4.0 }));
    }
    for ring in [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]] {
        plc.facets.push(Facet { polygons: vec![ring.map(|v| v + 6).to_vec()], ..Facet::default() });
    }
    plc
}

#[test]
fn a_pierced_polygon_keeps_its_diagonal_as_a_segment() {
    for bend in [1e-17, -1e-17] {
        let plc = pierced(bend);
        let mesh = tetrahedralize(&plc, &Options::default(), &mut Silent).unwrap();
        check_mesh(&plc, &mesh, true, 10).unwrap();
        // Neither diagonal is an edge of the Delaunay tetrahedralization: the two vertices are joined through the middle.
        assert!(on_diagonals(&plc, &mesh) > 0);
    }
    let flat = pierced(0.0);
    let mesh = tetrahedralize(&flat, &Options::default(), &mut Silent).unwrap();
    assert_eq!(mesh.steiner.len(), 0, "a planar polygon needs no segment for its diagonal");
}

#[test]
fn polygons_keep_their_markers_in_both_modes() {
    let plc = polycrystal(12, 5);
    let options = Options { mode: Mode::Preserve, ..Options::default() };
    let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
    check_preserved(&plc, &mesh, 10).unwrap();
    assert!(mesh.steiner.iter().all(|point| point.is_inside()));
    let facets: BTreeSet<u32> = mesh.subfaces.iter().map(|face| face.facet).collect();
    assert_eq!(facets.len(), plc.facets.len());
}

/// A thin curved strip above the floor of a box: flat polygons of ten corners, whose Delaunay diagonals are not all in the
/// tetrahedralization of the corners.
fn strip() -> Plc {
    let mut plc = Plc::default();
    for z in [-20.0, 30.0] {
        plc.points.extend([[0.0, 0.0, z], [0.0, 50.0, z], [90.0, 50.0, z], [90.0, 0.0, z]]);
    }
    let low = [[11.3, 14.5], [26.3, 21.76], [41.3, 26.06], [56.3, 25.65], [71.3, 20.69]];
    let high = [[70.0, 26.19], [55.0, 31.15], [40.0, 31.56], [25.0, 27.26], [10.0, 20.0]];
    for z in [0.0, 4.0] {
        plc.points.extend(low.iter().chain(&high).map(|p| [p[0], p[1], z]));
    }
    let ring = |corners: &[u32]| Facet { polygons: vec![corners.to_vec()], ..Facet::default() };
    for side in [[0, 1, 2, 3], [4, 5, 6, 7], [0, 3, 7, 4], [1, 5, 6, 2], [0, 4, 5, 1], [3, 2, 6, 7]] {
        plc.facets.push(ring(&side));
    }
    plc.facets.push(ring(&(8..18).collect::<Vec<u32>>()));
    plc.facets.push(ring(&(18..28).collect::<Vec<u32>>()));
    plc.facets.extend((0..10).map(|k| ring(&[8 + k, 8 + (k + 1) % 10, 18 + (k + 1) % 10, 18 + k])));
    plc
}

#[test]
fn no_point_inside_for_the_diagonals_of_a_planar_polygon() {
    let plc = strip();
    let options = Options { mode: Mode::Preserve, ..Options::default() };
    let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
    check_preserved(&plc, &mesh, 10).unwrap();
    assert_eq!(mesh.steiner.len(), 0);
    // Two triangles for a quadrilateral, eight for a polygon of ten corners.
    for (f, facet) in plc.facets.iter().enumerate() {
        let count = mesh.subfaces.iter().filter(|face| face.facet as usize == f).count();
        assert_eq!(count, facet.polygons[0].len() - 2);
    }
}

#[test]
fn a_broken_promise_is_internal() {
    let plc = strip();
    let options = Options { mode: Mode::Preserve, ..Options::default() };
    let mut mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
    let mut run = Run {
        is_refining: false,
        clock: Instant::now(),
        statistics: Statistics::default(),
        warnings: Warnings::default(),
        seeds: Warnings::default(),
        unmerged_at_least: 0,
        promise: Promise::default(),
        control: &Control::free(),
    };
    run.audit(&plc, &options, &mut mesh).unwrap();
    let face = mesh.subfaces.pop().unwrap();
    run.promise.triangles.push((face.corners, face.facet));
    let error = run.audit(&plc, &options, &mut mesh).unwrap_err();
    assert_eq!((error.status, error.defects[0].first), (Status::Internal, Element::Facet(face.facet)));
}
