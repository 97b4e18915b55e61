//! Films, friction and losses of the new and of the worn pair, from the loads and pressures of the run.
//!
//! With x the pinion's radius of curvature at the contact point of a slice, w its transverse load per mm of face width, v_g its sliding speed and
//! n slices, the normal force is w/cos β_b ([`gearwear_bodies::gear::normal_section`]) and
//!
//! ```text
//! P_VZ = 1/p_bt ∫ b/n Σ μ w v_g/cos β_b dx        H_VL = 1/p_bt ∫ b/n Σ w v_g/cos β_b dx / P
//! ```
//!
//! over all contacts of slices, also those of tip edges before A and after E.
//!
//! Film and friction of each contact are those of [`crate::lubrication::running_pair`].

use std::f64::consts::PI;

use super::scuffing::{self, NO_SHARING_FACTOR};
use super::{RunModel, slices};
use crate::contact::settings::SurfaceKind;
use crate::lubrication::local_film::local_film;
use crate::lubrication::loss;
use crate::lubrication::running_pair::{ContactFilm, Finish, LoadedPlace, OilInMesh, RunningPair};
use crate::mesh_cycle::sliced_mesh::SlicedMesh;
use crate::results::lubrication::{
    AlongPath, FilmRow, FilmSummary, FrictionSummary, LossSummary, LubricationSummary, MethodBPoint, MethodBSummary,
    OilSummary,
};
use crate::simulation::wear_run::Outcome;
use gearwear_bodies::gear::{Gear, PerGear, flank_zones::FlankZone};
use gearwear_bodies::reference::hertz_line::PEAK_OVER_MEAN;

/// Summary and rows of the record.
pub(super) struct LubricationFindings {
    pub summary: LubricationSummary,
    pub rows: Vec<FilmRow>,
}

/// Contact of the run at one position, of one slice.
#[derive(Clone, Copy)]
struct LubricatedContact {
    position_mm: f64,
    slice: usize,
    width_mm: f64,
    /// Length of the path of contact that it represents.
    length_mm: f64,
    /// Part of the width of its slice that is in contact.
    part_of_width: f64,
    /// Transverse load over the whole width of its slice.
    load_n_per_mm: [f64; 2],
    pressure_mpa: [f64; 2],
    half_width_mm: [f64; 2],
}

/// Film and friction of a contact, new or worn.
#[derive(Clone, Copy)]
struct FilmState {
    friction: f64,
    film: Option<ContactFilm>,
}

impl LubricatedContact {
    fn loaded(&self, which: usize) -> LoadedPlace {
        LoadedPlace {
            position_mm: self.position_mm,
            line_load_n_per_mm: self.load_n_per_mm[which] / self.part_of_width,
            peak_pressure_mpa: self.pressure_mpa[which],
            half_width_mm: self.half_width_mm[which],
        }
    }

    /// Film and friction in the new (0) or worn (1) pair; none without load.
    fn film_state(&self, running: &RunningPair<'_>, which: usize) -> Option<FilmState> {
        let loaded = self.loaded(which);
        (loaded.line_load_n_per_mm > 0.0).then(|| {
            let friction = running.friction(&loaded);
            FilmState { friction, film: running.film(&loaded, friction, [Finish::New, Finish::RunIn][which]) }
        })
    }
}

