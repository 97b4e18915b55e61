//! Geometry of cylindrical involute gears, after ISO 21771.

pub mod error;
pub mod modification;
pub mod pair;
pub mod per_gear;
pub mod spec;

pub use error::PairError;
pub use per_gear::{Gear, PerGear};
