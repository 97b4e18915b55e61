//! Nodes of a sector's outline, from the element lengths wanted along it.
//!
//! Wanted lengths: on the working flank of a fine sector the local half-width of contact over the number of elements in it, on
//! flanks that are not resolved a fraction of the module; on a fillet its arc over a number of elements, less where it is
//! sharply curved; on a rounding a fraction of its radius; never more than a fraction of the tooth's thickness. Between these
//! lengths change at the rate of growth.

use std::ops::Range;

use super::profile::{Piece, Profile};
use super::spacing::{OutlineNode, OutlinePart, OutlinePoint, OutlineRun, ToothSide, limit_growth};
use super::{FlankResolution, GREATEST_MODULES, GROWTH, LEAST_MODULES, SectorSettings, ToothMeshError, ToothShape};
use crate::gear_mesh::settings::rounding_element_mm;

/// Longest element of a flank that is not resolved, in modules.
const FLANK_MODULES: f64 = 0.3;
/// Elements along a fillet of a coarse sector.
const COARSE_FILLET_ELEMENTS: f64 = 5.0;
/// Longest element of a fillet over its radius of curvature; shortest in modules, at a sharp corner of the rack.
const FILLET_OVER_CURVATURE: f64 = 0.4;
const LEAST_FILLET_MODULES: f64 = 0.01;
/// Longest element of a rounding over its radius, where the flank is resolved and where it is not.
const ROUNDING_OVER_RADIUS: [f64; 2] = [0.25, 0.6];
/// Elements on the rounding of the edge of a chamfer.
const CHAMFER_EDGE_ELEMENTS: f64 = 4.0;
/// Longest element over the thickness of the tooth.
const OVER_THICKNESS: f64 = 0.5;
/// Longest element at the cuts, in modules.
const AT_CUT_MODULES: f64 = 0.12;
/// Fraction of an element below which a root arc is meshed together with the fillet, and a kink with the nearest node.
const NEGLIGIBLE: f64 = 0.4;
/// Most elements of an outline.
const MOST_ELEMENTS: f64 = 20_000.0;
/// Sampling intervals of a run.
const SAMPLES: usize = 300;

/// Nodes of the outline from the right cut over the tip to the left cut, the body on their left.
pub(super) struct Outline {
    /// Ends and middles of elements alternately.
    pub nodes: Vec<OutlineNode>,
    /// Runs in order, with their nodes; neighbours share one.
    pub runs: Vec<(ToothSide, OutlinePart, Range<usize>)>,
    /// Longest element where the outline meets the cuts; depends on the gear alone.
    pub at_cut_mm: f64,
    /// Radius of curvature of the involute at the nodes of both flanks, NaN elsewhere.
    pub rho_mm: Vec<f64>,
    /// ρ where the resolved part of the working flank begins.
    pub resolved_from_rho_mm: Option<f64>,
}

impl Outline {
    /// Nodes for `settings`.
    pub(super) fn new(
        shape: &ToothShape,
        settings: &SectorSettings,
        profile: &Profile,
    ) -> Result<Self, ToothMeshError> {
        let wanted = Wanted::new(shape, settings, profile)?;
        let right = wanted.half(profile, ToothSide::Right);
        let left = wanted.half(profile, ToothSide::Left);
        let mut runs = right;
        if profile.land_mm() > LEAST_MODULES * shape.normal_module_mm {
            let halves = [(ToothSide::Right, Piece::Land, [0.0, 1.0]), (ToothSide::Left, Piece::Land, [1.0, 0.0])];
            runs.push(OutlineRun::new(profile, OutlinePart::Land, &halves, SAMPLES));
        }
        runs.extend(left.into_iter().rev());
        for run in &mut runs {
            wanted.apply(profile, run);
        }
        limit_growth(&mut runs, settings.growth(), wanted.at_cut_mm);

        let elements: f64 = runs.iter().map(OutlineRun::elements).sum();
        if elements.is_nan() || elements > MOST_ELEMENTS {
            return Err(ToothMeshError::TooFine { elements: elements as usize, greatest: MOST_ELEMENTS as usize });
        }
        let mut outline = Self {
            nodes: Vec::new(),
            runs: Vec::new(),
            rho_mm: Vec::new(),
            at_cut_mm: wanted.at_cut_mm,
            resolved_from_rho_mm: wanted.resolved.as_ref().map(|resolved| resolved.from_rho_mm),
        };
        for run in &runs {
            let first = outline.nodes.len().saturating_sub(1);
            let nodes = run.divide(profile);
            outline.nodes.extend(nodes.into_iter().skip(usize::from(!outline.nodes.is_empty())));
            outline.runs.push((run.side, run.part, first..outline.nodes.len()));
        }
        outline.rho_mm = vec![f64::NAN; outline.nodes.len()];
        for side in [ToothSide::Right, ToothSide::Left] {
            for k in outline.part(side, OutlinePart::Flank) {
                let OutlinePoint { piece, u, .. } = outline.nodes[k].place;
                // End nodes of the flank may belong to the neighbouring pieces.
                outline.rho_mm[k] = match piece {
                    Piece::Flank => profile.rho_mm(u),
                    Piece::RootArc | Piece::Fillet => profile.rho_mm(0.0),
                    Piece::Rounding | Piece::Chamfer | Piece::Land => profile.rho_mm(1.0),
                };
            }
        }
        Ok(outline)
    }

