//! What can be turned of a scene: its torque, duration and wear coefficient, modifications of both flanks, and the teeth themselves.
//!
//! Each slider has a list of values, the scene's own among them; ranges are those that a designer tries for a pair of this module. A value is a key of the scene, but for
//!
//! - tip relief, of which amount and length belong together: a scene without relief gets both,
//! - the profile shift, which is divided between the gears so that x₁ + x₂ and with it the backlash stay; tip diameters that are given follow, d_a + 2 m Δx,
//! - the helix angle of a pair by its normal module, whose centre distance follows so that the backlash stays; given tip diameters follow the reference circles.

use serde::Serialize;
use toml::Value;

use super::{Change, ExploreError, Setting};
use crate::scene::draft::Draft;
use crate::scene::file::PairFile;
use crate::scene::loaded::LoadedScene;
use crate::scene::problem::number;
use gearwear_bodies::gear::modification::Relief;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};

/// Values of a slider on either side of the scene's own, at most.
const MOST_STEPS: i32 = 60;

/// A slider: its name, and the values that it takes.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Slider {
    /// Name: the key of the scene, of several the one that says it best.
    pub name: String,
    pub label: String,
    pub unit: &'static str,
    /// Values, rising.
    pub values: Vec<f64>,
    /// Index of the scene's own value.
    pub at: usize,
    /// What else follows it.
    pub note: &'static str,
}

/// What a slider changes.
#[derive(Debug, Clone, PartialEq)]
enum Turned {
    /// A key, or several linked ones.
    Key,
    /// Amount of the tip relief, µm.
    ReliefAmount(Gear),
    /// Length of the tip relief.
    ReliefLength(Gear),
    /// Profile shift of the pinion; that of the wheel makes up for it.
    Shift,
    /// Helix angle.
    Helix,
    /// Duration, with which snapshots go.
    Duration,
}

/// The sliders of a scene, and what their changes start from.
pub(super) struct Sliders {
    pub(super) list: Vec<Slider>,
    turned: Vec<Turned>,
    start: Start,
}

/// Teeth of the scene as opened.
struct Start {
    has_relief: PerGear<bool>,
    shift: PerGear<f64>,
    /// Module by which profile shifts are given.
    module_mm: f64,
    /// Tip diameters that the scene or its preset gives.
    tip_diameter_mm: PerGear<Option<f64>>,
    teeth: PerGear<f64>,
    /// Backlash of a pair whose centre distance follows the helix angle, µm.
    kept_backlash_um: Option<f64>,
    helix_deg: f64,
}

/// Values in steps on both sides of `start`, which is one of them, from `low` to `high`.
fn in_steps(start: f64, low: f64, high: f64, step: f64) -> (Vec<f64>, usize) {
    let at = |i: i32| if i == 0 { start } else { rounded(start + f64::from(i) * step) };
    let values = (-MOST_STEPS..=MOST_STEPS).map(|i| (i, at(i)));
    let within = values.filter(|(i, value)| *i == 0 || (*value >= low - 1e-9 && *value <= high + 1e-9));
    let (steps, values): (Vec<i32>, Vec<f64>) = within.unzip();
    (values, steps.iter().position(|&i| i == 0).unwrap_or(0))
}

/// Values in equal ratios, ten a decade, one decade on both sides of `start`.
fn in_ratios(start: f64) -> (Vec<f64>, usize) {
    let values = (-10..=10).map(|i| if i == 0 { start } else { three_digits(start * 10_f64.powf(0.1 * f64::from(i))) });
    (values.collect(), 10)
}

fn rounded(value: f64) -> f64 {
    let value = format!("{value:.6}").parse().unwrap_or(value);
    if value == 0.0 { 0.0 } else { value }
}

