//! Plots over a flank whose sections are alike, from root to tip: wear at every snapshot, greatest pressure, modifications.

use crate::report::chart::{DashType, Fill, HoverInfo, Plot};

use super::active_flank::ActiveFlank;
use super::number::{figure, given, percent, plotted, revolutions, significant};
use super::reading::{Extreme, greatest, place_on_flank, tip_edge_note};
use super::theme::{self, Figure, axis, curve, layout, line, mark_path_points, new_and_worn};
use crate::gear::Gear;
use crate::results::run::{HistoryRow, RunRecord};

/// At most so many snapshots are drawn, evenly chosen: more curves than that cannot be told apart.
const CURVES: usize = 12;

/// Wear depth over both flanks, one curve per snapshot.
pub fn wear(record: &RunRecord) -> Vec<Figure> {
    let deepest = Gear::BOTH.map(|gear| greatest(&record.flanks[gear].wear_um).map_or(0.0, |e| e.value));
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

fn wear_of(record: &RunRecord, gear: Gear, depth_um: f64) -> Figure {
    let flank = &record.flanks[gear];
    let active = ActiveFlank::of(flank);
    let radius = active.cut(&flank.radius_mm);
    let mut plot = Plot::new();
    let drawn = drawn_snapshots(record.history.len());
    for (i, &snapshot) in drawn.iter().enumerate() {
        let last = i + 1 == drawn.len();
        let share = if drawn.len() > 1 { i as f64 / (drawn.len() - 1) as f64 } else { 1.0 };
        let stroke = line(theme::gear_colour_at(gear, share), if last { 2.6 } else { 1.5 }, DashType::Solid);
        let name = moment(&record.history[snapshot]);
        let mut trace = curve(&name, radius.iter().copied(), active.cut(&flank.snapshot_wear_um[snapshot]), stroke)
            .hover_template("%{y:.3f} µm");
        if last {
            let roll: Vec<f64> = active.cut(&flank.roll_angle_deg).into_iter().map(plotted).collect();
            trace = trace.custom_data(roll).hover_template("%{y:.3f} µm (roll angle %{customdata:.2f}°)");
        }
        plot.add_trace(trace);
    }
    if let Some(verified) = &flank.verified_wear_um {
        add_verified(&mut plot, gear, &radius, &active.cut(&flank.wear_um), &active.cut(verified));
    }
    let [_, bottom] = theme::from_zero(depth_um);
    plot.set_layout(mark_path_points(
        layout(400)
            .show_legend(true)
            .x_axis(active.axis(gear))
            .y_axis(axis("wear depth, µm").range(vec![bottom, -0.02 * bottom])),
        &flank.path_point_radius_mm,
    ));
    Figure {
        id: format!("wear-{}", gear.name()),
        title: format!("Wear of the {}’s flank, root to tip", gear.name()),
        reading: wear_reading(record, gear, drawn.len()),
        plot,
        wide: false,
    }
}

/// The wear by the finite elements that vouch for the run, and the band between both answers.
fn add_verified(plot: &mut Plot, gear: Gear, radius_mm: &[f64], own_um: &[f64], verified_um: &[f64]) {
    let around = radius_mm.iter().chain(radius_mm.iter().rev()).copied();
    let edges = own_um.iter().chain(verified_um.iter().rev()).copied();
    let band = curve("difference", around, edges, line(theme::INK, 0.0, DashType::Solid))
        .fill(Fill::ToSelf)
        .fill_color(theme::gear_colour_at(gear, 0.4))
        .opacity(0.45)
        .hover_info(HoverInfo::Skip)
        .show_legend(false);
    plot.add_trace(band);
    let verified = curve(
        "finite elements",
        radius_mm.iter().copied(),
        verified_um.iter().copied(),
        line(theme::INK, 1.4, DashType::Dash),
    );
    plot.add_trace(verified.hover_template("%{y:.3f} µm"));
}

fn wear_reading(record: &RunRecord, gear: Gear, drawn: usize) -> String {
    if record.history.is_empty() {
        return format!("No snapshot was reached, so the {}’s flank has no curve to show.", gear.name());
    }
    let (flank, wear) = (&record.flanks[gear], gear_wear(record, gear));
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
        "The active profile of the {} wears most {}: {} µm, against {} µm at the pitch circle; over the root it reaches {} µm, at the tip \
         edge {}{of_tip_edge} µm, below the active profile {} µm.",
        gear.name(),
        place_on_flank(flank, wear.peak_wear_radius_mm),
        figure(wear.peak_wear_um),
        figure(wear.pitch_wear_um),
        figure(wear.root_wear_um),
        figure(wear.tip_edge_wear_um),
        figure(wear.below_sap_wear_um),
    );
    if let Some(off) = profile {
        reading.push_str(&format!(
            " Dashed: the same life on finite elements; over the flank the two differ by {} of the wear (root mean square), the \
             uncertainty of the finite elements included.",
            percent(off)
        ));
    }
    if drawn < record.history.len() {
        reading.push_str(&format!(" {drawn} of {} snapshots are drawn.", record.history.len()));
    }
    reading
}

