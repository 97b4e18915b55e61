//! The planetary stage that a stage of sun and planet belongs to: its ring, and how many planets it has.
//!
//! The format has a cylindrical stage for each mesh: sun and each planet, each planet and ring (`ring_gear`). Numbers of teeth and profile shifts of rings stand in files with
//! either sign. Without its sign, a shift is taken with the one that leaves less backlash at the centre distance.

use super::RexsError;
use super::document::{RexsComponent, RexsDocument};
use super::profile_shift;
use super::stage::{Figure, GearData, Gears, NormalSection, RexsStage};

/// A planetary stage beside its mesh of sun and planet.
#[derive(Debug)]
pub(super) struct PlanetaryUnit<'a> {
    /// Component of the whole stage, where the file has one alone.
    pub component: Option<&'a RexsComponent>,
    /// Whether the sun is the pinion of the pair that the file gives.
    pub sun_drives: bool,
    /// Number of planets.
    pub planets: usize,
    /// The ring.
    pub ring: GearData<'a>,
    /// Mesh of the planet and the ring.
    pub ring_mesh: RexsStage<'a>,
}

/// The planetary stage of `stage`, whose gears are `gears`; `None` where no gear of it meets a ring.
pub(super) fn of<'a>(
    document: &'a RexsDocument,
    stage: &RexsStage<'a>,
    gears: &Gears<'a>,
    warnings: &mut Vec<String>,
) -> Result<Option<PlanetaryUnit<'a>>, RexsError> {
    let meshes: Vec<RexsStage> = meshes(document);
    let mesh_with_ring = |planet: &RexsComponent| {
        let mut of_planet = meshes.iter().filter_map(|mesh| Some((mesh, mate(&mesh.gears, planet)?)));
        of_planet.find(|(_, mate)| mate.kind == "ring_gear")
    };
    let ring_of = |planet: &RexsComponent| mesh_with_ring(planet).map(|(_, ring)| ring);
    let found = stage.gears.iter().enumerate().find_map(|(side, planet)| Some((side, mesh_with_ring(planet)?)));
    let Some((planet_side, (ring_mesh, ring))) = found else { return Ok(None) };
    let sun = stage.gears[1 - planet_side];
    let planets = meshes
        .iter()
        .filter_map(|mesh| mate(&mesh.gears, sun))
        .filter(|planet| ring_of(planet).is_some_and(|other| other.id == ring.id))
        .count();
    let sun_drives = gears.pinion.component.id == sun.id;
    let planet = if sun_drives { &gears.wheel } else { &gears.pinion };
    let section = match (&gears.normal_module_mm, &gears.pressure_angle_deg) {
        (Some(module), Some(angle)) => Some(NormalSection {
            normal_module_mm: module.value,
            pressure_angle_deg: angle.value,
            helix_angle_deg: gears.helix_angle_deg.value,
        }),
        _ => None,
    };
    let mut ring = stage.ring_data(document, ring, section.as_ref(), warnings)?;
    ring.profile_shift = ring_shift(section.as_ref(), gears.centre_distance_mm.as_ref(), planet, &ring);
    let mut units = document.components.iter().filter(|component| component.kind == "planetary_stage");
    let component = units.next().filter(|_| units.next().is_none());
    let ring_mesh = RexsStage { component: ring_mesh.component, gears: [stage.gears[planet_side], ring.component] };
    Ok(Some(PlanetaryUnit { component, sun_drives, planets, ring, ring_mesh }))
}

/// All cylindrical stages, with whatever gears.
fn meshes(document: &RexsDocument) -> Vec<RexsStage<'_>> {
    let stages = document.components.iter().filter(|component| component.kind == "cylindrical_stage");
    let meshes = stages.filter_map(|component| {
        let relation = document.relation("stage", &[("stage", &component.id)])?;
        let [Some(one), Some(other)] = ["gear_1", "gear_2"].map(|role| document.component(relation.member(role)?))
        else {
            return None;
        };
        Some(RexsStage { component, gears: [one, other] })
    });
    meshes.collect()
}

/// The other one of two gears.
fn mate<'a>(gears: &[&'a RexsComponent; 2], gear: &RexsComponent) -> Option<&'a RexsComponent> {
    let own = gears.iter().position(|other| other.id == gear.id)?;
    Some(gears[1 - own])
}

/// x of the ring, positive towards its tips: as given, or what the centre distance asks for.
fn ring_shift(
    section: Option<&NormalSection>,
    centre_distance_mm: Option<&Figure>,
    planet: &GearData,
    ring: &GearData,
) -> Option<Figure> {
    let given = ring.profile_shift.clone();
    let determined = || {
        let teeth = [f64::from(planet.teeth?), -f64::from(ring.teeth?)];
        let sum = profile_shift::sum(section?, -centre_distance_mm?.value, teeth[0] + teeth[1])?;
        let value = sum - planet.profile_shift.as_ref()?.value;
        // Without the sign of a shift that is none.
        Some((1e9 * value).round() / 1e9 + 0.0)
    };
    match (given, determined()) {
        (Some(given), Some(tight)) if (given.value + tight).abs() < (given.value - tight).abs() => {
            Some(Figure::derived(-given.value, "the file’s with the sign that fits the centre distance"))
        }
        (Some(given), _) => Some(given),
        (None, Some(tight)) => {
            Some(Figure::derived(tight, "from the centre distance and the planet’s, without backlash"))
        }
        (None, None) => None,
    }
}
