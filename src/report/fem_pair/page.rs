//! `report.html` of finite-element contact of a gear pair.

use crate::report::output_files;
use maud::html;

use super::{cycle_figures, field_figures, figures_table, pressure_figure};
use crate::report::html::number::{figure, significant};
use crate::report::html::page::{self, Page, Plots, section, sources_list, stages_table};
use gearwear_physics::results::fem_pair::{FemPairRecord, FemPairSummary};
use gearwear_physics::results::path_points::among;
use gearwear_physics::results::run::{PathPoints, ReportedBy, StopReason};

const DATA_FILES: [(&str, &str); 5] = [
    (output_files::SUMMARY, "the main figures"),
    (output_files::MESH_CYCLE, "load, pressure, transmission error and root stress, position by position"),
    (output_files::PRESSURE, "pressure along the flank, beside Hertz’s"),
    (output_files::SOLUTION, "displacement and stress of the teeth in contact, for ParaView"),
    (output_files::SCENE, "the resolved scene"),
];

const LEGEND: &str = "A to E are the points of the path of contact: theoretical contact begins at A \
     and ends at E, a tooth pair carries the load alone between B and D where no more than two pairs share it, and C is the \
     pitch point. The contact position is the radius of curvature of the pinion’s flank at the theoretical contact point of \
     the reference pair, or in plots of one pair its own. Under load teeth bend, and pairs touch a little before A and after E as well, at a tip edge.";

pub(super) fn page(record: &FemPairRecord) -> String {
    let s = &record.summary;
    let mut charts: Vec<_> = record.solution.iter().map(|solution| field_figures::mesh(s, solution)).collect();
    if s.position_mm.is_none() {
        charts.extend(cycle_figures::all(record));
    }
    charts.extend(pressure_figure::all(record));
    charts.extend(record.solution.iter().flat_map(field_figures::von_mises));
    let is_there = |(name, _): &(&str, &str)| *name != output_files::SOLUTION || record.solution.is_some();
    let files: Vec<_> = DATA_FILES.into_iter().filter(is_there).collect();
    let work = html! { (stages_table(&s.stages, s.wall_s)) (figures_table::checks(s)) };
    let plots = Plots::default();
    Page {
        kind: "Finite-element contact of a gear pair",
        title: &s.title,
        byline: &ReportedBy::line_of_scene(&record.scene_toml),
        answer: &answer(s),
        interruption: interruption(s).as_deref(),
        warnings: &s.warnings,
        main: html! {
            (section("figures", "Main figures", figures_table::tables(s)))
            (section("plots", "Plots", html! { (page::note(LEGEND)) (plots.show(&charts)) }))
            (section("work", "How it was computed", page::tables([work])))
            (section("sources", "Data and scene", sources_list(&files, "The resolved scene, every default filled in", &record.scene_toml)))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", s.program_version, s.scene_hash),
    }
    .html()
}

fn answer(s: &FemPairSummary) -> String {
    let (new, te) = (&s.new, &s.new.transmission_error_um);
    let mut text = match (new.peak_pressure_MPa, new.peak_pressure_pair_position_mm) {
        (Some(peak), Some(at)) if s.position_mm.is_none() => format!(
            "Away from sharp tip edges the pressure reaches {} MPa, where its tooth pair is at {} mm, {}.",
            figure(peak),
            significant(at, 4),
            where_on_path(&s.geometry.curvature_radius_mm, at)
        ),
        (Some(peak), _) => format!("Away from sharp tip edges the pressure reaches {} MPa.", figure(peak)),
        (None, _) => "Every contact touches a sharp tip edge, where pressure has no finite value.".to_owned(),
    };
    text.push_str(&if s.position_mm.is_some() {
        format!(" The loaded transmission error is {} µm.", figure(te.max))
    } else {
        format!(
            " The loaded transmission error runs from {} to {} µm, {} µm peak to peak.",
            figure(te.min),
            figure(te.max),
            figure(te.peak_to_peak)
        )
    });
    if let (Some(pinion), Some(wheel)) = (&s.root.pinion, &s.root.wheel) {
        text.push_str(&format!(
            " At the fillets the stress reaches {} MPa on the pinion and {} MPa on the wheel.",
            figure(pinion.tension_MPa),
            figure(wheel.tension_MPa)
        ));
    }
    text
}

fn where_on_path(points: &PathPoints, at_mm: f64) -> String {
    match at_mm {
        at if at < points.A => "before A".to_owned(),
        at if at > points.E => "after E".to_owned(),
        at => among(&points.named(), at),
    }
}

fn interruption(s: &FemPairSummary) -> Option<String> {
    let how = match s.stopped {
        StopReason::Completed | StopReason::LimitReached => return None,
        StopReason::Interrupted => "The run was interrupted",
        StopReason::NotConverged | StopReason::WornThrough => "The contact at the next position did not converge",
    };
    Some(format!("{how} after {} positions; those are shown, and nothing is said of the rest.", s.positions))
}
