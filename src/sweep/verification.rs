//! The rows of a sweep that finite elements verify, and what they say of them.
//!
//! A verification ([`TotalError`]) takes as long as a row on elastic half-planes and several times as long as one on springs, so
//! that it is spent where the answer is read: on the rows one would choose, which are those with the least [`objective`], and on the
//! corners of the box that is swept, where the pair is furthest from the middle of it.
//!
//! A corner has every varied key at its first or at its last value. k keys have 2^k of them; of more than [`MOST_CORNERS`] an
//! orthogonal array is taken, in which each key is at its last value in one half, and any two keys have each of their four
//! pairs of ends equally often. With r the number of the corner and m_j the mask of key j, both in binary digits,
//!
//! ```text
//! key j is at its last value where the number of ones in r ∧ m_j is odd
//! ```
//!
//! The masks of the first four keys are single digits, so that up to four keys have all of their corners. Source: G. E. P. Box,
//! J. S. Hunter, W. G. Hunter, *Statistics for Experimenters* (2005), ch. 6: fractional factorial designs at two levels.

use std::collections::{BTreeMap, BTreeSet};

use serde::{Deserialize, Serialize};

use super::goal::Goal;
use super::record::{SweepIdentity, SweepRow};
use crate::evaluate::figure::{self, StudyFigure};
use crate::scene::opened::EachMesh;
use gearwear_physics::results::error::TotalError;

/// Figure by which rows are ranked: that of the goal, else the wear.
pub fn objective(identity: &SweepIdentity) -> &'static StudyFigure {
    let kind = identity.kind;
    identity.goal.as_ref().map_or_else(|| figure::peak_wear(kind), |goal| goal.figure(kind))
}

/// Number of best rows that are verified: the best, and two more to tell whether it is best by more than its error.
pub const MOST_BEST: usize = 3;
/// Number of corners that are verified: all of four keys, which take about half a minute on one thread; each further key would double that.
pub const MOST_CORNERS: usize = 16;

/// Corners in which each varied key is at its last value, as masks of four bits for 16 corners. Those of three bits come before the others: with up
/// to eight keys any three have all eight combinations of their ends.
const MASKS: [usize; 15] = [1, 2, 4, 8, 7, 11, 13, 14, 15, 3, 5, 6, 9, 10, 12];

/// Why a row is verified.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Chosen {
    pub best: bool,
    pub corner: bool,
}

impl Chosen {
    pub fn name(self) -> &'static str {
        match (self.best, self.corner) {
            (true, true) => "best and corner",
            (true, false) => "best",
            (false, _) => "corner",
        }
    }
}

/// Verification of a row by finite elements.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RowVerification {
    pub chosen: Chosen,
    /// Errors against finite elements, or the reason why they are not known.
    pub total: EachMesh<TotalError>,
    pub wall_s: f64,
}

impl RowVerification {
    pub fn has_answer(&self) -> bool {
        figure::claims(self.total.kind()).iter().any(|claim| claim.of(&self.total).is_some())
    }

    /// Source of the errors, or the reasons why they are not known.
    pub fn how(&self) -> String {
        figure::how(&self.total)
    }
}

/// The corners of the box that is swept, at most [`MOST_CORNERS`], by index.
pub fn corners(identity: &SweepIdentity) -> BTreeSet<usize> {
    (0..corner_count(identity))
        .map(|corner| {
            let mut masks = MASKS.iter().cycle();
            identity.axes.iter().fold(0, |index, axis| {
                let is_last = axis.count > 1 && masks.next().is_some_and(|mask| (corner & mask).count_ones() % 2 == 1);
                index * axis.count + if is_last { axis.count - 1 } else { 0 }
            })
        })
        .collect()
}

fn corner_count(identity: &SweepIdentity) -> usize {
    all_corners(identity).min(MOST_CORNERS)
}

/// 2^k corners of k keys that take more than one value: no more than there are combinations.
fn all_corners(identity: &SweepIdentity) -> usize {
    identity.axes.iter().map(|axis| axis.count.min(2)).product()
}

/// Description of the verification, before any row is known.
pub fn intention(identity: &SweepIdentity) -> String {
    let (all, taken) = (all_corners(identity), corner_count(identity));
    let best = MOST_BEST.min(identity.combinations());
    let corners = if taken < all { format!("{taken} of the {all} corners") } else { format!("the corners ({taken})") };
    let most = (best + taken).min(identity.combinations());
    let by = identity.goal.as_ref().map_or_else(|| figure::peak_wear(identity.kind).name.clone(), Goal::in_words);
    format!("the best ({best}, by {by}) and {corners} of what is varied, at most {most} combinations")
}

