//! What the programs that measure the search share: problems, settings as points, fresh shots.
#![allow(dead_code)]

pub mod cube;
pub mod known;
pub mod statistics;
pub mod suite;
pub mod validation;
pub mod variant;

use std::path::{Path, PathBuf};

/// Where this repository is; packages in it use these files, too.
pub fn root() -> PathBuf {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    let is_root = |folder: &&Path| folder.join("problems/keyway.yaml").exists();
    package.ancestors().find(is_root).unwrap_or(package).into()
}
