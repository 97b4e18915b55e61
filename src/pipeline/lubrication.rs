//! Films, friction and losses of the new and of the worn pair, from the loads and pressures of the run.
//!
//! With x the pinion's radius of curvature at the contact point of a slice, w its load per mm of face width, v_g its sliding speed and n slices,
//!
//! ```text
//! P_VZ = 1/p_bt ∫ b/n Σ μ w v_g dx        H_VL = 1/p_bt ∫ b/n Σ w v_g dx / P
//! ```
//!
//! Each surface runs at ω ρ through the contact. Load and pressure of a film are those of the contact with the factors K_A K_V, as the standard
//! has it for a contact analysis (Method A); its radius and speeds are the nominal ones, also where flanks are worn.

use std::f64::consts::{PI, TAU};

use super::{Model, scuffing};
use crate::contact::settings::SurfaceKind;
use crate::gear::conjugate::ConjugateFlanks;
use crate::gear::{Gear, GearPair, PerGear};
use crate::lubrication::film::FilmParameters;
use crate::lubrication::friction::{self, MeanConditions};
use crate::lubrication::load_sharing_factor::SharingGeometry;
use crate::lubrication::local_film::{LocalFilm, bulk_temperature_c, local_film};
use crate::lubrication::loss;
use crate::lubrication::oil::Oil;
use crate::lubrication::rolling_contact::{Bodies, RollingContact};
use crate::lubrication::scuffing::helical_load_factor;
use crate::lubrication::settings::{FrictionModel, FrictionSettings, LubricantSettings, LubricationSettings};
use crate::reference::hertz_line::contact_modulus_mpa;
use crate::results::lubrication::{
    AlongPath, FilmRow, FilmSummary, FrictionSummary, LossSummary, LubricationSummary, MethodBPoint, MethodBSummary,
    OilSummary,
};
use crate::simulation::wear_run::Outcome;

/// W per N·mm/s.
const W_PER_N_MM_PER_S: f64 = 1e-3;

/// What is found, as the record has it.
pub(super) struct Observed {
    pub summary: LubricationSummary,
    pub rows: Vec<FilmRow>,
}

/// The pair at the speed of the reference phase.
pub(super) struct Running<'a> {
    pub pair: &'a GearPair,
    pub settings: LubricationSettings,
    /// ω of each gear, rad/s.
    pub angular_speed_per_s: PerGear<f64>,
    /// F_bt/b, N/mm.
    pub line_load_n_per_mm: f64,
    /// E_r and B_M.
    pub bodies: Bodies,
    pub sharing: SharingGeometry,
}

/// The oil in the mesh.
pub(super) struct OilInMesh {
    pub settings: LubricantSettings,
    pub oil: Oil,
    /// For mean values of friction.
    pub mean: MeanConditions,
    /// θ_M, °C.
    pub bulk_c: f64,
}

/// A contact of the run.
#[derive(Clone, Copy)]
struct Place {
    position_mm: f64,
    slice: usize,
    width_mm: f64,
    /// Length of the path that it stands for.
    length_mm: f64,
    load_n_per_mm: [f64; 2],
    pressure_mpa: [f64; 2],
}

/// One contact, new or worn.
#[derive(Clone, Copy)]
struct State {
    friction: f64,
    central_um: Option<f64>,
    least_um: Option<f64>,
    local: Option<LocalFilm>,
    lambda: Option<f64>,
}

impl<'a> Running<'a> {
    fn new(model: &Model<'a>, outcome: &Outcome, settings: LubricationSettings) -> Option<Self> {
        let pair = model.pair;
        let rpm = model.scene.operation.phases[outcome.reference_phase].pinion_speed_rpm?;
        let pinion = TAU * rpm / 60.0;
        let elastic = Gear::BOTH.map(|gear| model.scene.material[gear]);
        let modulus = contact_modulus_mpa(elastic.map(|body| (body.young_modulus_mpa, body.poisson_ratio)));
        let thermal = settings.lubricant.map(|lubricant| lubricant.thermal_contact_w_s05_per_m2_k);
        Some(Self {
            pair,
            settings,
            angular_speed_per_s: PerGear { pinion, wheel: pinion * pair.wheel_turns_per_pinion_turn() },
            line_load_n_per_mm: model.reference().line_load_n_per_mm,
            bodies: Bodies {
                reduced_modulus_mpa: 2.0 * modulus,
                thermal_contact_w_s05_per_m2_k: thermal.unwrap_or_default(),
            },
            sharing: SharingGeometry {
                points_mm: pair.path.points_mm(),
                overlap_ratio: pair.overlap_ratio(),
                base_helix_angle_rad: pair.base_helix_angle_rad(),
            },
        })
    }

