//! `report.html` of a three-dimensional problem.

use crate::report::output_files;
use maud::{Markup, html};

use super::page::{model_table, solver_table};
use crate::report::html::number::{figure, significant};
use crate::report::html::page::{self, Page, Plots, note, section, sources_list, stages_table};
use crate::report::html::table::{cells, line, list, row, table};
use gearwear_physics::results::fem_problem::{FemRecord, FemSummary, InSpaceSummary, SpaceSolution};

const DATA_FILES: [(&str, &str); 3] = [
    (output_files::SUMMARY, "the main figures"),
    (output_files::SOLUTION, "displacement and stress, for ParaView"),
    (output_files::PROBLEM, "the resolved problem"),
];

pub(super) fn page(record: &FemRecord, found: &SpaceSolution) -> String {
    let s = &record.summary;
    let figures = s.in_space.iter().map(|greatest| greatest_table(s, greatest));
    let figures = figures.chain([model_table(s), solver_table(s)]);
    let work = page::tables([stages_table(&s.stages, s.wall_s)]);
    let sources = sources_list(&DATA_FILES, "The resolved problem, every default filled in", &record.problem_toml);
    let displacement_mm = s.in_space.map_or(0.0, |greatest| greatest.greatest_displacement_mm);
    Page {
        kind: "Elastic bodies in space",
        title: &s.title,
        byline: "",
        answer: &format!(
            "The bodies move by up to {} mm; the von Mises stress reaches {} MPa.",
            figure(displacement_mm),
            figure(s.peak_von_mises_MPa)
        ),
        interruption: None,
        warnings: &s.warnings,
        main: html! {
            (section("figures", "Main figures", page::tables(figures)))
            (section("model", "Bodies, supports and loads", page::tables([bodies_table(record, found), boundary_table(found)])))
            (note("solution.vtu opens in ParaView: displacement, stress and von Mises stress at the nodes."))
            (section("work", "How it was computed", work))
            (section("sources", "Data and problem", sources))
        },
        plots: Plots::default(),
        footer: &format!("gearwear {} · problem {} · mesh {}", s.program_version, s.problem_hash, s.mesh.hash),
    }
    .html()
}

fn greatest_table(s: &FemSummary, greatest: &InSpaceSummary) -> Markup {
    let line_of = |name, value: f64, unit, [x, y, z]: [f64; 3]| line(cells![name, value, unit, x, y, z]);
    let rows = [
        line_of("Displacement", greatest.greatest_displacement_mm, "mm", greatest.greatest_displacement_at_mm),
        line_of("Von Mises stress at a node", s.peak_von_mises_MPa, "MPa", greatest.peak_von_mises_at_mm),
    ];
    list("Maxima, and where they are before deformation", ["", "maximum", "", "x, mm", "y, mm", "z, mm"], rows)
}

fn bodies_table(record: &FemRecord, found: &SpaceSolution) -> Markup {
    let rows = (0..).zip(record.bodies.iter().zip(&found.problem.materials)).map(|(number, (body, material))| {
        let elements = found.problem.solid.elements.iter().filter(|element| element.body == number).count();
        let (modulus, ratio) = (material.young_modulus_mpa / 1e3, material.poisson_ratio);
        line(cells![body.as_str(), elements, significant(modulus, 4), significant(ratio, 3)])
    });
    list("Bodies", ["", "elements", "Young’s modulus, GPa", "Poisson’s ratio"], rows)
}

fn boundary_table(found: &SpaceSolution) -> Markup {
    let rows = found.boundary.iter().map(|given| {
        let [x, y, z] = given.along.map(|value| value.map_or_else(|| "free".to_owned(), |value| significant(value, 4)));
        row(format!("{}: {}", given.group, given.what), given.unit, [x, y, z])
    });
    table("Supports and loads", &["x", "y", "z"], rows)
}
