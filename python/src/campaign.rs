//! Campaigns.

use std::path::{Path, PathBuf};

use peenpose::campaign::{CampaignFolder, CaseStatus, Plan, Shard};
use pyo3::exceptions::{PyOSError, PyValueError};
use pyo3::prelude::*;

use crate::study::refusal;
use crate::watched::watched;

fn open(folder: &Path) -> PyResult<CampaignFolder> {
    CampaignFolder::open(folder).map_err(PyOSError::new_err)
}

/// Plans a campaign; how many cases there are, and how many were left out as they repeat others.
#[pyfunction]
pub fn campaign_plan(py: Python<'_>, file: PathBuf, folder: PathBuf) -> PyResult<(usize, usize)> {
    let plan = py
        .detach(|| Plan::read(&file))
        .map_err(|rejection| refusal(py, &rejection))?;
    let counts = (plan.cases.len(), plan.repeated);
    CampaignFolder::create(&folder, plan).map_err(PyOSError::new_err)?;
    Ok(counts)
}

/// Solves the cases of a shard that are missing: how many were solved, are faulty, were kept, and are left.
#[pyfunction]
#[pyo3(signature = (folder, shard="1/1", threads=None, progress=None))]
pub fn campaign_run(
    py: Python<'_>,
    folder: PathBuf,
    shard: &str,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<(usize, usize, usize, usize)> {
    let campaign = open(&folder)?;
    let shard: Shard = shard.parse().map_err(PyValueError::new_err)?;
    let told = |id: &str, status: CaseStatus| {
        let Some(progress) = &progress else { return };
        let word = match status {
            CaseStatus::Done => "done",
            CaseStatus::Missing => "missing",
            CaseStatus::Faulty => "faulty",
        };
        // What a callback raises must not lose what is solved.
        Python::attach(|py| {
            progress
                .call1(py, (id, word))
                .map(drop)
                .unwrap_or_else(|error| error.print(py))
        });
    };
    let run = |control: &peenpose::control::Control| {
        campaign.run(shard, control, &|case, status| told(&case.id, status))
    };
    let outcome = watched(py, threads, None, run)?.map_err(PyOSError::new_err)?;
    Ok((outcome.solved, outcome.faulty, outcome.kept, outcome.left))
}

/// How many cases are done, missing and faulty.
#[pyfunction]
pub fn campaign_status(folder: PathBuf) -> PyResult<(usize, usize, usize)> {
    let campaign = open(&folder)?;
    let count = |status| campaign.count(status);
    Ok((
        count(CaseStatus::Done),
        count(CaseStatus::Missing),
        count(CaseStatus::Faulty),
    ))
}

/// The table of all cases as CSV.
#[pyfunction]
pub fn campaign_gather(py: Python<'_>, folder: PathBuf) -> PyResult<String> {
    let campaign = open(&folder)?;
    let table = py.detach(|| campaign.gather());
    table.map(|table| table.csv).map_err(PyOSError::new_err)
}
