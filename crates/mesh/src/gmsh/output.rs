//! Output of values to a Gmsh file, as text or as bytes.

use std::io::Write;

use super::GmshEncoding;

#[derive(Debug)]
pub(super) struct GmshOutput {
    pub bytes: Vec<u8>,
    /// Whether numbers are binary.
    pub binary: bool,
}

impl GmshOutput {
    pub(super) fn new(encoding: GmshEncoding) -> Self {
        Self { bytes: Vec::new(), binary: encoding == GmshEncoding::Binary }
    }

    /// Writes a line of text, in binary files too.
    pub(super) fn line(&mut self, line: impl std::fmt::Display) {
        // Writing into memory does not fail.
        let _ = writeln!(self.bytes, "{line}");
    }

    fn number(&mut self, text: impl std::fmt::Display, raw: &[u8]) {
        if self.binary {
            self.bytes.extend_from_slice(raw);
            return;
        }
        if self.bytes.last().is_some_and(|&last| last != b'\n') {
            self.bytes.push(b' ');
        }
        let _ = write!(self.bytes, "{text}");
    }

    /// Writes an `int`; the numbers of nodes, cells and tags have been checked to fit.
    pub(super) fn int(&mut self, value: i64) {
        self.number(value, &(value as i32).to_le_bytes());
    }

    pub(super) fn size(&mut self, value: usize) {
        self.number(value, &(value as u64).to_le_bytes());
    }

    /// Writes a `double`, as text the shortest decimal that reads back as the same bits.
    pub(super) fn real(&mut self, value: f64) {
        self.number(format_args!("{value:?}"), &value.to_le_bytes());
    }

    /// Ends a line of numbers as text.
    pub(super) fn end_line(&mut self) {
        if !self.binary {
            self.bytes.push(b'\n');
        }
    }

    /// Ends a section of numbers on a new line, in a binary file too.
    pub(super) fn end_section(&mut self, section: &str) {
        if self.binary {
            self.bytes.push(b'\n');
        }
        self.line(format_args!("$End{section}"));
    }
}
