//! The scene of a combination, and its row.

use std::time::Instant;

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::evaluate::figure;
use crate::evaluate::output::SummaryOutput;
use crate::scene::Problem;
use crate::scene::draft::Draft;
use crate::scene::opened::{EachMesh, OpenedScene};
use crate::scene::planetary::mesh::StageMesh;
use crate::sweep::goal::Goal;
use crate::sweep::record::{SweepAxis, SweepIdentity, SweepRow};
use crate::sweep::verification::Chosen;
use crate::varied_scene::{StudiedRun, VariedScene, in_words, one_line};
use gearwear_physics::assessment::guarded::guarded;
use gearwear_physics::observer::Observer;
use gearwear_physics::plan::{Plan, StageKind};
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::run::StopReason;

/// Something to do of a sweep: what one thread, wherever it is, does from beginning to end.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum SweepTask {
    /// A combination is to be run.
    Run(usize),
    /// A finished row is to be verified.
    Verify { row: Box<SweepRow>, chosen: Chosen },
}

/// A sweep that can be run.
#[derive(Debug, Clone)]
pub struct Sweep {
    pub identity: SweepIdentity,
    varied: VariedScene,
    /// Columns beside those of every sweep.
    outputs: Vec<SummaryOutput>,
}

impl Sweep {
    /// The sweep of the scene `given`.
    ///
    /// Snapshots are left out, as a row keeps only the end of the run; errors are estimated only where asked for, and rows verified
    /// only where the scene asks for it by name, or where there is a goal and the scene does not refuse it.
    pub fn new(
        given: &OpenedScene,
        axes: Vec<SweepAxis>,
        goal: Option<Goal>,
        error_estimate: bool,
        outputs: Vec<SummaryOutput>,
    ) -> Result<Self, Vec<Problem>> {
        let draft = Draft::parse(&given.given().text)?;
        let kind = given.kind();
        let mut figures: Vec<String> = figure::in_sweeps(kind).iter().map(|figure| figure.name.clone()).collect();
        let is_verified = |path: &str| figure::claims(kind).iter().any(|claim| claim.name == path);
        let of_meshes = StageMesh::BOTH.map(|mesh| format!("{}.numerics.verify", mesh.table()));
        let asks_by_name = draft.gives("numerics.verify") || of_meshes.iter().any(|key| draft.gives(key));
        let mut own = Vec::new();
        for output in outputs {
            if !figures.contains(&output.path) && !is_verified(&output.path) {
                figures.push(output.path.clone());
                own.push(output);
            }
        }
        let identity = SweepIdentity {
            kind,
            title: given.title().to_owned(),
            program_version: env!("CARGO_PKG_VERSION").to_owned(),
            scene_hash: given.scene_hash(),
            given_hash: draft.hash(),
            inputs_hash: given.inputs_hash(),
            error_estimate,
            verify: given.verifies() && (asks_by_name || goal.is_some()),
            axes,
            figures,
            goal,
        };
        let varied = VariedScene::new(given, error_estimate)?;
        let varied = varied.with_torque_curve(own.iter().any(SummaryOutput::is_of_torque_curve));
        Ok(Self { identity, varied, outputs: own })
    }

    /// The scene, as the user gave it.
    pub fn scene_toml(&self) -> &str {
        self.varied.given_text()
    }

    /// The scene of combination `index`, which is not verified.
    pub fn scene(&self, index: usize) -> Result<OpenedScene, Vec<Problem>> {
        let values = self.identity.values(index);
        self.varied.resolved(self.identity.axes.iter().zip(values).map(|(axis, value)| {
            let value = match axis.word(value) {
                Some(truth @ ("true" | "false")) => toml::Value::Boolean(truth == "true"),
                Some(word) => toml::Value::String(word.to_owned()),
                // The values were checked to be whole; the cast keeps any that a scene allows.
                None if axis.whole => toml::Value::Integer(value as i64),
                None => toml::Value::Float(value),
            };
            (axis.key.as_str(), value)
        }))
    }

    /// Problems of the first combination, where no combination is a valid scene.
    pub fn unbuildable(&self) -> Option<String> {
        let first = self.scene(0).err()?;
        let all = (1..self.identity.combinations()).all(|index| self.scene(index).is_err());
        all.then(|| in_words(&first))
    }

