//! Strokes in a record.

use nalgebra::Vector4;
use serde::{Deserialize, Serialize};

use super::answer::{PoseRecord, SettingsRecord, VerdictRecord, subject_name};
use crate::coverage::Dose;
use crate::problem::stroke::{Leg, Line};
use crate::scenario::Scenario;
use crate::solve::Answer;
use crate::stroke::{Program, Spot};
use crate::units::degrees;

/// Attitudes whose quaternions have this much less than 1 in common are the same, within 1e-5 rad.
const ALIKE: f64 = 1e-11;

/// A stroke: where the nozzle travels, how fast, and what that gives.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrokeRecord {
    /// Length on the part between the ends, m.
    pub length_m: f64,
    /// Turns of the part from the first waypoint to the last; 0 for a line.
    pub turns: f64,
    /// How far the aim point travels beyond the ends, m: the longer way of both.
    pub run_out_m: f64,
    /// That beyond the beginning, and that beyond the end.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub run_outs: Option<[RunOutRecord; 2]>,
    /// Between which places the same settings hold.
    pub segments: Vec<SegmentRecord>,
    /// What each station receives, where the nozzle stands still.
    pub stations: Vec<StationRecord>,
    /// Poses from one end of the run-out to the other.
    pub waypoints: Vec<WaypointRecord>,
    /// Passes; absent where the feed is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub passes: Option<u32>,
    /// Speed of the spot over the part, m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_m_s: Option<f64>,
    /// Its standard error where it follows from the wanted coverage, m/s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub feed_standard_error_m_s: Option<f64>,
    /// Turns of the part, 1/s; absent for a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub turns_per_s: Option<f64>,
    /// Time of all passes, s.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub time_s: Option<f64>,
    /// Keys that are missing for a feed.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub missing: Vec<String>,
    /// What all passes together dent; absent where the feed or the dent is not known.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dented: Option<StrokeDentedRecord>,
    /// How often surfaces that should be spared are hit in all; none where the feed is not known.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub doses: Vec<DoseRecord>,
    /// The same on a map.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dented_map: Option<DentedMapRecord>,
    /// The axis round which the part turns; absent for a line.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub axis: Option<TurnAxisRecord>,
}

/// The way of the aim point beyond an end of a stroke.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RunOutRecord {
    /// Its length, m.
    pub length_m: f64,
    /// The length at which the whole spot has passed the end of the target, m; or what was asked for.
    pub wanted_m: f64,
    /// The verdict that fails farther out, where it is shorter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub limited_by: Option<String>,
}

/// A piece of a stroke with the same settings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SegmentRecord {
    /// Where it begins, from the beginning of the stroke, m.
    pub from_m: f64,
    /// Where it ends, m.
    pub to_m: f64,
    /// Name of the contact.
    pub contact: String,
    /// Settings.
    pub settings: SettingsRecord,
}

/// A station of a stroke.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StationRecord {
    /// From the beginning of the stroke, m.
    pub at_m: f64,
    /// The aim point, m.
    pub aim_m: [f64; 3],
    /// One verdict for each goal and each secondary surface.
    pub verdicts: Vec<VerdictRecord>,
}

/// A pose that the nozzle passes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WaypointRecord {
    /// How far the spot has travelled from the beginning of the stroke, m; below 0 in the run-out before it.
    pub at_m: f64,
    /// The pose in the machine: in the part's coordinates where it does not turn.
    pub pose: PoseRecord,
    /// By how much the part is turned then, deg; 0 for a line.
    pub turn_deg: f64,
}

/// What a stroke dents of the target.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct StrokeDentedRecord {
    /// Mass of shot that is fired, kg.
    pub mass_kg: f64,
    /// Mean share of the area.
    pub mean: f64,
    /// Its standard error.
    #[serde(default)]
    pub mean_standard_error: f64,
    /// Bound of its error by the size of cells.
    #[serde(default)]
    pub mean_resolution: f64,
    /// The least share, of the cells of the target.
    pub least: f64,
    /// Its standard error.
    #[serde(default)]
    pub least_standard_error: f64,
    /// The largest.
    pub most: f64,
}

