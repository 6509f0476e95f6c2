//! Invariants after every step, on small models.
use super::*;
use crate::control::{controlled, CancelToken, Control, Limits};
use crate::delaunay::insert::Inserter;
use crate::delaunay::Construction;
use crate::domain::{components, label, Seeds};
use crate::error::Status;
use crate::facets::recovery::FacetRecovery;
use crate::facets::subface::{Subfaces, Triangles};
use crate::kernel::around::StarSearch;
use crate::kernel::replace::{Replace, Sector};
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::kernel::{edge_key, face_key};
use crate::ops::center::{center, Plane};
use crate::ops::check::check_domain;
use crate::ops::hollow::Start;
use crate::ops::polygon::Polygons;
use crate::ops::widen::{Kept, Rays, Widen};
use crate::predicates::Sign;
use crate::preserve::release::patches::Target;
use crate::progress::{Phase, Silent};
use crate::segments::recovery::Recovery;
use rustc_hash::FxHashSet;

/// The patch of each subface.
fn patches(mesh: &Mesh) -> FxHashMap<[u32; 3], u32> {
    mesh.subfaces().map(|code| (face_key(mesh.face(code)), mesh.subface(code))).collect()
}

/// A triangulated surface whose triangles are patches of their own, but for those that share a number in `patch`.
struct Model {
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    patch: Vec<u32>,
    keep_hull: bool,
}

impl Model {
    fn new(points: &[[f64; 3]], triangles: &[[u32; 3]]) -> Model {
        let patch = (0..triangles.len() as u32).collect();
        Model { points: points.to_vec(), triangles: triangles.to_vec(), patch, keep_hull: false }
    }

    fn segments(&self) -> Vec<[u32; 2]> {
        let mut uses: Vec<([u32; 2], u32)> = Vec::new();
        for (&[a, b, c], &patch) in self.triangles.iter().zip(&self.patch) {
            uses.extend([(a, b), (b, c), (c, a)].map(|(x, y)| (edge_key(x, y), patch)));
        }
        uses.sort_unstable();
        uses.chunk_by(|x, y| x.0 == y.0)
            .filter(|group| group.len() != 2 || group[0].1 != group[1].1)
            .map(|group| group[0].0)
            .collect()
    }

    /// The constrained mesh of the domain, with its points and segments.
    fn carve(&self) -> (Mesh, Points, Segments) {
        let free = &Control::free();
        let mut points = Points::new(self.points.clone());
        let (mut mesh, mut inserter) = (Construction::of(&points), Inserter::default());
        let mut segments = Segments::new(&points, self.segments(), free).unwrap();
        Recovery::new(&mut mesh, &mut inserter, &mut points, &mut segments, free).run().unwrap();
        let facet = vec![0; self.triangles.len()];
        let triangles = Triangles {
            corners: &self.triangles,
            facet: &facet,
            patch: &self.patch,
            patch_count: self.patch.len(),
        };
        let subfaces = Subfaces::build(&points, &triangles, &segments, free).unwrap();
        FacetRecovery::new(&mut mesh, &points, &subfaces, free).unwrap().run().unwrap();
        mesh.clear_subsegments();
        let parts = components(&mesh, free).unwrap();
        let seeds = Seeds { holes: &[], regions: &[], exponent: 0 };
        let regions = label(&mesh, &mut points, &parts, &seeds, self.keep_hull, free).unwrap();
        mesh.set_regions(|t| regions.of_component[parts.of[t as usize] as usize]).unwrap();
        carve(&mut mesh, points.len(), &subfaces, free).unwrap();
        check_domain(&mesh, &points).unwrap();
        (mesh, points, segments)
    }

