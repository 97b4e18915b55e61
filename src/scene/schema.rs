//! The JSON schema of the scene file, from the types of [`super::file`], and of any other file made the same way.

use std::sync::OnceLock;

use schemars::generate::SchemaSettings;
use schemars::transform::{Transform, transform_subschemas};
use schemars::{JsonSchema, Schema};
use serde_json::Value;

use super::file::SceneFile;

/// The schema of a scene.
pub fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(schema_of::<SceneFile>)
}

/// The schema of a scene for editors, in which an internal wheel may have negative numbers: a scene is checked once they are positive.
pub fn published() -> &'static Value {
    static PUBLISHED: OnceLock<Value> = OnceLock::new();
    PUBLISHED.get_or_init(with_negative_numbers)
}

fn with_negative_numbers() -> Value {
    let mut whole = schema().clone();
    let pair = "/properties/pair/properties";
    if let Some(Value::Object(teeth)) = whole.pointer_mut(&format!("{pair}/wheel/properties/teeth")) {
        let bounds = |least: i64, most: i64| serde_json::json!({ "minimum": least, "maximum": most });
        teeth.retain(|key, _| !matches!(key.as_str(), "minimum" | "maximum" | "format"));
        teeth.insert("anyOf".to_owned(), Value::Array(vec![bounds(5, 10_000), bounds(-10_000, -5)]));
    }
    for key in ["centre_distance_mm", "wheel/properties/tip_diameter_mm", "wheel/properties/root_diameter_mm"] {
        if let Some(Value::Object(length)) = whole.pointer_mut(&format!("{pair}/{key}")) {
            length.remove("exclusiveMinimum");
            length.insert("not".to_owned(), serde_json::json!({ "const": 0 }));
        }
    }
    whole
}

/// The schema (draft 2020-12) of a file, without references: every table is described where it stands.
pub fn schema_of<F: JsonSchema>() -> Value {
    let settings = SchemaSettings::draft2020_12().with(|s| s.inline_subschemas = true).with_transform(WithoutNull);
    settings.into_generator().into_root_schema_for::<F>().to_value()
}

/// TOML has no null: an optional key is left out.
#[derive(Debug, Clone)]
struct WithoutNull;

impl Transform for WithoutNull {
    fn transform(&mut self, schema: &mut Schema) {
        transform_subschemas(self, schema);
        let Some(node) = schema.as_object_mut() else { return };
        if let Some(Value::Array(types)) = node.get_mut("type") {
            types.retain(|name| name != "null");
            if let [only] = types.as_slice() {
                let only = only.clone();
                node.insert("type".to_owned(), only);
            }
        }
        if let Some(Value::Array(variants)) = node.get_mut("anyOf") {
            variants.retain(|variant| variant.get("type").is_none_or(|name| name != "null"));
            if let [Value::Object(only)] = variants.as_slice() {
                let only = only.clone();
                node.remove("anyOf");
                for (key, value) in only {
                    // The field's own description and default come first.
                    node.entry(key).or_insert(value);
                }
            }
        }
        if node.get("default").is_some_and(Value::is_null) {
            node.remove("default");
        }
    }
}

/// Values that a key takes, read from its node of the schema.
#[derive(Debug, Clone, Copy)]
pub struct Node<'a>(&'a Value);

impl<'a> Node<'a> {
    /// The whole file that `schema` describes.
    pub fn root(schema: &'a Value) -> Self {
        Node(schema)
    }

