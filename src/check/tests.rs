//! Hand-made meshes, all valid; then each kind of defect, made by one change to a valid mesh, must be found.
use crate::check::{check_mesh, check_preserved, check_preserved_outer};
use crate::error::{DefectKind, Error, Status};
use crate::output::{Guarantee, Region, SteinerPoint, SteinerTerm, Subface, Subsegment, TetMesh};
use crate::plc::{Facet, Plc, Segment};
use crate::predicates::{orient3d, Sign};
use crate::INVALID;

/// The mesh of these tetrahedra, with all other arrays computed by brute force; faces that equal a PLC triangle are its subfaces.
fn mesh(plc: &Plc, points: Vec<[f64; 3]>, tets: Vec<[u32; 4]>) -> TetMesh {
    let face = |t: usize, i: usize| {
        let mut corners: Vec<u32> = (0..4).filter(|&k| k != i).map(|k| tets[t][k]).collect();
        corners.sort_unstable();
        corners
    };
    let across = |t: usize, i: usize| {
        let other = (0..tets.len()).find(|&o| o != t && (0..4).any(|k| face(o, k) == face(t, i)));
        other.map_or(INVALID, |o| o as u32)
    };
    let mut out = TetMesh {
        input_point_count: plc.points.len() as u32,
        point_alias: (0..plc.points.len() as u32).collect(),
        neighbors: (0..tets.len()).map(|t| std::array::from_fn(|i| across(t, i))).collect(),
        tet_region: vec![0; tets.len()],
        regions: vec![Region { attribute: 1.0, seed: INVALID, max_volume: None }],
        points,
        tets,
        ..TetMesh::default()
    };
    for (f, corners) in plc.triangles.iter().enumerate() {
        add_subface(plc, &mut out, *corners, f as u32);
    }
    for (i, s) in plc.segments.iter().enumerate() {
        out.subsegments.push(Subsegment { ends: s.ends, segment: i as u32, marker: s.marker });
    }
    out
}

fn add_subface(plc: &Plc, mesh: &mut TetMesh, corners: [u32; 3], facet: u32) {
    let mut tets = [INVALID; 2];
    for (t, tet) in mesh.tets.iter().enumerate() {
        if corners.iter().all(|v| tet.contains(v)) {
            if let Some(&apex) = tet.iter().find(|v| !corners.contains(v)) {
                let p = |v: u32| &mesh.points[v as usize];
                let sign = orient3d(p(corners[0]), p(corners[1]), p(corners[2]), p(apex));
                tets[usize::from(sign == Sign::Positive)] = t as u32;
            }
        }
    }
    let marker = plc.facet_marker(facet as usize);
    mesh.subfaces.push(ordered(mesh, Subface { corners, facet, marker, tets }));
}

/// First the tetrahedron in the lower region, otherwise the one with the lower index.
fn ordered(mesh: &TetMesh, face: Subface) -> Subface {
    let rank = |t: u32| (mesh.tet_region.get(t as usize).copied().unwrap_or(0), t);
    let ([a, b, c], [s, t]) = (face.corners, face.tets);
    match t == INVALID || s != INVALID && rank(s) < rank(t) {
        true => face,
        false => Subface { corners: [a, c, b], tets: [t, s], ..face },
    }
}

fn kinds(result: Result<(), Error>) -> Vec<DefectKind> {
    match result {
        Ok(()) => Vec::new(),
        Err(error) => {
            assert_eq!(error.status, Status::CheckFailed, "{error}");
            assert!(error.defect_count > 0);
            let mut kinds: Vec<DefectKind> = error.defects.iter().map(|d| d.kind).collect();
            kinds.sort_unstable();
            kinds.dedup();
            kinds
        }
    }
}

fn check(plc: &Plc, mesh: &TetMesh) -> Vec<DefectKind> {
    kinds(check_mesh(plc, mesh, true, 100))
}

fn corner(i: u32) -> [f64; 3] {
    [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2 & 1)]
}

/// The unit cube's corners, its 12 edges as segments, and a surface triangulation.
fn cube_plc(triangles: Vec<[u32; 3]>) -> Plc {
    let mut segments = Vec::new();
    for a in 0..8u32 {
        for b in [a | 1, a | 2, a | 4].into_iter().filter(|&b| b != a) {
            segments.push(Segment { ends: [a, b], marker: 7 });
        }
    }
    Plc { points: (0..8).map(corner).collect(), segments, triangles, ..Plc::default() }
}

