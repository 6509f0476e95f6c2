//! What may end a run before it is done, and what a run says meanwhile: one object, handed down to every stage.
//!
//! A caller may cancel (by a [`CancelToken`] from any thread, or by the return value of its [`Observer`]) and may limit time, memory,
//! Steiner points and tetrahedra ([`Limits`]). Each has a status of its own. Progress and log go through the same object, so that progress
//! never falls whatever a stage repeats.
//!
//! Every loop that may run long calls [`Control::step`] once per turn. A step is a counter; every [`INTERVAL`] steps it *looks*: at the
//! token, the clock and, if there is a limit, the memory. A turn may take up to about 100 µs, so that a look comes at least every 20 ms;
//! turns shorter than a microsecond count in blocks ([`Control::steps`]). Looks also call the observer again if it has not been called for
//! a while, so cancelling by its return value is as quick.
//!
//! The object is passed as `&Control` and counts in cells: it can be kept in the structs of a stage and copied into closures beside
//! whatever they change. It belongs to the calling thread; helpers share a flag with it (`delaunay/parallel.rs`).
mod memory;

use crate::error::{Error, Status};
use crate::fallible;
use crate::progress::{Observer, Phase, Silent};
use memory::Memory;
use std::cell::{Cell, RefCell};
use std::cmp::Ordering as Order;
use std::ops::{ControlFlow, Deref, Range};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::Arc;
use std::time::{Duration, Instant};

/// Steps between two looks. A look takes about 40 ns: with turns of a microsecond, 0.03 %.
const INTERVAL: u32 = 128;
/// The most elements sorted between two looks: about 20 ms.
const SORTED_AT_ONCE: usize = 1 << 17;
/// How many turns much shorter than a step count as one.
const TURNS: usize = 64;
/// The observer is called at least this often.
const HEARTBEAT: Duration = Duration::from_millis(20);

/// Cancels runs from any thread. Clones share one state. A run that uses a cancelled token fails with
/// [`Status::Cancelled`], wherever it is; the token stays cancelled until it is reset.
#[derive(Debug, Default)]
pub struct CancelToken(Arc<AtomicBool>);

impl CancelToken {
    /// A token that is not cancelled.
    pub fn new() -> Self {
        Self::default()
    }

    /// Another handle of the same state.
    pub(crate) fn shared(&self) -> Self {
        CancelToken(shared(&self.0))
    }

    /// Cancels all runs that use the token or one of its clones, also those that begin later.
    pub fn cancel(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether the token is cancelled.
    pub fn is_cancelled(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Makes the token usable again. A run that has not yet seen that it was cancelled goes on.
    pub fn reset(&self) {
        self.0.store(false, Ordering::Relaxed);
    }

    /// The state, for [`Limits::cancel`].
    pub fn flag(&self) -> &AtomicBool {
        &self.0
    }
}

#[expect(clippy::disallowed_methods, reason = "a count goes up, nothing is allocated")]
fn shared(state: &Arc<AtomicBool>) -> Arc<AtomicBool> {
    Arc::clone(state)
}

impl Clone for CancelToken {
    fn clone(&self) -> Self {
        self.shared()
    }
}

/// Tokens are equal if they share their state.
impl PartialEq for CancelToken {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

/// What ends a run besides its observer. By default nothing does.
#[derive(Clone, Copy, Debug, Default)]
pub struct Limits<'a> {
    /// Set to cancel.
    pub cancel: Option<&'a AtomicBool>,
    /// Time from the start.
    pub time: Option<Duration>,
    /// Growth of the process's memory from the start, in bytes.
    pub memory: Option<u64>,
    /// Steiner points.
    pub steiner: Option<u64>,
    /// Tetrahedra.
    pub tetrahedra: Option<u64>,
}

/// Limits, progress and log of a run. See the module.
pub struct Control<'a> {
    /// Steps left until the next look.
    left: Cell<u32>,
    limits: Limits<'a>,
    start: Instant,
    memory: Memory,
    caller: &'a dyn Caller,
    /// The phase and fraction reported last.
    now: Cell<Option<(Phase, f64)>>,
    /// When the observer was last called.
    called: Cell<Duration>,
    /// Why the run ends: later steps fail in the same way.
    ended: Cell<Option<Status>>,
    /// Whether progress and log lines are kept back.
    muted: Cell<bool>,
}

/// An observer behind a shared reference, which has its lifetime alone: the structs of a stage need only one.
trait Caller {
    fn progress(&self, phase: Phase, fraction: f64) -> ControlFlow<()>;
    fn log(&self, message: &str);
}

impl Caller for RefCell<&mut dyn Observer> {
    fn progress(&self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        // Nothing of the run goes on during a callback, so nobody else holds it.
        self.try_borrow_mut()
            .map_or(ControlFlow::Continue(()), |mut observer| observer.progress(phase, fraction))
    }

