//! The tables of a chart.

use std::io;

use super::{Rows, Table};
use crate::chart::{Chart, Leaks, Method, Sampling, Walls};
use crate::report::number::plain;

pub(super) fn all(chart: &Chart) -> io::Result<Vec<Table>> {
    Ok(vec![poses(chart)?, searches(chart)?, effects(chart)?])
}

fn poses(chart: &Chart) -> io::Result<Table> {
    let mut table = Rows::headed(
        "pose",
        &[
            "sampling",
            "walls",
            "chord_angle_deg",
            "triangles",
            "shots",
            "seconds",
            "error",
            "bias",
            "bias_standard_error",
            "rays_at_edges",
            "rays_lost",
        ],
    )?;
    for curve in &chart.poses {
        let sampling = match curve.sampling {
            Sampling::Random => "random",
            Sampling::Sobol => "sobol",
            Sampling::SobolRim => "sobol_rim",
        };
        let (walls, chord_angle) = match curve.walls {
            Walls::Exact => ("exact", String::new()),
            Walls::Mesh => ("mesh", String::new()),
            Walls::Points => ("points", String::new()),
            Walls::Parry => ("parry", String::new()),
            Walls::Facets { chord_angle_deg } => ("facets", plain(chord_angle_deg)),
        };
        let leaks = |of: fn(Leaks) -> usize| {
            let leaks = curve.leaks.map(of);
            leaks.map_or_else(String::new, |rays| rays.to_string())
        };
        let (aimed, missed) = (leaks(|it| it.aimed), leaks(|it| it.missed));
        for point in &curve.points {
            table.row(&[
                &sampling,
                &walls,
                &chord_angle,
                &curve.triangles,
                &point.shots,
                &point.seconds,
                &point.error,
                &curve.bias,
                &curve.bias_standard_error,
                &aimed,
                &missed,
            ])?;
        }
    }
    table.finish()
}

/// Starts with the columns that `peenpose chart --beside` reads.
fn searches(chart: &Chart) -> io::Result<Table> {
    let mut table = Rows::headed(
        "search",
        &[
            "method",
            "speed",
            "seconds",
            "excess",
            "excess_standard_error",
            "seed",
            "shots_per_pose",
            "contact",
        ],
    )?;
    for run in chart.searches.iter().flat_map(|searches| &searches.runs) {
        let (method, speed) = match run.method {
            Method::Accuracy(accuracy) => ("accuracy", format!("{} %", plain(accuracy * 100.0))),
            Method::MostShots(shots) => ("most_shots", format!("{shots} shots")),
        };
        table.row(&[
            &method,
            &speed,
            &run.seconds,
            &run.excess,
            &run.excess_standard_error,
            &run.seed,
            &run.shots_per_pose,
            &run.contact,
        ])?;
    }
    table.finish()
}

fn effects(chart: &Chart) -> io::Result<Table> {
    let mut table = Rows::headed(
        "effect",
        &[
            "left_out",
            "change",
            "change_standard_error",
            "regret",
            "regret_standard_error",
            "fits",
            "relative_cost",
        ],
    )?;
    for effect in &chart.effects {
        table.row(&[
            &effect.name,
            &effect.change,
            &effect.change_standard_error,
            &effect.regret,
            &effect.regret_standard_error,
            &effect.fits,
            &effect.relative_cost,
        ])?;
    }
    table.finish()
}
