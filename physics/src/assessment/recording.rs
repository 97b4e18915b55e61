//! Record of a run: from its outcome in the program's units to the units of the output files.

use super::lubrication::{self, LubricationFindings};
use super::slices::MESH_ORDERS;
use super::temperature::{self, ObservedHeat};
use super::{
    RunError, RunModel, UM_PER_MM, drawing, error_estimates, invariants, law_without_effect, left_out_contact, phases,
    root_stress, severe_pressure, slices, stability::Judged, torque_curve, verification::Verified,
};
use crate::contact::flank_pressure::{PressureFigures, TIP_EDGE_MEAN_OVER_MM};
use crate::mesh_cycle::CycleObservation;
use crate::mesh_cycle::wearing_pair::Snapshot;
use crate::operation::Scene;
use crate::plan::Plan;
use crate::results::error::ErrorSummary;
use crate::results::iso_stiffness::IsoStiffnessSummary;
use crate::results::life::LifeSummary;
use crate::results::provenance::Provenance;
use crate::results::run::{
    ContactSummary, CycleSummary, FlankRecord, GearSummary, GeometrySummary, HistoryRow, MeshCycleRow, OverLifeSummary,
    PathPoints, RangeSummary, RunRecord, StageLeftOut, StiffnessSummary, Summary, WearBalance, WearSummary,
    WorkSummary,
};
use crate::results::torque_curve::TorqueCurveRow;
use crate::results::worn_pair::WornPair;
use crate::simulation::figures::{WearFigures, wear_profile};
use crate::simulation::wear_run::{Outcome, SMALL_WEAR_MODULES};
use crate::stiffness::iso6336;
use crate::thermal::settings::TemperatureMethod;
use crate::wear::settings::WearOfPair;
use crate::wear::settings::WearSettings;
use crate::wear::vdi_2736::mean_wear_mm;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, flank_surface::FlankSurface, outline::section_mm2};
use gearwear_bodies::reference::steel_yield;

/// Flank points that the pitch point index of the output counts in.
const INDEX_POINTS: f64 = 750.0;
/// Relative difference of the volumes that both flanks of a contact lose, above which it is warned of.
const IMBALANCE: f64 = 0.02;

/// Outcome of a run with the observations of it.
#[derive(Clone, Copy)]
pub(super) struct RunFindings<'a> {
    pub outcome: &'a Outcome,
    pub heat: Option<&'a ObservedHeat>,
    pub lubrication: Option<&'a LubricationFindings>,
    pub torque_curve: &'a [TorqueCurveRow],
    pub verified: Option<&'a Verified>,
}

/// The record of a run.
pub(super) fn record(from: &Provenance, model: &RunModel<'_>, found: RunFindings<'_>, summary: Summary) -> RunRecord {
    let outcome = found.outcome;
    RunRecord {
        summary,
        scene_toml: from.scene_toml.clone(),
        inputs: from.inputs.clone(),
        flanks: PerGear::from_fn(|gear| flank(model, found, gear)),
        history: outcome.snapshots.iter().map(|snapshot| history_row(model, outcome, snapshot)).collect(),
        mesh_cycle: mesh_cycle(model, found),
        film: found.lubrication.map_or_else(Vec::new, |observed| observed.rows.clone()),
        surface: PerGear::from_fn(|gear| FlankSurface::new(model.pair, gear)),
        slices: slices::record(outcome),
        drawing: drawing::draw(model.pair, model.scene.fem.clamp_radius_mm.wheel),
        torque_curve: found.torque_curve.to_vec(),
    }
}

/// Main figures, history, wear over both flanks and mesh cycle.
pub(super) fn worn_pair(model: &RunModel<'_>, found: RunFindings<'_>, summary: Summary) -> WornPair {
    let outcome = found.outcome;
    WornPair {
        summary,
        history: outcome.snapshots.iter().map(|snapshot| history_row(model, outcome, snapshot)).collect(),
        flanks: PerGear::from_fn(|gear| wear_profile(model.pair, outcome, gear)),
        mesh_cycle: mesh_cycle(model, found),
    }
}

