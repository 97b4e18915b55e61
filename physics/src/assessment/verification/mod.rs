//! The same life on finite elements: how far the run is from what vouches for it.
//!
//! Both gears are meshed with few elements and condensed, and the same operation wears their flanks by the same law in adaptive steps.
//! Wear handed over conservatively ([`crate::gear_fem::load_transfer`]) needs no more: on the pairs of the case `verified-pairs` this life is within
//! its stated uncertainty of one on elements, positions and steps four times as fine (docs/accuracy.md). The whole life is run and not a part of it, for worn
//! flanks that fit one surface do not fit another, and what a short run says of a long one swings with its steps.
//!
//! With h the run's wear, h_f that of the finite elements and u their own uncertainty,
//!
//! ```text
//! profile       √(∫ (h − h_f)² ds / ∫ h_f² ds) + u        of a flank
//! peak wear     |max h − max h_f| / max h_f + u           of the active profile of a flank, and of its tip edge
//! transmission error   the same for its peak to peak on worn flanks
//! pressure      √(mean of (p/p_f − 1)²) + u               of the greatest pressure at the positions between the tip edges, on worn flanks
//! flank pressure      |p − p_f| / p_f + u                 of the greatest between the tip-edge zones, on new and on worn flanks
//! ```
//!
//! A run on finite elements is held against a finer mesh of them; a run with slices against another in space ([`in_space`]).

mod in_space;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::Model;
use super::guarded::guarded;
use crate::contact::settings::SurfaceKind;
use crate::gear::{Gear, GearPair, PerGear, flank_zones::FlankZone};
use crate::gear_fem::{condensed_pair::CondensedPair, model::ModelError};
use crate::gear_mesh::settings::{BodySettings, rounding_element_mm};
use crate::material::Material;
use crate::mesh_cycle::pair_in_space::{PairInSpace, PairInSpaceError};
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::mesh_cycle::{CycleObservation, PositionObservation};
use crate::observer::Observer;
use crate::operation::Scene;
use crate::plan::is_finest_in_space;
use crate::reference::flattening::Flattening;
use crate::results::error::{ErrorNewAndWorn, ErrorPerGear, ErrorSummary, TotalError};
use crate::results::run::StopReason;
use crate::simulation::figures::WearFigures;
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::settings::{Numerics, Phase, Stepping};
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun};
use crate::stiffness::curve::PairCompliance;
use crate::wear::stepping::adaptive::SHALLOW_MM;

/// Least half-width of contact at the pitch point that is meshed, in modules: the flank then has some thousand nodes.
const LEAST_HALF_WIDTH_MODULES: f64 = 0.015;
/// Positions from A to E.
const POSITIONS: usize = 400;
/// Error of the wear depth allowed, over the greatest depth.
const TOLERANCE: f64 = 0.03;
/// Least tolerance, mm: less is no wear.
const LEAST_TOLERANCE_MM: f64 = 1e-9;
/// Most wear steps: an ordinary life takes some fifteen, one with severe wear or of great depth some hundreds.
const MOST_STEPS: u64 = 2000;
/// Half-widths of contact at the pitch point from A and E within which the tip edges shape the pressure.
const NEAR_TIP_EDGES: f64 = 3.0;

/// A life's own uncertainty, relative.
struct Uncertainty {
    profile: f64,
    peak: f64,
    tip_edge: f64,
    transmission_error: f64,
    pressure: f64,
    /// Of the greatest pressure between the tip-edge zones, on new and on worn flanks.
    flank_pressure: [f64; 2],
}

