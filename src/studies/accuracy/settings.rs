//! A setting of the models and their resolution, and the scene it stands for.
//!
//! The scene is the user's file with some keys changed, resolved again: what was measured can be repeated by
//! `gearwear run` on that file, and the checks of scenes hold for settings as well.

use crate::contact::settings::{Foundation, MatchCriterion, SurfaceKind};
use crate::mesh_cycle::settings::{Coupling, SliceSettings};
use crate::operation::Scene;
use crate::report::html::number::significant;
use crate::scene::file::{HelicalFile, NumericsFile, StepFile, StiffnessFile, StiffnessModel};
use crate::scene::{Problem, Resolved};
use crate::studies::accuracy::record::VariantSettings;

/// Fewest points and positions of a setting: the least that a scene may ask for.
pub(crate) const LEAST_POINTS: usize = 20;

/// A contact surface with what it needs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Surface {
    HertzMean,
    Hertz,
    Winkler(Foundation),
    HalfSpace,
    Fem { elements_per_half_width: f64 },
}

/// How much coarser than the scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Coarsening {
    /// The scene's numbers of flank points and positions are divided by this.
    pub spacing: u32,
    /// The scene's wear step is multiplied by this.
    pub step: u32,
}

impl Coarsening {
    /// Points, positions and steps alike.
    pub(crate) fn even(by: u32) -> Self {
        Self { spacing: by, step: by }
    }

    /// "1/2 of points, positions and steps", "1/4 of steps"; none where nothing is coarser.
    fn name(self) -> Option<String> {
        let of = |by: u32, what: &str| (by != 1).then(|| format!("1/{by} of {what}"));
        match self {
            Self { spacing, step } if spacing == step => of(step, "points, positions and steps"),
            Self { spacing, step: 1 } => of(spacing, "points and positions"),
            Self { spacing: 1, step } => of(step, "steps"),
            Self { spacing, step } => Some(format!("1/{spacing} of points and positions, 1/{step} of steps")),
        }
    }
}

/// A tooth stiffness as a scene asks for it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stiffness {
    /// The scene's section.
    pub file: StiffnessFile,
    /// What it is called: `constant 20`, `weber-banaschek`.
    pub name: String,
}

#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Setting {
    /// How the flanks touch.
    pub surface: Surface,
    /// Whether a tip edge is followed outside A to E, by the surfaces that can.
    pub tip_contact: bool,
    /// How the teeth yield; `None` for finite elements.
    pub stiffness: Option<Stiffness>,
    /// The slices over the face width; none where all sections are alike.
    pub slices: Option<SliceSettings>,
    pub coarsening: Coarsening,
}

impl Surface {
    /// The scene's own, with the scene's own K/H.
    pub(crate) fn of_scene(resolved: &Resolved) -> Self {
        let contact = &resolved.scene.contact;
        match contact.surface {
            SurfaceKind::HertzMean => Self::HertzMean,
            SurfaceKind::Hertz => Self::Hertz,
            SurfaceKind::HalfSpace => Self::HalfSpace,
            SurfaceKind::Winkler | SurfaceKind::Fem => Self::Winkler(contact.foundation),
        }
    }

    /// "Winkler, K/H calibrated by peak pressure", "finite elements, 10 in a half-width".
    pub(crate) fn name(self) -> String {
        let by = |criterion: MatchCriterion| criterion.name().replace("peak-", "peak ");
        match self {
            Self::HertzMean => "Hertz, mean pressure".to_owned(),
            Self::Hertz => "Hertz".to_owned(),
            Self::HalfSpace => "elastic half-planes".to_owned(),
            Self::Winkler(Foundation::Given { .. }) => "Winkler, K/H given".to_owned(),
            Self::Winkler(Foundation::Matched(criterion)) => format!("Winkler, K/H from Hertz by {}", by(criterion)),
            Self::Winkler(Foundation::Calibrated(criterion)) => format!("Winkler, K/H calibrated by {}", by(criterion)),
            Self::Fem { elements_per_half_width } => {
                format!("finite elements, {} in a half-width", significant(elements_per_half_width, 3))
            }
        }
    }

    /// Whether it knows the gap of the flanks beside the line of action, and so may follow a tip edge.
    pub(crate) fn may_follow_tip(self) -> bool {
        matches!(self, Self::Winkler(_) | Self::HalfSpace)
    }

    pub(crate) fn kind(self) -> SurfaceKind {
        match self {
            Self::HertzMean => SurfaceKind::HertzMean,
            Self::Hertz => SurfaceKind::Hertz,
            Self::Winkler(_) => SurfaceKind::Winkler,
            Self::HalfSpace => SurfaceKind::HalfSpace,
            Self::Fem { .. } => SurfaceKind::Fem,
        }
    }
}

impl Stiffness {
    /// A model without data of its own.
    pub(crate) fn of_model(model: StiffnessModel, name: &str) -> Self {
        Self { file: StiffnessFile { model: Some(model), ..StiffnessFile::default() }, name: name.to_owned() }
    }

