//! Work-equivalent nodal shares of a force spread evenly over faces of hexahedra,
//!
//! ```text
//! sₐ = ∫ Nₐ dA/∫ dA        dA = |∂x/∂ξ × ∂x/∂η| dξ dη
//! ```
//!
//! with the shape functions of quadrilaterals of four and of eight nodes. The shares add up to 1; at the corners of an even face of
//! eight nodes they are −1/12, in the middles of its sides 1/3.
//!
//! Source: O. C. Zienkiewicz, R. L. Taylor and J. Z. Zhu, *The Finite Element Method: Its Basis and Fundamentals* (2005),
//! section 2.3.

use std::collections::BTreeMap;

use nalgebra::Vector3;

use crate::quadrature::rule;
use crate::solid::ElementKind;

/// Share of each node of distinct `faces` (four corners, or corners and middles).
pub fn spread_shares<'a>(points_mm: &[Vector3<f64>], faces: impl Iterator<Item = &'a [u32]>) -> BTreeMap<u32, f64> {
    let mut shares: BTreeMap<u32, f64> = BTreeMap::new();
    let mut whole_mm2 = 0.0;
    for nodes in faces {
        let kind = if nodes.len() == 4 { ElementKind::Quad4 } else { ElementKind::Quad8 };
        for point in &rule(kind).points {
            let [along_xi, along_eta] = [0, 1].map(|k| {
                let slopes = nodes.iter().zip(point.shape.slopes);
                slopes.map(|(node, slope)| points_mm[*node as usize] * slope[k]).sum::<Vector3<f64>>()
            });
            let area_mm2 = point.weight * along_xi.cross(&along_eta).norm();
            whole_mm2 += area_mm2;
            for (node, value) in nodes.iter().zip(point.shape.values) {
                *shares.entry(*node).or_default() += value * area_mm2;
            }
        }
    }
    shares.values_mut().for_each(|share| *share /= whole_mm2);
    shares
}
