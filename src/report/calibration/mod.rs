//! The files of a calibration: the JSON that scenes name, and a page beside it for the reader.

mod foundation_figures;
mod page;
mod stiffness_figures;
mod tables;
mod wear_figure;

use std::path::{Path, PathBuf};

use super::files::{ReportError, create_folder};
use gearwear_files::whole_file;
use gearwear_physics::calibration::Calibration;
use gearwear_physics::results::run::{PathPoints, StageTime};

pub fn folder(file: &Path) -> &Path {
    file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

pub fn page_beside(file: &Path) -> PathBuf {
    file.with_extension("html")
}

/// Writes the page, under the title and byline of the scene, and then the calibration itself, so that its presence says the rest is complete.
pub fn write(
    calibration: &Calibration,
    stages: &[StageTime],
    [title, byline]: [&str; 2],
    file: &Path,
) -> Result<(), ReportError> {
    create_folder(folder(file))?;
    let name = file.file_name().unwrap_or_default().to_string_lossy();
    place(&page_beside(file), &page::page(calibration, stages, [title, byline], &name))?;
    place(file, &calibration.to_json())
}

/// The points of the path of contact by name.
fn path_points(calibration: &Calibration) -> PathPoints {
    let [a, b, c, d, e] = calibration.path_points_mm;
    PathPoints { A: a, B: b, C: c, D: d, E: e }
}

fn place(path: &Path, text: &str) -> Result<(), ReportError> {
    whole_file::write(path, |out| out.write_all(text.as_bytes()))
        .map_err(|source| ReportError::WriteFile { path: path.to_owned(), source })
}
