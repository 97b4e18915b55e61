//! The documents of the project say what is so: the tables of keys what the schemas say, the table of figures what their catalogue says,
//! the table of rooms what the imports are, links lead to something, and no document grows beyond its bar.
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
    let sources = ["file", "fem_file", "gear_file", "improve_file", "lubrication_file", "wear_file"];
    let sources = sources.map(|name| read(&format!("src/scene/{name}.rs"))).join("\n");
    check_generated("docs/scene.md", "keys", &key_tables::of_schema(gearwear::scene::schema::schema(), &sources));
}

/// What `[planetary]` has and `[pair]` has not.
#[test]
fn scene_document_has_every_key_of_a_stage() {
    let mut schema = gearwear::scene::schema::schema_of::<gearwear::scene::planetary::file::StageFile>();
    let pair = &gearwear::scene::schema::schema()["properties"]["pair"]["properties"];
    let mut source = read("src/scene/planetary/file.rs");
    let keys = schema.pointer_mut("/properties/planetary/properties").and_then(|keys| keys.as_object_mut());
    keys.expect("the schema of a stage has its table").retain(|key, _| {
        let is_of_stage = pair.get(key).is_none() && !["sun", "planet", "ring"].contains(&key.as_str());
        if !is_of_stage {
            source = source.replace(&format!("    pub {key}: "), "    ");
        }
        is_of_stage
    });
    let schema = &schema["properties"]["planetary"];
    check_generated("docs/scene.md", "planetary", &key_tables::of_schema(schema, &source));
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
fn links_of_documents_lead_somewhere() {
    let faults = links::broken(&in_repository(""));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn pages_that_the_repository_names_exist() {
    let faults = links::missing_pages(&in_repository(""));
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Words as `wc -w` counts them; the table of figures in docs/outputs.md, which is generated, is not counted.
#[test]
fn documents_stay_short() {
    let words = |text: &str| text.split_whitespace().count();
    let changelog = read("CHANGELOG.md");
    let unreleased = changelog.split("\n## ").find(|part| part.starts_with("[Unreleased]")).unwrap_or_default();
    let pages = links::pages(&in_repository("docs"));
    let in_pages: usize = pages.iter().map(|page| words(&fs::read_to_string(page).expect("a page can be read"))).sum();
    for (what, size, bar) in [
        ("words of ARCHITECTURE.md", words(&read("ARCHITECTURE.md")), 900),
        ("words of README.md", words(&read("README.md")), 900),
        ("words under Unreleased of CHANGELOG.md", words(unreleased), 600),
        ("pages in docs", pages.len(), 17),
        ("words of the pages in docs", in_pages - words(&figure_table::of_catalogue()), 35_000),
    ] {
        assert!(size <= bar, "{what}: {size}, at most {bar}");
    }
}