    /// Runs combination `index`; `None` where it was interrupted. Any error, a panic included, becomes the error of the row.
    ///
    /// Whatever goes wrong with it is its row's error, a defect of the program included.
    fn row(&self, index: usize, observer: &dyn Observer) -> Option<SweepRow> {
        let start = Instant::now();
        let run = guarded(|| self.run(index, observer));
        let run = run.unwrap_or_else(|said| Err(format!("a defect of the program: {said}")));
        let row = match run {
            Ok(run) if run.summary().stopped() == StopReason::Interrupted => return None,
            Ok(run) => SweepRow {
                figures: self.figures(&run),
                warnings: Some(run.summary().warnings()),
                simulation_s: run.simulation_s(),
                ..self.empty(index)
            },
            Err(_) if observer.interrupted() => return None,
            Err(error) => self.failed(index, &error),
        };
        Some(SweepRow { wall_s: start.elapsed().as_secs_f64(), ..row })
    }

    /// The figures of a row, in the order of the identity.
    fn figures(&self, run: &StudiedRun) -> Vec<Option<f64>> {
        let main = figure::in_sweeps(self.identity.kind).iter().map(|figure| figure.value(run));
        let whole = if self.outputs.is_empty() { Value::Null } else { serde_json::json!(run.summary()) };
        let own = self.outputs.iter().map(|output| output.of(&whole));
        main.chain(own).map(|value| value.filter(|value| value.is_finite())).collect()
    }

    fn empty(&self, index: usize) -> SweepRow {
        let (values, figures) = (self.identity.values(index), vec![None; self.identity.figures.len()]);
        SweepRow { index, values, figures, ..SweepRow::default() }
    }

    /// Does `task`; `None` where it was interrupted.
    pub fn row_of(&self, task: &SweepTask, observer: &dyn Observer) -> Option<SweepRow> {
        match task {
            SweepTask::Run(index) => self.row(*index, observer),
            SweepTask::Verify { row, chosen } => self.verified(row, *chosen, observer),
        }
    }

    /// The row of combination `index` with an error and no figures.
    pub fn failed(&self, index: usize, reason: &str) -> SweepRow {
        SweepRow { error: Some(one_line(reason)), ..self.empty(index) }
    }

    fn run(&self, index: usize, observer: &dyn Observer) -> Result<StudiedRun, String> {
        let scene = self.scene(index).map_err(|problems| in_words(&problems))?;
        self.varied.inputs_belong_to(&scene)?;
        self.varied.run(&scene, observer)
    }

    /// The row `row` verified by finite elements; `None` where that was interrupted. Its run is repeated with the same result: the best rows are
    /// known only at the end, and keeping the state of every run would take much memory.
    ///
    /// Its run is done again and comes to the same bits: which rows are the best is known when all are there, and what a verification
    /// starts from would be much to keep of each until then.
    fn verified(&self, row: &SweepRow, chosen: Chosen, observer: &dyn Observer) -> Option<SweepRow> {
        let start = Instant::now();
        let total = guarded(|| self.total_error(row.index, observer));
        let total = total.unwrap_or_else(|said| Err(format!("a defect of the program: {said}")));
        if observer.interrupted() {
            return None;
        }
        let total = total.unwrap_or_else(|reason| self.not_verified(&reason));
        Some(row.clone().verified(chosen, total, start.elapsed().as_secs_f64()))
    }

    /// Errors of a row that is not verified for `reason`.
    pub fn not_verified(&self, reason: &str) -> EachMesh<TotalError> {
        EachMesh::alike(self.identity.kind, TotalError::none(&one_line(reason)))
    }

    fn total_error(&self, index: usize, observer: &dyn Observer) -> Result<EachMesh<TotalError>, String> {
        let mut scene = self.scene(index).map_err(|problems| in_words(&problems))?;
        self.varied.verify_as_given(&mut scene);
        scene.change_each(|pair| pair.resolved.scene.numerics.error_estimate = false);
        let left_out = scene
            .each()
            .map(|pair| Plan::of(pair.scene()).left_out_because(StageKind::Verification).map(str::to_owned));
        // Where one mesh has an answer, the other says why it has none.
        match left_out.all().into_iter().cloned().collect::<Option<Vec<String>>>() {
            Some(reasons) => Err(reasons.join("; ")),
            None => Ok(self.varied.run(&scene, observer)?.total_errors()),
        }
    }
}
