//! Condensed finite-element model of a gear pair: the gears are meshed, then condensed.

use std::sync::Arc;

use super::condensed_pair::{CondensedPair, hertz_half_width_mm};
use super::flank_surface::MeshedFlank;
use super::ring::{GearCompliance, Surroundings};
use super::sector::{CondensedSector, Functional, Sector};
use crate::gear::{Gear, GearPair, PerGear};
use crate::gear_mesh::settings::{Body, BodySettings, SectorSides};
use crate::gear_mesh::{FlankChain, ToothElement, ToothMeshError, ToothSector, gear_sector, touching_pairs};
use crate::material::contact_modulus_mpa;
use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::equilibrium::SolveError;
use gearwear_fem::solid::{Element, ElementKind, Solid};
use gearwear_fem::stress::{StressComponent, StressRecovery};
use gearwear_mesh::CellKind;

/// Greatest number of nodes of one flank; their compliance takes [`GB_OF_MOST_NODES`].
const MOST_FLANK_NODES: usize = 3000;
/// Memory of one gear with the most nodes, GB, quadratic in the number of nodes. Measured on FZG type C with 10 and 14 elements in a half-width and
/// tip roundings of 0.01 and 0.1 mm, and on the pair of the thesis with 24 and 36, both gears together 0.37 to 0.95 GB: within 15 %.
const GB_OF_MOST_NODES: f64 = 0.7;
/// Memory of a condensed sector beside the compliance of its flank, GB per degree of freedom: a sweep of FZG type C that may keep 0.3 GB of them takes 0.32 GB
/// more than one that keeps none.
const GB_OF_A_DOF: f64 = 8e-7;
/// Memory above which a condensation is announced, GB.
const MUCH_MEMORY_GB: f64 = 0.8;
/// Memory above which a condensation is refused, GB: both gears with the most nodes.
const MOST_MEMORY_GB: f64 = 2.0 * GB_OF_MOST_NODES;

/// Arc of flank on either side of a known load whose elements are as short as under it, in half-widths.
const LOAD_REACHES_HALF_WIDTHS: f64 = 3.0;
/// Growth of the resolved half-width with the arc from there: slow enough for the layer of quadrilaterals.
const GROWTH_FROM_LOAD: f64 = 0.3;
/// Refinement of tip roundings that nothing touches.
const UNTOUCHED_ROUNDING: f64 = 0.05;

/// Reason why there is no model.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ModelError {
    /// A tooth cannot be meshed.
    #[error("{}: {source}", gear.name())]
    Mesh {
        /// Gear.
        gear: Gear,
        /// Reason.
        source: Box<ToothMeshError>,
    },
    /// A gear cannot be condensed.
    #[error("{}: {source}", gear.name())]
    Condense {
        /// Gear.
        gear: Gear,
        /// Reason.
        source: SolveError,
    },
    /// The compliance of the flanks needs too much memory.
    #[error(
        "{}: the working flank has {nodes} nodes, more than the {most} whose compliance memory is allowed for; fewer fem.elements_per_half_width or a \
         larger tip_rounding_mm give fewer nodes",
        gear.name()
    )]
    TooFine {
        /// Gear.
        gear: Gear,
        /// Number of nodes of one flank.
        nodes: usize,
        /// Greatest number.
        most: usize,
    },
    /// The sector has too few teeth.
    #[error("{}: a sector of {teeth} teeth has fewer than the {least} that touch over the mesh cycle; give at least {least}", gear.name())]
    TooFewTeeth {
        /// Gear.
        gear: Gear,
        /// Given number of teeth.
        teeth: u32,
        /// Least number of teeth.
        least: u32,
    },
}

