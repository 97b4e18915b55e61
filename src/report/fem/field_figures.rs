//! The model, and the von Mises stress over the bodies: whole, and around each contact.

use crate::report::chart::{DragMode, HoverInfo, Marker, MarkerSymbol, Mode, Plot, Trace};

use crate::fem::problem::Edge;
use crate::report::html::field_plot::{self, Bodies, MOST_SIDES, Quantity, Window, segments, sides, to_scale};
use crate::report::html::number::{count, figure, plotted, significant};
use crate::report::html::reading::greatest;
use crate::report::html::theme::{Figure, MUTED};
use crate::results::fem_problem::{ContactCurve, ContactSummary, FemRecord};

/// Half the height of the picture of a contact, in half-widths.
const AROUND: f64 = 2.0;
/// Marks of one kind that are drawn at the most: beyond, every second, third … of them.
const MOST_MARKS: usize = 200;

/// The undeformed mesh with its supports, loads and surfaces.
pub fn model(record: &FemRecord) -> Figure {
    let solid = &record.problem.solid;
    let points: Vec<[f64; 2]> = solid.points_mm.iter().map(|p| [p.x, p.y]).collect();
    let bodies = Bodies { points_mm: &points, elements: &solid.elements };
    let window = Window::around(&points);
    let (outline, inner) = sides(bodies, window);
    let mut plot = Plot::new();
    if inner.len() <= MOST_SIDES {
        plot.add_trace(segments("elements", bodies, &inner, "var(--rule)", 0.7).show_legend(false));
    }
    plot.add_trace(segments("outline", bodies, &outline, "var(--ink)", 1.2).show_legend(false));
    for (contact, names) in record.problem.contacts.iter().zip(&record.summary.contact) {
        for (edges, name, colour) in [
            (&contact.slave, format!("slave {}", names.slave), "var(--pinion)"),
            (&contact.master, format!("master {}", names.master), "var(--wheel)"),
        ] {
            plot.add_trace(segments(&name, bodies, &along(edges), colour, 3.0));
        }
    }
    let held = |component: u32| {
        record.problem.held.iter().filter(move |held| held.dof % 2 == component).map(|held| held.dof / 2)
    };
    let loaded = (0..points.len() as u32).filter(|&node| {
        let dof = 2 * node as usize;
        record.problem.forces_n_per_mm[dof..dof + 2].iter().any(|force| *force != 0.0)
    });
    for (name, symbol, nodes) in [
        ("held along x", MarkerSymbol::TriangleRightOpen, held(0).collect::<Vec<_>>()),
        ("held along y", MarkerSymbol::TriangleUpOpen, held(1).collect()),
        ("force", MarkerSymbol::CircleOpen, loaded.collect()),
    ] {
        if !nodes.is_empty() {
            plot.add_trace(marks(name, symbol, &nodes, &points));
        }
    }
    plot.set_layout(to_scale(window).show_legend(true).drag_mode(DragMode::Zoom));
    let materials = record.bodies.iter().zip(&record.problem.materials).map(|(body, material)| {
        format!(
            "{body} of {} GPa and Poisson’s ratio {}",
            significant(material.young_modulus_mpa / 1e3, 4),
            significant(material.poisson_ratio, 3)
        )
    });
    Figure {
        id: "model".into(),
        title: "The model".into(),
        reading: format!(
            "{} elements on {} nodes: {}.",
            count(solid.elements.len() as u64),
            count(points.len() as u64),
            materials.collect::<Vec<_>>().join("; ")
        ),
        plot,
        wide: true,
    }
}

fn along(edges: &[Edge]) -> Vec<Vec<u32>> {
    edges
        .iter()
        .map(|edge| [Some(edge.ends[0]), edge.middle, Some(edge.ends[1])].into_iter().flatten().collect())
        .collect()
}

fn marks(name: &str, symbol: MarkerSymbol, nodes: &[u32], points: &[[f64; 2]]) -> Trace {
    let step = nodes.len().div_ceil(MOST_MARKS);
    let [x, y] =
        [0, 1].map(|axis| nodes.iter().step_by(step).map(|&node| plotted(points[node as usize][axis])).collect());
    Trace::scatter(x, y)
        .name(name)
        .mode(Mode::Markers)
        .marker(Marker::new().symbol(symbol).size(8).color(MUTED))
        .hover_info(HoverInfo::Skip)
}

/// The von Mises stress: over all bodies, and around each contact that carries load; deformed as computed.
pub fn von_mises(record: &FemRecord) -> Vec<Figure> {
    let solid = &record.problem.solid;
    let deformed: Vec<[f64; 2]> =
        solid.points_mm.iter().zip(&record.displacement_mm).map(|(p, u)| [p.x + u[0], p.y + u[1]]).collect();
    let bodies = Bodies { points_mm: &deformed, elements: &solid.elements };
    let values: Vec<f64> = record.stress.iter().map(|stress| stress.von_mises_MPa).collect();
    let quantity = Quantity { name: "σ<sub>v</sub>, MPa", unit: "MPa", values: &values };
    let picture = |id: String, title: String, reading: String, window: Window| Figure {
        id,
        title,
        reading,
        plot: field_plot::field(bodies, quantity, window),
        wide: true,
    };
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
    let mut figures = vec![picture("stress".into(), "Von Mises stress".into(), whole, Window::around(&deformed))];
    for (index, (summary, contact)) in record.summary.contact.iter().zip(&record.contacts).enumerate() {
        let Some(middle) = middle(contact) else { continue };
        if summary.half_width_mm <= 0.0 {
            continue;
        }
        let (surface, below) = (summary.peak_pressure_MPa, peak_within(&deformed, &values, middle, summary));
        let reading = format!(
            "{} half-widths on either side of the middle of the contact, deformed as computed. The stress is greatest with {} MPa, {} of \
             the greatest pressure{}.",
            significant(AROUND * 1.75, 2),
            figure(below),
            significant(below / surface, 3),
            if summary.hertz.is_some() {
                "; under a line contact of Hertz in plane strain with ν = 0.3 it is 0.558 of it, 0.70 half-widths deep"
            } else {
                ""
            }
        );
        figures.push(picture(
            format!("stress-{index}"),
            format!("Von Mises stress at {} on {}", summary.slave, summary.master),
            reading,
            Window::about(middle, AROUND * summary.half_width_mm).within(Window::around(&deformed)),
        ));
    }
    figures
}

/// The middle of a contact, deformed.
fn middle(contact: &ContactCurve) -> Option<[f64; 2]> {
    let distance = |along_mm: f64| (along_mm - contact.centre_along_mm).abs();
    let row = contact.rows.iter().min_by(|a, b| distance(a.along_mm).total_cmp(&distance(b.along_mm)))?;
    Some([row.x_mm + row.displacement_x_mm, row.y_mm + row.displacement_y_mm])
}

/// The greatest value at a node within the picture of a contact.
fn peak_within(points: &[[f64; 2]], values: &[f64], middle: [f64; 2], summary: &ContactSummary) -> f64 {
    let reach = AROUND * summary.half_width_mm;
    let near = |p: &[f64; 2]| (p[0] - middle[0]).abs() <= reach && (p[1] - middle[1]).abs() <= reach;
    points.iter().zip(values).filter(|(p, _)| near(p)).map(|(_, value)| *value).fold(0.0, f64::max)
}
