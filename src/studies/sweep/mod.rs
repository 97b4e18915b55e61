//! Sweeps: the scene's run for all combinations of some varied keys.
//!
//! Each combination is a scene like any other: the user's file with some values exchanged, resolved anew. It is carried
//! out by [`crate::pipeline`] on one thread, and leaves one row of figures. Rows are kept in a journal as they are finished,
//! so that a sweep which was stopped goes on where it was; parts of a sweep that ran elsewhere are merged from their
//! journals.
//!
//! | module | what it does |
//! |---|---|
//! | [`asked`] | a sweep as it is asked for, checked |
//! | [`axis`] | a varied key as the user writes it, checked |
//! | [`goal`] | what is to be least, and what is as good within the error |
//! | [`combination`] | the scene of a combination, and its row |
//! | [`journal`] | the rows finished so far, kept on disk |
//! | [`study`] | what is left to do, and runs it on all threads |
//! | [`unfinished`] | a sweep under way, whoever runs its rows |
//! | [`mod@merge`] | one sweep from its parts |

pub(crate) mod asked;
pub(crate) mod axis;
pub(crate) mod combination;
pub(crate) mod goal;
pub(crate) mod journal;
pub(crate) mod merge;
pub(crate) mod record;
pub(crate) mod report;
pub(crate) mod study;
pub(crate) mod unfinished;
pub(crate) mod verification;
