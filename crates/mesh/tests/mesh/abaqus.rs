//! Input files as other programs write them.

use std::fs;
use std::path::Path;

use gearwear_mesh::vtu::VtuEncoding;
use gearwear_mesh::{CellKind, Format, Formulation, Mesh, from_bytes, read, read_with_content, to_bytes};

fn mesh(text: &str) -> Mesh {
    from_bytes(Format::Abaqus, text.as_bytes()).unwrap_or_else(|fault| panic!("{fault}"))
}

fn fault(text: &str) -> String {
    from_bytes(Format::Abaqus, text.as_bytes()).expect_err("wrong").to_string()
}

/// Nodes of all cells of a set.
fn set(mesh: &Mesh, name: &str) -> Vec<Vec<usize>> {
    let lists = mesh.cells.iter().zip(&mesh.cell_sets[name]);
    lists.flat_map(|(block, list)| list.iter().map(|&cell| block.iter().nth(cell).unwrap().to_vec())).collect()
}

const CUBE: &str = "*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0\n5, 0, 0, 2\n6, 1, 0, 2\n7, 1, 1, 2\n8, 0, 1, 2\n\
                    *ELEMENT, TYPE=C3D8R, ELSET=BLOCK\n1, 1, 2, 3, 4, 5, 6, 7, 8\n";

#[test]
fn surfaces_of_solids_are_faces_and_come_back() {
    let read = mesh(&format!("{CUBE}*SURFACE, NAME=BASE\n1, s1\n*SURFACE, NAME=TOP, TYPE=ELEMENT\nBLOCK, S2\n"));
    assert_eq!(set(&read, "TOP"), [[4, 5, 6, 7]]);
    assert_eq!(set(&read, "BASE"), [[0, 3, 2, 1]]);
    assert_eq!(
        read.cells.iter().map(|block| block.kind).collect::<Vec<_>>(),
        [CellKind::Hexahedron, CellKind::Quad, CellKind::Quad]
    );
    let written = to_bytes(&read, Format::Abaqus).unwrap();
    let text = std::str::from_utf8(&written).unwrap();
    assert!(text.contains("NAME=TOP\n1, S2\n") && !text.contains("CPE4"), "{text}");
    let again = mesh(text);
    assert_eq!((&again.cells, &again.cell_sets), (&read.cells, &read.cell_sets));
}

#[test]
fn faces_of_shells_are_the_shells_and_their_sides_lines() {
    let text = "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*ELEMENT, TYPE=S4R, ELSET=SHEET\n1, 1, 2, 3, 4\n\
                *SURFACE, NAME=UP\nSHEET, SPOS\n*SURFACE, NAME=RIM\nSHEET, E2\n*SURFACE, NAME=SAME\nSHEET, S4\n";
    let read = mesh(text);
    assert_eq!(read.cells[0].formulation, Some(Formulation::Shell));
    assert_eq!(set(&read, "UP"), [[0, 1, 2, 3]]);
    assert_eq!(set(&read, "RIM"), [[1, 2]]);
    assert_eq!(set(&read, "SAME"), set(&read, "RIM"));
}

/// Two instances of one part, the second shifted by (10, 0, 0) and turned by 90° about the axis through (10, 0, 0) along z, and another part.
const ASSEMBLY: &str = "*HEADING\n*PART, NAME=Bar\n*NODE, NSET=ends\n1, 0, 0\n2, 2, 0\n3, 2, 1\n4, 0, 1\n\
    *ELEMENT, TYPE=CPE4, ELSET=all\n1, 1, 2, 3, 4\n*SURFACE, NAME=top\nall, S3\n*END PART\n\
    *PART, NAME=Block\n*NODE\n1, 0, -1\n2, 2, -1\n3, 0, -2\n*ELEMENT, TYPE=CPE3, ELSET=all\n1, 1, 3, 2\n*END PART\n\
    *ASSEMBLY, NAME=A\n*INSTANCE, NAME=Bar-1, PART=Bar\n*END INSTANCE\n\
    *INSTANCE, NAME=Bar-2, PART=BAR\n10., 0., 0.\n10., 0., 0., 10., 0., 1., 90.\n*END INSTANCE\n\
    *INSTANCE, NAME=Block-1, PART=Block\n*END INSTANCE\n\
    *NSET, NSET=corner, INSTANCE=Bar-2\n2\n*NSET, NSET=both\nBar-1.2, bar-2.2\n*ELSET, ELSET=bars\nBar-1.all, Bar-2.all\n\
    *NODE\n77, 5, 5\n*NSET, NSET=reference\n77\n*END ASSEMBLY\n";

