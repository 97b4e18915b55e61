//! What a finished run left behind, as far as it is shown beside others: `summary.json`, `scene.toml` and the tables.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;

use crate::gear::{Gear, PerGear};
use crate::results::error::TotalError;
use crate::results::life::LifeSummary;
use crate::results::run::ReportedBy;
use crate::studies::compare::run_folder::{self, RunFolder, RunFolderError};

/// `summary.json`, in part.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct RunSummary {
    pub title: String,
    pub scene_hash: String,
    /// Who reports, and when; none where the scene does not say it.
    pub report: Option<ReportedBy>,
    pub revolutions: f64,
    pub contact: ContactSummary,
    pub new: MeshSummary,
    pub worn: MeshSummary,
    pub pinion: FlankSummary,
    pub wheel: FlankSummary,
    pub helical: Option<FaceSummary>,
    pub life: Option<LifeSummary>,
    pub error: ErrorSummary,
}

/// Of the load under which new and worn pair are stated.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct ContactSummary {
    pub line_load_N_per_mm: f64,
}

/// Of the mesh cycle.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct MeshSummary {
    pub peak_pressure_MPa: Option<f64>,
    pub flank_pressure_MPa: Option<f64>,
    pub tip_edge_line_load_N_per_mm: Option<f64>,
    pub tip_edge_mean_pressure_MPa: Option<f64>,
    pub transmission_error_um: RangeSummary,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct RangeSummary {
    pub peak_to_peak: Option<f64>,
}

/// Of a flank's wear.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct FlankSummary {
    pub peak_wear_um: Option<f64>,
    pub tip_edge_wear_um: Option<f64>,
    pub below_sap_wear_um: Option<f64>,
    pub worn_volume_mm3: Option<f64>,
}

/// Of the face width.
#[allow(non_snake_case, reason = "the contract's key names")]
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct FaceSummary {
    pub K_Hbeta_new: Option<f64>,
    pub K_Hbeta_worn: Option<f64>,
}

#[derive(Debug, Clone, PartialEq, Deserialize)]
pub(crate) struct ErrorSummary {
    pub total: TotalError,
    pub volume_balance: Option<f64>,
}

/// Columns of numbers by name; an empty field is no number.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Columns(BTreeMap<String, Vec<f64>>);

impl Columns {
    /// The values of a column; none where the file lacks it.
    pub(crate) fn get(&self, name: &str) -> &[f64] {
        self.0.get(name).map_or(&[], Vec::as_slice)
    }
}

/// A finished run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FinishedRun {
    /// As it is called here: the name of its folder.
    pub name: String,
    pub summary: RunSummary,
    /// The keys of its scene, `pair.face_width_mm`, with their values as they stand there.
    pub scene: BTreeMap<String, String>,
    pub mesh_cycle: Columns,
    pub flanks: PerGear<Columns>,
}

impl FinishedRun {
    /// Reads the folder of a finished run.
    pub(crate) fn read(folder: &Path, name: String) -> Result<Self, RunFolderError> {
        let summary = run_folder::summary(folder)?;
        let path = RunFolder::scene_path(folder);
        let given = run_folder::read(&path)?;
        let table: toml::Table = given.parse().map_err(|error: toml::de::Error| {
            let before = error.span().map_or(0, |span| span.start).min(given.len());
            let line = given.as_bytes()[..before].iter().filter(|&&byte| byte == b'\n').count() as u64 + 1;
            damaged(&path, line, error.message().to_owned())
        })?;
        let mut scene = BTreeMap::new();
        flatten("", &toml::Value::Table(table), &mut scene);
        scene.remove("title");
        // Who reports is no difference of the pair.
        scene.retain(|key, _| !key.starts_with("report."));
        Ok(Self {
            name,
            summary,
            scene,
            mesh_cycle: columns(&folder.join("mesh_cycle.csv"))?,
            flanks: PerGear {
                pinion: columns(&folder.join(format!("{}.csv", Gear::Pinion.name())))?,
                wheel: columns(&folder.join(format!("{}.csv", Gear::Wheel.name())))?,
            },
        })
    }

    /// Radius and greatest wear over the face width at each point of a flank.
    pub(crate) fn wear_profile(&self, gear: Gear) -> (Vec<f64>, Vec<f64>) {
        let flank = &self.flanks[gear];
        let (points, radii, wear) = (flank.get("point"), flank.get("radius_mm"), flank.get("wear_um"));
        let count = points.iter().copied().fold(-1.0, f64::max) + 1.0;
        // A flank has no more points than rows, whatever a damaged table says.
        let count = (count as usize).min(points.len());
        let mut profile = vec![0.0_f64; count];
        for (point, wear_um) in points.iter().zip(wear) {
            if let Some(greatest) = profile.get_mut(*point as usize) {
                *greatest = greatest.max(*wear_um);
            }
        }
        (radii[..count.min(radii.len())].to_vec(), profile)
    }
}

fn damaged(path: &Path, line: u64, found: String) -> RunFolderError {
    let allowed = "what this version of gearwear run writes".to_owned();
    RunFolderError::Damaged { path: path.to_owned(), line, found, allowed }
}

fn columns(path: &Path) -> Result<Columns, RunFolderError> {
    let text = run_folder::read(path)?;
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let refused = |error: csv::Error| damaged(path, error.position().map_or(0, csv::Position::line), error.to_string());
    let names: Vec<String> = reader.headers().map_err(refused)?.iter().map(str::to_owned).collect();
    let mut values: Vec<Vec<f64>> = vec![Vec::new(); names.len()];
    for row in reader.records() {
        let row = row.map_err(refused)?;
        // A word, such as true, is no number.
        values.iter_mut().zip(&row).for_each(|(column, field)| column.push(field.parse().unwrap_or(f64::NAN)));
    }
    Ok(Columns(names.into_iter().zip(values).collect()))
}

/// Every key below `value` with its value.
fn flatten(key: &str, value: &toml::Value, into: &mut BTreeMap<String, String>) {
    match value {
        toml::Value::Table(table) => {
            for (name, value) in table {
                let key = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
                flatten(&key, value, into);
            }
        }
        other => {
            into.insert(key.to_owned(), other.to_string());
        }
    }
}
