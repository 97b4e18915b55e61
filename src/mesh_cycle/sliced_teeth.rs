//! What a wear run of a pair with slices is made of, beside the pair itself.

use super::settings::{Coupling, SliceSettings};
use super::slice_coupling::SliceCoupling;
use crate::contact::settings::Material;
use crate::gear::{GearPair, PerGear, slices::Slices};

/// The slices of a pair, and how they hold each other.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SlicedTeeth {
    /// As asked for.
    pub settings: SliceSettings,
    /// Where they are.
    pub slices: Slices,
    /// How they are coupled; none: thin independent teeth.
    pub coupling: Option<SliceCoupling>,
}

impl SlicedTeeth {
    /// Of a pair.
    pub(crate) fn new(pair: &GearPair, material: &PerGear<Material>, settings: SliceSettings) -> Self {
        let slices = Slices::new(pair, settings.count);
        let coupling = match settings.coupling {
            Coupling::None => None,
            Coupling::Slicing => Some(SliceCoupling::of_pair(pair, material, &slices)),
        };
        Self { settings, slices, coupling }
    }
}
