use crate::fill::tests::grid_box;
use crate::options::{Mode, Options};
use crate::plc::{Facet, Plc};
use crate::progress::Silent;
use crate::query::quality::TetQuality;
use crate::size::{distance, volume};
use crate::vector::{cross, dot, sub};
use crate::{check_guarantee, check_mesh, tetrahedralize, Guarantee, RegionSeed, Segment, Status, TetMesh};

/// A box of six squares.
pub(crate) fn cuboid(plc: &mut Plc, low: [f64; 3], high: [f64; 3]) {
    let first = plc.points.len() as u32;
    for i in 0..8 {
        plc.points.push([0, 1, 2].map(|k| if i >> k & 1 == 1 { high[k] } else { low[k] }));
    }
    for k in 0..3 {
        let (i, j) = (1u32 << ((k + 1) % 3), 1u32 << ((k + 2) % 3));
        for start in [first, first + (1 << k)] {
            let polygons = vec![vec![start, start + i, start + i + j, start + j]];
            plc.facets.push(Facet { polygons, ..Facet::default() });
        }
    }
}

fn unit_cube() -> Plc {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [1.0; 3]);
    plc
}

/// Squares that are planar only up to rounding, as triangles.
fn as_triangles(plc: &mut Plc) {
    plc.triangles = plc
        .facets
        .iter()
        .flat_map(|f| {
            let q = &f.polygons[0];
            [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
        })
        .collect();
    plc.facets.clear();
}

/// The mesh, which is constrained Delaunay, or valid if it was optimised.
fn mesh(plc: &Plc, options: &Options) -> TetMesh {
    let mesh = tetrahedralize(plc, options, &mut Silent).unwrap();
    check_guarantee(plc, &mesh, 10).unwrap();
    assert_eq!(mesh.guarantee == Guarantee::Conforming, options.optimize > 0);
    mesh
}

fn shaped(ratio: f64) -> Options {
    Options { quality: Some(ratio), ..Options::default() }
}

fn ratios(mesh: &TetMesh) -> Vec<f64> {
    let of = |t: &[u32; 4]| TetQuality::of(t.map(|v| mesh.points[v as usize])).radius_edge;
    mesh.tets.iter().map(of).collect()
}

fn volumes(mesh: &TetMesh) -> f64 {
    mesh.tets.iter().map(|t| volume(t.map(|v| &mesh.points[v as usize]))).sum()
}

/// A box twenty times as long as it is thick.
#[test]
fn a_beam_gets_the_ratio_all_along() {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [20.0, 1.0, 1.0]);
    let beam = mesh(&plc, &shaped(1.414));
    // Without points along it, the ratio of all is above ten.
    let above = ratios(&beam).into_iter().filter(|&ratio| ratio > 1.414).count();
    assert!(4 * above <= beam.tets.len(), "{above} of {}", beam.tets.len());
    assert!(ratios(&beam).into_iter().all(|ratio| ratio < 4.0));
    assert!((volumes(&beam) - 20.0).abs() < 1e-9);
    assert!(beam.steiner.iter().filter(|p| p.is_on_edge()).count() > 20);
    // The corners of the beam are on a grid, and all else is in planes normal to an axis.
    assert!(beam.steiner.iter().all(|p| p.exact));
}

/// Where planes are no planes of doubles, points have frames; the check sees them in their planes.
#[test]
fn points_lie_exactly_on_slanted_facets() {
    let mut plc = unit_cube();
    for p in &mut plc.points {
        let [x, y, z] = *p;
        *p = [x + 0.1 * y, y + 0.3 * z, z + 0.7 * x].map(|x| x * 0.1);
    }
    as_triangles(&mut plc);
    let fine = mesh(&plc, &Options { size: Some(0.03), ..shaped(1.5) });
    let on_facets: Vec<_> = fine.steiner.iter().filter(|p| p.facet != crate::INVALID).collect();
    assert!(on_facets.len() > 10, "{}", on_facets.len());
    assert!(on_facets.iter().any(|p| p.third != crate::INVALID));
    // Without its position such a point is not on its facet.
    let mut lost = fine.try_clone().unwrap();
    for p in lost.steiner.iter_mut().filter(|p| p.third != crate::INVALID) {
        p.third = (0..8).rfind(|v| !p.ends.contains(v) && *v != p.third).unwrap();
    }
    assert_eq!(check_mesh(&plc, &lost, false, 10).unwrap_err().status, Status::CheckFailed);
    let optimised = mesh(&plc, &Options { size: Some(0.03), optimize: 1, ..shaped(1.5) });
    assert!(optimised.steiner.iter().any(|p| p.third != crate::INVALID));
}

