//! Transmission error of a planetary stage, from those of its meshes.
//!
//! With carrier and ring in their places, the sun lags at its base circle by what a planet lags behind it along one line of action, δ_sp, and the planet
//! behind the ring along the other, δ_pr, since both meshes have the same base circle of the planet. A sun that finds its place among planets that share the load takes
//! the mean:
//!
//! ```text
//! δ(φ) = (1/N) Σ_i [δ_sp(φ + φ_i) + δ_pr(φ + φ_i + γ)]
//! ```
//!
//! φ, φ_i: place within the mesh and phase of planet i, in base pitches; γ: phase of its mesh with the ring ([`gearwear_bodies::gear::planetary`]). Each mesh has
//! the load of the planet that carries most.

use super::MeshFindings;
use super::record::StageTransmissionRow;
use gearwear_physics::results::run::{MeshCycleRow, RangeSummary};

/// Rows over one base pitch.
const ROWS: usize = 200;

/// Transmission error of one mesh over one base pitch, again and again.
struct PeriodicError<'a> {
    rows: &'a [MeshCycleRow],
    pitch_point_mm: f64,
    base_pitch_mm: f64,
}

impl<'a> PeriodicError<'a> {
    /// `None` where the path of contact is shorter than a base pitch.
    fn of(MeshFindings { summary, mesh_cycle: rows }: MeshFindings<'a>) -> Option<Self> {
        let geometry = &summary.geometry;
        let [first, last] = [rows.first()?.position_mm, rows.last()?.position_mm];
        let base_pitch_mm = geometry.base_pitch_mm;
        (last - first >= base_pitch_mm).then_some(Self {
            rows,
            pitch_point_mm: geometry.curvature_radius_mm.C,
            base_pitch_mm,
        })
    }

    /// Value of `of` at `phase` base pitches beyond the pitch point, straight between positions.
    fn at(&self, phase: f64, of: fn(&MeshCycleRow) -> f64) -> f64 {
        let first_mm = self.rows[0].position_mm;
        let beyond_mm = self.pitch_point_mm + phase * self.base_pitch_mm - first_mm;
        let position_mm = first_mm + beyond_mm.rem_euclid(self.base_pitch_mm);
        let next = self.rows.partition_point(|row| row.position_mm <= position_mm).clamp(1, self.rows.len() - 1);
        let (before, after) = (&self.rows[next - 1], &self.rows[next]);
        let share = (position_mm - before.position_mm) / (after.position_mm - before.position_mm);
        of(before) + share * (of(after) - of(before))
    }
}

/// Rows over one base pitch; empty where a path of contact is shorter than that.
pub(super) fn rows(
    phases: &[f64],
    ring_mesh_phase: f64,
    sun_planet: MeshFindings<'_>,
    planet_ring: MeshFindings<'_>,
) -> Vec<StageTransmissionRow> {
    let (Some(sun), Some(ring)) = (PeriodicError::of(sun_planet), PeriodicError::of(planet_ring)) else {
        return Vec::new();
    };
    let of_stage = |phase: f64, of: fn(&MeshCycleRow) -> f64| {
        let of_planet = |own: &f64| sun.at(phase + own, of) + ring.at(phase + own + ring_mesh_phase, of);
        phases.iter().map(of_planet).sum::<f64>() / phases.len() as f64
    };
    let new: fn(&MeshCycleRow) -> f64 = |row| row.transmission_error_new_um;
    let worn: fn(&MeshCycleRow) -> f64 = |row| row.transmission_error_worn_um;
    (0..ROWS)
        .map(|row| {
            let mesh_phase = row as f64 / ROWS as f64;
            StageTransmissionRow {
                mesh_phase,
                sun_planet_new_um: sun.at(mesh_phase, new),
                planet_ring_new_um: ring.at(mesh_phase + ring_mesh_phase, new),
                stage_new_um: of_stage(mesh_phase, new),
                sun_planet_worn_um: sun.at(mesh_phase, worn),
                planet_ring_worn_um: ring.at(mesh_phase + ring_mesh_phase, worn),
                stage_worn_um: of_stage(mesh_phase, worn),
            }
        })
        .collect()
}

/// Extremes of a column; `None` without rows.
pub(super) fn range(rows: &[StageTransmissionRow], of: fn(&StageTransmissionRow) -> f64) -> Option<RangeSummary> {
    let values = rows.iter().map(of);
    let min = values.clone().reduce(f64::min)?;
    let max = values.reduce(f64::max)?;
    Some(RangeSummary { min, max, peak_to_peak: max - min })
}
