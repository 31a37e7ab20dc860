//! Complaints of the YAML crate in the words of this program.

use serde_saphyr::budget::BudgetBreach;
use serde_saphyr::{Error, MessageFormatter, UserMessageFormatter};

use super::span;
use crate::problem::fault::{Fault, Span};
use crate::problem::fault_code::FaultCode;
use crate::units::{Dimension, parse, parse_number, shortened};

/// The YAML crate's complaint in the words of this program.
pub(super) fn explain(text: &str, error: &Error) -> Fault {
    let file = |rule: FaultCode, message: &str| Fault::at_key(rule, "", message);
    let mut cause = error.without_snippet();
    while let Error::AliasError { error, .. } = cause {
        cause = error;
    }
    let mut fault = match cause {
        Error::MergeKeyNotAllowed { .. } => file(FaultCode::MergeKey, "`<<` is not supported")
            .expecting("the keys themselves, or an alias as a value"),
        Error::MultipleDocuments { .. } => {
            file(FaultCode::SecondDocument, "a second document starts here")
                .expecting("one problem in a file")
        }
        Error::Budget {
            breach: BudgetBreach::Documents { .. },
            ..
        } => file(FaultCode::SecondDocument, "a second document starts here")
            .expecting("one problem in a file"),
        Error::Budget {
            breach: BudgetBreach::Depth { .. },
            ..
        } => too_deep(),
        Error::Budget { .. }
        | Error::AliasReplayCounterOverflow { .. }
        | Error::AliasReplayLimitExceeded { .. }
        | Error::AliasExpansionLimitExceeded { .. }
        | Error::AliasReplayStackDepthExceeded { .. } => file(
            FaultCode::TooManyValues,
            "the file, with its aliases written out, is too large for a problem file",
        ),
        Error::RecursiveReferencesRequireWeakTypes { .. } => {
            file(FaultCode::AliasOfItself, "an alias contains itself")
        }
        Error::UnknownAnchor { .. } => file(
            FaultCode::UnknownAlias,
            "this alias has no anchor before it",
        )
        .expecting("`&name` at the value that `*name` repeats, or quotes round a text with `*`"),
        Error::UnsupportedTag { tag, .. } => {
            let message = format!("the tag `{}` means nothing here", shortened(tag));
            file(FaultCode::UnknownTag, &message).expecting("the value alone")
        }
        Error::NullIntoString { .. } => key_not_a_name(),
        other => explain_syntax(&UserMessageFormatter.format_message(other)),
    };
    fault.at = error.location().map(|location| span(text, location));
    let unit = (fault.rule == FaultCode::NotYaml).then(|| unit_behind_list(text, fault.at?));
    unit.flatten().unwrap_or(fault)
}

/// The fault of a unit that stands behind a list, as in `[-90, 90] deg`, where the crate complains
/// about that line or the next.
fn unit_behind_list(text: &str, at: Span) -> Option<Fault> {
    let line_of = |number: usize| text.lines().nth(number.checked_sub(1)?);
    [at.line, at.line.saturating_sub(1)]
        .into_iter()
        .find_map(|number| {
            let line = line_of(number)?;
            let (start, end) = (line.find('[')?, line.find(']')?);
            let list = line.get(start + 1..end)?;
            let rest = &line[end + 1..];
            let unit = rest.split('#').next()?.split([',', '}']).next()?.trim();
            let are_numbers = list.split(',').all(|item| parse_number(item).is_some());
            let is_unit = |dimension: Dimension| parse(dimension, &format!("1 {unit}")).is_ok();
            if !are_numbers || !Dimension::ALL.into_iter().any(is_unit) {
                return None;
            }
            let items: Vec<String> = list
                .split(',')
                .map(|item| format!("{} {unit}", item.trim()))
                .collect();
            let message = format!("units belong to each number: [{}]", items.join(", "));
            let mut fault = Fault::at_key(FaultCode::NotYaml, "", message);
            let from = line.len() - rest.trim_start().len();
            let before = text.split_inclusive('\n').take(number - 1);
            let line_start: usize = before.map(str::len).sum();
            fault.at = Some(Span {
                line: number,
                column: line[..from].chars().count() + 1,
                start: line_start + from,
                end: line_start + from + unit.len(),
            });
            Some(fault)
        })
}

/// A complaint about the syntax alone, for people who write YAML twice a year.
fn explain_syntax(message: &str) -> Fault {
    if message.starts_with("tabs disallowed") {
        let fault = Fault::at_key(
            FaultCode::Tab,
            "",
            "not valid YAML: a tab is used to indent",
        );
        return fault.expecting("spaces");
    }
    if message.starts_with("recursion limit") {
        return too_deep();
    }
    if message.starts_with("expected string scalar") {
        return key_not_a_name();
    }
    // The YAML crate quotes a character as `x', and a control character as `\u{7}'.
    if let Some(character) = message.strip_prefix("unexpected character: `") {
        let character = character.trim_end_matches('\'');
        let message = format!("not valid YAML: the character `{character}` cannot stand here");
        let expected = match character.chars().count() {
            1 => "quotes round a text with it",
            _ => "a text without control characters",
        };
        return Fault::at_key(FaultCode::NotYaml, "", message).expecting(expected);
    }
    let known = [
        (
            "mapping values are not allowed",
            "a `:` stands where no key can be",
            "quotes round a text with `: ` in it, and a space after the `:` of every key",
        ),
        (
            "while parsing a block mapping",
            "this line does not continue the group above it",
            "the same indentation for every key of a group",
        ),
        (
            "while parsing a flow mapping",
            "a `,` or a `}` is missing before this",
            "`{ key: value, key: value }`",
        ),
        (
            "invalid indentation in multiline quoted scalar",
            "a text in quotes does not end in its line",
            "the same quote at its end",
        ),
    ];
    let found = known.iter().find(|(start, ..)| message.starts_with(start));
    let plain = found.map_or(message, |(_, plain, _)| plain);
    let mut fault = Fault::at_key(FaultCode::NotYaml, "", format!("not valid YAML: {plain}"));
    fault.expected = found.map(|(.., remedy)| (*remedy).to_owned());
    fault
}

fn key_not_a_name() -> Fault {
    let message = "not valid YAML here: a key must be a plain name";
    Fault::at_key(FaultCode::KeyNotAName, "", message)
}

fn too_deep() -> Fault {
    Fault::at_key(FaultCode::NestedTooDeeply, "", "nested too deeply")
        .expecting("at most 24 levels")
}
