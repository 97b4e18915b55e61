//! Goal of a sweep: the combination where a figure is least, among those within some limits.
//!
//! An optimum is only as good as the error of the figure: every combination that is not worse by more than that belongs to it. With the
//! relative error e of the least value y and of another one, z, which is taken to be as great, z is not known to be worse where
//!
//! ```text
//! z (1 − e) ≤ y (1 + e)
//! ```

use std::fmt;

use serde::{Deserialize, Serialize};

use super::record::{SweepIdentity, SweepRow};
use crate::evaluate::figure::{self, StudyFigure};
use crate::scene::nearest::nearest;
use crate::scene::opened::SceneKind;
use crate::scene::problem::number;

/// Figure to minimise, and limits of other figures.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Goal {
    /// Name of its column.
    pub figure: String,
    pub limits: Vec<FigureLimit>,
}

/// Limit of a figure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FigureLimit {
    /// Name of its column.
    pub figure: String,
    /// Whether the value is an upper limit; else a lower one.
    pub at_most: bool,
    pub value: f64,
}

/// Faults of a goal.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum GoalError {
    #[error("unknown figure {name}; allowed: a column of sweep.csv such as {allowed}{}", meant.as_ref().map_or_else(String::new, |meant| format!("; did you mean {meant}?")))]
    Unknown { name: String, meant: Option<&'static str>, allowed: &'static str },
    #[error("found {given:?}; allowed: FIGURE<=VALUE or FIGURE>=VALUE, such as \"wheel.peak_wear_um<=8\"")]
    Form { given: String },
}

impl FigureLimit {
    /// Reads a limit of a figure of a kind of scene.
    ///
    /// # Errors
    /// Another form; a name that no column has.
    pub fn parse(kind: SceneKind, given: &str) -> Result<Self, GoalError> {
        let split = ["<=", ">="].into_iter().find_map(|sign| Some((given.split_once(sign)?, sign)));
        let read = split.and_then(|((figure, value), sign)| {
            let value = value.trim().parse::<f64>().ok().filter(|value| value.is_finite())?;
            Some((figure.trim(), sign == "<=", value))
        });
        let (figure, at_most, value) = read.ok_or_else(|| GoalError::Form { given: given.to_owned() })?;
        Ok(Self { figure: known(kind, figure)?.name.clone(), at_most, value })
    }

    /// Whether `row` has the figure and keeps to the limit.
    fn is_kept_by(&self, kind: SceneKind, row: &SweepRow) -> bool {
        let value = column(kind, &self.figure).and_then(|figure| row.figure(figure));
        value.is_some_and(|value| if self.at_most { value <= self.value } else { value >= self.value })
    }
}

impl fmt::Display for FigureLimit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} {}", self.figure, if self.at_most { "≤" } else { "≥" }, number(self.value))
    }
}

/// The column of this name, or of this name in the version before.
fn column(kind: SceneKind, name: &str) -> Option<&'static StudyFigure> {
    figure::find(kind, name).filter(|figure| figure.column().is_some())
}

fn known(kind: SceneKind, name: &str) -> Result<&'static StudyFigure, GoalError> {
    let names: Vec<&'static str> = figure::in_sweeps(kind).iter().map(|figure| figure.name.as_str()).collect();
    let allowed = if kind.is_pair() { "pinion.peak_wear_um" } else { "sun.peak_wear_um" };
    column(kind, name).ok_or_else(|| GoalError::Unknown {
        name: name.to_owned(),
        meant: nearest(name, &names),
        allowed,
    })
}

impl Goal {
    /// Goal of the least figure `name` within `limits`.
    ///
    /// # Errors
    /// A name that no column has.
    pub fn new(kind: SceneKind, name: &str, limits: Vec<FigureLimit>) -> Result<Self, GoalError> {
        Ok(Self { figure: known(kind, name)?.name.clone(), limits })
    }

