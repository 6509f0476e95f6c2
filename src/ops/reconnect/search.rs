//! The search of [`Reconnect`](crate::ops::reconnect::Reconnect): depth first over front faces, with an explicit stack.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::ops::quality::quality;
use crate::ops::reconnect::face::{take_lowest, Face, Front, Sides};
use crate::ops::reconnect::free::Blocks;
use crate::ops::reconnect::qualities::Qualities;
use crate::ops::reconnect::rows::Rows;
use crate::ops::reconnect::signs::Signs;
use crate::ops::reconnect::{Polyhedron, MOST_VERTICES};
use crate::predicates::Points;

/// One step: a front face, the apexes to try, and what the current one changed.
#[derive(Default)]
pub(super) struct Level {
    pub(super) face: Face,
    /// Apexes not yet tried, the best last.
    pub(super) apexes: Vec<u8>,
    closed: Vec<(Face, Sides)>,
    opened: Vec<Face>,
}

/// What ends a search.
#[derive(Clone, Copy)]
pub(super) struct Budget<'a> {
    /// The most apexes tried.
    pub(super) steps: u32,
    pub(super) control: &'a Control<'a>,
}

/// State and scratch space.
pub struct Search {
    pub(super) signs: Signs,
    pub(super) rows: Rows,
    /// Tetrahedra that were not free.
    pub(super) blocks: Blocks,
    /// The qualities of tetrahedra, if a search asks for them.
    pub(super) qualities: Qualities,
    /// The best filling so far.
    pub(super) best: Vec<[u8; 4]>,
    /// Faces whose inner side is open.
    pub(super) front: Front,
    /// For each vertex its neighbours on the front.
    pub(super) neighbours: [u64; MOST_VERTICES],
    /// Boundary faces, as given.
    boundary: Vec<Face>,
    /// The polyhedron's vertices.
    pub(super) present: u64,
    /// Required edges.
    pub(super) edges: Vec<[u8; 2]>,
    inner: Vec<u8>,
    pub(super) levels: Vec<Level>,
    pub(super) depth: usize,
    pub(super) tets: Vec<[u8; 4]>,
    /// Apexes of the current face, and the quality of each.
    pub(super) apexes: Vec<(f64, u8)>,
    /// The number of apexes that the last search tried.
    pub(super) steps: u32,
    /// For each pair of vertices how much more often it is used in one direction; zero between uses.
    balance: Vec<i16>,
}

impl Default for Search {
    fn default() -> Self {
        Search {
            signs: Signs::default(),
            rows: Rows::default(),
            blocks: Blocks::default(),
            qualities: Qualities::default(),
            best: Vec::new(),
            front: Front::default(),
            neighbours: [0; MOST_VERTICES],
            boundary: Vec::new(),
            present: 0,
            edges: Vec::new(),
            inner: Vec::new(),
            levels: Vec::new(),
            depth: 0,
            tets: Vec::new(),
            apexes: Vec::new(),
            steps: 0,
            balance: Vec::new(),
        }
    }
}

impl Search {
    /// Forgets all vertices and their signs.
    pub fn forget(&mut self) {
        self.signs.clear();
        self.rows.clear();
        self.blocks.clear();
    }

    /// Sets the front; returns false if the polyhedron is too large or not closed. Known signs are kept as far as there is room.
    pub fn begin(&mut self, points: &Points, polyhedron: &Polyhedron) -> Result<bool, Error> {
        self.steps = 0;
        if !self.number(points, polyhedron)? {
            self.forget();
            if !self.number(points, polyhedron)? {
                return Ok(false);
            }
        }
        if self.present.count_ones() < 4 || !self.is_closed()? {
            return Ok(false);
        }
        self.edges.clear();
        self.edges.try_reserve(polyhedron.edges.len())?;
        for edge in polyhedron.edges {
            // An edge to a vertex not of the polyhedron cannot be required.
            let number = |v: u32| self.signs.number(v).filter(|n| self.present >> n & 1 == 1);
            let [Some(a), Some(b)] = edge.map(number) else { return Ok(false) };
            fallible::push(&mut self.edges, [a, b])?;
        }
        self.front.clear(4 * self.boundary.len() + 64)?;
        for &face in &self.boundary {
            self.front.push(face, Sides::default());
        }
        self.tets.clear();
        self.depth = 0;
        Ok(true)
    }

