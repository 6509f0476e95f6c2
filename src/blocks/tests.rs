use super::*;
use crate::kernel::block::Shares;
use crate::kernel::replace::Replace;
use crate::ops::check::check_domain;
use crate::ops::scene_tests::{finite, mix, on_scenes, Scene};

const CASES: u32 = if cfg!(debug_assertions) { 200 } else { 2000 };

/// Tetrahedra in up to four blocks as if at random, in single pieces and touching each other in vertices and edges; some are in none.
fn scattered(scene: &Scene) -> Shares {
    let Scene { mesh, seed, .. } = scene;
    let count = 1 + seed % 4;
    let owner = |t: u32| mix(&[*seed, t]) % (count + u32::from(seed % 3 == 0));
    let (mut slots, mut starts) = (Vec::new(), vec![0]);
    for block in 0..count {
        slots.extend(finite(mesh).filter(|&t| owner(t) == block));
        starts.push(slots.len());
    }
    let mut rank = vec![NONE; mesh.slot_count()];
    for (i, &t) in (0u32..).zip(&slots) {
        rank[t as usize] = i;
    }
    Shares { slots, starts, rank }
}

fn pieces(scene: &Scene, shares: &Shares) -> Vec<Piece> {
    let movable = vec![false; scene.points.len()];
    let whole = Whole { mesh: &scene.mesh, points: &scene.points, movable: &movable };
    let mut numbering = Numbering::default();
    let piece = |i| whole.piece(shares, i, &mut numbering, &Control::free()).unwrap();
    (0..shares.count()).map(piece).collect()
}

#[test]
fn blocks_that_do_not_change_leave_the_mesh_as_it_was() {
    on_scenes(CASES, |mut scene| {
        let before = scene.state();
        let slots = scene.mesh.slots_as_they_are();
        let shares = scattered(&scene);
        let pieces = pieces(&scene, &shares);
        let Scene { mesh, points, .. } = &mut scene;
        for (i, piece) in pieces.into_iter().enumerate() {
            check_domain(&piece.block.mesh, &piece.points).unwrap();
            assert_eq!(finite(&piece.block.mesh).count(), shares.of(i).len());
            let mut inside = Inside::default();
            piece.put_back(&mut Model { mesh, points, inside: &mut inside }, &Control::free()).unwrap();
        }
        assert_eq!(scene.mesh.slots_as_they_are(), slots);
        scene.check(&before, &[]);
    });
}

/// Every second tetrahedron of each block gets a vertex, or two of them lose one again, while all blocks are apart.
#[test]
fn blocks_that_change_at_the_same_time_fit_together_again() {
    on_scenes(CASES, |mut scene| {
        let before = scene.state();
        let shares = scattered(&scene);
        let mut pieces = pieces(&scene, &shares);
        let mut replace = Replace::default();
        let mut count = 0;
        for piece in &mut pieces {
            let Piece { block: Block { mesh, .. }, points, inside, .. } = piece;
            let tets: Vec<u32> = finite(mesh).filter(|t| t % 2 == scene.seed % 2).collect();
            for t in tets {
                let v = mesh.verts(t);
                let at = [0, 1, 2].map(|k| v.iter().map(|&v| points.xyz(v)[k]).sum::<f64>() / 4.0);
                let p = inside.add(mesh, points, at).unwrap();
                let new: Vec<[u32; 4]> = (4 * t..4 * t + 4)
                    .map(|code| {
                        let [x, y, z] = mesh.face(code);
                        [p, x, y, z]
                    })
                    .collect();
                replace.cavity(mesh, &[t], &new, &[]).unwrap();
                count += 1;
                if t % 3 == 0 {
                    let star = replace.fresh.clone();
                    replace.cavity(mesh, &star, &[v], &[]).unwrap();
                    mesh.vertex_tet[p as usize] = NONE;
                    count -= 1;
                }
            }
        }
        let Scene { mesh, points, .. } = &mut scene;
        let mut inside = Inside::default();
        for piece in pieces {
            piece.put_back(&mut Model { mesh, points, inside: &mut inside }, &Control::free()).unwrap();
        }
        assert_eq!(inside.list.len(), count);
        check_domain(mesh, points).unwrap();
        let now = scene.state();
        assert_eq!(now.tets.len(), before.tets.len() + 3 * count);
        assert_eq!(now.vertices.len(), before.vertices.len() + count);
        scene.same_domain(&before);
    });
}

/// In every round all tetrahedra that count are in one block, and in the end every vertex has once been inside one.
#[test]
fn rounds_settle_everything() {
    let mut state = 9u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (state >> 20) as f64 / (1u64 << 44) as f64
    };
    let points = Points::new((0..3000).map(|_| [next(), 3.0 * next(), next()]).collect());
    let mut mesh = crate::delaunay::Construction::of(&points);
    mesh.set_regions(|_| 0).unwrap();
    mesh.index_vertices(points.len()).unwrap();
    let control = Control::free();
    let mut rounds = Rounds::new(&points).unwrap();
    let (mut counts, mut settled) = (Vec::new(), vec![false; points.len()]);
    while let Some(shares) = rounds.next(&mesh, &points, 700, &control).unwrap() {
        let mut sorted = shares.slots.clone();
        sorted.sort_unstable();
        assert!(sorted.windows(2).all(|pair| pair[0] < pair[1]));
        let sizes = (0..shares.count()).map(|i| shares.of(i).len());
        assert!(counts.is_empty() || sizes.clone().sum::<usize>() <= counts[0]);
        if counts.is_empty() {
            assert_eq!(sorted.len(), finite(&mesh).count());
            assert!(shares.count() > 20 && sizes.clone().all(|size| (350..1400).contains(&size)));
        }
        counts.push(sorted.len());
        let mut apart = vec![false; points.len()];
        for t in finite(&mesh) {
            for code in 4 * t..4 * t + 4 {
                let n = mesh.across(code) >> 2;
                let block = (0..shares.count()).find(|&i| shares.has(i, t));
                if !mesh.is_wall(code) && !block.is_some_and(|i| shares.has(i, n)) {
                    mesh.face(code).into_iter().for_each(|v| apart[v as usize] = true);
                }
            }
        }
        settled.iter_mut().zip(&apart).for_each(|(settled, apart)| *settled |= !apart);
        for v in 0..points.len() as u32 {
            assert!(
                !settled[v as usize] || rounds.done == 1 || !rounds.is_unsettled(v) || !apart[v as usize]
            );
        }
    }
    assert!(counts.len() <= MOST_ROUNDS + 2 && settled.iter().all(|&settled| settled), "{counts:?}");
}
