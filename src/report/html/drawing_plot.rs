//! The pair in mesh, drawn to scale in the transverse section.

use std::f64::consts::TAU;

use crate::report::chart::{
    Anchor, Annotation, AxisConstrain, DashType, DragMode, Fill, Font, HoverInfo, HoverMode, Layout, Marker, Mode,
    Plot, Position, Trace,
};

use super::number::{figure, significant};
use super::theme::{Figure, MUTED, PATH, axis, gear_colour, layout, line};
use crate::gear::Gear;
use crate::results::run::{GearCircles, PairDrawing, RunRecord};

/// Points of a drawn circle: its sagitta stays below 1e-4 of the radius.
const CIRCLE_POINTS: usize = 240;

/// A coordinate for the drawing, to a tenth of a micrometre.
fn to_scale(mm: f64) -> f64 {
    (mm * 1e4).round() / 1e4
}

/// Both gears, the line of action and the path of contact; zoomed on the mesh to begin with.
pub fn pair(record: &RunRecord) -> Figure {
    let drawing = &record.drawing;
    let mut plot = Plot::new();
    for gear in Gear::BOTH {
        plot.add_trace(outline(drawing, gear));
    }
    for gear in Gear::BOTH {
        add_circles(&mut plot, drawing, gear);
    }
    let [t1, t2] = drawing.line_of_action;
    plot.add_trace(
        polyline("line of action T1T2", &[t1, t2]).line(line(MUTED, 1.4, DashType::Solid)).hover_info(HoverInfo::Skip),
    );
    plot.add_trace(path_of_contact(drawing));
    plot.set_layout(zoomed_on_mesh(record));
    Figure { id: "pair".into(), title: "The pair in mesh, to scale".into(), reading: reading(record), plot, wide: true }
}

fn polyline(name: &str, points: &[[f64; 2]]) -> Trace {
    let [x, y] = [0, 1].map(|axis| points.iter().map(|p| to_scale(p[axis])).collect());
    Trace::scatter(x, y).name(name).mode(Mode::Lines)
}

fn outline(drawing: &PairDrawing, gear: Gear) -> Trace {
    let mut points = drawing.outline[gear].clone();
    points.extend(points.first().copied());
    let fill = match gear {
        Gear::Pinion => "var(--pinion-fill)",
        Gear::Wheel => "var(--wheel-fill)",
    };
    polyline(gear.name(), &points)
        .line(line(gear_colour(gear), 1.8, DashType::Solid))
        .fill(Fill::ToSelf)
        .fill_color(fill)
        .hover_info(HoverInfo::Skip)
}

/// Base, working pitch and tip circle, and the bore; one legend entry for the circles of both gears.
fn add_circles(plot: &mut Plot, drawing: &PairDrawing, gear: Gear) {
    let GearCircles { base, working_pitch, tip } = drawing.circles_mm[gear];
    let circles = [
        ("base circles", Some(base), DashType::Dot, true),
        ("pitch circles", Some(working_pitch), DashType::DashDot, true),
        ("tip circles", Some(tip), DashType::Dash, true),
        ("bores", drawing.bore_radius_mm[gear], DashType::Solid, false),
    ];
    for (name, radius, dash, listed) in circles {
        let Some(radius) = radius else { continue };
        plot.add_trace(
            polyline(name, &circle(drawing.axis[gear], radius))
                .line(line(gear_colour(gear), 1.0, dash))
                .opacity(0.8)
                .legend_group(name)
                .show_legend(listed && gear == Gear::Pinion)
                .hover_info(HoverInfo::Skip),
        );
    }
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
    polyline("path of contact A–E", &points)
        .mode(Mode::LinesMarkersText)
        .line(line(PATH, 4.5, DashType::Solid))
        .marker(Marker::new().color(PATH).size(8))
        .text_array(names)
        .text_position(Position::TopCenter)
        .text_font(Font::new().size(15).color(PATH))
        .hover_template("%{text}: x %{x:.3f} mm, y %{y:.3f} mm<extra></extra>")
}

/// The view to begin with: the path of contact with three modules around it. A double click shows both gears whole.
fn zoomed_on_mesh(record: &RunRecord) -> Layout {
    let drawing = &record.drawing;
    let pinion = &record.summary.geometry.gears.pinion;
    let around = 3.0 * pinion.reference_diameter_mm / f64::from(pinion.teeth.max(1));
    let within = |axis: usize| {
        let along = drawing.path_of_contact.iter().map(|(_, point)| point[axis]);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        vec![low - around, high + around]
    };
    let (mut x, mut y) = (axis("x, mm"), axis("y, mm").scale_anchor("x").scale_ratio(1.0));
    if !drawing.path_of_contact.is_empty() && around.is_finite() {
        (x, y) = (x.range(within(0)), y.range(within(1)));
    }
    layout(620)
        .show_legend(true)
        .hover_mode(HoverMode::Closest)
        .drag_mode(DragMode::Pan)
        .x_axis(x.constrain(AxisConstrain::Range))
        .y_axis(y.constrain(AxisConstrain::Range))
        .annotations(ends_of_the_line_of_action(drawing))
}

fn ends_of_the_line_of_action(drawing: &PairDrawing) -> Vec<Annotation> {
    ["T1", "T2"]
        .into_iter()
        .zip(drawing.line_of_action)
        .map(|(name, [x, y])| {
            Annotation::new()
                .x_ref("x")
                .y_ref("y")
                .x(to_scale(x))
                .y(to_scale(y))
                .y_anchor(Anchor::Bottom)
                .show_arrow(false)
                .text(name)
                .font(Font::new().size(12).color(MUTED))
        })
        .collect()
}

fn reading(record: &RunRecord) -> String {
    let geometry = &record.summary.geometry;
    let length = geometry.curvature_radius_mm.E - geometry.curvature_radius_mm.A;
    format!(
        "The flanks touch along the path of contact from A to E, {} mm of the {} mm long line of action at {}°; a tooth \
         pair follows every {} mm, so {} pairs are in contact on average. Double-click shows both gears whole.",
        figure(length),
        figure(geometry.line_of_action_mm),
        figure(geometry.working_pressure_angle_deg),
        figure(geometry.base_pitch_mm),
        significant(geometry.transverse_contact_ratio, 4),
    )
}
