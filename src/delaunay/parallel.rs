//! One round of insertions by several workers (after Marot, Pellerin & Remacle 2019, "One machine, one minute, three billion
//! tetrahedra", with another schedule).
//!
//! A *pass* divides space into ranges (module `ranges`). A tetrahedron with all vertices in one range belongs to it, the
//! others are frozen. Each range inserts its vertices in order and touches only its own tetrahedra; a vertex whose walk or cavity would
//! need a frozen one is deferred to the next pass, which divides space differently; the few that remain in the end are inserted by one
//! thread. New tetrahedra reuse the slots of dead ones, then a block of slots reserved for the range.
//!
//! *Same bytes for any number of threads.* The ranges depend only on the vertices, and what a range does depends only on its own
//! tetrahedra: not on the worker, nor on what others do at the same time. So slots come out the same whether one thread processes all
//! ranges or many do, and nothing has to be renumbered.
//!
//! No data race: see [`Slots`].
//!
//! # Scaling
//!
//! A vertex is deferred if its cavity reaches a tetrahedron across a border. In a range of m vertices about c·m^(2/3) lie that close to its
//! border, so of V present vertices in R ranges the fraction f = c·(R/V)^(1/3) is deferred, and about f² after a second pass, whose borders
//! meet the first one's in lines. Half of that work is wasted, and the fraction f² is sequential. The number of ranges grows as √V: f falls
//! as V^(-1/6), and the number of usable threads grows (module `ranges`): 2 from 6·10^4 vertices on, 4 at 10^6, 12 at 10^7, 40 at 10^8, 126
//! at 10^9.
//!
//! `capi-tests/bench/delaunay.rs` counts the conflicts for any number of ranges. For uniform random points, the table has the fraction of
//! the last round's vertices that each pass deferred, and a bound on the speed-up of insertion with as many threads as ranges (equal work
//! per vertex, half of it for a deferred one; rounds below 8192 vertices and what the last pass leaves are sequential):
//!
//! | points | ranges | pass 1 | pass 2 | pass 3 | speed-up at most |
//! |--:|--:|--:|--:|--:|--:|
//! | 10^6 | 2 | 5.3 % | 0.4 % | – | 1.96 |
//! | 10^6 | 4 (chosen) | 10.3 % | 0.7 % | – | 3.2 |
//! | 10^6 | 8 | 15.1 % | 3.4 % | – | 5.4 |
//! | 10^6 | 16 | 24.5 % | 9.9 % | 3.8 % | 7.3 |
//! | 10^6 | 64 | 41 % | 38 % | 35 % | 3.8 |
//! | 10^7 | 8 | 6.9 % | 0.8 % | – | 6.9 |
//!
//! So 8 threads need 10^7 points and 16 a few 10^7; 64 ranges, by the law above fitted to the rows of 8, defer 7 % in the first pass at
//! 8·10^7 points. Ordering and division are sequential; each pass visits all tetrahedra once, in parallel.
use crate::control::{Control, Part};
use crate::delaunay::insert::Inserter;
use crate::delaunay::locate::{walk, Walk};
use crate::delaunay::ranges::{Division, FEWEST};
use crate::delaunay::Construction;
use crate::error::{Error, Status};
use crate::fallible;
use crate::kernel::slots::Slots;
use crate::kernel::{flag, Mesh, NONE};
use crate::predicates::Points;
use crate::workers::together;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// A pass with fewer vertices is not worth its preparation.
pub(super) const FEWEST_VERTICES: usize = 4096;
/// After this many vertices a range gives up if it has deferred most of them: if tetrahedra extend across ranges, as through the inside of
/// a cylinder, walks that end at a border only waste time.
const TRIAL: usize = 1024;
/// After this many deferred vertices in a row a walk starts elsewhere.
const PATIENCE: usize = 16;
/// Number of vertices between two reports of progress.
const TICK: usize = 2048;
/// Number of vertices after which a helper asks whether it should stop.
const ASK: usize = 64;

