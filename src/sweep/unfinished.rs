//! A sweep in progress: the open tasks and the finished rows, whoever runs them.
//!
//! [`UnfinishedSweep::run`] runs what is left on the threads of this process. Engines that spread work over processes and machines take it
//! piece by piece: [`UnfinishedSweep::tasks`] says what is left, one text each; [`Sweep::carry_out`] does a task wherever it is, and comes
//! to the row as the line of the journal; [`UnfinishedSweep::keep`] keeps it. When all is there, there may be more to do: rows that
//! finite elements verify are chosen from all of them. Whoever runs a task, its row is the same but for its times.

use std::path::{Path, PathBuf};
use std::time::Instant;

use serde::Serialize;

use super::asked::{SweepError, SweepFault};
use super::combination::{Sweep, SweepTask};
use super::record::{Shard, SweepPart, SweepRecord};
use super::report;
use super::study;
use crate::journal::{Journal, JournalError};
use crate::report::columns::Table;
use crate::report::writable;
use crate::spread::SpreadOutcome;
use gearwear_physics::observer::Observer;

/// A sweep with the rows that are finished.
#[derive(Debug)]
pub struct UnfinishedSweep {
    sweep: Sweep,
    shard: Option<Shard>,
    journal: Journal<SweepPart>,
    folder: Option<PathBuf>,
    begun: Instant,
    /// Number of threads of the last start; 0 where the rows come from elsewhere.
    threads: usize,
}

impl UnfinishedSweep {
    /// Begins `sweep`, or continues it where `folder` has rows of it; without a folder the rows are kept in memory only.
    ///
    /// # Errors
    /// A sweep of which no combination makes a scene, or a folder with the rows of another one, or that cannot be written.
    pub fn begin(sweep: &Sweep, folder: Option<&Path>) -> Result<Self, SweepError> {
        Self::begin_part(sweep, folder, None).map_err(SweepError)
    }

    /// Begins a part of a sweep.
    pub fn begin_part(sweep: &Sweep, folder: Option<&Path>, shard: Option<Shard>) -> Result<Self, SweepFault> {
        if let Some(problems) = sweep.unbuildable() {
            return Err(SweepFault::NothingToVary(problems));
        }
        let begun = Instant::now();
        let part = SweepPart { identity: sweep.identity.clone(), shard };
        let journal = match folder {
            None => Journal::in_memory(part),
            Some(folder) => {
                writable(folder)?;
                let journal = Journal::open(folder, part)?;
                report::begin(sweep.scene_toml(), folder)?;
                journal
            }
        };
        Ok(Self { sweep: sweep.clone(), shard, journal, folder: folder.map(Path::to_owned), begun, threads: 0 })
    }

    /// Number of combinations of the sweep or shard.
    pub fn combinations(&self) -> usize {
        study::part(self.sweep.identity.combinations(), self.shard).count()
    }

    /// Number of finished combinations.
    pub fn finished(&self) -> usize {
        self.journal.contents.rows.len()
    }

    /// Number of rows verified by finite elements.
    pub fn verified(&self) -> usize {
        self.journal.contents.rows.values().filter(|row| row.verification.is_some()).count()
    }

    /// Tasks that can be done now, one text each: the missing combinations, then the rows to be verified by finite elements. Empty where the sweep is
    /// finished.
    ///
    /// # Errors
    /// None of a sweep whose rows have finite values.
    pub fn tasks(&self) -> Result<Vec<String>, SweepError> {
        let tasks = study::tasks(&self.sweep, self.shard, &self.journal.contents.rows);
        Ok(tasks.iter().map(text_of).collect::<Result<_, _>>()?)
    }

    /// Adds the result of a task: the line that [`Sweep::carry_out`] or [`Sweep::lost`] returned.
    ///
    /// # Errors
    /// A line that is no row of this sweep; a journal that cannot be written.
    pub fn keep(&mut self, line: &str) -> Result<(), SweepError> {
        let row = self.journal.contents.row(line).map_err(foreign)?;
        self.journal.append(row).map_err(|error| SweepFault::Journal(error).into())
    }

    /// Runs all open tasks in this process on `threads` threads; false where it was interrupted.
    ///
    /// # Errors
    /// A row that cannot be kept; the rows before it are.
    pub fn run(&mut self, threads: usize, observer: &dyn Observer) -> Result<bool, SweepError> {
        self.threads = threads;
        let ended = study::run(&self.sweep, self.shard, &mut self.journal, threads, observer);
        Ok(ended.map_err(SweepFault::Journal)? == SpreadOutcome::Completed)
    }