    /// Nodes of a part on a side, neighbouring runs together; empty where there is none.
    pub(super) fn part(&self, side: ToothSide, part: OutlinePart) -> Range<usize> {
        let mut of_part = self.runs.iter().filter(|run| run.0 == side && run.1 == part).map(|run| run.2.clone());
        match of_part.next() {
            Some(first) => first.start..of_part.next_back().map_or(first.end, |last| last.end),
            None => 0..0,
        }
    }
}

/// Whether ρ is not below `from_rho_mm`, but for round-off.
pub(super) fn reaches(rho_mm: f64, from_rho_mm: f64) -> bool {
    rho_mm >= from_rho_mm * (1.0 - 1e-12_f64.copysign(from_rho_mm))
}

/// Resolved part of the working flank.
struct ResolvedFlank<'a> {
    flank: FlankResolution<'a>,
    from_rho_mm: f64,
    edge_rho_mm: f64,
}

impl ResolvedFlank<'_> {
    /// Wanted element length.
    fn element_mm(&self, rho_mm: f64) -> f64 {
        (self.flank.half_width_mm)(rho_mm) / self.flank.elements_per_half_width
    }
}

/// Wanted element lengths.
struct Wanted<'a> {
    module_mm: f64,
    fillet_mm: f64,
    at_cut_mm: f64,
    root_arc_mm: f64,
    resolved: Option<ResolvedFlank<'a>>,
}

impl<'a> Wanted<'a> {
    fn new(shape: &ToothShape, settings: &SectorSettings<'a>, profile: &Profile) -> Result<Self, ToothMeshError> {
        let (tooth, module_mm) = (shape.tooth, shape.normal_module_mm);
        let arc_mm =
            OutlineRun::new(profile, OutlinePart::Fillet, &[(ToothSide::Right, Piece::Fillet, [0.0, 1.0])], SAMPLES)
                .arc_mm();
        let root_arc_mm = profile.root_arc_rad() * tooth.root_radius_mm;
        // Coarse sectors have the cuts of fine ones.
        let fine_mm = arc_mm / f64::from(settings.fillet_elements);
        let at_cut_mm = (AT_CUT_MODULES * module_mm).min(fine_mm + GROWTH * root_arc_mm);
        let mut wanted = Self { module_mm, fillet_mm: fine_mm, at_cut_mm, root_arc_mm, resolved: None };
        let Some(flank) = settings.flank else {
            wanted.fillet_mm = arc_mm / COARSE_FILLET_ELEMENTS;
            return Ok(wanted);
        };
        let start = shape.active_start_rho_mm;
        let margin_mm = flank.margin_mm.max(0.0);
        // Arc length of the involute: s = ρ²/(2 r_b).
        let square = start * start - 2.0 * tooth.involute.base_radius_mm * margin_mm;
        let from_rho_mm = tooth.involute.signed(square.max(0.0).sqrt()).max(tooth.root_form_rho_mm());
        let resolved = ResolvedFlank { flank, from_rho_mm, edge_rho_mm: tooth.edge_rho_mm() };
        let least_mm = LEAST_MODULES * module_mm;
        for k in 0..=SAMPLES {
            let rho = from_rho_mm + (profile.flank_end_rho_mm() - from_rho_mm) * k as f64 / SAMPLES as f64;
            let value = resolved.element_mm(rho);
            if !(value.is_finite() && value >= least_mm) {
                return Err(ToothMeshError::ElementLength { value_mm: value, rho_mm: rho, least_mm });
            }
        }
        wanted.resolved = Some(resolved);
        Ok(wanted)
    }

