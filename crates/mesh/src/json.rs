//! Meshes as JSON: the serde form of [`Mesh`], field by field.
//!
//! ```json
//! {"points": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], "cells": [{"type": "line", "nodes": [0, 1]}],
//!  "point_data": {"gap": {"components": 1, "values": {"reals": [0.5, "nan"]}}},
//!  "cell_data": {"body": [{"components": 1, "values": {"integers": [7]}}]},
//!  "point_sets": {"fixed": [0]}, "cell_sets": {"edge": [[0]]}, "field_data": {"edge": {"tag": 3, "dimension": 1}}}
//! ```
//!
//! JSON has no word for numbers that are not finite; in data they are the strings `"nan"`, `"inf"` and `"-inf"`. Numbers are
//! the shortest decimals that read back as the same bits.

use super::Mesh;
use super::error::{Fault, FilePosition, Problem};

/// Reads a mesh from JSON.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, Fault> {
    serde_json::from_slice(bytes).map_err(|error| Fault {
        place: Some(FilePosition::Line(error.line())),
        section: "JSON".into(),
        problem: Problem::unexpected(&error.to_string(), "a mesh with `points`, `cells`, …"),
    })
}

/// The mesh as JSON, ending in a line break.
pub(super) fn write(mesh: &Mesh) -> Vec<u8> {
    let mut text = serde_json::to_vec(mesh).expect("numbers, lists and maps keyed by strings always serialise");
    text.push(b'\n');
    text
}

/// Reals whose non-finite values are strings.
pub(super) mod reals {
    use std::borrow::Cow;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(untagged)]
    enum Real<'a> {
        Finite(f64),
        Named(Cow<'a, str>),
    }

    /// Serialises finite numbers as they are and others by name.
    pub(crate) fn serialize<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(values.iter().map(|&value| match value {
            value if value.is_finite() => Real::Finite(value),
            value if value.is_nan() => Real::Named("nan".into()),
            value => Real::Named(if value > 0.0 { "inf" } else { "-inf" }.into()),
        }))
    }

    /// The inverse of [`serialize`].
    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
        let values = Vec::<Real>::deserialize(deserializer)?;
        let number = |value| match value {
            Real::Finite(value) => Ok(value),
            Real::Named(name) => match name.as_ref() {
                "nan" => Ok(f64::NAN),
                "inf" => Ok(f64::INFINITY),
                "-inf" => Ok(f64::NEG_INFINITY),
                _ => Err(serde::de::Error::custom(format!("`{name}` is not a number, \"nan\", \"inf\" or \"-inf\""))),
            },
        };
        values.into_iter().map(number).collect()
    }
}
