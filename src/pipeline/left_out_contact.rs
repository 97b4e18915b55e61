//! The warning of contact before A and after E that a run leaves out.

use super::{Model, UM_PER_MM};
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::tip_contact;
use crate::simulation::left_out_contact::overlaps_mm;
use crate::simulation::mesh_contact;
use crate::simulation::wear_run::Outcome;

/// An overlap of less is none, mm.
const LEAST_MM: f64 = 5e-5;

/// Warns of the contact before A and after E that the run leaves out, if there is any.
pub(super) fn warning(model: &Model<'_>, outcome: &Outcome) -> Option<String> {
    let (contact, teeth) = (model.scene.contact, model.teeth?);
    if contact.tip_contact {
        return None;
    }
    let bodies_mm = mesh_contact::bodies_mm2_per_n(teeth, model.sliced) * model.reference().line_load_n_per_mm;
    let [new, worn] = [&outcome.new, &outcome.worn].map(|state| overlaps_mm(model.pair, outcome, state, bodies_mm));
    let ends: Vec<String> = ["before A", "after E"]
        .into_iter()
        .zip(new.into_iter().zip(worn))
        .filter(|(_, (new, worn))| new.max(*worn) >= LEAST_MM)
        .map(|(end, (new, worn))| {
            let [new, worn] = [new, worn].map(|mm| mm.max(0.0) * UM_PER_MM);
            format!("{end} by {new:.1} µm (worn: {worn:.1} µm)")
        })
        .collect();
    if ends.is_empty() {
        return None;
    }
    let most_mm = [0, 1].map(|end| new[end].max(worn[end]));
    let [before, after] = [0, 1].map(|end| tip_contact::reach_mm(model.pair, most_mm[end])[end]);
    let follow = match contact.surface {
        SurfaceKind::Winkler | SurfaceKind::HalfSpace => "contact.tip_contact = true follows it".to_owned(),
        other => format!(
            "contact.surface = \"{}\" cannot: \"half-space\" with contact.tip_contact = true follows it",
            other.name()
        ),
    };
    Some(format!(
        "loaded teeth touch outside A to E, where this run leaves contact out: the flanks would overlap {}, from about {before:.2} mm of the \
         path of contact before A to {after:.2} mm after E; {follow}",
        ends.join(" and ")
    ))
}