/// Of plane finite elements. Tip edges have a contact narrower than what the elements are meshed for, and worn ones the end of the wear in it.
const OF_ELEMENTS: Uncertainty = Uncertainty {
    profile: 0.006,
    peak: 0.006,
    tip_edge: 0.015,
    transmission_error: 0.005,
    pressure: 0.02,
    flank_pressure: [0.01, 0.01],
};
/// Of the wear of a tip edge that is hardly worn in, over how far an element of its rounding bulges beyond its chord, over the depth: on a contact
/// narrower than the element, where the wear is has the length of the element.
const OF_BULGE: f64 = 0.01;
/// Where that is more, which is where the depth is less than ten times the bulge, the elements of roundings are refined …
const HARDLY_WORN: f64 = 0.001;
/// … so many times.
const ON_HARDLY_WORN_EDGES: f64 = 3.0;
/// That at most.
const MOST_OF_TIP_EDGE: f64 = 0.2;
/// Of the profile and the peak wear where wear is severe: what elements twice as fine find differs by that on nine of ten random pairs.
const SEVERE: f64 = 0.02;

impl Uncertainty {
    /// Where wear may be severe.
    fn severe(self) -> Self {
        let Self { profile, peak, tip_edge, .. } = self;
        Self { profile: profile.max(SEVERE), peak: peak.max(SEVERE), tip_edge: tip_edge.max(SEVERE), ..self }
    }
}

/// What the verification of a run is made with.
pub(super) struct Means<'a, 'b> {
    /// Plane finite elements of the pair.
    pub elements: Option<Result<Elements<'a>, ModelError>>,
    /// Stiffness along the path of contact that finite elements have told already.
    pub curve: Option<&'b PairCompliance>,
    /// The teeth in space, of a run with slices.
    pub in_space: Option<Result<Arc<PairInSpace>, PairInSpaceError>>,
}

/// How many times a difference is what the run leaves: more than 1 where the life has slices as the run has.
#[derive(Debug, Clone, Copy)]
struct Beyond {
    /// Of wear of the active profile.
    wear: f64,
    /// Of the transmission error.
    transmission_error: f64,
}

impl Beyond {
    /// The difference is the error.
    const NONE: Self = Self { wear: 1.0, transmission_error: 1.0 };
}

/// The same life on what vouches for the run.
struct Life {
    outcome: Outcome,
    own: Uncertainty,
    /// How the bodies were meshed, of plane finite elements.
    bodies: Option<BodySettings>,
    /// How many times differences to it are what the run leaves.
    beyond: Beyond,
    /// What the flank points of the run have lost there.
    wear_mm: PerGear<Vec<f64>>,
    /// What it was.
    on: String,
}

/// What the finite elements say.
#[derive(Default)]
pub(super) struct Verified {
    /// How far the run is from them.
    pub total: TotalError,
    /// What the contact surface and the stiffness of the teeth make of the greatest wear.
    surface_model: Option<f64>,
    /// What the flank points have lost on them; none where there is no answer.
    pub wear_mm: Option<PerGear<Vec<f64>>>,
    /// Where the user must know that nothing vouches for the answer.
    pub warning: Option<String>,
}

impl Verified {
    /// There is no answer, for this reason.
    pub(super) fn none(reason: &str) -> Self {
        Self { total: TotalError::none(reason), ..Self::default() }
    }

    /// Puts what is known into the errors of the run.
    pub(super) fn tell(&self, error: &mut ErrorSummary) {
        error.total = self.total.clone();
        error.surface_model = self.surface_model;
        error.how.surface_model = match self.surface_model {
            Some(_) => "difference of the maximum wear from the same wear simulation with finite elements, of both gears the larger"
                .to_owned(),
            None => self.total.how.clone(),
        };
    }

    /// The same where that is worth a warning.
    pub(super) fn warned(reason: &str) -> Self {
        let warning = Some(format!("not verified by finite elements: {reason}"));
        Self { warning, ..Self::none(reason) }
    }
}

/// Hears an interrupt, and stops a life that takes too many steps.
struct Bounded<'a> {
    observer: &'a dyn Observer,
    steps: AtomicU64,
}