    /// P, W.
    fn power_w(&self) -> f64 {
        let base_radius = self.pair.path.involute.pinion.base_radius_mm;
        let force = self.line_load_n_per_mm * self.pair.spec.face_width_mm;
        W_PER_N_MM_PER_S * force * base_radius * self.angular_speed_per_s.pinion
    }

    /// Surfaces at a place, with the load and pressure there.
    pub(super) fn contact(&self, position_mm: f64, line_load_n_per_mm: f64, peak_pressure_mpa: f64) -> RollingContact {
        RollingContact {
            line_load_n_per_mm,
            relative_radius_mm: self.pair.relative_radius_mm(position_mm) / self.pair.base_helix_angle_rad().cos(),
            peak_pressure_mpa,
            surface_speeds_m_per_s: PerGear::from_fn(|gear| {
                1e-3 * self.angular_speed_per_s[gear] * self.pair.path.rho_mm(gear, position_mm)
            }),
        }
    }

    fn oil(&self) -> Option<OilInMesh> {
        let settings = self.settings.lubricant?;
        let oil = Oil::new(settings.oil);
        let at_pitch = self.contact(self.pair.path.pitch_point_mm, 0.0, 0.0);
        let factors = &self.settings.load_factors;
        let usual = || friction::lubricant_factor(oil.base());
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
            lubricant_factor: settings.lubricant_factor.unwrap_or_else(usual),
        };
        let loss_kw = 1e-3 * self.power_w() * mean.iso_6336_22() * loss::of_pair(self.pair);
        let spec = &self.pair.spec;
        let of_standard = || {
            let supply = settings.supply.factor();
            bulk_temperature_c(settings.temperature_c, loss_kw, spec.centre_distance_mm, spec.face_width_mm, supply)
        };
        let bulk_c = settings.bulk_temperature_c.unwrap_or_else(of_standard);
        Some(OilInMesh { settings, oil, mean, bulk_c })
    }

    /// μ of a contact.
    fn friction(&self, oil: Option<&OilInMesh>, contact: &RollingContact) -> f64 {
        let FrictionSettings { model, coefficient } = self.settings.friction;
        let coefficient = coefficient.unwrap_or_default();
        let Some(oil) = oil else { return coefficient };
        let roughness = oil.settings.roughness;
        let viscosity = oil.mean.viscosity_milli_pa_s;
        match (oil.mean.mean(model), model) {
            (Some(mean), _) => mean,
            (None, FrictionModel::BenedictKelley) => friction::benedict_kelley(contact, viscosity, oil.mean.ra_um),
            (None, FrictionModel::Xu) => {
                let rq_um = roughness.pinion.rq_um.hypot(roughness.wheel.rq_um);
                friction::xu(contact, viscosity, rq_um)
            }
            (None, _) => coefficient,
        }
    }

    /// A contact of the run, new (0) or worn (1); none without load.
    fn state(&self, oil: Option<&OilInMesh>, place: &Place, which: usize) -> Option<State> {
        let load = place.load_n_per_mm[which];
        if load <= 0.0 {
            return None;
        }
        let factors = &self.settings.load_factors;
        let dynamic = factors.application * factors.dynamic;
        let nominal = self.contact(place.position_mm, load, place.pressure_mpa[which]);
        let friction = self.friction(oil, &nominal);
        let contact = self.contact(place.position_mm, dynamic * load, dynamic.sqrt() * place.pressure_mpa[which]);
        let Some(oil) = oil else {
            return Some(State { friction, central_um: None, least_um: None, local: None, lambda: None });
        };
        let inlet_c = oil.settings.temperature_c;
        let film = FilmParameters::new(
            &contact,
            self.bodies.reduced_modulus_mpa,
            oil.oil.viscosity_milli_pa_s(inlet_c),
            oil.oil.pressure_viscosity_per_gpa(inlet_c),
        );
        let local = local_film(&contact, &self.bodies, &oil.oil, oil.bulk_c, friction);
        let ra = |gear: Gear| {
            let roughness = oil.settings.roughness[gear];
            [roughness.ra_um, roughness.run_in_ra_um][which]
        };
        let ra_um = 0.5 * (ra(Gear::Pinion) + ra(Gear::Wheel));
        Some(State {
            friction,
            central_um: Some(film.central_um(oil.settings.central_film)),
            least_um: Some(film.least_um()),
            lambda: local.map(|local| local.thickness_um / ra_um),
            local,
        })
    }

    fn method_b(&self, oil: &OilInMesh) -> MethodBSummary {
        let [a, b, c, d, e] = self.pair.path.points_mm();
        let mean_friction = oil.mean.iso_6336_22();
        let named = [("A", a), ("AB", 0.5 * (a + b)), ("B", b), ("C", c), ("D", d), ("DE", 0.5 * (d + e)), ("E", e)];
        let points: Vec<MethodBPoint> = named
            .into_iter()
            .map(|(name, position_mm)| {
                let load_sharing_factor = self.sharing.factor(position_mm);
                let load = load_sharing_factor * self.line_load_n_per_mm;
                let radius = self.contact(position_mm, load, 0.0).relative_radius_mm;
                let nominal_pressure_mpa = (self.bodies.reduced_modulus_mpa * load / (2.0 * PI * radius)).sqrt();
                let pressure_mpa = nominal_pressure_mpa * self.settings.load_factors.product().sqrt();
                let contact = self.contact(position_mm, load, pressure_mpa);
                let local = local_film(&contact, &self.bodies, &oil.oil, oil.bulk_c, mean_friction);
                let (flash_k, film_um) = local.map_or((0.0, 0.0), |local| (local.flash_k, local.thickness_um));
                MethodBPoint {
                    name: name.to_owned(),
                    position_mm,
                    load_sharing_factor,
                    relative_radius_mm: radius,
                    nominal_pressure_MPa: nominal_pressure_mpa,
                    pressure_MPa: pressure_mpa,
                    contact_temperature_C: oil.bulk_c + flash_k,
                    film_um,
                    lambda: film_um / oil.mean.ra_um,
                }
            })
            .collect();
        let least = points.iter().min_by(|one, two| one.lambda.total_cmp(&two.lambda));
        let (least_lambda_at, least_lambda) =
            least.map_or((String::new(), 0.0), |point| (point.name.clone(), point.lambda));
        let micropitting_safety = oil.settings.permissible_lambda.map(|permissible| least_lambda / permissible);
        MethodBSummary { points, mean_friction, least_lambda_at, least_lambda, micropitting_safety }
    }
}

