//! `gearwear completions`: what a shell needs to complete commands and options.

use clap_complete::Shell;

use super::failure::Failure;
use super::print;

#[derive(Debug, clap::Args)]
pub(super) struct CompletionsArgs {
    /// The shell
    shell: Shell,
}

pub(super) fn run(args: &CompletionsArgs) -> Result<(), Failure> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut super::command(), "gearwear", &mut script);
    print(&String::from_utf8_lossy(&script))
}
