//! K/H by finite elements against Hertz and against its fit.

use super::path_points;
use crate::report::chart::{Chart, Dash, MUTED, PATH, Trace, WORN, colour_between_gears};
use crate::report::html::number::{figure, percent};
use gearwear_physics::calibration::Calibration;
use gearwear_physics::calibration::foundation_fit::FitErrors;
use gearwear_physics::calibration::single_contact::{Purpose, SingleContact};
use gearwear_physics::contact::settings::MatchCriterion;

pub(super) fn all(calibration: &Calibration) -> Vec<Chart> {
    let against_curvature = MatchCriterion::ALL.map(|criterion| against_curvature(calibration, criterion));
    let errors = MatchCriterion::ALL.map(|criterion| errors(calibration, criterion));
    against_curvature.into_iter().chain([against_hertz(calibration)]).chain(errors).collect()
}

fn words(criterion: MatchCriterion) -> &'static str {
    match criterion {
        MatchCriterion::HalfWidth => "half-width",
        MatchCriterion::PeakPressure => "maximum pressure",
        MatchCriterion::Approach => "approach",
    }
}

/// Loads of the contacts, rising.
fn loads(contacts: &[SingleContact]) -> Vec<f64> {
    let mut loads: Vec<f64> = contacts.iter().map(|contact| contact.line_load_n_per_mm).collect();
    loads.sort_by(f64::total_cmp);
    loads.dedup_by(|a, b| (*a - *b).abs() < 1e-9 * *b);
    loads
}

fn is_load(contact: &SingleContact, load: f64) -> bool {
    (contact.line_load_n_per_mm / load - 1.0).abs() < 1e-6
}

/// K/H against the relative radius of curvature, at every fitted load: towards A and towards E apart.
fn against_curvature(calibration: &Calibration, criterion: MatchCriterion) -> Chart {
    let contacts = &calibration.single_contact;
    let away: Vec<&SingleContact> = contacts.iter().filter(|c| c.purpose != Purpose::AtEdge).collect();
    let fitted = loads(&contacts.iter().copied().filter(|c| c.purpose == Purpose::Fitted).collect::<Vec<_>>());
    let count = fitted.len().max(2) - 1;
    // R is greatest in the middle of the line of action; it is met once on the way there and once beyond.
    let top_mm = away.iter().fold((0.0, 0.0), |best: (f64, f64), c| {
        if c.relative_radius_mm > best.0 { (c.relative_radius_mm, c.position_mm) } else { best }
    });
    let at_c = calibration.foundation.get(&criterion).map_or_else(String::new, |curve| {
        let c_mm = calibration.path_points_mm[2];
        format!(
            "At C under {} N/mm it is {} MPa/mm. ",
            figure(calibration.line_load_n_per_mm),
            figure(curve.at_mpa_per_mm(c_mm, calibration.line_load_n_per_mm))
        )
    });
    let mut chart = Chart::new(
        format!("foundation-{}", criterion.name()),
        format!("K/H with the {} of finite elements", words(criterion)),
    )
    .wide()
    .height(420)
    .x("relative radius of curvature R, mm")
    .x_format(".3f")
    .y("K/H, MPa/mm")
    .reading(format!(
        "{at_c}Points by finite elements, dashed lines Hertz in closed form with the same load. Positions where a tip edge \
         carries pressure are left out."
    ));
    for (k, &load) in fitted.iter().enumerate() {
        let colour = colour_between_gears(k as f64 / count as f64);
        let group = format!("{} N/mm", figure(load));
        let own = || away.iter().filter(|contact| is_load(contact, load));
        // Along the path: the depth of the closed form is another towards A than towards E.
        let (x, y) = (own().map(|c| c.relative_radius_mm), own().map(|c| c.hertz_mpa_per_mm(criterion)));
        let hertz = Trace::line(format!("Hertz, {group}"), x, y, (&*colour, 1.4, Dash::Dashed)).group(&group);
        chart = chart.add(hertz.listed(k == 0).hover("%{y:.4g} MPa/mm, Hertz"));
        for (side, end, symbol) in [(false, "A", "circle"), (true, "E", "diamond-open")] {
            let own = || own().filter(|contact| (contact.position_mm > top_mm.1) == side);
            let (x, y) = (own().map(|c| c.relative_radius_mm), own().map(|c| c.mpa_per_mm(criterion)));
            let points = Trace::points(format!("{group}, towards {end}"), x, y, (&colour, symbol, 6));
            chart = chart.add(points.group(&group).hover("%{y:.4g} MPa/mm"));
        }
    }
    chart
}

