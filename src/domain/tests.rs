//! Seeds: each is located correctly, whatever its coordinates.
use crate::{tetrahedralize, DefectKind, Element, Error, Facet, Options, Plc, RegionSeed, Silent, Status};
use crate::{TetMesh, WarningKind};

/// A row of `count` unit cubes along x, with their common walls, times `size`.
fn row(count: u32, size: f64) -> Plc {
    let mut plc = Plc::default();
    for i in 0..=count {
        for [y, z] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
            plc.points.push([f64::from(i) * size, y * size, z * size]);
        }
    }
    let mut add = |ring: [u32; 4]| {
        plc.facets.push(Facet { polygons: vec![ring.to_vec()], ..Facet::default() });
    };
    for i in 0..=count {
        add([0, 1, 2, 3].map(|k| 4 * i + k));
    }
    for i in 0..count {
        for k in 0..4 {
            let (a, b) = (4 * i + k, 4 * i + (k + 1) % 4);
            add([a, b, b + 4, a + 4]);
        }
    }
    plc
}

fn seed(point: [f64; 3], attribute: f64) -> RegionSeed {
    RegionSeed { point, attribute, max_volume: None }
}

fn mesh(plc: &Plc) -> Result<TetMesh, Error> {
    tetrahedralize(plc, &Options::default(), &mut Silent)
}

/// The attribute of every cube of a row, by the smallest x of tetrahedra.
fn attributes(mesh: &TetMesh, size: f64) -> Vec<f64> {
    let mut found = Vec::new();
    for (tet, &region) in mesh.tets.iter().zip(&mesh.tet_region) {
        let x = tet.iter().map(|&v| mesh.points[v as usize][0]).fold(f64::INFINITY, f64::min);
        let cube = (x / size) as usize;
        found.resize(found.len().max(cube + 1), f64::NAN);
        found[cube] = mesh.regions[region as usize].attribute;
    }
    found
}

#[test]
fn every_seed_of_many_is_found_in_its_cube() {
    let count = 300;
    let mut plc = row(count, 1.0);
    let x = |i: u32| f64::from(i * 77 % count);
    plc.regions = (0..count).map(|i| seed([x(i) + 0.3, 0.6, 0.2], x(i) + 1000.0)).collect();
    let attributes = attributes(&mesh(&plc).unwrap(), 1.0);
    assert_eq!(attributes, (0..count).map(|i| f64::from(i) + 1000.0).collect::<Vec<_>>());
}

/// They used to cause INTERNAL: as vertices they would leave the range in which signs are exact.
#[test]
fn seeds_of_any_finite_coordinates_work() {
    for tiny in [1e-70, -1e-70, 1e-300, f64::from_bits(1), 0.0] {
        let mut plc = row(2, 1.0);
        // Shifted so that the common wall is at x = 0: the seed's sign decides.
        plc.points.iter_mut().for_each(|p| p[0] -= 1.0);
        plc.regions = vec![seed([tiny, 0.2, 0.3], 7.0)];
        match mesh(&plc) {
            Ok(mesh) => {
                let seeded = mesh.regions.iter().position(|r| r.seed == 0).unwrap() as u32;
                for (tet, &region) in mesh.tets.iter().zip(&mesh.tet_region) {
                    let right = tet.iter().any(|&v| mesh.points[v as usize][0] > 0.0);
                    assert_eq!(region == seeded, right == (tiny > 0.0), "{tiny}");
                }
                assert!(tiny != 0.0);
            }
            Err(error) => assert_eq!((error.status, tiny), (Status::SeedOutside, 0.0)),
        }
        plc.regions = vec![seed([0.2, tiny, 0.3], 7.0)];
        assert_eq!(mesh(&plc).is_ok(), tiny > 0.0, "{tiny}");
    }
    for huge in [1e300, -1e300, f64::MAX] {
        let mut plc = row(1, 1.0);
        plc.holes = vec![[huge, 0.5, 0.5]];
        assert_eq!(mesh(&plc).unwrap().warnings.count(WarningKind::HoleOutside), 1);
        plc.holes.clear();
        plc.regions = vec![seed([0.5, huge, 0.5], 1.0)];
        assert_eq!(mesh(&plc).unwrap_err().status, Status::SeedOutside);
    }
}

