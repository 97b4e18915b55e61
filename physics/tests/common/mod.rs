//! Pairs that several tests run on.
#![allow(dead_code, unused_imports, unreachable_pub, reason = "tests and examples each use their own part")]

#[path = "../../../crates/fem/tests/common/mod.rs"]
mod fem;

pub use fem::{assert_close, fe_case, grid};

use gearwear_bodies::gear::{
    Gear, GearPair, PerGear,
    flank::PointSpacing,
    flank_zones::FlankZones,
    modification::Modification,
    root_trochoid::greatest_fillet_radius_factor,
    spec::{AxisParallelism, BasicRack, GearSpec, PairSpec},
};

/// One gear by teeth, shift and tip diameter.
pub fn gear(teeth: u32, profile_shift: f64, tip_diameter_mm: Option<f64>) -> GearSpec {
    GearSpec {
        teeth,
        profile_shift,
        tip_diameter_mm,
        tooth_thickness_allowance_mm: 0.0,
        bore_diameter_mm: None,
        modification: Modification::default(),
        measured_flank: None,
        shaft: None,
        ring: None,
        tip_chamfer: None,
    }
}

/// A spur pair on the rack 20°, 1.0/1.25/0.38.
pub fn spur(module: f64, centre_distance_mm: f64, face_width_mm: f64, pinion: GearSpec, wheel: GearSpec) -> PairSpec {
    PairSpec {
        normal_module_mm: module,
        normal_pressure_angle_rad: 20f64.to_radians(),
        helix_angle_rad: 0.0,
        centre_distance_mm,
        face_width_mm,
        rack: BasicRack::default(),
        axis_parallelism: AxisParallelism::default(),
        gears: PerGear { pinion, wheel },
    }
}

/// FZG type C: ISO 14635-1.
pub fn fzg_c() -> PairSpec {
    spur(4.5, 91.5, 14.0, gear(16, 0.1817, Some(82.46)), gear(24, 0.1715, Some(118.36)))
}

/// FZG type A (A20).
pub fn fzg_a() -> PairSpec {
    spur(4.5, 91.5, 20.0, gear(16, 0.8532, Some(88.77)), gear(24, -0.5, Some(112.5)))
}

/// The transverse section of FZG type C with a helix: factors of the transverse module become x_n = x_t/cos β, but for a
/// fillet radius that does not fit into the rack of a steep helix.
pub fn fzg_c_with_helix(helix_angle_deg: f64, face_width_mm: f64) -> PairSpec {
    let mut spec = fzg_c();
    (spec.helix_angle_rad, spec.face_width_mm) = (helix_angle_deg.to_radians(), face_width_mm);
    let cos_beta = spec.helix_angle_rad.cos();
    spec.normal_module_mm *= cos_beta;
    spec.normal_pressure_angle_rad = (spec.normal_pressure_angle_rad.tan() * cos_beta).atan();
    let scale = 1.0 / cos_beta;
    Gear::BOTH.into_iter().for_each(|gear| spec.gears[gear].profile_shift *= scale);
    let BasicRack { addendum_factor, dedendum_factor, fillet_radius_factor } = spec.rack;
    let greatest = greatest_fillet_radius_factor(spec.normal_pressure_angle_rad, scale * dedendum_factor);
    spec.rack = BasicRack {
        addendum_factor: scale * addendum_factor,
        dedendum_factor: scale * dedendum_factor,
        fillet_radius_factor: (scale * fillet_radius_factor).min(greatest),
    };
    spec
}

/// A public FEUP pair, 15° and 91.5 mm, with broken tip edges.
fn feup(module: f64, face_width_mm: f64, pinion: GearSpec, wheel: GearSpec) -> PairSpec {
    with_broken_edges(PairSpec {
        helix_angle_rad: 15f64.to_radians(),
        ..spur(module, 91.5, face_width_mm, pinion, wheel)
    })
}

/// The same with tip edges rounded by 0.1 mm.
fn with_broken_edges(mut spec: PairSpec) -> PairSpec {
    Gear::BOTH.into_iter().for_each(|gear| spec.gears[gear].modification.tip_rounding_mm = 0.1);
    spec
}

