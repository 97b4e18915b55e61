//! Runs side by side, as plain data: what the files of the comparison hold.

use schemars::JsonSchema;
use serde::Serialize;

use super::finished_run::{FinishedRun, RunSummary};
use crate::reference::steel_yield;
use crate::results::error::TotalError;

/// A comparison of runs, each with the first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct VariantsRecord {
    pub program_version: String,
    /// The main result in words.
    pub answer: String,
    pub runs: Vec<Variant>,
    /// Keys in which their scenes differ, each with its value in every run; empty where a run leaves it out.
    pub keys: Vec<VariedKey>,
    pub warnings: Vec<String>,
    /// In `variants.csv`.
    #[serde(skip)]
    pub rows: Vec<VariantRow>,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct Variant {
    pub name: String,
    pub title: String,
    pub scene_hash: String,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub(crate) struct VariedKey {
    pub key: String,
    pub values: Vec<String>,
}

/// A figure of a run.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub(crate) struct VariantRow {
    /// what it is, as a path in summary.json
    pub figure: String,
    /// the same in words
    pub meaning: String,
    /// of the value
    pub unit: String,
    /// name of the run
    pub run: String,
    /// the figure; empty where the run has none
    pub value: Option<f64>,
    /// relative error that the run states of it (error.total); empty where that is not known
    pub error: Option<f64>,
    /// relative difference to the first run; empty in its own row
    pub difference: Option<f64>,
    /// errors of both together, relative to the first run
    pub errors_together: Option<f64>,
    /// whether the difference is more than the errors together: true, false, or empty where these are not known
    pub significant: Option<bool>,
}

impl VariantRow {
    /// What it is, with its unit.
    pub(crate) fn named(&self) -> String {
        if self.unit.is_empty() { self.meaning.clone() } else { format!("{}, {}", self.meaning, self.unit) }
    }
}

/// A figure that runs are compared by.
pub(crate) struct Figure {
    path: &'static str,
    pub meaning: &'static str,
    pub unit: &'static str,
    value: Value,
    pub error: Error,
}

/// What the figure at this path in `summary.json` is; none where it is none that runs are compared by.
pub(crate) fn described(path: &str) -> Option<&'static Figure> {
    FIGURES.iter().find(|figure| figure.path == path)
}

type Value = fn(&RunSummary) -> Option<f64>;
/// Of the errors that a run states, the one of the figure; none where it states none.
pub(crate) type Error = fn(&TotalError) -> Option<f64>;

impl Figure {
    const fn of(path: &'static str, meaning: &'static str, unit: &'static str, value: Value, error: Error) -> Self {
        Self { path, meaning, unit, value, error }
    }
}

