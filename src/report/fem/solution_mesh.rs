//! `solution.vtu`: the bodies with displacement and stress at their nodes.

use std::collections::BTreeMap;
use std::io::{self, Write};

use crate::fem::record::FemRecord;
use crate::fem::solid::ElementKind;
use crate::mesh::{CellBlock, CellKind, DataArray, Mesh, Values};

/// Writes the mesh in the form ParaView reads.
pub fn write(out: &mut dyn Write, record: &FemRecord) -> io::Result<()> {
    serde_json::to_writer(out, &mesh(record)).map_err(io::Error::other)
}

/// The solution as a mesh with data.
fn mesh(record: &FemRecord) -> Mesh {
    let solid = &record.problem.solid;
    let mut cells: Vec<CellBlock> = Vec::new();
    let mut bodies: Vec<Vec<i64>> = Vec::new();
    for element in &solid.elements {
        let kind = cell_kind(element.kind);
        if cells.last().is_none_or(|block| block.kind != kind) {
            cells.push(CellBlock { kind, nodes: Vec::new() });
            bodies.push(Vec::new());
        }
        if let (Some(block), Some(bodies)) = (cells.last_mut(), bodies.last_mut()) {
            block.nodes.extend(element.nodes().iter().map(|&node| node as usize));
            bodies.push(i64::from(element.material));
        }
    }
    let scalar = |values: Vec<f64>| DataArray { components: 1, values: Values::Reals(values) };
    let mut point_data = BTreeMap::new();
    let displacement = record.displacement_mm.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect();
    point_data.insert("displacement_mm".to_owned(), DataArray { components: 3, values: Values::Reals(displacement) });
    // A symmetric tensor in VTK's order: xx, yy, zz, xy, yz, xz.
    let tensor = |[x, y, z, xy]: [f64; 4]| [x, y, z, xy, 0.0, 0.0];
    let stress = record.stress.iter().flat_map(|stress| tensor(stress.components_MPa)).collect();
    point_data.insert("stress_MPa".to_owned(), DataArray { components: 6, values: Values::Reals(stress) });
    point_data
        .insert("von_mises_MPa".to_owned(), scalar(record.stress.iter().map(|stress| stress.von_mises_MPa).collect()));
    point_data.insert("pressure_MPa".to_owned(), scalar(pressures(record)));
    let body = bodies.into_iter().map(|body| DataArray { components: 1, values: Values::Integers(body) }).collect();
    Mesh {
        points: solid.points_mm.iter().map(|p| [p.x, p.y, 0.0]).collect(),
        cells,
        point_data,
        cell_data: BTreeMap::from([("body".to_owned(), body)]),
        ..Mesh::default()
    }
}

fn cell_kind(kind: ElementKind) -> CellKind {
    match kind {
        ElementKind::Triangle3 => CellKind::Triangle,
        ElementKind::Triangle6 => CellKind::Triangle6,
        ElementKind::Quad4 => CellKind::Quad,
        ElementKind::Quad8 => CellKind::Quad8,
        ElementKind::Quad9 => CellKind::Quad9,
    }
}

/// Contact pressure at every node: 0 where there is none.
fn pressures(record: &FemRecord) -> Vec<f64> {
    let mut pressure_mpa = vec![0.0; record.problem.solid.points_mm.len()];
    for row in record.contacts.iter().flat_map(|contact| &contact.rows) {
        pressure_mpa[row.node as usize] = row.pressure_MPa;
    }
    pressure_mpa
}
