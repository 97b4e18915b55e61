//! The CSV files.
//!
//! Each begins with lines that start with `#`: program version and scene hash, then what every column holds. Numbers
//! are the shortest decimals that read back as the same bits; a value that was not computed is an empty field.

use std::io::{self, Write};

use serde::Serialize;

use crate::gear::Gear;
use crate::results::fem_pair::FemPairSummary;
use crate::results::fem_problem::FemSummary;
use crate::results::run::{FlankRecord, HistoryRow, MeshCycleRow, RunRecord, Summary};
use crate::studies::accuracy::record::AccuracyRecord;
use crate::studies::compare::record::CompareRecord;
use crate::studies::sweep::record::SweepRecord;

/// Name and meaning of a column.
pub type Column = (&'static str, &'static str);

/// Columns of `pinion.csv` and `wheel.csv`; rows run from the base circle to the tip circle, slice after slice.
pub const FLANK: [Column; 10] = [
    ("radius_mm", "distance from the gear's axis, new"),
    ("roll_angle_deg", "roll angle of the transverse involute"),
    ("width_mm", "place over the face width"),
    ("removed_um", "material removed by modifications, normal to the flank"),
    ("sliding_mm_per_mesh", "distance the point slides against the other flank during one mesh, new"),
    ("wear_um", "wear depth at the end of the run, normal to the flank"),
    ("pressure_new_MPa", "greatest pressure during one mesh, new"),
    ("pressure_worn_MPa", "greatest pressure during one mesh, worn"),
    ("point", "index of the flank point, 0 at the base circle"),
    ("slice", "number of the slice over the face width, 0 at width 0"),
];

const PHASE: &str = "number of the phase of the operation, from 1; at the end of one, that one";

/// Columns of `history.csv`; one row per snapshot reached.
pub const HISTORY: [Column; 15] = [
    ("hours", "running time; empty where the scene gives no speed"),
    ("revolutions", "of the pinion"),
    ("pinion_peak_wear_um", "greatest wear depth on the pinion's active profile, its tip edge apart"),
    ("pinion_root_wear_um", "greatest wear depth in the first 2 mm of radius above the start of active profile"),
    ("pinion_pitch_wear_um", "wear depth at the working pitch circle"),
    ("wheel_peak_wear_um", "the same of the wheel"),
    ("peak_pressure_MPa", "greatest pressure during one mesh, sharp tip edges under load apart"),
    ("transmission_error_peak_to_peak_um", "of the loaded pair, along the line of action"),
    ("pinion_peak_wear_radius_mm", "radius of the greatest wear depth on the active profile"),
    ("pinion_sap_wear_um", "wear depth at the start of active profile"),
    ("pinion_sap_wear_rate_um_per_Mrev", "growth there per million pinion revolutions"),
    ("phase", PHASE),
    (
        "sharp_edge_pressure_MPa",
        "greatest pressure found at a sharp tip edge under load, which grows with every refinement; empty where there is none",
    ),
    ("pinion_tip_edge_wear_um", "greatest wear depth at the pinion's tip edge"),
    ("wheel_tip_edge_wear_um", "the same of the wheel"),
];

/// Columns of `profiles.csv`; both flanks at every snapshot.
pub const PROFILES: [Column; 8] = [
    ("hours", "running time; empty where the scene gives no speed"),
    ("gear", "pinion or wheel"),
    ("radius_mm", "distance from the gear's axis, new"),
    ("width_mm", "place over the face width"),
    ("wear_um", "wear depth, normal to the flank"),
    ("revolutions", "of the pinion"),
    ("slice", "number of the slice over the face width, 0 at width 0"),
    ("phase", PHASE),
];

/// Columns of `mesh_cycle.csv`; one row per loading position of the reference pair, from A to E.
pub const MESH_CYCLE: [Column; 17] = [
    ("position_mm", "radius of curvature of the pinion's flank at the theoretical contact point"),
    ("load_share_new", "share of the whole load that the pair carries, new"),
    ("load_share_worn", "the same, worn"),
    ("peak_pressure_new_MPa", "greatest pressure of the pair, new"),
    ("peak_pressure_worn_MPa", "the same, worn"),
    ("half_width_mm", "half the extent of the contact strip, new"),
    ("transmission_error_new_um", "approach along the line of action, positive under load, new"),
    ("transmission_error_worn_um", "the same, worn"),
    (
        "temperature_rise_K",
        "greatest rise of the contact above the bulk by the chosen method, new; empty where not computed",
    ),
    ("half_width_worn_mm", "half the extent of the contact strip, worn"),
    ("temperature_rise_heat_equation_K", "the rise by the transient heat equation, new; empty where not computed"),
    ("temperature_rise_williams_K", "the same by Williams"),
    ("temperature_rise_tian_kennedy_K", "the same by Tian and Kennedy"),
    ("peclet_pinion", "Peclet number of the pinion's surface, new; empty where not computed"),
    ("peclet_wheel", "the same of the wheel's"),
    ("at_sharp_edge_new", "whether a sharp tip edge cuts the contact off: its peak pressure is not defined, new"),
    ("at_sharp_edge_worn", "the same, worn"),
];

/// Where the figures of a table come from.
#[derive(Debug, Clone, Copy)]
pub struct Provenance<'a> {
    program_version: &'a str,
    /// What kind of input it was: `scene`, `problem`.
    input: &'a str,
    hash: &'a str,
}

