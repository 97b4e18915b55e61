//! Equilibrium of a position by the general solver, where the fast one fails.
//!
//! Every contact is a [`PairContact`] of the closed form with a given gap; teeth and their coupling are those of the general mesh cycle ([`crate::mesh_cycle::sliced`]).

use crate::contact::{Footprint, PairContact, PointContact, PressedCell, Response, Sweep, hertz};
use crate::mesh_cycle::{
    load_sharing::{EquilibriumError, MeshedPair, PairEquilibrium, balance},
    sliced_positions::SliceContact,
    sliced_sharing::balance_on_teeth,
    sliced_teeth::SlicedTeeth,
    spring_along_path::SpringAlongPath,
};
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::material::Material;
use gearwear_bodies::reference::flattening::Flattening;

/// A contact with a given gap.
struct GivenGap {
    flattening: Flattening,
    /// Approach along the normal at which the flanks touch.
    gap_mm: f64,
}

impl PairContact for GivenGap {
    fn set_removed(&mut self, _removed_mm: PerGear<&[f64]>) {}

    fn touch_mm(&self) -> f64 {
        self.gap_mm
    }

    fn load_at(&mut self, indentation_mm: f64) -> Response {
        let line_load_n_per_mm = self.flattening.line_load_n_per_mm(indentation_mm);
        let (_, compliance) = self.flattening.approach_and_compliance(line_load_n_per_mm);
        Response { line_load_n_per_mm, stiffness_n_per_mm2: 1.0 / compliance }
    }

    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64 {
        self.flattening.approach_mm(line_load_n_per_mm)
    }

    fn sweep(&self, _gear: Gear, _removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        *sweep = Sweep::default();
    }

    fn contact_of_points(&self, _gear: Gear, _removed_mm: PerGear<&[f64]>) -> Vec<PointContact> {
        Vec::new()
    }

    fn footprint(&self) -> Footprint {
        Footprint::default()
    }

    fn pressed_cells(&self) -> Vec<PressedCell> {
        Vec::new()
    }
}

/// Slices and teeth of a pair, for the general solver.
pub(crate) struct SlicesInSeries<'a> {
    /// The gears.
    pub pair: &'a GearPair,
    /// Material of each gear.
    pub material: &'a PerGear<Material>,
    /// Compliance of the teeth.
    pub along_path: SpringAlongPath,
    /// The slices and their coupling.
    pub sliced: &'a SlicedTeeth,
    /// Sum of all line loads.
    pub line_load_n_per_mm: f64,
}

impl SlicesInSeries<'_> {
    /// Line loads of contacts with these gaps, and their equilibrium.
    pub(crate) fn balance(
        &self,
        contacts: &[SliceContact],
        gap_mm: impl Iterator<Item = f64>,
        position_mm: f64,
    ) -> Result<(Vec<f64>, PairEquilibrium), EquilibriumError> {
        let mut teeth =
            self.sliced.coupled_teeth(self.pair, contacts, |contact| self.sliced.mm2_per_n(contact, &self.along_path));
        let coupled = teeth.is_some();
        let section = self.pair.normal_section();
        let mut pairs: Vec<MeshedPair<'_>> = contacts
            .iter()
            .zip(gap_mm)
            .map(|(contact, gap_mm)| {
                let gap_mm = section.obliquity.normal_mm(gap_mm);
                let flattening = hertz::flattening(&section, self.material, contact.cell.position_mm);
                let teeth_n_per_mm2 =
                    if coupled { f64::INFINITY } else { 1.0 / self.sliced.mm2_per_n(contact, &self.along_path) };
                let contact = Box::new(GivenGap { flattening, gap_mm });
                let mut pair = MeshedPair::on_lever(contact, teeth_n_per_mm2, 1.0, section.obliquity);
                let nothing = PerGear { pinion: &[][..], wheel: &[][..] };
                pair.set_removed(nothing);
                pair
            })
            .collect();
        let equilibrium = match &mut teeth {
            None => balance(&mut pairs, self.line_load_n_per_mm, position_mm)?,
            Some(teeth) => balance_on_teeth(&mut pairs, teeth, self.line_load_n_per_mm, position_mm)?,
        };
        Ok((pairs.iter().map(|pair| pair.response.line_load_n_per_mm).collect(), equilibrium))
    }
}