fn method_b(running: &RunningPair<'_>, oil: &OilInMesh) -> MethodBSummary {
    let [a, b, c, d, e] = running.pair.path.points_mm();
    let mean_friction = oil.mean.iso_6336_22();
    let named = [("A", a), ("AB", 0.5 * (a + b)), ("B", b), ("C", c), ("D", d), ("DE", 0.5 * (d + e)), ("E", e)];
    let points: Vec<MethodBPoint> = named
        .into_iter()
        .map(|(name, position_mm)| {
            let load_sharing_factor = running.sharing.factor(position_mm);
            let load = load_sharing_factor * running.line_load_n_per_mm;
            let unpressed = running.contact(position_mm, load, 0.0);
            let nominal_pressure_mpa = running.bodies.peak_pressure_mpa(&unpressed);
            let pressure_mpa = nominal_pressure_mpa * running.settings.load_factors.product().sqrt();
            let contact = running.contact(position_mm, load, pressure_mpa);
            let pressed = load * running.settings.load_factors.product();
            let local = local_film(&contact, &running.bodies, &oil.oil, oil.bulk_c, mean_friction);
            let (flash_k, film_um) = local.map_or((0.0, 0.0), |local| (local.flash_k, local.thickness_um));
            MethodBPoint {
                name: name.to_owned(),
                position_mm,
                load_sharing_factor,
                relative_radius_mm: unpressed.relative_radius_mm,
                nominal_pressure_MPa: nominal_pressure_mpa,
                pressure_MPa: pressure_mpa,
                // p = 2 w/(π a).
                half_width_mm: 2.0 * pressed / (PI * pressure_mpa),
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

/// All contacts of the run's mesh, new and worn; of a pair without slices, those within the line of action.
fn contacts(model: &RunModel<'_>, outcome: &Outcome) -> Vec<LubricatedContact> {
    // The simplified surface reports its mean pressure as the greatest.
    let greatest = if model.scene.contact.surface == SurfaceKind::HertzMean { PEAK_OVER_MEAN } else { 1.0 };
    match slices::meshes(outcome) {
        Some(meshes) => contacts_of_slices(model, outcome, &meshes, greatest),
        None => contacts_of_pair(model, outcome, greatest),
    }
}

/// Contacts of a pair without slices at the positions of its mesh cycle.
fn contacts_of_pair(model: &RunModel<'_>, outcome: &Outcome, greatest: f64) -> Vec<LubricatedContact> {
    let (new, worn) = (&outcome.new.cycle.positions, &outcome.worn.cycle.positions);
    let whole = model.reference().line_load_n_per_mm;
    let last = new.len().saturating_sub(1);
    let pairs = new.iter().zip(worn).enumerate();
    pairs
        .map(|(k, (one, other))| LubricatedContact {
            position_mm: one.position_mm,
            slice: 0,
            width_mm: 0.5 * model.pair.spec.face_width_mm,
            length_mm: 0.5 * (new[(k + 1).min(last)].position_mm - new[k.saturating_sub(1)].position_mm),
            part_of_width: 1.0,
            load_n_per_mm: [one.load_share * whole, other.load_share * whole],
            pressure_mpa: [one, other].map(|state| greatest * state.footprint.peak_pressure_mpa),
            half_width_mm: [one, other].map(|state| state.footprint.half_width_mm),
        })
        .collect()
}

/// Contacts of all slices of one tooth, from the new and the worn mesh.
fn contacts_of_slices(
    model: &RunModel<'_>,
    outcome: &Outcome,
    meshes: &[SlicedMesh; 2],
    greatest: f64,
) -> Vec<LubricatedContact> {
    let [new, worn] = meshes;
    let length_mm = new.base_pitch_mm / new.transmission_error_mm.len() as f64;
    let tip_contact = model.scene.contact.tip_contact;
    let mut contacts = Vec::new();
    for (row, &position_mm) in new.position_mm.iter().enumerate() {
        for slice in 0..new.slices {
            let cell = row * new.slices + slice;
            let part_of_width = f64::max(0.0, new.part_of_width[cell]).max(worn.part_of_width[cell]);
            if part_of_width <= 0.0 {
                continue;
            }
            let middle_mm = position_mm + outcome.slices.ahead_mm[slice];
            contacts.push(LubricatedContact {
                // A slice may be in contact where its middle is not.
                position_mm: if tip_contact { middle_mm } else { model.pair.path.folded_mm(middle_mm) },
                slice,
                width_mm: outcome.slices.width_mm[slice],
                length_mm,
                part_of_width,
                load_n_per_mm: meshes.each_ref().map(|mesh| mesh.line_load_n_per_mm[cell]),
                pressure_mpa: meshes.each_ref().map(|mesh| greatest * mesh.peak_pressure_mpa[cell]),
                half_width_mm: meshes.each_ref().map(|mesh| mesh.half_width_mm[cell]),
            });
        }
    }
    contacts
}

/// Power of the sliding, summed over the path of contact.
#[derive(Default)]
struct SlidingWork {
    sliding_w: f64,
    friction_w: f64,
    /// Sliding power between A and E.
    on_path_w: f64,
    /// Part of it that wears each gear under its films; none where its law reads none.
    wearing_w: PerGear<Option<f64>>,
}

impl SlidingWork {
    /// Power in the new (0) or worn (1) pair.
    fn over(model: &RunModel<'_>, contacts: &ObservedContacts<'_>, slice_width_mm: f64, which: usize) -> Self {
        let mut work = Self::default();
        let obliquity = model.pair.obliquity();
        for (place, states) in contacts.places.iter().zip(&contacts.states) {
            let sliding_m_per_s = contacts.running.contact(place.position_mm, 0.0, 0.0).sliding_speed_m_per_s();
            let force_n = obliquity.normal_force(place.load_n_per_mm[which]) * slice_width_mm;
            let power_w = force_n * sliding_m_per_s * place.length_mm / model.pair.path.base_pitch_mm;
            work.sliding_w += power_w;
            let Some(state) = states[which] else { continue };
            work.friction_w += power_w * state.friction;
            if !contacts.is_on_path(place) {
                continue;
            }
            work.on_path_w += power_w;
            for gear in Gear::BOTH {
                if let Some(factor) = model.reference().wear.film_factor(gear, &place.loaded(which)) {
                    *work.wearing_w[gear].get_or_insert(0.0) += power_w * factor;
                }
            }
        }
        work
    }

    /// Mean factor of the film on the wear of each gear; none where neither law reads films.
    fn wear_factors(&self) -> Option<PerGear<f64>> {
        let reads = self.on_path_w > 0.0 && Gear::BOTH.into_iter().any(|gear| self.wearing_w[gear].is_some());
        reads.then(|| self.wearing_w.map(|wearing_w| wearing_w.map_or(1.0, |wearing| wearing / self.on_path_w)))
    }

    /// μ, the mean over the sliding.
    fn mean_friction(&self) -> f64 {
        if self.sliding_w > 0.0 { self.friction_w / self.sliding_w } else { 0.0 }
    }
}

/// Contacts of a run with their films.
pub(super) struct ObservedContacts<'a> {
    running: &'a RunningPair<'a>,
    places: Vec<LubricatedContact>,
    /// New and worn state of each contact.
    states: Vec<[Option<FilmState>; 2]>,
}

impl ObservedContacts<'_> {
    /// Whether a contact lies between A and E.
    fn is_on_path(&self, place: &LubricatedContact) -> bool {
        let path = &self.running.pair.path;
        (path.start_mm..=path.end_mm).contains(&place.position_mm)
    }
}

/// Observes the new and the worn pair; none of a scene without films and losses.
pub(super) fn observe<'a>(model: &RunModel<'a>, outcome: &Outcome) -> Option<ObservedContacts<'a>> {
    let running = model.phases[outcome.reference_phase].wear.running?;
    let places = contacts(model, outcome);
    let states = places.iter().map(|place| [0, 1].map(|which| place.film_state(running, which))).collect();
    Some(ObservedContacts { running, places, states })
}

