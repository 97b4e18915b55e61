//! Wear laws: loss of material of a flank point under pressure and sliding.
//!
//! Every law here has the form of the generalised Archard law with a coefficient of its own,
//!
//! ```text
//! dh = C(p) · f(λ) · k(p, v, T, λ) · p ds
//! ```
//!
//! and a new one is a file that implements [`WearLaw`]. The severe transition C(p) (`severe`) and the factor f of the film of oil
//! ([`settings::FilmDependence`]) go with any of them.

pub mod adsorption;
pub(crate) mod archard;
pub mod coefficient_range;
pub(crate) mod heated_row;
pub mod oxidation;
pub mod regime;
pub mod settings;
mod severe;
pub mod stepping;
pub mod vdi_2736;

use crate::lubrication::running_pair::{LoadedPlace, RunningPair};
use crate::lubrication::settings::FilmRatio;
use crate::thermal::ContactHeat;
use gearwear_bodies::gear::{Gear, PerGear};
use settings::{FilmDependence, LawSettings, SevereTransition, WearSettings};

/// Conditions of a contact that the chemistry of a flank point depends on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactConditions {
    /// Sliding speed, mm/s.
    pub sliding_speed_mm_per_s: f64,
    /// Contact temperature, K.
    pub temperature_k: f64,
}

/// Contact at a flank point, as a wear law sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LocalContact {
    /// Pressure, MPa.
    pub pressure_mpa: f64,
    /// Sliding speed and temperature; none for laws that do not read them.
    pub conditions: Option<ContactConditions>,
    /// λ; none where wear does not follow the film.
    pub lambda: Option<f64>,
}

/// A local wear law.
pub trait WearLaw: Sync {
    /// Whether the coefficient depends on the [`ContactConditions`].
    const READS_CONDITIONS: bool;

    /// Depth per pressure and sliding distance, mm²/N.
    fn coefficient_mm2_per_n(&self, at: &LocalContact) -> f64;
}

/// Constants of a law, with the facts that a scene and a report state of it.
pub(crate) trait LawConstants {
    /// Contact temperatures between which the law holds, °C; none where it has no bounds.
    const VALID_TEMPERATURE_C: Option<[f64; 2]> = None;

    /// Keys of the constants that have a typical value, which is an order of magnitude and not measured.
    fn typical(&self) -> Vec<&'static str>;
}

/// Pressure, sliding and conditions of points of a flank at one loading position, in rows of the same length.
#[derive(Debug, Clone, Copy)]
pub struct SlidingRow<'a> {
    /// Pressure on each, MPa.
    pub pressure_mpa: &'a [f64],
    /// Sliding distance of each, mm.
    pub sliding_mm: &'a [f64],
    /// Conditions of each, where the law reads them.
    pub conditions: Option<&'a [ContactConditions]>,
    /// λ, where the coefficient depends on it.
    pub lambda: Option<Lambda<'a>>,
    /// Whether the points are the cells of one contact, one after another, between which pressure is linear; otherwise each has a pressure of its own, as the mean on its course.
    pub is_continuous: bool,
}

/// λ of the points of a row.
#[derive(Debug, Clone, Copy)]
pub enum Lambda<'a> {
    /// λ of the one contact that all points are in.
    OfAll(f64),
    /// λ of the contact of each point.
    OfEach(&'a [f64]),
}

/// Wear of a flank by some law, in rows of points.
pub trait FlankWear: Sync {
    /// Adds the depth, mm, that each point loses. Rows without conditions are for laws that do not read them.
    fn add_depth(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64]);

    /// Whether rows must have conditions.
    fn reads_conditions(&self) -> bool;

    /// Dependence of the coefficient on the film; rows should have λ where there is one.
    fn film(&self) -> Option<&FilmDependence>;

    /// Depth per pressure and sliding distance of mild wear without a film, mm²/N.
    fn mild_coefficient_mm2_per_n(&self, at: &LocalContact) -> f64;

    /// Pressure from which on wear is faster than mild, MPa; none where it never is.
    fn severe_from_mpa(&self) -> Option<f64> {
        None
    }
}

/// A law with the factors of severe wear and of the film.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct WithFactors<L> {
    /// The law of mild wear.
    pub law: L,
    /// The transition to severe wear, where there is one.
    pub severe: Option<SevereTransition>,
    /// Dependence on the film, where there is one.
    pub film: Option<FilmDependence>,
}

