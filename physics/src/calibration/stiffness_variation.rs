//! Variation of a stiffness over the path of contact: mean, ratio of greatest to least, and place of the greatest.

use serde::{Deserialize, Serialize};

use super::tooth_stiffness::PairDeflection;
use gearwear_bodies::gear::GearPair;

/// Variation of one stiffness.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StiffnessVariation {
    /// Stiffness.
    pub of: VariationOf,
    /// Mean over the positions, N/(mm·µm).
    pub mean_n_per_mm_um: f64,
    /// Greatest over least.
    pub max_over_min: f64,
    /// Place of the greatest: 0 at A, 1 at E.
    pub greatest_at: f64,
}

/// Stiffness whose variation is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum VariationOf {
    /// The pair, flattening included.
    PairWhole,
    /// The pair's teeth and bodies alone.
    PairBending,
    /// The pinion, its flattening included.
    PinionWhole,
    /// The pinion's tooth and body alone.
    PinionBending,
}

impl VariationOf {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::PairWhole, Self::PairBending, Self::PinionWhole, Self::PinionBending];

    /// In words.
    pub fn words(self) -> &'static str {
        match self {
            Self::PairWhole => "pair, flattening included",
            Self::PairBending => "pair, flattening apart",
            Self::PinionWhole => "pinion, flattening included",
            Self::PinionBending => "pinion, flattening apart",
        }
    }

    /// Stiffness at a position, N/(mm·µm).
    pub fn n_per_mm_um(self, at: &PairDeflection) -> f64 {
        1e-3 / match self {
            Self::PairWhole => at.sum(|tooth| tooth.whole_mm2_per_n),
            Self::PairBending => at.sum(|tooth| tooth.bending_mm2_per_n),
            Self::PinionWhole => at.pinion.whole_mm2_per_n,
            Self::PinionBending => at.pinion.bending_mm2_per_n,
        }
    }
}

/// Variations over the positions of `deflections` (at least one).
pub fn courses(pair: &GearPair, deflections: &[PairDeflection]) -> Vec<StiffnessVariation> {
    let path = &pair.path;
    VariationOf::ALL
        .into_iter()
        .map(|of| {
            let mut least = f64::INFINITY;
            let (mut greatest, mut at_mm) = (0.0, path.start_mm);
            let mut sum = 0.0;
            for at in deflections {
                let stiffness = of.n_per_mm_um(at);
                sum += stiffness;
                least = least.min(stiffness);
                if stiffness > greatest {
                    (greatest, at_mm) = (stiffness, at.position_mm);
                }
            }
            StiffnessVariation {
                of,
                mean_n_per_mm_um: sum / deflections.len() as f64,
                max_over_min: greatest / least,
                greatest_at: (at_mm - path.start_mm) / (path.end_mm - path.start_mm),
            }
        })
        .collect()
}