    /// As tables and plots say it: "teeth by ISO 6336".
    pub(crate) fn title(&self) -> String {
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

    /// One value for the spring of the teeth, N/(mm·µm).
    pub(crate) fn constant(pair_n_per_mm_um: f64) -> Self {
        let file = StiffnessFile {
            model: Some(StiffnessModel::Constant),
            pair_N_per_mm_um: Some(pair_n_per_mm_um),
            ..StiffnessFile::default()
        };
        Self { file, name: format!("constant {pair_n_per_mm_um}") }
    }

    /// The scene's own.
    pub(crate) fn of_scene(resolved: &Resolved) -> Self {
        let mut file = resolved.file.stiffness.clone().unwrap_or_default();
        // Left open, it is that of finite elements.
        file.model.get_or_insert(StiffnessModel::Fem);
        match file.pair_N_per_mm_um.filter(|_| file.model == Some(StiffnessModel::Constant)) {
            Some(value) => Self::constant(value),
            None => Self { file, name: resolved.scene.stiffness.name().to_owned() },
        }
    }
}

/// The wear step that everything is compared with: Euler's.
pub(crate) fn euler_revolutions(scene: &Scene) -> f64 {
    scene.numerics.stepping.euler_revolutions(scene.operation.pinion_revolutions)
}

/// As tables and plots say it.
pub(crate) fn coupling_name(coupling: Coupling) -> &'static str {
    match coupling {
        Coupling::None => "uncoupled",
        Coupling::Slicing => "coupled by plate theory",
        Coupling::Fem => "coupled by three-dimensional finite elements",
    }
}

impl Setting {
    /// What it is called in tables and plots.
    pub(crate) fn name(&self) -> String {
        let slices = self.slices.map(|s| format!("{} slices, {}", s.count, coupling_name(s.coupling)));
        let stiffness = self.stiffness.as_ref().map(Stiffness::title);
        let parts = [Some(self.surface_name()), stiffness, slices, self.coarsening.name()];
        parts.into_iter().flatten().collect::<Vec<_>>().join(" · ")
    }

    /// The surface, and whether it follows tip edges.
    pub(crate) fn surface_name(&self) -> String {
        let follows = self.surface.may_follow_tip() && self.tip_contact;
        format!("{}{}", self.surface.name(), if follows { ", tip contact" } else { "" })
    }

    /// Whether `scene` is fine enough to be coarsened like this.
    pub(crate) fn fits(coarsening: Coarsening, scene: &Scene) -> bool {
        let numerics = scene.numerics;
        coarsening.spacing == 1
            || numerics.flank_points.min(numerics.positions) / coarsening.spacing as usize >= LEAST_POINTS
    }

    /// The scene it stands for. `calibration` is the name of the calibration file where there is a calibration.
    pub(crate) fn scene(&self, base: &Resolved, calibration: Option<&str>) -> Result<Resolved, Vec<Problem>> {
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
            Surface::Winkler(Foundation::Given { foundation_mpa_per_mm }) => {
                contact.foundation_MPa_per_mm = Some(foundation_mpa_per_mm);
            }
            Surface::Winkler(Foundation::Matched(criterion)) => contact.match_criterion = Some(criterion),
            Surface::Winkler(Foundation::Calibrated(criterion)) => {
                contact.match_criterion = Some(criterion);
                contact.calibration = calibration.map(str::to_owned);
            }
            Surface::Hertz | Surface::HertzMean | Surface::HalfSpace if reads_calibration => {
                contact.calibration = calibration.map(str::to_owned);
            }
            Surface::Hertz | Surface::HertzMean | Surface::HalfSpace => {}
            Surface::Fem { elements_per_half_width } => {
                file.fem.get_or_insert_default().elements_per_half_width = Some(elements_per_half_width);
            }
        }
        if let Some(SliceSettings { count, coupling }) = self.slices {
            file.helical = Some(HelicalFile { slices: Some(count as u32), coupling: Some(coupling) });
        }
        file.stiffness = self.stiffness.as_ref().map(|stiffness| stiffness.file.clone());
        let numerics = base.scene.numerics;
        let coarser = |count: usize| (count as u32 / self.coarsening.spacing).max(LEAST_POINTS as u32);
        file.numerics = Some(NumericsFile {
            flank_points: Some(coarser(numerics.flank_points)),
            positions: Some(coarser(numerics.positions)),
            error_estimate: Some(false),
            step: Some(StepFile::fixed(f64::from(self.coarsening.step) * euler_revolutions(&base.scene))),
            ..NumericsFile::default()
        });
        Resolved::from_toml(&file.to_toml())
    }

    /// What the record says of it.
    pub(crate) fn record(&self, scene: &Scene) -> VariantSettings {
        let match_criterion = match self.surface {
            Surface::Winkler(Foundation::Matched(criterion) | Foundation::Calibrated(criterion)) => {
                Some(criterion.name())
            }
            Surface::Winkler(Foundation::Given { .. }) => Some("given"),
            _ => None,
        };
        let elements_per_half_width = match self.surface {
            Surface::Fem { elements_per_half_width } => Some(elements_per_half_width),
            _ => None,
        };
        VariantSettings {
            surface: self.surface.kind().name().to_owned(),
            match_criterion: match_criterion.map(str::to_owned),
            calibrated: matches!(self.surface, Surface::Winkler(Foundation::Calibrated(_))),
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
