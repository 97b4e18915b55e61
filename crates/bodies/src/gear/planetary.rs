//! Planetary stage of a sun, planets on a carrier and a ring: speeds, torques, conditions of assembly and phases of the meshes.
//!
//! Seen from the carrier the stage is a train with standing axes, in which the sun drives the planets and these the ring (Willis):
//!
//! ```text
//! (n_s − n_c) z_s = −(n_r − n_c) z_r        speeds; z_s, z_r > 0
//! T_s/z_s = T_r/z_r = −T_c/(z_s + z_r)      torques without losses
//! ```
//!
//! Each tooth of the sun meets N planets while the sun turns once relative to the carrier, that is N (n_s − n_c)/n_s in one of its own revolutions; 3.24
//! for 19/81 teeth and four planets.
//!
//! **Assembly.** Planets at the angles ψ_i can be put in where (z_s + z_r) ψ_i/2π is a whole number, and neighbours pass one another where
//! 2 a sin(Δψ/2) > d_a of the planet.
//!
//! **Phases.** In units of the base pitch, with 0 where contact passes the pitch point C, the mesh of planet i with the sun is −z_s ψ_i/2π ahead of that of the
//! first planet, and by the condition of assembly its mesh with the ring is ahead of its mesh with the sun by the same for all planets,
//!
//! ```text
//! γ = (h_1 + h_2 − π) z_p/2π        h: half thickness angles of the planet's tooth on its working circles with sun and ring
//! ```
//!
//! since sun and ring touch opposite flanks of a planet at places opposite one another. Sources: VDI 2157; Parker and Lin, J. Mech. Des. 126 (2004) 365,
//! whose γ for standard planets is ½ of an even number of teeth and 0 of an odd one.

use std::f64::consts::{PI, TAU};

use super::{Gear, GearPair};

/// Rotating member of a stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs, reason = "the names say it")]
pub enum Member {
    Sun,
    Carrier,
    Ring,
}

impl Member {
    /// All three.
    pub const ALL: [Member; 3] = [Member::Sun, Member::Carrier, Member::Ring];

    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Member::Sun => "sun",
            Member::Carrier => "carrier",
            Member::Ring => "ring",
        }
    }
}

/// Teeth and planets of a stage.
#[derive(Debug, Clone, PartialEq)]
pub struct PlanetaryStage {
    /// Number of teeth of the sun.
    pub sun_teeth: u32,
    /// Number of teeth of each planet.
    pub planet_teeth: u32,
    /// Number of teeth of the ring, positive.
    pub ring_teeth: u32,
    /// Angle of each planet on the carrier in rad, rising from 0 of the first.
    pub planet_angles_rad: Vec<f64>,
    /// Member that stands still.
    pub held: Member,
}

/// Tolerance of the condition of assembly, in pitches: angles are given with three decimals of a degree.
const PITCH_ROUNDING: f64 = 2e-3;
/// Phase that counts as none, base pitches.
const PHASE_ROUNDING: f64 = 1e-9;

/// Reason why planets cannot be put in.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum AssemblyError {
    /// Teeth and spaces do not meet at a planet.
    #[error(
        "planet {planet} at {angle_deg:.4}° cannot be assembled: ({sun_teeth} + {ring_teeth}) × {angle_deg:.4}°/360° = {pitches:.4} is no whole number"
    )]
    NoWholePitch {
        /// Number of the planet, from 1.
        planet: usize,
        /// Angle of the planet.
        angle_deg: f64,
        /// Number of teeth of the sun.
        sun_teeth: u32,
        /// Number of teeth of the ring.
        ring_teeth: u32,
        /// Pitches of sun and ring together up to the planet.
        pitches: f64,
    },
    /// Neighbouring planets touch.
    #[error(
        "planets {first} and {second} touch: their axes are {axes_mm:.4} mm apart, and the tip diameter of a planet is {tip_diameter_mm:.4} mm"
    )]
    PlanetsTouch {
        /// Number of the first planet, from 1.
        first: usize,
        /// Number of its neighbour.
        second: usize,
        /// Distance of the axes.
        axes_mm: f64,
        /// Tip diameter of a planet.
        tip_diameter_mm: f64,
    },
}

impl PlanetaryStage {
    /// Number of planets.
    pub fn planets(&self) -> usize {
        self.planet_angles_rad.len()
    }

    /// `planets` angles of equal spacing, rad.
    pub fn equal_angles_rad(planets: usize) -> Vec<f64> {
        (0..planets).map(|planet| TAU * planet as f64 / planets as f64).collect()
    }

