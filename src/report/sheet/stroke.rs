//! The stroke: where the nozzle travels, how fast, what is worst where, and what it covers.

use crate::elementary::hypot;
use crate::record::{
    CoverageRecord, Record, RunOutRecord, SegmentRecord, StrokeDentedRecord, StrokeRecord,
};
use crate::report::layout::{Align, Block, Table};
use crate::report::number::{plain, share, significant};

/// Segments, feed and coverage; nothing for a spot.
pub fn block(record: &Record) -> Option<Block> {
    let stroke = record.stroke.as_ref()?;
    let mut block = Block::default();
    let mut table = Table::new(&[
        ("STROKE", Align::Left),
        ("from, mm", Align::Right),
        ("to, mm", Align::Right),
        ("incid. deg", Align::Right),
        ("az. deg", Align::Right),
        ("standoff mm", Align::Right),
        ("m/s", Align::Right),
        ("contact", Align::Left),
    ]);
    for (index, segment) in stroke.segments.iter().enumerate() {
        table.row(row(index, segment));
    }
    block.table(table);
    block.hanging("way        ", &way(stroke));
    block.hanging("feed       ", &feed(stroke));
    if let Some((dented, coverage)) = stroke.dented.as_ref().zip(record.coverage.as_ref()) {
        block.hanging("coverage   ", &covered(dented, coverage));
    }
    if !stroke.doses.is_empty() {
        block.hanging("dose       ", &doses(stroke));
    }
    let worst = worst_places(record, stroke);
    if !worst.is_empty() {
        block.hanging("worst      ", &worst);
    }
    Some(block)
}

fn covered(dented: &StrokeDentedRecord, coverage: &CoverageRecord) -> String {
    let mean_error = hypot(dented.mean_standard_error, dented.mean_resolution);
    format!(
        "{} of the target is dented (+- {}); over cells of {} mm {} where least (std. error {}) and {} where most; {} kg of shot",
        share(dented.mean),
        share(mean_error),
        significant(coverage.cell_side_m * 1e3, 2),
        share(dented.least),
        share(dented.least_standard_error),
        share(dented.most),
        significant(dented.mass_kg, 3),
    )
}

/// How often surfaces that should be spared are hit where they are hit most.
fn doses(stroke: &StrokeRecord) -> String {
    let each = stroke.doses.iter().map(|dose| {
        format!(
            "{} {} (std. error {})",
            dose.surface,
            significant(dose.most_hits_m2 * 1e-6, 2),
            significant(dose.standard_error_m2 * 1e-6, 2),
        )
    });
    let each: Vec<String> = each.collect();
    format!(
        "hits/mm2 in all on what should be spared, where they are densest: {}",
        each.join("; ")
    )
}

fn row(index: usize, segment: &SegmentRecord) -> [String; 8] {
    let settings = &segment.settings;
    let millimetres = |length: f64| plain(length * 1e3);
    [
        format!("segment {}", index + 1),
        millimetres(segment.from_m),
        millimetres(segment.to_m),
        significant(settings.incidence_deg, 3),
        significant(settings.azimuth_deg, 3),
        significant(settings.standoff_m * 1e3, 3),
        significant(settings.speed_m_s, 4),
        segment.contact.clone(),
    ]
}

fn way(stroke: &StrokeRecord) -> String {
    let mut text = format!("{} mm on the part", significant(stroke.length_m * 1e3, 4));
    if stroke.turns > 0.0 {
        text += &format!(", {} turns", significant(stroke.turns, 3));
    }
    text += &run_out(stroke);
    text + &format!("; verified at {} stations", stroke.stations.len())
}

fn run_out(stroke: &StrokeRecord) -> String {
    let millimetres = |length: f64| significant(length * 1e3, 3);
    let beyond_both = |length: f64| match length {
        0.0 => ", no run-out".to_owned(),
        length => format!(
            ", and a run-out of {} mm beyond both ends",
            millimetres(length)
        ),
    };
    let Some([before, after]) = &stroke.run_outs else {
        return beyond_both(stroke.run_out_m);
    };
    if before == after && before.limited_by.is_none() {
        return beyond_both(before.length_m);
    }
    let one = |run_out: &RunOutRecord, end: &str| {
        let length = millimetres(run_out.length_m);
        match &run_out.limited_by {
            Some(limit) => format!(
                "{length} mm {end} it ({} mm would bring the whole spot past the target, but {limit} fails)",
                millimetres(run_out.wanted_m)
            ),
            None => format!("{length} mm {end} it"),
        }
    };
    let [before, after] = [one(before, "before"), one(after, "after")];
    format!(", and a run-out of {before} and {after}")
}

fn feed(stroke: &StrokeRecord) -> String {
    let (Some(feed), Some(passes)) = (stroke.feed_m_s, stroke.passes) else {
        return match stroke.missing.is_empty() {
            true => "none reaches the wanted coverage: some of the target is not hit at all".into(),
            false => format!("not known: it needs {}", stroke.missing.join(" and ")),
        };
    };
    let mut text = format!("{} mm/s at the spot", significant(feed * 1e3, 3));
    if let Some(error) = stroke.feed_standard_error_m_s {
        text += &format!(", std. error {}", significant(error * 1e3, 2));
    }
    if let Some(turns) = stroke.turns_per_s {
        text += &format!(" ({} rpm)", significant(turns * 60.0, 3));
    }
    text += match passes {
        1 => ", one pass".to_owned(),
        passes => format!(", {passes} passes"),
    }
    .as_str();
    match stroke.time_s {
        Some(time) => text + &format!(", {} s in all", significant(time, 3)),
        None => text,
    }
}

/// Where verdicts are used up most, with the places.
fn worst_places(record: &Record, stroke: &StrokeRecord) -> String {
    let verdicts = record.best.verdicts.iter();
    let placed = verdicts.filter_map(|verdict| {
        let place = stroke.place(verdict.at_m?);
        Some(format!(
            "{} at {place} ({})",
            verdict.subject,
            share(verdict.share)
        ))
    });
    placed.collect::<Vec<String>>().join("; ")
}

/// The spot, and how much of the target it is.
pub fn spot(record: &Record) -> Option<String> {
    let spot = record.spot.as_ref()?;
    let millimetres = |length: f64| significant(length * 1e3, 2);
    Some(format!(
        "{} x {} mm, {} of the target",
        millimetres(spot.length_m),
        millimetres(spot.width_m),
        share(spot.share_of_target),
    ))
}
