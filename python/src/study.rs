//! Problems: read, checked, changed, solved.

use std::path::PathBuf;

use peenpose::control::Control;
use peenpose::map::Axis;
use peenpose::problem::change::{Change, Template};
use peenpose::problem::fault::{Fault, Span};
use peenpose::problem::given::{Incomplete, PartialSettings};
use peenpose::problem::setting::{Range, Setting, Settings};
use peenpose::problem::warning::Warning;
use peenpose::problem::{self, given};
use peenpose::record::MapRecord;
use peenpose::report;
use peenpose::scenario::Rejection;
use peenpose::study::{self, Extras};
use pyo3::exceptions::{PyTypeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::record::Record;
use crate::watched::watched;

/// A fault for Python: line, column, key, message, what is expected, the nearest valid name.
pub type FaultTuple = (
    Option<usize>,
    Option<usize>,
    String,
    String,
    Option<String>,
    Option<String>,
);

fn fault(fault: &Fault) -> FaultTuple {
    let at = |part: fn(&Span) -> usize| fault.at.as_ref().map(part);
    (
        at(|span| span.line),
        at(|span| span.column),
        fault.key.clone(),
        fault.message.clone(),
        fault.expected.clone(),
        fault.suggestion.clone(),
    )
}

/// A `peenpose.ProblemError` with all faults.
pub fn refusal(py: Python<'_>, rejection: &Rejection) -> PyErr {
    let faults: Vec<FaultTuple> = rejection.faults.iter().map(fault).collect();
    let text = rejection.render(false);
    let error = py
        .import("peenpose._errors")
        .and_then(|module| module.getattr("ProblemError"))
        .and_then(|class| class.call_method1("of_tuples", (text.trim_end(), faults)));
    error.map_or_else(|error| error, PyErr::from_value)
}

/// A checked problem with its scene.
#[pyclass(frozen, module = "peenpose._core")]
pub struct Study {
    pub study: study::Study,
}

#[pymethods]
impl Study {
    /// From a text; its meshes are looked for beside `path`.
    #[staticmethod]
    fn from_text(py: Python<'_>, text: &str, path: PathBuf) -> PyResult<Self> {
        let study = py.detach(|| study::Study::from_text(text, &path));
        let study = study.map_err(|rejection| refusal(py, &rejection))?;
        Ok(Self { study })
    }

    #[getter]
    fn title(&self) -> &str {
        &self.study.problem().title
    }

    #[getter]
    fn surfaces(&self) -> Vec<String> {
        self.study.scenario().scene.surfaces().to_vec()
    }

    #[getter]
    fn contacts(&self) -> Vec<String> {
        self.study
            .problem()
            .contacts
            .iter()
            .map(|contact| contact.name.clone())
            .collect()
    }

    /// What parses but can hardly be meant; what could be meant instead is what is expected.
    fn warnings(&self) -> Vec<FaultTuple> {
        let found = self.study.check().into_iter();
        let tuple = |it: Warning| {
            let at = |part: fn(&Span) -> usize| it.at.as_ref().map(part);
            let place = (at(|span| span.line), at(|span| span.column));
            (place.0, place.1, it.key, it.message, Some(it.help), None)
        };
        found.map(tuple).collect()
    }

    #[pyo3(signature = (*, accuracy=None, seed=None, threads=None, pareto=false, evidence=true, progress=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn solve(
        &self,
        py: Python<'_>,
        accuracy: Option<&str>,
        seed: Option<u64>,
        threads: Option<usize>,
        pareto: bool,
        evidence: bool,
        progress: Option<Py<PyAny>>,
    ) -> PyResult<Record> {
        let mut study = self.study.clone();
        if let Some(accuracy) = accuracy {
            let accuracy = given::accuracy(accuracy);
            study = study.with_accuracy(
                accuracy.map_err(|fault| PyValueError::new_err(format!("accuracy: {fault}")))?,
            );
        }
        if let Some(seed) = seed {
            study = study.with_seed(seed);
        }
        let extras = Extras { pareto, evidence };
        let record = watched(py, threads, progress, |control| {
            study.solve(extras, control)
        })?;
        let record =
            record.ok_or_else(|| PyValueError::new_err("there is no contact to choose"))?;
        Ok(Record { record })
    }

    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    #[pyo3(signature = (settings, *, answered=false, shots=16384, seed=None, threads=None, evidence=true))]
    fn evaluate(
        &self,
        py: Python<'_>,
        settings: &Bound<'_, PyDict>,
        answered: bool,
        shots: usize,
        seed: Option<u64>,
        threads: Option<usize>,
        evidence: bool,
    ) -> PyResult<Record> {
        let settings = self.settings(settings, &[], answered)?;
        let study = match seed {
            Some(seed) => self.study.clone().with_seed(seed),
            None => self.study.clone(),
        };
        let extras = Extras {
            pareto: false,
            evidence,
        };
        let evaluate = |control: &Control| study.evaluate(&settings, shots.max(1), extras, control);
        let record = watched(py, threads, None, evaluate)?;
        let record = record.ok_or_else(|| PyValueError::new_err("there is nothing to report"))?;
        Ok(Record { record })
    }

    /// A map as JSON.
    #[pyo3(signature = (settings, x, y, *, answered=false, x_range=None, y_range=None, steps=41, shots=1024, threads=None))]
    #[expect(clippy::too_many_arguments, reason = "keywords of Python")]
    fn map(
        &self,
        py: Python<'_>,
        settings: &Bound<'_, PyDict>,
        x: &str,
        y: &str,
        answered: bool,
        x_range: Option<[f64; 2]>,
        y_range: Option<[f64; 2]>,
        steps: usize,
        shots: usize,
        threads: Option<usize>,
    ) -> PyResult<String> {
        let axis = |name: &str, range: Option<[f64; 2]>| -> PyResult<Axis> {
            let setting = setting_named(name)?;
            let range = match range {
                Some([from, to]) => {
                    let [min, max] = [from, to].map(|end| setting.from_record(end));
                    Range { min, max }
                }
                None => self.study.problem().ranges.range(setting).ok_or_else(|| {
                    PyValueError::new_err(format!("{name}: the file has no range of it; give one"))
                })?,
            };
            if !range.min.is_finite() || !range.max.is_finite() || range.min >= range.max {
                return Err(PyValueError::new_err(format!(
                    "{name}: the range has no width; give one"
                )));
            }
            Ok(Axis::over(setting, range, steps.clamp(2, 1000)))
        };
        let axes = [axis(x, x_range)?, axis(y, y_range)?];
        if x == y {
            return Err(PyValueError::new_err("both axes are the same setting"));
        }
        let settings = self.settings(settings, &[axes[0].setting, axes[1].setting], answered)?;
        let map = watched(py, threads, None, |control| {
            self.study.map(&settings, axes, shots.max(1), control)
        })?;
        let record = MapRecord::new(&self.study.scenario().as_asked(), &map);
        serde_json::to_string(&record).map_err(|error| PyValueError::new_err(error.to_string()))
    }
}