/// Rows of `rows` to be verified: the best and the corners, of those that have figures.
pub fn chosen<'a>(identity: &SweepIdentity, rows: impl Iterator<Item = &'a SweepRow>) -> BTreeMap<usize, Chosen> {
    let corners = corners(identity);
    let mut chosen: BTreeMap<usize, Chosen> = BTreeMap::new();
    let mut ranked: Vec<(f64, usize)> = Vec::new();
    for row in rows.filter(|row| row.error.is_none()) {
        if corners.contains(&row.index) {
            chosen.entry(row.index).or_default().corner = true;
        }
        if identity.goal.as_ref().is_none_or(|goal| goal.allows(identity.kind, row)) {
            ranked.extend(row.figure(objective(identity)).map(|value| (value, row.index)));
        }
    }
    ranked.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
    for &(_, index) in ranked.iter().take(MOST_BEST) {
        chosen.entry(index).or_default().best = true;
    }
    chosen
}

/// Summary of the verification of a sweep, over its rows.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepVerification<'a> {
    /// Rows chosen, and why.
    pub intention: String,
    /// Rows that were chosen: fewer than intended where the best are corners or a corner has no figures.
    pub chosen: usize,
    pub verified: usize,
    /// Rows without a result; the reason is in their `total.how`.
    pub unanswered: usize,
    /// Number of rows not verified yet: of merged shards, none of which knows the best of all rows.
    pub open: usize,
    /// The greatest of each claim over the verified rows.
    pub worst: Vec<WorstClaim>,
    /// The chosen rows but the open ones, in the order of the combinations.
    pub rows: Vec<VerifiedRow<'a>>,
    pub wall_s: f64,
}

/// A row with what finite elements say of it.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct VerifiedRow<'a> {
    pub index: usize,
    pub values: &'a [f64],
    /// The greatest wear of all flanks.
    pub peak_wear_um: Option<f64>,
    /// Value of the figure by which rows are ranked.
    pub objective: Option<f64>,
    #[serde(flatten)]
    pub verification: &'a RowVerification,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WorstClaim {
    pub claim: &'static str,
    #[serde(skip)]
    pub title: &'static str,
    pub value: f64,
    /// Combination it is of, the first of equals.
    pub index: usize,
    pub values: Vec<f64>,
}

impl<'a> SweepVerification<'a> {
    pub fn of(identity: &SweepIdentity, rows: &'a [SweepRow]) -> Self {
        let chosen = chosen(identity, rows.iter());
        let open = rows.iter().filter(|row| chosen.contains_key(&row.index) && row.verification.is_none()).count();
        let rows: Vec<VerifiedRow<'a>> = rows
            .iter()
            .filter_map(|row| {
                let verification = row.verification.as_ref()?;
                let (peak_wear_um, objective) =
                    (row.figure(figure::peak_wear(identity.kind)), row.figure(objective(identity)));
                Some(VerifiedRow { index: row.index, values: &row.values, peak_wear_um, objective, verification })
            })
            .collect();
        let worst = figure::claims(identity.kind).iter().filter_map(|claim| {
            let stated = rows.iter().filter_map(|row| Some((row, claim.of(&row.verification.total)?)));
            let (row, value) = stated.reduce(|worst, other| if other.1 > worst.1 { other } else { worst })?;
            let (index, values) = (row.index, row.values.to_vec());
            Some(WorstClaim { claim: &claim.name, title: &claim.title, value, index, values })
        });
        let verified = rows.iter().filter(|row| row.verification.has_answer()).count();
        Self {
            intention: intention(identity),
            chosen: chosen.len(),
            verified,
            unanswered: rows.len() - verified,
            open,
            worst: worst.collect(),
            wall_s: rows.iter().map(|row| row.verification.wall_s).sum(),
            rows,
        }
    }

    /// The worst claim about the greatest wear of a gear.
    pub fn worst_of_peak_wear(&self) -> Option<f64> {
        let totals = self.rows.iter().flat_map(|row| row.verification.total.all());
        totals.flat_map(|total| [total.peak_wear.pinion, total.peak_wear.wheel]).flatten().reduce(f64::max)
    }

