//! Random sets of vertices in random order into small models, with all invariants checked after every step, and the result compared with
//! the mesh built at once. Vertices have positions of all kinds.
mod check;
mod model;
mod state;

use crate::control::{controlled, Control, Limits};
use crate::error::Status;
use crate::kernel::{edge_key, face_key, Mesh};
use crate::ops::insert::Outcome;
use crate::predicates::Sign;
use crate::progress::Silent;
use check::Count;
use model::{coordinate, Model, Random};
use state::{Place, State};
use std::sync::atomic::AtomicBool;

/// A number of random cases: more by the environment variable that sets them for the other property tests.
fn cases(usual: u32) -> u32 {
    std::env::var("PROPTEST_CASES").ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

/// Parameters inside a triangle or on its edges: often such that doubles have the point.
fn parameters(random: &mut Random) -> [f64; 2] {
    let [u, v] = match random.next(2) {
        0 => [1 + random.next(7), random.next(8)].map(|x| f64::from(x) / 8.0),
        _ => [random.unit(), random.unit()],
    };
    if u + v > 1.0 {
        [1.0 - u, 1.0 - v]
    } else {
        [u, v]
    }
}

/// Adds a point to a random triangle of the model, in the nearest doubles.
fn near_triangle(
    state: &mut State,
    model: &Model,
    random: &mut Random,
    count: &mut Count,
) -> Option<[u32; 2]> {
    let triangle = model.triangles[random.next(model.triangles.len() as u32) as usize];
    let [a, b, c] = triangle.map(|v| model.points[v as usize]);
    let [u, v] = parameters(random);
    let p = [0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
    state.points.push(p).unwrap();
    state.add(count)
}

/// The same exactly, by a position on its facet.
fn on_triangle(state: &mut State, model: &Model, random: &mut Random, count: &mut Count) -> Option<[u32; 2]> {
    let triangle = model.triangles[random.next(model.triangles.len() as u32) as usize];
    let p = state.points.push_on_facet(triangle, parameters(random)).unwrap();
    let place = state.locate(p);
    assert!(!matches!(place, Place::Outside | Place::Inside(_)), "{place:?}");
    state.add(count)
}

/// Adds a point strictly inside a random subface.
fn in_subface(state: &mut State, model: &Model, random: &mut Random, count: &mut Count) -> Option<[u32; 2]> {
    let i = random.next(model.triangles.len() as u32) as usize;
    let subfaces = state.mesh.subfaces().filter(|&code| state.mesh.subface(code) == model.patch[i]);
    let subfaces: Vec<u32> = subfaces.collect();
    let triangle = state.mesh.face(subfaces[random.next(subfaces.len() as u32) as usize]);
    let [a, b, c] = triangle.map(|v| *state.points.xyz(v));
    let [u, v] = parameters(random);
    let wanted = [0, 1, 2].map(|k| a[k] + u * (b[k] - a[k]) + v * (c[k] - a[k]));
    // `None` if the triangle is too thin.
    let p = state.points.push_in_triangle(model.triangles[i], triangle, &wanted).unwrap()?;
    match state.locate(p) {
        Place::Facet(code) => assert_eq!(face_key(state.mesh.face(code)), face_key(triangle)),
        place => panic!("{place:?}"),
    }
    state.add(count)
}

fn run(seed: u64, squeeze: bool, count: &mut Count) {
    let mut random = Random(seed.wrapping_mul(0x9e37_79b9_7f4a_7c15));
    let random = &mut random;
    let mut grid = [[0.0, 1.0, 2.0, 3.0, 4.0]; 3];
    if random.next(3) == 0 {
        for x in grid.iter_mut().flatten() {
            *x += 0.8 * random.unit();
        }
    }
    let model = Model::random(random, &grid);
    let mut state = State::new(&model);
    state.insert.squeeze = squeeze;
    count.steiner += (state.points.len() - model.points.len()) as u32;
    for _ in 0..4 + random.next(16) {
        let blocked = match random.next(8) {
            0 | 1 => {
                let i = random.next(state.pieces.len() as u32) as usize;
                let fraction = [0.5, 0.25, random.unit()][random.next(3) as usize];
                state.split_piece(i, fraction, count)
            }
            2 => near_triangle(&mut state, &model, random, count),
            3 => on_triangle(&mut state, &model, random, count),
            4 => in_subface(&mut state, &model, random, count),
            _ => {
                let p = [0, 1, 2].map(|k| coordinate(random, &grid[k]));
                state.points.push(p).unwrap();
                state.add(count)
            }
        };
        // As in refinement, what is in the way is split.
        if let Some([a, b]) = blocked.filter(|_| random.next(2) == 0) {
            let i = state.pieces.iter().position(|x| edge_key(x.ends[0], x.ends[1]) == edge_key(a, b));
            state.split_piece(i.expect("only subsegments block"), 0.5, count);
        }
    }
    if state.exact {
        state.compare(count);
    }
}

#[test]
fn constrained_insertion_keeps_the_mesh_constrained_delaunay() {
    let mut count = Count::default();
    for seed in 0..u64::from(cases(300)) {
        run(seed, false, &mut count);
    }
    println!("{count:?}");
    assert!(count.inserted.iter().all(|&n| n > 0) && count.implicit[1..].iter().all(|&n| n > 0));
    assert!(count.steiner > 0 && count.blocked > 0 && count.occupied > 0);
    assert!(count.compared > 0 && count.wrapped > 0 && count.refuted > 0);
}

#[test]
fn vertices_are_squeezed_in_where_there_is_no_constrained_delaunay_mesh() {
    let mut count = Count::default();
    for seed in 0..u64::from(cases(300)) {
        run(seed, true, &mut count);
    }
    println!("{count:?}");
    assert!(count.squeezed > 0 && count.blocked == 0);
}

/// A vertex that is not where the caller says is refused, and nothing changes.
#[test]
fn misplaced_vertices_are_refused() {
    let mut model = Model::default();
    model.cuboid([0.0; 3], [4.0; 3], None);
    let control = &Control::free();
    let State { mut mesh, mut points, mut insert, pieces, .. } = State::new(&model);
    let before = mesh.slots_as_they_are();
    let mut push = |p| points.push(p).unwrap();
    let [inside, on_wall, on_edge] = [[1.0, 1.25, 1.5], [0.0, 1.0, 1.5], [0.0, 0.0, 1.5]].map(&mut push);
    let outside = push([5.0, 1.0, 1.0]);
    let live = mesh.all().filter(|&t| mesh.is_live(t)).collect::<Vec<_>>();
    for t in live {
        let ghost = mesh.is_ghost(t);
        let has = |mesh: &Mesh, p| {
            !ghost
                && (4 * t..4 * t + 4).all(|code| {
                    let [x, y, z] = mesh.face(code);
                    points.orient3d(p, x, y, z) != Sign::Negative
                })
        };
        for p in [inside, on_wall, on_edge, outside] {
            if p != inside || !has(&mesh, p) {
                assert!(insert.interior(&mut mesh, &points, p, t, control).is_err());
            }
            for code in (4 * t..4 * t + 4).filter(|_| p == inside || p == outside) {
                assert!(insert.on_facet(&mut mesh, &points, p, code, control).is_err());
            }
            for piece in &pieces {
                let [a, b] = piece.ends;
                let there = !ghost && points.collinear(a, b, p) && mesh.is_subsegment(t, [a, b]);
                if p != on_edge || !there {
                    assert!(insert.on_segment(&mut mesh, &points, p, [a, b], t, control).is_err());
                }
            }
        }
    }
    assert_eq!(before, mesh.slots_as_they_are());
}

/// A box with a slanted facet, and the corners of this.
fn slanted() -> (State, [u32; 3]) {
    let mut model = Model::default();
    model.cuboid([0.0; 3], [4.0; 3], None);
    model.facet(&[[1.0, 1.0, 1.0], [3.0, 1.5, 1.25], [1.25, 3.0, 2.75]]);
    let frame = model.triangles[model.triangles.len() - 1];
    (State::new(&model), frame)
}

/// What doubles miss is on its facet and its segment; the nearest doubles are not.
#[test]
fn exact_positions_decide_where_a_vertex_is() {
    let (mut state, frame @ [o, a, _]) = slanted();
    let third = 1.0 / 3.0;
    let on_facet = state.points.push_on_facet(frame, [third, 0.2]).unwrap();
    let on_segment = state.points.push_on_segment(o, a, &third.into()).unwrap();
    for p in [on_facet, on_segment] {
        assert!(!state.points.is_explicit(p));
        let near = state.points.push(*state.points.xyz(p)).unwrap();
        let (place, control) = (state.locate(p), Control::free());
        let nearest_place = state.locate(near);
        assert!(matches!(nearest_place, Place::Inside(_)), "{nearest_place:?}");
        let State { mesh, points, insert, .. } = &mut state;
        let before = mesh.slots_as_they_are();
        let outcome = match place {
            Place::Facet(code) => {
                assert!(insert.on_facet(mesh, points, near, code, &control).is_err());
                assert_eq!(before, mesh.slots_as_they_are());
                insert.on_facet(mesh, points, p, code, &control)
            }
            Place::Segment(edge, t) => {
                assert!(insert.on_segment(mesh, points, near, edge, t, &control).is_err());
                assert_eq!(before, mesh.slots_as_they_are());
                insert.on_segment(mesh, points, p, edge, t, &control)
            }
            _ => panic!("{place:?}"),
        };
        assert_eq!(outcome.unwrap(), Outcome::Inserted);
        assert!(before != mesh.slots_as_they_are());
    }
}

/// A run that has ended changes nothing.
#[test]
fn a_cancelled_insertion_leaves_the_mesh_as_it_was() {
    let (mut state, frame) = slanted();
    let cancelled = AtomicBool::new(true);
    let limits = Limits { cancel: Some(&cancelled), ..Limits::default() };
    let p = state.points.push_on_facet(frame, [0.3, 0.3]).unwrap();
    let Place::Facet(code) = state.locate(p) else { panic!("not on the facet") };
    let before = state.mesh.slots_as_they_are();
    let State { mesh, points, insert, .. } = &mut state;
    let ended = controlled(limits, &mut Silent, |control| insert.on_facet(mesh, points, p, code, control));
    assert_eq!(ended.unwrap_err().status, Status::Cancelled);
    assert_eq!(before, mesh.slots_as_they_are());
    let again = insert.on_facet(mesh, points, p, code, &Control::free());
    assert_eq!(again.unwrap(), Outcome::Inserted);
}
