//! Coupling of two surfaces: the gap of every multiplier as a linear function of the displacements.
//!
//! ```text
//! g_i = g_i⁰ + Σ_k B_ik · u_k,     B_ik = (1/w_i) ∫ ψ_i n (N_k^m − N_k^s) dγ,     w_i = ∫ ψ_i dγ
//! ```
//!
//! with dγ the area of the slave, per mm of thickness in the plane and of the whole circumference of a body of revolution,
//! integrated segment by segment, so that no kink of the integrand falls between integration points. With the force
//! f_i = w_i λ_i the nodal forces are Bᵀ f.

use nalgebra::Vector2;
use sprs::CsMat;

use super::dual_basis::{DualBasis, gauss_points};
use super::edge::shape;
use super::master_search::{FacingSegment, MasterSearch, SlavePoint};
use super::surface::Surface;
use crate::elastic::Analysis;

/// Weight over that of a fully faced node below which a multiplier is a sliver: its basis function is added to that of
/// a neighbour, so that a constant pressure is still represented; without a neighbour it is left out.
const LEAST_WEIGHT: f64 = 0.05;

/// Coupling of a slave surface with a master surface; a row for every slave node that faces the master, or for a group of them ([`MortarCoupling::grouped`]).
///
/// Columns are `2 · local node + component` of each surface.
#[derive(Debug, Clone)]
pub struct MortarCoupling {
    /// Local slave node of each row; of a group of them ([`Self::grouped`]) the middle one.
    pub nodes: Vec<usize>,
    /// First and last local slave node of each row, in the order of the rows that were grouped.
    pub ends: Vec<[usize; 2]>,
    /// Weights w_i, mm.
    pub weight_mm: Vec<f64>,
    /// Initial gaps g_i⁰, mm.
    pub gap_mm: Vec<f64>,
    /// Matrix B for displacements of the slave.
    pub slave: CsMat<f64>,
    /// Matrix B for displacements of the master.
    pub master: CsMat<f64>,
}

/// Integrals of one multiplier.
#[derive(Debug, Clone, Default)]
struct MultiplierSums {
    weight_mm: f64,
    /// Weight if the master faced all of the node's edges.
    whole_mm: f64,
    gap_mm2: f64,
    slave: Vec<(usize, Vector2<f64>)>,
    master: Vec<(usize, Vector2<f64>)>,
}

impl MultiplierSums {
    fn is_sliver(&self) -> bool {
        self.weight_mm <= LEAST_WEIGHT * self.whole_mm
    }

    /// Adds the integrals of another multiplier.
    fn take(&mut self, other: &MultiplierSums) {
        self.weight_mm += other.weight_mm;
        self.gap_mm2 += other.gap_mm2;
        for &(node, value) in &other.slave {
            add(&mut self.slave, node, value);
        }
        for &(node, value) in &other.master {
            add(&mut self.master, node, value);
        }
    }
}

/// Adds the basis function of each sliver to that of the neighbour with the greatest weight.
fn hand_over_slivers(slave: &Surface, rows: &mut [MultiplierSums]) {
    let mut neighbour: Vec<Option<usize>> = vec![None; rows.len()];
    for edge in &slave.edges {
        for &node in edge.nodes().iter().filter(|&&node| rows[node].is_sliver() && rows[node].weight_mm > 0.0) {
            for &other in edge.nodes().iter().filter(|&&other| !rows[other].is_sliver()) {
                if neighbour[node].is_none_or(|best: usize| rows[other].weight_mm > rows[best].weight_mm) {
                    neighbour[node] = Some(other);
                }
            }
        }
    }
    for (node, neighbour) in neighbour.into_iter().enumerate() {
        if let Some(neighbour) = neighbour {
            let sliver = std::mem::take(&mut rows[node]);
            rows[neighbour].take(&sliver);
        }
    }
}

/// Adds `value` to the entry of `node`.
fn add(entries: &mut Vec<(usize, Vector2<f64>)>, node: usize, value: Vector2<f64>) {
    match entries.iter_mut().find(|(other, _)| *other == node) {
        Some((_, sum)) => *sum += value,
        None => entries.push((node, value)),
    }
}

impl MortarCoupling {
    /// Couples `slave` to `master` where their distance along the slave's normals is at most `reach_mm`.
    pub fn new(slave: &Surface, master: &Surface, reach_mm: f64, analysis: Analysis) -> Self {
        let facing = MasterSearch::new(master);
        let mut rows = vec![MultiplierSums::default(); slave.points_mm.len()];
        let edges = 0..slave.edges.len();
        let segments: Vec<Vec<FacingSegment>> = edges.map(|number| facing.segments(slave, number, reach_mm)).collect();
        // Where the surfaces face each other nowhere there are no rows.
        if segments.iter().any(|of_edge| !of_edge.is_empty()) {
            for (number, segments) in segments.iter().enumerate() {
                integrate_edge((slave, number, analysis), &facing, segments, &mut rows);
            }
        }
        hand_over_slivers(slave, &mut rows);
        let kept: Vec<(usize, MultiplierSums)> =
            rows.into_iter().enumerate().filter(|(_, row)| !row.is_sliver()).collect();
        Self {
            nodes: kept.iter().map(|(node, _)| *node).collect(),
            ends: kept.iter().map(|(node, _)| [*node; 2]).collect(),
            weight_mm: kept.iter().map(|(_, row)| row.weight_mm).collect(),
            gap_mm: kept.iter().map(|(_, row)| row.gap_mm2 / row.weight_mm).collect(),
            slave: operator(&kept, slave.points_mm.len(), |row| &row.slave),
            master: operator(&kept, master.points_mm.len(), |row| &row.master),
        }
    }

