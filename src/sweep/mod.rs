//! Sweeps: the scene's run for all combinations of some varied keys.
//!
//! Each combination is a scene like any other: the user's file with some values exchanged, resolved anew. It is carried
//! out by [`gearwear_physics::assessment`] on one thread, and leaves one row of figures. Rows are kept in a journal as they are finished,
//! so that a sweep which was stopped goes on where it was; parts of a sweep that ran elsewhere are merged from their
//! journals.
//!
//! | module | what it does |
//! |---|---|
//! | [`asked`] | a sweep as it is asked for, checked |
//! | [`axis`] | a varied key as the user writes it, checked |
//! | [`goal`] | what is to be least, and what is as good within the error |
//! | [`minimum`] | least value of a figure, and how far it is one |
//! | [`combination`] | the scene of a combination, and its row |
//! | [`crate::journal`] | the rows finished so far, kept on disk |
//! | [`study`] | what is left to do, and runs it on all threads |
//! | [`unfinished`] | a sweep under way, whoever runs its rows |
//! | [`mod@merge`] | one sweep from its parts |
//!
//! ```
//! use gearwear::sweep::{Sweep, SweepQuestion, UnfinishedSweep};
//! use gearwear::{LoadedScene, Unwatched};
//!
//! let scene = LoadedScene::preset("thesis-spur")?.with("contact.surface", "hertz-mean")?.with("numerics.positions", 40)?;
//! let vary = vec!["operation.pinion_torque_Nm=200,300".to_owned()];
//! let sweep = Sweep::of(&scene, &SweepQuestion { vary, ..SweepQuestion::default() })?;
//! // Kept in memory; with a folder, in the journal that `gearwear sweep` goes on with.
//! let mut unfinished = UnfinishedSweep::begin(&sweep, None)?;
//! for task in unfinished.tasks()? {
//!     // On any machine.
//!     let row = sweep.carry_out(&task, &Unwatched)?.expect("nobody interrupts it");
//!     unfinished.keep(&row)?;
//! }
//! assert_eq!((unfinished.finished(), unfinished.tasks()?.len()), (2, 0));
//! let table = unfinished.finish()?.table();
//! assert_eq!(table.columns[0].name, "index");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

pub mod asked;
pub mod axis;
pub mod combination;
pub mod goal;
pub mod merge;
pub mod minimum;
pub mod record;
pub mod report;
pub mod study;
pub mod unfinished;
pub mod verification;

pub use asked::{SweepError, SweepQuestion};
pub use combination::Sweep;
pub use record::SweepRecord;
pub use unfinished::UnfinishedSweep;
