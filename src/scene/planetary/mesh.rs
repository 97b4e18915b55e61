//! The two meshes of a planetary stage, and what is known of each.

use std::ops::{Index, IndexMut};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use gearwear_bodies::gear::Gear;

/// A mesh of the stage.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum StageMesh {
    /// The sun, as pinion, and a planet.
    SunPlanet,
    /// A planet, as pinion, and the ring.
    PlanetRing,
}

impl StageMesh {
    /// Both, in the order of power from the sun.
    pub const BOTH: [StageMesh; 2] = [StageMesh::SunPlanet, StageMesh::PlanetRing];

    /// Table of the file with what holds for this mesh alone.
    pub fn table(self) -> &'static str {
        match self {
            StageMesh::SunPlanet => "sun_planet",
            StageMesh::PlanetRing => "planet_ring",
        }
    }

    /// Folder of its run in that of the stage.
    pub fn folder(self) -> &'static str {
        match self {
            StageMesh::SunPlanet => "sun-planet",
            StageMesh::PlanetRing => "planet-ring",
        }
    }

    /// Names of pinion and wheel in the stage.
    pub fn gears(self) -> [&'static str; 2] {
        match self {
            StageMesh::SunPlanet => ["sun", "planet"],
            StageMesh::PlanetRing => ["planet", "ring"],
        }
    }

    /// Path of a gear's flank in the summary of a stage.
    pub fn flank(self, gear: Gear) -> &'static str {
        match (self, gear) {
            (StageMesh::SunPlanet, Gear::Pinion) => "sun",
            (StageMesh::SunPlanet, Gear::Wheel) => "planet.sun_flank",
            (StageMesh::PlanetRing, Gear::Pinion) => "planet.ring_flank",
            (StageMesh::PlanetRing, Gear::Wheel) => "ring",
        }
    }

    /// The flank in words.
    pub fn flank_in_words(self, gear: Gear) -> &'static str {
        match (self, gear) {
            (StageMesh::SunPlanet, Gear::Pinion) => "sun",
            (StageMesh::SunPlanet, Gear::Wheel) => "planet towards the sun",
            (StageMesh::PlanetRing, Gear::Pinion) => "planet towards the ring",
            (StageMesh::PlanetRing, Gear::Wheel) => "ring",
        }
    }

    /// Both gears in words.
    pub fn in_words(self) -> String {
        self.gears().join(" and ")
    }
}

/// One of each mesh.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[allow(missing_docs, reason = "the names say it")]
pub struct PerMesh<T> {
    pub sun_planet: T,
    pub planet_ring: T,
}

impl<T> PerMesh<T> {
    /// Made for each mesh, or the first error.
    ///
    /// # Errors
    /// That of `make`.
    pub fn try_from_fn<E>(mut make: impl FnMut(StageMesh) -> Result<T, E>) -> Result<Self, E> {
        Ok(Self { sun_planet: make(StageMesh::SunPlanet)?, planet_ring: make(StageMesh::PlanetRing)? })
    }

    /// Each changed by `change`.
    pub fn map<U>(self, mut change: impl FnMut(T) -> U) -> PerMesh<U> {
        PerMesh { sun_planet: change(self.sun_planet), planet_ring: change(self.planet_ring) }
    }

    /// References to both.
    pub fn as_ref(&self) -> PerMesh<&T> {
        PerMesh { sun_planet: &self.sun_planet, planet_ring: &self.planet_ring }
    }

    /// Both, in their order.
    pub fn both(&self) -> [&T; 2] {
        [&self.sun_planet, &self.planet_ring]
    }
}

impl<T> Index<StageMesh> for PerMesh<T> {
    type Output = T;

    fn index(&self, mesh: StageMesh) -> &T {
        match mesh {
            StageMesh::SunPlanet => &self.sun_planet,
            StageMesh::PlanetRing => &self.planet_ring,
        }
    }
}

impl<T> IndexMut<StageMesh> for PerMesh<T> {
    fn index_mut(&mut self, mesh: StageMesh) -> &mut T {
        match mesh {
            StageMesh::SunPlanet => &mut self.sun_planet,
            StageMesh::PlanetRing => &mut self.planet_ring,
        }
    }
}
