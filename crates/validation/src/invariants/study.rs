//! The study: scenes drawn, run, judged, one a thread, and put together in the order of their numbers.

use std::cell::Cell;
use std::collections::BTreeMap;
use std::time::Instant;

use toml::Table;

use super::carried_out::{Ended, carried_out};
use super::comparison::Measured;
use super::record::{InvariantsRecord, Refusal, StatementRow, Violation};
use super::relation::{RelationOutcome, SceneRelation, Subject};
use super::{relations, scene_generator};
use crate::record::Tier;
use crate::soundness;
use gearwear::spread::spread;
use gearwear_physics::observer::Observer;
use gearwear_physics::results::invariant::Invariant;

/// A scene is tested against every fourth relation.
const STRIDE: u64 = 4;
/// Name of the statement that a scene runs or is refused.
const RUNS: &str = "runs or is refused";
/// Name of the statement that a record is sound.
const SOUND: &str = "sound";

/// The word among cases of the validation suite that stands for random scenes.
pub const INVARIANTS: &str = "invariants";

/// Range of scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SceneRange {
    pub seed: u64,
    /// Number of the first.
    pub first: u64,
    pub count: u64,
}

impl SceneRange {
    /// Range of a tier of the validation suite, of the first seed.
    pub fn of_tier(tier: Option<Tier>) -> Self {
        Self { seed: 1, first: 0, count: if tier == Some(Tier::Smoke) { 100 } else { 1000 } }
    }
}

/// Findings on one scene.
struct OfScene {
    index: u64,
    ended: Option<Ended>,
    runs: u64,
    found: Vec<Finding>,
}

/// A statement held against a scene.
struct Finding {
    statement: String,
    kind: &'static str,
    states: String,
    reason: String,
    /// The worst of its figures; none where the other scene gave none.
    worst: Option<Measured>,
    /// Defect of the program beside figures.
    defect: Option<String>,
    text: String,
    other: Option<String>,
}

/// Runs the study on `threads` threads; but for times, the record does not depend on their number.
pub fn run(asked: SceneRange, threads: usize, observer: &dyn Observer) -> InvariantsRecord {
    let start = Instant::now();
    let relations = relations::all();
    let tasks: Vec<u64> = (asked.first..asked.first + asked.count).collect();
    let mut record = InvariantsRecord {
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        seed: asked.seed,
        first: asked.first,
        count: asked.count,
        drawn: 0,
        ran: 0,
        refused: 0,
        worn_through: 0,
        runs: 0,
        violations: Vec::new(),
        statements: Vec::new(),
        refusals: Vec::new(),
        threads,
        wall_s: 0.0,
    };
    let mut rows = StatementRows::of(&relations);
    // Scenes finished before one of a lower number: the record takes them in order.
    let mut early: BTreeMap<u64, OfScene> = BTreeMap::new();
    let mut next = asked.first;
    spread(
        &tasks,
        threads.max(1),
        observer,
        |&index, within| of_scene(asked.seed, index, &relations, within),
        |scene| {
            record.drawn += 1;
            early.insert(scene.index, scene);
            while let Some(scene) = early.remove(&next) {
                take(scene, &mut record, &mut rows);
                next += 1;
            }
            observer.counted(record.drawn as usize, tasks.len(), "scenes", "");
            true
        },
    );
    // Of an interrupted study some numbers are missing.
    early.into_values().for_each(|scene| take(scene, &mut record, &mut rows));
    record.statements = rows.0;
    record.wall_s = start.elapsed().as_secs_f64();
    record
}

/// Findings on one scene; `None` where it was interrupted.
fn of_scene(seed: u64, index: u64, relations: &[SceneRelation], observer: &dyn Observer) -> Option<OfScene> {
    let table = scene_generator::scene(seed, index);
    let runs = Cell::new(1);
    let mut scene = OfScene { index, ended: None, runs: 1, found: Vec::new() };
    match carried_out(&table, observer) {
        Err(Ended::Interrupted) => return None,
        Err(ended) => {
            scene.found.push(Finding::of_run(RUNS, &table, None, ended.defect()));
            scene.ended = Some(ended);
        }
        Ok(record) => {
            scene.found.push(Finding::of_run(RUNS, &table, None, None));
            let count = |table: &Table| {
                runs.set(runs.get() + 1);
                carried_out(table, observer)
            };
            let subject = Subject { table: &table, record: &record, run: &count };
            scene.found.extend(own_invariants(&subject)?);
            let tried = relations
                .iter()
                .enumerate()
                .filter(|(k, relation)| relation.is_rare || (index + *k as u64).is_multiple_of(STRIDE));
            for (_, relation) in tried {
                match (relation.check)(&subject) {
                    RelationOutcome::NotOfThisScene => {}
                    RelationOutcome::Ended { how: Ended::Interrupted, .. } => return None,
                    verdict => scene.found.extend(Finding::of_relation(relation, &table, verdict)),
                }
            }
        }
    }
    scene.runs = runs.get();
    Some(scene)
}

