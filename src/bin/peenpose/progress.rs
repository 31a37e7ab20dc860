//! The progress bar: on a terminal only.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{Builder, sleep};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use peenpose::chart::Step;
use peenpose::digits::significant;
use peenpose::solve::Progress;

use crate::output;

/// Exit status of a run that was ended before it had all that was asked for, or before that was written,
/// as shells have it.
pub const ENDED: u8 = 130;

/// Signals that come this soon after the first ask for nothing new: `timeout` and process managers send
/// theirs to the program and to its group.
const SAME_REQUEST: Duration = Duration::from_millis(500);

/// What comes after the search has so long once the user asks for an end.
const GRACE: Duration = Duration::from_millis(400);

/// Shows how far a search is, and notices Ctrl-C.
pub struct Watcher {
    bar: ProgressBar,
    /// Set when the user asks for an end.
    pub stop: Arc<AtomicBool>,
    /// Set a moment later: what makes an answer complete has so long.
    pub late: Arc<AtomicBool>,
    is_writing: Arc<AtomicBool>,
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
        bar.enable_steady_tick(Duration::from_millis(100));
        let stop = Arc::new(AtomicBool::new(false));
        let is_writing = Arc::new(AtomicBool::new(false));
        let (asked, found) = (Arc::clone(&stop), Arc::clone(&is_writing));
        let late = Arc::new(AtomicBool::new(false));
        let grace_is_over = Arc::clone(&late);
        let mut first: Option<Instant> = None;
        let handler = ctrlc::set_handler(move || {
            asked.store(true, Ordering::SeqCst);
            match first {
                None => {
                    first = Some(Instant::now());
                    let late = Arc::clone(&grace_is_over);
                    let wait = move || {
                        sleep(GRACE);
                        late.store(true, Ordering::SeqCst);
                    };
                    if Builder::new().spawn(wait).is_err() {
                        grace_is_over.store(true, Ordering::SeqCst);
                    }
                }
                Some(first) if first.elapsed() < SAME_REQUEST => return,
                // Whoever asks twice does not want to wait for the best answer so far.
                Some(_) => {
                    output::note("ended at once: not everything has been written");
                    std::process::exit(ENDED.into());
                }
            }
            if found.load(Ordering::SeqCst) {
                output::note("the answer is found and being written; once more ends at once");
            }
        });
        if let Err(error) = handler {
            bar.println(format!(
                "warning: Ctrl-C will end the run without an answer: {error}"
            ));
        }
        Self {
            bar,
            stop,
            late,
            is_writing,
        }
    }

    /// Takes a step of the search to the bar.
    pub fn show(&self, progress: Progress) {
        self.bar.set_message(match progress.best {
            Some(best) => format!(
                "{} poses, best J so far {}",
                progress.poses,
                significant(best, 4)
            ),
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

    /// Takes the bar away when the answer is found: Ctrl-C lets it be written, asked twice it ends
    /// the program at once.
    pub fn finish(&self) {
        self.is_writing.store(true, Ordering::SeqCst);
        self.bar.finish_and_clear();
    }

    /// Takes the drawing of a map to the bar.
    pub fn show_drawing(&self) {
        self.bar.set_message("drawing the map");
    }
}
