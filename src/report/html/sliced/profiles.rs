//! Wear and pressure from root to tip in the first, the middle and the last slice.

use super::sliced_run::{SlicedRun, slice_name};
use crate::report::chart::{Chart, Dash, NEW, WORN, gear_colour};
use crate::report::html::active_flank::ActiveFlank;
use crate::report::html::number::{figure, significant};
use crate::report::html::reading::greatest;
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::FlankRecord;

/// First, middle and last of `count` slices; fewer where there are fewer.
fn shown(count: usize) -> Vec<usize> {
    let mut slices = vec![0, count.saturating_sub(1) / 2, count.saturating_sub(1)];
    slices.dedup();
    slices
}

/// Full, dashed and dotted, in the order of the slices.
const DASHES: [Dash; 3] = [Dash::Solid, Dash::Dashed, Dash::Dot];

/// The part of the flat `field` that belongs to `slice`.
fn of_slice<'a>(flank: &FlankRecord, field: &'a [f64], slice: usize) -> &'a [f64] {
    let points = flank.radius_mm.len();
    field.get(slice * points..(slice + 1) * points).unwrap_or_default()
}

/// Draws quantities, each with its name, colour and values, in the slices shown.
fn draw(mut chart: Chart, flank: &FlankRecord, gear: Gear, quantities: &[(&str, &str, &[f64])], hover: &str) -> Chart {
    let active = ActiveFlank::of(flank);
    let radius = active.cut(&flank.radius_mm);
    for (name, colour, values) in quantities {
        for (slice, dash) in shown(flank.width_mm.len()).into_iter().zip(DASHES) {
            let place = slice_name(flank, slice);
            let name = if name.is_empty() { place } else { format!("{name}, {place}") };
            let values = active.cut(of_slice(flank, values, slice));
            chart = chart.line(name, radius.iter().copied(), values, (*colour, 2.0, dash), hover);
        }
    }
    active.across(chart.height(420), gear)
}

/// What `words` says of each slice shown, one after the other.
fn of_each(flank: &FlankRecord, words: impl Fn(usize) -> Option<String>) -> String {
    let said = shown(flank.width_mm.len()).into_iter().filter_map(|slice| Some((slice, words(slice)?)));
    let said: Vec<String> = said.map(|(slice, words)| format!("{words} in {}", slice_name(flank, slice))).collect();
    if said.is_empty() { "nothing".into() } else { said.join(", ") }
}

pub(super) fn wear(run: SlicedRun<'_>) -> Vec<Chart> {
    let of = |gear: Gear| {
        let flank = &run.record.flanks[gear];
        let deepest_in = |slice: usize| {
            let peak = greatest(of_slice(flank, &flank.wear_um, slice))?;
            let radius = significant(flank.radius_mm[peak.index], 4);
            Some(format!("{} µm at {radius} mm radius", figure(peak.value)))
        };
        let name = gear.name();
        let chart =
            Chart::new(format!("wear-{name}"), format!("Wear of the {name}’s flank in three slices, root to tip"))
                .y("wear depth, µm")
                .y_down_to(greatest(&flank.wear_um).map_or(0.0, |peak| peak.value))
                .reading(format!("The {name} has lost up to {}.", of_each(flank, deepest_in)));
        draw(chart, flank, gear, &[("", gear_colour(gear), &flank.wear_um)], "%{y:.3f} µm")
    };
    Gear::BOTH.map(of).into()
}

pub(super) fn pressure(run: SlicedRun<'_>) -> Vec<Chart> {
    let of = |gear: Gear| {
        let flank = &run.record.flanks[gear];
        let fields = [&flank.pressure_new_MPa, &flank.pressure_worn_MPa];
        let top = fields.map(|field| greatest(field).map_or(0.0, |peak| peak.value));
        let from_new_to_worn = |slice: usize| {
            let [new, worn] = fields.map(|field| greatest(of_slice(flank, field, slice)));
            Some(format!("from {} to {} MPa", figure(new?.value), figure(worn?.value)))
        };
        let name = gear.name();
        let chart =
            Chart::new(format!("pressure-{name}"), format!("Maximum pressure on the {name}’s flank in three slices"))
                .y("maximum pressure, MPa")
                .y_up_to(top[0].max(top[1]))
                .reading(format!("The maximum pressure on the {name} goes {}.", of_each(flank, from_new_to_worn)));
        draw(chart, flank, gear, &[("new", NEW, fields[0]), ("worn", WORN, fields[1])], "%{y:.1f} MPa")
    };
    Gear::BOTH.map(of).into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_middle_and_last_slice_are_shown() {
        assert_eq!([20, 3, 2, 1].map(shown), [vec![0, 9, 19], vec![0, 1, 2], vec![0, 1], vec![0]]);
    }
}
