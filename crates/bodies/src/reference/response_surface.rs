//! Response surface: a polynomial in several variables, fitted by least squares to values at given points, with the error it would have at each of them
//! without it.
//!
//! Its terms φ are all products of Legendre polynomials up to a total degree, of variables that the points extend from −1 to 1. With the matrix Φ = Q R of the
//! rows φ(xᵢ)ᵀ, what is read off it is a sum over the values y at the points,
//!
//! ```text
//! ŷ(x) = w(x)ᵀ y          w(x) = Q R⁻ᵀ φ(x)          h(x) = |w(x)|² = |R⁻ᵀ φ(x)|²
//! ```
//!
//! The leverage h(x) says how much of the scatter of y comes through: 1 where all of it does, more outside the points. A fit without the points of a group g
//! would miss their values by e, and have the leverage h there:
//!
//! ```text
//! e = (I − H_gg)⁻¹ (y − ŷ)_g          h = diag[(I − H_gg)⁻¹ H_gg]          H = Q Qᵀ
//! ```
//!
//! Source: R. H. Myers, D. C. Montgomery and C. M. Anderson-Cook, *Response Surface Methodology*, 4th ed., Wiley 2016, chapter 2; R. D. Cook and S. Weisberg,
//! *Residuals and Influence in Regression*, Chapman and Hall 1982, section 2.2, for one point; for several the same follows from Woodbury's formula.

use nalgebra::{DMatrix, DVector};

use super::statistics::extent;

/// Least ratio of the numbers on the diagonal of R: below it the points do not tell all terms apart.
const RANK: f64 = 1e-10;

/// A response surface; the values at its points are left to whoever reads it.
#[derive(Debug, Clone)]
pub struct ResponseSurface {
    /// Least and greatest value of each variable.
    extents: Vec<[f64; 2]>,
    /// Degree of each variable in each term.
    terms: Vec<Vec<usize>>,
    q: DMatrix<f64>,
    /// Rᵀ.
    lower: DMatrix<f64>,
}

/// Points of a surface, each found without its group.
#[derive(Debug, Clone, PartialEq)]
pub struct LeftOut {
    /// Values less those found, by point and column.
    pub errors: DMatrix<f64>,
    /// Leverage of each point.
    pub leverage: Vec<f64>,
}

impl ResponseSurface {
    /// Surface of a total `degree` over `points`, each of as many variables; `None` where they do not tell all terms apart.
    pub fn new(points: &[Vec<f64>], degree: usize) -> Option<Self> {
        let variables = points.first()?.len();
        let extents: Vec<[f64; 2]> =
            (0..variables).map(|variable| extent(points.iter().map(|point| point[variable]))).collect();
        let terms = terms(variables, degree);
        if terms.len() > points.len() {
            return None;
        }
        let rows: Vec<DVector<f64>> = points.iter().map(|point| terms_at(point, &extents, &terms)).collect();
        let (q, r) = DMatrix::from_fn(points.len(), terms.len(), |row, term| rows[row][term]).qr().unpack();
        let diagonal = r.diagonal().map(f64::abs);
        (diagonal.min() > RANK * diagonal.max()).then(|| Self { extents, terms, q, lower: r.transpose() })
    }

    /// Total degree.
    pub fn degree(&self) -> usize {
        total_degree(&self.terms)
    }

    /// Number of terms.
    pub fn terms(&self) -> usize {
        self.terms.len()
    }

    /// R⁻ᵀ φ(x); `None` where that is no number.
    fn scaled(&self, place: &[f64]) -> Option<DVector<f64>> {
        let scaled = self.lower.solve_lower_triangular(&terms_at(place, &self.extents, &self.terms))?;
        scaled.iter().all(|value| value.is_finite()).then_some(scaled)
    }

    /// Leverage at a place.
    pub fn leverage(&self, place: &[f64]) -> f64 {
        self.scaled(place).map_or(f64::INFINITY, |scaled| scaled.norm_squared())
    }

    /// ŷ at a place, of each column of `values` by point and column; `None` where it is no number.
    pub fn at(&self, place: &[f64], values: &DMatrix<f64>) -> Option<Vec<f64>> {
        let weights = &self.q * self.scaled(place)?;
        Some(values.tr_mul(&weights).as_slice().to_vec())
    }

    /// All points, each found without the points of its group; `values` by point and column. `None` where the others do not tell all terms apart.
    pub fn left_out(&self, groups: &[Vec<usize>], values: &DMatrix<f64>) -> Option<LeftOut> {
        let residual = values - &self.q * self.q.tr_mul(values);
        let mut errors = DMatrix::zeros(values.nrows(), values.ncols());
        let mut leverage = vec![0.0; values.nrows()];
        for group in groups {
            let own = self.q.select_rows(group);
            let hat = &own * own.transpose();
            let inverse = (DMatrix::identity(group.len(), group.len()) - &hat).try_inverse()?;
            let without = &inverse * residual.select_rows(group);
            let leverage_without = (&inverse * hat).diagonal();
            for (row, &point) in group.iter().enumerate() {
                errors.set_row(point, &without.row(row));
                leverage[point] = leverage_without[row];
            }
        }
        Some(LeftOut { errors, leverage })
    }
}

/// Degrees of so many `variables` whose sum is at most `degree`, by that sum.
fn terms(variables: usize, degree: usize) -> Vec<Vec<usize>> {
    let mut terms = vec![Vec::new()];
    for _ in 0..variables {
        let longer = terms.iter().flat_map(|term| {
            let left = degree - term.iter().sum::<usize>();
            (0..=left).map(|own| term.iter().copied().chain([own]).collect())
        });
        terms = longer.collect();
    }
    terms.sort_by_key(|term| term.iter().sum::<usize>());
    terms
}

