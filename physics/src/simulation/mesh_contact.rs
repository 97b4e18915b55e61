//! The elastic model of a pair in mesh, and the pair that wears by it.

use std::borrow::Cow;

use super::settings::Numerics;
use crate::contact::flank_pressure::FlankParts;
use crate::contact::{ContactSurface, Effort, Flanks};
use crate::mesh_cycle::local_means::LocalMeans;
use crate::mesh_cycle::simplified::{SimplifiedPair, exact::SlicesInSeries};
use crate::mesh_cycle::wearing_pair::{OnFlankPlaces, PointsBetweenNodes, WearingPair};
use crate::mesh_cycle::{
    LineOfActionCycle, MeshCycle,
    condensed::WearingElements,
    positions::{loading_positions, positions_with_tip_contact},
    sliced::{SliceSprings, SlicedCycle},
    sliced_positions::{SliceEnds, sliced_positions},
    sliced_teeth::SlicedTeeth,
    spring_along_path::SpringAlongPath,
    tip_contact,
};
use crate::stiffness::{SpringParts, StiffnessError, TeethSpring};
use gearwear_bodies::gear::removed_material::measured_flank_mm;
use gearwear_bodies::gear::{GearPair, PerGear, flank_zones::FlankZones, slices::Slices};
use gearwear_bodies::material::Material;

/// The elastic model of the pair in mesh.
#[derive(Clone, Copy)]
pub enum MeshContact<'a> {
    /// Each tooth pair a spring of its teeth in series with its contact surface, on the theoretical line of action.
    LineOfAction {
        /// Contact surface of the flanks.
        surface: &'a dyn ContactSurface,
        /// Springs of the teeth.
        teeth: &'a TeethSpring<'a>,
        /// Whether tip edges are followed into contact before A and after E.
        tip_contact: bool,
        /// The slices over the face width; none where all sections are alike.
        sliced: Option<&'a SlicedTeeth>,
    },
    /// Slices with Hertz's mean pressure, whose wear is kept at their contact points.
    Simplified {
        /// Material of each gear.
        material: &'a PerGear<Material>,
        /// Springs of the teeth.
        teeth: &'a TeethSpring<'a>,
        /// The slices over the face width.
        sliced: &'a SlicedTeeth,
    },
    /// Both gears as finite elements, condensed onto their flanks.
    FiniteElements(&'a WearingElements<'a>),
}

/// Tip edges are looked at within this many times the approach at the pitch point under the whole load: off it the teeth
/// are softer, and wear adds to it.
const AMPLE_APPROACH: f64 = 2.0;

/// Least effort between clean starts, in equilibria of a tooth pair on springs: about a quarter of a second of one thread.
const EFFORT_BETWEEN_CLEAN_STARTS: f64 = 100_000.0;
/// Part of the time that clean starts may take at the most.
const SHARE_OF_CLEAN_STARTS: f64 = 0.05;
/// Measured on the presets `helical` and `fzg-c`, rounded.
const SIMPLIFIED: Effort = Effort { of_equilibrium: 0.005, of_clean_start: 5.0 };
const FINITE_ELEMENTS: Effort = Effort { of_equilibrium: 4.0, of_clean_start: 15.0 };

/// Compliance of the bodies that all pairs in mesh share.
pub fn bodies_mm2_per_n(teeth: &TeethSpring<'_>, sliced: Option<&SlicedTeeth>) -> f64 {
    let of_section = teeth.shared_mm2_per_n();
    sliced.map_or(of_section, |sliced| sliced.bodies_mm2_per_n(of_section))
}

/// Spring of the section of a slice beside its surface: of three-dimensional teeth, that of the whole section.
///
/// # Errors
/// [`StiffnessError::SurfaceTooSoft`] also where the section's spring is positive and a slice's is not.
fn slice_spring(
    teeth: &TeethSpring<'_>,
    sliced: &SlicedTeeth,
    position_mm: f64,
) -> Result<SpringParts, StiffnessError> {
    let parts = match sliced.in_space() {
        Some(_) => teeth.oblique_parts(position_mm)?,
        None => teeth.own_parts(position_mm)?,
    };
    let [one, other] = sliced.softness().map(|softness| parts.mm2_per_n(softness));
    match one.min(other) {
        least if least > 0.0 => Ok(parts),
        least => Err(teeth.too_soft(position_mm, least)),
    }
}