/// The work of one range in a pass.
struct Task {
    /// The range's number in the flags.
    owner: u16,
    vertices: Vec<u32>,
    /// Own tetrahedra along the curve, as starts of walks.
    starts: Vec<u32>,
    free: Vec<u32>,
    /// Unused slots.
    block: std::ops::Range<u32>,
}

/// The result of a task.
struct Outcome {
    deferred: Vec<u32>,
    free: Vec<u32>,
}

/// State shared by all workers.
struct Shop<'a> {
    slots: Slots<'a>,
    points: &'a Points,
    tasks: Mutex<std::iter::Enumerate<std::vec::IntoIter<Task>>>,
    outcomes: Mutex<Vec<(usize, Outcome)>>,
    /// Set by a failure or the end of the run: all workers stop.
    stop: AtomicBool,
    /// Vertices done, inserted or deferred, and all.
    done: AtomicUsize,
    all: f64,
}

/// What may end a worker's work, and what it tells of it.
trait Watch {
    /// Before each vertex.
    fn step(&self, index: usize) -> Result<(), Error>;

    /// Within a vertex that takes long.
    fn look(&self) -> Result<(), Error>;

    /// So much of the pass is done by all together.
    fn progress(&self, fraction: f64) -> Result<(), Error>;
}

/// The calling thread's: the control of the run.
impl Watch for Part<'_> {
    #[inline(always)]
    fn step(&self, _: usize) -> Result<(), Error> {
        Control::step(self)
    }

    fn look(&self) -> Result<(), Error> {
        Control::look(self)
    }

    fn progress(&self, fraction: f64) -> Result<(), Error> {
        Part::progress(*self, fraction)
    }
}

/// A helper's: the flag of all workers.
struct Helper<'a>(&'a AtomicBool);

impl Watch for Helper<'_> {
    #[inline(always)]
    fn step(&self, index: usize) -> Result<(), Error> {
        if index % ASK == 0 {
            self.look()?;
        }
        Ok(())
    }

    fn look(&self) -> Result<(), Error> {
        match self.0.load(Ordering::Relaxed) {
            // The reason is that of whoever set it.
            true => Err(Error::new(Status::Cancelled, "cancelled")),
            false => Ok(()),
        }
    }

    fn progress(&self, _: f64) -> Result<(), Error> {
        Ok(())
    }
}

