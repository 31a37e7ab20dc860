//! The progress bar: on a terminal only.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use indicatif::{ProgressBar, ProgressStyle};
use peenpose::chart::Step;
use peenpose::solve::Progress;

/// Shows how far a search is, and notices Ctrl-C.
pub struct Watcher {
    bar: ProgressBar,
    /// Set when the user asks for an end.
    pub stop: Arc<AtomicBool>,
}

impl Watcher {
    /// A watcher; `quiet` hides the bar even on a terminal.
    pub fn new(quiet: bool) -> Self {
        let bar = if quiet {
            ProgressBar::hidden()
        } else {
            ProgressBar::new_spinner()
        };
        if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} [{elapsed}]") {
            bar.set_style(style);
        }
        bar.set_message("screening");
        bar.enable_steady_tick(std::time::Duration::from_millis(100));
        let stop = Arc::new(AtomicBool::new(false));
        let flag = Arc::clone(&stop);
        let handler = ctrlc::set_handler(move || {
            // Whoever asks twice does not want to wait for the best answer so far.
            if flag.swap(true, Ordering::Relaxed) {
                std::process::exit(130);
            }
        });
        if let Err(error) = handler {
            bar.println(format!(
                "warning: Ctrl-C will end the run without an answer: {error}"
            ));
        }
        Self { bar, stop }
    }

    /// Takes a step of the search to the bar.
    pub fn show(&self, progress: Progress) {
        self.bar.set_message(match progress.best {
            Some(best) => format!("{} poses, best J so far {best:.6}", progress.poses),
            None => format!(
                "{} poses, the nozzle has fitted nowhere yet",
                progress.poses
            ),
        });
    }

    /// Takes a step of a chart to the bar.
    pub fn show_step(&self, step: Step) {
        self.bar.set_message(match step.of {
            1 => step.name,
            of => format!("{}, {} of {of}", step.name, step.number + 1),
        });
    }

    /// Takes the bar away. From here on Ctrl-C ends the program at once.
    pub fn finish(&self) {
        self.stop.store(true, Ordering::Relaxed);
        self.bar.finish_and_clear();
    }
}