/// The boundary faces of some tetrahedra, outward.
fn boundary(tets: &[[u32; 4]]) -> Vec<[u32; 3]> {
    let mut faces: Vec<[u32; 3]> = Vec::new();
    for t in tets {
        for f in [[t[1], t[2], t[3]], [t[0], t[3], t[2]], [t[0], t[1], t[3]], [t[0], t[2], t[1]]] {
            let same = |g: &[u32; 3]| f.iter().all(|v| g.contains(v));
            match faces.iter().position(same) {
                Some(i) => {
                    faces.remove(i);
                }
                None => faces.push(f),
            }
        }
    }
    faces
}

fn kuhn() -> Vec<[u32; 4]> {
    vec![[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]]
}

fn five() -> Vec<[u32; 4]> {
    vec![[0, 3, 5, 6], [1, 0, 3, 5], [2, 3, 0, 6], [4, 5, 6, 0], [7, 6, 5, 3]]
        .into_iter()
        .map(positive)
        .collect()
}

fn positive(mut t: [u32; 4]) -> [u32; 4] {
    let p = t.map(corner);
    if orient3d(&p[0], &p[1], &p[2], &p[3]) == Sign::Negative {
        t.swap(2, 3);
    }
    t
}

fn cube(tets: Vec<[u32; 4]>) -> (Plc, TetMesh) {
    let plc = cube_plc(boundary(&tets));
    let points = plc.points.clone();
    let mesh = mesh(&plc, points, tets);
    (plc, mesh)
}

/// Two tetrahedra on a common face, which is an inner facet with its own marker.
fn two() -> (Plc, TetMesh) {
    let points = vec![[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0.2, 0.2, 1.], [0.2, 0.2, -1.]];
    let tets = vec![[0, 1, 2, 3], [0, 2, 1, 4]];
    let mut triangles = boundary(&tets);
    triangles.push([0, 1, 2]);
    let triangle_markers = vec![0, 0, 0, 0, 0, 0, 5];
    let plc = Plc { points: points.clone(), triangles, triangle_markers, ..Plc::default() };
    let mesh = mesh(&plc, points, tets);
    (plc, mesh)
}

#[test]
fn valid_meshes_pass() {
    for (plc, mesh) in [cube(kuhn()), cube(five()), two()] {
        assert_eq!(check(&plc, &mesh), vec![]);
    }
    let points: Vec<[f64; 3]> = [0u32, 1, 2, 4].map(corner).to_vec();
    let plc = Plc { triangles: boundary(&[[0, 1, 2, 3]]), points: points.clone(), ..Plc::default() };
    assert_eq!(check(&plc, &mesh(&plc, points, vec![[0, 1, 2, 3]])), vec![]);
    assert_eq!(check(&Plc::default(), &TetMesh::default()), vec![]);
}

/// A mesh that lists no faces does not pass for that.
#[test]
fn a_mesh_without_subfaces_covers_no_facet() {
    let (plc, mut mesh) = cube(kuhn());
    mesh.subfaces.clear();
    let found = check(&plc, &mesh);
    assert!(found.contains(&DefectKind::FacetMissing), "{found:?}");
    let missing = kinds(check_mesh(&plc, &mesh, false, 100));
    assert!(missing.contains(&DefectKind::FacetMissing), "{missing:?}");
    // Mode Delaunay promises no facets; that it keeps the surface is asked all the same.
    (mesh.guarantee, mesh.hull_kept) = (Guarantee::Delaunay, true);
    mesh.subsegments.clear();
    assert_eq!(check(&plc, &mesh), vec![]);
    for kept in [check_preserved(&plc, &mesh, 100), check_preserved_outer(&plc, &mesh, 100)] {
        let found = kinds(kept);
        assert!(found.contains(&DefectKind::FacetMissing), "{found:?}");
    }
}

/// Exactly coplanar facets may be retriangulated across their common edges: six tetrahedra against the surface of five.
#[test]
fn coplanar_facets_may_be_retriangulated() {
    let (_, mut mesh) = cube(kuhn());
    let (plc, _) = cube(five());
    mesh.subfaces.clear();
    for corners in boundary(&kuhn()) {
        let side = |a: &[u32]| {
            (0..3).find(|k| a.iter().all(|v| v >> k & 1 == a[0] >> k & 1)).map(|k| (k, a[0] >> k & 1))
        };
        let facet = plc.triangles.iter().position(|t| side(t) == side(&corners)).unwrap();
        add_subface(&plc, &mut mesh, corners, facet as u32);
    }
    assert_eq!(check(&plc, &mesh), vec![]);
    // Not across unequal markers.
    let mut marked = plc.clone();
    marked.triangle_markers = (0..12).collect();
    for face in &mut mesh.subfaces {
        face.marker = marked.facet_marker(face.facet as usize);
    }
    assert_eq!(check(&marked, &mesh), vec![DefectKind::FacetMissing]);
}

