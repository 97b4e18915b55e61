//! Springs of a Winkler foundation where a tip edge touches, matched to half-planes.
//!
//! A foundation matched to elastic bodies on the gap of two involutes does not match them where a tip edge touches: the
//! gap there has the radius of the rounding on one side, a slope on the other, and a contact a tenth as wide needs springs many
//! times as stiff. There the foundation is matched on that gap. At places along the path around A and E the half-planes of
//! [`half_space`](super::half_space) are pressed against each other by indentations δ on the unworn gap
//!
//! ```text
//! g(x) = drop₁ + drop₂ + roundings
//! ```
//!
//! and carry a load w over a strip of half-width a. The foundation with the same half-width has the indentation d_a on the same gap, and with
//! U(d) = ∫ max(0, d − g) dx
//!
//! ```text
//! |{g < d_a}| = 2a        K/H = κ w/U(d_a)        K/H · U(d) = w
//! ```
//!
//! κ: K/H of the criterion in use over that of equal half-width in Hertz's contact under the same load, 1 for the half-width. By δ − d
//! the bodies approach each other more than the foundation. Between those loads K/H is a power of the load, and the compliance (δ − d)/w linear in its
//! logarithm; both are linear in the position between the places. On the gap of two involutes this is Hertz's contact.
//!
//! Between neighbouring values of a sampled gap |{g < d}| is linear in d and U quadratic: both indentations d_a and d are found exactly.
//!
//! Limits: the gap is that of unworn flanks without relief; half-planes go on where the tooth ends.

use rayon::prelude::*;

use super::elastic_cells::ElasticCells;
use super::flank_motion::on_tangent;
use super::foundation::{FoundationCurve, FoundationStiffness, matched_mpa_per_mm, mean_positive};
use super::hertz;
use super::pressure_field::PressureField;
use super::settings::MatchCriterion;
use super::strip::{common_extent_mm, nearest_mm};
use gearwear_bodies::gear::flank_edge::PathEnd;
use gearwear_bodies::gear::normal_section::Obliquity;
use gearwear_bodies::gear::{Gear, GearPair, PerGear, conjugate::ConjugateFlanks, removed_material::tip_edge_mm};
use gearwear_bodies::material::{Material, contact_modulus_mpa};
use gearwear_bodies::reference::half_plane::cell_compliance_mm_per_mpa;

/// Greatest load over the whole load.
const GREATEST_LOAD: f64 = 1.5;
/// Number of indentations, each half of the one before.
const DEPTHS: usize = 11;
/// Number of places around each end of the path.
const PLACES: usize = 25;
/// Distance of the contact from the edge, in half-widths under the whole load, below which the edge counts.
const WIDENED: f64 = 1.25;
/// Cells of a window.
const CELLS: usize = 60;
/// Times that a window is fitted to the contact found in it.
const FITTINGS: usize = 2;
/// Part of the contact's width by which a window goes beyond it on either side.
const MARGIN: f64 = 0.2;

/// Foundations around A and E.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeFoundations {
    /// Positions from within the path outwards, before A and after E.
    ends: [Vec<EdgePosition>; 2],
}

/// Springs at a position.
#[derive(Debug, Clone, PartialEq)]
struct EdgePosition {
    position_mm: f64,
    stiffness: EdgeStiffness,
}

/// Stiffness at one position, by increasing load.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeStiffness {
    points: Vec<LoadedEdge>,
}

/// Stiffness at one position under one load.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LoadedEdge {
    ln_line_load: f64,
    ln_mpa_per_mm: f64,
    /// (δ − d)/w, mm²/N.
    further_mm2_per_n: f64,
}

