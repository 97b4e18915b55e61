//! Profiles in expressions: what is read off a worn or a measured flank beside the figures of any column.
//!
//! | expression | meaning |
//! |---|---|
//! | `form_removed(x, y)` | y less its least-squares polynomial of third order in x, as `gearwear compare --form cubic` takes it away |
//! | `mean_deviation(x, y)` | mean of the distance of y from its mean over the length: Pa of one trace, Sa of an area |
//! | `separate_peaks(x, y, share)` | y at its separate peaks, 0 elsewhere |
//!
//! A peak is separate where the profile falls by `share` of its height on both sides before it rises above the peak.

use super::value::{ColumnError, Value, same_length};
use gearwear_bodies::reference::separate_peaks::separate_peaks;
use gearwear_studies::measurement::form::{Form, FormRemoval};
use gearwear_studies::measurement::roughness;

/// Value of a function of profiles; none where there is no such function of these.
pub fn call(name: &str, arguments: &[Value]) -> Result<Option<Value>, ColumnError> {
    use Value::{Column, Number};
    Ok(Some(match (name, arguments) {
        ("form_removed", [Column(x), Column(y)]) => Value::column(form_removed(x, y)?),
        ("mean_deviation", [Column(x), Column(y)]) => {
            rising(x, y)?;
            Number(roughness::mean_deviation(x, y))
        }
        ("separate_peaks", [Column(x), Column(y), Number(share)]) => {
            rising(x, y)?;
            Value::column(separate_peaks(y, *share))
        }
        _ => return Ok(None),
    }))
}

/// Refuses what is no profile over the rising places `x`.
fn rising(x: &[f64], y: &[f64]) -> Result<(), ColumnError> {
    same_length(x, y)?;
    if x.is_sorted_by(|a, b| a < b) { Ok(()) } else { Err(ColumnError::NotRising) }
}

fn form_removed(x: &[f64], y: &[f64]) -> Result<Vec<f64>, ColumnError> {
    rising(x, y)?;
    if x.len() <= Form::Cubic.parameters() {
        return Err(ColumnError::NoForm(x.len()));
    }
    let mut left = y.to_vec();
    FormRemoval::new(Form::Cubic, x).remove(&mut left);
    Ok(left)
}

#[cfg(test)]
mod tests {
    use crate::expression::Evaluator;
    use crate::value::Value;

    fn evaluator() -> Evaluator {
        let mut evaluator = Evaluator::default();
        let x: Vec<f64> = (0..401).map(|i| 0.01 * f64::from(i)).collect();
        evaluator.name("x", &Value::column(x.iter().copied()));
        evaluator.name("wave", &Value::column(x.iter().map(|&x| (10.0 * std::f64::consts::PI * x).sin())));
        evaluator.name("cubic", &Value::column(x.iter().map(|&x| 3.0 - x + 0.5 * x.powi(3))));
        evaluator.name("at", &Value::column([0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
        evaluator.name("depth", &Value::column([9.0, 5.0, 8.0, 7.5, 7.9, 3.0, 4.0]));
        evaluator
    }

    /// The mean of |sin| is 2/π; a cubic has no form left, and a short wave hardly loses any.
    #[test]
    fn ver_form_and_mean_deviation() {
        let e = evaluator();
        for (expression, expected, allowed) in [
            ("max(abs(form_removed(x, cubic)))", 0.0, 1e-12),
            ("mean_deviation(x, wave)", 2.0 / std::f64::consts::PI, 2e-2),
            ("mean_deviation(x, form_removed(x, wave + cubic))", 2.0 / std::f64::consts::PI, 2e-2),
        ] {
            let found = e.number(expression).unwrap();
            assert!((found - expected).abs() <= allowed, "{expression}: {found}");
        }
    }

    /// Of 9, 5, 8, 7.5, 7.9, 3, 4 the 8 alone falls by a tenth on both sides; ends are no peaks, and 7.9 is a shoulder of 8.
    #[test]
    fn ver_separate_peaks() {
        let e = evaluator();
        assert_eq!(e.column("separate_peaks(at, depth, 0.1)").unwrap(), [0.0, 0.0, 8.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(e.column("separate_peaks(at, depth, 0.05)").unwrap(), [0.0, 0.0, 8.0, 0.0, 7.9, 0.0, 0.0]);
    }

    #[test]
    fn what_is_no_profile_is_refused() {
        let e = evaluator();
        for (expression, said) in [
            ("form_removed(at - at, depth)", "must rise"),
            ("form_removed(column([0.0, 1.0, 2.0, 3.0]), column([0.0, 1.0, 2.0, 3.0]))", "no cubic form"),
            ("separate_peaks(x, depth, 0.1)", "401 and 7"),
        ] {
            let message = e.column(expression).unwrap_err().to_string();
            assert!(message.contains(said), "{message}");
        }
    }
}
