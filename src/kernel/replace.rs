//! The one transaction: tetrahedra go, others with the same boundary take their place, and what hangs on the mesh is carried over.
//!
//! Faces are matched by their vertices, each twice: from two new tetrahedra, or from a new tetrahedron and the one that stays beyond the
//! boundary. Most replacements are small, and searching a list of their faces is faster than hashing.
//!
//! Subfaces of old tetrahedra stay subfaces, with their names, where new tetrahedra have the same face, and subsegments stay subsegments
//! where they have the same edge. Regions come from the sector.
use crate::error::Error;
use crate::fallible;
use crate::kernel::journal::Journal;
use crate::kernel::tables::EDGE;
use crate::kernel::{edge_key, face_key, flag, Mesh, GHOST, NONE};
use rustc_hash::{FxHashMap, FxHashSet};
use std::collections::TryReserveError;

/// The most tetrahedra of a small replacement: a list instead of a hash table. From 16 to 64 the time of a model with 2,870 Steiner points
/// stays within 2 %: nothing measurable depends on it.
const SMALL: usize = 32;

/// Faces that wait for their second side, with the corner code of the first.
#[derive(Debug, Default)]
struct OpenFaces {
    small: bool,
    list: Vec<([u32; 3], u32)>,
    map: FxHashMap<[u32; 3], u32>,
}

impl OpenFaces {
    /// Clears the list and makes room for the faces of `tets` tetrahedra.
    fn clear(&mut self, tets: usize) -> Result<(), Error> {
        self.small = tets <= SMALL;
        self.list.clear();
        self.map.clear();
        if self.small {
            self.list.try_reserve(4 * tets)?;
        } else {
            self.map.try_reserve(4 * tets)?;
        }
        Ok(())
    }

    fn insert(&mut self, key: [u32; 3], code: u32) -> Result<(), TryReserveError> {
        if self.small {
            return fallible::push(&mut self.list, (key, code));
        }
        fallible::insert(&mut self.map, key, code).map(drop)
    }

    fn remove(&mut self, key: &[u32; 3]) -> Option<u32> {
        if !self.small {
            return self.map.remove(key);
        }
        let at = self.list.iter().position(|x| x.0 == *key)?;
        Some(self.list.swap_remove(at).1)
    }

    fn is_empty(&self) -> bool {
        self.list.is_empty() && self.map.is_empty()
    }
}

/// A part of a replacement between subfaces: tetrahedra that go, and those that come.
#[derive(Debug, Default)]
pub struct Sector {
    /// Slots of the old tetrahedra.
    pub old: Vec<u32>,
    /// Vertices of the new ones, positive; ghosts with the ghost vertex last.
    pub new: Vec<[u32; 4]>,
    /// Their region; `NONE` if they are ghosts.
    pub region: u32,
}

/// A part of a replacement, borrowed.
#[derive(Clone, Copy)]
struct Part<'a> {
    old: &'a [u32],
    new: &'a [[u32; 4]],
    region: u32,
}

/// Replaces tetrahedra; keeps its scratch space.
#[derive(Debug, Default)]
pub struct Replace {
    open: OpenFaces,
    /// Subfaces inside and on the boundary, with their names.
    subfaces: FxHashMap<[u32; 3], u32>,
    /// Subsegments inside and on the boundary.
    subsegments: FxHashSet<[u32; 2]>,
    /// The slots of the new tetrahedra, in the order given.
    pub fresh: Vec<u32>,
}

impl Replace {
    /// Replaces the tetrahedra `old`, all of one region and none a ghost, by `new`. The faces `subfaces` become subfaces without names.
    ///
    /// # Errors
    /// `Internal` if the boundaries differ (the mesh is then unusable), `OutOfMemory`, `TooLarge`.
    pub fn cavity(
        &mut self,
        mesh: &mut Mesh,
        old: &[u32],
        new: &[[u32; 4]],
        subfaces: &[[u32; 3]],
    ) -> Result<(), Error> {
        self.begin(subfaces.iter().map(|&face| (face, NONE)), &[])?;
        let region = old.first().map_or(NONE, |&t| mesh.region(t));
        self.run(mesh, &[Part { old, new, region }])
    }

    /// The same, recorded in a journal.
    pub fn recorded(
        &mut self,
        mesh: &mut Mesh,
        old: &[u32],
        new: &[[u32; 4]],
        journal: &mut Journal,
    ) -> Result<(), Error> {
        journal.begin(mesh, old)?;
        self.cavity(mesh, old, new, &[])?;
        journal.end(&self.fresh)
    }

    /// Replaces the tetrahedra of several sectors at once. `subfaces` come between them, with their names, and `subsegments` among their
    /// edges.
    ///
    /// # Errors
    /// As for [`Replace::cavity`].
    pub fn sectors(
        &mut self,
        mesh: &mut Mesh,
        sectors: &[Sector],
        subfaces: &[([u32; 3], u32)],
        subsegments: &[[u32; 2]],
    ) -> Result<(), Error> {
        self.begin(subfaces.iter().copied(), subsegments)?;
        let parts = sectors.iter().map(|s| Part { old: &s.old, new: &s.new, region: s.region });
        self.run(mesh, &fallible::collect(parts)?)
    }

    fn begin(
        &mut self,
        subfaces: impl ExactSizeIterator<Item = ([u32; 3], u32)>,
        subsegments: &[[u32; 2]],
    ) -> Result<(), Error> {
        self.subfaces.clear();
        let keyed = subfaces.map(|(face, name)| (face_key(face), name));
        fallible::insert_all(&mut self.subfaces, keyed)?;
        self.subsegments.clear();
        let keyed = subsegments.iter().map(|&[a, b]| edge_key(a, b));
        Ok(fallible::add_all(&mut self.subsegments, keyed)?)
    }

