//! A setting of models and resolution, and its scene.
//!
//! The scene is the user's file with some keys changed, resolved again: what was measured can be repeated by
//! `gearwear run` on that file, and the checks of scenes hold for settings as well.

use crate::accuracy::record::VariantSettings;
use gearwear::report::html::number::significant;
use gearwear::scene::file::{HelicalFile, NumericsFile, StepFile, StiffnessFile, StiffnessModel};
use gearwear::scene::{Problem, Resolved};
use gearwear_physics::contact::settings::{Foundation, MatchCriterion, SurfaceKind};
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};
use gearwear_physics::operation::Scene;

/// Fewest points and positions of a setting: the least that a scene may ask for.
pub const LEAST_POINTS: usize = 20;

/// A contact surface with what it needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum SurfaceSetting {
    HertzMean,
    Hertz,
    Winkler(Foundation),
    HalfSpace,
    Fem { elements_per_half_width: f64 },
}

/// Coarsening relative to the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Coarsening {
    /// Divisor of the numbers of flank points and positions.
    pub spacing: u32,
    /// Factor on the wear step.
    pub step: u32,
}

impl Coarsening {
    /// Equal coarsening of points, positions and steps.
    pub fn even(by: u32) -> Self {
        Self { spacing: by, step: by }
    }

    /// "1/2 of points, positions and steps", "1/4 of steps"; none where nothing is coarser.
    fn name(self) -> Option<String> {
        Some(match self {
            Self { spacing: 1, step: 1 } => return None,
            Self { spacing, step } if spacing == step => format!("1/{step} of points, positions and steps"),
            Self { spacing, step: 1 } => format!("1/{spacing} of points and positions"),
            Self { spacing: 1, step } => format!("1/{step} of steps"),
            Self { spacing, step } => format!("1/{spacing} of points and positions, 1/{step} of steps"),
        })
    }
}

/// A tooth stiffness as a scene asks for it.
#[derive(Debug, Clone, PartialEq)]
pub struct StiffnessSetting {
    /// The scene's section.
    pub file: StiffnessFile,
    /// Name: `constant 20`, `weber-banaschek`.
    pub name: String,
}

#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Contact surface.
    pub surface: SurfaceSetting,
    /// Whether contact at a tip edge outside A to E is computed, where the surface can.
    pub tip_contact: bool,
    /// Stiffness of the teeth; `None` for finite elements.
    pub stiffness: Option<StiffnessSetting>,
    /// The slices over the face width; none where all sections are alike.
    pub slices: Option<SliceSettings>,
    pub coarsening: Coarsening,
}

fn in_words(criterion: MatchCriterion) -> String {
    criterion.name().replace("peak-", "peak ")
}

impl SurfaceSetting {
    /// Surface of the scene, with its K/H.
    pub fn of_scene(resolved: &Resolved) -> Self {
        let contact = &resolved.scene.contact;
        match contact.surface {
            SurfaceKind::HertzMean => Self::HertzMean,
            SurfaceKind::Hertz => Self::Hertz,
            SurfaceKind::HalfSpace => Self::HalfSpace,
            SurfaceKind::Winkler | SurfaceKind::Fem => Self::Winkler(contact.foundation),
        }
    }

    /// "Winkler, K/H calibrated by peak pressure", "finite elements, 10 in a half-width".
    pub fn name(self) -> String {
        match self {
            Self::HertzMean => "Hertz, mean pressure".to_owned(),
            Self::Hertz => "Hertz".to_owned(),
            Self::HalfSpace => "elastic half-planes".to_owned(),
            Self::Winkler(Foundation::Given { .. }) => "Winkler, K/H given".to_owned(),
            Self::Winkler(Foundation::Matched(criterion)) => {
                format!("Winkler, K/H from Hertz by {}", in_words(criterion))
            }
            Self::Winkler(Foundation::Calibrated(criterion)) => {
                format!("Winkler, K/H calibrated by {}", in_words(criterion))
            }
            Self::Fem { elements_per_half_width } => {
                format!("finite elements, {} in a half-width", significant(elements_per_half_width, 3))
            }
        }
    }

