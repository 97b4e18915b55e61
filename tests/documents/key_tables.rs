//! Tables of the keys of a file, from its JSON schema: value (type, range and unit), default and meaning. Tables with the same keys are
//! written once.
//!
//! The schema's objects are sorted by name. The order of keys is that of the structures they are made from, which is read
//! from the source text. A description ends in sentences that begin with "Default" or "Required": they become a column of
//! their own, and what unit and range already say leaves the text.

use std::fmt::Write;

use serde_json::Value;

/// Ends of key names, the unit each stands for, and how descriptions word it. The longer of two that fit comes first.
const UNITS: [(&str, &str, &str); 29] = [
    ("_K_m2_per_W", "K·m²/W", "K·m²/W"),
    ("_kg_per_m2s", "kg/(m²·s)", "kg/(m²·s)"),
    ("_kg_per_m3", "kg/m³", "kg/m³"),
    ("_W_per_mK", "W/(m·K)", "W/(m·K)"),
    ("_mm2_per_s", "mm²/s", "mm²/s (cSt)"),
    ("_m2_per_s", "m²/s", "m²/s"),
    ("_m2_per_N", "m²/N", "m²/N"),
    ("_mm3_per_Nm", "mm³/(N·m)", "mm³/(N·m)"),
    ("_MPa_per_mm", "MPa/mm", "MPa/mm"),
    ("_N_per_mm_um", "N/(mm·µm)", "N/(mm·µm)"),
    ("_N_per_mm", "N/mm", "N per mm of thickness"),
    ("_N", "N", "N"),
    ("_kJ_per_mol", "kJ/mol", "kJ/mol"),
    ("_per_GPa", "1/GPa", "1/GPa"),
    ("_GPa", "GPa", "GPa"),
    ("_MPa", "MPa", "MPa"),
    ("_Nm", "N·m", "N·m"),
    ("_rpm", "1/min", "revolutions per minute"),
    ("_deg", "°", "degrees"),
    ("_mm", "mm", "mm"),
    ("_m2", "m²", "m²"),
    ("_um", "µm", "µm"),
    ("_nm", "nm", "nm"),
    ("_ps", "ps", "ps"),
    ("_C", "°C", "°C"),
    ("_h", "h", "hours"),
    ("hours", "h", "hours"),
    ("pinion_revolutions", "rev", "revolutions of the pinion"),
    ("revolutions", "rev", "revolutions of the pinion"),
];

/// A table of the file.
struct Section<'a> {
    /// Its path, and those of its neighbours with the same keys.
    paths: Vec<String>,
    /// The path of the neighbour of an outer table that has these keys too.
    likewise: Option<String>,
    /// Whether it is a list of tables.
    list: bool,
    /// What it is.
    about: &'a str,
    node: &'a Value,
    /// Unit that its keys take over from its name.
    unit: Option<&'static (&'static str, &'static str, &'static str)>,
}

