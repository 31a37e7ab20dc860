//! The trade-off between target error, tangential risk and rebound.

use super::setting::SETTINGS;
use crate::elementary::whole_power;
use crate::record::{FrontRecord, Record};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{Scale, decimals_for, fixed};

/// A row for each answer of the front; nothing when none was asked for.
pub fn block(record: &Record) -> Option<Block> {
    let front = &record.front;
    if front.is_empty() {
        return None;
    }
    let mut table = Table::new(&[
        ("TRADE-OFF", Align::Left),
        ("", Align::Left),
        ("incid. deg", Align::Right),
        ("az. deg", Align::Right),
        ("standoff mm", Align::Right),
        ("m/s", Align::Right),
        ("target", Align::Right),
        ("tangential", Align::Right),
        ("rebound", Align::Right),
    ]);
    for (number, point) in (1..).zip(front) {
        let mark = if point.recommended { " *" } else { "" };
        let mut cells = vec![
            format!("{number} {}{mark}", point.contact),
            match point.fails.len() {
                0 => "PASS".into(),
                fails => format!("FAIL {fails}"),
            },
        ];
        cells.extend(SETTINGS[..4].iter().map(|it| it.text(&point.settings)));
        cells.extend(point.objectives().map(with_error));
        table.row(cells);
    }
    let mut block = Block::default();
    block.table(table);
    for sentence in sentences(front) {
        block.paragraph(&sentence);
    }
    Some(block)
}

/// A value whose last digit is uncertain by what stands in brackets: `0.004646(4)`; four digits where
/// all of them are certain.
fn with_error((value, error): (f64, f64)) -> String {
    let decimals = decimals_for(error, 1);
    if error <= 0.5e-3 * value.abs() || decimals > 8 {
        return Scale::for_error(value, 0.0).text(value);
    }
    let digits = (error * whole_power(10.0, decimals as i32)).round();
    format!("{}({})", fixed(value, decimals), fixed(digits, 0))
}

fn sentences(front: &[FrontRecord]) -> Vec<String> {
    let explanation = "Parts of J with their weights; target is normal_impulse and miss \
                       together. In brackets: standard error of the last digit, where that is uncertain. * the recommended \
                       settings.";
    let finding = if front.len() == 1 {
        "There is nothing to trade: no other settings are better in any of the three by more than \
         the standard errors."
            .into()
    } else {
        format!(
            "Of these {} settings none is better than another in all three.",
            front.len()
        )
    };
    vec![finding, explanation.into()]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_stand_behind_the_digits_that_they_touch() {
        assert_eq!(with_error((0.004_645_5, 0.000_004_2)), "0.004646(4)");
        assert_eq!(with_error((0.491_004, 0.000_02)), "0.4910");
        assert_eq!(with_error((0.31, 0.012)), "0.31(1)");
        assert_eq!(with_error((0.0, 0.0)), "0");
        assert_eq!(with_error((0.25, 0.0)), "0.2500");
    }
}
