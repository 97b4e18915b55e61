//! Stiffness of the teeth over the path of contact, and by their number.

use crate::report::chart::{DashType, Layout, Plot};

use super::path_points;
use crate::calibration::Calibration;
use crate::calibration::stiffness_variation::{StiffnessVariation, VariationOf};
use crate::calibration::tooth_stiffness::{PairDeflection, ToothDeflection};
use crate::gear::Gear;
use crate::report::html::number::{figure, percent, significant};
use crate::report::html::theme::{
    Figure, MUTED, PATH, WORN, axis, curve, from_zero, gear_colour, layout, line, mark_path_points, padded,
};

/// The figures, in the order of the page.
pub fn all(calibration: &Calibration) -> Vec<Figure> {
    vec![
        pair(calibration),
        each_gear(calibration),
        flattening(calibration),
        coupling(calibration),
        course(calibration),
        family(calibration),
    ]
}

fn positions(calibration: &Calibration) -> impl Iterator<Item = f64> + '_ {
    calibration.deflection.iter().map(|at| at.position_mm)
}

fn over_the_path(calibration: &Calibration, y_name: &str, greatest: f64) -> Layout {
    let points = path_points(calibration);
    let x = axis("contact position, mm").range(padded(points.A, points.E)).hover_format(".3f");
    let y = axis(y_name).range(from_zero(greatest).to_vec());
    mark_path_points(layout(380).show_legend(true).x_axis(x).y_axis(y), &points)
}

/// Adds a curve over the path.
fn add(
    plot: &mut Plot,
    calibration: &Calibration,
    name: &str,
    style: (&str, f64, DashType),
    value: impl Fn(&PairDeflection) -> f64,
) {
    let y = calibration.deflection.iter().map(value);
    let (colour, width, dash) = style;
    let trace = curve(name, positions(calibration), y, line(colour.to_owned(), width, dash));
    plot.add_trace(trace.hover_template("%{y:.4g}"));
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

fn pair(calibration: &Calibration) -> Figure {
    let mut plot = Plot::new();
    let iso = calibration.iso6336_n_per_mm_um;
    add(&mut plot, calibration, "finite elements", (PATH, 2.4, DashType::Solid), PairDeflection::pair_n_per_mm_um);
    add(&mut plot, calibration, "Weber and Banaschek", (WORN, 2.0, DashType::Dash), |at| {
        at.weber_banaschek_n_per_mm_um()
    });
    add(&mut plot, calibration, "ISO 6336, c'", (MUTED, 1.6, DashType::Dot), |_| iso);
    let top = greatest(calibration, PairDeflection::pair_n_per_mm_um);
    plot.set_layout(over_the_path(calibration, "stiffness of the pair, N/(mm·µm)", top.max(iso)));
    let at_c = calibration.deflection_at_points[2].as_ref().map_or_else(String::new, |at| {
        format!(
            "At C finite elements find {} N/(mm·µm), Weber and Banaschek {}, ISO 6336 {} for the whole path. ",
            figure(at.pair_n_per_mm_um()),
            figure(at.weber_banaschek_n_per_mm_um()),
            figure(iso)
        )
    });
    Figure {
        id: "pair-stiffness".into(),
        title: "Stiffness of the tooth pair, flattening included".into(),
        reading: format!(
            "{at_c}Both gears carry {} N/mm as Hertz’s ellipse; the curves end where the ellipse would hang over a tip edge.",
            figure(calibration.line_load_n_per_mm)
        ),
        plot,
        wide: false,
    }
}

fn each_gear(calibration: &Calibration) -> Figure {
    let mut plot = Plot::new();
    let mut top = 0.0_f64;
    for gear in Gear::BOTH {
        let colour = gear_colour(gear);
        let name = gear.name();
        add(&mut plot, calibration, &format!("{name}, finite elements"), (colour, 2.2, DashType::Solid), |at| {
            stiffness(at.tooth(gear))
        });
        add(&mut plot, calibration, &format!("{name}, Weber and Banaschek"), (colour, 1.6, DashType::Dash), |at| {
            weber_banaschek(at.tooth(gear))
        });
        top = top.max(greatest(calibration, |at| stiffness(at.tooth(gear))));
    }
    plot.set_layout(over_the_path(calibration, "stiffness, N/(mm·µm)", top));
    Figure {
        id: "gear-stiffness".into(),
        title: "Stiffness of each gear’s tooth, flattening included".into(),
        reading: "The pinion’s tooth is loaded at its root at A and at its tip at E, the wheel’s the other way round. Weber and \
                  Banaschek let the body yield as an elastic half-plane does; finite elements hold it at the clamp radius."
            .into(),
        plot,
        wide: false,
    }
}

fn flattening(calibration: &Calibration) -> Figure {
    let mut plot = Plot::new();
    let mut top = 0.0_f64;
    let um_per_load = 1e3 * calibration.line_load_n_per_mm;
    for gear in Gear::BOTH {
        let (colour, name) = (gear_colour(gear), gear.name());
        let fem = |at: &PairDeflection| um_per_load * at.tooth(gear).flattening_mm2_per_n();
        add(&mut plot, calibration, &format!("{name}, finite elements"), (colour, 2.2, DashType::Solid), fem);
        add(&mut plot, calibration, &format!("{name}, half-plane"), (colour, 1.6, DashType::Dash), |at| {
            um_per_load * at.tooth(gear).closed_form_flattening_mm2_per_n
        });
        top = top.max(greatest(calibration, fem));
    }
    plot.set_layout(over_the_path(calibration, "flattening to the centre line, µm", top));
    let excess = |at: &PairDeflection| {
        at.sum(ToothDeflection::flattening_mm2_per_n) / at.sum(|tooth| tooth.closed_form_flattening_mm2_per_n) - 1.0
    };
    let (least, most) = calibration
        .deflection
        .iter()
        .map(excess)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, m), e| (l.min(e), m.max(e)));
    Figure {
        id: "flattening".into(),
        title: "Flattening: the tooth against the half-plane".into(),
        reading: format!(
            "From the flank to the centre line the teeth yield {} to {} more than half-planes would, both together: a tooth ends \
             on its far side, where a half-plane goes on.",
            percent(least),
            percent(most)
        ),
        plot,
        wide: false,
    }
}

