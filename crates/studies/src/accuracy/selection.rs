//! Selection of the settings that are run, their order, and the reason for those left out.
//!
//! Not every combination is run, but
//!
//! * the finite-element surface on meshes of three sizes, the coarser ones at every resolution of points, positions and steps; the
//!   finest and some companions of it make the reference and come first;
//! * every other surface at every resolution, with the scene's own stiffness and with that of finite elements;
//! * every other surface with every other stiffness at the second resolution, the scene's own surface at the finest;
//! * tip edges followed outside A to E, and not, with one stiffness only.
//!
//! A scene with slices over the face width has another plan: `sliced_selection`.

use super::settings::{Coarsening, Setting, StiffnessSetting, SurfaceSetting};
use super::sliced_selection;
use crate::accuracy::record::LeftOut;
use gearwear::scene::Resolved;
use gearwear::scene::file::StiffnessModel;
use gearwear_physics::contact::settings::{Foundation, MatchCriterion, SurfaceKind};

/// Usual stiffness of a tooth pair of steel without flattening, where the scene gives none, N/(mm·µm).
const USUAL_STIFFNESS_N_PER_MM_UM: f64 = 20.0;
/// Sizes of the finite-element mesh beside the scene's: this share of its elements in a half-width.
const COARSER_MESHES: [f64; 2] = [0.6, 0.4];
/// Fewest elements in a half-width.
const LEAST_ELEMENTS: f64 = 2.0;
/// Factor on the wear step of the companions of the reference. On a fine mesh short waves of wear limit Euler's step; much longer steps would not
/// show the order of convergence that the extrapolation assumes.
pub(super) const COMPANION_STEP: u32 = 2;

/// Options of the comparison beside the scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AccuracyOptions {
    /// The relative error that recommendations stay within.
    pub within: f64,
    /// Whether to leave the finest resolution out.
    pub quick: bool,
}

/// Two runs of the reference that differ in one spacing; indices of the settings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CompanionRuns {
    pub fine: usize,
    pub coarse: usize,
    pub spacing: RefinedSpacing,
}

/// Setting that differs between two companions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RefinedSpacing {
    /// The size of elements, by this ratio.
    Elements(f64),
    /// The spacing of flank points and positions, by this ratio.
    Points(f64),
    /// The width of the slices, by this ratio.
    Slices(f64),
    /// The length of the wear step; the ratio follows from the steps taken.
    Step,
}

impl RefinedSpacing {
    /// Change of the scene that reduces the difference.
    pub fn remedy(self) -> &'static str {
        match self {
            Self::Elements(_) => "more fem.elements_per_half_width",
            Self::Points(_) => "more numerics.flank_points and numerics.positions",
            Self::Slices(_) => "more helical.slices",
            Self::Step => "a shorter numerics.step or a lower numerics.tolerance_um",
        }
    }
}

#[derive(Debug, Clone, PartialEq)]
pub struct Selection {
    /// Every setting, in the order of the runs; the first is the finest.
    pub settings: Vec<Setting>,
    /// Settings from which, with the first, the reference is extrapolated.
    pub companions: Vec<CompanionRuns>,
    pub left_out: Vec<LeftOut>,
}

impl Selection {
    /// Settings that fit the scene. `calibrated` holds the criteria with a calibrated K/H; where it is empty, `no_calibration` is the reason.
    pub fn new(
        resolved: &Resolved,
        asked: AccuracyOptions,
        calibrated: &[MatchCriterion],
        no_calibration: &str,
    ) -> Self {
        let scene = &resolved.scene;
        let finest = if asked.quick { 2 } else { 1 };
        let mut levels = vec![finest];
        let mut selection = Self { settings: Vec::new(), companions: Vec::new(), left_out: Vec::new() };
        if asked.quick {
            selection
                .leave_out("the scene's own resolution", "--quick: half of its points, positions and steps at most");
        }
        for by in [2 * finest, 4 * finest] {
            if Setting::fits(Coarsening::even(by), scene) {
                levels.push(by);
            } else {
                selection.leave_out(
                    &format!("1/{by} of the scene's points and positions"),
                    "fewer than 20 points or positions would be left",
                );
            }
        }
        let stiffnesses = Stiffnesses::new(resolved, calibrated);
        match scene.slices {
            Some(slices) => sliced_selection::add(&mut selection, resolved, slices, &levels, calibrated, &stiffnesses),
            None => {
                selection.finite_elements(scene.fem.elements_per_half_width, &levels);
                selection.line_of_action(resolved, &levels, calibrated, &stiffnesses);
            }
        }
        selection.leave_out_of_all(resolved, calibrated, no_calibration);
        selection
    }

