//! Friction heat over a mesh: temperature rises by every method, Peclet numbers, and the wear law at these temperatures.
//!
//! Seen from outside, from load and half-width of every contact, as reports need it: the strip is taken to be heated evenly or as by
//! Hertz's ellipse, whatever its worn pressure is. The wear itself reads the pressures as they are ([`crate::wear::heated_row`]).
//!
//! The work that sliding flanks do on each other weighs every place and moment,
//!
//! ```text
//! W = Σ ∫ p v_s dt dx        k̄ = 1/W · Σ ∫ k(v_s, T) p v_s dt dx
//! ```
//!
//! and so does the part of it that is done outside the temperatures for which a law holds.

use crate::lubrication::running_pair::LoadedPlace;
use crate::mesh_cycle::{CycleObservation, sliced_mesh::SlicedMesh};
use crate::thermal::{
    ContactHeat, HeatedStrip, SpeedRatios,
    band::{HeatedBand, Spread},
    settings::TemperatureMethod,
};
use crate::wear::{ContactConditions, LocalContact, WearModel};
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::reference::hertz_line::PEAK_OVER_MEAN;

/// Places across a contact at which its work is weighed.
const PLACES: usize = 32;

/// Heat at one position of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HeatAtPosition {
    /// Theoretical contact point.
    pub position_mm: f64,
    /// Greatest rise of either surface by each of [`TemperatureMethod::ALL`], K.
    pub rise_k: [f64; 3],
    /// Pe of each surface; where slices are at different places, the greatest.
    pub peclet: PerGear<f64>,
    /// Whether the pair carries load here.
    pub loaded: bool,
}

/// Heat over a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct HeatObservation {
    /// At the positions of the observed cycle.
    pub positions: Vec<HeatAtPosition>,
    /// The wear law in it.
    pub law: LawInHeat,
}

/// A wear law over a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawInHeat {
    /// Over both flanks.
    pub both: LawOverMesh,
    /// Over each of them.
    pub of: PerGear<LawOverMesh>,
    /// The greatest k · 2 a |ζ| of mild wear at any contact: what a point loses in a mesh per pressure, mm³/N.
    pub greatest_rate_mm3_per_n: PerGear<f64>,
}

/// Means of a wear law over a mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LawOverMesh {
    /// k̄ of mild wear, mm²/N.
    pub mean_coefficient_mm2_per_n: f64,
    /// Part of the sliding work that is done at temperatures for which the law does not hold; none where it names none.
    pub work_outside_validity: Option<f64>,
}

/// Observer of the friction heat of a mesh cycle.
#[derive(Clone, Copy)]
pub struct HeatObserver<'a> {
    /// The gears.
    pub pair: &'a GearPair,
    /// The heat.
    pub heat: &'a ContactHeat,
    /// The wear law of each gear, and the friction.
    pub wear: WearModel<'a>,
    /// Temperatures between which it holds, K.
    pub valid_k: PerGear<Option<[f64; 2]>>,
    /// Distribution of the heat over a contact.
    pub spread: Spread,
    /// Whole load, N per mm of face width.
    pub line_load_n_per_mm: f64,
    /// Distance of the theoretical contact point of each slice ahead of the tooth's position, mm.
    pub ahead_mm: &'a [f64],
}

/// A contact seen from outside.
#[derive(Debug, Clone, Copy)]
struct ContactAsHeated {
    position_mm: f64,
    line_load_n_per_mm: f64,
    half_width_mm: f64,
    /// Length of the path it stands for.
    length_mm: f64,
}

impl ContactAsHeated {
    /// Mean pressure, MPa.
    fn mean_mpa(&self) -> f64 {
        if self.half_width_mm > 0.0 { self.line_load_n_per_mm / (2.0 * self.half_width_mm) } else { 0.0 }
    }
}

/// Sums over the contacts of a mesh.
#[derive(Debug, Clone, Copy, Default)]
struct MeshSums {
    both: WorkSums,
    of: PerGear<WorkSums>,
    greatest_rate: PerGear<f64>,
}

/// Sums of the work of flanks.
#[derive(Debug, Clone, Copy, Default)]
struct WorkSums {
    work: f64,
    outside: f64,
    worn: f64,
}

impl WorkSums {
    /// A `part` of the work, which wears by the coefficient `k`.
    fn add(&mut self, part: f64, k: f64, is_outside: bool) {
        self.work += part;
        self.worn += k * part;
        if is_outside {
            self.outside += part;
        }
    }

