//! The Delaunay invariants on random and degenerate point sets.
use crate::control::{controlled, CancelToken, Control, Limits};
use crate::delaunay::check::check_delaunay;
use crate::delaunay::locate::locate;
use crate::delaunay::order::insertion_order;
use crate::delaunay::{Construction, HELPERS_STARTED};
use crate::error::Status;
use crate::predicates::{Lifts, Points};
use crate::progress::{Observer, Phase, Silent};
use std::ops::ControlFlow;

/// Deterministic numbers in [0, 1).
struct Lcg(u64);

impl Lcg {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1u64 << 53) as f64
    }
}

fn build(xyz: Vec<[f64; 3]>) -> (Construction, Points) {
    let ids: Vec<u32> = (0..xyz.len() as u32).collect();
    let mut order = insertion_order(&xyz, &ids, &Control::free()).unwrap().ids;
    let points = Points::new(xyz);
    let mut delaunay = Construction::default();
    delaunay.build(&points, &mut order, &Control::free()).unwrap();
    check_delaunay(&delaunay.mesh, &points).unwrap();
    slots_are_accounted_for(&delaunay);
    (delaunay, points)
}

/// Each free slot is listed once, and no others are.
fn slots_are_accounted_for(delaunay: &Construction) {
    let mesh = &delaunay.mesh;
    let mut free = mesh.free().to_vec();
    free.sort_unstable();
    let dead: Vec<u32> = (0..mesh.slot_count() as u32).filter(|&t| !mesh.is_live(t)).collect();
    assert_eq!(free, dead);
}

fn finite_count(delaunay: &Construction) -> usize {
    let mesh = &delaunay.mesh;
    (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)).count()
}

#[test]
fn random_points() {
    let mut random = Lcg(1);
    let (delaunay, _) = build((0..3000).map(|_| [random.next(), random.next(), random.next()]).collect());
    let tets = finite_count(&delaunay);
    assert!((6 * 3000..7 * 3000).contains(&tets), "{tets}");
}

#[test]
fn integer_grid_is_filled_without_flat_tetrahedra() {
    let n = 9;
    let mut xyz = Vec::new();
    for i in 0..n {
        for j in 0..n {
            for k in 0..n {
                xyz.push([i as f64, j as f64, k as f64]);
            }
        }
    }
    let (delaunay, points) = build(xyz);
    let volume: f64 = (0..delaunay.mesh.slot_count() as u32)
        .filter(|&t| delaunay.mesh.is_live(t) && !delaunay.mesh.is_ghost(t))
        .map(|t| {
            let [a, b, c, d] = delaunay.mesh.verts(t).map(|v| points.xyz(v));
            let u: [f64; 3] = std::array::from_fn(|k| b[k] - a[k]);
            let v: [f64; 3] = std::array::from_fn(|k| c[k] - a[k]);
            let w: [f64; 3] = std::array::from_fn(|k| d[k] - a[k]);
            u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0])
                + u[2] * (v[0] * w[1] - v[1] * w[0])
        })
        .sum();
    // Integer coordinates: the sum is exact.
    assert_eq!(volume, 6.0 * ((n - 1) * (n - 1) * (n - 1)) as f64);
}

#[test]
fn nearly_everything_in_one_plane() {
    let mut random = Lcg(7);
    let mut xyz: Vec<[f64; 3]> =
        (0..500).map(|_| [(random.next() * 30.0).floor(), (random.next() * 30.0).floor(), 0.0]).collect();
    xyz.sort_by(|a, b| a.partial_cmp(b).unwrap());
    xyz.dedup();
    xyz.push([3.0, 4.0, 5.0]);
    build(xyz);
}

#[test]
fn large_cavities_are_linked_by_sorting() {
    // Two skew lines: every tetrahedron joins an edge of each, stars are as large as they get.
    let mut xyz: Vec<[f64; 3]> = (0..80).map(|i| [i as f64, 0.0, 0.0]).collect();
    xyz.extend((0..80).map(|i| [0.0, i as f64, 1.0]));
    let (delaunay, _) = build(xyz);
    assert_eq!(finite_count(&delaunay), 79 * 79);
}

