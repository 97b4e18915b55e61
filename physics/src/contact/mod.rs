//! Contact surfaces: load and pressure of a tooth pair whose flanks are pressed together.
//!
//! A [`ContactSurface`] prepares a [`PairContact`] for each tooth pair at each loading position; the mesh cycle presses it and reads load and
//! stiffness, and the wear collects pressure and sliding of each flank point ([`Sweep`]). A contact reads a flank only as *removed material*:
//! modifications and wear alike.
//!
//! | surface | pressure | load against approach |
//! |---|---|---|
//! | [`winkler`] | independent springs K/H against the real gap | from the pressure |
//! | [`half_space`] | elastic half-planes against the real gap | from the pressure |
//! | [`hertz`] | Hertz's ellipse on the nominal curvature | closed-form flattening |
//! | [`hertz_mean`] | Hertz's mean pressure, closed-form sliding | closed-form flattening |

mod coordinates_along;
pub mod edge_foundation;
pub(crate) mod elastic_cells;
mod flank_motion;
pub mod flank_pressure;
pub mod foundation;
pub(crate) mod gap_at_points;
mod growing_window;
pub mod half_space;
pub mod hertz;
pub mod hertz_mean;
pub(crate) mod observed_points;
pub(crate) mod pressure_field;
pub mod settings;
pub(crate) mod standard_deviation;
pub(crate) mod strip;
pub(crate) mod swept_field;
mod toeplitz;
mod weighted_rows;
pub mod winkler;

use serde::{Deserialize, Serialize};

use flank_pressure::FlankParts;
use gearwear_bodies::gear::{
    Gear, GearPair, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid, normal_section::NormalSection,
};

/// Two flanks and the points on them.
#[derive(Clone, Copy)]
pub struct Flanks<'a> {
    /// Geometry in the normal section: gaps and removed material are normal to the flanks.
    pub geometry: NormalSection<'a>,
    /// Points of each flank.
    pub grid: PerGear<&'a FlankGrid>,
    /// Part of the removed material that is modification of the profile, but for a constant; none where wear and modification are not told
    /// apart.
    pub modification_mm: Option<PerGear<&'a [f64]>>,
    /// Gears whose tip edge may carry load and is sharp: the pressure of a contact that it cuts off is not defined.
    pub sharp_edges: PerGear<bool>,
    /// Zones of the flanks; none where no figures of pressure are wanted.
    pub parts: Option<FlankParts>,
    /// Gears whose corner of undercut, at the form circle, may carry load.
    pub sharp_corners: PerGear<bool>,
    /// Coordinate at which the tip edge of each gear or its rounding begins, mm.
    pub tip_from_mm: PerGear<f64>,
}

impl<'a> Flanks<'a> {
    /// Flanks of a spur section without tip edges under load.
    pub fn new(geometry: &'a dyn ConjugateFlanks, grid: PerGear<&'a FlankGrid>) -> Self {
        Self::in_section(NormalSection::of_spur(geometry), grid)
    }

    /// Flanks of gears without tip edges under load.
    pub fn of_gears(pair: &'a GearPair, grid: PerGear<&'a FlankGrid>) -> Self {
        Self::in_section(pair.normal_section(), grid)
    }

    fn in_section(geometry: NormalSection<'a>, grid: PerGear<&'a FlankGrid>) -> Self {
        Self {
            geometry,
            grid,
            modification_mm: None,
            sharp_edges: PerGear::default(),
            sharp_corners: PerGear::default(),
            tip_from_mm: flank_motion::tips_mm(&geometry),
            parts: None,
        }
    }
}

/// A loading position and the stretch of the path of contact that it represents.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionCell {
    /// Theoretical contact point.
    pub position_mm: f64,
    /// Begin of the stretch.
    pub lower_mm: f64,
    /// End of the stretch.
    pub upper_mm: f64,
}

impl PositionCell {
    /// Whether the stretch goes to both sides of the position: not at A and E, where it ends at the position but for rounding errors.
    pub(crate) fn goes_both_ways(&self) -> bool {
        let round_off = flank_motion::ROUND_OFF * (self.upper_mm - self.lower_mm);
        self.position_mm - self.lower_mm > round_off && self.upper_mm - self.position_mm > round_off
    }
}