/// A number in deg, m or m/s, or a text with a unit; SI.
fn given_value(setting: Setting, value: &Bound<'_, PyAny>) -> PyResult<f64> {
    let name = setting.name();
    if let Ok(text) = value.extract::<&str>() {
        return given::setting(setting, text)
            .map_err(|fault| PyValueError::new_err(format!("{name}: {fault}")));
    }
    let number: f64 = value.extract().map_err(|_| {
        PyTypeError::new_err(format!("{name}: expected a number or a text with a unit"))
    })?;
    Ok(setting.from_record(number))
}

fn setting_named(name: &str) -> PyResult<Setting> {
    given::setting_named(name).map_err(PyValueError::new_err)
}

impl Study {
    /// Settings by their names: numbers in deg, m and m/s, or texts with a unit; those that the file holds need not be
    /// given, nor those in `varied`. Where they are those of an answer, friction is that of a contact that holds its own.
    pub fn settings(
        &self,
        given: &Bound<'_, PyDict>,
        varied: &[Setting],
        answered: bool,
    ) -> PyResult<Settings> {
        let problem = self.study.problem();
        let mut known = PartialSettings::held(problem);
        for (name, value) in given.iter() {
            let name: String = name.extract()?;
            let setting = given::setting_or_contact(&name).map_err(PyValueError::new_err)?;
            let Some(setting) = setting else {
                known
                    .set_contact(&value.extract::<String>()?)
                    .map_err(PyValueError::new_err)?;
                continue;
            };
            let value = given_value(setting, &value)?;
            match setting {
                Setting::StaticFriction if answered => _ = known.fill(setting, value),
                _ => known.set(setting, value),
            }
        }
        let middle = problem.ranges.middle();
        for setting in varied {
            known.fill(*setting, setting.of(&middle));
        }
        known.complete().map_err(|incomplete| {
            PyValueError::new_err(match &incomplete {
                Incomplete::Missing(_) => format!("{incomplete}; say what they are"),
                Incomplete::FrictionIsHeld(_) | Incomplete::Wrong(_) => incomplete.to_string(),
            })
        })
    }

    /// The index of a contact.
    pub fn contact_named(&self, name: &str) -> PyResult<usize> {
        given::contact_named(name, self.study.problem()).map_err(PyValueError::new_err)
    }
}

/// All faults of a text, geometry and meshes included.
#[pyfunction]
pub fn check(text: &str, path: PathBuf) -> Vec<FaultTuple> {
    match study::Study::from_text(text, &path) {
        Ok(_) => Vec::new(),
        Err(rejection) => rejection.faults.iter().map(fault).collect(),
    }
}

/// A text in which keys have other values.
#[pyfunction]
pub fn changed(text: &str, changes: Vec<(String, String)>) -> PyResult<String> {
    let changes = changes.iter().map(|(key, value)| Change::new(key, value));
    let changes: Result<Vec<Change>, String> = changes.collect();
    let changed = Template::new(text).and_then(|template| template.with(&changes?));
    changed
        .map(|it| it.text().to_owned())
        .map_err(PyValueError::new_err)
}

/// Shot and contacts with a source for each number, as JSON.
#[pyfunction]
pub fn media() -> PyResult<String> {
    report::library_json().map_err(|error| PyValueError::new_err(error.to_string()))
}

/// The JSON Schema of problem files, as JSON.
#[pyfunction]
pub fn schema() -> String {
    problem::schema().to_string()
}
