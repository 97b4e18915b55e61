//! Relative links of the documents: the file is there, and so is the heading.

use std::fs;
use std::path::{Path, PathBuf};

/// Links that lead nowhere, each with its file and line.
pub fn broken(root: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    for file in documents(root) {
        let text = fs::read_to_string(&file).expect("a document can be read");
        for (number, line) in lines_outside_code(&text) {
            for target in targets(line) {
                if let Some(why) = fault(&file, target) {
                    let shown = file.strip_prefix(root).unwrap_or(&file).display();
                    faults.push(format!("{shown}:{number}: {target}: {why}"));
                }
            }
        }
    }
    faults
}

/// Markdown files at the top, in `docs`, in `meshes` and of the cross-check.
fn documents(root: &Path) -> Vec<PathBuf> {
    ["", "docs", "meshes", "validation/cross-check"].iter().flat_map(|folder| pages(&root.join(folder))).collect()
}

/// Markdown files of a folder, sorted.
pub fn pages(folder: &Path) -> Vec<PathBuf> {
    let mut files = entries(folder);
    files.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    files.sort();
    files
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let all = fs::read_dir(folder).expect("the folder is there");
    all.map(|entry| entry.expect("the folder can be read").path()).collect()
}

/// Files that name a page `docs/….md` which is not there: sources, tests, cases, examples, scripts and notebooks.
pub fn missing_pages(root: &Path) -> Vec<String> {
    let mut faults = Vec::new();
    let mut waiting: Vec<PathBuf> = entries(root);
    while let Some(path) = waiting.pop() {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        if path.is_dir() {
            if !matches!(&*name, "target" | ".git" | "out") {
                waiting.extend(entries(&path));
            }
            continue;
        }
        // Files that are no text name no pages.
        let text = fs::read_to_string(&path).unwrap_or_default();
        for rest in text.split("docs/").skip(1) {
            let page = rest.split(|c: char| !(c.is_ascii_lowercase() || c == '-')).next().unwrap_or_default();
            let named = !page.is_empty() && rest[page.len()..].starts_with(".md");
            if named && !root.join("docs").join(page).with_extension("md").exists() {
                faults.push(format!("{}: docs/{page}.md", path.strip_prefix(root).unwrap_or(&path).display()));
            }
        }
    }
    faults
}

fn lines_outside_code(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let mut code = false;
    text.lines().enumerate().filter_map(move |(index, line)| {
        let fence = line.starts_with("```");
        code ^= fence;
        (!code && !fence).then_some((index + 1, line))
    })
}

/// What `](…)` and `src="…"` name in a line.
fn targets(line: &str) -> Vec<&str> {
    let between = |open: &'static str, close: char| {
        line.split(open).skip(1).filter_map(move |rest| rest.split_once(close).map(|(target, _)| target))
    };
    between("](", ')').chain(between("src=\"", '"')).collect()
}

fn fault(file: &Path, target: &str) -> Option<&'static str> {
    if target.contains("://") || target.starts_with("mailto:") {
        return None;
    }
    let (path, anchor) = target.split_once('#').unwrap_or((target, ""));
    let named = if path.is_empty() { file.to_owned() } else { file.parent()?.join(path) };
    if !named.exists() {
        return Some("no such file");
    }
    if anchor.is_empty() || named.extension().is_none_or(|extension| extension != "md") {
        return None;
    }
    let text = fs::read_to_string(&named).ok()?;
    let found = lines_outside_code(&text)
        .filter(|(_, line)| line.starts_with('#'))
        .any(|(_, line)| anchor_of(line.trim_start_matches('#').trim()) == anchor);
    (!found).then_some("no such heading")
}

/// The anchor that GitHub gives to a heading: lower case, spaces as hyphens, punctuation left out.
pub fn anchor_of(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}