#[test]
fn the_result_does_not_depend_on_the_order() {
    let mut xyz = Vec::new();
    for i in 0..5 {
        for j in 0..5 {
            for k in 0..5 {
                xyz.push([i as f64, j as f64, k as f64]);
            }
        }
    }
    let points = Points::new(xyz);
    let sorted_tets = |mut order: Vec<u32>| {
        let mut delaunay = Construction::default();
        delaunay.build(&points, &mut order, &Control::free()).unwrap();
        let mesh = &delaunay.mesh;
        let mut tets: Vec<[u32; 4]> = (0..mesh.slot_count() as u32)
            .filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t))
            .map(|t| {
                let mut v = mesh.verts(t);
                v.sort_unstable();
                v
            })
            .collect();
        tets.sort_unstable();
        tets
    };
    let forward: Vec<u32> = (0..125).collect();
    let backward: Vec<u32> = (0..125).rev().collect();
    let mixed: Vec<u32> = (0..125).map(|i| i * 62 % 125).collect();
    let reference = sorted_tets(forward);
    assert_eq!(reference, sorted_tets(backward));
    assert_eq!(reference, sorted_tets(mixed));
}

#[test]
fn coplanar_points_are_refused() {
    let points = Points::new((0..10).map(|i| [i as f64, (i * i % 7) as f64, 0.0]).collect());
    let mut delaunay = Construction::default();
    let mut order: Vec<u32> = (0..10).collect();
    let error = delaunay.build(&points, &mut order, &Control::free()).unwrap_err();
    assert_eq!(error.status, crate::Status::DegenerateInput);
}

/// Vertices, neighbours, flags and free slots.
type Bytes = (Vec<([u32; 4], [u32; 4], bool)>, Vec<u32>);

fn build_by(threads: usize, xyz: &[[f64; 3]]) -> (Construction, Points, Bytes) {
    let ids: Vec<u32> = (0..xyz.len() as u32).collect();
    let order = insertion_order(xyz, &ids, &Control::free()).unwrap();
    let points = Points::new(order.ids.iter().map(|&i| xyz[i as usize]).collect());
    let mut sequence = ids;
    let mut delaunay = Construction::default();
    let free = Control::free();
    let part = free.whole(Phase::Delaunay);
    delaunay.build_rounds(&points, &mut sequence, &order.rounds, threads, part).unwrap();
    let mesh = &delaunay.mesh;
    let bytes = (mesh.slots_as_they_are(), mesh.free().to_vec());
    (delaunay, points, bytes)
}

/// Point sets that are large enough for ranges.
fn large_sets() -> Vec<(&'static str, Vec<[f64; 3]>)> {
    const COUNT: usize = 72_000;
    let mut random = Lcg(11);
    let mut on_sphere = |radius: f64| loop {
        let p = [(); 3].map(|()| 2.0 * random.next() - 1.0);
        let r = p.iter().map(|x| x * x).sum::<f64>().sqrt();
        if (0.1..1.0).contains(&r) {
            return p.map(|x| radius * x / r);
        }
    };
    let sphere: Vec<[f64; 3]> = (0..COUNT).map(|_| on_sphere(1.0)).collect();
    let clustered = (0..COUNT)
        .map(|i| {
            let at = on_sphere(1e-4 * (1 + i % 1000) as f64);
            [at[0] + (i % 7) as f64, at[1] + (i % 3) as f64, at[2]]
        })
        .collect();
    let uniform = (0..COUNT).map(|_| [(); 3].map(|()| random.next())).collect();
    let mut plane: Vec<[f64; 3]> = (0..COUNT).map(|_| [random.next(), random.next(), 0.0]).collect();
    plane.push([0.5, 0.5, 1.0]);
    let grid = (0..42 * 42 * 42).map(|i| [i % 42, i / 42 % 42, i / 1764].map(f64::from)).collect();
    vec![("sphere", sphere), ("clustered", clustered), ("uniform", uniform), ("plane", plane), ("grid", grid)]
}