/// The cube's sides as square facets.
#[test]
fn polygons_are_covered() {
    let (triangles, mut mesh) = cube(kuhn());
    let mut plc = Plc { triangles: vec![], ..triangles };
    for (k, high) in (0..3).flat_map(|k| [(k, 0u32), (k, 1)]) {
        let (i, j) = (1 << ((k + 1) % 3), 1 << ((k + 2) % 3));
        let base = high << k;
        plc.facets
            .push(Facet { polygons: vec![vec![base, base + i, base + i + j, base + j]], ..Facet::default() });
    }
    mesh.subfaces.clear();
    for corners in boundary(&kuhn()) {
        let holds = |f: &Facet| corners.iter().all(|v| f.polygons[0].contains(v));
        let facet = plc.facets.iter().position(holds).unwrap();
        add_subface(&plc, &mut mesh, corners, facet as u32);
    }
    assert_eq!(check(&plc, &mesh), vec![]);
    let mut missing = mesh.clone();
    missing.subfaces.pop();
    assert!(check(&plc, &missing).contains(&DefectKind::FacetMissing));
    // A hole in the facet, missing from the mesh.
    let ring = plc.facets[0].polygons[0][..3].to_vec();
    plc.facets[0].polygons.push(ring);
    assert!(check(&plc, &mesh).contains(&DefectKind::FacetMissing));
}

#[test]
fn indices_out_of_range() {
    let (plc, mesh) = cube(kuhn());
    let wrong: [fn(&mut TetMesh); 9] = [
        |m| m.tets[0][0] = 8,
        |m| m.neighbors[0][0] = 6,
        |m| m.tet_region[0] = 1,
        |m| m.subfaces[0].corners[0] = INVALID,
        |m| m.subfaces[0].facet = 12,
        |m| m.subsegments[0].ends[1] = 9,
        |m| m.subsegments[0].segment = 12,
        |m| m.neighbors.truncate(5),
        |m| m.point_alias.truncate(7),
    ];
    for (i, change) in wrong.iter().enumerate() {
        let mut mesh = mesh.clone();
        change(&mut mesh);
        assert_eq!(check(&plc, &mesh), vec![DefectKind::IndexOutOfRange], "change {i}");
    }
    let mut bad = plc.clone();
    bad.triangles[3][1] = 8;
    assert_eq!(check(&bad, &mesh), vec![DefectKind::IndexOutOfRange]);
    let mut bad = plc.clone();
    bad.segments[3].ends[1] = 8;
    assert_eq!(check(&bad, &mesh), vec![DefectKind::IndexOutOfRange]);
    let mut nan = mesh.clone();
    nan.points[2][1] = f64::NAN;
    assert_eq!(check(&plc, &nan), vec![DefectKind::NonFinite]);
}

#[test]
fn moved_and_lost_points() {
    let (plc, mesh) = cube(kuhn());
    let mut moved = mesh.clone();
    moved.points[3][0] = 1.0 + f64::EPSILON;
    assert_eq!(kinds(check_mesh(&plc, &moved, false, 100)), vec![DefectKind::PointMoved]);
    let mut zero = mesh.clone();
    zero.points[0][0] = -0.0;
    assert_eq!(check(&plc, &zero), vec![DefectKind::PointMoved]);
    let mut short = mesh.clone();
    short.points.pop();
    assert!(check(&plc, &short).contains(&DefectKind::PointMoved));
    // A point inside that is no vertex; then one outside, which may be carved.
    for (p, expected) in [([0.5, 0.25, 0.75], vec![DefectKind::PointMoved]), ([2., 2., 2.], vec![])] {
        let (mut plc, mut mesh) = (plc.clone(), mesh.clone());
        plc.points.push(p);
        mesh.points.push(p);
        mesh.point_alias.push(8);
        assert_eq!(check(&plc, &mesh), expected);
    }
    // A duplicate is mapped to the first.
    let (mut plc, mut mesh) = (plc, mesh);
    plc.points.push([1.0, -0.0, 0.0]);
    mesh.points.push([1.0, -0.0, 0.0]);
    mesh.point_alias.push(1);
    assert_eq!(check(&plc, &mesh), vec![]);
    mesh.point_alias[8] = 8;
    assert_eq!(check(&plc, &mesh), vec![DefectKind::PointMoved]);
}