/// Main figures of a run, without the times of its stages.
pub(super) fn summary(
    from: &Provenance,
    plan: &Plan,
    model: &RunModel<'_>,
    found: RunFindings<'_>,
    mut error: ErrorSummary,
    judged: Judged,
) -> Result<Summary, RunError> {
    let (scene, pair) = (model.scene, model.pair);
    let outcome = found.outcome;
    let wear_balance = balance(model, outcome);
    let worn = PerGear::from_fn(|gear| wear_figures(model, outcome, gear));
    (error.volume_balance, error.how.volume_balance) = volume_balance(model, &worn);
    let left_out = plan.left_out.iter();
    let mut summary = Summary {
        title: from.title.clone(),
        report: from.report.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: from.scene_hash.clone(),
        stopped: outcome.stop,
        hours: scene.operation.hours(outcome.worn.revolutions),
        revolutions: outcome.worn.revolutions,
        life: life(model, outcome, &worn),
        stages: Vec::new(),
        left_out: left_out
            .map(|stage| StageLeftOut { name: stage.kind.name().to_owned(), reason: stage.reason.clone() })
            .collect(),
        wall_s: 0.0,
        geometry: geometry(pair),
        helical: slices::summary(model, outcome),
        contact: contact(model, outcome),
        reference_phase: outcome.reference_phase + 1,
        phases: phases::summaries(model, outcome),
        stiffness: stiffness(model)?,
        stiffness_iso_6336_1: Some(stiffness_iso_6336_1(model)),
        root_stress: root_stress::summary(pair, model.reference().line_load_n_per_mm),
        wear: temperature::law(model, found.heat),
        wear_of_gear: temperature::law_of_gear(model, found.heat),
        temperature: found.heat.and_then(|heat| temperature::summary(model, heat)),
        lubrication: found.lubrication.map(|findings| findings.summary.clone()),
        new: cycle(pair, &outcome.new.cycle),
        worn: cycle(pair, &outcome.worn.cycle),
        transmission_error_over_life: Some(OverLifeSummary {
            mean_um: outcome.worn.over_life.mean_mm() * UM_PER_MM,
            max_um: outcome.worn.over_life.greatest_mm() * UM_PER_MM,
        }),
        transmission_error_over_torque: torque_curve::summary(found.torque_curve),
        pinion: worn.pinion,
        wheel: worn.wheel,
        invariants: invariants::of_run(model, outcome, &wear_balance),
        wear_balance,
        error,
        work: work(outcome, judged.evaluations),
        warnings: from.warnings.clone(),
    };
    let found = warnings(model, found, judged, &summary);
    summary.warnings.extend(found);
    Ok(summary)
}

/// Counts of the work of a run, after the mesh cycles of the step bound.
fn work(outcome: &Outcome, stability_probes: u64) -> WorkSummary {
    WorkSummary {
        wear_steps: outcome.steps.accepted,
        rejected_steps: outcome.steps.rejected,
        stages: outcome.steps.stages,
        jacobian_probes: outcome.steps.probes,
        stability_probes,
        mesh_cycles: outcome.work.mesh_cycles,
        equilibria: outcome.work.equilibria,
        newton_iterations: outcome.work.newton_iterations,
        pair_evaluations: outcome.work.pair_evaluations,
    }
}

/// Warnings of a run beside those of its scene, from its findings and its figures.
fn warnings(model: &RunModel<'_>, found: RunFindings<'_>, judged: Judged, figures: &Summary) -> Vec<String> {
    let (pair, outcome) = (model.pair, found.outcome);
    let mut warnings = temperature::all_warnings(figures.wear.as_ref(), &figures.wear_of_gear);
    warnings.extend(temperature::tooth_warnings(model, figures.temperature.as_ref()));
    warnings.extend(figures.lubrication.as_ref().and_then(lubrication::warning));
    let film = figures.lubrication.as_ref().and_then(|of| of.film.as_ref());
    warnings.extend(law_without_effect::warnings(model, outcome, film));
    warnings.extend(judged.warnings);
    warnings.extend(sharp_edge_warning(pair, outcome));
    warnings.extend(left_out_contact::warning(model, outcome));
    warnings.extend(deep_wear_warning(pair, outcome));
    warnings.extend(pressure_warning(model, outcome));
    warnings.extend(severe_pressure::warning(model, outcome));
    warnings.extend(imbalance_warning(&figures.wear_balance, figures.error.volume_balance));
    warnings.extend(invariants::warnings(&figures.invariants));
    warnings.extend(slices::warning(model, outcome));
    warnings.extend(error_estimates::warnings(model.scene.contact.surface, &figures.error));
    warnings.extend(found.verified.and_then(|verified| verified.warning.clone()));
    warnings
}

