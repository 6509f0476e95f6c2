//! The mesh of the domain alone, closed by ghosts, on which the removal of boundary points works.
//!
//! Made by carving the constrained mesh ([`Solid::carve`]): every component that does not stay is contracted to the vertex at infinity.
//! A boundary face has a ghost tetrahedron beyond it, like a hull face in the engine's mesh; around a boundary edge two ghosts are
//! neighbours if only carved space lies between them. So every face has two sides, every edge a closed ring, and the star of a point inside
//! a segment is connected, even where domains touch only along that segment. (The star of a vertex at which domains touch only in that
//! point is not connected: nothing here walks around such a vertex.)
//!
//! Invariants between operations: those of [`Tetrahedra`]; all tetrahedra but ghosts are positive; a face is flagged on both sides
//! if and only if it is in `patch_of`; each tetrahedron has a region, ghosts have `NONE`.
use crate::domain::{Components, Regions};
use crate::error::{Error, Status};
use crate::facets::subface::Subfaces;
use crate::kernel::face_key;
use crate::kernel::star::StarSearch;
use crate::kernel::{flag, Tetrahedra, GHOST, NONE};
use rustc_hash::FxHashMap;

/// The working mesh.
#[derive(Clone, Debug, Default)]
pub struct Solid {
    /// The tetrahedra, closed by ghosts.
    pub mesh: Tetrahedra,
    /// Region of each slot; `NONE` for ghosts.
    pub region: Vec<u32>,
    /// A tetrahedron (no ghost) of each vertex, `NONE` for vertices that no tetrahedron has.
    pub vertex_tet: Vec<u32>,
    /// The patch of each subface, by its corners in ascending order.
    pub patch_of: FxHashMap<[u32; 3], u32>,
    /// Faces of a replacement that wait for their second side.
    open: FxHashMap<[u32; 4], u32>,
    /// Tetrahedra made by the last replacement.
    pub fresh: Vec<u32>,
    /// How many replacements there were.
    pub changes: u64,
    /// Per slot, after which of them it has what it has now; slots beyond the end have never changed.
    pub changed: Vec<u64>,
}

/// A part of a replacement between subfaces: tetrahedra that go, and those that come.
#[derive(Clone, Debug, Default)]
pub struct Sector {
    /// Slots of the old tetrahedra.
    pub old: Vec<u32>,
    /// Vertices of the new ones, positive; ghosts with the ghost vertex last.
    pub new: Vec<[u32; 4]>,
    /// Their region; `NONE` if they are ghosts.
    pub region: u32,
}

/// The ghost beyond a face of the domain: `(p, face)` is positive for `p` beyond it.
pub fn ghost_at([x, y, z]: [u32; 3]) -> [u32; 4] {
    [x, z, y, GHOST]
}

/// The face with the opposite orientation.
pub fn reversed([x, y, z]: [u32; 3]) -> [u32; 3] {
    [x, z, y]
}

fn out_of_memory<T>(_: T) -> Error {
    Error::new(Status::OutOfMemory, "out of memory")
}

impl Solid {
    /// Takes the components that stay out of a constrained mesh.
    pub fn carve(
        mesh: Tetrahedra,
        vertex_count: usize,
        components: &Components,
        regions: &Regions,
        subfaces: &Subfaces,
    ) -> Result<Solid, Error> {
        let mut solid = Solid { mesh, ..Solid::default() };
        let slots = solid.mesh.slot_count();
        let mut region_of = Vec::new();
        region_of.try_reserve(slots)?;
        region_of.extend((0..slots as u32).map(|t| {
            let stays = solid.mesh.is_live(t) && !solid.mesh.is_ghost(t);
            if stays {
                regions.of_component[components.of[t as usize] as usize]
            } else {
                NONE
            }
        }));
        solid.region = region_of;
        let mut carved: Vec<u32> = Vec::new();
        carved.try_reserve(slots)?;
        carved
            .extend((0..slots as u32).filter(|&t| solid.mesh.is_live(t) && solid.region[t as usize] == NONE));
        solid.close(slots)?;
        solid.mesh.free.try_reserve(carved.len())?;
        for t in carved {
            solid.mesh.release(t);
        }
        solid.vertex_tet.try_reserve(vertex_count)?;
        solid.vertex_tet.resize(vertex_count, NONE);
        for t in (0..slots as u32).filter(|&t| solid.region[t as usize] != NONE) {
            for v in solid.mesh.verts[t as usize] {
                solid.vertex_tet[v as usize] = t;
            }
        }
        solid.take_subfaces(subfaces)?;
        Ok(solid)
    }

