//! The generalised Archard law.
//!
//! ```text
//! dh = k p ds
//! ```
//!
//! Source: J. F. Archard (1953); the thesis, equations 9–12.

use super::{LocalContact, WearLaw};

/// dh = k p ds at every point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Archard {
    /// k, mm²/N.
    pub coefficient_mm2_per_n: f64,
}

impl WearLaw for Archard {
    const READS_CONDITIONS: bool = false;

    fn coefficient_mm2_per_n(&self, _at: &LocalContact) -> f64 {
        self.coefficient_mm2_per_n
    }
}

#[cfg(test)]
mod tests {
    use crate::wear::{
        SlidingRow,
        settings::{SevereTransition, WearSettings},
    };

    /// Thesis eq 26 with k = 1e-17 m²/N, factor 100 above 2000 MPa, 0.7 mm of sliding.
    #[test]
    fn ver_mild_and_severe_rates() {
        let severe = Some(SevereTransition { above_mpa: 2000.0, factor: 100.0, band_mpa: 0.0 });
        let law = crate::wear::of(&WearSettings { severe, ..WearSettings::archard(1e-11) });
        let mut depth = [0.0; 3];
        let row = SlidingRow {
            pressure_mpa: &[1000.0, 2000.0, 2001.0],
            sliding_mm: &[0.7; 3],
            conditions: None,
            lambda: None,
            is_continuous: false,
        };
        law.add_depth(&row, &mut depth);
        let expected = [1e-11 * 1000.0 * 0.7, 1e-11 * 2000.0 * 0.7, 1e-9 * 2001.0 * 0.7];
        for (d, e) in depth.iter().zip(expected) {
            assert!((d / e - 1.0).abs() < 1e-14);
        }
    }
}
