//! Plane finite elements that runs of a study leave to one another.
//!
//! A condensed gear depends on its mesh and its elastic constants alone: not on flank points, positions, steps or wear, and on its mate only as far as that
//! changes the mesh. Gears of the same mesh are condensed once. Those that were not asked for longest make room for others.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use gearwear_bodies::gear::{GearPair, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::flank_surface::MeshedFlank;
use gearwear_bodies::gear_fem::model::{MeshedGear, ModelError};
use gearwear_bodies::gear_fem::ring::GearCompliance;
use gearwear_bodies::gear_mesh::settings::BodySettings;
use gearwear_fem::elastic::Elastic;

/// Condensed gears of earlier runs; by default none are kept.
#[derive(Clone, Default)]
pub struct KeptElements(Option<Arc<Mutex<KeptGears>>>);

/// Condensed gears, the one asked for last at the end.
struct KeptGears {
    /// Memory that they may take, GB; the last pinion and the last wheel are kept whatever they take.
    most_gb: f64,
    gears: Vec<KeptGear>,
}

/// A condensed gear, and what it was made of.
struct KeptGear {
    meshed: MeshedGear,
    material: Elastic,
    condensed: (GearCompliance, MeshedFlank),
}

/// All are equal: kept elements are no property of a scene.
impl PartialEq for KeptElements {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for KeptElements {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("KeptElements")
    }
}

impl KeptElements {
    /// As many gears as take `most_gb` of memory, the last pair at least, are kept from one run to the next.
    pub fn up_to_gb(most_gb: f64) -> Self {
        Self(Some(Arc::new(Mutex::new(KeptGears { most_gb, gears: Vec::new() }))))
    }

    /// Condensed gears of `pair`: those kept, or new ones; much memory is announced before.
    ///
    /// # Errors
    /// As [`CondensedPair::build`].
    pub fn condensed<'a>(
        &self,
        pair: &'a GearPair,
        material: &PerGear<Elastic>,
        line_load_n_per_mm: f64,
        bodies: &BodySettings,
        announce: &dyn Fn(&str),
    ) -> Result<CondensedPair<'a>, ModelError> {
        let condense = |meshed: &MeshedGear, own: Elastic| {
            let new = || meshed.condense_without_stresses(pair, own);
            let Some(kept) = &self.0 else { return new() };
            // Nothing is half changed where another thread panics.
            let locked = || kept.lock().unwrap_or_else(PoisonError::into_inner);
            if let Some(condensed) = locked().find_or_make_room(meshed, own) {
                return Ok(condensed);
            }
            // Not locked meanwhile: this thread may take over other work while it waits, and runs on other threads go on. One that wants the same gear
            // finds the same bits.
            let condensed = new()?;
            locked().keep(KeptGear { meshed: meshed.clone(), material: own, condensed: condensed.clone() });
            Ok(condensed)
        };
        CondensedPair::build_by(condense, pair, material, line_load_n_per_mm, bodies, announce)
    }
}

impl KeptGears {
    /// The gear condensed of this mesh and material, which is the one asked for last then; where there is none, room for it.
    fn find_or_make_room(&mut self, meshed: &MeshedGear, material: Elastic) -> Option<(GearCompliance, MeshedFlank)> {
        let Some(at) = self.gears.iter().position(|kept| kept.material == material && kept.meshed == *meshed) else {
            self.make_room(meshed);
            return None;
        };
        let kept = self.gears.remove(at);
        let condensed = kept.condensed.clone();
        self.gears.push(kept);
        Some(condensed)
    }

    /// Keeps a gear, unless another run has left the same one meanwhile.
    fn keep(&mut self, gear: KeptGear) {
        if self.find_or_make_room(&gear.meshed, gear.material).is_none() {
            self.gears.push(gear);
        }
    }

    /// Drops gears, those not asked for longest first, until there is room for the `coming` one, or only the last of its mate is left.
    fn make_room(&mut self, coming: &MeshedGear) {
        let gb = |gears: &[KeptGear]| gears.iter().map(|kept| kept.meshed.condensed_gb()).sum::<f64>();
        while gb(&self.gears) + coming.condensed_gb() > self.most_gb {
            let may_go = |&at: &usize| {
                let gear = self.gears[at].meshed.gear;
                gear == coming.gear || self.gears[at + 1..].iter().any(|newer| newer.meshed.gear == gear)
            };
            let Some(oldest) = (0..self.gears.len()).find(may_go) else { break };
            self.gears.remove(oldest);
        }
    }
}
