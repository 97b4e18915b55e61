//! Verification of a run by the same wear simulation on finite elements.
//!
//! Both gears are meshed with few elements and condensed, and the same operation wears their flanks by the same law in adaptive steps.
//! Conservative transfer of the wear ([`gearwear_bodies::gear_fem::load_transfer`]) needs no more: on the pairs of the case `verified-pairs` this reference run
//! is within its stated uncertainty of one on elements, positions and steps four times as fine (docs/accuracy.md). The whole duration is simulated:
//! worn flanks that fit one surface do not fit another, and the difference over a short run swings with its steps.
//!
//! With h the run's wear, h_f that of the reference run and u the uncertainty of the latter,
//!
//! ```text
//! profile       √(∫ (h − h_f)² ds / ∫ h_f² ds) + u        of a flank
//! peak wear     |max h − max h_f| / max h_f + u           of the active profile of a flank, and of its tip edge; no less than what
//!                                                         wear at a kink, with its own uncertainty, exceeds max h by
//! transmission error   the same for its peak to peak on worn flanks
//! pressure      √(mean of (p/p_f − 1)²) + u               of the greatest pressure at the positions between the tip edges, on worn flanks
//! flank pressure      |p − p_f| / p_f + u                 of the greatest between the tip-edge zones, on new and on worn flanks
//! ```
//!
//! A run on finite elements is compared with one of elements and positions half as long again, from which it differs by more than from the converged
//! answer where both approach that at second order; a run with slices with one on three-dimensional finite elements ([`in_space`]).

mod in_space;
mod uncertainty;

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use self::uncertainty::{HARDLY_WORN, OF_ELEMENTS, ReferenceUncertainty, of_hardly_worn_edge, of_hardly_worn_kink};
use super::RunModel;
use super::guarded::guarded;
use super::inputs::RunInputs;
use super::kept_elements::KeptElements;
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::condensed::WearingElements;
use crate::mesh_cycle::pair_in_space::{PairInSpace, PairInSpaceError};
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::mesh_cycle::{CycleObservation, PositionObservation};
use crate::observer::Observer;
use crate::operation::{
    COARSER, LEAST_HALF_WIDTH_MODULES, ON_HARDLY_WORN_EDGES, Scene, VERIFIED_POSITIONS, VERIFIED_TOLERANCE,
};
use crate::plan::is_finest_in_space;
use crate::results::error::{ErrorNewAndWorn, ErrorPerGear, ErrorSummary, TotalError};
use crate::results::run::StopReason;
use crate::simulation::figures::WearFigures;
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::settings::{Numerics, Stepping};
use crate::simulation::wear_run::{Outcome, RunPhase, WearRun};
use crate::stiffness::curve::PairCompliance;
use crate::wear::stepping::adaptive::SHALLOW_MM;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, flank::FlankGrid, flank_zones::FlankZone};
use gearwear_bodies::gear_fem::condensed_pair::{CondensedPair, hertz_half_width_mm};
use gearwear_bodies::gear_fem::model::ModelError;
use gearwear_bodies::gear_mesh::settings::{BodySettings, kink_element_mm};
use gearwear_bodies::material::{Material, contact_modulus_mpa};
use gearwear_bodies::reference::flattening::Flattening;

/// Least tolerance of the wear depth, mm.
const LEAST_TOLERANCE_MM: f64 = 1e-9;
/// Most wear steps: ordinary runs take some fifteen, runs with severe wear or of great depth some hundreds.
const MOST_STEPS: u64 = 2000;
/// Half-widths of contact at the pitch point from A and E within which the tip edges shape the pressure.
const NEAR_TIP_EDGES: f64 = 3.0;

/// Finite-element models at hand for a verification.
pub(super) struct VerificationModels<'a, 'b> {
    /// Plane finite elements of the pair.
    pub elements: Option<Result<Elements<'a>, ModelError>>,
    /// Stiffness along the path of contact by plane finite elements, where it is known already.
    pub curve: Option<&'b PairCompliance>,
    /// Three-dimensional finite elements of the teeth, of a run with slices.
    pub in_space: Option<Result<Arc<PairInSpace>, PairInSpaceError>>,
}

