//! Reports errors of the gear pair at the key to change.

use super::{centre_distance, internal_geometry};
use crate::scene::findings::Findings;
use crate::scene::problem::{ProblemKind, number};
use gearwear_bodies::gear::pair::{GearPair, MEASURED_FLANK};
use gearwear_bodies::gear::spec::PairSpec;
use gearwear_bodies::gear::tip_chamfer::TipChamfer;
use gearwear_bodies::gear::{Gear, PairError};
use gearwear_physics::mesh_cycle::settings::SliceSettings;

/// Key of a geometry error, and its remedy.
pub(super) struct Cause {
    pub key: String,
    pub found: String,
    pub allowed: String,
    pub help: String,
}

/// Derives the pair and reports why that is impossible, if it is, or why its slices leave a position without contact.
pub(super) fn check(spec: &PairSpec, slices: Option<SliceSettings>, findings: &mut Findings) -> Option<GearPair> {
    match GearPair::new(spec) {
        Ok(pair) => {
            internal_geometry::warn(&pair, findings);
            if let Some(slices) = slices {
                check_slices(&pair, slices.count, findings);
            }
            Some(pair)
        }
        Err(error) => {
            let Cause { key, found, allowed, help } = place(&error, spec, findings);
            findings.problem(ProblemKind::Geometry(error), &key, found, allowed);
            findings.help(help);
            None
        }
    }
}

/// Greatest number of teeth side by side over a face width.
const GREATEST_OVERLAP: f64 = 1000.0;

/// Checks the slices: the middles of the outermost ones are (n − 1)/n of the face width apart, and have that part of the overlap.
fn check_slices(pair: &GearPair, count: usize, findings: &mut Findings) {
    let (contact_ratio, overlap_ratio) = (pair.path.contact_ratio(), pair.overlap_ratio());
    if overlap_ratio > GREATEST_OVERLAP {
        let found = format!("{}, overlap ratio {overlap_ratio:.0}", number(pair.spec.face_width_mm));
        let allowed = format!("an overlap ratio of at most {GREATEST_OVERLAP}");
        findings.not_allowed("pair.face_width_mm", found, allowed);
        return;
    }
    let of_slices = overlap_ratio * (count as f64 - 1.0) / count as f64;
    if contact_ratio + of_slices < 1.0 {
        let least = overlap_ratio / (contact_ratio + overlap_ratio - 1.0);
        let allowed = format!("at least {} slices", least.ceil());
        findings.not_allowed("helical.slices", count.to_string(), allowed);
        findings.help("with so few slices none of them is in contact at some position");
    }
}

/// Finder of the key that causes an error of the geometry.
pub(super) struct ErrorPlace<'a> {
    pub spec: &'a PairSpec,
    pub findings: &'a Findings,
    /// Ratio of a factor in the file, of the module given there, to the factor of the normal module.
    pub factor_scale: f64,
}