    /// Means of the law, which may have bounds of its temperature.
    fn law(&self, is_bounded: bool) -> LawOverMesh {
        let part = |of: f64| if self.work > 0.0 { of / self.work } else { 0.0 };
        LawOverMesh {
            mean_coefficient_mm2_per_n: part(self.worn),
            work_outside_validity: is_bounded.then(|| part(self.outside)),
        }
    }
}

impl HeatObserver<'_> {
    /// Looks at a cycle.
    pub fn observe(&self, cycle: &CycleObservation) -> HeatObservation {
        let mut sums = MeshSums::default();
        let positions = match &cycle.slices {
            Some(mesh) => self.sliced(mesh, cycle, &mut sums),
            None => self.whole(cycle, &mut sums),
        };
        let is_bounded = self.valid_k.map(|valid| valid.is_some());
        let law = LawInHeat {
            both: sums.both.law(is_bounded.pinion || is_bounded.wheel),
            of: PerGear::from_fn(|gear| sums.of[gear].law(is_bounded[gear])),
            greatest_rate_mm3_per_n: sums.greatest_rate,
        };
        HeatObservation { positions, law }
    }

    /// The reference pair at every position.
    fn whole(&self, cycle: &CycleObservation, sums: &mut MeshSums) -> Vec<HeatAtPosition> {
        let places: Vec<f64> = cycle.positions.iter().map(|at| at.position_mm).collect();
        let last = places.len().saturating_sub(1);
        let seen = |(k, at): (usize, &crate::mesh_cycle::PositionObservation)| {
            let length_mm = 0.5 * (places[(k + 1).min(last)] - places[k.saturating_sub(1)]);
            let contact = ContactAsHeated {
                position_mm: at.position_mm,
                line_load_n_per_mm: at.load_share * self.line_load_n_per_mm,
                half_width_mm: at.footprint.equivalent_half_width_mm,
                length_mm,
            };
            self.weigh(&contact, sums);
            self.at(&contact)
        };
        cycle.positions.iter().enumerate().map(seen).collect()
    }

    /// The hottest slice of a tooth at every position, between the phases of the mesh.
    fn sliced(&self, mesh: &SlicedMesh, cycle: &CycleObservation, sums: &mut MeshSums) -> Vec<HeatAtPosition> {
        let spacing = mesh.base_pitch_mm / mesh.transmission_error_mm.len() as f64;
        let rows: Vec<HeatAtPosition> = mesh
            .position_mm
            .iter()
            .enumerate()
            .map(|(row, &position_mm)| {
                let mut hottest =
                    HeatAtPosition { position_mm, rise_k: [0.0; 3], peclet: PerGear::default(), loaded: false };
                for (slice, ahead) in self.ahead_mm.iter().enumerate().take(mesh.slices) {
                    let place = row * mesh.slices + slice;
                    let part = mesh.part_of_width[place];
                    if part <= 0.0 {
                        continue;
                    }
                    let within = |at: f64| at.clamp(self.pair.path.start_mm, self.pair.path.end_mm);
                    let middle_mm = position_mm + ahead;
                    let contact = ContactAsHeated {
                        position_mm: if part < 1.0 { within(middle_mm) } else { middle_mm },
                        line_load_n_per_mm: mesh.line_load_n_per_mm[place] / part,
                        half_width_mm: mesh.equivalent_half_width_mm[place],
                        length_mm: part * spacing,
                    };
                    self.weigh(&contact, sums);
                    hottest.take_hotter(&self.at(&contact));
                }
                hottest
            })
            .collect();
        let first = mesh.position_mm.first().copied().unwrap_or_default();
        let nearest = |position_mm: f64| {
            let row = ((position_mm - first) / spacing).round().clamp(0.0, rows.len().saturating_sub(1) as f64);
            rows.get(row as usize).map(|row| HeatAtPosition { position_mm, ..*row })
        };
        cycle.positions.iter().filter_map(|at| nearest(at.position_mm)).collect()
    }

    fn band(&self, method: TemperatureMethod, contact: &ContactAsHeated) -> HeatedBand<'_> {
        let (line_load_n_per_mm, half_width_mm) = (contact.line_load_n_per_mm, contact.half_width_mm);
        let place = LoadedPlace {
            position_mm: contact.position_mm,
            line_load_n_per_mm,
            peak_pressure_mpa: PEAK_OVER_MEAN * contact.mean_mpa(),
            half_width_mm,
        };
        let strip = HeatedStrip {
            ratios: SpeedRatios::over(self.pair, contact.position_mm, contact.position_mm),
            line_load_n_per_mm,
            half_width_mm,
            friction_coefficient: self.wear.friction(self.heat, &place),
        };
        self.heat.band_by(method, &strip)
    }

    fn at(&self, contact: &ContactAsHeated) -> HeatAtPosition {
        let greatest = |method| {
            let band = self.band(method, contact);
            Gear::BOTH.map(|gear| band.greatest_rise_k(gear, self.spread)).into_iter().fold(0.0, f64::max)
        };
        let band = self.band(TemperatureMethod::TianKennedy, contact);
        HeatAtPosition {
            position_mm: contact.position_mm,
            rise_k: TemperatureMethod::ALL.map(greatest),
            peclet: PerGear::from_fn(|gear| band.peclet(gear)),
            loaded: contact.line_load_n_per_mm > 0.0,
        }
    }

    /// Adds the work of a contact, on both flanks, and what it wears.
    fn weigh(&self, contact: &ContactAsHeated, sums: &mut MeshSums) {
        if contact.line_load_n_per_mm <= 0.0 {
            return;
        }
        let ratios = SpeedRatios::over(self.pair, contact.position_mm, contact.position_mm);
        let band = self.band(self.heat.settings.method, contact);
        let work = contact.line_load_n_per_mm * ratios.sliding * contact.length_mm;
        let (pressure, mut rises) = (self.pressures(), [0.0; PLACES]);
        let total: f64 = pressure.iter().sum();
        let to_mpa = contact.mean_mpa() * PLACES as f64 / total;
        for gear in Gear::BOTH {
            match self.spread {
                Spread::Even => rises.fill(band.greatest_rise_k(gear, Spread::Even)),
                Spread::Ellipse => {
                    let along_mm: [f64; PLACES] =
                        std::array::from_fn(|k| 2.0 * contact.half_width_mm * k as f64 / PLACES as f64);
                    band.rises_k(gear, &along_mm, &pressure, &mut rises);
                }
            }
            let slid_mm = 2.0 * contact.half_width_mm * ratios.sliding / ratios.rolling[gear];
            for (pressure, rise) in pressure.iter().zip(rises) {
                let temperature_k = self.heat.settings.bulk_temperature_k + rise;
                let own = ContactConditions {
                    sliding_speed_mm_per_s: self.heat.sliding_speed_mm_per_s(&ratios),
                    temperature_k,
                };
                let at = LocalContact { pressure_mpa: to_mpa * pressure, conditions: Some(own), lambda: None };
                let k = self.wear.laws[gear].mild_coefficient_mm2_per_n(&at);
                let part = work * pressure / total;
                let is_outside = self.valid_k[gear].is_some_and(|[low, high]| !(low..=high).contains(&temperature_k));
                sums.both.add(part, k, is_outside);
                sums.of[gear].add(part, k, is_outside);
                sums.greatest_rate[gear] = sums.greatest_rate[gear].max(k * slid_mm);
            }
        }
    }

    /// Pressures across a contact, on any scale.
    fn pressures(&self) -> [f64; PLACES] {
        std::array::from_fn(|k| {
            let x = (2 * k + 1) as f64 / PLACES as f64 - 1.0;
            match self.spread {
                Spread::Even => 1.0,
                Spread::Ellipse => (1.0 - x * x).sqrt(),
            }
        })
    }
}

