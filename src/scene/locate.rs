//! Where each key stands in the text of a scene file.

use std::collections::BTreeMap;
use std::ops::Range;

use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// Byte ranges of one key and of its value.
#[derive(Debug, Clone, PartialEq)]
struct KeySpan {
    key: Range<usize>,
    value: Range<usize>,
}

/// The places of all keys of a file, by path (`pair.pinion.teeth`, `operation.snapshots_h[2]`).
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Locator {
    places: BTreeMap<String, KeySpan>,
    end: usize,
}

impl Locator {
    /// Reads the places from the file's text.
    pub(super) fn new(text: &str) -> Result<Self, toml::de::Error> {
        let table = DeTable::parse(text)?;
        let mut locator = Self { places: BTreeMap::new(), end: text.len() };
        locator.walk(table.get_ref(), "");
        Ok(locator)
    }

    /// Where the value of `path` stands.
    pub(super) fn value(&self, path: &str) -> Option<Range<usize>> {
        self.places.get(path).map(|place| place.value.clone())
    }

    /// Where the key `path` itself stands.
    pub(super) fn key(&self, path: &str) -> Option<Range<usize>> {
        self.places.get(path).map(|place| place.key.clone())
    }

    /// Where `path` stands or, if it is not in the file, the innermost table that should hold it, or the file's end.
    pub(super) fn nearest(&self, path: &str) -> Range<usize> {
        let mut path = path;
        if let Some(place) = self.value(path) {
            return place;
        }
        while let Some((parent, _)) = path.rsplit_once('.') {
            if let Some(place) = self.key(parent) {
                return place;
            }
            path = parent;
        }
        self.end..self.end
    }

    fn walk(&mut self, table: &DeTable<'_>, prefix: &str) {
        for (key, value) in table {
            let path = join(prefix, key.get_ref());
            self.place(&path, key.span(), value);
        }
    }

    fn place(&mut self, path: &str, key: Range<usize>, value: &Spanned<DeValue<'_>>) {
        match value.get_ref() {
            DeValue::Table(table) => self.walk(table, path),
            DeValue::Array(items) => {
                for (index, item) in items.iter().enumerate() {
                    self.place(&format!("{path}[{index}]"), item.span(), item);
                }
            }
            _ => {}
        }
        self.places.insert(path.to_owned(), KeySpan { key, value: value.span() });
    }
}

/// The path of `key` in the table `prefix`.
pub(super) fn join(prefix: &str, key: &str) -> String {
    if prefix.is_empty() { key.to_owned() } else { format!("{prefix}.{key}") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_values_and_missing_ones_are_found() {
        let text = "title = \"x\"\n[pair]\nface_width_mm = 14\n[pair.pinion]\nteeth = 16\n";
        let locator = Locator::new(text).unwrap();
        assert_eq!(&text[locator.value("pair.pinion.teeth").unwrap()], "16");
        assert_eq!(&text[locator.key("pair.face_width_mm").unwrap()], "face_width_mm");
        assert_eq!(&text[locator.nearest("pair.pinion.profile_shift")], "pinion");
        assert_eq!(&text[locator.nearest("pair.wheel.teeth")], "pair");
        assert_eq!(locator.nearest("wear.law"), text.len()..text.len());
    }
}
