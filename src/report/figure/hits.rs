//! The figure of the hits on the target: where they lie, what they deliver there, and how often.

use std::ops::Range;

use colorous::Gradient;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::linear::{Axes, Plot};
use super::sheet::{self, Area, Drawn, Fault, Place, drawn, headline, styled};
use super::style::{FAINT, GHOST, INK, LABEL, LOOKS, letters};
use crate::record::{EvidenceRecord, GoalsRecord, HitsRecord, Record, RoleRecord};
use crate::report::number::{
    count, decimals_for, fixed, impulse_asked, plain, rounded, share, share_asked, significant,
};

const SIZE: (u32, u32) = (2000, 1230);
/// Upper left corners of maps and histograms, px, and their sizes.
const LEFT: [i32; 3] = [130, 760, 1450];
const TOP: [i32; 2] = [250, 810];
const WIDTH: i32 = 390;
const MAP_HEIGHT: i32 = 390;
const HISTOGRAM_HEIGHT: i32 = 300;
/// Where the colour bar stands beside a map, px, and how wide it is.
const BAR_APART: i32 = 24;
const BAR_WIDTH: i32 = 26;
/// Room round the hits, relative to their extent.
const ROOM: f64 = 0.08;
/// Room beside the marks of a histogram, relative to its extent.
const ROOM_FOR_NAMES: f64 = 0.25;
/// A histogram shows at least this much of its values, relative to them.
const LEAST_SPAN: f64 = 1e-3;
/// Cells along the longer side of a map.
const FEWEST_CELLS: f64 = 8.0;
const MOST_CELLS: f64 = 36.0;
/// The colours of N* reach at least so far from what is wanted, relative to it.
const LEAST_TOLERANCE: f64 = 0.01;
/// Bars of a histogram.
const BARS: usize = 32;

/// The figure as SVG; `None` where nothing was hit, where all shots are the same, or a hit lacks some of its values.
pub fn svg(record: &Record, evidence: &EvidenceRecord) -> Option<Result<String, Fault>> {
    let hits = &evidence.hits;
    let number = hits.plane_m.len();
    let columns = [
        hits.angle_deg.len(),
        hits.normal_impulse.len(),
        hits.tangential_impulse.len(),
        hits.sticks.len(),
    ];
    if number == 0 || hits.shots < 2 || columns.iter().any(|column| *column != number) {
        return None;
    }
    let grid = Grid::new(hits);
    Some(drawn(SIZE, |area| {
        let sentences = [record.problem.title.clone(), where_they_lie(hits, evidence)];
        headline(area, "First hits on the target", &sentences)?;
        let outline = outline(evidence);
        for (index, map) in maps(record, hits, &grid).iter().enumerate() {
            let plot = map.draw(area, index, &grid)?;
            for ends in &outline {
                plot.segment(*ends, INK.stroke_width(3))?;
            }
        }
        for (index, histogram) in histograms(record, hits).iter().enumerate() {
            histogram.draw(area, index)?;
        }
        Ok(())
    }))
}

fn where_they_lie(hits: &HitsRecord, evidence: &EvidenceRecord) -> String {
    let sizes = |plane: &mut dyn Iterator<Item = [f64; 2]>| {
        let [x, y] = extent(plane);
        format!(
            "{} x {} mm",
            significant(x.end - x.start, 2),
            significant(y.end - y.start, 2)
        )
    };
    format!(
        "{} of {} shots hit it; the hits span {} of a patch of {}. Each shot flies as the jet scatters and \
         from a setting within the tolerance; the outline is the edge of the patch.",
        count(hits.plane_m.len()),
        count(hits.shots),
        sizes(&mut in_millimetres(hits)),
        sizes(&mut patch(evidence).flatten()),
    )
}

fn in_millimetres(hits: &HitsRecord) -> impl Iterator<Item = [f64; 2]> {
    hits.plane_m
        .iter()
        .map(|at| at.map(|part| f64::from(part) * 1e3))
}

