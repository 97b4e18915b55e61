//! Deflection of the teeth of a pair, with the load anywhere on the path of contact.
//!
//! At each position a tooth of each gear carries the reference line load as Hertz's ellipse ([`super::loaded_tooth`]). With the displacement δ of the
//! loaded point along the load, and δ_i of the point inside the tooth where the load's line meets the centre line:
//!
//! ```text
//! whole        q = (δ₁ + δ₂) / w           stiffness of the pair = 1/q
//! bending      q_b = (δ_i1 + δ_i2) / w     flattening  q_f = q − q_b
//! coupling     q_j = (δ'₁ + δ'₂) / w       δ': at the expected contact of the pair one base pitch ahead or behind
//! ```
//!
//! Next to them stand Weber and Banaschek's terms and the closed-form flattening at the same depth and load.
//!
//! Positions run evenly over the stretch on which the ellipse lies wholly on both flanks: it begins and ends about a
//! half-width of flank inside A and E. Beyond it the curve of the fast model ([`LoadedPair::curve`]) changes as bending alone does,
//! under a concentrated load along the normal where the flanks touch (`gear::tip_touch`): at A and E,
//! and beyond them, where the load turns towards the axis of the tooth whose tip edge touches.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::CalibrationError;
use super::loaded_tooth::{Inside, LoadedTooth};
use crate::contact::hertz;
use crate::stiffness::curve::{PairCompliance, StandsFor};
use crate::stiffness::weber_banaschek::ToothCompliance;
use gearwear_bodies::gear::flank_edge::PathEnd;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, tooth::LoadLine};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::ring::ToothForce;
use gearwear_bodies::material::{Material, contact_modulus_mpa};
use gearwear_bodies::reference::flattening::Flattening;

/// Iterations that find the end of the stretch clear of an edge.
const TURNS: usize = 12;
/// Half-widths from an edge at which an ellipse no longer feels it.
const CLEAR_OF_CORNERS: f64 = 2.0;
/// Places of the curve from the end of that stretch to where the edge touches.
const PLACES_TO_EDGE: usize = 5;
/// Places of the curve where the edge touches.
const PLACES_BEYOND_EDGE: usize = 16;
/// Greatest load for which the curve reaches as far as tip edges touch, over the load of the calibration.
const GREATEST_LOAD: f64 = 2.0;
/// Half-widths kept clear of the edges: a little more than one, for rounding errors.
const CLEAR: f64 = 1.0 + 1e-6;

/// One tooth under the load, displacements over line load in mm²/N.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ToothDeflection {
    /// At the loaded point, flattening included.
    pub whole_mm2_per_n: f64,
    /// At the point inside: tooth and body.
    pub bending_mm2_per_n: f64,
    /// Depth of the point inside below the flank, mm.
    pub depth_mm: f64,
    /// Flattening of this body in closed form, to the same depth.
    pub closed_form_flattening_mm2_per_n: f64,
    /// Weber and Banaschek's tooth and body terms.
    pub weber_banaschek_bending_mm2_per_n: f64,
}

/// Both teeth at one position.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct PairDeflection {
    /// ξ, mm.
    pub position_mm: f64,
    /// Half-width of the ellipse, mm.
    pub half_width_mm: f64,
    /// The pinion's tooth.
    pub pinion: ToothDeflection,
    /// The wheel's tooth.
    pub wheel: ToothDeflection,
    /// Displacement at the contact of the pair one base pitch ahead, where it is in mesh, mm²/N.
    pub ahead_mm2_per_n: Option<f64>,
    /// Displacement at the contact of the pair one base pitch behind, where it is in mesh, mm²/N.
    pub behind_mm2_per_n: Option<f64>,
}

impl ToothDeflection {
    /// Flattening by finite elements: displacement of the loaded point less that of the point inside.
    pub fn flattening_mm2_per_n(&self) -> f64 {
        self.whole_mm2_per_n - self.bending_mm2_per_n
    }
}

impl PairDeflection {
    /// One of the teeth.
    pub fn tooth(&self, gear: Gear) -> &ToothDeflection {
        match gear {
            Gear::Pinion => &self.pinion,
            Gear::Wheel => &self.wheel,
        }
    }

