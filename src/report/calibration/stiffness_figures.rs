//! Stiffness of the teeth over the path of contact, and by their number.

use super::path_points;
use crate::report::chart::{Chart, Dash, MUTED, PATH, Trace, WORN, colour_between_gears, gear_colour};
use crate::report::html::number::{figure, percent, significant};
use gearwear_bodies::gear::Gear;
use gearwear_bodies::reference::statistics::extent;
use gearwear_physics::calibration::Calibration;
use gearwear_physics::calibration::stiffness_variation::{StiffnessVariation, VariationOf};
use gearwear_physics::calibration::tooth_family::FamilyMember;
use gearwear_physics::calibration::tooth_stiffness::{PairDeflection, ToothDeflection};

pub(super) fn all(calibration: &Calibration) -> Vec<Chart> {
    let over_path = [pair, each_gear, flattening, coupling, course].map(|of| of(calibration));
    let points = path_points(calibration);
    over_path.into_iter().map(|chart| chart.over_path(&points)).chain([family(calibration)]).collect()
}

fn curve(
    chart: Chart,
    calibration: &Calibration,
    name: impl Into<String>,
    style: (&str, f64, Dash),
    value: impl Fn(&PairDeflection) -> f64,
) -> Chart {
    let x = calibration.deflection.iter().map(|at| at.position_mm);
    chart.line(name, x, calibration.deflection.iter().map(value), style, "%{y:.4g}")
}

fn greatest(calibration: &Calibration, value: impl Fn(&PairDeflection) -> f64) -> f64 {
    calibration.deflection.iter().map(value).fold(0.0, f64::max)
}

/// Stiffness of one tooth, flattening included, N/(mm·µm).
fn stiffness(tooth: &ToothDeflection) -> f64 {
    1e-3 / tooth.whole_mm2_per_n
}

fn weber_banaschek(tooth: &ToothDeflection) -> f64 {
    1e-3 / (tooth.weber_banaschek_bending_mm2_per_n + tooth.closed_form_flattening_mm2_per_n)
}

fn pair(calibration: &Calibration) -> Chart {
    let iso = calibration.iso6336_n_per_mm_um;
    let fem = PairDeflection::pair_n_per_mm_um;
    let weber_banaschek = PairDeflection::weber_banaschek_n_per_mm_um;
    let at_c = calibration.deflection_at_points[2].as_ref().map_or_else(String::new, |at| {
        format!(
            "At C finite elements find {} N/(mm·µm), Weber and Banaschek {}, ISO 6336 {} for the whole path. ",
            figure(fem(at)),
            figure(weber_banaschek(at)),
            figure(iso)
        )
    });
    let chart = Chart::new("pair-stiffness", "Stiffness of the tooth pair, flattening included")
        .y("stiffness of the pair, N/(mm·µm)")
        .y_up_to(greatest(calibration, fem).max(iso))
        .reading(format!(
            "{at_c}Both gears carry {} N/mm as Hertz’s ellipse; the curves end where the ellipse would hang over a tip edge.",
            figure(calibration.line_load_n_per_mm)
        ));
    let chart = curve(chart, calibration, "finite elements", (PATH, 2.4, Dash::Solid), fem);
    let chart = curve(chart, calibration, "Weber and Banaschek", (WORN, 2.0, Dash::Dashed), weber_banaschek);
    curve(chart, calibration, "ISO 6336, c'", (MUTED, 1.6, Dash::Dot), |_| iso)
}

/// Draws a quantity of each gear's tooth by finite elements and by a closed form.
fn of_each_gear(
    mut chart: Chart,
    calibration: &Calibration,
    fem: impl Fn(&ToothDeflection) -> f64,
    (closed_name, closed): (&str, impl Fn(&ToothDeflection) -> f64),
) -> Chart {
    let mut top = 0.0_f64;
    for gear in Gear::BOTH {
        let (colour, name) = (gear_colour(gear), gear.name());
        let (fem, closed) = (|at: &PairDeflection| fem(at.tooth(gear)), |at: &PairDeflection| closed(at.tooth(gear)));
        top = top.max(greatest(calibration, fem));
        chart = curve(chart, calibration, format!("{name}, finite elements"), (colour, 2.2, Dash::Solid), fem);
        chart = curve(chart, calibration, format!("{name}, {closed_name}"), (colour, 1.6, Dash::Dashed), closed);
    }
    chart.y_up_to(top)
}

fn each_gear(calibration: &Calibration) -> Chart {
    let chart = Chart::new("gear-stiffness", "Stiffness of each gear’s tooth, flattening included")
        .y("stiffness, N/(mm·µm)")
        .reading(
            "The pinion’s tooth is loaded at its root at A and at its tip at E, the wheel’s the other way round. Weber and \
             Banaschek let the body yield as an elastic half-plane does; finite elements hold it at the clamp radius.",
        );
    of_each_gear(chart, calibration, stiffness, ("Weber and Banaschek", weber_banaschek))
}

fn flattening(calibration: &Calibration) -> Chart {
    let um_per_load = 1e3 * calibration.line_load_n_per_mm;
    let excess = |at: &PairDeflection| {
        at.sum(ToothDeflection::flattening_mm2_per_n) / at.sum(|tooth| tooth.closed_form_flattening_mm2_per_n) - 1.0
    };
    let [least, most] = extent(calibration.deflection.iter().map(excess));
    let chart = Chart::new("flattening", "Flattening: the tooth against the half-plane")
        .y("flattening to the centre line, µm")
        .reading(format!(
            "From the flank to the centre line the teeth yield {} to {} more than half-planes would, both together: a tooth ends \
             on its far side, where a half-plane goes on.",
            percent(least),
            percent(most)
        ));
    let fem = |tooth: &ToothDeflection| um_per_load * tooth.flattening_mm2_per_n();
    let half_plane = |tooth: &ToothDeflection| um_per_load * tooth.closed_form_flattening_mm2_per_n;
    of_each_gear(chart, calibration, fem, ("half-plane", half_plane))
}