impl Observer for Bounded<'_> {
    fn progress(&self, done: f64, total: f64) {
        self.steps.fetch_add(1, Ordering::Relaxed);
        self.observer.progress(done, total);
    }

    fn announcement(&self, text: &str) {
        self.observer.announcement(text);
    }

    fn interrupted(&self) -> bool {
        self.steps.load(Ordering::Relaxed) > MOST_STEPS || self.observer.interrupted()
    }

    fn gives_up(&self) -> bool {
        self.observer.gives_up()
    }
}

/// Finite elements of the pair, and what they were meshed for.
pub(super) struct Elements<'a> {
    /// Both gears.
    pub condensed: CondensedPair<'a>,
    /// The load whose half-width of contact they resolve, N/mm.
    pub line_load_n_per_mm: f64,
    /// Half-width of contact at the pitch point under the scene's greatest load, mm, and the least that is meshed.
    half_width_mm: (f64, f64),
}

/// Finite elements for the greatest of the scene's loads; where its contact is too narrow to be meshed, for the least that is.
pub(super) fn elements<'a>(
    scene: &Scene,
    pair: &'a GearPair,
    at_pitch: &Flattening,
    observer: &dyn Observer,
) -> Result<Elements<'a>, ModelError> {
    let [_, greatest] = scene.operation.torque_range_n_mm();
    let greatest_load = pair.line_load_n_per_mm(greatest);
    let half_width_mm = at_pitch.contact.loaded(greatest_load).half_width_mm;
    let least_mm = LEAST_HALF_WIDTH_MODULES * pair.spec.normal_module_mm;
    // a² is proportional to the load.
    let line_load_n_per_mm = greatest_load * (least_mm / half_width_mm).max(1.0).powi(2);
    let condensed = condensed(scene, pair, line_load_n_per_mm, &scene.wear_bodies(), observer)?;
    Ok(Elements { condensed, line_load_n_per_mm, half_width_mm: (half_width_mm, least_mm) })
}

/// The scene's gears, meshed for the contact under a load.
pub(super) fn condensed<'a>(
    scene: &Scene,
    pair: &'a GearPair,
    line_load_n_per_mm: f64,
    bodies: &BodySettings,
    observer: &dyn Observer,
) -> Result<CondensedPair<'a>, ModelError> {
    let announce = |much: &str| observer.announcement(much);
    CondensedPair::build(pair, &scene.material.map(Material::elastic), line_load_n_per_mm, bodies, &announce)
}

/// The elements of the scene's gears, of a material that is softer or stiffer than the scene's.
pub(super) fn of_material<'a>(
    elements: &CondensedPair<'a>,
    scene: &Scene,
    own: &PerGear<Material>,
) -> CondensedPair<'a> {
    elements.with_moduli(&scene.material.map(Material::elastic), &own.map(Material::elastic))
}

/// Verifies the completed run `outcome`. Whatever happens to the finite elements never costs the run its result.
pub(super) fn verify<'a>(
    model: &Model<'a>,
    outcome: &Outcome,
    means: Means<'a, '_>,
    observer: &dyn Observer,
) -> Verified {
    let life = || match model.sliced {
        None => on_elements(model, outcome, means.elements, observer),
        Some(_) => in_space::life(model, outcome, means, observer),
    };
    match guarded(life) {
        Ok(Ok(life)) => compared(model, outcome, &life),
        Ok(Err(reason)) | Err(reason) => Verified::warned(&reason),
    }
}

