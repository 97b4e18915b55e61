//! Tables of a calibration.

use maud::Markup;

use crate::report::html::number::{change, fixed, percent, significant};
use crate::report::html::table::{cells, row, table};
use gearwear_bodies::gear::Gear;
use gearwear_physics::calibration::Calibration;
use gearwear_physics::calibration::foundation_fit::FitErrors;
use gearwear_physics::calibration::tooth_stiffness::{PairDeflection, ToothDeflection};
use gearwear_physics::contact::settings::MatchCriterion;

pub(super) fn tables(calibration: &Calibration) -> impl Iterator<Item = Markup> {
    [points, parts, fits, slices, convergence, rims, neighbours, courses].into_iter().map(|of| of(calibration))
}

const NAMES: [&str; 5] = ["A", "B", "C", "D", "E"];

/// The points of the path at which the load keeps clear of the edges.
fn at_points(calibration: &Calibration) -> impl Iterator<Item = (&'static str, &PairDeflection)> {
    NAMES.into_iter().zip(&calibration.deflection_at_points).filter_map(|(name, at)| Some((name, at.as_ref()?)))
}

fn points(calibration: &Calibration) -> Markup {
    const UNIT: &str = "N/(mm·µm)";
    let rows = at_points(calibration).map(|(name, at)| {
        let (fem, wb) = (at.pair_n_per_mm_um(), at.weber_banaschek_n_per_mm_um());
        row(format!("at {name}"), UNIT, cells![fem, wb, change(wb, fem)])
    });
    let iso = row("ISO 6336, c'", UNIT, cells!["", calibration.iso6336_n_per_mm_um, ""]);
    table("Stiffness of the pair", &["finite elements", "W.–B.", "difference"], rows.chain([iso]))
}

fn parts(calibration: &Calibration) -> Markup {
    let Some(at) = calibration.deflection_at_points[2].as_ref() else { return Markup::default() };
    let um = 1e3 * calibration.line_load_n_per_mm;
    let mut rows = Vec::new();
    for gear in Gear::BOTH {
        let tooth = at.tooth(gear);
        let mut one = |what: &str, fem: f64, closed: f64| {
            let label = format!("{}, {what}", gear.name());
            rows.push(row(label, "µm", cells![um * fem, um * closed, change(closed, fem)]));
        };
        one("tooth and body", tooth.bending_mm2_per_n, tooth.weber_banaschek_bending_mm2_per_n);
        one("flattening", tooth.flattening_mm2_per_n(), tooth.closed_form_flattening_mm2_per_n);
    }
    let sum = |of: fn(&ToothDeflection) -> f64| um * at.sum(of);
    let closed = sum(|t| t.weber_banaschek_bending_mm2_per_n + t.closed_form_flattening_mm2_per_n);
    let fem = sum(|tooth| tooth.whole_mm2_per_n);
    rows.push(row("together", "µm", cells![fem, closed, change(closed, fem)]));
    table("Approach at C", &["finite elements", "closed form", "difference"], rows)
}

fn fits(calibration: &Calibration) -> Markup {
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
    let columns = ["maximum", "half-width", "pressure", "approach"];
    table("Winkler foundation against finite elements: maximum error of what is matched, mean errors", &columns, rows)
}

/// What the slices have from the teeth in space; nothing where sections are alike over the face width.
fn slices(calibration: &Calibration) -> Markup {
    let Some(fit) = calibration.slices else { return Markup::default() };
    let of = fit.compliance;
    let mut rows = vec![
        row("Compliance of the teeth over that of the section", "", [significant(of.teeth, 4)]),
        row("Added compliance at the end face z = 0", "%", [fixed(100.0 * of.ends[0], 1)]),
        row("Added compliance at the end face z = b", "%", [fixed(100.0 * of.ends[1], 1)]),
        row("Decay length of that", "mm", [significant(of.end_length_mm, 3)]),
        row("Decay length along the tooth, twist", "mm", [significant(of.reach.twist_mm2.sqrt(), 3)]),
        row("Decay length along the tooth, bending", "mm", [significant(of.reach.bending_mm4.sqrt().sqrt(), 3)]),
        row("Compliance of the bodies over that of the section", "", [significant(of.bodies, 4)]),
    ];
    if let Some(ends) = of.end_twist {
        for (face, part) in ["0", "b"].iter().zip(ends) {
            let name = format!("Resistance to twisting within, over that at the end face z = {face}");
            rows.push(row(name, "", [significant(1.0 + part, 3)]));
        }
        let length_mm = of.end_twist_length_mm.unwrap_or(of.end_length_mm);
        rows.push(row("Decay length of that", "mm", [significant(length_mm, 3)]));
    }
    rows.push(row("Residual, root mean square", "%", [fixed(100.0 * fit.residual, 1)]));
    table("Slices, fitted to three-dimensional finite elements", &["value"], rows)
}

fn convergence(calibration: &Calibration) -> Markup {
    let finest = calibration.convergence.last().map_or(f64::NAN, |row| row.pair_n_per_mm_um);
    let rows = calibration.convergence.iter().map(|at| {
        let off = fixed(100.0 * (at.pair_n_per_mm_um / finest - 1.0), 3);
        let cells = cells![at.dofs, significant(at.pair_n_per_mm_um, 6), off];
        row(significant(at.elements_per_half_width, 3), "", cells)
    });
    table("Elements per half-width", &["unknowns", "stiffness at C, N/(mm·µm)", "difference from the finest, %"], rows)
}

fn rims(calibration: &Calibration) -> Markup {
    let rows = calibration.rim_depth.iter().map(|at| {
        let depth = format!("{} modules", significant(at.depth_modules, 2));
        row(depth, "", [at.clamp_radius_mm.pinion, at.clamp_radius_mm.wheel, at.pair_n_per_mm_um])
    });
    let columns = ["pinion held at, mm", "wheel, mm", "at C, N/(mm·µm)"];
    table("Depth of the body below the root circle", &columns, rows)
}

fn neighbours(calibration: &Calibration) -> Markup {
    let rows = calibration.neighbours.iter().map(|at| row(&*at.body, "", [at.pair_n_per_mm_um]));
    table("Neighbouring teeth", &["stiffness at C, N/(mm·µm)"], rows)
}

fn courses(calibration: &Calibration) -> Markup {
    let rows = calibration.courses.iter().map(|course| {
        let cells = cells![course.mean_n_per_mm_um, course.max_over_min, percent(course.greatest_at)];
        row(course.of.words(), "", cells)
    });
    let columns = ["mean, N/(mm·µm)", "maximum/minimum", "maximum at"];
    table("Stiffness over the path, from A (0 %) to E (100 %)", &columns, rows)
}
