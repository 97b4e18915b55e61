//! `gearwear mesh`: the mesh it writes, what it says of it, what it refuses.

use std::path::Path;

use assert_cmd::Command;
use gearwear::mesh;
use predicates::prelude::*;

use crate::program::preset;

/// The fzg-c scene with a `[fem]` table.
fn scene(fem: &str) -> String {
    format!("{}\n[fem]\n{fem}\n", preset("fzg-c"))
}

fn gearwear(folder: &Path, scene: &str, out: &str, more: &[&str]) -> assert_cmd::assert::Assert {
    let mut command = Command::cargo_bin("gearwear").unwrap();
    command.current_dir(folder).args(["mesh", "-", "--out", out]).args(more).write_stdin(scene.to_owned()).assert()
}

#[test]
fn the_plan_says_what_a_run_uses_the_table_for() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::cargo_bin("gearwear").unwrap();
    command.current_dir(folder.path()).args(["plan", "-"]).write_stdin(scene("body = \"ring\"")).assert().success();
    let mut command = Command::cargo_bin("gearwear").unwrap();
    let assert = command.args(["plan", "-"]).write_stdin(scene("body = \"ring\"")).assert().success();
    assert.stdout(predicate::str::contains("the surface fem: both gears meshed"));
}

/// One pitch of each gear in hexahedra, in every format alike.
#[test]
fn teeth_in_space_are_written_in_every_format() {
    let folder = tempfile::tempdir().unwrap();
    let meshes = ["teeth.json", "teeth.msh", "teeth.vtu", "teeth.inp"].map(|name| {
        let assert = gearwear(folder.path(), &preset("helical"), name, &["--three-dimensional"]).success().stderr("");
        assert
            .stdout(predicate::str::contains("twenty-node hexahedra").and(predicate::str::contains("scaled Jacobian")));
        mesh::read(folder.path().join(name)).unwrap()
    });
    let [first, others @ ..] = &meshes;
    for set in ["pinion_flank", "pinion_clamp", "wheel_left_cut", "wheel_right_cut"] {
        assert!(first.point_sets[set].len() > 100, "{set}");
    }
    let z = |mesh: &mesh::Mesh| mesh.points.iter().map(|point| point[2]).fold(0.0, f64::max);
    assert_eq!(z(first), 20.0, "the face width");
    for other in others {
        let cells = |mesh: &mesh::Mesh| mesh.cells.iter().map(|block| (block.kind, block.len())).collect::<Vec<_>>();
        assert_eq!(cells(first), cells(other));
        assert_eq!(first.points.len(), other.points.len());
    }
}

#[test]
fn loaded_teeth_have_displacement_and_stress() {
    let folder = tempfile::tempdir().unwrap();
    // A spur pair has no slices of its own, and its load is 302 N·m over the base radius.
    let options = ["--three-dimensional", "--loaded", "--position", "12.0"];
    gearwear(folder.path(), &preset("fzg-c"), "teeth.vtu", &options)
        .success()
        .stdout(predicate::str::contains("8927 N").and(predicate::str::contains("von Mises stress")));
    let mesh = mesh::read(folder.path().join("teeth.vtu")).unwrap();
    let values = |name: &str| match &mesh.point_data[name].values {
        mesh::Values::Reals(values) => values.clone(),
        mesh::Values::Integers(_) => panic!("{name}"),
    };
    let (u, stress, von_mises) = (values("displacement_mm"), values("stress_MPa"), values("von_mises_MPa"));
    assert_eq!([u.len(), stress.len(), von_mises.len()], [3, 6, 1].map(|count| count * mesh.points.len()));
    for node in mesh.point_sets["pinion_clamp"].iter().chain(&mesh.point_sets["wheel_clamp"]) {
        assert!(u[3 * node..3 * node + 3].iter().all(|u| *u == 0.0), "the clamp circle moves");
    }
    // The phase next to A may lie before it.
    let options = ["--three-dimensional", "--loaded", "--position", "4.4723"];
    gearwear(folder.path(), &preset("fzg-c"), "at-a.vtu", &options).success();
    // Some 10 µm, and a stress that steel bears in bending and beside the contact.
    let greatest = |values: &[f64]| values.iter().fold(0.0_f64, |most, value| most.max(value.abs()));
    assert!((0.005..0.05).contains(&greatest(&u)), "{}", greatest(&u));
    assert!((100.0..1500.0).contains(&greatest(&von_mises)), "{}", greatest(&von_mises));
}

