//! Layer of structured elements under the working flank.
//!
//! Columns stand on the elements of the flank, along the involute's normals; depths are multiples of the local element
//! length h, so that the layer keeps its shape where h changes along the flank. Rows thicken by a factor of 1.25 each;
//! once a row would be 1.5 times as thick as wide, pairs of columns are joined by a row of three triangles:
//!
//! ```text
//!  flank   A ─────── M ─────── B
//!          │ \      / \      / │        triangles A C M, M C D, M D B;  below, one column C D stands for two
//!  below   C ───────────────── D
//! ```
//!
//! The layer covers the part of the flank where it is thinner than a fraction of the tooth's thickness and of the
//! flank's radius of curvature, and where h changes slowly enough for the rows not to slant.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::{ToothElement, spacing::OutlineNode};
use gearwear_mesh::CellKind;

/// Ratio of thicknesses of neighbouring rows.
const THICKENING: f64 = 1.25;
/// Ratio of thickness to width of a row beyond which columns are joined.
const THICKEST_OVER_WIDTH: f64 = 1.5;
/// Greatest depth over the tooth's thickness.
const PART_OF_THICKNESS: f64 = 0.3;
/// Greatest depth over the radius of curvature of a convex flank, at whose centre the normals meet.
const PART_OF_CURVATURE: f64 = 0.4;
/// Steepest slant of the lowest row against the flank.
const STEEPEST: f64 = 0.3;
/// Passes of the running mean over element lengths.
const SMOOTHINGS: usize = 8;
/// Elements at both ends of the fine flank with triangles below, which fit the corners.
const LEFT_TO_CORNERS: usize = 5;

/// A row of the layer; depths in units of the local element length.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LayerRow {
    depth: [f64; 2],
    /// Flank elements a column covers above the row.
    width: usize,
    /// Whether pairs of columns are joined.
    joins: bool,
}

/// Rows down to at least `depth` element lengths.
fn rows(depth: f64) -> Vec<LayerRow> {
    let (mut rows, mut top, mut thickness, mut width) = (Vec::new(), 0.0, 1.0, 1);
    while top < depth {
        let joins = thickness >= THICKEST_OVER_WIDTH * width as f64;
        rows.push(LayerRow { depth: [top, top + thickness], width, joins });
        top += thickness;
        thickness *= THICKENING;
        width *= if joins { 2 } else { 1 };
    }
    rows
}

/// Layer under a flank.
#[derive(Debug, Default)]
pub(super) struct Layer {
    pub cells: Vec<ToothElement>,
    /// Covered nodes of the flank, counted along it; empty without a layer.
    pub covers: std::ops::Range<usize>,
    /// Edges inside the tooth (end, middle, end), from the flank at the tip down, along the lowest row and up to the
    /// flank at the root, the rest of the body on their left.
    pub border: Vec<[u32; 3]>,
}

/// Node of the flank above the layer.
#[derive(Debug, Clone, Copy)]
pub(super) struct FlankNode {
    pub id: u32,
    pub node: OutlineNode,
    /// Unit normal into the tooth.
    pub inward: Vector2<f64>,
    /// Radius of curvature of the flank, mm.
    pub rho_mm: f64,
}

/// Layer under `flank` (ends and middles of its elements alternately, from root to tip), about `depth_elements` element lengths deep; new
/// nodes are added to `points_mm`.
pub(super) fn build(flank: &[FlankNode], depth_elements: f64, points_mm: &mut Vec<Vector2<f64>>) -> Layer {
    let rows = rows(depth_elements);
    let Some(lowest) = rows.last() else { return Layer::default() };
    let joined = lowest.width * if lowest.joins { 2 } else { 1 };
    let (first, last) = where_it_fits(flank, lowest.depth[1]);
    let columns = (last - first) / joined * joined;
    if columns < 4 * joined {
        return Layer::default();
    }
    // Surplus elements are left out at the root, where the flank is least loaded.
    let first = last - columns;
    let flank = &flank[2 * first..=2 * last];
    let mut grid = Grid { flank, length_mm: smoothed_lengths_mm(flank), nodes: BTreeMap::new(), points_mm };
    let mut cells = Vec::new();
    for (number, row) in rows.iter().enumerate() {
        let step = row.width * if row.joins { 2 } else { 1 };
        for i in (0..columns).step_by(step) {
            if row.joins {
                cells.extend(grid.join(&rows, number, 2 * i, row.width));
            } else {
                cells.push(grid.quad(&rows, number, 2 * i, row.width));
            }
        }
    }
    let border = grid.border(&rows, columns, joined);
    Layer { cells, covers: 2 * first..2 * last + 1, border }
}

/// Smoothed element lengths at the nodes of the flank, whose kinks would bend the rows: a running mean at ends of elements, the mean
/// of both ends in middles.
fn smoothed_lengths_mm(flank: &[FlankNode]) -> Vec<f64> {
    let mut ends: Vec<f64> = flank.iter().step_by(2).map(|at| at.node.length_mm).collect();
    for _ in 0..SMOOTHINGS {
        let before = ends.clone();
        for (k, around) in before.windows(3).enumerate() {
            ends[k + 1] = 0.25 * (around[0] + 2.0 * around[1] + around[2]);
        }
    }
    (0..flank.len()).map(|i| 0.5 * (ends[i / 2] + ends[i.div_ceil(2)])).collect()
}

