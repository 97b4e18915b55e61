//! Contact of two elastic half-planes on evenly spaced cells of uniform pressure.
//!
//! Pressed together by the indentation δ, cells with the gaps g_i carry the pressures p_i for which
//!
//! ```text
//! p_i ≥ 0        g_i + Σ_j C_|i−j| p_j − δ ≥ 0        the product of both 0
//! ```
//!
//! C: [`cell_compliance_mm_per_mpa`](gearwear_bodies::reference::half_plane::cell_compliance_mm_per_mpa). As long as the same cells
//! touch, the pressures are linear in the indentation,
//!
//! ```text
//! p = δ C⁻¹1 − C⁻¹g          on the cells in contact
//! ```
//!
//! between the indentation at which the first of them leaves the contact and the one at which the next touches. Within
//! these, load and stiffness cost nothing; beyond them the set is found anew, starting from the present one, by exchanges of all cells that pull or
//! overlap, or by [`Condensed`] where these do not end. C does not change with wear, so its inverse is kept while the flanks wear until another set of
//! cells touches. C of cells beside each other is a Toeplitz matrix ([`ToeplitzInverse`]).

use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, MatMut, Side};

use super::Response;
use super::toeplitz::{self, ToeplitzInverse};
use gearwear_fem::active_set::{ActiveSetError, Condensed};

/// Exchanges of cells until the guarded method takes over; three or four are usual.
const MOST_EXCHANGES: usize = 12;
/// Round-off over the greatest pressure or gap.
const ROUND_OFF: f64 = 1e-12;

/// A row of cells that may touch.
pub(crate) struct ElasticCells {
    width_mm: f64,
    /// C by distance in cells.
    compliance: Vec<f64>,
    gap_mm: Vec<f64>,
    touching: Option<Touching>,
    indentation_mm: f64,
}

/// Cells in contact, with their pressures as linear functions of the indentation.
struct Touching {
    set: TouchingSet,
    /// One after the other, for one way through memory: C⁻¹1, MPa/mm, and C⁻¹g, MPa, of each cell in contact; 1 − C C⁻¹1, what remains of the
    /// indentation, and g − C C⁻¹g, mm, of each cell beside.
    numbers: Vec<f64>,
    /// Sums of C⁻¹1 and C⁻¹g.
    sums: [f64; 2],
    /// Indentations between which exactly these cells touch, mm.
    holds_mm: [f64; 2],
}

/// The cells in contact, with C⁻¹ on them.
enum TouchingSet {
    /// Cells beside each other.
    Adjacent {
        /// The first of them.
        first: usize,
        inverse: ToeplitzInverse,
    },
    /// Cells in several groups.
    Scattered {
        /// Cells in rising order.
        members: Vec<usize>,
        factor: Llt<f64>,
    },
}

impl ElasticCells {
    /// Cells of `width_mm`, as many as `compliance` has entries: the effect of one cell on another by their distance.
    pub(crate) fn new(width_mm: f64, compliance: Vec<f64>) -> Self {
        Self { width_mm, gap_mm: vec![0.0; compliance.len()], compliance, touching: None, indentation_mm: 0.0 }
    }

    /// Width of a cell, mm.
    pub(crate) fn width_mm(&self) -> f64 {
        self.width_mm
    }

    /// Forgets which cells touched.
    pub(crate) fn reset(&mut self) {
        self.touching = None;
        self.indentation_mm = 0.0;
    }

    /// Exchanges the gaps, one for each cell.
    pub(crate) fn set_gap(&mut self, gap_mm: &[f64]) {
        self.gap_mm.copy_from_slice(gap_mm);
        if let Some(touching) = &mut self.touching {
            touching.relieve(&self.gap_mm, &self.compliance);
        }
    }

    /// Load and stiffness when pressed together by `indentation_mm` beyond a gap of zero; NaN where the gaps are NaN.
    pub(crate) fn load_at(&mut self, indentation_mm: f64) -> Response {
        self.indentation_mm = indentation_mm;
        if indentation_mm <= 0.0 {
            return Response::default();
        }
        let [least, most] = self.touching.as_ref().map_or([f64::NAN; 2], |touching| touching.holds_mm);
        if !(least..=most).contains(&indentation_mm) {
            let Ok(touching) = self.find() else {
                return Response { line_load_n_per_mm: f64::NAN, stiffness_n_per_mm2: f64::NAN };
            };
            self.touching = Some(touching);
        }
        let [per_indentation, relieved] = self.touching.as_ref().map_or([0.0; 2], |touching| touching.sums);
        Response {
            line_load_n_per_mm: self.width_mm * (indentation_mm * per_indentation - relieved),
            stiffness_n_per_mm2: self.width_mm * per_indentation,
        }
    }

