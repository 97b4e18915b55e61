//! The pair in mesh as it is drawn.

use serde::{Deserialize, Serialize};

use gearwear_bodies::gear::PerGear;

/// The pair in mesh in the transverse section, mm; the pinion's axis is the origin and the wheel's lies on +y, on −y of an
/// internal pair.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PairDrawing {
    /// Closed outline of each whole gear in its place.
    pub outline: PerGear<Vec<[f64; 2]>>,
    /// Axis of each gear.
    pub axis: PerGear<[f64; 2]>,
    /// Bore radius of each gear, where given.
    pub bore_radius_mm: PerGear<Option<f64>>,
    /// Base, working pitch and tip radius of each gear.
    pub circles_mm: PerGear<GearCircles>,
    /// Where the line of action touches the base circles: T1, T2.
    pub line_of_action: [[f64; 2]; 2],
    /// Points A–E with their names, in the order of contact.
    pub path_of_contact: Vec<(String, [f64; 2])>,
    /// Outside radius with which an internal wheel is drawn.
    pub rim_radius_mm: Option<f64>,
}

/// Radii of the circles drawn, negative of an internal wheel.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[allow(missing_docs, reason = "the names say it")]
pub struct GearCircles {
    pub base: f64,
    pub working_pitch: f64,
    pub tip: f64,
}
