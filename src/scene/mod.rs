//! The user's scene: the file with its checks and presets, resolved into the settings of each layer.

pub(crate) mod decimal_comma;
pub(crate) mod draft;
pub(crate) mod fem_file;
pub(crate) mod fem_problem;
pub(crate) mod file;
mod findings;
pub(crate) mod key;
pub(crate) mod loaded;
mod locate;
pub(crate) mod lubrication_file;
pub(crate) mod material_presets;
pub(crate) mod nearest;
mod outside_model;
pub(crate) mod phase_conditions;
pub(crate) mod presets;
pub(crate) mod problem;
mod resolve;
pub(crate) mod schema;
mod shape;
mod text;
mod unit_slip;
pub(crate) mod wear_file;

use crate::contact::settings::ContactSettings;
use crate::content_hash::sha256;
use crate::gear::{PerGear, spec::PairSpec};
use crate::gear_mesh::settings::BodySettings;
use crate::lubrication::settings::LubricationSettings;
use crate::material::Material;
use crate::mesh_cycle::settings::SliceSettings;
use crate::simulation::settings::{Numerics, Operation};
use crate::stiffness::settings::StiffnessSettings;
use crate::thermal::settings::HeatSettings;
use crate::thermal::tooth::TemperatureCurve;
use crate::wear::settings::WearSettings;

pub(crate) use file::SceneFile;
pub use problem::{Problem, ProblemKind};

/// A scene with every choice made: what the plan and the pipeline work from.
#[derive(Debug, Clone, PartialEq)]
pub struct Scene {
    /// The user's title.
    pub title: String,
    /// The gear pair as given.
    pub pair: PairSpec,
    /// Material of each gear, its modulus at the temperature of its teeth where it follows that.
    pub material: PerGear<Material>,
    /// How Young's modulus of each follows that temperature, MPa; none where it is given.
    pub modulus: PerGear<Option<TemperatureCurve>>,
    /// Load, speed, duration.
    pub operation: Operation,
    /// Contact surface.
    pub contact: ContactSettings,
    /// Calibration file, as named by the scene.
    pub calibration_file: Option<String>,
    /// Tooth stiffness.
    pub stiffness: StiffnessSettings,
    /// Whether the scene leaves the model of the stiffness open.
    pub stiffness_by_default: bool,
    /// Data file of the stiffness, as named by the scene.
    pub stiffness_curve_file: Option<String>,
    /// Bodies of finite elements, where any are used.
    pub fem: BodySettings,
    /// Elements in the half-width of contact of a wear run on them.
    pub wear_elements_per_half_width: f64,
    /// Slices over the face width; none where all sections are alike.
    pub slices: Option<SliceSettings>,
    /// Whether the scene leaves their coupling open.
    pub coupling_by_default: bool,
    /// Contact temperatures; none where nothing asks for them.
    pub heat: Option<HeatSettings>,
    /// Films, friction and losses; none where nothing asks for them.
    pub lubrication: Option<LubricationSettings>,
    /// Wear law of each gear.
    pub wear: PerGear<WearSettings>,
    /// Resolution.
    pub numerics: Numerics,
    /// Whether the run is checked by finite elements.
    pub verify: bool,
}

impl Scene {
    /// Resolves the text of a scene file: presets expanded, defaults filled in, everything checked.
    ///
    /// # Errors
    /// Everything that is wrong with the scene, not only the first thing.
    pub fn from_toml(text: &str) -> Result<Resolved, Vec<Problem>> {
        resolve::resolve(text)
    }

    /// Bodies of finite elements that wear.
    pub(crate) fn wear_bodies(&self) -> BodySettings {
        BodySettings { elements_per_half_width: self.wear_elements_per_half_width, ..self.fem }
    }

    /// What a command that looks at one load leaves out of a scene with phases under others; none where there are no others.
    pub fn one_load_warning(&self) -> Option<String> {
        let own = self.operation.pinion_torque_n_mm;
        let [least, greatest] = self.operation.torque_range_n_mm();
        let (least, greatest) = (least.min(own), greatest.max(own));
        (least < greatest).then(|| {
            let n_m = 1e-3;
            format!(
                "this command looks at operation.pinion_torque_Nm, {} N·m, alone; the phases run under {} to {} N·m",
                n_m * own,
                n_m * least,
                n_m * greatest
            )
        })
    }

    /// What plane finite elements leave out of a pair whose sections differ over the face width; none where they are alike.
    pub fn plane_section_warning(&self) -> Option<String> {
        self.slices.is_some().then(|| {
            "finite elements are plane: they stand for one transverse section per mm of face width, without the helix and \
             without modifications over the face width"
                .to_owned()
        })
    }
}

/// A scene, the file that says all of it, and what the user should know about it.
#[derive(Debug, Clone, PartialEq)]
pub struct Resolved {
    /// What the program works from.
    pub scene: Scene,
    /// The same as a file, every default filled in and without a preset. Resolving it gives the same scene, bit for bit.
    pub file: SceneFile,
    /// Likely slips of unit and settings that are not used.
    pub warnings: Vec<String>,
}

impl Resolved {
    /// The resolved scene as TOML.
    pub fn to_toml(&self) -> String {
        self.file.to_toml()
    }

    /// Lets the key `contact.calibration` or `stiffness.curve` name another file.
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
            _ => {}
        }
    }

    /// First 16 hexadecimal digits of the SHA-256 of [`Self::to_toml`].
    pub fn scene_hash(&self) -> String {
        short_hash(self.to_toml().as_bytes())
    }
}

/// First 16 hexadecimal digits of the SHA-256 of `bytes`.
pub(crate) fn short_hash(bytes: &[u8]) -> String {
    sha256(bytes)[..16].to_owned()
}
