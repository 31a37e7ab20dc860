//! Whether a record that was read agrees with itself: what it concludes is concluded again.
//!
//! Reports say PASS where the record says so. Anybody can write a file, and a disk can damage one, so each
//! conclusion must follow from the numbers beside it. Where older versions computed a figure in
//! another way, it need only be possible.

mod answer;
mod place;
mod question;
mod verdict;
mod window;

use place::{Outcome, Place};

use super::{
    CoverageRecord, FrontRecord, RankingRecord, Record, StatusRecord, StrokeRecord, UnknownsRecord,
    WorkRecord,
};

/// Finds the first contradiction in a record.
pub(super) fn record(record: &Record) -> Outcome {
    let root = Place::default();
    question::check(&root.of("problem"), &record.problem)?;
    answers(&root, record)?;
    status(&root, record)?;
    ranking(&root, record)?;
    for (index, window) in record.windows.iter().enumerate() {
        window::check(&root.of("windows").item(index), window, record)?;
    }
    front(&root.of("front"), &record.front)?;
    if let Some(unknowns) = &record.unknowns {
        self::unknowns(&root.of("unknowns"), unknowns)?;
    }
    if let Some(coverage) = &record.coverage {
        self::coverage(&root.of("coverage"), coverage)?;
    }
    if let Some(stroke) = &record.stroke {
        self::stroke(&root.of("stroke"), stroke)?;
    }
    work(&root.of("work"), &record.work)?;
    let sums = record.mesh_sha256.values().chain([&record.problem_sha256]);
    for sum in sums {
        let is_digit = |c: char| c.is_ascii_digit() || ('a'..='f').contains(&c);
        let is_sum = sum.len() == 64 && sum.chars().all(is_digit);
        root.of("problem_sha256")
            .holds(is_sum, "or one of mesh_sha256 is no SHA-256")?;
    }
    Ok(())
}

fn answers(root: &Place, record: &Record) -> Outcome {
    let choices = root.of("choices");
    let first = record.choices.first();
    let is_best = first.is_some_and(|first| *first == record.best);
    answer::check(&root.of("best"), &record.best, record)?;
    choices.item(0).holds(is_best, "is not what `best` says")?;
    for (index, answer) in record.choices.iter().enumerate().skip(1) {
        answer::check(&choices.item(index), answer, record)?;
    }
    Ok(())
}

fn status(root: &Place, record: &Record) -> Outcome {
    let (at, fits) = (root.of("status"), record.best.objective.is_some());
    match record.status {
        StatusRecord::NoFeasiblePose => at.holds(
            !fits && !record.best.passes,
            "is no_feasible_pose, but the nozzle fits at `best`",
        ),
        StatusRecord::Converged | StatusRecord::BestFound => at.holds(
            fits,
            "says that settings were found, but `best` has no objective",
        ),
        StatusRecord::Interrupted | StatusRecord::Evaluated => Ok(()),
    }
}

fn ranking(root: &Place, record: &Record) -> Outcome {
    if let Some(spread) = record.spread {
        root.of("spread").within(spread, 0.0, f64::MAX)?;
    }
    record.ranking.map_or(Ok(()), |ranking| {
        root.of("ranking").holds(
            (ranking == RankingRecord::Passing) == record.best.passes,
            "is `passing` where `best` passes, and only there",
        )
    })
}

fn front(at: &Place, front: &[FrontRecord]) -> Outcome {
    let recommended = front.iter().filter(|point| point.recommended).count();
    at.holds(recommended <= 1, "recommends more than one answer")?;
    for (index, point) in front.iter().enumerate() {
        let at = at.item(index);
        answer::settings(&at.of("settings"), &point.settings)?;
        answer::objective(&at.of("objective"), &point.objective)?;
    }
    Ok(())
}

fn unknowns(at: &Place, unknowns: &UnknownsRecord) -> Outcome {
    let ends = unknowns
        .ranges
        .iter()
        .flat_map(|range| [&range.at_low, &range.at_high]);
    for outcome in ends.chain([&unknowns.nominal]) {
        at.of("objective").at_least(outcome.objective, 0.0)?;
        for share in &outcome.shares {
            at.of(&share.subject).share(share.share)?;
        }
    }
    for (index, range) in unknowns.ranges.iter().enumerate() {
        let is_upright = range.low <= range.high;
        at.of("ranges")
            .item(index)
            .holds(is_upright, "is upside down")?;
    }
    Ok(())
}

