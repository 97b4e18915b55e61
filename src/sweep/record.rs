//! Record of a sweep in the units of the output files, which its reports are written from.

use serde::{Deserialize, Serialize};

use super::goal::{Goal, Optimum};
use super::minimum::Minimum;
use super::verification::{Chosen, RowVerification, SweepVerification};
use crate::evaluate::figure::{self, StudyFigure};
use crate::journal::Kept;
use crate::scene::opened::{EachMesh, SceneKind};
use crate::scene::problem::number;
use gearwear_physics::results::error::TotalError;

/// Significant digits of a value between the ends of a range.
const DIGITS: i32 = 12;

/// How the values of a key are spaced.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AxisSpacing {
    /// Evenly, both ends included.
    #[default]
    Even,
    /// By equal ratios, both ends included.
    Logarithmic,
    /// Listed values, rising.
    Listed(Vec<f64>),
    /// Words as they are listed; the values are their places, from 0.
    Words(Vec<String>),
}

impl AxisSpacing {
    fn is_even(&self) -> bool {
        *self == Self::Even
    }
}

/// A key of the scene with the values it takes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepAxis {
    /// Path of the key, such as `pair.face_width_mm`, or of several that have the same value: `pair.{pinion,wheel}.tip_rounding_mm`.
    pub key: String,
    pub from: f64,
    pub to: f64,
    pub count: usize,
    /// Whether the key takes whole numbers.
    pub whole: bool,
    #[serde(default, skip_serializing_if = "AxisSpacing::is_even")]
    pub spacing: AxisSpacing,
}

impl SweepAxis {
    /// The value number `index`, from 0:
    ///
    /// ```text
    /// x_i = ((n − 1 − i) from + i to) / (n − 1)            x_i = from (to/from)^(i/(n − 1))
    /// ```
    ///
    /// Values between the ends are rounded to twelve digits of the larger end, so that they read as one would write them.
    pub fn value(&self, index: usize) -> f64 {
        let last = self.count.saturating_sub(1);
        if self.words().is_some() {
            index as f64
        } else if let AxisSpacing::Listed(values) = &self.spacing {
            values[index.min(last)]
        } else if index == 0 {
            self.from
        } else if index >= last {
            self.to
        } else if self.spacing == AxisSpacing::Logarithmic {
            let between = self.from * (self.to / self.from).powf(index as f64 / last as f64);
            format!("{between:.*e}", (DIGITS - 1) as usize).parse().unwrap_or(between)
        } else {
            let between = ((last - index) as f64 * self.from + index as f64 * self.to) / last as f64;
            let largest = self.from.abs().max(self.to.abs());
            let decimals = (DIGITS - 1 - largest.log10().floor() as i32).max(0) as usize;
            // Adding zero takes the sign of a negative zero away.
            format!("{between:.decimals$}").parse().unwrap_or(between) + 0.0
        }
    }

    pub fn values(&self) -> Vec<f64> {
        (0..self.count).map(|index| self.value(index)).collect()
    }

    /// Axis as the user may write it: `pair.face_width_mm=10:30:21`.
    pub fn as_given(&self) -> String {
        let range = format!("{}:{}:{}", number(self.from), number(self.to), self.count);
        let values = match &self.spacing {
            AxisSpacing::Even => range,
            AxisSpacing::Logarithmic => format!("{range}:log"),
            AxisSpacing::Listed(values) => values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(","),
            AxisSpacing::Words(words) => words.join(","),
        };
        format!("{}={values}", self.key)
    }

    /// The words, where the key takes words.
    pub fn words(&self) -> Option<&[String]> {
        match &self.spacing {
            AxisSpacing::Words(words) => Some(words),
            _ => None,
        }
    }

    /// The word that `value` stands for, where the key takes words.
    pub fn word(&self, value: f64) -> Option<&str> {
        self.words()?.get(value as usize).map(String::as_str)
    }

