use crate::elementary::cosine_of_degrees;
use crate::fill::tests::grid_box;
use crate::ops::shape::{sine, Shape};
use crate::options::{Mode, Options};
use crate::output::TetMesh;
use crate::plc::{Facet, Plc};
use crate::predicates::Points;
use crate::progress::Silent;
use crate::refine::tests::cuboid;
use crate::{check_guarantee, check_preserved, improve, tetrahedralize, RegionSeed, Segment, INVALID};

#[test]
fn the_worst_angle_never_gets_worse() {
    let plc = grid_box(4);
    let worst = |optimize: u32| {
        let options = Options { mode: Mode::Preserve, quality: Some(2.0), optimize, ..Options::default() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        check_preserved(&plc, &mesh, 10).unwrap();
        let at = |t: &[u32; 4]| Shape::at(t.map(|v| &mesh.points[v as usize])).angle;
        mesh.tets.iter().map(at).fold(f64::INFINITY, f64::min)
    };
    let (before, after) = (worst(0), worst(1));
    assert!(after >= before && after > 0.25, "{before} {after}");
}

/// Its smallest dihedral angle, by its sine.
fn worst_sine(mesh: &TetMesh) -> f64 {
    let at = |t: &[u32; 4]| sine(t.map(|v| &mesh.points[v as usize]));
    mesh.tets.iter().map(at).fold(f64::INFINITY, f64::min)
}

#[test]
fn larger_efforts_and_a_wanted_angle_find_more() {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [1.1, 0.7, 0.45]);
    let made = |optimize, min_angle| {
        let options = Options { quality: Some(1.414), optimize, min_angle, ..Options::default() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        check_guarantee(&plc, &mesh, 10).unwrap();
        mesh
    };
    let [one, two] = [1, 2].map(|optimize| worst_sine(&made(optimize, None)));
    let sine = |degrees: f64| cosine_of_degrees(90.0 - degrees);
    assert!(two > one && one < sine(24.0), "{one} {two}");
    // Nothing is done for an angle that is there.
    assert_eq!(made(0, Some(20.0)).points, made(1, None).points);
    let mesh = made(0, Some(24.0));
    assert!(worst_sine(&mesh) >= sine(24.0), "{}", worst_sine(&mesh));
    let options = Options { min_angle: Some(24.0), ..Options::default() };
    assert!(worst_sine(&improve(&mesh, &options, &mut Silent).unwrap()) >= worst_sine(&mesh));
    // Nothing reaches this: the best of all efforts.
    let most = worst_sine(&made(1, Some(60.0)));
    let three = worst_sine(&made(3, None));
    assert!(most >= one.max(two).max(three) && most < sine(60.0), "{most}: {one} {two} {three}");
}

/// A mesh is valid whenever the time is over, and no worse; with much time it is that of the largest effort.
#[test]
fn seconds_end_with_what_there_is() {
    let plc = grid_box(3);
    for mode in [Mode::Preserve, Mode::Constrained] {
        let made = |optimize, optimize_seconds| {
            let options = Options { mode, size: Some(0.7), optimize, optimize_seconds, ..Options::default() };
            let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
            check_guarantee(&plc, &mesh, 10).unwrap();
            let at = |t: &[u32; 4]| Shape::at(t.map(|v| &mesh.points[v as usize])).angle;
            let worst = mesh.tets.iter().map(at).fold(f64::INFINITY, f64::min);
            (mesh, worst)
        };
        let none = made(0, None).1;
        for seconds in [1e-9, 1e-3, 4e-3, 2e-2] {
            let worst = made(0, Some(seconds)).1;
            assert!(worst >= none, "{seconds}: {none} {worst}");
        }
        let (all, worst) = made(0, Some(1e9));
        let (effort, _) = made(u32::MAX, None);
        assert!(all.tets == effort.tets && all.points == effort.points && worst > none);
        let short = Options { optimize_seconds: Some(1e-9), ..Options::default() };
        let same = improve(&all, &short, &mut Silent).unwrap();
        assert!(same.tets.len() == all.tets.len() && same.points.len() == all.points.len());
    }
}

/// A box whose facets are slanted and no planes of doubles, as triangles.
fn slanted_box() -> Plc {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [1.3, 0.8, 0.6]);
    for p in &mut plc.points {
        let [x, y, z] = *p;
        *p = [x + 0.1 * y, y + 0.3 * z, z + 0.7 * x].map(|x| 0.9 * x);
    }
    let facets = std::mem::take(&mut plc.facets);
    let halves = facets.iter().map(|facet| &facet.polygons[0]);
    plc.triangles = halves.flat_map(|q| [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]).collect();
    plc
}

