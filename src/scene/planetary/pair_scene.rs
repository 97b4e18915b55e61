//! The scene of one mesh of a planetary stage, as a pair that runs on the carrier.
//!
//! Seen from the carrier the axes stand still. The sun is the pinion of the first mesh and drives a planet; the planet is the pinion of the second and
//! drives the ring. Where power flows the other way, contact passes the same points under the same load in the reverse order, so that the wear of Archard's law is
//! the same. Torque and turns of the pinions follow from those of the member that is given ([`gearwear_bodies::gear::planetary`]):
//!
//! ```text
//! T_1 = K_γ T_s/N        turns of the sun on the carrier × N planets = meshes of each of its teeth
//! T_2 = T_1 z_p/z_s      turns of a planet on the carrier; one mesh a turn on either of its flanks
//! ```
//!
//! Tables that name gears (`[wear.sun]`, `[material.planet]`) become those of pinion and wheel; `[sun_planet]` and `[planet_ring]` lie above what stands for both,
//! `[sun_planet.planet]` above `[planetary.planet]` too, as where the two flanks of the planets are not alike.

use toml::{Table, Value};

use super::file::{MemberFile, StageFile};
use super::mesh::StageMesh;
use crate::scene::table::{self, keys_of, other_ways_to_say};
use gearwear_bodies::gear::planetary::PlanetaryStage;

/// Keys of `[planetary]` that a pair does not have.
const OF_STAGE: [&str; 8] =
    ["planets", "planet_angles_deg", "held", "load_sharing_factor", "mesh", "sun", "planet", "ring"];

/// Names of keys of the operation: of the stage, and of the pinion of a mesh.
pub(super) const OF_OPERATION: [(&str, &str); 3] =
    [("torque_Nm", "pinion_torque_Nm"), ("speed_rpm", "pinion_speed_rpm"), ("revolutions", "pinion_revolutions")];

/// Torque and turns of a mesh's pinion per unit of those of the given member.
#[derive(Debug, Clone, Copy)]
struct Transfer {
    torque: f64,
    turns: f64,
}

impl Transfer {
    fn of(stage: &PlanetaryStage, file: &StageFile, member: MemberFile, mesh: StageMesh) -> Self {
        let planets = stage.planets() as f64;
        let share = file.planetary.load_sharing_factor.unwrap_or(1.0) / planets;
        let torque = stage.sun_torque(member.into()) * share;
        let turns = stage.sun_turns_relative_to_carrier(member.into()).unwrap_or(1.0);
        let to_planet = f64::from(stage.planet_teeth) / f64::from(stage.sun_teeth);
        match mesh {
            StageMesh::SunPlanet => Self { torque, turns },
            StageMesh::PlanetRing => Self { torque: torque * to_planet, turns: turns / to_planet },
        }
    }
}

/// The scene of `mesh` as a table, of the whole file `given` and what `file` says of the stage.
pub(super) fn of_mesh(
    given: &Table,
    file: &StageFile,
    stage: &PlanetaryStage,
    member: MemberFile,
    mesh: StageMesh,
    title: &str,
) -> Table {
    let mut scene = Table::new();
    let own = StageMesh::BOTH.map(StageMesh::table);
    for (name, value) in given {
        if name != "planetary" && name != "operation" && !own.contains(&name.as_str()) {
            scene.insert(name.clone(), with_gears_of(mesh, value));
        }
    }
    scene.insert("title".to_owned(), format!("{title}: {}", mesh.in_words()).into());
    if let Some(Value::Table(planetary)) = given.get("planetary") {
        scene.insert("pair".to_owned(), pair(planetary, mesh).into());
    }
    if let Some(Value::Table(operation)) = given.get("operation") {
        let of_pinion = Transfer::of(stage, file, member, mesh);
        scene.insert("operation".to_owned(), operation_of(operation, of_pinion, mesh, stage.planets()).into());
    }
    if let Some(above @ Value::Table(_)) = given.get(mesh.table()) {
        let Value::Table(above) = with_gears_of(mesh, above) else { return scene };
        for from in keys_of(&above, "") {
            // A gear of the mesh is one of its pair.
            let of_gear = from.starts_with("pinion.") || from.starts_with("wheel.");
            let key = if of_gear { format!("pair.{from}") } else { from.clone() };
            for other in other_ways_to_say(&key) {
                table::remove(&mut scene, &other);
            }
            if let Some(value) = table::at(&above, &from) {
                table::set(&mut scene, &key, value.clone());
            }
        }
    }
    scene
}

