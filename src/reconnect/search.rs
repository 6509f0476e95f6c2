//! The search of [`Reconnect`](super::Reconnect): depth first over front faces, with an explicit stack.
use super::quality::quality;
use super::signs::Signs;
use super::worths::Worths;
use super::Polyhedron;
use crate::error::Error;
use crate::predicates::{Points, Sign};
use rustc_hash::FxHashMap;

/// A face by local numbers, smallest first, turned so that the side to be filled is positive.
pub(super) type Face = [u8; 3];

/// Which vertices are on which side of a face's plane, as sets of bits. Those in the plane are on neither.
#[derive(Clone, Copy, Default)]
pub(super) struct Sides {
    /// On the side to be filled.
    pub(super) ahead: u64,
    behind: u64,
}

impl Sides {
    /// The ends are on different sides.
    fn part(self, [p, q]: [u8; 2]) -> bool {
        let (p, q) = (1 << p, 1 << q);
        (self.ahead & p != 0 && self.behind & q != 0) || (self.ahead & q != 0 && self.behind & p != 0)
    }
}

/// One step: a front face, the apexes to try, and what the current one changed.
#[derive(Clone, Default)]
pub(super) struct Level {
    pub(super) face: Face,
    /// Apexes not tried yet, the best last.
    pub(super) apexes: Vec<u8>,
    closed: Vec<Face>,
    opened: Vec<Face>,
}

/// State and scratch space.
#[derive(Default)]
pub struct Search {
    pub(super) signs: Signs,
    /// How good tetrahedra are, where that is asked.
    pub(super) worths: Worths,
    /// The best filling so far.
    pub(super) best: Vec<[u8; 4]>,
    /// Faces whose inner side is open.
    pub(super) front: Vec<Face>,
    /// Boundary faces, as given.
    boundary: Vec<Face>,
    /// Edges that must be.
    edges: Vec<[u8; 2]>,
    inner: Vec<u8>,
    pub(super) levels: Vec<Level>,
    pub(super) depth: usize,
    pub(super) tets: Vec<[u8; 4]>,
    uses: Vec<(u8, u8, bool)>,
    /// The sides of each face asked for, by the face's corners as one number: quick to hash.
    sides_of: FxHashMap<u32, Sides>,
    pub(super) xyz: Vec<[f64; 3]>,
}

fn canonical([x, y, z]: Face) -> Face {
    if x < y && x < z {
        [x, y, z]
    } else if y < z {
        [y, z, x]
    } else {
        [z, x, y]
    }
}

/// The three faces of tetrahedron (w, face) other than `face`, as seen from inside it.
fn other_faces(w: u8, [x, y, z]: Face) -> [Face; 3] {
    [canonical([w, z, y]), canonical([w, x, z]), canonical([w, y, x])]
}

fn reversed([x, y, z]: Face) -> Face {
    [x, z, y]
}

impl Search {
    /// Numbers the vertices and sets the front; false if the polyhedron is too large.
    pub fn begin(&mut self, points: &Points, polyhedron: &Polyhedron) -> Result<bool, Error> {
        let corners = polyhedron.faces.iter().flatten().chain(polyhedron.inner).copied();
        if !self.signs.set(corners)? {
            return Ok(false);
        }
        self.boundary.clear();
        self.boundary.try_reserve(polyhedron.faces.len())?;
        for face in polyhedron.faces {
            let [Some(x), Some(y), Some(z)] = face.map(|v| self.signs.number(v)) else { return Ok(false) };
            self.boundary.push(canonical([x, y, z]));
        }
        if !self.is_closed()? {
            return Ok(false);
        }
        self.edges.clear();
        self.edges.try_reserve(polyhedron.edges.len())?;
        for edge in polyhedron.edges {
            // An edge that leaves the polyhedron's vertices cannot be asked for.
            let [Some(a), Some(b)] = edge.map(|v| self.signs.number(v)) else { return Ok(false) };
            self.edges.push([a, b]);
        }
        self.inner.clear();
        self.inner.try_reserve(polyhedron.inner.len())?;
        self.inner.extend(polyhedron.inner.iter().filter_map(|&v| self.signs.number(v)));
        self.front.clear();
        self.front.try_reserve(4 * self.boundary.len() + 64)?;
        self.front.extend_from_slice(&self.boundary);
        self.xyz.clear();
        self.xyz.try_reserve(self.signs.count())?;
        self.xyz.extend(self.signs.vertices.iter().map(|&v| *points.xyz(v)));
        self.tets.clear();
        self.sides_of.clear();
        self.depth = 0;
        Ok(true)
    }

