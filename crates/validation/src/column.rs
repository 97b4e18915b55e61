//! Columns of numbers in expressions: arithmetic point by point, and the figures one reads off a curve.
//!
//! | expression | meaning |
//! |---|---|
//! | `x + y`, `2 * x`, `-x`, `x ** 2`, `x % 1` | point by point; of two numbers likewise |
//! | `abs(x)`, `sqrt(x)`, `exp(x)`, `ln(x)`, `log(x)`, `sin(x)`, `cos(x)`, `tan(x)`, `asin(x)`, `acos(x)`, `atan(x)`, `sinh(x)`, `cosh(x)`, `tanh(x)`, `floor(x)`, `ceiling(x)`, `round(x)` | the same; `log` is to base 10, angles are in radians |
//! | `PI()`, `E()`, `max(a, b)`, `min(a, b)`, `is_nan(a)`, `is_finite(a)` | of numbers |
//! | `a == b`, `a != b`, `a < b`, `a <= b`, `a > b`, `a >= b`, `text.contains(part)` | truths; the first two also of texts and truths, the last also of a list of texts: whether any does |
//! | `x[3]`, `x.len`, `first(x)`, `last(x)` | points of a column; `len` and an index also of a list or a text |
//! | `max(x)`, `min(x)`, `mean(x)`, `sum(x)`, `rms(x)`, `quantile(x, q)` | figures of a column |
//! | `at(x, y, x0)`, `resample(x, y, places)` | y at x0 (at places), linear between the points |
//! | `place_of_max(x, y)`, `place_of_min(x, y)` | the x where y is greatest, least |
//! | `crossing(x, y, level)` | the first x where y passes the level, linear between the points |
//! | `part(x, y, low, high)` | those y whose x lies from low to high |
//! | `differences(x)`, `integral(x, y)` | of neighbours; trapezia |
//! | `is_rising(x)`, `is_falling(x)` | every point beyond the one before |
//! | `local_maxima(y)` | how many inner points are above both neighbours |
//! | `count_above(x, level)`, `count_below(x, level)` | how many points |
//! | `relative_l2(y, reference)`, `relative_max(y, reference)` | ‖y − r‖ / ‖r‖ in the 2-norm, in the greatest value; the first also of two lists of columns, a number for each |
//! | `relative_l2(x, y, reference)` | √(∫ (y − r)² dx / ∫ r² dx), whatever the distances of the places x; also of three lists of columns |
//! | `order(h, error)` | slope of log error over log h, least squares |
//! | `share_within(claim, truth, above, low, high)` | of those whose truth is above a level, the share whose claim/truth lies from low to high |
//! | `column([a, b, …])` | a column of these |

use std::f64::consts;
use std::sync::Arc;

use super::profile;
use super::value::{ColumnError, Value, same_length};
use gearwear_bodies::reference::statistics;

fn map(x: &[f64], f: impl Fn(f64) -> f64) -> Arc<[f64]> {
    x.iter().map(|&x| f(x)).collect()
}

fn zip(x: &[f64], y: &[f64], f: impl Fn(f64, f64) -> f64) -> Result<Arc<[f64]>, ColumnError> {
    same_length(x, y)?;
    Ok(x.iter().zip(y).map(|(&x, &y)| f(x, y)).collect())
}

fn not_empty(x: &[f64]) -> Result<&[f64], ColumnError> {
    if x.is_empty() { Err(ColumnError::Empty) } else { Ok(x) }
}

/// Reduction of a column by `f`; NaN where any value is.
fn fold(x: &[f64], f: fn(f64, f64) -> f64) -> Result<f64, ColumnError> {
    let of_two = not_empty(x)?.iter().copied().reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { f(a, b) });
    Ok(of_two.unwrap_or(f64::NAN))
}