/// The sides of a slanted plate are a few hundred units in the last place apart: with points on both, rounding would make flat tetrahedra. No
/// such point comes, so rounding has nothing to mend, and the surface need not be kept.
#[test]
fn points_on_facets_leave_nothing_to_mend_to_rounding() {
    for thickness in [1e-13, 1e-14, 5e-15] {
        let mut plc = unit_cube();
        for p in &mut plc.points {
            let [x, y, z] = [p[0], p[1], p[2] * thickness];
            *p = [x + 0.1 * y + 0.2 * z, y + 0.3 * z - 0.2 * x, z + 0.7 * x + 0.4 * y].map(|x| x * 0.1);
        }
        as_triangles(&mut plc);
        let plate = mesh(&plc, &Options { size: Some(0.02), ..shaped(1.5) });
        let on_facets = plate.steiner.iter().filter(|p| p.facet != crate::INVALID).count();
        assert!(on_facets > 100, "{thickness:e}: {on_facets}");
        assert_eq!([plate.statistics.steiner_moved, plate.statistics.replaced], [0, 0], "{thickness:e}");
    }
}

/// What no theory promises ends as well, and fewer are above it.
#[test]
fn the_least_ratio_ends() {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [5.0, 1.1, 0.7]);
    let above = |ratio| {
        let ratios = ratios(&mesh(&plc, &shaped(ratio)));
        ratios.iter().filter(|&&ratio| ratio > 1.0).count() as f64 / ratios.len() as f64
    };
    assert!(above(1.0) < above(1.414), "{} {}", above(1.0), above(1.414));
    for mode in [Mode::Constrained, Mode::Preserve] {
        let [coarse, fine] = [1.414, 1.0].map(|ratio| mesh(&grid_box(3), &Options { mode, ..shaped(ratio) }));
        assert!(fine.tets.len() >= coarse.tets.len() && fine.tets.len() < 100 * coarse.tets.len());
    }
}

/// No tetrahedron is above the bound, edges have about the length that is asked for.
#[test]
fn sizes_and_volumes_are_kept_on_the_surface_too() {
    for optimize in [0, 1] {
        let bound = 0.001;
        let made = mesh(&unit_cube(), &Options { max_volume: Some(bound), optimize, ..shaped(1.5) });
        let largest =
            made.tets.iter().map(|t| volume(t.map(|v| &made.points[v as usize]))).fold(0.0, f64::max);
        assert!(largest <= bound, "{largest}");
    }
    let count = |size| mesh(&unit_cube(), &Options { size: Some(size), ..shaped(1.5) }).tets.len();
    let (coarse, fine) = (count(0.2), count(0.1));
    assert!(fine > 5 * coarse && fine < 12 * coarse, "{coarse} {fine}");
}

/// Two regions, a sheet inside, a sheet outside, a segment inside and one that is half outside.
#[test]
fn everything_that_is_split_stays_a_union() {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [4.0, 2.0, 2.0]);
    let sheet = |plc: &mut Plc, corners: &[[f64; 3]], marker| {
        let polygon: Vec<u32> = corners
            .iter()
            .map(|p| {
                let known = plc.points.iter().position(|q| q == p);
                known.unwrap_or_else(|| {
                    plc.points.push(*p);
                    plc.points.len() - 1
                }) as u32
            })
            .collect();
        plc.facets.push(Facet { polygons: vec![polygon], marker, ..Facet::default() });
    };
    sheet(&mut plc, &[[2.0, 0.0, 0.0], [2.0, 2.0, 0.0], [2.0, 2.0, 2.0], [2.0, 0.0, 2.0]], 5);
    sheet(&mut plc, &[[0.5, 0.5, 1.0], [1.5, 0.5, 1.0], [1.5, 1.5, 1.0], [0.5, 1.5, 1.0]], 6);
    sheet(&mut plc, &[[0.0, 0.0, 2.0], [4.0, 0.0, 2.0], [4.0, 0.0, 3.0], [0.0, 0.0, 3.0]], 7);
    let ends = [[3.0, 1.0, 0.5], [3.0, 1.0, 1.5], [3.0, 0.5, 1.0], [5.0, 0.5, 1.25]];
    plc.points.extend(ends);
    let last = plc.points.len() as u32;
    plc.segments = vec![Segment { ends: [last - 4, last - 3], marker: 8 }];
    plc.regions = vec![
        RegionSeed { point: [1.0, 1.0, 0.25], attribute: 1.0, max_volume: Some(0.01) },
        RegionSeed { point: [3.5, 1.0, 1.0], attribute: 2.0, max_volume: None },
    ];
    for optimize in [0, 1] {
        let made = mesh(&plc, &Options { optimize, ..shaped(1.5) });
        let tets = |region: f64| {
            let of = |r: &&u32| made.regions[**r as usize].attribute == region;
            made.tet_region.iter().filter(of).count()
        };
        assert!(tets(1.0) > 2 * tets(2.0), "{} {}", tets(1.0), tets(2.0));
        for marker in [5, 6] {
            assert!(made.subfaces.iter().filter(|face| face.marker == marker).count() > 8);
        }
        // Its edge on the box was split.
        assert!(made.unmeshed_subfaces.iter().filter(|face| face.marker == 7).count() > 2);
        assert!((volumes(&made) - 16.0).abs() < 1e-9);
    }
}

