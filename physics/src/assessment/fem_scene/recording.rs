//! Record of a finite-element contact: from the program's units to those of the output files.

use super::{FemPairError, Solved};
use crate::assessment::UM_PER_MM;
use crate::assessment::recording::{geometry, path_points, sharp_edges};
use crate::assessment::root_stress;
use crate::contact::hertz::flattening;
use crate::operation::Scene;
use crate::results::fem_pair::{
    ChecksSummary, FemCycleRow, FemCycleSummary, FemPairRecord, FemPairSummary, GearModelSummary, ModelSummary,
    PairSolution, PathPointsSummary, PressureCurve, RootSummary,
};
use crate::results::path_points::among;
use crate::results::provenance::Provenance;
use crate::results::run::{ContactSummary, RangeSummary};
use gearwear_bodies::gear::{Gear, GearPair, PerGear};
use gearwear_bodies::gear_fem::condensed_pair::CondensedPair;
use gearwear_bodies::gear_fem::model::{MeshedGear, solid};
use gearwear_bodies::gear_fem::position::{PositionContact, ToothPairContact};
use gearwear_bodies::gear_fem::ring::Surroundings;
use gearwear_bodies::gear_mesh::settings::{Body, NO_WEBS, SectorSides, default_clamp};
use gearwear_bodies::reference::hertz_line::LineContact;
use gearwear_bodies::reference::steel_yield;
use gearwear_mesh::quality::{self, MeshQuality};
use gearwear_mesh::{CellBlock, CellKind, Mesh};

/// Explanation of the torque ratio in the summary.
const TORQUE_RATIO: &str = "|T2/T1| is z2/z1 where all force acts along the line of action. Forces act on the flanks as they \
     are before deformation, along the normals of one of them: under load the resultant lies some hundredths of a millimetre \
     beside the theoretical contact point, and its arm differs by less than a thousandth; where a pair touches before A or \
     after E, at a tip edge, it is more, and there the instantaneous ratio does differ, as the transmission error changes \
     with rotation";

/// Source of a record: the scene with its condensed model.
pub(super) struct RecordSource<'a> {
    pub scene: &'a Scene,
    pub provenance: &'a Provenance,
    pub model: &'a CondensedPair<'a>,
    pub meshed: &'a PerGear<MeshedGear>,
    pub line_load_n_per_mm: f64,
    pub position_mm: Option<f64>,
}

/// Record without the times of its stages.
pub(super) fn record(
    source: RecordSource<'_>,
    solved: &Solved,
    solution: Option<PairSolution>,
) -> Result<FemPairRecord, FemPairError> {
    let (from, pair) = (source.provenance, source.model.pair);
    let mesh_cycle: Vec<FemCycleRow> = solved.positions.iter().flat_map(|at| source.rows(at)).collect();
    let at_pitch = source.hertz(pair.path.pitch_point_mm, source.line_load_n_per_mm);
    let model = source.model_summary()?;
    let new = source.cycle(solved, &mesh_cycle);
    let mut warnings = from.warnings.clone();
    warnings.extend(source.scene.plane_section_warning());
    warnings.extend(source.scene.one_load_warning());
    warnings.extend(source.warnings(&new));
    let summary = FemPairSummary {
        title: from.title.clone(),
        program_version: env!("CARGO_PKG_VERSION").to_owned(),
        scene_hash: from.scene_hash.clone(),
        stopped: solved.stop,
        position_mm: source.position_mm,
        positions: solved.positions.len(),
        dofs: model.gears.pinion.dofs + model.gears.wheel.dofs,
        elements: model.gears.pinion.elements + model.gears.wheel.elements,
        iterations: solved.positions.iter().map(|at| at.log.steps.len()).sum(),
        stages: Vec::new(),
        wall_s: 0.0,
        wall_per_position_s: None,
        geometry: geometry(pair),
        contact: ContactSummary {
            surface: "fem".to_owned(),
            line_load_N_per_mm: source.line_load_n_per_mm,
            foundation_MPa_per_mm: None,
            hertz_half_width_mm: at_pitch.half_width_mm,
            hertz_peak_pressure_MPa: at_pitch.peak_pressure_mpa,
        },
        model,
        new,
        points: solved.points.as_ref().map(|points| source.points(points)),
        root: PerGear::from_fn(|gear| root(gear, &solved.positions)),
        root_stress: root_stress::summary(pair, source.line_load_n_per_mm),
        checks: source.checks(&solved.positions),
        full: solved.full.clone(),
        warnings,
    };
    let pressure = source.pressure(solved);
    Ok(FemPairRecord { summary, scene_toml: from.scene_toml.clone(), mesh_cycle, pressure, solution })
}

