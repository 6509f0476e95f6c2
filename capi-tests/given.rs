//! Random meshes as given ones: they come back from arrays, and refining and improving keep what must be kept.
use delotet::query::TetQuality;
use delotet::{
    check_mesh, improve, mesh_from_arrays, refine, tetrahedralize, Error, MeshArrays, MeshSizes, Mode,
    Options, Plc, RegionSeed, Segment, Silent, Sizes, Status, TetMesh,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

type Failure = TestCaseError;

/// The same cases each time; others, and more, by the environment variable `PROPTEST_CASES`.
fn config() -> ProptestConfig {
    let default = ProptestConfig::default();
    let search = std::env::var_os("PROPTEST_CASES").is_some();
    let (cases, rng_seed) = if search { (default.cases, default.rng_seed) } else { (24, RngSeed::Fixed(1)) };
    ProptestConfig { cases, rng_seed, failure_persistence: None, ..default }
}

/// Two boxes with a wall between, points on an integer grid in them, a segment between two of these, a region seed.
fn boxes(inner: &[[i32; 3]]) -> Plc {
    let mut plc = Plc::default();
    for x in [0.0, 4.0, 8.0] {
        plc.points.extend([[x, 0.0, 0.0], [x, 4.0, 0.0], [x, 4.0, 4.0], [x, 0.0, 4.0]]);
    }
    for x in [0u32, 4, 8] {
        for corners in [[0, 1, 2], [0, 2, 3]] {
            plc.triangles.push(corners.map(|v| v + x));
            plc.triangle_markers.push(x as i32);
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
    plc.points.extend(inner.iter().map(|p| p.map(f64::from)));
    let one_box = |p: &[i32; 3]| p[0] < 4;
    if let [a, b, ..] = inner {
        if a != b && one_box(a) == one_box(b) && a[0] != 4 && b[0] != 4 {
            plc.segments.push(Segment { ends: [12, 13], marker: 5 });
        }
    }
    plc.regions.push(RegionSeed { point: [6.0625, 2.03125, 1.515625], attribute: 9.0, max_volume: None });
    plc
}

fn made(plc: &Plc, mode: Mode) -> Result<Option<TetMesh>, Failure> {
    match tetrahedralize(plc, &Options { mode, ..Options::default() }, &mut Silent) {
        Ok(mesh) => Ok(Some(mesh)),
        Err(Error { status: Status::SelfIntersection | Status::SeedOutside | Status::Rounding, .. }) => {
            Ok(None)
        }
        Err(error) => Err(Failure::fail(format!("{error}: {:?}\n{plc:?}", error.defects))),
    }
}

fn sorted<const N: usize>(mut corners: [u32; N]) -> [u32; N] {
    corners.sort_unstable();
    corners
}

fn attributes(mesh: &TetMesh) -> Vec<f64> {
    mesh.tet_region.iter().map(|&region| mesh.regions[region as usize].attribute).collect()
}

fn arrays(mesh: &TetMesh) -> MeshArrays {
    MeshArrays {
        points: mesh.points.clone(),
        input_point_count: Some(mesh.input_point_count),
        tets: mesh.tets.clone(),
        attributes: attributes(mesh),
        faces: mesh.subfaces.iter().map(|face| face.corners).collect(),
        face_markers: mesh.subfaces.iter().map(|face| face.marker).collect(),
        edges: mesh.subsegments.iter().map(|edge| edge.ends).collect(),
        edge_markers: mesh.subsegments.iter().map(|edge| edge.marker).collect(),
    }
}

/// Six times the volume.
fn volume6(mesh: &TetMesh, tet: &[u32; 4]) -> f64 {
    let [a, b, c, d] = tet.map(|v| mesh.points[v as usize]);
    let [u, v, w] = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
    u[0] * (v[1] * w[2] - v[2] * w[1])
        + u[1] * (v[2] * w[0] - v[0] * w[2])
        + u[2] * (v[0] * w[1] - v[1] * w[0])
}

fn volumes(mesh: &TetMesh) -> Vec<f64> {
    let mut sums = vec![0.0; mesh.regions.len()];
    mesh.tets
        .iter()
        .zip(&mesh.tet_region)
        .for_each(|(tet, &region)| sums[region as usize] += volume6(mesh, tet));
    sums
}

fn worst(mesh: &TetMesh) -> f64 {
    let qualities = delotet::query::quality::tet_qualities(mesh).expect("memory");
    qualities.iter().map(|quality| quality.min_dihedral()).fold(f64::INFINITY, f64::min)
}

/// What a mesh made of another one must have kept.
fn keeps(before: &TetMesh, after: &TetMesh) -> Result<(), Failure> {
    let inputs = before.input_point_count as usize;
    prop_assert_eq!(&after.points[..inputs], &before.points[..inputs]);
    prop_assert_eq!(&after.regions, &before.regions);
    let face = |face: &delotet::Subface| (sorted(face.corners), face.facet, face.marker);
    prop_assert_eq!(
        after.subfaces.iter().map(face).collect::<Vec<_>>(),
        before.subfaces.iter().map(face).collect::<Vec<_>>()
    );
    prop_assert_eq!(&after.subsegments, &before.subsegments);
    for (x, y) in volumes(before).into_iter().zip(volumes(after)) {
        prop_assert!((x - y).abs() <= 1e-9 * x, "{} {}", x, y);
    }
    Ok(())
}

fn checked(plc: &Plc, mesh: &TetMesh) -> Result<(), Failure> {
    check_mesh(plc, mesh, false, 10).map_err(|e| Failure::fail(format!("{e}: {:?}\n{plc:?}", e.defects)))
}

/// Everything with one mesh.
fn given(plc: &Plc, mesh: &TetMesh, mode: Mode, step: f64) -> Result<(), Failure> {
    let again =
        mesh_from_arrays(arrays(mesh), 10).map_err(|e| Failure::fail(format!("{e}: {:?}", e.defects)))?;
    prop_assert_eq!(&again.points, &mesh.points);
    prop_assert_eq!((&again.tets, &again.neighbors), (&mesh.tets, &mesh.neighbors));
    prop_assert_eq!(attributes(&again), attributes(mesh));
    prop_assert_eq!(&again.unmeshed_points, &mesh.unmeshed_points);
    let faces = |mesh: &TetMesh| -> Vec<_> {
        mesh.subfaces.iter().map(|face| (sorted(face.corners), sorted(face.tets), face.marker)).collect()
    };
    // In mode Delaunay no facet is known, but arrays have a boundary.
    if mode != Mode::Delaunay {
        prop_assert_eq!(faces(&again), faces(mesh));
    }
    let mut points = vec![f64::INFINITY; mesh.points.len()];
    points[0] = 0.7 * step;
    let sizes = MeshSizes { parts: Sizes { points, ..Sizes::default() }, ..MeshSizes::default() };
    let options = Options { gradation: 0.5, optimize: 1, ..Options::default() };
    let run = |mesh: &TetMesh| {
        refine(mesh, &sizes, &options, &mut Silent)
            .map_err(|e| Failure::fail(format!("{e}: {:?}\n{plc:?}", e.defects)))
    };
    let fine = run(mesh)?;
    keeps(mesh, &fine)?;
    if mode != Mode::Delaunay {
        checked(plc, &fine)?;
    }
    let mut twice = run(mesh)?;
    twice.statistics = fine.statistics.clone();
    prop_assert!(twice == fine, "another mesh in the second run");
    keeps(&again, &run(&again)?)?;
    for mesh in [mesh, &again, &fine] {
        let better = improve(mesh, &Options::default(), &mut Silent)
            .map_err(|e| Failure::fail(format!("{e}: {:?}\n{plc:?}", e.defects)))?;
        keeps(mesh, &better)?;
        prop_assert!(worst(&better) >= worst(mesh) - 1e-9, "{} {}", worst(&better), worst(mesh));
    }
    Ok(())
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn meshes_of_all_modes_are_refined_and_improved(inner in prop::collection::vec([1..8i32, 1..4i32, 1..4i32], 0..12), step in prop::sample::select(vec![1.0, 0.1])) {
        let mut plc = boxes(&inner);
        // With a factor that is no binary fraction, points on edges have to be rounded.
        plc.points.iter_mut().flatten().for_each(|x| *x *= step);
        plc.regions[0].point = plc.regions[0].point.map(|x| x * step);
        for mode in [Mode::Delaunay, Mode::Constrained, Mode::Preserve] {
            if let Some(mesh) = made(&plc, mode)? {
                given(&plc, &mesh, mode, step)?;
            }
        }
    }

    /// Random arrays: an error or a mesh, never a failure of the library.
    #[test]
    fn any_arrays_are_answered(
        points in prop::collection::vec([0..3i32, 0..3i32, 0..3i32], 4..10),
        tets in prop::collection::vec([0..10u32, 0..10, 0..10, 0..10], 1..8),
        faces in prop::collection::vec([0..10u32, 0..10, 0..10], 0..2),
    ) {
        let points: Vec<_> = points.iter().map(|p| p.map(f64::from)).collect();
        let arrays = MeshArrays { points, tets, faces, input_point_count: Some(0), ..MeshArrays::default() };
        match mesh_from_arrays(arrays, 10) {
            Ok(mesh) => {
                let options = Options { size: Some(0.8), optimize: 1, ..Options::default() };
                match refine(&mesh, &MeshSizes::default(), &options, &mut Silent) {
                    Ok(fine) => keeps(&mesh, &fine)?,
                    Err(e) => return Err(Failure::fail(format!("{e}: {:?}\n{mesh:?}", e.defects))),
                }
            }
            Err(e) => prop_assert!(
                matches!(e.status, Status::CheckFailed | Status::IndexOutOfRange),
                "{}", e
            ),
        }
    }
}

/// The smallest dihedral angle, or what the largest lacks to 180 degrees.
fn smallest_angle(mesh: &TetMesh) -> f64 {
    let angles = mesh.tets.iter().flat_map(|t| TetQuality::of_tet(mesh, t).dihedrals);
    angles.map(|angle| angle.min(180.0 - angle)).fold(180.0, f64::min)
}

/// It ended at 10 degrees: from what effort 1 had left, effort 2 could not reach what it reaches alone.
#[test]
fn an_angle_is_reached_that_one_of_the_efforts_reaches() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/capi-tests/data/nested.off");
    let plc = delotet::io::read(file.as_ref()).unwrap();
    let made = |optimize, min_angle| {
        let shape =
            Options { mode: Mode::Preserve, quality: Some(2.0), gradation: 1.0, ..Options::default() };
        smallest_angle(&tetrahedralize(&plc, &Options { optimize, min_angle, ..shape }, &mut Silent).unwrap())
    };
    let alone = [1, 2].map(|optimize| made(optimize, None));
    assert!(alone[0] < 10.0 && alone[1] > 20.0, "{alone:?}");
    let reached = made(0, Some(20.0));
    assert!(reached >= 20.0, "{reached}");
}