    /// Removes all points from the surface and checks the result; returns the statistics.
    fn free(&self) -> PreserveStatistics {
        let (mut mesh, mut points, segments) = self.carve();
        let before = volume(&mesh, &points);
        let facet = vec![0; self.triangles.len()];
        let preserve = crate::options::Preserve::All;
        let target = Target {
            triangles: &self.triangles,
            patch: &self.patch,
            facet: &facet,
            first_polygon: u32::MAX,
            preserve,
            attempt: 0,
        };
        let mut statistics = PreserveStatistics::default();
        let Freed { inside, .. } = from_constrained(
            &mut mesh,
            &mut points,
            &segments,
            &target,
            Inside::default(),
            &mut statistics,
            Control::free().whole(Phase::Preserve),
        )
        .unwrap();
        check_domain(&mesh, &points).unwrap();
        let there = patches(&mesh);
        for &triangle in &self.triangles {
            assert!(there.contains_key(&face_key(triangle)), "{triangle:?} is no face");
        }
        assert_eq!(there.len(), self.triangles.len());
        for (v, &t) in mesh.vertex_tet.iter().enumerate().skip(self.points.len()) {
            assert_eq!(t != crate::kernel::NONE, inside.list.contains(&(v as u32)), "point {v}");
        }
        assert!((volume(&mesh, &points) - before).abs() <= 1e-9 * before);
        assert_eq!(statistics.interior, inside.list.len() as u64);
        assert_eq!(statistics.deleted + statistics.relocated, segments.steiner_t.len() as u64);
        statistics
    }
}

fn volume(mesh: &Mesh, points: &Points) -> f64 {
    let mut sum = 0.0;
    for t in (0..mesh.slot_count() as u32).filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t)) {
        let [a, b, c, d] = mesh.verts(t).map(|v| *points.xyz(v));
        let u = [b, c, d].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
        sum += u[0][0] * (u[1][1] * u[2][2] - u[1][2] * u[2][1])
            - u[0][1] * (u[1][0] * u[2][2] - u[1][2] * u[2][0])
            + u[0][2] * (u[1][0] * u[2][1] - u[1][1] * u[2][0]);
    }
    sum / 6.0
}

/// Schönhardt's polyhedron: a prism twisted so far that no diagonal is inside.
fn schoenhardt() -> Model {
    let ring = |z: f64, turn: f64| {
        [0.0, 1.0, 2.0].map(|k: f64| {
            let angle = turn + k * std::f64::consts::TAU / 3.0;
            [angle.cos(), angle.sin(), z]
        })
    };
    let points = [ring(0.0, 0.0), ring(1.0, std::f64::consts::FRAC_PI_6)].concat();
    // The diagonals that span the larger angle are reflex.
    let mut triangles = vec![[0, 2, 1], [3, 4, 5]];
    for i in 0..3u32 {
        let j = (i + 1) % 3;
        triangles.push([i, 3 + j, 3 + i]);
        triangles.push([i, j, 3 + j]);
    }
    Model::new(&points, &triangles)
}