/// All contacts of the run's mesh, new and worn, within the line of action.
fn places(model: &Model<'_>, outcome: &Outcome) -> Vec<Place> {
    let (new, worn) = (&outcome.new.cycle, &outcome.worn.cycle);
    // The simplified surface has the mean pressure for the greatest.
    let greatest = if model.scene.contact.surface == SurfaceKind::HertzMean { 4.0 / PI } else { 1.0 };
    let whole = model.reference().line_load_n_per_mm;
    let middle_mm = 0.5 * model.pair.spec.face_width_mm;
    let Some([new_slices, worn_slices]) = new.slices.as_ref().zip(worn.slices.as_ref()).map(<[_; 2]>::from) else {
        let last = new.positions.len().saturating_sub(1);
        let at = |k: usize| new.positions[k].position_mm;
        return new
            .positions
            .iter()
            .zip(&worn.positions)
            .enumerate()
            .map(|(k, (new, worn))| Place {
                position_mm: new.position_mm,
                slice: 0,
                width_mm: middle_mm,
                length_mm: 0.5 * (at((k + 1).min(last)) - at(k.saturating_sub(1))),
                load_n_per_mm: [new.load_share * whole, worn.load_share * whole],
                pressure_mpa: [new, worn].map(|seen| greatest * seen.footprint.peak_pressure_mpa),
            })
            .collect();
    };
    let count = new_slices.slices;
    let spacing = new_slices.base_pitch_mm / new_slices.transmission_error_mm.len() as f64;
    let cells = new_slices.position_mm.iter().enumerate();
    let all = cells.flat_map(|(row, &position_mm)| {
        (0..count).map(move |slice| {
            let cell = row * count + slice;
            let meshes = [new_slices, worn_slices];
            Place {
                position_mm: position_mm + outcome.slices.ahead_mm[slice],
                slice,
                width_mm: outcome.slices.width_mm[slice],
                length_mm: spacing,
                load_n_per_mm: meshes.map(|mesh| mesh.line_load_n_per_mm[cell]),
                pressure_mpa: meshes.map(|mesh| greatest * mesh.peak_pressure_mpa[cell]),
            }
        })
    });
    let path = &model.pair.path;
    all.filter(|place| (path.start_mm..=path.end_mm).contains(&place.position_mm)).collect()
}