/// The triangles of the target, mm along and across from the aim point.
fn patch(evidence: &EvidenceRecord) -> impl Iterator<Item = [[f64; 2]; 3]> {
    let frame = &evidence.frame;
    let flat = move |at: [f32; 3]| {
        let from = [0, 1, 2].map(|axis| f64::from(at[axis]) - frame.aim_m[axis]);
        [frame.along, frame.across].map(|axis| {
            let parts = from.iter().zip(axis).map(|(part, unit)| part * unit);
            parts.sum::<f64>() * 1e3
        })
    };
    let targets = evidence
        .surfaces
        .iter()
        .filter(|s| s.role == RoleRecord::Target);
    targets.flat_map(move |shape| {
        let corner = move |index: u32| shape.points_m.get(index as usize).copied().map(flat);
        let triangles = shape.triangles.iter();
        triangles.filter_map(move |&[a, b, c]| Some([corner(a)?, corner(b)?, corner(c)?]))
    })
}

/// The edges of the target patch: those that belong to one triangle only.
fn outline(evidence: &EvidenceRecord) -> Vec<[(f64, f64); 2]> {
    let mut edges = std::collections::BTreeMap::new();
    // Corners of neighbours are the same but for rounding.
    let key = |at: [f64; 2]| at.map(|part| (part * 1e4).round() as i64);
    for triangle in patch(evidence) {
        for index in 0..3 {
            let ends = [triangle[index], triangle[(index + 1) % 3]];
            let mut name = ends.map(key);
            name.sort_unstable();
            let (number, _) = edges.entry(name).or_insert((0, ends));
            *number += 1;
        }
    }
    let single = edges.into_values().filter(|(number, _)| *number == 1);
    single
        .map(|(_, ends)| ends.map(|[along, across]| (along, across)))
        .collect()
}

fn extent(points: &mut dyn Iterator<Item = [f64; 2]>) -> [Range<f64>; 2] {
    let empty = [
        f64::INFINITY..f64::NEG_INFINITY,
        f64::INFINITY..f64::NEG_INFINITY,
    ];
    points.fold(empty, |[x, y], at| {
        [
            x.start.min(at[0])..x.end.max(at[0]),
            y.start.min(at[1])..y.end.max(at[1]),
        ]
    })
}

/// Square cells over the hits.
struct Grid {
    x: Range<f64>,
    y: Range<f64>,
    /// Whether all hits lie at one place, so that the scale means nothing.
    is_one_place: bool,
    /// Side of a cell, mm.
    side: f64,
    columns: usize,
    rows: usize,
    /// Which hits lie in each cell.
    cells: Vec<Vec<usize>>,
}

impl Grid {
    /// A grid with the proportions of a map.
    fn new(hits: &HitsRecord) -> Self {
        let [x, y] = extent(&mut in_millimetres(hits));
        let (width, height) = (x.end - x.start, y.end - y.start);
        let room =
            (2.0 * ROOM + 1.0) * width.max(height * f64::from(WIDTH) / f64::from(MAP_HEIGHT));
        // Where all hits are the same, any scale does.
        let is_one_place = room == 0.0;
        let room = if is_one_place { 1.0 } else { room };
        let half = [
            room / 2.0,
            room / 2.0 * f64::from(MAP_HEIGHT) / f64::from(WIDTH),
        ];
        let middle = [f64::midpoint(x.start, x.end), f64::midpoint(y.start, y.end)];
        let [x, y] = [0, 1].map(|axis| middle[axis] - half[axis]..middle[axis] + half[axis]);
        let fine = (hits.plane_m.len() as f64).sqrt() / 3.5;
        let side = 2.0 * half[1] / fine.clamp(FEWEST_CELLS, MOST_CELLS).round();
        let cells = |range: &Range<f64>| ((range.end - range.start) / side).ceil() as usize;
        let (columns, rows) = (cells(&x), cells(&y));
        let mut grid = Self {
            x,
            y,
            is_one_place,
            side,
            columns,
            rows,
            cells: vec![Vec::new(); columns * rows],
        };
        for (index, at) in in_millimetres(hits).enumerate() {
            let column = ((at[0] - grid.x.start) / side) as usize;
            let row = ((at[1] - grid.y.start) / side) as usize;
            grid.cells[row.min(rows - 1) * columns + column.min(columns - 1)].push(index);
        }
        grid
    }

