//! Small random meshes for the tests of operations, and what every operation must leave as it is.
//!
//! Coordinates are small integers, so most signs are zero somewhere: points on a grid with their Delaunay mesh, and stars of an edge or of
//! vertices on a line, far from Delaunay and not convex. Regions, subfaces, their names and edges to keep are put anywhere.
use crate::control::Control;
use crate::delaunay::Construction;
use crate::kernel::around::{EdgeRing, StarSearch};
use crate::kernel::cavity::Edges;
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, face_key, Mesh, NONE};
use crate::ops::check::check_domain;
use crate::ops::sheet::Sheets;
use crate::predicates::{Points, Sign};
use crate::vector::{cross, dot, sub};
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestRunner};
use std::collections::BTreeMap;

/// Directions round an axis, in order; many are opposite to others.
const ROUND: [[i32; 2]; 16] = [
    [1, 0],
    [2, 1],
    [1, 1],
    [1, 2],
    [0, 1],
    [-1, 2],
    [-1, 1],
    [-2, 1],
    [-1, 0],
    [-2, -1],
    [-1, -1],
    [-1, -2],
    [0, -1],
    [1, -2],
    [1, -1],
    [2, -1],
];

/// What a mesh is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The Delaunay mesh of points of a cube.
    Grid,
    /// The tetrahedra round the edge 0 1; their link are the vertices from 2 on.
    Ring,
    /// The same without the edge.
    Sheet,
    /// The same with the edge divided by one or two vertices inside.
    Chain,
}

/// How to make a scene.
#[derive(Clone, Debug)]
pub struct Recipe {
    kind: Kind,
    places: Vec<[i32; 3]>,
    /// What hangs on it, and the height of stars.
    seed: u32,
}

/// A mesh with all that hangs on it.
pub struct Scene {
    /// What it is made of.
    pub kind: Kind,
    /// The mesh.
    pub mesh: Mesh,
    /// Its vertices.
    pub points: Points,
    /// Edges that must stay.
    pub keep: Edges,
    /// Where a test may take choices from.
    pub seed: u32,
}

/// What must stay, and the tetrahedra.
pub struct State {
    subfaces: Vec<([u32; 3], u32)>,
    volumes: BTreeMap<u32, f64>,
    /// The vertices that tetrahedra have, in order.
    pub vertices: Vec<u32>,
    /// The tetrahedra, each always with the same order of corners, in order.
    pub tets: Vec<[u32; 4]>,
}

/// A number from others, as if at random.
pub fn mix(numbers: &[u32]) -> u32 {
    let step = |h: u64, &x: &u32| (h ^ u64::from(x)).wrapping_mul(0x9e37_79b9_7f4a_7c15).rotate_left(29);
    (numbers.iter().fold(1, step).wrapping_mul(0xbf58_476d_1ce4_e5b9) >> 33) as u32
}

/// Runs a test on as many random scenes, always the same; on others, and more, by the environment variable `PROPTEST_CASES`.
pub fn on_scenes(cases: u32, test: impl Fn(Scene)) {
    let default = ProptestConfig::default();
    let search = std::env::var_os("PROPTEST_CASES").is_some();
    let (cases, rng_seed) =
        if search { (default.cases, default.rng_seed) } else { (cases, RngSeed::Fixed(1)) };
    let config = ProptestConfig { cases, rng_seed, failure_persistence: None, ..default };
    let kind = prop_oneof![
        2 => Just(Kind::Grid),
        1 => Just(Kind::Ring),
        2 => Just(Kind::Sheet),
        1 => Just(Kind::Chain)
    ];
    let places = prop::collection::vec([0..5, 0..5, 0..5], 3..16);
    let recipes = (kind, places, any::<u32>()).prop_map(|(kind, places, seed)| Recipe { kind, places, seed });
    let outcome = TestRunner::new(config).run(&recipes, |recipe| {
        recipe.scene().into_iter().for_each(&test);
        Ok(())
    });
    outcome.unwrap_or_else(|error| panic!("{error}"));
}

impl Recipe {
    fn scene(&self) -> Option<Scene> {
        let (mesh, points) = if self.kind == Kind::Grid { self.grid() } else { self.star()? };
        let Recipe { kind, seed, .. } = *self;
        let mut scene = Scene { kind, mesh, points, keep: Edges::default(), seed };
        scene.attach();
        check_domain(&scene.mesh, &scene.points).unwrap();
        Some(scene)
    }

