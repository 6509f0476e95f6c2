//! On a grid of cubes cut into six tetrahedra each, where every count and every answer is known.
use super::*;
use crate::{Plc, Region, Segment, SteinerPoint, Subface, Subsegment, TetMesh, INVALID};
use std::collections::BTreeMap;

/// n × n × n unit cubes, each cut into the six tetrahedra along its diagonal.
pub(crate) fn grid(n: usize) -> TetMesh {
    let at = |x: usize, y: usize, z: usize| (x + (n + 1) * (y + (n + 1) * z)) as u32;
    let mut mesh = TetMesh::default();
    for z in 0..=n {
        for y in 0..=n {
            mesh.points.extend((0..=n).map(|x| [x as f64, y as f64, z as f64]));
        }
    }
    for cube in 0..n * n * n {
        let base = [cube % n, cube / n % n, cube / (n * n)];
        for [i, j, k] in [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]] {
            let mut path = vec![base];
            for axis in [i, j, k] {
                let mut next = path[path.len() - 1];
                next[axis] += 1;
                path.push(next);
            }
            let mut tet: Vec<u32> = path.iter().map(|p| at(p[0], p[1], p[2])).collect();
            if [[0, 1, 2], [1, 2, 0], [2, 0, 1]].contains(&[i, j, k]) {
                mesh.tets.push([tet[0], tet[1], tet[2], tet[3]]);
            } else {
                tet.swap(2, 3);
                mesh.tets.push([tet[0], tet[1], tet[2], tet[3]]);
            }
        }
    }
    link(&mut mesh);
    mesh.input_point_count = mesh.points.len() as u32;
    mesh.tet_region = vec![0; mesh.tets.len()];
    mesh.regions = vec![Region { attribute: 7.5, seed: INVALID, max_volume: None }];
    mesh
}

fn link(mesh: &mut TetMesh) {
    let mut open = BTreeMap::new();
    mesh.neighbors = vec![[INVALID; 4]; mesh.tets.len()];
    for tet in 0..mesh.tets.len() {
        for (side, corners) in FACE_CORNERS.iter().enumerate() {
            let mut key = corners.map(|corner| mesh.tets[tet][corner]);
            key.sort_unstable();
            if let Some((other, back)) = open.insert(key, (tet, side)) {
                mesh.neighbors[tet][side] = other as u32;
                mesh.neighbors[other][back] = tet as u32;
            }
        }
    }
}

fn orient(mesh: &TetMesh, corners: [u32; 4]) -> crate::predicates::Sign {
    let [a, b, c, d] = corners.map(|corner| mesh.points[corner as usize]);
    crate::predicates::orient3d(&a, &b, &c, &d)
}

#[test]
fn the_grid_is_positive() {
    let mesh = grid(2);
    assert!(mesh.tets.iter().all(|&tet| orient(&mesh, tet) == crate::predicates::Sign::Positive));
}

#[test]
fn faces_and_edges_satisfy_euler() {
    for n in 1..4 {
        let mesh = grid(n);
        let (faces, edges) = (Faces::new(&mesh).unwrap(), Edges::new(&mesh).unwrap());
        let count = |n: usize| n as i64;
        let euler = count(mesh.points.len()) - count(edges.edges.len()) + count(faces.faces.len())
            - count(mesh.tets.len());
        assert_eq!(euler, 1);
        let boundary = faces.faces.iter().filter(|face| face.tets[1] == INVALID).count();
        assert_eq!(boundary, 12 * n * n);
    }
}

#[test]
fn faces_look_outward_from_their_first_tetrahedron() {
    let mesh = grid(2);
    let faces = Faces::new(&mesh).unwrap();
    for (index, face) in faces.faces.iter().enumerate() {
        for (tet, outward) in face.tets.iter().zip([true, false]) {
            if *tet == INVALID {
                continue;
            }
            let corners = mesh.tets[*tet as usize];
            let side =
                faces.tet_faces[*tet as usize].iter().position(|&face| face as usize == index).unwrap();
            let [a, b, c] = face.corners;
            let sign = orient(&mesh, [a, b, c, corners[side]]);
            assert_eq!(sign == crate::predicates::Sign::Negative, outward);
        }
    }
}

