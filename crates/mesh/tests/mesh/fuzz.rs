//! Broken mesh files: whatever is in them, reading ends in a mesh or in a message.
//!
//! Each file here is valid at first, then cut, flipped, spliced or given huge counts. A panic fails the test by itself. Time and
//! memory are bounded by what `mesh::file` promises: every entry that is stored was paid for by bytes of the file or by the
//! allowance of `LARGEST_EXPANSION` entries for each byte, so what is read must stay below that.

use gearwear_mesh::error::{FileProblem, LARGEST_EXPANSION};
use gearwear_mesh::{DataArray, Format, Mesh, from_bytes, to_bytes};
use proptest::prelude::*;

use super::common::{FORMATS, any_mesh, without_data};

/// Small files have this allowance in any case.
const LEAST_ALLOWANCE: u64 = 10_000;

fn entries(mesh: &Mesh) -> u64 {
    let arrays = mesh.point_data.values().chain(mesh.cell_data.values().flatten());
    let data: usize = arrays.map(DataArray::value_count).sum();
    let sets: usize = mesh.point_sets.values().chain(mesh.cell_sets.values().flatten()).map(Vec::len).sum();
    let nodes: usize = mesh.cells.iter().map(|block| block.nodes.len()).sum();
    let lists: usize =
        mesh.cell_sets.values().map(Vec::len).sum::<usize>() + mesh.cell_data.values().map(Vec::len).sum::<usize>();
    (3 * mesh.points.len() + data + sets + nodes + lists) as u64
}

fn survives(format: Format, bytes: &[u8]) -> Result<(), TestCaseError> {
    match from_bytes(format, bytes) {
        Ok(mesh) => {
            prop_assert!(mesh.check().is_ok());
            let most = (bytes.len() as u64 * (LARGEST_EXPANSION + 8)).max(LEAST_ALLOWANCE);
            prop_assert!(entries(&mesh) <= most, "{} entries of {} bytes", entries(&mesh), bytes.len());
        }
        Err(fault) => {
            let text = fault.to_string();
            prop_assert!(!text.is_empty() && !text.contains('\n'), "one line: {text}");
            if format == Format::Abaqus && !matches!(fault.problem, FileProblem::TooLarge { .. } | FileProblem::Mesh(_))
            {
                prop_assert!(text.starts_with("line "), "without its line: {text}");
            }
        }
    }
    Ok(())
}

/// What to do to a file; places are fractions of its length.
#[derive(Debug, Clone)]
enum Harm {
    Cut(f64),
    Flip(f64, u8),
    Splice(f64, &'static [u8]),
    Repeat(f64, f64),
    Delete(f64, f64),
}

/// Tokens that mean something in one of the formats, and numbers that are too large for anything.
const TOKENS: [&[u8]; 37] = [
    b"$Nodes\n",
    b"$EndNodes\n",
    b"$Elements\n",
    b"$Entities\n",
    b"$NodeData\n",
    b"$PhysicalNames\n",
    b"$Gearwear\n{}\n",
    b"$",
    b" 18446744073709551615 ",
    b" 9999999999 ",
    b" -1 ",
    b" 0 ",
    b" nan ",
    b" 1e999 ",
    b"\xff\xff\xff\xff\xff\xff\xff\x7f",
    b"\x00\x00\x00\x00\x00\x00\x00\x00",
    b"<DataArray",
    b"</DataArray>",
    b"<Piece NumberOfPoints=\"99999999999\">",
    b"\"",
    b">",
    b"<AppendedData encoding=\"raw\">_",
    b"format=\"appended\" offset=\"5\"",
    b"*NSET, NSET=x, GENERATE\n1, 4000000000\n",
    b"*SURFACE, NAME=y\n1, S9\n",
    b"*ELEMENT, TYPE=CPE8\n1, 1,\n",
    b"*PART, NAME=a\n",
    b"*END PART\n*INSTANCE, NAME=i, PART=a\n1, 2, 3\n",
    b"0, 0, 0, 0, 0, 1, 90\n",
    b"*END INSTANCE\n",
    b"*INCLUDE, INPUT=other.inp\n",
    b"*ELEMENT, TYPE=SPRINGA, ELSET=x\n1, 1, 2\n",
    b"*NSET, NSET=y, INSTANCE=i\n1, i.2\n",
    b">**\n",
    b"[[",
    b"1e400",
    "é".as_bytes(),
];

fn harm() -> impl Strategy<Value = Harm> {
    let at = 0.0..1.0_f64;
    prop_oneof![
        at.clone().prop_map(Harm::Cut),
        (at.clone(), 1..=255_u8).prop_map(|(at, bits)| Harm::Flip(at, bits)),
        (at.clone(), prop::sample::select(TOKENS.to_vec())).prop_map(|(at, token)| Harm::Splice(at, token)),
        (at.clone(), at.clone()).prop_map(|(from, to)| Harm::Repeat(from, to)),
        (at.clone(), at).prop_map(|(from, to)| Harm::Delete(from, to)),
    ]
}

fn apply(bytes: &mut Vec<u8>, harm: &Harm) {
    let length = bytes.len();
    let place = |at: f64| (at * length as f64) as usize;
    let range = |a: f64, b: f64| place(a.min(b))..place(a.max(b));
    match *harm {
        Harm::Cut(at) => bytes.truncate(place(at)),
        Harm::Flip(at, bits) => {
            if let Some(byte) = bytes.get_mut(place(at)) {
                *byte ^= bits;
            }
        }
        Harm::Splice(at, token) => {
            bytes.splice(place(at)..place(at), token.iter().copied());
        }
        Harm::Repeat(from, to) => {
            let part = bytes[range(from, to)].to_vec();
            bytes.splice(place(to)..place(to), part);
        }
        Harm::Delete(from, to) => {
            bytes.drain(range(from, to));
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, max_shrink_iters: 200, ..ProptestConfig::default() })]