    /// A quantity of both teeth together.
    pub fn sum(&self, of: impl Fn(&ToothDeflection) -> f64) -> f64 {
        of(&self.pinion) + of(&self.wheel)
    }

    /// Stiffness of the pair by finite elements, flattening included, N/(mm·µm).
    pub fn pair_n_per_mm_um(&self) -> f64 {
        1e-3 / self.sum(|tooth| tooth.whole_mm2_per_n)
    }

    /// Stiffness of the pair by Weber and Banaschek, flattening included, N/(mm·µm).
    pub fn weber_banaschek_n_per_mm_um(&self) -> f64 {
        1e-3 / self.sum(|t| t.weber_banaschek_bending_mm2_per_n + t.closed_form_flattening_mm2_per_n)
    }
}

/// A pair of condensed gears, ready to be loaded.
pub struct LoadedPair<'a> {
    /// Geometry.
    pub pair: &'a GearPair,
    /// Material of each gear.
    pub material: PerGear<Material>,
    /// The teeth.
    pub teeth: PerGear<LoadedTooth<'a>>,
    /// Weber and Banaschek's tooth of each gear.
    weber_banaschek: PerGear<ToothCompliance>,
}

impl<'a> LoadedPair<'a> {
    /// The teeth of `condensed`.
    pub fn new(condensed: &'a CondensedPair<'a>, material: &PerGear<Material>) -> Self {
        let pair = condensed.pair;
        Self {
            pair,
            material: *material,
            teeth: PerGear::from_fn(|gear| {
                LoadedTooth::new(&pair.teeth[gear], &condensed.gears[gear], &condensed.flanks[gear])
            }),
            weber_banaschek: PerGear::from_fn(|gear| ToothCompliance::new(&pair.teeth[gear], &material[gear])),
        }
    }

    /// The closed form at a position.
    pub fn hertz(&self, position_mm: f64) -> Flattening {
        hertz::flattening(self.pair, &self.material, position_mm)
    }

    /// First and last position at which the ellipse under `line_load_n_per_mm` lies wholly on both flanks, drawn in by
    /// `half_widths` times its half-width.
    pub fn clear_of_the_edges_mm(&self, line_load_n_per_mm: f64, half_widths: f64) -> Option<(f64, f64)> {
        let path = &self.pair.path;
        let PerGear { pinion, wheel } = &self.teeth;
        // The half-width changes along the path: each end is found in turns with it.
        let (mut low, mut high) = (path.start_mm, path.end_mm);
        for _ in 0..TURNS {
            let [at_low, at_high] = [low, high].map(|position_mm| {
                half_widths * self.hertz(position_mm).contact.loaded(line_load_n_per_mm).half_width_mm
            });
            let wheel_low = path.line_of_action_mm - wheel.limits_mm(at_low)?.1;
            let wheel_high = path.line_of_action_mm - wheel.limits_mm(at_high)?.0;
            low = pinion.limits_mm(at_low)?.0.max(wheel_low).max(path.start_mm);
            high = pinion.limits_mm(at_high)?.1.min(wheel_high).min(path.end_mm);
        }
        (low < high).then_some((low, high))
    }

    /// Both teeth under `line_load_n_per_mm` at each of some positions; `None` where the ellipse hangs over an edge.
    pub fn deflections(&self, positions_mm: &[f64], line_load_n_per_mm: f64) -> Vec<Option<PairDeflection>> {
        let at = positions_mm.par_iter().zip(self.inside(positions_mm));
        at.map(|(&position_mm, inside)| self.deflection(position_mm, line_load_n_per_mm, &inside.ok()?)).collect()
    }