    /// Puts ghosts on all faces between what stays and what goes, and links them.
    fn close(&mut self, slots: usize) -> Result<(), Error> {
        // Per slot where its first face is in the boundary, which is in ascending order.
        let mut first: Vec<u32> = Vec::new();
        first.try_reserve(slots)?;
        let mut boundary: Vec<u32> = Vec::new();
        for t in 0..slots as u32 {
            first.push(boundary.len() as u32);
            if self.region[t as usize] == NONE {
                continue;
            }
            for code in 4 * t..4 * t + 4 {
                if self.region[(self.mesh.across(code) >> 2) as usize] == NONE {
                    boundary.try_reserve(1)?;
                    boundary.push(code);
                }
            }
        }
        self.mesh.reserve(boundary.len())?;
        let mut ghosts: Vec<u32> = Vec::new();
        ghosts.try_reserve(boundary.len())?;
        for &code in &boundary {
            let [x, y, z] = self.mesh.face(code);
            let g = self.mesh.allocate([x, y, z, GHOST]);
            // No slot has a tetrahedron beyond its faces yet.
            self.mesh.adj[g as usize] = [NONE; 4];
            ghosts.push(g);
        }
        self.region.try_reserve(self.mesh.slot_count() - slots)?;
        self.region.resize(self.mesh.slot_count(), NONE);
        let ghost_of = |code: u32| {
            let from = *first.get((code >> 2) as usize)? as usize;
            let at = boundary[from..].iter().take(4).position(|&c| c == code)?;
            Some(ghosts[from + at])
        };
        for (&code, &g) in boundary.iter().zip(&ghosts) {
            let corners = self.mesh.verts[g as usize];
            for k in 0..3 {
                // The way from the other side was the same.
                if self.mesh.adj[g as usize][k] != NONE {
                    continue;
                }
                let edge = [corners[(k + 1) % 3], corners[(k + 2) % 3]];
                let beyond = self.turn_through_void(code, edge, slots);
                let Some(other) = ghost_of(beyond) else {
                    return Err(Error::internal("a boundary edge has an odd number of faces"));
                };
                let slot = (0..3).find(|&i| !edge.contains(&self.mesh.verts[other as usize][i]));
                let Some(slot) = slot else {
                    return Err(Error::internal("a boundary face lacks its edge"));
                };
                self.mesh.link(4 * g + k as u32, 4 * other + slot as u32);
            }
        }
        for (&code, &g) in boundary.iter().zip(&ghosts) {
            self.mesh.link(code, 4 * g + 3);
        }
        Ok(())
    }

    /// From the boundary face of a corner around one of its edges, through what is removed, to the next boundary face's corner.
    fn turn_through_void(&self, code: u32, edge: [u32; 2], slots: usize) -> u32 {
        let mut entered = self.mesh.across(code);
        let mut left = self.mesh.face(code).into_iter().find(|v| !edge.contains(v)).unwrap_or(GHOST);
        for _ in 0..slots {
            let t = entered >> 2;
            let Some(slot) = self.mesh.slot_of(t, left) else { break };
            left = self.mesh.apex(entered);
            entered = self.mesh.across(4 * t + slot);
            if self.region[(entered >> 2) as usize] != NONE {
                return entered;
            }
        }
        NONE
    }

    /// Takes note of the subfaces that are faces of the domain, and flags them on both sides. Tetrahedra have the flags of the
    /// constrained mesh, ghosts none: only what may be a subface is looked up, and that from one side.
    fn take_subfaces(&mut self, subfaces: &Subfaces) -> Result<(), Error> {
        let mut patch_of: FxHashMap<[u32; 3], u32> = FxHashMap::default();
        patch_of.try_reserve(subfaces.verts.len()).map_err(out_of_memory)?;
        for (&corners, &patch) in subfaces.verts.iter().zip(&subfaces.patch) {
            patch_of.insert(face_key(corners), patch);
        }
        let mut sides = 0;
        for t in 0..self.mesh.slot_count() as u32 {
            let before = self.mesh.flags[t as usize];
            self.mesh.flags[t as usize] &= flag::DEAD;
            if !self.mesh.is_live(t) {
                continue;
            }
            let flagged = if self.mesh.is_ghost(t) { flag::FACE << 3 } else { before };
            for f in (0..4).filter(|f| flagged & (flag::FACE << f) != 0) {
                let n = self.mesh.across(4 * t + f);
                let known = n < 4 * t;
                let other = self.mesh.flags[(n >> 2) as usize] & (flag::FACE << (n & 3)) != 0;
                if (known && other) || !known && patch_of.contains_key(&face_key(self.mesh.face(4 * t + f))) {
                    self.mesh.flags[t as usize] |= flag::FACE << f;
                    sides += 1;
                }
            }
        }
        // Each face of the domain has two sides; subfaces that were carved have none.
        if sides < 2 * patch_of.len() {
            let mut stay: FxHashMap<[u32; 3], u32> = FxHashMap::default();
            stay.try_reserve(sides / 2).map_err(out_of_memory)?;
            for code in (0..4 * self.mesh.slot_count() as u32).filter(|&code| code < self.mesh.across(code)) {
                if self.mesh.flags[(code >> 2) as usize] & (flag::FACE << (code & 3)) != 0 {
                    let key = face_key(self.mesh.face(code));
                    stay.extend(patch_of.get(&key).map(|&patch| (key, patch)));
                }
            }
            patch_of = stay;
        }
        self.patch_of = patch_of;
        Ok(())
    }

