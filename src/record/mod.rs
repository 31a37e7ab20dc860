//! The complete result of a run, as `result.json` holds it: all reports are made from it alone.
//!
//! Angles are in degrees, everything else is SI, and every key ends with its unit.

mod answer;
mod check;
mod coverage;
mod evidence;
mod fault;
mod front;
mod json;
mod library;
mod map;
mod model;
mod question;
mod receipt;
mod room;
mod stroke;
mod unknowns;
mod window;

pub use answer::{
    AnswerRecord, ContactRecord, ObjectiveRecord, PoseRecord, SettingsRecord, VerdictRecord,
};
pub use coverage::{CoverageRecord, DensityRecord, DentedRecord, DentsFromRecord, EstimateRecord};
pub use evidence::{
    AxisRecord, BodyRecord, CellRecord, EvidenceRecord, FrameRecord, HitsRecord, MapRecord,
    PathImpactRecord, PathRecord, PlaceRecord, ReboundsRecord, RoleRecord, SurfaceShapeRecord,
};
pub use fault::RecordFault;
pub(crate) use fault::read_json;
pub use front::FrontRecord;
pub use library::{LibraryContactRecord, MediumRecord, OriginRecord};
pub use map::MapTerm;
pub use model::{EffectRecord, ModelRecord};
pub use question::{CalibrationRecord, GoalsRecord, QuestionRecord, RangeRecord, ToleranceRecord};
pub use receipt::{ReceiptRecord, SpreadRecord, TargetRecord};
pub use stroke::{
    DentedMapRecord, DoseRecord, RunOutRecord, SegmentRecord, SpotRecord, StationRecord,
    StrokeDentedRecord, StrokeRecord, TurnAxisRecord, WaypointRecord,
};
pub use unknowns::{
    OutcomeRecord, QuantityRecord, ShareRecord, UnknownRangeRecord, UnknownsRecord,
};
pub use window::{DriftRecord, WindowRecord};

use std::collections::BTreeMap;
use std::path::Path;

use serde::{Deserialize, Serialize};

use crate::control::Control;
use crate::coverage::Coverage;
use crate::evidence::{Evidence, SHOTS, least_dented};
use crate::map::standard_maps;
use crate::printable;
use crate::problem::Source;
use crate::problem::setting::Settings;
use crate::problem::stroke::Leg;
use crate::scenario::Scenario;
use crate::scene::MeshSource;
use crate::solve::{Ablation, Answer, Segment, Status, Window};
use crate::stroke::{Program, Spot};
use crate::unknowns::Unknowns;
use crate::validity::Note;

/// Bytes of the largest `result.json` that is read.
pub const LARGEST_FILE: u64 = 500_000_000;

/// The SHA-256 of every mesh file of a scene, by its name as in the problem file.
pub fn mesh_sha256(scenario: &Scenario, source: &Source) -> BTreeMap<String, String> {
    let named = |file: &MeshSource| (mesh_name(&source.path, &file.path), file.sha256.clone());
    scenario.scene.mesh_files().iter().map(named).collect()
}

/// What a mesh file is called in the results of a problem file.
pub(crate) fn mesh_name(problem: &Path, mesh: &Path) -> String {
    let folder = problem.parent().unwrap_or(Path::new(""));
    let name = mesh.strip_prefix(folder).unwrap_or(mesh);
    printable::line(&name.display().to_string()).into_owned()
}

