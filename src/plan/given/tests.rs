//! Arrays that are a mesh, arrays that are none, and what refining and improving keep.
use super::*;
use crate::check::{check_mesh, check_preserved};
use crate::error::{DefectKind, Element};
use crate::fill::tests::grid_box;
use crate::output::{Guarantee, SteinerPoint};
use crate::plc::{Plc, RegionSeed, Segment};
use crate::{tetrahedralize, CancelToken, Mode, INVALID};

fn arrays(points: &[[f64; 3]], tets: &[[u32; 4]]) -> MeshArrays {
    MeshArrays { points: points.to_vec(), tets: tets.to_vec(), ..MeshArrays::default() }
}

fn made(arrays: &MeshArrays) -> TetMesh {
    mesh_from_arrays(arrays.clone(), 100).unwrap_or_else(|e| panic!("{e}: {:?}", e.defects))
}

fn refused(arrays: &MeshArrays) -> Error {
    mesh_from_arrays(arrays.clone(), 100).expect_err("no mesh")
}

/// What a mesh is in arrays.
fn arrays_of(mesh: &TetMesh) -> MeshArrays {
    MeshArrays {
        points: mesh.points.clone(),
        input_point_count: None,
        tets: mesh.tets.clone(),
        attributes: mesh.tet_region.iter().map(|&r| mesh.regions[r as usize].attribute).collect(),
        faces: mesh.subfaces.iter().map(|face| face.corners).collect(),
        face_markers: mesh.subfaces.iter().map(|face| face.marker).collect(),
        edges: mesh.subsegments.iter().map(|edge| edge.ends).collect(),
        edge_markers: mesh.subsegments.iter().map(|edge| edge.marker).collect(),
    }
}

/// The surface of a mesh as an input, facet by facet as its subfaces name them.
fn surface_of(mesh: &TetMesh) -> Plc {
    let mut plc = Plc { points: mesh.points[..mesh.input_point_count as usize].to_vec(), ..Plc::default() };
    let mut faces: Vec<_> = mesh.subfaces.iter().collect();
    faces.sort_by_key(|face| face.facet);
    for face in faces {
        assert_eq!(face.facet as usize, plc.triangles.len());
        plc.triangles.push(face.corners);
        plc.triangle_markers.push(face.marker);
    }
    for edge in &mesh.subsegments {
        assert_eq!(edge.segment as usize, plc.segments.len());
        plc.segments.push(Segment { ends: edge.ends, marker: edge.marker });
    }
    plc
}

/// A box of n³ cubes, of six tetrahedra each, around one diagonal.
fn grid(n: u32) -> MeshArrays {
    let at = |x: u32, y: u32, z: u32| x + (n + 1) * (y + (n + 1) * z);
    let mut mesh = MeshArrays::default();
    for z in 0..=n {
        for y in 0..=n {
            for x in 0..=n {
                mesh.points.push([x, y, z].map(f64::from));
            }
        }
    }
    for i in 0..n * n * n {
        let cell = [i % n, i / n % n, i / n / n];
        for axes in [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]] {
            let mut at_corner = cell;
            let mut tet = [at(cell[0], cell[1], cell[2]); 4];
            for (k, axis) in axes.into_iter().enumerate() {
                at_corner[axis] += 1;
                tet[k + 1] = at(at_corner[0], at_corner[1], at_corner[2]);
            }
            mesh.tets.push(tet);
        }
    }
    mesh
}

