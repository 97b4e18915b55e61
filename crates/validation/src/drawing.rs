//! Plots of a case, error against cost, outcomes over a range.

use std::collections::BTreeMap;

use super::case_file::{CurveSpec, LineSpec, PlotSpec, StabilitySpec, WorkPrecisionSpec};
use super::execution::Executed;
use super::expression::{Evaluator, ExpressionError};
use super::judge::number;
use super::members::Member;
use super::schedule::Members;
use super::value::Value;
use crate::record::{CasePlot, CurveStyle, PlotCurve, RunOutcome, StabilityPoint, WorkPrecisionPoint};

/// Members of a family that have results.
fn finished(family: &Members) -> impl Iterator<Item = (&Member, &Executed)> {
    family.ended().filter(|(_, run)| run.outcome == RunOutcome::Sound)
}

/// Plot of a case; `families` holds the runs by name, `absent` the files of numbers that are missing.
pub fn plot(
    spec: &PlotSpec,
    absent: &BTreeMap<&str, &str>,
    families: &BTreeMap<&str, &Members>,
    e: &mut Evaluator,
) -> Result<CasePlot, ExpressionError> {
    let mut curves = Vec::new();
    for of in spec.curve.iter().filter(|of| of.needs.as_deref().is_none_or(|name| !absent.contains_key(name))) {
        match of.each.as_deref().and_then(|name| families.get(name)) {
            None => curves.push(curve(of, of.name.clone(), e)?),
            Some(family) => {
                for (member, run) in finished(family) {
                    let name = [of.name.as_str(), member.label.as_str()].join(" ").trim().to_owned();
                    curves.push(e.with("run", &run.as_value(), |e| curve(of, name, e))?);
                }
            }
        }
    }
    Ok(CasePlot {
        title: spec.title.clone(),
        reading: spec.reading.clone(),
        levels: lines(&spec.level, e)?,
        marks: lines(&spec.mark, e)?,
        x: spec.x.clone(),
        y: spec.y.clone(),
        log_x: spec.log_x,
        log_y: spec.log_y,
        curves,
    })
}

fn lines(specs: &[LineSpec], e: &mut Evaluator) -> Result<Vec<(String, f64)>, ExpressionError> {
    specs.iter().map(|line| Ok((line.name.clone(), number(&line.at, e)?))).collect()
}

fn curve(of: &CurveSpec, name: String, e: &mut Evaluator) -> Result<PlotCurve, ExpressionError> {
    let (mut x, mut y) = (e.column(&of.x)?, e.column(&of.y)?);
    if let (CurveStyle::Band, Some(upper)) = (of.style, &of.upper) {
        let upper = e.column(upper)?;
        x = x.iter().chain(x.iter().rev()).copied().collect();
        y.extend(upper.into_iter().rev());
    }
    if x.len() != y.len() {
        let reason = format!("{} ordinates for {} abscissae of {:?}", y.len(), x.len(), of.x);
        return Err(ExpressionError { expression: of.y.clone(), reason });
    }
    let uncertainty = of.uncertainty.as_ref().map(|expression| e.column(expression)).transpose()?.unwrap_or_default();
    Ok(PlotCurve { name, x, y, uncertainty, style: of.style })
}

/// Error against cost of the members of a family.
pub fn work_precision(
    spec: &WorkPrecisionSpec,
    family: &Members,
    e: &mut Evaluator,
) -> Result<Vec<WorkPrecisionPoint>, ExpressionError> {
    let mut points = Vec::new();
    for (member, run) in finished(family) {
        let error = e.with("run", &run.as_value(), |e| e.number(&spec.error))?;
        if !error.is_finite() {
            let reason = format!("found {error} for {:?}; allowed: a finite error", member.label);
            return Err(ExpressionError { expression: spec.error.clone(), reason });
        }
        let series = member.value(&spec.series).map_or_else(String::new, in_words);
        points.push(WorkPrecisionPoint {
            series: format!("{series} {}", spec.name).trim().to_owned(),
            setting: member.label.clone(),
            error,
            wall_s: run.wall_s,
            work: run.work.get(&spec.counted).map_or(0.0, |&count| count as f64),
            counted: spec.counted.clone(),
        });
    }
    Ok(points)
}

/// Outcomes of the members of a family over its parameter.
///
/// # Errors
/// In words: a member without a number for it.
pub fn stability(spec: &StabilitySpec, family: &Members) -> Result<Vec<StabilityPoint>, String> {
    family.ended().map(|(member, run)| stability_point(spec, member, run)).collect()
}

fn stability_point(spec: &StabilitySpec, member: &Member, run: &Executed) -> Result<StabilityPoint, String> {
    let Some(&Value::Number(value)) =
        member.value(&spec.value).filter(|v| matches!(v, Value::Number(x) if x.is_finite()))
    else {
        let (parameter, name) = (&spec.parameter, &spec.value);
        return Err(format!("stability over {parameter}: {name} of a member is no number; allowed: numbers"));
    };
    Ok(StabilityPoint {
        parameter: spec.parameter.clone(),
        value,
        setting: member.label.clone(),
        outcome: run.outcome,
        expected: if member.may_end(run.outcome) { run.outcome } else { member.expected },
        said: run.said.clone(),
    })
}

fn in_words(value: &Value) -> String {
    match value {
        Value::Text(text) => text.clone(),
        Value::Number(number) => number.to_string(),
        other => format!("{other:?}"),
    }
}
