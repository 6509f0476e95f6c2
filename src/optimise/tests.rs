use crate::fill::tests::grid_box;
use crate::ops::shape::Shape;
use crate::options::{Mode, Options};
use crate::progress::Silent;
use crate::{check_preserved, tetrahedralize};

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
