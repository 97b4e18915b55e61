//! Movement of the pressure along flanks with kinks.
//!
//! While the theoretical contact point passes a stretch of path, the contact moves along both flanks, and its pressure with it. Where a linear relief
//! begins, a flank has a kink, to which the pressure rises with the logarithm of the distance s, and that peak stays on the kink. There the pressure moves
//! over the flank with the kink by the part
//!
//! ```text
//! m(s) = min(1, s/a)
//! ```
//!
//! of the contact's movement, a: its half-width, and over the mate, where the contact moves the opposite way, by the rest more: at the kink the pressure
//! slides over it. Were it carried along with the contact, the peak would be spread over the stretch between two positions, and the ridge that it leaves
//! too low by an error of first order in their distance.

use crate::gear::{Gear, PerGear};

/// Movement of the pressure along both flanks at the places `at_mm`, where the contact moves by `contact_mm` to the beginning and to the end of a
/// stretch, each towards the gear's tip, and is `half_width_mm` wide to either side. A contact that stands on an edge keeps its own. Places and kinks
/// are counted from the root ends along the profiles.
pub(super) fn pressure_moves_mm(
    contact_mm: PerGear<[f64; 2]>,
    kinks_mm: PerGear<&[f64]>,
    at_mm: PerGear<f64>,
    half_width_mm: f64,
) -> PerGear<[f64; 2]> {
    let from_kinks = Gear::BOTH.into_iter().flat_map(|gear| {
        kinks_mm[gear].iter().map(move |kink_mm| (gear, (at_mm[gear] - kink_mm).abs() / half_width_mm))
    });
    let nearest = from_kinks.min_by(|a, b| a.1.total_cmp(&b.1));
    let stands = Gear::BOTH.into_iter().any(|gear| contact_mm[gear] == [0.0, 0.0]);
    let Some((gear, part)) = nearest.filter(|(_, part)| *part < 1.0 && !stands) else { return contact_mm };
    let held_mm = contact_mm[gear].map(|moved_mm| (1.0 - part) * moved_mm);
    let mut moves_mm = contact_mm;
    for (end, held_mm) in held_mm.into_iter().enumerate() {
        moves_mm[gear][end] -= held_mm;
        moves_mm[gear.mate()][end] += held_mm;
    }
    moves_mm
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pressure stays on a kink of either flank, slides over the mate there, moves with the contact a half-width away and by half in between; a contact
    /// on an edge moves as it does.
    #[test]
    fn ver_the_pressure_stays_on_a_kink() {
        let contact_mm = PerGear { pinion: [-0.2, 0.2], wheel: [0.3, -0.3] };
        let kinks_mm = PerGear { pinion: &[4.0][..], wheel: &[7.0][..] };
        let at = |pinion: f64, wheel: f64| pressure_moves_mm(contact_mm, kinks_mm, PerGear { pinion, wheel }, 0.5);
        let assert_moves = |found: PerGear<[f64; 2]>, ends: [f64; 2]| {
            for (gear, end) in [(Gear::Pinion, ends[0]), (Gear::Wheel, ends[1])] {
                assert!(
                    (found[gear][1] - end).abs() < 1e-12 && found[gear][0] == -found[gear][1],
                    "{gear:?} {found:?}"
                );
            }
        };
        assert_moves(at(4.0, 5.0), [0.0, -0.1]);
        assert_moves(at(3.75, 5.0), [0.1, -0.2]);
        assert_moves(at(5.0, 7.0), [-0.1, 0.0]);
        assert_moves(at(4.1, 7.05), [-0.07, -0.03]);
        assert_moves(at(4.5, 6.5), [0.2, -0.3]);
        let on_edge = PerGear { wheel: [0.0, 0.0], ..contact_mm };
        assert_eq!(pressure_moves_mm(on_edge, kinks_mm, PerGear { pinion: 4.0, wheel: 5.0 }, 0.5), on_edge);
    }
}