    /// Point inside each tooth at each of some positions; the error names a gear where it is outside the tooth.
    pub(super) fn inside(&self, positions_mm: &[f64]) -> Vec<Result<PerGear<Inside>, CalibrationError>> {
        let of_gears = PerGear::in_parallel(|gear| {
            let rho_mm: Vec<f64> = positions_mm.iter().map(|&at_mm| self.pair.path.rho_mm(gear, at_mm)).collect();
            self.teeth[gear].inside(&rho_mm)
        });
        let both = of_gears.pinion.into_iter().zip(of_gears.wheel).zip(positions_mm);
        let in_teeth = both.map(|((pinion, wheel), &position_mm)| {
            let off = |gear| CalibrationError::OffTheFlank { gear, position_mm };
            let pinion = pinion.ok_or_else(|| off(Gear::Pinion))?;
            Ok(PerGear { pinion, wheel: wheel.ok_or_else(|| off(Gear::Wheel))? })
        });
        in_teeth.collect()
    }

    /// Both teeth under `line_load_n_per_mm` at a position, with the points inside them.
    fn deflection(
        &self,
        position_mm: f64,
        line_load_n_per_mm: f64,
        inside: &PerGear<Inside>,
    ) -> Option<PairDeflection> {
        let (w, path) = (line_load_n_per_mm, &self.pair.path);
        let hertz = self.hertz(position_mm);
        let half_width_mm = hertz.contact.loaded(w).half_width_mm;
        let mut neighbours = [0.0; 2];
        let mut own = Vec::with_capacity(2);
        for gear in Gear::BOTH {
            let tooth = &self.teeth[gear];
            let rho_mm = path.rho_mm(gear, position_mm);
            let force = tooth.ellipse(rho_mm, half_width_mm, w)?;
            let middle = tooth.middle();
            let inside = &inside[gear];
            let mut forces = vec![ToothForce::new(); tooth.teeth()];
            forces[middle] = force;
            let force = &forces[middle];
            // Flattening of two bodies of this one's kind is twice that of one.
            let one = hertz.bodies[gear as usize];
            let both = Flattening { contact: hertz.contact, bodies: [one; 2] };
            own.push(ToothDeflection {
                whole_mm2_per_n: tooth.surface_mm(middle, rho_mm, middle, force)? / w,
                bending_mm2_per_n: tooth.inside_mm(inside, middle, &forces) / w,
                depth_mm: inside.depth_mm,
                closed_form_flattening_mm2_per_n: 0.5 * both.approach_mm(w) / w,
                weber_banaschek_bending_mm2_per_n: self.weber_banaschek[gear].mm2_per_n(rho_mm),
            });
            for (sum, beside) in neighbours.iter_mut().zip([1, -1]) {
                let there_mm = position_mm + f64::from(beside) * path.base_pitch_mm;
                // The pair ahead is the next tooth of the pinion and the one before of the wheel.
                let place = match gear {
                    Gear::Pinion => middle as i32 + beside,
                    Gear::Wheel => middle as i32 - beside,
                };
                let place = usize::try_from(place).ok().filter(|&place| place < tooth.teeth());
                let moved = place
                    .filter(|_| (path.start_mm..=path.end_mm).contains(&there_mm))
                    .and_then(|place| tooth.surface_mm(place, path.rho_mm(gear, there_mm), middle, force));
                *sum += moved.map_or(f64::NAN, |moved| moved / w);
            }
        }
        let [ahead, behind] = neighbours.map(|q| q.is_finite().then_some(q));
        Some(PairDeflection {
            position_mm,
            half_width_mm,
            pinion: own[0],
            wheel: own[1],
            ahead_mm2_per_n: ahead,
            behind_mm2_per_n: behind,
        })
    }

    /// The deflection at `count` positions (at least two) evenly over the stretch that is clear of the edges.
    pub fn along_the_path(
        &self,
        count: usize,
        line_load_n_per_mm: f64,
    ) -> Result<Vec<PairDeflection>, CalibrationError> {
        let none = CalibrationError::NoClearPosition { line_load_n_per_mm };
        let Some((low, high)) = self.clear_of_the_edges_mm(line_load_n_per_mm, CLEAR) else { return Err(none) };
        let positions = evenly(low, high, count.max(2));
        let deflections = self.deflections(&positions, line_load_n_per_mm).into_iter();
        deflections.map(|found| found.ok_or_else(|| none.clone())).collect()
    }