impl<L: WearLaw> WithFactors<L> {
    /// The law alone.
    #[cfg(test)]
    pub(crate) fn none(law: L) -> Self {
        Self { law, severe: None, film: None }
    }

    /// Adds the depth that each point loses, with λ and the factor of the film at the point's index.
    fn add(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64], film: impl Fn(usize) -> (Option<f64>, f64)) {
        let conditions = row.conditions.filter(|_| L::READS_CONDITIONS);
        assert!(conditions.is_some() || !L::READS_CONDITIONS, "rows of a law that reads the conditions have them");
        let points = depth_mm.iter_mut().zip(row.pressure_mpa.iter().zip(row.sliding_mm));
        for (index, (depth, (&pressure_mpa, &sliding_mm))) in points.enumerate() {
            let (lambda, thin) = film(index);
            let at = LocalContact { pressure_mpa, conditions: conditions.map(|row| row[index]), lambda };
            let factor = thin
                * self.severe.as_ref().map_or(1.0, |severe| match row.is_continuous {
                    true => severe.mean_factor(row.pressure_mpa, index),
                    false => severe.factor_at(pressure_mpa),
                });
            *depth += factor * self.law.coefficient_mm2_per_n(&at) * pressure_mpa * sliding_mm;
        }
    }
}

impl<L: WearLaw> FlankWear for WithFactors<L> {
    fn add_depth(&self, row: &SlidingRow<'_>, depth_mm: &mut [f64]) {
        match self.film.as_ref().zip(row.lambda) {
            None => self.add(row, depth_mm, |_| (None, 1.0)),
            Some((film, Lambda::OfAll(lambda))) => {
                let thin = film.factor_at(lambda);
                self.add(row, depth_mm, |_| (Some(lambda), thin));
            }
            Some((film, Lambda::OfEach(lambda))) => {
                self.add(row, depth_mm, |index| (Some(lambda[index]), film.factor_at(lambda[index])));
            }
        }
    }

    fn film(&self) -> Option<&FilmDependence> {
        self.film.as_ref()
    }

    fn reads_conditions(&self) -> bool {
        L::READS_CONDITIONS
    }

    fn mild_coefficient_mm2_per_n(&self, at: &LocalContact) -> f64 {
        self.law.coefficient_mm2_per_n(at)
    }

    fn severe_from_mpa(&self) -> Option<f64> {
        self.severe.filter(|severe| severe.factor > 1.0).map(SevereTransition::begins_mpa)
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

/// Part of the pressure from which on wear is severe up to which a contact is far from it.
const SURELY_MILD: f64 = 0.97;
/// The same, up to which the wear of a step hardly brings it there.
const OUT_OF_REACH: f64 = 0.8;

/// Laws of both gears, with heat and films of the mesh for laws that read them.
#[derive(Clone, Copy)]
pub struct WearModel<'a> {
    /// The law of each gear.
    pub laws: PerGear<&'a dyn FlankWear>,
    /// Friction heat of the contact, where a law reads it or the scene has it.
    pub heat: Option<&'a ContactHeat>,
    /// The pair with its oil, where the scene has any.
    pub running: Option<&'a RunningPair<'a>>,
}

impl<'a> WearModel<'a> {
    /// A model of these laws without heat and oil.
    pub fn new(laws: &'a Laws) -> Self {
        Self { laws: laws.as_ref().map(|law| &**law), heat: None, running: None }
    }

    /// A model of one law for both gears, without heat and oil.
    pub fn cold(law: &'a dyn FlankWear) -> Self {
        Self { laws: PerGear { pinion: law, wheel: law }, heat: None, running: None }
    }

    /// Adds the heat and the oil of the mesh.
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

    /// Pressure up to which contacts stay far from severe wear over a wear step, MPa; none where wear is never severe.
    pub(crate) fn surely_mild_mpa(&self) -> Option<f64> {
        self.severe_from_mpa().map(|from_mpa| SURELY_MILD * from_mpa)
    }

    /// Pressure up to which contacts hardly come to severe wear within a wear step, MPa; none where wear is never severe.
    pub(crate) fn out_of_reach_mpa(&self) -> Option<f64> {
        self.severe_from_mpa().map(|from_mpa| OUT_OF_REACH * from_mpa)
    }

