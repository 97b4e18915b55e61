//! Dual basis functions of the multipliers on one slave edge.
//!
//! The dual basis ψ is biorthogonal to a basis φ of the same nodes,
//!
//! ```text
//! ∫ ψ_i φ_j dγ = δ_ij ∫ φ_j dγ        ψ = A φ,   A = diag(∫φ_j) M⁻¹,   M_ij = ∫ φ_i φ_j dγ
//! ```
//!
//! so Σ ψ_i = 1 (a constant pressure is represented exactly), and the weighted gap of a node is its own gap wherever the gap is
//! in the span of φ. Where the master faces the whole edge, φ are the edge's shape functions. Where it faces a part only,
//! φ are hat functions on the half-edges, restricted to that part: their integrals are positive over any part,
//! unlike those of a quadratic shape function.
//!
//! Source: B. Wohlmuth, *SIAM J. Numer. Anal.* 38 (2000) 989–1012; T. Cichosz and M. Bischoff, *Comput. Methods Appl.
//! Mech. Eng.* 200 (2011) 1317–1332 (partly covered edges).

use nalgebra::{Matrix2, Matrix3, Vector3};

use super::edge::{MOST_NODES, shape};

/// Gauss points over an interval, exact to degree 11, more than curved edges need.
pub(crate) const GAUSS: [(f64, f64); 6] = [
    (-0.932_469_514_203_152, 0.171_324_492_379_170_3),
    (-0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (-0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.238_619_186_083_196_9, 0.467_913_934_572_691),
    (0.661_209_386_466_264_5, 0.360_761_573_048_138_6),
    (0.932_469_514_203_152, 0.171_324_492_379_170_3),
];

/// Least fraction of an interval between nodes that has a pressure.
const LEAST_COVERED: f64 = 0.01;

/// Points and weights of the interval from `a` to `b`.
pub(crate) fn gauss_points(a: f64, b: f64) -> impl Iterator<Item = (f64, f64)> {
    let (middle, half) = (0.5 * (a + b), 0.5 * (b - a));
    GAUSS.into_iter().map(move |(x, w)| (middle + half * x, half * w))
}

/// Dual basis of one edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum DualBasis {
    /// Basis ψ = A N over the whole edge.
    Whole {
        /// Number of nodes, 2 or 3.
        nodes: usize,
        /// Matrix A.
        transform: Matrix3<f64>,
    },
    /// Dual of the hats on each interval between nodes.
    Parts {
        /// Intervals that face the master.
        parts: [Option<HatPart>; 2],
    },
}

/// Dual of two hats over one interval between neighbouring nodes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct HatPart {
    /// Local numbers of the nodes at the ends.
    nodes: [usize; 2],
    /// Coordinates ξ of these nodes.
    places: [f64; 2],
    transform: Matrix2<f64>,
}

impl DualBasis {
    /// Basis of an edge with `nodes` nodes that faces the master for ξ in `covered`; `jacobian` is dγ/dξ.
    pub(crate) fn new(nodes: usize, covered: (f64, f64), jacobian: impl Fn(f64) -> f64) -> Self {
        const WHOLE: f64 = 1.0 - 1e-9;
        if covered.0 <= -WHOLE && covered.1 >= WHOLE {
            return Self::whole(nodes, jacobian);
        }
        Self::hats(nodes, covered, jacobian)
    }

    /// Dual of hats over the part `covered` of an edge with `nodes` nodes, also where that is the whole.
    pub(crate) fn hats(nodes: usize, covered: (f64, f64), jacobian: impl Fn(f64) -> f64) -> Self {
        let intervals = match nodes {
            2 => [Some(([0, 1], [-1.0, 1.0])), None],
            _ => [Some(([0, 2], [-1.0, 0.0])), Some(([2, 1], [0.0, 1.0]))],
        };
        let parts = intervals
            .map(|interval| interval.and_then(|(nodes, places)| HatPart::new(nodes, places, covered, &jacobian)));
        Self::Parts { parts }
    }