fn coupling(calibration: &Calibration) -> Chart {
    type Side = fn(&PairDeflection) -> Option<f64>;
    let sides: [(&str, &str, Side); 2] =
        [("pair ahead", PATH, |at| at.ahead_mm2_per_n), ("pair behind", WORN, |at| at.behind_mm2_per_n)];
    let mut chart = Chart::new("coupling", "Coupling of neighbouring teeth").y("approach there over approach here, %");
    let mut top = 0.0_f64;
    for (name, colour, side) in sides {
        let relative = |at: &PairDeflection| Some(side(at)? / at.sum(|tooth| tooth.whole_mm2_per_n));
        let (x, y): (Vec<f64>, Vec<f64>) =
            calibration.deflection.iter().filter_map(|at| Some((at.position_mm, 100.0 * relative(at)?))).unzip();
        top = y.iter().copied().fold(top, f64::max);
        chart = chart.line(name, x, y, (colour, 2.2, Dash::Solid), "%{y:.2f} %");
    }
    let at = |point: usize, side: Side| {
        let at = calibration.deflection_at_points[point].as_ref()?;
        Some(percent(side(at)? / at.sum(|tooth| tooth.whole_mm2_per_n)))
    };
    let at_b_and_d = match (at(1, |at| at.ahead_mm2_per_n), at(3, |at| at.behind_mm2_per_n)) {
        (Some(b), Some(d)) => format!(
            "With the pair at B the one ahead, at E, moves by {b} of its approach, and with the pair at D the one behind, at \
             A, by {d}. "
        ),
        _ => String::new(),
    };
    chart.y_up_to(top).reading(format!(
        "{at_b_and_d}A load on one pair moves its neighbour as well, through the bodies that both share, and by much the same \
         wherever it stands: the fast model has the mean, {} of E·δ/w, in series with all pairs together.",
        figure(
            calibration.pair_compliance.shared_mm2_per_n
                * 1e3
                * calibration.belongs_to.material.pinion.young_modulus_gpa
        )
    ))
}

fn course(calibration: &Calibration) -> Chart {
    let styles = [
        (PATH, 2.4, Dash::Solid),
        (PATH, 1.6, Dash::Dashed),
        (gear_colour(Gear::Pinion), 2.2, Dash::Solid),
        (gear_colour(Gear::Pinion), 1.6, Dash::Dashed),
    ];
    let mut chart = Chart::new("course", "Stiffness over its mean").y("stiffness over its mean");
    let mut top = 0.0_f64;
    for (course, style) in calibration.courses.iter().zip(styles) {
        let relative = |at: &PairDeflection| course.of.n_per_mm_um(at) / course.mean_n_per_mm_um;
        top = top.max(greatest(calibration, relative));
        chart = curve(chart, calibration, course.of.words(), style, relative);
    }
    let of = |wanted: VariationOf| calibration.courses.iter().find(|course| course.of == wanted);
    let words = |course: &StiffnessVariation| format!("{} {}", course.of.words(), figure(course.max_over_min));
    let ratios: Vec<String> = VariationOf::ALL.into_iter().filter_map(of).map(words).collect();
    let place = of(VariationOf::PairWhole).map_or_else(String::new, |course| {
        format!(" The pair is stiffest at {} of the way from A to E.", percent(course.greatest_at))
    });
    chart.y_up_to(top).reading(format!("Maximum over minimum: {}.{place}", ratios.join("; ")))
}

fn family(calibration: &Calibration) -> Chart {
    let members = &calibration.family;
    let heights = members.first().map_or(&[][..], |member| &member.height);
    let teeth = || members.iter().map(|member| f64::from(member.teeth));
    let mut chart = Chart::new("family", "Deflection by number of teeth, loaded from root to tip");
    let mut top = 0.0_f64;
    for (k, height) in heights.iter().enumerate() {
        let colour = colour_between_gears(*height);
        let name = match *height {
            0.0 => "root".to_owned(),
            1.0 => "tip".to_owned(),
            height => format!("{} of the way", significant(height, 2)),
        };
        let values = |of: fn(&FamilyMember) -> &Vec<f64>| members.iter().map(move |member| of(member)[k]);
        let (fem, closed) = (values(|member| &member.deflection), values(|member| &member.weber_banaschek));
        top = fem.clone().chain(closed.clone()).fold(top, f64::max);
        let fem = Trace::line(&*name, teeth(), fem, (&*colour, 2.2, Dash::Solid)).hover("%{y:.3g}");
        let closed = Trace::line(&*name, teeth(), closed, (&*colour, 1.2, Dash::Dot)).unlisted();
        chart = chart.add(fem.group(&name)).add(closed.group(&name).hover("%{y:.3g}, Weber and Banaschek"));
    }
    let shifted: Vec<String> = members
        .iter()
        .filter(|member| member.profile_shift > 0.0)
        .map(|member| format!("{} (x = {})", member.teeth, significant(member.profile_shift, 3)))
        .collect();
    let shifted = match shifted.is_empty() {
        true => String::new(),
        false => format!(" With the smallest profile shift that avoids undercut: {}.", shifted.join(", ")),
    };
    chart.wide().height(420).x("number of teeth").y("deflection of tooth and body, E·δ/w").y_up_to(top).reading(format!(
        "Full lines by finite elements, dotted by Weber and Banaschek, flattening apart; single gears of the scene’s rack \
         and module, held 2.5 modules below their root.{shifted}"
    ))
}