/// Wear coefficients k in a phase, over which both flanks lose the same volume V/k, or 1 where both are alike.
///
/// # Errors
/// Reason why the volumes do not follow from the coefficients alone.
fn unit_of_volume(model: &RunModel<'_>, phase: usize) -> Result<PerGear<f64>, String> {
    let own = model.scene.wear_in(&model.scene.operation.phases[phase]);
    let coefficients = own.as_ref().map(|own| own.coefficient_mm2_per_n);
    if let Some(gear) = Gear::BOTH.into_iter().find(|&gear| coefficients[gear] <= 0.0) {
        return Err(format!("the {} does not wear", gear.name()));
    }
    if !own.as_ref().map(|own| WearSettings { coefficient_mm2_per_n: 1.0, ..own.clone() }).are_alike() {
        return Err("the gears wear by different laws".to_owned());
    }
    // Equal coefficients leave the volumes as they are.
    Ok(if own.are_alike() { PerGear { pinion: 1.0, wheel: 1.0 } } else { coefficients })
}

/// Relative differences of the volumes that the flanks lose in one mesh from each other and from k ∫ F ds.
fn balance(model: &RunModel<'_>, outcome: &Outcome) -> WearBalance {
    let [work_new, work_worn] = [&outcome.new, &outcome.worn].map(|snapshot| beside_work(model, outcome, snapshot));
    let against_work = WearBalance { work_new, work_worn, ..WearBalance::default() };
    match unit_of_volume(model, outcome.reference_phase) {
        Err(reason) => WearBalance { not_compared: Some(reason), ..against_work },
        Ok(unit) => {
            let [new, worn] = [&outcome.new, &outcome.worn]
                .map(|snapshot| relative_difference(lost_in_a_mesh_mm2(outcome, snapshot), unit).or(Some(0.0)));
            WearBalance { new, worn, ..against_work }
        }
    }
}

/// Volume that a flank loses in one mesh per mm of face width, mm², slices added up.
fn lost_in_a_mesh_mm2(outcome: &Outcome, snapshot: &Snapshot) -> PerGear<f64> {
    PerGear::from_fn(|gear| {
        if let Some(lost) = &snapshot.lost_at_nodes {
            return lost[gear].per_mesh_mm2;
        }
        let (grid, depth) = (&outcome.grid[gear], &snapshot.depth_per_mesh_mm[gear]);
        depth.chunks_exact(grid.len()).map(|slice| grid.integral(slice)).sum()
    })
}

/// |V / (k ∫ F ds) − 1| of the gear for which it is greater; none where a law has more than its coefficient k, or neither gear wears.
fn beside_work(model: &RunModel<'_>, outcome: &Outcome, snapshot: &Snapshot) -> Option<f64> {
    let own = model.scene.wear_in(&model.scene.operation.phases[outcome.reference_phase]);
    let work_n = snapshot.cycle.sliding_work_n.filter(|work| *work > 0.0)?;
    let lost = lost_in_a_mesh_mm2(outcome, snapshot);
    let [pinion, wheel] = Gear::BOTH.map(|gear| {
        let expected = own[gear].constant_coefficient_mm2_per_n()? * work_n;
        Some(if expected > 0.0 { (lost[gear] / expected - 1.0).abs() } else { 0.0 })
    });
    let greater = pinion?.max(wheel?);
    Gear::BOTH.iter().any(|&gear| own[gear].coefficient_mm2_per_n > 0.0).then_some(greater)
}

/// |V₁/k₁ − V₂/k₂| over the greater; none where nothing is lost.
fn relative_difference(volume: PerGear<f64>, unit: PerGear<f64>) -> Option<f64> {
    let lost = PerGear::from_fn(|gear| volume[gear] / unit[gear]);
    let greater = lost.pinion.max(lost.wheel);
    (greater > 0.0).then(|| (lost.pinion - lost.wheel).abs() / greater)
}