    /// The curve for [`crate::stiffness::TeethSpring`], which adds the closed-form flattening again: the compliance by finite elements less that
    /// flattening, both under `line_load_n_per_mm`. Next to the edges, where an ellipse feels the corner and half-planes do not, and beyond them, it
    /// changes as bending does, as far as tip edges may touch under twice that load.
    pub fn curve(&self, deflections: &[PairDeflection], line_load_n_per_mm: f64) -> PairCompliance {
        let clear = self.clear_of_the_edges_mm(line_load_n_per_mm, CLEAR_OF_CORNERS);
        let all: Vec<(f64, f64)> = deflections
            .iter()
            .map(|at| (at.position_mm, at.sum(|tooth| tooth.whole_mm2_per_n - tooth.closed_form_flattening_mm2_per_n)))
            .collect();
        let mut inner = all.clone();
        inner.retain(|(position_mm, _)| clear.is_none_or(|(low, high)| (low..=high).contains(position_mm)));
        if inner.is_empty() {
            inner = all;
        }
        let path = &self.pair.path;
        let contact_modulus_mpa = contact_modulus_mpa(self.material.map(Material::elastic));
        let [before, after] = self.pair.ample_tip_reach_mm(GREATEST_LOAD * line_load_n_per_mm, contact_modulus_mpa);
        let [start_edge_mm, end_edge_mm] = [PathEnd::Start, PathEnd::End].map(|end| self.pair.edge_position_mm(end));
        let mut points = self.continued(inner[0], start_edge_mm, path.start_mm - before);
        points.reverse();
        points.extend_from_slice(&inner);
        points.extend(self.continued(inner[inner.len() - 1], end_edge_mm, path.end_mm + after));
        let (position_mm, mm2_per_n) = points.into_iter().unzip();
        // The coupling hardly depends on the position: the whole bodies yield.
        let couplings: Vec<f64> =
            deflections.iter().flat_map(|at| [at.ahead_mm2_per_n, at.behind_mm2_per_n]).flatten().collect();
        let shared_mm2_per_n =
            if couplings.is_empty() { 0.0 } else { couplings.iter().sum::<f64>() / couplings.len() as f64 };
        PairCompliance { position_mm, mm2_per_n, stands_for: StandsFor::Teeth, shared_mm2_per_n }
    }

    /// The curve from `from` (position and compliance) to `to_mm` by way of `edge_mm`, where an edge begins to touch: it changes as bending does.
    fn continued(&self, from: (f64, f64), edge_mm: f64, to_mm: f64) -> Vec<(f64, f64)> {
        let mut places = evenly(from.0, edge_mm, PLACES_TO_EDGE);
        places.pop();
        places.extend(evenly(edge_mm, to_mm, PLACES_BEYOND_EDGE));
        let mut places: Vec<f64> =
            places.into_iter().filter(|place| (place - from.0) * (to_mm - from.0) > 0.0).collect();
        places.insert(0, from.0);
        let bending = self.bending_mm2_per_n(&places);
        let Some(at_from) = bending[0] else { return Vec::new() };
        let beyond = places.into_iter().zip(bending).skip(1);
        beyond.map_while(|(place, bending)| Some((place, from.1 + bending? - at_from))).collect()
    }

    /// Bending of both teeth under a concentrated load where the flanks touch, over that load, at each of some positions, mm²/N.
    fn bending_mm2_per_n(&self, positions_mm: &[f64]) -> Vec<Option<f64>> {
        let loads = positions_mm.iter().map(|&position_mm| {
            let touch = self.pair.touch(position_mm);
            PerGear::from_fn(|gear| (touch.rho_mm[gear], touch.load_line[gear]))
        });
        let loads: Vec<PerGear<(f64, LoadLine)>> = loads.collect();
        let of_gears = PerGear::in_parallel(|gear| {
            self.teeth[gear].bending_mm2_per_n(&loads.iter().map(|load| load[gear]).collect::<Vec<_>>())
        });
        of_gears.pinion.into_iter().zip(of_gears.wheel).map(|(pinion, wheel)| Some(pinion? + wheel?)).collect()
    }
}

/// `count` (at least 2) places from `low` to `high`, both included.
pub fn evenly(low: f64, high: f64, count: usize) -> Vec<f64> {
    (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect()
}
