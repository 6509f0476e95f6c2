use crate::control::CancelToken;
use crate::error::Status;
use crate::options::{Mode, Options, SizeFunction};
use crate::plc::Plc;
use crate::progress::Silent;
use crate::{check_preserved, tetrahedralize, RegionSeed, Segment, TetMesh};

/// A box of `n` squares along each side, two triangles each.
pub(crate) fn grid_box(n: u32) -> Plc {
    let mut plc = Plc::default();
    let mut ids = std::collections::BTreeMap::new();
    let mut quads = Vec::new();
    for axis in 0..3 {
        for side in [0, n] {
            for i in 0..n {
                for j in 0..n {
                    let corner = |a: u32, b: u32| {
                        let mut p = [0; 3];
                        (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, a, b);
                        p
                    };
                    quads.push([corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]);
                }
            }
        }
    }
    for quad in quads {
        let q = quad.map(|p| {
            *ids.entry(p).or_insert_with(|| {
                plc.points.push(p.map(f64::from));
                plc.points.len() as u32 - 1
            })
        });
        for t in [[q[0], q[1], q[2]], [q[0], q[2], q[3]]] {
            plc.triangles.push(t);
        }
    }
    plc
}

fn mesh(plc: &Plc, options: Options) -> TetMesh {
    tetrahedralize(plc, &Options { mode: Mode::Preserve, ..options }, &mut Silent).unwrap()
}

fn refused(plc: &Plc, options: Options) -> Status {
    tetrahedralize(plc, &Options { mode: Mode::Preserve, ..options }, &mut Silent).unwrap_err().status
}

/// Where a mesh has points that the input has not.
fn added(plc: &Plc, mesh: &TetMesh) -> Vec<[f64; 3]> {
    mesh.points[plc.points.len()..].to_vec()
}

fn volume(mesh: &TetMesh, t: &[u32; 4]) -> f64 {
    crate::size::volume(t.map(|v| &mesh.points[v as usize]))
}

#[test]
fn the_surface_is_kept_and_nothing_is_inverted() {
    let plc = grid_box(4);
    let filled = mesh(&plc, Options { quality: Some(2.0), optimize: 1, ..Options::default() });
    assert!(filled.points.len() > plc.points.len() + 5, "{}", filled.points.len());
    check_preserved(&plc, &filled, 10).unwrap();
    assert_eq!(filled.points[..plc.points.len()], plc.points[..]);
    let sum: f64 = filled.tets.iter().map(|t| volume(&filled, t)).sum();
    assert!((sum - 64.0).abs() < 1e-9);
}

#[test]
fn smaller_sizes_make_more_points_and_the_same_input_the_same_mesh() {
    let plc = grid_box(2);
    let of = |size: f64| mesh(&plc, Options { size: Some(size), optimize: 1, ..Options::default() });
    let (coarse, fine) = (of(1.0), of(0.4));
    assert!(coarse.points.len() < fine.points.len());
    assert_eq!(fine.tets, of(0.4).tets);
    let threads = Options { size: Some(0.4), optimize: 1, threads: 3, ..Options::default() };
    let other = mesh(&plc, threads);
    assert!(other.tets == fine.tets && other.points == fine.points);
}

/// Where the surface's own triangles are as small as the bound asks for.
#[test]
fn no_tetrahedron_is_above_the_bound_on_volume() {
    let plc = grid_box(8);
    for optimize in [0, 1] {
        let bound = 0.15;
        let filled = mesh(&plc, Options { max_volume: Some(bound), optimize, ..Options::default() });
        check_preserved(&plc, &filled, 10).unwrap();
        let largest = filled.tets.iter().map(|t| volume(&filled, t)).fold(0.0, f64::max);
        assert!(largest <= bound, "{largest} with effort {optimize}");
    }
}

/// Two boxes side by side, the right one with a seed that bounds volumes.
#[test]
fn regions_have_bounds_and_sizes_of_their_own() {
    let (mut plc, right) = (grid_box(6), grid_box(6));
    let first = plc.points.len() as u32;
    plc.points.extend(right.points.iter().map(|&[x, y, z]| [x + 10.0, y, z]));
    plc.triangles.extend(right.triangles.iter().map(|t| t.map(|v| v + first)));
    for (x, max_volume) in [(1.0, None), (11.0, Some(0.05))] {
        plc.regions.push(RegionSeed { point: [x, 1.0, 1.0], attribute: x, max_volume });
    }
    let count = |plc: &Plc, options: &Options| {
        let added = added(plc, &mesh(plc, options.copied()));
        let right = added.iter().filter(|p| p[0] > 8.0).count();
        [added.len() - right, right]
    };
    let options = Options { quality: Some(2.0), ..Options::default() };
    let [left, right] = count(&plc, &options);
    assert!(right > 3 * left, "{left} {right}");
    plc.regions[1].max_volume = None;
    plc.sizes.set_regions(1.0, 0.5).unwrap();
    let [left, right] = count(&plc, &options);
    assert!(left > 3 * right, "{left} {right}");
}

