//! Temperatures of the new and the worn pair and of their teeth, with the warnings of these and of the wear law.

use std::f64::consts::TAU;

use super::RunModel;
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::operation::{Scene, mean_friction};
use crate::results::chemistry::{
    GreatestRise, RisesByMethod, TemperatureSummary, ToothTemperatureSummary, WearLawSummary,
};
use crate::simulation::heat_observation::{HeatObservation, HeatObserver, LawInHeat, LawOverMesh};
use crate::simulation::settings::Phase;
use crate::simulation::wear_run::{Outcome, reference_phase};
use crate::thermal::ContactHeat;
use crate::thermal::band::Spread;
use crate::thermal::settings::{ABSOLUTE_ZERO_C, TemperatureMethod};
use crate::thermal::tooth::{TemperatureCurve, ToothTemperatures};
use crate::wear::LocalContact;
use crate::wear::regime::{MM3_PER_NM, Regime};
use crate::wear::settings::WearOfPair;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};

/// Relative difference of Young's moduli of phases up to which it is not warned of.
const NEGLIGIBLE_CHANGE: f64 = 0.02;

/// Why a metal gear beside a plastic one has no temperature of its teeth.
const OF_PLASTIC_ALONE: &str = "VDI 2736-2 has the temperature of the plastic gear alone";

/// Above the melting point of any plastic that gears are made of, °C: that of PEEK is 343.
const HOTTEST_PLASTIC_C: f64 = 350.0;

/// Friction heat of a phase; none of a scene without temperatures.
pub(super) fn in_phase(scene: &Scene, pair: &GearPair, phase: &Phase) -> Option<ContactHeat> {
    let mut settings = scene.heat?;
    let pinion_per_s = TAU * phase.pinion_speed_rpm? / 60.0;
    if let Some(teeth) = scene.teeth_in(pair, phase)
        && settings.tooth.is_some_and(|tooth| tooth.is_bulk)
    {
        let flanks_c: Vec<f64> = Gear::BOTH.into_iter().filter_map(|gear| Some(teeth[gear]?.flank_c)).collect();
        settings.bulk_temperature_k = flanks_c.iter().sum::<f64>() / flanks_c.len() as f64 - ABSOLUTE_ZERO_C;
    }
    if settings.is_bulk_of_mesh
        && let Some(oil) = scene.running_in(pair, phase).and_then(|running| running.oil)
    {
        settings.bulk_temperature_k = oil.bulk_c - ABSOLUTE_ZERO_C;
    }
    Some(ContactHeat::new(settings, pair.path.involute.pinion.base_radius_mm * pinion_per_s))
}

/// Warnings of the material of warm teeth: constants that do not follow their temperature, or only in part.
pub(super) fn tooth_warnings(model: &RunModel<'_>, summary: Option<&TemperatureSummary>) -> Vec<String> {
    let Some(teeth) = summary.and_then(|summary| summary.tooth) else { return Vec::new() };
    let scene = model.scene;
    let phases = || scene.operation.phases.iter();
    let mut warnings = Vec::new();
    for gear in Gear::BOTH.into_iter().filter(|&gear| scene.material[gear].is_plastic()) {
        let Some(at) = teeth[gear] else { continue };
        let name = gear.name();
        let modulus_gpa = 1e-3 * scene.material[gear].young_modulus_mpa;
        let (modulus, wear) = (&scene.modulus[gear], &scene.wear[gear].warm);
        let wears = scene.wear[gear].coefficient_mm2_per_n > 0.0;
        let as_given = [
            ("Young's modulus", format!("material.{name}.young_modulus_curve"), modulus.is_none()),
            ("the wear coefficient", format!("wear.{name}.warm"), wear.is_none() && wears),
        ];
        for (what, key, _) in as_given.into_iter().filter(|(_, _, is_given)| *is_given) {
            warnings.push(format!(
                "[temperature.tooth] {name} {:.0} °C at the flank and {:.0} °C at the root, with {modulus_gpa:.4} GPa: {what} is taken as given at \
                 every temperature, and that of a plastic changes as it warms: give it at these, or {key}",
                at.flank_C, at.root_C
            ));
        }
        if at.flank_C > HOTTEST_PLASTIC_C {
            warnings.push(format!(
                "[temperature.tooth] {name} {:.0} °C at the flank, above the {HOTTEST_PLASTIC_C:.0} °C that plastics endure: check torque and speed, lubrication, and the heat coefficients",
                at.flank_C
            ));
        }
        let found: Vec<_> = phases().filter_map(|phase| scene.teeth_in(model.pair, phase)?[gear]).collect();
        let outside = |curve: &TemperatureCurve, at: fn(&ToothTemperatures) -> f64| {
            found.iter().map(at).find(|&celsius| !curve.covers(celsius))
        };
        let ends = [
            (
                format!("material.{name}.young_modulus_curve"),
                modulus.as_ref().and_then(|curve| outside(curve, ToothTemperatures::mean_c)),
            ),
            (format!("wear.{name}.warm"), wear.as_ref().and_then(|curve| outside(curve, |teeth| teeth.flank_c))),
        ];
        warnings.extend(ends.into_iter().filter_map(|(key, celsius)| {
            Some(format!(
                "{key} does not reach {:.0} °C, the temperature of the teeth: the value at its end is taken",
                celsius?
            ))
        }));
        if modulus.is_some() && phases().any(|phase| phase.young_modulus_mpa.is_none()) {
            let moduli = phases().filter_map(|phase| Some(1e-3 * scene.moduli_in(model.pair, phase)?[gear]));
            let (least, most) =
                moduli.fold((f64::INFINITY, 0.0), |(low, high): (f64, f64), own| (low.min(own), high.max(own)));
            if most > least * (1.0 + NEGLIGIBLE_CHANGE) {
                warnings.push(format!(
                    "material.{name}.young_modulus_curve: {modulus_gpa:.4} GPa of the phase of the greatest load is taken in all phases of a pair with \
                     slices or a calibration; their teeth would have {least:.4} to {most:.4} GPa"
                ));
            }
        }
    }
    warnings
}

