//! `peenpose surfaces`: what a mesh without names consists of.

use std::path::PathBuf;
use std::process::ExitCode;

use peenpose::report::{faces, figure::Figure};
use peenpose::scene::mesh_file;
use peenpose::units::{Dimension, parse};

use crate::folder;
use crate::output::{self, Failure};

/// Arguments of `surfaces`.
#[derive(clap::Args)]
pub struct SurfacesArgs {
    /// The mesh: STL, OBJ or PLY
    pub file: PathBuf,
    /// Faces end where neighbours differ by this angle
    #[arg(long, value_name = "ANGLE", default_value = "30 deg")]
    pub angle: String,
    /// How many faces are listed, the largest first
    #[arg(long, value_name = "N", default_value_t = 40)]
    pub most: usize,
    /// Draw them with their numbers into this SVG
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Lists the smooth faces of a mesh, in its own unit, and draws them where that is asked for.
pub fn run(args: &SurfacesArgs) -> Result<ExitCode, Failure> {
    let angle =
        parse(Dimension::Angle, &args.angle).map_err(|fault| format!("--angle: {fault}"))?;
    if !(angle > 0.0 && angle < std::f64::consts::FRAC_PI_2) {
        return Err(format!(
            "--angle {}: expected more than 0 and less than 90 deg",
            args.angle
        )
        .into());
    }
    // Whatever its unit is, what is told of the mesh is in the same.
    let (mesh, warnings) =
        mesh_file::read(&args.file, 1.0, &[]).map_err(|fault| fault.to_string())?;
    for warning in warnings {
        output::warn(&warning.to_string());
    }
    let smooth = mesh.smooth_faces(angle);
    let list = faces(&mesh, &smooth, args.most);
    let drawn = match &args.out {
        Some(file) => {
            let name = file
                .file_name()
                .ok_or_else(|| "--out: expected a file".to_owned())?;
            let figure =
                Figure::of_faces(&mesh, &smooth, args.most).map_err(|fault| fault.to_string())?;
            folder::write(
                folder::folder_of(file),
                &name.to_string_lossy(),
                figure.svg.as_bytes(),
            )
        }
        None => Ok(()),
    };
    output::both(output::text(list), drawn)
}
