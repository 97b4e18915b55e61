//! The tables of rooms in ARCHITECTURE.md against the imports of the source.
//!
//! A room is a folder of a crate's source, or a file there beside `lib.rs`; it uses only rooms that stand above it in the table of its crate. Which crate
//! uses which, the compiler holds. Reading is line by line: comments and what follows `#[cfg(test)]` with `mod tests` are left out.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Sources that have a table of rooms, in the order of the tables.
const SOURCES: [&str; 3] = ["crates/bodies/src", "physics/src", "src"];

/// An import of another room.
struct Import {
    line: usize,
    /// Room of the file that imports.
    room: String,
    /// Room that is imported.
    used: String,
}

/// Imports of rooms that do not stand above, rooms that the tables lack, and rooms in them that are gone.
pub fn faults(architecture: &str, root: &Path) -> Vec<String> {
    let tables = tables(architecture);
    assert_eq!(tables.len(), SOURCES.len(), "ARCHITECTURE.md: a table of rooms for each of {SOURCES:?}");
    SOURCES.iter().zip(&tables).flat_map(|(source, table)| faults_of(source, table, root)).collect()
}

fn faults_of(source: &str, table: &[String], root: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    let files = source_files(root, source);
    let names: BTreeSet<&str> = files.iter().filter_map(|file| room_of(file)).collect();
    let lacking = names.iter().filter(|name| !table.iter().any(|room| room == *name));
    faults.extend(lacking.map(|name| format!("ARCHITECTURE.md: no room {name} in the table of {source}")));
    let gone = table.iter().filter(|room| !names.contains(room.as_str()));
    faults.extend(gone.map(|room| format!("ARCHITECTURE.md: there is no room {room} in {source}")));
    for file in &files {
        let text = fs::read_to_string(root.join(file)).expect("a source file can be read");
        for Import { line, room, used } in imports(file, &text, &names) {
            let place = |name: &str| table.iter().position(|room| room == name);
            if place(&used) >= place(&room) {
                faults.push(format!(
                    "{file}:{line}: {room} uses {used}, which does not stand above it in ARCHITECTURE.md"
                ));
            }
        }
    }
    faults
}

/// Rooms of each table whose head begins with "room", in their order.
fn tables(architecture: &str) -> Vec<Vec<String>> {
    let mut tables: Vec<Vec<String>> = Vec::new();
    let mut inside = false;
    for line in architecture.lines() {
        match line.split('`').nth(1) {
            _ if line.starts_with("| room |") => {
                inside = true;
                tables.push(Vec::new());
            }
            Some(name) if inside && line.starts_with("| `") => {
                tables.last_mut().expect("a table").push(name.to_owned())
            }
            _ => inside = inside && line.starts_with('|'),
        }
    }
    tables
}

/// All files below the folder `src` of `root`, in order, with `/` between folders.
fn source_files(root: &Path, src: &str) -> Vec<String> {
    let mut files = Vec::new();
    let mut folders: Vec<PathBuf> = vec![root.join(src)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder of src can be read") {
            let path = entry.expect("a folder of src can be read").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let below = path.strip_prefix(root).expect("it is below the root");
                let parts: Vec<String> = below.iter().map(|part| part.to_string_lossy().into_owned()).collect();
                files.push(parts.join("/"));
            }
        }
    }
    files.sort();
    files
}

/// A file's path below the source folder it is in.
fn below_src(file: &str) -> &str {
    SOURCES.iter().find_map(|src| file.strip_prefix(src)?.strip_prefix('/')).unwrap_or(file)
}

/// The room of a file; the roots of libraries and program and files of tests have none.
fn room_of(file: &str) -> Option<&str> {
    if file.ends_with("tests.rs") || file.contains("/tests/") {
        return None;
    }
    let first = below_src(file).split('/').next()?.trim_end_matches(".rs");
    (!matches!(first, "lib" | "main")).then_some(first)
}

/// What a file names of other rooms: by `crate::`, or by as many `super::` as lead to the root.
fn imports(file: &str, text: &str, rooms: &BTreeSet<&str>) -> Vec<Import> {
    let Some(room) = room_of(file) else { return Vec::new() };
    // Modules between this file and the root of the crate.
    let depth = below_src(file).trim_end_matches("/mod.rs").split('/').count();
    let to_root = "super::".repeat(depth);
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (index, line) in lines.iter().enumerate() {
        let next = lines.get(index + 1).map_or("", |next| next.trim());
        if line.trim() == "#[cfg(test)]" && next.starts_with("mod tests") {
            break;
        }
        if line.trim_start().starts_with("//") {
            continue;
        }
        for root in ["crate::", &to_root] {
            for (at, _) in line.match_indices(root) {
                let rest = &line[at + root.len()..];
                let end = rest.find(|c: char| !(c.is_alphanumeric() || c == '_' || c == ':')).unwrap_or(rest.len());
                let path = rest[..end].trim_end_matches(':');
                let first = path.split("::").next().unwrap_or(path);
                if first != room && rooms.contains(first) {
                    found.push(Import { line: index + 1, room: room.to_owned(), used: first.to_owned() });
                }
            }
        }
    }
    found
}