impl EdgeFoundations {
    /// Foundations matched by `criterion` where the tip edges of `pair` touch under loads about `line_load_n_per_mm`. The difference of the
    /// calibrated `approach` to the closed-form flattening under that load is added in proportion to the load, as the spring of the teeth lacks it.
    pub fn new(
        pair: &GearPair,
        material: &PerGear<Material>,
        line_load_n_per_mm: f64,
        criterion: MatchCriterion,
        approach: &FoundationCurve,
    ) -> Self {
        let contact_modulus_mpa = contact_modulus_mpa(material.map(Material::elastic));
        let [before, after] = pair.ample_tip_reach_mm(line_load_n_per_mm, contact_modulus_mpa);
        let ends = [(PathEnd::Start, pair.path.start_mm - before), (PathEnd::End, pair.path.end_mm + after)];
        let ends = ends.map(|(end, last_mm)| {
            let edge_mm = pair.edge_position_mm(end);
            let half_width_mm = hertz::flattening(&pair.normal_section(), material, edge_mm)
                .contact
                .loaded(line_load_n_per_mm)
                .half_width_mm;
            // Length of the path on which the edge is within the contact; near a base circle a contact hardly moves over the flank.
            let within_mm = WIDENED * half_width_mm / pair.rolling_ratio(pair.edge(end).gear, edge_mm);
            let within_mm = within_mm.min(0.5 * (pair.path.end_mm - pair.path.start_mm));
            let first_mm = edge_mm + within_mm.copysign(edge_mm - last_mm);
            // Closer together where flank and edge share the contact.
            let places: Vec<f64> = (0..PLACES)
                .map(|k| first_mm + (last_mm - first_mm) * (k as f64 / (PLACES - 1) as f64).powi(2))
                .collect();
            let bodies = EdgeBodies { pair, material, line_load_n_per_mm, criterion, approach };
            places
                .into_par_iter()
                .map(|at| EdgePosition { position_mm: at, stiffness: bodies.springs_at(at) })
                .collect()
        });
        Self { ends }
    }

    /// Springs at a position; none where no edge counts.
    pub fn at(&self, position_mm: f64) -> Option<EdgeStiffness> {
        self.ends.iter().find_map(|places| {
            let first_mm = places.first()?.position_mm;
            let outwards = (places.last()?.position_mm - first_mm).signum();
            let beyond_mm = outwards * (position_mm - first_mm);
            if beyond_mm < 0.0 {
                return None;
            }
            let passed = places.partition_point(|place| outwards * (place.position_mm - first_mm) <= beyond_mm);
            let [low, high] = [passed.min(PLACES - 1) - 1, passed.min(PLACES - 1)].map(|k| &places[k]);
            let weight = (position_mm - low.position_mm) / (high.position_mm - low.position_mm);
            Some(low.stiffness.towards(&high.stiffness, weight.min(1.0))).filter(|stiffness| stiffness.points.len() > 1)
        })
    }
}

impl EdgeStiffness {
    /// Linear interpolation to `other`, load by load from the greatest on.
    fn towards(&self, other: &Self, weight: f64) -> Self {
        let points = self.points.iter().rev().zip(other.points.iter().rev()).map(|(low, high)| LoadedEdge {
            ln_line_load: low.ln_line_load + weight * (high.ln_line_load - low.ln_line_load),
            ln_mpa_per_mm: low.ln_mpa_per_mm + weight * (high.ln_mpa_per_mm - low.ln_mpa_per_mm),
            further_mm2_per_n: low.further_mm2_per_n + weight * (high.further_mm2_per_n - low.further_mm2_per_n),
        });
        let mut points: Vec<LoadedEdge> = points.collect();
        points.reverse();
        Self { points }
    }

    /// Both points between which `of` is `value`.
    fn segment(&self, value: f64, of: impl Fn(&LoadedEdge) -> f64) -> [LoadedEdge; 2] {
        let after = self.points.partition_point(|point| of(point) <= value).clamp(1, self.points.len() - 1);
        [self.points[after - 1], self.points[after]]
    }