impl Shop<'_> {
    /// Processes tasks until there are none.
    fn work(&self, inserter: &mut Inserter, watch: &impl Watch) -> Result<(), Error> {
        inserter.prepare(self.points.len())?;
        loop {
            let next = self.tasks.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((index, task)) = next else { return Ok(()) };
            let outcome = self.run(task, inserter, watch)?;
            let mut outcomes = self.outcomes.lock().unwrap_or_else(PoisonError::into_inner);
            fallible::push(&mut outcomes, (index, outcome))?;
        }
    }

    /// The same on the calling thread and `threads − 1` helpers. Only the calling thread reports progress and looks at the control.
    fn work_together(&self, inserter: &mut Inserter, workers: Workers) -> Result<(), Error> {
        let Workers { threads, part } = workers;
        together(
            threads,
            &|| self.work(&mut Inserter::default(), &Helper(&self.stop)),
            &|| self.stop.store(true, Ordering::Relaxed),
            || self.work(inserter, &part),
            &mut || {
                part.look()?;
                part.progress(self.done.load(Ordering::Relaxed) as f64 / self.all)
            },
        )
    }

    /// Inserts the vertices of one range that can be inserted.
    fn run(&self, mut task: Task, inserter: &mut Inserter, watch: &impl Watch) -> Result<Outcome, Error> {
        let vertices = std::mem::take(&mut task.vertices);
        let mut deferred = Vec::new();
        let mut hint = task.starts.first().copied().unwrap_or(NONE);
        let mut row = 0;
        for (i, &p) in vertices.iter().enumerate() {
            if i % TICK == TICK - 1 {
                let done = self.done.fetch_add(TICK, Ordering::Relaxed) + TICK;
                watch.progress(done as f64 / self.all)?;
            }
            watch.step(i)?;
            if i == TRIAL && 4 * deferred.len() > 3 * TRIAL {
                deferred.try_reserve(vertices.len() - i)?;
                fallible::append(&mut deferred, &vertices[i..])?;
                break;
            }
            if row == PATIENCE {
                row = 0;
                hint = self.nearest(&task, p).unwrap_or(hint);
            }
            let inserted = match hint {
                NONE => None,
                _ => self.insert(&mut task, inserter, p, hint, watch)?,
            };
            row = if inserted.is_some() { 0 } else { row + 1 };
            match inserted {
                Some(t) => hint = t,
                None => fallible::push(&mut deferred, p)?,
            }
        }
        self.done.fetch_add(vertices.len() % TICK, Ordering::Relaxed);
        // The rest of the block is part of the mesh as well.
        fallible::extend(&mut task.free, task.block.rev())?;
        Ok(Outcome { deferred, free: task.free })
    }

    /// The live start tetrahedron nearest to `p`, if any.
    fn nearest(&self, task: &Task, p: u32) -> Option<u32> {
        let at = self.points.xyz(p);
        let mut best = (f64::INFINITY, None);
        for &t in task.starts.iter().filter(|&&t| self.slots.flags(t) == task.owner) {
            let q = self.points.xyz(self.slots.vertex(t, 0));
            let distance: f64 = (0..3).map(|k| (at[k] - q[k]) * (at[k] - q[k])).sum();
            if distance < best.0 {
                best = (distance, Some(t));
            }
        }
        best.1
    }

    /// Inserts `p` and returns one of its tetrahedra; `None` if it must be deferred.
    #[inline(always)]
    fn insert(
        &self,
        task: &mut Task,
        inserter: &mut Inserter,
        p: u32,
        hint: u32,
        watch: &impl Watch,
    ) -> Result<Option<u32>, Error> {
        let slots = &self.slots;
        let t = match walk::<true, false, false>(slots, task.owner, self.points, p, hint) {
            Walk::Found(t, _) => t,
            Walk::Left => return Ok(None),
            Walk::Lost => return Err(Error::internal("point location did not terminate")),
        };
        if !inserter
            .conflicts
            .collect::<true, false>(slots, task.owner, self.points, p, t, &|| watch.look())?
        {
            return Ok(None);
        }
        let (dead, fresh) = (inserter.conflicts.dead().len(), inserter.conflicts.face_count());
        let more = fresh.saturating_sub(dead);
        let recycled = more.min(task.free.len());
        if task.block.len() < more - recycled {
            for &t in inserter.conflicts.dead() {
                slots.set_flags(t, task.owner);
            }
            return Ok(None);
        }
        inserter.reuse_slots()?;
        if more > 0 {
            inserter.fresh.try_reserve(more)?;
            fallible::extend(&mut inserter.fresh, task.free.drain(task.free.len() - recycled..))?;
            let end = task.block.start + (more - recycled) as u32;
            fallible::extend(&mut inserter.fresh, task.block.start..end)?;
            task.block.start = end;
        } else {
            task.free.try_reserve(dead - fresh)?;
            for &t in &inserter.conflicts.dead()[fresh..] {
                slots.set_flags(t, flag::DEAD);
                fallible::push(&mut task.free, t)?;
            }
        }
        inserter.fill(slots, task.owner, p)?;
        Ok(Some(inserter.fresh[0]))
    }
}

/// Who works, and what may end it.
#[derive(Clone, Copy)]
pub(super) struct Workers<'a> {
    pub(super) threads: usize,
    pub(super) part: Part<'a>,
}

