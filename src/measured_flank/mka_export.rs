//! Writes a profile as the text export `.mka` of a gear measuring machine, which [`super::mka`] reads: the lines of the gear that reading needs,
//! and one curve with values even in roll length.

use gearwear_bodies::gear::involute::Involute;
use gearwear_bodies::gear::{Gear, GearPair};

use super::mka::{FACE_WIDTH, HELIX_ANGLE, MODULE, PRESSURE_ANGLE, PROFILE_ENDS, TEETH};

/// Fewest values of a curve, as many as machines write.
const FEWEST_VALUES: usize = 480;
/// Values in a line.
const PER_LINE: usize = 12;

/// Text of the export of `height_um` at the rising roll lengths `rho_mm`, two at least, of `gear` at the place `width_mm`.
pub fn text(pair: &GearPair, gear: Gear, width_mm: f64, rho_mm: &[f64], height_um: &[f64]) -> String {
    let spec = &pair.spec;
    let involute = &pair.teeth[gear].involute;
    let (first, last) = (rho_mm[0], rho_mm[rho_mm.len() - 1]);
    let [from, to] = [first, last].map(|rho| diameter_mm(involute, rho));
    let mut text = "HEADER KS.MK.FILE\nVERSION 5.0\nSEPARATOR :\nUNITS MM\nUNDEFINED -2147483.648\n".to_owned();
    for (code, label, value) in [
        (MODULE, "Normalmodul mn..[mm]", spec.normal_module_mm),
        (TEETH, "Zähnezahl z.........", f64::from(spec.gears[gear].teeth)),
        (HELIX_ANGLE, "Schrägungswinkel....", spec.helix_angle_rad.to_degrees()),
        (PRESSURE_ANGLE, "Eingriffswinkel.....", spec.normal_pressure_angle_rad.to_degrees()),
        (FACE_WIDTH, "Zahnbreite.[mm].....", spec.face_width_mm),
        (PROFILE_ENDS[0], "Start Messbereich.da", from),
        (PROFILE_ENDS[1], "Ende Messbereich..de", to),
    ] {
        text.push_str(&format!("{code:4} :{label}: {value}\n"));
    }
    let count = rho_mm.len().max(FEWEST_VALUES);
    text.push_str(&format!("Profil:\nZahn-Nr.: 1 links / {count}  Werte  z= {width_mm}\n"));
    let places = (0..count).map(|index| first + (last - first) * index as f64 / (count - 1) as f64);
    let values: Vec<String> =
        places.map(|place| format!(" {:.6}", interpolated(rho_mm, height_um, place) + 0.0)).collect();
    values.chunks(PER_LINE).for_each(|line| text.push_str(&format!("{}\n", line.concat())));
    text
}

/// Diameter at a roll length.
fn diameter_mm(involute: &Involute, rho_mm: f64) -> f64 {
    2.0 * involute.base_radius_mm.hypot(rho_mm)
}

/// Value at `place` on the straight lines between the points.
fn interpolated(places: &[f64], values: &[f64], place: f64) -> f64 {
    let after = places.partition_point(|&other| other <= place).clamp(1, places.len() - 1);
    let part = (place - places[after - 1]) / (places[after] - places[after - 1]);
    values[after - 1] + part.clamp(0.0, 1.0) * (values[after] - values[after - 1])
}
