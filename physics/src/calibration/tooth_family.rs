//! Deflection of teeth by number of teeth and height of the load: the family of curves of Wang and Cheng.
//!
//! Single gears from the scene's basic rack, module and material, each a whole ring held 2.5 modules below its root, carry
//! a line load in the direction of their involute's normal; read is E δ/w of tooth and body, flattening apart
//! ([`super::loaded_tooth`]). Where the rack would undercut a gear its profile is shifted out by the least amount that
//! avoids it,
//!
//! ```text
//! x = h_fP* − ρ_fP* (1 − sin α) − z sin²α / 2
//! ```
//!
//! and it is 0 elsewhere. Heights run evenly in radius from where a rack of the same profile first touches the flank
//! (ρ = r sin α − (h_aP* − x) m / sin α, where that is not below the involute) to the tip circle. The deflection inside is
//! read at some tenths of a module of depth, where it does not matter how the load is spread, so that the load stands on a
//! point. All in the transverse section of spur gears.
//!
//! Compared with: K. L. Wang and H. S. Cheng, *ASME J. Mech. Design* 103 (1981) 177, whose own table is not at hand.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::CalibrationError;
use super::bodies::Setup;
use super::loaded_tooth::{LoadedTooth, limits_mm};
use super::tooth_stiffness::evenly;
use crate::stiffness::weber_banaschek::ToothCompliance;
use gearwear_bodies::gear::modification::Modification;
use gearwear_bodies::gear::spec::{GearSpec, PairSpec};
use gearwear_bodies::gear::{Gear, tooth::Tooth};
use gearwear_bodies::gear_fem::flank_surface::MeshedFlank;
use gearwear_bodies::gear_fem::model::{ModelError, sector};
use gearwear_bodies::gear_fem::ring::{GearCompliance, Surroundings, ToothForce};
use gearwear_bodies::gear_mesh::settings::default_clamp;
use gearwear_bodies::gear_mesh::{self as tooth_mesh, FlankResolution, SectorSettings, ToothSector, ToothShape};
use gearwear_fem::elastic::Analysis;
use gearwear_fem::equilibrium::SolveError;

const TEETH: [u32; 11] = [10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30];
/// Number of heights from root to tip.
const HEIGHTS: usize = 6;
/// Unit of length of the resolved flank, in modules.
const LENGTH_MODULES: f64 = 0.1;
/// Elements of the flank in that length.
const ELEMENTS_IN_LENGTH: f64 = 2.0;
/// Resolved part below the lowest height, in that length.
const MARGIN: f64 = 2.0;
/// Resolved depth, in that length.
const DEPTH: f64 = 1.0;
const FILLET_ELEMENTS: u32 = 16;

/// One gear of the family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FamilyMember {
    /// z.
    pub teeth: u32,
    /// x.
    pub profile_shift: f64,
    /// Height of each load: 0 at the lowest point, 1 at the tip.
    pub height: Vec<f64>,
    /// E δ/w of tooth and body by finite elements.
    pub deflection: Vec<f64>,
    /// E δ/w of tooth and body by Weber and Banaschek.
    pub weber_banaschek: Vec<f64>,
}

/// All gears of the family; a gear whose tooth is pointed or cannot be meshed is left out.
pub fn family(setup: &Setup<'_>) -> Result<Vec<FamilyMember>, CalibrationError> {
    let members: Vec<Option<FamilyMember>> =
        TEETH.par_iter().map(|&teeth| member(setup, teeth)).collect::<Result<_, _>>()?;
    Ok(members.into_iter().flatten().collect())
}

/// The scene's pair with a pinion of `teeth` teeth without undercut.
fn spec(setup: &Setup<'_>, teeth: u32) -> PairSpec {
    let mut spec = setup.pair.spec.clone();
    let (rack, sin) = (spec.rack, spec.normal_pressure_angle_rad.sin());
    let rounded = rack.dedendum_factor - rack.fillet_radius_factor * (1.0 - sin);
    let least_shift = rounded - 0.5 * f64::from(teeth) * sin * sin;
    spec.gears.pinion = GearSpec {
        teeth,
        profile_shift: least_shift.max(0.0),
        tip_diameter_mm: None,
        tooth_thickness_allowance_mm: 0.0,
        bore_diameter_mm: None,
        modification: Modification::default(),
        measured_flank: None,
        shaft: None,
        ring: None,
        tip_chamfer: None,
    };
    spec
}