    /// Coupling with one multiplier for each of `groups` of rows that follow one another along the slave: its pressure is even over all of them.
    pub fn grouped(&self, groups: &[Vec<usize>]) -> Self {
        let weight_mm: Vec<f64> = groups.iter().map(|rows| rows.iter().map(|&row| self.weight_mm[row]).sum()).collect();
        let mean = |rows: &[usize], whole_mm: f64| {
            rows.iter().map(|&row| self.weight_mm[row] * self.gap_mm[row]).sum::<f64>() / whole_mm
        };
        Self {
            nodes: groups.iter().map(|rows| self.nodes[rows[rows.len() / 2]]).collect(),
            ends: groups.iter().map(|rows| [self.nodes[rows[0]], self.nodes[rows[rows.len() - 1]]]).collect(),
            gap_mm: groups.iter().zip(&weight_mm).map(|(rows, &whole_mm)| mean(rows, whole_mm)).collect(),
            slave: self.grouped_operator(&self.slave, groups, &weight_mm),
            master: self.grouped_operator(&self.master, groups, &weight_mm),
            weight_mm,
        }
    }

    /// Matrix B of groups of rows with the weights `whole_mm`.
    fn grouped_operator(&self, operator: &CsMat<f64>, groups: &[Vec<usize>], whole_mm: &[f64]) -> CsMat<f64> {
        let mut sums = RowSums::new(operator.cols());
        for (rows, whole_mm) in groups.iter().zip(whole_mm) {
            for &row in rows {
                let part = self.weight_mm[row] / whole_mm;
                let entries = operator.outer_view(row);
                entries.iter().flat_map(|row| row.iter()).for_each(|(column, b)| sums.row.push((column, part * b)));
            }
            sums.end_row();
        }
        sums.matrix()
    }

    /// Number of multipliers.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// Whether no node of the slave faces the master.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }
}

/// Adds the integrals over one slave edge.
fn integrate_edge(
    (slave, number, analysis): (&Surface, usize, Analysis),
    facing: &MasterSearch<'_>,
    segments: &[FacingSegment],
    rows: &mut [MultiplierSums],
) {
    let edge = &slave.edges[number];
    let count = edge.nodes().len();
    let jacobian = |xi: f64| {
        let (at_mm, tangent) = slave.point_and_tangent(edge, xi);
        tangent.norm() * analysis.thickness_mm(at_mm.x)
    };
    let whole = match (analysis, count) {
        // The end of a quadratic edge on the axis has no area of its own but that of its hat.
        (Analysis::Axisymmetric, 3) => DualBasis::hats(count, (-1.0, 1.0), jacobian),
        _ => DualBasis::new(count, (-1.0, 1.0), jacobian),
    };
    for (xi, weight) in gauss_points(-1.0, 1.0) {
        for (psi, &node) in whole.at(xi).iter().zip(edge.nodes()) {
            rows[node].whole_mm += weight * jacobian(xi) * psi;
        }
    }
    let (Some(first), Some(last)) = (segments.first(), segments.last()) else { return };
    let faced: f64 = segments.iter().map(|segment| segment.to - segment.from).sum();
    // Between segments with a distance the master has a hole, which is treated as its end is.
    let unbroken = (last.to - first.from - faced).abs() < 1e-9;
    let basis = match (first.from, last.to) {
        (from, to) if unbroken && from == -1.0 && to == 1.0 => whole,
        (from, to) => DualBasis::hats(count, (from, to.min(1.0 - 2e-9).max(from)), jacobian),
    };
    for segment in segments {
        for (from, to) in smooth_stretches(segment, &basis) {
            for (xi, weight) in gauss_points(from, to) {
                let Some(point) = SlavePoint::new(slave, edge, xi) else { continue };
                let Some(meeting) = facing.meet(point, segment.master) else { continue };
                let normal = point.normal;
                let (psi, weight) = (basis.at(xi), weight * jacobian(xi));
                let own_shape = shape(count, xi);
                let master_nodes = facing.master.edges[segment.master].nodes();
                let mate_shape = shape(master_nodes.len(), meeting.eta);
                for (psi, &node) in psi.iter().zip(edge.nodes()) {
                    let (row, weight) = (&mut rows[node], weight * psi);
                    row.weight_mm += weight;
                    row.gap_mm2 += weight * meeting.gap_mm;
                    for (n, &k) in own_shape.iter().zip(edge.nodes()) {
                        add(&mut row.slave, k, -weight * n * normal);
                    }
                    for (n, &k) in mate_shape.iter().zip(master_nodes) {
                        add(&mut row.master, k, weight * n * normal);
                    }
                }
            }
        }
    }
}