/// [`relative_difference`] of the volumes that all teeth of each gear lose to one mate in the whole run, with how it was obtained, or why it was not.
fn volume_balance(model: &RunModel<'_>, worn: &PerGear<WearSummary>) -> (Option<f64>, String) {
    let phases = 0..model.scene.operation.phases.len();
    let unit = match phases.map(|phase| unit_of_volume(model, phase)).collect::<Result<Vec<_>, _>>() {
        Err(reason) => return (None, reason),
        Ok(units) => match units.split_first() {
            Some((first, others)) if others.iter().all(|unit| unit == first) => *first,
            _ => return (None, "the ratio of the wear coefficients is not the same in all phases".to_owned()),
        },
    };
    let mates = model.scene.operation.meshes_per_revolution;
    let of_one_mate = PerGear::from_fn(|gear| worn[gear].worn_volume_mm3 / mates[gear]);
    let balance = relative_difference(of_one_mate, unit);
    let how = "worn volumes of the whole gears over their wear coefficients, which are the same where contact and wear are resolved";
    (balance, how.to_owned())
}

/// Warns where the flanks of a contact do not lose the same, in one mesh or in the whole run.
fn imbalance_warning(balance: &WearBalance, whole: Option<f64>) -> Option<String> {
    let (in_one_mesh, whole) = (balance.new?.max(balance.worn?), whole.unwrap_or_default());
    let (when, greatest) = if whole > IMBALANCE { ("in the whole run", whole) } else { ("in one mesh", in_one_mesh) };
    (greatest > IMBALANCE).then(|| {
        format!(
            "{when} the flanks of pinion and wheel lose volumes that differ by {:.1} %, where both should lose the same for the same \
             wear coefficient: more \
             numerics.flank_points and numerics.positions, or contact.surface = \"fem\", bring them together",
            100.0 * greatest
        )
    })
}

pub(super) fn path_points(values: [f64; 5]) -> PathPoints {
    let [a, b, c, d, e] = values;
    PathPoints { A: a, B: b, C: c, D: d, E: e }
}

/// Geometry of a pair, with diameters and lengths as on a drawing: positive, of an internal wheel too (ISO 21771).
pub(super) fn geometry(pair: &GearPair) -> GeometrySummary {
    let pinion = &pair.teeth.pinion;
    let (base, tip) = (pinion.involute.base_radius_mm, pinion.tip_radius_mm);
    GeometrySummary {
        transverse_contact_ratio: pair.path.contact_ratio(),
        overlap_ratio: pair.overlap_ratio(),
        base_pitch_mm: pair.path.base_pitch_mm,
        working_pressure_angle_deg: pair.working_pressure_angle_rad.to_degrees(),
        curvature_radius_mm: path_points(pair.path.points_mm()),
        pitch_point_index: INDEX_POINTS * (pair.working_pitch_radius_mm(Gear::Pinion) - base) / (tip - base),
        line_of_action_mm: pair.path.line_of_action_mm.abs(),
        backlash_mm: pair.backlash_mm,
        gears: PerGear::from_fn(|gear| {
            let tooth = &pair.teeth[gear];
            let (span, over_balls) = (pair.span(gear), pair.over_balls(gear));
            GearSummary {
                teeth: tooth.teeth,
                reference_diameter_mm: 2.0 * tooth.reference_radius_mm.abs(),
                base_diameter_mm: 2.0 * tooth.involute.base_radius_mm.abs(),
                working_pitch_diameter_mm: 2.0 * pair.working_pitch_radius_mm(gear).abs(),
                tip_diameter_mm: 2.0 * tooth.tip_radius_mm.abs(),
                root_diameter_mm: 2.0 * tooth.root_radius_mm.abs(),
                root_form_diameter_mm: 2.0 * tooth.root_form_radius_mm.abs(),
                start_of_active_profile_diameter_mm: 2.0 * pair.active_start_radius_mm(gear).abs(),
                tooth_thickness_mm: tooth.thickness_mm(tooth.reference_radius_mm),
                tip_thickness_mm: tooth.thickness_mm(tooth.tip_radius_mm),
                tip_clearance_mm: pair.tip_clearance_mm[gear],
                undercut: tooth.undercut,
                tip_form_diameter_mm: 2.0 * pair.tip_form_radius_mm(gear).abs(),
                end_of_active_profile_diameter_mm: 2.0 * pair.active_end_radius_mm(gear).abs(),
                specific_sliding_at_root: pair.specific_sliding_at_root(gear),
                span_teeth: span.map(|span| span.teeth),
                span_mm: span.map(|span| span.span_mm),
                ball_diameter_mm: over_balls.map(|balls| balls.ball_diameter_mm),
                dimension_over_balls_mm: over_balls.map(|balls| balls.dimension_mm.abs()),
            }
        }),
    }
}

