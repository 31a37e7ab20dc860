//! What was written, checked as a whole: the file becomes a [`Problem`].
//!
//! Each function takes one group of keys and gives `None` where something in it is faulty; every
//! fault is on record then. All groups are looked at, so that all faults show up in one go.

mod calibration;
mod contacts;
mod coordinates;
mod cut;
mod goals;
mod library;
mod mesh;
mod model;
mod nozzle;
mod profile;
mod scene;
mod scope;
mod settings;
mod shape;
mod shot;
mod stroke;
mod surfaces;
mod target;
mod tolerance;

use std::f64::consts::FRAC_PI_2;
use std::path::Path;

use super::Problem;
use super::equipment::{CoverageWish, Dent, FULL, Jet, PathLimits, Spread};
use super::fault_code::FaultCode;
use super::faults::Faults;
use super::field::Field;
use super::file::equipment::{CoverageEntry, JetEntry, PathsEntry, SpreadEntry};
use super::file::settings::SolveEntry;
use super::file::{FORMAT, ProblemFile};
use super::part::{Part, Target};
use super::stroke::Stroke;
use crate::elementary::sin;
use crate::printable;
use crate::problem::Limit;
use coordinates::Coordinates;
use scope::Scope;

/// What could be made of a file.
pub(super) struct Checked {
    pub scene: Option<Vec<Part>>,
    pub target: Option<Target>,
    pub surfaces: Vec<String>,
    pub problem: Option<Problem>,
}

/// Checks every group of the file; `path` is where it was read from.
pub(super) fn check(file: &ProblemFile, path: &Path, faults: &Faults<'_>) -> Checked {
    let root = Scope::root(faults);
    let folder = path.parent().unwrap_or(Path::new(""));

    let format = root
        .required("format", &file.format, "`format: 1`")
        .filter(|format| {
            let known = **format == FORMAT;
            if !known {
                root.report(
                    root.fault(
                        FaultCode::UnknownFormat,
                        "format",
                        format!("format {format} is not known"),
                    )
                    .expecting("`format: 1`"),
                );
            }
            known
        });
    let coordinates = Coordinates::new(&root, &file.lengths_in);
    let scene = scene::check(&root, &file.scene, &coordinates, folder);
    let stroke = match &file.stroke {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(entry) => stroke::check(&root.of("stroke"), entry, &coordinates).map(Some),
    };
    let target = target::check(&root, &file.target, &scene, &coordinates);
    let target = target.map(|target| aimed_at_stroke(target, stroke.as_ref()));
    let shot = root
        .required("shot", &file.shot, "`{ radius: .., density: .. }`")
        .and_then(|entry| shot::check(&root.of("shot"), entry));
    let jet = root
        .required("jet", &file.jet, "`{ exit_diameter: .., divergence: .. }`")
        .and_then(|entry| jet(&root.of("jet"), entry));
    let calibration = match file.jet.value() {
        Some(entry) => calibration::check(&root.of("jet").of("pressure"), &entry.pressure),
        None => Some(None),
    };
    let nozzle = file
        .nozzle
        .or(Default::default())
        .and_then(|entry| nozzle::check(&root.of("nozzle"), &entry));
    let contacts = contacts::check(&root, &file.contacts);
    let settings = root
        .required(
            "settings",
            &file.settings,
            "incidence, azimuth, standoff and speed",
        )
        .and_then(|entry| settings::check(&root.of("settings"), entry, &contacts));
    let goals = root
        .required("goals", &file.goals, "at least normal_impulse")
        .and_then(|entry| goals::check(&root.of("goals"), entry));
    let of_target = file.target.value().and_then(|entry| entry.surface.value());
    let surfaces = surfaces::check(&root, &file.surfaces, &scene, of_target);
    let paths = file
        .paths
        .or(Default::default())
        .and_then(|entry| paths(&root.of("paths"), &entry));
    let coverage = match &file.coverage {
        Field::Missing => Some(None),
        Field::Faulty => None,
        Field::Present(entry) => coverage(&root.of("coverage"), entry).map(Some),
    };
    let tolerance = file
        .tolerance
        .or(Default::default())
        .and_then(|entry| tolerance::check(&root.of("tolerance"), &entry, settings.as_ref()));
    let solve = file
        .solve
        .or(Default::default())
        .and_then(|entry| solve(&root.of("solve"), &entry));
    let model = model::check(&root, &file.model);
    let title = file.title.or(path
        .file_stem()
        .map_or_else(String::new, |stem| stem.to_string_lossy().into_owned()));

    let parts = scene.sound();
    let scene = parts.clone();
    let assemble = || {
        format?;
        let (accuracy, seed) = solve?;
        Some(Problem {
            title: printable::line(&title?).into_owned(),
            parts: parts?,
            target: target.clone()?,
            shot: shot?,
            jet: jet?,
            calibration: calibration?,
            nozzle: nozzle?,
            contacts: contacts.sound()?,
            ranges: settings?,
            goals: goals?,
            surfaces: surfaces?,
            paths: paths?,
            stroke: stroke?,
            coverage: coverage?,
            model: model?,
            tolerance: tolerance?,
            accuracy,
            seed,
        })
    };
    let problem = assemble();
    let rules = file.surfaces.value().into_iter().flat_map(|rules| &rules.0);
    Checked {
        scene,
        target,
        surfaces: rules.map(|(name, _)| name.clone()).collect(),
        problem,
    }
}

