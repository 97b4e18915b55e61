//! Wrong input, one test each: exit status 2, and a message with file, line, key, what was found and what is allowed.

use std::fs;
use std::hash::{DefaultHasher, Hash, Hasher};
use std::path::{Path, PathBuf};

use assert_cmd::Command;

use crate::program::preset;

/// The fzg-c scene with its lines exchanged, in a folder of its own.
struct Case {
    folder: tempfile::TempDir,
    text: String,
}

/// What the program said.
struct Refusal {
    message: String,
}

impl Case {
    /// The fzg-c scene as `gearwear init` prints it.
    fn fzg_c() -> Self {
        Self::of(&preset("fzg-c"))
    }

    /// A scene of one's own.
    fn of(text: &str) -> Self {
        Self { folder: tempfile::tempdir().unwrap(), text: text.to_owned() }
    }

    /// Exchanges the line that begins with `key` in the table `[table]`.
    fn with(mut self, table: &str, key: &str, line: &str) -> Self {
        let header = format!("[{table}]");
        let mut inside = table.is_empty();
        let mut done = false;
        let lines: Vec<&str> = self
            .text
            .lines()
            .map(|old| {
                if old.starts_with('[') {
                    inside = old.starts_with(&header);
                }
                if inside && !done && old.trim_start_matches("# ").split('=').next().unwrap().trim() == key {
                    done = true;
                    line
                } else {
                    old
                }
            })
            .collect();
        assert!(done, "no {key} in [{table}]");
        self.text = lines.join("\n");
        self
    }

    fn scene(&self) -> PathBuf {
        let path = self.folder.path().join("scene.toml");
        fs::write(&path, &self.text).unwrap();
        path
    }

    fn gearwear(&self, out: &Path) -> Command {
        let mut command = Command::cargo_bin("gearwear").unwrap();
        command.args(["run", "--quiet", "--out"]).arg(out).arg(self.scene());
        command
    }

    /// Runs the scene, which must be refused without leaving anything behind.
    fn refused(&self) -> Refusal {
        let out = self.folder.path().join("out");
        let output = self.gearwear(&out).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(output.stdout.is_empty());
        assert!(!out.exists(), "something was left behind");
        assert!(message.contains("scene.toml"), "{message}");
        self.hand_to_python();
        Refusal { message }
    }

    /// Leaves the scene where the tests of the Python package look for scenes that must be refused there in the same words.
    fn hand_to_python(&self) {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("bad_input");
        fs::create_dir_all(&folder).unwrap();
        let mut hasher = DefaultHasher::new();
        self.text.hash(&mut hasher);
        // Named by its contents: Python may be reading what an earlier run has left.
        let scene = folder.join(format!("{:016x}.toml", hasher.finish()));
        if !scene.exists() {
            fs::write(scene, &self.text).unwrap();
        }
    }

    /// Plans the scene, which must be accepted, and gives the warnings.
    fn warnings(&self) -> String {
        let mut command = Command::cargo_bin("gearwear").unwrap();
        let output = command.arg("plan").arg(self.scene()).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(0), "{message}");
        message
    }

    /// The number of the line that begins with `start`, counted from 1.
    fn line_of(&self, start: &str) -> usize {
        1 + self.text.lines().position(|line| line.starts_with(start)).unwrap()
    }
}

impl Refusal {
    /// The message says all of this.
    fn says(&self, parts: &[&str]) -> &Self {
        for part in parts {
            assert!(self.message.contains(part), "no {part:?} in:\n{}", self.message);
        }
        self
    }

    /// The message points at this line of the scene.
    fn at_line(&self, line: usize) -> &Self {
        self.says(&[&format!("scene.toml:{line}:")])
    }
}

#[test]
fn unknown_key_with_the_nearest_known_one() {
    let case = Case::fzg_c().with("pair", "face_width_mm", "face_widht_mm = 14.0");
    let line = case.line_of("face_widht_mm");
    case.refused().at_line(line).says(&["unknown key pair.face_widht_mm", "did you mean face_width_mm?", "allowed:"]);
}

#[test]
fn known_key_in_the_wrong_table() {
    let case = Case::fzg_c().with("pair", "face_width_mm", "face_width_mm = 14.0\nteeth = 16");
    case.refused().says(&[
        "unknown key pair.teeth",
        "teeth belongs in [pair.pinion] or [pair.pinion.cutter] or [pair.wheel] or [pair.wheel.cutter]",
    ]);
}

#[test]
fn wrong_type() {
    let case = Case::fzg_c().with("pair.wheel", "teeth", "teeth = \"twenty-four\"");
    let line = case.line_of("teeth = \"");
    case.refused().at_line(line).says(&[
        "pair.wheel.teeth",
        "found the text \"twenty-four\"",
        "allowed: a whole number at least 5",
    ]);
}

#[test]
fn missing_key() {
    let case = Case::fzg_c().with("operation", "pinion_torque_Nm", "");
    let line = case.line_of("[operation]");
    case.refused().at_line(line).says(&["operation.pinion_torque_Nm is missing", "a number greater than 0"]);
}

#[test]
fn missing_table() {
    let case = Case::of("[pair]\npreset = \"fzg-c\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n");
    case.refused().says(&["operation is missing", "pinion_torque_Nm"]);
}

#[test]
fn missing_gear_data_can_come_from_a_preset() {
    let case = Case::fzg_c().with("pair.pinion", "profile_shift", "").with("pair", "normal_module_mm", "");
    case.refused().says(&[
        "pair.pinion.profile_shift is missing",
        "pair.normal_module_mm is missing",
        "or give pair.transverse_module_mm or pair.preset",
    ]);
}