    /// A value for each cell that was hit.
    fn values(&self, of: impl Fn(&[usize]) -> f64) -> Vec<Option<f64>> {
        let value = |cell: &Vec<usize>| (!cell.is_empty()).then(|| of(cell));
        self.cells.iter().map(value).collect()
    }
}

/// A map of a quantity over the target.
struct Map {
    title: &'static str,
    values: Vec<Option<f64>>,
    scale: Range<f64>,
    gradient: Gradient,
    /// Values that are marked on the colour bar.
    marks: Vec<(f64, String)>,
}

fn maps(record: &Record, hits: &HitsRecord, grid: &Grid) -> [Map; 3] {
    let goals = &record.problem.goals;
    // A density needs an extent; what lies at one place is all of it.
    let area = if grid.is_one_place {
        1.0
    } else {
        grid.side * grid.side
    };
    let density = |cell: &[usize]| cell.len() as f64 / hits.shots as f64 / area * 100.0;
    let mean = |of: &[f32], cell: &[usize]| {
        let sum: f64 = cell.iter().map(|&index| f64::from(of[index])).sum();
        sum / cell.len() as f64 * 1e6
    };
    let density = grid.values(density);
    let normal = grid.values(|cell| mean(&hits.normal_impulse, cell));
    let tangential = grid.values(|cell| mean(&hits.tangential_impulse, cell));
    let wanted = goals.normal_impulse * 1e6;
    let off = |value: &Option<f64>| value.map_or(0.0, |value| (value - wanted).abs());
    let least = goals.normal_impulse_tolerance.max(LEAST_TOLERANCE) * wanted;
    let half = normal.iter().map(off).fold(least, f64::max) * 1.05;
    let (limit, limit_mark) = limit(goals);
    let tangential_most = most(&tangential);
    [
        Map {
            title: if grid.is_one_place {
                "Hits, % of the shots, at one place"
            } else {
                "Hits, % of the shots per mm\u{b2}"
            },
            scale: 0.0..most(&density),
            values: density,
            gradient: colorous::CIVIDIS,
            marks: Vec::new(),
        },
        Map {
            title: "Mean N*, uN.s",
            values: normal,
            scale: wanted - half..wanted + half,
            gradient: colorous::PURPLE_ORANGE,
            marks: tolerance_marks(goals),
        },
        Map {
            title: "Mean f*, uN.s",
            scale: 0.0..limit
                .filter(|limit| *limit < 2.0 * tangential_most)
                .map_or(tangential_most, |limit| limit.max(tangential_most)),
            values: tangential,
            gradient: colorous::CIVIDIS,
            marks: limit_mark,
        },
    ]
}

fn most(values: &[Option<f64>]) -> f64 {
    let most = values.iter().flatten().copied().fold(0.0, f64::max);
    if most > 0.0 { most } else { 1.0 }
}

fn tolerance_marks(goals: &GoalsRecord) -> Vec<(f64, String)> {
    let wanted = goals.normal_impulse * 1e6;
    let tolerance = goals.normal_impulse_tolerance;
    vec![
        (wanted, "wanted".into()),
        (
            wanted * (1.0 - tolerance),
            format!("-{}", share_asked(tolerance)),
        ),
        (
            wanted * (1.0 + tolerance),
            format!("+{}", share_asked(tolerance)),
        ),
    ]
}