    /// Value as text: a word, or a number in its shortest form.
    pub fn said(&self, value: f64) -> String {
        self.word(value).map_or_else(|| number(value), str::to_owned)
    }

    /// Title of an axis of a plot, with the unit that ends the name of the key: `tip relief, amount, pinion and wheel, µm`.
    pub fn title(&self) -> String {
        let (name, unit) = self.name_and_unit();
        unit.map_or_else(|| name.clone(), |unit| format!("{name}, {unit}"))
    }

    /// Name and unit apart.
    pub fn name_and_unit(&self) -> (String, Option<&'static str>) {
        let mut parts: Vec<String> = self.key.split('.').skip(1).map(|part| part.replace('_', " ")).collect();
        let Some(last) = parts.pop() else { return (self.key.clone(), None) };
        let ending = UNITS.iter().find_map(|(suffix, unit)| Some((last.strip_suffix(suffix)?, *unit)));
        let (name, unit) = ending.map_or((last.as_str(), None), |(name, unit)| (name, Some(unit)));
        let section = self.key.split('.').next().unwrap_or_default();
        parts.push(if SAY_NOTHING_ALONE.contains(&name) { format!("{section} {name}") } else { name.to_owned() });
        if let Some(gears) = parts.iter().position(|part| are_gears(part)) {
            let gears = parts.remove(gears);
            parts.push(gears.trim_matches(['{', '}']).replace(',', " and "));
        }
        (parts.join(", "), unit)
    }

    /// "pinion torque = 302 N·m".
    pub fn name_and_value(&self, value: &str) -> String {
        let (name, unit) = self.name_and_unit();
        format!("{name} = {value}{}", unit.map_or_else(String::new, |unit| format!(" {unit}")))
    }
}

/// Whether a part of a key names a gear, or several.
fn are_gears(part: &str) -> bool {
    let mut gears = part.trim_matches(['{', '}']).split(',').map(str::trim);
    gears.all(|gear| ["pinion", "wheel", "sun", "planet", "ring"].contains(&gear))
}

/// Last parts of keys that are clear only with the name of their section.
const SAY_NOTHING_ALONE: [&str; 4] = ["coefficient", "surface", "model", "law"];

/// Suffixes of keys and their units.
const UNITS: [(&str, &str); 20] = [
    (" N per mm um", "N/(mm·µm)"),
    (" MPa per mm", "MPa/mm"),
    (" kg per m3", "kg/m³"),
    (" m2 per N", "m²/N"),
    (" m2 per s", "m²/s"),
    (" mm3 per Nm", "mm³/(N·m)"),
    (" W per mK", "W/(m·K)"),
    (" kJ per mol", "kJ/mol"),
    (" J per mol", "J/mol"),
    (" um", "µm"),
    (" mm", "mm"),
    (" deg", "°"),
    (" Nm", "N·m"),
    (" rpm", "rpm"),
    (" GPa", "GPa"),
    (" MPa", "MPa"),
    (" C", "°C"),
    (" s", "s"),
    (" h", "h"),
    (" K", "K"),
];

/// A shard: every `of`-th combination, beginning with `number`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// Number of the part, from 1.
    pub number: usize,
    pub of: usize,
}

/// Sweep, or part of one, that a journal keeps the rows of.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SweepPart {
    pub identity: SweepIdentity,
    /// Part of the sweep; `None`: all of it.
    pub shard: Option<Shard>,
}

impl Kept for SweepPart {
    type Row = SweepRow;
    const KIND: &'static str = "sweep";
    const COMMAND: &'static str = "gearwear sweep";

    fn number(&self, row: &SweepRow) -> usize {
        row.index
    }

    fn refuses(&self, row: &SweepRow) -> Option<String> {
        let fits = row.index < self.identity.combinations() && row.figures.len() == self.identity.figures.len();
        (!fits).then(|| format!("a row of another sweep, combination {}", row.index))
    }

