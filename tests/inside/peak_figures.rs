//! Greatest wear and greatest pressure mean the same in every output: the active profile apart from the tip edge and from what lies below it,
//! pressures that are defined apart from those at a sharp tip edge.

use gearwear::evaluate::output::SummaryOutput;
use gearwear::runs;
use gearwear::scene::{draft::Draft, presets};
use gearwear_bodies::gear::Gear;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::{figures, run::RunRecord};

use super::common::loaded;

/// A preset with keys exchanged, at a resolution that takes a second.
fn run(preset: &str, set: &[(&str, toml::Value)]) -> RunRecord {
    let mut draft = Draft::parse(presets::find(preset).unwrap().text).unwrap();
    draft.set("numerics.error_estimate", false);
    draft.set("numerics.verify", false);
    for (key, value) in set {
        draft.set(key, value.clone());
    }
    let resolved = draft.resolve().unwrap_or_else(|problems| panic!("{problems:?}"));
    let done = runs::run(&loaded(&resolved), &Unwatched).unwrap();
    assert_eq!(done.failure, None);
    done.record
}

fn rounded(radius_mm: f64) -> [(&'static str, toml::Value); 3] {
    [
        ("contact.tip_contact", true.into()),
        ("pair.pinion.tip_rounding_mm", radius_mm.into()),
        ("pair.wheel.tip_rounding_mm", radius_mm.into()),
    ]
}

/// (depth, radius) of the deepest point between two radii, over all slices.
fn deepest(record: &RunRecord, gear: Gear, from_mm: f64, below_mm: f64) -> (f64, f64) {
    let flank = &record.flanks[gear];
    let points = flank.wear_um.iter().zip(flank.radius_mm.iter().cycle());
    let inside = points.filter(|(_, radius)| (from_mm..below_mm).contains(*radius));
    inside.fold((0.0, f64::NAN), |best, (&depth, &radius)| if depth > best.0 { (depth, radius) } else { best })
}

/// The three figures of each gear are the greatest depths of its three zones, which follow from the geometry:
/// the tip-edge zone begins 3 a_C ≤ 0.15 m below where the rounding does, along the flank.
fn assert_zones(record: &RunRecord, rounding_mm: f64, normal_module_mm: f64) {
    let s = &record.summary;
    let length = (3.0 * s.contact.hertz_half_width_mm).min(0.15 * normal_module_mm);
    for (gear, wear) in [(Gear::Pinion, &s.pinion), (Gear::Wheel, &s.wheel)] {
        let of_gear = &s.geometry.gears[gear];
        let [base, tip, sap] =
            [of_gear.base_diameter_mm, of_gear.tip_diameter_mm, of_gear.start_of_active_profile_diameter_mm]
                .map(|d| 0.5 * d);
        let turn = std::f64::consts::FRAC_PI_2 - (base / tip).acos();
        let edge = (tip * tip - 2.0 * base * (length + rounding_mm * (0.5 * turn).tan())).sqrt();
        let found = [
            (wear.peak_wear_um, wear.peak_wear_radius_mm),
            (wear.tip_edge_wear_um, wear.tip_edge_wear_radius_mm),
            (wear.below_sap_wear_um, wear.below_sap_wear_radius_mm),
        ];
        for (found, (from, below)) in found.into_iter().zip([(sap, edge), (edge, f64::INFINITY), (0.0, sap)]) {
            let expected = deepest(record, gear, from, below);
            assert!(found.0 == expected.0, "{gear:?} from {from} to {below}: {found:?} instead of {expected:?}");
            assert!(found.0 == 0.0 || found.1 == expected.1, "{gear:?}: {found:?} instead of {expected:?}");
        }
    }
    let last = record.history.last().unwrap();
    assert_eq!(
        [last.pinion_peak_wear_um, last.pinion_peak_wear_radius_mm, last.wheel_peak_wear_um],
        [s.pinion.peak_wear_um, s.pinion.peak_wear_radius_mm, s.wheel.peak_wear_um]
    );
    assert_eq!(
        [last.pinion_tip_edge_wear_um, last.wheel_tip_edge_wear_um],
        [s.pinion.tip_edge_wear_um, s.wheel.tip_edge_wear_um]
    );
    // Main figures are the numbers at their paths.
    let summary = serde_json::to_value(s).unwrap();
    for figure in figures::all().iter().filter(|figure| figure.name != figures::PEAK_WEAR_OF_EITHER) {
        let written = SummaryOutput::find(&figure.name).unwrap().of(&summary);
        assert_eq!(figure.value(s).filter(|value| value.is_finite()), written, "{}", figure.name);
    }
}

fn warns_of_sharp_edges(record: &RunRecord) -> bool {
    record.summary.warnings.iter().any(|warning| warning.contains("mathematically sharp"))
}

/// An overloaded plastic gear whose teeth touch farther before A than the tip circles meet: the load that the warning says comes in at once there is the
/// step of the load share between rows of the mesh cycle, where there are but two pairs. With finite elements rows are interpolated, and another pair carries
/// a little besides.
#[test]
fn the_load_that_comes_in_at_once_is_the_step_of_the_rows() {
    for (surface, stiffness, rows, least, besides) in
        [("winkler", "[stiffness]\nmodel = \"iso6336\"", 2, 30.0, 1.0), ("fem", "", 4, 20.0, 4.0)]
    {
        let text = format!(
            r#"
            [pair]
            normal_module_mm = 3.853
            pressure_angle_deg = 20.0
            backlash_um = 154.0
            face_width_mm = 17.29
            pinion = {{ teeth = 15, profile_shift = -0.1755, tip_rounding_mm = 0.2276, tooth_thickness_allowance_um = -114.3 }}
            wheel = {{ teeth = 54, profile_shift = 0.0 }}
            [material.wheel]
            preset = "PBT"
            [operation]
            pinion_torque_Nm = 40.0
            pinion_revolutions = 1.0
            [contact]
            surface = "{surface}"
            {stiffness}
            [wear]
            law = "archard"
            coefficient_m2_per_N = 1e-20
            [numerics]
            flank_points = 150
            positions = 160
            error_estimate = false
            verify = false
            "#
        );
        let resolved = Draft::parse(&text).unwrap().resolve().unwrap_or_else(|problems| panic!("{problems:?}"));
        let record = runs::run(&loaded(&resolved), &Unwatched).unwrap().record;
        let said = record.summary.warnings.iter().find_map(|warning| {
            let (before, _) = warning.split_once(" % of the load comes in")?;
            before.rsplit(' ').next()?.parse::<f64>().ok()
        });
        let said = said.expect("the run warns");
        let steps = record
            .mesh_cycle
            .windows(rows)
            .map(|rows| (rows[rows.len() - 1].load_share_new - rows[0].load_share_new).abs());
        let greatest = 100.0 * steps.fold(0.0, f64::max);
        assert!(greatest > least, "{surface}: {greatest} %");
        assert!(said > greatest - 1.0 && said < greatest + besides, "{surface}: {said} for {greatest} %");
    }
}

/// Flanks whose crowning adds more to the transmission error than they yield touch as much farther outside A to E: no load comes in at once there, where 24 %
/// did as long as the range of tip edges followed the elastic approach alone (random scene 5796 of seed 19). Crowned leads, of which few slices carry all, touch
/// as much farther.
#[test]
fn tip_edges_are_followed_as_far_as_crowning_lets_them_touch() {
    let text = r#"
        [pair]
        normal_module_mm = 1.673
        pressure_angle_deg = 20.0
        face_width_mm = 14.04
        basic_rack = { addendum_factor = 1.197, dedendum_factor = 1.447, fillet_radius_factor = 0.1773 }
        backlash_um = 47.75
        pinion = { teeth = 12, profile_shift = -0.02218, tip_rounding_mm = 0.04629, tooth_thickness_allowance_um = -64.03 }
        wheel = { teeth = 41, profile_shift = 0.488, profile_crowning_um = 6.541 }
        [material.pinion]
        young_modulus_GPa = 121.1
        poisson_ratio = 0.3168
        [material.wheel]
        young_modulus_GPa = 107.4
        poisson_ratio = 0.2051
        [operation]
        pinion_torque_Nm = 0.7183
        pinion_revolutions = 1.0
        [contact]
        surface = "winkler"
        foundation_MPa_per_mm = 5.06e6
        [stiffness]
        model = "constant"
        pair_N_per_mm_um = 13.4
        [wear]
        law = "archard"
        coefficient_m2_per_N = 1e-20
        [numerics]
        flank_points = 300
        positions = 160
        error_estimate = false
        verify = false
        "#;
    let leads = text.replace("profile_crowning_um = 6.541", "lead_crowning_um = 60") + "[helical]\nslices = 60\n";
    for text in [text, &leads] {
        let resolved = Draft::parse(text).unwrap().resolve().unwrap_or_else(|problems| panic!("{problems:?}"));
        let record = runs::run(&loaded(&resolved), &Unwatched).unwrap().record;
        let warned = record.summary.warnings.iter().find(|warning| warning.contains("farther outside A to E"));
        assert_eq!(warned, None);
    }
}

/// With rounded tips that are followed into contact the wheel wears most at its tip edge: what stands for its flank is the active profile.
#[test]
fn the_greatest_wear_is_that_of_the_active_profile() {
    let record = run("thesis-spur", &rounded(0.1));
    let s = &record.summary;
    println!("{:?}\n{:?}", s.pinion, s.wheel);
    assert_zones(&record, 0.1, 4.5);
    assert!(s.wheel.tip_edge_wear_um > s.wheel.peak_wear_um && s.wheel.peak_wear_um > 0.0);
    assert!(s.pinion.below_sap_wear_um > 0.0);
    // A rounded edge is none: its pressure is defined.
    assert_eq!([s.new.sharp_edge_pressure_MPa, s.worn.sharp_edge_pressure_MPa], [None; 2]);
    assert!(record.mesh_cycle.iter().all(|row| !row.at_sharp_edge_new && !row.at_sharp_edge_worn));
    assert!(!warns_of_sharp_edges(&record));
}

/// Contact from A to E has no corner: nothing is said of edges, and the zones are the same.
#[test]
fn contact_from_a_to_e_knows_no_sharp_edges() {
    let record = run("thesis-spur", &[]);
    let s = &record.summary;
    println!("{:?}\n{:?}", s.pinion, s.wheel);
    assert_zones(&record, 0.0, 4.5);
    assert_eq!([s.new.sharp_edge_pressure_MPa, s.worn.sharp_edge_pressure_MPa], [None; 2]);
    assert!(!warns_of_sharp_edges(&record));
}

/// What a sharp edge shows grows as cells become finer, by Flamant's singularity without bound; what is called the greatest pressure
/// does not, and positions at a sharp edge are those near A and E.
#[test]
fn pressure_at_a_sharp_edge_stands_apart() {
    let with = |surface: &str, points: i64| {
        let once = [
            ("contact.surface", surface.into()),
            ("numerics.flank_points", points.into()),
            ("operation.pinion_revolutions", 1.0.into()),
            ("operation.snapshots_h", toml::Value::Array(Vec::new())),
            ("numerics.step.revolutions", 1.0.into()),
        ];
        run("thesis-spur", &[rounded(0.0).as_slice(), &once].concat())
    };
    for surface in ["winkler", "half-space"] {
        let [coarse, fine] = [400, 1600].map(|points| with(surface, points));
        let [(coarse_mpa, coarse_sharp), (fine_mpa, fine_sharp)] =
            [&coarse, &fine].map(|r| (r.summary.new.peak_pressure_MPa, r.summary.new.sharp_edge_pressure_MPa.unwrap()));
        println!("{surface}: {coarse_mpa:.1} and {fine_mpa:.1}, sharp {coarse_sharp:.1} and {fine_sharp:.1} MPa");
        assert!((coarse_mpa / fine_mpa - 1.0).abs() < 1e-3);
        assert!(fine_sharp > 2.0 * fine_mpa);
        // Cells of half-planes are a sixteenth to a fortieth of the half-width; springs have no singularity.
        assert!(surface != "half-space" || fine_sharp > 1.03 * coarse_sharp);
        assert!(warns_of_sharp_edges(&fine));
        let path = &fine.summary.geometry.curvature_radius_mm;
        let (sharp, other): (Vec<_>, Vec<_>) = fine.mesh_cycle.iter().partition(|row| row.at_sharp_edge_new);
        assert!(sharp.iter().all(|row| row.position_mm < path.A + 0.8 || row.position_mm > path.E - 0.8));
        assert!(sharp.iter().any(|row| row.position_mm < path.B) && sharp.iter().any(|row| row.position_mm > path.D));
        let greatest = other.iter().map(|row| row.peak_pressure_new_MPa).fold(0.0, f64::max);
        assert!(fine_mpa >= greatest && fine_mpa < 1.01 * greatest, "{fine_mpa} {greatest}");
        assert_eq!(fine.history.last().unwrap().peak_pressure_MPa, fine.summary.worn.peak_pressure_MPa);
    }
}

/// Slices follow the same rules: 20 of them have their maxima where maxima are read.
#[test]
fn slices_have_the_same_figures() {
    let coarse = [
        ("contact.surface", "winkler".into()),
        ("helical.slices", 20.into()),
        ("numerics.flank_points", 200.into()),
        ("numerics.positions", 60.into()),
        ("numerics.step.revolutions", 200_000.0.into()),
    ];
    for radius_mm in [0.0, 0.1] {
        let record = run("thesis-helical", &[rounded(radius_mm).as_slice(), &coarse].concat());
        assert_zones(&record, radius_mm, 4.5 * 15f64.to_radians().cos());
        let slices = record.slices.as_ref().unwrap();
        let is_sharp = slices.at_sharp_edge_new.iter().any(|sharp| *sharp);
        let new = &record.summary.new;
        assert_eq!(
            [is_sharp, new.sharp_edge_pressure_MPa.is_some(), warns_of_sharp_edges(&record)],
            [radius_mm == 0.0; 3]
        );
        assert!(new.sharp_edge_pressure_MPa.is_none_or(|sharp| sharp > 0.0));
        // Most of the mesh lies between the edges.
        assert!(new.peak_pressure_MPa > 500.0, "{}", new.peak_pressure_MPa);
    }
}

/// Finite elements know their sharp edges themselves.
#[test]
fn finite_elements_have_the_same_figures() {
    let quick = [
        ("contact.surface", "fem".into()),
        ("fem.body", "sector".into()),
        ("fem.sector_teeth", 5.into()),
        ("fem.elements_per_half_width", 3.0.into()),
        ("numerics.flank_points", 200.into()),
        ("numerics.positions", 24.into()),
        ("numerics.step.revolutions", 200_000.0.into()),
    ];
    for radius_mm in [0.0, 0.2] {
        let record = run("thesis-spur", &[rounded(radius_mm).as_slice(), &quick].concat());
        assert_zones(&record, radius_mm, 4.5);
        let new = &record.summary.new;
        println!("{new:?}");
        assert_eq!([new.sharp_edge_pressure_MPa.is_some(), warns_of_sharp_edges(&record)], [radius_mm == 0.0; 2]);
        assert_eq!(record.mesh_cycle.iter().any(|row| row.at_sharp_edge_new), radius_mm == 0.0);
        assert!(new.peak_pressure_MPa > new.pitch_pressure_MPa);
    }
}

/// A preset that is not one of the thesis's model has rounded tip edges, so that all of its pressures are defined, and nothing else to be
/// warned of, but that these runs are not verified.
#[test]
fn presets_do_not_warn_against_themselves() {
    for preset in ["fzg-c", "fzg-a", "helical", "h501", "h701", "h951"] {
        let coarse = [("numerics.flank_points", toml::Value::from(150)), ("numerics.positions", 60.into())];
        let few_slices = [
            ("helical.slices", toml::Value::from(6)),
            ("operation.pinion_revolutions", 2e4.into()),
            ("operation.snapshots_revolutions", toml::Value::Array(Vec::new())),
        ];
        let sliced = if preset.starts_with('h') { &few_slices[..] } else { &[] };
        let record = run(preset, &[&coarse[..], sliced].concat());
        assert_eq!(record.summary.new.sharp_edge_pressure_MPa, None, "{preset}");
        // What is said of every scene: that it is not verified here, and what an elastic tip edge bears.
        let of_every_scene = |said: &&String| said.contains("numerics.verify") || said.contains("hardness of steel");
        let told: Vec<&String> = record.summary.warnings.iter().filter(|said| !of_every_scene(said)).collect();
        assert!(told.is_empty(), "{preset}: {told:?}");
    }
}

/// One mesh of new flanks.
fn once(surface: &str, points: i64) -> [(&'static str, toml::Value); 5] {
    [
        ("contact.surface", surface.into()),
        ("numerics.flank_points", points.into()),
        ("operation.pinion_revolutions", 1.0.into()),
        ("operation.snapshots_h", toml::Value::Array(Vec::new())),
        ("numerics.step.revolutions", 1.0.into()),
    ]
}

/// Between the tip-edge zones of unmodified flanks the greatest pressure is Hertz's: closed form from the load share and the curvature at each
/// position, p₀² = w E/(2π (1 − ν²) R). A mean over 0.4 half-widths is 0.7 % lower, and where Hertz's mean pressure stands for the contact, π/4 of it.
#[test]
fn ver_the_flank_pressure_is_that_of_hertz_between_the_tips() {
    let surfaces = [("hertz", 1.0), ("half-space", 1.0), ("hertz-mean", 0.25 * std::f64::consts::PI)];
    for ((surface, factor), torque_nm) in surfaces.into_iter().zip([302.0, 302.0, 90.0]) {
        let load: [(&str, toml::Value); 1] = [("operation.pinion_torque_Nm", torque_nm.into())];
        let record = run("thesis-spur", &[once(surface, 750).as_slice(), &load].concat());
        let s = &record.summary;
        let ends_mm = Gear::BOTH.map(|gear| {
            let (zones, base) = (record.flanks[gear].zones, 0.5 * s.geometry.gears[gear].base_diameter_mm);
            (zones.tip_edge_radius_mm.powi(2) - base.powi(2)).sqrt()
        });
        let whole_mm = s.geometry.line_of_action_mm;
        let between = record
            .mesh_cycle
            .iter()
            .filter(|row| row.position_mm <= ends_mm[0] && whole_mm - row.position_mm <= ends_mm[1]);
        let hertz = |position_mm: f64, load: f64| {
            let radius_mm = position_mm * (whole_mm - position_mm) / whole_mm;
            (load * 206e3 / (0.91 * 2.0 * std::f64::consts::PI * radius_mm)).sqrt()
        };
        let greatest = between
            .map(|row| hertz(row.position_mm, row.load_share_new * s.contact.line_load_N_per_mm))
            .fold(0.0, f64::max);
        let found = s.new.flank_pressure_MPa / (factor * greatest);
        println!("{surface}: {} MPa, {found} of the closed form", s.new.flank_pressure_MPa);
        assert!((0.99..1.003).contains(&found), "{surface}: {found}");
    }
}

/// A linear relief begins in a kink, where the pressure has no limit: its mean over a length has one, which is approached by the order of one in
/// the distance of points (2483, 2586 MPa with 400 and 1600 points).
#[test]
fn ver_the_flank_pressure_settles_at_a_kink() {
    let relief =
        |gear: &str, key: &str, value: f64| (format!("pair.{gear}.tip_relief.{key}"), toml::Value::from(value));
    let relieved: Vec<(String, toml::Value)> = ["pinion", "wheel"]
        .into_iter()
        .flat_map(|gear| [relief(gear, "amount_um", 30.0), relief(gear, "length_mm", 2.0)])
        .collect();
    let relieved: Vec<(&str, toml::Value)> =
        relieved.iter().map(|(key, value)| (key.as_str(), value.clone())).collect();
    let [coarse, fine, finest] = [400, 1600, 3200].map(|points| {
        let record = run("thesis-spur", &[once("half-space", points).as_slice(), &relieved].concat());
        [record.summary.new.flank_pressure_MPa, record.summary.new.peak_pressure_MPa]
    });
    println!("flank {} and {} MPa, at a point {} and {} MPa", coarse[0], fine[0], coarse[1], fine[1]);
    let changes = [(fine[0] / coarse[0] - 1.0).abs(), (finest[0] / fine[0] - 1.0).abs()];
    assert!(changes[0] < 0.05 && changes[1] < 0.015, "{changes:?}");
    assert!(fine[1] > fine[0] && fine[1] / coarse[1] > 1.02);
}
