//! A polyhedron hollowed out of the mesh on one side of new walls, and its growth.
//!
//! A hollow that cannot be filled often can be after opening one of its edges: all tetrahedra around it are added, so that the edge is no
//! longer required. Reflex and flat edges are what obstructs a filling (the twisted diagonals of a prism, for example).
use crate::error::Error;
use crate::fallible;
use crate::kernel::cavity::{Cavity, Terms};
use crate::kernel::edge_key;
use crate::kernel::replace::Sector;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use crate::ops::reconnect::{Polyhedron, Reconnect, MOST_VERTICES};
use crate::predicates::{Points, Sign};
use rustc_hash::FxHashSet;

/// How far to grow.
#[derive(Clone, Copy, Debug)]
pub struct Growth {
    /// Steps per search.
    pub budget: u32,
    /// Edges opened at each hollow.
    pub branches: usize,
    /// Hollows tried in all.
    pub tries: usize,
}

/// Most tetrahedra added to open one edge: with more, more edges can be opened, into hollows whose steps cost more. 6 and 24 change nothing
/// on six models: it only bounds the work on worse ones.
const MOST_RING: usize = 12;

/// A polyhedron to fill; keeps its scratch space.
#[derive(Default)]
pub struct Hollow {
    /// The tetrahedra taken out, and what bounds them.
    pub cavity: Cavity,
    edges: Vec<[u32; 2]>,
    at_edge: Vec<([u32; 2], u32, u32)>,
    /// All tetrahedra that the last growth looked at, with repetitions: while they stay, it would end the same way.
    pub read: Vec<u32>,
}

/// What a hollow starts from.
#[derive(Clone, Copy, Debug)]
pub struct Start<'a> {
    /// The tetrahedra that must go.
    pub tets: &'a [u32],
    /// Subfaces that go, as keys.
    pub gone: &'a [[u32; 3]],
    /// Walls that come, turned inward.
    pub walls: &'a [[u32; 3]],
    /// A vertex that goes, or `NONE`.
    pub without: u32,
    /// An edge that must come.
    pub edge: Option<[u32; 2]>,
    /// Tetrahedra with both vertices are not added: they belong to another part of the same replacement.
    pub avoid: [u32; 2],
    /// Nor are these.
    pub taken: &'a [Sector],
}

impl Hollow {
    /// Takes these tetrahedra out.
    fn bound(
        &mut self,
        mesh: &Mesh,
        tets: &[u32],
        start: &Start,
        isolated: &FxHashSet<[u32; 2]>,
    ) -> Result<(), Error> {
        self.cavity.set(tets)?;
        let Start { gone, walls, without, .. } = *start;
        self.cavity.bound(mesh, &Terms { keep: isolated, gone, walls, without })?;
        self.edges.clear();
        self.edges.try_reserve(1 + self.cavity.edges.len())?;
        fallible::extend(&mut self.edges, start.edge)?;
        let others = self.cavity.edges.iter().copied().filter(|&edge| Some(edge) != start.edge);
        Ok(fallible::extend(&mut self.edges, others)?)
    }

    fn fill(
        &self,
        reconnect: &mut Reconnect,
        points: &Points,
        budget: u32,
        new: &mut Vec<[u32; 4]>,
    ) -> Result<bool, Error> {
        if self.cavity.vertex_count() > MOST_VERTICES {
            return Ok(false);
        }
        let polyhedron =
            Polyhedron { faces: &self.cavity.faces, inner: &self.cavity.inner, edges: &self.edges };
        reconnect.fill_another(points, &polyhedron, budget, new)
    }

