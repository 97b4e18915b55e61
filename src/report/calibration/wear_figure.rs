//! What one mesh of unworn flanks wears.

use plotly::Plot;
use plotly::common::DashType;

use crate::calibration::Calibration;
use crate::gear::Gear;
use crate::report::html::number::figure;
use crate::report::html::theme::{Figure, axis, curve, gear_colour, layout, line};

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
    let x = axis("radius, mm").hover_format(".3f");
    let y = axis("∫ p |v_s| dt of one mesh, N/mm");
    plot.set_layout(layout(380).show_legend(true).x_axis(x).y_axis(y));
    Figure {
        id: format!("wear-{}", gear.name()),
        title: format!("Wear of the unworn {} in one mesh, per wear coefficient", gear.name()),
        reading: "By the finite-element contact, load sharing and contact at the tip edges included; times the wear \
                  coefficient it is a depth."
            .into(),
        plot,
        wide: false,
    }
}
