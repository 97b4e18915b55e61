//! XML of a VTU file: its arrays and the places of their values, which are not decoded here.

use std::borrow::Cow;
use std::collections::BTreeMap;

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use crate::error::{FileFault, FilePosition, FileProblem};

#[derive(Debug, Default)]
pub(super) struct VtuDocument<'a> {
    /// Attributes of `VTKFile`: type, byte order, type of headers, compression.
    pub file: BTreeMap<String, String>,
    pub field_data: Vec<Array<'a>>,
    pub piece: Option<BTreeMap<String, String>>,
    pub points: Vec<Array<'a>>,
    pub cells: Vec<Array<'a>>,
    pub point_data: Vec<Array<'a>>,
    pub cell_data: Vec<Array<'a>>,
    /// Appended values at the end of the file, after the underscore.
    pub appended: Option<Appended<'a>>,
}

#[derive(Debug)]
pub(super) struct Array<'a> {
    pub attributes: BTreeMap<String, String>,
    /// Text between the tags.
    pub text: Cow<'a, str>,
    /// Offset of the array in the file.
    pub byte: usize,
}

/// Section of appended data.
#[derive(Debug, Clone, Copy)]
pub(super) struct Appended<'a> {
    /// Whether the data are base64 instead of raw bytes.
    pub base64: bool,
    pub bytes: &'a [u8],
}

impl<'a> VtuDocument<'a> {
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, FileFault> {
        // Raw appended data at the end are not XML.
        let head = bytes.windows(APPENDED.len()).position(|window| window == APPENDED).unwrap_or(bytes.len());
        let text = std::str::from_utf8(&bytes[..head])
            .map_err(|error| fault(error.valid_up_to(), "", FileProblem::unexpected("other bytes", "text in UTF-8")))?;
        let mut document = VtuDocument::default();
        document.walk(text, head < bytes.len())?;
        if head < bytes.len() {
            document.appended = Some(appended(&bytes[head..], head)?);
        }
        Ok(document)
    }

    fn walk(&mut self, text: &'a str, appended_follows: bool) -> Result<(), FileFault> {
        let mut reader = Reader::from_str(text);
        let mut path: Vec<String> = Vec::new();
        let mut open: Option<Array> = None;
        loop {
            let byte = reader.buffer_position() as usize;
            let event = reader.read_event().map_err(|error| {
                fault(reader.error_position() as usize, "", FileProblem::unexpected(&error.to_string(), "XML"))
            })?;
            match event {
                Event::Start(tag) => {
                    if tag.name().as_ref() == "DataArray" && open.is_none() {
                        open = Some(Array { attributes: attributes(&tag, byte)?, text: Cow::default(), byte });
                    } else {
                        self.enter(&tag, byte)?;
                    }
                    path.push(tag.name().as_ref().to_owned());
                }
                Event::Empty(tag) => {
                    if tag.name().as_ref() == "DataArray" && open.is_none() {
                        let array = Array { attributes: attributes(&tag, byte)?, text: Cow::default(), byte };
                        self.place(path.last(), array);
                    } else {
                        self.enter(&tag, byte)?;
                    }
                }
                Event::End(_) => {
                    path.pop();
                    // Further elements within an array do not contain values.
                    if path.last().is_none_or(|parent| SECTIONS.contains(&parent.as_str()))
                        && let Some(array) = open.take()
                    {
                        self.place(path.last(), array);
                    }
                }
                Event::Text(more) => {
                    if let Some(array) = open.as_mut().filter(|_| path.last().is_some_and(|name| name == "DataArray")) {
                        match &mut array.text {
                            text if text.is_empty() => *text = more.into_inner(),
                            text => text.to_mut().push_str(&more.into_inner()),
                        }
                    }
                }
                Event::Eof if path.is_empty() || appended_follows => return Ok(()),
                Event::Eof => {
                    let expected = format!("`</{}>`", path.last().map_or("", String::as_str));
                    return Err(fault(text.len(), "", FileProblem::Ended { expected }));
                }
                _ => {}
            }
        }
    }

    /// Reads the attributes of an element other than an array.
    fn enter(&mut self, tag: &BytesStart, byte: usize) -> Result<(), FileFault> {
        match tag.name().as_ref() {
            "VTKFile" => self.file = attributes(tag, byte)?,
            "Piece" if self.piece.is_some() => {
                let problem = FileProblem::Unsupported { what: "a second piece".into(), allowed: "one piece".into() };
                return Err(fault(byte, "Piece", problem));
            }
            "Piece" => self.piece = Some(attributes(tag, byte)?),
            _ => {}
        }
        Ok(())
    }

    fn place(&mut self, section: Option<&String>, array: Array<'a>) {
        match section.map(String::as_str) {
            Some("FieldData") => self.field_data.push(array),
            Some("Points") => self.points.push(array),
            Some("Cells") => self.cells.push(array),
            Some("PointData") => self.point_data.push(array),
            Some("CellData") => self.cell_data.push(array),
            _ => {}
        }
    }
}

const APPENDED: &[u8] = b"<AppendedData";

/// Elements that hold arrays.
const SECTIONS: [&str; 5] = ["FieldData", "Points", "Cells", "PointData", "CellData"];

/// Appended data of a file in its last `bytes`, from offset `at` on.
fn appended(bytes: &[u8], at: usize) -> Result<Appended<'_>, FileFault> {
    let ended = |expected: &str| fault(at, "AppendedData", FileProblem::Ended { expected: expected.into() });
    let tag_end = bytes.iter().position(|&byte| byte == b'>').ok_or_else(|| ended("`>`"))?;
    let tag = String::from_utf8_lossy(&bytes[..=tag_end]);
    let base64 = match Reader::from_str(&tag).read_event() {
        Ok(Event::Start(tag)) => match attributes(&tag, at)?.get("encoding").map(String::as_str) {
            Some("raw") => false,
            Some("base64") | None => true,
            Some(other) => {
                let problem =
                    FileProblem::Unsupported { what: format!("encoding {other:?}"), allowed: "raw and base64".into() };
                return Err(fault(at, "AppendedData", problem));
            }
        },
        _ => return Err(fault(at, "AppendedData", FileProblem::unexpected(&tag, "`<AppendedData encoding=…>`"))),
    };
    let rest = &bytes[tag_end + 1..];
    let start = rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
    let rest = rest[start..].strip_prefix(b"_").ok_or_else(|| ended("`_`, then the data"))?;
    // Raw bytes may contain end tags: the last one counts.
    const END: &[u8] = b"</AppendedData>";
    let end = rest.windows(END.len()).rposition(|window| window == END).ok_or_else(|| ended("`</AppendedData>`"))?;
    Ok(Appended { base64, bytes: &rest[..end] })
}

fn attributes(tag: &BytesStart, byte: usize) -> Result<BTreeMap<String, String>, FileFault> {
    let mut attributes = BTreeMap::new();
    for attribute in tag.attributes() {
        let read = attribute.map_err(|error| error.to_string()).and_then(|attribute| {
            let value = attribute.normalized_value(XmlVersion::Implicit1_0).map_err(|error| error.to_string())?;
            Ok((attribute.key.as_ref().to_owned(), value.into_owned()))
        });
        let (name, value) =
            read.map_err(|error| fault(byte, "", FileProblem::unexpected(&error, "attributes `name=\"value\"`")))?;
        attributes.insert(name, value);
    }
    Ok(attributes)
}

pub(super) fn fault(byte: usize, section: &str, problem: FileProblem) -> FileFault {
    FileFault { place: Some(FilePosition::Byte(byte)), section: section.into(), problem }
}
