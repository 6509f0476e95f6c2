//! Ctrl-C and the progress bar.
use delotet::{CancelToken, Observer, Phase};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::ops::ControlFlow;

/// Shows progress on a terminal and cancels its token on Ctrl-C.
pub struct Console {
    token: CancelToken,
    bar: ProgressBar,
    phase: Option<Phase>,
}

const STEPS: u64 = 1000;

impl Console {
    /// Shows nothing with `quiet`, or if stderr is not a terminal.
    pub fn new(quiet: bool) -> Self {
        let token = CancelToken::new();
        let interrupted = token.clone();
        // Without a handler Ctrl-C ends the program at once, which is also fine.
        let _ = ctrlc::set_handler(move || interrupted.cancel());
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(20) };
        let bar = ProgressBar::with_draw_target(Some(STEPS), target);
        if let Ok(style) = ProgressStyle::with_template("{msg:10} {bar:40} {percent:>3} % {elapsed:>4}") {
            bar.set_style(style);
        }
        Console { token, bar, phase: None }
    }

    /// Cancelled by Ctrl-C.
    pub fn token(&self) -> CancelToken {
        self.token.clone()
    }

    /// Removes the bar.
    pub fn finish(&self) {
        self.bar.finish_and_clear();
    }
}

impl Observer for Console {
    fn progress(&mut self, phase: Phase, fraction: f64) -> ControlFlow<()> {
        if self.phase != Some(phase) {
            self.phase = Some(phase);
            self.bar.set_message(phase.name());
        }
        self.bar.set_position((fraction * STEPS as f64) as u64);
        ControlFlow::Continue(())
    }
}

impl Drop for Console {
    fn drop(&mut self) {
        self.finish();
    }
}
