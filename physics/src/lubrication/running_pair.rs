//! A pair of gears at a speed and under a load, with its oil: film and friction of every contact of its teeth.
//!
//! Each surface runs at ω ρ through the contact. Load and pressure of a film are those of the contact with the factors K_A K_V, as
//! ISO/TS 6336-22 has it for a contact analysis (Method A); its radius and speeds are the nominal ones, also where flanks are worn, and before A
//! and after E those of A and E. A contact narrower than under its load w on the nominal radius ρ_n, as at a tip edge, has the radius of
//! the cylinders that have this width under that load, and Hertz's pressure:
//!
//! ```text
//! ρ = ρ_n (a/a_n)²    p = κ_p p_H a_n/a    for a < a_n = κ_a a_H    that is, with κ = 1, ρ = π E_r a²/(8 w) and p = 2w/(π a)
//! ```
//!
//! a is the half-width of the contact, or where that is the greater the one of Hertz's ellipse with its greatest pressure, which at an edge grows
//! with every refinement, as the width does not. κ_a and κ_p are half-width and pressure of the surface over Hertz's a_H and p_H on the nominal
//! radius: 1 where the surface is elastic, other numbers for a Winkler foundation. Source: K. L. Johnson, *Contact Mechanics* (1985),
//! section 4.2.

use std::f64::consts::{PI, TAU};

use super::film::FilmParameters;
use super::friction::{self, MeanConditions};
use super::load_sharing_factor::SharingGeometry;
use super::local_film::{LocalFilm, bulk_temperature_c, local_film};
use super::loss;
use super::oil::Oil;
use super::rolling_contact::{RollingBodies, RollingContact};
use super::scuffing::helical_load_factor;
use super::settings::{FilmRatio, FrictionModel, LubricantSettings, LubricationSettings, Roughness};
use gearwear_bodies::gear::conjugate::ConjugateFlanks;
use gearwear_bodies::gear::{GearPair, PerGear};

/// W per N·mm/s.
const W_PER_N_MM_PER_S: f64 = 1e-3;

/// Number of places of the path over which friction is averaged.
const PLACES: usize = 200;

/// Load, speed and surfaces of a running pair.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunningConditions {
    /// Speed of the pinion, revolutions per minute.
    pub pinion_speed_rpm: f64,
    /// F_bt/b, N/mm.
    pub line_load_n_per_mm: f64,
    /// E_r of both materials, MPa.
    pub reduced_modulus_mpa: f64,
    /// κ_a and κ_p of the contact surface.
    pub surface: SurfaceOverHertz,
}

/// Ratios of a contact surface to Hertz's, on the same radius under the same load.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceOverHertz {
    /// κ_a, of the half-widths.
    pub half_width: f64,
    /// κ_p, of the greatest pressures.
    pub pressure: f64,
}

impl SurfaceOverHertz {
    /// An elastic surface.
    pub const ELASTIC: Self = Self { half_width: 1.0, pressure: 1.0 };
}

/// The pair with its oil.
#[derive(Debug, Clone)]
pub struct RunningPair<'a> {
    /// The gears.
    pub pair: &'a GearPair,
    /// Settings of the scene.
    pub settings: &'a LubricationSettings,
    /// ω of each gear, rad/s.
    pub angular_speed_per_s: PerGear<f64>,
    /// F_bt/b, N/mm.
    pub line_load_n_per_mm: f64,
    /// E_r and B_M.
    pub bodies: RollingBodies,
    /// κ_a and κ_p of the contact surface.
    pub surface: SurfaceOverHertz,
    /// Load sharing of Method B.
    pub sharing: SharingGeometry,
    /// Oil; none where the scene has only friction without oil.
    pub oil: Option<OilInMesh>,
}

/// The oil in the mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct OilInMesh {
    /// Settings of the scene.
    pub settings: LubricantSettings,
    /// The oil.
    pub oil: Oil,
    /// Conditions of mean values of friction.
    pub mean: MeanConditions,
    /// θ_M, °C.
    pub bulk_c: f64,
    /// State at the inlet of the mesh.
    at_inlet: OilState,
    /// State at the temperature of the teeth.
    at_teeth: OilState,
}

