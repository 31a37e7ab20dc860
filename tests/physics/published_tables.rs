//! V1: the tables of Zohdi's paper, as published and as they should be.

use peenpose::impact::zohdi::{self, Row};
use peenpose::impact::{Law, Regime};

/// A printed number, and half a unit of its last digit.
struct Printed {
    value: f64,
    half_unit: f64,
}

impl Printed {
    fn read(text: &str) -> Self {
        let digits = text.split_once('.').map_or(0, |(_, digits)| digits.len());
        Self {
            value: text.parse().unwrap(),
            half_unit: 0.5 * 0.1_f64.powi(digits as i32),
        }
    }

    fn agrees(&self, value: f64) -> bool {
        // The slightest more for the binary form of the printed number.
        (value - self.value).abs() <= self.half_unit * (1.0 + 1e-9)
    }
}

fn printed_rows(text: &str) -> Vec<Vec<Printed>> {
    text.lines()
        .filter(|line| !line.starts_with(['#', 'm']))
        .map(|line| line.split(',').map(Printed::read).collect())
        .collect()
}

fn table_1() -> Vec<Vec<Printed>> {
    printed_rows(include_str!("../data/zohdi2015_table1.csv"))
}

fn table_2() -> Vec<Vec<Printed>> {
    printed_rows(include_str!("../data/zohdi2015_table2.csv"))
}

fn values_1(row: &Row) -> Vec<f64> {
    let out = &row.outcome;
    vec![
        row.static_friction,
        out.normal_velocity,
        out.tangential_velocity,
        out.angle.to_degrees(),
        out.spin,
    ]
}

fn values_2(row: &Row) -> Vec<f64> {
    let out = &row.outcome;
    vec![
        row.static_friction,
        1e6 * out.normal_impulse,
        1e6 * out.tangential_impulse,
        1e6 * out.before.translation,
        1e6 * out.after.translation,
        1e6 * out.before.rotation,
        1e6 * out.after.rotation,
        out.energy_ratio(),
    ]
}

/// The numbers of a printed row that differ from ours.
fn differences(printed: &[Printed], ours: &[f64]) -> Vec<String> {
    assert_eq!(printed.len(), ours.len());
    let pairs = printed.iter().zip(ours);
    pairs
        .filter(|(printed, ours)| !printed.agrees(**ours))
        .map(|(printed, ours)| format!("{} printed, {ours} found", printed.value))
        .collect()
}

#[test]
fn the_slip_formula_gives_every_printed_digit() {
    let rows = zohdi::rows(Law::AlwaysSlip);
    for (printed, values) in [
        (table_1(), values_1 as fn(&Row) -> Vec<f64>),
        (table_2(), values_2),
    ] {
        assert_eq!((printed.len(), rows.len()), (11, 11));
        let all: Vec<String> = printed
            .iter()
            .zip(&rows)
            .flat_map(|(printed, row)| differences(printed, &values(row)))
            .collect();
        assert_eq!(all, Vec::<String>::new());
    }
}

#[test]
fn rows_that_slip_are_as_published() {
    let rows = zohdi::rows(Law::StickSlip);
    let slipping = (table_1().into_iter().zip(table_2()).zip(&rows))
        .filter(|(_, row)| row.static_friction <= 0.12);
    let mut count = 0;
    for ((first, second), row) in slipping {
        count += 1;
        assert_eq!(row.outcome.regime, Regime::Slip);
        assert!(differences(&first, &values_1(row)).is_empty(), "{row:?}");
        assert!(differences(&second, &values_2(row)).is_empty(), "{row:?}");
    }
    assert_eq!(count, 5);
}

#[test]
fn rows_that_stick_are_all_the_same() {
    let rows = zohdi::rows(Law::StickSlip);
    let sticking: Vec<&Row> = rows
        .iter()
        .filter(|row| row.outcome.regime == Regime::Stick)
        .collect();
    let frictions: Vec<f64> = sticking.iter().map(|row| row.static_friction).collect();
    assert_eq!(frictions, [0.30, 0.27, 0.24, 0.21, 0.18, 0.15]);
    for row in sticking {
        let out = &row.outcome;
        for (value, expected) in [
            (out.tangential_velocity, 3.57143),
            (out.spin, -7142.857),
            (out.angle.to_degrees(), 31.225),
            (out.energy_ratio(), 0.225446),
        ] {
            let tolerance = 1e-6 * f64::max(1.0, f64::abs(expected));
            assert!((value - expected).abs() <= tolerance, "{value} {expected}");
        }
        let exact = 25.0 / 7.0;
        assert!((out.tangential_velocity - exact).abs() < 1e-12 * exact);
        // Both tables with the values of sticking, to four decimals.
        for (value, expected) in [
            (out.normal_velocity, 2.1651),
            (1e6 * out.tangential_impulse, 5.2360),
            (1e6 * out.after.translation, 31.9652),
            (1e6 * out.after.rotation, 9.3500),
        ] {
            assert!((value - expected).abs() <= 0.5e-4, "{value} {expected}");
        }
    }
    // So the published rows are not what the paper's own check gives.
    for (printed, row) in table_1().iter().zip(&rows) {
        let differs = !differences(printed, &values_1(row)).is_empty();
        assert_eq!(differs, row.outcome.regime == Regime::Stick, "{row:?}");
    }
}

#[test]
fn sticking_begins_between_two_rows() {
    let least = zohdi::least_sticking_friction();
    assert!((least - 0.13197).abs() < 0.5e-5);
    for (friction, regime) in [
        (least * (1.0 - 1e-12), Regime::Slip),
        (least * (1.0 + 1e-12), Regime::Stick),
    ] {
        let outcome = zohdi::case(Law::StickSlip, friction).outcome().unwrap();
        assert_eq!(outcome.regime, regime);
    }
}

#[test]
fn published_rows_that_should_stick_slide_backwards() {
    let rows = zohdi::rows(Law::AlwaysSlip);
    let slip = |row: &Row| {
        // s' = v_t' + R w_z'
        row.outcome.tangential_velocity + zohdi::SPHERE.radius * row.outcome.spin
    };
    assert!((slip(&rows[0]) - -5.23).abs() < 0.005);
    for row in &rows {
        let sticks = row.static_friction >= zohdi::least_sticking_friction();
        assert_eq!(slip(row) < 0.0, sticks, "{row:?}");
    }
}