/// Greatest sum of degrees, which is that of the last term.
fn total_degree(terms: &[Vec<usize>]) -> usize {
    terms.last().map_or(0, |term| term.iter().sum())
}

/// φ(x).
fn terms_at(place: &[f64], extents: &[[f64; 2]], terms: &[Vec<usize>]) -> DVector<f64> {
    let degree = total_degree(terms);
    let of_variables = place.iter().zip(extents).map(|(&value, [low, high])| {
        let half = 0.5 * (high - low);
        // A variable that does not vary has no terms of its own: the points do not tell them apart.
        let x = if half > 0.0 { (value - low) / half - 1.0 } else { 0.0 };
        legendre(x, degree)
    });
    let of_variables: Vec<Vec<f64>> = of_variables.collect();
    let product = |term: &Vec<usize>| term.iter().zip(&of_variables).map(|(&own, values)| values[own]).product();
    DVector::from_iterator(terms.len(), terms.iter().map(product))
}

/// Legendre polynomials up to a degree.
fn legendre(x: f64, degree: usize) -> Vec<f64> {
    let mut values = vec![1.0, x];
    for n in 1..degree {
        let n_th = n as f64;
        values.push(((2.0 * n_th + 1.0) * x * values[n] - n_th * values[n - 1]) / (n_th + 1.0));
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a square, at random.
    fn points(count: usize) -> Vec<Vec<f64>> {
        let mut random = fastrand::Rng::with_seed(3);
        (0..count).map(|_| vec![5.0 + random.f64(), -2.0 + 3.0 * random.f64()]).collect()
    }

    fn read(surface: &ResponseSurface, values: &[f64], place: &[f64]) -> f64 {
        surface.at(place, &DMatrix::from_column_slice(values.len(), 1, values)).unwrap()[0]
    }

    /// Polynomials of its degree are found everywhere, also beyond the points, and without any of these.
    #[test]
    fn ver_polynomials_of_its_degree_are_found() {
        let cubic = |place: &[f64]| 2.0 + place[0] * place[1] * place[1] - 0.5 * place[0].powi(3) + place[1];
        let points = points(24);
        let values: Vec<f64> = points.iter().map(|point| cubic(point)).collect();
        let surface = ResponseSurface::new(&points, 3).unwrap();
        assert_eq!(surface.terms(), 10);
        for place in [[5.5, 0.0], [7.0, 3.0], [4.0, -4.0]] {
            assert!((read(&surface, &values, &place) / cubic(&place) - 1.0).abs() < 1e-9, "{place:?}");
        }
        let groups: Vec<Vec<usize>> = (0..12).map(|first| vec![first, first + 12]).collect();
        let left_out = surface.left_out(&groups, &DMatrix::from_column_slice(24, 1, &values)).unwrap();
        assert!(left_out.errors.amax() < 1e-9, "{}", left_out.errors);
    }

    /// Of another function a fit without the points of a group misses them by what is said, with the leverage that is said.
    #[test]
    fn ver_points_left_out_are_missed_as_without_them() {
        let wave = |point: &Vec<f64>| (2.0 * point[0]).sin() * (0.5 * point[1]).exp();
        let points = points(30);
        let columns = [points.iter().map(wave).collect::<Vec<f64>>(), points.iter().map(|p| p[0].sqrt()).collect()];
        let groups: Vec<Vec<usize>> = (0..10).map(|first| vec![first, first + 10, first + 20]).collect();
        let surface = ResponseSurface::new(&points, 2).unwrap();
        let left_out = surface.left_out(&groups, &DMatrix::from_columns(&columns.clone().map(DVector::from))).unwrap();
        for group in &groups {
            let others: Vec<usize> = (0..points.len()).filter(|point| !group.contains(point)).collect();
            let without =
                ResponseSurface::new(&others.iter().map(|&at| points[at].clone()).collect::<Vec<_>>(), 2).unwrap();
            for &point in group {
                for (number, column) in columns.iter().enumerate() {
                    let values: Vec<f64> = others.iter().map(|&at| column[at]).collect();
                    let error = column[point] - read(&without, &values, &points[point]);
                    assert!((left_out.errors[(point, number)] - error).abs() < 1e-9, "{point}: {error}");
                }
                let leverage = without.leverage(&points[point]);
                assert!((left_out.leverage[point] / leverage - 1.0).abs() < 1e-9, "{point}: {leverage}");
            }
        }
    }

    /// The leverage at the points adds up to the number of terms, and is great outside them.
    #[test]
    fn ver_leverage() {
        let points = points(40);
        let surface = ResponseSurface::new(&points, 4).unwrap();
        let sum: f64 = points.iter().map(|point| surface.leverage(point)).sum();
        assert!((sum - surface.terms() as f64).abs() < 1e-9, "{sum}");
        assert!(surface.leverage(&[5.5, -0.5]) < 1.0 && surface.leverage(&[9.0, 7.0]) > 100.0);
    }

    /// Points on a line do not tell two variables apart, nor do fewer points than terms.
    #[test]
    fn ver_points_that_do_not_tell_all_terms_have_no_surface() {
        let on_a_line: Vec<Vec<f64>> = (0..20).map(|i| vec![f64::from(i), 2.0 * f64::from(i)]).collect();
        assert!(ResponseSurface::new(&on_a_line, 1).is_none());
        let fixed: Vec<Vec<f64>> = (0..20).map(|i| vec![f64::from(i), 2.0]).collect();
        assert!(ResponseSurface::new(&fixed, 1).is_none());
        assert!(ResponseSurface::new(&points(9), 3).is_none());
        assert!(ResponseSurface::new(&[], 0).is_none());
    }
}