/// A wedge between two squares at an angle, to which nothing forces a good shape.
fn wedge(height: f64) -> Plc {
    Plc {
        points: vec![
            [0.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [1.0, 0.0, height],
            [1.0, 1.0, height],
        ],
        facets: [vec![0, 1, 3, 2], vec![0, 1, 5, 4], vec![2, 3, 5, 4], vec![0, 2, 4], vec![1, 3, 5]]
            .map(|polygon| Facet { polygons: vec![polygon], ..Facet::default() })
            .into(),
        ..Plc::default()
    }
}

/// Angles of 10°, 1°, 0.1° and 0.01°: points stay in proportion.
#[test]
fn small_angles_end() {
    let counts =
        [0.176, 0.0175, 0.00175, 0.000175].map(|height| mesh(&wedge(height), &shaped(1.414)).tets.len());
    assert!(counts.iter().all(|&n| n < 20_000), "{counts:?}");
    // Facets a millionth apart, finer and finer sheets.
    let mut plate = Plc::default();
    cuboid(&mut plate, [0.0; 3], [1.0, 1.0, 1e-6]);
    let count = mesh(&plate, &shaped(1.414)).tets.len();
    assert!(count < 20_000, "{count}");
}

/// A fan of facets at one segment, and segments at one point.
#[test]
fn fans_end() {
    let mut fan = Plc::default();
    cuboid(&mut fan, [-2.0, -2.0, -1.0], [2.0, 2.0, 2.0]);
    let axis = fan.points.len() as u32;
    fan.points.extend([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0]]);
    for i in 0..100u32 {
        // On a square round the axis: no sines.
        let side = f64::from(i % 25) / 25.0 * 2.0 - 1.0;
        let [x, y] = [[side, -1.0], [1.0, side], [-side, 1.0], [-1.0, -side]][(i / 25) as usize];
        fan.points.extend([[x, y, 0.0], [x, y, 1.0]]);
        let first = axis + 2 + 2 * i;
        fan.facets.push(Facet { polygons: vec![vec![axis, first, first + 1, axis + 1]], ..Facet::default() });
    }
    let made = mesh(&fan, &shaped(1.5));
    assert!(made.tets.len() < 200_000, "{}", made.tets.len());
    let mut star = unit_cube();
    for i in 0..50u32 {
        let [x, y] = [f64::from(i % 7), f64::from(i / 7)].map(|x| 0.1 + 0.1 * x);
        star.points.push([x, y, 0.75]);
        star.segments.push(Segment { ends: [58, 8 + i], marker: 1 });
    }
    star.points.push([0.5, 0.5, 0.25]);
    let made = mesh(&star, &shaped(1.5));
    assert!(made.tets.len() < 200_000, "{}", made.tets.len());
}

/// What has no points to gain stays as it is; nonsense is refused; the same input makes the same mesh, with any number of threads.
#[test]
fn the_same_input_makes_the_same_mesh() {
    let plc = grid_box(2);
    let options = Options { size: Some(0.4), optimize: 1, ..shaped(1.5) };
    let (one, other) = (mesh(&plc, &options), mesh(&plc, &Options { threads: 3, ..options.copied() }));
    assert!(one.tets == other.tets && one.points == other.points && one.steiner == other.steiner);
    let absurd = Options { size: Some(1e-7), ..Options::default() };
    assert_eq!(tetrahedralize(&plc, &absurd, &mut Silent).unwrap_err().status, Status::TooLarge);
    let exact = Options { exact_form: true, optimize: 1, ..Options::default() };
    assert_eq!(tetrahedralize(&plc, &exact, &mut Silent).unwrap_err().status, Status::InvalidArgument);
    let few = Options { steiner_limit: Some(50), ..options.copied() };
    assert_eq!(tetrahedralize(&plc, &few, &mut Silent).unwrap_err().status, Status::SteinerLimit);
}