#[test]
fn teeth_below_five() {
    let case = Case::fzg_c().with("pair.pinion", "teeth", "teeth = 4");
    let line = case.line_of("teeth = 4");
    case.refused().at_line(line).says(&["pair.pinion.teeth", "found 4", "at least 5"]);
}

#[test]
fn negative_width() {
    let case = Case::fzg_c().with("pair", "face_width_mm", "face_width_mm = -14.0");
    let line = case.line_of("face_width_mm");
    case.refused().at_line(line).says(&["pair.face_width_mm", "found -14", "greater than 0"]);
}

#[test]
fn numbers_that_are_none() {
    for word in ["nan", "inf", "-inf"] {
        let case = Case::fzg_c().with("operation", "pinion_torque_Nm", &format!("pinion_torque_Nm = {word}"));
        case.refused().says(&["operation.pinion_torque_Nm", "greater than 0"]);
    }
}

#[test]
fn contact_ratio_below_one() {
    // Tips some 2 mm lower: the path of contact of 19.1 mm shrinks to 9.9 mm, below the base pitch of 13.3 mm.
    let case = Case::fzg_c().with("pair.pinion", "tip_diameter_mm", "tip_diameter_mm = 78.0").with(
        "pair.wheel",
        "tip_diameter_mm",
        "tip_diameter_mm = 113.5",
    );
    case.refused().says(&["contact ratio", "at least 1", "pair.centre_distance_mm"]);
}

#[test]
fn pointed_tooth() {
    // With x = 1.2 the flanks of 16 teeth meet near 91 mm; everything else of this pair is sound.
    let case = Case::fzg_c()
        .with("pair", "centre_distance_mm", "centre_distance_mm = 94.8")
        .with("pair.pinion", "profile_shift", "profile_shift = 1.2")
        .with("pair.pinion", "tip_diameter_mm", "tip_diameter_mm = 92.0")
        .with("pair.wheel", "profile_shift", "profile_shift = 0.0")
        .with("pair.wheel", "tip_diameter_mm", "");
    let line = case.line_of("tip_diameter_mm = 92");
    case.refused().at_line(line).says(&["pair.pinion.tip_diameter_mm", "pointed", "allowed: a tip diameter below"]);
}

#[test]
fn interference() {
    // The tip of the wheel, 0.2 modules longer than the rack's, runs into the fillet of the pinion.
    let case = Case::of(
        "[pair]\nnormal_module_mm = 4.5\npressure_angle_deg = 20.0\ncentre_distance_mm = 157.6\nface_width_mm = 14.0\n\
         [pair.pinion]\nteeth = 20\nprofile_shift = 0.0\n[pair.wheel]\nteeth = 50\nprofile_shift = 0.0\n\
         tip_diameter_mm = 235.8\n[operation]\npinion_torque_Nm = 100.0\npinion_revolutions = 1e6\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n",
    );
    let line = case.line_of("tip_diameter_mm");
    case.refused().at_line(line).says(&[
        "interference on the pinion",
        "pair.wheel.tip_diameter_mm",
        "allowed: a tip diameter of the wheel of at most 23",
        "pair.pinion.profile_shift",
    ]);
}

#[test]
fn a_rack_that_is_pointed() {
    // (π/4)/tan 35° = 1.12166: there the flanks of the rack meet.
    let case = Case::fzg_c().with("pair", "pressure_angle_deg", "pressure_angle_deg = 35.0");
    case.refused().says(&["pair.basic_rack.dedendum_factor", "the rack is pointed", "at most 1.1216"]);
}

#[test]
fn what_the_model_does_not_hold() {
    let crossed = Case::fzg_c().with("pair", "face_width_mm", "face_width_mm = 14.0\nhelix_angle_deg = 67.5");
    crossed.refused().says(&["pair.helix_angle_deg", "found 67.5", "crossed axes", "not in the model"]);
}

#[test]
fn inches_and_pounds() {
    // m = 25.4/8 = 3.175 mm; 3.5 in = 88.9 mm; 635 lbf·in = 71.745 N·m.
    let case = Case::of(
        "[pair]\ndiametral_pitch = 8\npressure_angle_deg = 20.0\ncentre_distance_in = 3.5\nface_width_in = 1.0\n\
         [pair.pinion]\nteeth = 28\nprofile_shift = 0.0\n[pair.wheel]\nteeth = 28\nprofile_shift = 0.0\n\
         [operation]\npinion_torque_lbin = 635\npinion_revolutions = 1e6\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-18\n",
    );
    case.refused().says(&[
        "unknown key pair.diametral_pitch",
        "m = 25.4/DP",
        "normal_module_mm = 3.175",
        "centre_distance_mm = 88.9",
        "face_width_mm = 25.4",
        "pinion_torque_Nm = 71.7454",
        "1 lbf·in = 0.112985 N·m",
    ]);
}

#[test]
fn tip_below_base_circle() {
    // The pinion's base circle has 67.6577 mm (twice 33.8289 mm).
    let case = Case::fzg_c().with("pair.pinion", "tip_diameter_mm", "tip_diameter_mm = 67.0");
    let line = case.line_of("tip_diameter_mm = 67");
    case.refused().at_line(line).says(&["pair.pinion.tip_diameter_mm", "form circle", "67.72"]);
}

#[test]
fn negative_backlash() {
    let case = Case::fzg_c().with("pair", "centre_distance_mm", "centre_distance_mm = 91.0");
    let line = case.line_of("centre_distance_mm");
    case.refused().at_line(line).says(&[
        "pair.centre_distance_mm",
        "the teeth interfere",
        "allowed: a centre distance of at least 91.",
    ]);
}

