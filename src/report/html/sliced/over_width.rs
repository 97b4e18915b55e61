//! Wear near root and tip over the face width: after the first mesh, and at the end of the run.
//!
//! One mesh wears a millionth of what a run does; both are shown over their mean, so that their shapes can be compared.

use crate::report::chart::{DashType, Mode, Plot};

use super::SlicedRun;
use crate::gear::Gear;
use crate::report::html::number::{figure, percent, significant};
use crate::report::html::theme::{self, Figure, NEW, axis, curve, layout, line};

/// Of one gear.
pub fn root_and_tip(run: SlicedRun<'_>, gear: Gear) -> Figure {
    let wear = &run.helical.wear[gear];
    let width = &run.helical.width_mm;
    let colour = theme::gear_colour(gear);
    let mut plot = Plot::new();
    let mut highest = 1.0_f64;
    for (name, values, colour, dash) in [
        ("root, first mesh", &wear.root_wear_first_mesh_um, NEW, DashType::Solid),
        ("root, end of the run", &wear.root_wear_um, colour, DashType::Solid),
        ("tip, first mesh", &wear.tip_wear_first_mesh_um, NEW, DashType::Dash),
        ("tip, end of the run", &wear.tip_wear_um, colour, DashType::Dash),
    ] {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        if mean > 0.0 {
            let relative: Vec<f64> = values.iter().map(|value| value / mean).collect();
            highest = relative.iter().copied().fold(highest, f64::max);
            let trace = curve(name, width.iter().copied(), relative, line(colour, 2.0, dash));
            plot.add_trace(trace.mode(Mode::LinesMarkers).hover_template("%{y:.3f}"));
        }
    }
    plot.set_layout(
        layout(380)
            .show_legend(true)
            .x_axis(axis("face width, mm").range(vec![0.0, run.slices.surface[gear].face_width_mm]).hover_format(".2f"))
            .y_axis(axis("wear over its mean").range(theme::from_zero(highest).to_vec())),
    );
    let reading = match (wear.root_wear_um.first(), wear.root_wear_um.last()) {
        (Some(first), Some(last)) if *first > 0.0 || *last > 0.0 => format!(
            "Root of the {}: {} µm in the first slice against {} µm in the last; (first − last)/(first + last) goes from {} in the first \
             mesh to {}. Greatest less least over the mean is {} at the root, {} at the tip, and {} of both together.",
            gear.name(),
            figure(*first),
            figure(*last),
            significant(wear.root_asymmetry_first_mesh, 3),
            significant(wear.root_asymmetry, 3),
            percent(wear.root_variation),
            percent(wear.tip_variation),
            percent(wear.root_tip_variation),
        ),
        _ => format!("The {}’s root has not worn.", gear.name()),
    };
    Figure {
        id: format!("over-width-{}", gear.name()),
        title: format!("Root and tip wear of the {} over the face width", gear.name()),
        reading,
        plot,
        wide: false,
    }
}
