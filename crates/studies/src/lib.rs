//! Questions to the library `gearwear` that take many runs: which model is accurate enough and cheapest ([`accuracy`]), which wear coefficients
//! explain measured profiles ([`compare`]), how long a gear lasts by measurements of its wear ([`remaining_life`]), which designs are better ([`improve`]), finished runs side by side ([`variants`]), the worn flank as a file ([`export`]).
#![allow(
    rustdoc::private_intra_doc_links,
    reason = "the documentation is read by those who work on it, private items with it"
)]
#![allow(missing_docs, reason = "internal to the workspace; names say what there is to say")]

pub mod accuracy;
pub mod compare;
pub mod export;
pub mod improve;
pub mod measurement;
pub mod remaining_life;
pub mod variants;
