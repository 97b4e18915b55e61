//! Structured meshes of every kind of element, bent and distorted as a test asks.

use gearwear_fem::problem::Edge;
use gearwear_fem::solid::{Element, ElementKind, Solid};
use nalgebra::Vector2;

pub const KINDS: [ElementKind; 5] =
    [ElementKind::Triangle3, ElementKind::Triangle6, ElementKind::Quad4, ElementKind::Quad8, ElementKind::Quad9];

/// A block of cells, one quadrilateral or two triangles each.
pub struct Block {
    pub solid: Solid,
    /// Edges of the four sides v = 0, u = 1, v = 1 and u = 0, the body on their left.
    pub sides: [Vec<Edge>; 4],
}

pub fn is_quadratic(kind: ElementKind) -> bool {
    !matches!(kind, ElementKind::Triangle3 | ElementKind::Quad4)
}

/// nx × ny cells over the unit square of (u, v), with nodes at `place(u, v)`; middles of sides at `place` of their (u, v).
pub fn block(kind: ElementKind, nx: usize, ny: usize, place: impl Fn(f64, f64) -> Vector2<f64>) -> Block {
    // A lattice at half the cell size; nodes are given numbers where an element wants them.
    let (across, along) = (2 * nx + 1, 2 * ny + 1);
    let mut number = vec![u32::MAX; across * along];
    let mut points_mm = Vec::new();
    let mut elements = Vec::new();
    for j in 0..ny {
        for i in 0..nx {
            let mut at = |offsets: &[(usize, usize)]| -> Vec<u32> {
                let mut node = |(di, dj): &(usize, usize)| {
                    let (p, q) = (2 * i + di, 2 * j + dj);
                    let entry = &mut number[q * across + p];
                    if *entry == u32::MAX {
                        *entry = points_mm.len() as u32;
                        points_mm.push(place(p as f64 / (2 * nx) as f64, q as f64 / (2 * ny) as f64));
                    }
                    *entry
                };
                offsets.iter().map(&mut node).collect()
            };
            const QUAD: [(usize, usize); 9] = [(0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1), (1, 1)];
            // Both diagonals in turn, so that no direction is special.
            const LEFT: [[(usize, usize); 6]; 2] =
                [[(0, 0), (2, 0), (2, 2), (1, 0), (2, 1), (1, 1)], [(0, 0), (2, 2), (0, 2), (1, 1), (1, 2), (0, 1)]];
            const RIGHT: [[(usize, usize); 6]; 2] =
                [[(0, 0), (2, 0), (0, 2), (1, 0), (1, 1), (0, 1)], [(2, 0), (2, 2), (0, 2), (2, 1), (1, 2), (1, 1)]];
            let nodes = kind.node_count();
            match kind {
                ElementKind::Triangle3 | ElementKind::Triangle6 => {
                    for triangle in if (i + j) % 2 == 0 { &LEFT } else { &RIGHT } {
                        elements.push(Element::new(kind, &at(&triangle[..nodes]), 0));
                    }
                }
                _ => elements.push(Element::new(kind, &at(&QUAD[..nodes]), 0)),
            }
        }
    }
    let middle = |p: usize, q: usize| is_quadratic(kind).then(|| number[q * across + p]);
    let ends = |p: [usize; 2], q: [usize; 2]| [number[q[0] * across + p[0]], number[q[1] * across + p[1]]];
    let sides = [
        (0..nx).map(|i| Edge { ends: ends([2 * i, 2 * i + 2], [0, 0]), middle: middle(2 * i + 1, 0) }).collect(),
        (0..ny)
            .map(|j| Edge { ends: ends([across - 1; 2], [2 * j, 2 * j + 2]), middle: middle(across - 1, 2 * j + 1) })
            .collect(),
        (0..nx)
            .rev()
            .map(|i| Edge { ends: ends([2 * i + 2, 2 * i], [along - 1; 2]), middle: middle(2 * i + 1, along - 1) })
            .collect(),
        (0..ny).rev().map(|j| Edge { ends: ends([0, 0], [2 * j + 2, 2 * j]), middle: middle(0, 2 * j + 1) }).collect(),
    ];
    Block { solid: Solid { points_mm, elements }, sides }
}

/// The unit square with its lines bent inside, smoothly, by about a tenth of its size; its sides stay straight.
pub fn bent_square(u: f64, v: f64) -> Vector2<f64> {
    use std::f64::consts::PI;
    let bump = (PI * u).sin() * (PI * v).sin();
    Vector2::new(u + 0.10 * bump * (2.0 * v - 0.4), v - 0.08 * bump * (1.6 - 2.0 * u))
}

/// Moves corners inside by a fixed pattern of pushes, `by` a fraction of the cell; sides stay straight and their middles in
/// the middle.
pub fn push_corners(block: &mut Block, by_mm: f64) {
    let solid = &mut block.solid;
    let mut border = vec![false; solid.points_mm.len()];
    for node in block.sides.iter().flatten().flat_map(|edge| edge.ends.into_iter().chain(edge.middle)) {
        border[node as usize] = true;
    }
    for (number, point) in solid.points_mm.iter_mut().enumerate() {
        if !border[number] {
            // A sequence of the golden ratio spreads the pushes without a random generator.
            let turn = (number as f64 * 0.618_033_988_749_895).fract() * std::f64::consts::TAU;
            *point += Vector2::new(turn.cos(), turn.sin()) * by_mm;
        }
    }
    for element in &solid.elements {
        let nodes = element.nodes();
        let corners = if matches!(element.kind, ElementKind::Triangle3 | ElementKind::Triangle6) { 3 } else { 4 };
        let at: Vec<Vector2<f64>> = nodes[..corners].iter().map(|node| solid.points_mm[*node as usize]).collect();
        for (a, node) in nodes[corners..].iter().enumerate() {
            solid.points_mm[*node as usize] =
                if a < corners { (at[a] + at[(a + 1) % corners]) / 2.0 } else { at.iter().sum::<Vector2<f64>>() / 4.0 };
        }
    }
}
