//! The reference teeth of a pair in space as they deform under the load of the scene.
//!
//! The load over the face width is that of unworn flanks on elastic half-planes, tip edges followed if the scene does so, with slices
//! coupled by the teeth in space, whatever surface and coupling the scene's own run has. Displacements are those against the clamp
//! circles, and so leave out how the gears turn; stresses are those of the coarse elements of the teeth in space, on which the contact
//! itself is not resolved.

use nalgebra::{Matrix3, Vector3};

use super::pair_mesh::{PairMeshError, SpaceMesh, in_space_at, on_path_mm};
use super::{Resumption, RunInputs, RunModel, UM_PER_MM, prepared};
use crate::contact::PositionCell;
use crate::contact::settings::SurfaceKind;
use crate::mesh_cycle::settings::{Coupling, SliceSettings};
use crate::mesh_cycle::sliced_mesh::SlicedMesh;
use crate::mesh_cycle::sliced_positions::{ContactPart, SliceContact};
use crate::observer::Observer;
use crate::simulation::settings::Operation;
use crate::stiffness::settings::StiffnessSettings;
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_fem::in_space::DeformedTooth;
use gearwear_bodies::gear_mesh::pair_mesh::in_place;
use gearwear_bodies::gear_mesh::settings::Body;
use gearwear_bodies::material::Material;
use gearwear_fem::nodal_fields::add_nodal_fields;
use gearwear_fem::stress::von_mises_mpa;

/// Slices over the face width, where the scene has none.
const SLICES: usize = 20;
/// Positions from A to E.
const POSITIONS: usize = 200;

/// The mesh with displacement and stress at its nodes, and the main figures.
#[derive(Debug, Clone, PartialEq)]
pub struct DeformedTeeth {
    /// The mesh.
    pub space: SpaceMesh,
    /// Load on the reference teeth, N.
    pub load_n: f64,
    /// Load of all teeth in contact, N.
    pub whole_load_n: f64,
    /// Transmission error there, µm.
    pub transmission_error_um: f64,
    /// Greatest displacement, µm.
    pub greatest_displacement_um: PerGear<f64>,
    /// Greatest von Mises stress, MPa.
    pub greatest_von_mises_mpa: PerGear<f64>,
}

/// The teeth of `inputs` at the position next to `position_mm`, by default to the pitch point.
pub fn deformed_teeth(
    inputs: RunInputs<'_>,
    position_mm: Option<f64>,
    observer: &dyn Observer,
) -> Result<DeformedTeeth, PairMeshError> {
    let mut scene = inputs.scene.clone();
    // Refused before the work.
    let position_mm = on_path_mm(&GearPair::new(&scene.pair)?, position_mm)?;
    let count = scene.slices.map_or(SLICES, |slices| slices.count);
    scene.slices = Some(SliceSettings { count, coupling: Coupling::Fem });
    scene.coupling_by_default = false;
    scene.contact.surface = SurfaceKind::HalfSpace;
    scene.contact.tip_contact = scene.contact.tip_contact || inputs.scene.contact.surface == SurfaceKind::Fem;
    scene.stiffness = StiffnessSettings::Fem;
    scene.fem.body = Body::Ring;
    scene.heat = None;
    scene.verify = false;
    scene.numerics.error_estimate = false;
    scene.numerics.positions = POSITIONS;
    // Under the one load of a scene in phases too.
    let torque = scene.operation.pinion_torque_n_mm;
    scene.operation = Operation::steady(torque, None, 1.0, vec![1.0]);
    prepared(RunInputs { scene: &scene, ..inputs }, &UnwornFlanksOnly(observer), |run, stages| {
        run.assess(Resumption::none(), stages, |model, found, _| {
            let mesh = found.outcome.new.cycle.slices.as_ref().expect("the scene has slices");
            deformed(model, mesh, position_mm)
        })
    })?
    .complete()?
}

/// Ends a run as soon as it has looked at its unworn flanks.
struct UnwornFlanksOnly<'a>(&'a dyn Observer);

impl Observer for UnwornFlanksOnly<'_> {
    fn stage(&self, name: &str) {
        self.0.stage(name);
    }

    fn warning(&self, text: &str) {
        self.0.warning(text);
    }

    fn interrupted(&self) -> bool {
        true
    }

    fn gives_up(&self) -> bool {
        self.0.gives_up()
    }
}

