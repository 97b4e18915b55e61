//! K/H by finite elements against Hertz and against its fit.

use crate::report::chart::{DashType, Marker, MarkerSymbol, Mode, Plot, Trace};

use super::path_points;
use crate::calibration::Calibration;
use crate::calibration::foundation_fit::{FitErrors, FitRow};
use crate::calibration::single_contact::{Purpose, SingleContact};
use crate::contact::settings::MatchCriterion;
use crate::report::html::number::{figure, percent, plotted};
use crate::report::html::theme::{Figure, MUTED, PATH, WORN, axis, curve, layout, line, mark_path_points, padded};

/// The figures, in the order of the page.
pub fn all(calibration: &Calibration) -> Vec<Figure> {
    let mut figures: Vec<Figure> =
        MatchCriterion::ALL.into_iter().map(|criterion| against_curvature(calibration, criterion)).collect();
    figures.push(against_hertz(calibration));
    figures.extend(MatchCriterion::ALL.into_iter().map(|criterion| errors(calibration, criterion)));
    figures
}

fn words(criterion: MatchCriterion) -> &'static str {
    match criterion {
        MatchCriterion::HalfWidth => "half-width",
        MatchCriterion::PeakPressure => "peak pressure",
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
fn against_curvature(calibration: &Calibration, criterion: MatchCriterion) -> Figure {
    let mut plot = Plot::new();
    let contacts = &calibration.single_contact;
    let away: Vec<&SingleContact> = contacts.iter().filter(|c| c.purpose != Purpose::AtEdge).collect();
    let fitted = loads(&contacts.iter().copied().filter(|c| c.purpose == Purpose::Fitted).collect::<Vec<_>>());
    let count = fitted.len().max(2) - 1;
    // R is greatest in the middle of the line of action; it is met once on the way there and once beyond.
    let top_mm = away.iter().fold((0.0, 0.0), |best: (f64, f64), c| {
        if c.relative_radius_mm > best.0 { (c.relative_radius_mm, c.position_mm) } else { best }
    });
    for (k, &load) in fitted.iter().enumerate() {
        let colour = format!("mix(--pinion,--wheel,{:.3})", k as f64 / count as f64);
        let own = || away.iter().filter(|contact| is_load(contact, load));
        let group = format!("{} N/mm", figure(load));
        // Along the path: the depth of the closed form is another towards A than towards E.
        let hertz = || own().map(|c| (c.relative_radius_mm, c.hertz_mpa_per_mm(criterion)));
        plot.add_trace(
            curve(
                &format!("Hertz, {group}"),
                hertz().map(|point| point.0),
                hertz().map(|point| point.1),
                line(colour.clone(), 1.4, DashType::Dash),
            )
            .legend_group(&group)
            .show_legend(k == 0)
            .hover_template("%{y:.4g} MPa/mm, Hertz"),
        );
        for (side, symbol) in [(false, MarkerSymbol::Circle), (true, MarkerSymbol::DiamondOpen)] {
            let points = || own().filter(|contact| (contact.position_mm > top_mm.1) == side);
            plot.add_trace(
                Trace::scatter(
                    points().map(|c| plotted(c.relative_radius_mm)).collect(),
                    points().map(|c| plotted(c.mpa_per_mm(criterion))).collect(),
                )
                .name(format!("{group}, towards {}", if side { "E" } else { "A" }))
                .mode(Mode::Markers)
                .marker(Marker::new().symbol(symbol).size(6).color(colour.clone()))
                .legend_group(&group)
                .hover_template("%{y:.4g} MPa/mm"),
            );
        }
    }
    let x = axis("relative radius of curvature R, mm").hover_format(".3f");
    plot.set_layout(layout(420).show_legend(true).x_axis(x).y_axis(axis("K/H, MPa/mm")));
    let at_c = calibration.foundation.get(&criterion).map_or_else(String::new, |curve| {
        let c_mm = calibration.path_points_mm[2];
        format!(
            "At C under {} N/mm it is {} MPa/mm. ",
            figure(calibration.line_load_n_per_mm),
            figure(curve.at_mpa_per_mm(c_mm, calibration.line_load_n_per_mm))
        )
    });
    Figure {
        id: format!("foundation-{}", criterion.name()),
        title: format!("K/H with the {} of finite elements", words(criterion)),
        reading: format!(
            "{at_c}Points by finite elements, dashed lines Hertz in closed form with the same load. Positions where a tip edge \
             carries pressure are left out."
        ),
        plot,
        wide: true,
    }
}

/// K/H of finite elements over that of Hertz along the path, under the scene's load.
fn against_hertz(calibration: &Calibration) -> Figure {
    let mut plot = Plot::new();
    for (criterion, colour) in MatchCriterion::ALL.into_iter().zip([PATH, WORN, MUTED]) {
        let own = || {
            calibration
                .single_contact
                .iter()
                .filter(|c| c.purpose != Purpose::AtEdge && is_load(c, calibration.line_load_n_per_mm))
        };
        plot.add_trace(
            curve(
                words(criterion),
                own().map(|c| c.position_mm),
                own().map(|c| c.mpa_per_mm(criterion) / c.hertz_mpa_per_mm(criterion)),
                line(colour, 2.2, DashType::Solid),
            )
            .hover_template("%{y:.4f}"),
        );
    }
    let points = path_points(calibration);
    let x = axis("contact position, mm").range(padded(points.A, points.E)).hover_format(".3f");
    plot.set_layout(mark_path_points(
        layout(380).show_legend(true).x_axis(x).y_axis(axis("K/H, finite elements over Hertz")),
        &points,
    ));
    Figure {
        id: "foundation-half-space".into(),
        title: "The half-space error of Hertz".into(),
        reading: format!(
            "Under {} N/mm, the pair alone in contact. Half-width and pressure are Hertz’s to within a per cent or so up to the \
             tip edges; the approach is not, as the tooth is no half-plane down to its centre line.",
            figure(calibration.line_load_n_per_mm)
        ),
        plot,
        wide: false,
    }
}

/// Error of the fitted bed in the quantity it was fitted on.
fn errors(calibration: &Calibration, criterion: MatchCriterion) -> Figure {
    let mut plot = Plot::new();
    let fit = calibration.foundation_fit.get(&criterion);
    for (name, fitted, colour, symbol) in
        [("fitted", true, PATH, MarkerSymbol::Circle), ("held out", false, WORN, MarkerSymbol::DiamondOpen)]
    {
        let rows = || fit.into_iter().flat_map(|fit| &fit.rows).filter(|row| row.fitted == fitted);
        plot.add_trace(
            Trace::scatter(
                rows().map(|row| plotted(row.position_mm)).collect(),
                rows().map(|row| plotted(100.0 * row.matched_error(criterion))).collect(),
            )
            .name(name)
            .mode(Mode::Markers)
            .marker(Marker::new().symbol(symbol).size(6).color(colour))
            .text_array(rows().map(load).collect::<Vec<_>>())
            .hover_template("%{y:.3f} %, %{text}"),
        );
    }
    let points = path_points(calibration);
    let x = axis("contact position, mm").range(padded(points.A, points.E)).hover_format(".3f");
    let y = axis(&format!("error of the {}, %", words(criterion)));
    plot.set_layout(mark_path_points(layout(380).show_legend(true).x_axis(x).y_axis(y), &points));
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
            "Where it was held out, a Winkler bed with this K/H has the {} of finite elements within {}; {} on average.",
            words(criterion),
            percent(worst_matched),
            others.join(" and ")
        )
    });
    Figure {
        id: format!("fit-{}", criterion.name()),
        title: format!("Error of the fit on the {}", words(criterion)),
        reading,
        plot,
        wide: false,
    }
}

fn load(row: &FitRow) -> String {
    format!("{} N/mm", figure(row.line_load_n_per_mm))
}

fn signed(share: f64) -> String {
    let sign = if share > 0.0 { "+" } else { "" };
    format!("{sign}{}", percent(share))
}
