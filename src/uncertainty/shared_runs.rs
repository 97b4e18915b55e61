//! Samples that differ in their wear coefficient alone share a run.
//!
//! Depth grows with k p ds in every wear law, and pressure knows nothing of k: under one load and speed, wear depends on k and on the revolutions n only
//! through their product. The run with the greatest coefficient of such samples passes through the state of each of the others at its own n:
//!
//! ```text
//! h(k, N) = h(k_max, N k/k_max)
//! ```

use std::collections::BTreeMap;

use super::sampled_run::SampledQuestion;
use crate::evaluate::figure;
use crate::evaluate::output::SummaryOutput;
use crate::scene::loaded::LoadedScene;
use crate::scene::opened::{EachMesh, OpenedScene};
use crate::varied_scene::VariedScene;
use gearwear_bodies::gear::{Gear, PerGear};
use gearwear_physics::operation::Scene;
use gearwear_physics::simulation::settings::Stepping;

/// Points whose samples share runs where the coefficient is the only uncertain key.
const POINTS_TOGETHER: usize = 32;
/// Relative difference of the ratios of both gears' coefficients by rounding.
const ROUNDING: f64 = 1e-12;

/// The uncertain key on which only the wear coefficients depend, by its index; `None` where samples share no runs.
pub(super) fn coefficient_key(varied: &VariedScene, question: &SampledQuestion) -> Option<usize> {
    // Lives and times follow from the coefficient too; a history has moments of its own.
    let shares = |output: &SummaryOutput| figure::find(question.kind, &output.path).is_some() && !output.is_life();
    let all_share = question.outputs.iter().all(shares) && question.limits.is_empty();
    let keys = 0..question.uncertain.len();
    keys.into_iter().filter(|_| all_share).find(|&key| {
        let of_share = |share: f64| {
            let values = question.uncertain.iter().enumerate().map(|(index, one)| {
                let share = if index == key { share } else { 0.5 };
                (one.key.as_str(), toml::Value::Float(one.distribution.quantile(share)))
            });
            varied.resolved(values)
        };
        let (low, high) = (of_share(0.25), of_share(0.75));
        low.ok().zip(high.ok()).is_some_and(|(low, high)| {
            let (low, high) = (low.each(), high.each());
            let mut both = low.all().into_iter().zip(high.all());
            both.all(|(low, high)| coefficient_ratio(low.scene(), high.scene()).is_some())
        })
    })
}

/// Ratio of the wear coefficients of `scene` to those of `other`, where the scenes differ in nothing else and have one load and no limit.
pub(super) fn coefficient_ratio(scene: &Scene, other: &Scene) -> Option<f64> {
    let operation = &scene.operation;
    let steady = operation.phases.len() == 1 && !operation.stop.are_set();
    if !steady || !matches!(scene.numerics.stepping, Stepping::Adaptive { .. }) {
        return None;
    }
    let [own, others] = [coefficients(scene)?, coefficients(other)?];
    let ratios = Gear::BOTH.map(|gear| (own[gear], others[gear]));
    let ratios: Vec<f64> = ratios
        .into_iter()
        .filter(|(own, other)| *own != 0.0 || *other != 0.0)
        .map(|(own, other)| own / other)
        .collect();
    let ratio = *ratios.first().filter(|ratio| ratio.is_finite() && **ratio > 0.0)?;
    let alike = ratios.iter().all(|one| (one / ratio - 1.0).abs() <= ROUNDING);
    (alike && without_coefficients(scene) == without_coefficients(other)).then_some(ratio)
}

/// Wear coefficients in the one phase of a scene.
fn coefficients(scene: &Scene) -> Option<PerGear<f64>> {
    let phase = scene.operation.phases.first()?;
    Some(scene.wear_in(phase).as_ref().map(|wear| wear.coefficient_mm2_per_n))
}

/// The scene with coefficients of 1.
fn without_coefficients(scene: &Scene) -> Scene {
    let mut scene = scene.clone();
    for gear in Gear::BOTH {
        scene.wear[gear].coefficient_mm2_per_n = 1.0;
        for phase in &mut scene.operation.phases {
            phase.coefficient_mm2_per_n[gear] = None;
        }
    }
    scene
}

/// Numbers of the runs of a number of points that share a run: those whose `values` but that of the `coefficient` are the same. Where that is all values,
/// points are taken [`POINTS_TOGETHER`] at a time, also beyond the last one asked for, so that a group does not depend on how many there are.
pub(super) fn groups(
    points: usize,
    runs_of_a_point: usize,
    coefficient: Option<usize>,
    values: impl Fn(usize) -> Vec<f64>,
) -> Vec<Vec<usize>> {
    let Some(coefficient) = coefficient else {
        return (0..points * runs_of_a_point).map(|number| vec![number]).collect();
    };
    let points_together = if values(0).len() == 1 { POINTS_TOGETHER } else { 1 };
    let mut groups = Vec::new();
    for first in (0..points).step_by(points_together) {
        let mut alike: BTreeMap<Vec<u64>, Vec<usize>> = BTreeMap::new();
        for number in first * runs_of_a_point..(first + points_together) * runs_of_a_point {
            let mut others = values(number);
            others.remove(coefficient);
            alike.entry(others.into_iter().map(f64::to_bits).collect()).or_default().push(number);
        }
        let mut of_points: Vec<Vec<usize>> = alike.into_values().collect();
        of_points.sort();
        groups.append(&mut of_points);
    }
    groups
}

/// The scene with the greatest coefficients of `scenes`, with a snapshot for each of them, and the revolutions of these, of each pair; `None` where they do
/// not differ in their coefficients alone.
pub(super) fn shared(scenes: &[OpenedScene]) -> Option<(OpenedScene, EachMesh<Vec<f64>>)> {
    let mut run = scenes.first()?.clone();
    let shared = EachMesh::for_each(run.kind(), |mesh| {
        let pairs = scenes.iter().map(|scene| scene.each().of(mesh).copied()).collect::<Option<Vec<_>>>()?;
        shared_by_pair(&pairs)
    })?;
    let mut pairs = shared.all().into_iter().map(|(pair, _)| pair.clone());
    run.change_each(|pair| pairs.by_ref().take(1).for_each(|shared| *pair = shared));
    Some((run, shared.map(|(_, revolutions)| revolutions)))
}

/// The same of one pair.
fn shared_by_pair(pairs: &[&LoadedScene]) -> Option<(LoadedScene, Vec<f64>)> {
    let coefficient = |pair: &LoadedScene| coefficients(pair.scene()).map_or(0.0, |of| of.pinion.max(of.wheel));
    let greatest = pairs.iter().max_by(|a, b| coefficient(a).total_cmp(&coefficient(b)))?;
    let ratios = pairs.iter().map(|pair| coefficient_ratio(pair.scene(), greatest.scene()));
    let duration = greatest.scene().operation.pinion_revolutions;
    let revolutions: Vec<f64> = ratios.map(|ratio| Some(duration * ratio?.min(1.0))).collect::<Option<_>>()?;
    let mut run = (*greatest).clone();
    let snapshots = &mut run.resolved.scene.operation.snapshots_revolutions;
    snapshots.extend(&revolutions);
    snapshots.sort_by(f64::total_cmp);
    snapshots.dedup();
    Some((run, revolutions))
}
