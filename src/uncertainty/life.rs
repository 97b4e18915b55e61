//! Life: the time at which a depth of wear reaches a limit, read off the history of the run.
//!
//! Between the moments of the history the depth is taken to grow evenly, from 0 at the beginning. A run that does not come to the limit
//! says only that its life is longer than its duration: it is censored.

use std::str::FromStr;

use serde::Serialize;

use crate::scene::nearest::nearest;
use gearwear_physics::results::figures::{self, MainFigure};
use gearwear_physics::results::run::HistoryRow;

/// Main figures that are depths of a history.
fn depths() -> impl Iterator<Item = &'static MainFigure> {
    figures::all().iter().filter(|figure| figure.depth_of_history().is_some())
}

fn names() -> Vec<&'static str> {
    depths().map(|figure| figure.name.as_str()).collect()
}

/// A depth that ends the life.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DepthLimit {
    pub output: &'static str,
    pub depth_um: f64,
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LimitError {
    #[error("found {given:?}; allowed: FIGURE=VALUE with a value above 0, such as pinion.peak_wear_um=10")]
    Form { given: String },
    #[error("unknown figure {name}; allowed: {}{}", names().join(", "), meant.map_or_else(String::new, |meant| format!("; did you mean {meant}?")))]
    Unknown { name: String, meant: Option<&'static str> },
}

impl FromStr for DepthLimit {
    type Err = LimitError;

    fn from_str(given: &str) -> Result<Self, LimitError> {
        let parts = given.split_once('=').and_then(|(name, value)| {
            Some((name.trim(), value.trim().parse().ok().filter(|depth: &f64| depth.is_finite() && *depth > 0.0)?))
        });
        let (name, depth_um) = parts.ok_or_else(|| LimitError::Form { given: given.to_owned() })?;
        let figure = figures::find(name).filter(|figure| figure.depth_of_history().is_some());
        let figure =
            figure.ok_or_else(|| LimitError::Unknown { name: name.to_owned(), meant: nearest(name, &names()) })?;
        Ok(Self { output: &figure.name, depth_um })
    }
}

/// Time, in hours where the scene has a speed and else in revolutions of the pinion, and depth at each moment.
pub type Growth = Vec<(f64, f64)>;

impl DepthLimit {
    /// Growth of the depth over the history.
    pub fn growth(&self, history: &[HistoryRow]) -> Growth {
        let Some(of) = figures::find(self.output).and_then(MainFigure::depth_of_history) else { return Growth::new() };
        history.iter().map(|row| (row.hours.unwrap_or(row.revolutions), of(row))).collect()
    }

    /// Depth at the end of the history, µm; no number where there is none.
    pub fn depth(&self, history: &[HistoryRow]) -> f64 {
        self.growth(history).last().map_or(f64::NAN, |(_, depth_um)| *depth_um)
    }

    /// Life: when `times` times the depth reaches the limit; infinite where it does not, with the time up to which that is known.
    pub fn life(&self, growth: &Growth, times: f64) -> (f64, f64) {
        let (mut time, mut depth) = (0.0, 0.0);
        for &(next_time, next_depth) in growth {
            let next_depth = times * next_depth;
            if next_depth >= self.depth_um {
                let part = (self.depth_um - depth) / (next_depth - depth);
                let life = time + part * (next_time - time);
                return (life, life);
            }
            (time, depth) = (next_time, next_depth);
        }
        (f64::INFINITY, time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Wear that grows evenly, 2 µm an hour.
    #[test]
    fn ver_life_of_linear_wear() {
        let limit: DepthLimit = "pinion.peak_wear_um = 5".parse().unwrap();
        let growth = vec![(1.0, 2.0), (2.0, 4.0), (3.0, 6.0)];
        assert_eq!(limit.life(&growth, 1.0), (2.5, 2.5));
        assert_eq!(limit.life(&growth, 5.0), (0.5, 0.5));
        assert_eq!(limit.life(&growth, 0.5), (f64::INFINITY, 3.0));
    }

    #[test]
    fn depths_of_the_history_are_called_as_in_the_summary() {
        for name in ["wheel.below_sap_wear_um", "pinion.root_wear_um", "pinion_root_wear_um"] {
            let limit: DepthLimit = format!("{name}=1").parse().unwrap();
            assert_eq!(limit.output, name.replace("pinion_", "pinion."));
        }
        assert!("wheel.root_wear_um=1".parse::<DepthLimit>().is_err(), "no history has it");
    }

    #[test]
    fn what_is_no_limit_is_refused() {
        for (given, part) in [
            ("pinion.peak_wear_um", "FIGURE=VALUE"),
            ("pinion.peak_wear_um=-1", "above 0"),
            ("pinion.peek_wear_um=1", "did you mean pinion.peak_wear_um?"),
        ] {
            assert!(given.parse::<DepthLimit>().unwrap_err().to_string().contains(part), "{given}");
        }
    }
}
