//! What the programs that measure the search share: problems, settings as points, fresh shots.
#![allow(dead_code)]

pub mod cube;
pub mod known;
pub mod statistics;
pub mod suite;
pub mod validation;
pub mod variant;
