//! The star of a point inside a segment, decomposed into walls and the sectors between them.
//!
//! A *wall* is the fan of subfaces (or of boundary faces) at the point in one half-plane bounded by the segment's line: a planar
//! polygon that is star-shaped from the point on one of its edges. A *sector* is what lies between walls: tetrahedra of the domain, or
//! ghosts. Without the point, each wall is retriangulated and each sector filled on its own.
use crate::error::Error;
use crate::fallible;
use crate::kernel::around::StarSearch;
use crate::kernel::face_key;
use crate::kernel::reversed;
use crate::kernel::Mesh;
use crate::kernel::NONE;
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;

/// A fan of subfaces from the point.
#[derive(Debug, Default)]
pub struct Wall {
    /// The polygon without the point: from one neighbour on the segment around to the other.
    pub polygon: Vec<u32>,
    /// Its subfaces' patch, `NONE` for boundary faces that are none.
    pub patch: u32,
    /// Corners of its faces now, as keys.
    pub faces: Vec<[u32; 3]>,
    /// The sectors on both sides, and whether triangles that turn the polygon's way are turned inward there.
    pub sides: [(usize, bool); 2],
}

/// The tetrahedra between walls.
#[derive(Debug, Default)]
pub struct Between {
    /// Their slots.
    pub tets: Vec<u32>,
    /// They are ghosts.
    pub void: bool,
    /// Their region.
    pub region: u32,
    /// The faces opposite the point, turned inward.
    pub link: Vec<[u32; 3]>,
}

/// A star taken apart; keeps its scratch space.
#[derive(Default)]
pub struct Star {
    /// The fans.
    pub walls: Vec<Wall>,
    /// What lies between.
    pub sectors: Vec<Between>,
    search: StarSearch,
    sector_of: FxHashMap<u32, usize>,
    /// Wall faces `(v, x, y)` by `x` and by `y`: corner codes.
    at: FxHashMap<u32, Vec<u32>>,
}

impl Star {
    /// Takes the star of `v` apart; `ends` are its neighbours on its segment.
    pub fn read(&mut self, mesh: &mut Mesh, v: u32, ends: [u32; 2]) -> Result<(), Error> {
        let start = mesh.vertex_tet[v as usize];
        self.search.vertex_star(mesh, v, start)?;
        self.find_sectors(mesh, v)?;
        self.find_walls(mesh, v, ends)
    }

    fn find_sectors(&mut self, mesh: &Mesh, v: u32) -> Result<(), Error> {
        self.sectors.clear();
        self.sector_of.clear();
        self.at.clear();
        let mut stack: Vec<u32> = fallible::reserved(self.search.tets.len() + 4)?;
        for &seed in &self.search.tets {
            if self.sector_of.contains_key(&seed) {
                continue;
            }
            let number = self.sectors.len();
            let mut sector =
                Between { void: mesh.is_ghost(seed), region: mesh.region(seed), ..Between::default() };
            fallible::insert(&mut self.sector_of, seed, number)?;
            fallible::push(&mut stack, seed)?;
            while let Some(t) = stack.pop() {
                fallible::push(&mut sector.tets, t)?;
                for code in 4 * t..4 * t + 4 {
                    let n = mesh.across(code) >> 2;
                    if mesh.apex(code) == v {
                        if !sector.void {
                            fallible::push(&mut sector.link, mesh.face(code))?;
                        }
                    } else if mesh.is_wall(code) {
                        if code < mesh.across(code) {
                            for w in mesh.face(code).into_iter().filter(|&w| w != v) {
                                fallible::push(fallible::entry(&mut self.at, w)?.or_default(), code)?;
                            }
                        }
                    } else if let Entry::Vacant(entry) = fallible::entry(&mut self.sector_of, n)? {
                        entry.insert(number);
                        fallible::push(&mut stack, n)?;
                    }
                }
            }
            fallible::push(&mut self.sectors, sector)?;
        }
        Ok(())
    }

    fn find_walls(&mut self, mesh: &Mesh, v: u32, [a, b]: [u32; 2]) -> Result<(), Error> {
        self.walls.clear();
        let broken = || Error::internal("the subfaces at a point inside a segment are no fans");
        let Some(starts) = self.at.get(&a) else { return Ok(()) };
        for &start in starts {
            let mut wall = Wall { patch: NONE, ..Wall::default() };
            fallible::push(&mut wall.polygon, a)?;
            let (mut code, mut from) = (start, a);
            loop {
                let face = mesh.face(code);
                fallible::push(&mut wall.faces, face_key(face))?;
                let Some(to) = face.into_iter().find(|&w| w != v && w != from) else { return Err(broken()) };
                fallible::push(&mut wall.polygon, to)?;
                if to == b {
                    break;
                }
                let next = match self.at.get(&to).map(|codes| &codes[..]) {
                    Some(&[x, y]) if x == code => y,
                    Some(&[x, y]) if y == code => x,
                    _ => return Err(broken()),
                };
                (code, from) = (next, to);
            }
            wall.patch = mesh.subface(start);
            // (v, a, u) turns as the polygon does.
            let face = mesh.face(start);
            let forward = (0..3).any(|k| face[k] == v && face[(k + 1) % 3] == a);
            let side = |code: u32| self.sector_of.get(&(code >> 2)).copied().ok_or_else(broken);
            wall.sides = [(side(start)?, forward), (side(mesh.across(start))?, !forward)];
            fallible::push(&mut self.walls, wall)?;
        }
        Ok(())
    }

    /// Appends the faces that sector `s` gets from the walls if these are triangulated as chosen.
    pub fn wall_faces<'a>(
        &self,
        s: usize,
        chosen: &dyn Fn(usize) -> Option<&'a [[u32; 3]]>,
        faces: &mut Vec<[u32; 3]>,
    ) -> Result<(), Error> {
        for (w, wall) in self.walls.iter().enumerate() {
            for &(sector, forward) in &wall.sides {
                if sector != s {
                    continue;
                }
                let Some(triangles) = chosen(w) else { continue };
                fallible::extend(faces, triangles.iter().map(|&t| if forward { t } else { reversed(t) }))?;
            }
        }
        Ok(())
    }
}
