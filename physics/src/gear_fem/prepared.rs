//! A position ready to be solved on ever newly worn flanks.
//!
//! The couplings and the compliance between all multipliers depend on where the gears stand and not on what their flanks have
//! lost: wear h along the normals of both flanks' nodes only opens the gaps,
//!
//! ```text
//! g⁰(h) = g⁰ − B₁ (n₁ h₁) − B₂ (n₂ h₂)
//! ```
//!
//! as a displacement of the nodes into their bodies would. So a position is prepared once and solved many times; where wear has tilted
//! the flanks so far that the direction of the load matters, it is corrected for that ([`super::tilted`]).

use faer::Mat;
use sprs::CsMat;

use super::beside_window::BesideWindow;
use super::condensed_pair::CondensedPair;
use super::facing_teeth::{Direction, FacingTeeth, Window};
use super::ring::Between;
use crate::gear::Gear;
use gearwear_fem::active_set::{ActiveSetError, Condensed, Equilibrium, Kept, Log};

/// Distance between the flanks within which they may come to touch, in units of line load over E*: an approach is some
/// ten of these.
const FIRST_REACH: f64 = 25.0;
/// Part of the reach that the approach may use up: what lies farther apart may touch then.
const REACH_USED: f64 = 0.8;
/// Half-widths on either side of the expected contact in which multipliers are looked for first.
const FIRST_WINDOW: f64 = 1.4;
/// How much wider each further window is.
const WIDER: f64 = 1.6;
/// How much farther across the gap each further window reaches.
const FARTHER: f64 = 3.0;
/// Looks before giving up.
const MOST_WINDOWS: usize = 8;

/// A position with its couplings and compliance.
pub struct Prepared {
    /// ξ.
    pub position_mm: f64,
    window: Window,
    pub(super) facings: Vec<FacingTeeth>,
    /// Of each tooth pair.
    beside: Vec<BesideWindow>,
    pub(super) condensed: Condensed,
    /// Change of each row's place along the flank, from root to tip, per transmission error.
    pub(super) along_rotation: Vec<f64>,
    pub(super) sideways: Option<Sideways>,
    /// Of the flanks at each row; empty: not at all.
    pub(super) tilt_rad: Vec<f64>,
    unworn_gap_mm: Vec<f64>,
    /// Where the next solution starts.
    pub(super) active: Option<Vec<bool>>,
    pub(super) kept: Option<Kept>,
    /// Number of the window, from 1.
    windows: usize,
}

/// A position along the flanks ([`super::tilted`]), and as it was before it was tilted.
pub(super) struct Sideways {
    /// B⊥ C Bᵀ.
    pub compliance: Mat<f64>,
    /// B⊥ C B⊥ᵀ.
    pub along: Mat<f64>,
    pub level_compliance: Mat<f64>,
    pub level_rigid: Mat<f64>,
}

impl<'a> CondensedPair<'a> {
    /// Prepares the contact at `position_mm` under `line_load_n_per_mm`.
    pub fn prepare(&self, position_mm: f64, line_load_n_per_mm: f64) -> Prepared {
        self.prepare_among((self.gears.pinion.teeth() / 2) as i32, position_mm, line_load_n_per_mm)
    }

    /// The same with the reference pair alone.
    pub(crate) fn prepare_alone(&self, position_mm: f64, line_load_n_per_mm: f64) -> Prepared {
        self.prepare_among(0, position_mm, line_load_n_per_mm)
    }

    fn prepare_among(&self, beside: i32, position_mm: f64, line_load_n_per_mm: f64) -> Prepared {
        self.observe(position_mm, self.first_window(beside, line_load_n_per_mm))
    }

    /// Where contact is looked for first.
    fn first_window(&self, beside: i32, line_load_n_per_mm: f64) -> Window {
        Window {
            beside,
            line_load_n_per_mm,
            half_widths: FIRST_WINDOW,
            reach_mm: FIRST_REACH * line_load_n_per_mm / self.contact_modulus_mpa,
            overlaps: Vec::new(),
        }
    }

    fn observe(&self, position_mm: f64, window: Window) -> Prepared {
        let placed = self.placed_teeth(position_mm, &window);
        let facings = self.facings(&placed, &window);
        let beside = placed.iter().map(|placed| self.beside_window(placed, window.reach_mm)).collect();
        let condensed = self.condensed(&facings, window.line_load_n_per_mm);
        let along_rotation =
            facings.iter().flat_map(|facing| self.by_rotation(facing, Direction::AlongFlank)).collect();
        Prepared {
            position_mm,
            window,
            unworn_gap_mm: condensed.gap_mm.clone(),
            facings,
            beside,
            condensed,
            along_rotation,
            sideways: None,
            tilt_rad: Vec::new(),
            active: None,
            kept: None,
            windows: 1,
        }
    }