fn measured(invariant: &Invariant) -> Option<Measured> {
    let place = invariant.place.clone().unwrap_or_default();
    Some(Measured::new(place, invariant.value?, invariant.bound?))
}

/// The statements that hold for every run by itself. Of too few points and positions for its contacts a run says that they are: its volumes are held
/// against those of a finer run. None where that was interrupted.
fn own_invariants(subject: &Subject<'_>) -> Option<Vec<Finding>> {
    let (table, record) = (subject.table, subject.record);
    let mut found = vec![Finding::of_run(SOUND, table, None, soundness::fault(record))];
    for invariant in &record.summary.invariants {
        let Some(mut value) = measured(invariant) else { continue };
        if invariant.name.starts_with("volume") && is_violated(&value) {
            let finer = match (subject.run)(&subject.finer()) {
                Err(Ended::Interrupted) => return None,
                finer => finer.ok(),
            };
            let same =
                finer.iter().flat_map(|finer| &finer.summary.invariants).find(|same| same.name == invariant.name);
            value = same.and_then(measured).unwrap_or(value);
        }
        found.push(Finding {
            states: invariant.how.clone(),
            ..Finding::of_run(&invariant.name, table, Some(value), None)
        });
    }
    Some(found)
}

impl Finding {
    fn of_run(statement: &str, table: &Table, worst: Option<Measured>, defect: Option<String>) -> Self {
        let is_wrong = defect.is_some() || worst.as_ref().is_some_and(is_violated);
        Self {
            statement: statement.to_owned(),
            kind: "run",
            states: String::new(),
            reason: String::new(),
            worst,
            defect,
            text: if is_wrong { table.to_string() } else { String::new() },
            other: None,
        }
    }

    fn of_relation(relation: &SceneRelation, table: &Table, verdict: RelationOutcome) -> Option<Self> {
        let (other, worst, defect) = match verdict {
            RelationOutcome::NotOfThisScene => return None,
            RelationOutcome::Ended { scene, how } => (scene, None, how.defect()),
            RelationOutcome::Measured { scene, figures } => {
                (scene, figures.into_iter().max_by(|a, b| a.used().total_cmp(&b.used())), None)
            }
        };
        let own = Self::of_run(relation.name, table, worst, defect);
        let other = (!own.text.is_empty()).then(|| other.to_string());
        Some(Self {
            kind: "relation",
            states: relation.states.to_owned(),
            reason: relation.bound.to_owned(),
            other,
            ..own
        })
    }
}

fn is_violated(measured: &Measured) -> bool {
    measured.value.is_nan() || measured.bound.is_nan() || measured.value > measured.bound
}

/// The rows of all statements, in the order in which they were first found.
struct StatementRows(Vec<StatementRow>);

impl StatementRows {
    /// Rows of `relations`, also of those that no scene comes to.
    fn of(relations: &[SceneRelation]) -> Self {
        let mut rows = Self(Vec::new());
        for relation in relations {
            rows.row(relation.name, "relation", relation.states, relation.bound);
        }
        rows
    }

    fn row(&mut self, statement: &str, kind: &str, states: &str, reason: &str) -> &mut StatementRow {
        let index = self.0.iter().position(|row| row.statement == statement).unwrap_or(self.0.len());
        if index == self.0.len() {
            self.0.push(StatementRow {
                statement: statement.to_owned(),
                kind: kind.to_owned(),
                scenes: 0,
                violated: 0,
                not_compared: 0,
                worst_used: 0.0,
                worst_value: 0.0,
                worst_bound: 0.0,
                worst_figure: String::new(),
                worst_scene: None,
                states: states.to_owned(),
                reason: reason.to_owned(),
            });
        }
        &mut self.0[index]
    }
}

