//! Colours of charts: tokens of the palette in `page.css`.

use gearwear_bodies::gear::Gear;

pub const NEW: &str = "var(--new)";
pub const WORN: &str = "var(--worn)";
/// Secondary lines and labels.
pub const MUTED: &str = "var(--muted)";
/// The path of contact.
pub const PATH: &str = "var(--path)";
/// Outlines and the answer that others are compared with.
pub const INK: &str = "var(--ink)";

pub fn gear_colour(gear: Gear) -> &'static str {
    match gear {
        Gear::Pinion => "var(--pinion)",
        Gear::Wheel => "var(--wheel)",
    }
}

pub fn gear_fill(gear: Gear) -> &'static str {
    match gear {
        Gear::Pinion => "var(--pinion-fill)",
        Gear::Wheel => "var(--wheel-fill)",
    }
}

/// Colour of a gear at `share` of its life: from pale to full.
pub fn gear_colour_at(gear: Gear, share: f64) -> String {
    format!("mix(--{0}-early,--{0},{share:.3})", gear.name())
}