#[test]
fn any_number_of_threads_makes_the_same_bytes() {
    for (name, xyz) in large_sets() {
        let (delaunay, points, one) = build_by(1, &xyz);
        check_delaunay(&delaunay.mesh, &points).unwrap();
        slots_are_accounted_for(&delaunay);
        let round = delaunay.rounds.last().unwrap_or_else(|| panic!("{name}: no round by ranges"));
        assert!(round.ranges >= 2 && round.deferred[0] > 0, "{name}");
        for threads in [2, 3, 4, 7] {
            let before = HELPERS_STARTED.get();
            assert!(build_by(threads, &xyz).2 == one, "{name}, {threads} threads");
            assert!(HELPERS_STARTED.get() > before, "{name}, {threads} threads: no helper");
        }
    }
}

/// Tetrahedra extend through the inside of a cylinder from every range to others: the first pass gives up, and there is no other.
#[test]
fn ranges_are_given_up_where_tetrahedra_cross_them() {
    let mut random = Lcg(5);
    let xyz: Vec<[f64; 3]> = (0..72_000)
        .map(|_| {
            let angle = std::f64::consts::TAU * random.next();
            [angle.cos(), angle.sin(), 4.0 * random.next()]
        })
        .collect();
    let (delaunay, points, one) = build_by(1, &xyz);
    check_delaunay(&delaunay.mesh, &points).unwrap();
    slots_are_accounted_for(&delaunay);
    let round = delaunay.rounds.last().unwrap();
    assert!(round.deferred.len() == 1 && 4 * round.deferred[0] > 3 * round.vertices, "{round:?}");
    for threads in [2, 3, 7] {
        assert!(build_by(threads, &xyz).2 == one, "{threads} threads");
    }
}

#[test]
fn ranges_make_the_tetrahedra_that_one_by_one_insertion_makes() {
    for (name, xyz) in large_sets() {
        let (by_ranges, points, _) = build_by(2, &xyz);
        let mut one_by_one = Construction::default();
        let mut order: Vec<u32> = (0..xyz.len() as u32).collect();
        one_by_one.build(&points, &mut order, &Control::free()).unwrap();
        let set = |delaunay: &Construction| {
            let mesh = &delaunay.mesh;
            let live = (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t));
            let mut set: Vec<[u32; 4]> = live.map(|t| mesh.verts(t)).collect();
            set.iter_mut().for_each(|v| v.sort_unstable());
            set.sort_unstable();
            set
        };
        assert!(set(&by_ranges) == set(&one_by_one), "{name}");
    }
}

#[test]
fn a_cancel_reaches_all_workers() {
    let xyz = large_sets().swap_remove(2).1;
    let ids: Vec<u32> = (0..xyz.len() as u32).collect();
    let order = insertion_order(&xyz, &ids, &Control::free()).unwrap();
    let points = Points::new(order.ids.iter().map(|&i| xyz[i as usize]).collect());
    for threads in [1, 3] {
        let mut delaunay = Construction::default();
        let error = controlled(Limits::default(), &mut Enough, |control| {
            let part = control.whole(Phase::Delaunay);
            delaunay.build_rounds(&points, &mut ids.clone(), &order.rounds, threads, part).unwrap_err()
        });
        assert_eq!((error.status, &*error.message), (Status::Cancelled, "cancelled by the caller"));
        assert_eq!(delaunay.mesh.slot_count(), 0);
    }
}

/// Cancels in the last round.
struct Enough;

