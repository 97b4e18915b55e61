//! Wear profiles of all surfaces over the reference, and their differences along the flank: where a model is off.
//!
//! Of pairs with slices the profiles are those in the middle of the face width, and the root wear over the face width is shown
//! beside them.

use crate::accuracy::record::{AccuracyRecord, ComparedQuantity, ReferenceFlank, VariantRecord};
use gearwear::report::chart::{Chart, Dash, INK, Trace, padded};
use gearwear::report::html::number::{figure, percent, significant};
use gearwear::report::html::reading::greatest;
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::path_points::among;

/// Stiffness models with which the surfaces are shown, the best first.
const BEST_STIFFNESS: [&str; 2] = ["fem", "weber-banaschek"];

/// Style of a surface: colour, dash, and whether it is visible before the reader selects it.
type SurfaceStyle = (&'static str, Dash, bool);

/// Profiles and differences of both gears.
pub(super) fn all(record: &AccuracyRecord) -> Vec<Chart> {
    let shown = shown(record);
    Gear::BOTH
        .into_iter()
        .filter(|&gear| record.reference.flanks[gear].path_point_radius_mm.is_some())
        .flat_map(|gear| {
            let root = record.has_slices().then(|| root_over_width(record, &shown, gear));
            [profiles(record, &shown, gear), differences(record, &shown, gear)].into_iter().chain(root)
        })
        .collect()
}

/// Runs of the finest resolution with the best available stiffness, and the finest finite elements.
fn shown(record: &AccuracyRecord) -> Vec<&VariantRecord> {
    let finest = record.variants.iter().filter(|v| v.wear_um.is_some());
    let stiffnesses: Vec<&str> = finest.clone().filter_map(|v| v.settings.stiffness.as_deref()).collect();
    let best = BEST_STIFFNESS.into_iter().find(|name| stiffnesses.contains(name));
    finest.filter(|v| v.settings.stiffness.is_none() || v.settings.stiffness.as_deref() == best).collect()
}

fn style(variant: &VariantRecord) -> SurfaceStyle {
    let s = &variant.settings;
    if s.slices.is_some() {
        return style_of_slices(variant);
    }
    let other_criterion = s.match_criterion.as_deref().is_some_and(|criterion| criterion != "half-width");
    match s.surface.as_str() {
        "hertz-mean" => ("var(--new)", Dash::Dot, true),
        "hertz" => ("var(--wheel)", Dash::Solid, true),
        "half-space" if s.tip_contact => ("var(--path)", Dash::Solid, true),
        "half-space" => ("var(--path)", Dash::Dashed, false),
        "fem" => ("var(--worn)", Dash::Dashed, variant.part_of_reference),
        _ if s.calibrated => ("var(--pinion)", Dash::Solid, !other_criterion && s.tip_contact),
        _ => ("var(--pinion)", Dash::Dashed, !other_criterion && !s.tip_contact),
    }
}

/// Full lines are coupled slices, dashed ones uncoupled; of the Winkler foundations the one on half-width is drawn to begin with.
fn style_of_slices(variant: &VariantRecord) -> SurfaceStyle {
    let s = &variant.settings;
    let coupled = s.coupling.as_deref() != Some("none");
    let dash = if coupled { Dash::Solid } else { Dash::Dashed };
    let (colour, stands_for_others) = match s.surface.as_str() {
        "hertz-mean" => ("var(--new)", true),
        "hertz" => ("var(--wheel)", true),
        "half-space" => ("var(--path)", true),
        _ if s.calibrated => ("var(--worn)", false),
        _ => ("var(--pinion)", s.match_criterion.as_deref() == Some("half-width") && s.tip_contact),
    };
    (colour, dash, stands_for_others && (coupled || s.surface == "hertz-mean"))
}

/// The part of a run's name that tells it from the others shown.
fn surface(variant: &VariantRecord) -> String {
    let surface = variant.name.split(" · ").next().unwrap_or(&variant.name);
    match variant.settings.coupling.as_deref() {
        None => surface.to_owned(),
        Some("fem") => format!("{surface}, coupled in space"),
        Some("slicing") => format!("{surface}, coupled"),
        Some(_) => format!("{surface}, uncoupled"),
    }
}

/// The slice whose profile is shown, where there are several: in the middle of the face width.
fn middle(reference: &ReferenceFlank) -> usize {
    reference.width_mm.len() / 2
}

/// Addition to a heading: the place of the slice over the face width.
fn where_over_width(reference: &ReferenceFlank) -> String {
    match reference.width_mm.len() {
        0 | 1 => String::new(),
        _ => format!(", {} mm over the face width", significant(reference.width_mm[middle(reference)], 3)),
    }
}

fn profiles(record: &AccuracyRecord, shown: &[&VariantRecord], gear: Gear) -> Chart {
    let reference = &record.reference.flanks[gear];
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
            if record.has_slices() { " over the whole flank" } else { "" }
        )
    });
    let title = format!("Wear of the {}’s flank by all surfaces{}", gear.name(), where_over_width(reference));
    let chart = Chart::new(format!("profiles-{}", gear.name()), title).y("wear depth, µm").reading(format!(
        "The reference wears up to {} µm{}.{closest} A click in the legend shows or hides a curve.",
        figure(record.reference.peak_wear_um[gear]),
        if record.has_slices() { " anywhere over the face width" } else { "" }
    ));
    let wear = reference.slice(&reference.wear_um, middle(reference));
    let deepest = 1.25 * greatest(wear).map_or(1.0, |e| e.value);
    let chart = chart.y_range([deepest, -0.02 * deepest]).add(of_reference(&reference.radius_mm, wear));
    over_flank(chart.add_all(of_runs(shown, reference, gear, |wear, _| wear)), reference, gear)
}

