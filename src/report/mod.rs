//! The files a run leaves behind, written from its [`RunRecord`] alone.
//!
//! | file | from |
//! |---|---|
//! | `summary.json` | [`Summary`](gearwear_physics::results::run::Summary) |
//! | `pinion.csv`, `wheel.csv`, `profiles.csv` | [`tables`] |
//! | `history.csv`, `mesh_cycle.csv` | [`HistoryRow`](gearwear_physics::results::run::HistoryRow), [`MeshCycleRow`](gearwear_physics::results::run::MeshCycleRow) |
//! | `columns.json` | what the columns of the CSV files hold ([`csv_table`]) |
//! | `slices.csv` | [`slice_table`]; only where the sections of the pair differ |
//! | `film.csv` | [`FilmRow`](gearwear_physics::results::lubrication::FilmRow); only where the scene asks for films or losses |
//! | `torque_curve.csv` | [`TorqueCurveRow`](gearwear_physics::results::torque_curve::TorqueCurveRow); unless the scene leaves it out |
//! | `flank.vtu`; where asked for `flank.pvd`, `flank_000.vtu` … | [`flank_mesh`] |
//! | `scene.toml` | the resolved scene, byte for byte, so that its SHA-256 begins with the scene hash |
//! | `record.bin` | the record itself, written by [`resume`](crate::resume) |
//! | `report.html` | [`html`] |
//! | `results.xlsx`, where asked for | [`workbook`], from the CSV files |
//! | figures in a folder of their own, where asked for | [`figure`], which draws the plots of the page too |
//!
//! `summary.json` comes last, so that its presence says the others are complete.

pub mod calibration;
pub mod chart;
mod colour;
pub mod columns;
pub mod control;
pub mod csv_table;
pub mod fem;
pub mod fem_pair;
pub mod figure;
pub mod files;
pub mod flank_mesh;
pub mod headline;
pub mod html;
pub mod output_files;
mod pressure_plot;
pub mod slice_table;
pub mod tables;
mod trace;
pub mod unit;
mod vtu_file;
mod workbook;

use std::io::Write;
use std::path::{Path, PathBuf};

use serde::Serialize;

use self::csv_table::{CsvFiles, Provenance, table};
pub use self::files::{ReportError, create_folder, writable};
use self::files::{place, remove, write_json};
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::RunRecord;

/// Writes all files of `record` but the page and `summary.json` into `dir`, which is made if need be; returns their paths, `flank.vtu` last. Files that only
/// some runs have are taken away where `record` has nothing for them.
pub fn write_data(record: &RunRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    create_folder(dir)?;
    let flank = || place(dir, output_files::FLANK, |out| flank_mesh::write(out, record));
    let (paths, flank) = rayon::join(|| write_tables(record, dir), flank);
    let mut paths = paths?;
    paths.push(flank?);
    Ok(paths)
}

/// Writes the scene, the tables, and what their columns hold.
fn write_tables(record: &RunRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    let provenance = Provenance::of_scene(&record.summary.program_version, &record.summary.scene_hash);
    let mut csv = CsvFiles::new(dir, provenance);
    let flank = |gear: Gear| move |out: &mut dyn Write| table(out, tables::flank(&record.flanks[gear]));
    let [pinion, wheel, history, profiles, mesh_cycle] = TABLES;
    let mut paths = vec![
        place(dir, output_files::SCENE, |out| out.write_all(record.scene_toml.as_bytes()))?,
        csv.place(pinion, flank(Gear::Pinion))?,
        csv.place(wheel, flank(Gear::Wheel))?,
        csv.place(history, |out| table(out, &record.history))?,
        csv.place(profiles, |out| table(out, tables::profiles(record)))?,
        csv.place(mesh_cycle, |out| table(out, &record.mesh_cycle))?,
    ];
    match &record.slices {
        Some(slices) => {
            let path = &record.summary.geometry.curvature_radius_mm;
            paths.push(csv.place(output_files::SLICES, |out| table(out, slice_table::rows(slices, path)))?);
        }
        // What an earlier run left there would pass for this one's.
        None => remove(dir, output_files::SLICES)?,
    }
    match record.film.is_empty() {
        false => paths.push(csv.place(output_files::FILM, |out| table(out, &record.film))?),
        true => remove(dir, output_files::FILM)?,
    }
    match record.torque_curve.is_empty() {
        false => paths.push(csv.place(output_files::TORQUE_CURVE, |out| table(out, &record.torque_curve))?),
        true => remove(dir, output_files::TORQUE_CURVE)?,
    }
    paths.push(csv.finish()?);
    Ok(paths)
}

/// Files of a run beside its tables.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RunFiles {
    /// The page.
    pub page: bool,
    /// The tables as a workbook.
    pub workbook: bool,
    /// Both flanks in space at every snapshot.
    pub series: bool,
    /// Folder of the plots of the page as SVG and PNG; `None`: not written.
    pub figures: Option<PathBuf>,
}

