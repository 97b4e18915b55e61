//! Form removal: the residual of a profile after its form is fitted by least squares.
//!
//! All forms are linear in a few functions of the place x along the flank, so that removing them is a projection: with Q the
//! orthonormal columns of these functions at the points,
//!
//! ```text
//! P z = z − Q Qᵀ z
//! ```
//!
//! | form | functions |
//! |---|---|
//! | cubic | 1, x, x², x³ of the length along the flank: the thesis's form of a trace (section 4.2) |
//! | involute | 1, x beside the nominal involute, whose sag and modifications are known: of the roll length, an offset and a line as the slope deviation f_Hα has it; of the length along the flank, offset and tilt of a stylus's line |
//! | none | none: heights and zero are true |
//!
//! The columns are Legendre's polynomials on the length of the profile, orthonormalised twice: well conditioned for any number of
//! points.

use gearwear::measured_flank::file::HeightFrom;
use gearwear::measured_flank::profile::MeasuredProfile;
use gearwear_bodies::gear::GearPair;

use super::fit::dot;

/// Length of a column, less what others have of it, below which it is one of them.
const IN_OTHERS: f64 = 1e-6;

/// Form of a profile: the values of `--form`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub enum Form {
    /// A least-squares polynomial of third order.
    Cubic,
    /// The nominal flank, with an offset and a line in roll length by least squares.
    Involute,
    /// Nothing.
    None,
}

impl Form {
    /// Name on the command line and in reports.
    pub fn name(self) -> &'static str {
        match self {
            Form::Cubic => "cubic",
            Form::Involute => "involute",
            Form::None => "none",
        }
    }

    /// Number of functions that are fitted.
    pub fn parameters(self) -> usize {
        match self {
            Form::Cubic => 4,
            Form::Involute => 2,
            Form::None => 0,
        }
    }

    /// Where the form of `profile` is even: lengths along the flank for heights from a line, roll lengths for those from the involute.
    pub fn places_mm(self, profile: &MeasuredProfile, pair: &GearPair) -> Vec<f64> {
        let [arc_mm, roll_mm] = profile.places_mm(pair);
        let is_in_roll = self == Form::Involute && profile.height_from == HeightFrom::Involute;
        if is_in_roll { roll_mm } else { arc_mm }
    }
}

/// The projection that removes a form from profiles at given points.
#[derive(Debug, Clone, PartialEq)]
pub struct FormRemoval {
    /// Orthonormal.
    columns: Vec<Vec<f64>>,
}

impl FormRemoval {
    /// Removal of `form` at points with these places, more of them than the form has parameters.
    pub fn new(form: Form, place_mm: &[f64]) -> Self {
        let (first, last) = match (place_mm.first(), place_mm.last()) {
            (Some(&first), Some(&last)) => (first, last),
            _ => (0.0, 0.0),
        };
        let (middle, half) = (0.5 * (first + last), (0.5 * (last - first)).max(f64::MIN_POSITIVE));
        let mut columns: Vec<Vec<f64>> = Vec::new();
        for degree in 0..form.parameters() {
            let mut column: Vec<f64> = place_mm.iter().map(|place| legendre(degree, (place - middle) / half)).collect();
            for _ in 0..2 {
                for other in &columns {
                    take_out(other, &mut column);
                }
            }
            let norm = dot(&column, &column).sqrt();
            column.iter_mut().for_each(|value| *value /= norm);
            columns.push(column);
        }
        Self { columns }
    }

    /// Removal of the part of `values` that is made of some columns too, beside what is removed already.
    pub fn and(mut self, columns: impl IntoIterator<Item = Vec<f64>>) -> Self {
        for mut column in columns {
            let length = dot(&column, &column).sqrt();
            for _ in 0..2 {
                self.remove(&mut column);
            }
            let rest = dot(&column, &column).sqrt();
            if rest > IN_OTHERS * length {
                column.iter_mut().for_each(|value| *value /= rest);
                self.columns.push(column);
            }
        }
        self
    }

    /// The orthonormal columns.
    pub fn columns(&self) -> &[Vec<f64>] {
        &self.columns
    }

    /// Takes the form away from `values` at the points.
    pub fn remove(&self, values: &mut [f64]) {
        for column in &self.columns {
            take_out(column, values);
        }
    }
}

/// Takes the part along the unit vector `column` out of `values`.
fn take_out(column: &[f64], values: &mut [f64]) {
    let part = dot(column, values);
    values.iter_mut().zip(column).for_each(|(value, c)| *value -= part * c);
}

/// Legendre's polynomial of degree 0 to 3.
fn legendre(degree: usize, x: f64) -> f64 {
    match degree {
        0 => 1.0,
        1 => x,
        2 => 0.5 * (3.0 * x * x - 1.0),
        _ => 0.5 * x * (5.0 * x * x - 3.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places() -> Vec<f64> {
        // Unevenly spaced, as a trace given by radius is.
        (0..200).map(|i| 0.3 + 8.0 * (i as f64 / 199.0).powi(2)).collect()
    }

    /// A cubic leaves nothing of a cubic, and removing twice is removing once.
    #[test]
    fn ver_removal_is_a_projection_that_takes_the_whole_cubic() {
        let arc = places();
        let removal = FormRemoval::new(Form::Cubic, &arc);
        let mut cubic: Vec<f64> = arc.iter().map(|s| 12.0 - 3.0 * s + 0.7 * s * s - 0.05 * s.powi(3)).collect();
        removal.remove(&mut cubic);
        assert!(cubic.iter().all(|z| z.abs() < 1e-12));
        let mut once: Vec<f64> = arc.iter().map(|s| (3.0 * s).sin()).collect();
        removal.remove(&mut once);
        let mut twice = once.clone();
        removal.remove(&mut twice);
        assert!(once.iter().zip(&twice).all(|(a, b)| (a - b).abs() < 1e-14));
        assert!(once.iter().any(|z| z.abs() > 0.5));
    }

    /// The residual is orthogonal to every function of the form: the normal equations of least squares.
    #[test]
    fn ver_what_is_left_satisfies_the_normal_equations() {
        let arc = places();
        for form in [Form::Cubic, Form::Involute, Form::None] {
            let mut left: Vec<f64> = arc.iter().map(|s| (s - 2.0).exp().ln_1p()).collect();
            FormRemoval::new(form, &arc).remove(&mut left);
            for power in 0..form.parameters() as i32 {
                let moment: f64 = left.iter().zip(&arc).map(|(z, s)| z * s.powi(power)).sum();
                let scale: f64 = arc.iter().map(|s| s.powi(power)).sum();
                assert!(moment.abs() < 1e-11 * scale, "{form:?} {power}: {moment}");
            }
        }
    }
}
