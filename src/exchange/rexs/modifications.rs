//! Modifications of a flank, as far as a scene has them.

use super::RexsError;
use super::document::{MM, MM_AS_UM, RexsComponent, RexsDocument};

/// Modifications of one flank.
#[derive(Debug, Default)]
pub(super) struct Modifications {
    pub tip_relief: Option<RexsRelief>,
    pub root_relief: Option<RexsRelief>,
    pub end_relief: Option<RexsEndRelief>,
    pub profile_crowning_um: Option<f64>,
    pub lead_crowning_um: Option<f64>,
}

#[derive(Debug)]
pub(super) struct RexsRelief {
    pub amount_um: f64,
    pub start: ReliefStart,
    pub form: ReliefForm,
}

/// Shape of a relief.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ReliefForm {
    Linear,
    Parabolic,
    /// Of constant curvature: parabolic to first order in its depth.
    Circular,
}

#[derive(Debug)]
pub(super) enum ReliefStart {
    Diameter(f64),
    RollLength(f64),
}

#[derive(Debug, PartialEq)]
pub(super) struct RexsEndRelief {
    pub amount_um: f64,
    pub length_mm: f64,
    pub form: ReliefForm,
}

/// Where an amount is given, or a crowning is highest: of a scene both are fixed.
const PLACES: [&str; 14] = [
    "tip_relief_evaluation_reference",
    "tip_relief_evaluation_reference_length",
    "root_relief_evaluation_reference",
    "root_relief_evaluation_reference_length",
    "end_relief_evaluation_reference_datum_face",
    "end_relief_evaluation_reference_non_datum_face",
    "diameter_where_profile_crowning_root_is_specified",
    "diameter_where_profile_crowning_tip_is_specified",
    "length_where_profile_crowning_root_is_specified",
    "length_where_profile_crowning_tip_is_specified",
    "coordinate_where_helix_crowning_is_specified_datum_face",
    "coordinate_where_helix_crowning_is_specified_non_datum_face",
    "profile_highest_point",
    "helix_highest_point",
];

/// The modifications of the components that any relation joins with the flank.
pub(super) fn of(
    document: &RexsDocument,
    flank: &RexsComponent,
    gear: &str,
    warnings: &mut Vec<String>,
) -> Result<Modifications, RexsError> {
    let mut found = Modifications::default();
    let mut ends = [None, None];
    let joined = document.relations.iter().filter(|relation| relation.members.iter().any(|(_, id)| *id == flank.id));
    let parts = joined.flat_map(|relation| &relation.members).filter(|(_, id)| *id != flank.id);
    for part in parts.filter_map(|(_, id)| document.component(id)) {
        if let Some(id) = part.first_of(&PLACES) {
            warnings.push(format!(
                "{gear}: {}: {id} is not read: amounts are those at the ends, and a crowning is highest in the middle",
                part.label()
            ));
        }
        add(part, gear, &mut found, &mut ends, warnings)?;
    }
    found.end_relief = match ends {
        [Some(one), Some(other)] if one == other => Some(one),
        [None, None] => None,
        _ => {
            warnings.push(format!(
                "{gear}: end relief is left out: it differs between the ends, and a scene has one for both"
            ));
            None
        }
    };
    Ok(found)
}