/// The limit of f*, uN.s.
fn limit(goals: &GoalsRecord) -> (Option<f64>, Vec<(f64, String)>) {
    let limit = goals.tangential_impulse.map(|limit| limit * 1e6);
    (
        limit,
        limit
            .map(|limit| (limit, "limit".into()))
            .into_iter()
            .collect(),
    )
}

impl Map {
    fn draw<'a, 'b>(
        &self,
        area: &'a Area<'b>,
        index: usize,
        grid: &Grid,
    ) -> Result<Plot<'a, 'b>, Fault> {
        let (left, top) = (LEFT[index], TOP[0]);
        let corners = [(left, top), (left + WIDTH, top + MAP_HEIGHT)];
        let axes = Axes {
            title: self.title,
            x: grid.x.clone(),
            x_name: "along (azimuth 0), mm",
            y: grid.y.clone(),
            y_name: "across (azimuth 90 deg), mm",
        };
        let plot = Plot::new(area, corners, &axes)?;
        self.cells(&plot, grid)?;
        self.bar(area, (left + WIDTH + BAR_APART, top))?;
        Ok(plot)
    }

    fn colour(&self, value: f64) -> RGBColor {
        let share = (value - self.scale.start) / (self.scale.end - self.scale.start);
        let colour = self.gradient.eval_continuous(share.clamp(0.0, 1.0));
        RGBColor(colour.r, colour.g, colour.b)
    }

    fn cells(&self, plot: &Plot, grid: &Grid) -> Drawn {
        for row in 0..grid.rows {
            for column in 0..grid.columns {
                let Some(value) = self.values[row * grid.columns + column] else {
                    continue;
                };
                let corner = |dx: usize, dy: usize| {
                    (
                        grid.x.start + (column + dx) as f64 * grid.side,
                        grid.y.start + (row + dy) as f64 * grid.side,
                    )
                };
                plot.rectangle([corner(0, 0), corner(1, 1)], self.colour(value).filled())?;
            }
        }
        Ok(())
    }

    /// The colours with their values, the marked ones by name.
    fn bar(&self, area: &Area, (left, top): Place) -> Drawn {
        const STEPS: i32 = 50;
        let (from, to) = (self.scale.start, self.scale.end);
        let height = |share: f64| top + MAP_HEIGHT - (share * f64::from(MAP_HEIGHT)).round() as i32;
        for step in 0..STEPS {
            let share = |step: i32| f64::from(step) / f64::from(STEPS);
            let value = from + (share(step) + share(1) / 2.0) * (to - from);
            let corners = [
                (left, height(share(step + 1))),
                (left + BAR_WIDTH, height(share(step))),
            ];
            area.draw(&Rectangle::new(corners, self.colour(value).filled()))?;
        }
        let frame = [(left, top), (left + BAR_WIDTH, top + MAP_HEIGHT)];
        area.draw(&Rectangle::new(frame, GHOST.stroke_width(2)))?;
        let style = styled(&letters(LABEL), INK, Pos::new(HPos::Left, VPos::Center));
        let right = left + BAR_WIDTH;
        let place = |value: f64| height((value - from) / (to - from));
        let mut taken: Vec<i32> = Vec::new();
        for (value, name) in self
            .marks
            .iter()
            .filter(|(value, _)| (from..=to).contains(value))
        {
            let y = place(*value);
            area.draw(&PathElement::new(
                vec![(left - 4, y), (right + 4, y)],
                INK.stroke_width(4),
            ))?;
            // On a wide scale the marks are all at one place; the first is the one that counts.
            if taken.iter().all(|other| (other - y).abs() > 28) {
                let text = format!("{} {name}", rounded(*value, 3));
                area.draw_text(&text, &style, (right + 10, y))?;
            }
            taken.push(y);
        }
        for value in ticks(from, to) {
            let y = place(value);
            if taken.iter().all(|other| (other - y).abs() > 28) {
                area.draw(&PathElement::new(
                    vec![(right, y), (right + 6, y)],
                    GHOST.stroke_width(2),
                ))?;
                area.draw_text(&plain(value), &style, (right + 10, y))?;
            }
        }
        Ok(())
    }
}