/// An oil at a temperature.
#[derive(Debug, Clone, Copy, PartialEq)]
struct OilState {
    /// η, mPa·s.
    viscosity_milli_pa_s: f64,
    /// α, 1/GPa.
    pressure_viscosity_per_gpa: f64,
}

/// Finish of the flanks.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Finish {
    /// New flanks.
    New,
    /// Run-in flanks.
    RunIn,
}

/// A contact of two teeth: place, load and pressure.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadedPlace {
    /// The pinion's radius of curvature, mm.
    pub position_mm: f64,
    /// Load, N per mm of face width.
    pub line_load_n_per_mm: f64,
    /// Greatest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half-width, mm.
    pub half_width_mm: f64,
}

/// Film of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ContactFilm {
    /// Thickness in the middle, with oil as it enters the mesh, µm.
    pub central_um: f64,
    /// Least thickness, with oil as it enters the mesh, µm.
    pub least_um: f64,
    /// Local film of ISO/TS 6336-22; none without pressure.
    pub local: Option<LocalFilm>,
    /// λ_GF: the local film over the mean Ra.
    pub lambda: Option<f64>,
    /// Least film with oil at the temperature of the teeth, over √(Rq₁² + Rq₂²).
    pub composite_lambda: f64,
}

impl<'a> RunningPair<'a> {
    /// `pair` under these conditions.
    pub fn new(pair: &'a GearPair, settings: &'a LubricationSettings, conditions: RunningConditions) -> Self {
        let pinion = TAU * conditions.pinion_speed_rpm / 60.0;
        let thermal = settings.lubricant.map(|lubricant| lubricant.thermal_contact_w_s05_per_m2_k);
        let dry = Self {
            pair,
            settings,
            angular_speed_per_s: PerGear { pinion, wheel: pinion * pair.wheel_turns_per_pinion_turn() },
            line_load_n_per_mm: conditions.line_load_n_per_mm,
            bodies: RollingBodies {
                reduced_modulus_mpa: conditions.reduced_modulus_mpa,
                thermal_contact_w_s05_per_m2_k: thermal.unwrap_or_default(),
            },
            surface: conditions.surface,
            sharing: SharingGeometry {
                points_mm: pair.path.points_mm(),
                overlap_ratio: pair.overlap_ratio(),
                base_helix_angle_rad: pair.base_helix_angle_rad(),
            },
            oil: None,
        };
        Self { oil: settings.lubricant.map(|lubricant| dry.oil(lubricant)), ..dry }
    }

    fn oil(&self, settings: LubricantSettings) -> OilInMesh {
        let oil = Oil::new(settings.oil);
        let at_pitch = self.contact(self.pair.path.pitch_point_mm, 0.0, 0.0);
        let factors = &self.settings.load_factors;
        let mean = MeanConditions {
            line_load_n_per_mm: self.line_load_n_per_mm,
            tangential_over_base: self.pair.spec.transverse_pressure_angle_rad().cos(),
            load_factor: factors.product(),
            helical_factor: helical_load_factor(self.sharing.contact_ratio() + self.sharing.overlap_ratio),
            application_factor: factors.application,
            sum_speed_m_per_s: at_pitch.sum_speed_m_per_s(),
            relative_radius_mm: at_pitch.relative_radius_mm,
            viscosity_milli_pa_s: oil.viscosity_milli_pa_s(settings.temperature_c),
            ra_um: 0.5 * settings.roughness.map(|roughness| roughness.ra_um).sum(),
            relative_run_in: settings.scuffing.relative_run_in,
            lubricant_factor: settings.lubricant_factor.unwrap_or_else(|| friction::lubricant_factor(oil.base())),
        };
        let loss_kw = 1e-3 * self.power_w() * mean.iso_6336_22() * loss::of_pair(self.pair);
        let spec = &self.pair.spec;
        let bulk_c = settings.bulk_temperature_c.unwrap_or_else(|| {
            let supply = settings.supply.factor();
            bulk_temperature_c(
                settings.temperature_c,
                loss_kw,
                spec.centre_distance_mm.abs(),
                spec.face_width_mm,
                supply,
            )
        });
        let [at_inlet, at_teeth] = [settings.temperature_c, bulk_c].map(|celsius| OilState::of(&oil, celsius));
        OilInMesh { settings, oil, mean, bulk_c, at_inlet, at_teeth }
    }

