//! Materials by name: elastic and thermal constants at room temperature, each with its public source (docs/materials.md).
//!
//! What a material wears by is not among them: the wear coefficient belongs to a pair, its lubrication and its load.

use super::file::{GearMaterialFile, MaterialPreset};

impl MaterialPreset {
    /// Constants of the material. Thermal diffusivity is conductivity over density and specific heat where the source gives these.
    pub fn properties(self) -> GearMaterialFile {
        // E in GPa, ν, ρ in kg/m³, λ in W/(m·K), κ in m²/s as λ/(ρ c), c in J/(kg·K).
        let [modulus, poisson, density, conductivity, diffusivity] = match self {
            // The thesis.
            Self::Steel => [206.0, 0.3, 7830.0, 46.0, 1.2e-5],
            // E, ρ, λ: iron-foundry.com, GS500-7; ν (0.28 to 0.31), c: makeitfrom.com, ductile cast iron.
            Self::CastIron => [169.0, 0.29, 7100.0, 35.2, 35.2 / (7100.0 * 490.0)],
            // Material library of the program GEARpie.
            Self::Pom => [3.2, 0.35, 1415.0, 0.3, 0.3 / (1415.0 * 1465.0)],
            Self::Pa66 => [1.85, 0.3, 1140.0, 0.26, 0.26 / (1140.0 * 1670.0)],
            // NETZSCH, PA46 (density 1180 to 1210); ν is typical.
            Self::Pa46 => [3.3, 0.4, 1195.0, 0.3, 0.3 / (1195.0 * 2100.0)],
            // designerdata.nl, PBT; ν: data sheet of TPS PBT (NC), newpages.asia.
            Self::Pbt => [2.65, 0.35, 1300.0, 0.25, 0.25 / (1300.0 * 1000.0)],
            // FreeCAD's card PEEK-Generic, after MatWeb; ν is typical.
            Self::Peek => [3.88, 0.4, 1340.0, 0.299, 0.299 / (1340.0 * 1410.0)],
        };
        GearMaterialFile {
            preset: None,
            young_modulus_GPa: Some(modulus),
            young_modulus_curve: None,
            poisson_ratio: Some(poisson),
            density_kg_per_m3: Some(density),
            thermal_conductivity_W_per_mK: Some(conductivity),
            thermal_diffusivity_m2_per_s: Some(diffusivity),
        }
    }
}
