//! Where cases come from: those built into the program, or folders on disk.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use include_dir::{Dir, include_dir};

use super::case_file::CaseFile;
use super::record::Tier;
use gearwear_files::size_limit::SizeLimit;
use gearwear_files::whole_file::TemporaryFolder;

/// Built-in cases with their files.
static CASES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../validation");
/// Finite-element meshes that cases read.
static MESHES: Dir<'_> = include_dir!("$CARGO_MANIFEST_DIR/../../meshes");
/// File of a case in its folder.
const CASE_FILE: &str = "case.toml";

/// Size of a case's own file, and of a scene beside it.
pub(crate) const MOST: SizeLimit = SizeLimit { of: "a case", megabytes: 16 };

/// Error of finding cases.
#[derive(Debug, thiserror::Error)]
pub enum LibraryError {
    #[error(
        "found {found:?}; allowed: the name of a built-in case, or a folder with a file {CASE_FILE}{}",
        nearest.map_or_else(String::new, |nearest| format!("; did you mean {nearest:?}?"))
    )]
    Unknown { found: String, nearest: Option<&'static str> },
    #[error("{}: {reason}", path.display())]
    Unreadable { path: PathBuf, reason: io::Error },
    #[error("{}: line {line}: {reason}", path.display())]
    NotACase { path: PathBuf, line: usize, reason: String },
    /// None of the cases asked for belongs to the tier asked for.
    #[error("found no case of the tier {tier} among those named; allowed: cases of that tier, or none named")]
    NoCaseOfTier { tier: &'static str },
    /// Two cases of the same name, which reports could not distinguish.
    #[error("found two cases called {name:?}; allowed: each name once")]
    Twice { name: String },
    /// Existing files are not overwritten: they may have been changed.
    #[error("found {} there already; allowed: a folder without it", path.display())]
    Exists { path: PathBuf },
    #[error("cannot write the built-in cases to {}: {reason}", folder.display())]
    Export { folder: PathBuf, reason: io::Error },
}

/// A case with its place on disk.
#[derive(Debug, Clone)]
pub struct ValidationCase {
    /// Name of its folder.
    pub name: String,
    pub folder: PathBuf,
    pub file: CaseFile,
}

/// Cases, and the folder that keeps the built-in ones as long as they are needed.
#[derive(Debug)]
pub struct Library {
    pub cases: Vec<ValidationCase>,
    _built_in: Option<TemporaryFolder>,
}

pub fn names() -> Vec<&'static str> {
    let cases = CASES.dirs().filter(|dir| dir.contains(dir.path().join(CASE_FILE)));
    cases.filter_map(|dir| dir.path().to_str()).collect()
}

/// Lays the built-in cases out in `folder`: `validation/` with one folder a case, and `meshes/` beside it.
pub fn export(folder: &Path) -> Result<(), LibraryError> {
    for name in ["validation", "meshes"] {
        let path = folder.join(name);
        if path.exists() {
            return Err(LibraryError::Exists { path });
        }
    }
    for (name, dir) in [("validation", &CASES), ("meshes", &MESHES)] {
        let into = folder.join(name);
        let laid_out = fs::create_dir_all(&into).and_then(|()| dir.extract(&into));
        laid_out.map_err(|reason| LibraryError::Export { folder: folder.into(), reason })?;
    }
    Ok(())
}

/// Temporary folder with the built-in cases.
fn exported() -> Result<TemporaryFolder, LibraryError> {
    let folder = TemporaryFolder::new();
    let folder = folder.map_err(|reason| LibraryError::Export { folder: std::env::temp_dir(), reason })?;
    export(folder.path())?;
    Ok(folder)
}

impl Library {
    /// Tier that is run: `asked` if given, else the full tier of the whole suite (`all`) and no limit for named cases.
    pub fn tier(&self, asked: Option<Tier>, all: bool) -> Result<Option<Tier>, LibraryError> {
        let tier = asked.or(all.then_some(Tier::Full));
        match tier {
            Some(tier) if self.cases.iter().all(|case| case.file.tier > tier) => {
                Err(LibraryError::NoCaseOfTier { tier: tier.name() })
            }
            _ => Ok(tier),
        }
    }

    /// The cases asked for, each by its name or by the folder it lies in; none asked for: all built-in ones.
    pub fn open(asked: &[String]) -> Result<Self, LibraryError> {
        let names = names();
        let all: Vec<String> = names.iter().map(|name| (*name).to_owned()).collect();
        let asked = if asked.is_empty() { &all } else { asked };
        let mut built_in: Option<TemporaryFolder> = None;
        let mut folders = Vec::with_capacity(asked.len());
        // A built-in name is that case; `./NAME` is a folder.
        for asked in asked {
            if names.contains(&asked.as_str()) {
                let folder = match &built_in {
                    Some(folder) => folder,
                    None => built_in.insert(exported()?),
                };
                folders.push(folder.path().join("validation").join(asked));
            } else if Path::new(asked).join(CASE_FILE).is_file() {
                folders.push(PathBuf::from(asked));
            } else {
                let nearest = gearwear::scene::nearest::nearest(asked, &names);
                return Err(LibraryError::Unknown { found: asked.clone(), nearest });
            }
        }
        let cases = folders.iter().map(|folder| read(folder)).collect::<Result<Vec<ValidationCase>, _>>()?;
        let mut taken = BTreeSet::new();
        if let Some(twice) = cases.iter().find(|case| !taken.insert(case.name.as_str())) {
            return Err(LibraryError::Twice { name: twice.name.clone() });
        }
        Ok(Self { cases, _built_in: built_in })
    }
}

fn read(folder: &Path) -> Result<ValidationCase, LibraryError> {
    let path = folder.join(CASE_FILE);
    let text = MOST.read_to_string(&path).map_err(|reason| LibraryError::Unreadable { path: path.clone(), reason })?;
    let file: CaseFile = toml::from_str(&text).map_err(|error| {
        let start = error.span().map_or(0, |span| span.start);
        let line = text.get(..start).map_or(1, |before| before.matches('\n').count() + 1);
        LibraryError::NotACase { path: path.clone(), line, reason: error.message().to_owned() }
    })?;
    super::check::check(&file).map_err(|fault| {
        let line = fault.line(&text);
        LibraryError::NotACase { path, line, reason: fault.to_string() }
    })?;
    // A folder given as `.` has a name all the same.
    let whole = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
    let name = whole.file_name().map_or_else(|| "case".to_owned(), |name| name.to_string_lossy().into_owned());
    Ok(ValidationCase { name, folder: folder.to_owned(), file })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_built_in_case_is_one() {
        let library = Library::open(&[]).unwrap();
        assert_eq!(library.cases.len(), names().len());
        assert!(!library.cases.is_empty());
    }

    #[test]
    fn an_unknown_case_is_refused_with_the_nearest_name() {
        let message = Library::open(&["fzg-c-geometri".to_owned()]).unwrap_err().to_string();
        assert!(
            message.contains("\"fzg-c-geometri\"") && message.contains("did you mean \"fzg-c-geometry\""),
            "{message}"
        );
    }
}
