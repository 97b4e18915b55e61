//! Key and remedy of an impossible internal pair.

use gearwear_bodies::gear::internal_error::InternalError;
use gearwear_bodies::gear::{Gear, GearPair};

use super::geometry::{Cause, ErrorPlace, at_least, at_most};
use crate::scene::findings::Findings;
use crate::scene::problem::number;

const CUTTER: &str = "pair.wheel.cutter";

/// Warns of an internal pair that can be assembled along its axis alone, and of a tip that the pinion's fillet alone leaves room for.
pub(super) fn warn(pair: &GearPair, findings: &mut Findings) {
    if let Some(of) = pair.involute_interference() {
        findings.warnings.push(format!(
            "pair: z1/z2 = {:.4} is less than 1 − tan α_a2/tan α_wt = {:.4} (involute interference): the wheel's tip circle of {:.4} mm, below {:.4} mm, \
             enters the pinion's root, whose fillet leaves room for it",
            of.ratio, of.limit, of.tip_diameter_mm, of.least_tip_diameter_mm
        ));
    }
    if let Some(clearance_mm) = pair.radial_assembly_clearance_mm().filter(|&clearance_mm| clearance_mm < 0.0) {
        findings.warnings.push(format!(
            "pair: the pinion can be put into the wheel along its axis alone: moved in along the line of centres, tips would overlap by {:.3} mm \
             (trimming interference)",
            -clearance_mm
        ));
    }
}

impl ErrorPlace<'_> {
    /// Where to mend an internal pair, and how.
    pub(super) fn of_internal(&self, error: &InternalError) -> Cause {
        match *error {
            InternalError::Teeth { pinion, wheel } => Cause {
                key: "pair.wheel.teeth".to_owned(),
                found: wheel.to_string(),
                allowed: format!("more than the {pinion} teeth of the pinion"),
                help: "an internal wheel holds its pinion".to_owned(),
            },
            InternalError::NoMesh { least_mm, .. } => {
                self.centre_distance(least_mm, "check centre distance, module and numbers of teeth")
            }
            InternalError::NegativeBacklash { greatest_mm, .. } => {
                let (key, found) = self.centre();
                Cause {
                    key: key.to_owned(),
                    found,
                    allowed: format!("a centre distance of at most {} mm", at_most(greatest_mm)),
                    help: "or smaller profile shifts, which are positive where they thicken a tooth, of the wheel too".to_owned(),
                }
            }
            InternalError::TipInsideBase { tip_diameter_mm, base_diameter_mm } => {
                self.ring_tip(tip_diameter_mm, at_least(base_diameter_mm), "the base circle, inside which there is no involute")
            }
            InternalError::TipBeyondForm { tip_diameter_mm, form_diameter_mm } => Cause {
                allowed: format!("a tip diameter of the wheel below its form circle, {} mm", at_most(form_diameter_mm)),
                ..self.ring_tip(tip_diameter_mm, form_diameter_mm, "the form circle")
            },
            InternalError::InvoluteInterference { of, .. } => self.ring_tip(
                of.tip_diameter_mm,
                at_least(of.least_tip_diameter_mm),
                "where the tip touches the pinion at its base circle",
            ),
            InternalError::CutterCutsTips { tip_diameter_mm, least_mm } => {
                self.ring_tip(tip_diameter_mm, at_least(least_mm), "below which the cutter leaves no involute")
            }
            InternalError::TrochoidalInterference { greatest_pinion_tip_mm, .. } => Cause {
                allowed: format!(
                    "a tip diameter of the pinion of at most {} mm, beside which the tips pass",
                    at_most(greatest_pinion_tip_mm)
                ),
                ..self.tip(
                    (Gear::Pinion, 2.0 * self.spec.tip_radius_mm(Gear::Pinion)),
                    String::new(),
                    "a larger pair.wheel.tip_diameter_mm, a greater difference of the numbers of teeth or a larger pressure angle help too",
                )
            },
            InternalError::CutterTeeth { teeth, most } => cutter("teeth", teeth.to_string(), format!("at most {most}")),
            InternalError::CutterShift { profile_shift, greatest } => {
                let [found, most] = [profile_shift, greatest].map(|shift| shift / self.factor_scale);
                cutter("profile_shift", number(found), format!("less than {}", at_most(most)))
            }
            InternalError::CutterAddendum { addendum_factor, least_factor, .. } => {
                let [found, least] = [addendum_factor, least_factor].map(|factor| factor / self.factor_scale);
                cutter("addendum_factor", number(found), format!("more than {}", at_least(least)))
            }
            InternalError::CutterTip { tip_rounding_factor, greatest } => {
                let [found, most] = [tip_rounding_factor, greatest].map(|factor| factor / self.factor_scale);
                cutter("tip_rounding_factor", number(found), format!("at most {}", at_most(most)))
            }
            InternalError::Root { root_diameter_mm, least_mm, greatest_mm } => Cause {
                key: match self.findings.is_in_file("pair.wheel.root_diameter_mm") {
                    true => "pair.wheel.root_diameter_mm".to_owned(),
                    false => "pair.wheel.profile_shift".to_owned(),
                },
                found: format!("root diameter {} mm", number(at_least(root_diameter_mm))),
                allowed: format!("a root diameter between {} and {} mm", at_least(least_mm), at_most(greatest_mm)),
                help: "between base circle and the circle on which the flanks of a space meet".to_owned(),
            },
        }
    }

    /// A tip diameter of the internal wheel that is too small.
    fn ring_tip(&self, tip_diameter_mm: f64, least_mm: f64, what: &str) -> Cause {
        let allowed = format!("a tip diameter of the wheel of at least {least_mm} mm, {what}");
        let help =
            "give pair.wheel.tip_diameter_mm, or a smaller profile shift of the wheel, positive towards its tips";
        self.tip((Gear::Wheel, tip_diameter_mm), allowed, help)
    }
}

fn cutter(name: &str, found: String, allowed: String) -> Cause {
    Cause { key: format!("{CUTTER}.{name}"), found, allowed, help: "the cutter generates the wheel's teeth".to_owned() }
}
