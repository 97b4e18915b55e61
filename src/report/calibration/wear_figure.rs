//! What one mesh of unworn flanks wears.

use crate::report::chart::{Chart, Dash, Trace, gear_colour};
use crate::report::html::number::figure;
use gearwear_bodies::gear::Gear;
use gearwear_physics::calibration::Calibration;

/// One in so many points, those at the tip edge, does not set the frame.
const TIP_SHARE: usize = 40;
/// A tip edge that wears so many times as fast as the rest of the flank is a sharp one.
const SINGULAR: f64 = 4.0;

pub(super) fn all(calibration: &Calibration) -> Vec<Chart> {
    Gear::BOTH.map(|gear| of(calibration, gear)).into()
}

fn of(calibration: &Calibration, gear: Gear) -> Chart {
    let styles = [(1.4, Dash::Dot), (2.4, Dash::Solid), (1.6, Dash::Dashed)];
    let curves = calibration.wear_reference.iter().zip(styles.into_iter().cycle()).map(|(reference, (width, dash))| {
        let flank = &reference.flanks[gear];
        let (x, y) = (flank.radius_mm.iter().copied(), flank.depth_per_coefficient_n_per_mm.iter().copied());
        let name = format!("{} N/mm", figure(reference.line_load_n_per_mm));
        Trace::line(name, x, y, (gear_colour(gear), width, dash)).hover("%{y:.4g} N/mm")
    });
    let depths = || calibration.wear_reference.iter().map(|of| &of.flanks[gear].depth_per_coefficient_n_per_mm);
    let top_of = |depths: &mut dyn Iterator<Item = &f64>| depths.copied().fold(0.0, f64::max);
    let below_tip = top_of(&mut depths().flat_map(|depth| &depth[..depth.len() - depth.len() / TIP_SHARE]));
    let anywhere = top_of(&mut depths().flatten());
    // A sharp tip edge wears out of all proportion: then the frame is that of the rest.
    let is_cut = anywhere > SINGULAR * below_tip;
    let cut = if is_cut {
        " At the tip edge, which is sharp, the curve leaves the frame: what it wears at first is that of a singular pressure."
    } else {
        ""
    };
    let title = format!("Wear of the unworn {} in one mesh, per wear coefficient", gear.name());
    Chart::new(format!("wear-{}", gear.name()), title)
        .x("radius, mm")
        .x_format(".3f")
        .y("∫ p |v_s| dt of one mesh, N/mm")
        .y_up_to(if is_cut { 1.1 * below_tip } else { anywhere })
        .add_all(curves)
        .reading(format!(
            "By the finite-element contact, load sharing and contact at the tip edges included; times the wear coefficient it \
             is a depth.{cut}"
        ))
}
