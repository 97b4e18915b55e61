//! Improvement of a gear pair: free keys are chosen for two or three goals that contradict one another.
//!
//! A design is a value for each free key. Its figures y(x) come from a wear simulation, so that designs are looked for in two steps:
//!
//! 1. On a *fast model*, elastic half-planes on teeth whose stiffness finite elements gave once, at coarse resolution ([`fast_model`]). Designs that no
//!    other is better than in all goals are the *front*: y(x) is there where no x' has y_k(x') ≤ y_k(x) in every goal k and less in one ([`search`]).
//! 2. Designs spread over the front are run as `gearwear run` runs them, on finite elements, each with its error ([`study`]). Of these the proposals
//!    are chosen: what each gains and costs against the scene as given, whether that is more than the errors of both, and how much of it the tolerances
//!    of manufacture take ([`proposal`]).
//!
//! | module | what it does |
//! |---|---|
//! | [`free_key`], [`goal`] | what may change and what for, as the user writes it |
//! | [`asked`] | the question of a scene, checked, with its defaults |
//! | [`tip_reliefs`] | free keys of a scene that names none |
//! | [`fast_model`] | the model that is searched on |
//! | [`search`] | front of a problem with a few hundred evaluations |
//! | [`kept`] | designs finished so far, kept in the journal |
//! | [`study`] | all of it, in order |
//! | [`proposal`] | proposals with gains, costs and sensitivity |
//! | [`reach`] | what no design does |
//! | [`record`], [`words`], [`report`] | what was found, in words, and its files |

pub mod asked;
pub mod fast_model;
pub mod free_key;
pub mod goal;
pub mod kept;
pub mod proposal;
pub mod reach;
pub mod record;
pub mod report;
pub mod search;
pub mod study;
pub mod tip_reliefs;
pub mod words;