    fn log(&self, message: &str) {
        if let Ok(mut observer) = self.try_borrow_mut() {
            observer.log(message);
        }
    }
}

impl Caller for Silent {
    fn progress(&self, _: Phase, _: f64) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn log(&self, _: &str) {}
}

/// Runs `body` with these limits, which count from here, and an observer.
pub fn controlled<R>(limits: Limits, observer: &mut dyn Observer, body: impl FnOnce(&Control) -> R) -> R {
    let caller = RefCell::new(observer);
    let memory = limits.memory.map_or(Memory::default(), |_| Memory::at_start());
    body(&Control::new(limits, memory, &caller))
}

impl<'a> Control<'a> {
    fn new(limits: Limits<'a>, memory: Memory, caller: &'a dyn Caller) -> Self {
        Control {
            left: Cell::new(0),
            limits,
            start: Instant::now(),
            memory,
            caller,
            now: Cell::new(None),
            called: Cell::new(Duration::ZERO),
            ended: Cell::new(None),
            muted: Cell::new(false),
        }
    }

    /// No limit and no observer.
    pub fn free() -> Control<'static> {
        Control::new(Limits::default(), Memory::default(), &Silent)
    }

    /// One turn of a loop: up to about 100 µs of work.
    ///
    /// # Errors
    /// [`Status::Cancelled`], [`Status::TimeLimit`], [`Status::MemoryLimit`].
    #[inline(always)]
    pub fn step(&self) -> Result<(), Error> {
        self.steps(1)
    }

    /// As much work as `count` steps.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    #[inline(always)]
    pub fn steps(&self, count: u32) -> Result<(), Error> {
        match self.left.get().checked_sub(count) {
            Some(left) => {
                self.left.set(left);
                Ok(())
            }
            None => self.look(),
        }
    }

    /// So many turns much shorter than a step are done, where no error can be returned: if the run must end, the next step says so.
    #[inline(always)]
    pub fn worked(&self, turns: usize) {
        let _ = self.steps((turns / TURNS) as u32);
    }

    /// Whether the run must end.
    #[cold]
    #[inline(never)]
    pub fn look(&self) -> Result<(), Error> {
        self.left.set(INTERVAL);
        let time = self.start.elapsed();
        self.test(time, 0)?;
        match self.now.get() {
            Some((phase, fraction)) if time.saturating_sub(self.called.get()) >= HEARTBEAT => {
                self.call(phase, fraction, time)
            }
            _ => Ok(()),
        }
    }

