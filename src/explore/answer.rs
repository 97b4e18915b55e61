//! Answer to a setting of the sliders: main figures, curves and the drawing of the pair, out of the record of its run.
//!
//! Numbers are those of the record, and so of the output files. Over the face width a curve of a flank has the greatest value at each radius.

#![allow(non_snake_case, reason = "names end in their unit as in the output files")]

use std::collections::BTreeMap;

use serde::Serialize;

use super::Model;
use gearwear_bodies::gear::PerGear;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::run::{FlankRecord, MeshCycleRow, PairDrawing, RunRecord, Summary};

/// Part of the drawing around the pitch point, in transverse modules.
const DRAWN_MODULES: f64 = 3.2;
/// Decimals of a coordinate of the drawing, mm.
const DRAWN_TO: f64 = 1e4;

/// A main figure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FigureOfAnswer {
    /// Path in the summary.
    pub name: &'static str,
    pub label: &'static str,
    pub unit: &'static str,
    pub value: f64,
    /// Relative difference of finite elements to others; none where it is not known.
    pub difference: Option<f64>,
}

/// Curves over a flank.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FlankCurves {
    pub radius_mm: Vec<f64>,
    pub wear_um: Vec<f64>,
    pub pressure_new_MPa: Vec<f64>,
    pub pressure_worn_MPa: Vec<f64>,
    /// Start of active profile, beginning of the tip-edge zone, tip circle.
    pub zones_mm: [f64; 3],
}

/// Curves over the path of contact.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CycleCurves {
    pub position_mm: Vec<f64>,
    pub load_share_new: Vec<f64>,
    pub load_share_worn: Vec<f64>,
    pub transmission_error_new_um: Vec<f64>,
    pub transmission_error_worn_um: Vec<f64>,
}

/// The pair around the pitch point, mm; the pinion's axis is the origin.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DrawnPair {
    /// Pieces of the outline of each gear.
    pub outline: PerGear<Vec<Vec<[f64; 2]>>>,
    pub axis: PerGear<[f64; 2]>,
    /// Radius of the working pitch circles.
    pub working_pitch_radius_mm: PerGear<f64>,
    /// Points A–E with their names.
    pub path_of_contact: Vec<(String, [f64; 2])>,
    /// Middle of the drawing and half its side.
    pub middle: [f64; 2],
    pub half_side_mm: f64,
}

/// Answer of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Answer {
    pub model: Model,
    pub figures: Vec<FigureOfAnswer>,
    pub flanks: PerGear<FlankCurves>,
    pub mesh_cycle: CycleCurves,
    pub drawing: DrawnPair,
    pub warnings: Vec<String>,
}