/// Load and stiffness of a tooth pair that is pressed together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Load it carries, N per mm of the line of contact: as much as F_bt per mm of face width.
    pub line_load_n_per_mm: f64,
    /// Derivative of the load with respect to the indentation, N/mm².
    pub stiffness_n_per_mm2: f64,
}

/// Pressure and sliding of consecutive points of one flank while the contact moves through a [`PositionCell`], in vectors of the same length: a
/// buffer that is filled anew for each pair.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sweep {
    /// Index of the first of the points.
    pub first_point: usize,
    /// Pressure on each, averaged over the cell, MPa.
    pub pressure_mpa: Vec<f64>,
    /// Distance that each slides against the other flank while it faces it, mm.
    pub sliding_mm: Vec<f64>,
}

impl Sweep {
    /// Makes room for the points that slide by `sliding_mm`, the first of them `first_point`.
    fn begin(&mut self, first_point: usize, sliding_mm: &[f64]) {
        self.first_point = first_point;
        self.sliding_mm.clear();
        self.sliding_mm.extend_from_slice(sliding_mm);
        self.pressure_mpa.resize(sliding_mm.len(), 0.0);
    }
}

/// Contact of one point of a [`Sweep`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PointContact {
    /// Greatest pressure while the contact moves through the cell and the point faces the other flank, MPa.
    pub pressure_mpa: f64,
    /// Part of the cell's sliding during which the point is in contact, 0 to 1.
    pub contact_fraction: f64,
}

/// Extent and greatest pressure of a contact.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Footprint {
    /// Greatest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the extent of the contact strip, mm.
    pub half_width_mm: f64,
    /// Half-width of the heated strip, mm: on elastic half-planes and finite elements that of Hertz's ellipse with the same second moment, otherwise half
    /// the extent.
    pub equivalent_half_width_mm: f64,
    /// Whether a sharp edge cuts the contact off: its pressure is then not defined, and grows with every refinement.
    pub at_sharp_edge: bool,
}

/// A part of a contact under a mean pressure. Places are along the tangent from the theoretical contact point, positive towards the
/// pinion's tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressedCell {
    /// Begin, mm.
    pub lower_mm: f64,
    /// End, mm.
    pub upper_mm: f64,
    /// Mean pressure on it, MPa.
    pub pressure_mpa: f64,
}

impl PressedCell {
    /// Load on the cell, N/mm.
    pub fn line_load_n_per_mm(&self) -> f64 {
        self.pressure_mpa * (self.upper_mm - self.lower_mm)
    }

    /// Part of the cell from one place to another; none where it has none there.
    pub(crate) fn within(&self, [from_mm, to_mm]: [f64; 2]) -> Option<Self> {
        let (lower_mm, upper_mm) = (self.lower_mm.max(from_mm), self.upper_mm.min(to_mm));
        (lower_mm < upper_mm).then_some(Self { lower_mm, upper_mm, ..*self })
    }

    /// Evenly spaced cells of `width_mm` from `lower_mm` on.
    pub(crate) fn evenly(lower_mm: f64, width_mm: f64, pressures_mpa: impl Iterator<Item = f64>) -> Vec<Self> {
        let cells = pressures_mpa.enumerate().map(|(k, pressure_mpa)| {
            let [lower_mm, upper_mm] = [k, k + 1].map(|k| lower_mm + k as f64 * width_mm);
            Self { lower_mm, upper_mm, pressure_mpa }
        });
        cells.collect()
    }

    /// One cell of `half_width_mm` to either side of the theoretical contact point.
    pub(crate) fn even(half_width_mm: f64, pressure_mpa: f64) -> Vec<Self> {
        vec![Self { lower_mm: -half_width_mm, upper_mm: half_width_mm, pressure_mpa }]
    }
}

/// One tooth pair at one loading position.
///
/// Order of use: [`set_removed`](Self::set_removed) the flanks, [`load_at`](Self::load_at) until the mesh cycle is in equilibrium,
/// [`window_suffices`](Self::window_suffices), then [`sweep`](Self::sweep) and [`footprint`](Self::footprint) of the last approach pressed.
pub trait PairContact: Send {
    /// Takes the material removed at each flank point, mm.
    fn set_removed(&mut self, removed_mm: PerGear<&[f64]>);

