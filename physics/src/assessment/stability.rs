//! Whether Euler's steps are short enough, asked before the first of them.

use super::Model;
use crate::gear::PerGear;
use crate::material::Material;
use crate::observer::Observer;
use crate::simulation::settings::Stepping;
use crate::simulation::stability::StepBound;
use crate::simulation::wear_run::RunPhase;
use crate::wear;

/// What is said of the steps, and the mesh cycles that it took to know.
#[derive(Default)]
pub(super) struct Judged {
    pub warnings: Vec<String>,
    pub evaluations: u64,
    /// The step over the longest safe one, of the phase where that is most; 0 where there is no limit.
    pub step_over_safe: f64,
}

/// What the bound on the steps of a phase depends on.
#[derive(Clone, Copy, PartialEq)]
struct Conditions {
    line_load_n_per_mm: f64,
    pinion_speed_rpm: Option<f64>,
    coefficient_mm2_per_n: PerGear<f64>,
    material: PerGear<Material>,
}

/// Warns of each phase whose steps are too long for Euler's method, and names the longest that are not. Tells `observer` at once.
/// Phases of the same load, speed and wear coefficient have the same bound.
pub(super) fn judge(model: &Model<'_>, observer: &dyn Observer) -> Judged {
    let scene = model.scene;
    let Stepping::Fixed { revolutions: step } = scene.numerics.stepping else { return Judged::default() };
    let mut judged = Judged::default();
    let mut begin = 0.0;
    let mut measured: Vec<(Conditions, StepBound)> = Vec::new();
    for (index, (phase, asked)) in model.phases.iter().zip(&scene.operation.phases).enumerate() {
        let step = step.min(phase.end_revolutions - begin);
        begin = phase.end_revolutions;
        let own = scene.wear_in(asked);
        // The transition counts as a factor: its jump has no rate of its own.
        let mild = wear::of_both(&own.with_severe(|_| None));
        let phase = RunPhase { wear: phase.wear.with_laws(&mild), ..*phase };
        let conditions = Conditions {
            line_load_n_per_mm: phase.line_load_n_per_mm,
            pinion_speed_rpm: asked.pinion_speed_rpm,
            coefficient_mm2_per_n: own.as_ref().map(|own| own.coefficient_mm2_per_n),
            material: scene.material_in(asked),
        };
        let bound = match measured.iter().find(|(before, _)| *before == conditions) {
            Some(&(_, bound)) => bound,
            None => {
                let stopped = || observer.gives_up();
                // Where the unworn pair has no equilibrium, the run says so.
                let Ok(bound) = model.wear_run().step_bound(&phase, own.may_be_severe(), &stopped) else {
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
