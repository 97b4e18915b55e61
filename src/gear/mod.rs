//! Geometry of cylindrical involute gears, after ISO 21771: from the data of a pair to its teeth, their outline, the path
//! of contact and the flank's field of removed material.

pub(crate) mod backlash;
pub(crate) mod conjugate;
pub(crate) mod error;
pub(crate) mod flank;
pub(crate) mod flank_surface;
pub(crate) mod flank_zones;
pub(crate) mod half_profile;
pub(crate) mod involute;
pub(crate) mod modification;
pub(crate) mod outline;
pub(crate) mod pair;
pub(crate) mod path_of_contact;
pub(crate) mod per_gear;
pub(crate) mod removed_material;
pub(crate) mod root_trochoid;
pub(crate) mod shaft;
pub(crate) mod slices;
pub(crate) mod spec;
pub(crate) mod tip_touch;
pub(crate) mod tolerance;
pub(crate) mod tooth;

pub(crate) use error::PairError;
pub(crate) use pair::GearPair;
pub use per_gear::{Gear, PerGear};