/// A cube of `2n²` triangles a side with all diagonals leaning the same way.
fn cube(n: u32, keep_hull: bool) -> Model {
    let mut points: Vec<[f64; 3]> = Vec::new();
    let mut triangles = Vec::new();
    let mut patch = Vec::new();
    let mut number = |p: [u32; 3]| {
        let p = p.map(f64::from);
        points.iter().position(|q| *q == p).unwrap_or_else(|| {
            points.push(p);
            points.len() - 1
        }) as u32
    };
    for axis in 0..3 {
        for side in [0, n] {
            for i in 0..n {
                for j in 0..n {
                    let mut at = |di: u32, dj: u32| {
                        let mut p = [side; 3];
                        p[(axis + 1) % 3] = i + di;
                        p[(axis + 2) % 3] = j + dj;
                        number(p)
                    };
                    let [a, b, c, d] = [at(0, 0), at(1, 0), at(1, 1), at(0, 1)];
                    // The corner that both triangles share alternates between sides.
                    triangles.extend(if side == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
                    patch.extend([2 * axis as u32 + u32::from(side > 0); 2]);
                }
            }
        }
    }
    Model { points, triangles, patch, keep_hull }
}

#[test]
fn schoenhardt_needs_exactly_one_point() {
    let statistics = schoenhardt().free();
    assert_eq!(statistics.interior, 1, "{statistics:?}");
}

#[test]
fn a_cube_gets_its_triangles_back() {
    for n in 1..5 {
        for keep_hull in [false, true] {
            let statistics = cube(n, keep_hull).free();
            assert!(statistics.interior <= 1, "{n}: {statistics:?}");
        }
    }
}

#[test]
fn a_fin_in_a_box_is_freed_on_both_sides() {
    // A dangling triangle inside a long tetrahedron, whose edges are not Delaunay: thin points crowd round it.
    let mut model = cube(1, false);
    model.points.extend([[0.1, 0.1, 0.5], [0.9, 0.9, 0.5], [0.5, 0.5, 0.9]]);
    for i in 0..6 {
        let t = 0.2 + 0.1 * f64::from(i);
        model.points.push([t + 0.015625, t - 0.015625, 0.5 + 0.00390625 * f64::from(i % 2)]);
    }
    model.triangles.push([8, 9, 10]);
    model.patch.push(6);
    let statistics = model.free();
    assert!(statistics.deleted + statistics.relocated > 0, "nothing was to be done: {statistics:?}");
}

#[test]
fn the_center_of_a_box_is_found() {
    let plane = |normal, offset| Plane { normal, offset };
    let planes = [
        plane([1.0, 0.0, 0.0], 1.0),
        plane([-1.0, 0.0, 0.0], 3.0),
        plane([0.0, 1.0, 0.0], 0.5),
        plane([0.0, -1.0, 0.0], 0.5),
        plane([0.0, 0.0, 1.0], 2.0),
        plane([0.0, 0.0, -1.0], 2.0),
    ];
    let (p, distance) = center(&planes, 16.0);
    assert!((distance - 0.5).abs() < 1e-9 && p[1].abs() < 1e-9, "{p:?} {distance}");
    // Two half-spaces without a common point.
    let (_, distance) = center(&[plane([1.0, 0.0, 0.0], -1.0), plane([-1.0, 0.0, 0.0], -1.0)], 16.0);
    assert!(distance < 0.0);
}

#[test]
fn polygons_are_triangulated_as_wanted() {
    // A notched polygon with three corners in a row.
    let xy = [[0.0, 0.0], [2.0, 1.0], [4.0, 0.0], [4.0, 2.0], [4.0, 4.0], [0.0, 4.0]];
    let points = Points::new(xy.iter().map(|p| [p[0], p[1], 1.0]).collect());
    let polygon = [0, 1, 2, 3, 4, 5];
    let mut polygons = Polygons::default();
    let area = |list: &[[u32; 3]]| -> f64 {
        list.iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| xy[v as usize]);
                ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
            })
            .sum()
    };
    let all = polygons.triangulations(&points, 2, &polygon, &|_, _| false).unwrap();
    assert!(all.len() > 1);
    for list in &all {
        assert_eq!((list.len(), area(list)), (4, 14.0));
    }
    let wanted = polygons.triangulations(&points, 2, &polygon, &|a, b| edge_key(a, b) == [1, 4]).unwrap();
    assert!(wanted[0].iter().filter(|t| t.contains(&1) && t.contains(&4)).count() == 2);
}

/// A cube with a grid of points inside, each moved by next to nothing: the Delaunay mesh is full of slivers.
fn crystal(n: i32) -> Model {
    let far = f64::from(n);
    let mut points: Vec<[f64; 3]> =
        (0..8).map(|i| [0, 1, 2].map(|k| if i >> k & 1 == 0 { -far } else { far })).collect();
    let mut noise = 1u32;
    for i in 0..n * n * n {
        points.push([i % n, i / n % n, i / n / n].map(|x| {
            noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f64::from(x) - 0.5 * (far - 1.0) + f64::from(noise) * 2f64.powi(-60)
        }));
    }
    let quads = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    let triangles: Vec<[u32; 3]> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    // Both triangles of a side are one patch.
    Model { patch: (0..12).map(|t| t / 2).collect(), ..Model::new(&points, &triangles) }
}

fn worst(mesh: &Mesh, points: &Points) -> crate::ops::shape::Shape {
    use crate::ops::shape::Shape;
    (0..mesh.slot_count() as u32)
        .filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t))
        .map(|t| crate::ops::reshape::shape(mesh, points, t))
        .fold(Shape::BEST, Shape::worse)
}