/// Pair of the mesh.
fn pair(planetary: &Table, mesh: StageMesh) -> Table {
    let mut pair: Table = planetary
        .iter()
        .filter(|(name, _)| !OF_STAGE.contains(&name.as_str()))
        .map(|(name, value)| (name.clone(), value.clone()))
        .collect();
    for (gear, name) in ["pinion", "wheel"].into_iter().zip(mesh.gears()) {
        if let Some(value) = planetary.get(name) {
            pair.insert(gear.to_owned(), value.clone());
        }
    }
    if let (StageMesh::PlanetRing, Some(Value::Table(ring))) = (mesh, pair.get_mut("wheel")) {
        ring.insert("internal".to_owned(), true.into());
    }
    pair
}

/// `value` with the tables of the mesh's gears as those of pinion and wheel, and without those of the third gear.
fn with_gears_of(mesh: StageMesh, value: &Value) -> Value {
    let [pinion, wheel] = mesh.gears();
    match value {
        Value::Table(table) => {
            let renamed = table.iter().filter_map(|(name, value)| {
                let name = match name.as_str() {
                    name if name == pinion => "pinion",
                    name if name == wheel => "wheel",
                    "sun" | "planet" | "ring" => return None,
                    name => name,
                };
                Some((name.to_owned(), with_gears_of(mesh, value)))
            });
            Value::Table(renamed.collect())
        }
        Value::Array(items) => items.iter().map(|item| with_gears_of(mesh, item)).collect::<Vec<_>>().into(),
        other => other.clone(),
    }
}

/// Operation of the mesh's pinion, from that of the member.
fn operation_of(given: &Table, of_pinion: Transfer, mesh: StageMesh, planets: usize) -> Table {
    let mut operation = with_pinion(given, of_pinion);
    operation.remove("member");
    if let Some(Value::Array(times)) = operation.get_mut("snapshots_revolutions") {
        for time in times {
            *time = scaled(time, of_pinion.turns);
        }
    }
    if let Some(Value::Array(phases)) = operation.get_mut("phases") {
        for phase in phases {
            if let Value::Table(table) = phase {
                *table = with_pinion(table, of_pinion);
            }
        }
    }
    let planets = i64::try_from(planets).unwrap_or(i64::MAX);
    let [pinion, wheel] = match mesh {
        StageMesh::SunPlanet => [planets, 1],
        StageMesh::PlanetRing => [1, planets],
    };
    let meshes = Table::from_iter([("pinion".to_owned(), pinion.into()), ("wheel".to_owned(), wheel.into())]);
    operation.insert("meshes_per_revolution".to_owned(), meshes.into());
    operation
}

/// Torque, speed and revolutions as the pinion's.
fn with_pinion(given: &Table, of_pinion: Transfer) -> Table {
    let renamed = given.iter().map(|(name, value)| match OF_OPERATION.iter().find(|(of_stage, _)| of_stage == name) {
        None => (name.clone(), value.clone()),
        Some((of_stage, of_pair)) => {
            let factor = if *of_stage == "torque_Nm" { of_pinion.torque } else { of_pinion.turns };
            ((*of_pair).to_owned(), scaled(value, factor))
        }
    });
    renamed.collect()
}

/// A number times `factor`; anything else as it is.
fn scaled(value: &Value, factor: f64) -> Value {
    match value {
        Value::Integer(number) => Value::Float(*number as f64 * factor),
        Value::Float(number) => Value::Float(number * factor),
        other => other.clone(),
    }
}
