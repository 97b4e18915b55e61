//! `gearwear init`: a commented scene to start from, built in or out of the file of another program.

use std::fs;
use std::path::{Path, PathBuf};

use gearwear::exchange::rexs;
use gearwear::scene::presets;

use super::failure::{Failure, InputError};
use super::{print, warn};

#[derive(Debug, clap::Args)]
pub(super) struct InitArgs {
    /// The scene to print
    #[arg(default_value = presets::PRESETS[0].name, help = format!("The scene to print: {}", presets::names().join(", ")))]
    preset: String,
    /// Make the scene from a cylindrical stage of a gear unit in REXS (versions 1.4 to 2.0, XML)
    #[arg(long, value_name = "FILE", conflicts_with = "preset")]
    from: Option<PathBuf>,
    /// Number of the cylindrical stage in the file, from 1; may be left out where there is one
    #[arg(long, value_name = "N", requires = "from")]
    stage: Option<usize>,
}

pub(super) fn run(args: &InitArgs) -> Result<(), Failure> {
    if let Some(file) = &args.from {
        return from_rexs(file, args.stage);
    }
    let name = args.preset.clone();
    let preset = presets::find(&name).ok_or(InputError::UnknownPreset { name })?;
    print(preset.text)
}

fn from_rexs(file: &Path, stage: Option<usize>) -> Result<(), Failure> {
    let name = file.display().to_string();
    let bytes = fs::read(file).map_err(|reason| InputError::Unreadable { name: name.clone(), reason })?;
    let scene = rexs::scene(&String::from_utf8_lossy(&bytes), stage)
        .map_err(|error| InputError::Rexs { name, error: Box::new(error) })?;
    warn(&scene.warnings);
    print(&scene.text)
}
