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
//! may be meant, and the equilibrium of such a contact can still be found. Source: K. L. Johnson, *Contact Mechanics* (1985),
//! sections 4.1 to 4.3.

use crate::contact::{foundation, hertz, settings::Foundation};
use crate::gear::GearPair;
use crate::gear::conjugate::ConjugateFlanks;
use crate::scene::Scene;
use crate::scene::problem::number;

/// Half-width over relative radius beyond which strains are no longer small.
const GREATEST_SMALL: f64 = 0.1;

/// Warnings of loads, and of foundations given by hand, whose contact at the pitch point of `pair` is not narrow.
pub(super) fn warnings(scene: &Scene, pair: &GearPair) -> Vec<String> {
    let torques = scene.operation.phases.iter().map(|phase| phase.pinion_torque_n_mm);
    let torque_n_mm = torques.fold(0.0, f64::max);
    let line_load = pair.line_load_n_per_mm(torque_n_mm);
    let radius = pair.relative_radius_mm(pair.path.pitch_point_mm);
    let of_hertz =
        hertz::flattening(pair, &scene.material, pair.path.pitch_point_mm).contact.loaded(line_load).half_width_mm;
    let mut contacts = vec![("operation.pinion_torque_Nm", 1e-3 * torque_n_mm, "Hertz's contact", of_hertz)];
    if let Foundation::Given { foundation_mpa_per_mm } = scene.contact.foundation {
        let half_width = foundation::half_width_mm(foundation_mpa_per_mm, radius, line_load);
        let key = "contact.foundation_MPa_per_mm";
        contacts.push((key, foundation_mpa_per_mm, "the contact on the foundation", half_width));
    }
    let wide = contacts.into_iter().filter(|(.., half_width)| *half_width > GREATEST_SMALL * radius);
    wide.map(|(key, value, contact, half_width)| {
        format!(
            "{key} = {}: half the width of {contact} at the pitch point is {half_width:.3} mm, where the relative radius is \
             {radius:.3} mm: strains are not small, and the result is not reliable",
            number(value)
        )
    })
    .collect()
}

#[cfg(test)]
mod tests {
    use crate::scene::draft::Draft;
    use crate::scene::presets;

    fn warnings(key: &str, value: f64) -> Vec<String> {
        let mut draft = Draft::parse(presets::find("fzg-c").unwrap().text).unwrap();
        if key == "contact.foundation_MPa_per_mm" {
            draft.remove("contact.match");
        }
        draft.set(key, value);
        draft.resolve().unwrap().warnings
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
            let about_strains = |value| {
                let all = warnings(key, value);
                all.into_iter().filter(|warning| warning.contains("strains are not small")).collect::<Vec<_>>()
            };
            assert_eq!(about_strains(narrow), Vec::<String>::new(), "{key}");
            let said = about_strains(wide);
            assert!(said.len() == 1 && said[0].starts_with(named), "{said:?}");
        }
    }
}
