//! Runs side by side, as plain data: what the files of the comparison hold.

use schemars::JsonSchema;
use serde::Serialize;

use super::finished_run::FinishedRun;
use gearwear::report::html::reading::capitalised;
use gearwear_bodies::reference::steel_yield;
use gearwear_physics::results::figures::{self, MainFigure};

/// A comparison of runs, each with the first.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariantsRecord {
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
pub struct Variant {
    pub name: String,
    pub title: String,
    pub scene_hash: String,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VariedKey {
    pub key: String,
    pub values: Vec<String>,
}

/// A figure of a run.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct VariantRow {
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
    /// Meaning and unit.
    pub fn named(&self) -> String {
        if self.unit.is_empty() { self.meaning.clone() } else { format!("{}, {}", self.meaning, self.unit) }
    }
}

/// Durations and loads this close, relatively, are the same.
const SAME: f64 = 1e-9;

impl VariantsRecord {
    /// Of `runs` (two at least), each compared with the first.
    pub fn new(runs: &[FinishedRun]) -> Self {
        let rows: Vec<VariantRow> = figures::compared()
            .iter()
            .filter(|figure| runs.iter().any(|run| run.figure(figure).is_some()))
            .flat_map(|figure| runs.iter().map(move |run| row(figure, &runs[0], run)))
            .collect();
        let variants = runs.iter().map(|run| Variant {
            name: run.name.clone(),
            title: run.summary.title.clone(),
            scene_hash: run.summary.scene_hash.clone(),
        });
        Self {
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            answer: answer(&rows, &runs[0].name),
            runs: variants.collect(),
            keys: varied_keys(runs),
            warnings: warnings(runs),
            rows,
        }
    }

    /// The rows of one figure after the other, each with those of all runs.
    pub fn figures(&self) -> impl Iterator<Item = &[VariantRow]> {
        self.rows.chunks_exact(self.runs.len())
    }
}

fn row(figure: &MainFigure, first: &FinishedRun, run: &FinishedRun) -> VariantRow {
    let [(base, base_error), (value, error)] = [first, run].map(|run| (run.figure(figure), run.error(figure)));
    let compared = if run.name == first.name { None } else { base.filter(|base| *base != 0.0).zip(value) };
    let difference = compared.map(|(base, value)| value / base - 1.0);
    let errors_together = compared.and_then(|(base, value)| Some(base_error? + error? * (value / base).abs()));
    VariantRow {
        figure: figure.name.clone(),
        meaning: capitalised(&figure.heading),
        unit: figure.unit().to_owned(),
        run: run.name.clone(),
        value,
        error,
        difference,
        errors_together,
        significant: difference.zip(errors_together).map(|(difference, errors)| difference.abs() > errors),
    }
}

/// Figures that the answer speaks of, with their names in a sentence.
const ANSWERED: [(&str, &str); 4] = [
    ("pinion.peak_wear_um", "maximum wear of the pinion"),
    ("wheel.peak_wear_um", "maximum wear of the wheel"),
    ("transmission_error_over_life.mean_um", "mean transmission error over life"),
    ("worn.flank_pressure_MPa", "flank pressure of the worn pair"),
];

/// Differences of the wear of both gears, the transmission error and the flank pressure of each variant, in words.
fn answer(rows: &[VariantRow], first: &str) -> String {
    let mut sentences = Vec::new();
    let answered = ANSWERED
        .iter()
        .flat_map(|(path, name)| rows.iter().filter(move |row| row.figure == *path).map(move |row| (row, name)));
    for (row, name) in answered {
        let Some(difference) = row.difference else { continue };
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
        sentences.push(format!("The {name} is {per_cent} {more} with {} than with {first}, {judged}.", row.run));
    }
    sentences.join(" ")
}

/// Keys in which the scenes differ.
fn varied_keys(runs: &[FinishedRun]) -> Vec<VariedKey> {
    let mut keys: Vec<&String> = runs.iter().flat_map(|run| run.scene.keys()).collect();
    keys.sort();
    keys.dedup();
    let said = keys.into_iter().map(|key| {
        let values = runs.iter().map(|run| run.scene.get(key).cloned().unwrap_or_default()).collect();
        VariedKey { key: key.clone(), values }
    });
    said.filter(|varied| varied.values.iter().any(|value| *value != varied.values[0])).collect()
}

/// Line load under which new and worn pair are stated, N/mm.
fn line_load(run: &FinishedRun) -> f64 {
    run.number("contact.line_load_N_per_mm").unwrap_or(f64::NAN)
}

/// Whether two values are not the same, nearly.
fn differ(one: f64, other: f64) -> bool {
    (one / other - 1.0).abs() > SAME
}

fn warnings(runs: &[FinishedRun]) -> Vec<String> {
    let first = &runs[0];
    let durations = runs.iter().filter(|run| differ(run.summary.revolutions, first.summary.revolutions)).map(|run| {
        format!(
            "{} runs {:.4e} pinion revolutions, {} {:.4e}: wear of different durations is compared",
            run.name, run.summary.revolutions, first.name, first.summary.revolutions
        )
    });
    let loads = runs.iter().filter(|run| differ(line_load(run), line_load(first))).map(|run| {
        format!(
            "pressure, load share and transmission error of {} are under {:.1} N/mm, those of {} under {:.1} N/mm: they differ by the \
             load too",
            run.name,
            line_load(run),
            first.name,
            line_load(first)
        )
    });
    let pressures = runs.iter().filter_map(|run| {
        let [new, worn] = ["new.flank_pressure_MPa", "worn.flank_pressure_MPa"].map(|path| run.number(path));
        let (pressure_mpa, when) = if worn > new { (worn?, "worn") } else { (new?, "new") };
        steel_yield::warning(pressure_mpa, &format!("{}, {when}", run.name))
    });
    durations.chain(loads).chain(pressures).collect()
}
