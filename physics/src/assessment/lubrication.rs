//! Films, friction and losses of the new and of the worn pair, from the loads and pressures of the run.
//!
//! With x the pinion's radius of curvature at the contact point of a slice, w its transverse load per mm of face width, v_g its sliding speed and
//! n slices, the normal force is w/cos β_b ([`crate::gear::normal_section`]) and
//!
//! ```text
//! P_VZ = 1/p_bt ∫ b/n Σ μ w v_g/cos β_b dx        H_VL = 1/p_bt ∫ b/n Σ w v_g/cos β_b dx / P
//! ```
//!
//! over all contacts of slices, also those of tip edges before A and after E.
//!
//! Film and friction of each contact are those of [`crate::lubrication::running_pair`].

use std::f64::consts::PI;

use super::{Model, scuffing, slices};
use crate::contact::settings::SurfaceKind;
use crate::gear::{Gear, PerGear, flank_zones::FlankZone};
use crate::lubrication::local_film::local_film;
use crate::lubrication::loss;
use crate::lubrication::running_pair::{ContactFilm, Finish, LoadedPlace, OilInMesh, RunningPair};
use crate::mesh_cycle::sliced_mesh::SlicedMesh;
use crate::reference::hertz_line::PEAK_OVER_MEAN;
use crate::results::lubrication::{
    AlongPath, FilmRow, FilmSummary, FrictionSummary, LossSummary, LubricationSummary, MethodBPoint, MethodBSummary,
    OilSummary,
};
use crate::simulation::wear_run::Outcome;

/// Why figures that need the standards' load sharing factor are missing.
pub(super) const NO_SHARING_FACTOR: &str =
    "the standards have a load sharing factor for transverse contact ratios below 2 alone";

/// What is found, as the record has it.
pub(super) struct Observed {
    pub summary: LubricationSummary,
    pub rows: Vec<FilmRow>,
}

/// A contact of the run.
#[derive(Clone, Copy)]
struct Place {
    position_mm: f64,
    slice: usize,
    width_mm: f64,
    /// Length of the path that it stands for.
    length_mm: f64,
    /// Part of the width of its slice that is in contact.
    part_of_width: f64,
    /// Transverse load over the whole width of its slice.
    load_n_per_mm: [f64; 2],
    pressure_mpa: [f64; 2],
    half_width_mm: [f64; 2],
}

/// One contact, new or worn.
#[derive(Clone, Copy)]
struct State {
    friction: f64,
    film: Option<ContactFilm>,
}

impl Place {
    fn loaded(&self, which: usize) -> LoadedPlace {
        LoadedPlace {
            position_mm: self.position_mm,
            line_load_n_per_mm: self.load_n_per_mm[which] / self.part_of_width,
            peak_pressure_mpa: self.pressure_mpa[which],
            half_width_mm: self.half_width_mm[which],
        }
    }

