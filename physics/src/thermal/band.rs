//! The strip of a contact as a band of heat: rise of the temperature of both surfaces, at the hottest place or point by point.

use super::heat_equation::{CELLS, Passage};
use super::peclet::peclet;
use super::settings::{HeatVelocity, TemperatureMethod, ThermalMaterial};
use super::{ContactHeat, HeatedStrip, enters_at_tip_side, partition, tian_kennedy, williams};
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::reference::linear_means::value_at;

/// Distribution of the heat over the strip.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spread {
    /// Even flux.
    Even,
    /// Hertz's ellipse.
    Ellipse,
}

/// Heat of one body.
#[derive(Debug, Clone, Copy, PartialEq)]
struct HeatedBody {
    /// δ q̄, N/(mm·s).
    flux: f64,
    /// U, mm/s.
    velocity_mm_per_s: f64,
    material: ThermalMaterial,
}

/// The heated strip of a contact.
#[derive(Debug, Clone, Copy)]
pub struct HeatedBand<'a> {
    method: TemperatureMethod,
    /// a, mm.
    half_width_mm: f64,
    bodies: PerGear<HeatedBody>,
    passage: &'a Passage,
}

impl<'a> HeatedBand<'a> {
    /// The strip of a contact under a line load; without load, width or sliding there is no heat.
    pub(super) fn new(heat: &'a ContactHeat, method: TemperatureMethod, strip: &HeatedStrip) -> Self {
        let HeatedStrip { ratios, line_load_n_per_mm, half_width_mm, friction_coefficient } = *strip;
        let (settings, speed) = (&heat.settings, heat.speed_mm_per_s);
        let sliding = heat.sliding_speed_mm_per_s(&ratios);
        let warm = line_load_n_per_mm > 0.0 && half_width_mm > 0.0 && sliding > 0.0;
        let mean_pressure_mpa = if warm { line_load_n_per_mm / (2.0 * half_width_mm) } else { 0.0 };
        let flux = friction_coefficient * mean_pressure_mpa * sliding;
        let with_all = PerGear::from_fn(|gear| HeatedBody {
            flux,
            velocity_mm_per_s: match settings.velocity {
                HeatVelocity::Sliding => sliding,
                HeatVelocity::Surface => speed * ratios.rolling[gear],
            },
            material: settings.material[gear],
        });
        let mut band = Self { method, half_width_mm, bodies: with_all, passage: &heat.passage };
        let even = PerGear::from_fn(|gear| band.greatest_rise_k(gear, Spread::Even));
        let shares = partition::shares(settings.partition, even);
        for gear in Gear::BOTH {
            band.bodies[gear].flux *= shares[gear];
        }
        band
    }

    /// Pe of a gear's surface.
    pub fn peclet(&self, gear: Gear) -> f64 {
        let body = &self.bodies[gear];
        peclet(self.half_width_mm, body.velocity_mm_per_s, body.material.diffusivity_mm2_per_s)
    }

    /// Greatest rise of a gear's surface, K.
    pub fn greatest_rise_k(&self, gear: Gear, spread: Spread) -> f64 {
        let HeatedBody { flux, velocity_mm_per_s, material } = &self.bodies[gear];
        if *flux <= 0.0 {
            return 0.0;
        }
        match (self.method, spread) {
            (TemperatureMethod::TianKennedy, _) => {
                tian_kennedy::greatest_rise_k(*flux, self.half_width_mm, *velocity_mm_per_s, material)
            }
            (TemperatureMethod::HeatEquation, Spread::Ellipse) => {
                self.rise_per_passage_k(gear) * self.passage.greatest_of_ellipse()
            }
            // Under an even flux the heat equation is Williams's closed form.
            (TemperatureMethod::Williams, _) | (TemperatureMethod::HeatEquation, Spread::Even) => {
                williams::rise_k(*flux, 2.0 * self.half_width_mm, *velocity_mm_per_s, material)
            }
        }
    }

    /// δ q̄ √(κ t₀)/K with t₀ = 2a/U, K.
    fn rise_per_passage_k(&self, gear: Gear) -> f64 {
        let HeatedBody { flux, velocity_mm_per_s, material } = &self.bodies[gear];
        let passage_s = 2.0 * self.half_width_mm / velocity_mm_per_s;
        flux / material.conductivity_n_per_s_k * (material.diffusivity_mm2_per_s * passage_s).sqrt()
    }

