//! The XML of a VTU file: which arrays there are, and where their values stand. Nothing is decoded here.

use std::borrow::Cow;
use std::collections::BTreeMap;

use quick_xml::events::{BytesStart, Event};
use quick_xml::{Reader, XmlVersion};

use crate::error::{Fault, FilePosition, Problem};

#[derive(Debug, Default)]
pub(super) struct Document<'a> {
    /// Attributes of `VTKFile`: type, order of bytes, type of headers, compression.
    pub file: BTreeMap<String, String>,
    pub field_data: Vec<Array<'a>>,
    pub piece: Option<BTreeMap<String, String>>,
    pub points: Vec<Array<'a>>,
    pub cells: Vec<Array<'a>>,
    pub point_data: Vec<Array<'a>>,
    pub cell_data: Vec<Array<'a>>,
    /// Values that stand at the end of the file, from behind the underscore on.
    pub appended: Option<Appended<'a>>,
}

#[derive(Debug)]
pub(super) struct Array<'a> {
    pub attributes: BTreeMap<String, String>,
    /// What stands between its tags.
    pub text: Cow<'a, str>,
    /// Where it begins.
    pub byte: usize,
}

/// The section of appended data.
#[derive(Debug, Clone, Copy)]
pub(super) struct Appended<'a> {
    /// Whether it is base64; otherwise raw bytes.
    pub base64: bool,
    pub bytes: &'a [u8],
}

impl<'a> Document<'a> {
    pub(super) fn parse(bytes: &'a [u8]) -> Result<Self, Fault> {
        // Raw appended data are no XML, and come last.
        let head = bytes.windows(APPENDED.len()).position(|window| window == APPENDED).unwrap_or(bytes.len());
        let text = std::str::from_utf8(&bytes[..head])
            .map_err(|error| fault(error.valid_up_to(), "", Problem::unexpected("other bytes", "text in UTF-8")))?;
        let mut document = Document::default();
        document.walk(text, head < bytes.len())?;
        if head < bytes.len() {
            document.appended = Some(appended(&bytes[head..], head)?);
        }
        Ok(document)
    }

    fn walk(&mut self, text: &'a str, appended_follows: bool) -> Result<(), Fault> {
        let mut reader = Reader::from_str(text);
        let mut path: Vec<String> = Vec::new();
        let mut open: Option<Array> = None;
        loop {
            let byte = reader.buffer_position() as usize;
            let event = reader.read_event().map_err(|error| {
                fault(reader.error_position() as usize, "", Problem::unexpected(&error.to_string(), "XML"))
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
                    // Within an array there may be further elements, which say nothing of its values.
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
                    return Err(fault(text.len(), "", Problem::Ended { expected }));
                }
                _ => {}
            }
        }
    }

    /// What an element other than an array tells.
    fn enter(&mut self, tag: &BytesStart, byte: usize) -> Result<(), Fault> {
        match tag.name().as_ref() {
            "VTKFile" => self.file = attributes(tag, byte)?,
            "Piece" if self.piece.is_some() => {
                let problem = Problem::Unsupported { what: "a second piece".into(), allowed: "one piece".into() };
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

/// The appended data of a file that goes on with them, `at` bytes from its beginning.
fn appended(bytes: &[u8], at: usize) -> Result<Appended<'_>, Fault> {
    let ended = |expected: &str| fault(at, "AppendedData", Problem::Ended { expected: expected.into() });
    let tag_end = bytes.iter().position(|&byte| byte == b'>').ok_or_else(|| ended("`>`"))?;
    let tag = String::from_utf8_lossy(&bytes[..=tag_end]);
    let base64 = match Reader::from_str(&tag).read_event() {
        Ok(Event::Start(tag)) => match attributes(&tag, at)?.get("encoding").map(String::as_str) {
            Some("raw") => false,
            Some("base64") | None => true,
            Some(other) => {
                let problem =
                    Problem::Unsupported { what: format!("encoding {other:?}"), allowed: "raw and base64".into() };
                return Err(fault(at, "AppendedData", problem));
            }
        },
        _ => return Err(fault(at, "AppendedData", Problem::unexpected(&tag, "`<AppendedData encoding=…>`"))),
    };
    let rest = &bytes[tag_end + 1..];
    let start = rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
    let rest = rest[start..].strip_prefix(b"_").ok_or_else(|| ended("`_`, then the data"))?;
    // Raw bytes may look like anything: the last end tag is the one.
    const END: &[u8] = b"</AppendedData>";
    let end = rest.windows(END.len()).rposition(|window| window == END).ok_or_else(|| ended("`</AppendedData>`"))?;
    Ok(Appended { base64, bytes: &rest[..end] })
}

fn attributes(tag: &BytesStart, byte: usize) -> Result<BTreeMap<String, String>, Fault> {
    let wrong = |error: String| fault(byte, "", Problem::unexpected(&error, "attributes `name=\"value\"`"));
    let read = |attribute: Result<quick_xml::events::attributes::Attribute, _>| {
        let attribute =
            attribute.map_err(|error: quick_xml::events::attributes::AttrError| wrong(error.to_string()))?;
        let value = attribute.normalized_value(XmlVersion::Implicit1_0).map_err(|error| wrong(error.to_string()))?;
        Ok((attribute.key.as_ref().to_owned(), value.into_owned()))
    };
    tag.attributes().map(read).collect()
}

pub(super) fn fault(byte: usize, section: &str, problem: Problem) -> Fault {
    Fault { place: Some(FilePosition::Byte(byte)), section: section.into(), problem }
}
