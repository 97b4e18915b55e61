//! Wear laws: how fast a flank point loses material under pressure and sliding.
//!
//! Every law here has the form of the generalised Archard law with a coefficient of its own,
//!
//! ```text
//! dh = C(p) · f(λ) · k(v, T) · p ds
//! ```
//!
//! and a new one is a file that implements [`WearLaw`]. The severe transition C(p) (`severe`) and the factor f of the film of oil
//! ([`settings::FilmDependence`]) go with any of them.

pub mod adsorption;
pub(crate) mod archard;
pub(crate) mod heated_row;
pub mod oxidation;
pub mod regime;
pub mod settings;
mod severe;
pub mod stepping;
pub mod vdi_2736;

use crate::gear::{Gear, PerGear};
use crate::lubrication::running_pair::{LoadedPlace, RunningPair};
use crate::lubrication::settings::FilmRatio;
use crate::thermal::ContactHeat;
use settings::{FilmDependence, LawSettings, SevereTransition, WearSettings};

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
    /// λ, where the coefficient follows it.
    pub lambda: Option<Lambda<'a>>,
}

/// λ of the points of a row.
#[derive(Debug, Clone, Copy)]
pub enum Lambda<'a> {
    /// All are in one contact.
    OfAll(f64),
    /// Each is in a contact of its own.
    OfEach(&'a [f64]),
}

/// Wear of a flank by some law, in rows of points: the law itself stays out of the inner loop's way.
pub trait FlankWear: Sync {
    /// Adds to each point's depth (mm) what it loses. Rows without conditions are for laws that do not read them.
    fn add_depth(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64]);

    /// Whether rows must have conditions.
    fn reads_conditions(&self) -> bool;

    /// How the coefficient follows the film, where it does and rows should have λ.
    fn film(&self) -> Option<&FilmDependence>;

    /// Depth per pressure and sliding distance of mild wear without a film, mm²/N.
    fn mild_coefficient_mm2_per_n(&self, conditions: Option<ContactConditions>) -> f64;
}

/// A law with the factors that go with any.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WithFactors<L> {
    /// The law of mild wear.
    pub law: L,
    /// The transition to severe wear, where there is one.
    pub severe: Option<SevereTransition>,
    /// How wear follows the film, where it does.
    pub film: Option<FilmDependence>,
}

impl<L: WearLaw> WithFactors<L> {
    /// The law alone.
    #[cfg(test)]
    pub(crate) fn none(law: L) -> Self {
        Self { law, severe: None, film: None }
    }

    /// Adds to each point's depth what it loses where the film leaves `thin` of it, by the point's index.
    fn add(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64], thin: impl Fn(usize) -> f64) {
        let points = row.pressure_mpa.iter().zip(row.sliding_mm);
        let add = |index: usize, (depth, (&pressure, &sliding)): (&mut f64, (&f64, &f64)), k: f64| {
            let factor = thin(index) * self.severe.as_ref().map_or(1.0, |severe| severe.factor_at(pressure));
            *depth += factor * k * pressure * sliding;
        };
        if L::READS_CONDITIONS {
            let conditions = row.conditions.expect("rows of a law that reads the conditions have them");
            for (index, (point, own)) in depth_mm.iter_mut().zip(points).zip(conditions).enumerate() {
                add(index, point, self.law.coefficient_mm2_per_n(Some(*own)));
            }
        } else {
            let k = self.law.coefficient_mm2_per_n(None);
            depth_mm.iter_mut().zip(points).enumerate().for_each(|(index, point)| add(index, point, k));
        }
    }
}

impl<L: WearLaw> FlankWear for WithFactors<L> {
    fn add_depth(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64]) {
        match self.film.as_ref().zip(row.lambda) {
            None => self.add(row, depth_mm, |_| 1.0),
            Some((film, Lambda::OfAll(lambda))) => {
                let thin = film.factor_at(lambda);
                self.add(row, depth_mm, |_| thin);
            }
            Some((film, Lambda::OfEach(lambda))) => self.add(row, depth_mm, |index| film.factor_at(lambda[index])),
        }
    }

    fn film(&self) -> Option<&FilmDependence> {
        self.film.as_ref()
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
    fn boxed<L: WearLaw + 'static>(law: L, settings: &WearSettings) -> Box<dyn FlankWear> {
        Box::new(WithFactors { law, severe: settings.severe_transition(), film: settings.film.clone() })
    }
    let k = settings.coefficient_mm2_per_n;
    match settings.law {
        LawSettings::Archard => boxed(archard::Archard { coefficient_mm2_per_n: k }, settings),
        LawSettings::Adsorption(constants) => {
            boxed(adsorption::Adsorption { coefficient_mm2_per_n: k, constants }, settings)
        }
        LawSettings::Oxidation(constants) => {
            boxed(oxidation::Oxidation { coefficient_mm2_per_n: k, constants }, settings)
        }
    }
}