#[test]
fn points_facets_segments_and_a_function_have_sizes() {
    let mut plc = grid_box(6);
    let count = |plc: &Plc, options: Options| {
        let filled = mesh(plc, options);
        check_preserved(plc, &filled, 10).unwrap();
        let added = added(plc, &filled);
        let low = added.iter().filter(|p| p[2] < 3.0).count();
        [low, added.len() - low]
    };
    let [low, high] = count(&plc, Options { quality: Some(2.0), ..Options::default() });
    assert!(low < 2 * high && high < 2 * low, "{low} {high}");
    // Only what is asked for near the bottom makes points there.
    let more = |[low, high]: [usize; 2]| assert!(low as f64 > 1.3 * high as f64, "{low} {high}");
    plc.triangle_markers = vec![0; plc.triangles.len()];
    for (marker, t) in plc.triangle_markers.iter_mut().zip(&plc.triangles) {
        *marker = i32::from(t.iter().all(|&v| plc.points[v as usize][2] == 0.0));
    }
    plc.sizes.set_facets(1, 0.3).unwrap();
    more(count(&plc, Options { quality: Some(2.0), ..Options::default() }));
    plc.sizes.set_facets(1, f64::INFINITY).unwrap();
    plc.sizes.points = plc.points.iter().map(|p| if p[2] == 0.0 { 0.3 } else { f64::INFINITY }).collect();
    more(count(&plc, Options { quality: Some(2.0), ..Options::default() }));
    plc.sizes.points.clear();
    let at = |p: [f64; 3]| plc.points.iter().position(|&q| q == p).unwrap() as u32;
    let ends = [at([0.0, 3.0, 0.0]), at([0.0, 4.0, 0.0])];
    plc.segments.push(Segment { ends, marker: 7 });
    plc.sizes.set_segments(7, 0.1).unwrap();
    more(count(&plc, Options { quality: Some(2.0), ..Options::default() }));
    plc.sizes.segments.clear();
    let function = SizeFunction::new(|p| Ok(if p[2] < 2.0 { 0.4 } else { f64::INFINITY }));
    more(count(&plc, Options { size_function: Some(function), ..Options::default() }));
}

#[test]
fn what_the_function_refuses_ends_the_run() {
    let plc = grid_box(3);
    let with = |function| Options { size_function: Some(function), ..Options::default() };
    assert_eq!(refused(&plc, with(SizeFunction::new(|_| Ok(f64::NAN)))), Status::InvalidArgument);
    let cancels = SizeFunction::new(|_| Err(crate::Error::new(Status::Cancelled, format_args!("no"))));
    assert_eq!(refused(&plc, with(cancels)), Status::Cancelled);
    let token = CancelToken::new();
    let other = token.clone();
    let late = SizeFunction::new(move |_| {
        other.cancel();
        Ok(0.01)
    });
    let options = Options { size_function: Some(late), cancel: Some(token), ..Options::default() };
    assert_eq!(refused(&plc, options), Status::Cancelled);
}

#[test]
fn points_inside_count_as_steiner_points() {
    let plc = grid_box(3);
    let options = Options { size: Some(0.1), steiner_limit: Some(50), ..Options::default() };
    assert_eq!(refused(&plc, options), Status::SteinerLimit);
}

/// Coordinates far from one: sizes, volumes and functions are the caller's.
#[test]
fn all_of_it_scales() {
    let plc = grid_box(3);
    for exponent in [-700, -80, 90, 700] {
        let unit = crate::elementary::power_of_two(exponent);
        let mut other = grid_box(3);
        other.points.iter_mut().flatten().for_each(|x| *x *= unit);
        let of = |plc: &Plc, unit: f64| {
            let function =
                SizeFunction::new(move |p| Ok(if p[0] < unit { 0.5 * unit } else { f64::INFINITY }));
            let options = Options {
                size: Some(0.9 * unit),
                size_function: Some(function),
                optimize: 1,
                ..Options::default()
            };
            mesh(plc, options)
        };
        let (near, far) = (of(&plc, 1.0), of(&other, unit));
        assert_eq!(near.tets.len(), far.tets.len(), "{exponent}");
    }
}

/// A wish far below what doubles can tell apart ends with a status, not with a mesh for ever.
#[test]
fn absurd_sizes_end() {
    let plc = grid_box(1);
    for size in [1e-300, 1e-12] {
        let options = Options { size: Some(size), ..Options::default() };
        assert_eq!(refused(&plc, options), Status::TooLarge, "{size}");
    }
    let options = Options { max_volume: Some(1e-40), ..Options::default() };
    assert_eq!(refused(&plc, options), Status::TooLarge);
    let huge = mesh(&plc, Options { size: Some(1e300), max_volume: Some(1e300), ..Options::default() });
    check_preserved(&plc, &huge, 10).unwrap();
}
