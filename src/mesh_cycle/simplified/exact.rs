//! The equilibrium of a phase by the general solver: where the fast one gives up.
//!
//! Every contact becomes a [`PairContact`] of the closed form itself, whose gap is given; teeth and their coupling are those of the
//! general mesh cycle ([`crate::mesh_cycle::sliced`]).

use crate::contact::{Felt, Footprint, PairContact, Response, Sweep, hertz, settings::Material};
use crate::gear::{Gear, GearPair, PerGear};
use crate::mesh_cycle::{
    bent_tooth::BentTooth,
    load_sharing::{Equilibrium, EquilibriumError, MeshedPair, balance},
    phases::SliceContact,
    sliced::SpringAlongPath,
    sliced_sharing::balance_on_teeth,
    sliced_teeth::SlicedTeeth,
};
use crate::reference::flattening::Flattening;

/// A contact whose gap is known.
struct GivenGap {
    flattening: Flattening,
    /// Approach at which the flanks touch.
    gap_mm: f64,
}

impl PairContact for GivenGap {
    fn read(&mut self, _removed_mm: PerGear<&[f64]>) {}

    fn touch_mm(&self) -> f64 {
        self.gap_mm
    }

    fn press(&mut self, depth_mm: f64) -> Response {
        let line_load_n_per_mm = self.flattening.line_load_n_per_mm(depth_mm);
        let (_, compliance) = self.flattening.approach_and_compliance(line_load_n_per_mm);
        Response { line_load_n_per_mm, stiffness_n_per_mm2: 1.0 / compliance }
    }

    fn ample_depth_mm(&self, line_load_n_per_mm: f64) -> f64 {
        self.flattening.approach_mm(line_load_n_per_mm)
    }

    fn sweep(&self, _gear: Gear, _removed_mm: PerGear<&[f64]>, sweep: &mut Sweep) {
        *sweep = Sweep::default();
    }

    fn felt(&self, _gear: Gear, _removed_mm: PerGear<&[f64]>) -> Vec<Felt> {
        Vec::new()
    }

    fn footprint(&self) -> Footprint {
        Footprint::default()
    }
}

/// What the general solver is told of a phase beside its gaps.
pub struct Springs<'a> {
    /// The gears.
    pub pair: &'a GearPair,
    /// What they are made of.
    pub material: &'a PerGear<Material>,
    /// Compliance of the teeth.
    pub along_path: SpringAlongPath,
    /// The slices and their coupling.
    pub sliced: &'a SlicedTeeth,
    /// Sum of all line loads.
    pub line_load_n_per_mm: f64,
}

impl Springs<'_> {
    /// Line load of every contact with its gap, and the equilibrium.
    ///
    /// # Errors
    /// [`EquilibriumError`].
    pub fn balance(
        &self,
        contacts: &[SliceContact],
        gap_mm: impl Iterator<Item = f64>,
        position_mm: f64,
    ) -> Result<(Vec<f64>, Equilibrium), EquilibriumError> {
        let compliance = |contact: &SliceContact| self.along_path.mm2_per_n(contact.cell.position_mm);
        let coupling = self.sliced.coupling.as_ref();
        let mut pairs: Vec<MeshedPair<'_>> = contacts
            .iter()
            .zip(gap_mm)
            .map(|(contact, gap_mm)| {
                let flattening = hertz::flattening(self.pair, self.material, contact.cell.position_mm);
                let teeth = if coupling.is_some() { f64::INFINITY } else { 1.0 / compliance(contact) };
                let mut pair = MeshedPair::new(Box::new(GivenGap { flattening, gap_mm }), teeth);
                let nothing = PerGear { pinion: &[][..], wheel: &[][..] };
                pair.read(nothing);
                pair
            })
            .collect();
        let equilibrium = match coupling {
            None => balance(&mut pairs, self.line_load_n_per_mm, position_mm)?,
            Some(coupling) => {
                let mut teeth = BentTooth::of_phase(contacts, self.sliced.slices.count(), compliance);
                balance_on_teeth(&mut pairs, &mut teeth, coupling, self.line_load_n_per_mm, position_mm)?
            }
        };
        Ok((pairs.iter().map(|pair| pair.response.line_load_n_per_mm).collect(), equilibrium))
    }
}
