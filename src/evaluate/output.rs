//! An output of a run by its path in `summary.json`: `pinion.peak_wear_um`; items of lists are numbered from 1. Names that main figures had in the
//! version before are read too, and so is the greatest wear of either gear.

use std::sync::OnceLock;

use serde_json::Value;

use crate::planetary_run::record::PlanetarySummary;
use crate::scene::key::{is_number, nearest_path};
use crate::scene::opened::SceneKind;
use crate::scene::planetary::mesh::StageMesh;
use crate::scene::schema::{Node, schema_of};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::figures;
use gearwear_physics::results::run::Summary;

const GEARS: [&str; 2] = ["pinion", "wheel"];

#[derive(Debug, Clone, PartialEq)]
pub struct SummaryOutput {
    pub path: String,
    /// Path as a JSON pointer; of several the greatest number counts.
    pointers: Vec<String>,
}

/// A path that leads to no number.
#[derive(Debug, Clone, PartialEq)]
pub struct OutputError {
    pub output: String,
    /// Path that was probably meant.
    pub nearest: Option<String>,
}

fn schema(kind: SceneKind) -> &'static Value {
    static OF_PAIRS: OnceLock<Value> = OnceLock::new();
    static OF_STAGES: OnceLock<Value> = OnceLock::new();
    match kind {
        SceneKind::Pair => OF_PAIRS.get_or_init(schema_of::<Summary>),
        SceneKind::Stage => OF_STAGES.get_or_init(schema_of::<PlanetarySummary>),
    }
}

/// Pointers to what the greatest wear of all is the greatest of.
fn peak_wears(kind: SceneKind) -> Vec<String> {
    let flanks = match kind {
        SceneKind::Pair => GEARS.map(str::to_owned).into(),
        SceneKind::Stage => {
            let of_mesh = |mesh: StageMesh| Gear::BOTH.map(|gear| mesh.flank(gear).replace('.', "/"));
            StageMesh::BOTH.map(of_mesh).concat()
        }
    };
    flanks.iter().map(|flank: &String| format!("/{flank}/{}", figures::PEAK_WEAR_OF_EITHER)).collect()
}

impl SummaryOutput {
    /// The number at `path` of the summary of a pair.
    pub fn find(path: &str) -> Result<Self, OutputError> {
        Self::of_kind(SceneKind::Pair, path)
    }

    /// The number at `path` of the summary of a kind of scene.
    pub fn of_kind(kind: SceneKind, path: &str) -> Result<Self, OutputError> {
        let path = figures::name_now(path).filter(|_| kind.is_pair()).unwrap_or(path);
        if path == figures::PEAK_WEAR_OF_EITHER {
            return Ok(Self { path: path.to_owned(), pointers: peak_wears(kind) });
        }
        let root = Node::root(schema(kind));
        let mut pointer = String::new();
        let mut node = Some(root);
        for part in path.split('.') {
            let above = node;
            let number = part.parse::<usize>().ok().filter(|&number| number > 0);
            node = above.and_then(|above| number.map_or_else(|| above.child(part), |_| above.items()));
            pointer.push_str(&number.map_or_else(|| format!("/{part}"), |number| format!("/{}", number - 1)));
        }
        match node.filter(|&node| is_number(node)) {
            Some(_) => Ok(Self { path: path.to_owned(), pointers: vec![pointer] }),
            None => Err(OutputError { output: path.to_owned(), nearest: nearest_path(path, root, is_number) }),
        }
    }

    /// Path in the summary of a pair, and the mesh of a stage that it is of.
    fn of_pair(&self) -> (Option<StageMesh>, &str) {
        let of_mesh = |mesh: StageMesh| Some((Some(mesh), self.path.strip_prefix(mesh.table())?.strip_prefix('.')?));
        StageMesh::BOTH.into_iter().find_map(of_mesh).unwrap_or((None, &self.path))
    }

    /// Whether it is one of the run's statements about its own error, which take runs of their own.
    pub fn is_of_error(&self) -> bool {
        self.of_pair().1.starts_with("error.")
    }

    /// Whether it is of the transmission error over torque, which takes mesh cycles of its own.
    pub fn is_of_torque_curve(&self) -> bool {
        self.of_pair().1.starts_with("transmission_error_over_torque.")
    }

    /// Whether it is the life to a limit.
    pub fn is_life(&self) -> bool {
        self.of_pair().1.starts_with("life.")
    }

    /// Duration of a run that comes to no limit, where the output is the life to a limit.
    pub fn at_least(&self, summary: &Value) -> Option<f64> {
        let (mesh, path) = self.of_pair();
        let time = path.strip_prefix("life.").filter(|time| matches!(*time, "hours" | "revolutions"))?;
        let summary = mesh.map_or(summary, |mesh| &summary[mesh.table()]);
        summary["life"].is_object().then(|| summary[time].as_f64())?
    }

    /// Value in the summary; none where the run does not compute it.
    pub fn of(&self, summary: &Value) -> Option<f64> {
        let numbers: Option<Vec<f64>> =
            self.pointers.iter().map(|pointer| summary.pointer(pointer).and_then(Value::as_f64)).collect();
        numbers?.into_iter().reduce(f64::max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn outputs_are_paths_of_numbers() {
        for path in [
            "pinion.peak_wear_um",
            "new.transmission_error_um.peak_to_peak",
            "error.total.peak_wear.pinion",
            "geometry.gears.wheel.teeth",
            "helical.wear.pinion.root_wear_um.3",
            "new.sharp_edge_pressure_MPa",
            "phases.2.wheel.worn_volume_mm3",
            "temperature.greatest_rise_new_K",
        ] {
            assert!(SummaryOutput::find(path).is_ok(), "{path}");
        }
        let phase = SummaryOutput::find("phases.2.wheel.worn_volume_mm3").unwrap();
        let summary = serde_json::json!({ "phases": [null, { "wheel": { "worn_volume_mm3": 1.5 } }] });
        assert_eq!((phase.of(&summary), phase.of(&serde_json::json!({}))), (Some(1.5), None));
        assert_eq!(
            SummaryOutput::find("pinion_peak_wear_um").map(|output| output.path),
            Ok("pinion.peak_wear_um".to_owned())
        );
        assert_eq!(
            SummaryOutput::find("pinion.peak_ware_um").unwrap_err().nearest.as_deref(),
            Some("pinion.peak_wear_um")
        );
        let of_either = SummaryOutput::find("peak_wear_um").unwrap();
        let gears = serde_json::json!({ "pinion": { "peak_wear_um": 1.0 }, "wheel": { "peak_wear_um": 2.0 } });
        assert_eq!((of_either.of(&gears), of_either.of(&summary)), (Some(2.0), None));
        for figure in figures::all() {
            assert!(SummaryOutput::find(&figure.name).is_ok(), "{}", figure.name);
        }
        for path in ["title", "phases.0.hours", "pinion", ""] {
            assert!(SummaryOutput::find(path).is_err(), "{path}");
        }
    }
}
