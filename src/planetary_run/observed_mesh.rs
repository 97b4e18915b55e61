//! The observer of a stage as that of one mesh's run: what is said of the pair is said of the stage.

use crate::scene::planetary::mesh::StageMesh;
use crate::scene::planetary::words::of_stage;
use gearwear_physics::observer::Observer;

pub(super) struct ObservedMesh<'a> {
    pub observer: &'a dyn Observer,
    pub mesh: StageMesh,
}

impl ObservedMesh<'_> {
    fn told(&self, text: &str) -> String {
        format!("{}: {}", self.mesh.in_words(), of_stage(text, self.mesh))
    }
}

impl Observer for ObservedMesh<'_> {
    fn stage(&self, name: &str) {
        self.observer.stage(&format!("{}: {name}", self.mesh.in_words()));
    }

    fn run_of(&self, number: usize, count: usize, name: &str) {
        self.observer.run_of(number, count, name);
    }

    fn progress(&self, done: f64, total: f64) {
        self.observer.progress(done, total);
    }

    fn counted(&self, done: usize, total: usize, things: &'static str, beside: &str) {
        self.observer.counted(done, total, things, beside);
    }

    fn warning(&self, text: &str) {
        self.observer.warning(&self.told(text));
    }

    fn announcement(&self, text: &str) {
        self.observer.announcement(&self.told(text));
    }

    fn interrupted(&self) -> bool {
        self.observer.interrupted()
    }

    fn gives_up(&self) -> bool {
        self.observer.gives_up()
    }
}
