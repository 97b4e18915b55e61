//! A run of fzg-c at coarse resolution.

use std::fs;

use crate::program::gearwear;

/// The scene, with snapshots after these hours.
pub fn scene(snapshots_h: &str) -> String {
    format!(
        "title = \"coarse\"\n[pair]\npreset = \"thesis-spur\"\n\
         [operation]\npinion_torque_Nm = 302.0\npinion_speed_rpm = 150.0\nhours = 127.75\nsnapshots_h = [{snapshots_h}]\n\
         [contact]\nsurface = \"winkler\"\ntip_contact = false\n[stiffness]\nmodel = \"constant\"\npair_N_per_mm_um = 20.0\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n\
         [numerics]\nflank_points = 200\npositions = 100\nstep = {{ revolutions = 19162.5 }}\nerror_estimate = false\nverify = false\n"
    )
}

/// A folder with the finished run of a scene in its folder `run`.
pub fn finished_run(scene: &str) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("given.toml"), scene).unwrap();
    let arguments = ["run", "--quiet", "--no-report", "--out", "run", "given.toml"];
    let output = gearwear().args(arguments).current_dir(folder.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
}
