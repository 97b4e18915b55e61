//! What a wear run of a pair with slices is made of, beside the pair itself.

use std::sync::Arc;

use super::bent_tooth::BentTooth;
use super::coupled_teeth::{CoupledTeeth, TeethTogether};
use super::influence::Influence;
use super::pair_in_space::PairInSpace;
use super::settings::{Coupling, SliceSettings};
use super::slice_coupling::{Reach, SliceCompliance, SliceCoupling};
use super::sliced::SpringAlongPath;
use super::sliced_positions::SliceContact;
use crate::gear::{Gear, GearPair, PerGear, slices::Slices};
use crate::material::Material;

/// The slices of a pair, and how they hold each other.
#[derive(Clone)]
pub struct SlicedTeeth {
    /// As asked for.
    pub settings: SliceSettings,
    /// Where they are.
    pub slices: Slices,
    /// How they yield where they are not coupled in space.
    compliance: SliceCompliance,
    /// Compliance of the teeth of each slice over that of the section.
    softness: Arc<[f64]>,
    model: Model,
    /// What the twist of the shafts adds between slices, of whatever tooth, mm²/N, row by row; none where nothing twists.
    twist: Option<Arc<[f64]>>,
}

/// How slices are coupled.
#[derive(Clone)]
enum Model {
    /// Not at all.
    Thin,
    /// Each tooth is a plate.
    Plate(SliceCoupling),
    /// All teeth in space.
    InSpace(Arc<PairInSpace>),
}

impl SlicedTeeth {
    /// Of a pair, coupled as `settings` say; `in_space` where that is by teeth in space, which are the same whatever the slices.
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
            Coupling::None => Model::Thin,
            Coupling::Slicing => Model::Plate(compliance.coupling(&slices)),
            Coupling::Fem => Model::InSpace(in_space.expect("the coupling by teeth in space comes with them")),
        };
        let softness = match settings.coupling {
            Coupling::Fem => vec![1.0; settings.count].into(),
            Coupling::None | Coupling::Slicing => compliance.of_slices(pair, &slices).into(),
        };
        let twist = twist(pair, material, &slices).map(Arc::from);
        Self { settings, slices, compliance, softness, model, twist }
    }

    /// Compliance of the teeth at a contact, mm²/N, by that of their section along the path of contact.
    pub fn mm2_per_n(&self, contact: &SliceContact, section: &SpringAlongPath) -> f64 {
        section.at(contact.cell.position_mm).mm2_per_n(self.softness[contact.slice])
    }

    /// Least and greatest compliance of the teeth of a slice over that of the section.
    pub fn softness(&self) -> [f64; 2] {
        self.softness.iter().fold([f64::INFINITY, 0.0], |[least, most], &of| [of.min(least), of.max(most)])
    }

    /// Compliance of the bodies that all pairs in mesh share, where the section's is given, mm²/N; those of teeth in space are part of what
    /// couples them.
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
        !matches!(self.model, Model::Thin) || self.twist.is_some()
    }

    /// The teeth in space, where they couple the slices.
    pub fn in_space(&self) -> Option<&Arc<PairInSpace>> {
        match &self.model {
            Model::InSpace(teeth) => Some(teeth),
            Model::Thin | Model::Plate(_) => None,
        }
    }

    /// How far a deflection reaches along a tooth that is a plate.
    pub fn reach(&self) -> Option<Reach> {
        match &self.model {
            Model::Plate(coupling) => Some(coupling.reach),
            Model::Thin | Model::InSpace(_) => None,
        }
    }

    /// The teeth that `contacts`, tooth by tooth, belong to, not yet bent, where the pair has the compliance `mm2_per_n` at a contact;
    /// none where slices are not coupled.
    pub fn coupled_teeth(
        &self,
        pair: &GearPair,
        contacts: &[SliceContact],
        mm2_per_n: impl Fn(&SliceContact) -> f64,
    ) -> Option<CoupledTeeth> {
        let mut influence = match (&self.model, &self.twist) {
            (Model::Thin, None) => return None,
            (Model::Plate(coupling), None) => {
                return Some(CoupledTeeth::Plates {
                    teeth: BentTooth::of_phase(contacts, self.slices.count(), mm2_per_n),
                    coupling: coupling.clone(),
                });
            }
            (Model::Thin, Some(_)) => Influence::of_thin_slices(contacts, mm2_per_n),
            (Model::Plate(coupling), Some(_)) => coupling.influence(contacts, mm2_per_n),
            (Model::InSpace(teeth), _) => teeth.influence(pair, &self.slices, contacts, mm2_per_n),
        };
        if let Some(twist) = &self.twist {
            influence.add(|a, b| twist[contacts[a].slice * self.slices.count() + contacts[b].slice]);
        }
        Some(CoupledTeeth::Together(TeethTogether::new(influence)))
    }
}

/// What the twist of both shafts adds between slices, mm²/N, row by row; none where nothing twists.
fn twist(pair: &GearPair, material: &PerGear<Material>, slices: &Slices) -> Option<Vec<f64>> {
    let of_gear = |gear: Gear| {
        let shaft = pair.spec.gears[gear].shaft?;
        let shear_modulus_mpa = material[gear].elastic().shear_modulus_mpa();
        Some(shaft.mm2_per_n(pair.teeth[gear].involute.base_radius_mm, shear_modulus_mpa, slices))
    };
    let sum = |a: Vec<f64>, b: Vec<f64>| a.iter().zip(&b).map(|(a, b)| a + b).collect();
    Gear::BOTH.into_iter().filter_map(of_gear).reduce(sum)
}
