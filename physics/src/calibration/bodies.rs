//! Condensed gears of a pair, and its stiffness at C by resolution, depth of the body and neighbouring teeth.
//!
//! A known load needs the compliances of the loaded nodes alone: each row of these tables costs little more than the factorisation of one tooth
//! of each gear.

use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::CalibrationError;
use super::loaded_tooth::{LoadedTooth, nodes_under};
use crate::contact::hertz;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::model::MeshedGear;
use gearwear_bodies::gear_fem::ring::{GearCompliance, ToothForce};
use gearwear_bodies::gear_mesh::settings::{Body, BodySettings, SectorSides, greatest_clamp_mm};
use gearwear_bodies::material::Material;
use gearwear_fem::elastic::Elastic;

/// Elements per half-width in the tables of rim and neighbours; the convergence table shows that they are enough.
pub(crate) const TABLE_ELEMENTS_PER_HALF_WIDTH: f64 = 4.0;
const RESOLUTIONS: [f64; 5] = [4.0, 6.0, 8.0, 10.0, 14.0];
const RIM_MODULES: [f64; 7] = [0.5, 1.0, 1.5, 2.0, 2.5, 4.0, 5.5];
const SECTORS: [u32; 3] = [1, 3, 5];
/// Least radius at which a body is held, over the root radius.
const LEAST_CLAMP_OVER_ROOT: f64 = 0.1;

/// A gear pair with its material and its bodies for finite elements.
#[derive(Clone, Copy)]
pub struct Setup<'a> {
    /// Geometry.
    pub pair: &'a GearPair,
    /// Materials.
    pub material: PerGear<Material>,
    /// Bodies and resolution.
    pub bodies: BodySettings,
    /// Line load that the mesh is made for, N/mm.
    pub line_load_n_per_mm: f64,
}

/// Stiffness of the pair at C, flattening included, on one mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ResolutionRow {
    /// Elements per half-width.
    pub elements_per_half_width: f64,
    /// Degrees of freedom of both gears.
    pub dofs: usize,
    /// Stiffness, N/(mm·µm).
    pub pair_n_per_mm_um: f64,
}

/// Stiffness of the pair at C with the bodies held at a depth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RimRow {
    /// Depth of the body below the root circle in normal modules.
    pub depth_modules: f64,
    /// Radius at which each body is held, mm; positive.
    pub clamp_radius_mm: PerGear<f64>,
    /// Stiffness, N/(mm·µm).
    pub pair_n_per_mm_um: f64,
}

/// Stiffness of the pair at C with some neighbouring teeth.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NeighbourRow {
    /// `ring`, or the number of teeth of a sector and how its sides are held.
    pub body: String,
    /// Stiffness, N/(mm·µm).
    pub pair_n_per_mm_um: f64,
}

/// Stiffness of the pair at C with whole rings, as the tables of rim and neighbours have them.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct WholeRings {
    bodies: BodySettings,
    pair_n_per_mm_um: f64,
    dofs: usize,
}

impl<'a> Setup<'a> {
    /// The elastic constants.
    pub fn elastic(&self) -> PerGear<Elastic> {
        self.material.map(Material::elastic)
    }

    /// One gear, meshed.
    pub fn mesh(&self, gear: Gear) -> Result<MeshedGear, CalibrationError> {
        Ok(MeshedGear::new(self.pair, gear, &self.elastic(), self.line_load_n_per_mm, &self.bodies)?)
    }

    /// Both gears, meshed.
    pub fn meshed(&self) -> Result<PerGear<MeshedGear>, CalibrationError> {
        PerGear::try_in_parallel(|gear| self.mesh(gear))
    }

