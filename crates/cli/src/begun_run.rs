//! Start of a run: in a new folder, or from the checkpoint of an interrupted run of the same scene.

use std::fs;
use std::path::{Path, PathBuf};

use gearwear::report;
use gearwear::resume::file::CheckpointFile;
use gearwear::resume::folder::{self, FolderContents};
use gearwear::resume::identity::RunIdentity;
use gearwear::scene::loaded::LoadedScene;
use gearwear_physics::simulation::checkpoint::Checkpoint;

use super::failure::{Failure, InputError, in_the_scene};

pub(super) struct BegunRun {
    /// Scene, with input files as they lie in the folder.
    pub scene: LoadedScene,
    /// Folder, which holds the scene and the input files.
    pub out: PathBuf,
    pub identity: RunIdentity,
    /// Checkpoint to continue from; `None`: from the beginning.
    pub from: Option<Checkpoint>,
    /// Folder made at the beginning.
    pub made: Option<MadeFolder>,
}

/// Folder of a new run.
pub(super) struct MadeFolder {
    out: PathBuf,
    files: Vec<String>,
    /// Whether the folder is new.
    is_new: bool,
}

impl MadeFolder {
    /// Removes the files of a run that its scene does not allow. What cannot be removed stays.
    pub(super) fn abandon(&self) {
        folder::abandon(&self.out, &self.files);
        if self.is_new {
            // A folder with other files stays.
            let _ = fs::remove_dir(&self.out);
        }
    }
}

pub(super) fn begin(scene: LoadedScene, out: &Path) -> Result<BegunRun, Failure> {
    scene.check_springs().map_err(|error| in_the_scene(error, &scene))?;
    let (scene, identity) = named_as_copied(scene);
    report::writable(out)?;
    begin_anew(scene, identity, out)
}

/// File of the scene whose run in the folder `out` is to be continued: `scene`, or else the one in the folder.
pub(super) fn scene_to_resume(scene: Option<&Path>, out: &Path) -> Result<PathBuf, InputError> {
    let own = out.join(gearwear::report::output_files::SCENE);
    match scene {
        Some(scene) => Ok(scene.to_owned()),
        None if own.exists() => Ok(own),
        None => Err(InputError::NothingToResume { folder: out.display().to_string() }),
    }
}

/// Continues the run of `scene` in the folder `out`. `None` where it is complete.
pub(super) fn resume(scene: LoadedScene, out: &Path) -> Result<Option<BegunRun>, Failure> {
    let (mut scene, identity) = named_as_copied(scene);
    report::writable(out)?;
    let contents = folder::contents(out, &identity, &scene.resolved.scene_hash())
        .map_err(|error| InputError::Resume(Box::new(error)))?;
    match contents {
        FolderContents::Nothing | FolderContents::Begun => begin_anew(scene, identity, out).map(Some),
        FolderContents::Checkpoint(found) => {
            let CheckpointFile { warnings, checkpoint, .. } = *found;
            scene.resolved.warnings = warnings;
            Ok(Some(BegunRun { scene, out: out.to_owned(), identity, from: Some(checkpoint), made: None }))
        }
        FolderContents::Ended(stopped) if stopped.is_complete() => Ok(None),
        FolderContents::Ended(_) => Err(InputError::NothingLeft { folder: out.display().to_string() }.into()),
    }
}

fn named_as_copied(scene: LoadedScene) -> (LoadedScene, RunIdentity) {
    let scene = scene.naming_copies();
    let identity = RunIdentity::new(scene.resolved.to_toml(), &scene.files.as_read);
    (scene, identity)
}

fn begin_anew(scene: LoadedScene, identity: RunIdentity, out: &Path) -> Result<BegunRun, Failure> {
    let is_new = !out.exists();
    report::create_folder(out)?;
    folder::begin(out, &identity, &scene.files.as_read)?;
    let files = scene.files.as_read.iter().map(|file| file.name.clone()).collect();
    let made = Some(MadeFolder { out: out.to_owned(), files, is_new });
    Ok(BegunRun { scene, out: out.to_owned(), identity, from: None, made })
}
