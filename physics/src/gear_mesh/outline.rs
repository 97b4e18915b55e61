//! The nodes of a sector's outline: which element lengths are wanted where, and the nodes that follow.
//!
//! Wanted lengths: on the working flank of a fine sector the local half-width of contact over the elements in it, on the
//! other flank and on coarse ones a part of the module; on a fillet its arc over a number of elements, less where it is
//! sharply curved; on a rounding a part of its radius; never more than a part of the tooth's thickness. Everything else
//! follows from the rate of growth.

use std::ops::Range;

use super::profile::{Piece, Profile};
use super::spacing::{OutlineNode, OutlinePoint, Part, Run, Side, limit_growth};
use super::{FlankResolution, GREATEST_MODULES, GROWTH, LEAST_MODULES, SectorSettings, ToothMeshError, ToothShape};
use crate::gear_mesh::settings::rounding_element_mm;

/// Longest element of a flank that is not resolved, in modules.
const FLANK_MODULES: f64 = 0.3;
/// Elements of a fillet that is not resolved.
const COARSE_FILLET_ELEMENTS: f64 = 5.0;
/// Longest element of a fillet over its radius of curvature; shortest in modules, at a sharp corner of the rack.
const FILLET_OVER_CURVATURE: f64 = 0.4;
const LEAST_FILLET_MODULES: f64 = 0.01;
/// Longest element of a rounding over its radius, where the flank is resolved and where it is not.
const ROUNDING_OVER_RADIUS: [f64; 2] = [0.25, 0.6];
/// Longest element over the thickness of the tooth.
const OVER_THICKNESS: f64 = 0.5;
/// Longest element at the cuts, in modules.
const AT_CUT_MODULES: f64 = 0.12;
/// A root arc shorter than this part of a fillet's element is meshed together with it; so are kinks near other nodes.
const NEGLIGIBLE: f64 = 0.4;
/// Most elements of an outline.
const MOST_ELEMENTS: f64 = 20_000.0;
/// Sampling intervals of a run.
const SAMPLES: usize = 300;

/// Nodes of the outline from the right cut over the tip to the left cut, the body on their left.
pub(super) struct Outline {
    /// Ends and middles of elements alternately.
    pub nodes: Vec<OutlineNode>,
    /// The runs in order, with their nodes; neighbours share one.
    pub runs: Vec<(Side, Part, Range<usize>)>,
    /// Longest element where the outline meets the cuts; depends on the gear alone.
    pub at_cut_mm: f64,
    /// Radius of curvature of the involute at the nodes of both flanks, NaN elsewhere.
    pub rho_mm: Vec<f64>,
    /// ρ where the resolved part of the working flank begins.
    pub resolved_from_rho_mm: Option<f64>,
}

impl Outline {
    /// The nodes for `settings`.
    pub(super) fn new(
        shape: &ToothShape,
        settings: &SectorSettings,
        profile: &Profile,
    ) -> Result<Self, ToothMeshError> {
        let wanted = Wanted::new(shape, settings, profile)?;
        let right = wanted.half(profile, Side::Right);
        let left = wanted.half(profile, Side::Left);
        let mut runs = right;
        if profile.land_rad() * shape.tooth.tip_radius_mm > LEAST_MODULES * shape.normal_module_mm {
            let halves = [(Side::Right, Piece::Land, [0.0, 1.0]), (Side::Left, Piece::Land, [1.0, 0.0])];
            runs.push(Run::new(profile, Part::Land, &halves, SAMPLES));
        }
        runs.extend(left.into_iter().rev());
        for run in &mut runs {
            wanted.apply(profile, run);
        }
        limit_growth(&mut runs, settings.growth(), wanted.at_cut_mm);

        let elements: f64 = runs.iter().map(Run::elements).sum();
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
        for side in [Side::Right, Side::Left] {
            for k in outline.part(side, Part::Flank) {
                let OutlinePoint { piece, u, .. } = outline.nodes[k].place;
                // The flank's end nodes may have been placed by its neighbours.
                outline.rho_mm[k] = match piece {
                    Piece::Flank => profile.rho_mm(u),
                    Piece::RootArc | Piece::Fillet => profile.rho_mm(0.0),
                    Piece::Rounding | Piece::Land => profile.rho_mm(1.0),
                };
            }
        }
        Ok(outline)
    }

    /// The nodes of a part on a side, neighbouring runs together; empty where there is none.
    pub(super) fn part(&self, side: Side, part: Part) -> Range<usize> {
        let mut of_part = self.runs.iter().filter(|run| run.0 == side && run.1 == part).map(|run| run.2.clone());
        match of_part.next() {
            Some(first) => first.start..of_part.next_back().map_or(first.end, |last| last.end),
            None => 0..0,
        }
    }
}

/// The part of the working flank that is resolved.
struct Resolved<'a> {
    flank: FlankResolution<'a>,
    from_rho_mm: f64,
    tip_rho_mm: f64,
}

impl Resolved<'_> {
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
    resolved: Option<Resolved<'a>>,
}

