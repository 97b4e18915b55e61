//! What the finite-element model teaches the fast one: tooth stiffness and K/H along the path of contact.
//!
//! | module | what it finds |
//! |---|---|
//! | [`tooth_stiffness`] | how far the teeth yield under a known load anywhere on the path, bending and flattening apart |
//! | [`bodies`] | the pair's stiffness at C as resolution, rim and neighbours change |
//! | [`tooth_family`], [`stiffness_variation`] | the same as families of curves: by number of teeth, and over the path |
//! | [`single_contact`] | the pair alone in contact: half-width, peak pressure, approach by position and load |
//! | [`foundation_fit`] | K/H as a curve that a Winkler foundation can use, with its error where it was not fitted |
//! | [`slice_fit`] | how the slices of a pair yield together, from its teeth in space |
//! | [`wear_reference`] | what one mesh of unworn flanks wears |
//! | [`identity`], [`mod@file`] | what the calibration belongs to, and the file it is kept in |
//!
//! Everything is per mm of face width, elastic, without friction, and but for [`slice_fit`] in plane strain.

pub mod bodies;
pub mod file;
pub mod foundation_fit;
pub mod identity;
pub(crate) mod loaded_tooth;
pub mod single_contact;
pub mod slice_fit;
pub mod stiffness_variation;
pub mod tooth_family;
pub mod tooth_stiffness;
pub mod wear_reference;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use self::bodies::{NeighbourRow, ResolutionRow, RimRow};
use self::foundation_fit::FoundationFit;
use self::identity::Identity;
use self::single_contact::SingleContact;
use self::slice_fit::SliceFit;
use self::stiffness_variation::StiffnessVariation;
use self::tooth_family::FamilyMember;
use self::tooth_stiffness::{LoadedPair, PairDeflection};
use self::wear_reference::WearReference;
use crate::contact::{foundation::FoundationCurve, settings::MatchCriterion};
use crate::gear::{Gear, PerGear};
use crate::gear_fem::{condensed_pair::CondensedPair, model::ModelError};
use crate::material::Material;
use crate::stiffness::curve::PairCompliance;
use gearwear_fem::active_set::ActiveSetError;

/// Positions of the stiffness curve.
pub const STIFFNESS_POSITIONS: usize = 61;
/// Positions of the curve that a run makes for itself: straight lines between them are off by 1e-4.
const OWN_POSITIONS: usize = 31;

/// Why there is no calibration.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum CalibrationError {
    /// A gear cannot be modelled.
    #[error(transparent)]
    Model(#[from] ModelError),
    /// The contact of the pair alone was not found.
    #[error("contact at position {position_mm:.4} mm under {line_load_n_per_mm:.2} N/mm: {source}")]
    Contact {
        /// ξ.
        position_mm: f64,
        /// w.
        line_load_n_per_mm: f64,
        /// Why.
        source: ActiveSetError,
    },
    /// The strip of contact is wider than the flank.
    #[error("{}: the contact strip at position {position_mm:.4} mm does not fit on the flank", gear.name())]
    OffTheFlank {
        /// Whose.
        gear: Gear,
        /// ξ.
        position_mm: f64,
    },
    /// The strip of contact is as wide as the whole path.
    #[error("under {line_load_n_per_mm:.2} N/mm no contact strip keeps clear of the tip edges")]
    NoClearPosition {
        /// w.
        line_load_n_per_mm: f64,
    },
}

/// A calibration of one gear pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Calibration {
    /// Program that made it.
    pub program_version: String,
    /// SHA-256 of everything else (as the file is written, without it).
    pub hash: String,
    /// What it belongs to.
    pub belongs_to: Identity,
    /// Elements per half-width of contact of the mesh it was made with.
    pub elements_per_half_width: f64,
    /// The scene's whole line load: that of the stiffness curve, and the unit of the loads of K/H, N/mm.
    pub line_load_n_per_mm: f64,
    /// Points A to E of the path of contact, mm.
    pub path_points_mm: [f64; 5],
    /// Compliance of a tooth pair for the fast model: the whole one by finite elements less the closed-form flattening
    /// that the fast model adds again.
    pub pair_compliance: PairCompliance,
    /// K/H for each criterion.
    pub foundation: BTreeMap<MatchCriterion, FoundationCurve>,
    /// How well the curves of K/H meet finite elements, where fitted and where held out.
    pub foundation_fit: BTreeMap<MatchCriterion, FoundationFit>,
    /// Deflection of both teeth along the path.
    pub deflection: Vec<PairDeflection>,
    /// The same at A to E, as far as the load keeps clear of the tip edges.
    pub deflection_at_points: [Option<PairDeflection>; 5],
    /// The single stiffness c' of ISO 6336-1, N/(mm·µm).
    pub iso6336_n_per_mm_um: f64,
    /// The pair alone in contact.
    pub single_contact: Vec<SingleContact>,
    /// The stiffness at C on finer and finer meshes.
    pub convergence: Vec<ResolutionRow>,
    /// The stiffness at C with the bodies held at other depths.
    pub rim_depth: Vec<RimRow>,
    /// The stiffness at C with more or fewer neighbouring teeth.
    pub neighbours: Vec<NeighbourRow>,
    /// Deflection by number of teeth and height of the load.
    pub family: Vec<FamilyMember>,
    /// How the stiffness varies over the path.
    pub courses: Vec<StiffnessVariation>,
    /// What one mesh of unworn flanks wears.
    pub wear_reference: Vec<WearReference>,
    /// How its slices yield together; none where its sections are alike over the face width.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slices: Option<SliceFit>,
}

impl Calibration {
    /// Least and greatest line load that K/H was fitted on, N/mm.
    pub fn fitted_loads_n_per_mm(&self) -> (f64, f64) {
        let loads = single_contact::FITTED_LOADS.map(|load| load * self.line_load_n_per_mm);
        (loads.iter().copied().fold(f64::INFINITY, f64::min), loads.iter().copied().fold(0.0, f64::max))
    }
}

/// The stiffness curve alone, for a scene that asks for it without a calibration file.
pub fn pair_compliance(
    condensed: &CondensedPair<'_>,
    material: &PerGear<Material>,
    line_load_n_per_mm: f64,
) -> Result<PairCompliance, CalibrationError> {
    let loaded = LoadedPair::new(condensed, material);
    let deflection = loaded.along_the_path(OWN_POSITIONS, line_load_n_per_mm)?;
    Ok(loaded.curve(&deflection, line_load_n_per_mm))
}
