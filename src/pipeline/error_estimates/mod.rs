//! How far the pinion's peak wear is from the truth, from companions that cost at most half of the run itself.
//!
//! | estimate | companions | module |
//! |---|---|---|
//! | wear step, discretisation; on finite elements the size of the elements | coarser wear runs | [`wear_runs`] |
//! | wear step of adaptive runs | none: their own steps estimate it | [`wear_runs`] |
//! | severe switch: hard or over a band | two short wear runs | [`severe_switch`] |
//! | surface model, with a calibration | none: the calibration holds a mesh of finite elements | [`reference_mesh`] |
//! | surface model, without | short wear runs on a truer surface and on the run's own | [`surface_model`] |
//!
//! Cost is counted in equilibria of the run's own surface at its own resolution: an equilibrium on another surface counts as
//! many as it takes the time of ([`relative_cost`]).

mod reference_mesh;
mod severe_switch;
mod surface_model;
mod wear_runs;

use super::{Model, elastic};
use crate::contact::settings::SurfaceKind;
use crate::fem::gear::position::CondensedPair;
use crate::gear::PerGear;
use crate::mesh::settings::BodySettings;
use crate::simulation::{
    figures::WearFigures,
    mesh_contact::MeshContact,
    record::{ErrorSources, ErrorSummary},
    wear_run::{Outcome, Progress},
};
use crate::working_cycle::{settings::SliceSettings, sliced_teeth::SlicedTeeth};

/// Fewest points and positions of a companion: with fewer nothing can be learned.
const LEAST_POINTS: usize = 20;
/// Fewest elements in a half-width of contact of a companion.
const LEAST_ELEMENTS: f64 = 2.0;
/// Cost of all companions over that of the run, at the most.
const BUDGET: f64 = 0.5;
/// Estimates above this part of the peak wear are warned of.
const ALARMING: f64 = 0.02;
/// The same for the surface model, whose estimate is rougher and which no refinement can mend.
const ALARMING_MODEL: f64 = 0.1;

/// An estimate with its source; no value where there is none, and then the source says why.
struct Estimate {
    relative: Option<f64>,
    how: String,
}

impl Estimate {
    fn none(reason: &str) -> Self {
        Self { relative: None, how: format!("not estimated: {reason}") }
    }
}

/// Hides how far the companions have come, but hears an interrupt.
struct Companion<'a> {
    observer: &'a dyn Progress,
    /// Share of the companions' work done before this one, and its own share.
    share: (f64, f64),
}

impl Progress for Companion<'_> {
    fn progress(&self, done: f64, total: f64) {
        self.observer.progress(self.share.0 + self.share.1 * done / total, 1.0);
    }

    fn interrupted(&self) -> bool {
        self.observer.interrupted()
    }

    fn gives_up(&self) -> bool {
        self.observer.gives_up()
    }
}

/// Estimates the errors of the pinion's peak wear in `outcome`. A companion that fails leaves its estimate out, never the
/// result of the run. `step_over_safe` is the run's step over the longest safe one, 0 where nothing can swing.
pub(super) fn estimate(
    model: &Model<'_>,
    outcome: &Outcome,
    step_over_safe: f64,
    observer: &dyn Progress,
) -> ErrorSummary {
    let (elements, slices) = (coarse_elements(model), coarse_slices(model));
    let coarse = Coarse { elements: elements.as_ref(), slices: slices.as_ref() };
    let runs = wear_runs::estimate(model, outcome, coarse, step_over_safe, observer);
    let (severe_switch, switch_cost) = severe_switch::estimate(model, outcome, BUDGET - runs.cost, observer);
    let against_reference = || reference_mesh::estimate(model, outcome).map(|estimate| (estimate, 0.0));
    let from_elements = runs.surface_model.map(|estimate| (estimate, 0.0));
    let on_truer_surface = |tip_contact: bool| {
        let short = surface_model::estimate(model, outcome, tip_contact, BUDGET - runs.cost - switch_cost, observer);
        (short.estimate, short.cost)
    };
    let (surface_model, surface_cost) = match model.first().contact {
        MeshContact::LineOfAction { tip_contact, .. } => {
            against_reference().unwrap_or_else(|| on_truer_surface(tip_contact))
        }
        MeshContact::Simplified { .. } => against_reference().unwrap_or_else(|| on_truer_surface(false)),
        MeshContact::FiniteElements(_) => {
            from_elements.unwrap_or_else(|| (Estimate::none("the companions say nothing of it"), 0.0))
        }
    };
    if observer.interrupted() {
        return ErrorSummary::not_estimated("the estimates were interrupted");
    }
    ErrorSummary {
        discretisation: runs.discretisation.relative,
        wear_step: runs.wear_step.relative,
        surface_model: surface_model.relative,
        severe_switch: severe_switch.relative,
        companions_cost: Some(runs.cost + surface_cost + switch_cost),
        how: ErrorSources {
            discretisation: runs.discretisation.how,
            wear_step: runs.wear_step.how,
            surface_model: surface_model.how,
            severe_switch: severe_switch.how,
        },
    }
}