    /// Pressure from which on either flank wears severely, MPa; none where wear is never severe.
    fn severe_from_mpa(&self) -> Option<f64> {
        Gear::BOTH.into_iter().filter_map(|gear| self.laws[gear].severe_from_mpa()).reduce(f64::min)
    }

    /// Friction heat, where either law reads contact conditions.
    pub(crate) fn heat_of_laws(&self) -> Option<&'a ContactHeat> {
        Gear::BOTH.into_iter().find_map(|gear| self.heat_of_law(gear))
    }

    /// Friction heat, where the law of `gear` reads contact conditions.
    pub(crate) fn heat_of_law(&self, gear: Gear) -> Option<&'a ContactHeat> {
        self.heat.filter(|_| self.laws[gear].reads_conditions())
    }

    /// Whether either law reads heat or film.
    pub(crate) fn reads_places(&self) -> bool {
        Gear::BOTH.into_iter().any(|gear| self.heat_of_law(gear).is_some() || self.films_of_law(gear).is_some())
    }

    /// Coefficient of friction that heats a contact: the given one, otherwise that of the mesh.
    pub(crate) fn friction(&self, heat: &ContactHeat, place: &LoadedPlace) -> f64 {
        let given = heat.settings.friction_coefficient;
        given.unwrap_or_else(|| self.running.map_or(0.0, |running| running.friction(place)))
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

    /// Films that the law of `gear` reads; none where it reads none.
    pub(crate) fn films_of_law(&self, gear: Gear) -> Option<Films<'a>> {
        let film = self.laws[gear].film()?;
        Some(Films { running: self.running?, ratio: film.ratio })
    }
}

/// Films of the mesh, with the λ that a law reads.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// k(p, λ) = k₀ p^(n−1) (1 + λ), n = 1.5, k₀ = 1e-12.
    struct Power;

    impl WearLaw for Power {
        const READS_CONDITIONS: bool = false;

        fn coefficient_mm2_per_n(&self, at: &LocalContact) -> f64 {
            1e-12 * at.pressure_mpa.sqrt() * (1.0 + at.lambda.unwrap_or_default())
        }
    }

    /// Wear that slows down above a limit, or goes on as it was, is not severe: steps of the same wear written otherwise are the same.
    #[test]
    fn only_faster_wear_is_severe() {
        for (factor, from_mpa) in [(0.5, None), (1.0, None), (2.0, Some(1950.0))] {
            let severe = Some(SevereTransition { above_mpa: 2000.0, factor, band_mpa: 100.0 });
            assert_eq!(WithFactors { law: Power, severe, film: None }.severe_from_mpa(), from_mpa, "{factor}");
        }
    }

    /// dh = k₀ pⁿ ds in closed form at every point, and with λ and the factor f(λ) of a film where there is one: f falls from 1 at λ = 0 to 0 at 2.
    #[test]
    fn ver_a_law_sees_pressure_and_film_of_its_own_point() {
        let (pressure, sliding, lambda) = ([100.0, 400.0, 900.0], [0.7, 0.5, 0.3], [0.0, 0.5, 1.0]);
        let row = SlidingRow {
            pressure_mpa: &pressure,
            sliding_mm: &sliding,
            conditions: None,
            lambda: None,
            is_continuous: false,
        };
        let film = FilmDependence { ratio: FilmRatio::Composite, lambda: vec![0.0, 2.0], factor: vec![1.0, 0.0] };
        let (dry, oiled) = (WithFactors::none(Power), WithFactors { law: Power, severe: None, film: Some(film) });
        let of_each = SlidingRow { lambda: Some(Lambda::OfEach(&lambda)), ..row };
        let of_all = SlidingRow { lambda: Some(Lambda::OfAll(0.5)), ..row };
        let cases: [(&WithFactors<Power>, SlidingRow<'_>, [f64; 3]); 3] =
            [(&dry, of_each, [0.0; 3]), (&oiled, of_each, lambda), (&oiled, of_all, [0.5; 3])];
        for (law, row, lambda) in cases {
            let mut depth = [0.0; 3];
            law.add_depth(&row, &mut depth);
            for point in 0..3 {
                let film = (1.0 + lambda[point]) * (1.0 - 0.5 * lambda[point]);
                let expected = 1e-12 * pressure[point].powf(1.5) * sliding[point] * film;
                assert!((depth[point] / expected - 1.0).abs() < 1e-14, "{point}: {} for {expected}", depth[point]);
            }
        }
    }
}
