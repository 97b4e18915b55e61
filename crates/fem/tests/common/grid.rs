//! Mapped grids of every kind of element, and the cylinder on a block made of two of them.

#![allow(dead_code, reason = "each test takes what it needs")]

use std::collections::BTreeMap;

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::problem::{ContactPair, Edge, Held, Problem};
use gearwear_fem::solid::{Element, ElementKind, Solid};
use nalgebra::Vector2;

/// A grid of cells over the image of a rectangle; nodes are kept on a lattice of half steps.
pub struct Grid {
    kind: ElementKind,
    columns: usize,
    rows: usize,
    nodes: BTreeMap<(usize, usize), u32>,
}

fn quadratic(kind: ElementKind) -> bool {
    matches!(kind, ElementKind::Triangle6 | ElementKind::Quad8 | ElementKind::Quad9)
}

impl Grid {
    /// Adds to `solid` a grid with the given lines; `map` takes (u, v) to the plane, keeping orientation.
    pub fn add(
        solid: &mut Solid,
        kind: ElementKind,
        material: u16,
        (u, v): (&[f64], &[f64]),
        map: impl Fn(f64, f64) -> Vector2<f64>,
    ) -> Self {
        let half = |lines: &[f64], k: usize| match k % 2 {
            0 => lines[k / 2],
            _ => 0.5 * (lines[k / 2] + lines[k / 2 + 1]),
        };
        let (columns, rows) = (u.len() - 1, v.len() - 1);
        let mut nodes = BTreeMap::new();
        for j in 0..=2 * rows {
            for i in 0..=2 * columns {
                let corner = i % 2 == 0 && j % 2 == 0;
                let middle = i % 2 == 1 && j % 2 == 1;
                let wanted = corner || quadratic(kind) && (!middle || kind != ElementKind::Quad8);
                if wanted {
                    nodes.insert((i, j), solid.points_mm.len() as u32);
                    solid.points_mm.push(map(half(u, i), half(v, j)));
                }
            }
        }
        let grid = Self { kind, columns, rows, nodes };
        for row in 0..rows {
            for column in 0..columns {
                let at = |di: usize, dj: usize| grid.nodes[&(2 * column + di, 2 * row + dj)];
                let mut add = |places: &[(usize, usize)]| {
                    let nodes: Vec<u32> = places.iter().map(|&(di, dj)| at(di, dj)).collect();
                    solid.elements.push(Element::new(kind, &nodes, material));
                };
                let quad = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)];
                match kind {
                    ElementKind::Quad4 => add(&quad[..4]),
                    ElementKind::Quad8 => add(&quad[..8]),
                    ElementKind::Quad9 => add(&quad),
                    ElementKind::Triangle3 => {
                        add(&[quad[0], quad[1], quad[2]]);
                        add(&[quad[0], quad[2], quad[3]]);
                    }
                    ElementKind::Triangle6 => {
                        add(&[quad[0], quad[1], quad[2], quad[4], quad[5], quad[8]]);
                        add(&[quad[0], quad[2], quad[3], quad[8], quad[6], quad[7]]);
                    }
                }
            }
        }
        grid
    }

    fn edge(&self, from: (usize, usize), to: (usize, usize)) -> Edge {
        let middle = ((from.0 + to.0) / 2, (from.1 + to.1) / 2);
        let middle = quadratic(self.kind).then(|| self.nodes[&middle]);
        Edge { ends: [self.nodes[&from], self.nodes[&to]], middle }
    }

    /// Edges of the line v = first, body on their left.
    pub fn bottom(&self) -> Vec<Edge> {
        (0..self.columns).map(|k| self.edge((2 * k, 0), (2 * k + 2, 0))).collect()
    }

    /// Edges of the line v = last, body on their left.
    pub fn top(&self) -> Vec<Edge> {
        let j = 2 * self.rows;
        (0..self.columns).rev().map(|k| self.edge((2 * k + 2, j), (2 * k, j))).collect()
    }

    /// Edges of the line u = last, body on their left.
    pub fn right(&self) -> Vec<Edge> {
        let i = 2 * self.columns;
        (0..self.rows).map(|k| self.edge((i, 2 * k), (i, 2 * k + 2))).collect()
    }

    /// Edges of the line u = first, body on their left.
    pub fn left(&self) -> Vec<Edge> {
        (0..self.rows).rev().map(|k| self.edge((0, 2 * k + 2), (0, 2 * k))).collect()
    }

    /// Nodes with u = last.
    pub fn right_nodes(&self) -> Vec<u32> {
        self.nodes_where(|i, _| i == 2 * self.columns)
    }

    /// Nodes with u = first.
    pub fn left_nodes(&self) -> Vec<u32> {
        self.nodes_where(|i, _| i == 0)
    }

    /// Nodes with v = first.
    pub fn bottom_nodes(&self) -> Vec<u32> {
        self.nodes_where(|_, j| j == 0)
    }

    /// Nodes with v = last.
    pub fn top_nodes(&self) -> Vec<u32> {
        self.nodes_where(|_, j| j == 2 * self.rows)
    }

    fn nodes_where(&self, keep: impl Fn(usize, usize) -> bool) -> Vec<u32> {
        self.nodes.iter().filter(|((i, j), _)| keep(*i, *j)).map(|(_, node)| *node).collect()
    }
}