/// Announcement before both gears are condensed, where that takes much memory; `bodies`: peak memory over that of one pair.
///
/// # Errors
/// [`ModelError::TooFine`] above the memory allowed for.
pub fn much_memory(meshed: &PerGear<MeshedGear>, bodies: f64) -> Result<Option<String>, ModelError> {
    let nodes = meshed.as_ref().map(|meshed| meshed.flank().surface.mesh_nodes.len());
    let share = nodes.map(|nodes| (nodes as f64 / MOST_FLANK_NODES as f64).powi(2));
    let gb = bodies * GB_OF_MOST_NODES * share.sum();
    if gb > MOST_MEMORY_GB {
        let gear = if nodes.pinion > nodes.wheel { Gear::Pinion } else { Gear::Wheel };
        let most = (MOST_FLANK_NODES as f64 * bodies.recip().sqrt()) as usize;
        return Err(ModelError::TooFine { gear, nodes: nodes[gear], most });
    }
    Ok((gb > MUCH_MEMORY_GB).then(|| {
        format!(
            "the working flanks have {} nodes (pinion) and {} (wheel): their condensation takes some {gb:.1} GB; fewer \
             fem.elements_per_half_width or a larger tip_rounding_mm takes less",
            nodes.pinion, nodes.wheel
        )
    }))
}

/// Meshed sectors of one gear.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshedGear {
    /// Pinion or wheel.
    pub gear: Gear,
    /// Sector of a tooth that may touch.
    pub fine: ToothSector,
    /// Sector of any other tooth; `None` where all are fine.
    pub coarse: Option<ToothSector>,
    /// Number of fine teeth.
    pub fine_teeth: u32,
    /// Surroundings of the fine teeth.
    pub surroundings: Surroundings,
    /// Whether the tip edge is sharp.
    pub sharp: bool,
    /// Settings of the mesh.
    pub settings: BodySettings,
}

impl MeshedGear {
    /// Meshes a gear of `pair` for contact under `line_load_n_per_mm`.
    pub fn new(
        pair: &GearPair,
        gear: Gear,
        material: &PerGear<Elastic>,
        line_load_n_per_mm: f64,
        settings: &BodySettings,
    ) -> Result<Self, ModelError> {
        let teeth = pair.teeth[gear].teeth;
        let reach_mm = pair.ample_tip_reach_mm(line_load_n_per_mm, contact_modulus_mpa(*material));
        let fine_teeth = (touching_pairs(pair, reach_mm).len() as u32).min(teeth - 1 + teeth % 2);
        let contact_modulus_mpa = contact_modulus_mpa(*material);
        let half_width_mm =
            |position_mm: f64| hertz_half_width_mm(pair, contact_modulus_mpa, line_load_n_per_mm, position_mm);
        Self::with_fine_teeth(fine_teeth, pair, gear, &half_width_mm, settings)
    }

    /// Meshes a gear of which only the middle tooth is loaded, at `position_mm` alone: away from there the elements grow.
    pub fn loaded_at(
        position_mm: f64,
        pair: &GearPair,
        gear: Gear,
        material: &PerGear<Elastic>,
        line_load_n_per_mm: f64,
        settings: &BodySettings,
    ) -> Result<Self, ModelError> {
        let contact_modulus_mpa = contact_modulus_mpa(*material);
        let hertz_mm =
            |position_mm: f64| hertz_half_width_mm(pair, contact_modulus_mpa, line_load_n_per_mm, position_mm);
        let arc_mm = |position_mm: f64| pair.path.involute[gear].arc_mm(pair.path.rho_mm(gear, position_mm));
        let (loaded_mm, at_mm) = (hertz_mm(position_mm), arc_mm(position_mm));
        let half_width_mm = |position_mm: f64| {
            let away_mm = (arc_mm(position_mm) - at_mm).abs() - LOAD_REACHES_HALF_WIDTHS * loaded_mm;
            hertz_mm(position_mm).max(loaded_mm + GROWTH_FROM_LOAD * away_mm.max(0.0))
        };
        let settings = BodySettings { rounding_refinement: UNTOUCHED_ROUNDING, ..*settings };
        Self::with_fine_teeth(1, pair, gear, &half_width_mm, &settings)
    }

