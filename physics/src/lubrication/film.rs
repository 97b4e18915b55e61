//! Thickness of the oil film in a line contact, isothermal and fully flooded.
//!
//! ```text
//! U = η v_Σ / (2 E_r ρ)      G = α E_r      W = w / (E_r ρ)
//!
//! least, Dowson and Higginson   h/ρ = 2.65  U^0.70  G^0.54  W^−0.13
//! central, Hamrock              h/ρ = 2.922 U^0.692 G^0.470 W^−0.166
//! central, Grubin               h/ρ = 1.95 (U G)^(8/11) W^(−1/11)
//! ```
//!
//! Sources: D. Dowson and G. R. Higginson, *Elasto-Hydrodynamic Lubrication* (1966, second edition 1977); B. J. Hamrock, S. R. Schmid and
//! B. O. Jacobson, *Fundamentals of Fluid Film Lubrication* (2004), section 18; A. N. Grubin and I. E. Vinogradova (1949), as in K. L.
//! Johnson's regimes.
//!
//! Limits: smooth surfaces, full film, oil that thickens with pressure exponentially; neither starvation nor heat by shear in the inlet,
//! which takes less than 1 % at the speeds of usual gears and tens of per cent above some 20 m/s.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::rolling_contact::RollingContact;

/// Formula of the central film.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum CentralFilm {
    /// Hamrock, Schmid and Jacobson's fit of numerical solutions of the line contact.
    #[default]
    Hamrock,
    /// Grubin's inlet analysis.
    Grubin,
}

/// U, G and W of a contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilmParameters {
    relative_radius_mm: f64,
    speed: f64,
    material: f64,
    load: f64,
}

impl FilmParameters {
    /// Parameters of a contact of bodies with E_r, in an oil of η and α at the temperature of the inlet.
    pub fn new(
        contact: &RollingContact,
        reduced_modulus_mpa: f64,
        viscosity_milli_pa_s: f64,
        pressure_viscosity_per_gpa: f64,
    ) -> Self {
        let stiffness_n_per_mm = reduced_modulus_mpa * contact.relative_radius_mm;
        // mPa·s · m/s is 1e-6 N/mm.
        let viscous_n_per_mm = 1e-6 * viscosity_milli_pa_s * contact.sum_speed_m_per_s();
        Self {
            relative_radius_mm: contact.relative_radius_mm,
            speed: viscous_n_per_mm / (2.0 * stiffness_n_per_mm),
            material: 1e-3 * pressure_viscosity_per_gpa * reduced_modulus_mpa,
            load: contact.line_load_n_per_mm / stiffness_n_per_mm,
        }
    }

    /// Least thickness, Dowson and Higginson, µm.
    pub fn least_um(&self) -> f64 {
        1e3 * self.relative_radius_mm * 2.65 * self.speed.powf(0.7) * self.material.powf(0.54) * self.load.powf(-0.13)
    }

    /// Thickness in the middle of the contact, µm.
    pub fn central_um(&self, by: CentralFilm) -> f64 {
        let over_radius = match by {
            CentralFilm::Hamrock => 2.922 * self.speed.powf(0.692) * self.material.powf(0.470) * self.load.powf(-0.166),
            CentralFilm::Grubin => 1.95 * (self.speed * self.material).powf(8.0 / 11.0) * self.load.powf(-1.0 / 11.0),
        };
        1e3 * self.relative_radius_mm * over_radius
    }
}
