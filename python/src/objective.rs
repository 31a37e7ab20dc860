//! J of many settings at once, for optimisers of others.

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray2};
use peenpose::feasibility::infeasibility;
use peenpose::jet::{Samples, Stream};
use peenpose::objective::Tally;
use peenpose::problem::setting::{Range, Setting, Settings};
use peenpose::scenario::Scenario;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use rayon::prelude::*;

use crate::study::Study;

/// J on common random numbers: the same shots for every row.
#[pyclass(frozen, module = "peenpose._core")]
pub struct Objective {
    scenario: Scenario,
    samples: Samples,
    base: Settings,
    axes: Vec<(Setting, Range)>,
    penalty: f64,
}

#[pymethods]
impl Objective {
    #[new]
    #[pyo3(signature = (study, contact, *, shots=1024, penalty=1e6))]
    fn new(study: &Study, contact: &str, shots: usize, penalty: f64) -> PyResult<Self> {
        if shots == 0 || !(penalty > 0.0 && penalty.is_finite()) {
            return Err(PyValueError::new_err(
                "shots and penalty: expected more than 0",
            ));
        }
        let scenario = study.study.scenario().as_asked();
        let ranges = &scenario.problem.ranges;
        let mut base = ranges.middle();
        base.contact = study.contact_named(contact)?;
        let friction = scenario.problem.contacts[base.contact].static_friction;
        base.static_friction = friction.min;
        let of_the_nozzle = Setting::OF_THE_NOZZLE.into_iter();
        let axes = of_the_nozzle
            .filter_map(|setting| Some((setting, ranges.range(setting)?)))
            .chain([(Setting::StaticFriction, friction)])
            .filter(|(_, range)| !range.is_held())
            .collect();
        Ok(Self {
            samples: Samples::with_boundary(&scenario.problem, Stream::Search, shots),
            scenario,
            base,
            axes,
            penalty,
        })
    }

    /// Names of the columns: the settings that the file leaves open.
    #[getter]
    fn names(&self) -> Vec<&'static str> {
        self.axes
            .iter()
            .map(|(setting, _)| setting.name())
            .collect()
    }

    /// Lower and upper ends of the columns, deg, m and m/s.
    #[getter]
    fn bounds(&self) -> Vec<(f64, f64)> {
        let ends = |(setting, range): &(Setting, Range)| {
            (setting.to_record(range.min), setting.to_record(range.max))
        };
        self.axes.iter().map(ends).collect()
    }

    /// J of each row. Where the nozzle does not fit it is the penalty and more, the more the deeper it is in the way.
    fn __call__<'py>(
        &self,
        py: Python<'py>,
        x: PyReadonlyArray2<'py, f64>,
    ) -> PyResult<Bound<'py, PyArray1<f64>>> {
        let x = x.as_array();
        if x.ncols() != self.axes.len() {
            return Err(PyValueError::new_err(format!(
                "x has {} columns; expected {}: {}",
                x.ncols(),
                self.axes.len(),
                self.names().join(", ")
            )));
        }
        if let Some(value) = x.iter().find(|value| !value.is_finite()) {
            return Err(PyValueError::new_err(format!(
                "x holds {value}, which is no setting"
            )));
        }
        let rows: Vec<Settings> = x
            .rows()
            .into_iter()
            .map(|row| {
                let pairs = self.axes.iter().zip(row);
                pairs.fold(self.base, |settings, ((setting, range), value)| {
                    // Rounding of degrees leads out of no range.
                    let value = setting.from_record(*value).clamp(range.min, range.max);
                    setting.with(&settings, value)
                })
            })
            .collect();
        let values: Vec<f64> =
            py.detach(|| rows.par_iter().map(|settings| self.of(settings)).collect());
        Ok(values.into_pyarray(py))
    }
}

impl Objective {
    fn of(&self, settings: &Settings) -> f64 {
        if let Some(infeasible) = infeasibility(&self.scenario, settings) {
            let millimetres = infeasible.violation * 1e3;
            return self.penalty * (1.0 + millimetres / (1.0 + millimetres));
        }
        let tally = Tally::trace(
            &self.scenario,
            settings,
            settings.speed,
            &self.samples.shots,
        );
        let terms = tally.terms(&self.scenario.problem.goals, settings.speed);
        terms.total().min(self.penalty)
    }
}