    fn differences(&self, wanted: &Self) -> Vec<String> {
        let mut differences = self.identity.differences(&wanted.identity);
        if self.shard != wanted.shard {
            let [there, here] = [self.shard, wanted.shard]
                .map(|shard| shard.map_or_else(|| "all of it".to_owned(), |s| format!("shard {}/{}", s.number, s.of)));
            differences.push(format!("the part that is run: {there} and {here}"));
        }
        differences
    }
}

/// Identity of a sweep: rows of sweeps with equal identities can be merged.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SweepIdentity {
    /// Kind of the scene.
    #[serde(default, skip_serializing_if = "SceneKind::is_pair")]
    pub kind: SceneKind,
    pub title: String,
    pub program_version: String,
    /// First 16 hexadecimal digits of the SHA-256 of the scene as given, resolved.
    pub scene_hash: String,
    /// Hash of the scene file as given: what it leaves open is chosen anew for each combination.
    pub given_hash: String,
    /// Hash of the calibration and the stiffness curve that the scene names; empty where it names none.
    pub inputs_hash: String,
    pub error_estimate: bool,
    /// Whether the scene sets `verify = true`: the best rows and the corners are then verified.
    pub verify: bool,
    /// Varied keys; the first changes slowest.
    pub axes: Vec<SweepAxis>,
    /// Names of the figures of a row, in order.
    pub figures: Vec<String>,
    /// Figure to minimise; rows do not depend on it, so it may change at a restart.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub goal: Option<Goal>,
}

impl SweepIdentity {
    pub fn combinations(&self) -> usize {
        self.axes.iter().map(|axis| axis.count).product()
    }

    /// Index of each axis's value in combination `index`, in the order of the axes.
    pub fn digits(&self, index: usize) -> Vec<usize> {
        let mut rest = index;
        let mut digits = vec![0; self.axes.len()];
        for (digit, axis) in digits.iter_mut().zip(&self.axes).rev() {
            *digit = rest % axis.count;
            rest /= axis.count;
        }
        digits
    }

    /// The varied values of combination `index`, in the order of the axes.
    pub fn values(&self, index: usize) -> Vec<f64> {
        self.axes.iter().zip(self.digits(index)).map(|(axis, digit)| axis.value(digit)).collect()
    }

    /// The combination in words: `pair.helix_angle_deg = 15, pair.face_width_mm = 20`.
    pub fn in_words(&self, index: usize) -> String {
        let values = self.values(index);
        let said: Vec<String> =
            self.axes.iter().zip(values).map(|(axis, value)| format!("{} = {}", axis.key, axis.said(value))).collect();
        said.join(", ")
    }

    /// Differences from `other`, in words; empty where both are one sweep.
    pub fn differences(&self, other: &Self) -> Vec<String> {
        let mut differences: Vec<String> = Vec::new();
        for ((what, mine), (_, theirs)) in self.said().into_iter().zip(other.said()) {
            // The resolved scene differs wherever the scene does.
            let said_before = what == "the resolved scene" && self.given_hash != other.given_hash;
            if mine != theirs && !said_before {
                differences.push(format!("{what}: {mine} and {theirs}"));
            }
        }
        differences
    }

    /// Parts of the identity with their names.
    fn said(&self) -> [(&'static str, String); 7] {
        let axes: Vec<String> = self.axes.iter().map(SweepAxis::as_given).collect();
        [
            ("program version", self.program_version.clone()),
            ("what is varied", axes.join(" ")),
            ("scene", self.given_hash.clone()),
            ("the resolved scene", self.scene_hash.clone()),
            ("files that the scene names", self.inputs_hash.clone()),
            ("errors estimated", if self.error_estimate { "yes" } else { "no" }.to_owned()),
            ("figures of a row", self.figures.join(" ")),
        ]
    }
}

/// Result of one combination.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct SweepRow {
    /// Number of the combination, from 0.
    pub index: usize,
    pub values: Vec<f64>,
    /// Reason why there are no figures, on one line; `None` where the run was completed.
    pub error: Option<String>,
    /// The figures, in the order of the columns; `None` where the scene does not have one.
    pub figures: Vec<Option<f64>>,
    pub warnings: Option<usize>,
    /// Wall time of the wear run alone, s.
    pub simulation_s: Option<f64>,
    /// Wall time of the whole combination, its verification apart, s.
    pub wall_s: f64,
    /// Verification by finite elements; `None` where the row is not verified.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub verification: Option<RowVerification>,
}