/// The result of a search.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// How the search ended.
    pub status: StatusRecord,
    /// By how much finalists of independent searches differ in J, relative to the best one; absent where nothing
    /// was searched, and in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spread: Option<f64>,
    /// What ranks the choices; absent where nothing was searched, and in results of older versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub ranking: Option<RankingRecord>,
    /// What was asked.
    pub problem: QuestionRecord,
    /// The recommended settings.
    pub best: AnswerRecord,
    /// How far each setting may drift alone before a verdict turns.
    pub windows: Vec<WindowRecord>,
    /// The best settings of each contact, best first.
    pub choices: Vec<AnswerRecord>,
    /// The trade-off between target error, tangential risk and rebound, from the least target error
    /// on; empty where it was not asked for.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub front: Vec<FrontRecord>,
    /// The model that was asked for, and what each effect does.
    #[serde(default)]
    pub model: ModelRecord,
    /// What was left out.
    pub notes: Vec<NoteRecord>,
    /// What restitution and friction do at the ends of their ranges; absent where they are known.
    #[serde(default)]
    pub unknowns: Option<UnknownsRecord>,
    /// How densely hits fall on the target; absent where the problem does not ask for it, or the
    /// nozzle does not fit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub coverage: Option<CoverageRecord>,
    /// Where first hits fall while the nozzle stands still; absent where hardly any shot hits, and in results of older
    /// versions.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub spot: Option<SpotRecord>,
    /// The stroke; absent for a spot, or where the nozzle does not fit.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stroke: Option<StrokeRecord>,
    /// What pictures are drawn from; absent where none were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub evidence: Option<EvidenceRecord>,
    /// Work done.
    pub work: WorkRecord,
    /// Checksum of the problem file.
    pub problem_sha256: String,
    /// Checksums of the mesh files, by their names as in the problem file; none in results of older versions.
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub mesh_sha256: BTreeMap<String, String>,
    /// Version of the program.
    pub version: String,
    /// The command that gives the same answer again.
    pub command: String,
}

/// See [`Status`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum StatusRecord {
    /// The accuracy asked for was reached: finalists of independent searches agree.
    Converged,
    /// The best settings that were found; finalists differ, or J was not certain. In results of older
    /// versions it is called `budget_spent`.
    #[serde(alias = "budget_spent")]
    BestFound,
    /// The nozzle collides with the part everywhere.
    NoFeasiblePose,
    /// The search was asked to stop.
    Interrupted,
    /// Given settings were evaluated; nothing was searched.
    Evaluated,
}

/// What ranks the choices.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RankingRecord {
    /// The best settings pass; those that pass rank by J.
    Passing,
    /// No settings were found that pass: the least violation ranks first, then J.
    LeastViolation,
}

/// Work done.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WorkRecord {
    /// Poses tried.
    pub poses: usize,
    /// Shots at each pose in the last stage of the search.
    pub shots_per_pose: usize,
    /// Rays cast.
    pub rays: usize,
    /// Wall time, s.
    pub seconds: f64,
}

/// See [`Note`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct NoteRecord {
    /// A short fixed name.
    pub name: String,
    /// The number behind it.
    pub value: f64,
    /// For people.
    pub text: String,
}

impl From<Note> for NoteRecord {
    fn from(note: Note) -> Self {
        Self {
            name: note.name.into(),
            value: note.value,
            text: note.text,
        }
    }
}

impl From<Status> for StatusRecord {
    fn from(status: Status) -> Self {
        match status {
            Status::Converged => Self::Converged,
            Status::BestFound => Self::BestFound,
            Status::NoFeasiblePose => Self::NoFeasiblePose,
            Status::Interrupted => Self::Interrupted,
        }
    }
}

/// What a record says besides the answers.
pub struct RunInfo<'a> {
    /// The problem file.
    pub source: &'a Source,
    /// How the run ended.
    pub status: StatusRecord,
    /// By how much finalists differ, where settings were searched.
    pub spread: Option<f64>,
    /// The command that gives the same answer again.
    pub command: String,
    /// Segments of a stroke with settings of their own; none for a spot, or where one setting holds.
    pub segments: &'a [Segment],
    /// What each effect of the model does, as far as that was measured.
    pub ablations: &'a [Ablation],
    /// Work done.
    pub work: WorkRecord,
}

/// The legs of segments, or one all along.
fn legs(segments: &[Segment], settings: &Settings) -> Vec<Leg> {
    match segments.is_empty() {
        true => vec![Leg::whole(settings)],
        false => segments.iter().map(Segment::leg).collect(),
    }
}