static FIGURES: [Figure; 23] = [
    Figure::of(
        "pinion.peak_wear_um",
        "Maximum wear of the pinion, active profile",
        "µm",
        |s| s.pinion.peak_wear_um,
        |e| e.peak_wear.pinion,
    ),
    Figure::of(
        "wheel.peak_wear_um",
        "Maximum wear of the wheel, active profile",
        "µm",
        |s| s.wheel.peak_wear_um,
        |e| e.peak_wear.wheel,
    ),
    Figure::of(
        "pinion.tip_edge_wear_um",
        "Maximum wear of the pinion, tip edge",
        "µm",
        |s| s.pinion.tip_edge_wear_um,
        |e| e.tip_edge_wear.pinion,
    ),
    Figure::of(
        "wheel.tip_edge_wear_um",
        "Maximum wear of the wheel, tip edge",
        "µm",
        |s| s.wheel.tip_edge_wear_um,
        |e| e.tip_edge_wear.wheel,
    ),
    Figure::of(
        "pinion.below_sap_wear_um",
        "Maximum wear of the pinion, below the active profile",
        "µm",
        |s| s.pinion.below_sap_wear_um,
        |_| None,
    ),
    Figure::of(
        "wheel.below_sap_wear_um",
        "Maximum wear of the wheel, below the active profile",
        "µm",
        |s| s.wheel.below_sap_wear_um,
        |_| None,
    ),
    Figure::of(
        "worn.transmission_error_um.peak_to_peak",
        "Transmission error, peak to peak, worn",
        "µm",
        |s| s.worn.transmission_error_um.peak_to_peak,
        |e| e.transmission_error_peak_to_peak,
    ),
    Figure::of(
        "new.transmission_error_um.peak_to_peak",
        "Transmission error, peak to peak, new",
        "µm",
        |s| s.new.transmission_error_um.peak_to_peak,
        |_| None,
    ),
    Figure::of(
        "worn.flank_pressure_MPa",
        "Flank pressure, worn",
        "MPa",
        |s| s.worn.flank_pressure_MPa,
        |e| e.flank_pressure.worn,
    ),
    Figure::of(
        "new.flank_pressure_MPa",
        "Flank pressure, new",
        "MPa",
        |s| s.new.flank_pressure_MPa,
        |e| e.flank_pressure.new,
    ),
    Figure::of(
        "worn.tip_edge_line_load_N_per_mm",
        "Line load of a tip edge, worn",
        "N/mm",
        |s| s.worn.tip_edge_line_load_N_per_mm,
        |_| None,
    ),
    Figure::of(
        "new.tip_edge_line_load_N_per_mm",
        "Line load of a tip edge, new",
        "N/mm",
        |s| s.new.tip_edge_line_load_N_per_mm,
        |_| None,
    ),
    Figure::of(
        "worn.tip_edge_mean_pressure_MPa",
        "Pressure of a tip edge over 0.04 mm, worn",
        "MPa",
        |s| s.worn.tip_edge_mean_pressure_MPa,
        |_| None,
    ),
    Figure::of(
        "new.tip_edge_mean_pressure_MPa",
        "Pressure of a tip edge over 0.04 mm, new",
        "MPa",
        |s| s.new.tip_edge_mean_pressure_MPa,
        |_| None,
    ),
    Figure::of(
        "worn.peak_pressure_MPa",
        "Maximum pressure at a point, worn",
        "MPa",
        |s| s.worn.peak_pressure_MPa,
        |_| None,
    ),
    Figure::of(
        "new.peak_pressure_MPa",
        "Maximum pressure at a point, new",
        "MPa",
        |s| s.new.peak_pressure_MPa,
        |_| None,
    ),
    Figure::of("pinion.worn_volume_mm3", "Worn volume of the pinion", "mm³", |s| s.pinion.worn_volume_mm3, |_| None),
    Figure::of("wheel.worn_volume_mm3", "Worn volume of the wheel", "mm³", |s| s.wheel.worn_volume_mm3, |_| None),
    Figure::of(
        "helical.K_Hbeta_new",
        "Face load factor, new",
        "",
        |s| s.helical.as_ref().and_then(|face| face.K_Hbeta_new),
        |_| None,
    ),
    Figure::of(
        "helical.K_Hbeta_worn",
        "Face load factor, worn",
        "",
        |s| s.helical.as_ref().and_then(|face| face.K_Hbeta_worn),
        |_| None,
    ),
    Figure::of(
        "error.volume_balance",
        "Difference of the worn volumes of pinion and wheel",
        "",
        |s| s.error.volume_balance,
        |_| None,
    ),
    Figure::of("life.hours", "Life", "h", |s| s.life.as_ref().and_then(|life| life.hours), |_| None),
    Figure::of(
        "life.revolutions",
        "Life",
        "pinion revolutions",
        |s| s.life.as_ref().and_then(|life| life.revolutions),
        |_| None,
    ),
];

/// Durations and loads this close, relatively, are the same.
const SAME: f64 = 1e-9;

impl VariantsRecord {
    /// Of `runs` (two at least), each compared with the first.
    pub(crate) fn new(runs: &[FinishedRun]) -> Self {
        let rows: Vec<VariantRow> = FIGURES
            .iter()
            .filter(|figure| runs.iter().any(|run| (figure.value)(&run.summary).is_some()))
            .flat_map(|figure| runs.iter().map(move |run| row(figure, &runs[0], run)))
            .collect();
        let variant = |run: &FinishedRun| Variant {
            name: run.name.clone(),
            title: run.summary.title.clone(),
            scene_hash: run.summary.scene_hash.clone(),
        };
        Self {
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            answer: answer(&rows, &runs[0].name),
            runs: runs.iter().map(variant).collect(),
            keys: varied_keys(runs),
            warnings: warnings(runs),
            rows,
        }
    }

