//! Selection of the settings that are run where sections differ over the face width.
//!
//! Plane finite elements are no solution of such a pair. The reference is therefore elastic half-planes whose slices are coupled
//! by three-dimensional finite elements of both gears, with tip contact, on twice the scene's slices; where the gears cannot be
//! meshed in space, or not with so many slices, the slices are coupled by plate theory. The plan is
//!
//! * the reference and its companions: steps twice as long, half of the slices, half of the points and positions;
//! * the surfaces that stand for the others, coupled in space, at the finest resolution;
//! * every surface, coupled by plate theory and uncoupled, at every resolution of points, positions and steps, on the scene's slices;
//! * other numbers of slices with the surfaces that stand for the others, at the second resolution;
//! * other tooth stiffnesses on the scene's own surface, and tip edges that are not followed.

use super::selection::{COMPANION_STEP, CompanionRuns, RefinedSpacing, Selection, Stiffnesses, surfaces};
use super::settings::{Coarsening, Setting, StiffnessSetting, SurfaceSetting};
use gearwear::scene::Resolved;
use gearwear_bodies::gear_mesh::settings::Body;
use gearwear_physics::contact::settings::{Foundation, MatchCriterion};
use gearwear_physics::mesh_cycle::settings::{Coupling, MOST_SLICES_IN_SPACE, SliceSettings};
use gearwear_physics::operation::Scene;

/// Least number of slices worth comparing.
const LEAST_SLICES: usize = 2;
/// Criterion of the K/H whose Winkler foundation is tried at every resolution and coupling.
const CRITERION: MatchCriterion = MatchCriterion::HalfWidth;
const MATCHED: SurfaceSetting = SurfaceSetting::Winkler(Foundation::Matched(CRITERION));
/// Couplings tried with every surface, the more accurate one first.
const COUPLINGS: [Coupling; 2] = [Coupling::Slicing, Coupling::None];

/// Coupling of the reference with this many slices: three-dimensional finite elements where they can be meshed, else plate theory.
pub(super) fn truest(scene: &Scene, slices: usize) -> Coupling {
    match scene.fem.body == Body::Ring && slices <= MOST_SLICES_IN_SPACE {
        true => Coupling::Fem,
        false => Coupling::Slicing,
    }
}

/// Greatest number of slices of the reference.
fn most_slices(coupling: Coupling) -> usize {
    match coupling {
        Coupling::Fem => MOST_SLICES_IN_SPACE,
        Coupling::None | Coupling::Slicing => 2000,
    }
}

/// Slices on which the stiffness models are compared: a single one where the coupling is three-dimensional.
pub(super) fn slices_of_any_stiffness(own: SliceSettings) -> SliceSettings {
    match own.coupling {
        Coupling::Fem => SliceSettings { coupling: Coupling::Slicing, ..own },
        Coupling::None | Coupling::Slicing => own,
    }
}

/// Adds the settings of a pair with slices to `selection`.
pub(super) fn add(
    selection: &mut Selection,
    resolved: &Resolved,
    own: SliceSettings,
    levels: &[u32],
    calibrated: &[MatchCriterion],
    stiffnesses: &Stiffnesses,
) {
    let best = stiffnesses.best();
    let truest = truest(&resolved.scene, own.count);
    reference(selection, SliceSettings { coupling: truest, ..own }, levels, best);
    let finest = levels[0];
    let second = levels.get(1).copied().unwrap_or(finest);
    for surface in surfaces(resolved, calibrated) {
        if truest == Coupling::Fem && stands_for_others(surface) {
            selection.add(setting(surface, best, SliceSettings { coupling: truest, ..own }, Coarsening::even(finest)));
        }
        for &by in levels {
            for coupling in COUPLINGS {
                if stands_for_others(surface) || (by == finest && coupling == Coupling::Slicing) {
                    selection.add(setting(surface, best, SliceSettings { coupling, ..own }, Coarsening::even(by)));
                }
            }
        }
    }
    for count in other_counts(selection, own.count) {
        for surface in [SurfaceSetting::HertzMean, SurfaceSetting::Hertz, MATCHED, SurfaceSetting::HalfSpace] {
            for coupling in COUPLINGS {
                selection.add(setting(surface, best, SliceSettings { count, coupling }, Coarsening::even(second)));
            }
        }
    }
    for stiffness in &stiffnesses.all {
        let slices = slices_of_any_stiffness(own);
        selection.add(setting(SurfaceSetting::of_scene(resolved), stiffness, slices, Coarsening::even(second)));
    }
    let coupled = SliceSettings { coupling: Coupling::Slicing, ..own };
    for (surface, by) in [(MATCHED, finest), (SurfaceSetting::HalfSpace, second)] {
        let followed = setting(surface, best, coupled, Coarsening::even(by));
        selection.add(Setting { tip_contact: false, ..followed });
    }
    leave_out(selection);
}

