//! peenpose finds nozzle settings for precision shot peening deep inside keyways, bores and slots.
//!
//! A problem file says what the part looks like, what the jet is, what the target must receive and
//! what its neighbours may take. The answer is a pose, a speed and a contact, with what every
//! surface receives, how far each setting may drift, and what the model leaves out.
//!
//! # One door
//!
//! A [`study::Study`] is a problem file, checked, with its scene. It solves, evaluates settings, draws maps and measures
//! charts; what it finds is a [`record::Record`], and all reports are made from that.
//!
//! ```
//! use peenpose::control::Control;
//! use peenpose::study::{Extras, Study};
//!
//! let study = Study::open("problems/keyway.yaml".as_ref())?;
//! assert!(study.check().is_empty());
//! // Few shots are enough here; `Control::default()` is what the program uses.
//! let control = Control { most_shots: 256, validation_shots: 2048, ..Control::default() };
//! let record = study.solve(Extras::default(), &control).ok_or("no contact to choose")?;
//! assert!(record.passes());
//! // Steep enough to be gentle sideways, and just so flat that rebounds leave by the open end.
//! assert!((60.0..72.0).contains(&record.best.settings.incidence_deg));
//! println!("{}", peenpose::report::sheet(&record));
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
//! | [`control`] | what a run may spend, how it is watched and ended |
//! | [`checkpoint`] | work that is written down as it is done |
//! | [`unknowns`] | which of restitution and friction, where they are not known exactly, moves the result most |
//! | [`solve`] | the search over settings, how far each may drift, and the trade-off |
//! | [`map`] | the objective and the verdicts over two settings |
//! | [`warnings`] | what parses but can hardly be meant |
//! | [`validity`] | what the model leaves out at the answer |
//! | [`coverage`] | how densely first hits fall on the target, and how long until it is dented |
//! | [`evidence`] | what pictures of an answer are drawn from: shapes, flights, places |
//! | [`record`] | the complete result, JSON both ways |
//! | [`study`] | one door to all of it |
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
pub mod control;

pub mod unknowns;

pub mod solve;

pub mod map;

pub mod warnings;

pub mod validity;

pub mod coverage;
pub mod evidence;
pub mod stroke;

pub mod record;

pub mod chart;
pub mod study;

#[cfg(feature = "report")]
pub mod report;

#[cfg(feature = "campaign")]
pub mod atomic;
#[cfg(feature = "campaign")]
pub mod campaign;

/// The example of the library's chapter, which must run as well.
#[cfg(doctest)]
#[doc = include_str!("../docs/library.md")]
struct Chapter;
