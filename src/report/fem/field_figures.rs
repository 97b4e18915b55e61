//! The model, and the von Mises stress over the bodies: whole, and around each contact.

use crate::report::chart::{Chart, INK, MUTED, Trace};
use crate::report::html::field_plot::{self, WIDTH_OVER_HEIGHT, segments, side_lines, to_scale};
use crate::report::html::number::{count, figure, significant};
use crate::report::html::reading::greatest;
use gearwear_fem::field_raster::{self, Bodies, Window, greatest_near};
use gearwear_fem::problem::Edge;
use gearwear_physics::results::fem_problem::{ContactCurve, FemRecord, FemSummary, PlaneSolution};

/// Half the height of the picture of a contact, in half-widths.
const AROUND: f64 = 2.0;
/// Marks of one kind that are drawn at the most: beyond, every second, third … of them.
const MOST_MARKS: usize = 200;

/// The undeformed mesh with its supports, loads and surfaces.
pub(super) fn model(record: &FemRecord, PlaneSolution { problem, .. }: &PlaneSolution) -> Chart {
    let solid = &problem.solid;
    let points: Vec<[f64; 2]> = solid.points_mm.iter().map(|p| [p.x, p.y]).collect();
    let bodies = Bodies { points_mm: &points, elements: &solid.elements };
    let window = Window::around(&points);
    let materials = record.bodies.iter().zip(&problem.materials).map(|(body, material)| {
        format!(
            "{body} of {} GPa and Poisson’s ratio {}",
            significant(material.young_modulus_mpa / 1e3, 4),
            significant(material.poisson_ratio, 3)
        )
    });
    let mut chart = Chart::new("model", "The model").wide().reading(format!(
        "{} elements on {} nodes: {}.",
        count(solid.elements.len() as u64),
        count(points.len() as u64),
        materials.collect::<Vec<_>>().join("; ")
    ));
    let (inner, outline) = side_lines(bodies, window, ("var(--rule)", 0.7), ("outline", INK, 1.2));
    chart = chart.add_all(inner.into_iter().chain([outline]).map(Trace::unlisted));
    for (contact, names) in problem.contacts.iter().zip(&record.summary.contact) {
        for (edges, name, colour) in [
            (&contact.slave, format!("slave {}", names.slave), "var(--pinion)"),
            (&contact.master, format!("master {}", names.master), "var(--wheel)"),
        ] {
            chart = chart.add(segments(&name, bodies, &along(edges), colour, 3.0));
        }
    }
    let held =
        |component: u32| problem.held.iter().filter(move |held| held.dof % 2 == component).map(|held| held.dof / 2);
    let loaded = (0..points.len() as u32).filter(|&node| {
        let dof = 2 * node as usize;
        problem.forces_n_per_mm[dof..dof + 2].iter().any(|force| *force != 0.0)
    });
    for (name, symbol, nodes) in [
        ("held along x", "triangle-right-open", held(0).collect::<Vec<_>>()),
        ("held along y", "triangle-up-open", held(1).collect()),
        ("force", "circle-open", loaded.collect()),
    ] {
        if !nodes.is_empty() {
            chart = chart.add(marks(name, symbol, &nodes, &points));
        }
    }
    to_scale(chart, window)
}

fn along(edges: &[Edge]) -> Vec<Vec<u32>> {
    edges
        .iter()
        .map(|edge| [Some(edge.ends[0]), edge.middle, Some(edge.ends[1])].into_iter().flatten().collect())
        .collect()
}

fn marks(name: &str, symbol: &str, nodes: &[u32], points: &[[f64; 2]]) -> Trace {
    let step = nodes.len().div_ceil(MOST_MARKS);
    let along = |axis: usize| nodes.iter().step_by(step).map(move |&node| points[node as usize][axis]);
    Trace::points(name, along(0), along(1), (MUTED, symbol, 8))
}

/// The von Mises stress: over all bodies, and around each contact that carries load; deformed as computed.
pub(super) fn von_mises(summary: &FemSummary, plane: &PlaneSolution) -> Vec<Chart> {
    let solid = &plane.problem.solid;
    let deformed = field_raster::deformed(solid.points_mm.iter().map(|p| [p.x, p.y]), &plane.displacement_mm);
    let bodies = Bodies { points_mm: &deformed, elements: &solid.elements };
    let values: Vec<f64> = plane.stress.iter().map(|stress| stress.von_mises_MPa).collect();
    let picture = |chart: Chart, window: Window| field_plot::von_mises(chart, bodies, &values, window);
    let whole = greatest(&values).map_or_else(String::new, |peak| {
        let at = solid.points_mm[peak.index];
        format!(
            "The von Mises stress is greatest with {} MPa at x = {} mm, y = {} mm before deformation. The bodies are shown \
             deformed, to scale.",
            figure(peak.value),
            significant(at.x, 4),
            significant(at.y, 4)
        )
    });
    let chart = Chart::new("stress", "Von Mises stress").reading(whole);
    let mut charts = vec![picture(chart, Window::around(&deformed))];
    for (index, (summary, contact)) in summary.contact.iter().zip(&plane.contacts).enumerate() {
        let Some(middle) = middle(contact) else { continue };
        if summary.half_width_mm <= 0.0 {
            continue;
        }
        let below = greatest_near(bodies, &values, middle, AROUND * summary.half_width_mm);
        let reading = format!(
            "{} half-widths on either side of the middle of the contact, deformed as computed. The stress is greatest with {} MPa, {} of \
             the maximum pressure{}.",
            significant(AROUND * 1.75, 2),
            figure(below),
            significant(below / summary.peak_pressure_MPa, 3),
            if summary.hertz.is_some() {
                "; under a line contact of Hertz in plane strain with ν = 0.3 it is 0.558 of it, 0.70 half-widths deep"
            } else {
                ""
            }
        );
        let title = format!("Von Mises stress at {} on {}", summary.slave, summary.master);
        let window =
            Window::about(middle, AROUND * summary.half_width_mm, WIDTH_OVER_HEIGHT).within(Window::around(&deformed));
        charts.push(picture(Chart::new(format!("stress-{index}"), title).reading(reading), window));
    }
    charts
}

fn middle(contact: &ContactCurve) -> Option<[f64; 2]> {
    let distance = |along_mm: f64| (along_mm - contact.centre_along_mm).abs();
    let row = contact.rows.iter().min_by(|a, b| distance(a.along_mm).total_cmp(&distance(b.along_mm)))?;
    Some([row.x_mm + row.displacement_x_mm, row.y_mm + row.displacement_y_mm])
}