fn place(error: &PairError, spec: &PairSpec, findings: &Findings) -> Cause {
    let is_transverse = findings.is_in_file("pair.transverse_module_mm");
    let factor_scale = if is_transverse { 1.0 / spec.helix_angle_rad.cos() } else { 1.0 };
    let place = ErrorPlace { spec, findings, factor_scale };
    match *error {
        PairError::NoMesh { least_mm, .. } => {
            place.centre_distance(least_mm, "check centre distance, module and numbers of teeth")
        }
        PairError::NegativeBacklash { least_mm, .. } => place.centre_distance(
            least_mm,
            "or smaller profile shifts, or thinner teeth by a negative tooth_thickness_allowance_um on a gear",
        ),
        PairError::ContactRatioBelowOne { contact_ratio, overlap_ratio } => {
            place.contact_ratio(contact_ratio, overlap_ratio)
        }
        PairError::PointedTooth { gear, tip_diameter_mm, pointed_diameter_mm, .. } => place.tip(
            (gear, tip_diameter_mm),
            match pointed_diameter_mm < 0.0 {
                true => format!("a tip diameter above {} mm, where the flanks meet", at_least(-pointed_diameter_mm)),
                false => format!("a tip diameter below {} mm, where the flanks meet", at_most(pointed_diameter_mm)),
            },
            &format!("give {} or a smaller profile shift", key_of(gear, "tip_diameter_mm")),
        ),
        PairError::TipBelowForm { gear, tip_diameter_mm, form_diameter_mm } => place.tip(
            (gear, tip_diameter_mm),
            format!("a tip diameter above the form circle, {} mm", at_least(form_diameter_mm)),
            "a larger centre distance leaves more of a tip that follows from the rack, less profile shift of its mate too",
        ),
        PairError::Internal(ref error) => place.of_internal(error),
        PairError::Interference { gear, greatest_tip_diameter_mm, .. } => {
            place.interference(gear, greatest_tip_diameter_mm)
        }
        PairError::NoTipClearance { gear, clearance_mm } => place.tip_clearance(gear, clearance_mm),
        PairError::RackPointed { greatest_dedendum_factor } => place.rack(
            "dedendum_factor",
            (spec.rack.dedendum_factor, greatest_dedendum_factor),
            "or a smaller pressure angle; the root fillet that a dedendum factor leaves room for grows as it falls below that",
        ),
        PairError::RackTipPointed { greatest } => place.rack(
            "fillet_radius_factor",
            (spec.rack.fillet_radius_factor, greatest),
            "or a smaller pair.basic_rack.dedendum_factor",
        ),
        PairError::NoTooth { gear } => place.no_tooth(gear),
        PairError::BoreTooLarge { gear, bore_diameter_mm, root_diameter_mm } => Cause {
            key: key_of(gear, "bore_diameter_mm"),
            found: number(bore_diameter_mm),
            allowed: format!("less than the root diameter, {} mm", at_most(root_diameter_mm)),
            help: "leave the bore out where it does not matter".to_owned(),
        },
        PairError::ModificationTooLong { gear, modification, length_mm, available_mm } => {
            too_long(gear, modification, length_mm, available_mm)
        }
        PairError::ModificationTooDeep { gear, modification, amount_mm, greatest_mm } => {
            place.too_deep(gear, modification, amount_mm, greatest_mm)
        }
        PairError::AxesTooFarFromParallel { slope_mm, greatest_mm } => axes(slope_mm, greatest_mm),
        PairError::TipRoundingTooLarge { gear, radius_mm, greatest_mm } => tip_rounding(gear, radius_mm, greatest_mm),
        PairError::TipChamferTooLarge { gear, height_mm, greatest_mm } => Cause {
            key: key_of(gear, "tip_chamfer_mm"),
            found: number(height_mm),
            allowed: format!("at most {} mm", at_most(greatest_mm)),
            help: "the chamfers of both flanks must leave a tip land, and some flank above the form circle".to_owned(),
        },
        PairError::TipChamferAngle { gear, angle_deg, least_deg, greatest_deg } => Cause {
            key: key_of(gear, "tip_chamfer_deg"),
            found: number(angle_deg),
            allowed: format!("at least {:.2} and at most {}", (1e2 * least_deg).ceil() / 1e2, number(greatest_deg)),
            help: "degrees between the chamfer and the radius; the flank’s own angle there and 5° more is the least".to_owned(),
        },
    }
}

fn key_of(gear: Gear, name: &str) -> String {
    format!("pair.{}.{name}", gear.name())
}

fn tip_found(gear: Gear, tip_mm: f64) -> String {
    format!("tip diameter {} of the {}", short(tip_mm), gear.name())
}

fn tip_rounding(gear: Gear, radius_mm: f64, greatest_mm: f64) -> Cause {
    Cause {
        key: key_of(gear, "tip_rounding_mm"),
        found: number(radius_mm),
        allowed: format!("at most {} mm", at_most(greatest_mm)),
        help: "the roundings of both flanks must fit on the tip or its chamfers, and leave some active flank"
            .to_owned(),
    }
}

fn axes(slope_mm: f64, greatest_mm: f64) -> Cause {
    Cause {
        key: "pair.axis_parallelism".to_owned(),
        found: format!("a helix slope of {:.0} µm over the face width", 1e3 * slope_mm),
        allowed: format!("at most {} µm, a quarter of the module", at_most(1e3 * greatest_mm)),
        help: "deviations are in µm, over over_length_mm where that is given".to_owned(),
    }
}