    /// P, W.
    pub fn power_w(&self) -> f64 {
        let base_radius = self.pair.path.involute.pinion.base_radius_mm;
        let force = self.line_load_n_per_mm * self.pair.spec.face_width_mm;
        W_PER_N_MM_PER_S * force * base_radius * self.angular_speed_per_s.pinion
    }

    /// Nominal contact at a place, with the load and pressure there.
    pub fn contact(&self, position_mm: f64, line_load_n_per_mm: f64, peak_pressure_mpa: f64) -> RollingContact {
        RollingContact {
            line_load_n_per_mm,
            relative_radius_mm: self.pair.normal_section().relative_radius_mm(position_mm),
            peak_pressure_mpa,
            surface_speeds_m_per_s: PerGear::from_fn(|gear| {
                let rho_mm = self.pair.path.involute[gear].signed(1.0) * self.pair.path.rho_mm(gear, position_mm);
                1e-3 * self.angular_speed_per_s[gear] * rho_mm
            }),
        }
    }

    /// Contact under `load_factor` times the load, on the radius of its own width where that is narrower than on the nominal radius.
    fn at(&self, place: &LoadedPlace, load_factor: f64) -> RollingContact {
        let path = &self.pair.path;
        let position_mm = place.position_mm.clamp(path.start_mm, path.end_mm);
        let grown = load_factor.sqrt();
        let nominal =
            self.contact(position_mm, load_factor * place.line_load_n_per_mm, grown * place.peak_pressure_mpa);
        let hertz_mpa = self.bodies.peak_pressure_mpa(&nominal);
        let hertz_mm = 2.0 * nominal.line_load_n_per_mm / (PI * hertz_mpa);
        let by_pressure = self.surface.pressure * hertz_mpa / nominal.peak_pressure_mpa;
        let by_extent = grown * place.half_width_mm / (self.surface.half_width * hertz_mm);
        let narrower = by_extent.max(by_pressure);
        if !(0.0..1.0).contains(&narrower) || narrower == 0.0 {
            return nominal;
        }
        RollingContact {
            relative_radius_mm: nominal.relative_radius_mm * narrower * narrower,
            peak_pressure_mpa: self.surface.pressure * hertz_mpa / narrower,
            ..nominal
        }
    }

    /// μ of a contact.
    pub fn friction(&self, place: &LoadedPlace) -> f64 {
        self.uniform_friction().unwrap_or_else(|| self.local_friction(&self.at(place, 1.0)))
    }

    /// μ of a model that is the same everywhere.
    fn uniform_friction(&self) -> Option<f64> {
        let friction = &self.settings.friction;
        match friction.model {
            FrictionModel::Constant => friction.coefficient,
            model => self.oil.as_ref()?.mean.mean(model),
        }
    }

    fn local_friction(&self, contact: &RollingContact) -> f64 {
        match (&self.settings.friction.table, &self.oil) {
            (Some(table), _) => table.at(contact),
            (None, Some(oil)) if self.settings.friction.model == FrictionModel::BenedictKelley => {
                friction::benedict_kelley(contact, oil.mean.viscosity_milli_pa_s, oil.mean.ra_um)
            }
            (None, Some(oil)) => {
                let roughness = oil.settings.roughness;
                let rq_um = roughness.pinion.rq_um.hypot(roughness.wheel.rq_um);
                friction::xu(contact, oil.mean.viscosity_milli_pa_s, rq_um)
            }
            (None, None) => 0.0,
        }
    }

