//! The transient heat equation perpendicular to the surface, while a point passes through the contact.
//!
//! ```text
//! ∂T/∂t = κ ∂²T/∂z²        −K ∂T/∂z = q(t) at z = 0,   T = 0 before
//! ```
//!
//! Time is counted in passages t₀ = 2a/U, depth in diffusion lengths √(κ t₀), the rise in units of q √(κ t₀)/K: only the course of the
//! flux remains, and one grid serves every contact. Depths are graded from the surface down, each node with the
//! half-way volume around it, as deep as heat comes. In time Alexander's method of two implicit stages damps what the
//! grid cannot resolve, with one factorisation for both:
//!
//! ```text
//! (1 + γ Δ A) Y = y + γ Δ b q         (1 + γ Δ A) y⁺ = y + (1 − γ)/γ (Y − y) + γ Δ b q        γ = 1 − 1/√2
//! ```
//!
//! Both are of second order. As the equation is linear, the rise of the surface follows from its response to the flux of one
//! cell alone ([`Passage`], Duhamel), which is found once by finite differences: a contact is a sum over its cells.
//!
//! Source: the thesis, equation 28; R. Alexander, *SIAM J. Numer. Anal.* 14 (1977) 1006.

/// Number of cells of a passage.
pub const CELLS: usize = 32;
/// Steps in time per cell.
const STEPS_PER_CELL: usize = 16;
/// First interval of the depths over the diffusion length of a step.
const FIRST_INTERVAL: f64 = 0.2;
/// Ratio of each further interval to the one before.
const GROWTH: f64 = 1.08;
/// Depth of the grid in diffusion lengths of the whole time: the rise there is below exp(−9) of that of the surface.
const DEPTH: f64 = 6.0;

/// A half-space heated at its surface, in the units of the module's documentation.
#[derive(Debug, Clone)]
pub(crate) struct Conduction {
    /// Rise at each depth, the surface first.
    rise: Vec<f64>,
    stage: Vec<f64>,
    /// Rise of the volume at the surface in γ Δ per flux.
    source: f64,
    /// Factors of Thomas's algorithm: lower diagonal, inverses of the pivots, upper diagonal.
    lower: Vec<f64>,
    inverse_pivot: Vec<f64>,
    upper: Vec<f64>,
}

/// Alexander's γ.
fn gamma() -> f64 {
    1.0 - 0.5_f64.sqrt()
}

impl Conduction {
    /// A half-space without heat, to be heated over a `duration` in `steps` (at least one).
    pub(crate) fn new(duration: f64, steps: usize) -> Self {
        Self::on_depths(duration, steps, FIRST_INTERVAL * (duration / steps as f64).sqrt(), GROWTH)
    }

    /// A half-space with depths whose first interval is `interval`, and each further one `growth` times as long.
    fn on_depths(duration: f64, steps: usize, mut interval: f64, growth: f64) -> Self {
        let step = duration / steps as f64;
        let mut depth = vec![0.0];
        while depth[depth.len() - 1] < DEPTH * duration.sqrt() {
            depth.push(depth[depth.len() - 1] + interval);
            interval *= growth;
        }
        let n = depth.len();
        let implicit = gamma() * step;
        let conductance: Vec<f64> = depth.windows(2).map(|ends| 1.0 / (ends[1] - ends[0])).collect();
        let volume: Vec<f64> = (0..n).map(|j| 0.5 * (depth[(j + 1).min(n - 1)] - depth[j.saturating_sub(1)])).collect();
        let (mut lower, mut inverse_pivot, mut upper) = (vec![0.0; n], vec![0.0; n], vec![0.0; n]);
        for j in 0..n {
            let above = if j > 0 { implicit * conductance[j - 1] / volume[j] } else { 0.0 };
            let below = if j + 1 < n { implicit * conductance[j] / volume[j] } else { 0.0 };
            upper[j] = -below;
            let diagonal = 1.0 + above + below;
            let pivot = if j > 0 {
                lower[j] = -above * inverse_pivot[j - 1];
                diagonal - lower[j] * upper[j - 1]
            } else {
                diagonal
            };
            inverse_pivot[j] = 1.0 / pivot;
        }
        Self { rise: vec![0.0; n], stage: vec![0.0; n], source: implicit / volume[0], lower, inverse_pivot, upper }
    }