/// Range before A and after E in which tip edges are followed on the line of action, mm of path.
fn tip_range_mm(
    pair: &GearPair,
    surface: &dyn ContactSurface,
    teeth: &TeethSpring<'_>,
    sliced: Option<&SlicedTeeth>,
    line_load_n_per_mm: f64,
) -> Result<[f64; 2], StiffnessError> {
    let pitch_point = pair.path.pitch_point_mm;
    let section = pair.normal_section();
    let along_normal = surface.plain_approach_mm(&section, pitch_point, line_load_n_per_mm);
    let surfaces = section.obliquity.transverse_mm(along_normal);
    let own = match sliced {
        Some(sliced) => slice_spring(teeth, sliced, pitch_point)?.mm2_per_n(sliced.softness()[1]),
        None => 1.0 / teeth.own_n_per_mm2(pitch_point)?,
    };
    let yielding = bodies_mm2_per_n(teeth, sliced) + own;
    let elastic_mm = AMPLE_APPROACH * (surfaces + yielding * line_load_n_per_mm);
    let reach_mm = pair.tip_reach_mm(elastic_mm + pair.unloaded_approach_mm());
    // Teeth in space are there for contacts so far out and no farther.
    let in_space = sliced.and_then(SlicedTeeth::in_space);
    Ok(in_space.map_or(reach_mm, |teeth| [0, 1].map(|end| reach_mm[end].min(teeth.reach_mm()[end]))))
}

/// A pair under a load, at some resolution.
pub(super) struct LoadedMesh<'a> {
    pub pair: &'a GearPair,
    pub contact: MeshContact<'a>,
    pub line_load_n_per_mm: f64,
    pub numerics: Numerics,
    /// The parts of each flank that figures speak of.
    pub zones: PerGear<FlankZones>,
}

impl MeshContact<'_> {
    /// Evaluations after which a wear run forgets what it starts from ([`super::checkpoint`]). Part of the model: it changes results in
    /// their last bits, and so depends on nothing but the scene.
    pub(crate) fn evaluations_between_clean_starts(&self, positions: usize) -> u64 {
        let (effort, slices) = match self {
            MeshContact::LineOfAction { surface, sliced, .. } => {
                (surface.effort(), sliced.map_or(1, |sliced| sliced.slices.count()))
            }
            MeshContact::Simplified { sliced, .. } => (SIMPLIFIED, sliced.slices.count()),
            MeshContact::FiniteElements(_) => (FINITE_ELEMENTS, 1),
        };
        let of_evaluation = effort.of_equilibrium * (positions * slices) as f64;
        (EFFORT_BETWEEN_CLEAN_STARTS / of_evaluation).max(effort.of_clean_start / SHARE_OF_CLEAN_STARTS) as u64
    }

    /// Range before A and after E in which contact of `pair` is looked for, mm of path: 0 where tip edges are not followed.
    pub fn range_mm(&self, pair: &GearPair, line_load_n_per_mm: f64) -> Result<[f64; 2], StiffnessError> {
        match self {
            MeshContact::LineOfAction { surface, teeth, tip_contact: true, sliced } => {
                tip_range_mm(pair, *surface, teeth, *sliced, line_load_n_per_mm)
            }
            MeshContact::LineOfAction { .. } | MeshContact::Simplified { .. } => Ok([0.0; 2]),
            MeshContact::FiniteElements(elements) => Ok(elements.model.range_mm()),
        }
    }

    /// Whether both are on the same finite elements.
    pub(super) fn is_on_elements_of(&self, other: &MeshContact<'_>) -> bool {
        match (self, other) {
            (MeshContact::FiniteElements(own), MeshContact::FiniteElements(others)) => std::ptr::eq(*own, *others),
            _ => false,
        }
    }

    /// Drops the positions that were prepared on finite elements and that no mesh cycle uses.
    pub(crate) fn drop_idle_positions(&self) {
        if let MeshContact::FiniteElements(elements) = self {
            elements.drop_idle();
        }
    }

    /// The slices of `pair` over the face width: one where all sections are alike.
    pub(super) fn slices(&self, pair: &GearPair) -> Slices {
        match self {
            MeshContact::LineOfAction { sliced: Some(teeth), .. } | MeshContact::Simplified { sliced: teeth, .. } => {
                teeth.slices.clone()
            }
            _ => Slices::new(pair, 1),
        }
    }
}