/// The life on plane finite elements, others than the run's own; where it does not come to its end, why.
fn on_elements<'a>(
    model: &Model<'a>,
    outcome: &Outcome,
    elements: Option<Result<Elements<'a>, ModelError>>,
    observer: &dyn Observer,
) -> Result<Life, String> {
    let mut bodies = model.scene.wear_bodies();
    if elements.is_none() {
        bodies.elements_per_half_width += 1.0;
    }
    let hardly_worn = Gear::BOTH.into_iter().any(|gear| {
        let depth_mm = WearFigures::at(model.pair, gear, outcome, &outcome.worn).tip_edge.depth_mm;
        of_hardly_worn_edge(model.pair, gear, &bodies, depth_mm) > HARDLY_WORN
    });
    if hardly_worn {
        bodies.rounding_refinement = ON_HARDLY_WORN_EDGES;
    }
    let mesh = |line_load_n_per_mm: f64| condensed(model.scene, model.pair, line_load_n_per_mm, &bodies, observer);
    let elements = match elements {
        Some(Ok(Elements { half_width_mm: (half_width, least), .. })) if half_width < least => {
            return Err(format!(
                "the contact is too narrow to be meshed for a verification: its half-width at the pitch point is {half_width:.2e} mm, \
                 at least {least:.2e} mm is wanted, for narrower contact takes too many elements"
            ));
        }
        Some(Ok(elements)) if hardly_worn => mesh(elements.line_load_n_per_mm),
        Some(elements) => elements.map(|elements| elements.condensed),
        None => mesh(model.phases.iter().map(|phase| phase.line_load_n_per_mm).fold(0.0, f64::max)),
    };
    let elements = elements.map_err(|error| error.to_string())?;
    let scene = model.scene;
    let warmed = |phase: &Phase| {
        let own = scene.material_in(phase);
        (own != scene.material).then(|| of_material(&elements, scene, &own))
    };
    let warm: Vec<Option<CondensedPair<'_>>> = scene.operation.phases.iter().map(warmed).collect();
    let contacts = warm.iter().map(|own| MeshContact::FiniteElements(own.as_ref().unwrap_or(&elements))).collect();
    let life = life(model, outcome, contacts, POSITIONS, observer)?;
    let own = if wears_severely(model, &life) { OF_ELEMENTS.severe() } else { OF_ELEMENTS };
    Ok(Life {
        wear_mm: life.worn.wear_mm.clone(),
        outcome: life,
        own,
        bodies: Some(bodies),
        beyond: Beyond::NONE,
        on: if hardly_worn { "finite elements, short on tip roundings" } else { "finite elements" }.to_owned(),
    })
}

/// The life with these contacts in the phases of the run; where it does not come to its end, why.
fn life(
    model: &Model<'_>,
    outcome: &Outcome,
    contacts: Vec<MeshContact<'_>>,
    positions: usize,
    observer: &dyn Observer,
) -> Result<Outcome, String> {
    let scene = model.scene;
    let phases: Vec<RunPhase<'_>> =
        model.phases.iter().zip(contacts).map(|(phase, contact)| RunPhase { contact, ..*phase }).collect();
    let deepest = |gear: Gear| outcome.worn.deepest_mm(gear);
    let deepest_mm = deepest(Gear::Pinion).max(deepest(Gear::Wheel));
    // Beyond it grows with the wear by itself.
    let tolerance_mm = (TOLERANCE * deepest_mm.min(SHALLOW_MM)).max(LEAST_TOLERANCE_MM);
    let stepping = Stepping::Adaptive { tolerance_mm };
    let numerics = Numerics { positions, stepping, ..scene.numerics };
    let run = WearRun { phases: &phases, numerics, snapshots_revolutions: &[], ..model.wear_run() };
    let bounded = Bounded { observer, steps: AtomicU64::new(0) };
    let life = run.run(&bounded).map_err(|error| error.to_string())?;
    match (life.stop, &life.failure) {
        (StopReason::Completed, _) => Ok(life),
        (_, Some(failure)) => Err(failure.to_string()),
        _ if observer.interrupted() => Err("interrupted".to_owned()),
        _ => Err(format!(
            "after {MOST_STEPS} wear steps the finite elements had reached {:.0} % of the duration",
            100.0 * life.worn.revolutions / model.duration()
        )),
    }
}

