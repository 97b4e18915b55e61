//! The main figures of finite-element contact of a gear pair as HTML tables.

use maud::{Markup, html};

use crate::report::html::number::{change, count, fixed, percent, significant};
use crate::report::html::page;
use crate::report::html::root_stress_table;
use crate::report::html::table::{row, table};
use gearwear_bodies::gear::PerGear;
use gearwear_physics::results::fem_pair::{
    FemPairSummary, FullModelSummary, GearModelSummary, PathPointsSummary, RootSummary,
};
use gearwear_physics::results::run::PathPoints;

pub(super) fn tables(s: &FemPairSummary) -> Markup {
    let points = s.points.as_ref().map_or_else(Markup::default, points);
    page::tables([cycle(s), roots(s), points, model(s), gears(s)])
}

fn cycle(s: &FemPairSummary) -> Markup {
    let (new, te) = (&s.new, &s.new.transmission_error_um);
    let one = |label, unit, value: f64| row(label, unit, [value]);
    let mut rows: Vec<Markup> = Vec::new();
    rows.extend(new.peak_pressure_MPa.map(|p| one("Maximum pressure away from sharp edges", "MPa", p)));
    rows.extend(
        new.peak_pressure_pair_position_mm
            .filter(|_| s.position_mm.is_none())
            .map(|at| one("its tooth pair at", "mm", at)),
    );
    rows.extend(new.peak_pressure_pinion_radius_mm.map(|r| one("at radius on the pinion", "mm", r)));
    rows.extend(new.sharp_edge_pressure_MPa.map(|p| one("At a sharp tip edge, singular", "MPa", p)));
    if let (Some(found), Some(hertz)) = (new.pitch_pressure_MPa, new.pitch_hertz_pressure_MPa) {
        rows.push(one("Pressure at the pitch point C", "MPa", found));
        rows.push(one("Hertz pressure at C, same load", "MPa", hertz));
        rows.push(row("Finite elements against Hertz", "", [change(hertz, found)]));
    }
    if s.position_mm.is_some() {
        rows.push(one("Transmission error", "µm", te.max));
    } else {
        rows.extend([
            one("Transmission error, minimum", "µm", te.min),
            one("Transmission error, maximum", "µm", te.max),
            one("Transmission error, peak to peak", "µm", te.peak_to_peak),
        ]);
    }
    rows.push(one("Line load, whole torque", "N/mm", s.contact.line_load_N_per_mm));
    table(if s.position_mm.is_some() { "Contact" } else { "Mesh cycle" }, &["value"], rows)
}

fn roots(s: &FemPairSummary) -> Markup {
    let PerGear { pinion: Some(pinion), wheel: Some(wheel) } = &s.root else { return Markup::default() };
    let both = |label, unit, value: fn(&RootSummary) -> f64| row(label, unit, [pinion, wheel].map(value));
    let found = [
        both("Maximum, below the working flank", "MPa", |r| r.tension_MPa),
        both("at position", "mm", |r| r.tension_position_mm),
        both("Minimum, on the other side", "MPa", |r| r.compression_MPa),
        both("at position", "mm", |r| r.compression_position_mm),
    ];
    let by_standards = root_stress_table::stresses(&s.root_stress);
    table("Stress at the fillets of the reference pair", &["pinion", "wheel"], found.into_iter().chain(by_standards))
}

fn points(points: &PathPointsSummary) -> Markup {
    let five = |label, unit, values: &PathPoints| {
        let PathPoints { A, B, C, D, E } = *values;
        row(label, unit, [A, B, C, D, E])
    };
    table(
        "The reference pair at A to E",
        &["A", "B", "C", "D", "E"],
        [
            five("Share of the load", "", &points.load_share),
            five("Maximum pressure", "MPa", &points.peak_pressure_MPa),
            five("Hertz, same load", "MPa", &points.hertz_pressure_MPa),
            five("Transmission error", "µm", &points.transmission_error_um),
        ],
    )
}

