//! Maps of the whole flank, face width across and root to tip upwards, with lines of contact.
//!
//! A line of contact is straight in the radius of curvature, ρ_c(z), and therefore a little bent over the radius
//! r = √(r_b² + ρ²). It crosses the flank from one side of the map to the other while the tooth goes through the mesh.

use super::raster::SlicedRaster;
use super::sliced_run::{SlicedRun, slice_name};
use crate::report::chart::{Chart, Dash, Label, Trace};
use crate::report::control::{Change, Control, SliderStep};
use crate::report::html::active_flank::ActiveFlank;
use crate::report::html::flank_plots::{drawn_snapshots, moment};
use crate::report::html::number::{figure, percent, significant};
use crate::report::html::reading::{gear_wear, greatest, place_on_flank, yield_note};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::FlankRecord;

/// Positions of the tooth whose lines of contact are drawn.
const LINES_OF_CONTACT: usize = 7;
/// Pieces of a drawn line of contact.
const PIECES: usize = 24;

struct MappedQuantity<'a> {
    id: &'static str,
    /// What stands before and after the name of the flank.
    title: [&'static str; 2],
    unit: &'static str,
    values: &'a [f64],
    /// The greatest value of the scale of colours, which begins at 0.
    top: f64,
    reading: String,
}

/// Part of the greatest value between the tip-edge zones up to which colours tell values apart.
const COLOURS_BEYOND_FLANK: f64 = 1.15;

/// Wear at the end of the run, and at every snapshot.
pub(super) fn wear(run: SlicedRun<'_>, gear: Gear) -> Chart {
    let wear = &run.record.flanks[gear].wear_um;
    let (top, ends) = colours_of(wear, gear_wear(&run.record.summary, gear).peak_wear_um, "µm");
    let reading = wear_reading(run, gear) + &ends;
    let worn_off = MappedQuantity { id: "wear", title: ["Wear of", ""], unit: "µm", values: wear, top, reading };
    map(run, gear, worn_off).movable(over_time(run, gear))
}

pub(super) fn sliding(run: SlicedRun<'_>, gear: Gear) -> Chart {
    let flank = &run.record.flanks[gear];
    let values = &flank.sliding_mm_per_mesh;
    let top = greatest(values).map_or(0.0, |peak| peak.value);
    let title = ["Sliding of", " during one mesh, new"];
    map(run, gear, MappedQuantity { id: "sliding", title, unit: "mm", values, top, reading: sliding_reading(flank) })
}

pub(super) fn pressure_new(run: SlicedRun<'_>, gear: Gear) -> Chart {
    pressure(run, gear, &run.record.flanks[gear].pressure_new_MPa, ["pressure-new", "new"])
}

pub(super) fn pressure_worn(run: SlicedRun<'_>, gear: Gear) -> Chart {
    pressure(run, gear, &run.record.flanks[gear].pressure_worn_MPa, ["pressure-worn", "worn"])
}

/// New and worn have one scale of colours.
fn pressure(run: SlicedRun<'_>, gear: Gear, values: &[f64], [id, when]: [&'static str; 2]) -> Chart {
    let flank = &run.record.flanks[gear];
    let s = &run.record.summary;
    let both =
        [&flank.pressure_new_MPa, &flank.pressure_worn_MPa].map(|field| greatest(field).map_or(0.0, |at| at.value));
    let (top, ends) = colours_of(&both, s.new.flank_pressure_MPa.max(s.worn.flank_pressure_MPa), "MPa");
    let reading = pressure_reading(run, gear, values, when) + &contact_pattern(flank, values) + &ends;
    let title = ["Contact pattern and maximum pressure on", if when == "new" { ", new" } else { ", worn" }];
    // What is not touched has no colour.
    let values: Vec<f64> = values.iter().map(|&mpa| if mpa > 0.0 { mpa } else { f64::NAN }).collect();
    map(run, gear, MappedQuantity { id, title, unit: "MPa", values: &values, top, reading })
}

/// What the modifications take off the flank below the rounding of its tip edge; none where they take nothing.
pub(super) fn modifications(run: SlicedRun<'_>, gear: Gear) -> Option<Chart> {
    let flank = &run.record.flanks[gear];
    let points = flank.radius_mm.len();
    let (first, rounding) = (ActiveFlank::of(flank).first, ActiveFlank::rounding_from(flank));
    let is_shown = |place: usize| (first..rounding).contains(&(place % points));
    let values = flank.removed_um.iter().enumerate();
    let values: Vec<f64> = values.map(|(place, &value)| if is_shown(place) { value } else { f64::NAN }).collect();
    if values.iter().all(|&removed| removed.is_nan() || removed == 0.0) {
        return None;
    }
    let reading = format!(
        "Modifications, or what was measured, take up to {}; the rounding of the tip edge is left out.",
        peak_of(flank, &values, "µm")
    );
    let top = greatest(&values).map_or(0.0, |peak| peak.value);
    let title = ["Material missing from", " before the run"];
    Some(map(run, gear, MappedQuantity { id: "modifications", title, unit: "µm", values: &values, top, reading }))
}

