//! Conditions of a phase of the operation: its lubricated mesh, its warm teeth, its wear laws.
//!
//! Where the scene has [`ToothHeatSettings`](crate::thermal::tooth::ToothHeatSettings), teeth are as warm as VDI 2736-2 says. The wear coefficient of a gear may
//! follow the temperature of its flanks in each phase, its Young's modulus the mean of flank and root. A pair with slices, and one with a calibration file, has
//! the modulus of the phase of the greatest load in all of them: its teeth in space and its calibration belong to one.

use std::f64::consts::TAU;

use crate::contact::settings::{Foundation, SurfaceKind};
use crate::contact::{foundation, hertz};
use crate::lubrication::loss;
use crate::lubrication::running_pair::{RunningConditions, RunningPair, SurfaceOverHertz};
use crate::operation::Scene;
use crate::simulation::settings::Phase;
use crate::thermal::settings::HeatSettings;
use crate::thermal::tooth::{ToothTemperatures, WarmGear};
use crate::wear::settings::WearSettings;
use crate::wear::vdi_2736::SteadyWear;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::material::{Material, contact_modulus_mpa};

/// W per N·mm/s.
const W_PER_N_MM_PER_S: f64 = 1e-3;
/// Halvings until a coefficient of friction is known to its last digits.
const BISECTIONS: usize = 60;
/// No friction is greater.
const GREATEST_FRICTION: f64 = 1e3;

impl Scene {
    /// The wear laws under the conditions of `phase`.
    pub fn wear_in(&self, phase: &Phase) -> PerGear<WearSettings> {
        PerGear::from_fn(|gear| {
            let own = &self.wear[gear];
            let given = phase.coefficient_mm2_per_n[gear].unwrap_or(own.coefficient_mm2_per_n);
            let factor = own.warm.as_ref().zip(phase.flank_c[gear]).map_or(1.0, |(warm, flank_c)| warm.at(flank_c));
            WearSettings { coefficient_mm2_per_n: factor * given, ..own.clone() }
        })
    }

    /// Wear of a gear by its coefficient in each phase, up to `revolutions` of the pinion; none of a law that is more than a coefficient.
    pub fn steady_wear(&self, gear: Gear, revolutions: f64) -> Option<Vec<SteadyWear>> {
        let (mut begin, mates) = (0.0, self.operation.meshes_per_revolution[gear]);
        let stretches = self.operation.phases.iter().map(|phase| {
            let end = phase.end_revolutions.min(revolutions);
            let revolutions = (end - begin).max(0.0);
            begin = phase.end_revolutions;
            Some(SteadyWear {
                coefficient_mm2_per_n: self.wear_in(phase)[gear].constant_coefficient_mm2_per_n()?,
                pinion_torque_n_mm: phase.pinion_torque_n_mm,
                revolutions: mates * revolutions,
            })
        });
        stretches.collect()
    }

    /// The pair at the speed and load of `phase`, with its oil; none where nobody asks for films or losses.
    pub fn running_in<'a>(&'a self, pair: &'a GearPair, phase: &Phase) -> Option<RunningPair<'a>> {
        let material = self.material_in(phase);
        let modulus = contact_modulus_mpa(material.map(Material::elastic));
        let line_load_n_per_mm = pair.line_load_n_per_mm(phase.pinion_torque_n_mm);
        let conditions = RunningConditions {
            pinion_speed_rpm: phase.pinion_speed_rpm?,
            line_load_n_per_mm,
            reduced_modulus_mpa: 2.0 * modulus,
            surface: self.surface_over_hertz(pair, &material, line_load_n_per_mm),
        };
        Some(RunningPair::new(pair, self.lubrication.as_ref()?, conditions))
    }

    /// The contact surface over Hertz's at the pitch point under the whole load.
    fn surface_over_hertz(
        &self,
        pair: &GearPair,
        material: &PerGear<Material>,
        line_load_n_per_mm: f64,
    ) -> SurfaceOverHertz {
        if self.contact.surface != SurfaceKind::Winkler {
            return SurfaceOverHertz::ELASTIC;
        }
        let at_pitch = hertz::flattening(pair, material, pair.path.pitch_point_mm);
        let foundation_mpa_per_mm = match self.contact.foundation {
            Foundation::Given { foundation_mpa_per_mm } => foundation_mpa_per_mm,
            Foundation::Matched(criterion) | Foundation::Calibrated(criterion) => {
                foundation::matched_mpa_per_mm(criterion, &at_pitch, line_load_n_per_mm)
            }
        };
        let [half_width, pressure] = foundation::over_hertz(foundation_mpa_per_mm, &at_pitch, line_load_n_per_mm);
        SurfaceOverHertz { half_width, pressure }
    }

    /// The teeth of each gear in `phase` whose temperature is asked for; none of a metal gear beside a plastic one, and none where nobody asks.
    pub fn teeth_in(&self, pair: &GearPair, phase: &Phase) -> Option<PerGear<Option<ToothTemperatures>>> {
        let running = self.running_in(pair, phase);
        self.teeth_under(pair, phase, mean_friction(&self.heat?, running.as_ref()))
    }

