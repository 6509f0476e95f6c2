//! A block: some tetrahedra of a mesh as a mesh of its own, and back.
//!
//! A block has its own vertices and slots, so that several can be changed at the same time. Its boundary is closed by ghosts like that of any
//! domain ([`Mesh::of_domain`]): what changes it keeps walls, so it keeps the boundary, and the block fits into its place again, whatever
//! has happened to other blocks meanwhile.
//!
//! Invariants: slot `i` of the block is the `i`-th of its tetrahedra; behind them come the ghosts, one for each boundary face, which nobody may
//! replace. Boundary faces keep their corners.
use crate::control::Control;
use crate::error::Error;
use crate::fallible;
use crate::kernel::given::{Beside, Given};
use crate::kernel::tables::EDGE;
use crate::kernel::{flag, Mesh, GHOST, NONE};

/// The tetrahedra of each block.
#[derive(Debug, Default)]
pub struct Shares {
    /// Slots, block by block; in a block they ascend.
    pub slots: Vec<u32>,
    /// Where each block begins, and the end.
    pub starts: Vec<usize>,
    /// Per slot of the mesh where it is in `slots`; `NONE` if it is in no block.
    pub rank: Vec<u32>,
}

impl Shares {
    /// The number of blocks.
    pub fn count(&self) -> usize {
        self.starts.len().saturating_sub(1)
    }

    /// The slots of a block.
    pub fn of(&self, block: usize) -> &[u32] {
        &self.slots[self.starts[block]..self.starts[block + 1]]
    }

    /// Whether a block has a slot of the mesh.
    pub fn has(&self, block: usize, t: u32) -> bool {
        self.place(block, t).is_some()
    }

    /// The place in a block of a slot of the mesh, if it has it.
    fn place(&self, block: usize, t: u32) -> Option<u32> {
        let rank = self.rank.get(t as usize).filter(|&&rank| rank != NONE)?;
        let [from, to] = [self.starts[block], self.starts[block + 1]];
        (from..to).contains(&(*rank as usize)).then(|| rank - from as u32)
    }
}

/// Some tetrahedra of a mesh.
#[derive(Debug)]
pub struct Block {
    /// They, with vertices numbered anew.
    pub mesh: Mesh,
    /// The vertex of the whole mesh that each was.
    pub vertices: Vec<u32>,
    /// Where the tetrahedra were.
    slots: Vec<u32>,
    /// For each ghost, where the boundary face was: the corner code inside.
    boundary: Vec<u32>,
    /// For each ghost, whether the boundary face is no wall of the whole mesh.
    seam: Vec<bool>,
}

impl Block {
    /// What is beyond its boundary faces, and the mesh to be changed.
    pub fn parts(&mut self) -> BlockParts<'_> {
        let seams = Seams { first: self.slots.len() as u32, seam: &self.seam };
        BlockParts { mesh: &mut self.mesh, vertices: &self.vertices, seams }
    }

    /// For each face of the boundary the corner codes on this side, in the whole mesh as it was and in the block as it is.
    pub fn boundary(&self) -> impl Iterator<Item = [u32; 2]> + '_ {
        let ghost = self.slots.len() as u32..;
        self.boundary.iter().zip(ghost).map(|(&code, ghost)| [code, self.mesh.across(4 * ghost + 3)])
    }
}

/// See [`Block::parts`].
pub struct BlockParts<'a> {
    /// As in [`Block`].
    pub mesh: &'a mut Mesh,
    /// As in [`Block`].
    pub vertices: &'a [u32],
    /// Where it was cut.
    pub seams: Seams<'a>,
}

/// The boundary faces of a block that are no walls of the whole mesh.
#[derive(Clone, Copy)]
pub struct Seams<'a> {
    /// The first ghost.
    first: u32,
    /// By ghost.
    seam: &'a [bool],
}

impl Seams<'_> {
    /// Whether the face of a corner is one, seen from inside.
    pub fn has(&self, mesh: &Mesh, code: u32) -> bool {
        let ghost = (mesh.across(code) >> 2).checked_sub(self.first);
        ghost.is_some_and(|ghost| self.seam.get(ghost as usize) == Some(&true))
    }
}

/// Numbers vertices anew, in the order that they have; keeps its table.
#[derive(Debug, Default)]
pub struct Numbering(Vec<u32>);

