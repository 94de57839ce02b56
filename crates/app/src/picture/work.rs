//! Long work: how far it is, and whether the user has stopped it.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{ProgressBar, ProgressStyle};

use crate::failure::Failure;

/// Steps done of steps to do, shared with whoever watches. Clones are one and the same work.
#[derive(Clone, Debug)]
pub struct Work {
    bar: ProgressBar,
    stopped: Arc<AtomicBool>,
}

impl Default for Work {
    fn default() -> Work {
        Work { bar: ProgressBar::hidden(), stopped: Arc::default() }
    }
}

impl Work {
    /// Work that shows a bar on standard error if that is a terminal, and that Ctrl+C stops between two steps.
    pub fn on_terminal() -> Work {
        let work = Work { bar: ProgressBar::new(0), stopped: Arc::default() };
        let style = ProgressStyle::with_template("{msg} {bar:32} {pos}/{len}  {eta} left");
        if let Ok(style) = style {
            work.bar.set_style(style);
        }
        let stopped = work.stopped.clone();
        // Where signals can't be watched, Ctrl+C ends the program at once, as it does without this.
        let _ = ctrlc::set_handler(move || {
            // Asked twice, it doesn't wait for the step to end.
            if stopped.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        work
    }

    /// So many steps are to be done, of what.
    pub fn begin(&self, steps: u64, what: &'static str) {
        self.bar.set_length(steps);
        self.bar.set_position(0);
        self.bar.set_message(what);
    }

    /// One step is done.
    ///
    /// # Errors
    /// The user has stopped the work.
    pub fn step(&self) -> Result<(), Failure> {
        self.advance(1)
    }

    /// So many steps are done.
    ///
    /// # Errors
    /// The user has stopped the work.
    pub fn advance(&self, steps: u64) -> Result<(), Failure> {
        self.bar.inc(steps);
        self.check()
    }

    /// Nothing is done, but the user may have stopped the work.
    ///
    /// # Errors
    /// The user has.
    pub fn check(&self) -> Result<(), Failure> {
        if self.stopped.load(Ordering::Relaxed) { Err(Failure::Stopped) } else { Ok(()) }
    }

    /// The bar goes away.
    pub fn end(&self) {
        self.bar.finish_and_clear();
    }

    /// Asks the work to stop.
    pub fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// What part is done, 0 to 1; 0 before it is known how much there is.
    pub fn share(&self) -> f32 {
        match self.bar.length() {
            Some(length) if length > 0 => (self.bar.position() as f32 / length as f32).min(1.0),
            _ => 0.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_clone_tells_how_far_it_is_and_stops_it() {
        let work = Work::default();
        let watch = work.clone();
        assert_eq!(watch.share(), 0.0);
        work.begin(4, "frames");
        assert_eq!(work.step(), Ok(()));
        assert_eq!(watch.share(), 0.25);
        watch.stop();
        assert_eq!(work.step(), Err(Failure::Stopped));
    }
}
