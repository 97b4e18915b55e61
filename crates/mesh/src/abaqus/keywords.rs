//! Lines of an Abaqus file: keywords with their parameters, and data.

use super::sources::{At, Sources};
use crate::error::{FileFault, FileProblem};

/// Keyword line with its data lines.
#[derive(Debug)]
pub(super) struct Keyword<'a> {
    /// Keyword in capitals with single blanks between words, without the star.
    pub name: String,
    /// Parameters, with names in capitals.
    pub parameters: Parameters,
    /// Line of the keyword.
    pub at: At,
    /// Lines and texts of data, without comments.
    pub data: Vec<(At, &'a str)>,
    /// Files that the lines are of.
    pub sources: &'a Sources,
}

/// Parameters of a keyword with their values.
pub(super) type Parameters = Vec<(String, Option<Name>)>;

/// Name of a set or surface.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Name {
    pub text: String,
    /// Whether the name is in quotes, and case-sensitive.
    pub quoted: bool,
}

impl Keyword<'_> {
    /// Fault in a line of the keyword.
    pub(super) fn fault(&self, at: At, problem: FileProblem) -> FileFault {
        self.sources.fault(at, &format!("*{}", self.name), problem)
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.parameters.iter().any(|(own, _)| own == name)
    }

    pub(super) fn value(&self, name: &str) -> Option<&Name> {
        self.parameters.iter().find(|(own, _)| own == name)?.1.as_ref()
    }

    /// Value of a required parameter.
    pub(super) fn required(&self, name: &str) -> Result<&Name, FileFault> {
        self.value(name).ok_or_else(|| self.fault(self.at, FileProblem::Ended { expected: format!("{name}=…") }))
    }

    pub(super) fn unsupported(&self, what: impl Into<String>, allowed: &str) -> FileFault {
        self.fault(self.at, FileProblem::Unsupported { what: what.into(), allowed: allowed.into() })
    }
}

/// Line without comments and with its continuations.
pub(super) enum LogicalLine<'a> {
    /// Keyword with its parameters, without the star.
    Keyword(String),
    /// Data, without blanks around them.
    Data(&'a str),
}

/// Lines of a text with their numbers. Comments begin with `**`, of some programs with `>**`.
pub(super) fn logical_lines(text: &str) -> impl Iterator<Item = (usize, LogicalLine<'_>)> {
    let lines = (1..).zip(text.lines()).map(|(number, line)| (number, line.trim()));
    let is_comment = |line: &str| line.is_empty() || line.starts_with("**") || line.starts_with(">**");
    let mut lines = lines.filter(move |(_, line)| !is_comment(line)).peekable();
    std::iter::from_fn(move || {
        let (number, line) = lines.next()?;
        let Some(first) = line.strip_prefix('*') else { return Some((number, LogicalLine::Data(line))) };
        let mut whole = first.to_owned();
        while whole.ends_with(',')
            && let Some((_, more)) = lines.next_if(|(_, line)| !line.starts_with('*'))
        {
            whole.push_str(more);
        }
        Some((number, LogicalLine::Keyword(whole)))
    })
}

/// Name and parameters of a keyword line.
pub(super) fn parsed(line: &str) -> (String, Parameters) {
    let mut fields = split(line).into_iter();
    let name = fields.next().unwrap_or_default();
    let name = name.split_ascii_whitespace().collect::<Vec<_>>().join(" ").to_ascii_uppercase();
    let parameters = fields.filter(|field| !field.trim().is_empty()).map(|field| match field.split_once('=') {
        Some((name, value)) => (name.trim().to_ascii_uppercase(), Some(Name::parse(value))),
        None => (field.trim().to_ascii_uppercase(), None),
    });
    (name, parameters.collect())
}

impl Name {
    /// Name from text of the file, with or without quotes.
    pub(super) fn parse(text: &str) -> Self {
        let text = text.trim();
        match text.strip_prefix('"').and_then(|rest| rest.strip_suffix('"')) {
            Some(inner) => Self { text: inner.to_owned(), quoted: true },
            None => Self { text: text.to_owned(), quoted: false },
        }
    }

    /// Whether both stand for the same; unquoted names are case-insensitive.
    pub(super) fn is(&self, other: &Name) -> bool {
        self.text == other.text || !self.quoted && !other.quoted && self.text.eq_ignore_ascii_case(&other.text)
    }
}

/// Fields of a line, separated by commas outside quotes.
pub(super) fn split(line: &str) -> Vec<&str> {
    let mut quoted = false;
    line.split(|c: char| {
        quoted ^= c == '"';
        c == ',' && !quoted
    })
    .collect()
}
