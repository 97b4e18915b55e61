//! Lines of an Abaqus file: keywords with their parameters, and data.

use crate::error::{FileFault, FilePosition, FileProblem};

/// Keyword line with its data lines.
#[derive(Debug)]
pub(super) struct Keyword<'a> {
    /// Keyword in capitals with single blanks between words, without the star.
    pub name: String,
    /// Parameters, with names in capitals.
    pub parameters: Vec<(String, Option<Name>)>,
    /// Line number, from 1.
    pub line: usize,
    /// Line numbers and texts of data, without comments.
    pub data: Vec<(usize, &'a str)>,
}

/// Name of a set or surface.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Name {
    pub text: String,
    /// Whether the name is in quotes, and case-sensitive.
    pub quoted: bool,
}

impl Keyword<'_> {
    /// Fault in a `line` of the keyword.
    pub(super) fn fault(&self, line: usize, problem: FileProblem) -> FileFault {
        FileFault { place: Some(FilePosition::Line(line)), section: format!("*{}", self.name), problem }
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.parameters.iter().any(|(own, _)| own == name)
    }

    pub(super) fn value(&self, name: &str) -> Option<&Name> {
        self.parameters.iter().find(|(own, _)| own == name)?.1.as_ref()
    }

    /// Value of a required parameter.
    pub(super) fn required(&self, name: &str) -> Result<&Name, FileFault> {
        self.value(name).ok_or_else(|| self.fault(self.line, FileProblem::Ended { expected: format!("{name}=…") }))
    }

    pub(super) fn refuse_input(&self, allowed: &str) -> Result<(), FileFault> {
        if self.has("INPUT") { Err(self.unsupported("INPUT=", allowed)) } else { Ok(()) }
    }

    pub(super) fn unsupported(&self, what: impl Into<String>, allowed: &str) -> FileFault {
        self.fault(self.line, FileProblem::Unsupported { what: what.into(), allowed: allowed.into() })
    }
}

/// All keywords of a file in order.
pub(super) fn keywords(text: &str) -> Result<Vec<Keyword<'_>>, FileFault> {
    let mut keywords: Vec<Keyword> = Vec::new();
    let mut lines = (1..).zip(text.lines()).filter(|(_, line)| !line.trim_start().starts_with("**"));
    while let Some((number, line)) = lines.next() {
        let line = line.trim();
        if let Some(first) = line.strip_prefix('*') {
            let mut whole = first.to_owned();
            while whole.trim_end().ends_with(',') {
                match lines.next() {
                    Some((_, more)) => whole.push_str(more),
                    None => break,
                }
            }
            keywords.push(keyword(&whole, number));
        } else if !line.is_empty() {
            match keywords.last_mut() {
                Some(keyword) => keyword.data.push((number, line)),
                None => {
                    let problem = FileProblem::unexpected(line, "a keyword, `*NODE` for example");
                    return Err(FileFault { place: Some(FilePosition::Line(number)), section: String::new(), problem });
                }
            }
        }
    }
    Ok(keywords)
}

fn keyword<'a>(line: &str, number: usize) -> Keyword<'a> {
    let mut fields = split(line).into_iter();
    let name = fields.next().unwrap_or_default();
    let name = name.split_ascii_whitespace().collect::<Vec<_>>().join(" ").to_ascii_uppercase();
    let parameters = fields.filter(|field| !field.trim().is_empty()).map(|field| match field.split_once('=') {
        Some((name, value)) => (name.trim().to_ascii_uppercase(), Some(Name::parse(value))),
        None => (field.trim().to_ascii_uppercase(), None),
    });
    Keyword { name, parameters: parameters.collect(), line: number, data: Vec::new() }
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