fn contact(model: &RunModel<'_>, outcome: &Outcome) -> ContactSummary {
    let at_pitch = model.at_pitch.contact.loaded(model.reference().line_load_n_per_mm);
    ContactSummary {
        surface: model.scene.contact.surface.name().to_owned(),
        line_load_N_per_mm: model.reference().line_load_n_per_mm,
        foundation_MPa_per_mm: model.foundations_mpa_per_mm[outcome.reference_phase],
        hertz_half_width_mm: at_pitch.half_width_mm,
        hertz_peak_pressure_MPa: at_pitch.peak_pressure_mpa,
    }
}

/// c', c_γα and c_γβ of the pair under the load of the reference phase.
fn stiffness_iso_6336_1(model: &RunModel<'_>) -> IsoStiffnessSummary {
    let (scene, pair) = (model.scene, model.pair);
    let load = model.reference().line_load_n_per_mm;
    let single = iso6336::single_stiffness_n_per_mm2(&scene.pair, &scene.material, load) / UM_PER_MM;
    let mesh = iso6336::mesh_over_single(pair.path.contact_ratio()) * single;
    IsoStiffnessSummary {
        single_N_per_mm_um: single,
        mesh_alpha_N_per_mm_um: mesh,
        mesh_beta_N_per_mm_um: iso6336::MISALIGNED_OVER_MESH * mesh,
    }
}

/// Stiffness of the springs of the teeth; none with finite elements.
fn stiffness(model: &RunModel<'_>) -> Result<Option<StiffnessSummary>, RunError> {
    let Some(teeth) = model.teeth else { return Ok(None) };
    let at = model.pair.path.pitch_point_mm;
    Ok(Some(StiffnessSummary {
        model: model.stiffness.name().to_owned(),
        reference_line_load_N_per_mm: teeth.reference_line_load_n_per_mm,
        pair_at_pitch_N_per_mm_um: teeth.pair_n_per_mm2(at)? / UM_PER_MM,
        teeth_at_pitch_N_per_mm_um: teeth.n_per_mm2(at)? / UM_PER_MM,
        split_remainder_at_half_load: teeth.split_remainder(at, 0.5),
    }))
}

fn cycle(pair: &GearPair, cycle: &CycleObservation) -> CycleSummary {
    let (min, max) = cycle.transmission_error_mm();
    let orders_mm = cycle.mesh_orders_mm(pair.path.base_pitch_mm, MESH_ORDERS);
    CycleSummary {
        peak_pressure_MPa: cycle.greatest_pressure.defined_mpa,
        sharp_edge_pressure_MPa: cycle.greatest_pressure.sharp_edge_mpa,
        load_imbalance: cycle.positions.iter().map(|p| p.load_imbalance.abs()).fold(0.0, f64::max),
        flank_pressure_MPa: cycle.pressure_figures.flank_mpa,
        tip_edge_line_load_N_per_mm: cycle.pressure_figures.tip_edge_line_load_n_per_mm,
        tip_edge_mean_pressure_MPa: cycle.pressure_figures.tip_edge_mean_mpa,
        pitch_pressure_MPa: cycle.peak_pressure_at_mpa(pair.path.pitch_point_mm),
        transmission_error_um: RangeSummary {
            min: min * UM_PER_MM,
            max: max * UM_PER_MM,
            peak_to_peak: (max - min) * UM_PER_MM,
        },
        mesh_orders_um: orders_mm.into_iter().map(|mm| mm * UM_PER_MM).collect(),
    }
}

fn wear_figures(model: &RunModel<'_>, outcome: &Outcome, gear: Gear) -> WearSummary {
    let (scene, pair) = (model.scene, model.pair);
    let figures = WearFigures::at(pair, gear, outcome, &outcome.worn);
    let volume_mm3 = pair.over_all_flanks(gear, figures.area_mm2);
    let mean_mm = vdi_2736_mean_wear_mm(model, outcome, gear);
    WearSummary {
        peak_wear_um: figures.peak_mm * UM_PER_MM,
        peak_wear_radius_mm: figures.peak_radius_mm.abs(),
        tip_edge_wear_um: figures.tip_edge.depth_mm * UM_PER_MM,
        tip_edge_wear_radius_mm: figures.tip_edge.radius_mm.abs(),
        below_sap_wear_um: figures.below_active.depth_mm * UM_PER_MM,
        below_sap_wear_radius_mm: figures.below_active.radius_mm.abs(),
        root_wear_um: figures.root_mm * UM_PER_MM,
        pitch_wear_um: figures.pitch_mm * UM_PER_MM,
        worn_volume_mm3: volume_mm3,
        // kg/m³ are 1e-3 mg/mm³.
        worn_mass_mg: volume_mm3 * scene.material[gear].density_kg_per_m3 * 1e-3,
        mass_kg: mass_kg(scene, pair, gear),
        normal_tip_thickness_mm: pair.normal_tip_thickness_mm(gear, figures.tip_edge.depth_mm),
        vdi_2736_mean_wear_um: mean_mm.map(|mean| mean * UM_PER_MM),
        peak_over_vdi_2736_mean_wear: mean_mm.filter(|mean| *mean > 0.0).map(|mean| figures.peak_mm / mean),
    }
}

