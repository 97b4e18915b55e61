//! The slices over the face width, where sections differ.

use crate::contact::settings::SurfaceKind;
use crate::gear::spec::PairSpec;
use crate::mesh_cycle::settings::{Coupling, SliceSettings};
use crate::scene::file::HelicalFile;
use crate::scene::findings::Findings;

const SLICES: u32 = 20;
/// Most slices that are coupled each with each: 400 positions then take less than 0.5 GB.
const MOST_SLICES_IN_SPACE: u32 = 100;

/// Chooses the slices of `pair`; none where all its transverse sections are alike.
pub(super) fn choose(
    file: &mut Option<HelicalFile>,
    pair: &PairSpec,
    surface: Option<SurfaceKind>,
    findings: &mut Findings,
) -> Option<SliceSettings> {
    if pair.is_alike_over_width() {
        if file.is_some() {
            findings.warnings.push(
                "[helical] is not used: without a helix angle or a modification over the face width all sections are alike"
                    .to_owned(),
            );
        }
        return None;
    }
    if surface == Some(SurfaceKind::Fem) {
        findings.not_allowed(
            "contact.surface",
            "\"fem\" with sections that differ over the face width",
            "\"winkler\", \"half-space\", \"hertz\" or \"hertz-mean\", which work slice by slice",
        );
        findings.help(
            "the finite elements are plane: they calibrate the slices (gearwear calibrate), but are no slices themselves",
        );
    }
    let file = file.get_or_insert_default();
    let (count, coupling) = (*file.slices.get_or_insert(SLICES), *file.coupling.get_or_insert_default());
    if coupling == Coupling::Fem && count > MOST_SLICES_IN_SPACE {
        findings.not_allowed(
            "helical.slices",
            format!("{count} with helical.coupling = \"fem\""),
            format!(
                "at most {MOST_SLICES_IN_SPACE}: every slice in contact is coupled with every other at every position"
            ),
        );
    }
    Some(SliceSettings { count: count as usize, coupling })
}
