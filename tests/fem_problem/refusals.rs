//! Wrong problems, one test each: exit status 2, and a message with file, line, key, what was found and what is allowed.

use gearwear::fem::solid::ElementKind;
use gearwear::mesh::{CellKind, Mesh};

use super::case::{Case, TEXT, add_block, mesh_of};
use super::coarse;

fn mesh() -> Mesh {
    mesh_of(&coarse(ElementKind::Quad8))
}

fn case() -> Case {
    Case::new(TEXT, &mesh())
}

#[test]
fn keys_that_no_problem_has() {
    case().with("friction = 0.0", "frictoin = 0.0").refused("frictoin", &["unknown key contact[0].frictoin", "friction?"]);
    case()
        .with("group = \"top\"", "group = \"top\"\nyoung_modulus_GPa = 1.0")
        .refused("young_modulus_GPa = 1.0", &["unknown key load[0].young_modulus_GPa", "belongs in [[body]]"]);
    case().with("[mesh]", "[pair]\nface_width_mm = 14.0\n[mesh]").run_says("both [mesh] and [pair]");
}

impl Case {
    fn run_says(&self, part: &str) {
        let (status, _, message) = self.run();
        assert_eq!(status, Some(2), "{message}");
        assert!(message.contains(part), "{message}");
    }
}

#[test]
fn a_body_without_material() {
    case()
        .with("young_modulus_GPa = 70.0\n", "")
        .refused("[[body]]\ngroup = \"block\"".lines().next().unwrap(), &["body[1].young_modulus_GPa is missing"]);
}
