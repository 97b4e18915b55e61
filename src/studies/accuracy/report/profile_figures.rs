//! Wear profiles of all surfaces over the reference, and their differences along the flank: where a model is off.
//!
//! Of pairs with slices the profiles are those in the middle of the face width, and the root wear over the face width is shown
//! beside them.

use crate::report::chart::{DashType, Plot, Visible};

use super::has_slices;
use crate::gear::Gear;
use crate::report::html::number::{figure, percent, significant};
use crate::report::html::reading::{among, greatest};
use crate::report::html::theme::{Figure, axis, curve, layout, line, mark_path_points, named, padded};
use crate::studies::accuracy::record::{AccuracyRecord, Quantity, ReferenceFlank, VariantRecord};

/// Stiffnesses to show the surfaces with, the best first.
const BEST_STIFFNESS: [&str; 2] = ["fem", "weber-banaschek"];

/// How a surface is drawn.
struct Stroke {
    colour: &'static str,
    dash: DashType,
    /// Whether it is drawn to begin with, or only when the reader asks for it.
    at_once: bool,
}

/// Profiles and differences of both gears.
pub fn all(record: &AccuracyRecord) -> Vec<Figure> {
    let shown = shown(record);
    Gear::BOTH
        .into_iter()
        .filter(|&gear| record.reference.flanks[gear].path_point_radius_mm.is_some())
        .flat_map(|gear| {
            let root = has_slices(record).then(|| root_over_width(record, &shown, gear));
            [profiles(record, &shown, gear), differences(record, &shown, gear)].into_iter().chain(root)
        })
        .collect()
}

/// The runs of the finest resolution with the best stiffness there is, and the finest finite elements.
fn shown(record: &AccuracyRecord) -> Vec<&VariantRecord> {
    let finest = |v: &&VariantRecord| v.wear_um.is_some();
    let with =
        |name: &str| record.variants.iter().filter(finest).any(|v| v.settings.stiffness.as_deref() == Some(name));
    let best = BEST_STIFFNESS.into_iter().find(|name| with(name));
    record
        .variants
        .iter()
        .filter(finest)
        .filter(|v| v.settings.stiffness.is_none() || v.settings.stiffness.as_deref() == best)
        .collect()
}

fn stroke(variant: &VariantRecord) -> Stroke {
    let s = &variant.settings;
    if s.slices.is_some() {
        return stroke_of_slices(variant);
    }
    let other_criterion = s.match_criterion.as_deref().is_some_and(|criterion| criterion != "half-width");
    match s.surface.as_str() {
        "hertz-mean" => Stroke { colour: "var(--new)", dash: DashType::Dot, at_once: true },
        "hertz" => Stroke { colour: "var(--wheel)", dash: DashType::Solid, at_once: true },
        "half-space" if s.tip_contact => Stroke { colour: "var(--path)", dash: DashType::Solid, at_once: true },
        "half-space" => Stroke { colour: "var(--path)", dash: DashType::Dash, at_once: false },
        "fem" => Stroke { colour: "var(--worn)", dash: DashType::Dash, at_once: variant.part_of_reference },
        _ if s.calibrated => {
            Stroke { colour: "var(--pinion)", dash: DashType::Solid, at_once: !other_criterion && s.tip_contact }
        }
        _ => Stroke { colour: "var(--pinion)", dash: DashType::Dash, at_once: !other_criterion && !s.tip_contact },
    }
}

/// Full lines are coupled slices, dashed ones uncoupled; of the Winkler beds the one on half-width is drawn to begin with.
fn stroke_of_slices(variant: &VariantRecord) -> Stroke {
    let s = &variant.settings;
    let coupled = s.coupling.as_deref() == Some("slicing");
    let dash = if coupled { DashType::Solid } else { DashType::Dash };
    let (colour, stands_for_others) = match s.surface.as_str() {
        "hertz-mean" => ("var(--new)", true),
        "hertz" => ("var(--wheel)", true),
        "half-space" => ("var(--path)", true),
        _ if s.calibrated => ("var(--worn)", false),
        _ => ("var(--pinion)", s.match_criterion.as_deref() == Some("half-width") && s.tip_contact),
    };
    Stroke { colour, dash, at_once: stands_for_others && (coupled || s.surface == "hertz-mean") }
}

