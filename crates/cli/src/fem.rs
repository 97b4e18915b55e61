//! `gearwear fem`: finite-element contact, of a problem with its own mesh or of a gear pair.

use gearwear::report::output_files;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

use gearwear::fem_problem::{self, FemProblemError};
use gearwear::report;
use gearwear::report::ReportError;
use gearwear::scene::fem_problem::FemProblem;
use gearwear::scene::loaded::SceneText;
use gearwear_physics::results::fem_problem::{FemRecord, FemSummary};
use gearwear_physics::results::run::StageTime;

use super::failure::{Failure, InputError};
use super::progress::Progress;
use super::run::pool;
use super::{fem_scene, figures, print, warn};

#[derive(Debug, clap::Args)]
pub(super) struct FemArgs {
    /// The file, TOML: a problem with its own [mesh], or a scene with a [pair]; - reads standard input
    file: PathBuf,
    /// The folder for the results; files of an earlier run are replaced
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Of a gear pair: the one position to solve, radius of curvature of the pinion in mm, from A to E; default: the mesh
    /// cycle
    #[arg(long, value_name = "MM", allow_negative_numbers = true)]
    pub position: Option<f64>,
    /// Of a gear pair: solve the whole model without condensation too, at --position or at A to E, and compare
    #[arg(long)]
    pub full: bool,
    /// Number of threads; default: all cores. Never changes the results
    #[arg(long, value_name = "N")]
    pub threads: Option<NonZeroUsize>,
    /// Show neither progress nor figures, only what is wrong
    #[arg(long, short)]
    pub quiet: bool,
}

impl FemArgs {
    /// Option that is given but applies to gear pairs only.
    fn of_a_pair(&self) -> Option<&'static str> {
        match self {
            Self { position: Some(_), .. } => Some("--position"),
            Self { full: true, .. } => Some("--full"),
            _ => None,
        }
    }
}

pub(super) fn run(args: &FemArgs) -> Result<(), Failure> {
    let text = SceneText::read(&args.file)?;
    // Text that is not TOML is refused by the reader that follows.
    let Ok(table) = text.text.parse::<toml::Table>() else {
        return if args.of_a_pair().is_some() { fem_scene::run(args, text) } else { problem(args, text) };
    };
    let has_pair = table.contains_key("pair") || table.contains_key("planetary");
    match (table.contains_key("mesh"), has_pair) {
        (true, true) => Err(InputError::MeshAndPair { name: text.name }.into()),
        (false, true) => fem_scene::run(args, text),
        _ => match args.of_a_pair() {
            Some(option) => Err(InputError::OnlyForPair { name: text.name, option }.into()),
            None => problem(args, text),
        },
    }
}

/// A problem with its own mesh.
fn problem(args: &FemArgs, text: SceneText) -> Result<(), Failure> {
    let problem = FemProblem::from_toml(&text.text).map_err(|problems| text.refused(problems))?;
    report::writable(&args.out)?;
    report::remove_summary(&args.out)?;
    let folder = args.file.parent().unwrap_or(Path::new(""));
    let progress = Progress::new(args.quiet, Arc::default());
    let pool = pool(args.threads)?;
    let record = pool.install(|| fem_problem::run(&problem, folder, &progress)).map_err(|error| match error {
        FemProblemError::Input(problems) => text.refused(problems).into(),
        FemProblemError::Memory(said) => Failure::Memory(said),
        FemProblemError::Solve(error) => Failure::Solve(error),
    });
    progress.finish();
    let mut record = record?;
    warn(&record.summary.warnings);
    write(&mut record, &args.out)?;
    if !args.quiet {
        let page = args.out.join(output_files::PAGE);
        print(&format!("{}report: {}\n", summary(&record.summary), page.display()))?;
    }
    Ok(())
}

/// The last stage: the output folder. Its own time is in the summary, which is therefore written last.
fn write(record: &mut FemRecord, out: &Path) -> Result<(), ReportError> {
    let start = Instant::now();
    report::fem::write_data_and_page(record, out)?;
    let wall_s = start.elapsed().as_secs_f64();
    record.summary.stages.push(StageTime { name: "report".to_owned(), wall_s });
    record.summary.wall_s += wall_s;
    report::write_summary(&record.summary, out).map(drop)
}

/// The main figures, for the terminal.
fn summary(summary: &FemSummary) -> String {
    let mut text = format!("{}\n\n", summary.title);
    for contact in &summary.contact {
        let names = format!("{} on {}", contact.slave, contact.master);
        text.push_str(&figures::row(&names, ["computed", "Hertz"]));
        let hertz = contact.hertz;
        let [x, y] = contact.force_N_per_mm.map_or([None; 2], |force| force.map(Some));
        let along_axis = contact.force_N.map(|[_, y]| y);
        for (name, value, other) in [
            ("maximum pressure, MPa", Some(contact.peak_pressure_MPa), hertz.map(|h| h.peak_pressure_MPa)),
            ("half-width, mm", Some(contact.half_width_mm), hertz.map(|h| h.half_width_mm)),
            ("force along x, N/mm", x, None),
            ("force along y, N/mm", y, None),
            ("force along the axis, N", along_axis, None),
        ] {
            let Some(value) = value else { continue };
            let other = other.map_or_else(String::new, figures::digits);
            text.push_str(&figures::row(name, [&figures::digits(value), &other]));
        }
    }
    if let Some(greatest) = summary.in_space {
        for (name, value, at_mm) in [
            ("maximum displacement, mm", greatest.greatest_displacement_mm, greatest.greatest_displacement_at_mm),
            ("maximum von Mises stress, MPa", summary.peak_von_mises_MPa, greatest.peak_von_mises_at_mm),
        ] {
            let [x, y, z] = at_mm.map(figures::digits);
            let row = figures::row(name, [&figures::digits(value), ""]);
            text.push_str(&format!("{} at {x}, {y}, {z} mm\n", row.trim_end()));
        }
    }
    let sets = match summary.in_space {
        Some(_) => String::new(),
        None => format!(", {} active-set iterations", summary.iterations),
    };
    text.push_str(&format!(
        "\n{} elements, {} degrees of freedom{sets}, computed in {:.2} s\n",
        summary.elements, summary.dofs, summary.wall_s
    ));
    text
}