impl SweepRow {
    pub fn figure(&self, figure: &StudyFigure) -> Option<f64> {
        self.figures.get(figure.column()?).copied().flatten()
    }

    /// Row with its verification by finite elements.
    pub fn verified(self, chosen: Chosen, total: EachMesh<TotalError>, wall_s: f64) -> Self {
        Self { verification: Some(RowVerification { chosen, total, wall_s }), ..self }
    }

    /// Whether everything but the wall times is the same, the verification where both have one.
    pub fn same_result(&self, other: &Self) -> bool {
        let [mine, theirs] =
            [self, other].map(|row| Self { simulation_s: None, wall_s: 0.0, verification: None, ..row.clone() });
        let verifications = self.verification.as_ref().zip(other.verification.as_ref());
        mine == theirs && verifications.is_none_or(|(mine, theirs)| mine.total == theirs.total)
    }
}

/// A finished sweep, or a finished part of one.
#[derive(Debug, Clone, PartialEq)]
pub struct SweepRecord {
    pub identity: SweepIdentity,
    /// Part of the sweep; `None`: all of it.
    pub shard: Option<Shard>,
    /// The scene, as the user gave it.
    pub scene_toml: String,
    /// One row per combination, in the order of the combinations.
    pub rows: Vec<SweepRow>,
    /// Number of threads; 0 where the rows come from elsewhere: other processes or machines, or merged shards.
    pub threads: usize,
    /// Wall time since the start of the command, s, without rows of earlier starts.
    pub wall_s: f64,
}

/// `sweep.json`.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SweepSummary<'a> {
    #[serde(flatten)]
    pub identity: &'a SweepIdentity,
    /// Part of the sweep; null: all of it.
    pub shard: Option<Shard>,
    pub combinations: usize,
    pub ok: usize,
    pub failed: usize,
    /// The best combination by each figure that has a best.
    pub best: Vec<BestCombination>,
    /// Optimum; null without a goal or where no combination is within the limits.
    pub optimum: Option<Optimum>,
    /// Verification of the best rows and the corners by finite elements; null where the scene does not ask for it, and in a shard, which
    /// does not know the best of all rows.
    pub verification: Option<SweepVerification<'a>>,
    /// Wall times of all combinations together, their verifications apart, s.
    pub combinations_wall_s: f64,
    pub wall_s: f64,
    pub threads: usize,
}

#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct BestCombination {
    pub figure: &'static str,
    pub value: f64,
    pub index: usize,
    pub values: Vec<f64>,
    /// Keys on an end of their range beyond which there are further values.
    pub on_edge: Vec<String>,
    /// Combinations one step of one key away that are as good within the error; null where no error is known.
    pub neighbours_as_good: Option<usize>,
}

impl SweepRecord {
    /// Row with the least value of `figure`, the first of equal ones.
    pub fn least(&self, figure: &StudyFigure) -> Option<(&SweepRow, f64)> {
        let valued = self.rows.iter().filter_map(|row| Some((row, row.figure(figure)?)));
        valued.min_by(|a, b| a.1.total_cmp(&b.1))
    }

    pub fn failed(&self) -> usize {
        self.rows.iter().filter(|row| row.error.is_some()).count()
    }

    /// Optimum; `None` without a goal or where no combination is within the limits.
    pub fn optimum(&self) -> Option<Optimum> {
        self.identity.goal.as_ref()?.optimum(&self.identity, &self.rows)
    }

