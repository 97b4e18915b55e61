//! What a journal keeps of a study of uncertainty: which study it is, and a row for each finished run.

use serde::{Deserialize, Serialize};

use super::life::Growth;
use super::sampled_run::SampledQuestion;
use crate::journal::Kept;
use crate::scene::draft::Draft;
use crate::scene::loaded::SceneError;
use crate::scene::opened::{EachMesh, OpenedScene};
use gearwear_bodies::gear::PerGear;

/// A study as far as its runs depend on it. The number of samples is no part of it: more samples go on with the same sequence.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SampledStudy {
    pub program_version: String,
    /// Hash of the scene file as given.
    pub given_hash: String,
    /// Hash of the scene as given, resolved.
    pub scene_hash: String,
    /// Hash of the calibration and the stiffness curve that the scene names; empty where it names none.
    pub inputs_hash: String,
    /// Uncertain keys with their distributions.
    pub uncertain: Vec<String>,
    /// Correlation of their normal scores; empty where they are independent.
    pub correlation: Vec<Vec<f64>>,
    pub outputs: Vec<String>,
    pub limits: Vec<String>,
    pub seed: u32,
    /// Contact surface of the samples.
    pub surface: String,
    /// Places of each flank where the wear of samples A and B is kept.
    pub places: EachMesh<PerGear<usize>>,
}

impl SampledStudy {
    /// Parts of the identity with their names.
    fn said(&self) -> [(&'static str, String); 11] {
        [
            ("program version", self.program_version.clone()),
            ("what is uncertain", self.uncertain.join(" ")),
            ("correlation", format!("{:?}", self.correlation)),
            ("figures", self.outputs.join(", ")),
            ("limits", self.limits.join(" ")),
            ("seed", self.seed.to_string()),
            ("scene", self.given_hash.clone()),
            ("the resolved scene", self.scene_hash.clone()),
            ("files that the scene names", self.inputs_hash.clone()),
            ("contact surface of the samples", self.surface.clone()),
            ("places of the flanks", {
                let places = self.places.all().into_iter().map(|of| format!("{} and {}", of.pinion, of.wheel));
                places.collect::<Vec<_>>().join(" and ")
            }),
        ]
    }

    /// Runs of a point: A, B, and A with each key from B; without the last where keys are correlated.
    pub fn runs_of_a_point(&self) -> usize {
        if self.correlation.is_empty() { 2 + self.uncertain.len() } else { 2 }
    }

    /// Study of `question` on `scene`.
    ///
    /// # Errors
    /// A scene whose text cannot be read again.
    pub fn of(
        scene: &OpenedScene,
        question: &SampledQuestion,
        surface: &str,
        places: EachMesh<PerGear<usize>>,
    ) -> Result<Self, SceneError> {
        let correlation = question.correlation.as_ref();
        let draft = Draft::parse(&scene.given().text).map_err(|problems| scene.refused(problems))?;
        Ok(Self {
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            given_hash: draft.hash(),
            scene_hash: scene.scene_hash(),
            inputs_hash: scene.inputs_hash(),
            uncertain: question.uncertain.iter().map(|one| format!("{}={}", one.key, one.given)).collect(),
            correlation: correlation.map_or_else(Vec::new, |correlation| {
                correlation.matrix.row_iter().map(|row| row.iter().copied().collect()).collect()
            }),
            outputs: question.outputs.iter().map(|output| output.path.clone()).collect(),
            limits: question.limits.iter().map(|limit| format!("{}={}", limit.output, limit.depth_um)).collect(),
            seed: question.seed,
            surface: surface.to_owned(),
            places,
        })
    }
}

impl Kept for SampledStudy {
    type Row = KeptRun;
    const KIND: &'static str = "study of uncertainty";
    const COMMAND: &'static str = "gearwear uncertainty";

    fn number(&self, row: &KeptRun) -> usize {
        row.number
    }

    fn refuses(&self, row: &KeptRun) -> Option<String> {
        let Ok(ran) = &row.ran else { return None };
        let of_flanks = ran.wear_um.as_ref().map(|wear| wear.as_ref().map(|of| of.as_ref().map(Vec::len)));
        let has_wear = row.number % self.runs_of_a_point() < 2;
        let fits = ran.outputs.len() == self.outputs.len()
            && ran.growths.len() == self.limits.len()
            && of_flanks == has_wear.then_some(self.places);
        (!fits).then(|| format!("run {} of another study", row.number))
    }

    fn differences(&self, wanted: &Self) -> Vec<String> {
        let both = self.said().into_iter().zip(wanted.said());
        both.filter(|((_, mine), (_, theirs))| mine != theirs)
            .map(|((what, mine), (_, theirs))| format!("{what}: {mine} and {theirs}"))
            .collect()
    }
}

/// A finished run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct KeptRun {
    /// Number of the run: those of the first point, then those of the second.
    pub number: usize,
    /// What is kept of it, or on one line why it failed.
    pub ran: Result<Ran, String>,
}

/// Part of a run that is kept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ran {
    pub outputs: Vec<ReadOutput>,
    pub growths: Vec<Growth>,
    /// Wear at the places of the bands, for samples A and B only.
    pub wear_um: Option<EachMesh<PerGear<Vec<f32>>>>,
}

/// Output of a run: its value, or the time that a life is known to exceed; neither where the run has none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct ReadOutput {
    pub value: Option<f64>,
    pub at_least: Option<f64>,
}

impl ReadOutput {
    /// `times` the value and until when it is known: a life that is longer is infinite, what the run does not have is no number.
    pub fn times(self, times: f64) -> (f64, f64) {
        match (self.value, self.at_least) {
            (Some(value), _) => (times * value, times * value),
            (None, Some(at_least)) => (f64::INFINITY, times * at_least),
            (None, None) => (f64::NAN, f64::NAN),
        }
    }
}
