//! Mesh files: what is written comes back, and what other programs write is read.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use gearwear_mesh::{
    CellBlock, CellKind, DataArray, Format, Formulation, Mesh, PhysicalTag, Values, from_bytes, read, to_bytes,
};
use proptest::prelude::*;

use super::common::{FORMATS, any_mesh, without_data};

fn repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(path)
}

/// JSON is the serde form and keeps the sign of zeros, which `==` does not see.
fn bits(mesh: &Mesh) -> Vec<u8> {
    to_bytes(mesh, Format::Json).expect("every mesh goes into JSON")
}

/// The cells of each set, each as its kind and its nodes; lines without their direction.
fn set_cells(mesh: &Mesh) -> BTreeMap<&str, Vec<(CellKind, Vec<usize>)>> {
    let cells = |lists: &[Vec<usize>]| {
        let mut cells = Vec::new();
        for (block, list) in mesh.cells.iter().zip(lists) {
            for &cell in list {
                let mut nodes = block.iter().nth(cell).expect("the mesh is consistent").to_vec();
                if block.kind.dimension() == 1 {
                    nodes[..2].sort_unstable();
                }
                cells.push((block.kind, nodes));
            }
        }
        cells.sort();
        cells
    };
    mesh.cell_sets.iter().map(|(name, lists)| (name.as_str(), cells(lists))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn prop_every_format_with_data_keeps_every_name_and_bit(mesh in any_mesh()) {
        for format in FORMATS.into_iter().filter(|&format| format != Format::Abaqus) {
            let bytes = to_bytes(&mesh, format).expect("nothing in it that the format cannot hold");
            let back = from_bytes(format, &bytes);
            let back = back.map_err(|fault| TestCaseError::fail(format!("{format:?}: {fault}")))?;
            prop_assert_eq!(&back, &mesh, "{:?}", format);
            prop_assert_eq!(bits(&back), bits(&mesh), "{:?}", format);
        }
    }

    /// Abaqus turns lines on sides into surfaces with a node set of that name; nodes, sets and their cells stay.
    #[test]
    fn prop_abaqus_keeps_nodes_sets_and_what_is_in_them(mesh in any_mesh()) {
        let mesh = without_data(mesh);
        let bytes = to_bytes(&mesh, Format::Abaqus).expect("nothing in it that the format cannot hold");
        let back = from_bytes(Format::Abaqus, &bytes).map_err(|fault| TestCaseError::fail(fault.to_string()))?;
        let point_bits = |mesh: &Mesh| mesh.points.iter().flatten().map(|x| x.to_bits()).collect::<Vec<_>>();
        prop_assert_eq!(point_bits(&back), point_bits(&mesh));
        prop_assert_eq!(set_cells(&back), set_cells(&mesh));
        for (name, set) in &mesh.point_sets {
            prop_assert_eq!(back.point_sets.get(name), Some(set));
        }
        let solids = |mesh: &Mesh| mesh.cells.iter().filter(|b| b.kind.dimension() != 1).cloned().collect::<Vec<_>>();
        prop_assert_eq!(solids(&back), solids(&mesh));
    }
}

/// Two squares side by side, the left a quadrilateral, the right two triangles, as `meshes/formats/make.py` has Gmsh make
/// them: "whole body" is both, "правая" the right one, "base" the two lower lines, "corner" the first point; line 6 is in a
/// group without a name, tag 40.
#[test]
fn val_what_gmsh_writes_is_read_alike_in_all_variants() {
    let reference = read(repository("meshes/formats/gmsh-41-ascii.msh")).expect("valid");
    assert_eq!(reference.points.len(), 14);
    let kinds: Vec<(CellKind, usize)> = reference.cells.iter().map(|block| (block.kind, block.len())).collect();
    assert_eq!(kinds, [(CellKind::Vertex, 1), (CellKind::Line3, 3), (CellKind::Quad8, 1), (CellKind::Triangle6, 2)]);
    let sets: Vec<(&str, &[Vec<usize>])> =
        reference.cell_sets.iter().map(|(name, lists)| (name.as_str(), lists.as_slice())).collect();
    let expected: [(&str, [&[usize]; 4]); 5] = [
        ("40", [&[], &[2], &[], &[]]),
        ("base", [&[], &[0, 1], &[], &[]]),
        ("corner", [&[0], &[], &[], &[]]),
        ("whole body", [&[], &[], &[0], &[0, 1]]),
        ("правая", [&[], &[], &[], &[0, 1]]),
    ];
    assert_eq!(sets.len(), expected.len());
    for ((name, lists), (expected_name, expected_lists)) in sets.into_iter().zip(expected) {
        assert_eq!(name, expected_name);
        assert!(lists.iter().map(Vec::as_slice).eq(expected_lists), "{name}: {lists:?}");
    }
    // `$PhysicalNames` of the file.
    assert_eq!(reference.field_data["base"], PhysicalTag { tag: 3, dimension: 1 });
    assert_eq!(reference.field_data["правая"], PhysicalTag { tag: 2, dimension: 2 });
    for variant in ["41-binary", "41-ascii-parametric", "41-binary-parametric"] {
        let mesh = read(repository(&format!("meshes/formats/gmsh-{variant}.msh"))).expect("valid");
        assert_eq!(without_rounding(mesh), without_rounding(reference.clone()), "{variant}");
    }
    // Version 2.2 orders elements by physical group: other blocks, but the same sets.
    for variant in ["22-ascii", "22-binary", "22-ascii-parametric", "22-binary-parametric"] {
        let mesh = read(repository(&format!("meshes/formats/gmsh-{variant}.msh"))).expect("valid");
        assert_eq!(mesh.cells.iter().map(CellBlock::len).sum::<usize>(), 7, "copies are one cell again: {variant}");
        assert_eq!(set_cells(&mesh), set_cells(&reference), "{variant}");
        assert_eq!(mesh.field_data, reference.field_data, "{variant}");
    }
}

/// Gmsh writes 16 digits in ASCII, so that its coordinates are off by a rounding error.
fn without_rounding(mut mesh: Mesh) -> Mesh {
    mesh.points.iter_mut().flatten().for_each(|x| *x = (*x * 1e9).round());
    mesh
}

/// The mesh of `meshio_files` in `meshes/formats/make.py`.
#[test]
fn val_what_meshio_writes_is_read() {
    for (file, integers) in [
        ("meshio-ascii.vtu", true),
        ("meshio-base64.vtu", true),
        ("meshio-zlib.vtu", true),
        ("meshio-22-binary.msh", false),
    ] {
        let mesh = read(repository("meshes/formats").join(file)).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(mesh.points[4], [2.0, 0.5, 0.1], "{file}");
        let blocks = [
            CellBlock::new(CellKind::Quad, vec![0, 1, 2, 3]),
            CellBlock::new(CellKind::Triangle, vec![1, 4, 2, 0, 1, 2]),
        ];
        assert_eq!(mesh.cells, blocks, "{file}");
        let temperature = DataArray { components: 1, values: Values::Reals(vec![1.5, 2.5, -3.5, 0.1, 1e-300]) };
        // meshio writes 12 digits into an ASCII file.
        assert_eq!(mesh.point_data["temperature"], temperature, "{file}");
        let bodies = match integers {
            true => [Values::Integers(vec![7]), Values::Integers(vec![8, 9])],
            false => [Values::Reals(vec![7.0]), Values::Reals(vec![8.0, 9.0])],
        };
        assert_eq!(mesh.cell_data["body"], bodies.map(|values| DataArray { components: 1, values }), "{file}");
    }
    let mesh = read(repository("meshes/formats/meshio.inp")).expect("valid");
    assert_eq!(mesh.point_sets["low"], [0, 1]);
    assert_eq!(mesh.cell_sets["slanted"], [vec![], vec![0]]);
}

/// vtkio reads on its own what we write.
#[test]
fn val_vtkio_reads_our_vtu() {
    let mesh = read(repository("meshes/cylinder-on-block-quad8.msh")).expect("valid");
    for format in FORMATS.into_iter().filter(|format| matches!(format, Format::Vtu(_))) {
        let bytes = to_bytes(&mesh, format).expect("nothing in it that VTU cannot hold");
        let vtk = vtkio::Vtk::parse_xml(bytes.as_slice()).expect("vtkio reads it");
        let vtkio::model::DataSet::UnstructuredGrid { pieces, .. } = vtk.data else {
            panic!("not an unstructured grid")
        };
        let piece = pieces[0].load_piece_data(None).expect("one piece inline");
        let points: Vec<f64> = piece.points.cast_into().expect("coordinates");
        assert!(points.iter().eq(mesh.points.iter().flatten()), "{format:?}");
        let (nodes, ends) = piece.cells.cell_verts.into_xml();
        assert!(nodes.iter().map(|&node| node as usize).eq(mesh.cells.iter().flat_map(|b| b.nodes.iter().copied())));
        assert_eq!(ends.len(), mesh.cells.iter().map(CellBlock::len).sum::<usize>());
    }
}

/// Arc nodes of the reference meshes, middle nodes too, lie on the circles that their scripts draw.
#[test]
fn ver_reference_meshes_have_their_groups_and_true_arcs() {
    let circles = [("cylinder-surface", [0.0, 50.0], 50.0), ("hollow", [0.0, 50.5], 50.5)];
    let mut arcs = 0;
    let mut files: Vec<PathBuf> = std::fs::read_dir(repository("meshes"))
        .expect("a folder")
        .map(|entry| entry.expect("readable").path())
        .collect();
    files.sort();
    for path in files.iter().filter(|path| path.extension().is_some_and(|ending| ending == "msh")) {
        let mesh = read(path).unwrap_or_else(|error| panic!("{error}"));
        let is_plane = mesh.cells.iter().all(|block| block.kind.dimension() < 3);
        let groups: &[&str] = if is_plane { &["base", "top"] } else { &["plate"] };
        assert!(groups.iter().all(|name| mesh.cell_sets.contains_key(*name)), "{}", path.display());
        for (name, [x, y], radius_mm) in circles {
            let Some(lists) = mesh.cell_sets.get(name) else { continue };
            arcs += 1;
            for (block, list) in mesh.cells.iter().zip(lists) {
                for &node in list.iter().flat_map(|&cell| block.iter().nth(cell).expect("consistent")) {
                    let [px, py, _] = mesh.points[node];
                    let error = ((px - x).hypot(py - y) - radius_mm).abs();
                    assert!(error < 1e-12 * radius_mm, "{}: node {node} is off the arc by {error} mm", path.display());
                }
            }
        }
    }
    // Four cylinders on blocks, two in hollows that are arcs as well.
    assert_eq!(arcs, 8);
}

/// Surfaces come back as surfaces, and the solver finds sets of lines and of nodes under their names.
#[test]
fn a_surface_of_an_abaqus_file_becomes_lines_and_a_set() {
    let text = "** a block\n*Heading\n any text\n*Node, nset=ALL\n 1, 0., 0.\n 2, 1., 0.\n 3, 1d0, 1.\n 40, 0., 1.\n\
                *Element, type=CPE4R,\n elset=Body\n 7, 1, 2,\n 3, 40\n*Nset, nset=\"left side\"\n 1, 40\n\
                *Elset, elset=both\nBODY,\n*Nset, nset=again, generate\n 2, 40, 2\n*Surface, type=ELEMENT, name=Top\nbody, S3\n\
                *Material, name=steel\n*Elastic\n 210000., 0.3\n*Step\n*End step\n";
    let mesh = from_bytes(Format::Abaqus, text.as_bytes()).expect("valid");
    assert_eq!(mesh.points[2], [1.0, 1.0, 0.0]);
    let formulation = Some(Formulation::PlaneStrain);
    assert_eq!(mesh.cells[0], CellBlock { formulation, ..CellBlock::new(CellKind::Quad, vec![0, 1, 2, 3]) });
    assert_eq!(mesh.cells[1], CellBlock::new(CellKind::Line, vec![2, 3]));
    assert_eq!(mesh.cell_sets["Top"], [vec![], vec![0]]);
    assert_eq!(mesh.cell_sets["both"], mesh.cell_sets["Body"]);
    assert_eq!(mesh.point_sets["left side"], [0, 3]);
    assert_eq!(mesh.point_sets["again"], [1, 3]);
    let written = String::from_utf8(to_bytes(&mesh, Format::Abaqus).expect("fits")).expect("text");
    assert!(written.contains("*SURFACE, TYPE=ELEMENT, NAME=Top\n1, S3\n*NSET, NSET=Top\n3, 4\n"), "{written}");
    assert!(!written.contains("T2D2"), "lines on sides need no elements: {written}");
}

/// What is wrong, where, and what is allowed.
#[test]
fn faults_say_where_and_what_is_allowed() {
    let of = |path: &str, text: &str| {
        let format = Format::of_path(Path::new(path)).expect("known");
        from_bytes(format, text.as_bytes()).expect_err("wrong").to_string()
    };
    let nodes = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n1\n1 0 0 0\n$EndNodes\n";
    assert_eq!(
        of("a.msh", &format!("{nodes}$Elements\n1\n1 1 0 1 2\n$EndElements\n")),
        "line 10: $Elements: node 2 does not exist; nodes must come before what refers to them"
    );
    assert_eq!(
        of("a.msh", &format!("{nodes}$Elements\n1\n1 99 0 1 2\n$EndElements\n")),
        "line 10: $Elements: element type 99 is not supported; allowed: points, lines, triangles, quadrilaterals, \
         tetrahedra, hexahedra, wedges and pyramids, linear or quadratic (Gmsh's types 1 to 12 and 15 to 19)"
    );
    assert_eq!(
        of("a.msh", "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 1 1 1\n2 1 0 1\n1\n0 nan 0\n$EndNodes\n"),
        "line 8: $Nodes: found \"NaN\", expected a coordinate that is finite"
    );
    assert_eq!(
        of("a.msh", "$MeshFormat\n4.0 0 8\n$EndMeshFormat\n"),
        "line 2: $MeshFormat: version 4.0 of the format is not supported; allowed: 2.2 and 4.1"
    );
    assert_eq!(
        of("a.msh", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4000000000\n1 0 0 0\n$EndNodes\n"),
        "line 5: $Nodes: 4000000000 nodes announced, but the rest of the file holds at most 2"
    );
    assert_eq!(
        of("a.inp", "*NODE\n1, 0, 0\n*INCLUDE, INPUT=other.inp\n"),
        "line 3: *INCLUDE: the included file \"other.inp\" cannot be read: a mesh that is no file of its own can include none"
    );
    assert_eq!(
        of("a.inp", "*NODE\n1, 0, x\n"),
        "line 2: *NODE: found \"1, 0, x\", expected a node's number and up to three coordinates"
    );
    assert!(of("a.json", "{\"points\": [[0, 0, 0]],\n \"cellz\": []}").starts_with("line 2: JSON: "));
    assert!(of("a.json", "{\"points\": [[0, 0, null]], \"cells\": []}").starts_with("line 1: JSON: "));
    assert!(of("a.vtu", "<VTKFile type=\"PolyData\"><Piece/></VTKFile>").contains("allowed: UnstructuredGrid"));
    let unknown = read("mesh.stl").expect_err("not a mesh format");
    assert_eq!(
        unknown.to_string(),
        "mesh.stl: a mesh file ends in .msh (Gmsh 2.2 or 4.1), .vtu (VTK), .inp (Abaqus) or .json"
    );
}

/// Appended data, raw and base64, with a big end first and headers of 32 bits, as VTK may write them.
#[test]
fn appended_arrays_are_read() {
    let points: Vec<u8> = [0.0_f64, 0.0, 0.0, 2.0, 0.0, 0.0].iter().flat_map(|x| x.to_be_bytes()).collect();
    let nodes: Vec<u8> = [0_i32, 1].iter().flat_map(|x| x.to_be_bytes()).collect();
    let arrays = [points, nodes, 2_u32.to_be_bytes().to_vec(), vec![3]];
    for base64 in [false, true] {
        let mut data = Vec::new();
        let mut offsets = Vec::new();
        for array in &arrays {
            offsets.push(data.len());
            let with_header = [&(array.len() as u32).to_be_bytes()[..], array].concat();
            match base64 {
                false => data.extend(with_header),
                true => {
                    data.extend(base64::Engine::encode(&base64::prelude::BASE64_STANDARD, with_header).into_bytes())
                }
            }
        }
        let array = |kind: &str, name: &str, components: usize, number: usize| {
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"appended\" \
                 offset=\"{}\"/>",
                offsets[number]
            )
        };
        let head = format!(
            "<VTKFile type=\"UnstructuredGrid\" byte_order=\"BigEndian\"><UnstructuredGrid>\
             <Piece NumberOfPoints=\"2\" NumberOfCells=\"1\"><Points>{}</Points><Cells>{}{}{}</Cells></Piece>\
             </UnstructuredGrid><AppendedData encoding=\"{}\">\n _",
            array("Float64", "Points", 3, 0),
            array("Int32", "connectivity", 1, 1),
            array("UInt32", "offsets", 1, 2),
            array("UInt8", "types", 1, 3),
            if base64 { "base64" } else { "raw" },
        );
        let file = [head.as_bytes(), &data, b"\n</AppendedData></VTKFile>"].concat();
        let format = Format::of_path(Path::new("a.vtu")).expect("known");
        let mesh = from_bytes(format, &file).unwrap_or_else(|fault| panic!("{fault}"));
        assert_eq!(mesh.points, [[0.0; 3], [2.0, 0.0, 0.0]]);
        assert_eq!(mesh.cells, [CellBlock::new(CellKind::Line, vec![0, 1])]);
    }
}

/// What a format cannot hold is refused rather than dropped.
#[test]
fn what_does_not_fit_is_refused() {
    let array = |values| DataArray { components: 1, values };
    let mut mesh = Mesh { points: vec![[0.0; 3]], ..Mesh::default() };
    mesh.point_data.insert("gap".into(), array(Values::Integers(vec![(1 << 53) + 1])));
    for format in FORMATS {
        let fits = to_bytes(&mesh, format).is_ok();
        assert_eq!(fits, matches!(format, Format::Vtu(_) | Format::Json), "{format:?}");
    }
    mesh.point_data.insert("gap".into(), array(Values::Reals(vec![f64::NAN])));
    for format in FORMATS.into_iter().filter(|&format| format != Format::Abaqus) {
        let back = from_bytes(format, &to_bytes(&mesh, format).expect("data may be NaN")).expect("valid");
        assert!(matches!(&back.point_data["gap"].values, Values::Reals(gap) if gap[0].is_nan()), "{format:?}");
    }
    mesh.points[0][0] = f64::INFINITY;
    assert!(FORMATS.into_iter().all(|format| to_bytes(&mesh, format).is_err()));
}