fn coverage(at: &Place, coverage: &CoverageRecord) -> Outcome {
    at.of("wanted").share(coverage.wanted)?;
    at.of("share_not_hit").share(coverage.share_not_hit)?;
    for (key, value) in [
        ("dent_diameter_m", coverage.dent_diameter_m),
        ("area_m2", coverage.area_m2),
        ("cell_side_m", coverage.cell_side_m),
        ("variation", coverage.variation),
        ("shots_per_kg", coverage.shots_per_kg),
        ("mass_flow_kg_s", coverage.mass_flow_kg_s.unwrap_or(0.0)),
    ] {
        at.of(key).at_least(value, 0.0)?;
    }
    for (key, density) in [("mean", &coverage.mean), ("lowest_5", &coverage.lowest_5)] {
        let at = at.of(key);
        at.of("hits_per_shot_m2")
            .at_least(density.hits_per_shot_m2, 0.0)?;
        at.of("mass_kg")
            .at_least(density.mass_kg.unwrap_or(0.0), 0.0)?;
        at.of("time_s")
            .at_least(density.time_s.unwrap_or(0.0), 0.0)?;
    }
    Ok(())
}

fn stroke(at: &Place, stroke: &StrokeRecord) -> Outcome {
    at.of("length_m").at_least(stroke.length_m, 0.0)?;
    at.of("run_out_m").at_least(stroke.run_out_m, 0.0)?;
    for (index, run_out) in stroke.run_outs.iter().flatten().enumerate() {
        let at = at.of("run_outs").item(index);
        at.of("length_m").at_least(run_out.length_m, 0.0)?;
        at.of("wanted_m")
            .at_least(run_out.wanted_m, run_out.length_m)?;
    }
    for (key, value) in [
        ("feed_m_s", stroke.feed_m_s),
        ("feed_standard_error_m_s", stroke.feed_standard_error_m_s),
        ("turns_per_s", stroke.turns_per_s),
        ("time_s", stroke.time_s),
    ] {
        at.of(key).at_least(value.unwrap_or(0.0), 0.0)?;
    }
    let segments = at.of("segments");
    segments.holds(!stroke.segments.is_empty(), "holds none")?;
    for (index, segment) in stroke.segments.iter().enumerate() {
        let at = segments.item(index);
        at.of("to_m").at_least(segment.to_m, segment.from_m)?;
        answer::settings(&at.of("settings"), &segment.settings)?;
    }
    for (index, waypoint) in stroke.waypoints.iter().enumerate() {
        let at = at.of("waypoints").item(index);
        answer::pose(&at.of("pose"), &waypoint.pose)?;
        let before = index.checked_sub(1).map(|before| &stroke.waypoints[before]);
        let is_onwards = before.is_none_or(|before| before.at_m <= waypoint.at_m);
        at.of("at_m").holds(is_onwards, "goes back")?;
    }
    for (index, station) in stroke.stations.iter().enumerate() {
        let at = at.of("stations").item(index).of("verdicts");
        for (index, it) in station.verdicts.iter().enumerate() {
            verdict::alone(&at.item(index), it, it.counted == 1)?;
        }
    }
    if let Some(dented) = &stroke.dented {
        let at = at.of("dented");
        at.of("mass_kg").at_least(dented.mass_kg, 0.0)?;
        for (key, value) in [
            ("mean", dented.mean),
            ("least", dented.least),
            ("most", dented.most),
        ] {
            at.of(key).share(value)?;
        }
    }
    for (index, dose) in stroke.doses.iter().enumerate() {
        let at = at.of("doses").item(index);
        at.of("most_hits_m2").at_least(dose.most_hits_m2, 0.0)?;
    }
    if let Some(map) = &stroke.dented_map {
        let at = at.of("dented_map");
        for side in map.sides_m {
            at.of("sides_m").at_least(side, 0.0)?;
        }
        let is_whole = map.columns > 0 && map.dented.len().is_multiple_of(map.columns);
        at.of("columns")
            .holds(is_whole, "does not divide the number of cells")?;
        for (index, share) in map.dented.iter().enumerate() {
            let share = share.unwrap_or(0.0);
            at.of("dented").item(index).share(f64::from(share))?;
        }
    }
    Ok(())
}

fn work(at: &Place, work: &WorkRecord) -> Outcome {
    at.of("seconds").at_least(work.seconds, 0.0)
}
