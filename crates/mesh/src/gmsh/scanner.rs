//! Reading values off a Gmsh file, ASCII or binary, never past its end.

use crate::error::{Fault, FilePosition, Problem};
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

/// A place in the file, and what follows it.
#[derive(Debug)]
pub(super) struct Scanner<'a> {
    bytes: &'a [u8],
    at: usize,
    /// Where the value read last began.
    before: usize,
    section: String,
    /// How numbers stand from here on.
    pub encoding: Encoding,
    /// What sets and data may still take.
    pub allowance: Allowance,
}

impl<'a> Scanner<'a> {
    pub(super) fn new(bytes: &'a [u8]) -> Self {
        let allowance = Allowance::of(bytes.len());
        Self { bytes, at: 0, before: 0, section: String::new(), encoding: Encoding::Ascii, allowance }
    }

    /// A fault at the value read last.
    pub(super) fn fault(&self, problem: impl Into<Problem>) -> Fault {
        let place = match self.encoding {
            Encoding::Ascii => {
                FilePosition::Line(1 + self.bytes[..self.before].iter().filter(|&&byte| byte == b'\n').count())
            }
            Encoding::Binary { .. } => FilePosition::Byte(self.before),
        };
        Fault { place: Some(place), section: self.section.clone(), problem: problem.into() }
    }

    fn ended(&mut self, expected: &str) -> Fault {
        self.before = self.bytes.len();
        self.fault(Problem::Ended { expected: expected.into() })
    }

    fn unexpected(&self, found: &[u8], expected: &str) -> Fault {
        self.fault(Problem::unexpected(&String::from_utf8_lossy(found), expected))
    }

    fn skip_space(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += rest.iter().position(|byte| !byte.is_ascii_whitespace()).unwrap_or(rest.len());
    }

    /// The next section's name, without the dollar sign; `None` at the end of the file.
    pub(super) fn next_section(&mut self) -> Result<Option<String>, Fault> {
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

    /// The line that closes the section.
    pub(super) fn end_section(&mut self) -> Result<(), Fault> {
        let expected = format!("$End{}", self.section.trim_start_matches('$'));
        self.skip_space();
        let line = self.line(&expected)?;
        if line != expected {
            return Err(self.unexpected(line.as_bytes(), &expected));
        }
        Ok(())
    }

    /// Goes on behind the line that closes the section, whatever comes before it.
    pub(super) fn skip_section(&mut self) -> Result<(), Fault> {
        let end = format!("$End{}", self.section.trim_start_matches('$'));
        // `at` stands behind a line break, so that a section without content ends right here.
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

    /// The rest of the line, trimmed, as text; a line break must not be missing unless the file ends.
    pub(super) fn line(&mut self, expected: &str) -> Result<&'a str, Fault> {
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

    /// A line that holds one number as text, in binary files too.
    pub(super) fn number_line<T: std::str::FromStr>(&mut self, expected: &str) -> Result<T, Fault> {
        let line = self.line(expected)?;
        line.parse().map_err(|_| self.unexpected(line.as_bytes(), expected))
    }

    fn token<T: std::str::FromStr>(&mut self, expected: &str) -> Result<T, Fault> {
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

    fn raw<const N: usize>(&mut self, expected: &str, big_endian: bool) -> Result<[u8; N], Fault> {
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

    pub(super) fn int(&mut self, expected: &str) -> Result<i64, Fault> {
        match self.encoding {
            Encoding::Ascii => self.token(expected),
            Encoding::Binary { big_endian, .. } => Ok(i32::from_le_bytes(self.raw(expected, big_endian)?).into()),
        }
    }

    /// An `int` that numbers or counts something.
    pub(super) fn positive_int(&mut self, expected: &str) -> Result<u64, Fault> {
        let value = self.int(expected)?;
        u64::try_from(value).map_err(|_| self.unexpected(value.to_string().as_bytes(), expected))
    }

    pub(super) fn size(&mut self, expected: &str) -> Result<u64, Fault> {
        match self.encoding {
            Encoding::Ascii => self.token(expected),
            Encoding::Binary { big_endian, size_bytes: 4 } => {
                Ok(u32::from_le_bytes(self.raw(expected, big_endian)?).into())
            }
            Encoding::Binary { big_endian, .. } => Ok(u64::from_le_bytes(self.raw(expected, big_endian)?)),
        }
    }

    pub(super) fn real(&mut self, expected: &str) -> Result<f64, Fault> {
        match self.encoding {
            Encoding::Ascii => self.token(expected),
            Encoding::Binary { big_endian, .. } => Ok(f64::from_le_bytes(self.raw(expected, big_endian)?)),
        }
    }

    /// Three coordinates, all finite.
    pub(super) fn point(&mut self) -> Result<[f64; 3], Fault> {
        let mut point = [0.0; 3];
        for x in &mut point {
            *x = self.real("a coordinate")?;
            if !x.is_finite() {
                return Err(self.unexpected(x.to_string().as_bytes(), "a coordinate that is finite"));
            }
        }
        Ok(point)
    }

    /// `count` as a length, if the rest of the file can hold so many, each of at least `sizes`, `ints` and `reals` values.
    pub(super) fn count(&self, what: &'static str, count: u64, [sizes, ints, reals]: [u64; 3]) -> Result<usize, Fault> {
        let bytes_each = match self.encoding {
            // One figure and what parts it from the next.
            Encoding::Ascii => 2 * (sizes + ints + reals),
            Encoding::Binary { size_bytes, .. } => sizes * size_bytes as u64 + 4 * ints + 8 * reals,
        };
        let rest = (self.bytes.len() - self.at) as u64;
        // The last figure of a file needs nothing behind it.
        let possible = (rest + 1) / bytes_each.max(1);
        if count > possible {
            return Err(self.fault(Problem::Count { what, count, possible }));
        }
        // No more than the bytes of the file, which are in memory.
        Ok(count as usize)
    }

    pub(super) fn allow(&mut self, entries: usize) -> Result<(), Fault> {
        self.allowance.take(entries).map_err(|problem| self.fault(problem))
    }
}
