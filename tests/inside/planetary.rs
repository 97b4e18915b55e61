//! Planetary stages: the pairs that they are made of, and what follows for the stage.

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use gearwear::planetary_run::{self, record::PlanetaryRecord};
use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::SceneText;
use gearwear::scene::planetary::PlanetaryScene;
use gearwear::scene::planetary::mesh::StageMesh;
use gearwear::{LoadedScene, RunFiles, evaluate};
use gearwear_bodies::gear::GearPair;
use gearwear_bodies::gear::planetary::ring_mesh_phase;
use gearwear_physics::observer::{Observer, Unwatched};
use gearwear_physics::results::run::{RunRecord, StopReason};
use gearwear_physics::simulation::settings::Operation;

use super::common::loaded;

/// What both meshes have in common, beside teeth, operation and law.
const COMMON: &str = "[contact]\nsurface = \"hertz\"\n[numerics]\nerror_estimate = false\nverify = false\nflank_points = 150\npositions = 60\n";

/// A stage 20/20/60 with four planets, 600 N·m on its sun.
pub(super) const STAGE: &str = r#"
[planetary]
planets = 4
load_sharing_factor = 1.2
normal_module_mm = 3.0
pressure_angle_deg = 20.0
centre_distance_mm = 60.0
face_width_mm = 20.0
sun = { teeth = 20, profile_shift = -0.3 }
planet = { teeth = 20, profile_shift = 0.3 }
ring = { teeth = 60, profile_shift = -0.3, tip_diameter_mm = 176.2, cutter = { teeth = 25 } }
[operation]
torque_Nm = 600.0
speed_rpm = 1000.0
revolutions = 4e4
[wear]
law = "archard"
coefficient_m2_per_N = 1e-17
"#;

