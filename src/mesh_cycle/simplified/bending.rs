//! The teeth of a phase where their slices hold each other, for contacts side by side: [`crate::mesh_cycle::bent_tooth`] on the
//! tangents of [`super::loaded`].

use super::lanes::LANES;
use super::loaded_position::{Pack, Tangent};
use crate::mesh_cycle::bent_tooth::{BentTooth, ContactTangent, bend};
use crate::mesh_cycle::slice_coupling::SliceCoupling;

/// The teeth of a phase.
pub(crate) struct BentTeeth<'a> {
    /// Each.
    pub teeth: &'a mut [BentTooth],
    /// How their slices hold each other.
    pub coupling: &'a SliceCoupling,
}

impl BentTeeth<'_> {
    /// Bends the teeth for the Newton step of `tangents`, adds their deflection to its approaches, and gives δ; not a number where no
    /// contact carries.
    pub(crate) fn bend(&mut self, packs: &[Pack], tangents: &mut [Tangent], line_load: f64) -> f64 {
        let tangent = |at: usize| {
            let (pack, lane) = (at / LANES, at % LANES);
            ContactTangent {
                line_load_n_per_mm: packs[pack].load.0[lane],
                n_per_mm2: tangents[pack].n_per_mm2.0[lane],
                approach_mm: tangents[pack].approach_mm.0[lane],
            }
        };
        let Some(approach_mm) = bend(self.teeth, self.coupling, line_load, tangent) else { return f64::NAN };
        for (at, _, deflection_mm) in self.teeth.iter().flat_map(BentTooth::deflections_mm) {
            tangents[at / LANES].approach_mm.0[at % LANES] += deflection_mm;
        }
        approach_mm
    }
}
