//! The slices over the face width, where sections differ.

use crate::scene::fem_file::{BodyKind, FemFile, WebsFile};
use crate::scene::file::{SceneFile, StiffnessModel};
use crate::scene::findings::Findings;
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_physics::contact::settings::SurfaceKind;
use gearwear_physics::mesh_cycle::settings::MOST_SLICES_IN_SPACE;
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};

const SLICES: u32 = 20;

/// Whether a gear has a web.
pub(super) fn has_web(fem: Option<&FemFile>) -> bool {
    fem.and_then(|fem| fem.web.as_ref()).is_some_and(WebsFile::has_one)
}

/// Chooses the slices of `pair`; none where all its transverse sections are alike.
pub(super) fn choose(
    file: &mut SceneFile,
    pair: &PairSpec,
    surface: Option<SurfaceKind>,
    findings: &mut Findings,
) -> Option<SliceSettings> {
    let stiffness = file.stiffness.as_ref().and_then(|stiffness| stiffness.model);
    let body = file.fem.as_ref().and_then(|fem| fem.body);
    let has_web = has_web(file.fem.as_ref());
    let file = &mut file.helical;
    if pair.is_alike_over_width() && !has_web {
        if file.is_some() {
            let because = "without a helix angle, a modification over the face width or a web all sections are alike";
            findings.unused("[helical]", because);
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
    let count = *file.slices.get_or_insert(SLICES);
    // The default differs where the gears cannot be meshed in three dimensions, and is not written into the file.
    let in_space = count as usize <= MOST_SLICES_IN_SPACE
        && stiffness.is_none_or(|model| model == StiffnessModel::Fem)
        && body != Some(BodyKind::Sector);
    let coupling = match in_space {
        true => file.coupling.unwrap_or(Coupling::Fem),
        false => *file.coupling.get_or_insert(Coupling::Slicing),
    };
    let couples_all = match coupling {
        Coupling::Fem => Some("helical.coupling = \"fem\""),
        Coupling::None | Coupling::Slicing => pair.has_shafts().then_some("a shaft that twists"),
    };
    if let Some(what) = couples_all.filter(|_| count as usize > MOST_SLICES_IN_SPACE) {
        findings.not_allowed(
            "helical.slices",
            format!("{count} with {what}"),
            format!(
                "at most {MOST_SLICES_IN_SPACE}: every slice in contact is coupled with every other at every position"
            ),
        );
    }
    Some(SliceSettings { count: count as usize, coupling })
}