/// The teeth at the phase of `mesh` next to `position_mm`.
fn deformed(model: &RunModel<'_>, mesh: &SlicedMesh, position_mm: f64) -> Result<DeformedTeeth, PairMeshError> {
    let RunModel { scene, pair, sliced, .. } = *model;
    let sliced = sliced.expect("the scene has slices");
    let in_space_teeth = sliced.in_space().expect("they are coupled in space");
    let phases = mesh.transmission_error_mm.len();
    let spacing_mm = mesh.base_pitch_mm / phases as f64;
    let row = ((position_mm - mesh.position_mm[0]) / spacing_mm).round().max(0.0) as usize;
    let row = row.min(mesh.position_mm.len() - 1);
    let slices = &sliced.slices;
    let middle_mm = 0.5 * pair.spec.face_width_mm;
    let mut contacts = Vec::new();
    for (at, loads) in mesh.line_load_n_per_mm.chunks_exact(mesh.slices).enumerate() {
        if at % phases != row % phases {
            continue;
        }
        let tooth = (at / phases) as i32 - (row / phases) as i32;
        for (slice, load) in loads.iter().enumerate().filter(|(_, load)| **load > 0.0) {
            let ahead_mm = (middle_mm - slices.width_mm[slice]) * pair.base_helix_angle_rad().tan();
            let position_mm = mesh.position_mm[at] + ahead_mm;
            let cell = PositionCell { position_mm, lower_mm: position_mm, upper_mm: position_mm };
            let contact = SliceContact { tooth, slice, cell, part: ContactPart::WHOLE };
            contacts.push((contact, load * slices.slice_width_mm));
        }
    }
    let material = scene.material.map(Material::elastic);
    let teeth = in_space_teeth.deformed(pair, &material, slices, &contacts)?;
    let mut space = in_space_at(scene, pair, mesh.position_mm[row])?;
    add_solution(&mut space, pair, &teeth);
    let load = |of: &dyn Fn(i32) -> bool| -> f64 {
        contacts.iter().filter(|(contact, _)| of(contact.tooth)).map(|(_, load)| load).sum()
    };
    let phase = ((mesh.position_mm[row] - mesh.first_position_mm) / spacing_mm).round() as i64;
    let error_mm = mesh.transmission_error_mm[phase.rem_euclid(phases as i64) as usize];
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
    Ok(DeformedTeeth {
        space,
        load_n: load(&|tooth| tooth == 0),
        whole_load_n: load(&|_| true),
        transmission_error_um: error_mm * UM_PER_MM,
        greatest_displacement_um: teeth
            .as_ref()
            .map(|tooth| greatest(&mut tooth.displacement_mm.iter().map(|u| u.norm() * UM_PER_MM))),
        greatest_von_mises_mpa: teeth
            .as_ref()
            .map(|tooth| greatest(&mut tooth.stress_mpa.iter().map(|stress| von_mises_mpa((*stress).into())))),
    })
}

/// Displacement and stress at the nodes of both teeth, turned as they stand.
fn add_solution(space: &mut SpaceMesh, pair: &GearPair, teeth: &PerGear<DeformedTooth>) {
    let (mut displacement, mut stress, mut von_mises) = (Vec::new(), Vec::new(), Vec::new());
    for gear in Gear::BOTH {
        let place = in_place(pair, gear, space.position_mm);
        let origin = place(Vector3::zeros().xy());
        let turned = |k: usize| place(Vector3::ith(k, 1.0).xy()) - origin;
        let (x, y) = (turned(0), turned(1));
        let turn = Matrix3::new(x.x, y.x, 0.0, x.y, y.y, 0.0, 0.0, 0.0, 1.0);
        for (u, s) in teeth[gear].displacement_mm.iter().zip(&teeth[gear].stress_mpa) {
            displacement.push((turn * u).into());
            let tensor = Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2]);
            let t = turn * tensor * turn.transpose();
            // VTK's order: xx, yy, zz, xy, yz, xz.
            stress.push([t.m11, t.m22, t.m33, t.m12, t.m23, t.m13]);
            von_mises.push(von_mises_mpa((*s).into()));
        }
    }
    let (displacement, stress) = (displacement.into_iter(), stress.into_iter());
    add_nodal_fields(&mut space.mesh, displacement, stress, von_mises.into_iter());
}