/// Factors from a difference to the error of the run by Richardson extrapolation; above 1 where the reference run has slices as the run has.
#[derive(Debug, Clone, Copy)]
struct Extrapolation {
    /// Factor of the wear of the active profile.
    wear: f64,
    /// Factor of the transmission error.
    transmission_error: f64,
}

impl Extrapolation {
    /// The difference itself is the error.
    const NONE: Self = Self { wear: 1.0, transmission_error: 1.0 };
}

/// Wear simulation on finite elements that a run is compared with.
struct ReferenceRun {
    outcome: Outcome,
    uncertainty: ReferenceUncertainty,
    /// Mesh settings of plane finite elements.
    bodies: Option<BodySettings>,
    /// Factors of the differences to it.
    extrapolation: Extrapolation,
    /// Wear depth at the flank points of the verified run, mm.
    wear_mm: PerGear<Vec<f64>>,
    /// Description of its finite elements.
    on: String,
}

/// Errors of a run against finite elements.
#[derive(Default)]
pub(super) struct Verified {
    /// Error of each quantity, with how it was obtained.
    pub total: TotalError,
    /// Part of contact surface and tooth stiffness in the error of the maximum wear.
    surface_model: Option<f64>,
    /// Difference of the maximum wear on finite elements to that on coarser ones, where wear is not severe.
    discretisation: Option<f64>,
    /// Wear depth at the flank points by finite elements, mm; none of a run that is not verified.
    pub wear_mm: Option<PerGear<Vec<f64>>>,
    /// Warning that the run is not verified.
    pub warning: Option<String>,
}

impl Verified {
    /// A run that is not verified, for this reason.
    pub(super) fn none(reason: &str) -> Self {
        Self { total: TotalError::none(reason), ..Self::default() }
    }

    /// A run whose verification failed or cannot be made, which is warned of.
    pub(super) fn failed(reason: &str) -> Self {
        let warning = Some(format!("not verified by finite elements: {reason}"));
        Self { warning, ..Self::none(reason) }
    }

    /// Enters the errors into those of the run.
    pub(super) fn tell(&self, error: &mut ErrorSummary) {
        error.total = self.total.clone();
        error.surface_model = self.surface_model;
        error.how.surface_model = match self.surface_model {
            Some(_) => "difference of the maximum wear from the same wear simulation with finite elements, of both gears the larger"
                .to_owned(),
            None => self.total.how.clone(),
        };
        // Only where the estimates were made, and left it to the verification.
        if let (None, Some(_), Some(difference)) = (error.discretisation, error.wear_step, self.discretisation) {
            error.discretisation = Some(difference);
            error.how.discretisation = format!(
                "difference of the maximum wear from the same wear simulation on elements {COARSER} times as long, of both gears the larger"
            );
        }
    }
}

/// Observer that also stops a reference run of too many wear steps.
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

/// Plane finite elements of the pair, with the load that they are meshed for.
pub(super) struct Elements<'a> {
    /// Condensed model of both gears.
    pub condensed: CondensedPair<'a>,
    /// Load whose half-width of contact the elements resolve, N/mm.
    pub line_load_n_per_mm: f64,
}

/// Finite elements for the greatest of the scene's loads; where its contact is too narrow to be meshed, for the least that is.
pub(super) fn elements<'a>(
    RunInputs { scene, elements, .. }: RunInputs<'_>,
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
    let condensed = condensed(scene, pair, line_load_n_per_mm, &scene.wear_bodies(), (elements, observer))?;
    Ok(Elements { condensed, line_load_n_per_mm })
}

/// The scene's gears, meshed for the contact under a load; `kept` elements stand for them where they are the same.
pub(super) fn condensed<'a>(
    scene: &Scene,
    pair: &'a GearPair,
    line_load_n_per_mm: f64,
    bodies: &BodySettings,
    (kept, observer): (&KeptElements, &dyn Observer),
) -> Result<CondensedPair<'a>, ModelError> {
    let material = scene.material.map(Material::elastic);
    kept.condensed(pair, &material, line_load_n_per_mm, bodies, &|much| observer.announcement(much))
}