    /// `fraction` of `phase` is done (0 to 1). Phases come in the order of [`Phase::ALL`]; what would go back is not passed on.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn progress(&self, phase: Phase, fraction: f64) -> Result<(), Error> {
        let fraction = fraction.clamp(0.0, 1.0);
        let time = self.start.elapsed();
        self.test(time, 0)?;
        let now = match self.now.get() {
            Some(now) if self.muted.get() => now,
            Some((last, reached)) if last.place() > phase.place() => (last, reached),
            Some((last, reached)) if last == phase => (last, reached.max(fraction)),
            Some((last, reached)) => {
                if reached < 1.0 {
                    self.call(last, 1.0, time)?;
                }
                (phase, fraction)
            }
            None => (phase, fraction),
        };
        self.now.set(Some(now));
        self.call(now.0, now.1, time)
    }

    /// A line of text for the caller.
    pub fn log(&self, message: &str) {
        if !self.muted.get() {
            self.caller.log(message);
        }
    }

    /// Runs `body`, which makes no progress and logs nothing as far as the caller sees; it can still be ended.
    pub fn muted<R>(&self, body: impl FnOnce() -> R) -> R {
        let outer = self.muted.replace(true);
        let result = body();
        self.muted.set(outer);
        result
    }

    /// All of a phase's progress.
    pub fn whole(&'a self, phase: Phase) -> Part<'a> {
        Part { control: self, phase, from: 0.0, to: 1.0 }
    }

    /// To be called before allocating `bytes` at once that will all be used.
    ///
    /// # Errors
    /// [`Status::MemoryLimit`] if that would be beyond the limit; as [`step`](Self::step).
    pub fn room(&self, bytes: usize) -> Result<(), Error> {
        match self.limits.memory {
            None => Ok(()),
            Some(_) => self.test(self.start.elapsed(), bytes as u64),
        }
    }

    /// What the large tables of the engine hold now, where the system does not tell the memory of the process.
    pub fn tables(&self, bytes: usize) {
        self.memory.tables(bytes as u64);
    }

    /// To be called when there are `count` Steiner points, in a surface with so many segments.
    ///
    /// # Errors
    /// [`Status::SteinerLimit`] if there are more than allowed. Without a limit of the caller these are many times what any model has
    /// needed.
    pub fn steiner(&self, count: u64, segments: usize) -> Result<(), Error> {
        let limit = self.steiner_limit(segments);
        if count <= limit {
            return Ok(());
        }
        let message =
            format_args!("the limit of {limit} Steiner points was reached, more are needed; allow more");
        Err(Error::new(Status::SteinerLimit, message))
    }

    /// How many Steiner points there may be.
    pub fn steiner_limit(&self, segments: usize) -> u64 {
        self.limits.steiner.unwrap_or(100_000 + 100 * segments as u64)
    }

    /// To be called when there are `count` tetrahedra.
    ///
    /// # Errors
    /// [`Status::TetrahedraLimit`] if there are more than the caller allows.
    pub fn tetrahedra(&self, count: usize) -> Result<(), Error> {
        match self.limits.tetrahedra {
            Some(limit) if count as u64 > limit => {
                let phase = self.now.get().map_or("start", |now| now.0.name());
                let message = format_args!(
                    "the limit of {limit} tetrahedra was reached in phase {phase}, more are needed; \
                     allow more, or ask for larger sizes"
                );
                Err(Error::new(Status::TetrahedraLimit, message))
            }
            _ => Ok(()),
        }
    }

    /// How many tetrahedra there may be.
    pub fn tetrahedra_limit(&self) -> Option<u64> {
        self.limits.tetrahedra
    }

    /// Sorts a list, a long one in parts with a look after each: the middle element goes to its place until the parts are short.
    ///
    /// # Errors
    /// As [`step`](Self::step); `OutOfMemory`.
    pub fn sort<T: Ord>(&self, list: &mut [T]) -> Result<(), Error> {
        let halve = |part: &mut [T], middle: usize| {
            part.select_nth_unstable(middle);
        };
        self.sort_parts(list, halve, <[T]>::sort_unstable)
    }

    /// The same by an order in which no two elements are equal.
    ///
    /// # Errors
    /// As [`sort`](Self::sort).
    pub fn sort_by<T>(&self, list: &mut [T], order: impl Fn(&T, &T) -> Order) -> Result<(), Error> {
        let halve = |part: &mut [T], middle: usize| {
            part.select_nth_unstable_by(middle, &order);
        };
        self.sort_parts(list, halve, |part| part.sort_unstable_by(&order))
    }

    fn sort_parts<T>(
        &self,
        list: &mut [T],
        halve: impl Fn(&mut [T], usize),
        sort: impl Fn(&mut [T]),
    ) -> Result<(), Error> {
        if list.len() <= SORTED_AT_ONCE {
            self.look()?;
            sort(list);
            return Ok(());
        }
        // The ends of the parts behind the sorted ones, the last first.
        let mut ends = fallible::reserved(usize::BITS as usize)?;
        fallible::push(&mut ends, list.len())?;
        let mut from = 0;
        while let Some(&end) = ends.last() {
            self.look()?;
            let part = &mut list[from..end];
            if part.len() > SORTED_AT_ONCE {
                let middle = part.len() / 2;
                halve(part, middle);
                fallible::push(&mut ends, from + middle)?;
            } else {
                sort(part);
                from = end;
                ends.pop();
            }
        }
        Ok(())
    }

    /// Calls the observer.
    fn call(&self, phase: Phase, fraction: f64, time: Duration) -> Result<(), Error> {
        self.called.set(time);
        match self.caller.progress(phase, fraction) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => Err(self.end(Status::Cancelled, 0)),
        }
    }

    /// Fails if the run must end, or would have to with `more` bytes.
    fn test(&self, time: Duration, more: u64) -> Result<(), Error> {
        if let Some(status) = self.ended.get() {
            return Err(self.end(status, more));
        }
        let Limits { cancel, time: seconds, memory, .. } = self.limits;
        if cancel.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            return Err(self.end(Status::Cancelled, 0));
        }
        if seconds.is_some_and(|limit| time >= limit) {
            return Err(self.end(Status::TimeLimit, 0));
        }
        if memory.is_some_and(|limit| self.memory.growth(time, more > 0).saturating_add(more) > limit) {
            return Err(self.end(Status::MemoryLimit, more));
        }
        Ok(())
    }

    /// The error for a run that ends for this reason.
    #[cold]
    fn end(&self, status: Status, more: u64) -> Error {
        self.ended.set(Some(status));
        // The next step looks again, and fails, even if nobody heeds this error.
        self.left.set(0);
        let phase = self.now.get().map_or("start", |now| now.0.name());
        let megabytes = |bytes: u64| bytes as f64 / 1e6;
        match status {
            Status::TimeLimit => {
                let limit = self.limits.time.unwrap_or_default().as_secs_f64();
                let message =
                    format_args!("the time limit of {limit} s was reached in phase {phase}; allow more time");
                Error::new(status, message)
            }
            Status::MemoryLimit => {
                let limit = megabytes(self.limits.memory.unwrap_or_default());
                let used = megabytes(self.memory.used());
                let more = megabytes(more);
                let message = format_args!(
                    "the memory limit of {limit:.1} MB was reached in phase {phase}: {used:.1} MB in use, {more:.1} MB needed next; \
                     allow more"
                );
                Error::new(status, message)
            }
            _ => Error::new(status, "cancelled by the caller"),
        }
    }
}