    fn power_law([low, high]: [LoadedEdge; 2]) -> FoundationStiffness {
        let load_exponent = -(high.ln_mpa_per_mm - low.ln_mpa_per_mm) / (high.ln_line_load - low.ln_line_load);
        FoundationStiffness::new(low.ln_mpa_per_mm.exp(), load_exponent, low.ln_line_load.exp())
    }

    /// K/H under a line load (> 0), MPa/mm.
    pub fn mpa_per_mm(&self, line_load_n_per_mm: f64) -> f64 {
        Self::power_law(self.segment(line_load_n_per_mm.ln(), |p| p.ln_line_load)).mpa_per_mm(line_load_n_per_mm)
    }

    /// Load and stiffness as of [`FoundationStiffness::load_and_stiffness`].
    pub(crate) fn load_and_stiffness(&self, penetration_mm2: f64, contact_mm: f64) -> (f64, f64) {
        // U = w/(K/H) tells the segment.
        let segment = self.segment(penetration_mm2.ln(), |p| p.ln_line_load - p.ln_mpa_per_mm);
        Self::power_law(segment).load_and_stiffness(penetration_mm2, contact_mm)
    }

    /// δ − d under a line load, and its derivative by the load.
    pub fn further_approach_mm(&self, line_load_n_per_mm: f64) -> (f64, f64) {
        if line_load_n_per_mm <= 0.0 {
            return (0.0, 0.0);
        }
        let [low, high] = self.segment(line_load_n_per_mm.ln(), |p| p.ln_line_load);
        let slope = (high.further_mm2_per_n - low.further_mm2_per_n) / (high.ln_line_load - low.ln_line_load);
        let compliance = low.further_mm2_per_n + slope * (line_load_n_per_mm.ln() - low.ln_line_load);
        (compliance * line_load_n_per_mm, compliance + slope)
    }
}

/// Bodies to which the foundation is matched.
struct EdgeBodies<'a> {
    pair: &'a GearPair,
    material: &'a PerGear<Material>,
    line_load_n_per_mm: f64,
    criterion: MatchCriterion,
    approach: &'a FoundationCurve,
}

/// Half-planes in contact: δ, w, a, and the gap less its least value at even distances.
struct Pressed {
    indentation_mm: f64,
    line_load_n_per_mm: f64,
    half_width_mm: f64,
    gap_mm: Vec<f64>,
    spacing_mm: f64,
}

