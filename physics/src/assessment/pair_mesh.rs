//! The finite-element mesh of a scene's gear pair.

use super::RunError;
use crate::contact::hertz;
use crate::mesh_cycle::pair_in_space::PairInSpaceError;
use crate::operation::Scene;
use gearwear_bodies::gear::{Gear, GearPair, PairError, PerGear};
use gearwear_bodies::gear_mesh::settings::{Body, SpaceResolution};
use gearwear_bodies::gear_mesh::tooth_section::ExtrudedTooth;
use gearwear_bodies::gear_mesh::{self, ToothMeshError};
use gearwear_bodies::material::{Material, contact_modulus_mpa};
use gearwear_mesh::quality::{self, MeshQuality, QualityError};
use gearwear_mesh::{CellKind, Mesh};

/// Mesh of a pair with its resolution.
#[derive(Debug, Clone, PartialEq)]
pub struct PairMesh {
    /// The mesh, see [`mod@gear_mesh::pair_mesh`].
    pub mesh: Mesh,
    /// Quality of its cells.
    pub quality: MeshQuality,
    /// Where the reference pair touches: radius of curvature of the pinion, mm.
    pub position_mm: f64,
    /// Hertz's half-width at the pitch point under the whole load, mm.
    pub half_width_mm: f64,
    /// Length of the flank's elements at the pitch point, mm.
    pub element_mm: f64,
    /// Degrees of freedom of one resolved tooth's sector.
    pub fine_dofs: PerGear<usize>,
    /// Degrees of freedom of a sector that is not resolved.
    pub coarse_dofs: PerGear<usize>,
    /// Resolved teeth.
    pub fine_teeth: Vec<i32>,
}