impl<'a> LoadedMesh<'a> {
    /// The pair, ready to wear.
    pub(super) fn wearing_pair(
        &self,
        flanks: Flanks<'a>,
        modification_mm: &'a PerGear<Vec<f64>>,
    ) -> Result<Box<dyn WearingPair + 'a>, StiffnessError> {
        let (count, line_load) = (self.numerics.positions, self.line_load_n_per_mm);
        let cycle: Box<dyn MeshCycle + 'a> = match self.contact {
            MeshContact::LineOfAction { surface, teeth, tip_contact, sliced } => {
                // In every slice the profile is modified alike, but for a constant.
                let of_profile = PerGear::from_fn(|gear| &modification_mm[gear][..flanks.grid[gear].len()]);
                let parts = Some(FlankParts::new(self.pair, &self.zones));
                let flanks = Flanks { modification_mm: Some(of_profile), parts, ..flanks };
                self.on_line_of_action(flanks, surface, teeth, tip_contact, sliced)?
            }
            MeshContact::Simplified { material, teeth, sliced } => {
                return Ok(Box::new(self.simplified(flanks, modification_mm, material, teeth, sliced)?));
            }
            MeshContact::FiniteElements(elements) => {
                let cycle = elements.cycle(count, line_load).observing(self.zones);
                let between_nodes = PointsBetweenNodes {
                    radius_mm: PerGear::from_fn(|gear| {
                        let involute = self.pair.teeth[gear].involute;
                        flanks.grid[gear].coordinate_mm.iter().map(|&rho| involute.radius_mm(rho)).collect()
                    }),
                    node_radius_mm: cycle.radius_mm().map(<[f64]>::to_vec),
                    node_share_mm: cycle.nodes().map(|nodes| nodes.share_mm.clone()),
                };
                let places = cycle.nodes().map(|nodes| (nodes.along_mm.clone(), nodes.share_mm.clone()));
                let means = LocalMeans::new(places, &self.zones);
                let measured_mm = PerGear::from_fn(|gear| {
                    measured_flank_mm(self.pair, gear, cycle.radius_mm()[gear].iter().copied())
                });
                let cycle = Box::new(cycle);
                return Ok(Box::new(OnFlankPlaces::new(cycle, means, Cow::Owned(measured_mm), Some(between_nodes))));
            }
        };
        let places = flanks.grid.map(|grid| {
            let share_mm = (0..grid.len()).map(|i| grid.share_mm(i)).collect();
            (grid.arc_mm.clone(), share_mm)
        });
        let means = LocalMeans::new(places, &self.zones);
        Ok(Box::new(OnFlankPlaces::new(cycle, means, Cow::Borrowed(modification_mm), None)))
    }

    /// The simplified model of a pair with slices.
    fn simplified(
        &self,
        flanks: Flanks<'a>,
        modification_mm: &PerGear<Vec<f64>>,
        material: &'a PerGear<Material>,
        teeth: &TeethSpring<'_>,
        sliced: &'a SlicedTeeth,
    ) -> Result<SimplifiedPair<'a>, StiffnessError> {
        let (path, count, line_load) = (&self.pair.path, self.numerics.positions, self.line_load_n_per_mm);
        let springs = SlicesInSeries {
            pair: self.pair,
            material,
            along_path: SpringAlongPath::new(path, count, [0.0; 2], |at| slice_spring(teeth, sliced, at))?,
            sliced,
            line_load_n_per_mm: line_load * sliced.slices.count() as f64,
        };
        let phases = sliced_positions(path, &sliced.slices, count, SliceEnds::AtOnce);
        let bodies_mm = bodies_mm2_per_n(teeth, Some(sliced)) * line_load;
        let parts = FlankParts::new(self.pair, &self.zones);
        Ok(SimplifiedPair::new(springs, phases, flanks.grid, modification_mm, count, bodies_mm, parts))
    }

    /// SlicesInSeries on the line of action, at every loading position.
    fn on_line_of_action(
        &self,
        flanks: Flanks<'a>,
        surface: &'a dyn ContactSurface,
        teeth: &TeethSpring<'_>,
        tip_contact: bool,
        sliced: Option<&'a SlicedTeeth>,
    ) -> Result<Box<dyn MeshCycle + 'a>, StiffnessError> {
        let line_load = self.line_load_n_per_mm;
        let (path, count) = (&self.pair.path, self.numerics.positions);
        let spring = |at| teeth.own_n_per_mm2(at);
        let bodies = bodies_mm2_per_n(teeth, sliced) * line_load;
        let sharp_edges = PerGear::from_fn(|gear| tip_contact && self.pair.spec.is_tip_sharp(gear));
        let sharp_corners = self.pair.undercut_corners().map(|corner| tip_contact && corner);
        let tip_from_mm = PerGear::from_fn(|gear| self.pair.rounding_start_rho_mm(gear));
        let flanks = Flanks { sharp_edges, sharp_corners, tip_from_mm, ..flanks };
        let lever_ratio = |at| tip_contact::approach_ratio(self.pair, at);
        let beyond = match tip_contact {
            true => Some(tip_range_mm(self.pair, surface, teeth, sliced, line_load)?),
            false => None,
        };
        if let Some(sliced) = sliced {
            let spring = |at| slice_spring(teeth, sliced, at);
            let along = SpringAlongPath::new(path, count, beyond.unwrap_or_default(), spring)?;
            let ends = match beyond {
                Some(beyond_mm) => SliceEnds::Beyond(beyond_mm),
                None if surface.touches_in_points() => SliceEnds::AtOnce,
                None => SliceEnds::Gradual,
            };
            let phases = sliced_positions(path, &sliced.slices, count, ends);
            let springs = SliceSprings { pair: self.pair, along_path: &along, lever_ratio: &lever_ratio };
            let cycle = SlicedCycle::new(flanks, surface, sliced, &phases, &springs, path, count, line_load);
            return Ok(Box::new(cycle.on_bodies_that_yield_by(bodies)));
        }
        let positions = match beyond {
            Some(beyond) => positions_with_tip_contact(path, count, beyond, lever_ratio, spring)?,
            None => loading_positions(path, count, spring)?,
        };
        let cycle = LineOfActionCycle::new(flanks, surface, &positions, line_load);
        Ok(Box::new(cycle.on_bodies_that_yield_by(bodies)))
    }
}
