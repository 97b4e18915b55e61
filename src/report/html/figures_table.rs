//! The main figures of a run as HTML tables.

use maud::{Markup, html};

use super::number::{change, fixed, percent, significant, to_digits};
use super::reading::capitalised;
use super::table::{Cell, cells, line, list, row, table, whole};
use super::{film_table, law_table, mesh_orders, page, root_stress_table, sliced};
use gearwear_physics::results::error::{ErrorSummary, SevereLimit, WearAtLimit};
use gearwear_physics::results::figures::{FAMILIES, FigureFamily, FigureValues, STATED_ERRORS};
use gearwear_physics::results::run::{GearSummary, PhaseSummary, PhaseWear, Summary};

/// Phases that are shown one by one.
const MOST_PHASES: usize = 60;

/// The figures that a run is asked for, with their errors: wear, load and transmission error, the pair.
pub fn main_figures(s: &Summary) -> Markup {
    let with_errors = |wanted: fn(&FigureValues) -> bool| {
        let families = shown(s, wanted).filter(|(family, ..)| family.in_headline || !family.errors[1].is_empty());
        families.flat_map(|(family, label, values)| {
            let errors = family.both_errors(&s.error.total);
            let error = errors.iter().any(Option::is_some).then(|| {
                let said = errors.map(|error| error.map(|error| format!("± {}", significant(100.0 * error, 2))));
                row(html! { span.error { "its error" } }, "%", said)
            });
            [Some(row(label, family.unit, values)), error].into_iter().flatten()
        })
    };
    let pair = [
        row("Teeth", "", [format!("{}, {}", s.geometry.gears.pinion.teeth, s.geometry.gears.wheel.teeth)]),
        row("Transverse contact ratio", "", [fixed(s.geometry.transverse_contact_ratio, 3)]),
        row("Line load, whole torque", "N/mm", [s.contact.line_load_N_per_mm]),
        row("Hertz pressure at C", "MPa", [s.contact.hertz_peak_pressure_MPa]),
        row("Contact surface", "", [&*s.contact.surface]),
    ];
    page::tables([
        table("Wear", &["pinion", "wheel"], with_errors(|values| matches!(values, FigureValues::Gears(_)))),
        table(
            "Load and transmission error",
            &["new", "worn"],
            with_errors(|values| matches!(values, FigureValues::States(_))),
        ),
        table("The pair", &["value"], pair),
    ])
}

/// All figures of the mesh cycle.
pub fn mesh_cycle(s: &Summary) -> Markup {
    html! { (page::tables([new_and_worn(s)])) (page::note(&pitch_pressure_note(s))) }
}

/// All figures of wear, and the law that makes it.
pub fn wear_and_law(s: &Summary) -> Markup {
    html! { (page::tables([wear(s), law_table::law(s)])) (law_table::note(s)) (phases(s)) }
}

/// Temperatures; nothing where none was asked for.
pub fn temperatures(s: &Summary) -> Markup {
    page::tables([law_table::temperatures(s)])
}

/// Oil, films, friction and losses; nothing without oil.
pub fn films(s: &Summary) -> Markup {
    page::tables([film_table::tables(s)])
}

/// Geometry of the pair and of both gears, stiffness and root stress.
pub fn pair_and_gears(s: &Summary) -> Markup {
    page::tables([pair(s), gears(s), contact(s), root_stress_table::tables(&s.root_stress)])
}

/// Slices, load and wear over the face width; nothing where all sections are alike.
pub fn over_width(s: &Summary) -> Markup {
    let Some(helical) = &s.helical else { return Markup::default() };
    let wear = of_gears(s, true).chain([sliced::tables::asymmetry_of_the_first_mesh(&helical.wear)]);
    page::tables([html! {
        (sliced::tables::slices(helical))
        (table("Load over the face width", &["new", "worn", "change"], of_states(s, true)))
        (table("Wear over the face width", &["pinion", "wheel"], wear))
    }])
}

/// Families on the page whose values are the `wanted`, with heading and values; none of those that the run has no values of.
fn shown(
    s: &Summary,
    wanted: fn(&FigureValues) -> bool,
) -> impl Iterator<Item = (&'static FigureFamily, String, [Option<f64>; 2])> {
    let families = FAMILIES.iter().filter(move |family| family.on_page && wanted(&family.values));
    families
        .map(|family| (family, capitalised(&family.row()), family.both(s)))
        .filter(|(_, _, values)| values.iter().any(Option::is_some))
}

