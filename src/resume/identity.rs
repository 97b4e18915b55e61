//! Identity of the run of a checkpoint: the resolved scene, and the contents of the files it names.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use toml::{Table, Value};

use crate::scene::loaded::NamedFile;
use gearwear_files::content_hash::sha256;

/// Inputs of a run.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RunIdentity {
    /// The resolved scene.
    pub scene_toml: String,
    /// SHA-256 of the file that each key of the scene names.
    pub inputs: BTreeMap<String, String>,
}

impl RunIdentity {
    /// Of a run of the resolved scene `scene_toml` with `files`.
    pub fn new(scene_toml: String, files: &[NamedFile]) -> Self {
        Self { scene_toml, inputs: files.iter().map(|file| (file.key.to_owned(), sha256(&file.bytes))).collect() }
    }

    /// Differences from `asked`: each key with both values.
    pub fn differences(&self, asked: &Self) -> Vec<String> {
        let mut differences = between_scenes(&self.scene_toml, &asked.scene_toml);
        let keys: std::collections::BTreeSet<_> = self.inputs.keys().chain(asked.inputs.keys()).collect();
        for key in keys {
            let [there, here] = [self, asked].map(|identity| identity.inputs.get(key));
            // A file that only one of them names already differs in its key.
            if let (Some(there), Some(here)) = (there, here)
                && there != here
            {
                differences.push(format!("the file of {key}: contents {} there, {} here", &there[..8], &here[..8]));
            }
        }
        differences
    }
}

/// Keys in which two resolved scenes differ, with both values.
pub fn between_scenes(there: &str, here: &str) -> Vec<String> {
    if there == here {
        return Vec::new();
    }
    let [there, here] = [there, here].map(values);
    let all: std::collections::BTreeSet<_> = there.keys().chain(here.keys()).collect();
    let mut differences = Vec::new();
    for key in all {
        let [there, here] = [&there, &here].map(|values| values.get(key).map_or("nothing", String::as_str));
        if there != here {
            differences.push(format!("{key}: {there} there, {here} here"));
        }
    }
    if differences.is_empty() { vec!["the text of the scene".to_owned()] } else { differences }
}

/// Values of a scene by the paths of their keys.
fn values(scene: &str) -> BTreeMap<String, String> {
    let mut values = BTreeMap::new();
    if let Ok(table) = scene.parse::<Table>() {
        flatten("", &Value::Table(table), &mut values);
    }
    values
}

/// Every value below `path` with the path of its key.
fn flatten(path: &str, value: &Value, keys: &mut BTreeMap<String, String>) {
    match value {
        Value::Table(table) => {
            for (key, value) in table {
                let path = if path.is_empty() { key.clone() } else { format!("{path}.{key}") };
                flatten(&path, value, keys);
            }
        }
        Value::Array(list) if !list.is_empty() && list.iter().all(Value::is_table) => {
            for (index, value) in list.iter().enumerate() {
                flatten(&format!("{path}[{index}]"), value, keys);
            }
        }
        value => {
            keys.insert(path.to_owned(), value.to_string());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn identity(scene_toml: &str, bytes: &[u8]) -> RunIdentity {
        let file = NamedFile { key: "stiffness.curve", name: "c.csv".to_owned(), bytes: bytes.to_vec() };
        RunIdentity::new(scene_toml.to_owned(), &[file])
    }

    #[test]
    fn differences_are_told_key_by_key() {
        let there = identity("[operation]\nhours = 1.0\n[[operation.phases]]\nhours = 1.0\n", b"a");
        let here = identity("title = \"x\"\n[operation]\nhours = 2.0\n[[operation.phases]]\nhours = 2.0\n", b"b");
        assert_eq!(there.differences(&there), Vec::<String>::new());
        let differences = there.differences(&here);
        assert_eq!(
            differences[..3],
            [
                "operation.hours: 1.0 there, 2.0 here",
                "operation.phases[0].hours: 1.0 there, 2.0 here",
                "title: nothing there, \"x\" here"
            ]
        );
        assert!(differences[3].starts_with("the file of stiffness.curve: contents "), "{differences:?}");
        assert_eq!(between_scenes("a = 1 # one\n", "a = 1\n"), ["the text of the scene"]);
    }
}
