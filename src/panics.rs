//! Panics, which are bugs of ours: they become an error of the run, and during calls from C nothing is printed about them.
//!
//! A panic is reported by a hook that the whole process shares, on the thread that panics. So a thread says whether it works for
//! a call from C; workers inherit that from the thread that starts them.
use crate::error::Error;
use crate::fallible;
use std::cell::{Cell, RefCell};
use std::panic::{catch_unwind, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Once, OnceLock};

#[cfg(panic = "abort")]
compile_error!("delotet turns panics into a status: build it with panic = \"unwind\"");

thread_local! {
    /// This thread works for a call from C: the hook stays silent and keeps the text.
    static SILENT: Cell<bool> = const { Cell::new(false) };
    static TEXT: RefCell<String> = const { RefCell::new(String::new()) };
}

type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Send + Sync + 'static>;

static INSTALL: Once = Once::new();
/// The hook that was there before ours.
static PREVIOUS: OnceLock<Hook> = OnceLock::new();

/// Keeps the text of panics in silent threads and passes on all others.
fn hook(info: &PanicHookInfo<'_>) {
    if SILENT.try_with(Cell::get).unwrap_or(false) {
        let text = fallible::text(format_args!("{info}")).unwrap_or_default();
        let _ = TEXT.try_with(|slot| slot.try_borrow_mut().map(|mut slot| *slot = text));
    } else if let Some(previous) = PREVIOUS.get() {
        previous(info);
    }
}

/// Whether this thread is silent: for [`work`].
pub fn is_silent() -> bool {
    SILENT.try_with(Cell::get).unwrap_or(false)
}

/// Runs `body`; a panic in it becomes an error with its text. Nothing is printed about it.
pub fn catch_silently<R>(body: impl FnOnce() -> R) -> Result<R, Error> {
    // Neither box takes memory: a function has no size.
    INSTALL.call_once(|| {
        let _ = PREVIOUS.set(std::panic::take_hook());
        std::panic::set_hook(Box::new(hook));
    });
    work(true, body)
}

/// Runs `body` on a thread that is silent or not; a panic in it becomes an error with its text, where that is known.
pub fn work<R>(silent: bool, body: impl FnOnce() -> R) -> Result<R, Error> {
    let outer = SILENT.replace(silent);
    let result = catch_unwind(AssertUnwindSafe(body));
    SILENT.set(outer);
    result.map_err(|payload| {
        // Dropping a payload may run arbitrary code; ours are strings, but nothing may unwind from here.
        std::mem::forget(payload);
        let text = match silent {
            true => TEXT.with(|slot| std::mem::take(&mut *slot.borrow_mut())),
            false => String::new(),
        };
        // One line: it goes into a message.
        let mut lines = text.lines();
        let (first, rest) = (lines.next().unwrap_or("a panic"), lines.next().unwrap_or_default());
        Error::internal(format_args!("internal error, please report it: {first} {rest}"))
    })
}