#[test]
fn no_mesh() {
    // The base radii add up to 84.572 mm.
    let case = Case::fzg_c().with("pair", "centre_distance_mm", "centre_distance_mm = 80.0");
    let line = case.line_of("centre_distance_mm");
    case.refused().at_line(line).says(&["pair.centre_distance_mm", "base circles overlap", "84.57"]);
}

#[test]
fn zero_torque() {
    let case = Case::fzg_c().with("operation", "pinion_torque_Nm", "pinion_torque_Nm = 0");
    let line = case.line_of("pinion_torque_Nm");
    case.refused().at_line(line).says(&["operation.pinion_torque_Nm", "found 0", "greater than 0"]);
}

#[test]
fn incompressible_material() {
    let case = Case::fzg_c().with("material", "poisson_ratio", "poisson_ratio = 0.5");
    let line = case.line_of("poisson_ratio");
    case.refused().at_line(line).says(&["material.poisson_ratio", "found 0.5", "less than 0.5"]);
}

#[test]
fn two_keys_for_the_duration() {
    let case = Case::fzg_c().with("operation", "hours", "hours = 127.75\npinion_revolutions = 1e6");
    let line = case.line_of("pinion_revolutions");
    case.refused().at_line(line).says(&["operation.hours and operation.pinion_revolutions", "say the same thing"]);
}

#[test]
fn other_pairs_of_keys_that_say_the_same() {
    for (table, key, lines, named) in [
        (
            "pair",
            "normal_module_mm",
            "normal_module_mm = 4.5\ntransverse_module_mm = 4.5",
            "pair.normal_module_mm and pair.transverse_module_mm",
        ),
        (
            "contact",
            "surface",
            "match = \"approach\"\nfoundation_MPa_per_mm = 5e5",
            "contact.match and contact.foundation_MPa_per_mm",
        ),
        (
            "wear",
            "coefficient_m2_per_N",
            "coefficient_m2_per_N = 1e-17\ncoefficient_mm3_per_Nm = 1e-8",
            "wear.coefficient_m2_per_N and wear.coefficient_mm3_per_Nm",
        ),
        (
            "material",
            "poisson_ratio",
            "poisson_ratio = 0.3\npinion = { poisson_ratio = 0.3 }",
            "material.poisson_ratio and material.pinion.poisson_ratio",
        ),
    ] {
        let case = Case::fzg_c().with(table, key, lines);
        case.refused().says(&[named, "say the same thing"]);
    }
}

#[test]
fn preset_that_does_not_exist() {
    let case = Case::of(
        "[pair]\npreset = \"fzg-d\"\n[operation]\npinion_torque_Nm = 302\npinion_revolutions = 1e6\n\
         [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n",
    );
    case.refused().at_line(2).says(&[
        "pair.preset",
        "found \"fzg-d\"",
        "\"fzg-c\", \"thesis-spur\", \"fzg-test\", \"thesis-fzg-test\", \"fzg-a\"",
        "did you mean",
    ]);
    let mut init = Command::cargo_bin("gearwear").unwrap();
    let output = init.args(["init", "fzg-cc"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("fzg-cc") && message.contains("did you mean fzg-c?") && message.contains("fzg-a"));
}

#[test]
fn output_folder_that_cannot_be_written() {
    let case = Case::fzg_c();
    let file = case.folder.path().join("file");
    fs::write(&file, "in the way").unwrap();
    for out in [file.clone(), file.join("below")] {
        let output = case.gearwear(&out).output().unwrap();
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{message}");
        assert!(message.contains("--out") && message.contains("file"), "{message}");
    }
    assert_eq!(fs::read_to_string(&file).unwrap(), "in the way");
}

/// Drawings say where a relief begins, how much backlash there is, and which class a helix slope is of: once, and within the gear.
#[test]
fn data_of_drawings() {
    let relief = |lines: &str| {
        Case::fzg_c().with("pair.pinion", "tip_diameter_mm", &format!("tip_diameter_mm = 82.46\n{lines}"))
    };
    for (lines, parts) in [
        (
            "tip_relief = { amount_um = 20.0, length_mm = 2.0, begins_at_diameter_mm = 80.1 }",
            &["tip_relief.length_mm and pair.pinion.tip_relief.begins_at_diameter_mm", "say the same thing"][..],
        ),
        (
            "tip_relief = { amount_um = 20.0 }",
            &["pair.pinion.tip_relief.length_mm is missing", "begins_at_diameter_mm", "begins_at_roll_angle_deg"],
        ),
        (
            "tip_relief = { amount_um = 20.0, begins_at_diameter_mm = 82.46 }",
            &[
                "tip_relief.begins_at_diameter_mm: found 82.46",
                "at the start of active profile",
                "82.4600 mm at the tip",
            ],
        ),
        (
            "root_relief = { amount_um = 20.0, begins_at_diameter_mm = 60.0 }",
            &["root_relief.begins_at_diameter_mm: found 60", "between 68.2"],
        ),
        (
            "root_relief = { amount_um = 20.0, begins_at_roll_angle_deg = 45.0 }",
            &["root_relief.begins_at_roll_angle_deg: found 45", "39.9", "° at the tip circle"],
        ),
        ("end_relief = { amount_um = 20.0, begins_at_diameter_mm = 80.1 }", &["unknown key", "end_relief.begins_at"]),
        ("helix_slope_class = 12", &["pair.pinion.helix_slope_class: found 12", "at least 1 and at most 11"]),
        (
            "helix_slope_class = 6\nhelix_slope_deviation_um = 8.0",
            &["helix_slope_deviation_um and pair.pinion.helix_slope_class", "say the same thing"],
        ),
    ] {
        let case = relief(lines);
        let at = case.line_of(lines.lines().next().unwrap().split(' ').next().unwrap());
        let refused = case.refused();
        refused.says(parts);
        if !lines.contains('\n') {
            refused.at_line(at);
        }
    }
    let distance = |lines: &str| Case::fzg_c().with("pair", "centre_distance_mm", lines);
    distance("centre_distance_mm = 91.5\nbacklash_um = 50.0")
        .refused()
        .says(&["pair.centre_distance_mm and pair.backlash_um", "say the same thing"]);
    distance("backlash_um = 50.0\nnormal_backlash_um = 50.0").refused().says(&["say the same thing"]);
    distance("backlash_um = -1.0").refused().says(&["pair.backlash_um: found -1", "at least 0"]);
    distance("").refused().says(&["pair.centre_distance_mm is missing", "pair.backlash_um = 0"]);
    // So much that a tooth leaves before the next one comes.
    let case = distance("backlash_um = 4000.0");
    case.refused().at_line(case.line_of("backlash_um")).says(&["pair.backlash_um", "contact ratio", "centre distance"]);
    let case =
        distance("backlash_um = 50.0").with("pair.wheel", "teeth", "teeth = 24\ntooth_thickness_allowance_um = -5000");
    case.refused()
        .at_line(case.line_of("backlash_um"))
        .says(&["pair.backlash_um: found 50; allowed: more than", "thin"]);
}

/// Every value with a decimal comma, at its line and with its key.
#[test]
fn decimal_commas() {
    let case = Case::fzg_c().with("pair", "face_width_mm", "face_width_mm = 30,5").with(
        "pair.wheel",
        "teeth",
        "teeth = 24\nroot_relief = { amount_um = 7,5, length_mm = 2.0 }",
    );
    let refused = case.refused();
    for (start, key, found, meant) in [
        ("face_width_mm", "pair.face_width_mm", "30,5", "write 30.5"),
        ("root_relief", "pair.wheel.root_relief.amount_um", "7,5", "write 7.5"),
    ] {
        let said = format!("{key}: found {found}; allowed: a decimal point, not a comma");
        refused.at_line(case.line_of(start)).says(&[&said, meant]);
    }
    let list = Case::fzg_c().with("operation", "snapshots_h", "snapshots_h = [1,5, 2,5]");
    list.refused().at_line(list.line_of("snapshots_h")).says(&["commas separate times", "after a point"]);
}

#[test]
fn truncated_file() {
    let mut case = Case::fzg_c();
    let cut = case.text.find("snapshots_h = [0.25, ").unwrap() + "snapshots_h = [0.25, ".len();
    case.text.truncate(cut);
    let line = case.text.lines().count();
    case.refused().at_line(line).says(&["not TOML"]);
}

#[test]
fn file_that_is_no_text() {
    let case = Case::of("");
    let scene = case.scene();
    fs::write(&scene, b"title = \"x\"\ntitle = \"\xff\"\n").unwrap();
    let output = Command::cargo_bin("gearwear").unwrap().arg("plan").arg(&scene).output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(message.contains("scene.toml") && message.contains("UTF-8") && message.contains("line 2"), "{message}");
}

#[test]
fn file_that_is_not_there() {
    let output = Command::cargo_bin("gearwear").unwrap().args(["plan", "nowhere.toml"]).output().unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8(output.stderr).unwrap().contains("nowhere.toml"));
}

