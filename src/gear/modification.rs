//! Deliberate deviations of the flank from the involute, as data.
//!
//! Each is an amount of material removed along the flank normal; together they are the field that every contact model
//! reads, to which wear adds. Lengths are roll lengths: differences of the radius of curvature ρ of the transverse
//! involute, which are lengths along the path of contact (ISO 21771-1, profile modifications):
//!
//! ```text
//! relief        C (u/L)ⁿ       u: roll length from where it begins, L: its whole length, n = 1 linear, 2 parabolic
//! crowning      C_α (2v)²      v: roll length from the middle of the active profile over its whole length
//! tip rounding  ρ − √(ρ² − d²) d: distance along the flank from where the rounding of radius ρ begins
//! ```

use super::tooth::Tooth;

/// How a relief grows from its start to its end.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ReliefShape {
    /// In proportion to the roll length from the start.
    #[default]
    Linear,
    /// With the square of the roll length from the start: no kink where it begins.
    Parabolic,
}

/// Tip or root relief.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relief {
    /// Removed at the tip circle (tip relief) or at the start of active profile (root relief), mm.
    pub amount_mm: f64,
    /// Roll length over which it runs out, mm.
    pub length_mm: f64,
    /// Its shape.
    pub shape: ReliefShape,
}

/// All modifications of one flank; the default is the plain involute.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Modification {
    /// Relief towards the tip.
    pub tip_relief: Option<Relief>,
    /// Relief towards the root.
    pub root_relief: Option<Relief>,
    /// Height of the profile crowning (parabola over the active profile, nothing removed at its middle), mm.
    pub profile_crowning_mm: f64,
    /// Radius of the rounding of the tip edge, mm.
    pub tip_rounding_mm: f64,
}

impl Relief {
    /// Removed at `from_start_mm` of roll length beyond where the relief begins; 0 before, the amount after its end.
    fn removed_mm(&self, from_start_mm: f64) -> f64 {
        let fraction = (from_start_mm / self.length_mm).clamp(0.0, 1.0);
        self.amount_mm
            * match self.shape {
                ReliefShape::Linear => fraction,
                ReliefShape::Parabolic => fraction * fraction,
            }
    }
}

impl Modification {
    /// Whether the flank is the plain involute.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Length along the flank that the tip rounding takes: the tangent length ρ tan(γ/2) of the turn γ = π/2 − α_a from
    /// flank to tip circle.
    pub fn tip_rounding_length_mm(&self, tooth: &Tooth) -> f64 {
        let turn = std::f64::consts::FRAC_PI_2 - tooth.involute.pressure_angle_rad(tooth.tip_rho_mm());
        self.tip_rounding_mm * (0.5 * turn).tan()
    }

    /// Material removed along the normal at radius of curvature `rho_mm` of `tooth`, whose active profile begins at
    /// `active_start_rho_mm`.
    pub fn removed_mm(&self, tooth: &Tooth, active_start_rho_mm: f64, rho_mm: f64) -> f64 {
        let tip_rho = tooth.tip_rho_mm();
        let tip = self.tip_relief.map_or(0.0, |r| r.removed_mm(rho_mm - (tip_rho - r.length_mm)));
        let root = self.root_relief.map_or(0.0, |r| r.removed_mm(active_start_rho_mm + r.length_mm - rho_mm));
        let across = (2.0 * (rho_mm - active_start_rho_mm) / (tip_rho - active_start_rho_mm) - 1.0).clamp(-1.0, 1.0);
        let crowning = self.profile_crowning_mm * across * across;

        let begins = tooth.involute.arc_mm(tip_rho) - self.tip_rounding_length_mm(tooth);
        let into = (tooth.involute.arc_mm(rho_mm) - begins).max(0.0);
        let radius = self.tip_rounding_mm;
        // ρ − √(ρ² − d²) without cancellation; beyond the tip the last value holds.
        let rounding = if into > 0.0 && radius > 0.0 {
            into * into / (radius + ((radius - into) * (radius + into)).max(0.0).sqrt())
        } else {
            0.0
        };
        tip + root + crowning + rounding
    }
}
