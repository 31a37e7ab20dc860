//! Impacts, paths, what surfaces receive and what the model leaves out.

#[path = "../common/mod.rs"]
mod common;

mod contacts;
mod coverage;
mod finite_size;
mod impact_properties;
mod objective;
mod physics_properties;
mod published_tables;
mod rare_shares;
mod rare_violations;
mod reference;
mod rims;
mod roughness;
mod strokes;
mod unknowns;
mod validation;
mod validity;
