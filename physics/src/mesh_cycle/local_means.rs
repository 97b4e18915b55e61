//! Rows of depths as a contact sees them: averaged along the flank.
//!
//! A depth at a single point or node is a matter of the resolution: at a fine tip edge nodes are micrometres apart, and severe wear passes from one to
//! the next in bursts. The mean of their magnitudes over half the length over which pressures are averaged is not.

use crate::wear::stepping::greater_or_nan;
use gearwear_bodies::gear::{Gear, PerGear, flank_zones::FlankZones};

/// Length of the means, in that over which pressures are averaged. With the whole of it the wear of tip edges is less exact than a verification needs
/// (case `verified-lean`).
const LENGTH: f64 = 0.5;

/// Places of both flanks, and the length over which depths at them are averaged.
pub(crate) struct LocalMeans {
    flanks: PerGear<FlankPlaces>,
}

struct FlankPlaces {
    /// Distance of each place along the flank, mm.
    along_mm: Vec<f64>,
    /// Length of flank that each place represents, mm.
    share_mm: Vec<f64>,
    /// Length of the means, mm.
    length_mm: f64,
}

impl LocalMeans {
    /// Means over half of [`FlankZones::pressure_length_mm`] of depths at places with these distances along the flanks, and the shares of the flanks that each
    /// represents, mm.
    pub(crate) fn new(places: PerGear<(Vec<f64>, Vec<f64>)>, zones: &PerGear<FlankZones>) -> Self {
        let flank = |(along_mm, share_mm), zones: &FlankZones| FlankPlaces {
            along_mm,
            share_mm,
            length_mm: LENGTH * zones.pressure_length_mm,
        };
        let PerGear { pinion, wheel } = places;
        Self { flanks: PerGear { pinion: flank(pinion, &zones.pinion), wheel: flank(wheel, &zones.wheel) } }
    }

    /// Greatest mean magnitude of `rows`, mm: depths at the places of each flank, slice after slice.
    pub(crate) fn greatest_mm(&self, rows: PerGear<&[f64]>) -> f64 {
        let of = |flank: &FlankPlaces, row: &[f64]| {
            let slices = row.chunks(flank.along_mm.len()).map(|slice| flank.greatest_mm(slice));
            slices.fold(0.0, greater_or_nan)
        };
        greater_or_nan(of(&self.flanks.pinion, rows.pinion), of(&self.flanks.wheel, rows.wheel))
    }

    /// Mean of depths at the places of a gear's flank, slice after slice, about one of them, mm.
    pub(crate) fn about_mm(&self, gear: Gear, place: usize, row: &[f64]) -> f64 {
        let FlankPlaces { along_mm, share_mm, length_mm } = &self.flanks[gear];
        let (slice, here) = (place / along_mm.len(), place % along_mm.len());
        let row = &row[slice * along_mm.len()..][..along_mm.len()];
        let is_near = |at_mm: f64| (at_mm - along_mm[here]).abs() <= 0.5 * length_mm;
        let near = along_mm.iter().zip(share_mm.iter().zip(row)).filter(|(at_mm, _)| is_near(**at_mm));
        let (sum_mm2, long_mm) = near.fold((0.0, 0.0), |(sum_mm2, long_mm), (_, (share_mm, depth_mm))| {
            (sum_mm2 + share_mm * depth_mm, long_mm + share_mm)
        });
        sum_mm2 / long_mm
    }
}

impl FlankPlaces {
    /// Greatest mean magnitude about a place; where places are farther apart than the length, that of a depth.
    fn greatest_mm(&self, depth_mm: &[f64]) -> f64 {
        let Self { along_mm, share_mm, length_mm } = self;
        let (mut from, mut to, mut area_mm2, mut long_mm) = (0, 0, 0.0, 0.0);
        let mut greatest = 0.0;
        for here_mm in along_mm {
            while to < along_mm.len() && along_mm[to] <= here_mm + 0.5 * length_mm {
                area_mm2 += share_mm[to] * depth_mm[to].abs();
                long_mm += share_mm[to];
                to += 1;
            }
            while along_mm[from] < here_mm - 0.5 * length_mm {
                area_mm2 -= share_mm[from] * depth_mm[from].abs();
                long_mm -= share_mm[from];
                from += 1;
            }
            greatest = greater_or_nan(greatest, area_mm2 / long_mm);
        }
        greatest
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn evenly(apart_mm: f64, length_mm: f64) -> FlankPlaces {
        let along_mm: Vec<f64> = (0..21).map(|k| apart_mm * f64::from(k)).collect();
        let share_mm = (0..21).map(|k| if k % 20 == 0 { 0.5 * apart_mm } else { apart_mm }).collect();
        FlankPlaces { along_mm, share_mm, length_mm }
    }

    #[test]
    fn single_places_count_by_the_length_they_represent() {
        let mut row = vec![0.0; 21];
        row[7] = -3.0;
        let close = evenly(0.01, 0.041).greatest_mm(&row);
        assert!((close - 3.0 / 5.0).abs() < 1e-12, "{close}");
        assert_eq!(evenly(0.03, 0.041).greatest_mm(&row), 3.0);
        assert!((evenly(0.01, 0.041).greatest_mm(&[2.0; 21]) - 2.0).abs() < 1e-12);
        let waves: Vec<f64> = (0..42).map(|k| f64::from(k / 21) + if k % 2 == 0 { 1.0 } else { -1.0 }).collect();
        for (place, mean) in [(7, -0.2), (28, 1.2)] {
            let flanks = PerGear { pinion: evenly(0.01, 0.041), wheel: evenly(0.03, 0.041) };
            let means = LocalMeans { flanks };
            assert!((means.about_mm(Gear::Pinion, place, &waves) - mean).abs() < 1e-12, "{place}");
            assert_eq!(means.about_mm(Gear::Wheel, place, &waves), waves[place]);
        }
        row[20] = f64::NAN;
        assert!(evenly(0.03, 0.041).greatest_mm(&row).is_nan());
    }
}