fn coupling(calibration: &Calibration) -> Figure {
    let mut plot = Plot::new();
    type Side = fn(&PairDeflection) -> Option<f64>;
    let sides: [(&str, &str, Side); 2] =
        [("pair ahead", PATH, |at| at.ahead_mm2_per_n), ("pair behind", WORN, |at| at.behind_mm2_per_n)];
    let mut top = 0.0_f64;
    for (name, colour, side) in sides {
        let relative = |at: &PairDeflection| Some(side(at)? / at.sum(|tooth| tooth.whole_mm2_per_n));
        let (x, y): (Vec<f64>, Vec<f64>) =
            calibration.deflection.iter().filter_map(|at| Some((at.position_mm, 100.0 * relative(at)?))).unzip();
        top = y.iter().copied().fold(top, f64::max);
        plot.add_trace(curve(name, x, y, line(colour, 2.2, DashType::Solid)).hover_template("%{y:.2f} %"));
    }
    plot.set_layout(over_the_path(calibration, "approach there over approach here, %", top));
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
    Figure {
        id: "coupling".into(),
        title: "Coupling of neighbouring teeth".into(),
        reading: format!(
            "{at_b_and_d}A load on one pair moves its neighbour as well, through the bodies that both share, and by much the same \
             wherever it stands: the fast model has the mean, {} of E·δ/w, in series with all pairs together.",
            figure(
                calibration.pair_compliance.shared_mm2_per_n
                    * 1e3
                    * calibration.belongs_to.material.pinion.young_modulus_gpa
            )
        ),
        plot,
        wide: false,
    }
}

