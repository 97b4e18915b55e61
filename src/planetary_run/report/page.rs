//! `report.html` of a planetary stage.

use maud::{Markup, html};

use super::TRANSMISSION_ERROR;
use super::drawing::{self, StageDrawing};
use crate::planetary_run::record::{PlanetaryRecord, PlanetarySummary, StageTransmissionRow};
use crate::report::chart::{Chart, Dash, INK, MUTED, Trace, gear_colour, gear_fill};
use crate::report::html::number::{figure, hours, percent, revolutions, significant};
use crate::report::html::page::{Page, Plots, note, section, sources_list};
use crate::report::html::run_page;
use crate::report::html::table::{cells, line, list, row, table};
use crate::report::output_files;
use crate::scene::planetary::mesh::StageMesh;
use crate::scene::planetary::words::of_stage;
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::error::TotalError;
use gearwear_physics::results::run::{RunRecord, StopReason, Summary, WearSummary};

const DATA_FILES: [(&str, &str); 4] = [
    (output_files::SUMMARY, "the main figures of the stage and of both meshes"),
    (TRANSMISSION_ERROR, "the transmission error over one base pitch"),
    (output_files::COLUMNS, "what its columns hold"),
    (output_files::SCENE, "the scene as given"),
];

/// Plots of a mesh's page that the page of the stage shows too.
const OF_FLANKS: [&str; 4] = ["wear-pinion", "wear-wheel", "pressure-pinion", "pressure-wheel"];

pub(super) fn page(record: &PlanetaryRecord) -> String {
    let s = &record.summary;
    let plots = Plots::default();
    let interruption = (!s.stopped.is_complete()).then(|| interruption(s));
    let figures = html! {
        div.tables { (wear(s)) (meshes(s)) }
        (note("Each mesh runs under the load of the planet that carries most. Seen from the carrier, sun and planet are a pair, and so are planet and ring: \
               their pages have everything else."))
        (links(record))
    };
    Page {
        kind: "Wear of a planetary stage",
        title: &s.title,
        byline: "",
        answer: &answer(s),
        interruption: interruption.as_deref(),
        warnings: &s.warnings,
        main: html! {
            (section("figures", "Main figures", figures))
            (section("plots", "Plots", plots.show(&charts(record))))
            (section("kinematics", "Speeds, torques and assembly", html! { div.tables { (members(s)) (assembly(s)) } }))
            (section("sources", "Data and scene", sources_list(&DATA_FILES, "The scene as given", &record.scene_toml)))
        },
        plots,
        footer: &format!("gearwear {} · scene {}", s.program_version, s.scene_hash),
    }
    .html()
}

/// The plots: the stage to scale, wear and pressure of all flanks, transmission error.
pub(super) fn charts(record: &PlanetaryRecord) -> Vec<Chart> {
    let mut charts: Vec<Chart> = drawing::draw(record).map(|drawing| stage(&drawing, record)).into_iter().collect();
    for mesh in StageMesh::BOTH {
        if let Some(run) = &record.meshes[mesh] {
            charts.extend(of_flanks(run, mesh));
        }
    }
    charts.extend(transmission_error(record));
    charts
}

/// Plots of both flanks of a mesh, in the words of the stage.
fn of_flanks(run: &RunRecord, mesh: StageMesh) -> impl Iterator<Item = Chart> {
    let own = run_page::charts(run).into_iter().filter(|chart| OF_FLANKS.contains(&chart.id.as_str()));
    own.map(move |chart| {
        let title = of_stage(&chart.title, mesh);
        let mate = |gear: &str| mesh.gears().into_iter().find(|name| *name != gear).unwrap_or_default();
        let of_planet =
            if title.contains("planet") { format!(" towards the {}", mate("planet")) } else { String::new() };
        let x = of_stage(&chart.x.title, mesh);
        Chart {
            id: format!("{}-{}", mesh.folder(), chart.id),
            title: title.replacen("’s flank", &format!("’s flank{of_planet}"), 1),
            reading: of_stage(&chart.reading, mesh),
            ..chart.x(&x)
        }
    })
}