#[test]
fn subfaces_and_subsegments_are_found_among_faces_and_edges() {
    let mut mesh = grid(1);
    let [a, b, c] = FACE_CORNERS[0].map(|corner| mesh.tets[3][corner]);
    mesh.subfaces.push(Subface { corners: [c, b, a], facet: 4, marker: -9, tets: [mesh.neighbors[3][0], 3] });
    mesh.subsegments.push(Subsegment { ends: [b, a], segment: 2, marker: 11 });
    let (faces, edges) = (Faces::new(&mesh).unwrap(), Edges::new(&mesh).unwrap());
    let marked: Vec<_> = faces.faces.iter().filter(|face| face.subface != INVALID).collect();
    assert_eq!(marked.len(), 1);
    assert_eq!((marked[0].subface, marked[0].marker), (0, -9));
    assert!(
        marked[0].corners.contains(&a) && marked[0].corners.contains(&b) && marked[0].corners.contains(&c)
    );
    let marked: Vec<_> = edges.edges.iter().filter(|edge| edge.subsegment != INVALID).collect();
    assert_eq!(marked.len(), 1);
    assert_eq!((marked[0].ends, marked[0].marker), ([a.min(b), a.max(b)], 11));
    let ends = edges.subface_edges[0].map(|edge| edges.edges[edge as usize].ends);
    assert_eq!(ends, [(c, b), (b, a), (a, c)].map(|(a, b)| [a.min(b), a.max(b)]));
}

#[test]
fn second_order_nodes_sit_in_the_middle_of_the_documented_edges() {
    let mesh = grid(2);
    let edges = Edges::new(&mesh).unwrap();
    let nodes = second_order::nodes(&mesh, &edges).unwrap();
    let orders = [
        (NodeOrder::Vtk, [[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]]),
        (NodeOrder::Gmsh, [[0, 1], [1, 2], [0, 2], [0, 3], [2, 3], [1, 3]]),
        (NodeOrder::Tetgen, [[2, 3], [0, 3], [0, 1], [1, 2], [1, 3], [0, 2]]),
    ];
    for (order, expected) in orders {
        for tet in second_order::tets(&mesh, &edges, order).unwrap() {
            for (slot, [a, b]) in expected.into_iter().enumerate() {
                let node = nodes[tet[4 + slot] as usize - mesh.points.len()];
                let [a, b] = [a, b].map(|end: usize| mesh.points[tet[end] as usize]);
                assert_eq!(node, [0, 1, 2].map(|axis| (a[axis] + b[axis]) / 2.0));
            }
        }
    }
}

#[test]
fn point_tets_names_the_first_tetrahedron_or_none() {
    let mut mesh = grid(2);
    mesh.points.push([9.0; 3]);
    let first = point_tets(&mesh).unwrap();
    assert_eq!(first[mesh.points.len() - 1], INVALID);
    for (point, &tet) in first[..mesh.points.len() - 1].iter().enumerate() {
        let expected = mesh.tets.iter().position(|corners| corners.contains(&(point as u32)));
        assert_eq!(Some(tet as usize), expected);
    }
    assert_eq!(tet_attributes(&mesh).unwrap(), vec![7.5; mesh.tets.len()]);
}

#[test]
fn locate_agrees_with_a_search_of_all_tetrahedra() {
    let mesh = grid(3);
    let locator = Locator::new(&mesh).unwrap();
    // Sixths of units: grid points, points on edges, on faces, on diagonals, inside, and outside.
    let mut points = Vec::new();
    for index in 0..23 * 23 * 23 {
        let step = |i: usize| (i % 23) as f64 / 6.0 - 0.25 * 2.0 / 3.0;
        points.push([step(index), step(index / 23), step(index / 529)]);
    }
    let mut tets = vec![0; points.len()];
    let mut weights = vec![[0.0; 4]; points.len()];
    locator.locate(&mesh, &points, &mut tets, Some(&mut weights));
    for ((point, &tet), weights) in points.iter().zip(&tets).zip(&weights) {
        let holds = |corners: &[u32; 4]| {
            let at = corners.map(|corner| mesh.points[corner as usize]);
            FACE_CORNERS.iter().all(|&[a, b, c]| {
                crate::predicates::orient3d(&at[a], &at[b], &at[c], point)
                    != crate::predicates::Sign::Positive
            })
        };
        let expected = mesh.tets.iter().position(holds).map_or(INVALID, |tet| tet as u32);
        assert_eq!(tet, expected, "{point:?}");
        if tet == INVALID {
            assert!(weights.iter().all(|weight| weight.is_nan()));
            continue;
        }
        assert!(weights.iter().all(|&weight| weight >= 0.0));
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-15);
        for (axis, x) in point.iter().enumerate() {
            let corners = mesh.tets[tet as usize];
            let sum: f64 = (0..4).map(|i| weights[i] * mesh.points[corners[i] as usize][axis]).sum();
            assert!((sum - x).abs() < 1e-13);
        }
    }
    assert!(tets.contains(&INVALID) && tets.iter().any(|&tet| tet != INVALID));
}