#[test]
fn flat_and_inverted_tets() {
    let (plc, mut mesh) = two();
    mesh.tets[1].swap(0, 1);
    mesh.neighbors[1].swap(0, 1);
    assert!(check(&plc, &mesh).contains(&DefectKind::NotPositive));
    let (mut plc, mut mesh) = two();
    for points in [&mut plc.points, &mut mesh.points] {
        points[4][2] = 0.0;
    }
    assert!(check(&plc, &mesh).contains(&DefectKind::NotPositive));
}

#[test]
fn broken_topology() {
    let (plc, mesh) = cube(kuhn());
    let mut wrong = mesh.clone();
    let n = wrong.neighbors[0].iter().position(|&n| n == INVALID).unwrap();
    wrong.neighbors[0][n] = 3;
    assert_eq!(check(&plc, &wrong), vec![DefectKind::NotConforming]);
    let mut twice = mesh.clone();
    twice.tets.push(twice.tets[0]);
    twice.neighbors.clear();
    twice.tet_region.clear();
    assert!(check(&plc, &twice).contains(&DefectKind::NotConforming));
    // Two positive tetrahedra on one side of their common face.
    let (plc, mut same) = two();
    same.points[4] = [0.3, 0.3, 2.0];
    same.tets[1] = [0, 1, 2, 4];
    assert!(check(&plc, &same).contains(&DefectKind::NotConforming));
    // A region border without a facet.
    let (plc, mut regions) = cube(kuhn());
    regions.regions.push(regions.regions[0]);
    regions.tet_region[2] = 1;
    assert_eq!(check(&plc, &regions), vec![DefectKind::NotConforming]);
    // Subfaces and subsegments with false claims.
    let changes: [fn(&mut TetMesh); 6] = [
        |m| m.subfaces[0].marker = 3,
        |m| m.subfaces[0].tets.swap(0, 1),
        |m| m.subfaces.push(m.subfaces[0]),
        |m| m.subsegments[0].marker = 0,
        |m| m.subsegments[0].segment = 5,
        |m| m.subsegments[0].ends = [1, 6],
    ];
    for (i, change) in changes.iter().enumerate() {
        let mut mesh = mesh.clone();
        change(&mut mesh);
        assert!(check(&plc, &mesh).contains(&DefectKind::NotConforming), "change {i}");
    }
}

#[test]
fn missing_segments() {
    let (plc, mesh) = cube(kuhn());
    let mut diagonal = plc.clone();
    diagonal.segments.push(Segment { ends: [1, 6], marker: 0 });
    assert_eq!(check(&diagonal, &mesh), vec![DefectKind::SegmentMissing]);
    let mut short = mesh.clone();
    short.subsegments.remove(4);
    assert_eq!(check(&plc, &short), vec![DefectKind::SegmentMissing]);
}

#[test]
fn missing_facets() {
    let (plc, mesh) = cube(kuhn());
    // An inner facet across the mesh.
    let mut cut = plc.clone();
    cut.triangles.push([1, 2, 4]);
    assert_eq!(check(&cut, &mesh), vec![DefectKind::FacetMissing]);
    // A subface that is no face; one on another facet's plane.
    let mut wrong = mesh.clone();
    wrong.subfaces[0].corners = [1, 2, 4];
    assert!(check(&plc, &wrong).contains(&DefectKind::FacetMissing));
    let mut wrong = mesh.clone();
    let other = wrong.subfaces.iter().position(|s| s.corners.iter().all(|v| v >> 2 & 1 == 1)).unwrap();
    let facet = wrong.subfaces.iter().position(|s| s.corners.iter().all(|v| v >> 2 & 1 == 0)).unwrap();
    wrong.subfaces[other].facet = facet as u32;
    assert_eq!(check(&plc, &wrong), vec![DefectKind::FacetMissing]);
    let mut wrong = mesh.clone();
    wrong.subfaces.remove(0);
    let found = check(&plc, &wrong);
    assert_eq!(found, vec![DefectKind::FacetMissing, DefectKind::HullOffFacets]);
}

