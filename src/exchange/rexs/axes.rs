//! Distance of two gears' axes, by where the file puts them.

use super::document::{RexsComponent, RexsDocument};

/// Cosine of the angle between axes that are parallel, at least.
const PARALLEL: f64 = 1.0 - 1e-6;

/// How two axes lie to one another.
#[derive(Debug, PartialEq)]
pub(super) enum Axes {
    /// At this distance, mm.
    Parallel(f64),
    Crossed,
}

/// The axes of two gears, or of the shafts that carry them; None where the file does not say where they are.
pub(super) fn of(document: &RexsDocument, gears: [&RexsComponent; 2]) -> Option<Axes> {
    between(gears[0], gears[1]).or_else(|| between(document.shaft_of(gears[0])?, document.shaft_of(gears[1])?))
}

/// The axes of two components whose places are of the same reference.
fn between(one: &RexsComponent, other: &RexsComponent) -> Option<Axes> {
    let reference = |component: &RexsComponent| component.text("reference_component_for_position").map(str::to_owned);
    if reference(one) != reference(other) {
        return None;
    }
    let [at, to] = [one.vector_mm("support_vector")?, other.vector_mm("support_vector")?];
    // Without a direction the axes are the u axis of the gear unit.
    let [along, mate] = [one, other].map(|part| unit(part.vector_mm("u_axis_vector").unwrap_or([1.0, 0.0, 0.0])));
    let (along, mate) = (along?, mate?);
    if dot(along, mate).abs() < PARALLEL {
        return Some(Axes::Crossed);
    }
    let apart = [0, 1, 2].map(|i| to[i] - at[i]);
    let on_axis = dot(apart, along);
    let square = [0, 1, 2].map(|i| apart[i] - on_axis * along[i]);
    let distance_mm = dot(square, square).sqrt();
    (distance_mm > 1e-9).then_some(Axes::Parallel(distance_mm))
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// The vector of length 1.
fn unit(vector: [f64; 3]) -> Option<[f64; 3]> {
    let length = dot(vector, vector).sqrt();
    (length > 0.0 && length.is_finite()).then(|| vector.map(|x| x / length))
}
