//! A position of the mesh: equilibrium of all its contacts, from one wear step to the next.
//!
//! ```text
//! g_m + s_m(w_m) + u_m = δ   for every contact          Σ w_m = F
//! s(w) = w y,   y = Q − ½ Φ ln w + P(w)                 s' = y − ½ Φ + w P'(w)
//! ```
//!
//! with the gap g_m of the flanks at the contact point, worn and modified, the closed form of [`super::closed_form`], and, where slices
//! are coupled, the deflection u of the teeth ([`CoupledTeeth`]; otherwise their compliance q is part of Q).
//!
//! A wear step changes loads by per cents. The next equilibrium is followed from the last ones: loads change by e, as in the step
//! before, and one Newton step corrects them,
//!
//! ```text
//! e = correction + change        z = e/(2w + e)        ln w ← ln w + 2 (z + z³/3 + z⁵/5)        w ← w + e
//! c = 1/s'(w)                    δ = (F − Σ w + Σ c h) / Σ c,   h = g + s(w) + u
//! correction = c (δ − h)         change ← change + correction
//! ```
//!
//! so that the logarithm costs a division. The sum of the loads w + correction is F, whatever the correction is. The residual of the
//! other equation is ¼ Φ correction²/w, and c times that in load: with c Φ < 0.6, less than 2e-10 of F in all once no
//! correction is above [`SETTLED`] of its load. Otherwise another one follows.
//!
//! Where a contact comes or goes, or changes its load by more than [`GREATEST_SHIFT`] allows, the equilibrium is sought
//! with logarithms ([`LoadedPosition::settle`]).

use super::lanes::{LANES, Lanes};
use crate::mesh_cycle::bent_tooth::{Bend, ContactTangent};
use crate::mesh_cycle::coupled_teeth::CoupledTeeth;

/// Correction over load at which a followed equilibrium is accepted.
pub(crate) const SETTLED: f64 = 3e-5;
/// Greatest z of the series, whose first omitted term is 2 z⁷/7.
pub(crate) const GREATEST_SHIFT: f64 = 0.03;
/// Most corrections of a followed equilibrium.
const FOLLOW_LIMIT: u64 = 5;
/// Most Newton steps of a sought equilibrium.
const SETTLE_LIMIT: u64 = 60;
/// correction²/w over F at which a sought equilibrium is accepted: the error of the loads is far below 1e-12 of F.
const SOUGHT: f64 = 1e-12;
/// Part of its load that a contact whose flanks overlap keeps in a Newton step that would take all of it.
const KEPT: f64 = 0.1;
/// Gap of unused lanes, which never touch.
pub(crate) const UNUSED_GAP_MM: f64 = 1e300;

/// Constants and state of contacts side by side.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Pack {
    /// Q, mm²/N.
    pub rigid: Lanes,
    /// A_k.
    pub series: [Lanes; 4],
    /// g, mm.
    pub gap_mm: Lanes,
    /// w without the last correction, N/mm; 0 without contact.
    pub load: Lanes,
    /// ln w without the last correction.
    pub log_load: Lanes,
    /// Last correction, N/mm.
    pub correction: Lanes,
    /// Change of the load in the last wear step, N/mm.
    pub change: Lanes,
}

/// Linearised contacts of a pack.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Tangent {
    /// h less the approach at the start, mm.
    pub approach_mm: Lanes,
    /// c, N/mm²; 0 without contact.
    pub n_per_mm2: Lanes,
    /// 1/(2w), mm/N.
    half_over_load: Lanes,
}

/// Constants of all contacts of a pair.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Common {
    /// Φ, mm²/N.
    pub log_compliance_mm2_per_n: f64,
    /// F: sum of all line loads, N/mm.
    pub line_load_n_per_mm: f64,
}

/// End of an attempt to find an equilibrium.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Attempt {
    /// Equilibrium after so many Newton steps.
    Settled(u64),
    /// No equilibrium after so many Newton steps.
    Lost(u64),
}

impl Pack {
    /// w, N/mm.
    #[inline(always)]
    pub(crate) fn loads(&self) -> Lanes {
        self.load + self.correction
    }

    /// y = s/w and s'. Sums are paired so that few operations wait for the logarithm, which comes last.
    #[inline(always)]
    fn compliance(&self, phi: f64) -> (Lanes, Lanes) {
        let ([a1, a2, a3, a4], w) = (self.series, self.load);
        let (square, second) = (w * w, a3 + w * a4);
        let series = w * (a1 + w * a2) + square * w * second;
        // w P'
        let slope = w * (a1 + w * a2 + w * a2) + square * w * (second + second + second + w * a4);
        let y = self.rigid + series - self.log_load * (0.5 * phi);
        (y, y + (slope - Lanes::splat(0.5 * phi)))
    }

