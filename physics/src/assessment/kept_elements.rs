//! Plane finite elements that one run of a study leaves to the next of the same pair.
//!
//! Meshing and condensation depend on the pair, its elastic constants, the load that the mesh is made for and the bodies, not on flank points, positions,
//! steps or wear: runs that differ in these alone have the same elements. Only those of the last run are kept.

use std::fmt;
use std::sync::{Arc, Mutex, PoisonError};

use gearwear_bodies::gear::{GearPair, PerGear, spec::PairSpec};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::flank_surface::MeshedFlank;
use gearwear_bodies::gear_fem::model::ModelError;
use gearwear_bodies::gear_fem::ring::GearCompliance;
use gearwear_bodies::gear_mesh::settings::BodySettings;
use gearwear_fem::elastic::Elastic;

/// Elements of the last run; by default none are kept.
#[derive(Clone, Default)]
pub struct KeptElements(Option<Arc<Mutex<Option<KeptPair>>>>);

/// What condensed gears depend on: pair, materials, line load and bodies.
#[derive(Clone, PartialEq)]
struct ElementsOf {
    pair: PairSpec,
    material: PerGear<Elastic>,
    line_load_n_per_mm: f64,
    bodies: BodySettings,
}

/// Condensed gears of a pair.
struct KeptPair {
    of: ElementsOf,
    gears: PerGear<(GearCompliance, MeshedFlank)>,
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
    /// Elements that are kept from one run to the next.
    pub fn of_last_run() -> Self {
        Self(Some(Arc::default()))
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
        let build = || CondensedPair::build(pair, material, line_load_n_per_mm, bodies, announce);
        let Some(last) = &self.0 else { return build() };
        let of = ElementsOf { pair: pair.spec.clone(), material: *material, line_load_n_per_mm, bodies: *bodies };
        // Nothing is half changed where another thread panics.
        let mut last = last.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(kept) = last.as_ref().filter(|kept| kept.of == of) {
            return Ok(CondensedPair::new(pair, material, kept.gears.clone()));
        }
        *last = None;
        let built = build()?;
        let gears = PerGear::from_fn(|gear| (built.gears[gear].clone(), built.flanks[gear].clone()));
        *last = Some(KeptPair { of, gears });
        Ok(built)
    }
}