/// The numbers below `count` in blocks, for loops whose turns are much shorter than a step: one step per block.
pub fn blocks(count: usize) -> impl Iterator<Item = Range<usize>> {
    (0..count).step_by(TURNS).map(move |from| from..count.min(from + TURNS))
}

/// The control, and the part of a phase's progress that a piece of work makes.
#[derive(Clone, Copy)]
pub struct Part<'a> {
    control: &'a Control<'a>,
    phase: Phase,
    from: f64,
    to: f64,
}

impl<'a> Part<'a> {
    /// The control.
    pub fn control(self) -> &'a Control<'a> {
        self.control
    }

    /// A part of this part.
    #[must_use]
    pub fn part(self, from: f64, to: f64) -> Self {
        let at = |fraction: f64| self.from + (self.to - self.from) * fraction;
        Part { from: at(from), to: at(to), ..self }
    }

    /// `fraction` of the part is done.
    ///
    /// # Errors
    /// As [`Control::step`].
    pub fn progress(self, fraction: f64) -> Result<(), Error> {
        self.control.progress(self.phase, self.from + (self.to - self.from) * fraction.clamp(0.0, 1.0))
    }
}

impl<'a> Deref for Part<'a> {
    type Target = Control<'a>;

    fn deref(&self) -> &Control<'a> {
        self.control
    }
}

#[cfg(test)]
mod tests;
