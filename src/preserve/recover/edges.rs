//! Recovery of edges and faces by flips and reconnection, with points only on segments that resist.
//!
//! First by flips ([`flips`](crate::ops::flip)): an edge that obstructs a missing one is removed if fewer tetrahedra then obstruct it. Edges
//! near the ends come first, and only a few are tried, since most removable edges are there. If no flip helps, a search fills the whole
//! corridor with the edge in it (Liu, Chen & Chen 2007); for a missing triangle whose edges exist, the tetrahedra that cross it are
//! removed, and both halves of the cavity are filled. What fails is tried again after the others, with more steps. A segment that resists
//! to the end gets points ([`breakpoint`](crate::preserve::recover::breakpoint)), each of which makes the corridors shorter, so that this ends.
//!
//! Invariants: `edges` holds the surface's edges that the mesh has, flags the faces; neither is ever lost.
use crate::control::Control;
use crate::error::Error;
use crate::facets::cavity::RegionCavity;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::cavity::{Cavity, Edges, Terms};
use crate::kernel::edge_key;
use crate::kernel::replace::Replace;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::flip::{Flips, Limits, Site};
use crate::ops::reconnect::{Polyhedron, Reconnect};
use crate::predicates::{Expansion, Points, Sign};
use crate::preserve::recover::breakpoint::breakpoint;
use crate::preserve::recover::corridor::{Corridor, Feature, Outcome};
use crate::progress::Phase;
use crate::segments::recovery::Segments;
use rustc_hash::FxHashMap;

/// The effort for edges in one round.
#[derive(Clone, Copy, Debug)]
pub struct Round {
    /// Limits for each obstructing edge.
    pub limits: Limits,
    /// The most obstructing edges tried before the corridor is filled.
    pub tried: usize,
    /// Search steps for the corridor.
    pub budget: u32,
}

const fn round(depth: usize, rings: u32, tried: usize, budget: u32) -> Round {
    Round { limits: Limits { depth, rings }, tried, budget }
}

/// Rounds over the missing edges; the last is that of the pieces of those that resist. The second list takes longer and needs fewer points:
/// its meshes leave more room where those of the first leave none. On eleven models with 22 points inside one level less takes one more
/// (six meshes changed), one more three more (six meshes changed). There half of all rings takes two more (five meshes changed), double two
/// more (three meshes changed). There half of the edges tried takes two more (four meshes changed), double two more (two meshes changed).
/// Half of the steps and double change nothing on eleven models: it only bounds the work on worse ones.
pub const ROUNDS: [&[Round]; 2] = [
    &[round(4, 60, 12, 50), round(6, 200, 12, 200), round(6, 600, 12, 200)],
    &[round(4, 200, 50, 0), round(6, 1000, 50, 200), round(6, 1000, 50, 200), round(7, 2000, 50, 200)],
];

/// Search steps per cavity of a face in each round: time for fewer faces that need points. On eleven models with 22 points inside half of
/// all changes one mesh, double none, but never their number.
pub(super) const BUDGETS: [u32; 3] = [50, 200, 200];
/// The limits for edges that pierce a face. None of the models measured reaches it.
pub(super) const PIERCING: Limits = Limits { depth: 4, rings: 1000 };

/// Most faces of a cavity that is searched: the cost of a step grows with the square. (Larger ones may still be cones.) 30 and 120 change
/// nothing on eleven models: it only bounds the work on worse ones.
const MOST_SEARCHED: usize = 60;

/// Most pieces of one segment; beyond, reconnection has failed. 2,048 and 8,192 change nothing on four models: it only bounds the work on
/// worse ones.
const MOST_PIECES: u32 = 4096;