/// Lines from `from` that begin with steps of `step` over the length `even` and then grow by `growth` up to `to`.
pub fn graded(from: f64, to: f64, step: f64, even: f64, growth: f64) -> Vec<f64> {
    let sign = (to - from).signum();
    let length = (to - from).abs();
    let mut lines = vec![0.0];
    let (mut at, mut h) = (0.0, step);
    while at + 1.5 * h < length {
        at += h;
        lines.push(at);
        if at >= even {
            h *= growth;
        }
    }
    lines.push(length);
    lines.iter().map(|s| from + sign * s).collect()
}

/// Consistent nodal forces of a uniform traction on straight edges whose resultant is `force`.
pub fn spread(solid: &Solid, edges: &[Edge], force: Vector2<f64>, forces: &mut [f64]) {
    let length = |edge: &Edge| (solid.points_mm[edge.ends[0] as usize] - solid.points_mm[edge.ends[1] as usize]).norm();
    let total: f64 = edges.iter().map(length).sum();
    for edge in edges {
        let shares: &[f64] = if edge.middle.is_some() { &[1.0 / 6.0, 1.0 / 6.0, 2.0 / 3.0] } else { &[0.5, 0.5] };
        for (node, share) in edge.ends.into_iter().chain(edge.middle).zip(shares) {
            let part = force * (share * length(edge) / total);
            forces[2 * node as usize] += part.x;
            forces[2 * node as usize + 1] += part.y;
        }
    }
}

/// What varies between cylinders on a block.
#[derive(Debug, Clone, Copy)]
pub struct CylinderOnBlock {
    pub kind: ElementKind,
    pub young_modulus_mpa: [f64; 2],
    pub poisson_ratio: f64,
    pub radius_mm: f64,
    /// Of the half model.
    pub force_n_per_mm: f64,
    /// Expected half-width, which the grading follows.
    pub half_width_mm: f64,
    pub elements_per_half_width: f64,
    /// Element length of the block over that of the cylinder.
    pub mesh_ratio: f64,
    pub cylinder_is_slave: bool,
}

impl CylinderOnBlock {
    /// The NAFEMS benchmark: R 50 mm, 210 and 70 GPa, ν 0.3, 35 kN/mm.
    pub fn nafems(kind: ElementKind, elements_per_half_width: f64) -> Self {
        Self {
            kind,
            young_modulus_mpa: [210e3, 70e3],
            poisson_ratio: 0.3,
            radius_mm: 50.0,
            force_n_per_mm: 17_500.0,
            half_width_mm: 6.215,
            elements_per_half_width,
            mesh_ratio: 1.0,
            cylinder_is_slave: true,
        }
    }

    /// The half model x ≥ 0: the lower quarter of the cylinder, with a hole of a hundredth of its radius, over a block
    /// four radii wide and high; the load is spread over the cylinder's horizontal mid-plane.
    pub fn problem(&self) -> Problem {
        let mut solid = Solid::default();
        let r = self.radius_mm;
        let h = self.half_width_mm / self.elements_per_half_width;
        let even = 1.3 * self.half_width_mm;
        let angles = graded(0.0, std::f64::consts::FRAC_PI_2, h / r, even / r, 1.3);
        // From the inside to the surface, fine at the surface.
        let depths: Vec<f64> = graded(r, 0.01 * r, h, 0.5 * self.half_width_mm, 1.3).into_iter().rev().collect();
        let cylinder = Grid::add(&mut solid, self.kind, 0, (&depths, &angles), |radius, angle| {
            Vector2::new(radius * angle.sin(), r - radius * angle.cos())
        });
        let h = h * self.mesh_ratio;
        let across = graded(0.0, 4.0 * r, h, even, 1.3);
        let down: Vec<f64> = graded(0.0, -4.0 * r, h, 0.5 * self.half_width_mm, 1.3).into_iter().rev().collect();
        let block = Grid::add(&mut solid, self.kind, 1, (&across, &down), Vector2::new);
        let mut held = Vec::new();
        let hold = |held: &mut Vec<Held>, nodes: Vec<u32>, component: u32| {
            held.extend(nodes.into_iter().map(|node| Held { dof: 2 * node + component, displacement_mm: 0.0 }));
        };
        hold(&mut held, cylinder.bottom_nodes(), 0);
        hold(&mut held, block.left_nodes(), 0);
        hold(&mut held, block.bottom_nodes(), 1);
        let mut forces = vec![0.0; solid.dofs()];
        spread(&solid, &cylinder.top(), Vector2::new(0.0, -self.force_n_per_mm), &mut forces);
        let (outside, surface) = (cylinder.right(), block.top());
        let (slave, master) = if self.cylinder_is_slave { (outside, surface) } else { (surface, outside) };
        let material = |young_modulus_mpa| Elastic { young_modulus_mpa, poisson_ratio: self.poisson_ratio };
        Problem {
            analysis: Analysis::PlaneStrain,
            solid,
            materials: self.young_modulus_mpa.map(material).to_vec(),
            held,
            forces_n_per_mm: forces,
            contacts: vec![ContactPair { slave, master }],
        }
    }
}
