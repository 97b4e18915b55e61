//! The table of rooms in ARCHITECTURE.md against the imports of the source.
//!
//! A room is a folder of `physics/src` or `src`, or a file there beside `lib.rs` and `main.rs`. Reading is line by line: comments and what follows
//! `#[cfg(test)]` with `mod tests` are left out.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Where the rooms are, those of the first crate above those of the second.
const SOURCES: [&str; 2] = ["physics/src", "src"];

/// A row of the table.
struct Room {
    name: String,
    /// Rooms, or modules of rooms, that it may use.
    may_use: Vec<String>,
    /// Whether it may use every room above it in the table.
    all_above: bool,
}

/// An import of another room.
struct Import {
    /// Below the root of the repository.
    file: String,
    line: usize,
    room: String,
    /// From the root of the crate on.
    path: String,
}

/// Imports that the table does not allow, rooms that it lacks or that are gone, and known imports that are gone.
pub fn faults(architecture: &str, root: &Path) -> Vec<String> {
    let table = table(architecture);
    let mut faults = Vec::new();
    let files: Vec<String> = SOURCES.iter().flat_map(|src| source_files(root, src)).collect();
    let names: BTreeSet<&str> = files.iter().filter_map(|file| room_of(file)).collect();
    for name in &names {
        if !table.iter().any(|room| room.name == *name) {
            faults.push(format!("ARCHITECTURE.md: no room {name} in the table"));
        }
    }
    for room in table.iter().filter(|room| !names.contains(room.name.as_str())) {
        faults.push(format!("ARCHITECTURE.md: the room {} is in none of {SOURCES:?}", room.name));
    }
    for file in &files {
        let text = fs::read_to_string(root.join(file)).expect("a source file can be read");
        for import in imports(file, &text, &names) {
            if !allowed(&table, &import) {
                let Import { file, line, room, path } = import;
                faults.push(format!("{file}:{line}: {room} may not use {path}"));
            }
        }
    }
    faults
}

/// Entries of the table that name a room which does not stand above: without them the table is an order without circles.
pub fn upward_entries(architecture: &str) -> Vec<String> {
    let table = table(architecture);
    let mut faults = Vec::new();
    for (index, room) in table.iter().enumerate() {
        for used in &room.may_use {
            let name = used.split("::").next().unwrap_or(used);
            if !table[..index].iter().any(|above| above.name == name) {
                faults.push(format!("ARCHITECTURE.md: {} may use {used}, which does not stand above it", room.name));
            }
        }
    }
    faults
}

fn allowed(table: &[Room], import: &Import) -> bool {
    let Some(index) = table.iter().position(|room| room.name == import.room) else { return false };
    let under =
        |used: &str| import.path.strip_prefix(used).is_some_and(|rest| rest.is_empty() || rest.starts_with("::"));
    table[index].may_use.iter().any(|used| under(used))
        || (table[index].all_above && table[..index].iter().any(|above| under(&above.name)))
}

/// The rows of the table whose head begins with "room": the first column names the room, the third what it may use.
fn table(architecture: &str) -> Vec<Room> {
    let rows = architecture.lines().skip_while(|line| !line.starts_with("| room |")).skip(2);
    rows.take_while(|line| line.starts_with('|'))
        .map(|line| {
            let cells: Vec<&str> = line.trim_matches('|').split(" | ").collect();
            let [name, .., may_use] = cells.as_slice() else { panic!("ARCHITECTURE.md: {line}") };
            let words = |cell: &str| cell.split('`').skip(1).step_by(2).map(str::to_owned).collect::<Vec<String>>();
            Room {
                name: words(name).first().unwrap_or_else(|| panic!("ARCHITECTURE.md: no name in {line}")).clone(),
                may_use: words(may_use),
                all_above: may_use.contains("all above"),
            }
        })
        .collect()
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
                if first != room && (rooms.contains(first) || first.is_empty()) {
                    let (file, path) = (file.to_owned(), path.to_owned());
                    found.push(Import { file, line: index + 1, room: room.to_owned(), path });
                }
            }
        }
    }
    found
}
