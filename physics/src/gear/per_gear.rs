//! One value for each gear of the pair.

use std::ops::{Index, IndexMut};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Which gear of the pair; the pinion drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Gear {
    /// The driving gear.
    Pinion,
    /// The driven gear.
    Wheel,
}

impl Gear {
    /// Pinion, then wheel.
    pub const BOTH: [Gear; 2] = [Gear::Pinion, Gear::Wheel];

    /// The gear this one meshes with.
    pub fn mate(self) -> Gear {
        match self {
            Gear::Pinion => Gear::Wheel,
            Gear::Wheel => Gear::Pinion,
        }
    }

    /// `"pinion"` or `"wheel"`, as in the scene file.
    pub fn name(self) -> &'static str {
        match self {
            Gear::Pinion => "pinion",
            Gear::Wheel => "wheel",
        }
    }
}

/// A value for the pinion and one for the wheel.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PerGear<T> {
    /// The pinion's.
    pub pinion: T,
    /// The wheel's.
    pub wheel: T,
}

impl<T> PerGear<T> {
    /// The value `f` gives for each gear.
    pub fn from_fn(mut f: impl FnMut(Gear) -> T) -> Self {
        Self { pinion: f(Gear::Pinion), wheel: f(Gear::Wheel) }
    }

    /// Each gear's value, transformed.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> PerGear<U> {
        PerGear { pinion: f(self.pinion), wheel: f(self.wheel) }
    }

    /// References to both values.
    pub fn as_ref(&self) -> PerGear<&T> {
        PerGear { pinion: &self.pinion, wheel: &self.wheel }
    }
}

impl<T> From<PerGear<T>> for [T; 2] {
    /// The pinion's, then the wheel's.
    fn from(of: PerGear<T>) -> Self {
        [of.pinion, of.wheel]
    }
}

impl<T: Send> PerGear<T> {
    /// What `of` makes of each gear, of both at the same time where there are threads for it.
    ///
    /// # Errors
    /// That of the pinion, or else that of the wheel.
    pub fn try_in_parallel<E: Send>(of: impl Fn(Gear) -> Result<T, E> + Sync) -> Result<Self, E> {
        let (pinion, wheel) = rayon::join(|| of(Gear::Pinion), || of(Gear::Wheel));
        Ok(Self { pinion: pinion?, wheel: wheel? })
    }
}

impl<T: std::ops::Add<Output = T>> PerGear<T> {
    /// Pinion's and wheel's together.
    pub fn sum(self) -> T {
        self.pinion + self.wheel
    }
}

impl<T> Index<Gear> for PerGear<T> {
    type Output = T;

    fn index(&self, gear: Gear) -> &T {
        match gear {
            Gear::Pinion => &self.pinion,
            Gear::Wheel => &self.wheel,
        }
    }
}

impl<T> IndexMut<Gear> for PerGear<T> {
    fn index_mut(&mut self, gear: Gear) -> &mut T {
        match gear {
            Gear::Pinion => &mut self.pinion,
            Gear::Wheel => &mut self.wheel,
        }
    }
}
