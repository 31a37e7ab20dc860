//! peenpose finds nozzle settings for precision shot peening deep inside keyways, bores and slots.
//!
//! A problem file says what the part looks like, what the jet is, what the target must receive and
//! what its neighbours may take. The answer is a pose, a speed and a contact, with what every
//! surface receives, how far each setting may drift, and what the model leaves out.
//!
//! # The pipeline
//!
//! Data flows one way: a text becomes a checked [`problem::Problem`], that with its scene a
//! [`scenario::Scenario`], the search of that a [`solve::Solution`], that a [`record::Record`], and all
//! reports are made from the record.
//!
//! ```
//! use std::path::Path;
//!
//! use peenpose::record::{Circumstances, Record, WorkRecord};
//! use peenpose::scene::Walls;
//! use peenpose::setup::Setup;
//! use peenpose::solve::{Control, passing_windows, solve};
//! use peenpose::unknowns::Unknowns;
//! use peenpose::{problem, report, validity};
//!
//! // What is asked. In a file it is the same text; `Scenario::load` reads one and builds its scene.
//! let text = "
//! format: 1
//! title: Floor of a keyway
//! lengths_in: mm
//! scene:
//!   hub: { keyway: { bore: 30 mm, width: 8 mm, depth: 3.3 mm, length: 40 mm } }
//! target: { surface: hub.floor, within: { min: [-3, 18, 15], max: [3, 19, 25] } }
//! shot: { radius: 0.5 mm, density: 7000 kg/m3 }
//! jet: { exit_diameter: 1.5 mm, divergence: 4 deg, speed_spread: 5 % }
//! contacts:
//!   oiled: { mu_s: 0.06, mu_d: 0.054, restitution: 0.25 }
//! settings:
//!   incidence: [45 deg, 85 deg]
//!   azimuth: 0 deg
//!   standoff: 8 mm
//!   speed: [5 m/s, 40 m/s]
//! goals:
//!   normal_impulse: { target: 40 uN.s, tolerance: 15 % }
//!   rebound: { allow: 10 uN.s }
//! tolerance: { incidence: 2 deg }
//! ";
//! let reading = problem::read_text(text, Path::new("floor.yaml"))?;
//! let source = reading.source;
//! let Some(problem) = reading.problem else {
//!     panic!("{}", problem::render(&source, &reading.faults, false));
//! };
//!
//! // What is there: the scene, its target patch, and what each surface may take.
//! let setup = Setup::new(problem, Walls::Exact).map_err(|faults| faults[0].to_string())?;
//! assert_eq!(setup.scene.surfaces()[setup.target.surface as usize], "hub.floor");
//!
//! // The search. A few shots are enough here; `Control::default()` is what the program uses.
//! let control = Control { most_shots: 1024, fresh_shots: 4096, ..Control::default() };
//! let solution = solve(&setup, &control);
//! let best = &solution.answers[0];
//! assert!(best.passes());
//! // Steep enough to be gentle sideways, and just so flat that rebounds leave by the open end.
//! assert!((60.0..72.0).contains(&best.choice.incidence.to_degrees()));
//!
//! // The complete result, and the sheet for the shop.
//! let circumstances = Circumstances {
//!     ablations: &solution.ablations,
//!     source: &source,
//!     status: solution.status.into(),
//!     command: "peenpose solve floor.yaml".into(),
//!     work: WorkRecord {
//!         poses: solution.poses,
//!         shots_per_pose: solution.shots_per_pose,
//!         rays: solution.rays,
//!         seconds: 0.0,
//!     },
//! };
//! let windows = passing_windows(&setup, &solution);
//! let notes = validity::notes(&setup, &best.choice, best.evaluation.as_ref());
//! let unknowns = Unknowns::of(&setup, &best.choice);
//! let record = Record::new(&setup, &solution.answers, &windows, notes, unknowns, circumstances)
//!     .ok_or("no contact to choose")?;
//! assert_eq!(Record::from_json(&record.to_json()?)?, record);
//! println!("{}", report::sheet(&record));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # The modules, in reading order
//!
//! | module | what it holds |
//! |---|---|
//! | [`elementary`] | sines, logarithms, powers with the same bits on every machine |
//! | [`digits`] | numbers in texts: five significant digits at most |
//! | [`printable`] | text from elsewhere, made safe to show |
//! | [`units`] | `0.5 mm` to SI: the only conversions |
//! | [`impact`] | one impact of a sphere on a surface: the contact laws |
//! | [`problem`] | what was asked: problem files, their schema, the library, and the faults of a check |
//! | [`scene`] | what is there: walls, meshes, the target patch; rays and clearances |
//! | [`scenario`] | a problem together with its scene |
//! | [`jet`] | what comes out of the nozzle: its pose, and the shots |
//! | [`feasibility`] | whether the nozzle can be where settings put it |
//! | [`trace`] | shots through the scene, impact by impact |
//! | [`objective`] | impacts to terms to J, and the best speed |
//! | [`evaluate`] | what settings do, on shots that nothing was tuned on |
//! | [`verdict`] | whether that passes, goal by goal |
//! | [`checkpoint`] | work that is written down as it is done |
//! | [`unknowns`] | which of restitution and friction, where they are not known exactly, moves the result most |
//! | [`solve`] | the search over settings, how far each may drift, and the trade-off |
//! | [`map`] | the objective and the verdicts over two settings |
//! | [`warnings`] | what parses but can hardly be meant |
//! | [`validity`] | what the model leaves out at the answer |
//! | [`coverage`] | how densely first hits fall on the target, and how long until it is dented |
//! | [`evidence`] | what pictures of an answer are drawn from: shapes, flights, places |
//! | [`record`] | the complete result, JSON both ways |
//! | [`chart`] | speed against accuracy, measured on the problem at hand |
//! | [`report`] | sheet, page, tables, figures and exports, made from a record or a chart alone |
//!
//! Everything is in SI units and radians except where a name says otherwise. `docs/model.md` holds
//! the model with its equations, `docs/problem-file.md` every key of a problem file.

#![forbid(unsafe_code)]
#![warn(missing_docs)]
// Results have the same bits on every machine.
#![cfg_attr(not(test), warn(clippy::disallowed_methods))]

// In reading order: a module builds on those above it.

mod content;
pub mod digits;
pub mod elementary;
pub mod printable;
mod triple;
pub mod units;

pub mod impact;
pub mod problem;
pub mod scenario;
pub mod scene;

pub mod feasibility;
pub mod jet;
pub mod trace;

pub mod objective;

pub mod evaluate;
pub mod verdict;

pub mod checkpoint;

pub mod unknowns;

pub mod solve;

pub mod map;

pub mod warnings;

pub mod validity;

pub mod coverage;
pub mod evidence;

pub mod record;

pub mod chart;

#[cfg(feature = "report")]
pub mod report;

/// The example of the README, which must run as well.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