fn sum(x: &[f64]) -> f64 {
    x.iter().sum()
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// y at `place`, linear between the points of ascending or descending `x`.
fn at(x: &[f64], y: &[f64], place: f64) -> Result<f64, ColumnError> {
    same_length(x, y)?;
    let found = x.windows(2).zip(y.windows(2)).find_map(|(x, y)| {
        let (low, high) = (x[0].min(x[1]), x[0].max(x[1]));
        ((low..=high).contains(&place) && low < high).then(|| y[0] + (y[1] - y[0]) * (place - x[0]) / (x[1] - x[0]))
    });
    let [from, to] = [x.first(), x.last()].map(|end| end.copied().unwrap_or(f64::NAN));
    found.ok_or(ColumnError::Outside { place, from, to })
}

fn place_of(x: &[f64], y: &[f64], better: fn(&f64, &f64) -> bool) -> Result<f64, ColumnError> {
    same_length(x, y)?;
    let mut best: Option<(f64, f64)> = None;
    for (&x, &y) in x.iter().zip(y) {
        if best.is_none_or(|(_, so_far)| better(&y, &so_far)) {
            best = Some((x, y));
        }
    }
    best.map(|(x, _)| x).ok_or(ColumnError::Empty)
}

fn crossing(x: &[f64], y: &[f64], level: f64) -> Result<f64, ColumnError> {
    same_length(x, y)?;
    let found = x.windows(2).zip(y.windows(2)).find_map(|(x, y)| {
        let (before, after) = (y[0] - level, y[1] - level);
        (before * after <= 0.0 && before != after).then(|| x[0] + (x[1] - x[0]) * before / (before - after))
    });
    found.ok_or(ColumnError::NeverPasses(level))
}

fn part(x: &[f64], y: &[f64], low: f64, high: f64) -> Result<Arc<[f64]>, ColumnError> {
    same_length(x, y)?;
    Ok(x.iter().zip(y).filter(|(x, _)| (low..=high).contains(*x)).map(|(_, &y)| y).collect())
}

fn quantile(x: &[f64], share: f64) -> Result<f64, ColumnError> {
    let mut sorted = not_empty(x)?.to_vec();
    sorted.sort_by(f64::total_cmp);
    Ok(statistics::quantile(&sorted, share.clamp(0.0, 1.0)).unwrap_or(f64::NAN))
}

fn integral(x: &[f64], y: &[f64]) -> Result<f64, ColumnError> {
    same_length(x, y)?;
    Ok(x.windows(2).zip(y.windows(2)).map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1])).sum())
}

fn order(h: &[f64], error: &[f64]) -> Result<f64, ColumnError> {
    same_length(h, error)?;
    let (x, y) = (map(h, f64::ln), map(error, f64::ln));
    let n = x.len() as f64;
    let (x_mean, y_mean) = (sum(&x) / n, sum(&y) / n);
    let (x, y) = (map(&x, |x| x - x_mean), map(&y, |y| y - y_mean));
    Ok(sum(&zip(&x, &y, |x, y| x * y)?) / sum(&zip(&x, &x, |a, b| a * b)?))
}

fn relative_l2(y: &[f64], reference: &[f64]) -> Result<f64, ColumnError> {
    Ok(norm(&zip(y, reference, |y, r| y - r)?) / norm(reference))
}

/// Number for each pair of columns of two lists, such as one profile for each member of two families.
fn relative_l2_of_each(rows: &[Value], references: &[Value]) -> Result<Arc<[f64]>, ColumnError> {
    same_count(rows, references)?;
    rows.iter()
        .zip(references)
        .map(|both| match both {
            (Value::Column(row), Value::Column(reference)) => relative_l2(row, reference),
            // A member without results has no profile.
            _ => Ok(f64::NAN),
        })
        .collect()
}

fn same_count(rows: &[Value], others: &[Value]) -> Result<(), ColumnError> {
    let (one, other) = (rows.len(), others.len());
    if one == other { Ok(()) } else { Err(ColumnError::ListLengths(one, other)) }
}

fn relative_l2_over(x: &[f64], y: &[f64], reference: &[f64]) -> Result<f64, ColumnError> {
    let off = zip(y, reference, |y, r| (y - r).powi(2))?;
    Ok((integral(x, &off)? / integral(x, &map(reference, |r| r * r))?).sqrt())
}

/// Number for each three columns of three lists.
fn relative_l2_over_each(places: &[Value], rows: &[Value], references: &[Value]) -> Result<Arc<[f64]>, ColumnError> {
    same_count(places, rows)?;
    same_count(rows, references)?;
    places
        .iter()
        .zip(rows)
        .zip(references)
        .map(|three| match three {
            ((Value::Column(x), Value::Column(row)), Value::Column(reference)) => relative_l2_over(x, row, reference),
            _ => Ok(f64::NAN),
        })
        .collect()
}

fn relative_max(y: &[f64], reference: &[f64]) -> Result<f64, ColumnError> {
    let differences = zip(y, reference, |y, r| (y - r).abs())?;
    Ok(fold(&differences, f64::max)? / fold(&map(reference, f64::abs), f64::max)?)
}

