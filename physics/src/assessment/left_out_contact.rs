//! The warning of contact before A and after E that a run leaves out.

use super::{RunModel, UM_PER_MM};
use crate::contact::settings::SurfaceKind;
use crate::simulation::left_out_contact::overlaps_mm;
use crate::simulation::mesh_contact;
use crate::simulation::wear_run::Outcome;

/// An overlap of less is none, mm.
const LEAST_MM: f64 = 5e-5;

/// A part of the load that is worth telling.
const LEAST_SHARE: f64 = 0.005;

/// Warns of the contact before A and after E that the run leaves out, if there is any.
pub(super) fn warning(model: &RunModel<'_>, outcome: &Outcome) -> Option<String> {
    if model.scene.contact.surface == SurfaceKind::Fem || model.scene.contact.tip_contact {
        return beyond_range(model, outcome);
    }
    outside_path(model, outcome)
}

/// Deflection of the bodies that all pairs in mesh share, mm.
fn bodies_mm(model: &RunModel<'_>) -> f64 {
    let load = model.reference().line_load_n_per_mm;
    model.teeth.map_or(0.0, |teeth| mesh_contact::bodies_mm2_per_n(teeth, model.sliced) * load)
}

/// Range before A and after E in which a run follows tip edges, and overlap of the flanks of loaded teeth at its ends, new or worn, mm; none without a range.
fn overlaps_at_range_mm(model: &RunModel<'_>, outcome: &Outcome) -> Option<[[f64; 2]; 2]> {
    let reference = model.reference();
    let range_mm = reference.contact.range_mm(model.pair, reference.line_load_n_per_mm).ok()?;
    let [new, worn] =
        [&outcome.new, &outcome.worn].map(|state| overlaps_mm(model.pair, outcome, state, bodies_mm(model), range_mm));
    Some([range_mm, [0, 1].map(|end| new[end].max(worn[end]))])
}

/// Whether teeth overlap by more than `least_mm` where a run that follows tip edges follows them no farther, so that loads jump there.
pub(super) fn is_beyond_range(model: &RunModel<'_>, outcome: &Outcome, least_mm: f64) -> bool {
    overlaps_at_range_mm(model, outcome)
        .is_some_and(|[_, overlaps]| overlaps.iter().any(|&overlap| overlap >= least_mm))
}

/// Warning of a run that follows tip edges, but not far enough.
fn beyond_range(model: &RunModel<'_>, outcome: &Outcome) -> Option<String> {
    let [range_mm, overlaps_mm] = overlaps_at_range_mm(model, outcome)?;
    let states = [&outcome.new, &outcome.worn];
    let farthest_mm = model.pair.farthest_touch_mm();
    let mut ends = Vec::new();
    for (end, name) in ["before A", "after E"].into_iter().enumerate() {
        let overlap_mm = overlaps_mm[end];
        if overlap_mm < LEAST_MM {
            continue;
        }
        let shares = states.into_iter().filter_map(|state| state.cycle.shares_at_ends.map(|shares| shares[end]));
        let at_once = shares.reduce(f64::max).filter(|share| *share >= LEAST_SHARE).map_or_else(String::new, |share| {
            format!(", so that up to {:.0} % of the load comes in or leaves at once there", 1e2 * share)
        });
        let why = match range_mm[end] > 0.99 * farthest_mm[end] {
            true => ", where the tip circles of both gears part: tips would meet tips",
            false => "",
        };
        ends.push(format!(
            "{:.2} mm of the path {name}{why}, where the flanks would overlap by {:.1} µm{at_once}",
            range_mm[end],
            overlap_mm * UM_PER_MM
        ));
    }
    (!ends.is_empty()).then(|| {
        format!(
            "loaded teeth touch farther outside A to E than this run follows them, up to {}; less operation.pinion_torque_Nm, a stiffer material, \
             or a shorter run keeps them within",
            ends.join(" and ")
        )
    })
}

/// Warning of a run that does not follow tip edges.
fn outside_path(model: &RunModel<'_>, outcome: &Outcome) -> Option<String> {
    let contact = model.scene.contact;
    model.teeth?;
    let [new, worn] =
        [&outcome.new, &outcome.worn].map(|state| overlaps_mm(model.pair, outcome, state, bodies_mm(model), [0.0; 2]));
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
    let [before, after] = [0, 1].map(|end| model.pair.tip_reach_mm(most_mm[end])[end]);
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
