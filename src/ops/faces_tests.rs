//! Removals of faces on random meshes: the choice is the best of all, and the mesh and what must stay of it are right after each.
use crate::kernel::cavity::Edges;
use crate::kernel::replace::Replace;
use crate::kernel::{edge_key, face_key, Mesh};
use crate::ops::check::check_domain;
use crate::ops::faces::{Faces, Site, MOST_FACES};
use crate::ops::reshape::Aim;
use crate::ops::scene_tests::{edges, finite, is_positive, mix, on_scenes, ring, Kind, Scene};
use crate::ops::shape::{Goal, Measure, Shape};
use crate::ops::sheet::Sheets;
use crate::predicates::Points;
use std::cell::RefCell;

/// The most faces between two vertices of which all sets are tried.
const MOST_TRIED: usize = 11;

/// Any valid set is good enough.
const ANY: Goal = Goal { measure: Measure::Angle, above: -0.5, least: 0.0, largest: f64::INFINITY };

/// A face between two vertices.
struct Between {
    /// The corner at the first vertex.
    code: u32,
    corners: [u32; 3],
}

/// All faces between the two vertices beside a face, this one first: those that may go at all.
fn all_between(mesh: &Mesh, code: u32) -> Vec<Between> {
    let ends = [mesh.apex(code), mesh.apex(mesh.across(code))];
    let region = mesh.region(code >> 2);
    let fits = |&c: &u32| {
        let n = mesh.across(c);
        let right = [mesh.apex(c), mesh.apex(n)] == ends && !mesh.is_subface(c);
        right && [c, n].iter().all(|x| !mesh.is_ghost(x >> 2) && mesh.region(x >> 2) == region)
    };
    let all = finite(mesh).flat_map(|t| 4 * t..4 * t + 4).filter(fits);
    let mut list: Vec<Between> = all.map(|code| Between { code, corners: mesh.face(code) }).collect();
    let first = list.iter().position(|face| face.code == code);
    if let Some(first) = first {
        list.swap(0, first);
    } else {
        list.clear();
    }
    list
}

/// Whether two faces meet in an edge with nothing between their tetrahedra but what may go; `None` if something there must stay.
fn may_join(scene: &Scene, one: &Between, other: &Between, edge: [u32; 2]) -> Option<bool> {
    let mesh = &scene.mesh;
    let third = *one.corners.iter().find(|v| !edge.contains(v)).unwrap();
    let mut free = !scene.keep.contains(&edge_key(edge[0], edge[1]));
    for (from, to) in [(one.code, other.code), (mesh.across(one.code), mesh.across(other.code))] {
        let t = from >> 2;
        let code = 4 * t + mesh.slot_of(t, third).unwrap();
        if mesh.across(code) >> 2 != to >> 2 {
            return Some(false);
        }
        free &= !mesh.is_subface(code);
    }
    free.then_some(true)
}

/// The new tetrahedra of a set of faces, if it is one whose removal is valid.
fn tets_of(scene: &Scene, ends: [u32; 2], set: &[&Between]) -> Option<Vec<[u32; 4]>> {
    let mut sides: Vec<([u32; 2], [u32; 2], usize)> = Vec::new();
    for (i, face) in set.iter().enumerate() {
        let [x, y, z] = face.corners;
        sides.extend([[x, y], [y, z], [z, x]].map(|[u, w]| (edge_key(u, w), [u, w], i)));
    }
    sides.sort_unstable();
    let mut part: Vec<usize> = (0..set.len()).collect();
    let mut outline = Vec::new();
    for group in sides.chunk_by(|s, t| s.0 == t.0) {
        match *group {
            [(edge, _, i), (_, _, j)] if may_join(scene, set[i], set[j], edge)? => {
                let (from, to) = (part[i], part[j]);
                part.iter_mut().filter(|p| **p == from).for_each(|p| *p = to);
            }
            _ => outline.extend(group.iter().map(|side| side.1)),
        }
    }
    let whole = part.iter().all(|&p| p == part[0]);
    let kept = |v: &u32| outline.iter().any(|side| side.contains(v));
    let tets: Vec<[u32; 4]> = outline.iter().map(|&[u, w]| [ends[0], ends[1], u, w]).collect();
    let valid = whole
        && set.iter().flat_map(|face| &face.corners).all(kept)
        && tets.iter().all(|&t| is_positive(&scene.points, t));
    valid.then_some(tets)
}

