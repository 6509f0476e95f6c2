//! Removal of edges by flips: of an edge itself, or first of others that obstruct it.
//!
//! An edge is removed if a sheet fills its ring ([`sheet`](crate::ops::sheet)). If none does, the ring is made smaller: an edge from
//! an end to a vertex of the link is removed in the same way, which takes that vertex from the ring, and so on to a limited depth (George,
//! Hecht & Saltel 1991; Liu & Baida 2000, "Applications of flips in boundary recovery"; here with an explicit stack). Flips that do not
//! lead to the removal of the edge itself are undone from a log.
//!
//! If an edge is removed to make way for another, the replacing sheet is the one that obstructs the other edge least.
//!
//! Invariants: constrained edges and subfaces stay; the mesh is valid after every step.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::{EdgeRing, StarSearch};
use crate::kernel::cavity::Edges;
use crate::kernel::edge_key;
use crate::kernel::journal::Journal;
use crate::kernel::replace::Replace;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::sheet::{Sheets, MOST_IN_RING};
use crate::predicates::{Points, Sign};

/// The most tetrahedra around an edge that is removed to make way for another: the number of obstacles to try grows with it. On eleven
/// models with 22 points inside 8 takes three more (seven meshes changed), 32 as many (none changed).
const USUAL_RING: usize = 16;

/// How far to go.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Levels of obstructing edges.
    pub depth: usize,
    /// Rings looked at for one edge.
    pub rings: u32,
}

/// An edge whose ring is being made smaller.
struct Frame {
    edge: [u32; 2],
    /// The vertex that is to get an ear.
    ear: Option<u32>,
    /// Obstructing edges still to be tried, the last first.
    obstacles: Vec<Obstacle>,
    /// Number of tetrahedra around it.
    ring: usize,
    /// Length of the log when it was first tried, and before the last obstacle.
    start: usize,
    kept: usize,
}

/// An obstructing edge.
#[derive(Clone, Copy)]
struct Obstacle {
    edge: [u32; 2],
    /// The vertex of its link that is to get an ear.
    ear: u32,
    /// A tetrahedron that had it.
    hint: u32,
}

/// What to do next.
enum Next {
    Try([u32; 2], Option<u32>, u32),
    Advance,
    Done(bool),
}

/// What flips work on.
pub struct Site<'a> {
    /// The mesh.
    pub mesh: &'a mut Mesh,
    /// The vertices.
    pub points: &'a Points,
    /// Edges that must stay.
    pub edges: &'a Edges,
    /// Puts tetrahedra in place.
    pub replace: &'a mut Replace,
    /// What may end the work.
    pub control: &'a Control<'a>,
}

/// Flips; keeps its scratch space and the log of the last removal.
#[derive(Default)]
pub struct Flips {
    sheets: Sheets,
    search: StarSearch,
    ring: Vec<u32>,
    link: Vec<u32>,
    tets: Vec<[u32; 4]>,
    frames: Vec<Frame>,
    log: Journal,
    /// The edge to make way for, if any.
    way: Option<[u32; 2]>,
}

impl Flips {
    /// Removes an edge, to make way for another if there is one; nothing has changed if the outcome is false.
    pub fn remove(
        &mut self,
        site: &mut Site,
        edge: [u32; 2],
        way: Option<[u32; 2]>,
        limits: Limits,
    ) -> Result<bool, Error> {
        self.way = way;
        self.log.clear();
        self.frames.clear();
        let mut left = limits.rings;
        let mut next = Next::Try(edge, None, NONE);
        loop {
            next = match next {
                Next::Try(edge, ear, hint) => {
                    left = left.saturating_sub(1);
                    site.control.step()?;
                    self.enter(site, edge, ear, hint, limits.depth)?
                }
                Next::Advance => self.advance(site, left)?,
                Next::Done(done) if self.frames.is_empty() => return Ok(done),
                Next::Done(true) => self.resume(site)?,
                Next::Done(false) => Next::Advance,
            };
        }
    }

    /// Replaces an edge by another that crosses it and joins two vertices of its link, if a sheet has it.
    pub fn exchange(&mut self, site: &mut Site, old: [u32; 2], new: [u32; 2]) -> Result<bool, Error> {
        self.log.clear();
        if !self.collect_ring(site, old, Some(new[0]), NONE, MOST_IN_RING)? {
            return Ok(false);
        }
        // The link runs from after the first end to the second, and on to the first.
        let Some(middle) = self.link.iter().position(|&v| v == new[1]) else { return Ok(false) };
        self.tets.clear();
        let Flips { sheets, link, tets, .. } = self;
        link.rotate_right(1);
        let one = fallible::copied(&link[..=middle + 1])?;
        let mut other = fallible::copied(&link[middle + 1..])?;
        fallible::push(&mut other, link[0])?;
        for part in [one, other] {
            if !sheets.fill(site.points, old, &part, false, tets)? {
                return Ok(false);
            }
        }
        self.put(site)?;
        Ok(true)
    }

    /// Undoes the last removal.
    pub fn take_back(&mut self, site: &mut Site) -> Result<(), Error> {
        self.undo(site, 0)
    }

    /// Tries to remove an edge at once, or else makes it the topmost frame.
    fn enter(
        &mut self,
        site: &mut Site,
        edge: [u32; 2],
        ear: Option<u32>,
        hint: u32,
        depth: usize,
    ) -> Result<Next, Error> {
        if self.frames.iter().any(|f| edge_key(f.edge[0], f.edge[1]) == edge_key(edge[0], edge[1]))
            || !self.collect_ring(site, edge, ear, hint, USUAL_RING)?
        {
            return Ok(Next::Done(false));
        }
        let way = self.way.filter(|_| self.frames.is_empty());
        if self.fill_ring(site, edge, ear.is_some(), way)? {
            return Ok(Next::Done(true));
        }
        if self.frames.len() >= depth {
            return Ok(Next::Done(false));
        }
        let obstacles = self.obstacles(site, edge)?;
        let (ring, start) = (self.link.len(), self.log.len());
        fallible::push(&mut self.frames, Frame { edge, ear, obstacles, ring, start, kept: start })?;
        Ok(Next::Advance)
    }