/// The state of a recovery.
pub struct Recovery<'a> {
    pub(super) mesh: &'a mut Mesh,
    pub(super) control: &'a Control<'a>,
    /// The vertices.
    pub points: &'a mut Points,
    pub(super) rounds: &'static [Round],
    pub(super) edges: Edges,
    pub(super) cavity: Cavity,
    pub(super) replace: Replace,
    corridor: Corridor,
    places: Vec<f64>,
    obstacles: Vec<[u32; 2]>,
    flips: Flips,
    pub(super) search: StarSearch,
    pub(super) crossed: RegionCavity,
    pub(super) reconnect: Reconnect<'a>,
    pub(super) tets: Vec<[u32; 4]>,
    /// Edges missing at the start.
    pub missing_edges: u64,
    /// Faces missing once all edges were there.
    pub missing_faces: u64,
    /// Edges and faces recovered without a point.
    pub recovered: u64,
    /// Edges recovered by points on them.
    pub split: u64,
    /// Faces recovered with points inside.
    pub by_points: u64,
    /// The points inside.
    pub inside: Vec<u32>,
}

impl<'a> Recovery<'a> {
    /// Prepares a recovery; `mesh.vertex_tet` must be up to date.
    pub fn new(
        mesh: &'a mut Mesh,
        points: &'a mut Points,
        rounds: &'static [Round],
        control: &'a Control<'a>,
    ) -> Self {
        Recovery {
            mesh,
            control,
            points,
            rounds,
            edges: Edges::default(),
            cavity: Cavity::default(),
            replace: Replace::default(),
            corridor: Corridor::default(),
            places: Vec::new(),
            obstacles: Vec::new(),
            flips: Flips::default(),
            search: StarSearch::default(),
            crossed: RegionCavity::default(),
            reconnect: Reconnect::new(control),
            tets: Vec::new(),
            missing_edges: 0,
            missing_faces: 0,
            recovered: 0,
            split: 0,
            by_points: 0,
            inside: Vec::new(),
        }
    }

    /// Recovers edges by reconnection alone; returns the numbers of those it could not.
    pub fn edges(&mut self, edges: &[[u32; 2]]) -> Result<Vec<u32>, Error> {
        let mut missing: Vec<u32> = Vec::new();
        self.edges.try_reserve(edges.len())?;
        for (i, &[a, b]) in edges.iter().enumerate() {
            self.control.step()?;
            if self.has_edge(a, b)? {
                fallible::add(&mut self.edges, edge_key(a, b))?;
            } else {
                fallible::push(&mut missing, i as u32)?;
            }
        }
        self.missing_edges = missing.len() as u64;
        self.sort_by_length(edges, &mut missing);
        for round in &self.rounds[..self.rounds.len() - 1] {
            let before = missing.len();
            let mut left = fallible::reserved(missing.len())?;
            for (i, &edge) in missing.iter().enumerate() {
                if i % 64 == 0 {
                    let open = (before - i + left.len()) as f64;
                    self.control.progress(Phase::Segments, 1.0 - open / edges.len().max(1) as f64)?;
                }
                if self.recover_edge(edges[edge as usize], round)? {
                    self.recovered += 1;
                } else {
                    fallible::push(&mut left, edge)?;
                }
            }
            missing = left;
        }
        Ok(missing)
    }

    /// Makes every segment a union of edges by points on those that are missing. False if it was given up.
    pub fn split_missing(&mut self, segments: &mut Segments) -> Result<bool, Error> {
        let mut missing: Vec<u32> = Vec::new();
        for (i, piece) in segments.pieces.iter().enumerate() {
            self.control.step()?;
            if !self.edges.contains(&edge_key(piece.ends[0], piece.ends[1])) {
                fallible::push(&mut missing, i as u32)?;
            }
        }
        self.split += missing.len() as u64;
        let Some(last) = self.rounds.last() else { return Ok(missing.is_empty()) };
        let mut count: FxHashMap<u32, u32> = FxHashMap::default();
        while let Some(piece) = missing.pop() {
            self.control.look()?;
            let sub = segments.pieces[piece as usize];
            if self.recover_edge(sub.ends, last)? {
                continue;
            }
            let pieces = fallible::entry(&mut count, sub.segment)?.or_insert(1);
            *pieces += 1;
            if *pieces > MOST_PIECES || !self.split(segments, piece)? {
                return Ok(false);
            }
            fallible::extend(&mut missing, [segments.pieces.len() as u32 - 1, piece])?;
        }
        Ok(true)
    }