#[test]
fn every_instance_is_in_its_place() {
    let read = mesh(ASSEMBLY);
    assert_eq!(read.points.len(), 12);
    let turned = read.points[read.point_sets["corner"][0]];
    let expected = [10.0, 2.0, 0.0];
    assert!(turned.iter().zip(expected).all(|(x, e)| (x - e).abs() < 1e-14), "{turned:?}");
    assert_eq!(read.point_sets["both"].len(), 2);
    assert_eq!(read.points[read.point_sets["reference"][0]], [5.0, 5.0, 0.0]);
    let counts =
        [("all", 3), ("Bar-2.all", 1), ("bars", 2), ("Block-1", 1), ("Bar-1", 1), ("top", 2), ("Bar-1.top", 1)];
    for (name, count) in counts {
        assert_eq!(set(&read, name).len(), count, "{name}");
    }
    assert_eq!((read.point_sets["ends"].len(), read.point_sets["Bar-1.ends"].len()), (8, 4));
}

/// One instance, as before, needs no prefix; a part without an instance is in its place.
#[test]
fn names_of_a_single_instance_need_no_prefix() {
    let part =
        "*PART, NAME=P\n*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=CPS3, ELSET=all\n1, 1, 2, 3\n*END PART\n";
    let assembly = "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n*END INSTANCE\n*NSET, NSET=n\nI.1, 2\n*ELSET, ELSET=e, INSTANCE=I\n1\n\
                    *END ASSEMBLY\n";
    let read = mesh(&format!("{part}{assembly}"));
    assert_eq!(read.point_sets["n"], [0, 1]);
    assert_eq!(read.cell_sets["e"], read.cell_sets["all"]);
    assert_eq!(read.cell_sets.len(), 2);
    assert_eq!(read.cells[0].formulation, Some(Formulation::PlaneStress));
    assert_eq!(mesh(part).cell_sets["all"], [vec![0]]);
}

#[test]
fn elements_without_cells_are_left_out_with_their_sets() {
    let text = format!(
        ">**\n** springs\n{CUBE}*ELEMENT, TYPE=SpringA, ELSET=WEAK\n2, 1, 7\n3, 2, 8\n*ELEMENT, TYPE=U1\n4, 1, 2,\n 3\n\
         *ELSET, ELSET=MIXED\n1, 2\n*NSET, NSET=N, ELSET=WEAK\n*SURFACE, NAME=SIDE\nMIXED, S1\n"
    );
    let read = mesh(&text);
    assert_eq!(read.cells.len(), 2);
    let springs = &read.left_out[0];
    assert_eq!((springs.element_type.as_str(), springs.count, springs.line), ("SpringA", 2, 14));
    assert_eq!(springs.sets, ["MIXED", "WEAK"]);
    assert_eq!((read.left_out[1].element_type.as_str(), read.left_out[1].count), ("U1", 1));
    assert_eq!(set(&read, "MIXED").len(), 1);
    assert_eq!(set(&read, "SIDE").len(), 1);
    assert!(read.cell_sets["WEAK"].iter().all(Vec::is_empty));
}

#[test]
fn included_files_are_read_relative_to_the_first() {
    let folder = std::env::temp_dir().join(format!("gearwear-include-{}", std::process::id()));
    fs::create_dir_all(folder.join("parts")).unwrap();
    let write = |name: &str, text: &str| fs::write(folder.join(name), text).unwrap();
    write(
        "main.inp",
        "*INCLUDE, INPUT=parts/nodes.inc\n*ELEMENT, TYPE=CPE3, ELSET=E, INPUT=elements.txt\n*NSET, NSET=A\n1\n",
    );
    write("parts/nodes.inc", "*NODE\n1, 0, 0\n*Include,\n input=parts/more.inc\n");
    write("parts/more.inc", "2, 1, 0\n3, 0, 1\n");
    write("elements.txt", "1, 1, 2, 3\n");
    let (read_mesh, content) = read_with_content(folder.join("main.inp")).unwrap();
    assert_eq!((read_mesh.points.len(), set(&read_mesh, "E")), (3, vec![vec![0, 1, 2]]));
    assert!(content.ends_with(b"2, 1, 0\n3, 0, 1\n"));
    write("parts/more.inc", "2, 1, x\n");
    let wrong = read(folder.join("main.inp")).unwrap_err().to_string();
    assert!(wrong.contains("line 1: *NODE in the included file \"parts/more.inc\": found \"2, 1, x\""), "{wrong}");
    write("parts/more.inc", "*INCLUDE, INPUT=parts/nodes.inc\n");
    let wrong = read(folder.join("main.inp")).unwrap_err().to_string();
    assert!(wrong.contains("it includes itself") && wrong.contains("line 1"), "{wrong}");
    write("main.inp", "*NODE\n1, 0, 0\n*INCLUDE, INPUT=nowhere.inc\n");
    let wrong = read(folder.join("main.inp")).unwrap_err().to_string();
    assert!(wrong.contains("line 3: *INCLUDE: the included file \"nowhere.inc\""), "{wrong}");
    fs::remove_dir_all(&folder).unwrap();
}

