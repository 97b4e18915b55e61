//! The main figures of a run as HTML tables.

use super::law_table;
use super::number::{change, figure, fixed, percent, significant};
use super::page::escape;
use super::sliced;
use super::table::{Row, row, table};
use crate::results::error::ErrorSummary;
use crate::results::run::{GearSummary, RunRecord, Summary, WearSummary};

/// All tables, in the order of the page.
pub fn tables(record: &RunRecord) -> String {
    let s = &record.summary;
    let sliced = s.helical.as_ref().map_or_else(String::new, sliced::tables::tables);
    let law = law_table::tables(s);
    [new_and_worn(s), wear(s), law, sliced, pair(s), gears(s), contact(s)].concat()
}

fn new_and_worn(s: &Summary) -> String {
    let compare = |label, unit, new: f64, worn: f64| row(label, unit, [figure(new), figure(worn), change(new, worn)]);
    let (new, worn) = (&s.new, &s.worn);
    let (te_new, te_worn) = (&new.transmission_error_um, &worn.transmission_error_um);
    let greatest = compare("Greatest pressure", "MPa", new.peak_pressure_MPa, worn.peak_pressure_MPa);
    let sharp = [new.sharp_edge_pressure_MPa, worn.sharp_edge_pressure_MPa];
    let found = |pressure: Option<f64>| pressure.map_or_else(|| "–".to_owned(), figure);
    let at_sharp_edge = sharp.iter().any(Option::is_some).then(|| {
        row("Found at sharp tip edges, not defined", "MPa", [found(sharp[0]), found(sharp[1]), String::new()])
    });
    let rows: Vec<Row> = [greatest]
        .into_iter()
        .chain(at_sharp_edge)
        .chain([
            compare("Pressure at the pitch point C", "MPa", new.pitch_pressure_MPa, worn.pitch_pressure_MPa),
            compare("Transmission error, peak to peak", "µm", te_new.peak_to_peak, te_worn.peak_to_peak),
            compare("Transmission error, least", "µm", te_new.min, te_worn.min),
            compare("Transmission error, greatest", "µm", te_new.max, te_worn.max),
        ])
        .collect();
    table("Mesh cycle", &["new", "worn", "change"], &rows)
}

fn wear(s: &Summary) -> String {
    let both = |label, unit, value: fn(&WearSummary) -> f64| {
        row(label, unit, [figure(value(&s.pinion)), figure(value(&s.wheel))])
    };
    table(
        "Wear",
        &["pinion", "wheel"],
        &[
            both("Greatest depth of the active profile", "µm", |w| w.peak_wear_um),
            both("Radius of the greatest depth", "mm", |w| w.peak_wear_radius_mm),
            both("Greatest at the tip edge", "µm", |w| w.tip_edge_wear_um),
            both("Greatest below the active profile", "µm", |w| w.below_sap_wear_um),
            both("Greatest over the root", "µm", |w| w.root_wear_um),
            both("At the pitch circle", "µm", |w| w.pitch_wear_um),
            both("Volume, whole gear", "mm³", |w| w.worn_volume_mm3),
            both("Mass, whole gear", "mg", |w| w.worn_mass_mg),
        ],
    )
}

fn pair(s: &Summary) -> String {
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
    table("Geometry of the pair", &["value"], &rows)
}

fn gears(s: &Summary) -> String {
    let gears = &s.geometry.gears;
    let both = |label, value: fn(&GearSummary) -> f64| {
        row(label, "mm", [fixed(value(&gears.pinion), 3), fixed(value(&gears.wheel), 3)])
    };
    let undercut = |gear: &GearSummary| String::from(if gear.undercut { "yes" } else { "no" });
    table(
        "Geometry of the gears",
        &["pinion", "wheel"],
        &[
            row("Teeth", "", [gears.pinion.teeth.to_string(), gears.wheel.teeth.to_string()]),
            both("Tip diameter", |g| g.tip_diameter_mm),
            both("Working pitch diameter", |g| g.working_pitch_diameter_mm),
            both("Reference diameter", |g| g.reference_diameter_mm),
            both("Base diameter", |g| g.base_diameter_mm),
            both("Start of active profile, diameter", |g| g.start_of_active_profile_diameter_mm),
            both("Root form diameter", |g| g.root_form_diameter_mm),
            both("Root diameter", |g| g.root_diameter_mm),
            both("Tooth thickness at the reference circle", |g| g.tooth_thickness_mm),
            both("Tooth thickness at the tip", |g| g.tip_thickness_mm),
            both("Tip clearance", |g| g.tip_clearance_mm),
            row("Undercut", "", [undercut(&gears.pinion), undercut(&gears.wheel)]),
        ],
    )
}