/// Sums up the films, friction and losses of all contacts.
pub(super) fn sum_up(model: &RunModel<'_>, outcome: &Outcome, contacts: &ObservedContacts<'_>) -> LubricationFindings {
    let ObservedContacts { running, places, states } = contacts;
    let oil = running.oil.as_ref();
    let has_factor = running.sharing.is_of_standard();
    let slices = outcome.slices.count().max(1) as f64;
    let width_mm = model.pair.spec.face_width_mm / slices;
    let work = [0, 1].map(|which| SlidingWork::over(model, contacts, width_mm, which));
    let rows: Vec<FilmRow> = places.iter().zip(states).map(|(place, states)| row(running, place, states)).collect();
    let is_between = between_tip_edges(model);
    let placed = rows.iter().zip(places);
    let films = FilmRows {
        between: placed
            .clone()
            .filter(|(_, place)| is_between(place) && contacts.is_on_path(place))
            .map(|(row, place)| (row, place.length_mm))
            .collect(),
        at_tip_edges: placed.filter(|(_, place)| !is_between(place)).map(|(row, _)| row).collect(),
    };
    let summary = LubricationSummary {
        oil: oil.map(oil_summary),
        film: oil.and_then(|oil| films.summary(oil.settings.permissible_lambda, &work)),
        method_b: oil.filter(|_| has_factor).map(|oil| method_b(running, oil)),
        method_b_null_because: oil.filter(|_| !has_factor).map(|_| NO_SHARING_FACTOR.to_owned()),
        scuffing: oil.map(|oil| scuffing::summary(running, oil, &model.scene.material)),
        friction: friction_summary(running, &work),
        losses: losses(running, &work),
    };
    LubricationFindings { summary, rows }
}

