//! From the current triangulation of patches to the surface's: flips in the plane, carried out in space.
//!
//! In the plane, missing edges are inserted one by one: the edges that cross one are flipped where their quadrilateral is strictly
//! convex, until none is left (Sloan 1993). In space a flip of edge `ab` to `cd` empties, on each side of the plane, the
//! tetrahedra round `ab`, and fills them again under the two new triangles: by reconnection, or from a point inside near the
//! crossing of `ab` and `cd`, which all the faces see. Diagonals of polygons are not inserted: any others are valid too.
use crate::control::Part;
use crate::elementary::quotient;
use crate::error::Error;
use crate::fallible;
use crate::kernel::ghosts::ghost_at;
use crate::kernel::replace::{Replace, Sector};
use crate::kernel::Mesh;
use crate::kernel::{edge_key, face_key};
use crate::kernel::{GHOST, NONE};
use crate::ops::hollow::{Growth, Hollow, Start};
use crate::ops::place::place;
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::ops::widen::{Kept, Rays, Widen};
use crate::options::Preserve;
use crate::predicates::{Points, Sign};
use crate::preserve::inside::Inside;
use crate::preserve::release::segments::{axis_of, unit};
use crate::vector::{cross, dot, sub};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::VecDeque;

/// The triangles that patches must have.
pub struct Target<'a> {
    /// Corners, in vertex ids.
    pub triangles: &'a [[u32; 3]],
    /// Patch of each.
    pub patch: &'a [u32],
    /// Input facet of each.
    pub facet: &'a [u32],
    /// The first facet that is a polygon. Of these the edges must be there; which diagonals they have does not matter.
    pub first_polygon: u32,
    /// Which of them must be faces.
    pub preserve: Preserve,
    /// How many attempts have failed.
    pub attempt: u32,
}

/// A triangle of the target.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Wanted {
    patch: u32,
    corners: [u32; 3],
    facet: u32,
}

/// What flips took.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Flips {
    /// Flips in the plane.
    pub flips: u64,
    /// Sides of flips that needed more tetrahedra than those round the edge.
    pub grown: u64,
    /// Sides of flips that needed a point inside.
    pub placed: u64,
    /// Triangles that were not reached.
    pub missing: Vec<[u32; 3]>,
}

/// Retriangulates patches.
pub struct Retarget<'a> {
    /// The mesh.
    pub mesh: &'a mut Mesh,
    /// The vertices.
    pub points: &'a mut Points,
    /// Points inside.
    pub inside: &'a mut Inside,
    /// Pieces of segments on no facet.
    pub isolated: &'a FxHashSet<[u32; 2]>,
    /// Patches that get their triangles only where that takes no point inside.
    pub loose: &'a FxHashSet<u32>,
    /// How far the surroundings of a flip grow.
    pub growth: Growth,
    hollow: Hollow,
    widen: Widen,
    /// Points inside that cavities of the current flip swallow.
    swallowed: Vec<u32>,
    reconnect: Reconnect<'a>,
    replace: Replace,
    part: Part<'a>,
    /// A corner code of each subface.
    code_of: FxHashMap<[u32; 3], u32>,
    /// Apexes of the triangles at each edge of the patch at hand: at most two.
    apexes: FxHashMap<[u32; 2], Vec<u32>>,
    /// A neighbour of each of its vertices.
    neighbor: FxHashMap<u32, u32>,
    axis: usize,
    count: Flips,
}

/// One side of a flip.
struct Side {
    tets: Vec<u32>,
    /// What bounds it after the flip, turned inward.
    faces: Vec<[u32; 3]>,
}

impl<'a> Retarget<'a> {
    /// Nothing is done yet.
    pub fn new(
        mesh: &'a mut Mesh,
        points: &'a mut Points,
        inside: &'a mut Inside,
        isolated: &'a FxHashSet<[u32; 2]>,
        loose: &'a FxHashSet<u32>,
        growth: Growth,
        part: Part<'a>,
    ) -> Self {
        Retarget {
            mesh,
            points,
            inside,
            isolated,
            loose,
            growth,
            hollow: Hollow::default(),
            widen: Widen::default(),
            swallowed: Vec::new(),
            reconnect: Reconnect::new(part.control()),
            replace: Replace::default(),
            part,
            code_of: FxHashMap::default(),
            apexes: FxHashMap::default(),
            neighbor: FxHashMap::default(),
            axis: 0,
            count: Flips::default(),
        }
    }

