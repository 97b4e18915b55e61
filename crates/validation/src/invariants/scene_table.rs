//! A scene as the table of its file, and changes that follow from the units in which keys end.

use toml::{Table, Value};

use gearwear::scene::table::set;

/// The value at the path `key`.
pub(super) fn value<'a>(table: &'a Table, key: &str) -> Option<&'a Value> {
    let mut parts = key.split('.');
    let first = table.get(parts.next()?)?;
    parts.try_fold(first, |value, part| value.get(part))
}

/// Whether the scene gives the key at the path `key`.
pub(super) fn gives(table: &Table, key: &str) -> bool {
    value(table, key).is_some()
}

/// The number at the path `key`.
pub(super) fn number(table: &Table, key: &str) -> Option<f64> {
    let value = value(table, key)?;
    value.as_float().or_else(|| value.as_integer().map(|whole| whole as f64))
}

/// The word at the path `key`.
pub(super) fn word<'a>(table: &'a Table, key: &str) -> Option<&'a str> {
    value(table, key)?.as_str()
}

/// The phases of the operation, where there are any.
pub(super) fn phases(table: &Table) -> Option<&Vec<Value>> {
    value(table, "operation.phases")?.as_array()
}

/// The scene with the value at the path `key` exchanged.
pub(super) fn with(table: &Table, key: &str, value: impl Into<Value>) -> Table {
    let mut table = table.clone();
    set(&mut table, key, value);
    table
}

/// The scene with every number `x` of a key multiplied by `factor` of the key's name, in all tables and lists.
pub(super) fn scaled(table: &Table, factor: &dyn Fn(&str) -> f64) -> Table {
    let mut table = table.clone();
    scale(&mut table, factor);
    table
}

fn scale(table: &mut Table, factor: &dyn Fn(&str) -> f64) {
    for (name, value) in table.iter_mut() {
        scale_value(value, factor(name), factor);
    }
}

fn scale_value(value: &mut Value, by: f64, factor: &dyn Fn(&str) -> f64) {
    match value {
        Value::Table(below) => scale(below, factor),
        Value::Array(items) => items.iter_mut().for_each(|item| scale_value(item, by, factor)),
        Value::Float(number) if by != 1.0 => *number *= by,
        Value::Integer(whole) if by != 1.0 => *value = Value::Float(*whole as f64 * by),
        _ => {}
    }
}

/// Exchanges the tables `pinion` and `wheel` wherever both gears have one.
pub(super) fn exchange_gears(table: &mut Table) {
    for (_, value) in table.iter_mut() {
        match value {
            Value::Table(below) => exchange_gears(below),
            Value::Array(items) => items.iter_mut().filter_map(Value::as_table_mut).for_each(exchange_gears),
            _ => {}
        }
    }
    let (pinion, wheel) = (table.remove("pinion"), table.remove("wheel"));
    let renamed = [("pinion", wheel), ("wheel", pinion)];
    renamed.into_iter().for_each(|(name, of)| {
        of.map(|of| table.insert(name.to_owned(), of));
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_scale_and_gears_change_places_in_lists_too() {
        let text = "[a]\nx_mm = 2\ny_um = [1.0, 2.0]\n[a.pinion]\nteeth = 16\n[[p]]\nx_mm = 3.0\n[p.wheel]\nk = 1.0\n";
        let table: Table = text.parse().unwrap();
        let scaled = scaled(&table, &|key| if key.ends_with("_mm") { 10.0 } else { 1.0 });
        assert_eq!((number(&scaled, "a.x_mm"), number(&scaled, "a.pinion.teeth")), (Some(20.0), Some(16.0)));
        assert_eq!(value(&scaled, "p").unwrap()[0]["x_mm"].as_float(), Some(30.0));
        let mut exchanged = table.clone();
        exchange_gears(&mut exchanged);
        assert!(gives(&exchanged, "a.wheel.teeth") && !gives(&exchanged, "a.pinion"));
        assert_eq!(value(&exchanged, "p").unwrap()[0]["pinion"]["k"].as_float(), Some(1.0));
        exchange_gears(&mut exchanged);
        assert_eq!(exchanged, table);
    }
}
