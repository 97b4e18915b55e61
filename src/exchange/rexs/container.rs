//! The bytes of a file: text, or an archive with a model in it, beside which other files may lie. What has no end, and archives whose content has
//! none, are refused at a stated limit.

use std::io::{Cursor, Read};

use zip::ZipArchive;

use super::RexsError;
use super::document::{Lines, on_one_line};

/// Bytes of a file, and of the model in an archive, at most.
pub const MOST_BYTES: usize = 64 << 20;

/// The bytes that `input` gives.
///
/// # Errors
/// [`FileError`]: it cannot be read, or there is no end to it within [`MOST_BYTES`].
pub fn read(input: impl Read) -> Result<Vec<u8>, FileError> {
    let mut bytes = Vec::new();
    input.take(MOST_BYTES as u64 + 1).read_to_end(&mut bytes).map_err(FileError::Unreadable)?;
    if bytes.len() > MOST_BYTES { Err(FileError::Rexs(too_large())) } else { Ok(bytes) }
}

/// Why the bytes of a file are not had.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    #[error(transparent)]
    Unreadable(std::io::Error),
    #[error(transparent)]
    Rexs(RexsError),
}

/// The text of the model in a file of these bytes.
///
/// # Errors
/// An archive without a model or with several, one that cannot be read or has no end, and text in no known encoding.
pub fn text(bytes: &[u8]) -> Result<String, RexsError> {
    if bytes.starts_with(b"PK") { decoded(&unpacked(bytes)?) } else { decoded(bytes) }
}

fn too_large() -> RexsError {
    RexsError::TooLarge { most_mb: MOST_BYTES >> 20 }
}

/// The bytes of the only model in an archive.
fn unpacked(bytes: &[u8]) -> Result<Vec<u8>, RexsError> {
    let broken = |error: &dyn std::fmt::Display| RexsError::NoModel {
        line: 1,
        found: format!("an archive that cannot be read ({})", on_one_line(&error.to_string())),
    };
    let mut archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| broken(&error))?;
    let names = archive.file_names().enumerate().filter_map(|(index, name)| Some((index, name.ok()?.into_owned())));
    let models: Vec<(usize, String)> = names.filter(|(_, name)| is_model(name)).collect();
    let model = match models.as_slice() {
        [(model, _)] => *model,
        [] => {
            let found = "an archive without a file whose name ends in .rexs, .rexsj, .xml or .json".to_owned();
            return Err(RexsError::NoModel { line: 1, found });
        }
        [(_, first), ..] => {
            let (count, first) = (models.len(), on_one_line(first));
            return Err(RexsError::NoModel {
                line: 1,
                found: format!("an archive of {count} models, {first} and others"),
            });
        }
    };
    let member = archive.by_index(model).map_err(|error| broken(&error))?;
    read(member).map_err(|error| match error {
        FileError::Unreadable(error) => broken(&error),
        FileError::Rexs(error) => error,
    })
}

/// Whether a file of an archive is a model by its name, and none of those that an operating system lays beside.
fn is_model(name: &str) -> bool {
    let name = name.to_lowercase();
    let last = name.rsplit(['/', '\\']).next().unwrap_or_default();
    [".rexs", ".rexsj", ".xml", ".json"].iter().any(|ending| last.ends_with(ending)) && !last.starts_with("._")
}

/// Text in UTF-8, or in Latin-1 where the file says that.
fn decoded(bytes: &[u8]) -> Result<String, RexsError> {
    let error = match std::str::from_utf8(bytes) {
        Ok(text) => return Ok(text.to_owned()),
        Err(error) => error,
    };
    if is_latin_1(bytes) {
        return Ok(bytes.iter().map(|&byte| char::from(byte)).collect());
    }
    let before = String::from_utf8_lossy(&bytes[..error.valid_up_to()]).into_owned();
    let line = Lines::of(&before).at(before.len() as u64);
    Err(RexsError::NoModel { line, found: "bytes that are not UTF-8".to_owned() })
}

/// Whether the XML declaration names Latin-1, or the code page of Windows, which differs from it in quotation marks.
fn is_latin_1(bytes: &[u8]) -> bool {
    let head = String::from_utf8_lossy(&bytes[..bytes.len().min(200)]).to_lowercase();
    let declaration = head.split("?>").next().unwrap_or_default();
    declaration.starts_with("<?xml") && ["iso-8859-1", "windows-1252"].iter().any(|name| declaration.contains(name))
}
