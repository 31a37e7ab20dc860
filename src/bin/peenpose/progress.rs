//! The progress bar: on a terminal only.

use std::borrow::Cow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{Builder, sleep};
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use peenpose::control::{Cancel, Control, Progress};
use peenpose::digits::significant;

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
    /// Set when the user asks for an end, and once more a moment later: what makes an answer complete
    /// has so long.
    cancel: Cancel,
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
        let cancel = Cancel::default();
        let is_writing = Arc::new(AtomicBool::new(false));
        let (asked, found) = (cancel.clone(), Arc::clone(&is_writing));
        let mut first: Option<Instant> = None;
        let handler = ctrlc::set_handler(move || {
            asked.end();
            match first {
                None => {
                    first = Some(Instant::now());
                    let late = asked.clone();
                    let wait = move || {
                        sleep(GRACE);
                        late.hurry();
                    };
                    if Builder::new().spawn(wait).is_err() {
                        asked.hurry();
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
            cancel,
            is_writing,
        }
    }

    /// What runs are watched and ended by.
    pub fn control(&self) -> Control {
        let bar = self.bar.clone();
        Control {
            cancel: self.cancel.clone(),
            observer: Some(Arc::new(move |progress| bar.set_message(message(progress)))),
            ..Control::default()
        }
    }

    /// Takes the bar away when the answer is found: Ctrl-C lets it be written, asked twice it ends
    /// the program at once.
    pub fn finish(&self) {
        self.is_writing.store(true, Ordering::SeqCst);
        self.bar.finish_and_clear();
    }

    /// Shows something else.
    pub fn say(&self, message: impl Into<Cow<'static, str>>) {
        self.bar.set_message(message);
    }
}

fn message(progress: Progress) -> String {
    match progress {
        Progress::Search {
            poses,
            best: Some(best),
        } => format!("{poses} poses, best J so far {}", significant(best, 4)),
        Progress::Search { poses, best: None } => {
            format!("{poses} poses, the nozzle has fitted nowhere yet")
        }
        Progress::Step { name, of: 1, .. } => name,
        Progress::Step { name, number, of } => format!("{name}, {} of {of}", number + 1),
    }
}
