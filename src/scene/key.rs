//! A key of the scene by its path, such as `pair.pinion.teeth`: whether there is one, and which numbers it takes.

use super::locate::join;
use super::nearest::nearest;
use super::planetary;
use super::schema::{Node, schema};

/// A key that takes a number.
#[derive(Debug, Clone, Copy)]
pub struct NumberKey {
    node: Node<'static>,
}

/// Error of a path that is not that of a number.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum KeyError {
    /// No scene has the key.
    #[error("unknown key {key}; allowed: a key of the scene that takes a number, such as pair.face_width_mm")]
    Unknown {
        /// Key as given.
        key: String,
        /// Key that was probably meant.
        nearest: Option<String>,
    },
    /// The key does not take a number.
    #[error("{key} takes {takes}; allowed: a key that takes a number, such as pair.face_width_mm")]
    NotANumber {
        /// Key as given.
        key: String,
        /// Values that it takes.
        takes: String,
    },
}

/// Node of the schema at this path, of a pair or of a planetary stage; none where no scene has it. Items of lists are numbered from 1.
fn node_at(path: &str) -> Option<Node<'static>> {
    let within = |schema| {
        path.split('.').try_fold(Node::root(schema), |node: Node<'static>, name| match name.parse::<usize>() {
            Ok(1..) => node.items(),
            _ => node.child(name),
        })
    };
    within(schema()).or_else(|| within(planetary::schema::published()))
}

/// The words that the key at `path` takes, "true" and "false" where it is said so; none where it takes no words.
pub fn words(path: &str) -> Option<Vec<&'static str>> {
    let node = node_at(path)?;
    match (node.type_name(), node.choices()) {
        ("boolean", _) => Some(vec!["false", "true"]),
        (_, choices) if !choices.is_empty() => Some(choices),
        _ => None,
    }
}

/// Whether a scene may have a key at this path.
pub fn is_key(path: &str) -> bool {
    node_at(path).is_some()
}

/// Paths of a key with alternatives: `a.b.d` and `a.c.d` for `a.{b,c}.d`.
pub fn linked_keys(key: &str) -> Vec<String> {
    let Some((before, rest)) = key.split_once('{') else { return vec![key.to_owned()] };
    let Some((alternatives, after)) = rest.split_once('}') else { return vec![key.to_owned()] };
    alternatives.split(',').flat_map(|name| linked_keys(&format!("{before}{}{after}", name.trim()))).collect()
}

/// Whether a key takes whole numbers alone, so that `16.0` stands for `16`: arrays of numbers have but one kind.
pub fn takes_whole_numbers(key: &str) -> bool {
    linked_keys(key).iter().any(|key| NumberKey::find(key).is_ok_and(|key| key.whole()))
}

/// A number of which nothing is lost as a whole one; any other value as it is.
pub fn as_whole(value: &toml::Value) -> toml::Value {
    match value.as_float() {
        // A cast keeps any whole number that is of a size that a scene allows.
        Some(number) if number.fract() == 0.0 => toml::Value::Integer(number as i64),
        _ => value.clone(),
    }
}

/// Whether a key takes a list.
pub fn takes_list(key: &str) -> bool {
    linked_keys(key).iter().any(|key| node_at(key).is_some_and(|node| node.items().is_some()))
}

impl NumberKey {
    /// The key at `path`.
    ///
    /// # Errors
    /// A path that leads nowhere, or to something that is no number.
    pub fn find(path: &str) -> Result<Self, KeyError> {
        let Some(node) = node_at(path) else {
            return Err(KeyError::Unknown { key: path.to_owned(), nearest: nearest_number(path) });
        };
        if is_number(node) {
            Ok(Self { node })
        } else {
            Err(KeyError::NotANumber { key: path.to_owned(), takes: node.allowed() })
        }
    }

    /// Whether the key takes whole numbers only.
    pub fn whole(&self) -> bool {
        self.node.type_name() == "integer"
    }

    /// Whether the key allows `value`.
    pub fn holds(&self, value: f64) -> bool {
        self.node.holds(value) && !(self.whole() && value.fract() != 0.0)
    }

    /// Values that it takes, in words.
    pub fn allowed(&self) -> String {
        self.node.allowed()
    }
}

pub fn is_number(node: Node<'_>) -> bool {
    node.choices().is_empty() && matches!(node.type_name(), "number" | "integer")
}

/// The path of a number that `path` is most like: the least deep one that ends in it, or the nearest in spelling.
fn nearest_number(path: &str) -> Option<String> {
    nearest_in_either(path, is_number)
}

/// The key of a scene that `path` is most like, whatever it takes.
pub fn nearest_key(path: &str) -> Option<String> {
    nearest_in_either(path, |node| node.keys().is_empty())
}

/// The path to what is `wanted` that `path` is most like, of a planetary stage where it begins with one of its tables, else of a pair.
fn nearest_in_either(path: &str, wanted: fn(Node<'_>) -> bool) -> Option<String> {
    let of_stage = ["planetary.", "sun_planet.", "planet_ring."].iter().any(|table| path.starts_with(table));
    let schema = if of_stage { planetary::schema::published() } else { schema() };
    nearest_path(path, Node::root(schema), wanted)
}

/// The path below `root` to what is `wanted` that `path` is most like: one that ends in it, or the nearest in spelling.
pub fn nearest_path(path: &str, root: Node<'_>, wanted: fn(Node<'_>) -> bool) -> Option<String> {
    let mut known = Vec::new();
    paths_below(root, "", wanted, &mut known);
    let ending = format!(".{path}");
    let whole = known.iter().filter(|known| known.ends_with(&ending));
    if let Some(whole) = whole.min_by_key(|known| known.matches('.').count()) {
        return Some(whole.clone());
    }
    let known: Vec<&str> = known.iter().map(String::as_str).collect();
    nearest(path, &known).map(str::to_owned)
}

fn paths_below(node: Node<'_>, path: &str, wanted: fn(Node<'_>) -> bool, found: &mut Vec<String>) {
    for name in node.keys() {
        let Some(child) = node.child(name) else { continue };
        let path = join(path, name);
        if wanted(child) {
            found.push(path);
        } else {
            paths_below(child, &path, wanted, found);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_found_and_others_are_refused() {
        assert!(!NumberKey::find("pair.face_width_mm").unwrap().whole());
        let teeth = NumberKey::find("pair.pinion.teeth").unwrap();
        assert!(teeth.whole() && teeth.holds(16.0) && !teeth.holds(16.5) && !teeth.holds(4.0));
        assert!(NumberKey::find("numerics.step.revolutions").is_ok());
        for path in ["contact.surface", "pair.pinion", "operation.snapshots_h", "title", "numerics.error_estimate"] {
            assert!(matches!(NumberKey::find(path), Err(KeyError::NotANumber { .. })), "{path}");
        }
    }

    #[test]
    fn misspelt_keys_have_a_nearest_one() {
        for (path, meant) in [
            ("face_width_mm", "pair.face_width_mm"),
            ("pair.face_widht_mm", "pair.face_width_mm"),
            ("pair.helix_angle", "pair.helix_angle_deg"),
            ("pair.teeth", "pair.wheel.teeth"),
            ("planetary.plnets", "planetary.planets"),
            ("planetary.load_sharing", "planetary.load_sharing_factor"),
        ] {
            let Err(KeyError::Unknown { nearest, .. }) = NumberKey::find(path) else { panic!("{path} is known") };
            assert_eq!(nearest.as_deref(), Some(meant));
        }
        assert!(matches!(NumberKey::find(""), Err(KeyError::Unknown { .. })));
    }
}