/// Greatest pressure that each flank point feels during one mesh, new and worn.
pub fn pressure(record: &RunRecord) -> Vec<Figure> {
    let both = Gear::BOTH.map(|gear| {
        let flank = &record.flanks[gear];
        [&flank.pressure_new_MPa, &flank.pressure_worn_MPa].map(|p| greatest(p).map_or(0.0, |e| e.value))
    });
    let top = both.as_flattened().iter().copied().fold(0.0, f64::max);
    Gear::BOTH.into_iter().map(|gear| pressure_on(record, gear, top)).collect()
}

fn pressure_on(record: &RunRecord, gear: Gear, top_mpa: f64) -> Figure {
    let flank = &record.flanks[gear];
    let active = ActiveFlank::of(flank);
    let mut plot = Plot::new();
    new_and_worn(
        &mut plot,
        &active.cut(&flank.radius_mm),
        active.cut(&flank.pressure_new_MPa),
        active.cut(&flank.pressure_worn_MPa),
        "%{y:.1f} MPa",
    );
    plot.set_layout(mark_path_points(
        layout(380)
            .show_legend(true)
            .x_axis(active.axis(gear))
            .y_axis(axis("greatest pressure, MPa").range(theme::from_zero(top_mpa).to_vec())),
        &flank.path_point_radius_mm,
    ));
    let place = |at: Extreme| place_on_flank(flank, flank.radius_mm[at.index]);
    let reading = match (greatest(&flank.pressure_new_MPa), greatest(&flank.pressure_worn_MPa)) {
        (Some(new), Some(worn)) => format!(
            "During one mesh the {}’s flank feels at most {} MPa new, {}, and {} MPa worn, {}.{}",
            gear.name(),
            figure(new.value),
            place(new),
            figure(worn.value),
            place(worn),
            tip_edge_note(&theme::named(&flank.path_point_radius_mm), flank.radius_mm[worn.index]),
        ),
        _ => format!("No pressure was computed on the {}’s flank.", gear.name()),
    };
    Figure {
        id: format!("pressure-{}", gear.name()),
        title: format!("Greatest pressure on the {}’s flank", gear.name()),
        reading,
        plot,
        wide: false,
    }
}

/// Material that the modifications remove from each flank; nothing where there is none.
pub fn modifications(record: &RunRecord) -> Vec<Figure> {
    let modified = |gear: &Gear| record.flanks[*gear].removed_um.iter().any(|&h| h != 0.0);
    Gear::BOTH.into_iter().filter(modified).map(|gear| modifications_of(record, gear)).collect()
}

fn modifications_of(record: &RunRecord, gear: Gear) -> Figure {
    let flank = &record.flanks[gear];
    let active = ActiveFlank::of(flank);
    let removed = active.cut(&flank.removed_um);
    let radius = active.cut(&flank.radius_mm);
    let (least, most) = removed.iter().fold((0.0_f64, 0.0_f64), |(a, b), &h| (a.min(h), b.max(h)));
    let most_at = greatest(&removed);
    let mut plot = Plot::new();
    let stroke = line(theme::gear_colour(gear), 2.2, DashType::Solid);
    plot.add_trace(curve("modifications", radius.clone(), removed, stroke).hover_template("%{y:.3f} µm"));
    let span = if most > least { most - least } else { 1.0 };
    plot.set_layout(mark_path_points(
        layout(320)
            .show_legend(false)
            .x_axis(active.axis(gear))
            .y_axis(axis("material removed, µm").range(vec![most + 0.06 * span, least - 0.04 * span])),
        &flank.path_point_radius_mm,
    ));
    let reading = match most_at {
        Some(at) if at.value > 0.0 => format!(
            "The modifications take up to {} µm off the {}’s active flank, {}.",
            figure(at.value),
            gear.name(),
            place_on_flank(flank, radius[at.index]),
        ),
        _ => format!("The modifications of the {} lie outside its active flank.", gear.name()),
    };
    Figure {
        id: format!("modifications-{}", gear.name()),
        title: format!("Modifications of the {}’s flank", gear.name()),
        reading,
        plot,
        wide: false,
    }
}

fn gear_wear(record: &RunRecord, gear: Gear) -> &crate::results::run::WearSummary {
    match gear {
        Gear::Pinion => &record.summary.pinion,
        Gear::Wheel => &record.summary.wheel,
    }
}

/// Indices of the snapshots drawn out of `count`: all, or evenly chosen with the last one.
fn drawn_snapshots(count: usize) -> Vec<usize> {
    if count <= CURVES {
        return (0..count).collect();
    }
    (1..=CURVES).map(|i| (i * count).div_ceil(CURVES) - 1).collect()
}

/// "31.75 h", or revolutions where the scene gives no speed.
fn moment(row: &HistoryRow) -> String {
    match row.hours {
        Some(hours) => format!("{} h", given(hours)),
        None => format!("{} rev", revolutions(row.revolutions)),
    }
}
