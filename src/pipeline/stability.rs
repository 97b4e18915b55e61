//! Whether Euler's steps are short enough, asked before the first of them.

use super::{Model, Observer};
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::settings::Stepping;
use crate::simulation::wear_run::RunPhase;
use crate::wear::{self, WearModel, settings::WearSettings};

/// What is said of the steps, and the working cycles that it took to know.
#[derive(Default)]
pub(super) struct Judged {
    pub warnings: Vec<String>,
    pub evaluations: u64,
    /// The step over the longest safe one, of the phase where that is most; 0 where nothing can swing.
    pub step_over_safe: f64,
}

/// Warns of each phase whose steps are too long for Euler's method, and names the longest that are not. Tells `observer` at once.
pub(super) fn judge(model: &Model<'_>, observer: &dyn Observer) -> Judged {
    let scene = model.scene;
    let Stepping::Fixed { revolutions: step } = scene.numerics.stepping else { return Judged::default() };
    let mut judged = Judged::default();
    let mut begin = 0.0;
    for (index, (phase, asked)) in model.phases.iter().zip(&scene.operation.phases).enumerate() {
        let step = step.min(phase.end_revolutions - begin);
        begin = phase.end_revolutions;
        if !knows_short_waves(&phase.contact) {
            continue;
        }
        let coefficient_mm2_per_n = asked.coefficient_mm2_per_n.unwrap_or(scene.wear.coefficient_mm2_per_n);
        // The transition counts as a factor: its jump has no rate of its own.
        let mild = wear::of(&WearSettings { coefficient_mm2_per_n, severe: None, ..scene.wear });
        let phase = RunPhase { wear: WearModel { law: mild.as_ref(), ..phase.wear }, ..*phase };
        // Where the unworn pair has no equilibrium, the run says so.
        let Ok(bound) = model.wear_run().step_bound(&phase) else { continue };
        judged.evaluations += bound.evaluations;
        let severe = scene.wear.severe.filter(|severe| severe.factor_at(bound.peak_pressure_mpa) > 1.0);
        let safe = bound.revolutions / severe.map_or(1.0, |severe| severe.factor.max(1.0));
        judged.step_over_safe = judged.step_over_safe.max(step / safe);
        if step > safe {
            let of_phase = if model.phases.len() > 1 { format!(" of phase {}", index + 1) } else { String::new() };
            let where_severe = if severe.is_some() { " where wear is severe" } else { "" };
            let warning = format!(
                "numerics.step: with {step:.4} revolutions a step the wear{of_phase} may oscillate{where_severe}; the longest \
                 safe step is {safe:.4} revolutions, and step = \"adaptive\" is safe by itself"
            );
            observer.warning(&warning);
            judged.warnings.push(warning);
        }
    }
    judged
}

/// Whether the pressure answers to short waves of wear at all: on Hertz's ellipse it does not.
fn knows_short_waves(contact: &MeshContact<'_>) -> bool {
    match contact {
        MeshContact::LineOfAction { surface, .. } => surface.feels_short_waves(),
        MeshContact::Simplified { .. } => false,
        MeshContact::FiniteElements(_) => true,
    }
}
