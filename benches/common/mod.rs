//! What the benchmarks run.

use gearwear::{LoadedScene, RunRecord, Unwatched};

/// The preset `name` without `snapshots`, error estimates and verification, some keys replaced.
pub(crate) fn scene(name: &str, snapshots: &str, edits: &[(&str, &str)]) -> LoadedScene {
    let preset = LoadedScene::preset(name).and_then(|scene| scene.without(snapshots)).expect("the preset is sound");
    let off = [("numerics.error_estimate", "false"), ("numerics.verify", "false")];
    off.iter().chain(edits).fold(preset, |scene, (key, value)| {
        let value: toml::Table = format!("value = {value}").parse().expect("a value");
        scene.with(key, value["value"].clone()).expect("the scene is sound")
    })
}

/// Runs it.
pub(crate) fn run(scene: &LoadedScene) -> RunRecord {
    gearwear::run(scene, &Unwatched).expect("the preset runs").record
}