/// Heat of the new and of the worn pair.
pub(super) struct ObservedHeat {
    pub new: HeatObservation,
    pub worn: HeatObservation,
}

/// Observes both pairs; none of a scene without temperatures.
pub(super) fn observe(model: &RunModel<'_>, outcome: &Outcome) -> Option<ObservedHeat> {
    let of = |snapshot| observe_at(model, outcome, snapshot, outcome.reference_phase);
    Some(ObservedHeat { new: of(&outcome.new)?, worn: of(&outcome.worn)? })
}

/// Observes a snapshot under the speed and load of a phase.
pub(super) fn observe_at(
    model: &RunModel<'_>,
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

/// Temperatures of the summary.
pub(super) fn summary(model: &RunModel<'_>, observed: &ObservedHeat) -> Option<TemperatureSummary> {
    let phase = reference_phase(&model.phases);
    let (settings, running) = (model.phases[phase].wear.heat?.settings, model.phases[phase].wear.running);
    let teeth = model.scene.teeth_in(model.pair, &model.scene.operation.phases[phase]);
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
        tooth: teeth.map(|both| {
            PerGear::from_fn(|gear| {
                let own = both[gear]?;
                Some(ToothTemperatureSummary {
                    flank_C: own.flank_c,
                    root_C: own.root_c,
                    young_modulus_GPa: Some(1e-3 * model.scene.material[gear].young_modulus_mpa),
                    wear_factor: model.scene.wear[gear].warm.as_ref().map(|warm| warm.at(own.flank_c)),
                })
            })
        }),
        tooth_null_because: teeth.map(|both| both.map(|own| own.is_none().then(|| OF_PLASTIC_ALONE.to_owned()))),
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

/// Wear law of both gears in the summary; none where each has its own.
pub(super) fn law(model: &RunModel<'_>, observed: Option<&ObservedHeat>) -> Option<WearLawSummary> {
    let own = model.scene.wear_in(&model.scene.operation.phases[reference_phase(&model.phases)]);
    own.are_alike().then(|| law_over(model, Gear::Pinion, observed, |heat| &heat.both))
}

/// Wear law of each gear in the summary.
pub(super) fn law_of_gear(model: &RunModel<'_>, observed: Option<&ObservedHeat>) -> PerGear<WearLawSummary> {
    PerGear::from_fn(|gear| law_over(model, gear, observed, |heat| &heat.of[gear]))
}

/// The law of `gear` over the flanks that `over` chooses.
fn law_over(
    model: &RunModel<'_>,
    gear: Gear,
    observed: Option<&ObservedHeat>,
    over: impl Fn(&LawInHeat) -> &LawOverMesh,
) -> WearLawSummary {
    let wear = &model.scene.wear[gear];
    let mild = |of: Option<&HeatObservation>| match of {
        Some(heat) => over(&heat.law).mean_coefficient_mm2_per_n,
        None => {
            let hertz = model.at_pitch.contact.loaded(model.reference().line_load_n_per_mm);
            let at = LocalContact { pressure_mpa: hertz.peak_pressure_mpa, conditions: None, lambda: None };
            model.reference().wear.laws[gear].mild_coefficient_mm2_per_n(&at)
        }
    };
    let new = mild(observed.map(|heat| &heat.new));
    let worn = mild(observed.map(|heat| &heat.worn));
    let severe = wear.severe_transition().map(|severe| severe.factor * new);
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

/// Warnings of the wear law of both gears, or of that of each.
pub(super) fn all_warnings(both: Option<&WearLawSummary>, of_gear: &PerGear<WearLawSummary>) -> Vec<String> {
    match both {
        Some(law) => warnings("wear", law),
        None => {
            Gear::BOTH.into_iter().flat_map(|gear| warnings(&format!("wear.{}", gear.name()), &of_gear[gear])).collect()
        }
    }
}

/// Warnings of a wear law: typical constants, and work outside its temperatures.
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