    /// Solves a prepared position, in a wider window where contact comes close to the end of the first or the flanks overlap beside it.
    /// `opening` adds to the gaps of the unworn flanks what these are opened by: each time anew where the window is wider, and so has other
    /// multipliers; `depth_mm` is what the local nodes of a gear's flank have lost.
    pub fn solve(
        &self,
        prepared: &mut Prepared,
        opening: &mut dyn FnMut(&Prepared, &mut [f64]),
        depth_mm: &dyn Fn(Gear, usize) -> f64,
    ) -> Result<Equilibrium, ActiveSetError> {
        let mut log = Log::default();
        for attempt in 1..=MOST_WINDOWS {
            prepared.open_gaps(opening);
            let last = attempt == MOST_WINDOWS;
            let wider = match prepared.condensed.solve_with(prepared.active.as_deref(), &mut prepared.kept) {
                Ok(mut found) => {
                    log.append(&mut found.log);
                    // What overlaps beside the last window is left, and told.
                    let wider = match prepared.is_cramped(&found) && !last {
                        true => Some(prepared.window.wider()),
                        false => self.window_over_overlaps(prepared, &found, depth_mm).filter(|_| !last),
                    };
                    prepared.active = Some(found.active.clone());
                    match wider {
                        Some(wider) => wider,
                        None => return Ok(Equilibrium { log, ..found }),
                    }
                }
                Err(error) if last || !prepared.misses_contact(&error) => return Err(error),
                Err(_) => prepared.window.wider(),
            };
            self.widen(prepared, wider);
        }
        unreachable!("the last attempt returns")
    }

    /// Where flanks far relieved or worn touch beside the window of `found`.
    fn window_over_overlaps(
        &self,
        prepared: &mut Prepared,
        found: &Equilibrium,
        depth_mm: &dyn Fn(Gear, usize) -> f64,
    ) -> Option<Window> {
        let Prepared { window, facings, beside, .. } = prepared;
        let mut wider: Option<Window> = None;
        for beside in beside {
            if let Some(overlap) = self.overlap(beside, facings, found, depth_mm) {
                wider.get_or_insert_with(|| window.clone()).reach_to(overlap);
            }
        }
        wider
    }

    /// Makes a prepared position as if it had never been solved, and its wear never seen: it starts from no contact, in a window no
    /// wider than at first.
    pub fn reset(&self, prepared: &mut Prepared) {
        if prepared.windows > 1 {
            let Window { beside, line_load_n_per_mm, .. } = prepared.window;
            *prepared = self.observe(prepared.position_mm, self.first_window(beside, line_load_n_per_mm));
        } else {
            prepared.level();
        }
    }

    fn widen(&self, prepared: &mut Prepared, window: Window) {
        let mut next = self.observe(prepared.position_mm, window);
        next.active = prepared.active.as_ref().map(|active| carried_over(&prepared.facings, active, &next.facings));
        next.windows = prepared.windows + 1;
        *prepared = next;
    }

    fn condensed(&self, facings: &[FacingTeeth], line_load_n_per_mm: f64) -> Condensed {
        let rows = facings.iter().map(|facing| facing.coupling.len()).sum();
        let mut rigid = Mat::zeros(rows, 1);
        let mut gap_mm = Vec::with_capacity(rows);
        for facing in facings {
            gap_mm.extend_from_slice(&facing.coupling.gap_mm);
            for (i, change) in self.by_rotation(facing, Direction::AcrossFlank).enumerate() {
                rigid[(facing.first_row + i, 0)] = change;
            }
        }
        let mut compliance = Mat::zeros(rows, rows);
        for gear in Gear::BOTH {
            let operators: Vec<&CsMat<f64>> = facings.iter().map(|facing| &facing.operator[gear]).collect();
            self.add_symmetric_sandwich(&mut compliance, facings, gear, &operators);
        }
        mirror_below(&mut compliance);
        Condensed { compliance, gap_mm, rigid, rigid_load: vec![-line_load_n_per_mm] }
    }

    /// Adds L C Lᵀ of a gear on and below the diagonal to `sum`, `operators` being L of each tooth pair.
    pub(super) fn add_symmetric_sandwich(
        &self,
        sum: &mut Mat<f64>,
        facings: &[FacingTeeth],
        gear: Gear,
        operators: &[&CsMat<f64>],
    ) {
        for (a, (facing, own)) in facings.iter().zip(operators).enumerate() {
            for (other, others) in facings[..=a].iter().zip(operators) {
                let places = (facing.first_row, other.first_row);
                let between = self.gears[gear].between(other.tooth[gear], facing.tooth[gear]);
                add_sandwich(sum, places, own, between, others, facing.first_row == other.first_row);
            }
        }
    }
}

impl Window {
    fn wider(&self) -> Self {
        let Self { half_widths, reach_mm, .. } = *self;
        Self { half_widths: WIDER * half_widths, reach_mm: FARTHER * reach_mm, ..self.clone() }
    }
}

impl Prepared {
    /// Is again as if its flanks had never been tilted, and never been solved.
    fn level(&mut self) {
        (self.active, self.kept) = (None, None);
        if let Some(Sideways { level_compliance, level_rigid, .. }) = &self.sideways {
            self.condensed.compliance.copy_from(level_compliance);
            self.condensed.rigid.copy_from(level_rigid);
            self.tilt_rad.clear();
        }
    }

