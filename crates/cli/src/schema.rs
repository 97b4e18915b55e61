//! `gearwear schema`: the JSON schema of the scene, of a planetary stage, or of a finite-element problem, for editors.

use gearwear::scene::{fem_problem, planetary, schema::published};

use super::failure::Failure;
use super::print;

#[derive(Debug, clap::Args)]
pub(super) struct SchemaArgs {
    /// The schema of a finite-element problem with its own mesh instead
    #[arg(long)]
    problem: bool,
    /// The schema of a planetary stage, [planetary], instead
    #[arg(long, conflicts_with = "problem")]
    planetary: bool,
}

pub(super) fn run(args: &SchemaArgs) -> Result<(), Failure> {
    let schema = match (args.problem, args.planetary) {
        (true, _) => fem_problem::schema(),
        (_, true) => planetary::schema::published(),
        _ => published(),
    };
    print(&format!("{schema:#}\n"))
}
