//! Contact, stiffness and numerics.

use std::ops::RangeInclusive;

use crate::scene::file::{ContactFile, NamedStep, NumericsFile, StepFile, StiffnessFile, StiffnessModel};
use crate::scene::findings::Findings;
use crate::scene::problem::number;
use gearwear_bodies::gear::GearPair;
use gearwear_bodies::gear::flank::PointSpacing;
use gearwear_physics::contact::settings::{ContactSettings, Foundation, SurfaceKind};
use gearwear_physics::mesh_cycle::settings::{Coupling, SliceSettings};
use gearwear_physics::operation::Scene;
use gearwear_physics::simulation::settings::{Numerics, Stepping};
use gearwear_physics::stiffness::settings::StiffnessSettings;

const FLANK_POINTS: u32 = 750;
pub(super) const POSITIONS: usize = 400;
/// Positions of half-planes in slices whose tip edges are followed, at least and at most: slices enter the mesh one by one, so that there are many more
/// places of contact.
pub(super) const POSITIONS_IN_SLICES: RangeInclusive<usize> = 150..=200;
/// Distance of these positions in half-widths of contact: the error is proportional to the square of it (docs/accuracy.md).
const APART_IN_SLICES: f64 = 0.5;
/// Error of the wear depth that adaptive steps may make, µm.
const TOLERANCE_UM: f64 = 0.05;
/// Least tolerance, µm: below the size of an atom the rounding of equilibria dominates, and steps become infinitely short.
const LEAST_TOLERANCE_UM: f64 = 1e-4;
/// Greatest product of points and positions, limited by memory: 300 000 take about 10 MB.
const MOST_POINTS_TIMES_POSITIONS: usize = 100_000_000;
/// Greatest number of wear steps in an acceptable time.
const MOST_STEPS: f64 = 1e7;

/// Contact surface of a scene that leaves it open: finite elements where plane ones can be made of the pair, unless something is given that only another surface
/// reads.
fn default_surface(file: &ContactFile, stiffness: Option<&StiffnessFile>, can_be_meshed: bool) -> SurfaceKind {
    let of_foundation = file.foundation_MPa_per_mm.is_some() || file.match_criterion.is_some();
    let of_springs = stiffness.is_some_and(StiffnessFile::says_anything);
    if of_foundation || file.calibration.is_some() {
        SurfaceKind::Winkler
    } else if !can_be_meshed || of_springs || file.tip_contact == Some(false) {
        SurfaceKind::HalfSpace
    } else {
        SurfaceKind::Fem
    }
}

/// Chooses the contact surface.
pub(super) fn contact(
    file: &mut Option<ContactFile>,
    stiffness: Option<&StiffnessFile>,
    can_be_meshed: bool,
    findings: &mut Findings,
) -> Option<ContactSettings> {
    let file = file.get_or_insert_default();
    let surface = match (file.surface, default_surface(file, stiffness, can_be_meshed)) {
        (Some(surface), _) => surface,
        // The default differs where finite elements are not possible, and is not written into the file.
        (None, SurfaceKind::Fem) => SurfaceKind::Fem,
        (None, default) => *file.surface.insert(default),
    };
    let (given, criterion) = (file.foundation_MPa_per_mm, file.match_criterion);
    let keys = ["contact.match", "contact.foundation_MPa_per_mm"];
    if findings.said_twice(&[(keys[0], criterion.is_some()), (keys[1], given.is_some())]) {
        return None;
    }
    let calibrated = file.calibration.is_some();
    // Finite elements find the contact anywhere; Hertz's closed forms hold at the theoretical contact point.
    let tip_contact = match surface {
        SurfaceKind::Winkler | SurfaceKind::HalfSpace => *file.tip_contact.get_or_insert(true),
        SurfaceKind::Fem => true,
        SurfaceKind::Hertz | SurfaceKind::HertzMean => false,
    };
    if file.tip_contact.is_some_and(|asked| asked != tip_contact) {
        findings.unused("contact.tip_contact", "only the surfaces \"winkler\" and \"half-space\" read it");
    }
    if surface == SurfaceKind::Fem && calibrated {
        findings.unused("contact.calibration", "the surface \"fem\" is what it was made from");
    }
    if calibrated && given.is_some() && surface == SurfaceKind::Winkler {
        findings.unused("the K/H of contact.calibration", "contact.foundation_MPa_per_mm gives one");
    }
    if surface != SurfaceKind::Winkler {
        for (key, given) in [(keys[0], criterion.is_some()), (keys[1], given.is_some())] {
            if given {
                findings.unused(key, "only the surface \"winkler\" has a foundation");
            }
        }
    }
    let foundation = match given {
        Some(foundation_mpa_per_mm) => Foundation::Given { foundation_mpa_per_mm },
        None if surface == SurfaceKind::Winkler => {
            let criterion = *file.match_criterion.get_or_insert_default();
            if calibrated { Foundation::Calibrated(criterion) } else { Foundation::Matched(criterion) }
        }
        None => Foundation::Matched(criterion.unwrap_or_default()),
    };
    Some(ContactSettings { surface, foundation, tip_contact })
}