/// The reference, first of all, with its companions.
fn reference(selection: &mut Selection, own: SliceSettings, levels: &[u32], stiffness: &StiffnessSetting) {
    let (finest, slices) = (levels[0], own.count);
    let long_steps = Coarsening { spacing: finest, step: COMPANION_STEP * finest };
    let most = (2 * slices).min(most_slices(own.coupling));
    let many = SliceSettings { count: most, ..own };
    selection.add(setting(SurfaceSetting::HalfSpace, stiffness, many, Coarsening::even(finest)));
    let long = selection.add(setting(SurfaceSetting::HalfSpace, stiffness, many, long_steps));
    selection.companions.push(CompanionRuns { fine: 0, coarse: long, spacing: RefinedSpacing::Step });
    let wide = selection.add(setting(SurfaceSetting::HalfSpace, stiffness, own, long_steps));
    if most > slices {
        let ratio = most as f64 / slices as f64;
        selection.companions.push(CompanionRuns { fine: long, coarse: wide, spacing: RefinedSpacing::Slices(ratio) });
    }
    if let Some(&wider) = levels.get(1) {
        let coarser = Coarsening { spacing: wider, ..long_steps };
        let coarse = selection.add(setting(SurfaceSetting::HalfSpace, stiffness, own, coarser));
        let ratio = f64::from(wider) / f64::from(finest);
        selection.companions.push(CompanionRuns { fine: wide, coarse, spacing: RefinedSpacing::Points(ratio) });
    }
}

/// A quarter, half and twice the scene's number of slices, where at least [`LEAST_SLICES`].
fn other_counts(selection: &mut Selection, own: usize) -> Vec<usize> {
    let mut counts: Vec<usize> = Vec::new();
    for (count, name) in
        [(own / 4, "a quarter"), (own / 2, "half"), ((2 * own).min(most_slices(Coupling::Slicing)), "twice")]
    {
        if count < LEAST_SLICES || count == own {
            selection.leave_out(&format!("{name} of the scene's {own} slices"), "not between 2 and 2000 slices");
        } else {
            counts.push(count);
        }
    }
    counts
}

fn setting(
    surface: SurfaceSetting,
    stiffness: &StiffnessSetting,
    slices: SliceSettings,
    coarsening: Coarsening,
) -> Setting {
    Setting {
        surface,
        tip_contact: surface.may_follow_tip(),
        stiffness: Some(stiffness.clone()),
        slices: Some(slices),
        coarsening,
    }
}

/// Whether a surface is tried at every resolution and coupling: of the Winkler foundations, those matched on half-width.
fn stands_for_others(surface: SurfaceSetting) -> bool {
    match surface {
        SurfaceSetting::Winkler(Foundation::Matched(criterion) | Foundation::Calibrated(criterion)) => {
            criterion == CRITERION
        }
        _ => true,
    }
}

fn leave_out(selection: &mut Selection) {
    for (what, reason) in [
        ("surface fem", "the finite elements are plane: they calibrate the slices, but are no slices themselves"),
        (
            "other surfaces, stiffnesses, numbers of slices and resolutions coupled in space",
            "the coupling changes them as it changes those that are run",
        ),
        ("half-width", "where slices of one tooth enter while others leave, no pair ever carries the load alone"),
        (
            "Winkler foundations on peak pressure and approach uncoupled, and at coarser resolutions",
            "coupling and resolution change them as they change the one on half-width",
        ),
        (
            "other numbers of slices with calibrated foundations, and at other resolutions",
            "the slices' error hardly depends on them",
        ),
        ("other tooth stiffnesses than the best on other surfaces than the scene's", "the difference is the same"),
        (
            "tip edges not followed, but by coupled half-space and Winkler on half-width",
            "what the tip edge changes hardly depends on the rest",
        ),
    ] {
        selection.leave_out(what, reason);
    }
}
