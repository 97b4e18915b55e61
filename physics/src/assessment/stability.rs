//! Stability of Euler's wear steps, judged before the first of them.

use super::RunModel;
use crate::observer::Observer;
use crate::simulation::settings::Stepping;
use crate::simulation::stability::StepBound;
use crate::simulation::wear_run::RunPhase;
use crate::wear;
use crate::wear::settings::WearOfPair;
use gearwear_bodies::gear::PerGear;
use gearwear_bodies::material::Material;

/// Judgement of the wear steps, and the mesh cycles evaluated for it.
#[derive(Clone, Default)]
pub(super) struct Judged {
    pub warnings: Vec<String>,
    pub evaluations: u64,
    /// Wear step over the longest stable one, greatest of all phases; 0 without a limit.
    pub step_over_safe: f64,
}

/// Conditions of a phase that its longest stable step depends on.
#[derive(Clone, Copy, PartialEq)]
struct StepConditions {
    line_load_n_per_mm: f64,
    pinion_speed_rpm: Option<f64>,
    coefficient_mm2_per_n: PerGear<f64>,
    material: PerGear<Material>,
}

/// Warns of each phase whose steps are too long for Euler's method, with the longest stable one; `observer` is told at once.
/// Phases of the same load, speed, wear coefficient and material share one evaluation.
pub(super) fn judge(model: &RunModel<'_>, observer: &dyn Observer) -> Judged {
    let scene = model.scene;
    let Stepping::Fixed { revolutions: step } = scene.numerics.stepping else { return Judged::default() };
    let mut judged = Judged::default();
    let mut begin = 0.0;
    let mut measured: Vec<(StepConditions, StepBound)> = Vec::new();
    for (index, (phase, asked)) in model.phases.iter().zip(&scene.operation.phases).enumerate() {
        let step = step.min(phase.end_revolutions - begin);
        begin = phase.end_revolutions;
        let own = scene.wear_in(asked);
        // Severe wear enters as a factor below: the jump of a transition has no rate.
        let mild = wear::of_both(&own.with_severe(|_| None));
        let phase = RunPhase { wear: phase.wear.with_laws(&mild), ..*phase };
        let conditions = StepConditions {
            line_load_n_per_mm: phase.line_load_n_per_mm,
            pinion_speed_rpm: asked.pinion_speed_rpm,
            coefficient_mm2_per_n: own.as_ref().map(|own| own.coefficient_mm2_per_n),
            material: scene.material_in(asked),
        };
        let bound = match measured.iter().find(|(before, _)| *before == conditions) {
            Some(&(_, bound)) => bound,
            None => {
                // A pair without equilibrium is reported by the run itself.
                let run = model.wear_run();
                let Ok(bound) = run.step_bound(&phase, own.may_be_severe(), &|| observer.gives_up()) else {
                    continue;
                };
                judged.evaluations += bound.evaluations;
                measured.push((conditions, bound));
                bound
            }
        };
        let severe = bound.peak_pressure_mpa.and_then(|pressure| own.severe_factor_under(pressure));
        let safe = bound.revolutions / severe.map_or(1.0, |factor| factor.max(1.0));
        judged.step_over_safe = judged.step_over_safe.max(step / safe);
        if step > safe {
            let of_phase = if model.phases.len() > 1 { format!(" of phase {}", index + 1) } else { String::new() };
            let where_severe = if severe.is_some() { " where wear is severe" } else { "" };
            let warning = format!(
                "numerics.step: with {step:.4} revolutions a step the wear{of_phase} may oscillate{where_severe}; the longest \
                 stable step is {safe:.4} revolutions, and step = \"adaptive\" keeps to it by itself"
            );
            observer.warning(&warning);
            judged.warnings.push(warning);
        }
    }
    judged
}