    /// Verification by finite elements; `None` where it is not asked for.
    pub fn verification(&self) -> Option<SweepVerification<'_>> {
        let asked = self.identity.verify && self.shard.is_none();
        asked.then(|| SweepVerification::of(&self.identity, &self.rows))
    }

    pub fn summary(&self) -> SweepSummary<'_> {
        let failed = self.failed();
        SweepSummary {
            identity: &self.identity,
            shard: self.shard,
            combinations: self.identity.combinations(),
            ok: self.rows.len() - failed,
            failed,
            best: figure::in_sweeps(self.identity.kind)
                .iter()
                .filter(|figure| figure.less_is_better())
                .filter_map(|figure| {
                    let Minimum { row, value, on_edge, as_good, .. } = self.minimum(figure)?;
                    Some(BestCombination {
                        figure: &figure.name,
                        value,
                        index: row.index,
                        values: row.values.clone(),
                        on_edge: on_edge.into_iter().map(str::to_owned).collect(),
                        neighbours_as_good: as_good,
                    })
                })
                .collect(),
            optimum: self.optimum(),
            verification: self.verification(),
            combinations_wall_s: self.rows.iter().map(|row| row.wall_s).sum(),
            wall_s: self.wall_s,
            threads: self.threads,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn axis(key: &str, from: f64, to: f64, count: usize) -> SweepAxis {
        SweepAxis { key: key.to_owned(), from, to, count, whole: false, spacing: AxisSpacing::Even }
    }

    /// Ends are as given; values between them are rounded.
    #[test]
    fn ver_values_are_evenly_spaced() {
        assert_eq!(axis("k", 0.1, 0.7, 7).values(), [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
        assert_eq!(axis("k", -1.0, 1.0, 3).values(), [-1.0, 0.0, 1.0]);
        assert_eq!(axis("k", 14.0, 14.0, 1).values(), [14.0]);
        assert_eq!(axis("k", 0.0, 1.0, 4).values()[1], 0.333_333_333_33);
        assert_eq!(axis("k", -0.1, 0.6, 15).values()[1..4], [-0.05, 0.0, 0.05]);
        assert_eq!(axis("k", 1e-18, 3e-18, 3).values(), [1e-18, 2e-18, 3e-18]);
        assert_eq!(axis("k", 0.0, 3e15, 4).values(), [0.0, 1e15, 2e15, 3e15]);
    }

    /// Names of keys without their section, and units.
    #[test]
    fn axes_have_titles_with_units() {
        for (key, title) in [
            ("pair.{pinion,wheel}.tip_relief.amount_um", "tip relief, amount, pinion and wheel, µm"),
            ("operation.pinion_torque_Nm", "pinion torque, N·m"),
            ("wear.coefficient_m2_per_N", "wear coefficient, m²/N"),
            ("contact.surface", "contact surface"),
            ("pair.pinion.teeth", "teeth, pinion"),
            ("numerics.positions", "positions"),
            ("operation.phases.2.pinion_speed_rpm", "phases, 2, pinion speed, rpm"),
        ] {
            assert_eq!(axis(key, 0.0, 1.0, 2).title(), title);
        }
    }

    /// The first key changes slowest.
    #[test]
    fn combinations_are_counted_like_digits() {
        let identity =
            SweepIdentity { axes: vec![axis("a", 0.0, 1.0, 2), axis("b", 5.0, 7.0, 3)], ..SweepIdentity::default() };
        assert_eq!(identity.combinations(), 6);
        let all: Vec<Vec<f64>> = (0..6).map(|index| identity.values(index)).collect();
        assert_eq!(all, [[0.0, 5.0], [0.0, 6.0], [0.0, 7.0], [1.0, 5.0], [1.0, 6.0], [1.0, 7.0]]);
        assert_eq!(identity.in_words(4), "a = 1, b = 6");
        assert_eq!([10.0, -0.25, 1e-17].map(number), ["10", "-0.25", "1e-17"]);
    }
}
