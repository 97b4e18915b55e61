//! Columns of numbers in expressions: arithmetic point by point, and the figures one reads off a curve.
//!
//! | expression | meaning |
//! |---|---|
//! | `x + y`, `2.0 * x`, `-x`, `abs(x)`, `sqrt(x)`, `ln(x)`, `exp(x)`, `sin(x)` | point by point |
//! | `x[3]`, `x.len`, `first(x)`, `last(x)` | points of a column |
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
//! | `order(h, error)` | slope of log error over log h, least squares |
//! | `share_within(claim, truth, above, low, high)` | of those whose truth is above a level, the share whose claim/truth lies from low to high |
//! | `column([a, b, …])` | a column of these |

use std::sync::Arc;

use rhai::{Array, Dynamic, Engine, EvalAltResult, Position};

/// Why a function has no value.
pub type Failed = Box<EvalAltResult>;

/// A column in an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Column(pub Arc<[f64]>);

/// A function that has no value, and why.
pub fn fault<T>(text: String) -> Result<T, Failed> {
    Err(EvalAltResult::ErrorRuntime(text.into(), Position::NONE).into())
}

/// A number of either kind.
fn number(value: &Dynamic) -> Option<f64> {
    value.as_float().ok().or_else(|| value.as_int().ok().map(|whole| whole as f64))
}

impl Column {
    fn map(&self, f: impl Fn(f64) -> f64) -> Self {
        Self(self.0.iter().map(|&x| f(x)).collect())
    }

    fn zip(&self, other: &Self, f: impl Fn(f64, f64) -> f64) -> Result<Self, Failed> {
        self.same_length(other)?;
        Ok(Self(self.0.iter().zip(other.0.iter()).map(|(&x, &y)| f(x, y)).collect()))
    }

    /// Refuses columns that do not go together.
    pub fn same_length(&self, other: &Self) -> Result<(), Failed> {
        match (self.0.len(), other.0.len()) {
            (one, same) if one == same => Ok(()),
            (one, two) => fault(format!("columns of {one} and {two} points do not go together")),
        }
    }

    fn not_empty(&self) -> Result<&[f64], Failed> {
        if self.0.is_empty() { fault("the column has no points".to_owned()) } else { Ok(&self.0) }
    }

    /// A figure that a number that is none spoils.
    fn fold(&self, f: impl Fn(f64, f64) -> f64) -> Result<f64, Failed> {
        let points = self.not_empty()?;
        Ok(points
            .iter()
            .copied()
            .reduce(|a, b| if a.is_nan() || b.is_nan() { f64::NAN } else { f(a, b) })
            .unwrap_or(f64::NAN))
    }

    fn sum(&self) -> f64 {
        self.0.iter().sum()
    }

    fn norm(&self) -> f64 {
        self.0.iter().map(|x| x * x).sum::<f64>().sqrt()
    }

    fn get(&self, index: i64) -> Result<f64, Failed> {
        let from_end = if index < 0 { index + self.0.len() as i64 } else { index };
        let point = usize::try_from(from_end).ok().and_then(|index| self.0.get(index));
        point.copied().map_or_else(|| fault(format!("a column of {} points has no point {index}", self.0.len())), Ok)
    }
}

/// y at `place`, linear between the points of ascending or descending `x`.
fn at(x: &Column, y: &Column, place: f64) -> Result<f64, Failed> {
    x.same_length(y)?;
    let found = x.0.windows(2).zip(y.0.windows(2)).find_map(|(x, y)| {
        let (low, high) = (x[0].min(x[1]), x[0].max(x[1]));
        ((low..=high).contains(&place) && low < high).then(|| y[0] + (y[1] - y[0]) * (place - x[0]) / (x[1] - x[0]))
    });
    let [from, to] = [x.0.first(), x.0.last()].map(|end| end.copied().unwrap_or(f64::NAN));
    found.map_or_else(|| fault(format!("{place} lies outside the column, {from} to {to}")), Ok)
}

fn place_of(x: &Column, y: &Column, better: fn(&f64, &f64) -> bool) -> Result<f64, Failed> {
    x.same_length(y)?;
    let mut best: Option<(f64, f64)> = None;
    for (&x, &y) in x.0.iter().zip(y.0.iter()) {
        if best.is_none_or(|(_, so_far)| better(&y, &so_far)) {
            best = Some((x, y));
        }
    }
    best.map_or_else(|| fault("the column has no points".to_owned()), |(x, _)| Ok(x))
}