impl<'a> Provenance<'a> {
    /// That of the run summarised in `summary`.
    pub fn of(summary: &'a Summary) -> Self {
        Self { program_version: &summary.program_version, input: "scene", hash: &summary.scene_hash }
    }

    /// That of the finite-element pair summarised in `summary`.
    pub fn of_fem_pair(summary: &'a FemPairSummary) -> Self {
        Self { program_version: &summary.program_version, input: "scene", hash: &summary.scene_hash }
    }

    /// That of a comparison of models.
    pub fn of_accuracy(record: &'a AccuracyRecord) -> Self {
        Self { program_version: &record.program_version, input: "scene", hash: &record.scene_hash }
    }

    /// That of a comparison with a measured profile: the hash is that of the run's scene.
    pub fn of_compare(record: &'a CompareRecord) -> Self {
        Self { program_version: &record.program_version, input: "scene", hash: &record.scene_hash }
    }

    /// That of a sweep: the hash is that of the scene as given.
    pub fn of_sweep(record: &'a SweepRecord) -> Self {
        let identity = &record.identity;
        Self { program_version: &identity.program_version, input: "scene", hash: &identity.scene_hash }
    }

    /// That of the finite-element problem summarised in `summary`.
    pub fn of_fem(summary: &'a FemSummary) -> Self {
        Self { program_version: &summary.program_version, input: "problem", hash: &summary.problem_hash }
    }
}

#[allow(non_snake_case, reason = "the contract's column names")]
#[derive(Serialize)]
struct FlankRow {
    radius_mm: f64,
    roll_angle_deg: f64,
    width_mm: f64,
    removed_um: f64,
    sliding_mm_per_mesh: f64,
    wear_um: f64,
    pressure_new_MPa: f64,
    pressure_worn_MPa: f64,
    point: usize,
    slice: usize,
}

#[derive(Serialize)]
struct ProfileRow {
    hours: Option<f64>,
    gear: Gear,
    radius_mm: f64,
    width_mm: f64,
    wear_um: f64,
    revolutions: f64,
    slice: usize,
    phase: usize,
}

/// Writes `pinion.csv` or `wheel.csv`.
pub fn flank(out: &mut dyn Write, provenance: Provenance, flank: &FlankRecord) -> io::Result<()> {
    let points = flank.radius_mm.len();
    let rows = flank.width_mm.iter().enumerate().flat_map(|(slice, &width_mm)| {
        (0..points).map(move |point| {
            let place = slice * points + point;
            FlankRow {
                radius_mm: flank.radius_mm[point],
                roll_angle_deg: flank.roll_angle_deg[point],
                width_mm,
                removed_um: flank.removed_um[place],
                sliding_mm_per_mesh: flank.sliding_mm_per_mesh[place],
                wear_um: flank.wear_um[place],
                pressure_new_MPa: flank.pressure_new_MPa[place],
                pressure_worn_MPa: flank.pressure_worn_MPa[place],
                point,
                slice,
            }
        })
    });
    table(out, provenance, &FLANK, rows)
}

/// Writes `history.csv`.
pub fn history(out: &mut dyn Write, provenance: Provenance, rows: &[HistoryRow]) -> io::Result<()> {
    table(out, provenance, &HISTORY, rows)
}

/// Writes `profiles.csv`.
pub fn profiles(out: &mut dyn Write, provenance: Provenance, record: &RunRecord) -> io::Result<()> {
    let rows = record.history.iter().enumerate().flat_map(|(snapshot, at)| {
        Gear::BOTH.into_iter().flat_map(move |gear| {
            let flank = &record.flanks[gear];
            let slices = flank.snapshot_wear_um[snapshot].chunks_exact(flank.radius_mm.len().max(1));
            flank.width_mm.iter().zip(slices).enumerate().flat_map(move |(slice, (&width_mm, wear_um))| {
                flank.radius_mm.iter().zip(wear_um).map(move |(&radius_mm, &wear_um)| ProfileRow {
                    hours: at.hours,
                    gear,
                    radius_mm,
                    width_mm,
                    wear_um,
                    revolutions: at.revolutions,
                    slice,
                    phase: at.phase,
                })
            })
        })
    });
    table(out, provenance, &PROFILES, rows)
}

/// Writes `mesh_cycle.csv`.
pub fn mesh_cycle(out: &mut dyn Write, provenance: Provenance, rows: &[MeshCycleRow]) -> io::Result<()> {
    table(out, provenance, &MESH_CYCLE, rows)
}

/// The opening lines, the header and the rows. The header is written from `columns`, so that a table without rows has it.
pub(crate) fn table<R: Serialize>(
    out: &mut dyn Write,
    provenance: Provenance,
    columns: &[(&str, &str)],
    rows: impl IntoIterator<Item = R>,
) -> io::Result<()> {
    writeln!(out, "# gearwear {}, {} {}", provenance.program_version, provenance.input, provenance.hash)?;
    for (name, meaning) in columns {
        writeln!(out, "# {name}: {meaning}")?;
    }
    let mut csv = csv::WriterBuilder::new().has_headers(false).from_writer(out);
    csv.write_record(columns.iter().map(|(name, _)| name))?;
    for row in rows {
        csv.serialize(row)?;
    }
    csv.flush()
}
