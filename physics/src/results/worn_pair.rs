//! Record that a study of many runs keeps of each: the main figures, how they grew, the wear over both flanks, and the mesh cycle.

use super::run::{HistoryRow, MeshCycleRow, Summary};
use gearwear_bodies::gear::PerGear;

/// A run as a study of many keeps it.
#[derive(Debug, Clone, PartialEq)]
pub struct WornPair {
    /// Main figures.
    pub summary: Summary,
    /// One row per snapshot.
    pub history: Vec<HistoryRow>,
    /// Wear over both flanks at the end.
    pub flanks: PerGear<WearProfile>,
    /// One row per position, of the new and of the worn pair.
    pub mesh_cycle: Vec<MeshCycleRow>,
}

/// Wear over a flank.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct WearProfile {
    /// Radii of the points of the flank.
    pub radius_mm: Vec<f64>,
    /// Greatest over the face width at each radius.
    pub wear_um: Vec<f64>,
    /// Start of active profile and tip, by radius.
    pub active_mm: [f64; 2],
}