fn too_long(gear: Gear, modification: &str, length_mm: f64, available_mm: f64) -> Cause {
    let help = match modification {
        "end relief" => "it begins at either end of the face width, and ends before its middle",
        _ => "lengths are roll lengths, along the path of contact",
    };
    Cause {
        key: key_of(gear, &format!("{}.length_mm", modification.replace(' ', "_"))),
        found: number(length_mm),
        allowed: format!("at most {} mm", at_most(available_mm)),
        help: help.to_owned(),
    }
}

impl ErrorPlace<'_> {
    /// Key of the tip, where the file gives it, else of the profile shift.
    fn tip_key(&self, gear: Gear) -> String {
        let tip = key_of(gear, "tip_diameter_mm");
        let is_given = self.spec.gears[gear].tip_diameter_mm.is_some() && self.findings.is_in_file(&tip);
        if is_given { tip } else { key_of(gear, "profile_shift") }
    }

    /// Key and meaning of the centre distance; the backlash where it follows from that.
    pub(super) fn centre(&self) -> (&'static str, String) {
        let key = centre_distance::KEYS.into_iter().find(|key| self.findings.is_in_file(key));
        match key.unwrap_or("pair.centre_distance_mm") {
            key @ "pair.centre_distance_mm" => (key, number(self.spec.centre_distance_mm.abs())),
            key => (key, format!("a backlash that gives centre distance {}", short(self.spec.centre_distance_mm))),
        }
    }

    pub(super) fn centre_distance(&self, least_mm: f64, help: &str) -> Cause {
        let (key, found) = self.centre();
        let allowed = format!("a centre distance of at least {} mm", at_least(least_mm));
        Cause { key: key.to_owned(), found, allowed, help: help.to_owned() }
    }

    /// The higher of the tip chamfers, where there are any.
    fn highest_chamfer(&self) -> Option<(Gear, TipChamfer)> {
        let given = Gear::BOTH.into_iter().filter_map(|gear| Some((gear, self.spec.tip_chamfer(gear)?)));
        given.max_by(|(_, a), (_, b)| a.height_mm.total_cmp(&b.height_mm))
    }

    fn contact_ratio(&self, contact_ratio: f64, overlap_ratio: f64) -> Cause {
        if overlap_ratio > 0.0 {
            let width = number(self.spec.face_width_mm);
            return Cause {
                key: "pair.face_width_mm".to_owned(),
                found: format!("{width}, transverse contact ratio {contact_ratio:.4}, overlap ratio {overlap_ratio:.4}"),
                allowed: "contact ratios that together are at least 1, the transverse one above 0".to_owned(),
                help: "a larger face width or helix angle raises the overlap; larger tip diameters or a smaller centre distance \
                       raise the transverse contact ratio"
                    .to_owned(),
            };
        }
        let (key, found) = self.centre();
        if let Some((gear, chamfer)) = self.highest_chamfer() {
            return Cause {
                key: key_of(gear, "tip_chamfer_mm"),
                found: format!("{}, contact ratio {contact_ratio:.4}", number(chamfer.height_mm)),
                allowed: "a transverse contact ratio of at least 1".to_owned(),
                help: "chamfers end the flanks; lower ones raise it".to_owned(),
            };
        }
        Cause {
            key: key.to_owned(),
            found: format!("{found}, contact ratio {contact_ratio:.4}"),
            allowed: "a transverse contact ratio of at least 1".to_owned(),
            help: "a smaller centre distance, larger tip diameters, more teeth or a smaller pressure angle raise it"
                .to_owned(),
        }
    }

    fn interference(&self, gear: Gear, greatest_tip_diameter_mm: f64) -> Cause {
        let mate = gear.mate();
        Cause {
            key: match self.tip_key(mate) {
                tip if tip.ends_with("tip_diameter_mm") => tip,
                _ => key_of(gear, "profile_shift"),
            },
            found: match self.spec.gears[mate].tip_diameter_mm {
                Some(tip_mm) => tip_found(mate, tip_mm),
                None => format!("profile shift {}", of_file(self.spec.gears[gear].profile_shift, self.factor_scale)),
            },
            allowed: format!(
                "a tip diameter of the {} of {}, which leaves the root fillet of the {} alone",
                mate.name(),
                inside(greatest_tip_diameter_mm),
                gear.name()
            ),
            help: format!(
                "a {} {}, a larger {} or more teeth on the {}",
                if greatest_tip_diameter_mm < 0.0 { "larger" } else { "smaller" },
                key_of(mate, "tip_diameter_mm"),
                key_of(gear, "profile_shift"),
                gear.name()
            ),
        }
    }

    pub(super) fn tip(&self, (gear, tip_diameter_mm): (Gear, f64), allowed: String, help: &str) -> Cause {
        Cause { key: self.tip_key(gear), found: tip_found(gear, tip_diameter_mm), allowed, help: help.to_owned() }
    }

    fn no_tooth(&self, gear: Gear) -> Cause {
        Cause {
            key: key_of(gear, "profile_shift"),
            found: of_file(self.spec.gears[gear].profile_shift, self.factor_scale),
            allowed: "a profile shift that leaves a flank above the base circle".to_owned(),
            help: format!("a larger profile shift or more teeth on the {}", gear.name()),
        }
    }

    fn tip_clearance(&self, gear: Gear, clearance_mm: f64) -> Cause {
        Cause {
            key: self.tip_key(gear),
            found: self.spec.gears[gear]
                .tip_diameter_mm
                .map_or_else(|| "a tip from the rack".to_owned(), |tip_mm| number(tip_mm.abs())),
            allowed: format!(
                "a tip diameter of {}, beyond which it reaches the root circle of the {}",
                inside(2.0 * (self.spec.tip_radius_mm(gear) + clearance_mm)),
                gear.mate().name()
            ),
            help: match self.spec.is_internal() {
                true => "or a smaller centre distance, or a larger pair.basic_rack.dedendum_factor".to_owned(),
                false => "or a larger centre distance, or a larger pair.basic_rack.dedendum_factor".to_owned(),
            },
        }
    }

    fn rack(&self, name: &str, (found, greatest): (f64, f64), help: &str) -> Cause {
        Cause {
            key: format!("pair.basic_rack.{name}"),
            found: of_file(found, self.factor_scale),
            allowed: format!("at most {}", at_most(greatest / self.factor_scale)),
            help: help.to_owned(),
        }
    }

    fn too_deep(&self, gear: Gear, modification: &str, amount_mm: f64, greatest_mm: f64) -> Cause {
        let name = match modification {
            "helix slope deviation" if self.findings.is_in_file(&key_of(gear, "helix_slope_class")) => {
                "helix_slope_class".to_owned()
            }
            crowning @ ("profile crowning" | "lead crowning" | "helix slope deviation") => {
                format!("{}_um", crowning.replace(' ', "_"))
            }
            MEASURED_FLANK => "initial_flank".to_owned(),
            relief => format!("{}.amount_um", relief.replace(' ', "_")),
        };
        Cause {
            key: key_of(gear, &name),
            found: number(1e3 * amount_mm),
            allowed: format!("at most {} µm, a quarter of the module", at_most(1e3 * greatest_mm)),
            help: "amounts are in µm".to_owned(),
        }
    }
}