    /// Takes a step under a constant flux. Returns the rise of the surface at its end.
    pub(crate) fn step(&mut self, flux: f64) -> f64 {
        self.stage.copy_from_slice(&self.rise);
        self.stage[0] += self.source * flux;
        solve(&self.lower, &self.inverse_pivot, &self.upper, &mut self.stage);
        let onward = (1.0 - gamma()) / gamma();
        for (rise, stage) in self.rise.iter_mut().zip(&self.stage) {
            *rise += onward * (stage - *rise);
        }
        self.rise[0] += self.source * flux;
        solve(&self.lower, &self.inverse_pivot, &self.upper, &mut self.rise);
        self.rise[0]
    }
}

/// Thomas's algorithm with its factors.
fn solve(lower: &[f64], inverse_pivot: &[f64], upper: &[f64], x: &mut [f64]) {
    for j in 1..x.len() {
        x[j] -= lower[j] * x[j - 1];
    }
    let last = x.len() - 1;
    x[last] *= inverse_pivot[last];
    for j in (0..last).rev() {
        x[j] = (x[j] - upper[j] * x[j + 1]) * inverse_pivot[j];
    }
}

/// Response of the surface to the flux of a passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// Rise at the end of each cell after the flux 1 in the first.
    response: [f64; CELLS],
    /// Greatest rise under Hertz's ellipse of mean flux 1.
    greatest_of_ellipse: f64,
}

impl Default for Passage {
    fn default() -> Self {
        let mut body = Conduction::new(1.0, CELLS * STEPS_PER_CELL);
        let mut response = [0.0; CELLS];
        for (cell, rise) in response.iter_mut().enumerate() {
            for _ in 0..STEPS_PER_CELL {
                *rise = body.step(if cell == 0 { 1.0 } else { 0.0 });
            }
        }
        let mut passage = Self { response, greatest_of_ellipse: 0.0 };
        let ellipse = std::array::from_fn(|k| CELLS as f64 * (ellipse_before(k + 1) - ellipse_before(k)));
        passage.greatest_of_ellipse = passage.rises(&ellipse).into_iter().fold(0.0, f64::max);
        passage
    }
}

/// Part of Hertz's ellipse over the first `cells`: ∫ 4/π √(1 − x²) dx/2 from −1 on, but for a constant.
fn ellipse_before(cells: usize) -> f64 {
    let x = 2.0 * cells as f64 / CELLS as f64 - 1.0;
    (x * (1.0 - x * x).max(0.0).sqrt() + x.asin()) / std::f64::consts::PI
}

impl Passage {
    /// Rise at the end of each cell under the mean flux of each, the first where the point enters.
    pub fn rises(&self, flux: &[f64; CELLS]) -> [f64; CELLS] {
        std::array::from_fn(|k| flux[..=k].iter().zip(self.response[..=k].iter().rev()).map(|(q, r)| q * r).sum())
    }

    /// Greatest rise under Hertz's ellipse of mean flux 1.
    pub(crate) fn greatest_of_ellipse(&self) -> f64 {
        self.greatest_of_ellipse
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Constant flux on a half-space: 2 q/K √(κ t/π) (Carslaw and Jaeger, section 2.9).
    fn under_constant_flux(time: f64) -> f64 {
        2.0 * (time / std::f64::consts::PI).sqrt()
    }

    #[test]
    fn ver_constant_flux_on_a_half_space() {
        let passage = Passage::default();
        for (cell, rise) in passage.rises(&[1.0; CELLS]).into_iter().enumerate() {
            let exact = under_constant_flux((cell + 1) as f64 / CELLS as f64);
            assert!((rise / exact - 1.0).abs() < 1e-3, "{cell}: {rise} {exact}");
        }
    }

    /// With twice the steps on depths twice as fine everywhere the error at a fixed time is a quarter, though the flux begins at once.
    #[test]
    fn ver_second_order_in_time_and_depth() {
        let errors = [0, 1, 2, 3].map(|halvings: i32| {
            let steps = 8 << halvings;
            let finer = 0.5_f64.powi(halvings);
            let mut body = Conduction::on_depths(1.0, steps, 0.1 * finer, 1.2_f64.powf(finer));
            let rise = (0..steps).map(|_| body.step(1.0)).last().unwrap_or_default();
            (rise / under_constant_flux(1.0) - 1.0).abs()
        });
        for two in errors.windows(2) {
            assert!((two[0] / two[1]).log2() > 1.8, "{errors:?}");
        }
    }
}
