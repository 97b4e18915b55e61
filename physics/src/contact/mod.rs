//! Contact surfaces: how a tooth pair answers when its flanks are pressed together.
//!
//! One interface for all models. A [`ContactSurface`] prepares a [`PairContact`] for each tooth pair at each loading
//! position; the mesh cycle then presses it and reads load and stiffness, and the wear collects pressure
//! and sliding of each flank point ([`Sweep`]). A contact reads the flank only as *removed material*: modifications and wear alike.
//!
//! | surface | pressure | load against approach |
//! |---|---|---|
//! | [`winkler`] | independent springs K/H against the real gap | from the pressure |
//! | [`half_space`] | elastic half-planes against the real gap | from the pressure |
//! | [`hertz`] | Hertz's ellipse on the nominal curvature | closed-form flattening |
//! | [`hertz_mean`] | Hertz's mean pressure, closed-form sliding | closed-form flattening |

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
pub(crate) mod strip;
pub(crate) mod swept_field;
pub mod winkler;

use serde::{Deserialize, Serialize};

use crate::gear::{
    Gear, GearPair, PerGear, conjugate::ConjugateFlanks, flank::FlankGrid, normal_section::NormalSection,
};
use flank_pressure::FlankParts;

/// Two flanks and the points on them.
#[derive(Clone, Copy)]
pub struct Flanks<'a> {
    /// Their geometry, in the normal section: gaps and what is removed are normal to the flanks.
    pub geometry: NormalSection<'a>,
    /// Their points.
    pub grid: PerGear<&'a FlankGrid>,
    /// What of the removed material is no wear but the modification of the profile, but for a constant; none where that is not told
    /// apart.
    pub modification_mm: Option<PerGear<&'a [f64]>>,
    /// Whose tip edge may carry load and is mathematically sharp: contact that it cuts off has no pressure of its own.
    pub sharp_edges: PerGear<bool>,
    /// The parts that figures of pressure speak of; none where nobody asks for such.
    pub parts: Option<FlankParts>,
    /// Whose corner at the form circle, which undercut leaves, may carry load.
    pub sharp_corners: PerGear<bool>,
}

impl<'a> Flanks<'a> {
    /// Flanks that end where their contact does, and along whose lines of contact nothing changes: no tip edge carries load.
    pub fn new(geometry: &'a dyn ConjugateFlanks, grid: PerGear<&'a FlankGrid>) -> Self {
        Self::in_section(NormalSection::of_spur(geometry), grid)
    }

    /// The same of gears.
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
            parts: None,
        }
    }
}

/// A loading position and the stretch of the path of contact it stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PositionCell {
    /// Theoretical contact point.
    pub position_mm: f64,
    /// Where the stretch begins.
    pub lower_mm: f64,
    /// Where it ends.
    pub upper_mm: f64,
}

impl PositionCell {
    /// Whether the contact moves to both sides of its position while it stands for the stretch: not at A and E, where the stretch ends at the position,
    /// but for the last bits with which either is calculated.
    pub(crate) fn goes_both_ways(&self) -> bool {
        let round_off = flank_motion::ROUND_OFF * (self.upper_mm - self.lower_mm);
        self.position_mm - self.lower_mm > round_off && self.upper_mm - self.position_mm > round_off
    }
}

/// A tooth pair's answer to being pressed together.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Response {
    /// Load it carries, N per mm of the line of contact: as much as F_bt per mm of face width.
    pub line_load_n_per_mm: f64,
    /// Derivative of the load with respect to the indentation, N/mm².
    pub stiffness_n_per_mm2: f64,
}

/// What consecutive points of one flank wear by while the contact moves through a [`PositionCell`]; the vectors have the
/// same length. Filled anew for each pair, so that one buffer serves many.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sweep {
    /// Index of the first of the points.
    pub first_point: usize,
    /// Pressure on each, averaged over the cell, MPa.
    pub pressure_mpa: Vec<f64>,
    /// How far each slides against the other flank while it faces it, mm.
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

/// What an observer sees of one point of a [`Sweep`].
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PointContact {
    /// Greatest pressure while the contact moves through the cell and the point faces the other flank, MPa.
    pub pressure_mpa: f64,
    /// Part of the cell's sliding during which the point is in contact, 0 to 1.
    pub contact_fraction: f64,
}

/// Where the contact is and how hard it presses.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Footprint {
    /// Greatest pressure, MPa.
    pub peak_pressure_mpa: f64,
    /// Half the extent of the contact strip, mm.
    pub half_width_mm: f64,
    /// Whether a sharp tip edge cuts the contact off: the pressure then is not defined, and what is found grows with every refinement.
    pub at_sharp_edge: bool,
}

/// A part of a contact under a mean pressure. Places are along the tangent from the theoretical contact point, positive towards the
/// pinion's tip.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressedCell {
    /// Where it begins, mm.
    pub lower_mm: f64,
    /// Where it ends, mm.
    pub upper_mm: f64,
    /// Mean pressure on it, MPa.
    pub pressure_mpa: f64,
}

