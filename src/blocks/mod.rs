//! Work on a mesh in blocks, by several threads: each block is a mesh of its own meanwhile ([`kernel::block`](crate::kernel::block)).
//!
//! *Same bytes for any number of threads.* Blocks depend on the mesh alone ([`divide`]), what is done in one depends on this block
//! alone, and they are put back in their order. No data are shared but for reading.
//!
//! What a block's border is in the way of is done in the next round, whose borders are elsewhere ([`Rounds`]): a vertex that has once been inside
//! a block is *settled*. The last round is one block round the vertices that are not, which are few.
//!
//! Blocks come in waves, so that only so many exist at a time.
pub mod divide;
#[cfg(test)]
mod tests;

use crate::control::{controlled, Control, Limits, Part};
use crate::error::Error;
use crate::fallible;
use crate::kernel::block::{Block, Numbering, Shares};
use crate::kernel::budget::Budget;
use crate::kernel::{Mesh, NONE};
use crate::predicates::Points;
use crate::preserve::inside::Inside;
use crate::progress::{Observer, Phase, Silent};
use crate::workers::together;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// Blocks of a wave. They exist at the same time, beside the mesh.
const WAVE: usize = 16;
/// Layers of tetrahedra round the vertices that are not settled.
const LAYERS: usize = 5;
/// After so many rounds what is left is one block.
const MOST_ROUNDS: usize = 3;

/// What is worked on.
pub struct Model<'a> {
    /// Carved, with regions.
    pub mesh: &'a mut Mesh,
    /// All points.
    pub points: &'a mut Points,
    /// The points inside.
    pub inside: &'a mut Inside,
}

/// A block with its points.
pub struct Piece {
    /// Its tetrahedra.
    pub block: Block,
    /// Its points.
    pub points: Points,
    /// Those of the points inside that are not on its border, and what comes.
    pub inside: Inside,
    /// How many points it came with.
    came: usize,
}

/// Who works, and how far they are.
#[derive(Clone, Copy)]
pub struct Crew<'a> {
    /// How many.
    pub threads: usize,
    /// What may end it.
    pub part: Part<'a>,
}

/// Tells the run about the work on a block in the calling thread.
struct Forward<'a> {
    part: Part<'a>,
    done: &'a AtomicUsize,
    all: usize,
}

impl Observer for Forward<'_> {
    fn progress(&mut self, _: Phase, _: f64) -> ControlFlow<()> {
        match self.part.progress(share(self.done, self.all)) {
            Ok(()) => ControlFlow::Continue(()),
            Err(_) => ControlFlow::Break(()),
        }
    }
}

fn share(done: &AtomicUsize, all: usize) -> f64 {
    done.load(Ordering::Relaxed) as f64 / all.max(1) as f64
}

/// Work on a block: its number, and what it is.
pub type Work<'a, R> = dyn Fn(usize, &mut Piece, Part) -> Result<R, Error> + Sync + 'a;

/// What is done with the result of a block that is back in its place: it gets the vertices of the whole mesh.
pub type Landed<'a, R> = dyn FnMut(R, &[u32]) -> Result<(), Error> + 'a;

/// Does the work on every block, and puts the blocks back.
///
/// # Errors
/// Those of the work, `OutOfMemory`, `TooLarge`, `SteinerLimit`, `TetrahedraLimit`, and what ends the run; the mesh is then unusable.
pub fn on_each<R: Send>(
    model: &mut Model,
    shares: &Shares,
    crew: Crew,
    phase: Phase,
    work: &Work<R>,
    landed: &mut Landed<R>,
) -> Result<(), Error> {
    let Crew { threads, part } = crew;
    let tetrahedra = part.tetrahedra_limit();
    let mut tets = Budget::default();
    let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let all = shares.count();
    let mut movable = fallible::filled(false, model.points.len())?;
    model.inside.list.iter().for_each(|&v| movable[v as usize] = true);
    for from in (0..all).step_by(WAVE) {
        let to = all.min(from + WAVE);
        let next = AtomicUsize::new(from);
        let pieces = Mutex::new(fallible::reserved(to - from)?);
        let whole = Whole { mesh: model.mesh, points: model.points, movable: &movable };
        let work_on = |observer: &mut dyn Observer| -> Result<(), Error> {
            let mut numbering = Numbering::default();
            loop {
                let index = next.fetch_add(1, Ordering::Relaxed);
                if index >= to {
                    return Ok(());
                }
                let limits = Limits { cancel: Some(&stop), tetrahedra, ..Limits::default() };
                let piece = controlled(limits, observer, |control| {
                    let mut piece = whole.piece(shares, index, &mut numbering, control)?;
                    let result = work(index, &mut piece, control.whole(phase))?;
                    Ok::<_, Error>((piece, result))
                })?;
                done.fetch_add(1, Ordering::Relaxed);
                let mut pieces = pieces.lock().unwrap_or_else(PoisonError::into_inner);
                fallible::push(&mut pieces, (index, piece))?;
            }
        };
        let own = || {
            let mut forward = Forward { part, done: &done, all };
            // If the run has ended, it knows why.
            work_on(&mut forward).map_err(|error| part.look().err().unwrap_or(error))
        };
        let mut wait = || part.progress(share(&done, all));
        let help = || work_on(&mut Silent);
        together(threads.min(to - from), &help, &|| stop.store(true, Ordering::Relaxed), own, &mut wait)?;
        let mut pieces = pieces.into_inner().unwrap_or_else(PoisonError::into_inner);
        pieces.sort_unstable_by_key(|&(index, _)| index);
        for (_, (piece, result)) in pieces {
            landed(result, &piece.put_back(model, &part)?)?;
        }
        tets.check(model.mesh, &part)?;
        part.steiner(model.inside.total(), usize::MAX / 200)?;
    }
    Ok(())
}