fn three_digits(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// Step of 1, 2 or 5 times a power of ten, at least so many to `span`.
fn even_step(span: f64, count: f64) -> f64 {
    let raw = span / count;
    let power = 10_f64.powf(raw.log10().floor());
    let factor = [5.0, 2.0, 1.0].into_iter().find(|factor| factor * power <= raw).unwrap_or(1.0);
    three_digits(factor * power)
}

impl Sliders {
    /// Sliders of `given`, read as `draft`, with the teeth of `pair`.
    pub(super) fn of(given: &LoadedScene, draft: &Draft, pair: &GearPair) -> Self {
        let file = &given.resolved.file.pair;
        let start = Start::of(file, draft, pair);
        let mut sliders = Self { list: Vec::new(), turned: Vec::new(), start };
        sliders.add_reliefs(pair);
        sliders.add_modifications(given, pair);
        sliders.add_operation(given, draft);
        sliders.add_teeth(given);
        sliders
    }

    fn add(&mut self, turned: Turned, name: &str, (label, unit): (String, &'static str), values: (Vec<f64>, usize)) {
        let note = match turned {
            Turned::Shift => "the wheel's makes up for it; tip diameters follow",
            Turned::Helix if self.start.kept_backlash_um.is_some() => "centre distance and tip diameters follow",
            _ => "",
        };
        let (values, at) = values;
        if values.len() > 1 {
            self.list.push(Slider { name: name.to_owned(), label, unit, values, at, note });
            self.turned.push(turned);
        }
    }

    fn add_reliefs(&mut self, pair: &GearPair) {
        let module_mm = pair.spec.normal_module_mm;
        let path_mm = (pair.path.end_mm - pair.path.start_mm).abs();
        let usual_mm = (0.5 * (path_mm - pair.path.base_pitch_mm)).max(0.1 * path_mm);
        for gear in Gear::BOTH {
            let own = pair.spec.gears[gear].modification.tip_relief;
            let Relief { amount_mm, length_mm, .. } = own.unwrap_or(Relief {
                amount_mm: 0.0,
                length_mm: format!("{usual_mm:.1}").parse().unwrap_or(usual_mm),
                shape: Default::default(),
            });
            let amount_um = rounded(1e3 * amount_mm);
            let most_um = (14.0 * module_mm).max(2.0 * amount_um);
            let values = in_steps(amount_um, 0.0, most_um, even_step(most_um, 50.0));
            let label = |what: &str| format!("{what} of tip relief, {}", gear.name());
            let name = |what: &str| format!("pair.{}.tip_relief.{what}", gear.name());
            self.add(Turned::ReliefAmount(gear), &name("amount_um"), (label("Amount"), "µm"), values);
            let step_mm = even_step(path_mm, 100.0);
            let values = in_steps(rounded(length_mm), step_mm, (0.45 * path_mm).max(length_mm), step_mm);
            self.add(Turned::ReliefLength(gear), &name("length_mm"), (label("Length"), "mm"), values);
        }
    }

    fn add_modifications(&mut self, given: &LoadedScene, pair: &GearPair) {
        let module_mm = pair.spec.normal_module_mm;
        let of_both = pair.spec.gears.as_ref().map(|gear| gear.modification);
        let linked = |key: &str| format!("pair.{{pinion,wheel}}.{key}");
        let own_mm = of_both.pinion.tip_rounding_mm;
        if own_mm == of_both.wheel.tip_rounding_mm {
            let most_mm = (0.08 * module_mm).max(1.5 * own_mm);
            let values = in_steps(own_mm, 0.0, most_mm, even_step(most_mm, 40.0));
            let label = ("Radius of the tip edges".to_owned(), "mm");
            self.add(Turned::Key, &linked("tip_rounding_mm"), label, values);
        }
        for gear in Gear::BOTH {
            let own = of_both[gear];
            let profile_um = rounded(1e3 * own.profile_crowning_mm);
            let most_um = (3.0 * module_mm).max(2.0 * profile_um);
            let values = in_steps(profile_um, 0.0, most_um, even_step(most_um, 30.0));
            let label = (format!("Profile crowning, {}", gear.name()), "µm");
            self.add(Turned::Key, &format!("pair.{}.profile_crowning_um", gear.name()), label, values);
        }
        if given.scene().slices.is_some() {
            let lead_um = rounded(1e3 * of_both.pinion.lead_crowning_mm);
            let most_um = 20.0_f64.max(2.0 * lead_um);
            let values = in_steps(lead_um, 0.0, most_um, 0.5_f64.max(even_step(most_um, 40.0)));
            let label = ("Lead crowning, pinion".to_owned(), "µm");
            self.add(Turned::Key, "pair.pinion.lead_crowning_um", label, values);
        }
    }

    fn add_operation(&mut self, given: &LoadedScene, draft: &Draft) {
        let phases = &given.scene().operation.phases;
        let torque_nm = given.resolved.file.operation.pinion_torque_Nm;
        if let (Some(torque_nm), [_]) = (torque_nm, &phases[..]) {
            let values = in_steps(torque_nm, 0.2 * torque_nm, 2.0 * torque_nm, even_step(torque_nm, 30.0));
            let label = ("Torque on the pinion".to_owned(), "N·m");
            self.add(Turned::Key, "operation.pinion_torque_Nm", label, values);
        }
        let durations = [("operation.hours", "h"), ("operation.pinion_revolutions", "rev")];
        if let ([_], Some((key, unit))) = (&phases[..], durations.into_iter().find(|(key, _)| draft.gives(key))) {
            let file = &given.resolved.file.operation;
            let own = if unit == "h" { file.hours } else { file.pinion_revolutions };
            if let Some(own) = own {
                self.add(Turned::Duration, key, ("Duration".to_owned(), unit), in_ratios(own));
            }
        }
        let keys = ["wear.coefficient_m2_per_N", "wear.coefficient_mm3_per_Nm"];
        let of_phase =
            phases.iter().any(|phase| Gear::BOTH.iter().any(|&gear| phase.coefficient_mm2_per_n[gear].is_some()));
        let given_key = keys.into_iter().find(|key| draft.gives(key));
        let wear = &given.resolved.file.wear;
        let (m2_per_n, mm3_per_nm) = (wear.coefficient_m2_per_N, wear.coefficient_mm3_per_Nm);
        let own = given_key.and_then(|key| match key == keys[0] {
            true => m2_per_n.or(mm3_per_nm.map(|k| 1e-9 * k)),
            false => mm3_per_nm.or(m2_per_n.map(|k| 1e9 * k)),
        });
        if let (Some(key), Some(own), false) = (given_key, own, of_phase) {
            let unit = if key == keys[0] { "m²/N" } else { "mm³/(N·m)" };
            self.add(Turned::Key, key, ("Wear coefficient k".to_owned(), unit), in_ratios(own));
        }
    }

    fn add_teeth(&mut self, given: &LoadedScene) {
        let spec = &given.scene().pair;
        if spec.is_internal() {
            return;
        }
        let shift = self.start.shift.pinion;
        let label = ("Profile shift of the pinion".to_owned(), "");
        let values = in_steps(shift, shift - 0.3, shift + 0.3, 0.02);
        self.add(Turned::Shift, "pair.pinion.profile_shift", label, values);
        let helix_deg = self.start.helix_deg;
        if helix_deg != 0.0 {
            let label = ("Helix angle".to_owned(), "°");
            let values = in_steps(helix_deg, helix_deg - 10.0, helix_deg + 10.0, 0.5);
            self.add(Turned::Helix, "pair.helix_angle_deg", label, without_zero(values));
        }
    }

    /// Changes of the scene by `setting`.
    ///
    /// # Errors
    /// A slider that there is not; a value outside its range.
    pub(super) fn changes(&self, setting: &Setting) -> Result<Vec<Change>, ExploreError> {
        for (name, &found) in setting {
            let slider = self.list.iter().find(|slider| slider.name == *name);
            let Some(Slider { values, .. }) = slider else {
                return Err(ExploreError::UnknownSlider { name: name.chars().take(80).collect() });
            };
            let (low, high) = (values[0], values[values.len() - 1]);
            // No number is outside too.
            if !(low..=high).contains(&found) {
                return Err(ExploreError::OutOfRange { name: name.clone(), found, low, high });
            }
        }
        let turned = self.list.iter().zip(&self.turned).filter_map(|(slider, turned)| {
            let value = *setting.get(&slider.name)?;
            (value != slider.values[slider.at]).then_some((slider, turned, value))
        });
        Ok(turned.flat_map(|(slider, turned, value)| self.changes_of(slider, turned, value, setting)).collect())
    }

    /// Tip reliefs, and other modifications that `setting` turns, with the ranges of their sliders: `KEY = FROM:TO`.
    pub(super) fn free(&self, setting: &Setting) -> Vec<String> {
        let turned = self.list.iter().zip(&self.turned).filter(|(slider, turned)| match turned {
            Turned::ReliefAmount(_) | Turned::ReliefLength(_) => true,
            Turned::Key => slider.name.starts_with("pair.") && setting.contains_key(&slider.name),
            Turned::Shift | Turned::Helix | Turned::Duration => false,
        });
        let range = |values: &[f64]| [number(values[0]), number(values[values.len() - 1])].join(":");
        turned.map(|(slider, _)| format!("{} = {}", slider.name, range(&slider.values))).collect()
    }

    fn changes_of(&self, slider: &Slider, turned: &Turned, value: f64, setting: &Setting) -> Vec<Change> {
        let own = (slider.name.clone(), Some(Value::Float(value)));
        match turned {
            Turned::Key => vec![own],
            Turned::ReliefAmount(gear) if self.start.has_relief[*gear] => vec![own],
            Turned::ReliefLength(gear) if self.start.has_relief[*gear] => vec![own],
            // Without relief a length says nothing; with an amount both are given.
            Turned::ReliefLength(_) => Vec::new(),
            Turned::ReliefAmount(gear) => {
                let name = format!("pair.{}.tip_relief.length_mm", gear.name());
                let length = self.list.iter().find(|other| other.name == name);
                let length_mm = setting.get(&name).copied().or(length.map(|other| other.values[other.at]));
                vec![own, (name, length_mm.map(Value::Float))]
            }
            Turned::Shift => self.start.divided_shift(value),
            Turned::Helix => self.start.with_helix(value),
            Turned::Duration => {
                let snapshots = ["operation.snapshots_h", "operation.snapshots_revolutions"];
                snapshots.map(|key| (key.to_owned(), None)).into_iter().chain([own]).collect()
            }
        }
    }
}

/// Values of the sign of the scene's own: a helix that is none is another model.
fn without_zero((values, at): (Vec<f64>, usize)) -> (Vec<f64>, usize) {
    let own = values[at];
    let kept: Vec<f64> = values.into_iter().filter(|value| value * own > 0.0 && value.abs() <= 45.0).collect();
    let at = kept.iter().position(|value| *value == own).unwrap_or(0);
    (kept, at)
}

impl Start {
    fn of(file: &PairFile, draft: &Draft, pair: &GearPair) -> Self {
        let spec = &pair.spec;
        let given_by_transverse = file.transverse_module_mm.is_some();
        let gives = |gear: Gear, name: &str| {
            let key = format!("pair.{}.{name}", gear.name());
            // Presets give all of a pair but what stands beside them.
            draft.gives(&key) || (draft.gives("pair.preset") && !spec.is_internal())
        };
        let follows_backlash = ["pair.backlash_um", "pair.normal_backlash_um"].iter().any(|key| draft.gives(key));
        let shift = |gear: Gear| {
            let own = file.gear(gear).and_then(|own| own.profile_shift);
            own.unwrap_or(spec.gears[gear].profile_shift)
        };
        Self {
            has_relief: PerGear::from_fn(|gear| spec.gears[gear].modification.tip_relief.is_some()),
            shift: PerGear::from_fn(shift),
            module_mm: file.transverse_module_mm.unwrap_or(spec.normal_module_mm),
            tip_diameter_mm: PerGear::from_fn(|gear| {
                spec.gears[gear].tip_diameter_mm.filter(|_| gives(gear, "tip_diameter_mm"))
            }),
            teeth: PerGear::from_fn(|gear| spec.gears[gear].z()),
            kept_backlash_um: (!given_by_transverse && !follows_backlash).then_some(1e3 * pair.backlash_mm),
            helix_deg: file.helix_angle_deg.unwrap_or_default(),
        }
    }

    /// Profile shift of the pinion with that of the wheel, which keeps their sum, and tip diameters.
    fn divided_shift(&self, pinion: f64) -> Vec<Change> {
        let by = pinion - self.shift.pinion;
        let mut changes = Vec::new();
        for (gear, by) in [(Gear::Pinion, by), (Gear::Wheel, -by)] {
            let key = |name: &str| format!("pair.{}.{name}", gear.name());
            changes.push((key("profile_shift"), Some(Value::Float(rounded(self.shift[gear] + by)))));
            if let Some(tip_mm) = self.tip_diameter_mm[gear] {
                let moved_mm = rounded(tip_mm + 2.0 * self.module_mm * by);
                changes.push((key("tip_diameter_mm"), Some(Value::Float(moved_mm))));
            }
        }
        changes
    }

    /// Helix angle, with what follows it.
    fn with_helix(&self, helix_deg: f64) -> Vec<Change> {
        let mut changes = vec![("pair.helix_angle_deg".to_owned(), Some(Value::Float(helix_deg)))];
        if let Some(backlash_um) = self.kept_backlash_um {
            changes.push(("pair.backlash_um".to_owned(), Some(Value::Float(rounded(backlash_um)))));
            let [own, other] = [self.helix_deg, helix_deg].map(|deg| self.module_mm / deg.to_radians().cos());
            for gear in Gear::BOTH {
                if let Some(tip_mm) = self.tip_diameter_mm[gear] {
                    let moved_mm = rounded(tip_mm + self.teeth[gear] * (other - own));
                    let key = format!("pair.{}.tip_diameter_mm", gear.name());
                    changes.push((key, Some(Value::Float(moved_mm))));
                }
            }
        }
        changes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_have_the_scene_s_own_among_them() {
        let (values, at) = in_steps(0.1817, 0.1, 0.25, 0.02);
        assert_eq!((values, at), (vec![0.1017, 0.1217, 0.1417, 0.1617, 0.1817, 0.2017, 0.2217, 0.2417], 4));
        let (values, at) = in_ratios(1e-17);
        assert_eq!((values.len(), values[at], values[0], values[20]), (21, 1e-17, 1e-18, 1e-16));
        assert_eq!(even_step(63.0, 50.0), 1.0);
        assert_eq!(even_step(302.0, 30.0), 10.0);
        assert_eq!(without_zero((vec![-0.5, 0.0, 0.5, 1.0], 3)), (vec![0.5, 1.0], 1));
    }
}
