//! `flank.vtu`: the working flanks of one tooth pair in space, where they touch at the pitch point in the middle of the face
//! width; for ParaView.
//!
//! Points lie on the nominal flanks ([`crate::gear::flank_surface`]), from the root form circle to the tip circle and from one
//! end face to the other: at the middle of every slice, and at both end faces with the values of the slice next to them. Wear
//! and modifications are data; along `transverse_normal` they make the worn flank (ParaView: Warp By Vector, or Calculator and
//! Warp By Scalar with a factor).

use std::io::{self, Write};

use super::vtu_file;
use crate::gear::Gear;
use crate::mesh::{CellBlock, CellKind, DataArray, Mesh, Values};
use crate::results::run::{FlankRecord, RunRecord, SliceRecord};

pub(crate) fn write(out: &mut dyn Write, record: &RunRecord, slices: &SliceRecord) -> io::Result<()> {
    vtu_file::write(out, &mesh(record, slices))
}

/// Places over the face width, each with the slice whose values it has.
fn sections(width_mm: &[f64], face_width_mm: f64) -> Vec<(f64, usize)> {
    let last = width_mm.len().saturating_sub(1);
    let middles = width_mm.iter().copied().zip(0..);
    std::iter::once((0.0, 0)).chain(middles).chain([(face_width_mm, last)]).collect()
}

fn mesh(record: &RunRecord, slices: &SliceRecord) -> Mesh {
    let mut mesh = Mesh::default();
    let (mut quads, mut gear_of_quad) = (Vec::new(), Vec::new());
    let mut data = PointData::default();
    for gear in Gear::BOTH {
        let flank = &record.flanks[gear];
        let surface = &slices.surface[gear];
        let position_mm = record.summary.geometry.curvature_radius_mm.C;
        let root_form_mm = 0.5 * record.summary.geometry.gears[gear].root_form_diameter_mm;
        let on_involute = flank.radius_mm.partition_point(|&radius| radius < root_form_mm)..flank.radius_mm.len();
        let (start, along) = (mesh.points.len(), on_involute.len());
        let sections = sections(&flank.width_mm, surface.face_width_mm);
        for &(width_mm, slice) in &sections {
            for point in on_involute.clone() {
                let rho = surface.rho_mm(flank.radius_mm[point]);
                mesh.points.push(surface.point_mm(rho, width_mm, position_mm));
                data.normal.extend(surface.transverse_normal(rho, width_mm, position_mm));
                data.push(flank, point, width_mm, slice);
            }
        }
        for across in 0..sections.len().saturating_sub(1) {
            for point in 0..along.saturating_sub(1) {
                let near = start + across * along + point;
                let far = near + along;
                // Anticlockwise as seen from outside the tooth.
                quads.extend([near, far, far + 1, near + 1]);
                gear_of_quad.push(gear as i64);
            }
        }
    }
    mesh.cells.push(CellBlock { kind: CellKind::Quad, nodes: quads });
    let gears = DataArray { components: 1, values: Values::Integers(gear_of_quad) };
    mesh.cell_data.insert("gear".to_owned(), vec![gears]);
    data.into_mesh(&mut mesh);
    mesh
}

/// What is told of every point.
#[derive(Default)]
struct PointData {
    reals: [Vec<f64>; 7],
    slice: Vec<i64>,
    normal: Vec<f64>,
}

/// Names of the scalars, in the order in which [`PointData::push`] adds them.
const NAMES: [&str; 7] =
    ["radius_mm", "width_mm", "removed_um", "sliding_mm_per_mesh", "wear_um", "pressure_new_MPa", "pressure_worn_MPa"];

impl PointData {
    fn push(&mut self, flank: &FlankRecord, point: usize, width_mm: f64, slice: usize) {
        let place = slice * flank.radius_mm.len() + point;
        let values = [
            flank.radius_mm[point],
            width_mm,
            flank.removed_um[place],
            flank.sliding_mm_per_mesh[place],
            flank.wear_um[place],
            flank.pressure_new_MPa[place],
            flank.pressure_worn_MPa[place],
        ];
        self.reals.iter_mut().zip(values).for_each(|(all, value)| all.push(value));
        self.slice.push(slice as i64);
    }

    fn into_mesh(self, mesh: &mut Mesh) {
        for (name, values) in NAMES.into_iter().zip(self.reals) {
            mesh.add_point_data(name, 1, values);
        }
        let slice = DataArray { components: 1, values: Values::Integers(self.slice) };
        mesh.point_data.insert("slice".to_owned(), slice);
        mesh.add_point_data("transverse_normal", 3, self.normal);
    }
}
