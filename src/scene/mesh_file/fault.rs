//! Why a mesh file cannot be used, and where.

use std::error::Error;
use std::fmt;
use std::path::{Path, PathBuf};

use super::defect::Defect;

/// A mesh file that cannot be used.
#[derive(Clone, Debug, PartialEq)]
pub struct MeshFault {
    /// The file.
    pub file: PathBuf,
    /// Where in the file.
    pub place: Place,
    /// What is wrong there.
    pub defect: Defect,
}

/// A place in a mesh file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// The file as a whole.
    File,
    /// A line of a text file, from 1.
    Line(u64),
    /// A triangle of a binary STL file, from 1.
    Triangle(u64),
    /// A vertex of a binary PLY file, from 0 as its faces count them.
    Vertex(u64),
    /// A face of a binary PLY file, from 0.
    Face(u64),
}

impl Defect {
    /// The fault that this defect makes of a file, once [`MeshFault::in_file`] has named it.
    pub(super) fn at(self, place: Place) -> MeshFault {
        MeshFault {
            file: PathBuf::new(),
            place,
            defect: self,
        }
    }
}

impl MeshFault {
    pub(super) fn in_file(self, file: &Path) -> Self {
        Self {
            file: file.to_owned(),
            ..self
        }
    }
}

impl Error for MeshFault {}

impl fmt::Display for MeshFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file.display())?;
        match self.place {
            Place::File => {}
            Place::Line(number) => write!(f, ", line {number}")?,
            Place::Triangle(number) => write!(f, ", triangle {number}")?,
            Place::Vertex(number) => write!(f, ", vertex {number}")?,
            Place::Face(number) => write!(f, ", face {number}")?,
        }
        write!(f, ": {}", self.defect)
    }
}
