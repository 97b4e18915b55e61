//! What a comparison says of profile slopes and of its interval, in sentences: for the terminal and the page alike.

use super::profile_slope::FitWithSlopes;
use super::record::{Coefficient, CompareRecord, ProfileRecord};
use crate::measurement::form::Form;
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
            finding
                .sentences
                .push("Before wear it is the scene’s within its interval, or has none: nothing to set.".to_owned());
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
        match &self.with_profile_slopes {
            Some(with) => {
                finding.sentences.push(verdict(with.likelihood_gain, &self.described(with)));
                finding.moved = vec![format!("With it {}.", self.moved(with))];
            }
            None => {
                finding.sentences.push("If manufacture made it so, it belongs into the scene:".to_owned());
                finding.moved = vec!["What that moves is not known.".to_owned()];
            }
        }
        Some(finding)
    }

    /// Sentence of the headline, where slopes of manufacture are likely: another k than the fitted one.
    pub fn slope_headline(&self) -> Option<String> {
        let with = self.with_profile_slopes.as_ref().filter(|with| with.likelihood_gain > DECISIVE)?;
        Some(format!(" With a profile slope of manufacture in the scene, which is likely, {}.", self.moved(with)))
    }

    /// What the slopes move.
    fn moved(&self, with: &FitWithSlopes) -> String {
        let several = self.profiles.len() > 1;
        let both = self.fit.coefficients.iter().zip(&with.coefficients);
        listed(both.map(|(without, with)| moved_coefficient(without, with, several)))
    }

    /// How far the profiles are from the run with and without the slopes.
    fn described(&self, with: &FitWithSlopes) -> String {
        format!(
            "root mean square of the difference {} µm with it, {} µm without",
            listed(with.difference_um.iter().copied().map(figure)),
            listed(self.profiles.iter().map(|of| figure(of.figures.difference_um)))
        )
    }
}

/// What the likelihood of the profiles with the slopes says of where they come from; keys follow.
fn verdict(likelihood_gain: f64, described: &str) -> String {
    match likelihood_gain {
        gain if gain > DECISIVE => format!(
            "The profiles are described better with it in the scene ({described}): it is likely of manufacture. Set, with the wear that goes with it:"
        ),
        gain if gain < -DECISIVE => format!(
            "The profiles are described worse with it in the scene ({described}): it is likely of the measurement (clamping, eccentricity of a tooth). \
             Leave the scene as it is. Of manufacture it would be, with the wear that goes with it:"
        ),
        _ => format!(
            "The profiles do not tell ({described}) whether it is of manufacture or of the measurement (clamping, eccentricity of a tooth); a profile before \
             wear does. Of manufacture, set, with the wear that goes with it:"
        ),
    }
}

/// What was done with the slope of the profiles.
fn treatment(of: &ProfileRecord) -> String {
    match of.profile_slope.as_ref().is_some_and(|slope| slope.removed_with_form) {
        true => format!(
            "Profile slope f_Hα: the form ({}) takes it away, so that it does not count as wear; but where the flank is loaded, and so the wear, depends \
             on it.{}",
            of.form,
            if of.form == Form::Cubic.name() {
                " Of heights from the involute --form involute leaves more of the wear."
            } else {
                ""
            }
        ),
        false => "Profile slope f_Hα: without a form (--form none) it counts as wear.".to_owned(),
    }
}

impl ProfileRecord {
    /// Sentence on a slope before wear that is not the scene's.
    pub fn other_slope(&self) -> Option<String> {
        let is_other = self.profile_slope.as_ref().is_some_and(|slope| slope.differs);
        is_other.then(|| slope_of(self)).flatten()
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
