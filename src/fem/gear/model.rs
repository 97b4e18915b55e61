//! From a gear pair to its condensed finite-element model, in two steps: mesh, condense.

use super::flank_surface::FlankSurface;
use super::position::{CondensedPair, OUTSIDE_BASE_PITCHES};
use super::ring::{GearCompliance, Surroundings};
use super::sector::{CondensedSector, Functional, Sector};
use crate::fem::active_set::ActiveSetError;
use crate::fem::elastic::{Analysis, Elastic};
use crate::fem::equilibrium::SolveError;
use crate::fem::solid::{Element, ElementKind, Solid};
use crate::fem::stress::{StressComponent, StressRecovery};
use crate::gear::{Gear, GearPair, PerGear};
use crate::mesh::CellKind;
use crate::mesh::tooth::{self, FlankResolution, SectorSettings, ToothMeshError, ToothSector, ToothShape};
use crate::reference::hertz_line::HertzLine;

/// Elements along each fillet of a fine tooth.
const FILLET_ELEMENTS: u32 = 24;
/// Half-widths of flank resolved below the start of active profile.
const MARGIN_HALF_WIDTHS: f64 = 3.0;
/// Depth of the structured elements below the flank, in half-widths.
const DEPTH_HALF_WIDTHS: f64 = 1.0;

/// How much of each gear is modelled, and how finely.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModelSettings {
    /// Which teeth beside those that touch.
    pub body: Body,
    /// Where each body is held or turned rigidly, mm.
    pub clamp_radius_mm: PerGear<f64>,
    /// Elements per Hertz half-width of the whole load at each place of the flank.
    pub elements_per_half_width: f64,
}

/// Which part of each gear is modelled.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Body {
    /// The whole gear.
    Ring,
    /// This many teeth.
    Sector {
        /// Odd number, at least those that touch.
        teeth: u32,
        /// Whether the sides are held.
        clamped_sides: bool,
    },
}

/// Why there is no model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// A tooth cannot be meshed.
    #[error("{}: {source}", gear.name())]
    Mesh {
        /// Whose.
        gear: Gear,
        /// Why.
        source: ToothMeshError,
    },
    /// A gear cannot be condensed.
    #[error("{}: {source}", gear.name())]
    Condense {
        /// Whose.
        gear: Gear,
        /// Why.
        source: SolveError,
    },
    /// The sector is too small.
    #[error("{}: {teeth} teeth are fewer than the {least} that touch over the mesh cycle", gear.name())]
    TooFewTeeth {
        /// Whose.
        gear: Gear,
        /// Given.
        teeth: u32,
        /// Needed.
        least: u32,
    },
}

/// One gear, meshed.
#[derive(Debug, Clone)]
pub struct MeshedGear {
    /// Which.
    pub gear: Gear,
    /// A tooth that may touch.
    pub fine: ToothSector,
    /// Any other tooth; none where all are fine.
    pub coarse: Option<ToothSector>,
    /// How many teeth may touch.
    pub fine_teeth: u32,
    /// What surrounds them.
    pub surroundings: Surroundings,
    /// Whether the tip edge is sharp.
    pub sharp: bool,
}

/// Teeth of each gear that touch at some position from A to E: the reference one and as many on either side as the
/// contact ratio and contact outside the line of action ask for.
pub fn touching_teeth(pair: &GearPair) -> u32 {
    1 + 2 * (pair.path.contact_ratio() + OUTSIDE_BASE_PITCHES).floor() as u32
}