/// Warns where the contact is too hot for the fits of the oil.
pub(super) fn warning(summary: &LubricationSummary) -> Option<String> {
    let film = summary.film.as_ref()?;
    let states = [("new", film.lambda_new.min), ("worn", film.lambda_worn.min)];
    let without: Vec<&str> = states.into_iter().filter(|(_, least)| *least <= 0.0).map(|(state, _)| state).collect();
    (!without.is_empty()).then(|| {
        format!(
            "the least λ by ISO/TS 6336-22 is 0 ({}): flash temperatures of up to {:.0} K are beyond what its fits of the oil hold for (the \
             pressure–viscosity coefficient ends at 510 °C); λ and the safety against micropitting are of no use there",
            without.join(", "),
            film.greatest_flash_new_K.max(film.greatest_flash_worn_K)
        )
    })
}

fn row(running: &RunningPair<'_>, place: &LubricatedContact, states: &[Option<FilmState>; 2]) -> FilmRow {
    let surfaces = running.contact(place.position_mm, 0.0, 0.0);
    let films = states.map(|state| state?.film);
    let [central_film_new_um, central_film_worn_um] = films.map(|film| Some(film?.central_um));
    let [minimum_film_new_um, minimum_film_worn_um] = films.map(|film| Some(film?.least_um));
    let [local_film_new_um, local_film_worn_um] = films.map(|film| Some(film?.local?.thickness_um));
    let [lambda_new, lambda_worn] = films.map(|film| film?.lambda);
    let [composite_lambda_new, composite_lambda_worn] = films.map(|film| Some(film?.composite_lambda));
    let [flash_new_k, flash_worn_k] = films.map(|film| Some(film?.local?.flash_k));
    let [friction_new, friction_worn] = states.map(|state| state.map(|state| state.friction));
    let [normal_new, normal_worn] =
        place.load_n_per_mm.map(|transverse| running.pair.obliquity().normal_force(transverse));
    FilmRow {
        position_mm: place.position_mm,
        slice: place.slice,
        width_mm: place.width_mm,
        relative_radius_mm: surfaces.relative_radius_mm,
        sum_speed_m_per_s: surfaces.sum_speed_m_per_s(),
        sliding_speed_m_per_s: surfaces.sliding_speed_m_per_s(),
        line_load_new_N_per_mm: normal_new,
        line_load_worn_N_per_mm: normal_worn,
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
        composite_lambda_new,
        composite_lambda_worn,
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

/// Value of a column of the film rows.
type Value = fn(&FilmRow) -> Option<f64>;

/// Whether contacts are between the tip-edge zones of both gears: all, where tip edges are not followed.
fn between_tip_edges(model: &RunModel<'_>) -> impl Fn(&LubricatedContact) -> bool {
    let contact = &model.scene.contact;
    let sees_edges = contact.tip_contact || contact.surface == SurfaceKind::Fem;
    let (path, zones) = (&model.pair.path, model.zones());
    move |place| {
        let is_at_edge = Gear::BOTH.into_iter().any(|gear| {
            let radius_mm = path.involute[gear].radius_mm(path.rho_mm(gear, place.position_mm));
            zones[gear].at(radius_mm) == FlankZone::TipEdge
        });
        !(sees_edges && is_at_edge)
    }
}

/// Film rows by their place on the flanks.
struct FilmRows<'a> {
    /// Rows between A and E and between the tip-edge zones, with the length of the path of contact that each represents, mm.
    between: Vec<(&'a FilmRow, f64)>,
    /// Rows within a tip-edge zone.
    at_tip_edges: Vec<&'a FilmRow>,
}

impl FilmRows<'_> {
    /// Extremes and mean of a column between the tip edges, where it has values.
    fn along_path(&self, value: Value) -> Option<AlongPath> {
        let (mut total, mut length, mut min, mut max) = (0.0, 0.0, f64::INFINITY, f64::NEG_INFINITY);
        for (value, part) in self.between.iter().filter_map(|(row, length_mm)| Some((value(row)?, *length_mm))) {
            (total, length) = (total + value * part, length + part);
            (min, max) = (f64::min(min, value), f64::max(max, value));
        }
        (length > 0.0).then(|| AlongPath { min, max, mean: total / length })
    }

    /// Position of the least value of a column between the tip edges, mm.
    fn position_of_least_mm(&self, value: Value) -> Option<f64> {
        let valued = self.between.iter().map(|(row, _)| *row).filter(|row| value(row).is_some());
        let least = valued.min_by(|one, two| value(one).partial_cmp(&value(two)).unwrap_or(std::cmp::Ordering::Equal));
        least.map(|row| row.position_mm)
    }

    /// Greatest value of a column, tip edges included; 0 without any.
    fn greatest(&self, value: Value) -> f64 {
        let all = self.between.iter().map(|(row, _)| *row).chain(self.at_tip_edges.iter().copied());
        all.filter_map(value).fold(0.0, f64::max)
    }

    /// Least value of a column at tip edges.
    fn least_at_tip_edges(&self, value: Value) -> Option<f64> {
        self.at_tip_edges.iter().copied().filter_map(value).reduce(f64::min)
    }

    /// Summary of the films; none without λ anywhere between the tip edges.
    fn summary(&self, permissible_lambda: Option<f64>, work: &[SlidingWork; 2]) -> Option<FilmSummary> {
        let [wear_factor_new, wear_factor_worn] = work.each_ref().map(SlidingWork::wear_factors);
        let lambda_new = self.along_path(|row| row.lambda_new)?;
        let lambda_worn = self.along_path(|row| row.lambda_worn)?;
        Some(FilmSummary {
            central_film_new_um: self.along_path(|row| row.central_film_new_um)?,
            central_film_worn_um: self.along_path(|row| row.central_film_worn_um)?,
            minimum_film_new_um: self.along_path(|row| row.minimum_film_new_um)?,
            minimum_film_worn_um: self.along_path(|row| row.minimum_film_worn_um)?,
            lambda_new,
            lambda_worn,
            least_lambda_new_position_mm: self.position_of_least_mm(|row| row.lambda_new)?,
            least_lambda_worn_position_mm: self.position_of_least_mm(|row| row.lambda_worn)?,
            micropitting_safety_new: permissible_lambda.map(|permissible| lambda_new.min / permissible),
            micropitting_safety_worn: permissible_lambda.map(|permissible| lambda_worn.min / permissible),
            tip_edge_lambda_new: self.least_at_tip_edges(|row| row.lambda_new),
            tip_edge_lambda_worn: self.least_at_tip_edges(|row| row.lambda_worn),
            greatest_flash_new_K: self.greatest(|row| row.flash_new_K),
            greatest_flash_worn_K: self.greatest(|row| row.flash_worn_K),
            composite_lambda_new: self.along_path(|row| row.composite_lambda_new),
            composite_lambda_worn: self.along_path(|row| row.composite_lambda_worn),
            wear_factor_new,
            wear_factor_worn,
        })
    }
}

fn friction_summary(running: &RunningPair<'_>, work: &[SlidingWork; 2]) -> FrictionSummary {
    let [mean_new, mean_worn] = work.each_ref().map(SlidingWork::mean_friction);
    FrictionSummary { model: running.settings.friction.model.name().to_owned(), mean_new, mean_worn }
}

fn losses(running: &RunningPair<'_>, [new, worn]: &[SlidingWork; 2]) -> LossSummary {
    let power = running.power_w();
    LossSummary {
        loss_factor_ohlendorf: loss::of_pair(running.pair),
        loss_factor_local_new: new.sliding_w / power,
        loss_factor_local_worn: worn.sliding_w / power,
        power_W: power,
        mesh_power_loss_new_W: new.friction_w,
        mesh_power_loss_worn_W: worn.friction_w,
        efficiency_new: 1.0 - new.friction_w / power,
        efficiency_worn: 1.0 - worn.friction_w / power,
    }
}