    /// What is there in the new (0) or worn (1) pair; none without load.
    fn state(&self, running: &RunningPair<'_>, which: usize) -> Option<State> {
        let loaded = self.loaded(which);
        (loaded.line_load_n_per_mm > 0.0).then(|| {
            let friction = running.friction(&loaded);
            State { friction, film: running.film(&loaded, friction, [Finish::New, Finish::RunIn][which]) }
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
fn places(model: &Model<'_>, outcome: &Outcome) -> Vec<Place> {
    let (new, worn) = (&outcome.new.cycle, &outcome.worn.cycle);
    // The simplified surface has the mean pressure for the greatest.
    let greatest = if model.scene.contact.surface == SurfaceKind::HertzMean { PEAK_OVER_MEAN } else { 1.0 };
    let whole = model.reference().line_load_n_per_mm;
    let middle_mm = 0.5 * model.pair.spec.face_width_mm;
    let Some(meshes) = slices::meshes(outcome) else {
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
                part_of_width: 1.0,
                load_n_per_mm: [new.load_share * whole, worn.load_share * whole],
                pressure_mpa: [new, worn].map(|seen| greatest * seen.footprint.peak_pressure_mpa),
                half_width_mm: [new, worn].map(|seen| seen.footprint.half_width_mm),
            })
            .collect();
    };
    let [new_slices, _] = &meshes;
    let count = new_slices.slices;
    let spacing = new_slices.base_pitch_mm / new_slices.transmission_error_mm.len() as f64;
    let cells = new_slices.position_mm.iter().enumerate();
    let path = &model.pair.path;
    let touches_beyond = model.scene.contact.tip_contact;
    let meshes = &meshes;
    let all = cells.flat_map(|(row, &position_mm)| {
        (0..count).map(move |slice| {
            let cell = row * count + slice;
            let of = |field: fn(&SlicedMesh) -> &Vec<f64>| meshes.each_ref().map(|mesh| field(mesh)[cell]);
            let middle_mm = position_mm + outcome.slices.ahead_mm[slice];
            Place {
                // The part of a slice whose middle is not in contact is.
                position_mm: if touches_beyond { middle_mm } else { path.folded_mm(middle_mm) },
                slice,
                width_mm: outcome.slices.width_mm[slice],
                length_mm: spacing,
                part_of_width: of(|mesh| &mesh.part_of_width).into_iter().fold(0.0, f64::max),
                load_n_per_mm: of(|mesh| &mesh.line_load_n_per_mm),
                pressure_mpa: of(|mesh| &mesh.peak_pressure_mpa).map(|mean| greatest * mean),
                half_width_mm: of(|mesh| &mesh.half_width_mm),
            }
        })
    });
    all.filter(|place| place.part_of_width > 0.0).collect()
}

/// Sums over the path.
#[derive(Default)]
struct Work {
    sliding_w: f64,
    friction_w: f64,
    /// Sliding between A and E.
    on_path_w: f64,
    /// Sliding of each gear there that counts as wearing under its films; none where its law reads none.
    wearing_w: PerGear<Option<f64>>,
}

impl Work {
    /// Of the new (0) or worn (1) pair.
    fn over(model: &Model<'_>, seen: &Seen<'_>, slice_width_mm: f64, which: usize) -> Self {
        let mut work = Self::default();
        let obliquity = model.pair.obliquity();
        for (place, states) in seen.places.iter().zip(&seen.states) {
            let sliding_m_per_s = seen.running.contact(place.position_mm, 0.0, 0.0).sliding_speed_m_per_s();
            let force_n = obliquity.normal_force(place.load_n_per_mm[which]) * slice_width_mm;
            let power_w = force_n * sliding_m_per_s * place.length_mm / model.pair.path.base_pitch_mm;
            work.sliding_w += power_w;
            let Some(state) = states[which] else { continue };
            work.friction_w += power_w * state.friction;
            if !seen.is_on_path(place) {
                continue;
            }
            work.on_path_w += power_w;
            for gear in Gear::BOTH {
                let wear = &model.reference().wear;
                if let Some(factor) = wear.film_factor(gear, &place.loaded(which)) {
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

/// What is seen of the contacts of a run.
pub(super) struct Seen<'a> {
    running: &'a RunningPair<'a>,
    places: Vec<Place>,
    /// New and worn at each place.
    states: Vec<[Option<State>; 2]>,
}

impl Seen<'_> {
    /// Whether a place lies between A and E.
    fn is_on_path(&self, place: &Place) -> bool {
        let path = &self.running.pair.path;
        (path.start_mm..=path.end_mm).contains(&place.position_mm)
    }
}

/// Looks at both states of a run; none where nobody asks.
pub(super) fn look<'a>(model: &Model<'a>, outcome: &Outcome) -> Option<Seen<'a>> {
    let running = model.phases[outcome.reference_phase].wear.running?;
    let places = places(model, outcome);
    let states = places.iter().map(|place| [0, 1].map(|which| place.state(running, which))).collect();
    Some(Seen { running, places, states })
}

/// Sums up what was seen.
pub(super) fn sum_up(model: &Model<'_>, outcome: &Outcome, seen: &Seen<'_>) -> Observed {
    let Seen { running, places, states } = seen;
    let oil = running.oil.as_ref();
    let has_factor = running.sharing.is_of_standard();
    let slices = outcome.slices.count().max(1) as f64;
    let width_mm = model.pair.spec.face_width_mm / slices;
    let work = [0, 1].map(|which| Work::over(model, seen, width_mm, which));
    let wear_factors = work.each_ref().map(Work::wear_factors);
    let rows: Vec<FilmRow> = places.iter().zip(states).map(|(place, states)| row(running, place, states)).collect();
    let is_between = between_tip_edges(model);
    let (on_path, at_tip_edges) = rows
        .iter()
        .zip(places)
        .map(|(row, place)| (row, place, is_between(place)))
        .partition::<Vec<_>, _>(|(_, place, between)| *between && seen.is_on_path(place));
    let between: Vec<RowOfPath<'_>> = on_path.into_iter().map(|(row, place, _)| (row, place.length_mm)).collect();
    let at_tip_edges: Vec<&FilmRow> =
        at_tip_edges.into_iter().filter(|(.., between)| !between).map(|(row, ..)| row).collect();
    let summary = LubricationSummary {
        oil: oil.map(oil_summary),
        film: oil.and_then(|oil| film_summary(&between, &at_tip_edges, oil.settings.permissible_lambda, wear_factors)),
        method_b: oil.filter(|_| has_factor).map(|oil| method_b(running, oil)),
        method_b_null_because: oil.filter(|_| !has_factor).map(|_| NO_SHARING_FACTOR.to_owned()),
        scuffing: oil.map(|oil| scuffing::summary(running, oil, &model.scene.material)),
        friction: friction_summary(running, &work),
        losses: losses(running, &work),
    };
    Observed { summary, rows }
}

/// What the user should know of the films: where contact is too hot for what is known of the oil.
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

fn row(running: &RunningPair<'_>, place: &Place, states: &[Option<State>; 2]) -> FilmRow {
    let surfaces = running.contact(place.position_mm, 0.0, 0.0);
    let of = |value: fn(&ContactFilm) -> Option<f64>| {
        states.map(|state| state.and_then(|state| state.film).as_ref().and_then(value))
    };
    let [central_film_new_um, central_film_worn_um] = of(|film| Some(film.central_um));
    let [minimum_film_new_um, minimum_film_worn_um] = of(|film| Some(film.least_um));
    let [local_film_new_um, local_film_worn_um] = of(|film| film.local.map(|local| local.thickness_um));
    let [lambda_new, lambda_worn] = of(|film| film.lambda);
    let [composite_lambda_new, composite_lambda_worn] = of(|film| Some(film.composite_lambda));
    let [flash_new_k, flash_worn_k] = of(|film| film.local.map(|local| local.flash_k));
    let [friction_new, friction_worn] = states.map(|state| state.map(|state| state.friction));
    let normal_force = |transverse| running.pair.obliquity().normal_force(transverse);
    FilmRow {
        position_mm: place.position_mm,
        slice: place.slice,
        width_mm: place.width_mm,
        relative_radius_mm: surfaces.relative_radius_mm,
        sum_speed_m_per_s: surfaces.sum_speed_m_per_s(),
        sliding_speed_m_per_s: surfaces.sliding_speed_m_per_s(),
        line_load_new_N_per_mm: normal_force(place.load_n_per_mm[0]),
        line_load_worn_N_per_mm: normal_force(place.load_n_per_mm[1]),
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

/// A row between A and E and between the tip-edge zones, and the length of the path that it stands for, mm.
type RowOfPath<'a> = (&'a FilmRow, f64);

type Value = fn(&FilmRow) -> Option<f64>;

/// Which places are between the tip-edge zones of both gears: all, where the surface sees no tip edges.
fn between_tip_edges(model: &Model<'_>) -> impl Fn(&Place) -> bool {
    let contact = &model.scene.contact;
    let sees_edges = contact.tip_contact || contact.surface == SurfaceKind::Fem;
    let (path, zones) = (&model.pair.path, model.zones());
    move |place| {
        let is_edge = |gear: Gear| {
            let radius_mm = path.involute[gear].base_radius_mm.hypot(path.rho_mm(gear, place.position_mm));
            zones[gear].at(radius_mm) == FlankZone::TipEdge
        };
        !(sees_edges && Gear::BOTH.into_iter().any(is_edge))
    }
}

/// Extremes and mean of a column, where it has values.
fn along_path(rows: &[RowOfPath<'_>], value: Value) -> Option<AlongPath> {
    let values = || rows.iter().filter_map(|(row, length_mm)| Some((value(row)?, *length_mm)));
    let (total, length) = values().fold((0.0, 0.0), |(sum, length), (value, part)| (sum + value * part, length + part));
    let extremes =
        values().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (value, _)| (low.min(value), high.max(value)));
    (length > 0.0).then(|| AlongPath { min: extremes.0, max: extremes.1, mean: total / length })
}

/// Of the rows between A and E and between the tip-edge zones, `rows`, and of those at tip edges.
fn film_summary(
    rows: &[RowOfPath<'_>],
    at_tip_edges: &[&FilmRow],
    permissible_lambda: Option<f64>,
    [wear_factor_new, wear_factor_worn]: [Option<PerGear<f64>>; 2],
) -> Option<FilmSummary> {
    let along = |value: Value| along_path(rows, value);
    let place_of_least = |value: Value| {
        let least = rows.iter().map(|(row, _)| *row).filter(|row| value(row).is_some());
        let least = least.min_by(|one, two| value(one).partial_cmp(&value(two)).unwrap_or(std::cmp::Ordering::Equal));
        least.map(|row| row.position_mm)
    };
    let (lambda_new, lambda_worn) = (along(|row| row.lambda_new)?, along(|row| row.lambda_worn)?);
    let all = || rows.iter().map(|(row, _)| *row).chain(at_tip_edges.iter().copied());
    let greatest = |value: Value| all().filter_map(value).fold(0.0, f64::max);
    let least_of_edges = |value: Value| at_tip_edges.iter().copied().filter_map(value).reduce(f64::min);
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
        tip_edge_lambda_new: least_of_edges(|row| row.lambda_new),
        tip_edge_lambda_worn: least_of_edges(|row| row.lambda_worn),
        greatest_flash_new_K: greatest(|row| row.flash_new_K),
        greatest_flash_worn_K: greatest(|row| row.flash_worn_K),
        composite_lambda_new: along(|row| row.composite_lambda_new),
        composite_lambda_worn: along(|row| row.composite_lambda_worn),
        wear_factor_new,
        wear_factor_worn,
    })
}

fn friction_summary(running: &RunningPair<'_>, work: &[Work; 2]) -> FrictionSummary {
    let [mean_new, mean_worn] = work.each_ref().map(Work::mean_friction);
    FrictionSummary { model: running.settings.friction.model.name().to_owned(), mean_new, mean_worn }
}

fn losses(running: &RunningPair<'_>, [new, worn]: &[Work; 2]) -> LossSummary {
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
