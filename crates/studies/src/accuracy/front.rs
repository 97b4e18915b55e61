//! The Pareto front of error and run time, and the cheapest setting below a wanted error.
//!
//! A run is on the front where no other run is both at least as fast and at least as accurate, and better in one of the
//! two. Errors below the reference's own uncertainty cannot be told apart and count as equal to it.

/// Run time and error of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FrontPoint {
    /// Run time.
    pub wall_s: f64,
    /// Relative error.
    pub error: f64,
}

impl FrontPoint {
    fn is_comparable(&self) -> bool {
        self.wall_s.is_finite() && self.error.is_finite()
    }
}

/// Whether each of `points` is on the front; errors below `uncertainty` count as equal.
pub fn on_front(points: &[FrontPoint], uncertainty: f64) -> Vec<bool> {
    let others = points.iter().enumerate().filter(|(_, other)| other.is_comparable());
    let on_front = points.iter().enumerate().map(|(i, point)| {
        let beaten = others.clone().any(|(j, other)| {
            let (own, others) = (point.error.max(uncertainty), other.error.max(uncertainty));
            let no_worse = other.wall_s <= point.wall_s && others <= own;
            let better = other.wall_s < point.wall_s || others < own;
            // Of equal points only the first is on the front.
            no_worse && (better || j < i)
        });
        point.is_comparable() && !beaten
    });
    on_front.collect()
}

/// The fastest of `points` whose error is within `wanted`, else the one with the least error; and whether it is within.
pub fn cheapest_within(points: &[FrontPoint], wanted: f64) -> Option<(usize, bool)> {
    let all = points.iter().enumerate().filter(|(_, point)| point.is_comparable());
    let within = all.clone().filter(|(_, point)| point.error <= wanted);
    match within.min_by(|(_, a), (_, b)| a.wall_s.total_cmp(&b.wall_s)) {
        Some((index, _)) => Some((index, true)),
        None => all.min_by(|(_, a), (_, b)| a.error.total_cmp(&b.error)).map(|(index, _)| (index, false)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(of: &[(f64, f64)]) -> Vec<FrontPoint> {
        of.iter().map(|&(wall_s, error)| FrontPoint { wall_s, error }).collect()
    }

    /// By hand: the second is beaten by the first (faster and better), the fourth by the third (as good, faster); the last
    /// has failed.
    #[test]
    fn ver_the_front_of_five_runs() {
        let runs = points(&[(1.0, 0.10), (2.0, 0.20), (3.0, 0.01), (4.0, 0.01), (f64::NAN, 0.001)]);
        assert_eq!(on_front(&runs, 0.0), [true, false, true, false, false]);
        // Below 0.15 nothing is told apart: the fastest stands for all.
        assert_eq!(on_front(&runs, 0.15), [true, false, false, false, false]);
    }

    #[test]
    fn ver_the_cheapest_within() {
        let runs = points(&[(1.0, 0.10), (2.0, 0.04), (3.0, 0.01), (0.1, f64::INFINITY)]);
        assert_eq!(cheapest_within(&runs, 0.05), Some((1, true)));
        assert_eq!(cheapest_within(&runs, 0.001), Some((2, false)));
        assert_eq!(cheapest_within(&[], 0.05), None);
    }

    proptest! {
        /// Every run is on the front or beaten by one that is.
        #[test]
        fn prop_the_front_beats_the_rest(
            runs in prop::collection::vec((0.01f64..10.0, 1e-4f64..1.0), 1..30), uncertainty in 0.0f64..0.1
        ) {
            let runs = points(&runs);
            let front = on_front(&runs, uncertainty);
            for point in &runs {
                let covered = runs.iter().zip(&front).any(|(other, &on)| {
                    on && other.wall_s <= point.wall_s
                        && other.error.max(uncertainty) <= point.error.max(uncertainty)
                });
                prop_assert!(covered);
            }
        }
    }
}