    /// Puts a point on a missing piece.
    fn split(&mut self, segments: &mut Segments, piece: u32) -> Result<bool, Error> {
        let sub = segments.pieces[piece as usize];
        let outcome =
            self.corridor.collect(self.mesh, self.points, sub.ends, &mut self.cavity, self.control)?;
        if outcome != Outcome::Found {
            return Ok(false);
        }
        let [a, b] = segments.ends[sub.segment as usize];
        let part = breakpoint(self.points, sub.ends, &self.corridor.features, &mut self.places)?;
        let t = sub.t[0] + part * (sub.t[1] - sub.t[0]);
        if !(t > sub.t[0] && t < sub.t[1]) {
            return Ok(false);
        }
        let v = self.points.push_on_segment(a, b, &Expansion::from(t))?;
        fallible::push(&mut self.mesh.vertex_tet, NONE)?;
        // The tetrahedra whose closure has the point: it sees their boundary.
        let (mesh, points) = (&self.mesh, &*self.points);
        let mut holds = std::mem::take(&mut self.cavity.tets);
        holds.retain(|&t| {
            (0..4).all(|f| {
                let [x, y, z] = mesh.face(4 * t + f);
                points.orient3d(v, x, y, z) != Sign::Negative
            })
        });
        self.cavity.set(&holds)?;
        self.cavity.bound(self.mesh, &Terms::keep(&self.edges))?;
        self.tets.clear();
        fallible::extend(&mut self.tets, self.cavity.faces.iter().map(|&[x, y, z]| [v, x, y, z]))?;
        let fits = self.tets.iter().all(|&[v, x, y, z]| self.points.orient3d(v, x, y, z) == Sign::Positive);
        if !fits || !self.cavity.edges.is_empty() || !self.cavity.inner.is_empty() {
            return Ok(false);
        }
        self.replace.cavity(self.mesh, &self.cavity.tets, &self.tets, &[])?;
        segments.add_steiner(piece, v, t)?;
        Ok(true)
    }

    /// Short edges first: their corridors are small, and what they fix stays out of the way of long ones.
    fn sort_by_length(&self, edges: &[[u32; 2]], pieces: &mut [u32]) {
        let length = |edge: u32| {
            let [p, q] = edges[edge as usize].map(|v| self.points.xyz(v));
            (0..3).map(|k| (p[k] - q[k]) * (p[k] - q[k])).sum::<f64>()
        };
        pieces.sort_unstable_by(|&x, &y| length(x).total_cmp(&length(y)).then(x.cmp(&y)));
    }

    pub(super) fn has_edge(&mut self, a: u32, b: u32) -> Result<bool, Error> {
        let start = self.mesh.vertex_tet[a as usize];
        let found = start != NONE && self.search.find_edge(self.mesh, a, b, start)?.is_some();
        self.control.worked(self.search.tets.len());
        Ok(found)
    }

    /// Makes `a b` an edge of the mesh, if possible: obstructing edges are flipped away as long as that shortens its corridor, then the
    /// corridor is filled. Returns whether the edge exists.
    pub(super) fn recover_edge(&mut self, edge: [u32; 2], round: &Round) -> Result<bool, Error> {
        loop {
            match self.corridor.collect(self.mesh, self.points, edge, &mut self.cavity, self.control)? {
                Outcome::Present => {
                    fallible::add(&mut self.edges, edge_key(edge[0], edge[1]))?;
                    return Ok(true);
                }
                Outcome::Blocked => return Ok(false),
                Outcome::Found => {}
            }
            if let [Feature::Edge(crossed)] = self.corridor.features[..] {
                let (flips, mut site) = self.site();
                if flips.exchange(&mut site, crossed, edge)? {
                    continue;
                }
            }
            if !self.clear_way(edge, round)? && !self.fill_corridor(edge, round.budget)? {
                return Ok(false);
            }
        }
    }

