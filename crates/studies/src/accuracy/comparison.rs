//! Runs that differ in one respect only, side by side: how much a choice matters by itself.
//!
//! The tooth stiffness is compared on one surface with the stiffness of finite elements; the contact surfaces are compared
//! with the surface of finite elements, which brings its own stiffness. Unlike the errors against the reference, these
//! are differences of two runs of the same resolution.

use super::measure::profile_error;
use super::observed::ObservedRun;
use super::settings::{Setting, StiffnessSetting, SurfaceSetting};
use crate::accuracy::record::{ComparisonRow, SettingComparison};
use gearwear::scene::Resolved;
use gearwear::scene::file::StiffnessModel;
use gearwear_bodies::gear::PerGear;

/// A run to compare.
#[derive(Debug, Clone, Copy)]
pub struct ComparedRun<'a> {
    pub setting: &'a Setting,
    /// Curves of the run, at the reference's coordinates.
    pub observed: &'a ObservedRun,
    /// Wall time of the wear run.
    pub simulation_s: f64,
}

impl ComparedRun<'_> {
    fn stiffness_model(&self) -> Option<StiffnessModel> {
        self.setting.stiffness.as_ref().and_then(|stiffness| stiffness.file.model)
    }

    fn stiffness_title(&self) -> String {
        self.setting.stiffness.as_ref().map_or_else(String::new, StiffnessSetting::title)
    }

    fn is_fem(&self) -> bool {
        matches!(self.setting.surface, SurfaceSetting::Fem { .. })
    }

    /// Rank of the tooth stiffness, the most accurate highest.
    fn stiffness_rank(&self) -> u8 {
        match self.stiffness_model() {
            Some(StiffnessModel::Fem) => 2,
            Some(StiffnessModel::WeberBanaschek) => 1,
            _ => 0,
        }
    }
}

/// Tooth stiffnesses on the scene's surface, and contact surfaces with the best stiffness there is, where all sections are alike.
pub fn comparisons(resolved: &Resolved, runs: &[ComparedRun<'_>]) -> Vec<SettingComparison> {
    let Some(finest) = runs.iter().map(|run| run.setting.coarsening.spacing).min() else { return Vec::new() };
    let even: Vec<ComparedRun<'_>> = runs
        .iter()
        .copied()
        .filter(|run| run.setting.coarsening.spacing == finest && run.setting.coarsening.step == finest)
        .collect();
    stiffnesses(resolved, &even).into_iter().chain(surfaces(&even)).collect()
}

/// All stiffnesses on one surface; none where only one was run.
pub(super) fn stiffnesses(resolved: &Resolved, runs: &[ComparedRun<'_>]) -> Option<SettingComparison> {
    let surface = SurfaceSetting::of_scene(resolved);
    let on_it: Vec<ComparedRun<'_>> = runs.iter().copied().filter(|run| run.setting.surface == surface).collect();
    let baseline = [StiffnessModel::Fem, StiffnessModel::WeberBanaschek]
        .into_iter()
        .find_map(|wanted| on_it.iter().find(|run| run.stiffness_model() == Some(wanted)))?;
    let rows: Vec<ComparisonRow> = on_it
        .iter()
        .filter(|run| run.setting.tip_contact == baseline.setting.tip_contact)
        .filter(|run| run.stiffness_title() != baseline.stiffness_title())
        .map(|run| row(run.stiffness_title(), run, baseline))
        .collect();
    table("Tooth stiffness", format!("contact: {}", surface.name()), &baseline.stiffness_title(), rows)
}

/// None where nothing is to be compared.
pub(super) fn table(
    title: &str,
    common: String,
    baseline: &str,
    rows: Vec<ComparisonRow>,
) -> Option<SettingComparison> {
    (!rows.is_empty()).then(|| SettingComparison {
        title: title.to_owned(),
        common,
        baseline: baseline.to_owned(),
        rows,
    })
}

/// All surfaces with one stiffness against finite elements; none where there are none.
fn surfaces(runs: &[ComparedRun<'_>]) -> Option<SettingComparison> {
    let baseline = runs.iter().find(|run| run.is_fem())?;
    let best = runs.iter().map(ComparedRun::stiffness_rank).max()?;
    let others: Vec<&ComparedRun<'_>> =
        runs.iter().filter(|run| !run.is_fem() && run.stiffness_rank() == best).collect();
    let stiffness = others.iter().find_map(|run| run.setting.stiffness.as_ref())?;
    let rows = others.iter().map(|run| row(run.setting.surface_name(), run, baseline)).collect();
    let common = format!("{} on the line of action", stiffness.title());
    table("Contact surface", common, &baseline.setting.surface.name(), rows)
}

pub(super) fn row(name: String, run: &ComparedRun<'_>, baseline: &ComparedRun<'_>) -> ComparisonRow {
    ComparisonRow {
        name,
        wear_profile: PerGear::from_fn(|gear| {
            profile_error(&run.observed.flanks[gear], &baseline.observed.flanks[gear])
        }),
        peak_wear: PerGear::from_fn(|gear| {
            let [peak, of_baseline] = [run, baseline].map(|run| run.observed.flanks[gear].peak_wear_um());
            if peak == of_baseline { 0.0 } else { peak / of_baseline - 1.0 }
        }),
        simulation_s: run.simulation_s,
    }
}
