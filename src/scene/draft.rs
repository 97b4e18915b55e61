//! A scene file whose values can be changed before it is resolved, as for the combinations of a sweep.
//!
//! The text is read once. A value that is exchanged stands where the user would have written it, so that everything
//! the file leaves open is chosen anew for each combination: a tip diameter that follows from the rack, say.

use toml::{Table, Value};

use super::findings::Findings;
use super::key::{as_whole, is_key, linked_keys, takes_whole_numbers};
use super::locate::Locator;
use super::problem::Problem;
use super::table::{self, other_ways_to_say};
use super::{Resolved, resolve, short_hash, text};

/// A scene file, read but not resolved.
#[derive(Debug, Clone, PartialEq)]
pub struct Draft {
    table: Table,
    locator: Locator,
}

impl Draft {
    /// Reads the text of a scene file.
    pub fn parse(text: &str) -> Result<Self, Vec<Problem>> {
        let (table, findings) = text::parse(text)?;
        Ok(Self { table, locator: findings.into_locator() })
    }

    /// Sets the key at the path `key`, and removes its alternative keys.
    pub fn set(&mut self, key: &str, value: impl Into<Value>) {
        for other in other_ways_to_say(key) {
            self.remove(&other);
        }
        table::set(&mut self.table, key, value);
    }

    /// Changes all these keys, each to a value or to nothing. A key with alternatives, `pair.{pinion,wheel}.teeth`, is all of them, and a number without a
    /// fraction is whole where the key takes whole numbers.
    pub fn change_all(&mut self, changes: impl IntoIterator<Item = (String, Option<Value>)>) {
        for (keys, value) in changes {
            for key in linked_keys(&keys) {
                match &value {
                    Some(value) if takes_whole_numbers(&key) => self.set(&key, as_whole(value)),
                    Some(value) => self.set(&key, value.clone()),
                    None if is_key(&key) => self.remove(&key),
                    // As a key that is given, it is refused with what was probably meant.
                    None => self.set(&key, true),
                }
            }
        }
    }

    /// Whether the file gives the key at the path `key`.
    pub fn gives(&self, key: &str) -> bool {
        let mut parts = key.split('.');
        let first = parts.next().and_then(|part| self.table.get(part));
        let found = first.and_then(|first| {
            parts.try_fold(first, |value, part| match (value.as_array(), part.parse::<usize>()) {
                (Some(list), Ok(number)) => list.get(number.checked_sub(1)?),
                _ => value.get(part),
            })
        });
        found.is_some()
    }

    /// Removes the key at the path `key`.
    pub fn remove(&mut self, key: &str) {
        table::remove(&mut self.table, key);
    }

    /// Resolves the draft.
    ///
    /// # Errors
    /// Everything that is wrong with it, at the places of the text it was read from.
    pub fn resolve(&self) -> Result<Resolved, Vec<Problem>> {
        let (table, findings) = self.to_resolve();
        resolve::resolve_table(table, findings)
    }

    /// The table, and findings that know where its keys stand.
    pub(super) fn to_resolve(&self) -> (Table, Findings) {
        (self.table.clone(), Findings::new(self.locator.clone()))
    }

    /// Number at the path `key`; items of lists are numbered from 1.
    pub fn number(&self, key: &str) -> Option<f64> {
        number_at(&self.table, key)
    }

    /// Word at the path `key`, which leads through tables alone.
    pub fn word(&self, key: &str) -> Option<&str> {
        table::at(&self.table, key)?.as_str()
    }

    /// Paths of all values.
    pub fn keys(&self) -> Vec<String> {
        table::keys_of(&self.table, "")
    }

    /// Scene as text, with the changes made.
    pub fn to_toml(&self) -> String {
        self.table.to_string()
    }

    /// First 16 hexadecimal digits of the SHA-256 of the content, independent of layout and comments.
    pub fn hash(&self) -> String {
        short_hash(self.table.to_string().as_bytes())
    }
}

/// The number at the path `key` of a table; items of lists are numbered from 1.
pub fn number_at(table: &Table, key: &str) -> Option<f64> {
    let mut parts = key.split('.');
    let first = table.get(parts.next()?)?;
    let value = parts.try_fold(first, |value, part| match value.as_array() {
        Some(list) => list.get(part.parse::<usize>().ok()?.checked_sub(1)?),
        None => value.get(part),
    })?;
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::presets;

    /// Keys of phases are numbered from 1.
    #[test]
    fn items_of_lists_are_exchanged() {
        let text = "[operation]\n[[operation.phases]]\nhours = 1.0\n[[operation.phases]]\nhours = 2.0\n";
        let mut draft = Draft::parse(text).unwrap();
        assert!(draft.gives("operation.phases.2.hours") && !draft.gives("operation.phases.3.hours"));
        draft.set("operation.phases.2.hours", 5.0);
        draft.set("operation.phases.3.hours", 7.0);
        draft.remove("operation.phases.1.hours");
        let hours: Vec<Option<f64>> = draft.table["operation"]["phases"]
            .as_array()
            .unwrap()
            .iter()
            .map(|phase| phase.get("hours").and_then(Value::as_float))
            .collect();
        assert_eq!(hours, [None, Some(5.0)]);
    }

    /// Exchanging values gives the same scene as writing them into the text.
    #[test]
    fn a_draft_resolves_as_its_text_would() {
        let text = presets::find("fzg-c").unwrap().text;
        let mut draft = Draft::parse(text).unwrap();
        assert_eq!(draft.resolve().unwrap(), Resolved::from_toml(text).unwrap());
        draft.set("pair.face_width_mm", 20.0);
        draft.set("pair.pinion.teeth", 17);
        draft.remove("pair.pinion.tip_diameter_mm");
        draft.remove("pair.pinion.basic_rack.nothing");
        let written = text
            .replace("face_width_mm = 14.0", "face_width_mm = 20.0")
            .replace("teeth = 16", "teeth = 17")
            .replace("tip_diameter_mm = 82.46", "");
        let (mine, theirs) = (draft.resolve(), Resolved::from_toml(&written));
        assert_eq!(mine.map(|r| r.scene), theirs.map(|r| r.scene));
    }

    #[test]
    fn a_key_beside_a_preset_and_a_second_way_to_say_it() {
        let text = "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302\npinion_revolutions = 1e6\n\
                    [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n";
        let mut draft = Draft::parse(text).unwrap();
        let as_given = draft.hash();
        draft.set("pair.wheel.tip_relief.amount_um", 20.0);
        draft.set("pair.wheel.tip_relief.length_mm", 2.0);
        draft.set("wear.coefficient_mm3_per_Nm", 2e-8);
        draft.set("operation.hours", 10);
        draft.set("operation.pinion_speed_rpm", 100);
        let scene = draft.resolve().unwrap().scene;
        assert_eq!(scene.pair.gears.wheel.modification.tip_relief.unwrap().amount_mm, 0.02);
        assert_eq!(scene.operation.pinion_revolutions, 60_000.0);
        assert_ne!(draft.hash(), as_given);
        assert_eq!(Draft::parse(&format!("# a comment\n{text}")).unwrap().hash(), as_given);
    }
}