    /// Finishes the sweep and writes its files, where it has a folder.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(self) -> Result<SweepRecord, SweepError> {
        let record = SweepRecord {
            scene_toml: self.sweep.scene_toml().to_owned(),
            identity: self.sweep.identity,
            shard: self.shard,
            rows: self.journal.contents.rows.into_values().collect(),
            threads: self.threads,
            wall_s: self.begun.elapsed().as_secs_f64(),
        };
        if let Some(folder) = &self.folder {
            report::write(&record, folder).map_err(SweepFault::Report)?;
        }
        Ok(record)
    }
}

impl Sweep {
    /// Runs `task` in any process; returns its line of the journal, or `None` where it was interrupted. Any error of the combination becomes the
    /// error of its row.
    ///
    /// # Errors
    /// A text that is no task.
    pub fn carry_out(&self, task: &str, observer: &dyn Observer) -> Result<Option<String>, SweepError> {
        let row = self.row_of(&self.read(task)?, observer);
        Ok(row.map(|row| text_of(&row)).transpose()?)
    }

    /// Line of a task without a result for `reason`, such as the death of its process.
    ///
    /// # Errors
    /// A text that is no task.
    pub fn lost(&self, task: &str, reason: &str) -> Result<String, SweepError> {
        Ok(text_of(&match self.read(task)? {
            SweepTask::Run(index) => self.failed(index, reason),
            SweepTask::Verify { row, chosen } => row.verified(chosen, self.not_verified(reason), 0.0),
        })?)
    }

    fn read(&self, text: &str) -> Result<SweepTask, SweepFault> {
        let task: SweepTask = serde_json::from_str(text).map_err(foreign)?;
        let index = match &task {
            SweepTask::Run(index) => *index,
            SweepTask::Verify { row, .. } => row.index,
        };
        if index < self.identity.combinations() {
            return Ok(task);
        }
        Err(foreign(format!("combination {index} of {}", self.identity.combinations())))
    }
}

fn text_of(of: &impl Serialize) -> Result<String, SweepFault> {
    serde_json::to_string(of).map_err(foreign)
}

fn foreign(found: impl ToString) -> SweepFault {
    JournalError::Foreign { found: found.to_string() }.into()
}

impl SweepRecord {
    /// `sweep.csv` as columns.
    pub fn table(&self) -> Table {
        report::tables::table(self)
    }

    /// `sweep.json`.
    ///
    /// # Errors
    /// None that is known.
    pub fn summary_json(&self) -> serde_json::Result<String> {
        serde_json::to_string(&self.summary())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::columns::Values;
    use crate::scene::loaded::LoadedScene;
    use crate::sweep::asked::SweepQuestion;
    use gearwear_physics::observer::Unwatched;

    /// Whoever runs a task, its row is kept; one that was lost is a failed row, and what is not of the sweep is refused.
    #[test]
    fn tasks_and_rows_are_texts() {
        let scene = LoadedScene::preset("thesis-spur").unwrap();
        let vary = vec!["operation.pinion_torque_Nm=-1,302".to_owned()];
        let sweep = Sweep::of(&scene, &SweepQuestion { vary, ..SweepQuestion::default() }).unwrap();
        assert_eq!(sweep.warnings().len(), 1);
        let mut unfinished = UnfinishedSweep::begin(&sweep, None).unwrap();
        let tasks = unfinished.tasks().unwrap();
        assert_eq!(tasks, [r#"{"run":0}"#, r#"{"run":1}"#]);
        unfinished.keep(&sweep.carry_out(&tasks[0], &Unwatched).unwrap().unwrap()).unwrap();
        let lost = sweep.lost(&tasks[1], "its worker\ndied").unwrap();
        assert!(unfinished.keep(&lost.replace("\"index\":1", "\"index\":2")).is_err());
        unfinished.keep(&lost).unwrap();
        assert_eq!((unfinished.finished(), unfinished.combinations(), unfinished.tasks().unwrap().len()), (2, 2, 0));
        for foreign in [r#"{"run":2}"#, "nothing"] {
            let said = sweep.carry_out(foreign, &Unwatched).unwrap_err().to_string();
            assert!(said.contains("allowed: tasks and rows of this sweep"), "{said}");
        }
        let table = unfinished.finish().unwrap().table();
        let errors = table.columns.iter().find(|column| column.name == "error").unwrap();
        let Values::Words(errors) = &errors.values else { panic!("{errors:?}") };
        assert!(errors[0].contains("greater than 0") && errors[1] == "its worker died", "{errors:?}");
    }
}
