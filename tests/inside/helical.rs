//! Pairs with slices over the face width, as scenes ask for them: the preset's transverse section, warnings and
//! invariants of runs, narrow teeth.

use gearwear::runs;
use gearwear::scene::{draft::Draft, presets};
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Unwatched;

use super::common::{assert_close, fzg_c, loaded, pair};

/// A normal profile shift is the same length as the transverse one of m_t; the preset keeps the transverse section of type C at
/// any helix angle.
#[test]
fn val_the_preset_keeps_the_transverse_section() {
    let spur = pair(&fzg_c());
    for degrees in [0.0_f64, 15.0, 30.0, -20.0, 45.0] {
        let text = gearwear::scene::presets::find("thesis-helical").unwrap().text;
        let text = text.replace("helix_angle_deg = 15.0", &format!("helix_angle_deg = {degrees:?}"));
        let spec = gearwear::scene::Resolved::from_toml(&text).unwrap().scene.pair;
        let helical = pair(&spec);
        for (a, b) in helical.path.points_mm().into_iter().zip(spur.path.points_mm()) {
            assert_close("path", a, b, 1e-12);
        }
        for gear in Gear::BOTH {
            let (a, b) = (&helical.teeth[gear], &spur.teeth[gear]);
            assert_close("base radius", a.involute.base_radius_mm, b.involute.base_radius_mm, 1e-12);
            assert_close("thickness", a.base_half_angle_rad, b.base_half_angle_rad, 1e-9);
            assert_close("root radius", a.root_radius_mm, b.root_radius_mm, 1e-9);
        }
        // tan β_b = tan β cos α_t, and ε_β = b tan β_b / p_bt.
        let beta_b = helical.base_helix_angle_rad();
        let by_normal = (degrees.to_radians().sin() * spec.normal_pressure_angle_rad.cos()).asin();
        assert!((beta_b - by_normal).abs() < 1e-12, "sin β_b = sin β cos α_n: {beta_b} {by_normal}");
        let overlap = spec.face_width_mm * beta_b.tan().abs() / helical.path.base_pitch_mm;
        assert!((helical.overlap_ratio() - overlap).abs() < 1e-12);
    }
}

/// Where slices enter as others leave, the transmission error hardly varies but by their steps, and the run says so.
#[test]
fn steps_of_single_slices_are_told() {
    let warnings = |name: &str| {
        let mut draft = Draft::parse(gearwear::scene::presets::find(name).unwrap().text).unwrap();
        draft.set("contact.surface", "hertz-mean");
        draft.set("helical.coupling", "none");
        draft.set("stiffness.model", "weber-banaschek");
        draft.set("numerics.step.revolutions", 10_000.0);
        draft.set("numerics.error_estimate", false);
        draft.set("numerics.verify", false);
        for key in ["numerics.tolerance_um", "contact.tip_contact"] {
            draft.remove(key);
        }
        let resolved = draft.resolve().unwrap();
        let unwatched = &gearwear_physics::observer::Unwatched;
        gearwear::runs::run(&loaded(&resolved), unwatched).unwrap().record.summary.warnings
    };
    assert!(warnings("h951").iter().any(|warning| warning.starts_with("helical.slices: the transmission error")));
    assert!(!warnings("thesis-helical").iter().any(|warning| warning.starts_with("helical.slices")));
}

/// With tip edges followed, all slices, also those whose middle is before A or after E, lose together what their load and sliding ask for, and both flanks alike.
#[test]
fn ver_slices_lose_what_load_and_sliding_ask_for() {
    let mut draft = Draft::parse(presets::find("helical").unwrap().text).unwrap();
    for (key, value) in [("helical.slices", 10), ("numerics.flank_points", 300), ("numerics.positions", 200)] {
        draft.set(key, value);
    }
    draft.set("numerics.error_estimate", false);
    draft.set("numerics.verify", false);
    let resolved = draft.resolve().unwrap_or_else(|problems| panic!("{problems:?}"));
    let invariants = runs::run(&loaded(&resolved), &Unwatched).unwrap().record.summary.invariants;
    for name in ["volume-balance", "volume-of-work"] {
        let found = invariants.iter().find(|invariant| invariant.name == name).and_then(|invariant| invariant.value);
        assert!(found.is_some_and(|value| value < 3e-3), "{name}: {found:?}");
    }
}