/// A limit that a value may reach, to four digits and within the true one.
pub(super) fn at_most(limit: f64) -> f64 {
    (limit * 1e4).floor() / 1e4
}

/// A limit that a value must reach, to four digits and within the true one.
pub(super) fn at_least(limit: f64) -> f64 {
    (limit * 1e4).ceil() / 1e4
}

/// Limit of a tip diameter, which is negative of an internal gear.
fn inside(diameter_mm: f64) -> String {
    match diameter_mm < 0.0 {
        true => format!("at least {} mm", at_least(-diameter_mm)),
        false => format!("at most {} mm", at_most(diameter_mm)),
    }
}

/// Factor of the normal module in terms of the file, without the digits of the conversion.
fn of_file(factor: f64, factor_scale: f64) -> String {
    number((factor / factor_scale * 1e10).round() / 1e10)
}

/// Derived length without rounding errors, as on a drawing.
fn short(length_mm: f64) -> String {
    format!("{} mm", (length_mm.abs() * 1e4).round() / 1e4)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Resolved;
    use crate::scene::locate::Locator;
    use crate::scene::presets;

    /// Errors of the pair and of its teeth, with the key of each.
    fn errors_of_pair() -> Vec<(PairError, &'static str)> {
        let gear = Gear::Pinion;
        let tip = "pair.pinion.tip_diameter_mm";
        let pointed = (-0.1, 92.0, 91.0);
        let (tip_thickness_mm, tip_diameter_mm, pointed_diameter_mm) = pointed;
        vec![
            (PairError::NoMesh { centre_distance_mm: 80.0, least_mm: 84.5723 }, "pair.centre_distance_mm"),
            (
                PairError::NegativeBacklash { backlash_mm: -0.4, centre_distance_mm: 91.0, least_mm: 91.5 },
                "pair.centre_distance_mm",
            ),
            (PairError::ContactRatioBelowOne { contact_ratio: 0.75, overlap_ratio: 0.0 }, "pair.centre_distance_mm"),
            (PairError::PointedTooth { gear, tip_thickness_mm, tip_diameter_mm, pointed_diameter_mm }, tip),
            (PairError::Interference { gear: Gear::Wheel, overlap_mm: 0.1, greatest_tip_diameter_mm: 82.0 }, tip),
            (PairError::TipBelowForm { gear, tip_diameter_mm: 67.0, form_diameter_mm: 67.7 }, tip),
            (PairError::NoTipClearance { gear, clearance_mm: -0.5 }, tip),
            (PairError::RackPointed { greatest_dedendum_factor: 1.1216 }, "pair.basic_rack.dedendum_factor"),
            (PairError::RackTipPointed { greatest: 0.47 }, "pair.basic_rack.fillet_radius_factor"),
            (PairError::NoTooth { gear }, "pair.pinion.profile_shift"),
            (
                PairError::BoreTooLarge { gear, bore_diameter_mm: 70.0, root_diameter_mm: 62.386 },
                "pair.pinion.bore_diameter_mm",
            ),
            (PairError::AxesTooFarFromParallel { slope_mm: 2.0, greatest_mm: 1.1 }, "pair.axis_parallelism"),
        ]
    }

    /// Errors of modifications, with the key of each.
    fn errors_of_modifications() -> Vec<(PairError, &'static str)> {
        let gear = Gear::Pinion;
        let [relief, crowning] = ["tip relief", "profile crowning"];
        let (length_mm, available_mm, amount_mm, greatest_mm) = (30.0, 19.1, 2.0, 1.1);
        vec![
            (
                PairError::ModificationTooLong { gear, modification: relief, length_mm, available_mm },
                "pair.pinion.tip_relief.length_mm",
            ),
            (
                PairError::ModificationTooDeep { gear, modification: crowning, amount_mm, greatest_mm },
                "pair.pinion.profile_crowning_um",
            ),
            (
                PairError::ModificationTooDeep { gear, modification: relief, amount_mm, greatest_mm },
                "pair.pinion.tip_relief.amount_um",
            ),
            (PairError::TipRoundingTooLarge { gear, radius_mm: 2.7, greatest_mm: 2.6 }, "pair.pinion.tip_rounding_mm"),
            (PairError::TipChamferTooLarge { gear, height_mm: 2.7, greatest_mm: 2.6 }, "pair.pinion.tip_chamfer_mm"),
            (
                PairError::TipChamferAngle { gear, angle_deg: 20.0, least_deg: 35.0, greatest_deg: 80.0 },
                "pair.pinion.tip_chamfer_deg",
            ),
        ]
    }

    /// Every geometry error lands at a key of the scene, in the preset's own text and beside a preset.
    #[test]
    fn every_error_has_its_key() {
        let text = presets::PRESETS[0].text;
        let spec = Resolved::from_toml(text).unwrap().scene.pair;
        let findings = Findings::new(Locator::new(text).unwrap());
        let beside_preset = Findings::new(Locator::new("pair.preset = \"fzg-c\"").unwrap());
        for (error, key) in errors_of_pair().into_iter().chain(errors_of_modifications()) {
            assert_eq!(place(&error, &spec, &findings).key, key);
            let mended = if let PairError::Interference { .. } = error { "wheel" } else { "pinion" };
            let key = key.replace("pinion.tip_diameter_mm", &format!("{mended}.profile_shift"));
            assert_eq!(place(&error, &spec, &beside_preset).key, key);
        }
    }
}
