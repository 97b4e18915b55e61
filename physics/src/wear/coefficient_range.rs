//! Ranges of wear coefficients by wear regime.
//!
//! They are those of the table in `docs/materials.md`, three times as wide on either side, since repeated tests scatter by half and no load or oil is
//! that of the source; where the table has one end, two decades. A range is the 95 % interval of a lognormal distribution.

/// A row of the table of coefficients.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CoefficientRange {
    /// Name of the regime.
    pub name: &'static str,
    /// 95 % interval before any measurement, m²/N.
    pub range_m2_per_n: [f64; 2],
}

/// Ranges in the order of the table.
pub const RANGES: [CoefficientRange; 6] = [
    CoefficientRange { name: "mild", range_m2_per_n: [3e-18, 6e-17] },
    CoefficientRange { name: "regime-1", range_m2_per_n: [1e-20, 1e-18] },
    CoefficientRange { name: "regime-2", range_m2_per_n: [3e-18, 3e-15] },
    CoefficientRange { name: "regime-3", range_m2_per_n: [1e-14, 1e-12] },
    CoefficientRange { name: "plastic", range_m2_per_n: [3e-16, 1.5e-14] },
    CoefficientRange { name: "dry", range_m2_per_n: [4e-13, 4e-11] },
];

impl CoefficientRange {
    /// Range of the regime of this name.
    pub fn named(name: &str) -> Option<Self> {
        RANGES.into_iter().find(|range| range.name == name.trim())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page names every regime in a row of its own, with the same ends.
    #[test]
    fn ranges_stand_in_the_table_of_coefficients() {
        let page = include_str!("../../../docs/materials.md");
        for CoefficientRange { name, range_m2_per_n: [low, high] } in RANGES {
            let row = page.lines().find(|line| line.contains(&format!("`{name}`")));
            let row = row.unwrap_or_else(|| panic!("docs/materials.md: no row of {name}"));
            assert!(row.contains(&format!("{low:e}–{high:e}")), "{name}: {low:e}–{high:e} is not in {row}");
        }
    }
}
