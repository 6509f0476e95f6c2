//! Sheets on random meshes: the best of all triangulations of a link, and the mesh and what must stay of it are right after each.
use crate::kernel::edge_key;
use crate::kernel::replace::Replace;
use crate::kernel::tables::EDGE;
use crate::kernel::Mesh;
use crate::ops::quality::quality;
use crate::ops::scene_tests::{edges, finite, is_positive, mix, on_scenes, ring, triangulations, Scene};
use crate::ops::shape::{Goal, Measure, Shape};
use crate::ops::sheet::Sheets;
use std::cell::RefCell;

/// The longest link of which all triangulations are tried.
const MOST_TRIED: usize = 8;

/// The ring of an edge and its link, if all of it may go.
fn free_ring(scene: &Scene, edge: [u32; 2]) -> Option<(Vec<u32>, Vec<u32>)> {
    let mesh = &scene.mesh;
    let has = |&t: &u32| {
        EDGE.iter().any(|e| edge_key(mesh.vertex(t, e[0].into()), mesh.vertex(t, e[1].into())) == edge)
    };
    let start = finite(mesh).find(has).filter(|_| !scene.keep.contains(&edge))?;
    let (old, link) = ring(mesh, start, edge);
    let walled =
        |mesh: &Mesh, code: u32| mesh.is_subface(code) && edge.iter().all(|v| mesh.face(code).contains(v));
    let free = old.iter().all(|&t| !mesh.is_ghost(t) && !(4 * t..4 * t + 4).any(|code| walled(mesh, code)));
    free.then_some((old, link))
}

/// The best worst value that a valid sheet has, with an ear at the last vertex if there must be one.
fn best(scene: &Scene, [p, q]: [u32; 2], link: &[u32], ear: bool, value: impl Fn([u32; 4]) -> f64) -> f64 {
    let n = link.len();
    let all = triangulations(0, n - 1).into_iter().filter(|all| !ear || all.contains(&[0, n - 2, n - 1]));
    let worst = |all: Vec<[usize; 3]>| {
        let triangles = all.into_iter().map(|t| t.map(|i| link[i]));
        let tets: Vec<[u32; 4]> = triangles.flat_map(|[a, b, c]| [[a, b, c, q], [b, a, c, p]]).collect();
        let valid = tets.iter().all(|&t| is_positive(&scene.points, t));
        valid.then(|| tets.into_iter().map(&value).fold(f64::INFINITY, f64::min))
    };
    all.filter_map(worst).fold(f64::NEG_INFINITY, f64::max)
}

#[test]
fn the_best_sheet_comes_and_all_else_stays() {
    let counts = RefCell::new([[0; 2]; 4]);
    on_scenes(128, |mut scene| {
        let (mut sheets, mut replace) = (Sheets::default(), Replace::default());
        for edge in edges(&scene.mesh) {
            let Some((old, link)) = free_ring(&scene, edge) else { continue };
            let points = &scene.points;
            let dice = mix(&[scene.seed, edge[0], edge[1]]);
            let worst = |tets: &[[u32; 4]], value: &dyn Fn([u32; 4]) -> f64| {
                tets.iter().map(|&t| value(t)).fold(f64::INFINITY, f64::min)
            };
            let by_quality = |t: [u32; 4]| quality(t.map(|v| points.xyz(v)));
            let measure = if dice >> 8 & 1 == 0 { Measure::Angle } else { Measure::Ratio };
            let by_shape = |t: [u32; 4]| Shape::of(points, t).by(measure);
            let above = old.iter().map(|&t| by_shape(scene.mesh.verts(t))).fold(f64::INFINITY, f64::min);
            let small = link.len() <= MOST_TRIED;
            let mut new = Vec::new();
            let found = match dice % 4 {
                kind @ (0 | 1) => {
                    let found = sheets.fill(points, edge, &link, kind == 1, &mut new).unwrap();
                    if small {
                        let best = best(&scene, edge, &link, kind == 1, by_quality);
                        assert_eq!(if found { worst(&new, &by_quality) } else { f64::NEG_INFINITY }, best);
                    }
                    found
                }
                2 => {
                    let way = [link[0], dice / 16 % points.len() as u32];
                    let found = sheets.clear(points, edge, &link, way, &mut new).unwrap();
                    assert_eq!(found, sheets.fill(points, edge, &link, false, &mut Vec::new()).unwrap());
                    found
                }
                _ => {
                    let goal = Goal { measure, above, least: 0.0, largest: f64::INFINITY };
                    let found = sheets.improve(points, edge, &link, &goal, &mut new).unwrap();
                    if small {
                        let best = best(&scene, edge, &link, false, by_shape);
                        assert!(if found { worst(&new, &by_shape) == best } else { best <= above });
                    }
                    assert!(!found || worst(&new, &by_shape) > above);
                    found
                }
            };
            counts.borrow_mut()[dice as usize % 4][usize::from(found)] += 1;
            let before = scene.state();
            assert_eq!(new.len(), if found { 2 * (link.len() - 2) } else { 0 });
            if found {
                replace.cavity(&mut scene.mesh, &old, &new, &[]).unwrap();
                scene.check(&before, &[]);
                assert!(edges(&scene.mesh).binary_search(&edge).is_err());
            }
        }
    });
    let counts = counts.into_inner();
    println!("none and a sheet, plain, with ear, with a way, better: {counts:?}");
    assert!(counts.iter().flatten().all(|&n| n > 20), "{counts:?}");
}
