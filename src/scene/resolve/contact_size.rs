//! Loads whose contact is not narrow: a strip that is wide beside the radius of curvature of the flanks.
//!
//! Every surface approximates the flanks by parabolas of relative radius R and takes strains to be small. Both rest on
//! the half-width a of the contact being small beside R, and Hertz's contact says so in one number, since p₀/E* = a/(2R).
//! At C under the whole load,
//!
//! ```text
//! Hertz     a² = 4 w R / (π E*)            foundation given by hand     a³ = 3 w R / (2 K/H)
//! ```
//!
//! From a = R/10 on (a mean strain of some 5 %) the scene comes with a warning. It is not refused: soft materials and huge loads
//! may be meant, and the equilibrium of such a contact can still be found. From a = 100 R on, and below the size of an atom, it is:
//! teeth of that pair are smaller than their contact, or the contact than what they are made of, and what is computed of it is
//! digits that mean nothing. Source: K. L. Johnson, *Contact Mechanics* (1985), sections 4.1 to 4.3.

use crate::scene::findings::Findings;
use crate::scene::problem::number;
use gearwear_bodies::gear::conjugate::ConjugateFlanks;
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_physics::contact::{foundation, hertz, settings::Foundation};
use gearwear_physics::operation::Scene;

/// Greatest half-width over relative radius with small strains.
const GREATEST_SMALL: f64 = 0.1;
/// Greatest plausible half-width over relative radius: it is 5 under 10⁷ N·m on FZG type C, 13 with rubber of 1 MPa.
const GREATEST_MEANT: f64 = 100.0;
/// Least plausible half-width, mm: the size of an atom.
const LEAST_MEANT_MM: f64 = 1e-7;
/// Usual values of steel gears: Young's modulus in MPa, line load in N/mm, face width in modules. The key furthest from them is the likely error.
const USUAL: (f64, f64, f64) = (206e3, 500.0, 10.0);

/// Ratio to the usual value, or its inverse, from which a key other than the torque is reported as the cause.
const CLEARLY_OFF: f64 = 1e3;

/// Half the width of a contact of the scene, and what decides it.
struct Contact {
    /// The key that the user changes.
    key: String,
    /// Value, as the file gives it.
    value: f64,
    /// Name in messages.
    name: &'static str,
    half_width_mm: f64,
}

/// Refuses contacts of `pair` at the pitch point of implausible size, and warns of those that are not narrow: of loads, and of foundations given by
/// hand.
pub(super) fn check(scene: &Scene, pair: &GearPair, findings: &mut Findings) {
    let radius_mm = pair.normal_section().relative_radius_mm(pair.path.pitch_point_mm);
    let contacts = contacts(scene, pair, findings);
    let meant_mm = LEAST_MEANT_MM..=GREATEST_MEANT * radius_mm;
    let outside = contacts.iter().find(|contact| !meant_mm.contains(&contact.half_width_mm));
    if let Some(Contact { key, value, name, half_width_mm }) = outside {
        let found = format!(
            "{}, with which half the width of {name} at the pitch point is {half_width_mm:.3e} mm",
            number(*value)
        );
        let allowed = format!(
            "a half-width of {} mm to {:.4e} mm, a hundred times the relative radius of the flanks",
            number(LEAST_MEANT_MM),
            GREATEST_MEANT * radius_mm
        );
        findings.not_allowed(key, found, allowed);
        findings
            .help("it follows from torque, face width, Young's modulus and the size of the gears; check their units");
        return;
    }
    for Contact { key, value, name, half_width_mm } in contacts {
        if half_width_mm > GREATEST_SMALL * radius_mm {
            findings.warnings.push(format!(
                "{key} = {}: half the width of {name} at the pitch point is {half_width_mm:.3} mm, where the relative radius is \
                 {radius_mm:.3} mm: strains are not small, and the result is not reliable",
                number(value)
            ));
        }
    }
}