    /// Mean of μ over the sliding work of the path; where μ is local, with the loads and pressures of Method B.
    pub fn mean_friction(&self) -> f64 {
        if let Some(uniform) = self.uniform_friction() {
            return uniform;
        }
        let (mut work, mut friction) = (0.0, 0.0);
        for position_mm in self.pair.path.evenly_mm(PLACES) {
            let line_load_n_per_mm = self.sharing.factor(position_mm) * self.line_load_n_per_mm;
            let contact = self.contact(position_mm, line_load_n_per_mm, 0.0);
            let peak_pressure_mpa = self.bodies.peak_pressure_mpa(&contact);
            let half_width_mm = 2.0 * line_load_n_per_mm / (PI * peak_pressure_mpa);
            let work_there = line_load_n_per_mm * contact.sliding_speed_m_per_s();
            let place = LoadedPlace { position_mm, line_load_n_per_mm, peak_pressure_mpa, half_width_mm };
            work += work_there;
            friction += work_there * self.friction(&place);
        }
        friction / work
    }

    /// Film of a contact between flanks with this coefficient of friction; none without oil or load.
    pub fn film(&self, place: &LoadedPlace, friction: f64, finish: Finish) -> Option<ContactFilm> {
        let (oil, contact) = self.lubricated(place)?;
        let film = self.smooth_film(&contact, oil.at_inlet);
        let local = local_film(&contact, &self.bodies, &oil.oil, oil.bulk_c, friction);
        Some(ContactFilm {
            central_um: film.central_um(oil.settings.central_film),
            least_um: film.least_um(),
            local,
            lambda: local.map(|local| oil.lambda(&local, finish)),
            composite_lambda: self.composite_lambda(oil, &contact, finish),
        })
    }

    /// λ of a loaded contact of run-in flanks, as a wear law reads it; none without oil or load.
    pub(crate) fn film_ratio(&self, place: &LoadedPlace, ratio: FilmRatio) -> Option<f64> {
        let (oil, contact) = self.lubricated(place)?;
        match ratio {
            FilmRatio::Iso633622 => {
                let local = local_film(&contact, &self.bodies, &oil.oil, oil.bulk_c, self.friction(place))?;
                Some(oil.lambda(&local, Finish::RunIn))
            }
            FilmRatio::Composite => Some(self.composite_lambda(oil, &contact, Finish::RunIn)),
        }
    }

    /// The oil and the contact with its load factors; none without oil or load.
    fn lubricated(&self, place: &LoadedPlace) -> Option<(&OilInMesh, RollingContact)> {
        let oil = self.oil.as_ref().filter(|_| place.line_load_n_per_mm > 0.0)?;
        let factors = &self.settings.load_factors;
        Some((oil, self.at(place, factors.application * factors.dynamic)))
    }

    fn smooth_film(&self, contact: &RollingContact, oil: OilState) -> FilmParameters {
        let OilState { viscosity_milli_pa_s, pressure_viscosity_per_gpa } = oil;
        FilmParameters::new(contact, self.bodies.reduced_modulus_mpa, viscosity_milli_pa_s, pressure_viscosity_per_gpa)
    }

    fn composite_lambda(&self, oil: &OilInMesh, contact: &RollingContact, finish: Finish) -> f64 {
        let [_, pinion] = oil.settings.roughness.pinion.of(finish);
        let [_, wheel] = oil.settings.roughness.wheel.of(finish);
        self.smooth_film(contact, oil.at_teeth).least_um() / pinion.hypot(wheel)
    }
}

impl OilInMesh {
    /// λ_GF.
    fn lambda(&self, local: &LocalFilm, finish: Finish) -> f64 {
        let ra_um = self.settings.roughness.map(|roughness| roughness.of(finish)[0]);
        local.thickness_um / (0.5 * ra_um.sum())
    }
}

impl OilState {
    fn of(oil: &Oil, temperature_c: f64) -> Self {
        Self {
            viscosity_milli_pa_s: oil.viscosity_milli_pa_s(temperature_c),
            pressure_viscosity_per_gpa: oil.pressure_viscosity_per_gpa(temperature_c),
        }
    }
}

impl Roughness {
    /// Ra and Rq, µm; Rq falls with Ra.
    fn of(&self, finish: Finish) -> [f64; 2] {
        match finish {
            Finish::New => [self.ra_um, self.rq_um],
            Finish::RunIn => [self.run_in_ra_um, self.rq_um * self.run_in_ra_um / self.ra_um],
        }
    }
}