fn crossing(x: &Column, y: &Column, level: f64) -> Result<f64, Failed> {
    x.same_length(y)?;
    let found = x.0.windows(2).zip(y.0.windows(2)).find_map(|(x, y)| {
        let (before, after) = (y[0] - level, y[1] - level);
        (before * after <= 0.0 && before != after).then(|| x[0] + (x[1] - x[0]) * before / (before - after))
    });
    found.map_or_else(|| fault(format!("the column never passes {level}")), Ok)
}

fn part(x: &Column, y: &Column, low: f64, high: f64) -> Result<Column, Failed> {
    x.same_length(y)?;
    Ok(Column(x.0.iter().zip(y.0.iter()).filter(|(x, _)| (low..=high).contains(*x)).map(|(_, &y)| y).collect()))
}

fn quantile(x: &Column, share: f64) -> Result<f64, Failed> {
    let mut sorted = x.not_empty()?.to_vec();
    sorted.sort_by(f64::total_cmp);
    let place = share.clamp(0.0, 1.0) * (sorted.len() - 1) as f64;
    let (below, above) = (place.floor() as usize, place.ceil() as usize);
    Ok(sorted[below] + (sorted[above] - sorted[below]) * place.fract())
}

fn order(h: &Column, error: &Column) -> Result<f64, Failed> {
    h.same_length(error)?;
    let (x, y) = (h.map(f64::ln), error.map(f64::ln));
    let n = x.0.len() as f64;
    let (x_mean, y_mean) = (x.sum() / n, y.sum() / n);
    let (x, y) = (x.map(|x| x - x_mean), y.map(|y| y - y_mean));
    Ok(x.zip(&y, |x, y| x * y)?.sum() / x.zip(&x, |a, b| a * b)?.sum())
}

fn column(items: Array) -> Result<Column, Failed> {
    let numbers: Option<Arc<[f64]>> = items.iter().map(number).collect();
    numbers.map_or_else(|| fault("a column is made of numbers".to_owned()), |numbers| Ok(Column(numbers)))
}

/// Whether every neighbour follows as `in_order` says.
fn ordered(x: &Column, in_order: fn(&f64, &f64) -> bool) -> bool {
    x.0.is_sorted_by(in_order)
}