    fn grid(&self) -> (Mesh, Points) {
        let corners = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2].map(|x| 4 * x));
        // Every second point is inside.
        let places = self.places.iter().zip([0, 1].into_iter().cycle());
        let places = places.map(|(&p, least)| p.map(|x| x.clamp(least, 4 - least)));
        let mut all: Vec<[i32; 3]> = corners.chain(places).collect();
        all.sort_unstable();
        all.dedup();
        let points = Points::new(all.iter().map(|p| p.map(f64::from)).collect());
        (Construction::of(&points), points)
    }

    fn star(&self) -> Option<(Mesh, Points)> {
        let mut round = BTreeMap::new();
        for &[x, y, z] in &self.places {
            let way = (5 * x + y) % 16;
            let [p, q] = ROUND[way as usize].map(|c| f64::from(c * (1 + (x + z) % 2)));
            round.entry(way).or_insert([p, q, f64::from(z - 2)]);
        }
        let height = f64::from(1 + self.seed % 4);
        let inner: &[f64] = match (self.kind, self.seed / 4 % 2) {
            (Kind::Chain, 0) => &[0.0],
            (Kind::Chain, _) => &[-0.5, 0.25],
            _ => &[],
        };
        let mut xyz = vec![[0.0, 0.0, -height], [0.0, 0.0, height]];
        xyz.extend(round.values());
        let link: Vec<u32> = (2..xyz.len() as u32).collect();
        let mut axis = vec![0];
        axis.extend(xyz.len() as u32..(xyz.len() + inner.len()) as u32);
        axis.push(1);
        xyz.extend(inner.iter().map(|&z| [0.0, 0.0, z]));
        let points = Points::new(xyz);
        let sides: Vec<[u32; 2]> = (0..link.len()).map(|k| [link[k], link[(k + 1) % link.len()]]).collect();
        let mut tets: Vec<[u32; 4]> =
            axis.windows(2).flat_map(|p| sides.iter().map(|&[r, s]| [p[0], p[1], r, s])).collect();
        if link.len() < 3 || !tets.iter().all(|&t| is_positive(&points, t)) {
            return None;
        }
        if self.kind == Kind::Sheet {
            tets.clear();
            if !Sheets::default().fill(&points, [0, 1], &link, false, &mut tets).unwrap() {
                return None;
            }
        }
        Some((Mesh::of_tetrahedra(&tets, points.len()).unwrap(), points))
    }
}

impl Scene {
    /// Puts regions, subfaces and edges to keep on the mesh.
    fn attach(&mut self) {
        let Scene { mesh, points, keep, seed, .. } = self;
        let seed = *seed / 8;
        let middle = points.coordinates().iter().map(|p| p[0]).sum::<f64>() / points.len() as f64;
        let is_beyond: Vec<bool> = mesh
            .all()
            .map(|t| {
                !mesh.is_ghost(t)
                    && mesh.verts(t).iter().map(|&v| points.xyz(v)[0] - middle).sum::<f64>() > 0.0
            })
            .collect();
        match seed % 4 {
            0 => {}
            1 | 2 => mesh.set_regions(|_| 5).unwrap(),
            _ => mesh.set_regions(|t| u32::from(is_beyond[t as usize])).unwrap(),
        }
        let rare = [u32::MAX, u32::MAX, 60, 12][(seed / 4 % 4) as usize];
        let codes = mesh.all().filter(|&t| mesh.is_live(t)).flat_map(|t| 4 * t..4 * t + 4);
        let walls: Vec<u32> = codes
            .filter(|&code| {
                let n = mesh.across(code) >> 2;
                let within = !mesh.is_ghost(code >> 2) && !mesh.is_ghost(n);
                let apart = within && mesh.region(code >> 2) != mesh.region(n);
                apart || mix(&[seed, code.min(mesh.across(code))]) % rare == 0
            })
            .collect();
        walls.into_iter().for_each(|code| mesh.set_subface(code));
        if seed / 16 % 2 == 1 {
            let name = |mesh: &Mesh, code| Some(mix(&face_key(mesh.face(code))) % 7);
            mesh.name_subfaces(name, &Control::free()).unwrap();
        }
        if seed / 32 % 2 == 1 {
            keep.extend(edges(mesh).into_iter().filter(|edge| mix(&[seed, edge[0], edge[1]]) % 20 == 0));
        }
    }

    /// Takes off what hangs on the mesh.
    pub fn strip(&mut self) {
        let tets: Vec<[u32; 4]> = finite(&self.mesh).map(|t| self.mesh.verts(t)).collect();
        self.mesh = Mesh::of_tetrahedra(&tets, self.points.len()).unwrap();
        self.keep.clear();
    }

