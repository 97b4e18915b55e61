//! Runs that differ in one respect only, side by side: how much a choice matters by itself.
//!
//! The tooth stiffness is compared on one surface with the stiffness of finite elements; the contact surfaces are compared
//! with the surface of finite elements, which brings its own stiffness. Unlike the errors against the reference, these
//! are differences of two runs of the same resolution.

use super::measure::profile_error;
use super::observed::Observed;
use super::settings::{Setting, Stiffness, Surface};
use crate::gear::PerGear;
use crate::scene::Resolved;
use crate::scene::file::StiffnessModel;
use crate::studies::accuracy::record::{Comparison, ComparisonRow};

/// A run to compare.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run<'a> {
    pub setting: &'a Setting,
    /// Curves of the run, at the reference's coordinates.
    pub observed: &'a Observed,
    /// Wall time of the wear run.
    pub simulation_s: f64,
}

/// Tooth stiffnesses on the scene's surface, and contact surfaces with the best stiffness there is, where all sections are alike.
pub(crate) fn comparisons(resolved: &Resolved, runs: &[Run<'_>]) -> Vec<Comparison> {
    let Some(finest) = runs.iter().map(|run| run.setting.coarsening.spacing).min() else { return Vec::new() };
    let even: Vec<Run<'_>> = runs
        .iter()
        .copied()
        .filter(|run| run.setting.coarsening.spacing == finest && run.setting.coarsening.step == finest)
        .collect();
    stiffnesses(resolved, &even).into_iter().chain(surfaces(&even)).collect()
}

/// All stiffnesses on one surface; none where only one was run.
pub(super) fn stiffnesses(resolved: &Resolved, runs: &[Run<'_>]) -> Option<Comparison> {
    let surface = Surface::of_scene(resolved);
    let on_it: Vec<Run<'_>> = runs.iter().copied().filter(|run| run.setting.surface == surface).collect();
    let model = |run: &Run<'_>| run.setting.stiffness.as_ref().and_then(|stiffness| stiffness.file.model);
    let with = |wanted| on_it.iter().copied().find(|run| model(run) == Some(wanted));
    let baseline = with(StiffnessModel::Fem).or_else(|| with(StiffnessModel::WeberBanaschek))?;
    let name = |run: &Run<'_>| run.setting.stiffness.as_ref().map_or_else(String::new, Stiffness::title);
    let rows: Vec<ComparisonRow> = on_it
        .iter()
        .filter(|run| run.setting.tip_contact == baseline.setting.tip_contact && name(run) != name(&baseline))
        .map(|run| row(name(run), run, &baseline))
        .collect();
    table("Tooth stiffness", format!("contact: {}", surface.name()), &name(&baseline), rows)
}

/// None where nothing is to be compared.
pub(super) fn table(title: &str, common: String, baseline: &str, rows: Vec<ComparisonRow>) -> Option<Comparison> {
    (!rows.is_empty()).then(|| Comparison { title: title.to_owned(), common, baseline: baseline.to_owned(), rows })
}

/// All surfaces with one stiffness against finite elements; none where there are none.
fn surfaces(runs: &[Run<'_>]) -> Option<Comparison> {
    let is_fem = |run: &&Run<'_>| matches!(run.setting.surface, Surface::Fem { .. });
    let baseline = runs.iter().find(is_fem)?;
    let rank = |run: &Run<'_>| match run.setting.stiffness.as_ref().and_then(|stiffness| stiffness.file.model) {
        Some(StiffnessModel::Fem) => 2,
        Some(StiffnessModel::WeberBanaschek) => 1,
        _ => 0,
    };
    let best = runs.iter().map(rank).max()?;
    let others: Vec<&Run<'_>> = runs.iter().filter(|run| !is_fem(run) && rank(run) == best).collect();
    let stiffness = others.iter().find_map(|run| run.setting.stiffness.as_ref())?;
    let rows = others.iter().map(|run| row(run.setting.surface_name(), run, baseline)).collect();
    let common = format!("{} on the line of action", stiffness.title());
    table("Contact surface", common, &baseline.setting.surface.name(), rows)
}

pub(super) fn row(name: String, run: &Run<'_>, baseline: &Run<'_>) -> ComparisonRow {
    ComparisonRow {
        name,
        wear_profile: PerGear::from_fn(|gear| {
            profile_error(&run.observed.flanks[gear], &baseline.observed.flanks[gear])
        }),
        peak_wear: PerGear::from_fn(|gear| {
            let peak = |run: &Run<'_>| run.observed.flanks[gear].peak_wear_um();
            if peak(run) == peak(baseline) { 0.0 } else { peak(run) / peak(baseline) - 1.0 }
        }),
        simulation_s: run.simulation_s,
    }
}