    /// Fills the corridor of an edge with the edge in it.
    fn fill_corridor(&mut self, edge: [u32; 2], budget: u32) -> Result<bool, Error> {
        let outcome = self.corridor.collect(self.mesh, self.points, edge, &mut self.cavity, self.control)?;
        if outcome != Outcome::Found {
            return Ok(false);
        }
        self.cavity.bound(self.mesh, &Terms::keep(&self.edges))?;
        fallible::push(&mut self.cavity.edges, edge)?;
        self.refill(budget)
    }

    /// What flips work on.
    pub(super) fn site(&mut self) -> (&mut Flips, Site<'_>) {
        let Recovery { mesh, points, edges, replace, flips, control, .. } = self;
        (flips, Site { mesh, points, edges, replace, control })
    }

    /// Fills the bounded cavity and puts the filling in its place.
    fn refill(&mut self, budget: u32) -> Result<bool, Error> {
        self.tets.clear();
        let budget = if self.cavity.faces.len() > MOST_SEARCHED { 0 } else { budget };
        let polyhedron =
            Polyhedron { faces: &self.cavity.faces, inner: &self.cavity.inner, edges: &self.cavity.edges };
        if !self.reconnect.fill(self.points, &polyhedron, budget, &mut self.tets)? {
            return Ok(false);
        }
        self.replace.cavity(self.mesh, &self.cavity.tets, &self.tets, &[])?;
        Ok(true)
    }

    /// Removes one of the edges that obstruct `edge` so that fewer are left.
    fn clear_way(&mut self, edge: [u32; 2], round: &Round) -> Result<bool, Error> {
        self.choose_obstacles(edge, round.tried)?;
        let before = self.cavity.tets.len();
        for i in 0..self.obstacles.len() {
            let obstacle = self.obstacles[i];
            let (flips, mut site) = self.site();
            if !flips.remove(&mut site, obstacle, Some(edge), round.limits)? {
                continue;
            }
            let outcome =
                self.corridor.collect(self.mesh, self.points, edge, &mut self.cavity, self.control)?;
            let after = if outcome == Outcome::Present { 0 } else { self.cavity.tets.len() };
            if outcome != Outcome::Blocked && after < before {
                return Ok(true);
            }
            let (flips, mut site) = self.site();
            flips.take_back(&mut site)?;
        }
        Ok(false)
    }

    /// The removable edges that obstruct `edge`, alternating from both ends, at most as many as are tried.
    fn choose_obstacles(&mut self, edge: [u32; 2], most: usize) -> Result<(), Error> {
        let Recovery { corridor, obstacles, edges, .. } = self;
        obstacles.clear();
        let found = corridor.obstacles.len();
        obstacles.try_reserve(most.min(found))?;
        let by_turns = (0..found).map(|i| if i % 2 == 0 { i / 2 } else { found - 1 - i / 2 });
        for [p, q] in by_turns.map(|i| corridor.obstacles[i]) {
            if obstacles.len() == most {
                break;
            }
            let obstacle = edge_key(p, q);
            let at_end = edge.iter().any(|v| obstacle.contains(v));
            if !at_end && !edges.contains(&obstacle) && !obstacles.contains(&obstacle) {
                fallible::push(obstacles, obstacle)?;
            }
        }
        Ok(())
    }

    /// Flags the triangle in the mesh if it is a face there.
    pub(super) fn mark_if_present(&mut self, corners: [u32; 3]) -> Result<bool, Error> {
        let start = self.mesh.vertex_tet[corners[0] as usize];
        let mesh = &mut self.mesh;
        let found = self.search.find_face(mesh, corners, start)?;
        self.control.worked(self.search.tets.len());
        if let Some(code) = found {
            mesh.set_subface(code);
        }
        Ok(found.is_some())
    }
}
