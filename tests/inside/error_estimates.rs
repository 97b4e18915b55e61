//! The error estimates of a run, against the true errors that finer runs and truer surfaces show, and what they cost.

use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::presets;
use gearwear_physics::observer::Unwatched;
use gearwear_physics::plan::Plan;
use gearwear_physics::results::run::Summary;

use super::common::loaded;

/// The thesis-spur scene with other lines.
fn scene(edits: &[(&str, &str)]) -> String {
    let mut text = presets::find("thesis-spur").unwrap().text.to_owned();
    for (from, to) in edits {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

fn run(text: &str) -> Summary {
    let resolved = Resolved::from_toml(text).unwrap_or_else(|problems| panic!("{problems:?}"));
    let done = runs::run(&loaded(&resolved), &Unwatched).unwrap();
    assert!(done.failure.is_none());
    done.record.summary
}

const POINTS: &str = "flank_points = 750 ";
const POSITIONS: &str = "positions = 400 ";
const STEP: &str = "step = { revolutions = 7665.0 }";
const SURFACE: &str = "surface = \"winkler\"";
const MATCH: &str = "match = \"half-width\"";

/// Steps of this many revolutions, points and positions of the thesis-spur scene over `by`.
fn resolution(by: usize, step_revolutions: f64) -> [(&'static str, String); 3] {
    [
        (POINTS, format!("flank_points = {} ", 750 / by)),
        (POSITIONS, format!("positions = {} ", 400 / by)),
        (STEP, format!("step = {{ revolutions = {step_revolutions:.1} }}")),
    ]
}

fn with(surface: &str, by: usize, step_revolutions: f64) -> String {
    let of_resolution = resolution(by, step_revolutions);
    let surface = format!("surface = \"{surface}\"");
    let mut edits: Vec<(&str, &str)> = of_resolution.iter().map(|(from, to)| (*from, to.as_str())).collect();
    edits.push((SURFACE, &surface));
    if !surface.contains("winkler") {
        edits.push((MATCH, "# match = \"half-width\""));
    }
    scene(&edits)
}

/// The same scene, held against no life on finite elements.
fn unverified(text: &str) -> String {
    text.replace("error_estimate = true", "error_estimate = true\nverify = false")
}

/// Whether an estimate is within a factor of three of the true value, or both are below what the truth itself is known to.
fn assert_tells(what: &str, estimate: Option<f64>, truth: f64, negligible: f64) {
    let estimate = estimate.unwrap_or_else(|| panic!("{what}: not estimated"));
    let fits = estimate <= 3.0 * truth && truth <= 3.0 * estimate;
    assert!(fits || estimate.max(truth) < negligible, "{what}: estimated {estimate:.5}, true {truth:.5}");
}

/// The true error of the wear step is what a run with an eighth of the step shows, that of the spacing what four times the
/// points and positions show; both keep 1/8 and 1/16 of the error themselves, far below the factor allowed.
#[test]
fn val_estimates_tell_the_errors_that_finer_runs_show() {
    let long_step = 20_000.0;
    for surface in ["winkler", "hertz"] {
        let coarse = run(&unverified(&with(surface, 2, long_step)));
        let fine_step = run(&unverified(&with(surface, 2, long_step / 8.0)));
        let fine_spacing =
            with(surface, 1, long_step).replace("points = 750", "points = 1500").replace("= 400", "= 800");
        let fine_spacing = run(&unverified(&fine_spacing));
        let peak = coarse.pinion.peak_wear_um;
        let truth = |finer: &Summary| (finer.pinion.peak_wear_um - peak).abs() / peak;
        assert_tells(&format!("{surface}, wear step"), coarse.error.wear_step, truth(&fine_step), 1e-3);
        assert_tells(&format!("{surface}, spacing"), coarse.error.discretisation, truth(&fine_spacing), 1e-3);
    }
}

/// The surface model is what a whole run on finite elements differs by, on another mesh than the verification's.
#[test]
fn val_the_surface_model_tells_the_difference_of_whole_runs() {
    let elements = run(&with("fem", 2, 15_330.0)
        .replace("[wear]", "[fem]\nelements_per_half_width = 5\n[wear]")
        .replace("step = { revolutions = 15330.0 }", "step = \"adaptive\"\nverify = false")
        .replace("tip_contact = false", "# tip_contact"));
    for surface in ["hertz", "winkler"] {
        let own = run(&with(surface, 2, 15_330.0));
        let off = |own: f64, truth: f64| (own / truth - 1.0).abs();
        let truth = off(own.pinion.peak_wear_um, elements.pinion.peak_wear_um)
            .max(off(own.wheel.peak_wear_um, elements.wheel.peak_wear_um));
        let told = own.error.surface_model.expect("verified");
        assert!((told - truth).abs() < 0.015, "{surface}: {told} {truth}");
    }
}

/// Companions cost at most half of the run, counted in equilibria weighted by their time; where that leaves no room for an
/// estimate, the summary says so.
#[test]
fn companions_cost_at_most_half_of_the_run() {
    for surface in ["winkler", "hertz", "hertz-mean", "half-space"] {
        let longer = (surface == "winkler").then_some((2, 7_665.0));
        for (by, step) in [(4, 100_000.0)].into_iter().chain(longer) {
            let error = run(&with(surface, by, step)).error;
            let cost = error.companions_cost.expect("estimates were made");
            // Nothing is run where longer steps would swing: on half-planes with the longer of both.
            let may_swing = surface == "half-space" && step > 10_000.0;
            assert!((cost > 0.0 || may_swing) && cost <= 0.5, "{surface}: {cost}");
            let (sources, how) =
                ([error.wear_step, error.surface_model], [&error.how.wear_step, &error.how.surface_model]);
            for (estimate, how) in sources.into_iter().zip(how) {
                assert!(estimate.is_some() || how.starts_with("not estimated: "), "{how}");
            }
        }
    }
}

/// A run on finite elements is verified by one of elements and positions half as long again, and claims its difference to that with 0.6 % added: what a
/// scene with these finds.
#[test]
fn val_finite_elements_are_verified_on_coarser_ones() {
    let edits = resolution(4, 40_000.0);
    let mut edits: Vec<(&str, &str)> = edits.iter().map(|(from, to)| (*from, to.as_str())).collect();
    edits.extend([
        (SURFACE, "surface = \"fem\""),
        (MATCH, "# match = \"half-width\""),
        ("tip_contact = false", "tip_contact = true"),
        ("[pair.pinion] ", "[pair.pinion]\ntip_rounding_mm = 0.1 "),
        ("[pair.wheel]", "[pair.wheel]\ntip_rounding_mm = 0.1"),
    ]);
    let text = scene(&edits);
    let summary = run(&text);
    let deepest_um = [&summary.pinion, &summary.wheel].map(|own| own.peak_wear_um.max(own.tip_edge_wear_um));
    let tolerance_um = 0.03 * deepest_um[0].max(deepest_um[1]);
    let adaptive = format!("step = \"adaptive\"\ntolerance_um = {tolerance_um}");
    let coarser = unverified(&text)
        .replace("positions = 100 ", "positions = 67 ")
        // A verification keeps no states on its way, at which its steps would end.
        .replace("0.25, 0.75, 1.75, 3.75, 7.75, 15.75, 31.75, 63.75, 127.75", "127.75")
        .replace("step = { revolutions = 40000.0 }", &adaptive);
    let coarser = run(&format!("{coarser}\n[fem]\nelements_per_half_width = 2.0\n"));
    let error = summary.error;
    let total = &error.total;
    let of_gears = [
        (summary.pinion.peak_wear_um, coarser.pinion.peak_wear_um, total.peak_wear.pinion),
        (summary.wheel.peak_wear_um, coarser.wheel.peak_wear_um, total.peak_wear.wheel),
    ];
    for (own, check, claimed) in of_gears {
        let (off, claimed) = ((own / check - 1.0).abs(), claimed.expect("verified"));
        assert!((claimed - off - 0.006).abs() < 1e-9, "{claimed} {off}");
    }
    let errors = [total.profile.pinion, total.profile.wheel, total.peak_wear.pinion, total.peak_wear.wheel];
    // The uncertainty that the finite elements claim is 0.6 %; a coarse path of 100 positions leaves some more.
    assert!(errors.iter().all(|error| error.is_some_and(|error| error < 0.04)), "{total:?}");
    assert_eq!(error.surface_model, None, "finite elements are their own reference");
}

/// A run is held against the same wear simulation with finite elements: the thesis's model, which stops at A and E, misses the wear at the tips by
/// far, and half-planes with contact at tip edges do not; without verification nothing is claimed, and that is said.
#[test]
fn runs_are_verified_by_finite_elements() {
    let rounded = [
        ("[pair.pinion] ", "[pair.pinion]\ntip_rounding_mm = 0.1 "),
        ("[pair.wheel]", "[pair.wheel]\ntip_rounding_mm = 0.1"),
    ];
    let coarse = resolution(2, 20_000.0);
    let profile = |edits: &[(&str, &str)]| {
        let of_resolution = coarse.iter().map(|(from, to)| (*from, to.as_str()));
        run(&scene(&of_resolution.chain(edits.iter().copied()).collect::<Vec<_>>())).error.total.profile
    };
    let thesis = profile(&rounded);
    let half_planes = profile(
        &[
            &rounded[..],
            &[
                (SURFACE, "surface = \"half-space\""),
                (MATCH, "# none"),
                ("tip_contact = false", "tip_contact = true"),
                ("model = \"constant\"", "model = \"fem\""),
                ("pair_N_per_mm_um", "# pair_N_per_mm_um"),
            ],
        ]
        .concat(),
    );
    for (coarse, fine) in [(thesis.pinion, half_planes.pinion), (thesis.wheel, half_planes.wheel)] {
        let (coarse, fine) = (coarse.expect("verified"), fine.expect("verified"));
        assert!(coarse > 0.15 && fine < 0.06, "{coarse} {fine}");
    }
    let unverified = run(&unverified(&with("winkler", 4, 100_000.0)));
    assert_eq!(unverified.error.total.peak_wear.pinion, None);
    assert!(unverified.error.total.how.contains("numerics.verify is false"), "{:?}", unverified.error.total);
    assert!(
        unverified.warnings.iter().any(|warning| warning.contains("the error against finite elements is unknown")),
        "{:?}",
        unverified.warnings
    );
}

/// Tip edges worn by some hundredths of a micrometre touch on less than a usual element of their rounding, and the verification has shorter ones: both tip edges
/// of a pair of 16 and 69 teeth then claim how far they are from 0.11706 and 0.01708 µm, which the same scene finds with `surface = "fem"`, twelve elements in a
/// half-width, 800 positions and `tolerance_um = 0.001`.
#[test]
fn val_hardly_worn_tip_edges_are_verified_on_short_elements() {
    let of = |coefficient: f64| {
        run(&format!(
            "[pair]\nnormal_module_mm = 3.0\npressure_angle_deg = 20.0\ncentre_distance_mm = 128.4405\nface_width_mm = 22.588\n\
             [pair.pinion]\nteeth = 16\nprofile_shift = 0.566\ntip_rounding_mm = 0.1381\n\
             [pair.wheel]\nteeth = 69\nprofile_shift = -0.244\ntip_rounding_mm = 0.1008\n\
             [operation]\npinion_torque_Nm = 150.0\npinion_revolutions = 1e6\n\
             [contact]\nsurface = \"half-space\"\n\
             [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = {coefficient:e}\n[numerics]\nerror_estimate = false\n"
        ))
    };
    let light = of(1e-19);
    assert!(light.error.total.how.contains("short on tip roundings"), "{}", light.error.total.how);
    let total = &light.error.total.tip_edge_wear;
    let of_gears = [(&light.pinion, total.pinion, 0.11706), (&light.wheel, total.wheel, 0.01708)];
    for (wear, claimed, converged_um) in of_gears {
        let (claimed, off) = (claimed.expect("verified"), (wear.tip_edge_wear_um / converged_um - 1.0).abs());
        // The verification's own uncertainty, 1.5 %, is in the claim.
        assert!(claimed > 0.9 * off && claimed < 1.6 * off.max(0.015), "{off} {claimed}");
    }
    let ordinary = of(3e-17);
    assert!(!ordinary.error.total.how.contains("short on tip roundings"), "{}", ordinary.error.total.how);
}

/// Left out where the scene says so, with the reason.
#[test]
fn no_estimates_where_the_scene_wants_none() {
    let text = with("winkler", 4, 100_000.0).replace("error_estimate = true", "error_estimate = false\nverify = false");
    let error = run(&text).error;
    assert_eq!([error.discretisation, error.wear_step, error.surface_model, error.companions_cost], [None; 4]);
    assert_eq!(error.how.discretisation, "not estimated: numerics.error_estimate is false");
    assert!(
        Plan::of(&Resolved::from_toml(&text).unwrap().scene)
            .left_out
            .iter()
            .any(|s| s.kind.name() == "error-estimates")
    );
}

/// The verification of a run on finite elements is on other elements, and tells the error of their length: no companion is run for it.
#[test]
fn elements_leave_their_resolution_to_the_verification() {
    let text = with("fem", 2, 15_330.0)
        .replace("step = { revolutions = 15330.0 }", "step = \"adaptive\"")
        .replace("tip_contact = false", "# tip_contact");
    let error = run(&text).error;
    assert_eq!(error.companions_cost, Some(0.0), "{error:?}");
    let told = error.discretisation.expect("the verification tells it");
    let of_peaks = [error.total.peak_wear.pinion, error.total.peak_wear.wheel].map(|total| total.expect("verified"));
    // The totals have the uncertainty of the verification, 0.6 %, on top.
    assert!((of_peaks[0].max(of_peaks[1]) - told - 0.006).abs() < 1e-9, "{error:?}");
    assert!(run(&unverified(&text)).error.companions_cost.is_some_and(|cost| cost > 0.0));
}

/// An estimate is a matter of the run, not of threads.
#[test]
fn estimates_are_the_same_on_any_number_of_threads() {
    let text = with("winkler", 2, 20_000.0);
    let on =
        |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| run(&text).error);
    assert_eq!(on(1), on(2));
}

/// Adaptive steps estimate their own error, and their companions cost at most half of the run too, with and without severe wear.
#[test]
fn adaptive_steps_estimate_their_own_error() {
    let severe = "severe = { above_MPa = 2000.0, factor = 100.0, band_MPa = 100.0 }\n";
    for (surface, severe) in [("winkler", ""), ("winkler", severe), ("half-space", "")] {
        let text = with(surface, 2, 7_665.0)
            // A tenth of the default tolerance, of some 7 µm.
            .replace("step = { revolutions = 7665.0 }", "step = \"adaptive\"\ntolerance_um = 0.005")
            .replace("coefficient_m2_per_N", &format!("{severe}coefficient_m2_per_N"));
        let summary = run(&unverified(&text));
        let (error, work) = (summary.error, summary.work);
        let what = format!("{surface} {severe}: {error:?}, {work:?}");
        assert!(error.companions_cost.is_some_and(|cost| cost <= 0.5), "{what}");
        // Beside a severe run that takes few evaluations, those of an abrupt transition would cost more than half of it.
        let is_left_out = error.how.severe_switch.contains("would cost too much beside this one");
        assert!(error.companions_cost > Some(0.0) || !severe.is_empty() && is_left_out, "{what}");
        // 0.05 µm, the default tolerance, of some 7 µm.
        assert!(error.wear_step.is_some_and(|e| e > 0.0 && e < 0.05), "{what}");
        assert!(error.how.wear_step.contains("adaptive steps"), "{what}");
        assert_eq!(work.wear_steps + work.rejected_steps > 0, work.jacobian_probes > 0, "{what}");
    }
}

/// The wear with limits of severe wear a tenth lower and higher is that of runs with these limits, and where it hangs on them the run warns; a pressure far
/// below the limit has no such interval.
#[test]
fn val_the_interval_of_the_limit_is_that_of_other_limits() {
    let limited = |above_mpa: f64, estimate: bool| {
        let text = with("winkler", 4, 7_665.0)
            .replace("step = { revolutions = 7665.0 }", "step = \"adaptive\"\ntolerance_um = 0.05")
            .replace(
                "coefficient_m2_per_N",
                &format!(
                    "severe = {{ above_MPa = {above_mpa:?}, factor = 20.0, band_MPa = 85.0 }}\ncoefficient_m2_per_N"
                ),
            );
        let text = unverified(&text);
        run(&if estimate { text } else { text.replace("error_estimate = true", "error_estimate = false") })
    };
    let own = limited(1700.0, true);
    let limit = own.error.severe_limit.expect("wear is severe");
    assert_eq!([limit.low.limit_factor, limit.high.limit_factor], [0.9, 1.1]);
    for (at, above_mpa) in [(limit.low, 1530.0), (limit.high, 1870.0)] {
        let other = limited(above_mpa, false);
        for (told, truth) in [(at.pinion, other.pinion), (at.wheel, other.wheel)] {
            let off = [told.peak_wear_um / truth.peak_wear_um, told.pitch_wear_um / truth.pitch_wear_um];
            assert!(off.iter().all(|ratio| (ratio - 1.0).abs() < 1e-3), "{above_mpa}: {told:?}, {truth:?}");
        }
    }
    let ratio = limit.low.pinion.pitch_wear_um / limit.high.pinion.pitch_wear_um;
    let ratio = ratio.max(limit.low.wheel.pitch_wear_um / limit.high.wheel.pitch_wear_um);
    assert_eq!(
        own.warnings.iter().any(|warning| warning.contains("is sensitive to the limit")),
        ratio > 2.0,
        "{ratio}"
    );
    let far = limited(9e4, true);
    assert_eq!(far.error.severe_limit, None);
    assert!(far.error.how.severe_limit.contains("no pressure comes near"), "{:?}", far.error.how);
}

/// Roots of a steel pinion and a wheel of PA46 that wear severely, with an abrupt limit, by eleven tolerances: waves that steps leave carry pressures above
/// the limit, and where they are not damped the worn volume is a fifth too great and the greatest wear a third.
#[test]
fn ver_waves_of_steps_do_not_wear_severely() {
    let run_within = |tolerance_um: f64| {
        run(&format!(
            "[pair]\nbacklash_um = 22.08\nface_width_mm = 8.967\nnormal_module_mm = 1.096\npressure_angle_deg = 20.0\n\
             [pair.basic_rack]\naddendum_factor = 0.8026\ndedendum_factor = 1.053\nfillet_radius_factor = 0.1193\n\
             [pair.pinion]\nteeth = 15\nprofile_shift = 0.252\ntooth_thickness_allowance_um = -16.28\n\
             [pair.wheel]\nteeth = 40\nprofile_shift = 0.1874\nprofile_crowning_um = 2.122\ntip_rounding_mm = 0.01276\n\
             [material.wheel]\npreset = \"PA46\"\nyoung_modulus_GPa = 1.003\npoisson_ratio = 0.3783\n\
             [operation]\npinion_torque_Nm = 0.1118\npinion_speed_rpm = 489.7\npinion_revolutions = 250100.0\n\
             [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1.361e-16\n\
             [wear.severe]\nabove_MPa = 19.54\nband_MPa = 0.0\nfactor = 77.66\n\
             [numerics]\nverify = false\nerror_estimate = false\ntolerance_um = {tolerance_um:?}\n"
        ))
    };
    let [usual, fine] = [0.05, 0.002].map(run_within);
    let volume = usual.pinion.worn_volume_mm3 / fine.pinion.worn_volume_mm3 - 1.0;
    let peak = usual.pinion.peak_wear_um / fine.pinion.peak_wear_um - 1.0;
    println!("volume {volume:+.4}, greatest wear {peak:+.4}, {:?}", usual.work);
    assert!(volume.abs() < 0.08 && peak.abs() < 0.12, "{volume} {peak}");
    assert!(usual.work.mesh_cycles < 40, "{:?}", usual.work);
}

/// A limit of severe wear far above every pressure takes no evaluation more, with slices and without, and the wear is the same but for rounding: with a limit
/// the wear of a contact is summed cell by cell. A limit that tip edges come near takes shorter steps.
#[test]
fn ver_a_limit_out_of_reach_costs_nothing() {
    let run_with = |pair: &str, severe: &str| {
        run(&format!(
            "[pair]\npreset = \"{pair}\"\n[operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 100.0\npinion_revolutions = 2e5\n\
             [contact]\nsurface = \"half-space\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n{severe}\n\
             [numerics]\nverify = false\nerror_estimate = false\nflank_points = 300\npositions = 60\n"
        ))
    };
    for pair in ["fzg-c", "helical"] {
        let severe = |above: &str| format!("severe = {{ above_MPa = {above}, factor = 100.0, band_MPa = 0.0 }}");
        let mild = run_with(pair, "");
        let far = run_with(pair, &severe("1e5"));
        let evaluations = |run: &Summary| {
            let work = &run.work;
            [work.wear_steps, work.rejected_steps, work.stages, work.jacobian_probes, work.mesh_cycles, work.equilibria]
        };
        assert_eq!(evaluations(&far), evaluations(&mild), "{pair}");
        let volume = far.pinion.worn_volume_mm3 / mild.pinion.worn_volume_mm3 - 1.0;
        assert!(volume.abs() < 1e-4, "{pair}: {volume:e}");
        let near = run_with(pair, &severe("1e4"));
        println!(
            "{pair}: {} mesh cycles, {} with a limit that tip edges come near",
            mild.work.mesh_cycles, near.work.mesh_cycles
        );
        assert!(near.work.mesh_cycles > mild.work.mesh_cycles, "{pair}: {:?}", near.work);
    }
}

/// Where the contact is too narrow to be meshed, or teeth cannot be had in space, the run has its result, and says why nothing vouches for it.
#[test]
fn what_finite_elements_cannot_vouch_for_is_said() {
    let light = with("winkler", 4, 100_000.0).replace("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 0.1");
    let light = run(&light);
    assert_eq!(light.error.total.peak_wear.pinion, None);
    assert!(light.error.total.how.contains("too narrow to be meshed"), "{:?}", light.error.total);
    assert!(light.warnings.iter().any(|warning| warning.contains("not verified")), "{:?}", light.warnings);
    assert!(light.pinion.peak_wear_um > 0.0);
    let crowned = with("winkler", 4, 100_000.0).replace("[pair.pinion] ", "[pair.pinion]\nlead_crowning_um = 5.0 ");
    let crowned = run(&format!("{crowned}\n[fem]\nbody = \"sector\"\n"));
    assert_eq!(crowned.error.total.profile.wheel, None);
    assert!(crowned.error.total.how.contains("fem.body"), "{:?}", crowned.error.total);
}
