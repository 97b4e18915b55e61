//! `gearwear plan`: what a run would do, and why.

use std::path::PathBuf;

use clap::ValueEnum;
use gearwear_physics::plan::Plan;

use gearwear::scene::loaded::LoadedScene;

use super::failure::{Failure, in_the_scene};
use super::{print, warn};

#[derive(Debug, clap::Args)]
pub(super) struct PlanArgs {
    /// The scene file; - reads standard input
    scene: PathBuf,
    /// How to print the plan
    #[arg(long, value_enum, default_value_t = PlanFormat::Text)]
    format: PlanFormat,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PlanFormat {
    /// For people
    Text,
    /// For scripts
    Json,
}

pub(super) fn run(args: &PlanArgs) -> Result<(), Failure> {
    let scene = LoadedScene::open(&args.scene)?;
    scene.check_springs().map_err(|error| in_the_scene(error, &scene))?;
    warn(scene.warnings());
    let plan = scene.plan();
    print(&match args.format {
        PlanFormat::Text => text(scene.resolved.title(), &plan),
        PlanFormat::Json => serde_json::to_string_pretty(&plan).expect("a plan is names and texts") + "\n",
    })
}

fn text(title: &str, plan: &Plan) -> String {
    let width = plan.stages.iter().chain(&plan.left_out).map(|stage| stage.kind.name().len()).max().unwrap_or(0);
    let [run, left_out] = [&plan.stages, &plan.left_out].map(|stages| -> String {
        stages.iter().map(|stage| format!("  {:width$}  {}\n", stage.kind.name(), stage.reason)).collect()
    });
    format!("{title}\n\nStages\n{run}\nLeft out\n{left_out}")
}