/// Adds a scene to the record.
fn take(scene: OfScene, record: &mut InvariantsRecord, rows: &mut StatementRows) {
    record.runs += scene.runs;
    match &scene.ended {
        None => record.ran += 1,
        Some(Ended::Refused(message)) => {
            record.refused += 1;
            let kind = without_numbers(message);
            match record.refusals.iter_mut().find(|known| without_numbers(&known.message) == kind) {
                Some(known) => known.count += 1,
                None => record.refusals.push(Refusal { message: message.clone(), count: 1, first_scene: scene.index }),
            }
        }
        Some(Ended::WornThrough) => record.worn_through += 1,
        Some(Ended::NotConverged(_) | Ended::Panicked(_) | Ended::Interrupted) => {}
    }
    for finding in scene.found {
        let row = rows.row(&finding.statement, finding.kind, &finding.states, &finding.reason);
        if finding.kind == "relation" && finding.worst.is_none() && finding.defect.is_none() {
            row.not_compared += 1;
            continue;
        }
        row.scenes += 1;
        let violated = finding.defect.is_some() || finding.worst.as_ref().is_some_and(is_violated);
        row.violated += u64::from(violated);
        if let Some(worst) =
            finding.worst.as_ref().filter(|worst| row.worst_scene.is_none() || worst.used() > row.worst_used)
        {
            (row.worst_used, row.worst_value, row.worst_bound) = (worst.used(), worst.value, worst.bound);
            (row.worst_figure, row.worst_scene) = (worst.figure.clone(), Some(scene.index));
        }
        if violated {
            let worst = finding.worst.as_ref();
            record.violations.push(Violation {
                scene: scene.index,
                statement: finding.statement,
                figure: finding.defect.or_else(|| worst.map(|worst| worst.figure.clone())).unwrap_or_default(),
                value: worst.map(|worst| worst.value),
                bound: worst.map(|worst| worst.bound),
                text: finding.text,
                other: finding.other,
            });
        }
    }
}

/// The message with its numbers taken out: its kind.
fn without_numbers(message: &str) -> String {
    message.chars().filter(|c| !c.is_ascii_digit() && !matches!(c, '.' | '-' | '+')).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_physics::observer::Unwatched;

    /// Scenes give the same on one and two threads, and the record of the whole is that of its parts.
    #[test]
    fn threads_and_parts_change_nothing() {
        let asked = SceneRange { seed: 5, first: 0, count: 6 };
        let (one, two) = (run(asked, 1, &Unwatched), run(asked, 2, &Unwatched));
        assert_eq!(
            (&one.statements, one.ran, one.refused, one.runs),
            (&two.statements, two.ran, two.refused, two.runs)
        );
        let [early, late] = [0, 3].map(|first| run(SceneRange { first, count: 3, ..asked }, 1, &Unwatched));
        assert_eq!((one.ran, one.runs), (early.ran + late.ran, early.runs + late.runs));
        assert!(one.ran > 0);
    }

    /// Scenes that once violated a statement, or whose bound was once too narrow.
    #[test]
    fn reg_scenes_that_broke_a_statement_hold() {
        for (seed, first, broke) in [
            (1, 602, "wear of the simplified model became less at flank points"),
            (3, 268, "rounding decided whether a contact window grew"),
            (3, 1576, "the kink of a relief lay between samples of a contact"),
            (3, 1776, "rows ran across the jump where slices come all at once"),
            (7, 1016, "the first and the last contact of a slice stood half of their stretch off"),
            (7, 3922, "loads jumped where tip edges are followed no farther"),
            (7, 5133, "positions were farther apart than contacts are wide"),
            (7, 5546, "last bits chose other adaptive steps"),
            (11, 1536, "a window ended within a tip rounding, with contact beside it"),
            (13, 2877, "a window ended where flanks part otherwise than a parabola, with contact beside it"),
            (19, 5514, "the last bit decided whether the contact at E goes on beyond it"),
            (19, 14962, "the last bit decided whether the contact at E goes on beyond it"),
            (19, 6906, "all points of a window moved like those in its middle"),
            (23, 13470, "longer windows sampled the gap elsewhere"),
            (23, 13706, "a point between the outermost sample in contact and the next was left out"),
            (31, 8329, "a point beyond the sample beside the contact was left out"),
            (31, 11836, "the last bit decided how far apart the samples of a window were"),
            (31, 12089, "the face width's last bit decided how long a window was"),
            (31, 14685, "curvature raised penetration beyond the end of a window"),
            (11, 6136, "asked too much: strains of a tenth"),
            (13, 833, "asked too much: 24 positions"),
            (13, 2255, "asked too much: the sign of rounding"),
            (17, 501, "asked too much: 71 flank points under little load"),
            (19, 6456, "asked too much: a transmission error that lags where the path ends"),
            (19, 12644, "asked too much: a finer new pair whose steps of wear were not stable"),
            (41, 1877, "asked too much: rounding of a mesh order beside orders a million times as great"),
            (19, 14364, "asked too much: adaptive steps through severe wear on springs that sampled the gap elsewhere"),
        ] {
            let record = run(SceneRange { seed, first, count: 1 }, 1, &Unwatched);
            assert_eq!((record.ran, &record.violations[..]), (1, &[][..]), "{seed} {first}: {broke}");
        }
    }
}
