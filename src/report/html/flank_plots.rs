//! Plots over a flank whose sections are alike, from root to tip: wear at every snapshot, greatest pressure, modifications.

use super::active_flank::ActiveFlank;
use super::number::{figure, hours, percent, revolutions, significant};
use super::reading::{gear_wear, greatest, place_on_flank};
use crate::report::chart::{Chart, Dash, INK, Trace, gear_colour, gear_colour_at, gear_fill};
use crate::report::control::{Change, Control, SliderStep};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::run::{HistoryRow, RunRecord};

/// At most so many snapshots are drawn, evenly chosen: more curves than that cannot be told apart.
const CURVES: usize = 12;

/// Height of a plot of pressure over the greatest between the tip-edge zones: what is more belongs to tip edges.
const SHOWN_OVER_FLANK: f64 = 1.5;

/// Wear depth over both flanks, one curve per snapshot.
pub(super) fn wear(record: &RunRecord) -> Vec<Chart> {
    let deepest = Gear::BOTH.map(|gear| {
        let flank = &record.flanks[gear];
        let deepest_of = |wear: &[f64]| greatest(wear).map_or(0.0, |e| e.value);
        deepest_of(&flank.wear_um).max(flank.verified_wear_um.as_deref().map_or(0.0, deepest_of))
    });
    Gear::BOTH
        .into_iter()
        .zip(deepest)
        .map(|(gear, own)| {
            // The same scale for both gears, unless one would hardly show on it.
            let both = deepest[0].max(deepest[1]);
            wear_of(record, gear, if own > 0.2 * both { both } else { own })
        })
        .collect()
}

fn wear_of(record: &RunRecord, gear: Gear, depth_um: f64) -> Chart {
    let flank = &record.flanks[gear];
    let active = ActiveFlank::of(flank);
    let radius = active.cut(&flank.radius_mm);
    let drawn = drawn_snapshots(record.history.len());
    let mut chart =
        Chart::new(format!("wear-{}", gear.name()), format!("Wear of the {}’s flank, root to tip", gear.name()))
            .height(400)
            .y("wear depth, µm")
            .y_down_to(depth_um)
            .reading(wear_reading(record, gear, drawn.len()));
    for (i, &snapshot) in drawn.iter().enumerate() {
        let last = i + 1 == drawn.len();
        let share = if drawn.len() > 1 { i as f64 / (drawn.len() - 1) as f64 } else { 1.0 };
        let stroke = (gear_colour_at(gear, share), if last { 2.6 } else { 1.5 }, Dash::Solid);
        let wear = active.cut(&flank.snapshot_wear_um[snapshot]);
        let trace = Trace::line(moment(&record.history[snapshot]), radius.iter().copied(), wear, stroke);
        chart = chart.add(if last {
            trace.further(active.cut(&flank.roll_angle_deg)).hover("%{y:.3f} µm (roll angle %{customdata:.2f}°)")
        } else {
            trace.hover("%{y:.3f} µm")
        });
    }
    let curves = drawn.len();
    if let Some(verified) = &flank.verified_wear_um {
        chart = add_verified(chart, gear, &radius, &active.cut(&flank.wear_um), &active.cut(verified));
    }
    // Up to each snapshot; what finite elements say, at the end.
    let all = chart.traces.len();
    let up_to = |last: usize| (0..all).map(move |trace| trace <= last || trace >= curves && last + 1 == curves);
    let steps = drawn.iter().enumerate().map(|(i, &snapshot)| SliderStep {
        label: moment(&record.history[snapshot]),
        change: Change::Shown(up_to(i).collect()),
    });
    let chart = chart.movable(Control::Steps { name: "time", steps: steps.collect() });
    active.across(chart, gear)
}

