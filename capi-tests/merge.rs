//! Facet merging from end to end: flips are made, listed, applied by the checker, and save Steiner points.
use delotet::{
    check_mesh, check_preserved, tetrahedralize, DefectKind, FacetFlip, Mode, Options, Plc, Silent, TetMesh,
};

/// A closed tube of `n` planar strips up to rounding, each cut into slivers by a fan from one corner and one from the opposite one. In
/// single precision, with an axis along no coordinate axis. Strips alternate between two markers in pairs.
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
    // A flip across a border between markers is never accepted.
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

/// Three nested tubes, each smaller by twice `gap` than the next and rotated, so that no facet is planar and none is far from another:
/// Steiner points have parameters that no double holds.
fn nested_tubes(n: u32, m: u32, gap: f64, turns: u32) -> Plc {
    let outer = Plc { triangle_markers: Vec::new(), ..tube(n, m) };
    let count = outer.points.len() as u32;
    let center = [0, 1, 2].map(|k| outer.points.iter().map(|p| p[k]).sum::<f64>() / f64::from(count));
    let mut plc = Plc::default();
    for shell in 0..3 {
        let size = 1.0 - 2.0 * f64::from(shell) * gap;
        for p in &outer.points {
            let mut p: [f64; 3] = std::array::from_fn(|k| center[k] + size * (p[k] - center[k]));
            for _ in 0..turns {
                let [x, y, z] = p;
                p = [0.36 * x - 0.8 * y + 0.48 * z, 0.48 * x + 0.6 * y + 0.64 * z, 0.6 * z - 0.8 * x];
            }
            plc.points.push(p);
        }
        plc.triangles.extend(outer.triangles.iter().map(|t| t.map(|v| v + shell * count)));
    }
    plc
}

/// No flip is directly followed, as far as its two facets are concerned, by another that undoes it.
fn assert_net(mesh: &TetMesh) {
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    let flips = &mesh.facet_flips;
    for (i, first) in flips.iter().enumerate() {
        let touches = |f: &&FacetFlip| f.facets.iter().any(|g| first.facets.contains(g));
        let Some(next) = flips[i + 1..].iter().find(touches) else { continue };
        let same_pair = sorted(next.facets) == sorted(first.facets);
        let back = sorted(next.old) == sorted(first.new) && sorted(next.new) == sorted(first.old);
        assert!(!(same_pair && back), "{first:?} and {next:?}");
    }
}

#[test]
fn merging_never_takes_more_points_and_passes_the_check() {
    let (mut fewer, mut fine) = (0, 0);
    for (n, m) in [(3, 1), (3, 2), (4, 2)] {
        for gap in [1e-5, 1e-6, 1e-7, 1e-9] {
            for turns in [1, 2] {
                let plc = nested_tubes(n, m, gap, turns);
                let (strict, merged) = (mesh(&plc, None), mesh(&plc, Some(179.9)));
                let what = format!("{n} strips of {m}, gap {gap}, turned {turns} times");
                assert!(merged.steiner.len() <= strict.steiner.len(), "{what}");
                fine += merged.steiner_terms.len();
                check_mesh(&plc, &merged, true, 10).unwrap_or_else(|e| panic!("{what}: {e}"));
                assert_net(&merged);
                fewer += usize::from(merged.steiner.len() < strict.steiner.len());
            }
        }
    }
    assert!(fewer >= 12 && fine > 100, "{fewer} of 24, {fine} terms");
}

#[test]
fn merging_does_not_refuse_what_is_meshed_without_it() {
    // Only without merging within this limit: 214 points, with merging 604.
    let plc = nested_tubes(3, 2, 1e-9, 1);
    let options = Options { steiner_limit: Some(300), ..Options::default() };
    let strict = tetrahedralize(&plc, &options, &mut Silent).unwrap();
    let merging = Options { merge_facets: Some(179.9), ..options };
    let merged = tetrahedralize(&plc, &merging, &mut Silent).unwrap();
    assert_eq!(merged.facet_flips, []);
    assert_eq!((merged.points, merged.tets), (strict.points, strict.tets));
}

#[test]
fn merging_keeps_its_promises_in_preserved_surfaces() {
    for (n, m, gap) in [(3, 1, 1e-5), (3, 2, 1e-3), (4, 2, 1e-3)] {
        let plc = nested_tubes(n, m, gap, 1);
        for keep_hull in [false, true] {
            let options = Options { mode: Mode::Preserve, keep_hull, ..Options::default() };
            let strict = tetrahedralize(&plc, &options, &mut Silent).unwrap();
            let merging = Options { merge_facets: Some(179.9), ..options };
            let merged = tetrahedralize(&plc, &merging, &mut Silent).unwrap();
            assert!(merged.steiner.len() <= strict.steiner.len());
            check_preserved(&plc, &merged, 10).unwrap();
            assert_net(&merged);
        }
    }
}