    /// Makes every triangle of the target a face, as far as its patch is in the mesh.
    pub fn run(&mut self, target: &Target, first_steiner: u32) -> Result<Flips, Error> {
        // (patch, triangle) of the target where one is missing, and (patch, key) of what is there instead.
        let mut wrong: Vec<u32> = Vec::new();
        let mut there = fallible::collect(self.mesh.subfaces().map(|code| face_key(self.mesh.face(code))))?;
        self.part.sort(&mut there)?;
        for (&triangle, &patch) in target.triangles.iter().zip(target.patch) {
            self.part.step()?;
            if there.binary_search(&face_key(triangle)).is_err() {
                fallible::push(&mut wrong, patch)?;
            }
        }
        drop(there);
        self.part.sort(&mut wrong)?;
        wrong.dedup();
        let mut present: Vec<(u32, [u32; 3])> = Vec::new();
        for t in self.mesh.all() {
            self.part.step()?;
            self.note_codes(t, &wrong, &mut present)?;
        }
        self.part.sort(&mut present)?;
        present.dedup();
        let mut wanted: Vec<Wanted> = fallible::reserved(target.triangles.len())?;
        let all = target.patch.iter().zip(target.triangles).zip(target.facet);
        let all = all.map(|((&patch, &corners), &facet)| Wanted { patch, corners, facet });
        fallible::extend(&mut wanted, all.filter(|x| wrong.binary_search(&x.patch).is_ok()))?;
        self.part.sort(&mut wanted)?;
        let count = wrong.len() as f64;
        for (i, patch) in wrong.into_iter().enumerate() {
            self.part.progress(i as f64 / count)?;
            let from = present.partition_point(|x| x.0 < patch);
            let now = &present[from..present.partition_point(|x| x.0 <= patch)];
            let from = wanted.partition_point(|x| x.patch < patch);
            let then = &wanted[from..wanted.partition_point(|x| x.patch <= patch)];
            // A patch that is not in the mesh was carved; one with points that stay on it has them for corners.
            let corners = now.iter().flat_map(|x| x.1);
            let bent = self.loose.contains(&patch) && corners.into_iter().any(|v| v >= first_steiner);
            if !now.is_empty() && !bent {
                self.patch(patch, now, then, target.first_polygon)?;
            }
        }
        Ok(std::mem::take(&mut self.count))
    }

    fn note_codes(&mut self, t: u32, wrong: &[u32], present: &mut Vec<(u32, [u32; 3])>) -> Result<(), Error> {
        if !self.mesh.is_live(t) {
            return Ok(());
        }
        for code in (4 * t..4 * t + 4).filter(|&code| self.mesh.is_subface(code)) {
            let (key, patch) = (face_key(self.mesh.face(code)), self.mesh.subface(code));
            if wrong.binary_search(&patch).is_ok() {
                fallible::insert(&mut self.code_of, key, code)?;
                fallible::push(present, (patch, key))?;
            }
        }
        Ok(())
    }

    /// One patch: its triangles now, and those it is to have.
    fn patch(
        &mut self,
        patch: u32,
        now: &[(u32, [u32; 3])],
        then: &[Wanted],
        first_polygon: u32,
    ) -> Result<(), Error> {
        self.apexes.clear();
        self.neighbor.clear();
        let Some(axis) = axis_of(self.points, &now[0].1) else {
            return Err(Error::internal("a subface is degenerate"));
        };
        self.axis = axis;
        for &(_, [a, b, c]) in now {
            for (x, y, z) in [(a, b, c), (b, c, a), (c, a, b)] {
                fallible::push(fallible::entry(&mut self.apexes, edge_key(x, y))?.or_default(), z)?;
                fallible::insert(&mut self.neighbor, x, y)?;
            }
        }
        // (edge, facet)
        let mut edges: Vec<([u32; 2], u32)> = fallible::reserved(3 * then.len())?;
        for &Wanted { corners: [a, b, c], facet, .. } in then {
            fallible::extend(
                &mut edges,
                [edge_key(a, b), edge_key(b, c), edge_key(c, a)].map(|edge| (edge, facet)),
            )?;
        }
        edges.sort_unstable();
        for run in edges.chunk_by(|x, y| x.0 == y.0) {
            let edge = run[0].0;
            let is_diagonal = matches!(run, [(_, f), (_, g)] if f == g && *f >= first_polygon);
            if !is_diagonal && !self.apexes.contains_key(&edge) {
                self.insert_edge(patch, edge)?;
            }
        }
        if self.loose.contains(&patch) {
            return Ok(());
        }
        let missing = then.iter().filter(|x| x.facet < first_polygon).map(|x| x.corners);
        let missing = missing.filter(|t| !self.code_of.contains_key(&face_key(*t)));
        fallible::extend(&mut self.count.missing, missing)?;
        Ok(())
    }