impl EdgeBodies<'_> {
    fn springs_at(&self, position_mm: f64) -> EdgeStiffness {
        let flattening = hertz::flattening(&self.pair.normal_section(), self.material, position_mm);
        let load = GREATEST_LOAD * self.line_load_n_per_mm;
        let half_width_mm = WIDENED * flattening.contact.loaded(load).half_width_mm;
        let ((lower_mm, upper_mm), _) = common_extent_mm(self.pair, position_mm);
        let centre_mm = nearest_mm(self.pair, position_mm, (lower_mm, upper_mm));
        let mut window = (lower_mm.max(centre_mm - half_width_mm), upper_mm.min(centre_mm + half_width_mm));
        let mut indentation_mm = flattening.approach_mm(load);
        let mut points = Vec::with_capacity(DEPTHS);
        for _ in 0..DEPTHS {
            let mut pressed = None;
            for _ in 0..FITTINGS {
                let found = self.pressed(position_mm, window, indentation_mm);
                let Some((found, (from_mm, to_mm))) = found else { break };
                let margin_mm = MARGIN * (to_mm - from_mm);
                window = (lower_mm.max(from_mm - margin_mm), upper_mm.min(to_mm + margin_mm));
                pressed = Some(found);
            }
            points.extend(pressed.map(|pressed: Pressed| {
                let [own, as_wide] = [self.criterion, MatchCriterion::HalfWidth]
                    .map(|criterion| matched_mpa_per_mm(criterion, &flattening, pressed.line_load_n_per_mm));
                pressed.matched(own / as_wide)
            }));
            indentation_mm *= 0.5;
        }
        points.reverse();
        let w = self.line_load_n_per_mm;
        let calibrated =
            self.approach.springs_at(position_mm).approach_and_compliance(flattening.contact.relative_radius_mm(), w).0;
        let beside_mm2_per_n = (calibrated - flattening.approach_mm(w)) / w;
        points.iter_mut().for_each(|point: &mut LoadedEdge| point.further_mm2_per_n += beside_mm2_per_n);
        EdgeStiffness { points }
    }

    /// Half-planes pressed together by `indentation_mm` in a window of the tangent, and the ends of their contact.
    fn pressed(&self, position_mm: f64, window: (f64, f64), indentation_mm: f64) -> Option<(Pressed, (f64, f64))> {
        let (from_mm, to_mm) = window;
        let spacing_mm = (to_mm - from_mm) / (2 * CELLS) as f64;
        let obliquity = self.pair.obliquity();
        let mut gap_mm: Vec<f64> =
            (0..=2 * CELLS).map(|k| self.gap_mm(position_mm, from_mm + k as f64 * spacing_mm, obliquity)).collect();
        let least_mm = gap_mm.iter().copied().fold(f64::INFINITY, f64::min);
        gap_mm.iter_mut().for_each(|gap| *gap -= least_mm);
        let flattening = hertz::flattening(&self.pair.normal_section(), self.material, position_mm);
        let width_mm = 2.0 * spacing_mm;
        let mut cells = ElasticCells::new(width_mm, cell_compliance_mm_per_mpa(&flattening.bodies, width_mm, CELLS));
        // Mean of each cell.
        let of_cells: Vec<f64> = gap_mm.windows(3).step_by(2).map(|g| (g[0] + 4.0 * g[1] + g[2]) / 6.0).collect();
        cells.set_gap(&of_cells);
        let response = cells.load_at(indentation_mm);
        let mut field = PressureField::new(from_mm, width_mm, false);
        field.fill(|pressure| cells.pressure_mpa(pressure));
        let (lower_mm, upper_mm) = field.extent_mm();
        let touches = response.line_load_n_per_mm > 0.0 && upper_mm > lower_mm;
        let pressed = Pressed {
            indentation_mm,
            line_load_n_per_mm: response.line_load_n_per_mm,
            half_width_mm: 0.5 * (upper_mm - lower_mm),
            gap_mm,
            spacing_mm,
        };
        touches.then_some((pressed, (lower_mm, upper_mm)))
    }

    /// Gap of the unworn flanks, along their normal.
    fn gap_mm(&self, position_mm: f64, along_mm: f64, obliquity: Obliquity) -> f64 {
        let [pinion, wheel] = Gear::BOTH.map(|gear| {
            let (rho_mm, drop_mm) = self.pair.at_along(gear, on_tangent(gear, along_mm), position_mm);
            let rounding_mm = self.pair.spec.gears[gear].modification.tip_rounding_mm;
            drop_mm + tip_edge_mm(rounding_mm, &self.pair.teeth[gear], rho_mm)
        });
        obliquity.normal_mm(pinion + wheel)
    }
}

impl Pressed {
    /// Foundation whose K/H is `stiffer` times that of the foundation with the same half-width.
    fn matched(&self, stiffer: f64) -> LoadedEdge {
        let w = self.line_load_n_per_mm;
        let mut levels_mm = self.gap_mm.clone();
        levels_mm.sort_by(f64::total_cmp);
        let as_wide_mm = self.indentation_mm_where(&levels_mm, |at| at.contact_mm - 2.0 * self.half_width_mm);
        let penetration_mm2 = self.penetration(as_wide_mm).area_mm2 / stiffer;
        let foundation_mm = self.indentation_mm_where(&levels_mm, |at| at.area_mm2 - penetration_mm2);
        LoadedEdge {
            ln_line_load: w.ln(),
            ln_mpa_per_mm: (w / penetration_mm2).ln(),
            further_mm2_per_n: (self.indentation_mm - foundation_mm) / w,
        }
    }

