//! One impact and the tables as text.

use peenpose::elementary::tan;
use peenpose::impact::zohdi::{self, Row};
use peenpose::impact::{Law, Oblique, Outcome};

use super::Table;
use super::json::{EnergiesJson, TableJson, VelocitiesJson, to_json};

pub fn impact_text(shot: &Oblique, outcome: &Outcome) -> String {
    let sticking = match shot.stick_angle() {
        Some(angle) => [
            decimals(tan(angle), 5),
            format!(
                "so from {} deg without spin",
                decimals(angle.to_degrees(), 4)
            ),
        ],
        None => ["never".to_owned(), String::new()],
    };
    let [threshold, threshold_angle] = sticking;
    let energy = |value: f64| decimals(1e6 * value, 4);
    let row = |name: &str, value: String, unit: &str| [name.to_owned(), value, unit.to_owned()];
    let rows = [
        row("regime", outcome.regime.name().to_owned(), ""),
        row(
            "normal impulse N*",
            decimals(1e6 * outcome.normal_impulse, 4),
            "uN.s",
        ),
        row(
            "tangential impulse f*",
            decimals(1e6 * outcome.tangential_impulse, 4),
            "uN.s",
        ),
        row(
            "normal velocity v_n'",
            decimals(outcome.normal_velocity, 4),
            "m/s",
        ),
        row(
            "tangential velocity v_t'",
            decimals(outcome.tangential_velocity, 4),
            "m/s",
        ),
        row(
            "rebound angle theta'",
            decimals(outcome.angle.to_degrees(), 4),
            "deg",
        ),
        row("spin w'", decimals(outcome.spin, 4), "rad/s"),
        row(
            "energy of translation before",
            energy(outcome.before.translation),
            "uJ",
        ),
        row(
            "energy of translation after",
            energy(outcome.after.translation),
            "uJ",
        ),
        row(
            "energy of rotation before",
            energy(outcome.before.rotation),
            "uJ",
        ),
        row(
            "energy of rotation after",
            energy(outcome.after.rotation),
            "uJ",
        ),
        row(
            "energy after / before",
            decimals(outcome.energy_ratio(), 4),
            "",
        ),
        row("sticks from tan(theta)", threshold, &threshold_angle),
    ];
    let width = |column: usize| {
        let cells = rows.iter().map(|row| row[column].len());
        cells.max().unwrap_or(0)
    };
    let (names, values) = (width(0), width(1));
    let lines = rows.iter().map(|[name, value, unit]| {
        let line = format!("{name:names$}  {value:>values$}  {unit}");
        format!("{}\n", line.trim_end())
    });
    lines.collect()
}

/// A number with that many decimals; 0 has no sign.
fn decimals(value: f64, places: usize) -> String {
    let text = format!("{value:.places$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| matches!(c, '0' | '.')) => digits.to_owned(),
        _ => text,
    }
}

pub fn table_text(table: Table, as_published: bool, json: bool) -> Result<String, String> {
    let law = if as_published {
        Law::AlwaysSlip
    } else {
        Law::StickSlip
    };
    let rows = zohdi::rows(law);
    let note = note(as_published);
    if json {
        return match table {
            Table::Zohdi1 => to_json(&TableJson {
                law: law.name(),
                rows: rows.iter().map(VelocitiesJson::new).collect(),
                note,
            }),
            Table::Zohdi2 => to_json(&TableJson {
                law: law.name(),
                rows: rows.iter().map(EnergiesJson::new).collect(),
                note,
            }),
        };
    }
    let mut lines = match table {
        Table::Zohdi1 => velocities(&rows),
        Table::Zohdi2 => energies(&rows),
    };
    lines.push_str(&format!("\n{note}\n"));
    Ok(lines)
}

/// Why the published tables and the paper's own check disagree.
pub fn note(as_published: bool) -> String {
    let least = decimals(zohdi::least_sticking_friction(), 5);
    if as_published {
        format!(
            "As published: the slip formula (Eq. 23) in every row. By the paper's own check \
             (Eq. 22) the rows with mu_s >= {least} stick; the formula makes their contact points \
             leave backwards and their energy rise with friction, from nowhere."
        )
    } else {
        format!(
            "Rows with mu_s >= {least} stick (Eq. 22), so more friction changes nothing there. \
             The published rows apply the slip formula (Eq. 23) all the same: their contact points \
             leave backwards and their energy rises with friction, from nowhere. --as-published \
             prints them."
        )
    }
}

/// Table 1.
fn velocities(rows: &[Row]) -> String {
    let header = [
        "mu_s",
        "regime",
        "v_n' m/s",
        "v_t' m/s",
        "theta' deg",
        "w_z' rad/s",
    ];
    aligned(&header, rows, |row| {
        let out = &row.outcome;
        vec![
            decimals(row.static_friction, 3),
            out.regime.name().to_owned(),
            decimals(out.normal_velocity, 4),
            decimals(out.tangential_velocity, 4),
            decimals(out.angle.to_degrees(), 4),
            decimals(out.spin, 4),
        ]
    })
}

/// Table 2.
fn energies(rows: &[Row]) -> String {
    let header = [
        "mu_s", "regime", "N* uN.s", "f* uN.s", "W_T uJ", "W_T' uJ", "W_R uJ", "W_R' uJ", "W'/W",
    ];
    aligned(&header, rows, |row| {
        let out = &row.outcome;
        let micro = |value: f64| decimals(1e6 * value, 4);
        vec![
            decimals(row.static_friction, 3),
            out.regime.name().to_owned(),
            micro(out.normal_impulse),
            micro(out.tangential_impulse),
            micro(out.before.translation),
            micro(out.after.translation),
            micro(out.before.rotation),
            micro(out.after.rotation),
            decimals(out.energy_ratio(), 4),
        ]
    })
}

/// Right-aligned columns under their headings.
fn aligned(header: &[&str], rows: &[Row], cells: impl Fn(&Row) -> Vec<String>) -> String {
    let mut lines = vec![header.iter().map(|&text| text.to_owned()).collect()];
    lines.extend(rows.iter().map(cells));
    let mut text = String::new();
    for line in &lines {
        let padded = line.iter().enumerate().map(|(column, cell)| {
            let column = lines.iter().filter_map(|line| line.get(column));
            let width = column.map(String::len).max().unwrap_or(0);
            format!("{cell:>width$}")
        });
        text.push_str(&padded.collect::<Vec<_>>().join("  "));
        text.push('\n');
    }
    text
}
