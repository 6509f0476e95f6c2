//! Facet merging from end to end: flips are made, told, applied by the checker, and save Steiner points.
use delotet::{check_mesh, tetrahedralize, DefectKind, FacetFlip, Options, Plc, Silent, TetMesh};

/// A closed tube of `n` planar strips up to rounding, each cut into slivers by a fan from one corner and one from the opposite one. Single
/// precision, the axis along no axis of coordinates. Strips alternate between two markers in pairs.
fn tube(n: u32, m: u32) -> Plc {
    let mut plc = Plc::default();
    for i in 0..n {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let (x, y) = (angle.cos(), angle.sin());
        for k in 0..=m {
            let z = f64::from(k) * 0.3;
            let p = [0.36 * x - 0.8 * y + 0.48 * z, 0.48 * x + 0.6 * y + 0.64 * z, 0.6 * z - 0.8 * x];
            plc.points.push(p.map(|x| f64::from(x as f32)));
        }
    }
    let id = |i: u32, k: u32| (i % n) * (m + 1) + k;
    for i in 0..n {
        plc.triangles.extend((0..m).map(|k| [id(i, 0), id(i + 1, k), id(i + 1, k + 1)]));
        plc.triangles.extend((0..m).map(|k| [id(i, k), id(i + 1, m), id(i, k + 1)]));
        plc.triangle_markers.extend((0..2 * m).map(|_| 1 + (i / 2 % 2) as i32));
    }
    for i in 2..n {
        plc.triangles.extend([[id(0, 0), id(i, 0), id(i - 1, 0)], [id(0, m), id(i - 1, m), id(i, m)]]);
        plc.triangle_markers.extend([3, 4]);
    }
    plc
}

fn mesh(plc: &Plc, merge_facets: Option<f64>) -> TetMesh {
    tetrahedralize(plc, &Options { merge_facets, ..Options::default() }, &mut Silent).expect("a mesh")
}

#[test]
fn slivers_are_flipped_and_save_steiner_points() {
    let plc = tube(12, 10);
    let (strict, merged) = (mesh(&plc, None), mesh(&plc, Some(179.9)));
    assert!(strict.facet_flips.is_empty());
    assert!(merged.facet_flips.len() > 12 * 5, "{} flips", merged.facet_flips.len());
    assert!(
        4 * merged.steiner.len() < strict.steiner.len(),
        "{} of {} Steiner points",
        merged.steiner.len(),
        strict.steiner.len()
    );
    check_mesh(&plc, &merged, true, 10).expect("a valid mesh");
    assert_eq!(merged.points[..plc.points.len()], plc.points[..]);
    assert_eq!(merged, TetMesh { statistics: merged.statistics.clone(), ..mesh(&plc, Some(179.9)) });
}

#[test]
fn markers_stay_on_their_side() {
    let plc = tube(12, 10);
    let merged = mesh(&plc, Some(179.9));
    for flip in &merged.facet_flips {
        let [f, g] = flip.facets.map(|f| plc.facet_marker(f as usize));
        assert_eq!(f, g);
    }
    let area = |mesh: &TetMesh, marker: i32| -> f64 {
        let pieces = mesh.subfaces.iter().filter(|s| s.marker == marker);
        pieces.map(|s| s.corners.map(|v| mesh.points[v as usize])).map(triangle_area).sum()
    };
    let strict = mesh(&plc, None);
    for marker in 1..=4 {
        let (before, after) = (area(&strict, marker), area(&merged, marker));
        assert!((before - after).abs() < 1e-5 * before, "marker {marker}: {before}, {after}");
    }
}

fn triangle_area([a, b, c]: [[f64; 3]; 3]) -> f64 {
    let (u, v): ([f64; 3], [f64; 3]) =
        (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
    let normal = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
    0.5 * normal.iter().map(|x| x * x).sum::<f64>().sqrt()
}

#[test]
fn the_checker_needs_the_flips() {
    let plc = tube(12, 10);
    let merged = mesh(&plc, Some(179.9));
    let untold = TetMesh { facet_flips: Vec::new(), ..merged.clone() };
    let error = check_mesh(&plc, &untold, true, 1000).expect_err("the input's facets are not in the mesh");
    assert!(error.defects.iter().any(|d| d.kind == DefectKind::FacetMissing));
    // A flip across a border of markers is not accepted, whatever the mesh.
    let mut wrong = merged.clone();
    wrong.facet_flips.push(FacetFlip { old: [0, 1], new: [5, 6], facets: [0, 1] });
    assert!(check_mesh(&plc, &wrong, true, 1000).is_err());
}

#[test]
fn a_flip_keeps_the_numbers_of_the_facets() {
    // Facet `facets[0]` is the triangle at `old[0]` after the flip, in either order.
    let plc = tube(5, 8);
    let merged = mesh(&plc, Some(179.9));
    assert!(!merged.facet_flips.is_empty());
    let mut corners = plc.triangles.clone();
    for flip in &merged.facet_flips {
        let [f, g] = flip.facets.map(|f| f as usize);
        for facet in [f, g] {
            assert!(flip.old.iter().all(|v| corners[facet].contains(v)));
        }
        assert!(flip.new.iter().zip([f, g]).all(|(v, facet)| corners[facet].contains(v)));
        corners[f] = [flip.old[0], flip.new[0], flip.new[1]];
        corners[g] = [flip.old[1], flip.new[0], flip.new[1]];
    }
    // Subfaces that were not split show which triangle carries which number.
    let sorted = |mut t: [u32; 3]| {
        t.sort_unstable();
        t
    };
    let whole = merged.subfaces.iter().filter(|s| sorted(s.corners) == sorted(corners[s.facet as usize]));
    let flipped = merged.facet_flips.iter().flat_map(|f| f.facets);
    let flipped: std::collections::BTreeSet<u32> = flipped.collect();
    assert!(whole.filter(|s| flipped.contains(&s.facet)).count() > 10);
}
