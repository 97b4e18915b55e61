//! The stage to scale in the transverse section: sun, planets and ring, with the first planet in contact with the sun at the pitch point.
//!
//! The drawing of sun and planet has the sun's axis in the origin and the planet on +y, the sun turning anticlockwise. That of planet and ring, in which a planet drives
//! with its anticlockwise flanks, is mirrored at the line of centres, since the planets turn clockwise here; its ring is turned on by the phase of its mesh. Planet i is
//! the first one turned about the sun by ψ_i and about its own axis by ψ_i z_s/z_p more, as it rolls on a sun that stands still.

use std::f64::consts::TAU;

use crate::planetary_run::record::PlanetaryRecord;
use gearwear_bodies::gear::Gear;
use gearwear_physics::results::run::RunRecord;

/// Closed outlines of a stage, mm; the sun's axis is the origin.
pub(super) struct StageDrawing {
    pub sun: Vec<[f64; 2]>,
    pub planets: Vec<Vec<[f64; 2]>>,
    pub ring: Vec<[f64; 2]>,
    /// Outside radius with which the ring is drawn.
    pub rim_radius_mm: f64,
}

/// `point` turned about `centre`.
fn turned([x, y]: [f64; 2], centre: [f64; 2], angle_rad: f64) -> [f64; 2] {
    let (sin, cos) = angle_rad.sin_cos();
    let [dx, dy] = [x - centre[0], y - centre[1]];
    [centre[0] + cos * dx - sin * dy, centre[1] + sin * dx + cos * dy]
}

/// Outlines of the stage; `None` where a mesh was not run.
pub(super) fn draw(record: &PlanetaryRecord) -> Option<StageDrawing> {
    let [sun_planet, planet_ring]: [&RunRecord; 2] =
        [record.meshes.sun_planet.as_ref()?, record.meshes.planet_ring.as_ref()?];
    let stage = &record.summary.planetary;
    let teeth = [stage.teeth.sun, stage.teeth.planet, stage.teeth.ring].map(f64::from);
    let [sun_teeth, planet_teeth, ring_teeth] = teeth;
    let axis = sun_planet.drawing.axis[Gear::Wheel];
    let first = &sun_planet.drawing.outline[Gear::Wheel];
    let planets = stage.planet_angles_deg.iter().map(|angle_deg| {
        let angle = angle_deg.to_radians();
        let rolled = |&point: &[f64; 2]| {
            let own = turned(point, axis, angle * sun_teeth / planet_teeth);
            turned(own, [0.0, 0.0], angle)
        };
        first.iter().map(rolled).collect()
    });
    // Clockwise, as the planets that drive it.
    let ahead = -stage.ring_mesh_phase * TAU / ring_teeth;
    let ring_axis = planet_ring.drawing.axis[Gear::Wheel];
    let ring = planet_ring.drawing.outline[Gear::Wheel].iter().map(|&[x, y]| {
        let [x, y] = [-(x - ring_axis[0]), y - ring_axis[1]];
        turned([x, y], [0.0, 0.0], ahead)
    });
    Some(StageDrawing {
        sun: sun_planet.drawing.outline[Gear::Pinion].clone(),
        planets: planets.collect(),
        ring: ring.collect(),
        rim_radius_mm: planet_ring.drawing.rim_radius_mm?,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::planetary_run;
    use crate::scene::loaded::SceneText;
    use crate::scene::planetary::PlanetaryScene;
    use gearwear_physics::observer::Unwatched;
    use std::path::Path;

    /// Depth of `point` within the closed `outline`, mm; negative outside.
    fn depth(outline: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
        let sides = || outline.iter().zip(outline.iter().cycle().skip(1));
        let crossings =
            sides().filter(|([x1, y1], [x2, y2])| (*y1 > y) != (*y2 > y) && x < x1 + (y - y1) / (y2 - y1) * (x2 - x1));
        let distance = sides()
            .map(|([x1, y1], [x2, y2])| {
                let (sx, sy) = (x2 - x1, y2 - y1);
                let along = (((x - x1) * sx + (y - y1) * sy) / (sx * sx + sy * sy)).clamp(0.0, 1.0);
                (x1 + along * sx - x).hypot(y1 + along * sy - y)
            })
            .fold(f64::INFINITY, f64::min);
        if crossings.count() % 2 == 1 { distance } else { -distance }
    }

    /// Where every planet stands in its phase, teeth neither overlap nor leave more room than the backlash: with sun and ring at once, for even and odd numbers of teeth, equal
    /// and unequal angles. Outlines are chords of the flanks; every fifth point of a planet's is looked at.
    #[test]
    fn ver_teeth_of_all_planets_fit_between_sun_and_ring() {
        let stages = [
            ("planets = 4", [20, 20, 60], 60.0, 176.2),
            ("planets = 4", [21, 21, 63], 63.0, 185.2),
            ("planets = 3\nplanet_angles_deg = [0, 124.28571428571429, 240]", [21, 21, 63], 63.0, 185.2),
        ];
        for (planets, [sun, planet, ring], centre_distance, ring_tip) in stages {
            let text = format!(
                "[planetary]\n{planets}\nnormal_module_mm = 3.0\npressure_angle_deg = 20.0\ncentre_distance_mm = {centre_distance:?}\nface_width_mm = 20.0\n\
                 sun = {{ teeth = {sun}, profile_shift = -0.3 }}\nplanet = {{ teeth = {planet}, profile_shift = 0.3 }}\n\
                 ring = {{ teeth = {ring}, profile_shift = -0.3, tip_diameter_mm = {ring_tip:?}, cutter = {{ teeth = 25 }} }}\n\
                 [operation]\ntorque_Nm = 60.0\nrevolutions = 10\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 1e-20\n\
                 [contact]\nsurface = \"hertz\"\n[numerics]\nerror_estimate = false\nverify = false\nflank_points = 100\npositions = 40\n"
            );
            let given = SceneText { name: "stage".to_owned(), text };
            let scene = PlanetaryScene::from_text(given, Path::new("")).unwrap();
            let record = planetary_run::run(&scene, &Unwatched).unwrap().record;
            let drawing = draw(&record).unwrap();
            for (number, planet) in drawing.planets.iter().enumerate() {
                let points = || planet.iter().step_by(5);
                let in_sun = points().map(|&point| depth(&drawing.sun, point)).fold(f64::NEG_INFINITY, f64::max);
                let out_of_ring = points().map(|&point| -depth(&drawing.ring, point)).fold(f64::NEG_INFINITY, f64::max);
                for (mate, overlap) in [("sun", in_sun), ("ring", out_of_ring)] {
                    assert!((-0.05..0.02).contains(&overlap), "planet {number} and {mate}: overlap {overlap} mm");
                }
            }
        }
    }
}