#[test]
fn snapshots_out_of_order_or_beyond_the_end() {
    for (list, place) in
        [("[1.0, 0.5]", "snapshots_h[1]"), ("[1.0, 200.0]", "snapshots_h[1]"), ("[0.0]", "snapshots_h[0]")]
    {
        let case = Case::fzg_c().with("operation", "snapshots_h", &format!("snapshots_h = {list}"));
        case.refused().says(&[&format!("operation.{place}")]);
    }
}

#[test]
fn hours_without_a_speed() {
    let case = Case::fzg_c().with("operation", "pinion_speed_rpm", "");
    case.refused().says(&["operation.pinion_speed_rpm is missing", "operation.hours needs the speed"]);
}

#[test]
fn constant_stiffness_without_its_value() {
    let case = Case::fzg_c().with("contact", "surface", "surface = \"winkler\"\n[stiffness]\nmodel = \"constant\"");
    case.refused().says(&["stiffness.pair_N_per_mm_um is missing", "\"constant\" needs it"]);
}

#[test]
fn temperatures_out_of_range_or_without_a_speed() {
    let with = |table: &str| Case::fzg_c().with("numerics", "error_estimate", &format!("[temperature]\n{table}"));
    for (line, says) in [
        ("bulk_temperature_C = -273.15", "-273.15"),
        ("bulk_temperature_C = -300.0", "-273.15"),
        ("bulk_temperature_C = nan", "bulk_temperature_C"),
        ("friction_coefficient = 0.0", "friction_coefficient"),
        ("method = \"blok\"", "tian-kennedy"),
        ("velocity = \"rolling\"", "surface"),
        ("partition = 0.5", "partition"),
    ] {
        let case = with(line);
        let line = case.line_of(line.split(' ').next().unwrap());
        case.refused().at_line(line).says(&[says]);
    }
    for law in ["adsorption", "oxidation"] {
        let text = Case::fzg_c()
            .text
            .replace("pinion_speed_rpm = 150.0", "")
            .replace("hours = 127.75 ", "pinion_revolutions = 1e6 ");
        let text =
            text.replace("snapshots_h", "# snapshots_h").replace("law = \"archard\"", &format!("law = \"{law}\""));
        let case = Case { text, folder: tempfile::tempdir().unwrap() };
        case.refused().says(&["operation.pinion_speed_rpm", &format!("wear.law = \"{law}\" needs the speed")]);
    }
}