fn model(s: &FemPairSummary) -> Markup {
    let m = &s.model;
    let body = match (m.sector_teeth, &m.sector_sides) {
        (Some(teeth), Some(sides)) => format!("sector of {teeth} teeth, sides {}", sides),
        _ => "whole ring".to_owned(),
    };
    table(
        "Model",
        &["value"],
        [
            row("Body", "", [body]),
            row("Analysis", "", ["plane strain"]),
            row("Elements along Hertz’s half-width", "", [significant(m.elements_per_half_width, 3)]),
            row("Degrees of freedom, supports included", "", [s.dofs]),
            row("Elements", "", [s.elements]),
        ],
    )
}

fn gears(s: &FemPairSummary) -> Markup {
    let gears = &s.model.gears;
    let both = |label, unit, value: &dyn Fn(&GearModelSummary) -> String| {
        row(label, unit, [value(&gears.pinion), value(&gears.wheel)])
    };
    table(
        "Finite elements of the gears",
        &["pinion", "wheel"],
        [
            both("Fixed (wheel) or rotated (pinion) at radius", "mm", &|g| fixed(g.clamp_radius_mm, 3)),
            both("Degrees of freedom", "", &|g| count(g.dofs as u64)),
            both("Elements", "", &|g| count(g.elements as u64)),
            both("Teeth with a resolved flank", "", &|g| g.resolved_teeth.to_string()),
            both("Nodes of a flank that may carry load", "", &|g| count(g.candidates as u64)),
            both("Smallest angle of an element", "°", &|g| fixed(g.quality.least_angle_deg.value, 1)),
            both("Minimum Jacobian ratio", "", &|g| fixed(g.quality.jacobian_ratio.value, 3)),
            both("Maximum aspect ratio", "", &|g| fixed(g.quality.aspect_ratio.value, 2)),
        ],
    )
}

/// How well equilibrium was met, and the whole model where it was solved.
pub(super) fn checks(s: &FemPairSummary) -> Markup {
    let c = &s.checks;
    let mut rows = vec![
        row("|T2/T1| against z2/z1, worst", "", [percent(c.torque_ratio_error)]),
        row("at position", "mm", [c.torque_ratio_error_position_mm]),
    ];
    rows.extend(
        c.torque_ratio_error_on_line
            .map(|error| row("the same with all contact on the line of action", "", [percent(error)])),
    );
    rows.extend([
        row("Load not balanced, relative", "", [significant(c.load_imbalance, 2)]),
        row("Largest penetration", "µm", [significant(c.max_penetration_um, 2)]),
        row("Active-set iterations per position, mean", "", [significant(c.iterations_per_position, 3)]),
        row("Active-set iterations per position, maximum", "", [c.most_iterations]),
        row("Active-set cycles broken", "", [c.cycles_broken]),
    ]);
    rows.extend(s.wall_per_position_s.map(|wall_s| row("Time per position", "ms", [significant(1e3 * wall_s, 3)])));
    let note = page::note(&format!("{}.", c.torque_ratio));
    html! { (table("Checks", &["value"], rows)) (note) @for at in s.full.iter().flatten() { (full(at)) } }
}

fn full(at: &FullModelSummary) -> Markup {
    let rows = [
        row("Degrees of freedom", "", [at.dofs]),
        row("Transmission error", "µm", [at.transmission_error_um]),
        row("Transmission error, difference, relative", "", [significant(at.transmission_error_difference, 2)]),
        row("Line load of a pair, difference, relative", "", [significant(at.line_load_difference, 2)]),
        row("Maximum pressure of a pair, difference, relative", "", [significant(at.peak_pressure_difference, 2)]),
        row("Time", "s", [fixed(at.wall_s, 2)]),
    ];
    let caption = format!("Whole model without condensation, at {} mm", significant(at.position_mm, 5));
    table(caption, &["value"], rows)
}
