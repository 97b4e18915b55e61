//! Which settings are run where sections differ over the face width.
//!
//! There is no finite-element solution of such a pair to measure against: the finite elements are plane. The truest model
//! there is takes its place, elastic half-planes whose slices are coupled through the tooth's bending, tip edges followed, on
//! twice the scene's slices. The plan is
//!
//! * the reference and its companions: steps twice as long, half of the slices, half of the points and positions;
//! * every surface, coupled and uncoupled, at every resolution of points, positions and steps, on the scene's slices;
//! * other numbers of slices with the surfaces that stand for the others, at the second resolution;
//! * other tooth stiffnesses on the scene's own surface, and tip edges that are not followed.

use super::selection::{COMPANION_STEP, Companions, Selection, Spacing, Stiffnesses, surfaces};
use super::settings::{Coarsening, Setting, Stiffness, Surface};
use crate::contact::settings::{Foundation, MatchCriterion};
use crate::mesh_cycle::settings::{Coupling, SliceSettings};
use crate::scene::Resolved;

/// Most slices that a scene may have.
const MOST_SLICES: usize = 2000;
/// Fewest slices that tell something of the width.
const LEAST_SLICES: usize = 2;
/// The K/H that stands for the others.
const CRITERION: MatchCriterion = MatchCriterion::HalfWidth;
const MATCHED: Surface = Surface::Winkler(Foundation::Matched(CRITERION));
/// The true coupling first.
const COUPLINGS: [Coupling; 2] = [Coupling::Slicing, Coupling::None];

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
    reference(selection, own.count, levels, best);
    let finest = levels[0];
    let second = levels.get(1).copied().unwrap_or(finest);
    for surface in surfaces(resolved, calibrated) {
        for &by in levels {
            for coupling in COUPLINGS {
                if stands_for_others(surface) || (by == finest && coupling == Coupling::Slicing) {
                    selection.add(setting(surface, best, SliceSettings { coupling, ..own }, Coarsening::even(by)));
                }
            }
        }
    }
    for count in other_counts(selection, own.count) {
        for surface in [Surface::HertzMean, Surface::Hertz, MATCHED, Surface::HalfSpace] {
            for coupling in COUPLINGS {
                selection.add(setting(surface, best, SliceSettings { count, coupling }, Coarsening::even(second)));
            }
        }
    }
    for stiffness in &stiffnesses.all {
        selection.add(setting(Surface::of_scene(resolved), stiffness, own, Coarsening::even(second)));
    }
    let coupled = SliceSettings { coupling: Coupling::Slicing, ..own };
    for (surface, by) in [(MATCHED, finest), (Surface::HalfSpace, second)] {
        let followed = setting(surface, best, coupled, Coarsening::even(by));
        selection.add(Setting { tip_contact: false, ..followed });
    }
    leave_out(selection);
}

/// The reference, first of all, with its companions.
fn reference(selection: &mut Selection, slices: usize, levels: &[u32], stiffness: &Stiffness) {
    let finest = levels[0];
    let of = |count: usize, coarsening: Coarsening| {
        let slices = SliceSettings { count, coupling: Coupling::Slicing };
        setting(Surface::HalfSpace, stiffness, slices, coarsening)
    };
    let long_steps = Coarsening { spacing: finest, step: COMPANION_STEP * finest };
    let most = (2 * slices).min(MOST_SLICES);
    selection.add(of(most, Coarsening::even(finest)));
    let long = selection.add(of(most, long_steps));
    selection.companions.push(Companions { fine: 0, coarse: long, spacing: Spacing::Step });
    let wide = selection.add(of(slices, long_steps));
    if most > slices {
        let ratio = most as f64 / slices as f64;
        selection.companions.push(Companions { fine: long, coarse: wide, spacing: Spacing::Slices(ratio) });
    }
    if let Some(&wider) = levels.get(1) {
        let coarse = selection.add(of(slices, Coarsening { spacing: wider, ..long_steps }));
        let ratio = f64::from(wider) / f64::from(finest);
        selection.companions.push(Companions { fine: wide, coarse, spacing: Spacing::Points(ratio) });
    }
}

/// A quarter, half and twice the scene's slices, as far as these are slices at all.
fn other_counts(selection: &mut Selection, own: usize) -> Vec<usize> {
    let mut counts: Vec<usize> = Vec::new();
    for (count, name) in [(own / 4, "a quarter"), (own / 2, "half"), ((2 * own).min(MOST_SLICES), "twice")] {
        if count < LEAST_SLICES || count == own {
            selection.leave_out(&format!("{name} of the scene's {own} slices"), "not between 2 and 2000 slices");
        } else {
            counts.push(count);
        }
    }
    counts
}

fn setting(surface: Surface, stiffness: &Stiffness, slices: SliceSettings, coarsening: Coarsening) -> Setting {
    Setting {
        surface,
        tip_contact: surface.may_follow_tip(),
        stiffness: Some(stiffness.clone()),
        slices: Some(slices),
        coarsening,
    }
}

/// Whether a surface is tried at every resolution and coupling: of the Winkler foundations, those matched on half-width.
fn stands_for_others(surface: Surface) -> bool {
    match surface {
        Surface::Winkler(Foundation::Matched(criterion) | Foundation::Calibrated(criterion)) => criterion == CRITERION,
        _ => true,
    }
}

fn leave_out(selection: &mut Selection) {
    for (what, reason) in [
        ("surface fem", "the finite elements are plane: they calibrate the slices, but are no slices themselves"),
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
