//! Wear where flanks end, in whole runs.

use super::common::loaded;

/// Where the corner of an undercut pinion carries the load, before A, it stands under the pressure, which its mate slides past: what it loses is the same whatever
/// the distance of the positions. Were it to roll through each pressure, it would lose 7.67 to 7.96 µm with 100 to 400 of them.
#[test]
fn ver_the_corner_of_undercut_stands_under_its_load() {
    let corner_um = |positions: u32| {
        let text = format!(
            "[pair]\nnormal_module_mm = 6.81\npressure_angle_deg = 20.0\ncentre_distance_mm = 152.02\nface_width_mm = 40.0\n\
             [pair.pinion]\nteeth = 11\nprofile_shift = -0.06334\ntip_rounding_mm = 0.2\n\
             [pair.wheel]\nteeth = 34\nprofile_shift = -0.1643\ntip_rounding_mm = 0.2\n\
             [operation]\npinion_torque_Nm = 300.0\npinion_speed_rpm = 100.0\nhours = 50.0\n\
             [contact]\nsurface = \"half-space\"\n[wear]\nlaw = \"archard\"\ncoefficient_m2_per_N = 2e-17\n\
             [numerics]\nflank_points = 400\npositions = {positions}\nstep = \"adaptive\"\nerror_estimate = false\nverify = false\n"
        );
        let scene = loaded(&gearwear::scene::Resolved::from_toml(&text).unwrap());
        let record = gearwear::run(&scene, &gearwear::Unwatched).unwrap().record;
        let (pinion, wear) = (&record.summary.pinion, &record.flanks.pinion);
        let corner_mm = record.summary.geometry.gears.pinion.root_form_diameter_mm / 2.0;
        let first = wear.radius_mm.partition_point(|radius| *radius < corner_mm - 1e-6);
        assert_eq!(pinion.peak_wear_um, wear.wear_um[first], "{corner_mm}");
        pinion.peak_wear_um
    };
    let all_um = [100, 200, 400].map(corner_um);
    let [least, most] = [f64::min, f64::max].map(|of| all_um.into_iter().reduce(of).unwrap());
    println!("{all_um:?} µm");
    assert!(least > 7.0 && most / least < 1.001, "{all_um:?}");
}