#[test]
fn refusals_say_the_line() {
    for (text, start) in [
        ("*NODE\n1, 0, 0\n1, 1, 0\n", "line 3: *NODE: node 1 is there twice"),
        (
            "*NODE\n1,0\n*ELEMENT, TYPE=MASS\n1, 1\n*ELEMENT, TYPE=SPRING1\n1, 1\n",
            "line 6: *ELEMENT: element 1 is there twice",
        ),
        (
            "*NODE\n1, 0, 0\n2, 1, 0\n*ELEMENT, TYPE=T3D2\n1,\n1, 2\n, 1, 2, 1\n",
            "line 7: *ELEMENT: element 1 is there twice",
        ),
        ("*NODE\n1, 0\n*SURFACE, NAME=S, COMBINE=UNION\na, b\n", "line 3: *SURFACE: a surface with COMBINE"),
        (
            "*PART, NAME=P\n*END PART\n*INSTANCE, NAME=I, PART=Q\n",
            "line 3: *INSTANCE: found \"Q\", expected a part defined before (P)",
        ),
        (
            "*PART, NAME=P\n*END PART\n*INSTANCE, NAME=I, PART=P\n1, 2, 3, 4\n",
            "line 4: *INSTANCE: found \"1, 2, 3, 4\"",
        ),
        (
            "*PART, NAME=P\n*END PART\n*INSTANCE, NAME=I, PART=P\n*NSET, NSET=N, INSTANCE=J\n1\n",
            "line 4: *NSET: found \"J\"",
        ),
        (
            "*NODE\n1, 0\n*ELEMENT, TYPE=GAPUNI\nx, 1\n",
            "line 4: *ELEMENT: found \"x, 1\", expected an element's number",
        ),
        ("*NODE\n1, 0\n*NGEN\n1, 5\n", "line 3: *NGEN"),
    ] {
        let found = fault(text);
        assert!(found.starts_with(start), "{found}");
        assert!(!found.contains('\n'));
    }
    let shells = fault(&format!("{CUBE}*SURFACE, NAME=S\n1, S7\n"));
    assert!(shells.starts_with("line 13: *SURFACE: side \"S7\" of an element with 8 nodes"), "{shells}");
}

/// The same physics in every format.
#[test]
fn formulations_come_back_from_every_format_that_has_them() {
    let read = mesh(
        "*NODE\n1, 0, 0\n2, 1, 0\n3, 1, 1\n4, 0, 1\n*ELEMENT, TYPE=CPS4\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=CAX3\n2, 1, 2, 3\n",
    );
    for format in super::common::FORMATS {
        assert_eq!(from_bytes(format, &to_bytes(&read, format).unwrap()).unwrap().cells, read.cells, "{format:?}");
    }
}

const TAGGED: &str = r#"<VTKFile type="UnstructuredGrid"><UnstructuredGrid><Piece NumberOfPoints="6" NumberOfCells="4">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 4 3 1 2 5 4 0 3 2 5</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4 8 10 12</DataArray>
<DataArray type="Int64" Name="types" format="ascii">9 9 3 3</DataArray></Cells>
<CellData><DataArray type="Int32" Name="gmsh:physical" format="ascii">1 1 2 0</DataArray>
<DataArray type="Int32" Name="medit:ref" format="ascii">5 6 5 5</DataArray></CellData>
</Piece></UnstructuredGrid></VTKFile>"#;

/// Physical groups of a VTU file are sets, also after a detour through any format; the content says what is read.
#[test]
fn integers_at_cells_are_groups() {
    let folder = std::env::temp_dir().join(format!("gearwear-tags-{}", std::process::id()));
    fs::create_dir_all(&folder).unwrap();
    let path = folder.join("mesh.txt");
    fs::write(&path, TAGGED).unwrap();
    let tagged = read(&path).unwrap();
    fs::remove_dir_all(&folder).unwrap();
    assert_eq!(set(&tagged, "1"), [[0, 1, 4, 3], [1, 2, 5, 4]]);
    assert_eq!(set(&tagged, "2"), [[0, 3]]);
    assert_eq!(tagged.cell_sets.len(), 2);
    let other: Vec<String> = gearwear_mesh::tag_groups(&tagged).into_iter().map(|group| group.name).collect();
    assert_eq!(other, ["medit:ref=5", "medit:ref=6"]);
    for format in super::common::FORMATS {
        let Ok(bytes) = to_bytes(&tagged, format) else { continue };
        let back = from_bytes(format, &bytes).unwrap();
        assert_eq!(set(&back, "1"), set(&tagged, "1"), "{format:?}");
    }
    let vtu = Format::Vtu(VtuEncoding::Ascii);
    assert_eq!(from_bytes(vtu, &to_bytes(&tagged, vtu).unwrap()).unwrap(), tagged);
    assert_eq!(Format::of_content(b"\n $MeshFormat"), Some(Format::of_path(Path::new("a.msh")).unwrap()));
}
