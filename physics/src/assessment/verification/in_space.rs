//! The life that vouches for a run with slices: on elastic half-planes, tip edges followed, slices coupled by three-dimensional finite
//! elements of both gears ([`crate::mesh_cycle::pair_in_space`]), teeth as stiff as plane finite elements have them.
//!
//! A run that is of this kind itself is held against one on other slices, m in place of n: what is left of its error is that of the slices, for
//! positions, points and steps have estimates of their own. Loads gather in the last slices of a line of contact, so that wear converges with the
//! first order of their width, and the whole error is m/(m − n) times the difference (Richardson). At tip edges and below the start of active
//! profile it counts once: positions and points make it there, not slices. The transmission error is a sum over the slices and converges about
//! with the second order, m²/(m² − n²) times (docs/accuracy.md).

use super::{Beyond, Elements, Life, Means, Uncertainty, life as run_life};
use crate::assessment::Model;
use crate::calibration;
use crate::contact::{ContactSurface, half_space::HalfSpace};
use crate::gear::slices::Slices;
use crate::gear::{Gear, PerGear};
use crate::mesh_cycle::settings::{Coupling, MOST_SLICES_IN_SPACE, SliceSettings};
use crate::mesh_cycle::slice_coupling::SliceCompliance;
use crate::mesh_cycle::sliced_teeth::SlicedTeeth;
use crate::observer::Observer;
use crate::plan::is_finest_in_space;
use crate::simulation::mesh_contact::MeshContact;
use crate::simulation::wear_run::Outcome;
use crate::stiffness::settings::StiffnessSettings;
use crate::stiffness::{StiffnessError, TeethSpring, curve::PairCompliance};

/// Positions from A to E.
const POSITIONS: usize = 200;
/// Fewest slices: with fewer the loads at the ends of the lines of contact are lost.
const LEAST_SLICES: usize = 20;
/// Of half-planes in place of finite elements, whose teeth end, and of elements and slices (docs/accuracy.md): no less than what severe wear asks for.
const OF_HALF_PLANES: Uncertainty = Uncertainty {
    profile: 0.03,
    peak: 0.02,
    tip_edge: 0.06,
    transmission_error: 0.01,
    pressure: 0.03,
    flank_pressure: [0.03, 0.03],
};

/// The life in space; where it does not come to its end, why.
pub(super) fn life(
    model: &Model<'_>,
    outcome: &Outcome,
    means: Means<'_, '_>,
    observer: &dyn Observer,
) -> Result<Life, String> {
    let Model { scene, pair, .. } = *model;
    let in_space = match means.in_space {
        Some(Ok(teeth)) => teeth,
        Some(Err(error)) => return Err(error.to_string()),
        None => return Err("there are no three-dimensional teeth".to_owned()),
    };
    let own_curve;
    let curve: &PairCompliance = match (means.curve, means.elements) {
        (Some(curve), _) => curve,
        (None, Some(Ok(Elements { condensed, line_load_n_per_mm, .. }))) => {
            let curve = calibration::pair_compliance(&condensed, &scene.material, line_load_n_per_mm);
            own_curve = curve.map_err(|error| error.to_string())?;
            &own_curve
        }
        (None, Some(Err(error))) => return Err(error.to_string()),
        (None, None) => return Err("there are no plane finite elements".to_owned()),
    };
    let own = outcome.slices.count();
    let (count, beyond) = if is_finest_in_space(scene) {
        let count = in_space.slices_from((own + own.div_ceil(3)).max(LEAST_SLICES)).min(MOST_SLICES_IN_SPACE);
        // As many are no other slices: then fewer of them tell.
        let count = if count > own { count } else { own - own / 4 };
        let (m, n) = (count as f64, own as f64);
        let beyond = Beyond { wear: m / (m - n).abs(), transmission_error: m.powi(2) / (m.powi(2) - n.powi(2)).abs() };
        (count, beyond)
    } else {
        let count = if own < LEAST_SLICES { in_space.slices_from(LEAST_SLICES) } else { own };
        (count.min(MOST_SLICES_IN_SPACE), Beyond::NONE)
    };
    let settings = SliceSettings { count, coupling: Coupling::Fem };
    let unread = SliceCompliance::of_plates(pair, &scene.material, true);
    let sliced = SlicedTeeth::new(pair, &scene.material, settings, unread, Some(in_space));
    let loads = || model.phases.iter().map(|phase| phase.line_load_n_per_mm);
    let half_plane = |expected_line_load_n_per_mm| HalfSpace { material: scene.material, expected_line_load_n_per_mm };
    let surfaces: Vec<HalfSpace> = loads().map(half_plane).collect();
    let spring =
        |(surface, load)| TeethSpring::new(StiffnessSettings::Fem, Some(curve), pair, &scene.material, surface, load);
    let teeth: Vec<TeethSpring<'_>> = surfaces
        .iter()
        .map(|surface| surface as &dyn ContactSurface)
        .zip(loads())
        .map(spring)
        .collect::<Result<_, StiffnessError>>()
        .map_err(|error| error.to_string())?;
    let contact =
        |(surface, teeth)| MeshContact::LineOfAction { surface, teeth, tip_contact: true, sliced: Some(&sliced) };
    let contacts = surfaces.iter().map(|surface| surface as _).zip(&teeth).map(contact).collect();
    let life = run_life(model, outcome, contacts, POSITIONS, observer)?;
    let wear_mm = PerGear::from_fn(|gear: Gear| {
        let points = outcome.grid[gear].len();
        over_slices(&life.worn.wear_mm[gear], points, &life.slices, &outcome.slices)
    });
    let counts = match is_finest_in_space(scene) {
        true => format!(
            ", to which differences of the active profile count {:.1} times, for wear converges with the width of the slices, and of the \
             transmission error {:.1} times, for it converges with its square",
            beyond.wear, beyond.transmission_error
        ),
        false => String::new(),
    };
    let on = format!("elastic half-planes in {count} slices, coupled by three-dimensional finite elements{counts}");
    Ok(Life { outcome: life, own: OF_HALF_PLANES, bodies: None, beyond, wear_mm, on })
}

/// What so many `points` of slices have lost, as means over other slices of the same face width.
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
