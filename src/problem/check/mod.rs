//! What was written, checked as a whole: the file becomes a [`Problem`].
//!
//! Each function takes one group of keys and gives `None` where something in it is faulty; every
//! fault is on record then. All groups are looked at, so that all faults show up in one go.

mod calibration;
mod contacts;
mod coordinates;
mod goals;
mod limit;
mod mesh;
mod model;
mod nozzle;
mod profile;
mod scene;
mod scope;
mod settings;
mod shape;
mod surfaces;
mod target;
mod tolerance;

use std::path::Path;

use super::Problem;
use super::equipment::{CoverageWish, Jet, PathLimits, Shot, Spread};
use super::faults::Faults;
use super::field::Field;
use super::file::ProblemFile;
use super::file::equipment::{CoverageEntry, JetEntry, PathsEntry, ShotEntry, SpreadEntry};
use super::file::settings::SolveEntry;
use super::part::{Part, Target};
use coordinates::Coordinates;
use limit::Limit;
use scope::Scope;

/// What could be made of a file.
pub(super) struct Checked {
    pub scene: Option<Vec<Part>>,
    pub target: Option<Target>,
    pub problem: Option<Problem>,
}

/// Checks every group of the file; `path` is where it was read from.
pub(super) fn check(file: &ProblemFile, path: &Path, faults: &Faults<'_>) -> Checked {
    let root = Scope::root(faults);
    let folder = path.parent().unwrap_or(Path::new(""));

    let format = root
        .required("format", &file.format, "`format: 1`")
        .filter(|format| {
            let known = **format == 1;
            if !known {
                root.report(
                    root.fault("format", format!("format {format} is not known"))
                        .expecting("`format: 1`"),
                );
            }
            known
        });
    let coordinates = Coordinates::new(&root, &file.lengths_in);
    let scene = scene::check(&root, &file.scene, &coordinates, folder);
    let target = target::check(&root, &file.target, &scene, &coordinates);
    let shot = root
        .required("shot", &file.shot, "`{ radius: .., density: .. }`")
        .and_then(|entry| shot(&root.of("shot"), entry));
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
    let surfaces = surfaces::check(&root, &file.surfaces, &scene);
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
            title: title?,
            parts: parts?,
            target: target.clone()?,
            shot: shot?,
            jet: jet?,
            calibration: calibration?,
            nozzle: nozzle?,
            contacts: contacts.sound()?,
            settings: settings?,
            goals: goals?,
            surfaces: surfaces?,
            paths: paths?,
            coverage: coverage?,
            model: model?,
            tolerance: tolerance?,
            accuracy,
            seed,
        })
    };
    let problem = assemble();
    Checked {
        scene,
        target,
        problem,
    }
}

fn shot(scope: &Scope<'_>, entry: &ShotEntry) -> Option<Shot> {
    let radius = scope.needed("radius", &entry.radius, Limit::LENGTH);
    let density = scope.needed("density", &entry.density, Limit::DENSITY);
    let size_spread = scope.optional("size_spread", &entry.size_spread, Limit::SPREAD, 0.0);
    Some(Shot {
        radius: radius?,
        density: density?,
        size_spread: size_spread?,
    })
}

fn jet(scope: &Scope<'_>, entry: &JetEntry) -> Option<Jet> {
    let exit_diameter = scope.needed("exit_diameter", &entry.exit_diameter, Limit::LENGTH_OR_ZERO);
    let divergence = scope.needed("divergence", &entry.divergence, Limit::DIVERGENCE);
    let speed_spread = scope.optional("speed_spread", &entry.speed_spread, Limit::SPREAD, 0.0);
    let mass_flow = scope.maybe("mass_flow", &entry.mass_flow, Limit::MASS_FLOW);
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
    })
}

fn coverage(scope: &Scope<'_>, entry: &CoverageEntry) -> Option<CoverageWish> {
    let dent_diameter = scope.needed("dent_diameter", &entry.dent_diameter, Limit::LENGTH);
    let wanted = scope.optional("wanted", &entry.wanted, Limit::WANTED, 0.98);
    Some(CoverageWish {
        dent_diameter: dent_diameter?,
        wanted: wanted?,
    })
}

fn paths(scope: &Scope<'_>, entry: &PathsEntry) -> Option<PathLimits> {
    let impacts = entry.impacts.or(6).and_then(|impacts| {
        let sound = usize::try_from(impacts)
            .ok()
            .filter(|i| (1..=1000).contains(i));
        if sound.is_none() {
            scope.report(
                scope
                    .fault("impacts", format!("`{impacts}` is out of range"))
                    .expecting("a whole number from 1 to 1000"),
            );
        }
        sound
    });
    let least_energy = scope.optional("least_energy", &entry.least_energy, Limit::BELOW_ALL, 0.01);
    Some(PathLimits {
        impacts: impacts?,
        least_energy: least_energy?,
        shot_size: true,
        spin: true,
    })
}

fn solve(scope: &Scope<'_>, entry: &SolveEntry) -> Option<(f64, u64)> {
    let accuracy = scope.optional("accuracy", &entry.accuracy, Limit::ACCURACY, 0.01);
    let seed = entry.seed.or(1);
    Some((accuracy?, seed?))
}
