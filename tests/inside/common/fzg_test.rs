//! The FZG wear test of the thesis (paper D, figures 24 and 26) under estimates of what its text does not give.
//!
//! Wear by the law of Archard depends on wear coefficient and revolutions by their product alone. One run therefore tells all speeds
//! and both coefficients: it goes to the greatest product, and is read where the stops of each speed and coefficient are.
//!
//! What the text says is made computable by these bounds, which are this project's own:
//!
//! | target | what the thesis says | holds where |
//! |---|---|---|
//! | D1 | root wear of two teeth between the simulations with k = 1e-17 and 2e-17, axis to 0.03 mm | at the end with 2e-17 between 15 and 30 µm |
//! |    | very fast wear-in, then slow | mean rate to the fifth stop (3.75 h) at least five times that of the last 64 h, both k |
//! | D2 | a peak at 1 mm, axes to 2 mm and 35 µm, where the pressure passes 2000 MPa | a separate peak at 0.5 to 1.5 mm, 10 to 35 µm, either k |
//! | D3 | root, tip and start of single-tooth mesh moderate to severe; pitch point and its end mild to moderate | the least of the three above the greatest of the two, k = 1e-17 |
#![allow(dead_code, reason = "a test and an example each use their own part")]

use gearwear::{Done, LoadedScene, Unwatched};
use gearwear_bodies::reference::separate_peaks::separate_peaks;
use gearwear_physics::results::run::FlankRecord;

/// The stops of the test, h.
pub(crate) const STOPS_H: [f64; 9] = [0.25, 0.75, 1.75, 3.75, 7.75, 15.75, 31.75, 63.75, 127.75];
/// Stops up to which the wear-in counts.
const WEAR_IN: usize = 3;
/// Wear coefficients over 1e-17 m²/N.
pub(crate) const COEFFICIENTS: [f64; 2] = [1.0, 2.0];
/// What is called the root, the tip and the neighbourhood of a point of the flank, mm of radius.
const END_ZONE_MM: f64 = 0.5;
const ROOT_ZONE_MM: f64 = 2.0;
const NEAR_MM: f64 = 0.25;
/// Where Fig 26 has its peak: at 1 mm of an axis whose zero is not said, mm above SAP.
const PEAK_PLACE_MM: std::ops::RangeInclusive<f64> = 0.5..=1.5;
/// A peak is separate where the profile falls by this part of it on both sides.
const SEPARATE: f64 = 0.1;

/// An estimate of the test's load and contact.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Estimate {
    /// Torque on the pinion, N·m.
    pub torque_nm: f64,
    /// Lines of `[contact]`.
    pub contact: String,
    /// Lines of `[numerics]`.
    pub numerics: String,
    /// Width of the transition to severe wear, MPa.
    pub band_mpa: f64,
    /// Speeds that are read from the run, 1/min.
    pub speeds_rpm: Vec<f64>,
}

/// Wear of the pinion over product of coefficient and revolutions.
pub(crate) struct ReadRun {
    flank: FlankRecord,
    products: Vec<f64>,
}

/// What the targets come to at one speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Verdict {
    /// Root wear at the end, µm, for each coefficient.
    pub root_um: [f64; 2],
    /// Mean rate of the wear-in over that of the last 64 h, for each coefficient.
    pub fast_start: [f64; 2],
    /// FilePosition above SAP in mm, and height in µm, of the separate peak of each coefficient.
    pub peak: [Option<(f64, f64)>; 2],
    /// Root, tip, B, C, D with the first coefficient, µm.
    pub places_um: [f64; 5],
}

impl Verdict {
    pub(crate) fn d1(&self) -> bool {
        (15.0..=30.0).contains(&self.root_um[1]) && self.fast_start.iter().all(|&ratio| ratio >= 5.0)
    }

    pub(crate) fn d2(&self) -> bool {
        self.peak.iter().flatten().any(|(_, height)| (10.0..=35.0).contains(height))
    }

    pub(crate) fn d3(&self) -> bool {
        let [root, tip, start, pitch, end] = self.places_um;
        root.min(tip).min(start) > pitch.max(end)
    }
}

/// Product of coefficient and revolutions at a stop, in revolutions at 1e-17 m²/N.
fn product(speed_rpm: f64, coefficient: f64, hours: f64) -> f64 {
    60.0 * speed_rpm * hours * coefficient
}