    /// Approach at which the flanks first touch: zero where they are unworn and unmodified.
    fn touch_mm(&self) -> f64;

    /// Load and stiffness when the flanks are pressed together by `indentation_mm` beyond their first touch.
    fn load_at(&mut self, indentation_mm: f64) -> Response;

    /// Approach of the bodies under a line load beyond the indentation, and its derivative by the load: the part that a model
    /// whose surface is too stiff leaves out.
    fn further_approach_mm(&self, _line_load_n_per_mm: f64) -> (f64, f64) {
        (0.0, 0.0)
    }

    /// Indentation that should carry at least `line_load_n_per_mm`, to begin an iteration with.
    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64;

    /// Whether the window of this contact holds all that touches at the last indentation, on flanks that have lost `removed_mm`. If not,
    /// [`widen`](Self::widen) it, set the removed material and press again.
    fn window_suffices(&mut self, _removed_mm: PerGear<&[f64]>) -> bool {
        true
    }

    /// Widens the window.
    fn widen(&mut self) {}

    /// Greatest overlap of flanks that have lost `removed_mm` beside the window at the last indentation, mm; 0 where they overlap nowhere, none for
    /// contacts without the real gap.
    fn overlap_beside_mm(&self, _removed_mm: PerGear<&[f64]>) -> Option<f64> {
        None
    }

    /// Returns to the state in which the contact was made, so that later results are the same bits whatever was pressed before.
    fn reset(&mut self) {}

    /// Fills in pressure and sliding of the points of a flank; nothing for a pair prepared without a [`PositionCell`].
    fn sweep(&self, gear: Gear, removed_mm: PerGear<&[f64]>, sweep: &mut Sweep);

    /// Whether the points of a [`Sweep`] run across the contact from end to end, each under its own pressure;
    /// otherwise they pass the theoretical contact point, and each passes through all of the contact.
    fn sweeps_across(&self) -> bool {
        true
    }

    /// Contact of each point of that [`Sweep`].
    fn contact_of_points(&self, gear: Gear, removed_mm: PerGear<&[f64]>) -> Vec<PointContact>;

    /// Extent and greatest pressure.
    fn footprint(&self) -> Footprint;

    /// Pressure along the contact, cell after cell towards the pinion's tip; the sum of their loads is that of the contact.
    fn pressed_cells(&self) -> Vec<PressedCell>;
}

/// Approximate computing time of equilibria.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Time of a tooth pair over that on springs.
    pub of_equilibrium: f64,
    /// Time of an equilibrium without a start over that with one.
    pub of_clean_start: f64,
}

/// A model of the surfaces in contact.
pub trait ContactSurface: Sync {
    /// Prepares a tooth pair with its theoretical contact point at `position_mm`; with a `cell`, its wear is collected.
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a>;

    /// Approach of unmodified involutes under a line load at `position_mm`, away from the tip edges.
    fn plain_approach_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64, line_load_n_per_mm: f64) -> f64;

    /// Whether a pair touches at the theoretical contact point alone, so that a contact wears one place of the flanks, and not a strip.
    fn touches_in_points(&self) -> bool {
        false
    }

    /// Approximate computing time of equilibria.
    fn effort(&self) -> Effort {
        Effort { of_equilibrium: 1.0, of_clean_start: 4.0 }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// At A and E the stretch ends at the position, whichever of the two the last bit has farther out.
    #[test]
    fn stretches_end_at_a_and_e_but_for_the_last_bit() {
        let whole = PositionCell { position_mm: 23.4, lower_mm: 22.9, upper_mm: 23.9 };
        assert!(whole.goes_both_ways());
        for end_mm in [23.4_f64.next_down(), 23.4, 23.4_f64.next_up()] {
            assert!(!PositionCell { upper_mm: end_mm, ..whole }.goes_both_ways());
            assert!(!PositionCell { lower_mm: end_mm, ..whole }.goes_both_ways());
        }
    }
}