/// Elements of the scene's gears with other Young's moduli.
pub(super) fn of_material<'a>(
    elements: &CondensedPair<'a>,
    scene: &Scene,
    own: &PerGear<Material>,
) -> CondensedPair<'a> {
    elements.with_moduli(&scene.material.map(Material::elastic), &own.map(Material::elastic))
}

/// Verifies the completed run `outcome`. A failure of the finite elements never costs the run its result.
pub(super) fn verify<'a>(
    model: &RunModel<'a>,
    outcome: &Outcome,
    models: VerificationModels<'a, '_>,
    observer: &dyn Observer,
) -> Verified {
    let reference = guarded(|| match model.sliced {
        None => on_elements(model, outcome, models.elements, observer),
        Some(_) => in_space::reference_run(model, outcome, models, observer),
    });
    match reference {
        Ok(Ok(reference)) => RunComparison::new(model, outcome, &reference).verified(),
        Ok(Err(reason)) | Err(reason) => Verified::failed(&reason),
    }
}

/// Reference run on plane finite elements other than the run's own.
///
/// # Errors
/// Reason why it is not completed.
fn on_elements<'a>(
    model: &RunModel<'a>,
    outcome: &Outcome,
    elements: Option<Result<Elements<'a>, ModelError>>,
    observer: &dyn Observer,
) -> Result<ReferenceRun, String> {
    let scene = model.scene;
    let mut bodies = scene.wear_bodies();
    let mut positions = VERIFIED_POSITIONS;
    if elements.is_none() {
        bodies.elements_per_half_width /= COARSER;
        positions = (scene.numerics.positions as f64 / COARSER).round() as usize;
    }
    let hardly_worn = Gear::BOTH.into_iter().any(|gear| {
        let depth_mm = WearFigures::at(model.pair, gear, outcome, &outcome.worn).tip_edge.depth_mm;
        of_hardly_worn_edge(model.pair, gear, &bodies, depth_mm) > HARDLY_WORN
    });
    if hardly_worn {
        bodies.rounding_refinement = ON_HARDLY_WORN_EDGES;
    }
    let elements = match elements {
        Some(Ok(elements)) if hardly_worn => {
            condensed(scene, model.pair, elements.line_load_n_per_mm, &bodies, (&KeptElements::default(), observer))
        }
        Some(elements) => elements.map(|elements| elements.condensed),
        None => {
            condensed(scene, model.pair, model.greatest_load_n_per_mm(), &bodies, (&KeptElements::default(), observer))
        }
    };
    let elements = WearingElements::new(elements.map_err(|error| error.to_string())?);
    let phases = scene.operation.phases.iter();
    let warm: Vec<Option<WearingElements<'_>>> = phases
        .map(|phase| scene.material_in(phase))
        .map(|own| (own != scene.material).then(|| WearingElements::new(of_material(&elements.model, scene, &own))))
        .collect();
    let contacts = warm.iter().map(|own| MeshContact::FiniteElements(own.as_ref().unwrap_or(&elements))).collect();
    let reference = simulate(model, outcome, contacts, positions, observer)?;
    let own = if model.pair.spec.is_internal() { OF_ELEMENTS.internal() } else { OF_ELEMENTS };
    let uncertainty = if model.wears_severely(&reference) { own.severe() } else { own };
    Ok(ReferenceRun {
        wear_mm: reference.worn.wear_mm.clone(),
        outcome: reference,
        uncertainty,
        bodies: Some(bodies),
        extrapolation: Extrapolation::NONE,
        on: if hardly_worn { "finite elements, short on tip roundings" } else { "finite elements" }.to_owned(),
    })
}

