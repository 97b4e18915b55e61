//! `report.html` of a finite-element problem.

use crate::report::output_files;
use maud::{Markup, html};

use super::{field_figures, pressure_figure};
use crate::report::html::number::{change, figure, significant};
use crate::report::html::page::{self, Page, Plots, section, sources_list, stages_table};
use crate::report::html::table::{NONE, cells, row, table};
use gearwear_fem::problem::{Stop, ThirdDirection};
use gearwear_physics::results::fem_problem::{FemContactSummary, FemRecord, FemSummary, PlaneSolution};

const DATA_FILES: [(&str, &str); 4] = [
    (output_files::SUMMARY, "the main figures"),
    (output_files::CONTACT, "gap and pressure along the contacts"),
    (output_files::SOLUTION, "displacement and stress, for ParaView"),
    (output_files::PROBLEM, "the resolved problem"),
];

pub(super) fn page(record: &FemRecord, plane: &PlaneSolution) -> String {
    let s = &record.summary;
    let mut charts = vec![field_figures::model(record, plane)];
    let contacts = s.contact.iter().zip(&plane.contacts).enumerate();
    charts.extend(
        contacts.filter_map(|(index, (summary, contact))| {
            pressure_figure::pressure(index, s.contact.len(), summary, contact)
        }),
    );
    charts.extend(field_figures::von_mises(&record.summary, plane));
    let figures = s.contact.iter().map(contact_table).chain([model_table(s), solver_table(s)]);
    let work = page::tables([stages_table(&s.stages, s.wall_s), work_table(s)]);
    let sources = sources_list(&DATA_FILES, "The resolved problem, every default filled in", &record.problem_toml);
    let plots = Plots::default();
    Page {
        kind: "Elastic bodies in contact",
        title: &s.title,
        byline: "",
        answer: &answer(s),
        interruption: None,
        warnings: &s.warnings,
        main: html! {
            (section("figures", "Main figures", page::tables(figures)))
            (section("plots", "Plots", plots.show(&charts)))
            (section("work", "How it was computed", work))
            (section("sources", "Data and problem", sources))
        },
        plots,
        footer: &format!("gearwear {} · problem {} · mesh {}", s.program_version, s.problem_hash, s.mesh.hash),
    }
    .html()
}

fn answer(s: &FemSummary) -> String {
    let touching = |contact: &&FemContactSummary| contact.half_width_mm > 0.0;
    let hardest = s.contact.iter().filter(touching).max_by(|a, b| a.peak_pressure_MPa.total_cmp(&b.peak_pressure_MPa));
    match hardest {
        Some(contact) => format!(
            "{} presses on {} with up to {} MPa over a half-width of {} mm; {}.",
            contact.slave,
            contact.master,
            figure(contact.peak_pressure_MPa),
            figure(contact.half_width_mm),
            force_in_words(contact),
        ),
        None if s.contact.is_empty() => {
            format!("The von Mises stress reaches {} MPa.", figure(s.peak_von_mises_MPa))
        }
        None => format!("Nothing touches; the von Mises stress reaches {} MPa.", figure(s.peak_von_mises_MPa)),
    }
}

fn force_in_words(contact: &FemContactSummary) -> String {
    let part = if contact.half_model { "in the modelled half" } else { "altogether" };
    match (contact.force_N_per_mm, contact.force_N) {
        (Some([x, y]), _) => {
            format!("{part} the force along x and y is {} and {} N per mm of thickness", figure(x), figure(y))
        }
        (None, force) => format!("around the axis the force is {} N", figure(force.map_or(0.0, |[_, y]| y))),
    }
}

fn contact_table(contact: &FemContactSummary) -> Markup {
    let hertz = contact.hertz;
    let compare = |label, unit, found: f64, by_hertz: Option<f64>| {
        let difference = by_hertz.map_or_else(|| NONE.to_owned(), |hertz| change(hertz, found));
        row(label, unit, cells![found, by_hertz, difference])
    };
    let only = |label, unit, value: f64| row(label, unit, cells![value, "", ""]);
    let mut rows = vec![
        compare("Maximum pressure", "MPa", contact.peak_pressure_MPa, hertz.map(|h| h.peak_pressure_MPa)),
        compare("Half-width a", "mm", contact.half_width_mm, hertz.map(|h| h.half_width_mm)),
        only("Width in contact, modelled part", "mm", contact.contact_width_mm),
    ];
    if let Some([x, y]) = contact.force_N_per_mm {
        rows.push(only("Force along x, modelled part", "N/mm", x));
        rows.push(only("Force along y, modelled part", "N/mm", y));
    }
    rows.extend(contact.force_N.map(|[_, y]| only("Force along the axis, whole circumference", "N", y)));
    rows.extend([
        only("Centre, x", "mm", contact.centre_mm[0]),
        only("Centre, y", "mm", contact.centre_mm[1]),
        only("Largest penetration", "µm", contact.max_penetration_um),
    ]);
    rows.extend(contact.elements_per_half_width.map(|elements| only("Elements along a", "", elements)));
    rows.extend(hertz.map(|hertz| only("Relative radius of curvature, fitted", "mm", hertz.relative_radius_mm)));
    let caption = format!("{} on {}", contact.slave, contact.master);
    table(caption, &["finite elements", "Hertz", "difference"], rows)
}

pub(super) fn model_table(s: &FemSummary) -> Markup {
    let analysis = match s.analysis {
        ThirdDirection::PlaneStrain => "plane strain",
        ThirdDirection::PlaneStress => "plane stress",
        ThirdDirection::Axisymmetric => "axisymmetric, x the radius",
        ThirdDirection::ThreeDimensional => "three-dimensional",
    };
    let rows = [
        row("Mesh file", "", [&*s.mesh.file]),
        row("Nodes", "", [s.mesh.nodes]),
        row("Elements", "", [s.elements]),
        row("Degrees of freedom, supports included", "", [s.dofs]),
        row("Analysis", "", [analysis]),
        row("Maximum von Mises stress at a node", "MPa", [s.peak_von_mises_MPa]),
    ];
    table("Model", &["value"], rows)
}

pub(super) fn solver_table(s: &FemSummary) -> Markup {
    let stop = match s.stopped {
        Stop::Converged => "converged",
        Stop::ConvergedAfterCycle => "converged after an active-set cycle was broken",
    };
    let sets = s.in_space.is_none().then(|| row("Active-set iterations", "", [s.iterations]));
    let rows = [
        row("Stopped", "", [stop]),
        row("Largest unbalanced nodal force, relative", "", [significant(s.residual, 2)]),
        row("Unbalance of external forces, relative", "", [significant(s.force_balance, 2)]),
    ];
    table("Solver", &["value"], sets.into_iter().chain(rows))
}

fn work_table(s: &FemSummary) -> Markup {
    let rows = [
        row("Active-set iterations", "", [s.work.iterations]),
        row("Changes of a node’s contact state", "", [s.work.active_set_changes]),
        row("Cycles broken", "", [s.work.cycles_broken]),
        row("Sparse factorisations", "", [s.work.factorisations]),
        row("Right-hand sides", "", [s.work.right_hand_sides]),
    ];
    table("Computational work of the solver", &["count"], rows)
}