/// How far the run is from the finite elements.
fn compared(
    model: &Model<'_>,
    run: &Outcome,
    Life { outcome: life, own: of_life, bodies, beyond, wear_mm, on }: &Life,
) -> Verified {
    let per_gear = |of: &dyn Fn(Gear) -> Option<f64>| ErrorPerGear { pinion: of(Gear::Pinion), wheel: of(Gear::Wheel) };
    let profile = per_gear(&|gear| {
        let (own, truth, grid) = (&run.worn.wear_mm[gear], &wear_mm[gear], &run.grid[gear]);
        let square = |of: &dyn Fn(usize) -> f64| {
            let squares: Vec<f64> = (0..own.len()).map(|i| of(i).powi(2)).collect();
            squares.chunks_exact(grid.len()).map(|slice| grid.integral(slice)).sum::<f64>()
        };
        let involute = model.pair.teeth[gear].involute;
        let counts = |&rho_mm: &f64| match run.zones[gear].at(involute.radius_mm(rho_mm)) {
            FlankZone::Active => beyond.wear,
            FlankZone::BelowActive | FlankZone::TipEdge => 1.0,
        };
        let counts: Vec<f64> = grid.coordinate_mm.iter().map(counts).collect();
        let whole = square(&|i| truth[i]);
        let off = |i: usize| counts[i % counts.len()] * (own[i] - truth[i]);
        (whole > 0.0).then(|| (square(&off) / whole).sqrt() + of_life.profile)
    });
    let figures =
        |outcome: &Outcome| PerGear::from_fn(|gear| WearFigures::at(model.pair, gear, outcome, &outcome.worn));
    let (own, truth) = (figures(run), figures(life));
    let off = |gear: Gear| relative(own[gear].peak_mm, truth[gear].peak_mm);
    let peak_wear = per_gear(&|gear| off(gear).map(|off| beyond.wear * off + of_life.peak));
    let of_tip_edge = PerGear::from_fn(|gear| {
        let depth_mm = truth[gear].tip_edge.depth_mm;
        let of_edge = |bodies: &BodySettings| of_hardly_worn_edge(model.pair, gear, bodies, depth_mm);
        bodies.as_ref().map_or(0.0, of_edge).max(of_life.tip_edge)
    });
    let tip_edge_wear = per_gear(&|gear| {
        let off = relative(own[gear].tip_edge.depth_mm, truth[gear].tip_edge.depth_mm);
        off.map(|off| off + of_tip_edge[gear])
    });
    let surface_model = match model.scene.contact.surface {
        SurfaceKind::Fem => None,
        _ if is_finest_in_space(model.scene) => None,
        _ => Gear::BOTH.into_iter().filter_map(off).reduce(f64::max),
    };
    let peak_to_peak = |outcome: &Outcome| {
        let (low, high) = outcome.worn.cycle.transmission_error_mm();
        high - low
    };
    let total = TotalError {
        profile,
        peak_wear,
        tip_edge_wear,
        transmission_error_peak_to_peak: relative(peak_to_peak(run), peak_to_peak(life))
            .map(|off| beyond.transmission_error * off + of_life.transmission_error),
        pressure_between_tips: pressure(model, &run.worn.cycle, &life.worn.cycle).map(|off| off + of_life.pressure),
        flank_pressure: ErrorNewAndWorn {
            new: flank_pressure([&run.new, &life.new]).map(|off| off + of_life.flank_pressure[0]),
            worn: flank_pressure([&run.worn, &life.worn]).map(|off| off + of_life.flank_pressure[1]),
        },
        how: [how(life, of_life, &of_tip_edge, on), without_wear(&own)].concat(),
    };
    Verified { total, surface_model, wear_mm: Some(wear_mm.clone()), warning: None }
}

