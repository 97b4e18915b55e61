//! Transmission error over the life of a pair: of the peak-to-peak values Δ at all evaluations of a run, the greatest and the mean over its revolutions N,
//!
//! ```text
//! mean = 1/N ∫ Δ dN,
//! ```
//!
//! by the trapezoidal rule over the wear steps. Each evaluation is under the load of its own phase, so that every load of a spectrum counts by its share of
//! the revolutions.

use serde::{Deserialize, Serialize};

/// Peak-to-peak transmission error so far.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct PeakToPeakOverLife {
    /// Revolutions of the last evaluation and its value, mm.
    last: Option<(f64, f64)>,
    /// ∫ Δ dN, mm.
    integral_mm: f64,
    greatest_mm: f64,
}

impl PeakToPeakOverLife {
    /// Notes the value of an evaluation after `revolutions`, none before those of the last one. Another one at the same moment, under the load of the next
    /// phase, begins where that ends.
    pub(crate) fn note(&mut self, revolutions: f64, peak_to_peak_mm: f64) {
        if let Some((before, last_mm)) = self.last {
            self.integral_mm += (revolutions - before) * last_mm.midpoint(peak_to_peak_mm);
        }
        self.last = Some((revolutions, peak_to_peak_mm));
        self.greatest_mm = self.greatest_mm.max(peak_to_peak_mm);
    }

    /// Mean so far, mm; before the first revolution the value there.
    pub fn mean_mm(&self) -> f64 {
        let Some((revolutions, value_mm)) = self.last else { return 0.0 };
        if revolutions > 0.0 { self.integral_mm / revolutions } else { value_mm }
    }

    /// Greatest so far, mm.
    pub fn greatest_mm(&self) -> f64 {
        self.greatest_mm
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two phases of straight lines: the mean is the sum of the trapezia over the revolutions, whatever is evaluated twice.
    #[test]
    fn ver_the_mean_is_that_of_the_trapezia() {
        let mut over_life = PeakToPeakOverLife::default();
        for (revolutions, mm) in [(0.0, 4.0), (10.0, 2.0), (10.0, 2.0), (10.0, 6.0), (30.0, 8.0)] {
            over_life.note(revolutions, mm);
        }
        assert_eq!((over_life.mean_mm(), over_life.greatest_mm()), ((30.0 + 140.0) / 30.0, 8.0));
        let mut new = PeakToPeakOverLife::default();
        new.note(0.0, 5.0);
        assert_eq!(new.mean_mm(), 5.0);
    }
}