    /// What part of the line load `force` on the multipliers from `first_row` on carries, with the lever that it has, N/mm.
    pub(super) fn carried_n_per_mm(&self, first_row: usize, force: &[f64]) -> f64 {
        force.iter().enumerate().map(|(k, f)| -f * self.condensed.rigid[(first_row + k, 0)]).sum()
    }

    /// w.
    pub fn line_load_n_per_mm(&self) -> f64 {
        self.window.line_load_n_per_mm
    }

    /// Number of the window, from 1: each is wider than the one before.
    pub fn windows(&self) -> usize {
        self.windows
    }

    /// How deep the flanks overlap beside the window of the last solution, mm.
    pub(crate) fn overlap_beside_mm(&self) -> f64 {
        self.beside.iter().map(BesideWindow::deepest_mm).fold(0.0, f64::max)
    }

    /// Number of tooth pairs that may touch.
    pub fn tooth_pairs(&self) -> usize {
        self.facings.len()
    }

    /// The gaps of the unworn flanks with what `opening` adds.
    fn open_gaps(&mut self, opening: &mut dyn FnMut(&Prepared, &mut [f64])) {
        let mut gap_mm = std::mem::take(&mut self.condensed.gap_mm);
        gap_mm.copy_from_slice(&self.unworn_gap_mm);
        opening(self, &mut gap_mm);
        self.condensed.gap_mm = gap_mm;
    }

    /// Whether contact failed for want of anything near enough to touch.
    fn misses_contact(&self, error: &ActiveSetError) -> bool {
        matches!(error, ActiveSetError::NoContact { .. }) || self.unworn_gap_mm.is_empty()
    }

    /// Whether contact may reach beyond what is looked at.
    fn is_cramped(&self, found: &Equilibrium) -> bool {
        found.rigid[0] > REACH_USED * self.window.reach_mm
            || self.facings.iter().any(|facing| facing.is_cramped(&found.force))
    }
}

/// The active set of `before` on the rows of `after`.
fn carried_over(before: &[FacingTeeth], active: &[bool], after: &[FacingTeeth]) -> Vec<bool> {
    let was_active = |pair: i32, node: usize| {
        before.iter().filter(|facing| facing.pair == pair).any(|facing| {
            let row = facing.coupling.nodes.iter().position(|&other| other == node);
            row.is_some_and(|row| active[facing.first_row + row])
        })
    };
    let rows = after.iter().flat_map(|facing| facing.coupling.nodes.iter().map(|&node| (facing.pair, node)));
    rows.map(|(pair, node)| was_active(pair, node)).collect()
}

/// Has above the diagonal what lies below it.
pub(super) fn mirror_below(matrix: &mut Mat<f64>) {
    for i in 0..matrix.nrows() {
        for j in i + 1..matrix.ncols() {
            matrix[(i, j)] = matrix[(j, i)];
        }
    }
}

/// Adds `left · Cᵀ · rightᵀ`, or the `half` of it on and below the diagonal, at `places` of `sum`; `compliance` is C, a row for a
/// column of `right`.
pub(super) fn add_sandwich(
    sum: &mut Mat<f64>,
    places: (usize, usize),
    left: &CsMat<f64>,
    compliance: Between<'_>,
    right: &CsMat<f64>,
    half: bool,
) {
    let (left_columns, left_place) = used_columns(left);
    let (right_columns, right_place) = used_columns(right);
    // Each entry of C is read once, into columns that lie together, and so are those of the right.
    let width = right_columns.len();
    let gathered = compliance.gathered(&right_columns, &left_columns);
    let right_entries: Vec<(usize, f64)> =
        right.indices().iter().zip(right.data()).map(|(&column, &value)| (right_place[column], value)).collect();
    let right_rows = right.indptr();
    let mut carried = vec![0.0; width];
    for (i, row) in left.outer_iterator().enumerate() {
        carried.fill(0.0);
        for (k, value) in row.iter() {
            let column = &gathered[left_place[k] * width..][..width];
            for (sum, c) in carried.iter_mut().zip(column) {
                *sum += value * c;
            }
        }
        let count = if half { i + 1 } else { right.rows() };
        for (j, row) in right_rows.iter_outer_sz().take(count).enumerate() {
            let product: f64 = right_entries[row].iter().map(|&(place, value)| value * carried[place]).sum();
            sum[(places.0 + i, places.1 + j)] += product;
        }
    }
}

/// The columns that hold anything, and the place of each among them.
fn used_columns(operator: &CsMat<f64>) -> (Vec<usize>, Vec<usize>) {
    let mut used = operator.indices().to_vec();
    used.sort_unstable();
    used.dedup();
    let mut place = vec![usize::MAX; operator.cols()];
    for (k, &column) in used.iter().enumerate() {
        place[column] = k;
    }
    (used, place)
}
