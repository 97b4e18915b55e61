//! `gearwear export`: the worn flank of a finished run as the file of a measured one.

use std::path::PathBuf;

use gearwear::report::ReportError;
use gearwear_bodies::gear::Gear;
use gearwear_files::whole_file;
use gearwear_physics::assessment::RunError;
use gearwear_studies::export::{ExportError, FlankFormat, worn_flank};

use super::compare::{gear, length};
use super::failure::{Failure, InputError};

#[derive(Debug, clap::Args)]
pub(super) struct ExportArgs {
    /// The folder of a finished `gearwear run`
    run: PathBuf,
    /// Whose flank
    #[arg(long, value_name = "GEAR", default_value = "pinion", value_parser = gear)]
    gear: Gear,
    /// The place over the face width, of a run with slices: the nearest slice; default: the middle
    #[arg(long, value_name = "MM", value_parser = length)]
    width: Option<f64>,
    /// The file, which `gearwear compare` reads: a table of roll lengths and heights, or, where its name ends in .mka, the text export of a
    /// P40 gear measuring machine
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

pub(super) fn run(args: &ExportArgs) -> Result<(), Failure> {
    let text = worn_flank(&args.run, args.gear, args.width, FlankFormat::of(&args.out))?;
    whole_file::write(&args.out, |file| file.write_all(text.as_bytes()))
        .map_err(|source| ReportError::WriteFile { path: args.out.clone(), source })?;
    Ok(())
}

impl From<ExportError> for Failure {
    fn from(error: ExportError) -> Self {
        match error {
            ExportError::Load(error) => error.into(),
            ExportError::RunFolder(error) => InputError::RunFolder(error).into(),
            ExportError::Pair(error) => Failure::Run(RunError::from(error)),
            error => InputError::Export(error).into(),
        }
    }
}