pub(super) fn stage(text: &str) -> PlanetaryScene {
    let given = SceneText { name: "stage of a test".to_owned(), text: text.to_owned() };
    PlanetaryScene::from_text(given, Path::new("")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn run(text: &str) -> PlanetaryRecord {
    let done = planetary_run::run(&stage(text), &Unwatched).unwrap();
    assert!(done.failure.is_none());
    done.record
}

fn with_common(text: &str) -> String {
    format!("{text}{COMMON}")
}

/// The example is a stage as it stands.
#[test]
fn the_example_is_a_stage() {
    let example = stage(include_str!("../../examples/planetary_stage.toml"));
    assert!((4.0 * example.stage.sun_turns_relative_to_carrier(example.member).unwrap() - 3.24).abs() < 1e-12);
}

/// Both meshes are the pairs of their gears on the carrier: torques, speeds and meshes by Willis's equation, by hand.
#[test]
fn ver_meshes_are_pairs_on_the_carrier() {
    let stage = stage(&with_common(STAGE));
    let pair = "normal_module_mm = 3.0\npressure_angle_deg = 20.0\ncentre_distance_mm = 60.0\nface_width_mm = 20.0\n";
    // n_c = n_s z_s/(z_s + z_r): the sun turns 3/4 as often on the carrier. 1.2 × 600 N·m / 4 planets.
    let sun_planet = format!(
        "[pair]\n{pair}[pair.pinion]\nteeth = 20\nprofile_shift = -0.3\n[pair.wheel]\nteeth = 20\nprofile_shift = 0.3\n\
         [operation]\npinion_torque_Nm = 180.0\npinion_speed_rpm = 750.0\npinion_revolutions = 3e4\nmeshes_per_revolution = {{ pinion = 4 }}\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n{COMMON}"
    );
    let planet_ring = format!(
        "[pair]\n{pair}[pair.pinion]\nteeth = 20\nprofile_shift = 0.3\n[pair.wheel]\nteeth = 60\ninternal = true\nprofile_shift = -0.3\n\
         tip_diameter_mm = 176.2\ncutter = {{ teeth = 25 }}\n\
         [operation]\npinion_torque_Nm = 180.0\npinion_speed_rpm = 750.0\npinion_revolutions = 3e4\nmeshes_per_revolution = {{ wheel = 4 }}\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n{COMMON}"
    );
    for (mesh, by_hand) in [(StageMesh::SunPlanet, sun_planet), (StageMesh::PlanetRing, planet_ring)] {
        let by_hand = Resolved::from_toml(&by_hand).unwrap();
        let own = &stage.meshes[mesh].resolved;
        assert_eq!(own.scene, by_hand.scene, "{mesh:?}");
        let done = runs::run(&loaded(&by_hand), &Unwatched).unwrap().record;
        assert!(done.summary.pinion.peak_wear_um > 0.0);
    }
}

/// A stage that is driven at its carrier, or whose sun is held, is the same stage: each tooth meets as many mates under the same load.
#[test]
fn ver_the_given_member_does_not_matter() {
    let by_sun = stage(&with_common(STAGE));
    // T_c = T_s (z_s + z_r)/z_s, n_c = n_s z_s/(z_s + z_r).
    let by_carrier = STAGE.replace(
        "torque_Nm = 600.0\nspeed_rpm = 1000.0\nrevolutions = 4e4",
        "member = \"carrier\"\ntorque_Nm = 2400.0\nspeed_rpm = 250.0\nrevolutions = 1e4",
    );
    let held_sun = by_carrier
        .replace("planets = 4\n", "planets = 4\nheld = \"sun\"\n")
        .replace("speed_rpm = 250.0\nrevolutions = 1e4", "speed_rpm = 750.0\nrevolutions = 3e4");
    for text in [by_carrier, held_sun] {
        let other = stage(&with_common(&text));
        for mesh in StageMesh::BOTH {
            let [one, other] = [&by_sun, &other].map(|stage| &stage.meshes[mesh].scene().operation);
            for (one, other) in [
                (one.pinion_torque_n_mm, other.pinion_torque_n_mm),
                (one.pinion_revolutions, other.pinion_revolutions),
                (one.pinion_speed_rpm.unwrap(), other.pinion_speed_rpm.unwrap()),
            ] {
                assert!((one / other - 1.0).abs() < 1e-12, "{mesh:?}: {one} and {other}");
            }
        }
    }
}

/// Tables of one mesh lie above those of both, those of a gear go to its pairs.
#[test]
fn tables_of_a_mesh_lie_above_those_of_both() {
    let text = format!(
        "{STAGE}[wear.ring]\ncoefficient_m2_per_N = 2e-17\n[planet_ring.contact]\nsurface = \"hertz-mean\"\n\
         [sun_planet.planet]\ntip_relief = {{ amount_um = 10.0, length_mm = 1.0 }}\n{COMMON}"
    );
    let stage = stage(&text);
    let relief = |mesh: StageMesh| {
        let gears = &stage.meshes[mesh].scene().pair.gears;
        [&gears.pinion, &gears.wheel].map(|gear| gear.modification.tip_relief.is_some())
    };
    assert_eq!([relief(StageMesh::SunPlanet), relief(StageMesh::PlanetRing)], [[false, true], [false, false]]);
    let surface = StageMesh::BOTH.map(|mesh| stage.meshes[mesh].scene().contact.surface.name());
    assert_eq!(surface, ["hertz", "hertz-mean"]);
    let laws = |mesh: StageMesh| stage.meshes[mesh].resolved.file.wear.wheel.is_some();
    assert_eq!(StageMesh::BOTH.map(laws), [false, true]);
}

/// The transmission error of four planets that share a pitch evenly repeats itself four times over it, and has the means of both meshes.
#[test]
fn ver_transmission_error_of_planets_out_of_phase() {
    // (21 + 63)/4 planets: the sun's 21 teeth leave a quarter of a pitch from planet to planet.
    let text = STAGE
        .replace("teeth = 20, profile_shift = -0.3", "teeth = 21, profile_shift = -0.3")
        .replace("teeth = 20, profile_shift = 0.3", "teeth = 21, profile_shift = 0.3")
        .replace(
            "teeth = 60, profile_shift = -0.3, tip_diameter_mm = 176.2",
            "teeth = 63, profile_shift = -0.3, tip_diameter_mm = 185.2",
        )
        .replace("centre_distance_mm = 60.0", "centre_distance_mm = 63.0");
    let record = run(&with_common(&text));
    let rows = &record.transmission_error;
    let quarter = rows.len() / 4;
    let whole = record.summary.transmission_error.new.unwrap();
    let of_mesh = record.summary.meshes.sun_planet.as_ref().unwrap().new.transmission_error_um;
    assert!(whole.peak_to_peak > 0.0 && whole.peak_to_peak < of_mesh.peak_to_peak);
    for row in 0..quarter {
        let off = rows[row].stage_new_um - rows[row + quarter].stage_new_um;
        assert!(off.abs() < 1e-9, "{off} µm at {}", rows[row].mesh_phase);
    }
    let mean = |of: fn(&gearwear::planetary_run::record::StageTransmissionRow) -> f64| {
        rows.iter().map(of).sum::<f64>() / rows.len() as f64
    };
    let off = mean(|row| row.stage_new_um) - mean(|row| row.sun_planet_new_um) - mean(|row| row.planet_ring_new_um);
    assert!(off.abs() < 1e-9, "{off}");
    // In phase, the planets add nothing to one another.
    let together = run(&with_common(STAGE));
    for row in &together.transmission_error {
        let off = row.stage_new_um - row.sun_planet_new_um - row.planet_ring_new_um;
        assert!(off.abs() < 1e-9, "{off}");
    }
}

/// Parker and Lin, J. Mech. Des. 126 (2004) 365: ½ of planets with an even number of teeth and 0 with an odd one, where flanks are standard.
#[test]
fn val_phase_of_a_planets_mesh_with_the_ring() {
    for (planet_teeth, ring_teeth, centre_distance_mm, expected) in [(20, 60, 40.0, 0.5), (21, 62, 41.0, 0.0)] {
        let text = STAGE
            .replace("planets = 4", "planets = 2")
            .replace("normal_module_mm = 3.0", "normal_module_mm = 2.0")
            .replace("centre_distance_mm = 60.0", &format!("centre_distance_mm = {centre_distance_mm:?}"))
            .replace("teeth = 20, profile_shift = -0.3", "teeth = 20, profile_shift = 0.0")
            .replace("teeth = 20, profile_shift = 0.3", &format!("teeth = {planet_teeth}, profile_shift = 0.0"))
            .replace(
                "teeth = 60, profile_shift = -0.3, tip_diameter_mm = 176.2",
                &format!(
                    "teeth = {ring_teeth}, profile_shift = 0.0, tip_diameter_mm = {:?}",
                    f64::from(ring_teeth) * 2.0 - 2.5
                ),
            );
        let stage = stage(&with_common(&text));
        let phase = ring_mesh_phase(&stage.pairs.sun_planet, &stage.pairs.planet_ring);
        assert!((phase - expected).abs() < 1e-9, "{phase} and {expected}");
    }
}

/// Interrupts after some looks.
struct After(AtomicUsize);

impl Observer for After {
    fn interrupted(&self) -> bool {
        self.0.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |left| Some(left.saturating_sub(1))) == Ok(0)
    }
}

/// What a run leaves but for times.
fn timeless(run: &RunRecord) -> RunRecord {
    let mut run = run.clone();
    run.summary.wall_s = 0.0;
    run.summary.stages.iter_mut().for_each(|stage| stage.wall_s = 0.0);
    run
}

/// A stage that is interrupted in either mesh goes on to the same results, and a complete one is read again.
#[test]
fn an_interrupted_stage_goes_on_to_the_same_results() {
    let scene = stage(&with_common(STAGE));
    let whole = planetary_run::run(&scene, &Unwatched).unwrap().record;
    let mut interrupted = 0;
    for looks in [3, 60, 140] {
        let dir = tempfile::tempdir().unwrap();
        let watched = After(AtomicUsize::new(looks));
        interrupted += match planetary_run::run_kept(&scene, dir.path(), &RunFiles::default(), false, &watched) {
            Err(_) => 1,
            Ok(done) => usize::from(done.failure.is_some() || done.record.summary.stopped == StopReason::Interrupted),
        };
        for _ in 0..2 {
            let done = planetary_run::run_kept(&scene, dir.path(), &RunFiles::default(), true, &Unwatched).unwrap();
            for mesh in StageMesh::BOTH {
                let [own, expected] =
                    [&done.record, &whole].map(|record| timeless(record.meshes[mesh].as_ref().unwrap()));
                assert_eq!(own, expected, "{mesh:?} after {looks} looks");
            }
            assert_eq!(done.record.transmission_error, whole.transmission_error);
        }
    }
    assert!(interrupted > 0);
}

/// A mesh that the file names is a pair for every study, with the keys of the stage; torque and wear grow with K_γ.
#[test]
fn ver_studies_of_a_mesh_have_the_keys_of_the_stage() {
    let text = with_common(STAGE).replace("planets = 4", "planets = 4\nmesh = \"planet-ring\"");
    let scene = LoadedScene::from_toml(&text).unwrap();
    let key = "planetary.load_sharing_factor";
    let rows = [1.0, 1.2, 9.0].map(|factor| vec![factor.into()]);
    let found = evaluate(&scene, &[key], &rows, &["pinion.peak_wear_um"], 1, &Unwatched).unwrap();
    assert!(found.values[0][0] < found.values[1][0]);
    let own =
        runs::run(&stage(&with_common(STAGE)).meshes.planet_ring.without("operation.snapshots_h").unwrap(), &Unwatched)
            .unwrap()
            .record;
    assert!((found.values[1][0] / own.summary.pinion.peak_wear_um - 1.0).abs() < 1e-3);
    assert!(found.reasons[2].as_ref().is_some_and(|reason| reason.contains("planetary.load_sharing_factor: found 9")));
    let error = LoadedScene::from_toml(&with_common(STAGE)).unwrap_err().to_string();
    assert!(error.contains("planetary.mesh is missing; allowed: \"sun-planet\" or \"planet-ring\""), "{error}");
}

/// A random stage; half of them cannot be assembled or have planets that touch.
fn random_stage(random: &mut fastrand::Rng) -> String {
    let module = [1.0, 2.0, 3.2, 5.0][random.usize(..4)];
    let [sun, planet] = [random.u32(14..40), random.u32(14..45)];
    let planets = random.u32(1..7);
    // A ring that the planets fit in, and that can be assembled more often than not.
    let mut ring = sun + 2 * planet + random.u32(0..3);
    if random.bool() {
        ring -= (sun + ring) % planets;
    }
    let shift = 0.4 * random.f64();
    let held = ["ring", "carrier", "sun"][random.usize(..3)];
    // Modules by which the axes are farther apart than reference circles that touch; the ring makes room for them, most often.
    let apart = if random.bool() { 0.0 } else { 0.2 * random.f64() };
    let centre_distance = module * (0.5 * f64::from(sun + planet) + apart);
    let room = 0.3 * random.f64() - 0.05;
    let helix = if random.u8(..5) == 0 { 15.0 * random.f64() } else { 0.0 };
    let member = ["sun", "carrier", "ring"][random.usize(..3)];
    format!(
        "[planetary]\nplanets = {planets}\nheld = \"{held}\"\nload_sharing_factor = {:.3}\nnormal_module_mm = {module:?}\npressure_angle_deg = 20.0\n\
         helix_angle_deg = {helix:.2}\ncentre_distance_mm = {centre_distance:.3}\nface_width_mm = {:.1}\n\
         sun = {{ teeth = {sun}, profile_shift = {:.3}, tooth_thickness_allowance_um = -{:.0} }}\n\
         planet = {{ teeth = {planet}, profile_shift = {shift:.3} }}\nring = {{ teeth = {}, profile_shift = {:.3} }}\n\
         [operation]\nmember = \"{member}\"\ntorque_Nm = {:.1}\nspeed_rpm = 300.0\nhours = 1.0\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-18\n{COMMON}",
        1.0 + 0.3 * random.f64(),
        module * 8.0,
        apart - shift,
        20.0 * module,
        if random.bool() { i64::from(ring) } else { -i64::from(ring) },
        -shift - apart - room,
        100.0 * module.powi(3),
    )
}

/// Of 3,000 random stages none fails but with a key and what is allowed. Those that can be assembled keep the laws of a train: both meshes press with one force on a
/// planet, which turns on the carrier alike in both, and what enters the stage leaves it.
#[test]
fn prop_random_stages_keep_the_laws_of_a_train() {
    let mut random = fastrand::Rng::with_seed(20_261_127);
    let mut sound = 0;
    for number in 0..3_000 {
        let text = random_stage(&mut random);
        let given = SceneText { name: "stage".to_owned(), text: text.clone() };
        let stage = match PlanetaryScene::from_text(given, Path::new("")) {
            Ok(stage) => stage,
            Err(gearwear::LoadError::Scene(error)) => {
                for problem in &error.problems {
                    let named = ["planetary", "operation"].iter().any(|table| problem.key.starts_with(table));
                    assert!(named && !problem.allowed.is_empty(), "{number}: {problem}\n{text}");
                }
                continue;
            }
            Err(other) => panic!("{number}: {other}\n{text}"),
        };
        sound += 1;
        let [with_sun, with_ring] =
            StageMesh::BOTH.map(|mesh| (&stage.pairs[mesh], &stage.meshes[mesh].scene().operation));
        let near = |one: f64, other: f64, what: &str| {
            assert!(
                (one - other).abs() <= 1e-9 * one.abs().max(other.abs()),
                "{number}, {what}: {one} and {other}\n{text}"
            );
        };
        let force = |(pair, operation): (&GearPair, &Operation)| {
            operation.pinion_torque_n_mm / pair.path.involute.pinion.base_radius_mm
        };
        near(force(with_sun), force(with_ring), "force on a planet");
        near(
            with_sun.0.path.involute.wheel.base_radius_mm,
            with_ring.0.path.involute.pinion.base_radius_mm,
            "base circle of a planet",
        );
        near(with_sun.0.path.base_pitch_mm, with_ring.0.path.base_pitch_mm, "base pitch");
        let planet_turns = with_sun.1.pinion_revolutions * with_sun.0.wheel_turns_per_pinion_turn();
        near(planet_turns, with_ring.1.pinion_revolutions, "turns of a planet");
        near(with_sun.1.meshes_per_revolution.pinion, stage.stage.planets() as f64, "mates of the sun");
        near(with_ring.1.meshes_per_revolution.wheel, stage.stage.planets() as f64, "mates of the ring");
        assert!((0.0..1.0).contains(&stage.ring_mesh_phase) && stage.planet_clearance_mm.is_none_or(|gap| gap > 0.0));
    }
    assert!((250..2_700).contains(&sound), "{sound} of 3000 stages are possible");
}