    /// Fills `rise_k` with the rise of `gear`'s surface, K, at consecutive points of its flank, from root to tip at `along_mm`, under
    /// `pressure_mpa`. The strip is as wide as the band and lies around the centre of the pressure.
    pub(crate) fn rises_k(&self, gear: Gear, along_mm: &[f64], pressure_mpa: &[f64], rise_k: &mut [f64]) {
        rise_k.fill(0.0);
        let HeatedBody { flux, velocity_mm_per_s, material } = &self.bodies[gear];
        let width = 2.0 * self.half_width_mm;
        let backwards = enters_at_tip_side(gear);
        let Some(strip) = PointsInBand::under(along_mm, pressure_mpa, width, backwards).filter(|_| *flux > 0.0) else {
            return;
        };
        let heated = rise_k.iter_mut().enumerate().zip(pressure_mpa).filter(|(_, pressure)| **pressure > 0.0);
        match self.method {
            TemperatureMethod::TianKennedy => {
                let greatest = tian_kennedy::greatest_rise_k(*flux, self.half_width_mm, *velocity_mm_per_s, material);
                heated.for_each(|((_, rise), _)| *rise = greatest);
            }
            TemperatureMethod::Williams => {
                for ((k, rise), _) in heated {
                    *rise = williams::rise_k(*flux, strip.passed(k) * width, *velocity_mm_per_s, material);
                }
            }
            TemperatureMethod::HeatEquation => {
                let at_ends = self.passage.rises(&strip.cells(pressure_mpa));
                let scale = self.rise_per_passage_k(gear);
                for ((k, rise), _) in heated {
                    let place = strip.passed(k) * CELLS as f64;
                    let cell = (place as usize).min(CELLS - 1);
                    let before = if cell > 0 { at_ends[cell - 1] } else { 0.0 };
                    *rise = scale * (before + (place - cell as f64) * (at_ends[cell] - before));
                }
            }
        }
    }
}

/// A row of points in the strip of the contact.
#[derive(Debug, Clone, Copy)]
struct PointsInBand<'a> {
    /// Places of the points.
    along_mm: &'a [f64],
    /// Middle of the strip.
    centre_mm: f64,
    width_mm: f64,
    /// Whether material enters at the end of the row.
    backwards: bool,
}

impl<'a> PointsInBand<'a> {
    /// A strip around the centre of the pressure on a row; none without pressure.
    fn under(along_mm: &'a [f64], pressure_mpa: &[f64], width_mm: f64, backwards: bool) -> Option<Self> {
        let last = along_mm.len() - 1;
        let (mut sum, mut moment) = (0.0, 0.0);
        for (k, (at, pressure)) in along_mm.iter().zip(pressure_mpa).enumerate() {
            let part = if last == 0 { 1.0 } else { part_mm(along_mm, k) };
            sum += part * pressure;
            moment += part * pressure * (at - along_mm[0]);
        }
        (sum > 0.0).then(|| Self { along_mm, centre_mm: along_mm[0] + moment / sum, width_mm, backwards })
    }

    /// Part of the strip that point k has passed: 0 before it, 1 behind it.
    fn passed(&self, k: usize) -> f64 {
        let from_centre = (self.along_mm[k] - self.centre_mm) / self.width_mm;
        (0.5 + if self.backwards { -from_centre } else { from_centre }).clamp(0.0, 1.0)
    }

    /// Pressure in the middle of every cell of the passage over the mean of all: linear between the points, constant beyond the ends of the row.
    fn cells(&self, pressure_mpa: &[f64]) -> [f64; CELLS] {
        let cells: [f64; CELLS] = std::array::from_fn(|cell| {
            let from_inlet = (cell as f64 + 0.5) / CELLS as f64;
            let from_start = if self.backwards { 1.0 - from_inlet } else { from_inlet };
            let place_mm = self.centre_mm + (from_start - 0.5) * self.width_mm;
            match pressure_mpa {
                [alone] => *alone,
                row => value_at(self.along_mm, row, place_mm),
            }
        });
        let mean = cells.iter().sum::<f64>() / CELLS as f64;
        if mean > 0.0 { cells.map(|pressure| pressure / mean) } else { [1.0; CELLS] }
    }
}