    /// Every edge of the boundary is used as often in one direction as in the other.
    fn is_closed(&mut self) -> Result<bool, Error> {
        let uses = &mut self.uses;
        uses.clear();
        uses.try_reserve(3 * self.boundary.len())?;
        for &[x, y, z] in &self.boundary {
            uses.extend([(x, y), (y, z), (z, x)].map(|(a, b)| (a.min(b), a.max(b), a < b)));
        }
        uses.sort_unstable();
        Ok(uses
            .chunk_by(|u, v| (u.0, u.1) == (v.0, v.1))
            .all(|c| 2 * c.iter().filter(|u| u.2).count() == c.len()))
    }

    /// A vertex from which all boundary faces without it are seen from inside: the one with the best worst tetrahedron.
    pub fn cone(&mut self, points: &Points) -> Option<u8> {
        let bit = |&w: &u8| 1u64 << w;
        // All that is inside the cone is the apex itself and edges from it.
        let mut apexes =
            self.inner.iter().map(bit).fold(u64::MAX >> (64 - self.signs.count()), |all, w| all & w);
        apexes = self.edges.iter().fold(apexes, |all, e| all & (bit(&e[0]) | bit(&e[1])));
        for i in 0..self.boundary.len() {
            let face = self.boundary[i];
            let mut seen = self.sides(points, face).ahead;
            let corners = face.iter().map(bit).fold(0, |all, w| all | w);
            // A face with the inside on both sides cancels in the sum of boundaries: the cone may lack it.
            if apexes & corners != 0 && !self.boundary.contains(&canonical(reversed(face))) {
                seen |= corners;
            }
            apexes &= seen;
            if apexes == 0 {
                return None;
            }
        }
        let mut best: Option<(f64, u8)> = None;
        for w in (0..self.signs.count() as u8).filter(|w| apexes & bit(w) != 0) {
            let away = self.boundary.iter().filter(|f| !f.contains(&w));
            let worst = away.map(|&f| self.quality(w, f)).fold(f64::INFINITY, f64::min);
            if best.is_none_or(|b| worst > b.0) {
                best = Some((worst, w));
            }
        }
        best.map(|b| b.1)
    }

    /// The tetrahedra from a vertex to all boundary faces without it.
    pub fn append_cone(&mut self, w: u8, tets: &mut Vec<[u32; 4]>) -> Result<bool, Error> {
        tets.try_reserve(self.boundary.len())?;
        let id = |i: u8| self.signs.vertices[i as usize];
        tets.extend(
            self.boundary.iter().filter(|f| !f.contains(&w)).map(|f| [id(w), id(f[0]), id(f[1]), id(f[2])]),
        );
        Ok(true)
    }

    /// Searches; appends the first solution.
    pub fn run(&mut self, points: &Points, budget: u32, tets: &mut Vec<[u32; 4]>) -> Result<bool, Error> {
        if !self.descend(points)? {
            return Ok(false);
        }
        let mut steps = 0;
        // Invariant: level `depth − 1` has a face, and none of its apexes is applied.
        while self.depth > 0 {
            let level = self.depth - 1;
            let face = self.levels[level].face;
            let Some(apex) = self.levels[level].apexes.pop() else {
                self.retreat();
                continue;
            };
            steps += 1;
            if steps > budget {
                return Ok(false);
            }
            if !self.apply(level, face, apex)? {
                continue;
            }
            if self.front.is_empty() {
                if self.complete() {
                    tets.try_reserve(self.tets.len())?;
                    let id = |i: u8| self.signs.vertices[i as usize];
                    tets.extend(self.tets.iter().map(|t| t.map(id)));
                    return Ok(true);
                }
                self.undo(level);
            } else if !self.descend(points)? {
                self.undo(level);
            }
        }
        Ok(false)
    }