/// For every valid set with the first face the worst quality of the new tetrahedra and of the old ones.
fn all_sets(scene: &Scene, faces: &[Between], goal: &Goal) -> Vec<[f64; 2]> {
    let Some(first) = faces.first() else { return Vec::new() };
    let mesh = &scene.mesh;
    let ends = [mesh.apex(first.code), mesh.apex(mesh.across(first.code))];
    let mut all = Vec::new();
    for bits in (1..1u32 << faces.len()).step_by(2) {
        let set: Vec<&Between> = (0..).zip(faces).filter(|(i, _)| bits >> i & 1 == 1).map(|f| f.1).collect();
        let Some(new) = tets_of(scene, ends, &set) else { continue };
        let new = new.iter().map(|&t| goal.quality(Shape::of(&scene.points, t)));
        let old = set.iter().flat_map(|f| [f.code >> 2, mesh.across(f.code) >> 2]);
        let old = old.map(|t| Shape::of(&scene.points, mesh.verts(t)).by(goal.measure));
        all.push([new.fold(f64::INFINITY, f64::min), old.fold(f64::INFINITY, f64::min)]);
    }
    all
}

/// The worst of these in a measure.
fn worst(points: &Points, tets: &[[u32; 4]], measure: Measure) -> f64 {
    tets.iter().map(|&t| Shape::of(points, t).by(measure)).fold(f64::INFINITY, f64::min)
}

/// What is in the first list and not in the second.
fn without(list: &[[u32; 4]], other: &[[u32; 4]]) -> Vec<[u32; 4]> {
    list.iter().copied().filter(|t| other.binary_search(t).is_err()).collect()
}

#[test]
fn the_best_set_goes_and_all_else_stays() {
    // Removals that improve and that reach a goal, refusals, and how many faces went.
    let counts = RefCell::new(([0; 3], [0; MOST_TRIED + 1]));
    on_scenes(384, |mut scene| {
        let (mut faces, mut replace) = (Faces::default(), Replace::default());
        for round in 0..40 {
            let dice = mix(&[scene.seed, round]);
            let code = dice % (4 * scene.mesh.slot_count() as u32);
            let Scene { mesh, points, .. } = &scene;
            if !mesh.is_live(code >> 2) || mesh.is_ghost(code >> 2) {
                continue;
            }
            let measure = if dice >> 8 & 1 == 0 { Measure::Angle } else { Measure::Ratio };
            let least = if dice >> 9 & 1 == 0 { 0.0 } else { 0.2 };
            let (enough, least) = (
                Shape { angle: 0.3, ratio: 0.5, dihedral: 0.3, volume: 0.0 },
                Shape { angle: least, ratio: least, dihedral: least, volume: 0.0 },
            );
            let aim = Aim { measure, enough, least, largest: f64::INFINITY };
            let between = all_between(mesh, code);
            let beside = mesh.across(code) >> 2;
            // Improvement never takes a ghost.
            let improve = dice >> 10 & 1 == 0;
            let goal = match improve {
                true if !mesh.is_ghost(beside) => {
                    Goal { above: 0.0, ..aim.goal(mesh, points, &[code >> 2, beside]) }
                }
                _ => Goal { measure, ..ANY },
            };
            let sets =
                if between.len() > MOST_TRIED { Vec::new() } else { all_sets(&scene, &between, &goal) };
            let best = sets.iter().map(|s| s[0]).fold(f64::NEG_INFINITY, f64::max);
            let before = scene.state();
            let Scene { mesh, points, keep, .. } = &mut scene;
            let mut site = Site { mesh, points, edges: keep, replace: &mut replace };
            let done = match improve {
                true => faces.improve(&mut site, code, &aim).unwrap(),
                false => faces.reach(&mut site, code, &goal).unwrap(),
            };
            let now = scene.check(&before, &[]);
            let (old, new) = (without(&before.tets, &now.tets), without(&now.tets, &before.tets));
            assert_eq!(done, !new.is_empty());
            let new_worst = worst(&scene.points, &new, measure);
            if done {
                assert_eq!(old.len() % 2, 0);
                assert_eq!(new.len(), old.len() / 2 + 2);
                assert!(!improve || new_worst > worst(&scene.points, &old, measure), "never worse");
                assert!(new_worst > goal.above);
            }
            if between.len() > MOST_TRIED {
                continue;
            }
            // Several sets may be equally good.
            let is_possible = |s: &&[f64; 2]| s[0] == best && (!improve || (s[1] < best) == done);
            match done {
                true => {
                    assert!(new_worst == best && sets.iter().any(|s| is_possible(&s)), "{new_worst} {best}")
                }
                false => assert!(best <= goal.above || sets.iter().any(|s| improve && is_possible(&s))),
            }
            let mut counts = counts.borrow_mut();
            counts.0[if !done { 2 } else { usize::from(!improve) }] += 1;
            counts.1[old.len() / 2] += 1;
        }
    });
    let (kinds, sizes) = counts.into_inner();
    println!("improved, reached, refused: {kinds:?}; faces: {sizes:?}");
    assert!(kinds.iter().all(|&n| n > 20), "{kinds:?}");
    assert!(sizes[..4].iter().all(|&n| n > 20), "{sizes:?}");
}

