//! What is there: meshes and their surfaces.

pub mod mesh;
pub mod mesh_file;