    /// Speed of each member, the held one 0, per unit of speed of `member`; `None` where that is the held one.
    pub fn speed(&self, of: Member, member: Member) -> Option<f64> {
        let [sun, ring] = [self.sun_teeth, self.ring_teeth].map(f64::from);
        // Any multiple of the speeds.
        let speed = |member| match (self.held, member) {
            (held, member) if held == member => 0.0,
            (Member::Ring, Member::Sun) | (Member::Sun, Member::Ring) => sun + ring,
            (Member::Ring, _) => sun,
            (Member::Sun, _) => ring,
            (Member::Carrier, Member::Sun) => ring,
            (Member::Carrier, _) => -sun,
        };
        (member != self.held).then(|| speed(of) / speed(member))
    }

    /// Revolutions of the sun relative to the carrier in one revolution of `member`, without sign; `None` where that is the held one.
    pub fn sun_turns_relative_to_carrier(&self, member: Member) -> Option<f64> {
        Some((self.speed(Member::Sun, member)? - self.speed(Member::Carrier, member)?).abs())
    }

    /// Torque on the sun per unit of torque on `member`, without losses and without sign.
    pub fn sun_torque(&self, member: Member) -> f64 {
        let [sun, ring] = [self.sun_teeth, self.ring_teeth].map(f64::from);
        match member {
            Member::Sun => 1.0,
            Member::Ring => sun / ring,
            Member::Carrier => sun / (sun + ring),
        }
    }

    /// Refuses planets between which sun and ring do not fit.
    ///
    /// # Errors
    /// [`AssemblyError::NoWholePitch`]
    pub fn check_assembly(&self) -> Result<(), AssemblyError> {
        let teeth = f64::from(self.sun_teeth) + f64::from(self.ring_teeth);
        for (index, angle) in self.planet_angles_rad.iter().enumerate() {
            let pitches = teeth * angle / TAU;
            if (pitches - pitches.round()).abs() > PITCH_ROUNDING {
                return Err(AssemblyError::NoWholePitch {
                    planet: index + 1,
                    angle_deg: angle.to_degrees(),
                    sun_teeth: self.sun_teeth,
                    ring_teeth: self.ring_teeth,
                    pitches,
                });
            }
        }
        Ok(())
    }

    /// Least distance between the tip circles of neighbouring planets at this centre distance, mm; `None` for one planet.
    ///
    /// # Errors
    /// [`AssemblyError::PlanetsTouch`] where it is not positive.
    pub fn planet_clearance_mm(
        &self,
        centre_distance_mm: f64,
        tip_diameter_mm: f64,
    ) -> Result<Option<f64>, AssemblyError> {
        let angles = &self.planet_angles_rad;
        let mut least: Option<f64> = None;
        for first in 0..angles.len() {
            let second = (first + 1) % angles.len();
            if first == second {
                return Ok(None);
            }
            let apart = (angles[second] - angles[first]).rem_euclid(TAU);
            let axes_mm = 2.0 * centre_distance_mm * (0.5 * apart).sin().abs();
            if axes_mm <= tip_diameter_mm {
                return Err(AssemblyError::PlanetsTouch {
                    first: first + 1,
                    second: second + 1,
                    axes_mm,
                    tip_diameter_mm,
                });
            }
            least = Some(least.unwrap_or(f64::INFINITY).min(axes_mm - tip_diameter_mm));
        }
        Ok(least)
    }

    /// Base pitches by which each planet's mesh with the sun is ahead of that of the first planet, 0 to below 1.
    pub fn phases(&self) -> Vec<f64> {
        self.planet_angles_rad.iter().map(|angle| fraction(-f64::from(self.sun_teeth) * angle / TAU)).collect()
    }
}

/// Base pitches γ by which the mesh of a planet with the ring is ahead of its mesh with the sun, 0 to below 1: of the pairs sun and planet, planet and ring.
pub fn ring_mesh_phase(sun_and_planet: &GearPair, planet_and_ring: &GearPair) -> f64 {
    let [with_sun, with_ring] = [(sun_and_planet, Gear::Wheel), (planet_and_ring, Gear::Pinion)]
        .map(|(pair, planet)| pair.teeth[planet].half_angle_rad(pair.working_pitch_radius_mm(planet)));
    let planet_teeth = f64::from(planet_and_ring.spec.gears.pinion.teeth);
    fraction((with_sun + with_ring - PI) * planet_teeth / TAU)
}