    /// Flips edges that cross `ab` until it is there.
    fn insert_edge(&mut self, patch: u32, [a, b]: [u32; 2]) -> Result<(), Error> {
        let mut crossing = self.crossing(a, b)?;
        // Flips that fail without a point fail again until others have changed the surroundings, so one round must suffice.
        let loose = self.loose.contains(&patch);
        let mut tries = if loose { 2 * crossing.len() } else { 4 * crossing.len() * crossing.len() + 16 };
        while let Some([x, y]) = crossing.pop_front() {
            if tries == 0 {
                return Ok(());
            }
            tries -= 1;
            self.part.step()?;
            let Some(&[c, d]) = self.apexes.get(&[x, y]).map(|v| &v[..]) else { continue };
            if !self.is_convex([x, y], [c, d]) || !self.flip(patch, [x, y], [c, d])? {
                fallible::push_back(&mut crossing, [x, y])?;
                continue;
            }
            let ends = [a, b];
            if !ends.contains(&c) && !ends.contains(&d) && self.side(a, b, c) == -self.side(a, b, d) {
                fallible::push_back(&mut crossing, edge_key(c, d))?;
            }
        }
        Ok(())
    }

    fn side(&self, a: u32, b: u32, c: u32) -> Sign {
        self.points.orient_in_plane(self.axis, a, b, c)
    }

    /// The edge opposite `a` in the triangle that `ab` enters at `a`.
    fn opposite(&self, a: u32, b: u32) -> Result<Option<[u32; 2]>, Error> {
        let mut around: Vec<u32> = fallible::collect(self.neighbor.get(&a).copied())?;
        let mut next = 0;
        while next < around.len() {
            let w = around[next];
            next += 1;
            self.part.step()?;
            for &x in self.apexes.get(&edge_key(a, w)).into_iter().flatten() {
                let (s, t) = (self.side(a, b, w), self.side(a, b, x));
                if s != Sign::Zero && s == -t && self.side(w, x, b) == -self.side(w, x, a) {
                    return Ok(Some(edge_key(w, x)));
                }
                if !around.contains(&x) {
                    fallible::push(&mut around, x)?;
                }
            }
        }
        Ok(None)
    }

    /// The edges of the patch's triangulation that cross `ab`, in order.
    fn crossing(&self, a: u32, b: u32) -> Result<VecDeque<[u32; 2]>, Error> {
        let mut out = VecDeque::new();
        let Some(first) = self.opposite(a, b)? else { return Ok(out) };
        let (mut edge, mut behind) = (first, a);
        for _ in 0..self.apexes.len() {
            self.part.step()?;
            fallible::push_back(&mut out, edge)?;
            let Some(apexes) = self.apexes.get(&edge) else { break };
            let Some(&ahead) = apexes.iter().find(|&&v| v != behind) else { break };
            if ahead == b {
                break;
            }
            let s = self.side(a, b, ahead);
            let kept = edge.into_iter().find(|&v| self.side(a, b, v) == -s);
            let Some(kept) = kept else { break };
            behind = edge.into_iter().find(|&v| v != kept).unwrap_or(behind);
            edge = edge_key(kept, ahead);
        }
        Ok(out)
    }

