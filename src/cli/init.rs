//! `gearwear init`: a commented scene to start from.

use crate::scene::presets;

use super::failure::{Failure, InputError};
use super::print;

#[derive(Debug, clap::Args)]
pub(super) struct Args {
    /// The scene to print
    #[arg(default_value = presets::PRESETS[0].name, help = format!("The scene to print: {}", presets::names().join(", ")))]
    preset: String,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let name = args.preset.clone();
    let preset = presets::find(&name).ok_or(InputError::UnknownPreset { name })?;
    print(preset.text)
}
