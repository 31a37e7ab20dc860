//! The best settings known of each problem, as `best_known` found them.

use std::error::Error;

use peenpose::problem::Problem;
use peenpose::problem::setting::{Setting, Settings};

use super::cube::Cube;
use super::variant::{Variant, contact_named};

/// Names of the columns.
pub const HEADER: &str = "file,tolerance,shots,contact,incidence_deg,azimuth_deg,standoff_mm,speed_m_s,\
                          J,standard_error,poses,rays";

/// The best settings known for one contact.
#[derive(Clone, Debug)]
pub struct Known {
    pub file: String,
    pub tolerance: String,
    pub shots: String,
    pub contact: String,
    /// deg, deg, mm and m/s.
    pub settings: [f64; 4],
    pub objective: f64,
    pub standard_error: f64,
    pub poses: usize,
    pub rays: usize,
}

impl Known {
    /// The line of the table.
    pub fn line(&self) -> String {
        let [incidence, azimuth, standoff, speed] = self.settings;
        format!(
            "{},{},{},{},{incidence:.5},{azimuth:.5},{standoff:.5},{speed:.6},{:.8},{:.1e},{},{}",
            self.file,
            self.tolerance,
            self.shots,
            self.contact,
            self.objective,
            self.standard_error,
            self.poses,
            self.rays,
        )
    }

    fn parse(line: &str) -> Result<Self, Box<dyn Error>> {
        let fields: Vec<&str> = line.split(',').collect();
        let &[
            file,
            tolerance,
            shots,
            contact,
            incidence,
            azimuth,
            standoff,
            speed,
            j,
            error,
            poses,
            rays,
        ] = &fields[..]
        else {
            return Err(format!("not a line of best known settings: {line}").into());
        };
        Ok(Self {
            file: file.into(),
            tolerance: tolerance.into(),
            shots: shots.into(),
            contact: contact.into(),
            settings: [
                incidence.parse()?,
                azimuth.parse()?,
                standoff.parse()?,
                speed.parse()?,
            ],
            objective: j.parse()?,
            standard_error: error.parse()?,
            poses: poses.parse()?,
            rays: rays.parse()?,
        })
    }

    /// Reads the table.
    pub fn read() -> Result<Vec<Self>, Box<dyn Error>> {
        let path = super::root().join("tests/data/best_known.csv");
        let text = std::fs::read_to_string(&path)
            .map_err(|error| format!("{}: {error}", path.display()))?;
        text.lines().skip(1).map(Self::parse).collect()
    }

    /// Whether these are settings for a variant.
    pub fn is_of(&self, variant: &Variant) -> bool {
        self.file == variant.file
            && self.tolerance == variant.tolerance_word()
            && self.shots == variant.shots_word()
    }

    /// The settings in SI.
    pub fn settings(&self, problem: &Problem) -> Result<Settings, Box<dyn Error>> {
        let contact = contact_named(problem, &self.contact)
            .ok_or_else(|| format!("{} has no contact {}", self.file, self.contact))?;
        let [incidence, azimuth, standoff, speed] = self.settings;
        let middle = Cube::new(problem, contact, &[]).settings(&[]);
        let settings = Setting::Incidence.with(&middle, incidence.to_radians());
        let settings = Setting::Azimuth.with(&settings, azimuth.to_radians());
        let settings = Setting::Standoff.with(&settings, standoff * 1e-3);
        Ok(Setting::Speed.with(&settings, speed))
    }
}

/// Settings in the units of the table.
pub fn in_units(settings: &Settings) -> [f64; 4] {
    [
        settings.incidence.to_degrees(),
        settings.azimuth.to_degrees(),
        settings.standoff * 1e3,
        settings.speed,
    ]
}