impl<'a> Wanted<'a> {
    fn new(shape: &ToothShape, settings: &SectorSettings<'a>, profile: &Profile) -> Result<Self, ToothMeshError> {
        let (tooth, module_mm) = (shape.tooth, shape.normal_module_mm);
        let arc_mm = Run::new(profile, Part::Fillet, &[(Side::Right, Piece::Fillet, [0.0, 1.0])], SAMPLES).arc_mm();
        let root_arc_mm = profile.root_arc_rad() * tooth.root_radius_mm;
        // The cuts are those of a fine sector on coarse ones too.
        let fine_mm = arc_mm / f64::from(settings.fillet_elements);
        let at_cut_mm = (AT_CUT_MODULES * module_mm).min(fine_mm + GROWTH * root_arc_mm);
        let mut wanted = Self { module_mm, fillet_mm: fine_mm, at_cut_mm, root_arc_mm, resolved: None };
        let Some(flank) = settings.flank else {
            wanted.fillet_mm = arc_mm / COARSE_FILLET_ELEMENTS;
            return Ok(wanted);
        };
        let start = shape.active_start_rho_mm;
        let margin_mm = flank.margin_mm.max(0.0);
        // In arc length s = ρ²/(2 r_b) below the start of active profile.
        let square = start * start - 2.0 * tooth.involute.base_radius_mm * margin_mm;
        let from_rho_mm = square.max(0.0).sqrt().max(tooth.root_form_rho_mm());
        let resolved = Resolved { flank, from_rho_mm, tip_rho_mm: tooth.tip_rho_mm() };
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

    /// The runs of one side, in the direction of the outline on the right side and against it on the left; the
    /// stretches themselves run with the outline.
    fn half(&self, profile: &Profile, side: Side) -> Vec<Run> {
        let mut runs = Vec::new();
        let mut add = |part: Part, stretches: &[(Piece, [f64; 2])]| {
            let directed: Vec<_> = match side {
                Side::Right => stretches.iter().map(|&(piece, ends)| (side, piece, ends)).collect(),
                Side::Left => stretches.iter().rev().map(|&(piece, [a, b])| (side, piece, [b, a])).collect(),
            };
            runs.push(Run::new(profile, part, &directed, SAMPLES));
        };
        let whole = [0.0, 1.0];
        if self.root_arc_mm >= NEGLIGIBLE * self.fillet_mm {
            add(Part::RootArc, &[(Piece::RootArc, whole)]);
            add(Part::Fillet, &[(Piece::Fillet, whole)]);
        } else {
            add(Part::Fillet, &[(Piece::RootArc, whole), (Piece::Fillet, whole)]);
        }
        for ends in self.flank_breaks(profile, side).windows(2) {
            add(Part::Flank, &[(Piece::Flank, [ends[0], ends[1]])]);
        }
        if profile.rounding_mm() > 0.0 {
            add(Part::Rounding, &[(Piece::Rounding, whole)]);
        }
        runs
    }

    /// Where the flank must have a node, as its parameter, increasing.
    fn flank_breaks(&self, profile: &Profile, side: Side) -> Vec<f64> {
        let mut breaks = vec![0.0];
        if let (Some(resolved), Side::Left) = (&self.resolved, side) {
            let mut rhos = profile.kinks_rho_mm();
            rhos.push(resolved.from_rho_mm);
            rhos.sort_by(f64::total_cmp);
            let at_mm = |u: f64| profile.point_mm(Piece::Flank, u);
            for rho in rhos {
                let (u, near_mm) = (profile.at_rho(rho), NEGLIGIBLE * resolved.element_mm(rho));
                let before = breaks.last().copied().unwrap_or(0.0);
                if (at_mm(u) - at_mm(before)).norm() > near_mm && (at_mm(1.0) - at_mm(u)).norm() > near_mm {
                    breaks.push(u);
                }
            }
        }
        breaks.push(1.0);
        breaks
    }

    /// Asks for the lengths on `run`.
    fn apply(&self, profile: &Profile, run: &mut Run) {
        let (module, least) = (self.module_mm, LEAST_MODULES * self.module_mm);
        let resolved = self.resolved.as_ref().filter(|_| run.side == Side::Left);
        run.want(|_, _| GREATEST_MODULES * module);
        match run.part {
            Part::RootArc => {}
            Part::Fillet => {
                run.want(|_, _| self.fillet_mm);
                run.follow_curvature(FILLET_OVER_CURVATURE, LEAST_FILLET_MODULES * module);
            }
            Part::Flank => run.want(|place, point| {
                let rho = profile.rho_mm(place.u);
                let thickness = (2.0 * point.x.abs()).max(least / OVER_THICKNESS);
                let open = (FLANK_MODULES * module).min(OVER_THICKNESS * thickness);
                // The break at the beginning of the resolved part belongs to it, on both of its sides.
                resolved
                    .filter(|resolved| rho >= resolved.from_rho_mm * (1.0 - 1e-12))
                    .map_or(open, |resolved| resolved.element_mm(rho).min(open))
            }),
            Part::Rounding => {
                let [fine, open] = ROUNDING_OVER_RADIUS.map(|part| (part * profile.rounding_mm()).max(least));
                let wanted = resolved.map_or(open, |resolved| {
                    let FlankResolution { elements_per_half_width, rounding_refinement, .. } = resolved.flank;
                    let own = rounding_element_mm(profile.rounding_mm(), elements_per_half_width, rounding_refinement);
                    fine.min(resolved.element_mm(resolved.tip_rho_mm)).min(own.max(least))
                });
                run.want(|_, _| wanted);
            }
            Part::Land => {
                let wanted = (OVER_THICKNESS * run.arc_mm()).max(least);
                run.want(|_, _| wanted);
            }
        }
    }
}
