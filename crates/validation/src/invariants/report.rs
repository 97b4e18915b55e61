//! The files of a study of random scenes, written from its record alone: `invariants.csv`, `report.html`, `violations/`, and `summary.json` last.

use gearwear::report::output_files;
use std::fmt::Write as _;
use std::path::Path;

use maud::{Markup, html};

use super::record::{InvariantsRecord, Violation};
use gearwear::report::csv_table::{self, CsvFiles, Provenance};
use gearwear::report::files::{ReportError, create_folder, place, remove, write_json};
use gearwear::report::html::number::significant;
use gearwear::report::html::page::{Page, Plots, section};
use gearwear::report::html::table::{Cell, line, list};

/// The folder of the scenes that violate a statement.
const VIOLATIONS: &str = "violations";
/// Violations of which the scenes are written.
const MOST_WRITTEN: usize = 200;

/// Writes all files into `dir`, which is made if need be.
pub fn write(record: &InvariantsRecord, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    remove(dir, output_files::SUMMARY)?;
    let seed = format!("seed {}", record.seed);
    let mut csv = CsvFiles::new(dir, Provenance::of_scene(&record.program_version, &seed));
    csv.place("invariants.csv", |out| csv_table::table(out, record.statements.iter()))?;
    csv.finish()?;
    let folder = dir.join(VIOLATIONS);
    if !record.violations.is_empty() {
        create_folder(&folder)?;
    }
    for violation in record.violations.iter().take(MOST_WRITTEN) {
        let name = file_name(record.seed, violation);
        place(&folder, &format!("{name}.toml"), |out| out.write_all(violation.text.as_bytes()))?;
        if let Some(other) = &violation.other {
            place(&folder, &format!("{name}-other.toml"), |out| out.write_all(other.as_bytes()))?;
        }
    }
    place(dir, output_files::PAGE, |out| out.write_all(page(record).as_bytes()))?;
    place(dir, output_files::SUMMARY, |out| write_json(out, record)).map(drop)
}

fn file_name(seed: u64, violation: &Violation) -> String {
    let statement: String =
        violation.statement.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '-' }).collect();
    format!("{seed}-{}-{statement}", violation.scene)
}

/// The result in a sentence.
fn answer(record: &InvariantsRecord) -> String {
    format!(
        "{} random scenes of seed {}: {} ran, {} were refused, {} are worn through; {} of the statements held against them are violated.",
        record.drawn,
        record.seed,
        record.ran,
        record.refused,
        record.worn_through,
        record.violations.len()
    )
}

/// Text for the terminal.
pub fn terminal(record: &InvariantsRecord) -> String {
    let mut text = format!(
        "{:34} {:>6} {:>8} {:>10} {:>10}  {}\n",
        "statement", "scenes", "violated", "worst", "allowed", "scene, figure"
    );
    for row in &record.statements {
        let worst = row.worst_scene.map_or_else(String::new, |scene| format!("{scene}, {}", row.worst_figure));
        let _ = writeln!(
            text,
            "{:34} {:>6} {:>8} {:>10.2e} {:>10.2e}  {worst}",
            row.statement, row.scenes, row.violated, row.worst_value, row.worst_bound
        );
    }
    for violation in record.violations.iter().take(20) {
        let _ = writeln!(text, "violated: {} by scene {}: {}", violation.statement, violation.scene, violation.figure);
    }
    let _ = writeln!(text, "{} {} runs, {:.1} s", answer(record), record.runs, record.wall_s);
    text
}

fn page(record: &InvariantsRecord) -> String {
    let violations: Vec<String> = record
        .violations
        .iter()
        .take(20)
        .map(|violation| format!("{}: scene {}, {}", violation.statement, violation.scene, violation.figure))
        .collect();
    let interruption = (record.drawn < record.count)
        .then(|| format!("It was interrupted after {} of {} scenes.", record.drawn, record.count));
    Page {
        kind: "Invariants",
        title: "Statements that hold for every scene, on random ones",
        byline: "",
        answer: &answer(record),
        interruption: interruption.as_deref(),
        warnings: &violations,
        main: html! {
            (section("statements", "Statements", statements(record)))
            (section("refusals", "Scenes that were refused", refusals(record)))
        },
        plots: Plots::default(),
        footer: &format!("gearwear {} · seed {}", record.program_version, record.seed),
    }
    .html()
}

fn statements(record: &InvariantsRecord) -> Markup {
    let rows = record.statements.iter().map(|row| {
        let scene = row.worst_scene.map(|scene| scene.to_string());
        line([
            Cell::from(row.statement.as_str()),
            Cell::from(row.scenes),
            Cell::from(row.violated),
            Cell::from(significant(row.worst_value, 2)),
            Cell::from(significant(row.worst_bound, 2)),
            Cell::from(scene),
            Cell::from(row.worst_figure.as_str()),
            Cell::sentence(row.states.as_str()),
            Cell::sentence(row.reason.as_str()),
        ])
    });
    let columns =
        ["", "scenes", "violated", "worst", "allowed", "scene", "figure or place", "states", "why so much is allowed"];
    list("Statements", columns, rows)
}

fn refusals(record: &InvariantsRecord) -> Markup {
    let rows = record.refusals.iter().map(|refusal| {
        line([Cell::sentence(refusal.message.as_str()), Cell::from(refusal.count), Cell::from(refusal.first_scene)])
    });
    html! { (list("Messages, one for each kind", ["message", "scenes", "first scene"], rows)) }
}