#[test]
fn temperatures_of_plastic_teeth() {
    let with = |friction: &str, table: &str| {
        let tables = format!("[temperature]\n{friction}\n[temperature.tooth]\n{table}");
        Case::fzg_c().with("numerics", "verify", &tables)
    };
    let some = "ambient_temperature_C = 20.0\nlubrication = \"oil\"";
    for (table, key, says) in [
        ("lubrication = \"oil\"", "ambient_temperature_C", "missing"),
        ("ambient_temperature_C = 353.15\nlubrication = \"oil\"", "ambient_temperature_C", "353.15"),
        ("ambient_temperature_C = 20.0", "lubrication", "or give temperature.tooth.flank_heat_coefficient"),
        ("ambient_temperature_C = 20.0\nlubrication = \"grease\"", "lubrication", "\"dry\""),
        ("ambient_temperature_C = 20.0\nlubrication = \"dry\"", "lubrication", "two gears of metal"),
        ("ambient_temperature_C = 20.0\nflank_heat_coefficient = 4e3", "root_heat_coefficient", "missing"),
        ("ambient_temperature_C = 20.0\nroot_heat_coefficient = 4e3", "flank_heat_coefficient", "missing"),
        (&format!("{some}\nflank_heat_coefficient = -1.0"), "flank_heat_coefficient", "-1"),
        (&format!("{some}\nroot_heat_coefficient = 900.0"), "root_heat_coefficient", "say the same thing"),
        (&format!("{some}\nhousing_resistance_K_m2_per_W = 0.06"), "housing_area_m2", "missing"),
        (&format!("{some}\nhousing_resistance_K_m2_per_W = 60.0"), "housing_resistance_K_m2_per_W", "at most 1"),
        (&format!("{some}\nhousing_area_m2 = 0.0"), "housing_area_m2", "greater than 0"),
        (&format!("{some}\nhousing_area_m2 = 10000.0"), "housing_area_m2", "did you mean 0.01? (mm² given for m²)"),
        (&format!("{some}\nduty_cycle = 40.0"), "duty_cycle", "did you mean 0.4? (% given for a part of 1)"),
    ] {
        with("friction_coefficient = 0.1", table).refused().says(&[&format!("temperature.tooth.{key}"), says]);
    }
    with("", some).refused().says(&["temperature.friction_coefficient is missing", "[temperature.tooth] needs it"]);
}

#[test]
fn wear_that_follows_the_film() {
    let with = |film: &str, more: &str| {
        Case::fzg_c().with("wear", "law", &format!("law = \"archard\"\nfilm = {{ {film} }}\n{more}"))
    };
    let table = |lambda: &str, factor: &str| with(&format!("lambda = [{lambda}], factor = [{factor}]"), "");
    with("law = \"priest-taylor\"", "")
        .refused()
        .says(&["lubricant.temperature_C is missing", "[wear.film] needs the table [lubricant]"]);
    with("ratio = \"composite\"", "").refused().says(&["wear.film.law is missing", "\"priest-taylor\""]);
    with("law = \"stribeck\"", "").refused().says(&["stribeck", "priest-taylor"]);
    for (lambda, factor, says) in [
        ("1.0", "1.0", "two"),
        ("0.5, 4.0", "1.0", "two"),
        ("0.5, 4.0", "0.0, 0.0", "0 at every film"),
        ("0.5, 4.0", "1.0, 0.5, 0.0", "as many as wear.film.lambda"),
        ("0.5, -4.0", "1.0, 0.0", "-4"),
        ("0.5, 4.0", "1.0, -0.1", "-0.1"),
        ("0.5, nan", "1.0, 0.0", "nan"),
    ] {
        table(lambda, factor).refused().says(&["wear.film", says]);
    }
}

#[test]
fn traction_curves() {
    let with = |table: &str| Case::fzg_c().with("numerics", "verify", &format!("[friction]\n{table}"));
    for (table, says) in [
        ("model = \"table\"", "friction.table.slide_to_roll_ratio is missing"),
        ("table = { slide_to_roll_ratio = [0.0, 0.1] }", "friction.table.coefficient is missing"),
        ("table = { slide_to_roll_ratio = [0.1, 0.1], coefficient = [0.0, 0.05] }", "greater than 0.1"),
        ("table = { slide_to_roll_ratio = [0.0, 0.1, 0.2], coefficient = [0.0, 0.05] }", "as many as"),
        ("table = { slide_to_roll_ratio = [0.0, 0.1], coefficient = [0.0, 5.0] }", "at most 2"),
        (
            "model = \"xu\"\ntable = { slide_to_roll_ratio = [0.0, 0.1], coefficient = [0.0, 0.05] }",
            "needs the table [lubricant]",
        ),
    ] {
        with(table).refused().says(&[says]);
    }
}