    /// Takes the last loads within 0 to `line_load` as a start.
    fn bound_load(&mut self, line_load: f64) {
        self.load = self.loads().map(|load| if load.is_finite() { load.clamp(0.0, line_load) } else { 0.0 });
        (self.correction, self.change) = (Lanes::default(), Lanes::default());
    }

    /// Adds the last correction to the load.
    fn take_correction(&mut self) {
        self.load = self.loads();
        self.correction = Lanes::default();
        self.log_load = self.load.map(|load| if load > 0.0 { load.ln() } else { 0.0 });
    }

    /// Corrects the loads by a Newton step in which the approaches lack `lacks` and the loads change by `change`; `mean` is the mean load of the
    /// contacts. Returns whether the loads are settled.
    fn correct(&mut self, lacks: Lanes, change: Lanes, common: &Common, mean: f64) -> bool {
        let (phi, line_load) = (common.log_compliance_mm2_per_n, common.line_load_n_per_mm);
        let surface = self.load * self.compliance(phi).0;
        let mut settled = true;
        for k in 0..LANES {
            let (load, lacks, change) = (self.load.0[k], lacks.0[k], change.0[k]);
            self.correction.0[k] = if load > 0.0 && load + change > 0.0 {
                settled &= change * change <= SOUGHT * line_load * load;
                change
            } else if load > 0.0 {
                settled = false;
                let overlaps = lacks + surface.0[k] > 0.0;
                if overlaps { KEPT * load - load } else { -load }
            } else if lacks > 0.0 {
                settled = false;
                (lacks / (self.rigid.0[k] - 0.5 * phi * mean.ln())).min(line_load)
            } else {
                0.0
            };
        }
        settled
    }

    /// Approach and tangent stiffness at the present load.
    #[inline(always)]
    fn tangent(&self, phi: f64, from_mm: f64) -> (Lanes, Lanes) {
        let (y, slope) = self.compliance(phi);
        let approach = self.gap_mm - Lanes::splat(from_mm) + self.load * y;
        (approach, (Lanes::splat(1.0) / slope).where_positive(self.load, Lanes::default()))
    }
}

/// Sums over the contacts of a position.
#[derive(Default)]
struct ContactSums {
    load: Lanes,
    stiffness: Lanes,
    /// Σ c h.
    carried: Lanes,
}

impl ContactSums {
    #[inline(always)]
    fn add(&mut self, pack: &Pack, tangent: &Tangent) {
        self.load += pack.load;
        self.stiffness += tangent.n_per_mm2;
        self.carried += tangent.n_per_mm2 * tangent.approach_mm;
    }

    /// δ less the approach at the start.
    fn approach_mm(&self, line_load: f64) -> f64 {
        (line_load - self.load.sum() + self.carried.sum()) / self.stiffness.sum()
    }
}

/// A position of the mesh.
#[derive(Debug, Clone)]
pub(crate) struct LoadedPosition {
    /// Position of the reference tooth in the middle of the face width.
    pub position_mm: f64,
    /// δ.
    pub transmission_error_mm: f64,
    /// Number of contacts, which are in the first lanes of the packs.
    pub contacts: usize,
    /// Greatest load of the closed form of every contact, N/mm.
    pub greatest_load_n_per_mm: f64,
    /// Packs among those of the batch, the last with unused lanes where contacts do not fill it.
    pub packs: std::ops::Range<usize>,
}

