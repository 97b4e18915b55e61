//! `gearwear plan`: what a run would do, and why.

use std::path::PathBuf;

use clap::ValueEnum;
use gearwear_bodies::gear::GearPair;
use gearwear_physics::assessment::RunError;
use gearwear_physics::plan::Plan;
use gearwear_physics::plan::cost::{PlanAndCost, RunCost};

use gearwear::scene::loaded::LoadedScene;

use super::failure::{Failure, in_the_scene};
use super::figures::digits;
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
    let pair = GearPair::new(&scene.scene().pair).map_err(RunError::from)?;
    let cost = RunCost::of(scene.scene(), &plan, &pair);
    print(&match args.format {
        PlanFormat::Text => text(scene.resolved.title(), &plan, &cost),
        PlanFormat::Json => {
            let whole = PlanAndCost { plan, cost };
            serde_json::to_string_pretty(&whole).expect("a plan is names, texts and finite numbers") + "\n"
        }
    })
}

fn text(title: &str, plan: &Plan, cost: &RunCost) -> String {
    let width = plan.stages.iter().chain(&plan.left_out).map(|stage| stage.kind.name().len()).max().unwrap_or(0);
    let [run, left_out] = [&plan.stages, &plan.left_out].map(|stages| -> String {
        stages.iter().map(|stage| format!("  {:width$}  {}\n", stage.kind.name(), stage.reason)).collect()
    });
    let [seconds, memory_gb] = [cost.seconds, cost.memory_gb].map(digits);
    format!("{title}\n\nStages\n{run}\nLeft out\n{left_out}\nSome {seconds} s on one thread, {memory_gb} GB\n")
}