    /// The triangles at edge `ab` with apexes `c` and `d` form a strictly convex quadrilateral.
    fn is_convex(&self, [a, b]: [u32; 2], [c, d]: [u32; 2]) -> bool {
        let (x, y) = (self.side(c, d, a), self.side(c, d, b));
        x != Sign::Zero && x == -y
    }

    /// Flips edge `ab` to `cd`, in space; false if a side has neither a filling nor a point.
    fn flip(&mut self, patch: u32, [a, b]: [u32; 2], [c, d]: [u32; 2]) -> Result<bool, Error> {
        let (first, second) = (face_key([a, b, c]), face_key([a, b, d]));
        let Some(&code) = self.code_of.get(&first) else { return Ok(false) };
        let codes = [code, self.mesh.across(code)];
        let before = self.inside.list.len();
        self.swallowed.clear();
        let mut sectors = Vec::new();
        for code in codes {
            let mut side = self.collect_side(code, [a, b], [c, d])?;
            let t = code >> 2;
            let ghost = self.mesh.is_ghost(t);
            let new = if ghost {
                fallible::collect(side.faces.iter().map(|&f| ghost_at(f)))?
            } else {
                match self.fill_side(patch, &mut side, &sectors, [[a, b], [c, d]])? {
                    Some(new) => new,
                    None => {
                        self.inside.shorten(before);
                        return Ok(false);
                    }
                }
            };
            fallible::push(&mut sectors, Sector { old: side.tets, new, region: self.mesh.region(t) })?;
        }
        for key in [first, second] {
            self.code_of.remove(&key);
        }
        self.replace.sectors(self.mesh, &sectors, &[([a, c, d], patch), ([b, c, d], patch)], &[])?;
        for &p in &self.swallowed {
            self.mesh.vertex_tet[p as usize] = NONE;
        }
        for &t in &self.replace.fresh {
            for code in 4 * t..4 * t + 4 {
                if self.mesh.is_subface(code) {
                    fallible::insert(&mut self.code_of, face_key(self.mesh.face(code)), code)?;
                }
            }
        }
        self.apexes.remove(&edge_key(a, b));
        fallible::insert(&mut self.apexes, edge_key(c, d), fallible::copied(&[a, b])?)?;
        for (v, w) in [(a, c), (b, c), (c, d), (d, c)] {
            fallible::insert(&mut self.neighbor, v, w)?;
        }
        for (edge, old, new) in [([a, c], b, d), ([b, c], a, d), ([a, d], b, c), ([b, d], a, c)] {
            if let Some(list) = self.apexes.get_mut(&edge_key(edge[0], edge[1])) {
                for v in list.iter_mut().filter(|v| **v == old) {
                    *v = new;
                }
            }
        }
        self.count.flips += 1;
        self.count.placed += (self.inside.list.len() - before) as u64;
        Ok(true)
    }

    /// The tetrahedra round edge `ab` from the face of a corner to the other face of the flip, and what bounds them after it.
    fn collect_side(&self, code: u32, [a, b]: [u32; 2], [c, d]: [u32; 2]) -> Result<Side, Error> {
        let mesh = &self.mesh;
        let mut side = Side { tets: Vec::new(), faces: Vec::new() };
        let face = mesh.face(code);
        let ghost = mesh.is_ghost(code >> 2);
        let (mut t, mut left) = (code >> 2, c);
        loop {
            fallible::push(&mut side.tets, t)?;
            let [Some(of_a), Some(of_b), Some(of_left)] = [a, b, left].map(|v| mesh.slot_of(t, v)) else {
                return Err(Error::internal("the tetrahedra around a flat edge form no ring"));
            };
            if !ghost {
                fallible::extend(&mut side.faces, [mesh.face(4 * t + of_a), mesh.face(4 * t + of_b)])?;
            }
            let exit = 4 * t + of_left;
            let apex = mesh.verts(t).into_iter().find(|&v| v != a && v != b && v != left);
            left = apex.unwrap_or(GHOST);
            if self.mesh.is_wall(exit) {
                break;
            }
            t = mesh.across(exit) >> 2;
            if side.tets.len() > mesh.slot_count() {
                return Err(Error::internal("the tetrahedra around a flat edge do not end"));
            }
        }
        if left != d {
            return Err(Error::internal("a flat edge has other subfaces"));
        }
        // The quadrilateral a d b c, turned as the first face is.
        let forward = (0..3).any(|k| face[k] == a && face[(k + 1) % 3] == b);
        let halves = if forward { [[d, b, c], [c, a, d]] } else { [[d, c, b], [c, d, a]] };
        fallible::extend(&mut side.faces, halves)?;
        Ok(side)
    }