/// Part of a number beyond the next whole one below it; 0 for one that is whole but for rounding.
fn fraction(pitches: f64) -> f64 {
    if (pitches - pitches.round()).abs() < PHASE_ROUNDING { 0.0 } else { pitches.rem_euclid(1.0) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn stage(teeth: [u32; 3], planets: usize, held: Member) -> PlanetaryStage {
        let [sun_teeth, planet_teeth, ring_teeth] = teeth;
        let planet_angles_rad = PlanetaryStage::equal_angles_rad(planets);
        PlanetaryStage { sun_teeth, planet_teeth, ring_teeth, planet_angles_rad, held }
    }

    /// Zhao et al., IEEE Trans. Reliability 67 (2018) 316: 19/31/81 with four planets, 3.24 meshes of the sun a revolution.
    #[test]
    fn val_meshes_of_the_sun_per_revolution() {
        let stage = stage([19, 31, 81], 4, Member::Ring);
        assert!((4.0 * stage.sun_turns_relative_to_carrier(Member::Sun).unwrap() - 3.24).abs() < 1e-12);
    }

    /// VDI 2157: ratios 1 + z_r/z_s with a standing ring, −z_r/z_s with a standing carrier, 1 + z_s/z_r of ring over carrier with a standing sun; power is
    /// kept, and torques balance.
    #[test]
    fn ver_speeds_and_torques() {
        let [z_s, z_r] = [19.0, 81.0];
        let of = |held| stage([19, 31, 81], 4, held);
        assert!((of(Member::Ring).speed(Member::Sun, Member::Carrier).unwrap() - (1.0 + z_r / z_s)).abs() < 1e-12);
        assert!((of(Member::Carrier).speed(Member::Sun, Member::Ring).unwrap() + z_r / z_s).abs() < 1e-12);
        assert!((of(Member::Sun).speed(Member::Ring, Member::Carrier).unwrap() - (1.0 + z_s / z_r)).abs() < 1e-12);
        for held in Member::ALL {
            let stage = of(held);
            assert_eq!(stage.speed(Member::Sun, held), None);
            for member in Member::ALL.into_iter().filter(|&member| member != held) {
                let speed = |of| stage.speed(of, member).unwrap();
                let torque = |of| 1.0 / stage.sun_torque(of);
                let power = speed(Member::Sun) * torque(Member::Sun) + speed(Member::Ring) * torque(Member::Ring)
                    - speed(Member::Carrier) * torque(Member::Carrier);
                assert!(power.abs() < 1e-12, "{held:?} {member:?}: {power}");
                let willis = (speed(Member::Sun) - speed(Member::Carrier)) * z_s
                    + (speed(Member::Ring) - speed(Member::Carrier)) * z_r;
                assert!(willis.abs() < 1e-12, "{held:?} {member:?}: {willis}");
            }
        }
    }

    #[test]
    fn planets_that_cannot_be_assembled_or_touch_are_refused() {
        assert_eq!(stage([19, 31, 81], 4, Member::Ring).check_assembly(), Ok(()));
        let error = stage([19, 31, 81], 3, Member::Ring).check_assembly().unwrap_err();
        assert!(error.to_string().contains("= 33.3333 is no whole number"), "{error}");
        let mut uneven = stage([19, 31, 81], 3, Member::Ring);
        uneven.planet_angles_rad = [0.0, 118.8, 241.2].map(f64::to_radians).to_vec();
        assert_eq!(uneven.check_assembly(), Ok(()));
        let stage = stage([20, 40, 100], 6, Member::Ring);
        let gap_mm = stage.planet_clearance_mm(60.0, 59.0).unwrap().unwrap();
        assert!((gap_mm - 1.0).abs() < 1e-9, "{gap_mm}");
        let error = stage.planet_clearance_mm(60.0, 84.0).unwrap_err();
        assert!(matches!(error, AssemblyError::PlanetsTouch { first: 1, second: 2, .. }), "{error}");
    }

    /// A whole number of teeth of the sun per planet puts all meshes in phase; otherwise the planets share a pitch evenly.
    #[test]
    fn ver_phases_of_equally_spaced_planets() {
        assert_eq!(stage([18, 30, 78], 3, Member::Ring).phases(), [0.0; 3]);
        let mut phases = stage([19, 31, 81], 4, Member::Ring).phases();
        phases.sort_by(f64::total_cmp);
        for (phase, expected) in phases.iter().zip([0.0, 0.25, 0.5, 0.75]) {
            assert!((phase - expected).abs() < 1e-9, "{phases:?}");
        }
    }

    /// The phase is the part of a pitch by which the sun's flank that passed the line of centres last has gone beyond it, turning anticlockwise, flank by flank:
    /// where angles are unequal, its sign matters.
    #[test]
    fn ver_phases_are_those_of_the_flank_that_passed_last() {
        let mut stage = stage([21, 21, 63], 3, Member::Ring);
        stage.planet_angles_rad = [0.0, 124.285_714_285_714_29, 240.0].map(f64::to_radians).to_vec();
        assert_eq!(stage.check_assembly(), Ok(()));
        let pitch = TAU / 21.0;
        for (angle, phase) in stage.planet_angles_rad.iter().zip(stage.phases()) {
            let beyond = (0..=21).map(|flank| f64::from(flank) * pitch - angle).filter(|beyond| *beyond > -1e-9);
            let least = beyond.fold(f64::INFINITY, f64::min);
            assert!((phase - least / pitch).abs() < 1e-6, "{phase} at {angle}: {}", least / pitch);
        }
    }
}
