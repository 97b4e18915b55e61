//! The Pareto front of error and run time, and the cheapest setting below a wanted error.
//!
//! A run is on the front where no other run is both at least as fast and at least as accurate, and better in one of the
//! two. Errors below the reference's own uncertainty cannot be told apart and count as equal to it.

/// A run as the front sees it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Point {
    /// Run time.
    pub wall_s: f64,
    /// Relative error.
    pub error: f64,
}

/// Whether each of `points` is on the front, with errors below `uncertainty` told apart no more.
pub(crate) fn on_front(points: &[Point], uncertainty: f64) -> Vec<bool> {
    let error = |point: &Point| point.error.max(uncertainty);
    let comparable = |point: &Point| point.wall_s.is_finite() && point.error.is_finite();
    points
        .iter()
        .enumerate()
        .map(|(i, point)| {
            let beaten_by = |(j, other): (usize, &Point)| {
                let no_worse = other.wall_s <= point.wall_s && error(other) <= error(point);
                let better = other.wall_s < point.wall_s || error(other) < error(point);
                // Of equals, the first stands for all.
                comparable(other) && no_worse && (better || j < i)
            };
            comparable(point) && !points.iter().enumerate().any(beaten_by)
        })
        .collect()
}

/// The fastest of `points` whose error is within `wanted`, else the one with the least error; and whether it is within.
pub(crate) fn cheapest_within(points: &[Point], wanted: f64) -> Option<(usize, bool)> {
    let comparable = || points.iter().enumerate().filter(|(_, p)| p.wall_s.is_finite() && p.error.is_finite());
    let fastest =
        comparable().filter(|(_, p)| p.error <= wanted).min_by(|(_, a), (_, b)| a.wall_s.total_cmp(&b.wall_s));
    match fastest {
        Some((index, _)) => Some((index, true)),
        None => comparable().min_by(|(_, a), (_, b)| a.error.total_cmp(&b.error)).map(|(index, _)| (index, false)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn points(of: &[(f64, f64)]) -> Vec<Point> {
        of.iter().map(|&(wall_s, error)| Point { wall_s, error }).collect()
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