/// Rows of figures of new and worn flanks, of the slices or of the pair.
fn of_states(s: &Summary, of_slices: bool) -> impl Iterator<Item = Markup> {
    let families = shown(s, |values| matches!(values, FigureValues::States(_)));
    // Where both are nought no tip edge carries anything.
    let families =
        families.filter(move |(family, _, values)| family.is_of_slices() == of_slices && *values != [Some(0.0); 2]);
    families.map(|(family, label, [new, worn])| {
        let changed = match (new, worn) {
            (Some(new), Some(worn)) if family.caveat.is_empty() => change(new, worn),
            _ => String::new(),
        };
        row(label, family.unit, cells![new, worn, changed])
    })
}

fn new_and_worn(s: &Summary) -> Markup {
    let mut rows: Vec<Markup> = of_states(s, false).chain(mesh_orders::higher(s)).collect();
    let [new, worn] = over_hertz(s).map(|ratio| fixed(ratio, 3));
    rows.push(row("Pressure at the pitch point over Hertz’s with the whole load", "", cells![new, worn, ""]));
    // What one flank of a contact loses the other does too: what differs is error.
    let balance = [s.wear_balance.new, s.wear_balance.worn];
    let balance = balance.map(|share| share.map(|share| format!("{}\u{202f}%", fixed(100.0 * share, 4))));
    let [new, worn] = balance;
    rows.push(row("Volumes worn off both flanks in one mesh, difference", "", cells![new, worn, ""]));
    table("Mesh cycle", &["new", "worn", "change"], rows)
}

/// Rows of figures of each gear, of the slices or of the pair.
fn of_gears(s: &Summary, of_slices: bool) -> impl Iterator<Item = Markup> {
    let families = shown(s, |values| matches!(values, FigureValues::Gears(_)));
    let families = families.filter(move |(family, ..)| family.is_of_slices() == of_slices);
    families.map(|(family, label, values)| row(label, family.unit, values))
}

fn wear(s: &Summary) -> Markup {
    table("Wear", &["pinion", "wheel"], of_gears(s, false))
}

/// The pressure at C, new and worn, over Hertz's of unmodified involutes under the whole load.
fn over_hertz(s: &Summary) -> [f64; 2] {
    [s.new.pitch_pressure_MPa, s.worn.pitch_pressure_MPa].map(|pressure| pressure / s.contact.hertz_peak_pressure_MPa)
}

/// Why the pressure at C is not Hertz's.
fn pitch_pressure_note(s: &Summary) -> String {
    let [new, worn] = over_hertz(s);
    let of_surface = match &*s.contact.surface {
        "hertz-mean" => Some("the surface takes the mean pressure of the contact, π/4 = 0.785 of the maximum"),
        "winkler" => Some(
            "a Winkler foundation has a parabolic pressure, 3π/8 = 1.178 times Hertz’s at the same half-width and the same pressure at another",
        ),
        _ => None,
    };
    let shared = "at C the load is shared with another pair or spread over slices (the pressure goes with the square root of the load), or a \
                  modification has changed the curvature";
    let mut text = format!(
        "At C the new pair has {} times the pressure of Hertz’s contact of plain involutes under the whole load",
        fixed(new, 3)
    );
    match (of_surface, (new - 1.0).abs() < 0.02) {
        (_, true) => text.push('.'),
        (Some(reason), false) => text.push_str(&format!(": {reason}; where that is not all of it, {shared}.")),
        (None, false) => text.push_str(&format!(": {shared}.")),
    }
    if (worn / new - 1.0).abs() >= 0.02 {
        text.push_str(&format!(
            " Worn it has {} times: wear has changed the curvature of both flanks there.",
            fixed(worn, 3)
        ));
    }
    text
}

fn pair(s: &Summary) -> Markup {
    let g = &s.geometry;
    let one = |label, unit, value| row(label, unit, [fixed(value, 3)]);
    let mut rows = vec![one("Transverse contact ratio", "", g.transverse_contact_ratio)];
    if g.overlap_ratio != 0.0 {
        rows.push(one("Overlap ratio", "", g.overlap_ratio));
    }
    rows.extend([
        one("Working pressure angle, transverse", "°", g.working_pressure_angle_deg),
        one("Base pitch, transverse", "mm", g.base_pitch_mm),
        one("Line of action T1T2", "mm", g.line_of_action_mm),
        one("Backlash on the working circles", "mm", g.backlash_mm),
    ]);
    table("Geometry of the pair", &["value"], rows)
}