/// Contact modulus E*, MPa.
fn contact_modulus_mpa(material: &PerGear<Elastic>) -> f64 {
    1.0 / material.map(|m| (1.0 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus_mpa).sum()
}

/// Hertz half-width under the whole load at `position_mm`, taken at A or E where it lies outside.
pub fn hertz_half_width_mm(
    pair: &GearPair,
    contact_modulus_mpa: f64,
    line_load_n_per_mm: f64,
    position_mm: f64,
) -> f64 {
    let position_mm = position_mm.clamp(pair.path.start_mm, pair.path.end_mm);
    let rho = PerGear::from_fn(|gear| pair.path.rho_mm(gear, position_mm));
    let relative_radius_mm = rho.pinion * rho.wheel / rho.sum();
    HertzLine::of_relative_radius(relative_radius_mm, contact_modulus_mpa).loaded(line_load_n_per_mm).half_width_mm
}

impl MeshedGear {
    /// Meshes a gear of `pair` for contact under `line_load_n_per_mm`.
    ///
    /// # Errors
    /// [`ModelError::Mesh`], [`ModelError::TooFewTeeth`].
    pub fn new(
        pair: &GearPair,
        gear: Gear,
        material: &PerGear<Elastic>,
        line_load_n_per_mm: f64,
        settings: &ModelSettings,
    ) -> Result<Self, ModelError> {
        let teeth = pair.teeth[gear].teeth;
        let fine_teeth = touching_teeth(pair).min(teeth - 1 + teeth % 2);
        let surroundings = match settings.body {
            Body::Ring => Surroundings::Ring { coarse: (teeth - fine_teeth) as usize },
            Body::Sector { teeth, .. } if teeth < fine_teeth => {
                return Err(ModelError::TooFewTeeth { gear, teeth, least: fine_teeth });
            }
            Body::Sector { teeth, clamped_sides } => {
                let coarse = ((teeth - fine_teeth) / 2) as usize;
                if clamped_sides { Surroundings::ClampedSector { coarse } } else { Surroundings::FreeSector { coarse } }
            }
        };
        let shape = ToothShape::of(pair, gear);
        // ρ1 + ρ2 = T1T2 reads the same both ways.
        let contact_modulus_mpa = contact_modulus_mpa(material);
        let half_width_mm =
            |rho: f64| hertz_half_width_mm(pair, contact_modulus_mpa, line_load_n_per_mm, pair.path.rho_mm(gear, rho));
        let fine = SectorSettings {
            clamp_radius_mm: settings.clamp_radius_mm[gear],
            fillet_elements: FILLET_ELEMENTS,
            flank: Some(FlankResolution {
                half_width_mm: &half_width_mm,
                elements_per_half_width: settings.elements_per_half_width,
                margin_half_widths: MARGIN_HALF_WIDTHS,
                depth_half_widths: DEPTH_HALF_WIDTHS,
            }),
        };
        let mesh = |settings: &SectorSettings<'_>| {
            tooth::sector(&shape, settings).map_err(|source| ModelError::Mesh { gear, source })
        };
        let coarse = match surroundings.coarse() {
            0 => None,
            _ => Some(mesh(&SectorSettings { flank: None, ..fine })?),
        };
        Ok(Self {
            gear,
            fine: mesh(&fine)?,
            coarse,
            fine_teeth,
            surroundings,
            sharp: pair.spec.gears[gear].modification.tip_rounding_mm == 0.0,
        })
    }

    /// Degrees of freedom of the whole gear as modelled.
    pub fn dofs(&self) -> usize {
        let rows = if matches!(self.surroundings, Surroundings::Ring { .. }) { 1 } else { 2 };
        let coarse = rows * self.surroundings.coarse();
        let own = |sector: &ToothSector| sector.dofs() - 2 * sector.left_cut.len();
        self.fine_teeth as usize * own(&self.fine) + coarse * self.coarse.as_ref().map_or(0, own)
    }

    /// Nodes of both fillets, the working side's first.
    fn fillets(&self) -> [&[u32]; 2] {
        [&self.fine.working_fillet, &self.fine.back_fillet]
    }

    /// The stress along the surface at each node of both fillets, σ_t = t · σ t.
    fn fillet_probes(&self, solid: &Solid, material: Elastic) -> Result<Vec<Functional>, SolveError> {
        let materials = [material];
        let recovery = StressRecovery::new(solid, &materials, Analysis::PlaneStrain)?;
        let mut probes = Vec::new();
        for fillet in self.fillets() {
            for (k, &node) in fillet.iter().enumerate() {
                let at = |k: usize| solid.points_mm[fillet[k] as usize];
                let t = (at((k + 1).min(fillet.len() - 1)) - at(k.saturating_sub(1))).normalize();
                let mut probe = Functional::new();
                for (component, factor) in [
                    (StressComponent::X, t.x * t.x),
                    (StressComponent::Y, t.y * t.y),
                    (StressComponent::Xy, 2.0 * t.x * t.y),
                ] {
                    let row = recovery.nodal_stress_row(node, 0, component)?;
                    probe.extend(row.into_iter().map(|(dof, value)| (dof, factor * value)));
                }
                probes.push(probe);
            }
        }
        Ok(probes)
    }

    /// Condenses the gear onto the nodes of its working flanks.
    ///
    /// # Errors
    /// [`ModelError::Condense`].
    pub fn condense(&self, pair: &GearPair, material: Elastic) -> Result<(GearCompliance, FlankSurface), ModelError> {
        let failed = |source: SolveError| ModelError::Condense { gear: self.gear, source };
        let half_angle_rad = std::f64::consts::PI / f64::from(pair.teeth[self.gear].teeth);
        let (chain, rho_mm) = self.fine.working_flank.resolved_nodes();
        let flank = FlankSurface::new(chain, rho_mm, &self.fine.points_mm, self.sharp);
        let mut fine = sector(&self.fine, half_angle_rad, flank.surface.mesh_nodes.clone());
        fine.probes = self.fillet_probes(&fine.solid, material).map_err(failed)?;
        fine.working_side_probes = self.fine.working_fillet.len();
        let fine = condense(fine, material).map_err(failed)?;
        let coarse = match &self.coarse {
            Some(coarse) => Some(condense(sector(coarse, half_angle_rad, Vec::new()), material).map_err(failed)?),
            None => None,
        };
        let joined = GearCompliance::new(fine, coarse.as_ref(), self.fine_teeth as usize, self.surroundings);
        Ok((joined.map_err(|error: ActiveSetError| failed(error.into()))?, flank))
    }
}