/// So narrow that all of its width is in the same place of the mesh, a helical pair has in its normal section lines as long as its load is greater, and radii greater by
/// 1/cos β_b: it has the half-width and the pressure of the spur pair of its transverse section whose modulus is cos β_b times as great, and, as gaps are greater by 1/cos β_b
/// along the transverse line of action, its transmission error. Where the stiffness model speaks of the section, the teeth yield 1/cos⁴ β times as much and the pair, at
/// the load for which the model speaks, alike on every surface.
#[test]
fn ver_a_narrow_helical_pair_is_a_softer_spur_pair() {
    let (helix, module_mm, centre_mm) = (30f64.to_radians(), 4.0, 99.0);
    let of_transverse = (20f64.to_radians().tan() / helix.cos()).atan();
    let cos_base = (1.0 - (helix.sin() * 20f64.to_radians().cos()).powi(2)).sqrt();
    let (transverse_module_mm, teeth) = (module_mm / helix.cos(), [18, 24]);
    let shifts_mm = [0.3 * module_mm, 0.2 * module_mm];
    let run = |surface: &str, stiffness: &str, is_helical: bool| {
        let of = |mm: f64| if is_helical { mm / module_mm } else { mm / transverse_module_mm };
        let gear = |k: usize| {
            let reference_mm = transverse_module_mm * f64::from(teeth[k]);
            format!(
                "{{ teeth = {}, profile_shift = {:?}, tip_diameter_mm = {:?} }}",
                teeth[k],
                of(shifts_mm[k]),
                reference_mm + 2.0 * (0.9 * module_mm + shifts_mm[k])
            )
        };
        let (module, angle, modulus) = match is_helical {
            true => (module_mm, 20.0, 206.0),
            false => (transverse_module_mm, of_transverse.to_degrees(), 206.0 * cos_base),
        };
        let rack = format!(
            "{{ addendum_factor = {:?}, dedendum_factor = {:?}, fillet_radius_factor = {:?} }}",
            of(module_mm),
            of(1.25 * module_mm),
            of(0.2 * module_mm)
        );
        let text = format!(
            "[pair]\nnormal_module_mm = {module:?}\npressure_angle_deg = {angle:?}\nhelix_angle_deg = {:?}\ncentre_distance_mm = {centre_mm:?}\nface_width_mm = 0.4\n\
             basic_rack = {rack}\npinion = {}\nwheel = {}\n[material]\nyoung_modulus_GPa = {modulus:?}\npoisson_ratio = 0.3\n\
             [operation]\npinion_torque_Nm = 8.0\npinion_revolutions = 1.0\n[contact]\nsurface = \"{surface}\"\ntip_contact = false\n\
             [helical]\nslices = 2\ncoupling = \"none\"\n[stiffness]\n{stiffness}\n\
             [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-20\n\
             [numerics]\nflank_points = 1500\npositions = 200\nerror_estimate = false\nverify = false\n",
            if is_helical { helix.to_degrees() } else { 0.0 },
            gear(0),
            gear(1)
        );
        let resolved = Draft::parse(&text).unwrap().resolve().unwrap_or_else(|problems| panic!("{problems:?}"));
        runs::run(&loaded(&resolved), &Unwatched).unwrap().record
    };
    let (rigid, weber_banaschek) = ("model = \"constant\"\npair_N_per_mm_um = 1e6", "model = \"weber-banaschek\"");
    let surfaces = ["hertz", "winkler", "half-space"];
    for surface in surfaces {
        let [helical, spur] = [true, false].map(|is_helical| run(surface, rigid, is_helical));
        let path = (spur.mesh_cycle[0].position_mm, spur.mesh_cycle[spur.mesh_cycle.len() - 1].position_mm);
        assert_eq!(helical.mesh_cycle.len(), spur.mesh_cycle.len());
        let mut most = [0.0_f64; 3];
        for (narrow, own) in helical.mesh_cycle.iter().zip(&spur.mesh_cycle) {
            assert!((narrow.position_mm - own.position_mm).abs() < 1e-9 * path.1);
            // Slices come and go by themselves: where one pair has the path to itself.
            if narrow.load_share_new.min(own.load_share_new) < 0.999 {
                continue;
            }
            let off = [
                narrow.transmission_error_new_um / own.transmission_error_new_um,
                narrow.peak_pressure_new_MPa / own.peak_pressure_new_MPa,
                narrow.half_width_mm / own.half_width_mm,
            ];
            most = [0, 1, 2].map(|k| most[k].max((off[k] - 1.0).abs()));
        }
        assert!(most[0] < 1e-4 && most[1].max(most[2]) < 4e-3, "{surface}: {most:?}");
    }
    // In the middle of the path, which belongs to one pair.
    let in_the_middle_um = |surface: &str, stiffness: &str, is_helical: bool| {
        let record = run(surface, stiffness, is_helical);
        let middle = &record.mesh_cycle[record.mesh_cycle.len() / 2];
        assert!(middle.load_share_new > 0.999);
        middle.transmission_error_new_um
    };
    let flattening_um = in_the_middle_um("half-space", rigid, true);
    let [helical, spur] = [true, false].map(|is_helical| in_the_middle_um("half-space", weber_banaschek, is_helical));
    let softer = (helical - flattening_um) / (spur - flattening_um);
    assert_close("teeth", softer, cos_base / helix.cos().powi(4), 5e-3);
    for surface in surfaces {
        assert_close(surface, in_the_middle_um(surface, weber_banaschek, true), helical, 1e-3);
    }
}
