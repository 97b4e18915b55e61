//! The pair in mesh, drawn to scale in the transverse section.

use std::f64::consts::TAU;

use super::number::{figure, significant};
use crate::report::chart::{Chart, Dash, INK, Label, MUTED, PATH, Trace, gear_colour, gear_fill};
use crate::report::control::{Control, MeshMotion, TurningBody};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::results::run::{GearCircles, PairDrawing, RunRecord};

/// Points of a drawn circle: its sagitta stays below 1e-4 of the radius.
const CIRCLE_POINTS: usize = 240;

/// A coordinate for the drawing, to a tenth of a micrometre.
fn to_scale(mm: f64) -> f64 {
    (mm * 1e4).round() / 1e4
}

/// Both gears, the line of action and the path of contact; zoomed on the mesh to begin with: the path of contact with three
/// modules around it. A double click shows both gears whole.
pub(super) fn pair(record: &RunRecord) -> Chart {
    let drawing = &record.drawing;
    let line_of_action = polyline("line of action T1T2", &drawing.line_of_action, (MUTED, 1.4, Dash::Solid));
    let chart = Chart::new("pair", "The pair in mesh, to scale")
        .wide()
        .height(620)
        .x("x, mm")
        .y("y, mm")
        .drawn_to_scale()
        .read_nearest()
        .dragged()
        .label(ends_of_the_line_of_action(drawing))
        .add_all(Gear::BOTH.map(|gear| outline(drawing, gear)))
        .add_all(Gear::BOTH.into_iter().flat_map(|gear| circles(drawing, gear)))
        .add(line_of_action)
        .add(path_of_contact(drawing))
        .reading(reading(record));
    let chart = with_motion(chart, record);
    let pinion = &record.summary.geometry.gears.pinion;
    let around = 3.0 * pinion.reference_diameter_mm / f64::from(pinion.teeth.max(1));
    if drawing.path_of_contact.is_empty() || !around.is_finite() {
        return chart;
    }
    let [x, y] = [0, 1].map(|axis| {
        let [low, high] = extent(drawing.path_of_contact.iter().map(|(_, point)| point[axis]));
        [low - around, high + around]
    });
    chart.x_range(x).y_range(y)
}

/// The pair, which the reader turns through the mesh, and the points where its flanks touch.
fn with_motion(chart: Chart, record: &RunRecord) -> Chart {
    let (drawing, geometry) = (&record.drawing, &record.summary.geometry);
    let [from, to] = drawing.line_of_action;
    // T1T2 is negative of an internal pair: contact is on the other side of T1.
    let sense = drawing.circles_mm.wheel.base.signum();
    let along = [to[0] - from[0], to[1] - from[1]].map(|component| sense * component);
    let length_mm = along[0].hypot(along[1]);
    let path = &geometry.curvature_radius_mm;
    let at_mm = [path.A, path.C, path.E];
    if record.mesh_cycle.is_empty() || length_mm <= 0.0 || at_mm.iter().any(|at| !at.is_finite()) {
        return chart;
    }
    let (origin_mm, direction) = (from, along.map(|component| component / length_mm));
    // Base circles roll off the line of action, the pinion's anticlockwise.
    let turning = [(Gear::Pinion, 1.0), (Gear::Wheel, -1.0)].map(|(gear, sense)| TurningBody {
        trace: gear as usize,
        centre_mm: drawing.axis[gear],
        radians_per_mm: sense / drawing.circles_mm[gear].base,
    });
    let motion = MeshMotion {
        bodies: turning,
        drawn_at_mm: path.C,
        path_mm: [path.A, path.E],
        base_pitch_mm: geometry.base_pitch_mm,
        contacts: chart.traces.len(),
        origin_mm,
        direction,
        position_mm: record.mesh_cycle.iter().map(|row| to_scale(row.position_mm)).collect(),
        load_share: record.mesh_cycle.iter().map(|row| to_scale(row.load_share_worn)).collect(),
    };
    let at_c = [0, 1].map(|axis| [origin_mm[axis] + path.C * direction[axis]]);
    let contacts = Trace::points("contact", at_c[0], at_c[1], (INK, "circle", 9));
    chart.add(contacts).movable(Control::Mesh(motion))
}

fn polyline(name: &str, points: &[[f64; 2]], stroke: (&str, f64, Dash)) -> Trace {
    Trace::line(name, points.iter().map(|p| p[0]), points.iter().map(|p| p[1]), stroke)
}

