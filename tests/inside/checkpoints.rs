//! Checkpoints of every contact model, with Euler's method and with adaptive steps: a run that goes on from one has the same bits, and so
//! has a run of which none is kept.

use std::sync::Mutex;

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear_physics::assessment::{Resumption, RunError};
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::{RunRecord, StopReason};
use gearwear_physics::simulation::checkpoint::{Checkpoint, Keeper, NothingKept};
use gearwear_physics::simulation::wear_run::SimulationError;

use super::common::loaded;

/// Keeps every checkpoint there is, as it would be in a file.
#[derive(Default)]
struct AllKept(Mutex<Vec<Vec<u8>>>);

impl Keeper for AllKept {
    fn is_due(&self) -> bool {
        true
    }

    fn keep(&self, checkpoint: &Checkpoint) {
        self.0.lock().unwrap().push(postcard::to_stdvec(checkpoint).unwrap());
    }
}

fn scene(pair: &str, contact: &str, numerics: &str, more: &str) -> String {
    format!(
        "[pair]\n{pair}\n[operation]\npinion_torque_Nm = 302.0\npinion_revolutions = 1e6\n[contact]\n{contact}\n\
         [stiffness]\nmodel = \"weber-banaschek\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 2e-17\n[numerics]\nerror_estimate = false\nverify = false\n{numerics}\n{more}\n"
    )
}

/// The record, without what a clock tells.
fn run(text: &str, from: Option<Checkpoint>, keeper: &dyn Keeper) -> Result<RunRecord, RunError> {
    let resolved = Resolved::from_toml(text).unwrap();
    let resumption = Resumption { from, keeper };
    let mut done = runs::run_from(&loaded(&resolved), resumption, &Unwatched)?;
    assert_eq!(done.failure, None);
    done.record.summary.stages.clear();
    done.record.summary.wall_s = 0.0;
    Ok(done.record)
}

/// Runs `text`, and again from its checkpoint in the middle and its last; `least` of these there must be. Answers the record.
fn goes_on_to_the_same_bits(text: &str, least: usize) -> RunRecord {
    let all = AllKept::default();
    let whole = run(text, None, &all).unwrap();
    let kept = all.0.into_inner().unwrap();
    assert!(kept.len() >= least, "{} checkpoints; {:?}", kept.len(), whole.summary.work);
    let mut places = vec![kept.len() / 2, kept.len() - 1];
    places.dedup();
    for place in places {
        let checkpoint: Checkpoint = postcard::from_bytes(&kept[place]).unwrap();
        let at = checkpoint.revolutions;
        let resumed = run(text, Some(checkpoint), &NothingKept).unwrap();
        assert_eq!(resumed.summary, whole.summary, "from {at}");
        assert!(resumed == whole, "from {at}");
    }
    whole
}

const SPUR: &str = "preset = \"fzg-c\"";
const HELICAL: &str = "preset = \"helical\"";

#[test]
fn on_winkler_beds() {
    let numerics = "flank_points = 150\npositions = 400\nstep = { revolutions = 1300.0 }";
    let text = scene(SPUR, "surface = \"winkler\"\ntip_contact = true", numerics, "");
    let whole = goes_on_to_the_same_bits(&text, 3);
    assert!(run(&text, None, &NothingKept).unwrap() == whole, "without checkpoints");
}

/// With the life on finite elements that a completed run is held against: it is the same however the run got there.
#[test]
fn with_hertz_pressure() {
    let numerics = "flank_points = 150\npositions = 200\nstep = { revolutions = 900.0 }";
    let fem = "[fem]\nbody = \"sector\"\nsector_teeth = 3\nelements_per_half_width = 2";
    let text = scene(SPUR, "surface = \"hertz\"", numerics, fem).replace("verify = false", "verify = true");
    goes_on_to_the_same_bits(&text, 2);
}

#[test]
fn on_half_planes() {
    let numerics = "flank_points = 120\npositions = 20\nstep = { revolutions = 1400.0 }";
    goes_on_to_the_same_bits(&scene(SPUR, "surface = \"half-space\"\ntip_contact = false", numerics, ""), 2);
}

#[test]
fn on_finite_elements() {
    let numerics = "flank_points = 120\npositions = 90\nstep = { revolutions = 2400.0 }";
    let fem = "[fem]\nbody = \"sector\"\nsector_teeth = 3\nelements_per_half_width = 3";
    goes_on_to_the_same_bits(&scene(SPUR, "surface = \"fem\"", numerics, fem), 1);
}

