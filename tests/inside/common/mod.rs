//! Pairs and scenes that several tests run on.

pub mod fzg_test;

#[path = "../../../physics/tests/common/mod.rs"]
mod of_physics;

use gearwear::scene::Resolved;
use gearwear::scene::loaded::{LoadedScene, NamedFiles, SceneText};
#[allow(unused_imports, reason = "each test uses its own part")]
pub use of_physics::*;

/// A resolved scene that names no files, as it is run.
pub fn loaded(resolved: &Resolved) -> LoadedScene {
    loaded_with(resolved, NamedFiles::default())
}

/// The same with the files that it names.
pub fn loaded_with(resolved: &Resolved, files: NamedFiles) -> LoadedScene {
    let given = SceneText { name: "scene of a test".to_owned(), text: resolved.to_toml() };
    LoadedScene::with_files(resolved.clone(), given, files).expect("the scene of the test has its files")
}