    /// Numbers the vertices, and sets the boundary by their numbers; returns false if there is no room for all.
    fn number(&mut self, points: &Points, polyhedron: &Polyhedron) -> Result<bool, Error> {
        self.present = 0;
        self.boundary.clear();
        self.boundary.try_reserve(polyhedron.faces.len())?;
        for face in polyhedron.faces {
            let mut corners = [0; 3];
            for (corner, &v) in corners.iter_mut().zip(face) {
                let Some(number) = self.signs.add(points, v)? else { return Ok(false) };
                *corner = number;
                self.present |= 1 << number;
            }
            fallible::push(&mut self.boundary, Face::new(corners, &self.signs.vertices))?;
        }
        self.inner.clear();
        self.inner.try_reserve(polyhedron.inner.len())?;
        for &v in polyhedron.inner {
            let Some(number) = self.signs.add(points, v)? else { return Ok(false) };
            fallible::push(&mut self.inner, number)?;
            self.present |= 1 << number;
        }
        self.rows.set_count(self.signs.count())?;
        self.blocks.set_count(self.signs.count())?;
        Ok(true)
    }

    /// Whether every edge of the boundary is used equally often in both directions.
    fn is_closed(&mut self) -> Result<bool, Error> {
        let Search { balance, boundary, .. } = self;
        if balance.is_empty() {
            fallible::resize(balance, MOST_VERTICES * MOST_VERTICES, 0)?;
        }
        let pair = |a: u8, b: u8| MOST_VERTICES * usize::from(a.min(b)) + usize::from(a.max(b));
        for face in boundary.iter() {
            let [x, y, z] = face.corners();
            for (a, b) in [(x, y), (y, z), (z, x)] {
                let uses = &mut balance[pair(a, b)];
                *uses = uses.wrapping_add(if a < b { 1 } else { -1 });
            }
        }
        let mut closed = true;
        for face in boundary.iter() {
            let [x, y, z] = face.corners();
            for (a, b) in [(x, y), (y, z), (z, x)] {
                closed &= std::mem::take(&mut balance[pair(a, b)]) == 0;
            }
        }
        Ok(closed)
    }

