//! A tooth pair in contact alone by finite elements: half-width, peak pressure and approach against position and load.
//!
//! The reference pair carries the whole load w; its pressure is found by the contact solver, not assumed. The approach of
//! the surfaces is what is left of the transmission error when both points inside the teeth are taken off (where the line
//! of action meets the centre lines, as in [`super::tooth_stiffness`]):
//!
//! ```text
//! δ = δ_TE − δ_i1 − δ_i2
//! ```
//!
//! The half-width is that of the ellipse with the same second moment of the pressure,
//!
//! ```text
//! a² = 4 (Σ f x² / Σ f − (Σ f x / Σ f)²)
//! ```
//!
//! with the nodal forces f of the contact at places x along the flank: the ends of the strip are known to a part of
//! an element only, the moments of the forces far better, and for Hertz's pressure both half-widths are the same.
//!
//! Where a tip edge, sharp or rounded, carries pressure, the contact has neither Hertz's curvature nor, if sharp, a finite
//! peak; such points are marked, and no K/H is fitted to them.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::CalibrationError;
use super::loaded_tooth::Inside;
use super::tooth_stiffness::{LoadedPair, evenly};
use crate::contact::settings::MatchCriterion;
use gearwear_bodies::gear::conjugate::ConjugateFlanks;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::flank_surface::MeshedFlank;
use gearwear_bodies::gear_fem::position::{PositionContact, WarmStart};
use gearwear_bodies::gear_fem::ring::ToothForce;

/// Loads of the fit, in units of the scene's, largest first.
pub const FITTED_LOADS: [f64; 4] = [1.5, 1.0, 0.5, 0.25];
/// Held-out loads, in units of the scene's.
pub(crate) const HELD_OUT_LOADS: [f64; 3] = [1.25, 0.7, 0.35];
/// Number of positions of the fit; held-out positions lie halfway between them.
const FITTED_POSITIONS: usize = 17;
/// Half-widths that are kept clear of the edges at the greatest load.
const CLEAR: f64 = 1.05;

/// Use of a point in the fit of K/H.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Purpose {
    /// The fit is made to it.
    Fitted,
    /// The error of the fit is measured on it.
    HeldOut,
    /// A tip edge carries pressure: neither.
    AtEdge,
}

/// The pair alone in contact at one position and load, beside Hertz in closed form.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SingleContact {
    /// ξ, mm.
    pub position_mm: f64,
    /// w, N/mm.
    pub line_load_n_per_mm: f64,
    /// R, mm.
    pub relative_radius_mm: f64,
    /// Use in the fit.
    pub purpose: Purpose,
    /// By finite elements.
    pub fem: TouchFigures,
    /// Hertz's half-width and pressure, and the closed-form flattening.
    pub hertz: TouchFigures,
}

/// Half-width, peak pressure and approach of a contact: the quantities that K/H can be matched on.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TouchFigures {
    /// a, mm.
    pub half_width_mm: f64,
    /// p₀, MPa.
    pub peak_pressure_mpa: f64,
    /// δ, mm.
    pub approach_mm: f64,
}

impl TouchFigures {
    /// A Winkler foundation of stiffness K/H under w on a gap of radius R: a³ = 3wR/(2 K/H), p₀ = (K/H) a²/2R, δ = a²/2R.
    pub fn of_foundation(mpa_per_mm: f64, relative_radius_mm: f64, line_load_n_per_mm: f64) -> Self {
        let half_width_mm = (1.5 * line_load_n_per_mm * relative_radius_mm / mpa_per_mm).cbrt();
        let approach_mm = half_width_mm * half_width_mm / (2.0 * relative_radius_mm);
        Self { half_width_mm, peak_pressure_mpa: mpa_per_mm * approach_mm, approach_mm }
    }