    #[test]
    fn prop_broken_files_of_every_format_are_read_or_refused(
        mesh in any_mesh(),
        harms in prop::collection::vec(harm(), 1..4),
    ) {
        let plain = without_data(mesh.clone());
        for format in FORMATS {
            let mesh = if format == Format::Abaqus { &plain } else { &mesh };
            let mut bytes = to_bytes(mesh, format).expect("the format holds such meshes");
            harms.iter().for_each(|harm| apply(&mut bytes, harm));
            survives(format, &bytes)?;
        }
    }

    #[test]
    fn prop_bytes_at_random_are_read_or_refused(bytes in prop::collection::vec(any::<u8>(), 0..200)) {
        for format in FORMATS {
            survives(format, &bytes)?;
        }
    }

    #[test]
    fn prop_broken_files_of_other_programs_are_read_or_refused(
        file in prop::sample::select(vec![
            "gmsh-22-ascii-parametric.msh", "gmsh-22-binary.msh", "gmsh-41-ascii.msh", "gmsh-41-binary-parametric.msh",
            "meshio-zlib.vtu", "meshio-base64.vtu", "meshio-ascii.vtu", "meshio.inp",
        ]),
        harms in prop::collection::vec(harm(), 1..4),
    ) {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/formats").join(file);
        let mut bytes = std::fs::read(&path).expect("the file is part of the repository");
        harms.iter().for_each(|harm| apply(&mut bytes, harm));
        survives(Format::of_path(&path).expect("a mesh file"), &bytes)?;
    }
}

/// An assembly of two instances, shells, springs and surfaces of every kind.
const ASSEMBLY: &str = "*HEADING\n** of two\n*PART, NAME=a\n*NODE, NSET=n\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n4, 0, 0, 1\n\
    *ELEMENT, TYPE=C3D4, ELSET=e\n1, 1, 2, 3, 4\n*ELEMENT, TYPE=S3, ELSET=s\n2, 1, 2, 3\n*ELEMENT, TYPE=SPRINGA, ELSET=w\n3, 1,\n2\n\
    *SURFACE, NAME=f\ne, S2\ns, SPOS\ns, E1\n*END PART\n*ASSEMBLY, NAME=b\n*INSTANCE, NAME=i, PART=a\n*END INSTANCE\n\
    *INSTANCE, NAME=j, PART=a\n1, 2, 3\n0, 0, 0, 0, 0, 1, 90\n*END INSTANCE\n*NODE\n1, 5, 5\n*NSET, NSET=m, INSTANCE=i, GENERATE\n1, 3\n\
    *ELSET, ELSET=all\ni.e, j.1, j.w\n*NSET, NSET=k, ELSET=all\n*SURFACE, TYPE=NODE, NAME=p\nm, 1.\n*END ASSEMBLY\n*STEP\n*END STEP\n";

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, max_shrink_iters: 200, ..ProptestConfig::default() })]

    #[test]
    fn prop_broken_assemblies_are_read_or_refused_at_their_line(harms in prop::collection::vec(harm(), 1..4)) {
        let mut bytes = ASSEMBLY.as_bytes().to_vec();
        prop_assert!(from_bytes(Format::Abaqus, &bytes).is_ok());
        harms.iter().for_each(|harm| apply(&mut bytes, harm));
        survives(Format::Abaqus, &bytes)?;
    }

    #[test]
    fn prop_lines_in_any_order_are_read_or_refused_at_their_line(
        order in prop::collection::vec(0..ASSEMBLY.lines().count(), 0..40),
    ) {
        let lines: Vec<&str> = ASSEMBLY.lines().collect();
        let text: Vec<&str> = order.into_iter().map(|line| lines[line]).collect();
        survives(Format::Abaqus, text.join("\n").as_bytes())?;
    }
}

/// Every count in a binary Gmsh file replaced by a huge one: refused before anything of that size is allocated.
#[test]
fn huge_counts_at_every_place_of_a_binary_file_are_refused_or_harmless() {
    for file in ["gmsh-22-binary.msh", "gmsh-41-binary.msh"] {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/formats").join(file);
        let bytes = std::fs::read(&path).expect("the file is part of the repository");
        let format = Format::of_path(&path).expect("a mesh file");
        for at in 0..bytes.len() - 4 {
            let mut broken = bytes.clone();
            broken[at..at + 4].copy_from_slice(&[0xff, 0xff, 0xff, 0x7f]);
            survives(format, &broken).expect("no panic and no runaway memory");
        }
    }
}

/// Thousands of sets of all nodes in a few bytes each: the file would otherwise ask for memory as the square of its length.
#[test]
fn sets_far_larger_than_the_file_are_refused() {
    let mut text = String::from("*NODE\n");
    (1..=5000).for_each(|node| text.push_str(&format!("{node},0\n")));
    (0..5000).for_each(|set| text.push_str(&format!("*NSET,NSET=s{set},GENERATE\n1,5000\n")));
    // 25 million members in some 200 kB.
    let fault = from_bytes(Format::Abaqus, text.as_bytes()).expect_err("more than 100 members for each byte");
    assert!(matches!(fault.problem, FileProblem::TooLarge { .. }), "{fault}");
}
