//! `gearwear init`: a commented scene to start from, built in or out of the file of another program.

use std::path::{Path, PathBuf};

use gearwear::exchange::rexs::{self, Provenance};
use gearwear::scene::presets;

use super::failure::{Failure, InputError};
use super::{print, rexs as rexs_file, say, warn};

#[derive(Debug, clap::Args)]
pub(super) struct InitArgs {
    /// The scene to print
    #[arg(default_value = presets::PRESETS[0].name, help = format!("The scene to print: {}", presets::names().join(", ")))]
    preset: String,
    /// Make the scene from a cylindrical stage of a gear unit in REXS (versions 1.0 to 2.0: XML, JSON, or an archive of one), and list
    /// on standard error what of it is taken, derived, assumed and left REQUIRED
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
    let refused = |error| InputError::Rexs { name: file.display().to_string(), error: Box::new(error) };
    let text = rexs::container::text(&rexs_file::bytes_of(file, refused)?).map_err(refused)?;
    let scene = rexs::scene(&text, stage).map_err(refused)?;
    let Provenance { taken, derived, assumed, required } = &scene.provenance;
    for (what, keys) in
        [("taken from the file", taken), ("derived", derived), ("assumed", assumed), ("REQUIRED", required)]
    {
        say(&format!("{what}: {}", if keys.is_empty() { "nothing".to_owned() } else { keys.join(", ") }));
    }
    warn(&scene.warnings);
    print(&scene.text)
}
