//! Geometry of cylindrical involute gears, after ISO 21771.

pub mod modification;
pub mod per_gear;
pub mod spec;

pub use per_gear::{Gear, PerGear};
