//! The points of the path of contact, and where among them a place is.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A value at each of the points A–E of the path of contact.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[allow(non_snake_case, reason = "the points' names")]
pub struct PathPoints {
    /// Start of contact.
    pub A: f64,
    /// Lower point of single-pair contact on the pinion.
    pub B: f64,
    /// Pitch point.
    pub C: f64,
    /// Upper point of single-pair contact on the pinion.
    pub D: f64,
    /// End of contact.
    pub E: f64,
}

impl PathPoints {
    /// Names and values, in the order of contact.
    pub fn named(&self) -> [(&'static str, f64); 5] {
        [("A", self.A), ("B", self.B), ("C", self.C), ("D", self.D), ("E", self.E)]
    }
}

/// Where `at` lies among the named places: close to one of them, between two, or outside all.
pub fn among(places: &[(&str, f64)], at: f64) -> String {
    let mut sorted = places.to_vec();
    sorted.sort_by(|a, b| a.1.total_cmp(&b.1));
    let (Some(first), Some(last)) = (sorted.first(), sorted.last()) else { return String::new() };
    let nearest = sorted.iter().min_by(|a, b| (a.1 - at).abs().total_cmp(&(b.1 - at).abs())).unwrap_or(first);
    if (nearest.1 - at).abs() <= 0.03 * (last.1 - first.1) {
        return format!("close to {}", nearest.0);
    }
    match sorted.windows(2).find(|pair| (pair[0].1..pair[1].1).contains(&at)) {
        Some(pair) => format!("between {} and {}", pair[0].0, pair[1].0),
        None => "outside the active flank".into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// On an FZG type A pair C lies before B: order is by place, not by name.
    #[test]
    fn places_are_named_in_their_own_order() {
        let places = [("A", 0.0), ("B", 4.8), ("C", 3.3), ("D", 13.0), ("E", 18.0)];
        assert_eq!(among(&places, 0.2), "close to A");
        assert_eq!(among(&places, 4.1), "between C and B");
        assert_eq!(among(&places, 9.0), "between B and D");
        assert_eq!(among(&places, 25.0), "outside the active flank");
        assert_eq!(among(&[], 1.0), "");
    }
}
