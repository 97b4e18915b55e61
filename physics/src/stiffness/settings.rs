//! Settings of the tooth stiffness.

/// Model of the pair's stiffness along the path of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StiffnessSettings {
    /// Constant stiffness of a tooth pair, without contact flattening.
    Constant {
        /// Stiffness in N per mm of approach and mm of face width (1 N/(mm·µm) is 1000 of these).
        pair_n_per_mm2: f64,
    },
    /// Weber and Banaschek's tooth and body terms on the generated profile.
    WeberBanaschek,
    /// Single stiffness c' of ISO 6336-1.
    Iso6336,
    /// Curve of a calibration by finite elements.
    Fem,
    /// Curve after Simon, supplied by the user.
    Simon,
    /// Curve after Wang and Cheng, supplied by the user.
    WangCheng,
}

impl StiffnessSettings {
    /// Name in scenes and results.
    pub fn name(&self) -> &'static str {
        match self {
            Self::Constant { .. } => "constant",
            Self::WeberBanaschek => "weber-banaschek",
            Self::Iso6336 => "iso6336",
            Self::Fem => "fem",
            Self::Simon => "simon",
            Self::WangCheng => "wang-cheng",
        }
    }
}
