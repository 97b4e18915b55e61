//! Runs of a pair with slices that differ in one respect only, side by side.
//!
//! | table | differs in | against |
//! |---|---|---|
//! | coupling | how slices are coupled | the same surface, coupled as the reference |
//! | simplified model | mean pressure in place of Hertz's ellipse | `hertz` with the same coupling |
//! | contact surface | the surface, all of them coupled | `half-space`, tip edges followed |
//! | tooth stiffness | the stiffness, on the scene's surface | that of finite elements |

use super::comparison::{ComparedRun, row, stiffnesses, table};
use super::settings::{Setting, StiffnessSetting, SurfaceSetting, coupling_name};
use super::sliced_selection::{slices_of_any_stiffness, truest};
use crate::accuracy::record::SettingComparison;
use gearwear::scene::Resolved;
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};

/// All tables that have rows.
pub(super) fn comparisons(resolved: &Resolved, own: SliceSettings, runs: &[ComparedRun<'_>]) -> Vec<SettingComparison> {
    let on_own_slices = runs.iter().copied().filter(|run| run.setting.slices.is_some_and(|s| s.count == own.count));
    let even: Vec<ComparedRun<'_>> =
        on_own_slices.filter(|run| run.setting.coarsening.spacing == run.setting.coarsening.step).collect();
    let Some(finest) = even.iter().map(|run| run.setting.coarsening.spacing).min() else { return Vec::new() };
    let at = |by: u32| -> Vec<ComparedRun<'_>> {
        even.iter().copied().filter(|run| run.setting.coarsening.spacing == by).collect()
    };
    let runs = at(finest);
    // Stiffnesses are tried at the second resolution where there is one.
    let scenes_own: Vec<ComparedRun<'_>> = [2 * finest, finest]
        .into_iter()
        .map(|by| {
            let slices = Some(slices_of_any_stiffness(own));
            at(by).into_iter().filter(|run| run.setting.slices == slices).collect::<Vec<_>>()
        })
        .find(|runs| !runs.is_empty())
        .unwrap_or_default();
    [
        coupling(&runs, own.count, truest(&resolved.scene, own.count)),
        simplified(&runs, own.count),
        surfaces(&runs, own.count),
        stiffnesses(resolved, &scenes_own),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// The run whose setting is that of `run` after `change`.
fn counterpart<'a>(
    runs: &[ComparedRun<'a>],
    run: &ComparedRun<'_>,
    change: impl Fn(&mut Setting),
) -> Option<ComparedRun<'a>> {
    let mut wanted = run.setting.clone();
    change(&mut wanted);
    runs.iter().copied().find(|other| *other.setting == wanted)
}

fn coupling_of(run: &ComparedRun<'_>) -> Coupling {
    run.setting.slices.map_or(Coupling::None, |slices| slices.coupling)
}

/// Every surface against itself with the most accurate coupling.
fn coupling(runs: &[ComparedRun<'_>], slices: usize, truest: Coupling) -> Option<SettingComparison> {
    let rows = runs
        .iter()
        .filter(|run| coupling_of(run) != truest)
        .filter_map(|run| {
            let coupled = counterpart(runs, run, |setting| {
                setting.slices = setting.slices.map(|s| SliceSettings { coupling: truest, ..s });
            })?;
            let coupling = coupling_name(coupling_of(run));
            Some(row(format!("{}, {coupling}", run.setting.surface_name()), run, &coupled))
        })
        .collect();
    let against = format!("the same surface, {}", coupling_name(truest));
    table("Coupling of slices", format!("{slices} slices, each surface by itself"), &against, rows)
}

/// The simplified model against the distributed pressure it stands for.
fn simplified(runs: &[ComparedRun<'_>], slices: usize) -> Option<SettingComparison> {
    let rows = runs
        .iter()
        .filter(|run| run.setting.surface == SurfaceSetting::HertzMean)
        .filter_map(|run| {
            let hertz = counterpart(runs, run, |setting| setting.surface = SurfaceSetting::Hertz)?;
            Some(row(format!("mean pressure, {}", coupling_name(coupling_of(run))), run, &hertz))
        })
        .collect();
    table(
        "Simplified model",
        format!("{slices} slices, coupling alike"),
        "Hertz with its distribution of pressure",
        rows,
    )
}

/// All coupled surfaces against elastic half-planes.
fn surfaces(runs: &[ComparedRun<'_>], slices: usize) -> Option<SettingComparison> {
    let coupled: Vec<&ComparedRun<'_>> = runs.iter().filter(|run| coupling_of(run) == Coupling::Slicing).collect();
    let baseline = coupled
        .iter()
        .find(|run| run.setting.surface == SurfaceSetting::HalfSpace && run.setting.tip_contact)
        .copied()?;
    let stiffness = &baseline.setting.stiffness;
    let rows = coupled
        .iter()
        .filter(|run| run.setting.stiffness == *stiffness && run.setting != baseline.setting)
        .map(|run| row(run.setting.surface_name(), run, baseline))
        .collect();
    let teeth = stiffness.as_ref().map_or_else(String::new, StiffnessSetting::title);
    let common = format!("{slices} slices, {}, {teeth}", coupling_name(Coupling::Slicing));
    table("Contact surface", common, &baseline.setting.surface_name(), rows)
}
