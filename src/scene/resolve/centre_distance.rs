//! The centre distance, as given or from the backlash.

use crate::scene::file::PairFile;
use crate::scene::findings::Findings;
use crate::scene::{presets, problem::number};
use gearwear_bodies::gear::backlash::{Backlash, NoSuchBacklash};
use gearwear_bodies::gear::spec::PairSpec;

/// Alternative keys, one of which is given.
pub(super) const KEYS: [&str; 3] = ["pair.centre_distance_mm", "pair.backlash_um", "pair.normal_backlash_um"];

const UM: f64 = 1e-3;

/// Centre distance as the file gives it.
#[derive(Debug, Clone, Copy)]
pub(super) enum CentreDistance {
    Given { centre_distance_mm: f64 },
    Leaves { key: &'static str, backlash: Backlash },
}

/// Centre distance as the file gives it; `None` where it does not, or twice.
pub(super) fn given(file: &PairFile, findings: &mut Findings) -> Option<CentreDistance> {
    let [centre, circumferential, normal] = KEYS;
    match (file.centre_distance_mm, file.backlash_um, file.normal_backlash_um) {
        (Some(centre_distance_mm), None, None) => Some(CentreDistance::Given { centre_distance_mm }),
        (None, Some(um), None) => {
            Some(CentreDistance::Leaves { key: circumferential, backlash: Backlash::Circumferential(UM * um) })
        }
        (None, None, Some(um)) => Some(CentreDistance::Leaves { key: normal, backlash: Backlash::Normal(UM * um) }),
        (None, None, None) => {
            findings.missing(&[centre, presets::KEY], "a number greater than 0");
            findings.help(format!("{circumferential} = 0 or {normal} = 0 is a pair without backlash"));
            None
        }
        (distance, j_wt, j_bn) => {
            findings.said_twice(&[
                (centre, distance.is_some()),
                (circumferential, j_wt.is_some()),
                (normal, j_bn.is_some()),
            ]);
            None
        }
    }
}

/// The centre distance of `spec`, which has all else, negative of an internal pair; written into the file as positive.
pub(super) fn choose(
    given: CentreDistance,
    file: &mut PairFile,
    spec: &PairSpec,
    findings: &mut Findings,
) -> Option<f64> {
    let centre_distance_mm = match given {
        CentreDistance::Given { centre_distance_mm } if spec.is_internal() => -centre_distance_mm,
        CentreDistance::Given { centre_distance_mm } => centre_distance_mm,
        CentreDistance::Leaves { key, backlash } => match spec.centre_distance_with_mm(backlash) {
            Ok(centre_distance_mm) => centre_distance_mm,
            Err(NoSuchBacklash::TeethTooThick { greatest_mm }) => {
                let (Backlash::Circumferential(found_mm) | Backlash::Normal(found_mm)) = backlash;
                let allowed = format!("less than {:.1}", (10.0 * greatest_mm / UM).floor() / 10.0);
                findings.not_allowed(key, number(found_mm / UM), allowed);
                findings.help(
                    "an internal pair has its greatest backlash where its base circles touch: check profile shifts",
                );
                return None;
            }
            Err(NoSuchBacklash::TeethTooThin { least_mm }) => {
                let (Backlash::Circumferential(found_mm) | Backlash::Normal(found_mm)) = backlash;
                let allowed = format!("more than {:.1}", (10.0 * least_mm / UM).ceil() / 10.0);
                findings.not_allowed(key, number(found_mm / UM), allowed);
                findings.help("such thin teeth have as much at any centre distance: check profile shifts and tooth_thickness_allowance_um");
                return None;
            }
        },
    };
    (file.centre_distance_mm, file.backlash_um, file.normal_backlash_um) = (Some(centre_distance_mm.abs()), None, None);
    Some(centre_distance_mm)
}