impl PressedCell {
    /// The load on it, N/mm.
    pub fn line_load_n_per_mm(&self) -> f64 {
        self.pressure_mpa * (self.upper_mm - self.lower_mm)
    }

    /// The part of it from one place to another; none where there is no such.
    pub(crate) fn within(&self, [from_mm, to_mm]: [f64; 2]) -> Option<Self> {
        let (lower_mm, upper_mm) = (self.lower_mm.max(from_mm), self.upper_mm.min(to_mm));
        (lower_mm < upper_mm).then_some(Self { lower_mm, upper_mm, ..*self })
    }

    /// Evenly spaced cells of `width_mm` from `lower_mm` on.
    pub(crate) fn evenly(lower_mm: f64, width_mm: f64, pressures_mpa: impl Iterator<Item = f64>) -> Vec<Self> {
        let at = |k: usize| lower_mm + k as f64 * width_mm;
        let cell = |(k, pressure_mpa)| Self { lower_mm: at(k), upper_mm: at(k + 1), pressure_mpa };
        pressures_mpa.enumerate().map(cell).collect()
    }

    /// `half_width_mm` to either side of the theoretical contact point under one pressure.
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

    /// Approach of the bodies under a line load beside the indentation, and its derivative by the load: what a model
    /// whose surface yields too little leaves out.
    fn further_approach_mm(&self, _line_load_n_per_mm: f64) -> (f64, f64) {
        (0.0, 0.0)
    }

    /// An indentation that should carry at least `line_load_n_per_mm`, to begin an iteration with.
    fn ample_indentation_mm(&self, line_load_n_per_mm: f64) -> f64;

    /// Whether, at the last indentation, the stretch of flank this contact looks
    /// at holds all that touches then. If not, [`widen`](Self::widen) it, read and press again.
    fn window_suffices(&mut self) -> bool {
        true
    }

    /// Looks at a longer stretch of flank.
    fn widen(&mut self) {}

    /// How deep flanks that have lost `removed_mm` overlap beside the stretch this contact looks at, at the last indentation, mm; 0 where
    /// they do so nowhere, and none of contacts that do not look at the real gap.
    fn overlap_beside_mm(&self, _removed_mm: PerGear<&[f64]>) -> Option<f64> {
        None
    }

    /// Is again as it was when it was made: what it does then depends only on what it reads and how it is pressed from now on, to the
    /// bit. For contacts that keep something from one wear step to the next.
    fn reset(&mut self) {}

    /// Fills in pressure and sliding of the points of a flank; nothing for a pair prepared without a [`PositionCell`].
    fn sweep(&self, gear: Gear, removed_mm: PerGear<&[f64]>, sweep: &mut Sweep);

    /// Whether the points of a [`Sweep`] run across the contact from one end of its strip to the other, each under its own pressure;
    /// otherwise they are those that pass the theoretical contact point, and each passes through all of the contact.
    fn sweeps_across(&self) -> bool {
        true
    }

    /// The contact of each point of that [`Sweep`], for an observer.
    fn contact_of_points(&self, gear: Gear, removed_mm: PerGear<&[f64]>) -> Vec<PointContact>;

    /// Extent and greatest pressure.
    fn footprint(&self) -> Footprint;

    /// The pressure along the contact, cell after cell towards the pinion's tip; their loads are that of the contact.
    fn pressed_cells(&self) -> Vec<PressedCell>;
}

/// How long equilibria take, about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Effort {
    /// Of a tooth pair, over that on springs.
    pub of_equilibrium: f64,
    /// What one without anything to start from takes more, over one with.
    pub of_clean_start: f64,
}

/// A model of the surfaces in contact.
pub trait ContactSurface: Sync {
    /// Prepares a tooth pair with its theoretical contact point at `position_mm`; with a `cell`, its wear is collected.
    fn pair<'a>(&self, flanks: Flanks<'a>, position_mm: f64, cell: Option<PositionCell>) -> Box<dyn PairContact + 'a>;

    /// Approach of plain involutes under a line load at `position_mm`, away from the tip edges.
    fn plain_approach_mm(&self, geometry: &dyn ConjugateFlanks, position_mm: f64, line_load_n_per_mm: f64) -> f64;

    /// Whether a pair touches in the theoretical contact point alone, so that the wear of a contact is that of one place of the flanks; else it
    /// touches over a strip.
    fn touches_in_points(&self) -> bool {
        false
    }

    /// How long equilibria take.
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
        let goes = |lower_mm, upper_mm| PositionCell { position_mm: 23.4, lower_mm, upper_mm }.goes_both_ways();
        for end_mm in [23.4_f64.next_down(), 23.4, 23.4_f64.next_up()] {
            assert!(!goes(22.9, end_mm) && !goes(end_mm, 23.9));
        }
        assert!(goes(22.9, 23.9));
    }
}