    /// Schema of `value`'s kind, where the key takes a table as well as a word.
    pub(super) fn variant(self, value: &toml::Value) -> Node<'a> {
        let kind = if value.is_str() { "string" } else { "object" };
        self.variants().find(|variant| variant.type_name() == kind).unwrap_or(self)
    }

    /// Alternatives, where values of several kinds are taken.
    fn variants(self) -> impl Iterator<Item = Node<'a>> {
        self.0.get("anyOf").and_then(Value::as_array).into_iter().flatten().map(Node)
    }

    /// The table that this key takes.
    fn table(self) -> Node<'a> {
        self.variants().find(|variant| variant.type_name() == "object").unwrap_or(self)
    }

    /// The key `name` of this table.
    pub fn child(&self, name: &str) -> Option<Node<'a>> {
        self.table().0.get("properties")?.get(name).map(Node)
    }

    /// The names of all keys of this table, in alphabetical order.
    pub fn keys(&self) -> Vec<&'a str> {
        match self.table().0.get("properties") {
            Some(Value::Object(properties)) => properties.keys().map(String::as_str).collect(),
            _ => Vec::new(),
        }
    }

    /// The keys this table must have.
    pub(super) fn required(&self) -> Vec<&'a str> {
        strings(self.0.get("required"))
    }

    /// Schema of each item of a list.
    pub fn items(&self) -> Option<Node<'a>> {
        self.0.get("items").map(Node)
    }

    /// How many items this list must have, if that is fixed.
    pub(super) fn length(&self) -> Option<usize> {
        let [least, most] = ["minItems", "maxItems"].map(|name| self.0.get(name).and_then(Value::as_u64));
        least.filter(|_| least == most).and_then(|length| usize::try_from(length).ok())
    }

    /// `object`, `array`, `number`, `integer`, `boolean` or `string`.
    pub fn type_name(&self) -> &'a str {
        self.0.get("type").and_then(Value::as_str).unwrap_or(if self.choices().is_empty() {
            "object"
        } else {
            "string"
        })
    }

    /// The words this key takes, if only certain ones.
    pub fn choices(&self) -> Vec<&'a str> {
        if let Some(Value::Array(variants)) = self.0.get("oneOf") {
            return variants.iter().flat_map(|variant| Node(variant).choices()).collect();
        }
        match self.0.get("const").and_then(Value::as_str) {
            Some(only) => vec![only],
            None => strings(self.0.get("enum")),
        }
    }

    /// Whether `value` lies within the bounds.
    pub(super) fn holds(&self, value: f64) -> bool {
        value.is_finite()
            && self.bound("minimum").is_none_or(|least| value >= least)
            && self.bound("exclusiveMinimum").is_none_or(|limit| value > limit)
            && self.bound("maximum").is_none_or(|most| value <= most)
            && self.bound("exclusiveMaximum").is_none_or(|limit| value < limit)
    }

    /// Allowed values, in words.
    pub(super) fn allowed(&self) -> String {
        let variants: Vec<String> = self.variants().map(|variant| variant.allowed()).collect();
        if !variants.is_empty() {
            return variants.join(", or ");
        }
        let choices = self.choices();
        if !choices.is_empty() {
            let quoted: Vec<String> = choices.iter().map(|word| format!("{word:?}")).collect();
            return quoted.join(", ");
        }
        match self.type_name() {
            "object" => format!("a table of {}", self.keys().join(", ")),
            "array" => {
                let count = self.length().map_or_else(String::new, |n| format!(" of {n}"));
                format!("a list{count}, each {}", self.items().map_or_else(String::new, |item| item.allowed()))
            }
            "boolean" => "true or false".to_owned(),
            "string" => "a text in quotes".to_owned(),
            "integer" => format!("a whole number{}", self.bounds_in_words()),
            _ => format!("a number{}", self.bounds_in_words()),
        }
    }

    fn bounds_in_words(&self) -> String {
        let mut words = Vec::new();
        for (name, word) in [("exclusiveMinimum", "greater than"), ("minimum", "at least")] {
            words.extend(self.bound(name).map(|bound| format!("{word} {bound}")));
        }
        for (name, word) in [("exclusiveMaximum", "less than"), ("maximum", "at most")] {
            words.extend(self.bound(name).map(|bound| format!("{word} {bound}")));
        }
        if words.is_empty() { String::new() } else { format!(" {}", words.join(" and ")) }
    }

    fn bound(&self, name: &str) -> Option<f64> {
        self.0.get(name).and_then(Value::as_f64)
    }
}

fn strings(list: Option<&Value>) -> Vec<&str> {
    list.and_then(Value::as_array).into_iter().flatten().filter_map(Value::as_str).collect()
}