/// The hull is not split where no facet is.
#[test]
fn a_kept_hull_is_filled() {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [1.0; 3]);
    plc.points.extend([[3.0, 0.5, 0.5], [-2.0, 0.25, 0.5]]);
    mesh(&plc, &Options { keep_hull: true, ..shaped(1.5) });
    mesh(&plc, &Options { keep_hull: true, size: Some(0.3), optimize: 1, ..shaped(1.5) });
}

/// Points alone, whose hull is kept.
#[test]
fn a_hull_without_facets_is_filled() {
    let points = vec![[0.0, 2.0, 0.0], [0.0; 3], [0.0, 0.0, 2.0], [1.0, 0.0, 0.0]];
    let plc = Plc { points, ..Plc::default() };
    for optimize in [0, 1] {
        mesh(&plc, &Options { keep_hull: true, size: Some(0.5), gradation: 1.0, optimize, ..shaped(2.0) });
    }
}

/// A limit on added points counts those on the surface and those inside, whichever stage puts them there.
#[test]
fn a_limit_counts_all_points() {
    let outcome = |limit, optimize| {
        let options = Options { size: Some(0.25), steiner_limit: Some(limit), optimize, ..shaped(1.5) };
        tetrahedralize(&unit_cube(), &options, &mut Silent)
    };
    for optimize in [0, 1] {
        let all = outcome(u64::MAX, optimize).unwrap().steiner;
        let surface = all.iter().filter(|point| !point.is_inside()).count() as u64;
        assert!(surface > 20 && (all.len() as u64) > surface + 5);
        for limit in (0..3 * all.len() as u64 / 2).step_by(7) {
            match outcome(limit, optimize) {
                Ok(mesh) => assert!(mesh.steiner.len() as u64 <= limit),
                Err(error) => assert_eq!(error.status, Status::SteinerLimit),
            }
        }
        assert!(outcome(surface + 1, 0).is_err());
        assert!(outcome(2 * all.len() as u64, optimize).is_ok());
    }
}

/// Where facets have an area or a length, all of their subfaces have it, also far from the edges, and others are larger.
#[test]
fn subfaces_are_as_small_as_their_facets_ask() {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [8.0, 8.0, 2.0]);
    plc.facets[4].marker = 3;
    assert!(plc.facets[4].polygons[0].iter().all(|&v| plc.points[v as usize][2] == 0.0));
    let largest = |plc: &Plc, optimize, of: &dyn Fn(&[[f64; 3]; 3]) -> f64| {
        let made = mesh(plc, &Options { optimize, gradation: 1.0, ..shaped(2.0) });
        [3, 0].map(|marker| {
            let own = made.subfaces.iter().filter(|face| face.marker == marker);
            own.map(|face| of(&face.corners.map(|v| made.points[v as usize]))).fold(0.0, f64::max)
        })
    };
    let area = |[x, y, z]: &[[f64; 3]; 3]| {
        let n = cross(&sub(y, x), &sub(z, x));
        0.5 * dot(&n, &n).sqrt()
    };
    let edge = |[x, y, z]: &[[f64; 3]; 3]| distance(x, y).max(distance(y, z)).max(distance(z, x));
    for optimize in [0, 1] {
        plc.sizes.set_facet_areas(3, 0.125).unwrap();
        let [own, others] = largest(&plc, optimize, &area);
        assert!(own <= 0.125 && others > 0.25, "{own} {others}");
        plc.sizes.set_facet_areas(3, f64::INFINITY).unwrap();
        plc.sizes.set_facets(3, 0.5).unwrap();
        let [own, others] = largest(&plc, optimize, &edge);
        // No circumradius is above 0.95 of the length.
        assert!(own <= 0.95 && others > 1.0, "{own} {others}");
        plc.sizes.set_facets(3, 1e-7).unwrap();
        let absurd = tetrahedralize(&plc, &shaped(2.0), &mut Silent).unwrap_err();
        assert_eq!(absurd.status, Status::TooLarge, "{absurd}");
        plc.sizes.set_facets(3, f64::INFINITY).unwrap();
        assert!(largest(&plc, optimize, &edge)[0] > 1.0);
    }
}