/// Wear by the finite elements that verify the run, and the band between both answers.
fn add_verified(chart: Chart, gear: Gear, radius_mm: &[f64], own_um: &[f64], verified_um: &[f64]) -> Chart {
    let around = radius_mm.iter().chain(radius_mm.iter().rev()).copied();
    let edges = own_um.iter().chain(verified_um.iter().rev()).copied();
    let band = Trace::line("difference", around, edges, (INK, 0.0, Dash::Solid)).filled(gear_colour_at(gear, 0.4));
    let (radius, wear) = (radius_mm.iter().copied(), verified_um.iter().copied());
    let chart = chart.add(band.opacity(0.45).unlisted());
    chart.line("finite elements", radius, wear, (INK, 1.4, Dash::Dashed), "%{y:.3f} µm")
}

fn wear_reading(record: &RunRecord, gear: Gear, drawn: usize) -> String {
    if record.history.is_empty() {
        return format!("No snapshot was reached, so the {}’s flank has no curve to show.", gear.name());
    }
    let (flank, wear) = (&record.flanks[gear], gear_wear(&record.summary, gear));
    if [wear.peak_wear_um, wear.tip_edge_wear_um, wear.below_sap_wear_um].iter().all(|depth| *depth <= 0.0) {
        return format!("The {}’s flank has not worn.", gear.name());
    }
    let total = &record.summary.error.total;
    let (profile, tip_edge) = match gear {
        Gear::Pinion => (total.profile.pinion, total.tip_edge_wear.pinion),
        Gear::Wheel => (total.profile.wheel, total.tip_edge_wear.wheel),
    };
    let of_tip_edge =
        tip_edge.map_or_else(String::new, |off| format!(" ± {}", significant(off * wear.tip_edge_wear_um, 1)));
    let mut reading = format!(
        "{} µm on the active profile {}, {}{of_tip_edge} µm at the tip edge.",
        figure(wear.peak_wear_um),
        place_on_flank(flank, wear.peak_wear_radius_mm),
        figure(wear.tip_edge_wear_um),
    );
    if let Some(off) = profile {
        reading
            .push_str(&format!(" Dashed: the same run on finite elements, {} off over the flank (rms).", percent(off)));
    }
    if drawn < record.history.len() {
        reading.push_str(&format!(" {drawn} of {} snapshots are drawn.", record.history.len()));
    }
    reading
}

pub(super) fn pressure(record: &RunRecord) -> Vec<Chart> {
    let both = Gear::BOTH.map(|gear| {
        let flank = &record.flanks[gear];
        [&flank.pressure_new_MPa, &flank.pressure_worn_MPa].map(|p| greatest(p).map_or(0.0, |e| e.value))
    });
    let top = both.as_flattened().iter().copied().fold(0.0, f64::max);
    Gear::BOTH.into_iter().map(|gear| pressure_on(record, gear, top)).collect()
}

fn pressure_on(record: &RunRecord, gear: Gear, top_mpa: f64) -> Chart {
    let flank = &record.flanks[gear];
    let active = ActiveFlank::of(flank);
    let [shown_new, shown_worn] = [record.summary.new.flank_pressure_MPa, record.summary.worn.flank_pressure_MPa];
    let shown_mpa = match SHOWN_OVER_FLANK * shown_new.max(shown_worn) {
        shown if shown > 0.0 => shown.min(top_mpa),
        _ => top_mpa,
    };
    let reading = match (greatest(&flank.pressure_new_MPa), greatest(&flank.pressure_worn_MPa)) {
        (Some(new), Some(worn)) => {
            let at_edges = if new.value.max(worn.value) > shown_mpa { ", cut off here" } else { "" };
            format!(
                "Flank pressure up to {} MPa new and {} MPa worn; where a tip edge touches (shaded) up to {} and {} MPa{at_edges}.",
                figure(shown_new),
                figure(shown_worn),
                figure(new.value),
                figure(worn.value),
            )
        }
        _ => format!("No pressure was computed on the {}’s flank.", gear.name()),
    };
    let [radius, new, worn] =
        [&flank.radius_mm, &flank.pressure_new_MPa, &flank.pressure_worn_MPa].map(|values| active.cut(values));
    let title = format!("Maximum pressure on the {}’s flank", gear.name());
    let chart = Chart::new(format!("pressure-{}", gear.name()), title).y("maximum pressure, MPa");
    let chart = chart.y_cut_above(shown_mpa, top_mpa).add_all(tip_edge_zones(record, gear, 1.06 * shown_mpa));
    active.across(chart.new_and_worn(&radius, new, worn, "%{y:.1f} MPa").reading(reading), gear)
}