fn mass_kg(scene: &Scene, pair: &GearPair, gear: Gear) -> f64 {
    let bore_mm = pair.spec.gears[gear].bore_diameter_mm.unwrap_or(0.0);
    let section_mm2 = section_mm2(&pair.teeth[gear], bore_mm, scene.fem.clamp_radius_mm[gear]);
    // kg/m³ are 1e-9 kg/mm³.
    section_mm2 * pair.spec.face_width_mm * scene.material[gear].density_kg_per_m3 * 1e-9
}

/// W_m of VDI 2736-2 after what has been run; none where neither gear is a plastic, or the law is more than a coefficient.
fn vdi_2736_mean_wear_mm(model: &RunModel<'_>, outcome: &Outcome, gear: Gear) -> Option<f64> {
    let scene = model.scene;
    Gear::BOTH.into_iter().any(|gear| scene.material[gear].is_plastic()).then_some(())?;
    let stretches = scene.steady_wear(gear, outcome.worn.revolutions)?;
    Some(mean_wear_mm(model.pair, gear, stretches.into_iter()))
}

/// Service life to the limits of the scene, where it has any.
fn life(model: &RunModel<'_>, outcome: &Outcome, worn: &PerGear<WearSummary>) -> Option<LifeSummary> {
    let operation = &model.scene.operation;
    let stop = operation.stop;
    if !stop.are_set() {
        return None;
    }
    let found = outcome.limit_reached;
    let revolutions = outcome.worn.revolutions;
    let not_reached = found.is_none().then(|| {
        let after = match operation.hours(revolutions) {
            Some(hours) => format!("{} h", (1e4 * hours).round() / 1e4),
            None => format!("{revolutions:.6e} pinion revolutions"),
        };
        format!(
            "after {after} the maximum wear is {:.3} µm, and {:.4} mm are left of the thinner tip",
            worn.pinion.peak_wear_um.max(worn.wheel.peak_wear_um),
            worn.pinion.normal_tip_thickness_mm.min(worn.wheel.normal_tip_thickness_mm)
        )
    });
    Some(LifeSummary {
        reached: found.map(|found| found.limit),
        gear: found.map(|found| found.gear),
        hours: found.and_then(|_| operation.hours(revolutions)),
        revolutions: found.map(|_| revolutions),
        not_reached,
        wear_limit_um: stop.wear_mm.map(|limit| limit * UM_PER_MM),
        tip_thickness_limit_mm: stop.tip_thickness_mm,
    })
}

/// Depths in µm.
fn in_um(mm: &[f64]) -> Vec<f64> {
    mm.iter().map(|value| value * UM_PER_MM).collect()
}

fn flank(model: &RunModel<'_>, RunFindings { outcome, verified, .. }: RunFindings<'_>, gear: Gear) -> FlankRecord {
    let pair = model.pair;
    let involute = pair.teeth[gear].involute;
    let rho = &outcome.grid[gear].coordinate_mm;
    // Along the transverse line of action, as drawings have them.
    let normal_mm = outcome.modification_mm[gear].iter();
    let drawn_mm: Vec<f64> = normal_mm.map(|&normal| pair.obliquity().transverse_mm(normal)).collect();
    FlankRecord {
        radius_mm: rho.iter().map(|&rho| involute.radius_mm(rho).abs()).collect(),
        roll_angle_deg: rho.iter().map(|&rho| involute.roll_angle_rad(rho).to_degrees()).collect(),
        width_mm: outcome.slices.width_mm.clone(),
        removed_um: in_um(&drawn_mm),
        sliding_mm_per_mesh: outcome.new.cycle.sliding_mm[gear].clone(),
        wear_um: in_um(&outcome.worn.wear_mm[gear]),
        verified_wear_um: verified.and_then(|verified| verified.wear_mm.as_ref()).map(|wear_mm| in_um(&wear_mm[gear])),
        pressure_new_MPa: outcome.new.cycle.pressure_mpa[gear].clone(),
        pressure_worn_MPa: outcome.worn.cycle.pressure_mpa[gear].clone(),
        snapshot_wear_um: outcome.snapshots.iter().map(|snapshot| in_um(&snapshot.wear_mm[gear])).collect(),
        snapshot_pressure_MPa: outcome.snapshots.iter().map(|s| s.cycle.pressure_mpa[gear].clone()).collect(),
        path_point_radius_mm: path_points(
            pair.path.points_mm().map(|position| pair.radius_at_mm(gear, position).abs()),
        ),
        zones: outcome.zones[gear],
    }
}

