//! The end of the sheet: what was left out, how to get it again, what it cost.

use crate::record::{Record, StatusRecord};
use crate::report::layout::{Block, WIDTH};
use crate::report::number::{count, fixed, plural};
use crate::validity::STRONG_INTERFERENCE;

/// The notes on validity, but for the one that stands in the head.
pub fn validity(record: &Record) -> Option<Block> {
    let notes = record.notes.iter();
    let mut notes = notes
        .filter(|note| note.name != STRONG_INTERFERENCE)
        .peekable();
    notes.peek()?;
    let mut block = Block::titled("VALIDITY");
    for note in notes {
        block.hanging("- ", &note.text);
    }
    Some(block)
}

/// The command that gives the same figures, and what it depends on.
pub fn reproduce(record: &Record) -> Block {
    let mut block = Block::titled("REPRODUCE");
    for line in command_lines(&record.command, WIDTH - 2) {
        block.verbatim(&line);
    }
    block.verbatim(&format!("problem sha256  {}", record.problem_sha256));
    block.verbatim(&format!(
        "peenpose        {}, seed {}",
        record.version, record.problem.seed
    ));
    block
}

/// Breaks a command before an option, the way a shell reads it. What has no option to break at
/// stays whole, however long: a command must work when it is copied.
fn command_lines(command: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let mut line = String::new();
    for (index, part) in command.split(" --").enumerate() {
        let part = if index == 0 {
            part.to_owned()
        } else {
            format!(" --{part}")
        };
        // Room for ` \` at the end.
        if !line.is_empty() && line.chars().count() + part.chars().count() + 2 > width {
            lines.push(format!("{line} \\"));
            line = format!("   {part}");
        } else {
            line += &part;
        }
    }
    lines.push(line);
    lines
}

/// Work done; wall time stands alone on the last line, so that sheets can be compared without it.
pub fn work(record: &Record) -> Block {
    let work = &record.work;
    let mut block = Block::titled("WORK");
    if record.status == StatusRecord::Evaluated {
        block.paragraph(&format!(
            "{}, {}",
            plural(work.shots_per_pose, "shot"),
            plural(work.rays, "ray")
        ));
    } else {
        block.paragraph(&format!(
            "{} tried, at the end with {} each; {}",
            plural(work.poses, "pose"),
            plural(work.shots_per_pose, "shot"),
            plural(work.rays, "ray"),
        ));
        if record.best.shots > 0 {
            block.paragraph(&format!(
                "figures from {}, which the search had not seen",
                plural(record.best.shots, "validation shot")
            ));
        }
        if record.best.rim_shots > 0 {
            block.paragraph(&format!(
                "J also from {} drawn where violations come from, with their importance weights",
                count(record.best.rim_shots)
            ));
        }
    }
    block.paragraph(&format!("wall time {} s", fixed(work.seconds, 2)));
    block
}

#[cfg(test)]
mod tests {
    use super::command_lines;

    #[test]
    fn commands_are_broken_where_a_shell_can_join_them() {
        let command = "peenpose evaluate a.yaml --set speed=1m/s --seed 1";
        let lines = command_lines(command, 40);
        assert_eq!(
            lines,
            [
                "peenpose evaluate a.yaml \\",
                "    --set speed=1m/s --seed 1"
            ]
        );
        assert_eq!(command_lines(command, 90), [command]);
    }
}
