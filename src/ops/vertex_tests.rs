//! Vertices inside random meshes are removed, contracted, smoothed and placed; the mesh and what must stay of it are right after each.
use crate::control::Control;
use crate::kernel::around::StarSearch;
use crate::kernel::NONE;
use crate::ops::contract::Contract;
use crate::ops::hollow::Growth;
use crate::ops::place::{place, place_at_center, sees_all};
use crate::ops::quality::quality;
use crate::ops::remove_vertex::RemoveVertex;
use crate::ops::scene_tests::{mix, on_scenes, Scene};
use crate::ops::smooth::smooth;
use crate::predicates::Points;
use crate::vector::sub;
use std::cell::RefCell;

/// Search steps: with one, hardly anything but cones is found.
const BUDGETS: [u32; 2] = [1, 300];

/// The faces opposite a vertex inside.
fn link(scene: &Scene, v: u32) -> Vec<[u32; 3]> {
    let mut faces = Vec::new();
    StarSearch::default().link(&scene.mesh, v, &mut faces).unwrap();
    faces
}

/// Whether some vertex of these faces sees all others: they can then be filled without any other vertex.
fn is_cone(points: &Points, faces: &[[u32; 3]]) -> bool {
    let sees = |v: u32| {
        let others: Vec<[u32; 3]> = faces.iter().copied().filter(|face| !face.contains(&v)).collect();
        sees_all(points, v, &others)
    };
    faces.iter().flatten().any(|&v| sees(v))
}

#[test]
fn vertices_are_removed_or_nothing_changes() {
    // Kept, removed at once, removed from a hollow.
    let counts = RefCell::new([0; 3]);
    on_scenes(256, |mut scene| {
        let control = Control::free();
        let mut remove = RemoveVertex::new(&control);
        let tries = if scene.seed & 1 == 0 { 0 } else { 6 };
        let budget = BUDGETS[(scene.seed / 2 % 2) as usize];
        for p in scene.inside() {
            let (before, slots) = (scene.state(), scene.mesh.slots_as_they_are());
            let faces = link(&scene, p);
            let Scene { mesh, points, keep, .. } = &mut scene;
            let growth = Growth { budget, branches: 3, tries };
            let done = remove.remove(mesh, points, p, keep, growth).unwrap();
            let now = scene.check(&before, &[p][usize::from(!done)..]);
            assert!(done || !is_cone(&scene.points, &faces));
            if done {
                assert_eq!(scene.mesh.vertex_tet[p as usize], NONE);
            } else {
                assert_eq!(scene.mesh.slots_as_they_are(), slots);
            }
            let gone = before.tets.iter().filter(|t| now.tets.binary_search(t).is_err()).count();
            let grown = gone > faces.len();
            counts.borrow_mut()[usize::from(done) + usize::from(grown)] += 1;
        }
    });
    let counts = counts.into_inner();
    println!("kept, removed, from a hollow: {counts:?}");
    assert!(counts[1] > 50, "{counts:?}");
}

#[test]
fn neighbours_become_one_or_nothing_changes() {
    // None, one and two vertices gone.
    let counts = RefCell::new([0; 3]);
    on_scenes(256, |mut scene| {
        let control = Control::free();
        let mut contract = Contract::new(&control);
        let budget = BUDGETS[(scene.seed / 2 % 2) as usize];
        for p in scene.inside() {
            let (before, slots) = (scene.state(), scene.mesh.slots_as_they_are());
            let at = scene.points.coordinates().to_vec();
            let inside = scene.inside();
            // At times some must stay where they are.
            let movable: Vec<u32> =
                inside.iter().copied().filter(|&q| mix(&[scene.seed, q]) % 4 != 0).collect();
            let Scene { mesh, points, .. } = &mut scene;
            let done = contract.merge(mesh, points, &movable, p, budget).unwrap();
            let now = scene.state();
            let is_gone = |v: &&u32| now.vertices.binary_search(v).is_err();
            let gone: Vec<u32> = before.vertices.iter().filter(is_gone).copied().collect();
            scene.check(&before, &gone);
            assert_eq!(done, !gone.is_empty());
            assert!(gone.iter().all(|&v| scene.mesh.vertex_tet[v as usize] == NONE));
            assert!(
                gone.iter().all(|v| *v == p || movable.contains(v)) && gone.iter().any(|&v| v != p) == done
            );
            let merged = gone.len() == 1;
            let moved = |v: usize| scene.points.coordinates()[v] != at[v];
            assert!(
                (0..at.len()).all(|v| !moved(v) || (done && v as u32 == p && (merged || gone.len() == 2)))
            );
            if !done {
                assert_eq!(scene.mesh.slots_as_they_are(), slots);
            }
            counts.borrow_mut()[gone.len()] += 1;
        }
    });
    let counts = counts.into_inner();
    println!("vertices gone: {counts:?}");
    assert!(counts[0] > 20 && counts[2] > 20, "{counts:?}");
}

#[test]
fn smoothing_makes_no_star_worse() {
    let counts = RefCell::new([0; 2]);
    on_scenes(256, |mut scene| {
        for p in scene.inside() {
            let (before, faces) = (scene.state(), link(&scene, p));
            let worst = |points: &Points| {
                let of = |&[x, y, z]: &[u32; 3]| quality([p, x, y, z].map(|v| points.xyz(v)));
                faces.iter().map(of).fold(f64::INFINITY, f64::min)
            };
            let (at, least) = (*scene.points.xyz(p), worst(&scene.points));
            smooth(&mut scene.points, p, &faces).unwrap();
            scene.check(&before, &[]);
            let moved = *scene.points.xyz(p) != at;
            let now = worst(&scene.points);
            assert!(if moved { now > least } else { now == least }, "{now} {least}");
            counts.borrow_mut()[usize::from(moved)] += 1;
        }
    });
    let counts = counts.into_inner();
    println!("stayed, moved: {counts:?}");
    assert!(counts[1] > 50, "{counts:?}");
}

#[test]
fn positions_that_are_found_see_all_faces() {
    let counts = RefCell::new([0; 2]);
    on_scenes(256, |mut scene| {
        let control = Control::free();
        for p in scene.inside() {
            let (before, faces) = (scene.state(), link(&scene, p));
            let at = *scene.points.xyz(p);
            // Where the star is known to be open all ways must lead to a position.
            assert!(place_at_center(&mut scene.points, p, &faces).unwrap());
            scene.check(&before, &[]);
            assert!(place(&mut scene.points, p, &faces, at, &[], &control).unwrap());
            scene.check(&before, &[]);
            // At a corner of the boundary it need not be open.
            let from = *scene.points.xyz(faces[mix(&[scene.seed, p]) as usize % faces.len()][0]);
            let toward = [sub(&at, &from), [0.0, 0.0, 1.0], [0.0; 3]];
            let found = place(&mut scene.points, p, &faces, from, &toward, &control).unwrap();
            assert_eq!(found, sees_all(&scene.points, p, &faces));
            if found {
                scene.check(&before, &[]);
            }
            // Where no position sees all of them, none is found.
            let mut closed = faces.clone();
            closed.push([faces[0][0], faces[0][2], faces[0][1]]);
            assert!(!place_at_center(&mut scene.points, p, &closed).unwrap());
            assert!(!place(&mut scene.points, p, &closed, at, &toward, &control).unwrap());
            scene.points.move_to(p, at).unwrap();
            counts.borrow_mut()[usize::from(found)] += 1;
        }
    });
    let counts = counts.into_inner();
    println!("none, found from a corner: {counts:?}");
    assert!(counts[1] > 50, "{counts:?}");
}
