//! Synthetic measurements: the wear of a run with known coefficients, form and noise added.

use std::f64::consts::{PI, TAU};

use gearwear::measured_flank::file;
use gearwear::measured_flank::teeth::TraceChoice;
use gearwear::report;
use gearwear::runs;
use gearwear::scene::Resolved;
use gearwear::scene::loaded::LoadedScene;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_physics::observer::Unwatched;
use gearwear_physics::results::run::{FlankRecord, RunRecord};
use gearwear_studies::compare::question::{CompareOptions, ComparisonQuestion, FitKind};
use gearwear_studies::compare::record::CompareRecord;
use gearwear_studies::compare::run_folder::RunFolder;
use gearwear_studies::compare::study;

use crate::common::loaded;

/// A run as its folder has it, and the noiseless traces of another one with other coefficients.
pub struct Laboratory {
    folder: RunFolder,
    scene: LoadedScene,
    pair: GearPair,
    pub traces: PerGear<Trace>,
}

/// Points of a flank of a run.
pub struct Trace {
    gear: Gear,
    radius_mm: Vec<f64>,
    /// Arc lengths from the base circle.
    pub arc_mm: Vec<f64>,
    /// Wear depth there.
    pub wear_um: Vec<f64>,
}

/// Points of a trace.
pub const POINTS: usize = 300;

impl Laboratory {
    /// A run of `scene`, and the wear by `truth`.
    pub fn new(scene: &str, truth: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let (resolved, record) = run(scene);
        report::write_data(&record, folder.path()).unwrap();
        report::write_summary(&record.summary, folder.path()).unwrap();
        let pair = GearPair::new(&resolved.scene.pair).unwrap();
        let flanks = run(truth).1.flanks;
        let traces = PerGear::from_fn(|gear| Trace::new(&pair, gear, &flanks[gear]));
        let folder = RunFolder::with_snapshots(folder.path()).unwrap();
        Self { folder, scene: loaded(&resolved), pair, traces }
    }

    /// r_b.
    pub fn base_radius_mm(&self, gear: Gear) -> f64 {
        self.pair.teeth[gear].involute.base_radius_mm
    }

    /// L of f_Hα: from the start of active profile to the tip circle.
    pub fn profile_length_mm(&self, gear: Gear) -> f64 {
        self.pair.teeth[gear].edge_rho_mm() - self.pair.active_start_rho_mm(gear)
    }

    /// What the comparison of a file with the run says.
    pub fn compare(&self, text: &str, asked: &CompareOptions) -> CompareRecord {
        self.compare_all(&[text], asked)
    }

    /// What the comparison of some files with the run says.
    pub fn compare_all(&self, texts: &[&str], asked: &CompareOptions) -> CompareRecord {
        let files: Vec<_> =
            texts.iter().map(|text| ("trace.csv".to_owned(), file::parse(text, &asked.traces).unwrap())).collect();
        let question = ComparisonQuestion::new(asked, &files, &self.folder, &self.scene.resolved, &self.pair).unwrap();
        study::run(&question, &self.folder, &self.scene, &Unwatched).unwrap()
    }
}

impl Trace {
    /// Wear of a flank at evenly spaced arc lengths of its active part.
    fn new(pair: &GearPair, gear: Gear, flank: &FlankRecord) -> Self {
        let tooth = &pair.teeth[gear];
        let involute = tooth.involute;
        let start = involute.arc_mm(pair.active_start_rho_mm(gear));
        let end = involute.arc_mm(tooth.tip_rho_mm());
        // A little less than the whole flank, so that a shift leaves the trace on it.
        let arc_mm: Vec<f64> =
            (0..POINTS).map(|i| start + 0.06 + (end - start - 0.12) * i as f64 / (POINTS - 1) as f64).collect();
        let radius_at = |arc: &f64| involute.radius_mm((2.0 * involute.base_radius_mm * arc).sqrt());
        let radius_mm: Vec<f64> = arc_mm.iter().map(radius_at).collect();
        let wear_um = radius_mm.iter().map(|&r| interpolated(&flank.radius_mm, &flank.wear_um, r)).collect();
        Self { gear, radius_mm, arc_mm, wear_um }
    }

    /// Greatest wear depth.
    pub fn depth_um(&self) -> f64 {
        self.wear_um.iter().copied().fold(0.0, f64::max)
    }

    /// Heights with noise of 5 % of the greatest depth.
    pub fn heights(&self, noise: &[f64]) -> Vec<f64> {
        let depth = self.depth_um();
        self.wear_um.iter().zip(noise).map(|(wear, noise)| -wear + 0.05 * depth * noise).collect()
    }

    /// A file of heights at the points.
    pub fn file(&self, height_um: &[f64]) -> String {
        let rows: String = self.radius_mm.iter().zip(height_um).map(|(r, z)| format!("{r},{z}\n")).collect();
        format!("# gear = {}\nradius_mm,height_um\n{rows}", self.gear.name())
    }
}

/// Carries a scene out.
fn run(scene: &str) -> (Resolved, RunRecord) {
    let resolved = Resolved::from_toml(scene).unwrap_or_else(|problems| panic!("{problems:?}"));
    let done = runs::run(&loaded(&resolved), &Unwatched).unwrap();
    assert!(done.failure.is_none());
    (resolved, done.record)
}

fn interpolated(x: &[f64], y: &[f64], at: f64) -> f64 {
    let after = x.partition_point(|&x| x <= at).clamp(1, x.len() - 1);
    let t = (at - x[after - 1]) / (x[after] - x[after - 1]);
    y[after - 1] + t * (y[after] - y[after - 1])
}

/// What is asked where a test says nothing else: k of heights, no shift.
pub fn asked(fit: FitKind) -> CompareOptions {
    CompareOptions {
        gear: None,
        form: None,
        fit: Some(fit),
        shift_within_mm: 0.0,
        traces: TraceChoice::default(),
        tries_slopes: false,
    }
}

/// Normal numbers of mean 0 and deviation 1 by Box and Muller, from xorshift64* (Vigna 2016).
pub struct Noise(u64);

impl Noise {
    /// A generator with its seed.
    pub fn new(seed: u64) -> Self {
        // Neighbouring seeds begin far apart: the odd constant of Knuth's multiplicative hashing.
        let mut noise = Self((seed + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15));
        for _ in 0..16 {
            noise.uniform();
        }
        noise
    }

    /// A number from 0 to 1, all alike.
    pub fn uniform(&mut self) -> f64 {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        ((self.0.wrapping_mul(0x2545_F491_4F6C_DD1D) >> 11) as f64 + 0.5) / (1u64 << 53) as f64
    }

    /// The next number.
    pub fn normal(&mut self) -> f64 {
        (-2.0 * self.uniform().ln()).sqrt() * (TAU * self.uniform()).cos()
    }

    /// White noise.
    pub fn white(&mut self, count: usize) -> Vec<f64> {
        (0..count).map(|_| self.normal()).collect()
    }

    /// Noise of the same deviation whose neighbours depend on each other: an autoregression of first order.
    pub fn correlated(&mut self, count: usize, rho: f64) -> Vec<f64> {
        let mut last = self.normal();
        (0..count)
            .map(|_| {
                last = rho * last + (1.0 - rho * rho).sqrt() * self.normal();
                last
            })
            .collect()
    }
}

/// A wave of this amplitude and length.
pub fn wave(arc_mm: &[f64], amplitude_um: f64, length_mm: f64) -> Vec<f64> {
    arc_mm.iter().map(|s| amplitude_um * (2.0 * PI * s / length_mm).sin()).collect()
}