const CORNERS: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// A box with a wall, a region seed and an inner segment, in a mode.
fn model(mode: Mode) -> (Plc, TetMesh) {
    let mut plc = Plc::default();
    for x in [0.0, 1.0, 2.0] {
        plc.points.extend([[x, 0.0, 0.0], [x, 1.0, 0.0], [x, 1.0, 1.0], [x, 0.0, 1.0]]);
    }
    plc.points.extend([[0.3, 0.4, 0.5], [0.6, 0.5, 0.4]]);
    for (i, x) in [0u32, 4, 8].into_iter().enumerate() {
        for corners in [[0, 1, 2], [0, 2, 3]] {
            plc.triangles.push(corners.map(|v| v + x));
            plc.triangle_markers.push(i as i32 + 1);
        }
    }
    for x in [0u32, 4] {
        for k in 0..4 {
            let (a, b) = (x + k, x + (k + 1) % 4);
            for corners in [[a, b, b + 4], [a, b + 4, a + 4]] {
                plc.triangles.push(corners);
                plc.triangle_markers.push(7);
            }
        }
    }
    plc.segments.push(Segment { ends: [12, 13], marker: 5 });
    plc.regions.push(RegionSeed { point: [1.5, 0.5, 0.5], attribute: 9.0, max_volume: Some(0.05) });
    let mesh = tetrahedralize(&plc, &Options { mode, ..Options::default() }, &mut Silent).unwrap();
    (plc, mesh)
}

fn volume(mesh: &TetMesh) -> f64 {
    let of = |tet: &[u32; 4]| crate::size::volume([0, 1, 2, 3].map(|k| &mesh.points[tet[k] as usize]));
    mesh.tets.iter().map(of).sum()
}

/// The sine of the worst dihedral angle.
fn worst(mesh: &TetMesh) -> f64 {
    let of = |tet: &[u32; 4]| crate::ops::shape::sine([0, 1, 2, 3].map(|k| &mesh.points[tet[k] as usize]));
    mesh.tets.iter().map(of).fold(f64::INFINITY, f64::min)
}

/// What must be the same in a mesh and what was made of it.
fn keeps(before: &TetMesh, after: &TetMesh) {
    let inputs = before.input_point_count as usize;
    assert_eq!(after.input_point_count as usize, inputs);
    assert_eq!(after.points[..inputs], before.points[..inputs]);
    assert_eq!(after.regions, before.regions);
    let faces = |mesh: &TetMesh| -> Vec<_> {
        let region = |t: u32| mesh.tet_region.get(t as usize).copied();
        let key = |face: &crate::Subface| {
            let mut corners = face.corners;
            corners.sort_unstable();
            (corners, face.facet, face.marker, face.tets.map(region))
        };
        mesh.subfaces.iter().map(key).collect()
    };
    assert_eq!(faces(after), faces(before));
    assert_eq!(after.subsegments, before.subsegments);
    assert!((volume(after) / volume(before) - 1.0).abs() < 1e-12);
    for region in 0..before.regions.len() as u32 {
        let of = |mesh: &TetMesh| {
            let part = TetMesh {
                tets: (0..mesh.tets.len())
                    .filter(|&t| mesh.tet_region[t] == region)
                    .map(|t| mesh.tets[t])
                    .collect(),
                points: mesh.points.clone(),
                ..TetMesh::default()
            };
            volume(&part)
        };
        assert!((of(after) - of(before)).abs() <= 1e-12 * volume(before), "region {region}");
    }
}

#[test]
fn arrays_become_a_mesh() {
    let mut given = arrays(&CORNERS, &[[0, 1, 3, 2]]);
    given.points.push([5.0; 3]);
    let mesh = made(&given);
    assert_eq!(mesh.tets, [[0, 1, 2, 3]], "turned positive");
    assert_eq!(mesh.neighbors, [[INVALID; 4]]);
    assert_eq!((mesh.input_point_count, &mesh.unmeshed_points[..]), (5, &[4][..]));
    assert_eq!(mesh.subfaces.len(), 4);
    assert!(mesh.subfaces.iter().all(|face| face.marker == 0 && face.tets == [0, INVALID]));
    assert_eq!((mesh.regions.len(), mesh.regions[0].attribute), (1, 1.0));
    assert_eq!(mesh.guarantee, Guarantee::Given);
    check_mesh(&surface_of(&mesh), &mesh, false, 10).unwrap();
    check_preserved(&surface_of(&mesh), &mesh, 10).unwrap();
}