/// K/H of finite elements over that of Hertz along the path, under the scene's load.
fn against_hertz(calibration: &Calibration) -> Chart {
    let load = calibration.line_load_n_per_mm;
    let own = || calibration.single_contact.iter().filter(|c| c.purpose != Purpose::AtEdge && is_load(c, load));
    let ratios = MatchCriterion::ALL.into_iter().zip([PATH, WORN, MUTED]).map(|(criterion, colour)| {
        let ratio = own().map(|c| c.mpa_per_mm(criterion) / c.hertz_mpa_per_mm(criterion));
        let x = own().map(|c| c.position_mm);
        Trace::line(words(criterion), x, ratio, (colour, 2.2, Dash::Solid)).hover("%{y:.4f}")
    });
    Chart::new("foundation-half-space", "The half-space error of Hertz")
        .y("K/H, finite elements over Hertz")
        .add_all(ratios)
        .over_path(&path_points(calibration))
        .reading(format!(
            "Under {} N/mm, the pair alone in contact. Half-width and pressure are Hertz’s to within a per cent or so up to the \
             tip edges; the approach is not, as the tooth is no half-plane down to its centre line.",
            figure(load)
        ))
}

/// Error of the fitted foundation in the quantity it was fitted on.
fn errors(calibration: &Calibration, criterion: MatchCriterion) -> Chart {
    let fit = calibration.foundation_fit.get(&criterion);
    let reading = fit.map_or_else(String::new, |fit| {
        let FitErrors { worst_matched, mean_half_width, mean_peak_pressure, mean_approach, .. } = fit.held_out;
        let others: Vec<String> = [
            (MatchCriterion::HalfWidth, mean_half_width),
            (MatchCriterion::PeakPressure, mean_peak_pressure),
            (MatchCriterion::Approach, mean_approach),
        ]
        .into_iter()
        .filter(|(other, _)| *other != criterion)
        .map(|(other, mean)| format!("its {} is {} off", words(other), signed(mean)))
        .collect();
        format!(
            "Where it was held out, a Winkler foundation with this K/H has the {} of finite elements within {}; {} on average.",
            words(criterion),
            percent(worst_matched),
            others.join(" and ")
        )
    });
    let kinds = [("fitted", true, PATH, "circle"), ("held out", false, WORN, "diamond-open")];
    let points = kinds.map(|(name, fitted, colour, symbol)| {
        let rows = || fit.into_iter().flat_map(|fit| &fit.rows).filter(|row| row.fitted == fitted);
        let (x, y) = (rows().map(|row| row.position_mm), rows().map(|row| 100.0 * row.matched_error(criterion)));
        let points = Trace::points(name, x, y, (colour, symbol, 6));
        let loads = rows().map(|row| format!("{} N/mm", figure(row.line_load_n_per_mm)));
        points.texts(loads.collect()).hover("%{y:.3f} %, %{text}")
    });
    Chart::new(format!("fit-{}", criterion.name()), format!("Error of the fit on the {}", words(criterion)))
        .y(&format!("error of the {}, %", words(criterion)))
        .add_all(points)
        .over_path(&path_points(calibration))
        .reading(reading)
}

fn signed(share: f64) -> String {
    let sign = if share > 0.0 { "+" } else { "" };
    format!("{sign}{}", percent(share))
}
