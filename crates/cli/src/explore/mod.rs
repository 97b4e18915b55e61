//! `gearwear explore`: a local page on which a pair is turned like a model in the hand.
//!
//! The page is compiled in, its answers come from a session of the library ([`gearwear::explore`]). The server listens on the loopback address alone, and serves
//! nobody who does not know the word in the address that it prints ([`access`]). It writes no file: what is saved, the browser saves.

mod access;
mod desk;
mod routes;
mod server;
mod windows;

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::sync::Arc;

use gearwear::explore::{ExploreError, Session};
use gearwear::scene::loaded::{LoadedScene, SceneError};
use gearwear_physics::observer::Observer;

use super::failure::{Failure, InputError};
use super::progress::Progress;
use super::run::{pool, thread_count, watch_for_interrupt};
use super::{print, say, warn};
use access::Access;
use desk::Desk;

#[derive(Debug, clap::Args)]
pub(super) struct ExploreArgs {
    /// The scene file; - reads standard input
    scene: PathBuf,
    /// Port on the loopback address; default: a free one
    #[arg(long, value_name = "N", default_value_t = 0)]
    port: u16,
    /// Do not open the browser; the address is printed anyhow
    #[arg(long)]
    no_browser: bool,
    /// Number of threads; default: all cores. Never changes the results
    #[arg(long, value_name = "N")]
    threads: Option<NonZeroUsize>,
}

pub(super) fn run(args: &ExploreArgs) -> Result<(), Failure> {
    let scene = LoadedScene::open(&args.scene)?;
    warn(scene.warnings());
    let (listener, port) = server::bind(args.port).map_err(|error| InputError::Port { port: args.port, error })?;
    let interrupted = watch_for_interrupt();
    let progress = Progress::new(false, Arc::clone(&interrupted));
    progress.stage("calibration of the fast model");
    let session = pool(args.threads)?.install(|| Session::open(scene.clone(), &progress));
    progress.finish();
    let session = session.map_err(|error| refused(error, &scene))?;
    let access = Access::new(port).map_err(InputError::Server)?;
    print(&format!("{}\n", access.page()))?;
    say("open it in a browser; the program ends with the window, or by Ctrl-C");
    if !args.no_browser && open::that_detached(access.page()).is_err() {
        say("no browser could be opened: open the address above in one");
    }
    let desk = Desk::new(session, thread_count(args.threads), Arc::clone(&interrupted))?;
    server::serve(listener, desk, access, &interrupted).map_err(InputError::Server)?;
    Ok(())
}

/// Failure of a scene that cannot be explored.
fn refused(error: ExploreError, scene: &LoadedScene) -> Failure {
    match error {
        ExploreError::Scene(problems) => Failure::Scene(SceneError { given: (*scene.given).clone(), problems }),
        ExploreError::Load(error) => error.into(),
        ExploreError::Run(error) => super::failure::in_the_scene(error, scene),
        ExploreError::Interrupted => Failure::Interrupted,
        other => Failure::Input(InputError::Explore(other)),
    }
}
