//! Geometry of cylindrical involute gears after ISO 21771: teeth of a pair, their outline, the path
//! of contact and the field of material removed from the flanks.

pub mod backlash;
pub mod conjugate;
pub mod error;
pub mod fillet;
pub mod flank;
pub mod flank_edge;
pub mod flank_surface;
pub mod flank_zones;
mod graded_spacing;
pub mod half_profile;
pub mod inspection;
pub(crate) mod interference;
pub mod internal;
pub mod internal_error;
pub mod involute;
pub mod lines_of_contact;
pub mod measured_flank;
pub mod modification;
pub mod normal_section;
pub mod outline;
pub mod pair;
pub mod path_of_contact;
pub(crate) mod per_gear;
pub mod planetary;
pub mod removed_material;
pub mod ring_fillet;
pub mod root_trochoid;
pub mod shaft;
pub mod shaft_bearings;
pub mod slices;
pub mod spec;
pub mod tip_chamfer;
pub(crate) mod tip_touch;
pub mod tolerance;
pub mod tooth;

pub use error::PairError;
pub use pair::GearPair;
pub use per_gear::{Gear, PerGear};