    /// Reason of the first row without a result.
    pub fn first_reason(&self) -> Option<String> {
        let unanswered = self.rows.iter().find(|row| !row.verification.has_answer());
        unanswered.map(|row| row.verification.how())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::opened::SceneKind;
    use crate::sweep::record::{AxisSpacing, SweepAxis};

    fn identity(counts: &[usize]) -> SweepIdentity {
        let axis = |&count| SweepAxis {
            key: "k".to_owned(),
            from: 0.0,
            to: 1.0,
            count,
            whole: false,
            spacing: AxisSpacing::Even,
        };
        SweepIdentity { verify: true, axes: counts.iter().map(axis).collect(), ..SweepIdentity::default() }
    }

    /// A row whose every figure is `wear`; failed where there is none.
    fn row(index: usize, wear: Option<f64>) -> SweepRow {
        SweepRow {
            index,
            error: wear.is_none().then(|| "no".to_owned()),
            figures: vec![wear; figure::in_sweeps(SceneKind::Pair).len()],
            ..SweepRow::default()
        }
    }

    #[test]
    fn ver_few_keys_have_all_their_corners() {
        assert_eq!(corners(&identity(&[])), BTreeSet::from([0]));
        assert_eq!(corners(&identity(&[1, 5])), BTreeSet::from([0, 4]));
        assert_eq!(corners(&identity(&[3, 4])), BTreeSet::from([0, 3, 8, 11]));
        let four = corners(&identity(&[2, 3, 2, 3]));
        assert_eq!((four.len(), four.first(), four.last()), (16, Some(&0), Some(&35)));
    }

    /// An orthogonal array: any two keys have each of the four pairs of their ends in a quarter of the corners.
    #[test]
    fn ver_corners_of_many_keys_are_balanced() {
        for keys in 5..=15 {
            let identity = identity(&vec![2; keys]);
            let corners = corners(&identity);
            assert_eq!(corners.len(), MOST_CORNERS);
            let ends: Vec<Vec<f64>> = corners.iter().map(|&index| identity.values(index)).collect();
            for (one, other) in (0..keys).flat_map(|one| (0..one).map(move |other| (one, other))) {
                for pair in [[0.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 1.0]] {
                    assert_eq!(ends.iter().filter(|ends| [ends[one], ends[other]] == pair).count(), MOST_CORNERS / 4);
                }
            }
        }
        // More keys than a sweep of two values each can have.
        assert_eq!(corners(&identity(&[2; 19])).len(), MOST_CORNERS);
    }

    #[test]
    fn the_best_and_the_corners_are_chosen() {
        let identity = identity(&[3, 3]);
        // The centre is least; two are equal, of which the first counts; one corner failed.
        let wear = [Some(9.0), Some(3.0), None, Some(4.0), Some(1.0), Some(3.0), Some(2.0), Some(5.0), Some(8.0)];
        let rows: Vec<SweepRow> = wear.into_iter().enumerate().map(|(index, wear)| row(index, wear)).collect();
        let names: Vec<(usize, &str)> =
            chosen(&identity, rows.iter()).into_iter().map(|(index, chosen)| (index, chosen.name())).collect();
        assert_eq!(names, [(0, "corner"), (1, "best"), (4, "best"), (6, "best and corner"), (8, "corner")]);
        let intended = intention(&identity);
        assert_eq!(
            intended,
            "the best (3, by peak_wear_um) and the corners (4) of what is varied, at most 7 combinations"
        );
        assert!(intention(&self::identity(&[2; 5])).contains("16 of the 32 corners"));
        assert!(intention(&self::identity(&[2, 1])).ends_with("at most 2 combinations"));
    }

    #[test]
    fn the_worst_claims_are_over_the_verified_rows() {
        let identity = identity(&[4]);
        let mut rows: Vec<SweepRow> = (0..4).map(|index| row(index, Some(index as f64))).collect();
        for (row, peak) in rows.iter_mut().zip([Some(0.01), Some(0.03), None]) {
            let mut total = TotalError::none("the contact is too narrow");
            total.peak_wear.wheel = peak;
            row.verification =
                Some(RowVerification { chosen: Chosen::default(), total: EachMesh::Pair(total), wall_s: 1.0 });
        }
        let found = SweepVerification::of(&identity, &rows);
        assert_eq!((found.chosen, found.verified, found.unanswered, found.open), (4, 2, 1, 1));
        let worst: Vec<(&str, f64, usize)> = found.worst.iter().map(|w| (w.claim, w.value, w.index)).collect();
        assert_eq!(worst, [("error.total.peak_wear.wheel", 0.03, 1)]);
        assert_eq!(found.first_reason().as_deref(), Some("not verified: the contact is too narrow"));
        assert_eq!((found.worst_of_peak_wear(), found.wall_s), (Some(0.03), 3.0));
    }
}
