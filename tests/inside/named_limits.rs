//! Limits that refusals name: used, they are accepted.

use gearwear::scene::Resolved;
use gearwear::scene::draft::Draft;
use proptest::prelude::*;

/// The number that a sentence of what is allowed ends in or holds first.
fn limit(allowed: &str) -> Option<f64> {
    let starts = allowed.find(|c: char| c.is_ascii_digit())?;
    let starts = if allowed[..starts].ends_with('-') { starts - 1 } else { starts };
    let number: String =
        allowed[starts..].chars().take_while(|c| c.is_ascii_digit() || matches!(c, '.' | '-')).collect();
    number.trim_end_matches('.').parse().ok()
}

fn scene(teeth: [u32; 2], angle_deg: f64, shifts: [f64; 2], centre_mm: f64, rack: Option<(f64, f64)>) -> Draft {
    let rack = rack.map_or_else(String::new, |(dedendum, fillet)| {
        format!("[pair.basic_rack]\ndedendum_factor = {dedendum:?}\nfillet_radius_factor = {fillet:?}\n")
    });
    let text = format!(
        "[pair]\nnormal_module_mm = 3.0\npressure_angle_deg = {angle_deg:?}\ncentre_distance_mm = {centre_mm:?}\nface_width_mm = 10.0\n\
         [pair.pinion]\nteeth = {}\nprofile_shift = {:?}\n[pair.wheel]\nteeth = {}\nprofile_shift = {:?}\n{rack}\
         [operation]\npinion_torque_Nm = 1.0\npinion_revolutions = 1e6\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-18\n",
        teeth[0], shifts[0], teeth[1], shifts[1]
    );
    Draft::parse(&text).expect("the text of the test is TOML")
}

/// What is wrong with it about the gears, as the key that a limit is named for, the limit, and the kind of the refusal.
fn refusal(draft: &Draft) -> Option<(String, f64, String)> {
    let problems = Resolved::from_toml(&draft.to_toml()).err()?;
    let said = problems[0].to_string();
    let (_, allowed) = said.rsplit_once("allowed: ")?;
    let limit = limit(allowed)?;
    // A diameter is mended at the tip, wherever the sentence points.
    let key = if allowed.contains("tip diameter") {
        let of_wheel =
            said.contains("the wheel tip") || said.contains("the wheel tooth") || allowed.contains("of the wheel of");
        format!("pair.{}.tip_diameter_mm", if of_wheel { "wheel" } else { "pinion" })
    } else {
        problems[0].key.clone()
    };
    Some((
        key,
        limit,
        said.split("; found")
            .next()
            .unwrap_or_default()
            .split(':')
            .nth(1)
            .unwrap_or_default()
            .trim()
            .get(..12)
            .unwrap_or_default()
            .to_owned(),
    ))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    /// 14.5 to 35°, 8 to 100 teeth, any shift and centre distance nearby, default and own racks: a limit that is named is one that can be
    /// used, and then that refusal is gone.
    #[test]
    fn prop_named_limits_are_true(
        teeth in prop::array::uniform2(8u32..100),
        angle_deg in 14.5..35.0_f64,
        shifts in prop::array::uniform2(-0.8..1.2_f64),
        apart in -0.03..0.06_f64,
        rack in prop::option::of((0.9..1.6_f64, 0.0..0.6_f64)),
    ) {
        let centre_mm = 1.5 * f64::from(teeth[0] + teeth[1]) + 3.0 * (shifts[0] + shifts[1]);
        let mut draft = scene(teeth, angle_deg, shifts, centre_mm * (1.0 + apart), rack);
        if let Some((key, limit, kind)) = refusal(&draft)
            && !kind.starts_with("transverse")
        {
            let below = if kind.contains("pointed") && key.ends_with("tip_diameter_mm") { 1e-3 } else { 0.0 };
            draft.set(&key, limit - below);
            if let Some((again, _, other)) = refusal(&draft) {
                prop_assert!(again != key || other != kind, "{key} = {limit} is refused again for {kind:?}");
            }
        }
    }
}

/// Cases of default racks at great pressure angles: the fillet gives way, the dedendum is refused with the limit (π/4)/tan α.
#[test]
fn val_default_racks_at_great_pressure_angles() {
    let at = |angle_deg: f64| Resolved::from_toml(&scene([28, 28], angle_deg, [0.0, 0.0], 84.0, None).to_toml());
    // (π/4 − 1.25 tan 25°)/(1/cos 25° − tan 25°) = 0.317882.
    let resolved = at(25.0).expect("the default gives way");
    assert_eq!(resolved.scene.pair.rack.fillet_radius_factor, 0.3178);
    assert!(resolved.warnings.iter().any(|w| w.contains("0.3178 instead of 0.38")), "{:?}", resolved.warnings);
    assert_eq!(at(20.0).expect("it fits").scene.pair.rack.fillet_radius_factor, 0.38);
    // (π/4)/tan 35° = 1.12166.
    let problems = at(35.0).expect_err("the rack is pointed");
    assert_eq!((&*problems[0].key, &*problems[0].allowed), ("pair.basic_rack.dedendum_factor", "at most 1.1216"));
    let mut draft = scene([28, 28], 35.0, [0.0, 0.0], 84.0, None);
    draft.set("pair.basic_rack.dedendum_factor", 1.1216);
    let resolved = Resolved::from_toml(&draft.to_toml()).expect("the limit is true");
    assert!(resolved.scene.pair.rack.fillet_radius_factor < 1e-3);
}
