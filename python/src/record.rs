//! Results, and their columns as arrays.

use std::path::PathBuf;

use numpy::IntoPyArray;
use peenpose::atomic;
use peenpose::record;
use peenpose::report;
use pyo3::exceptions::{PyOSError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A result.
#[pyclass(frozen, module = "peenpose._core")]
pub struct Record {
    pub record: record::Record,
}

fn unexpected(error: impl ToString) -> PyErr {
    PyRuntimeError::new_err(error.to_string())
}

/// Adds a column for each coordinate of some points.
fn add_coordinates<const N: usize>(
    columns: &Bound<'_, PyDict>,
    names: [&str; N],
    points: &[[f32; N]],
) -> PyResult<()> {
    for (axis, name) in names.into_iter().enumerate() {
        let values: Vec<f32> = points.iter().map(|point| point[axis]).collect();
        columns.set_item(name, values.into_pyarray(columns.py()))?;
    }
    Ok(())
}

#[pymethods]
impl Record {
    /// From the text of a result.json.
    #[staticmethod]
    fn from_json(text: &str) -> PyResult<Self> {
        let record = record::Record::from_json(text);
        let record = record.map_err(|fault| PyValueError::new_err(fault.to_string()))?;
        Ok(Self { record })
    }

    /// The text of result.json.
    fn to_json(&self) -> PyResult<String> {
        self.record.to_json().map_err(unexpected)
    }

    /// The technique sheet.
    fn sheet(&self) -> String {
        report::sheet(&self.record)
    }

    /// Its head.
    fn brief(&self) -> String {
        report::brief(&self.record)
    }

    /// The page.
    fn report_html(&self) -> PyResult<String> {
        report::page(&self.record).map_err(unexpected)
    }

    /// Writes result.json and all reports into a folder and tells their names.
    fn save(&self, py: Python<'_>, folder: PathBuf) -> PyResult<Vec<String>> {
        py.detach(|| {
            std::fs::create_dir_all(&folder).map_err(PyOSError::new_err)?;
            let json = self.record.to_json().map_err(unexpected)?;
            let mut files = vec![("result.json".to_owned(), json.into_bytes())];
            files.extend(report::files(&self.record).map_err(unexpected)?);
            let written = files.into_iter().map(|(name, contents)| {
                atomic::write(&folder, &name, &contents).map_err(PyOSError::new_err)?;
                Ok(name)
            });
            written.collect()
        })
    }

    /// Columns of first hits on the target; `None` for a result without evidence.
    fn hits<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(evidence) = &self.record.evidence else {
            return Ok(None);
        };
        let hits = evidence.hits.clone();
        let columns = PyDict::new(py);
        add_coordinates(&columns, ["x_m", "y_m", "z_m"], &hits.points_m)?;
        add_coordinates(&columns, ["along_m", "across_m"], &hits.plane_m)?;
        columns.set_item("angle_deg", hits.angle_deg.into_pyarray(py))?;
        columns.set_item("normal_impulse_N_s", hits.normal_impulse.into_pyarray(py))?;
        columns.set_item(
            "tangential_impulse_N_s",
            hits.tangential_impulse.into_pyarray(py),
        )?;
        columns.set_item("sticks", hits.sticks.into_pyarray(py))?;
        Ok(Some(columns))
    }

    /// Columns of impacts on secondary surfaces; `None` for a result without evidence. `surface` is an index into
    /// `evidence.surfaces` of the JSON.
    fn rebounds<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyDict>>> {
        let Some(evidence) = &self.record.evidence else {
            return Ok(None);
        };
        let rebounds = evidence.rebounds.clone();
        let columns = PyDict::new(py);
        add_coordinates(&columns, ["x_m", "y_m", "z_m"], &rebounds.points_m)?;
        columns.set_item("surface", rebounds.surface.into_pyarray(py))?;
        columns.set_item("number", rebounds.number.into_pyarray(py))?;
        columns.set_item(
            "normal_impulse_N_s",
            rebounds.normal_impulse.into_pyarray(py),
        )?;
        Ok(Some(columns))
    }
}