fn edges(mesh: &Mesh) -> rustc_hash::FxHashSet<[u32; 2]> {
    let mut edges = rustc_hash::FxHashSet::default();
    for t in (0..mesh.slot_count()).filter(|&t| mesh.is_live(t as u32)) {
        let v = mesh.verts(t as u32);
        edges.extend(crate::kernel::tables::EDGE.map(|[i, j]| edge_key(v[i as usize], v[j as usize])));
    }
    edges
}

#[test]
fn slivers_are_reconnected_away() {
    for n in 3..6 {
        let (mut mesh, points, segments) = crystal(n).carve();
        assert!(segments.steiner_t.is_empty());
        let (first, volume_before, before_patches) =
            (worst(&mesh, &points), volume(&mesh, &points), patches(&mesh));
        improve::improve(&mut mesh, &points, &Default::default(), &Control::free()).unwrap();
        check_domain(&mesh, &points).unwrap();
        let last = worst(&mesh, &points);
        println!("{n}: {first:?} {last:?}");
        assert!(first.angle < 1e-6 && last.angle > 0.01, "{n}: {first:?} {last:?}");
        assert!(last.ratio >= first.ratio.min(0.1));
        assert_eq!(patches(&mesh), before_patches);
        assert!((volume(&mesh, &points) - volume_before).abs() <= 1e-12 * volume_before);
    }
}

fn sorted(mut tet: [u32; 4]) -> [u32; 4] {
    tet.sort_unstable();
    tet
}

/// If no edge can be removed, walls get another apex: all new tetrahedra are better than the removed ones, and the surface stays.
#[test]
fn walls_get_better_apexes() {
    use crate::ops::reshape::{Aim, Effort, Reshape};
    use crate::ops::shape::{Measure, Shape};
    let mut model = cube(2, false);
    let mut state = 5u64;
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        0.125 + 1.75 * ((state >> 33) as f64 / (1u64 << 31) as f64)
    };
    model.points.extend((0..200).map(|_| [next(), next(), next()]));
    for measure in [Measure::Angle, Measure::Ratio] {
        let (mut mesh, points, _) = model.carve();
        let (before, before_patches) = (volume(&mesh, &points), patches(&mesh));
        let any = Shape::default();
        let aim = Aim { measure, enough: any, least: any, largest: f64::INFINITY };
        let free = &Control::free();
        let (mut reshape, mut lifted, none) = (Reshape::new(free), 0, FxHashSet::default());
        for t in 0..mesh.slot_count() as u32 {
            if !mesh.is_live(t) || mesh.is_ghost(t) {
                continue;
            }
            let walled = (4 * t..4 * t + 4).any(|code| mesh.is_wall(code));
            let old: Vec<[u32; 4]> = mesh.all().map(|t| mesh.verts(t)).collect();
            let live: Vec<bool> = (0..old.len() as u32).map(|t| mesh.is_live(t)).collect();
            let mut try_with = |thorough: bool, mesh: &mut Mesh| {
                let effort = Effort { cavities: &[], thorough };
                reshape.improve(mesh, &points, &none, t, &aim, effort).unwrap()
            };
            if try_with(false, &mut mesh) || !try_with(true, &mut mesh) {
                continue;
            }
            assert!(walled);
            lifted += 1;
            // The removed tetrahedra: those of the previous mesh that no longer exist.
            let now: FxHashSet<[u32; 4]> =
                mesh.all().filter(|&t| mesh.is_live(t)).map(|t| sorted(mesh.verts(t))).collect();
            let worst_of_cavity = (0..old.len())
                .filter(|&t| {
                    live[t] && !old[t].contains(&crate::kernel::GHOST) && !now.contains(&sorted(old[t]))
                })
                .map(|t| Shape::of(&points, old[t]).by(measure))
                .fold(f64::INFINITY, f64::min);
            let came = reshape
                .replace
                .fresh
                .iter()
                .map(|&t| crate::ops::reshape::shape(&mesh, &points, t).by(measure));
            assert!(came.fold(f64::INFINITY, f64::min) > worst_of_cavity);
            check_domain(&mesh, &points).unwrap();
        }
        assert!(lifted > 0);
        assert_eq!(patches(&mesh), before_patches);
        assert!((volume(&mesh, &points) - before).abs() <= 1e-12 * before);
    }
}