#[test]
fn boundary_off_facets() {
    let (mut plc, mut mesh) = cube(kuhn());
    plc.triangles.clear();
    plc.segments.clear();
    mesh.subfaces.clear();
    mesh.subsegments.clear();
    assert_eq!(check(&plc, &mesh), vec![DefectKind::HullOffFacets]);
    mesh.hull_kept = true;
    assert_eq!(check(&plc, &mesh), vec![]);
    // A mesh with a notch is no hull.
    mesh.tets.pop();
    mesh.tet_region.pop();
    mesh.neighbors.clear();
    assert_eq!(check(&plc, &mesh), vec![DefectKind::HullOffFacets]);
}

#[test]
fn not_delaunay() {
    // A flat bipyramid: the two tetrahedra see each other's apex, unless their common face is a facet.
    let (mut plc, mut mesh) = two();
    for points in [&mut plc.points, &mut mesh.points] {
        points[3] = [0.3, 0.3, 0.1];
        points[4] = [0.3, 0.3, -0.1];
    }
    assert_eq!(check(&plc, &mesh), vec![]);
    plc.triangles.pop();
    mesh.subfaces.pop();
    assert_eq!(check(&plc, &mesh), vec![DefectKind::NotDelaunay]);
    assert_eq!(kinds(check_mesh(&plc, &mesh, false, 100)), vec![]);
    // At a tetrahedron replaced by rounding that is no defect.
    mesh.replaced = vec![1];
    assert_eq!(check(&plc, &mesh), vec![]);
    mesh.replaced = vec![1, 2];
    assert_eq!(check(&plc, &mesh), vec![DefectKind::IndexOutOfRange]);
    mesh.replaced = vec![1, 0];
    assert_eq!(check(&plc, &mesh), vec![DefectKind::IndexOutOfRange]);
}

#[test]
fn the_list_is_cut_but_not_the_count() {
    let (plc, mut mesh) = cube(kuhn());
    mesh.neighbors = vec![[5; 4]; 6];
    let error = check_mesh(&plc, &mesh, false, 2).unwrap_err();
    assert_eq!((error.defects.len(), error.defect_count), (2, 6));
}

/// A tetrahedron with a Steiner point on one edge, `a + t (b − a)`, and so two tetrahedra and six subfaces.
fn split_edge(scale: f64, t: f64) -> (Plc, TetMesh) {
    let points: Vec<[f64; 3]> = [0u32, 1, 2, 4].map(|i| corner(i).map(|x| (0.1 + 0.7 * x) * scale)).to_vec();
    let segments = vec![Segment { ends: [2, 3], marker: 4 }];
    let plc = Plc { triangles: boundary(&[[0, 1, 2, 3]]), segments, points, ..Plc::default() };
    let mut all = plc.points.clone();
    all.push(std::array::from_fn(|k| all[2][k] + t * (all[3][k] - all[2][k])));
    let mut mesh = mesh(&plc, all, vec![[0, 1, 2, 4], [0, 1, 4, 3]]);
    mesh.subfaces.clear();
    for (f, corners) in plc.triangles.iter().enumerate() {
        if corners.contains(&2) && corners.contains(&3) {
            for end in [2, 3] {
                let split = corners.map(|v| if v == end { 4 } else { v });
                add_subface(&plc, &mut mesh, split, f as u32);
            }
        } else {
            add_subface(&plc, &mut mesh, *corners, f as u32);
        }
    }
    let piece = |ends| Subsegment { ends, segment: 0, marker: 4 };
    mesh.subsegments = vec![piece([2, 4]), piece([4, 3])];
    mesh.steiner = vec![SteinerPoint { ends: [2, 3], t, segment: 0, exact: false, ..SteinerPoint::INSIDE }];
    (plc, mesh)
}

#[test]
fn steiner_points_are_judged_where_they_are_exactly() {
    for (scale, t) in [(1.0, 0.3), (1.0, 0.5), (1e-300, 0.7), (1e300, 0.1)] {
        let (plc, mesh) = split_edge(scale, t);
        assert_eq!(check(&plc, &mesh), vec![], "scale {scale}");
    }
    let (plc, mesh) = split_edge(1.0, 0.3);
    // Moved, but valid, since the exact position conforms; not valid if marked exact.
    let mut moved = mesh.clone();
    moved.points[4][0] += 1e-9;
    assert_eq!(check(&plc, &moved), vec![]);
    moved.steiner[0].exact = true;
    assert_eq!(check(&plc, &moved), vec![DefectKind::PointMoved]);
    // The doubles are flat, the exact tetrahedra are not.
    let mut flat = mesh.clone();
    flat.points[4] = flat.points[2];
    assert_eq!(check(&plc, &flat), vec![DefectKind::NotPositive]);
    // On another edge.
    let mut wrong = mesh.clone();
    wrong.steiner[0].ends = [1, 3];
    let found = check(&plc, &wrong);
    assert!(found.contains(&DefectKind::SegmentMissing) && found.contains(&DefectKind::FacetMissing));
    let mut lost = mesh.clone();
    lost.points.push([0.0; 3]);
    lost.steiner.push(SteinerPoint {
        ends: [0, 1],
        t: 0.5,
        segment: INVALID,
        exact: false,
        ..SteinerPoint::INSIDE
    });
    assert_eq!(check(&plc, &lost), vec![DefectKind::PointMoved]);
    let mut tiny = mesh;
    tiny.steiner[0].t = f64::MIN_POSITIVE;
    assert_eq!(check(&plc, &tiny), vec![DefectKind::IndexOutOfRange]);
}

