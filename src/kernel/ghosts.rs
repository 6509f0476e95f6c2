//! Closing a domain by ghosts.
//!
//! The Delaunay tetrahedralization has ghosts beyond its convex hull from the start. Here any other domain gets them: every component that
//! does not stay is contracted to the vertex at infinity. A boundary face has a ghost tetrahedron beyond it; around a boundary edge two
//! ghosts are neighbours if only carved space lies between them. So every face has two sides, every edge a closed ring, and the star of a
//! point inside a segment is connected, even where domains touch only along that segment. (The star of a vertex at which domains touch
//! only in that point is not connected: nothing walks around such a vertex.)
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::tables::FACE;
use crate::kernel::{face_key, Mesh, GHOST, NONE};
use rustc_hash::FxHashMap;

/// The ghost beyond a face of the domain: `(p, face)` is positive for `p` beyond it.
pub fn ghost_at([x, y, z]: [u32; 3]) -> [u32; 4] {
    [x, z, y, GHOST]
}

impl Mesh {
    /// The mesh of these tetrahedra, which must fill a domain whose boundary touches itself nowhere, with ghosts around; vertices are below
    /// `vertex_count`.
    ///
    /// # Errors
    /// `Internal` if the boundary is not closed, `OutOfMemory`, `TooLarge`.
    pub fn of_tetrahedra(tets: &[[u32; 4]], vertex_count: usize) -> Result<Mesh, Error> {
        let hull = outer_faces(tets)?;
        let mut mesh = Mesh::default();
        mesh.reserve(tets.len() + hull.len())?;
        let ghosts = hull.iter().map(|&[x, y, z]| [x, y, z, GHOST]);
        let mut open: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        open.try_reserve(2 * (tets.len() + hull.len()))?;
        for corners in tets.iter().copied().chain(ghosts) {
            let t = mesh.allocate(corners)?;
            for code in 4 * t..4 * t + 4 {
                let key = face_key(mesh.face(code));
                match open.remove(&key) {
                    Some(other) => mesh.link(code, other),
                    None => drop(fallible::insert(&mut open, key, code)?),
                }
            }
        }
        if !open.is_empty() {
            return Err(Error::internal("the boundary of the given tetrahedra is not closed"));
        }
        mesh.index_vertices(vertex_count)?;
        Ok(mesh)
    }

    /// Takes out what has no region (see [`Mesh::set_regions`]), closes the rest by ghosts, and finds a tetrahedron of each vertex.
    ///
    /// # Errors
    /// `Internal` if the boundary is not closed (the mesh is then unusable), `OutOfMemory`, `TooLarge`.
    pub fn carve(&mut self, vertex_count: usize, control: &Control) -> Result<(), Error> {
        let slots = self.slot_count();
        control.look()?;
        let mut carved: Vec<u32> = fallible::reserved(slots)?;
        fallible::extend(&mut carved, self.all().filter(|&t| self.is_live(t) && self.region(t) == NONE))?;
        self.close(slots, control)?;
        self.free.try_reserve(carved.len())?;
        for t in carved {
            self.release(t)?;
        }
        control.look()?;
        self.vertex_tet = Vec::new();
        self.index_vertices(vertex_count)
    }

    /// Puts ghosts on all faces between what stays and what goes, and links them.
    fn close(&mut self, slots: usize, control: &Control) -> Result<(), Error> {
        // Per slot where its first face is in the boundary, which is in ascending order.
        let mut first: Vec<u32> = fallible::reserved(slots)?;
        let mut boundary: Vec<u32> = Vec::new();
        for t in 0..slots as u32 {
            fallible::push(&mut first, boundary.len() as u32)?;
            if t % 64 == 0 {
                control.step()?;
            }
            if self.region(t) == NONE {
                continue;
            }
            for code in 4 * t..4 * t + 4 {
                if self.region(self.across(code) >> 2) == NONE {
                    fallible::push(&mut boundary, code)?;
                }
            }
        }
        self.reserve(boundary.len())?;
        let mut ghosts: Vec<u32> = fallible::reserved(boundary.len())?;
        for &code in &boundary {
            control.step()?;
            let [x, y, z] = self.face(code);
            let g = self.allocate([x, y, z, GHOST])?;
            // No slot has a tetrahedron beyond its faces yet.
            self.adj[g as usize] = [NONE; 4];
            fallible::push(&mut ghosts, g)?;
        }
        let slots_now = self.slot_count();
        fallible::resize(&mut self.region, slots_now, NONE)?;
        let ghost_of = |code: u32| {
            let from = *first.get((code >> 2) as usize)? as usize;
            let at = boundary[from..].iter().take(4).position(|&c| c == code)?;
            Some(ghosts[from + at])
        };
        for (&code, &g) in boundary.iter().zip(&ghosts) {
            control.step()?;
            let corners = self.verts(g);
            for k in 0..3 {
                // The way from the other side was the same.
                if self.adj[g as usize][k] != NONE {
                    continue;
                }
                let edge = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
                let beyond = self.turn_through_void(code, edge, slots);
                let Some(other) = ghost_of(beyond) else {
                    return Err(Error::internal("a boundary edge has an odd number of faces"));
                };
                let slot = (0..3).find(|&i| !edge.contains(&self.vertex(other, i)));
                let Some(slot) = slot else {
                    return Err(Error::internal("a boundary face lacks its edge"));
                };
                self.link(4 * g + k as u32, 4 * other + slot);
            }
        }
        for (&code, &g) in boundary.iter().zip(&ghosts) {
            self.link(code, 4 * g + 3);
        }
        Ok(())
    }

    /// From the boundary face of a corner around one of its edges, through what is removed, to the next boundary face's corner.
    fn turn_through_void(&self, code: u32, edge: [u32; 2], slots: usize) -> u32 {
        let mut entered = self.across(code);
        let mut left = self.face(code).into_iter().find(|v| !edge.contains(v)).unwrap_or(GHOST);
        for _ in 0..slots {
            let t = entered >> 2;
            let Some(slot) = self.slot_of(t, left) else { break };
            left = self.apex(entered);
            entered = self.across(4 * t + slot);
            if self.region(entered >> 2) != NONE {
                return entered;
            }
        }
        NONE
    }
}

/// The faces of one tetrahedron only, turned inwards, in the order of the list.
pub fn outer_faces(tets: &[[u32; 4]]) -> Result<Vec<[u32; 3]>, Error> {
    let faces = || tets.iter().flat_map(|tet| FACE.map(|face| face.map(|k| tet[k as usize])));
    let mut keys = fallible::collect(faces().map(face_key))?;
    keys.sort_unstable();
    let once = |face: &[u32; 3]| {
        let key = face_key(*face);
        let at = keys.partition_point(|x| *x < key);
        keys.get(at + 1) != Some(&key)
    };
    Ok(fallible::collect(faces().filter(once))?)
}
