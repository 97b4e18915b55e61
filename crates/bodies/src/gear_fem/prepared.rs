//! Position prepared for repeated solution on flanks as they wear.
//!
//! The couplings and the compliance between all multipliers depend on the position of the gears and not on wear:
//! wear h along the normals of both flanks' nodes only opens the gaps,
//!
//! ```text
//! g⁰(h) = g⁰ − B₁ (n₁ h₁) − B₂ (n₂ h₂)
//! ```
//!
//! as a displacement of the nodes into their bodies would. A position is prepared once and solved many times; where wear has tilted
//! the flanks so far that the direction of the load matters, it is corrected for the tilt ([`super::tilted`]).

use faer::Mat;

use super::beside_window::BesideWindow;
use super::condensed_pair::CondensedPair;
use super::facing_teeth::{Direction, FacingTeeth, SearchWindow};
use super::sandwich::{ToothRows, mirror_below};
use crate::gear::Gear;
use gearwear_fem::active_set::{ActiveSetError, ActiveSetLog, Condensed, ContactEquilibrium, ReusableFactor};

/// Greatest gap with multipliers in the first window, in units of line load over E*; approaches are about ten units.
const FIRST_REACH: f64 = 25.0;
/// Ratio of the approach to the reach beyond which greater gaps may close.
const REACH_USED: f64 = 0.8;
/// Half-widths of the first window on either side of the expected contact.
const FIRST_WINDOW: f64 = 1.4;
/// Ratio of widths of successive windows.
const WIDER: f64 = 1.6;
/// Ratio of reaches across the gap of successive windows.
const FARTHER: f64 = 3.0;
/// Greatest number of windows.
const MOST_WINDOWS: usize = 8;

/// Position with its couplings and compliance.
pub struct PreparedPosition {
    /// Position ξ, mm.
    pub position_mm: f64,
    window: SearchWindow,
    pub(super) facings: Vec<FacingTeeth>,
    /// Nodes beside the window of each tooth pair.
    beside: Vec<BesideWindow>,
    pub(super) condensed: Condensed,
    /// Displacement of each row along the flank, from root to tip, per transmission error.
    pub(super) along_rotation: Vec<f64>,
    pub(super) sideways: Option<Sideways>,
    /// Tilt of the flanks at each row; empty without tilt.
    pub(super) tilt_rad: Vec<f64>,
    unworn_gap_mm: Vec<f64>,
    /// Contact of the unworn flanks in the first window; `None` where that has none.
    unworn: Option<UnwornContact>,
    /// Active set that the next solution starts from.
    pub(super) active: Option<Vec<bool>>,
    pub(super) kept: Option<ReusableFactor>,
    /// Number of the window, from 1.
    windows: usize,
    /// Position in the last window before it was reset, without contact.
    wider: Option<Box<PreparedPosition>>,
}

/// Contact of unworn flanks, from which that of worn ones is found.
struct UnwornContact {
    active: Vec<bool>,
    transmission_error_mm: f64,
}

/// Compliance along the flanks ([`super::tilted`]), and the matrices without tilt.
pub(super) struct Sideways {
    /// Matrix B⊥ C Bᵀ.
    pub compliance: Mat<f64>,
    /// Matrix B C Bᵀ on and below the diagonal, B⊥ C B⊥ᵀ above it, both symmetric.
    pub level_and_along: Mat<f64>,
    /// Diagonal of B⊥ C B⊥ᵀ.
    pub along_diagonal: Vec<f64>,
    pub level_rigid: Mat<f64>,
}

impl<'a> CondensedPair<'a> {
    /// Prepares the contact at `position_mm` under `line_load_n_per_mm`, with that of unworn flanks.
    pub fn prepare(&self, position_mm: f64, line_load_n_per_mm: f64) -> PreparedPosition {
        self.unworn(position_mm, self.first_window(self.most_beside(), line_load_n_per_mm))
    }

    /// Number of tooth pairs on either side of the reference pair that have fine teeth.
    pub(super) fn most_beside(&self) -> i32 {
        (self.gears.pinion.teeth() / 2) as i32
    }

    /// Position without any contact yet, with `beside` tooth pairs on either side of the reference pair.
    pub(super) fn untouched(&self, beside: i32, position_mm: f64, line_load_n_per_mm: f64) -> PreparedPosition {
        self.observe(position_mm, self.first_window(beside, line_load_n_per_mm))
    }

