//! Panics, which are bugs in the library: they become an error of the run, and during calls from C nothing is printed about them.
//!
//! A panic is reported by a hook shared by the whole process, on the panicking thread. So each thread records whether it works for a call
//! from C; worker threads inherit this from the thread that starts them.
use crate::error::Error;
use crate::fallible;
use std::cell::{Cell, RefCell};
use std::panic::{catch_unwind, AssertUnwindSafe, PanicHookInfo};
use std::sync::{Once, OnceLock};

#[cfg(panic = "abort")]
compile_error!("delotet turns panics into a status: build it with panic = \"unwind\"");

thread_local! {
    /// Whether this thread works for a call from C: the hook then stays silent and keeps the text.
    static SILENT: Cell<bool> = const { Cell::new(false) };
    static TEXT: RefCell<String> = const { RefCell::new(String::new()) };
}

type Hook = Box<dyn Fn(&PanicHookInfo<'_>) + Send + Sync + 'static>;

static INSTALL: Once = Once::new();
/// The previously installed hook.
static PREVIOUS: OnceLock<Hook> = OnceLock::new();

/// Keeps the text of panics in silent threads and passes all others on to the previous hook.
fn hook(info: &PanicHookInfo<'_>) {
    if SILENT.try_with(Cell::get).unwrap_or(false) {
        let text = fallible::text(format_args!("{info}")).unwrap_or_default();
        let _ = TEXT.try_with(|slot| slot.try_borrow_mut().map(|mut slot| *slot = text));
    } else if let Some(previous) = PREVIOUS.get() {
        previous(info);
    }
}

/// Whether this thread is silent; pass it to [`work`].
pub fn is_silent() -> bool {
    SILENT.try_with(Cell::get).unwrap_or(false)
}

/// Runs `body`; a panic in it becomes an error with its text. Nothing is printed about it.
pub fn catch_silently<R>(body: impl FnOnce() -> R) -> Result<R, Error> {
    INSTALL.call_once(|| {
        let _ = PREVIOUS.set(std::panic::take_hook());
        #[expect(clippy::disallowed_methods, reason = "a function has no size, so its box takes no memory")]
        std::panic::set_hook(Box::new(hook));
    });
    work(true, body)
}

/// Runs `body` on a thread that is silent or not; a panic in it becomes an error with its text, if known.
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
        // One line, since it becomes part of a message.
        let mut lines = text.lines();
        let (first, rest) = (lines.next().unwrap_or("a panic"), lines.next().unwrap_or_default());
        Error::internal(format_args!("internal error, please report it: {first} {rest}"))
    })
}
