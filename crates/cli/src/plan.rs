//! `gearwear plan`: what a run would do, and why.

use std::path::PathBuf;

use clap::ValueEnum;
use gearwear_bodies::gear::GearPair;
use gearwear_physics::assessment::RunError;
use gearwear_physics::plan::cost::{PlanAndCost, RunCost};

use gearwear::scene::loaded::LoadedScene;
use gearwear::scene::opened::OpenedScene;
use gearwear::scene::planetary::mesh::{PerMesh, StageMesh};
use gearwear_studies::improve::asked::ImproveQuestion;

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
    let planned = match OpenedScene::open(&args.scene)? {
        OpenedScene::Pair(scene) => {
            let whole = plan_and_cost(&scene)?;
            // A table [improve] is no part of a run, but a mistake in it is one of the scene.
            ImproveQuestion::of(&scene).map_err(Failure::Scene)?;
            warn(scene.warnings());
            match args.format {
                PlanFormat::Text => text(scene.resolved.title(), &whole),
                PlanFormat::Json => json(serde_json::to_string_pretty(&whole)),
            }
        }
        OpenedScene::Planetary(stage) => {
            let meshes = PerMesh::try_from_fn(|mesh| plan_and_cost(&stage.meshes[mesh]))?;
            warn(&stage.warnings);
            match args.format {
                PlanFormat::Text => {
                    let of_mesh = StageMesh::BOTH.map(|mesh| text(stage.meshes[mesh].resolved.title(), &meshes[mesh]));
                    of_mesh.join("\n")
                }
                PlanFormat::Json => json(serde_json::to_string_pretty(&meshes)),
            }
        }
    };
    print(&planned)
}

/// Stages of the run of a pair, and what they cost.
fn plan_and_cost(scene: &LoadedScene) -> Result<PlanAndCost, Failure> {
    scene.check_springs().map_err(|error| in_the_scene(error, scene))?;
    let plan = scene.plan();
    let pair = GearPair::new(&scene.scene().pair).map_err(RunError::from)?;
    let cost = RunCost::of(scene.scene(), &plan, &pair);
    Ok(PlanAndCost { plan, cost })
}

fn json(planned: Result<String, serde_json::Error>) -> String {
    planned.expect("a plan is names, texts and finite numbers") + "\n"
}

fn text(title: &str, PlanAndCost { plan, cost }: &PlanAndCost) -> String {
    let width = plan.stages.iter().chain(&plan.left_out).map(|stage| stage.kind.name().len()).max().unwrap_or(0);
    let [run, left_out] = [&plan.stages, &plan.left_out].map(|stages| -> String {
        stages.iter().map(|stage| format!("  {:width$}  {}\n", stage.kind.name(), stage.reason)).collect()
    });
    let [seconds, memory_gb] = [cost.seconds, cost.memory_gb].map(digits);
    format!("{title}\n\nStages\n{run}\nLeft out\n{left_out}\nSome {seconds} s on one thread, {memory_gb} GB\n")
}