    /// Position with the contact of its unworn flanks.
    fn unworn(&self, position_mm: f64, window: SearchWindow) -> PreparedPosition {
        let mut prepared = self.observe(position_mm, window);
        if let Ok(found) = prepared.condensed.solve_with(None, &mut prepared.kept) {
            let unworn = UnwornContact { active: found.active, transmission_error_mm: found.rigid[0] };
            prepared.active = Some(unworn.active.clone());
            prepared.unworn = Some(unworn);
        }
        prepared
    }

    /// Window around the expected contact.
    fn first_window(&self, beside: i32, line_load_n_per_mm: f64) -> SearchWindow {
        SearchWindow {
            beside,
            line_load_n_per_mm,
            half_widths: FIRST_WINDOW,
            reach_mm: FIRST_REACH * line_load_n_per_mm / self.contact_modulus_mpa,
            overlaps: Vec::new(),
        }
    }

    fn observe(&self, position_mm: f64, window: SearchWindow) -> PreparedPosition {
        let placed = self.placed_teeth(position_mm, &window);
        let facings = self.facings(&placed, &window);
        let beside = placed.iter().map(|placed| self.beside_window(placed, window.reach_mm)).collect();
        let condensed = self.condensed(&facings, window.line_load_n_per_mm);
        let along_rotation =
            facings.iter().flat_map(|facing| self.by_rotation(facing, Direction::AlongFlank)).collect();
        PreparedPosition {
            position_mm,
            window,
            unworn_gap_mm: condensed.gap_mm.clone(),
            facings,
            beside,
            condensed,
            along_rotation,
            sideways: None,
            tilt_rad: Vec::new(),
            unworn: None,
            active: None,
            kept: None,
            windows: 1,
            wider: None,
        }
    }

    /// Solves a prepared position, in wider windows where contact comes close to the end of the first or the flanks overlap beside it.
    /// `opening` adds the opening by wear to the gaps of the unworn flanks, once for the multipliers of each window;
    /// `depth_mm` is the wear at the local nodes of a gear's flank.
    pub fn solve(
        &self,
        prepared: &mut PreparedPosition,
        opening: &mut dyn FnMut(&PreparedPosition, &mut [f64]),
        depth_mm: &dyn Fn(Gear, usize) -> f64,
    ) -> Result<ContactEquilibrium, ActiveSetError> {
        let mut log = ActiveSetLog::default();
        for attempt in 1..=MOST_WINDOWS {
            prepared.open_gaps(opening);
            let last = attempt == MOST_WINDOWS;
            let wider = match prepared.condensed.solve_with(prepared.active.as_deref(), &mut prepared.kept) {
                Ok(mut found) => {
                    log.append(&mut found.log);
                    // Overlaps beside the last window remain, and are reported.
                    let wider = match prepared.window_around(&found).filter(|_| !last) {
                        None => self.window_over_overlaps(prepared, &found, depth_mm).filter(|_| !last),
                        wider => wider,
                    };
                    prepared.active = Some(found.active.clone());
                    match wider {
                        Some(wider) => wider,
                        None => return Ok(ContactEquilibrium { log, ..found }),
                    }
                }
                Err(error) if last || !prepared.misses_contact(&error) => return Err(error),
                Err(_) => prepared.window.clone().longer().farther(),
            };
            self.widen(prepared, wider);
        }
        unreachable!("the last attempt returns")
    }

    /// Window that includes all overlaps of relieved or worn flanks beside that of `found`; `None` without overlaps.
    fn window_over_overlaps(
        &self,
        prepared: &mut PreparedPosition,
        found: &ContactEquilibrium,
        depth_mm: &dyn Fn(Gear, usize) -> f64,
    ) -> Option<SearchWindow> {
        let PreparedPosition { window, facings, beside, .. } = prepared;
        let mut wider: Option<SearchWindow> = None;
        for beside in beside {
            if let Some(overlap) = self.overlap(beside, facings, found, depth_mm) {
                wider.get_or_insert_with(|| window.clone()).reach_to(overlap);
            }
        }
        wider
    }

