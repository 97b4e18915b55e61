//! Implausible loads: strains above 100, or displacements above 100 times the size of the body.
//!
//! Strains are taken to be small. A force F on bodies of extent L and Young's modulus E strains them by about
//!
//! ```text
//! in the plane  F/(E L), F per mm of thickness        in space  F/(E L²)
//! ```
//!
//! which says nothing of how it is distributed, but tells a load from a slip: of units, or of an exponent.

use super::file::{FemProblemFile, LoadFile};
use crate::scene::findings::Findings;
use crate::scene::problem::number;

/// Greatest plausible mean strain, or displacement over extent.
const GREATEST_MEANT: f64 = 100.0;
/// Least plausible Young's modulus, MPa: below it the modulus is the likely error, not the force.
const SOFTEST_MPA: f64 = 1e-6;

/// Refuses implausible forces and displacements of bodies with these nodes.
pub(super) fn check(file: &FemProblemFile, points_mm: &[[f64; 3]], findings: &mut Findings) {
    let extent_mm = extent_mm(points_mm);
    let moduli_mpa = file.body.iter().map(|body| 1e3 * body.young_modulus_GPa).enumerate();
    let Some((softest, modulus_mpa)) = moduli_mpa.min_by(|(_, a), (_, b)| a.total_cmp(b)) else { return };
    for (i, load) in file.load.iter().enumerate() {
        if let Some(moved) = load.displacement_mm.as_deref().map(length)
            && moved > GREATEST_MEANT * extent_mm
        {
            let found = format!("a displacement of {moved:.3e} mm on bodies of {extent_mm:.4e} mm");
            let allowed = format!("at most {:.4e} mm, a hundred times their extent", GREATEST_MEANT * extent_mm);
            findings.not_allowed(&format!("load[{i}].displacement_mm"), found, allowed);
        }
        let Some((key, force)) = load.force() else { continue };
        let carrying = modulus_mpa * carrying(load, extent_mm);
        let strain = length(force) / carrying;
        if strain <= GREATEST_MEANT {
            continue;
        }
        if modulus_mpa < SOFTEST_MPA {
            let found = format!(
                "{}, which the force of load[{i}] strains by about {strain:.1e}",
                number(file.body[softest].young_modulus_GPa)
            );
            let least_gpa = 1e-3 * modulus_mpa * strain / GREATEST_MEANT;
            findings.not_allowed(
                &format!("body[{softest}].young_modulus_GPa"),
                found,
                format!("at least {least_gpa:.4e} under that force"),
            );
        } else {
            let found = format!("a force of {:.3e}, which strains the bodies by about {strain:.1e}", length(force));
            let allowed = format!("at most {:.4e}, a strain of {GREATEST_MEANT}", GREATEST_MEANT * carrying);
            findings.not_allowed(&format!("load[{i}].{key}"), found, allowed);
        }
        findings.help("check the units: N, mm and GPa");
    }
}

/// Loaded cross-section: L in the plane, L² in space.
fn carrying(load: &LoadFile, extent_mm: f64) -> f64 {
    if load.force_N.is_some() { extent_mm * extent_mm } else { extent_mm }
}

fn length(vector: &[f64]) -> f64 {
    vector.iter().fold(0.0, |length: f64, component| length.hypot(*component))
}

/// The greatest extent along an axis.
fn extent_mm(points_mm: &[[f64; 3]]) -> f64 {
    let extents = (0..3).map(|axis| {
        let values = points_mm.iter().map(|point| point[axis]);
        values.clone().fold(f64::NEG_INFINITY, f64::max) - values.fold(f64::INFINITY, f64::min)
    });
    extents.fold(0.0, f64::max)
}
