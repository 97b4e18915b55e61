//! Parts of the scene format that this version does not have: refused by name, before any work.

/// Something another version of the program understands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Later {
    /// Path of the key.
    pub key: &'static str,
    /// The value that is not there yet; `None`: the key as a whole.
    pub value: Option<&'static str>,
    /// What can be done instead.
    pub instead: &'static str,
}

const fn key(key: &'static str, instead: &'static str) -> Later {
    Later { key, value: None, instead }
}

const fn choice(key: &'static str, value: &'static str, instead: &'static str) -> Later {
    Later { key, value: Some(value), instead }
}

const LAW: &str = r#"wear.law = "archard""#;
const STEP: &str = "a fixed step, numerics.step = { revolutions = … }";

/// What a scene of this version lacks.
pub const SCENE: &[Later] = &[
    key("mesh", "a gear pair, [pair]; gearwear fem runs a problem with a mesh of its own"),
    key("numerics.tolerance_um", STEP),
    choice("numerics.step", "adaptive", STEP),
    choice("wear.law", "adsorption", LAW),
    choice("wear.law", "oxidation", LAW),
];

/// The entry of `later` for an unknown key.
pub fn unknown_key(later: &[Later], key: &str) -> Option<Later> {
    later.iter().copied().find(|later| later.key == key && later.value.is_none())
}

/// The entry of `later` for a value that `key` does not take in this version.
pub fn unknown_value(later: &[Later], key: &str, value: &str) -> Option<Later> {
    later.iter().copied().find(|later| later.key == key && later.value == Some(value))
}