    /// Temperatures of the teeth under this coefficient of friction.
    fn teeth_under(&self, pair: &GearPair, phase: &Phase, friction: f64) -> Option<PerGear<Option<ToothTemperatures>>> {
        let tooth = self.heat?.tooth?;
        let pinion_per_s = TAU * phase.pinion_speed_rpm? / 60.0;
        let power_w = W_PER_N_MM_PER_S * phase.pinion_torque_n_mm * pinion_per_s;
        let loss_w = power_w * friction * loss::of_pair(pair);
        Some(PerGear::from_fn(|gear| {
            let warm = WarmGear {
                teeth: pair.spec.gears[gear].teeth,
                face_width_mm: pair.spec.face_width_mm,
                pitch_velocity_m_per_s: 1e-3 * pair.working_pitch_radius_mm(Gear::Pinion) * pinion_per_s,
                normal_module_mm: pair.spec.normal_module_mm,
            };
            // Every mate warms the teeth that it runs on.
            let loss_w = self.operation.meshes_per_revolution[gear] * loss_w;
            tooth.of[gear].then(|| tooth.temperatures(&warm, loss_w))
        }))
    }

    /// The materials in `phase`.
    pub fn material_in(&self, phase: &Phase) -> PerGear<Material> {
        PerGear::from_fn(|gear| {
            let given = self.material[gear];
            let young_modulus_mpa = phase.young_modulus_mpa.map_or(given.young_modulus_mpa, |moduli| moduli[gear]);
            Material { young_modulus_mpa, ..given }
        })
    }

    /// Sets the constants of material and wear that follow the temperature of the teeth; none where the geometry has no pair.
    pub fn warm_up(&mut self) {
        let follows_modulus = Gear::BOTH.into_iter().any(|gear| self.modulus[gear].is_some());
        let follows = follows_modulus || Gear::BOTH.into_iter().any(|gear| self.wear[gear].warm.is_some());
        let Some(pair) = follows.then(|| GearPair::new(&self.pair).ok()).flatten() else { return };
        if let Some(moduli) = self.moduli_in(&pair, self.operation.heaviest_phase()) {
            for gear in Gear::BOTH {
                self.material[gear].young_modulus_mpa = moduli[gear];
            }
        }
        let in_each = follows_modulus && self.slices.is_none() && self.calibration_file.is_none();
        let phases: Vec<Phase> = self
            .operation
            .phases
            .iter()
            .map(|phase| {
                let young_modulus_mpa = in_each.then(|| self.moduli_in(&pair, phase)).flatten();
                let warm = Phase { young_modulus_mpa, ..*phase };
                let teeth = self.teeth_in(&pair, &warm).unwrap_or_default();
                Phase { flank_c: teeth.map(|tooth| tooth.map(|tooth| tooth.flank_c)), ..warm }
            })
            .collect();
        self.operation.phases = phases;
    }

    /// Young's moduli at the temperatures that teeth with them have in `phase`, MPa; none where nobody asks for these. Friction that depends on
    /// pressure depends on them in turn: the coefficient is bisected that makes the temperatures under which it is itself.
    pub fn moduli_in(&self, pair: &GearPair, phase: &Phase) -> Option<PerGear<f64>> {
        let heat = self.heat?;
        let moduli_under = |friction: f64| {
            let teeth = self.teeth_under(pair, phase, friction)?;
            Some(PerGear::from_fn(|gear| match (&self.modulus[gear], teeth[gear]) {
                (Some(modulus), Some(tooth)) => modulus.at(tooth.mean_c()),
                _ => self.material[gear].young_modulus_mpa,
            }))
        };
        let friction_of = |young_modulus_mpa: PerGear<f64>| {
            let warm = Phase { young_modulus_mpa: Some(young_modulus_mpa), ..*phase };
            mean_friction(&heat, self.running_in(pair, &warm).as_ref())
        };
        let cold = friction_of(moduli_under(0.0)?);
        let (mut low, mut high) = (0.0, 2.0 * cold);
        let mut moduli = moduli_under(cold)?;
        // What does not depend on them is there at once.
        if friction_of(moduli) == cold {
            return Some(moduli);
        }
        while friction_of(moduli_under(high)?) > high && high < GREATEST_FRICTION {
            high *= 2.0;
        }
        for _ in 0..BISECTIONS {
            let middle = 0.5 * (low + high);
            moduli = moduli_under(middle)?;
            if friction_of(moduli) > middle { low = middle } else { high = middle }
        }
        Some(moduli)
    }
}

/// μ of the heat: as given, or the mean of the mesh.
pub fn mean_friction(settings: &HeatSettings, running: Option<&RunningPair<'_>>) -> f64 {
    settings.friction_coefficient.unwrap_or_else(|| running.map_or(0.0, RunningPair::mean_friction))
}
