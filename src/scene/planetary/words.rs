//! Problems of a mesh's scene in the words of the stage's file, at the places of that file.

use super::mesh::StageMesh;
use super::pair_scene::OF_OPERATION;
use crate::scene::locate::Locator;
use crate::scene::problem::{Problem, ProblemKind};

/// `text` about the pair of a mesh, as of the stage: its keys and the names of its gears.
pub fn of_stage(text: &str, mesh: StageMesh) -> String {
    let [pinion, wheel] = mesh.gears();
    let mut said = text.replace("pair.pinion", &format!("planetary.{pinion}"));
    said = said.replace("pair.wheel", &format!("planetary.{wheel}")).replace("[pair]", "[planetary]");
    said = said.replace("pair.", "planetary.");
    for (of_stage, of_pair) in OF_OPERATION {
        said = said.replace(of_pair, of_stage);
    }
    said.replace("an internal wheel", "an internal ring").replace("pinion", pinion).replace("wheel", wheel)
}

/// `problem` of the scene of `mesh`, in the file whose keys `locator` knows.
pub(super) fn told_of_stage(problem: Problem, mesh: StageMesh, locator: &Locator) -> Problem {
    let key = of_stage(&problem.key, mesh);
    // What stands for this mesh alone lies above what stands for both.
    let own = format!("{}.{}", mesh.table(), key.strip_prefix("planetary.").unwrap_or(&key));
    let key = if locator.key(&own).is_some() { own } else { key };
    let of_key = match problem.kind {
        ProblemKind::UnknownKey | ProblemKind::NotAvailable => locator.key(&key),
        _ => None,
    };
    let (kind, found) = match problem.kind {
        // Their own words are of a pair.
        ProblemKind::Geometry(error) => (ProblemKind::NotAllowed, format!("{} ({error})", problem.found)),
        ProblemKind::Stiffness(error) => (ProblemKind::NotAllowed, format!("{} ({error})", problem.found)),
        kind => (kind, problem.found),
    };
    Problem {
        span: Some(of_key.unwrap_or_else(|| locator.nearest(&key))),
        found: of_stage(&found, mesh),
        allowed: of_stage(&problem.allowed, mesh),
        // A stage has no preset.
        help: problem.help.filter(|help| !help.contains("pair.preset")).map(|help| of_stage(&help, mesh)),
        kind,
        key,
    }
}