/// About five round values between two.
fn ticks(from: f64, to: f64) -> Vec<f64> {
    if to <= from {
        return Vec::new();
    }
    let power = 10_f64.powf(((to - from) / 5.0).log10().floor());
    let steps = [1.0, 2.0, 5.0, 10.0].map(|multiple| multiple * power);
    let step = steps.into_iter().find(|step| (to - from) / step <= 7.0);
    let step = step.unwrap_or(to - from);
    let first = (from / step).ceil() as i64;
    (first..)
        .map(|tick| tick as f64 * step)
        .take_while(|tick| *tick <= to)
        .collect()
}

/// How often a quantity has which value.
struct Histogram {
    title: &'static str,
    name: &'static str,
    values: Vec<f64>,
    marks: Vec<(f64, String, bool)>,
    /// What is said below the title.
    remark: String,
}

fn histograms(record: &Record, hits: &HitsRecord) -> [Histogram; 3] {
    let goals = &record.problem.goals;
    let impulses = |of: &[f32]| {
        of.iter()
            .map(|value| f64::from(*value) * 1e6)
            .collect::<Vec<f64>>()
    };
    let angles: Vec<f64> = hits
        .angle_deg
        .iter()
        .map(|angle| f64::from(*angle))
        .collect();
    let normal = impulses(&hits.normal_impulse);
    let tangential = impulses(&hits.tangential_impulse);
    let wanted = goals.normal_impulse * 1e6;
    let share_of = |values: &[f64], breaks: &dyn Fn(f64) -> bool| {
        let number = values.iter().filter(|value| breaks(**value)).count();
        share(number as f64 / values.len() as f64)
    };
    let tolerance = goals.normal_impulse_tolerance;
    let off = share_of(&normal, &|value| (value / wanted - 1.0).abs() > tolerance);
    let marks = tolerance_marks(goals).into_iter();
    let sticking = hits.sticks.iter().filter(|sticks| **sticks).count();
    [
        Histogram {
            title: "Angle between flight and surface",
            name: "angle, deg; 90 is perpendicular",
            remark: format!(
                "{} of these stick",
                share(sticking as f64 / hits.sticks.len().max(1) as f64)
            ),
            values: angles,
            marks: Vec::new(),
        },
        Histogram {
            title: "N*",
            name: "N*, uN.s",
            values: normal,
            remark: format!(
                "{off} off {} +- {}",
                impulse_asked(goals.normal_impulse),
                share_asked(tolerance)
            ),
            marks: marks
                .map(|(value, name)| (value, name.clone(), name != "wanted"))
                .collect(),
        },
        Histogram {
            title: "f*",
            name: "f*, uN.s",
            remark: goals.tangential_impulse.map_or_else(
                || "no limit".into(),
                |limit| {
                    let over = share_of(&tangential, &|value| value > limit * 1e6);
                    format!("{over} over {}", impulse_asked(limit))
                },
            ),
            values: tangential,
            marks: limit(goals)
                .1
                .into_iter()
                .map(|(value, name)| (value, name, false))
                .collect(),
        },
    ]
}