/// Failure of a mesh.
#[derive(Debug, thiserror::Error)]
pub enum PairMeshError {
    /// The pair cannot exist.
    #[error(transparent)]
    Pair(#[from] PairError),
    /// The reference pair does not touch there.
    #[error("position {position_mm} mm is not on the path of contact: allowed are {from_mm:.4} (A) to {to_mm:.4} (E)")]
    Position {
        /// Position asked for.
        position_mm: f64,
        /// Position of A.
        from_mm: f64,
        /// Position of E.
        to_mm: f64,
    },
    /// A tooth cannot be meshed.
    #[error(transparent)]
    Tooth(#[from] ToothMeshError),
    /// The mesh has unfit cells.
    #[error("{source}")]
    Quality {
        /// Gear of the mesh, where each has its own.
        gear: Option<Gear>,
        /// Fault of the mesh.
        source: QualityError,
    },
    /// The equilibrium that loads the teeth, or what it is made with.
    #[error(transparent)]
    Run(#[from] RunError),
}

impl From<PairInSpaceError> for PairMeshError {
    fn from(error: PairInSpaceError) -> Self {
        PairMeshError::Run(error.into())
    }
}

/// One pitch of each gear in space, as [`gear_mesh::space_mesh`] places it.
#[derive(Debug, Clone, PartialEq)]
pub struct SpaceMesh {
    /// The mesh.
    pub mesh: Mesh,
    /// Quality of the quadrilaterals of both sections.
    pub quality: PerGear<MeshQuality>,
    /// Elements over the face width.
    pub layers: usize,
    /// Where the reference pair touches in the middle of the face width: radius of curvature of the pinion, mm.
    pub position_mm: f64,
}

/// Meshes one pitch of each gear of `scene` in space, the reference teeth in contact at `position_mm`, by default at the pitch point.
pub fn in_space(scene: &Scene, position_mm: Option<f64>) -> Result<SpaceMesh, PairMeshError> {
    let pair = GearPair::new(&scene.pair)?;
    let position_mm = on_path_mm(&pair, position_mm)?;
    in_space_at(scene, &pair, position_mm)
}

/// Meshes one pitch of each gear of `pair` in space at a position on the path of contact or beyond.
pub(super) fn in_space_at(scene: &Scene, pair: &GearPair, position_mm: f64) -> Result<SpaceMesh, PairMeshError> {
    let resolution = SpaceResolution { slices: scene.slices.map(|slices| slices.count), ..SpaceResolution::USUAL };
    let bodies = scene.fem.in_space();
    let teeth = PerGear::from_fn(|gear| ExtrudedTooth::of_gear(pair, gear, &bodies, &resolution));
    let quality = |gear: Gear| {
        let section = teeth[gear].section.to_mesh();
        quality::of_mesh(&section).map_err(|source| PairMeshError::Quality { gear: Some(gear), source })
    };
    Ok(SpaceMesh {
        mesh: gear_mesh::space_mesh(pair, &teeth, position_mm),
        quality: PerGear { pinion: quality(Gear::Pinion)?, wheel: quality(Gear::Wheel)? },
        layers: teeth.pinion.layers(),
        position_mm,
    })
}

/// A position as given, which must be on the path of contact; the pitch point where none is.
pub(super) fn on_path_mm(pair: &GearPair, position_mm: Option<f64>) -> Result<f64, PairMeshError> {
    let [from_mm, to_mm] = [pair.path.start_mm, pair.path.end_mm];
    let position_mm = position_mm.unwrap_or_else(|| pair.path.pitch_point_mm.clamp(from_mm, to_mm));
    // Ends are printed with four decimals and may be typed as printed.
    let rounding_mm = 1e-4;
    if position_mm >= from_mm - rounding_mm && position_mm <= to_mm + rounding_mm {
        Ok(position_mm)
    } else {
        Err(PairMeshError::Position { position_mm, from_mm, to_mm })
    }
}

/// Meshes the pair of `scene` in contact at `position_mm`, by default at the pitch point.
pub fn build(scene: &Scene, position_mm: Option<f64>) -> Result<PairMesh, PairMeshError> {
    let pair = GearPair::new(&scene.pair)?;
    let [from_mm, to_mm] = [pair.path.start_mm, pair.path.end_mm];
    let position_mm = on_path_mm(&pair, position_mm)?;
    let line_load_n_per_mm = pair.line_load_n_per_mm(scene.operation.pinion_torque_n_mm);
    let half_width_mm = |position_mm: f64| {
        hertz::flattening(&pair, &scene.material, position_mm).contact.loaded(line_load_n_per_mm).half_width_mm
    };
    let sectors = gear_mesh::pair_sectors(&pair, &scene.fem, &half_width_mm)?;
    let reach_mm =
        pair.ample_tip_reach_mm(line_load_n_per_mm, contact_modulus_mpa(scene.material.map(Material::elastic)));
    let mut fine_teeth = gear_mesh::touching_pairs(&pair, reach_mm);
    if let Body::Sector { teeth, .. } = scene.fem.body {
        fine_teeth.retain(|index| 2 * index.unsigned_abs() < teeth);
    }
    let mesh = gear_mesh::pair_mesh(&pair, &scene.fem, &sectors, &fine_teeth, position_mm)?;
    let quality = quality::of_mesh(&mesh).map_err(|source| PairMeshError::Quality { gear: None, source })?;
    let at_pitch_mm = half_width_mm(pair.path.pitch_point_mm.clamp(from_mm, to_mm));
    Ok(PairMesh {
        mesh,
        quality,
        position_mm,
        half_width_mm: at_pitch_mm,
        element_mm: at_pitch_mm / scene.fem.elements_per_half_width,
        fine_dofs: PerGear::from_fn(|gear: Gear| sectors.fine[gear].dofs()),
        coarse_dofs: PerGear::from_fn(|gear: Gear| sectors.coarse[gear].dofs()),
        fine_teeth,
    })
}

impl PairMesh {
    /// Cells of a kind.
    pub fn count(&self, kind: CellKind) -> usize {
        self.mesh.cells.iter().filter(|block| block.kind == kind).map(|block| block.len()).sum()
    }
}