/// A prism with a sheet inside that touches nothing, one from edge to edge, and a segment on no facet.
fn prism_with_sheets() -> Plc {
    let mut plc = Plc::default();
    let base = [[0.0, 0.0], [2.1, 0.3], [0.7, 1.9]];
    plc.points = [0.0, 1.7].into_iter().flat_map(|z| base.map(|[x, y]| [x, y, z])).collect();
    let mut add = |corners: Vec<u32>, marker| {
        plc.facets.push(Facet { polygons: vec![corners], marker, ..Facet::default() });
    };
    add(vec![0, 1, 2], 1);
    add(vec![3, 4, 5], 1);
    add(vec![0, 1, 4, 3], 2);
    add(vec![1, 2, 5, 4], 2);
    add(vec![2, 0, 3, 5], 2);
    add(vec![0, 1, 5], 3);
    add(vec![6, 7, 8], 4);
    plc.points.extend([[0.4, 0.3, 1.3], [1.3, 0.5, 1.45], [0.8, 0.9, 1.6], [0.7, 0.5, 0.1], [1.2, 0.8, 0.3]]);
    plc.segments = vec![Segment { ends: [9, 10], marker: 5 }];
    plc
}

/// Two boxes, one on the other.
fn two_materials() -> Plc {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [1.1, 0.7, 0.3]);
    let top: Vec<u32> = (4..8).collect();
    let first = plc.points.len() as u32;
    plc.points.extend(
        top.iter()
            .map(|&v| {
                let [x, y, z] = plc.points[v as usize];
                [x + 0.1, y - 0.05, z + 0.4]
            })
            .collect::<Vec<_>>(),
    );
    for [i, j] in [[0, 1], [1, 3], [3, 2], [2, 0]] {
        let (i, j) = (i as u32, j as u32);
        let polygons = vec![vec![4 + i, 4 + j, first + j, first + i]];
        plc.facets.push(Facet { polygons, ..Facet::default() });
    }
    let polygons = vec![vec![first, first + 1, first + 3, first + 2]];
    plc.facets.push(Facet { polygons, ..Facet::default() });
    plc.regions = vec![
        RegionSeed { point: [0.5, 0.3, 0.1], attribute: 1.0, max_volume: Some(0.002) },
        RegionSeed { point: [0.55, 0.3, 0.5], attribute: 2.0, max_volume: None },
    ];
    plc
}

/// Where the record of a point on the surface says that it is: the nearest doubles.
fn recorded(plc: &Plc, mesh: &TetMesh, i: usize) -> [f64; 3] {
    let (point, mut points) = (&mesh.steiner[i], Points::new(plc.points.clone()));
    let v = match (point.ends, point.third) {
        ([INVALID, INVALID], _) => return mesh.points[plc.points.len() + i],
        ([a, b], INVALID) => points.push_on_segment(a, b, &point.t.into()).unwrap(),
        ([o, a], b) => points.push_on_facet([o, a, b], [point.t, point.u]).unwrap(),
    };
    *points.xyz(v)
}

/// Points of the surface slide where it may be refined: the mesh passes the check, which judges facets and segments by the records, and these
/// agree with the points; nothing is worse than without optimisation.
#[test]
fn points_slide_on_surfaces_and_are_recorded_where_they_are() {
    let shaped = || Options { quality: Some(1.414), ..Options::default() };
    for (plc, name) in [(slanted_box(), "box"), (prism_with_sheets(), "prism"), (two_materials(), "two")] {
        for options in
            [shaped(), Options { size: Some(0.2), ..shaped() }, Options { optimize: 2, ..shaped() }]
        {
            let effort = options.optimize.max(1);
            let made = |optimize| {
                let mesh =
                    tetrahedralize(&plc, &Options { optimize, ..options.clone() }, &mut Silent).unwrap();
                check_guarantee(&plc, &mesh, 10).unwrap();
                mesh
            };
            let (before, after) = (made(0), made(effort));
            assert!(worst_sine(&after) >= worst_sine(&before), "{name}");
            let on_surface: Vec<usize> =
                (0..after.steiner.len()).filter(|&i| !after.steiner[i].is_inside()).collect();
            let mut slid = [0; 2];
            for &i in &on_surface {
                let (old, new) = (&before.steiner[i], &after.steiner[i]);
                assert_eq!(recorded(&plc, &after, i), after.points[plc.points.len() + i], "{name} {new:?}");
                // Each on its own segment or facet.
                assert_eq!(
                    (old.segment, old.facet, old.is_on_edge()),
                    (new.segment, new.facet, new.is_on_edge())
                );
                if before.points[plc.points.len() + i] != after.points[plc.points.len() + i] {
                    slid[usize::from(new.is_on_edge())] += 1;
                }
            }
            assert!(
                slid[1] > 0 && (slid[0] > 0 || options.size.is_none()),
                "{name}: {slid:?} of {}",
                on_surface.len()
            );
        }
    }
}
