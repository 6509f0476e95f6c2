use crate::elementary::cosine_of_degrees;
use crate::fill::tests::grid_box;
use crate::ops::shape::{sine, Shape};
use crate::options::{Mode, Options};
use crate::output::TetMesh;
use crate::plc::Plc;
use crate::progress::Silent;
use crate::refine::tests::cuboid;
use crate::{check_guarantee, check_preserved, improve, tetrahedralize};

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
    // Nothing reaches this: as much as can be.
    let most = worst_sine(&made(1, Some(60.0)));
    assert!(most >= sine(24.0) && most < sine(60.0), "{most}");
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
