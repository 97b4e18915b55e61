//! The files of a study of improvement, written from its [`ImproveRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `improve.csv` | every design that was run |
//! | `front.csv` | verified designs |
//! | `columns.json` | what the columns hold |
//! | `proposal-….toml` | scenes of the proposals |
//! | `report.html` | `page` |
//! | `scene.toml` | the scene as the user gave it |
//! | `summary.json` | [`ImproveRecord`], written last |

mod figures;
mod page;

use std::borrow::Cow;
use std::fs;
use std::io;
use std::path::Path;

use gearwear::report::columns::Cell;
use gearwear::report::csv_table::{Column, CsvFiles, Provenance, table_of};
use gearwear::report::files::{ReportError, create_folder, place, remove, write_json};
use gearwear::report::output_files;

use super::kept::{DesignRole, KeptDesign};
use super::record::ImproveRecord;

/// The file that is written last: its presence says that the others are complete.
const LAST: &str = "summary.json";
const DESIGNS: &str = "improve.csv";
const FRONT: &str = "front.csv";

/// Creates `dir` or removes the results of an earlier start there.
///
/// # Errors
/// A folder that cannot be written.
pub fn begin(dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    remove(dir, LAST)?;
    let entries = fs::read_dir(dir).map_err(|source| ReportError::CreateFolder { path: dir.to_owned(), source })?;
    for entry in entries.flatten() {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        if name.starts_with("proposal-") && name.ends_with(".toml") {
            remove(dir, &name)?;
        }
    }
    Ok(())
}

/// Writes all files of `record` into `dir`.
///
/// # Errors
/// A file that cannot be written.
pub fn write(record: &ImproveRecord, dir: &Path) -> Result<(), ReportError> {
    begin(dir)?;
    place(dir, output_files::SCENE, |out| out.write_all(record.scene_toml.as_bytes()))?;
    for proposal in &record.proposals {
        place(dir, &proposal.file, |out| out.write_all(proposal.scene_toml.as_bytes()))?;
    }
    let provenance = Provenance::of_scene(&record.program_version, &record.scene_hash);
    let mut csv = CsvFiles::new(dir, provenance);
    csv.place(DESIGNS, |out| designs(out, record, |_| true))?;
    csv.place(FRONT, |out| designs(out, record, |design| design.role == DesignRole::Verify))?;
    csv.finish()?;
    place(dir, output_files::PAGE, |out| out.write_all(page::page(record).as_bytes()))?;
    place(dir, LAST, |out| write_json(out, record)).map(drop)
}

/// Table of the designs that are `wanted`.
fn designs(
    out: &mut dyn io::Write,
    record: &ImproveRecord,
    wanted: impl Fn(&KeptDesign) -> bool,
) -> io::Result<Vec<Column>> {
    let column = |name: &str, meaning: &str| (name.to_owned(), meaning.to_owned());
    let mut columns = vec![
        column("design", "number in the order of the study, from 0"),
        column("role", "search or tolerance: on the fast model; verify: as gearwear run runs it"),
        column("front", "1 on the front of the search, else 0"),
        column("proposal", "name of the proposal; empty for others"),
    ];
    columns.extend(record.keys.iter().map(|key| column(key, "free key; empty: the scene as given")));
    columns.extend(
        record
            .figures
            .iter()
            .map(|path| column(path, "figure of the run, by its path in summary.json of gearwear run")),
    );
    columns.push(column("wall_s", "wall time of the run, s"));
    columns.push(column("error", "why there are no figures"));
    let rows = record.designs.iter().enumerate().filter(|(_, design)| wanted(design)).map(|(place, design)| {
        let proposal = record.proposals.iter().find(|proposal| proposal.design == design.number);
        let text = |text: Option<String>| Cell::Text(text.map(Cow::Owned));
        let mut cells = vec![
            Cell::count(design.number),
            text(Some(design.role.name().to_owned())),
            Cell::count(usize::from(record.front.contains(&design.number))),
            text(proposal.map(|proposal| proposal.name.clone())),
        ];
        let said = record.said[place].as_ref();
        cells.extend((0..record.keys.len()).map(|key| text(said.map(|said| said[key].clone()))));
        let figures = design.figures.as_deref().unwrap_or_default();
        cells.extend((0..record.figures.len()).map(|at| Cell::Number(figures.get(at).copied().flatten())));
        cells.push(Cell::Number(Some(design.wall_s)));
        cells.push(text(design.figures.as_ref().err().cloned()));
        cells
    });
    table_of(out, columns, rows)
}