    fn fill_side(
        &mut self,
        patch: u32,
        side: &mut Side,
        taken: &[Sector],
        [[a, b], [c, d]]: [[u32; 2]; 2],
    ) -> Result<Option<Vec<[u32; 4]>>, Error> {
        let mut new = Vec::new();
        let polyhedron = Polyhedron { faces: &side.faces, inner: &[], ..Polyhedron::default() };
        if self.reconnect.fill(self.points, &polyhedron, self.growth.budget, &mut new)? {
            return Ok(Some(new));
        }
        let tets = fallible::copied(&side.tets)?;
        let walls = [side.faces[side.faces.len() - 2], side.faces[side.faces.len() - 1]];
        let gone = [face_key([a, b, c]), face_key([a, b, d])];
        let start = Start {
            tets: &tets,
            gone: &gone,
            walls: &walls,
            without: NONE,
            edge: None,
            avoid: [a, b],
            taken,
        };
        let growth = Growth { budget: self.growth.budget / 4, ..self.growth };
        let Retarget { mesh, points, reconnect, isolated, hollow, .. } = self;
        if let Some(new) = hollow.grow(mesh, points, reconnect, &start, isolated, growth)? {
            self.count.grown += 1;
            side.tets = std::mem::take(&mut hollow.cavity.tets);
            return Ok(Some(new));
        }
        if self.loose.contains(&patch) {
            return Ok(None);
        }
        let [pa, pb, pc, pd] = [a, b, c, d].map(|v| *self.points.xyz(v));
        let (from, normal) = crossing_point(pa, pb, pc, pd);
        let p = self.inside.add(self.mesh, self.points, from)?;
        if place(self.points, p, &side.faces, from, &[normal, normal.map(|x| -x)], &self.part)? {
            fallible::extend(&mut new, side.faces.iter().map(|&[x, y, z]| [p, x, y, z]))?;
            return Ok(Some(new));
        }
        // Straight up, and tilted towards the quadrilateral's centre, since other facets may rise next to its edges.
        let up = unit(normal);
        let middle = unit([0, 1, 2].map(|k| 0.25 * (pa[k] + pb[k] + pc[k] + pd[k]) - from[k]));
        let lean = |s: f64, m: f64| unit([0, 1, 2].map(|k| s * up[k] + m * middle[k]));
        let toward = [
            lean(1.0, 0.0),
            lean(-1.0, 0.0),
            lean(1.0, 1.0),
            lean(-1.0, 1.0),
            lean(1.0, 8.0),
            lean(-1.0, 8.0),
        ];
        let rays = Rays { point: p, from, toward: &toward };
        let Retarget { mesh, points, isolated, inside, widen, part, .. } = self;
        let kept = Kept { isolated, inside: &inside.list };
        if let Some(new) = widen.place(mesh, points, &start, kept, &rays, part)? {
            side.tets = std::mem::take(&mut widen.cavity.tets);
            fallible::append(&mut self.swallowed, &self.widen.swallowed)?;
            return Ok(Some(new));
        }
        let last = self.inside.list.len() - 1;
        self.inside.shorten(last);
        Ok(None)
    }
}

/// Where `ab` and `cd` cross, and the normal of their plane, in plain arithmetic.
fn crossing_point(a: [f64; 3], b: [f64; 3], c: [f64; 3], d: [f64; 3]) -> ([f64; 3], [f64; 3]) {
    let (ab, cd, ac) = (sub(&b, &a), sub(&d, &c), sub(&c, &a));
    let n = cross(&ab, &cd);
    // a + s ab lies on the line cd where (a + s ab − c) × cd = 0.
    let s = quotient(dot(&cross(&ac, &cd), &n), dot(&n, &n)).map_or(0.5, |s| s.clamp(0.0, 1.0));
    ([0, 1, 2].map(|k| a[k] + s * ab[k]), n)
}
