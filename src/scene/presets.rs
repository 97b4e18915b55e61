//! Gear pairs of the library: each is a whole scene file, ready to run and commented.
//!
//! `gearwear init NAME` prints the file; `pair.preset = "NAME"` takes its `[pair]` table. The numbers of the FZG gears
//! are those of ISO 14635-1: their tip diameters are data of the standard, not derived. `fzg-c` runs them with this library's
//! defaults, `thesis-spur` with the thesis's model, every choice written out, and `fzg-test` is the thesis's wear test on elastic contact,
//! `thesis-fzg-test` with the thesis's model. Helical pairs: one like the FZG gears, again with the thesis's model as `thesis-helical`, and the public ones of FEUP (Porto), whose tip diameters follow from the rack.

/// Key of the scene that names one.
pub const KEY: &str = "pair.preset";

/// A scene of the library.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Preset {
    /// Name, as in `pair.preset`.
    pub name: &'static str,
    /// The commented scene file.
    pub text: &'static str,
}

/// All presets; the first is the one `gearwear init` prints unasked.
pub const PRESETS: [Preset; 10] = [
    Preset { name: "fzg-c", text: include_str!("presets/fzg-c.toml") },
    Preset { name: "thesis-spur", text: include_str!("presets/thesis-spur.toml") },
    Preset { name: "fzg-test", text: include_str!("presets/fzg-test.toml") },
    Preset { name: "thesis-fzg-test", text: include_str!("presets/thesis-fzg-test.toml") },
    Preset { name: "fzg-a", text: include_str!("presets/fzg-a.toml") },
    Preset { name: "helical", text: include_str!("presets/helical.toml") },
    Preset { name: "thesis-helical", text: include_str!("presets/thesis-helical.toml") },
    Preset { name: "h501", text: include_str!("presets/h501.toml") },
    Preset { name: "h701", text: include_str!("presets/h701.toml") },
    Preset { name: "h951", text: include_str!("presets/h951.toml") },
];

/// The names of all presets.
pub fn names() -> [&'static str; PRESETS.len()] {
    PRESETS.map(|preset| preset.name)
}

/// The preset called `name`.
pub fn find(name: &str) -> Option<Preset> {
    PRESETS.into_iter().find(|preset| preset.name == name)
}

impl Preset {
    /// The `[pair]` table of the scene.
    pub fn pair(&self) -> toml::Table {
        let mut scene: toml::Table = self.text.parse().expect("the library's own scenes are TOML");
        match scene.remove("pair") {
            Some(toml::Value::Table(pair)) => pair,
            _ => unreachable!("the library's own scenes have a pair"),
        }
    }
}

/// The name of a preset that `name` is most like, if it is like any.
pub fn nearest(name: &str) -> Option<&'static str> {
    super::nearest::nearest(name, &names())
}