/// First and last end of a flank element between which the layer fits.
fn where_it_fits(flank: &[FlankNode], depth: f64) -> (usize, usize) {
    let count = flank.len() / 2;
    let (mut best, mut start) = ((0, 0), None);
    for k in LEFT_TO_CORNERS..count.saturating_sub(LEFT_TO_CORNERS) {
        if fits(&flank[2 * k], flank.get(2 * k + 2), depth) {
            let first = *start.get_or_insert(k);
            if k - first > best.1 - best.0 {
                best = (first, k);
            }
        } else {
            start = None;
        }
    }
    best
}

/// Whether a layer of `depth` element lengths is thin enough at the end of a flank element, and level enough to the next end.
fn fits(at: &FlankNode, next: Option<&FlankNode>, depth: f64) -> bool {
    let depth_mm = depth * at.node.length_mm;
    depth_mm <= PART_OF_THICKNESS * 2.0 * at.node.point_mm.x.abs()
        && (at.rho_mm < 0.0 || depth_mm <= PART_OF_CURVATURE * at.rho_mm)
        && next.is_none_or(|next| {
            let along = (next.node.point_mm - at.node.point_mm).norm();
            depth * (next.node.length_mm - at.node.length_mm).abs() <= STEEPEST * along
        })
}

/// Nodes of the layer by half columns along the flank and half rows into the depth.
struct Grid<'a> {
    flank: &'a [FlankNode],
    /// Unit of depth at each node of the flank.
    length_mm: Vec<f64>,
    nodes: BTreeMap<(usize, usize), u32>,
    points_mm: &'a mut Vec<Vector2<f64>>,
}

impl Grid<'_> {
    /// The node at half column `i` and half row `j`.
    fn node(&mut self, rows: &[LayerRow], i: usize, j: usize) -> u32 {
        let at = &self.flank[i];
        if j == 0 {
            return at.id;
        }
        let (points_mm, length_mm) = (&mut *self.points_mm, self.length_mm[i]);
        *self.nodes.entry((i, j)).or_insert_with(|| {
            let [top, bottom] = rows[(j - 1) / 2].depth;
            let depth = if j.is_multiple_of(2) { bottom } else { 0.5 * (top + bottom) };
            add(points_mm, at.node.point_mm + depth * length_mm * at.inward)
        })
    }

    /// Quadrilateral of `row` from half column `i` on.
    fn quad(&mut self, rows: &[LayerRow], row: usize, i: usize, width: usize) -> ToothElement {
        let (top, bottom, last) = (2 * row, 2 * row + 2, i + 2 * width);
        let corners = [(i, top), (i, bottom), (last, bottom), (last, top)];
        let middles = [(i, top + 1), (i + width, bottom), (last, top + 1), (i + width, top)];
        let mut nodes = [0; 8];
        for (node, place) in nodes.iter_mut().zip(corners.into_iter().chain(middles)) {
            *node = self.node(rows, place.0, place.1);
        }
        ToothElement { kind: CellKind::Quad8, nodes }
    }

    /// Three triangles of `row` from half column `i` on, which join two columns.
    fn join(&mut self, rows: &[LayerRow], row: usize, i: usize, width: usize) -> [ToothElement; 3] {
        let (top, bottom) = (2 * row, 2 * row + 2);
        let (middle, last) = (i + 2 * width, i + 4 * width);
        let [a, m, b] = [i, middle, last].map(|i| self.node(rows, i, top));
        let [c, d] = [i, last].map(|i| self.node(rows, i, bottom));
        let [am, mb] = [i + width, middle + width].map(|i| self.node(rows, i, top));
        let cd = self.node(rows, middle, bottom);
        let [ac, bd] = [i, last].map(|i| self.node(rows, i, top + 1));
        let mc = self.between(m, c);
        let md = self.between(m, d);
        [
            ToothElement::triangle([a, c, m], [ac, mc, am]),
            ToothElement::triangle([m, c, d], [mc, cd, md]),
            ToothElement::triangle([m, d, b], [md, bd, mb]),
        ]
    }

    /// New node halfway between two.
    fn between(&mut self, a: u32, b: u32) -> u32 {
        let point = 0.5 * (self.points_mm[a as usize] + self.points_mm[b as usize]);
        add(self.points_mm, point)
    }

    /// [`Layer::border`].
    fn border(&mut self, rows: &[LayerRow], columns: usize, joined: usize) -> Vec<[u32; 3]> {
        let (tip, lowest) = (2 * columns, 2 * rows.len());
        let mut border = Vec::new();
        for j in (0..lowest).step_by(2) {
            border.push([j, j + 1, j + 2].map(|j| self.node(rows, tip, j)));
        }
        for i in (0..columns).step_by(joined).rev() {
            border.push([2 * (i + joined), 2 * i + joined, 2 * i].map(|i| self.node(rows, i, lowest)));
        }
        for j in (0..lowest).step_by(2).rev() {
            border.push([j + 2, j + 1, j].map(|j| self.node(rows, 0, j)));
        }
        border
    }
}

/// Adds a node.
pub(super) fn add(points_mm: &mut Vec<Vector2<f64>>, point: Vector2<f64>) -> u32 {
    points_mm.push(point);
    (points_mm.len() - 1) as u32
}