    /// Both gears, condensed onto their whole flanks.
    pub fn condensed(&self, meshed: &PerGear<MeshedGear>) -> Result<CondensedPair<'a>, CalibrationError> {
        let elastic = self.elastic();
        let gears = PerGear::try_in_parallel(|gear| meshed[gear].condense(self.pair, elastic[gear]))?;
        Ok(CondensedPair::new(self.pair, &elastic, gears))
    }

    /// Compliance of one gear's tooth at the pitch point with each of `shapes` for its body, flattening included, mm²/N, and the degrees of
    /// freedom of the gear as `bodies` has it.
    fn pitch_compliances(
        &self,
        gear: Gear,
        bodies: BodySettings,
        shapes: &[Body],
    ) -> Result<(Vec<f64>, usize), CalibrationError> {
        let w = self.line_load_n_per_mm;
        let position_mm = self.pair.path.pitch_point_mm;
        let meshed = MeshedGear::loaded_at(position_mm, self.pair, gear, &self.elastic(), w, &bodies)?;
        let tooth = &self.pair.teeth[gear];
        let rho_mm = self.pair.path.rho_mm(gear, position_mm);
        let half_width_mm = hertz::flattening(self.pair, &self.material, position_mm).contact.loaded(w).half_width_mm;
        let flank = meshed.flank();
        let nodes = nodes_under(tooth, &flank, rho_mm, half_width_mm);
        let compliance = |body: &GearCompliance| {
            let loaded = LoadedTooth::new(tooth, body, &flank);
            let middle = loaded.middle();
            let moved = loaded
                .ellipse(rho_mm, half_width_mm, w)
                .and_then(|force: ToothForce| loaded.surface_mm(middle, rho_mm, middle, &force));
            moved.map(|moved| moved / w).ok_or(CalibrationError::OffTheFlank { gear, position_mm })
        };
        let condensed = meshed.condense_onto(self.pair, self.elastic()[gear], nodes, shapes)?;
        Ok((condensed.iter().map(compliance).collect::<Result<_, _>>()?, meshed.dofs()))
    }

    /// Stiffness of the pair at the pitch point with each of `shapes` for its bodies, N/(mm·µm), and the degrees of freedom of both gears as
    /// `bodies` has them.
    fn pitch_stiffnesses(&self, bodies: BodySettings, shapes: &[Body]) -> Result<(Vec<f64>, usize), CalibrationError> {
        let of = PerGear::try_in_parallel(|gear| self.pitch_compliances(gear, bodies, shapes))?;
        let sums = of.pinion.0.iter().zip(&of.wheel.0).map(|(pinion, wheel)| 1e-3 / (pinion + wheel));
        Ok((sums.collect(), of.pinion.1 + of.wheel.1))
    }

    /// Stiffness of the pair at the pitch point with `bodies`, N/(mm·µm), and the degrees of freedom of both gears, unless `known`.
    fn pitch_stiffness(&self, bodies: BodySettings, known: &WholeRings) -> Result<(f64, usize), CalibrationError> {
        if bodies == known.bodies {
            return Ok((known.pair_n_per_mm_um, known.dofs));
        }
        let (stiffness, dofs) = self.pitch_stiffnesses(bodies, &[bodies.body])?;
        Ok((stiffness[0], dofs))
    }

    /// Radius at which the body of a gear is held `depth_modules` below its root circle; none where it has no body there.
    fn clamp_radius_mm(&self, gear: Gear, depth_modules: f64) -> Option<f64> {
        let module_mm = self.pair.spec.normal_module_mm;
        let root_mm = self.pair.teeth[gear].root_radius_mm;
        let radius_mm = root_mm - depth_modules * module_mm;
        let bore_mm = self.pair.spec.gears[gear].bore_diameter_mm.map_or(0.0, |diameter| 0.5 * diameter);
        let least_mm = if root_mm < 0.0 { f64::NEG_INFINITY } else { bore_mm.max(LEAST_CLAMP_OVER_ROOT * root_mm) };
        (least_mm..=greatest_clamp_mm(root_mm, module_mm)).contains(&radius_mm).then_some(radius_mm)
    }

    fn coarse(&self) -> BodySettings {
        BodySettings { elements_per_half_width: TABLE_ELEMENTS_PER_HALF_WIDTH, ..self.bodies }
    }

    /// Stiffness of whole rings, which the other tables have in common, and of sectors.
    pub fn neighbours(&self) -> Result<(Vec<NeighbourRow>, WholeRings), CalibrationError> {
        let least = self.pair.teeth.as_ref().map(|tooth| tooth.teeth);
        let least = least.pinion.min(least.wheel);
        let sectors: Vec<(Body, String)> = SECTORS
            .into_iter()
            .filter(|&teeth| teeth <= least)
            .flat_map(|teeth| {
                let plural = if teeth == 1 { "tooth" } else { "teeth" };
                [(SectorSides::Free, "free"), (SectorSides::Clamped, "clamped")]
                    .map(|(sides, how)| (Body::Sector { teeth, sides }, format!("{teeth} {plural}, sides {how}")))
            })
            .collect();
        let bodies = BodySettings { body: Body::Ring, ..self.coarse() };
        let shapes: Vec<Body> = sectors.iter().map(|&(body, _)| body).collect();
        // Pins hold a ring, and no sector.
        let (mut stiffness, dofs) = match self.bodies.rim_pins {
            None => self.pitch_stiffnesses(bodies, &[&[Body::Ring], &shapes[..]].concat())?,
            Some(_) => self.pitch_stiffnesses(bodies, &[Body::Ring])?,
        };
        if let (Some(_), Some(&most)) = (self.bodies.rim_pins, shapes.last()) {
            stiffness.extend(self.pitch_stiffnesses(BodySettings { body: most, ..bodies }, &shapes)?.0);
        }
        let names = ["whole ring".to_owned()].into_iter().chain(sectors.into_iter().map(|(_, name)| name));
        let whole_rings = WholeRings { bodies, pair_n_per_mm_um: stiffness[0], dofs };
        let rows = names.zip(stiffness).map(|(body, pair_n_per_mm_um)| NeighbourRow { body, pair_n_per_mm_um });
        Ok((rows.collect(), whole_rings))
    }

    /// Stiffness on finer and finer meshes; `known` is one of them.
    pub fn convergence(&self, known: &WholeRings) -> Result<Vec<ResolutionRow>, CalibrationError> {
        RESOLUTIONS
            .par_iter()
            .map(|&elements_per_half_width| {
                let bodies = BodySettings { elements_per_half_width, ..self.bodies };
                let (pair_n_per_mm_um, dofs) = self.pitch_stiffness(bodies, known)?;
                Ok(ResolutionRow { elements_per_half_width, dofs, pair_n_per_mm_um })
            })
            .collect()
    }

    /// Stiffness of thinner and thicker rims, as far as both gears have bodies for them; `known` may be one of them.
    pub fn rim_depths(&self, known: &WholeRings) -> Result<Vec<RimRow>, CalibrationError> {
        let rims: Vec<(f64, PerGear<f64>)> = RIM_MODULES
            .into_iter()
            .filter_map(|modules| {
                let [pinion, wheel] = Gear::BOTH.map(|gear| self.clamp_radius_mm(gear, modules));
                Some((modules, PerGear { pinion: pinion?, wheel: wheel? }))
            })
            .collect();
        rims.par_iter()
            .map(|&(depth_modules, clamp_radius_mm)| {
                let bodies = BodySettings { clamp_radius_mm, ..self.coarse() };
                let (pair_n_per_mm_um, _) = self.pitch_stiffness(bodies, known)?;
                Ok(RimRow { depth_modules, clamp_radius_mm: clamp_radius_mm.map(f64::abs), pair_n_per_mm_um })
            })
            .collect()
    }
}
