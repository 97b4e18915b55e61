//! `flank.vtu`: the working flanks of one tooth pair in space, where they touch at the pitch point in the middle of the face
//! width; for ParaView. `flank.pvd`, where asked for: the same at the beginning and at every snapshot.
//!
//! Points lie on the nominal flanks ([`gearwear_bodies::gear::flank_surface`]), from the root form circle to the tip circle and from one
//! end face to the other: at the middle of every slice, and at both end faces with the values of the slice next to them. Wear
//! and modifications are data; along `transverse_normal` they make the worn flank (ParaView: Warp By Vector, or Calculator and
//! Warp By Scalar with a factor).

use std::io::{self, Write};

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, Event};

use super::vtu_file;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_mesh::{CellBlock, CellKind, DataArray, Mesh, Values};
use gearwear_physics::results::run::{FlankRecord, RunRecord};

/// Names and values of what is told of the points of a flank, slice after slice.
type Fields<'a> = Vec<(&'static str, &'a [f64])>;

/// Writes both flanks at the end of the run.
pub fn write(out: &mut dyn Write, record: &RunRecord) -> io::Result<()> {
    let fields = |gear: Gear| {
        let flank = &record.flanks[gear];
        let pressures =
            [("pressure_new_MPa", &flank.pressure_new_MPa), ("pressure_worn_MPa", &flank.pressure_worn_MPa)];
        with_unworn(flank, [("wear_um", &flank.wear_um), pressures[0], pressures[1]])
    };
    vtu_file::write(out, &mesh(record, PerGear::from_fn(fields)))
}

/// How many files [`write_moment`] can write: the beginning and every snapshot.
pub fn moments(record: &RunRecord) -> usize {
    record.history.len() + 1
}

/// Writes both flanks at the beginning (0) or at a snapshot, from 1.
pub fn write_moment(out: &mut dyn Write, record: &RunRecord, moment: usize) -> io::Result<()> {
    let unworn = PerGear::from_fn(|gear| vec![0.0; record.flanks[gear].wear_um.len()]);
    let fields = |gear: Gear| {
        let flank = &record.flanks[gear];
        let (wear_um, pressure_mpa) = match moment.checked_sub(1) {
            None => (&unworn[gear], &flank.pressure_new_MPa),
            Some(snapshot) => (&flank.snapshot_wear_um[snapshot], &flank.snapshot_pressure_MPa[snapshot]),
        };
        with_unworn(flank, [("wear_um", wear_um), ("pressure_MPa", pressure_mpa)])
    };
    vtu_file::write(out, &mesh(record, PerGear::from_fn(fields)))
}

/// Writes the list of the `files` of all moments, each with its time: running time in hours, pinion revolutions where there is none.
pub fn write_series(out: &mut dyn Write, record: &RunRecord, files: &[String]) -> io::Result<()> {
    let times = record.history.iter().map(|row| row.hours.unwrap_or(row.revolutions).to_string());
    let mut xml = Writer::new_with_indent(out, b' ', 2);
    xml.write_event(Event::Decl(BytesDecl::new("1.0", None, None)))?;
    let whole = xml.create_element("VTKFile").with_attributes([("type", "Collection"), ("version", "0.1")]);
    whole.write_inner_content(|xml| {
        xml.create_element("Collection").write_inner_content(|xml| {
            for (time, file) in std::iter::once("0".to_owned()).chain(times).zip(files) {
                let set = [("timestep", time.as_str()), ("group", ""), ("part", "0"), ("file", file.as_str())];
                xml.create_element("DataSet").with_attributes(set).write_empty()?;
            }
            Ok(())
        })?;
        Ok(())
    })?;
    Ok(())
}

/// What does not change with wear, and then `worn`.
fn with_unworn<'a, const N: usize>(flank: &'a FlankRecord, worn: [(&'static str, &'a Vec<f64>); N]) -> Fields<'a> {
    let unworn = [("removed_um", &flank.removed_um), ("sliding_mm_per_mesh", &flank.sliding_mm_per_mesh)];
    unworn.into_iter().chain(worn).map(|(name, values)| (name, values.as_slice())).collect()
}

/// Places over the face width, each with the slice whose values it has.
fn sections(width_mm: &[f64], face_width_mm: f64) -> Vec<(f64, usize)> {
    let last = width_mm.len().saturating_sub(1);
    let middles = width_mm.iter().copied().zip(0..);
    std::iter::once((0.0, 0)).chain(middles).chain([(face_width_mm, last)]).collect()
}

fn mesh(record: &RunRecord, fields: PerGear<Fields<'_>>) -> Mesh {
    let mut mesh = Mesh::default();
    let (mut quads, mut gear_of_quad) = (Vec::new(), Vec::new());
    let (mut radius, mut width, mut slice_of, mut normal) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let mut values: Vec<(&'static str, Vec<f64>)> = fields.pinion.iter().map(|(name, _)| (*name, Vec::new())).collect();
    for gear in Gear::BOTH {
        let flank = &record.flanks[gear];
        let surface = &record.surface[gear];
        let position_mm = record.summary.geometry.curvature_radius_mm.C;
        let root_form_mm = 0.5 * record.summary.geometry.gears[gear].root_form_diameter_mm;
        let on_involute = flank.first_from(root_form_mm)..flank.radius_mm.len();
        let (start, along) = (mesh.points.len(), on_involute.len());
        let sections = sections(&flank.width_mm, surface.face_width_mm);
        for &(width_mm, slice) in &sections {
            for point in on_involute.clone() {
                let rho = surface.rho_mm(flank.radius_mm[point]);
                mesh.points.push(surface.point_mm(rho, width_mm, position_mm));
                normal.extend(surface.transverse_normal(rho, width_mm, position_mm));
                radius.push(flank.radius_mm[point]);
                width.push(width_mm);
                slice_of.push(slice as i64);
                for ((_, all), (_, field)) in values.iter_mut().zip(&fields[gear]) {
                    all.push(field[slice * flank.radius_mm.len() + point]);
                }
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
    mesh.cells.push(CellBlock::new(CellKind::Quad, quads));
    let integers = |values| DataArray { components: 1, values: Values::Integers(values) };
    mesh.cell_data.insert("gear".to_owned(), vec![integers(gear_of_quad)]);
    for (name, values) in [("radius_mm", radius), ("width_mm", width)].into_iter().chain(values) {
        mesh.add_point_data(name, 1, values);
    }
    mesh.point_data.insert("slice".to_owned(), integers(slice_of));
    mesh.add_point_data("transverse_normal", 3, normal);
    mesh
}