    /// Whether the face of a corner is a wall: a subface, or between the domain and what is not.
    pub fn is_wall(&self, code: u32) -> bool {
        let (t, n) = (code >> 2, self.mesh.across(code) >> 2);
        self.mesh.flags[t as usize] & (flag::FACE << (code & 3)) != 0
            || self.mesh.is_ghost(t) != self.mesh.is_ghost(n)
    }

    /// Replaces tetrahedra by others. Before, `patch_of` must have got the new subfaces and lost the old ones.
    ///
    /// # Errors
    /// [`Status::Internal`] if the new tetrahedra do not fit together; the mesh is then unusable.
    pub fn replace(&mut self, sectors: &[Sector]) -> Result<(), Error> {
        let Solid { mesh, open, .. } = self;
        open.clear();
        for &t in sectors.iter().flat_map(|s| &s.old) {
            mesh.flags[t as usize] |= flag::MARK;
        }
        for (s, sector) in sectors.iter().enumerate() {
            for code in sector.old.iter().flat_map(|&t| 4 * t..4 * t + 4) {
                let n = mesh.across(code);
                if mesh.flags[(n >> 2) as usize] & flag::MARK == 0 {
                    open.insert(key(mesh.face(code), s), n);
                }
            }
        }
        let count = sectors.iter().map(|s| s.new.len()).sum();
        for &t in sectors.iter().flat_map(|s| &s.old) {
            mesh.release(t);
        }
        self.fresh.clear();
        self.fresh.try_reserve(count)?;
        mesh.reserve(count)?;
        self.region.try_reserve(count)?;
        for (s, sector) in sectors.iter().enumerate() {
            for &corners in &sector.new {
                let t = mesh.allocate(corners);
                self.fresh.push(t);
                if self.region.len() < mesh.slot_count() {
                    self.region.push(NONE);
                }
                self.region[t as usize] = sector.region;
                if corners[3] != GHOST {
                    for v in corners {
                        self.vertex_tet[v as usize] = t;
                    }
                }
                for code in 4 * t..4 * t + 4 {
                    let face = mesh.face(code);
                    if !face.contains(&GHOST) && self.patch_of.contains_key(&face_key(face)) {
                        mesh.flags[t as usize] |= flag::FACE << (code & 3);
                    }
                    let key = key(face, s);
                    match open.remove(&key) {
                        Some(other) => mesh.link(code, other),
                        None => {
                            open.insert(key, code);
                        }
                    }
                }
            }
        }
        self.changes += 1;
        let missing = mesh.slot_count().saturating_sub(self.changed.len());
        self.changed.try_reserve(missing)?;
        self.changed.resize(mesh.slot_count(), 0);
        for &t in sectors.iter().flat_map(|s| &s.old).chain(&self.fresh) {
            self.changed[t as usize] = self.changes;
        }
        if !open.is_empty() {
            return Err(Error::internal("a replacement does not fit into the mesh"));
        }
        Ok(())
    }

    /// The faces opposite a vertex inside, turned towards it. `search` gets its star.
    ///
    /// # Errors
    /// [`Status::OutOfMemory`].
    pub fn link(&mut self, search: &mut StarSearch, v: u32, faces: &mut Vec<[u32; 3]>) -> Result<(), Error> {
        search.vertex_star(&mut self.mesh, v, self.vertex_tet[v as usize]);
        faces.clear();
        faces.try_reserve(search.tets.len())?;
        for &t in &search.tets {
            if let Some(slot) = self.mesh.slot_of(t, v) {
                faces.push(self.mesh.face(4 * t + slot));
            }
        }
        Ok(())
    }

    /// Makes room for a vertex.
    pub fn add_vertex(&mut self, v: u32) -> Result<(), Error> {
        let count = (v as usize + 1).saturating_sub(self.vertex_tet.len());
        self.vertex_tet.try_reserve(count)?;
        self.vertex_tet.resize(self.vertex_tet.len() + count, NONE);
        Ok(())
    }
}

/// The key of a face in a replacement. Ghosts of different sectors may have faces with equal corners, at a line where domains touch.
fn key(face: [u32; 3], sector: usize) -> [u32; 4] {
    let [a, b, c] = face_key(face);
    [a, b, c, if c == GHOST { sector as u32 + 1 } else { 0 }]
}