impl Default for RunFiles {
    /// The page alone.
    fn default() -> Self {
        Self { page: true, workbook: false, series: false, figures: None }
    }
}

/// Writes all of `record` but its summary and the record itself into `dir`; of `files` those that are not asked for are taken away there.
pub fn write_files(record: &RunRecord, files: &RunFiles, dir: &Path) -> Result<(), ReportError> {
    create_folder(dir)?;
    let page = || match files.page {
        true => write_page(record, dir).map(drop),
        false => remove_page(dir),
    };
    let (data, page) = rayon::join(|| write_data(record, dir), page);
    data.and(page)?;
    match files.series {
        true => write_series(record, dir).map(drop),
        false => remove_series(dir),
    }?;
    match files.workbook {
        true => write_workbook(record, dir).map(drop),
        false => remove_workbook(dir),
    }?;
    files.figures.as_ref().map_or(Ok(()), |figures| write_figures(record, figures).map(drop))
}

/// Writes the page of `record` into `dir`.
pub fn write_page(record: &RunRecord, dir: &Path) -> Result<PathBuf, ReportError> {
    place(dir, output_files::PAGE, |out| out.write_all(html::run_page::page(record).as_bytes()))
}

/// Writes the plots of the page of `record` as SVG and PNG into `dir`.
pub fn write_figures(record: &RunRecord, dir: &Path) -> Result<Vec<PathBuf>, ReportError> {
    figure::write_all(&html::run_page::charts(record), dir)
}

/// The plots of the page of `record`, drawn.
pub fn figures(record: &RunRecord) -> Vec<figure::Figure> {
    figure::drawn(&html::run_page::charts(record)).collect()
}

/// Writes the tables of `record`, which stand in `dir`, as a workbook beside them.
pub fn write_workbook(record: &RunRecord, dir: &Path) -> Result<PathBuf, ReportError> {
    let sliced = record.slices.is_some().then_some(output_files::SLICES);
    let films = (!record.film.is_empty()).then_some(output_files::FILM);
    let torques = (!record.torque_curve.is_empty()).then_some(output_files::TORQUE_CURVE);
    let tables: Vec<&str> = TABLES.into_iter().chain(sliced).chain(films).chain(torques).collect();
    workbook::write(&record.summary, &tables, dir)
}

/// Takes away the workbook of an earlier run, if there is one.
pub fn remove_workbook(dir: &Path) -> Result<(), ReportError> {
    remove(dir, workbook::WORKBOOK)
}

/// Writes both flanks of `record` at the beginning and at every snapshot into `dir`, and the list of these files.
pub fn write_series(record: &RunRecord, dir: &Path) -> Result<PathBuf, ReportError> {
    let files: Vec<String> = (0..flank_mesh::moments(record)).map(flank_at).collect();
    for (moment, file) in files.iter().enumerate() {
        place(dir, file, |out| flank_mesh::write_moment(out, record, moment))?;
    }
    remove_moments(dir, files.len())?;
    place(dir, output_files::SERIES, |out| flank_mesh::write_series(out, record, &files))
}

/// Takes away the series of an earlier run, if there is one.
pub fn remove_series(dir: &Path) -> Result<(), ReportError> {
    remove(dir, output_files::SERIES)?;
    remove_moments(dir, 0)
}

fn remove_moments(dir: &Path, from: usize) -> Result<(), ReportError> {
    let names = (from..).map(flank_at).take_while(|name| dir.join(name).exists());
    names.into_iter().try_for_each(|name| remove(dir, &name))
}

/// The file of both flanks at a moment of a series.
fn flank_at(moment: usize) -> String {
    format!("flank_{moment:03}.vtu")
}

/// Takes away the page of an earlier run, if there is one: it would pass for that of a run without.
pub fn remove_page(dir: &Path) -> Result<(), ReportError> {
    remove(dir, output_files::PAGE)
}

/// The tables of every run.
const TABLES: [&str; 5] = [
    output_files::PINION,
    output_files::WHEEL,
    output_files::HISTORY,
    output_files::PROFILES,
    output_files::MESH_CYCLE,
];

/// Writes `summary.json` into `dir`, of a wear run or of finite elements, after everything else.
pub fn write_summary(summary: &impl Serialize, dir: &Path) -> Result<PathBuf, ReportError> {
    create_folder(dir)?;
    place(dir, output_files::SUMMARY, |out| write_json(out, summary))
}

/// Takes away the `summary.json` of an earlier run, if there is one: its presence says that the other files are complete, and they are about to be replaced.
pub fn remove_summary(dir: &Path) -> Result<(), ReportError> {
    remove(dir, output_files::SUMMARY)
}