    /// K/H of the foundation that has the quantity of `criterion` in common with this contact.
    ///
    /// ```text
    /// half-width K/H = 3wR/(2a³)   peak pressure K/H = 32 R p₀³/(9 w²)   approach K/H = 3wR/(2 (2Rδ)^{3/2})
    /// ```
    pub fn matched_mpa_per_mm(
        &self,
        criterion: MatchCriterion,
        relative_radius_mm: f64,
        line_load_n_per_mm: f64,
    ) -> f64 {
        let (w, radius) = (line_load_n_per_mm, relative_radius_mm);
        match criterion {
            MatchCriterion::HalfWidth => 1.5 * w * radius / self.half_width_mm.powi(3),
            MatchCriterion::PeakPressure => 32.0 * radius * self.peak_pressure_mpa.powi(3) / (9.0 * w * w),
            MatchCriterion::Approach => 1.5 * w * radius / (2.0 * radius * self.approach_mm).powf(1.5),
        }
    }
}

impl SingleContact {
    /// K/H by finite elements, MPa/mm.
    pub fn mpa_per_mm(&self, criterion: MatchCriterion) -> f64 {
        self.fem.matched_mpa_per_mm(criterion, self.relative_radius_mm, self.line_load_n_per_mm)
    }

    /// K/H by Hertz in closed form, MPa/mm.
    pub fn hertz_mpa_per_mm(&self, criterion: MatchCriterion) -> f64 {
        self.hertz.matched_mpa_per_mm(criterion, self.relative_radius_mm, self.line_load_n_per_mm)
    }
}

/// A position to be solved, and whether the fit is made to it.
#[derive(Clone, Copy)]
struct SolvedPosition {
    position_mm: f64,
    fitted: bool,
}

/// Solves the pair alone at positions from A to E under all loads, in the order of the positions; `reference_n_per_mm` is
/// the load of the scene.
pub fn solve(
    condensed: &CondensedPair<'_>,
    loaded: &LoadedPair<'_>,
    reference_n_per_mm: f64,
) -> Result<Vec<SingleContact>, CalibrationError> {
    let places = places(loaded, reference_n_per_mm)?;
    let inside = loaded.inside(&places.iter().map(|place| place.position_mm).collect::<Vec<_>>());
    let solved: Vec<Vec<SingleContact>> = places
        .par_iter()
        .zip(inside)
        .map(|(place, inside)| at_all_loads(condensed, loaded, place, &inside?, reference_n_per_mm))
        .collect::<Result<_, _>>()?;
    Ok(solved.into_iter().flatten().collect())
}

fn places(loaded: &LoadedPair<'_>, reference_n_per_mm: f64) -> Result<Vec<SolvedPosition>, CalibrationError> {
    let line_load_n_per_mm = FITTED_LOADS[0] * reference_n_per_mm;
    let path = &loaded.pair.path;
    let (low, high) = loaded
        .clear_of_the_edges_mm(line_load_n_per_mm, CLEAR)
        .ok_or(CalibrationError::NoClearPosition { line_load_n_per_mm })?;
    let before = [path.start_mm, 0.5 * (path.start_mm + low)];
    let mut places = before.map(|position_mm| SolvedPosition { position_mm, fitted: false }).to_vec();
    for (k, position_mm) in evenly(low, high, 2 * FITTED_POSITIONS - 1).into_iter().enumerate() {
        places.push(SolvedPosition { position_mm, fitted: k % 2 == 0 });
    }
    let after = [0.5 * (path.end_mm + high), path.end_mm];
    places.extend(after.map(|position_mm| SolvedPosition { position_mm, fitted: false }));
    Ok(places)
}

