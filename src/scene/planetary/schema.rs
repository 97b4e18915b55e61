//! The JSON schema of the file of a planetary stage.

use std::sync::OnceLock;

use serde_json::{Map, Value, json};

use super::StageFile;
use super::mesh::StageMesh;
use crate::scene::schema::{schema as scene_schema, schema_of};

/// What the file says of the stage itself.
pub(super) fn stage() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(schema_of::<StageFile>)
}

/// The whole file, for editors: the tables of the stage, and those of a pair's scene with the names of three gears.
pub fn published() -> &'static Value {
    static PUBLISHED: OnceLock<Value> = OnceLock::new();
    PUBLISHED.get_or_init(whole)
}

fn whole() -> Value {
    let mut whole = stage().clone();
    whole["title"] = json!("gearwear planetary stage");
    let mut common = Map::new();
    if let Some(Value::Object(tables)) = scene_schema().get("properties") {
        let others = tables.iter().filter(|(name, _)| !matches!(name.as_str(), "pair" | "operation"));
        common.extend(others.map(|(name, table)| (name.clone(), with_three_gears(table.clone()))));
    }
    for mesh in StageMesh::BOTH {
        let description = format!("What holds for the mesh of {} alone. Default: as for both.", mesh.in_words());
        let own = common.iter().filter(|(name, _)| name.as_str() != "title");
        let mut properties: Map<String, Value> =
            own.map(|(name, table)| (name.clone(), optional(table.clone()))).collect();
        for gear in mesh.gears() {
            properties.insert(gear.to_owned(), stage()["properties"]["planetary"]["properties"][gear].clone());
        }
        let table = json!({ "description": description, "type": "object", "properties": properties, "additionalProperties": false });
        whole["properties"][mesh.table()] = table;
    }
    for (name, table) in common {
        let table = if name == "wear" { table } else { optional(table) };
        whole["properties"][name] = table;
    }
    whole
}

/// A table none of whose keys is required, since the other place may give them.
fn optional(mut table: Value) -> Value {
    if let Value::Object(table) = &mut table {
        table.remove("required");
    }
    table
}

/// A schema whose tables of pinion and wheel are those of sun, planet and ring.
fn with_three_gears(mut schema: Value) -> Value {
    match &mut schema {
        Value::Object(node) => {
            for value in node.values_mut() {
                *value = with_three_gears(value.take());
            }
            if let Some(Value::Object(properties)) = node.get_mut("properties")
                && let (Some(gear), Some(_)) = (properties.remove("pinion"), properties.remove("wheel"))
            {
                for name in ["sun", "planet", "ring"] {
                    let mut gear = gear.clone();
                    if let Some(Value::String(text)) = gear.get_mut("description") {
                        *text = text.replace("pinion", name);
                    }
                    properties.insert(name.to_owned(), gear);
                }
            }
        }
        Value::Array(items) => {
            for item in items {
                *item = with_three_gears(item.take());
            }
        }
        _ => {}
    }
    schema
}
