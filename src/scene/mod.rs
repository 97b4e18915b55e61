//! The user's scene: the file with its checks and presets, resolved into the settings of each layer.

pub mod blame;
pub mod decimal_comma;
pub mod draft;
#[allow(rustdoc::broken_intra_doc_links, reason = "tables of the file stand in brackets, as in TOML")]
pub mod fem_file;
pub mod fem_problem;
#[allow(rustdoc::broken_intra_doc_links, reason = "tables of the file stand in brackets, as in TOML")]
pub mod file;
mod findings;
#[allow(rustdoc::broken_intra_doc_links, reason = "tables of the file stand in brackets, as in TOML")]
pub mod gear_file;
pub mod improve_file;
mod internal;
pub mod key;
pub mod loaded;
mod locate;
#[allow(rustdoc::broken_intra_doc_links, reason = "tables of the file stand in brackets, as in TOML")]
pub mod lubrication_file;
pub mod material_presets;
mod named_files;
pub mod nearest;
pub mod opened;
mod outside_model;
pub mod planetary;
pub mod presets;
pub mod problem;
mod resolve;
mod scene_text;
pub mod schema;
mod shape;
pub mod table;
mod text;
mod unit_slip;
#[allow(rustdoc::broken_intra_doc_links, reason = "tables of the file stand in brackets, as in TOML")]
pub mod wear_file;

use gearwear_bodies::gear::Gear;
use gearwear_files::content_hash::sha256;
use gearwear_physics::operation::Scene;

pub use file::SceneFile;
use loaded::{LoadError, SceneError, SceneText};
pub use problem::{Problem, ProblemKind};

/// Scene with every default filled in, as values and as a file, with its warnings.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// Scene in the terms of physics.
    pub scene: Scene,
    /// Scene as a file, every default filled in and without a preset. Resolving it gives the same scene, bit for bit.
    pub file: SceneFile,
    /// Likely slips of unit and settings that are not used.
    pub warnings: Vec<String>,
}

impl Resolved {
    /// Resolves the text of a scene file: presets expanded, defaults filled in, everything checked.
    ///
    /// # Errors
    /// Everything that is wrong with the scene, not only the first thing.
    pub fn from_toml(text: &str) -> Result<Self, Vec<Problem>> {
        resolve::resolve(text)
    }

    /// The user's title, or the one made of the pair.
    pub fn title(&self) -> &str {
        self.file.title.as_deref().unwrap_or_default()
    }

    /// The resolved scene as TOML.
    pub fn to_toml(&self) -> String {
        self.file.to_toml()
    }

    /// Lets a key that names a file, such as `contact.calibration`, name another one.
    pub fn rename_file(&mut self, key: &str, name: &str) {
        let name = Some(name.to_owned());
        match key {
            "contact.calibration" => {
                self.scene.calibration_file.clone_from(&name);
                self.file.contact.get_or_insert_default().calibration = name;
            }
            "stiffness.curve" => {
                self.scene.stiffness_curve_file.clone_from(&name);
                self.file.stiffness.get_or_insert_default().curve = name;
            }
            _ => {
                let gear = Gear::BOTH.into_iter().find(|&gear| named_files::INITIAL_FLANK[gear] == key);
                let file = gear.and_then(|gear| self.file.pair.gear_mut(gear));
                if let (Some(flank), Some(name)) = (file.and_then(|file| file.initial_flank.as_mut()), name) {
                    flank.file = name;
                }
            }
        }
    }

    /// First 16 hexadecimal digits of the SHA-256 of [`Self::to_toml`].
    pub fn scene_hash(&self) -> String {
        short_hash(self.to_toml().as_bytes())
    }
}

/// First 16 hexadecimal digits of the SHA-256 of `bytes`.
pub fn short_hash(bytes: &[u8]) -> String {
    sha256(bytes)[..16].to_owned()
}