/// The part of a run's name that tells it from the others shown.
fn surface(variant: &VariantRecord) -> String {
    let surface = variant.name.split(" · ").next().unwrap_or(&variant.name);
    match variant.settings.coupling.as_deref() {
        None => surface.to_owned(),
        Some("slicing") => format!("{surface}, coupled"),
        Some(_) => format!("{surface}, uncoupled"),
    }
}

/// The slice whose profile is shown, where there are several: in the middle of the face width.
fn middle(reference: &ReferenceFlank) -> usize {
    reference.width_mm.len() / 2
}

/// What a heading adds for that slice.
fn where_over_width(reference: &ReferenceFlank) -> String {
    match reference.width_mm.len() {
        0 | 1 => String::new(),
        _ => format!(", {} mm over the face width", significant(reference.width_mm[middle(reference)], 3)),
    }
}

fn profiles(record: &AccuracyRecord, shown: &[&VariantRecord], gear: Gear) -> Figure {
    let reference = &record.reference.flanks[gear];
    let mut plot = Plot::new();
    plot.add_trace(
        curve(
            "reference",
            reference.radius_mm.iter().copied(),
            reference.slice(&reference.wear_um, middle(reference)).iter().copied(),
            line("var(--ink)", 5.0, DashType::Solid),
        )
        .opacity(0.35)
        .hover_template("%{y:.3f} µm"),
    );
    add_runs(&mut plot, shown, reference, gear, |wear, _| wear);
    finish(&mut plot, reference, gear, "wear depth, µm", true);
    let quantity = profile_of(gear);
    let closest = shown
        .iter()
        .filter(|v| v.settings.surface != "fem")
        .filter_map(|v| Some((surface(v), v.errors.get(&quantity)?.relative)))
        .min_by(|a, b| a.1.total_cmp(&b.1));
    let closest = closest.map_or_else(String::new, |(name, error)| {
        format!(
            " Of the surfaces on the line of action, {name} is closest: {} (L2{}).",
            percent(error),
            if has_slices(record) { " over the whole flank" } else { "" }
        )
    });
    Figure {
        id: format!("profiles-{}", gear.name()),
        title: format!("Wear of the {}’s flank by all surfaces{}", gear.name(), where_over_width(reference)),
        reading: format!(
            "The reference wears up to {} µm{}.{closest} A click in the legend shows or hides a curve.",
            figure(record.reference.peak_wear_um[gear]),
            if has_slices(record) { " anywhere over the face width" } else { "" }
        ),
        plot,
        wide: true,
    }
}

fn differences(record: &AccuracyRecord, shown: &[&VariantRecord], gear: Gear) -> Figure {
    let reference = &record.reference.flanks[gear];
    let mut plot = Plot::new();
    add_runs(&mut plot, shown, reference, gear, |wear, there| wear - there);
    finish(&mut plot, reference, gear, "wear depth less the reference’s, µm", false);
    let places = reference.path_point_radius_mm.as_ref().map(named);
    let worst = |variant: &VariantRecord| {
        let wear = reference.slice(&variant.wear_um.as_ref()?[gear], middle(reference));
        let there = reference.slice(&reference.wear_um, middle(reference));
        let off: Vec<f64> = wear.iter().zip(there).map(|(a, b)| (a - b).abs()).collect();
        let at = greatest(&off)?;
        let radius = reference.radius_mm[at.index];
        Some(format!(
            "{} by {} µm at {} mm ({})",
            surface(variant),
            figure(at.value),
            significant(radius, 4),
            among(places.as_ref()?, radius)
        ))
    };
    let at_once: Vec<String> =
        shown.iter().filter(|v| v.settings.surface != "fem" && stroke(v).at_once).filter_map(|v| worst(v)).collect();
    Figure {
        id: format!("differences-{}", gear.name()),
        title: format!("Where on the {}’s flank each surface is off{}", gear.name(), where_over_width(reference)),
        reading: format!("Furthest from the reference: {}.", at_once.join("; ")),
        plot,
        wide: true,
    }
}