#[test]
fn locate_works_at_every_scale() {
    for exponent in [-900, -300, 0, 300, 900] {
        let mut mesh = grid(2);
        let factor = 2.0f64.powi(exponent);
        mesh.points.iter_mut().flatten().for_each(|x| *x *= factor);
        let locator = Locator::new(&mesh).unwrap();
        let mut tets = [0; 3];
        let mut weights = [[0.0; 4]; 3];
        let points =
            [[0.7, 0.2, 0.1], [1.0, 1.0, 1.0], [2.5, 1.0, 1.0]].map(|p: [f64; 3]| p.map(|x| x * factor));
        locator.locate(&mesh, &points, &mut tets, Some(&mut weights));
        assert_ne!(tets[0], INVALID);
        assert_eq!(tets[1..], [0, INVALID]);
        assert_eq!(weights[1].iter().filter(|&&weight| weight == 1.0).count(), 1);
    }
}

#[test]
fn locate_in_nothing_finds_nothing() {
    let mesh = TetMesh::default();
    let mut tets = [5];
    Locator::new(&mesh).unwrap().locate(&mesh, &[[0.0; 3]], &mut tets, None);
    assert_eq!(tets, [INVALID]);
    let mut tets = [5, 5];
    let mesh = grid(1);
    Locator::new(&mesh).unwrap().locate(&mesh, &[[f64::NAN; 3], [f64::INFINITY; 3]], &mut tets, None);
    assert_eq!(tets, [INVALID; 2]);
}

#[test]
fn point_data_continues_to_steiner_points() {
    let plc = Plc {
        points: vec![[0.0; 3], [4.0, 0.0, 0.0]],
        point_attribute_count: 2,
        point_attributes: vec![1.0, 10.0, 3.0, 30.0],
        point_markers: vec![5, 6],
        segments: vec![Segment { ends: [0, 1], marker: 42 }],
        ..Plc::default()
    };
    let mesh = TetMesh {
        points: vec![[0.0; 3], [4.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]],
        input_point_count: 2,
        steiner: vec![
            SteinerPoint { ends: [0, 1], t: 0.25, segment: 0, exact: true, ..SteinerPoint::INSIDE },
            SteinerPoint { ends: [1, 0], t: 0.5, segment: INVALID, exact: true, ..SteinerPoint::INSIDE },
        ],
        ..TetMesh::default()
    };
    let data = PointData::new(&plc, &mesh).unwrap();
    assert_eq!(data.attributes, [1.0, 10.0, 3.0, 30.0, 1.5, 15.0, 2.0, 20.0]);
    assert_eq!(data.markers, [5, 6, 42, 0]);
}

/// An octahedron around two points inside, one of which needs the other's value.
#[test]
fn linear_attributes_are_met_inside() {
    let mut points = vec![
        [2.0, 0.0, 0.0],
        [-2.0, 0.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, -2.0, 0.0],
        [0.0, 0.0, 2.0],
        [0.0, 0.0, -2.0],
    ];
    let field = |p: &[f64; 3]| [3.0 + p[0] - 2.0 * p[1] + 5.0 * p[2], 7.0];
    let plc = Plc {
        point_attribute_count: 2,
        point_attributes: points.iter().flat_map(field).collect(),
        point_markers: vec![9; 6],
        points: points.clone(),
        ..Plc::default()
    };
    points.extend([[0.5, 0.25, 0.125], [0.75, 0.5, 0.625]]);
    // The first point with all sides but one, where the second one lies between.
    let mut tets = Vec::new();
    for (x, y, z) in (0..8).map(|i| (i & 1, 2 + (i >> 1 & 1), 4 + (i >> 2))) {
        match (x, y, z) {
            (0, 2, 4) => tets.extend([[7, x, y, z], [7, 6, x, y], [7, 6, y, z], [7, 6, x, z]]),
            _ => tets.push([6, x, y, z]),
        }
    }
    let mesh = TetMesh {
        points,
        input_point_count: 6,
        tets,
        steiner: vec![SteinerPoint::INSIDE; 2],
        ..TetMesh::default()
    };
    let data = PointData::new(&plc, &mesh).unwrap();
    assert_eq!(data.markers[6..], [0, 0]);
    for (point, found) in mesh.points.iter().zip(data.attributes.chunks(2)) {
        for (wanted, found) in field(point).iter().zip(found) {
            assert!((wanted - found).abs() < 1e-14, "{point:?}: {found} instead of {wanted}");
        }
    }
}

#[test]
fn attributes_inside_without_enough_neighbours_still_come_from_them() {
    let plc = Plc {
        points: vec![[0.0; 3]],
        point_attribute_count: 1,
        point_attributes: vec![4.0],
        ..Plc::default()
    };
    let points = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [9.0, 9.0, 9.0]];
    let steiner = vec![SteinerPoint::INSIDE; 4];
    let mesh =
        TetMesh { points, input_point_count: 1, tets: vec![[0, 1, 2, 3]], steiner, ..TetMesh::default() };
    assert_eq!(PointData::new(&plc, &mesh).unwrap().attributes, [4.0, 4.0, 4.0, 4.0, 0.0]);
}