/// Adds the modification of a component: to `found`, or an end relief to that of the datum face and of the other.
fn add(
    part: &RexsComponent,
    gear: &str,
    found: &mut Modifications,
    ends: &mut [Option<RexsEndRelief>; 2],
    warnings: &mut Vec<String>,
) -> Result<(), RexsError> {
    match part.kind.as_str() {
        "tip_relief" => {
            let names = ["tip_relief_depth", "tip_relief_datum_diameter", "tip_relief_datum_length"];
            found.tip_relief = relief(part, names, warnings)?;
        }
        "root_relief" => {
            let names = ["root_relief_depth", "root_relief_datum_diameter", "root_relief_datum_length"];
            found.root_relief = relief(part, names, warnings)?;
        }
        "end_relief_datum_face" => {
            let names = ["end_relief_depth_datum_face", "end_relief_length_datum_face"];
            ends[0] = end_relief(part, names, warnings)?;
        }
        "end_relief_non_datum_face" => {
            let names = ["end_relief_depth_non_datum_face", "end_relief_length_non_datum_face"];
            ends[1] = end_relief(part, names, warnings)?;
        }
        "profile_crowning" => {
            let names = ["profile_crowning_at_root", "profile_crowning_at_tip"];
            found.profile_crowning_um = crowning(part, names, warnings)?;
        }
        "helix_crowning" => {
            let names = ["helix_crowning_amount_datum_face", "helix_crowning_amount_non_datum_face"];
            found.lead_crowning_um = crowning(part, names, warnings)?;
        }
        "helix_slope" => warnings.push(format!(
            "{gear}: {} is left out; give helix_slope_deviation_um with the sign of the scene",
            part.label()
        )),
        "profile_slope" | "triangular_tip_relief" | "triangular_root_relief" | "topographical_modification" => {
            warnings.push(format!("{gear}: {} is left out", part.label()));
        }
        _ => {}
    }
    Ok(())
}

/// A relief by the names of its depth, of the diameter and of the length where it begins; None where nothing is removed.
fn relief(
    part: &RexsComponent,
    [depth, diameter, length]: [&'static str; 3],
    warnings: &mut Vec<String>,
) -> Result<Option<RexsRelief>, RexsError> {
    let amount_um = part.needed(depth, MM_AS_UM)?;
    if amount_um == 0.0 {
        return Ok(None);
    }
    let start = match part.number(diameter, MM)? {
        Some(diameter_mm) => ReliefStart::Diameter(diameter_mm),
        None => ReliefStart::RollLength(part.needed(length, MM)?),
    };
    Ok(Some(RexsRelief { amount_um, start, form: form(part, warnings) }))
}

/// An end relief by the names of its depth and length; None where nothing is removed.
fn end_relief(
    part: &RexsComponent,
    [depth, length]: [&'static str; 2],
    warnings: &mut Vec<String>,
) -> Result<Option<RexsEndRelief>, RexsError> {
    let amount_um = part.needed(depth, MM_AS_UM)?;
    if amount_um == 0.0 {
        return Ok(None);
    }
    Ok(Some(RexsEndRelief { amount_um, length_mm: part.needed(length, MM)?, form: form(part, warnings) }))
}

/// The height of a crowning that is given at both ends.
fn crowning(
    part: &RexsComponent,
    ends: [&'static str; 2],
    warnings: &mut Vec<String>,
) -> Result<Option<f64>, RexsError> {
    let [one_um, other_um] = [part.number(ends[0], MM_AS_UM)?, part.number(ends[1], MM_AS_UM)?];
    let height_um = match (one_um, other_um) {
        (Some(one_um), Some(other_um)) => {
            if (one_um - other_um).abs() > 0.01 * one_um.abs().max(other_um.abs()) {
                warnings.push(format!(
                    "{}: {one_um:.2} and {other_um:.2} µm at its ends; the mean is taken, highest in the middle",
                    part.label()
                ));
            }
            0.5 * (one_um + other_um)
        }
        (one_um, other_um) => one_um.or(other_um).ok_or_else(|| part.missing(ends[0]))?,
    };
    Ok(Some(height_um).filter(|&height_um| height_um != 0.0))
}

fn form(part: &RexsComponent, warnings: &mut Vec<String>) -> ReliefForm {
    match part.text("shape_of_relief") {
        Some("parabolic") => ReliefForm::Parabolic,
        Some("circular") => ReliefForm::Circular,
        Some("linear") | None => ReliefForm::Linear,
        Some(other) => {
            warnings.push(format!(
                "{}: shape {other:?} is taken as linear; a scene has linear and parabolic",
                part.label()
            ));
            ReliefForm::Linear
        }
    }
}