/// What stands in the tables so far.
#[derive(Default)]
struct Written<'a> {
    /// Keys of each table, with its heading.
    tables: Vec<(&'a Value, String)>,
    /// Lists of words, with the key that takes them.
    words: Vec<(&'a Value, String)>,
}

impl<'a> Written<'a> {
    /// The words that the key at `path` takes, or the key before it that takes the same.
    fn words(&mut self, node: &'a Value, path: String) -> String {
        let list = if node["items"].is_object() { &node["items"]["oneOf"] } else { &node["oneOf"] };
        if let Some((_, earlier)) = self.words.iter().find(|(words, _)| list.is_array() && *words == list) {
            return format!(" Words of `{earlier}`.");
        }
        self.words.push((list, path));
        choices(node)
    }
}

/// All tables of the file that `schema` describes, made from structures in `sources`.
pub fn of_schema(schema: &Value, sources: &str) -> String {
    let orders = field_orders(sources);
    let root = Section { paths: Vec::new(), likewise: None, list: false, about: "", node: schema, unit: None };
    let mut text = String::new();
    write_section(&root, &orders, &mut Written::default(), &mut text);
    text
}

fn write_section<'a>(section: &Section<'a>, orders: &[Vec<String>], written: &mut Written<'a>, text: &mut String) {
    let keys = ordered_keys(section.node, orders);
    let required: Vec<&str> =
        section.node["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
    let properties = &section.node["properties"];
    let nested = nested_tables(section, &keys, written);

    if section.paths.is_empty() {
        text.push_str("## Top level\n\n");
    } else {
        write!(text, "## {}\n\n", heading(section)).expect("text can be written");
        let mut prose = section.about.to_owned();
        if let Some(likewise) = &section.likewise {
            write!(prose, " Likewise under `{likewise}`.").expect("text can be written");
        }
        if !prose.is_empty() {
            write!(text, "{}\n\n", prose.trim()).expect("text can be written");
        }
    }
    text.push_str("| key | value | default | meaning |\n|---|---|---|---|\n");
    for key in &keys {
        let node = &properties[key.as_str()];
        let unit = unit_of(key).or(section.unit);
        let target = table_of(node).and_then(|(table, _)| {
            let same = |keys: &Value| *keys == table["properties"];
            let earlier = written.tables.iter().find(|(keys, _)| same(keys)).map(|(_, heading)| heading.clone());
            earlier.or_else(|| nested.iter().find(|table| same(&table.node["properties"])).map(heading))
        });
        let words = if target.is_some() { String::new() } else { written.words(node, child_path(section, key)) };
        text.push_str(&row(key, node, unit, required.contains(&key.as_str()), target.as_deref(), &words));
    }
    text.push('\n');
    for table in &nested {
        written.tables.push((&table.node["properties"], heading(table)));
        write_section(table, orders, written, text);
    }
}

/// Tables that the keys of a section take and that are not written yet; neighbours with the same keys share one.
fn nested_tables<'a>(section: &Section<'a>, keys: &[String], written: &Written<'a>) -> Vec<Section<'a>> {
    let mut nested: Vec<Section> = Vec::new();
    for key in keys {
        let node = &section.node["properties"][key.as_str()];
        let Some((table, list)) = table_of(node) else { continue };
        if written.tables.iter().any(|(keys, _)| **keys == table["properties"]) {
            continue;
        }
        if let Some(same) = nested.iter_mut().find(|other| other.node["properties"] == table["properties"]) {
            same.paths.push(child_path(section, key));
            continue;
        }
        let likewise = match section.paths.as_slice() {
            [_, second, ..] => Some(second.clone()),
            _ => section.likewise.as_ref().map(|outer| format!("{outer}.{}", last_name(&section.paths[0]))),
        };
        // The row of the table above says what a single table is.
        let about = table["description"].as_str().filter(|_| list).unwrap_or_default();
        nested.push(Section {
            paths: vec![child_path(section, key)],
            likewise,
            list,
            about,
            node: table,
            unit: unit_of(key),
        });
    }
    nested
}

fn row(
    key: &str,
    node: &Value,
    unit: Option<&(&str, &str, &str)>,
    required: bool,
    target: Option<&str>,
    words: &str,
) -> String {
    let (mut meaning, default) = split_default(description(node), required);
    let range = range(node);
    if target.is_none() {
        if !range.is_empty() {
            meaning = meaning.replacen(&format!(", {range}"), "", 1);
        }
        if let Some((_, _, words)) = unit {
            meaning = meaning.replacen(&format!(" in {words}"), "", 1);
        }
    }
    meaning.push_str(words);
    let value = match target {
        Some(heading) => format!("[{}](#{})", type_name(node), anchor(heading)),
        None => {
            let bounds = range.strip_suffix(" or more").map_or_else(|| range.clone(), |least| format!("≥ {least}"));
            let shown_unit = unit.filter(|_| is_number(node)).map_or("", |unit| unit.1);
            let amount = format!("{bounds} {shown_unit}");
            let parts = [type_name(node), amount.trim().to_owned()];
            parts.join(", ").trim_end_matches(", ").to_owned()
        }
    };
    let cells = [format!("`{key}`"), value, default, meaning];
    let cells: Vec<String> = cells.iter().map(|cell| flat(cell).replace('|', "\\|")).collect();
    format!("| {} |\n", cells.join(" | "))
}

fn description(node: &Value) -> &str {
    node["description"].as_str().unwrap_or("")
}

fn flat(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

fn child_path(section: &Section, key: &str) -> String {
    match section.paths.first() {
        Some(path) => format!("{path}.{key}"),
        None => key.to_owned(),
    }
}

fn last_name(path: &str) -> &str {
    path.rsplit('.').next().unwrap_or(path)
}

fn heading(section: &Section) -> String {
    let (open, close) = if section.list { ("[[", "]]") } else { ("[", "]") };
    let names: Vec<String> = section.paths.iter().map(|path| format!("`{open}{path}{close}`")).collect();
    names.join(", ")
}

/// The anchor that GitHub gives to a heading.
fn anchor(heading: &str) -> String {
    super::links::anchor_of(heading)
}

/// The table that a key takes, and whether it takes a list of them.
fn table_of(node: &Value) -> Option<(&Value, bool)> {
    let is_table = |value: &Value| value["properties"].is_object();
    if is_table(node) {
        return Some((node, false));
    }
    if is_table(&node["items"]) {
        return Some((&node["items"], true));
    }
    node["anyOf"].as_array()?.iter().find(|variant| is_table(variant)).map(|table| (table, false))
}

fn unit_of(key: &str) -> Option<&'static (&'static str, &'static str, &'static str)> {
    UNITS.iter().find(|(end, _, _)| key.ends_with(end))
}

fn is_number(node: &Value) -> bool {
    let numeric = |value: &Value| matches!(value["type"].as_str(), Some("number" | "integer"));
    numeric(node) || numeric(&node["items"])
}

fn type_name(node: &Value) -> String {
    if let Some(variants) = node["anyOf"].as_array() {
        return variants.iter().map(type_name).collect::<Vec<_>>().join(" or ");
    }
    if node["oneOf"].is_array() || node["enum"][0].is_string() || node["const"].is_string() {
        return "word".to_owned();
    }
    match node["type"].as_str() {
        Some("number") => "number".to_owned(),
        Some("integer") => "whole number".to_owned(),
        Some("boolean") => "`true` or `false`".to_owned(),
        Some("string") => "text".to_owned(),
        Some("object") => "table".to_owned(),
        Some("array") => match (node["minItems"].as_u64(), node["maxItems"].as_u64()) {
            (Some(least), Some(most)) if least < most => {
                format!("list of {least} or {most}: {}", type_name(&node["items"]))
            }
            (_, Some(count)) => format!("list of {count}: {}", type_name(&node["items"])),
            (_, None) => format!("list: {}", type_name(&node["items"])),
        },
        other => panic!("a type that no table has yet: {other:?}"),
    }
}

/// Bounds as descriptions word them.
fn range(node: &Value) -> String {
    let node = if node["items"].is_object() { &node["items"] } else { node };
    let bound = |name: &str| node[name].as_f64().map(|value| value.to_string().replace('-', "−"));
    let from = bound("minimum").map(|least| (least, false)).or(bound("exclusiveMinimum").map(|limit| (limit, true)));
    let to = bound("maximum").map(|most| (most, false)).or(bound("exclusiveMaximum").map(|limit| (limit, true)));
    match (from, to) {
        (None, None) => String::new(),
        (Some((least, false)), None) => format!("{least} or more"),
        (Some((limit, true)), None) => format!("> {limit}"),
        (None, Some((most, false))) => format!("up to {most}"),
        (None, Some((limit, true))) => format!("< {limit}"),
        (Some((least, false)), Some((most, false))) => format!("{least} to {most}"),
        (Some((limit, true)), Some((most, false))) => format!("> {limit} to {most}"),
        (Some((least, false)), Some((limit, true))) => format!("{least} to below {limit}"),
        (Some((low, true)), Some((high, true))) => format!("above {low} and below {high}"),
    }
}

/// The words that a key takes, each with its meaning.
fn choices(node: &Value) -> String {
    let node = if node["items"].is_object() { &node["items"] } else { node };
    let mut text = String::new();
    for choice in node["oneOf"].as_array().into_iter().flatten() {
        let word = choice["const"].as_str().expect("a choice is a word");
        write!(text, "<br>`\"{word}\"`: {}", flat(description(choice))).expect("text can be written");
    }
    if let Some(words) = node["enum"].as_array() {
        let words: Vec<String> = words.iter().map(|word| format!("`{word}`")).collect();
        write!(text, "<br>One of {}.", words.join(", ")).expect("text can be written");
    }
    text
}

/// A description without its sentences on the default, and what they say.
fn split_default(description: &str, required: bool) -> (String, String) {
    let description = flat(description);
    let mut meaning = Vec::new();
    let mut default = Vec::new();
    for sentence in description.split_inclusive(". ") {
        let sentence = sentence.trim();
        if let Some(rest) = sentence.strip_prefix("Default") {
            default.push(rest.trim_start_matches(':').trim().trim_end_matches('.').to_owned());
        } else if sentence.starts_with("Required") {
            default.push(sentence.replacen('R', "r", 1).trim_end_matches('.').to_owned());
        } else {
            meaning.push(sentence);
        }
    }
    if required {
        default.insert(0, "required".to_owned());
    }
    (meaning.join(" "), default.join("; "))
}

/// The keys of a table in the order of the structure they are made from.
fn ordered_keys(node: &Value, orders: &[Vec<String>]) -> Vec<String> {
    let properties = node["properties"].as_object().expect("a table has keys");
    let order = orders
        .iter()
        .find(|order| order.len() == properties.len() && order.iter().all(|name| properties.contains_key(name)));
    let names: Vec<&String> = properties.keys().collect();
    order.unwrap_or_else(|| panic!("no structure has the keys {names:?}")).clone()
}

/// The names of the public fields of every structure, in order, as the file names them.
fn field_orders(sources: &str) -> Vec<Vec<String>> {
    let mut orders = Vec::new();
    for body in sources.split("struct ").skip(1) {
        let body = body.split("\n}").next().unwrap_or(body);
        let mut names = Vec::new();
        let mut renamed = None;
        for line in body.lines().map(str::trim) {
            if let Some((_, rest)) = line.split_once("rename = \"") {
                renamed = rest.split('"').next().map(str::to_owned);
            } else if let Some((name, _)) = line.strip_prefix("pub ").and_then(|field| field.split_once(':')) {
                names.push(renamed.take().unwrap_or_else(|| name.to_owned()));
            }
        }
        orders.push(names);
    }
    orders
}