#[test]
fn edge_removal_brings_back_what_went() {
    let counts = RefCell::new([0; 2]);
    on_scenes(192, |mut scene| {
        let (mut faces, mut replace, mut sheets) = (Faces::default(), Replace::default(), Sheets::default());
        for round in 0..20 {
            let code = mix(&[scene.seed, round]) % (4 * scene.mesh.slot_count() as u32);
            if !scene.mesh.is_live(code >> 2) {
                continue;
            }
            let before = scene.state();
            let ends = [scene.mesh.apex(code), scene.mesh.apex(scene.mesh.across(code))];
            let Scene { mesh, points, keep, .. } = &mut scene;
            let mut site = Site { mesh, points, edges: keep, replace: &mut replace };
            if !faces.reach(&mut site, code, &ANY).unwrap() {
                continue;
            }
            let now = scene.check(&before, &[]);
            let (ring, link) = ring(&scene.mesh, replace.fresh[0], ends);
            assert_eq!(ring.len(), replace.fresh.len());
            let old = without(&before.tets, &now.tets);
            // The sheet that was there is one of those compared.
            let floor = worst(&scene.points, &old, Measure::Angle);
            let goal = Goal { above: floor.min(1e-300) - 1e-301, ..ANY };
            let mut sheet = Vec::new();
            assert!(sheets.improve(&scene.points, ends, &link, &goal, &mut sheet).unwrap());
            assert!(worst(&scene.points, &sheet, Measure::Angle) >= floor);
            replace.cavity(&mut scene.mesh, &ring, &sheet, &[]).unwrap();
            let again = scene.check(&before, &[]);
            let same = again.tets == before.tets;
            assert!(same || link.len() > 3, "there is one triangle only");
            counts.borrow_mut()[usize::from(same)] += 1;
        }
    });
    let counts = counts.into_inner();
    println!("another sheet, the same: {counts:?}");
    assert!(counts[0] < counts[1] && counts[1] > 50, "{counts:?}");
}

