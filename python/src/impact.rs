//! The impact model over arrays.

use numpy::{IntoPyArray, PyReadonlyArray1};
use peenpose::impact::{Contact, Law, Oblique, Regime, Restitution, Sphere};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Arrays of one length: speed in m/s, angle to the surface in deg, spin in rad/s, radius in m, density in kg/m3.
#[pyfunction]
#[expect(clippy::too_many_arguments, reason = "a column each")]
pub fn impact<'py>(
    py: Python<'py>,
    law: &str,
    speed: PyReadonlyArray1<'py, f64>,
    angle: PyReadonlyArray1<'py, f64>,
    mu_s: PyReadonlyArray1<'py, f64>,
    mu_d: PyReadonlyArray1<'py, f64>,
    restitution: PyReadonlyArray1<'py, f64>,
    tangential_restitution: PyReadonlyArray1<'py, f64>,
    spin: PyReadonlyArray1<'py, f64>,
    radius: PyReadonlyArray1<'py, f64>,
    density: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, PyDict>> {
    let law = Law::ALL
        .into_iter()
        .find(|it| it.name() == law)
        .ok_or_else(|| {
            let names: Vec<&str> = Law::ALL.iter().map(|law| law.name()).collect();
            PyValueError::new_err(format!(
                "there is no law `{law}`; expected one of {}",
                names.join(", ")
            ))
        })?;
    let columns = [
        speed,
        angle,
        mu_s,
        mu_d,
        restitution,
        tangential_restitution,
        spin,
        radius,
        density,
    ];
    let columns = columns.each_ref().map(|column| column.as_array());
    let count = columns[0].len();
    let mut found: [Vec<f64>; 7] = std::array::from_fn(|_| Vec::with_capacity(count));
    let mut sticks = Vec::with_capacity(count);
    for index in 0..count {
        let [
            speed,
            angle,
            mu_s,
            mu_d,
            restitution,
            tangential,
            spin,
            radius,
            density,
        ] = columns.each_ref().map(|column| column[index]);
        let refuse = |fault: String| PyValueError::new_err(format!("row {index}: {fault}"));
        let contact = Contact {
            law,
            static_friction: mu_s,
            dynamic_friction: mu_d,
            restitution: Restitution::Constant(restitution),
            tangential_restitution: tangential,
        };
        contact
            .validate()
            .map_err(|fault| refuse(fault.to_string()))?;
        for (name, value) in [("speed", speed), ("radius", radius), ("density", density)] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(refuse(format!("{name} is {value}; expected more than 0")));
            }
        }
        if !(angle > 0.0 && angle <= 90.0) {
            return Err(refuse(format!(
                "angle is {angle}; expected more than 0 and at most 90 deg"
            )));
        }
        if !spin.is_finite() || (spin != 0.0 && !law.spins()) {
            return Err(refuse(format!("spin is {spin}, which this law has not")));
        }
        let oblique = Oblique {
            sphere: Sphere { radius, density },
            contact,
            speed,
            angle: angle.to_radians(),
            spin,
        };
        let outcome = oblique
            .outcome()
            .ok_or_else(|| refuse("the shot does not approach".to_owned()))?;
        let values = [
            outcome.normal_impulse,
            outcome.tangential_impulse,
            outcome.normal_velocity,
            outcome.tangential_velocity,
            outcome.angle.to_degrees(),
            outcome.spin,
            outcome.energy_ratio(),
        ];
        found
            .iter_mut()
            .zip(values)
            .for_each(|(column, value)| column.push(value));
        sticks.push(outcome.regime == Regime::Stick);
    }
    let columns = PyDict::new(py);
    let names = [
        "normal_impulse",
        "tangential_impulse",
        "normal_velocity",
        "tangential_velocity",
        "angle",
        "spin",
        "energy_ratio",
    ];
    for (name, column) in names.into_iter().zip(found) {
        columns.set_item(name, column.into_pyarray(py))?;
    }
    columns.set_item("sticks", sticks.into_pyarray(py))?;
    Ok(columns)
}