/// Parts of a segment over which `basis` is smooth: on a partly faced edge it has a kink at the middle node.
fn smooth_stretches(segment: &FacingSegment, basis: &DualBasis) -> impl Iterator<Item = (f64, f64)> + use<> {
    let cut = match basis {
        DualBasis::Whole { .. } => segment.to,
        DualBasis::Parts { .. } => 0.0_f64.clamp(segment.from, segment.to),
    };
    [(segment.from, cut), (cut, segment.to)].into_iter().filter(|(from, to)| to > from)
}

/// Sparse matrix B on one surface.
fn operator(
    rows: &[(usize, MultiplierSums)],
    nodes: usize,
    entries: impl Fn(&MultiplierSums) -> &Vec<(usize, Vector2<f64>)>,
) -> CsMat<f64> {
    let mut sums = RowSums::new(2 * nodes);
    for (_, row) in rows {
        for (node, value) in entries(row) {
            sums.row.extend([(2 * node, value.x / row.weight_mm), (2 * node + 1, value.y / row.weight_mm)]);
        }
        sums.end_row();
    }
    sums.matrix()
}

/// Sparse matrix that is made row by row.
struct RowSums {
    columns: usize,
    /// Entries of the present row in any order; those of one column are added up.
    row: Vec<(usize, f64)>,
    ends: Vec<usize>,
    indices: Vec<usize>,
    values: Vec<f64>,
}

impl RowSums {
    fn new(columns: usize) -> Self {
        Self { columns, row: Vec::new(), ends: vec![0], indices: Vec::new(), values: Vec::new() }
    }

    fn end_row(&mut self) {
        // Stable: entries of a column are added in the order in which they came.
        self.row.sort_by_key(|(column, _)| *column);
        let begin = self.indices.len();
        for (column, value) in self.row.drain(..) {
            match self.values.last_mut() {
                Some(sum) if self.indices[begin..].last() == Some(&column) => *sum += value,
                _ => {
                    self.indices.push(column);
                    self.values.push(value);
                }
            }
        }
        self.ends.push(self.indices.len());
    }

    fn matrix(self) -> CsMat<f64> {
        CsMat::new((self.ends.len() - 1, self.columns), self.ends, self.indices, self.values)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Edge;

    /// Flat surface with nodes at `x_mm`, body below or above.
    fn flat(x_mm: &[f64], y_mm: f64) -> Surface {
        let points: Vec<Vector2<f64>> = x_mm.iter().map(|&x| Vector2::new(x, y_mm)).collect();
        let edges: Vec<Edge> = (1..x_mm.len() as u32).map(|end| Edge { ends: [end - 1, end], middle: None }).collect();
        Surface::new(&edges, &points)
    }

    /// A group of multipliers loads both surfaces as its rows do together under an even pressure, and its gap is their mean.
    #[test]
    fn ver_groups_are_the_sum_of_their_rows() {
        let (slave, master) = (flat(&[0.0, 0.3, 0.5, 1.1, 1.4, 2.0], 0.0), flat(&[2.2, 1.5, 0.8, 0.1, -0.5], -0.02));
        let fine = MortarCoupling::new(&slave, &master, 1.0, Analysis::PlaneStrain);
        assert_eq!(fine.len(), 6);
        let groups = [vec![0, 1], vec![2, 3, 4], vec![5]];
        let grouped = fine.grouped(&groups);
        assert_eq!((grouped.len(), &grouped.ends[1]), (3, &[2, 4]));
        for (at, rows) in groups.iter().enumerate() {
            let whole_mm: f64 = rows.iter().map(|&row| fine.weight_mm[row]).sum();
            assert!((grouped.weight_mm[at] - whole_mm).abs() < 1e-15);
            let gap_mm: f64 = rows.iter().map(|&row| fine.weight_mm[row] * fine.gap_mm[row]).sum();
            assert!((grouped.gap_mm[at] * whole_mm - gap_mm).abs() < 1e-15);
            for (own, others) in [(&grouped.slave, &fine.slave), (&grouped.master, &fine.master)] {
                for column in 0..own.cols() {
                    let entry = |matrix: &CsMat<f64>, row| matrix.get(row, column).copied().unwrap_or(0.0);
                    let sum: f64 = rows.iter().map(|&row| fine.weight_mm[row] * entry(others, row)).sum();
                    assert!((entry(own, at) * whole_mm - sum).abs() < 1e-15, "{at} {column}");
                }
            }
        }
    }
}
