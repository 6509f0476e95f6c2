//! Known shapes, all scales, any order, and wedges.
use super::*;
use crate::query::tests::grid;
use crate::query::EDGE_ENDS;
use crate::{tetrahedralize, Mode, Options, Plc, Silent, INVALID};

const REGULAR: [[f64; 3]; 4] = [[1.0, 1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0], [-1.0, -1.0, 1.0]];
const CORNER: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

fn near(a: f64, b: f64, error: f64) -> bool {
    (a - b).abs() <= error * b.abs()
}

/// A generator of numbers from 0 to 1.
struct Numbers(u64);

impl Numbers {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / 2f64.powi(53)
    }

    fn point(&mut self) -> [f64; 3] {
        [self.next(), self.next(), self.next()]
    }
}

#[test]
fn known_shapes_have_known_measures() {
    let regular = TetQuality::of(REGULAR);
    assert!(regular.dihedrals.iter().all(|&angle| near(angle, 70.528_779_365_509_31, 1e-15)), "{regular:?}");
    assert!(near(regular.radius_edge, 0.612_372_435_695_794_5, 1e-15) && near(regular.eta, 1.0, 1e-15));
    assert!(near(regular.volume, 8.0 / 3.0, 1e-15));

    let corner = TetQuality::of(CORNER);
    let slanted = 54.735_610_317_245_346;
    for (angle, known) in corner.dihedrals.into_iter().zip([90.0, 90.0, 90.0, slanted, slanted, slanted]) {
        assert!(near(angle, known, 1e-15), "{corner:?}");
    }
    assert!(near(corner.radius_edge, 0.75f64.sqrt(), 1e-15) && near(corner.volume, 1.0 / 6.0, 1e-15));
    assert!(near(corner.eta, 12.0 * 0.25f64.cbrt() / 9.0, 1e-14));

    // A path of three edges of a cube: 45, 60 and 90 degrees.
    let path = TetQuality::of([[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [1.0; 3]]);
    for (angle, known) in path.dihedrals.into_iter().zip([45.0, 90.0, 60.0, 90.0, 90.0, 45.0]) {
        assert!(near(angle, known, 1e-15), "{path:?}");
    }
}

/// The tetrahedron with these corners, the last two swapped if that makes it positive.
fn positive([a, b, c, d]: [[f64; 3]; 4]) -> TetQuality {
    let quality = TetQuality::of([a, b, c, d]);
    if quality.volume > 0.0 {
        quality
    } else {
        TetQuality::of([a, b, d, c])
    }
}

/// Two crossing diagonals of a square, `h` apart: all measures have closed forms.
#[test]
fn slivers_keep_their_digits() {
    for h in [1e-1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15, 1e-100] {
        let sliver = positive([[1.0, 0.0, h], [-1.0, 0.0, h], [0.0, 1.0, 0.0], [0.0, -1.0, 0.0]]);
        // The faces at a diagonal fall off to both sides with slope h; those at a side have normals (0, h, 1) and (h, 0, -1).
        let diagonal = 180.0 - 2.0 * h.atan().to_degrees();
        let side = (h * (2.0 + h * h).sqrt()).atan().to_degrees();
        for (angle, known) in sliver.dihedrals.into_iter().zip([diagonal, side, side, side, side, diagonal]) {
            assert!(near(angle, known, 1e-13), "{h}: {sliver:?}");
        }
        // The centre is half way up.
        let ratio = ((1.0 + 0.25 * h * h) / (2.0 + h * h)).sqrt();
        assert!(near(sliver.radius_edge, ratio, 1e-13), "{h}: {sliver:?}");
        assert!(near(sliver.volume, 4.0 * h / 6.0, 1e-13), "{h}: {sliver:?}");
    }
}

/// On both sides of the threshold below which sums are exact.
#[test]
fn exact_sums_agree_with_rounded_ones() {
    let mut numbers = Numbers(7);
    for i in 0..400 {
        let height = 2f64.powf(-40.0 * numbers.next());
        let mut corners = [numbers.point(), numbers.point(), numbers.point(), numbers.point()];
        corners.iter_mut().for_each(|p| p[2] *= height);
        let quality = positive(corners);
        let exact = exact_volume(corners).abs();
        assert!(near(quality.volume, exact, 1e-9), "{i}: {quality:?} {exact}");
        let sum: f64 = quality.dihedrals.iter().sum();
        assert!(sum > 360.0 - 1e-9 && sum < 540.0 + 1e-9, "Gaddum's bounds: {sum}");
    }
}

/// Six times the volume by rational numbers, as a double, over six.
fn exact_volume(corners: [[f64; 3]; 4]) -> f64 {
    use num_rational::BigRational;
    use num_traits::ToPrimitive;
    let [a, b, c, d] = corners.map(|p| p.map(|x| BigRational::from_float(x).unwrap()));
    let minus = |p: &[BigRational; 3]| [0, 1, 2].map(|k| &p[k] - &a[k]);
    let [u, v, w] = [minus(&b), minus(&c), minus(&d)];
    let minor = |i: usize, j: usize| &v[i] * &w[j] - &v[j] * &w[i];
    let det = &u[0] * minor(1, 2) + &u[1] * minor(2, 0) + &u[2] * minor(0, 1);
    det.to_f64().unwrap() / 6.0
}

#[test]
fn scale_changes_nothing_but_the_volume() {
    let skew = [[0.1, 0.2, 0.3], [1.3, 0.1, 0.2], [0.4, 1.7, 0.1], [0.2, 0.6, 0.9]];
    let flat = [[0.0, 0.0, 0.0], [1.0, 0.0, 1e-11], [0.0, 1.0, 0.0], [1.0, 1.0, 1.0 / 1048576.0 / 3.0]];
    for corners in [REGULAR, CORNER, skew, flat] {
        let known = TetQuality::of(corners);
        assert!(known.volume > 0.0);
        for k in [-900, -300, 300, 900, 1020] {
            let size = 2f64.powi(k);
            let scaled = TetQuality::of(corners.map(|p| p.map(|x| x * size)));
            assert_eq!(TetQuality { volume: known.volume, ..scaled }, known, "2^{k}");
        }
        for size in [1e-100, 1e100, 1e150, 1e307] {
            let scaled = TetQuality::of(corners.map(|p| p.map(|x| x * size)));
            for (measure, error) in Measure::ALL.into_iter().zip([1e-8; 4]) {
                assert!(near(scaled.by(measure), known.by(measure), error), "{size}: {scaled:?}");
            }
            assert!(scaled.volume.is_finite() && scaled.volume > 0.0);
        }
        let volume = TetQuality::of(corners.map(|p| p.map(|x| x * 1e-100))).volume;
        assert!(near(volume * 1e300, known.volume, 1e-8), "{volume:e}");
    }
    let huge = TetQuality::of(REGULAR.map(|p| p.map(|x| x * f64::MAX)));
    assert!(huge.volume == f64::MAX && near(huge.eta, 1.0, 1e-15), "{huge:?}");
    let tiny = TetQuality::of(REGULAR.map(|p| p.map(|x| x * 5e-324)));
    assert!(tiny.volume == 0.0 && near(tiny.eta, 1.0, 1e-15), "{tiny:?}");
}

#[test]
fn what_is_not_positive_counts_as_flat() {
    let [a, b, c, d] = CORNER;
    let inverted = TetQuality::of([b, a, c, d]);
    assert!(near(inverted.volume, -1.0 / 6.0, 1e-15));
    let flat = [[a, b, c, [1.0, 1.0, 0.0]], [a, b, b, d], [a; 4], [a, b, c, [f64::NAN, 0.0, 0.0]]];
    let more = [[a, b, c, [f64::INFINITY; 3]], [[0.1; 3], [0.2; 3], [0.3; 3], [0.7; 3]]];
    for quality in flat.into_iter().chain(more).map(TetQuality::of).chain([inverted]) {
        assert_eq!(quality.dihedrals, [0.0, 0.0, 0.0, 180.0, 180.0, 180.0]);
        assert_eq!((quality.radius_edge, quality.eta), (f64::INFINITY, 0.0));
        assert!(quality.volume <= 0.0);
    }
}

/// The same bits whatever the order of the corners, those of an inverted tetrahedron excepted.
#[test]
fn the_order_of_corners_changes_no_bit() {
    let mut numbers = Numbers(3);
    for i in 0..200 {
        let mut corners = [numbers.point(), numbers.point(), numbers.point(), numbers.point()];
        if i % 4 == 0 {
            // Flat ones take the exact way, and shared coordinates test the order.
            corners.iter_mut().for_each(|p| p[2] *= 1e-7);
        }
        if i % 5 == 0 {
            corners[2][0] = corners[1][0];
        }
        if TetQuality::of(corners).volume <= 0.0 {
            corners.swap(0, 1);
        }
        let known = TetQuality::of(corners);
        assert!(known.volume > 0.0);
        for turn in [[1, 2, 0, 3], [0, 2, 3, 1], [3, 2, 1, 0], [1, 0, 3, 2], [2, 3, 0, 1]] {
            let turned = TetQuality::of(turn.map(|i| corners[i]));
            let places = EDGE_ENDS.map(|[i, j]| {
                let ends = [turn[i].min(turn[j]), turn[i].max(turn[j])];
                EDGE_ENDS.iter().position(|&edge| edge == ends).unwrap()
            });
            assert_eq!(turned.dihedrals, places.map(|edge| known.dihedrals[edge]));
            assert_eq!(TetQuality { dihedrals: known.dihedrals, ..turned }, known);
        }
    }
}

#[test]
fn bins_are_in_order_and_have_names() {
    for measure in Measure::ALL {
        let edges = measure.bin_edges();
        assert!(edges.windows(2).all(|pair| pair[0] < pair[1]));
        for bin in 0..BINS {
            assert_eq!(measure.bin(edges[bin]), bin);
            let name = measure.bin_name(bin);
            let digits =
                |x: f64| if x == std::f64::consts::SQRT_2 { "1.414".to_string() } else { x.to_string() };
            assert_eq!(
                name,
                match bin {
                    0 => format!("below {}", digits(edges[1])),
                    9 => format!("from {}", digits(edges[9])),
                    _ => format!("{} to {}", digits(edges[bin]), digits(edges[bin + 1])),
                }
            );
        }
        assert_eq!((measure.bin_name(BINS), measure.bin(-1.0), measure.bin(f64::INFINITY)), ("", 0, 9));
    }
}

/// The mesh of a wedge of `degrees`: a triangle, extruded in two steps. Points 0, 3 and 6 are on the sharp edge.
fn wedge(degrees: f64, mode: Mode) -> (Plc, TetMesh) {
    let (sine, cosine) = degrees.to_radians().sin_cos();
    let section = [[0.0, 0.0], [2.0, 0.0], [2.0 * cosine, 2.0 * sine]];
    let mut points = Vec::new();
    for z in [0.0, 0.3, 0.7] {
        points.extend(section.map(|p| [p[0], p[1], z]));
    }
    let quad =
        |i: u32, j: u32, low: u32| [[low + i, low + j, low + j + 3], [low + i, low + j + 3, low + i + 3]];
    let mut triangles = vec![[0, 2, 1], [6, 7, 8]];
    for low in [0, 3] {
        triangles.extend([quad(0, 1, low), quad(1, 2, low), quad(2, 0, low)].into_iter().flatten());
    }
    let plc = Plc { points, triangles, ..Plc::default() };
    let mesh = tetrahedralize(&plc, &Options { mode, ..Options::default() }, &mut Silent).unwrap();
    (plc, mesh)
}

#[test]
fn tetrahedra_in_a_narrow_wedge_are_forced_by_its_two_facets() {
    for mode in [Mode::Constrained, Mode::Preserve] {
        let (plc, mesh) = wedge(10.0, mode);
        let forced = forced_tets(&mesh).unwrap();
        assert!(!forced.is_empty() && forced.windows(2).all(|pair| pair[0].tet < pair[1].tet));
        let on_edge = |c: u32| c < 9 && c % 3 == 0;
        let sharp = |facet: u32, i: u32| {
            let corners = plc.triangles[facet as usize];
            corners.iter().any(|&c| on_edge(c)) && corners.iter().all(|&c| on_edge(c) || c % 3 == i)
        };
        for f in &forced {
            let [a, b] = f.facets;
            assert!((sharp(a, 1) && sharp(b, 2)) || (sharp(a, 2) && sharp(b, 1)), "{f:?}");
            assert!(f.ends.iter().all(|&end| on_edge(end)) && near(f.angle, 10.0, 1e-12), "{f:?}");
            assert!(TetQuality::of_tet(&mesh, &mesh.tets[f.tet as usize]).min_dihedral() < 10.0 + 1e-9);
        }
        // Exactly the tetrahedra with an edge on the sharp one.
        let touches = |tet: &[u32; 4]| tet.iter().filter(|&&c| on_edge(c)).count() > 1;
        let expected: Vec<u32> =
            (0..).zip(&mesh.tets).filter(|(_, tet)| touches(tet)).map(|(i, _)| i).collect();
        assert_eq!(forced.iter().map(|f| f.tet).collect::<Vec<_>>(), expected);
        let summary = QualitySummary::new(&mesh, &forced);
        assert_eq!(summary.forced_count as usize, forced.len());
        assert!(summary.all.worst[0] < 10.0 + 1e-9);
    }
    assert_eq!(forced_tets(&wedge(30.1, Mode::Constrained).1).unwrap(), []);
    assert!(!forced_tets(&wedge(29.9, Mode::Constrained).1).unwrap().is_empty());
}

/// Histograms count every tetrahedron once, and those left out are the forced ones.
#[test]
fn histograms_add_up() {
    let mut meshes = vec![grid(3), wedge(10.0, Mode::Constrained).1, TetMesh::default()];
    meshes[0].points[21][0] += 0.9;
    for mesh in &meshes {
        let forced = forced_tets(mesh).unwrap();
        let summary = QualitySummary::new(mesh, &forced);
        let qualities = tet_qualities(mesh).unwrap();
        assert_eq!((summary.tet_count as usize, qualities.len()), (mesh.tets.len(), mesh.tets.len()));
        for (i, measure) in Measure::ALL.into_iter().enumerate() {
            let (all, unforced) = (summary.all, summary.unforced);
            assert_eq!(all.histograms[i].iter().sum::<u64>(), summary.tet_count);
            assert_eq!(unforced.histograms[i].iter().sum::<u64>(), summary.tet_count - summary.forced_count);
            let mut order: Vec<u32> = (0..mesh.tets.len() as u32).collect();
            let of = |tet: u32| measure.badness(qualities[tet as usize].by(measure));
            order.sort_by(|&a, &b| of(b).total_cmp(&of(a)).then(a.cmp(&b)));
            let mut worst = vec![9; mesh.tets.len() + 2];
            assert_eq!(worst_tets(mesh, measure, &[], &mut worst).unwrap(), mesh.tets.len());
            assert_eq!(worst[..mesh.tets.len()], order);
            assert!(worst[mesh.tets.len()..].iter().all(|&tet| tet == INVALID));
            let mut few = [0; 5];
            let count = worst_tets(mesh, measure, &[], &mut few).unwrap();
            assert_eq!(few[..count], order[..count]);
            assert_eq!(all.worst_tet[i], order.first().copied().unwrap_or(INVALID));
            order.retain(|tet| !forced.iter().any(|f| f.tet == *tet));
            assert_eq!(worst_tets(mesh, measure, &forced, &mut worst).unwrap(), order.len());
            assert_eq!(worst[..order.len()], order);
            assert_eq!(unforced.worst_tet[i], order.first().copied().unwrap_or(INVALID));
        }
        assert_eq!(worst_tets(mesh, Measure::Eta, &[], &mut []).unwrap(), 0);
    }
}

/// Histograms and worst values are those of the measures, also where bins are told without them: random, flat, equal and inverted tetrahedra,
/// regular ones and corners (on edges of bins, and tied), of all sizes.
#[test]
fn figures_are_those_of_the_measures() {
    let mut numbers = Numbers(9);
    let mut mesh = TetMesh::default();
    for i in 0..6000 {
        let mut corners = match i % 8 {
            0 => REGULAR,
            1 => CORNER,
            _ => [(); 4].map(|()| numbers.point()),
        };
        let flat = 10f64.powi(-(i % 40) / 2);
        let size = [1.0, 1e-3, 1e7, 1e-19, 1e-150, 1e150][i as usize / 8 % 6];
        for p in &mut corners {
            p[2] *= if i % 8 > 4 { flat } else { 1.0 };
            *p = p.map(|x| x * size);
        }
        let first = mesh.points.len() as u32;
        mesh.points.extend(corners);
        mesh.tets.push([0, 1, 2, 3].map(|k| first + k));
    }
    let some = |tet| ForcedTet { tet, facets: [0, 1], ends: [0, 1], angle: 1.0 };
    let forced: Vec<ForcedTet> = (0..6000).filter(|tet| tet % 7 < 2).map(some).collect();
    let summary = QualitySummary::new(&mesh, &forced);
    let qualities = tet_qualities(&mesh).unwrap();
    for (figures, of_unforced) in [(summary.all, false), (summary.unforced, true)] {
        for (i, measure) in Measure::ALL.into_iter().enumerate() {
            let mut histogram = [0; BINS];
            let mut worst: Option<(f64, u32)> = None;
            for (tet, quality) in (0..).zip(&qualities) {
                if of_unforced && tet % 7 < 2 {
                    continue;
                }
                let value = quality.by(measure);
                histogram[measure.bin(value)] += 1;
                if worst.is_none_or(|worst| measure.badness(value) > measure.badness(worst.0)) {
                    worst = Some((value, tet));
                }
            }
            assert_eq!(figures.histograms[i], histogram, "{measure:?}");
            assert_eq!(Some((figures.worst[i], figures.worst_tet[i])), worst, "{measure:?}");
        }
    }
    // Bins are told for nearly all tetrahedra of a usual shape.
    let bins = rough::Bins::new();
    let usual =
        (0..1000).map(|_| [(); 4].map(|()| numbers.point())).filter(|&c| TetQuality::of(c).volume > 1e-3);
    let told: Vec<bool> = usual.map(|c| rough::keys(&c).and_then(|keys| bins.of(&keys)).is_some()).collect();
    assert!(told.len() > 100 && told.iter().all(|&told| told));
}

/// The same figures, bit for bit, after points, tetrahedra and corners have been renumbered.
#[test]
fn renumbering_changes_no_figure() {
    let (_, mesh) = wedge(10.0, Mode::Constrained);
    let forced = forced_tets(&mesh).unwrap();
    let known = QualitySummary::new(&mesh, &forced);
    let (points, tets) = (mesh.points.len() as u32, mesh.tets.len() as u32);
    let mut turned = mesh.try_clone().unwrap();
    let point = |v: u32| points - 1 - v;
    let tet = |t: u32| if t == INVALID { t } else { tets - 1 - t };
    turned.points.reverse();
    turned.tets.reverse();
    turned.neighbors.reverse();
    for (corners, neighbors) in turned.tets.iter_mut().zip(&mut turned.neighbors) {
        *corners = [1, 2, 0, 3].map(|i| point(corners[i]));
        *neighbors = [1, 2, 0, 3].map(|i| tet(neighbors[i]));
    }
    for subface in &mut turned.subfaces {
        subface.corners = subface.corners.map(point);
        subface.tets = subface.tets.map(tet);
    }
    turned.subfaces.reverse();
    let again = forced_tets(&turned).unwrap();
    let mut expected: Vec<ForcedTet> = forced
        .iter()
        .map(|f| ForcedTet { tet: tet(f.tet), ends: [point(f.ends[1]), point(f.ends[0])], ..*f })
        .collect();
    expected.reverse();
    assert_eq!(again, expected);
    let summary = QualitySummary::new(&turned, &again);
    assert_eq!((summary.all.worst, summary.all.histograms), (known.all.worst, known.all.histograms));
    assert_eq!(
        (summary.unforced.worst, summary.unforced.histograms),
        (known.unforced.worst, known.unforced.histograms)
    );
}

/// Meshes that contradict themselves, or lack neighbours as those from files do, force nothing and end.
#[test]
fn inconsistent_meshes_are_survived() {
    let (_, mut mesh) = wedge(10.0, Mode::Constrained);
    mesh.neighbors.clear();
    forced_tets(&mesh).unwrap();
    mesh.subfaces.iter_mut().for_each(|subface| subface.tets = [INVALID, 77_777]);
    assert_eq!(forced_tets(&mesh).unwrap(), []);
    let (_, mut mesh) = wedge(10.0, Mode::Constrained);
    let count = mesh.tets.len() as u32;
    mesh.neighbors.iter_mut().flatten().for_each(|tet| *tet = tet.wrapping_add(1) % count);
    mesh.points[0] = [f64::NAN; 3];
    mesh.tets[0][1] = 12_345;
    let forced = forced_tets(&mesh).unwrap();
    QualitySummary::new(&mesh, &forced);
}
