//! Question of `[improve]` of a scene, checked, and its errors.

use gearwear::evaluate::output::SummaryOutput;
use gearwear::journal::JournalError;
use gearwear::report::ReportError;
use gearwear::scene::draft::Draft;
use gearwear::scene::improve_file::ImproveFile;
use gearwear::scene::key::linked_keys;
use gearwear::scene::loaded::{LoadedScene, SceneError};
use gearwear::scene::problem::Problem;
use gearwear::scene::table::other_ways_to_say;
use gearwear::varied_scene::missing_phase;

use super::free_key::{FreeKey, FreeKeyError};
use super::goal::{ImproveGoal, ImproveGoalError, ImproveLimit};

/// Most goals: a front of more is hard to choose from.
pub const MOST_GOALS: usize = 3;
/// Most free keys: a few hundred designs say little of more.
pub const MOST_KEYS: usize = 12;

/// Goals of a scene that names none.
const DEFAULT_GOALS: [&str; 3] = ["pinion.peak_wear_um", "wheel.peak_wear_um", "transmission_error_over_life.mean_um"];

/// Figures that every design keeps.
const WATCHED: [&str; 11] = [
    "pinion.peak_wear_um",
    "wheel.peak_wear_um",
    "pinion.tip_edge_wear_um",
    "wheel.tip_edge_wear_um",
    "new.transmission_error_um.peak_to_peak",
    "worn.transmission_error_um.peak_to_peak",
    "transmission_error_over_life.mean_um",
    "new.flank_pressure_MPa",
    "worn.flank_pressure_MPa",
    "new.tip_edge_line_load_N_per_mm",
    "worn.tip_edge_line_load_N_per_mm",
];

/// Question of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct ImproveQuestion {
    /// Free keys; none: those of the tip reliefs, whose ranges follow from the pair.
    pub free: Vec<FreeKey>,
    pub goals: Vec<ImproveGoal>,
    pub limits: Vec<ImproveLimit>,
    /// Greatest number of designs of the search; `None`: by the number of free keys.
    evaluations: Option<usize>,
    pub seed: u32,
    /// Figures of each design.
    pub figures: Vec<SummaryOutput>,
}

