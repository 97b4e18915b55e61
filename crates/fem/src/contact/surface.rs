//! Surface of edges with a continuous field of normals.
//!
//! Nodes are numbered locally, 0 … n−1, in the order of their first edges. The unit normal of a node is the mean
//! of its edges' normals there; between nodes it is interpolated and normalised.

use std::collections::BTreeMap;

use nalgebra::Vector2;

use super::edge::{MOST_NODES, interpolate, node_place, outward, shape, shape_derivative};
use crate::problem::Edge;

/// Edge by local node numbers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SurfaceEdge {
    nodes: [usize; MOST_NODES],
    count: usize,
}

/// Surface of a body, or part of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Number in the mesh of each local node.
    pub mesh_nodes: Vec<u32>,
    /// Coordinates of the nodes, mm.
    pub points_mm: Vec<Vector2<f64>>,
    /// Outward unit normals at the nodes.
    pub normals: Vec<Vector2<f64>>,
    /// Edges, body on their left.
    pub edges: Vec<SurfaceEdge>,
}

impl SurfaceEdge {
    /// Local numbers of the nodes: ends, middle.
    pub fn nodes(&self) -> &[usize] {
        &self.nodes[..self.count]
    }
}

impl Surface {
    /// Surface of `edges` with nodes at `points_mm`.
    pub fn new(edges: &[Edge], points_mm: &[Vector2<f64>]) -> Self {
        let mut local = BTreeMap::new();
        let mut mesh_nodes = Vec::new();
        let edges = edges
            .iter()
            .map(|edge| {
                let mut nodes = [0; MOST_NODES];
                for (own, node) in nodes.iter_mut().zip(edge.nodes()) {
                    *own = *local.entry(node).or_insert_with(|| {
                        mesh_nodes.push(node);
                        mesh_nodes.len() - 1
                    });
                }
                SurfaceEdge { nodes, count: edge.node_count() }
            })
            .collect();
        let points_mm = mesh_nodes.iter().map(|&node| points_mm[node as usize]).collect();
        let mut surface = Self { mesh_nodes, points_mm, normals: Vec::new(), edges };
        surface.normals = surface.mean_normals();
        surface
    }

    /// Surface moved as a rigid body: `place` maps points, `turn` directions.
    pub fn placed(
        &self,
        place: impl Fn(Vector2<f64>) -> Vector2<f64>,
        turn: impl Fn(Vector2<f64>) -> Vector2<f64>,
    ) -> Self {
        Self {
            mesh_nodes: self.mesh_nodes.clone(),
            points_mm: self.points_mm.iter().map(|&p| place(p)).collect(),
            normals: self.normals.iter().map(|&n| turn(n)).collect(),
            edges: self.edges.clone(),
        }
    }

    /// Surface of some of the edges alone; nodes keep their numbers and normals.
    pub fn part(&self, edges: std::ops::Range<usize>) -> Self {
        let Self { mesh_nodes, points_mm, normals, .. } = self;
        let (mesh_nodes, points_mm, normals) = (mesh_nodes.clone(), points_mm.clone(), normals.clone());
        Self { mesh_nodes, points_mm, normals, edges: self.edges[edges].to_vec() }
    }

    fn mean_normals(&self) -> Vec<Vector2<f64>> {
        let mut sums = vec![Vector2::zeros(); self.points_mm.len()];
        for edge in &self.edges {
            for (place, &node) in edge.nodes().iter().enumerate() {
                let (_, tangent) = self.point_and_tangent(edge, node_place(place));
                sums[node] += outward(tangent).normalize();
            }
        }
        // Opposite edges (a crack, a sheet without thickness) have no mean normal: such a node faces nothing.
        sums.into_iter().map(|sum| sum.try_normalize(1e-9).unwrap_or_else(Vector2::zeros)).collect()
    }

    /// Coordinates of an edge's nodes, of which the first `count` are used.
    fn corners(&self, edge: &SurfaceEdge) -> [Vector2<f64>; MOST_NODES] {
        edge.nodes.map(|node| self.points_mm[node])
    }

    /// Point at ξ and its derivative by ξ.
    pub(crate) fn point_and_tangent(&self, edge: &SurfaceEdge, xi: f64) -> (Vector2<f64>, Vector2<f64>) {
        let corners = self.corners(edge);
        let corners = &corners[..edge.count];
        let point = interpolate(&shape(edge.count, xi), corners);
        (point, interpolate(&shape_derivative(edge.count, xi), corners))
    }

    /// Interpolated, not normalised, normal at ξ and its derivative by ξ.
    pub(crate) fn normal_and_derivative(&self, edge: &SurfaceEdge, xi: f64) -> (Vector2<f64>, Vector2<f64>) {
        let normals = edge.nodes.map(|node| self.normals[node]);
        let normals = &normals[..edge.count];
        let normal = interpolate(&shape(edge.count, xi), normals);
        (normal, interpolate(&shape_derivative(edge.count, xi), normals))
    }

    /// Smallest box around an edge, with room for the bulge of a curved one.
    pub(crate) fn edge_box(&self, edge: &SurfaceEdge) -> (Vector2<f64>, Vector2<f64>) {
        let corners = self.corners(edge);
        let corners = &corners[..edge.count];
        let low = corners.iter().fold(corners[0], |low, p| low.inf(p));
        let high = corners.iter().fold(corners[0], |high, p| high.sup(p));
        let bulge = if edge.count == 3 { (0.5 * (corners[0] + corners[1]) - corners[2]).norm() } else { 0.0 };
        (low.add_scalar(-bulge), high.add_scalar(bulge))
    }

    /// Diagonal of the box around the whole surface, mm.
    pub fn extent_mm(&self) -> f64 {
        let Some(&first) = self.points_mm.first() else { return 0.0 };
        let low = self.points_mm.iter().fold(first, |low, p| low.inf(p));
        let high = self.points_mm.iter().fold(first, |high, p| high.sup(p));
        (high - low).norm()
    }

    /// Nodes in the order of the surface, one path for each connected part; a closed one begins at its first edge.
    pub fn paths(&self) -> Vec<Vec<usize>> {
        let mut leaving = vec![None; self.points_mm.len()];
        let mut entered = vec![false; self.points_mm.len()];
        for (number, edge) in self.edges.iter().enumerate() {
            leaving[edge.nodes[0]] = Some(number);
            entered[edge.nodes[1]] = true;
        }
        let mut walked = vec![false; self.edges.len()];
        let mut paths = Vec::new();
        // Open parts from their beginnings, then closed ones.
        let open = (0..self.edges.len()).filter(|&number| !entered[self.edges[number].nodes[0]]);
        for start in open.chain(0..self.edges.len()) {
            let mut path = Vec::new();
            let mut next = Some(start);
            while let Some(number) = next.filter(|&number| !walked[number]) {
                walked[number] = true;
                let [first, last, middle] = self.edges[number].nodes;
                if path.is_empty() {
                    path.push(first);
                }
                if self.edges[number].count == 3 {
                    path.push(middle);
                }
                path.push(last);
                next = leaving[last];
            }
            if !path.is_empty() {
                paths.push(path);
            }
        }
        paths
    }

    /// Distance of each node of a path from its first, along the chords, mm.
    pub fn along_mm(&self, path: &[usize]) -> Vec<f64> {
        let mut along = 0.0;
        let mut previous = None;
        path.iter()
            .map(|&node| {
                if let Some(last) = previous.replace(self.points_mm[node]) {
                    along += (self.points_mm[node] - last).norm();
                }
                along
            })
            .collect()
    }
}