/// The laws of both gears.
pub type Laws = PerGear<Box<dyn FlankWear>>;

/// The wear that a scene asks for of each gear.
pub fn of_both(settings: &PerGear<WearSettings>) -> Laws {
    PerGear::from_fn(|gear| of(&settings[gear]))
}

/// How flanks in mesh wear: each gear by which law, and where its heat and its films come from where a law reads them.
#[derive(Clone, Copy)]
pub struct WearModel<'a> {
    /// The law of each gear.
    pub laws: PerGear<&'a dyn FlankWear>,
    /// Friction heat of the contact, where the law or the scene asks for it.
    pub heat: Option<&'a ContactHeat>,
    /// The pair with its oil, where the scene has any.
    pub running: Option<&'a RunningPair<'a>>,
}

impl<'a> WearModel<'a> {
    /// Both gears by these laws, which read neither heat nor film.
    pub fn new(laws: &'a Laws) -> Self {
        Self { laws: laws.as_ref().map(|law| &**law), heat: None, running: None }
    }

    /// Both gears by one law, which reads neither.
    pub fn cold(law: &'a dyn FlankWear) -> Self {
        Self { laws: PerGear { pinion: law, wheel: law }, heat: None, running: None }
    }

    /// The same in the heat and the oil of the mesh.
    pub fn under(self, heat: Option<&'a ContactHeat>, running: Option<&'a RunningPair<'a>>) -> Self {
        Self { heat, running, ..self }
    }

    /// Other laws in the same heat and oil.
    pub fn with_laws<'b>(&self, laws: &'b Laws) -> WearModel<'b>
    where
        'a: 'b,
    {
        WearModel::new(laws).under(self.heat, self.running)
    }

    /// The heat, where either law reads what it does to the contact.
    pub(crate) fn heat_of_laws(&self) -> Option<&'a ContactHeat> {
        Gear::BOTH.into_iter().find_map(|gear| self.heat_of_law(gear))
    }

    /// The heat, where the law of `gear` reads what it does to the contact.
    pub(crate) fn heat_of_law(&self, gear: Gear) -> Option<&'a ContactHeat> {
        self.heat.filter(|_| self.laws[gear].reads_conditions())
    }

    /// Whether either law reads heat or film.
    pub(crate) fn reads_places(&self) -> bool {
        Gear::BOTH.into_iter().any(|gear| self.heat_of_law(gear).is_some() || self.films_of_law(gear).is_some())
    }

    /// Coefficient of friction that heats a contact: the given one, otherwise that of the mesh.
    pub(crate) fn friction(&self, heat: &ContactHeat, place: &LoadedPlace) -> f64 {
        let of_mesh = || self.running.map_or(0.0, |running| running.friction(place));
        heat.settings.friction_coefficient.unwrap_or_else(of_mesh)
    }

    /// Factor of the film of a contact on the wear of `gear`; none where its law reads no film.
    pub fn film_factor(&self, gear: Gear, place: &LoadedPlace) -> Option<f64> {
        let films = self.films_of_law(gear)?;
        Some(self.laws[gear].film()?.factor_at(films.lambda(place)))
    }

    /// λ of a contact as the law of each gear reads it; none where it reads none.
    pub(crate) fn lambdas(&self, place: &LoadedPlace) -> PerGear<Option<Lambda<'static>>> {
        let films = PerGear::from_fn(|gear| self.films_of_law(gear));
        let pinion = films.pinion.map(|films| films.lambda(place));
        let wheel = match (films.pinion, films.wheel) {
            (Some(of_pinion), Some(of_wheel)) if of_pinion.ratio == of_wheel.ratio => pinion,
            (_, of_wheel) => of_wheel.map(|films| films.lambda(place)),
        };
        PerGear { pinion, wheel }.map(|lambda| lambda.map(Lambda::OfAll))
    }

    /// Which λ the law of `gear` reads, and of which pair; none where it reads none.
    pub(crate) fn films_of_law(&self, gear: Gear) -> Option<Films<'a>> {
        let film = self.laws[gear].film()?;
        Some(Films { running: self.running?, ratio: film.ratio })
    }
}

/// The films that a law reads.
#[derive(Clone, Copy)]
pub(crate) struct Films<'a> {
    running: &'a RunningPair<'a>,
    ratio: FilmRatio,
}

impl Films<'_> {
    /// λ of a contact; no film where there is no load.
    pub(crate) fn lambda(&self, place: &LoadedPlace) -> f64 {
        self.running.film_ratio(place, self.ratio).unwrap_or(0.0)
    }
}
