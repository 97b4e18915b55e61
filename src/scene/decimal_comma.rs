//! Decimal commas: `face_width_mm = 30,5`, as decimals are written in much of Europe.
//!
//! TOML ends the number at the comma and says so in its own terms. What was meant is plain, so that each such value becomes a problem of
//! its key. In a list a comma between digits is TOML, `[1,5]`, and is left alone.

use std::ops::Range;

use super::locate::join;
use super::problem::{Problem, ProblemKind};

/// A value with a decimal comma.
#[derive(Debug, Clone, PartialEq)]
struct DecimalComma {
    /// Path of its key.
    key: String,
    /// Where the value stands, in bytes from the beginning of the text.
    span: Range<usize>,
}

/// The values with decimal commas in a text that is no TOML because of what stands at the byte `at`; none where something else is wrong
/// there.
pub(super) fn problems(text: &str, at: usize) -> Vec<Problem> {
    let found = find(text);
    let line = line_of(text, at);
    if !found.iter().any(|comma| line_of(text, comma.span.start) == line) {
        return Vec::new();
    }
    let problems = found.into_iter().map(|DecimalComma { key, span }| Problem {
        kind: ProblemKind::NotAllowed,
        key,
        found: text[span.clone()].to_owned(),
        allowed: "a decimal point, not a comma".to_owned(),
        help: mended(&text[span.clone()]).map(|number| format!("write {number}")),
        span: Some(span),
    });
    problems.collect()
}

/// Number of lines that end before this byte.
fn line_of(text: &str, byte: usize) -> usize {
    text.as_bytes()[..byte.min(text.len())].iter().filter(|&&byte| byte == b'\n').count()
}

/// Number with a decimal point, where `text` is a number with a decimal comma.
pub(super) fn mended(text: &str) -> Option<String> {
    let text = text.trim();
    (number_with_comma(text.as_bytes()) == Some(text.len())).then(|| text.replace(',', "."))
}

/// The help for a number that cannot be read because of its decimal comma.
pub fn help(text: &str) -> Option<String> {
    mended(text).map(|number| format!("decimal point, not comma: {number}"))
}

fn find(text: &str) -> Vec<DecimalComma> {
    let (mut found, mut table, mut headers, mut begin) = (Vec::new(), String::new(), Vec::new(), 0);
    for line in text.split_inclusive('\n') {
        let header = line.trim_start();
        if header.starts_with('[') {
            table = path_of_table(header, &mut headers);
        } else {
            find_in_line(line, begin, &table, &mut found);
        }
        begin += line.len();
    }
    found
}

/// The path that a header `[table]` or `[[list]]` opens; `before` are the headers that stood above it.
fn path_of_table(header: &str, before: &mut Vec<String>) -> String {
    let is_list = header.starts_with("[[");
    let name: String =
        header.trim_start_matches('[').chars().take_while(|&c| c != ']').filter(|c| !c.is_whitespace()).collect();
    if !is_list {
        return name;
    }
    let index = before.iter().filter(|other| **other == name).count();
    before.push(name.clone());
    format!("{name}[{index}]")
}

/// Finds `key = 30,5` in a line, also within `{ … }`.
fn find_in_line(line: &str, begin: usize, table: &str, found: &mut Vec<DecimalComma>) {
    let bytes = line.as_bytes();
    let (mut quote, mut outer, mut word) = (None, String::new(), String::new());
    let mut at = 0;
    while let Some(&byte) = bytes.get(at) {
        at += 1;
        match (quote, byte) {
            (Some(open), _) => quote = Some(open).filter(|&open| open != byte),
            (None, b'"' | b'\'') => quote = Some(byte),
            (None, b'#') => return,
            (None, b'{') => outer = std::mem::take(&mut word),
            (None, b',' | b'}') => word.clear(),
            (None, b'=') => {
                at += bytes[at..].iter().take_while(|&&byte| byte == b' ' || byte == b'\t').count();
                if let Some(length) = number_with_comma(&bytes[at..]) {
                    let key = [outer.trim(), word.trim()]
                        .iter()
                        .fold(table.to_owned(), |path, name| if name.is_empty() { path } else { join(&path, name) });
                    found.push(DecimalComma { key, span: begin + at..begin + at + length });
                    at += length;
                    word.clear();
                }
            }
            (None, byte) => word.push(char::from(byte)),
        }
    }
}

/// Length of a number with a decimal comma at the beginning of `bytes`.
fn number_with_comma(bytes: &[u8]) -> Option<usize> {
    let sign = usize::from(matches!(bytes.first(), Some(b'+' | b'-')));
    let comma = sign + leading_digits(&bytes[sign..]);
    if comma == sign || bytes.get(comma) != Some(&b',') || leading_digits(&bytes[comma + 1..]) == 0 {
        return None;
    }
    let end = comma + 1 + leading_digits(&bytes[comma + 1..]);
    let exponent = match bytes.get(end) {
        Some(b'e' | b'E') => 1 + usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-'))),
        _ => return Some(end),
    };
    let power = bytes.get(end + exponent..).map_or(0, leading_digits);
    Some(if power == 0 { end } else { end + exponent + power })
}

fn leading_digits(bytes: &[u8]) -> usize {
    bytes.iter().take_while(|byte| byte.is_ascii_digit()).count()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_with_a_comma_are_recognised() {
        for (text, meant) in [("30,5", "30.5"), (" -0,25 ", "-0.25"), ("1,5e-17", "1.5e-17"), ("+2,0E6", "+2.0E6")] {
            assert_eq!(mended(text).as_deref(), Some(meant), "{text}");
        }
        for text in ["30.5", "30,", ",5", "1,2,3", "x,5", "1,5e", "", "-", "1, 5"] {
            assert_eq!(mended(text), None, "{text}");
        }
    }

    #[test]
    fn keys_are_those_of_their_tables() {
        let text = "title = \"a = 1,5\" # b = 2,5\n[pair]\nface_width_mm = 30,5\ntip_relief = { amount_um = 20,5, length_mm=2,1 }\n\
                    [[operation.phases]]\nhours = 1\n[[ operation.phases ]]\nhours = 1,5\nlist = [1,5]\n";
        let found = find(text);
        let keys: Vec<&str> = found.iter().map(|comma| comma.key.as_str()).collect();
        let expected = [
            "pair.face_width_mm",
            "pair.tip_relief.amount_um",
            "pair.tip_relief.length_mm",
            "operation.phases[1].hours",
        ];
        assert_eq!(keys, expected);
        let values: Vec<&str> = found.iter().map(|comma| &text[comma.span.clone()]).collect();
        assert_eq!(values, ["30,5", "20,5", "2,1", "1,5"]);
    }
}