/// How a life vouches for a run, with its own uncertainty of the wear of each tip edge.
fn how(life: &Outcome, of_life: &Uncertainty, of_tip_edge: &PerGear<f64>, on: &str) -> String {
    format!(
        "the same wear simulation with {on} ({} positions in a base pitch, {} wear steps, {} mesh cycles); their own uncertainty is added: \
             {} % of the profile, {} % of the maximum wear, {:.2} and {:.2} % of that of the tip edges, and of the flank pressure {} % new and {} % worn",
        life.work.equilibria / life.work.mesh_cycles.max(1),
        life.steps.accepted,
        life.work.mesh_cycles,
        100.0 * of_life.profile,
        100.0 * of_life.peak,
        100.0 * of_tip_edge.pinion,
        100.0 * of_tip_edge.wheel,
        100.0 * of_life.flank_pressure[0],
        100.0 * of_life.flank_pressure[1],
    )
}

/// Why a gear has no error of its wear.
fn without_wear(figures: &PerGear<WearFigures>) -> String {
    let still = Gear::BOTH.into_iter().filter(|gear| figures[*gear].peak_mm <= 0.0);
    still.map(|gear| format!("; the {} does not wear, so that its wear has no error", gear.name())).collect()
}

/// What the length of the elements leaves open of the wear of a rounded tip edge that has lost `depth_mm`.
fn of_hardly_worn_edge(pair: &GearPair, gear: Gear, bodies: &BodySettings, depth_mm: f64) -> f64 {
    let rounding_mm = pair.spec.tip_rounding_mm(gear);
    if rounding_mm <= 0.0 || depth_mm <= 0.0 {
        return 0.0;
    }
    let BodySettings { elements_per_half_width, rounding_refinement, .. } = *bodies;
    let element_mm = rounding_element_mm(rounding_mm, elements_per_half_width, rounding_refinement);
    let bulge_mm = element_mm.powi(2) / (8.0 * rounding_mm);
    (OF_BULGE * bulge_mm / depth_mm).min(MOST_OF_TIP_EDGE)
}

/// Whether the pressure reaches a transition to severe wear at any moment that is kept.
fn wears_severely(model: &Model<'_>, life: &Outcome) -> bool {
    let states = [&life.new].into_iter().chain(&life.snapshots);
    let greatest_mpa = states.map(|state| state.cycle.peak_pressure_mpa()).fold(0.0, f64::max);
    let mut transitions = Gear::BOTH.into_iter().filter_map(|gear| model.scene.wear[gear].severe_transition());
    transitions.any(|severe| greatest_mpa > severe.above_mpa - 0.5 * severe.band_mpa)
}

/// |own − truth|/truth; none where there is nothing to be wrong about.
fn relative(own: f64, truth: f64) -> Option<f64> {
    (truth > 0.0).then(|| (own - truth).abs() / truth)
}

/// What is observed between the tip edges.
fn between_tip_edges<'a>(
    model: &Model<'_>,
    cycle: &'a CycleObservation,
) -> impl Iterator<Item = &'a PositionObservation> + use<'a> {
    let path = &model.pair.path;
    let near_mm = NEAR_TIP_EDGES * model.at_pitch.contact.loaded(model.reference().line_load_n_per_mm).half_width_mm;
    let between = path.start_mm + near_mm..path.end_mm - near_mm;
    cycle.positions.iter().filter(move |at| between.contains(&at.position_mm))
}

/// How far a run's greatest pressure between the tip-edge zones is from a life's.
fn flank_pressure(run_and_life: [&Snapshot; 2]) -> Option<f64> {
    let [own, truth] = run_and_life.map(|state| state.cycle.pressure_figures.flank_mpa);
    relative(own, truth)
}

/// The difference of the greatest pressures between the tip edges.
fn pressure(model: &Model<'_>, own: &CycleObservation, truth: &CycleObservation) -> Option<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for at in between_tip_edges(model, own) {
        let reference = truth.peak_pressure_at_mpa(at.position_mm);
        if reference > 0.0 {
            sum += (at.footprint.peak_pressure_mpa / reference - 1.0).powi(2);
            count += 1.0;
        }
    }
    (count > 0.0).then(|| f64::sqrt(sum / count))
}
