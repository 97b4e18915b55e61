//! What is asked of the wear law.

/// The transition from mild to severe wear (thesis eq 26).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SevereTransition {
    /// Local pressure above which wear is severe, MPa.
    pub above_mpa: f64,
    /// Factor on the wear coefficient there.
    pub factor: f64,
}

/// The wear law with its constants.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WearSettings {
    /// Wear coefficient k of the generalised Archard law, mm²/N (1e-17 m²/N is 1e-11 mm²/N).
    pub coefficient_mm2_per_n: f64,
    /// Mild-to-severe transition, where asked for.
    pub severe: Option<SevereTransition>,
}