impl Observer for Enough {
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        assert_eq!(phase, Phase::Delaunay);
        if fraction > 0.4 {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

/// One insertion may take as long as all others: a vertex near the centre of a sphere with all others on it.
#[test]
fn a_large_cavity_can_be_left() {
    let xyz = large_sets().swap_remove(0).1;
    let mut order: Vec<u32> = (0..xyz.len() as u32).collect();
    let points = Points::new(xyz.into_iter().chain([[0.01, 0.02, 0.03]]).collect());
    let mut delaunay = Construction::default();
    delaunay.build(&points, &mut order, &Control::free()).unwrap();
    let Construction { mesh, inserter, hint, .. } = &mut delaunay;
    inserter.prepare(points.len()).unwrap();
    let token = CancelToken::new();
    controlled(Limits { cancel: Some(token.flag()), ..Limits::default() }, &mut Silent, |control| {
        let t = locate(mesh, &points, order.len() as u32, *hint).unwrap();
        control.look().unwrap();
        token.cancel();
        let error =
            inserter.insert::<false, false>(mesh, &points, order.len() as u32, t, control).unwrap_err();
        assert_eq!(error.status, Status::Cancelled);
    });
}

/// Light points come first, heavy ones last: the late ones take all tetrahedra of earlier vertices.
#[test]
fn vertices_are_hidden_by_later_ones_and_their_slots_are_free() {
    let mut random = Lcg(13);
    let mut light: Vec<[f64; 3]> = (0..2000).map(|_| [random.next(), random.next(), random.next()]).collect();
    for corner in 0..8u8 {
        light.push([0, 1, 2].map(|k| f64::from(corner >> k & 1) * 9.0 - 4.0));
    }
    let grid = (0..125).map(|i| [i % 5, i / 5 % 5, i / 25].map(|x| f64::from(x) / 4.0));
    let xyz: Vec<[f64; 3]> = light.iter().copied().chain(grid).collect();
    // A heavy point hides all lighter ones around it, out to the middle between the heavy ones.
    let offsets = (0..xyz.len()).map(|i| if i < light.len() { 0.0 } else { -1.0 }).collect();
    let mut points = Points::new(xyz);
    points.lift(Lifts::new(offsets, true));
    let mut forward = Construction::default();
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    forward.build(&points, &mut order, &Control::free()).unwrap();
    let mut backward = Construction::default();
    let mut order: Vec<u32> = (0..points.len() as u32).rev().collect();
    backward.build(&points, &mut order, &Control::free()).unwrap();
    let vertices = |delaunay: &Construction| {
        let mesh = &delaunay.mesh;
        check_delaunay(mesh, &points).unwrap();
        slots_are_accounted_for(delaunay);
        let mut all: Vec<u32> = mesh.all().filter(|&t| mesh.is_live(t)).flat_map(|t| mesh.verts(t)).collect();
        all.sort_unstable();
        all.dedup();
        all.pop();
        all
    };
    let heavy: Vec<u32> = (2000..points.len() as u32).collect();
    assert_eq!(vertices(&forward), heavy);
    assert_eq!(vertices(&backward), heavy);
    assert_eq!(finite_count(&forward), finite_count(&backward));
}

/// The squares as heights are no weights: the same perturbation breaks the same ties.
#[test]
fn heights_of_squares_make_the_same_mesh() {
    let xyz: Vec<[f64; 3]> = (0..343).map(|i| [i % 7, i / 7 % 7, i / 49].map(f64::from)).collect();
    let squares = xyz.iter().map(|p| p.iter().map(|x| x * x).sum()).collect();
    let set = |points: &Points| {
        let mesh = Construction::of(points);
        let mut tets: Vec<[u32; 4]> =
            mesh.all().filter(|&t| mesh.is_live(t)).map(|t| mesh.verts(t)).collect();
        tets.iter_mut().for_each(|tet| tet.sort_unstable());
        tets.sort_unstable();
        tets
    };
    let plain = Points::new(xyz);
    let mut lifted = plain.copied().unwrap();
    lifted.lift(Lifts::new(squares, false));
    assert!(set(&plain) == set(&lifted));
}
