//! Contact before A and after E that a run leaves out.
//!
//! Under load the gears approach each other by the transmission error δ, of which the bodies that all pairs share take δ_b. Just before A the
//! next pair is apart by g, the tip rounding of the wheel, relief and wear of both flanks where they would touch. Where
//!
//! ```text
//! u = δ − δ_b − g > 0
//! ```
//!
//! it touches before A in truth, at the tip edge of the wheel, and a model whose contact begins at A lets it come in overlapping by u; likewise
//! after E, at the tip edge of the pinion. Of a pair with slices each slice comes in by itself; that slices of one tooth pull each other along is
//! not reckoned with. The same holds at the end of any range in which tip edges are followed: there u > 0 says that the range is too short.
//!
//! Source: R. G. Munro, L. Morrish and D. Palmer, *Proc. Inst. Mech. Eng. C* 213 (1999) 389–400, for the phenomenon.

use super::wear_run::Outcome;
use crate::mesh_cycle::wearing_pair::Snapshot;
use gearwear_bodies::gear::flank_edge::PathEnd;
use gearwear_bodies::gear::{Gear, GearPair, removed_material};

/// Distances along the path are compared to this part of the base pitch.
const SAME_PLACE: f64 = 1e-9;

/// By how much the flanks overlap where a pair comes in `range_mm` before A, and where one leaves as far after E; negative where they are
/// apart. Of slices, the greatest. `bodies_mm` is δ_b.
pub fn overlaps_mm(
    pair: &GearPair,
    outcome: &Outcome,
    state: &Snapshot,
    bodies_mm: f64,
    range_mm: [f64; 2],
) -> [f64; 2] {
    let path = &pair.path;
    let (pitch, same) = (path.base_pitch_mm, SAME_PLACE * path.base_pitch_mm);
    let positions = &state.cycle.positions;
    let on_path =
        || positions.iter().filter(|at| (path.start_mm - same..=path.end_mm + same).contains(&at.position_mm));
    // A place belongs to the stretch before it, in which the pair that comes in there does not touch yet.
    let before = |place: f64| on_path().rfind(|at| at.position_mm <= place + same);
    let after = |place: f64| on_path().find(|at| at.position_mm > place + same);
    let of_slice = |slice: usize| {
        let ahead_mm = outcome.slices.ahead_mm[slice];
        // The reference tooth in the middle of the face width, while the slice of another tooth comes in or leaves; a base pitch repeats itself.
        let coming_in = path.start_mm + pitch - (range_mm[0] + ahead_mm).rem_euclid(pitch);
        let leaving = path.end_mm - pitch + (range_mm[1] - ahead_mm).rem_euclid(pitch);
        let ends_mm = [path.start_mm - range_mm[0], path.end_mm + range_mm[1]];
        [(PathEnd::Start, ends_mm[0], before(coming_in)), (PathEnd::End, ends_mm[1], after(leaving))].map(
            |(end, end_mm, observed)| {
                let error_mm = observed.map_or(f64::NEG_INFINITY, |at| at.transmission_error_mm);
                error_mm - bodies_mm - separation_mm(pair, outcome, state, slice, end, end_mm)
            },
        )
    };
    (0..outcome.slices.count())
        .map(of_slice)
        .fold([f64::NEG_INFINITY; 2], |most, of| [most[0].max(of[0]), most[1].max(of[1])])
}

/// Distance of the flanks of a slice with the theoretical contact point at an end of the path, mm.
fn separation_mm(pair: &GearPair, outcome: &Outcome, state: &Snapshot, slice: usize, end: PathEnd, end_mm: f64) -> f64 {
    let touch = pair.touch(end_mm);
    let edge = pair.edge(end);
    let rho = |gear: Gear| if gear == edge.gear { edge.rho_mm } else { touch.rho_mm[gear] };
    let removed: f64 = Gear::BOTH
        .into_iter()
        .map(|gear| {
            let grid = &outcome.grid[gear];
            let wear = &state.wear_mm[gear][slice * grid.len()..(slice + 1) * grid.len()];
            let width_mm = outcome.slices.width_mm[slice];
            removed_material::without_tip_edge_mm(pair, gear, width_mm, rho(gear))
                + pair.obliquity().transverse_mm(grid.value_at(wear, rho(gear)))
        })
        .sum();
    touch.gap_mm + removed
}