#[test]
fn regions_faces_and_edges() {
    let mut given = grid(3);
    given.attributes = (0..given.tets.len()).map(|t| f64::from(u8::from(t >= 6 * 9))).collect();
    given.faces = vec![[0, 1, 5], [0, 1, 21]];
    given.face_markers = vec![3, 4];
    given.edges = vec![[42, 21], [0, 1], [21, 42]];
    given.edge_markers = vec![8, 9, 10];
    let mesh = made(&given);
    assert_eq!(mesh.regions.iter().map(|r| r.attribute).collect::<Vec<_>>(), [0.0, 1.0]);
    // Two faces of a cube's surface for each square: the boundary, the wall, and the face inside.
    assert_eq!(mesh.subfaces.len(), 2 * 9 * 7 + 1);
    assert_eq!((mesh.subfaces[0].marker, mesh.subfaces[1].marker, mesh.subfaces[2].marker), (3, 4, 0));
    assert_eq!(mesh.subfaces[1].tets.iter().filter(|&&t| t == INVALID).count(), 0);
    let ends: Vec<_> = mesh.subsegments.iter().map(|edge| (edge.ends, edge.segment, edge.marker)).collect();
    assert_eq!(ends, [([42, 21], 0, 8), ([0, 1], 1, 9)]);
    check_mesh(&surface_of(&TetMesh { ..mesh.clone() }), &mesh, false, 10).unwrap();
}

#[test]
fn equal_points_are_one() {
    let mut given = arrays(&CORNERS, &[[0, 1, 2, 3], [4, 5, 6, 7]]);
    given.points.extend([CORNERS[1], CORNERS[2], CORNERS[3], [1.0; 3]]);
    let mesh = made(&given);
    assert_eq!(mesh.neighbors, [[1, INVALID, INVALID, INVALID], [INVALID, INVALID, INVALID, 0]]);
    assert_eq!(mesh.point_alias, [0, 1, 2, 3, 1, 2, 3, 7]);
    assert_eq!(mesh.unmeshed_points, [4, 5, 6]);
}

/// Four tetrahedra around an edge, with gaps between; two that share a vertex; two apart; one in the hole of others.
#[test]
fn domains_may_touch() {
    let star = |wanted: &[[usize; 2]]| {
        let mut points = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        points.extend((0..8).map(|i| {
            let [x, y] = [
                [2.0, 0.0],
                [2.0, 2.0],
                [0.0, 2.0],
                [-2.0, 2.0],
                [-2.0, 0.0],
                [-2.0, -2.0],
                [0.0, -2.0],
                [2.0, -2.0],
            ][i];
            [x, y, 0.0]
        }));
        let tets: Vec<_> = wanted.iter().map(|&[i, j]| [0, 1, 2 + i as u32, 2 + j as u32]).collect();
        // Those that are not used must not lie on faces: a check against the input would miss them there.
        let unused = |v: &usize| !tets.iter().flatten().any(|&w| w as usize == *v);
        (2..10).filter(unused).for_each(|v| points[v][2] = 50.0);
        arrays(&points, &tets)
    };
    for fans in [
        &[[0, 1], [2, 3], [4, 5], [6, 7]][..],
        &[[4, 5], [0, 1]],
        &[[1, 2], [2, 3], [5, 7]],
        &[[0, 3], [4, 7]],
    ] {
        let mesh = made(&star(fans));
        check_mesh(&surface_of(&mesh), &mesh, false, 10).unwrap();
        let options = Options { size: Some(0.7), optimize: 1, ..Options::default() };
        let fine = refine(&mesh, &MeshSizes::default(), &options, &mut Silent).unwrap();
        keeps(&mesh, &fine);
        check_mesh(&surface_of(&mesh), &fine, false, 10).unwrap();
    }
    // The first overlaps, or its face is on another's.
    for fans in
        [&[[0, 2], [1, 3]][..], &[[0, 3], [1, 2]], &[[0, 3], [3, 6], [6, 1]], &[[0, 3], [2, 5], [6, 7]]]
    {
        let error = refused(&star(fans));
        assert_eq!((error.status, error.defects[0].kind), (Status::CheckFailed, DefectKind::NotConforming));
    }
    let mut vertex = arrays(&CORNERS, &[[0, 1, 2, 3], [0, 4, 5, 6]]);
    vertex.points.extend([[-1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]]);
    let mesh = made(&vertex);
    assert_eq!(mesh.regions.len(), 2);
    let options = Options { size: Some(0.3), optimize: 1, ..Options::default() };
    let fine = refine(&mesh, &MeshSizes::default(), &options, &mut Silent).unwrap();
    keeps(&mesh, &fine);
    assert!(fine.tets.len() > 2);
    check_mesh(&surface_of(&mesh), &fine, false, 10).unwrap();
}

