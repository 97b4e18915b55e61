//! The slices over the face width, where sections differ.

use crate::contact::settings::SurfaceKind;
use crate::gear::spec::PairSpec;
use crate::mesh_cycle::settings::SliceSettings;
use crate::scene::file::HelicalFile;
use crate::scene::findings::Findings;

const SLICES: u32 = 20;

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
    Some(SliceSettings {
        count: *file.slices.get_or_insert(SLICES) as usize,
        coupling: *file.coupling.get_or_insert_default(),
    })
}