impl Estimate {
    /// The preset's scene with this estimate instead of its own, to the greatest product.
    fn scene(&self) -> (String, Vec<f64>) {
        let mut products: Vec<f64> = (self.speeds_rpm)
            .iter()
            .flat_map(|&rpm| COEFFICIENTS.iter().flat_map(move |&k| STOPS_H.map(|hours| product(rpm, k, hours))))
            .collect();
        products.sort_by(f64::total_cmp);
        products.dedup();
        let (last, list) = (products[products.len() - 1], format!("{products:?}"));
        let Self { torque_nm, contact, numerics, band_mpa, .. } = self;
        // On elastic contact the preset's own stiffness and rounded tips; springs have the thesis's.
        let elastic = contact.contains("half-space");
        let within = if elastic || contact.contains("tip_contact") { "" } else { "tip_contact = false" };
        let (pair, stiffness) = match elastic {
            true => ("fzg-test", ""),
            false => ("thesis-fzg-test", "[stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n"),
        };
        let text = format!(
            "[pair]\npreset = \"{pair}\"\n[operation]\npinion_torque_Nm = {torque_nm:?}\npinion_revolutions = {last:?}\n\
             snapshots_revolutions = {list}\n[contact]\n{contact}\n{within}\n{stiffness}\
             [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n\
             severe = {{ above_MPa = 2000.0, factor = 100.0, band_MPa = {band_mpa:?} }}\n\
             [numerics]\nerror_estimate = false\nverify = false\n{numerics}\n"
        );
        (text, products)
    }

    /// Runs it.
    pub(crate) fn run(&self) -> ReadRun {
        let (text, products) = self.scene();
        let scene = LoadedScene::from_toml(&text).expect("the scene of the test is sound");
        let Done { record, failure } = gearwear::run(&scene, &Unwatched).expect("the run of the test has results");
        assert_eq!(failure, None);
        ReadRun { flank: record.flanks.pinion, products }
    }
}

impl ReadRun {
    /// Profile at a stop, µm.
    fn profile_um(&self, speed_rpm: f64, coefficient: f64, hours: f64) -> &[f64] {
        let at = product(speed_rpm, coefficient, hours);
        let nearest = |a: &usize, b: &usize| (self.products[*a] - at).abs().total_cmp(&(self.products[*b] - at).abs());
        &self.flank.snapshot_wear_um[(0..self.products.len()).min_by(nearest).expect("a run has snapshots")]
    }

    /// Greatest depth between two radii.
    fn greatest_um(&self, profile: &[f64], [from, to]: [f64; 2]) -> f64 {
        let points = self.flank.radius_mm.iter().zip(profile);
        points.filter(|(radius, _)| (from..=to).contains(*radius)).map(|(_, depth)| *depth).fold(0.0, f64::max)
    }

    /// Greatest root wear at each stop, µm.
    pub(crate) fn root_um(&self, speed_rpm: f64, coefficient: f64) -> [f64; STOPS_H.len()] {
        let start = self.flank.path_point_radius_mm.A;
        STOPS_H.map(|hours| {
            self.greatest_um(self.profile_um(speed_rpm, coefficient, hours), [start, start + ROOT_ZONE_MM])
        })
    }

    /// The highest separate peak at the place of Fig 26's: place above SAP in mm, height in µm.
    fn separate_peak(&self, profile: &[f64]) -> Option<(f64, f64)> {
        let start = self.flank.path_point_radius_mm.A;
        let zone: Vec<(f64, f64)> = (self.flank.radius_mm.iter().zip(profile))
            .map(|(radius, &depth)| (radius - start, depth))
            .filter(|(above, _)| (0.0..=ROOT_ZONE_MM).contains(above))
            .collect();
        let depths: Vec<f64> = zone.iter().map(|(_, depth)| *depth).collect();
        let peaks = zone.iter().map(|(above, _)| *above).zip(separate_peaks(&depths, SEPARATE));
        peaks
            .filter(|(above, height)| *height > 0.0 && PEAK_PLACE_MM.contains(above))
            .max_by(|a, b| a.1.total_cmp(&b.1))
    }

    /// What the targets come to at a speed.
    pub(crate) fn verdict(&self, speed_rpm: f64) -> Verdict {
        let end = STOPS_H[STOPS_H.len() - 1];
        let rate = |root: &[f64; STOPS_H.len()], from: Option<usize>, to: usize| {
            let (depth, hours) = from.map_or((0.0, 0.0), |from| (root[from], STOPS_H[from]));
            (root[to] - depth) / (STOPS_H[to] - hours)
        };
        let roots = COEFFICIENTS.map(|k| self.root_um(speed_rpm, k));
        let last = STOPS_H.len() - 1;
        let places = &self.flank.path_point_radius_mm;
        let profile = self.profile_um(speed_rpm, COEFFICIENTS[0], end);
        let near = |radius: f64| self.greatest_um(profile, [radius - NEAR_MM, radius + NEAR_MM]);
        Verdict {
            root_um: roots.map(|root| root[last]),
            fast_start: roots.map(|root| rate(&root, None, WEAR_IN) / rate(&root, Some(last - 1), last)),
            peak: COEFFICIENTS.map(|k| self.separate_peak(self.profile_um(speed_rpm, k, end))),
            places_um: [
                self.greatest_um(profile, [places.A, places.A + END_ZONE_MM]),
                self.greatest_um(profile, [places.E - END_ZONE_MM, places.E]),
                near(places.B),
                near(places.C),
                near(places.D),
            ],
        }
    }
}