/// Sums over the path, new and worn.
#[derive(Default)]
struct Work {
    sliding_w: [f64; 2],
    friction_w: [f64; 2],
}

/// What is seen of the contacts of a run.
pub(super) struct Seen<'a> {
    running: Running<'a>,
    oil: Option<OilInMesh>,
    places: Vec<Place>,
    /// New and worn at each place.
    states: Vec<[Option<State>; 2]>,
}

/// Looks at both states of a run; none where nobody asks.
pub(super) fn look<'a>(model: &Model<'a>, outcome: &Outcome) -> Option<Seen<'a>> {
    let running = Running::new(model, outcome, model.scene.lubrication?)?;
    let oil = running.oil();
    let places = places(model, outcome);
    let states = places.iter().map(|place| [0, 1].map(|which| running.state(oil.as_ref(), place, which))).collect();
    Some(Seen { running, oil, places, states })
}

/// Sums up what was seen.
pub(super) fn sum_up(model: &Model<'_>, outcome: &Outcome, seen: &Seen<'_>) -> Observed {
    let Seen { running, oil, places, states } = seen;
    let slices = outcome.slices.count().max(1) as f64;
    let width_mm = model.pair.spec.face_width_mm / slices;
    let mut work = Work::default();
    for (place, states) in places.iter().zip(states) {
        let sliding_m_per_s = running.contact(place.position_mm, 0.0, 0.0).sliding_speed_m_per_s();
        for (which, state) in states.iter().enumerate() {
            let power_w = place.load_n_per_mm[which] * width_mm * sliding_m_per_s * place.length_mm
                / model.pair.path.base_pitch_mm;
            work.sliding_w[which] += power_w;
            work.friction_w[which] += power_w * state.map_or(0.0, |state| state.friction);
        }
    }
    let rows: Vec<FilmRow> = places.iter().zip(states).map(|(place, states)| row(running, place, states)).collect();
    let summary = LubricationSummary {
        oil: oil.as_ref().map(oil_summary),
        film: oil.as_ref().and_then(|oil| film_summary(&rows, places, oil.settings.permissible_lambda)),
        method_b: oil.as_ref().map(|oil| running.method_b(oil)),
        scuffing: oil.as_ref().map(|oil| scuffing::summary(running, oil, &model.scene.material)),
        friction: friction_summary(running, &work),
        losses: losses(running, &work),
    };
    Observed { summary, rows }
}

fn row(running: &Running<'_>, place: &Place, states: &[Option<State>; 2]) -> FilmRow {
    let surfaces = running.contact(place.position_mm, 0.0, 0.0);
    let of = |value: fn(&State) -> Option<f64>| states.map(|state| state.as_ref().and_then(value));
    let [central_film_new_um, central_film_worn_um] = of(|state| state.central_um);
    let [minimum_film_new_um, minimum_film_worn_um] = of(|state| state.least_um);
    let [local_film_new_um, local_film_worn_um] = of(|state| state.local.map(|local| local.thickness_um));
    let [lambda_new, lambda_worn] = of(|state| state.lambda);
    let [flash_new_k, flash_worn_k] = of(|state| state.local.map(|local| local.flash_k));
    let [friction_new, friction_worn] = of(|state| Some(state.friction));
    FilmRow {
        position_mm: place.position_mm,
        slice: place.slice,
        width_mm: place.width_mm,
        relative_radius_mm: surfaces.relative_radius_mm,
        sum_speed_m_per_s: surfaces.sum_speed_m_per_s(),
        sliding_speed_m_per_s: surfaces.sliding_speed_m_per_s(),
        line_load_new_N_per_mm: place.load_n_per_mm[0],
        line_load_worn_N_per_mm: place.load_n_per_mm[1],
        central_film_new_um,
        central_film_worn_um,
        minimum_film_new_um,
        minimum_film_worn_um,
        local_film_new_um,
        local_film_worn_um,
        lambda_new,
        lambda_worn,
        flash_new_K: flash_new_k,
        flash_worn_K: flash_worn_k,
        friction_new,
        friction_worn,
    }
}

