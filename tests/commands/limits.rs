//! Input without an end, and memory that cannot be had: refused at once, in one line, with nothing left behind.
#![cfg(unix)]

use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

use crate::program::{gearwear, preset};

/// Exit status and messages.
fn outcome(command: &mut Command) -> (Option<i32>, String) {
    let output = command.output().unwrap();
    (output.status.code(), String::from_utf8(output.stderr).unwrap())
}

/// A file of 5 GB that takes no room on the disk.
fn endless(path: &Path) {
    File::create(path).unwrap().set_len(5 << 30).unwrap();
}

#[test]
fn files_beyond_the_size_of_their_kind_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    ["scene.toml", "mesh.msh", "profile.csv", "curve.csv"].iter().for_each(|name| endless(&at(name)));
    let body = "body = [{ group = \"body\", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }]\n";
    fs::write(at("problem.toml"), format!("mesh = {{ file = \"mesh.msh\" }}\n{body}")).unwrap();
    let curve = format!(
        "{}\n[stiffness]\nmodel = \"simon\"\ncurve = \"curve.csv\"\n",
        preset("thesis-spur").replace("[stiffness]", "[fem]\n#")
    );
    let scene = curve.replace("model = \"constant\"", "#").replace("pair_N_per_mm_um", "# pair_N_per_mm_um");
    fs::write(at("curve.toml"), scene).unwrap();
    for (command, file, words) in [
        ("plan", "scene.toml", "scene.toml cannot be read: it exceeds 4 MB, the most of a scene"),
        ("fem", "problem.toml", "mesh.msh: it exceeds 1024 MB, the most of a mesh file"),
        ("plan", "curve.toml", "\"curve.csv\", which cannot be read: it exceeds 64 MB"),
    ] {
        let mut asked = gearwear();
        asked.arg(command).arg(at(file));
        if command == "fem" {
            asked.arg("--out").arg(at("out"));
        }
        let (status, said) = outcome(&mut asked);
        assert!(status == Some(2) && said.contains(words), "{file}: {status:?} {said}");
    }
    let (status, said) = outcome(gearwear().args(["plan", "/dev/zero"]));
    assert!(status == Some(2) && said.contains("/dev/zero cannot be read: it is a device"), "{said}");
    assert!(!at("out").exists());
}

#[test]
fn standard_input_without_an_end_is_refused() {
    let mut command = gearwear();
    command.args(["plan", "-"]).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let mut running = command.spawn().unwrap();
    let mut input = running.stdin.take().unwrap();
    // Until the program takes no more.
    while input.write_all(&[b'#'; 1 << 16]).is_ok() {}
    drop(input);
    let output = running.wait_with_output().unwrap();
    let said = String::from_utf8(output.stderr).unwrap();
    assert!(
        output.status.code() == Some(2) && said.contains("standard input cannot be read: it exceeds 4 MB"),
        "{said}"
    );
}

/// A line that no screen holds is named, and not shown.
#[test]
fn long_lines_are_named_by_their_number() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    fs::write(&scene, format!("# mine\ntitle = \"{}\n", "x".repeat(1 << 20))).unwrap();
    let (status, said) = outcome(gearwear().arg("plan").arg(&scene));
    assert!(
        status == Some(2) && said.contains("scene.toml, line 2: not TOML") && said.len() < 1000,
        "{} bytes",
        said.len()
    );
}

/// The program with so much address space, in MB.
#[cfg(target_os = "linux")]
fn within_mb(megabytes: u32) -> Command {
    let mut shell = Command::new("sh");
    let program = gearwear().get_program().to_owned();
    shell.args(["-c", &format!("ulimit -v {}; exec \"$0\" \"$@\"", 1024 * megabytes)]).arg(program);
    shell
}

/// 2000 slices take 2.4 GB.
#[cfg(target_os = "linux")]
#[test]
fn a_run_that_no_memory_is_left_for_does_not_begin() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    let text = "[pair]\npreset = \"helical\"\n[operation]\npinion_torque_Nm = 302.0\n\
                pinion_revolutions = 100.0\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n[contact]\nsurface = \"winkler\"\n\
                [helical]\nslices = 2000\ncoupling = \"none\"\n[numerics]\nflank_points = 300\npositions = 150\nverify = false\nerror_estimate = false\n";
    fs::write(&scene, text).unwrap();
    let out = folder.path().join("out");
    let (status, said) =
        outcome(within_mb(500).args(["run", "--quiet", "--threads", "1"]).arg(&scene).arg("--out").arg(&out));
    assert!(status == Some(3) && said.contains("GB of memory, more than can be had"), "{status:?} {said}");
    assert!(!out.exists());
}

/// The matrices of a pair's elements take some 50 MB each.
#[cfg(target_os = "linux")]
#[test]
fn matrices_that_no_memory_is_left_for_end_the_command() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("scene.toml");
    fs::write(&scene, preset("fzg-c")).unwrap();
    let out = folder.path().join("out");
    let mut command = within_mb(200);
    command.args(["fem", "--quiet", "--threads", "1"]).arg(&scene).arg("--out").arg(&out);
    let (status, said) = outcome(&mut command);
    assert!(status == Some(3) && said.contains("more memory than can be had"), "{status:?} {said}");
    assert!(!said.contains("panicked"), "{said}");
}

/// A square of 600 × 600 quadrilaterals: a file of 20 MB, which reading takes some 160 MB for and the stiffness some 540.
#[cfg(target_os = "linux")]
#[test]
fn a_mesh_that_no_memory_is_left_for_is_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let side = 600;
    let mut deck = "*NODE\n".to_owned();
    for node in 0..(side + 1) * (side + 1) {
        deck.push_str(&format!("{}, {}, {}\n", node + 1, node % (side + 1), node / (side + 1)));
    }
    deck.push_str("*ELEMENT, TYPE=CPE4, ELSET=BODY\n");
    for element in 0..side * side {
        let first = element / side * (side + 1) + element % side + 1;
        let nodes = [first, first + 1, first + side + 2, first + side + 1].map(|node| node.to_string());
        deck.push_str(&format!("{}, {}\n", element + 1, nodes.join(", ")));
    }
    deck.push_str(&format!("*NSET, NSET=BASE, GENERATE\n1, {}, 1\n", side + 1));
    fs::write(at("square.inp"), deck).unwrap();
    let problem = "mesh = { file = \"square.inp\" }\nbody = [{ group = \"BODY\", young_modulus_GPa = 210.0, poisson_ratio = 0.3 }]\n\
                   fixed = [{ group = \"BASE\" }]\n";
    fs::write(at("problem.toml"), problem).unwrap();
    for (megabytes, words) in
        [(200, "square.inp: reading it takes some"), (400, "the stiffness of this mesh takes some")]
    {
        let mut command = within_mb(megabytes);
        command.args(["fem", "--quiet", "--threads", "1"]).arg(at("problem.toml")).arg("--out").arg(at("out"));
        let (status, said) = outcome(&mut command);
        assert!(
            status == Some(3) && said.contains(words) && said.contains("more than can be had"),
            "{status:?} {said}"
        );
        assert!(!at("out").exists());
    }
}