    /// Least indentation of the foundation at which `beyond`, |{g < d}| or U less a value, is not negative, at most twice that of the half-planes.
    /// `levels_mm`: the gaps, rising.
    fn indentation_mm_where(&self, levels_mm: &[f64], beyond: impl Fn(&Penetration) -> f64) -> f64 {
        let most_mm = 2.0 * self.indentation_mm;
        let above = levels_mm.partition_point(|&level_mm| beyond(&self.penetration(level_mm)) < 0.0);
        let low_mm = levels_mm[above.max(1) - 1];
        let high_mm = levels_mm.get(above).copied().unwrap_or(most_mm).min(most_mm);
        if low_mm >= high_mm {
            return high_mm;
        }
        let [low, middle, high] =
            [low_mm, low_mm.midpoint(high_mm), high_mm].map(|at_mm| beyond(&self.penetration(at_mm)));
        // f₀ + b t + a t² on 0 ≤ t ≤ 1, rising.
        let (a, b) = (2.0 * (low - 2.0 * middle + high), 4.0 * middle - 3.0 * low - high);
        let t = -2.0 * low / (b + (b * b - 4.0 * a * low).max(0.0).sqrt());
        low_mm + t.clamp(0.0, 1.0) * (high_mm - low_mm)
    }

    /// Penetration of the foundation by an indentation: sums over the intervals between samples, where the gap is linear.
    fn penetration(&self, indentation_mm: f64) -> Penetration {
        let parts =
            self.gap_mm.windows(2).map(|ends| mean_positive([indentation_mm - ends[0], indentation_mm - ends[1]]));
        let (mean, fraction) = parts.fold((0.0, 0.0), |sum, part| (sum.0 + part.0, sum.1 + part.1));
        Penetration { area_mm2: self.spacing_mm * mean, contact_mm: self.spacing_mm * fraction }
    }
}

/// Penetration of a foundation: U and |{g < d}|.
struct Penetration {
    area_mm2: f64,
    contact_mm: f64,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The foundation penetrates, and touches, as far as is asked for, on a gap with a slope on one side and a curve on the other; where that is out of
    /// reach it has twice the indentation of the half-planes.
    #[test]
    fn ver_indentations_are_found_exactly() {
        let gap_mm = (0..=2 * CELLS).map(|k| (k as f64 - 31.0) / 40.0);
        let gap_mm = gap_mm.map(|x| if x < 0.0 { -0.7 * x } else { 0.3 * x * x }).collect();
        let pressed =
            Pressed { indentation_mm: 1.5, line_load_n_per_mm: 100.0, half_width_mm: 1.0, gap_mm, spacing_mm: 0.025 };
        let mut levels_mm = pressed.gap_mm.clone();
        levels_mm.sort_by(f64::total_cmp);
        for part in [1e-6, 1e-3, 0.1, 0.4, 0.9, 0.999] {
            let whole = pressed.penetration(3.0);
            let (area_mm2, contact_mm) = (part * whole.area_mm2, part * whole.contact_mm);
            let deep_mm = pressed.indentation_mm_where(&levels_mm, |at| at.area_mm2 - area_mm2);
            assert!((pressed.penetration(deep_mm).area_mm2 / area_mm2 - 1.0).abs() < 1e-9, "{part}: {deep_mm}");
            let wide_mm = pressed.indentation_mm_where(&levels_mm, |at| at.contact_mm - contact_mm);
            assert!((pressed.penetration(wide_mm).contact_mm / contact_mm - 1.0).abs() < 1e-9, "{part}: {wide_mm}");
        }
        assert_eq!(pressed.indentation_mm_where(&levels_mm, |at| at.contact_mm - 3.1), 3.0);
    }
}
