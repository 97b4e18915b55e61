//! Uncertainties of the finite elements of a verification.

use crate::operation::HARDLY_WORN_BULGES;
use gearwear_bodies::gear::{Gear, GearPair};
use gearwear_bodies::gear_mesh::settings::{BodySettings, rounding_element_mm};

/// Relative uncertainties of a reference run.
pub(super) struct ReferenceUncertainty {
    pub profile: f64,
    pub peak: f64,
    pub tip_edge: f64,
    /// On new and on worn flanks.
    pub transmission_error: [f64; 2],
    pub pressure: f64,
    /// Greatest pressure between the tip-edge zones, on new and on worn flanks.
    pub flank_pressure: [f64; 2],
}

/// Uncertainty of plane finite elements. Contacts at tip edges are narrower than the elements are meshed for, and contain the end of the wear.
pub(super) const OF_ELEMENTS: ReferenceUncertainty = ReferenceUncertainty {
    profile: 0.006,
    peak: 0.006,
    tip_edge: 0.015,
    transmission_error: [0.005, 0.005],
    pressure: 0.02,
    flank_pressure: [0.01, 0.01],
};
/// Uncertainty of the wear of a hardly worn tip edge, per bulge of an element of its rounding beyond its chord, over the depth: a contact narrower than
/// the element is placed to within the length of the element.
const OF_BULGE: f64 = 0.01;
/// Uncertainty of the tip-edge wear above which the elements of roundings are refined: the depth is less than ten times the bulge.
pub(super) const HARDLY_WORN: f64 = OF_BULGE / HARDLY_WORN_BULGES;
/// Greatest uncertainty of the wear of a tip edge.
const MOST_OF_TIP_EDGE: f64 = 0.2;
/// Uncertainty of the first wear at a kink, to which pressure rises with the logarithm of the distance until wear has rounded it. With elements three to six times as short, the wear of four
/// flanks, external and internal, is higher by 11 to 17, 10, 3 to 5 and 0.3 % where it is 0.1, 0.2, 0.5 to 0.8 and 2 times as deep as an element of the length e bridges, θ e.
const OF_KINK: f64 = 0.15;
/// Uncertainty of profile and peak wear under severe wear: difference to elements twice as fine on nine of ten random pairs.
const SEVERE: f64 = 0.02;
/// Uncertainty of the transmission error on flanks that have worn severely: on 19 of 20 pairs elements twice as fine change it by less than 0.6 %, on one by some 2 %.
const TRANSMISSION_ERROR_OF_SEVERE: f64 = 0.01;

/// Uncertainty of the greatest pressure on worn flanks of an internal pair, which lies in a narrow maximum beside the tip-edge zones.
const WORN_INSIDE: f64 = 0.015;

impl ReferenceUncertainty {
    /// Uncertainty of an internal pair.
    pub(super) fn internal(self) -> Self {
        let [new, worn] = self.flank_pressure;
        Self { flank_pressure: [new, worn.max(WORN_INSIDE)], ..self }
    }

    /// Uncertainty under severe wear.
    pub(super) fn severe(self) -> Self {
        let Self { profile, peak, tip_edge, transmission_error: [new, worn], .. } = self;
        Self {
            profile: profile.max(SEVERE),
            peak: peak.max(SEVERE),
            tip_edge: tip_edge.max(SEVERE),
            transmission_error: [new, worn.max(TRANSMISSION_ERROR_OF_SEVERE)],
            ..self
        }
    }
}

/// Uncertainty by the length of the elements of the wear of a rounded tip edge that is `depth_mm` deep.
pub(super) fn of_hardly_worn_edge(pair: &GearPair, gear: Gear, bodies: &BodySettings, depth_mm: f64) -> f64 {
    let rounding_mm = pair.spec.tip_rounding_mm(gear);
    if rounding_mm <= 0.0 || depth_mm <= 0.0 {
        return 0.0;
    }
    let BodySettings { elements_per_half_width, rounding_refinement, .. } = *bodies;
    let element_mm = rounding_element_mm(rounding_mm, elements_per_half_width, rounding_refinement);
    let bulge_mm = element_mm.powi(2) / (8.0 * rounding_mm);
    (OF_BULGE * bulge_mm / depth_mm).min(MOST_OF_TIP_EDGE)
}

/// Uncertainty by the length of the elements of the wear at a kink of `angle_rad` that is `depth_mm` deep.
pub(super) fn of_hardly_worn_kink(angle_rad: f64, element_mm: f64, depth_mm: f64) -> f64 {
    OF_KINK * (1.0 - depth_mm / (angle_rad * element_mm)).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// An element of 0.02 mm bridges 0.2 µm of a kink of 0.01 rad: the first wear is uncertain by 15 %, that of 0.1 µm by half of that, and none that is deeper than 0.2 µm.
    #[test]
    fn ver_kinks_are_uncertain_until_wear_has_rounded_them() {
        let of_depth = |depth_um: f64| of_hardly_worn_kink(0.01, 0.02, 1e-3 * depth_um);
        assert!((of_depth(0.1) - 0.075).abs() < 1e-12);
        assert_eq!([0.0, 0.2, 2.0].map(of_depth), [0.15, 0.0, 0.0]);
    }
}
