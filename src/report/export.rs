//! Scene, nozzle, paths and hits for other programs. Lengths are in m everywhere.

mod animation;
mod glb;
mod piece;
mod ply;
mod vtk;

use std::io;

use super::motion::stops;
use crate::record::Record;
use animation::Motion;

/// A file format of other programs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// glTF 2.0 in one binary file: surfaces, nozzle, paths and hits, each by its name; on a stroke the nozzle travels.
    Glb,
    /// The legacy format of VTK as text: the same as poly data; `piece` numbers the names in
    /// `piece_names`, `normal_impulse_N_s` is N* of a hit and 0 elsewhere.
    Vtk,
    /// Stanford's polygon format: surfaces and nozzle as triangles, hits as vertices without any.
    Ply,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 3] = [Self::Glb, Self::Vtk, Self::Ply];

    /// How the names of its files end.
    pub const fn ending(self) -> &'static str {
        match self {
            Self::Glb => "glb",
            Self::Vtk => "vtk",
            Self::Ply => "ply",
        }
    }

    /// The format of a file whose name ends like that.
    pub fn with_ending(ending: &str) -> Option<Self> {
        let is_it = |format: &Self| format.ending().eq_ignore_ascii_case(ending);
        Self::ALL.into_iter().find(is_it)
    }
}

/// What a record shows as a file for other programs; `None` where it has no evidence.
///
/// # Errors
/// When the scene is too large for the format: more than 4 GB.
pub fn export(record: &Record, format: Format) -> Option<io::Result<Vec<u8>>> {
    let evidence = record.evidence.as_ref()?;
    let pieces = piece::all(evidence, record.best.pose.exit_m);
    Some(match format {
        Format::Glb => {
            let feed = record.stroke.as_ref().and_then(|stroke| stroke.feed_m_s);
            glb::write(&pieces, Motion::new(stops(record), feed).as_ref())
        }
        Format::Vtk => Ok(vtk::write(&pieces)),
        Format::Ply => Ok(ply::write(&pieces)),
    })
}
