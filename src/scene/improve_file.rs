//! The table `[improve]` of the scene file: what `gearwear improve` may change, and what for.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Question of `gearwear improve`; runs leave it aside.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ImproveFile {
    /// Free keys with range and tolerance of manufacture: "KEY = FROM:TO ± TOLERANCE" (or +-), or "KEY = WORD, WORD". Default: amount and length of
    /// the tip relief of both gears.
    pub free: Option<Vec<String>>,
    /// One to three figures to lower (lives are raised), as paths in summary.json, or weighted sums of them: "0.7 * PATH + 0.3 * PATH". Default:
    /// maximum wear of pinion and wheel, transmission error over life.
    pub goals: Option<Vec<String>>,
    /// Limits: "PATH <= VALUE" or "PATH >= VALUE". Default: none.
    pub limits: Option<Vec<String>>,
    /// Greatest number of designs run on the fast model, 20 to 2000. Default 50 and 25 more for each free key.
    #[schemars(range(min = 20, max = 2000))]
    pub evaluations: Option<u32>,
    /// Seed of the search. Default 1.
    pub seed: Option<u32>,
}