    /// Whether the surface models the gap beside the line of action, and so can follow a tip edge.
    pub fn may_follow_tip(self) -> bool {
        matches!(self, Self::Winkler(_) | Self::HalfSpace)
    }

    pub fn kind(self) -> SurfaceKind {
        match self {
            Self::HertzMean => SurfaceKind::HertzMean,
            Self::Hertz => SurfaceKind::Hertz,
            Self::Winkler(_) => SurfaceKind::Winkler,
            Self::HalfSpace => SurfaceKind::HalfSpace,
            Self::Fem { .. } => SurfaceKind::Fem,
        }
    }
}

impl StiffnessSetting {
    /// A model without data of its own.
    pub fn of_model(model: StiffnessModel, name: &str) -> Self {
        Self { file: StiffnessFile { model: Some(model), ..StiffnessFile::default() }, name: name.to_owned() }
    }

    /// Title in tables and plots: "teeth by ISO 6336".
    pub fn title(&self) -> String {
        let how = match self.file.model {
            Some(StiffnessModel::Constant) => {
                return format!("teeth of {} N/(mm·µm)", self.name.trim_start_matches("constant "));
            }
            Some(StiffnessModel::Iso6336) => "ISO 6336",
            Some(StiffnessModel::WeberBanaschek) => "Weber and Banaschek",
            Some(StiffnessModel::Fem) => "finite elements",
            _ => &self.name,
        };
        format!("teeth by {how}")
    }

    /// Constant stiffness of a tooth pair, N/(mm·µm).
    pub fn constant(pair_n_per_mm_um: f64) -> Self {
        let file = StiffnessFile {
            model: Some(StiffnessModel::Constant),
            pair_N_per_mm_um: Some(pair_n_per_mm_um),
            ..StiffnessFile::default()
        };
        Self { file, name: format!("constant {pair_n_per_mm_um}") }
    }

    /// The scene's own.
    pub fn of_scene(resolved: &Resolved) -> Self {
        let mut file = resolved.file.stiffness.clone().unwrap_or_default();
        // The default is the stiffness of finite elements.
        file.model.get_or_insert(StiffnessModel::Fem);
        match file.pair_N_per_mm_um.filter(|_| file.model == Some(StiffnessModel::Constant)) {
            Some(value) => Self::constant(value),
            None => Self { file, name: resolved.scene.stiffness.name().to_owned() },
        }
    }
}

/// Length of Euler's wear step in pinion revolutions, which settings coarsen.
pub fn euler_revolutions(scene: &Scene) -> f64 {
    scene.numerics.stepping.euler_revolutions(scene.operation.pinion_revolutions)
}

/// Title in tables and plots.
pub fn coupling_name(coupling: Coupling) -> &'static str {
    match coupling {
        Coupling::None => "uncoupled",
        Coupling::Slicing => "coupled by plate theory",
        Coupling::Fem => "coupled by three-dimensional finite elements",
    }
}

impl Setting {
    /// Plane finite elements, which bring their own stiffness.
    pub(super) fn fem(elements_per_half_width: f64, coarsening: Coarsening) -> Self {
        let surface = SurfaceSetting::Fem { elements_per_half_width };
        Self { surface, tip_contact: false, stiffness: None, slices: None, coarsening }
    }

    /// Name in tables and plots.
    pub fn name(&self) -> String {
        let slices = self.slices.map(|s| format!("{} slices, {}", s.count, coupling_name(s.coupling)));
        let stiffness = self.stiffness.as_ref().map(StiffnessSetting::title);
        let parts = [Some(self.surface_name()), stiffness, slices, self.coarsening.name()];
        parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
    }

    /// The surface, and whether it follows tip edges.
    pub fn surface_name(&self) -> String {
        let follows = self.surface.may_follow_tip() && self.tip_contact;
        format!("{}{}", self.surface.name(), if follows { ", tip contact" } else { "" })
    }

    /// Whether `scene` is fine enough to be coarsened like this.
    pub fn fits(coarsening: Coarsening, scene: &Scene) -> bool {
        let numerics = scene.numerics;
        coarsening.spacing == 1
            || numerics.flank_points.min(numerics.positions) / coarsening.spacing as usize >= LEAST_POINTS
    }