#[test]
fn edges_on_no_facet_stay_when_a_mesh_is_improved() {
    let (mut mesh, points, _) = crystal(4).carve();
    let improved = {
        let mut mesh = mesh.copied().unwrap();
        improve::improve(&mut mesh, &points, &Default::default(), &Control::free()).unwrap();
        edges(&mesh)
    };
    let gone: rustc_hash::FxHashSet<[u32; 2]> = edges(&mesh).difference(&improved).copied().collect();
    assert!(gone.len() > 5);
    improve::improve(&mut mesh, &points, &gone, &Control::free()).unwrap();
    check_domain(&mesh, &points).unwrap();
    assert!(gone.is_subset(&edges(&mesh)));
}

#[test]
fn improvement_can_be_cancelled() {
    let (mut mesh, points, _) = crystal(3).carve();
    let token = CancelToken::new();
    token.cancel();
    let limits = Limits { cancel: Some(token.flag()), ..Limits::default() };
    let result = controlled(limits, &mut Silent, |control| {
        improve::improve(&mut mesh, &points, &Default::default(), control)
    });
    assert_eq!(result.unwrap_err().status, Status::Cancelled);
    check_domain(&mesh, &points).unwrap();
}

/// A cavity grown for a position is star-shaped from it, swallows only allowed points, and fits into the mesh.
#[test]
fn cavities_grow_round_a_position() {
    let mut model = cube(2, false);
    let (first, mut state) = (model.points.len(), 3u64);
    let mut next = || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        0.25 + 1.5 * ((state >> 33) as f64 / (1u64 << 31) as f64)
    };
    model.points.extend((0..60).map(|_| [next(), next(), next()]));
    for may_swallow in [true, false] {
        let (mut mesh, mut points, _) = model.carve();
        let inner: Vec<u32> = (first as u32..model.points.len() as u32).collect();
        let mut inside = Inside::of(inner.clone());
        let (mut widen, mut search, mut link) = (Widen::default(), StarSearch::default(), Vec::new());
        let (mut moves, mut swallowed) = (0, 0);
        for &v in &inner {
            if mesh.vertex_tet[v as usize] == NONE {
                continue;
            }
            search.link(&mesh, v, &mut link).unwrap();
            let (from, region) = (*points.xyz(v), mesh.region(search.tets[0]));
            let p = inside.add(&mut mesh, &mut points, from).unwrap();
            let (tets, gone, walls, taken) = (&search.tets, &[], &[], &[]);
            let start = Start { tets, gone, walls, without: v, edge: None, avoid: [v; 2], taken };
            let known: &[u32] = if may_swallow { &inside.list } else { &[] };
            let rays = Rays { point: p, from, toward: &[[0.6, 0.8, 0.0], [0.0, -0.6, 0.8]] };
            let none = FxHashSet::default();
            let kept = Kept { isolated: &none, inside: known };
            let new = widen.place(&mesh, &mut points, &start, kept, &rays, &Control::free()).unwrap();
            let Some(new) = new else { continue };
            assert!(new.iter().all(|&[p, x, y, z]| points.orient3d(p, x, y, z) == Sign::Positive));
            moves += usize::from(widen.cavity.tets.len() > search.tets.len());
            swallowed += widen.swallowed.len();
            let sector = Sector { old: std::mem::take(&mut widen.cavity.tets), new, region };
            Replace::default().sectors(&mut mesh, &[sector], &[], &[]).unwrap();
            for &w in widen.swallowed.iter().chain([&v]) {
                assert!(inside.list.contains(&w));
                mesh.vertex_tet[w as usize] = NONE;
            }
            check_domain(&mesh, &points).unwrap();
        }
        assert!((volume(&mesh, &points) - 8.0).abs() < 1e-12);
        assert!(moves > 20 && (swallowed > 0) == may_swallow, "{moves} {swallowed}");
    }
}
