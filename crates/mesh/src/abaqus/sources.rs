//! Text of an Abaqus file and of the files that it includes.
//!
//! `*INCLUDE, INPUT=file` stands for the lines of that file, and `INPUT=file` of `*NODE`, `*ELEMENT`, `*NSET` and `*ELSET` for data lines
//! there. Names are relative to the folder of the file read, as all programs take them that run there. A file that includes itself, on
//! any way, is refused, and so is more than [`MOST_FILES`] or [`MESH_SIZE`] of all.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::keywords::{Keyword, LogicalLine, logical_lines, parsed};
use crate::error::{FileFault, FilePosition, FileProblem};
use crate::file::MESH_SIZE;

/// Greatest number of included files.
const MOST_FILES: usize = 1000;
/// Keywords whose data may be in another file.
const WITH_INPUT: [&str; 4] = ["NODE", "ELEMENT", "NSET", "ELSET"];

/// The files, the one read first.
#[derive(Debug, Default)]
pub(super) struct Sources {
    files: Vec<Source>,
    /// Included file by the line that includes it.
    included: BTreeMap<At, usize>,
    bytes: u64,
}

#[derive(Debug)]
struct Source {
    /// Name as the including line gives it; `None` for the file read.
    name: Option<String>,
    path: Option<PathBuf>,
    text: String,
    /// File that includes it.
    parent: Option<usize>,
}

/// Line of one of the files.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct At {
    /// Number of the file.
    pub file: usize,
    /// Line, from 1.
    pub line: usize,
}

impl Sources {
    /// The text of a file and all that it includes; text that is of no `file` can include none.
    pub(super) fn load(bytes: &[u8], file: Option<&Path>) -> Result<Self, FileFault> {
        let mut sources = Self::default();
        let text = utf8(bytes).map_err(|(line, problem)| fault(line, None, "", problem))?;
        let path = file.map(Path::to_owned);
        sources.files.push(Source { name: None, path, text: text.to_owned(), parent: None });
        let mut next = 0;
        while next < sources.files.len() {
            for (line, name) in sources.inclusions(next) {
                let place = At { file: next, line };
                let loaded = sources.open(place, &name);
                let source = loaded.map_err(|problem| sources.fault(place, "*INCLUDE", problem))?;
                sources.included.insert(place, sources.files.len());
                sources.files.push(source);
            }
            next += 1;
        }
        Ok(sources)
    }

    /// Lines of a file that include others, with their names.
    fn inclusions(&self, file: usize) -> Vec<(usize, String)> {
        let lines = logical_lines(&self.files[file].text);
        let inclusions = lines.filter_map(|(line, text)| match text {
            LogicalLine::Keyword(text) => {
                let (name, parameters) = parsed(&text);
                let includes = name == "INCLUDE" || WITH_INPUT.contains(&name.as_str());
                let input = parameters.into_iter().find(|(name, _)| includes && name == "INPUT")?;
                Some((line, input.1.map_or_else(String::new, |name| name.text)))
            }
            LogicalLine::Data(_) => None,
        });
        inclusions.collect()
    }

    fn open(&mut self, place: At, name: &str) -> Result<Source, FileProblem> {
        let refused = |reason: String| FileProblem::Included { file: name.to_owned(), reason };
        let Some(folder) = self.files[0].path.as_ref().map(|path| path.parent().unwrap_or(Path::new(""))) else {
            return Err(refused("a mesh that is no file of its own can include none".to_owned()));
        };
        let path = folder.join(name);
        let mut above = Some(place.file);
        while let Some(file) = above {
            let is_same = self.files[file].path.as_ref().is_some_and(|own| same_file(own, &path));
            if is_same {
                return Err(refused("it includes itself".to_owned()));
            }
            above = self.files[file].parent;
        }
        let bytes = MESH_SIZE.read(&path).map_err(|error| refused(error.to_string()))?;
        self.bytes += bytes.len() as u64;
        if self.files.len() > MOST_FILES || self.bytes > MESH_SIZE.bytes() {
            let most_mb = MESH_SIZE.megabytes;
            return Err(refused(format!("more than {MOST_FILES} files or {most_mb} MB are included")));
        }
        let text = utf8(&bytes).map_err(|(line, problem)| refused(format!("line {line}: {problem}")))?;
        Ok(Source { name: Some(name.to_owned()), path: Some(path), text: text.to_owned(), parent: Some(place.file) })
    }

    /// Content of all included files.
    pub(super) fn included_bytes(&self) -> Vec<u8> {
        self.files[1..].iter().flat_map(|source| source.text.bytes()).collect()
    }

    /// Number of bytes of all files.
    pub(super) fn len(&self) -> usize {
        self.files.iter().map(|source| source.text.len()).sum()
    }

    /// All keywords in order.
    pub(super) fn keywords(&self) -> Result<Vec<Keyword<'_>>, FileFault> {
        let mut keywords = Vec::new();
        self.add_keywords(0, &mut keywords)?;
        Ok(keywords)
    }

    fn add_keywords<'a>(&'a self, file: usize, keywords: &mut Vec<Keyword<'a>>) -> Result<(), FileFault> {
        for (line, text) in logical_lines(&self.files[file].text) {
            let at = At { file, line };
            match text {
                LogicalLine::Keyword(text) => {
                    let (name, parameters) = parsed(&text);
                    let included = self.included.get(&at);
                    if name != "INCLUDE" {
                        keywords.push(Keyword { name, parameters, at, data: Vec::new(), sources: self });
                    } else if included.is_none() {
                        return Err(self.fault(at, "*INCLUDE", FileProblem::Ended { expected: "INPUT=…".into() }));
                    }
                    if let Some(&file) = included {
                        self.add_keywords(file, keywords)?;
                    }
                }
                LogicalLine::Data(text) => match keywords.last_mut() {
                    Some(keyword) => keyword.data.push((at, text)),
                    None => {
                        let problem = FileProblem::unexpected(text, "a keyword, `*NODE` for example");
                        return Err(self.fault(at, "", problem));
                    }
                },
            }
        }
        Ok(())
    }

    /// Fault of a section in a line.
    pub(super) fn fault(&self, at: At, section: &str, problem: FileProblem) -> FileFault {
        fault(at.line, self.files[at.file].name.as_deref(), section, problem)
    }
}

fn fault(line: usize, file: Option<&str>, section: &str, problem: FileProblem) -> FileFault {
    let section = match file {
        None => section.to_owned(),
        Some(file) => format!("{section} in the included file {file:?}").trim_start().to_owned(),
    };
    FileFault { place: Some(FilePosition::Line(line)), section, problem }
}

/// Text in UTF-8, or the first line that is not.
fn utf8(bytes: &[u8]) -> Result<&str, (usize, FileProblem)> {
    std::str::from_utf8(bytes).map_err(|error| {
        let line = 1 + bytes[..error.valid_up_to()].iter().filter(|&&byte| byte == b'\n').count();
        (line, FileProblem::unexpected("other bytes", "text in UTF-8"))
    })
}

fn same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => a == b,
    }
}