/// Puts a scene that leaves its surface open on elastic half-planes where finite elements for its contact would be too many, with a warning.
pub(super) fn leave_elements_out(scene: &mut Scene, pair: &GearPair) -> Option<String> {
    let too_narrow = scene.surface_by_default && scene.contact.surface == SurfaceKind::Fem;
    (too_narrow && scene.check_contact_can_be_meshed(pair).is_err()).then(|| {
        *scene = scene.on_half_planes();
        "contact.surface: elastic half-planes, as the contact is too narrow for finite elements, the default".to_owned()
    })
}

/// Inputs of the choice of a stiffness model.
#[derive(Debug, Clone, Copy)]
pub(super) struct StiffnessInputs {
    /// Contact surface.
    pub surface: Option<SurfaceKind>,
    /// Whether a calibration is given.
    pub calibrated: bool,
    /// Coupling of the slices over the face width, where there are any.
    pub coupling: Option<Coupling>,
}

/// Chooses the tooth stiffness.
pub(super) fn stiffness(
    file: &mut Option<StiffnessFile>,
    StiffnessInputs { surface, calibrated, coupling }: StiffnessInputs,
    findings: &mut Findings,
) -> Option<StiffnessSettings> {
    let key = "stiffness.pair_N_per_mm_um";
    let file = file.get_or_insert_default();
    if surface == Some(SurfaceKind::Fem) && file.model.is_some() {
        findings.unused("stiffness.model", "the finite elements of the surface \"fem\" bend their own teeth");
    }
    let model = match (surface, calibrated) {
        (_, true) if surface != Some(SurfaceKind::Fem) => *file.model.get_or_insert(StiffnessModel::Fem),
        // The default differs where finite elements are not possible, and is not written into the file; nor is a key that is not read.
        _ => file.model.unwrap_or(StiffnessModel::Fem),
    };
    if coupling == Some(Coupling::Fem) && model != StiffnessModel::Fem {
        findings.not_allowed(
            "stiffness.model",
            "another model than \"fem\" with helical.coupling = \"fem\"",
            "\"fem\", the stiffness of the same teeth in plane strain",
        );
        return None;
    }
    let of_curve = matches!(model, StiffnessModel::Simon | StiffnessModel::WangCheng);
    if of_curve && file.curve.is_none() {
        findings.missing(&["stiffness.curve"], "the name of a data file");
        return None;
    }
    if !of_curve && file.curve.is_some() {
        findings.unused("stiffness.curve", "only stiffness.model = \"simon\" and \"wang-cheng\" read it");
    }
    let settings = match model {
        StiffnessModel::Constant => match file.pair_N_per_mm_um {
            Some(value) => StiffnessSettings::Constant { pair_n_per_mm2: 1e3 * value },
            None => {
                findings.missing(&[key], "a number greater than 0");
                findings.help("stiffness.model = \"constant\" needs it; 20 is usual for steel");
                return None;
            }
        },
        StiffnessModel::WeberBanaschek => StiffnessSettings::WeberBanaschek,
        StiffnessModel::Iso6336 => StiffnessSettings::Iso6336,
        StiffnessModel::Fem => StiffnessSettings::Fem,
        StiffnessModel::Simon => StiffnessSettings::Simon,
        StiffnessModel::WangCheng => StiffnessSettings::WangCheng,
    };
    if model != StiffnessModel::Constant && file.pair_N_per_mm_um.is_some() {
        findings.unused(key, "only stiffness.model = \"constant\" reads it");
    }
    Some(settings)
}

/// Chooses the resolution for a run of `duration` revolutions, with `adaptive` steps where the file does not say, and flank points closer
/// at the tip edges where these touch.
pub(super) fn numerics(
    file: &mut Option<NumericsFile>,
    duration: f64,
    adaptive: bool,
    tip_contact: bool,
    most_positions: usize,
    findings: &mut Findings,
) -> Option<Numerics> {
    let file = file.get_or_insert_default();
    let stepping = stepping(file, duration, adaptive, findings)?;
    let flank_points = *file.flank_points.get_or_insert(FLANK_POINTS) as usize;
    let positions = file.positions.map_or(most_positions, |positions| positions as usize);
    let spacing = if tip_contact { PointSpacing::Graded } else { PointSpacing::Even };
    let point_spacing = *file.flank_point_spacing.get_or_insert(spacing);
    let error_estimate = *file.error_estimate.get_or_insert(true);
    Some(Numerics { flank_points, point_spacing, positions, stepping, error_estimate })
}