/// A limit on tetrahedra allows as many as there come, and no less; what would be too many ends early.
#[test]
fn a_limit_counts_all_tetrahedra() {
    for (mode, optimize) in
        [(Mode::Constrained, 0), (Mode::Preserve, 0), (Mode::Constrained, 1), (Mode::Preserve, 1)]
    {
        let outcome = |limit| {
            let options =
                Options { size: Some(0.25), tetrahedra_limit: Some(limit), optimize, mode, ..shaped(1.5) };
            tetrahedralize(&unit_cube(), &options, &mut Silent)
        };
        let all = outcome(u64::MAX).unwrap();
        let count = all.tets.len() as u64;
        assert!(count > 50, "{count}");
        for limit in (0..2 * count).step_by(1 + count as usize / 8).chain([count - 1, count]) {
            match outcome(limit) {
                Ok(mesh) => assert!(mesh.tets.len() as u64 <= limit),
                Err(error) => assert_eq!(error.status, Status::TetrahedraLimit),
            }
        }
        assert!(outcome(count / 2).unwrap_err().message.contains("reached in phase refine"));
        if optimize == 0 {
            assert!(outcome(count).unwrap().tets == all.tets && outcome(count - 1).is_err());
        }
    }
}

/// Points are counted by where they are and by what they came for; the sums are those of the mesh.
#[test]
fn statistics_add_up_to_the_points_of_the_mesh() {
    let mut plc = Plc::default();
    cuboid(&mut plc, [0.0; 3], [6.0, 1.0, 0.8]);
    cuboid(&mut plc, [0.5, 0.3, 0.3], [1.5, 0.6, 0.6]);
    let wanted = [
        shaped(1.414),
        Options { size: Some(0.3), ..Options::default() },
        Options { max_volume: Some(0.01), ..Options::default() },
        Options { size: Some(0.4), max_volume: Some(0.01), ..shaped(1.5) },
    ];
    for (options, optimize, mode) in wanted.iter().flat_map(|options| {
        [(0, Mode::Constrained), (1, Mode::Constrained), (0, Mode::Preserve), (1, Mode::Preserve)]
            .map(|(optimize, mode)| (options, optimize, mode))
    }) {
        let options = Options { optimize, mode, ..options.clone() };
        let mesh = tetrahedralize(&plc, &options, &mut Silent).unwrap();
        let statistics = &mesh.statistics;
        let (refine, done) = (&statistics.refine, &statistics.optimize);
        assert!(refine.points() > 0 && refine.points() == refine.for_sizes + refine.for_shapes, "{refine:?}");
        let count =
            |f: &dyn Fn(&crate::SteinerPoint) -> bool| mesh.steiner.iter().filter(|p| f(p)).count() as u64;
        assert_eq!(count(&|p| p.is_on_edge()), statistics.steiner + refine.on_segments);
        assert_eq!(count(&|p| p.facet != crate::INVALID), refine.on_facets);
        let inside = refine.inside + statistics.preserve.interior + done.points_added;
        assert_eq!(count(&|p| p.is_inside()) + done.points_removed, inside);
        assert_eq!(mode == Mode::Preserve, refine.on_segments + refine.on_facets == 0);
        // A mesh that was not optimised has none of it; one that was has the angle that is measured.
        assert_eq!(optimize == 0, *done == crate::OptimizeStatistics::default());
        if optimize > 0 {
            let of = |t: &[u32; 4]| TetQuality::of(t.map(|v| mesh.points[v as usize]));
            let worst = |q: TetQuality| q.min_dihedral().min(180.0 - q.max_dihedral());
            let worst = mesh.tets.iter().map(|t| worst(of(t))).fold(90.0, f64::min);
            assert!((worst - done.worst_after).abs() < 1e-6, "{worst} {done:?}");
            assert!(done.worst_after >= done.worst_before && done.passes >= 2, "{done:?}");
            assert!(done.moves > 0 && done.edges_removed + done.faces_removed > 0, "{done:?}");
        }
        // The same in every run.
        let again = tetrahedralize(&plc, &options, &mut Silent).unwrap().statistics;
        assert_eq!((again.refine, again.optimize), (*refine, *done));
    }
    let none = mesh(&plc, &Options::default()).statistics;
    assert_eq!((none.refine, none.optimize), Default::default());
}