/// Simulates the wear with these contacts in the phases of the run.
///
/// # Errors
/// Reason why the simulation is not completed.
fn simulate(
    model: &RunModel<'_>,
    outcome: &Outcome,
    contacts: Vec<MeshContact<'_>>,
    positions: usize,
    observer: &dyn Observer,
) -> Result<Outcome, String> {
    let phases: Vec<RunPhase<'_>> =
        model.phases.iter().zip(contacts).map(|(phase, contact)| RunPhase { contact, ..*phase }).collect();
    let deepest_mm = outcome.worn.deepest_mm(Gear::Pinion).max(outcome.worn.deepest_mm(Gear::Wheel));
    // Above SHALLOW_MM the integrator's own tolerance grows with the wear.
    let tolerance_mm = (VERIFIED_TOLERANCE * deepest_mm.min(SHALLOW_MM)).max(LEAST_TOLERANCE_MM);
    let stepping = Stepping::Adaptive { tolerance_mm };
    let numerics = Numerics { positions, stepping, ..model.scene.numerics };
    let run = WearRun { phases: &phases, numerics, snapshots_revolutions: &[], ..model.wear_run() };
    let bounded = Bounded { observer, steps: AtomicU64::new(0) };
    let reference = run.run(&bounded).map_err(|error| error.to_string())?;
    match (reference.stop, &reference.failure) {
        (StopReason::Completed, _) => Ok(reference),
        (_, Some(failure)) => Err(failure.to_string()),
        _ if observer.interrupted() => Err("interrupted".to_owned()),
        _ => Err(format!(
            "after {MOST_STEPS} wear steps the finite elements had reached {:.0} % of the duration",
            100.0 * reference.worn.revolutions / model.duration()
        )),
    }
}

/// A completed run beside its reference run.
struct RunComparison<'a> {
    model: &'a RunModel<'a>,
    run: &'a Outcome,
    reference: &'a ReferenceRun,
    /// Wear of the run.
    wear: PerGear<WearFigures>,
    /// Wear of the reference run.
    reference_wear: PerGear<WearFigures>,
}

impl<'a> RunComparison<'a> {
    fn new(model: &'a RunModel<'_>, run: &'a Outcome, reference: &'a ReferenceRun) -> Self {
        let [wear, reference_wear] = [run, &reference.outcome]
            .map(|outcome| PerGear::from_fn(|gear| WearFigures::at(model.pair, gear, outcome, &outcome.worn)));
        Self { model, run, reference, wear, reference_wear }
    }

    /// Errors of the run.
    fn verified(&self) -> Verified {
        let ReferenceRun { outcome, uncertainty, wear_mm, .. } = self.reference;
        let peak = Gear::BOTH.into_iter().filter_map(|gear| self.peak_difference(gear)).reduce(f64::max);
        let [surface_model, discretisation] = match self.model.scene.contact.surface {
            SurfaceKind::Fem => [None, peak.filter(|_| !self.model.wears_severely(outcome))],
            _ if is_finest_in_space(self.model.scene) => [None; 2],
            _ => [peak, None],
        };
        let [new, worn] = uncertainty.flank_pressure;
        let [of_new, of_worn] = uncertainty.transmission_error;
        let total = TotalError {
            profile: per_gear(|gear| self.profile(gear)),
            peak_wear: per_gear(|gear| {
                let off = self.extrapolated_peak_difference(gear)?;
                Some(off.max(self.beyond_at_kinks(gear)) + uncertainty.peak)
            }),
            tip_edge_wear: per_gear(|gear| self.tip_edge_wear(gear)),
            transmission_error_peak_to_peak: self
                .transmission_error(of_worn, |outcome| outcome.worn.cycle.peak_to_peak_mm()),
            transmission_error_peak_to_peak_new: self
                .transmission_error(of_new, |outcome| outcome.new.cycle.peak_to_peak_mm()),
            transmission_error_over_life: self.transmission_error(of_worn, |outcome| outcome.worn.over_life.mean_mm()),
            pressure_between_tips: pressure(self.model, &self.run.worn.cycle, &outcome.worn.cycle)
                .map(|off| off + uncertainty.pressure),
            flank_pressure: ErrorNewAndWorn {
                new: flank_pressure([&self.run.new, &outcome.new]).map(|off| off + new),
                worn: flank_pressure([&self.run.worn, &outcome.worn]).map(|off| off + worn),
            },
            how: [self.how(), self.at_kinks(), without_wear(&self.wear)].concat(),
        };
        Verified { total, surface_model, discretisation, wear_mm: Some(wear_mm.clone()), warning: None }
    }