#[test]
fn what_follows_the_temperature_of_teeth() {
    let tooth = "[temperature]\nfriction_coefficient = 0.1\n[temperature.tooth]\nambient_temperature_C = 40.0\nlubrication = \"oil\"";
    let with = |material: &str, wear: &str, more: &str| {
        let case = Case::fzg_c().with("material", "young_modulus_GPa", material).with(
            "wear",
            "law",
            &format!("law = \"archard\"\n{wear}"),
        );
        case.with("numerics", "verify", more)
    };
    let modulus = "young_modulus_GPa = 206.0";
    let curve = |celsius: &str, gpa: &str| {
        format!("young_modulus_curve = {{ temperature_C = [{celsius}], young_modulus_GPa = [{gpa}] }}")
    };
    let warm = |celsius: &str, factor: &str| format!("warm = {{ temperature_C = [{celsius}], factor = [{factor}] }}");
    let needed = "needs the table [temperature.tooth]";
    with(&curve("20.0, 80.0", "3.0, 1.5"), "", "")
        .refused()
        .says(&["temperature.tooth.ambient_temperature_C is missing", needed]);
    with(modulus, &warm("20.0, 80.0", "1.0, 3.0"), "")
        .refused()
        .says(&["temperature.tooth.ambient_temperature_C is missing", needed]);
    for (material, says) in [
        (curve("20.0", "3.0"), "material.young_modulus_curve.temperature_C"),
        (curve("80.0, 20.0", "3.0, 1.5"), "greater than 80"),
        (curve("20.0, 80.0", "3.0"), "material.young_modulus_curve.young_modulus_GPa"),
        (curve("20.0, 80.0", "3.0, 0.0"), "young_modulus_GPa[1]"),
        (curve("20.0, 80.0", "3000.0, 1500.0"), "young_modulus_GPa[0]"),
        (format!("{modulus}\n{}", curve("20.0, 80.0", "3.0, 1.5")), "say the same thing"),
    ] {
        with(&material, "", tooth).refused().says(&[says]);
    }
    for (wear, says) in [
        (warm("20.0", "1.0"), "wear.warm.temperature_C"),
        (warm("20.0, 80.0", "1.0, 0.0"), "wear.warm.factor[1]"),
        (warm("353.15, 293.15", "1.0, 3.0"), "greater than 353.15"),
    ] {
        with(modulus, &wear, tooth).refused().says(&[says]);
    }
}

#[test]
fn constants_of_wear_laws_out_of_range() {
    for (law, line) in [
        ("adsorption", "molecule_diameter_nm = 0.0"),
        ("adsorption", "vibration_time_ps = -1.0"),
        ("adsorption", "heat_of_adsorption_kJ_per_mol = -1.0"),
        ("oxidation", "arrhenius_constant_kg_per_m2s = 0.0"),
        ("oxidation", "activation_energy_kJ_per_mol = -5.0"),
        ("oxidation", "density_kg_per_m3 = 0.0"),
        ("oxidation", "mass_ratio = \"printed\""),
    ] {
        let case = Case::fzg_c().with("wear", "law", &format!("law = \"{law}\"")).with(
            "numerics",
            "error_estimate",
            &format!("[wear.{law}]\n{line}"),
        );
        let key = line.split(' ').next().unwrap();
        case.refused().says(&[&format!("wear.{law}.{key}")]);
    }
}

/// What is wrong with the law of one gear is said with its key, and what both say together with what is allowed.
#[test]
fn wear_laws_of_each_gear() {
    // The last key of the file, so that nothing stands behind the table.
    let case = |lines: &str| Case::fzg_c().with("numerics", "verify", lines);
    for (lines, says) in [
        ("[wear.pinion]\ncoefficient_m2_per_N = -1e-17", ["wear.pinion.coefficient_m2_per_N", "at least 0"]),
        ("[wear.wheel]\ncoefficient_mm3_per_Nm = -1.0", ["wear.wheel.coefficient_mm3_per_Nm", "at least 0"]),
        (
            "[wear.wheel]\ncoefficient_m2_per_N = 1e-17\ncoefficient_mm3_per_Nm = 1e-8",
            ["wear.wheel.coefficient_m2_per_N and wear.wheel.coefficient_mm3_per_Nm", "say the same"],
        ),
        (
            "[wear.pinion]\ncoefficient_m2_per_N = 0.0\n[wear.wheel]\ncoefficient_m2_per_N = 0",
            ["0 for both gears", "greater than 0 for one gear at least"],
        ),
        ("[wear.pinion]\nlaw = \"magic\"", ["wear.pinion.law", "archard"]),
        ("[wear.pinion]\ncoefficent_m2_per_N = 1e-17", ["wear.pinion.coefficent_m2_per_N", "coefficient_m2_per_N"]),
        ("[wear.wheel]\nsevere = { above_MPa = 0.0, factor = 9.0 }", ["wear.wheel.severe.above_MPa", "greater than 0"]),
        ("[wear.pinion.adsorption]\nmolecule_diameter_nm = 0.0", ["wear.pinion.adsorption.molecule_diameter_nm", "0"]),
        ("[wear.pinion.oxidation]\ndensity_kg_per_m3 = -1.0", ["wear.pinion.oxidation.density_kg_per_m3", "0"]),
    ] {
        case(lines).refused().says(&says);
    }
    let slip = case("[wear.wheel]\ncoefficient_m2_per_N = 1e-11").warnings();
    assert!(slip.contains("wear.wheel.coefficient_m2_per_N = 1e-11: did you mean 1e-17?"), "{slip}");
    let unused = case("[wear.wheel.oxidation]\ndensity_kg_per_m3 = 7800.0").warnings();
    assert!(unused.contains("[wear.wheel.oxidation] is not used"), "{unused}");

    let least = |phase: &str, wear: &str| {
        Case::of(&format!(
            "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\n\
             [[operation.phases]]\npinion_revolutions = 1e5\n{phase}\n[wear]\n{wear}\n"
        ))
    };
    let k = "coefficient_m2_per_N = 1e-17";
    least("", k).refused().says(&["wear.law", "archard"]);
    least("", &format!("pinion.law = \"archard\"\n{k}")).refused().says(&["wear.wheel.law", "or give wear.law"]);
    least("", "law = \"archard\"").refused().says(&["wear.coefficient_m2_per_N", "a number greater than 0"]);
    least("", &format!("law = \"archard\"\nwheel.{k}")).refused().says(&["wear.pinion.coefficient_m2_per_N"]);
    let differ = format!("law = \"archard\"\n{k}\nwheel.coefficient_m2_per_N = 0.0");
    least(k, &differ).refused().says(&["operation.phases[0].coefficient_m2_per_N", "one for each gear"]);
    least("pinion.coefficient_m2_per_N = 0.0", &differ).refused().says(&["operation.phases[0]", "0 for both gears"]);
    let negative = "wheel.coefficient_mm3_per_Nm = -1.0";
    least(negative, &differ).refused().says(&["operation.phases[0].wheel.coefficient_mm3_per_Nm", "at least 0"]);
}