#[test]
fn teeth_that_cannot_be_had_in_space_are_refused_at_their_key() {
    let folder = tempfile::tempdir().unwrap();
    let text = preset("helical").replace("face_width_mm = 20.0", "face_width_mm = 900.0");
    let options = ["--three-dimensional", "--loaded"];
    gearwear(folder.path(), &text, "teeth.vtu", &options)
        .code(2)
        .stderr(predicate::str::contains("pair.face_width_mm").and(predicate::str::contains("900")));
    assert!(!folder.path().join("teeth.vtu").exists());
}

/// A load so light that its contact asks for more elements than a tooth may have: the key that says how many is marked, by every command that
/// meshes.
#[test]
fn what_cannot_be_meshed_is_refused_at_its_key() {
    let folder = tempfile::tempdir().unwrap();
    let text = preset("fzg-c").replace("pinion_torque_Nm = 302.0", "pinion_torque_Nm = 1e-6");
    assert!(text.contains("1e-6"), "{text}");
    for (command, out) in [("mesh", "pair.msh"), ("fem", "out"), ("calibrate", "pair.calibration.json")] {
        let mut program = Command::cargo_bin("gearwear").unwrap();
        let assert =
            program.current_dir(folder.path()).args([command, "-", "--out", out]).write_stdin(text.clone()).assert();
        let marked =
            predicate::str::contains("fem.elements_per_half_width").and(predicate::str::contains("cannot be meshed"));
        assert.code(2).stderr(marked.and(predicate::str::contains("standard input:")));
        assert!(!folder.path().join(out).exists(), "{command}");
    }
}

#[test]
fn the_mesh_is_written_and_described() {
    let folder = tempfile::tempdir().unwrap();
    let text = scene("body = \"sector\"\nsector_teeth = 3\nelements_per_half_width = 8");
    let assert = gearwear(folder.path(), &text, "pair.json", &["--position", "13.0"]).success().stderr("");
    assert
        .stdout(predicate::str::contains("sectors of 3 teeth, sides free").and(predicate::str::contains("13.0000 mm")))
        .stdout(predicate::str::contains("minimum angle").and(predicate::str::contains("degrees of freedom")));
    let mesh = mesh::read(folder.path().join("pair.json")).unwrap();
    for set in [
        "pinion",
        "wheel",
        "pinion-flanks",
        "wheel-fillets",
        "pinion-tips",
        "wheel-clamp",
        "pinion-sides",
        "wheel-flank-0",
        "pinion-flank+1",
        "pinion-flank-1",
    ] {
        assert!(mesh.cell_sets.contains_key(set), "{set}: {:?}", mesh.cell_sets.keys());
    }
}

/// The formats that other programs read hold the same mesh, sets included.
#[test]
fn every_format_holds_the_mesh() {
    let folder = tempfile::tempdir().unwrap();
    let text = scene("body = \"sector\"\nelements_per_half_width = 2");
    let read = |name: &str| {
        gearwear(folder.path(), &text, name, &[]).success();
        mesh::read(folder.path().join(name)).unwrap()
    };
    let [json, msh, vtu] = ["pair.json", "pair.msh", "pair.vtu"].map(read);
    assert_eq!(json.points, vtu.points);
    assert_eq!(json.points.len(), msh.points.len());
    assert!(json.cell_sets.keys().eq(msh.cell_sets.keys()), "{:?}", msh.cell_sets.keys());
    assert!(json.cell_sets.keys().eq(vtu.cell_sets.keys()), "{:?}", vtu.cell_sets.keys());
}

#[test]
fn a_position_off_the_path_is_refused_with_what_is_allowed() {
    let folder = tempfile::tempdir().unwrap();
    for position in ["4.0", "-1", "24", "nan"] {
        // A and E of fzg-c: 4.4723 and 23.5695 mm, ISO 21771 on the data of ISO 14635-1.
        gearwear(folder.path(), &scene(""), "pair.json", &["--position", position])
            .code(2)
            .stderr(predicate::str::contains("--position").and(predicate::str::contains("(A) to")));
    }
    assert!(!folder.path().join("pair.json").exists());
}

#[test]
fn a_mesh_file_that_cannot_be_written_is_said() {
    let folder = tempfile::tempdir().unwrap();
    gearwear(folder.path(), &scene("body = \"sector\"\nelements_per_half_width = 8"), "nowhere/pair.json", &[])
        .code(2)
        .stderr(predicate::str::contains("--out"));
    gearwear(folder.path(), &scene(""), "pair.obj", &[])
        .code(2)
        .stderr(predicate::str::contains("--out").and(predicate::str::contains(".msh")));
}