    /// Goes on with the next obstacle of the topmost frame, or gives its edge up.
    fn advance(&mut self, site: &mut Site, left: u32) -> Result<Next, Error> {
        let Some(frame) = self.frames.last_mut() else { return Ok(Next::Done(false)) };
        frame.kept = self.log.len();
        match frame.obstacles.pop() {
            Some(Obstacle { edge, ear, hint }) if left > 0 => Ok(Next::Try(edge, Some(ear), hint)),
            _ => {
                let start = frame.start;
                self.undo(site, start)?;
                self.frames.pop();
                Ok(Next::Done(false))
            }
        }
    }

    /// Called when an obstacle of the topmost frame was removed: tries its edge again.
    fn resume(&mut self, site: &mut Site) -> Result<Next, Error> {
        let Some(&Frame { edge, ear, ring, kept, .. }) = self.frames.last() else {
            return Ok(Next::Done(true));
        };
        if self.collect_ring(site, edge, ear, NONE, USUAL_RING)? {
            let way = self.way.filter(|_| self.frames.len() == 1);
            if self.fill_ring(site, edge, ear.is_some(), way)? {
                self.frames.pop();
                return Ok(Next::Done(true));
            }
            if self.link.len() < ring {
                let obstacles = self.obstacles(site, edge)?;
                if let Some(frame) = self.frames.last_mut() {
                    frame.obstacles = obstacles;
                    frame.ring = self.link.len();
                }
                return Ok(Next::Advance);
            }
        }
        self.undo(site, kept)?;
        Ok(Next::Advance)
    }

    /// Finds the tetrahedra round an edge and its link, the ear's vertex last; false if the edge must stay.
    fn collect_ring(
        &mut self,
        site: &mut Site,
        [p, q]: [u32; 2],
        ear: Option<u32>,
        hint: u32,
        most: usize,
    ) -> Result<bool, Error> {
        if site.edges.contains(&edge_key(p, q)) {
            return Ok(false);
        }
        let mesh = &*site.mesh;
        let known = (hint as usize) < mesh.slot_count() && mesh.is_live(hint) && {
            let v = mesh.verts(hint);
            v.contains(&p) && v.contains(&q)
        };
        let first = match known {
            true => hint,
            false => {
                let found = self.search.find_edge(mesh, p, q, mesh.vertex_tet[p as usize])?;
                site.control.worked(self.search.tets.len());
                let Some(first) = found else { return Ok(false) };
                first
            }
        };
        self.ring.clear();
        self.link.clear();
        self.ring.try_reserve(MOST_IN_RING)?;
        self.link.try_reserve(MOST_IN_RING)?;
        for (t, .., k, l) in EdgeRing::new(mesh, first, p, q) {
            let constrained = mesh.is_subface(4 * t + k) || mesh.is_subface(4 * t + l);
            if constrained || mesh.is_ghost(t) || self.ring.len() == most {
                return Ok(false);
            }
            fallible::push(&mut self.ring, t)?;
            fallible::push(&mut self.link, mesh.vertex(t, k))?;
        }
        if let Some(v) = ear {
            let Some(at) = self.link.iter().position(|&w| w == v) else { return Ok(false) };
            self.link.rotate_left(at + 1);
            self.ring.rotate_left(at + 1);
        }
        Ok(true)
    }

    /// Fills the ring without its edge, if a sheet does.
    fn fill_ring(
        &mut self,
        site: &mut Site,
        edge: [u32; 2],
        ear: bool,
        way: Option<[u32; 2]>,
    ) -> Result<bool, Error> {
        let Flips { sheets, link, tets, .. } = self;
        tets.clear();
        let found = match way {
            Some(way) => sheets.clear(site.points, edge, link, way, tets)?,
            None => sheets.fill(site.points, edge, link, ear, tets)?,
        };
        if found {
            self.put(site)?;
        }
        Ok(found)
    }

    /// Replaces the ring by the current filling.
    fn put(&mut self, site: &mut Site) -> Result<(), Error> {
        site.replace.recorded(site.mesh, &self.ring, &self.tets, &mut self.log)
    }

    /// The edges whose removal would make the ring smaller: if the ear at a vertex of the link is visible from only one end, the edge to
    /// the other end obstructs it.
    fn obstacles(&self, site: &Site, [p, q]: [u32; 2]) -> Result<Vec<Obstacle>, Error> {
        let n = self.link.len();
        let mut out = fallible::reserved(n)?;
        for i in (0..n).rev() {
            let [a, b, c] = [i + n - 1, i, i + 1].map(|at| self.link[at % n]);
            let above = site.points.orient3d(a, b, c, q) == Sign::Positive;
            let below = site.points.orient3d(a, b, c, p) == Sign::Negative;
            match (below, above) {
                (true, false) => {
                    fallible::push(&mut out, Obstacle { edge: [q, b], ear: p, hint: self.ring[i] })?;
                }
                (false, true) => {
                    fallible::push(&mut out, Obstacle { edge: [p, b], ear: q, hint: self.ring[i] })?;
                }
                _ => {}
            }
        }
        Ok(out)
    }

    /// Undoes fillings until the log has this length.
    fn undo(&mut self, site: &mut Site, length: usize) -> Result<(), Error> {
        while self.log.len() > length {
            self.log.take_back(site.mesh)?;
        }
        Ok(())
    }
}
