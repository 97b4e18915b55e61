//! Calibration of the fast model by finite elements: tooth stiffness and K/H along the path of contact.
//!
//! | module | result |
//! |---|---|
//! | [`tooth_stiffness`] | deflection of the teeth under a known load anywhere on the path, bending and flattening apart |
//! | [`bodies`] | the pair's stiffness at C as resolution, rim and neighbours change |
//! | [`tooth_family`] | deflection by number of teeth and height of the load |
//! | [`stiffness_variation`] | variation of the stiffness over the path |
//! | [`single_contact`] | the pair alone in contact: half-width, peak pressure, approach by position and load |
//! | [`foundation_fit`] | K/H as a curve for a Winkler foundation, with its error at fitted and at held-out points |
//! | [`slice_fit`] | compliance of the slices of a pair together, from its teeth in space |
//! | [`wear_reference`] | wear of unworn flanks in one mesh |
//! | [`identity`] | pair, material and bodies that a calibration belongs to |
//! | [`mod@file`] | the calibration file |
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
use self::identity::CalibrationIdentity;
use self::single_contact::SingleContact;
use self::slice_fit::SliceFit;
use self::stiffness_variation::StiffnessVariation;
use self::tooth_family::FamilyMember;
use self::tooth_stiffness::{LoadedPair, PairDeflection};
use self::wear_reference::WearReference;
use crate::contact::{foundation::FoundationCurve, settings::MatchCriterion};
use crate::stiffness::curve::PairCompliance;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::gear_fem::{condensed_pair::CondensedPair, model::ModelError};
use gearwear_bodies::material::Material;
use gearwear_fem::active_set::ActiveSetError;

/// Positions of the stiffness curve.
pub const STIFFNESS_POSITIONS: usize = 61;
/// Positions of the curve that a run makes for itself: linear interpolation between them is off by 1e-4.
const OWN_POSITIONS: usize = 31;

/// Reason why there is no calibration.
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
        /// Failure of the solver.
        source: ActiveSetError,
    },
    /// The strip of contact is wider than the flank.
    #[error("{}: the contact strip at position {position_mm:.4} mm does not fit on the flank", gear.name())]
    OffTheFlank {
        /// Gear of the flank.
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
    /// Pair, material and bodies.
    pub belongs_to: CalibrationIdentity,
    /// Elements per half-width of contact of the mesh it was made with.
    pub elements_per_half_width: f64,
    /// The scene's whole line load: that of the stiffness curve, and the unit of the loads of K/H, N/mm.
    pub line_load_n_per_mm: f64,
    /// Points A to E of the path of contact, mm.
    pub path_points_mm: [f64; 5],
    /// Compliance of a tooth pair for the fast model: by finite elements, less the closed-form flattening that the fast model adds
    /// again.
    pub pair_compliance: PairCompliance,
    /// K/H for each criterion.
    pub foundation: BTreeMap<MatchCriterion, FoundationCurve>,
    /// Error of the curves of K/H at fitted and at held-out points.
    pub foundation_fit: BTreeMap<MatchCriterion, FoundationFit>,
    /// Deflection of both teeth along the path.
    pub deflection: Vec<PairDeflection>,
    /// Deflection of both teeth at A to E, as far as the load keeps clear of the tip edges.
    pub deflection_at_points: [Option<PairDeflection>; 5],
    /// The single stiffness c' of ISO 6336-1, N/(mm·µm).
    pub iso6336_n_per_mm_um: f64,
    /// The pair alone in contact.
    pub single_contact: Vec<SingleContact>,
    /// Stiffness at C on finer and finer meshes.
    pub convergence: Vec<ResolutionRow>,
    /// Stiffness at C with the bodies held at other depths.
    pub rim_depth: Vec<RimRow>,
    /// Stiffness at C with more or fewer neighbouring teeth.
    pub neighbours: Vec<NeighbourRow>,
    /// Deflection by number of teeth and height of the load.
    pub family: Vec<FamilyMember>,
    /// Variation of the stiffness over the path.
    pub courses: Vec<StiffnessVariation>,
    /// Wear of unworn flanks in one mesh.
    pub wear_reference: Vec<WearReference>,
    /// Compliance of the slices together; none where all sections over the face width are alike.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub slices: Option<SliceFit>,
}

impl Calibration {
    /// Least and greatest line load that K/H was fitted to, N/mm.
    pub fn fitted_loads_n_per_mm(&self) -> (f64, f64) {
        let loads = single_contact::FITTED_LOADS.map(|load| load * self.line_load_n_per_mm);
        (loads.iter().copied().fold(f64::INFINITY, f64::min), loads.iter().copied().fold(0.0, f64::max))
    }
}

/// The stiffness curve alone, for a scene without a calibration file.
pub fn pair_compliance(
    condensed: &CondensedPair<'_>,
    material: &PerGear<Material>,
    line_load_n_per_mm: f64,
) -> Result<PairCompliance, CalibrationError> {
    let loaded = LoadedPair::new(condensed, material);
    let deflection = loaded.along_the_path(OWN_POSITIONS, line_load_n_per_mm)?;
    Ok(loaded.curve(&deflection, line_load_n_per_mm))
}