/// Pairs of presets of the program by name; a test of `gearwear` holds them against the presets themselves.
pub fn preset_pairs() -> [(&'static str, PairSpec); 8] {
    let helical = fzg_c_with_helix(15.0, 20.0);
    let h951 = feup(1.75, 21.2418, gear(38, 1.6915, None), gear(57, 2.0003, None));
    let smaller_fillets = BasicRack { fillet_radius_factor: 0.3, ..h951.rack };
    [
        ("thesis-spur", fzg_c()),
        ("fzg-c", with_broken_edges(fzg_c())),
        ("fzg-a", with_broken_edges(fzg_a())),
        ("thesis-helical", helical.clone()),
        ("helical", with_broken_edges(helical)),
        ("h501", feup(3.5, 23.0, gear(20, 0.1809, None), gear(30, 0.0891, None))),
        ("h701", feup(2.5, 17.0, gear(28, 0.229, None), gear(42, 0.1489, None))),
        ("h951", PairSpec { rack: smaller_fillets, ..h951 }),
    ]
}

/// The pair of a preset.
pub fn preset(name: &str) -> PairSpec {
    let (_, pair) = preset_pairs().into_iter().find(|(own, _)| *own == name).expect("a preset");
    pair
}

/// A pair that can run.
pub fn pair(spec: &PairSpec) -> GearPair {
    GearPair::new(spec).expect("the pair of the test is sound")
}

/// The parts of the flanks of a steel pair under this load.
pub fn zones(pair: &GearPair, line_load_n_per_mm: f64) -> PerGear<FlankZones> {
    let at_pitch = hertz::flattening(pair, &steel(), pair.path.pitch_point_mm);
    FlankZones::of_pair(pair, at_pitch.contact.loaded(line_load_n_per_mm).half_width_mm)
}

/// Steel as in the scene's default.
pub const STEEL: gearwear_bodies::material::Material =
    gearwear_bodies::material::Material { young_modulus_mpa: 206e3, poisson_ratio: 0.3, density_kg_per_m3: 7830.0 };

/// Both gears of steel.
pub fn steel() -> PerGear<gearwear_bodies::material::Material> {
    PerGear { pinion: STEEL, wheel: STEEL }
}

use gearwear_bodies::gear_mesh::ToothSector;
use gearwear_physics::contact::{
    ContactSurface,
    foundation::matched_mpa_per_mm,
    half_space::HalfSpace,
    hertz::{self, Hertz},
    hertz_mean::HertzMean,
    settings::MatchCriterion,
    winkler::{Winkler, WinklerFoundation},
};
use gearwear_physics::mesh_cycle::{
    settings::SliceSettings, slice_coupling::SliceCompliance, sliced_teeth::SlicedTeeth,
};
use gearwear_physics::observer::Unwatched;
use gearwear_physics::simulation::mesh_contact::MeshContact;
use gearwear_physics::simulation::settings::{LifeLimits, Numerics, Stepping};
use gearwear_physics::simulation::stability::StepBound;
use gearwear_physics::simulation::wear_run::{Outcome, RunPhase, WearRun};
use gearwear_physics::stiffness::{TeethSpring, curve::PairCompliance, settings::StiffnessSettings};
use gearwear_physics::wear::{
    WearModel,
    settings::{SevereTransition, WearSettings},
};

/// A wear run in the making; the default is the fzg-c scene.
#[derive(Clone)]
pub struct Scene {
    pub pair: PairSpec,
    pub torque_n_mm: f64,
    pub revolutions: f64,
    pub snapshots: Vec<f64>,
    pub surface: &'static str,
    pub criterion: MatchCriterion,
    pub stiffness: StiffnessSettings,
    pub coefficient_mm2_per_n: f64,
    pub severe: Option<SevereTransition>,
    pub flank_points: usize,
    pub positions: usize,
    pub steps: f64,
    /// Instead of `steps`.
    pub stepping: Option<Stepping>,
    pub tip_contact: bool,
    pub slices: Option<SliceSettings>,
    pub curve: Option<PairCompliance>,
}

/// Wear run of `pair` in `phases`, all under the load of the first, with one mate of each gear.
pub fn wear_run<'a>(
    pair: &'a GearPair,
    phases: &'a [RunPhase<'a>],
    snapshots_revolutions: &'a [f64],
    numerics: Numerics,
) -> WearRun<'a> {
    WearRun {
        pair,
        zones: zones(pair, phases[0].line_load_n_per_mm),
        phases,
        snapshots_revolutions,
        meshes_per_pinion_turn: PerGear { pinion: 1.0, wheel: pair.wheel_turns_per_pinion_turn() },
        limits: LifeLimits::default(),
        numerics,
    }
}

