//! What one mesh of unworn flanks wears.

use crate::report::chart::{DashType, Plot};

use crate::calibration::Calibration;
use crate::gear::Gear;
use crate::report::html::number::figure;
use crate::report::html::theme::{Figure, axis, curve, from_zero, gear_colour, layout, line};

/// One in so many points, those at the tip edge, does not set the frame.
const TIP_SHARE: usize = 40;

/// A figure for each gear.
pub fn all(calibration: &Calibration) -> Vec<Figure> {
    Gear::BOTH.into_iter().map(|gear| of(calibration, gear)).collect()
}

fn of(calibration: &Calibration, gear: Gear) -> Figure {
    let mut plot = Plot::new();
    let styles = [(1.4, DashType::Dot), (2.4, DashType::Solid), (1.6, DashType::Dash)];
    for (reference, (width, dash)) in calibration.wear_reference.iter().zip(styles.into_iter().cycle()) {
        let flank = &reference.flanks[gear];
        plot.add_trace(
            curve(
                &format!("{} N/mm", figure(reference.line_load_n_per_mm)),
                flank.radius_mm.iter().copied(),
                flank.depth_per_coefficient_n_per_mm.iter().copied(),
                line(gear_colour(gear), width, dash),
            )
            .hover_template("%{y:.4g} N/mm"),
        );
    }
    // A sharp tip edge wears out of all proportion: the frame is that of the rest.
    let top = calibration.wear_reference.iter().flat_map(|reference| {
        let depth = &reference.flanks[gear].depth_per_coefficient_n_per_mm;
        &depth[..depth.len() - depth.len() / TIP_SHARE]
    });
    let top = 1.1 * top.copied().fold(0.0, f64::max);
    let x = axis("radius, mm").hover_format(".3f");
    let y = axis("∫ p |v_s| dt of one mesh, N/mm").range(from_zero(top).to_vec());
    plot.set_layout(layout(380).show_legend(true).x_axis(x).y_axis(y));
    Figure {
        id: format!("wear-{}", gear.name()),
        title: format!("Wear of the unworn {} in one mesh, per wear coefficient", gear.name()),
        reading: "By the finite-element contact, load sharing and contact at the tip edges included; times the wear \
                  coefficient it is a depth. At the tip edge the curve may leave the frame: where it is sharp, what it wears \
                  at first is that of a singular pressure."
            .into(),
        plot,
        wide: false,
    }
}