    /// The last indentation.
    pub(crate) fn indentation_mm(&self) -> f64 {
        self.indentation_mm
    }

    /// Displacement of the first and the last cell by the pressures at the last indentation, mm.
    pub(crate) fn sunk_at_ends_mm(&self) -> [f64; 2] {
        let Some(touching) = self.touching.as_ref().filter(|_| self.indentation_mm > 0.0) else { return [0.0; 2] };
        [0, self.gap_mm.len() - 1].map(|end| {
            let pressures = touching.pressures_mpa(self.indentation_mm);
            pressures.map(|(member, pressure)| self.compliance[end.abs_diff(member)] * pressure).sum()
        })
    }

    /// The pressures at the last indentation.
    pub(crate) fn pressure_mpa(&self, pressure_mpa: &mut Vec<f64>) {
        pressure_mpa.clear();
        pressure_mpa.resize(self.gap_mm.len(), 0.0);
        let Some(touching) = self.touching.as_ref().filter(|_| self.indentation_mm > 0.0) else { return };
        let pressures = touching.pressures_mpa(self.indentation_mm);
        pressures.for_each(|(member, pressure)| pressure_mpa[member] = pressure.max(0.0));
    }

    /// Cells that touch at the present indentation.
    fn find(&self) -> Result<Touching, ActiveSetError> {
        let mut active = match &self.touching {
            Some(touching) => touching.active(self.gap_mm.len()),
            None => self.gap_mm.iter().map(|gap| *gap <= self.indentation_mm).collect(),
        };
        for _ in 0..MOST_EXCHANGES {
            if !active.contains(&true) {
                break;
            }
            let touching = Touching::new(&active, &self.gap_mm, &self.compliance)?;
            if !touching.exchange(&mut active, self.indentation_mm) {
                return Ok(touching);
            }
        }
        self.find_guarded()
    }

    /// Cells that touch at the present indentation, by the method that cannot cycle.
    fn find_guarded(&self) -> Result<Touching, ActiveSetError> {
        let count = self.gap_mm.len();
        let problem = Condensed {
            compliance: Mat::from_fn(count, count, |i, j| self.compliance[i.abs_diff(j)]),
            gap_mm: self.gap_mm.iter().map(|gap| gap - self.indentation_mm).collect(),
            rigid: Mat::zeros(count, 0),
            rigid_load: Vec::new(),
        };
        let start = self.touching.as_ref().map(|touching| touching.active(count));
        let active = problem.solve(start.as_deref())?.active;
        Touching::new(&active, &self.gap_mm, &self.compliance)
    }
}

impl Touching {
    fn new(active: &[bool], gap_mm: &[f64], compliance: &[f64]) -> Result<Self, ActiveSetError> {
        let set = TouchingSet::new(active, compliance)?;
        let (count, beside) = (set.count(), active.len() - set.count());
        let mut numbers = vec![0.0; 2 * active.len()];
        let (of_members, of_beside) = numbers.split_at_mut(2 * count);
        let (per_indentation, closing) = (&mut of_members[..count], &mut of_beside[..beside]);
        set.times(&vec![1.0; count], per_indentation);
        set.sunk_beside_mm(per_indentation, compliance, closing);
        closing.iter_mut().for_each(|sunk| *sunk = 1.0 - *sunk);
        let mut touching = Self { set, numbers, sums: [0.0; 2], holds_mm: [0.0; 2] };
        touching.relieve(gap_mm, compliance);
        Ok(touching)
    }

    /// C⁻¹1, C⁻¹g, 1 − C C⁻¹1 and g − C C⁻¹g.
    fn numbers(&self) -> [&[f64]; 4] {
        let count = self.set.count();
        let (of_members, of_beside) = self.numbers.split_at(2 * count);
        let (per_indentation, relieved) = of_members.split_at(count);
        let (closing, beside_mm) = of_beside.split_at(of_beside.len() / 2);
        [per_indentation, relieved, closing, beside_mm]
    }

