//! `gearwear schema`: the JSON schema of the scene, or of a finite-element problem, for editors.

use gearwear::scene::{fem_problem, schema::published};

use super::failure::Failure;
use super::print;

#[derive(Debug, clap::Args)]
pub(super) struct SchemaArgs {
    /// The schema of a finite-element problem with its own mesh instead
    #[arg(long)]
    problem: bool,
}

pub(super) fn run(args: &SchemaArgs) -> Result<(), Failure> {
    let schema = if args.problem { fem_problem::schema() } else { published() };
    print(&format!("{schema:#}\n"))
}
