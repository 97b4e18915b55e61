//! Loads that no elastic contact carries: a strip of contact as wide as the flanks are curved.
//!
//! Every surface approximates the flanks by parabolas of relative radius R and takes strains to be small. Both rest on
//! the half-width a of the contact being small beside R, and Hertz's contact says so in one number, since p₀/E* = a/(2R).
//! At C under the whole load,
//!
//! ```text
//! Hertz     a² = 4 w R / (π E*)            foundation given by hand     a³ = 3 w R / (2 K/H)
//! ```
//!
//! From a = R/10 on (a mean strain of some 5 %) the run warns; beyond a = R there is nothing to compute, and the scene is
//! refused. Source: K. L. Johnson, *Contact Mechanics* (1985), sections 4.1 to 4.3.

use crate::contact::settings::Foundation;
use crate::gear::conjugate::ConjugateFlanks;
use crate::gear::{Gear, GearPair};
use crate::reference::hertz_line::HertzLine;
use crate::scene::Scene;
use crate::scene::findings::Findings;
use crate::scene::problem::{ProblemKind, number};

/// Half-width over relative radius beyond which strains are no longer small.
const GREATEST_SMALL: f64 = 0.1;

/// Reports loads, and foundations given by hand, whose contact at the pitch point of `pair` would not be narrow.
pub fn check(scene: &Scene, pair: &GearPair, findings: &mut Findings) {
    let torques = scene.operation.phases.iter().map(|phase| phase.pinion_torque_n_mm);
    let torque_n_mm = torques.fold(0.0, f64::max);
    let line_load = torque_n_mm / pair.path.involute.pinion.base_radius_mm / scene.pair.face_width_mm;
    let radius = pair.relative_radius_mm(pair.path.pitch_point_mm);
    let compliance: f64 = Gear::BOTH
        .map(|gear| (1.0 - scene.material[gear].poisson_ratio.powi(2)) / scene.material[gear].young_modulus_mpa)
        .iter()
        .sum();
    let hertz = HertzLine::of_relative_radius(radius, 1.0 / compliance).loaded(line_load);
    let share = hertz.half_width_mm / radius;
    let said = format!("{:.3} mm at the pitch point, where the relative radius is {radius:.3} mm", hertz.half_width_mm);
    if share > 1.0 {
        let key = "operation.pinion_torque_Nm";
        let allowed = format!("at most {} on this pair", number((1e-3 * torque_n_mm / (share * share)).floor()));
        findings.problem(ProblemKind::NotAllowed, key, number(1e-3 * torque_n_mm), allowed);
        findings.help(format!(
            "half the width of Hertz's contact would be {said}: check torque, width and Young's modulus"
        ));
    } else if share > GREATEST_SMALL {
        findings.warnings.push(format!(
            "operation.pinion_torque_Nm = {}: half the width of Hertz's contact is {said}: strains are no longer small, and \
             the result is no longer reliable",
            number(1e-3 * torque_n_mm)
        ));
    }
    if let Foundation::Given { foundation_mpa_per_mm } = scene.contact.foundation {
        let half_width = (1.5 * line_load * radius / foundation_mpa_per_mm).cbrt();
        if half_width > radius {
            let allowed = format!("at least {:e} under this load", 1.5 * line_load / (radius * radius));
            let key = "contact.foundation_MPa_per_mm";
            findings.problem(ProblemKind::NotAllowed, key, number(foundation_mpa_per_mm), allowed);
            findings
                .help(format!("half the width of contact would be {half_width:.3} mm, more than the relative radius"));
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::Scene;
    use crate::scene::draft::Draft;
    use crate::scene::presets;

    fn resolved(key: &str, value: f64) -> Result<Vec<String>, String> {
        let mut draft = Draft::parse(presets::find("fzg-c").unwrap().text).unwrap();
        if key == "contact.foundation_MPa_per_mm" {
            draft.remove("contact.match");
        }
        draft.set(key, value);
        draft.resolve().map(|resolved| resolved.warnings).map_err(|problems| problems[0].to_string())
    }

    /// fzg-c: a = 0.2452 mm under 302 N·m, R = 8.382 mm, so that a = R at 302 (8.382/0.2452)² = 3.53e5 N·m.
    #[test]
    fn wide_contacts_warn_and_wider_ones_are_refused() {
        assert!(Scene::from_toml(presets::find("fzg-c").unwrap().text).unwrap().warnings.is_empty());
        let warnings = resolved("operation.pinion_torque_Nm", 1e4).unwrap();
        assert!(warnings.iter().any(|w| w.contains("strains are no longer small")), "{warnings:?}");
        for (key, value) in [
            ("operation.pinion_torque_Nm", 3.6e5),
            ("material.young_modulus_GPa", 0.1),
            ("contact.foundation_MPa_per_mm", 1.0),
        ] {
            let problem = resolved(key, value).unwrap_err();
            let named = if key.starts_with("material") { "operation.pinion_torque_Nm" } else { key };
            assert!(problem.contains(named), "{problem}");
        }
        assert!(resolved("operation.pinion_torque_Nm", 3.4e5).is_ok());
    }
}