    /// Whether each of `cells` cells is in contact.
    fn active(&self, cells: usize) -> Vec<bool> {
        let mut active = vec![false; cells];
        (0..self.set.count()).for_each(|k| active[self.set.member(k)] = true);
        active
    }

    /// Cells in contact with their pressures at an indentation, MPa.
    fn pressures_mpa(&self, indentation_mm: f64) -> impl Iterator<Item = (usize, f64)> {
        let [per_indentation, relieved, ..] = self.numbers();
        let pressures = per_indentation.iter().zip(relieved);
        pressures.enumerate().map(move |(k, (per, relieved))| (self.set.member(k), indentation_mm * per - relieved))
    }

    /// Exchanges the gaps.
    fn relieve(&mut self, gap_mm: &[f64], compliance: &[f64]) {
        let count = self.set.count();
        let (of_members, of_beside) = self.numbers.split_at_mut(2 * count);
        let (per_indentation, relieved) = of_members.split_at_mut(count);
        let (closing, beside_mm) = of_beside.split_at_mut(gap_mm.len() - count);
        self.set.relieve(gap_mm, compliance, relieved, beside_mm);
        self.sums = [toeplitz::sum(per_indentation), toeplitz::sum(relieved)];
        // A cell leaves the contact where δ C⁻¹1 = C⁻¹g.
        let (mut least, mut most) = (0.0_f64, f64::INFINITY);
        for (per_indentation, relieved) in per_indentation.iter().zip(relieved) {
            let depth = *relieved / per_indentation;
            if *per_indentation > 0.0 {
                least = least.max(depth);
            } else {
                most = most.min(depth);
            }
        }
        // Another one touches where g + C p = δ.
        for (closing, gap_mm) in closing.iter().zip(beside_mm) {
            if *closing > 0.0 {
                most = most.min(*gap_mm / closing);
            } else if *gap_mm < 0.0 {
                least = f64::INFINITY;
            }
        }
        self.holds_mm = [least, most];
    }

    /// Exchanges cells in contact, all that are `active`, that pull at an indentation, and others that overlap. Returns whether there are any.
    fn exchange(&self, active: &mut [bool], indentation_mm: f64) -> bool {
        let [_, _, closing, beside_mm] = self.numbers();
        let pressures = || self.pressures_mpa(indentation_mm).map(|(_, pressure)| pressure);
        let gaps_mm = || closing.iter().zip(beside_mm).map(|(closing, gap_mm)| gap_mm - indentation_mm * closing);
        let greatest = |most: f64, value: f64| most.max(value.abs());
        let least_mpa = -ROUND_OFF * pressures().fold(0.0, greatest);
        let least_mm = -ROUND_OFF * gaps_mm().fold(0.0, greatest);
        let (mut pressures, mut gaps_mm, mut any) = (pressures(), gaps_mm(), false);
        for active in active {
            let wrong = match active {
                true => pressures.next().is_some_and(|pressure| pressure < least_mpa),
                false => gaps_mm.next().is_some_and(|gap| gap < least_mm),
            };
            *active ^= wrong;
            any |= wrong;
        }
        any
    }
}

impl TouchingSet {
    fn new(active: &[bool], compliance: &[f64]) -> Result<Self, ActiveSetError> {
        let first = active.iter().position(|active| *active).unwrap_or_default();
        let end = active.iter().rposition(|active| *active).map_or(first, |last| last + 1);
        let error = ActiveSetError::NotPositiveDefinite { index: first };
        if active[first..end].iter().all(|active| *active) {
            let inverse = ToeplitzInverse::new(compliance, end - first).ok_or(error)?;
            return Ok(Self::Adjacent { first, inverse });
        }
        let members: Vec<usize> = (first..end).filter(|&i| active[i]).collect();
        let count = members.len();
        let own = Mat::from_fn(count, count, |i, j| compliance[members[i].abs_diff(members[j])]);
        let factor = Llt::new(own.as_ref(), Side::Lower).map_err(|_| error)?;
        Ok(Self::Scattered { members, factor })
    }

