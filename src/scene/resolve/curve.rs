//! Checks of curves that stand in the scene file as two arrays, of places and of values.

use crate::scene::findings::Findings;
use crate::scene::problem::number;
use gearwear_physics::thermal::tooth::TemperatureCurve;

/// A curve as the file has it: the key of each array, and the array.
type Array<'a> = (&'a str, &'a Option<Vec<f64>>);

/// Both arrays, of the same length of two or more, the places rising; none with a finding otherwise.
pub(super) fn choose(places: Array<'_>, values: Array<'_>, findings: &mut Findings) -> Option<[Vec<f64>; 2]> {
    for (key, given) in [places, values] {
        match given {
            None => {
                findings.missing(&[key], "numbers in square brackets, two or more");
                return None;
            }
            Some(given) if given.len() < 2 => {
                findings.not_allowed(key, format!("{} of them", given.len()), "two numbers or more");
                return None;
            }
            Some(_) => {}
        }
    }
    let ((place_key, at), (value_key, of)) = ((places.0, places.1.as_ref()?), (values.0, values.1.as_ref()?));
    if at.len() != of.len() {
        findings.not_allowed(
            value_key,
            format!("{} of them", of.len()),
            format!("as many as {place_key}, {}", at.len()),
        );
        return None;
    }
    if let Some(index) = (1..at.len()).find(|&index| at[index] <= at[index - 1]) {
        findings.not_allowed(
            &format!("{place_key}[{index}]"),
            number(at[index]),
            format!("greater than {} before it", number(at[index - 1])),
        );
        return None;
    }
    Some([at.clone(), of.clone()])
}

/// The curve in the table `key` of what its array `name` holds over the temperature of the teeth, which the scene must give.
pub(super) fn tooth_curve(
    key: &str,
    temperature_c: &Option<Vec<f64>>,
    (name, values): (&str, &Option<Vec<f64>>),
    has_tooth_temperature: bool,
    findings: &mut Findings,
) -> Option<TemperatureCurve> {
    let [places, name] = ["temperature_C", name].map(|name| format!("{key}.{name}"));
    let [temperature_c, value] = choose((&places, temperature_c), (&name, values), findings)?;
    if !has_tooth_temperature {
        findings.missing(&["temperature.tooth.ambient_temperature_C"], "a number from -60 to 250");
        findings.help(format!("{key} follows the temperature of the teeth and needs the table [temperature.tooth]"));
        return None;
    }
    Some(TemperatureCurve { temperature_c, value })
}