impl Numbering {
    /// Numbers the vertices of some tetrahedra, and those that these refer to, and returns them.
    fn number(
        &mut self,
        mesh: &Mesh,
        tets: &[u32],
        parents: impl Fn(u32) -> [u32; 3],
        control: &Control,
    ) -> Result<Vec<u32>, Error> {
        let mut vertices = Vec::new();
        let count = self.0.len().max(mesh.vertex_tet.len());
        fallible::resize(&mut self.0, count, NONE)?;
        for &t in tets {
            control.steps(u32::from(t % 16 == 0))?;
            for v in mesh.verts(t) {
                let known = &mut self.0[v as usize];
                if *known == NONE {
                    *known = 0;
                    fallible::push(&mut vertices, v)?;
                }
            }
        }
        for i in 0..vertices.len() {
            for v in parents(vertices[i]).into_iter().filter(|&v| v != NONE) {
                let count = self.0.len().max(v as usize + 1);
                fallible::resize(&mut self.0, count, NONE)?;
                if self.0[v as usize] == NONE {
                    self.0[v as usize] = 0;
                    fallible::push(&mut vertices, v)?;
                }
            }
        }
        // What is perturbed by numbers is perturbed as before.
        control.sort(&mut vertices)?;
        for (i, &v) in (0u32..).zip(&vertices) {
            self.0[v as usize] = i;
        }
        Ok(vertices)
    }

    /// The number of a vertex.
    fn of(&self, v: u32) -> u32 {
        self.0[v as usize]
    }

    /// Forgets the vertices of a list.
    fn clear(&mut self, list: &[u32]) {
        list.iter().for_each(|&v| self.0[v as usize] = NONE);
    }
}

impl Mesh {
    /// A block of this mesh, with what hangs on it. `parents` tells which other vertices one refers to, filled up with `NONE`.
    ///
    /// # Errors
    /// `OutOfMemory`, `TooLarge`, and what ends the run.
    pub fn block(
        &self,
        shares: &Shares,
        block: usize,
        numbering: &mut Numbering,
        parents: impl Fn(u32) -> [u32; 3],
        control: &Control,
    ) -> Result<Block, Error> {
        let slots = fallible::copied(shares.of(block))?;
        let vertices = numbering.number(self, &slots, parents, control)?;
        let mut tets = fallible::reserved(slots.len())?;
        let mut across = fallible::reserved(slots.len())?;
        let mut boundary = Vec::new();
        for &t in &slots {
            control.step()?;
            fallible::push(&mut tets, self.verts(t).map(|v| numbering.of(v)))?;
            let mut row = [NONE; 4];
            for (code, other) in (4 * t..).zip(self.adj(t)) {
                match shares.place(block, other >> 2) {
                    Some(place) => row[(code & 3) as usize] = 4 * place + (other & 3),
                    None => fallible::push(&mut boundary, code)?,
                }
            }
            fallible::push(&mut across, row)?;
        }
        let beside = self.beside(shares, block, &boundary, numbering, control)?;
        numbering.clear(&vertices);
        let given = Given { tets: &tets, across: &across, beside: &beside };
        let mut mesh = Mesh::of_domain(given, vertices.len(), control)?;
        mesh.stamps.tracked = self.stamps.tracked;
        mesh.set_regions(|place| slots.get(place as usize).map_or(NONE, |&t| self.region(t)))?;
        if !self.subface.is_empty() {
            let count = mesh.slot_count();
            fallible::resize(&mut mesh.subface, count, [NONE; 4])?;
        }
        for (place, &t) in slots.iter().enumerate() {
            mesh.flags[place] = self.flags[t as usize] & (flag::FACES | flag::EDGES);
            if let (Some(to), Some(from)) = (mesh.subface.get_mut(place), self.subface.get(t as usize)) {
                *to = *from;
            }
        }
        for (ghost, _) in (slots.len() as u32..).zip(&boundary) {
            mesh.take_over(ghost);
        }
        let seam = fallible::collect(boundary.iter().map(|&code| !self.is_wall(code)))?;
        Ok(Block { mesh, vertices, slots, boundary, seam })
    }

    /// Which boundary faces of a block follow each other round its edges.
    fn beside(
        &self,
        shares: &Shares,
        block: usize,
        boundary: &[u32],
        numbering: &Numbering,
        control: &Control,
    ) -> Result<Vec<Beside>, Error> {
        let code_in = |code: u32| shares.place(block, code >> 2).map(|place| 4 * place + (code & 3));
        let mut out = fallible::reserved(boundary.len() + boundary.len() / 2)?;
        for &code in boundary {
            control.step()?;
            let [x, y, z] = self.face(code);
            for [a, b, left] in [[x, y, z], [y, z, x], [z, x, y]] {
                let other = self.turn_outside(code, left, |code| code_in(code).is_some());
                let codes = [code, other].map(|code| if code == NONE { None } else { code_in(code) });
                let [Some(code), Some(other)] = codes else {
                    return Err(Error::internal("a block's boundary is not closed"));
                };
                // The way from the other side is the same.
                if code < other {
                    let edge = [a, b].map(|v| numbering.of(v));
                    fallible::push(&mut out, Beside { edge, codes: [code, other] })?;
                }
            }
        }
        Ok(out)
    }