    /// Number of cells in contact.
    fn count(&self) -> usize {
        match self {
            Self::Adjacent { inverse, .. } => inverse.count(),
            Self::Scattered { members, .. } => members.len(),
        }
    }

    /// Cell number `k` of those in contact.
    fn member(&self, k: usize) -> usize {
        match self {
            Self::Adjacent { first, .. } => first + k,
            Self::Scattered { members, .. } => members[k],
        }
    }

    /// Fills in C⁻¹g of the cells in contact and g − C C⁻¹g of those beside.
    fn relieve(&self, gap_mm: &[f64], compliance: &[f64], relieved: &mut [f64], beside_mm: &mut [f64]) {
        match self {
            Self::Adjacent { first, .. } => {
                let end = first + self.count();
                self.times(&gap_mm[*first..end], relieved);
                self.sunk_beside_mm(relieved, compliance, beside_mm);
                let beside = gap_mm[..*first].iter().chain(&gap_mm[end..]);
                beside_mm.iter_mut().zip(beside).for_each(|(sunk, gap)| *sunk = gap - *sunk);
            }
            Self::Scattered { members, .. } => {
                let own: Vec<f64> = members.iter().map(|&member| gap_mm[member]).collect();
                self.times(&own, relieved);
                self.sunk_beside_mm(relieved, compliance, beside_mm);
                let beside = (0..gap_mm.len()).filter(|cell| members.binary_search(cell).is_err());
                beside_mm.iter_mut().zip(beside).for_each(|(sunk, cell)| *sunk = gap_mm[cell] - *sunk);
            }
        }
    }

    /// Fills in the displacements of the cells beside those in contact by `pressures` on these, mm.
    fn sunk_beside_mm(&self, pressures: &[f64], compliance: &[f64], sunk_mm: &mut [f64]) {
        match self {
            Self::Adjacent { first, .. } => toeplitz::beside(compliance, pressures, *first, sunk_mm),
            Self::Scattered { members, .. } => {
                let cells = pressures.len() + sunk_mm.len();
                let beside = (0..cells).filter(|cell| members.binary_search(cell).is_err());
                for (sunk, cell) in sunk_mm.iter_mut().zip(beside) {
                    let by_cells = members.iter().zip(pressures);
                    *sunk = by_cells.map(|(member, pressure)| compliance[cell.abs_diff(*member)] * pressure).sum();
                }
            }
        }
    }