#[test]
fn coordinates_out_of_the_exact_range() {
    let (mut plc, mut mesh) = two();
    for points in [&mut plc.points, &mut mesh.points] {
        points[0][0] = -1e-300;
    }
    assert_eq!(check_mesh(&plc, &mesh, true, 9).unwrap_err().status, Status::CoordinateRange);
}

/// A fin outside: its facet and segment are carved, their pieces are listed on no tetrahedron.
#[test]
fn carved_pieces_are_outside() {
    let (mut plc, mut mesh) = cube(kuhn());
    for points in [&mut plc.points, &mut mesh.points] {
        points.push([2.0, 0.5, 0.5]);
    }
    mesh.point_alias.push(8);
    plc.triangles.push([1, 5, 8]);
    plc.segments.push(Segment { ends: [5, 8], marker: 3 });
    mesh.unmeshed_subsegments.push(Subsegment { ends: [8, 5], segment: 12, marker: 3 });
    let unlisted = mesh.clone();
    mesh.unmeshed_subfaces.push(Subface { corners: [1, 5, 8], facet: 12, marker: 0, tets: [INVALID; 2] });
    assert_eq!(check(&plc, &mesh), vec![]);
    assert_eq!(check(&plc, &unlisted), vec![DefectKind::FacetMissing]);
    // Among the mesh's own they are wrong.
    let mut listed = mesh.clone();
    listed.subfaces.append(&mut listed.unmeshed_subfaces);
    assert_eq!(check(&plc, &listed), vec![DefectKind::FacetMissing]);
    let mut listed = mesh.clone();
    listed.subsegments.append(&mut listed.unmeshed_subsegments);
    assert!(check(&plc, &listed).contains(&DefectKind::NotConforming));
    // The same claim about a facet and a segment inside of the mesh.
    plc.triangles[12] = [1, 2, 4];
    plc.segments[12].ends = [1, 6];
    mesh.unmeshed_subfaces[0].corners = [1, 2, 4];
    mesh.unmeshed_subsegments[0].ends = [1, 6];
    let found = check(&plc, &mesh);
    assert!(found.contains(&DefectKind::NotConforming) && found.contains(&DefectKind::SegmentMissing));
}

/// Every triangle between corners of the cube that is no face: since all corners are used, signs alone decide what is outside.
#[test]
fn outside_by_signs() {
    // An L of two of the six tetrahedra: 0137 and 0451 7; triangles over the gap are outside, those through tetrahedra are not.
    let (plc, _) = cube(kuhn());
    let tets = vec![kuhn()[0], kuhn()[2], kuhn()[4]];
    let mesh = mesh(&plc, plc.points.clone(), tets.clone());
    let context = super::context::Context::new(&plc, &mesh).unwrap();
    let (mut outside, mut inside) = (0, 0);
    for a in 0..8u32 {
        for b in (0..8).filter(|&b| b != a) {
            for c in (0..8).filter(|&c| c != a && c != b) {
                if !context.faces.find([a, b, c]).is_empty() {
                    continue;
                }
                let found = super::carved::face_outside(&context, [a, b, c]);
                // Points of the open triangle near its first corner, in exact small binary fractions.
                let p = |x: f64, y: f64| -> [f64; 3] {
                    let (a, b, c) = (corner(a), corner(b), corner(c));
                    std::array::from_fn(|k| a[k] + x * (b[k] - a[k]) + y * (c[k] - a[k]))
                };
                let within = |q: [f64; 3]| {
                    tets.iter().filter(|t| t.contains(&a)).any(|t| {
                        (0..4).all(|k| {
                            let mut v = t.map(corner);
                            v[k] = q;
                            orient3d(&v[0], &v[1], &v[2], &v[3]) != Sign::Negative
                        })
                    })
                };
                let e = 1.0 / 1024.0;
                let met = (1..64).any(|i| within(p(f64::from(i) * e / 64.0, f64::from(64 - i) * e / 64.0)));
                assert_eq!(found, !met, "{a} {b} {c}");
                if found {
                    outside += 1;
                } else {
                    inside += 1;
                }
            }
        }
    }
    assert!(outside > 10 && inside > 10, "{outside} {inside}");
}