fn course(calibration: &Calibration) -> Figure {
    let mut plot = Plot::new();
    let mut top = 0.0_f64;
    let styles = [
        (PATH, 2.4, DashType::Solid),
        (PATH, 1.6, DashType::Dash),
        (gear_colour(Gear::Pinion), 2.2, DashType::Solid),
        (gear_colour(Gear::Pinion), 1.6, DashType::Dash),
    ];
    for (course, style) in calibration.courses.iter().zip(styles) {
        let relative = |at: &PairDeflection| course.of.n_per_mm_um(at) / course.mean_n_per_mm_um;
        add(&mut plot, calibration, course.of.words(), style, relative);
        top = top.max(greatest(calibration, relative));
    }
    plot.set_layout(over_the_path(calibration, "stiffness over its mean", top));
    let of = |wanted: VariationOf| calibration.courses.iter().find(|course| course.of == wanted);
    let words = |course: &StiffnessVariation| format!("{} {}", course.of.words(), figure(course.max_over_min));
    let ratios: Vec<String> = VariationOf::ALL.into_iter().filter_map(of).map(words).collect();
    let place = of(VariationOf::PairWhole).map_or_else(String::new, |course| {
        format!(" The pair is stiffest at {} of the way from A to E.", percent(course.greatest_at))
    });
    Figure {
        id: "course".into(),
        title: "Stiffness over its mean".into(),
        reading: format!("Greatest over least: {}.{place}", ratios.join("; ")),
        plot,
        wide: false,
    }
}

fn family(calibration: &Calibration) -> Figure {
    let mut plot = Plot::new();
    let members = &calibration.family;
    let heights = members.first().map_or(&[][..], |member| &member.height);
    let mut top = 0.0_f64;
    for (k, height) in heights.iter().enumerate() {
        let colour = format!("mix(--pinion,--wheel,{height:.3})");
        let name = match *height {
            0.0 => "root".to_owned(),
            1.0 => "tip".to_owned(),
            height => format!("{} of the way", significant(height, 2)),
        };
        let teeth = || members.iter().map(|member| f64::from(member.teeth));
        plot.add_trace(
            curve(&name, teeth(), members.iter().map(|m| m.deflection[k]), line(colour.clone(), 2.2, DashType::Solid))
                .legend_group(&name)
                .hover_template("%{y:.3g}"),
        );
        plot.add_trace(
            curve(&name, teeth(), members.iter().map(|m| m.weber_banaschek[k]), line(colour, 1.2, DashType::Dot))
                .legend_group(&name)
                .show_legend(false)
                .hover_template("%{y:.3g}, Weber and Banaschek"),
        );
        let greatest = |values: fn(&crate::calibration::tooth_family::FamilyMember) -> &Vec<f64>| {
            members.iter().map(|member| values(member)[k]).fold(0.0, f64::max)
        };
        top = top.max(greatest(|m| &m.deflection)).max(greatest(|m| &m.weber_banaschek));
    }
    let x = axis("number of teeth");
    let y = axis("deflection of tooth and body, E·δ/w").range(from_zero(top).to_vec());
    plot.set_layout(layout(420).show_legend(true).x_axis(x).y_axis(y));
    let shifted: Vec<String> = members
        .iter()
        .filter(|member| member.profile_shift > 0.0)
        .map(|member| format!("{} (x = {})", member.teeth, significant(member.profile_shift, 3)))
        .collect();
    let shifted = match shifted.is_empty() {
        true => String::new(),
        false => format!(" Shifted out by the least that avoids undercut: {}.", shifted.join(", ")),
    };
    Figure {
        id: "family".into(),
        title: "Deflection by number of teeth, loaded from root to tip".into(),
        reading: format!(
            "Full lines by finite elements, dotted by Weber and Banaschek, flattening apart; single gears of the scene’s rack \
             and module, held 2.5 modules below their root.{shifted}"
        ),
        plot,
        wide: true,
    }
}
