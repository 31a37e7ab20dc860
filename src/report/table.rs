//! The numbers of a chart or a map as tables: comma-separated values with a heading, SI units in it.

use std::fmt::Display;

use crate::chart::{Chart, Method, Precision, Sampling, Walls};
use crate::record::{FrontRecord, MapRecord, MapTerm};
use crate::report::number::plain;

/// A table as text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// Name of its file, without ending: that of the figure it belongs to.
    pub name: &'static str,
    /// Its text.
    pub csv: String,
}

impl Table {
    /// The tables of a chart, each if there is something in it.
    pub fn of_chart(chart: &Chart) -> Vec<Self> {
        let tables = [poses(chart), searches(chart), effects(chart)];
        tables
            .into_iter()
            .filter(|table| table.csv.lines().count() > 1)
            .collect()
    }

    /// The table of a map: a row for each place.
    pub fn of_map(map: &MapRecord) -> Self {
        let columns = format!(
            "{},{},total,normal_impulse,tangential_impulse,rebound,miss,share_sticking,passes,fails",
            map.x.setting, map.y.setting
        );
        let mut table = Self::headed("map", &columns);
        let rows = map.cells.chunks(map.x.values.len().max(1));
        for (y, row) in map.y.values.iter().zip(rows) {
            for (x, cell) in map.x.values.iter().zip(row) {
                // Records keep seven digits.
                let number = |value: Option<f64>| {
                    value.map_or_else(String::new, |value| (value as f32).to_string())
                };
                let named = |index: &u32| map.subjects.get(*index as usize).cloned();
                let fails: Vec<String> = cell.fails.iter().filter_map(named).collect();
                let mut cells = vec![x.to_string(), y.to_string()];
                cells.extend(MapTerm::ALL.map(|term| number(term.of(cell))));
                cells.push(number(cell.share_sticking.map(f64::from)));
                cells.push(fails.is_empty().to_string());
                cells.push(fails.join(" "));
                let cells: Vec<&dyn Display> = cells.iter().map(|it| it as &dyn Display).collect();
                table.row(&cells);
            }
        }
        table
    }

    /// The table of a trade-off: a row for each answer.
    pub fn of_front(front: &[FrontRecord]) -> Self {
        let mut table = Self::headed(
            "trade_off",
            "recommended,contact,mu_s,incidence_deg,azimuth_deg,standoff_m,speed_m_s,aim_along_m,\
             aim_across_m,aim_above_m,target_error,target_error_standard_error,tangential,\
             tangential_standard_error,rebound,rebound_standard_error,total,fails",
        );
        for point in front {
            let at = &point.settings;
            let risks = point.risks();
            table.row(&[
                &point.recommended,
                &point.contact,
                &point.mu_s,
                &at.incidence_deg,
                &at.azimuth_deg,
                &at.standoff_m,
                &at.speed_m_s,
                &at.aim_along_m,
                &at.aim_across_m,
                &at.aim_above_m,
                &risks[0].0,
                &risks[0].1,
                &risks[1].0,
                &risks[1].1,
                &risks[2].0,
                &risks[2].1,
                &point.objective.total,
                &point.fails.join(" "),
            ]);
        }
        table
    }

    fn headed(name: &'static str, columns: &str) -> Self {
        Self {
            name,
            csv: format!("{columns}\n"),
        }
    }

    fn row(&mut self, cells: &[&dyn Display]) {
        let cells: Vec<String> = cells.iter().map(|cell| field(&cell.to_string())).collect();
        self.csv += &cells.join(",");
        self.csv.push('\n');
    }
}

/// A cell; in quotes where it holds what separates cells.
fn field(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.into()
    }
}

fn poses(chart: &Chart) -> Table {
    let mut table = Table::headed(
        "pose",
        "sampling,walls,chord_angle_deg,triangles,precision,shots,seconds,error,bias,bias_standard_error",
    );
    for curve in &chart.poses {
        let sampling = match curve.sampling {
            Sampling::Random => "random",
            Sampling::Sobol => "sobol",
            Sampling::SobolRim => "sobol_rim",
        };
        let (walls, chord_angle) = match curve.walls {
            Walls::Exact => ("exact", String::new()),
            Walls::Mesh => ("mesh", String::new()),
            Walls::Facets { chord_angle_deg } => ("facets", plain(chord_angle_deg)),
        };
        let precision = match curve.precision {
            Precision::F64 => "f64",
            Precision::F32 => "f32",
        };
        for point in &curve.points {
            table.row(&[
                &sampling,
                &walls,
                &chord_angle,
                &curve.triangles,
                &precision,
                &point.shots,
                &point.seconds,
                &point.error,
                &curve.bias,
                &curve.bias_standard_error,
            ]);
        }
    }
    table
}

/// Starts with the columns that `peenpose chart --beside` reads.
fn searches(chart: &Chart) -> Table {
    let mut table = Table::headed(
        "search",
        "method,speed,seconds,excess,excess_standard_error,seed,shots_per_pose,contact",
    );
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
        ]);
    }
    table
}

fn effects(chart: &Chart) -> Table {
    let mut table = Table::headed(
        "effect",
        "left_out,change,change_standard_error,regret,regret_standard_error,relative_cost",
    );
    for effect in &chart.effects {
        table.row(&[
            &effect.name,
            &effect.change,
            &effect.change_standard_error,
            &effect.regret,
            &effect.regret_standard_error,
            &effect.relative_cost,
        ]);
    }
    table
}
