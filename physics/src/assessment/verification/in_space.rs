//! Reference run for a run with slices: on elastic half-planes, tip edges followed, slices coupled by three-dimensional finite elements of both gears
//! ([`crate::mesh_cycle::pair_in_space`]), teeth as stiff as by plane finite elements.
//!
//! A run of this kind itself is compared with one on m slices in place of its n: the remaining error is that of the slices, for positions,
//! points and steps have estimates of their own. Loads gather in the last slices of a line of contact, so that wear converges with the
//! first order of their width, and the whole error is m/(m − n) times the difference (Richardson). At tip edges and below the start of active
//! profile it is the difference itself: the error there is of positions and points, not of slices. The transmission error is a sum over the slices and
//! converges about with the second order, m²/(m² − n²) times (docs/accuracy.md). A run of another kind is compared with one on as many slices, or on m
//! where the overlap is wide.

use std::borrow::Cow;

use super::{Elements, Extrapolation, ReferenceRun, ReferenceUncertainty, VerificationModels, simulate};
use crate::assessment::RunModel;
use crate::calibration;
use crate::contact::{ContactSurface, half_space::HalfSpace};
use crate::mesh_cycle::pair_in_space::PairInSpace;
use crate::mesh_cycle::settings::{Coupling, MOST_SLICES_IN_SPACE, SliceSettings};
use crate::mesh_cycle::slice_coupling::SliceCompliance;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::observer::Observer;
use crate::operation::Scene;
use crate::plan::is_finest_in_space;
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::wear_run::Outcome;
use crate::stiffness::settings::StiffnessSettings;
use crate::stiffness::{TeethSpring, curve::PairCompliance};
use gearwear_bodies::gear::slices::Slices;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::gear_fem::model::ModelError;

/// Positions from A to E, and those of the verification of a run with about as many: errors of the same spacing would agree.
const POSITIONS: [usize; 2] = [150, 120];
/// Difference to the number of positions of the run, over that, from which they are others.
const OTHERS: f64 = 0.1;
/// Fewest slices that resolve the loads at the ends of the lines of contact.
const LEAST_SLICES: usize = 20;
/// Overlap ratio from which the transmission error is so small that slices make a ripple of a tenth of it and more, and more slices are compared with.
const WIDE_OVERLAP: f64 = 0.8;
/// Uncertainty of half-planes in place of finite elements, of the elements and of the slices (docs/accuracy.md), at least that of severe wear.
const OF_HALF_PLANES: ReferenceUncertainty = ReferenceUncertainty {
    profile: 0.03,
    peak: 0.02,
    tip_edge: 0.06,
    transmission_error: [0.01, 0.01],
    pressure: 0.03,
    flank_pressure: [0.03, 0.03],
};

/// Reference run with slices coupled by three-dimensional finite elements.
///
/// # Errors
/// Reason why it is not completed.
pub(super) fn reference_run(
    model: &RunModel<'_>,
    outcome: &Outcome,
    models: VerificationModels<'_, '_>,
    observer: &dyn Observer,
) -> Result<ReferenceRun, String> {
    let RunModel { scene, pair, .. } = *model;
    let in_space = match models.in_space {
        Some(Ok(teeth)) => teeth,
        Some(Err(error)) => return Err(error.to_string()),
        None => return Err("there are no three-dimensional finite elements of the teeth".to_owned()),
    };
    let curve = curve(scene, models.curve, models.elements)?;
    let (count, extrapolation) = slices_of_reference(scene, outcome.slices.count(), &in_space);
    let settings = SliceSettings { count, coupling: Coupling::Fem };
    let unread = SliceCompliance::of_plates(pair, &scene.material, true);
    let sliced = SlicedTeeth::new(pair, &scene.material, settings, unread, Some(in_space));
    let surfaces: Vec<HalfSpace> = model
        .phases
        .iter()
        .map(|phase| HalfSpace { material: scene.material, expected_line_load_n_per_mm: phase.line_load_n_per_mm })
        .collect();
    let teeth: Vec<TeethSpring<'_>> = surfaces
        .iter()
        .map(|surface| {
            let load = surface.expected_line_load_n_per_mm;
            TeethSpring::new(StiffnessSettings::Fem, Some(&curve), pair, &scene.material, surface, load)
        })
        .collect::<Result<_, _>>()
        .map_err(|error| error.to_string())?;
    let surfaces = surfaces.iter().map(|surface| surface as &dyn ContactSurface);
    let contacts = surfaces
        .zip(&teeth)
        .map(|(surface, teeth)| MeshContact::LineOfAction { surface, teeth, tip_contact: true, sliced: Some(&sliced) })
        .collect();
    let reference = simulate(model, outcome, contacts, positions_beside(scene.numerics.positions), observer)?;
    let wear_mm = PerGear::from_fn(|gear: Gear| {
        let points = outcome.grid[gear].len();
        over_slices(&reference.worn.wear_mm[gear], points, &reference.slices, &outcome.slices)
    });
    let factors = match is_finest_in_space(scene) {
        true => format!(
            ", to which differences of the active profile count {:.1} times, for wear converges with the width of the slices, and of the \
             transmission error {:.1} times, for it converges with its square",
            extrapolation.wear, extrapolation.transmission_error
        ),
        false => String::new(),
    };
    let on = format!("elastic half-planes in {count} slices, coupled by three-dimensional finite elements{factors}");
    Ok(ReferenceRun { outcome: reference, uncertainty: OF_HALF_PLANES, bodies: None, extrapolation, wear_mm, on })
}

