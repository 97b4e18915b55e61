//! Partition of the friction heat between both bodies.
//!
//! Two surfaces that touch have one temperature. With T₁ and T₂ what each would rise by if it took all of the heat, and rises in
//! proportion to the heat, both are equally hot where
//!
//! ```text
//! δ₁ T₁ = δ₂ T₂,   δ₁ + δ₂ = 1        δ₁ = T₂/(T₁ + T₂)
//! ```
//!
//! Source: J. F. Archard and R. A. Rowntree, *Wear* 128 (1988) 1; the thesis, equation 29 (δ_theory).

use super::settings::HeatPartition;
use gearwear_bodies::gear::PerGear;

/// δ of both bodies, from the greatest rise that each would have with all of the heat.
pub(crate) fn shares(partition: HeatPartition, rise_with_all: PerGear<f64>) -> PerGear<f64> {
    let sum = rise_with_all.sum();
    match partition {
        HeatPartition::ArchardRowntree if sum > 0.0 => {
            PerGear { pinion: rise_with_all.wheel / sum, wheel: rise_with_all.pinion / sum }
        }
        _ => PerGear { pinion: 0.5, wheel: 0.5 },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Both get equally hot, and take all of the heat.
    #[test]
    fn ver_both_get_equally_hot() {
        let alone = PerGear { pinion: 30.0, wheel: 90.0 };
        let delta = shares(HeatPartition::ArchardRowntree, alone);
        assert!((delta.sum() - 1.0).abs() < 1e-15);
        assert!((delta.pinion * alone.pinion - delta.wheel * alone.wheel).abs() < 1e-12);
        assert_eq!(shares(HeatPartition::Equal, alone), PerGear { pinion: 0.5, wheel: 0.5 });
        assert_eq!(shares(HeatPartition::ArchardRowntree, PerGear::default()).sum(), 1.0);
    }
}
