//! Parts, mesh files, free space, rays and contacts of spheres.

#[path = "../common/mod.rs"]
mod common;

mod bad_geometry;
mod bad_meshes;
mod closed_mesh;
mod cuts;
mod facets_converge;
mod found_files;
mod free_space;
mod mesh_files;
mod mesh_rays;
mod open_mesh;
mod parry_rays;
mod revolved;
mod scene_faults;
mod small_shot;
