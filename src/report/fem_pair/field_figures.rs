//! The teeth in contact as finite elements, and the von Mises stress in them.

use crate::report::chart::{Chart, Trace, gear_colour};
use crate::report::html::field_plot::{self, WIDTH_OVER_HEIGHT, side_lines, to_scale};
use crate::report::html::number::{count, figure, significant};
use gearwear_bodies::gear::Gear;
use gearwear_fem::field_raster::{self, Bodies, Window, greatest_near};
use gearwear_fem::solid::Element;
use gearwear_physics::results::fem_pair::{ContactPlace, FemPairSummary, PairSolution};

/// Half the height of the picture of a contact, in half-widths.
const AROUND: f64 = 2.0;

/// The elements of the teeth, undeformed.
pub(super) fn mesh(s: &FemPairSummary, solution: &PairSolution) -> Chart {
    let gears = &s.model.gears;
    let reading = |shown: &str| {
        format!(
            "{} elements on {} nodes, at the contact position of {} mm before loading; {shown}. They \
         are part of bodies of {} degrees of freedom (pinion, rigid at {} mm and rotated by the torque) and {} \
         (wheel, fixed at {} mm).",
            count(solution.elements.len() as u64),
            count(solution.points_mm.len() as u64),
            significant(solution.position_mm, 5),
            count(gears.pinion.dofs as u64),
            significant(gears.pinion.clamp_radius_mm, 4),
            count(gears.wheel.dofs as u64),
            significant(gears.wheel.clamp_radius_mm, 4),
        )
    };
    let window = Window::around(&solution.points_mm);
    let (mut all_inner, mut outlines) = (Vec::new(), Vec::new());
    for (gear, material) in Gear::BOTH.into_iter().zip(0..) {
        let own: Vec<Element> = solution.elements.iter().filter(|e| e.material == material).copied().collect();
        let bodies = Bodies { points_mm: &solution.points_mm, elements: &own };
        let own_outline = (gear.name(), gear_colour(gear), 1.4);
        let (inner, outline) = side_lines(bodies, window, ("var(--rule)", 0.6), own_outline);
        all_inner.push(inner.map(Trace::unlisted));
        outlines.push(outline);
    }
    // Of both gears or of neither.
    let inner = all_inner.into_iter().collect::<Option<Vec<Trace>>>();
    let shown = if inner.is_some() {
        "drag over a contact to see them"
    } else {
        "too many to be drawn here; solution.vtu has them"
    };
    let chart = Chart::new("mesh", "Finite elements of the teeth that may touch").wide().reading(reading(shown));
    to_scale(chart.add_all(inner.into_iter().flatten()).add_all(outlines), window)
}

/// The von Mises stress in the teeth, and around each contact, deformed as computed.
pub(super) fn von_mises(solution: &PairSolution) -> Vec<Chart> {
    let deformed = field_raster::deformed(solution.points_mm.iter().copied(), &solution.displacement_mm);
    let bodies = Bodies { points_mm: &deformed, elements: &solution.elements };
    let values: Vec<f64> = solution.stress.iter().map(|stress| stress.von_mises_MPa).collect();
    let picture = |chart: Chart, window: Window| field_plot::von_mises(chart, bodies, &values, window);
    let whole = format!(
        "The teeth at the contact position of {} mm, deformed to scale. The stress is greatest under the contact{}, next at \
         the fillets.",
        significant(solution.position_mm, 5),
        if solution.contacts.len() == 1 { "" } else { "s" },
    );
    let whole = picture(Chart::new("stress", "Von Mises stress").reading(whole), Window::around(&deformed));
    let contacts = solution.contacts.iter().map(|contact| {
        let reach_mm = AROUND * contact.half_width_mm;
        let greatest_mpa = greatest_near(bodies, &values, contact.at_mm, reach_mm);
        let id = format!("stress-contact-{}", contact.pair).replace("--", "-behind-");
        let chart = Chart::new(id, format!("Von Mises stress under {}", pair_name(contact.pair)));
        picture(
            chart.reading(contact_reading(contact, greatest_mpa)),
            Window::about(contact.at_mm, reach_mm, WIDTH_OVER_HEIGHT),
        )
    });
    [whole].into_iter().chain(contacts).collect()
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
        "Pinion below, wheel above. The stress is greatest with {} MPa, {} of the maximum pressure of {} MPa; under a line \
         contact of Hertz in plane strain with ν = 0.3 it is 0.558 of it, 0.70 half-widths deep, to which the bending of the \
         teeth adds.",
        figure(greatest_mpa),
        significant(greatest_mpa / contact.peak_pressure_MPa, 3),
        figure(contact.peak_pressure_MPa),
    )
}
