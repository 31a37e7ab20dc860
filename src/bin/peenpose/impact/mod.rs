//! `peenpose impact`: one impact on a flat surface, or the tables of Zohdi's paper.

mod case;
mod json;
#[cfg(test)]
mod tests;
mod text;

use case::shot;
use json::{ImpactJson, to_json};
use peenpose::impact::Law;
use text::{impact_text, table_text};

/// Work out one impact of a shot on a flat surface.
///
/// Without flags it is the case of Zohdi's paper with mu_s = 0.3. Angles are measured from the
/// surface: 90 deg is perpendicular.
#[derive(Debug, clap::Args)]
pub struct ImpactArgs {
    /// Speed of the shot.
    #[arg(
        long,
        value_name = "SPEED",
        allow_hyphen_values = true,
        default_value = "10 m/s"
    )]
    speed: String,

    /// Angle between its path and the surface, above 0 deg and up to 90 deg.
    #[arg(
        long,
        value_name = "ANGLE",
        allow_hyphen_values = true,
        default_value = "60 deg"
    )]
    angle: String,

    /// Spin about the axis across the plane of motion; rolling forwards is negative.
    #[arg(
        long,
        value_name = "SPIN",
        allow_hyphen_values = true,
        default_value = "0 rad/s"
    )]
    spin: String,

    /// Radius of the shot.
    #[arg(
        long,
        value_name = "LENGTH",
        allow_hyphen_values = true,
        default_value = "0.5 mm"
    )]
    radius: String,

    /// Density of the shot.
    #[arg(
        long,
        value_name = "DENSITY",
        allow_hyphen_values = true,
        default_value = "7000 kg/m3"
    )]
    density: String,

    /// Static friction.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_hyphen_values = true,
        default_value = "0.3"
    )]
    mu_s: String,

    /// Dynamic friction, at most the static one [default: 0.9 times the static friction]
    #[arg(long, value_name = "NUMBER", allow_hyphen_values = true)]
    mu_d: Option<String>,

    /// Normal coefficient of restitution, 0 to 1.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_hyphen_values = true,
        default_value = "0.25"
    )]
    restitution: String,

    /// Tangential restitution of a contact that sticks, -1 to 1; 0 is the paper's model.
    #[arg(
        long,
        value_name = "NUMBER",
        allow_hyphen_values = true,
        default_value = "0"
    )]
    tangential_restitution: String,

    /// Friction law. always_slip creates energy; it is there to compare with the paper.
    #[arg(long, default_value = Law::StickSlip.name(), value_parser = Law::ALL.map(Law::name))]
    law: String,

    /// Print a table of the paper, as it should be.
    #[arg(long, value_enum, conflicts_with_all = [
        "speed", "angle", "spin", "radius", "density", "mu_s", "mu_d", "restitution",
        "tangential_restitution", "law",
    ])]
    table: Option<Table>,

    /// Print the table as it was published: with the slip formula where the contact sticks.
    #[arg(long, requires = "table")]
    as_published: bool,

    /// Print JSON in SI units.
    #[arg(long)]
    json: bool,
}

/// A table of Zohdi's paper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
enum Table {
    /// Table 1: velocities and spin after the impact.
    Zohdi1,
    /// Table 2: impulses and energies.
    Zohdi2,
}

/// The text for standard output.
///
/// # Errors
/// Every flag with a value that cannot be, one to a line.
pub fn run(args: &ImpactArgs) -> Result<String, String> {
    if let Some(table) = args.table {
        return table_text(table, args.as_published, args.json);
    }
    let shot = shot(args)?;
    let outcome = shot
        .outcome()
        .ok_or("the shot does not reach the surface: raise --speed or --angle")?;
    if args.json {
        to_json(&ImpactJson::new(&shot, &outcome))
    } else {
        Ok(impact_text(&shot, &outcome))
    }
}