    /// Error of the wear over the whole flank of a gear; none where the reference does not wear.
    fn profile(&self, gear: Gear) -> Option<f64> {
        let (own, truth, grid) = (&self.run.worn.wear_mm[gear], &self.reference.wear_mm[gear], &self.run.grid[gear]);
        let involute = self.model.pair.teeth[gear].involute;
        let rho_mm = grid.coordinate_mm.iter();
        let factors: Vec<f64> = rho_mm
            .map(|&rho_mm| match self.run.zones[gear].at(involute.radius_mm(rho_mm)) {
                FlankZone::Active => self.reference.extrapolation.wear,
                FlankZone::BelowActive | FlankZone::TipEdge => 1.0,
            })
            .collect();
        let off =
            own.iter().zip(truth).zip(factors.iter().cycle()).map(|((own, truth), factor)| factor * (own - truth));
        let whole = integral_of_squares(grid, truth.iter().copied());
        (whole > 0.0).then(|| (integral_of_squares(grid, off) / whole).sqrt() + self.reference.uncertainty.profile)
    }

    /// Error of a figure of the transmission error, of which the reference has this uncertainty.
    fn transmission_error(&self, uncertainty: f64, mm: impl Fn(&Outcome) -> f64) -> Option<f64> {
        let ReferenceRun { outcome, extrapolation, .. } = self.reference;
        relative(mm(self.run), mm(outcome)).map(|off| extrapolation.transmission_error * off + uncertainty)
    }

    /// Relative difference of the greatest wear of the active profile.
    fn peak_difference(&self, gear: Gear) -> Option<f64> {
        relative(self.wear[gear].peak_mm, self.reference_wear[gear].peak_mm)
    }

    /// The same, as far as the reference run tells of the converged answer.
    fn extrapolated_peak_difference(&self, gear: Gear) -> Option<f64> {
        Some(self.reference.extrapolation.wear * self.peak_difference(gear)?)
    }

    /// Sentence for each gear whose wear at a kink makes the error of its greatest wear.
    fn at_kinks(&self) -> String {
        let of_kinks = Gear::BOTH.into_iter().filter_map(|gear| {
            let (off, beyond) = (self.extrapolated_peak_difference(gear)?, self.beyond_at_kinks(gear));
            (beyond > off).then(|| {
                format!(
                    "; where a linear relief of the {} begins, its wear may exceed the maximum by {:.1} %, as light wear has not rounded the kink",
                    gear.name(),
                    100.0 * beyond
                )
            })
        });
        of_kinks.collect()
    }

    /// Part of the greatest wear of a gear's active profile by which that at a kink may exceed it.
    fn beyond_at_kinks(&self, gear: Gear) -> f64 {
        let Some(bodies) = &self.reference.bodies else { return 0.0 };
        let (pair, grid) = (self.model.pair, &self.run.grid[gear]);
        let modulus_mpa = contact_modulus_mpa(self.model.scene.material.map(Material::elastic));
        let load_n_per_mm = self.model.greatest_load_n_per_mm();
        let [own, reference] = [&self.run.worn.wear_mm[gear], &self.reference.wear_mm[gear]];
        let at_kinks_mm = pair.kinks(gear).map(|kink| {
            let position_mm = pair.path.rho_mm(gear, kink.rho_mm);
            let half_width_mm = hertz_half_width_mm(pair, modulus_mpa, load_n_per_mm, position_mm);
            let element_mm = kink_element_mm(half_width_mm, bodies.elements_per_half_width);
            let kink_mm = pair.path.involute[gear].arc_mm(kink.rho_mm);
            let beside = grid
                .arc_mm
                .iter()
                .zip(own.iter().zip(reference))
                .filter(|(arc_mm, _)| (*arc_mm - kink_mm).abs() <= element_mm);
            let depth_mm = beside.fold(0.0, |deepest: f64, (_, (own, reference))| deepest.max(*own).max(*reference));
            depth_mm * (1.0 + of_hardly_worn_kink(kink.angle_rad, element_mm, depth_mm))
        });
        (at_kinks_mm.fold(0.0, f64::max) - self.wear[gear].peak_mm) / self.reference_wear[gear].peak_mm
    }