    /// Finest setting with half of its points and positions, where that was run.
    pub fn second_resolution(&self) -> Setting {
        let finest = &self.settings[0];
        let by = 2 * finest.coarsening.spacing;
        let half = self.settings.iter().find(|setting| setting.coarsening.spacing == by);
        half.unwrap_or(finest).clone()
    }

    pub(super) fn leave_out(&mut self, what: &str, reason: &str) {
        self.left_out.push(LeftOut { what: what.to_owned(), reason: reason.to_owned() });
    }

    pub(super) fn add(&mut self, setting: Setting) -> usize {
        if let Some(there) = self.settings.iter().position(|other| *other == setting) {
            return there;
        }
        self.settings.push(setting);
        self.settings.len() - 1
    }

    /// The reference with its companions, then the finite elements of other sizes.
    fn finite_elements(&mut self, elements: f64, levels: &[u32]) {
        let mut meshes = vec![elements];
        for share in COARSER_MESHES {
            let coarser = (elements * share).round();
            if coarser >= LEAST_ELEMENTS && !meshes.contains(&coarser) {
                meshes.push(coarser);
            } else {
                self.leave_out(
                    &format!("finite elements with {share} of the scene's {elements} elements in a half-width"),
                    "too few elements",
                );
            }
        }
        let finest = levels[0];
        let long_steps = Coarsening { spacing: finest, step: COMPANION_STEP * finest };
        self.add(Setting::fem(elements, Coarsening::even(finest)));
        let cheapest = meshes.get(1).copied().unwrap_or(elements);
        let fine = self.add(Setting::fem(cheapest, Coarsening::even(finest)));
        let long = self.add(Setting::fem(cheapest, long_steps));
        self.companions.push(CompanionRuns { fine, coarse: long, spacing: RefinedSpacing::Step });
        if fine != 0 {
            let spacing = RefinedSpacing::Elements(elements / cheapest);
            self.companions.push(CompanionRuns { fine: 0, coarse: fine, spacing });
        }
        if let Some(&wider) = levels.get(1) {
            let coarse = self.add(Setting::fem(cheapest, Coarsening { spacing: wider, ..long_steps }));
            let ratio = f64::from(wider) / f64::from(finest);
            self.companions.push(CompanionRuns { fine: long, coarse, spacing: RefinedSpacing::Points(ratio) });
        }
        // The finest mesh has most of its cost in the mesh itself: fewer points and steps on it cost more than all of them on a coarser one.
        let coarser = if meshes.len() > 1 { &meshes[1..] } else { &meshes[..] };
        for &mesh in coarser {
            for &by in levels {
                self.add(Setting::fem(mesh, Coarsening::even(by)));
            }
        }
        if meshes.len() > 1 && levels.len() > 1 {
            self.leave_out(
                &format!("fewer points, positions and steps with {elements} elements in a half-width"),
                "all of them with fewer elements cost less",
            );
        }
    }

    /// Adds the settings whose contact is on the theoretical line of action.
    fn line_of_action(
        &mut self,
        resolved: &Resolved,
        levels: &[u32],
        calibrated: &[MatchCriterion],
        with: &Stiffnesses,
    ) {
        let has_calibration = !calibrated.is_empty();
        let Stiffnesses { all: stiffnesses, tried } = with;
        let best = &with.best().name;
        let finest = levels[0];
        for surface in surfaces(resolved, calibrated) {
            // Stiffnesses are compared with each other on the scene's own surface.
            let is_own = surface == SurfaceSetting::of_scene(resolved);
            let level_of_others = if is_own { finest } else { levels.get(1).copied().unwrap_or(finest) };
            for &by in levels {
                for stiffness in stiffnesses {
                    if by != level_of_others && !tried.contains(&stiffness.name) {
                        continue;
                    }
                    let tip_contact = follows_tip(surface, has_calibration);
                    let setting = Setting {
                        surface,
                        tip_contact,
                        stiffness: Some(stiffness.clone()),
                        slices: None,
                        coarsening: Coarsening::even(by),
                    };
                    self.add(setting.clone());
                    if surface.may_follow_tip() && by == finest && stiffness.name == *best {
                        self.add(Setting { tip_contact: !tip_contact, ..setting });
                    }
                }
            }
        }
        if levels.len() > 1 && stiffnesses.len() > tried.len() {
            self.leave_out(
                &format!("more than one resolution with other stiffnesses than {}", tried.join(" and ")),
                "the resolution's error hardly depends on the stiffness",
            );
        }
        if stiffnesses.len() > 1 {
            self.leave_out(
                &format!("tip edges followed, and not, with another stiffness than {best}"),
                "what the tip edge changes hardly depends on the stiffness",
            );
        }
    }