/// Error of a study of improvement.
#[derive(Debug, thiserror::Error)]
pub enum ImproveError {
    #[error(transparent)]
    Scene(#[from] SceneError),
    #[error("the scene as given cannot be run: {0}")]
    Base(String),
    #[error("none of {count} designs has a result; the first says: {first}")]
    NoDesign { count: usize, first: String },
    #[error("none of {count} designs keeps to the limits: {nearest}")]
    NotWithinLimits { count: usize, nearest: String },
    #[error("interrupted")]
    Interrupted,
    #[error(transparent)]
    Journal(#[from] JournalError),
    #[error(transparent)]
    Report(#[from] ReportError),
}

impl ImproveQuestion {
    /// Question of `scene`.
    ///
    /// # Errors
    /// What is wrong with its table `[improve]`, at its place.
    pub fn of(scene: &LoadedScene) -> Result<Self, SceneError> {
        let asked = scene.resolved.file.improve.clone().unwrap_or_default();
        let refused = |problems: Vec<Problem>| scene.given.refused(problems);
        let mut problems = Vec::new();
        let at = |key: String, said: String, help: Option<String>| of_entry(&scene.given.text, &key, &said, help);
        let ImproveFile { free, goals, limits, evaluations, seed } = asked;
        let free: Vec<FreeKey> = read(
            free.unwrap_or_default(),
            "improve.free",
            &mut problems,
            |text| text.parse().map_err(|error: FreeKeyError| (error.to_string(), error.help())),
            &at,
        );
        let of_goal = |error: ImproveGoalError| (error.to_string(), error.help());
        let goals = goals.unwrap_or_else(|| DEFAULT_GOALS.map(str::to_owned).into());
        let (count, key) = (goals.len(), "improve.goals");
        let goals: Vec<ImproveGoal> = read(goals, key, &mut problems, |text| text.parse().map_err(of_goal), &at);
        let limits = limits.unwrap_or_default();
        let limits: Vec<ImproveLimit> =
            read(limits, "improve.limits", &mut problems, |text| text.parse().map_err(of_goal), &at);
        if !(1..=MOST_GOALS).contains(&count) {
            problems.push(at(key.to_owned(), format!("found {count} goals; allowed: 1 to {MOST_GOALS}"), None));
        }
        let draft = Draft::parse(&scene.given.text).map_err(refused)?;
        problems.extend(faults_together(&free, &draft).map(|(key, said)| at(key, said, None)));
        if !problems.is_empty() {
            return Err(refused(problems));
        }
        let mut figures: Vec<SummaryOutput> =
            WATCHED.iter().filter_map(|path| SummaryOutput::find(path).ok()).collect();
        let of_goals = goals.iter().flat_map(|goal| goal.terms.iter().map(|(_, figure)| figure));
        for figure in of_goals.chain(limits.iter().map(|limit| &limit.figure)) {
            if !figures.contains(figure) {
                figures.push(figure.clone());
            }
        }
        let over_torque = figures.iter().find(|figure| figure.is_of_torque_curve());
        if let Some(figure) = over_torque.filter(|_| scene.scene().operation.torque_curve_n_mm.is_empty()) {
            let said =
                format!("found {}; allowed: with operation.torque_curve_Nm, the torques of the curve", figure.path);
            let of_goal = goals.iter().any(|goal| goal.terms.iter().any(|(_, other)| other == figure));
            let key = if of_goal { "improve.goals" } else { "improve.limits" };
            return Err(refused(vec![at(key.to_owned(), said, None)]));
        }
        let evaluations = evaluations.map(|count| count as usize);
        Ok(Self { free, goals, limits, evaluations, seed: seed.unwrap_or(1), figures })
    }

    /// Greatest number of designs of the search.
    pub fn evaluations(&self) -> usize {
        self.evaluations.unwrap_or(50 + 25 * self.free.len())
    }

    /// Figure `path` among those of a design.
    pub fn figure(&self, figures: &[Option<f64>], path: &str) -> Option<f64> {
        let at = self.figures.iter().position(|figure| figure.path == path)?;
        figures.get(at).copied().flatten()
    }
}

/// Entries of a list that can be read; the others are problems at their places.
fn read<T>(
    entries: Vec<String>,
    key: &str,
    problems: &mut Vec<Problem>,
    parse: impl Fn(&str) -> Result<T, (String, Option<String>)>,
    at: &impl Fn(String, String, Option<String>) -> Problem,
) -> Vec<T> {
    let read = entries.iter().enumerate().filter_map(|(place, text)| match parse(text) {
        Ok(entry) => Some(entry),
        Err((said, help)) => {
            problems.push(at(format!("{key}[{place}]"), said, help));
            None
        }
    });
    read.collect()
}

/// Problem at an entry whose message has what was found and what is allowed.
pub fn of_entry(text: &str, key: &str, said: &str, help: Option<String>) -> Problem {
    let (found, allowed) = said.split_once("; allowed: ").unwrap_or((said, "see docs/sweep.md"));
    let found = found.strip_prefix("found ").unwrap_or(found);
    let problem = Problem::at_key(text, key, found.to_owned(), allowed, "");
    Problem { help, ..problem }
}

/// Faults of free keys beside each other or in this scene, with their places.
fn faults_together<'a>(free: &'a [FreeKey], draft: &'a Draft) -> impl Iterator<Item = (String, String)> + 'a {
    let too_many = (free.len() > MOST_KEYS)
        .then(|| ("improve.free".to_owned(), format!("found {} free keys; allowed: at most {MOST_KEYS}", free.len())));
    let faults = free.iter().enumerate().filter_map(|(place, one)| {
        let at = format!("improve.free[{place}]");
        let keys = linked_keys(&one.key);
        let before: Vec<String> = free[..place].iter().flat_map(|other| linked_keys(&other.key)).collect();
        let said_before = keys
            .iter()
            .find(|key| before.contains(key) || other_ways_to_say(key).iter().any(|other| before.contains(other)));
        if let Some(key) = said_before {
            return Some((at, format!("found {key}, which an entry before says too; allowed: each key once")));
        }
        let phase = missing_phase(keys, draft)?;
        Some((at, format!("found {phase}; allowed: a phase that the scene has, numbered from 1")))
    });
    too_many.into_iter().chain(faults)
}