/// What pieces are taken from.
struct Whole<'a> {
    mesh: &'a Mesh,
    points: &'a Points,
    /// By vertex, whether it is a point inside.
    movable: &'a [bool],
}

impl Whole<'_> {
    fn piece(
        &self,
        shares: &Shares,
        index: usize,
        numbering: &mut Numbering,
        control: &Control,
    ) -> Result<Piece, Error> {
        let parents = |v: u32| self.points.parents(v);
        let block = self.mesh.block(shares, index, numbering, parents, control)?;
        let mut movable =
            fallible::collect(block.vertices.iter().map(|&v| self.movable.get(v as usize) == Some(&true)))?;
        for [_, code] in block.boundary() {
            block.mesh.face(code).into_iter().for_each(|v| movable[v as usize] = false);
        }
        let inside = fallible::collect((0u32..).zip(&movable).filter(|x| *x.1).map(|x| x.0))?;
        let points = self.points.excerpt(&block.vertices)?;
        let came = points.len();
        Ok(Piece { block, points, inside: Inside::of(inside), came })
    }
}

impl Piece {
    /// The number of its tetrahedra with ghosts.
    pub fn len(&self) -> usize {
        self.block.mesh.live_count()
    }

    fn put_back(mut self, model: &mut Model, control: &Control) -> Result<Vec<u32>, Error> {
        let Model { mesh, points, inside } = model;
        let mut vertices = std::mem::take(&mut self.block.vertices);
        for (v, &whole) in (0u32..).zip(&vertices) {
            let at = *self.points.xyz(v);
            if *points.xyz(whole) != at {
                points.move_to(whole, at)?;
            }
        }
        for v in self.came as u32..self.points.len() as u32 {
            let there = self.block.mesh.vertex_tet.get(v as usize).is_some_and(|&t| t != NONE);
            let whole = if there { inside.add(mesh, points, *self.points.xyz(v))? } else { NONE };
            fallible::push(&mut vertices, whole)?;
        }
        mesh.put_back(&self.block, &vertices, control)?;
        Ok(vertices)
    }
}

/// Rounds of blocks, and which vertices borders have been in the way of in every one so far.
pub struct Rounds {
    unsettled: Vec<bool>,
    /// Those on borders of this round.
    border: Vec<bool>,
    done: usize,
}

impl Rounds {
    /// Before the first.
    ///
    /// # Errors
    /// `OutOfMemory`.
    pub fn new(points: &Points) -> Result<Rounds, Error> {
        Ok(Rounds { unsettled: fallible::filled(true, points.len())?, border: Vec::new(), done: 0 })
    }

    /// Whether this is the first.
    pub fn is_first(&self) -> bool {
        self.done <= 1
    }

    /// Whether borders were in the way of a vertex in every round before this one.
    pub fn is_unsettled(&self, v: u32) -> bool {
        self.unsettled.get(v as usize) == Some(&true)
    }

    /// The blocks of the next round, of about so many tetrahedra each; `None` if everything is settled.
    ///
    /// # Errors
    /// `OutOfMemory`, and what ends the run.
    pub fn next(
        &mut self,
        mesh: &Mesh,
        points: &Points,
        each: usize,
        control: &Control,
    ) -> Result<Option<Shares>, Error> {
        let counts = |t: u32| mesh.is_live(t) && mesh.region(t) != NONE;
        let round = self.done;
        self.done += 1;
        let shares = match round {
            0 => divide::divide(mesh, points, counts, round, each, control)?,
            _ => {
                for (unsettled, &border) in self.unsettled.iter_mut().zip(&self.border) {
                    *unsettled &= border;
                }
                if !self.unsettled.contains(&true) {
                    return Ok(None);
                }
                let near = self.near(mesh, points, control)?;
                let near = |t: u32| counts(t) && mesh.verts(t).into_iter().any(|v| near[v as usize]);
                let each = if round < MOST_ROUNDS { each } else { usize::MAX };
                divide::divide(mesh, points, near, round, each, control)?
            }
        };
        self.border = self.border_of(mesh, &shares, control)?;
        Ok(Some(shares))
    }

    /// The vertices that all tetrahedra round unsettled ones have, but for the last layer.
    fn near(&self, mesh: &Mesh, points: &Points, control: &Control) -> Result<Vec<bool>, Error> {
        let mut near = fallible::copied(&self.unsettled)?;
        fallible::resize(&mut near, points.len(), false)?;
        for _ in 1..LAYERS {
            let mut wider = fallible::copied(&near)?;
            for t in mesh.all().filter(|&t| mesh.is_live(t) && mesh.region(t) != NONE) {
                control.steps(u32::from(t % 16 == 0))?;
                let v = mesh.verts(t);
                if v.into_iter().any(|v| near[v as usize]) {
                    v.into_iter().for_each(|v| wider[v as usize] = true);
                }
            }
            near = wider;
        }
        Ok(near)
    }

    /// Which vertices are on borders of blocks that walls do not make.
    fn border_of(&self, mesh: &Mesh, shares: &Shares, control: &Control) -> Result<Vec<bool>, Error> {
        let mut border = fallible::filled(false, self.unsettled.len())?;
        for block in 0..shares.count() {
            for &t in shares.of(block) {
                control.steps(u32::from(t % 16 == 0))?;
                for code in 4 * t..4 * t + 4 {
                    if !mesh.is_wall(code) && !shares.has(block, mesh.across(code) >> 2) {
                        for v in mesh.face(code) {
                            if let Some(border) = border.get_mut(v as usize) {
                                *border = true;
                            }
                        }
                    }
                }
            }
        }
        Ok(border)
    }
}
