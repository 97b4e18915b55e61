//! Check that contact surface and stiffness model of a scene are compatible, in closed form and before any work.

use super::stage_clock::StageClock;
use super::{RunError, RunInputs, contact_case};
use crate::contact::settings::SurfaceKind;
use crate::observer::Unwatched;
use crate::stiffness::settings::StiffnessSettings;
use gearwear_bodies::gear::GearPair;

impl RunInputs<'_> {
    /// Checks that every spring of the run has a positive compliance, where that is known without finite elements of the run itself.
    ///
    /// # Errors
    /// The same as the run's.
    pub fn check_springs(self) -> Result<(), RunError> {
        let scene = self.scene;
        let curve = match (scene.stiffness, self.calibration) {
            (StiffnessSettings::Fem, Some(calibration)) => Some(&calibration.pair_compliance),
            (StiffnessSettings::Fem, None) => return Ok(()),
            _ => self.stiffness_curve,
        };
        if scene.contact.surface == SurfaceKind::Fem {
            return Ok(());
        }
        let pair = GearPair::new(&scene.pair)?;
        let mut stages = StageClock::new(&Unwatched);
        for phase in &scene.operation.phases {
            let (load, material) = (pair.line_load_n_per_mm(phase.pinion_torque_n_mm), scene.material_in(phase));
            let case = contact_case::contact_case(self, &pair, material, load, &mut stages)?;
            let Some(spring) = case.spring(scene.stiffness, curve, &pair)? else { continue };
            for position_mm in pair.path.evenly_mm(scene.numerics.positions) {
                spring.own_n_per_mm2(position_mm)?;
            }
        }
        Ok(())
    }
}
