//! The commands, one file each, and what they share: reading scenes, printing errors, exit statuses.

mod accuracy;
mod begun_run;
mod calibrate;
mod compare;
mod completions;
mod counted_progress;
mod explore;
mod export;
mod failure;
mod fem;
mod fem_scene;
mod figures;
mod improve;
mod init;
mod mesh;
mod out_of_memory;
mod plan;
mod planetary;
mod progress;
mod remaining_life;
mod rexs;
mod run;
mod schema;
mod sweep;
mod uncertainty;
mod validate;
mod variants;

use std::ffi::OsString;
use std::io::{ErrorKind, IsTerminal, Write};
use std::process::ExitCode;

use clap::{Parser, Subcommand};

/// Exit status where the input is wrong.
const WRONG_INPUT: u8 = 2;
/// Width of messages where no terminal sets one: never broken, so that scripts find what they look for.
const UNBROKEN: usize = 10_000;

/// Predicts how the flanks of spur and helical gears wear, and the pressure, load sharing and transmission error that follow.
///
/// Exit status: 0 done; 1 a check failed; 2 the input is wrong; 3 the solver failed, or memory lacks; 130 interrupted (what was finished is kept).
#[derive(Debug, Parser)]
#[command(name = "gearwear", version)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Print a commented scene to start from
    Init(init::InitArgs),
    /// Show the stages a scene needs, those left out, and why; runs nothing
    Plan(plan::PlanArgs),
    /// Write the finite-element mesh of the tooth pair
    Mesh(mesh::MeshArgs),
    /// Run the wear simulation of a scene
    Run(run::RunArgs),
    /// Turn a scene's keys on a local page: curves follow at once, finite elements soon after
    Explore(explore::ExploreArgs),
    /// Solve elastic contact with finite elements: of a gear pair, or on a mesh of one's own
    Fem(fem::FemArgs),
    /// Draw error against run time of every model that fits a scene, and recommend the cheapest below a wanted error
    Accuracy(accuracy::AccuracyArgs),
    /// Run a scene for all combinations of varied keys: restartable, in shards on a cluster, with contour plots
    Sweep(sweep::SweepArgs),
    /// Run a scene for samples of uncertain keys: quantiles of its figures, and how much each key contributes (Sobol indices)
    Uncertainty(uncertainty::UncertaintyArgs),
    /// Look for better designs within the ranges of [improve]: fast model, then finite elements; proposals with gain, cost and tolerance
    Improve(improve::ImproveArgs),
    /// Calibrate the fast model: tooth stiffness and K/H from finite elements, against Hertz
    Calibrate(calibrate::CalibrateArgs),
    /// Compare measured flank profiles with a finished run, and fit the wear coefficients to them
    Compare(compare::CompareArgs),
    /// Write the worn flank of a finished run as the file of a measured one
    Export(export::ExportArgs),
    /// Write the results of a finished run into the REXS file that its scene came from
    Rexs(rexs::RexsArgs),
    /// Run the validation suite: every claim against its reference, with error, run time and work
    Validate(validate::ValidateArgs),
    /// Print the JSON schema of the scene: every key with its meaning, unit, range and default
    Schema(schema::SchemaArgs),
    /// Print completions for a shell
    Completions(completions::CompletionsArgs),
}

/// Runs the command the user typed.
pub fn main() -> ExitCode {
    ExitCode::from(out_of_memory::guarded(|| with_arguments(std::env::args_os())))
}

/// Runs the command in `arguments`, of which the first is the name of the program; gives its exit status.
pub fn with_arguments(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version are errors of clap too. A closed output is no failure.
            let _ = error.print();
            return u8::try_from(error.exit_code()).unwrap_or(WRONG_INPUT);
        }
    };
    let width = (!std::io::stderr().is_terminal()).then_some(UNBROKEN);
    let hook = miette::set_hook(Box::new(move |_| {
        let options = miette::MietteHandlerOpts::new();
        Box::new(width.map_or(options.clone(), |width| options.width(width)).build())
    }));
    debug_assert!(hook.is_ok(), "the hook is set once");
    let done = match &cli.command {
        Command::Init(args) => init::run(args),
        Command::Plan(args) => plan::run(args),
        Command::Mesh(args) => mesh::run(args),
        Command::Run(args) => run::run(args),
        Command::Explore(args) => explore::run(args),
        Command::Fem(args) => fem::run(args),
        Command::Accuracy(args) => accuracy::run(args),
        Command::Sweep(args) => sweep::run(args),
        Command::Uncertainty(args) => uncertainty::run(args),
        Command::Improve(args) => improve::run(args),
        Command::Calibrate(args) => calibrate::run(args),
        Command::Compare(args) => compare::run(args),
        Command::Export(args) => export::run(args),
        Command::Rexs(args) => rexs::run(args),
        Command::Validate(args) => validate::run(args),
        Command::Schema(args) => schema::run(args),
        Command::Completions(args) => completions::run(args),
    };
    match done {
        Ok(()) => 0,
        Err(failure) => {
            let status = failure.exit_status();
            failure.print();
            status
        }
    }
}

/// Prints warnings on standard error, so that results can be piped.
fn warn(warnings: &[String]) {
    for warning in warnings {
        say(&format!("warning: {warning}"));
    }
}

/// Prints a line on standard error; a closed stream is no failure.
fn say(text: &str) {
    let _ = writeln!(std::io::stderr(), "{text}");
}

/// Prints `text` as it is on standard output, which may be closed early, as by `gearwear schema | head`.
fn print(text: &str) -> Result<(), failure::Failure> {
    let mut out = std::io::stdout().lock();
    out.write_all(text.as_bytes()).and_then(|()| out.flush()).map_err(|error| match error.kind() {
        ErrorKind::BrokenPipe => failure::Failure::Closed,
        _ => failure::InputError::Stdout(error).into(),
    })
}

/// The command line, for completions.
fn command() -> clap::Command {
    <Cli as clap::CommandFactory>::command()
}