    pub fn figure(&self, kind: SceneKind) -> &'static StudyFigure {
        // The journal of another version may name a figure that no longer exists.
        column(kind, &self.figure).unwrap_or_else(|| figure::peak_wear(kind))
    }

    /// Whether `row` has the figure and is within all limits.
    pub fn allows(&self, kind: SceneKind, row: &SweepRow) -> bool {
        row.error.is_none()
            && row.figure(self.figure(kind)).is_some()
            && self.limits.iter().all(|limit| limit.is_kept_by(kind, row))
    }

    /// In words: "pinion.peak_wear_um, with wheel.peak_wear_um ≤ 8".
    pub fn in_words(&self) -> String {
        let limits: Vec<String> = self.limits.iter().map(ToString::to_string).collect();
        if limits.is_empty() { self.figure.clone() } else { format!("{}, with {}", self.figure, limits.join(" and ")) }
    }

    /// Optimum among `rows`; `None` where no row is within the limits.
    pub fn optimum(&self, identity: &SweepIdentity, rows: &[SweepRow]) -> Option<Optimum> {
        let figure = self.figure(identity.kind);
        let allowed: Vec<(&SweepRow, f64)> = rows
            .iter()
            .filter(|row| self.allows(identity.kind, row))
            .filter_map(|row| Some((row, row.figure(figure)?)))
            .collect();
        let &(best, value) = allowed.iter().min_by(|a, b| a.1.total_cmp(&b.1))?;
        let claims = allowed.iter().filter_map(|(row, _)| figure.error(&row.verification.as_ref()?.total));
        let own = best.verification.as_ref().and_then(|of| figure.error(&of.total));
        // The row's own error and those of the verified ones beside it: the greatest.
        let error = own.map(|own| claims.fold(own, f64::max));
        let plateau: Option<Vec<usize>> = error.map(|e| {
            let as_good = allowed.iter().filter(|(_, other)| other * (1.0 - e) <= value * (1.0 + e));
            as_good.map(|(row, _)| row.index).collect()
        });
        let why_no_error = match (error, &best.verification) {
            (Some(_), _) => None,
            (None, None) => Some("the best combination is not verified by finite elements".to_owned()),
            (None, Some(of)) if !figure.has_errors() => {
                Some(format!("the verification states no error of {} ({})", self.figure, of.how()))
            }
            (None, Some(of)) => Some(of.how()),
        };
        Some(Optimum {
            goal: self.clone(),
            within_limits: allowed.len(),
            index: best.index,
            values: best.values.clone(),
            value,
            error,
            why_no_error,
            plateau_keys: plateau
                .as_ref()
                .map(|plateau| (0..identity.axes.len()).map(|at| values_among(identity, plateau, at)).collect()),
            plateau,
        })
    }
}

/// Values of axis number `at` among these combinations: `KEY from FIRST to LAST`, or `KEY = VALUE, VALUE`.
fn values_among(identity: &SweepIdentity, combinations: &[usize], at: usize) -> String {
    let axis = &identity.axes[at];
    let mut places: Vec<usize> = combinations.iter().map(|&index| identity.digits(index)[at]).collect();
    places.sort_unstable();
    places.dedup();
    match (axis.words(), places.first(), places.last()) {
        (None, Some(&first), Some(&last)) if places.len() > 2 && places.len() == last - first + 1 => {
            format!("{} from {} to {}", axis.key, number(axis.value(first)), number(axis.value(last)))
        }
        _ => {
            let said: Vec<String> = places.iter().map(|&place| axis.said(axis.value(place))).collect();
            format!("{} = {}", axis.key, said.join(", "))
        }
    }
}

