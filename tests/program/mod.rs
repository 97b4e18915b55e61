//! What the tests that run the program share.

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// The program.
pub fn gearwear() -> Command {
    Command::new(assert_cmd::cargo::cargo_bin!("gearwear"))
}

/// The scene that `gearwear init NAME` prints.
pub fn preset(name: &str) -> String {
    let output = gearwear().args(["init", name]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// A preset's scene with parts of its text exchanged.
pub fn exchanged(name: &str, edits: &[(&str, &str)]) -> String {
    let mut text = preset(name);
    for (from, to) in edits {
        assert!(text.contains(from), "{from}");
        text = text.replace(from, to);
    }
    text
}

/// A JSON file.
pub fn json(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}