impl Histogram {
    fn draw(&self, area: &Area, index: usize) -> Drawn {
        let (left, top) = (LEFT[index], TOP[1]);
        let corners = [(left, top), (left + WIDTH + 90, top + HISTOGRAM_HEIGHT)];
        let lowest = self.values.iter().copied().fold(f64::INFINITY, f64::min);
        let highest = self
            .values
            .iter()
            .copied()
            .fold(f64::NEG_INFINITY, f64::max);
        let span = (highest - lowest).max(LEAST_SPAN * highest.abs()).max(1e-9);
        // Marks that are near are worth seeing.
        let near = |value: &f64| (lowest - span..=highest + span).contains(value);
        let marks = || self.marks.iter().map(|(value, ..)| *value).filter(near);
        let room = if marks().next().is_some() {
            ROOM_FOR_NAMES
        } else {
            ROOM
        } * span;
        let low = marks().fold(lowest, f64::min) - room;
        let high = marks().fold(highest, f64::max) + room;
        let width = (high - low) / BARS as f64;
        let mut counts = [0_usize; BARS];
        for value in &self.values {
            counts[(((value - low) / width) as usize).min(BARS - 1)] += 1;
        }
        let percent = |number: usize| number as f64 / self.values.len() as f64 * 100.0;
        let most = counts.into_iter().max().unwrap_or(1);
        let axes = Axes {
            title: self.title,
            x: low..high,
            x_name: self.name,
            y: 0.0..percent(most) * 1.25,
            y_name: "hits, %",
        };
        let plot = Plot::new(area, corners, &axes)?;
        for (bar, number) in counts
            .into_iter()
            .enumerate()
            .filter(|(_, number)| *number > 0)
        {
            let from = low + bar as f64 * width;
            let corners = [(from, 0.0), (from + width, percent(number))];
            plot.rectangle(corners, LOOKS[0].colour.filled())?;
        }
        for (value, name, is_dashed) in &self.marks {
            plot.mark(*value, name, *is_dashed)?;
        }
        let decimals = decimals_for(span, 3);
        let [from, to] = [lowest, highest].map(|value| fixed(value, decimals));
        let extent = if from == to {
            format!("all {from}")
        } else {
            format!("{from} to {to}")
        };
        let remark = format!("{extent}; {}", self.remark);
        let place = (left, top + HISTOGRAM_HEIGHT + 76);
        sheet::text(area, &remark, place, HPos::Left, &letters(LABEL), FAINT)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hits(places: &[[f32; 2]]) -> HitsRecord {
        HitsRecord {
            shots: places.len(),
            plane_m: places.to_vec(),
            ..HitsRecord::default()
        }
    }

    #[test]
    fn every_hit_lies_in_the_cell_round_it() {
        let places = [
            [-1e-3, 2e-3],
            [1e-3, -2e-3],
            [0.5e-3, 0.1e-3],
            [0.5e-3, 0.1e-3],
        ];
        let grid = Grid::new(&hits(&places));
        let mut found = 0;
        for (index, cell) in grid.cells.iter().enumerate() {
            let (column, row) = (index % grid.columns, index / grid.columns);
            for &hit in cell {
                let from_corner = |axis: usize, low: f64, number: usize| {
                    f64::from(places[hit][axis]) * 1e3 - low - number as f64 * grid.side
                };
                let [x, y] = [
                    from_corner(0, grid.x.start, column),
                    from_corner(1, grid.y.start, row),
                ];
                assert!((-1e-6..=grid.side).contains(&x) && (-1e-6..=grid.side).contains(&y));
                found += 1;
            }
        }
        assert_eq!(found, places.len());
    }

    #[test]
    fn hits_at_one_place_have_a_map_too() {
        let grid = Grid::new(&hits(&[[1e-3, 1e-3]; 5]));
        assert!(grid.side > 0.0);
        assert_eq!(
            grid.values(|cell| cell.len() as f64)
                .iter()
                .flatten()
                .sum::<f64>(),
            5.0
        );
        assert!(grid.is_one_place);
    }

    #[test]
    fn ticks_are_round_and_few() {
        assert!(ticks(1.0, 1.0).is_empty());
        assert_eq!(ticks(0.0, 65.0), [0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0]);
        assert_eq!(
            ticks(33.0, 47.0),
            [34.0, 36.0, 38.0, 40.0, 42.0, 44.0, 46.0]
        );
    }
}