/// Chooses the positions that the scene leaves open, once its pair is known.
pub(super) fn positions(scene: &mut Scene, file: &mut NumericsFile, pair: &GearPair) {
    if file.positions.is_none() && are_in_slices(Some(scene.contact), scene.slices) {
        scene.numerics.positions = scene.positions_apart(pair, APART_IN_SLICES, POSITIONS_IN_SLICES);
    }
    file.positions.get_or_insert(scene.numerics.positions as u32);
}

/// Whether contact is that of half-planes in slices that are followed beyond the tip edges.
pub(super) fn are_in_slices(contact: Option<ContactSettings>, slices: Option<SliceSettings>) -> bool {
    let of_half_planes =
        contact.is_some_and(|contact| contact.surface == SurfaceKind::HalfSpace && contact.tip_contact);
    of_half_planes && slices.is_some()
}

fn stepping(file: &mut NumericsFile, duration: f64, adaptive: bool, findings: &mut Findings) -> Option<Stepping> {
    let default = match adaptive {
        true => StepFile::Named(NamedStep::Adaptive),
        false => StepFile::fixed(Stepping::euler(duration).euler_revolutions(duration)),
    };
    match *file.step.get_or_insert(default) {
        StepFile::Fixed(step) => {
            let revolutions = step.revolutions;
            for (key, given) in
                [("numerics.tolerance_um", file.tolerance_um.is_some()), ("numerics.method", file.method.is_some())]
            {
                if given {
                    findings.unused(key, "only numerics.step = \"adaptive\" reads it");
                }
            }
            if duration / revolutions > MOST_STEPS {
                let allowed = format!("at least {} (ten million steps)", number(duration / MOST_STEPS));
                findings.not_allowed("numerics.step.revolutions", number(revolutions), allowed);
                return None;
            }
            Some(Stepping::Fixed { revolutions })
        }
        StepFile::Named(NamedStep::Adaptive) => {
            let tolerance_um = *file.tolerance_um.get_or_insert(TOLERANCE_UM);
            if tolerance_um < LEAST_TOLERANCE_UM {
                let allowed = format!("at least {} µm", number(LEAST_TOLERANCE_UM));
                findings.not_allowed("numerics.tolerance_um", number(tolerance_um), allowed);
                return None;
            }
            file.method.get_or_insert_default();
            Some(Stepping::Adaptive { tolerance_mm: 1e-3 * tolerance_um })
        }
    }
}

/// Refuses a resolution that needs too much memory. The simplified surface stores a position instead of a strip of the flank for each contact.
pub(super) fn memory(numerics: &Numerics, surface: SurfaceKind, slices: usize, findings: &mut Findings) {
    let (points, positions) = (numerics.flank_points, numerics.positions);
    let a_position =
        if surface == SurfaceKind::HertzMean && slices > 1 { slices } else { points.saturating_mul(slices) };
    if a_position.saturating_mul(positions) > MOST_POINTS_TIMES_POSITIONS {
        let of_slices = if slices > 1 { format!(" and {slices} slices") } else { String::new() };
        let allowed = format!(
            "at most {} positions with {points} flank points{of_slices} (about 4 GB of memory)",
            MOST_POINTS_TIMES_POSITIONS / a_position
        );
        findings.not_allowed("numerics.positions", positions.to_string(), allowed);
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::draft::Draft;
    use crate::scene::presets;

    /// Positions of a preset that leaves them open, with these keys exchanged.
    fn positions(preset: &str, exchanged: &[(&str, f64)]) -> usize {
        let mut draft = Draft::parse(presets::find(preset).unwrap().text).unwrap();
        draft.remove("numerics.positions");
        exchanged.iter().for_each(|(key, value)| draft.set(key, *value));
        draft.resolve().unwrap().scene.numerics.positions
    }

    /// helical: 19.097 mm from A to E and a = 0.2083 mm at C under 302 N·m give 19.097/(0.5 · 0.2083) = 183.3 intervals, 184 whole ones; under 1.5 times the
    /// torque 183.3/√1.5 = 149.7, 150 whole ones. Within 150 and 200 positions whatever the load; a number that is given stands.
    #[test]
    fn ver_positions_in_slices_follow_the_width_of_contact() {
        assert_eq!(positions("helical", &[]), 185);
        assert_eq!(positions("helical", &[("operation.pinion_torque_Nm", 453.0)]), 151);
        assert_eq!(positions("helical", &[("operation.pinion_torque_Nm", 30.0)]), 200);
        assert_eq!(positions("h951", &[]), 150);
        assert_eq!(positions("fzg-c", &[]), 400);
        let mut given = Draft::parse(presets::find("helical").unwrap().text).unwrap();
        given.set("numerics.positions", 60);
        assert_eq!(given.resolve().unwrap().scene.numerics.positions, 60);
    }
}