    /// Which vertices are on which side of a face.
    pub(super) fn sides(&mut self, points: &Points, face: Face) -> Sides {
        let [x, y, z] = face;
        let key = u32::from_le_bytes([x, y, z, 0]);
        if let Some(&sides) = self.sides_of.get(&key) {
            return sides;
        }
        let [b, c, d] = face.map(|i| self.signs.vertices[i as usize]);
        let plane = points.plane(b, c, d);
        let mut sides = Sides::default();
        for w in (0..self.signs.count() as u8).filter(|w| !face.contains(w)) {
            let sign = match plane.side(&self.xyz[w as usize]) {
                Some(side) => i8::from(side == Sign::Positive) - i8::from(side == Sign::Negative),
                None => self.signs.of(points, w, x, y, z),
            };
            sides.ahead |= u64::from(sign > 0) << w;
            sides.behind |= u64::from(sign < 0) << w;
        }
        self.sides_of.insert(key, sides);
        sides
    }

    /// Puts the most constrained front face on the stack; false if a front face has no apex at all.
    fn descend(&mut self, points: &Points) -> Result<bool, Error> {
        let on_front = self.vertices_on_front();
        let mut best: Option<(u32, usize, u64)> = None;
        for i in 0..self.front.len() {
            let set = on_front & self.sides(points, self.front[i]).ahead;
            let count = set.count_ones();
            if count == 0 {
                return Ok(false);
            }
            if best.is_none_or(|b| count < b.0) {
                best = Some((count, i, set));
            }
        }
        let Some((_, index, mut rest)) = best else { return Ok(false) };
        let face = self.front[index];
        let mut apexes: Vec<(f64, u8)> = Vec::new();
        while rest != 0 {
            let w = rest.trailing_zeros() as u8;
            rest &= rest - 1;
            if self.is_free(points, w, face, on_front) {
                let closes = other_faces(w, face).iter().filter(|g| self.front.contains(g)).count() as f64;
                apexes.try_reserve(1)?;
                apexes.push((self.quality(w, face) * (1.0 + closes), w));
            }
        }
        self.push_level(face, apexes)
    }

    /// Puts a face with these apexes, each with its worth, on the stack; false if there are none.
    pub(super) fn push_level(&mut self, face: Face, mut apexes: Vec<(f64, u8)>) -> Result<bool, Error> {
        if apexes.is_empty() {
            return Ok(false);
        }
        apexes.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
        if self.levels.len() == self.depth {
            self.levels.try_reserve(1)?;
            self.levels.push(Level::default());
        }
        let level = &mut self.levels[self.depth];
        level.face = face;
        level.apexes.clear();
        level.apexes.try_reserve(apexes.len())?;
        level.apexes.extend(apexes.iter().map(|a| a.1));
        self.depth += 1;
        Ok(true)
    }

    /// Leaves the topmost level.
    pub(super) fn retreat(&mut self) {
        self.depth -= 1;
        if self.depth > 0 {
            self.undo(self.depth - 1);
        }
    }

    /// Vertices of front faces, and inner ones that no tetrahedron has yet.
    pub(super) fn vertices_on_front(&self) -> u64 {
        let mut set = 0u64;
        for f in &self.front {
            set |= 1 << f[0] | 1 << f[1] | 1 << f[2];
        }
        for &v in &self.inner {
            if !self.tets.iter().any(|t| t.contains(&v)) {
                set |= 1 << v;
            }
        }
        set
    }

