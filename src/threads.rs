//! Threads that help the calling one.
//!
//! The standard library aborts the process if memory runs out while it starts a thread, or as the thread begins; so on Unix the threads
//! are the system's. A thread that cannot be started is missing, nothing else.
//!
//! Invariant: no helper outlives the call that started it, even if that call unwinds.
#![allow(unsafe_code)]
use crate::fallible;

/// Runs `help`, which must not panic, on up to `count` other threads, and at the same time `own` on this one, which is given their number.
/// Returns when all have ended.
pub fn beside<R>(count: usize, help: &(dyn Fn() + Sync), own: impl FnOnce(usize) -> R) -> R {
    let mut helpers = Helpers(fallible::reserved(count).unwrap_or_default());
    while helpers.0.len() < count.min(helpers.0.capacity()) {
        // SAFETY: `helpers` joins the thread before `help` ends, and nothing forgets it.
        let Some(thread) = (unsafe { system::start(&help) }) else { break };
        #[expect(clippy::disallowed_methods, reason = "there is room")]
        helpers.0.push(thread);
    }
    own(helpers.0.len())
}

/// Threads that are joined when this is dropped.
struct Helpers(Vec<system::Thread>);

impl Drop for Helpers {
    fn drop(&mut self) {
        self.0.drain(..).for_each(system::join);
    }
}

#[cfg(unix)]
mod system {
    use std::mem::MaybeUninit;
    use std::ptr::{from_ref, null_mut};

    /// As much as the standard library gives its threads.
    const STACK: usize = 2 << 20;

    pub(super) type Thread = libc::pthread_t;

    extern "C" fn run(help: *mut libc::c_void) -> *mut libc::c_void {
        // SAFETY: `start` has passed the address of such a reference, which is alive until the thread is joined.
        let help = unsafe { *help.cast::<&(dyn Fn() + Sync)>() };
        help();
        null_mut()
    }

    /// Starts a thread that runs `help`, if possible.
    ///
    /// # Safety
    /// The thread is joined before the borrow of the reference ends.
    pub(super) unsafe fn start(help: &&(dyn Fn() + Sync)) -> Option<Thread> {
        let (mut thread, mut attributes) = (MaybeUninit::uninit(), MaybeUninit::uninit());
        // SAFETY: both are valid for writes; the attributes are used only once they are set, and the thread only once it is started.
        unsafe {
            if libc::pthread_attr_init(attributes.as_mut_ptr()) != 0 {
                return None;
            }
            // If this fails, the stack has the system's usual size.
            libc::pthread_attr_setstacksize(attributes.as_mut_ptr(), STACK);
            let data = from_ref(help).cast_mut().cast();
            let status = libc::pthread_create(thread.as_mut_ptr(), attributes.as_ptr(), run, data);
            libc::pthread_attr_destroy(attributes.as_mut_ptr());
            (status == 0).then(|| thread.assume_init())
        }
    }

    /// Waits for the end of a thread.
    pub(super) fn join(thread: Thread) {
        // SAFETY: `start` has made it, and it is joined once.
        unsafe { libc::pthread_join(thread, null_mut()) };
    }
}

#[cfg(not(unix))]
mod system {
    pub(super) type Thread = std::thread::JoinHandle<()>;

    /// Starts a thread that runs `help`, if possible.
    ///
    /// # Safety
    /// The thread is joined before the borrow of the reference ends.
    pub(super) unsafe fn start(help: &&(dyn Fn() + Sync)) -> Option<Thread> {
        // SAFETY: the caller promises that the thread ends before what it borrows.
        unsafe { std::thread::Builder::new().spawn_unchecked(*help) }.ok()
    }

    /// Waits for the end of a thread.
    pub(super) fn join(thread: Thread) {
        drop(thread.join());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn all_run_at_the_same_time_and_end_before_the_call() {
        let (inside, ended) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let help = || {
            inside.fetch_add(1, Ordering::SeqCst);
            while inside.load(Ordering::SeqCst) < 4 {
                std::thread::yield_now();
            }
            ended.fetch_add(1, Ordering::SeqCst);
        };
        let count = beside(3, &help, |count| {
            assert_eq!(count, 3);
            inside.fetch_add(1, Ordering::SeqCst);
            count
        });
        assert_eq!((count, ended.load(Ordering::SeqCst)), (3, 3));
        assert_eq!(beside(0, &|| unreachable!(), |count| count), 0);
    }

    #[test]
    fn a_panic_waits_for_the_helpers() {
        let (begun, ended) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let help = || {
            begun.fetch_add(1, Ordering::SeqCst);
            std::thread::sleep(std::time::Duration::from_millis(50));
            ended.fetch_add(1, Ordering::SeqCst);
        };
        let caught = crate::panics::catch_silently(|| {
            beside(2, &help, |_| {
                while begun.load(Ordering::SeqCst) < 2 {
                    std::thread::yield_now();
                }
                panic!("while helpers work");
            })
        });
        assert!(caught.is_err());
        assert_eq!(ended.load(Ordering::SeqCst), 2);
    }
}