    /// Meshes a gear with `fine_teeth` of which the flanks resolve the half-widths of contact `half_width_mm` by position.
    fn with_fine_teeth(
        fine_teeth: u32,
        pair: &GearPair,
        gear: Gear,
        half_width_mm: &dyn Fn(f64) -> f64,
        settings: &BodySettings,
    ) -> Result<Self, ModelError> {
        let surroundings = surroundings(fine_teeth, pair, gear, settings)?;
        let failed = |source| ModelError::Mesh { gear, source: Box::new(source) };
        let fine = gear_sector(pair, gear, true, settings, half_width_mm).map_err(failed)?;
        let coarse = (surroundings.coarse() > 0).then(|| gear_sector(pair, gear, false, settings, half_width_mm));
        Ok(Self {
            gear,
            fine,
            coarse: coarse.transpose().map_err(failed)?,
            fine_teeth,
            surroundings,
            sharp: pair.spec.is_tip_sharp(gear),
            settings: *settings,
        })
    }

    /// Degrees of freedom of the whole gear as modelled.
    pub fn dofs(&self) -> usize {
        let rows = match self.surroundings {
            Surroundings::Ring { .. } | Surroundings::PinnedRing { .. } => 1,
            Surroundings::FreeSector { .. } | Surroundings::ClampedSector { .. } => 2,
        };
        let coarse = rows * self.surroundings.coarse();
        self.fine_teeth as usize * dofs_without_cut(&self.fine)
            + coarse * self.coarse.as_ref().map_or(0, dofs_without_cut)
    }

    /// Memory that the condensed gear takes, GB: that of the compliance of its flank, 8 bytes an entry, and of its sector.
    pub fn condensed_gb(&self) -> f64 {
        let flank = 2.0 * self.fine.working_flank.nodes.len() as f64;
        8e-9 * flank * flank + GB_OF_A_DOF * self.fine.dofs() as f64
    }