    /// Joins a front face to an apex; false (and nothing changed) if a face would get a second tetrahedron on one side.
    pub(super) fn apply(&mut self, level: usize, face: Face, apex: u8) -> Result<bool, Error> {
        let others = other_faces(apex, face);
        if others.iter().any(|&g| self.front.contains(&canonical(reversed(g))) && !self.front.contains(&g)) {
            return Ok(false);
        }
        self.front.try_reserve(3)?;
        let Search { front, levels, .. } = self;
        let level = &mut levels[level];
        level.closed.clear();
        level.opened.clear();
        level.closed.try_reserve(4)?;
        level.opened.try_reserve(3)?;
        let mut close = |front: &mut Vec<Face>, g: Face| {
            let at = front.iter().position(|&x| x == g);
            if let Some(at) = at {
                front.swap_remove(at);
                level.closed.push(g);
            }
            at.is_some()
        };
        close(front, face);
        for g in others {
            if !close(front, g) {
                let far = canonical(reversed(g));
                front.push(far);
                level.opened.push(far);
            }
        }
        self.tets.try_reserve(1)?;
        self.tets.push([apex, face[0], face[1], face[2]]);
        Ok(true)
    }

    /// Takes the current apex of a level back.
    pub(super) fn undo(&mut self, level: usize) {
        let Search { front, levels, .. } = self;
        let level = &levels[level];
        for g in &level.opened {
            if let Some(at) = front.iter().rposition(|x| x == g) {
                front.swap_remove(at);
            }
        }
        front.extend_from_slice(&level.closed);
        self.tets.pop();
    }

    /// The tetrahedra have all required edges and inner vertices.
    pub(super) fn complete(&self) -> bool {
        let has = |a: u8, b: u8| self.tets.iter().any(|t| t.contains(&a) && t.contains(&b));
        self.edges.iter().all(|&[a, b]| has(a, b)) && self.inner.iter().all(|&v| has(v, v))
    }

    /// The tetrahedron holds no vertex, its new edges pierce no front face, and no front or required edge pierces its new faces.
    pub(super) fn is_free(&mut self, points: &Points, w: u8, face: Face, on_front: u64) -> bool {
        let bit = |v: u8| 1u64 << v;
        let base = bit(face[0]) | bit(face[1]) | bit(face[2]);
        let others = other_faces(w, face);
        let new = others.map(|g| self.sides(points, g));
        let outside = new.iter().fold(self.sides(points, face).behind, |set, g| set | g.behind);
        if on_front & !outside & !base & !bit(w) != 0 {
            return false;
        }
        for i in 0..self.edges.len() {
            let edge = self.edges[i];
            for (g, sides) in others.into_iter().zip(new) {
                if sides.part(edge) && self.meets(points, edge, g) {
                    return false;
                }
            }
        }
        for i in 0..self.front.len() {
            let f = self.front[i];
            let sides = self.sides(points, f);
            let across = match (sides.ahead & bit(w) != 0, sides.behind & bit(w) != 0) {
                (true, _) => sides.behind & base,
                (_, true) => sides.ahead & base,
                _ => 0,
            };
            if face.into_iter().any(|v| across & bit(v) != 0 && self.meets(points, [w, v], f)) {
                return false;
            }
            let corners = bit(f[0]) | bit(f[1]) | bit(f[2]);
            for (g, sides) in others.into_iter().zip(new) {
                if corners & sides.ahead == 0 || corners & sides.behind == 0 {
                    continue;
                }
                for edge in [[f[0], f[1]], [f[1], f[2]], [f[2], f[0]]] {
                    // Each edge of the front belongs to two of its faces, one of which has it this way.
                    if edge[0] < edge[1] && sides.part(edge) && self.meets(points, edge, g) {
                        return false;
                    }
                }
            }
        }
        true
    }

    /// The line through two vertices on different sides of a face meets the closed face.
    fn meets(&mut self, points: &Points, [p, q]: [u8; 2], [x, y, z]: Face) -> bool {
        let turns = [
            self.signs.of(points, p, q, x, y),
            self.signs.of(points, p, q, y, z),
            self.signs.of(points, p, q, z, x),
        ];
        turns.iter().all(|&s| s >= 0) || turns.iter().all(|&s| s <= 0)
    }

    /// Volume over the cube of the mean edge length, in plain arithmetic: it only orders the search.
    fn quality(&self, w: u8, face: Face) -> f64 {
        let at = |i: u8| &self.xyz[i as usize];
        quality([at(w), at(face[0]), at(face[1]), at(face[2])]).abs()
    }
}