    /// Scene of the setting. `calibration` is the name of the calibration file where there is one.
    pub fn scene(&self, base: &Resolved, calibration: Option<&str>) -> Result<Resolved, Vec<Problem>> {
        let mut file = base.file.clone();
        let contact = file.contact.get_or_insert_default();
        contact.surface = Some(self.surface.kind());
        contact.tip_contact = self.surface.may_follow_tip().then_some(self.tip_contact);
        contact.match_criterion = None;
        contact.foundation_MPa_per_mm = None;
        contact.calibration = None;
        // A calibration that is given makes every Winkler foundation a calibrated one.
        let reads_calibration = self.stiffness.as_ref().is_some_and(|s| s.file.model == Some(StiffnessModel::Fem));
        match self.surface {
            SurfaceSetting::Winkler(Foundation::Given { foundation_mpa_per_mm }) => {
                contact.foundation_MPa_per_mm = Some(foundation_mpa_per_mm);
            }
            SurfaceSetting::Winkler(Foundation::Matched(criterion)) => contact.match_criterion = Some(criterion),
            SurfaceSetting::Winkler(Foundation::Calibrated(criterion)) => {
                contact.match_criterion = Some(criterion);
                contact.calibration = calibration.map(str::to_owned);
            }
            SurfaceSetting::Hertz | SurfaceSetting::HertzMean | SurfaceSetting::HalfSpace if reads_calibration => {
                contact.calibration = calibration.map(str::to_owned);
            }
            SurfaceSetting::Hertz | SurfaceSetting::HertzMean | SurfaceSetting::HalfSpace => {}
            SurfaceSetting::Fem { elements_per_half_width } => {
                file.fem.get_or_insert_default().elements_per_half_width = Some(elements_per_half_width);
            }
        }
        if let Some(SliceSettings { count, coupling }) = self.slices {
            file.helical = Some(HelicalFile { slices: Some(count as u32), coupling: Some(coupling) });
        }
        file.stiffness = self.stiffness.as_ref().map(|stiffness| stiffness.file.clone());
        let numerics = base.scene.numerics;
        let [flank_points, positions] = [numerics.flank_points, numerics.positions]
            .map(|count| Some((count as u32 / self.coarsening.spacing).max(LEAST_POINTS as u32)));
        file.numerics = Some(NumericsFile {
            flank_points,
            positions,
            error_estimate: Some(false),
            step: Some(StepFile::fixed(f64::from(self.coarsening.step) * euler_revolutions(&base.scene))),
            ..NumericsFile::default()
        });
        Resolved::from_toml(&file.to_toml())
    }

    /// Setting as recorded.
    pub fn record(&self, scene: &Scene) -> VariantSettings {
        let match_criterion = match self.surface {
            SurfaceSetting::Winkler(Foundation::Matched(criterion) | Foundation::Calibrated(criterion)) => {
                Some(criterion.name())
            }
            SurfaceSetting::Winkler(Foundation::Given { .. }) => Some("given"),
            _ => None,
        };
        let elements_per_half_width = match self.surface {
            SurfaceSetting::Fem { elements_per_half_width } => Some(elements_per_half_width),
            _ => None,
        };
        VariantSettings {
            surface: self.surface.kind().name().to_owned(),
            match_criterion: match_criterion.map(str::to_owned),
            calibrated: matches!(self.surface, SurfaceSetting::Winkler(Foundation::Calibrated(_))),
            tip_contact: self.tip_contact || elements_per_half_width.is_some(),
            stiffness: self.stiffness.as_ref().map(|stiffness| stiffness.name.clone()),
            elements_per_half_width,
            slices: self.slices.map(|slices| slices.count),
            coupling: self.slices.map(|slices| slices.coupling.name().to_owned()),
            flank_points: scene.numerics.flank_points,
            positions: scene.numerics.positions,
            step_revolutions: euler_revolutions(scene),
            spacing_coarsening: self.coarsening.spacing,
            step_coarsening: self.coarsening.step,
        }
    }
}