/// How often a stroke hits a surface that should be spared, all impacts counted.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DoseRecord {
    /// Full name of the surface.
    pub surface: String,
    /// Hits per area where they are densest, 1/m2.
    pub most_hits_m2: f64,
    /// Its standard error, 1/m2.
    pub standard_error_m2: f64,
    /// Side of the cells over which that is looked at, m.
    pub cell_side_m: f64,
}

/// A map of what a stroke dents, unrolled where it goes round an axis.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct DentedMapRecord {
    /// Where its first cell begins: along the stroke from its beginning, and across it, m.
    pub corner_m: [f64; 2],
    /// Sides of a cell, along and across, m.
    pub sides_m: [f64; 2],
    /// Cells along the stroke.
    pub columns: usize,
    /// Share that is dented of each, row by row from the lowest place across; nothing beside the target.
    pub dented: Vec<Option<f32>>,
}

/// The axis round which a part turns.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct TurnAxisRecord {
    /// A point of it, m.
    pub through_m: [f64; 3],
    /// Unit vector along it.
    pub axis: [f64; 3],
}

/// Where first hits fall while the nozzle stands still.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct SpotRecord {
    /// In which 95 % of them fall, along the jet's heading, m.
    pub length_m: f64,
    /// The same across it, m.
    pub width_m: f64,
    /// Its area over that of the target; at most 1.
    pub share_of_target: f64,
}

impl SpotRecord {
    pub(super) fn new(spot: &Spot) -> Self {
        Self {
            length_m: spot.length,
            width_m: spot.width,
            share_of_target: spot.share_of_target,
        }
    }
}

impl DoseRecord {
    fn all(scenario: &Scenario, program: &Program) -> Vec<Self> {
        let fired = program.dented.zip(program.coverage.as_ref());
        let Some((dented, coverage)) = fired else {
            return Vec::new();
        };
        let shots = dented.mass * coverage.shots_per_kilogram;
        let record = |dose: &Dose| Self {
            surface: scenario.scene.surfaces()[dose.surface as usize].clone(),
            most_hits_m2: dose.most * shots,
            standard_error_m2: dose.standard_error * shots,
            cell_side_m: dose.side,
        };
        program.doses.iter().map(record).collect()
    }
}

impl DentedMapRecord {
    /// The middle of the cell that is dented least, along and across, m, and its share.
    pub fn least(&self) -> Option<([f64; 2], f64)> {
        let cells = self.dented.iter().enumerate();
        let known = cells.filter_map(|(index, share)| Some((index, (*share)?)));
        let (index, share) = known.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let steps = [index % self.columns, index / self.columns];
        let middle =
            [0, 1].map(|it| self.corner_m[it] + (steps[it] as f64 + 0.5) * self.sides_m[it]);
        Some((middle, f64::from(share)))
    }

    fn new(program: &Program) -> Option<Self> {
        let coverage = program.coverage.as_ref()?;
        let map = coverage.map.as_ref()?;
        let mass = program.dented?.mass;
        let share = |density: f64| coverage.share_dented(density, mass) as f32;
        // Four digits are enough for a picture.
        let short = |share: f32| (share * 1e4).round() / 1e4;
        Some(Self {
            corner_m: map.corner,
            sides_m: map.sides,
            columns: map.columns,
            dented: map
                .density
                .iter()
                .map(|density| density.map(|it| short(share(it))))
                .collect(),
        })
    }
}

impl StrokeRecord {
    /// Whether the nozzle or the part turns while settings are held.
    pub fn turns_on_the_way(&self) -> bool {
        let turns = |segment: &SegmentRecord| {
            let held = |it: &&WaypointRecord| it.at_m >= segment.from_m && it.at_m <= segment.to_m;
            let mut attitudes = self.waypoints.iter().filter(held).map(|it| {
                let [x, y, z, w] = it.pose.quaternion_xyzw;
                Vector4::new(x, y, z, w)
            });
            let first = attitudes.next();
            // Either sign is the same attitude; waypoints are rounded.
            first.is_some_and(|first| attitudes.any(|it| it.dot(&first).abs() < 1.0 - ALIKE))
        };
        self.turns != 0.0 || self.segments.iter().any(turns)
    }

