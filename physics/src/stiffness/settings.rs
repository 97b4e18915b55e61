//! What is asked of the tooth stiffness.

/// The model of the pair's stiffness along the path of contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StiffnessSettings {
    /// One value for the combined spring of a tooth pair, without contact flattening.
    Constant {
        /// N per mm of approach and mm of face width (1 N/(mm·µm) is 1000 of these).
        pair_n_per_mm2: f64,
    },
    /// Weber and Banaschek's tooth and body terms on the generated profile.
    WeberBanaschek,
    /// The single stiffness c' of ISO 6336-1.
    Iso6336,
    /// From finite elements: a calibration's curve.
    Fem,
    /// A curve that the user supplies, after Simon.
    Simon,
    /// A curve that the user supplies, after Wang and Cheng.
    WangCheng,
}

impl StiffnessSettings {
    /// Its name in scenes and results.
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