/// Insertions of one pass.
pub(super) struct Pass<'a> {
    pub(super) points: &'a Points,
    /// All vertices in the mesh.
    pub(super) present: &'a [u32],
    /// Slots reserved, as a fraction of the number expected if no vertex is deferred. (If they do not suffice, vertices are deferred.)
    pub(super) reserve: f64,
    pub(super) workers: Workers<'a>,
}

impl Construction {
    /// Inserts vertices of a round, given by range; returns those that were deferred, in the same order.
    pub(super) fn insert_pass(&mut self, pass: &Pass, division: Division) -> Result<Vec<u32>, Error> {
        let threads = pass.workers.threads.min(division.parts.len()).max(1);
        let workers = Workers { threads, ..pass.workers };
        let starts = self.assign(&division, threads)?;
        let vertices: usize = division.parts.iter().map(Vec::len).sum();
        let each = self.mesh.live_count() as f64 / pass.present.len().max(1) as f64 * pass.reserve;
        let mut tasks = fallible::reserved(division.parts.len())?;
        // Free slots are distributed first; blocks cover the rest.
        let mut free = self.mesh.take_free();
        let first = self.mesh.slot_count() as u32;
        let mut end = first;
        let share = free.len();
        for (i, (vertices_of, starts)) in division.parts.into_iter().zip(starts).enumerate() {
            let part = vertices_of.len() as f64;
            let own = (share as f64 * part / vertices.max(1) as f64) as usize;
            let from = free.len() - own.min(free.len());
            let own = fallible::copied(&free[from..])?;
            free.truncate(from);
            let more = (part * each) as usize + 64;
            let block = end..end.saturating_add(more.saturating_sub(own.len()) as u32);
            end = block.end;
            fallible::push(
                &mut tasks,
                Task { owner: i as u16 + 1, vertices: vertices_of, starts, free: own, block },
            )?;
        }
        let more = (end - first) as usize;
        workers.part.control().room(more * Mesh::SLOT_BYTES)?;
        let shop = Shop {
            slots: self.mesh.share(more)?,
            points: pass.points,
            outcomes: Mutex::new(Vec::new()),
            tasks: Mutex::new(tasks.into_iter().enumerate()),
            stop: AtomicBool::new(false),
            done: AtomicUsize::new(0),
            all: vertices.max(1) as f64,
        };
        shop.work_together(&mut self.inserter, workers)?;
        let mut outcomes = shop.outcomes.into_inner().unwrap_or_else(PoisonError::into_inner);
        outcomes.sort_unstable_by_key(|&(index, _)| index);
        let mut deferred = Vec::new();
        for (_, outcome) in outcomes {
            fallible::extend(&mut free, outcome.free)?;
            fallible::extend(&mut deferred, outcome.deferred)?;
        }
        self.mesh.give_free(free);
        Ok(deferred)
    }

    /// Writes the owner of each tetrahedron into its flags; returns for each range some of its tetrahedra.
    fn assign(&mut self, division: &Division, threads: usize) -> Result<Vec<Vec<u32>>, Error> {
        let (verts, flags) = self.mesh.verts_and_flags();
        let part = verts.len().div_ceil(threads).max(FEWEST);
        let parts = Mutex::new(verts.chunks(part).zip(flags.chunks_mut(part)));
        let work = || loop {
            let next = parts.lock().unwrap_or_else(PoisonError::into_inner).next();
            let Some((verts, flags)) = next else { return Ok(()) };
            division.assign(verts, flags);
        };
        together(threads, &work, &|| {}, work, &mut || Ok(()))?;
        let mut starts: Vec<Vec<u32>> = fallible::made(division.parts.len(), Vec::new)?;
        let stride = (flags.len() / (64 * division.parts.len())).max(1);
        for t in (0..flags.len()).step_by(stride) {
            let owner = flags[t] & flag::OWNER;
            if owner != 0 && flags[t] & flag::DEAD == 0 {
                let list = &mut starts[owner as usize - 1];
                fallible::push(list, t as u32)?;
            }
        }
        Ok(starts)
    }
}