    fn whole(nodes: usize, jacobian: impl Fn(f64) -> f64) -> Self {
        let (mut mass, mut sums) = (Matrix3::zeros(), Vector3::zeros());
        for (xi, weight) in gauss_points(-1.0, 1.0) {
            let n = Vector3::from(shape(nodes, xi));
            let weight = weight * jacobian(xi);
            mass += weight * n * n.transpose();
            sums += weight * n;
        }
        if nodes == 2 {
            mass[(2, 2)] = 1.0;
        }
        // The mass matrix of a non-degenerate edge is positive definite; a degenerate one has no pressure.
        let inverse = mass.try_inverse().unwrap_or_else(Matrix3::zeros);
        Self::Whole { nodes, transform: Matrix3::from_diagonal(&sums) * inverse }
    }

    /// Values ψ at ξ; zero where the edge does not face the master.
    pub(crate) fn at(&self, xi: f64) -> [f64; MOST_NODES] {
        match self {
            Self::Whole { nodes, transform } => (transform * Vector3::from(shape(*nodes, xi))).into(),
            Self::Parts { parts } => {
                let mut psi = [0.0; MOST_NODES];
                for part in parts.iter().flatten() {
                    if (part.places[0]..=part.places[1]).contains(&xi) {
                        let values = part.transform * part.hats(xi);
                        psi[part.nodes[0]] = values[0];
                        psi[part.nodes[1]] = values[1];
                    }
                }
                psi
            }
        }
    }
}

impl HatPart {
    fn new(nodes: [usize; 2], places: [f64; 2], covered: (f64, f64), jacobian: impl Fn(f64) -> f64) -> Option<Self> {
        let (from, to) = (covered.0.max(places[0]), covered.1.min(places[1]));
        if to - from < LEAST_COVERED * (places[1] - places[0]) {
            return None;
        }
        let mut part = Self { nodes, places, transform: Matrix2::identity() };
        let (mut mass, mut sums) = (Matrix2::zeros(), nalgebra::Vector2::zeros());
        for (xi, weight) in gauss_points(from, to) {
            let hats = part.hats(xi);
            let weight = weight * jacobian(xi);
            mass += weight * hats * hats.transpose();
            sums += weight * hats;
        }
        part.transform = Matrix2::from_diagonal(&sums) * mass.try_inverse()?;
        Some(part)
    }

    fn hats(&self, xi: f64) -> nalgebra::Vector2<f64> {
        let second = (xi - self.places[0]) / (self.places[1] - self.places[0]);
        nalgebra::Vector2::new(1.0 - second, second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ∫ ψ_i N_j = δ_ij ∫ N_j, and for a straight quadratic edge the integrals are 1/3, 1/3, 4/3 (Simpson's rule).
    #[test]
    fn ver_biorthogonal_on_a_curved_edge() {
        let jacobian = |xi: f64| 1.0 + 0.2 * xi;
        for nodes in [2, 3] {
            let basis = DualBasis::new(nodes, (-1.0, 1.0), jacobian);
            let (mut product, mut sums) = (Matrix3::<f64>::zeros(), Vector3::zeros());
            for (xi, weight) in gauss_points(-1.0, 1.0) {
                let (psi, n) = (Vector3::from(basis.at(xi)), Vector3::from(shape(nodes, xi)));
                product += weight * jacobian(xi) * psi * n.transpose();
                sums += weight * jacobian(xi) * n;
            }
            for i in 0..nodes {
                for j in 0..nodes {
                    let expected = if i == j { sums[i] } else { 0.0 };
                    assert!((product[(i, j)] - expected).abs() < 1e-14, "{nodes} {product}");
                }
            }
        }
    }

    #[test]
    fn ver_partition_of_unity_also_on_a_part() {
        for (nodes, covered) in [(2, (-1.0, -0.3)), (3, (-0.2, 1.0)), (3, (-1.0, -0.6)), (3, (-1.0, 1.0))] {
            let basis = DualBasis::new(nodes, covered, |_| 0.7);
            for (xi, _) in gauss_points(covered.0, covered.1) {
                let sum: f64 = basis.at(xi).iter().sum();
                assert!((sum - 1.0).abs() < 1e-12, "{nodes} {covered:?} {xi} {sum}");
            }
        }
    }
}
