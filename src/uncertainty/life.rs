//! Life: the time at which a depth of wear reaches a limit, read off the history of the run.
//!
//! Between the moments of the history the depth is taken to grow evenly, from 0 at the beginning. A run that does not come to the limit
//! says only that its life is longer than its duration: it is censored.

use serde::Serialize;

use crate::evaluate::figure::{self, StudyFigure};
use crate::scene::nearest::nearest;
use crate::scene::opened::SceneKind;
use crate::varied_scene::StudiedRun;

/// Names of the main figures of a kind of scene that are depths of a history.
fn names(kind: SceneKind) -> Vec<&'static str> {
    let depths = figure::all(kind).iter().filter(|figure| figure.has_history());
    depths.map(|figure| figure.name.as_str()).collect()
}

/// A depth that ends the life.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DepthLimit {
    pub output: &'static str,
    pub depth_um: f64,
    #[serde(skip)]
    figure: &'static StudyFigure,
}

#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum LimitError {
    #[error("found {given:?}; allowed: FIGURE=VALUE with a value above 0, such as {}=10", names(*kind)[0])]
    Form { given: String, kind: SceneKind },
    #[error("unknown figure {name}; allowed: {}{}", names(*kind).join(", "), nearest(name, &names(*kind)).map_or_else(String::new, |meant| format!("; did you mean {meant}?")))]
    Unknown { name: String, kind: SceneKind },
}

/// Time, in hours where the scene has a speed and else in revolutions that the scene counts in, and depth at each moment.
pub type Growth = Vec<(f64, f64)>;

impl DepthLimit {
    /// Reads a limit of a figure of a kind of scene.
    ///
    /// # Errors
    /// Another form; a figure that no history has.
    pub fn parse(kind: SceneKind, given: &str) -> Result<Self, LimitError> {
        let parts = given.split_once('=').and_then(|(name, value)| {
            Some((name.trim(), value.trim().parse().ok().filter(|depth: &f64| depth.is_finite() && *depth > 0.0)?))
        });
        let (name, depth_um) = parts.ok_or_else(|| LimitError::Form { given: given.to_owned(), kind })?;
        let figure = figure::find(kind, name).filter(|figure| figure.has_history());
        let figure = figure.ok_or_else(|| LimitError::Unknown { name: name.to_owned(), kind })?;
        Ok(Self { output: &figure.name, depth_um, figure })
    }

    /// Growth of the depth over the history of a run.
    pub fn growth(&self, run: &StudiedRun) -> Growth {
        self.figure.growth(run)
    }

    /// Depth at the end of the history, µm; no number where there is none.
    pub fn depth(&self, run: &StudiedRun) -> f64 {
        self.growth(run).last().map_or(f64::NAN, |(_, depth_um)| *depth_um)
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
        let limit = DepthLimit::parse(SceneKind::Pair, "pinion.peak_wear_um = 5").unwrap();
        let growth = vec![(1.0, 2.0), (2.0, 4.0), (3.0, 6.0)];
        assert_eq!(limit.life(&growth, 1.0), (2.5, 2.5));
        assert_eq!(limit.life(&growth, 5.0), (0.5, 0.5));
        assert_eq!(limit.life(&growth, 0.5), (f64::INFINITY, 3.0));
    }

    #[test]
    fn depths_of_the_history_are_called_as_in_the_summary() {
        for name in ["wheel.below_sap_wear_um", "pinion.root_wear_um", "pinion_root_wear_um"] {
            let limit = DepthLimit::parse(SceneKind::Pair, &format!("{name}=1")).unwrap();
            assert_eq!(limit.output, name.replace("pinion_", "pinion."));
        }
        assert!(DepthLimit::parse(SceneKind::Pair, "wheel.root_wear_um=1").is_err(), "no history has it");
    }

    #[test]
    fn what_is_no_limit_is_refused() {
        for (given, part) in [
            ("pinion.peak_wear_um", "FIGURE=VALUE"),
            ("pinion.peak_wear_um=-1", "above 0"),
            ("pinion.peek_wear_um=1", "did you mean pinion.peak_wear_um?"),
        ] {
            assert!(DepthLimit::parse(SceneKind::Pair, given).unwrap_err().to_string().contains(part), "{given}");
        }
    }
}