impl LoadedPosition {
    /// Follows the equilibrium over a wear step.
    pub(crate) fn follow(
        &mut self,
        packs: &mut [Pack],
        tangents: &mut [Tangent],
        mut teeth: Option<&mut CoupledTeeth>,
        common: &Common,
    ) -> Attempt {
        let (phi, from_mm) = (common.log_compliance_mm2_per_n, self.transmission_error_mm);
        let mut continued = 1.0;
        for steps in 1..=FOLLOW_LIMIT {
            let (mut sums, mut shift) = (ContactSums::default(), Lanes::default());
            for (pack, tangent) in packs.iter_mut().zip(&mut *tangents) {
                let e = pack.correction + pack.change * continued;
                let half_over_load =
                    Lanes::splat(1.0) / (pack.load + pack.load + e).max(Lanes::splat(f64::MIN_POSITIVE));
                let z = e * half_over_load;
                let square = z * z;
                pack.log_load += z + z + z * square * (square * 0.4 + 2.0 / 3.0);
                pack.load += e;
                shift = shift.max(z.abs());
                let (approach_mm, n_per_mm2) = pack.tangent(phi, from_mm);
                *tangent = Tangent { approach_mm, n_per_mm2, half_over_load };
                sums.add(pack, tangent);
            }
            let approach_mm = match &mut teeth {
                None => sums.approach_mm(common.line_load_n_per_mm),
                Some(teeth) => bend(teeth, packs, tangents, common.line_load_n_per_mm),
            };
            let shift = shift.greatest();
            let (mut correction, mut strayed, mut greatest) = (Lanes::default(), Lanes::splat(-1.0), Lanes::default());
            for (pack, tangent) in packs.iter_mut().zip(&*tangents) {
                let lacks = Lanes::splat(approach_mm) - tangent.approach_mm;
                let own = tangent.n_per_mm2 * lacks;
                pack.correction = own;
                pack.change += own;
                let loads = pack.loads();
                correction = correction.max(own.abs() * tangent.half_over_load);
                greatest = greatest.max(loads);
                // A load must stay positive, and flanks without contact must not overlap.
                strayed = strayed.max((Lanes::default() - loads).where_positive(pack.load, lacks));
            }
            let sound = approach_mm.is_finite() && shift <= GREATEST_SHIFT;
            if !(sound && strayed.greatest() <= 0.0 && greatest.greatest() <= self.greatest_load_n_per_mm) {
                return Attempt::Lost(steps);
            }
            if correction.greatest() <= 0.5 * SETTLED {
                self.transmission_error_mm = from_mm + approach_mm;
                return Attempt::Settled(steps);
            }
            continued = 0.0;
        }
        Attempt::Lost(FOLLOW_LIMIT)
    }

    /// Seeks the equilibrium from any loads: contacts come where flanks would overlap and go where a load would be negative.
    pub(crate) fn settle(
        &mut self,
        packs: &mut [Pack],
        tangents: &mut [Tangent],
        mut teeth: Option<&mut CoupledTeeth>,
        common: &Common,
    ) -> Attempt {
        let (phi, line_load) = (common.log_compliance_mm2_per_n, common.line_load_n_per_mm);
        let mean = line_load / self.contacts as f64;
        let from_mm = if self.transmission_error_mm.is_finite() { self.transmission_error_mm } else { 0.0 };
        packs.iter_mut().for_each(|pack| pack.bound_load(line_load));
        for steps in 1..=SETTLE_LIMIT {
            let mut sums = ContactSums::default();
            for (pack, tangent) in packs.iter_mut().zip(&mut *tangents) {
                pack.take_correction();
                let (approach_mm, n_per_mm2) = pack.tangent(phi, from_mm);
                *tangent = Tangent { approach_mm, n_per_mm2, half_over_load: Lanes::default() };
                sums.add(pack, tangent);
            }
            if sums.stiffness.sum() <= 0.0 {
                // No contact carries load: begin again with all of them.
                for pack in &mut *packs {
                    pack.correction = pack.gap_mm.map(|gap| if gap < UNUSED_GAP_MM { mean } else { 0.0 });
                }
                continue;
            }
            let approach_mm = match &mut teeth {
                None => sums.approach_mm(line_load),
                Some(teeth) => bend(teeth, packs, tangents, line_load),
            };
            let mut settled = approach_mm.is_finite();
            for (pack, tangent) in packs.iter_mut().zip(&*tangents) {
                let lacks = Lanes::splat(approach_mm) - tangent.approach_mm;
                settled &= pack.correct(lacks, tangent.n_per_mm2 * lacks, common, mean);
            }
            if settled {
                self.transmission_error_mm = from_mm + approach_mm;
                let greatest = packs.iter().fold(Lanes::default(), |greatest, pack| greatest.max(pack.loads()));
                let holds = greatest.greatest() <= self.greatest_load_n_per_mm;
                return if holds { Attempt::Settled(steps) } else { Attempt::Lost(steps) };
            }
        }
        Attempt::Lost(SETTLE_LIMIT)
    }
}

/// Bends the coupled teeth of a position for the Newton step of `tangents`, and adds their deflection to its approaches. Returns δ; NaN where
/// no contact carries load.
fn bend(teeth: &mut CoupledTeeth, packs: &[Pack], tangents: &mut [Tangent], line_load: f64) -> f64 {
    let bend = teeth.bend(line_load, |at| {
        let (pack, lane) = (at / LANES, at % LANES);
        ContactTangent {
            line_load_n_per_mm: packs[pack].load.0[lane],
            n_per_mm2: tangents[pack].n_per_mm2.0[lane],
            approach_mm: tangents[pack].approach_mm.0[lane],
        }
    });
    let Some(Bend { delta_mm: approach_mm, .. }) = bend else { return f64::NAN };
    teeth.each_deflection_mm(|at, _, deflection_mm| {
        tangents[at / LANES].approach_mm.0[at % LANES] += deflection_mm;
    });
    approach_mm
}
