//! Integration rules on the reference cells, with the shape functions at their points.
//!
//! | element | rule | integrates exactly |
//! |---|---|---|
//! | linear triangle | 1 point | degree 1 |
//! | quadratic triangle | 7 points (Radon) | degree 5 |
//! | bilinear quadrilateral | 2 × 2 Gauss | degree 3 in ξ and in η |
//! | quadratic quadrilaterals | 3 × 3 Gauss | degree 5 in ξ and in η |
//!
//! The stiffness of a quadratic element with straight, evenly divided sides is then exact; curved sides make the integrand
//! rational, and the remaining error is of higher order than the element's own.
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor and J. Z. Zhu, *The Finite Element Method: Its Basis and Fundamentals* (2005),
//! tables 5.2 and 5.3; J. Radon, *Monatshefte für Mathematik und Physik* 52 (1948) 286–300.

use std::sync::LazyLock;

use super::shape::{Shape, reference_nodes};
use super::solid::ElementKind;

/// Point of a rule.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegrationPoint {
    /// Coordinates (ξ, η).
    pub at: [f64; 2],
    /// Weight; the weights of a rule add up to the area of the reference cell.
    pub weight: f64,
    /// Shape functions at the point.
    pub shape: Shape,
}

/// Integration rule of a kind of element.
#[derive(Debug, Clone, PartialEq)]
pub struct Rule {
    /// Points of the rule.
    pub points: Vec<IntegrationPoint>,
    /// Shape functions at the nodes of the element, where the Jacobian is checked too.
    pub nodes: Vec<Shape>,
}

/// Abscissae and weights of Gauss and Legendre on [−1, 1] with 2 points.
pub(crate) const GAUSS_2: [(f64, f64); 2] = [(-0.577_350_269_189_625_8, 1.0), (0.577_350_269_189_625_8, 1.0)];

/// Abscissae and weights of Gauss and Legendre on [−1, 1] with 3 points.
pub const GAUSS_3: [(f64, f64); 3] =
    [(-0.774_596_669_241_483_4, 5.0 / 9.0), (0.0, 8.0 / 9.0), (0.774_596_669_241_483_4, 5.0 / 9.0)];

/// Abscissae and weights of Gauss and Legendre on [−1, 1] with 4 points.
pub(crate) const GAUSS_4: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_86),
];

/// Integration rule of an element.
pub fn rule(kind: ElementKind) -> &'static Rule {
    static TRIANGLE3: LazyLock<Rule> =
        LazyLock::new(|| Rule::new(ElementKind::Triangle3, &[([1.0 / 3.0, 1.0 / 3.0], 0.5)]));
    static TRIANGLE6: LazyLock<Rule> = LazyLock::new(|| Rule::new(ElementKind::Triangle6, &radon()));
    static QUAD4: LazyLock<Rule> = LazyLock::new(|| Rule::new(ElementKind::Quad4, &product(&GAUSS_2)));
    static QUAD8: LazyLock<Rule> = LazyLock::new(|| Rule::new(ElementKind::Quad8, &product(&GAUSS_3)));
    static QUAD9: LazyLock<Rule> = LazyLock::new(|| Rule::new(ElementKind::Quad9, &product(&GAUSS_3)));
    match kind {
        ElementKind::Triangle3 => &TRIANGLE3,
        ElementKind::Triangle6 => &TRIANGLE6,
        ElementKind::Quad4 => &QUAD4,
        ElementKind::Quad8 => &QUAD8,
        ElementKind::Quad9 => &QUAD9,
    }
}

/// Integration rule for loads, which may vary over an element: at least degree 5 for every kind.
pub fn load_rule(kind: ElementKind) -> &'static Rule {
    static TRIANGLE3: LazyLock<Rule> = LazyLock::new(|| Rule::new(ElementKind::Triangle3, &radon()));
    static QUAD4: LazyLock<Rule> = LazyLock::new(|| Rule::new(ElementKind::Quad4, &product(&GAUSS_3)));
    match kind {
        ElementKind::Triangle3 => &TRIANGLE3,
        ElementKind::Quad4 => &QUAD4,
        ElementKind::Triangle6 | ElementKind::Quad8 | ElementKind::Quad9 => rule(kind),
    }
}

impl Rule {
    fn new(kind: ElementKind, points: &[([f64; 2], f64)]) -> Self {
        let points = points.iter().map(|&(at, weight)| IntegrationPoint { at, weight, shape: Shape::at(kind, at) });
        Self { points: points.collect(), nodes: reference_nodes(kind).iter().map(|at| Shape::at(kind, *at)).collect() }
    }
}

/// All pairs of the abscissae, η slowest.
fn product(line: &[(f64, f64)]) -> Vec<([f64; 2], f64)> {
    line.iter().flat_map(|(eta, g)| line.iter().map(move |(xi, f)| ([*xi, *eta], f * g))).collect()
}

/// Radon's seven points: the middle and two orbits of three, a = (6 ∓ √15)/21, weights (155 ∓ √15)/2400.
fn radon() -> Vec<([f64; 2], f64)> {
    let root = 15f64.sqrt();
    let mut points = vec![([1.0 / 3.0, 1.0 / 3.0], 9.0 / 80.0)];
    for sign in [-1.0, 1.0] {
        let a = (6.0 + sign * root) / 21.0;
        let weight = (155.0 + sign * root) / 2400.0;
        points.extend([[a, a], [1.0 - 2.0 * a, a], [a, 1.0 - 2.0 * a]].map(|at| (at, weight)));
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn factorial(n: i32) -> f64 {
        (1..=n).map(f64::from).product()
    }

    fn integral(kind: ElementKind, p: i32, q: i32) -> f64 {
        rule(kind).points.iter().map(|point| point.weight * point.at[0].powi(p) * point.at[1].powi(q)).sum()
    }

    /// ∫ ξᵖ ηᵠ over the triangle is p! q!/(p + q + 2)!, over the square 4/((p + 1)(q + 1)) for even p and q.
    #[test]
    fn ver_rules_integrate_their_degree() {
        for (kind, degree) in [(ElementKind::Triangle3, 1), (ElementKind::Triangle6, 5)] {
            for p in 0..=degree {
                for q in 0..=degree - p {
                    let exact = factorial(p) * factorial(q) / factorial(p + q + 2);
                    assert!((integral(kind, p, q) - exact).abs() < 1e-15, "{kind:?} {p} {q}");
                }
            }
        }
        for (kind, degree) in [(ElementKind::Quad4, 3), (ElementKind::Quad8, 5), (ElementKind::Quad9, 5)] {
            for p in 0..=degree {
                for q in 0..=degree {
                    let even = p % 2 == 0 && q % 2 == 0;
                    let exact = if even { 4.0 / f64::from((p + 1) * (q + 1)) } else { 0.0 };
                    assert!((integral(kind, p, q) - exact).abs() < 1e-14, "{kind:?} {p} {q}");
                }
            }
        }
    }
}
