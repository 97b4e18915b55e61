//! Scanner of the values of a Gmsh file, ASCII or binary, with checks for its end.

use crate::error::{FileFault, FilePosition, FileProblem};
use crate::numbering::Allowance;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Ascii,
    Binary {
        big_endian: bool,
        /// Bytes of a `size_t`: 4 or 8.
        size_bytes: usize,
    },
}

/// Scanner at a place in the file.
#[derive(Debug)]
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Beginning of the last value.
    before: usize,
    section: String,
    /// Encoding of the following numbers.
    pub encoding: Encoding,
    /// Remaining number of entries of sets and data.
    pub allowance: Allowance,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let allowance = Allowance::of(bytes.len());
        Self { bytes, at: 0, before: 0, section: String::new(), encoding: Encoding::Ascii, allowance }
    }

    /// Fault at the last value.
    pub(super) fn fault(&self, problem: impl Into<FileProblem>) -> FileFault {
        let place = match self.encoding {
            Encoding::Ascii => {
                FilePosition::Line(1 + self.bytes[..self.before].iter().filter(|&&byte| byte == b'\n').count())
            }
            Encoding::Binary { .. } => FilePosition::Byte(self.before),
        };
        FileFault { place: Some(place), section: self.section.clone(), problem: problem.into() }
    }

    fn ended(&mut self, expected: &str) -> FileFault {
        self.before = self.bytes.len();
        self.fault(FileProblem::Ended { expected: expected.into() })
    }

    fn unexpected(&self, found: &[u8], expected: &str) -> FileFault {
        self.fault(FileProblem::unexpected(&String::from_utf8_lossy(found), expected))
    }

    fn skip_space(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
    }

    /// Name of the next section without the dollar sign; `None` at the end of the file.
    pub(super) fn next_section(&mut self) -> Result<Option<String>, FileFault> {
        self.section.clear();
        self.skip_space();
        if self.at == self.bytes.len() {
            return Ok(None);
        }
        let line = self.line("a section, `$Nodes` for example")?;
        match line.strip_prefix('$') {
            Some(name) => {
                self.section = line.to_owned();
                Ok(Some(name.to_owned()))
            }
            None => Err(self.unexpected(line.as_bytes(), "a section, `$Nodes` for example")),
        }
    }

    /// Reads the line that closes the section.
    pub(super) fn end_section(&mut self) -> Result<(), FileFault> {
        let expected = format!("$End{}", self.section.trim_start_matches('$'));
        self.skip_space();
        let line = self.line(&expected)?;
        if line != expected {
            return Err(self.unexpected(line.as_bytes(), &expected));
        }
        Ok(())
    }

    /// Skips the rest of the section with the line that closes it.
    pub(super) fn skip_section(&mut self) -> Result<(), FileFault> {
        let end = format!("$End{}", self.section.trim_start_matches('$'));
        // `at` is after a line break, where a section without content ends.
        let mut from = self.at.saturating_sub(1);
        while let Some(found) = self.bytes[from..].windows(end.len()).position(|window| window == end.as_bytes()) {
            let (start, after) = (from + found, from + found + end.len());
            let alone = start == 0 || self.bytes[start - 1] == b'\n';
            if alone && self.bytes.get(after).is_none_or(u8::is_ascii_whitespace) {
                self.at = after;
                return Ok(());
            }
            from = after;
        }
        Err(self.ended(&end))
    }

    /// Rest of the line as trimmed text.
    pub(super) fn line(&mut self, expected: &str) -> Result<&'a str, FileFault> {
        if self.at == self.bytes.len() {
            return Err(self.ended(expected));
        }
        self.before = self.at;
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(|&byte| byte == b'\n').unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        match std::str::from_utf8(&rest[..length]) {
            Ok(line) => Ok(line.trim()),
            Err(_) => Err(self.unexpected(&rest[..length], &format!("{expected} in UTF-8"))),
        }
    }

    /// Number on a line of text, in binary files too.
    pub(super) fn number_line<T: std::str::FromStr>(&mut self, expected: &str) -> Result<T, FileFault> {
        let line = self.line(expected)?;
        line.parse().map_err(|_| self.unexpected(line.as_bytes(), expected))
    }

    fn token<T: std::str::FromStr>(&mut self, expected: &str) -> Result<T, FileFault> {
        self.skip_space();
        if self.at == self.bytes.len() {
            return Err(self.ended(expected));
        }
        let rest = &self.bytes[self.at..];
        let token = &rest[..rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len())];
        self.before = self.at;
        self.at += token.len();
        let parsed = std::str::from_utf8(token).ok().and_then(|text| text.parse().ok());
        parsed.ok_or_else(|| self.unexpected(token, expected))
    }

    fn raw<const N: usize>(&mut self, expected: &str, big_endian: bool) -> Result<[u8; N], FileFault> {
        let Some(bytes) = self.bytes[self.at..].first_chunk::<N>() else {
            return Err(self.ended(expected));
        };
        self.before = self.at;
        self.at += N;
        let mut bytes = *bytes;
        if big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    pub(super) fn int(&mut self, expected: &str) -> Result<i64, FileFault> {
        match self.encoding {
            Encoding::Ascii => self.token(expected),
            Encoding::Binary { big_endian, .. } => Ok(i32::from_le_bytes(self.raw(expected, big_endian)?).into()),
        }
    }

    /// Nonnegative `int`.
    pub(super) fn positive_int(&mut self, expected: &str) -> Result<u64, FileFault> {
        let value = self.int(expected)?;
        u64::try_from(value).map_err(|_| self.unexpected(value.to_string().as_bytes(), expected))
    }

    pub(super) fn size(&mut self, expected: &str) -> Result<u64, FileFault> {
        match self.encoding {
            Encoding::Ascii => self.token(expected),
            Encoding::Binary { big_endian, size_bytes: 4 } => {
                Ok(u32::from_le_bytes(self.raw(expected, big_endian)?).into())
            }
            Encoding::Binary { big_endian, .. } => Ok(u64::from_le_bytes(self.raw(expected, big_endian)?)),
        }
    }

    pub(super) fn real(&mut self, expected: &str) -> Result<f64, FileFault> {
        match self.encoding {
            Encoding::Ascii => self.token(expected),
            Encoding::Binary { big_endian, .. } => Ok(f64::from_le_bytes(self.raw(expected, big_endian)?)),
        }
    }

    /// Three finite coordinates.
    pub(super) fn point(&mut self) -> Result<[f64; 3], FileFault> {
        let mut point = [0.0; 3];
        for x in &mut point {
            *x = self.real("a coordinate")?;
            if !x.is_finite() {
                return Err(self.unexpected(x.to_string().as_bytes(), "a coordinate that is finite"));
            }
        }
        Ok(point)
    }

    /// Checked `count` of items that have at least `sizes`, `ints` and `reals` values each in the rest of the file.
    pub(super) fn count(
        &self,
        what: &'static str,
        count: u64,
        [sizes, ints, reals]: [u64; 3],
    ) -> Result<usize, FileFault> {
        let bytes_each = match self.encoding {
            // One digit and a separator.
            Encoding::Ascii => 2 * (sizes + ints + reals),
            Encoding::Binary { size_bytes, .. } => sizes * size_bytes as u64 + 4 * ints + 8 * reals,
        };
        let rest = (self.bytes.len() - self.at) as u64;
        // The last digit of a file needs no separator.
        let possible = (rest + 1) / bytes_each.max(1);
        if count > possible {
            return Err(self.fault(FileProblem::Count { what, count, possible }));
        }
        // At most the number of bytes of the file.
        Ok(count as usize)
    }

    pub(super) fn allow(&mut self, entries: usize) -> Result<(), FileFault> {
        self.allowance.take(entries).map_err(|problem| self.fault(problem))
    }
}
