//! The record of a pair slice by slice.

use super::{RunModel, UM_PER_MM};
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::sliced_mesh::SlicedMesh;
use crate::results::run::{HelicalSummary, LineOfContactSummary, OverWidthSummary, SliceRecord};
use crate::simulation::figures::{SliceFigures, WearFigures, variation};
use crate::simulation::wear_run::Outcome;
use gearwear_bodies::gear::spec::AxisParallelism;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, lines_of_contact::LinesOfContact};

/// Mesh orders that are kept.
pub(super) const MESH_ORDERS: usize = 5;

/// New and worn mesh of a pair with slices, row beside row: worn teeth may touch farther before A and after E.
pub(super) fn meshes(outcome: &Outcome) -> Option<[SlicedMesh; 2]> {
    let (new, worn) = (outcome.new.cycle.slices.as_ref()?, outcome.worn.cycle.slices.as_ref()?);
    Some([new.with_rows_of(worn), worn.with_rows_of(new)])
}

/// Part of the peak-to-peak transmission error above which the step of a single slice is warned of.
const TELLING_STEP: f64 = 0.25;

/// Warns where the transmission error varies by little more than the steps of slices that enter and leave: those of the simplified model do so
/// all at once.
pub(super) fn warning(model: &RunModel<'_>, outcome: &Outcome) -> Option<String> {
    let [new, _] = meshes(outcome)?;
    if model.scene.contact.surface != SurfaceKind::HertzMean {
        return None;
    }
    let errors = || new.transmission_error_mm.iter().copied();
    let peak_to_peak = errors().fold(f64::NEG_INFINITY, f64::max) - errors().fold(f64::INFINITY, f64::min);
    // Slices that enter within one phase of each other make a step that is real, as spur teeth do.
    let spacing = new.base_pitch_mm / new.transmission_error_mm.len() as f64;
    let apart = outcome.slices.ahead_mm.windows(2).all(|two| (two[0] - two[1]).abs() >= spacing);
    let step = new.greatest_step_mm();
    (apart && outcome.slices.count() > 1 && step > TELLING_STEP * peak_to_peak).then(|| {
        format!(
            "helical.slices: the transmission error varies by {:.3} µm peak to peak, of which {:.3} µm is the step of a single slice that \
             enters or leaves: that part is of the slices, which \"hertz-mean\" has in contact as a whole or not at all, and not of the gears; the mesh orders see \
             less of it, more slices make it smaller, and other surfaces have no steps",
            peak_to_peak * UM_PER_MM,
            step * UM_PER_MM
        )
    })
}

/// Figures of the pair slice by slice; none where all sections are alike.
pub(super) fn summary(model: &RunModel<'_>, outcome: &Outcome) -> Option<HelicalSummary> {
    let [new, worn] = meshes(outcome)?;
    let sliced = model.sliced?;
    let um = |mm: Vec<f64>| mm.into_iter().map(|value| value * UM_PER_MM).collect();
    Some(HelicalSummary {
        slices: sliced.settings.count,
        coupling: sliced.settings.coupling.name().to_owned(),
        coupling_reach_mm: sliced.reach().map(|reach| [reach.twist_mm2.sqrt(), reach.bending_mm4.sqrt().sqrt()]),
        shaft_twist_um: PerGear::from_fn(|gear| shaft_twist_mm(model, gear).map(|mm| mm * UM_PER_MM)),
        misalignment_um: PerGear::from_fn(|gear| misalignment_mm(model, gear).map(|mm| mm * UM_PER_MM)),
        slope_of_axes_um: (model.pair.spec.axis_parallelism != AxisParallelism::default())
            .then(|| model.pair.slope_of_axes_mm() * UM_PER_MM),
        helix_angle_deg: model.pair.spec.helix_angle_rad.to_degrees(),
        base_helix_angle_deg: model.pair.base_helix_angle_rad().to_degrees(),
        total_contact_ratio: model.pair.path.contact_ratio() + model.pair.overlap_ratio(),
        width_mm: outcome.slices.width_mm.clone(),
        line_of_contact_mm: line_of_contact(model.pair),
        K_Hbeta_new: new.face_load_factor(),
        K_Hbeta_worn: worn.face_load_factor(),
        mesh_orders_new_um: um(new.mesh_orders_mm(MESH_ORDERS)),
        mesh_orders_worn_um: um(worn.mesh_orders_mm(MESH_ORDERS)),
        wear: PerGear::from_fn(|gear| over_width(model, outcome, gear)),
    })
}