/// Stiffness along the path of contact by plane finite elements: the known `curve`, or computed on `elements`.
fn curve<'c>(
    scene: &Scene,
    curve: Option<&'c PairCompliance>,
    elements: Option<Result<Elements<'_>, ModelError>>,
) -> Result<Cow<'c, PairCompliance>, String> {
    match (curve, elements) {
        (Some(curve), _) => Ok(Cow::Borrowed(curve)),
        (None, Some(Ok(Elements { condensed, line_load_n_per_mm, .. }))) => {
            let curve = calibration::pair_compliance(&condensed, &scene.material, line_load_n_per_mm);
            curve.map(Cow::Owned).map_err(|error| error.to_string())
        }
        (None, Some(Err(error))) => Err(error.to_string()),
        (None, None) => Err("there are no plane finite elements".to_owned()),
    }
}

/// Number of positions of the reference run for a run on `own` positions.
fn positions_beside(own: usize) -> usize {
    let are_others = POSITIONS[0].abs_diff(own) as f64 >= OTHERS * own as f64;
    POSITIONS[usize::from(!are_others)]
}

/// Number of slices of the reference run for a run with `own` slices, and the factors of the differences to it.
fn slices_of_reference(scene: &Scene, own: usize, in_space: &PairInSpace) -> (usize, Extrapolation) {
    let more = in_space.slices_from((own + own.div_ceil(3)).max(LEAST_SLICES)).min(MOST_SLICES_IN_SPACE);
    if !is_finest_in_space(scene) {
        let count = match own {
            _ if scene.pair.overlap_ratio() >= WIDE_OVERLAP => more,
            ..LEAST_SLICES => in_space.slices_from(LEAST_SLICES),
            _ => own,
        };
        return (count.min(MOST_SLICES_IN_SPACE), Extrapolation::NONE);
    }
    let count = more;
    // At the upper limit fewer slices are compared with.
    let count = if count > own { count } else { own - own / 4 };
    let (m, n) = (count as f64, own as f64);
    let transmission_error = m.powi(2) / (m.powi(2) - n.powi(2)).abs();
    (count, Extrapolation { wear: m / (m - n).abs(), transmission_error })
}

/// Wear at the `points` of each slice as means over other slices of the same face width, mm.
fn over_slices(wear_mm: &[f64], points: usize, from: &Slices, to: &Slices) -> Vec<f64> {
    if from.count() == to.count() {
        return wear_mm.to_vec();
    }
    let mut means = vec![0.0; points * to.count()];
    for (own, mean) in means.chunks_exact_mut(points).enumerate() {
        let begins = own as f64 * to.slice_width_mm;
        for (other, slice) in wear_mm.chunks_exact(points).enumerate() {
            let other = other as f64 * from.slice_width_mm;
            let shared = (begins + to.slice_width_mm).min(other + from.slice_width_mm) - begins.max(other);
            if shared > 0.0 {
                let weight = shared / to.slice_width_mm;
                mean.iter_mut().zip(slice).for_each(|(mean, wear)| *mean += weight * wear);
            }
        }
    }
    means
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A check on the positions of the run itself would not see what their spacing does: they are a tenth off at least, whatever the run takes.
    #[test]
    fn ver_slices_are_verified_on_other_positions() {
        for own in 20..1000 {
            let other = positions_beside(own);
            assert!(10 * other.abs_diff(own) >= own, "{own}: {other}");
        }
        assert_eq!([100, 150, 200].map(positions_beside), [150, 120, 150]);
    }
}
