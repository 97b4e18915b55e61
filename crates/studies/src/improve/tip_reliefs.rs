//! Free keys of a scene that names none: amount and length of the tip relief of both gears, with ranges that follow from load and path of contact.

use gearwear::evaluate::output::SummaryOutput;
use gearwear_physics::observer::Observer;

use super::asked::ImproveError;
use super::fast_model::FastModel;
use super::free_key::{FreeKey, FreeKeyError};

/// Tolerances of a tip relief of a scene that names no free keys, µm and mm.
const RELIEF_TOLERANCES: [f64; 2] = [3.0, 0.2];
/// Greatest tip relief of such a scene over the greatest approach of the new pair.
const RELIEF_OVER_APPROACH: f64 = 2.0;
/// Ends of its length over the part of the path with two pairs in contact: the longest begins where contact of a single pair ends.
const RELIEF_LENGTHS: [f64; 2] = [0.25, 1.0];

/// Keys of the scene of `fast`.
///
/// # Errors
/// A scene that cannot be run, an interrupt.
pub fn of(fast: &FastModel, observer: &dyn Observer) -> Result<Vec<FreeKey>, ImproveError> {
    let paths = ["new.transmission_error_um.max", "geometry.transverse_contact_ratio", "geometry.base_pitch_mm"];
    let outputs: Vec<SummaryOutput> = paths.iter().filter_map(|path| SummaryOutput::find(path).ok()).collect();
    let figures = fast.figures([], &outputs, observer).ok_or(ImproveError::Interrupted)?;
    let figures = figures.map_err(ImproveError::Base)?;
    let &[Some(approach_um), Some(contact_ratio), Some(base_pitch_mm)] = figures.as_slice() else {
        return Err(ImproveError::Base("it has no transmission error".to_owned()));
    };
    let greatest_um = 10.0 * (RELIEF_OVER_APPROACH * approach_um / 10.0).ceil();
    let two_pairs_mm = (contact_ratio - 1.0).clamp(0.1, 1.0) * base_pitch_mm;
    let [least_mm, greatest_mm] = RELIEF_LENGTHS.map(|share| (10.0 * share * two_pairs_mm).ceil() / 10.0);
    let [amount, length] = RELIEF_TOLERANCES;
    let of_gear = |gear: &str| {
        [
            format!("pair.{gear}.tip_relief.amount_um = 0:{greatest_um} ± {amount}"),
            format!("pair.{gear}.tip_relief.length_mm = {least_mm}:{greatest_mm} ± {length}"),
        ]
    };
    let given = ["pinion", "wheel"].into_iter().flat_map(of_gear);
    given.map(|text| text.parse().map_err(|error: FreeKeyError| ImproveError::Base(error.to_string()))).collect()
}