    /// The rows of one figure after the other, each with those of all runs.
    pub(crate) fn figures(&self) -> impl Iterator<Item = &[VariantRow]> {
        self.rows.chunks_exact(self.runs.len())
    }
}

fn row(figure: &Figure, first: &FinishedRun, run: &FinishedRun) -> VariantRow {
    let of = |run: &FinishedRun| ((figure.value)(&run.summary), (figure.error)(&run.summary.error.total));
    let ((base, base_error), (value, error)) = (of(first), of(run));
    let compared = if run.name == first.name { None } else { base.filter(|base| *base != 0.0).zip(value) };
    let difference = compared.map(|(base, value)| value / base - 1.0);
    let errors_together = compared.and_then(|(base, value)| Some(base_error? + error? * (value / base).abs()));
    VariantRow {
        figure: figure.path.to_owned(),
        meaning: figure.meaning.to_owned(),
        unit: figure.unit.to_owned(),
        run: run.name.clone(),
        value,
        error,
        difference,
        errors_together,
        significant: difference.zip(errors_together).map(|(difference, errors)| difference.abs() > errors),
    }
}

/// What the maximum wear of both gears says of each variant.
fn answer(rows: &[VariantRow], first: &str) -> String {
    let mut sentences = Vec::new();
    for row in rows.iter().filter(|row| row.figure.ends_with(".peak_wear_um")) {
        let Some(difference) = row.difference else { continue };
        let gear = row.figure.split('.').next().unwrap_or_default();
        let per_cent = format!("{:.1} %", 100.0 * difference.abs());
        let more = if difference < 0.0 { "less" } else { "more" };
        let errors = row.errors_together.map(|errors| format!("{:.1} %", 100.0 * errors)).unwrap_or_default();
        let judged = match row.significant {
            Some(true) => format!("which is larger than the errors of both runs together ({errors})"),
            Some(false) => {
                format!("which is within the errors of both runs together ({errors}): they cannot be ranked by it")
            }
            None => "whose error is not known, as not both runs were verified".to_owned(),
        };
        sentences.push(format!(
            "The maximum wear of the {gear} is {per_cent} {more} with {} than with {first}, {judged}.",
            row.run
        ));
    }
    sentences.join(" ")
}

/// Keys in which the scenes differ.
fn varied_keys(runs: &[FinishedRun]) -> Vec<VariedKey> {
    let mut keys: Vec<&String> = runs.iter().flat_map(|run| run.scene.keys()).collect();
    keys.sort();
    keys.dedup();
    let values =
        |key: &String| runs.iter().map(|run| run.scene.get(key).cloned().unwrap_or_default()).collect::<Vec<_>>();
    let varied = |key: &String| {
        let values = values(key);
        values.iter().any(|value| *value != values[0]).then(|| VariedKey { key: key.clone(), values })
    };
    keys.into_iter().filter_map(varied).collect()
}

fn warnings(runs: &[FinishedRun]) -> Vec<String> {
    let first = &runs[0];
    let differs = |run: &FinishedRun, of: fn(&FinishedRun) -> f64| (of(run) / of(first) - 1.0).abs() > SAME;
    let (duration, load) =
        (|run: &FinishedRun| run.summary.revolutions, |run: &FinishedRun| run.summary.contact.line_load_N_per_mm);
    let durations = runs.iter().filter(|run| differs(run, duration)).map(|run| {
        format!(
            "{} runs {:.4e} pinion revolutions, {} {:.4e}: wear of different durations is compared",
            run.name, run.summary.revolutions, first.name, first.summary.revolutions
        )
    });
    let loads = runs.iter().filter(|run| differs(run, load)).map(|run| {
        format!(
            "pressure, load share and transmission error of {} are under {:.1} N/mm, those of {} under {:.1} N/mm: they differ by the \
             load too",
            run.name,
            load(run),
            first.name,
            load(first)
        )
    });
    let pressures = runs.iter().filter_map(|run| {
        let (new, worn) = (run.summary.new.flank_pressure_MPa, run.summary.worn.flank_pressure_MPa);
        let (pressure_mpa, when) = if worn > new { (worn?, "worn") } else { (new?, "new") };
        steel_yield::warning(pressure_mpa, &format!("{}, {when}", run.name))
    });
    durations.chain(loads).chain(pressures).collect()
}
