//! One impact and the tables as JSON.

use peenpose::elementary::{sin, tan};
use peenpose::impact::zohdi::Row;
use peenpose::impact::{Oblique, Outcome};
use serde::Serialize;

pub fn to_json(value: &impl Serialize) -> Result<String, String> {
    serde_json::to_string_pretty(value)
        .map(|text| text + "\n")
        .map_err(|fault| fault.to_string())
}

#[derive(Serialize)]
pub struct ImpactJson {
    law: &'static str,
    speed_m_s: f64,
    angle_rad: f64,
    spin_rad_s: f64,
    radius_m: f64,
    #[serde(rename = "density_kg_m3")]
    density: f64,
    static_friction: f64,
    dynamic_friction: f64,
    restitution: f64,
    tangential_restitution: f64,
    regime: &'static str,
    #[serde(rename = "normal_impulse_N_s")]
    normal_impulse: f64,
    #[serde(rename = "tangential_impulse_N_s")]
    tangential_impulse: f64,
    normal_velocity_after_m_s: f64,
    tangential_velocity_after_m_s: f64,
    angle_after_rad: f64,
    spin_after_rad_s: f64,
    #[serde(rename = "translation_energy_before_J")]
    translation_before: f64,
    #[serde(rename = "translation_energy_after_J")]
    translation_after: f64,
    #[serde(rename = "rotation_energy_before_J")]
    rotation_before: f64,
    #[serde(rename = "rotation_energy_after_J")]
    rotation_after: f64,
    energy_ratio: f64,
    /// Null when the contact never sticks.
    stick_tangent: Option<f64>,
    stick_angle_rad: Option<f64>,
}

impl ImpactJson {
    pub fn new(shot: &Oblique, outcome: &Outcome) -> Self {
        let contact = &shot.contact;
        let stick_angle = shot.stick_angle();
        Self {
            law: contact.law.name(),
            speed_m_s: shot.speed,
            angle_rad: shot.angle,
            spin_rad_s: shot.spin,
            radius_m: shot.sphere.radius,
            density: shot.sphere.density,
            static_friction: contact.static_friction,
            dynamic_friction: contact.dynamic_friction,
            restitution: contact.restitution.at(shot.speed * sin(shot.angle)),
            tangential_restitution: contact.tangential_restitution,
            regime: outcome.regime.name(),
            normal_impulse: outcome.normal_impulse,
            tangential_impulse: outcome.tangential_impulse,
            normal_velocity_after_m_s: outcome.normal_velocity,
            tangential_velocity_after_m_s: outcome.tangential_velocity,
            angle_after_rad: outcome.angle,
            spin_after_rad_s: outcome.spin,
            translation_before: outcome.before.translation,
            translation_after: outcome.after.translation,
            rotation_before: outcome.before.rotation,
            rotation_after: outcome.after.rotation,
            energy_ratio: outcome.energy_ratio(),
            stick_tangent: stick_angle.map(tan),
            stick_angle_rad: stick_angle,
        }
    }
}

#[derive(Serialize)]
pub struct TableJson<T> {
    pub law: &'static str,
    pub rows: Vec<T>,
    pub note: String,
}

#[derive(Serialize)]
pub struct VelocitiesJson {
    static_friction: f64,
    regime: &'static str,
    normal_velocity_after_m_s: f64,
    tangential_velocity_after_m_s: f64,
    angle_after_rad: f64,
    spin_after_rad_s: f64,
}

impl VelocitiesJson {
    pub fn new(row: &Row) -> Self {
        let out = &row.outcome;
        Self {
            static_friction: row.static_friction,
            regime: out.regime.name(),
            normal_velocity_after_m_s: out.normal_velocity,
            tangential_velocity_after_m_s: out.tangential_velocity,
            angle_after_rad: out.angle,
            spin_after_rad_s: out.spin,
        }
    }
}

#[derive(Serialize)]
pub struct EnergiesJson {
    static_friction: f64,
    regime: &'static str,
    #[serde(rename = "normal_impulse_N_s")]
    normal_impulse: f64,
    #[serde(rename = "tangential_impulse_N_s")]
    tangential_impulse: f64,
    #[serde(rename = "translation_energy_before_J")]
    translation_before: f64,
    #[serde(rename = "translation_energy_after_J")]
    translation_after: f64,
    #[serde(rename = "rotation_energy_before_J")]
    rotation_before: f64,
    #[serde(rename = "rotation_energy_after_J")]
    rotation_after: f64,
    energy_ratio: f64,
}

impl EnergiesJson {
    pub fn new(row: &Row) -> Self {
        let out = &row.outcome;
        Self {
            static_friction: row.static_friction,
            regime: out.regime.name(),
            normal_impulse: out.normal_impulse,
            tangential_impulse: out.tangential_impulse,
            translation_before: out.before.translation,
            translation_after: out.after.translation,
            rotation_before: out.before.rotation,
            rotation_after: out.after.rotation,
            energy_ratio: out.energy_ratio(),
        }
    }
}
