//! The documents of the project say what is so: the tables of keys what the schemas say, the table of figures what their catalogue says, the table of rooms what the imports
//! are, and links lead to something.
#![allow(unreachable_pub, reason = "test modules are of one crate")]

mod figure_table;
mod key_tables;
mod links;
mod rooms;

use std::path::{Path, PathBuf};
use std::{env, fs};

/// Path of a file of the repository.
fn in_repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

fn read(path: &str) -> String {
    fs::read_to_string(in_repository(path)).unwrap_or_else(|error| panic!("{path}: {error}"))
}

/// Holds what stands between the marks `what` of `path` against `expected`; with the environment variable `UPDATE_DOCS` set to 1 writes it.
fn check_generated(path: &str, what: &str, expected: &str) {
    let (begin, end) = (&*format!("<!-- {what}:begin -->\n"), &*format!("<!-- {what}:end -->\n"));
    let text = read(path);
    let (before, rest) = text.split_once(begin).unwrap_or_else(|| panic!("{path}: no {begin}"));
    let (current, after) = rest.split_once(end).unwrap_or_else(|| panic!("{path}: no {end}"));
    if env::var("UPDATE_DOCS").is_ok_and(|value| value == "1") {
        fs::write(in_repository(path), format!("{before}{begin}{expected}{end}{after}"))
            .expect("the document can be written");
        return;
    }
    for (number, (is, should)) in current.lines().zip(expected.lines()).enumerate() {
        let line = before.lines().count() + 2 + number;
        assert_eq!(is, should, "{path}, line {line}: UPDATE_DOCS=1 cargo test --test documents writes it anew");
    }
    assert_eq!(current, expected, "{path}: UPDATE_DOCS=1 cargo test --test documents writes it anew");
}

#[test]
fn scene_document_has_every_key() {
    let sources = ["file", "fem_file", "lubrication_file", "wear_file"];
    let sources = sources.map(|name| read(&format!("src/scene/{name}.rs"))).join("\n");
    check_generated("docs/scene.md", "keys", &key_tables::of_schema(gearwear::scene_schema(), &sources));
}

#[test]
fn problem_document_has_every_key() {
    let source = read("src/scene/fem_problem/file.rs");
    check_generated("docs/fem-problems.md", "keys", &key_tables::of_schema(gearwear::fem_problem_schema(), &source));
}

#[test]
fn outputs_document_has_every_main_figure() {
    check_generated("docs/outputs.md", "figures", &figure_table::of_catalogue());
}

#[test]
fn imports_keep_to_the_table_of_rooms() {
    let faults = rooms::faults(&read("ARCHITECTURE.md"), &in_repository(""));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn rooms_stand_in_an_order() {
    let faults = rooms::upward_entries(&read("ARCHITECTURE.md"));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn links_of_documents_lead_somewhere() {
    let faults = links::broken(&in_repository(""));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}