/// What the contact pattern, all that is touched during a mesh, covers of the face width and of the active flank.
fn contact_pattern(flank: &FlankRecord, pressure_mpa: &[f64]) -> String {
    let points = flank.radius_mm.len();
    let [a_mm, e_mm] = [flank.path_point_radius_mm.A, flank.path_point_radius_mm.E];
    let is_active = |point: &usize| (a_mm.min(e_mm)..=a_mm.max(e_mm)).contains(&flank.radius_mm[*point]);
    let active: Vec<usize> = (0..ActiveFlank::rounding_from(flank)).filter(is_active).collect();
    let (mut slices, mut wide, mut area, mut touched) = (0_u32, 0_u32, 0.0, 0.0);
    for slice in pressure_mpa.chunks_exact(points.max(1)) {
        slices += 1;
        let mut is_touched = false;
        for &point in &active {
            let half = |other: usize| 0.5 * (flank.radius_mm[point] - flank.radius_mm[other]).abs();
            let share = half(point.saturating_sub(1)) + half((point + 1).min(points - 1));
            area += share;
            if slice[point] > 0.0 {
                touched += share;
                is_touched = true;
            }
        }
        wide += u32::from(is_touched);
    }
    if area <= 0.0 {
        return String::new();
    }
    let width = percent(f64::from(wide) / f64::from(slices));
    format!(
        " The contact pattern covers {width} of the face width and {} of the active flank.",
        percent(touched / area)
    )
}

/// Where the colours of a field end, somewhat above its greatest value `between` the tip-edge zones, and what to say of what is beyond.
fn colours_of(field: &[f64], between: f64, unit: &str) -> (f64, String) {
    let (all, end) = (greatest(field).map_or(0.0, |peak| peak.value), COLOURS_BEYOND_FLANK * between);
    if end.is_nan() || end <= 0.0 || all <= end {
        return (all, String::new());
    }
    (end, format!(" Colours end at {} {unit}: tip edges have more.", figure(end)))
}

/// The wear at every snapshot that is drawn.
fn over_time(run: SlicedRun<'_>, gear: Gear) -> Control {
    let (flank, history) = (&run.record.flanks[gear], &run.record.history);
    let raster = SlicedRaster::of_flank(flank, run.record.surface[gear].face_width_mm);
    let points = flank.radius_mm.len();
    let steps = drawn_snapshots(history.len()).into_iter().map(|snapshot| {
        let wear = &flank.snapshot_wear_um[snapshot];
        let cells = raster.rows(|point, slice| wear[slice * points + point]);
        SliderStep { label: moment(&history[snapshot]), change: Change::Cells(cells) }
    });
    Control::Steps { name: "time", steps: steps.collect() }
}

fn map(run: SlicedRun<'_>, gear: Gear, quantity: MappedQuantity<'_>) -> Chart {
    let flank = &run.record.flanks[gear];
    let raster = SlicedRaster::of_flank(flank, run.record.surface[gear].face_width_mm);
    let points = flank.radius_mm.len();
    let values = raster.rows(|point, slice| quantity.values[slice * points + point]);
    let unit = quantity.unit;
    let colours = Trace::heat_map(unit, &raster.across.edges, &raster.along.edges, values)
        .colours_up_to(quantity.top)
        .hover(format!("width %{{x:.2f}} mm, radius %{{y:.2f}} mm<br>%{{z:.4~g}} {unit}<extra></extra>"));
    let ends = |edges: &[f64]| match edges {
        [first, .., last] => [*first, *last],
        _ => [0.0, 1.0],
    };
    let (name, [before, after]) = (gear.name(), quantity.title);
    Chart::new(format!("map-{}-{name}", quantity.id), format!("{before} the {name}’s flank{after}"))
        .height(360)
        .legend(false)
        .read_nearest()
        .x("face width, mm")
        .x_range(ends(&raster.across.edges))
        .y(&format!("radius on the {name}, mm"))
        .y_range(ends(&raster.along.edges))
        .without_grid()
        .label(path_points(flank))
        .add(colours)
        .add(lines_of_contact(run, gear))
        .reading(quantity.reading)
}

/// The letters A–E at the right of the map.
fn path_points(flank: &FlankRecord) -> impl Iterator<Item = Label> {
    let points = flank.path_point_radius_mm.named().into_iter().filter(|(_, radius)| radius.is_finite());
    points.map(|(name, y)| Label::Beside { name: name.to_owned(), y })
}

