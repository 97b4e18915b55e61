//! The slices of a pair over the face width, with the compliance and the coupling of their teeth.

use std::sync::Arc;

use super::bent_tooth::BentTooth;
use super::coupled_teeth::{CoupledTeeth, TeethTogether};
use super::influence::Influence;
use super::pair_in_space::PairInSpace;
use super::settings::{Coupling, SliceSettings};
use super::slice_coupling::{Reach, SliceCompliance, SliceCoupling};
use super::sliced_positions::SliceContact;
use super::spring_along_path::SpringAlongPath;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, slices::Slices};
use gearwear_bodies::material::Material;

/// Slices of a pair with their coupling.
#[derive(Clone)]
pub struct SlicedTeeth {
    /// Settings.
    pub settings: SliceSettings,
    /// Places over the face width.
    pub slices: Slices,
    /// Compliance where they are not coupled in space.
    compliance: SliceCompliance,
    /// Compliance of the teeth of each slice over that of the section.
    softness: Arc<[f64]>,
    model: SliceModel,
    /// Compliance by twist and bending of the shafts between slices of any teeth, mm²/N, row by row; none where nothing twists.
    twist: Option<Arc<[f64]>>,
}

/// Coupling of slices.
#[derive(Clone)]
enum SliceModel {
    /// Thin, independent slices.
    Thin,
    /// Teeth as plates.
    Plate(SliceCoupling),
    /// Teeth in space.
    InSpace(Arc<PairInSpace>),
}

impl SlicedTeeth {
    /// Slices of a pair, coupled by `settings`; `in_space` for coupling by teeth in space, which do not depend on the slices.
    ///
    /// # Panics
    /// Where the coupling is by teeth in space and there are none.
    pub fn new(
        pair: &GearPair,
        material: &PerGear<Material>,
        settings: SliceSettings,
        compliance: SliceCompliance,
        in_space: Option<Arc<PairInSpace>>,
    ) -> Self {
        let slices = Slices::new(pair, settings.count);
        let model = match settings.coupling {
            Coupling::None => SliceModel::Thin,
            Coupling::Slicing => SliceModel::Plate(compliance.coupling(&slices)),
            Coupling::Fem => SliceModel::InSpace(in_space.expect("the coupling by teeth in space comes with them")),
        };
        let softness = match settings.coupling {
            Coupling::Fem => vec![1.0; settings.count].into(),
            Coupling::None | Coupling::Slicing => compliance.of_slices(pair, &slices).into(),
        };
        let twist = twist(pair, material, &slices).map(Arc::from);
        Self { settings, slices, compliance, softness, model, twist }
    }

    /// Compliance of the teeth at a contact, mm²/N, from that of their section along the path of contact.
    pub fn mm2_per_n(&self, contact: &SliceContact, section: &SpringAlongPath) -> f64 {
        section.at(contact.cell.position_mm).mm2_per_n(self.softness[contact.slice])
    }

    /// Least and greatest compliance of the teeth of a slice over that of the section.
    pub fn softness(&self) -> [f64; 2] {
        self.softness.iter().fold([f64::INFINITY, 0.0], |[least, most], &of| [of.min(least), of.max(most)])
    }

    /// Compliance of the bodies that all pairs in mesh share, mm²/N, from that of the section; 0 for teeth in space, whose coupling includes
    /// them.
    pub fn bodies_mm2_per_n(&self, section_mm2_per_n: f64) -> f64 {
        if self.in_space().is_some() { 0.0 } else { self.compliance.bodies * section_mm2_per_n }
    }

    /// Slices of the same teeth, `count` in number.
    pub fn with_count(&self, pair: &GearPair, material: &PerGear<Material>, count: usize) -> Self {
        let settings = SliceSettings { count, ..self.settings };
        Self::new(pair, material, settings, self.compliance, self.in_space().cloned())
    }

    /// Whether the slices of a tooth act on each other.
    pub(crate) fn is_coupled(&self) -> bool {
        !matches!(self.model, SliceModel::Thin) || self.twist.is_some()
    }

    /// The teeth in space, where they couple the slices.
    pub fn in_space(&self) -> Option<&Arc<PairInSpace>> {
        match &self.model {
            SliceModel::InSpace(teeth) => Some(teeth),
            SliceModel::Thin | SliceModel::Plate(_) => None,
        }
    }

    /// Reach of a deflection along a tooth as a plate.
    pub fn reach(&self) -> Option<Reach> {
        match &self.model {
            SliceModel::Plate(coupling) => Some(coupling.reach),
            SliceModel::Thin | SliceModel::InSpace(_) => None,
        }
    }

    /// Teeth of `contacts`, tooth by tooth, not yet bent, where the pair has the compliance `mm2_per_n` at a contact; none where slices are not
    /// coupled.
    pub fn coupled_teeth(
        &self,
        pair: &GearPair,
        contacts: &[SliceContact],
        mm2_per_n: impl Fn(&SliceContact) -> f64,
    ) -> Option<CoupledTeeth> {
        let mut influence = match (&self.model, &self.twist) {
            (SliceModel::Thin, None) => return None,
            (SliceModel::Plate(coupling), None) => {
                return Some(CoupledTeeth::Plates {
                    teeth: BentTooth::of_contacts(contacts, self.slices.count(), mm2_per_n),
                    coupling: coupling.clone(),
                });
            }
            (SliceModel::Thin, Some(_)) => Influence::of_thin_slices(contacts, mm2_per_n),
            (SliceModel::Plate(coupling), Some(_)) => coupling.influence(contacts, mm2_per_n),
            (SliceModel::InSpace(teeth), _) => teeth.influence(pair, &self.slices, contacts, mm2_per_n),
        };
        if let Some(twist) = &self.twist {
            influence.add(|a, b| twist[contacts[a].slice * self.slices.count() + contacts[b].slice]);
        }
        Some(CoupledTeeth::Together(Box::new(TeethTogether::new(influence))))
    }
}

/// Compliance by twist and bending of both shafts between slices, mm²/N, row by row; none where nothing twists.
fn twist(pair: &GearPair, material: &PerGear<Material>, slices: &Slices) -> Option<Vec<f64>> {
    let twists = Gear::BOTH.into_iter().filter_map(|gear| {
        let shaft = pair.spec.gears[gear].shaft?;
        let shear_modulus_mpa = material[gear].elastic().shear_modulus_mpa();
        let mut compliance = shaft.mm2_per_n(pair.teeth[gear].involute.base_radius_mm, shear_modulus_mpa, slices);
        if let Some(beam) = shaft.beam(pair.tooth_force_direction(gear), material[gear].young_modulus_mpa) {
            compliance.iter_mut().zip(beam.mm2_per_n(slices)).for_each(|(twist, bending)| *twist += bending);
        }
        Some(compliance)
    });
    twists.reduce(|pinion, wheel| pinion.iter().zip(&wheel).map(|(a, b)| a + b).collect())
}