    fn run(&mut self, mesh: &mut Mesh, parts: &[Part]) -> Result<(), Error> {
        let old: usize = parts.iter().map(|p| p.old.len()).sum();
        let new: usize = parts.iter().map(|p| p.new.len()).sum();
        self.open.clear(old + new)?;
        self.fresh.clear();
        self.fresh.try_reserve(new)?;
        mesh.prepare(old, new)?;
        self.read(mesh, parts)?;
        for &t in parts.iter().flat_map(|p| p.old) {
            mesh.release(t)?;
        }
        for (sector, part) in (0..).zip(parts) {
            for &corners in part.new {
                self.put(mesh, corners, part.region, sector)?;
            }
        }
        mesh.stamp(parts.iter().flat_map(|p| p.old).chain(&self.fresh).copied());
        if self.open.is_empty() {
            Ok(())
        } else {
            Err(Error::internal("a replacement does not fit into the mesh"))
        }
    }

    /// Collects the boundary, the subfaces and the subsegments of what goes.
    fn read(&mut self, mesh: &mut Mesh, parts: &[Part]) -> Result<(), Error> {
        let mut any = 0;
        for &t in parts.iter().flat_map(|p| p.old) {
            let flags = &mut mesh.flags[t as usize];
            any |= *flags;
            *flags |= flag::MARK;
        }
        if any & flag::EDGES != 0 {
            self.read_subsegments(mesh, parts)?;
        }
        let Replace { open, subfaces, .. } = self;
        for (sector, part) in (0..).zip(parts) {
            for code in part.old.iter().flat_map(|&t| 4 * t..4 * t + 4) {
                let face = mesh.face(code);
                if mesh.is_subface(code) {
                    fallible::insert(subfaces, face_key(face), mesh.subface(code))?;
                }
                let n = mesh.across(code);
                if mesh.flags[(n >> 2) as usize] & flag::MARK == 0 {
                    open.insert(key(face, sector), n)?;
                }
            }
        }
        Ok(())
    }

    #[inline(never)]
    fn read_subsegments(&mut self, mesh: &Mesh, parts: &[Part]) -> Result<(), Error> {
        for &t in parts.iter().flat_map(|p| p.old) {
            for [a, b] in mesh.subsegments(t) {
                fallible::add(&mut self.subsegments, edge_key(a, b))?;
            }
        }
        Ok(())
    }

    /// Puts a new tetrahedron in its slot and links it to those that are there already.
    #[inline(always)]
    fn put(&mut self, mesh: &mut Mesh, corners: [u32; 4], region: u32, sector: u32) -> Result<(), Error> {
        let t = mesh.allocate(corners)?;
        fallible::push(&mut self.fresh, t)?;
        if let Some(place) = mesh.region.get_mut(t as usize) {
            *place = region;
        }
        if corners[3] != GHOST {
            for v in corners {
                mesh.vertex_tet[v as usize] = t;
            }
        }
        if !self.subsegments.is_empty() {
            self.flag_subsegments(mesh, t);
        }
        for code in 4 * t..4 * t + 4 {
            let face = mesh.face(code);
            let key = key(face, sector);
            if !self.subfaces.is_empty() {
                if let Some(&name) = self.subfaces.get(&key) {
                    mesh.flags[t as usize] |= flag::FACE << (code & 3);
                    if let Some(names) = mesh.subface.get_mut(t as usize) {
                        names[(code & 3) as usize] = name;
                    }
                }
            }
            match self.open.remove(&key) {
                Some(other) => mesh.link(code, other),
                None => self.open.insert(key, code)?,
            }
        }
        Ok(())
    }

    #[inline(never)]
    fn flag_subsegments(&self, mesh: &mut Mesh, t: u32) {
        let v = mesh.verts(t);
        for (e, [i, j]) in (0..).zip(EDGE) {
            if self.subsegments.contains(&edge_key(v[i as usize], v[j as usize])) {
                mesh.set_subsegment(t, e);
            }
        }
    }
}

impl Mesh {
    /// Makes room for a replacement, attachments included.
    fn prepare(&mut self, old: usize, new: usize) -> Result<(), Error> {
        self.reserve(new)?;
        self.free.try_reserve(old)?;
        self.fit_attachments(self.verts.len() + new.saturating_sub(old + self.free.len()))
    }

    /// Makes room for what hangs on so many slots.
    pub(super) fn fit_attachments(&mut self, slots: usize) -> Result<(), Error> {
        if !self.region.is_empty() && self.region.len() < slots {
            fallible::resize(&mut self.region, slots, NONE)?;
        }
        if !self.subface.is_empty() && self.subface.len() < slots {
            fallible::resize(&mut self.subface, slots, [NONE; 4])?;
        }
        if self.stamps.tracked && self.stamps.changed.len() < slots {
            fallible::resize(&mut self.stamps.changed, slots, 0)?;
        }
        Ok(())
    }

    /// Notes that slots have changed.
    pub(super) fn stamp(&mut self, slots: impl Iterator<Item = u32>) {
        if self.stamps.tracked {
            self.stamps.changes += 1;
            for t in slots {
                self.stamps.changed[t as usize] = self.stamps.changes;
            }
        }
    }
}

/// The key of a face in a replacement. Ghosts of different sectors may have faces with equal corners, at a line where domains touch. (No
/// vertex has such a high number: a mesh has fewer vertices than tetrahedra, of which there are less than 2^30.)
#[inline(always)]
fn key(face: [u32; 3], sector: u32) -> [u32; 3] {
    let [a, b, c] = face_key(face);
    [a, b, if c == GHOST { GHOST - sector } else { c }]
}