fn oil_summary(in_mesh: &OilInMesh) -> OilSummary {
    let (oil, at) = (&in_mesh.oil, in_mesh.settings.temperature_c);
    OilSummary {
        temperature_C: at,
        kinematic_viscosity_mm2_per_s: oil.kinematic_viscosity_mm2_per_s(at),
        density_kg_per_m3: oil.density_kg_per_m3(at),
        dynamic_viscosity_mPas: oil.viscosity_milli_pa_s(at),
        pressure_viscosity_per_GPa: oil.pressure_viscosity_per_gpa(at),
        bulk_temperature_C: in_mesh.bulk_c,
        dynamic_viscosity_at_bulk_mPas: oil.viscosity_milli_pa_s(in_mesh.bulk_c),
    }
}

type Value = fn(&FilmRow) -> Option<f64>;

/// Extremes and mean of a column, where it has values.
fn along_path(rows: &[FilmRow], places: &[Place], value: Value) -> Option<AlongPath> {
    let values = || rows.iter().zip(places).filter_map(|(row, place)| Some((value(row)?, place.length_mm)));
    let (total, length) = values().fold((0.0, 0.0), |(sum, length), (value, part)| (sum + value * part, length + part));
    let extremes =
        values().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (value, _)| (low.min(value), high.max(value)));
    (length > 0.0).then(|| AlongPath { min: extremes.0, max: extremes.1, mean: total / length })
}

fn film_summary(rows: &[FilmRow], places: &[Place], permissible_lambda: Option<f64>) -> Option<FilmSummary> {
    let along = |value: Value| along_path(rows, places, value);
    let place_of_least = |value: Value| {
        let least = rows.iter().filter(|row| value(row).is_some());
        let least = least.min_by(|one, two| value(one).partial_cmp(&value(two)).unwrap_or(std::cmp::Ordering::Equal));
        least.map(|row| row.position_mm)
    };
    let (lambda_new, lambda_worn) = (along(|row| row.lambda_new)?, along(|row| row.lambda_worn)?);
    let safety = |lambda: AlongPath| permissible_lambda.map(|permissible| lambda.min / permissible);
    Some(FilmSummary {
        central_film_new_um: along(|row| row.central_film_new_um)?,
        central_film_worn_um: along(|row| row.central_film_worn_um)?,
        minimum_film_new_um: along(|row| row.minimum_film_new_um)?,
        minimum_film_worn_um: along(|row| row.minimum_film_worn_um)?,
        lambda_new,
        lambda_worn,
        least_lambda_new_position_mm: place_of_least(|row| row.lambda_new)?,
        least_lambda_worn_position_mm: place_of_least(|row| row.lambda_worn)?,
        micropitting_safety_new: safety(lambda_new),
        micropitting_safety_worn: safety(lambda_worn),
        greatest_flash_new_K: along(|row| row.flash_new_K)?.max,
        greatest_flash_worn_K: along(|row| row.flash_worn_K)?.max,
    })
}

fn friction_summary(running: &Running<'_>, work: &Work) -> FrictionSummary {
    let [mean_new, mean_worn] = [0, 1]
        .map(|which| if work.sliding_w[which] > 0.0 { work.friction_w[which] / work.sliding_w[which] } else { 0.0 });
    FrictionSummary { model: running.settings.friction.model.name().to_owned(), mean_new, mean_worn }
}

fn losses(running: &Running<'_>, work: &Work) -> LossSummary {
    let power = running.power_w();
    LossSummary {
        loss_factor_ohlendorf: loss::of_pair(running.pair),
        loss_factor_local_new: work.sliding_w[0] / power,
        loss_factor_local_worn: work.sliding_w[1] / power,
        power_W: power,
        mesh_power_loss_new_W: work.friction_w[0],
        mesh_power_loss_worn_W: work.friction_w[1],
        efficiency_new: 1.0 - work.friction_w[0] / power,
        efficiency_worn: 1.0 - work.friction_w[1] / power,
    }
}
