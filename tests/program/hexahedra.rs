//! A bar of hexahedra in tension as a mesh and a problem file, for the tests of the library and of the program.

use std::collections::BTreeMap;

use gearwear::mesh::{CellBlock, CellKind, Mesh};

/// The bar of [`mesh_of_box`] pulled along x with 100 N.
pub const BAR: &str = r#"title = "bar"
analysis = "three-dimensional"

[mesh]
file = "mesh.json"

[[body]]
group = "box"
young_modulus_GPa = 206.0
poisson_ratio = 0.3

[[fixed]]
group = "x0"
components = ["x"]

[[fixed]]
group = "y0"
components = ["y"]

[[fixed]]
group = "z0"
components = ["z"]

[[load]]
group = "x1"
force_N = [100.0, 0.0, 0.0]
"#;

/// Corners of a cell on the grid of half cells.
const CORNERS: [[usize; 3]; 8] =
    [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2]];

/// The faces of the box, each with the corners of a cell that lie on it.
const FACES: [(&str, [usize; 4]); 6] = [
    ("x0", [0, 4, 7, 3]),
    ("x1", [1, 2, 6, 5]),
    ("y0", [0, 1, 5, 4]),
    ("y1", [3, 7, 6, 2]),
    ("z0", [0, 3, 2, 1]),
    ("z1", [4, 5, 6, 7]),
];

/// A box of cells [0, nx] × [0, ny] × [0, nz] of `kind`, each point moved by `to`: group `box`, and its faces `x0` to `z1`.
pub fn mesh_of_box(kind: CellKind, cells: [usize; 3], to: impl Fn([f64; 3]) -> [f64; 3]) -> Mesh {
    let is_quadratic = kind == CellKind::Hexahedron20;
    let mut number: BTreeMap<[usize; 3], usize> = BTreeMap::new();
    let mut mesh = Mesh::default();
    let mut solids = Vec::new();
    let mut faces: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let [nx, ny, nz] = cells;
    for cell in 0..nx * ny * nz {
        let first = [cell % nx, cell / nx % ny, cell / nx / ny];
        let corner = |c: usize| [0, 1, 2].map(|k| 2 * first[k] + CORNERS[c][k]);
        let middle = |a: usize, b: usize| [0, 1, 2].map(|k| (corner(a)[k] + corner(b)[k]) / 2);
        let mut node = |at: [usize; 3]| {
            *number.entry(at).or_insert_with(|| {
                mesh.points.push(to(at.map(|x| x as f64 / 2.0)));
                mesh.points.len() - 1
            })
        };
        solids.extend((0..8).map(|c| node(corner(c))));
        if is_quadratic {
            let around = |from: usize| (0..4).map(move |c| [from + c, from + (c + 1) % 4]);
            let edges = around(0).chain(around(4)).chain((0..4).map(|c| [c, c + 4]));
            solids.extend(edges.map(|[a, b]| node(middle(a, b))));
        }
        for (name, own) in FACES {
            let (k, side) = (usize::from(name.as_bytes()[0] - b'x'), 2 * cells[usize::from(name.as_bytes()[0] - b'x')]);
            if own.iter().all(|&c| corner(c)[k] == if name.ends_with('0') { 0 } else { side }) {
                let nodes = faces.entry(name).or_default();
                nodes.extend(own.iter().map(|&c| node(corner(c))));
                if is_quadratic {
                    nodes.extend((0..4).map(|i| node(middle(own[i], own[(i + 1) % 4]))));
                }
            }
        }
    }
    add(&mut mesh, kind, solids, "box");
    for (name, nodes) in faces {
        add(&mut mesh, if is_quadratic { CellKind::Quad8 } else { CellKind::Quad }, nodes, name);
    }
    mesh
}

/// Adds a block of cells, all of which are the set `name`.
pub fn add(mesh: &mut Mesh, kind: CellKind, nodes: Vec<usize>, name: &str) {
    mesh.cells.push(CellBlock::new(kind, nodes));
    let (last, count) = (mesh.cells.len() - 1, mesh.cells[mesh.cells.len() - 1].len());
    let mut set = vec![Vec::new(); last];
    set.push((0..count).collect());
    mesh.cell_sets.insert(name.to_owned(), set);
    mesh.cell_sets.values_mut().for_each(|set| set.resize(last + 1, Vec::new()));
}