    /// Resets a prepared position to its state before any solution: with the contact of its unworn flanks, without tilt, with its first window.
    pub fn reset(&self, prepared: &mut PreparedPosition) {
        prepared.level();
        if prepared.windows > 1 {
            let SearchWindow { beside, line_load_n_per_mm, .. } = prepared.window;
            let first = self.unworn(prepared.position_mm, self.first_window(beside, line_load_n_per_mm));
            // One at most, however often this is done.
            prepared.wider = None;
            prepared.wider = Some(Box::new(std::mem::replace(prepared, first)));
        }
    }

    fn widen(&self, prepared: &mut PreparedPosition, window: SearchWindow) {
        let mut next = match prepared.wider.take() {
            Some(wider) if wider.window == window => *wider,
            other => PreparedPosition { wider: other, ..self.observe(prepared.position_mm, window) },
        };
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
            let rows = self.tooth_rows(facings, gear);
            for (a, own) in rows.iter().enumerate() {
                rows[..=a].iter().for_each(|other| own.add_carried_product(other, &mut compliance));
                ToothRows::held_products(&[own], &mut |_, [i, j], entry| compliance[(i, j)] += entry);
            }
        }
        mirror_below(&mut compliance);
        Condensed { compliance, gap_mm, rigid, rigid_load: vec![-line_load_n_per_mm] }
    }

    /// Rows B of each tooth pair on a gear.
    pub(super) fn tooth_rows<'b>(&'b self, facings: &'b [FacingTeeth], gear: Gear) -> Vec<ToothRows<'b>> {
        let of_pairs = facings.iter();
        of_pairs
            .map(|facing| {
                ToothRows::new(&self.gears[gear], facing.tooth[gear], facing.first_row, &facing.carried[gear])
            })
            .collect()
    }
}

impl SearchWindow {
    fn longer(self) -> Self {
        Self { half_widths: WIDER * self.half_widths, ..self }
    }

    fn farther(self) -> Self {
        Self { reach_mm: FARTHER * self.reach_mm, ..self }
    }
}

impl PreparedPosition {
    /// Resets tilt, active set and what was found beside the window.
    fn level(&mut self) {
        self.beside.iter_mut().for_each(BesideWindow::forget);
        self.active = self.unworn.as_ref().map(|unworn| unworn.active.clone());
        self.kept = None;
        if let Some(sideways) = &self.sideways {
            let level = &sideways.level_and_along;
            self.condensed.compliance.copy_from_triangular_lower(level);
            mirror_below(&mut self.condensed.compliance);
            self.condensed.rigid.copy_from(&sideways.level_rigid);
            self.tilt_rad.clear();
        }
    }

    /// Line load that `force` on the multipliers from `first_row` on carries, with its lever, N/mm.
    pub(super) fn carried_n_per_mm(&self, first_row: usize, force: &[f64]) -> f64 {
        force.iter().enumerate().map(|(k, f)| -f * self.condensed.rigid[(first_row + k, 0)]).sum()
    }

    /// Transmission error on unworn flanks by their contact in the first window, mm; 0 without one.
    pub fn unworn_transmission_error_mm(&self) -> f64 {
        self.unworn.as_ref().map_or(0.0, |unworn| unworn.transmission_error_mm)
    }

    /// Line load w, N/mm.
    pub fn line_load_n_per_mm(&self) -> f64 {
        self.window.line_load_n_per_mm
    }

    /// Number of the window, from 1.
    pub fn windows(&self) -> usize {
        self.windows
    }

    /// Greatest overlap of the flanks beside the window of the last solution, mm.
    pub fn overlap_beside_mm(&self) -> f64 {
        self.beside.iter().map(BesideWindow::deepest_mm).fold(0.0, f64::max)
    }

    /// Number of tooth pairs that may touch.
    pub fn tooth_pairs(&self) -> usize {
        self.facings.len()
    }