/// The reference, behind all others.
fn of_reference(along: &[f64], wear: &[f64]) -> Trace {
    let line = Trace::line("reference", along.iter().copied(), wear.iter().copied(), (INK, 5.0, Dash::Solid));
    line.opacity(0.35).hover("%{y:.3f} µm")
}

/// Greatest difference of a run from the reference, and where on the flank it is.
fn greatest_difference(variant: &VariantRecord, reference: &ReferenceFlank, gear: Gear) -> Option<String> {
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
        among(&reference.path_point_radius_mm.as_ref()?.named(), radius)
    ))
}

fn differences(record: &AccuracyRecord, shown: &[&VariantRecord], gear: Gear) -> Chart {
    let reference = &record.reference.flanks[gear];
    let drawn = shown.iter().filter(|v| v.settings.surface != "fem" && style(v).2);
    let worst: Vec<String> = drawn.filter_map(|v| greatest_difference(v, reference, gear)).collect();
    let title = format!("Error of each surface along the {}’s flank{}", gear.name(), where_over_width(reference));
    let chart = Chart::new(format!("differences-{}", gear.name()), title)
        .y("wear depth less the reference’s, µm")
        .add_all(of_runs(shown, reference, gear, |wear, there| wear - there))
        .reading(format!("Furthest from the reference: {}.", worst.join("; ")));
    over_flank(chart, reference, gear)
}

/// Root wear over the face width, coupled and not.
fn root_over_width(record: &AccuracyRecord, shown: &[&VariantRecord], gear: Gear) -> Chart {
    let reference = &record.reference.flanks[gear];
    let runs = shown.iter().filter_map(|variant| {
        let root = variant.root_wear_um.as_ref()?;
        Some(of_run(variant, &reference.width_mm, root[gear].iter().copied()))
    });
    let drawn = shown.iter().filter(|v| style(v).2).filter_map(|v| v.root_wear_um.as_ref());
    let lowest = drawn.flat_map(|root| &root[gear]).copied().fold(0.0, f64::max);
    let deepest = greatest(&reference.root_wear_um).map_or(1.0, |e| e.value);
    let at = greatest(&reference.root_wear_um).map(|e| reference.width_mm[e.index]);
    let title = format!("Root wear of the {} over the face width", gear.name());
    Chart::new(format!("root-over-width-{}", gear.name()), title)
        .wide()
        .height(560)
        .x("place over the face width, mm")
        .x_format(".2f")
        .y("root wear, µm")
        .y_range([1.05 * deepest.max(lowest), 0.0])
        .add(of_reference(&reference.width_mm, &reference.root_wear_um))
        .add_all(runs)
        .reading(format!(
            "Maximum depth within 2 mm of radius above the start of active profile. The reference’s is {} µm{}. Full lines are \
             coupled slices, dashed ones uncoupled.",
            figure(deepest),
            at.map_or_else(String::new, |at| format!(" at {} mm", significant(at, 3)))
        ))
}

fn of_run(variant: &VariantRecord, along: &[f64], values: impl Iterator<Item = f64>) -> Trace {
    let (colour, dash, at_once) = style(variant);
    let line = Trace::line(surface(variant), along.iter().copied(), values, (colour, 1.8, dash));
    line.at_once(at_once).hover("%{y:.3f} µm")
}

/// Curves of `value`, a function of each run's wear and the reference's.
fn of_runs(shown: &[&VariantRecord], reference: &ReferenceFlank, gear: Gear, value: fn(f64, f64) -> f64) -> Vec<Trace> {
    let runs = shown.iter().filter_map(|variant| {
        let wear = &variant.wear_um.as_ref()?[gear];
        let [own, there] = [wear, &reference.wear_um].map(|field| reference.slice(field, middle(reference)));
        Some(of_run(variant, &reference.radius_mm, own.iter().zip(there).map(|(&a, &b)| value(a, b))))
    });
    runs.collect()
}

fn over_flank(chart: Chart, reference: &ReferenceFlank, gear: Gear) -> Chart {
    let Some(points) = &reference.path_point_radius_mm else { return chart };
    let [low, high] = extent(points.named().map(|(_, radius)| radius));
    let [from, to] = padded(low, high);
    // Contact before A and after E wears below the start of active profile.
    let range = [from - 0.05 * (high - low), to];
    let chart = chart.wide().height(640).x(&format!("radius on the {}, mm", gear.name()));
    chart.x_range(range).x_format(".3f").mark_path_points(points)
}

fn profile_of(gear: Gear) -> ComparedQuantity {
    match gear {
        Gear::Pinion => ComparedQuantity::PinionWearProfile,
        Gear::Wheel => ComparedQuantity::WheelWearProfile,
    }
}
