//! `gearwear rexs`: the results of a finished run written into the REXS file that its scene came from.

use std::fs::File;
use std::path::{Path, PathBuf};

use gearwear::exchange::rexs::RexsError;
use gearwear::exchange::rexs::container::{self, FileError};
use gearwear::exchange::rexs::mesh_stiffness::MeshStiffness;
use gearwear::exchange::rexs::results::{self, RunResults, StageResults, WearDepths};
use gearwear::report::ReportError;
use gearwear::scene::loaded::LoadedScene;
use gearwear::scene::planetary::mesh::PerMesh;
use gearwear_bodies::gear::PerGear;
use gearwear_files::whole_file;
use gearwear_studies::compare::run_folder::RunFolder;
use gearwear_studies::variants::finished_run::FinishedRun;

use super::failure::{Failure, InputError};
use super::{print, warn};

#[derive(Debug, clap::Args)]
pub(super) struct RexsArgs {
    /// The folder of a finished `gearwear run`
    run: PathBuf,
    /// The gear unit in REXS (versions 1.4 to 2.0, XML) that the run's scene came from; it is left as it is
    #[arg(long, value_name = "FILE")]
    into: PathBuf,
    /// Number of the cylindrical stage in the file, from 1; of a planetary stage that of a mesh of its sun with a planet. May be left out where there is one
    #[arg(long, value_name = "N")]
    stage: Option<usize>,
    /// The file to be written: all that FILE holds, with the results as attributes of the stage and its gears
    #[arg(long, value_name = "NEW")]
    out: PathBuf,
    /// Show no count of attributes, only what is wrong
    #[arg(long, short)]
    quiet: bool,
}

pub(super) fn run(args: &RexsArgs) -> Result<(), Failure> {
    let run = read(args)?;
    let name = args.into.display().to_string();
    let refused = |error| InputError::IntoRexs { name: name.clone(), error: Box::new(error) };
    let text = String::from_utf8(bytes_of(&args.into, refused)?).map_err(|error| {
        let before = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = before.iter().filter(|&&byte| byte == b'\n').count() + 1;
        InputError::NotUtf8 { name: name.clone(), line }
    })?;
    let written = match &run {
        FinishedResults::Pair(run) => results::with_results(&text, args.stage, run),
        FinishedResults::Stage(run) => results::with_results_of_stage(&text, args.stage, run),
    };
    let written = written.map_err(refused)?;
    whole_file::write(&args.out, |out| out.write_all(written.text.as_bytes()))
        .map_err(|source| ReportError::WriteFile { path: args.out.clone(), source })?;
    warn(&written.warnings);
    if args.quiet {
        return Ok(());
    }
    print(&format!(
        "{}: {} attributes of the format, {} with the prefix custom_gearwear_\nfile: {}\n",
        written.stage,
        written.standard,
        written.custom,
        args.out.display()
    ))
}

/// The bytes of a file, if it has an end; `refused` makes the failure of one that has none.
pub(super) fn bytes_of(file: &Path, refused: impl Fn(RexsError) -> InputError) -> Result<Vec<u8>, Failure> {
    let unreadable = |reason| InputError::Unreadable { name: file.display().to_string(), reason };
    let opened = File::open(file).map_err(unreadable)?;
    container::read(opened).map_err(|error| match error {
        FileError::Unreadable(reason) => unreadable(reason).into(),
        FileError::Rexs(error) => refused(error).into(),
    })
}

/// Results of a finished run of either kind.
enum FinishedResults {
    Pair(Box<RunResults>),
    Stage(Box<StageResults>),
}

/// Results of the finished run to be written.
fn read(args: &RexsArgs) -> Result<FinishedResults, Failure> {
    let folder = RunFolder::open(&args.run).map_err(InputError::RunFolder)?;
    if !folder.whole_summary["planetary"].is_object() {
        return Ok(FinishedResults::Pair(Box::new(of_pair(folder)?)));
    }
    let meshes = PerMesh::try_from_fn(|mesh| {
        of_pair(RunFolder::open(&args.run.join(mesh.folder())).map_err(InputError::RunFolder)?)
    })?;
    Ok(FinishedResults::Stage(Box::new(StageResults { summary: folder.whole_summary, meshes })))
}

/// Results of the run of a pair.
fn of_pair(folder: RunFolder) -> Result<RunResults, Failure> {
    let scene = LoadedScene::open(folder.scene_path())?;
    folder.check_scene(&scene.resolved).map_err(InputError::RunFolder)?;
    let finished = FinishedRun::of(folder.clone(), String::new()).map_err(InputError::RunFolder)?;
    let cycle = &finished.mesh_cycle;
    Ok(RunResults {
        summary: folder.whole_summary,
        pair: scene.scene().pair.clone(),
        mesh_stiffness: MeshStiffness {
            pinion_rotation_deg: cycle.get("pinion_rotation_deg").to_vec(),
            new_N_per_mm_um: cycle.get("mesh_stiffness_new_N_per_mm_um").to_vec(),
            worn_N_per_mm_um: cycle.get("mesh_stiffness_worn_N_per_mm_um").to_vec(),
        },
        wear_profile: PerGear::from_fn(|gear| {
            let (radius_mm, depth_um) = finished.wear_profile(gear);
            WearDepths { radius_mm, depth_um }
        }),
    })
}
