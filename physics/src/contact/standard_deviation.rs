//! Standard deviation of the pressure along a contact, from which the heated strip takes its half-width.
//!
//! The extent of a contact jumps where worn flanks come to touch in another place, however light the load there, and so would temperatures and all wear
//! that reads them; the standard deviation σ of the pressure does not. Hertz's ellipse has the half-width 2 σ.
//!
//! Pressure is even within each cell. Of a smooth pressure that falls to nothing at its ends this is too much by w²/6, w the width of the cells: 0.13 % of the
//! half-width with 16 cells in it. A single cell has a width too.

use super::PressedCell;

/// Half-width of Hertz's ellipse over its standard deviation.
pub(crate) const HALF_WIDTH_OF_ELLIPSE: f64 = 2.0;

/// Standard deviation of the places of the load, mm; 0 without load.
pub(crate) fn standard_deviation_mm(cells: impl Iterator<Item = PressedCell>) -> f64 {
    let (mut sum, mut first, mut second, mut within) = (0.0, 0.0, 0.0, 0.0);
    for cell in cells {
        let (load, centre_mm) = (cell.line_load_n_per_mm(), cell.lower_mm.midpoint(cell.upper_mm));
        let width_mm = cell.upper_mm - cell.lower_mm;
        sum += load;
        first += load * centre_mm;
        second += load * centre_mm * centre_mm;
        within += load * width_mm * width_mm / 12.0;
    }
    if sum <= 0.0 {
        return 0.0;
    }
    let (mean, within) = (first / sum, within / sum);
    (second / sum - mean * mean).max(0.0).sqrt().hypot(within.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cells of a strip from −1 to 1, with the loads of a pressure by its integral.
    fn deviation(cells: i32, load_below: impl Fn(f64) -> f64) -> f64 {
        let width_mm = 2.0 / f64::from(cells);
        standard_deviation_mm((0..cells).map(|k| {
            let lower_mm = -1.0 + f64::from(k) * width_mm;
            let load = load_below(lower_mm + width_mm) - load_below(lower_mm);
            PressedCell { lower_mm, upper_mm: lower_mm + width_mm, pressure_mpa: load / width_mm }
        }))
    }

    /// Ellipse and parabola, of which the latter has a standard deviation of 1/√5 of its half-width, have it to 0.2 % with 32 cells, even pressure has 1/√3.
    #[test]
    fn ver_half_widths_of_ellipse_and_parabola() {
        let ellipse = deviation(32, |x| 0.5 * (x * (1.0 - x * x).max(0.0).sqrt() + x.clamp(-1.0, 1.0).asin()));
        assert!((HALF_WIDTH_OF_ELLIPSE * ellipse - 1.0).abs() < 2e-3, "{ellipse}");
        let parabola = deviation(32, |x| x - x.powi(3) / 3.0);
        assert!((5f64.sqrt() * parabola - 1.0).abs() < 2e-3, "{parabola}");
        for cells in [1, 2, 7] {
            let even = deviation(cells, |x| x);
            assert!((3f64.sqrt() * even - 1.0).abs() < 1e-12, "{cells}: {even}");
        }
    }

    /// A second place that comes to carry load moves the half-width by little, wherever it is.
    #[test]
    fn ver_half_widths_do_not_jump_where_flanks_come_to_touch() {
        let with_load = |load: f64| {
            let cell =
                |lower_mm: f64, pressure_mpa: f64| PressedCell { lower_mm, upper_mm: lower_mm + 0.1, pressure_mpa };
            standard_deviation_mm([cell(0.0, 1.0), cell(0.1, 1.0), cell(5.0, load)].into_iter())
        };
        assert!((with_load(1e-9) / with_load(0.0) - 1.0).abs() < 1e-5);
        assert_eq!(standard_deviation_mm(std::iter::empty()), 0.0);
    }
}