fn history_row(model: &RunModel<'_>, outcome: &Outcome, snapshot: &Snapshot) -> HistoryRow {
    let pair = model.pair;
    let pinion = WearFigures::at(pair, Gear::Pinion, outcome, snapshot);
    let wheel = WearFigures::at(pair, Gear::Wheel, outcome, snapshot);
    let depth_mm =
        outcome.grid.pinion.value_at(&snapshot.depth_per_mesh_mm.pinion, pair.active_start_rho_mm(Gear::Pinion));
    let rate = model.scene.operation.meshes_per_revolution.pinion * depth_mm;
    HistoryRow {
        hours: model.scene.operation.hours(snapshot.revolutions),
        revolutions: snapshot.revolutions,
        pinion_peak_wear_um: pinion.peak_mm * UM_PER_MM,
        pinion_root_wear_um: pinion.root_mm * UM_PER_MM,
        pinion_pitch_wear_um: pinion.pitch_mm * UM_PER_MM,
        wheel_peak_wear_um: wheel.peak_mm * UM_PER_MM,
        peak_pressure_MPa: snapshot.cycle.greatest_pressure.defined_mpa,
        transmission_error_peak_to_peak_um: snapshot.cycle.peak_to_peak_mm() * UM_PER_MM,
        pinion_peak_wear_radius_mm: pinion.peak_radius_mm,
        pinion_sap_wear_um: pinion.active_start_mm * UM_PER_MM,
        pinion_sap_wear_rate_um_per_Mrev: rate * UM_PER_MM * 1e6,
        phase: phases::number_at(model, snapshot),
        sharp_edge_pressure_MPa: snapshot.cycle.greatest_pressure.sharp_edge_mpa,
        pinion_tip_edge_wear_um: pinion.tip_edge.depth_mm * UM_PER_MM,
        wheel_tip_edge_wear_um: wheel.tip_edge.depth_mm * UM_PER_MM,
        pinion_below_sap_wear_um: pinion.below_active.depth_mm * UM_PER_MM,
        wheel_below_sap_wear_um: wheel.below_active.depth_mm * UM_PER_MM,
        flank_pressure_MPa: snapshot.cycle.pressure_figures.flank_mpa,
        tip_edge_line_load_N_per_mm: snapshot.cycle.pressure_figures.tip_edge_line_load_n_per_mm,
    }
}