/// "The fzg-c scene": 302 N·m, 150 rpm, 127.75 h, Winkler matched on half-width, 20 N/(mm·µm), k 1e-17 m²/N.
pub fn fzg_c_scene() -> Scene {
    Scene {
        pair: fzg_c(),
        torque_n_mm: 302e3,
        revolutions: 127.75 * 60.0 * 150.0,
        snapshots: Vec::new(),
        surface: "winkler",
        criterion: MatchCriterion::HalfWidth,
        stiffness: StiffnessSettings::Constant { pair_n_per_mm2: 20e3 },
        coefficient_mm2_per_n: 1e-11,
        severe: None,
        flank_points: 750,
        positions: 400,
        steps: 150.0,
        stepping: None,
        tip_contact: false,
        slices: None,
        curve: None,
    }
}

impl Scene {
    /// Whole load per mm of face width.
    pub fn line_load(&self) -> f64 {
        let pair = pair(&self.pair);
        self.torque_n_mm / pair.path.involute.pinion.base_radius_mm / self.pair.face_width_mm
    }

    /// K/H by the scene's criterion.
    pub fn foundation(&self) -> f64 {
        let pair = pair(&self.pair);
        let at_pitch = hertz::flattening(&pair, &steel(), pair.path.pitch_point_mm);
        matched_mpa_per_mm(self.criterion, &at_pitch, self.line_load())
    }

    /// The contact surface by name.
    pub fn surface(&self) -> Box<dyn ContactSurface> {
        let expected_line_load_n_per_mm = self.line_load();
        match self.surface {
            "winkler" => Box::new(Winkler {
                foundation: WinklerFoundation::Uniform { mpa_per_mm: self.foundation() },
                expected_line_load_n_per_mm,
            }),
            "half-space" => Box::new(HalfSpace { material: steel(), expected_line_load_n_per_mm }),
            "hertz" => Box::new(Hertz { material: steel(), expected_line_load_n_per_mm }),
            "hertz-mean" => Box::new(HertzMean { material: steel() }),
            other => panic!("no surface {other}"),
        }
    }

    /// Its resolution.
    pub fn numerics(&self) -> Numerics {
        Numerics {
            flank_points: self.flank_points,
            point_spacing: PointSpacing::Even,
            positions: self.positions,
            stepping: self.stepping.unwrap_or(Stepping::Fixed { revolutions: self.revolutions / self.steps }),
            error_estimate: false,
        }
    }

    /// Runs it.
    pub fn run(&self) -> Outcome {
        self.with(|run, _| run.run(&Unwatched).expect("the run of the test converges"))
    }

    /// The longest stable step of Euler's method.
    pub fn step_bound(&self) -> StepBound {
        self.with(|run, phase| run.step_bound(phase, false, &|| false).expect("the unworn pair has an equilibrium"))
    }

    /// Hands the run and its phase to `then`.
    fn with<T>(&self, then: impl FnOnce(&WearRun<'_>, &RunPhase<'_>) -> T) -> T {
        let pair = pair(&self.pair);
        let (surface, line_load) = (self.surface(), self.line_load());
        let teeth = TeethSpring::new(self.stiffness, self.curve.as_ref(), &pair, &steel(), surface.as_ref(), line_load)
            .expect("the model has its curve");
        let law = gearwear_physics::wear::of(&WearSettings {
            severe: self.severe,
            ..WearSettings::archard(self.coefficient_mm2_per_n)
        });
        let compliance = SliceCompliance::of_plates(&pair, &steel(), teeth.states_the_section());
        let sliced = self.slices.map(|settings| SlicedTeeth::new(&pair, &steel(), settings, compliance, None));
        let phase = RunPhase {
            contact: MeshContact::LineOfAction {
                surface: surface.as_ref(),
                teeth: &teeth,
                tip_contact: self.tip_contact,
                sliced: sliced.as_ref(),
            },
            wear: WearModel::cold(law.as_ref()),
            line_load_n_per_mm: line_load,
            end_revolutions: self.revolutions,
        };
        then(&wear_run(&pair, &[phase], &self.snapshots, self.numerics()), &phase)
    }
}

/// Area of a meshed sector, mm², by corners and middles in turn round each cell.
pub fn sector_mm2(sector: &ToothSector) -> f64 {
    let cells = sector.cells.iter().map(|cell| {
        let nodes = cell.nodes();
        let corners = nodes.len() / 2;
        let round = (0..corners).flat_map(|k| [nodes[k], nodes[corners + k]]);
        let round: Vec<_> = round.map(|node| sector.points_mm[node as usize]).collect();
        0.5 * (0..round.len()).map(|k| round[k].perp(&round[(k + 1) % round.len()])).sum::<f64>()
    });
    cells.sum::<f64>().abs()
}
