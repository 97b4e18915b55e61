//! A scene file whose values can be changed before it is resolved, as for the combinations of a sweep.
//!
//! The text is read once. A value that is exchanged stands where the user would have written it, so that everything
//! the file leaves open is chosen anew for each combination: a tip diameter that follows from the rack, say.

use toml::{Table, Value};

use super::findings::Findings;
use super::locate::{Locator, join};
use super::problem::Problem;
use super::{Resolved, resolve, short_hash, text};

/// Alternative keys: setting one removes the others.
const SAME_THING: [&[&str]; 8] = [
    &["pair.normal_module_mm", "pair.transverse_module_mm"],
    &["pair.pressure_angle_deg", "pair.transverse_pressure_angle_deg"],
    &["pair.centre_distance_mm", "pair.backlash_um", "pair.normal_backlash_um"],
    &["operation.hours", "operation.pinion_revolutions"],
    &["wear.coefficient_m2_per_N", "wear.coefficient_mm3_per_Nm"],
    &["contact.foundation_MPa_per_mm", "contact.match"],
    &["lubricant.viscosity_class", "lubricant.viscosity_40C_mm2_per_s"],
    &["lubricant.pressure_viscosity", "lubricant.pressure_viscosity_per_GPa"],
];

/// Alternative keys of `pair.pinion` and `pair.wheel`.
const SAME_THING_OF_GEAR: [&[&str]; 3] = [
    &["tip_relief.length_mm", "tip_relief.begins_at_diameter_mm", "tip_relief.begins_at_roll_angle_deg"],
    &["root_relief.length_mm", "root_relief.begins_at_diameter_mm", "root_relief.begins_at_roll_angle_deg"],
    &["helix_slope_deviation_um", "helix_slope_class"],
];

/// Alternative keys of `wear.pinion` and `wear.wheel`.
const SAME_THING_OF_WEAR: [&[&str]; 1] = [&["coefficient_m2_per_N", "coefficient_mm3_per_Nm"]];

/// Alternative keys of `key`.
pub fn other_ways_to_say(key: &str) -> Vec<String> {
    let tables: [(&str, &[&[&str]]); 5] = [
        ("pair.pinion.", &SAME_THING_OF_GEAR),
        ("pair.wheel.", &SAME_THING_OF_GEAR),
        ("wear.pinion.", &SAME_THING_OF_WEAR),
        ("wear.wheel.", &SAME_THING_OF_WEAR),
        ("", &SAME_THING),
    ];
    let found = tables.into_iter().find_map(|(table, groups)| Some((table, key.strip_prefix(table)?, groups)));
    let (table, name, groups) = found.unwrap_or_default();
    let group = groups.iter().find(|group| group.contains(&name)).copied().unwrap_or_default();
    group.iter().filter(|other| **other != name).map(|other| format!("{table}{other}")).collect()
}

/// The paths of all values of `table`, which stands at `path`, that are no tables.
pub fn keys_of(table: &Table, path: &str) -> Vec<String> {
    let keys = table.iter().flat_map(|(name, value)| match value {
        Value::Table(table) => keys_of(table, &join(path, name)),
        _ => vec![join(path, name)],
    });
    keys.collect()
}

/// Removes the key at the path `key` of `table`. Items of lists are numbered from 1.
pub fn remove(mut table: &mut Table, key: &str) {
    let mut parts = key.split('.').rev();
    let Some(name) = parts.next() else { return };
    let mut path = parts.rev().peekable();
    while let Some(part) = path.next() {
        let Some(mut below) = table.get_mut(part) else { return };
        if let Some(number) = path.next_if(|next| below.is_array() && next.parse::<usize>().is_ok()) {
            let Some(item) = item_mut(below, number) else { return };
            below = item;
        }
        let Some(next) = below.as_table_mut() else { return };
        table = next;
    }
    table.remove(name);
}

/// Sets the key at the path `key` of `table`. Items of lists are numbered from 1; an item that the list does not have is not added.
pub fn set(table: &mut Table, key: &str, value: impl Into<Value>) {
    let (tables, name) = key.rsplit_once('.').map_or((None, key), |(tables, name)| (Some(tables), name));
    let mut table = table;
    let mut path = tables.into_iter().flat_map(|tables| tables.split('.')).peekable();
    while let Some(part) = path.next() {
        let mut below = table.entry(part).or_insert_with(|| Value::Table(Table::new()));
        if let Some(number) = path.next_if(|next| below.is_array() && next.parse::<usize>().is_ok()) {
            let Some(item) = item_mut(below, number) else { return };
            below = item;
        }
        if path.peek().is_none()
            && let Some(item) = below.is_array().then(|| item_mut(below, name)).flatten()
        {
            *item = value.into();
            return;
        }
        if !below.is_table() {
            // Resolving reports that the key takes no table.
            *below = Value::Table(Table::new());
        }
        table = below.as_table_mut().expect("it is a table now");
    }
    table.insert(name.to_owned(), value.into());
}

/// The item of a list that has this number, from 1.
fn item_mut<'a>(list: &'a mut Value, number: &str) -> Option<&'a mut Value> {
    let index = number.parse::<usize>().ok()?.checked_sub(1)?;
    list.as_array_mut()?.get_mut(index)
}

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
        set(&mut self.table, key, value);
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
        remove(&mut self.table, key);
    }

    /// Resolves the draft.
    ///
    /// # Errors
    /// Everything that is wrong with it, at the places of the text it was read from.
    pub fn resolve(&self) -> Result<Resolved, Vec<Problem>> {
        resolve::resolve_table(self.table.clone(), Findings::new(self.locator.clone()))
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
