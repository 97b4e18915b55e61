//! Pairs that several tests run on.
#![allow(dead_code, reason = "each test binary uses its own part")]

use gearwear::gear::{
    GearPair, PerGear,
    modification::Modification,
    spec::{BasicRack, GearSpec, PairSpec},
};

/// Sum of |relative difference| check with a readable message.
pub fn assert_close(what: &str, value: f64, expected: f64, relative: f64) {
    let error = (value / expected - 1.0).abs();
    assert!(error <= relative, "{what}: {value} instead of {expected} (off by {error:.2e}, allowed {relative:.0e})");
}

/// One gear by teeth, shift and tip diameter.
pub fn gear(teeth: u32, profile_shift: f64, tip_diameter_mm: Option<f64>) -> GearSpec {
    GearSpec {
        teeth,
        profile_shift,
        tip_diameter_mm,
        tooth_thickness_allowance_mm: 0.0,
        bore_diameter_mm: None,
        modification: Modification::default(),
    }
}

/// A spur pair on the rack 20°, 1.0/1.25/0.38.
pub fn spur(module: f64, centre_distance_mm: f64, face_width_mm: f64, pinion: GearSpec, wheel: GearSpec) -> PairSpec {
    PairSpec {
        normal_module_mm: module,
        normal_pressure_angle_rad: 20f64.to_radians(),
        helix_angle_rad: 0.0,
        centre_distance_mm,
        face_width_mm,
        rack: BasicRack::default(),
        gears: PerGear { pinion, wheel },
    }
}

/// FZG type C: ISO 14635-1.
pub fn fzg_c() -> PairSpec {
    spur(4.5, 91.5, 14.0, gear(16, 0.1817, Some(82.46)), gear(24, 0.1715, Some(118.36)))
}

/// FZG type A (A20).
pub fn fzg_a() -> PairSpec {
    spur(4.5, 91.5, 20.0, gear(16, 0.8532, Some(88.77)), gear(24, -0.5, Some(112.5)))
}

/// A pair that can run.
pub fn pair(spec: &PairSpec) -> GearPair {
    GearPair::new(spec).expect("the pair of the test is sound")
}

/// Steel as in the scene's default.
pub const STEEL: gearwear::contact::settings::Material =
    gearwear::contact::settings::Material { young_modulus_mpa: 206e3, poisson_ratio: 0.3, density_kg_per_m3: 7830.0 };

/// Both gears of steel.
pub fn steel() -> PerGear<gearwear::contact::settings::Material> {
    PerGear { pinion: STEEL, wheel: STEEL }
}