fn gears(s: &Summary) -> Markup {
    let gears = &s.geometry.gears;
    let both = |label, value: fn(&GearSummary) -> f64| {
        row(label, "mm", [&gears.pinion, &gears.wheel].map(|gear| fixed(value(gear), 3)))
    };
    let maybe = |label, unit, value: fn(&GearSummary) -> Option<f64>| {
        row(label, unit, [&gears.pinion, &gears.wheel].map(|gear| value(gear).map(|value| fixed(value, 3))))
    };
    table(
        "Geometry of the gears",
        &["pinion", "wheel"],
        [
            row("Teeth", "", [gears.pinion.teeth, gears.wheel.teeth]),
            both("Tip diameter", |g| g.tip_diameter_mm),
            both("Working pitch diameter", |g| g.working_pitch_diameter_mm),
            both("Reference diameter", |g| g.reference_diameter_mm),
            both("Base diameter", |g| g.base_diameter_mm),
            both("Tip form diameter", |g| g.tip_form_diameter_mm),
            both("End of active profile, diameter", |g| g.end_of_active_profile_diameter_mm),
            both("Start of active profile, diameter", |g| g.start_of_active_profile_diameter_mm),
            both("Root form diameter", |g| g.root_form_diameter_mm),
            both("Root diameter", |g| g.root_diameter_mm),
            both("Tooth thickness at the reference circle", |g| g.tooth_thickness_mm),
            both("Tooth thickness at the tip", |g| g.tip_thickness_mm),
            both("Tip clearance", |g| g.tip_clearance_mm),
            row("Undercut", "", [gears.pinion.undercut, gears.wheel.undercut]),
            maybe("Specific sliding at the start of active profile", "", |g| g.specific_sliding_at_root),
            row(
                "Span over teeth, number of teeth",
                "",
                [&gears.pinion, &gears.wheel].map(|gear| gear.span_teeth.map(|teeth| teeth.to_string())),
            ),
            maybe("Span over teeth", "mm", |g| g.span_mm),
            maybe("Diameter of measuring balls or pins", "mm", |g| g.ball_diameter_mm),
            maybe("Dimension over balls or pins", "mm", |g| g.dimension_over_balls_mm),
        ],
    )
}

fn contact(s: &Summary) -> Markup {
    let c = &s.contact;
    let mut rows = vec![
        row("Contact surface", "", [&*c.surface]),
        row("Line load, whole torque", "N/mm", [c.line_load_N_per_mm]),
        row("Hertz half-width at C", "mm", [c.hertz_half_width_mm]),
        row("Hertz pressure at C", "MPa", [c.hertz_peak_pressure_MPa]),
    ];
    if let Some(foundation) = c.foundation_MPa_per_mm {
        rows.push(row("Foundation K/H", "MPa/mm", [foundation]));
    }
    if let Some(k) = &s.stiffness {
        rows.extend([
            row("Tooth stiffness", "", [&*k.model]),
            row("Pair with flattening, at C", "N/(mm·µm)", [k.pair_at_pitch_N_per_mm_um]),
            row("Teeth alone, at C", "N/(mm·µm)", [k.teeth_at_pitch_N_per_mm_um]),
            row("Line load of both stiffnesses", "N/mm", [k.reference_line_load_N_per_mm]),
        ]);
        let remainder = k.split_remainder_at_half_load.map(percent);
        rows.extend(
            remainder.map(|share| {
                row("Deviation of teeth plus contact from the pair’s compliance, at 50 % load", "", [share])
            }),
        );
    }
    if let Some(iso) = &s.stiffness_iso_6336_1 {
        rows.extend([
            row("c′, ISO 6336-1", "N/(mm·µm)", [iso.single_N_per_mm_um]),
            row("c_γα, ISO 6336-1", "N/(mm·µm)", [iso.mesh_alpha_N_per_mm_um]),
            row("c_γβ, ISO 6336-1", "N/(mm·µm)", [iso.mesh_beta_N_per_mm_um]),
        ]);
    }
    table("Contact and stiffness", &["value"], rows)
}

