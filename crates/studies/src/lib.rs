//! Questions to the library `gearwear` that take many runs: which model is accurate enough and cheapest ([`accuracy`]), which wear coefficients
//! explain measured profiles ([`compare`]), finished runs side by side ([`variants`]).
#![allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]

pub mod accuracy;
pub mod compare;
pub mod measurement;
pub mod variants;