impl RecordSource<'_> {
    fn model_summary(&self) -> Result<ModelSummary, FemPairError> {
        let (body, sector_teeth, sector_sides) = match self.scene.fem.body {
            Body::Ring => ("ring", None, None),
            Body::Sector { teeth, sides } => {
                let sides = if sides == SectorSides::Clamped { "clamped" } else { "free" };
                ("sector", Some(teeth), Some(sides.to_owned()))
            }
        };
        Ok(ModelSummary {
            body: body.to_owned(),
            sector_teeth,
            sector_sides,
            elements_per_half_width: self.scene.fem.elements_per_half_width,
            gears: PerGear { pinion: self.gear_model(Gear::Pinion)?, wheel: self.gear_model(Gear::Wheel)? },
        })
    }

    /// Pressure curves at A to E, or at the one position asked for.
    fn pressure(&self, solved: &Solved) -> Vec<PressureCurve> {
        match &solved.points {
            Some(points) => {
                let named = ["A", "B", "C", "D", "E"].into_iter().zip(points);
                named.flat_map(|(name, at)| self.curves(Some(name), at)).collect()
            }
            None if self.position_mm.is_some() => {
                solved.positions.iter().flat_map(|at| self.curves(None, at)).collect()
            }
            None => Vec::new(),
        }
    }

    /// Gear ratio z2/z1.
    fn tooth_ratio(&self) -> f64 {
        let teeth = &self.model.pair.teeth;
        f64::from(teeth.wheel.teeth) / f64::from(teeth.pinion.teeth)
    }

    /// Hertz's contact at a pair's own position, at A or E where that lies outside.
    fn hertz(&self, position_mm: f64, line_load_n_per_mm: f64) -> LineContact {
        let path = &self.model.pair.path;
        let position_mm = position_mm.clamp(path.start_mm, path.end_mm);
        flattening(self.model.pair, &self.scene.material, position_mm).contact.loaded(line_load_n_per_mm)
    }

    fn rows(&self, at: &PositionContact) -> Vec<FemCycleRow> {
        at.pairs.iter().map(|contact| self.row(at, contact)).collect()
    }

    fn row(&self, at: &PositionContact, contact: &ToothPairContact) -> FemCycleRow {
        let own_mm = at.position_mm + f64::from(contact.pair) * self.model.pair.path.base_pitch_mm;
        let hertz = self.hertz(own_mm, contact.line_load_n_per_mm);
        FemCycleRow {
            position_mm: at.position_mm,
            pair: contact.pair,
            pair_position_mm: own_mm,
            line_load_N_per_mm: contact.line_load_n_per_mm,
            peak_pressure_MPa: contact.peak_pressure_mpa,
            half_width_mm: contact.half_width_mm,
            transmission_error_um: at.transmission_error_mm * UM_PER_MM,
            load_share: contact.line_load_n_per_mm / self.line_load_n_per_mm,
            hertz_pressure_MPa: hertz.peak_pressure_mpa,
            hertz_half_width_mm: hertz.half_width_mm,
            pinion_radius_mm: contact.pinion_radius_mm,
            at_sharp_edge: contact.at_sharp_edge,
            pinion_root_tension_MPa: at.root.pinion.working_side_mpa,
            pinion_root_compression_MPa: at.root.pinion.back_side_mpa,
            wheel_root_tension_MPa: at.root.wheel.working_side_mpa,
            wheel_root_compression_MPa: at.root.wheel.back_side_mpa,
            torque_ratio: (1.0 + at.torque_ratio_error) * self.tooth_ratio(),
            iterations: at.log.steps.len(),
        }
    }

    fn curves(&self, point: Option<&'static str>, at: &PositionContact) -> Vec<PressureCurve> {
        at.pairs
            .iter()
            .map(|contact| {
                let (along_mm, pressure_mpa) = contact.pressure.iter().copied().unzip();
                PressureCurve {
                    point: point.map(str::to_owned),
                    row: self.row(at, contact),
                    along_mm,
                    pressure_MPa: pressure_mpa,
                }
            })
            .collect()
    }

    fn gear_model(&self, gear: Gear) -> Result<GearModelSummary, FemPairError> {
        let meshed = &self.meshed[gear];
        let coarse = match meshed.surroundings {
            Surroundings::Ring { coarse } | Surroundings::PinnedRing { coarse, .. } => coarse,
            Surroundings::FreeSector { coarse } | Surroundings::ClampedSector { coarse } => 2 * coarse,
        };
        Ok(GearModelSummary {
            clamp_radius_mm: self.scene.fem.clamp_radius_mm[gear].abs(),
            dofs: meshed.dofs(),
            elements: meshed.fine_teeth as usize * meshed.fine.cells.len()
                + coarse * meshed.coarse.as_ref().map_or(0, |sector| sector.cells.len()),
            resolved_teeth: meshed.fine_teeth,
            resolved_tooth_dofs: meshed.fine.dofs(),
            candidates: self.model.flanks[gear].surface.points_mm.len(),
            quality: worst(meshed).map_err(|source| FemPairError::Quality { gear, source })?,
        })
    }

    fn cycle(&self, solved: &Solved, rows: &[FemCycleRow]) -> FemCycleSummary {
        let [peak, sharp] = [false, true].map(|sharp| {
            let rows = rows.iter().filter(|row| row.at_sharp_edge == sharp);
            rows.reduce(|most, row| if row.peak_pressure_MPa > most.peak_pressure_MPa { row } else { most })
        });
        let at_c = solved.points.as_ref().and_then(|[_, _, at_c, ..]| {
            let contact = at_c.pairs.iter().find(|contact| contact.pair == 0)?;
            Some(self.row(at_c, contact))
        });
        let [min, max] = rows
            .iter()
            .map(|row| row.transmission_error_um)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[min, max], te| [min.min(te), max.max(te)]);
        FemCycleSummary {
            peak_pressure_MPa: peak.map(|row| row.peak_pressure_MPa),
            peak_pressure_position_mm: peak.map(|row| row.position_mm),
            peak_pressure_pair: peak.map(|row| row.pair),
            peak_pressure_pair_position_mm: peak.map(|row| row.pair_position_mm),
            peak_pressure_pinion_radius_mm: peak.map(|row| row.pinion_radius_mm),
            sharp_edge_pressure_MPa: sharp.map(|row| row.peak_pressure_MPa),
            pitch_pressure_MPa: at_c.as_ref().map(|row| row.peak_pressure_MPa),
            pitch_hertz_pressure_MPa: at_c.as_ref().map(|row| row.hertz_pressure_MPa),
            transmission_error_um: RangeSummary { min, max, peak_to_peak: max - min },
        }
    }

    fn points(&self, points: &[PositionContact; 5]) -> PathPointsSummary {
        let rows = points.each_ref().map(|at| {
            let reference = at.pairs.iter().find(|contact| contact.pair == 0);
            reference.map(|contact| self.row(at, contact))
        });
        let rows = rows.each_ref().map(Option::as_ref);
        PathPointsSummary {
            load_share: path_points(rows.map(|row| row.map_or(0.0, |row| row.load_share))),
            peak_pressure_MPa: path_points(rows.map(|row| row.map_or(0.0, |row| row.peak_pressure_MPa))),
            hertz_pressure_MPa: path_points(rows.map(|row| row.map_or(0.0, |row| row.hertz_pressure_MPa))),
            transmission_error_um: path_points(points.each_ref().map(|at| at.transmission_error_mm * UM_PER_MM)),
        }
    }

    fn checks(&self, positions: &[PositionContact]) -> ChecksSummary {
        let mut worst = (0.0, f64::NAN);
        let mut on_line: Option<f64> = None;
        for at in positions {
            let error = at.torque_ratio_error.abs();
            if error > worst.0 || worst.1.is_nan() {
                worst = (error, at.position_mm);
            }
            if at.pairs.iter().all(|contact| is_on_line(self.model.pair, at, contact)) {
                on_line = Some(on_line.unwrap_or(0.0).max(error));
            }
        }
        let iterations: usize = positions.iter().map(|at| at.log.steps.len()).sum();
        ChecksSummary {
            tooth_ratio: self.tooth_ratio(),
            torque_ratio_error: worst.0,
            torque_ratio_error_position_mm: worst.1,
            torque_ratio_error_on_line: on_line,
            torque_ratio: TORQUE_RATIO.to_owned(),
            load_imbalance: positions.iter().map(|at| at.load_balance).fold(0.0, f64::max),
            max_penetration_um: positions.iter().map(|at| at.max_penetration_mm).fold(0.0, f64::max) * UM_PER_MM,
            iterations_per_position: iterations as f64 / positions.len() as f64,
            most_iterations: positions.iter().map(|at| at.log.steps.len()).max().unwrap_or(0),
            cycles_broken: positions.iter().map(|at| at.log.cycles_broken).sum(),
        }
    }

    fn warnings(&self, new: &FemCycleSummary) -> Vec<String> {
        let mut warnings = Vec::new();
        if new.sharp_edge_pressure_MPa.is_some() {
            warnings.push(format!(
                "mathematically sharp edges carry load ({}): the elastic pressure there is singular, and what is found grows with every \
                 refinement; such contacts are marked at_sharp_edge and left out of peak_pressure_MPa (at a tip tip_rounding_mm makes the \
                 pressure finite)",
                sharp_edges(self.model.pair)
            ));
        }
        let radii = self.scene.fem.clamp_radius_mm;
        let module_mm = self.model.pair.spec.transverse_module_mm();
        if Gear::BOTH
            .into_iter()
            .any(|gear| default_clamp(self.model.pair.teeth[gear].root_radius_mm, module_mm).radius_mm == radii[gear])
        {
            let (of_ring, key) = match self.model.pair.spec.is_internal() {
                true => (", 3.5 outside that of a ring", "fem.clamp_radius_mm and pair.wheel.rim_thickness_mm say"),
                false => ("", "fem.clamp_radius_mm says"),
            };
            warnings.push(format!(
                "the bodies are held at {:.2} mm (pinion) and {:.2} mm (wheel), by default 2.5 modules below the root circle{of_ring}: \
                 transmission error and root stress depend on it; {key} where rim or bore are",
                radii.pinion,
                radii.wheel.abs()
            ));
        }
        if self.scene.fem.web != NO_WEBS {
            warnings.push("fem.web: plane elements do not see it, their bodies are as wide as the teeth".to_owned());
        }
        if let Some(pressure_mpa) = new.peak_pressure_MPa {
            let at = new.peak_pressure_pair_position_mm.or(self.position_mm);
            let place =
                at.map(|at| among(&path_points(self.model.pair.path.points_mm()).named(), at)).unwrap_or_default();
            warnings.extend(steel_yield::warning(pressure_mpa, &place));
        }
        warnings
    }
}