/// Under what each phase ran, and what it wore off; nothing where there is only one.
fn phases(s: &Summary) -> Markup {
    if s.phases.len() < 2 {
        return Markup::default();
    }
    let columns = [
        "phase",
        "hours",
        "pinion revolutions",
        "pinion torque, N·m",
        "speed, 1/min",
        "Hertz pressure at C, MPa",
        "wear coefficient, m²/N",
        "temperature rise, K",
        "added to the maximum wear of the active profile, µm, pinion / wheel",
        "of the tip edge, µm",
        "below the active profile, µm",
        "pinion, volume added, mm³",
    ];
    let phase = |phase: &PhaseSummary| {
        line(cells![
            phase.number,
            phase.hours,
            phase.revolutions,
            phase.pinion_torque_Nm,
            phase.pinion_speed_rpm,
            phase.hertz_peak_pressure_MPa,
            match phase.coefficient_m2_per_N {
                Some(both) => format!("{:e}", to_digits(both, 4)),
                None => {
                    let [pinion, wheel] =
                        [&phase.pinion, &phase.wheel].map(|wear| to_digits(wear.coefficient_m2_per_N, 4));
                    format!("{pinion:e} and {wheel:e}")
                }
            },
            phase.greatest_rise_K,
            both_gears(phase, |wear| wear.greatest_depth_um),
            both_gears(phase, |wear| wear.tip_edge_depth_um),
            both_gears(phase, |wear| wear.below_sap_depth_um),
            significant(phase.pinion.worn_volume_mm3, 3),
        ])
    };
    let more = s.phases.len().saturating_sub(MOST_PHASES);
    html! {
        div.phases { (list("Phases of the operation", columns, s.phases.iter().take(MOST_PHASES).map(phase))) }
        @if more > 0 { (page::note(&format!("{more} more phases are in summary.json."))) }
        (page::note(&format!(
            "New and worn pair, line load, K/H, Hertz pressure and the temperatures of both are under the highest load of any phase, \
             that of phase {}; so that what wear changes can be read from them.",
            s.reference_phase
        )))
    }
}

/// A depth of both gears.
fn both_gears(phase: &PhaseSummary, depth_um: fn(&PhaseWear) -> f64) -> String {
    format!("{} / {}", significant(depth_um(&phase.pinion), 3), significant(depth_um(&phase.wheel), 3))
}

/// The error estimates, each with how it was obtained.
pub fn errors(error: &ErrorSummary) -> Markup {
    let how = &error.how;
    let by_elements = STATED_ERRORS.iter().enumerate().map(|(at, stated)| {
        let how = if at == 0 { &*error.total.how } else { "as above" };
        (format!("Finite elements: {}", stated.title), (stated.of)(&error.total), how)
    });
    let estimates = [
        ("Points and positions", error.discretisation, &*how.discretisation),
        ("Wear step", error.wear_step, &*how.wear_step),
        ("Worn volumes of pinion and wheel, difference", error.volume_balance, &*how.volume_balance),
        ("Abrupt against smoothed transition to severe wear", error.severe_switch, &*how.severe_switch),
    ]
    .map(|(label, estimate, how)| (label.to_owned(), estimate, how));
    let rows = by_elements.chain(estimates).map(|(label, estimate, how)| {
        let estimate = estimate.map_or_else(|| "not estimated".into(), |e| significant(e * 100.0, 2) + "\u{202f}%");
        line([label.into(), estimate.into(), Cell::sentence(how)])
    });
    let caption = "Error of the result: against finite elements, and estimates for the maximum wear";
    html! {
        (whole(Some("errors"), Some(html! { (caption) }), ["".into(), "relative".into(), Cell::sentence("how obtained")], rows))
        @if let Some(limit) = &error.severe_limit { (page::note(&at_other_limits(limit))) }
        @if let Some(cost) = error.companions_cost.filter(|&cost| cost > 0.0) {
            (page::note(&format!("The estimates took {} of the work of the run itself.", percent(cost))))
        }
    }
}

/// What limits of severe wear a tenth lower and higher make of the maximum wear.
fn at_other_limits(limit: &SevereLimit) -> String {
    let of = |gear: fn(&WearAtLimit) -> f64| {
        format!("{} to {} µm", significant(gear(&limit.high), 3), significant(gear(&limit.low), 3))
    };
    format!(
        "With limits of severe wear between 10 % higher and 10 % lower than the scene's the maximum wear is {} of the pinion and {} of the wheel.",
        of(|at| at.pinion.peak_wear_um),
        of(|at| at.wheel.peak_wear_um)
    )
}
