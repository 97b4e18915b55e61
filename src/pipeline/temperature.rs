//! The temperatures of the new and the worn pair and of their teeth, and what is said of them and of the wear law.

use std::f64::consts::TAU;

use super::Model;
use crate::contact::settings::SurfaceKind;
use crate::gear::{Gear, GearPair, PerGear};
use crate::lubrication::{loss, running_pair::RunningPair};
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::results::chemistry::{
    GreatestRise, RisesByMethod, TemperatureSummary, ToothTemperatureSummary, WearLawSummary,
};
use crate::scene::Scene;
use crate::simulation::heat_observation::{HeatObservation, HeatObserver, LawInHeat, LawOverMesh};
use crate::simulation::settings::Phase;
use crate::simulation::wear_run::{Outcome, reference_phase};
use crate::thermal::ContactHeat;
use crate::thermal::band::Spread;
use crate::thermal::settings::{ABSOLUTE_ZERO_C, HeatSettings, TemperatureMethod};
use crate::thermal::tooth::{ToothTemperatures, WarmGear};
use crate::wear::regime::{MM3_PER_NM, Regime};

/// W per N·mm/s.
const W_PER_N_MM_PER_S: f64 = 1e-3;

/// Friction heat of a phase; none where nobody asks for temperatures.
pub(super) fn in_phase(
    scene: &Scene,
    pair: &GearPair,
    phase: &Phase,
    running: Option<&RunningPair<'_>>,
) -> Option<ContactHeat> {
    let mut settings = scene.heat?;
    let pinion_per_s = TAU * phase.pinion_speed_rpm? / 60.0;
    if let Some(teeth) = teeth(scene, pair, phase, running)
        && settings.tooth.is_some_and(|tooth| tooth.is_bulk)
    {
        settings.bulk_temperature_k = 0.5 * (teeth.pinion.flank_c + teeth.wheel.flank_c) - ABSOLUTE_ZERO_C;
    }
    Some(ContactHeat::new(settings, pair.path.involute.pinion.base_radius_mm * pinion_per_s))
}

/// μ of the heat: as given, or the mean of the mesh.
fn mean_friction(settings: &HeatSettings, running: Option<&RunningPair<'_>>) -> f64 {
    let of_mesh = || running.map_or(0.0, RunningPair::mean_friction);
    settings.friction_coefficient.unwrap_or_else(of_mesh)
}

/// The teeth of each gear in a phase; none where nobody asks.
fn teeth(
    scene: &Scene,
    pair: &GearPair,
    phase: &Phase,
    running: Option<&RunningPair<'_>>,
) -> Option<PerGear<ToothTemperatures>> {
    let heat = scene.heat?;
    let tooth = heat.tooth?;
    let pinion_per_s = TAU * phase.pinion_speed_rpm? / 60.0;
    let power_w = W_PER_N_MM_PER_S * phase.pinion_torque_n_mm * pinion_per_s;
    let loss_w = power_w * mean_friction(&heat, running) * loss::of_pair(pair);
    Some(PerGear::from_fn(|gear| {
        let warm = WarmGear {
            teeth: pair.spec.gears[gear].teeth,
            face_width_mm: pair.spec.face_width_mm,
            pitch_velocity_m_per_s: 1e-3 * pair.working_pitch_radius_mm(Gear::Pinion) * pinion_per_s,
            normal_module_mm: pair.spec.normal_module_mm,
        };
        tooth.temperatures(&warm, loss_w)
    }))
}

/// What the user should know of the material of plastic teeth: it is as stiff as the scene says, however warm.
pub(super) fn tooth_warning(scene: &Scene, summary: Option<&TemperatureSummary>) -> Option<String> {
    let teeth = summary?.tooth?;
    let warm: Vec<String> = Gear::BOTH
        .into_iter()
        .filter(|&gear| scene.material[gear].is_plastic())
        .map(|gear| {
            let (name, at, modulus) = (gear.name(), teeth[gear], 1e-3 * scene.material[gear].young_modulus_mpa);
            format!("{name} {:.0} °C at the flank and {:.0} °C at the root, with {modulus} GPa", at.flank_C, at.root_C)
        })
        .collect();
    (!warm.is_empty()).then(|| {
        format!(
            "[temperature.tooth] {}: Young's modulus and wear coefficient are taken as given at every temperature; those of plastics change as \
             they warm, so that they are to be given at these",
            warm.join("; ")
        )
    })
}

/// Heat of the new and of the worn pair.
pub(super) struct ObservedHeat {
    pub new: HeatObservation,
    pub worn: HeatObservation,
}

/// Looks at both; none where nobody asks for temperatures.
pub(super) fn observe(model: &Model<'_>, outcome: &Outcome) -> Option<ObservedHeat> {
    let of = |snapshot| observe_at(model, outcome, snapshot, outcome.reference_phase);
    Some(ObservedHeat { new: of(&outcome.new)?, worn: of(&outcome.worn)? })
}

/// Looks at a snapshot under the speed and load of a phase.
pub(super) fn observe_at(
    model: &Model<'_>,
    outcome: &Outcome,
    snapshot: &Snapshot,
    phase: usize,
) -> Option<HeatObservation> {
    let phase = &model.phases[phase];
    let observer = HeatObserver {
        pair: model.pair,
        heat: phase.wear.heat?,
        wear: phase.wear,
        valid_k: model
            .scene
            .wear
            .as_ref()
            .map(|own| own.law.valid_temperature_c().map(|range| range.map(|at| at - ABSOLUTE_ZERO_C))),
        spread: match model.scene.contact.surface {
            SurfaceKind::HertzMean => Spread::Even,
            _ => Spread::Ellipse,
        },
        line_load_n_per_mm: phase.line_load_n_per_mm,
        ahead_mm: &outcome.slices.ahead_mm,
    };
    Some(observer.observe(&snapshot.cycle))
}

