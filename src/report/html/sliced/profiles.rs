//! Wear and pressure from root to tip in the first, the middle and the last slice.

use crate::report::chart::{Axis, DashType, Plot};

use super::{SlicedRun, slice_name};
use crate::gear::Gear;
use crate::report::html::active_flank::ActiveFlank;
use crate::report::html::number::{figure, significant};
use crate::report::html::reading::greatest;
use crate::report::html::theme::{self, Figure, curve, from_zero, layout, line, mark_path_points};
use crate::results::run::FlankRecord;

/// First, middle and last of `count` slices; fewer where there are fewer.
fn shown(count: usize) -> Vec<usize> {
    let mut slices = vec![0, count.saturating_sub(1) / 2, count.saturating_sub(1)];
    slices.dedup();
    slices
}

/// Full, dashed and dotted, in the order of the slices.
const DASHES: [DashType; 3] = [DashType::Solid, DashType::Dash, DashType::Dot];

/// The part of the flat `field` that belongs to `slice`.
fn of_slice<'a>(flank: &FlankRecord, field: &'a [f64], slice: usize) -> &'a [f64] {
    let points = flank.radius_mm.len();
    field.get(slice * points..(slice + 1) * points).unwrap_or_default()
}

/// A quantity of a figure: its name, colour and values.
struct Series<'a> {
    name: &'static str,
    colour: &'a str,
    values: &'a [f64],
}

fn plot(flank: &FlankRecord, gear: Gear, series: &[Series<'_>], y: Axis, hover: &str) -> Plot {
    let active = ActiveFlank::of(flank);
    let radius = active.cut(&flank.radius_mm);
    let mut plot = Plot::new();
    for Series { name, colour, values } in series {
        for (slice, dash) in shown(flank.width_mm.len()).into_iter().zip(DASHES) {
            let place = slice_name(flank, slice);
            let name = if name.is_empty() { place } else { format!("{name}, {place}") };
            let values = active.cut(of_slice(flank, values, slice));
            let stroke = line((*colour).to_owned(), 2.0, dash);
            plot.add_trace(curve(&name, radius.iter().copied(), values, stroke).hover_template(hover));
        }
    }
    plot.set_layout(mark_path_points(
        layout(420).show_legend(true).x_axis(active.axis(gear)).y_axis(y),
        &flank.path_point_radius_mm,
    ));
    plot
}

/// What `words` says of each slice shown, one after the other.
fn of_each(flank: &FlankRecord, words: impl Fn(usize) -> Option<String>) -> String {
    let said = shown(flank.width_mm.len()).into_iter().filter_map(|slice| Some((slice, words(slice)?)));
    let said: Vec<String> = said.map(|(slice, words)| format!("{words} in {}", slice_name(flank, slice))).collect();
    if said.is_empty() { "nothing".into() } else { said.join(", ") }
}

/// Wear depth at the end of the run.
pub fn wear(run: SlicedRun<'_>) -> Vec<Figure> {
    Gear::BOTH
        .map(|gear| {
            let flank = &run.record.flanks[gear];
            let deepest = greatest(&flank.wear_um).map_or(0.0, |peak| peak.value);
            let [_, bottom] = from_zero(deepest);
            let deepest_in = |slice: usize| {
                let peak = greatest(of_slice(flank, &flank.wear_um, slice))?;
                let radius = significant(flank.radius_mm[peak.index], 4);
                Some(format!("{} µm at {radius} mm radius", figure(peak.value)))
            };
            let y = theme::axis("wear depth, µm").range(vec![bottom, -0.02 * bottom]);
            let series = [Series { name: "", colour: theme::gear_colour(gear), values: &flank.wear_um }];
            Figure {
                id: format!("wear-{}", gear.name()),
                title: format!("Wear of the {}’s flank in three slices, root to tip", gear.name()),
                reading: format!("The {} has lost up to {}.", gear.name(), of_each(flank, deepest_in)),
                plot: plot(flank, gear, &series, y, "%{y:.3f} µm"),
                wide: false,
            }
        })
        .into()
}

/// Greatest pressure during one mesh, new and worn.
pub fn pressure(run: SlicedRun<'_>) -> Vec<Figure> {
    Gear::BOTH
        .map(|gear| {
            let flank = &run.record.flanks[gear];
            let fields = [&flank.pressure_new_MPa, &flank.pressure_worn_MPa];
            let top = fields.map(|field| greatest(field).map_or(0.0, |peak| peak.value));
            let from_new_to_worn = |slice: usize| {
                let [new, worn] = fields.map(|field| greatest(of_slice(flank, field, slice)));
                Some(format!("from {} to {} MPa", figure(new?.value), figure(worn?.value)))
            };
            let series = [("new", theme::NEW, fields[0]), ("worn", theme::WORN, fields[1])]
                .map(|(name, colour, values)| Series { name, colour, values });
            let y = theme::axis("greatest pressure, MPa").range(from_zero(top[0].max(top[1])).to_vec());
            Figure {
                id: format!("pressure-{}", gear.name()),
                title: format!("Greatest pressure on the {}’s flank in three slices", gear.name()),
                reading: format!(
                    "The greatest pressure on the {} goes {}.",
                    gear.name(),
                    of_each(flank, from_new_to_worn)
                ),
                plot: plot(flank, gear, &series, y, "%{y:.1f} MPa"),
                wide: false,
            }
        })
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_middle_and_last_slice_are_shown() {
        assert_eq!([20, 3, 2, 1].map(shown), [vec![0, 9, 19], vec![0, 1, 2], vec![0, 1], vec![0]]);
    }
}