/// Share of the claims within low to high times their truth, of those whose truth is above a level; 0 where none is.
fn share_within(claim: &[f64], truth: &[f64], above: f64, low: f64, high: f64) -> Result<f64, ColumnError> {
    same_length(claim, truth)?;
    let judged = claim.iter().zip(truth).filter(|(_, truth)| **truth > above);
    let (within, all) = judged.fold((0, 0), |(within, all), (claim, truth)| {
        (within + usize::from((low..=high).contains(&(claim / truth))), all + 1)
    });
    Ok(if all > 0 { within as f64 / all as f64 } else { 0.0 })
}

fn local_maxima(y: &[f64]) -> usize {
    y.windows(3).filter(|three| three[1] > three[0] && three[1] > three[2]).count()
}

fn column(items: &[Value]) -> Result<Arc<[f64]>, ColumnError> {
    items
        .iter()
        .map(|item| if let Value::Number(number) = item { Ok(*number) } else { Err(ColumnError::NotNumbers) })
        .collect()
}

fn count(x: &[f64], counted: impl Fn(f64) -> bool) -> Value {
    Value::Number(x.iter().filter(|&&x| counted(x)).count() as f64)
}

/// Function of a number, or of each point of a column.
fn point_by_point(name: &str) -> Option<fn(f64) -> f64> {
    Some(match name {
        "abs" => f64::abs,
        "sqrt" => f64::sqrt,
        "exp" => f64::exp,
        "ln" => f64::ln,
        "log" => f64::log10,
        "sin" => f64::sin,
        "cos" => f64::cos,
        "tan" => f64::tan,
        "asin" => f64::asin,
        "acos" => f64::acos,
        "atan" => f64::atan,
        "sinh" => f64::sinh,
        "cosh" => f64::cosh,
        "tanh" => f64::tanh,
        "floor" => f64::floor,
        "ceiling" => f64::ceil,
        "round" => f64::round,
        _ => return None,
    })
}

/// Number of points of a column, items of a list or characters of a text.
pub fn length(of: &Value) -> Option<Value> {
    let length = match of {
        Value::Column(x) => x.len(),
        Value::List(items) => items.len(),
        Value::Text(text) => text.chars().count(),
        _ => return None,
    };
    Some(Value::Number(length as f64))
}

/// `left` and `right` with an operator between them; none where there is no such operator.
pub fn operate(sign: &str, left: &Value, right: &Value) -> Result<Option<Value>, ColumnError> {
    use Value::{Column, Number, Text, Truth};
    let compared = match (sign, left, right) {
        ("==", Number(a), Number(b)) => Some(a == b),
        ("==", Truth(a), Truth(b)) => Some(a == b),
        ("==", Text(a), Text(b)) => Some(a == b),
        ("!=", Number(a), Number(b)) => Some(a != b),
        ("!=", Truth(a), Truth(b)) => Some(a != b),
        ("!=", Text(a), Text(b)) => Some(a != b),
        ("<", Number(a), Number(b)) => Some(a < b),
        ("<=", Number(a), Number(b)) => Some(a <= b),
        (">", Number(a), Number(b)) => Some(a > b),
        (">=", Number(a), Number(b)) => Some(a >= b),
        _ => None,
    };
    if let Some(truth) = compared {
        return Ok(Some(Truth(truth)));
    }
    let f: fn(f64, f64) -> f64 = match sign {
        "+" => |a, b| a + b,
        "-" => |a, b| a - b,
        "*" => |a, b| a * b,
        "/" => |a, b| a / b,
        "%" => |a, b| a % b,
        "**" => f64::powf,
        _ => return Ok(None),
    };
    Ok(Some(match (left, right) {
        (Number(a), Number(b)) => Number(f(*a, *b)),
        (Column(x), Column(y)) => Column(zip(x, y, f)?),
        (Column(x), Number(b)) => Column(map(x, |x| f(x, *b))),
        (Number(a), Column(y)) => Column(map(y, |y| f(*a, y))),
        _ => return Ok(None),
    }))
}

