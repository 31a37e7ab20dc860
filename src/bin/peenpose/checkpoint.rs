//! `--checkpoint`: work that is kept from run to run.

use std::path::Path;

use peenpose::checkpoint::Checkpoint;
use peenpose::scenario::Scenario;

use crate::output;

/// Opens the checkpoint in a folder, where one was asked for.
pub fn open(folder: Option<&Path>, scenario: &Scenario) -> Result<Option<Checkpoint>, String> {
    let opened = folder.map(|folder| Checkpoint::open(folder, scenario));
    let opened = opened.transpose();
    opened.map_err(|trouble| format!("--checkpoint: {trouble}"))
}

/// Writes the rest of it and tells how much of the work was there before; what cannot be kept is no
/// reason to give no answer.
pub fn close(checkpoint: Option<&Checkpoint>, is_quiet: bool) {
    let Some(checkpoint) = checkpoint else {
        return;
    };
    if let Err(trouble) = checkpoint.finish() {
        output::warn(&format!("--checkpoint: {trouble}"));
    }
    let recalled = checkpoint.recalled();
    if recalled > 0 && !is_quiet {
        let all = recalled + checkpoint.added();
        output::note(&format!(
            "{recalled} of {all} pieces of work were in the checkpoint"
        ));
    }
}