    /// Solves again on flanks that have hardly changed since `found` ([`Condensed::solve_again`]), in the same window, beside which overlaps are not looked for.
    /// `opening` adds the opening by wear to the gaps of the multipliers that are asked for. Returns whether `found` is the new solution.
    pub fn solve_again(
        &mut self,
        found: &mut ContactEquilibrium,
        opening: impl FnOnce(&PreparedPosition, &[bool], &mut [f64]),
    ) -> bool {
        let Some(mut kept) = self.kept.take() else { return false };
        let mut gap_mm = std::mem::take(&mut self.condensed.gap_mm);
        let asked = kept.asked(self.condensed.compliance.as_ref(), &found.active);
        if let Some(asked) = asked {
            gap_mm.copy_from_slice(&self.unworn_gap_mm);
            opening(self, asked, &mut gap_mm);
        }
        let is_asked = asked.is_some();
        self.condensed.gap_mm = gap_mm;
        let solved = is_asked && self.condensed.solve_again(found, &kept);
        self.kept = Some(kept);
        solved
    }

    /// Sets the gaps to those of the unworn flanks with `opening` added.
    fn open_gaps(&mut self, opening: &mut dyn FnMut(&PreparedPosition, &mut [f64])) {
        let mut gap_mm = std::mem::take(&mut self.condensed.gap_mm);
        gap_mm.copy_from_slice(&self.unworn_gap_mm);
        opening(self, &mut gap_mm);
        self.condensed.gap_mm = gap_mm;
    }

    /// Whether contact failed because no gap is small enough to close.
    fn misses_contact(&self, error: &ActiveSetError) -> bool {
        matches!(error, ActiveSetError::NoContact { .. }) || self.unworn_gap_mm.is_empty()
    }

    /// Window that does not cut off the contact of `found`; `None` where the present one does not.
    fn window_around(&self, found: &ContactEquilibrium) -> Option<SearchWindow> {
        let is_near = found.rigid[0] > REACH_USED * self.window.reach_mm;
        let is_cramped = self.facings.iter().any(|facing| facing.is_cramped(&found.force));
        let window = || self.window.clone();
        match (is_cramped, is_near) {
            (false, false) => None,
            (true, false) => Some(window().longer()),
            (false, true) => Some(window().farther()),
            (true, true) => Some(window().longer().farther()),
        }
    }
}

/// Active set of `before` on the rows of `after`.
fn carried_over(before: &[FacingTeeth], active: &[bool], after: &[FacingTeeth]) -> Vec<bool> {
    let rows = after.iter().flat_map(|facing| facing.coupling.nodes.iter().map(|&node| (facing.pair, node)));
    let was_active = rows.map(|(pair, node)| {
        before.iter().filter(|facing| facing.pair == pair).any(|facing| {
            let row = facing.coupling.nodes.iter().position(|&other| other == node);
            row.is_some_and(|row| active[facing.first_row + row])
        })
    });
    was_active.collect()
}

#[cfg(test)]
mod tests {
    use super::super::tilted::tests::{condensed_fzg_a, fzg_a};
    use super::*;

    /// Flanks with a flat bottom, which touch as far as that goes, are found in wider windows, after any number of resets with the same bits as on a new position;
    /// no more than one wider window is kept.
    #[test]
    fn resets_keep_one_wider_window() {
        let pair = fzg_a();
        let model = condensed_fzg_a(&pair);
        let new = || model.prepare(pair.path.pitch_point_mm, 300.0);
        let deepest_mm = new().unworn_gap_mm.iter().copied().fold(0.0, f64::max);
        let solve = |prepared: &mut PreparedPosition, bottom_mm: f64| {
            let mut flat = |_: &PreparedPosition, gap_mm: &mut [f64]| {
                gap_mm.iter_mut().for_each(|gap_mm| *gap_mm = gap_mm.max(bottom_mm));
            };
            let found = model.solve(prepared, &mut flat, &|_, _| bottom_mm).expect("the position has an equilibrium");
            (found.force, prepared.window.half_widths)
        };
        let mut prepared = new();
        let mut widths = Vec::new();
        for bottom in [0.9, 4.0, 0.9, 2.0, 4.0, 2.0, 0.9] {
            let bottom_mm = bottom * deepest_mm;
            let found = solve(&mut prepared, bottom_mm);
            assert_eq!(found, solve(&mut new(), bottom_mm), "{bottom}");
            widths.push(found.1);
            model.reset(&mut prepared);
            let kept = std::iter::successors(prepared.wider.as_deref(), |wider| wider.wider.as_deref()).count();
            assert_eq!((prepared.windows, kept), (1, 1), "{bottom}");
        }
        assert!(widths[1] > widths[0], "{widths:?}");
    }
}
