//! The problems of the repository.

use std::path::{Path, PathBuf};

use peenpose::scenario::Scenario;

/// Where a shipped file is.
pub fn path(file: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("problems");
    folder.join(file)
}

/// A shipped problem with its scene.
pub fn scenario(file: &str) -> Scenario {
    let loaded = Scenario::load(&path(file)).map_err(|rejection| rejection.render(false));
    loaded.unwrap().0
}