#[test]
fn a_removed_edge_comes_back() {
    let counts = RefCell::new([0; 2]);
    on_scenes(512, |mut scene| {
        if scene.kind != Kind::Ring {
            return;
        }
        scene.strip();
        let before = scene.state();
        let (old, link) = ring(&scene.mesh, finite(&scene.mesh).next().unwrap(), [0, 1]);
        let mut sheet = Vec::new();
        if !Sheets::default().fill(&scene.points, [0, 1], &link, false, &mut sheet).unwrap() {
            return;
        }
        let mut replace = Replace::default();
        replace.cavity(&mut scene.mesh, &old, &sheet, &[]).unwrap();
        let between = scene.check(&before, &[]);
        for face in 0..sheet.len() as u32 / 2 {
            let t = replace.fresh[2 * face as usize];
            let code = 4 * t + scene.mesh.slot_of(t, 1).unwrap();
            let Scene { mesh, points, keep, .. } = &mut scene;
            let copy = mesh.copied().unwrap();
            let mut again = Replace::default();
            let mut site = Site { mesh, points, edges: keep, replace: &mut again };
            assert!(Faces::default().reach(&mut site, code, &ANY).unwrap());
            let now = scene.check(&between, &[]);
            assert!(edges(&scene.mesh).contains(&[0, 1]));
            let came = without(&now.tets, &between.tets);
            let floor = worst(&scene.points, &before.tets, Measure::Angle);
            assert!(worst(&scene.points, &came, Measure::Angle) >= floor);
            let same = now.tets == before.tets;
            assert!(same || link.len() > 3);
            counts.borrow_mut()[usize::from(same)] += 1;
            scene.mesh = copy;
        }
    });
    let counts = counts.into_inner();
    println!("another ring, the same: {counts:?}");
    assert!(counts[1] > 2, "{counts:?}");
}

/// A flat polygon with a vertex below and one above, its triangles all at its first corner.
fn fan(n: u32) -> (Mesh, Points) {
    let mut xyz = vec![[0.0, 0.0, -1e6], [0.0, 0.0, 1e6]];
    xyz.extend((0..n).map(|k| {
        let angle = f64::from(k) * std::f64::consts::TAU / f64::from(n);
        [angle.cos(), angle.sin(), 0.0].map(|x| (1e6 * x).round())
    }));
    let points = Points::new(xyz);
    let triangles = (3..n + 1).map(|k| [2, k, k + 1]);
    let tets: Vec<[u32; 4]> = triangles.flat_map(|[x, y, z]| [[x, y, z, 1], [y, x, z, 0]]).collect();
    (Mesh::of_tetrahedra(&tets, points.len()).unwrap(), points)
}

/// A face by its corners.
fn corner_of(mesh: &Mesh, corners: [u32; 3]) -> u32 {
    let codes = finite(mesh).flat_map(|t| 4 * t..4 * t + 4);
    codes.into_iter().find(|&code| face_key(mesh.face(code)) == face_key(corners)).unwrap()
}

#[test]
fn known_sets_go() {
    let remove = |n: u32, corners: [u32; 3], keep: &[[u32; 2]]| {
        let (mut mesh, points) = fan(n);
        let code = corner_of(&mesh, corners);
        let (mut replace, edges): (_, Edges) = (Replace::default(), keep.iter().copied().collect());
        let mut site = Site { mesh: &mut mesh, points: &points, edges: &edges, replace: &mut replace };
        let done = Faces::default().reach(&mut site, code, &ANY).unwrap();
        check_domain(&mesh, &points).unwrap();
        done.then_some(replace.fresh.len())
    };
    // The flip 2-3, and the flip 4-4, in which both faces go since the edge between them crosses the new one.
    assert_eq!(remove(3, [2, 3, 4], &[]), Some(3));
    assert_eq!(remove(4, [2, 3, 4], &[]), Some(4));
    assert_eq!(remove(4, [2, 4, 5], &[[2, 4]]), None);
    // From a face at the rim all must go as far as the middle; beyond it none need go.
    assert!(remove(9, [2, 3, 4], &[]).is_some_and(|count| count >= 6));
    assert_eq!(remove(9, [2, 3, 4], &[[2, 5]]), None);
    assert_eq!(remove(9, [2, 3, 4], &[[2, 7]]), Some(6));
    // There is a limit to what is looked at.
    assert!(remove(MOST_FACES as u32, [2, 3, 4], &[]).is_some());
    assert!(remove(3 * MOST_FACES as u32, [2, 3, 4], &[]).is_none());
}
