//! How densely first hits fall on the target, and how long it takes until it is dented.

use crate::record::{CoverageRecord, DensityRecord, DentedRecord, DentsFromRecord, Record};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{count, plain, share, significant};

/// Densities with what it takes to the wanted coverage, and what that assumes.
pub fn block(record: &Record) -> Option<Block> {
    let coverage = record.coverage.as_ref()?;
    let wanted = wanted(coverage);
    let (time, shot) = (format!("{wanted} % after"), format!("{wanted} % takes"));
    let title = match record.stroke {
        Some(_) => "COVERAGE of a pass",
        None => "COVERAGE, nozzle at rest",
    };
    let mut table = Table::new(&[
        (title, Align::Left),
        (hits_unit(coverage), Align::Right),
        ("std. error", Align::Right),
        (&time, Align::Right),
        (&shot, Align::Right),
    ]);
    table.row(row("mean of the target", coverage, &coverage.mean));
    table.row(row("at least, on 95 % of it", coverage, &coverage.lowest_5));
    let mut block = Block::default();
    block.table(table.without_empty_columns());
    if let Some(dented) = &coverage.dented {
        block.paragraph(&of_the_target(coverage, dented, record.stroke.is_some()));
    }
    block.paragraph(&format!(
        "Over cells of {} mm the density of first hits varies by {} (standard deviation).",
        significant(coverage.cell_side_m * 1e3, 2),
        share(coverage.variation),
    ));
    block.paragraph(&format!(
        "Dents of {} mm{} that fall at random (Avrami): n hits per area cover 1 - exp(-n pi d2 / 4).",
        dent_diameter(coverage),
        dents_from(coverage),
    ));
    Some(block)
}

/// The wanted coverage in percent, as it was asked for.
fn wanted(coverage: &CoverageRecord) -> String {
    let share = match coverage.wanted_times {
        1.0 => coverage.wanted,
        times => times,
    };
    plain(share * 100.0)
}

fn dent_diameter(coverage: &CoverageRecord) -> String {
    match coverage.dents_from {
        None => plain(coverage.dent_diameter_m * 1e3),
        Some(_) => significant(coverage.dent_diameter_m * 1e3, 3),
    }
}

/// Where dents of different sizes come from.
fn dents_from(coverage: &CoverageRecord) -> String {
    match coverage.dents_from {
        None => String::new(),
        Some(DentsFromRecord::Measured {
            diameter_m,
            normal_speed_m_s,
        }) => format!(
            " in the mean area (one of {} mm was left at a normal speed of {} m/s; d grows with the root of it)",
            significant(diameter_m * 1e3, 3),
            significant(normal_speed_m_s, 3),
        ),
        Some(DentsFromRecord::Hardness { hardness }) => format!(
            " in the mean area (the work that a hit loses over a dynamic hardness of {} GPa is the volume of its dent)",
            significant(hardness * 1e-9, 3),
        ),
    }
}

/// How much of the target is dented and when, each number with its errors.
fn of_the_target(coverage: &CoverageRecord, dented: &DentedRecord, moves: bool) -> String {
    let wanted = wanted(coverage);
    let takes = |kilograms: f64| match coverage.mass_flow_kg_s {
        Some(flow) => format!("{} ({})", duration(kilograms / flow), mass(kilograms)),
        None => mass(kilograms),
    };
    let bare = format!(
        "{} of it is not reached (none of {} shots falls there; cell size at most {} more)",
        share(coverage.share_not_hit),
        count(coverage.shots),
        share(dented.not_hit_resolution),
    );
    let reached = match dented.mass_kg {
        Some(needed) => format!(
            "{wanted} % of the target {} after {} (std. error {}, cell size at most {})",
            if coverage.wanted_times == 1.0 {
                "is dented"
            } else {
                "are reached"
            },
            takes(needed.value),
            mass(needed.standard_error),
            mass(needed.resolution),
        ),
        None => format!("{wanted} % of the target is dented never: {bare}"),
    };
    let mut sentences = vec![reached];
    if dented.mass_kg.is_some() && coverage.share_not_hit > 0.0 {
        sentences.push(bare);
    }
    if let (Some(even), Some(by_even)) = (dented.even_mass_kg, dented.by_even_mass) {
        sentences.push(format!(
            "After {}, which were enough if hits fell evenly, {} of it is dented (std. error {}, cell size at most {})",
            takes(even),
            share(by_even.value),
            share(by_even.standard_error),
            share(by_even.resolution),
        ));
    }
    if coverage.share_not_hit > 0.0 && !moves {
        sentences.push("Only a nozzle that moves gets everywhere".into());
    }
    sentences.join(". ") + "."
}

fn hits_unit(coverage: &CoverageRecord) -> &'static str {
    match coverage.mass_flow_kg_s {
        Some(_) => "hits/mm2 per s",
        None => "hits/mm2 per kg",
    }
}

fn row(name: &str, coverage: &CoverageRecord, density: &DensityRecord) -> [String; 5] {
    let shots = coverage.shots_per_kg * coverage.mass_flow_kg_s.unwrap_or(1.0);
    let per_square_millimetre =
        |per_shot_and_square_metre: f64| significant(per_shot_and_square_metre * shots * 1e-6, 3);
    let after = match (density.time_s, coverage.mass_flow_kg_s) {
        (Some(time), _) => duration(time),
        (None, Some(_)) => "never".into(),
        (None, None) => String::new(),
    };
    [
        name.into(),
        per_square_millimetre(density.hits_per_shot_m2),
        per_square_millimetre(density.standard_error_m2),
        after,
        density.mass_kg.map_or_else(|| "no end".into(), mass),
    ]
}

fn duration(seconds: f64) -> String {
    if seconds < 100.0 {
        format!("{} s", significant(seconds, 3))
    } else {
        format!("{} min", significant(seconds / 60.0, 3))
    }
}

fn mass(kilograms: f64) -> String {
    if kilograms < 1.0 {
        format!("{} g", significant(kilograms * 1e3, 3))
    } else {
        format!("{} kg", significant(kilograms, 3))
    }
}
