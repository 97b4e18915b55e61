//! The cylinder on a block as a problem file, for the tests of the library and of the program.

use gearwear::mesh::{CellBlock, CellKind, Mesh};

/// The half model of the NAFEMS cylinder on a block; its groups are those of the committed meshes.
pub const TEXT: &str = r#"title = "cylinder on a block"

[mesh]
file = "mesh.json"

[[body]]
group = "cylinder"
young_modulus_GPa = 210.0
poisson_ratio = 0.3

[[body]]
group = "block"
young_modulus_GPa = 70.0
poisson_ratio = 0.3

[[fixed]]
group = "symmetry"
components = ["x"]

[[fixed]]
group = "base"
components = ["y"]

[[load]]
group = "top"
force_N_per_mm = [0.0, -17500.0]

[[contact]]
slave = "cylinder-surface"
master = "block-top"
friction = 0.0
"#;

/// Adds a block of cells, all of which are the set `name`.
pub fn add_block(mesh: &mut Mesh, kind: CellKind, nodes: Vec<usize>, name: &str) {
    let count = nodes.len() / kind.node_count();
    mesh.cells.push(CellBlock::new(kind, nodes));
    for set in mesh.cell_sets.values_mut() {
        set.push(Vec::new());
    }
    let mut set = vec![Vec::new(); mesh.cells.len()];
    set[mesh.cells.len() - 1] = (0..count).collect();
    mesh.cell_sets.insert(name.to_owned(), set);
}