fn shaft_twist_mm(model: &RunModel<'_>, gear: Gear) -> Option<f64> {
    let shaft = model.pair.spec.gears[gear].shaft?;
    let (base_radius_mm, material) = (model.pair.teeth[gear].involute.base_radius_mm, model.scene.material[gear]);
    let shear_modulus_mpa = material.elastic().shear_modulus_mpa();
    let (width_mm, load_n_per_mm) = (model.pair.spec.face_width_mm, model.reference().line_load_n_per_mm);
    Some(shaft.twist_mm(base_radius_mm, shear_modulus_mpa, width_mm, load_n_per_mm))
}

fn misalignment_mm(model: &RunModel<'_>, gear: Gear) -> Option<f64> {
    let shaft = model.pair.spec.gears[gear].shaft?;
    let young_modulus_mpa = model.scene.material[gear].young_modulus_mpa;
    let beam = shaft.beam(model.pair.tooth_force_direction(gear), young_modulus_mpa)?;
    Some(beam.misalignment_mm(model.pair.spec.face_width_mm, model.reference().line_load_n_per_mm))
}

fn line_of_contact(pair: &GearPair) -> LineOfContactSummary {
    let LinesOfContact { least_mm, mean_mm, greatest_mm } = pair.lines_of_contact();
    LineOfContactSummary { min: least_mm, max: greatest_mm, mean: mean_mm }
}

fn over_width(model: &RunModel<'_>, outcome: &Outcome, gear: Gear) -> OverWidthSummary {
    let worn = WearFigures::at(model.pair, gear, outcome, &outcome.worn).slices;
    let first = WearFigures::new(
        model.pair,
        gear,
        &outcome.grid[gear],
        &outcome.zones[gear],
        &outcome.new.depth_per_mesh_mm[gear],
    )
    .slices;
    let um = |slices: &[SliceFigures], of: fn(&SliceFigures) -> f64| -> Vec<f64> {
        slices.iter().map(|slice| of(slice) * UM_PER_MM).collect()
    };
    let asymmetry = |slices: &[SliceFigures]| {
        let (first, last) = (slices[0].root_mm, slices[slices.len() - 1].root_mm);
        if first + last > 0.0 { (first - last) / (first + last) } else { 0.0 }
    };
    let (root, tip) = (worn.iter().map(|slice| slice.root_mm), worn.iter().map(|slice| slice.tip_mm));
    OverWidthSummary {
        root_wear_um: um(&worn, |slice| slice.root_mm),
        tip_wear_um: um(&worn, |slice| slice.tip_mm),
        root_wear_first_mesh_um: um(&first, |slice| slice.root_mm),
        tip_wear_first_mesh_um: um(&first, |slice| slice.tip_mm),
        root_variation: variation(root.clone()),
        tip_variation: variation(tip.clone()),
        root_tip_variation: variation(root.chain(tip)),
        root_asymmetry_first_mesh: asymmetry(&first),
        root_asymmetry: asymmetry(&worn),
    }
}

/// The mesh of one tooth; none where all sections are alike.
pub(super) fn record(outcome: &Outcome) -> Option<SliceRecord> {
    let [new, worn] = meshes(outcome)?;
    Some(SliceRecord {
        width_mm: outcome.slices.width_mm.clone(),
        ahead_mm: outcome.slices.ahead_mm.clone(),
        position_mm: new.position_mm,
        line_load_new_N_per_mm: new.line_load_n_per_mm,
        line_load_worn_N_per_mm: worn.line_load_n_per_mm,
        peak_pressure_new_MPa: new.peak_pressure_mpa,
        peak_pressure_worn_MPa: worn.peak_pressure_mpa,
        at_sharp_edge_new: new.at_sharp_edge,
        at_sharp_edge_worn: worn.at_sharp_edge,
    })
}