#[test]
fn with_adaptive_steps() {
    let numerics = "flank_points = 150\npositions = 1000\nstep = \"adaptive\"\ntolerance_um = 2e-4";
    goes_on_to_the_same_bits(&scene(SPUR, "surface = \"winkler\"\ntip_contact = false", numerics, ""), 1);
}

/// Steps of slices are as long as a part of the positions allows, which is chosen anew from what was evaluated last.
#[test]
fn with_adaptive_steps_of_slices() {
    let numerics = "flank_points = 100\npositions = 400\nstep = \"adaptive\"\ntolerance_um = 2e-4";
    let helical = "[helical]\nslices = 20\ncoupling = \"slicing\"";
    goes_on_to_the_same_bits(&scene(HELICAL, "surface = \"winkler\"", numerics, helical), 1);
}

#[test]
fn slice_by_slice() {
    let numerics = "flank_points = 60\npositions = 60\nstep = { revolutions = 3500.0 }";
    let coupled = |coupling: &str| {
        let helical = format!("[helical]\nslices = 8\ncoupling = \"{coupling}\"");
        scene(HELICAL, "surface = \"winkler\"", numerics, &helical)
    };
    goes_on_to_the_same_bits(&coupled("none"), 1);
    goes_on_to_the_same_bits(&coupled("slicing"), 1);
    let in_space = coupled("fem").replace("\"weber-banaschek\"", "\"fem\"");
    goes_on_to_the_same_bits(&in_space, 1);
}

#[test]
fn at_contact_points() {
    for (coupling, step, least) in [("none", 195.0, 2), ("slicing", 390.0, 1)] {
        let helical = format!("[helical]\nslices = 20\ncoupling = \"{coupling}\"");
        let numerics = format!("flank_points = 60\npositions = 400\nstep = {{ revolutions = {step:?} }}");
        goes_on_to_the_same_bits(&scene(HELICAL, "surface = \"hertz-mean\"", &numerics, &helical), least);
    }
}

/// A phase begins with a clean start, so that a checkpoint may be taken there too.
#[test]
fn over_several_phases() {
    let phase = |torque: f64| format!("[[operation.phases]]\npinion_torque_Nm = {torque}\npinion_revolutions = 4e5\n");
    let text = scene(
        SPUR,
        "surface = \"winkler\"\ntip_contact = false",
        "flank_points = 100\npositions = 60\nstep = { revolutions = 8000.0 }",
        "",
    );
    let text = [text.replace("pinion_revolutions = 1e6\n", ""), phase(302.0), phase(100.0), phase(400.0)].concat();
    goes_on_to_the_same_bits(&text, 2);
    let adaptive = text.replace("step = { revolutions = 8000.0 }", "step = \"adaptive\"\ntolerance_um = 0.01");
    goes_on_to_the_same_bits(&adaptive, 2);
}

/// A life that ends at a limit, in the middle of a step.
#[test]
fn to_a_limit() {
    let numerics = "flank_points = 150\npositions = 400\nstep = { revolutions = 1300.0 }";
    let text = scene(SPUR, "surface = \"winkler\"\ntip_contact = false", numerics, "")
        .replace("[contact]", "stop = { wear_um = 8.0 }\n[contact]");
    assert_eq!(goes_on_to_the_same_bits(&text, 1).summary.stopped, StopReason::LimitReached);
}

/// What no file of this program holds, but a file could: rows of other flanks, phases that are none.
#[test]
fn a_checkpoint_of_another_run_is_refused() {
    let text = |points: u32| {
        let numerics = format!("flank_points = {points}\npositions = 400\nstep = {{ revolutions = 2500.0 }}");
        scene(SPUR, "surface = \"winkler\"\ntip_contact = false", &numerics, "")
    };
    let all = AllKept::default();
    run(&text(100), None, &all).unwrap();
    let bytes = all.0.into_inner().unwrap().remove(0);
    let checkpoint = || -> Checkpoint { postcard::from_bytes(&bytes).unwrap() };
    let refused = |checkpoint: Checkpoint, points: u32| {
        let error = run(&text(points), Some(checkpoint), &NothingKept).unwrap_err();
        assert_eq!(error, RunError::Simulation(SimulationError::OtherRun));
    };
    refused(checkpoint(), 101);
    refused(Checkpoint { phase: 1, ..checkpoint() }, 100);
    refused(Checkpoint { revolutions: 2e6, ..checkpoint() }, 100);
    refused(Checkpoint { revolutions: f64::NAN, ..checkpoint() }, 100);
    refused(Checkpoint { states: Vec::new(), ..checkpoint() }, 100);
    let mut short = checkpoint();
    short.wear_mm.wheel.pop();
    refused(short, 100);
}