fn outline(drawing: &PairDrawing, gear: Gear) -> Trace {
    let mut points = drawing.outline[gear].clone();
    if let (Gear::Wheel, Some(rim_mm)) = (gear, drawing.rim_radius_mm) {
        // The rim's circle is joined to the outline opposite the mesh, so that the ring between them is filled.
        let middle = points.len() / 2;
        points.rotate_left(middle);
        points.extend(points.first().copied());
        points.extend(rim(&points[0], drawing.axis[gear], rim_mm));
    }
    points.extend(points.first().copied());
    polyline(gear.name(), &points, (gear_colour(gear), 1.8, Dash::Solid)).filled(gear_fill(gear))
}

/// Base, working pitch and tip circle, and the bore; one legend entry for the circles of both gears.
fn circles(drawing: &PairDrawing, gear: Gear) -> impl Iterator<Item = Trace> {
    let GearCircles { base, working_pitch, tip } = drawing.circles_mm[gear];
    let circles = [
        ("base circles", Some(base), Dash::Dot, true),
        ("pitch circles", Some(working_pitch), Dash::Mixed, true),
        ("tip circles", Some(tip), Dash::Dashed, true),
        ("bores", drawing.bore_radius_mm[gear], Dash::Solid, false),
    ];
    circles.into_iter().filter_map(move |(name, radius, dash, listed)| {
        let circle = polyline(name, &circle(drawing.axis[gear], radius?), (gear_colour(gear), 1.0, dash));
        let circle = circle.opacity(0.8).group(name);
        Some(if listed && gear == Gear::Pinion { circle } else { circle.unlisted() })
    })
}

/// Circle about `centre` that begins and ends beside `point`.
fn rim(point: &[f64; 2], centre: [f64; 2], radius_mm: f64) -> Vec<[f64; 2]> {
    let first = (point[1] - centre[1]).atan2(point[0] - centre[0]);
    (0..=CIRCLE_POINTS)
        .map(|i| {
            let (sin, cos) = (first - TAU * i as f64 / CIRCLE_POINTS as f64).sin_cos();
            [centre[0] + radius_mm * cos, centre[1] + radius_mm * sin]
        })
        .collect()
}

fn circle(centre: [f64; 2], radius_mm: f64) -> Vec<[f64; 2]> {
    (0..=CIRCLE_POINTS)
        .map(|i| {
            let (sin, cos) = (TAU * i as f64 / CIRCLE_POINTS as f64).sin_cos();
            [centre[0] + radius_mm * cos, centre[1] + radius_mm * sin]
        })
        .collect()
}

fn path_of_contact(drawing: &PairDrawing) -> Trace {
    let points: Vec<[f64; 2]> = drawing.path_of_contact.iter().map(|(_, point)| *point).collect();
    let names: Vec<String> = drawing.path_of_contact.iter().map(|(name, _)| name.clone()).collect();
    polyline("path of contact A–E", &points, (PATH, 4.5, Dash::Solid))
        .with_points("circle", 8)
        .lettered(names)
        .hover("%{text}: x %{x:.3f} mm, y %{y:.3f} mm<extra></extra>")
}

fn ends_of_the_line_of_action(drawing: &PairDrawing) -> [Label; 2] {
    let [t1, t2] = drawing.line_of_action;
    [("T1", t1), ("T2", t2)].map(|(name, at)| Label::Above { name: name.to_owned(), at })
}

fn reading(record: &RunRecord) -> String {
    let geometry = &record.summary.geometry;
    let length = geometry.curvature_radius_mm.E - geometry.curvature_radius_mm.A;
    let [length, whole, angle] = [length, geometry.line_of_action_mm, geometry.working_pressure_angle_deg].map(figure);
    let line = match record.drawing.rim_radius_mm {
        Some(_) => format!("{length} mm long, on the line of action beyond T1, at {angle}°"),
        None => format!("{length} mm of the {whole} mm long line of action at {angle}°"),
    };
    format!(
        "The flanks touch along the path of contact from A to E, {line}; a tooth \
         pair follows every {} mm, so {} pairs are in contact on average. Double-click shows both gears whole; the \
         slider turns the pair through the mesh and tells what share of the load each contact of the worn pair carries.",
        figure(geometry.base_pitch_mm),
        significant(geometry.transverse_contact_ratio, 4),
    )
}