#[test]
fn helical_pairs_out_of_range() {
    for (table, key, line, at, says) in [
        ("pair", "face_width_mm", "face_width_mm = 14.0\nhelix_angle_deg = 60.0", "helix_angle_deg", "at most 45"),
        ("pair.pinion", "teeth", "teeth = 16\nlead_crowning_um = -5.0", "lead_crowning_um", "at least 0"),
        ("numerics", "error_estimate", "[helical]\nslices = 0", "slices", "at least 1"),
        ("numerics", "error_estimate", "[helical]\ncoupling = \"yes\"", "coupling", "slicing"),
        (
            "pair.wheel",
            "teeth",
            "teeth = 24\nend_relief = { amount_um = 10.0, length_mm = 8.0 }",
            "end_relief",
            "at most 7 mm",
        ),
        (
            "pair.wheel",
            "teeth",
            "teeth = 24\nhelix_slope_deviation_um = -9000.0",
            "helix_slope_deviation_um",
            "at most 1125 µm",
        ),
        (
            "pair.pinion",
            "teeth",
            "teeth = 16\nshaft = { diameter_mm = 40.0, bore_diameter_mm = 50.0 }",
            "shaft",
            "less than pair.pinion.shaft.diameter_mm, 40 mm",
        ),
        (
            "pair",
            "face_width_mm",
            "face_width_mm = 14.0\naxis_parallelism = { out_of_plane_um = -9000.0 }",
            "axis_parallelism",
            "at most 1125 µm",
        ),
    ] {
        let case = Case::fzg_c().with(table, key, line);
        let line = case.line_of(at);
        case.refused().at_line(line).says(&[says]);
    }
    Case::fzg_c()
        .with("pair.pinion", "teeth", "teeth = 16\nshaft = { diameter_mm = 40.0 }")
        .with("numerics", "error_estimate", "[helical]\nslices = 101\ncoupling = \"slicing\"")
        .refused()
        .says(&["helical.slices: found 101 with a shaft that twists; allowed: at most 100"]);
}

/// Where no part of the face width is in contact at some position, or none of so few slices.
#[test]
fn helical_pairs_without_contact_at_some_position() {
    let h951 = |from: &str, to: &str| {
        let text = preset("h951");
        assert!(text.contains(from));
        Case { text: text.replace(from, to), folder: tempfile::tempdir().unwrap() }
    };
    let narrow = h951("face_width_mm = 21.2418", "face_width_mm = 1.0");
    narrow.refused().says(&["pair.face_width_mm", "no part of the face width is in contact", "overlap ratio 0.0471"]);
    let few = h951("face_width_mm = 21.2418", "face_width_mm = 1.5");
    let few = Case { text: few.text.replace("slices = 20", "slices = 3"), ..few };
    few.refused().says(&["helical.slices: found 3; allowed: at least 14 slices"]);
    let wide = h951("face_width_mm = 21.2418", "face_width_mm = 1e7");
    wide.refused().says(&["pair.face_width_mm", "an overlap ratio of at most 1000"]);
}

#[test]
fn the_finite_element_surface_has_no_slices() {
    let case = Case::fzg_c().with("pair", "face_width_mm", "face_width_mm = 14.0\nhelix_angle_deg = 10.0").with(
        "contact",
        "surface",
        "surface = \"fem\"",
    );
    case.refused().says(&["contact.surface", "winkler", "half-space"]);
}

#[test]
fn slices_that_nothing_needs_are_told() {
    let case = Case::fzg_c().with("numerics", "verify", "[helical]\nslices = 20");
    assert!(case.warnings().contains("[helical] is not used"));
}

#[test]
fn all_problems_are_reported_at_once() {
    let case = Case::fzg_c()
        .with("pair.pinion", "teeth", "teeth = 4")
        .with("pair.wheel", "teeth", "theeth = 24")
        .with("material", "poisson_ratio", "poisson_ratio = 0.5")
        .with("operation", "pinion_torque_Nm", "")
        .with("operation", "hours", "hours = 1.0\npinion_revolutions = 1.0")
        .with("contact", "surface", "surface = \"rubber\"")
        .with("wear", "law", "law = 1");
    let refusal = case.refused();
    refusal.says(&[
        "pair.pinion.teeth",
        "unknown key pair.wheel.theeth",
        "material.poisson_ratio",
        "operation.pinion_torque_Nm is missing",
        "operation.hours and operation.pinion_revolutions",
        "contact.surface",
        "wear.law",
        "7 problems in ",
    ]);
    assert!(!refusal.message.contains("pair.wheel.teeth is missing"), "said already");
}

#[test]
fn likely_slips_of_unit_are_named_and_the_run_goes_on() {
    for (table, key, line, warning) in [
        (
            "operation",
            "pinion_torque_Nm",
            "pinion_torque_Nm = 302000",
            "operation.pinion_torque_Nm = 302000: did you mean 302? (N·mm given for N·m)",
        ),
        (
            "material",
            "young_modulus_GPa",
            "young_modulus_GPa = 206000",
            "material.young_modulus_GPa = 206000: did you mean 206? (MPa given for GPa)",
        ),
        (
            "wear",
            "coefficient_m2_per_N",
            "coefficient_m2_per_N = 1e-11",
            "wear.coefficient_m2_per_N = 1e-11: did you mean 1e-17? (mm²/N given for m²/N)",
        ),
        (
            "pair",
            "face_width_mm",
            "face_width_mm = 0.014",
            "pair.face_width_mm = 0.014: did you mean 14? (m given for mm)",
        ),
    ] {
        let warnings = Case::fzg_c().with(table, key, line).warnings();
        assert!(warnings.contains(&format!("warning: {warning}")), "{warnings}");
    }
}

