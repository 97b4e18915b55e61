//! Wear near root and tip over the face width: after the first mesh, and at the end of the run.
//!
//! One mesh wears a millionth of what a run does; both are shown over their mean, so that their shapes can be compared.

use super::sliced_run::SlicedRun;
use crate::report::chart::{Chart, Dash, NEW, Trace, gear_colour};
use crate::report::html::number::{figure, percent, significant};
use gearwear_bodies::gear::Gear;

pub(super) fn root_and_tip(run: SlicedRun<'_>, gear: Gear) -> Chart {
    let wear = &run.helical.wear[gear];
    let colour = gear_colour(gear);
    let title = format!("Root and tip wear of the {} over the face width", gear.name());
    let mut chart = Chart::new(format!("over-width-{}", gear.name()), title);
    let mut highest = 1.0_f64;
    for (name, values, colour, dash) in [
        ("root, first mesh", &wear.root_wear_first_mesh_um, NEW, Dash::Solid),
        ("root, end of the run", &wear.root_wear_um, colour, Dash::Solid),
        ("tip, first mesh", &wear.tip_wear_first_mesh_um, NEW, Dash::Dashed),
        ("tip, end of the run", &wear.tip_wear_um, colour, Dash::Dashed),
    ] {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        if mean > 0.0 {
            let relative: Vec<f64> = values.iter().map(|value| value / mean).collect();
            highest = relative.iter().copied().fold(highest, f64::max);
            let trace = Trace::line(name, run.helical.width_mm.iter().copied(), relative, (colour, 2.0, dash));
            chart = chart.add(trace.with_points("circle", 6).hover("%{y:.3f}"));
        }
    }
    let reading = match (wear.root_wear_um.first(), wear.root_wear_um.last()) {
        (Some(first), Some(last)) if *first > 0.0 || *last > 0.0 => format!(
            "Root of the {}: {} µm in the first slice against {} µm in the last; (first − last)/(first + last) goes from {} in the first \
             mesh to {}. (Maximum − minimum)/mean is {} at the root, {} at the tip, and {} of both together.",
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
    chart
        .x("face width, mm")
        .x_range([0.0, run.record.surface[gear].face_width_mm])
        .x_format(".2f")
        .y("wear over its mean")
        .y_up_to(highest)
        .reading(reading)
}