    /// A vertex that sees all boundary faces without it from inside: the one whose worst tetrahedron is best; `None` if there is none.
    pub fn cone(&mut self, points: &Points) -> Option<u8> {
        let bit = |&w: &u8| 1u64 << w;
        // The cone contains nothing but the apex itself and edges from it.
        let mut apexes = self.inner.iter().map(bit).fold(self.present, |all, w| all & w);
        apexes = self.edges.iter().fold(apexes, |all, e| all & (bit(&e[0]) | bit(&e[1])));
        for i in 0..self.boundary.len() {
            let face = self.boundary[i];
            let mut seen = self.front_sides(points, i).ahead;
            let corners = face.mask();
            // A face with the inside on both sides cancels in the sum of boundaries, so the cone may omit it.
            if apexes & corners != 0 && !self.boundary.contains(&face.reversed()) {
                seen |= corners;
            }
            apexes &= seen;
            if apexes == 0 {
                return None;
            }
        }
        let mut best: Option<(f64, u8)> = None;
        // In the order of ids, so that the first of equal ones is taken.
        let (mut list, count) = ([0; MOST_VERTICES], apexes.count_ones() as usize);
        for w in &mut list[..count] {
            *w = apexes.trailing_zeros() as u8;
            apexes &= apexes - 1;
        }
        list[..count].sort_unstable_by_key(|&w| self.signs.vertices[w as usize]);
        for &w in &list[..count] {
            let away = self.boundary.iter().filter(|f| f.mask() & bit(&w) == 0);
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
        let away = self.boundary.iter().filter(|f| f.mask() >> w & 1 == 0);
        for f in away {
            let [x, y, z] = f.corners().map(id);
            fallible::push(tets, [id(w), x, y, z])?;
        }
        Ok(true)
    }

    /// Searches; appends the first solution and returns whether there is one.
    pub fn run(&mut self, points: &Points, budget: Budget, tets: &mut Vec<[u32; 4]>) -> Result<bool, Error> {
        if !self.descend(points)? {
            return Ok(false);
        }
        // Invariant: level `depth − 1` has a face, and none of its apexes is applied.
        while self.depth > 0 {
            let level = self.depth - 1;
            let face = self.levels[level].face;
            let Some(apex) = self.levels[level].apexes.pop() else {
                self.retreat();
                continue;
            };
            self.steps += 1;
            if self.steps > budget.steps {
                return Ok(false);
            }
            budget.control.step()?;
            if !self.apply(level, face, apex)? {
                continue;
            }
            if self.front.faces.is_empty() {
                if self.complete() {
                    let id = |i: u8| self.signs.vertices[i as usize];
                    fallible::extend(tets, self.tets.iter().map(|t| t.map(id)))?;
                    return Ok(true);
                }
                self.undo(level);
            } else if !self.descend(points)? {
                self.undo(level);
            }
        }
        Ok(false)
    }

    /// The sides of a face on which vertices are.
    #[inline(always)]
    pub(super) fn sides(&mut self, points: &Points, face: Face) -> Sides {
        self.rows.of(points, &mut self.signs, face, self.present)
    }

    /// The sides of a front face on which vertices are.
    #[inline(always)]
    pub(super) fn front_sides(&mut self, points: &Points, i: usize) -> Sides {
        let mut sides = self.front.sides[i];
        if sides.ahead | sides.behind == 0 {
            sides = self.sides(points, self.front.faces[i]);
            self.front.sides[i] = sides;
        }
        sides
    }

    /// Pushes the most constrained front face; returns false if a front face has no apex at all.
    fn descend(&mut self, points: &Points) -> Result<bool, Error> {
        let on_front = self.vertices_on_front();
        let mut best: Option<(u32, usize, u64)> = None;
        for i in 0..self.front.faces.len() {
            let set = on_front & self.front_sides(points, i).ahead;
            let count = set.count_ones();
            if count == 0 {
                return Ok(false);
            }
            if best.is_none_or(|b| count < b.0) {
                best = Some((count, i, set));
            }
        }
        let Some((count, index, mut rest)) = best else { return Ok(false) };
        let face = self.front.faces[index];
        self.front.collect_neighbours(&mut self.neighbours);
        self.apexes.clear();
        self.apexes.try_reserve(count as usize)?;
        while let Some(w) = take_lowest(&mut rest) {
            if self.is_free(points, w, face, on_front) {
                let others = face.others(w, &self.signs.vertices);
                let closes = others.iter().filter(|g| self.front.faces.contains(g)).count() as f64;
                let quality = self.quality(w, face);
                fallible::push(&mut self.apexes, (quality * (1.0 + closes), w))?;
            }
        }
        self.push_level(face)
    }

    /// Pushes a face with the current apexes; returns false if there are none.
    pub(super) fn push_level(&mut self, face: Face) -> Result<bool, Error> {
        if self.apexes.is_empty() {
            return Ok(false);
        }
        if self.levels.len() == self.depth {
            fallible::push(&mut self.levels, Level::default())?;
        }
        let Search { apexes, levels, signs, .. } = self;
        let id = |w: u8| signs.vertices[w as usize];
        apexes.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then_with(|| id(b.1).cmp(&id(a.1))));
        let level = &mut levels[self.depth];
        level.face = face;
        level.apexes.clear();
        fallible::extend(&mut level.apexes, apexes.iter().map(|a| a.1))?;
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

    /// Vertices of front faces, and inner vertices of no tetrahedron so far.
    pub(super) fn vertices_on_front(&self) -> u64 {
        let mut set = 0u64;
        for face in &self.front.faces {
            set |= face.mask();
        }
        for &v in &self.inner {
            if !self.tets.iter().any(|t| t.contains(&v)) {
                set |= 1 << v;
            }
        }
        set
    }

    /// Joins a front face to an apex; returns false and changes nothing if a face would get a second tetrahedron on one side.
    #[expect(clippy::disallowed_methods, reason = "there is room for the faces of one tetrahedron")]
    pub(super) fn apply(&mut self, level: usize, face: Face, apex: u8) -> Result<bool, Error> {
        let others = face.others(apex, &self.signs.vertices);
        let faces = &self.front.faces;
        if others.iter().any(|g| faces.contains(&g.reversed()) && !faces.contains(g)) {
            return Ok(false);
        }
        self.front.reserve(3)?;
        let Search { front, levels, .. } = self;
        let level = &mut levels[level];
        level.closed.clear();
        level.opened.clear();
        level.closed.try_reserve(4)?;
        level.opened.try_reserve(3)?;
        let mut close = |front: &mut Front, g: Face| {
            let at = front.faces.iter().position(|&x| x == g);
            if let Some(at) = at {
                level.closed.push(front.swap_remove(at));
            }
            at.is_some()
        };
        close(front, face);
        for g in others {
            if !close(front, g) {
                let far = g.reversed();
                front.push(far, Sides::default());
                level.opened.push(far);
            }
        }
        let [x, y, z] = face.corners();
        fallible::push(&mut self.tets, [apex, x, y, z])?;
        Ok(true)
    }

    /// Undoes the current apex of a level.
    pub(super) fn undo(&mut self, level: usize) {
        let Search { front, levels, .. } = self;
        let level = &levels[level];
        for g in &level.opened {
            if let Some(at) = front.faces.iter().rposition(|x| x == g) {
                front.swap_remove(at);
            }
        }
        for &(face, sides) in &level.closed {
            front.push(face, sides);
        }
        self.tets.pop();
    }

    /// Whether the tetrahedra have all required edges and inner vertices.
    pub(super) fn complete(&self) -> bool {
        let has = |a: u8, b: u8| self.tets.iter().any(|t| t.contains(&a) && t.contains(&b));
        self.edges.iter().all(|&[a, b]| has(a, b)) && self.inner.iter().all(|&v| has(v, v))
    }

    /// Volume over the cube of the mean edge length, in floating-point arithmetic: it only orders the search.
    fn quality(&self, w: u8, face: Face) -> f64 {
        let at = |i: u8| &self.signs.xyz[i as usize];
        let [x, y, z] = face.corners();
        quality([at(w), at(x), at(y), at(z)]).abs()
    }
}