/// Root wear over the face width, coupled and not.
fn root_over_width(record: &AccuracyRecord, shown: &[&VariantRecord], gear: Gear) -> Figure {
    let reference = &record.reference.flanks[gear];
    let widths = || reference.width_mm.iter().copied();
    let mut plot = Plot::new();
    plot.add_trace(
        curve("reference", widths(), reference.root_wear_um.iter().copied(), line("var(--ink)", 5.0, DashType::Solid))
            .opacity(0.35)
            .hover_template("%{y:.3f} µm"),
    );
    for variant in shown {
        let Some(root) = &variant.root_wear_um else { continue };
        let Stroke { colour, dash, at_once } = stroke(variant);
        plot.add_trace(
            curve(&surface(variant), widths(), root[gear].iter().copied(), line(colour, 1.8, dash))
                .visible(if at_once { Visible::True } else { Visible::LegendOnly })
                .hover_template("%{y:.3f} µm"),
        );
    }
    let drawn = shown.iter().filter(|v| stroke(v).at_once).filter_map(|v| v.root_wear_um.as_ref());
    let lowest = drawn.flat_map(|root| &root[gear]).copied().fold(0.0, f64::max);
    let deepest = greatest(&reference.root_wear_um).map_or(1.0, |e| e.value);
    plot.set_layout(
        layout(560)
            .show_legend(true)
            .x_axis(axis("place over the face width, mm").hover_format(".2f"))
            .y_axis(axis("root wear, µm").range(vec![1.05 * deepest.max(lowest), 0.0])),
    );
    let at = greatest(&reference.root_wear_um).map(|e| reference.width_mm[e.index]);
    Figure {
        id: format!("root-over-width-{}", gear.name()),
        title: format!("Root wear of the {} over the face width", gear.name()),
        reading: format!(
            "Greatest depth within 2 mm of radius above the start of active profile. The reference’s is {} µm{}. Full lines are \
             coupled slices, dashed ones uncoupled.",
            figure(deepest),
            at.map_or_else(String::new, |at| format!(" at {} mm", significant(at, 3)))
        ),
        plot,
        wide: true,
    }
}

fn add_runs(
    plot: &mut Plot,
    shown: &[&VariantRecord],
    reference: &ReferenceFlank,
    gear: Gear,
    value: fn(f64, f64) -> f64,
) {
    for variant in shown {
        let Some(wear) = &variant.wear_um else { continue };
        let Stroke { colour, dash, at_once } = stroke(variant);
        let [own, there] = [&wear[gear], &reference.wear_um].map(|field| reference.slice(field, middle(reference)));
        let y: Vec<f64> = own.iter().zip(there).map(|(&a, &b)| value(a, b)).collect();
        plot.add_trace(
            curve(&surface(variant), reference.radius_mm.iter().copied(), y, line(colour, 1.8, dash))
                .visible(if at_once { Visible::True } else { Visible::LegendOnly })
                .hover_template("%{y:.3f} µm"),
        );
    }
}

fn finish(plot: &mut Plot, reference: &ReferenceFlank, gear: Gear, y_title: &str, downwards: bool) {
    let Some(points) = &reference.path_point_radius_mm else { return };
    let radii = named(points).map(|(_, radius)| radius);
    let (low, high) = radii.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), &r| (a.min(r), b.max(r)));
    let mut range = padded(low, high);
    // Contact before A and after E wears below the start of active profile.
    range[0] -= 0.05 * (high - low);
    let x = axis(&format!("radius on the {}, mm", gear.name())).range(range).hover_format(".3f");
    let mut y = axis(y_title);
    if downwards {
        let deepest = 1.25 * greatest(reference.slice(&reference.wear_um, middle(reference))).map_or(1.0, |e| e.value);
        y = y.range(vec![deepest, -0.02 * deepest]);
    }
    plot.set_layout(mark_path_points(layout(640).show_legend(true).x_axis(x).y_axis(y), points));
}

fn profile_of(gear: Gear) -> Quantity {
    match gear {
        Gear::Pinion => Quantity::PinionWearProfile,
        Gear::Wheel => Quantity::WheelWearProfile,
    }
}