/// What the summary says of the temperatures.
pub(super) fn summary(model: &Model<'_>, observed: &ObservedHeat) -> Option<TemperatureSummary> {
    let phase = reference_phase(&model.phases);
    let (settings, running) = (model.phases[phase].wear.heat?.settings, model.phases[phase].wear.running);
    let teeth = teeth(model.scene, model.pair, &model.scene.operation.phases[phase], running);
    let (new, worn) = (observed.new.greatest_rise_k(), observed.worn.greatest_rise_k());
    let by = |k: usize| GreatestRise { greatest_rise_new_K: new[k], greatest_rise_worn_K: worn[k] };
    let own = by(settings.method.index());
    let [peclet_min, peclet_max] = observed.new.peclet_range();
    Some(TemperatureSummary {
        method: settings.method,
        velocity: settings.velocity,
        partition: settings.partition,
        friction_coefficient: mean_friction(&settings, running),
        bulk_temperature_C: settings.bulk_temperature_k + ABSOLUTE_ZERO_C,
        tooth: teeth.map(|both| both.map(|at| ToothTemperatureSummary { flank_C: at.flank_c, root_C: at.root_c })),
        greatest_rise_new_K: own.greatest_rise_new_K,
        greatest_rise_worn_K: own.greatest_rise_worn_K,
        peclet_min,
        peclet_max,
        by_method: RisesByMethod {
            heat_equation: by(TemperatureMethod::HeatEquation.index()),
            williams: by(TemperatureMethod::Williams.index()),
            tian_kennedy: by(TemperatureMethod::TianKennedy.index()),
        },
    })
}

/// What the summary says of the wear law of both gears; none where each has its own.
pub(super) fn law(model: &Model<'_>, observed: Option<&ObservedHeat>) -> Option<WearLawSummary> {
    model.scene.wear.are_alike().then(|| law_over(model, Gear::Pinion, observed, |heat| &heat.both))
}

/// What it says of the wear law of each gear.
pub(super) fn law_of_gear(model: &Model<'_>, observed: Option<&ObservedHeat>) -> PerGear<WearLawSummary> {
    PerGear::from_fn(|gear| law_over(model, gear, observed, |heat| &heat.of[gear]))
}

/// The law of `gear` over the flanks that `over` chooses.
fn law_over(
    model: &Model<'_>,
    gear: Gear,
    observed: Option<&ObservedHeat>,
    over: impl Fn(&LawInHeat) -> &LawOverMesh,
) -> WearLawSummary {
    let wear = &model.scene.wear[gear];
    let mild = |of: Option<&HeatObservation>| match of {
        Some(heat) => over(&heat.law).mean_coefficient_mm2_per_n,
        None => model.reference().wear.laws[gear].mild_coefficient_mm2_per_n(None),
    };
    let new = mild(observed.map(|heat| &heat.new));
    let worn = mild(observed.map(|heat| &heat.worn));
    let severe = wear.severe.map(|severe| severe.factor * new);
    let outside =
        |of: fn(&ObservedHeat) -> &HeatObservation| observed.and_then(|heat| over(&of(heat).law).work_outside_validity);
    WearLawSummary {
        law: wear.law.name().to_owned(),
        coefficient_mm3_per_Nm: MM3_PER_NM * wear.coefficient_mm2_per_n,
        effective_coefficient_new_mm3_per_Nm: MM3_PER_NM * new,
        effective_coefficient_worn_mm3_per_Nm: MM3_PER_NM * worn,
        irg_regime: Regime::of(new),
        severe_coefficient_mm3_per_Nm: severe.map(|k| MM3_PER_NM * k),
        irg_regime_severe: severe.map(Regime::of),
        typical_constants: wear.law.typical_constants().into_iter().map(str::to_owned).collect(),
        valid_temperature_C: wear.law.valid_temperature_c(),
        work_outside_validity_new: outside(|heat| &heat.new),
        work_outside_validity_worn: outside(|heat| &heat.worn),
    }
}

/// What the user should know of the law of both gears, or of that of each.
pub(super) fn all_warnings(both: Option<&WearLawSummary>, of_gear: &PerGear<WearLawSummary>) -> Vec<String> {
    match both {
        Some(law) => warnings("wear", law),
        None => {
            Gear::BOTH.into_iter().flat_map(|gear| warnings(&format!("wear.{}", gear.name()), &of_gear[gear])).collect()
        }
    }
}

/// What the user should know of the law: constants that nobody measured, and work where it does not hold.
fn warnings(table: &str, law: &WearLawSummary) -> Vec<String> {
    let mut warnings = Vec::new();
    if !law.typical_constants.is_empty() {
        warnings.push(format!(
            "[{table}.{}] {}: typical value{}, an order of magnitude, not measured for a particular lubricant or steel",
            law.law.replace('-', "_"),
            law.typical_constants.join(", "),
            if law.typical_constants.len() > 1 { "s" } else { "" },
        ));
    }
    if let (Some([low, high]), Some(new), Some(worn)) =
        (law.valid_temperature_C, law.work_outside_validity_new, law.work_outside_validity_worn)
        && (new > 0.0 || worn > 0.0)
    {
        warnings.push(format!(
            "{table}.law = {:?} holds for contact temperatures of about {low} to {high} °C: {:.1} % of the sliding work of a mesh is done \
             outside them new and {:.1} % worn",
            law.law,
            100.0 * new,
            100.0 * worn
        ));
    }
    warnings
}