#[test]
fn a_hollow_and_a_ring_around_it() {
    let mut given = grid(3);
    // Without the cube in the middle.
    given.tets.drain(6 * 13..6 * 14);
    let mesh = made(&given);
    assert_eq!(mesh.subfaces.len(), 2 * 9 * 6 + 12);
    let options = Options { size: Some(0.5), quality: Some(2.0), ..Options::default() };
    let fine = refine(&mesh, &MeshSizes::default(), &options, &mut Silent).unwrap();
    keeps(&mesh, &fine);
    assert!(fine.tets.len() > mesh.tets.len());
    check_mesh(&surface_of(&mesh), &fine, false, 10).unwrap();
}

/// A ring of tetrahedra that goes round its edge twice: every face has two sides, and all are positive.
#[test]
fn a_ring_that_goes_round_twice_is_refused() {
    let mut points = vec![[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    // A star of five points: each step is 144 degrees.
    let circle = [[100.0, 0.0], [31.0, 95.0], [-81.0, 59.0], [-81.0, -59.0], [31.0, -95.0]];
    points.extend((0..5).map(|i| [circle[2 * i % 5][0], circle[2 * i % 5][1], 0.0]));
    let tets: Vec<_> = (0..5).map(|i| [0, 1, 2 + i, 2 + (i + 1) % 5]).collect();
    let error = refused(&arrays(&points, &tets));
    assert_eq!((error.status, error.defects[0].kind), (Status::CheckFailed, DefectKind::NotConforming));
    // The same in order is a mesh; and a second ring or a fan at its edge is too much.
    points.truncate(2);
    points.extend(circle.map(|[x, y]| [x, y, 0.0]));
    made(&arrays(&points, &tets));
    let count = points.len() as u32;
    points.extend(circle.map(|[x, y]| [2.0 * x, 2.0 * y, 0.5]));
    let more: Vec<_> = (0..5).map(|i| [0, 1, count + i, count + (i + 1) % 5]).collect();
    for extra in [5, 2] {
        let both: Vec<_> = tets.iter().chain(&more[..extra]).copied().collect();
        assert_eq!(refused(&arrays(&points, &both)).status, Status::CheckFailed);
    }
}

#[test]
fn what_is_no_mesh_is_refused() {
    let base = arrays(&CORNERS, &[[0, 1, 2, 3]]);
    let fault = |change: &dyn Fn(&mut MeshArrays)| {
        let mut given = base.clone();
        change(&mut given);
        let error = refused(&given);
        (error.status, error.defects.first().map(|d| (d.kind, d.first, d.second)))
    };
    let tet = |t| Element::Tet(t);
    assert_eq!(fault(&|m| m.tets.clear()), (Status::InvalidArgument, None));
    assert_eq!(fault(&|m| m.points.clear()).0, Status::IndexOutOfRange);
    assert_eq!(
        fault(&|m| m.points[2][1] = f64::NAN),
        (Status::NonFinitePoint, Some((DefectKind::NonFinite, Element::Point(2), None)))
    );
    assert_eq!(fault(&|m| m.points[2][1] = f64::INFINITY).0, Status::NonFinitePoint);
    assert_eq!(fault(&|m| m.points[2] = [1e300, 1e-300, 0.0]).0, Status::CoordinateRange);
    assert_eq!(
        fault(&|m| m.tets.push([0, 1, 2, 9])),
        (Status::IndexOutOfRange, Some((DefectKind::IndexOutOfRange, tet(1), Some(Element::Point(9)))))
    );
    for bad in [[0, 1, 1, 2], [0, 1, 2, 4]] {
        let flat = fault(&|m| {
            m.points.push([0.5, 0.5, 0.0]);
            m.tets.push(bad);
        });
        assert_eq!(flat, (Status::CheckFailed, Some((DefectKind::NotPositive, tet(1), None))));
    }
    // The same twice; another on the same side; a third at a face.
    for bad in [&[[0, 2, 1, 3]][..], &[[1, 2, 3, 4]], &[[1, 2, 3, 5], [1, 2, 3, 6]]] {
        let found = fault(&|m| {
            m.points.extend([[0.1; 3], [1.0; 3], [2.0; 3]]);
            m.tets.extend(bad);
        });
        assert_eq!(found, (Status::CheckFailed, Some((DefectKind::NotConforming, tet(0), Some(tet(1))))));
    }
    let missing = (DefectKind::FacetMissing, Element::Facet(1), None);
    for bad in [[0, 1, 7], [0, 1, 1], [0, 0, 0], [u32::MAX; 3]] {
        assert_eq!(fault(&|m| m.faces = vec![[0, 1, 2], bad]), (Status::CheckFailed, Some(missing)));
    }
    let missing = (DefectKind::SegmentMissing, Element::Segment(1), None);
    for bad in [[0, 4], [0, 0], [0, 99], [u32::MAX; 2]] {
        let found = fault(&|m| {
            m.points.push([5.0; 3]);
            m.edges = vec![[0, 1], bad];
        });
        assert_eq!(found, (Status::CheckFailed, Some(missing)));
    }
    assert_eq!(fault(&|m| m.attributes = vec![1.0; 2]).0, Status::InvalidArgument);
    assert_eq!(fault(&|m| m.attributes = vec![f64::NAN]).0, Status::InvalidArgument);
    assert_eq!(fault(&|m| m.face_markers = vec![1]).0, Status::InvalidArgument);
    assert_eq!(fault(&|m| m.edge_markers = vec![1]).0, Status::InvalidArgument);
}

#[test]
fn only_so_many_defects_are_listed() {
    let tets: Vec<_> = (0..50).map(|_| [0, 1, 2, 2]).collect();
    let error = mesh_from_arrays(arrays(&CORNERS, &tets), 7).expect_err("flat");
    assert_eq!((error.defects.len(), error.defect_count), (7, 50));
}

#[test]
fn our_meshes_come_back_from_arrays() {
    for mode in [Mode::Constrained, Mode::Preserve] {
        let (_, mesh) = model(mode);
        let again = made(&arrays_of(&mesh));
        assert_eq!(
            (&again.points, &again.tets, &again.neighbors),
            (&mesh.points, &mesh.tets, &mesh.neighbors)
        );
        let attribute = |m: &TetMesh| -> Vec<f64> {
            m.tet_region.iter().map(|&r| m.regions[r as usize].attribute).collect()
        };
        assert_eq!(attribute(&again), attribute(&mesh));
        // Which side comes first depends on the numbers of regions.
        let sorted = |mut tets: [u32; 2], mut corners: [u32; 3]| {
            tets.sort_unstable();
            corners.sort_unstable();
            (tets, corners)
        };
        let faces = |m: &TetMesh| -> Vec<_> {
            m.subfaces.iter().map(|f| (sorted(f.tets, f.corners), f.marker)).collect()
        };
        assert_eq!(faces(&again), faces(&mesh));
        let edges = |m: &TetMesh| -> Vec<_> { m.subsegments.iter().map(|e| (e.ends, e.marker)).collect() };
        assert_eq!(edges(&again), edges(&mesh));
    }
}

#[test]
fn refining_keeps_what_is_kept() {
    for mode in [Mode::Constrained, Mode::Preserve] {
        let (plc, mesh) = model(mode);
        let mut tets = vec![f64::INFINITY; mesh.tets.len()];
        tets[0] = 0.1;
        let mut points = vec![f64::INFINITY; mesh.points.len()];
        points[5] = 0.1;
        let parts = |change: &dyn Fn(&mut Sizes)| {
            let mut parts = Sizes::default();
            change(&mut parts);
            MeshSizes { parts, ..MeshSizes::default() }
        };
        let none = MeshSizes::default();
        let some = || Options { size: Some(0.3), ..Options::default() };
        let runs: [(MeshSizes, Options); 9] = [
            (none.clone(), some()),
            (none.clone(), Options { max_volume: Some(0.004), ..Options::default() }),
            (none.clone(), Options { quality: Some(1.6), optimize: 1, ..Options::default() }),
            (
                none,
                Options { size_function: Some(crate::SizeFunction::new(|[x, ..]| Ok(0.1 + x))), ..some() },
            ),
            (MeshSizes { tets, ..MeshSizes::default() }, Options { gradation: 0.5, ..Options::default() }),
            (parts(&|s| s.points = points.clone()), Options::default()),
            (parts(&|s| s.set_facets(2, 0.1).unwrap()), Options::default()),
            (parts(&|s| s.set_facet_areas(2, 0.004).unwrap()), Options::default()),
            (
                parts(&|s| {
                    s.set_segments(5, 0.1).unwrap();
                    s.set_regions(9.0, 0.2).unwrap();
                }),
                Options::default(),
            ),
        ];
        for (i, (sizes, options)) in runs.iter().enumerate() {
            let fine = refine(&mesh, sizes, options, &mut Silent).unwrap_or_else(|e| panic!("{i}: {e}"));
            assert!(fine.points.len() > mesh.points.len(), "{mode:?} {i}");
            keeps(&mesh, &fine);
            check_mesh(&plc, &fine, false, 10).unwrap_or_else(|e| panic!("{i}: {e}: {:?}", e.defects));
            if mode == Mode::Preserve {
                check_preserved(&plc, &fine, 10).unwrap();
                assert_eq!(fine.guarantee, Guarantee::Preserved);
            }
            assert_eq!(
                fine,
                TetMesh {
                    statistics: fine.statistics.clone(),
                    ..refine(&mesh, sizes, options, &mut Silent).unwrap()
                }
            );
            // And again, from what has come out.
            let finer = refine(
                &fine,
                &MeshSizes::default(),
                &Options { size: Some(0.25), ..Options::default() },
                &mut Silent,
            )
            .unwrap();
            keeps(&fine, &finer);
            check_mesh(&plc, &finer, false, 10).unwrap();
            let better = improve(&finer, &Options::default(), &mut Silent).unwrap();
            keeps(&finer, &better);
            assert!(worst(&better) >= worst(&finer));
            check_mesh(&plc, &better, false, 10).unwrap();
        }
    }
}

#[test]
fn sizes_are_reached_where_they_are_wanted() {
    let mesh = made(&grid(4));
    let mut points = vec![f64::INFINITY; mesh.points.len()];
    let middle = mesh.points.iter().position(|p| *p == [2.0; 3]).unwrap();
    points[middle] = 0.1;
    let sizes = MeshSizes { parts: Sizes { points, ..Sizes::default() }, ..MeshSizes::default() };
    let fine = refine(&mesh, &sizes, &Options::default(), &mut Silent).unwrap();
    let near = |v: u32| fine.points[v as usize].map(|x| (x - 2.0).abs()).iter().sum::<f64>() < 0.2;
    let longest = fine.tets.iter().filter(|tet| tet.iter().any(|&v| near(v))).flat_map(|tet| {
        let at = tet.map(|v| fine.points[v as usize]);
        (0..4).flat_map(move |i| (0..i).map(move |j| crate::size::distance(&at[i], &at[j])))
    });
    assert!(longest.fold(0.0, f64::max) < 0.5);
    // Far from there nothing was wanted beyond what the surface wants.
    assert!(fine.points.len() < 2000, "{}", fine.points.len());
}

#[test]
fn points_inside_may_move_if_they_are_no_input() {
    let mut given = grid(2);
    // The middle, far off its best place, is the last point.
    let middle = given.points.len() as u32 / 2;
    let last = given.points.len() as u32 - 1;
    given.points.swap(middle as usize, last as usize);
    given.points[last as usize] = [1.3, 1.2, 0.9];
    for v in given.tets.iter_mut().flatten() {
        *v = if *v == middle {
            last
        } else if *v == last {
            middle
        } else {
            *v
        };
    }
    let fixed = made(&given);
    let free = made(&MeshArrays { input_point_count: Some(0), ..given.clone() });
    assert_eq!((fixed.input_point_count, free.input_point_count), (27, 26));
    assert_eq!(free.steiner, [SteinerPoint::INSIDE]);
    let better = improve(&free, &Options::default(), &mut Silent).unwrap();
    keeps(&free, &better);
    assert!(better.points[26..] != free.points[26..]);
    assert!(worst(&better) >= worst(&free));
    let kept = improve(&fixed, &Options::default(), &mut Silent).unwrap();
    keeps(&fixed, &kept);
    assert_eq!(kept.points[26], [1.3, 1.2, 0.9]);
}

#[test]
fn nonsense_is_refused() {
    let mesh = made(&grid(1));
    let run = |sizes: MeshSizes, options: Options| {
        refine(&mesh, &sizes, &options, &mut Silent).map_err(|e| e.status)
    };
    let bad = Err(Status::InvalidArgument);
    let none = MeshSizes::default;
    assert_eq!(run(none(), Options { size: Some(-1.0), ..Options::default() }), bad);
    assert_eq!(run(none(), Options { gradation: 2.0, ..Options::default() }), bad);
    assert_eq!(run(MeshSizes { tets: vec![1.0], ..none() }, Options::default()), bad);
    assert_eq!(run(MeshSizes { tets: vec![0.0; 6], ..none() }, Options::default()), bad);
    let parts = Sizes { points: vec![f64::NAN; 8], ..Sizes::default() };
    assert_eq!(run(MeshSizes { parts, ..none() }, Options::default()), bad);
    let tiny = Options { size: Some(1e-5), ..Options::default() };
    assert_eq!(run(none(), tiny), Err(Status::TooLarge));
    let few = Options { size: Some(0.1), steiner_limit: Some(10), ..Options::default() };
    assert_eq!(run(none(), few), Err(Status::SteinerLimit));
    let few = Options { size: Some(0.1), tetrahedra_limit: Some(100), ..Options::default() };
    assert_eq!(run(none(), few), Err(Status::TetrahedraLimit));
    let few = Options { tetrahedra_limit: Some(1), ..Options::default() };
    assert_eq!(run(none(), few), Err(Status::TetrahedraLimit));
    // Nothing is wanted: the same mesh.
    let same = refine(&mesh, &none(), &Options::default(), &mut Silent).unwrap();
    assert_eq!(TetMesh { statistics: mesh.statistics.clone(), ..same }, mesh);
}

/// A mesh that a caller has changed is checked like arrays.
#[test]
fn a_damaged_mesh_is_refused() {
    let (_, mesh) = model(Mode::Preserve);
    let run = |change: &dyn Fn(&mut TetMesh)| {
        let mut bad = mesh.clone();
        change(&mut bad);
        improve(&bad, &Options::default(), &mut Silent).err().map(|e| e.status)
    };
    assert_eq!(run(&|_| {}), None);
    assert_eq!(run(&|m| m.tets[0][1] = 99999), Some(Status::IndexOutOfRange));
    assert_eq!(run(&|m| m.tets.truncate(1)), Some(Status::InvalidArgument));
    assert_eq!(run(&|m| m.tet_region[0] = 99), Some(Status::IndexOutOfRange));
    assert_eq!(run(&|m| m.subfaces[0].corners[0] = 99999), Some(Status::IndexOutOfRange));
    assert_eq!(run(&|m| m.subfaces[0].corners = [12, 12, 0]), Some(Status::CheckFailed));
    assert_eq!(run(&|m| m.subsegments[0].ends[0] = 99999), Some(Status::IndexOutOfRange));
    assert_eq!(run(&|m| m.steiner.push(SteinerPoint::INSIDE)), Some(Status::InvalidArgument));
    assert_eq!(run(&|m| m.input_point_count = 99999), Some(Status::InvalidArgument));
    assert_eq!(run(&|m| m.points[0] = m.points[2]), Some(Status::CheckFailed));
    assert_eq!(run(&|m| m.point_alias.clear()), None);
}

#[test]
fn a_mesh_far_from_one_in_size() {
    for scale in [1e-200, 1e150] {
        let mut given = grid(2);
        given.points.iter_mut().flatten().for_each(|x| *x *= scale);
        let mesh = made(&given);
        let options = Options { size: Some(0.6 * scale), optimize: 1, ..Options::default() };
        let fine = refine(&mesh, &MeshSizes::default(), &options, &mut Silent).unwrap();
        assert!(fine.points.len() > mesh.points.len());
        check_mesh(&surface_of(&mesh), &fine, false, 10).unwrap();
        assert_eq!(fine.points[..27], mesh.points[..]);
    }
}

/// Breaks at the n-th call.
struct Breaks(usize);

impl Observer for Breaks {
    fn progress(&mut self, _: Phase, _: f64) -> std::ops::ControlFlow<()> {
        if self.0 == 0 {
            return std::ops::ControlFlow::Break(());
        }
        self.0 -= 1;
        std::ops::ControlFlow::Continue(())
    }
}

#[test]
fn a_run_can_be_cancelled_at_any_report() {
    let (_, mesh) = model(Mode::Preserve);
    let options = Options { size: Some(0.4), optimize: 1, ..Options::default() };
    let mut ended = 0;
    for n in 0.. {
        match refine(&mesh, &MeshSizes::default(), &options, &mut Breaks(n)) {
            Err(e) => assert_eq!(e.status, Status::Cancelled),
            Ok(_) => break,
        }
        ended += 1;
    }
    assert!(ended > 5);
    let cancel = CancelToken::new();
    cancel.cancel();
    let options = Options { cancel: Some(cancel), ..Options::default() };
    assert_eq!(improve(&mesh, &options, &mut Silent).map_err(|e| e.status), Err(Status::Cancelled));
}

/// What refining and improving count are the points that come and go.
#[test]
fn statistics_of_given_meshes_add_up() {
    let plc = grid_box(3);
    let mesh =
        tetrahedralize(&plc, &Options { mode: Mode::Preserve, ..Options::default() }, &mut Silent).unwrap();
    let options = Options { size: Some(0.5), max_volume: Some(0.02), ..Options::default() };
    let fine = refine(&mesh, &MeshSizes::default(), &options, &mut Silent).unwrap();
    let counts = &fine.statistics.refine;
    let before = mesh.steiner.len() as u64;
    assert!(counts.inside > 0 && counts.inside == counts.points(), "{counts:?}");
    assert_eq!(fine.steiner.len() as u64, before + counts.inside);
    assert_eq!((fine.statistics.optimize, fine.ratio), (Default::default(), None));
    let options = Options { optimize: 2, ..Options::default() };
    let good = improve(&fine, &options, &mut Silent).unwrap();
    let done = &good.statistics.optimize;
    assert_eq!(
        good.steiner.len() as u64 + done.points_removed,
        fine.steiner.len() as u64 + done.points_added
    );
    assert!(done.moves > 0 && done.worst_after >= done.worst_before, "{done:?}");
    assert_eq!(good.statistics.refine, Default::default());
}