/// A polygon of four corners that are not coplanar, split by a diagonal with a Steiner point on it.
#[test]
fn non_planar_polygons_are_tiled_between_their_corners() {
    let (mut plc, mut mesh) = split_edge(1.0, 0.5);
    for points in [&mut plc.points, &mut mesh.points] {
        points[1] = [0.8; 3];
    }
    let at_edge = |t: &[u32; 3]| t.contains(&2) && t.contains(&3);
    plc.triangles.retain(|t| !at_edge(t));
    plc.segments.clear();
    mesh.subsegments.clear();
    mesh.steiner[0].segment = INVALID;
    plc.facets.push(Facet { polygons: vec![vec![0, 2, 1, 3]], ..Facet::default() });
    for face in &mut mesh.subfaces {
        let same = |t: &[u32; 3]| t.iter().all(|v| face.corners.contains(v));
        face.facet = plc.triangles.iter().position(same).unwrap_or(plc.triangles.len()) as u32;
    }
    assert_eq!(check(&plc, &mesh), vec![]);
    mesh.steiner[0].ends = [1, 3];
    assert!(check(&plc, &mesh).contains(&DefectKind::FacetMissing));
}

/// A cubic grid of `n`³ cubes in six tetrahedra each, its boundary triangles as facets.
fn grid(n: u32) -> (Plc, TetMesh) {
    let at = |x: u32, y: u32, z: u32| x + (n + 1) * (y + (n + 1) * z);
    let mut plc = Plc::default();
    for i in 0..(n + 1).pow(3) {
        plc.points.push([i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1).pow(2)].map(|k| f64::from(k) / 3.0));
    }
    let mut mesh = TetMesh { points: plc.points.clone(), ..TetMesh::default() };
    for cube in 0..n.pow(3) {
        let (x, y, z) = (cube % n, cube / n % n, cube / n / n);
        let vertex = |c: u32| at(x + (c & 1), y + (c >> 1 & 1), z + (c >> 2));
        mesh.tets.extend(kuhn().iter().map(|t| t.map(vertex)));
    }
    let table = super::faces::FaceTable::new(&mesh.tets, mesh.points.len()).unwrap();
    for (corners, run) in table.runs() {
        if let [only] = run {
            let facet = plc.triangles.len() as u32;
            plc.triangles.push(corners);
            let tet = mesh.tets[only.handle as usize / 4];
            let apex = tet[only.handle as usize % 4];
            let [p, q, r] = corners.map(|v| &mesh.points[v as usize]);
            let positive = orient3d(p, q, r, &mesh.points[apex as usize]) == Sign::Positive;
            let mut tets = [INVALID; 2];
            tets[usize::from(positive)] = only.handle / 4;
            let face = ordered(&mesh, Subface { corners, facet, marker: 0, tets });
            mesh.subfaces.push(face);
        }
    }
    (plc, mesh)
}

#[test]
fn grids_pass() {
    let (plc, mut mesh) = grid(8);
    assert_eq!(check(&plc, &mesh), vec![]);
    mesh.subfaces.truncate(mesh.subfaces.len() - 1);
    assert_eq!(check(&plc, &mesh), vec![DefectKind::FacetMissing, DefectKind::HullOffFacets]);
}

fn check_kept(plc: &Plc, mesh: &TetMesh) -> Vec<DefectKind> {
    kinds(super::check_preserved(plc, mesh, 100))
}

/// The cube's surface and a point inside, joined with all of it.
fn cone() -> (Plc, TetMesh) {
    let plc = cube_plc(boundary(&kuhn()));
    let mut points = plc.points.clone();
    points.push([0.5, 0.25, 0.625]);
    let tets = plc.triangles.iter().map(|&[a, b, c]| {
        let p = [a, b, c, 8].map(|v| &points[v as usize]);
        match orient3d(p[0], p[1], p[2], p[3]) {
            Sign::Negative => [a, c, b, 8],
            _ => [a, b, c, 8],
        }
    });
    let tets = tets.collect();
    let mut mesh = mesh(&plc, points, tets);
    mesh.steiner = vec![SteinerPoint::INSIDE];
    (plc, mesh)
}