/// A target without an aim point is aimed at where its stroke begins.
fn aimed_at_stroke(target: Target, stroke: Option<&Option<Stroke>>) -> Target {
    let start = stroke
        .and_then(Option::as_ref)
        .and_then(|it| it.line.start());
    match (target.aim, start) {
        (None, Some((aim, aim_key))) => Target {
            aim: Some(aim),
            aim_key,
            ..target
        },
        _ => target,
    }
}

fn jet(scope: &Scope<'_>, entry: &JetEntry) -> Option<Jet> {
    let exit_diameter = scope.needed("exit_diameter", &entry.exit_diameter);
    let divergence = scope.needed("divergence", &entry.divergence);
    let speed_spread = scope.optional("speed_spread", &entry.speed_spread, 0.0);
    let mass_flow = scope.maybe("mass_flow", &entry.mass_flow);
    let air_speed = scope.maybe("air_speed", &entry.air_speed);
    let spread = entry
        .spread
        .or(SpreadEntry::Uniform)
        .map(|spread| match spread {
            SpreadEntry::Uniform => Spread::Uniform,
            SpreadEntry::Gaussian => Spread::Gaussian,
        });
    Some(Jet {
        exit_diameter: exit_diameter?,
        divergence: divergence?,
        spread: spread?,
        speed_spread: speed_spread?,
        mass_flow: mass_flow?,
        air_speed: air_speed?,
    })
}

fn coverage(scope: &Scope<'_>, entry: &CoverageEntry) -> Option<CoverageWish> {
    let dent = dent(scope, entry);
    let wanted = match &entry.wanted {
        Field::Present(wanted) if wanted.0 > 1.0 => scope.within("wanted", wanted.0, Limit::TIMES),
        wanted => scope.optional("wanted", wanted, FULL),
    };
    let (wanted, times) = match wanted? {
        times if times > 1.0 => (FULL, times),
        wanted => (wanted, 1.0),
    };
    Some(CoverageWish {
        dent: dent?,
        wanted,
        times,
    })
}

/// A diameter, one with the hit that left it, or the hardness from which it follows.
fn dent(scope: &Scope<'_>, entry: &CoverageEntry) -> Option<Dent> {
    if entry.hardness.is_given() {
        let hardness = scope.maybe("hardness", &entry.hardness)?;
        for (key, is_given) in [
            ("dent_diameter", entry.dent_diameter.is_given()),
            ("measured_at", entry.measured_at.is_given()),
        ] {
            if is_given {
                let fault = scope.fault(FaultCode::EitherOr, key, "stands beside `hardness`");
                scope.report(fault.expecting("only one of dent_diameter, hardness"));
                return None;
            }
        }
        return hardness.map(Dent::Hardness);
    }
    let diameter = scope.needed_here("dent_diameter", &entry.dent_diameter);
    let Field::Present(at) = &entry.measured_at else {
        return match entry.measured_at {
            Field::Faulty => None,
            _ => Some(Dent::Diameter(diameter?)),
        };
    };
    let hit = scope.of("measured_at");
    let speed = hit.needed("speed", &at.speed);
    let incidence = hit.optional("incidence", &at.incidence, FRAC_PI_2);
    Some(Dent::Measured {
        diameter: diameter?,
        normal_speed: speed? * sin(incidence?),
    })
}

fn paths(scope: &Scope<'_>, entry: &PathsEntry) -> Option<PathLimits> {
    let impacts = scope.optional("impacts", &entry.impacts, 6.0);
    let least_energy = scope.optional("least_energy", &entry.least_energy, 0.01);
    Some(PathLimits {
        impacts: impacts? as usize,
        least_energy: least_energy?,
        shot_size: true,
        spin: true,
        exit_width: true,
    })
}

fn solve(scope: &Scope<'_>, entry: &SolveEntry) -> Option<(f64, u64)> {
    let accuracy = scope.optional("accuracy", &entry.accuracy, 0.01);
    let seed = entry.seed.or(1);
    Some((accuracy?, seed?))
}