/// The zones where the tip edge of either gear touches a flank, up to the height of the plot.
fn tip_edge_zones(record: &RunRecord, gear: Gear, height_mpa: f64) -> [Trace; 2] {
    let flank = &record.flanks[gear];
    let [own_mm, mate_mm] = ActiveFlank::tip_edges_mm(record, gear);
    let tip_mm = flank.radius_mm.last().copied().unwrap_or(own_mm);
    let root_mm = flank.radius_mm.first().copied().unwrap_or(mate_mm);
    [(gear, own_mm, tip_mm), (gear.mate(), mate_mm, root_mm)].map(|(edge, from, to)| {
        let outline = [[from, 0.0], [from, height_mpa], [to, height_mpa], [to, 0.0]];
        let stroke = (gear_colour(edge), 0.0, Dash::Solid);
        let name = format!("tip edge of the {}", edge.name());
        Trace::line(name, outline.map(|[x, _]| x), outline.map(|[_, y]| y), stroke).filled(gear_fill(edge))
    })
}

/// Material that the modifications remove from each flank, the rounding of its tip edge left out; nothing where there is none.
pub(super) fn modifications(record: &RunRecord) -> Vec<Chart> {
    let modified = |gear: &Gear| {
        let flank = &record.flanks[*gear];
        flank.removed_um[..ActiveFlank::rounding_from(flank)].iter().any(|&removed_um| removed_um != 0.0)
    };
    Gear::BOTH.into_iter().filter(modified).map(|gear| modifications_of(record, gear)).collect()
}

fn modifications_of(record: &RunRecord, gear: Gear) -> Chart {
    let flank = &record.flanks[gear];
    let active = ActiveFlank::of(flank);
    let to = ActiveFlank::rounding_from(flank);
    let removed = active.cut(&flank.removed_um[..to]);
    let radius = active.cut(&flank.radius_mm[..to]);
    let reading = match greatest(&removed) {
        Some(at) if at.value > 0.0 => format!(
            "Modifications, or what was measured, take up to {} µm off the {}’s active flank, {}; the rounding of its tip edge is left out.",
            figure(at.value),
            gear.name(),
            place_on_flank(flank, radius[at.index]),
        ),
        _ => format!("The modifications of the {} lie outside its active flank.", gear.name()),
    };
    let [least, most] = extent(removed.iter().copied().chain([0.0]));
    let span = if most > least { most - least } else { 1.0 };
    let title = format!("The {}’s flank before the run", gear.name());
    let chart = Chart::new(format!("modifications-{}", gear.name()), title)
        .height(320)
        .legend(false)
        .y("material removed, µm")
        .y_range([most + 0.06 * span, least - 0.04 * span])
        .line("modifications", radius, removed, (gear_colour(gear), 2.2, Dash::Solid), "%{y:.3f} µm")
        .reading(reading);
    active.across(chart, gear)
}

/// Indices of the snapshots drawn out of `count`: all, or evenly chosen with the last one.
pub(super) fn drawn_snapshots(count: usize) -> Vec<usize> {
    if count <= CURVES {
        return (0..count).collect();
    }
    (1..=CURVES).map(|i| (i * count).div_ceil(CURVES) - 1).collect()
}

/// "31.75 h", or revolutions where the scene gives no speed.
pub(super) fn moment(row: &HistoryRow) -> String {
    match row.hours {
        Some(time) => format!("{} h", hours(time)),
        None => format!("{} rev", revolutions(row.revolutions)),
    }
}
