//! Loading positions of the mesh cycle, with the pairs in mesh at each.
//!
//! Positions divide A–E evenly, both ends included. Each represents the stretch of the path halfway to its neighbours,
//! cut where a pair enters or leaves the mesh, so that no stretch spans a jump of the load and sums over positions are
//! of second order in their distance.
//!
//! Where tip edges are followed into contact, positions go on before A and after E as far as pairs may touch there
//! ([`super::tip_contact`]); every pair within those bounds may carry load, and loads do not jump: stretches need no cut. Limit: edges of an internal pair may still touch where
//! the tip circles part; there load does jump, and sums are of first order.

use super::{LoadingPosition, PairInMesh};
use crate::contact::PositionCell;
use gearwear_bodies::gear::path_of_contact::PathOfContact;

/// Part of the base pitch within which two places of the path are the same.
const SAME_PLACE: f64 = 1e-9;

/// Positions `count` (≥ 2) in number from A to E; `teeth_n_per_mm2` gives the spring of the teeth at a position.
pub(crate) fn loading_positions<E>(
    path: &PathOfContact,
    count: usize,
    mut teeth_n_per_mm2: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Vec<LoadingPosition>, E> {
    let (start, end, pitch) = (path.start_mm, path.end_mm, path.base_pitch_mm);
    let changes = changes_of_pairs(path);
    // Places with the zone between changes that holds each; a place on a change belongs to the zone before it.
    let places: Vec<(f64, usize)> = (0..count)
        .map(|j| {
            let place = start + (end - start) * j as f64 / (count - 1) as f64;
            let zone = changes.partition_point(|&change| change < place - SAME_PLACE * pitch);
            (place, zone.clamp(1, changes.len() - 1))
        })
        .collect();
    let mut positions = Vec::with_capacity(count);
    let mut lower_mm = start;
    for (j, &(position_mm, zone)) in places.iter().enumerate() {
        let middle_of_zone = changes[zone - 1].midpoint(changes[zone]);
        let upper_mm = match places.get(j + 1) {
            None => end,
            Some(&(next, zone_of_next)) if zone_of_next == zone => position_mm.midpoint(next),
            // The stretch ends with the zone; a zone too short to hold a position goes to the one before it.
            Some(&(_, zone_of_next)) => changes[zone_of_next - 1],
        };
        let mut pairs = Vec::new();
        for offset in pairs_in_mesh(path, middle_of_zone) {
            let position_mm = position_mm + f64::from(offset) * pitch;
            let teeth_n_per_mm2 = teeth_n_per_mm2(position_mm)?;
            pairs.push(PairInMesh { position_mm, teeth_n_per_mm2, lever_ratio: 1.0 });
        }
        let cell = PositionCell { position_mm, lower_mm, upper_mm };
        positions.push(LoadingPosition { cell, pairs, on_line_of_action: true });
        lower_mm = upper_mm;
    }
    Ok(positions)
}

/// Positions as far apart as `count` (≥ 2) from A to E, these included, but beginning `beyond_mm` before A and ending as far
/// after E; `lever_ratio` gives [`PairInMesh::lever_ratio`].
pub fn positions_with_tip_contact<E>(
    path: &PathOfContact,
    count: usize,
    beyond_mm: [f64; 2],
    lever_ratio: impl Fn(f64) -> f64,
    mut teeth_n_per_mm2: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Vec<LoadingPosition>, E> {
    let (start, end, pitch) = (path.start_mm, path.end_mm, path.base_pitch_mm);
    let spacing = (end - start) / (count - 1) as f64;
    // Never beyond the bounds: the tangent frame ends with the base circles.
    let [before, after] = beyond_mm.map(|beyond| (beyond / spacing).floor() as usize);
    let (first, last) = (start - beyond_mm[0].max(SAME_PLACE * pitch), end + beyond_mm[1].max(SAME_PLACE * pitch));
    (0..before + count + after)
        .map(|j| {
            let position_mm = start + spacing * (j as f64 - before as f64);
            let ahead = ((last - position_mm) / pitch).floor() as i32;
            let behind = ((position_mm - first) / pitch).floor() as i32;
            let pairs = std::iter::once(0).chain((-behind..=ahead).filter(|&offset| offset != 0)).map(|offset| {
                let position_mm = position_mm + f64::from(offset) * pitch;
                let teeth_n_per_mm2 = teeth_n_per_mm2(position_mm)?;
                Ok(PairInMesh { position_mm, teeth_n_per_mm2, lever_ratio: lever_ratio(position_mm) })
            });
            let (lower_mm, upper_mm) = (position_mm - 0.5 * spacing, position_mm + 0.5 * spacing);
            Ok(LoadingPosition {
                cell: PositionCell { position_mm, lower_mm, upper_mm },
                pairs: pairs.collect::<Result<_, E>>()?,
                on_line_of_action: (before..before + count).contains(&j),
            })
        })
        .collect()
}

/// A, E and every place between them where another pair enters or leaves, in order.
fn changes_of_pairs(path: &PathOfContact) -> Vec<f64> {
    let (start, end, pitch) = (path.start_mm, path.end_mm, path.base_pitch_mm);
    let whole = path.contact_ratio().floor() as i32;
    let mut changes: Vec<f64> = (0..=whole)
        .flat_map(|k| [start + f64::from(k) * pitch, end - f64::from(k) * pitch])
        .filter(|&place| place >= start && place <= end)
        .collect();
    changes.sort_by(f64::total_cmp);
    changes.dedup_by(|a, b| (*a - *b).abs() <= 2.0 * SAME_PLACE * pitch);
    changes
}

/// Pairs in mesh with the reference pair at `position_mm`, by their distance in pitches; the reference pair, 0, comes first.
fn pairs_in_mesh(path: &PathOfContact, position_mm: f64) -> impl Iterator<Item = i32> {
    let ahead = ((path.end_mm - position_mm) / path.base_pitch_mm).floor() as i32;
    let behind = ((position_mm - path.start_mm) / path.base_pitch_mm).floor() as i32;
    std::iter::once(0).chain((-behind..=ahead).filter(|&offset| offset != 0))
}

#[cfg(test)]
mod tests {
    use super::*;
    use gearwear_bodies::gear::{PerGear, involute::Involute};

    fn path(contact_ratio: f64) -> PathOfContact {
        let involute = Involute { base_radius_mm: 50.0 };
        PathOfContact {
            line_of_action_mm: 60.0,
            base_pitch_mm: 10.0,
            start_mm: 5.0,
            pitch_point_mm: 20.0,
            end_mm: 5.0 + 10.0 * contact_ratio,
            involute: PerGear { pinion: involute, wheel: involute },
        }
    }

    /// With tip contact: the rows from A to E are the same places, stretches follow each other without gap, and every pair
    /// within the bounds is there.
    #[test]
    fn ver_positions_with_tip_contact_go_beyond_the_path() {
        for ratio in [1.0, 1.4375, 2.3] {
            let path = path(ratio);
            let plain = loading_positions(&path, 50, |_| Ok::<_, ()>(1.0)).unwrap();
            let beyond = positions_with_tip_contact(&path, 50, [0.9, 1.3], |_| 1.0, |_| Ok::<_, ()>(1.0)).unwrap();
            let rows: Vec<_> = beyond.iter().filter(|p| p.on_line_of_action).collect();
            assert_eq!(rows.len(), plain.len());
            for (row, plain) in rows.iter().zip(&plain) {
                assert!((row.cell.position_mm - plain.cell.position_mm).abs() < 1e-12);
                assert!(row.pairs.len() >= plain.pairs.len());
            }
            // As far as whole spacings fit, and not beyond.
            let spacing = 10.0 * ratio / 49.0;
            let before = path.start_mm - beyond[0].cell.position_mm;
            let after = beyond[beyond.len() - 1].cell.position_mm - path.end_mm;
            assert!(before <= 0.9 + 1e-12 && before > 0.9 - spacing, "{before}");
            assert!(after <= 1.3 + 1e-12 && after > 1.3 - spacing, "{after}");
            for two in beyond.windows(2) {
                assert!((two[0].cell.upper_mm - two[1].cell.lower_mm).abs() < 1e-12);
            }
            // ∫ pairs dξ over A–E: each of them is there for ε p_bt + 0.9 + 1.3.
            let pairs: f64 = rows.iter().map(|p| p.pairs.len() as f64 * spacing).sum();
            let commons = (-4..=4).map(|k| {
                let from = (path.start_mm - 0.9 + 10.0 * f64::from(k)).max(path.start_mm);
                ((path.end_mm + 1.3 + 10.0 * f64::from(k)).min(path.end_mm) - from).max(0.0)
            });
            let expected: f64 = commons.sum();
            assert!((pairs / expected - 1.0).abs() < 0.06, "{ratio}: {pairs} {expected}");
        }
    }

    /// The stretches cover A–E without gap or overlap, and the numbers of pairs weighted by them add up to the
    /// contact ratio: every pair is in mesh for ε p_bt.
    #[test]
    fn ver_stretches_cover_the_path_and_count_the_pairs() {
        for ratio in [1.0, 1.001, 1.4375, 1.999, 2.0, 2.3, 2.9, 3.0] {
            let path = path(ratio);
            for count in [2, 3, 17, 400] {
                let positions = loading_positions(&path, count, |_| Ok::<_, ()>(1.0)).unwrap();
                let mut reached = path.start_mm;
                for position in &positions {
                    assert!((position.cell.lower_mm - reached).abs() < 1e-7, "{ratio} {count}");
                    reached = position.cell.upper_mm;
                }
                if count < 17 {
                    continue;
                }
                assert!((reached - path.end_mm).abs() < 1e-7);
                let pairs: f64 =
                    positions.iter().map(|p| p.pairs.len() as f64 * (p.cell.upper_mm - p.cell.lower_mm)).sum();
                // ∫ pairs dξ over A–E = Σ over offsets of the common length.
                let expected: f64 = (-3..=3).map(|k: i32| (10.0 * ratio - 10.0 * f64::from(k.abs())).max(0.0)).sum();
                // A zone shorter than the distance of positions (at ε 1.001 and 1.999) may be lost to its neighbour.
                let lost = if ratio.fract() > 0.01 && ratio.fract() < 0.99 { 1e-6 } else { 4e-3 };
                assert!((pairs / expected - 1.0).abs() < lost, "{ratio} {count}: {pairs} {expected}");
            }
        }
    }
}