fn closed(name: &str, points: &[[f64; 2]], (colour, fill): (&str, &str)) -> Trace {
    let points = points.iter().chain(points.first());
    let stroke = (colour, 1.4, Dash::Solid);
    Trace::line(name, points.clone().map(|p| p[0]), points.map(|p| p[1]), stroke).filled(fill)
}

/// Sun, planets and ring to scale.
fn stage(drawing: &StageDrawing, record: &PlanetaryRecord) -> Chart {
    let s = &record.summary.planetary;
    let [sun, wheel] = Gear::BOTH.map(|gear| (gear_colour(gear), gear_fill(gear)));
    let planets = drawing.planets.iter().enumerate().map(|(index, points)| {
        let planet = closed("planets", points, wheel).group("planets");
        if index == 0 { planet } else { planet.unlisted() }
    });
    let reach = 1.03 * drawing.rim_radius_mm;
    let mut ring = drawing.ring.clone();
    // The rim's circle is joined to the outline, so that the ring between them is filled.
    ring.extend(drawing.ring.first().copied());
    ring.extend(circle_from(drawing.ring.first(), drawing.rim_radius_mm));
    let clearance = s
        .planet_clearance_mm
        .map_or_else(String::new, |gap| format!(" Tip circles of neighbouring planets are {} mm apart.", figure(gap)));
    Chart::new("stage", "The stage in mesh, to scale")
        .wide()
        .height(640)
        .x("x, mm")
        .y("y, mm")
        .x_range([-reach, reach])
        .y_range([-reach, reach])
        .drawn_to_scale()
        .read_nearest()
        .dragged()
        .add(closed("ring", &ring, (MUTED, "rgba(128, 128, 128, 0.16)")))
        .add_all(planets)
        .add(closed("sun", &drawing.sun, sun))
        .reading(format!(
            "The first planet, at the top, touches the sun at the pitch point; its mesh with the ring is {} of a base pitch ahead. The {} is held.{clearance}",
            significant(s.ring_mesh_phase, 3),
            s.held,
        ))
}

/// Circle of `radius_mm` about the origin that begins and ends beside `point`, anticlockwise: the ring's outline, mirrored, is clockwise.
fn circle_from(point: Option<&[f64; 2]>, radius_mm: f64) -> Vec<[f64; 2]> {
    const POINTS: usize = 240;
    let first = point.map_or(0.0, |[x, y]| y.atan2(*x));
    let angle = |i: usize| first + std::f64::consts::TAU * i as f64 / POINTS as f64;
    (0..=POINTS).map(|i| [radius_mm * angle(i).cos(), radius_mm * angle(i).sin()]).collect()
}

/// Transmission error of stage and meshes over one base pitch; none where it is not known.
fn transmission_error(record: &PlanetaryRecord) -> Option<Chart> {
    let rows = &record.transmission_error;
    let of = &record.summary.transmission_error;
    let (new, worn) = (of.new?, of.worn?);
    let of_meshes = &record.summary;
    let alone: Vec<String> = StageMesh::BOTH
        .into_iter()
        .filter_map(|mesh| {
            let worn = of_meshes.mesh(mesh)?.worn.transmission_error_um.peak_to_peak;
            Some(format!("{} µm of {}", figure(worn), mesh.in_words()))
        })
        .collect();
    let x = || rows.iter().map(|row| row.mesh_phase);
    let curve = |of: fn(&StageTransmissionRow) -> f64| rows.iter().map(of);
    Some(
        Chart::new("stage-transmission-error", "Transmission error of the stage over one base pitch")
            .wide()
            .x("place within the mesh of sun and first planet, base pitches")
            .y("transmission error, µm")
            .line("sun and planet, worn", x(), curve(|row| row.sun_planet_worn_um), (gear_colour(Gear::Pinion), 1.4, Dash::Solid), "%{y:.3f} µm")
            .line("planet and ring, worn", x(), curve(|row| row.planet_ring_worn_um), (gear_colour(Gear::Wheel), 1.4, Dash::Solid), "%{y:.3f} µm")
            .line("stage, new", x(), curve(|row| row.stage_new_um), (MUTED, 2.0, Dash::Dashed), "%{y:.3f} µm")
            .line("stage, worn", x(), curve(|row| row.stage_worn_um), (INK, 2.4, Dash::Solid), "%{y:.3f} µm")
            .reading(format!(
                "At the base circle of the sun, mean of all planets: peak to peak {} µm new and {} µm worn, against {} worn. What the planets’ phases do not \
                 even out is left.",
                figure(new.peak_to_peak),
                figure(worn.peak_to_peak),
                alone.join(" and "),
            )),
    )
}