fn member(setup: &Setup<'_>, teeth: u32) -> Result<Option<FamilyMember>, CalibrationError> {
    let spec = spec(setup, teeth);
    let own = &spec.gears.pinion;
    let (module_mm, sin) = (spec.normal_module_mm, spec.normal_pressure_angle_rad.sin());
    let tip_radius_mm =
        spec.reference_radius_mm(Gear::Pinion) + (spec.rack.addendum_factor + own.profile_shift) * module_mm;
    let Ok(tooth) = Tooth::new(&spec, Gear::Pinion, tip_radius_mm) else { return Ok(None) };
    let rack_rho_mm =
        tooth.reference_radius_mm * sin - (spec.rack.addendum_factor - own.profile_shift) * module_mm / sin;
    let start_rho_mm = rack_rho_mm.max(tooth.root_form_rho_mm());
    let shape = ToothShape {
        tooth: &tooth,
        modification: &own.modification,
        active_start_rho_mm: start_rho_mm,
        normal_module_mm: module_mm,
    };
    let [Ok(fine), Ok(coarse)] = [true, false].map(|fine| mesh(&shape, fine)) else { return Ok(None) };
    let (chain, rho_mm) = fine.working_flank.resolved_nodes();
    let flank = MeshedFlank::new(chain, rho_mm, &fine.points_mm, true);
    let body = ring(setup, &tooth, &fine, &coarse, flank.surface.mesh_nodes.clone())?;
    let loaded = LoadedTooth::new(&tooth, &body, &flank);
    let Some((low, high)) = limits_mm(&tooth, &flank, 0.0) else { return Ok(None) };

    let material = &setup.material.pinion;
    let weber_banaschek = ToothCompliance::new(&tooth, material);
    let start_mm = tooth.involute.radius_mm(start_rho_mm);
    let mut found = FamilyMember {
        teeth,
        profile_shift: own.profile_shift,
        height: evenly(0.0, 1.0, HEIGHTS),
        deflection: Vec::with_capacity(HEIGHTS),
        weber_banaschek: Vec::with_capacity(HEIGHTS),
    };
    // Rounding errors must not put a load beyond an end of the flank.
    let on_flank = |height: &f64| {
        let radius_mm = start_mm + height * (tooth.tip_radius_mm - start_mm);
        tooth.involute.curvature_radius_mm(radius_mm).clamp(low * (1.0 + 1e-12), high * (1.0 - 1e-12))
    };
    let loads_mm: Vec<f64> = found.height.iter().map(on_flank).collect();
    for (&rho_mm, inside) in loads_mm.iter().zip(loaded.inside(&loads_mm)) {
        let read = loaded.ellipse(rho_mm, 0.0, 1.0).zip(inside);
        let Some((force, inside)) = read else { return Ok(None) };
        let mut forces = vec![ToothForce::new(); loaded.teeth()];
        forces[loaded.middle()] = force;
        let moved = loaded.inside_mm(&inside, loaded.middle(), &forces);
        found.deflection.push(material.young_modulus_mpa * moved);
        found.weber_banaschek.push(material.young_modulus_mpa * weber_banaschek.mm2_per_n(rho_mm));
    }
    Ok(Some(found))
}

fn mesh(shape: &ToothShape<'_>, fine: bool) -> Result<ToothSector, tooth_mesh::ToothMeshError> {
    let length_mm = LENGTH_MODULES * shape.normal_module_mm;
    let flank = FlankResolution {
        half_width_mm: &|_| length_mm,
        elements_per_half_width: ELEMENTS_IN_LENGTH,
        rounding_refinement: 1.0,
        margin_mm: MARGIN * length_mm,
        depth_half_widths: DEPTH,
    };
    let settings = SectorSettings {
        clamp_radius_mm: default_clamp(shape.tooth.root_radius_mm, shape.normal_module_mm).radius_mm,
        fillet_elements: FILLET_ELEMENTS,
        flank: fine.then_some(flank),
    };
    tooth_mesh::sector(shape, &settings)
}

/// The whole ring with one tooth resolved.
fn ring(
    setup: &Setup<'_>,
    tooth: &Tooth,
    fine: &ToothSector,
    coarse: &ToothSector,
    candidates: Vec<u32>,
) -> Result<GearCompliance, CalibrationError> {
    let material = setup.elastic().pinion;
    let half_angle_rad = std::f64::consts::PI / f64::from(tooth.teeth);
    let surroundings = Surroundings::Ring { coarse: tooth.teeth as usize - 1 };
    let ring = || -> Result<GearCompliance, SolveError> {
        let fine = sector(fine, half_angle_rad, candidates).condense(material, Analysis::PlaneStrain)?;
        let coarse = sector(coarse, half_angle_rad, Vec::new()).condense(material, Analysis::PlaneStrain)?;
        Ok(GearCompliance::new(fine, Some(&coarse), 1, surroundings)?)
    };
    Ok(ring().map_err(|source| ModelError::Condense { gear: Gear::Pinion, source })?)
}
