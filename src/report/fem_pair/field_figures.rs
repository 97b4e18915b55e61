//! The teeth in contact as finite elements, and the von Mises stress in them.

use crate::report::chart::{DragMode, Plot};

use crate::fem::solid::Element;
use crate::gear::Gear;
use crate::report::html::field_plot::{self, Bodies, MOST_SIDES, Quantity, Window, segments, sides, to_scale};
use crate::report::html::number::{count, figure, significant};
use crate::report::html::theme::{Figure, gear_colour};
use crate::results::fem_pair::{ContactPlace, FemPairSummary, PairSolution};

/// Half the height of the picture of a contact, in half-widths.
const AROUND: f64 = 2.0;

/// The elements of the teeth, undeformed.
pub fn mesh(s: &FemPairSummary, solution: &PairSolution) -> Figure {
    let window = Window::around(&solution.points_mm);
    let mut plot = Plot::new();
    for (gear, material) in Gear::BOTH.into_iter().zip(0..) {
        let own: Vec<Element> = solution.elements.iter().filter(|e| e.material == material).copied().collect();
        let bodies = Bodies { points_mm: &solution.points_mm, elements: &own };
        let (outline, inner) = sides(bodies, window);
        if inner.len() <= MOST_SIDES {
            plot.add_trace(segments("elements", bodies, &inner, "var(--rule)", 0.6).show_legend(false));
        }
        plot.add_trace(segments(gear.name(), bodies, &outline, gear_colour(gear), 1.4));
    }
    plot.set_layout(to_scale(window).show_legend(true).drag_mode(DragMode::Zoom));
    let gears = &s.model.gears;
    Figure {
        id: "mesh".into(),
        title: "Finite elements of the teeth that may touch".into(),
        reading: format!(
            "{} elements on {} nodes, at the contact position of {} mm before loading; drag over a contact to see them. They \
             are part of bodies of {} degrees of freedom (pinion, held rigidly at {} mm and turned by the torque) and {} \
             (wheel, held at {} mm).",
            count(solution.elements.len() as u64),
            count(solution.points_mm.len() as u64),
            significant(solution.position_mm, 5),
            count(gears.pinion.dofs as u64),
            significant(gears.pinion.clamp_radius_mm, 4),
            count(gears.wheel.dofs as u64),
            significant(gears.wheel.clamp_radius_mm, 4),
        ),
        plot,
        wide: true,
    }
}

/// The von Mises stress in the teeth, and around each contact, deformed as computed.
pub fn von_mises(solution: &PairSolution) -> Vec<Figure> {
    let deformed: Vec<[f64; 2]> =
        solution.points_mm.iter().zip(&solution.displacement_mm).map(|(p, u)| [p[0] + u[0], p[1] + u[1]]).collect();
    let bodies = Bodies { points_mm: &deformed, elements: &solution.elements };
    let values: Vec<f64> = solution.stress.iter().map(|stress| stress.von_mises_MPa).collect();
    let quantity = Quantity { name: "σ<sub>v</sub>, MPa", unit: "MPa", values: &values };
    let picture = |id: String, title: String, reading: String, window: Window| Figure {
        id,
        title,
        reading,
        plot: field_plot::field(bodies, quantity, window),
        wide: true,
    };
    let whole = format!(
        "The teeth at the contact position of {} mm, deformed to scale. The stress is greatest under the contact{}, next at \
         the fillets.",
        significant(solution.position_mm, 5),
        if solution.contacts.len() == 1 { "" } else { "s" },
    );
    let mut figures = vec![picture("stress".into(), "Von Mises stress".into(), whole, Window::around(&deformed))];
    figures.extend(solution.contacts.iter().map(|contact| {
        picture(
            format!("stress-contact-{}", contact.pair).replace("--", "-behind-"),
            format!("Von Mises stress under {}", pair_name(contact.pair)),
            contact_reading(contact, greatest_near(&deformed, &values, contact)),
            Window::about(contact.at_mm, AROUND * contact.half_width_mm),
        )
    }));
    figures
}

fn pair_name(pair: i32) -> &'static str {
    match pair.signum() {
        0 => "the contact of the reference pair",
        1 => "the contact of the pair ahead",
        _ => "the contact of the pair behind",
    }
}

fn contact_reading(contact: &ContactPlace, greatest_mpa: f64) -> String {
    if contact.at_sharp_edge {
        return format!(
            "A sharp tip edge carries load here: the stress is singular at it, and the greatest value at a node, {} MPa, \
             grows with every refinement.",
            figure(greatest_mpa)
        );
    }
    format!(
        "Pinion below, wheel above. The stress is greatest with {} MPa, {} of the greatest pressure of {} MPa; under a line \
         contact of Hertz in plane strain with ν = 0.3 it is 0.558 of it, 0.70 half-widths deep, to which the bending of the \
         teeth adds.",
        figure(greatest_mpa),
        significant(greatest_mpa / contact.peak_pressure_MPa, 3),
        figure(contact.peak_pressure_MPa),
    )
}

/// The greatest value at a node within the picture of a contact.
fn greatest_near(points: &[[f64; 2]], values: &[f64], contact: &ContactPlace) -> f64 {
    let reach_mm = AROUND * contact.half_width_mm;
    let near = |p: &[f64; 2]| (0..2).all(|axis| (p[axis] - contact.at_mm[axis]).abs() <= reach_mm);
    points.iter().zip(values).filter(|(p, _)| near(p)).map(|(_, value)| *value).fold(0.0, f64::max)
}