    /// Records the settings that are left out for every scene.
    fn leave_out_of_all(&mut self, resolved: &Resolved, calibrated: &[MatchCriterion], no_calibration: &str) {
        let own = resolved.file.stiffness.as_ref().and_then(|stiffness| stiffness.model);
        for (model, name) in [(StiffnessModel::Simon, "simon"), (StiffnessModel::WangCheng, "wang-cheng")] {
            if own != Some(model) {
                self.leave_out(&format!("stiffness {name}"), "a curve of the user's; the scene gives none");
            }
        }
        if calibrated.is_empty() {
            self.leave_out("stiffness fem and calibrated winkler", no_calibration);
        }
        self.leave_out("several resolutions of points, positions and steps in one run", "they are refined together");
    }
}

/// Stiffness models that fit a scene.
pub(super) struct Stiffnesses {
    pub all: Vec<StiffnessSetting>,
    /// Names of those tried at several resolutions, the best last.
    pub tried: Vec<String>,
}

impl Stiffnesses {
    fn new(resolved: &Resolved, calibrated: &[MatchCriterion]) -> Self {
        let has_calibration = !calibrated.is_empty();
        let own = (resolved.scene.contact.surface != SurfaceKind::Fem).then(|| StiffnessSetting::of_scene(resolved));
        let own = own.filter(|own| has_calibration || own.file.model != Some(StiffnessModel::Fem));
        let of_fem = has_calibration.then(|| StiffnessSetting::of_model(StiffnessModel::Fem, "fem"));
        let own_is_constant = own.as_ref().is_some_and(|own| own.file.model == Some(StiffnessModel::Constant));
        let usual = (!own_is_constant).then(|| StiffnessSetting::constant(USUAL_STIFFNESS_N_PER_MM_UM));
        let weber_banaschek = StiffnessSetting::of_model(StiffnessModel::WeberBanaschek, "weber-banaschek");
        let mut tried: Vec<String> = own.iter().chain(&of_fem).map(|stiffness| stiffness.name.clone()).collect();
        if tried.is_empty() {
            tried.push(weber_banaschek.name.clone());
        }
        let closed_forms = [weber_banaschek, StiffnessSetting::of_model(StiffnessModel::Iso6336, "iso6336")];
        let mut all: Vec<StiffnessSetting> = Vec::new();
        for stiffness in own.into_iter().chain(of_fem).chain(closed_forms).chain(usual) {
            if all.iter().all(|other| other.name != stiffness.name) {
                all.push(stiffness);
            }
        }
        Self { all, tried }
    }

    /// Stiffness with which tip contact is tried: that of finite elements where there is one.
    pub(super) fn best(&self) -> &StiffnessSetting {
        let name = self.tried.last();
        self.all.iter().find(|stiffness| Some(&stiffness.name) == name).unwrap_or(&self.all[0])
    }
}

/// Surfaces on the line of action, from the fastest to the most accurate.
pub(super) fn surfaces(resolved: &Resolved, calibrated: &[MatchCriterion]) -> Vec<SurfaceSetting> {
    let mut surfaces = vec![SurfaceSetting::HertzMean, SurfaceSetting::Hertz];
    let own = resolved.scene.contact.foundation;
    surfaces.extend(matches!(own, Foundation::Given { .. }).then_some(SurfaceSetting::Winkler(own)));
    surfaces.extend(MatchCriterion::ALL.map(|criterion| SurfaceSetting::Winkler(Foundation::Matched(criterion))));
    surfaces.extend(calibrated.iter().map(|&criterion| SurfaceSetting::Winkler(Foundation::Calibrated(criterion))));
    surfaces.push(SurfaceSetting::HalfSpace);
    surfaces
}

/// Whether a surface is run with tip contact alone: the calibrated and the most accurate ones are.
fn follows_tip(surface: SurfaceSetting, has_calibration: bool) -> bool {
    match surface {
        SurfaceSetting::Winkler(Foundation::Calibrated(_)) => true,
        SurfaceSetting::HalfSpace => has_calibration,
        _ => false,
    }
}