    /// Runs of one side from root to tip; each follows the direction of the outline.
    fn half(&self, profile: &Profile, side: ToothSide) -> Vec<OutlineRun> {
        let whole = [0.0, 1.0];
        let mut parts = if self.root_arc_mm >= NEGLIGIBLE * self.fillet_mm {
            vec![
                (OutlinePart::RootArc, vec![(Piece::RootArc, whole)]),
                (OutlinePart::Fillet, vec![(Piece::Fillet, whole)]),
            ]
        } else {
            vec![(OutlinePart::Fillet, vec![(Piece::RootArc, whole), (Piece::Fillet, whole)])]
        };
        for ends in self.flank_breaks(profile, side).windows(2) {
            parts.push((OutlinePart::Flank, vec![(Piece::Flank, [ends[0], ends[1]])]));
        }
        if profile.rounding_mm() > 0.0 {
            parts.push((OutlinePart::TipEdge, vec![(Piece::Rounding, whole)]));
        }
        if profile.has_chamfer() {
            parts.push((OutlinePart::TipEdge, vec![(Piece::Chamfer, whole)]));
        }
        let runs = parts.into_iter().map(|(part, stretches)| {
            let directed: Vec<_> = match side {
                ToothSide::Right => stretches.iter().map(|&(piece, ends)| (side, piece, ends)).collect(),
                ToothSide::Left => stretches.iter().rev().map(|&(piece, [a, b])| (side, piece, [b, a])).collect(),
            };
            OutlineRun::new(profile, part, &directed, SAMPLES)
        });
        runs.collect()
    }

    /// Parameters of the flank where there must be a node, increasing.
    fn flank_breaks(&self, profile: &Profile, side: ToothSide) -> Vec<f64> {
        let mut breaks = vec![0.0];
        if let (Some(resolved), ToothSide::Left) = (&self.resolved, side) {
            let mut rhos = profile.kinks_rho_mm();
            rhos.push(resolved.from_rho_mm);
            rhos.sort_by(f64::total_cmp);
            for rho in rhos {
                let (u, near_mm) = (profile.at_rho(rho), NEGLIGIBLE * resolved.element_mm(rho));
                let before = breaks.last().copied().unwrap_or(0.0);
                let [point, before, end] = [u, before, 1.0].map(|u| profile.point_mm(Piece::Flank, u));
                if (point - before).norm() > near_mm && (end - point).norm() > near_mm {
                    breaks.push(u);
                }
            }
        }
        breaks.push(1.0);
        breaks
    }

    /// Limits the element lengths of `run`.
    fn apply(&self, profile: &Profile, run: &mut OutlineRun) {
        let (module, least) = (self.module_mm, LEAST_MODULES * self.module_mm);
        let resolved = self.resolved.as_ref().filter(|_| run.side == ToothSide::Left);
        run.want(|_, _| GREATEST_MODULES * module);
        match run.part {
            OutlinePart::RootArc => {}
            OutlinePart::Fillet => {
                run.want(|_, _| self.fillet_mm);
                run.follow_curvature(FILLET_OVER_CURVATURE, LEAST_FILLET_MODULES * module);
            }
            OutlinePart::Flank => run.want(|place, point| {
                let rho = profile.rho_mm(place.u);
                let thickness = (2.0 * point.x.abs()).max(least / OVER_THICKNESS);
                let open = (FLANK_MODULES * module).min(OVER_THICKNESS * thickness);
                // The node at the beginning of the resolved part belongs to it for the runs on both sides.
                resolved
                    .filter(|resolved| reaches(rho, resolved.from_rho_mm))
                    .map_or(open, |resolved| resolved.element_mm(rho).min(open))
            }),
            OutlinePart::TipEdge => {
                let wanted = self.on_rounding_mm(profile, resolved, run.arc_mm());
                run.want(|place, _| if place.piece == Piece::Chamfer { GREATEST_MODULES * module } else { wanted });
            }
            OutlinePart::Land => {
                let wanted = (OVER_THICKNESS * run.arc_mm()).max(least);
                run.want(|_, _| wanted);
            }
        }
    }

    /// Wanted length on the rounding of an edge, `arc_mm` long.
    fn on_rounding_mm(&self, profile: &Profile, resolved: Option<&ResolvedFlank<'_>>, arc_mm: f64) -> f64 {
        let least = LEAST_MODULES * self.module_mm;
        let [fine, open] = ROUNDING_OVER_RADIUS.map(|part| (part * profile.rounding_mm()).max(least));
        let Some(resolved) = resolved else { return open };
        let FlankResolution { elements_per_half_width, rounding_refinement, .. } = resolved.flank;
        let own = rounding_element_mm(profile.rounding_mm(), elements_per_half_width, rounding_refinement);
        let wanted = fine.min(resolved.element_mm(resolved.edge_rho_mm)).min(own.max(least));
        // The arc to a chamfer is short.
        if profile.has_chamfer() { wanted.min((arc_mm / CHAMFER_EDGE_ELEMENTS).max(least)) } else { wanted }
    }
}