/// Greatest tension and compression of the root of a gear over the positions.
fn root(gear: Gear, positions: &[PositionContact]) -> Option<RootSummary> {
    let first = positions.first()?;
    let (mut tension, mut compression) = (first, first);
    for at in positions {
        if at.root[gear].working_side_mpa > tension.root[gear].working_side_mpa {
            tension = at;
        }
        if at.root[gear].back_side_mpa < compression.root[gear].back_side_mpa {
            compression = at;
        }
    }
    Some(RootSummary {
        tension_MPa: tension.root[gear].working_side_mpa,
        tension_position_mm: tension.position_mm,
        compression_MPa: compression.root[gear].back_side_mpa,
        compression_position_mm: compression.position_mm,
    })
}

/// Whether a pair touches on the line of action: between A and E and away from sharp edges.
fn is_on_line(pair: &GearPair, at: &PositionContact, contact: &ToothPairContact) -> bool {
    let own_mm = at.position_mm + f64::from(contact.pair) * pair.path.base_pitch_mm;
    (pair.path.start_mm..=pair.path.end_mm).contains(&own_mm) && !contact.at_sharp_edge
}

/// Quality of all elements of a gear's sectors.
fn worst(meshed: &MeshedGear) -> Result<MeshQuality, quality::QualityError> {
    let mut all = Mesh::default();
    for sector in std::iter::once(&meshed.fine).chain(&meshed.coarse) {
        let first = all.points.len();
        all.points.extend(solid(sector).points_mm.iter().map(|p| [p.x, p.y, 0.0]));
        for cell in &sector.cells {
            if all.cells.last().is_none_or(|block| block.kind != cell.kind) {
                all.cells.push(CellBlock::new(cell.kind, Vec::new()));
            }
            if let Some(block) = all.cells.last_mut() {
                block.nodes.extend(cell.nodes().iter().map(|&node| first + node as usize));
            }
        }
    }
    debug_assert!(all.cells.iter().all(|block| matches!(block.kind, CellKind::Triangle6 | CellKind::Quad8)));
    quality::of_mesh(&all)
}