fn condense(sector: Sector, material: Elastic) -> Result<CondensedSector, SolveError> {
    sector.condense(material, Analysis::PlaneStrain)
}

/// The finite-element form of a meshed sector.
fn sector(mesh: &ToothSector, half_angle_rad: f64, candidates: Vec<u32>) -> Sector {
    let clamped: std::collections::BTreeSet<u32> = mesh.clamp.iter().copied().collect();
    let free = |cut: &[u32]| cut.iter().copied().filter(|node| !clamped.contains(node)).collect::<Vec<u32>>();
    Sector {
        solid: solid(mesh),
        clamp: mesh.clamp.clone(),
        cuts: [free(&mesh.right_cut), free(&mesh.left_cut)],
        half_angle_rad,
        candidates,
        probes: Vec::new(),
        working_side_probes: 0,
    }
}

/// A sector's elements for the solver.
pub fn solid(mesh: &ToothSector) -> Solid {
    let kind = |kind: CellKind| if kind == CellKind::Quad8 { ElementKind::Quad8 } else { ElementKind::Triangle6 };
    Solid {
        points_mm: mesh.points_mm.clone(),
        elements: mesh.cells.iter().map(|cell| Element::new(kind(cell.kind), cell.nodes(), 0)).collect(),
    }
}

impl<'a> CondensedPair<'a> {
    /// Joins both condensed gears.
    pub fn new(
        pair: &'a GearPair,
        material: &PerGear<Elastic>,
        gears: PerGear<(GearCompliance, FlankSurface)>,
    ) -> Self {
        let (pinion, pinion_flank) = gears.pinion;
        let (wheel, wheel_flank) = gears.wheel;
        Self {
            pair,
            contact_modulus_mpa: contact_modulus_mpa(material),
            gears: PerGear { pinion, wheel },
            flanks: PerGear { pinion: pinion_flank, wheel: wheel_flank },
        }
    }
}