/// What companions are coarser in, beside points, positions and steps.
#[derive(Clone, Copy)]
struct Coarse<'a> {
    /// Elements twice as long, of a run on finite elements.
    elements: Option<&'a CondensedPair<'a>>,
    /// Half of the slices, of a run that has some.
    slices: Option<&'a SlicedTeeth>,
}

/// Of a run with slices, half as many; as many where so few would leave positions without contact.
fn coarse_slices(model: &Model<'_>) -> Option<SlicedTeeth> {
    let fine = model.sliced?;
    let settings = SliceSettings { count: fine.settings.count.div_ceil(2), ..fine.settings };
    let between = 1.0 - 1.0 / settings.count as f64;
    let covers = model.pair.path.contact_ratio() + between * model.pair.overlap_ratio() >= 1.0;
    Some(if covers { SlicedTeeth::new(model.pair, &model.scene.material, settings) } else { fine.clone() })
}

/// Of a run on finite elements, the model with elements twice as long; none where they cannot be so long.
fn coarse_elements<'a>(model: &Model<'a>) -> Option<CondensedPair<'a>> {
    let MeshContact::FiniteElements(_) = model.first().contact else { return None };
    let fine = model.scene.fem;
    let elements_per_half_width = 0.5 * fine.elements_per_half_width;
    if elements_per_half_width < LEAST_ELEMENTS {
        return None;
    }
    let bodies = BodySettings { elements_per_half_width, ..fine };
    CondensedPair::build(model.pair, &elastic(&model.scene.material), model.first().line_load_n_per_mm, &bodies).ok()
}

/// Time of an equilibrium of slices in the simplified model over that of slices on Winkler beds: 0.3 µs of 30, measured on the preset
/// `helical`, rounded.
const SIMPLIFIED_COST: f64 = 0.01;

/// Time of an equilibrium on a surface over that on a Winkler bed: measured on the fzg-c pair with 750 flank points and 400
/// positions, rounded; 2.6 µs on the bed.
fn relative_cost(surface: SurfaceKind) -> f64 {
    match surface {
        SurfaceKind::Winkler => 1.0,
        SurfaceKind::HertzMean => 1.4,
        SurfaceKind::Hertz => 3.3,
        SurfaceKind::HalfSpace => 20.0,
        SurfaceKind::Fem => 80.0,
    }
}

/// Greatest wear depth of each gear's flank.
fn peak_wear_of_both_mm(model: &Model<'_>, outcome: &Outcome) -> PerGear<f64> {
    PerGear::from_fn(|gear| WearFigures::at(model.pair, gear, outcome, &outcome.worn).peak_mm)
}

/// Warns where an estimate says that the peak wear is far from converged, or the surface far from true.
pub(super) fn warnings(error: &ErrorSummary) -> Vec<String> {
    let causes =
        [("numerics.flank_points and numerics.positions", error.discretisation), ("numerics.step", error.wear_step)];
    let unresolved = causes.into_iter().filter_map(|(keys, estimate)| {
        let off = 100.0 * estimate.filter(|e| *e > ALARMING)?;
        Some(format!("{keys}: the peak wear is estimated to be off by {off:.0} %; refine"))
    });
    let model = error.surface_model.filter(|e| *e > ALARMING_MODEL).map(|estimate| {
        format!(
            "contact.surface: against a truer surface the peak wear may be off by about {:.0} %; gearwear accuracy compares \
             all surfaces",
            100.0 * estimate
        )
    });
    unresolved.chain(model).collect()
}