/// The engine scales such inputs; a seed that scaling rounds to the wall is still next to it.
#[test]
fn seeds_that_scaling_would_round_are_exact() {
    let size = 2.0f64.powi(1000);
    let mut plc = row(2, size);
    plc.points.iter_mut().for_each(|p| p[0] -= size);
    plc.regions = vec![seed([f64::from_bits(1), size / 4.0, size / 3.0], 7.0)];
    let right = mesh(&plc).unwrap();
    plc.regions[0].point[0] = -f64::from_bits(1);
    let left = mesh(&plc).unwrap();
    let seeded = |mesh: &TetMesh| -> Vec<bool> {
        let at = |tet: &[u32; 4]| tet.iter().any(|&v| mesh.points[v as usize][0] > 0.0);
        mesh.tets
            .iter()
            .zip(&mesh.tet_region)
            .filter(|x| mesh.regions[*x.1 as usize].seed == 0)
            .map(|x| at(x.0))
            .collect()
    };
    let (right, left) = (seeded(&right), seeded(&left));
    assert!(!right.is_empty() && right.iter().all(|&x| x));
    assert!(!left.is_empty() && left.iter().all(|&x| !x));
}

#[test]
fn a_seed_on_a_facet_is_refused_whatever_lies_beyond() {
    // On the common wall, on its diagonals' crossing, on a side, an edge and a corner of the hull.
    for point in
        [[1.0, 0.3, 0.6], [1.0, 0.5, 0.5], [0.4, 0.0, 0.7], [0.4, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 1.0, 1.0]]
    {
        let mut plc = row(2, 1.0);
        plc.regions = vec![seed([0.5, 0.5, 0.5], 2.0), seed(point, 1.0)];
        let error = mesh(&plc).unwrap_err();
        assert_eq!(error.status, Status::SeedOutside);
        assert_eq!(error.defects[0].kind, DefectKind::SeedOnFacet, "{point:?}");
        assert_eq!((error.defects[0].first, error.defects[0].point), (Element::Region(1), Some(point)));
    }
}

#[test]
fn seeds_without_effect_are_reported() {
    let mut plc = row(3, 1.0);
    plc.regions = vec![seed([0.5, 0.5, 0.5], 4.0), seed([1.5, 0.5, 0.5], 5.0), seed([0.2, 0.3, 0.4], 6.0)];
    plc.holes = vec![[9.0, 0.0, 0.0], [2.5, 0.5, 0.5], [0.5, 1.5, 0.5]];
    let mesh = mesh(&plc).unwrap();
    let of = |kind| mesh.warnings.of(kind).map(|w| (w.first, w.second, w.point)).collect::<Vec<_>>();
    assert_eq!(
        of(WarningKind::RepeatedSeed),
        [(Element::Region(2), Some(Element::Region(0)), Some([0.2, 0.3, 0.4]))]
    );
    assert_eq!(
        of(WarningKind::HoleOutside),
        [(Element::Hole(0), None, Some([9.0, 0.0, 0.0])), (Element::Hole(2), None, Some([0.5, 1.5, 0.5]))]
    );
    assert_eq!(attributes(&mesh, 1.0), [4.0, 5.0]);
}

/// Not even that of a seed without a region of its own.
#[test]
fn an_unseeded_region_never_gets_the_attribute_of_a_seed() {
    let mut plc = row(6, 1.0);
    plc.regions = vec![
        seed([0.5, 0.5, 0.5], 3.0),
        seed([0.6, 0.6, 0.6], 1.0),
        seed([1.5, 0.5, 0.5], 2.5),
        seed([1.4, 0.5, 0.5], f64::INFINITY),
        seed([1.6, 0.5, 0.5], f64::NAN),
    ];
    let mesh = mesh(&plc).unwrap();
    let mut unseeded: Vec<f64> =
        mesh.regions.iter().filter(|r| r.seed == crate::INVALID).map(|r| r.attribute).collect();
    unseeded.sort_unstable_by(f64::total_cmp);
    assert_eq!(unseeded, [2.0, 4.0, 5.0, 6.0]);
}

#[test]
fn equal_and_crowded_seeds_make_no_difference() {
    let mut plc = row(2, 1.0);
    plc.regions = (0..500).map(|i| seed([1.5, 0.5, 0.5], f64::from(i))).collect();
    // On edges and faces of tetrahedra, whatever the diagonals are.
    plc.regions.extend((1..100).map(|i| seed([f64::from(i) / 100.0, 0.5, 0.5], 1e6 + f64::from(i))));
    let mesh = mesh(&plc).unwrap();
    assert_eq!(attributes(&mesh, 1.0), [1e6 + 1.0, 0.0]);
    assert_eq!(mesh.warnings.count(WarningKind::RepeatedSeed), 499 + 98);
}
