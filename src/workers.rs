//! The calling thread and helpers at the same work.
//!
//! The work does not depend on their number, so a thread that cannot be started is no error: fewer do the same work. A panic in one is an
//! error of the run; nothing is printed about it during a call from C. No thread outlives the call: a host may unload the library after it.
use crate::error::Error;
use crate::{panics, threads};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// The time between two calls of `wait`.
const PAUSE: Duration = Duration::from_millis(20);

#[cfg(test)]
thread_local! {
    /// The number of helpers that this thread has started so far.
    pub(crate) static STARTED: std::cell::Cell<usize> = const { std::cell::Cell::new(0) };
}

/// What the helpers report to the calling thread.
#[derive(Default)]
struct Office {
    failure: Mutex<Option<Error>>,
    /// Number of helpers that have ended.
    ended: Mutex<usize>,
    news: Condvar,
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Office {
    fn fail(&self, error: Error) {
        lock(&self.failure).get_or_insert(error);
    }

    /// A helper has ended.
    fn leave(&self) {
        *lock(&self.ended) += 1;
        self.news.notify_one();
    }

    /// Waits a moment for helpers to end; true if all have.
    fn closes(&self, helpers: usize) -> bool {
        let waited = self.news.wait_timeout_while(lock(&self.ended), PAUSE, |ended| *ended < helpers);
        *waited.unwrap_or_else(PoisonError::into_inner).0 == helpers
    }
}

/// Runs `own` on this thread, and at the same time `help` on up to `threads − 1` others; then waits until these have ended, calling `wait`
/// from time to time. `stop` is called at the first failure of any of them, to ask the others to end soon.
pub fn together(
    threads: usize,
    help: &(dyn Fn() -> Result<(), Error> + Sync),
    stop: &(dyn Fn() + Sync),
    own: impl FnOnce() -> Result<(), Error>,
    wait: &mut dyn FnMut() -> Result<(), Error>,
) -> Result<(), Error> {
    if threads <= 1 {
        return own();
    }
    let (office, silent) = (Office::default(), panics::is_silent());
    let outcome = |result: Result<(), Error>| {
        if let Err(error) = result {
            office.fail(error);
            stop();
        }
    };
    let helper = || {
        outcome(panics::work(silent, help).and_then(|result| result));
        office.leave();
    };
    threads::beside(threads - 1, &helper, |helpers| {
        #[cfg(test)]
        STARTED.set(STARTED.get() + helpers);
        outcome(own());
        while !office.closes(helpers) {
            outcome(wait());
        }
    });
    match office.failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
        Some(error) => Err(error),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::error::Status;
    use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

    #[test]
    fn all_take_part_and_the_caller_waits() {
        let (done, waits) = (AtomicUsize::new(0), AtomicUsize::new(0));
        let help = || {
            while waits.load(Ordering::Relaxed) == 0 {
                std::thread::yield_now();
            }
            done.fetch_add(1, Ordering::Relaxed);
            Ok(())
        };
        let mut wait = || {
            waits.fetch_add(1, Ordering::Relaxed);
            Ok(())
        };
        together(4, &help, &|| {}, || Ok(()), &mut wait).unwrap();
        assert_eq!(done.load(Ordering::Relaxed), 3);
        assert!(waits.load(Ordering::Relaxed) > 0);
    }

    #[test]
    fn one_thread_is_the_callers() {
        let here = std::thread::current().id();
        let own = || {
            assert_eq!(std::thread::current().id(), here);
            Ok(())
        };
        let help = || -> Result<(), Error> { unreachable!() };
        together(1, &help, &|| {}, own, &mut || Ok(())).unwrap();
    }

    #[test]
    fn a_panic_of_a_helper_stops_all_and_is_an_error() {
        let stopped = AtomicBool::new(false);
        let own = || {
            while !stopped.load(Ordering::Relaxed) {
                std::thread::yield_now();
            }
            Ok(())
        };
        let result = panics::catch_silently(|| {
            together(
                3,
                &|| panic!("helper {} fell", 7),
                &|| stopped.store(true, Ordering::Relaxed),
                own,
                &mut || Ok(()),
            )
        });
        let error = result.unwrap().unwrap_err();
        assert_eq!(error.status, Status::Internal);
        assert!(error.message.contains("helper 7 fell"), "{error}");
    }

    #[test]
    fn an_error_while_waiting_stops_the_helpers() {
        let stopped = AtomicBool::new(false);
        let help = || {
            while !stopped.load(Ordering::Relaxed) {
                std::thread::yield_now();
            }
            Ok(())
        };
        let mut wait = || Err(Error::new(Status::Cancelled, "enough"));
        let stop = || stopped.store(true, Ordering::Relaxed);
        let error = together(3, &help, &stop, || Ok(()), &mut wait).unwrap_err();
        assert_eq!(error.status, Status::Cancelled);
    }
}
