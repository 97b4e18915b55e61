//! Checks of curves that stand in the scene file as two arrays, of places and of values.

use crate::scene::findings::Findings;
use crate::scene::problem::number;

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
