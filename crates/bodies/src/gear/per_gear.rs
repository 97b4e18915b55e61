//! One value for each gear of the pair.

use std::ops::{Index, IndexMut};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Gear of the pair; the pinion drives.
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

    /// Mating gear.
    pub fn mate(self) -> Gear {
        match self {
            Gear::Pinion => Gear::Wheel,
            Gear::Wheel => Gear::Pinion,
        }
    }

    /// Name in the scene file, `"pinion"` or `"wheel"`.
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
    /// Value of the pinion.
    pub pinion: T,
    /// Value of the wheel.
    pub wheel: T,
}

impl<T> PerGear<T> {
    /// Values of `f` for both gears.
    pub fn from_fn(mut f: impl FnMut(Gear) -> T) -> Self {
        Self { pinion: f(Gear::Pinion), wheel: f(Gear::Wheel) }
    }

    /// Values of `f` for the values of both gears.
    pub fn map<U>(self, mut f: impl FnMut(T) -> U) -> PerGear<U> {
        PerGear { pinion: f(self.pinion), wheel: f(self.wheel) }
    }

    /// References to both values.
    pub fn as_ref(&self) -> PerGear<&T> {
        PerGear { pinion: &self.pinion, wheel: &self.wheel }
    }
}

impl<T> From<PerGear<T>> for [T; 2] {
    /// Values of the pinion and the wheel.
    fn from(of: PerGear<T>) -> Self {
        [of.pinion, of.wheel]
    }
}

impl<T: Send> PerGear<T> {
    /// Values of `of` for both gears, calculated in parallel.
    pub fn in_parallel(of: impl Fn(Gear) -> T + Sync) -> Self {
        let (pinion, wheel) = rayon::join(|| of(Gear::Pinion), || of(Gear::Wheel));
        Self { pinion, wheel }
    }

    /// Values of `of` for both gears, calculated in parallel.
    ///
    /// # Errors
    /// The error of the pinion, or else of the wheel.
    pub fn try_in_parallel<E: Send>(of: impl Fn(Gear) -> Result<T, E> + Sync) -> Result<Self, E> {
        let PerGear { pinion, wheel } = PerGear::in_parallel(of);
        Ok(Self { pinion: pinion?, wheel: wheel? })
    }
}

impl<T: std::ops::Add<Output = T>> PerGear<T> {
    /// Sum of both values.
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
