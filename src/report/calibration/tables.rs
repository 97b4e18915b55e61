//! Tables of a calibration.

use crate::calibration::Calibration;
use crate::calibration::foundation_fit::FitErrors;
use crate::calibration::tooth_stiffness::{PairDeflection, ToothDeflection};
use crate::contact::settings::MatchCriterion;
use crate::gear::Gear;
use crate::report::html::number::{change, count, figure, fixed, percent, significant};
use crate::report::html::table::{Row, row, table};

/// All of them, in the order of the page.
pub fn tables(calibration: &Calibration) -> String {
    [
        points(calibration),
        parts(calibration),
        fits(calibration),
        convergence(calibration),
        rims(calibration),
        neighbours(calibration),
        courses(calibration),
    ]
    .concat()
}

const NAMES: [&str; 5] = ["A", "B", "C", "D", "E"];

/// The points of the path at which the load keeps clear of the edges.
fn at_points(calibration: &Calibration) -> impl Iterator<Item = (&'static str, &PairDeflection)> {
    NAMES.into_iter().zip(&calibration.deflection_at_points).filter_map(|(name, at)| Some((name, at.as_ref()?)))
}

fn points(calibration: &Calibration) -> String {
    let rows: Vec<Row> = at_points(calibration)
        .map(|(name, at)| {
            let (fem, wb) = (at.pair_n_per_mm_um(), at.weber_banaschek_n_per_mm_um());
            row(format!("at {name}"), "N/(mm·µm)", [figure(fem), figure(wb), change(wb, fem)])
        })
        .chain([row(
            "ISO 6336, c'",
            "N/(mm·µm)",
            [String::new(), figure(calibration.iso6336_n_per_mm_um), String::new()],
        )])
        .collect();
    table("Stiffness of the pair", &["finite elements", "W.–B.", "difference"], &rows)
}

/// Bending and flattening at C.
fn parts(calibration: &Calibration) -> String {
    let Some(at) = calibration.deflection_at_points[2].as_ref() else { return String::new() };
    let um = 1e3 * calibration.line_load_n_per_mm;
    let mut rows = Vec::new();
    for gear in Gear::BOTH {
        let tooth = at.tooth(gear);
        let mut one = |what: &str, fem: f64, closed: f64| {
            let label = format!("{}, {what}", gear.name());
            rows.push(row(label, "µm", [figure(um * fem), figure(um * closed), change(closed, fem)]));
        };
        one("tooth and body", tooth.bending_mm2_per_n, tooth.weber_banaschek_bending_mm2_per_n);
        one("flattening", tooth.flattening_mm2_per_n(), tooth.closed_form_flattening_mm2_per_n);
    }
    let sum = |of: fn(&ToothDeflection) -> f64| um * at.sum(of);
    let closed = sum(|t| t.weber_banaschek_bending_mm2_per_n + t.closed_form_flattening_mm2_per_n);
    let fem = sum(|tooth| tooth.whole_mm2_per_n);
    rows.push(row("together", "µm", [figure(fem), figure(closed), change(closed, fem)]));
    table("Approach at C", &["finite elements", "closed form", "difference"], &rows)
}

fn fits(calibration: &Calibration) -> String {
    let mut rows = Vec::new();
    for criterion in MatchCriterion::ALL {
        let Some(fit) = calibration.foundation_fit.get(&criterion) else { continue };
        let cells = |e: &FitErrors| {
            [e.worst_matched, e.mean_half_width, e.mean_peak_pressure, e.mean_approach]
                .map(|share| fixed(100.0 * share, 2))
        };
        rows.push(row(format!("{}, fitted", criterion.name()), "%", cells(&fit.fitted)));
        rows.push(row(format!("{}, held out", criterion.name()), "%", cells(&fit.held_out)));
    }
    let columns = ["greatest", "half-width", "pressure", "approach"];
    table("Winkler’s bed against finite elements: greatest error of what is matched, mean errors", &columns, &rows)
}

fn convergence(calibration: &Calibration) -> String {
    let finest = calibration.convergence.last().map_or(f64::NAN, |row| row.pair_n_per_mm_um);
    let rows: Vec<Row> = calibration
        .convergence
        .iter()
        .map(|at| {
            let off = fixed(100.0 * (at.pair_n_per_mm_um / finest - 1.0), 3);
            row(
                significant(at.elements_per_half_width, 3),
                "",
                [count(at.dofs as u64), significant(at.pair_n_per_mm_um, 6), off],
            )
        })
        .collect();
    table("Elements in a half-width", &["unknowns", "stiffness at C, N/(mm·µm)", "off the finest, %"], &rows)
}

fn rims(calibration: &Calibration) -> String {
    let rows: Vec<Row> = calibration
        .rim_depth
        .iter()
        .map(|at| {
            row(
                format!("{} modules", significant(at.depth_modules, 2)),
                "",
                [figure(at.clamp_radius_mm.pinion), figure(at.clamp_radius_mm.wheel), figure(at.pair_n_per_mm_um)],
            )
        })
        .collect();
    let columns = ["pinion held at, mm", "wheel, mm", "at C, N/(mm·µm)"];
    table("Depth of the body below the root circle", &columns, &rows)
}

fn neighbours(calibration: &Calibration) -> String {
    let rows: Vec<Row> =
        calibration.neighbours.iter().map(|at| row(at.body.clone(), "", [figure(at.pair_n_per_mm_um)])).collect();
    table("Neighbouring teeth", &["stiffness at C, N/(mm·µm)"], &rows)
}

fn courses(calibration: &Calibration) -> String {
    let rows: Vec<Row> = calibration
        .courses
        .iter()
        .map(|course| {
            row(
                course.of.words(),
                "",
                [figure(course.mean_n_per_mm_um), figure(course.max_over_min), percent(course.greatest_at)],
            )
        })
        .collect();
    let columns = ["mean, N/(mm·µm)", "greatest/least", "greatest at"];
    table("Stiffness over the path, from A (0 %) to E (100 %)", &columns, &rows)
}