/// Distance from the point before to the point after the k-th of a row, which goes on beyond its ends as at them.
fn part_mm(along_mm: &[f64], k: usize) -> f64 {
    let last = along_mm.len() - 1;
    let before = if k > 0 { along_mm[k] - along_mm[k - 1] } else { along_mm[1] - along_mm[0] };
    let after = if k < last { along_mm[k + 1] - along_mm[k] } else { along_mm[last] - along_mm[last - 1] };
    before + after
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::thermal::SpeedRatios;
    use crate::thermal::settings::{HeatPartition, HeatSettings};

    fn heat(method: TemperatureMethod, velocity: HeatVelocity) -> ContactHeat {
        let steel = ThermalMaterial { conductivity_n_per_s_k: 46.0, diffusivity_mm2_per_s: 12.0 };
        let settings = HeatSettings {
            method,
            velocity,
            partition: HeatPartition::ArchardRowntree,
            friction_coefficient: None,
            bulk_temperature_k: 363.15,
            is_bulk_of_mesh: false,
            tooth: None,
            material: PerGear { pinion: steel, wheel: steel },
        };
        ContactHeat::new(settings, 531.4)
    }

    const STRIP: HeatedStrip = HeatedStrip {
        ratios: SpeedRatios { sliding: 0.468, rolling: PerGear { pinion: 0.132, wheel: 0.600 } },
        line_load_n_per_mm: 212.6,
        half_width_mm: 0.0966,
        friction_coefficient: 0.1,
    };

    /// Hertz's ellipse and an even strip point by point: greatest values as those of the whole strip.
    #[test]
    fn ver_rows_reach_the_greatest_rise() {
        for method in [TemperatureMethod::HeatEquation, TemperatureMethod::Williams, TemperatureMethod::TianKennedy] {
            let heat = heat(method, HeatVelocity::Surface);
            let band = heat.band(&STRIP);
            let mut row = vec![0.0; 204];
            let mut rise = vec![-1.0; 204];
            for spread in [Spread::Even, Spread::Ellipse] {
                for (k, pressure) in row[2..202].iter_mut().enumerate() {
                    let x: f64 = (k as f64 + 0.5) / 100.0 - 1.0;
                    *pressure = if spread == Spread::Even { 1.0 } else { (1.0 - x * x).sqrt() };
                }
                for gear in Gear::BOTH {
                    let along_mm: Vec<f64> = (0..204).map(|k| f64::from(k) * 2.0 * 0.0966 / 200.0).collect();
                    band.rises_k(gear, &along_mm, &row, &mut rise);
                    let (greatest, expected) =
                        (rise.iter().copied().fold(0.0, f64::max), band.greatest_rise_k(gear, spread));
                    assert!((greatest / expected - 1.0).abs() < 4e-3, "{method:?} {spread:?} {greatest} {expected}");
                    assert!(rise[..2].iter().chain(&rise[202..]).all(|&rise| rise == 0.0));
                    // Hotter where material leaves: at the pinion's root side, at the wheel's tip side.
                    let (root, tip) = (rise[12], rise[191]);
                    let (hot, cool) = if gear == Gear::Pinion { (root, tip) } else { (tip, root) };
                    assert!(hot > cool || method == TemperatureMethod::TianKennedy);
                }
            }
        }
    }

    /// Points that are twice as far apart on one side of the contact as on the other find the same strip as even ones.
    #[test]
    fn ver_uneven_rows_feel_the_same_strip() {
        let heat = heat(TemperatureMethod::HeatEquation, HeatVelocity::Surface);
        let band = heat.band(&STRIP);
        let half = STRIP.half_width_mm;
        let even: Vec<f64> = (0..=400).map(|k| 1.2 * half * (f64::from(k) / 200.0 - 1.0)).collect();
        let uneven: Vec<f64> =
            even.iter().enumerate().filter(|(k, at)| **at >= 0.0 || k % 2 == 0).map(|(_, at)| *at).collect();
        let [rises, others] = [&even, &uneven].map(|along_mm| {
            let row: Vec<f64> = along_mm.iter().map(|along| (1.0 - (along / half).powi(2)).max(0.0).sqrt()).collect();
            let mut rise = vec![0.0; row.len()];
            band.rises_k(Gear::Wheel, along_mm, &row, &mut rise);
            [-0.6, -0.3, 0.0, 0.3, 0.6].map(|at| value_at(along_mm, &rise, at * half))
        });
        for (one, other) in rises.iter().zip(others) {
            assert!((one / other - 1.0).abs() < 5e-3, "{one} {other}");
        }
    }

    /// Both surfaces equally hot; no heat without sliding; few points heat as many.
    #[test]
    fn ver_both_surfaces_are_equally_hot() {
        let heat = heat(TemperatureMethod::Williams, HeatVelocity::Surface);
        let band = heat.band(&STRIP);
        let [pinion, wheel] = Gear::BOTH.map(|gear| band.greatest_rise_k(gear, Spread::Even));
        assert!((pinion / wheel - 1.0).abs() < 1e-12 && pinion > 1.0);
        let still = heat.band(&HeatedStrip { ratios: SpeedRatios { sliding: 0.0, ..STRIP.ratios }, ..STRIP });
        assert_eq!(Gear::BOTH.map(|gear| still.greatest_rise_k(gear, Spread::Ellipse)), [0.0; 2]);
        // The mean of the cells is 1 however few points there are in the strip.
        for (row, per_point) in
            [(vec![0.0, 1.0, 0.0], 0.9), (vec![2.0], 3.0), (vec![0.0, 1.0, 2.0, 1.5, 0.5, 0.0], 0.24)]
        {
            let along_mm: Vec<f64> = (0..row.len()).map(|k| per_point * k as f64).collect();
            let cells = PointsInBand::under(&along_mm, &row, 1.0, true).unwrap().cells(&row);
            assert!((cells.iter().sum::<f64>() / CELLS as f64 - 1.0).abs() < 1e-12, "{row:?}");
        }
    }
}
