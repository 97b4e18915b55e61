//! Meshes as JSON, the serde form of [`Mesh`].
//!
//! ```json
//! {"points": [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0]], "cells": [{"type": "line", "nodes": [0, 1]}],
//!  "point_data": {"gap": {"components": 1, "values": {"reals": [0.5, "nan"]}}},
//!  "cell_data": {"body": [{"components": 1, "values": {"integers": [7]}}]},
//!  "point_sets": {"fixed": [0]}, "cell_sets": {"edge": [[0]]}, "field_data": {"edge": {"tag": 3, "dimension": 1}}}
//! ```
//!
//! Numbers that are not finite are the strings `"nan"`, `"inf"` and `"-inf"`, others the shortest decimals that read back as the same bits.

use super::Mesh;
use super::error::{FileFault, FilePosition, FileProblem};

/// Reads a mesh from JSON.
pub(super) fn read(bytes: &[u8]) -> Result<Mesh, FileFault> {
    serde_json::from_slice(bytes).map_err(|error| FileFault {
        place: Some(FilePosition::Line(error.line())),
        section: "JSON".into(),
        problem: FileProblem::unexpected(&error.to_string(), "a mesh with `points`, `cells`, …"),
    })
}

/// JSON of a mesh, with a line break at the end.
pub(super) fn write(mesh: &Mesh) -> Vec<u8> {
    let mut text = serde_json::to_vec(mesh).expect("numbers, lists and maps keyed by strings always serialise");
    text.push(b'\n');
    text
}

/// Serde form of reals whose non-finite values are strings.
pub(super) mod reals {
    use std::borrow::Cow;

    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(untagged)]
    enum Real<'a> {
        Finite(f64),
        Named(Cow<'a, str>),
    }

    /// Serialises finite numbers as numbers and others by name.
    pub(crate) fn serialize<S: Serializer>(values: &[f64], serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(values.iter().map(|&value| match value {
            value if value.is_finite() => Real::Finite(value),
            value if value.is_nan() => Real::Named("nan".into()),
            value => Real::Named(if value > 0.0 { "inf" } else { "-inf" }.into()),
        }))
    }

    /// Inverse of [`serialize`].
    pub(crate) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<f64>, D::Error> {
        let values = Vec::<Real>::deserialize(deserializer)?.into_iter().map(|value| match value {
            Real::Finite(value) => Ok(value),
            Real::Named(name) => match name.as_ref() {
                "nan" => Ok(f64::NAN),
                "inf" => Ok(f64::INFINITY),
                "-inf" => Ok(f64::NEG_INFINITY),
                _ => Err(serde::de::Error::custom(format!("`{name}` is not a number, \"nan\", \"inf\" or \"-inf\""))),
            },
        });
        values.collect()
    }
}