/// The contacts under the least and the greatest torque, and the widest on a foundation given by hand.
fn contacts(scene: &Scene, pair: &GearPair, findings: &Findings) -> Vec<Contact> {
    let pitch_point_mm = pair.path.pitch_point_mm;
    let flattening = hertz::flattening(&pair.normal_section(), &scene.material, pitch_point_mm);
    let [least_n_mm, greatest_n_mm] = scene.operation.torque_range_n_mm();
    let torques = [Some(greatest_n_mm), Some(least_n_mm).filter(|least| *least < greatest_n_mm)];
    let of_hertz = torques.into_iter().flatten().map(|torque_n_mm| {
        let (key, value) = most_unusual(scene, pair, torque_n_mm, findings);
        let half_width_mm = flattening.contact.loaded(pair.line_load_n_per_mm(torque_n_mm)).half_width_mm;
        Contact { key, value, name: "Hertz's contact", half_width_mm }
    });
    let mut contacts: Vec<Contact> = of_hertz.collect();
    if let Foundation::Given { foundation_mpa_per_mm } = scene.contact.foundation {
        let radius_mm = pair.normal_section().relative_radius_mm(pitch_point_mm);
        contacts.push(Contact {
            key: "contact.foundation_MPa_per_mm".to_owned(),
            value: foundation_mpa_per_mm,
            name: "the contact on the foundation",
            half_width_mm: foundation::half_width_mm(
                foundation_mpa_per_mm,
                radius_mm,
                pair.line_load_n_per_mm(greatest_n_mm),
            ),
        });
    }
    contacts
}

/// The key, with its value, by which Hertz's contact under a torque differs most from that of usual steel gears.
fn most_unusual(scene: &Scene, pair: &GearPair, torque_n_mm: f64, findings: &Findings) -> (String, f64) {
    let (modulus_mpa, line_load_n_per_mm, modules) = USUAL;
    let usual_width_mm = modules * scene.pair.normal_module_mm;
    let width_mm = scene.pair.face_width_mm;
    let usual_torque_n_mm =
        line_load_n_per_mm * torque_n_mm / pair.line_load_n_per_mm(torque_n_mm) * usual_width_mm / width_mm;
    let phase = scene.operation.phases.iter().position(|phase| phase.pinion_torque_n_mm == torque_n_mm).unwrap_or(0);
    let of_phase = format!("operation.phases[{phase}].pinion_torque_Nm");
    let of_whole = "operation.pinion_torque_Nm".to_owned();
    let torque_key = if findings.is_in_file(&of_phase) { of_phase } else { of_whole };
    let mut keys = vec![
        (torque_key, torque_n_mm / 1e3, torque_n_mm / usual_torque_n_mm),
        ("pair.face_width_mm".to_owned(), width_mm, width_mm / usual_width_mm),
    ];
    for gear in Gear::BOTH {
        let own_mpa = scene.material[gear].young_modulus_mpa;
        let own = format!("material.{}.young_modulus_GPa", gear.name());
        let key = if findings.is_in_file(&own) { own } else { "material.young_modulus_GPa".to_owned() };
        keys.push((key, own_mpa / 1e3, own_mpa / modulus_mpa));
    }
    let first = keys.swap_remove(0);
    let furthest = keys.into_iter().fold(first, |furthest, other| {
        let [off, others] = [furthest.2, other.2].map(|ratio| ratio.ln().abs());
        if others > off.max(CLEARLY_OFF.ln()) { other } else { furthest }
    });
    (furthest.0, furthest.1)
}

#[cfg(test)]
mod tests {
    use crate::scene::draft::Draft;
    use crate::scene::presets;

    /// Warnings of strains that are not small.
    fn warnings(key: &str, value: f64) -> Vec<String> {
        let mut draft = Draft::parse(presets::find("fzg-c").unwrap().text).unwrap();
        if key == "contact.foundation_MPa_per_mm" {
            draft.remove("contact.match");
        }
        draft.set(key, value);
        let warnings = draft.resolve().unwrap().warnings.into_iter();
        warnings.filter(|warning| warning.contains("strains are not small")).collect()
    }

    /// fzg-c: a = 0.2452 mm under 302 N·m and R = 8.382 mm, so that a = R/10 at 302 (0.8382/0.2452)² = 3529 N·m, or with
    /// 206 (0.2452/0.8382)² = 17.6 GPa; on a foundation, with 1.5 · 637.66 · 8.382/0.8382³ = 13 614 MPa/mm.
    #[test]
    fn wide_contacts_come_with_a_warning() {
        for (key, narrow, wide, named) in [
            ("operation.pinion_torque_Nm", 3500.0, 3560.0, "operation.pinion_torque_Nm"),
            ("material.young_modulus_GPa", 17.8, 17.4, "operation.pinion_torque_Nm"),
            ("contact.foundation_MPa_per_mm", 13_700.0, 13_500.0, "contact.foundation_MPa_per_mm"),
        ] {
            assert_eq!(warnings(key, narrow), Vec::<String>::new(), "{key}");
            let said = warnings(key, wide);
            assert!(said.len() == 1 && said[0].starts_with(named), "{said:?}");
        }
    }
}