    /// The record of a program and of the answer behind it; `None` for a spot.
    pub(super) fn new(scenario: &Scenario, answer: &Answer, program: &Program) -> Option<Self> {
        let traverse = scenario.traverse.as_ref()?;
        let segment = |leg: &Leg| SegmentRecord {
            from_m: traverse.travelled(leg.span[0]),
            to_m: traverse.travelled(leg.span[1]),
            contact: scenario.problem.contacts[leg.settings.contact].name.clone(),
            settings: SettingsRecord::new(&leg.settings),
        };
        let stations = answer.stations.iter().map(|station| StationRecord {
            at_m: traverse.travelled(station.place),
            aim_m: traverse.frame_at(station.place).aim.coords.into(),
            verdicts: station
                .verdicts
                .iter()
                .map(|verdict| VerdictRecord::new(scenario, verdict))
                .collect(),
        });
        let waypoints = program.waypoints.iter().map(|waypoint| WaypointRecord {
            at_m: waypoint.travelled,
            pose: PoseRecord::new(&waypoint.pose),
            turn_deg: degrees(waypoint.turn),
        });
        let turns_per_s = program
            .feed
            .filter(|_| program.turns > 0.0)
            .map(|feed| feed * program.turns / program.way());
        let [before, after] = program.run_outs;
        Some(Self {
            length_m: program.length,
            turns: program.turns,
            run_out_m: before.length.max(after.length),
            run_outs: Some(program.run_outs.map(|it| RunOutRecord {
                length_m: it.length,
                wanted_m: it.wanted,
                limited_by: it.limit.map(|limit| subject_name(scenario, limit)),
            })),
            segments: program.legs.iter().map(segment).collect(),
            stations: stations.collect(),
            waypoints: waypoints.collect(),
            passes: program.passes,
            feed_m_s: program.feed,
            feed_standard_error_m_s: program.feed_error,
            turns_per_s,
            time_s: program.time(),
            missing: program.missing.iter().map(|&key| key.to_owned()).collect(),
            dented: program.dented.map(|dented| StrokeDentedRecord {
                mass_kg: dented.mass,
                mean: dented.mean.value,
                mean_standard_error: dented.mean.standard_error,
                mean_resolution: dented.mean.resolution,
                least: dented.least,
                least_standard_error: dented.least_error,
                most: dented.most,
            }),
            doses: DoseRecord::all(scenario, program),
            dented_map: DentedMapRecord::new(program),
            axis: match &scenario.problem.stroke.as_ref()?.line {
                Line::Around(helix) => Some(TurnAxisRecord {
                    through_m: helix.through.coords.into(),
                    axis: helix.axis.into(),
                }),
                Line::Straight(_) | Line::Points(_) => None,
            },
        })
    }

    /// A place of the stroke in words: `z = 5 mm` where only z changes, or the point.
    pub fn place(&self, at_m: f64) -> String {
        let first = self.stations.first();
        let changes = |axis: &usize| {
            let start = first.map_or(0.0, |station| station.aim_m[*axis]);
            let mut stations = self.stations.iter();
            stations.any(|station| (station.aim_m[*axis] - start).abs() > SAME)
        };
        let axes: Vec<usize> = (0..3).filter(changes).collect();
        let here = self.stations.iter().min_by(|a, b| {
            let off = |station: &StationRecord| (station.at_m - at_m).abs();
            off(a).total_cmp(&off(b))
        });
        let Some(station) = here else {
            return format!("{} mm from its beginning", tidy(at_m * 1e3));
        };
        let [x, y, z] = station.aim_m.map(|it| tidy(it * 1e3));
        match axes[..] {
            [axis] => format!("{} = {} mm", ["x", "y", "z"][axis], [x, y, z][axis]),
            _ => format!("[{x}, {y}, {z}] mm"),
        }
    }
}

/// Coordinates that differ by less are the same, m.
const SAME: f64 = 1e-9;

fn tidy(millimetres: f64) -> f64 {
    (millimetres * 1e3).round() / 1e3
}