fn at_all_loads(
    condensed: &CondensedPair<'_>,
    loaded: &LoadedPair<'_>,
    place: &SolvedPosition,
    inside: &PerGear<Inside>,
    reference_n_per_mm: f64,
) -> Result<Vec<SingleContact>, CalibrationError> {
    let position_mm = place.position_mm;
    let mut loads: Vec<(f64, bool)> = FITTED_LOADS.map(|load| (load, true)).to_vec();
    loads.extend(HELD_OUT_LOADS.map(|load| (load, false)));
    loads.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut warm = WarmStart::default();
    let mut solved = Vec::with_capacity(loads.len());
    for (fraction, fitted) in loads {
        let line_load_n_per_mm = fraction * reference_n_per_mm;
        let found = condensed
            .at_alone(position_mm, line_load_n_per_mm, &warm)
            .map_err(|source| CalibrationError::Contact { position_mm, line_load_n_per_mm, source })?;
        let purpose = match (is_at_edge(condensed, &found), place.fitted && fitted) {
            (true, _) => Purpose::AtEdge,
            (false, true) => Purpose::Fitted,
            (false, false) => Purpose::HeldOut,
        };
        solved.push(read(condensed, loaded, inside, &found, line_load_n_per_mm, purpose));
        warm = found.warm;
    }
    Ok(solved)
}

/// Half-width of the ellipse with the second moment of the forces on a flank.
fn half_width_mm(flank: &MeshedFlank, force: &ToothForce) -> f64 {
    let (mut sum, mut first, mut second) = (0.0, 0.0, 0.0);
    let origin_mm = force.first().map_or(0.0, |(column, _)| flank.from_tip_mm[column / 2]);
    for node in force.chunk_by(|a, b| a.0 / 2 == b.0 / 2) {
        let place = node[0].0 / 2;
        let normal = flank.surface.normals[place];
        let pressing: f64 = -node.iter().map(|&(column, f)| f * normal[column % 2]).sum::<f64>();
        let x = flank.from_tip_mm[place] - origin_mm;
        sum += pressing;
        first += pressing * x;
        second += pressing * x * x;
    }
    2.0 * (second / sum - (first / sum).powi(2)).max(0.0).sqrt()
}

fn read(
    condensed: &CondensedPair<'_>,
    loaded: &LoadedPair<'_>,
    inside: &PerGear<Inside>,
    found: &PositionContact,
    line_load_n_per_mm: f64,
    purpose: Purpose,
) -> SingleContact {
    let position_mm = found.position_mm;
    let bent_mm = PerGear::from_fn(|gear| {
        let tooth = &loaded.teeth[gear];
        tooth.inside_mm(&inside[gear], tooth.middle(), &found.forces[gear])
    });
    let hertz = loaded.hertz(position_mm);
    let slave = found.pairs.first().map_or(Gear::Pinion, |pair| pair.slave);
    let force = &found.forces[slave][loaded.teeth[slave].middle()];
    let strip = hertz.contact.loaded(line_load_n_per_mm);
    SingleContact {
        position_mm,
        line_load_n_per_mm,
        relative_radius_mm: loaded.pair.relative_radius_mm(position_mm),
        purpose,
        fem: TouchFigures {
            half_width_mm: half_width_mm(&condensed.flanks[slave], force),
            peak_pressure_mpa: found.pairs.iter().map(|pair| pair.peak_pressure_mpa).fold(0.0, f64::max),
            approach_mm: found.transmission_error_mm - bent_mm.sum(),
        },
        hertz: TouchFigures {
            half_width_mm: strip.half_width_mm,
            peak_pressure_mpa: strip.peak_pressure_mpa,
            approach_mm: hertz.approach_mm(line_load_n_per_mm),
        },
    }
}

/// Whether an end of a flank, or the rounding of its tip, carries pressure.
fn is_at_edge(condensed: &CondensedPair<'_>, found: &PositionContact) -> bool {
    let at_edge = PerGear::from_fn(|gear| {
        let flank = &condensed.flanks[gear];
        let ends = [flank.tip_node(), flank.root_node()];
        let loaded = found.forces[gear].iter().flatten().map(|(column, _)| column / 2);
        loaded.into_iter().any(|node| ends.contains(&node) || flank.rho_mm[node].is_nan())
    });
    at_edge.pinion || at_edge.wheel
}
