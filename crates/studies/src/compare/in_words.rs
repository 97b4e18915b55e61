//! What a comparison says of profile slopes and of its interval, in sentences: for the terminal and the page alike.

use super::record::{Coefficient, CompareRecord, ProfileRecord};
use gearwear::report::html::number::{figure, fixed, significant};

/// What the interval of a comparison is for, and what the one of `--history` is for.
pub const INTERVAL: &str = "This interval is of the fit: how well the profile gives the mean k up to its measurement. It is the one to compare oils, \
                            materials or loads by. For remaining life take that of --history, which is wider: it allows for k that wanders over life.";

/// Logarithm of a ratio of likelihoods above which one of two explanations is told: a factor of 150.
const DECISIVE: f64 = 5.0;

/// A finding on profile slopes: sentences, and keys of the scene to set.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct SlopeFinding {
    pub sentences: Vec<String>,
    /// "pair.pinion.profile_slope_deviation_um = 6.9"
    pub keys: Vec<String>,
    /// What the keys move.
    pub moved: Vec<String>,
}

impl CompareRecord {
    /// Finding on the profile slopes; `None` where no profile tells of one.
    pub fn slope_finding(&self) -> Option<SlopeFinding> {
        let told: Vec<&ProfileRecord> = self.profiles.iter().filter(|of| of.profile_slope.is_some()).collect();
        let mut finding = SlopeFinding { sentences: vec![treatment(told.first()?)], ..SlopeFinding::default() };
        let differing: Vec<&ProfileRecord> =
            told.iter().copied().filter(|of| of.profile_slope.as_ref().is_some_and(|slope| slope.differs)).collect();
        if differing.is_empty() {
            finding.sentences.push(
                "Before wear it is the scene’s within its error, or its error is unknown: nothing to set.".to_owned(),
            );
            return Some(finding);
        }
        finding
            .sentences
            .push(format!("Before wear f_Hα is {}.", listed(differing.iter().filter_map(|of| slope_of(of)))));
        let keys = differing.iter().filter_map(|of| {
            let slope = of.profile_slope.as_ref()?;
            let key = slope.key.as_ref()?;
            let tried = self.with_profile_slopes.as_ref().and_then(|with| with.profile_slopes_um.get(key));
            Some(format!("{key} = {}", fixed(tried.copied().unwrap_or(slope.before_wear_um.value), 2)))
        });
        finding.keys = keys.map(|key| key.replace('\u{2212}', "-")).collect();
        if finding.keys.is_empty() {
            finding.sentences.push(
                "The scene takes its flank from initial_flank: a flank measured on the same gear belongs there."
                    .to_owned(),
            );
            return Some(finding);
        }
        finding.sentences.push("If manufacture made it so, it belongs into the scene:".to_owned());
        finding.moved = self.moved();
        Some(finding)
    }

    /// What the slopes move.
    fn moved(&self) -> Vec<String> {
        let Some(with) = &self.with_profile_slopes else {
            return vec!["What that moves is unknown until the scene is run and compared with it.".to_owned()];
        };
        let several = self.profiles.len() > 1;
        let both = self.fit.coefficients.iter().zip(&with.coefficients);
        let moved = listed(both.map(|(without, with)| moved_coefficient(without, with, several)));
        let differences = |values: &mut dyn Iterator<Item = f64>| listed(values.map(figure));
        let described = format!(
            "with it to {} µm (root mean square), without it to {} µm",
            differences(&mut with.difference_um.iter().copied()),
            differences(&mut self.profiles.iter().map(|of| of.figures.difference_um))
        );
        let likelier = match with.likelihood_gain {
            gain if gain > DECISIVE => "the slope is likely of manufacture: set it",
            gain if gain < -DECISIVE => {
                "the slope is likely of the measurement (clamping, eccentricity of a tooth): leave it out"
            }
            _ => {
                "the profiles do not tell which of both: a profile before wear, or the mean of teeth around the gear, does"
            }
        };
        vec![format!("With it {moved}."), format!("The run describes the profiles {described}; {likelier}.")]
    }
}

/// What was done with the slope of the profiles.
fn treatment(of: &ProfileRecord) -> String {
    match of.profile_slope.as_ref().is_some_and(|slope| slope.removed_with_form) {
        true => format!(
            "Profile slope f_Hα: the form ({}) takes it away, so that it does not count as wear; but the flank wears where it is loaded, which depends \
             on it.",
            of.form
        ),
        false => "Profile slope f_Hα: without a form (--form none) it counts as wear.".to_owned(),
    }
}

/// "7.63 µm (95 % 7.41 to 7.85) on the pinion, in the scene 0".
fn slope_of(of: &ProfileRecord) -> Option<String> {
    let found = of.profile_slope.as_ref()?.before_wear_um;
    let interval =
        found.low.zip(found.high).map(|(low, high)| format!(" (95 % {} to {})", fixed(low, 2), fixed(high, 2)));
    let scene = if found.of_run == 0.0 { "0".to_owned() } else { fixed(found.of_run, 2) };
    Some(format!(
        "{} µm{} on the {} (the scene has {scene})",
        fixed(found.value, 2),
        interval.unwrap_or_default(),
        of.gear.name()
    ))
}

/// "k of the pinion is 1.16e-17 m²/N, 95 % 1.13e-17 to 1.19e-17, −17 %".
fn moved_coefficient(without: &Coefficient, with: &Coefficient, several: bool) -> String {
    let whose = with.gear.filter(|_| several).map_or_else(String::new, |gear| format!(" of the {}", gear.name()));
    let k = with.coefficient_m2_per_N;
    let interval =
        k.low.zip(k.high).map(|(low, high)| format!(", 95 % {} to {}", significant(low, 3), significant(high, 3)));
    let change = 100.0 * (with.factor.value / without.factor.value - 1.0);
    let sign = if change > 0.0 { "+" } else { "" };
    format!(
        "k{whose} is {} m²/N{}, {sign}{} %",
        significant(k.value, 3),
        interval.unwrap_or_default(),
        fixed(change, 1)
    )
}

/// "a and b".
fn listed(items: impl Iterator<Item = String>) -> String {
    items.collect::<Vec<_>>().join(" and ")
}