fn contact(s: &Summary) -> String {
    let c = &s.contact;
    let foundation = c.foundation_MPa_per_mm.map_or_else(|| "none".into(), figure);
    let mut rows = vec![
        row("Contact surface", "", [escape(&c.surface)]),
        row("Line load, whole torque", "N/mm", [figure(c.line_load_N_per_mm)]),
        row("Foundation K/H", "MPa/mm", [foundation]),
        row("Hertz half-width at C", "mm", [figure(c.hertz_half_width_mm)]),
        row("Hertz pressure at C", "MPa", [figure(c.hertz_peak_pressure_MPa)]),
    ];
    if let Some(k) = &s.stiffness {
        rows.extend([
            row("Tooth stiffness", "", [escape(&k.model)]),
            row("Pair with flattening, at C", "N/(mm·µm)", [figure(k.pair_at_pitch_N_per_mm_um)]),
            row("Teeth alone, at C", "N/(mm·µm)", [figure(k.teeth_at_pitch_N_per_mm_um)]),
            row("at a line load of", "N/mm", [figure(k.reference_line_load_N_per_mm)]),
        ]);
    }
    if let Some(remainder) = s.stiffness.as_ref().and_then(|k| k.split_remainder_at_half_load) {
        rows.push(row("Left over by the split, at half load", "", [percent(remainder)]));
    }
    table("Contact and stiffness", &["value"], &rows)
}

/// The error estimates, each with how it was obtained.
pub fn errors(error: &ErrorSummary) -> String {
    let as_above = String::from("as above");
    let rows: String = [
        ("Finite elements: pinion’s greatest wear", error.total.peak_wear.pinion, &error.total.how),
        ("Finite elements: wheel’s greatest wear", error.total.peak_wear.wheel, &as_above),
        ("Finite elements: wear of the pinion’s tip edge", error.total.tip_edge_wear.pinion, &as_above),
        ("Finite elements: wear of the wheel’s tip edge", error.total.tip_edge_wear.wheel, &as_above),
        ("Finite elements: pinion’s wear over the flank", error.total.profile.pinion, &as_above),
        ("Finite elements: wheel’s wear over the flank", error.total.profile.wheel, &as_above),
        ("Finite elements: transmission error", error.total.transmission_error_peak_to_peak, &as_above),
        ("Finite elements: pressure between the tip edges", error.total.pressure_between_tips, &as_above),
        ("Points and positions", error.discretisation, &error.how.discretisation),
        ("Wear step", error.wear_step, &error.how.wear_step),
        ("Hard switch to severe wear against a band", error.severe_switch, &error.how.severe_switch),
    ]
    .into_iter()
    .map(|(label, estimate, how)| {
        let estimate = estimate.map_or_else(|| "not estimated".into(), |e| significant(e * 100.0, 2) + "\u{202f}%");
        format!("<tr><th scope=\"row\">{label}</th><td>{estimate}</td><td class=\"how\">{}</td></tr>\n", escape(how))
    })
    .collect();
    let cost = error.companions_cost.map_or_else(String::new, |cost| {
        format!("<p class=\"legend-note\">The estimates took {} of the work of the run itself.</p>\n", percent(cost))
    });
    format!(
        "<table class=\"errors\">\n<caption>Error of the result: against finite elements, and estimates for the greatest wear</caption>\n\
         <thead><tr><td></td><th scope=\"col\">relative</th><th scope=\"col\" class=\"how\">how obtained</th></tr></thead>\n\
         <tbody>\n{rows}</tbody>\n</table>\n{cost}"
    )
}