#[test]
fn all_lengths_in_metres_are_refused_with_what_was_meant() {
    // Teeth a thousandth as large under the same torque: a contact wider than they are.
    let case = Case::fzg_c()
        .with("pair", "normal_module_mm", "normal_module_mm = 0.0045")
        .with("pair", "centre_distance_mm", "centre_distance_mm = 0.0915")
        .with("pair", "face_width_mm", "face_width_mm = 0.014")
        .with("pair.pinion", "tip_diameter_mm", "tip_diameter_mm = 0.08246")
        .with("pair.wheel", "tip_diameter_mm", "tip_diameter_mm = 0.11836")
        .with("pair.pinion", "tip_rounding_mm", "tip_rounding_mm = 0.0001")
        .with("pair.wheel", "tip_rounding_mm", "tip_rounding_mm = 0.0001");
    case.refused().says(&[
        "pair.normal_module_mm = 0.0045: did you mean 4.5? (m given for mm)",
        "pair.centre_distance_mm = 0.0915: did you mean 91.5?",
    ]);
}

#[test]
fn a_slip_that_makes_the_scene_invalid_becomes_help() {
    // Radians for degrees: outside the range of pressure angles.
    let case = Case::fzg_c().with("pair", "pressure_angle_deg", "pressure_angle_deg = 0.349");
    case.refused().says(&["pair.pressure_angle_deg", "did you mean 20? (rad given for degrees)"]);
    // Metres for millimetres in the module alone: no pair at this centre distance.
    let case = Case::fzg_c().with("pair", "normal_module_mm", "normal_module_mm = 0.0045");
    case.refused().says(&["pair.normal_module_mm = 0.0045: did you mean 4.5? (m given for mm)"]);
}

/// A tolerance that no step can meet is refused, as is none at all.
#[test]
fn tolerance_of_adaptive_steps() {
    for (tolerance, allowed) in [("0", "greater than 0"), ("1e-9", "at least 0.0001 µm"), ("-1.0", "greater than 0")] {
        let case = Case::fzg_c().with("numerics", "tolerance_um", &format!("tolerance_um = {tolerance}"));
        let line = case.line_of("tolerance_um");
        case.refused().at_line(line).says(&["numerics.tolerance_um", allowed]);
    }
}

/// The key furthest from what steel gears are like is to blame for a contact wider than a hundred times the relative radius (8.38 mm on
/// fzg-c), or smaller than an atom.
#[test]
fn values_that_cannot_be_meant() {
    let allowed = "a half-width of 1e-7 mm to 8.38";
    for (table, key, value, named) in [
        ("material", "young_modulus_GPa", "1e-265", "material.young_modulus_GPa: found 1e-265"),
        ("operation", "pinion_torque_Nm", "1e75", "operation.pinion_torque_Nm: found 1e75"),
        ("operation", "pinion_torque_Nm", "1e-300", "operation.pinion_torque_Nm: found 1e-300"),
        ("pair", "face_width_mm", "1e-60", "pair.face_width_mm: found 1e-60"),
    ] {
        let line = format!("{key} = {value}");
        let case = Case::fzg_c().with(table, key, &line);
        case.refused().says(&[named, allowed, "check their units"]).at_line(case.line_of(&line));
    }
}

/// A web must find room between root circle and clamp circle, and within the face width.
#[test]
fn webs_without_room() {
    let scene = |clamp: &str, web: &str, more: &str| {
        Case::of(&format!(
            "[pair]\npreset = \"fzg-c\"\n[operation]\npinion_torque_Nm = 302.0\npinion_revolutions = 10.0\n\
             [wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-17\n\
             [fem]\nclamp_radius_mm = {{ wheel = {clamp} }}\nweb.wheel = {{ {web} }}\n{more}"
        ))
    };
    let with = |web: &str| scene("25.0", web, "");
    for (web, says) in [
        ("thickness_mm = 5.0", ["fem.web.wheel", "rim_thickness_mm"]),
        ("thickness_mm = 0.0, rim_thickness_mm = 5.0", ["fem.web.wheel.thickness_mm", "greater than 0"]),
        ("thickness_mm = 15.0, rim_thickness_mm = 5.0", ["fem.web.wheel.thickness_mm", "0.4500 to 14 mm"]),
        ("thickness_mm = 0.001, rim_thickness_mm = 5.0", ["fem.web.wheel.thickness_mm", "a tenth of a module"]),
        ("thickness_mm = 5.0, rim_thickness_mm = 24.0", ["fem.web.wheel.rim_thickness_mm", "1.1250 to 23."]),
        ("thickness_mm = 5.0, rim_thickness_mm = 0.1", ["fem.web.wheel.rim_thickness_mm", "1.1250 to 23."]),
        ("thickness_mm = 5.0, rim_thickness_mm = 5.0, offset_mm = 4.6", ["fem.web.wheel.offset_mm", "within the face"]),
        ("thickness = 5.0, rim_thickness_mm = 5.0", ["fem.web.wheel.thickness", "thickness_mm"]),
    ] {
        with(web).refused().says(&says);
    }
    let web = "thickness_mm = 5.0, rim_thickness_mm = 5.0";
    scene("48.3", web, "").refused().says(&["fem.clamp_radius_mm.wheel", "no room for a rim and a web"]);
    let unseen = scene("25.0", web, "[helical]\ncoupling = \"none\"\n").warnings();
    assert!(unseen.contains("fem.web: the wear simulation does not see it"), "{unseen}");
}
