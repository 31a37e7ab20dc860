//! Python bindings: thin doors to the library; what Python people expect is built on them in Python.

mod campaign;
mod impact;
mod objective;
mod record;
mod study;
mod watched;

use pyo3::prelude::*;

/// The compiled part of the package `peenpose`.
#[pymodule]
mod _core {
    #[pymodule_export]
    use super::campaign::{campaign_gather, campaign_plan, campaign_run, campaign_status};
    #[pymodule_export]
    use super::impact::impact;
    #[pymodule_export]
    use super::objective::Objective;
    #[pymodule_export]
    use super::record::Record;
    #[pymodule_export]
    use super::study::{Study, changed, check, media, schema};

    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
