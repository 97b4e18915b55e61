//! Whether a run is of the pair that a file describes.

use super::RexsError;
use super::stage::{Figure, Gears, RexsStage};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::gear::spec::PairSpec;

/// Figures this close to each other, relatively, or as numbers without unit, are the same: scenes from REXS have twelve digits.
const SAME: f64 = 1e-6;

/// Compares teeth, module, angles, centre distance, face width and profile shifts, as far as the file determines them.
///
/// # Errors
/// [`RexsError::OtherPair`], with the first that is another.
pub(super) fn check(stage: &RexsStage, gears: &Gears, run: &PairSpec) -> Result<(), RexsError> {
    let value = |figure: &Option<Figure>| figure.as_ref().map(|figure| figure.value);
    let of_gears = [(Gear::Pinion, &gears.pinion), (Gear::Wheel, &gears.wheel)];
    let teeth = of_gears.map(|(gear, data)| {
        (format!("teeth of the {}", gear.name()), f64::from(run.gears[gear].teeth), data.teeth.map(f64::from))
    });
    let shifts = of_gears.map(|(gear, data)| {
        (format!("profile shift of the {}", gear.name()), run.gears[gear].profile_shift, value(&data.profile_shift))
    });
    let common = [
        ("normal module in mm", run.normal_module_mm, value(&gears.normal_module_mm)),
        ("normal pressure angle in deg", run.normal_pressure_angle_rad.to_degrees(), value(&gears.pressure_angle_deg)),
        ("helix angle in deg", run.helix_angle_rad.to_degrees().abs(), Some(gears.helix_angle_deg.value.abs())),
        ("centre distance in mm", run.centre_distance_mm.abs(), value(&gears.centre_distance_mm)),
        ("face width in mm", run.face_width_mm, value(&gears.face_width_mm)),
    ];
    let common = common.map(|(what, run, file)| (what.to_owned(), run, file));
    for (what, run, file) in teeth.into_iter().chain(common).chain(shifts) {
        let Some(file) = file else { continue };
        if (run - file).abs() > SAME * file.abs().max(1.0) {
            let (found, allowed) = (run.to_string(), file.to_string());
            return Err(RexsError::OtherPair { what, found, allowed, stage: stage.component.label() });
        }
    }
    Ok(())
}
