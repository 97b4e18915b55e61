//! Wear laws: how fast a flank point loses material under pressure and sliding.
//!
//! Every law here has the form of the generalised Archard law with a coefficient of its own,
//!
//! ```text
//! dh = C(p) · k(v, T) · p ds
//! ```
//!
//! and a new one is a file that implements [`WearLaw`]. The severe transition C(p) (`severe`) goes with any of them.

pub mod adsorption;
pub(crate) mod archard;
pub(crate) mod heated_row;
pub mod oxidation;
pub mod regime;
pub mod settings;
mod severe;
pub mod stepping;

use crate::gear::{Gear, PerGear};
use crate::thermal::ContactHeat;
use settings::{LawSettings, SevereTransition, WearSettings};

/// What the chemistry of a flank point knows of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactConditions {
    /// Sliding speed, mm/s.
    pub sliding_speed_mm_per_s: f64,
    /// Contact temperature, K.
    pub temperature_k: f64,
}

/// A local wear law.
pub trait WearLaw: Sync {
    /// Whether the coefficient depends on the [`ContactConditions`].
    const READS_CONDITIONS: bool;

    /// Depth per pressure and sliding distance, mm²/N. Laws that do not read the conditions get none.
    fn coefficient_mm2_per_n(&self, conditions: Option<ContactConditions>) -> f64;
}

/// What consecutive points of a flank feel at one loading position, in rows of the same length.
#[derive(Debug, Clone, Copy)]
pub struct SlidingRow<'a> {
    /// Pressure on each, MPa.
    pub pressure_mpa: &'a [f64],
    /// How far each slides, mm.
    pub sliding_mm: &'a [f64],
    /// What its chemistry knows, where the law reads it.
    pub conditions: Option<&'a [ContactConditions]>,
}

/// Wear of a flank by some law, in rows of points: the law itself stays out of the inner loop's way.
pub trait FlankWear: Sync {
    /// Adds to each point's depth (mm) what it loses. Rows without conditions are for laws that do not read them.
    fn add_depth(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64]);

    /// Whether rows must have conditions.
    fn reads_conditions(&self) -> bool;

    /// Depth per pressure and sliding distance of mild wear, mm²/N.
    fn mild_coefficient_mm2_per_n(&self, conditions: Option<ContactConditions>) -> f64;
}

/// A law with a transition to severe wear.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct WithTransition<L> {
    /// The law of mild wear.
    pub law: L,
    /// The transition, where there is one.
    pub severe: Option<SevereTransition>,
}

impl<L: WearLaw> FlankWear for WithTransition<L> {
    fn add_depth(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64]) {
        let points = row.pressure_mpa.iter().zip(row.sliding_mm);
        let add = |(depth, (&pressure, &sliding)): (&mut f64, (&f64, &f64)), k: f64| {
            let factor = self.severe.as_ref().map_or(1.0, |severe| severe.factor_at(pressure));
            *depth += factor * k * pressure * sliding;
        };
        if L::READS_CONDITIONS {
            let conditions = row.conditions.expect("rows of a law that reads the conditions have them");
            for (point, own) in depth_mm.iter_mut().zip(points).zip(conditions) {
                add(point, self.law.coefficient_mm2_per_n(Some(*own)));
            }
        } else {
            let k = self.law.coefficient_mm2_per_n(None);
            depth_mm.iter_mut().zip(points).for_each(|point| add(point, k));
        }
    }

    fn reads_conditions(&self) -> bool {
        L::READS_CONDITIONS
    }

    fn mild_coefficient_mm2_per_n(&self, conditions: Option<ContactConditions>) -> f64 {
        self.law.coefficient_mm2_per_n(conditions)
    }
}

/// The wear that a scene asks for.
pub fn of(settings: &WearSettings) -> Box<dyn FlankWear> {
    let (k, severe) = (settings.coefficient_mm2_per_n, settings.severe);
    match settings.law {
        LawSettings::Archard => Box::new(WithTransition { law: archard::Archard { coefficient_mm2_per_n: k }, severe }),
        LawSettings::Adsorption(constants) => {
            Box::new(WithTransition { law: adsorption::Adsorption { coefficient_mm2_per_n: k, constants }, severe })
        }
        LawSettings::Oxidation(constants) => {
            Box::new(WithTransition { law: oxidation::Oxidation { coefficient_mm2_per_n: k, constants }, severe })
        }
    }
}

/// The laws of both gears.
pub type Laws = PerGear<Box<dyn FlankWear>>;

/// The wear that a scene asks for of each gear.
pub fn of_both(settings: &PerGear<WearSettings>) -> Laws {
    PerGear::from_fn(|gear| of(&settings[gear]))
}

/// How flanks in mesh wear: each gear by which law, and where their heat comes from where a law reads it.
#[derive(Clone, Copy)]
pub struct WearModel<'a> {
    /// The law of each gear.
    pub laws: PerGear<&'a dyn FlankWear>,
    /// Friction heat of the contact, where the law or the scene asks for it.
    pub heat: Option<&'a ContactHeat>,
}

impl<'a> WearModel<'a> {
    /// Both gears by these laws.
    pub fn new(laws: &'a Laws, heat: Option<&'a ContactHeat>) -> Self {
        Self { laws: laws.as_ref().map(|law| &**law), heat }
    }

    /// Both gears by one law, which reads no conditions.
    pub fn cold(law: &'a dyn FlankWear) -> Self {
        Self { laws: PerGear { pinion: law, wheel: law }, heat: None }
    }

    /// The heat, where either law reads what it does to the contact.
    pub(crate) fn heat_of_laws(&self) -> Option<&'a ContactHeat> {
        Gear::BOTH.into_iter().find_map(|gear| self.heat_of_law(gear))
    }

    /// The heat, where the law of `gear` reads what it does to the contact.
    pub(crate) fn heat_of_law(&self, gear: Gear) -> Option<&'a ContactHeat> {
        self.heat.filter(|_| self.laws[gear].reads_conditions())
    }
}