impl Record {
    /// The record of some answers, best first; `None` when there is none.
    pub fn new(
        scenario: &Scenario,
        answers: &[Answer],
        windows: &[Window],
        notes: Vec<Note>,
        unknowns: Option<Unknowns>,
        run: RunInfo,
    ) -> Option<Self> {
        let choices: Vec<AnswerRecord> = answers
            .iter()
            .map(|answer| AnswerRecord::new(scenario, answer))
            .collect();
        let best = answers.first()?;
        let fits = best.evaluation.is_some();
        let program = fits
            .then(|| Program::of(scenario, &legs(run.segments, &best.settings)))
            .flatten();
        let coverage = match &program {
            Some(program) => program.coverage.clone(),
            None if fits => Coverage::of(scenario, &best.settings),
            None => None,
        };
        let spot = fits.then(|| Spot::of(scenario, &best.settings)).flatten();
        Some(Self {
            status: run.status,
            spread: run.spread,
            ranking: run.spread.map(|_| match best.passes() {
                true => RankingRecord::Passing,
                false => RankingRecord::LeastViolation,
            }),
            problem: QuestionRecord::new(&scenario.problem, run.source),
            best: choices.first()?.clone(),
            windows: windows
                .iter()
                .map(|window| WindowRecord::new(scenario, window))
                .collect(),
            choices,
            front: Vec::new(),
            model: ModelRecord::new(scenario, run.ablations),
            notes: notes.into_iter().map(NoteRecord::from).collect(),
            unknowns: unknowns.map(|unknowns| UnknownsRecord::new(scenario, &unknowns)),
            coverage: coverage.as_ref().map(CoverageRecord::new),
            spot: spot.as_ref().map(SpotRecord::new),
            stroke: program
                .as_ref()
                .and_then(|program| StrokeRecord::new(scenario, best, program)),
            evidence: None,
            work: run.work,
            problem_sha256: run.source.sha256.clone(),
            mesh_sha256: mesh_sha256(scenario, run.source),
            version: env!("CARGO_PKG_VERSION").into(),
            command: printable::line(&run.command).into_owned(),
        })
    }

    /// The record as JSON text: a line for each key, lists of numbers on one line.
    ///
    /// # Errors
    /// None is expected: every number in a record is finite.
    pub fn to_json(&self) -> Result<String, serde_json::Error> {
        json::text(self)
    }

    /// Reads a record back. What it concludes is concluded again: nothing is shown that its own numbers
    /// contradict.
    ///
    /// # Errors
    /// When the text is not a record, one of a newer version of the program, or contradicts itself.
    pub fn from_json(text: &str) -> Result<Self, RecordFault> {
        let record: Self = read_json(text)?;
        check::record(&record)?;
        Ok(record)
    }

    /// The same with what the pictures of the best settings are drawn from; `best` is the first
    /// of the answers behind it. After a request to end there are fewer flights, maps of which nothing is
    /// known are left out, and the others have blanks.
    #[must_use]
    pub fn with_evidence(self, scenario: &Scenario, best: &Answer, control: &Control) -> Self {
        let fits = best.evaluation.is_some();
        let shots = if fits { SHOTS } else { 0 };
        let shown = Evidence::of(scenario, &best.settings, shots, &control.cancel);
        let mut evidence = EvidenceRecord::new(scenario, &best.settings, &shown);
        let map = self.stroke.as_ref().and_then(|it| it.dented_map.as_ref());
        let least = map.and_then(DentedMapRecord::least);
        let least = least.and_then(|(at, share)| least_dented(scenario, at, share));
        let least = least.map(|place| PlaceRecord::new(scenario, &place));
        evidence.places.extend(least);
        let maps = standard_maps(scenario, &best.settings, control);
        let maps = maps.iter().map(|map| MapRecord::new(scenario, map));
        evidence.maps = maps.filter(|map| map.known_places() > 0).collect();
        Self {
            evidence: Some(evidence),
            ..self
        }
    }

    /// Whether every verdict on the best settings passes.
    pub fn passes(&self) -> bool {
        self.best.passes
    }
}