fn mesh_cycle(model: &RunModel<'_>, RunFindings { outcome, heat, .. }: RunFindings<'_>) -> Vec<MeshCycleRow> {
    let positions = outcome.new.cycle.positions.iter().zip(&outcome.worn.cycle.positions);
    let (path, base_radius_mm) = (&model.pair.path, model.pair.teeth.pinion.involute.base_radius_mm);
    positions
        .enumerate()
        .map(|(k, (new, worn))| (heat.map(|heat| &heat.new.positions[k]), new, worn))
        .map(|(heat, new, worn)| MeshCycleRow {
            position_mm: new.position_mm,
            load_share_new: new.load_share,
            load_share_worn: worn.load_share,
            peak_pressure_new_MPa: new.footprint.peak_pressure_mpa,
            peak_pressure_worn_MPa: worn.footprint.peak_pressure_mpa,
            half_width_mm: new.footprint.half_width_mm,
            transmission_error_new_um: new.transmission_error_mm * UM_PER_MM,
            transmission_error_worn_um: worn.transmission_error_mm * UM_PER_MM,
            temperature_rise_K: model.scene.heat.and_then(|settings| Some(heat?.rise_k[settings.method.index()])),
            half_width_worn_mm: worn.footprint.half_width_mm,
            temperature_rise_heat_equation_K: heat.map(|heat| heat.rise_k[TemperatureMethod::HeatEquation.index()]),
            temperature_rise_williams_K: heat.map(|heat| heat.rise_k[TemperatureMethod::Williams.index()]),
            temperature_rise_tian_kennedy_K: heat.map(|heat| heat.rise_k[TemperatureMethod::TianKennedy.index()]),
            peclet_pinion: heat.map(|heat| heat.peclet.pinion),
            peclet_wheel: heat.map(|heat| heat.peclet.wheel),
            at_sharp_edge_new: new.footprint.at_sharp_edge,
            at_sharp_edge_worn: worn.footprint.at_sharp_edge,
            pinion_rotation_deg: ((new.position_mm - path.pitch_point_mm) / base_radius_mm).to_degrees(),
            mesh_stiffness_new_N_per_mm_um: new.stiffness_n_per_mm2.map(|n_per_mm2| n_per_mm2 / UM_PER_MM),
            mesh_stiffness_worn_N_per_mm_um: worn.stiffness_n_per_mm2.map(|n_per_mm2| n_per_mm2 / UM_PER_MM),
        })
        .collect()
}

/// Warns where a mathematically sharp edge carries load in any kept state.
fn sharp_edge_warning(pair: &GearPair, outcome: &Outcome) -> Option<String> {
    let is_loaded = outcome.states().any(|state| state.cycle.greatest_pressure.sharp_edge_mpa.is_some());
    is_loaded.then(|| {
        format!(
            "mathematically sharp edges carry load ({}): the pressure at an edge (sharp_edge_pressure_MPa, left out of peak_pressure_MPa) and \
             its wear (of a tip tip_edge_wear_um, left out of peak_wear_um) are not defined, they depend on the resolution; a tip edge gets a \
             pressure with tip_rounding_mm",
            sharp_edges(pair)
        )
    })
}

/// Names of the mathematically sharp edges of a pair: of tips, and those that undercut leaves.
pub(super) fn sharp_edges(pair: &GearPair) -> String {
    let tips = Gear::BOTH.into_iter().filter(|&gear| pair.spec.is_tip_sharp(gear));
    let corners = Gear::BOTH.into_iter().filter(|&gear| pair.undercut_corners()[gear]);
    let tips = tips.map(|gear| format!("the tip edge of {}", gear.name()));
    let corners = corners.map(|gear| format!("the edge that undercut leaves on {}", gear.name()));
    tips.chain(corners).collect::<Vec<_>>().join(", ")
}

/// Warns where steel would yield under the pressure of flanks or tip edges, new or worn; not of plastics, which have other limits.
fn pressure_warning(model: &RunModel<'_>, outcome: &Outcome) -> Option<String> {
    if Gear::BOTH.into_iter().any(|gear| model.scene.material[gear].is_plastic()) {
        return None;
    }
    let states = [("new", &outcome.new), ("worn", &outcome.worn)];
    let pressures = states.into_iter().flat_map(|(when, state)| {
        let PressureFigures { flank_mpa, tip_edge_mean_mpa, .. } = state.cycle.pressure_figures;
        let at_tip_edge = format!("tip edge, mean over {TIP_EDGE_MEAN_OVER_MM} mm, {when}");
        [(format!("flank, {when}"), flank_mpa), (at_tip_edge, tip_edge_mean_mpa)]
    });
    let (place, pressure_mpa) = pressures.max_by(|a, b| a.1.total_cmp(&b.1))?;
    steel_yield::warning(pressure_mpa, &place)
}

/// Warns where the wear is too deep for the stiffness and path of contact of the unworn tooth to hold.
fn deep_wear_warning(pair: &GearPair, outcome: &Outcome) -> Option<String> {
    let deepest = Gear::BOTH.map(|gear| outcome.worn.deepest_mm(gear)).into_iter().fold(0.0, f64::max);
    (deepest > SMALL_WEAR_MODULES * pair.spec.normal_module_mm).then(|| {
        format!(
            "the maximum wear, {:.1} µm, is more than {SMALL_WEAR_MODULES} modules, up to which it was measured to be within 6 % (13 % at 0.35): tooth \
             stiffness and path of contact are still those of the unworn tooth, and the result is no longer reliable",
            deepest * UM_PER_MM
        )
    })
}
