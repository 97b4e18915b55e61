//! Films, friction, load sharing and scuffing: formulas against their sources' own units and limits.

use gearwear_bodies::gear::PerGear;
use gearwear_physics::lubrication::film::{CentralFilm, FilmParameters};
use gearwear_physics::lubrication::friction;
use gearwear_physics::lubrication::load_sharing_factor::SharingGeometry;
use gearwear_physics::lubrication::rolling_contact::RollingContact;
use gearwear_physics::lubrication::scuffing;

use super::common::assert_close;

fn contact() -> RollingContact {
    RollingContact {
        line_load_n_per_mm: 300.0,
        relative_radius_mm: 8.0,
        peak_pressure_mpa: 1200.0,
        surface_speeds_m_per_s: PerGear { pinion: 3.0, wheel: 2.0 },
    }
}

/// Benedict and Kelley (1961) in the units of the paper: 0.0127 · 50/(50 − S) lg(3.17e8 W/(η V_s V_r²)), W in lbf/in, speeds in in/s, η in
/// cP, S in µin.
#[test]
fn val_benedict_and_kelley_in_their_own_units() {
    let contact = contact();
    let (viscosity, ra_um) = (20.0_f64, 0.4_f64);
    let inches = 1000.0_f64 / 25.4;
    let load = 300.0 * 25.4 / 4.448_221_6;
    let argument = 3.17e8 * load / (viscosity * inches * (5.0 * inches).powi(2));
    let rough = 50.0 / (50.0 - ra_um / 0.0254);
    let expected = 0.0127 * rough * argument.log10();
    assert_close("μ", friction::benedict_kelley(&contact, viscosity, ra_um), expected, 2e-3);
}

#[test]
fn ver_friction_without_sliding() {
    let still = RollingContact { surface_speeds_m_per_s: PerGear { pinion: 2.0, wheel: 2.0 }, ..contact() };
    assert_eq!(friction::xu(&still, 10.0, 0.1), 0.0);
    let most = friction::benedict_kelley(&still, 10.0, 0.4);
    assert!(most.is_finite() && most > friction::benedict_kelley(&contact(), 10.0, 0.4));
}

/// A film in dimensionless form: h/ρ depends on U, G and W alone.
#[test]
fn ver_films_of_similar_contacts_are_similar() {
    let contact = contact();
    let of = |scale: f64| {
        let larger = RollingContact {
            line_load_n_per_mm: scale * contact.line_load_n_per_mm,
            relative_radius_mm: scale * contact.relative_radius_mm,
            surface_speeds_m_per_s: contact.surface_speeds_m_per_s.map(|speed| scale * speed),
            ..contact
        };
        FilmParameters::new(&larger, 226_374.0, 20.0, 18.0)
    };
    let (one, ten) = (of(1.0), of(10.0));
    for by in [CentralFilm::Hamrock, CentralFilm::Grubin] {
        assert_close("central film", ten.central_um(by), 10.0 * one.central_um(by), 1e-12);
        // The least film is at the outlet, behind the middle.
        assert!(one.central_um(by) > one.least_um());
    }
    assert_close("least film", ten.least_um(), 10.0 * one.least_um(), 1e-12);
}

/// ISO/TS 6336-22, clause 8: a third, two thirds, the whole; 1.3/ε_α at the ends of helical teeth.
#[test]
fn val_load_sharing_factors() {
    let spur =
        SharingGeometry { points_mm: [4.0, 10.0, 14.0, 18.0, 24.0], overlap_ratio: 0.0, base_helix_angle_rad: 0.0 };
    for (position, factor) in
        [(4.0, 1.0 / 3.0), (9.999_999, 2.0 / 3.0), (10.0, 1.0), (18.0, 1.0), (21.0, 0.5), (24.0, 1.0 / 3.0)]
    {
        assert!((spur.factor(position) - factor).abs() < 1e-6, "{position}");
    }
    let helical = SharingGeometry { overlap_ratio: 1.4, base_helix_angle_rad: 0.164, ..spur };
    assert_close("end", helical.factor(4.0), 1.3 / helical.contact_ratio(), 1e-12);
    assert_close("middle", helical.factor(14.0), 1.0 / helical.contact_ratio(), 1e-12);
}

/// Report of stage 3 (KISSsoft 03/2017, public repository gfsReboucas/Drivetrain): ε₁ 0.852, ε₂ 0.611, C_a 2 µm of C_eff 44.74 µm, ε_γ 2.884.
#[test]
fn val_factors_of_the_integral_temperature() {
    assert!((scuffing::contact_ratio_factor(0.852, 0.611) - 0.263).abs() < 5e-4);
    assert!((scuffing::tip_relief_factor(2.0 / 44.74, 0.852) - 1.095).abs() < 5e-4);
    assert!((scuffing::helical_load_factor(2.884) - 1.274).abs() < 5e-4);
    assert_eq!(scuffing::approach_factor(0.611, 0.852), 1.0);
}

/// ISO/TS 6336-20 and -21: factors at values that are not neutral, and the scuffing temperatures of two printed reports: 451.98 °C of load stage
/// 14 with mineral oil of 30.08 mPa·s (KISSsoft 03/2017, public repository gfsReboucas/Drivetrain, stage 3), 151.8 °C of stage 6 and
/// 90.02 mm²/s (STplus 11.1F, public repository tkuhn39/semesterthesis).
#[test]
fn val_factors_and_limits_of_scuffing() {
    // Approach longer than recess: 1.4 − 4/15 · 2.
    assert_close("X_Q", scuffing::approach_factor(0.9, 0.45), 1.4 - 8.0 / 15.0, 1e-12);
    assert_eq!(scuffing::approach_factor(0.45, 0.9), 1.0);
    assert_close("X_J", scuffing::flash_approach_factor(20.0, -0.6, [-0.7, 0.5]), 1.0 + 0.4 * 0.125, 1e-12);
    assert_eq!(scuffing::flash_approach_factor(20.0, 0.5, [-0.7, 0.5]), 1.0);
    assert_eq!(scuffing::flash_approach_factor(-5.0, -0.7, [-0.7, 0.5]), 1.0);
    assert_close("X_E", scuffing::run_in_factor(0.0, 0.3, 8.3824), 2.0737, 1e-4);
    assert_eq!(scuffing::run_in_factor(1.0, 0.3, 8.4), 1.0);
    assert!((scuffing::scuffing_temperature_c(14, 1.0, 30.08f64.powf(-0.05)) - 451.98).abs() < 0.05);
    assert!((scuffing::integral_scuffing_temperature_c(6, 1.0, 1.0, 90.02) - 151.8).abs() < 0.05);
    // Beyond the test's last stage the torque is 3.726 S².
    let beyond = scuffing::integral_scuffing_temperature_c(13, 1.0, 1.0, 100.0);
    assert_close("stage 13", beyond, 80.0 + 0.53 * 3.726 * 169.0, 1e-12);
}