/// Value of a function; none where there is no such function of these.
pub fn call(name: &str, arguments: &[Value]) -> Result<Option<Value>, ColumnError> {
    use Value::{Column, List, Number, Text, Truth};
    if let ([of], Some(f)) = (arguments, point_by_point(name)) {
        return Ok(match of {
            Number(a) => Some(Number(f(*a))),
            Column(x) => Some(Column(map(x, f))),
            _ => None,
        });
    }
    let found = match (name, arguments) {
        ("PI", []) => Number(consts::PI),
        ("E", []) => Number(consts::E),
        ("max", [Number(a), Number(b)]) => Number(if a >= b { *a } else { *b }),
        ("min", [Number(a), Number(b)]) => Number(if a <= b { *a } else { *b }),
        ("is_nan", [Number(a)]) => Truth(a.is_nan()),
        ("is_finite", [Number(a)]) => Truth(a.is_finite()),
        ("contains", [Text(text), Text(part)]) => Truth(text.contains(part.as_str())),
        ("contains", [List(items), Text(part)]) => {
            Truth(items.iter().any(|item| matches!(item, Text(text) if text.contains(part.as_str()))))
        }
        // A list without items.
        ("contains", [Column(x), Text(_)]) if x.is_empty() => Truth(false),
        ("len", [of]) => return Ok(length(of)),
        _ => match figure(name, arguments)? {
            None => return curve_function(name, arguments),
            found => return Ok(found),
        },
    };
    Ok(Some(found))
}

/// Value of a function of one column.
fn figure(name: &str, arguments: &[Value]) -> Result<Option<Value>, ColumnError> {
    use Value::{Column, List, Number, Truth};
    Ok(Some(match (name, arguments) {
        ("column", [List(items)]) => Column(column(items)?),
        ("column", [Column(x)]) => Column(x.clone()),
        ("first", [Column(x)]) => Number(not_empty(x)?[0]),
        ("last", [Column(x)]) => Number(not_empty(x)?[x.len() - 1]),
        ("max", [Column(x)]) => Number(fold(x, f64::max)?),
        ("min", [Column(x)]) => Number(fold(x, f64::min)?),
        ("sum", [Column(x)]) => Number(sum(x)),
        ("mean", [Column(x)]) => Number(sum(x) / not_empty(x)?.len() as f64),
        ("rms", [Column(x)]) => Number(norm(x) / (not_empty(x)?.len() as f64).sqrt()),
        ("quantile", [Column(x), Number(share)]) => Number(quantile(x, *share)?),
        ("differences", [Column(x)]) => Value::column(x.windows(2).map(|two| two[1] - two[0])),
        ("is_rising", [Column(x)]) => Truth(x.is_sorted_by(|a, b| a < b)),
        ("is_falling", [Column(x)]) => Truth(x.is_sorted_by(|a, b| a > b)),
        ("local_maxima", [Column(y)]) => Number(local_maxima(y) as f64),
        ("count_above", [Column(x), Number(level)]) => count(x, |x| x > *level),
        ("count_below", [Column(x), Number(level)]) => count(x, |x| x < *level),
        _ => return Ok(None),
    }))
}

/// Value of a function of several columns.
fn curve_function(name: &str, arguments: &[Value]) -> Result<Option<Value>, ColumnError> {
    use Value::{Column, List, Number};
    Ok(Some(match (name, arguments) {
        ("at", [Column(x), Column(y), Number(place)]) => Number(at(x, y, *place)?),
        ("resample", [Column(x), Column(y), Column(places)]) => {
            Column(places.iter().map(|&place| at(x, y, place)).collect::<Result<_, _>>()?)
        }
        ("place_of_max", [Column(x), Column(y)]) => Number(place_of(x, y, |a, b| a > b)?),
        ("place_of_min", [Column(x), Column(y)]) => Number(place_of(x, y, |a, b| a < b)?),
        ("crossing", [Column(x), Column(y), Number(level)]) => Number(crossing(x, y, *level)?),
        ("part", [Column(x), Column(y), Number(low), Number(high)]) => Column(part(x, y, *low, *high)?),
        ("integral", [Column(x), Column(y)]) => Number(integral(x, y)?),
        ("relative_l2", [Column(y), Column(reference)]) => Number(relative_l2(y, reference)?),
        ("relative_l2", [List(rows), List(references)]) => Column(relative_l2_of_each(rows, references)?),
        ("relative_l2", [Column(x), Column(y), Column(reference)]) => Number(relative_l2_over(x, y, reference)?),
        ("relative_l2", [List(x), List(rows), List(references)]) => Column(relative_l2_over_each(x, rows, references)?),
        ("relative_max", [Column(y), Column(reference)]) => Number(relative_max(y, reference)?),
        ("order", [Column(h), Column(error)]) => Number(order(h, error)?),
        ("share_within", [Column(claim), Column(truth), Number(above), Number(low), Number(high)]) => {
            Number(share_within(claim, truth, *above, *low, *high)?)
        }
        _ => return profile::call(name, arguments),
    }))
}
