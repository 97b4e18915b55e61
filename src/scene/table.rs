//! Keys of a scene by their paths in its TOML table: which there are, which say the same thing, and how one is set or removed.

use toml::{Table, Value};

use super::locate::join;

/// Alternative keys: setting one removes the others.
const SAME_THING: [&[&str]; 10] = [
    &["pair.normal_module_mm", "pair.transverse_module_mm"],
    &["pair.pressure_angle_deg", "pair.transverse_pressure_angle_deg"],
    &["planetary.normal_module_mm", "planetary.transverse_module_mm"],
    &["planetary.pressure_angle_deg", "planetary.transverse_pressure_angle_deg"],
    &["pair.centre_distance_mm", "pair.backlash_um", "pair.normal_backlash_um"],
    &["operation.hours", "operation.pinion_revolutions", "operation.revolutions"],
    &["wear.coefficient_m2_per_N", "wear.coefficient_mm3_per_Nm"],
    &["contact.foundation_MPa_per_mm", "contact.match"],
    &["lubricant.viscosity_class", "lubricant.viscosity_40C_mm2_per_s"],
    &["lubricant.pressure_viscosity", "lubricant.pressure_viscosity_per_GPa"],
];

/// Alternative keys of `pair.pinion` and `pair.wheel`, and of the gears of a planetary stage.
const SAME_THING_OF_GEAR: [&[&str]; 3] = [
    &["tip_relief.length_mm", "tip_relief.begins_at_diameter_mm", "tip_relief.begins_at_roll_angle_deg"],
    &["root_relief.length_mm", "root_relief.begins_at_diameter_mm", "root_relief.begins_at_roll_angle_deg"],
    &["helix_slope_deviation_um", "helix_slope_class"],
];

/// Tables of what holds for one mesh of a planetary stage alone, and its gears.
const OF_MESHES: [&str; 2] = ["sun_planet.", "planet_ring."];
const GEARS_OF_STAGE: [&str; 3] = ["sun.", "planet.", "ring."];

/// Alternative keys of `wear.pinion` and `wear.wheel`, and of the gears of a planetary stage.
const SAME_THING_OF_WEAR: [&[&str]; 1] = [&["coefficient_m2_per_N", "coefficient_mm3_per_Nm"]];

/// Alternative keys of `key`.
pub fn other_ways_to_say(key: &str) -> Vec<String> {
    if let Some((table, rest)) = OF_MESHES.iter().find_map(|table| Some((table, key.strip_prefix(table)?))) {
        let of_gear = GEARS_OF_STAGE.iter().any(|gear| rest.starts_with(gear));
        let above = if of_gear { "planetary." } else { "" };
        let others = other_ways_to_say(&format!("{above}{rest}"));
        return others.iter().map(|other| format!("{table}{}", other.strip_prefix(above).unwrap_or(other))).collect();
    }
    let tables: [(&str, &[&[&str]]); 11] = [
        ("pair.pinion.", &SAME_THING_OF_GEAR),
        ("pair.wheel.", &SAME_THING_OF_GEAR),
        ("planetary.sun.", &SAME_THING_OF_GEAR),
        ("planetary.planet.", &SAME_THING_OF_GEAR),
        ("planetary.ring.", &SAME_THING_OF_GEAR),
        ("wear.pinion.", &SAME_THING_OF_WEAR),
        ("wear.wheel.", &SAME_THING_OF_WEAR),
        ("wear.sun.", &SAME_THING_OF_WEAR),
        ("wear.planet.", &SAME_THING_OF_WEAR),
        ("wear.ring.", &SAME_THING_OF_WEAR),
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

/// Value at the path `key` of `table`, which leads through tables alone.
pub(super) fn at<'a>(table: &'a Table, key: &str) -> Option<&'a Value> {
    let mut parts = key.split('.');
    let first = table.get(parts.next()?)?;
    parts.try_fold(first, |value, part| value.get(part))
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

#[cfg(test)]
mod tests {
    use super::*;

    /// What holds for one mesh alone has the alternatives of what holds for both.
    #[test]
    fn keys_of_a_stage_have_their_alternatives() {
        for (key, other) in [
            ("wear.ring.coefficient_m2_per_N", "wear.ring.coefficient_mm3_per_Nm"),
            ("sun_planet.wear.coefficient_mm3_per_Nm", "sun_planet.wear.coefficient_m2_per_N"),
            ("planet_ring.wear.ring.coefficient_mm3_per_Nm", "planet_ring.wear.ring.coefficient_m2_per_N"),
            ("sun_planet.planet.helix_slope_class", "sun_planet.planet.helix_slope_deviation_um"),
            ("planetary.normal_module_mm", "planetary.transverse_module_mm"),
        ] {
            assert_eq!(other_ways_to_say(key), [other], "{key}");
        }
        assert!(other_ways_to_say("sun_planet.planet.tip_rounding_mm").is_empty());
    }
}