    /// From a boundary face, given by its corner inside, round its edge without the vertex `left`, through what is outside, to the next one.
    fn turn_outside(&self, code: u32, mut left: u32, inside: impl Fn(u32) -> bool) -> u32 {
        let mut entered = self.across(code);
        for _ in 0..self.slot_count() {
            let t = entered >> 2;
            let Some(slot) = self.slot_of(t, left) else { break };
            left = self.apex(entered);
            entered = self.across(4 * t + slot);
            if inside(entered) {
                return entered;
            }
        }
        NONE
    }

    /// Gives a ghost the subface and the subsegments that the tetrahedron at its face has.
    fn take_over(&mut self, ghost: u32) {
        let code = self.across(4 * ghost + 3);
        if self.is_subface(code) {
            self.set_subface(code);
            let name = self.subface(code);
            if let Some(names) = self.subface.get_mut(ghost as usize) {
                names[3] = name;
            }
        }
        let v = self.verts(ghost);
        for (e, [i, j]) in (0u8..).zip(EDGE) {
            let edge = [v[i as usize], v[j as usize]];
            if edge[0] != GHOST && edge[1] != GHOST && self.is_subsegment(code >> 2, edge) {
                self.set_subsegment(ghost, e);
            }
        }
    }

    /// Puts a block into its place again. `vertices` are those of the whole mesh, also for vertices that are new, and `NONE` for those of them
    /// that are in no tetrahedron; old ones that are gone have no tetrahedron then.
    ///
    /// # Errors
    /// `OutOfMemory`, `TooLarge` (the mesh is then unusable), and what ends the run.
    pub fn put_back(&mut self, block: &Block, vertices: &[u32], control: &Control) -> Result<(), Error> {
        let Block { mesh, slots, boundary, .. } = block;
        let outside = fallible::collect(boundary.iter().map(|&code| self.across(code)))?;
        let (count, ghosts) = (slots.len() as u32, boundary.len() as u32);
        let is_tet = |t: u32| mesh.is_live(t) && !mesh.is_ghost(t);
        let mut to = fallible::filled(NONE, mesh.slot_count())?;
        // What stays where it was is written again: it may have other neighbours.
        let mut free = Vec::new();
        for (place, &t) in (0..count).zip(slots) {
            match is_tet(place) {
                true => to[place as usize] = t,
                false => fallible::push(&mut free, t)?,
            }
        }
        let came = || (count + ghosts..mesh.slot_count() as u32).filter(|&place| is_tet(place));
        let more = came().count().saturating_sub(free.len());
        self.allocate_all(more, &mut free)?;
        for (place, &t) in came().zip(&free) {
            to[place as usize] = t;
        }
        for &t in free.iter().skip(came().count()) {
            self.release(t)?;
        }
        self.fit_attachments(self.slot_count())?;
        self.stamp(to.iter().copied().filter(|&t| t != NONE));
        for (place, &t) in (0u32..).zip(&to).filter(|x| *x.1 != NONE) {
            control.step()?;
            self.verts[t as usize] = mesh.verts(place).map(|v| vertices[v as usize]);
            self.flags[t as usize] = mesh.flags[place as usize] & (flag::FACES | flag::EDGES);
            if let Some(region) = self.region.get_mut(t as usize) {
                *region = mesh.region(place);
            }
            if let (Some(to), Some(from)) =
                (self.subface.get_mut(t as usize), mesh.subface.get(place as usize))
            {
                *to = *from;
            }
            for (code, other) in (4 * t..).zip(mesh.adj(place)) {
                match (other >> 2).checked_sub(count).filter(|&ghost| ghost < ghosts) {
                    Some(ghost) => self.link(code, outside[ghost as usize]),
                    None => {
                        let n = to[(other >> 2) as usize];
                        self.adj[t as usize][(code & 3) as usize] = 4 * n + (other & 3);
                    }
                }
            }
        }
        for (&v, &t) in vertices.iter().zip(&mesh.vertex_tet).filter(|x| *x.0 != NONE) {
            let whole = &mut self.vertex_tet[v as usize];
            if t != NONE {
                *whole = to[t as usize];
            } else if slots.binary_search(whole).is_ok() {
                // It was in the block, not just referred to.
                *whole = NONE;
            }
        }
        Ok(())
    }
}