    /// Error of the greatest wear of the tip edge.
    fn tip_edge_wear(&self, gear: Gear) -> Option<f64> {
        let off = relative(self.wear[gear].tip_edge.depth_mm, self.reference_wear[gear].tip_edge.depth_mm);
        off.map(|off| off + self.tip_edge_uncertainty(gear))
    }

    /// Uncertainty of the reference run at the tip edge.
    fn tip_edge_uncertainty(&self, gear: Gear) -> f64 {
        let depth_mm = self.reference_wear[gear].tip_edge.depth_mm;
        let bodies = self.reference.bodies.as_ref();
        let of_elements = bodies.map_or(0.0, |bodies| of_hardly_worn_edge(self.model.pair, gear, bodies, depth_mm));
        of_elements.max(self.reference.uncertainty.tip_edge)
    }

    /// Description of the reference run with its uncertainties.
    fn how(&self) -> String {
        let ReferenceRun { outcome, uncertainty, on, .. } = self.reference;
        format!(
            "the same wear simulation with {on} ({} positions in a base pitch, {} wear steps, {} mesh cycles); their own uncertainty is added: \
             {} % of the profile, {} % of the maximum wear, {:.2} and {:.2} % of that of the tip edges, and of the flank pressure {} % new and {} % worn",
            outcome.work.positions_of_cycle(),
            outcome.steps.accepted,
            outcome.work.mesh_cycles,
            100.0 * uncertainty.profile,
            100.0 * uncertainty.peak,
            100.0 * self.tip_edge_uncertainty(Gear::Pinion),
            100.0 * self.tip_edge_uncertainty(Gear::Wheel),
            100.0 * uncertainty.flank_pressure[0],
            100.0 * uncertainty.flank_pressure[1],
        )
    }
}

fn per_gear(error: impl Fn(Gear) -> Option<f64>) -> ErrorPerGear {
    ErrorPerGear { pinion: error(Gear::Pinion), wheel: error(Gear::Wheel) }
}

/// ∫ v² ds of values at the points of a flank, slices added up.
fn integral_of_squares(grid: &FlankGrid, values: impl Iterator<Item = f64>) -> f64 {
    let squares: Vec<f64> = values.map(|value| value.powi(2)).collect();
    squares.chunks_exact(grid.len()).map(|slice| grid.integral(slice)).sum::<f64>()
}

/// Sentence for each gear that has no error because it does not wear.
fn without_wear(figures: &PerGear<WearFigures>) -> String {
    let still = Gear::BOTH.into_iter().filter(|gear| figures[*gear].peak_mm <= 0.0);
    still.map(|gear| format!("; the {} does not wear, so that its wear has no error", gear.name())).collect()
}

/// |own − truth|/truth; none where the truth is 0.
fn relative(own: f64, truth: f64) -> Option<f64> {
    (truth > 0.0).then(|| (own - truth).abs() / truth)
}

/// Observations at the positions between the tip edges.
fn between_tip_edges<'a>(
    model: &RunModel<'_>,
    cycle: &'a CycleObservation,
) -> impl Iterator<Item = &'a PositionObservation> + use<'a> {
    let path = &model.pair.path;
    let near_mm = NEAR_TIP_EDGES * model.at_pitch.contact.loaded(model.reference().line_load_n_per_mm).half_width_mm;
    let between = path.start_mm + near_mm..path.end_mm - near_mm;
    cycle.positions.iter().filter(move |at| between.contains(&at.position_mm))
}

/// Relative difference of the greatest pressures between the tip-edge zones.
fn flank_pressure(run_and_reference: [&Snapshot; 2]) -> Option<f64> {
    let [own, truth] = run_and_reference.map(|state| state.cycle.pressure_figures.flank_mpa);
    relative(own, truth)
}

/// Root mean square relative difference of the greatest pressures at positions between the tip edges.
fn pressure(model: &RunModel<'_>, own: &CycleObservation, truth: &CycleObservation) -> Option<f64> {
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