impl HeatAtPosition {
    /// Takes the greater of all values.
    fn take_hotter(&mut self, other: &Self) {
        for (rise, others) in self.rise_k.iter_mut().zip(other.rise_k) {
            *rise = rise.max(others);
        }
        if other.loaded {
            self.loaded = true;
            for gear in Gear::BOTH {
                self.peclet[gear] = self.peclet[gear].max(other.peclet[gear]);
            }
        }
    }
}

impl HeatObservation {
    /// Greatest rise over the mesh by each of [`TemperatureMethod::ALL`], K.
    pub fn greatest_rise_k(&self) -> [f64; 3] {
        let rises = self.positions.iter().map(|at| at.rise_k);
        rises.fold([0.0; 3], |greatest, rise| std::array::from_fn(|k| f64::max(greatest[k], rise[k])))
    }

    /// Least and greatest Peclet number of either surface where the pair carries load.
    pub fn peclet_range(&self) -> [f64; 2] {
        let loaded = self.positions.iter().filter(|at| at.loaded);
        let all = loaded.flat_map(|at| [at.peclet.pinion, at.peclet.wheel]);
        all.fold([f64::INFINITY, 0.0], |[low, high], pe| [low.min(pe), high.max(pe)])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::thermal::settings::{HeatPartition, HeatSettings, HeatVelocity, ThermalMaterial};
    use crate::wear::{FlankWear, SlidingRow, settings::FilmDependence};
    use gearwear_bodies::gear::modification::Modification;
    use gearwear_bodies::gear::spec::{AxisParallelism, BasicRack, GearSpec, PairSpec};

    /// A law whose coefficient is the pressure in MPa.
    struct Proportional;

    impl FlankWear for Proportional {
        fn add_depth(&self, _row: &SlidingRow<'_>, _depth_mm: &mut [f64]) {}

        fn reads_conditions(&self) -> bool {
            true
        }

        fn film(&self) -> Option<&FilmDependence> {
            None
        }

        fn mild_coefficient_mm2_per_n(&self, at: &LocalContact) -> f64 {
            at.pressure_mpa
        }
    }

    fn gear(teeth: u32, profile_shift: f64, tip_diameter_mm: f64) -> GearSpec {
        GearSpec {
            teeth,
            profile_shift,
            tip_diameter_mm: Some(tip_diameter_mm),
            tooth_thickness_allowance_mm: 0.0,
            bore_diameter_mm: None,
            modification: Modification::default(),
            measured_flank: None,
            shaft: None,
            ring: None,
            tip_chamfer: None,
        }
    }

    /// Weighed by the work p v_s, the mean of p is ∫p² dx/∫p dx: w/(2 a) where heat is even, 8/(3π) of Hertz's maximum 2 w/(π a) on
    /// his ellipse, within what the midpoint rule makes of its ends at 32 places. FZG type C, 0.5 mm before C.
    #[test]
    fn ver_laws_get_the_pressure_in_mpa() {
        let pair = GearPair::new(&PairSpec {
            normal_module_mm: 4.5,
            normal_pressure_angle_rad: 20f64.to_radians(),
            helix_angle_rad: 0.0,
            centre_distance_mm: 91.5,
            face_width_mm: 14.0,
            rack: BasicRack::default(),
            axis_parallelism: AxisParallelism::default(),
            gears: PerGear { pinion: gear(16, 0.1817, 82.46), wheel: gear(24, 0.1715, 118.36) },
        })
        .unwrap();
        let steel = ThermalMaterial { conductivity_n_per_s_k: 46.0, diffusivity_mm2_per_s: 12.0 };
        let settings = HeatSettings {
            method: TemperatureMethod::TianKennedy,
            velocity: HeatVelocity::Sliding,
            partition: HeatPartition::ArchardRowntree,
            friction_coefficient: Some(0.1),
            bulk_temperature_k: 363.15,
            is_bulk_of_mesh: false,
            tooth: None,
            material: PerGear { pinion: steel, wheel: steel },
        };
        let heat = ContactHeat::new(settings, 531.4);
        let (w, a) = (637.7, 0.25);
        let on_ellipse = 8.0 / (3.0 * std::f64::consts::PI) * 2.0 * w / (std::f64::consts::PI * a);
        for (spread, expected_mpa, within) in
            [(Spread::Even, w / (2.0 * a), 1e-12), (Spread::Ellipse, on_ellipse, 5e-3)]
        {
            let observer = HeatObserver {
                pair: &pair,
                heat: &heat,
                wear: WearModel::cold(&Proportional),
                valid_k: PerGear::default(),
                spread,
                line_load_n_per_mm: w,
                ahead_mm: &[],
            };
            let mut sums = MeshSums::default();
            let position_mm = pair.path.pitch_point_mm - 0.5;
            let contact = ContactAsHeated { position_mm, line_load_n_per_mm: w, half_width_mm: a, length_mm: 0.1 };
            observer.weigh(&contact, &mut sums);
            for of in [sums.both, sums.of.pinion, sums.of.wheel] {
                let mean_mpa = of.law(false).mean_coefficient_mm2_per_n;
                assert!((mean_mpa / expected_mpa - 1.0).abs() < within, "{spread:?}: {mean_mpa} for {expected_mpa}");
            }
        }
    }
}