    /// Fills `product` with C⁻¹ times `side`.
    fn times(&self, side: &[f64], product: &mut [f64]) {
        match self {
            Self::Adjacent { inverse, .. } => inverse.times(side, product),
            Self::Scattered { factor, .. } => {
                product.copy_from_slice(side);
                factor.solve_in_place(MatMut::from_column_major_slice_mut(product, side.len(), 1));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::contact::pressure_field::PressureField;
    use gearwear_bodies::reference::{
        flattening::{Flattening, HalfPlane},
        half_plane::cell_compliance_mm_per_mpa,
        hertz_line::{HertzLine, LineContact},
    };
    use gearwear_fem::elastic::Elastic;

    /// FZG type C at the pitch point, 302 N·m, the bodies so deep that the half-planes' own curvature is all there is.
    fn hertz(indentation_mm: f64) -> (Flattening, f64, LineContact) {
        let elastic = Elastic { young_modulus_mpa: 206e3, poisson_ratio: 0.3 };
        let body = HalfPlane { elastic, depth_mm: indentation_mm };
        let contact = HertzLine::new([13.9701, 20.9551], 206e3 / 0.91 / 2.0).unwrap();
        (Flattening { contact, bodies: [body; 2] }, 637.66, contact.loaded(637.66))
    }

    /// Relative errors of load, peak pressure and half-width at Hertz's own approach, the worst of several places of the
    /// contact between the cells.
    fn errors(indentation_mm: f64, cells_in_half_width: f64) -> [f64; 3] {
        let (flattening, load, strip) = hertz(indentation_mm);
        let width = strip.half_width_mm / cells_in_half_width;
        let half_count = (1.4 * cells_in_half_width).ceil() as i32;
        let compliance = cell_compliance_mm_per_mpa(&flattening.bodies, width, 2 * half_count as usize);
        let mut cells = ElasticCells::new(width, compliance);
        let radius = flattening.contact.relative_radius_mm();
        let mut worst = [0.0_f64; 3];
        for shift in [0.0, 0.1, 0.25, 0.4, 0.5] {
            let lower = (shift - f64::from(half_count)) * width;
            let centres = (0..2 * half_count).map(|k| lower + (f64::from(k) + 0.5) * width);
            let gap: Vec<f64> = centres.map(|x| x * x / (2.0 * radius)).collect();
            cells.set_gap(&gap);
            let response = cells.load_at(flattening.approach_mm(load));
            let mut field = PressureField::new(lower, width, false);
            field.fill(|pressure| cells.pressure_mpa(pressure));
            let found = field.footprint();
            let ratios = [
                response.line_load_n_per_mm / load,
                found.peak_pressure_mpa / strip.peak_pressure_mpa,
                found.half_width_mm / strip.half_width_mm,
            ];
            worst.iter_mut().zip(ratios).for_each(|(worst, ratio)| *worst = worst.max((ratio - 1.0).abs()));
        }
        worst
    }

    /// Hertz's contact in closed form, of second order in the cells, and within 0.5 % from twelve cells in the half-width on.
    #[test]
    fn ver_hertzs_contact_is_met_with_second_order() {
        // t = 400 mm: at finite depth the surfaces flatten less than half-planes do by parts of (a/t)².
        let by_cells = [8.0, 16.0, 32.0].map(|cells| errors(400.0, cells));
        for (quantity, name) in ["load", "peak pressure", "half-width"].iter().enumerate() {
            let [coarse, medium, fine] = by_cells.map(|errors| errors[quantity]);
            println!("{name}: {coarse:.2e} {medium:.2e} {fine:.2e}");
            assert!(medium < 5e-3 && fine < medium && medium < coarse, "{name}");
            assert!((coarse / fine).log2() / 2.0 > 1.2, "{name}: {coarse:.2e} {medium:.2e} {fine:.2e}");
        }
        assert!(errors(400.0, 12.0).iter().all(|error| *error < 5e-3));
        // A tooth's depth, 3.9 mm.
        assert!(errors(3.9, 16.0).iter().all(|error| *error < 5e-3));
    }

    /// The stiffness is the derivative of the load, and load and stiffness are those of a problem solved from nothing.
    #[test]
    fn ver_the_response_does_not_depend_on_the_way_there() {
        let (flattening, load, strip) = hertz(3.9);
        let width = strip.half_width_mm / 12.0;
        let compliance = cell_compliance_mm_per_mpa(&flattening.bodies, width, 40);
        let depth = flattening.approach_mm(load);
        // A parabola, worn hollow in its middle, with a scratch.
        let worn: Vec<f64> = (0..40)
            .map(|k| {
                let x = (f64::from(k) - 17.3) * width;
                let hollow = 2e-3 * (1.0 - (x / 0.15).powi(2)).max(0.0);
                x * x / 16.8 + hollow + if k == 9 { 5e-3 } else { 0.0 }
            })
            .collect();
        let touch = worn.iter().copied().fold(f64::INFINITY, f64::min);
        let gap: Vec<f64> = worn.iter().map(|gap| gap - touch).collect();
        let mut travelled = ElasticCells::new(width, compliance.clone());
        travelled.set_gap(&vec![0.0; 40]);
        travelled.load_at(depth);
        travelled.set_gap(&gap);
        for part in [1.0, 0.2, 1.7, 1.0, 1e-3, 0.0, 0.6] {
            let mut fresh = ElasticCells::new(width, compliance.clone());
            fresh.set_gap(&gap);
            let (there, here) = (travelled.load_at(part * depth), fresh.load_at(part * depth));
            assert!((there.line_load_n_per_mm - here.line_load_n_per_mm).abs() <= 1e-11 * load, "{part}");
            assert!((there.stiffness_n_per_mm2 - here.stiffness_n_per_mm2).abs() <= 1e-11 * load / depth, "{part}");
            let step = 1e-7 * depth;
            let rise = fresh.load_at(part * depth + step).line_load_n_per_mm - here.line_load_n_per_mm;
            if part > 0.0 {
                assert!((rise / step / here.stiffness_n_per_mm2 - 1.0).abs() < 1e-5, "{part}");
            }
        }
    }
}