/// The best combination, and how far it is known to be the best.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Optimum {
    #[serde(flatten)]
    pub goal: Goal,
    /// Number of combinations within the limits.
    pub within_limits: usize,
    pub index: usize,
    pub values: Vec<f64>,
    pub value: f64,
    /// Relative error of the figure: the greatest that a verified combination states.
    pub error: Option<f64>,
    /// Reason where it is not known.
    pub why_no_error: Option<String>,
    /// Combinations that are not known to be worse, the best included; null where the error is not known.
    pub plateau: Option<Vec<usize>>,
    /// Values of each key among them.
    pub plateau_keys: Option<Vec<String>>,
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::opened::EachMesh;
    use crate::sweep::record::{AxisSpacing, SweepAxis};
    use crate::sweep::verification::{Chosen, RowVerification};
    use gearwear_physics::results::error::TotalError;

    fn rows(wear: &[f64]) -> (SweepIdentity, Vec<SweepRow>) {
        let axis = SweepAxis {
            key: "pair.pinion.tip_relief.amount_um".to_owned(),
            from: 0.0,
            to: (wear.len() - 1) as f64,
            count: wear.len(),
            whole: false,
            spacing: AxisSpacing::Even,
        };
        let identity = SweepIdentity { axes: vec![axis], ..SweepIdentity::default() };
        let rows = wear.iter().enumerate().map(|(index, &wear)| {
            let is_wear = figure::in_sweeps(SceneKind::Pair).iter().map(|figure| figure.name == "pinion.peak_wear_um");
            let figures = is_wear.map(|is_wear| Some(if is_wear { wear } else { index as f64 })).collect();
            SweepRow { index, values: identity.values(index), figures, ..SweepRow::default() }
        });
        let rows = rows.collect();
        (identity, rows)
    }

    /// Among 10.0, 9.0, 8.9, 9.2 and 12, with an error of 2 %, those up to 8.9 · 1.02/0.98 = 9.263 are as good as 8.9.
    #[test]
    fn ver_an_optimum_is_a_plateau_of_the_width_of_its_error() {
        let (identity, mut rows) = rows(&[10.0, 9.0, 8.9, 9.2, 12.0]);
        let goal = Goal::new(SceneKind::Pair, "pinion.peak_wear_um", Vec::new()).unwrap();
        let unknown = goal.optimum(&identity, &rows).unwrap();
        assert_eq!((unknown.index, unknown.value, unknown.error, unknown.plateau), (2, 8.9, None, None));
        assert!(unknown.why_no_error.unwrap().contains("not verified"));
        let mut total = TotalError::none("");
        total.peak_wear.pinion = Some(0.02);
        rows[2].verification =
            Some(RowVerification { chosen: Chosen::default(), total: EachMesh::Pair(total), wall_s: 0.0 });
        let found = goal.optimum(&identity, &rows).unwrap();
        assert_eq!(found.plateau, Some(vec![1, 2, 3]));
        assert_eq!(found.plateau_keys.unwrap(), ["pair.pinion.tip_relief.amount_um from 1 to 3"]);
        // Every figure but this one is the number of the row.
        let limited = Goal::new(
            SceneKind::Pair,
            "pinion.peak_wear_um",
            vec![FigureLimit::parse(SceneKind::Pair, "wheel.peak_wear_um<=1").unwrap()],
        )
        .unwrap();
        let found = limited.optimum(&identity, &rows).unwrap();
        assert_eq!((found.index, found.within_limits), (1, 2));
        let never = Goal::new(
            SceneKind::Pair,
            "pinion.peak_wear_um",
            vec![FigureLimit::parse(SceneKind::Pair, "wheel.peak_wear_um >= 9").unwrap()],
        )
        .unwrap();
        assert_eq!(never.optimum(&identity, &rows), None);
    }

    #[test]
    fn what_is_wrong_with_a_goal_is_said() {
        let unknown = Goal::new(SceneKind::Pair, "pinion_peak_wear", Vec::new()).unwrap_err().to_string();
        assert!(unknown.contains("did you mean pinion.peak_wear_um?"), "{unknown}");
        for given in ["wheel.peak_wear_um<8", "wheel.peak_wear_um<=", "wheel.peak_wear_um<=eight"] {
            assert!(
                FigureLimit::parse(SceneKind::Pair, given).unwrap_err().to_string().contains("FIGURE<=VALUE"),
                "{given}"
            );
        }
    }
}