/// Teaches the engine all of the above.
pub fn register(engine: &mut Engine) {
    engine.register_type_with_name::<Column>("column");
    arithmetic(engine, "+", |a, b| a + b);
    arithmetic(engine, "-", |a, b| a - b);
    arithmetic(engine, "*", |a, b| a * b);
    arithmetic(engine, "/", |a, b| a / b);
    engine.register_fn("-", |x: Column| x.map(|x| -x));
    for (name, f) in [
        ("abs", f64::abs as fn(f64) -> f64),
        ("sqrt", f64::sqrt),
        ("ln", f64::ln),
        ("exp", f64::exp),
        ("sin", f64::sin),
    ] {
        engine.register_fn(name, move |x: Column| x.map(f));
    }
    engine.register_indexer_get(|x: &mut Column, index: i64| x.get(index));
    engine.register_get("len", |x: &mut Column| x.0.len() as i64);
    engine.register_fn("column", column);

    engine.register_fn("first", |x: Column| x.get(0));
    engine.register_fn("last", |x: Column| x.get(-1));
    engine.register_fn("max", |x: Column| x.fold(f64::max));
    engine.register_fn("min", |x: Column| x.fold(f64::min));
    engine.register_fn("sum", |x: Column| x.sum());
    engine.register_fn("mean", |x: Column| -> Result<f64, Failed> { Ok(x.sum() / x.not_empty()?.len() as f64) });
    engine
        .register_fn("rms", |x: Column| -> Result<f64, Failed> { Ok(x.norm() / (x.not_empty()?.len() as f64).sqrt()) });
    engine.register_fn("quantile", |x: Column, share: f64| quantile(&x, share));
    engine.register_fn("differences", |x: Column| Column(x.0.windows(2).map(|two| two[1] - two[0]).collect()));
    engine.register_fn("is_rising", |x: Column| ordered(&x, |a, b| a < b));
    engine.register_fn("is_falling", |x: Column| ordered(&x, |a, b| a > b));
    engine.register_fn("local_maxima", |y: Column| {
        y.0.windows(3).filter(|three| three[1] > three[0] && three[1] > three[2]).count() as i64
    });
    for name in ["count_above", "count_below"] {
        let above = name == "count_above";
        let count = move |x: &Column, level: f64| {
            x.0.iter().filter(|&&x| if above { x > level } else { x < level }).count() as i64
        };
        engine.register_fn(name, move |x: Column, level: f64| count(&x, level));
        engine.register_fn(name, move |x: Column, level: i64| count(&x, level as f64));
    }

    engine.register_fn("at", |x: Column, y: Column, place: f64| at(&x, &y, place));
    engine.register_fn("at", |x: Column, y: Column, place: i64| at(&x, &y, place as f64));
    engine.register_fn("resample", |x: Column, y: Column, places: Column| -> Result<Column, Failed> {
        let found: Result<Arc<[f64]>, Failed> = places.0.iter().map(|&place| at(&x, &y, place)).collect();
        found.map(Column)
    });
    engine.register_fn("place_of_max", |x: Column, y: Column| place_of(&x, &y, |a, b| a > b));
    engine.register_fn("place_of_min", |x: Column, y: Column| place_of(&x, &y, |a, b| a < b));
    engine.register_fn("crossing", |x: Column, y: Column, level: f64| crossing(&x, &y, level));
    engine.register_fn("part", |x: Column, y: Column, low: f64, high: f64| part(&x, &y, low, high));
    engine.register_fn("integral", |x: Column, y: Column| -> Result<f64, Failed> {
        x.same_length(&y)?;
        Ok(x.0.windows(2).zip(y.0.windows(2)).map(|(x, y)| 0.5 * (x[1] - x[0]) * (y[0] + y[1])).sum())
    });
    engine.register_fn("relative_l2", |y: Column, reference: Column| -> Result<f64, Failed> {
        Ok(y.zip(&reference, |y, r| y - r)?.norm() / reference.norm())
    });
    // Of those whose truth is above a level, the share whose claim over truth lies from low to high; 0 where none is.
    engine.register_fn("share_within", |claim: Column, truth: Column, above: f64, low: f64, high: f64| {
        claim.same_length(&truth)?;
        let judged = claim.0.iter().zip(truth.0.iter()).filter(|(_, truth)| **truth > above);
        let (within, all) = judged.fold((0, 0), |(within, all), (claim, truth)| {
            (within + usize::from((low..=high).contains(&(claim / truth))), all + 1)
        });
        Ok::<f64, Failed>(if all > 0 { within as f64 / all as f64 } else { 0.0 })
    });
    // Of two lists of columns, such as one profile for each member of two families: a column of one number for each.
    engine.register_fn("relative_l2", |rows: Array, references: Array| -> Result<Column, Failed> {
        if rows.len() != references.len() {
            return fault(format!("lists of different lengths, {} and {}", rows.len(), references.len()));
        }
        let pairs = rows.into_iter().zip(references);
        let of_two =
            |(row, reference): (Dynamic, Dynamic)| match (row.try_cast::<Column>(), reference.try_cast::<Column>()) {
                (Some(row), Some(reference)) => Ok(row.zip(&reference, |y, r| y - r)?.norm() / reference.norm()),
                // A member that did not run has no profile.
                _ => Ok(f64::NAN),
            };
        pairs.map(of_two).collect::<Result<_, Failed>>().map(Column)
    });
    engine.register_fn("relative_max", |y: Column, reference: Column| -> Result<f64, Failed> {
        Ok(y.zip(&reference, |y, r| (y - r).abs())?.fold(f64::max)? / reference.map(f64::abs).fold(f64::max)?)
    });
    engine.register_fn("order", |h: Column, error: Column| order(&h, &error));
}

/// An operator between columns and numbers in either order.
fn arithmetic(engine: &mut Engine, name: &str, f: fn(f64, f64) -> f64) {
    engine.register_fn(name, move |x: Column, y: Column| x.zip(&y, f));
    engine.register_fn(name, move |x: Column, y: f64| x.map(|x| f(x, y)));
    engine.register_fn(name, move |x: f64, y: Column| y.map(|y| f(x, y)));
    engine.register_fn(name, move |x: Column, y: i64| x.map(|x| f(x, y as f64)));
    engine.register_fn(name, move |x: i64, y: Column| y.map(|y| f(x as f64, y)));
}