/// "127.75 h (1.15 million revolutions of the sun)".
fn duration(s: &PlanetarySummary) -> String {
    let turns = format!("{} revolutions of the {}", revolutions(s.revolutions), s.planetary.member);
    match s.hours {
        Some(time) => format!("{} h ({turns})", hours(time)),
        None => turns,
    }
}

fn answer(s: &PlanetarySummary) -> String {
    let depths: Vec<String> = s
        .flanks()
        .into_iter()
        .filter_map(|(name, wear)| Some(format!("{} µm on the {name}", figure(wear?.peak_wear_um))))
        .collect();
    let life = s.life.as_ref().map_or_else(String::new, |life| match (&life.gear, life.revolutions) {
        (Some(gear), Some(turns)) => {
            let time = life.hours.map_or_else(String::new, |time| format!("{} h, ", hours(time)));
            format!(
                "The life of the stage is {time}{} revolutions of the {}, to the limit of the {gear}. ",
                revolutions(turns),
                s.planetary.member
            )
        }
        _ => "No limit of operation.stop was reached. ".to_owned(),
    });
    let error = match (&s.transmission_error.new, &s.transmission_error.worn) {
        (Some(new), Some(worn)) => format!(
            " The transmission error of the stage peak to peak went from {} to {} µm.",
            figure(new.peak_to_peak),
            figure(worn.peak_to_peak)
        ),
        _ => String::new(),
    };
    format!("{life}After {} the flanks have lost at most: {}.{error}", duration(s), depths.join(", "))
}

fn interruption(s: &PlanetarySummary) -> String {
    let reason = match s.stopped {
        StopReason::Interrupted => "It was interrupted; gearwear run --resume goes on with it",
        StopReason::WornThrough => "The wear of a gear came to the thickness of its teeth",
        StopReason::NotConverged | StopReason::Completed | StopReason::LimitReached => {
            "A mesh could not be run to its end"
        }
    };
    format!("{reason}.")
}

/// Wear of the four flanks.
fn wear(s: &PlanetarySummary) -> Markup {
    let flanks = s.flanks();
    let of = |value: fn(&WearSummary) -> f64| flanks.map(|(_, wear)| wear.map(value));
    let error = |mesh: StageMesh, gear: Gear| {
        let total: &TotalError = &s.mesh(mesh)?.error.total;
        let own = &total.peak_wear;
        (if gear == Gear::Pinion { own.pinion } else { own.wheel }).map(percent)
    };
    let errors = [
        error(StageMesh::SunPlanet, Gear::Pinion),
        error(StageMesh::SunPlanet, Gear::Wheel),
        error(StageMesh::PlanetRing, Gear::Pinion),
        error(StageMesh::PlanetRing, Gear::Wheel),
    ];
    table(
        "Wear",
        &flanks.map(|(name, _)| name),
        [
            row("maximum wear depth", "µm", of(|wear| wear.peak_wear_um)),
            row("its uncertainty", "", errors),
            row("at the tip edge", "µm", of(|wear| wear.tip_edge_wear_um)),
            row("at the pitch circle", "µm", of(|wear| wear.pitch_wear_um)),
            row("worn off all teeth of a gear", "mg", of(|wear| wear.worn_mass_mg)),
            row("normal tip thickness left", "mm", of(|wear| wear.normal_tip_thickness_mm)),
        ],
    )
}