    /// Fills the hollow with more and more opened, breadth first. Returns the new tetrahedra, or nothing; the old ones are in `self.cavity`.
    pub fn grow(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        reconnect: &mut Reconnect,
        start: &Start,
        isolated: &FxHashSet<[u32; 2]>,
        growth: Growth,
    ) -> Result<Option<Vec<[u32; 4]>>, Error> {
        self.read.clear();
        // No point moves from here on.
        reconnect.forget();
        let mut new = Vec::new();
        let mut known: FxHashSet<Vec<u32>> = FxHashSet::default();
        let mut queue: Vec<Vec<u32>> = Vec::new();
        let first = fallible::copied(start.tets)?;
        queue.try_reserve(growth.tries + 1)?;
        fallible::push(&mut queue, first)?;
        let mut next = 0;
        while next < queue.len() {
            fallible::append(&mut self.read, &queue[next])?;
            self.bound(mesh, &queue[next], start, isolated)?;
            // The caller has already tried the start itself.
            if next > 0 && self.fill(reconnect, points, growth.budget, &mut new)? {
                return Ok(Some(new));
            }
            next += 1;
            if queue.len() > growth.tries {
                continue;
            }
            for ring in self.rings(mesh, points, start)?.into_iter().take(growth.branches) {
                let mut larger = fallible::reserved(self.cavity.tets.len() + ring.len())?;
                fallible::append(&mut larger, &self.cavity.tets)?;
                fallible::append(&mut larger, &ring)?;
                let mut key = fallible::copied(&larger)?;
                key.sort_unstable();
                if fallible::add(&mut known, key)? && queue.len() <= growth.tries {
                    fallible::push(&mut queue, larger)?;
                }
            }
        }
        Ok(None)
    }

    /// The tetrahedra outside round each edge of the boundary that could be opened: reflex edges first, then flat ones, then those
    /// with few tetrahedra.
    fn rings(&mut self, mesh: &Mesh, points: &Points, start: &Start) -> Result<Vec<Vec<u32>>, Error> {
        self.at_edge.clear();
        for &(face, code) in &self.cavity.doors {
            let [x, y, z] = self.cavity.faces[face as usize];
            for (p, q) in [(x, y), (y, z), (z, x)] {
                fallible::push(&mut self.at_edge, (edge_key(p, q), face, code))?;
            }
        }
        self.at_edge.sort_unstable();
        let mut ranked: Vec<(Sign, usize, [u32; 2], Vec<u32>)> = Vec::new();
        let Hollow { at_edge, cavity, read, .. } = self;
        let faces = &cavity.faces;
        for pair in at_edge.chunk_by(|a, b| a.0 == b.0) {
            let [(edge, face, code), (_, other, _)] = *pair else { continue };
            let Some(ring) = ring(mesh, edge, code, start, cavity, read)? else { continue };
            let [x, y, z] = faces[face as usize];
            let apex = faces[other as usize].into_iter().find(|v| !edge.contains(v));
            let Some(apex) = apex else { continue };
            let sign =
                if [x, y, z].contains(&apex) { Sign::Negative } else { points.orient3d(apex, x, y, z) };
            fallible::push(&mut ranked, (sign, ring.len(), edge, ring))?;
        }
        ranked.sort_unstable();
        // Convex edges hardly ever obstruct a filling.
        let blocking = ranked.iter().filter(|r| r.0 != Sign::Positive).count();
        ranked.truncate(blocking.max(2));
        Ok(fallible::collect(ranked.into_iter().map(|r| r.3))?)
    }
}

/// The tetrahedra outside round an edge, from the one behind a boundary face to the next boundary face; none if a wall or what
/// must not be taken is among them. All that were looked at are added to `read`.
fn ring(
    mesh: &Mesh,
    edge: [u32; 2],
    code: u32,
    start: &Start,
    cavity: &Cavity,
    read: &mut Vec<u32>,
) -> Result<Option<Vec<u32>>, Error> {
    let mut ring = Vec::new();
    let mut entered = code;
    let mut left = mesh.face(code).into_iter().find(|v| !edge.contains(v)).unwrap_or(NONE);
    loop {
        let t = entered >> 2;
        if cavity.has(t) {
            return Ok(Some(ring));
        }
        fallible::push(read, t)?;
        let verts = mesh.verts(t);
        let taken = start.taken.iter().any(|s| s.old.contains(&t));
        if taken || ring.len() >= MOST_RING || start.avoid.iter().all(|v| verts.contains(v)) {
            return Ok(None);
        }
        fallible::push(&mut ring, t)?;
        let Some(slot) = mesh.slot_of(t, left) else { return Ok(None) };
        if mesh.is_wall(4 * t + slot) {
            return Ok(None);
        }
        left = mesh.apex(entered);
        entered = mesh.across(4 * t + slot);
    }
}