#[test]
fn a_kept_surface_passes() {
    for (plc, mesh) in [cone(), cube(kuhn()), cube(five()), two()] {
        assert_eq!(check_kept(&plc, &mesh), vec![]);
    }
    // An input point on a side: its triangle cannot be a face, but pieces between input points are accepted.
    let (mut plc, mesh) = split_edge(1.0, 0.5);
    let mut points: Vec<[f64; 3]> = [0u32, 1, 2, 4].map(corner).to_vec();
    points.push([0.0, 0.5, 0.5]);
    let kept =
        TetMesh { input_point_count: 5, point_alias: (0..5).collect(), steiner: vec![], points, ..mesh };
    plc.points = kept.points.clone();
    assert_eq!(check_kept(&plc, &kept), vec![]);
}

#[test]
fn a_surface_that_is_not_kept() {
    let (plc, mesh) = split_edge(1.0, 0.3);
    assert_eq!(check_kept(&plc, &mesh), vec![DefectKind::SegmentMissing, DefectKind::FacetMissing]);
    // The other diagonals: valid, but not what was given.
    let (plc, _) = cube(five());
    let (_, other) = cube(kuhn());
    assert!(check_kept(&plc, &other).contains(&DefectKind::FacetMissing));
    // A point on the surface that claims to lie inside.
    let (plc, mut mesh) = split_edge(1.0, 0.5);
    mesh.steiner = vec![SteinerPoint::INSIDE];
    assert!(check_kept(&plc, &mesh).contains(&DefectKind::FacetMissing));
    // A point inside has no parents and no parameter, and lies at its doubles.
    let (plc, mesh) = cone();
    for change in [
        |s: &mut SteinerPoint| s.exact = false,
        |s: &mut SteinerPoint| s.segment = 0,
        |s: &mut SteinerPoint| s.ends[0] = 0,
    ] {
        let mut wrong = mesh.clone();
        change(&mut wrong.steiner[0]);
        assert_eq!(check_kept(&plc, &wrong), vec![DefectKind::IndexOutOfRange]);
    }
}

/// Two Steiner points on a segment, with parameters that differ only in their last terms, and replaced tetrahedra with an edge that skips
/// one of the points: the pieces of the segment are found in their exact order.
#[test]
fn edges_of_replaced_tetrahedra_may_pass_points_of_a_segment_by() {
    let plc = Plc {
        points: vec![[0.0; 3], [4.0, 0.0, 0.0], [2.0, 3.0, 0.0], [2.0, -2.0, 3.0], [2.0, -2.0, -3.0]],
        segments: vec![Segment { ends: [0, 1], marker: 7 }],
        ..Plc::default()
    };
    let (a, b, far, near) = (0, 1, 5, 6);
    let mut points = plc.points.clone();
    points.extend([[2.4, 0.0, 0.0], [1.6, 0.25, 0.75]]);
    let mut tets = vec![[a, far, 3, 4], [a, far, 4, 2]];
    tets.extend([[near, far, 2, 3], [a, near, 2, 3], [a, far, near, 3], [a, far, 2, near]]);
    tets.extend([[far, b, 2, 3], [far, b, 3, 4], [far, b, 4, 2]]);
    for tet in &mut tets {
        let [p, q, r, s] = tet.map(|v| points[v as usize]);
        if orient3d(&p, &q, &r, &s) != Sign::Positive {
            tet.swap(2, 3);
        }
    }
    let mut mesh = mesh(&plc, points, tets);
    mesh.hull_kept = true;
    mesh.replaced = (0..9).collect();
    let steiner = SteinerPoint { ends: [a, b], t: 0.5, segment: 0, exact: false, ..SteinerPoint::INSIDE };
    mesh.steiner = vec![steiner; 2];
    mesh.steiner_terms = vec![SteinerTerm { steiner: 0, value: 1e-20 }];
    let piece = |ends| Subsegment { ends, segment: 0, marker: 7 };
    mesh.subsegments = vec![piece([a, near]), piece([near, far]), piece([far, b])];
    assert_eq!(check(&plc, &mesh), []);
    mesh.subsegments = vec![piece([a, far]), piece([far, b])];
    assert_eq!(check(&plc, &mesh), [DefectKind::NotConforming, DefectKind::SegmentMissing]);
}
