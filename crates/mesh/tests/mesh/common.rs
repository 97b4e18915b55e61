//! What the tests of mesh files share: every format, and meshes made at random.

use std::collections::BTreeMap;

use gearwear_mesh::gmsh::{GmshEncoding, GmshStyle, GmshVersion};
use gearwear_mesh::vtu::VtuEncoding;
use gearwear_mesh::{CellBlock, CellKind, DataArray, Format, Formulation, Mesh, PhysicalTag, Values};
use proptest::prelude::*;

/// Every format in every style.
pub const FORMATS: [Format; 9] = [
    gmsh(GmshVersion::V2, GmshEncoding::Ascii),
    gmsh(GmshVersion::V2, GmshEncoding::Binary),
    gmsh(GmshVersion::V4, GmshEncoding::Ascii),
    gmsh(GmshVersion::V4, GmshEncoding::Binary),
    Format::Vtu(VtuEncoding::Zlib),
    Format::Vtu(VtuEncoding::Base64),
    Format::Vtu(VtuEncoding::Ascii),
    Format::Json,
    Format::Abaqus,
];

const fn gmsh(version: GmshVersion, encoding: GmshEncoding) -> Format {
    Format::Gmsh(GmshStyle { version, encoding })
}

/// Finite numbers of every size, signed zeros and subnormal ones among them.
fn coordinate() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO
}

/// Names as people give them, with blanks, signs and letters of other alphabets; no quotes and no control characters, which
/// Gmsh and Abaqus cannot hold.
fn name() -> impl Strategy<Value = String> {
    prop_oneof![
        "[a-zA-Z][a-zA-Z0-9_-]{0,8}",
        "[a-cA-C]",
        "[0-9]{1,3}",
        "Zylinder-Oberfläche|поверхность|齿面|a b|x,y|<&>'|set:a|tag:b|  two  blanks ",
    ]
}

/// `count` members chosen at random.
fn subset(count: usize) -> impl Strategy<Value = Vec<usize>> {
    prop::collection::vec(any::<bool>(), count)
        .prop_map(|chosen| chosen.iter().enumerate().filter(|&(_, &in_it)| in_it).map(|(i, _)| i).collect())
}

/// Data of `components` for each of `owners`.
fn data(owners: usize, components: usize, integers: bool) -> BoxedStrategy<DataArray> {
    // Gmsh's data are doubles, which hold integers up to 2^53.
    const LARGEST: i64 = 1 << 53;
    let count = owners * components;
    let array = move |values| DataArray { components, values };
    if integers {
        prop::collection::vec(-LARGEST..=LARGEST, count).prop_map(move |values| array(Values::Integers(values))).boxed()
    } else {
        let real = prop_oneof![9 => coordinate(), 1 => prop::num::f64::INFINITE];
        prop::collection::vec(real, count).prop_map(move |values| array(Values::Reals(values))).boxed()
    }
}

/// A block of up to four cells of any kind that every format has.
fn block(points: usize) -> impl Strategy<Value = CellBlock> {
    let kinds: Vec<CellKind> = CellKind::ALL.into_iter().filter(|&kind| kind != CellKind::Hexahedron27).collect();
    let formulation = prop::option::of(prop::sample::select(vec![
        Formulation::PlaneStress,
        Formulation::Axisymmetric,
        Formulation::Shell,
        Formulation::Membrane,
    ]));
    (prop::sample::select(kinds), 0..4_usize, formulation).prop_flat_map(move |(kind, cells, formulation)| {
        let formulation = formulation.filter(|_| kind.dimension() == 2);
        prop::collection::vec(0..points, cells * kind.node_count()).prop_map(move |nodes| CellBlock {
            kind,
            nodes,
            formulation,
        })
    })
}

/// A mesh with everything a mesh may have. Its cells need not make sense as bodies.
pub fn any_mesh() -> impl Strategy<Value = Mesh> {
    let frame = (1..8_usize).prop_flat_map(|points| {
        let coordinates = prop::collection::vec([coordinate(), coordinate(), coordinate()], points);
        (coordinates, prop::collection::vec(block(points), 0..5))
    });
    frame.prop_flat_map(|(points, cells)| {
        let (count, lengths) = (points.len(), cells.iter().map(CellBlock::len).collect::<Vec<_>>());
        let form = || (name(), 1..=9_usize, any::<bool>());
        let point_data = prop::collection::vec(form(), 0..3).prop_flat_map(move |forms| {
            forms.into_iter().map(|(name, n, int)| (Just(name), data(count, n, int))).collect::<Vec<_>>()
        });
        let of_blocks = lengths.clone();
        let cell_data = prop::collection::vec(form(), 0..3).prop_flat_map(move |forms| {
            let arrays = |n, int| of_blocks.iter().map(|&length| data(length, n, int)).collect::<Vec<_>>();
            forms.into_iter().map(|(name, n, int)| (Just(name), arrays(n, int))).collect::<Vec<_>>()
        });
        let point_sets = prop::collection::vec((name(), subset(count)), 0..3);
        let lists = move || lengths.iter().map(|&length| subset(length)).collect::<Vec<_>>();
        let tag = prop::option::of((1..=i64::from(i32::MAX), 0..=3_u8));
        let cell_sets = prop::collection::vec((name(), lists(), tag), 0..4);
        (Just(points), Just(cells), point_data, cell_data, point_sets, cell_sets).prop_map(
            |(points, cells, point_data, mut cell_data, point_sets, cell_sets)| {
                if cells.is_empty() {
                    cell_data.clear();
                }
                let mut field_data = BTreeMap::new();
                let mut taken = Vec::new();
                for (name, _, tag) in &cell_sets {
                    if let Some((tag, dimension)) = *tag
                        && !taken.contains(&(tag, dimension))
                        && !field_data.contains_key(name)
                    {
                        taken.push((tag, dimension));
                        field_data.insert(name.clone(), PhysicalTag { tag, dimension });
                    }
                }
                Mesh {
                    points,
                    cells,
                    point_data: point_data.into_iter().collect(),
                    cell_data: cell_data.into_iter().collect(),
                    point_sets: point_sets.into_iter().collect(),
                    cell_sets: cell_sets.into_iter().map(|(name, lists, _)| (name, lists)).collect(),
                    field_data,
                    left_out: Vec::new(),
                }
            },
        )
    })
}

/// What an Abaqus file can hold of a mesh, whose plane cells always have a formulation.
pub fn without_data(mut mesh: Mesh) -> Mesh {
    for block in mesh.cells.iter_mut().filter(|block| block.kind.dimension() == 2) {
        block.formulation.get_or_insert(Formulation::PlaneStrain);
    }
    Mesh { point_data: BTreeMap::new(), cell_data: BTreeMap::new(), field_data: BTreeMap::new(), ..mesh }
}
