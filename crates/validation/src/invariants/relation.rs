//! A relation between a scene and another one made from it, of which physics says how their results follow from each other.

use toml::Table;

use super::carried_out::Ended;
use super::comparison::Measured;
use super::scene_table::{number, with};
use gearwear_physics::results::run::RunRecord;

/// A relation of the suite.
#[derive(Clone, Copy)]
pub struct SceneRelation {
    pub name: &'static str,
    /// Statement in a sentence.
    pub states: &'static str,
    /// Why the bound is what it is.
    pub bound: &'static str,
    /// Whether it applies to so few scenes that it is tested on each of them.
    pub is_rare: bool,
    pub check: fn(&Subject<'_>) -> RelationOutcome,
}

/// A scene that has run.
pub struct Subject<'a> {
    pub table: &'a Table,
    pub record: &'a RunRecord,
    /// Runs another scene.
    pub run: &'a dyn Fn(&Table) -> Result<RunRecord, Ended>,
}

/// Outcome of a relation on a scene.
pub enum RelationOutcome {
    /// The relation does not apply to the scene.
    NotOfThisScene,
    /// The other scene did not run to its end.
    Ended { scene: Table, how: Ended },
    /// Differences found, with the other scene.
    Measured { scene: Table, figures: Vec<Measured> },
}

/// Flank points, positions, and wear steps of a fixed length.
pub(super) const POINTS: &str = "numerics.flank_points";
pub(super) const POSITIONS: &str = "numerics.positions";
const STEP: &str = "numerics.step.revolutions";

/// Refinement of points or positions where the scene's own are too few for its contacts.
const FINER: f64 = 4.0;
/// Further refinement where these are too few as well, as for contacts near a base circle (seed 7, 1232: the worn volume is 56 % off what load and
/// sliding give at 96 positions, 25 % at 192, 10 % at 384, 4 % at 768).
const FINEST: f64 = 16.0;

impl RelationOutcome {
    fn is_beyond(&self) -> bool {
        self.figures().iter().any(|figure| figure.used() > 1.0)
    }

    fn figures(&self) -> &[Measured] {
        match self {
            RelationOutcome::Measured { figures, .. } => figures,
            RelationOutcome::NotOfThisScene | RelationOutcome::Ended { .. } => &[],
        }
    }

    /// Whether it has every figure that is beyond its bound in `other`.
    fn says_of_all_beyond(&self, other: &Self) -> bool {
        let mut beyond = other.figures().iter().filter(|figure| figure.used() > 1.0);
        beyond.all(|figure| self.figures().iter().any(|own| own.figure == figure.figure))
    }
}

/// The scene with `by` times the numbers at `keys`, where it has them. Wear steps of a fixed length are divided by twice that where the flank points
/// are among them: the stable step is proportional to their spacing.
fn finer(table: &Table, keys: &[&str], by: f64) -> Table {
    let mut finer = table.clone();
    for key in keys {
        if let Some(count) = number(table, key) {
            finer = with(&finer, key, (by * count) as i64);
        }
    }
    let step = number(table, STEP).filter(|_| keys.contains(&POINTS));
    match step {
        Some(step) => with(&finer, STEP, step / (2.0 * by)),
        None => finer,
    }
}

impl Subject<'_> {
    /// Runs the scene `other` and judges its record; without figures the relation does not apply.
    pub(super) fn beside(&self, other: Table, judge: impl FnOnce(&RunRecord) -> Vec<Measured>) -> RelationOutcome {
        match (self.run)(&other) {
            Ok(record) => match judge(&record) {
                figures if figures.is_empty() => RelationOutcome::NotOfThisScene,
                figures => RelationOutcome::Measured { figures, scene: other },
            },
            Err(how) => RelationOutcome::Ended { scene: other, how },
        }
    }

    /// The scene with four times the flank points and positions.
    pub(super) fn finer(&self) -> Table {
        finer(self.table, &[POINTS, POSITIONS], FINER)
    }

    /// Runs two scenes and judges both.
    pub(super) fn two(
        &self,
        one: Table,
        other: Table,
        judge: impl FnOnce(&RunRecord, &RunRecord) -> Vec<Measured>,
    ) -> RelationOutcome {
        match (self.run)(&one) {
            Ok(first) => self.beside(other, |second| judge(&first, second)),
            Err(how) => RelationOutcome::Ended { scene: one, how },
        }
    }

    /// Runs the scene that `other` makes of this one and judges both. Where a bound is exceeded, the numbers at `keys` may be too small for the
    /// contacts: both scenes are then judged at four times the numbers, and at sixteen times where a bound is exceeded there too.
    pub(super) fn refined(
        &self,
        keys: &[&str],
        other: impl Fn(&Table) -> Table,
        judge: impl Fn(&RunRecord, &RunRecord) -> Vec<Measured>,
    ) -> RelationOutcome {
        let mut verdict = self.beside(other(self.table), |record| judge(self.record, record));
        for by in [FINER, FINEST] {
            if verdict.is_beyond() {
                let finer = finer(self.table, keys, by);
                let of_finer = self.two(finer.clone(), other(&finer), &judge);
                // The finer run counts only where it has every figure that exceeds its bound.
                if of_finer.says_of_all_beyond(&verdict) {
                    verdict = of_finer;
                }
            }
        }
        verdict
    }
}