/// Contact of both meshes.
fn meshes(s: &PlanetarySummary) -> Markup {
    let of = |value: fn(&Summary) -> f64| StageMesh::BOTH.map(|mesh| s.mesh(mesh).map(value));
    let names = StageMesh::BOTH.map(StageMesh::in_words);
    table(
        "Meshes",
        &names.each_ref().map(String::as_str),
        [
            row("flank pressure, new", "MPa", of(|one| one.new.flank_pressure_MPa)),
            row("flank pressure, worn", "MPa", of(|one| one.worn.flank_pressure_MPa)),
            row("transmission error peak to peak, new", "µm", of(|one| one.new.transmission_error_um.peak_to_peak)),
            row("transmission error peak to peak, worn", "µm", of(|one| one.worn.transmission_error_um.peak_to_peak)),
            row("transverse contact ratio", "", of(|one| one.geometry.transverse_contact_ratio)),
            row("working pressure angle", "°", of(|one| one.geometry.working_pressure_angle_deg)),
            row("circumferential backlash", "mm", of(|one| to_tenth_of_um(one.geometry.backlash_mm))),
        ],
    )
}

/// A length without the remainder of differences of the last bit.
fn to_tenth_of_um(mm: f64) -> f64 {
    (mm * 1e4).round() / 1e4
}

/// Pages of both meshes.
fn links(record: &PlanetaryRecord) -> Markup {
    html! {
        ul.files {
            @for mesh in StageMesh::BOTH {
                @if record.meshes[mesh].is_some() {
                    li { a href={ (mesh.folder()) "/" (output_files::PAGE) } { (mesh.in_words()) } " the page of this mesh" }
                }
            }
        }
    }
}

/// Speeds and torques of the members.
fn members(s: &PlanetarySummary) -> Markup {
    let k = &s.planetary;
    let names = ["sun", "carrier", "ring"];
    let speeds = k.speed_rpm.map(|rpm| row("speed", "1/min", [rpm.sun, rpm.carrier, rpm.ring]));
    let ratio = [k.speed_ratio.sun, k.speed_ratio.carrier, k.speed_ratio.ring];
    let torque = [k.torque_Nm.sun, k.torque_Nm.carrier, k.torque_Nm.ring];
    let rows = speeds.into_iter().chain([
        row(format!("speed over that of the {}", k.member), "", ratio),
        row("torque, without losses", "N·m", torque),
    ]);
    table("Members", &names, rows)
}

fn assembly(s: &PlanetarySummary) -> Markup {
    let k = &s.planetary;
    let list_of = |values: &[f64]| values.iter().map(|value| significant(*value, 4)).collect::<Vec<_>>().join(", ");
    let meshes = &k.meshes_per_revolution;
    let per_turn = format!("meshes of a tooth in a revolution of the {}", k.member);
    let rows = [
        line(cells!["planets", k.planets]),
        line(cells!["angles of the planets, °", list_of(&k.planet_angles_deg)]),
        line(cells!["held", k.held.as_str()]),
        line(cells!["load sharing factor K_γ", k.load_sharing_factor]),
        line(cells![format!("{per_turn}: sun"), meshes.sun]),
        line(cells![format!("{per_turn}: either flank of a planet"), meshes.planet]),
        line(cells![format!("{per_turn}: ring"), meshes.ring]),
        line(cells!["distance between tip circles of neighbouring planets, mm", k.planet_clearance_mm]),
        line(cells!["phases of the planets’ meshes with the sun, base pitches", list_of(&k.mesh_phase)]),
        line(cells!["phase of a planet’s mesh with the ring, base pitches", k.ring_mesh_phase]),
    ];
    list("Assembly", ["", ""], rows)
}