/// Lines of contact at evenly spaced positions of the tooth between its first and its last touch, as one line with gaps.
fn lines_of_contact(run: SlicedRun<'_>, gear: Gear) -> Trace {
    let lines = lines_mm(run, gear);
    let along = |axis: usize| {
        lines.iter().flat_map(move |points| points.iter().map(move |point| Some(point[axis])).chain([None]))
    };
    Trace::line("lines of contact", along(0), along(1), ("rgba(255,255,255,0.8)", 1.3, Dash::Solid))
}

/// Those lines as points (width, radius), mm.
fn lines_mm(run: SlicedRun<'_>, gear: Gear) -> Vec<Vec<[f64; 2]>> {
    let surface = &run.record.surface[gear];
    let path = &run.record.summary.geometry.curvature_radius_mm;
    let reach = 0.5 * surface.face_width_mm * surface.base_helix_tangent.abs();
    let (first, last) = (path.A - reach, path.E + reach);
    (0..LINES_OF_CONTACT)
        .map(|i| first + (last - first) * (i as f64 + 0.5) / LINES_OF_CONTACT as f64)
        .map(|position| {
            (0..=PIECES)
                .map(|piece| surface.face_width_mm * piece as f64 / PIECES as f64)
                .map(|width| (width, surface.contact_rho_mm(position, width)))
                .filter(|(_, rho)| touches(run, gear, *rho))
                .map(|(width, rho)| [width, surface.base_radius_mm.hypot(rho)])
                .collect()
        })
        .collect()
}

/// Whether `rho_mm` lies on the active flank.
fn touches(run: SlicedRun<'_>, gear: Gear, rho_mm: f64) -> bool {
    let path = &run.record.summary.geometry.curvature_radius_mm;
    let position = match gear {
        Gear::Pinion => rho_mm,
        Gear::Wheel => run.record.surface[gear].line_of_action_mm - rho_mm,
    };
    (path.A..=path.E).contains(&position)
}

/// "3.21 µm at 34.12 mm radius, close to A, in slice 2 (1.5 mm)".
fn peak_of(flank: &FlankRecord, field: &[f64], unit: &str) -> String {
    let Some(peak) = greatest(field) else { return format!("nothing in {unit}") };
    let points = flank.radius_mm.len();
    let (slice, point) = (peak.index / points, peak.index % points);
    format!(
        "{} {unit} {}, in {}",
        figure(peak.value),
        place_on_flank(flank, flank.radius_mm[point]),
        slice_name(flank, slice),
    )
}

fn wear_reading(run: SlicedRun<'_>, gear: Gear) -> String {
    let flank = &run.record.flanks[gear];
    let root = &run.helical.wear[gear].root_wear_um;
    let mut reading = match (root.first(), root.last()) {
        (Some(first), Some(last)) if flank.wear_um.iter().any(|&wear| wear > 0.0) => format!(
            "The {} has worn up to {}; over its root by up to {} µm in the first slice and {} µm in the last.",
            gear.name(),
            peak_of(flank, &flank.wear_um, "µm"),
            figure(*first),
            figure(*last),
        ),
        _ => format!("The {}’s flank has not worn.", gear.name()),
    };
    reading.push_str(" White: lines of contact.");
    reading
}

fn sliding_reading(flank: &FlankRecord) -> String {
    format!(
        "A point slides up to {} against the other flank; on the pitch circle, at {} mm radius, the sliding changes its direction.",
        peak_of(flank, &flank.sliding_mm_per_mesh, "mm"),
        significant(flank.path_point_radius_mm.C, 4),
    )
}

/// Where the pressure is greatest, and what it is where the first slice begins its contact.
fn pressure_reading(run: SlicedRun<'_>, gear: Gear, field: &[f64], when: &str) -> String {
    let flank = &run.record.flanks[gear];
    let mut reading =
        format!("The maximum pressure on the {}, {when}, is {}.", gear.name(), peak_of(flank, field, "MPa"));
    reading.push_str(yield_note(greatest(field).map_or(0.0, |at| at.value)));
    // The slice that is farthest ahead enters first.
    if let Some(entering) = greatest(&run.slices.ahead_mm) {
        let points = flank.radius_mm.len();
        let first_touch = flank.path_point_radius_mm.A;
        let after = flank.first_from(first_touch);
        let nearest = match gear {
            // A is where the pinion's active flank begins, and where the wheel's ends.
            Gear::Pinion => after.min(points.saturating_sub(1)),
            Gear::Wheel => after.saturating_sub(1),
        };
        // A rounded tip edge is not touched at its very end.
        if let Some(pressure) = field.get(entering.index * points + nearest).filter(|&&pressure| pressure > 0.0) {
            reading.push_str(&format!(
                " Where the tooth first touches, at A in {}, it is {} MPa.",
                slice_name(flank, entering.index),
                figure(*pressure)
            ));
        }
    }
    reading
}
