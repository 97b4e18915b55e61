//! What the reader of a page may move in a chart with a slider below it: the time, from snapshot to snapshot, or the pair through the mesh.
//!
//! The page's script carries it out (`page.js`); figures in files show the chart as it is first drawn.

use serde::Serialize;

use super::trace::Rows;

/// A slider below a chart.
#[derive(Debug, Clone, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Control {
    /// States one after the other; the chart is first drawn in the last of them.
    Steps {
        /// What the slider moves, for those who do not see it.
        name: &'static str,
        steps: Vec<SliderStep>,
    },
    /// The pair turning through the mesh.
    Mesh(MeshMotion),
}

/// A state of a chart.
#[derive(Debug, Clone, Serialize)]
pub struct SliderStep {
    /// Its name beside the slider.
    pub label: String,
    pub change: Change,
}

/// What a state has of its own.
#[derive(Debug, Clone, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Change {
    /// Whether each trace is shown.
    Shown(Vec<bool>),
    /// Values over the cells of the first trace.
    Cells(Rows),
}

/// Two gears that turn about their axes while their contact moves along the path of contact.
#[derive(Debug, Clone, Serialize)]
pub struct MeshMotion {
    /// The traces that turn.
    pub bodies: [TurningBody; 2],
    /// Contact position at which they are drawn, mm.
    pub drawn_at_mm: f64,
    /// First and last contact position, mm.
    pub path_mm: [f64; 2],
    /// From one tooth pair to the next, mm.
    pub base_pitch_mm: f64,
    /// The trace of the points of contact, a row of points.
    pub contacts: usize,
    /// Contact position 0.
    pub origin_mm: [f64; 2],
    /// The way along the line of action, of length 1.
    pub direction: [f64; 2],
    /// Contact positions, rising, mm.
    pub position_mm: Vec<f64>,
    /// Share of the load that the pair at each of these carries, worn.
    pub load_share: Vec<f64>,
}

/// A trace that turns.
#[derive(Debug, Clone, Copy, Serialize)]
pub struct TurningBody {
    pub trace: usize,
    pub centre_mm: [f64; 2],
    /// Anticlockwise, per length along the path of contact.
    pub radians_per_mm: f64,
}