/// Relative differences of the figures of finite elements to others, by the names of the figures; of those alone that are known.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[serde(transparent)]
pub struct Band(BTreeMap<&'static str, f64>);

impl Band {
    /// Differences that a verified run states of itself.
    pub fn of(summary: &Summary) -> Self {
        let total = &summary.error.total;
        let TotalError { peak_wear, flank_pressure, .. } = total;
        let differences = [
            ("pinion.peak_wear_um", peak_wear.pinion),
            ("wheel.peak_wear_um", peak_wear.wheel),
            ("new.flank_pressure_MPa", flank_pressure.new),
            ("worn.flank_pressure_MPa", flank_pressure.worn),
            ("new.transmission_error_um.peak_to_peak", total.transmission_error_peak_to_peak_new),
            ("worn.transmission_error_um.peak_to_peak", total.transmission_error_peak_to_peak),
        ];
        Self(differences.into_iter().filter_map(|(name, difference)| Some((name, difference?))).collect())
    }
}

impl Answer {
    /// Answer in the record of a run with `model`.
    pub fn of(record: &RunRecord, model: Model) -> Self {
        Self {
            model,
            figures: figures(&record.summary),
            flanks: PerGear { pinion: curves(&record.flanks.pinion), wheel: curves(&record.flanks.wheel) },
            mesh_cycle: cycle(&record.mesh_cycle),
            drawing: drawn(&record.drawing, &record.summary),
            warnings: record.summary.warnings.clone(),
        }
    }

    /// Answer whose figures have their differences.
    pub fn with_band(mut self, band: &Band) -> Self {
        for figure in &mut self.figures {
            figure.difference = band.0.get(figure.name).copied();
        }
        self
    }

    /// Figure of this name.
    pub fn figure(&self, name: &str) -> Option<f64> {
        self.figures.iter().find(|figure| figure.name == name).map(|figure| figure.value)
    }

    /// Greatest wear of either flank.
    pub fn greatest_wear_um(&self) -> f64 {
        let of = |name| self.figure(name).unwrap_or_default();
        of("pinion.peak_wear_um").max(of("wheel.peak_wear_um"))
    }
}

fn figures(summary: &Summary) -> Vec<FigureOfAnswer> {
    let figure = |name, label, unit, value| FigureOfAnswer { name, label, unit, value, difference: None };
    let (new, worn) = (&summary.new, &summary.worn);
    let (te_new, te_worn) = (&new.transmission_error_um, &worn.transmission_error_um);
    vec![
        figure("pinion.peak_wear_um", "Wear of the pinion", "µm", summary.pinion.peak_wear_um),
        figure("wheel.peak_wear_um", "Wear of the wheel", "µm", summary.wheel.peak_wear_um),
        figure("new.flank_pressure_MPa", "Flank pressure, new", "MPa", new.flank_pressure_MPa),
        figure("worn.flank_pressure_MPa", "Flank pressure, worn", "MPa", worn.flank_pressure_MPa),
        figure(
            "new.transmission_error_um.peak_to_peak",
            "Transmission error, new, peak to peak",
            "µm",
            te_new.peak_to_peak,
        ),
        figure(
            "worn.transmission_error_um.peak_to_peak",
            "Transmission error, worn, peak to peak",
            "µm",
            te_worn.peak_to_peak,
        ),
        figure(
            "new.tip_edge_line_load_N_per_mm",
            "Line load of tip edges, new",
            "N/mm",
            new.tip_edge_line_load_N_per_mm,
        ),
        figure(
            "geometry.transverse_contact_ratio",
            "Transverse contact ratio",
            "",
            summary.geometry.transverse_contact_ratio,
        ),
    ]
}

fn curves(flank: &FlankRecord) -> FlankCurves {
    let points = flank.radius_mm.len();
    let zones = &flank.zones;
    FlankCurves {
        radius_mm: flank.radius_mm.clone(),
        wear_um: greatest_over_width(&flank.wear_um, points),
        pressure_new_MPa: greatest_over_width(&flank.pressure_new_MPa, points),
        pressure_worn_MPa: greatest_over_width(&flank.pressure_worn_MPa, points),
        zones_mm: [zones.active_start_radius_mm, zones.tip_edge_radius_mm, zones.tip_radius_mm].map(f64::abs),
    }
}

/// Greatest of all slices at each of so many points; values are slice after slice.
fn greatest_over_width(values: &[f64], points: usize) -> Vec<f64> {
    let mut slices = values.chunks_exact(points.max(1));
    let mut greatest = slices.next().unwrap_or_default().to_vec();
    for slice in slices {
        greatest.iter_mut().zip(slice).for_each(|(most, value)| *most = most.max(*value));
    }
    greatest
}

fn cycle(rows: &[MeshCycleRow]) -> CycleCurves {
    let column = |value: fn(&MeshCycleRow) -> f64| rows.iter().map(value).collect();
    CycleCurves {
        position_mm: column(|row| row.position_mm),
        load_share_new: column(|row| row.load_share_new),
        load_share_worn: column(|row| row.load_share_worn),
        transmission_error_new_um: column(|row| row.transmission_error_new_um),
        transmission_error_worn_um: column(|row| row.transmission_error_worn_um),
    }
}

fn drawn(drawing: &PairDrawing, summary: &Summary) -> DrawnPair {
    let PerGear { pinion, wheel } = &summary.geometry.gears;
    let module_mm = pinion.reference_diameter_mm.abs() / f64::from(pinion.teeth.max(1));
    let pitch_point = drawing.path_of_contact.iter().find(|(name, _)| name == "C").map_or([0.0, 0.0], |(_, at)| *at);
    let half_side_mm = DRAWN_MODULES * module_mm;
    let outline = |points: &[[f64; 2]]| pieces(points, pitch_point, 1.4 * half_side_mm);
    DrawnPair {
        outline: PerGear { pinion: outline(&drawing.outline.pinion), wheel: outline(&drawing.outline.wheel) },
        axis: drawing.axis,
        working_pitch_radius_mm: PerGear {
            pinion: 0.5 * pinion.working_pitch_diameter_mm,
            wheel: 0.5 * wheel.working_pitch_diameter_mm,
        },
        path_of_contact: drawing.path_of_contact.clone(),
        middle: pitch_point,
        half_side_mm,
    }
}

/// Pieces of a closed outline within `reach_mm` of `middle`.
fn pieces(points: &[[f64; 2]], middle: [f64; 2], reach_mm: f64) -> Vec<Vec<[f64; 2]>> {
    let is_near = |[x, y]: &[f64; 2]| (x - middle[0]).abs() <= reach_mm && (y - middle[1]).abs() <= reach_mm;
    // From a point that is not near on, no piece crosses the end of the list.
    let from = points.iter().position(|point| !is_near(point)).unwrap_or(0);
    let mut found = vec![Vec::new()];
    for point in points[from..].iter().chain(&points[..from]) {
        match (is_near(point), found.last_mut()) {
            (true, Some(piece)) => piece.push(point.map(|mm| (mm * DRAWN_TO).round() / DRAWN_TO)),
            (false, Some(piece)) if !piece.is_empty() => found.push(Vec::new()),
            _ => {}
        }
    }
    found.retain(|piece| piece.len() > 1);
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_slice_counts_at_each_point() {
        assert_eq!(greatest_over_width(&[1.0, 5.0, 2.0, 4.0], 2), [2.0, 5.0]);
        assert_eq!(greatest_over_width(&[1.0, 5.0], 2), [1.0, 5.0]);
        assert!(greatest_over_width(&[], 0).is_empty());
    }

    #[test]
    fn an_outline_is_cut_into_the_pieces_that_are_near() {
        let square = [[1.0, 0.0], [1.0, 1.0], [9.0, 1.0], [0.0, 1.0], [0.0, 0.0]];
        assert_eq!(pieces(&square, [0.5, 0.5], 1.0), [vec![[0.0, 1.0], [0.0, 0.0], [1.0, 0.0], [1.0, 1.0]]]);
    }
}
