//! Search for the element that contains a point.
//!
//! The map x(ξ, η) of a curved element is inverted by Newton's method from the middle of its reference cell; boxes around
//! the elements, widened for the bulge of curved sides, exclude most of them.

use nalgebra::Vector2;

use super::shape::Shape;
use super::solid::{Element, ElementKind, Solid};

/// Tolerance for points on the boundary of an element, in units of the reference cell.
const TOLERANCE: f64 = 1e-9;
/// Greatest number of Newton steps; about five are enough for slightly curved sides.
const MOST_STEPS: usize = 25;

/// A point within an element.
#[derive(Debug, Clone, PartialEq)]
pub struct ElementPoint {
    /// Number of the element.
    pub element: usize,
    /// Nodes with the values of their shape functions at the point.
    pub weights: Vec<(u32, f64)>,
}

/// First element of `solid` that contains `point_mm`; `None` outside all of them.
pub fn locate(solid: &Solid, point_mm: Vector2<f64>) -> Option<ElementPoint> {
    solid.elements.iter().enumerate().find_map(|(number, element)| {
        let shape = within(solid, element, point_mm)?;
        let weights = element.nodes().iter().copied().zip(shape.values).collect();
        Some(ElementPoint { element: number, weights })
    })
}

/// Shape functions at the point, where the element contains it.
fn within(solid: &Solid, element: &Element, point_mm: Vector2<f64>) -> Option<Shape> {
    let nodes_mm: Vec<Vector2<f64>> = element.nodes().iter().map(|&node| solid.points_mm[node as usize]).collect();
    let low = nodes_mm.iter().fold(nodes_mm[0], |low, p| low.inf(p));
    let high = nodes_mm.iter().fold(nodes_mm[0], |high, p| high.sup(p));
    let size_mm = (high - low).norm();
    let bulge = 0.1 * size_mm;
    if (0..2).any(|i| point_mm[i] < low[i] - bulge || point_mm[i] > high[i] + bulge) {
        return None;
    }
    let triangle = matches!(element.kind, ElementKind::Triangle3 | ElementKind::Triangle6);
    let mut at = if triangle { Vector2::repeat(1.0 / 3.0) } else { Vector2::zeros() };
    for _ in 0..MOST_STEPS {
        let shape = Shape::at(element.kind, at.into());
        let left = point_mm - shape.point(&nodes_mm);
        if left.norm() < 1e-13 * size_mm {
            break;
        }
        at += shape.jacobian(&nodes_mm).try_inverse()? * left;
    }
    let inside = if triangle {
        at.x >= -TOLERANCE && at.y >= -TOLERANCE && at.x + at.y <= 1.0 + TOLERANCE
    } else {
        at.amax() <= 1.0 + TOLERANCE
    };
    let shape = Shape::at(element.kind, at.into());
    (inside && (shape.point(&nodes_mm) - point_mm).norm() < 1e-9 * size_mm).then_some(shape)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neighbouring elements, one with a curved side: the located point is the given one.
    #[test]
    fn ver_a_located_point_is_its_shape_functions_times_nodes() {
        let points_mm = [
            [0.0, 0.0],
            [1.0, 0.0],
            [1.0, 1.0],
            [0.0, 1.0],
            [0.5, 0.1],
            [1.0, 0.5],
            [0.5, 1.0],
            [0.0, 0.5],
            [2.0, 0.0],
            [1.5, 0.0],
            [1.5, 0.5],
        ];
        let solid = Solid {
            points_mm: points_mm.map(Vector2::from).to_vec(),
            elements: vec![
                Element::new(ElementKind::Quad8, &[0, 1, 2, 3, 4, 5, 6, 7], 0),
                Element::new(ElementKind::Triangle6, &[1, 8, 2, 9, 10, 5], 0),
            ],
        };
        for (point, element) in [([0.3, 0.4], 0), ([0.5, 0.2], 0), ([1.3, 0.3], 1), ([1.01, 0.98], 1)] {
            let point = Vector2::from(point);
            let place = locate(&solid, point).unwrap();
            assert_eq!(place.element, element);
            let back: Vector2<f64> = place.weights.iter().map(|&(n, w)| solid.points_mm[n as usize] * w).sum();
            assert!((back - point).norm() < 1e-12, "{point:?}");
        }
        // Below the curved side, and right of the triangle.
        for point in [[0.5, 0.05], [1.9, 0.4]] {
            assert_eq!(locate(&solid, Vector2::from(point)), None);
        }
    }
}
