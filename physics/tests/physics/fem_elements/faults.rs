//! Meshes and materials that are refused, each with the place.

use gearwear_fem::elastic::{Analysis, Elastic};
use gearwear_fem::element::ElementError;
use gearwear_fem::solid::{Element, ElementKind, Solid};
use gearwear_fem::stiffness::Stiffness;
use nalgebra::Vector2;

use super::common::STEEL;
use super::meshes::{KINDS, block};

fn assembled(solid: &Solid, materials: &[Elastic]) -> Result<Stiffness, ElementError> {
    Stiffness::new(solid, materials, Analysis::PlaneStrain)
}

#[test]
fn folded_elements_are_named() {
    for kind in KINDS {
        let mut solid = block(kind, 3, 3, Vector2::new).solid;
        // A corner of the element in the middle goes over the opposite side.
        let number = solid.elements.len() / 2;
        let nodes = solid.elements[number].nodes().to_vec();
        let other = solid.points_mm[nodes[1] as usize] + solid.points_mm[nodes[2] as usize];
        solid.points_mm[nodes[0] as usize] = other * 0.5 + (other * 0.5 - solid.points_mm[nodes[0] as usize]);
        match assembled(&solid, &[STEEL]) {
            Err(ElementError::Distorted { element, determinant_mm2, at_mm, .. }) => {
                assert!(solid.elements[element].nodes().contains(&nodes[0]), "{kind:?}");
                assert!(determinant_mm2 <= 0.0 && at_mm.x.is_finite(), "{kind:?} {determinant_mm2}");
            }
            result => panic!("{kind:?}: {:?}", result.map(|stiffness| stiffness.matrix().dofs())),
        }
    }
}

#[test]
fn clockwise_flat_and_unbounded_elements_are_named() {
    let bad = |points: &[[f64; 2]], kind, nodes: &[u32]| {
        let points_mm = points.iter().map(|x| Vector2::new(x[0], x[1])).collect();
        let solid = Solid { points_mm, elements: vec![Element::new(kind, nodes, 0)] };
        matches!(assembled(&solid, &[STEEL]), Err(ElementError::Distorted { element: 0, .. }))
    };
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    assert!(!bad(&square, ElementKind::Quad4, &[0, 1, 2, 3]));
    assert!(bad(&square, ElementKind::Quad4, &[3, 2, 1, 0]), "clockwise");
    assert!(bad(&square, ElementKind::Triangle3, &[0, 2, 1]), "clockwise");
    assert!(bad(&square, ElementKind::Quad4, &[0, 2, 1, 3]), "crossed");
    let flat = [[0.0, 0.0], [1.0, 1.0], [2.0, 2.0], [f64::NAN, 0.0]];
    assert!(bad(&flat, ElementKind::Triangle3, &[0, 1, 2]), "flat");
    assert!(bad(&flat, ElementKind::Triangle3, &[0, 1, 3]), "not a number");
    assert!(bad(&flat, ElementKind::Quad4, &[0, 0, 0, 0]), "a point");
    // An arrow: its area is positive, one corner is turned in.
    let arrow = [[0.0, 0.0], [1.0, 0.0], [0.3, 0.3], [0.0, 1.0]];
    assert!(bad(&arrow, ElementKind::Quad4, &[0, 1, 2, 3]), "arrow");
}

#[test]
fn missing_nodes_and_unstable_materials_are_named() {
    let solid = block(ElementKind::Quad4, 2, 2, Vector2::new).solid;
    assert!(matches!(
        assembled(&solid, &[]),
        Err(ElementError::NoSuchMaterial { element: 0, material: 0, materials: 0 })
    ));
    for (young_modulus_mpa, poisson_ratio) in [(0.0, 0.3), (-1.0, 0.3), (f64::NAN, 0.3), (1.0, 0.5), (1.0, f64::NAN)] {
        let result = assembled(&solid, &[STEEL, Elastic { young_modulus_mpa, poisson_ratio }]);
        assert!(
            matches!(result, Err(ElementError::Material { material: 1, .. })),
            "{young_modulus_mpa} {poisson_ratio}"
        );
    }
    let mut short = solid.clone();
    short.points_mm.pop();
    assert!(matches!(assembled(&short, &[STEEL]), Err(ElementError::NoSuchNode { element: 3, node: 8, nodes: 8 })));
}