    /// Stress along the surface at each node of both fillets, the working side's first, σ_t = t · σ t.
    fn fillet_probes(&self, solid: &Solid, material: Elastic) -> Result<Vec<Functional>, SolveError> {
        let materials = [material];
        let recovery = StressRecovery::new(solid, &materials, Analysis::PlaneStrain)?;
        let mut probes = Vec::new();
        for fillet in [&self.fine.working_fillet, &self.fine.back_fillet] {
            for (k, &node) in fillet.iter().enumerate() {
                let [before, after] = [k.saturating_sub(1), (k + 1).min(fillet.len() - 1)];
                let t =
                    (solid.points_mm[fillet[after] as usize] - solid.points_mm[fillet[before] as usize]).normalize();
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

    /// Condenses the gear onto the nodes of its working flanks, with the stresses at its fillets.
    pub fn condense(&self, pair: &GearPair, material: Elastic) -> Result<(GearCompliance, MeshedFlank), ModelError> {
        self.condense_with(pair, material, true)
    }

    /// As [`Self::condense`], without stresses.
    pub fn condense_without_stresses(
        &self,
        pair: &GearPair,
        material: Elastic,
    ) -> Result<(GearCompliance, MeshedFlank), ModelError> {
        self.condense_with(pair, material, false)
    }

    fn condense_with(
        &self,
        pair: &GearPair,
        material: Elastic,
        stresses: bool,
    ) -> Result<(GearCompliance, MeshedFlank), ModelError> {
        let flank = self.flank();
        let nodes = flank.surface.mesh_nodes.len();
        if nodes > MOST_FLANK_NODES {
            return Err(ModelError::TooFine { gear: self.gear, nodes, most: MOST_FLANK_NODES });
        }
        let mut fine = self.sector(pair, &self.fine, flank.surface.mesh_nodes.clone());
        if stresses {
            fine.probes = self.fillet_probes(&fine.solid, material).map_err(|source| self.failed(source))?;
            fine.working_side_probes = self.fine.working_fillet.len();
        }
        let (fine, coarse) = self.condensed_sectors(fine, self.coarse_sector(pair), material)?;
        Ok((self.joined(fine, coarse.as_ref(), self.surroundings)?, flank))
    }

    /// Condenses the gear onto `nodes` of its working flank alone, without stresses, for known loads: once for all `bodies`, which are held
    /// alike and have no more teeth than the gear was meshed with.
    pub fn condense_onto(
        &self,
        pair: &GearPair,
        material: Elastic,
        nodes: Vec<u32>,
        bodies: &[Body],
    ) -> Result<Vec<GearCompliance>, ModelError> {
        let (fine, coarse) =
            self.condensed_sectors(self.sector(pair, &self.fine, nodes), self.coarse_sector(pair), material)?;
        let fine = Arc::new(fine);
        let of_body = |&body: &Body| {
            let settings = BodySettings { body, ..self.settings };
            let surroundings = surroundings(self.fine_teeth, pair, self.gear, &settings)?;
            self.joined(fine.clone(), coarse.as_ref(), surroundings)
        };
        bodies.iter().map(of_body).collect()
    }

    /// Working flank as a contact surface, down to the end of the involute: the part below the resolved one touches a deeply worn mate.
    pub fn flank(&self) -> MeshedFlank {
        let FlankChain { nodes, rho_mm, .. } = &self.fine.working_flank;
        MeshedFlank::new(nodes, rho_mm, &self.fine.points_mm, self.sharp)
    }

    /// One of the sectors, held below except on pins.
    fn sector(&self, pair: &GearPair, mesh: &ToothSector, candidates: Vec<u32>) -> Sector {
        let is_on_pins = matches!(self.surroundings, Surroundings::PinnedRing { .. });
        let clamp = if is_on_pins { &[] } else { mesh.clamp.as_slice() };
        held_sector(mesh, clamp, half_angle_rad(pair, self.gear), candidates)
    }

    fn coarse_sector(&self, pair: &GearPair) -> Option<Sector> {
        self.coarse.as_ref().map(|coarse| self.sector(pair, coarse, Vec::new()))
    }

    fn condensed_sectors(
        &self,
        fine: Sector,
        coarse: Option<Sector>,
        material: Elastic,
    ) -> Result<(CondensedSector, Option<CondensedSector>), ModelError> {
        let condense =
            |sector: Sector| sector.condense(material, Analysis::PlaneStrain).map_err(|source| self.failed(source));
        Ok((condense(fine)?, coarse.map(condense).transpose()?))
    }

    fn joined(
        &self,
        fine: impl Into<Arc<CondensedSector>>,
        coarse: Option<&CondensedSector>,
        surroundings: Surroundings,
    ) -> Result<GearCompliance, ModelError> {
        GearCompliance::new(fine, coarse, self.fine_teeth as usize, surroundings)
            .map_err(|error| self.failed(error.into()))
    }

    fn failed(&self, source: SolveError) -> ModelError {
        ModelError::Condense { gear: self.gear, source }
    }
}

/// Surroundings of the fine teeth of a gear.
fn surroundings(
    fine_teeth: u32,
    pair: &GearPair,
    gear: Gear,
    settings: &BodySettings,
) -> Result<Surroundings, ModelError> {
    let teeth = pair.teeth[gear].teeth;
    Ok(match settings.body {
        Body::Ring => {
            let coarse = (teeth - fine_teeth) as usize;
            match settings.rim_pins.filter(|_| pair.teeth[gear].is_internal()) {
                Some(pins) => Surroundings::PinnedRing { coarse, pins },
                None => Surroundings::Ring { coarse },
            }
        }
        // A sector of all teeth has no cuts.
        Body::Sector { teeth: all, .. } if all == teeth => Surroundings::Ring { coarse: (teeth - fine_teeth) as usize },
        Body::Sector { teeth, .. } if teeth < fine_teeth => {
            return Err(ModelError::TooFewTeeth { gear, teeth, least: fine_teeth });
        }
        Body::Sector { teeth, sides } => {
            let coarse = ((teeth - fine_teeth) / 2) as usize;
            match sides {
                SectorSides::Free => Surroundings::FreeSector { coarse },
                SectorSides::Clamped => Surroundings::ClampedSector { coarse },
            }
        }
    })
}

/// Degrees of freedom of a sector without those of one cut, which it shares with its neighbour.
fn dofs_without_cut(sector: &ToothSector) -> usize {
    sector.dofs() - 2 * sector.left_cut.len()
}

/// Half a pitch of a gear, negative of an internal one.
fn half_angle_rad(pair: &GearPair, gear: Gear) -> f64 {
    std::f64::consts::PI / pair.teeth[gear].z()
}

/// Finite-element model of a meshed sector held at its clamp circle; forces may act on the nodes `candidates`.
pub fn sector(mesh: &ToothSector, half_angle_rad: f64, candidates: Vec<u32>) -> Sector {
    held_sector(mesh, &mesh.clamp, half_angle_rad, candidates)
}

/// Sector held at the nodes `clamp`.
fn held_sector(mesh: &ToothSector, clamp: &[u32], half_angle_rad: f64, candidates: Vec<u32>) -> Sector {
    let clamped: std::collections::BTreeSet<u32> = clamp.iter().copied().collect();
    let cuts = [&mesh.right_cut, &mesh.left_cut];
    Sector {
        solid: solid(mesh),
        clamp: clamp.to_vec(),
        cuts: cuts.map(|cut| cut.iter().copied().filter(|node| !clamped.contains(node)).collect()),
        half_angle_rad,
        candidates,
        probes: Vec::new(),
        working_side_probes: 0,
    }
}

/// Nodes and elements of a sector.
pub fn solid(mesh: &ToothSector) -> Solid {
    Solid {
        points_mm: mesh.points_mm.clone(),
        elements: mesh.cells.iter().map(|cell| element(cell, cell.nodes(), 0)).collect(),
    }
}

/// Finite element of a cell on `nodes`.
pub fn element(cell: &ToothElement, nodes: &[u32], material: u16) -> Element {
    let kind = if cell.kind == CellKind::Quad8 { ElementKind::Quad8 } else { ElementKind::Triangle6 };
    Element::new(kind, nodes, material)
}

impl<'a> CondensedPair<'a> {
    /// Meshes and condenses both gears of `pair` for contact under `line_load_n_per_mm`, in parallel, without stresses. Much memory is
    /// announced before.
    pub fn build(
        pair: &'a GearPair,
        material: &PerGear<Elastic>,
        line_load_n_per_mm: f64,
        settings: &BodySettings,
        announce: &dyn Fn(&str),
    ) -> Result<Self, ModelError> {
        let condense = |meshed: &MeshedGear, own: Elastic| meshed.condense_without_stresses(pair, own);
        Self::build_by(condense, pair, material, line_load_n_per_mm, settings, announce)
    }

    /// As [`Self::build`], with what `condense` makes of a meshed gear and its material ([`MeshedGear::condense_without_stresses`]).
    ///
    /// # Errors
    /// Those of the meshes and of `condense`.
    pub fn build_by(
        condense: impl Fn(&MeshedGear, Elastic) -> Result<(GearCompliance, MeshedFlank), ModelError> + Sync,
        pair: &'a GearPair,
        material: &PerGear<Elastic>,
        line_load_n_per_mm: f64,
        settings: &BodySettings,
        announce: &dyn Fn(&str),
    ) -> Result<Self, ModelError> {
        let meshed =
            PerGear::try_in_parallel(|gear| MeshedGear::new(pair, gear, material, line_load_n_per_mm, settings))?;
        if let Some(much) = much_memory(&meshed, 1.0)? {
            announce(&much);
        }
        let gears = PerGear::try_in_parallel(|gear| condense(&meshed[gear], material[gear]))?;
        Ok(Self::new(pair, material, gears))
    }

    /// Joins both condensed gears.
    pub fn new(pair: &'a GearPair, material: &PerGear<Elastic>, gears: PerGear<(GearCompliance, MeshedFlank)>) -> Self {
        let (pinion, pinion_flank) = gears.pinion;
        let (wheel, wheel_flank) = gears.wheel;
        Self {
            pair,
            contact_modulus_mpa: contact_modulus_mpa(*material),
            gears: PerGear { pinion, wheel },
            flanks: PerGear { pinion: pinion_flank, wheel: wheel_flank },
        }
    }
}