    /// What there is now.
    pub fn state(&self) -> State {
        let Scene { mesh, points, .. } = self;
        let mut subfaces: Vec<_> =
            mesh.subfaces().map(|code| (face_key(mesh.face(code)), mesh.subface(code))).collect();
        subfaces.sort_unstable();
        let (mut volumes, mut tets) = (BTreeMap::new(), Vec::new());
        for t in finite(mesh) {
            let mut verts = mesh.verts(t);
            *volumes.entry(mesh.region(t)).or_insert(0.0) += volume(points, verts);
            // Sorted but for the last two, if it is not positive otherwise.
            verts.sort_unstable();
            if !is_positive(points, verts) {
                verts.swap(2, 3);
            }
            tets.push(verts);
        }
        tets.sort_unstable();
        let mut vertices: Vec<u32> = tets.iter().flatten().copied().collect();
        vertices.sort_unstable();
        vertices.dedup();
        State { subfaces, volumes, vertices, tets }
    }

    /// Checks the mesh, and that all that was there before and must stay is there, but for vertices that have gone.
    pub fn check(&self, before: &State, gone: &[u32]) -> State {
        check_domain(&self.mesh, &self.points).unwrap();
        let now = self.same_domain(before);
        let left: Vec<u32> = before.vertices.iter().copied().filter(|v| !gone.contains(v)).collect();
        assert_eq!(now.vertices, left);
        let edges = edges(&self.mesh);
        assert!(self.keep.iter().all(|edge| edges.binary_search(edge).is_ok()));
        now
    }

    /// Checks that subfaces and the volumes of regions are as before.
    pub fn same_domain(&self, before: &State) -> State {
        let now = self.state();
        assert_eq!(now.subfaces, before.subfaces);
        assert!(now.volumes.keys().eq(before.volumes.keys()));
        for (region, volume) in &now.volumes {
            assert!((volume - before.volumes[region]).abs() < 1e-9 * volume, "region {region}");
        }
        now
    }

    /// The vertices inside: on no subface, not on the boundary, on no edge that must stay.
    pub fn inside(&self) -> Vec<u32> {
        let mesh = &self.mesh;
        let mut search = StarSearch::default();
        let mut is_inside = |&v: &u32| {
            let start = mesh.vertex_tet[v as usize];
            if start == NONE {
                return false;
            }
            search.vertex_star(mesh, v, start).unwrap();
            let walled = |code: u32| mesh.is_subface(code) && mesh.face(code).contains(&v);
            let free = |&t: &u32| !mesh.is_ghost(t) && !(4 * t..4 * t + 4).any(walled);
            search.tets.iter().all(free) && !self.keep.iter().any(|edge| edge.contains(&v))
        };
        (0..self.points.len() as u32).filter(|v| is_inside(v)).collect()
    }
}

/// The live tetrahedra that are no ghosts.
pub fn finite(mesh: &Mesh) -> impl Iterator<Item = u32> + '_ {
    mesh.all().filter(|&t| mesh.is_live(t) && !mesh.is_ghost(t))
}

/// The ring of an edge of a tetrahedron, and its link.
pub fn ring(mesh: &Mesh, t: u32, [a, b]: [u32; 2]) -> (Vec<u32>, Vec<u32>) {
    EdgeRing::new(mesh, t, a, b).map(|(t, .., k, _)| (t, mesh.vertex(t, k))).unzip()
}

/// The edges, in order.
pub fn edges(mesh: &Mesh) -> Vec<[u32; 2]> {
    let of = |t| EDGE.map(|[i, j]| edge_key(mesh.vertex(t, i.into()), mesh.vertex(t, j.into())));
    let mut all: Vec<[u32; 2]> = finite(mesh).flat_map(of).collect();
    all.sort_unstable();
    all.dedup();
    all
}

/// Whether a tetrahedron is positive.
pub fn is_positive(points: &Points, [a, b, c, d]: [u32; 4]) -> bool {
    points.orient3d(a, b, c, d) == Sign::Positive
}

/// Six times the volume, exact for small integers.
fn volume(points: &Points, verts: [u32; 4]) -> f64 {
    let [o, p, q, r] = verts.map(|v| points.xyz(v));
    dot(&sub(p, o), &cross(&sub(q, o), &sub(r, o)))
}

/// All triangulations of the part of a polygon from `i` to `j`.
pub fn triangulations(i: usize, j: usize) -> Vec<Vec<[usize; 3]>> {
    if j - i < 2 {
        return vec![Vec::new()];
    }
    let mut all = Vec::new();
    for k in i + 1..j {
        for left in triangulations(i, k) {
            for right in triangulations(k, j) {
                all.push([&[[i, k, j]][..], &left, &right].concat());
            }
        }
    }
    all
}
